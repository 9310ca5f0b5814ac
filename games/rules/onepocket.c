/* One-pocket: the rules of OnePocket.org, which the BCA uses, under the general rules of the WPA.
 *
 * Each player has one of the two pockets at the foot. A ball in it counts for him, whoever played,
 * and eight win. The turn continues with a ball in one's own pocket. Balls that count for no one
 * are spotted at the end of the visit, or when no other is left. A foul costs one ball; a player
 * without a ball owes one, and the player's next ball does not count. On a foul the own pocket does
 * not count, nor any pocket where the cue ball is gone. A third foul in a row loses; of two eighth
 * balls the shooter's wins. */
#include "games.h"
#include "rules.h"

enum { BALLS = 15 };
static const uint32_t object_balls = 0xfffe;

static uint32_t pockets(const carom_rules_state *game) {
  return UINT32_C(1) << (game->pocket[0] & (CAROM_POCKETS_MOST - 1));
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  (void)call;
  const uint32_t balls = in_play & object_balls, gone = (facts->down | facts->off) & balls;
  const int32_t fault = (int32_t)carom_foul_of(facts, balls, cue_ball);
  const bool foul = fault != CAROM_FOUL_NONE, scratch = fault == CAROM_FOUL_CUE_BALL;
  carom_turn turn = carom_pass_by(fault);

  /* balls in the pockets of both, where these count; one that is owed is paid first */
  const bool none_count[2] = {foul, scratch};
  uint32_t in[2] = {0, 0};
  for (int seat = 0; seat < 2; seat++)
    for (int k = 1; k <= BALLS && !none_count[seat]; k++)
      if ((facts->down & balls) >> k & 1 && facts->pocket[k] == game->pocket[seat]) {
        in[seat] |= UINT32_C(1) << k;
        carom_count_ball(game, seat);
      }
  turn.points = carom_count_of(in[0]);

  /* a foul costs a ball */
  const bool third = carom_is_third_foul(game, foul);
  if (foul)
    carom_pay_ball(game);

  /* the end of the game, or of the visit */
  const uint32_t remain = balls & ~gone;
  if (!foul && game->score[0] >= CAROM_BALLS_THAT_WIN)
    turn.outcome = CAROM_TURN_WIN;
  else if (game->score[1] >= CAROM_BALLS_THAT_WIN || third)
    turn.outcome = CAROM_TURN_LOSE;
  else if (in[0] != 0)
    turn.outcome = CAROM_TURN_KEEP;
  if (turn.outcome == CAROM_TURN_PASS || (turn.outcome == CAROM_TURN_KEEP && remain == 0))
    turn.spot = carom_back_of(game, object_balls & ~remain, gone & ~(in[0] | in[1]));
  return carom_end_turn(game, turn);
}

/* To begin with, the pockets at the foot of a table of carom_table_make(): 5 and 2. */
CAROM_RULES_OBJECT(carom_onepocket) = {.state = {.pocket = {5, 2}},
                                       .on = carom_on_any,
                                       .judge = judge,
                                       .left = carom_left_of_eight,
                                       .pockets = pockets,
                                       .race = CAROM_RACE_OWN,
                                       .breaks = 2,
                                       .settle = carom_settle_rack,
                                       .rack = CAROM_RACK_EIGHTBALL};
