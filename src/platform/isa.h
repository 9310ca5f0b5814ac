/* Instruction sets: which this build has, which the processor has, and which is in force. See isa.c. */
#ifndef CAROM_SRC_PLATFORM_ISA_H
#define CAROM_SRC_PLATFORM_ISA_H

/* X(NAME, suffix) for the sets that sources are compiled for; see CMakeLists.txt. */
#if defined(__x86_64__)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) X(SSE2, sse2) X(AVX2, avx2) X(AVX512, avx512)
#elif defined(__aarch64__)
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain) X(NEON, neon)
#else
#define CAROM_BUILT_ISAS(X) X(PLAIN, plain)
#endif

#endif
