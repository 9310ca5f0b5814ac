/* Jumps of whole shots, for `carom-lab stress`: continuity.c. */
#ifndef CAROM_LAB_CONTINUITY_H
#define CAROM_LAB_CONTINUITY_H

#include <stdint.h>
#include <stdio.h>

/* Draws so many layouts and prints the table of jumps by family. threads: as in options. */
void continuity_print(uint64_t seed, uint64_t layouts, int threads, FILE *out);

#endif
