/* Fine sweeps of single inputs: the exact solver's results have no jumps, Euler's method's do.
 *
 * A jump is a step between neighbouring values that lies outside what the steps before and after
 * it span, over the largest result of the collision. A smooth curve has next to none, and
 * neither has a corner, as where the balls begin to stick before they part. But where the true
 * curve bends within one step, it seems to jump too: there carom_trace(), another method and a
 * more exact one, says how much of it is the solver's own.
 */
#include "cases.h"
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { VALUES = 10000, RESULTS = 12 };

/* The project's goal, and about what the solver reaches. */
static const double bound = 1e-6;
static const double worth_a_look = 3e-7;

/* Cases of all kinds: rolling, sliding, both balls moving, a ball at rest pressed, slip ending
 * early, late, just at the end and never. */
static const char *const ids[] = {"pooltool-005", "pooltool-031", "pooltool-034", "pooltool-048",
                                  "pooltool-086", "pooltool-108", "pooltool-135", "pooltool-179",
                                  "mathavan-3",   "mathavan-5"};
enum { IDS = sizeof ids / sizeof ids[0] };

/* The inputs: the cut angle, the speed, and numbers of the impact, from `low` to `high`; spins in
 * the speed over the radius. */
#define AT(field) (int)(offsetof(carom_impact, field) / sizeof(double))
static const struct {
  const char *name;
  int at;
  double low, high;
} inputs[] = {{"cut angle", -1, -0.5, 0.5},
              {"speed", -2, 0.2, 2.0},
              {"w1x", AT(a.w[0]), -1.0, 1.0},
              {"w1y", AT(a.w[1]), -1.0, 1.0},
              {"w1z", AT(a.w[2]), -1.0, 1.0},
              {"w2x", AT(b.w[0]), -1.0, 1.0},
              {"w2y", AT(b.w[1]), -1.0, 1.0},
              {"w2z", AT(b.w[2]), -1.0, 1.0},
              {"friction of the cloth on ball 1", AT(a.mu_cloth), 0.0, 0.6},
              {"friction of the cloth on ball 2", AT(b.mu_cloth), 0.0, 0.6},
              {"friction between the balls", AT(mu_ball), 0.0, 0.3},
              {"restitution", AT(restitution), 0.0, 1.0}};
enum { INPUTS = sizeof inputs / sizeof inputs[0], W1Z = 4 };

static void set(carom_impact *in, int k, double share) {
  const double speed = hypot(hypot(in->a.v[0], in->a.v[1]), hypot(in->b.v[0], in->b.v[1]));
  const double value = inputs[k].low + share * (inputs[k].high - inputs[k].low);
  if (inputs[k].at == -1) {
    const double x = in->b.r[0] - in->a.r[0], y = in->b.r[1] - in->a.r[1];
    in->b.r[0] = in->a.r[0] + x * cos(value) - y * sin(value);
    in->b.r[1] = in->a.r[1] + x * sin(value) + y * cos(value);
  } else if (inputs[k].at == -2) {
    for (int axis = 0; axis < 3; axis++) {
      in->a.v[axis] *= value;
      in->a.w[axis] *= value;
    }
  } else {
    ((double *)in)[inputs[k].at] = value * (inputs[k].low < 0.0 ? speed / in->a.radius : 1.0);
  }
}

typedef struct sample {
  double speed[RESULTS]; /* spins times radius */
  double scale;
  bool collides;
} sample;

/* By the solver, or by carom_trace(). */
static sample sample_of(const carom_impact *start, const carom_options *options, int k, int value,
                        bool traced) {
  carom_impact in = *start;
  carom_trace_point points[2];
  set(&in, k, (double)value / (VALUES - 1));
  const carom_status status =
      traced ? carom_trace(&in, options, 2, points) : carom_collide(&in, options, &points[1].state);
  sample s = {.collides = status == CAROM_OK};
  for (int c = 0; c < RESULTS; c++) {
    s.speed[c] = ((const double *)&points[1].state)[c] * (c / 3 % 2 == 1 ? in.a.radius : 1.0);
    s.scale = fmax(s.scale, fabs(s.speed[c]));
  }
  return s;
}

