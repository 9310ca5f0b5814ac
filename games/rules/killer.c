/* Killer: 2 to 8 seats, each for itself. No federation has rules of it; clubs and the descriptions
 * of their pages agree on these: each seat has three lives and plays one stroke in rotation. A
 * stroke that pots no ball, or is a foul, costs a life, and the last seat with one wins. Any ball
 * may be met, and no cushion is needed. After a scratch the cue ball is in hand anywhere. A break
 * without a pot costs nothing, and the same seat plays again. When all balls are down, they are
 * racked for the next seat.
 *
 * Clubs differ: here a scratch costs one life, not two, and no ball gives a life back. Balls that
 * fall on a foul stay down, and those that left the table return, on which no page speaks. */
#include "games.h"
#include "rules.h"

static const uint32_t object_balls = 0xfffe;

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  (void)call;
  const uint32_t balls = in_play & object_balls, fell = facts->down & balls;
  const bool opening = game->opening != 0;
  carom_turn turn = carom_pass;
  turn.foul = (int32_t)carom_foul_of(facts, balls, cue_ball);
  turn.spot = facts->off & balls;
  if (turn.foul == CAROM_FOUL_CUSHION)
    turn.foul = CAROM_FOUL_NONE;
  if (turn.foul == CAROM_FOUL_CUE_BALL)
    turn.leave = CAROM_LEAVE_ANYWHERE;
  game->opening = 0;
  const bool makes_none = turn.foul != CAROM_FOUL_NONE || fell == 0;
  if (opening && turn.foul == CAROM_FOUL_NONE && makes_none)
    return carom_keep;
  uint64_t *lives = &game->user[carom_seat_of(game)];
  if (makes_none && *lives > 0)
    --*lives;
  if (fell == balls) {
    game->opening = 1;
    turn.leave = CAROM_LEAVE_KITCHEN;
    turn.spot = object_balls;
  }
  return carom_give_seat(game, turn);
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  (void)game, (void)in_play;
  needed[0] = needed[1] = 1;
}

enum { LIVES_MOST = 16 };

/* The lives that a seat has lost after some rounds, in each of which it loses one with the chance
 * `usual`, a guess. They are binomial: chance[i] is the chance of i lives, and the last one of
 * all. */
typedef struct lives_lost {
  double chance[LIVES_MOST + 1];
  int last;
} lives_lost;

static lives_lost none_lost(uint64_t lives) {
  return (lives_lost){{1.0}, (int)carom_min((int64_t)(lives & INT32_MAX), LIVES_MOST)};
}

static void play_round(lives_lost *lost) {
  static const double usual = 0.4;
  double *chance = lost->chance;
  const int last = lost->last;
  chance[last] += usual * chance[last - (last > 0)];
  for (int i = last - 1; i >= 0; i--) {
    chance[i] *= 1.0 - usual;
    if (i > 0)
      chance[i] += usual * chance[i - 1];
  }
}

/* The seat at the table plays first in each round, so that it wins if it loses its last life in a
 * later round than all others. */
static double value(const carom_rules_state *game, const carom_ball_state *layout, int count,
                    int in_hand) {
  (void)layout, (void)count, (void)in_hand;
  enum { ROUNDS = 60 };
  const int own = carom_seat_of(game);
  lives_lost lost[CAROM_SEATS_MOST];
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++)
    lost[seat] = none_lost(game->user[seat]);
  double sum = 0.0, out = lost[own].chance[lost[own].last];
  for (int round = 1; round <= ROUNDS; round++) {
    play_round(&lost[own]);
    const double later = lost[own].chance[lost[own].last];
    double others = later - out;
    for (int seat = 0; seat < CAROM_SEATS_MOST; seat++) {
      if (seat == own || game->user[seat] == 0)
        continue;
      others *= lost[seat].chance[lost[seat].last];
      play_round(&lost[seat]);
    }
    sum += others;
    out = later;
  }
  return sum;
}

CAROM_RULES_OBJECT(carom_killer) = {.state = {.user = {3, 3}},
                                    .on = carom_on_any,
                                    .judge = judge,
                                    .left = left,
                                    .value = value,
                                    .race = CAROM_RACE_SEATS,
                                    .breaks = 1,
                                    .settle = carom_settle_rack,
                                    .rack = CAROM_RACK_EIGHTBALL};
