/* `carom break`: what comes of many breaks of a rack, with a player's errors. */
#include "game/ways.h"
#include "pictures/picture.h"
#include "pictures/shot_picture.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/options.h"
#include "program/output.h"
#include "program/words.h"
#include "rows/quantities.h"
#include "shots/given_shots.h"
#include "shots/shoot_flags.h"
#include "shots/shot_file.h"
#include "shots/strokes.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STROKES = 64, BLOCK = 64, DRAWN = 40 };

typedef struct break_job {
  shoot_flags flags;
  const char *plot;
  int racks;
  bool csv, json, falls, nine_on_spot, best;
} break_job;

static const option_row option_rules = {.name = "rules",
                                        .help = "the rack, on the table of its game",
                                        .noun = "rack",
                                        .else_usual = "eightball",
                                        .set = set_named,
                                        .field = offsetof(break_job, flags.balls.rack),
                                        .least = CAROM_WORDS_RACK};

/* --rack nineball is short for --racks. */
static OPTION_SET(set_racks) {
  const char *word;
  for (int k = 0; (word = carom_word(CAROM_WORDS_RACK, k)) != NULL; k++)
    if (same_word(text, strlen(text), word, strlen(word)))
      return refuse_value(row, text, "the number of breaks is needed; try --rules %s", word);
  return set_count(row, text, field);
}

OPTION(break_job, option_racks, "racks", racks, "N", set_racks, 1,
       "breaks of each speed, tip and gap", .usual = "500");
FLAG(break_job, option_break_csv, "csv", csv, "write a row of CSV for each stroke and gap");
FLAG(break_job, option_break_json, "json", json,
     "write each break as the line of a shot with its final states, as `carom plan --from final` "
     "and others read it");
FLAG(break_job, option_falls, "falls", falls,
     "also report how often each ball falls into each pocket; with --csv, write only these rows");
FLAG(break_job, option_best, "best", best,
     "find the breaks that win most often for this player: position of the cue ball, speed, height "
     "of the tip and cut; and the cost of the player's errors");
FLAG(break_job, option_nine_on_spot, "nine-on-spot", nine_on_spot,
     "nine-ball's rack, with the 9 on the foot spot");
OPTION(break_job, option_break_plot, "plot", plot, "OUT", set_picture, 0,
       "draw the break without errors, forty breaks with errors as thin lines, and the results of "
       "all breaks");

typedef carom_break_counts counts;

typedef struct breaker {
  const break_job *job;
  carom_shot_options options;
  carom_player player;
  carom_rack_kind rack;
  bool aimed; /* --aim was given, */
  bool cut;   /* or --cut; else the middle of the ball in front */
} breaker;

/* The library's job for a stroke and a gap; its memory is to be freed. */
static carom_break_job job_of(const breaker *b, const shot_line *line, double gap) {
  carom_break_job job = {.table = &line->table->table,
                         .balls = line->ball,
                         .count = line->count,
                         .cue = &line->cue,
                         .player = &b->player,
                         .shot = &b->options,
                         .rack = (int32_t)b->rack,
                         .gap = gap,
                         .seed = (uint64_t)b->job->flags.seed.item[0].x,
                         .memory_size = carom_break_memory()};
  if (b->cut)
    job.aim = CAROM_BREAK_CUT;
  else if (b->aimed)
    job.aim = CAROM_BREAK_DIRECTION;
  job.memory = allocate(1, job.memory_size);
  return job;
}

/* Plays the breaks of one stroke and gap; false after a complaint. */
static bool play(const breaker *b, const shot_line *line, double gap, counts *c) {
  const carom_break_job job = job_of(b, line, gap);
  carom_status status = CAROM_OK;
  *c = (counts){0};
  for (int first = 0; first < b->job->racks && status >= 0; first += BLOCK) {
    int n = b->job->racks - first;
    if (n > BLOCK)
      n = BLOCK;
    status = carom_break_play(&job, first, n, c);
    progress_show("racks", first + n, b->job->racks);
  }
  progress_clear();
  free(job.memory);
  if (status < 0)
    complain("the break cannot be played: %s", carom_status_string(status));
  return status >= 0;
}

static double share(int64_t times, const counts *c) {
  return (double)times / (double)c->breaks;
}

/* The standard error of the chance to win. */
static double error_of_wins(const counts *c) {
  const double n = (double)c->breaks, mean = c->wins / n;
  return sqrt(fmax(c->win_squares / n - mean * mean, 0.0) / n);
}

