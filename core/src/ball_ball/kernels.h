/* The functions that are compiled once for every instruction set, in tables: reduction and
 * restoration of rows, collocation steps of many collisions, and one complete collision. kernels.c
 * has the tables. */
#ifndef CAROM_SRC_BALL_BALL_KERNELS_H
#define CAROM_SRC_BALL_BALL_KERNELS_H

#include "carom.h"

#include "platform/isa.h"

#include <stdint.h>

/* In what a collision is computed. MIXED, of CAROM_SOLVER_FAST: rows in double precision around
 * collocation in single precision. */
typedef enum carom_precision {
  CAROM_F64,
  CAROM_F32,
  CAROM_MIXED,
  CAROM_PRECISIONS
} carom_precision;

/* ---- Data between the kernels: rows.c reduces collisions to eight numbers each and turns their
 * solutions into velocities; between them collocation (collocate.c) solves. */

/* Reduced collisions, a column for each quantity of reduced.h in units of |v_n0| / kappa. */
enum { IN_U_X, IN_U_Z, IN_D_X, IN_D_Y, IN_KAPPA, IN_MU, IN_MU_B, IN_E, IN_COLUMNS };
/* Solutions: see problem.h. */
enum { OUT_J_C, OUT_J_Z, OUT_I_X, OUT_I_Y, OUT_OVERSHOOT, OUT_STICK, OUT_K_C, OUT_COLUMNS };
/* A collision between two steps: the columns of its state (problem.h), whether v = 0 has been
 * passed (1 or 0), and the steps that were tried (collocate.c). */
enum { LANE_STATE, LANE_RESTITUTION = 13, LANE_SHARE, LANE_CAREFUL, LANE_ATTEMPTS, LANE_COLUMNS };

enum { MOST_LANES = 16 }; /* of floats in a vector */
/* A number of each lane, in the precision of collocation. */
typedef union lane_column {
  float single_numbers[MOST_LANES];
  double double_numbers[MOST_LANES / 2];
} lane_column;
typedef lane_column step_inputs[IN_COLUMNS];
typedef lane_column step_outputs[OUT_COLUMNS];
typedef lane_column lane_state[LANE_COLUMNS];

/* Kinds of steps (collocate.c), FULL over even or over graded nodes; and the other possible
 * results: a collision is solved, or collocation rejects it. */
enum step_kind {
  EASY,
  FULL,
  FULL_GRADED,
  STICK,
  PART,
  TURN,
  STEP_KINDS,
  SOLVED = STEP_KINDS,
  REFUSED,
  STEP_ENDS
};
/* For each, the lanes for which it is next, a bit for each. */
typedef uint32_t lanes_by_step[STEP_ENDS];

/* A ball that u_z presses less, in units of |v_n0| / kappa, is not pressed; friction between the
 * balls that is less counts as this, so that quotients by it are finite. */
static const double LEAST_PRESS = 1e-10, LEAST_MU_B = 1e-9;

/* Error in p, in units of |v_n0| / kappa, that a step may add by its estimate. */
static const float carom_tolerances[CAROM_PRECISIONS] = {
    [CAROM_F64] = 2.5e-7f, [CAROM_F32] = 5e-6f, [CAROM_MIXED] = 2.5e-7f};

/* ---- The kernels */

/* The data that rows.c keeps of a register of rows, from reduction to restoration. */
typedef struct row_context {
  _Alignas(64) unsigned char bytes[3200];
} row_context;

/* Reduces as many rows as collocation has lanes, given by their numbers in an array of
 * carom_impact or its twin. Returns a bit for each row that passes every check, approaches, and
 * is within the limits of collocation; the columns of others hold junk. s: see frame.h. */
typedef uint32_t carom_rows_in(const void *in, const uint32_t row[MOST_LANES], double s,
                               row_context *context, step_inputs columns);
/* Writes the velocities, to an array of carom_result or its twin. Returns a bit for each row
 * whose numbers are all finite. */
typedef uint32_t carom_rows_out(const row_context *context, const step_outputs solution, void *out,
                                const uint32_t row[MOST_LANES]);

/* The first step, where it is an easy one, in the lanes of `good`. next: the next kind; *out:
 * of those that are SOLVED. A lane for which the others would have to wait is put off: its next
 * step is EASY again. spin: 5/2 s. */
typedef void carom_first_step(step_inputs in, uint32_t good, double spin, float tolerance,
                              step_outputs out, lanes_by_step next);
/* A step of a kind, for collisions that are at their start, or are at *at, which becomes their
 * state after it. */
typedef void carom_next_step(enum step_kind kind, int at_start, step_inputs in, double spin,
                             float tolerance, lane_state gathered, step_outputs out,
                             lanes_by_step next);

/* One reduced collision, by all steps that it takes. Returns the number of right-hand sides
 * evaluated, or 0 if no step within the tolerance leads on. */
