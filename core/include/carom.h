/* carom: collisions of two billiard balls on a table.
 *
 * This header is the manual of collisions, from simple to advanced. Cushions and whole shots are in
 * carom_shot.h. The samples in the headers are valid in C and in C++.
 *
 *     // r, v, w, radius, mass, mu_slide; then a, b, mu_ball, restitution
 *     carom_ball ball = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0.028575, 0.17, 0.2};
 *     carom_impact in = {ball, ball, 0.05, 0.95};
 *     in.a.v[0] = 1.5;                                                            // m/s, along x
 *     in.b.r[0] = 2 * ball.radius;                                                // b touches a
 *     carom_result out;
 *     carom_status status = carom_collide(&in, NULL, &out);
 *     if (status < 0) fprintf(stderr, "%s\n", carom_status_string(status));
 *
 * Units are SI. The table is the plane x, y, its normal is +z, and all vectors are right-handed.
 * The model was published by S. Mathavan, M. R. Jackson, R. M. Parkin, "Numerical simulations of
 * the frictional collisions of solid balls on a rough surface", Sports Engineering 17 (2014)
 * 227-237. Both balls stay on the cloth. Friction acts between the balls, and between the cloth and
 * the ball that is pressed into it.
 *
 * Scope. A call solves one collision of two balls with the same radius at the same height, and with
 * any masses. The caller finds the contact. This header does not cover three balls that touch at
 * once, or balls that jump.
 *
 * Calls. Every function is reentrant and may be called from many threads at once. No function
 * prints, aborts or allocates memory. A batch starts threads only if options.threads requests them.
 * These threads receive no signals of the process and end with the call. The only global state is
 * the instruction set in use.
 *
 * Accuracy of the exact solver, the default. Errors are differences from the limit of Mathavan's
 * equations, divided by the fastest of the twelve numbers (spins times the radius).
 *   - Double precision, collisions of play (mu_ball up to 0.2, mu_slide up to 0.5, e from 0.5,
 *     masses within 1 : 2, any speeds and spins): within 1e-6, median 1e-9.
 *   - Double precision, anything else that is accepted: within 1e-5, or the status is
 *     CAROM_ERROR_UNRESOLVED.
 *   - Single precision, collisions of play: within 2e-5, median 1e-7.
 * docs/understanding/accuracy.md has the figures and the commands that print them.
 * docs/understanding/physics.md describes the model and its limits.
 *
 * Cost of the exact solver for one collision, on one core of an Intel Xeon of 2 GHz with
 * AVX-512:
 *   - A call takes 0.6 us on average in play: 0.3 us if the slip on the cloth is smooth, 0.4 to 4
 *     us if it turns or the balls stick. A row of a batch takes 0.3 us. With SSE2 or in plain C a
 *     call takes a third longer.
 *   - With CAROM_SOLVER_FAST a call takes 0.4 us, and a row of a batch 0.16 us.
 *   - Strong friction, very small restitution or very unequal masses take some microseconds.
 *   - No input takes more than 200 us: the solver ends after 400 iterations with
 *     CAROM_ERROR_UNRESOLVED, and evaluates the equations at most 3,300 times
 *     (carom_detail.evaluations). Each point of a trace may need as many.
 * Euler's method takes about 20 ns per step.
 *
 * Stack. In an optimised build every call fits into a thread with 76 KiB of stack, including what
 * the C library uses. On x86-64 a single call uses at most 8 KiB, a trace 10 KiB, a batch 47 KiB,
 * and a batch with threads 55 KiB in the calling thread (core/tests/unit/stack.c measures them).
 *
 * Determinism. The following have equal bits:
 *   - Each row of a batch and a single call on that row, for any batch size, split, neighbours
 *     and thread count.
 *   - Two runs on one processor with one instruction set.
 *   - All machines, compilers and instruction sets: shots, unless options.fast is set, and
 *     collisions in double precision by CAROM_SOLVER_EXACT and CAROM_SOLVER_EULER.
 *   - All machines and compilers: other calls with options.plain = 1, with the environment
 *     variable CAROM_ISA=plain, or after carom_isa_limit(CAROM_ISA_PLAIN). This holds for every
 *     function, also with flags such as -mfma, -march=native and LTO.
 *     core/tests/platforms/bits.expected has hashes on which gcc and clang, Linux on x86-64 and
 *     arm64, Windows and WebAssembly agree.
 * The bits of all other results (CAROM_SOLVER_FAST, functions in single precision, traces, the
 * exact limit of a cushion) differ between instruction sets. With sse2 and avx2 they also differ
 * between makes of processors, whose estimates of reciprocals differ. The differences stay within
 * the solver's errors. The bits of a NaN are not specified.
 *
 * Smoothness. The result of the exact solver is smooth to rounding errors, about 1e-15 of the
 * fastest speed, except for isolated jumps where a different kind or number of steps solves the
 * collision. If a velocity changes by its own size, there are some 3 to 8 such jumps. Their median
 * is 1e-9 of the fastest speed, and the largest is at most 1e-6 of it. Differences may therefore
 * take any step (docs/using/derivatives.md).
 *
 * Floating-point environment.
 *   - The rounding mode must be to nearest. With another mode, ordinary collisions are about 1e-6
 *     less accurate and have other bits.
 *   - Exceptions must be masked, as in every C program at its start. The lanes of a batch also
 *     compute on bad or missing rows, so invalid operations, overflow and division by zero occur
 *     and are ignored. Exception flags may be left raised; nothing else changes.
 *   - Flushing subnormal numbers to zero makes no difference to collisions on a table.
 *   - The threads of a batch inherit the environment of the calling thread; on Windows they have
 *     the default environment of a new thread.
 * The library refuses to be compiled with flags that change results, such as -ffast-math or
 * -fno-signed-zeros (docs/using/building.md).
 */
