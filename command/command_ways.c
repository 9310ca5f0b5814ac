/* `carom ways`: the ways to pot a ball, to score on a table without pockets, or to bring the cue
 * ball to a place. ways.c finds them; here they are asked for and told. */
#include "game/position.h"
#include "game/ways.h"
#include "pictures/picture.h"
#include "pictures/shot_picture.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/options.h"
#include "program/output.h"
#include "program/words.h"
#include "shots/shoot_aim.h"
#include "shots/shoot_flags.h"
#include "shots/shot_fault.h"
#include "shots/shot_file.h"
#include "shots/strokes.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STROKES = 320, MOST_DRAWN = 8 };
/* directions of all strokes together; of pots at least so many of each: steps of 0.2 degrees find
 * every window of 0.2 degrees */
enum { SCANNED = 20000, SCANNED_EACH = 1800, SCANNED_TO_SCORE = 100000 };

typedef struct ways_job {
  shoot_flags flags;
  leave leave;
  const char *ball, *pocket, *plot;
  int rails, scanned;
  bool csv, json, each;
} ways_job;

OPTION(ways_job, option_ball, "ball", ball, "NAME|any", set_text, 0, "the ball to be potted",
       .else_usual = "any");
OPTION(ways_job, option_to_pocket, "pocket", pocket, "NAME|any", set_text, 0,
       "the pocket into which it is to fall, such as foot-left", .else_usual = "any");
OPTION(ways_job, option_rails, "rails", rails, "0|1|2", set_choice, 0,
       "largest number of rails in banks, kicks and caroms", .usual = "2");
OPTION(ways_job, option_leave, "leave", leave, LEAVE_ARGUMENT, set_leave, 0,
       "the cue ball must come to rest within R (0.15 m) of this position, 2d,4d,20cm or "
       "foot-spot,20cm. The chance includes this, so carom reports the best of several speeds and "
       "tips. Without other balls, carom finds the ways to send the cue ball there");
OPTION(ways_job, option_scan, "scan", scanned, "N", set_count, 1,
       "how many strokes in all directions to try",
       .else_usual =
           "20000, or 1800 for each speed and tip if that is more; 100000 for points or only "
           "a cue ball");
FLAG(ways_job, option_each, "each", each,
     "report every stroke with which a way succeeds, in order, instead of the best one; this "
     "shows the range of speeds and tips");
FLAG(ways_job, option_ways_csv, "csv", csv, "write rows of CSV");
FLAG(ways_job, option_ways_json, "json", json,
     "write the stroke of each way as a line for `carom shoot`, with an object `way`");
OPTION(ways_job, option_ways_plot, "plot", plot, "OUT", set_picture, 0,
       "draw the eight best ways over each other");

/* ---- What is told */

enum { PARTS_TEXT = 160, WAY_TEXT = 400, CUT_TEXT = 24 };

/* "left, 2": the rails and balls of a way. */
static const char *parts_text(const ways_search *s, const way *w, char text[PARTS_TEXT]) {
  text[0] = '\0';
  for (int k = 0; k < w->parts; k++) {
    const int index = w->part[k].index;
    const char *name;
    if (w->part[k].kind == CAROM_PART_BALL)
      name = s->line->name[index];
    else
      name = text_or(carom_rail_name(&s->line->table->table, index), s->line->table->rail[index]);
    snprintf(text + strlen(text), PARTS_TEXT - strlen(text), "%s%s", text_if(k > 0, ", "), name);
  }
  return text;
}

/* "1 to foot-left, bank: left" */
static const char *way_text(const ways_search *s, const way *w, char text[WAY_TEXT]) {
  char parts[PARTS_TEXT];
  const named_table *t = s->line->table;
  parts_text(s, w, parts);
  if (w->ball < 0)
    snprintf(text, WAY_TEXT, "%s", text_or(parts, "straight"));
  else
    snprintf(text, WAY_TEXT, "%s to %s, %s%s%s", s->line->name[w->ball],
             text_or(carom_pocket_name(&t->table, w->pocket), t->pocket[w->pocket]), way_name(s, w),
             text_if(w->parts > 0, ": "), parts);
  return text;
}

