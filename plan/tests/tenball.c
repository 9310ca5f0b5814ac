/* Ten-ball: each branch of its rules beside rulings written down, its choices, and whole games. */
#include "carom_match.h"
#include "game_support.h"

enum { IN_HAND = CAROM_LEAVE_HAND, PUSH = CAROM_MAY_PUSH, TEN = 1 << 10 };
enum { BREAKS = 1, PUSHES = 2 };

typedef struct ten_case {
  const char *what;
  uint32_t in_play;
  int first, driven;  /* what the cue ball met, and how many balls met cushions */
  uint32_t down, off; /* what falls into pocket 2, or leaves the table */
  int call, pocket;   /* what is called */
  int stroke, fouls;  /* BREAKS, PUSHES or 0; the fouls of the player */
  int outcome, leave, foul;
  uint32_t spot;
  int may, fouls_after;
} ten_case;

/* clang-format off */
static const ten_case cases[] = {
    {"the lowest ball, called", 0x7ff, 1, 0, 2, 0, 1, 2, 0, 1, KEEP, AFTER, 0, 0, 0, 0},
    {"a combination, called", 0x7ff, 1, 0, 0x20, 0, 5, 2, 0, 0, KEEP, AFTER, 0, 0, 0, 0},
    {"one more with it stays down", 0x7ff, 1, 0, 0x22, 0, 1, 2, 0, 0, KEEP, AFTER, 0, 0, 0, 0},
    {"the ten with it comes back", 0x7ff, 1, 0, TEN | 2, 0, 1, 2, 0, 0, KEEP, AFTER, 0, TEN, 0, 0},
    {"the ten, called too early", 0x7ff, 1, 0, TEN, 0, 10, 2, 0, 0, KEEP, AFTER, 0, TEN, 0, 0},
    {"the ten beside the nine", 0x601, 9, 0, TEN, 0, 10, 2, 0, 0, KEEP, AFTER, 0, TEN, 0, 0},
    {"the ten at last", 0x401, 10, 0, TEN, 0, 10, 2, 0, 2, WIN, AFTER, 0, 0, 0, 0},
    {"the ten in another pocket", 0x401, 10, 0, TEN, 0, 10, 3, 0, 0, PASS, AFTER, 0, TEN, MAY, 0},
    {"the ten with the cue ball",
     0x401, 10, 0, TEN | 1, 0, 10, 2, 0, 0, PASS, IN_HAND, CUE_BALL, TEN, 0, 1},
    {"the eight, where it is the last", 0x101, 8, 0, 0x100, 0, 8, 2, 0, 0, WIN, AFTER, 0, 0, 0, 0},
    {"another ball than the called one", 0x7ff, 1, 0, 8, 0, 1, 2, 0, 1, PASS, AFTER, 0, 0, MAY, 0},
    {"another pocket", 0x7ff, 1, 0, 2, 0, 1, 4, 0, 0, PASS, AFTER, 0, 0, MAY, 0},
    {"a ball that falls on a safety", 0x7ff, 1, 0, 2, 0, NONE, -1, 0, 0, PASS, AFTER, 0, 0, MAY, 0},
    {"a miss", 0x7ff, 1, 1, 0, 0, 1, 2, 0, 2, PASS, AFTER, 0, 0, 0, 0},
    {"not the lowest first", 0x7ff, 2, 1, 4, 0, 2, 2, 0, 0, PASS, IN_HAND, FIRST, 0, 0, 1},
    {"no cushion", 0x7ff, 1, 0, 0, 0, 1, 2, 0, 1, PASS, IN_HAND, CUSHION, 0, 0, 2},
    {"the ten off the table", 0x7ff, 1, 1, 0, TEN, 1, 2, 0, 0, PASS, IN_HAND, OFF, TEN, 0, 1},
    {"another ball off the table", 0x7ff, 1, 1, 2, 8, 1, 2, 0, 0, PASS, IN_HAND, OFF, 0, 0, 1},
    {"a third foul", 0x7ff, NONE, 0, 0, 0, NONE, -1, 0, 2, LOSE, IN_HAND, NO_BALL, 0, 0, 0},
    {"a break that pots", 0x7ff, 1, 0, 0x10, 0, NONE, -1, BREAKS, 0, KEEP, AFTER, 0, 0, PUSH, 0},
    {"a break that pots the ten",
     0x7ff, 1, 0, TEN, 0, NONE, -1, BREAKS, 0, KEEP, AFTER, 0, TEN, PUSH, 0},
    {"a break of four", 0x7ff, 1, 4, 0, 0, NONE, -1, BREAKS, 0, PASS, AFTER, 0, 0, PUSH, 0},
    {"a break of three", 0x7ff, 1, 3, 0, 0, NONE, -1, BREAKS, 0, PASS, IN_HAND, BREAK, 0, 0, 1},
    {"a break that scratches",
     0x7ff, 1, 4, TEN | 1, 0, NONE, -1, BREAKS, 0, PASS, IN_HAND, CUE_BALL, TEN, 0, 1},
    {"a push-out that meets none",
     0x7ff, NONE, 0, 0, 0, NONE, -1, PUSHES, 1, PASS, AFTER, 0, 0, MAY, 1},
    {"a push-out that pots the ten",
     0x7ff, 10, 0, TEN, 0, NONE, -1, PUSHES, 0, PASS, AFTER, 0, TEN, MAY, 0},
    {"a push-out that scratches",
     0x7ff, 5, 0, 1, 0, NONE, -1, PUSHES, 0, PASS, IN_HAND, CUE_BALL, 0, 0, 1},
};
/* clang-format on */

