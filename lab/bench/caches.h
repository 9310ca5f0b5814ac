/* The processor's data caches, as far as Linux shows them. */
#ifndef CAROM_BENCH_CACHES_H
#define CAROM_BENCH_CACHES_H

#include <stddef.h>

/* Size in bytes of the data cache of level 1, 2, ...; 0 where there is none or it is not visible. */
size_t cache_size(int level);

/* Where so many bytes in use lie: "L1", "L2", "L3", the smallest cache that holds them all, or "memory"; "NA" where no cache is
 * visible. */
const char *cache_holding(size_t bytes);

#endif
