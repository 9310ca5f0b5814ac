/* Games on a table without pockets: three-cushion and straight rail, by the world rules of carom
 * billiard of the UMB, and four-ball as it is played in Korea.
 *
 * Each player has a cue ball, and the opening meets the red first (article 23). A point is a stroke
 * in which the cue ball meets both others (24): in three-cushion after three cushions (83), in
 * straight rail in any way (61). Balls that leave the table are a foul (41) and return (28), and
 * a player whose cue ball touches another ball may have balls spotted (27): in three-cushion each
 * of these balls on its spot, in straight rail all three as for the opening.
 *
 * Where the state requires equal innings (29, as clubs tell it), a player who began and reaches the
 * target first gives the other one more inning, from the opening position of that player (23): who
 * reaches the target in it draws, and who misses loses. Without them the first who has the target
 * wins, as in all knock-out matches of the UMB (changes by its board, December 2019). So no match
 * of the UMB needs further strokes after a draw. Those changes also give 30 s for a stroke: the
 * clock is the caller's, who calls carom_match_clock().
 *
 * The barred corners of straight rail (52 to 54), in which the number of points in a row is
 * limited, are left out.
 *
 * Four-ball has no rules of a federation; it is by custom (Korean and English descriptions, which
 * agree): white and yellow are cue balls, and the opening meets the farther red first. A point is a
 * stroke that meets both reds. A stroke that meets no red or the other cue ball, a double hit and a
 * ball that leaves the table cost a point. The custom of a last point off three cushions is left
 * out. What the descriptions leave open, the position of the other cue ball at first and balls that
 * touch or return, is as in straight rail. */
#include "games.h"
#include "rules.h"
#include "table/marks.h"

enum { WHITE = 0, YELLOW = 1, RED = 2, BALLS_OF_THREE = 3, BALLS_OF_FOUR = 4 };

/* The cue ball of the player, by the group; of both ball 0 where there is none. */
static int cue_ball_of(const carom_rules_state *game) {
  if (game->group == 2)
    return YELLOW;
  return WHITE;
}

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t others = in_play & ~(UINT32_C(1) << cue_ball_of(game));
  if (game->opening != 0)
    return others & UINT32_C(1) << RED;
  return others;
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)game, (void)in_play;
  needed[0] = needed[1] = 1;
}

/* The turn goes to the other, who has the other cue ball. */
static carom_turn give(carom_rules_state *game, carom_turn turn) {
  if (game->group != 0)
    game->group = 3 - game->group;
  if (game->innings != 0)
    game->innings = CAROM_BEGAN + CAROM_FOLLOWS - game->innings;
  return carom_give(game, turn);
}

/* A miss or a foul: the turn goes to the other, who has won if this was the equalizing inning. */
static carom_turn end_inning(carom_rules_state *game, carom_turn turn) {
  if (game->innings != CAROM_LAST_INNING)
    return give(game, turn);
  turn.outcome = CAROM_TURN_LOSE;
  return turn;
}

/* The turn of a player who has the target. */
static carom_turn reach_target(carom_rules_state *game, uint32_t in_play, carom_turn turn) {
  turn.outcome = CAROM_TURN_WIN;
  if (game->innings == CAROM_LAST_INNING)
    turn.outcome = CAROM_TURN_DRAW;
  if (game->innings != CAROM_BEGAN)
    return turn;

  /* the other opens again: settle() places the balls */
  turn.outcome = CAROM_TURN_PASS;
  turn.spot = in_play;
  give(game, turn);
  game->innings = CAROM_LAST_INNING;
  game->opening = 1;
  return turn;
}

/* A point: before the cue ball meets the second ball, it meets so many cushions. */
static carom_turn judge_point(carom_rules_state *game, uint32_t in_play, const carom_facts *facts,
                              carom_call call, int cushions) {
  if ((game->may & CAROM_CHOICE_SPOT) && call.ball == CAROM_CALL_SPOT)
    return carom_keep; /* settle() spots, and takes the choice back */
  const uint32_t may_meet = targets_of(game, in_play), first = carom_met_first(facts);
  const bool opening = game->opening != 0;
  game->opening = game->may = 0;
  int32_t foul = CAROM_FOUL_NONE;
  if (facts->off != 0)
    foul = CAROM_FOUL_OFF;
  else if (facts->pushed != 0 || facts->touches > 1)
    foul = CAROM_FOUL_DOUBLE_HIT;
  else if (opening && first != 0 && (first & may_meet) == 0)
    foul = CAROM_FOUL_FIRST;
  if (foul != CAROM_FOUL_NONE || facts->first[1] < 0 || facts->cushions_before[1] < cushions)
    return end_inning(game,
                      (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_AFTER, foul, facts->off, 0.0});
  carom_turn turn = carom_keep;
  turn.points = 1.0;
  carom_add(&game->score[0], 1);
  if (game->target > 0 && game->score[0] >= game->target)
    return reach_target(game, in_play, turn);
  return turn;
}

