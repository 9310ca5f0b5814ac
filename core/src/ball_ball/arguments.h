/* Checks of arguments, in parts: options once per call, impacts once per pair. See arguments.c. */
#ifndef CAROM_SRC_ARGUMENTS_H
#define CAROM_SRC_ARGUMENTS_H

#include "carom.h"
#include "platform/arithmetic.h"

/* Euler's N, for options that may leave it to the default. */
static inline int carom_steps(const carom_options *opt) {
  return opt->steps != 0 ? opt->steps : CAROM_DEFAULT_STEPS;
}

/* CAROM_OK, or the error of the first option at fault. */
carom_status carom_check_options(const carom_options *opt);

/* CAROM_OK, or the error of the first field at fault; `*field` is its index, or -1 where no
 * single field is to blame. */
carom_status carom_check_impact(const carom_impact *in, int *field);

#endif
