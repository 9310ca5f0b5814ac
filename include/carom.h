/* carom: collisions of two billiard balls on a table.
 *
 * This header is the manual: read it from top to bottom and stop where you have what you need.
 *
 *     carom_impact in = { ... };                    // two touching balls, before the collision
 *     carom_result out;
 *     carom_status status = carom_collide(&in, NULL, &out);
 *     if (status < 0) fprintf(stderr, "%s\n", carom_status_string(status));
 *
 * Units are SI. The table's normal is +z, its surface is the plane x, y, and all vectors are right-handed. The model is that of
 * S. Mathavan, M. R. Jackson, R. M. Parkin, "Numerical simulations of the frictional collisions of solid balls on a rough
 * surface", Sports Engineering 17 (2014) 227-237: both balls stay on the cloth; friction acts between the balls, and between
 * the cloth and the ball that is pressed into it.
 *
 * Every function is reentrant and may be called from many threads at once. None prints or aborts, and none allocates memory,
 * except that carom_collide_batch() starts threads for large batches.
 */
#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

#define CAROM_VERSION_MAJOR 0
#define CAROM_VERSION_MINOR 1
#define CAROM_VERSION_PATCH 0

#if defined(_WIN32)
#define CAROM_API
#elif defined(__GNUC__)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- One collision: what goes in and what comes out ---------------------------------------------------------------- */

/* One ball just before the collision. */
typedef struct carom_ball {
  double r[3];     /* centre, m. Both balls of a pair lie at the same height r[2]. */
  double v[3];     /* velocity, m/s. v[2] must be 0: the model keeps both balls on the table. */
  double w[3];     /* angular velocity, rad/s. */
  double radius;   /* m, > 0, the same for both balls of a pair. */
  double mass;     /* kg, > 0, may differ between the balls. The moment of inertia is that of a solid ball, 2/5 M R^2. */
  double mu_cloth; /* coefficient of sliding friction between this ball and the cloth, 0 to 1. */
} carom_ball;

/* Two balls at the instant of contact. The distance of the centres is not checked: the caller has found the contact. The
 * struct is 26 doubles without gaps, so an array of n is also an (n, 26) array of doubles in row order. */
typedef struct carom_impact {
  carom_ball a, b;
  double mu_ball;     /* coefficient of sliding friction between the balls, 0 to 1. */
  double restitution; /* e, 0 to 1: the collision ends once e^2 of the work of compression has been given back. */
} carom_impact;

/* The motion of a ball. */
typedef struct carom_motion {
  double v[3]; /* velocity, m/s. */
  double w[3]; /* angular velocity, rad/s. */
} carom_motion;

/* The balls just after the collision; positions do not change. 12 doubles without gaps. */
typedef struct carom_result {
  double v_a[3], w_a[3]; /* first ball: velocity, m/s, and angular velocity, rad/s. */
  double v_b[3], w_b[3]; /* second ball. */
} carom_result;

/* ---- How a call ended ------------------------------------------------------------------------------------------------ */