static carom_turn judge_three(carom_rules_state *game, uint32_t in_play, int cue_ball,
                              const carom_facts *facts, carom_call call) {
  (void)cue_ball;
  return judge_point(game, in_play, facts, call, 3);
}

static carom_turn judge_any(carom_rules_state *game, uint32_t in_play, int cue_ball,
                            const carom_facts *facts, carom_call call) {
  (void)cue_ball;
  return judge_point(game, in_play, facts, call, 0);
}

/* ---- Four-ball */

enum { NEAR_RED = 2, FAR_RED = 3 };
static const uint32_t both_reds = UINT32_C(1) << NEAR_RED | UINT32_C(1) << FAR_RED;

static uint32_t on_four(const carom_rules_state *game, uint32_t in_play) {
  if (game->opening != 0)
    return in_play & UINT32_C(1) << FAR_RED;
  return in_play & both_reds;
}

static int32_t foul_of_four(const carom_facts *facts, uint32_t targets, uint32_t hit_balls) {
  if (hit_balls == 0)
    return CAROM_FOUL_NO_BALL;
  if ((carom_met_first(facts) & targets) == 0)
    return CAROM_FOUL_FIRST;
  if (facts->off != 0)
    return CAROM_FOUL_OFF;
  if (facts->pushed != 0 || facts->touches > 1)
    return CAROM_FOUL_DOUBLE_HIT;
  if ((hit_balls & ~both_reds) != 0)
    return CAROM_FOUL_OTHER;
  return CAROM_FOUL_NONE;
}

static carom_turn judge_four(carom_rules_state *game, uint32_t in_play, int cue_ball,
                             const carom_facts *facts, carom_call call) {
  (void)cue_ball;
  if ((game->may & CAROM_CHOICE_SPOT) && call.ball == CAROM_CALL_SPOT)
    return carom_keep; /* settle() spots, and takes the choice back */
  uint32_t hit_balls = 0;
  for (int k = 0; k < BALLS_OF_FOUR && facts->first[0] >= 0; k++)
    hit_balls |= carom_only(facts->order[k]);
  carom_turn turn = carom_pass;
  turn.foul = foul_of_four(facts, on_four(game, in_play), hit_balls);
  game->opening = game->may = 0;
  if (turn.foul != CAROM_FOUL_NONE) {
    turn.spot = facts->off;
    turn.points = -1.0;
    carom_add(&game->lost[0], 1);
    return give(game, turn);
  }
  if (carom_count_of(hit_balls) < 2)
    return give(game, turn);
  turn = carom_keep;
  turn.points = 1.0;
  carom_add(&game->score[0], 1);
  if (game->target > 0 && game->score[0] - game->lost[0] >= game->target)
    turn.outcome = CAROM_TURN_WIN;
  return turn;
}

/* ---- Balls that return */

/* The spots of three-cushion: for the red the foot spot, for the cue ball of the next player the
 * head spot, for the other one the centre. */
static void spot_of(const carom_table *table, int cue_ball, int ball, double place[2]) {
  place[0] = 0.5 * table->width;
  place[1] = 0.5 * table->length;
  if (ball == RED)
    place[1] = 0.75 * table->length;
  if (ball == cue_ball)
    place[1] = 0.25 * table->length;
}

/* Puts a ball on its spot, or where that is taken on the spot of the ball that is in the way. */
static void put_on_spot(const carom_table *table, carom_shot_ball *balls, int count, int cue_ball,
                        int ball) {
  double place[2];
  int spot = ball;
  for (int tried = 0; tried < BALLS_OF_THREE; tried++) {
    carom_part obstacle;
    spot_of(table, cue_ball, spot, place);
    if (carom_place_ball(table, balls, count, ball, place[0], place[1], &obstacle) == CAROM_OK)
      return;
    if (obstacle.kind != CAROM_PART_BALL)
      return;
    spot = obstacle.index;
  }
}

