/* The subcommands of `carom-lab`, a file each, command_NAME.c: of the study, of this folder, and of
 * games/lab. */
#ifndef CAROM_LAB_SUBCOMMANDS_H
#define CAROM_LAB_SUBCOMMANDS_H

#include "program/command.h"

#define COMMAND COMMAND_DECLARED
#include "commands.def"
#undef COMMAND

#endif