/* "30.6 left"; nothing where the cut is not known. */
static const char *cut_text(const way *w, char text[CUT_TEXT]) {
  text[0] = '\0';
  if (!isnan(w->cut))
    snprintf(text, CUT_TEXT, "%.1f %s", fabs(w->cut), left_or_right(w->cut));
  return text;
}

/* The line of a way's stroke. */
static json_t *way_line(const ways_search *s, const way *w) {
  char text[WAY_TEXT], parts[PARTS_TEXT];
  json_t *written = shot_line_json(s->line, json_string(way_text(s, w, text)), &w->cue);
  json_t *about = json_pack("{s: s, s: s, s: f, s: f, s: [f, f]}", "kind", way_name(s, w), "by",
                            parts_text(s, w, parts), "chance", w->chance, "error", w->error,
                            "window", w->phi[0], w->phi[1]);
  if (w->ball < 0)
    json_object_set_new(about, "share", json_real((double)w->found / (double)s->result.scanned));
  else
    json_object_set_new(about, "ball", json_string(s->line->name[w->ball]));
  if (!isnan(w->cut))
    json_object_set_new(about, "cut", json_real(w->cut));
  json_object_set_new(written, "way", about);
  return written;
}

static void tell(FILE *out, const ways_search *s) {
  const bool counted = s->job.goal != CAROM_WAY_POT;
  char text[WAY_TEXT];
  if (s->result.ways == 0)
    fputs("There is no way.\n", out);
  else
    fprintf(out, "    chance   window  %s   speed   tip           aim  way\n",
            counted ? "    of all" : "       cut");
  for (int k = 0; k < s->result.ways; k++) {
    const way *w = &s->way[k];
    char middle[CUT_TEXT];
    if (counted)
      snprintf(middle, sizeof middle, "%.3f %%",
               100.0 * (double)w->found / (double)s->result.scanned);
    else
      cut_text(w, middle);
    fprintf(out, "%8.1f %% %8.2f  %10s %7.3g  %+.2f,%+.2f  %7.2f  %s\n", 100.0 * w->chance,
            w->phi[1] - w->phi[0], middle, w->cue.speed, 0.0 - w->cue.a, w->cue.b, w->cue.phi,
            way_text(s, w, text));
  }
  if (counted)
    fprintf(out, "%lld of %lld strokes %s, %.2f %%, by %lld ways.\n", (long long)s->result.good,
            (long long)s->result.scanned, s->job.goal == CAROM_WAY_SCORE ? "score" : "get there",
            100.0 * (double)s->result.good / (double)(s->result.scanned + !s->result.scanned),
            (long long)s->result.ways);
}

static void write_rows(FILE *out, const ways_search *s) {
  char parts[PARTS_TEXT];
  fputs("rank,kind,ball,pocket,way,speed,phi,theta,a,b,cut,phi_low,phi_high,speed_low,speed_high,"
        "chance,error,found,scanned\n",
        out);
  for (int k = 0; k < s->result.ways; k++) {
    const way *w = &s->way[k];
    const char *ball = "", *pocket = "";
    if (w->ball >= 0)
      ball = s->line->name[w->ball];
    if (w->pocket >= 0)
      pocket = s->line->table->pocket[w->pocket];
    fprintf(out, "%d,%s,%s,%s,\"%s\",%.17g,%.17g,%.17g,%.17g,%.17g,", k + 1, way_name(s, w), ball,
            pocket, parts_text(s, w, parts), w->cue.speed, w->cue.phi, w->cue.theta, w->cue.a,
            w->cue.b);
    const double more[] = {w->cut, w->phi[0], w->phi[1], w->speed[0], w->speed[1]};
    for (size_t n = 0; n < sizeof more / sizeof more[0]; n++)
      fprintf(out, isnan(more[n]) ? "," : "%.10g,", more[n]);
    fprintf(out, "%.6f,%.6f,%lld,%lld\n", w->chance, w->error, (long long)w->found,
            (long long)s->result.scanned);
  }
}

typedef struct drawn_ways {
  const played *shot;
  int count;
  const char *words;
} drawn_ways;

