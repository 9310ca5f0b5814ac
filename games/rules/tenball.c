/* Ten-ball: World Standardized Rules of the WPA (2016), section 9, with the general fouls of
 * section 6. The edition of 2025, chapter 6, has the same rules, except its wording on safeties.
 *
 * The cue ball meets the lowest ball first (9). Ball and pocket are called, except on the break
 * (9.5). A called ball in its pocket keeps the turn, and what else falls stays down; the ten,
 * called as the last ball, wins (9.8). A ball that falls otherwise without a foul ends the visit,
 * and the other may hand the table back; this holds for a safety too (9.6, 9.7). A ten that falls
 * without winning or leaves the table returns, and no other ball does (9.9). A break pots a
 * ball or drives four to cushions (9.3). The next player may push out, and then the other may hand
 * the table back (9.4). After a foul the cue ball is in hand (9.10), and the third in a row loses
 * (9.11). A break below the three points of regulation 18, where the state requires them, may be
 * handed back. In a game without the ten the highest ball replaces it. */
#include "games.h"
#include "rules.h"

static const uint32_t object_balls = 0x7fe;

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return carom_lowest_of(in_play & object_balls);
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)game;
  needed[0] = needed[1] = carom_count_of(in_play & object_balls);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, ten = carom_highest_of(balls);
  const bool opening = game->opening != 0;
  const bool pushes = (game->may & CAROM_CHOICE_PUSH) && call.ball == CAROM_CALL_PUSH;
  const bool passes = (game->may & CAROM_CHOICE_PASS) && call.ball == CAROM_CALL_PASS;
  game->opening = game->may = 0;
  if (passes)
    return carom_give(game, carom_pass);

  /* fouls */
  const uint32_t back = (facts->down | facts->off) & ten;
  const int32_t foul =
      carom_rotation_foul_of(facts, targets_of(game, in_play), cue_ball, opening, pushes);
  if (foul != CAROM_FOUL_NONE)
    return carom_give_hand(game, foul, back);

  /* a push-out, which leaves the count of fouls as it is */
  const bool pots = (facts->down & balls) != 0;
  carom_turn turn = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, CAROM_FOUL_NONE, back, 0.0};
  if (pushes) {
    game->may = CAROM_CHOICE_PASS;
    return carom_give(game, turn);
  }
  game->fouls[0] = 0;

  /* the break, on which nothing is called */
  if (opening && carom_is_below_target(game, facts, balls)) {
    game->may = CAROM_CHOICE_PASS;
    return carom_give(game, turn);
  }
  if (opening) {
    game->may = CAROM_CHOICE_PUSH;
    if (pots)
      turn.outcome = CAROM_TURN_KEEP;
    return carom_end_turn(game, turn);
  }

  /* the ball that was called, or another one that fell */
  if (carom_is_called(facts, call) && (balls >> call.ball & 1)) {
    turn.outcome = CAROM_TURN_KEEP;
    if (balls == ten) {
      turn.outcome = CAROM_TURN_WIN;
      turn.spot = 0;
    }
    return turn;
  }
  if (pots)
    game->may = CAROM_CHOICE_PASS;
  return carom_give(game, turn);
}

CAROM_RULES_OBJECT(carom_ten_ball) = {.on = targets_of,
                                      .judge = judge,
                                      .left = left,
                                      .race = CAROM_RACE_SHARED,
                                      .first_decides = 1,
                                      .breaks = 1,
                                      .rack = CAROM_RACK_TENBALL};
