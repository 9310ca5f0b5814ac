/* Rows cut over threads; see threads.c. */
#ifndef CAROM_SRC_PLATFORM_THREADS_H
#define CAROM_SRC_PLATFORM_THREADS_H

#include "platform/arithmetic.h"

#include <stddef.h>

/* Works on the rows from `from` to before `end` of a job; returns the first of them that is in
 * error, or `end`. Called from several threads at once. */
typedef size_t carom_part_worker(const void *job, size_t start, size_t end);

/* Works on all of n rows, by at most `threads` threads (options.threads with its meaning), none
 * of which gets fewer rows than `least`. Returns the first row in error, or n. */
size_t carom_in_threads(carom_part_worker *worker, const void *job, size_t n, int threads,
                        size_t least);

/* The same for several jobs, one after the other, by threads that are started once: `call` gets
 * the context and the crew, with which it calls carom_crew_work(). At most `threads` threads, no
 * more than there are parts of the largest job. */
typedef struct carom_crew carom_crew;
typedef void carom_crew_caller(void *context, carom_crew *crew);
void carom_with_crew(carom_crew_caller *call, void *context, int threads, size_t parts);
size_t carom_crew_work(carom_crew *crew, carom_part_worker *worker, const void *job, size_t n,
                       size_t least);

#endif
