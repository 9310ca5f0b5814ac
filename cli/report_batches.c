/* The report's table of batches: speed, error, and how near they are to a copy of their bytes. */
#include "report.h"
#include "report_cells.h"
#include "workload.h"

#include <math.h>
#include <string.h>

static bool is(const sheet *s, size_t row, const char *column, const char *text) {
  return strcmp(sheet_text(s, row, column), text) == 0;
}

static bool is_batch(const sheet *s, size_t row) {
  return !is(s, row, "isa", "scalar") && !is(s, row, "kernel", "copy");
}

/* The copy of as many bytes by as many threads: bench prints the one in the cache behind it. NAN if there is none. */
static double copy_beside(const sheet *s, size_t row) {
  for (size_t k = 0; (k = sheet_find(s, k, "kernel", "copy")) < s->rows; k++)
    if (is(s, k, "precision", sheet_text(s, row, "precision")) && is(s, k, "threads", sheet_text(s, row, "threads")))
      return sheet_number(s, k, "ns_median");
  return NAN;
}

static void write_row(const sheet *s, size_t row, FILE *out) {
  const double ns = sheet_number(s, row, "ns_median"), speedup = sheet_number(s, row, "speedup"), copy = copy_beside(s, row);
  fputs("<tr>", out);
  cell(out, "t", sheet_text(s, row, "kernel"));
  cell(out, "t", sheet_text(s, row, "isa"));
  cell(out, "t", sheet_text(s, row, "precision"));
  cell(out, "", sheet_text(s, row, "threads"));
  cell_ns(out, ns);
  cell_of(out, "", "%.2g", sheet_number(s, row, "ns_spread"));
  cell_of(out, "", speedup < 100.0 ? "%.2f" : "%.0f", speedup);
  cell(out, "", is(s, row, "pair_error_max", "0") ? "the same bits" : sheet_text(s, row, "pair_error_max"));
  cell_of(out, "", "%.3g", (double)workload_bytes(is(s, row, "precision", "single")) / ns);
  if (isnan(copy))
    cell(out, "", "NA");
  else
    cell_of(out, "", ns < 10.0 * copy ? "%.1f" : "%.0f", ns / copy);
  fputs("</tr>\n", out);
}

void report_write_batches(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_ladder], *isas = &r->data[DATA_isas];
  size_t batches = 0;
  for (size_t k = 0; k < s->rows; k++)
    batches += is_batch(s, k);
  open_table(out, "batches", "Batches");
  if (batches == 0) {
    no_data(out, DATA_ladder);
    return;
  }
  const char *note = sheet_note(s, "batches");
  fputs("<p>Many pairs in a call, a collision in each lane: ", out);
  report_escape(out, note != NULL ? note : "");
  fputs(
      "; solvers with steps, N = 1000, in smaller batches. Speedup is over base, one call each; the error is the largest over "
      "the cases against the solver's reference. The last columns are bytes read and written, and the time over that of a copy "
      "of as many bytes: 1 would be as fast as memory.</p>\n",
      out);
  HEAD(out, "t:kernel", "t:isa", "t:precision", "threads", "ns", "±", "speedup", "largest error", "GB/s", "times the copy");
  for (size_t k = 0; k < s->rows; k++)
    if (is_batch(s, k))
      write_row(s, k, out);
  for (size_t k = 0; k < isas->rows; k++)
    if (is_batch(isas, k) && !is(isas, k, "steps", "0"))
      write_row(isas, k, out);
  close_table(out);
}
