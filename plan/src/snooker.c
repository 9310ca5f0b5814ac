/* Snooker: the rules of the WPBSA and IBSF, sections 2 and 3.
 *
 * A red and a colour in turn, then the colours from the lowest on. A foul gives the other the value
 * of the ball on, or of the highest ball that it concerns, at least 4; he may let the offender play
 * on. A player who is snookered after a foul may name any ball for one on: a free ball. The first
 * pot or foul on the last black ends the frame, but for equal scores: then the black comes back,
 * and the other plays from the D; by the rules they draw lots. Who comes to the last black more
 * than its seven points ahead claims the frame. Who plays away from a ball on that touches the cue
 * ball has met it first. To meet a ball before the tip has left the cue ball is a push stroke, also
 * at the very edge of one that nearly touches, which the rules allow: facts do not tell it. */
#include "games.h"
#include "rules.h"
#include "table/spots.h"

#include <math.h>

enum { YELLOW = 16, PINK = 20, BLACK = 21, COLOURS = 27, LEAST = 4, MOST = 7 };
static const uint32_t reds = 0xfffe, colours = 0x3f0000, black = UINT32_C(1) << BLACK;

static int worth(int ball) {
  return ball < YELLOW ? 1 : ball - YELLOW + 2;
}

/* Of a set; 0 of none. */
static int highest(uint32_t set) {
  int most = 0;
  for (int k = 1; k <= BLACK; k++)
    most = set >> k & 1 && worth(k) > most ? worth(k) : most;
  return most;
}

/* The balls on, but for a free ball. */
static uint32_t due_of(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t red = in_play & reds, colour = in_play & colours;
  if (game->on != 0)
    return colour;
  return red != 0 ? red : colour & (~colour + 1);
}

static uint32_t on(const carom_rules_state *game, uint32_t in_play) {
  return game->may & CAROM_MAY_FREE_BALL ? in_play & (reds | colours) : due_of(game, in_play);
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
    sum += in_play >> k & 1 ? worth(k) : 0;
  *pots = carom_count_of(in_play & colours);
  return sum;
}

static int64_t lead_of(const carom_rules_state *game) {
  return (int64_t)game->score[0] - game->score[1];
}

/* Whether a striker with this lead claims the frame: the black alone is left, and its pot or a foul
 * on it makes fewer points and ends the frame. */
static bool is_claimed(int64_t lead, uint32_t balls) {
  return balls == black && lead > MOST;
}

/* The points after which a lead of less than `reach` cannot be drawn level: at least 1. */
static int32_t points_beyond(int64_t reach) {
  return reach < 2 ? 1 : (int32_t)(reach / 2 + 1);
}

/* Points after which the other cannot draw level; 0 of a frame that is won. */
static void left(const carom_rules_state *game, uint32_t in_play, int32_t needed[2]) {
  int pots;
  const int64_t rest = remaining(game, in_play, &pots), lead = lead_of(game);
  const uint32_t balls = in_play & (reds | colours);
  needed[0] = is_claimed(lead, balls) ? 0 : points_beyond(rest - lead);
  needed[1] = is_claimed(-lead, balls) ? 0 : points_beyond(rest + lead);
}

static double points(const carom_rules_state *game, uint32_t in_play, int ball) {
  int pots;
  const int rest = remaining(game, in_play, &pots);
  const uint32_t due = due_of(game, in_play);
  if (ball < 0)
    return pots > 0 ? (double)rest / pots : 1.0;
  return game->on != 0 ? worth(ball) : highest(due);
}

/* The last black is gone: who has more has won; else it comes back. */
static carom_turn finish(carom_rules_state *game, carom_turn turn) {
  turn.spot = 0;
  turn.leave = CAROM_LEAVE_AFTER;
  turn.is = game->score[0] > game->score[1] ? CAROM_TURN_WIN : CAROM_TURN_LOSE;
  if (game->score[0] != game->score[1])
    return turn;
  turn.is = CAROM_TURN_PASS;
  turn.leave = CAROM_LEAVE_D;
  turn.spot = black;
  return turn;
}

/* The ball that is met first: the lowest of `choice` that touches the cue ball, where it is played
 * away from, else the one that it meets. */
static int first_of(const carom_facts *facts, uint32_t choice) {
  const uint32_t touching = facts->frozen & ~facts->pushed & choice;
  const int first = facts->first[0];
  if (touching == 0 || (first >= 0 && touching >> first & 1))
    return first;
  return carom_count_of((touching & (~touching + 1)) - 1);
}

