/* oracle.h - a slow, independent and very accurate answer to one collision, for tests. */
#ifndef CAROM_TESTS_ORACLE_H
#define CAROM_TESTS_ORACLE_H
#include "carom.h"

typedef struct oracle_story {
  double P, W_c, W_f;    /* normal impulse and work of the normal force */
  double P_stick;        /* normal impulse at which slip ceased, P when it never did */
  int stuck;             /* 0 never, 1 in compression, 2 in restitution */
  double slip_left;      /* smallest |u| / |u at the start| */
  double cloth_slip_min; /* smallest cloth slip of the pressed ball, m/s */
  long evaluations;
} oracle_story;

/* s: -1 paper, +1 pooltool. Balls must approach. Returns 0, or -1 if a step could not be made (seen: 2 of 6,000 drawn to
 * hurt). */
int oracle_collide(const carom_impact *in, double s, carom_result *out, oracle_story *story /* or NULL */);

#endif
