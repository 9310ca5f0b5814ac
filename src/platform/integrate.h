/* Adaptive steps of an ordinary differential equation, and its events. See integrate.c. */
#ifndef CAROM_SRC_PLATFORM_INTEGRATE_H
#define CAROM_SRC_PLATFORM_INTEGRATE_H

#include "platform/arithmetic.h"

enum { CAROM_ODE_MOST = 10 }; /* unknowns at most; even */

/* y' = f(x, y) with `size` unknowns. */
typedef struct carom_ode {
  int size;
  /* The right-hand side: f from x and y. */
  void (*slope)(const void *model, double x, const double *y, double *f);
  /* The longest step that the singularities of the right-hand side allow at (x, y), where its value is f; above 0. */
  double (*longest)(const void *model, double x, const double *y, const double *f);
  /* A function that rises to 0 at an event, and its derivative by x. */
  double (*event)(const void *model, double x, const double *y, const double *f, double *rate);
  const void *model;
  const double *weight;   /* what 1 of each unknown counts in the error of a step; 0 if it is not to be controlled */
  double tolerance;       /* for the error of a step: the largest of its components times their weights */
  double event_tolerance; /* how far from 0 the event function may be where an event is said to be; 0: as near as can be */
} carom_ode;

/* Where an integration stands. */
typedef struct carom_ode_point {
  double x, y[CAROM_ODE_MOST], f[CAROM_ODE_MOST];
  double next;     /* length that the error control proposes for the next step */
  int evaluations; /* right-hand sides so far */
} carom_ode_point;

/* Evaluates f at a point whose x or y has been set, or whose model has changed; begin with this. */
void carom_ode_set(const carom_ode *ode, carom_ode_point *at);

/* Takes one step from *at, no further than x_end and no further than the first event. Returns 1 if it ended at the event. It
 * makes progress whatever the tolerance: a step of rounding's size is taken as it is, and so is one after a number that is not
 * finite. */
int carom_ode_step(const carom_ode *ode, carom_ode_point *at, double x_end);

/* An event function at a distance x from the beginning of a step: value and derivative. */
typedef struct carom_ode_reading {
  double x, g, rate;
} carom_ode_reading;

/* The zero of the cubic through two readings, of which the first is negative and the second is not. */
double carom_ode_zero_between(const carom_ode_reading *low, const carom_ode_reading *high);

#endif
