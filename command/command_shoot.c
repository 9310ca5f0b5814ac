/* `carom shoot`: whole shots from a file or from words, from the strike to rest. */
#include "game/position.h"
#include "pictures/animation.h"
#include "pictures/picture.h"
#include "pictures/shot_drawings.h"
#include "program/program.h"
#include "rows/doubts.h"
#include "shots/given_shots.h"
#include "shots/shoot_flags.h"
#include "shots/shot_fault.h"
#include "shots/shot_file.h"
#include "shots/shot_story.h"
#include "shots/stop.h"
#include "shots/strokes.h"
#include "subcommands.h"

/* lines in error that are named */
enum { EVENTS_USUAL = -1, BLOCK = 64, FIRST_ROOM = 512, MOST_NAMED = 1000 };

typedef struct shoot_job {
  shoot_flags flags; /* --threads, --steps, --output; and a shot from words */
  int events;
  const char *id;
  drawings drawn; /* --plot, --animate */
  leave leave;
  char left[LEFT_TEXT]; /* what to report of it */
  stop_target stop;
  char stopped[STOP_TEXT]; /* likewise */
  player_error error;
  bool together; /* the shots came from options: they are drawn over each other, */
  bool words;    /* and told in words, unless --events asks for lines */
  bool csv;      /* as rows of moments instead of words */
  bool plot_log; /* the words stand under the picture too */
  bool cite;     /* the sources of the models are told instead */
} shoot_job;

/* What is read at once, and its results. */
typedef struct block {
  shot_line line[BLOCK];
  carom_shot shot[BLOCK];
  carom_facts facts[BLOCK];
  carom_status status[BLOCK];
  int count;
  const char *file;  /* its name, for messages */
  long long unnamed; /* lines in error beyond those that are named, -MOST_NAMED at first */
  doubts tips;
  uint64_t unread; /* numbers of balls that have no effect, and are told */
  /* the shots without error, as batches take them */
  carom_shot_ball ball[BLOCK * CAROM_BALLS_MOST];
  carom_cue cue[BLOCK];
  carom_shot batch[BLOCK];
  int8_t batch_status[BLOCK];
} block;

OPTION(shoot_job, option_events, "events", events, "none|brief|full", set_choice, 0,
       "events to write, as JSON for a shot by options: none; time, type and ids; or states too",
       .else_usual = "full");
FLAG(shoot_job, option_story, "csv", csv,
     "with a shot by options: write rows: where each ball leaves, rolls, meets a rail, passes a "
     "ball and rests");
OPTION(shoot_job, option_plot, "plot", drawn.path[PICTURE], "OUT", set_picture, 0,
       "draw the paths of the shots by options, or of the first good shot of a file; flights also "
       "from the side");
FLAG(shoot_job, option_plot_log, "plot-log", plot_log, "draw the output under the picture");
OPTION(
    shoot_job, option_spread, "spread", error, "SPEED,AIM,RIGHT,ABOVE", set_player_error, 0,
    "standard deviations of a player's errors: speed in %, aim in degrees, tip in radii, such as "
    "1%,0.05,0.01,0.01. carom reports the deviations of the final positions, to first order; "
    "--plot "
    "shows bands, and how far they hold");
OPTION(shoot_job, option_leave, "leave", leave, LEAVE_ARGUMENT, set_leave, 0,
       "choose the stroke that most often leaves the cue ball within R (0.15 m) of this position, "
       "and pots the ball of --pocket: from the speeds and tips given, or 0.5 to 4 m/s and five "
       "tips");
OPTION(shoot_job, option_stop, "stop", stop, STOP_ARGUMENT, set_stop, 0,
       "instead of --speed: find the speeds that stop the cue ball within R (0.1 m) of this "
       "position, or after this distance. 1=2d,4d is for ball 1",
       .noun = "position or distance", .example = "2d,4d");
