/* Values of options that several subcommands take. */
#ifndef CAROM_CLI_OPTION_H
#define CAROM_CLI_OPTION_H

#include <stdbool.h>

/* Reads the value of --steps. Complains and returns false if it is no whole number of 1 or more. */
bool option_steps(const char *text, int *steps);

#endif
