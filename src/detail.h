/* carom_detail from what the solvers know. */
#ifndef CAROM_SRC_DETAIL_H
#define CAROM_SRC_DETAIL_H

#include "euler.h"
#include "exact.h"
#include "frame.h"

carom_detail carom_detail_of_nothing(void);

carom_detail carom_detail_of_exact(const carom_frame *frame, const carom_exact_report *report);

/* Euler's method keeps no account of its impulses; the balance of what changed gives them. */
carom_detail carom_detail_of_euler(const carom_frame *frame, const carom_local *before, const carom_local *after,
                                   const carom_euler_run *run);

#endif
