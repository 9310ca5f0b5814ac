/* carom_tangent.h: derivatives of collisions, of impacts on cushions and of whole shots, in up
 * to 64 directions at once.
 *
 * A direction describes how all inputs change together: numbers of the cue, constants of the balls,
 * their states, noses and cushions of the table. A tangent is the derivative of a result in a
 * direction: its change, per unit of the direction, while the events and their order stay as they
 * are. It is exact for infinitesimal changes and not valid for large ones. With table, balls, cue
 * and shot of the sample of whole shots in carom_shot.h:
 *
 *     static double seed[CAROM_CUE_NUMBERS][2];                // two directions; all else is zero:
 *     seed[0][0] = 1.0;                                        // 0: the speed of the cue, per m/s
 *     seed[1][1] = 1.0;                                        // 1: its direction phi, per degree
 *     static carom_tangent_seeds seeds;
 *     seeds.directions = 2;
 *     seeds.cue = &seed[0][0];
 *     double change[10][CAROM_STATE_NUMBERS][2], when[256][2], reach[2];
 *     static carom_tangent tangent;
 *     tangent.final = &change[0][0][0];
 *     tangent.time = &when[0][0];
 *     tangent.reach = reach;
 *     // with room for all of its events
 *     status = carom_shoot(&table, balls, 10, &cue, NULL, &shot);
 *     status = carom_shot_tangent(&table, balls, 10, &cue, NULL, &shot, &seeds, &tangent);
 *     // change[i][0][1]: by how many metres the place x of ball i moves per degree of phi,
 *     // for less than reach[1] degrees
 *
 * docs/using/derivatives.md explains the meaning and the limits of tangents, and has the equations
 * and the measured errors.
 *
 * Units are as in carom_shot.h; the angles phi and theta are in degrees. Arrays are in row order,
 * with the directions last. */
#ifndef CAROM_TANGENT_H
#define CAROM_TANGENT_H

#include "carom_shot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The largest number of directions of a call; and how many numbers a cue (speed, phi, theta, a, b,
 * mass, end_mass, tip_restitution), a state (x, y, v_x, v_y, w_x, w_y, w_z, z, v_z), the cushions
 * of a table (height of the noses, mu_cushion, restitution) and a carom_ball_kind (its fields)
 * have. The last two numbers of a state belong to flight: for a ball on the cloth, z changes as its
 * radius does, and v_z does not change, whatever their seeds are. */
enum {
  CAROM_DIRECTIONS_MOST = 64,
  CAROM_CUE_NUMBERS = 8,
  CAROM_STATE_NUMBERS = 9,
  CAROM_NOSE_NUMBERS = 3
};
#define CAROM_KIND_NUMBERS ((int)(sizeof(carom_ball_kind) / sizeof(double)))

/* What limits a tangent at an event. A sum of these, 0 for none. */
typedef enum carom_tangent_flag {
  CAROM_TANGENT_GRAZING = 1,      /* the contact closes at less than 1 % of the speed, or it is the
                                     last hop of a ball on the slate, or nearly the last.
                                     Derivatives grow without bound there. Or it is a strike whose
                                     hop appears or disappears if its speed changes by 1 %. */
  CAROM_TANGENT_SLOW = 2,         /* a slow contact, for which docs/using/shots.md has the rule. */
  CAROM_TANGENT_SIMULTANEOUS = 4, /* a ball of the contact was in another contact less than 1e-9 s
                                     before, or it is a contact at the start whose gap changes. A
                                     small change may reverse the order of the contacts, or separate
                                     them, so the derivative is valid on one side at most. */
  CAROM_TANGENT_KINK = 8,         /* the model has no derivative here, or it was not found to 1e-4.
                                     An example is the derivative with respect to theta at theta = 0
                                     if balls can leave the cloth: the call returns the upward
                                     derivative. */
  CAROM_TANGENT_EULER = 16,       /* the cushion was resolved in steps, and the derivative is the
                                     derivative of the steps, by differences. */
  CAROM_TANGENT_DIFFERENCES = 32, /* the derivative of this contact was computed by central
                                     differences of this contact only. This happens for exact models
                                     if the motion is planar or a ball jams, and for Euler's
                                     steps. */
  CAROM_TANGENT_DRAG = 64,        /* no longer set: the derivatives of a roll with drag follow the
                                     pieces in which shots compute it. */
  CAROM_TANGENT_CLUSTER = 128     /* a contact of a cluster, a further touch of the tip, or a single
                                     contact with a third ball within 1 mm. The reach does not
                                     include touches of balls that appear or disappear there, nor
                                     their order. It ends where the velocity of a ball after the
                                     contact changes by 100 %. */
} carom_tangent_flag;

