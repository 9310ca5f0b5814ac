/* Chances that a player keeps his turn, by the numbers of learned.h, which were fitted to
 * racks that were played: p that he does so now, by a pot of any kind, a_n that he pots a later
 * ball of this visit where n are left, and e_n that he keeps the turn that the other has left him.
 * All are 1 / (1 + exp(-w x)), with x as carom_plan_features() has it. */
#include "learned.h"
#include "platform/elementary.h"

#include <math.h>
#include <string.h>

static double chance(const double *w, const double *x, int n) {
  double sum = 0.0;
  for (int k = 0; k < n; k++)
    sum += w[k] * x[k];
  return 1.0 / (1.0 + carom_exp(-sum));
}

bool carom_is_learned(const carom_view *view) {
  const int kind = view->rules->learned - 1, games = sizeof learned_of / sizeof learned_of[0];
  return kind >= 0 && kind < games && learned_of[kind].stretch > 0.0;
}

/* The chances of the game, or of one with the same race. */
static const learned *numbers_of(const carom_view *view) {
  static const int with_race[] = {[CAROM_RACE_OWN] = CAROM_RULES_EIGHTBALL,
                                  [CAROM_RACE_SHARED] = CAROM_RULES_NINEBALL,
                                  [CAROM_RACE_ALONE] = CAROM_RULES_EIGHTBALL,
                                  [CAROM_RACE_POINTS] = CAROM_RULES_STRAIGHT,
                                  [CAROM_RACE_SEATS] = CAROM_RULES_EIGHTBALL};
  if (carom_is_learned(view))
    return &learned_of[view->rules->learned - 1];
  if (view->rules->learned == CAROM_RULES_ROTATION + 1) /* one ball is on, as in nine-ball */
    return &learned_of[CAROM_RULES_NINEBALL];
  return &learned_of[with_race[view->rules->race]];
}

double carom_chance_usual(const carom_view *view) {
  return numbers_of(view)->mean;
}

double carom_log_size(const carom_view *view) {
  return carom_log(view->width / numbers_of(view)->width);
}

double carom_chance_next(const carom_view *view, const double x[NEXT_NUMBERS]) {
  return chance(numbers_of(view)->next, x, NEXT_NUMBERS);
}

static const double least_chance = 1e-3; /* between two who never pot the chain has no end */

/* a_n, of a layout with this mean over the balls. */
double carom_chance_later(const carom_view *view, int seat, double mean, int n) {
  const double x[LATER_NUMBERS] = {1.0, view->log_miss[seat], 1.0 / n, mean};
  double a = view->set_chance[seat];
  if (!(a > 0.0))
    a = chance(numbers_of(view)->later, x, LATER_NUMBERS);
  return fmax(a, least_chance);
}

/* e_n; for an opponent who makes every ball it is 1. */
double carom_chance_first(const carom_view *view, int seat, int n) {
  const double x[FIRST_NUMBERS] = {1.0, view->log_miss[seat], 1.0 / n};
  if (seat == 1 && view->set_chance[1] == 1.0)
    return 1.0;
  return fmax(chance(numbers_of(view)->first, x, FIRST_NUMBERS), least_chance);
}

void carom_plan_features(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                         uint32_t targets, uint32_t pockets, int seat, bool in_hand,
                         double each[CAROM_BALLS_MOST], double x[NEXT_NUMBERS]) {
  /* the best pot of each ball */
  double best = 0.0, second = 0.0, sum = 0.0;
  int count = 0;
  targets &= in_play;
  for (int k = 0; targets >> k != 0; k++) {
    if (!(targets >> k & 1))
      continue;
    /* the likeliest pocket of ball k; for others only whether they are likelier */
    double likeliest = 0.0;
    for (int p = 0; p < view->pockets; p++) {
      if (!(pockets >> p & 1))
        continue;
      const carom_way way = carom_way_of(view, balls, in_play, k, p, seat, in_hand, likeliest);
      if (way.chance > likeliest)
        likeliest = way.chance;
    }

    /* the two best of all balls */
    count++;
    sum += likeliest;
    if (likeliest > best) {
      second = best;
      best = likeliest;
    } else if (likeliest > second) {
      second = likeliest;
    }
    if (each != NULL)
      each[k] = likeliest;
  }

  const double mean = sum / (double)carom_max(count, 1);
  const double numbers[NEXT_NUMBERS] = {
      1.0, view->log_error[seat], mean, best, second, count == 1, in_hand};
  memcpy(x, numbers, sizeof numbers);
}

static double log_odds_of(double chance) {
  const double least = 1e-9, p = carom_within(chance, least, 1.0 - least);
  return carom_log(p / (1.0 - p));
}

void carom_find_edges(carom_view *view) {
  /* chances that the caller gives, as for a run-out, are no player's, and so make no edge */
  const bool is_set = view->set_chance[0] > 0.0 || view->set_chance[1] > 0.0;
  for (int n = 1; n <= MOST_LEFT; n++) {
    const double win = log_odds_of(view->win[0][n][n]), lose = log_odds_of(view->win[1][n][n]);
    view->edge[n] = is_set ? 0.0 : 0.5 * (win - lose);
  }
}

double carom_stretched(const carom_view *view, double value, int seat, int n) {
  const learned *numbers = numbers_of(view);
  const double edge = seat == 0 ? view->edge[n] : -view->edge[n];
  const double odds = numbers->edge * edge + numbers->stretch * (log_odds_of(value) - edge);
  return 1.0 / (1.0 + carom_exp(-odds));
}

double carom_even(const carom_view *view, int seat, int n) {
  double edge = numbers_of(view)->edge * view->edge[n];
  if (seat == 1)
    edge = -edge;
  return 1.0 / (1.0 + carom_exp(-edge));
}
