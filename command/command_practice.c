/* `carom practice`: what the strokes of a player cost in recorded matches, and drills of those that
 * cost most. */
#include "game/match_lines.h"
#include "game/ways.h"
#include "program/program.h"
#include "subcommands.h"

#include "carom_coach.h"

#include <inttypes.h>

typedef struct practice_job {
  shared_options shared; /* --output, --player, --errors */
  int seat, drills;
  bool csv;
} practice_job;

OPTION(practice_job, option_seat, "seat", seat, "1|2", set_choice, 0,
       "the player whose strokes are reviewed", .usual = "1");
OPTION(practice_job, option_drills, "drills", drills, "N", set_count, 1, "number of drills",
       .usual = "3");
FLAG(practice_job, option_csv, "csv", csv,
     "write the drills as rows for the web page, on a 9-ft pool table");

static const command_form form = {
    .name = "practice",
    .usual =
        (const option_usual[]){
            {.name = "player", .else_usual = "the rating of the seat, if it has one"}, {0}},
    .usage = "[OPTIONS] GAMES",
    .about = "Reviews each stroke of a player in concatenated recordings of `carom match`: the "
             "intended pot, how often a player of this rating makes it, and the cost of the "
             "stroke. Makes drills of the costliest strokes, from the costliest kind of stroke. "
             "GAMES may be -.\n",
    .options = (const option_row *const[]){&option_seat, &option_player, &option_player_errors,
                                           &option_drills, &option_csv, &option_output, NULL},
    .details = "columns of --csv: name,text,balls,goal,rating\n"
               "  balls                number:x,y of each ball, m; 0 is the cue ball\n"
               "  goal                 the required result: pot=N@POCKET cue=X,Y,R\n"
               "  rating               of a player who succeeds in half of the attempts\n"
               "\n"
               "exit code: 0; 2 for bad usage or unreadable input\n",
    .example = "carom practice --seat 2 game.jsonl",
    .files = ONE_FILE,
};

/* A stroke with the match before it. */
typedef struct stroke {
  carom_review review;
  carom_shot_ball balls[CAROM_BALLS_MOST];
  carom_plan_rules rules;
} stroke;

/* The strokes of a file, and the match that is read. */
typedef struct games {
  const practice_job *job;
  const char *path;
  carom_player player;
  stroke *stroke;
  size_t count, room;
  int64_t line;
} games;

static carom_match match;

static carom_plan_job job_of(const games *g, const stroke *s) {
  return (carom_plan_job){.table = &match.record.table,
                          .balls = s->balls,
                          .count = match.record.count,
                          .cue = &s->review.aim,
                          .player = &g->player,
                          .rules = &s->rules,
                          .shot = &match.record.options};
}

/* Reviews the last stroke, by the match before it; false after a complaint. */
static bool review_stroke(games *g, const carom_match *before) {
  g->stroke = grow(g->stroke, &g->room, g->count + 1, sizeof *g->stroke);
  stroke *s = &g->stroke[g->count];
  const double rating = match.seating.seat[before->seat].rating;
  const given_player *given = &g->job->shared.player;
  if (!given->rated && !given->errs && rating >= 200.0)
    g->player = carom_player_rated(rating, (carom_rules_kind)match.record.rules);
  memcpy(s->balls, match.before, sizeof s->balls);
  s->rules = before->rules;
  s->review.aim = match.stroke;
  const carom_plan_job job = job_of(g, s);
  const carom_cue played = match.stroke;
  const carom_status status = carom_review_of(&job, &played, before->call, &s->review);
  if (status == CAROM_OK) {
    g->count++;
    return true;
  }
  complain("%s: line %" PRId64 ": strokes of %s cannot be reviewed: a game of two sides with "
           "pockets is needed",
           g->path, g->line, carom_word(CAROM_WORDS_RULES, (int)match.record.rules));
  return false;
}

static bool read_line(void *context, const char *line, size_t size) {
  static carom_match before;
  games *g = context;
  g->line++;
  before = match;
  if (!match_line_read(&match, g->path, line, size))
    return false;
  const bool is_stroke =
      before.phase == CAROM_MATCH_STROKE && match.record.shots > before.record.shots;
  if (!is_stroke || before.seat != g->job->seat || before.rules.state.opening != 0 ||
      before.call.ball == CAROM_CALL_PUSH)
    return true;
  return review_stroke(g, &before);
}

/* Sums over the strokes of a group. */
typedef struct group_sums {
  int strokes, kept;
  double told, miss_cost, place_cost, off, squares;
} group_sums;

static void tell_groups(FILE *out, const group_sums sums[CAROM_PRACTICE_OTHER + 1]) {
  fprintf(out, "%-24s %7s %5s %5s %12s %13s %s\n", "", "strokes", "kept", "due", "misses cost",
          "places cost", "aim to the left, degrees");
  for (int k = 0; k <= CAROM_PRACTICE_OTHER; k++) {
    const group_sums *s = &sums[k];
    if (s->strokes == 0)
      continue;
    fprintf(out, "%-24s %7d %5d", carom_word_text(CAROM_WORDS_PRACTICE, k), s->strokes, s->kept);
    if (k < CAROM_PRACTICE_INDIRECT) {
      const double mean = s->off / s->strokes;
      fprintf(out, " %5.1f %12.2f %13.2f %6.2f, give or take %.2f", s->told, s->miss_cost,
              s->place_cost, mean, sqrt(fmax(s->squares / s->strokes - mean * mean, 0.0)));
    }
    putc('\n', out);
  }
  fputs("costs are games: the chances to win that strokes lost, less those that they won\n", out);
}

