/* The figures of `carom-lab bench`, a row a subject, as a table or as CSV. */
#include "bench_job.h"
#include "machine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const workload *work_of(const bench_subject *subject) {
  return subject->context;
}

static void print_number(FILE *out, const char *before, const char *format, double x) {
  fputs(before, out);
  if (isnan(x))
    fputs("NA", out);
  else
    fprintf(out, format, x);
}

static void print_notes(const bench_job *job, FILE *out) {
  fputs(job->machine, out);
  machine_note(out, "pinning", "%s", job->pinning);
  machine_note(out, "counters", "%s", job->counters_text);
  for (int k = 0; k < COUNTER_COUNT && job->counters; k++)
    machine_note(out, counter_column(k), "%s%s%s", counter_text(k), counter_reason(k) != NULL ? ": NA, " : "",
                 counter_reason(k) != NULL ? counter_reason(k) : "");
  job->table->note(job, out);
  machine_note(out, "rounds", "%zu; an empty call, subtracted, takes %.2f ns", job->figure[0].ns.count,
               job->figure[0].empty_ns);
}

static void print_csv_row(const bench_job *job, FILE *out, size_t k) {
  const bench_subject *s = &job->subject[k];
  const bench_figure *f = &job->figure[k];
  fprintf(out, "%s,%s,%s,%s,%d,%d", s->kernel, s->config, s->isa, s->precision, s->threads, s->steps);
  print_number(out, ",", "%.6g", f->ns.median);
  print_number(out, ",", "%.6g", f->ns.min);
  print_number(out, ",", "%.6g", f->ns.max);
  print_number(out, ",", "%.5g", f->speedup.median);
  print_number(out, ",", "%.3g", s->pair_error_max);
  if (job->spread) {
    print_number(out, ",", "%.3g", f->ns.spread);
    print_number(out, ",", "%.5g", f->speedup.min);
    print_number(out, ",", "%.5g", f->speedup.max);
    print_number(out, ",", "%.3g", f->speedup.spread);
  }
  if (job->errors) {
    fprintf(out, ",%s", carom_slip_name(work_of(s)->options.slip));
    print_number(out, ",", "%.3g", work_of(s)->exact.median);
    print_number(out, ",", "%.3g", work_of(s)->exact.max);
  }
  if (job->counters) {
    print_number(out, ",", "%.6g", f->ticks.median);
    for (int c = 0; c < COUNTER_COUNT; c++)
      print_number(out, ",", "%.6g", job->count[k][c]);
  }
  if (job->show_pairs)
    fprintf(out, ",%zu", s->in_a_call > 0 ? s->in_a_call : s->pairs);
  fputc('\n', out);
}

static void print_csv(const bench_job *job, FILE *out) {
  print_notes(job, out);
  fputs("kernel,config,isa,precision,threads,steps,ns_median,ns_min,ns_max,speedup,pair_error_max", out);
  if (job->spread)
    fputs(",ns_spread,speedup_min,speedup_max,speedup_spread", out);
  if (job->errors)
    fputs(",slip,error_exact_median,error_exact_max", out);
  if (job->counters) {
    fputs(",ref_cycles", out);
    for (int c = 0; c < COUNTER_COUNT; c++)
      fprintf(out, ",%s", counter_column(c));
  }
  if (job->show_pairs)
    fputs(",pairs", out);
  fputc('\n', out);
  for (size_t k = 0; k < job->subject_count; k++)
    if (job->figure[k].unchanged)
      print_csv_row(job, out, k);
}

/* Three decimals or, from a hundred, four digits. */
static void print_ratio(FILE *out, const char *before, double x) {
  print_number(out, before, x < 100.0 ? "%8.3f" : x < 1000.0 ? "%8.1f" : "%8.0f", x);
}

static void print_table(const bench_job *job, FILE *out) {
  print_notes(job, out);
  fprintf(out, "\n%-16s %-16s %-7s %-9s %7s %6s ", "kernel", "config", "isa", "precision", "threads", "steps");
  if (job->show_pairs)
    fprintf(out, "%8s ", "pairs");
  fprintf(out, "%12s %8s %8s %8s %9s  %s\n", "ns median", "spread", "speedup", "spread", "error", "paper");
  for (size_t k = 0; k < job->subject_count; k++) {
    const bench_subject *s = &job->subject[k];
    const bench_figure *f = &job->figure[k];
    if (!f->unchanged)
      continue;
    fprintf(out, "%-16s %-16s %-7s %-9s %7d %6d ", s->kernel, s->config, s->isa, s->precision, s->threads, s->steps);
    if (job->show_pairs)
      fprintf(out, "%8zu ", s->in_a_call > 0 ? s->in_a_call : s->pairs);
    fprintf(out, f->ns.median < 100.0 ? "%12.3f" : "%12.1f", f->ns.median);
    fprintf(out, " %6.2f %% ", 100.0 * f->ns.spread / f->ns.median);
    print_ratio(out, "", f->speedup.median);
    print_ratio(out, " ", f->speedup.spread);
    if (isnan(s->pair_error_max))
      fprintf(out, "%10s", "NA");
    else
      fprintf(out, " %9.2g", s->pair_error_max);
    fprintf(out, "  %s\n", s->paper != NULL && strcmp(s->config, job->subject[0].config) == 0 ? s->paper : "-");
  }
}

void bench_print(const bench_job *job, FILE *out) {
  (job->csv ? print_csv : print_table)(job, out);
}
