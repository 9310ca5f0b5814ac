/* Keeping the benchmark on one core. */
#ifndef CAROM_BENCH_PINNING_H
#define CAROM_BENCH_PINNING_H

/* Moves the calling thread to the last core that it may use; goes on where that fails. Returns what was reached, as a sentence
 * part for the notes; valid until the next call. */
const char *pinning_begin(void);

/* Back to the cores from before pinning_begin(). */
void pinning_end(void);

/* Back to the cores for a while, so that threads started meanwhile may use every core. Nothing happens if nothing is pinned. */
void pinning_suspend(void);
void pinning_resume(void);

#endif
