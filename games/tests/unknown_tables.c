/* Players who do not know the table. */
#include "plan_support.h"

/* A straight pot into the pocket at the origin; or a bank there, off the foot rail. */
static carom_cue put_pot(bool bank) {
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  player = carom_player_of(0.3);
  place_ball(8, bank ? 0.9 : 0.3, bank ? 1.2 : 0.3);
  place_ball(0, bank ? 1.0 : 0.6, bank ? 0.75 : 0.62);
  carom_pot pot = {.ball = 8, .vias = bank, .via = {{CAROM_PART_RAIL, 0}}};
  for (int p = 0; p < table.pockets; p++)
    if (table.pocket[p].centre[0] + table.pocket[p].centre[1] < 0.2)
      pot.pocket = p;
  for (int r = 0; r < table.rails; r++)
    if (table.rail[r].p[1] > 2.5 && fabs(table.rail[r].p[0] - table.rail[r].q[0]) > 1.0)
      pot.via[0].index = r;
  carom_cue stroke = cue;
  stroke.speed = bank ? 4.0 : 1.5;
  stroke.b = 0.25;
  expect_ok(carom_aim(&table, balls, BALLS, &shot_options, &pot, &stroke));
  ck_assert_msg(pot.outcome == CAROM_POT_FALLS, "%s: %d", bank ? "bank" : "pot", pot.outcome);
  options.shots = 9600;
  return stroke;
}

static carom_plan_stroke tried(const carom_cue *stroke, double unsure) {
  carom_plan_stroke c;
  options.unsure = unsure;
  make_memory();
  expect_ok(carom_plan_try(&job, stroke, 1, &c));
  edge_free(&memory);
  return c;
}

/* The less of the table a player knows, the less often a bank comes off; a pot near by comes off as
 * often. Rails with their own numbers are as little known as those with the numbers of the
 * balls. */
TEST(tables_that_are_not_known) {
  static const double unsure[] = {0.0, 0.1, 0.3, 1.0};
  double keep[2][4];
  for (int bank = 0; bank < 2; bank++)
    for (int k = 0; k < 4; k++) {
      const carom_cue stroke = put_pot(bank);
      const carom_plan_stroke c = tried(&stroke, unsure[k]);
      keep[bank][k] = c.keep;

      /* facings and jaws have their own numbers already */
      for (int r = 0; r < table.rails; r++) {
        if (table.rail[r].restitution > 0.0)
          continue;
        table.rail[r].restitution = balls[0].kind.restitution_cushion;
        table.rail[r].mu_cushion = balls[0].kind.mu_cushion;
      }
      const carom_plan_stroke known = tried(&stroke, unsure[k]);
      ck_assert_mem_eq(&known, &c, sizeof c);
    }
  printf("kept with all, much, some and little known: a pot %.2f %.2f %.2f %.2f, a bank %.2f %.2f "
         "%.2f %.2f\n",
         keep[0][0], keep[0][1], keep[0][2], keep[0][3], keep[1][0], keep[1][1], keep[1][2],
         keep[1][3]);
  for (int k = 1; k < 4; k++) {
    ck_assert_double_gt(keep[0][k], keep[0][0] - 0.02);
    ck_assert_double_lt(keep[1][k], keep[1][k - 1] - (k > 1 ? 0.03 : 0.0));
  }
}
