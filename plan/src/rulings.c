/* What the rulings of all games share: fouls, and balls that are put back. */
#include "rules.h"

#include <stddef.h>

static void swap(int32_t pair[2]) {
  const int32_t kept = pair[0];
  pair[0] = pair[1];
  pair[1] = kept;
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

carom_foul carom_foul_of(const carom_facts *facts, uint32_t on, int cue_ball) {
  if (facts == NULL)
    return CAROM_FOUL_NO_BALL;
  const int first = facts->first[0];
  const bool is_ball = cue_ball >= 0 && cue_ball < CAROM_BALLS_MOST;
  if (is_ball && ((facts->down | facts->off) >> cue_ball & 1) != 0)
    return CAROM_FOUL_CUE_BALL;
  if (first < 0 || first >= CAROM_BALLS_MOST)
    return CAROM_FOUL_NO_BALL;
  if (!(on >> first & 1))
    return CAROM_FOUL_FIRST;
  if (facts->off != 0)
    return CAROM_FOUL_OFF;
  if (carom_is_double_hit(facts))
    return CAROM_FOUL_DOUBLE_HIT;
  if (facts->down == 0 && facts->cushions_after == 0)
    return CAROM_FOUL_CUSHION;
  return CAROM_FOUL_NONE;
}

const char *carom_foul_string(int foul) {
  static const char *const words[] = {
      "",
      "the cue ball fell or left the table",
      "the cue ball met no ball",
      "the cue ball met another ball first than one that is on",
      "a ball left the table",
      "nothing fell, and nothing met a cushion after the first contact",
      "the break potted nothing, and drove too few balls to cushions",
      "another rule",
      "a ball fell that was not on",
      "the tip was still on the cue ball, or touched it again, as it met a ball"};
  return foul > 0 && foul < (int)(sizeof words / sizeof words[0]) ? words[foul] : "";
}

/* ---- Balls that are put back */

/* As near to a place as there is room, towards y = length, else away from it. */
static carom_status put_near(const carom_table *table, carom_shot_ball *balls, int count, int ball,
                             const double at[2]) {
  const double step = table->length > 10.0 ? 1e-4 * table->length : 1e-3;
  carom_status status = CAROM_ERROR_OFF_TABLE;
  for (int side = 1; side >= -1; side -= 2)
    for (double y = at[1]; y > 0.0 && y < table->length; y += side * step) {
      status = carom_place_ball(table, balls, count, ball, at[0], y, NULL);
      if (status != CAROM_ERROR_OVERLAP && status != CAROM_ERROR_OFF_TABLE)
        return status;
    }
  return status;
}

carom_status carom_spot_ball(const carom_table *table, carom_shot_ball *balls, int count,
                             int ball) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  const double foot[2] = {0.5 * table->width, 0.75 * table->length};
  return put_near(table, balls, count, ball, foot);
}

carom_status carom_spot_ball_of(carom_rack_kind kind, const carom_table *table,
                                carom_shot_ball *balls, int count, int ball) {
  double own[2], at[2];
  const carom_status bad = carom_spot_of(kind, table, ball, own);
  if (bad != CAROM_OK)
    return bad;

  /* a colour: its own spot, then the others, the highest first */
  enum { YELLOW = 16, BLACK = 21 };
  const bool colour = kind == CAROM_RACK_SNOOKER && ball >= YELLOW;
  for (int k = BLACK + 1; k >= YELLOW && colour; k--) {
    carom_spot_of(kind, table, k > BLACK ? ball : k, at);
    const carom_status status = carom_place_ball(table, balls, count, ball, at[0], at[1], NULL);
    if (status != CAROM_ERROR_OVERLAP)
      return status;
  }
  return put_near(table, balls, count, ball, own);
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
  carom_status first = CAROM_OK;
  for (int k = 0; turn->spot >> k != 0; k++) {
    const bool back = turn->spot >> k & 1;
    const carom_status status =
        back ? carom_spot_ball_of((carom_rack_kind)rules->rack, table, balls, count, k) : CAROM_OK;
    first = first == CAROM_OK ? status : first;
  }
  return first;
}

/* ---- Games of eight balls of fifteen */

void carom_count_ball(carom_rules_state *game, int who) {
  if (game->lost[who] > 0)
    game->lost[who]--;
  else
    carom_add(&game->score[who], 1);
}

void carom_pay_ball(carom_rules_state *game) {
  if (game->score[0] > 0)
    game->score[0]--;
  else
    carom_add(&game->lost[0], 1);
}

/* A number between 0 and the most. */
static int32_t clamped(int32_t x, int32_t most) {
  if (x < 0)
    return 0;
  return x < most ? x : most;
}

/* With those that are owed; of states that no game has, at least one and at most 16. */
void carom_left_of_eight(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int who = 0; who < 2; who++) {
    const int32_t own = clamped(game->score[who], CAROM_BALLS_THAT_WIN - 1);
    const int32_t owed = clamped(game->lost[who], CAROM_BALLS_THAT_WIN);
    needed[who] = CAROM_BALLS_THAT_WIN - own + owed;
  }
}

/* The balls that come back: as many as are down and count for no one, those of `first` before
 * others. The numbers of balls mean nothing in this game. */
uint32_t carom_back_of(const carom_rules_state *game, uint32_t down, uint32_t first) {
  const int64_t counted = (int64_t)game->score[0] + game->score[1];
  uint32_t back = 0;
  for (int64_t n = carom_count_of(down); n > counted && n > 0; n--) {
    const uint32_t from = (first & ~back) != 0 ? first & ~back : down & ~back;
    back |= from & (~from + 1);
  }
  return back;
}
