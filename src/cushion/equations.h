/* The differential equation of an impact on its way, and its events. See equations.c. */
#ifndef CAROM_SRC_CUSHION_EQUATIONS_H
#define CAROM_SRC_CUSHION_EQUATIONS_H

#include "cushion/mathavan.h"

/* How near to zero an event function is where the event is said to be. */
#define CAROM_CUSHION_EVENT_TOLERANCE 1e-8

enum { S_X, S_T, C_X, C_Y, WORK, P, UNKNOWNS }; /* y */

static inline carom_slips slips_of(const double *y) {
  return (carom_slips){{y[S_X], y[S_T]}, {y[C_X], y[C_Y]}};
}

static inline double length(carom_vector a) {
  return sqrt(a.x * a.x + a.y * a.y);
}

static inline double speed_into(const carom_coulomb *law, const double *y) {
  return (y[C_Y] - y[S_T]) / (1 + law->sine);
}

static inline carom_vector *slip_at(carom_slips *slips, bool cloth) {
  return cloth ? &slips->c : &slips->s;
}

static inline carom_vector *direction_at(carom_regime *regime, bool cloth) {
  return cloth ? &regime->cloth : &regime->nose;
}

/* The equation and its events in the present regime. */
carom_ode carom_cushion_equations(const carom_cushion_way *way);

/* Positive behind the end of the regime or of the phase, and its derivative: the larger of the two. */
double carom_cushion_event(const carom_cushion_way *way, const double *y, const double *f, double *rate);

/* By how much the regime is violated: the friction of a contact that sticks beyond the cone, as a share of it, or the load of
 * the wrong sign. */
double carom_violation(const carom_cushion_way *way, const carom_slips *slips);

/* Positive behind the end of the phase; and where a slow slip has become zero, or too large for that. */
double carom_phase_event(const carom_cushion_way *way, const double *y, const double *f, double *rate);
double carom_slow_event(const carom_cushion_way *way, const double *y, const double *f, double *rate);

/* The frictions where the slips are these. */
carom_friction carom_friction_here(const carom_cushion_way *way, const carom_slips *slips);

/* Whether nothing that changes acts on the direction of a slip, as the other contact sticks or has no friction. */
bool carom_slip_is_alone(const carom_cushion_way *way, bool cloth);

/* The regime with the direction of a slow slip (see coulomb.c), which *slips is left without, and how fast it turns. False if
 * there is none. */
bool carom_slow_regime(const carom_cushion_way *way, bool cloth, bool falls, carom_slips *slips, carom_regime *regime,
                       double *turns);

#endif
