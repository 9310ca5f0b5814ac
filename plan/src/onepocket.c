/* One-pocket: the rules of OnePocket.org, which are those of the BCA, under the general rules of
 * the WPA.
 *
 * Each player has one of the two pockets at the foot. A ball in it counts for him, whoever played,
 * and eight win. The turn goes on with a ball in one's own pocket. Balls that count for no one come
 * back at the end of the visit, or when no other is left. A foul costs one ball; who has none owes
 * one, and his next ball does not count. On a foul the own pocket does not count, nor any pocket
 * where the cue ball is gone. A third foul in a row loses; of two eighth balls that of the shooter
 * wins. */
#include "rules.h"

enum { BALLS = 15, BALLS_THAT_WIN = 8, FOULS_MOST = 3 };
static const uint32_t all = 0xfffe;

static uint32_t on(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return in_play & all;
}

static uint32_t pockets(const carom_rules_state *game) {
  return UINT32_C(1) << (game->pocket[0] & (CAROM_POCKETS_MOST - 1));
}

/* With those that are owed; of states that no game has, at least one and at most 16. */
static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int who = 0; who < 2; who++) {
    const int32_t own = game->score[who], owed = game->lost[who];
    needed[who] = (own < BALLS_THAT_WIN ? BALLS_THAT_WIN - (own > 0 ? own : 0) : 1) +
                  (owed < BALLS_THAT_WIN ? (owed > 0 ? owed : 0) : BALLS_THAT_WIN);
  }
}

/* The turn goes to the other: the state becomes his. */
static carom_turn give(carom_rules_state *game, carom_turn turn) {
  carom_swap(game->score);
  carom_swap(game->lost);
  carom_swap(game->pocket);
  carom_swap(game->fouls);
  return turn;
}

/* The balls that come back: as many as are down and count for no one, those of `first` before
 * others. The numbers of balls mean nothing in this game. */
static uint32_t back_of(const carom_rules_state *game, uint32_t down, uint32_t first) {
  const int64_t counted = (int64_t)game->score[0] + game->score[1];
  uint32_t back = 0;
  for (int64_t n = carom_count_of(down); n > counted && n > 0; n--) {
    const uint32_t from = (first & ~back) != 0 ? first & ~back : down & ~back;
    back |= from & (~from + 1);
  }
  return back;
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  (void)call;
  const uint32_t balls = in_play & all, gone = (facts->down | facts->off) & balls;
  const int32_t bad = (int32_t)carom_foul_of(facts, balls, cue_ball);
  const bool foul = bad != CAROM_FOUL_NONE, scratch = bad == CAROM_FOUL_CUE_BALL;
  carom_turn turn = {.is = CAROM_TURN_PASS,
                     .leave = scratch ? CAROM_LEAVE_KITCHEN : CAROM_LEAVE_AFTER,
                     .foul = bad};

  /* balls in the pockets of both, where these count; one that is owed is paid first */
  uint32_t in[2] = {0, 0};
  for (int who = 0; who < 2; who++)
    for (int k = 1; k <= BALLS && !(who == 0 ? foul : scratch); k++)
      if ((facts->down & balls) >> k & 1 && facts->pocket[k] == game->pocket[who]) {
        in[who] |= UINT32_C(1) << k;
        if (game->lost[who] > 0)
          game->lost[who]--;
        else
          carom_add(&game->score[who], 1);
      }
  turn.points = carom_count_of(in[0]);

  /* a foul costs a ball */
  game->fouls[0] = foul ? game->fouls[0] : 0;
  carom_add(&game->fouls[0], foul);
  if (foul && game->score[0] > 0)
    game->score[0]--;
  else
    carom_add(&game->lost[0], foul);

  /* the end of the game, or of the visit */
  const uint32_t remain = balls & ~gone;
  if (!foul && game->score[0] >= BALLS_THAT_WIN)
    turn.is = CAROM_TURN_WIN;
  else if (game->score[1] >= BALLS_THAT_WIN || game->fouls[0] >= FOULS_MOST)
    turn.is = CAROM_TURN_LOSE;
  else if (in[0] != 0)
    turn.is = CAROM_TURN_KEEP;
  if (turn.is == CAROM_TURN_PASS || (turn.is == CAROM_TURN_KEEP && remain == 0))
    turn.spot = back_of(game, all & ~remain, gone & ~(in[0] | in[1]));
  return turn.is == CAROM_TURN_PASS ? give(game, turn) : turn;
}

static void settle(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                   int count, carom_turn *turn) {
  (void)game;
  carom_put_back(table, balls, count, turn->spot);
}

/* To begin with, the pockets at the foot of a table of carom_table_make(): 5 and 2. */
const carom_plan_rules carom_onepocket = {.state = {.pocket = {5, 2}},
                                          .on = on,
                                          .judge = judge,
                                          .left = left,
                                          .pockets = pockets,
                                          .race = CAROM_RACE_OWN,
                                          .settle = settle,
                                          .rack = CAROM_RACK_EIGHTBALL};