/* 0 is success, a positive value a valid outcome worth a remark, a negative value an error: X(NAME, value, name, text). */
#define CAROM_STATUS_LIST(X)                                                                                      \
  X(OK, 0, "ok", "resolved")                                                                                      \
  X(SEPARATING, 1, "separating", "the balls do not approach each other; their state is returned unchanged")       \
  X(ERROR_NULL, -1, "null_pointer", "a required pointer is NULL")                                                 \
  X(ERROR_SOLVER, -2, "bad_solver", "options.solver is not one of carom_solver")                                  \
  X(ERROR_SLIP, -3, "bad_slip", "options.slip is not one of carom_slip")                                          \
  X(ERROR_STEPS, -4, "bad_steps", "options.steps must be at least 1")                                             \
  X(ERROR_POSITION, -5, "bad_position", "a position must be finite")                                              \
  X(ERROR_VELOCITY, -6, "bad_velocity", "a velocity must be finite")                                              \
  X(ERROR_SPIN, -7, "bad_spin", "an angular velocity must be finite")                                             \
  X(ERROR_RADIUS, -8, "bad_radius", "a radius must be positive and finite")                                       \
  X(ERROR_MASS, -9, "bad_mass", "a mass must be positive and finite")                                             \
  X(ERROR_MU_CLOTH, -10, "bad_mu_cloth", "the friction of ball and cloth must be in [0, 1]")                      \
  X(ERROR_MU_BALL, -11, "bad_mu_ball", "the friction of ball and ball must be in [0, 1]")                         \
  X(ERROR_RESTITUTION, -12, "bad_restitution", "the restitution must be in [0, 1]")                               \
  X(ERROR_RADII_DIFFER, -13, "radii_differ", "both balls must have the same radius")                              \
  X(ERROR_HEIGHTS_DIFFER, -14, "heights_differ", "both centres must be at the same height")                       \
  X(ERROR_VERTICAL, -15, "vertical_velocity", "the vertical velocity must be 0: both balls stay on the table")    \
  X(ERROR_COINCIDENT, -16, "centres_coincide", "the centres coincide, so there is no line of centres")            \
  X(ERROR_TOO_SLOW, -17, "too_slow",                                                                              \
    "Euler's method is too slow here: its steps are lost in rounding, or more than 16 N of them are needed")      \
  X(ERROR_OVERFLOW, -18, "overflow", "the collision overflows the range of double")                               \
  X(ERROR_MASSES_DIFFER, -19, "masses_differ", "this kernel is for balls of equal mass only")                     \
  X(ERROR_THREADS, -20, "bad_threads", "options.threads must not be negative")                                    \
  X(ERROR_POINTS, -21, "bad_points", "a trace needs at least 2 points")                                           \
  X(ERROR_UNRESOLVED, -22, "unresolved",                                                                          \
    "the collision is too extreme: its result hangs on rounding errors, or takes more work than a call may cost") \
  X(ERROR_CUSHION_MODEL, -30, "bad_cushion_model", "options.model is not one of carom_cushion_model")             \
  X(ERROR_CUSHION_OPTIONS, -31, "bad_cushion_options",                                                            \
    "an option of the cushion is out of its range, or a reserved one is not 0")                                   \
  X(ERROR_NORMAL, -32, "bad_normal", "the direction into the cushion must be finite and not 0")                   \
  X(ERROR_NOSE_HEIGHT, -33, "bad_nose_height", "the nose must be between the cloth and the top of the ball")      \
  X(ERROR_MU_CUSHION, -34, "bad_mu_cushion", "the friction of ball and cushion must be in [0, 1]")                \
  X(ERROR_JAW_RADIUS, -35, "bad_jaw_radius", "the radius of a jaw must be finite and not negative")

typedef enum carom_status {
#define CAROM_STATUS_ENUM(NAME, value, name, text) CAROM_##NAME = (value),
  CAROM_STATUS_LIST(CAROM_STATUS_ENUM)
#undef CAROM_STATUS_ENUM
} carom_status;

/* The short name of a status ("separating"), as it stands in the command's output. "unknown" for a value not listed. */
CAROM_API const char *carom_status_name(carom_status status);

/* What the status means, in one sentence without a full stop, fit for a message. Never NULL. */
CAROM_API const char *carom_status_string(carom_status status);

/* ---- Resolving ------------------------------------------------------------------------------------------------------- */

/* How the collision is computed: X(NAME, name, text). */
#define CAROM_SOLVER_LIST(X)                                                                               \
  X(EXACT, "exact", "the limit of infinitely many steps, by collocation: the physics of the model itself") \
  X(EULER, "euler", "Mathavan's N steps of equal normal impulse; with the pooltool slip, pooltool's result to the last bit")

