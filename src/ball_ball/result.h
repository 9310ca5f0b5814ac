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
    out->v_a[k] = out->w_a[k] = out->v_b[k] = out->w_b[k] = NAN;
}

/* For balls that do not collide. */
static inline void carom_copy_state(const carom_impact *in, carom_result *out) {
  memcpy(out->v_a, in->a.v, sizeof out->v_a);
  memcpy(out->w_a, in->a.w, sizeof out->w_a);
  memcpy(out->v_b, in->b.v, sizeof out->v_b);
  memcpy(out->w_b, in->b.w, sizeof out->w_b);
}

static inline bool carom_result_is_finite(const carom_result *out) {
  double sum = 0.0; /* stays 0 unless a term is infinite or NaN */
  for (int k = 0; k < 3; k++)
    sum += out->v_a[k] * 0.0 + out->w_a[k] * 0.0 + out->v_b[k] * 0.0 + out->w_b[k] * 0.0;
  return sum == 0.0;
}

#endif
