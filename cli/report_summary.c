/* What `carom report` says on standard output at its end: the speedups in a table of a few columns. */
#include "report.h"

#include <string.h>

static void print_row(const char *kernel, double ns, double speedup, const char *paper) {
  printf("%-17s %9.*f %9.*f  %s\n", kernel, ns < 1000.0 ? 1 : 0, ns, speedup < 100.0 ? 2 : 0, speedup, paper);
}

/* Of the batches only those with the highest instruction set: it comes last. */
static void print_batches(const sheet *all) {
  size_t last = all->rows;
  for (size_t k = 0; k < all->rows; k++)
    if (strcmp(sheet_text(all, k, "config"), "library") == 0 && strcmp(sheet_text(all, k, "isa"), "scalar") != 0)
      last = k;
  for (size_t k = 0; k < all->rows; k++) {
    if (strcmp(sheet_text(all, k, "config"), "library") != 0 ||
        strcmp(sheet_text(all, k, "isa"), sheet_text(all, last, "isa")) != 0)
      continue;
    const char *threads = sheet_text(all, k, "threads");
    char says[128];
    snprintf(says, sizeof says, "in batches, %s, %s, %s thread%s", sheet_text(all, k, "isa"), sheet_text(all, k, "precision"),
             threads, strcmp(threads, "1") == 0 ? "" : "s");
    print_row(sheet_text(all, k, "kernel"), sheet_number(all, k, "ns_median"), sheet_number(all, k, "speedup"), says);
  }
}

void report_print_speedups(const report *r) {
  const sheet *rungs = &r->data[DATA_speedup], *all = &r->data[DATA_ladder];
  if (rungs->rows == 0)
    return;
  const char *processor = sheet_note(rungs, "processor");
  printf("\nspeedup over %s, %s, N = 1000, %s\n", sheet_text(rungs, 0, "kernel"), report_default_config(r),
         processor != NULL ? processor : "processor unknown");
  printf("%-17s %9s %9s  %s\n", "kernel", "ns", "speedup", "paper");
  for (size_t k = 0; k < rungs->rows; k++)
    print_row(sheet_text(rungs, k, "kernel"), sheet_number(rungs, k, "ns"), sheet_number(rungs, k, "speedup"),
              sheet_text(rungs, k, "paper_text"));
  for (size_t k = 0; k < all->rows; k++)
    if (strcmp(sheet_text(all, k, "config"), "library") == 0 && strcmp(sheet_text(all, k, "isa"), "scalar") == 0)
      print_row(sheet_text(all, k, "kernel"), sheet_number(all, k, "ns_median"), sheet_number(all, k, "speedup"),
                "the library's");
  print_batches(all);
  printf("\n");
}
