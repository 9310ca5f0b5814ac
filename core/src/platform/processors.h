/* How many processors this process may use; see processors.c. */
#ifndef CAROM_SRC_PLATFORM_PROCESSORS_H
#define CAROM_SRC_PLATFORM_PROCESSORS_H

#include "platform/arithmetic.h"

/* 1 or more: the processors of the calling thread's affinity, but no more than its control group's
 * limit on processor time. */
int carom_processors(void);

/* Only the limit, rounded up to whole processors, INT_MAX if there is none. `self` lists the groups
 * of the process (/proc/self/cgroup), `root` is where they are mounted (/sys/fs/cgroup). */
int carom_group_limit(const char *self, const char *root);

#endif