#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

/* The version of this header. */
#define CAROM_VERSION_MAJOR 0
#define CAROM_VERSION_MINOR 4
#define CAROM_VERSION_PATCH 0

/* Marks an exported function. On Windows, define CAROM_DLL to use the library as a DLL; only the
 * library's own build defines CAROM_BUILD. */
#if defined(_WIN32) && defined(CAROM_BUILD)
#define CAROM_API __declspec(dllexport)
#elif defined(_WIN32) && defined(CAROM_DLL)
#define CAROM_API __declspec(dllimport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- One collision: input and result -------------------------------------------------------  */

/* One ball just before the collision. */
typedef struct carom_ball {
  double r[3];     /* centre, m. Both balls of a pair are at the same height r[2]. */
  double v[3];     /* velocity, m/s. v[2] must be 0: the model keeps both balls on the table. */
  double w[3];     /* angular velocity, rad/s. */
  double radius;   /* m, > 0, equal for both balls of a pair within a relative 1e-9. The computation
                      uses the radius of ball a. */
  double mass;     /* kg, > 0, may differ between the balls. The moment of inertia is 2/5 M R^2, as
                      for a solid ball. */
  double mu_slide; /* coefficient of sliding friction between this ball and the cloth, 0 to 1. */
} carom_ball;

/* Two balls at the instant of contact. The distance between the centres is not checked, because the
 * caller has found the contact. The struct is 26 doubles without gaps, so an array of n is also an
 * (n, 26) array of doubles in row order. */
typedef struct carom_impact {
  carom_ball a, b;    /* the first and the second ball: the line of centres goes from a to b. */
  double mu_ball;     /* coefficient of sliding friction between the balls, 0 to 1. */
  double restitution; /* e, 0 to 1: the collision ends once e^2 of the work of compression has been
                         returned. */
} carom_impact;

/* The motion of a ball. */
typedef struct carom_motion {
  double v[3]; /* velocity, m/s. */
  double w[3]; /* angular velocity, rad/s. */
} carom_motion;

/* The balls just after the collision; positions do not change. 12 doubles without gaps. */
typedef struct carom_result {
  carom_motion a, b; /* the motion of the first and of the second ball. */
} carom_result;

/* ---- How a call ended ------------------------------------------------------------------------ */

/* 0 is success, a positive value is another valid outcome, and a negative value is an error. Values
 * are never renumbered or reused. -30 to -39 are reserved for cushions, -40 to -109 for shots.
 * carom_status_string() describes each value. */
