/* Straight pool: every branch of its rules beside rulings written down, and new racks. */
#include "game_support.h"

typedef struct straight_case {
  const char *what;
  uint32_t in_play;
  int first, cushions;
  uint32_t down, off;
  int call, pocket;
  /* before: points of pots, points lost, fouls in a row */
  int pots, lost, fouls;
  /* after, of the one who played */
  int outcome, leave, foul;
  uint32_t spot;
  int pots_after, lost_after, fouls_after;
} straight_case;

static const straight_case straight[] = {
    {"a called ball", 0xffff, 3, 0, 8, 0, 3, 2, 4, 1, 2, KEEP, AFTER, 0, 0, 5, 1, 0},
    {"with two others", 0xffff, 3, 0, 0x308, 0, 3, 2, 4, 0, 0, KEEP, AFTER, 0, 0, 7, 0, 0},
    {"by another ball first", 0xffff, 9, 0, 8, 0, 3, 2, 0, 0, 0, KEEP, AFTER, 0, 0, 1, 0, 0},
    {"in another pocket", 0xffff, 3, 0, 8, 0, 3, 1, 4, 0, 1, PASS, AFTER, 0, 8, 4, 0, 0},
    {"another ball", 0xffff, 3, 0, 0x10, 0, 3, 2, 4, 0, 0, PASS, AFTER, 0, 0x10, 4, 0, 0},
    {"a safety that pots", 0xffff, 3, 0, 0x10, 0, NONE, -1, 4, 0, 0, PASS, AFTER, 0, 0x10, 4, 0, 0},
    {"a safety to a cushion", 0xffff, 3, 1, 0, 0, NONE, -1, 4, 0, 2, PASS, AFTER, 0, 0, 4, 0, 0},
    {"no cushion", 0xffff, 3, 0, 0, 0, 3, 2, 4, 0, 0, PASS, AFTER, CUSHION, 0, 4, 1, 1},
    {"no ball met", 0xffff, -1, 0, 0, 0, 3, 2, 4, 3, 1, PASS, AFTER, NO_BALL, 0, 4, 4, 2},
    {"the cue ball falls", 0xffff, 3, 0, 1, 0, 3, 2, 4, 0, 0, PASS, KITCHEN, CUE_BALL, 0, 4, 1, 1},
    {"with the called", 0xffff, 3, 0, 9, 0, 3, 2, 4, 0, 0, PASS, KITCHEN, CUE_BALL, 8, 4, 1, 1},
    {"the cue ball is off", 0xffff, 3, 1, 0, 1, 3, 2, 4, 0, 0, PASS, KITCHEN, CUE_BALL, 0, 4, 1, 1},
    {"a ball is off", 0xffff, 3, 1, 0, 0x10, 3, 2, 4, 0, 0, PASS, AFTER, OFF, 0x10, 4, 1, 1},
    {"the called one falls", 0xffff, 3, 1, 8, 0x10, 3, 2, 4, 0, 0, PASS, AFTER, OFF, 0x18, 4, 1, 1},
    {"a third foul", 0xffff, -1, 0, 0, 0, 3, 2, 4, 2, 2, KEEP, KITCHEN, NO_BALL, 0xfffe, 4, 18, 0},
    {"the fourteenth ball", 7, 1, 0, 2, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0xfffa, 41, 0, 0},
    {"the last two at once", 7, 1, 0, 6, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0xfffe, 42, 0, 0},
    {"one of two, not called", 7, 1, 0, 2, 0, 2, 2, 40, 0, 0, PASS, AFTER, 0, 2, 40, 0, 0},
    {"one of three", 0x000f, 1, 0, 2, 0, 1, 2, 40, 0, 0, KEEP, AFTER, 0, 0, 41, 0, 0},
    {"the last point", 0xffff, 3, 0, 8, 0, 3, 2, 99, 0, 0, WIN, AFTER, 0, 0, 100, 0, 0},
    {"points lost do not count", 0xffff, 3, 0, 8, 0, 3, 2, 99, 1, 0, KEEP, AFTER, 0, 0, 100, 1, 0},
    {"more than enough", 0xffff, 3, 0, 0x38, 0, 3, 2, 99, 1, 0, WIN, AFTER, 0, 0, 102, 1, 0},
};

TEST(straight_rulings) {
  for (size_t k = 0; k < sizeof straight / sizeof straight[0]; k++) {
    const straight_case *c = &straight[k];
    const carom_facts facts = facts_of(c->first, c->cushions, c->down, c->off);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    ck_assert_int_eq(of.state.target, 100);
    /* those of the other are told apart */
    of.state = (carom_rules_state){.score = {c->pots, 51},
                                   .lost = {c->lost, 7},
                                   .fouls = {c->fouls, 1},
                                   .target = of.state.target};
    const carom_turn turn =
        of.judge(&of.state, c->in_play, 0, &facts, (carom_call){c->call, c->pocket});
    const bool gives = c->outcome == PASS;
    ruled(c->what, &turn, c->outcome, c->leave, c->foul, c->spot);
    ck_assert_msg(of.state.score[gives] == c->pots_after && of.state.score[!gives] == 51 &&
                      of.state.lost[gives] == c->lost_after && of.state.lost[!gives] == 7,
                  "%s: points", c->what);
    ck_assert_msg(of.state.fouls[gives] == c->fouls_after && of.state.fouls[!gives] == 1,
                  "%s: fouls", c->what);
    ck_assert_msg(turn.points == (double)(c->pots_after - c->pots), "%s: points", c->what);
    ck_assert_int_eq(of.state.opening, c->fouls == 2 && c->lost_after == c->lost + 16);
  }
}

