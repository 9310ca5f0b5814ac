/* What all kinds of `carom-lab stress` share: errors counted, worst rows kept, tables, threads. */
#ifndef CAROM_LAB_STRESS_TALLY_H
#define CAROM_LAB_STRESS_TALLY_H

#include "carom.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum {
  STRESS_DECADES = 20, /* errors are counted in a histogram of their logarithms */
  STRESS_PER_DECADE = 50,
};

/* Rows of one kind, solved in one way. Errors are those of rows with status ok that were judged. */
typedef struct stress_tally {
  long rows, over_1e6, over_1e5, over_2e5; /* compared; with an error larger than 1e-6, 1e-5, 2e-5 */
  long unresolved, refused;                /* with that status, or with another error */
  long unjudged;                           /* with status ok, and no reference that could judge them */
  long by_fallback;                        /* left to the precise solver */
  double largest, largest_of_play;
  uint64_t worst; /* number of the draw that has the largest error, over the bound that it may have */
  double worst_share;
  long histogram[STRESS_DECADES * STRESS_PER_DECADE];
} stress_tally;

/* Counts the error of draw `k`, which is one of play or not. */
void stress_count(stress_tally *t, double error, bool of_play, uint64_t k);

/* The error that so large a share of the rows do not exceed. */
double stress_quantile(const stress_tally *t, double share);

void stress_add(stress_tally *to, const stress_tally *from);

/* A line of the table, and its head. */
void stress_print_head(FILE *out, const char *first, const char *second);
void stress_print(FILE *out, const char *first, const char *second, const stress_tally *t);

/* The contract of carom.h for double precision: rows of play within 1e-6, all within 1e-5. */
bool stress_holds(const stress_tally *t);

/* The threads that are meant by --threads, 0 being one for each processor. */
int stress_threads(int asked);

/* Calls work(shift, block) for the blocks 0 to `blocks` - 1, in that many threads, each with its own shift: `shifts` is an
 * array of as many, each of `size` bytes. */
typedef void stress_work(void *shift, uint64_t block);
void stress_in_threads(int threads, void *shifts, size_t size, uint64_t blocks, stress_work *work, const char *what);

#endif
