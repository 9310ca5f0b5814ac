/* Data of the report that is made of other data: speedups beside the paper's, and operations per cycle with their bounds. */
#include "ladder.h"
#include "report.h"

#include <math.h>
#include <string.h>

static void copy_notes(const sheet *from, FILE *out) {
  for (size_t k = 0; k < from->notes; k++)
    fprintf(out, "# %s\n", from->note[k]);
}

/* "base, clang-default, with as many steps" is the note that bench writes about what it compares with. */
const char *report_default_config(const report *r) {
  static char name[64];
  const char *note = sheet_note(&r->data[DATA_ladder], "yardstick"), *comma = note != NULL ? strstr(note, ", ") : NULL;
  snprintf(name, sizeof name, "%s", comma != NULL ? comma + 2 : "default");
  name[strcspn(name, ",")] = '\0';
  return name;
}

static const char *isa_name(ladder_isa isa) {
  return isa == LADDER_BASELINE ? "scalar" : isa == LADDER_AVX2 ? "avx2" : "avx512";
}

/* The rungs in the default configuration. What the paper says of the speedup is a number or, in its place, words; `paper` has
 * the number or NA, `paper_text` what it says. */
bool derive_speedup(const report *r, FILE *out) {
  const sheet *in = &r->data[DATA_ladder];
  const char *config = report_default_config(r);
  if (in->rows == 0)
    return false;
  copy_notes(in, out);
  fputs("kernel,parent,needs,ns,ns_spread,speedup,speedup_spread,paper,paper_text\n", out);
  const ladder_rung *rung;
  for (size_t k = 0; (rung = ladder_rung_at(k)) != NULL; k++) {
    size_t row = sheet_find(in, 0, "kernel", rung->name);
    while (row < in->rows && strcmp(sheet_text(in, row, "config"), config) != 0)
      row = sheet_find(in, row + 1, "kernel", rung->name);
    double paper;
    if (row < in->rows)
      fprintf(out, "%s,%s,%s,%s,%s,%s,%s,%s,%s\n", rung->name, rung->parent, isa_name(rung->isa),
              sheet_text(in, row, "ns_median"), sheet_text(in, row, "ns_spread"), sheet_text(in, row, "speedup"),
              sheet_text(in, row, "speedup_spread"), sscanf(rung->paper, "%lf", &paper) == 1 ? rung->paper : "NA", rung->paper);
  }
  return true;
}

/* The clock of the time stamp counter, from bench's note "time stamp counter, fenced, 2.5961 per ns"; NAN where there is none.
 */
static double ticks_per_ns(const sheet *s) {
  const char *note = sheet_note(s, "reference cycles");
  double rate = NAN;
  for (const char *at = note; at != NULL && (at = strstr(at, ", ")) != NULL; at += 2)
    if (sscanf(at, ", %lf per ns", &rate) == 1)
      return rate;
  return NAN;
}

/* bench says "AMD EPYC" and "26, model 2" in two notes, bound "AMD EPYC, family 26, model 2" in one. */
static bool same_machine(const sheet *bench, const sheet *bound) {
  const char *processor = sheet_note(bench, "processor"), *family = sheet_note(bench, "processor family"),
             *machine = sheet_note(bound, "machine");
  char name[256];
  if (processor == NULL || family == NULL || machine == NULL)
    return false;
  snprintf(name, sizeof name, "%s, family %s", processor, family);
  return strcmp(name, machine) == 0;
}

/* The counts for a kernel from the compiler whose code has been timed; that is the first one of its kind in the file. */
static size_t counted(const sheet *bounds, const char *kernel, const char *config) {
  const size_t size = strcspn(config, "-");
  for (size_t row = 0; (row = sheet_find(bounds, row, "kernel", kernel)) < bounds->rows; row++)
    if (strncmp(sheet_text(bounds, row, "compiler"), config, size) == 0 && !isnan(sheet_number(bounds, row, "flops_amd")))
      return row;
  return bounds->rows;
}

/* Operations over N are those at N = 1000 and, for every step more or less, those of a step. Where the machine counts core
 * cycles they are used, else reference cycles. The bound is of a step's operations over its longest chain, which is a number of
 * core cycles: on a machine that shows only reference cycles these are converted by the lengths of both, as measured. */
bool derive_performance(const report *r, FILE *out) {
  const sheet *in = &r->data[DATA_cycles], *bounds = &r->data[DATA_bounds], *latency = &r->data[DATA_latency];
  if (in->rows == 0 || bounds->rows == 0)
    return false;
  const size_t cycle = sheet_find(latency, 0, "row", "cycle");
  const bool core = !isnan(sheet_number(in, 0, "cycles"));
  const double counted_steps = 1000.0, rate = ticks_per_ns(in), core_ns = sheet_number(latency, cycle, "ns");
  const double unit = core ? 1.0 : core_ns * rate;
  copy_notes(in, out);
  fprintf(out, "# cycle: %s\n", core ? "core cycles" : "reference cycles");
  fprintf(out, "# ticks per ns: %.4g\n", rate);
  fprintf(out, "kernel,config,steps,flops,cycles,flops_per_cycle,bound_flops_per_cycle,share_of_bound\n");
  for (size_t k = 0; k < in->rows; k++) {
    const char *kernel = sheet_text(in, k, "kernel"), *config = sheet_text(in, k, "config");
    const size_t row = strstr(config, "-zen2") != NULL ? counted(bounds, kernel, config) : bounds->rows;
    if (row == bounds->rows)
      continue;
    const double steps = sheet_number(in, k, "steps"), a_step = sheet_number(bounds, row, "per_step_flops_amd");
    const double flops = sheet_number(bounds, row, "flops_amd") + (steps - counted_steps) * a_step;
    const double cycles = sheet_number(in, k, core ? "cycles" : "ref_cycles");
    const double chain = same_machine(in, bounds) ? sheet_number(bounds, row, "chain_cycles_native") : NAN;
    const double bound = counted_steps * a_step / (chain * unit);
    fprintf(out, "%s,%s,%.0f,%.6g,%.6g,%.4g", kernel, config, steps, flops, cycles, flops / cycles);
    if (isnan(bound))
      fputs(",NA,NA\n", out);
    else
      fprintf(out, ",%.4g,%.4g\n", bound, flops / cycles / bound);
  }
  return true;
}
