/* Straight pool: new racks. situations.txt has its rulings. */
#include "game_support.h"

/* New racks, by where the cue ball and the fifteenth lie: those stay, or go to the head spot, to
 * the centre, into hand. */
TEST(straight_racks) {
  enum { STAYS, HEAD, CENTRE, IN_HAND, RACKED };
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  const double w = table.width, l = table.length, x = 0.5 * w;
  const double rack_y = 0.75 * l + 0.08, head_y = 0.25 * l;
  const struct {
    const char *what;
    double last[2], cue[2];
    int last_goes, cue_goes;
  } cases[] = {
      {"none in the rack", {0.2, 1.5}, {0.3, 1.0}, STAYS, STAYS},
      {"the fifteenth in it", {x, rack_y}, {0.3, 1.0}, HEAD, STAYS},
      {"the fifteenth in it, the cue ball on the head spot",
       {x, rack_y},
       {x + 0.01, head_y},
       CENTRE,
       STAYS},
      {"both in it", {x - 0.06, rack_y + 0.06}, {x, rack_y}, RACKED, IN_HAND},
      {"the cue ball in it", {0.2, 1.5}, {x, rack_y}, STAYS, IN_HAND},
      {"the cue ball in it, the fifteenth behind the head string",
       {0.2, 0.3},
       {x, rack_y},
       STAYS,
       HEAD},
      {"the cue ball in it, the fifteenth on the head spot",
       {x, head_y + 0.01},
       {x, rack_y},
       STAYS,
       CENTRE},
      {"the cue ball on the front place", {0.2, 1.5}, {x, 0.75 * l}, STAYS, IN_HAND},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const int last = 9, count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1 | 1u << 9);
    put(0, cases[k].cue[0], cases[k].cue[1]);
    put(last, cases[k].last[0], cases[k].last[1]);
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    carom_turn turn = {.outcome = CAROM_TURN_KEEP, .spot = 0xfffe & ~(1u << last)};
    ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                     CAROM_OK);
    const double *place[2] = {cases[k].cue, cases[k].last};
    const int goes[2] = {cases[k].cue_goes, cases[k].last_goes}, moved[2] = {0, last};
    for (int n = 0; n < 2; n++) {
      const bool is_right[] = {[STAYS] = is_at(moved[n], place[n][0], place[n][1]),
                               [HEAD] = is_at(moved[n], x, head_y),
                               [CENTRE] = is_at(moved[n], x, 0.5 * l),
                               [IN_HAND] = balls[0].state.label == CAROM_BALL_POCKETED,
                               [RACKED] = turn.spot == 0xfffe};
      ck_assert_msg(is_right[goes[n]], "%s: ball %d", cases[k].what, moved[n]);
    }
    ck_assert_msg((turn.leave == CAROM_LEAVE_KITCHEN) == (goes[0] == IN_HAND), "%s", cases[k].what);

    /* all lie, close together, and the front place is taken by the fifteenth alone */
    int front = 0, racked = 0;
    for (int i = 1; i < 16; i++) {
      const double *r = balls[i].state.r;
      ck_assert(balls[i].state.label == CAROM_BALL_STATIONARY);
      front += fabs(r[1] - 0.75 * l) < 1e-9;
      racked += r[1] > 0.75 * l - 1e-9 && r[1] < 0.75 * l + 0.22 && fabs(r[0] - x) < 0.13;
    }
    ck_assert_int_eq(front, goes[1] == RACKED);
    ck_assert_int_eq(racked, goes[1] == RACKED ? 15 : 14);
    if (goes[0] != IN_HAND)
      ck_assert_int_eq(carom_shot_check(&table, balls, count, NULL, NULL, NULL), CAROM_OK);
  }

  /* the last two at once: all 15, the cue ball where it is */
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1);
  put(0, 0.3, 1.0);
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
  carom_turn turn = {.outcome = CAROM_TURN_KEEP, .spot = 0xfffe};
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_OK);
  ck_assert(is_at(0, 0.3, 1.0) && turn.leave == CAROM_LEAVE_AFTER && is_at(1, x, 0.75 * l));
  /* a ball that comes back alone goes to the foot spot */
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 3);
  put(1, 0.2, 0.3);
  turn = (carom_turn){.outcome = CAROM_TURN_PASS, .spot = 0x20};
  ck_assert_int_eq(carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn),
                   CAROM_OK);
  ck_assert(is_at(5, x, 0.75 * l));
}
