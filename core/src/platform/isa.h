/* Instruction sets: which this build has, which the processor has, and which is in force. See
 * isa.c. */
#ifndef CAROM_SRC_PLATFORM_ISA_H
#define CAROM_SRC_PLATFORM_ISA_H

#include "platform/arithmetic.h"

#include "carom.h"

/* What CAROM_ISAS of CMakeLists.txt leaves out is defined as CAROM_WITHOUT_NAME, in the sources
 * that list the sets: kernels.c, impact.c and isa.c. Functions are declared for all sets of the
 * processor's family. */
#ifdef CAROM_WITHOUT_SSE2
#define CAROM_IF_SSE2(X)
#else
#define CAROM_IF_SSE2(X) X(SSE2, sse2)
#endif
#ifdef CAROM_WITHOUT_AVX2
#define CAROM_IF_AVX2(X)
#else
#define CAROM_IF_AVX2(X) X(AVX2, avx2)
#endif
#ifdef CAROM_WITHOUT_AVX512
#define CAROM_IF_AVX512(X)
#else
#define CAROM_IF_AVX512(X) X(AVX512, avx512)
#endif
#ifdef CAROM_WITHOUT_NEON
#define CAROM_IF_NEON(X)
#else
#define CAROM_IF_NEON(X) X(NEON, neon)
#endif

/* X(NAME, suffix) for the sets of the family, and for those that sources are compiled for; see
 * CMakeLists.txt. */
#if defined(__x86_64__)
#define CAROM_FAMILY_ISAS(X) X(PLAIN, plain) X(SSE2, sse2) X(AVX2, avx2) X(AVX512, avx512)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) CAROM_IF_SSE2(X) CAROM_IF_AVX2(X) CAROM_IF_AVX512(X)
#elif defined(__aarch64__)
#define CAROM_FAMILY_ISAS(X) X(PLAIN, plain) X(NEON, neon)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) CAROM_IF_NEON(X)
#else
#define CAROM_FAMILY_ISAS(X) X(PLAIN, plain)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain)
#endif

/* The instruction set of a call with options.plain, 0 or 1. */
static inline carom_isa carom_isa_of_call(int plain) {
  return plain ? CAROM_ISA_PLAIN : carom_isa_in_force();
}

#endif
