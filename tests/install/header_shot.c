/* carom_shot.h by itself, in C and in C++, and the layouts that callers rely on. */
#include "carom_shot.h"

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_cushion_impact) == 15 * sizeof(double), "an impact is 15 doubles");
STATIC_ASSERT(sizeof(carom_motion) == 6 * sizeof(double), "a motion is 6 doubles");
STATIC_ASSERT(sizeof(carom_cushion_options) == 128,
              "options have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_CUSHION_MATHAVAN == 0 && CAROM_CUSHION_EULER == 4 && CAROM_CUSHION_SMOOTH == 5,
              "values are never changed");

STATIC_ASSERT(sizeof(carom_shot_options) == 80 && sizeof(carom_brief_event) == 24,
              "sizes that callers rely on");

/* What must not compile without a warning: the model of an impact for that of a shot. */
#ifdef MIXED
int mixed(void);
int mixed(void) {
  carom_shot_options options = {};
  options.cushion_model = CAROM_CUSHION_HAN;
  return (int)options.cushion_model;
}
#endif

int use(const carom_cushion_impact *in, carom_motion *out);
STATIC_ASSERT(sizeof(carom_shot_options) == 80 && sizeof(carom_brief_event) == 24,
              "sizes that callers rely on");

/* What must not compile without a warning: the model of an impact for that of a shot. */
#ifdef MIXED
int mixed(void);
int mixed(void) {
  carom_shot_options options = {};
  options.cushion_model = CAROM_CUSHION_HAN;
  return (int)options.cushion_model;
}
#endif

int use(const carom_cushion_impact *in, carom_motion *out) {
  return carom_cushion(in, NULL, out) == CAROM_OK;
}
