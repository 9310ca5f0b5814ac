/* Elementary functions by additions, multiplications, divisions and square roots only, so that
 * their bits are the same on every system. Errors are in units in the last place (ulp) of the
 * result, the largest that core/tests/unit/elementary.c has found. NaN gives NaN. */
#ifndef CAROM_SRC_PLATFORM_ELEMENTARY_H
#define CAROM_SRC_PLATFORM_ELEMENTARY_H

#include "platform/arithmetic.h"

/* exp(x), to 1.2 ulp; 0 below -708, infinite where it is beyond all numbers. */
double carom_exp(double x);

/* ln(x), to 3 ulp of the larger of 1 and |ln(x)|; minus infinity for 0, NaN below. */
double carom_log(double x);

/* (1 + x^(1/(2 q)))^-q, the bend between 1 and 1/sqrt(x), for 0 <= x <= 1 and 0 < q <= 1/2, to 2
 * ulp. */
double carom_bend(double x, double q);

/* Sine and cosine of an angle in degrees, to 1 ulp of 1; exact at multiples of 90 degrees.
 * |degrees| <= 1e15. */
void carom_sincos_degrees(double degrees, double *sine, double *cosine);

/* Sine and cosine of an angle in radians, |x| <= 1e6, to 1 ulp of 1. */
void carom_sincos(double x, double *sine, double *cosine);

/* The angle whose tangent is x, from -pi/2 to pi/2, to 2.5 ulp. */
double carom_atan(double x);

/* The angle whose cosine is x, from 0 to pi, to 4 ulp; NaN where |x| > 1. */
double carom_acos(double x);

/* The one nearer to 0 of two numbers of one sign; 0 where their signs differ. Exact. */
double carom_minmod(double a, double b);

#endif
