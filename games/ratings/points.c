/* Values of layouts in games of points.
 *
 * The player at the table needs n points, the other one m. Of the balls that are on the one whose
 * pot is worth most is taken: with the chance p, as chances.c has it, it makes w points, and each
 * later pot w' with the chance a. A visit that continues to the end, K pots, wins with the chance
 * q = p a^(K - 1); in the mean a visit makes
 *
 *     u = p (w + w' (a + a^2 + ... + a^(K - 1))).
 *
 * After it the other plays. Visits of the usual kind make V = w' e / (1 - a), with the chance e of
 * their first pot. Their numbers that are still needed are N = (n - u) / V of the player,
 * and M = m / V' of the other, whose next visit wins with the chance q' = e' a'^(K' - 1), and else
 * leaves M' = max(M - 1, M / 2). The number of visits has a variance of (1 + w' / V) each. So the
 * player wins with about
 *
 *     q + (1 - q) (1 - q') Phi((M' - N + 1/2) / sqrt(1/4 + N (1 + w' / V) + M' (1 + w' / V'))),
 *
 * Phi being the normal distribution. All of it is an estimate: a, e and w' are for a usual layout,
 * and the number of pots K assumes w' for each.
 *
 * Where the other makes every ball, as in a plan to run out, the value is the fraction of the
 * points on the table, or of those needed, that the visit makes. The chance q of all points of a
 * game is too small to choose a stroke by. */
#include "platform/elementary.h"
#include "platform/promise.h"
#include "random_draws.h"
#include "rules.h"
#include "table/marks.h"
#include "view.h"

#include <math.h>
#include <string.h>

typedef struct visits {
  double later, first; /* a, e */
  double mean_points;  /* V */
} visits;

static visits visits_of(const carom_view *view, int seat, double mean, int balls, double each) {
  visits v;
  v.later = fmin(carom_chance_later(view, seat, mean, balls), 0.999);
  v.first = carom_chance_first(view, seat, balls);
  v.mean_points = each * v.first / (1.0 - v.later);
  return v;
}

/* x^n of 0 < x < 1. */
static double power(double x, double n) {
  return carom_exp(n * carom_log(x));
}

static double normal(double x) {
  return 0.5 + copysign(0.5 * carom_erf(fabs(x) / 1.4142135623730951), x);
}

/* From the position of the cue ball, or as pots.c treats a cue ball in hand. */
static double value_from(const carom_view *view, const carom_rules_state *game,
                         const carom_ball_state *balls, uint32_t in_play, int seat, bool in_hand) {
  const carom_plan_rules *rules = view->rules;
  const uint32_t targets = rules->on(game, in_play) & in_play;
  const uint32_t pockets = carom_pockets_of(rules, game);
  const double each = carom_points_of(rules, game, in_play, -1);
  int32_t left[2];
  rules->left(game, in_play, left);
  if (left[0] < 1 || left[1] < 1)
    return left[0] < 1; /* one of them has won already */
  const bool runs_out = view->set_chance[1] == 1.0;
  if (runs_out && seat == 1)
    return 1.0;
  const double n = left[0], m = left[1];

  /* the pot of each ball; the most is made by the one of `chosen` */
  double x[NEXT_NUMBERS], pot[CAROM_BALLS_MOST], chosen = 0.0, w = each, most = -1.0;
  carom_plan_features(view, balls, in_play, targets, pockets, seat, in_hand, pot, x);
  for (int k = 0; targets >> k != 0; k++) {
    if (!(targets >> k & 1))
      continue;
    const double points = carom_points_of(rules, game, in_play, k);
    if (pot[k] * (points + each) > most) {
      most = pot[k] * (points + each);
      chosen = pot[k];
      w = points;
    }
  }
  const double mean = x[2], best = x[3];
  const int objects = carom_count_of(in_play & ~(UINT32_C(1) << view->cue_ball));
  double p = carom_chance_next(view, x);
  if (best > 0.0)
    p *= chosen / best;

  /* this visit */
  const visits player = visits_of(view, seat, mean, objects, each),
               opponent = visits_of(view, 1 - seat, mean, objects, each);
  const double later_pots = ceil(fmax(n - w, 0.0) / each),
               complete = power(player.later, later_pots);
  const double later = player.later * (1.0 - complete) / (1.0 - player.later);
  const double wins = p * complete, visit_points = p * (w + each * later);
  if (runs_out)
    return fmin(visit_points / fmin(n, each * fmax(objects, 1)), 1.0);
  const double needed = fmax(n - visit_points, 0.5);

  /* what follows it */
  const double needs = needed / player.mean_points, others = m / opponent.mean_points;
  const double his = opponent.first * power(opponent.later, ceil(m / each) - 1.0);
  const double rest = fmax(others - 1.0, 0.5 * others);
  const double variance =
      0.25 + needs * (1.0 + each / player.mean_points) + rest * (1.0 + each / opponent.mean_points);
  const double later_win = normal((rest - needs + 0.5) / sqrt(variance));
  const double value = wins + (1.0 - wins) * (1.0 - his) * later_win;
  CAROM_PROMISE(value >= 0.0 && value <= 1.0);
  return value;
}

double carom_points_value(const carom_view *view, const carom_rules_state *game,
                          const carom_ball_state *balls, uint32_t in_play, int seat, bool in_hand) {
  if (!in_hand || !carom_has_d(view->rules))
    return value_from(view, game, balls, in_play, seat, in_hand);

  /* in the D: the best of some positions on its line */
  carom_ball_state placed[CAROM_BALLS_MOST];
  memcpy(placed, balls, (size_t)view->count * sizeof *placed);
  const carom_marks marks = carom_marks_of(view->width, view->length);
  double best = 0.0;
  for (int k = -1; k <= 1; k++) {
    placed[view->cue_ball].r[0] = marks.d_centre[0] + 0.6 * k * marks.d_radius;
    placed[view->cue_ball].r[1] = marks.d_centre[1];
    if (k == 0)
      placed[view->cue_ball].r[1] -= 0.5 * marks.d_radius;
    best = fmax(best, value_from(view, game, placed, in_play, seat, false));
  }
  return best;
}
