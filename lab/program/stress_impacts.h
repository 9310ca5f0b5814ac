/* `carom-lab stress --cushion` and `--coincidences`: see stress_impacts.c. */
#ifndef CAROM_LAB_STRESS_IMPACTS_H
#define CAROM_LAB_STRESS_IMPACTS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Draws `draws` impacts of each kind, solves and judges them, and prints a table. Returns whether the contract holds. */
bool stress_impacts(FILE *out, bool coincidences, int draws, uint64_t seed, int threads);

#endif
