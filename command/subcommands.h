/* The subcommands of `carom`, a file each: command_NAME.c. */
#ifndef CAROM_CLI_SUBCOMMANDS_H
#define CAROM_CLI_SUBCOMMANDS_H

#include "program/command.h"

#define COMMAND COMMAND_DECLARED
#include "commands.def"
#undef COMMAND

#endif
