/* The report's tables: verification, speedups, operations and bounds, configurations; the seed paper's value beside ours where
 * it gives one, and a sentence where they differ. */
#include "ladder.h"
#include "report.h"
#include "report_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the paper says in its section 4.3, at N = 1000. */
typedef struct paper_bound {
  const char *kernel;
  double flops, bound, cycles; /* cycles as measured */
} paper_bound;

static const paper_bound paper_bounds[] = {{"base", 77796.0, 77000.0, 85300.0}, {"double", 43829.0, 44000.0, 50200.0}};
static const double paper_best = 1.93;
static const char paper_best_name[] = "float with archnative on clang";

static const paper_bound *paper_bound_of(const char *kernel) {
  for (size_t k = 0; k < sizeof paper_bounds / sizeof paper_bounds[0]; k++)
    if (strcmp(paper_bounds[k].kernel, kernel) == 0)
      return &paper_bounds[k];
  return NULL;
}

/* ---- Verification */

static const char *paper_count(const sheet *s, size_t row, const char *column) {
  const char *count = sheet_text(s, row, column);
  return strcmp(count, "NA") != 0 ? count : "";
}

static double largest(double x, double y) {
  return y > x || isnan(y) ? y : x;
}

/* One row for each kernel and reference: the worst of its builds. */
static void write_worst(const sheet *s, FILE *out) {
  HEAD(out, "t:kernel", "t:reference", "builds", "identical", "largest error", "bound", "> 0.1 %", "p:paper", "> 1 %",
       "p:paper", "t:");
  for (size_t first = 0; first < s->rows; first++) {
    const char *kernel = sheet_text(s, first, "kernel"), *reference = sheet_text(s, first, "reference");
    double identical = INFINITY, error = 0.0, over_1e3 = 0.0, over_1e2 = 0.0;
    size_t builds = 0, pass = 0, before = 0;
    for (size_t k = 0; k < s->rows; k++)
      if (strcmp(sheet_text(s, k, "kernel"), kernel) == 0 && strcmp(sheet_text(s, k, "reference"), reference) == 0) {
        before += k < first;
        builds++;
        pass += strcmp(sheet_text(s, k, "verdict"), "pass") == 0;
        identical = fmin(identical, sheet_number(s, k, "identical"));
        error = largest(error, sheet_number(s, k, "max"));
        over_1e3 = largest(over_1e3, sheet_number(s, k, "over_1e3"));
        over_1e2 = largest(over_1e2, sheet_number(s, k, "over_1e2"));
      }
    if (before > 0)
      continue;
    fputs("<tr>", out);
    cell(out, "t", kernel);
    cell(out, "t", reference);
    cell_of(out, "", "%zu", builds);
    cell_of(out, "", "%.0f of %s", identical, sheet_text(s, first, "cases"));
    cell_of(out, "", "%.2g", error);
    cell(out, "", sheet_text(s, first, "bound"));
    cell_of(out, "", "%.0f", over_1e3);
    cell(out, "paper", paper_count(s, first, "paper_1e3"));
    cell_of(out, "", "%.0f", over_1e2);
    cell(out, "paper", paper_count(s, first, "paper_1e2"));
    cell(out, pass == builds ? "t" : "t fail", pass == builds ? "pass" : "fail");
    fputs("</tr>\n", out);
  }
  close_table(out);
}

static void write_verification(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_verify];
  open_table(out, "verification", "Verification");
  if (s->rows == 0) {
    no_data(out, DATA_verify);
    return;
  }
  size_t failed = 0;
  for (size_t k = 0; k < s->rows; k++)
    failed += strcmp(sheet_text(s, k, "verdict"), "pass") != 0;
  fprintf(
      out,
      "<p>Every kernel on the 204 reference collisions, a row for the worst of its builds. Pair error: the largest deviation "
      "of a velocity, or R "
      "times an angular velocity, over the largest of the pair. The last columns count collisions in which a single "
      "component is off by more than 0.1 %% and 1 %% of itself, and what the paper counts. %zu of %zu comparisons are within "
      "their bounds.</p>\n",
      s->rows - failed, s->rows);
  write_worst(s, out);
  fputs("<p>Where counts differ from the paper's: its 204 collisions are not these, and it does not say how it treats "
        "components near "
        "zero, which here count against a thousandth of the pair's scale. Every build by itself is in "
        "<code>verify.csv</code>.</p>\n",
        out);
}