static carom_turn judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                        const carom_facts *facts, carom_call call) {
  const uint32_t balls = in_play & (reds | colours), due = due_of(game, in_play);
  const int32_t after_foul = game->may;
  const bool colour = game->on != 0;
  game->may = game->free_ball = 0;
  if ((after_foul & CAROM_MAY_PASS) && call.ball == CAROM_CALL_PASS) {
    carom_turn turn = carom_pass;
    turn.leave = after_foul & CAROM_MAY_PLACE ? CAROM_LEAVE_D : turn.leave;
    return carom_give(game, turn);
  }

  /* The ball that is named, where one may be: else it is the first. */
  const uint32_t choice = after_foul & CAROM_MAY_FREE_BALL ? balls : due;
  const bool calls = call.ball >= 0 && call.ball <= BLACK && choice >> call.ball & 1;
  const uint32_t called = calls ? UINT32_C(1) << call.ball : choice;
  const int first = first_of(facts, !colour && (called & due) != 0 ? due : called);
  const int met = first >= 0 && choice >> first & 1 ? first : -1;
  const int named = calls ? call.ball : met;
  const uint32_t its = named < 0 ? 0 : UINT32_C(1) << named;
  const bool free_ball = !colour && its != 0 && (its & due) == 0;
  const uint32_t to_meet = colour || free_ball ? its : due;
  const uint32_t free_set = free_ball ? its : 0;
  const uint32_t to_fall = colour ? its : due | free_set;
  const int of_colour = named >= 0 ? worth(named) : MOST;
  const int value = colour ? of_colour : highest(due);

  /* Fouls. Reds stay down. */
  const uint32_t gone = (facts->down | facts->off) & balls;
  const uint32_t wrong = (facts->down & balls & ~to_fall) | (facts->off & balls);
  const bool off_cue = (facts->down | facts->off) >> cue_ball & 1;
  /* two balls at one instant are a foul, but for two reds, and a free ball with a ball on */
  const uint32_t together = first >= 0 && first == facts->first[0] ? carom_met_first(facts) : 0;
  const uint32_t met_first = first >= 0 ? together | UINT32_C(1) << first : 0;
  const uint32_t may_meet = free_ball ? to_meet | due : to_meet;
  const bool wrong_first =
      met_first != 0 && ((met_first & to_meet) == 0 || (met_first & ~may_meet) != 0);
  const bool jumps = (facts->jumped & balls) != 0;
  const bool pushes = facts->pushed != 0 || facts->touches > 1;
  int32_t foul = CAROM_FOUL_NONE;
  if (off_cue)
    foul = CAROM_FOUL_CUE_BALL;
  else if (first < 0)
    foul = CAROM_FOUL_NO_BALL;
  else if (wrong_first)
    foul = CAROM_FOUL_FIRST;
  else if ((facts->off & balls) != 0)
    foul = CAROM_FOUL_OFF;
  else if (pushes)
    foul = CAROM_FOUL_DOUBLE_HIT;
  else if (jumps)
    foul = CAROM_FOUL_JUMP;
  else if ((facts->down & wrong) != 0)
    foul = CAROM_FOUL_POT;
  carom_turn turn = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, foul, gone & colours, 0.0};
  game->on = 0;
  if (foul != CAROM_FOUL_NONE) {
    int cost = value > LEAST ? value : LEAST;
    const int by_first = wrong_first ? highest(met_first) : 0,
              by_fall =
                  highest((wrong | facts->pushed | facts->jumped) & balls & ~(free_ball ? its : 0));
    cost = by_first > cost ? by_first : cost;
    cost = by_fall > cost ? by_fall : cost;
    carom_add(&game->score[1], cost);
    turn.leave = off_cue ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER;
    if (balls == black)
      turn = finish(game, turn);
    if (turn.is != CAROM_TURN_PASS)
      return turn;
    /* a black that comes back is a new beginning */
    if (balls != black)
      game->may = off_cue ? CAROM_MAY_PASS | CAROM_MAY_PLACE : CAROM_MAY_PASS;
    return carom_give(game, turn);
  }

  /* A stroke without a pot; the other must not be snookered behind a free ball. */
  const uint32_t fell = facts->down & balls;
  if (fell == 0) {
    if (is_claimed(-lead_of(game), balls))
      return finish(game, turn);
    game->free_ball = free_ball ? named : 0;
    return carom_give(game, turn);
  }

  /* Reds count one each, and a free ball beside them as one; of others the ball on counts alone. */
  const bool red = !colour && (due & reds) != 0;
  const int made = red ? carom_count_of(fell) : value;
  carom_add(&game->score[0], made);
  game->on = red;
  turn.is = CAROM_TURN_KEEP;
  turn.spot = !colour && !red ? fell & ~due : fell & colours;
  if (balls == black || is_claimed(lead_of(game), (balls & ~fell) | turn.spot))
    turn = finish(game, turn);
  turn.points = made;
  return turn.is == CAROM_TURN_PASS ? carom_give(game, turn) : turn;
}

/* ---- Where balls lie */

/* Whether a ball of `by` is in the way of the cue ball from c until it grazes ball k on a side, -1
 * or 1. */
