/* The processor as a line of text, to tell whether code compiled with -march=native belongs to
 * it. */
#ifndef CAROM_LADDER_CPU_H
#define CAROM_LADDER_CPU_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { LADDER_CPU_SIZE = 128 };

#if defined(__x86_64__)
#include <cpuid.h>

static inline uint64_t ladder_hash(uint64_t hash, uint32_t word) {
  for (int k = 0; k < 32; k += 8)
    hash = (hash ^ (word >> k & 0xff)) * 0x100000001b3u; /* FNV-1a */
  return hash;
}

/* Writes the model's name, its family, model and stepping number, and a hash of what
 * instructions it has. */
static inline void ladder_cpu(char text[LADDER_CPU_SIZE]) {
  uint32_t a, b, c, d, name[13] = {0};
  for (uint32_t leaf = 0; leaf < 3; leaf++)
    if (__get_cpuid(0x80000002u + leaf, &a, &b, &c, &d))
      memcpy(&name[4 * leaf], (const uint32_t[]){a, b, c, d}, 16);
  uint32_t signature = 0;
  uint64_t hash = 0xcbf29ce484222325u;
  if (__get_cpuid(1, &signature, &b, &c, &d)) {
    hash = ladder_hash(ladder_hash(hash, c), d);
    if (c & bit_OSXSAVE) { /* which registers the system saves decides what may be used */
      uint32_t low, high;
      __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
      hash = ladder_hash(hash, low);
    }
  }
  if (__get_cpuid_count(7, 0, &a, &b, &c, &d))
    hash = ladder_hash(ladder_hash(ladder_hash(hash, b), c), d);
  if (__get_cpuid_count(7, 1, &a, &b, &c, &d))
    hash = ladder_hash(hash, a);
  if (__get_cpuid(0x80000001u, &a, &b, &c, &d))
    hash = ladder_hash(ladder_hash(hash, c), d);
  snprintf(text, LADDER_CPU_SIZE, "%s (%08x, features %016llx)", (const char *)name,
           (unsigned)signature, (unsigned long long)hash);
}
#else
static inline void ladder_cpu(char text[LADDER_CPU_SIZE]) {
  snprintf(text, LADDER_CPU_SIZE, "not an x86 processor");
}
#endif

#endif
