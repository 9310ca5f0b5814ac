/* The vocabulary of lanes.h for a single collision: a vreal is one number, a vmask is 0 or 1. Every
 * function does to it the same as its namesake there to each lane, with the same bits; the
 * estimates are from the same instructions on one number. */
#ifndef CAROM_SRC_BALL_BALL_SCALAR_H
#define CAROM_SRC_BALL_BALL_SCALAR_H

#define LANES 1
#define CHUNK 1
typedef real vreal;
typedef int vmask;

#ifdef CAROM_LANES_F32
#define LANE(name) name##f
#else
#define LANE(name) name
#endif

static inline vreal v_splat(real x) {
  return x;
}
static inline vmask v_less(vreal a, vreal b) {
  return a < b;
}
static inline vmask v_less_equal(vreal a, vreal b) {
  return a <= b;
}
static inline vmask v_equal(vreal a, vreal b) {
  return a == b;
}
static inline vmask v_all(void) {
  return 1;
}
static inline vmask v_not(vmask m) {
  return !m;
}
static inline vreal v_select(vmask m, vreal yes, vreal no) {
  return m ? yes : no;
}
static inline unsigned v_bits(vmask m) {
  return (unsigned)m;
}
static inline bool v_any(vmask m) {
  return m != 0;
}
/* Does it hold in more than so many lanes? */
static inline bool v_more(vmask m, int count) {
  return m > count;
}
static inline vreal v_abs(vreal x) {
  return LANE(fabs)(x);
}
/* As the instruction: b if either is not a number. */
static inline vreal v_max(vreal a, vreal b) {
  return a > b ? a : b;
}
static inline vreal v_min(vreal a, vreal b) {
  return a < b ? a : b;
}
static inline vreal v_sqrt(vreal x) {
  return LANE(sqrt)(x);
}
static inline vreal v_fma(vreal a, vreal b, vreal c) {
#if V_FUSES
  return LANE(fma)(a, b, c);
#else
  return a * b + c;
#endif
}
static inline vreal v_fnma(vreal a, vreal b, vreal c) {
  return v_fma(-a, b, c);
}

#if V_ESTIMATES
static inline vreal v_estimate_reciprocal(vreal x) {
  vreal y;
#if defined(CAROM_LANES_AVX512) && defined(CAROM_LANES_F32)
  __asm__("vrcp14ss %1, %1, %0" : "=v"(y) : "v"(x));
#elif defined(CAROM_LANES_AVX512)
  __asm__("vrcp14sd %1, %1, %0" : "=v"(y) : "v"(x));
#elif defined(CAROM_LANES_AVX2)
  __asm__("vrcpss %1, %1, %0" : "=x"(y) : "x"(x));
#else
  __asm__("rcpss %1, %0" : "=x"(y) : "x"(x));
#endif
  return y;
}
static inline vreal v_estimate_reciprocal_sqrt(vreal x) {
  vreal y;
#if defined(CAROM_LANES_AVX512) && defined(CAROM_LANES_F32)
  __asm__("vrsqrt14ss %1, %1, %0" : "=v"(y) : "v"(x));
#elif defined(CAROM_LANES_AVX512)
  __asm__("vrsqrt14sd %1, %1, %0" : "=v"(y) : "v"(x));
#elif defined(CAROM_LANES_AVX2)
  __asm__("vrsqrtss %1, %1, %0" : "=x"(y) : "x"(x));
#else
  __asm__("rsqrtss %1, %0" : "=x"(y) : "x"(x));
#endif
  return y;
}
#endif

/* A row of memory is a column of one lane. */
static inline void v_load_columns(const real *const row[LANES], int offset, vreal column[]) {
  column[0] = row[0][offset];
}
static inline void v_store_columns(real *const row[LANES], int offset, const vreal column[]) {
  row[0][offset] = column[0];
}

#endif
