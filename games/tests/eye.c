/* Places that a player sees with errors. */
#include "eye.h"
#include "plan_support.h"

/* Pushes ball k from its position in a direction until it touches something. */
static void push(int k, double phi) {
  const double from[2] = {balls[k].state.r[0], balls[k].state.r[1]};
  const double u[2] = {cos(phi * per_degree), sin(phi * per_degree)};
  double free = 0.0, barred = 4.0;
  for (int n = 0; n < 60; n++) {
    const double way = 0.5 * (free + barred);
    const bool good = carom_place_ball(&table, balls, (int)job.count, k, from[0] + way * u[0],
                                       from[1] + way * u[1], NULL) == CAROM_OK;
    *(good ? &free : &barred) = way;
  }
  expect_ok(carom_place_ball(&table, balls, (int)job.count, k, from[0] + free * u[0],
                             from[1] + free * u[1], NULL));
}

static double gap_of(const carom_ball_state *a, const carom_ball_state *b, double R, double Q) {
  return hypot(a->r[0] - b->r[0], a->r[1] - b->r[1]) - 2.0 * sqrt(R * Q);
}

/* Whether the gaps of a drawn layout are what the player and the referee know of those that are. */
static void check_gaps(const carom_ball_state *drawn, double eye) {
  static const double left = 3e-5; /* m: by which the last sweep may be beyond a bound */
  for (int a = 0; a < job.count; a++)
    for (int b = 0; b < a; b++) {
      if (balls[a].state.label != CAROM_BALL_STATIONARY ||
          balls[b].state.label != CAROM_BALL_STATIONARY)
        continue;
      const double R = balls[a].kind.radius, Q = balls[b].kind.radius;
      const double gap = gap_of(&balls[a].state, &balls[b].state, R, Q);
      const double drawn_gap = gap_of(&drawn[a], &drawn[b], R, Q);
      if (gap > 12.0 * eye)
        continue;
      ck_assert_double_gt(drawn_gap, fmin(gap, 0.0) - left);
      ck_assert_double_lt(drawn_gap, 2.0 * fmax(gap, 0.0) + left);
      if (b == 0 && fabs(drawn_gap - CAROM_RULES_TOUCH) > left)
        ck_assert_int_eq(gap < CAROM_RULES_TOUCH, drawn_gap < CAROM_RULES_TOUCH);
    }
}

/* In every game, with its rack and with balls that were pushed against cushions, into jaws and
 * against each other, all that is drawn are layouts. Free balls have the errors of the eye. */
TEST(drawn_layouts_are_layouts) {
  static const double eyes[] = {2e-4, 1e-3, 1e-2};
  random_source r = {11};
  int places = 0;
  double squares = 0.0;
  for (int game = 0; carom_rules_about_of((carom_rules_kind)game) != NULL; game++)
    for (int layout = 0; layout < 6; layout++) {
      lay_out_game((carom_rules_kind)game, (uint64_t)layout + 1);
      for (int k = 0; k < job.count && layout > 0; k++) {
        while (carom_place_ball(&table, balls, (int)job.count, k,
                                random_between(&r, 0.0, table.width),
                                random_between(&r, 0.0, table.length), NULL) != CAROM_OK)
          continue;
        push(k, 45.0 * (int)random_between(&r, 0.0, 8.0));
      }
      carom_features features;
      carom_prepared prepared;
      int where;
      expect_ok(
          carom_prepare(&table, balls, job.count, &shot_options, &features, &prepared, &where));
      for (uint64_t row = 0; row < 30; row++) {
        const double eye = eyes[row % 3];
        carom_ball_state drawn[CAROM_BALLS_MOST];
        carom_shot_ball moved[CAROM_BALLS_MOST];
        carom_eye_draw(&prepared, 0, eye, (uint64_t)game, 16, row, drawn);
        memcpy(moved, balls, sizeof balls);
        for (int k = 0; k < job.count; k++)
          moved[k].state = drawn[k];
        const carom_status status =
            carom_shot_check(&table, moved, (int)job.count, NULL, &shot_options, &where);
        ck_assert_msg(status == CAROM_OK, "game %d, layout %d, eye %g: ball %d: %s", game, layout,
                      eye, where, carom_status_string(status));
        check_gaps(drawn, eye);

        /* the cue ball before a rack touches nothing */
        for (int x = 0; x < 2 && layout == 0; x++) {
          squares += pow((drawn[0].r[x] - balls[0].state.r[x]) / eye, 2.0);
          places++;
        }
      }
    }
  ck_assert_double_eq_tol(squares / places, 1.0, 0.15); /* by 1140 places: 0.04 */
}

