/* A cluster by numbers with one direction, follow_cluster.cpp: more directions than one would take
 * too much of the stack. */
#ifndef CAROM_SRC_TANGENT_FOLLOW_CLUSTER_H
#define CAROM_SRC_TANGENT_FOLLOW_CLUSTER_H

#include "carom_tangent.h"

#include <stdbool.h>
#include <stdint.h>

/* The numbers of a carom_cluster_ball that its caller sets; v and W are those from 3 on. */
enum { CAROM_MEMBER_NUMBERS = 17, CAROM_MEMBER_MOTION = 3, CAROM_MOTION_NUMBERS = 9 };
/* The numbers of a cue from speed on, and the way to its tip. */
enum { CAROM_TIP_NUMBERS = CAROM_CUE_NUMBERS + 3 };
enum { CAROM_TANGENT_TOUCHES = 54 }; /* of a cluster, at most */

typedef struct carom_tangent_cluster {
  int balls, first, second; /* members; the positions of the two of the contact that starts it; of a
                               push second is -1 */
  double steps, slow;       /* as in carom_cluster_state */
  int friction;             /* the law of its balls, friction/laws.h */
  bool on_slate;
  double tip_time; /* of the cue that pushes ball `first`, where `second` is below 0; */
  double reach, reach_rate, slowest, slowest_rate; /* m, how far it continues; m/s, of the arm */
  double tip_friction;                             /* of a further touch; 0: it is the first */
  bool nose_near, in_nose;                         /* a nose is near, and touches as all begins: */
  double normal[3], normal_rate[3], gap, gap_rate;
  /* gives the motion that its model leaves of r, v and W, which are x; */
  bool (*model)(void *context, const double x[CAROM_MOTION_NUMBERS],
                const double d[CAROM_MOTION_NUMBERS], double out[6], double rate[6]);
  /* gives the numbers of the cue and their tangents, in the order of carom_cue, and of a further
     touch the way from the centre to the tip; */
  void (*give_cue)(void *context, double x[CAROM_TIP_NUMBERS], double d[CAROM_TIP_NUMBERS]);
  /* gives numbers and tangents of member k, the last one e of its slate, and whether it flies; */
  bool (*give)(void *context, int k, double x[CAROM_MEMBER_NUMBERS + 1],
               double d[CAROM_MEMBER_NUMBERS + 1]);
  /* receives the tangents of its motion, v, W and shift, and of the impulse of the slate. */
  void (*take)(void *context, int k, const double x[CAROM_MOTION_NUMBERS + 1],
               const double d[CAROM_MOTION_NUMBERS + 1]);
  void *context;
  /* written before `take` is called: how far apart its touches are, places.c, and how long the
     integration lasts, with their tangents; the touches in their order, each by the positions of
     its two balls, and the impulse of its contact */
  double separation, separation_rate, duration;
  int touches;
  int8_t touch[CAROM_TANGENT_TOUCHES][2];
  double impulse[CAROM_TANGENT_TOUCHES], impulse_rate[CAROM_TANGENT_TOUCHES];
  /* written: of a push the speed of the cue after it, and the lead of its tip, with their
     tangents */
  double V, V_rate, lead, lead_rate;
  /* how far its arm has moved, and by what the tip is moved in addition */
  double arm, arm_rate, moved[3], moved_rate[3];
} carom_tangent_cluster;

/* False where it is not the cluster of all these balls, or takes too many steps. *kink becomes
 * true where a change to one side presses another ball on the cloth than a change to the other. */
bool carom_tangent_solve_cluster(carom_tangent_cluster *c, bool *kink);

#endif