/* The balls that fell in rows, pockets in columns: in how many of the breaks. */
static void tell_falls(FILE *out, const shot_line *line, const counts *c) {
  const carom_table *t = &line->table->table;
  fprintf(out, "  %%         ");
  for (int p = 0; p < t->pockets; p++)
    fprintf(out, "%12s", carom_pocket_name(t, p));
  fprintf(out, "%12s\n", "any");
  for (int k = 0; k < line->count; k++) {
    int64_t total = 0;
    for (int p = 0; p < t->pockets; p++)
      total += c->fell[k][p];
    if (total == 0)
      continue;
    fprintf(out, "  %-10s", line->name[k]);
    for (int p = 0; p < t->pockets; p++)
      fprintf(out, "%12.1f", 100.0 * share(c->fell[k][p], c));
    fprintf(out, "%12.1f\n", 100.0 * share(total, c));
  }
}

/* The balls and pockets that come together most often. */
static void tell_most_falls(FILE *out, const shot_line *line, const counts *c) {
  enum { TOLD = 3 };
  const carom_table *t = &line->table->table;
  bool is_listed[CAROM_BALLS_MOST][CAROM_POCKETS_MOST] = {{false}};
  for (int n = 0; n < TOLD; n++) {
    int ball = 0, pocket = 0;
    int64_t most = 0;
    for (int k = 0; k < line->count; k++)
      for (int p = 0; p < t->pockets; p++)
        if (!is_listed[k][p] && c->fell[k][p] > most) {
          most = c->fell[k][p];
          ball = k;
          pocket = p;
        }
    if (most == 0)
      break;
    is_listed[ball][pocket] = true;
    fprintf(out, "%s%s into %s in %.1f %%", n == 0 ? "  most often    " : ", ", line->name[ball],
            carom_pocket_name(t, pocket), 100.0 * share(most, c));
  }
  if (c->balls + c->scratches > 0)
    fputs("; --falls lists all\n", out);
}

static void tell(FILE *out, const breaker *b, const shot_line *line, double gap, const counts *c) {
  double r[2];
  const double far = carom_break_spread(c, r), p = share(c->makes, c);
  fprintf(out, "%s on the %s table, cue at %.3g m/s, ", carom_word(CAROM_WORDS_RACK, (int)b->rack),
          line->table->id, line->cue.speed);
  if (b->aimed || b->cut)
    fprintf(out, "aim %.2f degrees, ", line->cue.phi);
  if (line->cue.theta != 0.0)
    fprintf(out, "elevation %.3g degrees, ", line->cue.theta);
  fprintf(out, "tip %.2f right and %.2f above, gap %.3g mm: %lld breaks\n", 0.0 - line->cue.a,
          line->cue.b, 1e3 * gap, (long long)c->breaks);
  fprintf(out, "  make a ball   %5.1f %% (error %.1f); %.2f balls a break\n", 100.0 * p,
          100.0 * sqrt(p * (1.0 - p) / (double)c->breaks), share(c->balls, c));
  if (carom_break_has_rules(b->rack))
    fprintf(out, "  play on       %5.1f %% by the rules; fouls %.1f %%\n",
            100.0 * share(c->plays_on, c), 100.0 * share(c->fouls, c));
  if (carom_break_has_rules(b->rack))
    fprintf(out, "  win           %5.1f %% (error %.1f), by the value of what the break leaves\n",
            100.0 * c->wins / (double)c->breaks, 100.0 * error_of_wins(c));
  fprintf(out, "  cue ball      falls in %.1f %%; a ball leaves the table in %.1f %%\n",
          100.0 * share(c->scratches, c), 100.0 * share(c->off, c));
  fprintf(out, "  wing balls    one falls in %.1f %%\n", 100.0 * share(c->wing, c));
  if (c->stays > 0)
    fprintf(out, "  cue ball      rests about x = %.2f, y = %.2f m, give or take %.2f m\n", r[0],
            r[1], far);
  if (b->job->falls)
    tell_falls(out, line, c);
  else
    tell_most_falls(out, line, c);
}

/* What a row begins with: the stroke and the gap. */
static void begin_row(FILE *out, const breaker *b, const shot_line *line, double gap) {
  const carom_cue *cue = &line->cue;
  fprintf(out, "%s,%.17g,", carom_word(CAROM_WORDS_RACK, (int)b->rack), cue->speed);
  if (b->aimed || b->cut)
    fprintf(out, "%.17g", cue->phi);
  fprintf(out, ",%.17g,%.17g,%.17g,%.6g,", cue->theta, 0.0 - cue->a, cue->b, 1e3 * gap);
}