typedef enum carom_status {
  CAROM_OK = 0,                      /* resolved. */
  CAROM_SEPARATING = 1,              /* the balls do not approach each other; their state is
                                        returned unchanged. */
  CAROM_STOPPED_AT_TIME = 2,         /* a shot was stopped at options.time_most, as requested; balls
                                        are still moving. */
  CAROM_STOPPED_AT_EVENT = 3,        /* a shot was stopped after an event of options.stop_at, as
                                        requested. */
  CAROM_ERROR_NULL = -1,             /* a required pointer is NULL. */
  CAROM_ERROR_SOLVER = -2,           /* options.solver is not one of carom_solver. */
  CAROM_ERROR_SLIP = -3,             /* options.slip is not one of carom_slip. */
  CAROM_ERROR_STEPS = -4,            /* options.steps is negative. */
  CAROM_ERROR_POSITION = -5,         /* a position is not finite. */
  CAROM_ERROR_VELOCITY = -6,         /* a velocity is not finite. */
  CAROM_ERROR_SPIN = -7,             /* an angular velocity is not finite. */
  CAROM_ERROR_RADIUS = -8,           /* a radius is not positive and finite. */
  CAROM_ERROR_MASS = -9,             /* a mass is not positive and finite. */
  CAROM_ERROR_MU_SLIDE = -10,        /* the friction of ball and cloth is not in [0, 1]. */
  CAROM_ERROR_MU_BALL = -11,         /* the friction of ball and ball is not in [0, 1]. */
  CAROM_ERROR_RESTITUTION = -12,     /* the restitution is not in [0, 1]. */
  CAROM_ERROR_RADII_DIFFER = -13,    /* the radii of the balls differ by more than a relative
                                        1e-9. */
  CAROM_ERROR_HEIGHTS_DIFFER = -14,  /* the centres are at different heights. */
  CAROM_ERROR_VERTICAL = -15,        /* a vertical velocity is not 0: both balls stay on the
                                        table. */
  CAROM_ERROR_COINCIDENT = -16,      /* the centres coincide, so there is no line of centres. */
  CAROM_ERROR_TOO_SLOW = -17,        /* Euler's steps are lost in rounding, or the collision needs
                                        more than 16 N of them. */
  CAROM_ERROR_OVERFLOW = -18,        /* the collision overflows the range of double, or of float
                                        for single precision. */
  CAROM_ERROR_MASSES_DIFFER = -19,   /* the masses differ, in a shot with pooltool's rules or
                                        models, or in a kernel of the study. */
  CAROM_ERROR_THREADS = -20,         /* options.threads is neither CAROM_ALL_THREADS nor 0 or
                                        more. */
  CAROM_ERROR_POINTS = -21,          /* a trace needs at least 2 points. */
  CAROM_ERROR_UNRESOLVED = -22,      /* the result depends on rounding errors, or needs more work
                                        than a call may do. */
  CAROM_ERROR_OPTIONS = -23,         /* a number of the options, the job or the player is out of its
                                        range, or a reserved or unused field is not 0.
                                        carom_plan_fault() says which one of a plan. */
  CAROM_ERROR_CUSHION_MODEL = -30,   /* options.model of carom_shot.h is not one of
                                        carom_cushion_model. */
  CAROM_ERROR_NORMAL = -32,          /* the direction into a cushion is not finite, or 0. */
  CAROM_ERROR_NOSE_HEIGHT = -33,     /* the nose is not between the cloth and the top of the
                                        ball. */
  CAROM_ERROR_MU_CUSHION = -34,      /* the friction of ball and cushion is not in [0, 1]. */
  CAROM_ERROR_JAW_RADIUS = -35,      /* the radius of a jaw is not finite, or negative. */
  CAROM_ERROR_CONVENTION = -36,      /* options.convention is not one of
                                        carom_cushion_convention. */
  CAROM_ERROR_CUSHION_LAW = -37,     /* options.law is not one of carom_cushion_law. */
  CAROM_ERROR_LEAST_STEP = -38,      /* options.least_step is negative or not finite. */
  CAROM_ERROR_OMEGA_RATIO = -39,     /* omega_ratio of options or of a ball is neither 0 nor
                                        between 1 and 2. */
  CAROM_ERROR_SPEED_LOG = -24,       /* restitution_log, restitution_log2 or mu_log of options or of
                                        a ball, or roll_loss_log of a ball, is not -1 to 1. */
  CAROM_ERROR_SMOOTH = -25,          /* a member of options or of a ball whose name begins with
                                        smooth_ is out of its range. */
  CAROM_ERROR_VERSION = -26,         /* the caller was compiled with a header of a version that the
                                        library does not serve: see carom_serves(). */
  CAROM_ERROR_TOO_MANY_EVENTS = -40, /* a shot has more than options.events_most events. */
  CAROM_ERROR_TOO_LONG = -41,        /* a shot lasts longer than 1000 s, and options.time_most is
                                        0. */
  CAROM_ERROR_LEFT_TABLE = -42,      /* a ball on the cloth left the table. */
  CAROM_ERROR_SHOT_OPTIONS = -43,    /* a reserved or unused field of a shot's options, a job or
                                        seeds is not 0, first_of has a ball beyond the
                                        layout, or a job has both balls and kinds. */
  CAROM_ERROR_BALLS = -44,           /* the number of balls is not 1 to CAROM_BALLS_MOST. */
  CAROM_ERROR_LABEL = -45,           /* the label of a ball is not one that a layout may have. */
  CAROM_ERROR_OVERLAP = -46,         /* two balls overlap by more than 51 um. */
  CAROM_ERROR_OFF_TABLE = -47,       /* a ball is in or behind a cushion, in a pocket, or not at
                                        the height of its radius. */
  CAROM_ERROR_MU_MOTION = -48,       /* a friction of sliding, rolling or spinning is not above 0
                                        and at most 1. */
  CAROM_ERROR_GRAVITY = -49,         /* gravity is not above 0 and at most 1e6 m/s^2. */
  CAROM_ERROR_MISCUE = -51,          /* the tip misses the ball: a^2 + b^2 is not below miscue^2. */
  CAROM_ERROR_TABLE = -52,           /* the table has no part; or a part is not finite, has no
                                        length, or has an invalid friction or restitution; or
                                        rail_width is too small. */
  CAROM_ERROR_RACK = -53,            /* there is no such rack, the gap is not between 0 and R, or
                                        there is too little room. */
  CAROM_ERROR_EVENTS_LOST = -54,     /* carom_shot_at(), carom_shot_continue(): shot.events does not
                                        contain all events so far. */
  CAROM_ERROR_TIME = -55,            /* carom_shot_at(): the time is below 0, not a number, or after
                                        the end of a shot that stopped while balls moved. */
  CAROM_ERROR_DRAG = -56,            /* the drag of a rolling ball is not in [0, 1] 1/m. */
  CAROM_ERROR_BALL_CUSHION = -57,    /* roll_loss of a ball is not 0 to 1, or its nose_height is
                                        negative or not below 2 R. */
  CAROM_ERROR_MODULUS = -58,         /* a ball's modulus is neither 0 nor 1e6 to 1e15 Pa. */
  CAROM_ERROR_STATE = -60,           /* carom_shot_continue(): shot.state is damaged, or belongs to
                                        no shot that can be continued. carom_plan_continue(): the
                                        memory of the plan is damaged, or belongs to no plan. */
  CAROM_ERROR_STATE_TABLE = -64,     /* carom_shot_continue(): shot.state belongs to a shot on
                                        another table. */
  CAROM_ERROR_STATE_BALLS = -65,     /* carom_shot_continue(): shot.state belongs to a shot with
                                        other balls, or from another layout. */
  CAROM_ERROR_STATE_OPTIONS = -66,   /* carom_shot_continue(): shot.state belongs to a shot with
                                        other options, apart from the stopping options. */
  CAROM_ERROR_ROOM = -67,            /* shot.room is negative, or is not 0 although shot.events and
                                        shot.brief are both NULL. */
  CAROM_ERROR_TABLE_OPEN = -61,      /* carom_table_check(): a ball can leave the table, or there is
                                        no room for a ball on it. */
  CAROM_ERROR_RAIL_SIDE = -62,       /* carom_table_check(): the played side of a rail faces away
                                        from the table. */
  CAROM_ERROR_RAIL_LINE = -63,       /* carom_table_check(): the line of a rail does not pass
                                        through both of its ends. */
  CAROM_ERROR_TANGENT = -70,         /* carom_tangent.h: derivatives are not available for these
                                        rules of contact or this model. */
  CAROM_ERROR_DIRECTIONS = -71,      /* carom_tangent.h: the number of directions is not 1 to
                                        CAROM_DIRECTIONS_MOST. */
  CAROM_ERROR_NO_TANGENTS = -72,     /* carom_tangent.h: this library was built without derivatives,
                                        which need a C++ compiler. */

  CAROM_ERROR_CUE_SPEED = -80,           /* cue.speed is not 0 to 1000 m/s. */
  CAROM_ERROR_CUE_PHI = -81,             /* cue.phi is not -1e9 to 1e9 degrees. */
  CAROM_ERROR_CUE_THETA = -82,           /* cue.theta is not 0 to 90 degrees. */
  CAROM_ERROR_CUE_MASS = -83,            /* cue.mass is not positive and finite. */
  CAROM_ERROR_CUE_END_MASS = -84,        /* cue.end_mass is not positive and finite. */
  CAROM_ERROR_CUE_BALL = -85,            /* cue.ball is not the index of a ball. */
  CAROM_ERROR_CUE_BALL_OUT = -86,        /* cue.ball is in a pocket or off the table. */
  CAROM_ERROR_CUE_MISCUE = -87,          /* cue.miscue is not 0 to 1. */
  CAROM_ERROR_CUE_TIP_TIME = -88,        /* cue.tip_time is neither 0 to 0.01 s nor -1. */
  CAROM_ERROR_CUE_TIP_RESTITUTION = -89, /* cue.tip_restitution is not 0 to 1. */

  CAROM_ERROR_WORLD = -90,              /* options.world is not one of carom_world, or, for a
                                           cluster, not CAROM_WORLD_CAROM. */
  CAROM_ERROR_BALL_MODEL = -91,         /* options.ball_model is not one of carom_ball_model, or is
                                           not supported for a cluster. */
  CAROM_ERROR_SHOT_CUSHION_MODEL = -92, /* options.cushion_model is not one of
                                           carom_shot_cushion. */
  CAROM_ERROR_FRICTION = -93,           /* options.friction is not one of carom_ball_friction. */
  CAROM_ERROR_SPACE = -94,              /* options.space is not one of carom_space. */
  CAROM_ERROR_EVENTS_MOST = -95,        /* options.events_most is negative. */
  CAROM_ERROR_TIME_MOST = -96,          /* options.time_most is negative, not finite, or before the
                                           time of the shot to continue. */
  CAROM_ERROR_STOP_AT = -97,            /* options.stop_at has a bit that represents no event. */
  CAROM_ERROR_PLAIN = -98,              /* options.plain is neither 0 nor 1. */
  CAROM_ERROR_SIMULTANEOUS = -99,       /* options.simultaneous is not one of carom_simultaneous. */
  CAROM_ERROR_CLUSTER_STEPS = -100,     /* options.cluster_steps is not 0 to 10000. */
  CAROM_ERROR_RECORD = -101,            /* carom_record.h: record.fault describes the error. */
  CAROM_ERROR_REVISION = -102,          /* carom_record.h: the recording was made with another
                                           revision of the physics. */
  CAROM_ERROR_IN_MOTION = -103,         /* carom_plan.h: a ball of the layout is moving. */
  CAROM_ERROR_GAME_OVER = -104,         /* carom_plan.h: the rules name no ball to play. */
  CAROM_ERROR_FAST = -105,              /* options.fast is neither 0 nor 1. */
  CAROM_ERROR_CORNERS = -106,           /* a polygon has fewer than 3 or more than 32 corners. */
  CAROM_ERROR_SIDES_CROSS = -107,       /* two sides of a polygon that are not neighbours meet. */
  CAROM_ERROR_CUE_FOLLOW = -108,        /* cue.follow is not 0 to 1 m. */
  CAROM_ERROR_SCORE = -109,             /* carom_plan.h: a score of games is out of range. */
  CAROM_ERROR_CUE_TIP_RADIUS = -110,    /* cue.tip_radius is negative or not finite. */
  CAROM_ERROR_TABLE_KIND = -111,        /* not one of carom_table_kind. */
  CAROM_ERROR_CORNER = -112,            /* a corner of a polygon is not finite, is more than 1e6 m
                                           from 0, or has a negative mouth. */
  CAROM_ERROR_CORNERS_MEET = -113,      /* two successive corners coincide. */
  CAROM_ERROR_CORNERS_IN_LINE = -114,   /* all corners are on one line. */
  CAROM_ERROR_MOUTHS = -115,            /* the mouths at the ends of a side leave no rail between
                                           them. */
  CAROM_ERROR_POCKETS = -116,           /* a table has more than CAROM_POCKETS_MOST pockets. */
  CAROM_ERROR_JAWS = -117,              /* a table has more than CAROM_JAWS_MOST jaws. */
  CAROM_ERROR_RAILS = -118,             /* a table has more than CAROM_RAILS_MOST rails. */
  CAROM_ERROR_ACT = -119,               /* carom_match.h: the rules do not allow the act;
                                           match.fault says why, and what would be right. */
  CAROM_ERROR_SLOPE = -120              /* the slope of a table is not below mu_roll and mu_slide of
                                           every ball, or slope_x or slope_y is not -1 to 1. */
} carom_status;