typedef enum carom_solver {
#define CAROM_SOLVER_ENUM(NAME, name, text) CAROM_SOLVER_##NAME,
  CAROM_SOLVER_LIST(CAROM_SOLVER_ENUM)
#undef CAROM_SOLVER_ENUM
      CAROM_SOLVER_COUNT
} carom_solver;

/* Which velocity slips over the cloth. PAPER is the 2014 paper's (a ball that rolls does not slip). POOLTOOL is what the
 * simulator pooltool computes, with the opposite sign of the spin: for parity with it, not for truth. X(NAME, name, text). */
#define CAROM_SLIP_LIST(X)                                        \
  X(PAPER, "paper", "v_x - R w_y, v_y + R w_x: the 2014 paper's") \
  X(POOLTOOL, "pooltool", "v_x + R w_y, v_y - R w_x: pooltool's")

typedef enum carom_slip {
#define CAROM_SLIP_ENUM(NAME, name, text) CAROM_SLIP_##NAME,
  CAROM_SLIP_LIST(CAROM_SLIP_ENUM)
#undef CAROM_SLIP_ENUM
      CAROM_SLIP_COUNT
} carom_slip;

/* The names above as text ("euler", "paper"), or NULL for a value not listed. */
CAROM_API const char *carom_solver_name(carom_solver solver);
CAROM_API const char *carom_slip_name(carom_slip slip);

/* Options of a call. Begin with carom_default_options() and change what you need, so that new fields keep their defaults. */
typedef struct carom_options {
  carom_solver solver; /* default CAROM_SOLVER_EXACT. */
  carom_slip slip;     /* default CAROM_SLIP_PAPER. */
  int steps;           /* Euler's N >= 1, default 1000: about so many steps are taken; the error falls as 1/N. */
  int threads;         /* most threads that a batch may use, >= 0; default 0: one for each processor. Results do not depend on
                          it. 1 starts none; single calls never do. */
} carom_options;

enum { CAROM_ALL_THREADS = -1 }; /* for options.threads of carom_shot.h */

CAROM_API carom_options carom_default_options(void);

/* Resolves one collision. `opt` may be NULL for the defaults; `out` may not overlap `in`.
 * CAROM_OK: `*out` is the state after the collision. CAROM_SEPARATING: `*out` is the state before it. An error: every number
 * of `*out` is NaN (but `*out` is untouched when a pointer is NULL). */
CAROM_API carom_status carom_collide(const carom_impact *in, const carom_options *opt, carom_result *out);

/* Resolves `n` collisions, in[0..n-1] to out[0..n-1], each as carom_collide would: a bad pair gets NaN and its own status and
 * changes nothing for the others. `status` takes the n statuses as bytes, to be read with carom_status_of_byte(); it may be
 * NULL. `in`, `out` and `status` may not overlap; with n = 0 they may be NULL.
 * Euler's results have the bits of carom_collide. Exact ones differ from it by their errors, since lanes go another way; they
 * are the same for any number of threads, but not on every instruction set. Few pairs (up to 43; 199 with SSE2 or NEON), and
 * all in plain double precision, are done one by one, where that is faster.
 * Returns CAROM_OK if no pair is in error, else the status of the first that is; if the call itself cannot be served (NULL,
 * bad options), that error, with nothing written. */
CAROM_API carom_status carom_collide_batch(const carom_impact *in, size_t n, const carom_options *opt, carom_result *out,
                                           uint8_t *status);

/* The status that a byte of carom_collide_batch stands for: errors are negative, in two's complement. */
static inline carom_status carom_status_of_byte(uint8_t byte) {
  return (carom_status)(byte < 128 ? (int)byte : (int)byte - 256);
}

/* ---- Friction between the balls -------------------------------------------------------------------------------------- */

/* Friction that falls with the speed at which the balls slip on each other: mu = a + b exp(-c |u|), |u| in m/s. */
typedef struct carom_speed_law {
  double a, b, c; /* -, -, s/m */
} carom_speed_law;

