/* A batch by single calls: what serves the exact solver when the pairs are too few to fill the lanes. */
#include "batch.h"

static size_t single_calls(carom_precision precision, const char *in, size_t in_size, size_t n, const carom_options *opt,
                           char *out, size_t out_size, uint8_t *status) {
  size_t first_bad = n;
  for (size_t k = 0; k < n; k++) {
    const carom_status one = carom_collide_one(precision, in + k * in_size, opt, out + k * out_size);
    if (status != NULL)
      status[k] = (uint8_t)one;
    if (one < 0 && first_bad == n)
      first_bad = k;
  }
  return first_bad;
}

size_t carom_singles_double(const void *in, size_t n, const carom_options *opt, void *out, uint8_t *status) {
  return single_calls(CAROM_DOUBLE, in, sizeof(carom_impact), n, opt, out, sizeof(carom_result), status);
}

size_t carom_singles_single(const void *in, size_t n, const carom_options *opt, void *out, uint8_t *status) {
  return single_calls(CAROM_SINGLE, in, sizeof(carom_impact_f32), n, opt, out, sizeof(carom_result_f32), status);
}
