/* Keeping the benchmark on one core, with real-time priority where that is allowed. */
#ifndef CAROM_BENCH_PINNING_H
#define CAROM_BENCH_PINNING_H

/* Moves the calling thread to one core (an isolated one if there is one, else the last that it
 * may use) and requests real-time priority. Returns what was reached, as a sentence part for the
 * notes. */
const char *pinning_begin(void);

/* Back to the cores and the priority from before. */
void pinning_end(void);

/* Back to the cores, not the priority, for a while: threads that are started meanwhile may use
 * every core, and are then as undisturbed as one. Nothing happens if nothing is pinned. */
void pinning_suspend(void);
void pinning_resume(void);

/* To be called between samples with the nanoseconds they took. Linux stops a real-time task that
 * leaves a core nothing for 50 ms in every second, in the midst of a sample; sleeping a little
 * more than that between samples keeps the stops out of them. */
void pinning_breathe(double busy_ns);

#endif
