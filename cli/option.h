/* Values of options that several subcommands take. */
#ifndef CAROM_CLI_OPTION_H
#define CAROM_CLI_OPTION_H

#include <stdbool.h>

/* Reads the value of `option` ("--steps"). Complains and returns false if it is no whole number of `least` or more. */
bool option_count(const char *option, const char *text, int least, int *count);

#endif
