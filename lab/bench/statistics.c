/* What many noisy samples say. The median and the median absolute deviation, because a busy
 * machine makes outliers on one side only: an interrupted sample is too long, none is ever too
 * short. */
#include "statistics.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

void sort_samples(double *sample, size_t n) {
  qsort(sample, n, sizeof *sample, ascending);
}

double median_of_sorted(const double *sample, size_t n) {
  return n % 2 == 1 ? sample[n / 2] : 0.5 * (sample[n / 2 - 1] + sample[n / 2]);
}

sample_summary summarise(double *sample, size_t n) {
  const sample_summary unknown = {.count = n, .median = NAN, .min = NAN, .max = NAN, .spread = NAN};
  for (size_t k = 0; k < n; k++)
    if (isnan(sample[k]))
      return unknown;
  if (n == 0)
    return unknown;
  sort_samples(sample, n);
  sample_summary s = {
      .count = n, .median = median_of_sorted(sample, n), .min = sample[0], .max = sample[n - 1]};
  for (size_t k = 0; k < n; k++)
    sample[k] = fabs(sample[k] - s.median);
  sort_samples(sample, n);
  s.spread = median_of_sorted(sample, n);
  return s;
}

sample_summary summarise_ratios(const double *above, const double *below, size_t n,
                                double *scratch) {
  for (size_t k = 0; k < n; k++)
    scratch[k] = above[k] / below[k];
  return summarise(scratch, n);
}
