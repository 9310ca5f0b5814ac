/* carom_shot.h - balls on a table: what they meet there besides each other.
 *
 *     carom_cushion_impact in = {.v = {0.5, 1.2, 0}, .normal = {0, 1}, .height = 0.0365, .radius = 0.028575, .mass = 0.17,
 *                                .mu_cloth = 0.2, .mu_cushion = 0.2, .restitution = 0.85};
 *     carom_motion out;
 *     carom_status status = carom_cushion(&in, NULL, &out);
 *
 * Units, axes and statuses are those of carom.h. */
#ifndef CAROM_SHOT_H
#define CAROM_SHOT_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ==== A ball and a cushion ============================================================================================ */

/* A ball that touches a cushion, just before the impact. 15 doubles without gaps, so an array of n is also an (n, 15) array in
 * row order. */
typedef struct carom_cushion_impact {
  double v[3];        /* velocity, m/s. v[2] must be 0: the model keeps the ball on the table. */
  double w[3];        /* angular velocity, rad/s. */
  double normal[2];   /* horizontal direction from the ball into the cushion: across a rail, or from the centre of the ball to
                         the axis of a jaw. Any length but 0. */
  double height;      /* of the cushion's nose above the cloth, m, between 0 and 2 radius. */
  double radius;      /* of the ball, m, > 0. */
  double mass;        /* kg, > 0. The moment of inertia is that of a solid ball, 2/5 M R^2. */
  double mu_cloth;    /* coefficient of sliding friction between ball and cloth, 0 to 1, */
  double mu_cushion;  /* and between ball and cushion, 0 to 1. */
  double restitution; /* e, 0 to 1: the impact ends once e^2 of the work of compression has been given back. */
  double jaw_radius;  /* m, >= 0: radius of the jaw, 0 for a straight rail. The nose is touched at its height either way, so
                         this counts only for Stronge's model with the convention of pooltool. */
} carom_cushion_impact;

/* How the impact is computed. */
typedef enum carom_cushion_model {
  CAROM_CUSHION_MATHAVAN = 0, /* rigid cushion, friction at nose and cloth, energetic restitution: S. Mathavan, M. R. Jackson,
                                 R. M. Parkin, Proc. IMechE C 224 (2010) 1863-1873, as the exact limit of small impulses. */
  CAROM_CUSHION_STRONGE = 1,  /* compliant nose, no cloth: W. J. Stronge, Impact Mechanics (2000); the default of pooltool. */
  CAROM_CUSHION_HAN = 2,      /* rigid nose, no cloth: I. Han, J. Mech. Sci. Technol. 19 (2005) 976-984. */
  CAROM_CUSHION_MIRROR = 3,   /* the velocity across the cushion is turned back and multiplied by e; spin stays. */
  CAROM_CUSHION_EULER = 4,    /* the model of MATHAVAN in N steps of impulse, as pooltool takes them. */
} carom_cushion_model;

/* Whose conventions hold where the simulator pooltool departs from the papers: for parity with it, not for truth. */
typedef enum carom_cushion_convention {
  CAROM_CONVENTION_PAPER = 0, /* the nose is touched at its height: sin(theta) = (h - R) / R; a cloth cannot pull; no slip, no
                                 friction. */
  CAROM_CONVENTION_POOLTOOL = 1, /* STRONGE: tan(theta) = (h - R) / (R + jaw_radius + 1e-6 m). EULER: the cloth may pull, and a
                                    slip of 0 has the direction of +x. Nothing changes for the other models. */
} carom_cushion_convention;

/* Where restitution and friction of the cushion come from. */
typedef enum carom_cushion_law {
  CAROM_CUSHION_LAW_CONSTANT = 0, /* the fields of the impact. */
  CAROM_CUSHION_LAW_HAN = 1,      /* Han's fits, limited to 0 to 1, for any model; the fields are not used, though checked:
                                     e = 0.39 + 0.257 v_y - 0.044 v_y^2, v_y in m/s the speed into the cushion, and
                                     mu = 0.471 - 0.241 alpha, alpha in rad the angle of the velocity from the normal. */
} carom_cushion_law;

