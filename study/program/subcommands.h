/* The subcommands of `carom-lab`, of which a file command_NAME.c each is the study's. */
#ifndef CAROM_STUDY_SUBCOMMANDS_H
#define CAROM_STUDY_SUBCOMMANDS_H

#include "program/command.h"

#define COMMAND COMMAND_DECLARED
#include "../lab/program/commands.def"
#undef COMMAND

#endif
