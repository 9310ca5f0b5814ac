/* `carom break`: what comes of many breaks of a rack, with a player's errors. */
#include "game/ways.h"
#include "pictures/picture.h"
#include "pictures/shot_picture.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/options.h"
#include "program/output.h"
#include "rows/quantities.h"
#include "shots/shoot_flags.h"
#include "shots/shot_file.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STROKES = 64, BLOCK = 64, DRAWN = 40 };

typedef struct break_job {
  shoot_flags flags;
  const char *plot;
  int racks;
  bool csv, falls, nine_on_spot;
} break_job;

static const option_row option_rules = {.name = "rules",
                                        .help = "the rack, on the table of its game",
                                        .else_usual = "eightball",
                                        .set = set_named,
                                        .field = offsetof(break_job, flags.balls.rack),
                                        .least = CAROM_WORDS_RACK};

/* --rack nineball is short for --racks. */
static OPTION_SET(set_racks) {
  const char *word;
  for (int k = 0; (word = carom_word(CAROM_WORDS_RACK, k)) != NULL; k++)
    if (strcmp(word, text) == 0) {
      complain("--racks is how many breaks are played; --rules %s names the rack", word);
      return false;
    }
  return set_count(row, text, field);
}

OPTION(break_job, option_racks, "racks", racks, 0, "N", set_racks, 1,
       "breaks of each speed, tip and gap", .usual = "500");
OPTION(break_job, option_break_csv, "csv", csv, 0, NULL, set_flag, 0,
       "write a row for each stroke and gap instead of words");
OPTION(break_job, option_falls, "falls", falls, 0, NULL, set_flag, 0,
       "report also which balls fall into which pockets, and how often. With --csv, each ball and "
       "pocket has a row, instead of the other rows");
OPTION(break_job, option_nine_on_spot, "nine-on-spot", nine_on_spot, 0, NULL, set_flag, 0,
       "nine-ball's rack, with the 9 on the foot spot");
OPTION(break_job, option_break_plot, "plot", plot, 0, "OUT", set_picture, 0,
       "draw the break without errors, forty breaks with errors as thin lines, and the results of "
       "all breaks");

/* What came of the breaks of one stroke and gap: how many, and sums over the cue balls that stayed
 * on the table. */
typedef struct counts {
  int breaks, makes, plays_on, fouls, scratch, off, wing, balls, stay;
  int fell[CAROM_BALLS_MOST][CAROM_POCKETS_MOST];
  double x, y, squares;
} counts;

/* The balls that lie farthest to either side of the rack, as a set. */
static uint32_t wings_of(const carom_table *t, const carom_shot_ball *ball, int count) {
  double most = 0.0;
  uint32_t wings = 0;
  for (int k = 1; k < count; k++)
    most = fmax(most, fabs(ball[k].state.r[0] - 0.5 * t->width));
  for (int k = 1; k < count; k++)
    if (fabs(ball[k].state.r[0] - 0.5 * t->width) > most - 0.5 * ball[k].kind.radius)
      wings |= (uint32_t)1 << k;
  return wings;
}

/* The game of a rack, the first of those that have it; false where carom has none. */
static bool game_of(carom_rack_kind rack, carom_rules_kind *kind) {
  const carom_rules_about *about;
  if (rack == CAROM_RACK_NINEONSPOT)
    rack = CAROM_RACK_NINEBALL;
  for (int k = 0; (about = carom_rules_about_of((carom_rules_kind)k)) != NULL; k++)
    if (about->rack == (int32_t)rack) {
      *kind = (carom_rules_kind)k;
      return true;
    }
  return false;
}

/* The rules of a rack's game, at a break; false where carom has none. */
static bool rules_of(carom_rack_kind rack, carom_plan_rules *rules) {
  carom_rules_kind kind;
  if (!game_of(rack, &kind))
    return false;
  *rules = carom_plan_rules_of(kind);
  rules->state.opening = 1;
  return rules->breaks == 1;
}

/* The direction from the cue ball to the ball in front, degrees. */
static double direction_of_front(const carom_shot_ball *ball, int count) {
  const double *start = ball[0].state.r, *end = ball[ball_in_front(ball, count)].state.r;
  return atan2(end[1] - start[1], end[0] - start[0]) / degree;
}

