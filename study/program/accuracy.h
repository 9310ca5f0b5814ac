/* How far results are from a reference.
 *
 *     scale            largest of |v| and R |w| over the components of the reference, both balls
 *     pair error       largest |result - reference| over the 12 components, times R for w, over
 *                      scale: the figure that counts
 *     component error  |result - reference| / max(|reference|, 0.001 scale), the largest over
 *                      the components (times R for w)
 *     strict error     the same without the floor of 0.001 scale, as the seed paper judges. A
 *                      difference of less than 1e-12 scale is rounding, and no error: a component
 *                      that should be 0 would otherwise be wrong by 100 % in its last bit
 */
#ifndef CAROM_LAB_ACCURACY_H
#define CAROM_LAB_ACCURACY_H

#include "carom.h"

#include <stdbool.h>

typedef struct pair_accuracy {
  double pair, component, strict;
  bool identical; /* all 12 doubles have the same bits */
} pair_accuracy;

/* Compares one result. `radius` in m. A NaN in the result makes both errors infinite. */
pair_accuracy accuracy_of(const carom_result *result, const carom_result *reference, double radius);

typedef struct accuracy_summary {
  size_t cases, identical;
  double mean, median, p99, max;       /* of the pair error */
  size_t component_1e3, component_1e2; /* cases with a component error above 0.1 % and above 1 % */
  size_t strict_1e3, strict_1e2;       /* cases with such a strict error */
} accuracy_summary;

/* Summarises n > 0 comparisons. A percentile is the smallest value that so many per cent do not
 * exceed; the median is the mean of the two values in the middle where n is even. */
accuracy_summary accuracy_summarise(const pair_accuracy *each, size_t n);

#endif
