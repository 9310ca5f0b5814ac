/* `carom-lab bench --shots`: whole shots, beside the time that pooltool took for each.
 *
 * A subject of the engine is one shot, nothing kept of its events; with threads, a batch of
 * copies of it that takes about 2 ms. What is timed has been played once before: a shot that
 * ends in error, or by pooltool's models with another number of events than recorded, is
 * refused. With one thread the clock is the processor's time, which other programs disturb
 * least, as pooltool's was taken. */
#include "bench_job.h"
#include "command.h"
#include "machine.h"
#include "memory.h"
#include "message.h"
#include "monotonic.h"
#include "shot_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double sample_ns = 2e6, seconds_a_shot = 0.06;

typedef struct timed_shot {
  shot_line line;
  const char *family;
  double events, recorded_us;
  carom_shot_options options;
  size_t copies; /* in a pass */
  carom_shot *room;
} timed_shot;

/* The table's own part of a job. */
struct timed_shots {
  shot_file *file; /* open as long as its tables are needed */
  timed_shot *shot;
  size_t count, space;
};

/* ---- Reading and verifying */

static bool verified(timed_shot *t) {
  const carom_shot_options *options = &t->options;
  carom_shot shot = {0};
  const carom_status status = shot_line_play(&t->line, options, &shot);
  free(shot.events);
  t->events = (double)shot.count;
  if (status < 0)
    complain("line %zu: refused: %s", t->line.number, carom_status_string(status));
  if (status < 0 || options->world != CAROM_WORLD_POOLTOOL || options->cushion_model != 0)
    return status >= 0;
  const json_t *json = t->line.json, *sens = json_object_get(json, "sens");
  const json_int_t recorded = json_integer_value(json_object_get(json, "n_events"));
  const json_int_t same = json_integer_value(json_object_get(sens, "same_events"));
  if (json_object_get(json, "n_events") == NULL || shot.count + 2 == recorded || same < recorded)
    return true;
  complain("line %zu: refused: %lld events, not the %lld recorded", t->line.number,
           (long long)shot.count + 2, (long long)recorded);
  return false;
}

static bool read_shots(bench_job *job) {
  struct timed_shots *all = job->timed_shots = allocate(1, sizeof *all);
  if ((all->file = shot_file_open(job->shots)) == NULL)
    return false;
  timed_shot t = {.options = job->shared.shot};
  t.options.threads = job->threads.count > 0 ? job->threads.value[0] : 1;
  shot_read what;
  while ((what = shot_file_next_shot(all->file, &t.line)) == SHOT_SHOT) {
    if (t.line.error != NULL)
      complain("line %zu: refused: %s", t.line.number, t.line.error);
    if (t.line.error != NULL || !verified(&t)) {
      job->code = EXIT_SOME;
      shot_line_free(&t.line);
      continue;
    }
    const char *family = json_string_value(json_object_get(t.line.json, "family"));
    const json_t *recorded = json_object_get(t.line.json, "cpu_ms");
    t.family = family != NULL ? family : "-";
    t.recorded_us = json_is_number(recorded) ? 1e3 * json_number_value(recorded) : NAN;
    all->shot = grow(all->shot, &all->space, all->count + 1, sizeof *all->shot);
    all->shot[all->count++] = t;
  }
  if (what == SHOT_END && all->count == 0)
    complain("%s has no shots that can be timed", job->shots);
  return what == SHOT_END && all->count > 0;
}

/* ---- Timing */

static void play(void *context) {
  const timed_shot *t = context;
  const shot_line *line = &t->line;
  const carom_shot_job job = {.table = &line->table->table,
                              .balls = line->ball,
                              .cues = &line->cue,
                              .count = line->count,
                              .n = t->copies,
                              .options = &t->options,
                              .shots = t->room};
  carom_shoot_batch(&job);
  BENCH_CONSUME(t->room);
}

static uint64_t fingerprint(const void *context) {
  const timed_shot *t = context;
  uint64_t hash = 0;
  for (size_t k = 0; k < t->copies; k++)
    hash ^= bench_fingerprint(&t->room[k], sizeof t->room[k]) * (k + 1);
  return hash;
}

/* As many copies as keep all threads busy for a sample. */
static void make_room(timed_shot *t) {
  t->copies = 1;
  t->room = allocate(1, sizeof *t->room);
  if (t->options.threads == 1)
    return;
  double least = INFINITY;
  for (int turn = 0; turn < 5; turn++) {
    const double begin = processor_ns();
    play(t);
    least = fmin(least, processor_ns() - begin);
  }
  free(t->room);
  t->copies = (size_t)fmax(1.0, ceil(t->options.threads * sample_ns / least));
  t->room = allocate(t->copies, sizeof *t->room);
}