/* The short name of a status ("separating"), as in the command's output; "unknown" for a value not
 * listed. Arrays of statuses have elements of int8_t, each with the value of a carom_status. */
CAROM_API const char *carom_status_name(carom_status status);

/* The meaning of the status, in one sentence without a full stop, for use in messages. Never
 * NULL. */
CAROM_API const char *carom_status_string(carom_status status);

/* ---- Resolving ------------------------------------------------------------------------------- */

/* How the collision is computed. */
typedef enum carom_solver {
  CAROM_SOLVER_EXACT = 0, /* the limit of infinitely many steps, by collocation: the solution of
                             the model. Smooth, and with the same bits on all machines. */
  CAROM_SOLVER_EULER = 1, /* Mathavan's N steps of equal normal impulse. With the slip of
                             pooltool the result has pooltool's bits. */
  CAROM_SOLVER_FAST = 2,  /* EXACT with single precision inside. A call takes two thirds of the time
                             and a batch half, with the same error bounds. Its result jumps by 1e-9
                             to 1e-7 m/s, so finite differences need steps of 1e-4 or more. The
                             functions _f32 also compute EXACT in this way. */
} carom_solver;

/* How the slip on the cloth is computed. */
typedef enum carom_slip {
  CAROM_SLIP_PAPER = 0,    /* v_x - R w_y, v_y + R w_x, as in the 2014 paper. A rolling ball does
                              not slip. */
  CAROM_SLIP_POOLTOOL = 1, /* v_x + R w_y, v_y - R w_x, as in the simulator pooltool, with the
                              opposite sign of the spin. Only for parity with pooltool. */
} carom_slip;

