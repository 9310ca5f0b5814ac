/* Rotation, or 61: the rules of the BCA, under the general rules of pocket billiards.
 *
 * The cue ball meets the lowest ball first. Each ball that falls without a foul counts its number
 * and keeps the turn; 61 points win, and at 60 to 60 who potted the last ball. Balls that fall on a
 * foul or leave the table return. A break pots a ball without a foul or drives four to cushions;
 * else the other has the cue ball behind the head string, or a new rack. A foul ends the visit;
 * after a scratch the cue ball is behind the head string. The third foul in a row loses: of the
 * penalties the text at hand had only the summary. The two safeties in a row that it allows are not
 * counted. */
#include "games.h"
#include "rules.h"

enum { WINS = 61, OPEN_BREAK = 4 };
static const uint32_t object_balls = 0xfffe;

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return carom_lowest_of(in_play & object_balls);
}

static int32_t points_of_set(uint32_t set) {
  int32_t points = 0;
  for (int k = 1; set >> k != 0; k++)
    if (set >> k & 1)
      points += k;
  return points;
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++)
    needed[seat] = (int32_t)carom_max(WINS - game->score[seat], 0);
}

static double points(const carom_rules_state *game, uint32_t in_play, int ball) {
  (void)game;
  const uint32_t balls = in_play & object_balls;
  if (ball >= 0)
    return ball;
  if (balls == 0)
    return 1.0;
  return (double)points_of_set(balls) / carom_count_of(balls);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, fell = facts->down & balls;
  const bool opening = game->opening != 0;
  carom_turn turn;
  if (carom_racks_again(game, call.ball, object_balls, &turn))
    return turn;
  const int32_t foul =
      carom_rotation_foul_of(facts, targets_of(game, in_play), cue_ball, opening, false);
  game->opening = game->may = 0;
  if (foul != CAROM_FOUL_NONE) {
    turn = carom_give_hand(game, foul, (facts->down | facts->off) & balls);
    const bool failed = opening && carom_driven(facts, cue_ball) < OPEN_BREAK;
    turn.leave = CAROM_LEAVE_AFTER;
    if (foul == CAROM_FOUL_CUE_BALL || failed)
      turn.leave = CAROM_LEAVE_KITCHEN;
    if (failed)
      game->may = CAROM_CHOICE_RACK;
    return turn;
  }
  game->fouls[0] = 0;
  if (fell == 0)
    return carom_give(game, carom_pass);

  /* points; of scores that were not given neither may have enough with the last ball, and then who
   * has more wins, as at 60 to 60 who potted it */
  turn = carom_keep;
  turn.points = points_of_set(fell);
  carom_add(&game->score[0], points_of_set(fell));
  const bool last = (balls & ~fell) == 0;
  if (game->score[0] >= WINS || (last && game->score[0] >= game->score[1]))
    turn.outcome = CAROM_TURN_WIN;
  else if (last)
    turn.outcome = CAROM_TURN_LOSE;
  return turn;
}

CAROM_RULES_OBJECT(carom_rotation) = {.on = targets_of,
                                      .judge = judge,
                                      .left = left,
                                      .points = points,
                                      .race = CAROM_RACE_POINTS,
                                      .first_decides = 1,
                                      .breaks = 1,
                                      .rack = CAROM_RACK_ROTATION};
