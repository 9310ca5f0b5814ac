/* The cushion in the study's program: its models verified. */
#ifndef CAROM_LAB_CUSHION_LAB_H
#define CAROM_LAB_CUSHION_LAB_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Compares `draws` random impacts of each kind with the reference (lab/stress/reference.h), and the recorded impacts in
 * `folder` with pooltool's. Prints a table, or CSV; `*pass` becomes false if a bound is not met. False after a complaint. */
bool cushion_verify(FILE *out, const char *folder, int draws, uint64_t seed, bool csv, bool *pass);

/* Whether "--cushion" is among the arguments of a subcommand, and is taken out. */
bool cushion_asked(int *argc, char **argv);

/* `carom-lab verify --cushion`, without that argument; returns an exit code. */
int cushion_verify_command(int argc, char **argv);

#endif