static void draw(FILE *out, const void *data) {
  const drawn_ways *d = data;
  shots_draw(out, d->shot, d->count, d->words);
}

static bool plot(const ways_search *s, const char *path) {
  static shot_line line[MOST_DRAWN];
  static carom_shot shot[MOST_DRAWN];
  static carom_ball_state final[MOST_DRAWN][CAROM_BALLS_MOST];
  static played drawn[MOST_DRAWN];
  int count = MOST_DRAWN;
  if (s->result.ways < MOST_DRAWN)
    count = (int)s->result.ways;
  if (count == 0) {
    complain("nothing to draw: there is no way");
    return false;
  }
  char *words;
  size_t size;
  FILE *stream = open_text(&words, &size);
  for (int k = 0; k < count; k++)
    fprintf(stream, "%d: chance %.1f %%, window %.2f degrees, %.3g m/s\n", k + 1,
            100.0 * s->way[k].chance, s->way[k].phi[1] - s->way[k].phi[0], s->way[k].cue.speed);
  close_text(stream, &words);
  for (int k = 0; k < count; k++) {
    line[k] = *s->line;
    line[k].cue = s->way[k].cue;
    char text[WAY_TEXT];
    line[k].title = copy_text(way_text(s, &s->way[k], text)); /* for the legend */
    shot[k] = (carom_shot){.final = final[k]};
    shot_line_play(&line[k], &s->options, &shot[k]);
    drawn[k] = (played){.line = &line[k], .shot = &shot[k]};
  }
  const drawn_ways drawing = {drawn, count, words};
  const bool good = svg_draw(path, draw, &drawing);
  for (int k = 0; k < count; k++) {
    free(shot[k].events);
    free(line[k].title);
  }
  free(words);
  return good;
}

/* ---- The command */

/* Sets *ball to the ball of a name, -1 for any; false after a complaint. */
static bool read_ball(const ways_search *s, const char *name, int *ball) {
  char known[NAMES_TEXT] = "any", hint[HINT_TEXT];
  *ball = -1;
  if (name == NULL || strcmp(name, "any") == 0)
    return true;
  for (int k = 0; k < s->line->count; k++) {
    if (k == s->line->cue.ball || is_out_of_play(&s->line->ball[k].state))
      continue;
    if (strcmp(s->line->name[k], name) == 0) {
      *ball = k;
      return true;
    }
    snprintf(known + strlen(known), sizeof known - strlen(known), "|%s", s->line->name[k]);
  }
  complain("--ball '%.40s': no such ball in the layout; try %s", name,
           words_to_try(name, known, hint));
  return false;
}

/* Sets *pocket to the pocket of a name or an id, -1 for any; false after a complaint. */
static bool read_pocket(const ways_search *s, const char *name, int *pocket) {
  char known[NAMES_TEXT] = "any|", hint[HINT_TEXT];
  *pocket = -1;
  if (name == NULL || strcmp(name, "any") == 0)
    return true;
  *pocket = pocket_named(&s->line->table->table, s->line->table->pocket, name, known);
  if (*pocket >= 0)
    return true;
  complain("--pocket '%.40s': no such pocket; try %s (--help lists them)", name,
           words_to_try(name, known, hint));
  return false;
}

/* Asks for the ways of a job, and sorts them; false after a complaint. */
static bool find(const ways_job *job, ways_search *s) {
  const carom_table *t = &s->line->table->table;
  char fault[FAULT_TEXT];
  if (!read_ball(s, job->ball, &s->job.ball) || !read_pocket(s, job->pocket, &s->job.pocket))
    return false;
  s->job.goal = CAROM_WAY_POT;
  if (job->leave.is_set && s->line->count == 1)
    s->job.goal = CAROM_WAY_PLACE;
  else if (t->pockets == 0)
    s->job.goal = CAROM_WAY_SCORE;
  leave_into(&job->leave, s);
  if (s->job.goal == CAROM_WAY_SCORE && s->line->count < 3) {
    complain("three balls are needed to score; give two with --balls");
    return false;
  }
  if (s->job.goal == CAROM_WAY_POT && s->line->count < 2) {
    complain("there is no ball to pot; give --balls, or --leave for the cue ball");
    return false;
  }
  if (shot_fault(s->line, &s->options, fault)) {
    complain("the layout cannot be played: %s", fault);
    return false;
  }
  return ways_find(s);
}

