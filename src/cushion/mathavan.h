/* The exact limit of the model of the 2010 paper, for the precise solver of src/impact. See mathavan.c. */
#ifndef CAROM_SRC_CUSHION_MATHAVAN_H
#define CAROM_SRC_CUSHION_MATHAVAN_H

#include "cushion/contact.h"
#include "impact/impact.h"

/* Puts an impact at its start; tolerance: see impact.h. */
void carom_mathavan_begin(const carom_contact *contact, double tolerance, carom_trajectory *path);

/* Impulses so far, over the mass. */
carom_impulse carom_mathavan_impulse(const carom_contact *contact, const carom_trajectory *path);

#endif