static double jump_of(const sample at[4]) {
  double most = 0.0;
  if (!at[0].collides || !at[1].collides || !at[2].collides || !at[3].collides)
    return 0.0;
  for (int c = 0; c < RESULTS; c++) {
    double step[3];
    for (int k = 0; k < 3; k++)
      step[k] = at[k + 1].speed[c] - at[k].speed[c];
    most = fmax(most, fmax(step[1] - fmax(step[0], step[2]), fmin(step[0], step[2]) - step[1]));
  }
  return most / at[1].scale;
}

/* What the solver's error does from `value` to the next. */
static double own_jump(const carom_impact *start, const carom_options *options, int k, int value,
                       const sample at[2]) {
  const sample truth[2] = {sample_of(start, options, k, value, true),
                           sample_of(start, options, k, value + 1, true)};
  double most = 0.0;
  ck_assert(truth[0].collides && truth[1].collides);
  for (int c = 0; c < RESULTS; c++)
    most =
        fmax(most, fabs(at[1].speed[c] - truth[1].speed[c] - at[0].speed[c] + truth[0].speed[c]));
  return most / at[0].scale;
}

typedef struct finding {
  double seen, own; /* largest jumps */
  int value;
  const char *id;
} finding;

static void look(const carom_impact *in, const char *id, const carom_options *options, int k,
                 finding *f) {
  sample at[4] = {{.collides = false}};
  for (int value = 0; value < VALUES; value++) {
    memmove(at, at + 1, 3 * sizeof at[0]);
    at[3] = sample_of(in, options, k, value, false);
    const double seen = jump_of(at);
    const double own = seen > worth_a_look ? own_jump(in, options, k, value - 2, at + 1) : seen;
    f->seen = fmax(f->seen, seen);
    if (own > f->own) {
      f->own = own;
      f->value = value - 2;
      f->id = id;
    }
  }
}

static carom_impact find_case(const case_set *cases, const char *id) {
  size_t k = 0;
  while (k < cases->count && strcmp(cases->id[k], id) != 0)
    k++;
  ck_assert_msg(k < cases->count, "no case %s", id);
  return cases->impact[k];
}

TEST(exact_is_smooth) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  double most = 0.0;
  for (int k = 0; k < INPUTS; k++) {
    finding f = {.id = "any"};
    for (int one = 0; one < IDS; one++)
      for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
        const carom_options options = {.slip = (carom_slip)slip};
        const carom_impact in = find_case(&cases, ids[one]);
        look(&in, ids[one], &options, k, &f);
      }
    printf("%-32s largest jump %.2g, the solver's own %.2g (value %d of %s)\n", inputs[k].name,
           f.seen, f.own, f.value, f.id);
    most = fmax(most, f.own);
  }
  fflush(stdout);
  ck_assert_double_le(most, bound);
  cases_free(&cases);
}

/* What the measure sees of Euler's method, where the slip has come to its end. */
TEST(euler_is_not) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  const carom_impact in = find_case(&cases, "pooltool-135");
  const carom_options options = {.solver = CAROM_SOLVER_EULER};
  sample at[4] = {{.collides = false}};
  int jumps = 0;
  for (int value = VALUES / 2; value < VALUES / 2 + 200; value++) {
    memmove(at, at + 1, 3 * sizeof at[0]);
    at[3] = sample_of(&in, &options, W1Z, value, false);
    jumps += jump_of(at) > 1e-5;
  }
  printf("Euler's method, N = 1000, where it sticks: %d of 197 steps jump by more than 1e-5\n",
         jumps);
  ck_assert_int_ge(jumps, 50);
  cases_free(&cases);
}