/* ---- Speedups */

/* How far our ratio is from the paper's, in words; "" if it gives neither number nor word. `parent` is the speedup of the rung
 * that this one improves on. */
static void compare_speedup(const char *paper_text, double paper, double ours, double parent, const char *parent_name,
                            char text[256]) {
  const double more = 100.0 * (ours / paper - 1.0), step = 100.0 * (ours / parent - 1.0);
  text[0] = '\0';
  if (!isnan(paper) && fabs(more) < 2.5)
    snprintf(text, 256, "as in the paper, within %.1f %%", fabs(more) < 0.05 ? 0.1 : ceil(10.0 * fabs(more)) / 10.0);
  else if (!isnan(paper))
    snprintf(text, 256, "%.0f %% %s than the paper's", fabs(more), more > 0.0 ? "more" : "less");
  else if (strcmp(paper_text, "a little more") == 0)
    snprintf(text, 256,
             step > 0.5    ? "gains %.1f %% on %s, as the paper says in words"
             : step > -0.5 ? "changes nothing here (%+.1f %% on %s); the paper saw a little gain"
                           : "loses here (%+.1f %% on %s); the paper saw a little gain",
             step, parent_name);
  else if (strncmp(paper_text, "slower", 6) == 0)
    snprintf(text, 256,
             ours < parent ? "%.0f %% slower than %s, as the paper says in words"
                           : "%.0f %% faster than %s here; the paper saw it slower",
             fabs(100.0 * (parent / ours - 1.0)), parent_name);
}

/* What "slower" is slower than: the scalar kernel that the vector kernels began from. */
static size_t scalar_ancestor(const sheet *s, size_t row) {
  do
    row = sheet_find(s, 0, "kernel", sheet_text(s, row, "parent"));
  while (row < s->rows && strcmp(sheet_text(s, row, "needs"), "scalar") != 0);
  return row;
}

static void write_speedups(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_speedup], *all = &r->data[DATA_ladder];
  open_table(out, "speedups", "Speedups");
  if (s->rows == 0) {
    no_data(out, DATA_speedup);
    return;
  }
  fputs("<p>N = 1000, ", out);
  report_escape(out, report_default_config(r));
  fputs(
      "; the mean over the collisions, the median over rounds in which all kernels take turns, and &#177; the median absolute "
      "deviation of the rounds. Below them the library's own kernels, one call each.</p>\n",
      out);
  HEAD(out, "t:kernel", "t:idea", "ns", "±", "speedup", "±", "p:paper", "t:ours and the paper's");
  for (size_t k = 0; k < s->rows; k++) {
    const char *kernel = sheet_text(s, k, "kernel"), *says = sheet_text(s, k, "paper_text");
    const ladder_rung *rung = ladder_rung_find(kernel);
    const size_t parent =
        strncmp(says, "slower", 6) == 0 ? scalar_ancestor(s, k) : sheet_find(s, 0, "kernel", sheet_text(s, k, "parent"));
    char sentence[256];
    compare_speedup(says, sheet_number(s, k, "paper"), sheet_number(s, k, "speedup"), sheet_number(s, parent, "speedup"),
                    sheet_text(s, parent, "kernel"), sentence);
    fputs("<tr>", out);
    cell(out, "t", kernel);
    cell(out, "wrap", rung != NULL ? rung->idea : "");
    cell_count(out, "", sheet_number(s, k, "ns"));
    cell_count(out, "", sheet_number(s, k, "ns_spread"));
    cell_of(out, "", "%.2f", sheet_number(s, k, "speedup"));
    cell_of(out, "", "%.3f", sheet_number(s, k, "speedup_spread"));
    cell(out, "paper", says);
    cell(out, "wrap", k > 0 ? sentence : "");
    fputs("</tr>\n", out);
  }
  for (size_t k = 0; k < all->rows; k++)
    if (strcmp(sheet_text(all, k, "config"), "library") == 0 && strcmp(sheet_text(all, k, "isa"), "scalar") == 0) {
      fputs("<tr>", out);
      cell(out, "t", sheet_text(all, k, "kernel"));
      cell_of(out, "wrap", "the library, %s, %s", sheet_text(all, k, "isa"), sheet_text(all, k, "precision"));
      const double speedup = sheet_number(all, k, "speedup");
      cell_ns(out, sheet_number(all, k, "ns_median"));
      cell_of(out, "", "%.2g", sheet_number(all, k, "ns_spread"));
      cell_of(out, "", speedup < 100.0 ? "%.2f" : "%.4g", speedup);
      cell_of(out, "", "%.2g", sheet_number(all, k, "speedup_spread"));
      cell(out, "paper", "");
      cell(out, "wrap", "");
      fputs("</tr>\n", out);
    }
  close_table(out);
}

