/* `carom-lab bench`: times every kernel on the reference cases, once it is verified. */
#include "bench_job.h"
#include "command.h"
#include "kernel.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "output.h"
#include "pinning.h"
#include "place.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void show_samples(double done, double total) {
  progress_show("samples", done, total);
}

static bool time_all(bench_job *job) {
  job->figure = allocate(job->subject_count, sizeof *job->figure);
  FILE *machine = open_memstream(&job->machine, &(size_t){0});
  if (machine == NULL) {
    complain("out of memory");
    return false;
  }
  machine_describe(machine);
  fclose(machine);
  job->pinning = pinning_begin();
  const bench_settings settings = {
      .budget = job->budget, .now = job->now, .progress = show_samples};
  const bool good = bench_rounds(job->subject, job->subject_count, &settings, job->figure);
  pinning_end();
  progress_clear();
  if (!good)
    complain("out of memory");
  return good;
}

static void check_unchanged(bench_job *job) {
  for (size_t k = 0; k < job->subject_count; k++)
    if (!job->figure[k].unchanged) {
      complain(
          "%s (%s) did not repeat its verified results while it was timed: its figures are dropped",
          job->subject[k].kernel, job->subject[k].config);
      job->code = EXIT_SOME;
    }
}

/* The output is opened before the long part, so that a bad name costs nothing. */
static bool bench_all(bench_job *job) {
  if (!job->table->choose(job))
    return false;
  if (job->subject_count == 0)
    return true;
  FILE *out = output_open(job->shared.output);
  if (out == NULL)
    return false;
  if (!time_all(job)) {
    output_abandon();
    return false;
  }
  check_unchanged(job);
  job->table->print(job, out);
  return output_commit();
}

static void bench_free(bench_job *job) {
  carom_isa_limit(job->isa);
  job->table->release(job);
  free(job->subject);
  free(job->figure);
  free(job->machine);
}

/* ---- Printing */

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
  job->table->note(job, out);
  machine_note(out, "rounds", "%zu; an empty call, subtracted, takes %.2f ns",
               job->figure[0].ns.count, job->figure[0].empty_ns);
}

static void print_csv_row(const bench_job *job, FILE *out, size_t k) {
  const bench_subject *s = &job->subject[k];
  const bench_figure *f = &job->figure[k];
  fprintf(out, "%s,%s,%s,%s,%d,%d", s->kernel, s->config, s->isa, s->precision, s->threads,
          s->steps);
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
    fprintf(out, ",%s", s->slip);
    print_number(out, ",", "%.3g", s->error_exact_median);
    print_number(out, ",", "%.3g", s->error_exact_max);
  }
  if (job->show_pairs)
    fprintf(out, ",%zu", s->in_a_call > 0 ? s->in_a_call : s->pairs);
  fputc('\n', out);
}

static void print_csv(const bench_job *job, FILE *out) {
  print_notes(job, out);
  fputs("kernel,config,isa,precision,threads,steps,ns_median,ns_min,ns_max,speedup,pair_error_max",
        out);
  if (job->spread)
    fputs(",ns_spread,speedup_min,speedup_max,speedup_spread", out);
  if (job->errors)
    fputs(",slip,error_exact_median,error_exact_max", out);
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
  fprintf(out, "\n%-16s %-16s %-7s %-9s %7s %6s ", "kernel", "config", "isa", "precision",
          "threads", "steps");
  if (job->show_pairs)
    fprintf(out, "%8s ", "pairs");
  fprintf(out, "%12s %8s %8s %8s %9s  %s\n", "ns median", "spread", "speedup", "spread", "error",
          "paper");
  for (size_t k = 0; k < job->subject_count; k++) {
    const bench_subject *s = &job->subject[k];
    const bench_figure *f = &job->figure[k];
    if (!f->unchanged)
      continue;
    fprintf(out, "%-16s %-16s %-7s %-9s %7d %6d ", s->kernel, s->config, s->isa, s->precision,
            s->threads, s->steps);
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
    fprintf(out, "  %s\n",
            s->paper != NULL && strcmp(s->config, job->subject[0].config) == 0 ? s->paper : "-");
  }
}

