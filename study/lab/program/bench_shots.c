/* `carom-lab bench --shots`: complete shots, compared with the time that pooltool took for each.
 *
 * A subject of the engine is one shot, nothing kept of its events; with threads, a batch of
 * 64 copies of it for each. What is timed has been played once before: a shot that
 * ends in error, or by pooltool's models with another number of events than recorded, is
 * rejected. With one thread the clock is the processor's time, which other programs disturb
 * least, as pooltool's was taken. */
#include "bench_job.h"
#include "machine.h"
#include "program/program.h"
#include "sheet.h"
#include "shots/shot_file.h"

enum { COPIES = 64 };
static const double seconds_a_shot = 0.06;

typedef struct timed_shot {
  shot_line line;
  const char *family;
  double events, recorded_us;
  carom_shot_options options;
  size_t copies; /* in a pass */
  carom_shot *room;
} timed_shot;

static struct {
  shot_file *file; /* open as long as its tables are needed */
  timed_shot *shot;
  size_t count, space;
} timed;

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
  if ((timed.file = shot_file_open(job->shots, CAROM_SHOT_CUSHION_DEFAULT, LAYOUT_START)) == NULL)
    return false;
  timed_shot t = {.options = job->shared.shot};
  t.options.threads = 1;
  if (job->threads.count > 0)
    t.options.threads = atoi(job->threads.name[0]);
  shot_read what;
  while ((what = shot_file_next_shot(timed.file, &t.line)) == SHOT_SHOT) {
    if (t.line.error != NULL)
      complain("line %zu: refused: %s", t.line.number, t.line.error);
    if (t.line.error != NULL || !verified(&t)) {
      job->code = EXIT_SOME;
      shot_line_free(&t.line);
      continue;
    }
    const char *family = json_string_value(json_object_get(t.line.json, "family"));
    const json_t *recorded = json_object_get(t.line.json, "cpu_ms");
    t.family = text_or(family, "-");
    t.recorded_us = NAN;
    if (json_is_number(recorded))
      t.recorded_us = 1e3 * json_number_value(recorded);
    timed.shot = grow(timed.shot, &timed.space, timed.count + 1, sizeof *timed.shot);
    timed.shot[timed.count++] = t;
  }
  if (what == SHOT_END && timed.count == 0)
    complain("%s has no shots that can be timed", job->shots);
  return what == SHOT_END && timed.count > 0;
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

static bool choose(bench_job *job) {
  if (!read_shots(job))
    return false;
  job->subject_count = timed.count;
  job->subject = allocate(timed.count, sizeof *job->subject);
  for (size_t k = 0; k < timed.count; k++) {
    timed_shot *t = &timed.shot[k];
    t->copies = 1;
    if (t->options.threads > 1)
      t->copies = COPIES * (size_t)t->options.threads;
    t->room = allocate(t->copies, sizeof *t->room);
    play(t);
    job->subject[k] = (bench_subject){.name = t->family,
                                      .context = t,
                                      .resolve = play,
                                      .fingerprint = fingerprint,
                                      .pairs = t->copies,
                                      .threads = t->options.threads,
                                      .reference = SIZE_MAX};
  }
  if (timed.shot[0].options.threads == 1)
    job->clock = processor_ns;
  if (job->budget == 0.0)
    job->budget = seconds_a_shot * (double)timed.count;
  return true;
}

/* ---- Printing */

/* One row: the shots of a family, or all; NA where nothing was recorded. */
static void print_row(const bench_job *job, FILE *out, const char *family, double *us) {
  double balls = 0.0, events = 0.0, sum = 0.0, recorded = 0.0, slowest = INFINITY;
  size_t n = 0;
  for (size_t k = 0; k < timed.count; k++) {
    const timed_shot *t = &timed.shot[k];
    if ((family != NULL && !same_text(family, t->family)) || !job->figure[k].unchanged)
      continue;
    us[n] = job->figure[k].ns.median / 1e3;
    balls += t->line.count;
    events += t->events;
    sum += us[n];
    recorded += t->recorded_us;
    slowest = fmin(slowest, t->recorded_us / us[n++]);
  }
  const double count = (double)n;
  fprintf(out, "%s,%.2f,%zu,%.1f,%.3f,%.0f", text_or(family, "all"), balls / count, n,
          events / count, summarise(us, n).median, 1e6 * count / sum);
  if (isfinite(recorded))
    fprintf(out, ",%.1f,%.0f,%.0f\n", recorded / count, recorded / sum, slowest);
  else
    fputs(",NA,NA,NA\n", out);
}

static void print(const bench_job *job, FILE *out) {
  const carom_shot_options *options = &timed.shot[0].options;
  double *scratch = allocate(timed.count, sizeof *scratch);
  sheet table;
  const char *whose = "carom";
  if (options->world == CAROM_WORLD_POOLTOOL)
    whose = "pooltool";
  machine_note(out, "shots", "%s's models, %d thread%s", whose, options->threads,
               text_if(options->threads != 1, "s"));
  FILE *rows = sheet_begin(&table, out, job->csv);
  fputs("family,balls,shots,events_per_shot,us_median,shots_per_s,recorded_us,speedup,"
        "speedup_least\n",
        rows);
  for (size_t k = 0; k < timed.count; k++) {
    bool seen = false;
    for (size_t earlier = 0; earlier < k; earlier++)
      seen |= same_text(timed.shot[earlier].family, timed.shot[k].family);
    if (!seen)
      print_row(job, rows, timed.shot[k].family, scratch);
  }
  print_row(job, rows, NULL, scratch);
  sheet_end(&table, rows);
  free(scratch);
}

const bench_table bench_of_shots = {.choose = choose, .print = print};
