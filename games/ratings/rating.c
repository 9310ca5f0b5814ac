/* Ratings by games that were won and lost. A player of rating r wins a game against one of rating
 * d with the odds 2^((r - d)/100) : 1. With c = ln(2)/100 and sigma(x) = 1/(1 + e^(-c x)), the
 * logarithm of the posterior density and its slope are, but for a constant,
 *     l(r)  = -(r - 400)^2/(2 150^2) + sum_k [won_k ln sigma(r - d_k) + lost_k ln sigma(d_k - r)]
 *     l'(r) = -(r - 400)/150^2 + c sum_k [won_k sigma(d_k - r) - lost_k sigma(r - d_k)].
 * l' falls, so l has one maximum m. The density is integrated by Simpson's rule in cells between
 * the points where l = l(m) - 40, or the ends of the scale: any number of games has as many cells
 * where its density is. */
#include "carom_plan.h"
#include "platform/elementary.h"

#include <math.h>
#include <stdbool.h>

enum { CELLS = 1024 };
static const double LEAST = 200.0, MOST = 850.0, LN2 = 0x1.62e42fefa39efp-1;

/* l(r), and its slope. */
__attribute__((noinline)) static double likely(const carom_score *row, int64_t count, double r,
                                               double *slope) {
  double l = -0.5 * (r - 400.0) * (r - 400.0) / 22500.0;
  *slope = (400.0 - r) / 22500.0;
  for (int64_t k = 0; k < count; k++) {
    /* ln sigma is computed for the worse player, and for the better one by sigma(x) = e^x
     * sigma(-x) */
    const carom_score *s = &row[k];
    const double x = 0.01 * LN2 * (r - s->against), e = carom_exp(-fabs(x));
    const double worse = -fabs(x) - carom_log(1.0 + e), better = worse + fabs(x);
    double log_wins = worse, log_loses = better, sigma = e / (1.0 + e);
    if (x > 0.0) {
      log_wins = better;
      log_loses = worse;
      sigma = 1.0 / (1.0 + e);
    }
    l += s->won * log_wins + s->lost * log_loses;
    *slope += 0.01 * LN2 * (s->won * (1.0 - sigma) - s->lost * sigma);
  }
  return l;
}

/* Where l' changes its sign, and where l is `least`, between two ratings of which only `inside`
 * is above. */
__attribute__((noinline)) static double edge(const carom_score *row, int64_t count, double inside,
                                             double outside, bool of_slope, double least) {
  double slope;
  for (int k = 0; k < 60; k++) {
    const double r = 0.5 * (inside + outside), l = likely(row, count, r, &slope);
    if ((of_slope && slope > 0.0) || (!of_slope && l > least))
      inside = r;
    else
      outside = r;
  }
  return outside;
}

/* The rating below which is a fraction of the mass, by densities that are linear in a cell. */
static double below(const double f[2 * CELLS + 1], double low, double cell, double mass) {
  int k = 0;
  for (double next; k < CELLS - 1; k++, mass -= next)
    if ((next = (f[2 * k] + 4.0 * f[2 * k + 1] + f[2 * k + 2]) / 6.0) >= mass)
      break;
  const double a = f[2 * k], b = f[2 * k + 2], rest = 2.0 * mass;
  return low + cell * (k + rest / (a + sqrt(a * a + (b - a) * rest)));
}

carom_status carom_rating_of(const carom_score *rows, int64_t count, carom_rating *rating) {
  if (rating == NULL || (rows == NULL && count > 0))
    return CAROM_ERROR_NULL;
  if (count < 0) {
    *rating = (carom_rating){NAN, NAN, NAN, -1};
    return CAROM_ERROR_SCORE;
  }
  for (int64_t k = 0; k < count; k++)
    if (!(rows[k].against >= 0.0 && rows[k].against <= 1000.0 && rows[k].won >= 0.0 &&
          rows[k].won <= 1e9 && rows[k].lost >= 0.0 && rows[k].lost <= 1e9)) {
      *rating = (carom_rating){NAN, NAN, NAN, k};
      return CAROM_ERROR_SCORE;
    }

  /* where the density is */
  double slope, f[2 * CELLS + 1], sum = 0.0, first = 0.0;
  const double m = edge(rows, count, LEAST, MOST, true, 0.0), top = likely(rows, count, m, &slope);
  const double low = edge(rows, count, m, LEAST, false, top - 40.0),
               high = edge(rows, count, m, MOST, false, top - 40.0),
               cell = (high - low) / (double)CELLS;

  /* its mass and mean, in cells from low on */
  for (int k = 0; k <= 2 * CELLS; k++) {
    f[k] = carom_exp(likely(rows, count, low + 0.5 * k * cell, &slope) - top);
    double simpson = (double[]){2.0, 4.0}[k % 2];
    if (k == 0 || k == 2 * CELLS)
      simpson = 1.0;
    const double weight = simpson / 6.0 * f[k];
    sum += weight;
    first += 0.5 * k * weight;
  }
  *rating = (carom_rating){low + cell * first / sum, below(f, low, cell, 0.025 * sum),
                           below(f, low, cell, 0.975 * sum), -1};
  return CAROM_OK;
}
