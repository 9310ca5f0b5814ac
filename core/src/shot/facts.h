/* What the rules of games need to know about a shot (carom_facts), noted event by event. Every
 * function but carom_facts_begin() notes into sim->shot->facts. */
#ifndef CAROM_SHOT_FACTS_H
#define CAROM_SHOT_FACTS_H

#include "shot/clusters.h"

/* The facts of a shot in which nothing has happened. */
void carom_facts_begin(carom_facts *facts);

/* Adds an event of this instant. The facts must not be NULL. */
void carom_facts_event(const carom_sim *sim, const carom_due *pending_event);

/* Notes which balls the struck ball touches, by the tolerance of the rules, before the strike. */
void carom_facts_frozen(const carom_sim *sim);

/* Adds the touches of the tip within a push whose event is noted already: how many they are, and
 * the closing speeds of the first two, m/s. */
void carom_facts_touches(const carom_sim *sim, int touches, double first, double second);

/* Adds a push with `count` contacts of balls, in their order. */
void carom_facts_push(const carom_sim *sim, const carom_cluster_state *cluster,
                      const uint8_t order[], int count);

#endif
