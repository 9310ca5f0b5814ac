/* Elementary functions by additions, multiplications and square roots only, so that their bits are the same on every system. */
#ifndef CAROM_SRC_PLATFORM_ELEMENTARY_H
#define CAROM_SRC_PLATFORM_ELEMENTARY_H

/* exp(x) for x <= 0, to 2 units in the last place; 0 below -708. */
double carom_exp_negative(double x);

/* Sine and cosine of an angle in degrees, to 2 units in the last place; exact at multiples of 90 degrees. |degrees| <= 1e15. */
void carom_sincos_degrees(double degrees, double *sine, double *cosine);

#endif
