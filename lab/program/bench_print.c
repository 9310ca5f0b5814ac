/* The figures of `carom-lab bench`, as a table or as CSV. */
#include "bench_job.h"
#include "machine.h"

#include <math.h>
#include <stdio.h>

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

/* For batches: how large they are, and what the copy is. */
static void print_batch_notes(const bench_job *job, FILE *out) {
  bool any = false;
  for (size_t k = 0; k < job->work_count; k++)
    any |= job->work[k].batch.size > 0;
  if (!any)
    return;
  if (job->show_pairs)
    machine_note(out, "batches", "the cases over and over, so many pairs in a call as the column says");
  else
    machine_note(out, "batches", "the cases over and over, %d pairs in a call", job->pairs.value[0]);
  machine_note(out, "bytes", "a pair is %zu bytes in and %zu out in double precision, half of that in single",
               sizeof(carom_impact), sizeof(carom_result));
  machine_note(out, "copy", "reads and writes as many bytes and computes nothing; its config is the cache that holds them");
}

static void print_notes(const bench_job *job, FILE *out) {
  fputs(job->machine, out);
  machine_note(out, "pinning", "%s", job->pinning);
  machine_note(out, "counters", "%s", job->counters_text);
  for (int k = 0; k < COUNTER_COUNT && job->counters; k++)
    machine_note(out, counter_column(k), "%s%s%s", counter_text(k), counter_reason(k) != NULL ? ": NA, " : "",
                 counter_reason(k) != NULL ? counter_reason(k) : "");
  machine_note(out, "workload", "%zu reference cases, one call each, mean over the cases", job->cases.count);
  print_batch_notes(job, out);
  const workload *yardstick = &job->work[0];
  machine_note(out, "yardstick", "%s, %s, with as many steps", workload_name(yardstick), workload_config(yardstick));
  const char *name;
  for (size_t k = 0; (name = ladder_module_name(k)) != NULL; k++)
    for (size_t w = 0; w < job->work_count; w++)
      if (job->work[w].module != NULL && job->work[w].module->name == name) {
        const ladder_module *module = job->work[w].module;
        machine_note(out, module->name, "%s, %s, %s", module->compiler, module->version, module->flags);
        break;
      }
  for (size_t w = 0; w < job->work_count; w++)
    if (job->work[w].left_out > 0)
      machine_note(out, "left out",
                   "%s, %s, %d steps: %zu of %zu cases, whose approach its precision does not resolve in as many steps",
                   job->work[w].kernel->name, workload_config(&job->work[w]), job->work[w].options.steps, job->work[w].left_out,
                   job->cases.count);
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
    fprintf(out, ",%zu", work_of(s)->batch.size > 0 ? work_of(s)->batch.size : s->pairs);
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
  fprintf(out, "\n%-15s %-17s %-7s %-9s %7s %6s ", "kernel", "config", "isa", "precision", "threads", "steps");
  if (job->show_pairs)
    fprintf(out, "%8s ", "pairs");
  fprintf(out, "%12s %8s %8s %8s %9s  %s\n", "ns median", "spread", "speedup", "spread", "error", "paper");
  for (size_t k = 0; k < job->subject_count; k++) {
    const bench_subject *s = &job->subject[k];
    const bench_figure *f = &job->figure[k];
    if (!f->unchanged)
      continue;
    fprintf(out, "%-15s %-17s %-7s %-9s %7d %6d ", s->kernel, s->config, s->isa, s->precision, s->threads, s->steps);
    if (job->show_pairs)
      fprintf(out, "%8zu ", work_of(s)->batch.size > 0 ? work_of(s)->batch.size : s->pairs);
    fprintf(out, f->ns.median < 100.0 ? "%12.3f" : "%12.1f", f->ns.median);
    fprintf(out, " %6.2f %% ", 100.0 * f->ns.spread / f->ns.median);
    print_ratio(out, "", f->speedup.median);
    print_ratio(out, " ", f->speedup.spread);
    if (isnan(s->pair_error_max))
      fprintf(out, "%10s", "NA");
    else
      fprintf(out, " %9.2g", s->pair_error_max);
    const bool as_in_paper = work_of(s)->module == job->work[0].module;
    fprintf(out, "  %s\n", as_in_paper ? workload_paper(work_of(s)) : "-");
  }
}

void bench_print(const bench_job *job, FILE *out) {
  (job->csv ? print_csv : print_table)(job, out);
}