/* The changes in each direction; `directions` is their number m, 1 to 64. NULL stands for zeros.
 * Numbers that a shot does not use are not read: nose heights and cushions of the table are read if
 * neither the ball nor the part sets them. */
typedef struct carom_tangent_seeds {
  int64_t directions;   /* number of directions, 1 to CAROM_DIRECTIONS_MOST. */
  const double *cue;    /* [8][m] */
  const double *kind;   /* [balls][CAROM_KIND_NUMBERS][m]; balls of the same radius must change it
                           together. */
  const double *state;  /* [balls][9][m]: states at the start. For the ball that the cue strikes,
                           only x and y are read. */
  const double *table;  /* [3][m]: numbers of all rails and jaws together */
  const double *slope;  /* [2][m]: slope_x and slope_y of the table */
  uint64_t reserved[3]; /* must be 0. */
} carom_tangent_seeds;

/* Results, per unit of the seeds. `final` is needed; each of the others may be NULL. */
typedef struct carom_tangent {
  double *final;        /* [balls][9][m]: derivatives of the states at the end of the shot. 0 for a
                           pocketed ball; for a ball that left the table, the derivatives of the
                           position where it left. */
  double *time;         /* [events][m], s: derivatives of the times of the events. */
  double *before;       /* [events][2][9][m]: derivatives of the states of the balls just before
                           each event, whose time changes too. */
  double *after;        /* [events][2][9][m]: derivatives of the states of the balls just after each
                           event, whose time changes too. 0 for the second ball of an event with one
                           ball. */
  double *at;           /* [times][balls][9][m]: derivatives of the states at fixed times. */
  const double *times;  /* [times], s: ascending, for `at`. */
  int64_t times_count;  /* number of times. */
  int32_t *flags;       /* [events]: sums of carom_tangent_flag. */
  double *reach;        /* [m], in the unit of the direction: the smallest change at which, to first
                           order, a ball meets something else, or in another order. A hit becomes a
                           miss, a miss becomes a hit, two events of a ball swap, or a spin about
                           the vertical ends before a contact instead of after it. Infinite if
                           nothing of this happens. A tangent holds for changes well below the
                           reach. Needs `time`. */
  double error;         /* written: the largest relative error of the derivatives that were found by
                           differences. */
  int64_t all_flags;    /* written: the flags of all events together. */
  uint64_t reserved[4]; /* not read or written yet. */
} carom_tangent;

