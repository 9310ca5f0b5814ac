/* Running gnuplot on a script of lab/figures. */
#ifndef CAROM_CLI_GNUPLOT_H
#define CAROM_CLI_GNUPLOT_H

enum { NO_GNUPLOT = 127 };

/* Why nothing was drawn when gnuplot_run returns NO_GNUPLOT. */
extern const char no_gnuplot[];

/* Draws `picture` from `csv`, both relative to `folder`; gnuplot's exit code, NO_GNUPLOT if it cannot be run. What it says
 * comes out on stderr only if it fails: it also warns of every part of a plot that a CSV has no rows for, and those are
 * optional. */
int gnuplot_run(const char *folder, const char *script, const char *csv, const char *picture, const char *title);

#endif
