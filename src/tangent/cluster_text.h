/* The sources of clusters with a number for every double, as text.h has the others. The number
 * has one direction. */
#ifndef CAROM_SRC_TANGENT_CLUSTER_TEXT_H
#define CAROM_SRC_TANGENT_CLUSTER_TEXT_H
#pragma GCC system_header

#define CAROM_TANGENT_WIDTH 1
#define LANE_BYTES 8
#define CAROM_CLUSTER_CONTACTS \
  40 /* more would take too much of the stack; a triangle of 15
                                     balls has 30 */
#include "tangent/dual.h"
#undef CAROM_SRC_PLATFORM_RANGES_H /* plain doubles have had it */

namespace {
namespace text {
#define double number

double carom_exp(double x) {
  const real y = ::carom_exp(x.x);
  return {y, x.d * y};
}

void carom_sincos_degrees(double degrees, double *sine, double *cosine) {
  const real radians = 0.017453292519943295;
  real s, c;
  ::carom_sincos_degrees(degrees.x, &s, &c);
  *sine = number(s, degrees.d * (radians * c));
  *cosine = number(c, degrees.d * (radians * -s));
}

#include "cluster/cluster.h"
#define open least_overlap
#include "cluster/cluster.c"
#undef open
#include "cluster/members.c"
#define least_restitution least_of_tip
#include "cluster/push.c"
#undef least_restitution

#undef double
} // namespace text
} // namespace

#endif
