/* The functions of platform/elementary.h, of dual numbers. */
#ifndef CAROM_SRC_TANGENT_ELEMENTARY_H
#define CAROM_SRC_TANGENT_ELEMENTARY_H

#include "dual/platform/elementary.h"

number carom_exp(number x) {
  const real y = ::carom_exp(x.x);
  return {y, x.d * y};
}
number carom_log(number x) {
  return {::carom_log(x.x), x.d * (1 / x.x)};
}
/* Its logarithm is -q ln(1 + z), z = x^(1/(2 q)). */
number carom_bend(number x, number q) {
  const real y = ::carom_bend(x.x, q.x), z_log = ::carom_log(x.x) / (2 * q.x),
             z = ::carom_exp(z_log), share = z / (1 + z);
  return z > 0 ? number(y, x.d * (-0.5 * y * share / x.x) +
                               q.d * (y * (share * z_log - ::carom_log(1 + z))))
               : number(y);
}
void carom_sincos(number x, number *sine, number *cosine) {
  real s, c;
  ::carom_sincos(x.x, &s, &c);
  *sine = number(s, x.d * c);
  *cosine = number(c, x.d * -s);
}
void carom_sincos_degrees(number degrees, number *sine, number *cosine) {
  const real radians = 0.017453292519943295;
  real s, c;
  ::carom_sincos_degrees(degrees.x, &s, &c);
  *sine = number(s, degrees.d * (radians * c));
  *cosine = number(c, degrees.d * (radians * -s));
}
number carom_atan(number x) {
  return {::carom_atan(x.x), x.d * (1 / (1 + x.x * x.x))};
}
number carom_acos(number x) {
  const real square = 1 - x.x * x.x;
  return square > 0 ? number(::carom_acos(x.x), x.d * (-1 / __builtin_sqrt(square)))
                    : number(::carom_acos(x.x));
}
/* Where both are 0, but for rounding, each direction uses its own derivative: minmod of a change is
 * the change of minmod, to either side. */
number carom_minmod(number a, number b) {
  const bool by_a = __builtin_fabs(a.x) < __builtin_fabs(b.x);
  number c = ::carom_minmod(a.x, b.x);
  if (c.x != 0) {
    look(a, b);
    c.d = by_a ? a.d : b.d;
  }
  for (int k = 0; k < CLOCK; k++)
    if (__builtin_fmax(__builtin_fabs(a.x), __builtin_fabs(b.x)) <=
        1e-12 * (__builtin_fabs(a.d[k]) + __builtin_fabs(b.d[k])))
      c.d[k] = ::carom_minmod(a.d[k], b.d[k]);
  return c;
}

#endif
