/* Values of options that several subcommands take. Each function complains and returns false where the text is none. */
#ifndef CAROM_CLI_OPTION_H
#define CAROM_CLI_OPTION_H

#include "kernel.h"

#include <stdbool.h>

/* A whole number from `least`; `option` is its name for the complaint. */
bool option_count(const char *option, const char *text, int least, int *count);

/* --steps: a whole number of 1 or more. */
bool option_steps(const char *text, int *steps);

/* --slip: paper or pooltool. */
bool option_slip(const char *text, carom_slip *slip);

/* --kernel: a name in the table of kernels. */
bool option_kernel(const char *text, const kernel **one);

/* --budget: seconds, more than 0 and at most a day. */
bool option_budget(const char *text, double *seconds);

/* --precision: double or single. */
bool option_precision(const char *text, bool *single);

/* --friction: "alciatore", or "alciatore=a,b,c". */
bool option_law(const char *text, carom_speed_law *law);

#endif
