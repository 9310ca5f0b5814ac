/* carom_shot.h: balls on a table. The impact of a ball on a cushion, and whole shots from the
 * strike to rest.
 *
 *     carom_cushion_impact in = {{0.5, 1.2, 0}, {0, 0, 0}, {0, 1},   // v, w, normal
 *                                0.0365, 0.028575, 0.17,             // height, radius, mass
 *                                // mu_slide, mu_cushion, restitution, jaw_radius
 *                                0.2, 0.2, 0.85, 0};
 *     carom_motion out;
 *     carom_status status = carom_cushion(&in, NULL, &out);
 *
 * Units, axes and statuses are as in carom.h. */
#ifndef CAROM_SHOT_H
#define CAROM_SHOT_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ==== A ball and a cushion ==================================================================== */

/* A ball that touches a cushion, just before the impact. 15 doubles without gaps, so an array of
 * n is also an (n, 15) array in row order. */
typedef struct carom_cushion_impact {
  double v[3];        /* velocity, m/s. v[2] must be 0: the model keeps the ball on the table. */
  double w[3];        /* angular velocity, rad/s. */
  double normal[2];   /* horizontal direction from the ball into the cushion: across a rail, or
                         from the centre of the ball to the axis of a jaw. Any length but 0. */
  double height;      /* of the cushion's nose above the cloth, m, between 0 and 2 radius. */
  double radius;      /* of the ball, m, > 0. */
  double mass;        /* kg, > 0. The moment of inertia is 2/5 M R^2, as for a solid ball. */
  double mu_slide;    /* coefficient of sliding friction between ball and cloth, 0 to 1. */
  double mu_cushion;  /* coefficient of sliding friction between ball and cushion, 0 to 1. */
  double restitution; /* e, 0 to 1: the impact ends once e^2 of the work of compression has been
                         returned. */
  double jaw_radius;  /* m, >= 0: radius of the jaw, 0 for a straight rail. The nose is touched at
                         its height either way, so only Stronge's model with the convention of
                         pooltool uses this. */
} carom_cushion_impact;

/* How the impact is computed. STRONGE, HAN and SMOOTH work along the inclined normal of the nose
 * and drop the vertical velocity, so they can leave a ball that still moves into the cushion, with
 * CAROM_OK: without friction where e < tan^2 theta, sin(theta) = (height - radius) / radius, which
 * is 0.085 at a pool table's nose; with friction and much spin at larger e too. A shot with carom's
 * own rules separates such a ball from the cushion in the same event, as after a slow contact
 * (docs/using/shots.md).
 */
typedef enum carom_cushion_model {
  CAROM_CUSHION_MATHAVAN = 0, /* rigid cushion, friction at nose and cloth, energetic
                                 restitution: S. Mathavan, M. R. Jackson, R. M. Parkin, Proc.
                                 IMechE C 224 (2010) 1863-1873, as the exact limit of small
                                 impulses. */
  CAROM_CUSHION_STRONGE = 1,  /* compliant nose, no cloth: W. J. Stronge, Impact Mechanics
                                 (2000); the default of pooltool. */
  CAROM_CUSHION_HAN = 2,      /* rigid nose, no cloth: I. Han, J. Mech. Sci. Technol. 19 (2005)
                                 976-984. */
  CAROM_CUSHION_MIRROR = 3,   /* reverses the velocity across the cushion and multiplies it by e;
                                 spin stays. */
  CAROM_CUSHION_EULER = 4,    /* the model of MATHAVAN in N steps of impulse, as in pooltool. */
  CAROM_CUSHION_SMOOTH = 5,   /* HAN without its corner between sticking and sliding, and with an
                                 elastic nose; derived from recorded impacts:
                                 docs/understanding/cushion.md. No cloth. */
} carom_cushion_model;

/* Which conventions are used where the simulator pooltool differs from the papers. POOLTOOL is only
 * for parity with it. */
typedef enum carom_cushion_convention {
  CAROM_CONVENTION_PAPER = 0,    /* the nose is touched at its height: sin(theta) = (h - R) / R.
                                    The cloth cannot pull. Without slip there is no friction. */
  CAROM_CONVENTION_POOLTOOL = 1, /* STRONGE: tan(theta) = (h - R) / (R + jaw_radius + 1e-6 m).
                                    EULER: the cloth may pull, and a slip of 0 has the direction of
                                    +x. No effect on the other models. */
} carom_cushion_convention;

/* Where restitution and friction of the cushion come from. */
typedef enum carom_cushion_law {
  CAROM_CUSHION_LAW_CONSTANT = 0, /* the fields of the impact. */
  CAROM_CUSHION_LAW_HAN = 1,      /* Han's fits, limited to 0 to 1, for any model; the fields are
                                     checked but not used: e = 0.39 + 0.257 v_y - 0.044 v_y^2, v_y
                                     in m/s the speed into the cushion, and mu = 0.471
                                     - 0.241 alpha, alpha in rad the angle of the velocity from
                                     the normal. */
} carom_cushion_law;

/* Options of a call. All zero means the defaults; a pointer to options may be NULL for the same. */
typedef struct carom_cushion_options {
  carom_cushion_model model;           /* default CAROM_CUSHION_MATHAVAN. */
  carom_cushion_convention convention; /* default CAROM_CONVENTION_PAPER. */
  carom_cushion_law law;               /* default CAROM_CUSHION_LAW_CONSTANT. */
  int steps;          /* Euler's N: compression and restitution take about N steps each; 0:
                         CAROM_DEFAULT_STEPS. */
  int threads;        /* largest number of threads that a batch may use, including the calling one.
                         0, the default: only the calling one; CAROM_ALL_THREADS: one for each
                         processor. Results do not depend on it. */
  int plain;          /* 1: with CAROM_ISA_PLAIN, as in carom_options. Default 0. */
  double least_step;  /* N s, >= 0: EULER makes no step with a smaller impulse, except for the last
                         ones. Default 0; pooltool: 0.001. */
  double omega_ratio; /* STRONGE: frequency of the nose along its surface divided by the frequency
                         across it, between 1 and 2 (exclusive). 0: 1.8, as in pooltool. */
  double smooth_q;    /* SMOOTH: width of the transition from sticking to sliding, 1e-12 to 0.5. If
                         it is 0, all parameters of SMOOTH must be 0, and the model uses values
                         measured on one table: q 0.35, x 1.3, t 1.18, a 0.25, k 0, g 0.067, g_log
                         -0.059, e 0.06. */
  double smooth_x;    /* SMOOTH: fraction of the slip along the cushion that friction removes if it
                         can, above 0, at most 2. 1 stops the slip; more than 1 reverses some of
                         it. */
  double smooth_t;    /* SMOOTH: the same for the slip across the cushion, above 0, at most 2. */
  double smooth_a;    /* SMOOTH: the limit of friction across the cushion is 1 + smooth_a times the
                         limit along it. 0 to 1. */
  double smooth_k;    /* SMOOTH: where friction reaches its limit, the rebound gains this fraction
                         of the impulse, 0 to 1, at most up to an impulse that reverses the closing
                         speed. */
  double restitution_log;  /* any model: change of restitution for each unit of ln(v), -1 to 1;
                              default 0. At v = 1 m/s restitution has the value of the impact; the
                              total is limited to 0 to 1. v is the speed across the cushion, at
                              least 0.1 m/s: the closing speed at the nose over cos(theta). theta is
                              the angle for a ball on the cloth, also in flight. Not read with
                              CAROM_CUSHION_LAW_HAN. */
  double mu_log;           /* any model: the same for friction, -1 to 1; default 0. */
  double smooth_g;         /* SMOOTH: the further friction is from sticking, the more impulse the
                              rebound gains, at most this fraction of it, at v = 1 m/s. -1 to 1. The
                              energy limits the gain. */
  double smooth_g_log;     /* SMOOTH: change of smooth_g for each unit of ln(v), -1 to 1. */
  double smooth_e;         /* SMOOTH: restitution increases by at most this if the surface of the
                              ball moves down the nose, as when a ball rolls into it. -1 to 1. */
  double restitution_log2; /* any model: as restitution_log, for each unit of ln(v)^2. ln(v)^2 is
                              limited to 1, which it reaches at 0.37 and 2.7 m/s. -1 to 1. */
  double roll_loss;        /* any model: an impact reduces the ball's roll along the cushion by this
                              fraction of the speed along the cushion before the impact. 0 to 1. */
  double roll_loss_log;    /* any model: change of roll_loss for each unit of ln(v), -1 to 1. The
                              total is limited to 0 to 1. */
  uint64_t reserved[2];    /* must be 0. */
} carom_cushion_options;

/* Resolves one impact. `opt` may be NULL for the defaults; `out` may not overlap `in`.
 * CAROM_OK: `*out` is the motion after the impact. CAROM_SEPARATING: the ball does not move into
 * the cushion, and `*out` is its motion before. An error: every number of `*out` is NaN (but
 * `*out` is untouched when a pointer is NULL).
 *
 * MATHAVAN: impacts of play (mu_slide and mu_cushion 0.1 to 0.4, e from 0.6, the nose 1.2 to 1.45
 * radii high) have errors within 1e-6 of the fastest velocity (spins times the radius). All other
 * accepted impacts have errors within 1e-5, or the status CAROM_ERROR_UNRESOLVED; 3 of 2 million
 * random impacts of play had this status. There is one exception: with both frictions near the
 * values at which the ball jams (docs/understanding/cushion.md), 1 of 2 million random impacts
 * beyond play had an error of 6e-4. The bounds hold down to an approach of 1e-9 of the speed. The
 * solver ends after 400 iterations, at most 3,300 evaluations of the equations and 200 us. */
CAROM_API carom_status carom_cushion(const carom_cushion_impact *in,
                                     const carom_cushion_options *opt, carom_motion *out);

/* Resolves `n` impacts, in[0..n-1] to out[0..n-1], with the bits of carom_cushion(). A bad row gets
 * NaN and its own status, and does not change the other rows. `status` receives the n statuses,
 * each the value of a carom_status; it may be NULL. `in`, `out` and `status` may not overlap; with
 * n = 0 they may be NULL. Returns CAROM_OK if no row is in error, and otherwise the status of the
 * first row in error. If a pointer is NULL or an option is bad, the call returns that error and
 * writes nothing. */
CAROM_API carom_status carom_cushion_batch(const carom_cushion_impact *in, size_t n,
                                           const carom_cushion_options *opt, carom_motion *out,
                                           int8_t *status);

