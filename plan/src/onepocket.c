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

/* Words of the state. */
enum { POCKETS = 0, OWN = 2, OTHER = 3, OWED = 5, OWED_OTHER = 6, FOULS = 7 };
enum { POCKET = 8, BALLS = 15, BALLS_THAT_WIN = 8, FOULS_MOST = 3 };
static const uint32_t all = 0xfffe;

static int pocket_of(const uint64_t *user, int who) {
  return (int)((who == 0 ? user[POCKETS] : user[POCKETS] / POCKET) % POCKET);
}

static uint32_t on(const uint64_t *user, uint32_t in_play) {
  (void)user;
  return in_play & all;
}

static uint32_t pockets(const uint64_t *user) {
  return UINT32_C(1) << pocket_of(user, 0);
}

/* With those that are owed; of states that no game has, at least one and at most 16. */
static void left(const uint64_t *user, uint32_t in_play, int32_t needed[2]) {
  (void)in_play;
  for (int who = 0; who < 2; who++) {
    const uint64_t own = user[OWN + who], owed = user[OWED + who];
    needed[who] = (own < BALLS_THAT_WIN ? BALLS_THAT_WIN - (int32_t)own : 1) +
                  (owed < BALLS_THAT_WIN ? (int32_t)owed : BALLS_THAT_WIN);
  }
}

/* The turn goes to the other: the state becomes his. */
static carom_turn give(uint64_t *user, carom_turn turn) {
  carom_swap(&user[OWN], &user[OTHER]);
  carom_swap(&user[OWED], &user[OWED_OTHER]);
  user[POCKETS] = (uint64_t)(POCKET * pocket_of(user, 0) + pocket_of(user, 1));
  user[FOULS] = user[FOULS] >> 2 | (user[FOULS] & 3) << 2;
  return turn;
}

/* The balls that come back: as many as are down and count for no one, those of `first` before
 * others. The numbers of balls mean nothing in this game. */
static uint32_t back_of(const uint64_t *user, uint32_t down, uint32_t first) {
  const uint64_t counted = user[OWN] + user[OTHER];
  uint32_t back = 0;
  for (uint64_t n = (uint64_t)carom_count_of(down); n > counted; n--) {
    const uint32_t from = (first & ~back) != 0 ? first & ~back : down & ~back;
    back |= from & (~from + 1);
  }
  return back;
}

static carom_turn judge(uint64_t *user, uint32_t in_play, int cue_ball, const carom_facts *facts,
                        carom_call call) {
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
      if ((facts->down & balls) >> k & 1 && facts->pocket[k] == pocket_of(user, who)) {
        in[who] |= UINT32_C(1) << k;
        if (user[OWED + who] > 0)
          user[OWED + who]--;
        else
          user[OWN + who]++;
      }
  turn.points = carom_count_of(in[0]);

  /* a foul costs a ball */
  user[FOULS] = foul ? user[FOULS] + 1 : user[FOULS] & ~UINT64_C(3);
  if (foul && user[OWN] > 0)
    user[OWN]--;
  else if (foul)
    user[OWED]++;

  /* the end of the game, or of the visit */
  const uint32_t remain = balls & ~gone;
  if (!foul && user[OWN] >= BALLS_THAT_WIN)
    turn.is = CAROM_TURN_WIN;
  else if (user[OTHER] >= BALLS_THAT_WIN || (user[FOULS] & 3) >= FOULS_MOST)
    turn.is = CAROM_TURN_LOSE;
  else if (in[0] != 0)
    turn.is = CAROM_TURN_KEEP;
  if (turn.is == CAROM_TURN_PASS || (turn.is == CAROM_TURN_KEEP && remain == 0))
    turn.spot = back_of(user, all & ~remain, gone & ~(in[0] | in[1]));
  return turn.is == CAROM_TURN_PASS ? give(user, turn) : turn;
}

static void settle(uint64_t *user, const carom_table *table, carom_shot_ball *balls, int count,
                   carom_turn *turn) {
  (void)user;
  carom_put_back(table, balls, count, turn->spot);
}

/* To begin with, the pockets at the foot of a table of carom_table_make(): 5 and 2. */
const carom_plan_rules carom_onepocket = {.user = {[POCKETS] = 5 + POCKET * 2},
                                          .on = on,
                                          .judge = judge,
                                          .left = left,
                                          .pockets = pockets,
                                          .race = CAROM_RACE_OWN,
                                          .settle = settle,
                                          .rack = CAROM_RACK_EIGHTBALL};
