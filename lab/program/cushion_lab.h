/* `carom-lab verify --cushion`: the models of the cushion, verified. */
#ifndef CAROM_LAB_CUSHION_LAB_H
#define CAROM_LAB_CUSHION_LAB_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Compares `draws` random impacts of each kind with the reference (lab/stress/reference.h), and the recorded impacts in
 * `folder` with pooltool's. Prints a table, or CSV; `*pass` becomes false if a bound is not met. False after a complaint. */
bool cushion_verify(FILE *out, const char *folder, int draws, uint64_t seed, bool csv, bool *pass);

#endif
