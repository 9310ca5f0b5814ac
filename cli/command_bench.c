/* `carom bench`: times every kernel on the reference cases, once it is verified. */
#include "bench_job.h"
#include "command.h"
#include "machine.h"
#include "message.h"
#include "option.h"
#include "output.h"
#include "pinning.h"
#include "progress.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "usage: carom bench [OPTIONS]\n\n"
    "Times kernels on the 204 reference cases, each case one call, in turns: A B C A B C ... What is timed has been verified\n"
    "just before; a kernel that is over its bound is refused. Figures are nanoseconds per collision, the mean over the cases;\n"
    "median and spread are over the rounds. Speedup is that over the ladder's first kernel in the default configuration\n"
    "with as many steps (1000 for kernels that take none), round by round. The solver without steps is timed in batches too,\n"
    "with every instruction set; the copy beside them moves a batch's bytes and computes nothing.\n\n"
    "  --kernel NAME,...   only these kernels (see `carom kernels`); may be repeated\n"
    "  --config NAME,...   these builds of the ladder's kernels, or all (default: default); without --kernel, only the ladder\n"
    "  --steps N,...       steps of Euler's method (default 1000); several make a sweep\n"
    "  --batch             batches only, of all of the library's solvers (with euler about a minute)\n"
    "  --isa NAME,...      only these instruction sets: scalar (single calls), plain, sse2, avx2, avx512, neon, or best\n"
    "  --precision NAME    only double or only single\n"
    "  --threads N,...     threads of a batch, or all: 1, 2, 4, ... up to the processor's (default 1,2; 1 on a single core)\n"
    "  --pairs N,...       pairs in a batch (default 65536, rounded up to whole turns of the cases); adds the column pairs\n"
    "  --budget SECONDS    how long to measure (default 20)\n"
    "  --csv               as CSV, with lines about the machine that begin with #\n"
    "  --spread            more columns in the CSV: spread of the time; least, greatest and spread of the speedup\n"
    "  --errors            more columns in the CSV: slip, and the pair error against the exact reference, median and largest\n"
    "  --counters          more columns in the CSV: reference cycles and hardware counters per collision, NA where there\n"
    "                      are none\n"
    "  --data DIR          folder of the cases and references (default: $CAROM_DATA, else the one that came with carom)\n"
    "  -o, --output OUT    file to write, - for standard output (default); a file appears whole or not at all\n"
    "  -h, --help          this text\n\n"
    "Spread is the median absolute deviation: half of the rounds lie within it. docs/measuring.md tells what to make of it.\n\n"
    "exit code: 0 if all was timed, 1 if a kernel was refused (the others are timed), 2 for bad usage or unreadable data\n";

static bool verify_all(bench_job *job) {
  job->subject = calloc(job->work_count, sizeof *job->subject);
  job->figure = calloc(job->work_count, sizeof *job->figure);
  job->count = calloc(job->work_count, sizeof *job->count);
  if (job->subject == NULL || job->figure == NULL || job->count == NULL) {
    complain("out of memory");
    return false;
  }
  for (size_t k = 0; k < job->work_count; k++) {
    workload *w = &job->work[k];
    char message[WORKLOAD_MESSAGE];
    if (!workload_verify(w, job->folder, message) || (job->errors && !workload_compare_exact(w, job->folder)))
      return false;
    progress_show("kernels verified", (double)(k + 1), (double)job->work_count);
    if (message[0] != '\0') {
      complain("%s", message);
      job->code = EXIT_SOME;
      continue;
    }
    job->subject[job->subject_count++] = workload_subject(w);
  }
  return true;
}

static void show_samples(double done, double total) {
  progress_show("samples", done, total);
}

static bool time_all(bench_job *job) {
  for (size_t k = 0; k < job->subject_count; k++)
    job->subject[k].yardstick = bench_yardstick(job, job->subject[k].context);
  FILE *machine = open_memstream(&job->machine, &(size_t){0});
  if (machine == NULL) {
    complain("out of memory");
    return false;
  }
  machine_describe(machine);
  fclose(machine);
  job->counters_text = counters_begin();
  job->pinning = pinning_begin();
  const bench_settings settings = {.budget = job->budget, .progress = show_samples};
  const bool good = bench_rounds(job->subject, job->subject_count, &settings, job->figure);
  for (size_t k = 0; k < job->subject_count && job->counters && good; k++) {
    const bench_subject *s = &job->subject[k];
    double nothing[COUNTER_COUNT];
    counters_measure(s->resolve, s->context, job->count[k]);
    counters_measure(s->empty, s->context, nothing);
    for (int c = 0; c < COUNTER_COUNT; c++)
      job->count[k][c] = (job->count[k][c] - nothing[c]) / (double)s->pairs;
  }
  pinning_end();
  progress_clear();
  if (!good)
    complain("out of memory");
  return good;
}