enum {
  CAROM_DEFAULT_STEPS = 1000, /* of Euler's method */
  CAROM_ALL_THREADS = -1,     /* for options.threads */
};

/* Options of a call. All zero means the defaults: `carom_options options = {0};` in C, `{}` in
 * C++, then set the ones you need. A pointer to options may be NULL for the defaults. */
typedef struct carom_options {
  carom_solver solver;  /* default CAROM_SOLVER_EXACT. */
  carom_slip slip;      /* default CAROM_SLIP_PAPER. */
  int steps;            /* Euler's N, the approximate number of steps; the error falls like 1/N.
                           0: CAROM_DEFAULT_STEPS. */
  int threads;          /* largest number of threads that a batch may use, including the calling
                           one. 0, the default: only the calling one. CAROM_ALL_THREADS: one for
                           each processor that the process may use, according to its affinity and
                           the limit of its control group. Results do not depend on it. Small
                           batches, single calls, and libraries built without threads start none. */
  int plain;            /* 1: this call computes with CAROM_ISA_PLAIN instead of the instruction set
                           in use, so its bits are the same on all machines. 0, the default: it uses
                           the instruction set in use. */
  int unused;           /* must be 0. */
  uint64_t reserved[5]; /* must be 0. Room for future options, for which 0 will mean the default. */
} carom_options;

/* Resolves one collision. `opt` may be NULL for the defaults; `out` may not overlap `in`. CAROM_OK:
 * `*out` is the state after the collision. CAROM_SEPARATING: `*out` is the state before it. An
 * error: every number of `*out` is NaN (but `*out` is untouched when a pointer is NULL). */
CAROM_API carom_status carom_collide(const carom_impact *in, const carom_options *opt,
                                     carom_result *out);

/* Resolves `n` collisions, in[0..n-1] to out[0..n-1], with the bits of carom_collide(). A bad pair
 * gets NaN and its own status, and does not change the other pairs. `status` receives the n
 * statuses; it may be NULL. `in`, `out` and `status` may not overlap; with n = 0 they may be NULL.
 * A caller with its own threads may split a batch in any way. Returns CAROM_OK if no pair is in
 * error, and otherwise the status of the first pair in error. If a pointer is NULL or an option is
 * bad, the call returns that error and writes nothing. */
