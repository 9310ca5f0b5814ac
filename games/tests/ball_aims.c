/* Aiming at a ball: what is found holds, and what is refused is not there. The judge plays
 * shots, and knows nothing of paths.
 */
#include "carom_plan.h"
#include "shot_support.h"

#include <math.h>
#include <stdio.h>

static const double per_degree = 3.14159265358979323846 / 180.0;
enum { LAYOUTS = 2000, MOST_BALLS = 8, DIRECTIONS = 720, HALVINGS = 50 };

/* The angle from one direction to another one, degrees. */
static double degrees_between(const double a[2], const double b[2]) {
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) / per_degree;
}

/* A cue, what it shoots at, and by which rules. */
typedef struct problem {
  carom_table table;
  carom_shot_ball ball[MOST_BALLS];
  int count, offset;
  carom_cue cue;
  carom_shot_options options;
  double cut;
} problem;

/* The cut at which ball `at` is met, degrees; NaN where something else is met first, or nothing. */
static double cut_at(const problem *p, double phi) {
  carom_cue cue = p->cue;
  carom_shot_options options = p->options;
  carom_shot shot = {.events = events, .room = ROOM};
  cue.phi = phi;
  options.stop_at = CAROM_STOP_AT_CONTACT | CAROM_STOP_AT(CAROM_EVENT_RAIL) |
                    CAROM_STOP_AT(CAROM_EVENT_JAW) | CAROM_STOP_AT(CAROM_EVENT_POCKET) |
                    CAROM_STOP_AT(CAROM_EVENT_RAIL_TOP) | CAROM_STOP_AT(CAROM_EVENT_LEFT_TABLE);
  carom_shoot(&p->table, p->ball, p->count, &cue, &options, &shot);
  /* contacts of one instant come in their order, and may be between other balls */
  const carom_event *e = events, *end = events + shot.count;
  while (e < end && (e->type != CAROM_EVENT_BALL_BALL || (e->a != 0 && e->b != 0)))
    e++;
  if (e == end || (e->a != p->offset && e->b != p->offset))
    return (double)NAN;
  const carom_ball_state *striker = &e->before[e->a == 0 ? 0 : 1],
                         *object = &e->before[e->a == 0 ? 1 : 0];
  /* met while the cue pushes: the cut at which the ball would come alone, straight on */
  if (events[0].cluster > 0 && e->time == 0.0) {
    carom_shot_ball alone = p->ball[0];
    carom_ball_state left;
    carom_shot strike = {.final = &left};
    const double *from = p->ball[0].state.r, x = object->r[0] - from[0], y = object->r[1] - from[1],
                 touch = alone.kind.radius + p->ball[p->offset].kind.radius;
    options.stop_at = CAROM_STOP_AT(CAROM_EVENT_STRIKE);
    carom_shoot(&p->table, &alone, 1, &cue, &options, &strike);
    const double v = hypot(left.v[0], left.v[1]), along = (x * left.v[0] + y * left.v[1]) / v,
                 across = (x * left.v[1] - y * left.v[0]) / v;
    const double t = (along - sqrt(fmax(touch * touch - across * across, 0.0))) / v;
    return degrees_between(left.v, (const double[]){x - t * left.v[0], y - t * left.v[1]});
  }
  return degrees_between(
      striker->v, (const double[]){object->r[0] - striker->r[0], object->r[1] - striker->r[1]});
}

/* Whether some direction has the cut, by trial: neighbours with a lesser and a greater cut are
 * halved. */
static bool exists(const problem *p) {
  const int directions = FEWER(DIRECTIONS);
  double last = cut_at(p, 0.0);
  for (int k = 1; k <= directions; k++) {
    double low = 360.0 * (k - 1) / directions, high = 360.0 * k / directions;
    const double previous = last, next = last = cut_at(p, high);
    if (!((previous - p->cut) * (next - p->cut) < 0.0))
      continue;
    for (int halving = 0; halving < HALVINGS; halving++) {
      const double middle = 0.5 * (low + high);
      *((cut_at(p, middle) - p->cut) * (previous - p->cut) > 0.0 ? &low : &high) = middle;
    }
    if (fabs(cut_at(p, low) - p->cut) < 1e-3 && fabs(cut_at(p, high) - p->cut) < 1e-3)
      return true;
  }
  return false;
}

