/* Batches by the exact limit. */
#ifndef CAROM_SRC_BALL_BALL_BATCH_H
#define CAROM_SRC_BALL_BALL_BATCH_H

#include "ball_ball/kernels.h"

/* By the exact limit; see batch.c. */
carom_batch_solver carom_exact_batch_double, carom_exact_batch_single;

/* One pair by a single call, with the checks and the status of carom_collide(): what lanes leave to it is a row that is not
 * plainly good. `in` and `out` are of the precision. */
carom_status carom_collide_one(carom_precision precision, const void *in, const carom_options *opt, void *out);

#endif