OPTION(shoot_job, option_animate, "animate", drawn.path[FILM], "OUT.html|OUT.svg", set_animation, 0,
       "write a page that plays the shots of --plot; OUT.svg: a moving image");
FLAG(shoot_job, option_cite, "cite", cite, "print the sources of these models as BibTeX");
OPTION(shoot_job, option_shot_id, "id", id, "ID", set_text, 0, "draw the shot with this id");

static carom_shot_options options_of(const shoot_job *job) {
  carom_shot_options options = job->flags.shared.shot;
  options.threads = job->flags.shared.options.threads;
  return options;
}

/* Shots `start` to before `end` of a block: good lines of one table with one number of balls. */
static void play(block *b, int start, int end, const carom_shot_options *options) {
  const shot_line *first = &b->line[start];
  const int count = first->count, n = end - start;
  for (int k = 0; k < n; k++) {
    memcpy(b->ball + k * count, b->line[start + k].ball, (size_t)count * sizeof *b->ball);
    b->cue[k] = b->line[start + k].cue;
  }
  const carom_shot_job job = {.table = &first->table->table,
                              .balls = b->ball,
                              .cues = b->cue,
                              .count = count,
                              .ball_stride = (uint64_t)count,
                              .cue_stride = 1,
                              .n = (uint64_t)n,
                              .options = options,
                              .shots = b->shot + start,
                              .status = b->batch_status};
  const carom_status batch = carom_shoot_batch(&job);
  for (int k = 0; k < n; k++) {
    const shot_line *line = &b->line[start + k];
    carom_shot *shot = &b->shot[start + k];
    carom_status *status = &b->status[start + k];
    *status = (carom_status)b->batch_status[k];

    /* what is common to the batch may be at fault, and then nothing was played */
    int where;
    carom_status common = CAROM_OK;
    if (batch != CAROM_OK)
      common =
          carom_shot_check(&line->table->table, line->ball, count, &line->cue, options, &where);
    if (common != CAROM_OK) {
      *status = common;
      continue;
    }

    /* once more, with room for all */
    if (shot->room > 0 && shot->count > shot->room) {
      free(shot->events);
      *status = shot_line_play(line, options, shot);
    }
  }
}

static bool goes_with(const shot_line *a, const shot_line *b) {
  return b->error == NULL && a->table == b->table && a->count == b->count;
}

/* Counts one more line in error. Returns whether it is named. */
static bool count_wrong(block *b) {
  return b->unnamed++ < 0;
}

/* The residuals of the fit after as many contacts, where --with has one. They are no errors of a
 * forecast, as the strikes of the fit knew the whole shots. */
static void tell_bands(FILE *out, const given_numbers *with, const carom_shot *shot) {
  int contacts = 0, row = 0;
  for (int64_t k = 0; k < shot->count; k++)
    contacts +=
        shot->events[k].type == CAROM_EVENT_BALL_BALL || shot->events[k].type == CAROM_EVENT_RAIL;
  while (row + 1 < with->bands && with->band[row + 1][0] <= contacts)
    row++;
  if (with->bands > 0)
    fprintf(out,
            "residuals of the fit after as many contacts, with strikes fitted to whole shots: "
            "68 %% within %.2g m, 95 %% within %.2g m\n",
            with->band[row][1], with->band[row][2]);
}

/* Draws shots over each other; a spread says below them what its bands show. */
static void draw_bands(shoot_job *job, const played *shots, int count) {
  char *words;
  size_t size;
  FILE *stream = open_text(&words, &size);
  for (int k = 0; k < count; k++)
    if (shots[k].spread != NULL)
      spread_tell(stream, shots[k].spread, shots[k].line);
  close_text(stream, &words);
  drawings_draw(&job->drawn, shots, count, words);
  free(words);
}