static void check_unchanged(bench_job *job) {
  for (size_t k = 0; k < job->subject_count; k++)
    if (!job->figure[k].unchanged) {
      complain("%s (%s) did not repeat its verified results while it was timed: its figures are dropped",
               job->subject[k].kernel, job->subject[k].config);
      job->code = EXIT_SOME;
    }
}

/* The output is opened before the long part, so that a bad name costs nothing. */
static bool bench_all(bench_job *job) {
  if (!cases_load(job->folder, "collisions-204.csv", &job->cases) || !bench_choose(job) || !verify_all(job))
    return false;
  if (job->subject_count == 0)
    return true;
  FILE *out = output_open(job->out);
  if (out == NULL)
    return false;
  if (!time_all(job)) {
    output_abandon();
    return false;
  }
  check_unchanged(job);
  bench_print(job, out);
  return output_commit();
}

static void bench_free(bench_job *job) {
  carom_isa_limit(job->isa);
  counters_end();
  for (size_t k = 0; k < job->work_count; k++)
    workload_free(&job->work[k]);
  free(job->work);
  free(job->subject);
  free(job->figure);
  free(job->count);
  free(job->machine);
  cases_free(&job->cases);
  case_tiles_free(&job->tiles);
}

static bool add_names(name_list *list, char *text, const char *option) {
  const size_t before = list->count;
  char *rest;
  for (char *name = strtok_r(text, ",", &rest); name != NULL; name = strtok_r(NULL, ",", &rest)) {
    if (list->count == MOST_NAMES) {
      complain("%s takes at most %d names", option, MOST_NAMES);
      return false;
    }
    list->name[list->count++] = name;
  }
  if (list->count == before)
    complain("%s needs a name", option);
  return list->count > before;
}

static bool add_kernels(bench_job *job, char *text) {
  const size_t before = job->kernels.count;
  if (!add_names(&job->kernels, text, "--kernel"))
    return false;
  const kernel *unused;
  for (size_t k = before; k < job->kernels.count; k++)
    if (!option_kernel(job->kernels.name[k], &unused))
      return false;
  return true;
}

static bool add_step_counts(bench_job *job, char *text) {
  if (text[strspn(text, ",")] == '\0')
    return option_steps(text, &job->steps[0]);
  char *rest;
  for (char *one = strtok_r(text, ",", &rest); one != NULL; one = strtok_r(NULL, ",", &rest)) {
    if (job->steps_count == MOST_STEPS) {
      complain("--steps takes at most %d numbers", MOST_STEPS);
      return false;
    }
    if (!option_steps(one, &job->steps[job->steps_count++]))
      return false;
  }
  return true;
}

static bool add_isas(bench_job *job, char *text) {
  const size_t before = job->isas.count;
  if (!add_names(&job->isas, text, "--isa"))
    return false;
  for (size_t k = before; k < job->isas.count; k++) {
    const char *name = job->isas.name[k];
    bool here = strcmp(name, "scalar") == 0 || strcmp(name, "best") == 0;
    char list[128] = "scalar, best";
    for (int isa = 0; isa < CAROM_ISA_COUNT; isa++)
      if (bench_isa_here((carom_isa)isa)) {
        here |= strcmp(name, carom_isa_name((carom_isa)isa)) == 0;
        strcat(strcat(list, ", "), carom_isa_name((carom_isa)isa));
      }
    if (!here) {
      complain("no instruction set '%s' here; there are %s", name, list);
      return false;
    }
  }
  return true;
}

