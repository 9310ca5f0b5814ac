/* double_rsqrt14: double with AVX-512's estimate, which takes and gives double precision.
 *
 * The paper's machine had no AVX-512. 14 good bits in place of 12, the whole range of exponents, and no conversions.
 *
 * Paper: not in it. Here: 1.82, in every configuration of clang, because this function always gets AVX-512's 32 registers and
 * fused multiply-adds: nothing is spilt.
 */
#include "rung.h"

#include <immintrin.h>
#include <tgmath.h>

/* About 1/sqrt(x), to 14 bits; infinity for 0. */
CAROM_TARGET_AVX512 static inline double rsqrt(double x) {
  return _mm_cvtsd_f64(_mm_rsqrt14_sd(_mm_set_sd(x), _mm_set_sd(x)));
}

typedef double real;

CAROM_TARGET_AVX512 void carom_rung_double_rsqrt14(carom_local *state, int N) {
  carom_local c = *state;
#include "scalar.h"
  *state = c;
}
