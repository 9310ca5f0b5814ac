/* The subcommands of `carom-lab`, a file each, command_NAME.c: those of the study, of this folder,
 * and of plan/lab. */
#ifndef CAROM_LAB_SUBCOMMANDS_H
#define CAROM_LAB_SUBCOMMANDS_H

#include "study/program/subcommands.h"

int command_learn(int argc, char **argv);
int command_parity(int argc, char **argv);
int command_plan(int argc, char **argv);
int command_published(int argc, char **argv);
int command_stress(int argc, char **argv);

#endif