void bench_print(const bench_job *job, FILE *out) {
  (job->csv ? print_csv : print_table)(job, out);
}

/* ---- Arguments */

void add_count(count_list *list, int value) {
  list->value = grow(list->value, &list->room, list->count + 1, sizeof *list->value);
  list->value[list->count++] = value;
}

static OPTION_SET(set_names) {
  name_list *list = field;
  const size_t before = list->count;
  char *rest;
  for (char *name = strtok_r(text, ",", &rest); name != NULL; name = strtok_r(NULL, ",", &rest)) {
    list->name = grow(list->name, &list->room, list->count + 1, sizeof *list->name);
    list->name[list->count++] = name;
  }
  if (list->count == before)
    complain("--%s needs a name", row->name);
  return list->count > before;
}

static OPTION_SET(set_counts) {
  count_list *list = field;
  const size_t before = list->count;
  int value;
  char *rest, *one;
  for (one = strtok_r(text, ",", &rest); one != NULL && set_count(row, one, &value);
       one = strtok_r(NULL, ",", &rest))
    add_count(list, value);
  return one == NULL && (list->count > before || set_count(row, text + strlen(text), &value));
}

static OPTION_SET(set_kernels) {
  name_list *list = field;
  const size_t before = list->count;
  const kernel *unused;
  bool good = set_names(row, text, field);
  for (size_t k = before; k < list->count && good; k++)
    good = set_kernel(row, (char *)list->name[k], &unused);
  return good;
}

static OPTION_SET(set_isas) {
  name_list *list = field;
  const size_t before = list->count;
  bool good = set_names(row, text, field);
  for (size_t k = before; k < list->count && good; k++) {
    char here[128] = "scalar, best";
    good = strcmp(list->name[k], "scalar") == 0 || strcmp(list->name[k], "best") == 0;
    for (int isa = 0; carom_isa_name((carom_isa)isa) != NULL; isa++)
      if (bench_isa_here((carom_isa)isa)) {
        good |= strcmp(list->name[k], carom_isa_name((carom_isa)isa)) == 0;
        strcat(strcat(here, ", "), carom_isa_name((carom_isa)isa));
      }
    if (!good)
      complain("no instruction set '%s' here; there are %s", list->name[k], here);
  }
  return good;
}

static OPTION_SET(set_threads) {
  if (strcmp(text, "all") != 0)
    return set_counts(row, text, field);
  const int cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
  for (int count = 1; count < cores; count *= 2)
    add_count(field, count);
  add_count(field, cores);
  return true;
}

static OPTION_SET(set_budget) {
  double *seconds = field;
  char *end;
  *seconds = strtod(text, &end);
  const bool good = end != text && *end == '\0' && *seconds > 0.0 && *seconds <= 86400.0;
  if (!good)
    complain("--%s is a number of seconds above 0, up to 86400, not '%s'", row->name, text);
  return good;
}

OPTION(bench_job, option_kernel, "kernel", kernels, 0, "NAME,...", set_kernels, 0,
       "only these kernels (see `carom-lab kernels`); may be repeated");
OPTION(bench_job, option_config, "config", configs, 0, "NAME,...", set_names, 0,
       "these builds of the ladder's kernels, or all (default: default); without --kernel, only "
       "the ladder");
OPTION(bench_job, option_counts, "steps", steps, 0, "N,...", set_counts, 1,
       "steps of Euler's method (default 1000); several make a sweep");
OPTION(bench_job, option_batch, "batch", batch, 0, NULL, set_flag, 0,
       "batches only, of all of the library's solvers (with euler about a minute)");
OPTION(
    bench_job, option_isa, "isa", isas, 0, "NAME,...", set_isas, 0,
    "only these instruction sets: scalar (single calls), plain, sse2, avx2, avx512, neon, or best");
OPTION(bench_job, option_one_precision, "precision", shared.precision, 0, "double|single",
       set_choice, 0, "only this precision (default: both)");
OPTION(bench_job, option_thread_counts, "threads", threads, 0, "N,...", set_threads, 1,
       "threads of a batch, or all: 1, 2, 4, ... up to the processor's (default 1,2; 1 on a single "
       "core)");
