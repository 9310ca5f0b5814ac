/* The parts of `carom report`: measured data, figures drawn from it, and the page that shows both. */
#ifndef CAROM_CLI_REPORT_H
#define CAROM_CLI_REPORT_H

#include "sheet.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>

/* The rows of lab/figures/data.def by number: DATA_verify, ... */
enum {
#define MEASURED(name, share, command) DATA_##name,
#define STORED(name, folder, file) DATA_##name,
#define DERIVED(name, function) DATA_##name,
#include "data.def"
#undef MEASURED
#undef STORED
#undef DERIVED
  DATA_COUNT
};

enum {
  FIGURE_COUNT = 0
#define FIGURE(name, number, csv, title, sentence) +1
#include "figures.def"
#undef FIGURE
};

/* A row of lab/figures/figures.def, where the columns are explained. */
typedef struct report_figure {
  const char *name, *number, *csv, *title, *sentence;
  char missing[256]; /* why there is no picture; "" if there is one */
} report_figure;

typedef struct report {
  const char *folder;     /* of the report */
  const char *from;       /* folder of the stored CSVs; NULL: measure */
  const char *references; /* folder of cases and references; NULL: the usual one */
  double budget;          /* s */
  bool png;
  sheet data[DATA_COUNT]; /* empty where there is none */
  report_figure figure[FIGURE_COUNT];
} report;

/* "steps" for DATA_steps; the command that measures it ("carom bench ...") or NULL. */
const char *report_data_name(int k);
const char *report_data_command(int k);

/* Writes `folder`/`name``extension` into path; false after a complaint if that is too long. */
bool report_path(char path[PATH_MAX], const char *folder, const char *name, const char *extension);

/* Measures (or takes from r->from), derives and reads all data. What cannot be had is left empty, after a complaint. */
void report_collect(report *r);

/* Draws the figures; where one cannot be drawn, figure.missing says why. */
void report_draw(report *r);

/* Prints the speedups, for those who do not open the page. */
void report_print_speedups(const report *r);

/* Writes index.html. */
bool report_write_page(const report *r);

/* The tables of the page, as HTML. */
void report_write_tables(const report *r, FILE *out);
void report_write_batches(const report *r, FILE *out);
void report_write_experiments(const report *r, FILE *out);

/* Text into HTML. */
void report_escape(FILE *out, const char *text);

/* Functions of data.def: write a CSV made of other data; false if that is not there. */
bool derive_speedup(const report *r, FILE *out);
bool derive_performance(const report *r, FILE *out);

/* The module of the ladder's default configuration as it stands in the data, "clang-default". */
const char *report_default_config(const report *r);

#endif
