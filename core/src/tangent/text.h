/* The sources of motion, contacts and the strike once more, with a dual number (dual.h) for every
 * double. dual_copies.cmake writes these copies into dual/ in the folder of the build, where they
 * can be read. They are in their own namespace, next to the same types of plain doubles, and
 * the linker sees nothing of it. Each source is checked as C; so this file counts as one of the
 * system, whose warnings the compiler keeps to itself. */
#ifndef CAROM_SRC_TANGENT_TEXT_H
#define CAROM_SRC_TANGENT_TEXT_H
#pragma GCC system_header

#define CAROM_DUAL_WIDTH CAROM_TANGENT_WIDTH
#include "tangent/dual.h"
extern "C" {
#include "contact_law/variation.h"
#include "cushion/models.h"
#include "shot/shot.h"
}

namespace {
namespace text {

#include "dual/ball_ball/arguments.h"
#include "dual/ball_ball/euler.h"
#include "dual/ball_ball/reduced.h"
#include "dual/cluster/cluster.h"
#include "dual/cluster/cue.h"
#include "dual/cluster/nose.h"
#include "dual/cushion/models.h"
#include "dual/platform/threads.h"
#include "dual/shot/sim.h"

#include "tangent/elementary.h"

/* ---- Functions that events do not need, or that other files have ---- */

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
void carom_rail_line(const carom_rail *, number *) {
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
int carom_cluster_members_of_tip(carom_cluster_state *, number) {
  return -1;
}
void carom_cluster_tip_of(carom_cluster_state *, int, const number *, number) {
}
void carom_cluster_tip_slides(carom_cluster_state *, number, number, const number *) {
}
void carom_cluster_put_in_nose(carom_cluster_state *) {
}
bool carom_cluster_tip_comes(carom_cluster_state *) {
  return false;
}
void carom_cluster_push_alone(carom_cluster_state *) {
}
void carom_cluster_put_on_slate(carom_cluster_state *) {
}
number carom_cluster_slate_impulse(const carom_cluster_state *, int) {
  return 0.0;
}
number carom_cluster_separation(const carom_cluster_state *) {
  return 0.0;
}
void carom_cluster_limit_shifts(carom_cluster_state *) {
}

#include "tangent/exact.h"

/* ---- The sources ---- */

#include "dual/cushion/closed.c"
#include "dual/cushion/cushion.c"
#include "dual/cushion/stronge.c"
#include "dual/motion/path.c"
#include "dual/motion/strike.c"
#include "dual/shot/clusters.c"
#include "dual/shot/models.c"
#include "dual/shot/near_nose.c"
#include "dual/shot/raised.c"
#include "dual/shot/resolve.c"
#include "dual/shot/slate.c"
#include "dual/shot/spheres.c"
#include "dual/table/nose.c"
#include "dual/table/seams.c"

} // namespace text
} // namespace

#endif
