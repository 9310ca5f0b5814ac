/* --sequence of `carom plan`: the run-out as one answer, in words or as lines, with a picture of
 * its strokes and landing zones. */
#include "plan_sequence.h"

#include "game/plan_words.h"
#include "pictures/plan_picture.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "shots/shoot_aim.h"
#include "shots/shot_story.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest loss of value within a landing zone; shots of a plan in run-outs that are played. */
static const double within = 0.03;
enum { PLAYED_SHOTS = 300 };

/* The layout from which stroke k is played: that of the line, or what the stroke before leaves. */
static void lay_out(shot_line *placed, const shot_line *line, const carom_sequence_stroke *strokes,
                    int k) {
  const carom_plan_stroke *c = &strokes[k].choice;
  *placed = *line;
  if (k > 0)
    memcpy(placed->ball, strokes[k - 1].ruling.balls, (size_t)line->count * sizeof placed->ball[0]);
  placed->ball[0].state = (carom_ball_state){
      .r = {c->place[0], c->place[1], line->ball[0].kind.radius}, .label = CAROM_BALL_STATIONARY};
  placed->cue = c->cue;
}

/* The chance of the whole, by run-outs that were played, and its standard error. */
static double chance_of(const carom_sequence_counts *counts, double *error) {
  const double n = (double)counts->plays, chance = (double)counts->runs / n;
  *error = sqrt(chance * (1.0 - chance) / n);
  return chance;
}

static void tell_stroke(FILE *out, const shot_line *line, const carom_sequence_stroke *s, int k,
                        bool hand) {
  char text[PLAN_TEXT], pocket[WHERE_TEXT], ball[BALL_TEXT];
  const double *rest = s->ruling.balls[0].state.r;
  plan_describe(line, &s->choice, text);
  fprintf(out, "%d. %s\n", k + 1, text);
  plan_tell_stroke(out, &s->choice, hand);
  fprintf(out, "   tolerance    speed %.2f to %.2f m/s, direction %.2f to %.2f degrees\n",
          s->speed[0], s->speed[1], s->phi[0], s->phi[1]);
  fputs("   cue ball     ", out);
  if (s->ruling.turn.outcome == CAROM_TURN_KEEP)
    fprintf(out, "to %.2f, %.2f m; in its zone %.0f %%, elsewhere %.0f %%, ", rest[0], rest[1],
            100.0 * s->zone_share, 100.0 * s->stray_share);
  fprintf(out, "misses %.0f %%\n", 100.0 * (1.0 - s->zone_share - s->stray_share));
  if (s->turn_ball >= 0)
    fprintf(out, "   from there   %s into %s instead, in %.0f %%\n",
            named_ball(line->name[s->turn_ball], ball),
            pocket_words(line->table, s->turn_pocket, pocket), 100.0 * s->turn_share);
}

/* Writes a stroke as its line, from its own layout. */
static void write_stroke(FILE *out, const shot_line *placed, const carom_sequence_stroke *s,
                         const carom_sequence_counts *counts) {
  char text[PLAN_TEXT];
  double error;
  json_t *zone = json_array();
  const bool has_zone = s->zone[0][0] != s->zone[1][0] || s->zone[0][1] != s->zone[1][1];
  for (int k = 0; k < CAROM_ZONE_CORNERS && has_zone; k++)
    json_array_append_new(zone, json_pack("[f, f]", s->zone[k][0], s->zone[k][1]));
  plan_describe(placed, &s->choice, text);
  json_t *written = shot_line_json(placed, json_string(text), &s->choice.cue);
  json_t *sequence = json_pack("{s: o, s: f, s: f, s: [f, f], s: [f, f]}", "zone", zone,
                               "zone_share", s->zone_share, "stray_share", s->stray_share, "speed",
                               s->speed[0], s->speed[1], "phi", s->phi[0], s->phi[1]);
  if (s->turn_ball >= 0)
    json_object_set_new(sequence, "turn",
                        json_pack("{s: s, s: i, s: f}", "ball", placed->name[s->turn_ball],
                                  "pocket", s->turn_pocket, "share", s->turn_share));
  if (counts->plays > 0)
    json_object_set_new(sequence, "run_out", json_real(chance_of(counts, &error)));
  json_object_set_new(written, "sequence", sequence);
  shot_json_write(out, written);
}

static void tell_whole(FILE *out, bool wins, const carom_sequence_counts *counts) {
  double error;
  if (!wins)
    fputs("The plan stops here: it finds no ball that is sure to fall.\n", out);
  if (counts->plays == 0)
    return;
  const double chance = chance_of(counts, &error);
  fprintf(out, "The run-out: %.0f %% (error %.0f) of %lld that were played with errors.\n",
          100.0 * chance, 100.0 * error, (long long)counts->plays);
}

/* Plays the run-outs, with progress. */
static carom_status play(const carom_plan_job *job, const sequence_question *question,
                         carom_sequence_counts *counts) {
  carom_status status = CAROM_OK;
  for (int n = 0; n < question->plays && status == CAROM_OK; n++) {
    progress_show("run-outs", n, question->plays);
    status = carom_sequence_play(job, question->hand, n, 1, counts);
  }
  progress_clear();
  return status;
}

/* The run-out that was planned last, with the layout of each stroke. */
static carom_sequence_stroke strokes[CAROM_SEQUENCE_MOST];
static shot_line layouts[CAROM_SEQUENCE_MOST];
static int planned_strokes;

bool plan_sequence_draw(const char *path) {
  return sequence_draw(path, layouts, strokes, planned_strokes);
}

carom_status plan_sequence(FILE *out, const carom_plan_job *request, const shot_line *line,
                           const sequence_question *question) {
  carom_plan_options options = *request->options;
  carom_plan_job job = *request;
  carom_sequence_counts counts = {0};
  int n = 0;
  job.options = &options;
  job.memory_size = carom_sequence_memory(&options);
  job.memory = allocate(1, job.memory_size);
  carom_status status =
      carom_sequence(&job, question->hand, within, strokes, CAROM_SEQUENCE_MOST, &n);
  if (options.shots == 0 || options.shots > PLAYED_SHOTS)
    options.shots = PLAYED_SHOTS;
  if (status == CAROM_OK)
    status = play(&job, question, &counts);
  free(job.memory);
  if (status != CAROM_OK)
    return status;
  for (int k = 0; k < n; k++) {
    lay_out(&layouts[k], line, strokes, k);
    if (question->json)
      write_stroke(out, &layouts[k], &strokes[k], &counts);
    else
      tell_stroke(out, line, &strokes[k], k, question->hand && k == 0);
  }
  const bool wins = strokes[n - 1].ruling.turn.outcome == CAROM_TURN_WIN;
  if (!question->json)
    tell_whole(out, wins, &counts);
  planned_strokes = n;
  return CAROM_OK;
}
