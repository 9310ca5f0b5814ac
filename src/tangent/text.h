/* The sources of motion, contacts and the strike once more, with a number that carries
 * derivatives for every double. All of it stands in a namespace of its own, beside the same
 * types of plain doubles, and nothing of it is seen by the linker. Each source is checked as C;
 * so this file counts as one of the system, whose warnings the compiler keeps to itself. */
#ifndef CAROM_SRC_TANGENT_TEXT_H
#define CAROM_SRC_TANGENT_TEXT_H
#pragma GCC system_header

#include "tangent/dual.h"
extern "C" {
#include "contact_law/variation.h"
#include "cushion/models.h"
#include "shot/shot.h"
}

/* Headers that plain doubles have had already. */
#undef CAROM_H
#undef CAROM_SHOT_H
#undef CAROM_SRC_PLATFORM_ELEMENTARY_H
#undef CAROM_SRC_CUSHION_CONTACT_H
#undef CAROM_SRC_CUSHION_MODELS_H
#undef CAROM_SRC_CONTACT_LAW_IMPACT_H
#undef CAROM_SRC_CONTACT_LAW_LAW_H
#undef CAROM_SRC_SHOT_SHOT_H
#undef CAROM_SRC_TABLE_TABLE_H
#undef CAROM_SRC_MOTION_PATH_H
#undef CAROM_SRC_MOTION_STRIKE_H
#undef CAROM_SRC_PLATFORM_RANGES_H

/* Declarations of C with another type in them would be other functions for the same symbols. */
#pragma push_macro("__cplusplus")
#undef __cplusplus
#define _WCHAR_T /* a word of C++, which headers of C would define */
#undef _Static_assert
#define _Static_assert(...) static_assert(true, "")
#pragma push_macro("CAROM_API")
#undef CAROM_API

