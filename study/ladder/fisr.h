/* The text of the rungs with Walsh's "fast inverse square root": the loops of `double` and `float`
 * with the bit trick in place of the instruction.
 *
 * The bits of a float, halved as an integer, are about half its logarithm. Subtracted from a
 * constant they are the bits of a first estimate of 1/sqrt(x), and each Newton step improves it.
 *
 *     Newton steps   relative error at most   correct bits
 *     1              1.8e-3                   9
 *     2              5e-6                     17
 *
 * The instruction has 12 correct bits. In the chain of a step, a shift, a subtraction and four
 * products for each Newton step take the place of one instruction.
 *
 * Paper: all variants are slower than the instruction.
 *
 * A rung that includes this file once defines before it:
 *
 *     RUNG_FUNCTION  its function
 *     RUNG_BITS      64 or 32, the precision of its loops: those of `double` or of `float`
 *     TRICK_BITS     64 or 32, the precision of the trick; a rung of 64 bits converts to 32
 *     NEWTON_STEPS   1 or 2
 *
 * The parameters are macros, because the machine code is to be that of a file written out: a
 * compiler chooses other instructions where it has inlined the loops of a function, or unrolled
 * the Newton steps itself.
 */
#include "rung.h"

#include <stdint.h>
#include <tgmath.h>

#if RUNG_BITS == 64
typedef double real;
typedef carom_local local;
#define REAL(digits) digits
#define LOCAL_OF(state) *(state)
#define PUT_BACK(c, state) *(state) = (c)
#else
typedef float real;
typedef carom_local_f32 local;
#define REAL(digits) digits##f
#define LOCAL_OF(state) carom_to_single(state)
#define PUT_BACK(c, state) carom_from_single(&(c), state)
#endif

#if TRICK_BITS == 64
typedef double trick_real;
typedef uint64_t trick_bits;
#define TRICK(digits) digits
#define FIRST_ESTIMATE 0x5fe6eb50c7b537a9u
#else
typedef float trick_real;
typedef uint32_t trick_bits;
#define TRICK(digits) digits##f
#define FIRST_ESTIMATE 0x5f3759dfu
#endif

/* About 1/sqrt(x); for 0 a large number, 1e19 in 32 bits and 1e154 in 64. */
static inline trick_real trick(trick_real x) {
  union {
    trick_real number;
    trick_bits bits;
  } y = {x};
  y.bits = FIRST_ESTIMATE - (y.bits >> 1);
  y.number *= TRICK(1.5) - TRICK(0.5) * x * y.number * y.number;
#if NEWTON_STEPS == 2
  y.number *= TRICK(1.5) - TRICK(0.5) * x * y.number * y.number;
#endif
  return y.number;
}

static inline real rsqrt(real x) {
  return trick((trick_real)x);
}

void RUNG_FUNCTION(carom_local *state, int N) {
  local c = LOCAL_OF(state);
  const real M = c.M_i, R = c.R, sR = c.s * c.R;
  const real recM = REAL(1.0) / M;
  const real C = REAL(5.0) / (REAL(2.0) * M * R);

  real u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
  real u_z = R * (c.w_ix + c.w_jx);
  real d_x = c.v_ix + sR * c.w_iy, d_y = c.v_iy - sR * c.w_ix;
  real b_x = c.v_jx + sR * c.w_jy, b_y = c.v_jy - sR * c.w_jx;
  real ru = rsqrt(u_x * u_x + u_z * u_z);
  real v_n = c.v_jy - c.v_iy;

  const real DP = REAL(0.5) * (REAL(1.0) + c.e) * M * fabs(v_n) / (real)N;
  real W = REAL(0.0);

  while (v_n <= REAL(0.0)) {
    if (ru <= REAL(1e16)) {
      const real t = -c.mu_b * DP * ru;
      const real DP1 = t * u_x;
      const real Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabs(u_z) >= REAL(1e-16)) {
        const real DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < REAL(0.0)) {
          const real rb = rsqrt(b_x * b_x + b_y * b_y);
          if (rb < INFINITY) {
            const real t_j = -c.mu_j * rb;
            const real DP_jx = t_j * b_x * DP2;
            const real DP_jy = t_j * b_y * DP2;
            c.v_jx += DP_jx * recM;
            c.v_jy += DP_jy * recM;
            c.w_jx += C * DP_jy;
            c.w_jy -= C * DP_jx;
          }
        } else {
          const real rd = rsqrt(d_x * d_x + d_y * d_y);
          if (rd < INFINITY) {
            const real t_i = c.mu_i * rd;
            const real DP_ix = t_i * d_x * DP2;
            const real DP_iy = t_i * d_y * DP2;
            c.v_ix += DP_ix * recM;
            c.v_iy += DP_iy * recM;
            c.w_ix += C * DP_iy;
            c.w_iy -= C * DP_ix;
          }
        }
      }
      u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
      u_z = R * (c.w_ix + c.w_jx);
      ru = rsqrt(u_x * u_x + u_z * u_z);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;

    const real v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W -= v_n_old + v_n;
  }

  const real W_f = (REAL(1.0) + c.e * c.e) * W;
  while (W < W_f) {
    if (ru <= REAL(1e16)) {
      const real t = -c.mu_b * DP * ru;
      const real DP1 = t * u_x;
      const real Dw_z = C * -DP1;
      c.v_ix += DP1 * recM;
      c.v_jx -= DP1 * recM;
      c.w_iz += Dw_z;
      c.w_jz += Dw_z;
      if (fabs(u_z) >= REAL(1e-16)) {
        const real DP2 = t * u_z;
        c.w_ix += C * DP2;
        c.w_jx += C * DP2;
        if (u_z < REAL(0.0)) {
          const real rb = rsqrt(b_x * b_x + b_y * b_y);
          const real t_j = -c.mu_j * rb;
          const real DP_jx = t_j * b_x * DP2;
          const real DP_jy = t_j * b_y * DP2;
          c.v_jx += DP_jx * recM;
          c.v_jy += DP_jy * recM;
          c.w_jx += C * DP_jy;
          c.w_jy -= C * DP_jx;
        } else {
          const real rd = rsqrt(d_x * d_x + d_y * d_y);
          const real t_i = c.mu_i * rd;
          const real DP_ix = t_i * d_x * DP2;
          const real DP_iy = t_i * d_y * DP2;
          c.v_ix += DP_ix * recM;
          c.v_iy += DP_iy * recM;
          c.w_ix += C * DP_iy;
          c.w_iy -= C * DP_ix;
        }
      }
      u_x = c.v_ix - c.v_jx - R * (c.w_iz + c.w_jz);
      u_z = R * (c.w_ix + c.w_jx);
      ru = rsqrt(u_x * u_x + u_z * u_z);
    }
    c.v_iy -= DP * recM;
    c.v_jy += DP * recM;

    d_x = c.v_ix + sR * c.w_iy;
    d_y = c.v_iy - sR * c.w_ix;
    b_x = c.v_jx + sR * c.w_jy;
    b_y = c.v_jy - sR * c.w_jx;

    const real v_n_old = v_n;
    v_n = c.v_jy - c.v_iy;
    W += v_n_old + v_n;
  }
  PUT_BACK(c, state);
}
