/* Solutions of the references of core/reference, which take long, kept in agree/references.csv. An
 * impact that is not there is solved. One of 32 that are there is solved all the same, and must
 * agree; with UPDATE=1 in the environment all are, and the missing ones are added to the file.
 * `cmake --build build --target references` makes the file anew. */
#ifndef CAROM_TESTS_KEPT_H
#define CAROM_TESTS_KEPT_H

#include "reference.h"

/* Same as reference_collide() and reference_cushion(), but without the motion if the status is
 * not REFERENCE_OK, and for `normal`, unless it is NULL: the normal impulse, and the work of the
 * normal force over compression. */
reference_status kept_collide(const carom_impact *in, carom_slip slip, carom_result *out,
                              double normal[2]);
reference_status kept_cushion(const carom_cushion_impact *in, carom_motion *out);

#endif
