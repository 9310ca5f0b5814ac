/* Snooker: the rules of the WPBSA and IBSF, sections 2 and 3.
 *
 * Reds and colours alternately, then the colours from the lowest on. A foul gives the other the
 * value of the ball on, or of the highest ball that it concerns, at least 4; he may let the
 * offender play on. A player who is snookered after a foul may name any ball for one on: a free
 * ball. The first pot or foul on the last black ends the frame, but for equal scores: then the
 * black returns, and the other plays from the D; by the rules they draw lots. A player who reaches
 * the last black more than its seven points ahead claims the frame. Who plays away from a ball on
 * that touches the cue ball has met it first. To meet a ball before the tip has left the cue ball
 * is a push stroke, also at the very edge of a ball that nearly touches, which the rules allow:
 * facts do not show it. */
#include "games.h"
#include "rules.h"
#include "table/marks.h"

#include <math.h>

enum { YELLOW = 16, PINK = 20, BLACK = 21, COLOURS = 27, LEAST = 4, MOST = 7 };
static const uint32_t reds = 0xfffe, colours = 0x3f0000, black = UINT32_C(1) << BLACK;

static int worth(int ball) {
  if (ball < YELLOW)
    return 1;
  return ball - YELLOW + 2;
}

/* The value of the highest ball of a set; 0 of none. */
static int highest(uint32_t set) {
  for (int k = BLACK; k >= 1; k--)
    if (set >> k & 1)
      return worth(k);
  return 0;
}

/* The balls on, but for a free ball. */
static uint32_t due_of(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t red = in_play & reds, colour = in_play & colours;
  if (game->on != 0)
    return colour;
  if (red != 0)
    return red;
  return carom_lowest_of(colour);
}

static uint32_t targets_of(const carom_rules_state *game, uint32_t in_play) {
  if (game->may & CAROM_CHOICE_FREE_BALL)
    return in_play & (reds | colours);
  return due_of(game, in_play);
}

/* Points that are on the table, and in how many pots. */
static int remaining(const carom_rules_state *game, uint32_t in_play, int *pots) {
  const int red = carom_count_of(in_play & reds);
  const bool colour = game->on != 0;
  if (red > 0 || colour) {
    *pots = 2 * red + colour + 6;
    return 8 * red + 7 * colour + COLOURS;
  }
  int sum = 0;
  for (int k = YELLOW; k <= BLACK; k++)
    if (in_play >> k & 1)
      sum += worth(k);
  *pots = carom_count_of(in_play & colours);
  return sum;
}

static int64_t lead_of(const carom_rules_state *game) {
  return (int64_t)game->score[0] - game->score[1];
}

/* Whether a striker with this lead claims the frame: only the black is left, and its pot or a foul
 * on it makes fewer points and ends the frame. */
static bool is_claimed(int64_t lead, uint32_t balls) {
  return balls == black && lead > MOST;
}

/* The points, at least 1, after which a player with this lead cannot be drawn level by the points
 * on the table; 0 of a frame that is won. */
static int32_t needed_by(int64_t lead, int64_t on_table, uint32_t balls) {
  if (is_claimed(lead, balls))
    return 0;
  return (int32_t)carom_max((on_table - lead) / 2 + 1, 1);
}

static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  int pots;
  const int64_t on_table = remaining(game, in_play, &pots), lead = lead_of(game);
  const uint32_t balls = in_play & (reds | colours);
  needed[0] = needed_by(lead, on_table, balls);
  needed[1] = needed_by(-lead, on_table, balls);
}

static double points(const carom_rules_state *game, uint32_t in_play, int ball) {
  if (ball >= 0 && game->on != 0)
    return worth(ball);
  if (ball >= 0)
    return highest(due_of(game, in_play));
  int pots;
  const int on_table = remaining(game, in_play, &pots);
  if (pots == 0)
    return 1.0;
  return (double)on_table / pots;
}

/* The last black is gone: who has more has won; else it returns. */
static carom_turn finish(const carom_rules_state *game, carom_turn turn) {
  turn.spot = 0;
  turn.leave = CAROM_LEAVE_AFTER;
  turn.outcome = CAROM_TURN_LOSE;
  if (lead_of(game) > 0)
    turn.outcome = CAROM_TURN_WIN;
  if (lead_of(game) == 0) {
    turn.outcome = CAROM_TURN_PASS;
    turn.leave = CAROM_LEAVE_D;
    turn.spot = black;
  }
  return turn;
}

/* The balls of a stroke, by what was on and what is called. */
typedef struct nomination {
  int first;          /* the ball that is met first, or -1 */
  int named;          /* the ball that is called, else the first; -1: none */
  uint32_t to_meet;   /* of which one must be met first */
  uint32_t allowed;   /* that may be met with it, and may fall */
  uint32_t free_ball; /* the free ball, as a set; 0: none is played */
  int value;          /* of the ball on */
} nomination;

