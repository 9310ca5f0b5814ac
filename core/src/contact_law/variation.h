/* Derivatives of an impact with two frictional contacts, of law.h: its variational equations,
 * which follow the precise solver step by step; variation.c has the method. */
#ifndef CAROM_SRC_CONTACT_LAW_VARIATION_H
#define CAROM_SRC_CONTACT_LAW_VARIATION_H

#include "contact_law/impact.h"
#include "contact_law/quadrature.h"

/* The variables of derivatives of an impact: the slips at its start, frictions, restitution, and
 * the parameter lambda of the geometry.
 */
enum carom_variable {
  BY_A_X,
  BY_A_Y,
  BY_B_X,
  BY_B_Y,
  BY_MU,
  BY_MU_C,
  BY_E,
  BY_LAMBDA,
  CAROM_VARIABLES
};

/* The variables on which rates depend. */
enum { CAROM_PARAMETERS = 1 << BY_MU | 1 << BY_MU_C | 1 << BY_LAMBDA };

/* A step as the solver took it, at the nodes: dp/dX, p from the beginning of the step,
 * directions of the slips. */
typedef struct carom_kept_step {
  double z[NODES], p[NODES], u_x[NODES], u_y[NODES], t_x[NODES], t_y[NODES];
} carom_kept_step __attribute__((aligned(64)));

/* The results that have derivatives, in the order of the numbers below. */
enum carom_varied { OF_A_X, OF_A_Y, OF_B_X, OF_B_Y, OF_V, OF_W, CAROM_VARIED };

typedef struct carom_variation {
  carom_kept_step record;
  /* the derivatives of the coefficients of path->terms by the variables, for `regime` */
  double d_terms[sizeof(carom_terms) / sizeof(double)][CAROM_VARIABLES];
  double d[CAROM_VARIED][CAROM_VARIABLES]; /* derivatives at a fixed p: path->point.p; derivatives
                                              by variables that were not requested are 0 */
  const carom_law *d_law;                  /* by lambda */
  unsigned requests;                       /* bit k: by variable k */
  int regime;
  double d_p[CAROM_VARIABLES];   /* at the end the derivative of where the impact ends, and then d
                                    are total ones */
  double d_W_c[CAROM_VARIABLES]; /* of the work of compression */
  double rate[CAROM_VARIED];     /* y' at the end of the last step, by its regime */
  double lead[4];                /* directions of a and b there */
  bool lost;                     /* the equations do not determine how it continues: planar motion,
                                    a jammed ball */
  bool kink;                     /* a slip begins from zero, and there is a seed by it */
} carom_variation;

/* Impulses and their derivatives. */
typedef struct carom_impact_tangent {
  carom_impulses q;
  double d[5][CAROM_VARIABLES]; /* of p, f_x, f_y, F_x, F_y */
  double error;                 /* of those, by differences: relative to the largest; else 0 */
  bool differences, kink;
} carom_impact_tangent;

/* The impulses of an impact that begins with these slips over the speed of approach, and their
 * derivatives by the variables in `requests` (bit k: variable k); the others are 0. d_law: the
 * derivative of the law by lambda; plain: options.plain of the call. Errors: as for
 * carom_impact_advance(). */
carom_status carom_impact_differentiate(const carom_law *law, const carom_law *d_law,
                                        const double slips[4], int plain, unsigned requests,
                                        carom_impact_tangent *out);

/* Sets d_terms for path->regime. */
void carom_variation_begin_regime(carom_trajectory *path);
/* Directions of the slips at a point; `otherwise` where a slip is zero. */
void carom_variation_leads(const carom_point *point, const double otherwise[4], double lead[4]);
/* The rates at one position, from directions. */
void carom_variation_rates(const carom_terms *k, const double lead[4], double v,
                           double rate[CAROM_VARIED]);

/* Called by advance.c, in addition to variation_step() of variation_step.h: after a straight
 * step; */
void carom_variation_straight(carom_trajectory *path, const carom_point *start, bool planar);
/* and after either, once the regime is decided. phase_ended: compression or restitution has. */
void carom_variation_follow(carom_trajectory *path, const carom_point *start, bool phase_ended);

#endif
