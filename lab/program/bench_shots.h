/* `carom-lab bench --shots`: see bench_shots.c. */
#ifndef CAROM_LAB_BENCH_SHOTS_H
#define CAROM_LAB_BENCH_SHOTS_H

#include "bench_job.h"

/* Times the shots of job->shots; an exit code. */
int bench_shots(const bench_job *job);

#endif
