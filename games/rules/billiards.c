/* English billiards: the rules of the WPBSA. Their text was not at hand, but for its contents: the
 * rules are from memory, as clubs tell them, and as a page of 1914 had them (Principal Rules in a
 * Nutshell, eaba.co.uk) where they have not changed since.
 *
 * Each player has a cue ball, and the red belongs to both. A stroke makes 2 points by a cannon, 2
 * or 3 by a winning hazard, of the other's ball or the red, and 2 or 3 by a losing hazard off the
 * ball that is met first; all of them add up. After a losing hazard the player is in hand, in the
 * D. The other's ball that falls stays off until its player plays it from the D, as at the
 * beginning.
 *
 * The red returns to the Spot, else to the pyramid spot or the centre; behind two pots in a row
 * from the Spot, without another score, to the centre, else the pyramid spot or the Spot. At most
 * 15 strokes in a row score only by hazards, and at most 75 only by a cannon. Where the other's
 * ball was off before the first of 15, it is then placed in the middle of the D, or at its right
 * corner. A cue ball that rests against another is in hand: the red goes to the Spot, and the
 * other's ball to the centre. In hand, a ball in baulk may not be met before the cue ball has left
 * baulk; where no ball is out of baulk, a miss is not a foul. A foul gives the other 2 points, and
 * the choice to have the balls placed as above.
 *
 * Games are played to a number of points. Left out are games by time, and the line that a break had
 * to cross every hundred points in some tournaments. A stroke counts as one hazard, also by two. */
#include "games.h"
#include "rules.h"
#include "table/marks.h"

enum { RED = 2, BALLS = 3, HAZARDS_MOST = 15, CANNONS_MOST = 75, FOUL_POINTS = 2 };
/* Integers of state.user: hazards and cannons in a row; whether the red is on the Spot, and its
 * pots from there in a row; whether the other's ball was off when the hazards began. */
enum { HAZARDS, CANNONS, ON_SPOT, RED_POTS, WAS_OFF };
/* Spots of the rack of snooker. */
enum { RIGHT_OF_D = 16, MIDDLE_OF_D = 18, CENTRE = 19, PYRAMID = 20, SPOT = 21 };

static int cue_ball_of(const carom_rules_state *game) {
  return game->group == 2;
}

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  return in_play & 7 & ~carom_only(cue_ball_of(game));
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++)
    needed[seat] = (int32_t)carom_max((int64_t)game->target - game->score[seat], 0);
}

static double points(const carom_rules_state *game, uint32_t in_play, int ball) {
  (void)game, (void)in_play;
  if (ball < 0)
    return 2.5;
  return ball == RED ? 3.0 : 2.0;
}

/* The foul of a stroke, but for one that scores too often in a row. game->on: a miss is none. */
static int32_t foul_of(const carom_rules_state *game, const carom_facts *facts, uint32_t cue_ball) {
  const uint32_t first = carom_met_first(facts);
  if ((facts->off & cue_ball) != 0 || (first == 0 && (facts->down & cue_ball) != 0))
    return CAROM_FOUL_CUE_BALL;
  if (first == 0)
    return game->on != 0 ? CAROM_FOUL_NONE : CAROM_FOUL_NO_BALL;
  if ((first & ~facts->barred) == 0)
    return CAROM_FOUL_FIRST;
  if (facts->off != 0)
    return CAROM_FOUL_OFF;
  if (carom_is_double_hit(facts))
    return CAROM_FOUL_DOUBLE_HIT;
  return (facts->jumped & 7) != 0 ? CAROM_FOUL_JUMP : CAROM_FOUL_NONE;
}

