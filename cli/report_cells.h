/* Tables of the report's page, cell by cell. */
#ifndef CAROM_CLI_REPORT_CELLS_H
#define CAROM_CLI_REPORT_CELLS_H

#include <stdio.h>

/* A heading; then comes text, then HEAD, rows of cells between <tr> and </tr>, and close_table(). */
void open_table(FILE *out, const char *id, const char *heading);
void close_table(FILE *out);

/* Begins the table with its head cells: "t:" before a name aligns it left, "p:" marks the paper's column. */
void head_row(FILE *out, const char *const name[], size_t n);

#define HEAD(out, ...) \
  head_row(out, (const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

/* A cell of a class of the page's style ("" for none, "t" for text), with text, with a format, or with a number grouped by
 * thousands, "NA" if it was not measured. */
void cell(FILE *out, const char *class, const char *text);
__attribute__((format(printf, 3, 4))) void cell_of(FILE *out, const char *class, const char *format, ...);
void cell_count(FILE *out, const char *class, double x);

/* A time in ns: grouped by thousands, or with four digits. */
void cell_ns(FILE *out, double ns);

/* In place of a table whose data, a row of data.def, are missing. */
void no_data(FILE *out, int data);

#endif
