/* Values of layouts: who wins from there, by the chances of pots of chances.c.
 *
 * What follows a miss is a chain over the balls left, n to the one who plays and m to the other:
 * of a visit he keeps the first turn with the chance e_n and each later one with a_n, both of a
 * layout of the usual kind, and who misses gives the turn away:
 *
 *     W(n, m) = e_n U(n - 1, m) + (1 - e_n) (1 - V(m, n)),
 *     U(n, m) = a_n U(n - 1, m) + (1 - a_n) (1 - V(m, n)),
 *     U(0, m) = 1,
 *
 * and V of the other likewise. The visit is worth
 *
 *     (1 - p) (1 - V(m, n)) + p U'(n - 1, m),
 *
 * U' being U with the a_n of the mean of this layout. Of games that were played to the end, the
 * log-odds of these values were to be stretched by a number for each game. */
#include "platform/elementary.h"
#include "platform/promise.h"
#include "player.h"
#include "view.h"

#include <math.h>
#include <string.h>

const carom_facts carom_no_facts = {.first = {-1, -1}};

uint32_t carom_in_play(const carom_ball_state *balls, int count) {
  uint32_t set = 0;
  for (int k = 0; k < count; k++)
    if (balls[k].label != CAROM_BALL_POCKETED && balls[k].label != CAROM_BALL_OFF)
      set |= UINT32_C(1) << k;
  return set;
}

/* The chain: of each pair of numbers of balls the equations of W and V are solved together; u[]
 * is U of both. */
static void chain(carom_view *view, double a[2][MOST_LEFT + 1], double e[2][MOST_LEFT + 1]) {
  const bool shared = view->rules->race == CAROM_RACE_SHARED;
  double u[2][MOST_LEFT + 1][MOST_LEFT + 1];
  for (int k = 0; k <= MOST_LEFT; k++)
    u[0][0][k] = u[1][0][k] = 1.0;
  for (int total = 2; total <= 2 * MOST_LEFT; total++)
    for (int n = (int)carom_max(total - MOST_LEFT, 1); n < total && n <= MOST_LEFT; n++) {
      const int m = total - n;
      if (shared && n != m)
        continue;
      /* a ball of both is gone for both */
      const double s = u[0][n - 1][m - shared], t = u[1][m - 1][n - shared];
      const double c = e[0][n], d = e[1][m], f = c * s + 1.0 - c, g = d * t + 1.0 - d;
      const double det = 1.0 - (1.0 - c) * (1.0 - d);
      const double w = (f - (1.0 - c) * g) / det, v = (g - (1.0 - d) * f) / det;
      view->win[0][n][m] = w;
      view->win[1][m][n] = v;
      u[0][n][m] = a[0][n] * s + (1.0 - a[0][n]) * (1.0 - v);
      u[1][m][n] = a[1][m] * t + (1.0 - a[1][m]) * (1.0 - w);
    }
}

void carom_view_make(carom_view *view, const carom_plan_job *job,
                     const carom_plan_options *options) {
  const carom_player *players[2] = {job->player, carom_opponent_of(job, options)};
  const double chances[2] = {options->chance_me, options->chance_opponent};
  view->rules = job->rules;
  view->pockets = (int)job->table->pockets;
  view->count = (int)job->count;
  view->cue_ball = (int)job->cue->ball;
  view->width = job->table->width;
  view->length = job->table->length;
  for (int p = 0; p < view->pockets; p++)
    view->mouth[p] = carom_mouth_of(job->table, p);
  for (int k = 0; k < view->count; k++) {
    view->radius[k] = job->balls[k].kind.radius;
    for (int p = 0; p < view->pockets; p++)
      view->window[k][p] = carom_window_of(&view->mouth[p], job->balls[k].state.r, view->radius[k]);
    memcpy(view->place[k], job->balls[k].state.r, sizeof view->place[k]);
  }
  for (int seat = 0; seat < 2; seat++) {
    /* the error of a usual pot */
    static const double usual_speed = 2.0;
    const double phi = players[seat]->phi * carom_player_growth(players[seat], usual_speed);
    view->sigma[seat] = phi * (pi / 180.0);
    view->log_error[seat] = carom_log(fmax(phi / 0.1, 0.1));
    view->log_miss[seat] = view->log_error[seat] + carom_log_size(view);
    view->set_chance[seat] = chances[seat];
  }
  const double mean = carom_chance_usual(view);
  double a[2][MOST_LEFT + 1] = {{0.0}}, e[2][MOST_LEFT + 1] = {{0.0}};
  for (int seat = 0; seat < 2; seat++)
    for (int n = 1; n <= MOST_LEFT; n++) {
      a[seat][n] = carom_chance_later(view, seat, mean, n);
      e[seat][n] = carom_chance_first(view, seat, n);
    }
  chain(view, a, e);
  carom_find_edges(view);
}