/* The opening break: which are legal, what others cost, and that they may be asked for again. */
TEST(straight_breaks) {
  static const struct {
    const char *what;
    int cue_cushions, cue_before, driven;
    uint32_t down;
    int call, outcome, leave, foul, lost;
    uint32_t spot;
    bool again;
  } given[] = {
      {"two balls and the cue ball", 1, 0, 2, 0, NONE, PASS, AFTER, 0, 0, 0, false},
      {"one ball and the cue ball", 1, 0, 1, 0, NONE, PASS, AFTER, BREAK, 2, 0, true},
      {"without the cue ball", 0, 0, 5, 0, NONE, PASS, AFTER, BREAK, 2, 0, true},
      {"the cue ball before the rack only", 1, 1, 5, 0, NONE, PASS, AFTER, BREAK, 2, 0, true},
      {"a called ball", 0, 0, 0, 0x8, 3, KEEP, AFTER, 0, 0, 0, false},
      {"a ball that was not called", 0, 0, 1, 0x8, 4, PASS, AFTER, BREAK, 2, 0x8, true},
      {"the same, of a legal break", 1, 0, 3, 0x8, 4, PASS, AFTER, 0, 0, 0x8, false},
      {"one ball, and one that falls", 1, 0, 1, 0x8, 4, PASS, AFTER, 0, 0, 0x8, false},
      {"the cue ball falls, legal else", 1, 0, 3, 0x1, NONE, PASS, KITCHEN, CUE_BALL, 1, 0, false},
      {"the same, without a cushion", 0, 0, 2, 0x1, NONE, PASS, KITCHEN, CUE_BALL, 1, 0, false},
      {"the cue ball falls, bad too", 0, 0, 1, 0x1, NONE, PASS, KITCHEN, CUE_BALL, 2, 0, true},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts facts = facts_of(1, 4, given[k].down, 0);
    facts.cushions[0] = given[k].cue_cushions;
    facts.cushions_before[0] = given[k].cue_before;
    for (int i = 1; i <= given[k].driven; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    of.state.opening = 1;
    const carom_turn turn = of.judge(&of.state, 0xffff, 0, &facts, (carom_call){given[k].call, 2});
    ruled(given[k].what, &turn, given[k].outcome, given[k].leave, given[k].foul, given[k].spot);
    ck_assert_msg(of.state.lost[1] == given[k].lost && of.state.opening == 0, "%s", given[k].what);
    ck_assert_int_eq(of.state.may, given[k].again ? CAROM_MAY_PASS : 0);
    /* a bad break is no foul in a row */
    ck_assert_int_eq(of.state.fouls[1], given[k].lost == 1);
    if (!given[k].again)
      continue;

    /* the other has it played again: he who broke breaks once more */
    const carom_facts none = {.first = {-1, -1}};
    carom_plan_rules after = of;
    const carom_turn asked =
        after.judge(&after.state, 0xffff, 0, &none, (carom_call){CAROM_CALL_PASS, -1});
    ck_assert(asked.outcome == CAROM_TURN_PASS && asked.foul == 0 &&
              asked.leave == CAROM_LEAVE_KITCHEN);
    ck_assert(asked.spot == 0xfffe && after.state.opening == 1 && after.state.lost[0] == 2);
    ck_assert_int_eq(after.state.may, 0);
  }
}

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
  } given[] = {
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
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const int last = 9, count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 1 | 1u << 9);
    put(0, given[k].cue[0], given[k].cue[1]);
    put(last, given[k].last[0], given[k].last[1]);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
    carom_turn turn = {.outcome = CAROM_TURN_KEEP, .spot = 0xfffe & ~(1u << last)};
    ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, count, &turn), CAROM_OK);
    const double *at[2] = {given[k].cue, given[k].last};
    const int goes[2] = {given[k].cue_goes, given[k].last_goes}, who[2] = {0, last};
    for (int n = 0; n < 2; n++) {
      const bool there[] = {[STAYS] = is_at(who[n], at[n][0], at[n][1]),
                            [HEAD] = is_at(who[n], x, head_y),
                            [CENTRE] = is_at(who[n], x, 0.5 * l),
                            [IN_HAND] = balls[0].state.label == CAROM_BALL_POCKETED,
                            [RACKED] = turn.spot == 0xfffe};
      ck_assert_msg(there[goes[n]], "%s: ball %d", given[k].what, who[n]);
    }
    ck_assert_msg((turn.leave == CAROM_LEAVE_KITCHEN) == (goes[0] == IN_HAND), "%s", given[k].what);

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
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
  carom_turn turn = {.outcome = CAROM_TURN_KEEP, .spot = 0xfffe};
  ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(0, 0.3, 1.0) && turn.leave == CAROM_LEAVE_AFTER && is_at(1, x, 0.75 * l));
  /* a ball that comes back alone goes to the foot spot */
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 3);
  put(1, 0.2, 0.3);
  turn = (carom_turn){.outcome = CAROM_TURN_PASS, .spot = 0x20};
  ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(5, x, 0.75 * l));
}
