/* A cluster by numbers with one direction, follow_cluster.cpp: more directions than one would take
 * too much of the stack. */
#ifndef CAROM_SRC_TANGENT_FOLLOW_CLUSTER_H
#define CAROM_SRC_TANGENT_FOLLOW_CLUSTER_H

#include <stdbool.h>

/* The numbers of a carom_cluster_ball that its caller sets; v and W are those from 3 on. */
enum { CAROM_MEMBER_NUMBERS = 17, CAROM_MEMBER_MOTION = 3, CAROM_MOTION_NUMBERS = 6 };

typedef struct carom_tangent_cluster {
  int balls, first, second; /* members; the places of the two of the contact that starts it */
  double steps, slow;       /* as in carom_cluster_state */
  int friction;             /* the law of its balls, friction/laws.h */
  /* gives numbers and tangents of member k, and whether it flies; */
  bool (*give)(void *context, int k, double x[CAROM_MEMBER_NUMBERS],
               double d[CAROM_MEMBER_NUMBERS]);
  /* takes those of its motion, v and W. */
  void (*take)(void *context, int k, const double x[CAROM_MOTION_NUMBERS],
               const double d[CAROM_MOTION_NUMBERS]);
  void *context;
} carom_tangent_cluster;

/* False where it is not the cluster of all these balls, or takes too many steps. *kink becomes
 * true where a change to one side presses another ball on the cloth than a change to the other. */
bool carom_tangent_solve_cluster(const carom_tangent_cluster *c, bool *kink);

#endif
