/* Velocities and spins in words, for what is told of one impact. */
#ifndef CAROM_CLI_TELLING_H
#define CAROM_CLI_TELLING_H

#include <stdio.h>

/* "left" where an angle is above 0, else "right". */
const char *side_of(double degrees);

/* "1.2 m/s, 30.00 degrees to the left"; angles are from +x. Below 1e-9 of `scale`, m/s, a ball
 * is at rest. */
const char *velocity_text(const double v[2], double scale, char text[64]);

/* A line about a ball's spin after an impact, rad/s. */
void tell_spin(FILE *out, const double w[3]);

#endif
