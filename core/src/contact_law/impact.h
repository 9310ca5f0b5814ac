/* An impact with two frictional contacts: the precise solver. law.h has the equations, advance.c
 * the method. */
#ifndef CAROM_SRC_CONTACT_LAW_IMPACT_H
#define CAROM_SRC_CONTACT_LAW_IMPACT_H

#include "platform/arithmetic.h"

#include "carom.h"
#include "contact_law/law.h"

#include <stdbool.h>

/* A point of an impact, in units of the speed of approach at its beginning: slips, speed of
 * approach, int v dp since the phase began, and p. growth: logarithm by which an error of the
 * direction of b may have grown, where H < 0. */
typedef struct carom_point {
  double a_x, a_y, b_x, b_y, v, W, p, growth;
} carom_point;

/* The coefficients of the equations in a regime: see step.h. event: the regime ends where
 * event[0] + event[1] y + event[2] x^2 + event[3] y^2 becomes positive, with x, y the direction
 * u where the driving contact slips, and w t where it does not. */
typedef struct carom_terms {
  double S_x, S_y, A_0, C_x, C_y, R_x, R_y, B_0, H_x, H_y, V_0, V_u, V_w, w_0, w_u, w_t;
  double event[4];
} carom_terms;

/* The regime of each contact. */
typedef struct carom_regime {
  bool held;               /* friction holds the driving contact: a = 0 */
  bool cloth_held, loaded; /* friction holds the contact with the cloth: b = 0; or the cloth
                              bears a load, and slips */
  double u_x, u_y;         /* direction in which a slip of zero is about to begin at the driving
                              contact, */
  double t_x, t_y;         /* and on the cloth */
} carom_regime;

struct carom_variation;

/* An impact on its way. */
typedef struct carom_trajectory {
  carom_law law;
  carom_point start, point;
  carom_regime regime;
  carom_terms terms;
  bool restitution, ended; /* v = 0 is passed; nothing follows */
  double W_c;              /* int v dp over compression */
  double across;           /* of planar motion, where H < 0: the slip across the plane that
                              friction may have made of a slip that counts as none. 0 if there is
                              none */
  double p_stick;          /* p where friction first held the driving contact; NaN before that */
  int iterations;          /* of all steps so far; each computes the rates at eight nodes */
  carom_status status;     /* not CAROM_OK if there is no way on */
  /* of advance.c: */
  int plain;                         /* options.plain of the call */
  double tolerance;                  /* of a step, in units of the error of step.h */
  double no_slip;                    /* a slip that counts as zero */
  double longest;                    /* length that the next step may have */
  int refusals;                      /* in a row */
  int sticks_missed;                 /* steps to stick that diverged */
  bool careful;                      /* steps are planned for safety */
  double event_at;                   /* p where the regime ends, as far as is known */
  struct carom_variation *variation; /* derivatives that follow the impact: variation.h. Usually
                                        NULL */
} carom_trajectory;

/* Impulses over the mass of the ball and the speed of approach: normal impulse, friction at the
 * driving contact, friction of the cloth. */
typedef struct carom_impulses {
  double p, f_x, f_y, F_x, F_y;
} carom_impulses;

/* Puts an impact at its start. a, b: the slips over the speed of approach, in which errors are at
 * most `rounding`, and 0 along x in motion along the axes of the table. tolerance: 1 for errors of
 * about 1e-9 in the mean and 1e-7 at most, of the largest speed; errors are about proportional to
 * it. plain: as in the options. */
void carom_impact_begin(const carom_law *law, double tolerance, int plain, double a_x, double a_y,
                        double b_x, double b_y, double rounding, carom_trajectory *path);

/* Continues to p = target, or to the end if that is earlier. Errors: CAROM_ERROR_OVERFLOW; and
 * CAROM_ERROR_UNRESOLVED if that takes more than `most` iterations, counted from the start, if no
 * regime is consistent, or if the result depends on rounding errors.
 */
carom_status carom_impact_advance(carom_trajectory *path, double target, int most);

/* The most iterations for the impact of a call, and for each sample of a trace. */
enum { CAROM_IMPACT_ITERATIONS = 400 };

/* The impulses so far. */
carom_impulses carom_impact_impulses(const carom_trajectory *path);

/* int |v| dp so far: the work of the normal force over the mass and the square of the speed of
 * approach; for a cushion, over the cosine of the nose's angle too. */
double carom_impact_work(const carom_trajectory *path);

/* The regime that begins at path->point, into path->regime and path->terms. event: the event of the
 * last regime has ended it. False if no regime is consistent. See contact.c. */
bool carom_impact_regime(carom_trajectory *path, bool event);

/* The coefficients of a regime. */
carom_terms carom_impact_terms(const carom_law *law, const carom_regime *regime);

/* Whether friction is about to hold both contacts, so that the ball is jammed. */
bool carom_impact_jams(const carom_trajectory *path);

/* carom_impact_advance() as advance.c is compiled to: with vectors of two numbers, and with four
 * for AVX2. */
carom_status carom_impact_advance_plain(carom_trajectory *path, double target, int most);
carom_status carom_impact_advance_avx2(carom_trajectory *path, double target, int most);

#ifdef CAROM_LANES_AVX2
#define CAROM_IMPACT_ADVANCE carom_impact_advance_avx2
#else
#define CAROM_IMPACT_ADVANCE carom_impact_advance_plain
#endif

#endif
