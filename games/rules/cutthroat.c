/* Cut-throat, or elimination: the rules of the BCA (2002, as billiardsforum.com prints them), under
 * its general rules of pocket billiards, without calls.
 *
 * Three seats have five balls each, or five seats three, in the order of the numbers. The cue ball
 * meets a ball of another seat first. A ball that falls without a foul keeps the turn, also one's
 * own, but for the last of them, behind which the turn ends. A seat without balls is out, and the
 * last one with a ball wins. A break pots a ball or drives four to cushions; else the next seat may
 * have a new rack, and break. After a foul, balls of others that fell return, and one's own stay
 * down. A foul also brings back a ball of each other seat, which may so be in again: that, and a
 * stroke that takes the last balls of all, are of descriptions on other pages, as of these rules
 * only the first half was at hand. A seat of which balls return from the stroke gets no further
 * one. Where the last balls of all fall at once, each that lost its last one then gets it back, and
 * the same seat plays on. The rack is as in eight-ball; by the rules the 1 is in front, the 6 and
 * the 11 in the corners, and the others anywhere. */
#include "games.h"
#include "rules.h"

static const uint32_t object_balls = 0xfffe;

/* The balls with which a seat begins, as target reports how many; and those that it has left. */
static uint32_t first_balls_of(const carom_rules_state *game, int seat) {
  const int64_t each = carom_min(carom_max(game->target, 1), 15);
  const uint64_t balls = (UINT64_C(1) << each) - 1;
  if (each * seat > 15)
    return 0;
  return (uint32_t)(balls << (1 + each * seat)) & object_balls;
}
static uint32_t balls_of(const carom_rules_state *game, int seat) {
  return (uint32_t)game->user[seat] & object_balls;
}

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  uint32_t own = 0;
  if (game->opening == 0)
    own = balls_of(game, carom_seat_of(game));
  return in_play & object_balls & ~own;
}

/* The lowest ball of each seat that has lost one; `seats` are those that get it. */
static uint32_t give_back(carom_rules_state *game, uint32_t seats, uint32_t in_play) {
  uint32_t back = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++) {
    const uint32_t lost = first_balls_of(game, seat) & ~balls_of(game, seat) & ~in_play;
    if (!(seats >> seat & 1) || lost == 0)
      continue;
    back |= carom_lowest_of(lost);
    game->user[seat] |= carom_lowest_of(lost);
  }
  return back;
}

/* A foul: the balls of others return, and one more for each seat without a returning ball. */
static carom_turn judge_foul(carom_rules_state *game, uint32_t balls, const carom_facts *facts,
                             int32_t foul) {
  const int own = carom_seat_of(game);
  const uint32_t own_down = facts->down & balls_of(game, own);
  carom_turn turn = carom_pass_by(foul);
  turn.spot = (facts->down | facts->off) & balls & ~own_down;
  game->user[own] &= ~(uint64_t)own_down;
  uint32_t seats = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++)
    seats |= (uint32_t)(seat != own && (turn.spot & first_balls_of(game, seat)) == 0) << seat;
  turn.spot |= give_back(game, seats, balls);
  if (foul == CAROM_FOUL_BREAK)
    game->may = CAROM_CHOICE_RACK;
  return carom_give_seat(game, turn);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & object_balls, fell = facts->down & balls;
  carom_turn turn;
  if (carom_racks_again(game, call.ball, object_balls, &turn))
    return turn;
  const int32_t foul =
      carom_rotation_foul_of(facts, targets_of(game, in_play), cue_ball, game->opening != 0, false);
  game->opening = game->may = 0;
  if (foul != CAROM_FOUL_NONE)
    return judge_foul(game, balls, facts, foul);

  /* the seats that lost their last ball, and whether any is left */
  uint32_t out = 0;
  uint64_t remain = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++) {
    const uint64_t before = game->user[seat];
    game->user[seat] &= ~(uint64_t)fell;
    out |= (uint32_t)(before != 0 && game->user[seat] == 0) << seat;
    remain |= game->user[seat];
  }
  turn = carom_pass;
  if (fell != 0)
    turn = carom_keep;
  if (remain == 0)
    turn.spot = give_back(game, out, 0);
  else if (balls_of(game, carom_seat_of(game)) == 0)
    turn.outcome = CAROM_TURN_PASS;
  return carom_give_seat(game, turn);
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  needed[0] = (int32_t)carom_max(carom_count_of(targets_of(game, in_play)), 1);
  needed[1] = 1;
}

/* A visit pots balls of others with a usual chance each, a guess. Behind it each seat wins by its
 * fraction of the balls, as if they fell in any order. */
static double value(const carom_rules_state *game, const carom_ball_state *layout, int count,
                    int in_hand) {
  (void)layout, (void)count, (void)in_hand;
  static const double usual = 0.6;
  const int own = carom_count_of(balls_of(game, carom_seat_of(game)));
  int all = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++)
    all += carom_count_of(balls_of(game, seat));
  if (own == 0)
    return 0.0;
  double sum = 0.0, so_far = 1.0;
  for (; all > own; all--) {
    sum += so_far * (1.0 - usual) * own / all;
    so_far *= usual;
  }
  return sum + so_far;
}

CAROM_RULES_OBJECT(carom_cut_throat) = {.state = {.target = 5, .user = {0x3e, 0x7c0, 0xf800}},
                                        .on = targets_of,
                                        .judge = judge,
                                        .left = left,
                                        .value = value,
                                        .race = CAROM_RACE_SEATS,
                                        .first_decides = 1,
                                        .breaks = 1,
                                        .rack = CAROM_RACK_EIGHTBALL};
