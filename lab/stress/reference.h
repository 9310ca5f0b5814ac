/* A reference solution of one impact, for the study and for tests: slow, plain, and independent
 * of src/. See reference.c. */
#ifndef CAROM_LAB_REFERENCE_H
#define CAROM_LAB_REFERENCE_H

#include "carom_shot.h"

#include <stdbool.h>

/* How a reference solution ended. */
typedef enum reference_status {
  REFERENCE_OK,
  REFERENCE_SEPARATING, /* nothing approaches; the motion is that before */
  REFERENCE_ROUNDING,   /* the result depends on rounding errors of the input: it is given, but
                           not to be relied on */
  REFERENCE_FAILED,     /* the integration did not end, or its tolerances disagree */
} reference_status;

/* What is told besides the result. Errors are of velocities and R times spins, over the largest
 * of them before the impact. */
typedef struct reference_story {
  double P, W_c;   /* normal impulse; work of the normal force over compression */
  double error;    /* difference of the solutions with the two tightest tolerances */
  double rounding; /* largest difference that errors of one rounding in the slips and the
                      approach make */
  long steps;      /* of all integrations together */
} reference_story;

/* One impact that is known to be valid. story may be NULL. */
reference_status reference_collide(const carom_impact *in, carom_slip slip, carom_result *out,
                                   reference_story *story);
reference_status reference_cushion(const carom_cushion_impact *in, carom_motion *out,
                                   reference_story *story);

#endif