OPTION(bench_job, option_pairs, "pairs", pairs, 0, "N,...", set_counts, 1,
       "pairs in a batch (default 65536, rounded up to whole turns of the cases); adds the column "
       "pairs");
OPTION(bench_job, option_budget, "budget", budget, 0, "SECONDS", set_budget, 0,
       "how long to measure (default 20; shots 0.06 each)");
OPTION(bench_job, option_csv, "csv", csv, 0, NULL, set_flag, 0,
       "as CSV, with lines about the machine that begin with #");
OPTION(bench_job, option_spread, "spread", spread, 0, NULL, set_flag, 0,
       "more columns in the CSV: spread of the time; least, greatest and spread of the speedup");
OPTION(bench_job, option_errors, "errors", errors, 0, NULL, set_flag, 0,
       "more columns in the CSV: slip, and the pair error against the exact reference, median and "
       "largest");
OPTION(bench_job, option_shots, "shots", shots, 0, "IN.jsonl", set_text, 0,
       "time the whole shots of this file instead, beside pooltool's recorded times");
OPTION(bench_job, option_cushion_model, "cushion-model", shared.shot.cushion_model, 0, NULL,
       set_named, CAROM_WORDS_SHOT_CUSHION,
       "impacts on cushions in the shots (default: han; by pooltool's models stronge)");

static const char about[] =
    "Times kernels on the 204 reference collisions, one call each, in turns: A B C A B C ... Each "
    "kernel is verified first; one whose error is above its bound is not timed. Times are "
    "nanoseconds per collision, the mean over the collisions; median and spread are over the "
    "rounds. The speedup of a round is relative to the ladder's first kernel in the default "
    "configuration with the same number of steps (1000 for kernels without steps). The exact "
    "solver is also timed in batches, with every instruction set.\n";

static const char details[] =
    "Spread is the median absolute deviation: half of the rounds lie within it. "
    "docs/study/measuring.md explains how to read the figures.\n\n"
    "exit code: 0 if all was timed; 1 if a kernel was refused (the others are timed); 2 for bad "
    "usage or unreadable data\n";

static const command_form form = {
    .name = "bench",
    .usage = "[OPTIONS]",
    .about = about,
    .options =
        (const option_row *const[]){
            &option_kernel, &option_config, &option_counts, &option_batch, &option_isa,
            &option_one_precision, &option_thread_counts, &option_pairs, &option_budget,
            &option_csv, &option_spread, &option_errors, &option_shots, &option_models,
            &option_cushion_model, &option_simultaneous, &option_data, &option_output, NULL},
    .details = details,
    .example = "carom-lab bench --kernel base,double,float,exact --budget 5",
};

/* Options that choose collisions mean nothing for shots. */
static bool is_plain(const bench_job *job) {
  return job->kernels.count + job->configs.count + job->isas.count + job->steps.count +
                 job->pairs.count ==
             0 &&
         !job->batch && !job->errors && job->shared.precision == ANY_PRECISION;
}

static int bench(bench_job *job) {
  if ((job->spread || job->errors) && !job->csv)
    complain("--spread and --errors add columns to the CSV: give --csv too");
  else if (job->shots != NULL && !is_plain(job))
    complain("--kernel, --config, --steps, --batch, --isa, --precision, --pairs and --errors are "
             "for collisions of two balls");
  else {
    job->table = job->shots != NULL ? &bench_of_shots : &bench_of_collisions;
    job->folder = data_folder(job->shared.folder);
    job->isa = carom_isa_in_force();
    const int code = bench_all(job) ? job->code : EXIT_USAGE;
    bench_free(job);
    return code;
  }
  return usage_hint(&form);
}

int command_bench(int argc, char **argv) {
  bench_job job = {.shared = {.precision = ANY_PRECISION, .output = "-"}, .code = EXIT_GOOD};
  int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code < 0)
    code = bench(&job);
  free(job.kernels.name);
  free(job.configs.name);
  free(job.isas.name);
  free(job.steps.value);
  free(job.pairs.value);
  free(job.threads.value);
  return code;
}
