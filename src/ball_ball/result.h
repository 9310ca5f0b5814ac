/* What a result is when nothing was solved, and whether it is one: shared by all who return a carom_result. */
#ifndef CAROM_SRC_RESULT_H
#define CAROM_SRC_RESULT_H

#include "carom.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* After an error. */
static inline void carom_fill_nan(carom_result *out) {
  for (int k = 0; k < 3; k++)
    out->a.v[k] = out->a.w[k] = out->b.v[k] = out->b.w[k] = NAN;
}

/* For balls that do not collide. */
static inline void carom_copy_state(const carom_impact *in, carom_result *out) {
  memcpy(out->a.v, in->a.v, sizeof out->a.v);
  memcpy(out->a.w, in->a.w, sizeof out->a.w);
  memcpy(out->b.v, in->b.v, sizeof out->b.v);
  memcpy(out->b.w, in->b.w, sizeof out->b.w);
}

static inline bool carom_result_is_finite(const carom_result *out) {
  double sum = 0.0; /* stays 0 unless a term is infinite or NaN */
  for (int k = 0; k < 3; k++)
    sum += out->a.v[k] * 0.0 + out->a.w[k] * 0.0 + out->b.v[k] * 0.0 + out->b.w[k] * 0.0;
  return sum == 0.0;
}

#endif
