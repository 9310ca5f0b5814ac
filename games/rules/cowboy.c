/* Cowboy: the rules of the BCA, as the New Mexico Billiards Association prints them, by their
 * titles; other printings agree, but for balls whose spots are taken.
 *
 * Scoring: up to 90 points, exactly, the balls 1, 3 and 5 that fall count their numbers, and two or
 * three balls that the cue ball meets count 1 or 2; from 90 to 100, exactly, only the latter. The
 * last point is made by the cue ball off only the 1 into the called pocket. A stroke that would
 * pass 90 or 100 is a foul. Penalties: a foul costs the points of the visit. Balls that fall or
 * leave the table return to their spots; a ball whose spot is taken stays off until the end of a
 * stroke that frees it. If that is the 1, and the player has 100, all balls are placed as at first,
 * with the cue ball in hand behind the head string. After a scratch it is there too. Opening break:
 * it meets the 3 first; else the other breaks, or has it repeated, or plays on where the balls lie,
 * as other printings have it. A stroke that scores needs no cushion: the texts differ. */
#include "games.h"
#include "rules.h"

enum { ONE = 1, THREE = 2, CAROMS_ONLY = 90, LAST = 100 };
/* How far it is to the end, in points below 90. In games of carom_player_of(0.5) against itself a
 * visit makes 22.6 of these, 3.8 points from 90 on, and 0.32 of the last one; a stroke below 90
 * that scores makes 3.7 (CAROM_TEST_GAME=cowboy CAROM_TEST_TELL=1 of games/tests/self_play.c). */
enum { POINT_OF_CAROMS = 6, LAST_POINT = 70 };
static const double usual_points = 3.7;
static const uint32_t object_balls = 0xe;
static const int32_t number_of[] = {0, 1, 3, 5};

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  if (game->opening != 0)
    return in_play & UINT32_C(1) << THREE;
  if (game->score[0] >= LAST)
    return in_play & UINT32_C(1) << ONE;
  return in_play & object_balls;
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++) {
    /* one visit in six ends by a foul, which costs its points */
    const int32_t score = game->score[seat] - (seat == 0 ? game->lost[0] / 6 : 0);
    needed[seat] = (int32_t)carom_max(CAROMS_ONLY - score, 0);
    needed[seat] += POINT_OF_CAROMS * (int32_t)carom_within(LAST - score, 0, LAST - CAROMS_ONLY);
    needed[seat] += LAST_POINT * (score <= LAST);
  }
}

static double points(const carom_rules_state *game, uint32_t in_play, int ball) {
  (void)in_play;
  if (ball < 0 || ball > 3)
    return usual_points;
  if (game->score[0] >= LAST) /* a ball is more easily potted than the cue ball off it */
    return 0.25 * (double)LAST_POINT;
  if (game->score[0] >= CAROMS_ONLY)
    return POINT_OF_CAROMS;
  if (game->score[0] + number_of[ball] > CAROMS_ONLY)
    return 0.0;
  return number_of[ball];
}

/* The object balls that the cue ball met. */
static int count_hits(const carom_facts *facts) {
  int count = 0;
  while (count < 3 && facts->first[0] >= 0 && facts->order[count] >= 0)
    count++;
  return count;
}

/* The points of a stroke without a foul. */
static int32_t points_of(const carom_rules_state *game, const carom_facts *facts) {
  if (game->score[0] >= LAST)
    return 0;
  int32_t points = (int32_t)carom_max(count_hits(facts) - 1, 0);
  for (int k = ONE; k <= 3 && game->score[0] < CAROMS_ONLY; k++)
    if (facts->down >> k & 1)
      points += number_of[k];
  return points;
}

/* The last stroke: off only the 1 into the called pocket. */
static bool is_last(const carom_facts *facts, int cue_ball, carom_call call) {
  return facts->first[0] == ONE && count_hits(facts) == 1 && facts->off == 0 &&
         facts->down == UINT32_C(1) && call.ball == ONE && facts->pocket[cue_ball] == call.pocket &&
         !carom_is_double_hit(facts);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  carom_turn turn;
  const bool opening = game->opening != 0;
  if (carom_racks_again(game, call.ball, object_balls, &turn))
    return turn;
  const uint32_t may_meet = targets_of(game, in_play);
  game->opening = game->may = 0;
  if (game->score[0] >= LAST && is_last(facts, cue_ball, call)) {
    carom_add(&game->score[0], 1);
    return (carom_turn){CAROM_TURN_WIN, CAROM_LEAVE_AFTER, CAROM_FOUL_NONE, 0, 1.0};
  }

  /* fouls; a stroke that scores needs no cushion */
  const int32_t gain = points_of(game, facts);
  int32_t most = LAST;
  if (game->score[0] < CAROMS_ONLY)
    most = CAROMS_ONLY;
  int32_t foul = (int32_t)carom_foul_of(facts, may_meet, cue_ball);
  if (foul == CAROM_FOUL_CUSHION && gain > 0)
    foul = CAROM_FOUL_NONE;
  if (foul == CAROM_FOUL_NONE && game->score[0] + gain > most)
    foul = CAROM_FOUL_OTHER;
  turn = carom_pass_by(foul);
  turn.spot = (facts->down | facts->off | ~in_play) & object_balls;
  if (foul != CAROM_FOUL_NONE) {
    turn.points = -game->lost[0];
    game->score[0] -= (int32_t)carom_min(game->lost[0], game->score[0]);
    if (opening && (carom_met_first(facts) & may_meet) == 0)
      game->may = CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK;
  } else {
    if (gain > 0)
      turn.outcome = CAROM_TURN_KEEP;
    turn.points = gain;
    carom_add(&game->score[0], gain);
    carom_add(&game->lost[0], gain);
  }
  if (turn.outcome == CAROM_TURN_KEEP)
    return turn;
  game->lost[0] = 0;
  return carom_give(game, turn);
}

/* Balls go to their spots, where these are free. */
static void put_back(const carom_table *table, carom_shot_ball *balls, int count, uint32_t set) {
  for (int k = ONE; k <= 3; k++)
    if (set >> k & 1) {
      double spot[2] = {0.0, 0.0};
      balls[k].state.label = CAROM_BALL_POCKETED;
      carom_spot_of(CAROM_RACK_COWBOY, table, k, spot);
      carom_place_ball(table, balls, count, k, spot[0], spot[1], NULL);
    }
}

static void settle(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                   int count, carom_turn *turn) {
  if (count < carom_rack_size(CAROM_RACK_COWBOY))
    return;
  if (turn->leave >= CAROM_LEAVE_ANYWHERE) /* it takes no spot */
    balls[0].state.label = CAROM_BALL_POCKETED;
  put_back(table, balls, count, turn->spot);
  if (game->score[0] < LAST || balls[ONE].state.label != CAROM_BALL_POCKETED)
    return;
  turn->spot = object_balls;
  turn->leave = CAROM_LEAVE_KITCHEN;
  balls[0].state.label = CAROM_BALL_POCKETED;
  put_back(table, balls, count, object_balls);
}

CAROM_RULES_OBJECT(carom_cowboy) = {.on = targets_of,
                                    .judge = judge,
                                    .settle = settle,
                                    .left = left,
                                    .points = points,
                                    .race = CAROM_RACE_POINTS,
                                    .rack = CAROM_RACK_COWBOY};
