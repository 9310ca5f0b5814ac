/* What a module of the ladder tells of itself: the agreement between module.c, inside, and
 * modules.c, which loads it. */
#ifndef CAROM_LADDER_MODULE_H
#define CAROM_LADDER_MODULE_H

#include "rung.h"

typedef struct ladder_contents {
  size_t state_size; /* sizeof(carom_local), as a check that both sides were built from the same
                        sources */
  const char *compiler, *version, *config, *flags;
  const char *cpu; /* the processor it was built for, as ladder_cpu() writes it */
  size_t count;
  struct ladder_entry {
    const char *name;
    carom_rung *run;
  } const *rung; /* in the order of kernels.def */
} ladder_contents;

/* The one symbol that a module exports. */
typedef const ladder_contents *ladder_contents_of(void);
#define LADDER_SYMBOL "carom_ladder_contents"
CAROM_API ladder_contents_of carom_ladder_contents;

#endif