/* Tells the shots of a block in words, and draws them over each other. */
static void tell_block(shoot_job *job, FILE *out, const played *shots, int count) {
  char *words;
  size_t size;
  FILE *stream = open_text(&words, &size);
  for (int k = 0; k < count; k++) {
    const shoot_flags *flags = &job->flags;
    const char *name = shots[k].line->title;
    if (flags->shared.with.lists + flags->cue_numbers.lists > 0) /* the title does not say them */
      fprintf(stream, "%d, %s: ", k + 1, text_or(name, ""));
    else if (count > 1)
      fprintf(stream, "%d: ", k + 1);
    shot_tell(stream, shots[k].line, shots[k].shot, shots[k].spread, count > 1);
    tell_bands(stream, &job->flags.shared.with, shots[k].shot);
    const size_t number = shots[k].line->number;
    if (number <= MOST_SHOTS)
      fputs(job->flags.aimed[number - 1], stream);
    fputs(job->left, stream);
    fputs(job->stopped, stream);
  }
  for (int k = 0; k < count && job->csv; k++) {
    const int number = (int)shots[k].line->number;
    if (number == 1)
      fputs(STORY_COLUMNS "\n", out);
    story_rows(out, number, shots[k].line, shots[k].shot);
  }
  close_text(stream, &words);
  if (job->words && !job->csv)
    fputs(words, out);
  if (count > 0 && job->plot_log)
    drawings_draw(&job->drawn, shots, count, words);
  else if (count > 0)
    draw_bands(job, shots, count);
  free(words);
}

/* The spread of shot k of a block; where it is not known, that is an error of the shot. */
static void find_spread(block *b, int k, const shoot_job *job, const carom_shot_options *options,
                        spread *result) {
  *result = (spread){.status = b->status[k]};
  if (b->status[k] < 0)
    return;
  spread_of(&job->error, &b->line[k], &b->shot[k], options, drawings_asked(&job->drawn), result);
  if (result->status < 0 && count_wrong(b))
    complain("%s:%zu: --spread: %s", b->file, b->line[k].number,
             carom_status_string(result->status));
  if (result->status < 0)
    b->status[k] = result->status;
}

/* Plays what has been read: lines without error, by runs of one table and one number of balls. */
static void play_block(block *b, const carom_shot_options *options) {
  for (int start = 0, end; start < b->count; start = end) {
    end = start + 1;
    if (b->line[start].error != NULL)
      continue;
    while (end < b->count && goes_with(&b->line[start], &b->line[end]))
      end++;
    play(b, start, end, options);
  }
}

/* Says what is wrong with line k, and writes it as a line in error. */
static void write_wrong(block *b, int k, const shoot_job *job, FILE *out, const char *status,
                        const char *wrong) {
  const shot_line *line = &b->line[k];
  if (count_wrong(b))
    complain("%s:%zu: %s", b->file, line->number, wrong);
  if (!job->words)
    shot_write_error(out, line, status, wrong);
}

/* Writes shot k, which was played, and draws it where it is drawn alone. */
static void write_played(block *b, int k, shoot_job *job, FILE *out, const played *shot) {
  if (!job->words)
    shot_write(out, shot->line, shot->shot, b->status[k], job->events,
               shot->spread != NULL ? spread_json(shot->spread, shot->line) : NULL);
  if (!job->together && shot_has_id(shot->line, job->id))
    draw_bands(job, shot, 1);
}