static problem random_problem(random_source *random) {
  static const carom_game games[] = {CAROM_GAME_POOL, CAROM_GAME_POOL, CAROM_GAME_POOL,
                                     CAROM_GAME_SNOOKER, CAROM_GAME_BILLIARD};
  problem p;
  do {
    const int kind = (int)random_between(random, 0.0, 5.0);
    p = (problem){.count = 2 + (int)random_between(random, 0.0, MOST_BALLS - 1),
                  .cue = carom_cue_of(games[kind])};
    expect_ok(carom_table_make((carom_table_kind)kind, &p.table));
    for (int k = 0; k < p.count; k++) {
      p.ball[k].kind = carom_ball_kind_of(games[kind]);
      p.ball[k].state.r[0] = random_between(random, 0.0, p.table.width);
      p.ball[k].state.r[1] = random_between(random, 0.0, p.table.length);
      p.ball[k].state.r[2] = p.ball[k].kind.radius;
    }
    /* One ball in ten touches the cue ball. */
    if (random_between(random, 0.0, 10.0) < 1.0) {
      const double touch = random_between(random, 0.0, 360.0) * per_degree,
                   apart = 2.0 * p.ball[0].kind.radius;
      p.ball[1].state.r[0] = p.ball[0].state.r[0] + apart * cos(touch);
      p.ball[1].state.r[1] = p.ball[0].state.r[1] + apart * sin(touch);
    }
    /* Half of the cues are level, a fifth of all plays flat, one in ten by pooltool's rules. */
    const double off = random_between(random, 0.0, 0.9),
                 turn = random_between(random, 0.0, 360.0) * per_degree;
    const double world = random_between(random, 0.0, 10.0);
    p.cue.a = off * cos(turn);
    p.cue.b = off * sin(turn);
    p.cue.speed = exp(random_between(random, log(0.3), log(10.0)));
    p.cue.theta = fmax(random_between(random, -80.0, 80.0), 0.0);
    p.cue.tip_time = turn > 3.0 ? 0.0006 : 0.0; /* half of them jump */
    p.cut = fmax(fmin(random_between(random, -100.0, 100.0), 85.0), -85.0);
    p.options.space = world < 3.0 ? CAROM_SPACE_FLAT : CAROM_SPACE_3D;
    p.options.world = world < 1.0 ? CAROM_WORLD_POOLTOOL : CAROM_WORLD_CAROM;
    p.offset = 1;
  } while (carom_shot_check(&p.table, p.ball, p.count, &p.cue, &p.options, NULL) != CAROM_OK);
  return p;
}

TEST(the_ball_is_met_at_the_cut_or_cannot_be) {
  random_source random = {test_seed()};
  int found[CAROM_POT_STICK + 1] = {0};
  for (int k = 0; k < FEWER(LAYOUTS); k++) {
    const problem p = random_problem(&random);
    carom_cue cue = p.cue;
    carom_pot pot = {.ball = p.offset, .pocket = CAROM_POT_NO_POCKET, .cut = p.cut};
    expect_ok(carom_aim(&p.table, p.ball, p.count, &p.options, &pot, &cue));
    const int result = pot.outcome;
    found[result]++;
    /* Whether a ball that touches is met at once or after the slate depends on rounding. */
    const double allowed =
        hypot(p.ball[1].state.r[0] - p.ball[0].state.r[0],
              p.ball[1].state.r[1] - p.ball[0].state.r[1]) < 2.0 * p.ball[0].kind.radius + 1e-9
            ? 1e-2
            : 1e-4;
    if (result == CAROM_POT_FALLS)
      ck_assert_msg(fabs(cut_at(&p, cue.phi) - p.cut) < allowed,
                    "layout %d: a cut of %.9g, not %.9g", k, cut_at(&p, cue.phi), p.cut);
    else
      ck_assert_msg(!exists(&p),
                    "layout %d: refused (%d), but there is a direction for a cut of %.9g", k,
                    result, p.cut);
    if (result == CAROM_POT_BARRED)
      ck_assert_msg(
          pot.met.time >= 0.0 && pot.met.type != 0 &&
              (pot.met.type != CAROM_EVENT_BALL_BALL || pot.met.a + pot.met.b != p.offset),
          "layout %d: barred by event %d", k, pot.met.type);
  }
  printf("%d found, %d barred, %d not reached, %d without direction\n", found[CAROM_POT_FALLS],
         found[CAROM_POT_BARRED], found[CAROM_POT_SHORT], found[CAROM_POT_NO_WAY]);
  for (int k = CAROM_POT_FALLS; k <= CAROM_POT_SHORT; k++)
    ck_assert_int_gt(found[k], FEWER(10));
}