namespace {
namespace text {
#define double number

#define carom_table carom_whole_table
#include "carom.h"
#include "carom_shot.h"
#undef carom_table
#undef CAROM_API
#define CAROM_API

/* An event has at most one part of a table and two balls: there is room for these, all at place
 * 0 or 1. */
typedef struct carom_table {
  int64_t rails, jaws, pockets;
  carom_rail rail[1];
  carom_jaw jaw[1];
  carom_pocket pocket[1];
  double ball_radius;
} carom_table;
#define CAROM_RAILS_MOST 1
#define CAROM_JAWS_MOST 1
#define CAROM_POCKETS_MOST 1
#define CAROM_BALLS_MOST 2
#include "shot/sim.h"
#undef CAROM_RAILS_MOST
#undef CAROM_JAWS_MOST
#undef CAROM_POCKETS_MOST
#undef CAROM_BALLS_MOST

#include "ball_ball/arguments.h"
#include "ball_ball/euler.h"
#include "ball_ball/reduced.h"
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cushion/models.h"
#include "platform/elementary.h"
#include "platform/threads.h"

/* ---- Functions with derivatives of their own ---- */

double carom_exp(double x) {
  const real y = ::carom_exp(x.x);
  return {y, x.d * y};
}
double carom_log(double x) {
  return {::carom_log(x.x), x.d * (1 / x.x)};
}
/* Its logarithm is -q ln(1 + z), z = x^(1/(2 q)). */
double carom_bend(double x, double q) {
  const real y = ::carom_bend(x.x, q.x), z_log = ::carom_log(x.x) / (2 * q.x),
             z = ::carom_exp(z_log), share = z / (1 + z);
  return z > 0 ? number(y, x.d * (-0.5 * y * share / x.x) +
                               q.d * (y * (share * z_log - ::carom_log(1 + z))))
               : number(y);
}
void carom_sincos(double x, double *sine, double *cosine) {
  real s, c;
  ::carom_sincos(x.x, &s, &c);
  *sine = number(s, x.d * c);
  *cosine = number(c, x.d * -s);
}
void carom_sincos_degrees(double degrees, double *sine, double *cosine) {
  const real radians = 0.017453292519943295;
  real s, c;
  ::carom_sincos_degrees(degrees.x, &s, &c);
  *sine = number(s, degrees.d * (radians * c));
  *cosine = number(c, degrees.d * (radians * -s));
}
double carom_atan(double x) {
  return {::carom_atan(x.x), x.d * (1 / (1 + x.x * x.x))};
}
double carom_acos(double x) {
  const real square = 1 - x.x * x.x;
  return square > 0 ? number(::carom_acos(x.x), x.d * (-1 / __builtin_sqrt(square)))
                    : number(::carom_acos(x.x));
}
/* Where both are 0, but for rounding, each direction takes the one of its own derivatives: minmod
 * of a change is the change of minmod, to either side. */
double carom_minmod(double a, double b) {
  const bool by_a = __builtin_fabs(a.x) < __builtin_fabs(b.x);
  number c = ::carom_minmod(a.x, b.x);
  if (c.x != 0) {
    look(a, b);
    c.d = by_a ? a.d : b.d;
  }
  for (int k = 0; k < CLOCK; k++)
    if (__builtin_fmax(__builtin_fabs(a.x), __builtin_fabs(b.x)) <=
        1e-12 * (__builtin_fabs(a.d[k]) + __builtin_fabs(b.d[k])))
      c.d[k] = ::carom_minmod(a.d[k], b.d[k]);
  return c;
}
carom_speed_law carom_alciatore(void) {
  const ::carom_speed_law law = ::carom_alciatore();
  return {law.a, law.b, law.c};
}
/* Arguments have been checked; batches and two balls by Euler's steps have no derivatives. */
carom_status carom_cushion_check_impact(const carom_cushion_impact *, int *) {
  return CAROM_OK;
}
carom_status carom_cushion_check_options(const carom_cushion_options *) {
  return CAROM_OK;
}
carom_status carom_euler(carom_local *, int, int64_t, carom_euler_run *) {
  return CAROM_ERROR_TANGENT;
}
size_t carom_in_threads(carom_part_worker *, const void *, size_t, int, size_t) {
  return 0;
}
void carom_rail_line(const carom_rail *, double *) {
}
/* Clusters are followed by follow_cluster.cpp. */
carom_status carom_check_ball(const carom_shot_ball *, bool) {
  return CAROM_OK;
}
carom_status carom_check_shot_options(const carom_shot_options *) {
  return CAROM_OK;
}
int carom_cluster_members(carom_cluster_state *, int, int) {
  return -1;
}
bool carom_cluster_solve(carom_cluster_state *) {
  return false;
}
int carom_cluster_members_of_tip(carom_cluster_state *, double) {
  return -1;
}
void carom_cluster_tip_of(carom_cluster_state *, int, const double *, double) {
}
void carom_cluster_push_alone(carom_cluster_state *) {
}
void carom_cluster_put_on_slate(carom_cluster_state *) {
}
double carom_cluster_slate_impulse(const carom_cluster_state *, int) {
  return 0.0;
}

#include "tangent/exact.h"

/* ---- The sources; names that two of them have for their own ---- */

#include "cushion/closed.c"
#define defaults cushion_defaults
#include "cushion/cushion.c"
#undef defaults
#include "cushion/stronge.c"
#include "motion/path.c"
#include "shot/models.c"
#include "shot/raised.c"
#include "shot/slate.c"
#include "table/nose.c"
#define contact slow_contact
#include "shot/resolve.c"
#undef contact
#include "shot/spheres.c"
#define positive cue_positive
#include "motion/strike.c"
#undef positive
#define check cluster_check
#define contact_of cluster_contact_of
#include "shot/clusters.c"
#undef contact_of
#undef check

#undef double
} // namespace text
} // namespace

#undef CAROM_API
#pragma pop_macro("CAROM_API")
#undef _Static_assert
#define _Static_assert static_assert
#pragma pop_macro("__cplusplus")

#endif
