/* Bank pool: each branch of its rules beside rulings written down, and a bank that a plan finds. */
#include "game_support.h"

typedef struct bank_case {
  const char *what;
  uint32_t in_play;
  int first, before;      /* what the cue ball met, and its cushions before */
  uint32_t down, off;     /* what falls into the pocket that is called, or leaves the table */
  int call, cushions;     /* those of the ball that is called */
  int score, lost, fouls; /* of the player */
  bool opening;
  int outcome, leave, foul;
  uint32_t spot;
  int score_after, lost_after;
} bank_case;

/* clang-format off */
static const bank_case cases[] = {
    {"a bank", 0xffff, 3, 0, 8, 0, 3, 1, 0, 0, 0, false, KEEP, AFTER, 0, 0, 1, 0},
    {"without a cushion", 0xffff, 3, 0, 8, 0, 3, 0, 0, 0, 0, false, PASS, AFTER, 0, 8, 0, 0},
    {"by a kick", 0xffff, 3, 1, 8, 0, 3, 1, 0, 0, 0, false, PASS, AFTER, 0, 8, 0, 0},
    {"by a combination", 0xffff, 4, 0, 8, 0, 3, 1, 0, 0, 0, false, PASS, AFTER, 0, 8, 0, 0},
    {"another ball was called", 0xffff, 3, 0, 8, 0, 4, 1, 0, 0, 0, false, PASS, AFTER, 0, 8, 0, 0},
    {"one more with it", 0xffff, 3, 0, 0x18, 0, 3, 2, 0, 0, 0, false, KEEP, AFTER, 0, 0, 1, 0},
    {"which comes back", 0xffe7, 5, 0, 0, 0, NONE, 0, 1, 0, 0, false, PASS, AFTER, 0, 8, 1, 0},
    {"the last ball", 9, 3, 0, 8, 0, 3, 1, 6, 0, 0, false, KEEP, AFTER, 0, 0x1fe, 7, 0},
    {"a bank pays a debt", 0xffff, 3, 0, 8, 0, 3, 1, 0, 1, 0, false, KEEP, AFTER, 0, 0, 0, 0},
    {"the eighth", 0xff01, 9, 0, 0x200, 0, 9, 1, 7, 0, 0, false, WIN, AFTER, 0, 0, 8, 0},
    {"a safety", 0xffff, 3, 0, 0, 0, NONE, 0, 0, 0, 0, false, PASS, AFTER, 0, 0, 0, 0},
    {"a scratch", 0xfffd, 3, 0, 9, 0, 3, 1, 1, 0, 0, false, PASS, KITCHEN, CUE_BALL, 10, 0, 0},
    {"a ball off", 0xffff, 3, 0, 0, 0x10, 3, 0, 0, 0, 2, false, PASS, AFTER, 0, 0x10, 0, 0},
    {"with a bank", 0xffff, 3, 0, 8, 0x10, 3, 1, 0, 0, 0, false, KEEP, AFTER, 0, 0, 1, 0},
    {"no ball met", 0xffff, NONE, 0, 0, 0, NONE, 0, 0, 0, 0, false, PASS, AFTER, NO_BALL, 0, 0, 1},
    {"a third foul", 0xffff, NONE, 0, 0, 0, NONE, 0, 0, 0, 2, false, LOSE, AFTER, NO_BALL, 0, 0, 1},
    {"a break that pots", 0xffff, 1, 0, 0x6, 0, NONE, 1, 0, 0, 0, true, KEEP, AFTER, 0, 0, 0, 0},
    {"a break of two", 0xffff, 1, 0, 0, 0, NONE, 2, 0, 0, 0, true, PASS, AFTER, 0, 0, 0, 0},
    {"a break of one", 0xffff, 1, 0, 0, 0, NONE, 1, 0, 0, 0, true, PASS, AFTER, BREAK, 0, 0, 0},
    {"of none", 0xffff, NONE, 0, 0, 0, NONE, 0, 0, 0, 0, true, PASS, AFTER, NO_BALL, 0, 0, 1},
};
/* clang-format on */

TEST(bank_rulings) {
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const bank_case *c = &cases[k];
    carom_facts facts = facts_of(c->first, 1, c->down, c->off);
    facts.cushions_before[0] = c->before;
    if (c->call > 0)
      facts.banked = c->cushions > 0 ? UINT32_C(1) << c->call : 0;
    for (int i = 1; i <= c->cushions && c->opening; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_BANK);
    of.state = (carom_rules_state){
        .opening = c->opening, .fouls = {c->fouls, 1}, .score = {c->score}, .lost = {c->lost, 2}};
    const carom_turn turn = of.judge(&of.state, c->in_play, 0, &facts, (carom_call){c->call, 2});
    const bool gives = c->outcome == PASS;
    ruled(c->what, &turn, c->outcome, c->leave, c->foul, c->spot);
    const bool bad_break = c->opening && c->cushions < 2 && c->down == 0;
    ck_assert_msg(
        of.state.score[gives] == c->score_after && of.state.lost[gives] == c->lost_after &&
            of.state.lost[!gives] == 2 && of.state.opening == 0 && of.state.fouls[!gives] == 1 &&
            of.state.fouls[gives] == (c->foul == 0 || c->foul == BREAK ? 0 : c->fouls + 1) &&
            of.state.may == (bad_break ? MAY : 0),
        "%s: %d, %d owed", c->what, of.state.score[gives], of.state.lost[gives]);

    /* the other may have a bad break played again: all balls are racked */
    carom_turn asked = of.judge(&of.state, 0xffff, 0, &facts, (carom_call){CAROM_CALL_PASS, -1});
    ck_assert(of.state.opening == bad_break && (!bad_break || of.state.lost[0] == c->lost_after));
    lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0xfffe);
    put(5, 0.3, 0.3);
    carom_turn_settle(&of, &of.state, &table, balls, 16, &asked);
    ck_assert((balls[5].state.r[1] > 0.74 * table.length) == bad_break);
  }
}

/* A ball that hangs in a pocket is no shot: the plan banks another one, and tells a chance. */
TEST(a_bank_is_planned) {
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0x7);
  put(0, 0.5, 1.0);
  put(1, 0.62, 1.5);
  put(2, 0.08, 0.08);
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(0.2);
  const carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_BANK);
  const carom_plan_options options = {.shots = 4000};
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  carom_choice best;
  int found;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_msg(best.kind == CAROM_PLAN_BANK && best.cushions > 0 && best.keep > 0.4,
                "kind %d, ball %d, keeps %g", best.kind, best.ball, best.keep);
  free(job.memory);
}