#define SPEEDS_TO_POT "1.5,2.5,4"
#define SPEEDS_TO_LEAVE "1:4:0.5"
#define SPEEDS_TO_SCORE "3,4.5,6"
#define SPEEDS_ALONE "0.5:5:0.25"
#define TIPS_TO_SCORE "0,0.25:0.3,0.2:-0.3,0.2"

static const command_form form = {
    .name = "ways",
    .usual = (const option_usual[]){{.name = "speed",
                                     .usual = SPEEDS_TO_POT,
                                     .else_usual = SPEEDS_TO_LEAVE
                                     " with --leave, " SPEEDS_ALONE
                                     " for only a cue ball, " SPEEDS_TO_SCORE " to score"},
                                    {.name = "tip",
                                     .usual = "0,0.25",
                                     .else_usual = TIPS_TO_LEAVE
                                     " with --leave and other balls, " TIPS_TO_SCORE " to score"},
                                    {0}},
    .usage = "[OPTIONS] LAYOUT.jsonl | --balls X,Y:... [OPTIONS]",
    .about =
        "Finds the ways to pot a ball: directly, rail first, or by a bank, kick, kiss, carom or "
        "combination. On a table without pockets it finds the ways to score in three-cushion: "
        "the rails and balls that the cue ball meets. For each way carom reports the stroke with "
        "the best chance for a player: how often it succeeds with errors, and the directions in "
        "which it succeeds without. LAYOUT has shots of one layout; carom tries the stroke of each "
        "in all directions.\n",
    .options =
        (const option_row *const[]){
            &option_ball,          &option_to_pocket,  &option_rails,      &option_leave,
            &option_each,          &option_scan,       &option_table,      &option_cue,
            &option_balls,         &option_one_gap,    &option_one_seed,   &option_shot_speed,
            &option_ball_speed,    &option_tip,        &option_elevation,  &option_player,
            &option_player_errors, &option_player_eye, &options_of_motion, &option_with_of_shots,
            &option_cue_ball,      &option_layout,     &option_ways_csv,   &option_ways_json,
            &option_ways_plot,     &option_threads,    &option_output,     NULL},
    .details =
        "columns:\n"
        "  chance               how many of 400 strokes with errors succeed: the ball falls and "
        "the "
        "cue ball does not, or the stroke scores; and the cue ball meets --leave\n"
        "  window               range of the cue's direction, degrees\n"
        "  cut                  of the cue ball on its first ball, degrees; in three-cushion "
        "instead "
        "the fraction of all strokes\n"
        "  speed                of the cue, m/s\n"
        "  tip                  right and above, R\n"
        "  aim                  degrees from +x\n"
        "  way                  the rails and balls that are met, in order\n"
        "\n"
        "columns of --csv: "
        "rank,kind,ball,pocket,way,speed,phi,theta,a,b,cut,phi_low,phi_high,speed_low,speed_high,"
        "chance,error,found,scanned\n"
        "Pots with a window below 0.02 degrees are left out.\n"
        "\n"
        "exit code: 0; 1 if there is no way; 2 for bad usage or unreadable input\n",
    .example = "carom ways --cue 0.6,0.8 --balls 0.3,1.9:0.9,1.7 --ball 1 --plot ways.svg",
    .files = FILE_OR_NONE,
};

/* The speeds where none are given, m/s. */
static const char *usual_speeds(const ways_job *job, bool alone, bool points) {
  if (alone)
    return SPEEDS_ALONE;
  if (points)
    return SPEEDS_TO_SCORE;
  if (job->leave.is_set)
    return SPEEDS_TO_LEAVE;
  return SPEEDS_TO_POT;
}