/* Checks the arguments and solves nothing. Returns CAROM_OK or an error. If `field` is not NULL,
 * `*field` becomes the index of the invalid number among the 15 doubles of `*in`, or -1 if the
 * error is not in a single number. `opt` may be NULL. */
CAROM_API carom_status carom_cushion_check(const carom_cushion_impact *in,
                                           const carom_cushion_options *opt, int *field);

/* The C name of number `field` of a carom_cushion_impact, 0 to 14: "v[0]" ... "jaw_radius". NULL
 * outside that range. */
CAROM_API const char *carom_cushion_field_name(int field);

/* One point of an impact. Slips are in the frame of the cushion: x along it, y into it, z up. A
 * slip is the velocity, m/s, of the surface of the ball over the body it touches. */
typedef struct carom_cushion_point {
  double normal;      /* normal impulse so far, N s. It grows during the whole impact. */
  double work;        /* work of the normal force so far, J: the sum of |v_n| dP. */
  carom_phase phase;  /* CAROM_PHASE_COMPRESSION up to v_n = 0. */
  int nose_sticks;    /* 1 if the ball does not slip on the nose, otherwise 0. Always 0 with Euler's
                         method. */
  int cloth_sticks;   /* 1 if the ball does not slip on the cloth, otherwise 0. Always 0 with
                         Euler's method. */
  int unused;         /* 0. */
  double v_n;         /* speed into the nose, along the normal there, m/s; negative while they
                         separate. */
  double s_x, s_t;    /* slip on the nose, along the cushion and upwards across it; exactly 0
                         where it sticks. */
  double c_x, c_y;    /* slip on the cloth; exactly 0 where it sticks. */
  carom_motion state; /* along the axes of the table. */
  double reserved[4]; /* 0; room for future fields. */
} carom_cushion_point;

/* Follows one impact, by the model MATHAVAN or EULER, through `n` >= 2 points at equal steps of
 * normal impulse (EULER: the nearest whole steps) from 0 at points[0] to the end, which is the
 * result of carom_cushion(): only the last point includes the loss of roll. `opt` may be NULL. The
 * call is slow: MATHAVAN may need 400 iterations for each point, and EULER takes n/2 times as long
 * as an impact. Returns the status of carom_cushion(), or CAROM_ERROR_CUSHION_MODEL for a model in
 * closed form. CAROM_SEPARATING: every point is the motion before, with impulse 0. An error: every
 * number is NaN (but nothing is written when a pointer is NULL or n < 2). */
CAROM_API carom_status carom_cushion_trace(const carom_cushion_impact *in,
                                           const carom_cushion_options *opt, size_t n,
                                           carom_cushion_point *points);

/* ==== Whole shots ================================================================================
 *
 * A shot is computed event by event, from the strike of the cue until all balls rest. Between
 * events the motion of every ball has a closed form, so no contact is missed.
 *
 *     carom_table table;
 *     carom_table_make(CAROM_TABLE_POOL_9FT, &table);
 *     carom_shot_ball balls[10];
 *     // gap 0.1 mm, seed 1; balls[0] is the cue ball
 *     carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, 10);
 *     carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
 *     cue.speed = 8.0;  // aimed at the rack by default
 *     static carom_event events[256];
 *     static carom_shot shot;                                                   // static: all zero
 *     shot.events = events;
 *     shot.room = 256;
 *     // balls[] are not changed
 *     carom_status status = carom_shoot(&table, balls, 10, &cue, NULL, &shot);
 *     carom_ball_state moved[10];
 *     carom_shot_at(balls, 10, &shot, 1.5, moved);  // the states after 1.5 s
 *
 * The playing surface is 0 <= x <= width, 0 <= y <= length for the built-in tables, with z up
 * and the cloth at z = 0: a ball on it has its centre at z = R. docs/using/shots.md describes
 * the models, the rules and the bounds.
 *
 * Bits: a shot has the same bits on every machine, with every model and with carom's or pooltool's
 * rules, unless options.fast selects the instruction set in use. A batch has the bits of single
 * calls, for any number of threads and any split. Cost: docs/using/shots.md has the times of shots,
 * and docs/understanding/cushion.md the times of impacts on cushions. Stack: 61 KiB; a batch 67
 * KiB, also with threads. Only the threads of a batch allocate memory. */

/* ---- Balls ----------------------------------------------------------------------------------- */

/* How a ball moves. u = (v_x - R w_y, v_y + R w_x) is its slip over the cloth. */
typedef enum carom_label {
  CAROM_BALL_STATIONARY = 0, /* at rest */
  CAROM_BALL_SPINNING = 1,   /* turning on the spot about the vertical, v = 0 and w_x = w_y = 0 */
  CAROM_BALL_SLIDING = 2,    /* u is not 0; sliding friction acts against u */
  CAROM_BALL_ROLLING = 3,    /* u = 0; rolling resistance acts against v */
  CAROM_BALL_POCKETED = 4,   /* in a pocket, out of play */
  CAROM_BALL_AIRBORNE = 5,   /* above the cloth, or about to leave it or to land. The ball flies
                                freely, and its spin is constant */
  CAROM_BALL_OFF = 6         /* off the table, out of play. The position is where the ball left the
                                table */
} carom_label;

/* The constants of a ball and of its cloth. All doubles, without gaps. */
typedef struct carom_ball_kind {
  double mass;                /* kg, > 0. May differ from ball to ball with carom's rules. */
  double radius;              /* R, m, > 0. The same for all balls of a layout with
                                 CAROM_SPACE_FLAT. */
  double mu_slide;            /* sliding friction of ball and cloth, > 0, at most 1. Pool 0.2. */
  double mu_roll;             /* rolling resistance, > 0, at most 1. Pool 0.01. */
  double mu_spin;             /* friction of the ball turning on the spot, > 0, at most 1: w_z
                                 falls at 5 mu_spin g / (2 R). */
  double mu_ball;             /* friction between balls, 0 to 1; a pair uses the mean. Only read
                                 with CAROM_FRICTION_CONSTANT. */
  double restitution;         /* restitution of two balls, 0 to 1; a pair uses the mean. Pool
                                 0.95. */
  double mu_cushion;          /* friction of ball and cushion, 0 to 1. Pool 0.28. */
  double restitution_cushion; /* restitution of ball and cushion, 0 to 1. Pool 0.8. */
  double gravity;             /* g, m/s^2, > 0, at most 1e6. */
  double drag;                /* k, 1/m, 0 to 1: a rolling ball has the deceleration mu_roll g + k
                                 v^2, m/s^2. 0: only mu_roll g. */
  double roll_loss; /* 0 to 1: an impact on a cushion reduces the ball's roll along the cushion by
                       this fraction of its speed along the cushion. The roll is R w_n, where w_n is
                       the spin about the normal; it does not fall below 0. */
  double law_a, law_b, law_c; /* friction with another ball that slips at the speed u, m/s: law_a +
                                 law_b exp(-law_c u), law_c in s/m. Each >= 0, and law_a + law_b <=
                                 1; a pair uses the mean of each. All 0: carom_alciatore(). Not read
                                 with CAROM_FRICTION_CONSTANT. */
  double nose_height; /* height of the nose of every cushion that the ball meets, above the cloth,
                         m, below 2 R; 0: the height of the rail or jaw. */
  double omega_ratio; /* for Stronge's cushions, as in carom_cushion_options: between 1 and 2
                         (exclusive); 0: 1.8. */
  double restitution_table; /* restitution of ball and slate, at most 0.98; 0: 0.5, a convention;
                               -1: none. */
  double modulus;           /* E/(1 - nu^2) of the ball's material, 1e6 to 1e15 Pa; 0: 6.6e9, for
                               one phenolic resin. It matters if several balls touch at one
                               instant. */
  double restitution_log, mu_log; /* for cushions: restitution and friction change by these for each
                                     unit of ln(v), v in m/s the speed across the cushion, as in
                                     carom_cushion_options. */
  /* for smooth cushions, as in carom_cushion_options. All 0: values measured on one table. */
  double smooth_q, smooth_x, smooth_t, smooth_a, smooth_k, smooth_g, smooth_g_log, smooth_e;
  double restitution_log2; /* for cushions, as in carom_cushion_options. */
  double roll_loss_log;    /* roll_loss changes by this for each unit of ln(v), v as above, limited
                              to 0 to 1; -1 to 1. */
} carom_ball_kind;

/* Where a ball is and how it moves. */
typedef struct carom_ball_state {
  double r[3];   /* centre, m; r[2] = R on the cloth. */
  double v[3];   /* velocity, m/s; v[2] = 0 on the cloth. */
  double w[3];   /* angular velocity, rad/s. */
  int64_t label; /* a carom_label. In a layout, carom keeps POCKETED, AIRBORNE and OFF, and derives
                    all other labels. A ball is AIRBORNE if v[2] is not 0 or if it is more than 1e-6
                    m above the cloth. The rest follows from v and w, where a slip or a speed of at
                    most 1e-12 m/s counts as 0. */
} carom_ball_state;

/* A ball of a layout: its constants and its state. */
typedef struct carom_shot_ball {
  carom_ball_kind kind;   /* the constants of the ball. */
  carom_ball_state state; /* the position and the motion of the ball. */
} carom_shot_ball;

/* Games, for their balls and cues. docs/reference/constants.md has the source of each constant. The
 * constants of the cushion belong to the default model with carom's rules: the smooth model for the
 * first three games, Han's model for pooltool's games. carom_ball_kind_for() returns the constants
 * for other models. */
typedef enum carom_game {
  CAROM_GAME_POOL = 0,              /* typical constants, each within the published range. The
                                       constants of the cushion are fitted to public systems of
                                       players; no table was measured */
  CAROM_GAME_SNOOKER = 1,           /* rolling, impacts of balls and cushions from videos of 17
                                       broadcast shots; sliding friction measured on one table
                                       (Mathavan and others, 2009); the rest are conventions */
  CAROM_GAME_BILLIARD = 2,          /* three-cushion: measured on one table, from 182 recorded
                                       shots, with drag, loss of roll and the parameters of
                                       CAROM_CUSHION_SMOOTH */
  CAROM_GAME_POOLTOOL_POOL = 3,     /* pool balls with pooltool's constants, for parity with it */
  CAROM_GAME_POOLTOOL_SNOOKER = 4,  /* snooker balls with pooltool's constants, for parity with
                                       it */
  CAROM_GAME_POOLTOOL_BILLIARD = 5, /* carom balls with pooltool's constants, for parity with it */
  CAROM_GAME_BLACKBALL = 6,         /* POOL with balls of 50.8 mm and 116 g. Noses are as high for
                                       these balls as in POOL; no table was measured */
  CAROM_GAME_PYRAMID = 7,           /* POOL with balls of 68 mm and 285 g. Noses are as high for
                                       these balls as in POOL; no table was measured */
  CAROM_GAME_FOURBALL = 8           /* BILLIARD with balls of 65.5 mm, whose mass follows from the
                                       size. Noses are as high for these balls as in BILLIARD; no
                                       table was measured */
} carom_game;