/* Options of a call. All zero means the defaults; a pointer to options may be NULL for the same. */
typedef struct carom_cushion_options {
  carom_cushion_model model;           /* default CAROM_CUSHION_MATHAVAN. */
  carom_cushion_convention convention; /* default CAROM_CONVENTION_PAPER. */
  carom_cushion_law law;               /* default CAROM_CUSHION_LAW_CONSTANT. */
  int steps;            /* Euler's N: compression and restitution take about so many steps each; 0: CAROM_DEFAULT_STEPS. */
  int threads;          /* most threads that a batch may use, the calling one among them. 0, the default: that one alone;
                           CAROM_ALL_THREADS: one for each processor. Results do not depend on it. */
  int unused;           /* must be 0. */
  double least_step;    /* N s, >= 0: EULER takes no step of less impulse, but for the last ones. Default 0; pooltool: 0.001. */
  double omega_ratio;   /* STRONGE: frequency of the nose along its surface over that across it, 1 to 2 without the ends. 0:
                           1.8, which is that of pooltool. */
  uint64_t reserved[4]; /* must be 0. */
} carom_cushion_options;

/* The name of a model ("mathavan", "stronge", "han", "mirror", "euler"), or NULL for a value not listed. */
CAROM_API const char *carom_cushion_model_name(carom_cushion_model model);

/* Resolves one impact. `opt` may be NULL for the defaults; `out` may not overlap `in`.
 * CAROM_OK: `*out` is the motion after the impact. CAROM_SEPARATING: the ball does not move into the cushion, and `*out` is its
 * motion before. An error: every number of `*out` is NaN (but `*out` is untouched when a pointer is NULL). */
CAROM_API carom_status carom_cushion(const carom_cushion_impact *in, const carom_cushion_options *opt, carom_motion *out);

/* Resolves `n` impacts, in[0..n-1] to out[0..n-1], each as carom_cushion() does, bit for bit: a bad row gets NaN and its own
 * status and changes nothing for the others. `status` takes the n statuses, each the value of a carom_status; it may be NULL.
 * `in`, `out` and `status` may not overlap; with n = 0 they may be NULL. Returns CAROM_OK if no row is in error, else the
 * status of the first that is; if the call itself cannot be served (NULL, bad options), that error, with nothing written. */
CAROM_API carom_status carom_cushion_batch(const carom_cushion_impact *in, size_t n, const carom_cushion_options *opt,
                                           carom_motion *out, int8_t *status);

/* Checks the arguments and solves nothing. Returns CAROM_OK or an error. If `field` is not NULL, `*field` becomes the index of
 * the offending number among the 15 doubles of `*in`, or -1 where none is to blame. `opt` may be NULL. */
CAROM_API carom_status carom_cushion_check(const carom_cushion_impact *in, const carom_cushion_options *opt, int *field);

/* The C name of number `field` of a carom_cushion_impact, 0 to 14: "v[0]" ... "jaw_radius". NULL outside that range. */
CAROM_API const char *carom_cushion_field_name(int field);

/* An impact on its way. Slips are in the frame of the cushion: x along it, y into it, z up. A slip is the velocity, m/s, of the
 * surface of the ball over what it touches. */
typedef struct carom_cushion_point {
  double normal;      /* normal impulse so far, N s: the measure of how far the impact has come. */
  double work;        /* work of the normal force so far, J: the sum of |v_n| dP. */
  carom_phase phase;  /* CAROM_PHASE_COMPRESSION up to v_n = 0. */
  int nose_sticks;    /* 1 where the ball does not slip on the nose, */
  int cloth_sticks;   /* and on the cloth; else 0, and always by Euler's method. */
  int unused;         /* 0. */
  double v_n;         /* speed into the nose, along the normal there, m/s; negative while they part. */
  double s_x, s_t;    /* slip on the nose, along the cushion and upwards across it. */
  double c_x, c_y;    /* slip on the cloth. */
  carom_motion state; /* along the axes of the table. */
  double reserved[4]; /* 0; room for what may be told later. */
} carom_cushion_point;

/* Follows one impact, by the model MATHAVAN or EULER, through `n` >= 2 points at equal steps of normal impulse (EULER: the
 * nearest whole steps) from 0 at points[0] to the end, which is the result of carom_cushion(). `opt` may be NULL. Made for
 * looking, not for speed: EULER takes n/2 times an impact. Returns what carom_cushion() does, or CAROM_ERROR_CUSHION_MODEL for
 * a model in closed form. CAROM_SEPARATING: every point is the motion before, with impulse 0. An error: every number is NaN
 * (but nothing is written when a pointer is NULL or n < 2). */
CAROM_API carom_status carom_cushion_trace(const carom_cushion_impact *in, const carom_cushion_options *opt, size_t n,
                                           carom_cushion_point *points);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_SHOT_H */
