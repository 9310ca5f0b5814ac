/* Bank pool: a rack that is broken again, a bank that a plan finds, and what a bank is.
 * situations.txt has its rulings. */
#include "game_support.h"

/* A bad break may be played again: then all balls are racked. Without that right none is. */
TEST(a_break_is_played_again) {
  for (int asks = 0; asks < 2; asks++) {
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_BANK);
    game_rules.state.may = asks ? MAY : 0;
    const carom_facts facts = facts_of(1, 1, 0, 0);
    carom_turn turn =
        game_rules.judge(&game_rules.state, 0xffff, 0, &facts, (carom_call){CAROM_CALL_PASS, -1});
    lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0xfffe);
    put(5, 0.3, 0.3);
    carom_turn_settle(&game_rules, &game_rules.state, &table, balls, 16, &turn);
    ck_assert_int_eq(balls[5].state.r[1] > 0.74 * table.length, asks);
  }
}

/* A ball that hangs in a pocket is no shot: the plan banks another one, and tells a chance. */
TEST(a_bank_is_planned) {
  lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0x7);
  put(0, 0.5, 1.0);
  put(1, 0.62, 1.5);
  put(2, 0.08, 0.08);
  carom_plan_stroke best;
  best_of(CAROM_RULES_BANK, 4000, &best, 1);
  ck_assert_msg(best.kind == CAROM_PLAN_BANK && best.cushions > 0 && best.keep > 0.4,
                "kind %d, ball %d, keeps %g", best.kind, best.ball, best.keep);
}

/* The ruling counts the balls whose kind is a bank, of strokes in all directions. Some balls rub
 * the rail next to their pocket, which is no bank. */
TEST(rulings_and_kinds_agree) {
  enum { DIRECTIONS = 18000, ROOM = 100 };
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0xf);
  put(0, 0.25, 1.5);
  put(1, 0.05, 2.2);
  put(2, 0.9, 1.0);
  put(3, 0.6, 0.5);
  const carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_BANK);
  int banks = 0, rubs = 0;
  for (int k = 0; k < DIRECTIONS; k++) {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = 1.6;
    cue.phi = 360.0 / DIRECTIONS * k;
    carom_brief_event events[ROOM];
    carom_ball_state final[16];
    carom_facts facts;
    const carom_shot shot = {.brief = events, .room = ROOM, .facts = &facts, .final = final};
    carom_shot played = shot;
    carom_shoot(&table, balls, count, &cue, NULL, &played);
    const int ball = facts.first[0];
    if (ball < 0 || facts.pocket[ball] < 0)
      continue;
    carom_ruling ruling;
    const carom_call call = {ball, facts.pocket[ball]};
    expect_ok(carom_referee(&game_rules, &table, balls, count, 0, &played, call, &ruling));
    const int kind = carom_pot_kind(&played, 0, ball, call.pocket);
    const bool banked = kind == CAROM_PLAN_BANK && ruling.turn.foul == CAROM_FOUL_NONE;
    ck_assert_msg(kind == CAROM_PLAN_KISS || (ruling.turn.points == 1.0) == banked,
                  "%.2f degrees: a %s", cue.phi, carom_word_text(CAROM_WORDS_PLAN_KIND, kind));
    banks += banked;
    rubs += kind == CAROM_PLAN_POT && facts.rails[ball] != 0;
  }
  ck_assert_msg(banks > 3 && rubs > 3, "%d banks, %d balls that rub a rail", banks, rubs);
}
