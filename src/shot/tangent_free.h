/* Impacts by their normals with tangents, in space (tangent_free.c has the equations) and on the cloth. */
#ifndef CAROM_SRC_SHOT_TANGENT_FREE_H
#define CAROM_SRC_SHOT_TANGENT_FREE_H

#include "shot/tangent_work.h"

#include <math.h>

/* The rows of a place, a velocity and a spin. */
static const int CAROM_S_R[3] = {S_X, S_Y, S_Z}, CAROM_S_V[3] = {S_V_X, S_V_Y, S_V_Z}, CAROM_S_W[3] = {S_W_X, S_W_Y, S_W_Z};

static inline double carom_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How the unit vector into what is touched lies and turns. */
typedef struct carom_normal {
  double N[3];
  carom_row dN[3];
} carom_normal;

/* A touch with motions before, and the impulses of its impact. */
typedef struct carom_free_touch {
  carom_normal at;
  double closing, u[3]; /* u: the slip, across N */
  double mu, e, ratio;  /* ratio: of Stronge's nose */
  carom_row d_closing, du[3], d_mu, d_e, d_ratio;
  double P, f[3];
  carom_row dP, df[3];
} carom_free_touch;

/* The slip of surfaces with the relative velocity v, whose spins times radii add up to spin, and what closes; then their
 * tangents in one direction, for which dN is there. */
void carom_touch_slip(carom_free_touch *t, const double v[3], const double spin[3]);
void carom_touch_slip_tangent(carom_free_touch *t, int j, const double v[3], const double spin[3], const double dv[3],
                              const double d_spin[3]);
/* The same of a ball alone, before[0] of the event or another state. */
void carom_touch_alone(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_ball_state *s, carom_free_touch *t);

/* P and f, with their tangents, by a model of a nose: HAN, STRONGE or MIRROR. */
carom_status carom_free_impulse(carom_free_touch *t, carom_cushion_model model, int m, carom_tangent_note *note);
/* N x f and its tangent. */
void carom_free_torque(const carom_free_touch *t, int j, double there[3], double d[3]);
/* Takes the impulses from a ball that is alone. */
void carom_take_free(carom_tangent_work *w, const carom_tangent_ball *ball, const carom_free_touch *t);

/* tangent_contact.c. The impact of a ball on a cushion by the flat model of the shot, without the rule of slow contacts.
 * v, spin: the motion after it, of which v_z is not written; d: the tangents of v_x, v_y and the spin.
 * into: along the normal, whose part across the table counts. rolls: as in carom_tangent_to_frame().
 * in, din: the numbers of the nose; this function writes those of the ball. */
carom_status carom_tangent_flat_nose(carom_tangent_work *w, const carom_event *event, const carom_normal *into, bool rolls,
                                     double height, double *in, carom_row *din, double v[3], double spin[3], carom_row d[5]);

/* tangent_slow.c. The rule of slow contacts, for one ball at a nose or two balls. v, spin: motions before, whose tangents are
 * in w->d. */
void carom_tangent_part(carom_tangent_work *w, const carom_event *event, int bodies, const carom_normal *at, bool in_space,
                        const double (*v)[3], const double (*spin)[3]);
/* The same of the two balls of an event. */
void carom_tangent_part_balls(carom_tangent_work *w, const carom_event *event, const carom_normal *at, bool in_space);

#endif