static nomination nominate(bool colour, uint32_t choice, uint32_t targets, const carom_facts *facts,
                           carom_call call) {
  /* the balls that the stroke aims at: the one that is called, where it may be */
  const bool calls = call.ball >= 0 && call.ball <= BLACK && choice >> call.ball & 1;
  uint32_t aimed_at = choice;
  if (calls)
    aimed_at = carom_only(call.ball);
  if (!colour && (aimed_at & targets) != 0)
    aimed_at = targets;
  nomination n = {.first = carom_first_of(facts, aimed_at), .named = -1};
  if (n.first >= 0 && choice >> n.first & 1)
    n.named = n.first;
  if (calls)
    n.named = call.ball;

  /* what may be met and may fall, and what it is worth */
  const uint32_t named = carom_only(n.named);
  n.to_meet = n.allowed = targets;
  n.value = highest(targets);
  if (colour) {
    n.to_meet = n.allowed = named;
    n.value = MOST;
    if (n.named >= 0)
      n.value = worth(n.named);
  } else if ((named & ~targets) != 0) {
    n.free_ball = n.to_meet = named;
    n.allowed = targets | named;
  }
  return n;
}

/* The foul of a stroke. Two balls at one instant are a foul, but for two reds, and a free ball with
 * a ball on. Reds stay down. *concerned gets the balls whose values a foul costs. */
static int32_t foul_of(const nomination *n, uint32_t balls, int cue_ball, const carom_facts *facts,
                       uint32_t *concerned) {
  const uint32_t off = facts->off & balls;
  const uint32_t wrong_pots = facts->down & balls & ~n->allowed;
  uint32_t met_first = carom_only(n->first);
  if (n->first == facts->first[0])
    met_first |= carom_met_first(facts);
  const bool wrong_first =
      met_first != 0 && ((met_first & n->to_meet) == 0 || (met_first & ~n->allowed) != 0);
  *concerned = (wrong_pots | off | facts->pushed | facts->jumped) & balls & ~n->free_ball;
  if (wrong_first)
    *concerned |= met_first;
  if ((facts->down | facts->off) >> cue_ball & 1)
    return CAROM_FOUL_CUE_BALL;
  if (n->first < 0)
    return CAROM_FOUL_NO_BALL;
  if (wrong_first)
    return CAROM_FOUL_FIRST;
  if (off != 0)
    return CAROM_FOUL_OFF;
  if (facts->pushed != 0 || facts->touches > 1)
    return CAROM_FOUL_DOUBLE_HIT;
  if ((facts->jumped & balls) != 0)
    return CAROM_FOUL_JUMP;
  if (wrong_pots != 0)
    return CAROM_FOUL_POT;
  return CAROM_FOUL_NONE;
}

/* The turn after a foul, which costs the highest value of the balls that it concerns. */
static carom_turn judge_foul(carom_rules_state *game, uint32_t balls, int cost, carom_turn turn) {
  carom_add(&game->score[1], (int)carom_max(cost, LEAST));
  const bool scratch = turn.foul == CAROM_FOUL_CUE_BALL;
  if (scratch)
    turn.leave = CAROM_LEAVE_D;

  /* a black that returns is a new beginning */
  if (balls == black)
    return carom_end_turn(game, finish(game, turn));
  game->may = CAROM_CHOICE_PASS;
  if (scratch)
    game->may |= CAROM_CHOICE_PLACE;
  return carom_give(game, turn);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & (reds | colours), targets = due_of(game, in_play);
  const uint32_t choice = targets_of(game, in_play);
  const int32_t after_foul = game->may;
  const bool colour = game->on != 0;
  game->may = game->free_ball = 0;
  if ((after_foul & CAROM_CHOICE_PASS) && call.ball == CAROM_CALL_PASS) {
    carom_turn turn = carom_pass;
    if (after_foul & CAROM_CHOICE_PLACE)
      turn.leave = CAROM_LEAVE_D;
    return carom_give(game, turn);
  }

  /* a foul */
  const nomination n = nominate(colour, choice, targets, facts, call);
  uint32_t concerned;
  carom_turn turn = carom_pass;
  turn.foul = foul_of(&n, balls, cue_ball, facts, &concerned);
  turn.spot = (facts->down | facts->off) & colours & balls;
  game->on = 0;
  if (turn.foul != CAROM_FOUL_NONE)
    return judge_foul(game, balls, (int)carom_max(n.value, highest(concerned)), turn);

  /* A stroke without a pot; the other must not be snookered behind a free ball. */
  const uint32_t fell = facts->down & balls;
  if (fell == 0) {
    if (is_claimed(-lead_of(game), balls))
      return finish(game, turn);
    if (n.free_ball != 0)
      game->free_ball = n.named;
    return carom_give(game, turn);
  }

  /* Reds count one each, and a free ball potted with them as one; otherwise only the ball on
   * counts. */
  const bool red = !colour && (targets & reds) != 0;
  int points = n.value;
  turn.spot = fell & colours;
  if (red)
    points = carom_count_of(fell);
  else if (!colour)
    turn.spot = fell & ~targets;
  carom_add(&game->score[0], points);
  game->on = red;
  turn.outcome = CAROM_TURN_KEEP;
  if (balls == black || is_claimed(lead_of(game), (balls & ~fell) | turn.spot))
    turn = finish(game, turn);
  turn.points = points;
  return carom_end_turn(game, turn);
}