TEST(tenball_rulings) {
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const ten_case *c = &cases[k];
    carom_facts facts = facts_of(c->first, c->driven, c->down, c->off);
    for (int i = 1; i <= c->driven; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_TENBALL);
    of.state = (carom_rules_state){.opening = c->stroke == BREAKS,
                                   .may = c->stroke == PUSHES ? PUSH : 0,
                                   .fouls = {c->fouls, 1}};
    const carom_call call = {c->stroke == PUSHES ? CAROM_CALL_PUSH : c->call, c->pocket};
    const carom_turn turn = of.judge(&of.state, c->in_play, 0, &facts, call);
    ruled(c->what, &turn, c->outcome, c->leave, c->foul, c->spot);

    /* the state is that of the player who comes next; a game that is lost has been given too */
    const bool gives = c->outcome == PASS || c->outcome == LOSE;
    ck_assert_msg(of.state.may == c->may && of.state.opening == 0 &&
                      of.state.fouls[gives] == c->fouls_after && of.state.fouls[!gives] == 1,
                  "%s: may %d, fouls %d", c->what, of.state.may, of.state.fouls[gives]);

    /* who may do so hands the table back, once */
    if (c->may != MAY)
      continue;
    const carom_facts none = facts_of(NONE, 0, 0, 0);
    const carom_turn back = of.judge(&of.state, 0x7ff, 0, &none, (carom_call){CAROM_CALL_PASS, -1});
    ruled(c->what, &back, PASS, AFTER, 0, 0);
    ck_assert(of.state.may == 0 && of.state.fouls[0] == c->fouls_after);
  }
}

/* A match begins with ten balls and the ten in the middle, and any ball may be called. */
TEST(a_match_of_tenball) {
  static carom_match match;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ck_assert_int_eq(carom_match_begin(&match, CAROM_RULES_TENBALL, &table, 1, 0), CAROM_OK);
  const carom_shot_ball *lies = match.record.balls;
  const double pitch = 2.0 * lies[1].kind.radius + 1e-4;
  ck_assert(match.record.count == 11 && match.on == 2 && match.rules.state.opening == 1);
  ck_assert(fabs(lies[1].state.r[1] - 0.75 * table.length) < 1e-4);
  ck_assert(fabs(lies[10].state.r[0] - 0.5 * table.width) < 1e-4 &&
            fabs(lies[10].state.r[1] - 0.75 * table.length - 2.0 * pitch * sqrt(0.75)) < 1e-4);
  ck_assert_int_eq(carom_match_place(&match, 0, 0.6, 0.6), CAROM_OK);
  ck_assert_int_eq(carom_match_call(&match, 0, (carom_call){7, 1}), CAROM_OK);
  ck_assert_int_eq(carom_match_call(&match, 0, (carom_call){0, 1}), CAROM_ERROR_ACT);
  ck_assert_int_eq(carom_match_call(&match, 0, (carom_call){11, 1}), CAROM_ERROR_ACT);
}

/* A plan calls the combination of a ball that hangs in a pocket, which is not on. */
TEST(a_combination_is_planned) {
  const int count = lay_out(CAROM_RACK_TENBALL, CAROM_TABLE_POOL_9FT, 0x423);
  put(0, 0.3, 0.9);
  put(1, 0.2, 0.35);
  put(5, 0.035, 0.04);
  put(10, 1.0, 2.2);
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(0.2);
  const carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_TENBALL);
  const carom_plan_options options = {.shots = 2000};
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  carom_choice best[5];
  int found;
  ck_assert_int_eq(carom_plan(&job, best, 5, &found), CAROM_OK);
  bool calls_five = false;
  for (int k = 0; k < found; k++)
    calls_five |= best[k].ball == 5 && best[k].pocket >= 0 && best[k].keep > 0.3;
  ck_assert_msg(calls_five, "the best calls %d, keeps %g", best[0].ball, best[0].keep);
  free(job.memory);
}
