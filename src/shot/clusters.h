/* Contacts that last in a shot: see clusters.c. */
#ifndef CAROM_SRC_SHOT_CLUSTERS_H
#define CAROM_SRC_SHOT_CLUSTERS_H

#include "cluster/cluster.h"
#include "shot/sim.h"

/* Whether a third ball is so near to i or j, which touch now, that it may be in a cluster with
 * them. */
bool carom_third_is_near(const carom_sim *sim, int i, int j);

/* The cluster around balls i < j, which touch now and close at the speed of slow contacts or
 * faster. Returns how many contacts had an impulse, in the order of order[]; 0 where the contact
 * of i and j is one of two balls alone, or the cluster takes more than it may: the contacts of
 * this instant then are resolved one by one. */
int carom_cluster_now(carom_sim *sim, int i, int j, carom_cluster_state *c,
                      uint8_t order[CAROM_CLUSTER_CONTACTS]);

/* The motion of a ball after its cluster. */
void carom_cluster_take(const carom_cluster_ball *b, carom_ball_state *s);

#endif
