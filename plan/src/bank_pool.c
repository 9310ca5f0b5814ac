/* Bank pool: the rules of the BCA, under the general rules of the WPA.
 *
 * A ball counts that is called with its pocket and banked: the cue ball meets it first, without a
 * cushion before, and it meets a cushion, not only jaws, before it falls. It keeps the turn, and
 * eight of them win. What falls otherwise comes back. A foul costs one ball; who has none owes one.
 * After the break, which is called by nobody, who has potted plays on. */
#include "games.h"
#include "rules.h"

static const uint32_t all = 0xfffe;

static uint32_t on(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return in_play & all;
}

static bool is_banked(const carom_facts *facts, carom_call call) {
  return carom_is_called(facts, call) && facts->first[0] == call.ball &&
         facts->cushions_before[0] == 0 && (facts->banked >> call.ball & 1);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & all, remain = balls & ~(facts->down | facts->off);
  const bool opening = game->opening != 0;
  int32_t bad = (int32_t)carom_foul_of(facts, balls, cue_ball);
  if (bad == CAROM_FOUL_NONE && opening && !carom_is_break(facts, cue_ball))
    bad = CAROM_FOUL_BREAK;
  carom_turn turn = {.is = CAROM_TURN_PASS,
                     .leave = bad == CAROM_FOUL_CUE_BALL ? CAROM_LEAVE_KITCHEN : CAROM_LEAVE_AFTER,
                     .foul = bad};
  game->opening = 0;

  /* the ball that counts, or the one that a foul costs */
  const bool made = bad == CAROM_FOUL_NONE && !opening && is_banked(facts, call);
  if (made)
    carom_count_ball(game, 0);
  else if (bad != CAROM_FOUL_NONE)
    carom_pay_ball(game);
  turn.points = made;

  /* who plays, and what comes back: the ball that was made stays down */
  const uint32_t its = made ? UINT32_C(1) << call.ball : 0;
  if (game->score[0] >= CAROM_BALLS_THAT_WIN)
    turn.is = CAROM_TURN_WIN;
  else if (made || (opening && bad == CAROM_FOUL_NONE && facts->down != 0))
    turn.is = CAROM_TURN_KEEP;
  if (turn.is != CAROM_TURN_WIN)
    turn.spot = carom_back_of(game, all & ~remain, balls & ~remain & ~its);
  if (turn.is == CAROM_TURN_PASS) {
    carom_swap(game->score);
    carom_swap(game->lost);
  }
  return turn;
}

const carom_plan_rules carom_bank_pool = {.on = on,
                                          .judge = judge,
                                          .left = carom_left_of_eight,
                                          .race = CAROM_RACE_OWN,
                                          .breaks = 1,
                                          .settle = carom_settle_pool,
                                          .rack = CAROM_RACK_EIGHTBALL};
