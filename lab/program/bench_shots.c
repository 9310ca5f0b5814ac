/* `carom-lab bench --shots`: whole shots timed, beside the time that pooltool took for each.
 *
 * A sample plays one shot as often as takes about 2 ms, nothing kept of its events, and the shots take turns; a shot's time is
 * the median of its samples. With threads a sample is a batch of the same shot. What is timed has been played once before: a
 * shot that ends in error, or by pooltool's models with another number of events than recorded, is refused. */
#include "bench_shots.h"

#include "bench_job.h"
#include "command.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "recorded.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 15 };
static const double sample_ns = 2e6;

typedef struct timed_shot {
  shot_line line;
  const char *family;
  double events, recorded_us, us;
  size_t loops;
  double sample[ROUNDS];
} timed_shot;

typedef struct shots_bench {
  const bench_job *job;
  shot_file *file; /* open as long as its tables are needed */
  carom_shot_options options;
  int threads;
  timed_shot *shot;
  size_t count, room;
  int code;
} shots_bench;

/* ---- Reading and verifying */

static bool verified(const timed_shot *t, const carom_shot_options *options, double *events) {
  carom_shot shot;
  const carom_status status = play_recorded(&t->line, options, &shot);
  free(shot.events);
  *events = (double)shot.count;
  if (status < 0)
    complain("line %zu: refused: %s", t->line.number, carom_status_string(status));
  if (status < 0 || options->world != CAROM_WORLD_POOLTOOL || options->cushion_model != 0)
    return status >= 0;
  const json_t *json = t->line.json, *sens = json_object_get(json, "sens");
  const json_int_t recorded = json_integer_value(json_object_get(json, "n_events"));
  const json_int_t same = json_integer_value(json_object_get(sens, "same_events"));
  if (json_object_get(json, "n_events") == NULL || shot.count + 2 == recorded || same < recorded)
    return true;
  complain("line %zu: refused: %lld events, not the %lld recorded", t->line.number, (long long)shot.count + 2,
           (long long)recorded);
  return false;
}

static bool read_shots(shots_bench *b, const char *path) {
  shot_file *file = b->file = shot_file_open(path);
  if (file == NULL)
    return false;
  const char *text;
  timed_shot t = {.us = NAN};
  shot_read what;
  while ((what = shot_file_next(file, &t.line, &text)) == SHOT_SHOT || what == SHOT_TABLE) {
    if (what == SHOT_TABLE)
      continue;
    if (t.line.error != NULL)
      complain("line %zu: refused: %s", t.line.number, t.line.error);
    if (t.line.error != NULL || !verified(&t, &b->options, &t.events)) {
      b->code = EXIT_SOME;
      shot_line_free(&t.line);
      continue;
    }
    const char *family = json_string_value(json_object_get(t.line.json, "family"));
    const json_t *recorded = json_object_get(t.line.json, "cpu_ms");
    t.family = family != NULL ? family : "-";
    t.recorded_us = json_is_number(recorded) ? 1e3 * json_number_value(recorded) : NAN;
    b->shot = grow(b->shot, &b->room, b->count + 1, sizeof *b->shot);
    b->shot[b->count++] = t;
  }
  if (what == SHOT_END && b->count == 0)
    complain("%s has no shots that can be timed", path);
  return what == SHOT_END && b->count > 0;
}

/* ---- Timing */

/* The processor's time with one thread, which other programs disturb least, as pooltool's was taken; else the clock on the
 * wall. */
