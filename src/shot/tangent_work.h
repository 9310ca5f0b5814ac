/* A shot on its way through its events once more, with tangents: what the parts of tangent.c share.
 *
 * At each event, at the time T where g = 0, with d the tangents at a fixed time (tangent_path.c):
 *
 *     dT = -(d_x g d + d_k g dk)/g'        dx- = d + x'- dT        dx+ = J dx-        d+ = dx+ - x'+ dT
 *
 *     two balls         closing . dT = n . (d_b - d_a) - dR_a - dR_b
 *     rail, jaw         closing . dT = -n . d - dR, n into the cushion
 *     pocket            (p . v) dT = -p . d, p from its centre
 *     slate             v_z dT = dR - d_z
 *     end of a phase    tangent_path.c
 *
 * J is that of the contact. docs/understanding/gradients.md derives this. */
#ifndef CAROM_SRC_SHOT_TANGENT_WORK_H
#define CAROM_SRC_SHOT_TANGENT_WORK_H

#include "shot/sim.h"
#include "shot/tangent_path.h"

#define CAROM_GRAZING 0.01 /* closing over relative speed, below which a contact has the flag */

/* What an event is worked on with. */
typedef struct carom_tangent_work {
  const carom_table *table;
  const carom_cue *cue;
  const carom_shot_options *opt;
  const carom_tangent_seeds *seeds;
  int count, m;
  carom_tangent_ball ball[CAROM_BALLS_MOST];
  double reference;      /* radius of the balls that the table is meant for: nose.c */
  int64_t slow_instants; /* as in carom_sim */
  double slow_last;
  carom_tangent_note note;
  /* of the event: tangents of its balls, rates, the tangent of its time */
  carom_row d[2][CAROM_STATE_NUMBERS], d_time;
  double rate[2][CAROM_STATE_NUMBERS];
} carom_tangent_work;

/* A row of the caller's seeds; 0 where there are none. */
static inline const double *carom_seeds_row(const double *rows, int row, int m) {
  return rows != NULL ? rows + row * m : NULL;
}
static inline double carom_seed(const double *row, int j) {
  return row != NULL ? row[j] : 0.0;
}

/* tangent.c: total tangents before the event, of one of its balls. */
void carom_tangent_total(carom_tangent_work *w, int side);

/* Each turns tangents at the fixed time of an event into total ones after it, and finds the tangent of its time.
 *
 * tangent_strike.c */
void carom_tangent_strike(carom_tangent_work *w, const carom_event *event);
/* tangent_contact.c: on the cloth. */
carom_status carom_tangent_balls(carom_tangent_work *w, const carom_event *event);
carom_status carom_tangent_cushion(carom_tangent_work *w, const carom_event *event);
/* tangent_space.c: where a ball flies, or radii differ. */
carom_status carom_tangent_spheres(carom_tangent_work *w, const carom_event *event);
carom_status carom_tangent_nose_in_flight(carom_tangent_work *w, const carom_event *event);
/* tangent_flight.c: the ends of flights. */
carom_status carom_tangent_fall(carom_tangent_work *w, const carom_event *event);
carom_status carom_tangent_level_strike(carom_tangent_work *w, const carom_event *event);
void carom_tangent_pocket(carom_tangent_work *w, const carom_event *event);
void carom_tangent_leave(carom_tangent_work *w, const carom_event *event);

/* ---- Parts of contacts ---- */

/* The numbers of a nose, as those of a ball in tangent.h: height, how far it is inside its wall, and the distance from the wall
 * at which a ball on the cloth touches it (nose.c); the rest from NOSE_MU_S on is written to in and din. */
typedef struct carom_tangent_nose {
  double height, shift, reach;
  carom_row d_height, d_shift, d_reach;
} carom_tangent_nose;

/* tangent_contact.c. The nose of an event, for its ball. */
void carom_tangent_nose_of(const carom_tangent_work *w, const carom_event *event, carom_tangent_nose *nose, double *in,
                           carom_row *din);

/* Friction between the balls of an event at a slip, with its tangents: models.c. */
double carom_tangent_friction(const carom_tangent_work *w, const carom_event *event, double slip, const double *d_slip,
                              double *d_mu);

#endif