/* The usual fit for pool balls, a = 0.009951, b = 0.108, c = 1.088: D. Alciatore, TP A-14, to measurements by W. C. Marlow. */
CAROM_API carom_speed_law carom_alciatore(void);

/* The friction between the balls of `*in` by the law, |u| being the slip just before the collision; in->mu_ball is not read.
 * Assign it to in->mu_ball. A law that leaves [0, 1] or motion that is not finite gives a number that carom_collide() refuses.
 */
CAROM_API double carom_mu_ball(const carom_impact *in, carom_speed_law law);

/* ---- After the collision --------------------------------------------------------------------------------------------- */

/* The velocity, m/s, at which a ball of the given velocity, angular velocity and radius stops sliding and begins to roll:
 * (5/7) v + (2/7) R (w_y, -w_x, 0). The cloth's friction does not matter, only the time that it takes. */
CAROM_API void carom_rolling_velocity(const double v[3], const double w[3], double radius, double rolling[3]);

/* ---- Single precision ------------------------------------------------------------------------------------------------ */

/* The same in float: half the memory, twice the lanes. The worst pair error of a batch by the exact limit stays below 2e-5. */
typedef struct carom_ball_f32 {
  float r[3], v[3], w[3];
  float radius, mass, mu_cloth;
} carom_ball_f32;

typedef struct carom_impact_f32 {
  carom_ball_f32 a, b;
  float mu_ball, restitution;
} carom_impact_f32;

typedef struct carom_result_f32 {
  float v_a[3], w_a[3], v_b[3], w_b[3];
} carom_result_f32;

/* carom_collide() on floats, which become doubles and back. */
CAROM_API carom_status carom_collide_f32(const carom_impact_f32 *in, const carom_options *opt, carom_result_f32 *out);

/* carom_collide_batch() on floats, computed in float; rows that are too extreme for float are done in double. */
CAROM_API carom_status carom_collide_batch_f32(const carom_impact_f32 *in, size_t n, const carom_options *opt,
                                               carom_result_f32 *out, uint8_t *status);

/* ---- Instruction sets ------------------------------------------------------------------------------------------------ */

/* What batches and single calls of the exact limit compute with, from low to high: X(NAME, name). They take the highest that
 * the processor has; results differ within the solver's errors from one to another. The environment variable CAROM_ISA, set to
 * one of the names before the first call, limits it for the whole process. */
#define CAROM_ISA_LIST(X) \
  X(PLAIN, "plain")       \
  X(SSE2, "sse2")         \
  X(NEON, "neon")         \
  X(AVX2, "avx2")         \
  X(AVX512, "avx512")

typedef enum carom_isa {
#define CAROM_ISA_ENUM(NAME, name) CAROM_ISA_##NAME,
  CAROM_ISA_LIST(CAROM_ISA_ENUM)
#undef CAROM_ISA_ENUM
      CAROM_ISA_COUNT
} carom_isa;

/* The name of an instruction set, or NULL for a value not listed. */
CAROM_API const char *carom_isa_name(carom_isa isa);

/* Whether this build and this processor have it: 1 or 0. */
CAROM_API int carom_isa_available(carom_isa isa);

/* The one that is used. */
CAROM_API carom_isa carom_isa_in_force(void);

/* From now on the whole process uses no higher one than `isa`; a value not listed lifts the limit. Returns the one then in
 * force. Call it while no batch runs. */
CAROM_API carom_isa carom_isa_limit(carom_isa isa);

/* ---- Looking closer -------------------------------------------------------------------------------------------------- */

/* When the surfaces of the balls ceased to slip on each other, if they did. */
typedef enum carom_stick {
  CAROM_STICK_NEVER,          /* they slipped to the end */
  CAROM_STICK_IN_COMPRESSION, /* while the balls still approached each other */
  CAROM_STICK_IN_RESTITUTION, /* while they were parting */
} carom_stick;