/* ---- Operations and bounds */

static double at_1000(const sheet *s, const char *kernel, const char *column) {
  for (size_t row = 0; (row = sheet_find(s, row, "kernel", kernel)) < s->rows; row++)
    if (strcmp(sheet_text(s, row, "steps"), "1000") == 0)
      return sheet_number(s, row, column);
  return NAN;
}

/* The count of the paper, or an empty cell. */
static void cell_paper(FILE *out, const paper_bound *paper, double count) {
  if (paper != NULL)
    cell_count(out, "paper", count);
  else
    cell(out, "paper", "");
}

static void cell_share(FILE *out, const char *class, double share) {
  if (isnan(share))
    cell(out, class, "");
  else
    cell_of(out, class, "%.1f %%", 100.0 * share);
}

static void write_operation_row(FILE *out, const sheet *s, size_t row, double share) {
  static const char *const counts[] = {"flops_add", "flops_mul", "flops_div",  "flops_sqrt",
                                       "flops_fma", "rsqrt",     "conversions"};
  const char *kernel = sheet_text(s, row, "kernel");
  const paper_bound *paper = paper_bound_of(kernel);
  fputs("<tr>", out);
  cell(out, "t", kernel);
  for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
    cell_count(out, "", sheet_number(s, row, counts[c]));
  cell_count(out, "", sheet_number(s, row, "flops_amd"));
  cell_paper(out, paper, paper != NULL ? paper->flops : NAN);
  cell_count(out, "", sheet_number(s, row, "chain_cycles_zen2"));
  cell_paper(out, paper, paper != NULL ? paper->bound : NAN);
  cell_count(out, "", sheet_number(s, row, "chain_cycles_native"));
  cell_share(out, "", share);
  cell_share(out, "paper", paper != NULL ? paper->bound / paper->cycles : NAN);
  fputs("</tr>\n", out);
}

static void compare_operations(FILE *out, const sheet *s, size_t row) {
  const char *kernel = sheet_text(s, row, "kernel");
  const paper_bound *paper = paper_bound_of(kernel);
  if (paper == NULL)
    return;
  const double more = 100.0 * (sheet_number(s, row, "flops_amd") / paper->flops - 1.0),
               longer = 100.0 * (sheet_number(s, row, "chain_cycles_zen2") / paper->bound - 1.0);
  fprintf(out, "<b>%s</b> has %.0f %% %s operations than the paper counts and a bound %.0f %% %s than the paper's. ", kernel,
          fabs(more), more > 0.0 ? "more" : "fewer", fabs(longer), longer > 0.0 ? "higher" : "lower");
}

/* The rows of one compiler that have counts and belong to a rung. */
static bool is_counted(const sheet *s, size_t row, const char *compiler) {
  return strcmp(sheet_text(s, row, "compiler"), compiler) == 0 && ladder_rung_find(sheet_text(s, row, "kernel")) != NULL &&
         !isnan(sheet_number(s, row, "flops_amd"));
}

