/* A progress line on a terminal's stderr, for work of more than a second. */
#ifndef CAROM_CLI_PROGRESS_H
#define CAROM_CLI_PROGRESS_H

/* Seconds on the monotonic clock. */
double seconds_now(void);

/* Says that `done` of `total` units ("rows") are done; `total` < 0 where it is not known. Draws at most ten times a second, and
 * nothing in the first second or when stderr is not a terminal. */
void progress_show(const char *unit, double done, double total);

/* Removes the line, if one stands there. */
void progress_clear(void);

#endif