/* The constants of the balls of a game; the constants of pool for a value not listed. Racks use the
 * balls of carom's own games. */
CAROM_API carom_ball_kind carom_ball_kind_of(carom_game game);

/* ---- Tables ---------------------------------------------------------------------------------- */

/* The largest numbers of rails, jaws and pockets of a table, and of balls in a layout. */
enum { CAROM_RAILS_MOST = 32, CAROM_JAWS_MOST = 32, CAROM_POCKETS_MOST = 8, CAROM_BALLS_MOST = 32 };

/* A straight piece of cushion: a vertical wall above the segment from p to q. `line` is lx, ly, l0
 * of the line lx x + ly y + l0 = 0 through both ends. The caller sets it, or leaves it all 0, so
 * that carom derives it. `side` is the side on which the balls are: 0 where lx x + ly y + l0 < 0, 1
 * where it is > 0. With a derived line, side 1 is to the left of p -> q, side 0 to its right. */
typedef struct carom_rail {
  double p[2], q[2], height;      /* m; height of the nose above the cloth, between 0 and 2 R. */
  double line[3];                 /* lx, ly, l0 of the line lx x + ly y + l0 = 0; all 0: carom
                                     derives them. */
  int64_t side;                   /* 0: balls are where lx x + ly y + l0 < 0; 1: where it is > 0. */
  double mu_cushion, restitution; /* of this rail, 0 to 1; 0: the values of the ball. */
} carom_rail;

/* A rounded end of a cushion: a vertical cylinder, which balls touch from outside. radius >= 0.
 * Where a rail ends on it and is tangent to it, within 0.1 mm, it has the friction and the
 * restitution of the rail; its own apply from a chord of 8 mm from there on, except with
 * CAROM_WORLD_POOLTOOL. */
typedef struct carom_jaw {
  double centre[2], radius, height; /* m; height of the nose above the cloth, between 0 and 2 R. */
  double mu_cushion, restitution;   /* 0 to 1, as of a rail. */
} carom_jaw;

/* A ball falls into a pocket when the centre of the ball crosses the circle inward. A pocketed ball
 * is at z = -depth. */
typedef struct carom_pocket {
  double centre[2], radius, depth; /* m; radius 1e-9 or more. */
} carom_pocket;

/* A table: any geometry. Fill the counts and the arrays, or call carom_table_make(). */
typedef struct carom_table {
  double width, length;                    /* m, for drawing and racks. */
  int64_t rails, jaws, pockets;            /* number of elements of rail[], jaw[] and pocket[] in
                                              use. */
  carom_rail rail[CAROM_RAILS_MOST];       /* straight pieces of cushion. */
  carom_jaw jaw[CAROM_JAWS_MOST];          /* rounded ends of cushions. */
  carom_pocket pocket[CAROM_POCKETS_MOST]; /* pockets. */
  /* Only read with CAROM_SPACE_3D. All >= 0, m; 0 means the default. */
  double ball_radius; /* m, radius of the balls for which rails are placed: such a ball on the cloth
                         touches a rail when its centre is one radius from the rail's line. This
                         determines the position of the nose. 0: the radius that most balls of the
                         layout have, and of equally common radii the largest. */
  double rail_width;  /* width of the tops of the rails, behind the noses, onto which balls may
                         fall; at least the radius of the largest ball; 0: 0.12 m, a convention. */
  double pocket_back; /* height of the backs of pockets, m: an airborne ball over a pocket falls
                         into it if its centre is at most this high above the cloth when it leaves
                         the circle; 0: the greatest height of a nose. */
  /* Always read. */
  double slope_x, slope_y; /* by how much the cloth rises for each metre along x and y, -1 to 1; 0:
                              level. The magnitude of this slope must be below mu_roll and mu_slide
                              of every ball, so that the balls stop. Contacts neglect it. */
} carom_table;

/* Built-in tables, with their playing areas. The pockets of the pool tables are in the middle of
 * the ranges of the WPA's rules; carom_table_measures() returns the measures. */
typedef enum carom_table_kind {
  CAROM_TABLE_POOL_7FT = 0,     /* 0.9906 x 1.9812 m */
  CAROM_TABLE_POOL_8FT = 1,     /* 1.1176 x 2.2352 m */
  CAROM_TABLE_POOL_9FT = 2,     /* 1.27 x 2.54 m */
  CAROM_TABLE_SNOOKER = 3,      /* 12 ft, 1.778 x 3.569 m */
  CAROM_TABLE_THREECUSHION = 4, /* 10 ft, 1.42 x 2.84 m, no pockets */
  CAROM_TABLE_POOLTOOL = 5,     /* pooltool's default, "7 Ft Showood", 0.9906 x 1.9812 m, with
                                   its pockets, bit for bit */
  CAROM_TABLE_HEYBALL = 6,      /* 1.27 x 2.54 m, mouths of 85 and 86 mm with rounded jaws */
  CAROM_TABLE_BLACKBALL = 7,    /* 0.9144 x 1.8288 m, mouths of 83.7 mm with rounded jaws */
  CAROM_TABLE_PYRAMID = 8,      /* 1.775 x 3.55 m, mouths of 72.5 and 82.5 mm for balls of 68 mm */
  CAROM_TABLE_FOURBALL = 9      /* 1.27 x 2.54 m, no pockets */
} carom_table_kind;

/* The game for whose balls a table is made: CAROM_GAME_POOL unless it is a table of another
 * game. */
CAROM_API carom_game carom_game_of_table(carom_table_kind table);

/* Fills *table. Returns CAROM_OK, CAROM_ERROR_NULL, or CAROM_ERROR_TABLE if there is no such
 * kind. */
CAROM_API carom_status carom_table_make(carom_table_kind kind, carom_table *table);

/* The name of a rail or a pocket of a rectangular table, for a player who stands at the head, y =
 * 0, and looks along the table: "head", "foot", "left" or "right"; "head-left", "side-left",
 * "foot-left", "head-right", "side-right" or "foot-right". NULL for a rail that is the cut of a
 * pocket, for other tables, and for an invalid index. */
CAROM_API const char *carom_rail_name(const carom_table *table, int rail);
CAROM_API const char *carom_pocket_name(const carom_table *table, int pocket);

/* 1 if a rail ends at a pocket, within three radii of its centre, otherwise 0. A ball that meets
 * such a rail and falls into the pocket is not banked. */
CAROM_API int carom_is_beside(const carom_table *table, int rail, int pocket);

/* A part of a table, or a ball. */
typedef enum carom_part_kind {
  CAROM_PART_NONE = 0,   /* no part */
  CAROM_PART_RAIL = 1,   /* carom_rail */
  CAROM_PART_JAW = 2,    /* carom_jaw */
  CAROM_PART_POCKET = 3, /* carom_pocket */
  CAROM_PART_BALL = 4,   /* carom_ball_kind */
  /* other structs with numbers; see carom_number_of() */
  CAROM_PART_OPTIONS = 5,         /* carom_shot_options */
  CAROM_PART_IMPACT_OPTIONS = 6,  /* carom_options */
  CAROM_PART_CUSHION_OPTIONS = 7, /* carom_cushion_options, except for the numbers of a ball's
                                     cushions */
  CAROM_PART_PLAN_OPTIONS = 8,    /* carom_plan_options */
  CAROM_PART_CUE = 9,             /* carom_cue */
  CAROM_PART_TABLE = 10,          /* carom_table */
  CAROM_PART_STATE = 11,          /* carom_ball_state */
  CAROM_PART_MEASURES = 12,       /* carom_measures */
  CAROM_PART_CORNER = 13          /* carom_corner, of a polygon */
} carom_part_kind;

/* A part of a table or of a layout. */
typedef struct carom_part {
  carom_part_kind kind; /* a carom_part_kind. */
  int32_t index;        /* in its array; 0 of CAROM_PART_NONE. */
} carom_part;

/* What is wrong with a table, and where. A measure is a part too; its index is its position in its
 * struct. */
typedef struct carom_table_fault {
  carom_part part, other; /* the part at fault; for a hole, the parts on both of its sides. */
  double place[2];        /* m: the middle of the hole or of the rail; 0 if a number of the part is
                             invalid. */
  double gap;             /* m: width of the hole, from surface to surface; otherwise 0. */
} carom_table_fault;

/* Checks a custom table for balls of a radius. Call it while you build a table, not for each shot,
 * because it takes some milliseconds. It checks in this order that (1) each part is valid by
 * itself, as carom_shoot() does; (2) the line of each rail passes through its ends, within 1e-6 m;
 * (3) the ring of rails, jaws and pockets around the middle (width/2, length/2) is closed, so that
 * a ball can leave the table only through a pocket. If the middle is outside, the ring around a
 * point next to the longest rail counts; (4) the played side of each rail is the one where balls
 * are, if a ball has room next to the rail; (5) there is a jaw, if necessary of radius 0, wherever
 * a ball could enter between the ends of two rails without hitting anything. *fault describes the
 * first fault, and may be NULL. In case (5), gap is the distance between the centres of balls that
 * touch the two rails. The check does not look for holes between noses of different heights,
 * through which balls of other radii may pass. Returns CAROM_OK, CAROM_ERROR_NULL,
 * CAROM_ERROR_RADIUS, CAROM_ERROR_TABLE, CAROM_ERROR_RAILS, CAROM_ERROR_JAWS or CAROM_ERROR_POCKETS
 * for too many (the part is the first without room), CAROM_ERROR_NOSE_HEIGHT,
 * CAROM_ERROR_RAIL_LINE, CAROM_ERROR_TABLE_OPEN (with the hole that has to be closed last;
 * CAROM_PART_NONE if there is no ring, or no room for a ball in its middle), or
 * CAROM_ERROR_RAIL_SIDE. */
CAROM_API carom_status carom_table_check(const carom_table *table, double radius,
                                         carom_table_fault *fault);