static double now_ns(const shots_bench *b) {
  struct timespec t;
  clock_gettime(b->threads > 1 ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static double time_once(const shots_bench *b, const timed_shot *t, size_t loops, carom_shot *room) {
  const shot_line *line = &t->line;
  const double begin = now_ns(b);
  carom_shoot_batch(&line->table->table, line->ball, line->count, 1, &line->cue, 1, loops, &b->options, room, NULL);
  BENCH_CONSUME(room);
  return now_ns(b) - begin;
}

static void time_all(shots_bench *b) {
  size_t most = 1;
  for (size_t k = 0; k < b->count; k++) {
    carom_shot once = {0};
    timed_shot *t = &b->shot[k];
    double least = INFINITY;
    for (int turn = 0; turn < 5; turn++)
      least = fmin(least, time_once(&(shots_bench){.options = b->options, .threads = 1}, t, 1, &once));
    t->loops = (size_t)fmax(1.0, ceil(b->threads * sample_ns / least));
    most = t->loops > most ? t->loops : most;
  }
  carom_shot *room = allocate(most, sizeof *room);
  for (int round = 0; round < ROUNDS; round++)
    for (size_t k = 0; k < b->count; k++) {
      timed_shot *t = &b->shot[k];
      t->sample[round] = time_once(b, t, t->loops, room) / (double)t->loops / 1e3;
      progress_show("samples", (double)((size_t)round * b->count + k), (double)(ROUNDS * b->count));
    }
  progress_clear();
  free(room);
  for (size_t k = 0; k < b->count; k++)
    b->shot[k].us = summarise(b->shot[k].sample, ROUNDS).median;
}

/* ---- Printing */

/* One row: the shots of a family, or all. */
static void print_row(const shots_bench *b, const char *family, double *scratch) {
  double balls = 0.0, events = 0.0, us = 0.0, recorded = 0.0, slowest = INFINITY;
  size_t n = 0;
  for (size_t k = 0; k < b->count; k++) {
    const timed_shot *t = &b->shot[k];
    if (family != NULL && strcmp(family, t->family) != 0)
      continue;
    balls += t->line.count;
    events += t->events;
    us += t->us;
    recorded += t->recorded_us;
    slowest = fmin(slowest, t->recorded_us / t->us);
    scratch[n++] = t->us;
  }
  const double count = (double)n, median = summarise(scratch, n).median;
  char text[3][32]; /* NA where nothing was recorded */
  const double speed[3] = {recorded / count, recorded / us, slowest};
  for (int k = 0; k < 3; k++)
    snprintf(text[k], sizeof text[k], isfinite(recorded) ? k == 0 ? "%.1f" : "%.0f" : "NA", speed[k]);
  printf(b->job->csv ? "%s,%.2f,%zu,%.1f,%.3f,%.0f,%s,%s,%s\n" : "%-16s %6.2f %6zu %8.1f %10.3f %10.0f %12s %8s %8s\n",
         family != NULL ? family : "all", balls / count, n, events / count, median, 1e6 * count / us, text[0], text[1],
         text[2]);
}

static void print_all(const shots_bench *b) {
  double *scratch = allocate(b->count, sizeof *scratch);
  if (b->job->csv) {
    machine_describe(stdout);
    machine_note(stdout, "shots", "%s, %d thread%s",
                 b->options.world == CAROM_WORLD_POOLTOOL ? "pooltool's models" : "carom's models", b->threads,
                 b->threads == 1 ? "" : "s");
    puts("family,balls,shots,events_per_shot,us_median,shots_per_s,recorded_us,speedup,speedup_least");
  } else {
    printf("%-16s %6s %6s %8s %10s %10s %12s %8s %8s\n", "family", "balls", "shots", "events", "us_median", "shots_per_s",
           "recorded_us", "speedup", "least");
  }
  for (size_t k = 0; k < b->count; k++) {
    bool seen = false;
    for (size_t before = 0; before < k; before++)
      seen |= strcmp(b->shot[before].family, b->shot[k].family) == 0;
    if (!seen)
      print_row(b, b->shot[k].family, scratch);
  }
  print_row(b, NULL, scratch);
  free(scratch);
}

int bench_shots(const bench_job *job) {
  shots_bench b = {.job = job, .threads = job->threads.count > 0 ? job->threads.value[0] : 1, .code = EXIT_GOOD};
  b.options = (carom_shot_options){.world = job->models, .cushion_model = job->cushion_model, .threads = b.threads};
  if (read_shots(&b, job->shots)) {
    time_all(&b);
    print_all(&b);
  } else {
    b.code = EXIT_USAGE;
  }
  for (size_t k = 0; k < b.count; k++)
    shot_line_free(&b.shot[k].line);
  free(b.shot);
  if (b.file != NULL)
    shot_file_close(b.file);
  return b.code;
}