/* What else is known of a collision. Impulses in N s, as vectors along the axes of the table where they have a direction. */
typedef struct carom_detail {
  int64_t steps;           /* steps that Euler's method took; 0 for other solvers. */
  int64_t evaluations;     /* right-hand sides that the exact solver evaluated; 0 for others. */
  double normal;           /* impulse along the line of centres, on the second ball away from the first; the reverse on it. */
  double friction[3];      /* impulse of the second ball's friction on the first ball; the reverse on the second. */
  double cloth_a[3];       /* impulse of the cloth's friction on the first ball, */
  double cloth_b[3];       /* and on the second: only one of them is pressed into the cloth by the other's friction. */
  double work_compression; /* work of the normal force until the balls no longer approach, J. */
  double work;             /* the same over the whole collision: (1 + e^2) of it, for Euler's method a whole step more. */
  carom_stick stick;       /* CAROM_STICK_NEVER from Euler's method, which chatters instead. */
  double stick_normal;     /* the normal impulse so far when they stuck; NaN if they never did. */
} carom_detail;

/* carom_collide that also tells how it went. `*detail` is filled whatever the status, with 0 and NaN where nothing was solved.
 * `detail` may be NULL. */
CAROM_API carom_status carom_collide_detail(const carom_impact *in, const carom_options *opt, carom_result *out,
                                            carom_detail *detail);

/* Compression lasts while the balls approach each other; in restitution they part. */
typedef enum carom_phase { CAROM_PHASE_COMPRESSION, CAROM_PHASE_RESTITUTION } carom_phase;

/* A collision on its way. Slips are in the collision frame: y is the line of centres from the first ball to the second, z
 * points up, x = y x z. A slip is the velocity, m/s, of one surface over the other where they touch. */
typedef struct carom_trace_point {
  double normal;      /* normal impulse so far, N s: the measure of how far the collision has come. */
  double work;        /* work of the normal force so far, J: the sum of |v_n| dP. */
  carom_phase phase;  /* CAROM_PHASE_COMPRESSION up to v_n = 0. */
  int sticks;         /* 1 from where the balls no longer slip on each other, else 0; always 0 by Euler's method. */
  double v_n;         /* speed at which the balls part along y, m/s; negative while they approach. */
  double u_x, u_z;    /* slip of the first ball on the second; 0 once they stick. */
  double d_x, d_y;    /* slip of the first ball over the cloth, with the sign of options.slip, */
  double b_x, b_y;    /* and of the second ball. */
  carom_result state; /* both balls, along the axes of the table. */
} carom_trace_point;

/* Follows one collision through `n` >= 2 points at equal steps of normal impulse, from 0 at points[0] to the end, which is the
 * result of carom_collide() (by the exact solver to about 1e-6, as it is computed another way). Euler's method gives the
 * nearest whole steps. `opt` may be NULL; `points` may not overlap `in`. It is made for looking, not for speed: about a
 * millisecond for the exact limit, n/2 times a collision for Euler's method. Returns what carom_collide() does.
 * CAROM_SEPARATING: every point is the state before, with impulse 0. An error: every number is NaN (but nothing is written when
 * a pointer is NULL or n < 2). */
CAROM_API carom_status carom_trace(const carom_impact *in, const carom_options *opt, size_t n, carom_trace_point *points);

/* Checks the arguments of a collision and solves nothing. Returns CAROM_OK or an error that depends on single fields
 * (CAROM_SEPARATING, TOO_SLOW and OVERFLOW come only from solving). If `field` is not NULL, `*field` becomes the index of the
 * offending number among the 26 doubles of `*in`, or -1 where none is to blame. */
CAROM_API carom_status carom_check(const carom_impact *in, const carom_options *opt, int *field);

/* The C name of number `field` of a carom_impact, 0 to 25: "a.r[0]" ... "restitution". NULL outside that range. */
CAROM_API const char *carom_field_name(int field);

/* The version of the library that runs, "major.minor.patch"; the macros above are those of the header compiled against. */
CAROM_API const char *carom_version(void);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_H */