/* A ball close before another one, on a line into a pocket: a combination that is nearly dead. */
static carom_cue put_combination(double gap) {
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  player = carom_player_of(0.3);
  const double R = balls[0].kind.radius, u = sqrt(0.5);
  const double x = 0.6, farther = x + u * (2.0 * R + gap);
  expect_ok(place_ball(8, x, x));
  expect_ok(place_ball(9, farther, farther));
  expect_ok(place_ball(0, 0.95, 0.9));
  carom_pot pot = {.ball = 8, .vias = 1, .via = {{CAROM_PART_BALL, 9}}};
  for (int p = 0; p < table.pockets; p++)
    if (table.pocket[p].centre[0] + table.pocket[p].centre[1] < 0.2)
      pot.pocket = p;
  carom_cue stroke = cue;
  stroke.speed = 2.0;
  expect_ok(carom_aim(&table, balls, BALLS, &shot_options, &pot, &stroke));
  ck_assert_int_eq(pot.outcome, CAROM_POT_FALLS);
  return stroke;
}

static carom_plan_stroke tried(const carom_cue *stroke, double eye, int64_t shots) {
  carom_plan_stroke same[2];
  const carom_cue twice[2] = {*stroke, *stroke};
  player.eye = eye;
  options.shots = 2 * shots;
  make_memory();
  expect_ok(carom_plan_try(&job, twice, 2, same));
  edge_free(&memory);
  ck_assert_mem_eq(&same[0], &same[1], sizeof same[0]); /* all strokes meet the same places */
  return same[0];
}

/* The chance that is told is that of layouts whose balls lie elsewhere by the errors of the eye, as
 * this test draws them. The usual eye is 0.2 mm. */
TEST(told_chances_are_of_drawn_places) {
  static const double eyes[] = {-1.0, 1e-3, 2e-3, 4e-3};
  random_source r = {3};
  double last = 1.1;
  const carom_cue stroke = put_combination(0.02);
  for (size_t k = 0; k < COUNT_OF(eyes); k++) {
    const double told = tried(&stroke, eyes[k], 600).keep, eye = fmax(eyes[k], 0.0);
    double came = 0.0;
    const int layouts = draws_of_test(120, 240);
    for (int n = 0; n < layouts; n++) {
      do { /* balls do not lie in each other */
        put_combination(0.02);
        for (int ball = 0; ball < 10; ball++)
          for (int x = 0; x < 2 && (ball == 0 || ball > 7); x++)
            balls[ball].state.r[x] += eye * sqrt(-2.0 * log(random_between(&r, 1e-9, 1.0))) *
                                      cos(6.283185307 * random_between(&r, 0.0, 1.0));
      } while (hypot(balls[9].state.r[0] - balls[8].state.r[0],
                     balls[9].state.r[1] - balls[8].state.r[1]) < 2.0 * balls[0].kind.radius);
      options.seed = (uint64_t)n;
      came += tried(&stroke, -1.0, 50).keep / layouts;
    }
    put_combination(0.02);
    options.seed = 0;
    printf("eye of %g mm: told %.3f, came %.3f\n", 1e3 * eye, told, came);
    ck_assert_double_eq_tol(told, came, 1.5 / sqrt(layouts)); /* three standard errors at most */
    ck_assert_double_lt(told, last);
    last = told - 0.02;
  }
  const carom_plan_stroke usual = tried(&stroke, 0.0, 600), named = tried(&stroke, 2e-4, 600);
  ck_assert_mem_eq(&usual, &named, sizeof usual);
}
