/* `carom-lab stress --shots`: see stress_shots.c. */
#ifndef CAROM_LAB_STRESS_SHOTS_H
#define CAROM_LAB_STRESS_SHOTS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Plays `shots` random shots, the kinds in turn, and writes to `out` what invariants they keep. `world` and `cushion_model` as
 * in carom_shot_options; `elevated`: every cue comes from above. An exit code. */
int stress_shots(FILE *out, int shots, uint64_t seed, int world, int cushion_model, bool elevated);

#endif
