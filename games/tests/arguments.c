/* Arguments of plans that are in error. */
#include "plan_support.h"

static uint32_t none_is_on(const carom_rules_state *state, uint32_t in_play) {
  (void)state;
  (void)in_play;
  return 0;
}

#define REFUSED(field, wrong, expected)                             \
  do {                                                              \
    make_layout(5, 6);                                              \
    make_memory();                                                  \
    field = wrong;                                                  \
    memset(&best, 0x55, sizeof best);                               \
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), expected); \
    for (size_t byte = 0; byte < sizeof best; byte++)               \
      ck_assert_int_eq(((const unsigned char *)&best)[byte], 0x55); \
    edge_free(&memory);                                             \
  } while (0)

TEST(arguments_of_plans) {
  carom_plan_stroke best;
  int found;
  REFUSED(job.table, NULL, CAROM_ERROR_NULL);
  REFUSED(job.player, NULL, CAROM_ERROR_NULL);
  REFUSED(job.rules, NULL, CAROM_ERROR_NULL);
  REFUSED(job.memory, NULL, CAROM_ERROR_NULL);
  REFUSED(job.memory_size, job.memory_size - 1, CAROM_ERROR_NULL);
  REFUSED(job.count, 1, CAROM_ERROR_BALLS);
  REFUSED(job.count, 33, CAROM_ERROR_BALLS);
  REFUSED(job.reserved[0], 1, CAROM_ERROR_OPTIONS);
  REFUSED(job.leave, -1, CAROM_ERROR_OPTIONS);
  REFUSED(job.leave, CAROM_LEAVE_BAULK + 1, CAROM_ERROR_OPTIONS);
  REFUSED(options.shots, -1, CAROM_ERROR_OPTIONS);
  REFUSED(options.shots, 1000001, CAROM_ERROR_OPTIONS);
  REFUSED(options.scan, 0.91, CAROM_ERROR_OPTIONS);
  REFUSED(options.scan, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(options.threads, -2, CAROM_ERROR_OPTIONS);
  REFUSED(options.level, 2, CAROM_ERROR_OPTIONS);
  REFUSED(options.chance_me, 1.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.slice, -1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, -0.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, 1.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, 0.5, CAROM_ERROR_NULL); /* for which there is too little memory */
  REFUSED(options.reserved[0], 1, CAROM_ERROR_OPTIONS);
  REFUSED(player.phi, -0.1, CAROM_ERROR_OPTIONS);
  REFUSED(player.speed, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(player.speed, 1001.0, CAROM_ERROR_OPTIONS);
  REFUSED(player.tip_most, 1.5, CAROM_ERROR_OPTIONS);
  REFUSED(rules.judge, NULL, CAROM_ERROR_OPTIONS);
  REFUSED(rules.race, 4, CAROM_ERROR_OPTIONS);
  REFUSED(rules.rack, 12, CAROM_ERROR_OPTIONS);
  REFUSED(rules.reserved[2], 1, CAROM_ERROR_OPTIONS);
  REFUSED(shot_options.unused, 1, CAROM_ERROR_SHOT_OPTIONS);
  REFUSED(balls[1].state, balls[0].state, CAROM_ERROR_OVERLAP);
  REFUSED(cue.ball, BALLS, CAROM_ERROR_CUE_BALL);
  REFUSED(cue.mass, NAN, CAROM_ERROR_CUE_MASS);
  REFUSED(cue.speed = 0.0; cue.mass, NAN, CAROM_ERROR_CUE_MASS);
  REFUSED(balls[0].state.label, CAROM_BALL_POCKETED, CAROM_ERROR_CUE_BALL_OUT);
  REFUSED(balls[3].state.v[0], 0.1, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[0].state.w[2], -1.0, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[3].state.r[2], 0.2, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[8].state.label, CAROM_BALL_POCKETED, CAROM_ERROR_GAME_OVER);
  REFUSED(rules.on, none_is_on, CAROM_ERROR_GAME_OVER);
  make_layout(5, 6);
  make_memory();

  /* the stroke of the job's cue is not read, and those to be tried are */
  carom_plan_stroke same;
  expect_ok(carom_plan(&job, &same, 1, &found));
  cue.phi = NAN;
  cue.speed = 0.0;
  cue.theta = 30.0;
  cue.a = cue.b = 0.2;
  expect_ok(carom_plan(&job, &best, 1, &found));
  ck_assert_mem_eq(&best, &same, sizeof best);
  ck_assert_int_eq(carom_plan_try(&job, &cue, 1, &best), CAROM_ERROR_CUE_PHI);
  const double low[2] = {0.9, 0.9}, high[2] = {0.5, 2.0}, no[2] = {NAN, 0.0};
  ck_assert_int_eq(carom_plan_hand(&job, low, high, &best, 1, &found), CAROM_ERROR_OFF_TABLE);
  ck_assert_int_eq(carom_plan_hand(&job, no, NULL, &best, 1, &found), CAROM_ERROR_OFF_TABLE);
  const double point[2] = {0.5, 0.6}; /* a range of one position */
  expect_ok(carom_plan_hand(&job, point, point, &best, 1, &found));
  ck_assert(best.place[0] == point[0] && best.place[1] == point[1]);
  balls[0].state.v[0] = 1.0; /* in hand, it may move */
  expect_ok(carom_plan_hand(&job, NULL, NULL, &best, 1, &found));
  edge_free(&memory);
  ck_assert_int_eq(carom_plan(&job, NULL, 1, &found), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_plan(NULL, &best, 1, &found), CAROM_ERROR_NULL);
  ck_assert_uint_eq(carom_plan_memory(&(carom_plan_options){.shots = 1}), 0);
}