static void write_operations(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_bounds], *speed = &r->data[DATA_performance];
  open_table(out, "operations", "Operations and bounds");
  if (s->rows == 0) {
    no_data(out, DATA_bounds);
    return;
  }
  const char *compiler = sheet_text(s, 0, "compiler"), *machine = sheet_note(s, "machine");
  fputs("<p>Floating point operations of a collision at N = 1000, the mean over the cases, counted in the code that ", out);
  report_escape(out, compiler);
  fputs(" makes for Zen 2. The sum is AMD's: a fused multiply-add counts twice. The bound is the cycles that the longest chain "
        "of "
        "dependent operations takes with Zen 2's latencies, and with those measured on ",
        out);
  report_escape(out, machine != NULL ? machine : "the processor at hand");
  fputs(
      ". Share: the second bound over the time that the same code takes here, where it was measured on the same machine.</p>\n",
      out);
  HEAD(out, "t:kernel", "add", "mul", "div", "sqrt", "fma", "estimates", "conversions", "sum", "p:paper",
       "bound, Zen 2 (cycles)", "p:paper", "bound, measured (cycles)", "share", "p:paper");
  for (size_t k = 0; k < s->rows; k++)
    if (is_counted(s, k, compiler))
      write_operation_row(out, s, k, at_1000(speed, sheet_text(s, k, "kernel"), "share_of_bound"));
  close_table(out);
  fputs("<p>", out);
  for (size_t k = 0; k < s->rows; k++)
    if (is_counted(s, k, compiler))
      compare_operations(out, s, k);
  fputs("The paper does not name its compiler's version, and a chain is what a compiler made of the source: values that it "
        "keeps on "
        "the stack lengthen it. The bound is of a collision with friction in every step; some cases have less, so a share can "
        "exceed 100 %. <code>docs/bounds.md</code> tells more.</p>\n",
        out);
}

/* ---- Configurations */

static size_t first_with(const sheet *s, const char *column, size_t row) {
  return sheet_find(s, 0, column, sheet_text(s, row, column));
}

static double speedup_in(const sheet *s, const char *kernel, const char *config) {
  for (size_t row = 0; (row = sheet_find(s, row, "kernel", kernel)) < s->rows; row++)
    if (strcmp(sheet_text(s, row, "config"), config) == 0)
      return sheet_number(s, row, "speedup");
  return NAN;
}

static void write_configurations(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_configs];
  open_table(out, "configurations", "Compilers and configurations");
  if (s->rows == 0) {
    no_data(out, DATA_configs);
    return;
  }
  size_t best = 0;
  for (size_t k = 0; k < s->rows; k++)
    if (sheet_number(s, k, "speedup") > sheet_number(s, best, "speedup"))
      best = k;
  const double ours = sheet_number(s, best, "speedup");
  fprintf(out,
          "<p>Speedup over base in the first build. Best of all: <b>%s with %s, %.2f</b>; in the paper it is %s, %.2f.%s</p>\n",
          sheet_text(s, best, "kernel"), sheet_text(s, best, "config"), ours, paper_best_name, paper_best,
          ours < paper_best ? " This machine falls short of it." : "");
  fputs("<div class=\"wide\"><table>\n<tr><th class=\"t\">kernel</th>", out);
  for (size_t k = 0; k < s->rows; k++)
    if (first_with(s, "config", k) == k) {
      fputs("<th>", out);
      report_escape(out, sheet_text(s, k, "config"));
      fputs("</th>", out);
    }
  fputs("</tr>\n", out);
  for (size_t row = 0; row < s->rows; row++) {
    if (first_with(s, "kernel", row) != row)
      continue;
    const char *kernel = sheet_text(s, row, "kernel");
    fputs("<tr>", out);
    cell(out, "t", kernel);
    for (size_t k = 0; k < s->rows; k++)
      if (first_with(s, "config", k) == k) {
        const double x = speedup_in(s, kernel, sheet_text(s, k, "config"));
        if (isnan(x))
          cell(out, "", "NA");
        else
          cell_of(out, x == ours ? "best" : "", "%.2f", x);
      }
    fputs("</tr>\n", out);
  }
  close_table(out);
  fputs("<dl>\n", out);
  for (size_t k = 0; k < s->rows; k++) {
    const char *config = sheet_text(s, k, "config"), *flags = first_with(s, "config", k) == k ? sheet_note(s, config) : NULL;
    if (flags == NULL)
      continue;
    fprintf(out, "<dt>%s</dt><dd>", config);
    report_escape(out, flags);
    fputs("</dd>\n", out);
  }
  fputs("</dl>\n", out);
}

void report_write_tables(const report *r, FILE *out) {
  write_speedups(r, out);
  report_write_batches(r, out);
  write_configurations(r, out);
  write_operations(r, out);
  write_verification(r, out);
  report_write_experiments(r, out);
}
