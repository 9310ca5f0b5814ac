/* Free pyramid of Russian billiards: the rules of Free Pyramid, sections 1 to 7, with the General
 * Rules of Pyramid.
 *
 * Any of the 16 balls may be struck, but for the opening, which strikes the yellow one from behind
 * the head string. Each ball that falls without a foul counts one and keeps the turn, also the
 * struck one after it met another (5.4, 5.5); eight win. A foul gives the other one point (6).
 * Balls that fall on a foul or leave the table return to the foot spot, the struck one too, and
 * touch no other there. An opening that pots none drives two balls to cushions, else the other may
 * have the balls racked and break.
 *
 * Another stroke that pots none is legal where, behind the contact, balls meet two cushions, or one
 * and cross the middle of the table. This is the rule of two cushions, as clubs and magazines
 * report section 20 of the General Rules; its text was not at hand. */
#include "games.h"
#include "rules.h"

enum { WINS = 8, DRIVEN = 2, CUSHIONS = 2 };
static const uint32_t object_balls = 0xffff;

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  if (game->opening != 0)
    return in_play & object_balls & ~UINT32_C(1);
  return in_play & object_balls;
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++)
    needed[seat] = (int32_t)carom_max(WINS - game->score[seat], 1);
}

/* Whether a stroke that pots none is legal: two cushions were met, or one by a ball that was on
 * both sides of the middle, which may have been before the contact. */
static bool is_played_out(const carom_facts *facts, uint32_t balls) {
  const uint32_t crossed = facts->past_middle & facts->beyond_middle & balls;
  bool legal = facts->cushions_after >= CUSHIONS;
  for (int k = 0; crossed >> k != 0; k++)
    legal |= (crossed >> k & 1) && facts->cushions[k] > 0;
  return legal;
}

/* The foul of a stroke: that the cue ball falls is none. */
static int32_t foul_of(const carom_facts *facts, uint32_t balls, int cue_ball) {
  const uint32_t others = balls & ~(UINT32_C(1) << cue_ball);
  carom_facts of_others = *facts;
  of_others.down &= ~(UINT32_C(1) << cue_ball);
  of_others.cushions_after += facts->down != of_others.down;
  return (int32_t)carom_foul_of(&of_others, others, cue_ball);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, fell = facts->down & balls;
  const bool opening = game->opening != 0;
  carom_turn turn;
  if (carom_racks_again(game, call.ball, object_balls & ~UINT32_C(1), &turn))
    return turn;
  int32_t foul = foul_of(facts, balls, cue_ball);
  game->opening = game->may = 0;
  const bool so_far = foul == CAROM_FOUL_NONE || foul == CAROM_FOUL_CUSHION;
  if (so_far && fell == 0 && opening && carom_driven(facts, cue_ball) < DRIVEN)
    foul = CAROM_FOUL_BREAK;
  if (foul == CAROM_FOUL_NONE && fell == 0 && !opening && !is_played_out(facts, balls))
    foul = CAROM_FOUL_CUSHION;

  /* a foul gives the other a point */
  if (foul != CAROM_FOUL_NONE) {
    turn = carom_pass;
    turn.foul = foul;
    turn.spot = (facts->down | facts->off) & balls;
    carom_add(&game->score[1], 1);
    if (game->score[1] >= WINS)
      turn.outcome = CAROM_TURN_LOSE;
    if (foul == CAROM_FOUL_BREAK)
      game->may = CAROM_CHOICE_RACK;
    return carom_end_turn(game, turn);
  }
  if (fell == 0)
    return carom_give(game, carom_pass);
  turn = carom_keep;
  turn.points = carom_count_of(fell);
  carom_add(&game->score[0], carom_count_of(fell));
  if (game->score[0] >= WINS)
    turn.outcome = CAROM_TURN_WIN;
  return turn;
}

CAROM_RULES_OBJECT(carom_pyramid) = {.on = targets_of,
                                     .judge = judge,
                                     .left = left,
                                     .race = CAROM_RACE_OWN,
                                     .breaks = 1,
                                     .rack = CAROM_RACK_PYRAMID,
                                     .any_cue_ball = 1};