CAROM_API carom_status carom_collide_batch(const carom_impact *in, size_t n,
                                           const carom_options *opt, carom_result *out,
                                           int8_t *status);

/* ---- Friction between the balls -------------------------------------------------------------- */

/* Friction that falls with the speed at which the balls slip on each other: mu = a + b exp(-c
 * |u|), |u| in m/s. */
typedef struct carom_speed_law {
  double a, b, c; /* -, -, s/m */
} carom_speed_law;

/* The usual fit for pool balls, a = 0.009951, b = 0.108, c = 1.088: D. Alciatore, TP A-14, fitted
 * to measurements by W. C. Marlow. */
CAROM_API carom_speed_law carom_alciatore(void);

/* The friction between the balls of `*in` according to the law, where |u| is the slip just before
 * the collision. in->mu_ball is not read; assign the result to it. If the law leaves [0, 1] or the
 * motion is not finite, carom_collide() rejects the result. NaN if `in` is NULL. */
CAROM_API double carom_mu_ball(const carom_impact *in, carom_speed_law law);

/* ---- After the collision --------------------------------------------------------------------- */

/* The velocity, m/s, at which a ball of the given velocity, angular velocity and radius stops
 * sliding and begins to roll: (5/7) v + (2/7) R (w_y, -w_x, 0). It does not depend on the
 * cloth's friction, which only determines when this happens. `rolling` may be `v` or `w`. Where v
 * or w is NULL, `rolling` becomes NaN; where `rolling` is NULL, nothing is done. */
CAROM_API void carom_rolling_velocity(const double v[3], const double w[3], double radius,
                                      double rolling[3]);

/* ---- Single precision ------------------------------------------------------------------------ */

/* The same structs in single precision, with the suffix _f32: half the memory, twice the lanes.
 * Results of the exact solver for collisions of play are within 2e-5 of the exact result for the
 * rounded inputs. */
typedef struct carom_ball_f32 {
  float r[3], v[3], w[3];       /* centre, velocity and angular velocity, as of a carom_ball. */
  float radius, mass, mu_slide; /* radius, mass and sliding friction on the cloth, as of a
                                   carom_ball. */
} carom_ball_f32;

/* Two balls that touch, in single precision. */
typedef struct carom_impact_f32 {
  carom_ball_f32 a, b;        /* the first and the second ball. */
  float mu_ball, restitution; /* coefficient of sliding friction between the balls, and e, 0 to
                                 1. */
} carom_impact_f32;

/* The motion of a ball, in single precision. */
typedef struct carom_motion_f32 {
  float v[3], w[3]; /* velocity and angular velocity, as of a carom_motion. */
} carom_motion_f32;

/* Both motions after a collision, in single precision. */
typedef struct carom_result_f32 {
  carom_motion_f32 a, b; /* the motion of the first and of the second ball. */
} carom_result_f32;

/* carom_collide_batch() in single precision. Each row is bit-identical to a batch of only that row.
 * Euler's method is computed in double precision and rounded. */
CAROM_API carom_status carom_collide_batch_f32(const carom_impact_f32 *in, size_t n,
                                               const carom_options *opt, carom_result_f32 *out,
                                               int8_t *status);

/* ---- Instruction sets ------------------------------------------------------------------------ */

/* Instruction sets of batches and of single calls of the exact solver, from low to high. The
 * library uses the highest one that the processor has. Results of different sets differ within the
 * solver's errors. The environment variable CAROM_ISA, set to one of the names ("plain", "sse2",
 * "neon", "avx2", "avx512") before the first call, limits it for the whole process; other values
 * are ignored. A single call uses plain if options.plain is 1, and a shot uses it unless
 * carom_shot_options.fast is 1. */
typedef enum carom_isa {
  CAROM_ISA_ANY = -1,   /* no limit: for carom_isa_limit(). */
  CAROM_ISA_PLAIN = 0,  /* available on every processor; its bits are the same on all machines. */
  CAROM_ISA_SSE2 = 1,   /* x86-64: 2 doubles at a time. */
  CAROM_ISA_NEON = 2,   /* arm64: 2 doubles at a time. */
  CAROM_ISA_AVX2 = 3,   /* x86-64: 4 doubles at a time. */
  CAROM_ISA_AVX512 = 4, /* x86-64: 8 doubles at a time. */
} carom_isa;

/* Whether this build and this processor have the instruction set: 1 or 0. */
CAROM_API int carom_isa_available(carom_isa isa);

/* The instruction set in use. */
CAROM_API carom_isa carom_isa_in_force(void);

/* Limits the whole process to `isa` and lower ones. CAROM_ISA_ANY lifts this limit, but not the
 * limit set by the environment variable. Returns the instruction set then in use. Call it while no
 * batch runs. */
CAROM_API carom_isa carom_isa_limit(carom_isa isa);

/* ---- Details and traces ---------------------------------------------------------------------- */

/* When the balls stopped slipping on each other. */
typedef enum carom_stick {
  CAROM_STICK_NEVER = 0,          /* they slipped to the end */
  CAROM_STICK_IN_COMPRESSION = 1, /* while the balls still approached each other */
  CAROM_STICK_IN_RESTITUTION = 2, /* while they were separating */
} carom_stick;

/* More about a collision. Impulses are in N s, as vectors along the axes of the table where they
 * have a direction. */