static double with_targets(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                           uint32_t targets, uint32_t pockets, const int32_t needed[2], int seat,
                           bool in_hand) {
  const bool alone = view->rules->race == CAROM_RACE_ALONE;
  if (!alone && seat == 1 && view->set_chance[1] == 1.0)
    return 1.0;
  const bool shared = view->rules->race == CAROM_RACE_SHARED;
  int32_t most = MOST_LEFT, left[2];
  if (alone)
    most = CAROM_BALLS_MOST;
  for (int k = 0; k < 2; k++)
    left[k] = (int32_t)carom_max(carom_min(needed[k], most), 1);
  CAROM_PROMISE(seat == 0 || seat == 1);
  double x[NEXT_NUMBERS];
  carom_plan_features(view, balls, in_play, targets, pockets, seat, in_hand, NULL, x);
  const double p = carom_chance_next(view, x);

  /* the visit, ball by ball: how likely it is to get that far, and the value of a miss there */
  double worth = 0.0, so_far = 1.0, next = p;
  for (int n = left[0]; n > 0; n--) {
    int others = left[1];
    if (shared)
      others = n;
    if (alone)
      worth += so_far * next;
    else
      worth += so_far * (1.0 - next) * (1.0 - view->win[1 - seat][others][n]);
    so_far *= next;
    if (n > 1)
      next = carom_chance_later(view, seat, x[2], n - 1);
  }
  CAROM_PROMISE(worth >= 0.0 && so_far >= 0.0 && so_far <= 1.0 && (alone || worth <= 1.0));
  if (alone)
    return worth;
  return carom_stretched(view, worth + so_far, seat, left[0]);
}

/* The value to one who plays. */
static double value_of_playing(const carom_view *view, const carom_rules_state *game,
                               const carom_ball_state *balls, uint32_t in_play, int seat,
                               bool in_hand) {
  const carom_plan_rules *rules = view->rules;
  if (rules->value != NULL)
    return rules->value(game, balls, view->count, in_hand);
  if (rules->race == CAROM_RACE_POINTS)
    return carom_points_value(view, game, balls, in_play, seat, in_hand);
  const uint32_t pockets = carom_pockets_of(rules, game);
  int32_t left[2];
  rules->left(game, in_play, left);
  return with_targets(view, balls, in_play, rules->on(game, in_play), pockets, left, seat, in_hand);
}

/* ---- Games that each plays for itself
 *
 * As in the method max^n each seat plays for its own chance, and none against one seat. The value
 * of a game has the chance v of the seat at the table. The others share 1 - v by the chances that
 * they would have at the table. */

static double share_of(const carom_view *view, const carom_rules_state *game,
                       const carom_ball_state *balls, int player, bool in_hand) {
  carom_rules_state asked = *game;
  const double value = view->rules->value(game, balls, view->count, in_hand);
  if (game->seat == player)
    return value;
  double sum = 0.0, share = 0.0;
  for (asked.seat = 0; asked.seat < CAROM_SEATS_MOST; asked.seat++) {
    if (asked.seat == game->seat || game->user[asked.seat] == 0)
      continue;
    const double chance = view->rules->value(&asked, balls, view->count, in_hand);
    sum += chance;
    if (asked.seat == player)
      share = chance;
  }
  if (sum > 0.0)
    share *= (1.0 - value) / sum;
  return share;
}

/* The chance of the seat that plans. The values of these games depend on what each seat has left,
 * not on the layout: they are evaluated after the next stroke, which pots the likeliest ball or
 * misses. */
static double value_to_planner(const carom_view *view, const carom_rules_state *game,
                               const carom_ball_state *balls, uint32_t in_play, int seat,
                               bool in_hand) {
  const carom_plan_rules *rules = view->rules;
  const int player = rules->state.seat;
  const uint32_t targets = rules->on(game, in_play) & in_play;
  if (rules->learned == 0 || targets == 0)
    return share_of(view, game, balls, player, in_hand);
  double each[CAROM_BALLS_MOST], x[NEXT_NUMBERS], sum = 0.0;
  carom_plan_features(view, balls, in_play, targets, carom_pockets_of(rules, game), seat, in_hand,
                      each, x);
  int ball = -1;
  for (int k = 0; targets >> k != 0; k++)
    if ((targets >> k & 1) && (ball < 0 || each[k] > each[ball]))
      ball = k;
  const double pots = carom_chance_next(view, x), chance[2] = {1.0 - pots, pots};
  for (int falls = 0; falls < 2; falls++) {
    carom_rules_state after = *game;
    const carom_facts facts = {
        .first = {ball, -1}, .cushions_after = 1, .down = (uint32_t)falls << ball};
    const carom_turn turn =
        rules->judge(&after, in_play, view->cue_ball, &facts, (carom_call){-1, -1});
    double worth = after.seat == player;
    if (turn.outcome != CAROM_TURN_WIN)
      worth = share_of(view, &after, balls, player, turn.leave >= CAROM_LEAVE_ANYWHERE);
    sum += chance[falls] * worth;
  }
  return sum;
}

double carom_value_of(const carom_view *view, const carom_rules_state *game,
                      const carom_ball_state *balls, int seat, bool in_hand) {
  const carom_plan_rules *rules = view->rules;
  const uint32_t in_play = carom_in_play(balls, view->count) | UINT32_C(1) << view->cue_ball;
  if (rules->race == CAROM_RACE_SEATS) {
    const double value = value_to_planner(view, game, balls, in_play, seat, in_hand);
    return seat == 0 ? value : 1.0 - value;
  }
  double plays = value_of_playing(view, game, balls, in_play, seat, in_hand);
  if (game->may & CAROM_CHOICE_PUSH && view->set_chance[1] == 0.0) {
    int32_t left[2];
    rules->left(game, in_play, left);
    plays = fmax(plays, carom_even(view, seat, (int)carom_max(carom_min(left[0], MOST_LEFT), 1)));
  }
  if (!(game->may & CAROM_CHOICE_PASS))
    return plays;

  /* he may leave the table to the other */
  carom_rules_state passed = *game;
  rules->judge(&passed, in_play, view->cue_ball, &carom_no_facts,
               (carom_call){CAROM_CALL_PASS, -1});
  return fmax(plays, 1.0 - value_of_playing(view, &passed, balls, in_play, 1 - seat, in_hand));
}