/* Where the cue ball touches another ball, the player may have balls spotted. */
static int32_t may_spot(const carom_shot_ball *balls, int count, int cue_ball) {
  if (carom_touching(balls, count, cue_ball) == 0)
    return 0;
  return CAROM_CHOICE_SPOT;
}

/* All balls go to the positions of the opening of the next player. */
static void settle_rack(carom_rack_kind rack, carom_rules_state *game, const carom_table *table,
                        carom_shot_ball *balls, int count, carom_turn *turn) {
  const int cue_ball = cue_ball_of(game), count_of_balls = carom_rack_size(rack);
  if (count < count_of_balls)
    return;
  const bool is_requested = (game->may & CAROM_CHOICE_SPOT) && turn->outcome == CAROM_TURN_KEEP;
  if (is_requested || turn->spot != 0) {
    turn->spot = (UINT32_C(1) << count_of_balls) - 1;
    for (int k = 0; k < count_of_balls; k++)
      balls[k].state.label = CAROM_BALL_OFF;
    for (int k = 0; k < count_of_balls; k++) {
      /* the rack has the white as the cue ball */
      double place[2] = {0.0, 0.0};
      int spot = k;
      if (k < RED)
        spot = k != cue_ball;
      carom_spot_of(rack, table, spot, place);
      carom_place_ball(table, balls, count, k, place[0], place[1], NULL);
    }
  }
  game->may = may_spot(balls, count, cue_ball);
}

/* Balls that left the table return; and where the player chose so, those that touch his cue ball,
 * with it. All return for an equalizing inning, which is the only opening here. */
static void settle_one(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                       int count, carom_turn *turn) {
  const int cue_ball = cue_ball_of(game);
  if (count < BALLS_OF_THREE)
    return;
  if (game->opening != 0 && turn->spot != 0) {
    settle_rack(CAROM_RACK_THREECUSHION, game, table, balls, count, turn);
    return;
  }
  if ((game->may & CAROM_CHOICE_SPOT) && turn->outcome == CAROM_TURN_KEEP)
    turn->spot = carom_touching(balls, count, cue_ball) | UINT32_C(1) << cue_ball;
  for (int k = 0; k < BALLS_OF_THREE; k++)
    if (turn->spot >> k & 1)
      balls[k].state.label = CAROM_BALL_OFF;
  for (int k = 0; k < BALLS_OF_THREE; k++)
    if (turn->spot >> k & 1)
      put_on_spot(table, balls, count, cue_ball, k);
  game->may = may_spot(balls, count, cue_ball);
}

static void settle_three(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                         int count, carom_turn *turn) {
  settle_rack(CAROM_RACK_THREECUSHION, game, table, balls, count, turn);
}

static void settle_four(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                        int count, carom_turn *turn) {
  settle_rack(CAROM_RACK_FOURBALL, game, table, balls, count, turn);
}

/* ---- The games */

/* What follows is not estimated. */
static double value(const carom_rules_state *game, const carom_ball_state *layout, int count,
                    int in_hand) {
  (void)game, (void)layout, (void)count, (void)in_hand;
  return 0.0;
}

/* 40 points, as in the world championship of the UMB. */
CAROM_RULES_OBJECT(carom_threecushion) = {.state = {.target = 40},
                                          .on = targets_of,
                                          .judge = judge_three,
                                          .settle = settle_one,
                                          .left = left,
                                          .value = value,
                                          .race = CAROM_RACE_ALONE,
                                          .rack = CAROM_RACK_THREECUSHION};

CAROM_RULES_OBJECT(carom_straight_rail) = {.state = {.target = 100},
                                           .on = targets_of,
                                           .judge = judge_any,
                                           .settle = settle_three,
                                           .left = left,
                                           .value = value,
                                           .race = CAROM_RACE_ALONE,
                                           .rack = CAROM_RACK_THREECUSHION};

CAROM_RULES_OBJECT(carom_four_ball) = {.state = {.target = 10},
                                       .on = on_four,
                                       .judge = judge_four,
                                       .settle = settle_four,
                                       .left = left,
                                       .value = value,
                                       .race = CAROM_RACE_ALONE,
                                       .rack = CAROM_RACK_FOURBALL};