/* Plays what has been read and writes it; returns whether all was good. */
static bool finish_block(block *b, shoot_job *job, FILE *out) {
  const carom_shot_options options = options_of(job);
  played shots[BLOCK];
  spread spreads[BLOCK] = {0};
  int count = 0;
  bool good = true;
  play_block(b, &options);
  for (int k = 0; k < b->count; k++) {
    const shot_line *line = &b->line[k];
    char text[FAULT_TEXT];
    if (line->error != NULL) {
      write_wrong(b, k, job, out, "bad_line", line->error);
      good = false;
      continue;
    }
    if (b->status[k] < 0 && shot_fault(line, &options, text)) {
      write_wrong(b, k, job, out, carom_status_name(b->status[k]), text);
      good = false;
      continue;
    }

    /* it was played, to its end or up to an error on the way */
    if (b->status[k] < 0 && count_wrong(b))
      complain("%s:%zu: after %g s: %s", b->file, line->number, b->shot[k].time,
               carom_status_string(b->status[k]));
    played *shot = &shots[count];
    *shot = (played){.line = line, .shot = &b->shot[k]};
    if (job->error.is_set) {
      shot->spread = &spreads[count];
      find_spread(b, k, job, &options, &spreads[count]);
    }
    good &= b->status[k] >= 0;
    write_played(b, k, job, out, shot);
    if (!job->together)
      spread_free(&spreads[count]);
    count++;
  }
  if (job->together)
    tell_block(job, out, shots, count);
  for (int k = 0; k < count && job->together; k++)
    spread_free(&spreads[k]);
  return good;
}

static void begin_shot(block *b, bool events) {
  carom_shot *shot = &b->shot[b->count];
  *shot = (carom_shot){.facts = &b->facts[b->count], .room = events ? FIRST_ROOM : 0};
  if (events)
    shot->events = allocate((size_t)shot->room, sizeof *shot->events);
  shot->final = allocate(CAROM_BALLS_MOST, sizeof *shot->final);
}

static void clear_block(block *b) {
  for (int k = 0; k < b->count; k++) {
    shot_line_free(&b->line[k]);
    free(b->shot[k].events);
    free(b->shot[k].final);
  }
  b->count = 0;
}

/* Reads shots up to a whole block, a table or the end. */
static shot_read fill_block(block *b, shoot_job *job, shot_file *file, const char **text) {
  shot_read what = SHOT_SHOT;
  while (b->count < BLOCK) {
    shot_line *line = &b->line[b->count];
    what = shot_file_next(file, line, text);
    if (what != SHOT_SHOT)
      break;
    shot_numbers(line, &job->flags.shared, b->file, &b->unread);
    carom_cue *cue = &line->cue;
    const bool plays =
        line->error == NULL && cue->speed > 0.0 && cue->miscue == 0.0 && tip_off_centre(cue) < 1.0;
    if (plays && doubts_about_tip(&b->tips, tip_off_centre(cue)) != NULL &&
        job->flags.shared.strict)
      cue->miscue = TIP_LIMIT;
    begin_shot(b, job->events != EVENTS_NONE || job->together || drawings_asked(&job->drawn) ||
                      job->error.is_set);
    b->count++;
  }
  return what;
}

/* Whether --plot and --animate found a shot to draw, where they are given; else a complaint. */
static bool was_drawn(const shoot_job *job) {
  if (!drawings_asked(&job->drawn) || drawings_made(&job->drawn))
    return true;
  complain("nothing to draw: there is no shot without an error%s%s", text_if(job->id != NULL, " "),
           text_if(job->id != NULL, job->id));
  return false;
}

/* All shots of a file; an exit code. */
static int shoot_all(shoot_job *job, shot_file *file, FILE *out) {
  block *b = allocate(1, sizeof *b);
  b->file = shot_file_name(file);
  b->unnamed = -MOST_NAMED;
  const char *text;
  bool good = true;
  double done = 0.0;
  shot_read what;
  do {
    what = fill_block(b, job, file, &text);
    const bool whole = b->count == BLOCK;
    good &= finish_block(b, job, out);
    clear_block(b);
    if (whole)
      progress_show("shots", done += (double)BLOCK, -1.0);
    if (what == SHOT_TABLE) /* behind the shots before it */
      fputs(text, out);
  } while (what == SHOT_SHOT || what == SHOT_TABLE);
  if (b->unnamed > 0)
    complain("%s: %lld more lines in error", b->file, b->unnamed);
  doubts_report(&b->tips, "shot", b->file);
  free(b);
  progress_clear();
  good &= was_drawn(job);
  if (what == SHOT_FAILED)
    return EXIT_USAGE;
  return exit_of(good);
}