typedef struct breaker {
  const break_job *job;
  carom_shot_options options;
  carom_player player;
  carom_rack_kind rack;
  bool aimed; /* --aim was given, */
  bool cut;   /* or --cut; else the middle of the ball in front */
} breaker;

/* Rack number k and its stroke; number -1 is the first one without errors. */
static void set_up(const breaker *b, const shot_line *line, double gap, int number,
                   carom_shot_ball *ball, carom_cue *cue) {
  const int seed = (int)b->job->flags.seed.at[0].x;
  const int k = number < 0 ? 0 : number;
  carom_rack(b->rack, &line->table->table, gap, (uint64_t)(seed + k), ball, CAROM_BALLS_MOST);
  for (int n = 0; n < line->count; n++)
    ball[n].kind = line->ball[n].kind;
  ball[0].state = line->ball[0].state;
  *cue = line->cue;

  /* A cut is that in the line's own rack; others have the cue as far beside the ball in front. */
  if (!b->aimed)
    cue->phi = direction_of_front(ball, line->count);
  if (b->cut)
    cue->phi += line->cue.phi - direction_of_front(line->ball, line->count);
  if (number >= 0)
    carom_player_strike(&b->player, (uint64_t)seed, (uint64_t)k, cue);
}

static void count_break(const breaker *b, const carom_facts *f, const carom_ball_state *final,
                        uint32_t wings, counts *c) {
  int potted = 0;
  for (int k = 0; f->down >> k != 0; k++)
    if ((f->down >> k & 1) != 0) {
      potted += k > 0;
      c->fell[k][f->pocket[k]]++;
    }
  c->breaks++;
  c->balls += potted;
  c->makes += potted > 0;
  c->scratch += (carom_stroke_marks(f, 0) & CAROM_MARK_SCRATCH) != 0;
  c->off += f->off != 0;
  c->wing += (f->down & wings) != 0;
  carom_plan_rules rules;
  if (rules_of(b->rack, &rules)) {
    const uint32_t in_play = ((uint32_t)1 << carom_rack_size(b->rack)) - 1;
    const carom_turn turn = rules.judge(&rules.state, in_play, 0, f, (carom_call){-1, -1});
    c->plays_on += turn.outcome == CAROM_TURN_KEEP || turn.outcome == CAROM_TURN_WIN;
    c->fouls += turn.foul != 0;
  }
  if (((f->down | f->off) & 1) == 0) {
    c->stay++;
    c->x += final[0].r[0];
    c->y += final[0].r[1];
    c->squares += final[0].r[0] * final[0].r[0] + final[0].r[1] * final[0].r[1];
  }
}

/* Plays the breaks of one stroke and gap; false after a complaint. */
static bool play(const breaker *b, const shot_line *line, double gap, counts *c) {
  static carom_shot_ball ball[BLOCK][CAROM_BALLS_MOST];
  static carom_cue cue[BLOCK];
  static carom_shot shot[BLOCK];
  static carom_facts facts[BLOCK];
  static carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  *c = (counts){0};
  for (int start = 0; start < b->job->racks; start += BLOCK) {
    int n = b->job->racks - start;
    if (n > BLOCK)
      n = BLOCK;
    for (int k = 0; k < n; k++) {
      set_up(b, line, gap, start + k, ball[k], &cue[k]);
      shot[k] = (carom_shot){.facts = &facts[k], .final = final[k]};
    }
    const carom_shot_job job = {.table = &line->table->table,
                                .balls = ball[0],
                                .cues = cue,
                                .count = line->count,
                                .ball_stride = CAROM_BALLS_MOST,
                                .cue_stride = 1,
                                .n = (uint64_t)n,
                                .options = &b->options,
                                .shots = shot};
    const carom_status status = carom_shoot_batch(&job);
    if (status < 0) {
      progress_clear();
      complain("the break cannot be played: %s", carom_status_string(status));
      return false;
    }
    for (int k = 0; k < n; k++) /* the seed draws which balls lie there */
      count_break(b, &facts[k], final[k], wings_of(&line->table->table, ball[k], line->count), c);
    progress_show("racks", start + n, b->job->racks);
  }
  progress_clear();
  return true;
}