/* The measures of a table, as rule books have them. A mouth is the distance between the points
 * where the noses would meet the facings of the pocket if they were not rounded. A cut is the angle
 * between nose and facing. A shelf extends from the middle of the mouth to the edge of the hole; a
 * ball falls when its centre passes this edge. carom_number_of(CAROM_PART_MEASURES, k) has the
 * range of each. */
typedef struct carom_measures {
  double width, length; /* m, of the playing area, between the noses. */
  double nose_height;   /* m */
  double cushion_depth; /* m, how far the facings extend behind the noses. */
  /* of corner pockets, m and degrees; jaw and hole are radii, of the rounded point and of the hole.
   * Both mouths 0: a table without pockets. */
  double corner_mouth, corner_cut, corner_shelf, corner_jaw, corner_hole;
  /* of side pockets, m and degrees; jaw and hole are radii, as of corner pockets. */
  double side_mouth, side_cut, side_shelf, side_jaw, side_hole;
  double facing_restitution, facing_friction; /* of facings and jaws, as restitution and mu_cushion
                                                 of a carom_rail, 0 to 1; 0: the values of the
                                                 ball. */
  double slope_x, slope_y;                    /* of the cloth, as of a carom_table. */
} carom_measures;

/* The measures of a built-in table. Statuses are as for carom_table_make(). */
CAROM_API carom_status carom_table_measures(carom_table_kind kind, carom_measures *measures);

/* Makes a table from its measures, and checks it with carom_table_check() for balls of a radius.
 * The check sets the status and *fault; fault may be NULL. CAROM_ERROR_TABLE with
 * CAROM_PART_MEASURES means that the measure is outside its range. If fault->other is a measure
 * too, the first one must be below fault->gap because of the other. */
CAROM_API carom_status carom_table_measured(const carom_measures *measures, double ball_radius,
                                            carom_table *table, carom_table_fault *fault);

/* A corner of a table of any closed shape: its position, m, from any origin, and the width of the
 * pocket's mouth there, from jaw to jaw, m; 0: no pocket. A corner on a straight side makes a side
 * pocket. */
typedef struct carom_corner {
  double x, y, mouth; /* m. x, y: the position; mouth: the width of the mouth, 0: no pocket. */
} carom_corner;

/* Makes a table from its corners, 3 to CAROM_RAILS_MOST, in the order of a walk around it, in
 * either direction. The table is moved so that its least x and y are 0. nose_height, m, is the
 * height of all noses; jaw_radius, m, the radius of the rounded ends of rails at pockets;
 * ball_radius, m, the radius of the balls. Rails end where mouths begin. A pocket is a circle as
 * wide as the mouth. It is behind the mouth, or a little inside it if a ball could otherwise slip
 * past. There must be room for a ball in the middle (width/2, length/2), where width and length are
 * the greatest x and y, or next to the longest rail, as in an L or a U. carom_table_check() checks
 * the result and sets the status and *fault; fault may be NULL. Further errors are
 * CAROM_ERROR_CORNERS for the number of corners; CAROM_ERROR_SIDES_CROSS, with the two sides as
 * rails that have the index of the corner where they begin; and these, with the corner as a
 * CAROM_PART_CORNER: CAROM_ERROR_CORNER for a number of it; CAROM_ERROR_CORNERS_MEET and
 * CAROM_ERROR_MOUTHS, with the next corner as fault->other; CAROM_ERROR_POCKETS and
 * CAROM_ERROR_JAWS, with the first corner for whose parts there is no room; and
 * CAROM_ERROR_CORNERS_IN_LINE, with the first corner. */
CAROM_API carom_status carom_table_polygon(const carom_corner *corner, int count,
                                           double nose_height, double jaw_radius,
                                           double ball_radius, carom_table *table,
                                           carom_table_fault *fault);

/* Racks, with the cue ball first. */
typedef enum carom_rack_kind {
  CAROM_RACK_NINEBALL = 0,     /* 10 balls: cue ball, then 1 to 9 by number, 1 in front and 9 in
                                 the middle. */
  CAROM_RACK_EIGHTBALL = 1,    /* 16 balls: cue ball, then 1 to 15 by number; 8 in the middle,
                                 both kinds in the corners. */
  CAROM_RACK_TENBALL = 2,      /* 11 balls: cue ball, then 1 to 10 by number, 10 in the middle. */
  CAROM_RACK_SNOOKER = 3,      /* 22 balls: white, 15 reds, yellow, green, brown, blue, pink,
                                 black. */
  CAROM_RACK_THREECUSHION = 4, /* 3 balls: white, yellow, red, as for the opening. */
  CAROM_RACK_NINEONSPOT = 5,   /* as NINEBALL, with the 9 on the foot spot. */
  CAROM_RACK_BLACKBALL = 6,  /* as EIGHTBALL, with the 8 on the foot spot, and balls of 2 inches. */
  CAROM_RACK_ROTATION = 7,   /* 16 balls: cue ball, then 1 to 15 by number; 1 in front, 2 and 3 in
                                 the corners, 15 in the middle. */
  CAROM_RACK_PYRAMID = 8,    /* 16 balls of 68 mm: the yellow one, then 15 white ones. */
  CAROM_RACK_FOURBALL = 9,   /* 4 balls of 65.5 mm: white, yellow, two reds, as for the opening. */
  CAROM_RACK_COWBOY = 10,    /* 4 balls: cue ball; 1 on the head spot, 3 on the foot spot, 5 on the
                                 centre. */
  CAROM_RACK_BILLIARDS = 11, /* 3 balls of snooker: white, yellow, which is in a pocket, and the
                                 red on the spot of the black. */
  CAROM_RACK_EIGHTONSPOT = 12 /* as EIGHTBALL, with the 8 on the foot spot. */
} carom_rack_kind;

/* The number of balls of a rack; 0 if there is no such kind. */
CAROM_API int carom_rack_size(carom_rack_kind kind);

/* Sets up a rack on the table. Neighbours are `gap` apart, and each ball is moved by up to a
 * quarter of the gap in a random direction. gap 0 is a frozen rack. `seed` determines these
 * directions, and the positions of the balls that have no fixed one. `room` is the number of
 * elements of balls[]. Returns CAROM_OK, CAROM_ERROR_NULL, or CAROM_ERROR_RACK if there is no such
 * kind, the gap is below 0 or above R, or there is too little room. */
CAROM_API carom_status carom_rack(carom_rack_kind kind, const carom_table *table, double gap,
                                  uint64_t seed, carom_shot_ball *balls, int room);

/* The spot of a ball of a rack, m, by the rules of its game. A colour of snooker has its own spot.
 * For the balls of pool and the reds it is the foot spot, and for the cue ball the position in
 * which carom_rack() puts it. Returns CAROM_OK, CAROM_ERROR_NULL, or CAROM_ERROR_RACK if the rack
 * has no such ball. */
CAROM_API carom_status carom_spot_of(carom_rack_kind kind, const carom_table *table, int ball,
                                     double place[2]);

/* The marks of a table, m: spots and lines of the rules of all games. The head of a table is at y =
 * 0. */
typedef struct carom_marks {
  double head_spot[2];   /* middle of the head string, which is the line y = head_spot[1]. */
  double centre_spot[2]; /* middle of the table. */
  double foot_spot[2];   /* where racks begin. */
  double d_centre[2];    /* middle of the baulk line of snooker; the D is the half circle around it
                            towards y = 0. */
  double d_radius;       /* radius of the D. */
  double baulk_line;     /* y of the baulk line of blackball. */
} carom_marks;

/* Writes the marks of a table, which follow from its width and its length. Returns CAROM_OK or
 * CAROM_ERROR_NULL. */
CAROM_API carom_status carom_table_marks(const carom_table *table, carom_marks *marks);

/* ---- The cue --------------------------------------------------------------------------------- */

/* A stroke, and the cue with which it is played. */
typedef struct carom_cue {
  double speed;    /* speed V0 of the cue before the strike, m/s, 0 to 1000. 0: no strike. */
  double phi;      /* direction in the plane, degrees from +x towards +y, -1e9 to 1e9. */
  double theta;    /* elevation of the butt, degrees, 0 to 90; below CAROM_LEAST_ELEVATION the cue
                      is level. The tip of a raised cue presses the ball onto the slate, and the
                      slate throws the ball up: both are contacts that last. With CAROM_SPACE_FLAT
                      the downward component of the strike is lost. */
  double a, b;     /* where the tip touches, in units of R: a > 0 left, b > 0 above the centre. a^2
                      + b^2 < miscue^2. */
  double mass;     /* M, kg, > 0. */
  double end_mass; /* effective mass of the end of the cue at the tip, which causes squirt, kg, >
                      0. */
  double tip_restitution; /* restitution e of the tip and the ball, 0 to 1; 0: 1, without loss. The
                             speed of the ball is proportional to 1 + e. Leather 0.73, phenolic
                             resin 0.85, pooltool 1. carom_cue_of() uses a leather tip for carom's
                             games, and 1 for pooltool's games, with the bits of pooltool. */
  double tip_radius;      /* m, 0 or more; the strike does not use it. */
  int64_t ball;           /* index of the ball that is struck. */
  double miscue;          /* R, 0 to 1: the offset at which the tip slips off the ball; 0: 1, the
                             edge of the ball. Chalked tips reach 0.5. */
  double tip_time;        /* s, at most 0.01: how long the tip touches a single, free ball. 0:
                             CAROM_TIP_TIME; for tips of hard resin 0.0008. -1: no time; strike and
                             landing are then two events. */
  double follow; /* m, 0 to 1: how far the cue continues after it has touched the ball, with its
                    remaining speed. If it touches a ball then, this is another event STRIKE. 0: the
                    cue stops at once; carom_cue_of() uses CAROM_CUE_FOLLOW. */
} carom_cue;

/* m: the follow-through of carom's games. This is a convention: players who follow through move the
 * cue further, and players who play at a near ball stop the cue, or play from the side. */
#define CAROM_CUE_FOLLOW 0.03

/* s, for a leather tip. Measured values are 0.001 to 0.003 for leather, and 0.0008 or more for hard
 * resin (billiards.colostate.edu, "How long is the tip in contact with the cue ball?"). The choice
 * within that range is a convention. A raised strike depends only on the ratio to
 * CAROM_SLATE_TIME. */
#define CAROM_TIP_TIME 0.001

/* s: how long the slate touches a ball that falls on it, for every speed, within the strike of a
 * raised cue. A convention, because no measurement was found: from 0.93 to 2 ms the slate gives the
 * ball more than half of its impulse after the tip has left, as D. Alciatore describes hops. */
#define CAROM_SLATE_TIME 0.001