typedef int carom_collocate_f64(const double in[IN_COLUMNS], double spin, float tolerance,
                                double out[OUT_COLUMNS]);
typedef int carom_collocate_f32(const float in[IN_COLUMNS], double spin, float tolerance,
                                float out[OUT_COLUMNS]);
/* One row from end to end. Returns the same number, 0 also for a row that is not good; *solution
 * may be NULL. */
typedef int carom_one_call(const void *in, double s, void *out, double solution[OUT_COLUMNS]);

typedef struct carom_kernels {
  int lanes[CAROM_PRECISIONS]; /* collisions that collocation solves at once */
  /* Fewest rows of a batch for which steps in lanes take no longer than calls, in collisions of
   * play. */
  uint32_t fewest[CAROM_PRECISIONS];
  carom_rows_in *rows_in[CAROM_PRECISIONS];
  carom_rows_out *rows_out[CAROM_PRECISIONS];
  carom_first_step *first_step[CAROM_PRECISIONS];
  carom_next_step *next_step[CAROM_PRECISIONS];
  carom_one_call *call[CAROM_PRECISIONS];
} carom_kernels;

#define CAROM_KERNEL_PROTOTYPES(NAME, suffix)                                        \
  carom_rows_in carom_rows_in_##suffix##_f64, carom_rows_in_##suffix##_f32,          \
      carom_rows_in_##suffix##_mixed;                                                \
  carom_rows_out carom_rows_out_##suffix##_f64, carom_rows_out_##suffix##_f32,       \
      carom_rows_out_##suffix##_mixed;                                               \
  carom_first_step carom_first_step_##suffix##_f64, carom_first_step_##suffix##_f32; \
  carom_next_step carom_next_step_##suffix##_f64, carom_next_step_##suffix##_f32;    \
  carom_collocate_f64 carom_collocate_##suffix##_f64;                                \
  carom_collocate_f32 carom_collocate_##suffix##_f32;                                \
  carom_one_call carom_call_##suffix##_f64, carom_call_##suffix##_f32, carom_call_##suffix##_mixed;
CAROM_FAMILY_ISAS(CAROM_KERNEL_PROTOTYPES)
#undef CAROM_KERNEL_PROTOTYPES

/* In a source of kernels: the build's precision; the numbers of a column; the name of a kernel of
 * the build's instruction set, of its precision or of collocation's. */
#ifdef CAROM_LANES_SUFFIX
#if defined(CAROM_LANES_F32)
#define KERNEL_SUFFIX f32
#define KERNEL_PRECISION CAROM_F32
#elif defined(CAROM_LANES_MIXED)
#define KERNEL_SUFFIX mixed
#define KERNEL_PRECISION CAROM_MIXED
#else
#define KERNEL_SUFFIX f64
#define KERNEL_PRECISION CAROM_F64
#endif
#if defined(CAROM_LANES_F32) || defined(CAROM_LANES_MIXED)
#define COLLOCATED_SUFFIX f32
#define LANE_NUMBERS(column) ((column).single_numbers)
#else
#define COLLOCATED_SUFFIX f64
#define LANE_NUMBERS(column) ((column).double_numbers)
#endif
#define KERNEL_PASTE(a, b) a##_##b
#define KERNEL_PASTE_EXPANDED(a, b) KERNEL_PASTE(a, b)
#define KERNEL_OF_SET(name) KERNEL_PASTE_EXPANDED(name, CAROM_LANES_SUFFIX)
#define KERNEL(name) KERNEL_PASTE_EXPANDED(KERNEL_OF_SET(name), KERNEL_SUFFIX)
#define COLLOCATION_KERNEL(name) KERNEL_PASTE_EXPANDED(KERNEL_OF_SET(name), COLLOCATED_SUFFIX)
#endif

/* The kernels of a call with options.plain, 0 or 1. */
const carom_kernels *carom_kernels_of_call(int plain);

/* The precision of rows in double. */
static inline carom_precision carom_precision_of(const carom_options *opt) {
  return opt != NULL && opt->solver == CAROM_SOLVER_FAST ? CAROM_MIXED : CAROM_F64;
}

/* Of an impact and of a result of a precision. */
static inline size_t carom_impact_size(carom_precision precision) {
  return precision == CAROM_F32 ? sizeof(carom_impact_f32) : sizeof(carom_impact);
}
static inline size_t carom_result_size(carom_precision precision) {
  return precision == CAROM_F32 ? sizeof(carom_result_f32) : sizeof(carom_result);
}

/* One pair by a single call, with the checks and the status of carom_collide(): lanes leave to it
 * each row that is not plainly good. `in` and `out` are of the precision. */
carom_status carom_collide_one(carom_precision precision, const void *in, const carom_options *opt,
                               void *out);

#endif