static double share(int times, const counts *c) {
  return (double)times / c->breaks;
}

/* How far cue balls end from their mean place, m, a standard deviation; NAN where none stays. */
static double around(const counts *c, double *x, double *y) {
  *x = c->x / c->stay;
  *y = c->y / c->stay;
  return c->stay > 0 ? sqrt(fmax(c->squares / c->stay - *x * *x - *y * *y, 0.0)) : NAN;
}

/* The balls that fell in rows, pockets in columns: in how many of the breaks. */
static void tell_falls(FILE *out, const shot_line *line, const counts *c) {
  const carom_table *t = &line->table->table;
  fprintf(out, "  %%         ");
  for (int p = 0; p < t->pockets; p++)
    fprintf(out, "%12s", carom_pocket_name(t, p));
  fprintf(out, "%12s\n", "any");
  for (int k = 0; k < line->count; k++) {
    int total = 0;
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
    int ball = 0, pocket = 0, most = 0;
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
  if (c->balls + c->scratch > 0)
    fputs("; --falls lists all\n", out);
}

static void tell(FILE *out, const breaker *b, const shot_line *line, double gap, const counts *c) {
  carom_plan_rules rules;
  double x, y;
  const double far = around(c, &x, &y), p = share(c->makes, c);
  fprintf(out, "%s on the %s table, cue at %.3g m/s, ", carom_rack_name(b->rack), line->table->id,
          line->cue.speed);
  if (b->aimed || b->cut)
    fprintf(out, "aim %.2f degrees, ", line->cue.phi);
  if (line->cue.theta != 0.0)
    fprintf(out, "elevation %.3g degrees, ", line->cue.theta);
  fprintf(out, "tip %.2f right and %.2f above, gap %.3g mm: %d breaks\n", 0.0 - line->cue.a,
          line->cue.b, 1e3 * gap, c->breaks);
  fprintf(out, "  make a ball   %5.1f %% (error %.1f); %.2f balls a break\n", 100.0 * p,
          100.0 * sqrt(p * (1.0 - p) / c->breaks), (double)c->balls / c->breaks);
  if (rules_of(b->rack, &rules))
    fprintf(out, "  play on       %5.1f %% by the rules; fouls %.1f %%\n",
            100.0 * share(c->plays_on, c), 100.0 * share(c->fouls, c));
  fprintf(out, "  cue ball      falls in %.1f %%; a ball leaves the table in %.1f %%\n",
          100.0 * share(c->scratch, c), 100.0 * share(c->off, c));
  fprintf(out, "  wing balls    one falls in %.1f %%\n", 100.0 * share(c->wing, c));
  if (c->stay > 0)
    fprintf(out, "  cue ball      rests about x = %.2f, y = %.2f m, give or take %.2f m\n", x, y,
            far);
  if (b->job->falls)
    tell_falls(out, line, c);
  else
    tell_most_falls(out, line, c);
}

/* What a row begins with: the stroke and the gap. */
static void begin_row(FILE *out, const breaker *b, const shot_line *line, double gap) {
  const carom_cue *cue = &line->cue;
  fprintf(out, "%s,%.17g,", carom_rack_name(b->rack), cue->speed);
  if (b->aimed || b->cut)
    fprintf(out, "%.17g", cue->phi);
  fprintf(out, ",%.17g,%.17g,%.17g,%.6g,", cue->theta, 0.0 - cue->a, cue->b, 1e3 * gap);
}

static void write_falls(FILE *out, const breaker *b, const shot_line *line, double gap,
                        const counts *c) {
  for (int k = 0; k < line->count; k++)
    for (int p = 0; p < line->table->table.pockets; p++) {
      begin_row(out, b, line, gap);
      fprintf(out, "%d,%s,%s,%.6f\n", c->breaks, line->name[k],
              carom_pocket_name(&line->table->table, p), share(c->fell[k][p], c));
    }
}

static void write_row(FILE *out, const breaker *b, const shot_line *line, double gap,
                      const counts *c) {
  if (b->job->falls) {
    write_falls(out, b, line, gap, c);
    return;
  }
  double x, y;
  const double far = around(c, &x, &y), p = share(c->makes, c);
  carom_plan_rules rules;
  begin_row(out, b, line, gap);
  fprintf(out, "%d,%.6f,%.6f,%.6f,", c->breaks, p, sqrt(p * (1.0 - p) / c->breaks),
          (double)c->balls / c->breaks);
  if (rules_of(b->rack, &rules))
    fprintf(out, "%.6f,%.6f,", share(c->plays_on, c), share(c->fouls, c));
  else
    fputs(",,", out);
  fprintf(out, "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", share(c->scratch, c), share(c->off, c),
          share(c->wing, c), x, y, far);
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
  carom_shot shot[DRAWN + 1] = {0};
  const int drawn = b->job->racks < DRAWN ? b->job->racks : DRAWN;
  for (int k = drawn; k >= 0; k--) { /* the one without errors comes last, and stays in `each` */
    each = *line;
    set_up(b, line, gap, k - 1, each.ball, &each.cue);
    shot[k].final = final[k];
    shot_line_play(&each, &b->options, &shot[k]);
  }
  const drawn_break drawing = {{&each, &shot[0], NULL, &shot[1], drawn}, words};
  const bool good = svg_draw(b->job->plot, draw, &drawing);
  for (int k = 0; k <= drawn; k++)
    free(shot[k].events);
  return good;
}

static const command_form form = {
    .name = "break",
    .usual = (const option_usual[]){{"speed", "9", "unless --ball-speed is given"},
                                    {"aim", NULL, "at the middle of the ball in front"},
                                    {"cut", NULL, "none"},
                                    {"table", NULL, "that of the game"},
                                    {0}},
    .usage = "[OPTIONS]",
    .about = "Plays many breaks of a rack, each with a rack of its own and a player's errors, and "
             "reports how often a ball falls, the player plays on, the cue ball falls and a wing "
             "ball falls, where the cue ball ends, and which ball falls where. Each stroke and gap "
             "has a row. The cue aims at the middle of the ball in front, or cuts it by --cut.\n",
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
                                           &option_falls,
                                           &option_break_csv,
                                           &option_break_plot,
                                           &option_threads,
                                           &option_output,
                                           NULL},
    .details = "speed if none is given: 9 m/s\n"
               "columns of --csv: "
               "rules,speed,aim,elevation,right,above,gap_mm,racks,makes,makes_error,balls,plays_"
               "on,foul,scratch,off,wing,x,y,spread\n"
               "  aim                  degrees, by --aim or --cut; else empty\n"
               "  makes, plays_on, foul, scratch, off, wing  shares of the breaks; by the rules of "
               "eight-ball and nine-ball, empty for other racks\n"
               "  balls                balls made in a break\n"
               "  x y spread           mean place of the cue balls that stay, and their standard "
               "deviation, m\n"
               "  with --falls, from makes on: ball,pocket,share\n"
               "\n"
               "exit code: 0; 2 for bad usage\n",
    .example = "carom break --rules nineball --speed 8,9,10m/s --gap 0.1mm --racks 500",
    .files = NO_FILES,
};

/* Tells all strokes and gaps, and those of the first one to *words, which are to be freed; false
 * after a complaint. */
static bool tell_all(breaker *b, const shot_line *first, const carom_cue *stroke, int strokes,
                     const values *gaps, FILE *out, char **words) {
  if (b->job->csv)
    fprintf(out, "rules,speed,aim,elevation,right,above,gap_mm,racks,%s\n",
            b->job->falls ? "ball,pocket,share"
                          : "makes,makes_error,balls,plays_on,foul,scratch,off,wing,x,y,spread");
  for (int g = 0; g < gaps->count; g++)
    for (int k = 0; k < strokes; k++) {
      const double gap = gaps->at[g].x;
      shot_line line = *first;
      counts c;
      line.cue = stroke[k];
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
    if (!(gaps->at[g].x >= 0.0 && gaps->at[g].x <= GAP_MOST)) {
      complain("--gap is 0 to %g m, not %g", GAP_MOST, gaps->at[g].x);
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
    const bool drawn = job->plot == NULL || plot(b, line, gaps->at[0].x, words);
    code = exit_of(drawn);
  }
  free(words);
  return code;
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