/* degrees: a cue that is raised by less is level. */
#define CAROM_LEAST_ELEVATION 0.000001

/* The restitution of a leather tip: billiards.colostate.edu, "cue tip efficiency", 0.71 to 0.75.
 * The same source has 0.81 to 0.87 for phenolic resin. */
#define CAROM_TIP_LEATHER 0.73

/* The usual cue: speed 2, phi 90 (along the table), b = 0.25, ball 0, and a tip of leather; for
 * pooltool's games a tip without loss. */
CAROM_API carom_cue carom_cue_of(carom_game game);

/* Writes the motion of a ball at rest after a strike to out->v and out->w, as with
 * CAROM_SPACE_FLAT: v[2] = 0. Only the mass and the radius of the ball are read. Returns CAROM_OK;
 * an error of a field of the cue, or of the mass or radius of the ball; or CAROM_ERROR_OVERFLOW.
 * With an error *out is untouched. */
CAROM_API carom_status carom_strike(const carom_cue *cue, const carom_ball_kind *kind,
                                    carom_motion *out);

/* ---- Options --------------------------------------------------------------------------------- */

/* The rules of contact. CAROM_WORLD_CAROM: an event occurs where the gap is <= 0 and closing, and
 * only motion changes the position of a ball. CAROM_WORLD_POOLTOOL: the rules of pooltool, with its
 * spacers of 1 um, its order of simultaneous events, and its exchange between balls that stay in
 * touch. The histories of shots are the same as in pooltool. */
typedef enum carom_world {
  CAROM_WORLD_CAROM = 0,   /* the rules of carom */
  CAROM_WORLD_POOLTOOL = 1 /* the rules of pooltool, with its histories */
} carom_world;

/* The collision of two balls. DEFAULT is EXACT with carom's rules, INELASTIC with pooltool's. */
typedef enum carom_ball_model {
  CAROM_BALL_MODEL_DEFAULT = 0,   /* EXACT with carom's rules, INELASTIC with pooltool's */
  CAROM_BALL_MODEL_EXACT = 1,     /* carom_collide(): the exact limit of the 2014 model */
  CAROM_BALL_MODEL_EULER = 2,     /* carom_collide() in `steps` steps; with pooltool's slip if the
                                     rules are pooltool's */
  CAROM_BALL_MODEL_INELASTIC = 3, /* one closed-form impulse, as pooltool's default; for equal
                                     masses */
  CAROM_BALL_MODEL_MIRROR = 4     /* no friction: only the normal velocities change, by the
                                     restitution */
} carom_ball_model;

/* Friction between two balls: ALCIATORE depends on their speed of slip, by Alciatore's law or the
 * law of the balls; CONSTANT is mu_ball of the balls. */
typedef enum carom_ball_friction {
  CAROM_FRICTION_ALCIATORE = 0, /* falls with the speed of slip, by Alciatore's law or the law of
                                   the balls */
  CAROM_FRICTION_CONSTANT = 1   /* mu_ball of the balls, at every speed */
} carom_ball_friction;

/* Whether balls can leave the cloth. With 3D, a shot in which no ball leaves the cloth has the same
 * bits and the same speed as with FLAT: two balls on the cloth collide by the 2014 model, and a
 * ball on the cloth meets a cushion by the flat model. A ball that flies has the contacts of
 * spheres in space. Balls of different radii, and balls less than 1 mm above the
 * cloth, follow a law between the two (docs/using/shots.md), which changes continuously with radius
 * and height. With pooltool's rules the space is always flat. */
typedef enum carom_space {
  CAROM_SPACE_3D = 0,  /* elevated cues make balls hop; balls jump, fall on each other and on
                          rails, and leave the table */
  CAROM_SPACE_FLAT = 1 /* balls stay on the cloth, even if something pushes them up or down */
} carom_space;

/* The impact of a ball on a cushion, with the models of carom_cushion_model. With pooltool's rules,
 * DEFAULT is STRONGE. With carom's rules it is SMOOTH for a ball whose smooth_q is above 0, such as
 * the balls of carom's games, and otherwise HAN. HAN predicts recorded shots as well as MATHAVAN,
 * the exact limit, at a tenth of the cost or less (docs/understanding/reality.md). These values
 * differ from carom_cushion_model, in which 0 is a model. Compilers warn if the two are mixed
 * (-Wenum-conversion, which -Wextra of gcc turns on). */
typedef enum carom_shot_cushion {
  CAROM_SHOT_CUSHION_DEFAULT = 0,  /* STRONGE with pooltool's rules; with carom's rules SMOOTH for
                                      balls with smooth_q above 0, and otherwise HAN */
  CAROM_SHOT_CUSHION_MATHAVAN = 1, /* CAROM_CUSHION_MATHAVAN */
  CAROM_SHOT_CUSHION_STRONGE = 2,  /* CAROM_CUSHION_STRONGE */
  CAROM_SHOT_CUSHION_HAN = 3,      /* CAROM_CUSHION_HAN */
  CAROM_SHOT_CUSHION_MIRROR = 4,   /* CAROM_CUSHION_MIRROR */
  CAROM_SHOT_CUSHION_EULER = 5,    /* CAROM_CUSHION_EULER */
  CAROM_SHOT_CUSHION_SMOOTH = 6    /* CAROM_CUSHION_SMOOTH */
} carom_shot_cushion;

/* Writes the constants of a game's balls that belong to a model of the cushion, and returns 1. If
 * the game has no constants for the model, writes the same as carom_ball_kind_of() and returns 0.
 * Pooltool's games have one set of constants for all models. If kind is NULL, nothing is
 * written. */
CAROM_API int carom_ball_kind_for(carom_game game, carom_shot_cushion cushion,
                                  carom_ball_kind *kind);

/* Conditions of a pool table, for players who do not measure theirs with carom_calibrate().
 * docs/reference/constants.md has the sources. */
typedef enum carom_condition {
  CAROM_CONDITION_SLOW_CLOTH = 0,     /* a napped or dirty cloth */
  CAROM_CONDITION_MEDIUM_CLOTH = 1,   /* the cloth of CAROM_GAME_POOL */
  CAROM_CONDITION_FAST_CLOTH = 2,     /* a new cloth without nap */
  CAROM_CONDITION_OLD_CUSHION = 3,    /* slower cushions; soft banks return shorter */
  CAROM_CONDITION_NEW_CUSHION = 4,    /* faster cushions; soft banks return longer */
  CAROM_CONDITION_HUMID_CUSHION = 5,  /* cushions in humid air; banks return shorter */
  CAROM_CONDITION_LIVELY_CUSHION = 6, /* as the rail test of equipment asks: 4 1/2 lengths */
  CAROM_CONDITION_DEAD_CUSHION = 7    /* half of a rolling ball's speed is left, straight on */
} carom_condition;

/* Sets the constants of a ball for a condition, and returns 1: a cloth changes mu_roll; a cushion
 * changes restitution_cushion and mu_cushion, with values for the default model of pool. Returns 0
 * and changes nothing for a value not listed, or if kind is NULL. */
CAROM_API int carom_condition_give(carom_condition condition, carom_ball_kind *kind);

/* Contacts of several balls at one instant. CLUSTER: they last and overlap in time, as in
 * carom_cluster(). The ball models EXACT and MIRROR support this; MIRROR has no friction. PAIRS:
 * they are resolved one after the other, the fastest first. Pooltool's rules and the other ball
 * models always use PAIRS. */
typedef enum carom_simultaneous {
  CAROM_SIMULTANEOUS_CLUSTER = 0, /* contacts last and overlap in time, as in carom_cluster() */
  CAROM_SIMULTANEOUS_PAIRS = 1    /* contacts are resolved one after the other, the fastest first */
} carom_simultaneous;

/* All zero means the defaults. */
typedef struct carom_shot_options {
  carom_world world;                /* the rules of contact. */
  carom_ball_model ball_model;      /* the collision of two balls. */
  carom_shot_cushion cushion_model; /* the impact of a ball on a cushion. */
  carom_ball_friction friction;     /* the friction between two balls. */
  int32_t steps;                    /* for Euler's models; 0: 1000. */
  int32_t events_most;              /* largest number of events of a shot; the events of one cluster
                                       stay together. 0: 10000. */
  int32_t threads;                  /* largest number of threads of a batch, including the calling
                                       one; 0: only the calling one; CAROM_ALL_THREADS. */
  carom_space space;                /* whether balls can leave the cloth. */
  double time_most;                 /* s: the shot is stopped at exactly this time on its clock,
                                       after the events of that instant, with CAROM_STOPPED_AT_TIME.
                                       0: it is not stopped, but ends after 1000 s with
                                       CAROM_ERROR_TOO_LONG. */
  uint64_t stop_at;                 /* the shot is stopped right after an event of this set, or
                                       after its cluster, with CAROM_STOPPED_AT_EVENT. The set is
                                       CAROM_STOP_AT(type) of a carom_event_type,
                                       CAROM_STOP_AT_CONTACT, or several joined by |. 0: it is not
                                       stopped. */
  int32_t fast;                     /* 1: impacts by the cushion model MATHAVAN are computed with
                                       the instruction set in use, and have its bits. Other shots
                                       do not change. 0: the bits are the same on all machines. */
  carom_simultaneous simultaneous;  /* contacts of several balls at one instant. */
  int32_t cluster_steps;            /* steps of the integrator of clusters for the duration of a
                                       contact, at most 10000; 0: 25. */
  int32_t unused;                   /* must be 0. */
  uint64_t first_of;                /* the shot is stopped right after the first contact of the cue
                                       ball with another ball, with CAROM_STOPPED_AT_EVENT, unless
                                       that ball is in this set: bit k is ball k of the layout. 0:
                                       it is not stopped. Only the bit of the cue ball: it is
                                       stopped at any ball. */
  uint64_t reserved[1];             /* must be 0. */
} carom_shot_options;

/* Writes the sources of the models that shots with these options use, as BibTeX, with carom itself
 * first; options NULL: the defaults. Writes at most `room` bytes to text[], with a closing 0 if
 * room is above 0; text may be NULL if room is 0. Returns the length of the complete text without
 * the 0, or 0 if carom_shoot() rejects the options. */
CAROM_API size_t carom_cite(const carom_shot_options *options, char *text, size_t room);

/* ---- What happened --------------------------------------------------------------------------- */