static bool add_pairs(bench_job *job, char *text) {
  char *rest;
  int count = 0;
  const size_t before = job->pairs_count;
  for (char *one = strtok_r(text, ",", &rest); one != NULL; one = strtok_r(NULL, ",", &rest)) {
    if (job->pairs_count == MOST_PAIRS) {
      complain("--pairs takes at most %d numbers", MOST_PAIRS);
      return false;
    }
    if (!option_count("--pairs", one, 1, &count))
      return false;
    job->pairs[job->pairs_count++] = (size_t)count;
  }
  job->show_pairs = true;
  return job->pairs_count > before || option_count("--pairs", "", 1, &count);
}

static bool add_thread_count(bench_job *job, int count) {
  if (job->threads_count == MOST_THREADS) {
    complain("--threads takes at most %d numbers", MOST_THREADS);
    return false;
  }
  job->threads[job->threads_count++] = count;
  return true;
}

static bool add_threads(bench_job *job, char *text) {
  char *rest;
  int count = 0;
  const size_t before = job->threads_count;
  if (strcmp(text, "all") == 0) {
    const int cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
    for (count = 1; count < cores; count *= 2)
      if (!add_thread_count(job, count))
        return false;
    return add_thread_count(job, cores);
  }
  for (char *one = strtok_r(text, ",", &rest); one != NULL; one = strtok_r(NULL, ",", &rest))
    if (!option_count("--threads", one, 1, &count) || !add_thread_count(job, count))
      return false;
  return job->threads_count > before || option_count("--threads", "", 1, &count);
}

int command_bench(int argc, char **argv) {
  static const struct option options[] = {
      {"kernel", required_argument, NULL, 'k'},
      {"config", required_argument, NULL, 'c'},
      {"steps", required_argument, NULL, 'n'},
      {"batch", no_argument, NULL, 'B'},
      {"isa", required_argument, NULL, 'i'},
      {"precision", required_argument, NULL, 'P'},
      {"threads", required_argument, NULL, 't'},
      {"pairs", required_argument, NULL, 'a'},
      {"budget", required_argument, NULL, 'b'},
      {"csv", no_argument, NULL, 'v'},
      {"spread", no_argument, NULL, 's'},
      {"errors", no_argument, NULL, 'e'},
      {"counters", no_argument, NULL, 'p'},
      {"data", required_argument, NULL, 'd'},
      {"output", required_argument, NULL, 'o'},
      {"help", no_argument, NULL, 'h'},
      {0},
  };
  bench_job job = {.budget = 20.0, .out = "-", .code = EXIT_GOOD};
  const char *folder = NULL;
  bool good = true, single;
  int option;
  while (good && (option = getopt_long(argc, argv, "o:h", options, NULL)) != -1)
    switch (option) {
    case 'k':
      good = add_kernels(&job, optarg);
      break;
    case 'c':
      good = add_names(&job.configs, optarg, "--config");
      break;
    case 'n':
      good = add_step_counts(&job, optarg);
      break;
    case 'B':
      job.batch = true;
      break;
    case 'i':
      good = add_isas(&job, optarg);
      break;
    case 'P':
      good = option_precision(optarg, &single);
      job.precision = single ? "single" : "double";
      break;
    case 't':
      good = add_threads(&job, optarg);
      break;
    case 'a':
      good = add_pairs(&job, optarg);
      break;
    case 'b':
      good = option_budget(optarg, &job.budget);
      break;
    case 'v':
      job.csv = true;
      break;
    case 's':
      job.spread = true;
      break;
    case 'e':
      job.errors = true;
      break;
    case 'p':
      job.counters = true;
      break;
    case 'd':
      folder = optarg;
      break;
    case 'o':
      job.out = optarg;
      break;
    case 'h':
      fputs(help, stdout);
      return EXIT_GOOD;
    default:
      return usage_hint("bench");
    }
  if (!good)
    return EXIT_USAGE;
  if (optind < argc) {
    complain("bench takes no files, but got '%s'", argv[optind]);
    return usage_hint("bench");
  }
  if ((job.spread || job.errors || job.counters) && !job.csv) {
    complain("--spread, --errors and --counters add columns to the CSV: give --csv too");
    return usage_hint("bench");
  }
  if (job.steps_count == 0)
    job.steps[job.steps_count++] = carom_default_options().steps;
  job.folder = cases_folder(folder);
  job.isa = carom_isa_in_force();
  const int code = bench_all(&job) ? job.code : EXIT_USAGE;
  bench_free(&job);
  return code;
}
