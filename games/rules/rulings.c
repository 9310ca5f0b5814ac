/* What the rulings of all games share: fouls, and balls that are put back. */
#include "rules.h"
#include "table/marks.h"

#include <math.h>
#include <stddef.h>

static void swap(int32_t pair[2]) {
  const int32_t first = pair[0];
  pair[0] = pair[1];
  pair[1] = first;
}

uint32_t carom_on_any(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return in_play & 0xfffe;
}

carom_turn carom_give(carom_rules_state *game, carom_turn turn) {
  swap(game->fouls);
  swap(game->score);
  swap(game->lost);
  swap(game->pocket);
  return turn;
}

carom_turn carom_give_seat(carom_rules_state *game, carom_turn turn) {
  int seats = 0, next = carom_seat_of(game);
  for (int step = CAROM_SEATS_MOST; step > 0; step--) {
    const int seat = (carom_seat_of(game) + step) % CAROM_SEATS_MOST;
    if (game->user[seat] != 0) {
      seats++;
      next = seat;
    }
  }
  if (seats <= 1)
    turn = (carom_turn){CAROM_TURN_WIN, CAROM_LEAVE_AFTER, turn.foul, 0, 0.0};
  if (turn.outcome != CAROM_TURN_KEEP)
    game->seat = next;
  return turn;
}

carom_turn carom_pass_by(int32_t foul) {
  carom_turn turn = carom_pass;
  turn.foul = foul;
  if (foul == CAROM_FOUL_CUE_BALL)
    turn.leave = CAROM_LEAVE_KITCHEN;
  return turn;
}

bool carom_racks_again(carom_rules_state *game, int32_t call, uint32_t object_balls,
                       carom_turn *turn) {
  static const struct {
    int32_t call, choice;
  } choices[] = {{CAROM_CALL_RACK, CAROM_CHOICE_RACK},
                 {CAROM_CALL_OTHER_RACK, CAROM_CHOICE_OTHER_RACK},
                 {CAROM_CALL_STAY, CAROM_CHOICE_STAY}};
  bool chosen = false;
  for (size_t k = 0; k < sizeof choices / sizeof choices[0]; k++)
    chosen |= call == choices[k].call && (game->may & choices[k].choice) != 0;
  if (!chosen)
    return false;
  game->may = 0;
  *turn = carom_keep;
  if (call == CAROM_CALL_STAY)
    return true;
  game->opening = 1;
  game->free_ball = 0;
  turn->leave = CAROM_LEAVE_KITCHEN;
  turn->spot = object_balls;
  if (call == CAROM_CALL_OTHER_RACK) {
    turn->outcome = CAROM_TURN_PASS;
    carom_give(game, *turn);
  }
  return true;
}

int carom_cue_ball_of(const carom_plan_rules *rules) {
  const bool is_personal =
      rules != NULL && (rules->own_cue_balls != 0 || rules->rack == CAROM_RACK_THREECUSHION ||
                        rules->rack == CAROM_RACK_FOURBALL);
  return is_personal && rules->state.group == 2;
}

uint32_t carom_met_first(const carom_facts *facts) {
  if (facts->first[0] < 0 || facts->first[0] >= CAROM_BALLS_MOST)
    return 0;
  return facts->first_set | UINT32_C(1) << facts->first[0];
}

/* Balls up to a line that the cue ball has not crossed, as a set. */
static uint32_t behind_line(const carom_facts *facts, double line, const carom_shot_ball *balls,
                            int count) {
  uint32_t set = 0;
  for (int k = 0; k < count && !(facts->first_high[1] > line); k++)
    set |= (uint32_t)(balls[k].state.r[1] < line) << k;
  return set;
}

uint32_t carom_barred_from(const carom_plan_rules *rules, carom_leave leave,
                           const carom_facts *facts, const carom_table *table,
                           const carom_shot_ball *balls, int count) {
  const carom_marks marks = carom_marks_of(table->width, table->length);
  if (leave == CAROM_LEAVE_KITCHEN)
    return behind_line(facts, marks.head_spot[1], balls, count);
  if (leave == CAROM_LEAVE_D && rules->rack == CAROM_RACK_BILLIARDS)
    return behind_line(facts, marks.d_centre[1], balls, count);
  return 0;
}

uint32_t carom_nearest_behind(const carom_table *table, const carom_shot_ball *balls, int count,
                              uint32_t targets) {
  const double head = 0.25 * table->length;
  double nearest = -INFINITY;
  for (int k = 0; k < count; k++)
    if (targets >> k & 1)
      nearest = fmax(nearest, balls[k].state.r[1]);
  uint32_t set = 0;
  for (int k = 0; k < count && nearest < head; k++)
    if (balls[k].state.r[1] > nearest - CAROM_RULES_TOUCH)
      set |= targets & carom_only(k);
  return set;
}