/* What happened, and what `a` and `b` of the event are. */
typedef enum carom_event_type {
  CAROM_EVENT_STRIKE = 1,              /* the cue and ball a */
  CAROM_EVENT_BALL_BALL = 2,           /* balls a and b */
  CAROM_EVENT_RAIL = 3,                /* ball a and rail b */
  CAROM_EVENT_JAW = 4,                 /* ball a and jaw b */
  CAROM_EVENT_POCKET = 5,              /* ball a and pocket b */
  CAROM_EVENT_SLIDING_ROLLING = 6,     /* ball a slid, and rolls now */
  CAROM_EVENT_ROLLING_SPINNING = 7,    /* ball a rolled, and turns on the spot now */
  CAROM_EVENT_ROLLING_STATIONARY = 8,  /* ball a rolled, and rests now */
  CAROM_EVENT_SPINNING_STATIONARY = 9, /* ball a turned on the spot, and rests now */
  CAROM_EVENT_SLATE = 10,              /* airborne ball a lands on the slate */
  CAROM_EVENT_RAIL_TOP = 11,           /* airborne ball a falls on the top of rail b, or of jaw b
                                          minus the number of rails */
  CAROM_EVENT_LEFT_TABLE = 12          /* airborne ball a leaves the table: it falls or flies off
                                          it, or stops on a rail. The shot continues. */
} carom_event_type;

/* One event. before[1] and after[1] are the states of ball b of a CAROM_EVENT_BALL_BALL, and
 * otherwise all zero. Each contact of a cluster is an event; the events are in the order in which
 * the balls touched. A ball changes its state at its first event of the cluster. At its other
 * events it has its final state before and after. Momentum and energy therefore balance over all
 * events of a cluster, but not over a single one. A ball may start from another position than the
 * one that it reached, and overlap a ball that it leaves: docs/understanding/clusters.md,
 * Places. */
typedef struct carom_event {
  double time;                          /* when it happened, s. */
  int32_t type, a, b;                   /* a carom_event_type, and the indices of what it names. */
  int32_t cluster;                      /* the number of events of its cluster: contacts of balls,
                                           and in a push the strike and a cushion; 0: it is none. */
  double impulse;                       /* N s, for sounds: the magnitude of the impulse that ball a
                                           received from the cue, ball, cushion or slate; in a
                                           cluster only from ball b. 0 for every other event. */
  carom_ball_state before[2], after[2]; /* the states of balls a and b just before the event and
                                           just after it. */
} carom_event;

/* An event without states, with the size of three doubles. */
typedef struct carom_brief_event {
  double time;                  /* when it happened, s. */
  int32_t type, a, b, reserved; /* a carom_event_type, and the indices of what it names; reserved is
                                   0. */
} carom_brief_event;

/* For options.stop_at: the events of a type, */
#define CAROM_STOP_AT(type) (UINT64_C(1) << (type))
/* and a contact of the cue ball (the ball that the cue strikes, or ball 0 without a cue) with
 * another ball. */
#define CAROM_STOP_AT_CONTACT UINT64_C(1)

/* Everything that is needed to continue a stopped shot, with its count, time and facts, but without
 * its events; see carom_shot_continue(). The bytes may be copied, kept in a file and read by a
 * library of the same version and physics revision, which rejects them if a byte has changed. They
 * depend only on the arguments of the calls, and are 0 where they hold nothing. */
typedef struct carom_shot_state {
  uint64_t opaque[4096]; /* for the library alone. */
} carom_shot_state;

/* How the cue ball reached the first ball that it met. Only rails count, not jaws, nor the cuts of
 * pockets, nor a rail that a ball touches when the shot begins. */
typedef enum carom_approach {
  CAROM_APPROACH_DIRECT = 0,     /* The cue ball met no rail before, or no ball at all. */
  CAROM_APPROACH_RAIL_FIRST = 1, /* The cue ball met one rail, next to the ball: between the two
                                    there is no room for the cue ball. */
  CAROM_APPROACH_KICK = 2        /* The cue ball met other rails, or several. */
} carom_approach;

/* What happened in a shot, for rules of games. The library fills it in while it plays the shot, so
 * no event has to be kept. If something did not happen, its index is -1 and its time is infinite.
 * The cue ball is the ball that the cue strikes, or ball 0 without a cue. A cushion is a rail or a
 * jaw. Bit k of a set is ball k. */
typedef struct carom_facts {
  int32_t first[2];                     /* the first two different balls that the cue ball met. */
  int32_t cushions_before[2];           /* impacts of the cue ball on cushions before it met each
                                           ball of first[]; 0 where it met none. */
  double first_time[2];                 /* when the cue ball met the balls of first[], s. */
  int32_t cushions_after;               /* impacts of all balls on cushions after the first contact.
                                           If a ball touches a cushion, within CAROM_RULES_TOUCH,
                                           when the shot begins, its impacts on it do not count
                                           until it has left the cushion. */
  uint32_t down;                        /* the set of the balls that fell into a pocket in this
                                           shot. */
  uint32_t off;                         /* the set of the balls that left the table in this shot. */
  uint32_t moved;                       /* the set of the balls that were struck or met by another
                                           ball. */
  int32_t pocket[CAROM_BALLS_MOST];     /* the pocket into which each ball fell in this shot. */
  double pocket_time[CAROM_BALLS_MOST]; /* when each ball fell into its pocket, s. */
  int32_t cushions[CAROM_BALLS_MOST];   /* impacts of each ball on cushions. */
  uint32_t frozen;                      /* the set of the balls that touched the cue ball, within
                                           CAROM_RULES_TOUCH, when it was struck. */
  uint32_t pushed;                      /* the set of the balls that the cue ball met before the tip
                                           left it: while the tip pushed it, or while the tip
                                           touched it again within the push. */
  int32_t touches;                      /* how often the tip touched the cue ball: 0 without a
                                           strike, 1, or 2 and more in a double hit. A second touch
                                           occurs within the push, or later because of
                                           cue.follow. */
  uint32_t banked;                      /* the set of the balls that fell after they met a rail, as
                                           in rails[], that does not end at the pocket. */
  double second_time;                   /* time of the second touch of the tip, s; infinite if there
                                           was none; 0: within the push. */
  double second_speed;                  /* the closing speed of the tip at its second touch, m/s; 0
                                           if there was none. */
  double second_place[2];               /* the position of the cue ball at the second touch of the
                                           tip, m; 0 if there was none. */
  uint32_t first_set;                   /* the set of the balls that the cue ball met first, at one
                                           instant: the first one and those met within
                                           CAROM_RULES_INSTANT after it. */
  uint32_t barred;                      /* the set of the balls that may not be met first because of
                                           their positions. A referee sets it; a shot leaves it
                                           0. */
  uint32_t jumped;                      /* the set of the balls that the cue ball flew over before
                                           it met a ball: its centre passed theirs, and the balls
                                           overlap seen from above. */
  uint32_t beyond_middle;               /* the set of the balls that were wholly on the side of y =
                                           length of the line y = length/2, by their positions at
                                           their events; see also past_middle. */
  int32_t order[CAROM_BALLS_MOST];      /* the different balls that the cue ball met, in their
                                           order, followed by -1. */
  double first_place[2];                /* m: the position of the cue ball when it met the first
                                           ball; 0 if it met none. */
  double first_low[2];                  /* m: the least x and y of the cue ball at its strike and at
                                           its events up to the first contact. */
  double first_high[2];                 /* m: the greatest x and y of the cue ball at its strike and
                                           at its events up to the first contact. */
  uint32_t past_middle;                 /* the set of the balls that were wholly on the side of y =
                                           0 of the line y = length/2, by their positions at their
                                           events. */
  uint32_t at_head;                     /* the set of the balls that touched the head string, y =
                                           length/4, or were on its side of y = 0, by their
                                           positions at their events. */
  int32_t approach;                     /* a carom_approach: what the cue ball met before its first
                                           ball. */
  uint32_t rails[CAROM_BALLS_MOST];     /* the set of the rails that each ball met, as in approach:
                                           bit k is rail k. */
  int32_t reserved;                     /* 0. */
} carom_facts;

/* m: for the rules, balls and cushions that are nearer than this touch. This is a convention: about
 * the smallest gap that an eye of normal acuity (1 minute of arc) sees at 0.3 m. */
#define CAROM_RULES_TOUCH 0.0001

/* s: for the rules, contacts of the cue ball that are not further apart happen at one instant. This
 * is a convention: a ball of 10 m/s moves by 0.01 mm in this time. */
#define CAROM_RULES_INSTANT 0.000001

/* The result of a shot. The caller sets the members that it wants; with all zero, the shot returns
 * only count and time. */
typedef struct carom_shot {
  carom_event *events;      /* receives the first `room` events in the order in which they happened;
                               may be NULL. */
  carom_brief_event *brief; /* receives the events of events[] without states; may be NULL. */
  int64_t room;             /* number of elements of events[], of brief[], or of each of them. 0 if
                               both are NULL. */
  int64_t count;            /* events that happened, also beyond room. */
  carom_ball_state *final;  /* the states at the end, one for each ball; may be NULL. */
  double time;              /* s: the time up to which the shot was followed. This is time_most if
                               the shot was stopped there, and otherwise the time of the last event,
                               or the time at which a ball left the table. If events_most ended the
                               shot while balls with drag rolled, it is the time up to which they
                               were followed. If the shot ended while balls moved, carom_shot_at()
                               has no later state. */
  carom_shot_state *state;  /* the state in which the shot stopped, for carom_shot_continue(); may
                               be NULL. */
  carom_facts *facts;       /* the facts of the shot from its beginning, also after
                               carom_shot_continue(); may be NULL. */
  double slope_x, slope_y;  /* written: the slope of the table, for carom_shot_at() and similar
                               functions. */
  uint64_t reserved[1];     /* not read or written yet. */
} carom_shot;

/* One contact of a cluster. */
typedef struct carom_cluster_contact {
  int32_t a, b;       /* indices of its balls, a < b. */
  double touched;     /* s: time of the first touch, on the internal clock of the cluster, which
                         begins at 0. */
  double impulse;     /* N s: along the normal, on ball b away from a; the opposite on a. */
  double normal[3];   /* unit vector from ball a to ball b where they touched. */
  double friction[3]; /* N s: impulse of ball b's friction on ball a; the opposite on b. */
} carom_cluster_contact;

