/* The copies of the sources of clusters, as text.h has the others. Their number has one
 * direction. */
#ifndef CAROM_SRC_TANGENT_CLUSTER_TEXT_H
#define CAROM_SRC_TANGENT_CLUSTER_TEXT_H
#pragma GCC system_header

#define CAROM_DUAL_WIDTH 1
#include "tangent/dual.h"

namespace {
namespace text {

#include "dual/cluster/cluster.c"
#include "dual/cluster/members.c"
#include "dual/cluster/places.c"
#include "dual/cluster/push.c"
#include "tangent/elementary.h"

} // namespace text
} // namespace

#endif
