/* Bank pool: the rules of the BCA, under the general rules of the WPA.
 *
 * A ball counts that is called with its pocket and banked, as pot_kind.h has it: the cue ball meets
 * it first and directly, and it meets a cushion that is not next to the pocket before it falls. It
 * keeps the turn, and eight of them win. A kiss on the way does not spoil it, although it does in
 * most rules. What falls otherwise returns at the end of the visit, or when no other ball is left.
 * A foul costs one ball; a player without a ball owes one; the third in a row loses. A ball that
 * leaves the table is not a foul. After the break, which is called by nobody, who has potted plays
 * on; if it pots none and drives fewer than two balls to rails, the other may have it played
 * again. */
#include "games.h"
#include "pot_kind.h"
#include "rules.h"

enum { DRIVEN = 2 };
static const uint32_t object_balls = 0xfffe;

static bool is_banked(const carom_facts *facts, carom_call call) {
  return carom_is_called(facts, call) && facts->first[0] == call.ball &&
         carom_approach_kind(facts) == CAROM_PLAN_POT && (facts->banked >> call.ball & 1) != 0;
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, remain = balls & ~(facts->down | facts->off);
  const bool opening = game->opening != 0,
             passes = (game->may & CAROM_CHOICE_PASS) != 0 && call.ball == CAROM_CALL_PASS;
  game->opening = passes;
  game->may = 0;
  if (passes)
    return carom_give(game,
                      (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_KITCHEN, 0, object_balls, 0.0});

  int32_t fault = (int32_t)carom_foul_of(facts, balls, cue_ball);
  if (fault == CAROM_FOUL_OFF)
    fault = CAROM_FOUL_NONE;
  if (fault == CAROM_FOUL_NONE && carom_is_double_hit(facts))
    fault = CAROM_FOUL_DOUBLE_HIT;
  const bool foul = fault != CAROM_FOUL_NONE, pots = (facts->down & balls) != 0;
  const bool bad_break = opening && !pots && carom_driven(facts, cue_ball) < DRIVEN;
  carom_turn turn = carom_pass_by(fault);
  if (bad_break && !foul)
    turn.foul = CAROM_FOUL_BREAK;

  /* the ball that counts, or the one that a foul costs */
  const bool counts = !foul && !opening && is_banked(facts, call);
  if (counts)
    carom_count_ball(game, 0);
  else if (foul)
    carom_pay_ball(game);
  turn.points = counts;
  const bool third = carom_is_third_foul(game, foul);

  /* who plays, and what returns: the ball that was made stays down */
  uint32_t stays = 0;
  if (counts)
    stays = carom_only(call.ball);
  if (game->score[0] >= CAROM_BALLS_THAT_WIN)
    turn.outcome = CAROM_TURN_WIN;
  else if (third)
    turn.outcome = CAROM_TURN_LOSE;
  else if (counts || (opening && !foul && pots))
    turn.outcome = CAROM_TURN_KEEP;
  if (turn.outcome == CAROM_TURN_PASS || (turn.outcome == CAROM_TURN_KEEP && remain == 0))
    turn.spot = carom_back_of(game, object_balls & ~remain, balls & ~remain & ~stays);
  if (bad_break)
    game->may = CAROM_CHOICE_PASS;
  return carom_end_turn(game, turn);
}

CAROM_RULES_OBJECT(carom_bank_pool) = {.on = carom_on_any,
                                       .judge = judge,
                                       .left = carom_left_of_eight,
                                       .race = CAROM_RACE_OWN,
                                       .breaks = 1,
                                       .settle = carom_settle_rack,
                                       .rack = CAROM_RACK_EIGHTBALL};
