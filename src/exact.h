/* The exact limit of Mathavan's method for infinitely many steps. See exact.c. */
#ifndef CAROM_SRC_EXACT_H
#define CAROM_SRC_EXACT_H

#include "frame.h"

/* What happened on the way, in the axes of the collision frame. Impulses in N s, work in J. */
typedef struct carom_exact_report {
  double P;                /* normal impulse */
  double P_ax, P_az;       /* friction impulse of ball j on ball i, along x and z */
  double P_cx, P_cy;       /* impulse of the cloth on the pressed ball */
  int pressed;             /* +1: ball i was pressed into the cloth, -1: ball j, 0: neither */
  double work_compression; /* W_c, taken up until the balls no longer approach */
  double work_total;       /* W_f = (1 + e^2) W_c */
  int stuck;               /* 0: the balls slipped on each other to the end; 1: slip ceased in compression; 2: in restitution */
  double P_stick;          /* normal impulse at which slip ceased; P when it never did */
  int evaluations;         /* right-hand sides used */
} carom_exact_report;

/* Advances `c` from the instant of contact to the end of the collision; needs v_jy < v_iy and checked numbers. `report` may be
 * NULL. */
void carom_exact(carom_local *c, carom_exact_report *report);

#endif