int carom_first_of(const carom_facts *facts, uint32_t choice) {
  const uint32_t touching = facts->frozen & ~facts->pushed & choice;
  const int first = facts->first[0];
  if (touching == 0 || (first >= 0 && touching >> first & 1))
    return first;
  return carom_count_of(carom_lowest_of(touching) - 1);
}

static bool is_out(const carom_shot_ball *ball) {
  return ball->state.label == CAROM_BALL_POCKETED || ball->state.label == CAROM_BALL_OFF;
}

uint32_t carom_on_table(const carom_shot_ball *balls, int count) {
  uint32_t set = 0;
  for (int k = 0; k < count; k++)
    if (!is_out(&balls[k]))
      set |= UINT32_C(1) << k;
  return set;
}

uint32_t carom_touching(const carom_shot_ball *balls, int count, int ball) {
  uint32_t set = 0;
  for (int k = 0; k < count && !is_out(&balls[ball]); k++) {
    const double reach = balls[k].kind.radius + balls[ball].kind.radius + CAROM_RULES_TOUCH;
    const bool is_near = carom_square(balls[k].state.r, balls[ball].state.r) < reach * reach;
    if (k != ball && !is_out(&balls[k]) && is_near)
      set |= UINT32_C(1) << k;
  }
  return set;
}

/* Among balls that are met at one instant, a ball that is on is assumed to be the first (WPA,
 * regulations for referees, split hits). */
carom_foul carom_foul_of(const carom_facts *facts, uint32_t on, int cue_ball) {
  if (facts == NULL)
    return CAROM_FOUL_NO_BALL;
  const uint32_t first = carom_met_first(facts);
  const bool is_ball = cue_ball >= 0 && cue_ball < CAROM_BALLS_MOST;
  if (is_ball && ((facts->down | facts->off) >> cue_ball & 1) != 0)
    return CAROM_FOUL_CUE_BALL;
  if (first == 0)
    return CAROM_FOUL_NO_BALL;
  if ((on & ~facts->barred & first) == 0)
    return CAROM_FOUL_FIRST;
  if (facts->off != 0)
    return CAROM_FOUL_OFF;
  if (carom_is_double_hit(facts))
    return CAROM_FOUL_DOUBLE_HIT;
  if (facts->down == 0 && facts->cushions_after == 0)
    return CAROM_FOUL_CUSHION;
  return CAROM_FOUL_NONE;
}

/* ---- Balls that are put back */

/* How far from a ball another one is put next to it, m: a ball of pool is frozen to an object ball
 * (WPA 1.4); next to the cue ball, in snooker (WPBSA, section 3, spotting colours) and in pyramid
 * it must not touch, so it is put as near as clearly separate balls. */
static double room_beside(carom_rack_kind kind, int neighbour) {
  if (kind != CAROM_RACK_SNOOKER && kind != CAROM_RACK_PYRAMID && neighbour != 0)
    return 0.0;
  return 2.0 * CAROM_RULES_TOUCH;
}

/* Where a ball at x on the long string is behind another one on a side, y: their centres are
 * then at least the sum of the radii and a gap apart, by as little as doubles allow. */
static double place_beside(const carom_shot_ball *ball, const carom_shot_ball *neighbour, double x,
                           int side, double gap) {
  const double both = ball->kind.radius + neighbour->kind.radius + gap;
  const double across = x - neighbour->state.r[0], centre = neighbour->state.r[1];
  const double y = centre + side * sqrt(fmax(both * both - across * across, 0.0));
  return y + side * 4e-16 * (1.0 + fabs(y));
}

/* As near to a position as there is room, towards y = length, else away from it. */
static carom_status put_near(carom_rack_kind kind, const carom_table *table, carom_shot_ball *balls,
                             int count, int ball, const double place[2]) {
  const double step = fmax(1e-4 * table->length, 1e-3);
  carom_status status = CAROM_ERROR_OFF_TABLE;
  for (int side = 1; side >= -1; side -= 2) {
    double y = place[1];
    while (y > 0.0 && y < table->length) {
      carom_part obstacle;
      status = carom_place_ball(table, balls, count, ball, place[0], y, &obstacle);
      if (status != CAROM_ERROR_OVERLAP && status != CAROM_ERROR_OFF_TABLE)
        return status;

      /* to behind a ball that is there, or past a part of the table */
      const double previous = y;
      if (status == CAROM_ERROR_OVERLAP && obstacle.kind == CAROM_PART_BALL)
        y = place_beside(&balls[ball], &balls[obstacle.index], place[0], side,
                         room_beside(kind, obstacle.index));
      if (!((y - previous) * side > 0.0))
        y = previous + side * step;
    }
  }
  return status;
}

carom_status carom_spot_ball(const carom_table *table, carom_shot_ball *balls, int count,
                             int ball) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  const carom_marks marks = carom_marks_of(table->width, table->length);
  return put_near(CAROM_RACK_EIGHTBALL, table, balls, count, ball, marks.foot_spot);
}