/* How many strokes in all directions are searched: as asked, or the default, at least one each. */
static int scan_of(const ways_job *job, const shot_line *line, int strokes) {
  int scan = SCANNED_EACH * strokes;
  if (scan < SCANNED)
    scan = SCANNED;
  if (line->table->table.pockets == 0 || line->count == 1)
    scan = SCANNED_TO_SCORE;
  if (job->scanned > 0)
    scan = job->scanned;
  if (scan < strokes)
    scan = strokes;
  return scan;
}

/* Fills in the strokes that are usual in the game, where the options give none. */
static void fill_strokes(ways_job *job) {
  shoot_flags *flags = &job->flags;
  const bool points = flags->table.kind == 1 + CAROM_TABLE_THREECUSHION;
  const bool alone = job->leave.is_set && flags->balls.count == 0 && flags->balls.rack == 0;
  const bool by_options = has_flags(flags);
  if (by_options && flags->speed.count == 0 && flags->ball_speed.count == 0)
    values_default(&flags->speed, MEASURE_SPEED, usual_speeds(job, alone, points));
  if (flags->tip.count > 0)
    return;
  if (points) {
    char tips[] = TIPS_TO_SCORE;
    option_tip.set(&option_tip, tips, &flags->tip);
  } else if (by_options && job->leave.is_set && !alone) {
    char tips[] = TIPS_TO_LEAVE;
    option_tip.set(&option_tip, tips, &flags->tip);
  }
}

/* Writes each way as the line of its stroke. */
static void write_lines(FILE *out, const ways_search *s) {
  for (int k = 0; k < s->result.ways; k++)
    shot_json_write(out, way_line(s, &s->way[k]));
}

/* Finds the ways, writes them to the output, which is open, and draws them; an exit code. */
static int write_ways(const ways_job *job, ways_search *s, FILE *out) {
  if (!find(job, s)) {
    output_abandon();
    return EXIT_USAGE;
  }
  if (job->csv)
    write_rows(out, s);
  else if (job->json)
    write_lines(out, s);
  else
    tell(out, s);
  if (!output_commit())
    return EXIT_USAGE;
  if (job->plot != NULL && !plot(s, job->plot))
    return EXIT_SOME;
  return exit_of(s->result.ways > 0);
}

/* The ways of the layout and the strokes of a file; an exit code. */
static int ways_of_file(const ways_job *job, ways_search *s, shot_file *file) {
  static carom_cue stroke[MOST_STROKES];
  static shot_line line;
  s->line = &line;
  const int strokes = strokes_read(file, &job->flags.shared, &line, stroke, MOST_STROKES);
  if (strokes == 0)
    return EXIT_USAGE;
  int code = EXIT_USAGE;
  FILE *out = output_open(job->flags.shared.output);
  if (out != NULL) {
    ways_begin(s, stroke, strokes, MOST_WAYS);
    s->job.scan = scan_of(job, &line, strokes);
    s->way = allocate(MOST_WAYS, sizeof *s->way);
    code = write_ways(job, s, out);
    free(s->way);
    free(s->job.memory);
  }
  shot_line_free(&line);
  return code;
}

int command_ways(int argc, char **argv) {
  static ways_job job;
  const char *path;
  job = (ways_job){.flags = {.shared = {.options = COMMAND_OPTIONS}}};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  ways_search s = {.options = job.flags.shared.shot, .job = {.rails = job.rails, .each = job.each}};
  s.options.threads = job.flags.shared.options.threads;
  if (!player_of(&job.flags.shared.player, &s.player) || !svg_possible(job.plot))
    return EXIT_USAGE;
  without_bounds(&s.player);
  if (job.csv && job.json) {
    complain("--csv and --json exclude each other; give one of them");
    return EXIT_USAGE;
  }

  if (job.flags.table.kind == 0 && job.flags.balls.rack > 0)
    job.flags.table.kind = 1 + (int)table_of_rack((carom_rack_kind)(job.flags.balls.rack - 1));
  fill_strokes(&job);
  shot_file *file = layout_open(&job.flags, path, &s.options, MOST_STROKES);
  if (file == NULL)
    return EXIT_USAGE;
  const int code = ways_of_file(&job, &s, file);
  shot_file_close(file);
  return code;
}