typedef struct carom_detail {
  int64_t steps;           /* steps that Euler's method took; 0 for other solvers. */
  int64_t evaluations;     /* how often the exact solver evaluated the equations; 0 for other
                              solvers. */
  double normal;           /* impulse along the line of centres, on the second ball away from the
                              first; the opposite on the first. */
  double friction[3];      /* impulse of the second ball's friction on the first ball; the opposite
                              on the second. */
  double cloth_a[3];       /* impulse of the cloth's friction on the first ball. The friction of one
                              ball presses only the other one into the cloth. */
  double cloth_b[3];       /* impulse of the cloth's friction on the second ball, as for the first
                              one. */
  double work_compression; /* work of the normal force until the balls no longer approach, J. */
  double work;             /* work of the normal force over the whole collision, J: (1 + e^2) of
                              work_compression; with Euler's method up to a step more. */
  carom_stick stick;       /* always CAROM_STICK_NEVER with Euler's method, because its slip
                              alternates in sign instead. */
  double stick_normal;     /* the normal impulse when the balls began to stick; NaN if they never
                              did. */
  double reserved[4];      /* 0; room for future fields. */
} carom_detail;

/* carom_collide() with details. `*detail` is filled for every status, with 0 and NaN where nothing
 * was solved. `detail` may be NULL. Works are infinite above 1e150 m/s. */
CAROM_API carom_status carom_collide_detail(const carom_impact *in, const carom_options *opt,
                                            carom_result *out, carom_detail *detail);

/* Compression lasts while the balls approach each other; in restitution they separate. */
typedef enum carom_phase {
  CAROM_PHASE_COMPRESSION = 0, /* the balls approach each other */
  CAROM_PHASE_RESTITUTION = 1  /* the balls separate */
} carom_phase;

/* One point of a collision. Slips are in the collision frame: y is the line of centres from the
 * first ball to the second, z points up, x = y x z. A slip is the velocity, m/s, of one surface
 * over the other where they touch. */
typedef struct carom_trace_point {
  double normal;      /* normal impulse so far, N s. It grows during the whole collision. */
  double work;        /* work of the normal force so far, J: the sum of |v_n| dP. */
  carom_phase phase;  /* CAROM_PHASE_COMPRESSION up to v_n = 0. */
  int sticks;         /* 1 from where the balls no longer slip on each other, otherwise 0; always 0
                         with Euler's method. */
  double v_n;         /* speed at which the balls separate along y, m/s; negative while they
                         approach. */
  double u_x, u_z;    /* slip of the first ball on the second; 0 once they stick. */
  double d_x, d_y;    /* slip of the first ball over the cloth, with the sign of options.slip. */
  double b_x, b_y;    /* slip of the second ball over the cloth, with the sign of options.slip. */
  carom_result state; /* motion of both balls, along the axes of the table. */
  double reserved[4]; /* 0; room for future fields. */
} carom_trace_point;

/* Follows one collision through `n` >= 2 points at equal steps of normal impulse, from 0 at
 * points[0] to the end, which is the result of carom_collide() (with the exact solver within about
 * 1e-6, because the precise solver computes the trace). Euler's method gives the nearest whole
 * steps. `opt` may be NULL; `points` may not overlap `in`. The call is slow: it takes about a
 * millisecond with the exact solver, and with Euler's method n/2 times as long as a collision.
 * Returns the status of carom_collide(). CAROM_SEPARATING: every point is the state before, with
 * impulse 0. An error: every number is NaN (but nothing is written when a pointer is NULL or n <
 * 2). */
CAROM_API carom_status carom_trace(const carom_impact *in, const carom_options *opt, size_t n,
                                   carom_trace_point *points);

/* Checks the arguments of a collision and solves nothing. Returns CAROM_OK or an error that depends
 * on single fields (only solving finds CAROM_SEPARATING, TOO_SLOW and OVERFLOW). If `field` is not
 * NULL, `*field` becomes the index of the invalid number among the 26 doubles of `*in`, or -1 if
 * the error is not in a single number. */
CAROM_API carom_status carom_check(const carom_impact *in, const carom_options *opt, int *field);

/* The C name of number `field` of a carom_impact, 0 to 25: "a.r[0]" ... "restitution". NULL
 * outside that range. */
CAROM_API const char *carom_field_name(int field);

/* ---- Names of values ------------------------------------------------------------------------- */

/* Enumerations whose values have names ("words"), the same in the command, in recordings and in all
 * languages. From RULES on they belong to games, except CONDITION and ISA; a build without games
 * has no words for them. */
