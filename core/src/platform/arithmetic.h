/* What the bits of `plain` need: every operation is rounded by itself, as IEEE 754 says,
 * whatever flags the sources are compiled with. Every source of the library includes this before
 * its own code, so it holds without our CMake files too; the test platforms/flags compiles them
 * so.
 *
 * Fused multiply-adds are switched off here. Flags by which compilers change results are rejected:
 * here by their macros; in isa.c, the flags for which clang has no macro. No source can see
 * -ffp-contract=fast in clang's flags, which overrides the pragma: our CMake files override that
 * flag, others must not give it. Nor can a source see that a program is linked with -ffast-math:
 * gcc then has it flush subnormal numbers to zero. */
#ifndef CAROM_SRC_PLATFORM_ARITHMETIC_H
#define CAROM_SRC_PLATFORM_ARITHMETIC_H

#include <float.h>

/* In spite of -ffp-contract=off gcc 12 fuses alternate sums and differences of products where it
 * packs straight-line code into vectors (fmaddsub), and reportedly gcc 16 fuses in loops too for
 * RISC-V's vectors. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__) && defined(__riscv)
#pragma GCC optimize("fp-contract=off", "no-tree-vectorize")
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize")
#endif

#if defined(_M_FP_FAST)
#error "carom promises bits: compile its sources without /fp:fast"
#elif defined(__FAST_MATH__)
#error "carom promises bits: compile its sources without -ffast-math, -Ofast, -ffp-model=fast"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0
#error "carom finds bad input by NaN and infinity: compile its sources without -ffinite-math-only"
#elif defined(__ASSOCIATIVE_MATH__) && defined(__RECIPROCAL_MATH__)
#error "carom promises bits: compile its sources without -funsafe-math-optimizations"
#elif defined(__ASSOCIATIVE_MATH__)
#error "carom promises bits: compile its sources without -fassociative-math"
#elif defined(__RECIPROCAL_MATH__)
#error "carom promises bits: compile its sources without -freciprocal-math"
#elif defined(__NO_SIGNED_ZEROS__)
#error "carom promises bits: compile its sources without -fno-signed-zeros"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 /* 16: half precision too in its own */
#error "carom promises bits: compile its sources with -msse2 -mfpmath=sse, not -mfpmath=387"
#elif defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "carom hashes and seals bytes: compile its sources with a compiler for little endian"
#endif
_Static_assert(sizeof 0.1 == sizeof(double),
               "carom promises bits: compile its sources without -fsingle-precision-constant");

#endif