static void write_falls(FILE *out, const breaker *b, const shot_line *line, double gap,
                        const counts *c) {
  for (int k = 0; k < line->count; k++)
    for (int p = 0; p < line->table->table.pockets; p++) {
      begin_row(out, b, line, gap);
      fprintf(out, "%lld,%s,%s,%.6f\n", (long long)c->breaks, line->name[k],
              carom_pocket_name(&line->table->table, p), share(c->fell[k][p], c));
    }
}

static void write_row(FILE *out, const breaker *b, const shot_line *line, double gap,
                      const counts *c) {
  if (b->job->falls) {
    write_falls(out, b, line, gap, c);
    return;
  }
  double r[2];
  const double far = carom_break_spread(c, r), p = share(c->makes, c);
  begin_row(out, b, line, gap);
  fprintf(out, "%lld,%.6f,%.6f,%.6f,", (long long)c->breaks, p,
          sqrt(p * (1.0 - p) / (double)c->breaks), share(c->balls, c));
  if (carom_break_has_rules(b->rack))
    fprintf(out, "%.6f,%.6f,", share(c->plays_on, c), share(c->fouls, c));
  else
    fputs(",,", out);
  fprintf(out, "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,", share(c->scratches, c), share(c->off, c),
          share(c->wing, c), r[0], r[1], far);
  if (carom_break_has_rules(b->rack))
    fprintf(out, "%.6f,%.6f\n", c->wins / (double)c->breaks, error_of_wins(c));
  else
    fputs(",\n", out);
}

/* Writes the breaks of a stroke and gap as lines with their final states. False after a
 * complaint. */
static bool write_breaks(FILE *out, const breaker *b, const shot_line *line, double gap) {
  const carom_break_job job = job_of(b, line, gap);
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_status status = CAROM_OK;
  for (int k = 0; k < b->job->racks && status >= 0; k++) {
    shot_line each = *line;
    carom_shot shot = {.final = final};
    status = carom_break_stroke(&job, k, each.ball, &each.cue);
    if (status >= 0)
      status = shot_line_play(&each, &b->options, &shot);
    if (status >= 0) {
      each.json = shot_line_json(&each, json_integer(k + 1), &each.cue);
      shot_write(out, &each, &shot, status, EVENTS_NONE, NULL);
      json_decref(each.json);
    }
    free(shot.events);
    progress_show("racks", k + 1, b->job->racks);
  }
  progress_clear();
  free(job.memory);
  if (status < 0)
    complain("the break cannot be played: %s", carom_status_string(status));
  return status >= 0;
}

typedef struct drawn_break {
  played shot;
  const char *words;
} drawn_break;

static void draw(FILE *out, const void *data) {
  const drawn_break *d = data;
  shots_draw(out, &d->shot, 1, d->words);
}

/* Draws the breaks of a stroke and gap. */
static bool plot(const breaker *b, const shot_line *line, double gap, const char *words) {
  static carom_ball_state final[DRAWN + 1][CAROM_BALLS_MOST];
  static shot_line each;
  const carom_break_job job = job_of(b, line, gap);
  carom_shot shot[DRAWN + 1] = {0};
  const int drawn = b->job->racks < DRAWN ? b->job->racks : DRAWN;
  for (int k = drawn; k >= 0; k--) { /* the one without errors comes last, and stays in `each` */
    each = *line;
    carom_break_stroke(&job, k - 1, each.ball, &each.cue);
    shot[k].final = final[k];
    shot_line_play(&each, &b->options, &shot[k]);
  }
  const drawn_break drawing = {
      {.line = &each, .shot = &shot[0], .others = &shot[1], .others_count = drawn}, words};
  const bool good = svg_draw(b->job->plot, draw, &drawing);
  for (int k = 0; k <= drawn; k++)
    free(shot[k].events);
  free(job.memory);
  return good;
}