static bool is_barred(const carom_shot_ball *balls, uint32_t by, const double c[2], int k,
                      int side) {
  const double x = balls[k].state.r[0] - c[0], y = balls[k].state.r[1] - c[1];
  const double both = balls[0].kind.radius + balls[k].kind.radius, d = sqrt(x * x + y * y);
  if (d <= both)
    return false;
  /* the direction of the tangent, and how long it is */
  const double length = sqrt(d * d - both * both), cosine = length / d, sine = side * both / d;
  const double u[2] = {(x * cosine - y * sine) / d, (x * sine + y * cosine) / d};
  for (int n = 1; by >> n != 0; n++) {
    const double to[2] = {balls[n].state.r[0] - c[0], balls[n].state.r[1] - c[1]};
    if ((by >> n & 1) && n != k &&
        carom_is_near_way(to, u, length, balls[0].kind.radius + balls[n].kind.radius))
      return true;
  }
  return false;
}

/* Whether others bar the way from c to an edge of ball k. */
static bool is_hidden(const carom_shot_ball *balls, uint32_t others, const double c[2], int k) {
  return is_barred(balls, others, c, k, -1) || is_barred(balls, others, c, k, 1);
}

/* Whether no ball of `due` can be hit at both of its edges from c: others bar the way. */
static bool is_snookered_at(const carom_shot_ball *balls, uint32_t due, uint32_t others,
                            const double c[2]) {
  for (int k = 1; due >> k != 0; k++)
    if ((due >> k & 1) && !is_hidden(balls, others, c, k))
      return false;
  return true;
}

/* Whether `ball` snookers the cue ball: of the others that bar the way to each ball of `due`, it is
 * the nearest one. */
static bool is_behind(const carom_shot_ball *balls, uint32_t due, uint32_t others, int ball) {
  const double *c = balls[0].state.r;
  uint32_t nearer = 0;
  for (int n = 1; others >> n != 0; n++)
    nearer |= (uint32_t)((others >> n & 1) &&
                         carom_square(balls[n].state.r, c) < carom_square(balls[ball].state.r, c))
              << n;
  for (int k = 1; due >> k != 0; k++)
    if ((due >> k & 1) &&
        (!is_hidden(balls, UINT32_C(1) << ball, c, k) || is_hidden(balls, nearer, c, k)))
      return false;
  return true;
}

/* Whether the cue ball is snookered; in hand from all free places of the D: some are tried. */
static bool is_snookered(const carom_table *table, const carom_shot_ball *balls, uint32_t in_play,
                         uint32_t due, uint32_t others, bool hand) {
  enum { STEPS = 6 };
  if (!hand)
    return is_snookered_at(balls, due, others, balls[0].state.r);
  const carom_d d = carom_d_of(table->width, table->length);
  for (int i = -STEPS; i <= STEPS; i++)
    for (int j = 0; j <= STEPS; j++) {
      const double c[2] = {d.x + d.radius * i / (double)STEPS, d.y - d.radius * j / (double)STEPS};
      bool is_free = carom_is_in_d(table, c[0], c[1]);
      for (int k = 1; in_play >> k != 0 && is_free; k++) {
        const double least = balls[0].kind.radius + balls[k].kind.radius;
        is_free = !(in_play >> k & 1) || carom_square(balls[k].state.r, c) > least * least;
      }
      if (is_free && !is_snookered_at(balls, due, others, c))
        return false;
    }
  return true;
}

static void settle(carom_rules_state *game, const carom_table *table, carom_shot_ball *balls,
                   int count, carom_turn *turn) {
  for (int k = count <= BLACK ? count - 1 : BLACK; k >= YELLOW; k--)
    if (turn->spot >> k & 1)
      carom_spot_ball_of(CAROM_RACK_SNOOKER, table, balls, count, k);
  if (turn->is != CAROM_TURN_PASS)
    return;

  uint32_t in_play = 0;
  for (int k = 1; k < count && k <= BLACK; k++)
    in_play |= (uint32_t)(balls[k].state.label != CAROM_BALL_POCKETED &&
                          balls[k].state.label != CAROM_BALL_OFF)
               << k;
  const uint32_t due = due_of(game, in_play);
  const bool hand = turn->leave == CAROM_LEAVE_D;

  /* Behind the free ball, but for pink and black alone: a foul. */
  if (game->free_ball > 0 && game->free_ball <= BLACK) {
    const int its = game->free_ball;
    game->free_ball = 0;
    if (in_play != (black | black >> 1) && is_behind(balls, due, in_play & ~due, its)) {
      carom_add(&game->score[0], highest(due) > LEAST ? highest(due) : LEAST);
      game->may = CAROM_MAY_PASS;
      turn->foul = CAROM_FOUL_OTHER;
    }
  }

  /* A free ball; a black that came back gives none. */
  if (game->may & CAROM_MAY_PASS && is_snookered(table, balls, in_play, due, in_play & ~due, hand))
    game->may |= CAROM_MAY_FREE_BALL;
}

CAROM_RULES_OBJECT(carom_snooker) = {.on = on,
                                     .judge = judge,
                                     .left = left,
                                     .race = CAROM_RACE_POINTS,
                                     .points = points,
                                     .settle = settle,
                                     .rack = CAROM_RACK_SNOOKER};
