/* Straight pool, 14.1 continuous: World Standardized Rules of the WPA (2016), section 4.
 *
 * A called ball in its pocket keeps the turn; then it and all others that fell with it count one
 * each. What falls otherwise returns. A foul costs one point, the third in a row 15 more and a
 * new break. An opening break pots a called ball, or drives the cue ball and two others to
 * rails, as those that fall are; else it costs two points, and the other may have it played
 * again. */
#include "games.h"
#include "rules.h"
#include "table/marks.h"

enum { MANY_FOULS = 15, BAD_BREAK = 2, RACKED = 14, LAST_BALL = 15 };
static const uint32_t object_balls = 0xfffe;

static int64_t score(const carom_rules_state *game, int seat) {
  return (int64_t)game->score[seat] - game->lost[seat];
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++)
    needed[seat] = (int32_t)carom_min(carom_max(game->target - score(game, seat), 1), INT32_MAX);
}

/* A break: all balls are racked, and the cue ball is in hand. */
static carom_turn racked(carom_rules_state *game, carom_turn_outcome outcome, int32_t foul) {
  game->opening = 1;
  return (carom_turn){outcome, CAROM_LEAVE_KITCHEN, foul, object_balls, 0.0};
}

/* Whether an opening break drove the cue ball and two others to cushions. */
static bool is_open(const carom_facts *facts, int cue_ball) {
  const bool gone = (facts->down | facts->off) >> cue_ball & 1;
  return carom_driven(facts, cue_ball) >= 2 &&
         (gone || facts->cushions[cue_ball] > facts->cushions_before[0]);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, gone = (facts->down | facts->off) & balls;
  const bool opening = game->opening != 0,
             passes = (game->may & CAROM_CHOICE_PASS) != 0 && call.ball == CAROM_CALL_PASS;
  game->opening = game->may = 0;
  if (passes)
    return carom_give(game, racked(game, CAROM_TURN_PASS, 0));

  /* Fouls: what fell returns. */
  const int32_t foul = (int32_t)carom_foul_of(facts, balls, cue_ball);
  const bool called =
      foul == CAROM_FOUL_NONE && carom_is_called(facts, call) && (balls >> call.ball & 1);
  const bool bad_break = opening && !called && !is_open(facts, cue_ball);
  carom_turn turn = carom_pass_by(foul);
  turn.spot = gone;
  if (bad_break) {
    if (foul == CAROM_FOUL_NONE)
      turn.foul = CAROM_FOUL_BREAK;
    carom_add(&game->lost[0], BAD_BREAK);
    carom_give(game, turn);
    game->may = CAROM_CHOICE_PASS;
    return turn;
  }
  if (foul != CAROM_FOUL_NONE) {
    carom_add(&game->lost[0], 1);
    if (!carom_is_third_foul(game, true))
      return carom_give(game, turn);
    carom_add(&game->lost[0], MANY_FOULS);
    return racked(game, CAROM_TURN_KEEP, foul);
  }

  /* A miss or a safety; else points, and a new rack where one ball is left, or none. */
  game->fouls[0] = 0;
  if (!called)
    return carom_give(game, turn);
  turn = carom_keep;
  turn.points = carom_count_of(gone);
  carom_add(&game->score[0], carom_count_of(gone));
  if (score(game, 0) >= game->target)
    turn.outcome = CAROM_TURN_WIN;
  if (carom_count_of(balls & ~gone) <= 1)
    turn.spot = object_balls & ~(balls & ~gone);
  return turn;
}

/* ---- Racks */

/* The positions of the triangle, of which the first is its front. */
static void places_of(const carom_table *table, double radius, double place[LAST_BALL][2]) {
  const double pitch = 2.0 * radius + 1e-4; /* the gap of carom's racks */
  double foot[2] = {0.0, 0.0};
  carom_spot_of(CAROM_RACK_EIGHTBALL, table, 1, foot);
  for (int row = 0, n = 0; row < 5; row++)
    for (int k = 0; k <= row; k++, n++) {
      place[n][0] = foot[0] + (k - 0.5 * row) * pitch;
      place[n][1] = foot[1] + row * pitch * 0.8660254037844386;
    }
}

/* Whether a ball at r is in the way of one at a position. */
static bool is_near(const double r[2], const double place[2], double radius) {
  return carom_square(r, place) < 4.0 * radius * radius;
}

static bool is_in_rack(const carom_shot_ball *ball, double place[LAST_BALL][2]) {
  bool in = false;
  for (int k = 0; k < LAST_BALL; k++)
    in |= is_near(ball->state.r, place[k], ball->kind.radius);
  return in;
}

/* Spots balls of the set, one after another: if there is no room for one, there is none for the
 * others. */
