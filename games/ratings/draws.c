/* Random numbers as a function of seed, stage, row and number, so that no order of computation
 * changes a draw; and a few functions by additions, multiplications, divisions and square roots
 * only, so that their bits are the same on every system. */
#include "platform/elementary.h"
#include "random_draws.h"
#include "small_math.h"

#include <math.h>

double carom_angle_of(double x, double y) {
  if (x == 0.0 && y == 0.0)
    return 0.0;
  if (fabs(x) >= fabs(y)) {
    const double angle = carom_atan(y / x);
    if (x > 0.0)
      return angle;
    if (y >= 0.0)
      return angle + pi;
    return angle - pi;
  }
  return copysign(0.5 * pi, y) - carom_atan(x / y);
}

double carom_asin(double x) {
  return 0.5 * pi - carom_acos(x);
}

/* M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 7.1.26. */
double carom_erf(double x) {
  const double t = 1.0 / (1.0 + 0.3275911 * x);
  const double sum =
      t *
      (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  return 1.0 - sum * carom_exp(-x * x);
}

/* log(x), 0 < x < 1: x = m 2^e with m from sqrt(1/2) to sqrt(2), and log(m) = 2 artanh((m - 1) /
 * (m + 1)) by its series, whose ninth term is below 1e-14. */
static double log_of(double x) {
  int e;
  double m = frexp(x, &e);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    e--;
  }
  const double u = (m - 1.0) / (m + 1.0), u2 = u * u;
  double sum = 0.0;
  for (int k = 19; k >= 1; k -= 2)
    sum = sum * u2 + 1.0 / k;
  return 2.0 * u * sum + e * 0.69314718055994531;
}

/* The finalizer of splitmix64 (S. Vigna). */
static uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double carom_uniform(uint64_t seed, uint32_t stage, uint64_t row, uint32_t number) {
  const uint64_t odd = 0x9e3779b97f4a7c15u;
  const uint64_t place = mix(seed + odd) ^ mix(((uint64_t)stage << 32 | number) * odd + 1);
  return ((double)(mix(place + odd * (row + 1)) >> 11) + 0.5) * 0x1p-53;
}

/* The method of Box and Muller. */
void carom_normal_pair(uint64_t seed, uint32_t stage, uint64_t row, uint32_t number, double z[2]) {
  double sine, cosine;
  const double size = sqrt(-2.0 * log_of(carom_uniform(seed, stage, row, number)));
  carom_sincos(2.0 * pi * carom_uniform(seed, stage, row, number + 1), &sine, &cosine);
  z[0] = size * cosine;
  z[1] = size * sine;
}

void carom_normals(uint64_t seed, uint32_t stage, uint64_t row, double z[6]) {
  for (uint32_t k = 0; k < 6; k += 2)
    carom_normal_pair(seed, stage, row, k, &z[k]);
}