carom_status carom_spot_ball_of(carom_rack_kind kind, const carom_table *table,
                                carom_shot_ball *balls, int count, int ball) {
  /* in pyramid the ball that opens returns as the others do */
  int spot_ball = ball;
  if (kind == CAROM_RACK_PYRAMID && ball == 0)
    spot_ball = 1;
  double home[2], place[2];
  const carom_status error = carom_spot_of(kind, table, spot_ball, home);
  if (error != CAROM_OK)
    return error;

  /* a colour: its own spot, then the others, the highest first */
  enum { YELLOW = 16, BLACK = 21 };
  const bool colour = kind == CAROM_RACK_SNOOKER && ball >= YELLOW;
  for (int tried = BLACK + 1; tried >= YELLOW && colour; tried--) {
    int spot = tried;
    if (tried > BLACK)
      spot = ball;
    carom_spot_of(kind, table, spot, place);
    const carom_status status =
        carom_place_ball(table, balls, count, ball, place[0], place[1], NULL);
    if (status != CAROM_ERROR_OVERLAP)
      return status;
  }
  return put_near(kind, table, balls, count, ball, home);
}

/* All balls of a rack are placed as at first, and keep their kinds. The cue ball is in hand. */
static carom_status rack_again(carom_rack_kind rack, const carom_table *table,
                               carom_shot_ball *balls, int count) {
  const double gap = 1e-4; /* the rack of a match */
  carom_shot_ball racked[CAROM_BALLS_MOST];
  const carom_status error = carom_rack(rack, table, gap, 1, racked, CAROM_BALLS_MOST);
  if (error != CAROM_OK)
    return error;
  for (int k = 0; k < count && k < carom_rack_size(rack); k++)
    balls[k].state = racked[k].state;
  return CAROM_OK;
}

carom_status carom_turn_settle(const carom_plan_rules *rules, carom_rules_state *game,
                               const carom_table *table, carom_shot_ball *balls, int count,
                               carom_turn *turn) {
  if (rules == NULL || game == NULL || table == NULL || balls == NULL || turn == NULL)
    return CAROM_ERROR_NULL;
  if (count < 0 || count > CAROM_BALLS_MOST || (uint64_t)turn->spot >> count != 0)
    return CAROM_ERROR_BALLS;
  if (rules->settle != NULL) {
    rules->settle(game, table, balls, count, turn);
    return CAROM_OK;
  }
  const carom_rack_kind rack = (carom_rack_kind)rules->rack;
  if (game->opening != 0 && carom_count_of(turn->spot) == carom_rack_size(rack) - 1)
    return rack_again(rack, table, balls, count);
  carom_status first = CAROM_OK;
  for (int k = 0; turn->spot >> k != 0; k++) {
    if (!(turn->spot >> k & 1))
      continue;
    const carom_status status = carom_spot_ball_of(rack, table, balls, count, k);
    if (first == CAROM_OK)
      first = status;
  }
  return first;
}

/* ---- Games of eight balls of fifteen */

void carom_count_ball(carom_rules_state *game, int seat) {
  if (game->lost[seat] > 0)
    game->lost[seat]--;
  else
    carom_add(&game->score[seat], 1);
}

void carom_pay_ball(carom_rules_state *game) {
  if (game->score[0] > 0)
    game->score[0]--;
  else
    carom_add(&game->lost[0], 1);
}

bool carom_is_third_foul(carom_rules_state *game, bool foul) {
  enum { FOULS_MOST = 3 };
  if (!foul)
    game->fouls[0] = 0;
  carom_add(&game->fouls[0], foul);
  const bool third = game->fouls[0] >= FOULS_MOST;
  if (third)
    game->fouls[0] = 0;
  return third;
}

/* A number between 0 and the most. */
static int32_t clamped(int32_t x, int32_t most) {
  return (int32_t)carom_max(carom_min(x, most), 0);
}

/* With those that are owed; of states that no game has, at least one and at most 16. */
void carom_left_of_eight(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int seat = 0; seat < 2; seat++) {
    const int32_t score = clamped(game->score[seat], CAROM_BALLS_THAT_WIN - 1);
    const int32_t owed = clamped(game->lost[seat], CAROM_BALLS_THAT_WIN);
    needed[seat] = CAROM_BALLS_THAT_WIN - score + owed;
  }
}

/* The balls that return: as many as are down and count for no one, those of `first` before
 * others. The numbers of balls mean nothing in this game. */
uint32_t carom_back_of(const carom_rules_state *game, uint32_t down, uint32_t first) {
  const int64_t counted = (int64_t)game->score[0] + game->score[1];
  uint32_t back = 0;
  for (int64_t n = carom_count_of(down); n > counted && n > 0; n--) {
    uint32_t source = first & ~back;
    if (source == 0)
      source = down & ~back;
    back |= carom_lowest_of(source);
  }
  return back;
}
