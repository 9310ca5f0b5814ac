/* What every rung of the ladder sees: the state in the collision frame, and the one signature.
 *
 * A rung takes two approaching balls of equal mass from the instant of contact to the end of the
 * collision, in about N steps of Mathavan's algorithm (physics and symbols:
 * core/src/ball_ball/euler.c). Getting into the frame and out of it, and refusing what a rung could
 * not end or could not represent, is done once for all of them in resolve.c; so a rung is the
 * loop and nothing else, and `diff cse.c reorder.c` shows the idea of reorder and nothing else.
 *
 * Names in the rungs: u, d, b are the slip velocities at the contacts A (ball on ball), D (ball
 * i on the cloth), B (ball j on the cloth); ru, rd, rb the reciprocals of their magnitudes; DP a
 * normal impulse, DP1, DP2, DP_ix ... the friction impulses.
 */
#ifndef CAROM_LADDER_RUNG_H
#define CAROM_LADDER_RUNG_H

#include "ball_ball/frame.h"

/* Advances `state` from contact to the end of the collision; a rung across collisions, as many
 * states in a row as its width. Needs v_jy < v_iy, M_i = M_j, and N steps that are resolved in
 * the rung's precision: resolve.c says what exactly. */
typedef void carom_rung(carom_local *state, int N);

/* The collisions that a call of a rung takes are CAROM_WIDTH_<name>. */
#define RUNG(name, parent, precision, isa, width, bound, paper, over_1e3, over_1e2, idea) \
  carom_rung carom_rung_##name;                                                           \
  enum { CAROM_WIDTH_##name = width };
#include "kernels.def"
#undef RUNG

/* Rungs that need more than x86-64's baseline say so function by function, because the
 * configurations o3 and novec do not. */
#define CAROM_TARGET_AVX2 __attribute__((target("avx2,fma")))
#define CAROM_TARGET_AVX512 __attribute__((target("avx512f,avx512vl,fma")))

/* carom_local in single precision. */
#define CAROM_LOCAL_FIELDS(X) \
  X(v_ix)                     \
  X(v_iy)                     \
  X(w_ix)                     \
  X(w_iy)                     \
  X(w_iz)                     \
  X(v_jx) X(v_jy) X(w_jx) X(w_jy) X(w_jz) X(M_i) X(M_j) X(R) X(mu_i) X(mu_j) X(mu_b) X(e) X(s)

typedef struct carom_local_f32 {
#define FIELD(name) float name;
  CAROM_LOCAL_FIELDS(FIELD)
#undef FIELD
} carom_local_f32;

static inline carom_local_f32 carom_to_single(const carom_local *c) {
  carom_local_f32 f;
#define FIELD(name) f.name = (float)c->name;
  CAROM_LOCAL_FIELDS(FIELD)
#undef FIELD
  return f;
}

static inline void carom_from_single(const carom_local_f32 *f, carom_local *c) {
#define FIELD(name) c->name = f->name;
  CAROM_LOCAL_FIELDS(FIELD)
#undef FIELD
}

#endif