/* The score of a stroke, and the runs that it continues with. Returns false beyond a limit. */
static bool count_score(carom_rules_state *game, uint32_t in_play, const carom_facts *facts,
                        int32_t *score) {
  const uint32_t cue_ball = carom_only(cue_ball_of(game)), other = 3 & ~cue_ball;
  const uint32_t red = carom_only(RED), first = carom_met_first(facts);
  const bool cannon = first != 0 && facts->first[1] >= 0, hazard = facts->down != 0;
  int32_t losing = 2;
  if (first == red)
    losing = 3;
  *score = 2 * cannon;
  if ((facts->down & red) != 0)
    *score += 3;
  if ((facts->down & other) != 0)
    *score += 2;
  if ((facts->down & cue_ball) != 0)
    *score += losing;

  /* the runs */
  uint64_t *run = game->user;
  if (run[HAZARDS] == 0)
    run[WAS_OFF] = (in_play & other) == 0;
  run[HAZARDS] = hazard && !cannon ? run[HAZARDS] + 1 : 0;
  run[CANNONS] = cannon && !hazard ? run[CANNONS] + 1 : 0;
  const bool pots_red = !cannon && facts->down == red && run[ON_SPOT] != 0;
  run[RED_POTS] = pots_red ? run[RED_POTS] + 1 : 0;
  return run[HAZARDS] <= HAZARDS_MOST && run[CANNONS] <= CANNONS_MOST;
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball_index,
                        const carom_facts *facts, carom_call call) {
  (void)cue_ball_index;
  const uint32_t cue_ball = carom_only(cue_ball_of(game)), other = 3 & ~cue_ball;
  const uint32_t red = carom_only(RED), gone = facts->down | facts->off;
  carom_turn turn = carom_keep;
  const bool places = (game->may & CAROM_CHOICE_RACK) && call.ball == CAROM_CALL_RACK;
  game->may = 0;
  if (places) {
    turn.leave = CAROM_LEAVE_D;
    turn.spot = red | (in_play & other);
    return turn;
  }

  int32_t score = 0;
  turn.foul = foul_of(game, facts, cue_ball);
  turn.spot = gone & red;
  game->on = 0;
  if (turn.foul == CAROM_FOUL_NONE && !count_score(game, in_play, facts, &score))
    turn.foul = CAROM_FOUL_OTHER;
  if (turn.foul == CAROM_FOUL_NONE && score > 0) {
    turn.points = score;
    carom_add(&game->score[0], score);
    if ((gone & cue_ball) != 0)
      turn.leave = CAROM_LEAVE_D;
    if (game->score[0] >= game->target)
      turn.outcome = CAROM_TURN_WIN;
    return turn;
  }

  /* the other plays, from the D where his ball is off */
  turn.outcome = CAROM_TURN_PASS;
  if ((in_play & ~gone & other) == 0)
    turn.leave = CAROM_LEAVE_D;
  for (int k = HAZARDS; k <= WAS_OFF; k++)
    game->user[k] = 0;
  game->group = 1 + (cue_ball == 1);
  if (turn.foul != CAROM_FOUL_NONE) {
    carom_add(&game->score[1], FOUL_POINTS);
    game->may = CAROM_CHOICE_RACK;
    if (game->score[1] >= game->target)
      turn.outcome = CAROM_TURN_LOSE;
  }
  return carom_end_turn(game, turn);
}

/* ---- Where balls lie */

static bool put_on(const carom_table *table, carom_shot_ball *balls, int count, int ball,
                   int spot) {
  double place[2] = {0.0, 0.0};
  carom_spot_of(CAROM_RACK_SNOOKER, table, spot, place);
  return carom_place_ball(table, balls, count, ball, place[0], place[1], NULL) == CAROM_OK;
}

static void put_red(const carom_table *table, carom_shot_ball *balls, int count, bool to_centre) {
  static const int spots[2][3] = {{SPOT, PYRAMID, CENTRE}, {CENTRE, PYRAMID, SPOT}};
  for (int k = 0; k < 3; k++)
    if (put_on(table, balls, count, RED, spots[to_centre][k]))
      return;
}

static bool is_on_spot(const carom_table *table, const carom_shot_ball *balls) {
  double spot[2] = {0.0, 0.0};
  carom_spot_of(CAROM_RACK_SNOOKER, table, SPOT, spot);
  return balls[RED].state.label != CAROM_BALL_POCKETED &&
         carom_square(balls[RED].state.r, spot) < CAROM_RULES_TOUCH * CAROM_RULES_TOUCH;
}

static void settle(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                   int count, carom_turn *turn) {
  if (count < BALLS)
    return;
  const int cue_ball = cue_ball_of(game), other = 1 - cue_ball;
  const uint32_t on_table = carom_on_table(balls, count);
  if (turn->leave < CAROM_LEAVE_ANYWHERE && carom_touching(balls, count, cue_ball) != 0) {
    turn->leave = CAROM_LEAVE_D;
    turn->spot = carom_only(RED) | (on_table & carom_only(other));
  }
  if (turn->leave >= CAROM_LEAVE_ANYWHERE)
    balls[cue_ball].state.label = CAROM_BALL_POCKETED;

  /* balls return */
  for (int k = 0; k < BALLS; k++)
    if (turn->spot >> k & 1)
      balls[k].state.label = CAROM_BALL_POCKETED;
  if (turn->spot >> RED & 1)
    put_red(table, balls, count, game->user[RED_POTS] == 2);
  if (game->user[RED_POTS] == 2)
    game->user[RED_POTS] = 0;
  if (turn->spot >> other & 1)
    put_on(table, balls, count, other, CENTRE);
  if (game->user[HAZARDS] == HAZARDS_MOST && game->user[WAS_OFF] != 0 &&
      (on_table >> other & 1) == 0 && !put_on(table, balls, count, other, MIDDLE_OF_D))
    put_on(table, balls, count, other, RIGHT_OF_D);

  /* what the next stroke has to know */
  const double line = carom_marks_of(table->width, table->length).d_centre[1];
  bool is_in_baulk = turn->leave == CAROM_LEAVE_D;
  for (int k = 0; k < BALLS; k++)
    if (k != cue_ball && (carom_on_table(balls, count) >> k & 1))
      is_in_baulk &= balls[k].state.r[1] <= line;
  game->on = is_in_baulk;
  game->user[ON_SPOT] = is_on_spot(table, balls);
}

CAROM_RULES_OBJECT(carom_billiards) = {
    .state = {.group = 1, .target = 100, .user = {[ON_SPOT] = 1}},
    .on = targets_of,
    .judge = judge,
    .settle = settle,
    .left = left,
    .points = points,
    .race = CAROM_RACE_POINTS,
    .own_cue_balls = 1,
    .rack = CAROM_RACK_BILLIARDS};
