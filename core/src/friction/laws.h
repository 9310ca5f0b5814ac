/* Friction between two balls by a law of their slip: each law is here once, in one row. It is
 * called for two balls, for spheres in space and for contacts that last.
 *
 * X(NAME, name, of, numbers, at, ahead, sources, text)
 *
 * of:      the law whose numbers in schema/numbers.h it reads: itself, or another.
 * numbers: k[0], k[1], k[2] of a ball of `kind`; a pair has the mean of each. All 0 is no friction.
 * at:      the coefficient at a slip of u, m/s.
 * ahead:   in a contact that lasts: the coefficient once the slip has grown by x, m/s, within a
 *          step, beyond that at which it is mu; to first order is enough. */
#ifndef CAROM_SRC_FRICTION_LAWS_H
#define CAROM_SRC_FRICTION_LAWS_H

#include "platform/elementary.h"
#include "schema/sources.h"

#define CAROM_FRICTION_LAWS(X)                                                                     \
  X(ALCIATORE, "alciatore", ALCIATORE, carom_own_law(kind, k), k[0] + k[1] * carom_exp(-k[2] * u), \
    k[0] + (mu - k[0]) * (1.0 - (k[2] * x < 1.0 ? k[2] * x : 1.0)), CAROM_BY_ALCIATORE_THROW,      \
    "by the speed of slip: law_a + law_b exp(-law_c u)")                                           \
  X(CONSTANT, "constant", CONSTANT, (void)(k[0] = kind->mu_ball), k[0], k[0], 0,                   \
    "mu_ball of the balls")

#define CAROM_LAW_VALUE(NAME, ...) CAROM_LAW_##NAME,
enum { CAROM_FRICTION_LAWS(CAROM_LAW_VALUE) CAROM_LAW_COUNT };
#undef CAROM_LAW_VALUE

#define CAROM_LAW_AT(NAME, name, of, numbers, at, ...) \
  case CAROM_LAW_##NAME:                               \
    return at;
static inline double carom_friction_at(int law, const double k[3], double u) {
  (void)u;
  switch (law) {
    CAROM_FRICTION_LAWS(CAROM_LAW_AT)
  default:
    return 0.0;
  }
}
#undef CAROM_LAW_AT

#define CAROM_LAW_AHEAD(NAME, name, of, numbers, at, ahead, ...) \
  case CAROM_LAW_##NAME:                                         \
    return ahead;
static inline double carom_friction_ahead(int law, const double k[3], double mu, double x) {
  (void)mu;
  (void)x;
  switch (law) {
    CAROM_FRICTION_LAWS(CAROM_LAW_AHEAD)
  default:
    return 0.0;
  }
}
#undef CAROM_LAW_AHEAD

#endif