/* The balls of a layout as an option or a row names them. */
static void tell_balls(FILE *out, const stroke *s, bool csv) {
  const char *between = "";
  for (int k = csv ? 0 : 1; k < match.record.count; k++)
    if (s->balls[k].state.label == CAROM_BALL_STATIONARY) {
      const double *r = s->balls[k].state.r;
      fprintf(out, csv ? "%s%d:%.4f,%.4f" : "%s%d=%.4f,%.4f", between, k, r[0], r[1]);
      between = csv ? " " : ":";
    }
}

static void tell_drill(FILE *out, const games *g, const stroke *s, int number) {
  const carom_plan_job job = job_of(g, s);
  carom_drill drill;
  if (carom_drill_of(&job, &s->review, &drill) != CAROM_OK)
    return;
  char text[200], place[80] = "";
  const carom_review *review = &s->review;
  if (drill.radius > 0.0)
    snprintf(place, sizeof place, " Leave the cue ball within %.2f m of %.2f and %.2f m.",
             drill.radius, drill.place[0], drill.place[1]);
  const char *pocket = carom_pocket_name(&match.record.table, drill.pocket);
  snprintf(text, sizeof text, "Pot the %d into the %s pocket: a cut of %.0f degrees over %.1f m.%s",
           drill.ball, pocket, fabs(review->cut), review->distance, place);
  if (g->job->csv) {
    fprintf(out, "\"%s %d\",\"%s\",\"", carom_word_text(CAROM_WORDS_PRACTICE, review->group),
            number, text);
    tell_balls(out, s, true);
    fprintf(out, "\",\"pot=%d@%s", drill.ball, pocket);
    if (drill.radius > 0.0)
      fprintf(out, " cue=%.4f,%.4f,%.4f", drill.place[0], drill.place[1], drill.radius);
    fprintf(out, "\",%.0f\n", drill.rating);
    return;
  }
  fprintf(out, "drill %d  %s A %.0f makes it in half of the tries.\n", number, text, drill.rating);
  fprintf(out, "         it cost %.2f games; --cue %.4f,%.4f --balls ",
          review->miss_cost + review->place_cost, s->balls[0].state.r[0], s->balls[0].state.r[1]);
  tell_balls(out, s, false);
  putc('\n', out);
}

static double cost_of(const stroke *s) {
  return s->review.miss_cost + s->review.place_cost;
}

/* Tells the groups, and drills of the group that costs most. */
static void tell(FILE *out, const games *g) {
  group_sums sums[CAROM_PRACTICE_OTHER + 1] = {{0}};
  for (size_t k = 0; k < g->count; k++) {
    const carom_review *r = &g->stroke[k].review;
    group_sums *s = &sums[r->group];
    s->strokes++;
    s->kept += r->kept;
    s->told += r->told;
    s->miss_cost += r->miss_cost;
    s->place_cost += r->place_cost;
    s->off += r->off;
    s->squares += r->off * r->off;
  }
  int worst = 0;
  for (int k = 1; k < CAROM_PRACTICE_INDIRECT; k++)
    if (sums[k].miss_cost + sums[k].place_cost > sums[worst].miss_cost + sums[worst].place_cost)
      worst = k;
  if (g->job->csv)
    fputs("name,text,balls,goal,rating\n", out);
  else
    tell_groups(out, sums);

  /* each drill is of the stroke that cost most, of those that cost less than the one before */
  double last = INFINITY;
  for (int n = 1; n <= g->job->drills; n++) {
    const stroke *next = NULL;
    for (size_t k = 0; k < g->count; k++) {
      const stroke *s = &g->stroke[k];
      const bool is_open = s->review.group == worst && cost_of(s) < last && cost_of(s) > 0.0;
      if (is_open && (next == NULL || cost_of(s) > cost_of(next)))
        next = s;
    }
    if (next == NULL)
      break;
    last = cost_of(next);
    tell_drill(out, g, next, n);
  }
}

int command_practice(int argc, char **argv) {
  static practice_job job;
  job = (practice_job){0};
  games g = {.job = &job};
  const int parsed = parse_arguments(&form, argc, argv, &job, &g.path);
  if (parsed >= 0)
    return parsed;
  bool good = player_of(&job.shared.player, &g.player) && input_lines(g.path, read_line, &g);
  if (good && g.count == 0) {
    complain("%s: player %d has no stroke after a break", g.path, job.seat + 1);
    good = false;
  }
  carom_table pool;
  carom_table_make(CAROM_TABLE_POOL_9FT, &pool);
  if (good && job.csv && memcmp(&pool, &match.record.table, sizeof pool) != 0) {
    complain("--csv: %s is not played on a 9-ft pool table, which the page's drills have", g.path);
    good = false;
  }
  FILE *out = good ? output_open(job.shared.output) : NULL;
  if (out != NULL)
    tell(out, &g);
  free(g.stroke);
  return out != NULL && output_commit() ? EXIT_GOOD : EXIT_USAGE;
}
