/* Arguments of plans that are in error. */
#include "carom_coach.h"
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
    found = 7;                                                      \
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), expected); \
    ck_assert_int_eq(found, 0);                                     \
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
  REFUSED(rules.rack, CAROM_RACK_EIGHTONSPOT + 1, CAROM_ERROR_OPTIONS);
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

/* A rejected number of a job is named, with its value and its range. */
#define NAMED(field, wrong, words)                                             \
  do {                                                                         \
    make_layout(5, 6);                                                         \
    make_memory();                                                             \
    field = wrong;                                                             \
    char text[200], cut[8];                                                    \
    const size_t size = carom_plan_fault(&job, text, sizeof text);             \
    ck_assert_str_eq(text, words);                                             \
    ck_assert_uint_eq(size, strlen(words));                                    \
    ck_assert_uint_eq(carom_plan_fault(&job, cut, sizeof cut), size);          \
    ck_assert_mem_eq(cut, text, sizeof cut - 1);                               \
    ck_assert_uint_eq(carom_plan_fault(&job, NULL, 0), size);                  \
    carom_plan_stroke best;                                                    \
    int found;                                                                 \
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_ERROR_OPTIONS); \
    edge_free(&memory);                                                        \
  } while (0)

TEST(faults_of_plans_are_named) {
  NAMED(options.shots, 60, "options->shots is 60; it must be 0, or 100 to 1e6");
  NAMED(options.scan, 0.95, "options->scan is 0.95; it must be at most 0.9");
  NAMED(options.level, 2, "options->level is 2; it must be 0 to 1");
  NAMED(options.slice, -1, "options->slice is -1; it must be 0 or more");
  NAMED(options.reserved[0], 1, "options->reserved[0] must be 0");
  NAMED(player.phi, -0.1, "player->phi is -0.1; it must be 0 to 1000, in degrees");
  NAMED(player.eye, 0.5, "player->eye is 0.5; it must be at most 0.01, in m");
  NAMED(player.shots, 60, "player->shots is 60; it must be 0, or 100 to 2000");
  NAMED(player.speed_least = 2.0;
        player.speed_most, 1.0,
        "player->speed_most is 1; it must be 0, or at least speed_least, which is 2, in m/s");
  NAMED(rules.race, 9, "rules->race must be one of carom_race");
  NAMED(rules.judge, NULL, "rules->on, rules->judge and rules->left must be functions, not NULL");
  NAMED(job.leave, -1, "job->leave must be one of carom_leave");
  NAMED(job.reserved[0], 1, "job->reserved[0] must be 0");
  char text[8] = "before";
  make_layout(5, 6);
  ck_assert_uint_eq(carom_plan_fault(&job, text, sizeof text), 0);
  ck_assert_str_eq(text, "");
  ck_assert_uint_eq(carom_plan_fault(NULL, text, sizeof text), 0);
}

/* Numbers of what was found are set by every call, also by one that is rejected. */
TEST(counts_are_set_with_errors) {
  carom_plan_stroke best;
  carom_sequence_stroke strokes;
  int found[5] = {7, 7, 7, 7, 7};
  ck_assert_int_lt(carom_plan(NULL, &best, 1, &found[0]), 0);
  ck_assert_int_lt(carom_plan_hand(NULL, NULL, NULL, &best, 1, &found[1]), 0);
  ck_assert_int_lt(carom_plan_continue(NULL, &best, 1, &found[2]), 0);
  ck_assert_int_lt(carom_sequence(NULL, 0, 0.1, &strokes, 1, &found[3]), 0);
  ck_assert_int_lt(carom_sequence_continue(NULL, &found[4]), 0);
  for (int k = 0; k < 5; k++)
    ck_assert_int_eq(found[k], 0);
  carom_shot_way way;
  carom_ways_result result = {.ways = 7, .left_out = 7};
  ck_assert_int_lt(carom_ways(NULL, &way, 1, &result), 0);
  ck_assert(result.ways == 0 && result.left_out == 0);
}
