/* The kind of row that is a collision of two balls: 26 numbers, those of a carom_impact, and 12
 * results. */
#include "derived.h"
#include "kind.h"
#include "memory.h"

#include <stdlib.h>
#include <string.h>

enum {
  NUMBERS = sizeof(carom_impact) / sizeof(double),
  RESULTS = sizeof(carom_result) / sizeof(double)
};
enum { RADIUS = 9, MASS = 10, CLOTH = 11, SECOND = 12, POINT = 23 };

#define OF_BALL(n, other)                                                                       \
  {"r" n "x", 0, NO_NUMBER, 0}, {"r" n "y", 0, NO_NUMBER, 0}, {"r" n "z", 0, NO_NUMBER, 0},     \
      {"v" n "x", 0, NO_NUMBER, 0}, {"v" n "y", 0, NO_NUMBER, 0}, {"v" n "z", 0, NO_NUMBER, 0}, \
      {"w" n "x", 0, NO_NUMBER, 0}, {"w" n "y", 0, NO_NUMBER, 0}, {"w" n "z", 0, NO_NUMBER, 0}, \
      {"R" n, "R", (other) + RADIUS, 0}, {"M" n, "M", (other) + MASS, 0}, {                     \
    "u_s" n, "u_s", (other) + CLOTH, 0                                                          \
  }

static const column columns[NUMBERS] = {
    OF_BALL("1", SECOND), OF_BALL("2", 0), {"u_b", 0, NO_NUMBER, 0}, {"e_b", 0, NO_NUMBER, 0}};
static const double defaults[NUMBERS] = {0};

/* The options of the library for one of the solvers asked for. */
static carom_options options_of(const shared_options *asked, int variant) {
  carom_options options = asked->options;
  if (asked->solvers.count > 0)
    options.solver = asked->solvers.solver[variant];
  return options;
}

static const char *name(const shared_options *asked, int variant) {
  return carom_solver_name(options_of(asked, variant).solver);
}

static carom_status check(const void *in, const shared_options *asked, int *field) {
  return carom_check(in, &asked->options, field);
}

/* A law of friction depends on the slip, and so on the row. */
static void prepare(const shared_options *asked, void *in) {
  carom_impact *impact = in;
  if (asked->friction.given)
    impact->mu_ball = carom_mu_ball(impact, asked->friction.law);
}

static void solve(const shared_options *asked, bool single, const void *in, size_t n, void *out,
                  int8_t *status) {
  const carom_options options = options_of(asked, 0);
  if (single)
    carom_collide_batch_f32(in, n, &options, out, status);
  else
    carom_collide_batch(in, n, &options, out, status);
}

static void derive_row(const void *in, const void *out, double *numbers) {
  const derived d = derive(in, out);
  memcpy(numbers, &d, sizeof d);
}

static void describe(FILE *out, const shared_options *asked, const void *in) {
  const carom_impact *impact = in;
  const carom_options *options = &asked->options;
  fprintf(out, "# collision: %s\n# slip: %s\n# steps: %d\n", asked->id,
          carom_slip_name(options->slip), options->steps);
  fprintf(out,
          "# friction between the balls: %.3g\n# friction of the cloth: %.3g and %.3g\n# "
          "restitution: %.3g\n",
          impact->mu_ball, impact->a.mu_cloth, impact->b.mu_cloth, impact->restitution);
}

static carom_status trace(const shared_options *asked, int variant, const void *in, int n,
                          trace_point *points) {
  const carom_impact *impact = in;
  const carom_options options = options_of(asked, variant);
  const double along[2] = {impact->b.r[0] - impact->a.r[0], impact->b.r[1] - impact->a.r[1]};
  carom_trace_point *own = allocate((size_t)n, sizeof *own);
  const carom_status status = carom_trace(impact, &options, (size_t)n, own);
  for (int k = 0; k < n; k++) {
    const carom_trace_point *p = &own[k];
    points[k] = (trace_point){.impulse = p->normal,
                              .work = p->work,
                              .restitution = p->phase == CAROM_PHASE_RESTITUTION,
                              .sticks = {p->sticks != 0},
                              .number = {p->v_n, p->u_x, p->u_z, p->d_x, p->d_y, p->b_x, p->b_y}};
    into_frame(along, p->state.a.v, points[k].number + 7);
    into_frame(along, p->state.b.v, points[k].number + 9);
    memcpy(points[k].number + 11, &p->state, sizeof p->state);
  }
  free(own);
  return status;
}

/* The exact solver says where the balls stick; Euler's method does not see it. */
static void stuck(const shared_options *asked, const void *in, int n, const trace_point *points,
                  double at[2]) {
  carom_options options = asked->options;
  carom_result unused;
  carom_detail detail;
  (void)n;
  (void)points;
  options.solver = CAROM_SOLVER_EXACT;
  carom_collide_detail(in, &options, &unused, &detail);
  at[0] = detail.stick_normal;
}

/* Throw, the share of the impulse after which the balls stick, and the friction that was in
 * force. */
static carom_status look(const shared_options *asked, int variant, const void *in, void *out,
                         double lead[2], double *tail) {
  const carom_options options = options_of(asked, variant);
  carom_detail detail;
  const carom_status status = carom_collide_detail(in, &options, out, &detail);
  lead[0] = derive(in, out).throw_deg;
  lead[1] = detail.stick_normal / detail.normal;
  *tail = ((const carom_impact *)in)->mu_ball;
  return status;
}

const row_kind ball_kind = {
    .noun = "collision",
    .which = "solver",
    .clue = "mu_w",
    .meant = "with --cushion impacts on a cushion are read; ",
    .numbers = NUMBERS,
    .results = RESULTS,
    .columns = columns,
    .defaults = defaults,
    .radius = RADIUS,
    .height = NO_NUMBER,
    .motion = {3, SECOND + 3},
    .result_columns = RESULT_COLUMNS,
    .has_single = true,
    .name = name,
    .check = check,
    .prepare = prepare,
    .solve = solve,
    .derived_columns = DERIVED_COLUMNS,
    .derived = DERIVED_NUMBERS,
    .derive = derive_row,
    .describe = describe,
    .trace_columns = "sticks,v_n_m_s,u_x_m_s,u_z_m_s,d_x_m_s,d_y_m_s,b_x_m_s,b_y_m_s,v1_x_m_s,v1_y_"
                     "m_s,v2_x_m_s,v2_y_m_s",
    .contacts = {"the balls stick"},
    .trace_numbers = POINT,
    .trace = trace,
    .stuck = stuck,
    .inputs = "cut speed v1x v1y w1x w1y w1z v2x v2y w2x w2y w2z R M M1 M2 u_s u_s1 u_s2 u_b e_b",
    .turning = "cut",
    .lead_columns = "throw_deg,stick_share,",
    .lead = 2,
    .tail_columns = "mu_ball",
    .title = "Throw of the object ball",
    .axis = "throw of ball 2 (degrees, to the left)",
    .direction = {0, SECOND},
    .look = look,
};
