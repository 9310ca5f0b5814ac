/* The tables of kernels.h. */
#include "ball_ball/kernels.h"

#include "platform/enumerations.h"

/* Of floats in a vector. */
#define LANES_OF_PLAIN 4
#define LANES_OF_SSE2 4
#define LANES_OF_NEON 4
#define LANES_OF_AVX2 8
#define LANES_OF_AVX512 16

/* Where the times of calls and of steps in lanes cross, on a processor with AVX-512, over
 * collisions of play: in double and single precision, and mixed. NEON was not measured and has the
 * numbers that SSE2 was measured to have. At half of these numbers steps in lanes take 8 to 60 %
 * longer than calls, at twice of them 4 to 50 % less. In double precision a vector of plain C or
 * SSE2 has two lanes. Steps in these take longer than calls in plain C. By SSE2 they take up to 6 %
 * less, which is too little to justify kernels that few processors would use. */
#define FEWEST_OF_PLAIN UINT32_MAX, 34, 80
#define FEWEST_OF_SSE2 UINT32_MAX, 16, 24
#define FEWEST_OF_NEON 80, 16, 24
#define FEWEST_OF_AVX2 20, 13, 20
#define FEWEST_OF_AVX512 48, 18, 29

/* CAROM_WITHOUT_LANES leaves the steps in lanes out: every batch is then solved by calls, which
 * have the same bits. That is for targets without vectors, such as WebAssembly without SIMD128, on
 * which lanes are long scalar code. Plain C and SSE2 have no steps in lanes in double precision,
 * because no batch would take them. */
#define DOUBLE_LANES_OF_PLAIN(kernel) NULL
#define DOUBLE_LANES_OF_SSE2(kernel) NULL
#define DOUBLE_LANES_OF_NEON(kernel) kernel
#define DOUBLE_LANES_OF_AVX2(kernel) kernel
#define DOUBLE_LANES_OF_AVX512(kernel) kernel
/* Calls in double precision: every x86-64 processor has SSE2, and plain C is compiled to it. A call
 * has no use for the wider vectors of AVX-512: it takes as long as by AVX2, or 5 % longer. */
#define DOUBLE_CALL_OF_PLAIN carom_call_plain_f64
#define DOUBLE_CALL_OF_SSE2 carom_call_plain_f64
#define DOUBLE_CALL_OF_NEON carom_call_neon_f64
#define DOUBLE_CALL_OF_AVX2 carom_call_avx2_f64
#define DOUBLE_CALL_OF_AVX512 carom_call_avx2_f64
#ifdef CAROM_WITHOUT_LANES
#define EXACT_LANES(NAME, suffix) .fewest = {UINT32_MAX, UINT32_MAX, UINT32_MAX}
#else
#define EXACT_LANES(NAME, suffix)                                                                 \
  .fewest = {FEWEST_OF_##NAME},                                                                   \
  .rows_in = {DOUBLE_LANES_OF_##NAME(carom_rows_in_##suffix##_f64), carom_rows_in_##suffix##_f32, \
              carom_rows_in_##suffix##_mixed},                                                    \
  .rows_out = {DOUBLE_LANES_OF_##NAME(carom_rows_out_##suffix##_f64),                             \
               carom_rows_out_##suffix##_f32, carom_rows_out_##suffix##_mixed},                   \
  .first_step = {DOUBLE_LANES_OF_##NAME(carom_first_step_##suffix##_f64),                         \
                 carom_first_step_##suffix##_f32, carom_first_step_##suffix##_f32},               \
  .next_step = {DOUBLE_LANES_OF_##NAME(carom_next_step_##suffix##_f64),                           \
                carom_next_step_##suffix##_f32, carom_next_step_##suffix##_f32}
#endif

static const carom_kernels kernels[CAROM_ISA_COUNT] = {
#define ROW(NAME, suffix)                                                                      \
  [CAROM_ISA_##NAME] = {                                                                       \
      .lanes = {LANES_OF_##NAME / 2, LANES_OF_##NAME, LANES_OF_##NAME},                        \
      EXACT_LANES(NAME, suffix),                                                               \
      .call = {DOUBLE_CALL_OF_##NAME, carom_call_##suffix##_f32, carom_call_##suffix##_mixed}, \
  },
    CAROM_BUILT_ISAS(ROW)
#undef ROW
};

const carom_kernels *carom_kernels_of_call(int plain) {
  return &kernels[carom_isa_of_call(plain)];
}