typedef enum carom_words {
  CAROM_WORDS_WORLD = 0,              /* values of carom_world */
  CAROM_WORDS_BALL_MODEL = 1,         /* values of carom_ball_model */
  CAROM_WORDS_SHOT_CUSHION = 2,       /* values of carom_shot_cushion */
  CAROM_WORDS_BALL_FRICTION = 3,      /* values of carom_ball_friction */
  CAROM_WORDS_SPACE = 4,              /* values of carom_space */
  CAROM_WORDS_SIMULTANEOUS = 5,       /* values of carom_simultaneous */
  CAROM_WORDS_CUSHION_MODEL = 6,      /* values of carom_cushion_model */
  CAROM_WORDS_CUSHION_CONVENTION = 7, /* values of carom_cushion_convention */
  CAROM_WORDS_CUSHION_LAW = 8,        /* values of carom_cushion_law */
  CAROM_WORDS_GAME = 9,               /* values of carom_game */
  CAROM_WORDS_EVENT = 10,             /* values of carom_event_type */
  CAROM_WORDS_LABEL = 11,             /* values of carom_label */
  CAROM_WORDS_TABLE = 12,             /* values of carom_table_kind */
  CAROM_WORDS_RACK = 13,              /* values of carom_rack_kind */
  CAROM_WORDS_SOLVER = 14,            /* values of carom_solver */
  CAROM_WORDS_SLIP = 15,              /* values of carom_slip */
  CAROM_WORDS_RULES = 16,             /* values of carom_rules_kind */
  CAROM_WORDS_CONDITION = 17,         /* values of carom_condition */
  CAROM_WORDS_ISA = 18,               /* values of carom_isa */
  CAROM_WORDS_TURN = 19,              /* values of carom_turn_outcome */
  CAROM_WORDS_LEAVE = 20,             /* values of carom_leave */
  CAROM_WORDS_FOUL = 21,              /* values of carom_foul; the text of NONE is "" */
  CAROM_WORDS_CHOICE = 22,            /* values of carom_choice */
  CAROM_WORDS_GROUP = 23,             /* values of carom_group */
  CAROM_WORDS_PHASE = 24,             /* values of carom_match_phase */
  CAROM_WORDS_ACT = 25,               /* values of carom_act */
  CAROM_WORDS_REFUSAL = 26,           /* values of carom_refusal; the text of NOT is "" */
  CAROM_WORDS_GOAL = 27,              /* values of carom_goal_kind */
  CAROM_WORDS_PLAN_KIND = 28,         /* values of carom_plan_kind; the text is its name, such as
                                         "rail first" */
  CAROM_WORDS_PRACTICE = 29           /* values of carom_practice; the text is its name, such as
                                         "long thin cut" */
} carom_words;

/* The word of a value ("han", "double_hit"), and a short description of the value; NULL for a value
 * that is not listed. Words are found by value: `for (int k = 0; carom_word(of, k) != NULL; k++)`
 * finds all words of most sets; events begin with 1, and the values of CHOICE are powers of 2. */
CAROM_API const char *carom_word(carom_words of, int value);
CAROM_API const char *carom_word_text(carom_words of, int value);

/* The value whose word is `text`, as carom_word_means() compares them; -1 if there is none. A text
 * that is itself a word of the enumeration has that word's value. */
CAROM_API int carom_word_value(carom_words of, const char *text);

/* 1 if `text` is `word` as players write it, else 0. Capitals, hyphens, underscores and blanks do
 * not matter, nor does the order of the parts of a word with a hyphen ("left-side" is "side-left").
 * Words also have synonyms: "9-ball" is "nineball", "top-right" the pocket "foot-right". The
 * function works for all words of the library, and for names of rails and pockets. */
CAROM_API int carom_word_means(const char *text, const char *word);

/* Synonym k of a word, from 0 on ("9ball" of "nineball"); NULL if there are no more. */
CAROM_API const char *carom_word_synonym(const char *word, int k);

/* ---- Version --------------------------------------------------------------------------------- */

/* The version of this header as a number, 400 for 0.4.0. */
#define CAROM_VERSION_NUMBER \
  (CAROM_VERSION_MAJOR * 10000 + CAROM_VERSION_MINOR * 100 + CAROM_VERSION_PATCH)

/* The version of the library that runs, as "major.minor.patch" and as a number. */
CAROM_API const char *carom_version(void);
CAROM_API int carom_version_number(void);

/* The revision of the physics: a number that changes whenever the bits of a result of any call or
 * model change. Recordings play back bit for bit, and players in lockstep agree, only with the same
 * revision. */
CAROM_API int carom_physics_revision(void);

/* 1 if a caller that was compiled with a header of this version can use this library, otherwise 0:
 * call carom_serves(CAROM_VERSION_NUMBER). Before 1.0 the minor version must be equal. From 1.0 on,
 * the major version must be equal, and the minor one must not be above the library's. */
CAROM_API int carom_serves(int header_version_number);

/* The structs of this library may be longer in another version. Therefore the calls with which a
 * program begins compare versions: they return CAROM_ERROR_VERSION, before they read or write a
 * struct, if the library does not serve the header with which the call was compiled. These are
 * carom_table_make(), carom_table_measured(), carom_shoot(), carom_shoot_batch(), carom_plan(),
 * carom_match_begin(), carom_match_begin_with() and carom_match_read(). The program has nothing to
 * initialize. Shared libraries are also told apart by their soname. A program that finds
 * functions at run time, or in another language, calls carom_serves() itself. The library's own
 * build, and compilers without statement expressions, do not compare. */
#if defined(__GNUC__) && !defined(CAROM_BUILD)
#define CAROM_SERVED(call) \
  __extension__({ carom_serves(CAROM_VERSION_NUMBER) ? (call) : CAROM_ERROR_VERSION; })
#endif

#ifdef __cplusplus
}
#endif

#endif /* CAROM_H */