/* Side spin squirts and swerves: geometry alone has cuts of 44 and 62 degrees here. */
TEST(the_cut_is_exact_with_side_spin) {
  for (int side = 0; side <= 2; side++)
    for (int k = 0; k <= 1; k++) {
      problem p = {.count = 2, .offset = 1, .cut = 30.0, .cue = carom_cue_of(CAROM_GAME_POOL)};
      if (k == 0)
        expect_ok(carom_table_make(CAROM_TABLE_POOL_9FT, &p.table));
      else
        expect_ok(carom_table_make(CAROM_TABLE_THREECUSHION, &p.table));
      for (int ball = 0; ball < 2; ball++) {
        p.ball[ball].kind = carom_ball_kind_of(CAROM_GAME_POOL);
        p.ball[ball].state.r[0] = 0.6;
        p.ball[ball].state.r[1] = 0.5 + 1.2 * ball;
        p.ball[ball].state.r[2] = p.ball[ball].kind.radius;
      }
      p.cue.speed = 3.0;
      p.cue.a = 0.15 * side;
      carom_pot pot = {.ball = 1, .pocket = CAROM_POT_NO_POCKET, .cut = p.cut};
      expect_ok(carom_aim(&p.table, p.ball, p.count, NULL, &pot, &p.cue));
      ck_assert_int_eq(pot.outcome, CAROM_POT_FALLS);
      ck_assert_double_eq_tol(cut_at(&p, p.cue.phi), 30.0, 1e-6);
    }
}

/* A cue ball at the rail: the stick is raised over it, and the aim is that of the raised cue. */
TEST(the_stick_is_raised_as_far_as_it_must_be) {
  problem p = {.count = 2, .offset = 1, .cut = -20.0, .cue = carom_cue_of(CAROM_GAME_POOL)};
  expect_ok(carom_table_make(CAROM_TABLE_POOL_9FT, &p.table));
  for (int ball = 0; ball < 2; ball++) {
    p.ball[ball].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    p.ball[ball].state.r[0] = 0.6;
    p.ball[ball].state.r[1] = 0.03 + 1.2 * ball;
    p.ball[ball].state.r[2] = p.ball[ball].kind.radius;
  }
  p.cue.a = 0.3;
  p.cue.theta = (double)NAN;
  carom_pot pot = {.ball = 1, .pocket = CAROM_POT_NO_POCKET, .cut = p.cut};
  expect_ok(carom_aim(&p.table, p.ball, p.count, NULL, &pot, &p.cue));
  ck_assert_int_eq(pot.outcome, CAROM_POT_FALLS);
  ck_assert_double_gt(p.cue.theta, 1.0);
  ck_assert(p.cue.theta >= pot.elevation);
  ck_assert_double_eq_tol(cut_at(&p, p.cue.phi), -20.0, 1e-6);
}

TEST(wrong_aims_are_refused) {
  carom_table table;
  carom_shot_ball balls[2] = {0};
  expect_ok(carom_table_make(CAROM_TABLE_POOL_9FT, &table));
  for (int ball = 0; ball < 2; ball++) {
    balls[ball].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    balls[ball].state.r[0] = 0.6;
    balls[ball].state.r[1] = 0.5 + 1.2 * ball;
    balls[ball].state.r[2] = balls[ball].kind.radius;
  }
  static const struct {
    carom_pot pot;
    carom_status status;
  } wrong[] = {
      {{.ball = 0, .pocket = CAROM_POT_NO_POCKET}, CAROM_ERROR_BALLS},
      {{.ball = 2, .pocket = CAROM_POT_NO_POCKET}, CAROM_ERROR_BALLS},
      {{.ball = -1, .pocket = CAROM_POT_NO_POCKET}, CAROM_ERROR_BALLS},
      {{.ball = 1, .pocket = -2}, CAROM_ERROR_BALLS},
      {{.ball = 1, .pocket = CAROM_POT_NO_POCKET, .vias = 1}, CAROM_ERROR_BALLS},
      {{.ball = 1, .pocket = CAROM_POT_NO_POCKET, .cut = 90.0}, CAROM_ERROR_OPTIONS},
      {{.ball = 1, .pocket = CAROM_POT_NO_POCKET, .cut = NAN}, CAROM_ERROR_OPTIONS},
  };
  for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    carom_pot pot = wrong[k].pot;
    ck_assert_int_eq(carom_aim(&table, balls, 2, NULL, &pot, &cue), wrong[k].status);
  }
}
