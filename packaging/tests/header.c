/* A public header by itself, in C and in C++, and the constants and sizes that callers rely on. */
#ifndef HEADER
#define HEADER "carom.h"
#endif
#include HEADER

#ifdef __cplusplus
#define STATIC_ASSERT static_assert
#else
#define STATIC_ASSERT _Static_assert
#endif

STATIC_ASSERT(sizeof(carom_ball) == 12 * sizeof(double), "a ball is 12 doubles");
STATIC_ASSERT(sizeof(carom_impact) == 26 * sizeof(double), "an impact is 26 doubles");
STATIC_ASSERT(sizeof(carom_result) == 12 * sizeof(double), "a result is 12 doubles");
STATIC_ASSERT(CAROM_OK == 0 && CAROM_SEPARATING > 0 && CAROM_ERROR_NULL < 0,
              "signs of the statuses");

#ifdef CAROM_SHOT_H
STATIC_ASSERT(sizeof(carom_cushion_impact) == 15 * sizeof(double), "an impact is 15 doubles");
STATIC_ASSERT(sizeof(carom_motion) == 6 * sizeof(double), "a motion is 6 doubles");
STATIC_ASSERT(sizeof(carom_cushion_options) == 160,
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
#endif

#ifdef CAROM_TANGENT_H
STATIC_ASSERT(sizeof(carom_tangent_seeds) == 72, "options have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_STATE_NUMBERS == 9 && CAROM_CUE_NUMBERS == 8 && CAROM_DIRECTIONS_MOST == 64,
              "rows that callers rely on");
#endif

#ifdef CAROM_PLAN_H
STATIC_ASSERT(sizeof(carom_player) == 13 * sizeof(double), "a player is 13 doubles");
STATIC_ASSERT(sizeof(carom_plan_stroke) == 216, "choices have no gaps that a compiler may fill");
STATIC_ASSERT(CAROM_RULES_EIGHTBALL == 0 && CAROM_TURN_LOSE == 3 && CAROM_PLAN_GIVEN == 3,
              "values are never changed");
#endif

int use(const carom_impact *in, carom_result *out);
int use(const carom_impact *in, carom_result *out) {
#ifdef __cplusplus
  carom_options options = {};
#else
  carom_options options = {0};
#endif
  options.slip = CAROM_SLIP_POOLTOOL;
  return carom_collide(in, &options, out) == CAROM_OK && carom_serves(CAROM_VERSION_NUMBER);
}