/* ---- Where balls lie */

/* Whether no ball of `targets` can be hit at both of its edges from c: others bar the way. */
static bool is_snookered_at(const carom_shot_ball *balls, uint32_t targets, uint32_t others,
                            const double c[2]) {
  for (int k = 1; targets >> k != 0; k++)
    if ((targets >> k & 1) && !carom_is_hidden(balls, others, c, k))
      return false;
  return true;
}

/* Whether `ball` snookers the cue ball: of the others that bar the way to each ball of `targets`,
 * it is the nearest one. */
static bool is_behind(const carom_shot_ball *balls, uint32_t targets, uint32_t others, int ball) {
  const double *c = balls[0].state.r;
  uint32_t nearer = 0;
  for (int n = 1; others >> n != 0; n++)
    nearer |= (uint32_t)((others >> n & 1) &&
                         carom_square(balls[n].state.r, c) < carom_square(balls[ball].state.r, c))
              << n;
  for (int k = 1; targets >> k != 0; k++)
    if ((targets >> k & 1) && (!carom_is_hidden(balls, UINT32_C(1) << ball, c, k) ||
                               carom_is_hidden(balls, nearer, c, k)))
      return false;
  return true;
}

/* Whether the cue ball is snookered; in hand from all free positions of the D: some are tried. */
static bool is_snookered(const carom_table *table, const carom_shot_ball *balls, uint32_t in_play,
                         uint32_t targets, uint32_t others, bool hand) {
  enum { STEPS = 6 };
  if (!hand)
    return is_snookered_at(balls, targets, others, balls[0].state.r);
  const carom_marks marks = carom_marks_of(table->width, table->length);
  const double *d = marks.d_centre, radius = marks.d_radius;
  for (int i = -STEPS; i <= STEPS; i++)
    for (int j = 0; j <= STEPS; j++) {
      const double c[2] = {d[0] + radius * i / (double)STEPS, d[1] - radius * j / (double)STEPS};
      bool is_free = carom_is_in_d(&marks, c[0], c[1]);
      for (int k = 1; in_play >> k != 0 && is_free; k++) {
        const double least = balls[0].kind.radius + balls[k].kind.radius;
        is_free = !(in_play >> k & 1) || carom_square(balls[k].state.r, c) > least * least;
      }
      if (is_free && !is_snookered_at(balls, targets, others, c))
        return false;
    }
  return true;
}

/* Colours return: first those whose own spots are free, then the others, the highest first. */
static void put_back(const carom_table *table, carom_shot_ball *balls, int count, uint32_t set) {
  for (int k = YELLOW; k <= BLACK; k++) {
    double spot[2];
    carom_spot_of(CAROM_RACK_SNOOKER, table, k, spot);
    if ((set >> k & 1) &&
        carom_place_ball(table, balls, count, k, spot[0], spot[1], NULL) == CAROM_OK)
      set &= ~carom_only(k);
  }
  for (int k = BLACK; k >= YELLOW; k--)
    if (set >> k & 1)
      carom_spot_ball_of(CAROM_RACK_SNOOKER, table, balls, count, k);
}

static void settle(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                   int count, carom_turn *turn) {
  put_back(table, balls, count, turn->spot);
  if (turn->outcome != CAROM_TURN_PASS)
    return;

  const uint32_t in_play = carom_on_table(balls, count) & (reds | colours);
  const uint32_t targets = due_of(game, in_play);
  const bool hand = turn->leave == CAROM_LEAVE_D;

  /* Behind the free ball, except if only pink and black are left: a foul. */
  if (game->free_ball > 0 && game->free_ball <= BLACK) {
    const int free_ball = game->free_ball;
    game->free_ball = 0;
    if (in_play != (black | black >> 1) &&
        is_behind(balls, targets, in_play & ~targets, free_ball)) {
      carom_add(&game->score[0], (int)carom_max(highest(targets), LEAST));
      game->may = CAROM_CHOICE_PASS;
      turn->foul = CAROM_FOUL_OTHER;
    }
  }

  /* A free ball; a respotted black gives none. */
  if (game->may & CAROM_CHOICE_PASS &&
      is_snookered(table, balls, in_play, targets, in_play & ~targets, hand))
    game->may |= CAROM_CHOICE_FREE_BALL;
}

CAROM_RULES_OBJECT(carom_snooker) = {.on = targets_of,
                                     .judge = judge,
                                     .left = left,
                                     .race = CAROM_RACE_POINTS,
                                     .points = points,
                                     .breaks = 2,
                                     .settle = settle,
                                     .rack = CAROM_RACK_SNOOKER};
