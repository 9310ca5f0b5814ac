/* Checks of arguments: options once per call, impacts once per row. See arguments.c. */
#ifndef CAROM_SRC_CUSHION_ARGUMENTS_H
#define CAROM_SRC_CUSHION_ARGUMENTS_H

#include "carom_shot.h"
#include "platform/arithmetic.h"

/* CAROM_OK, or the error of the first option at fault. */
carom_status carom_cushion_check_options(const carom_cushion_options *opt);

/* CAROM_OK, or the error of the first field at fault; `*field` is its index. */
carom_status carom_cushion_check_impact(const carom_cushion_impact *in, int *field);

/* Euler's N of options that have been checked. */
static inline int carom_cushion_steps(const carom_cushion_options *opt) {
  return opt->steps > 0 ? opt->steps : CAROM_DEFAULT_STEPS;
}

#endif