static const command_form form = {
    .name = "break",
    .usual =
        (const option_usual[]){
            {.name = "speed", .usual = "9", .else_usual = "unless --ball-speed is given"},
            {.name = "aim", .else_usual = "at the centre of the ball in front"},
            {.name = "cut",
             .else_usual = "none",
             .help = "cut angle on the ball in front; above 0 it goes to the left"},
            {.name = "table", .else_usual = "the game's table"},
            {.name = "cue",
             .else_usual = "its position in the rack",
             .help =
                 "position of the cue ball: X,Y in m or with a unit, 2,3ft; in diamonds from the "
                 "left and head rails, 2,2d; at a rail, head,2d; or a name such as head-spot"},
            {0}},
    .usage = "[OPTIONS]",
    .about = "Plays many breaks, each with a new rack and a player's errors, and reports how often "
             "a ball, the cue ball and a wing ball fall and how often the player continues, where "
             "the cue ball comes to rest, and which ball falls into which pocket. Each stroke and "
             "gap is reported separately.\n",
    .options = (const option_row *const[]){&option_rules,
                                           &option_nine_on_spot,
                                           &option_racks,
                                           &option_gap,
                                           &option_one_seed,
                                           &option_table,
                                           &option_cue,
                                           &option_aim,
                                           &option_shot_cut,
                                           &option_shot_speed,
                                           &option_ball_speed,
                                           &option_tip,
                                           &option_elevation,
                                           &option_player,
                                           &option_player_errors,
                                           &options_of_motion,
                                           &option_with_of_shots,
                                           &option_best,
                                           &option_falls,
                                           &option_break_csv,
                                           &option_break_json,
                                           &option_break_plot,
                                           &option_threads,
                                           &option_output,
                                           NULL},
    .details =
        "columns of --csv: "
        "rules,speed,aim,elevation,right,above,gap_mm,racks,makes,makes_error,balls,plays_"
        "on,foul,scratch,off,wing,x,y,spread,wins,wins_error\n"
        "  aim                  degrees, by --aim or --cut; else empty\n"
        "  makes plays_on foul scratch off wing  fractions of the breaks; by the rules of "
        "eight-ball "
        "and nine-ball, empty for other racks\n"
        "  balls                balls made in a break\n"
        "  x y spread           mean position of the cue balls that stay, and their standard "
        "deviation, m\n"
        "  wins wins_error      chance to win by the value of the layout after the break, and its "
        "error\n"
        "  with --falls, from makes on: ball,pocket,share\n"
        "\n"
        "exit code: 0; 2 for bad usage\n",
    .example = "carom break --rules nineball --speed 8,9,10m/s --gap 0.1mm --racks 500",
    .files = NO_FILES,
};

/* Tells the breaks that win most often. */
static bool tell_best(FILE *out, const breaker *b, const shot_line *line, double gap) {
  static carom_break_choice choice[CAROM_BREAK_CHOICES];
  enum { TOLD = 3 };
  const carom_break_job job = job_of(b, line, gap);
  const carom_status status = carom_break_best(&job, b->job->racks, choice, TOLD);
  free(job.memory);
  if (status < 0) {
    complain("--best: %s",
             status == CAROM_ERROR_OPTIONS
                 ? "too few breaks or no break; give 16 --racks or more and eightball or nineball"
                 : carom_status_string(status));
    return false;
  }
  for (int k = 0; k < TOLD; k++) {
    const carom_break_choice *of = &choice[k];
    const counts *c = &of->counts;
    fprintf(out,
            "%d. wins %.1f %% (error %.1f): %s, cue ball at %.3f, %.3f m, cue at %.3g m/s, tip "
            "%.2f above, raised %.1f, aim %.2f degrees%s\n",
            k + 1, 100.0 * c->wins / (double)c->breaks, 100.0 * error_of_wins(c),
            carom_word(CAROM_WORDS_RACK, (int)b->rack), of->place[0], of->place[1], of->cue.speed,
            of->cue.b, of->cue.theta, of->cue.phi,
            text_if(of->aim == CAROM_BREAK_FULL, ", at the middle"));
    fprintf(out, "   makes a ball in %.1f %%, plays on in %.1f %%, fouls in %.1f %%\n",
            100.0 * share(c->makes, c), 100.0 * share(c->plays_on, c), 100.0 * share(c->fouls, c));
  }
  fprintf(out,
          "without errors the first one would win more often by %.1f %%: without those of speed "
          "by %.1f, of aim by %.1f, of the tip by %.1f %%\n",
          100.0 * choice[0].cost, 100.0 * choice[0].speed_cost, 100.0 * choice[0].aim_cost,
          100.0 * choice[0].tip_cost);
  return true;
}

/* Tells all strokes and gaps, and those of the first one to *words, which are to be freed; false
 * after a complaint. */
