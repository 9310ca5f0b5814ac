/* The tables of kernels.h. */
#include "ball_ball/kernels.h"

#include "platform/enumerations.h"

#define LANES_OF_PLAIN 4
#define LANES_OF_SSE2 4
#define LANES_OF_NEON 4
#define LANES_OF_AVX2 8
#define LANES_OF_AVX512 16

/* Where the times of calls and of steps in lanes cross, on an Intel Xeon with AVX-512, over
 * collisions of play. NEON was not measured and has the numbers of SSE2. At half of these
 * numbers steps in lanes take 15 to 60 % longer than calls, at twice of them 5 to 50 % less. */
#define FEWEST_OF_PLAIN 80, 34
#define FEWEST_OF_SSE2 24, 16
#define FEWEST_OF_NEON 24, 16
#define FEWEST_OF_AVX2 20, 13
#define FEWEST_OF_AVX512 29, 18

/* CAROM_WITHOUT_LANES leaves the steps in lanes out: every batch is then solved by calls, which
 * have the same
 * bits. That is for targets without vectors, such as WebAssembly without SIMD128, on which lanes
 * are long scalar code. */
#ifdef CAROM_WITHOUT_LANES
#define EXACT_LANES(NAME, suffix) .fewest = {UINT32_MAX, UINT32_MAX}
#else
#define EXACT_LANES(NAME, suffix)                                             \
  .fewest = {FEWEST_OF_##NAME},                                               \
  .rows_in = {carom_rows_in_##suffix##_f64, carom_rows_in_##suffix##_f32},    \
  .rows_out = {carom_rows_out_##suffix##_f64, carom_rows_out_##suffix##_f32}, \
  .first_step = carom_first_step_##suffix, .next_step = carom_next_step_##suffix
#endif

static const carom_kernels kernels[CAROM_ISA_COUNT] = {
#define ROW(NAME, suffix)                                             \
  [CAROM_ISA_##NAME] = {                                              \
      .lanes = LANES_OF_##NAME,                                       \
      EXACT_LANES(NAME, suffix),                                      \
      .call = {carom_call_##suffix##_f64, carom_call_##suffix##_f32}, \
  },
    CAROM_BUILT_ISAS(ROW)
#undef ROW
};

const carom_kernels *carom_kernels_of_call(int plain) {
  return &kernels[carom_isa_of_call(plain)];
}