/* Contacts that last: resolves together all balls that touch at one instant, in the limit of stiff
 * contacts. Positions do not change. Each contact has Hertz's force with restitution e and
 * Coulomb's friction, for which mu falls with the greatest slip so far. Balls on the cloth also
 * have the friction of the cloth. Balls that are near, but not yet in contact, are included if a
 * ball reaches them while a contact lasts (0.2 to 0.6 ms in reality).
 * docs/understanding/clusters.md has the equations, their limits and their consequences. A single
 * contact follows the law of carom_collide(), within 4e-4 of the closing speed.
 *
 * Two balls touch if they are less than 1e-9 m apart. Unless opt->space is FLAT, a contact is in
 * space if one of its balls is CAROM_BALL_AIRBORNE, and between the two laws if its balls are less
 * than 1 mm above the cloth or have different radii, as in a shot. The slate is not involved. Balls
 * out of play are ignored. The call reads these members of `opt`, which may be NULL for the
 * defaults: ball_model, which may be EXACT or MIRROR, friction, space, cluster_steps. A restitution
 * below 0.2 is raised to 0.2.
 *
 * out[] receives `count` motions. contacts[] receives the first `room` contacts that had an
 * impulse, in the order in which they touched; *contacts_count becomes the number of all of them,
 * and contacts_count may be NULL. Returns CAROM_OK; CAROM_SEPARATING, with the motion before, if no
 * balls touch and close at 1 mm/s or faster; CAROM_ERROR_UNRESOLVED if the cluster needs more than
 * 20,000 steps, which only long rows of balls with a small restitution do, or if there is no room
 * for the contacts of balls of very different sizes; or an error of a field. With an error *out is
 * all NaN (untouched when a pointer is NULL). About 80 us for a full rack, 6 us for three balls. */
CAROM_API carom_status carom_cluster(const carom_shot_ball *balls, int count,
                                     const carom_shot_options *opt, carom_motion *out,
                                     carom_cluster_contact *contacts, int room,
                                     int *contacts_count);

/* Plays a shot until nothing moves, with 1 to CAROM_BALLS_MOST balls. There is no strike if a ball
 * already moves, if cue is NULL, or if its speed is 0. `opt` may be NULL for the defaults. Returns
 * CAROM_OK; CAROM_STOPPED_AT_TIME or CAROM_STOPPED_AT_EVENT if the options request it;
 * CAROM_ERROR_TOO_MANY_EVENTS or CAROM_ERROR_TOO_LONG if a bound ended the shot; or an error of a
 * field, with count 0 and nothing else written (carom_shot_check() returns the field). It returns
 * CAROM_ERROR_LEFT_TABLE if a ball on the cloth found a hole between the cushions, or the error of
 * a collision, with everything up to that event. The final states are those at shot->time. */
CAROM_API carom_status carom_shoot(const carom_table *table, const carom_shot_ball *balls,
                                   int count, const carom_cue *cue, const carom_shot_options *opt,
                                   carom_shot *shot);

/* Continues a shot that its options or a bound stopped. Every event and state has the bits of the
 * uninterrupted shot, however often it is stopped. Table and balls are the same as in the call that
 * stopped, in which shot->state was set. The options have the same models, and may set a new time
 * or event to stop. `shot` may be another struct with a copy of the state: count, time and facts so
 * far always come from the state. The caller keeps the events: shot->events and shot->brief are
 * NULL, or contain all events so far with any room for more, or contain as many as fitted with the
 * same room. A shot in which all balls rest does not change, and the call returns CAROM_OK. With
 * table, balls, cue, shot and moved of the sample above:
 *
 *     static carom_shot_state state;
 *     static carom_shot_options options;                                 // all zero: the defaults
 *     options.time_most = 1.0 / 60.0;
 *     shot.state = &state;
 *     shot.final = moved;
 *     status = carom_shoot(&table, balls, 10, &cue, &options, &shot);
 *     // moved[] are the states of the frame before
 *     for (int frame = 2; status == CAROM_STOPPED_AT_TIME; frame++) {
 *       options.time_most = frame / 60.0;
 *       status = carom_shot_continue(&table, balls, 10, &options, &shot);
 *     }
 *
 * Returns the status of carom_shoot(), or one of these errors with nothing written.
 * CAROM_ERROR_STATE: shot->state is damaged or from another build, the shot ended in an error other
 * than a bound, or shot->count or shot->time is invalid. CAROM_ERROR_STATE_TABLE,
 * CAROM_ERROR_STATE_BALLS, CAROM_ERROR_STATE_OPTIONS: the table, the balls or their layout, or the
 * options other than the stopping options, differ from the call that stopped.
 * CAROM_ERROR_EVENTS_LOST: shot->events or shot->brief do not contain the events so far.
 * CAROM_ERROR_TIME_MOST: time_most is before the time at which the shot stopped. */
CAROM_API carom_status carom_shot_continue(const carom_table *table, const carom_shot_ball *balls,
                                           int count, const carom_shot_options *opt,
                                           carom_shot *shot);

/* The states of all balls at a time. The call evaluates the motion of each ball after its last
 * event. After the end of a shot in which nothing moves any more, the states are those at the end.
 * Returns CAROM_OK, or one of these errors with nothing written: CAROM_ERROR_NULL;
 * CAROM_ERROR_ROOM; CAROM_ERROR_BALLS; CAROM_ERROR_EVENTS_LOST if shot->room was too small for the
 * events that are needed; CAROM_ERROR_TIME if the time is below 0 or not a number, or if it is
 * after shot->time and balls still move then because a bound or an error ended the shot.
 * CAROM_ERROR_UNRESOLVED, with some states written, means that an event or a ball was damaged: its
 * motion is not finite, or needs more steps than any shot does. */
CAROM_API carom_status carom_shot_at(const carom_shot_ball *balls, int count,
                                     const carom_shot *shot, double time, carom_ball_state *states);

/* The same for drawing: a pocketed ball falls freely from the edge, along the wall of its pocket.
 * Balls that meet in a pocket push each other aside. A ball stops at the depth of the pocket or on
 * others, 0.7 s after its fall began at the latest, and stays there, also after the end of the
 * shot. Its label is CAROM_BALL_POCKETED. The call needs events with states, because brief events
 * do not say where a fall begins. CAROM_ERROR_NULL without a table. */
CAROM_API carom_status carom_shot_drawn(const carom_table *table, const carom_shot_ball *balls,
                                        int count, const carom_shot *shot, const double *times,
                                        size_t n, carom_ball_state *states);

/* Computes only the falls, for states of carom_shot_frames() at the same times: replaces the states
 * of pocketed balls. The errors are the same as for carom_shot_drawn(). */
CAROM_API carom_status carom_shot_falls(const carom_table *table, const carom_shot_ball *balls,
                                        int count, const carom_shot *shot, const double *times,
                                        size_t n, carom_ball_state *states);

/* The slip between the surfaces of ball a and of what it meets at the event, m/s. Together with
 * event->impulse it determines how a contact sounds. It is computed from the motion before the
 * event, or before the cluster. 0 for the strike, for pockets and for events without a contact; NaN
 * if a pointer is NULL, or if there is no such ball or part. */
CAROM_API double carom_event_slip(const carom_table *table, const carom_shot_ball *balls, int count,
                                  const carom_event *event);

/* Many shots on one table. Shot k has the `count` balls from balls[k * ball_stride] on, and the cue
 * cues[k * cue_stride]. Instead of `balls`, with 328 bytes per ball, a job may have `kinds` for all
 * shots and `states`, with 80 bytes per ball: shot k then has kinds[0 ... count - 1] with the
 * states from states[k * ball_stride] on. The bits are the same. With table, balls and cue of the
 * sample above:
 *
 *     static carom_cue cues[100];
 *     static carom_shot shots[100];
 *     for (int k = 0; k < 100; k++) {
 *       cues[k] = cue;
 *       cues[k].phi = 85.0 + 0.1 * k;
 *     }
 *     static carom_shot_job job;
 *     job.table = &table;
 *     job.balls = balls;     // one layout for all,
 *     job.count = 10;
 *     job.cues = cues;       // a cue for each
 *     job.cue_stride = 1;
 *     job.n = 100;
 *     job.shots = shots;
 *     status = carom_shoot_batch(&job); */
typedef struct carom_shot_job {
  const carom_table *table;          /* the table of all shots. */
  const carom_shot_ball *balls;      /* the layouts; NULL: kinds and states define them. */
  const carom_cue *cues;             /* NULL: no strikes. */
  int64_t count;                     /* number of balls of a shot. */
  uint64_t ball_stride;              /* distance from the layout of a shot to the layout of the
                                        next, in balls or states, usually `count`; 0: all shots use
                                        the first. */
  uint64_t cue_stride;               /* distance from the cue of a shot to the cue of the next, in
                                        cues, usually 1; 0: all shots use the first. */
  uint64_t n;                        /* shots. */
  const carom_shot_options *options; /* NULL: the defaults. `threads` is read here only. */
  carom_shot *shots;                 /* n results, in which the caller has set the members to fill,
                                        as for carom_shoot(). */
  int8_t *status;                    /* n statuses; may be NULL. */
  const carom_ball_kind *kinds;      /* `count` kinds, for the balls of all shots, if `balls` is
                                        NULL. */
  const carom_ball_state *states;    /* the layouts as states, if `balls` is NULL. */
  uint64_t reserved[2];              /* must be 0. */
} carom_shot_job;

/* Plays all shots of a job. Each shot has the bits and the status of carom_shoot(), and a bad shot
 * does not change the others: each layout has its own balls and radius and is checked with them (a
 * layout that successive shots share is checked once), and balls that are too small or too large
 * for the noses of the table invalidate only their own shot. Returns CAROM_OK or the status of the
 * first shot in error. If the call itself is wrong (NULL, an invalid option, an invalid count, a
 * part of the table that is invalid for every radius), it returns that error and writes nothing.
 * CAROM_ERROR_NULL: the job has neither balls nor both kinds and states; CAROM_ERROR_SHOT_OPTIONS:
 * it has balls and also kinds or states. With n = 0 nothing else is read. */
CAROM_API carom_status carom_shoot_batch(const carom_shot_job *job);

/* Checks the arguments of carom_shoot() and plays nothing. *where becomes the index of the ball,
 * rail, jaw or pocket at fault, or -1; where may be NULL. CAROM_ERROR_OFF_TABLE means that a ball
 * is in a cushion by more than 1e-6 m; or that its centre is behind one, outside the ring of rails,
 * jaws and pockets; or that its centre is in a pocket and its label is not CAROM_BALL_POCKETED. A
 * position is outside if no ball of that radius can roll to it from the middle of the table
 * (width/2, length/2). On a table that carom_table_check() rejects as open, the check may accept a
 * position outside. An airborne ball may be over a pocket or over the top of a rail. It must not be
 * in a nose, below a top, or lower than the cloth. */