static const command_form form = {
    .name = "shoot",
    .usual =
        (const option_usual[]){
            {.name = "elevation",
             .help =
                 "elevation of the butt; least, with --pocket: just enough to clear cushions and "
                 "balls"},
            {.name = "from",
             .usual = "start",
             .help = "with a file: start from the balls before each shot, or from its recorded "
                     "final states"},
            {.name = "with",
             .help = "parameters of all balls, their cushions and the cue (`carom models` lists "
                     "them), such as mu_slide=0.15,mass=6oz,end_mass=0.01; conditions of a pool "
                     "table, such as fast_cloth,old_cushion; or the file of a fit, FIT.json. "
                     "Several values give several shots"},
            {0}},
    .usage = "[OPTIONS] IN.jsonl | --cue X,Y --aim DEGREES [OPTIONS]",
    .about =
        "Plays a shot that options specify, and describes it; several values, with commas, give "
        "several shots, drawn over each other. Or plays the shots of IN, JSON Lines "
        "(docs/reference/files.md) or -, and writes events and final states.\n",
    .options = (const option_row *const[]){&option_table,
                                           &option_cue,
                                           &option_balls,
                                           &option_aim,
                                           &option_to,
                                           &option_at_ball,
                                           &option_pocket,
                                           &option_via,
                                           &option_shot_cut,
                                           &option_leave,
                                           &option_stop,
                                           &option_player,
                                           &option_player_errors,
                                           &option_player_eye,
                                           &option_shot_speed,
                                           &option_ball_speed,
                                           &option_tip,
                                           &option_elevation,
                                           &option_tip_time,
                                           &option_tip_restitution,
                                           &option_gap,
                                           &option_seed,
                                           &option_json,
                                           &option_layout,
                                           &option_story,
                                           &options_of_shots,
                                           &option_with_of_shots,
                                           &option_cue_ball,
                                           &option_events,
                                           &option_threads,
                                           &option_plot,
                                           &option_plot_log,
                                           &option_spread,
                                           &option_animate,
                                           &option_shot_id,
                                           &option_strict,
                                           &option_cite,
                                           &option_output,
                                           NULL},
    .details =
        "exit code: 0 if all shots are played to rest; 1 if some have errors, which OUT names; 2 "
        "for bad usage or unreadable input\n",
    .example =
        "carom shoot --cue 0.6,0.8 --balls 0.8,1.9 --pocket 1:foot-right --plot shot.svg\n"
        "  carom shoot --cue 0.6,0.8 --balls 0.5,1.6 --at-ball 1 --cut 20,30 --tip 0.2,-0.3\n"
        "  carom shoot --cue 0.6,0.8 --to 0.6,2.2 --stop 0.6,1.5",
    .files = FILE_OR_NONE,
};

static int write_sources(const carom_shot_options *options) {
  const size_t length = carom_cite(options, NULL, 0);
  char *text = allocate(length + 1, 1);
  carom_cite(options, text, length + 1);
  fputs(text, stdout);
  free(text);
  return EXIT_GOOD;
}

/* Options that others would ignore in silence; false after a complaint. */
static bool go_together(const shoot_job *job, bool words, const char *path) {
  const bool drawn = drawings_asked(&job->drawn);
  const char *playing = NULL; /* an option for which the shot would be played */
  if (job->csv)
    playing = "csv";
  else if (!words)
    playing = "events";
  else if (job->error.is_set)
    playing = "spread";
  else if (drawn)
    playing = "plot and --animate";
  if (job->cite && (job->together || path != NULL))
    complain("--cite prints the sources of models and plays nothing; give it without a shot");
  else if (job->flags.json && playing != NULL)
    complain("--json prints the shot and plays nothing; give it without --%s", playing);
  else if (job->csv && job->error.is_set)
    complain("--csv has no columns for --spread; give one of them");
  else if (job->id != NULL && (job->together || !drawn))
    complain("--id '%.40s': it chooses a shot of a file to draw; give a file and --plot", job->id);
  else
    return true;
  return false;
}

