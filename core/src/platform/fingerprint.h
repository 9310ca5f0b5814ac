/* Fingerprints of bytes: one number of 64 bits for many, which differs where they do, but for
 * chance. No secret: whoever forges the bytes can compute the number too. */
#ifndef CAROM_SRC_PLATFORM_FINGERPRINT_H
#define CAROM_SRC_PLATFORM_FINGERPRINT_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A step of a fingerprint: one to one for each word, so that a change of one word always changes
 * the result. */
static inline uint64_t carom_stir(uint64_t h, uint64_t word) {
  static const uint64_t odd = 0x9e3779b97f4a7c15u; /* 2^64 over the golden ratio */
  h ^= word;
  return (h << 27 | h >> 37) * odd;
}

/* The fingerprint of some words of 8 bytes, and of those before. Four chains, as each step waits
 * for the one before. */
static inline uint64_t carom_fingerprint(uint64_t hash, const void *bytes, size_t size) {
  enum { CHAINS = 4 };
  const unsigned char *byte = (const unsigned char *)bytes;
  uint64_t h[CHAINS] = {hash, 1, 2, 3}, word[CHAINS];
  const size_t words = size / sizeof *word, whole = words - words % CHAINS;
  for (size_t k = 0; k < whole; k += CHAINS) {
    memcpy(word, byte + k * sizeof *word, sizeof word);
    for (int c = 0; c < CHAINS; c++)
      h[c] = carom_stir(h[c], word[c]);
  }
  for (size_t k = whole; k < words; k++) {
    memcpy(word, byte + k * sizeof *word, sizeof *word);
    h[0] = carom_stir(h[0], word[0]);
  }
  for (int c = 1; c < CHAINS; c++)
    h[0] = carom_stir(h[0], h[c]);
  return h[0];
}

#endif
