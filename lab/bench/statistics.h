/* What many noisy samples say: the middle, the extremes and the spread. */
#ifndef CAROM_BENCH_STATISTICS_H
#define CAROM_BENCH_STATISTICS_H

#include <stddef.h>

typedef struct sample_summary {
  size_t count;
  double median, min, max;
  double spread; /* median absolute deviation from the median: half of the samples lie within it */
} sample_summary;

/* Sorts n samples, which are no NaN. */
void sort_samples(double *sample, size_t n);

/* Of n > 0 sorted samples the one in the middle, or the mean of the two. */
double median_of_sorted(const double *sample, size_t n);

/* Summarises n samples; reorders and overwrites them. All is NAN for n = 0 or where a sample is
 * NAN. */
sample_summary summarise(double *sample, size_t n);

/* Summarises the n ratios above[k] / below[k] of samples taken in the same round, so that what
 * slows both cancels. `scratch` holds n doubles; `above` and `below` stay as they are. */
sample_summary summarise_ratios(const double *above, const double *below, size_t n,
                                double *scratch);

#endif
