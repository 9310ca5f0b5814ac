/* How far results are from a reference. */
#include "accuracy.h"

#include "program/program.h"
#include "rounds.h"

enum { COMPONENTS = 12 };

static const double ROUNDING = 1e-12; /* of the scale */

static const double *numbers(const carom_result *result) {
  return (const double *)result;
}

/* v_a w_a v_b w_b: every second triple is an angular velocity. */
static double weight(int component, double radius) {
  if (component / 3 % 2 == 1)
    return radius;
  return 1.0;
}

pair_accuracy accuracy_of(const carom_result *result, const carom_result *reference,
                          double radius) {
  const double *x = numbers(result), *y = numbers(reference);
  pair_accuracy a = {.identical = memcmp(result, reference, sizeof *result) == 0};
  double scale = 0.0;
  for (int k = 0; k < COMPONENTS; k++)
    scale = fmax(scale, weight(k, radius) * fabs(y[k]));
  for (int k = 0; k < COMPONENTS; k++) {
    const double error = weight(k, radius) * fabs(x[k] - y[k]);
    if (error == 0.0)
      continue;
    const double size = weight(k, radius) * fabs(y[k]);
    const double of_scale = error / scale, of_itself = error / fmax(size, 0.001 * scale);
    a.pair = fmax(a.pair, of_scale);
    a.component = fmax(a.component, of_itself);
    if (of_scale > ROUNDING)
      a.strict = fmax(a.strict, error / size);
    if (isnan(of_scale))
      a.pair = INFINITY;
    if (isnan(of_itself))
      a.component = a.strict = INFINITY;
  }
  return a;
}

accuracy_summary accuracy_summarise(const pair_accuracy *each, size_t n) {
  accuracy_summary s = {.cases = n};
  double *pair = allocate(n, sizeof *pair);
  for (size_t k = 0; k < n; k++) {
    pair[k] = each[k].pair;
    s.mean += each[k].pair / (double)n;
    s.identical += each[k].identical;
    s.component_1e3 += each[k].component > 1e-3;
    s.component_1e2 += each[k].component > 1e-2;
    s.strict_1e3 += each[k].strict > 1e-3;
    s.strict_1e2 += each[k].strict > 1e-2;
  }
  sort_samples(pair, n);
  s.median = median_of_sorted(pair, n);
  s.p99 = pair[(99 * n + 99) / 100 - 1];
  s.max = pair[n - 1];
  free(pair);
  return s;
}