static bool choose(bench_job *job) {
  if (!read_shots(job))
    return false;
  job->subject = allocate(job->timed_shots->count, sizeof *job->subject);
  for (size_t k = 0; k < job->timed_shots->count; k++) {
    timed_shot *t = &job->timed_shots->shot[k];
    make_room(t);
    play(t);
    job->subject[job->subject_count++] = (bench_subject){.kernel = t->family,
                                                         .config = "library",
                                                         .threads = t->options.threads,
                                                         .pairs = t->copies,
                                                         .resolve = play,
                                                         .fingerprint = fingerprint,
                                                         .context = t,
                                                         .verified = fingerprint(t),
                                                         .reference = SIZE_MAX};
  }
  if (job->timed_shots->shot[0].options.threads == 1)
    job->now = processor_ns;
  if (job->budget == 0.0)
    job->budget = seconds_a_shot * (double)job->timed_shots->count;
  return true;
}

/* ---- Printing */

/* One row: the shots of a family, or all. */
static void print_row(const bench_job *job, FILE *out, const char *family, double *scratch) {
  double balls = 0.0, events = 0.0, us = 0.0, recorded = 0.0, slowest = INFINITY;
  size_t n = 0;
  for (size_t k = 0; k < job->timed_shots->count; k++) {
    const timed_shot *t = &job->timed_shots->shot[k];
    const double one = job->figure[k].ns.median / 1e3;
    if ((family != NULL && strcmp(family, t->family) != 0) || !job->figure[k].unchanged)
      continue;
    balls += t->line.count;
    events += t->events;
    us += one;
    recorded += t->recorded_us;
    slowest = fmin(slowest, t->recorded_us / one);
    scratch[n++] = one;
  }
  const double count = (double)n, median = summarise(scratch, n).median;
  char text[3][32]; /* NA where nothing was recorded */
  const double speed[3] = {recorded / count, recorded / us, slowest};
  for (int k = 0; k < 3; k++)
    snprintf(text[k], sizeof text[k], isfinite(recorded) ? k == 0 ? "%.1f" : "%.0f" : "NA",
             speed[k]);
  fprintf(out,
          job->csv ? "%s,%.2f,%zu,%.1f,%.3f,%.0f,%s,%s,%s\n"
                   : "%-16s %6.2f %6zu %8.1f %10.3f %10.0f %12s %8s %8s\n",
          family != NULL ? family : "all", balls / count, n, events / count, median,
          1e6 * count / us, text[0], text[1], text[2]);
}

static void print(const bench_job *job, FILE *out) {
  double *scratch = allocate(job->timed_shots->count, sizeof *scratch);
  const carom_shot_options *options = &job->timed_shots->shot[0].options;
  if (job->csv) {
    fputs(job->machine, out);
    machine_note(out, "pinning", "%s", job->pinning);
    machine_note(out, "shots", "%s, %d thread%s",
                 options->world == CAROM_WORLD_POOLTOOL ? "pooltool's models" : "carom's models",
                 options->threads, options->threads == 1 ? "" : "s");
    fputs("family,balls,shots,events_per_shot,us_median,shots_per_s,recorded_us,speedup,speedup_"
          "least\n",
          out);
  } else {
    fprintf(out, "%-16s %6s %6s %8s %10s %10s %12s %8s %8s\n", "family", "balls", "shots", "events",
            "us_median", "shots_per_s", "recorded_us", "speedup", "least");
  }
  for (size_t k = 0; k < job->timed_shots->count; k++) {
    bool seen = false;
    for (size_t before = 0; before < k; before++)
      seen |= strcmp(job->timed_shots->shot[before].family, job->timed_shots->shot[k].family) == 0;
    if (!seen)
      print_row(job, out, job->timed_shots->shot[k].family, scratch);
  }
  print_row(job, out, NULL, scratch);
  free(scratch);
}

static void release(bench_job *job) {
  for (size_t k = 0; k < job->timed_shots->count; k++) {
    shot_line_free(&job->timed_shots->shot[k].line);
    free(job->timed_shots->shot[k].room);
  }
  free(job->timed_shots->shot);
  if (job->timed_shots->file != NULL)
    shot_file_close(job->timed_shots->file);
  free(job->timed_shots);
}

const bench_table bench_of_shots = {.choose = choose, .print = print, .release = release};
