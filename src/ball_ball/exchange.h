/* What the parts of the exact solver hand to each other: rows.h, in the caller's precision, reduces collisions to eight numbers
 * each and turns their solutions into velocities; between them collocation (plan.h) computes in single precision, in as many
 * steps as it takes. */
#ifndef CAROM_SRC_BALL_BALL_EXCHANGE_H
#define CAROM_SRC_BALL_BALL_EXCHANGE_H

#include <stdint.h>

/* Reduced collisions, a column for each quantity of reduced.h in units of |v_n0| / kappa. */
enum { IN_U_X, IN_U_Z, IN_D_X, IN_D_Y, IN_KAPPA, IN_MU, IN_MU_B, IN_E, IN_COLUMNS };
/* Solutions: those of problem.h. */
enum { OUT_J_C, OUT_J_Z, OUT_I_X, OUT_I_Y, OUT_EXTRA, OUT_STICK, OUT_K_C, OUT_COLUMNS };
/* A collision between two steps: the columns of its state (problem.h), whether v = 0 has been passed (1 or 0), and what has
 * been tried (plan.h). */
enum { MOVING_STATE, MOVING_RESTITUTION = 13, MOVING_SHARE, MOVING_CAREFUL, MOVING_ATTEMPTS, MOVING_COLUMNS };

enum { MOST_LANES = 16 }; /* of floats in a vector */
typedef float carom_in[IN_COLUMNS][MOST_LANES];
typedef float carom_out[OUT_COLUMNS][MOST_LANES];
typedef float carom_moving[MOVING_COLUMNS][MOST_LANES];

/* Kinds of steps (plan.h), FULL over even or over graded nodes; and what else may come next: a collision is solved, or
 * collocation refuses it. */
enum step_kind { EASY, FULL, FULL_GRADED, STICK, PART, TURN, STEP_KINDS, SOLVED = STEP_KINDS, REFUSED, STEP_ENDS };
/* For each, the lanes for which it comes next, a bit for each. */
typedef uint32_t carom_next[STEP_ENDS];

/* A ball that u_z presses less, in units of |v_n0| / kappa, is not pressed; friction between the balls that is less counts as
 * this, so that what is divided by it is finite. */
static const double LEAST_PRESS = 1e-10, LEAST_MU_B = 1e-9;

/* Error in p, in units of |v_n0| / kappa, that a step may add by its estimate, for results in double and in single precision.
 */
static const float carom_tolerances[2] = {2.5e-7f, 5e-6f};

#endif
