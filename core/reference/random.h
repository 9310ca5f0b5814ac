/* Random numbers by splitmix64, the same for the same seed. */
#ifndef CAROM_LAB_RANDOM_H
#define CAROM_LAB_RANDOM_H

#include <math.h>
#include <stdint.h>

typedef struct lab_random {
  uint64_t state;
} lab_random;

static inline uint64_t lab_bits(lab_random *r) {
  uint64_t z = (r->state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static inline double lab_uniform(lab_random *r, double low, double high) {
  return low + (high - low) * (double)(lab_bits(r) >> 11) * 0x1p-53;
}

/* Both ends are among the numbers. */
static inline int lab_whole(lab_random *r, int low, int high) {
  return low + (int)(lab_bits(r) % (uint64_t)(high - low + 1));
}

static inline double lab_log_uniform(lab_random *r, double low, double high) {
  return exp(lab_uniform(r, log(low), log(high)));
}

#endif
