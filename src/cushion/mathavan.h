/* The exact limit of the 2010 model, followed from contact to parting. See mathavan.c. */
#ifndef CAROM_SRC_CUSHION_MATHAVAN_H
#define CAROM_SRC_CUSHION_MATHAVAN_H

#include "cushion/contact.h"
#include "cushion/coulomb.h"
#include "platform/integrate.h"

/* An impact on its way. Speeds and p are in units of the approach. */
typedef struct carom_cushion_way {
  carom_coulomb law;
  carom_regime regime;
  double e, rest;
  carom_slips start; /* slips at the start */
  double approach;   /* v_y at the start, m/s */
  double work_c;     /* int v_y dp over compression */
  double per_sine;   /* 1 / (1 + sin) */
  double to;         /* p at which to stop */
  int changes;       /* of the regime, so far */
  bool nose_singular, cloth_singular;
  enum { CAROM_NO_SLIP_IS_SLOW, CAROM_NOSE_IS_SLOW, CAROM_CLOTH_IS_SLOW } slow;
  bool falls;  /* the slow slip, */
  double most; /* which may be so large */
  bool in_restitution, ended, wedged, cornered;
  carom_ode_point point;
} carom_cushion_way;

/* Puts an impact at its start. */
carom_status carom_cushion_way_begin(const carom_contact *contact, carom_cushion_way *way);

/* On to p = `to`, m/s, or to the end if that comes first. */
carom_status carom_cushion_way_on(carom_cushion_way *way, double to, int budget);

/* The budget of a call of carom_cushion(). */
enum { CAROM_CUSHION_BUDGET = 8000 };

/* int v_y dp so far, over the square of the approach. */
double carom_cushion_way_work(const carom_cushion_way *way);

/* Impulses so far, over the mass. */
carom_impulse carom_cushion_way_impulse(const carom_cushion_way *way);

#endif