static bool tell_all(breaker *b, const shot_line *first, const carom_cue *stroke, int strokes,
                     const values *gaps, FILE *out, char **words) {
  if (b->job->csv)
    fprintf(
        out, "rules,speed,aim,elevation,right,above,gap_mm,racks,%s\n",
        b->job->falls
            ? "ball,pocket,share"
            : "makes,makes_error,balls,plays_on,foul,scratch,off,wing,x,y,spread,wins,wins_error");
  for (int g = 0; g < gaps->count; g++)
    for (int k = 0; k < strokes; k++) {
      const double gap = gaps->item[g].x;
      shot_line line = *first;
      counts c;
      line.cue = stroke[k];
      if (b->job->best) {
        if (!tell_best(out, b, &line, gap))
          return false;
        continue;
      }
      if (b->job->json) {
        if (!write_breaks(out, b, &line, gap))
          return false;
        continue;
      }
      if (!play(b, &line, gap, &c))
        return false;
      if (b->job->csv)
        write_row(out, b, &line, gap, &c);
      else
        tell(out, b, &line, gap, &c);
      if (*words == NULL) {
        size_t size;
        FILE *stream = open_text(words, &size);
        tell(stream, b, &line, gap, &c);
        close_text(stream, words);
      }
    }
  return true;
}

/* Takes the gaps from the flags, of which each is a row of its own; false after a complaint. */
static bool take_gaps(shoot_flags *f, values *gaps) {
  if (f->gap.count == 0)
    fill_usual(f, &option_gap);
  *gaps = f->gap;
  f->gap.count = 0;
  for (int g = 0; g < gaps->count; g++)
    if (!(gaps->item[g].x >= 0.0 && gaps->item[g].x <= GAP_MOST)) {
      complain("--gap '%s': out of range; give 0 to %g m", gaps->item[g].name, GAP_MOST);
      return false;
    }
  return true;
}

/* Plays, tells and draws the breaks of the strokes of a file; an exit code. */
static int run(breaker *b, const shot_line *line, const carom_cue *stroke, int strokes,
               const values *gaps) {
  const break_job *job = b->job;
  FILE *out = output_open(job->flags.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  char *words = NULL;
  int code = EXIT_USAGE;
  if (!tell_all(b, line, stroke, strokes, gaps, out, &words))
    output_abandon();
  else if (output_commit()) {
    const bool drawn = job->plot == NULL || plot(b, line, gaps->item[0].x, words);
    code = exit_of(drawn);
  }
  free(words);
  return code;
}

/* Whether the results are asked for in one form; complains if not. */
static bool has_one_form(const break_job *job) {
  const bool has_other = job->csv || job->falls || job->plot != NULL;
  if (job->json && (job->best || has_other)) {
    complain("--json excludes --csv, --falls, --plot and --best; give one of them");
    return false;
  }
  if (job->best && has_other) {
    complain("--best excludes --csv, --falls, --plot and --json; give one of them");
    return false;
  }
  return true;
}

int command_break(int argc, char **argv) {
  static break_job job;
  static carom_cue stroke[MOST_STROKES];
  static shot_line line;
  static values gaps;
  job = (break_job){
      .flags = {.shared = {.options = COMMAND_OPTIONS}, .balls = {.rack = CAROM_RACK_EIGHTBALL}}};
  const int parsed = parse_arguments(&form, argc, argv, &job, NULL);
  if (parsed >= 0)
    return parsed;
  shoot_flags *f = &job.flags;
  breaker b = {.job = &job,
               .options = f->shared.shot,
               .rack = (carom_rack_kind)f->balls.rack,
               .aimed = f->aim.count > 0,
               .cut = f->cut.count > 0};
  b.options.threads = f->shared.options.threads;
  if (!player_of(&f->shared.player, &b.player) || !svg_possible(job.plot))
    return EXIT_USAGE;
  without_bounds(&b.player);

  if (!has_one_form(&job))
    return EXIT_USAGE;

  /* the rack stands on the table of its game, and breaks have a speed of their own */
  if (job.nine_on_spot)
    b.rack = CAROM_RACK_NINEONSPOT;
  f->balls.rack = 1 + (int)b.rack;
  if (f->table.kind == 0)
    f->table.kind = 1 + (int)table_of_rack(b.rack);
  if (f->speed.count == 0 && f->ball_speed.count == 0)
    fill_usual(f, &option_shot_speed);
  if (f->aim.count == 0 && f->cut.count == 0)
    values_default(&f->aim, MEASURE_ANGLE, "90"); /* until the ball in front is known */
  if (!take_gaps(f, &gaps))
    return EXIT_USAGE;
  shot_file *file = flags_open(f, &b.options, MOST_STROKES);
  const int strokes =
      file != NULL ? strokes_read(file, &f->shared, &line, stroke, MOST_STROKES) : 0;
  const int code = strokes > 0 ? run(&b, &line, stroke, strokes, &gaps) : EXIT_USAGE;
  if (strokes > 0)
    shot_line_free(&line);
  if (file != NULL)
    shot_file_close(file);
  return code;
}