CAROM_API carom_status carom_shot_check(const carom_table *table, const carom_shot_ball *balls,
                                        int count, const carom_cue *cue,
                                        const carom_shot_options *opt, int *where);

/* Ball in hand: puts balls[ball] at rest at (x, y) if no other ball, cushion or pocket is in the
 * way, within the bounds of carom_shot_check(). The other balls need not be at rest. The ball keeps
 * its kind; it may have been out of play. Returns CAROM_OK; CAROM_ERROR_OVERLAP if another ball is
 * in the way; or CAROM_ERROR_OFF_TABLE if the position is in a cushion or a pocket, or outside the
 * ring. With these two errors *in_the_way is that ball or part (CAROM_PART_NONE: outside), and
 * nothing moves. Other errors are an error of the table or of the ball's radius,
 * CAROM_ERROR_POSITION, and CAROM_ERROR_BALLS for an invalid count or index. `in_the_way` may be
 * NULL. */
CAROM_API carom_status carom_place_ball(const carom_table *table, carom_shot_ball *balls, int count,
                                        int ball, double x, double y, carom_part *in_the_way);

/* The progress of carom_shot_frames(), in the caller's memory; all zero before the first call. It
 * is valid in one process only, so do not keep it in files. */
typedef struct carom_frames {
  uint64_t opaque[15400]; /* for the library alone. */
} carom_frames;

/* Frames: the states of all balls at `n` times, and how each ball has turned since the start of the
 * shot, for times[k] from states[k * count] and turned[k * count] on. One of states and turned may
 * be NULL. States have the bits of carom_shot_at(). turned[] receives unit quaternions (w, x, y,
 * z), which turn the marks on a ball from the start to the time. They depend only on the events,
 * not on earlier calls. They are exact except for rounding while the axis of the spin keeps its
 * direction (in flight, on the spot, rolling without side spin, in straight slides), and otherwise
 * within 1e-7 rad for each phase of the ball. Times in ascending order take about 20 ns per ball
 * for states, and 0.1 us for each radian that balls with side spin turn; if a time is before the
 * preceding one, a call without `onward` starts again from the first event. With `onward`, a call
 * continues from the last time of the previous call, if the balls and the events until then are the
 * same, as they are after carom_shot_continue(). For an earlier time it continues from one of about
 * 100 times of the shot that `onward` keeps, so that a film may run backwards; otherwise it starts
 * from the first event. The bits are the same. `onward` may be NULL. A frame of the 16 balls of a
 * break takes 2 us. Returns the status of carom_shot_at() for the first time in error; the frames
 * before it have been written. CAROM_ERROR_NULL if states and turned are both NULL;
 * CAROM_ERROR_UNRESOLVED also if balls turn by more than 5,000,000 rad.
 *
 *     static carom_frames film;
 *     double turned[10][4];
 *     for (double time = 0.0; time < shot.time; time += 1.0 / 60.0)
 *       carom_shot_frames(balls, 10, &shot, &time, 1, &film, moved, turned);
 */
CAROM_API carom_status carom_shot_frames(const carom_shot_ball *balls, int count,
                                         const carom_shot *shot, const double *times, size_t n,
                                         carom_frames *onward, carom_ball_state *states,
                                         double (*turned)[4]);

/* ==== What there is ============================================================================
 *
 * Names, ranges and descriptions of numbers and of named values, for programs whose users enter
 * them. The command and the packages of other languages also use them. */

/* What reads a number. */
typedef enum carom_reader {
  CAROM_READ_ALWAYS = 0,      /* every call */
  CAROM_READ_BY_CUSHION = 1,  /* a carom_cushion_model */
  CAROM_READ_BY_FRICTION = 2, /* a carom_ball_friction */
  CAROM_READ_TO_STOP = 3,     /* a stopping option */
  CAROM_READ_TO_COMPUTE = 4   /* an option of the computation */
} carom_reader;

/* Types of members. */
typedef enum carom_type {
  CAROM_TYPE_DOUBLE = 0, /* a double */
  CAROM_TYPE_INT32 = 1,  /* an int32_t */
  CAROM_TYPE_INT64 = 2,  /* an int64_t */
  CAROM_TYPE_UINT64 = 3  /* a set, whose bit k is value k of `words`, or ball k; or a seed, any
                            value */
} carom_type;

/* A number of a struct. Its value may be from low to high, including both, or `other`. Later
 * versions add members at the end. */
typedef struct carom_number {
  const char *name;       /* of the member. */
  const char *key;        /* its key in files of `carom shoot`, or for options the option of the
                             command; "": none. */
  const char *unit;       /* the unit; "" without one. */
  const char *text;       /* a short description. */
  double low, high;       /* the range. */
  double other;           /* an allowed value outside the range: 0, for a default, or -1; NaN:
                             none. */
  int32_t offset;         /* the offset of the member in its struct, bytes. */
  int32_t cushion_offset; /* the offset of a number of a ball in carom_cushion_options, bytes; -1:
                             it is not there. */
  carom_status error;     /* the error for a value that is not allowed. */
  carom_reader reader;    /* what reads it. */
  int32_t model;          /* which model or law of the reader reads it. */
  carom_type type;        /* the type of the member. */
  int32_t words;          /* a carom_words if its values have names, otherwise -1. */
  int32_t count;          /* the number of elements of an array; otherwise 1. */
} carom_number;

/* Number k of a part, in the order of its struct; options are in the order of their rows. NULL
 * beyond the last number, and for a part without numbers. */
CAROM_API const carom_number *carom_number_of(carom_part_kind part, int k);

/* Writes the allowed values of a number, such as "0, or 1e6 to 1e15, in Pa" or "3d or flat", to
 * text[], at most `room` bytes with a closing 0. Returns the length of the complete text without
 * the 0. */
CAROM_API size_t carom_number_range(const carom_number *number, char *text, size_t room);

/* Returns the first invalid number of a ball, and writes its allowed values to text[room], as
 * above. Returns NULL if all numbers are valid. */
CAROM_API const carom_number *carom_ball_fault(const carom_ball_kind *kind, char *text,
                                               size_t room);

/* What carom_shot_check() rejects. */
typedef struct carom_fault {
  carom_status status;     /* CAROM_OK: nothing. */
  carom_part part;         /* what is at fault; for balls CAROM_PART_BALL or CAROM_PART_STATE. */
  int32_t element;         /* index of the element of an array; -1: the complete array. */
  const carom_number *row; /* the invalid number of the part; NULL: no single number. */
  double value;            /* the value of that number. */
} carom_fault;

/* carom_shot_check() that also reports the invalid number. Writes its allowed values to text[room],
 * as above. It writes nothing if more than the range of the number matters; the text of the status
 * then describes the error. */
CAROM_API carom_status carom_shot_fault(const carom_table *table, const carom_shot_ball *balls,
                                        int count, const carom_cue *cue,
                                        const carom_shot_options *opt, carom_fault *fault,
                                        char *text, size_t room);

/* 1 if a shot with these options reads the number of this ball, otherwise 0. options NULL: the
 * defaults. */
CAROM_API int carom_number_is_read(const carom_number *number, const carom_ball_kind *kind,
                                   const carom_shot_options *options);

/* ---- The cushion of a table, from three banks that a player observes ------------------------- */

enum { CAROM_BANKS = 3 };

/* A bank: the ball is on the line from the corner x = 0, y = 0 through a sight of the rail x =
 * width, 0.35 m from the rail x = 0, and is played along this line without english. Sights are
 * counted from the corner, 8 to the length of a table; the sights and the corner are 94 mm behind
 * the noses. The reading is the sight where the ball touches the rail x = 0 again. */
typedef struct carom_bank {
  double aim;   /* the sight */
  double speed; /* of the ball, m/s */
  double roll;  /* 1: it rolls at once; 0: it slides, hit at its centre */
} carom_bank;

/* Bank number 0, 1 or 2. CAROM_OK, CAROM_ERROR_NULL, or CAROM_ERROR_POSITION for another number. */
CAROM_API carom_status carom_bank_of(int bank, carom_bank *out);

/* The result of three readings. */
typedef struct carom_calibration {
  double restitution, friction; /* of the cushion: restitution_cushion and mu_cushion of the
                                   balls */
  double restitution_error, friction_error; /* their standard deviations; without readings 0.05 and
                                               0.06 */
  double comes_back[CAROM_BANKS]; /* where the banks return with these constants, in sights */
  double misfit; /* rms residual of the readings, divided by 25 mm; above 2: a reading or a speed is
                    wrong */
} carom_calibration;

/* Finds the constants of a table's cushion for a ball; the constants of the ball are the prior
 * estimate. `reading` are CAROM_BANKS sights, above 0 and below 8; NULL: nothing is fitted, and
 * comes_back is computed with the constants of the ball. Returns CAROM_OK, CAROM_ERROR_NULL,
 * CAROM_ERROR_POSITION for a reading out of range or if a bank does not return, or the status of
 * carom_shoot(). A call plays about 450 shots of one ball. docs/using/fit.md shows how to play the
 * banks. */
CAROM_API carom_status carom_calibrate(const carom_table *table, const carom_ball_kind *ball,
                                       const double *reading, carom_calibration *out);

/* Replaces defaults by the values that a shot uses: in `kind` the numbers of the ball, and in
 * `options` the models and the law of friction. law_a, law_b and law_c become the law of friction
 * between balls, also a constant one; the numbers smooth_*, omega_ratio, restitution_table and
 * modulus become the default values of the models that read them; and nose_height becomes the
 * height of the table's noses if all noses have the same height. A shot with the result has the
 * same bits. With table NULL, nose_height does not change; options NULL: the defaults. Returns
 * CAROM_OK, CAROM_ERROR_NULL without a kind, or an error of options or table, with nothing
 * written. */
CAROM_API carom_status carom_ball_kind_resolve(const carom_table *table,
                                               carom_shot_options *options, carom_ball_kind *kind);

/* The comparison of versions of carom_serves(). */
#ifdef CAROM_SERVED
#define carom_table_make(...) CAROM_SERVED(carom_table_make(__VA_ARGS__))
#define carom_table_measured(...) CAROM_SERVED(carom_table_measured(__VA_ARGS__))
#define carom_shoot(...) CAROM_SERVED(carom_shoot(__VA_ARGS__))
#define carom_shoot_batch(...) CAROM_SERVED(carom_shoot_batch(__VA_ARGS__))
#endif

#ifdef __cplusplus
}
#endif

#endif /* CAROM_SHOT_H */