static void spot_each(const carom_table *table, carom_shot_ball *balls, int count, uint32_t spot) {
  carom_status status = CAROM_OK;
  for (int k = 1; spot >> k != 0 && status == CAROM_OK; k++)
    if (spot >> k & 1)
      status = carom_spot_ball(table, balls, count, k);
}

/* The ball of a rack of 15 that does not fall; 0: all fall. */
static int fifteenth_of(uint32_t spot) {
  int fifteenth = 0;
  for (int k = 1; k <= LAST_BALL; k++)
    if (!(spot >> k & 1))
      fifteenth = k;
  return fifteenth;
}

static void take_up(carom_shot_ball *ball) {
  ball->state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
}

/* Puts a ball on the head spot, or on the centre where the head spot is taken. */
static void place_at_head(const carom_table *table, carom_shot_ball *balls, int count, int ball,
                          const double head[2], bool is_occupied) {
  const double centre[2] = {0.5 * table->width, 0.5 * table->length};
  const double *spot = head;
  if (is_occupied)
    spot = centre;
  carom_place_ball(table, balls, count, ball, spot[0], spot[1], NULL);
}

/* Puts the balls of the set on the positions of the triangle: all 15 as in eight-ball, with the
 * eight in the middle and unlike balls in the corners; 14 in their order, with the front one
 * free. */
static void rack_up(const carom_table *table, carom_shot_ball *balls, int count, uint32_t spot,
                    double place[LAST_BALL][2]) {
  static const int of_place[LAST_BALL] = {1, 9, 2, 10, 8, 3, 11, 7, 14, 4, 5, 13, 15, 6, 12};
  int n = spot != object_balls; /* with 14 balls the front position stays free */
  for (int k = 1; k <= LAST_BALL; k++) {
    int ball = k;
    if (spot == object_balls)
      ball = of_place[n];
    if (spot >> ball & 1) {
      carom_place_ball(table, balls, count, ball, place[n][0], place[n][1], NULL);
      n++;
    }
  }
}

/* Whether balls that return are racked: 14 or all 15 of them, in straight pool or as a break. */
static bool is_racked(const carom_rules_state *game, uint32_t spot, int count) {
  const bool racks = game->target > 0 || game->opening != 0;
  return racks && carom_count_of(spot) >= RACKED && count > LAST_BALL;
}

/* Racks 14 balls without the front one, or all 15. The fifteenth leaves the rack for the head spot,
 * or for the centre where the cue ball is there. A cue ball in the rack is in hand; but with the
 * fifteenth behind the head string it goes to the head spot, or to the centre where the fifteenth
 * is there. With both in the rack all 15 are racked. */
void carom_settle_rack(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                       int count, carom_turn *turn) {
  uint32_t spot = turn->spot;
  if (!is_racked(game, spot, count)) {
    spot_each(table, balls, count, spot);
    return;
  }

  /* who is where */
  const double R = balls[1].kind.radius;
  double place[LAST_BALL][2], head[2] = {0.0, 0.0};
  places_of(table, R, place);
  carom_spot_of(CAROM_RACK_EIGHTBALL, table, 0, head);
  const int fifteenth = fifteenth_of(spot);
  const bool in_hand = turn->leave == CAROM_LEAVE_KITCHEN;
  const bool cue_in_rack = is_in_rack(&balls[0], place);
  const bool fifteenth_in_rack = fifteenth > 0 && is_in_rack(&balls[fifteenth], place);
  if (cue_in_rack && fifteenth_in_rack)
    spot = turn->spot = object_balls;

  /* all that is racked, and a cue ball that is in hand, make room */
  if (in_hand || cue_in_rack || spot & 1)
    take_up(&balls[0]);
  for (int k = 1; k <= LAST_BALL; k++)
    if (spot >> k & 1)
      take_up(&balls[k]);
  if (fifteenth_in_rack && !cue_in_rack) {
    const bool is_occupied = is_near(balls[0].state.r, head, R) && !in_hand;
    place_at_head(table, balls, count, fifteenth, head, is_occupied);
  }
  rack_up(table, balls, count, spot, place);

  /* a cue ball that was in the rack */
  if (!cue_in_rack || in_hand)
    return;
  const double *last = balls[fifteenth].state.r;
  const bool behind = spot != object_balls && last[1] < head[1];
  const bool on_head = spot != object_balls && is_near(last, head, R);
  if (on_head || behind)
    place_at_head(table, balls, count, 0, head, on_head);
  else
    turn->leave = CAROM_LEAVE_KITCHEN;
}

CAROM_RULES_OBJECT(carom_straight) = {.state = {.target = 100},
                                      .on = carom_on_any,
                                      .judge = judge,
                                      .left = left,
                                      .race = CAROM_RACE_POINTS,
                                      .breaks = 2,
                                      .settle = carom_settle_rack,
                                      .rack = CAROM_RACK_EIGHTBALL};