/* Derivatives of a shot that carom_shoot() has played: table, balls, cue and options are the same
 * as in that call, and shot->events contains all of its events. Tangents follow each ball from
 * event to event, on the cloth and in flight. Only clusters are played again, once for each
 * direction. All events of a cluster have the flags and the time derivative of its first event, and
 * CAROM_TANGENT_CLUSTER. A touch inside a cluster that begins to stick has no flag. Nothing is
 * allocated. Stack: 69 KiB; a batch 72 KiB. Cost: docs/using/derivatives.md.
 *
 * Returns CAROM_OK. Errors, with nothing written: CAROM_ERROR_NULL; CAROM_ERROR_BALLS;
 * CAROM_ERROR_DIRECTIONS if there are not 1 to 64; CAROM_ERROR_EVENTS_LOST if shot->room was too
 * small or events is NULL; CAROM_ERROR_STATE if an event cannot be one of this shot, and for a shot
 * that was rejected or never played; CAROM_ERROR_TIME for times below 0, not finite or not
 * ascending; CAROM_ERROR_SHOT_OPTIONS for a reserved field; or an error of the table or of an
 * option. CAROM_ERROR_NO_TANGENTS from a library that was built without derivatives.
 * CAROM_ERROR_TANGENT if derivatives are not available: in CAROM_WORLD_POOLTOOL, whose spacers are
 * not differentiable, with CAROM_BALL_MODEL_EULER, and through clusters that do not match the
 * events or have more than 38 contacts. Three errors set every number of `final` to NaN, and may
 * write other results: CAROM_ERROR_TIME for a time after the end of a shot that ended while balls
 * moved, CAROM_ERROR_OVERFLOW if a number of `final` is not finite, and an error of a collision. */
CAROM_API carom_status carom_shot_tangent(const carom_table *table, const carom_shot_ball *balls,
                                          int count, const carom_cue *cue,
                                          const carom_shot_options *opt, const carom_shot *shot,
                                          const carom_tangent_seeds *seeds, carom_tangent *tangent);

/* Derivatives of all shots of a job that carom_shoot_batch() has played. */
typedef struct carom_tangent_job {
  const carom_shot_job *played;     /* the job with its shots; its options set the number of
                                       threads. */
  const carom_tangent_seeds *seeds; /* the seeds of shot k are seeds[k * seeds_stride]. */
  uint64_t seeds_stride;            /* 0: all shots use the first; otherwise usually 1. */
  carom_tangent *tangents;          /* n results. */
  int8_t *status;                   /* n statuses; may be NULL. Shots with an error in
                                       played->status are skipped and keep their status. */
  uint64_t reserved[4];             /* must be 0. */
} carom_tangent_job;

/* Each shot has the bits and the status of carom_shot_tangent(), for any number of threads. Returns
 * CAROM_OK, or the status of the first shot in error. Errors of the call are as for
 * carom_shoot_batch(), with nothing written. */
CAROM_API carom_status carom_shot_tangent_batch(const carom_tangent_job *job);

/* Derivatives of carom_collide() with the exact solver: tangent[12][m] = J seeds[26][m], in the
 * order of the doubles of carom_result and carom_impact. Only the seeds of r[0] and r[1], v[0] and
 * v[1], w, radius of a, mass, mu_slide, mu_ball and restitution are read. There is no derivative
 * with respect to the slip of a ball that rolls and is pressed into the cloth. The call assumes
 * that this ball continues to roll in every direction, and directions in which it would slide set
 * CAROM_TANGENT_KINK. A ball rolls if its slip is at most 1e-12 of its speeds. *flags (may be NULL)
 * becomes a sum of CAROM_TANGENT_KINK and CAROM_TANGENT_DIFFERENCES. Returns the status of
 * carom_collide(): after CAROM_SEPARATING the tangents are derivatives of the motion before, and
 * after an error all are NaN. Also returns CAROM_ERROR_DIRECTIONS, and CAROM_ERROR_TANGENT for
 * options other than the exact solver and the slip of the paper. */
CAROM_API carom_status carom_collide_tangent(const carom_impact *in, const carom_options *opt,
                                             int64_t directions, const double *seeds,
                                             double *tangent, int32_t *flags);

/* Derivatives of carom_cushion(): tangent[6][m] = J seeds[15][m], in the order of the doubles of
 * carom_motion and carom_cushion_impact; v[2] and jaw_radius are not read. Otherwise the call is
 * like carom_collide_tangent(). CAROM_ERROR_TANGENT for the convention of pooltool, and if Euler's
 * steps fail for a neighbouring input, which the differences need. */
CAROM_API carom_status carom_cushion_tangent(const carom_cushion_impact *in,
                                             const carom_cushion_options *opt, int64_t directions,
                                             const double *seeds, double *tangent, int32_t *flags);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_TANGENT_H */
