/* float: double in single precision, without conversions.
 *
 * Paper: 1.87, and 1.93 with archnative, its best. Here: 1.92, and 1.95 with archnative, our best too: the two conversions
 * stood in the chain, with 3 cycles each. The price: rounding of 6e-8 a step, the larger a share of what a step adds the more
 * steps there are; the worst pair error is 1e-3 at N = 1000.
 */
#include "rung.h"

#include <tgmath.h>
#include <xmmintrin.h>

/* About 1/sqrt(x), to 12 bits; infinity for 0. */
static inline float rsqrt(float x) {
  return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set1_ps(x)));
}

typedef float real;

void carom_rung_float(carom_local *state, int N) {
  carom_local_f32 c = carom_to_single(state);
#include "scalar.h"
  carom_from_single(&c, state);
}
