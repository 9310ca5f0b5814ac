/* The cushion of a table by three banks. */
#include "shot_support.h"

static carom_table table;
static carom_ball_kind usual;

static void set_up(void) {
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  usual = carom_ball_kind_of(CAROM_GAME_POOL);
}

/* Without readings the banks return as those of the ball, away from the pockets. */
TEST(usual_table) {
  carom_calibration told;
  static const carom_table_kind kinds[] = {CAROM_TABLE_POOL_7FT, CAROM_TABLE_POOL_8FT,
                                           CAROM_TABLE_POOL_9FT};
  set_up();
  for (int t = 0; t < 3; t++) {
    carom_table_make(kinds[t], &table);
    expect_ok(carom_calibrate(&table, &usual, NULL, &told));
    ck_assert_double_eq(told.restitution, usual.restitution_cushion);
    ck_assert_double_eq(told.friction, usual.mu_cushion);
    for (int k = 0; k < CAROM_BANKS; k++)
      ck_assert(told.comes_back[k] > 4.5 && told.comes_back[k] < 7.4);
  }
}

/* Conditions move a rolling ball's way and the banks as their sources say, and nothing else. */
TEST(conditions) {
  carom_calibration told[CAROM_CONDITION_DEAD_CUSHION + 1];
  set_up();
  for (int k = 0; carom_word(CAROM_WORDS_CONDITION, k) != NULL; k++) {
    carom_ball_kind kind = usual;
    ck_assert_int_eq(carom_condition_give((carom_condition)k, &kind), 1);
    expect_ok(carom_calibrate(&table, &kind, NULL, &told[k]));
    const bool is_cloth = k <= CAROM_CONDITION_FAST_CLOTH;
    if (is_cloth) {
      ck_assert_double_eq(kind.mu_roll, usual.mu_roll + 0.005 * (1 - k));
      kind.mu_roll = usual.mu_roll;
    }
    ck_assert_int_eq(memcmp(&kind, &usual, sizeof kind) == 0, is_cloth);
    kind.restitution_cushion = usual.restitution_cushion;
    kind.mu_cushion = usual.mu_cushion;
    ck_assert_mem_eq(&kind, &usual, sizeof kind);
  }
  const double *before = told[CAROM_CONDITION_MEDIUM_CLOTH].comes_back;
  for (int k = 0; k < CAROM_BANKS; k++) {
    const bool rolls = k != 2;
    ck_assert(told[CAROM_CONDITION_HUMID_CUSHION].comes_back[k] < before[k]);
    ck_assert(!rolls || told[CAROM_CONDITION_OLD_CUSHION].comes_back[k] < before[k]);
    ck_assert(!rolls || told[CAROM_CONDITION_NEW_CUSHION].comes_back[k] > before[k]);
  }
  carom_ball_kind kind = usual;
  ck_assert_int_eq(carom_condition_give((carom_condition)-1, &kind), 0);
  ck_assert_int_eq(carom_condition_give(CAROM_CONDITION_FAST_CLOTH, NULL), 0);
  ck_assert_mem_eq(&kind, &usual, sizeof kind);
}

/* The readings of a table with other numbers tell them: nearer than those of the ball, by the two
 * deviations that are told, in the mean of 60 tables. */
TEST(other_tables) {
  random_source random = {test_seed()};
  double before = 0.0, after = 0.0, deviations = 0.0;
  int count = 0;
  set_up();
  for (int n = 0; n < 60; n++) {
    carom_ball_kind kind = usual;
    carom_calibration truth, found;
    kind.restitution_cushion = random_between(&random, 0.74, 0.86);
    kind.mu_cushion = random_between(&random, 0.2, 0.36);
    const carom_status status = carom_calibrate(&table, &kind, NULL, &truth);
    expect_ok(status);
    if (truth.comes_back[1] > 7.5) /* in the corner pocket */
      continue;
    expect_ok(carom_calibrate(&table, &usual, truth.comes_back, &found));
    ck_assert(found.misfit < 1.0);
    ck_assert(found.restitution_error < 0.05 && found.friction_error < 0.06);

    /* in units of what is known before, and of what is told */
    const double e = found.restitution - kind.restitution_cushion,
                 mu = found.friction - kind.mu_cushion;
    before += pow((usual.restitution_cushion - kind.restitution_cushion) / 0.05, 2) +
              pow((usual.mu_cushion - kind.mu_cushion) / 0.06, 2);
    after += pow(e / 0.05, 2) + pow(mu / 0.06, 2);
    deviations += pow(e / found.restitution_error, 2) + pow(mu / found.friction_error, 2);
    count++;
  }
  ck_assert_int_gt(count, 40);
  ck_assert_msg(after < 0.6 * before, "%g after %g", after, before);
  ck_assert(deviations < 2.0 * count);
}