/* Chooses the stroke of --leave, or the speed of --stop; false after a complaint. */
static bool choose_stroke(shoot_job *job, const carom_shot_options *options) {
  const given_player *player = &job->flags.shared.player;
  if (!job->leave.is_set && (player->rated || player->errs))
    complain(
        "--player and --errors need --leave; try `carom ways` for the chance to pot a ball, or "
        "--spread for the effect of errors");
  else if (job->leave.is_set && !job->together)
    complain("--leave needs a shot by options; give --cue and --balls");
  else if (job->leave.is_set && job->stop.is_set)
    complain("--leave and --stop both choose the speed; give one of them");
  else if (job->stop.is_set && !job->together)
    complain("--stop needs a shot by options; give --cue and --to");
  else if (job->leave.is_set)
    return leave_choose(&job->leave, &job->flags, options, job->left);
  else if (job->stop.is_set)
    return stop_choose(&job->stop, &job->flags, options, job->stopped);
  else
    return true;
  return false;
}

/* What the options of a shot that is played need; false after a complaint. */
static bool can_play(const shoot_job *job) {
  const carom_shot_options *shot = &job->flags.shared.shot;
  if (job->csv && !job->words)
    complain("--csv describes a shot by options; give it without --events and without a file");
  else if (job->error.is_set && shot->world == CAROM_WORLD_POOLTOOL)
    complain("--spread needs derivatives, which --world pooltool does not have; try --world carom");
  else if (job->error.is_set && shot->ball_model == CAROM_BALL_MODEL_EULER)
    complain("--spread needs derivatives, which --ball-model euler does not have; try exact");
  else
    return drawings_possible(&job->drawn);
  return false;
}

/* Plays the shots of a file to an output, and draws, or prints them for --json; an exit code. */
static int shoot_file(shoot_job *job, shot_file *file) {
  FILE *out = output_open(job->flags.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  int code = EXIT_GOOD;
  if (job->flags.json)
    shot_file_print(out, file);
  else
    code = shoot_all(job, file, out);
  if (code == EXIT_USAGE) {
    output_abandon();
    return code;
  }
  if (!output_commit())
    return EXIT_USAGE;
  if (!drawings_write(&job->drawn) || (code == EXIT_GOOD && job->flags.left_out > 0))
    return EXIT_SOME;
  return code;
}

int command_shoot(int argc, char **argv) {
  static shoot_job job;
  const char *path;
  job = (shoot_job){.flags = {.shared = {.options = COMMAND_OPTIONS}}, .events = EVENTS_USUAL};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  job.together = has_flags(&job.flags);
  job.words = job.together && job.events == EVENTS_USUAL;
  if (job.events == EVENTS_USUAL)
    job.events = EVENTS_FULL;
  if (!go_together(&job, !job.together || job.words, path))
    return EXIT_USAGE;
  const carom_shot_options options = options_of(&job);
  if (job.cite)
    return write_sources(&options);
  if (job.together == (path != NULL)) {
    if (job.together)
      complain("'%.80s': a file has its own shots; give either it or --cue, --aim and the like",
               name_of_file(path));
    else
      complain("there is no shot; give a file of shots, or --cue 0.6,0.8 --aim 35 --speed 2");
    return usage_hint(&form);
  }
  if (!job.together && !with_fits_file(&job.flags.shared.with))
    return EXIT_USAGE;
  if (!can_play(&job) || !choose_stroke(&job, &options))
    return EXIT_USAGE;

  shot_file *file;
  if (job.together)
    file = flags_open(&job.flags, &options, job.csv ? MOST_ROWS : MOST_SHOTS);
  else
    file = shot_file_open(path, options.cushion_model, played_again(&job.flags.shared));
  int code = EXIT_USAGE;
  if (file != NULL) {
    code = shoot_file(&job, file);
    shot_file_close(file);
  }
  return code;
}
