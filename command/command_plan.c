/* `carom plan`: which shot to play from a layout. */
#include "game/plan_game.h"
#include "game/plan_goal.h"
#include "game/plan_why.h"
#include "game/plan_words.h"
#include "game/ways.h"
#include "pictures/picture.h"
#include "pictures/plan_picture.h"
#include "plan_sequence.h"
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
#include "shots/shot_story.h"
#include "shots/strokes.h"
#include "subcommands.h"

#include "carom_coach.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BEST = 5, TRIED_MOST = 1000 };

typedef struct plan_job {
  shoot_flags flags;       /* --threads, --output; and a layout from words */
  carom_plan_options plan; /* --shots, --seed */
  plan_game game;
  bool hand, csv, json, tries, value, why, run_out, sequence;
  int only, plays; /* 1: only safeties; run-outs to play */
  given_goal goal;
  const char *plot;
} plan_job;

OPTION(plan_job, option_rules, "rules", game.rules, NULL, set_named, CAROM_WORDS_RULES,
       "the game; potting has no rules: all balls count. The balls are named cue, 1, 2, ..., or in "
       "snooker red1, yellow, ...; potting, cowboy and games without pockets accept any names, in "
       "the order of the rack",
       .else_usual = "eightball, or potting if no ball is named 8", .noun = "game");
OPTION(plan_job, option_group, "group", game.group, "open|solids|stripes", set_choice, 0,
       "the player's balls, in games with groups; open: any but the eight", .usual = "open");
OPTION(plan_job, option_permission, "may", game.permission, "shoot|push-out|pass|free-ball",
       set_choice, 0,
       "what the player may do. shoot: only shoot; free-ball: pass, or play any ball",
       .usual = "shoot");
OPTION(plan_job, option_score, "score", game.score, "OWN,OTHER", set_score, 0,
       "points or balls of the player and the opponent; below 0 if they were lost or are owed",
       .usual = "0,0");
OPTION(plan_job, option_own_pocket, "own-pocket", game.pocket, "foot-right|foot-left", set_choice,
       0, "the player's pocket, in games where each player has one", .else_usual = "foot-right");
OPTION(plan_job, option_target, "target", game.target, "N", set_count, 1,
       "points that win, if the rules leave it open");
FLAG(plan_job, option_colour, "colour", game.colour, "in snooker: a colour is on, after a red");
FLAG(plan_job, option_last_inning, "last-inning", game.last_inning,
     "in three-cushion and straight rail: this is the equalizing inning, in which a miss loses");
FLAG(plan_job, option_opening, "opening", game.opening,
     "the stroke is the break; with --in-hand the cue ball starts on or behind the head string");
FLAG(plan_job, option_hand, "in-hand", hand,
     "the cue ball is in hand: the plan also finds its position, within the rules");
FLAG(plan_job, option_run_out, "run-out", run_out,
     "plan to run out: a turn that ends before the game is won has no value");
OPTION(plan_job, option_only, "only", only, "any|safeties", set_choice, 0,
       "safeties: strokes that pass the turn without a foul; carom lists their directions",
       .usual = "any");
OPTION(
    plan_job, option_goal, "leave", goal, GOAL_ARGUMENT, set_goal, 0,
    "what the stroke should leave; carom reports its chance. hidden: a safety after which the "
    "opponent cannot hit any ball that is on in a straight line; snooker: one after which balls "
    "block the path to an edge of BALL; near: the cue ball within R (0.15 m) of a position, as in "
    "`carom ways --leave`; apart: these balls at least a ball's width from all others. With near "
    "and apart the player continues, or with --only safeties passes the turn");
FLAG(plan_job, option_sequence, "sequence", sequence,
     "plan the complete run-out: for each stroke the margins of speed and direction, the landing "
     "zone of the cue ball, and the next ball if it lands elsewhere. In the zone, the chance of "
     "the remaining run-out falls by at most 3 %, as estimated by --value");
OPTION(plan_job, option_plays, "plays", plays, "N", set_count, 0,
       "with --sequence: how many run-outs with errors to play for its chance, with a new plan of "
       "at most 300 shots for each stroke",
       .usual = "100");
static const option_row options_of_plan = {
    .set = set_option, .field = offsetof(plan_job, plan), .part = CAROM_PART_PLAN_OPTIONS};
FLAG(plan_job, option_try, "try", tries,
     "instead of a plan: the chances of the strokes in the file, up to 1000 shots from the same "
     "layout, in order");
FLAG(plan_job, option_value, "value", value,
     "instead of a plan: the chance to win from the layout, estimated without playing a shot");
FLAG(plan_job, option_csv, "csv", csv, "write rows of CSV");
FLAG(plan_job, option_plan_json, "json", json, "write each stroke as a line for `carom shoot`");
FLAG(plan_job, option_why, "why", why,
     "explain each shot: how to aim it, what it leaves, how often it misses and what a miss "
     "leaves, and what errors cost");
OPTION(
    plan_job, option_plan_plot, "plot", plot, "OUT", set_picture, 0,
    "draw the best shot: its paths without errors, thin lines with errors, and what can go wrong");

/* Whether the game is one of points on a table without pockets. */
static bool is_carom(const plan_job *job) {
  const int balls = carom_rules_about_of((carom_rules_kind)job->game.rules)->balls;
  return balls == CAROM_GAME_BILLIARD || balls == CAROM_GAME_FOURBALL;
}

static const char *value_words(const plan_job *job) {
  if (job->goal.kind != CAROM_GOAL_WIN)
    return "reaches the goal";
  if (job->game.rules == CAROM_RULES_POTTING)
    return "share potted";
  return is_carom(job) ? "scores" : "wins";
}

static void tell(FILE *out, const plan_job *job, const carom_plan_job *request,
                 const shot_line *line, const carom_plan_stroke *choices, int n) {
  for (int k = 0; k < n; k++) {
    const carom_plan_stroke *c = &choices[k];
    char text[PLAN_TEXT];
    plan_describe(line, c, text);
    fprintf(out, "%d. %s\n", k + 1, text);
    plan_tell_stroke(out, c, job->hand);
    fprintf(out, "   chances      %s %.1f %% (error %.1f), plays on %.0f %%, foul %.0f %%",
            value_words(job), 100.0 * c->value, 100.0 * c->error, 100.0 * c->keep, 100.0 * c->foul);
    if (c->lose >= 0.005) /* as by an early eight */
      fprintf(out, ", loses %.0f %%", 100.0 * c->lose);
    fprintf(out, "; played %lld times\n", (long long)c->seen);
    if (job->why)
      plan_tell_why(out, request, line, c);
  }
}

static void write_rows(FILE *out, const shot_line *line, const carom_plan_stroke *choices, int n) {
  fputs("rank,kind,ball,pocket,x,y,speed,phi,theta,a,b,value,error,keep,foul,lose,seen\n", out);
  for (int k = 0; k < n; k++) {
    const carom_plan_stroke *c = &choices[k];
    const char *pocket = c->pocket >= 0 ? line->table->pocket[c->pocket] : NULL;
    fprintf(out,
            "%d,%s,%s,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.6f,%.6f,%.6f,%.6f,%.6f,%lld\n",
            k + 1, carom_word_text(CAROM_WORDS_PLAN_KIND, c->kind),
            c->ball >= 0 ? line->name[c->ball] : "", pocket != NULL ? pocket : "", c->place[0],
            c->place[1], c->cue.speed, c->cue.phi, c->cue.theta, c->cue.a, c->cue.b, c->value,
            c->error, c->keep, c->foul, c->lose, (long long)c->seen);
  }
}

/* The strokes as lines; a cue ball in hand lies where the plan puts it. */
static void write_lines(FILE *out, const plan_job *job, const shot_line *line,
                        const carom_plan_stroke *choices, int n) {
  for (int k = 0; k < n; k++) {
    const carom_plan_stroke *c = &choices[k];
    shot_line placed = *line;
    if (job->hand)
      placed.ball[0].state =
          (carom_ball_state){.r = {c->place[0], c->place[1], line->ball[0].kind.radius},
                             .label = CAROM_BALL_STATIONARY};
    char text[PLAN_TEXT];
    plan_describe(line, c, text);
    json_t *written = shot_line_json(&placed, json_string(text), &c->cue);
    json_object_set_new(written, "plan",
                        json_pack("{s: s, s: f, s: f, s: f, s: f}", "kind",
                                  carom_word_text(CAROM_WORDS_PLAN_KIND, c->kind), "value",
                                  c->value, "error", c->error, "keep", c->keep, "foul", c->foul));
    if (c->leave[0] > 0.0)
      json_object_set_new(json_object_get(written, "plan"), "leave",
                          json_pack("[f, f]", c->leave[0], c->leave[1]));
    shot_json_write(out, written);
  }
}

/* Options that do not go together: one of `options` with one of `others`. */
enum asked_option {
  TRY = 1,
  VALUE = 2,
  HAND = 4,
  JSON = 8,
  CSV = 16,
  WHY = 32,
  PLOT = 64,
  SEQUENCE = 128,
  ONLY = 256,
  LEAVE = 512,
  RUN_OUT = 1024
};
static const struct {
  unsigned option, others;
  const char *text;
} clashes[] = {
    {TRY, VALUE | HAND,
     "--try plays strokes from where the cue ball lies: give it without --value and --in-hand"},
    {JSON, CSV | VALUE | WHY,
     "--json writes strokes alone: give it without --csv, --value and --why"},
    {WHY, CSV | VALUE, "--why explains shots in words: give it without --csv and --value"},
    {SEQUENCE, CSV | VALUE | WHY | TRY | ONLY | LEAVE,
     "--sequence plans a whole run-out: give it without --csv, --value, --why, --try, --only and "
     "--leave"},
    {LEAVE, VALUE | WHY | RUN_OUT,
     "--leave asks for the chance of a goal: give it without --value, --why and --run-out"},
    {VALUE, PLOT, "--value finds no shot that --plot could draw"}};

static unsigned asked_of(const plan_job *job) {
  const bool leaves = job->goal.kind != CAROM_GOAL_WIN, plots = job->plot != NULL;
  return job->tries * TRY | job->value * VALUE | job->hand * HAND | job->json * JSON |
         job->csv * CSV | job->why * WHY | plots * PLOT | job->sequence * SEQUENCE |
         (job->only != 0) * ONLY | leaves * LEAVE | job->run_out * RUN_OUT;
}

/* Whether the options go together; complains where they do not. */
static bool are_together(const plan_job *job) {
  carom_player player;
  const unsigned asked = asked_of(job);
  if (!player_of(&job->flags.shared.player, &player))
    return false;
  if (!plan_game_fits(&job->game))
    return false;
  for (size_t k = 0; k < sizeof clashes / sizeof clashes[0]; k++)
    if ((asked & clashes[k].option) != 0 && (asked & clashes[k].others) != 0) {
      complain("%s", clashes[k].text);
      return false;
    }
  if (job->value && is_carom(job))
    complain("--value: no estimate of a layout of %s is known; a plan reports chances",
             carom_rules_about_of((carom_rules_kind)job->game.rules)->text);
  else if (job->sequence && is_carom(job))
    complain("--sequence needs a game with pockets, such as --rules eightball");
  else
    return true;
  return false;
}

/* The chance of a layout, as words or a row. */
static carom_status tell_value(const plan_job *job, const carom_plan_job *request, FILE *out) {
  double chance;
  const carom_status status = carom_plan_value(request, job->hand, &chance);
  if (status == CAROM_OK && job->csv)
    fprintf(out, "value\n%.6f\n", chance);
  else if (status == CAROM_OK)
    fprintf(out, "%s %.1f %%\n", value_words(job), 100.0 * chance);
  return status;
}

/* Whether a game can be played on a layout; complains where it cannot. */
static bool is_playable(const plan_job *job, const shot_line *line, const char *file) {
  const bool pockets = line->table->table.pockets > 0;
  const bool scores = is_carom(job);
  const char *game = carom_rules_about_of((carom_rules_kind)job->game.rules)->name;
  if (!scores && !pockets)
    complain("%s:%zu: the table has no pockets, which this game needs", file, line->number);
  else if (scores && pockets)
    complain("%s:%zu: the table has pockets; %s needs one without, such as --table %s", file,
             line->number, game,
             carom_word(CAROM_WORDS_TABLE,
                        carom_rules_about_of((carom_rules_kind)job->game.rules)->table));
  else if (scores && line->count < 3)
    complain("%s:%zu: %s needs three balls", file, line->number, game);
  else if (line->count < 2)
    complain("%s:%zu: a plan needs the cue ball and one more", file, line->number);
  else
    return true;
  return false;
}

/* Makes the ball of the cue ball 0. */
static void put_cue_ball_first(shot_line *line) {
  shot_line_keep(line);
  const int64_t cue = line->cue.ball;
  const carom_shot_ball ball = line->ball[0];
  char *const name = line->name[0];
  line->ball[0] = line->ball[cue];
  line->name[0] = line->name[cue];
  line->ball[cue] = ball;
  line->name[cue] = name;
  line->cue.ball = 0;
}

/* Asks the library for the estimate, the chances of the strokes that were given, or the best
 * shots: n of them. */
static carom_status ask(const plan_job *job, const carom_plan_job *request,
                        const carom_cue *strokes, int tried, carom_plan_stroke *choices, int *n,
                        FILE *out) {
  *n = tried;
  if (job->value)
    return tell_value(job, request, out);
  if (tried > 0)
    return carom_plan_try(request, strokes, tried, choices);
  if (!job->hand)
    return carom_plan(request, choices, BEST, n);
  return carom_plan_hand(request, NULL, NULL, choices, BEST, n);
}

/* Within which bounds a cue ball in hand is put. */
static int64_t leave_in_hand(const plan_job *job) {
  const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)job->game.rules);
  return job->game.opening ? about->opening : about->hand;
}

/* Of a layout without an eight there is no eight-ball: where no game was asked for, all balls
 * count. */
static void choose_rules(plan_job *job, const shot_line *line) {
  if (job->game.group != 0 || line->table->table.pockets == 0)
    return;
  for (int k = 0; k < line->count; k++)
    if (strcmp(line->name[k], "8") == 0)
      return;
  job->game.rules = CAROM_RULES_POTTING;
  complain("no ball is named 8, so all balls count: --rules potting");
}

/* Plans for a layout, or judges `tried` strokes, writes the choices and keeps the best; an exit
 * code. */
static int plan(const plan_job *job, shot_line *line, const char *file, FILE *out,
                const carom_cue *strokes, int tried, planned *p) {
  if (!is_playable(job, line, file) || !plan_game_order(&job->game, line, file))
    return EXIT_USAGE;
  if (line->cue.ball != 0)
    put_cue_ball_first(line);
  player_of(&job->flags.shared.player, &p->player);
  plan_game_state(&job->game, line, &p->rules);

  carom_plan_options options = job->plan;
  options.threads = job->flags.shared.options.threads;
  options.chance_opponent = job->run_out ? 1.0 : 0.0;
  options.safeties = job->only;
  carom_plan_goal goal;
  if (!plan_goal_of(&job->goal, line, &p->rules, &goal))
    return EXIT_USAGE;
  carom_plan_job request = {.table = &line->table->table,
                            .balls = line->ball,
                            .count = line->count,
                            .cue = &line->cue,
                            .player = &p->player,
                            .rules = &p->rules,
                            .shot = &job->flags.shared.shot,
                            .options = &options,
                            .memory_size = carom_plan_memory(&options)};
  if (job->goal.kind != CAROM_GOAL_WIN)
    request.goal = &goal;
  if (job->hand)
    request.leave = leave_in_hand(job);
  request.memory = allocate(1, request.memory_size);
  static carom_plan_stroke choices[TRIED_MOST];
  int n;
  const sequence_question question = {job->hand, job->json, job->plays};
  carom_status status;
  if (job->sequence)
    status = plan_sequence(out, &request, line, &question);
  else
    status = ask(job, &request, strokes, tried, choices, &n, out);
  char fault[FAULT_TEXT];
  if (status != CAROM_OK && shot_fault(line, &job->flags.shared.shot, fault)) {
    free(request.memory);
    complain("%s:%zu: %s", file, line->number, fault);
    return EXIT_USAGE;
  }
  if (status != CAROM_OK) {
    free(request.memory);
    const char *advice = "; a ball that is not given counts as potted: add it, such as 8=2d,6d, or "
                         "give --rules potting, in which all balls count";
    complain("%s:%zu: by --rules %s: %s%s", file, line->number,
             carom_word(CAROM_WORDS_RULES, job->game.rules), carom_status_string(status),
             text_if(status == CAROM_ERROR_GAME_OVER, advice));
    return EXIT_USAGE;
  }

  if (job->sequence) {
    free(request.memory);
    return EXIT_GOOD;
  }
  if (job->why && tried == 0)
    carom_plan_replay(&request, choices, n);
  if (job->json)
    write_lines(out, job, line, choices, n);
  else if (job->csv && !job->value)
    write_rows(out, line, choices, n);
  else
    tell(out, job, &request, line, choices, n);
  free(request.memory);
  p->best = choices[0];
  for (int k = 1; k < n; k++)
    if (choices[k].value > p->best.value)
      p->best = choices[k];
  return EXIT_GOOD;
}

static const command_form form = {
    .name = "plan",
    .usage = "[OPTIONS] LAYOUT.jsonl | --balls X,Y:... [OPTIONS]",
    .about =
        "Finds the shots that win most often from a layout, for a player who makes errors, and "
        "describes the five best: what they do, how to strike, and their chances. LAYOUT is a file "
        "as for `carom shoot`: carom reads the table, the balls and the cue of its first shot, and "
        "with --try the strokes. Missing balls count as potted.\n",
    .options =
        (const option_row *const[]){
            &option_rules,         &option_table,      &option_cue,           &option_balls,
            &option_one_gap,       &option_group,      &option_permission,    &option_score,
            &option_target,        &option_own_pocket, &option_colour,        &option_opening,
            &option_last_inning,   &option_hand,       &option_run_out,       &option_only,
            &option_goal,          &option_sequence,   &option_plays,         &option_try,
            &option_value,         &option_player,     &option_player_errors, &option_player_eye,
            &option_with_of_shots, &option_cue_ball,   &options_of_plan,      &options_of_motion,
            &option_layout,        &option_csv,        &option_plan_json,     &option_why,
            &option_plan_plot,     &option_threads,    &option_output,        NULL},
    .details = "columns of --csv: "
               "rank,kind,ball,pocket,x,y,speed,phi,theta,a,b,value,error,keep,foul,lose,seen\n"
               "  x y                  position of the cue ball, m\n"
               "  value error          chance to win and its standard error; in potting the "
               "fraction of the balls that fall\n"
               "  keep foul lose       chances that the player continues or wins, fouls, loses\n"
               "  seen                 how often the shot was played with errors\n"
               "The choice depends only on the input, --shots and --seed, not on --threads.\n"
               "\n"
               "exit code: 0; 2 for bad usage or unreadable input\n",
    .example =
        "carom plan --rules eightball --group solids --shots 4000 --plot best.svg layout.jsonl",
    .files = FILE_OR_NONE,
};

int command_plan(int argc, char **argv) {
  static plan_job job;
  const char *path;
  job = (plan_job){.flags = {.shared = {.options = COMMAND_OPTIONS}},
                   .game = {.rules = NOT_GIVEN, .pocket = NOT_GIVEN},
                   .plays = 100};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  const bool any_rules = job.game.rules == NOT_GIVEN;
  if (any_rules)
    job.game.rules = CAROM_RULES_EIGHTBALL;
  else if (path == NULL && job.flags.table.kind == 0)
    job.flags.table.kind = 1 + (int)carom_rules_about_of((carom_rules_kind)job.game.rules)->table;
  if (!are_together(&job) || !svg_possible(job.plot))
    return EXIT_USAGE;
  shot_file *file = layout_open(&job.flags, path, &job.flags.shared.shot, 1);
  if (file == NULL)
    return EXIT_USAGE;
  static shot_line line;
  static planned result;
  int code = EXIT_USAGE;
  static carom_cue strokes[TRIED_MOST];
  const int strokes_of_file =
      strokes_read(file, &job.flags.shared, &line, strokes, job.tries ? TRIED_MOST : 1);
  if (strokes_of_file > 0) {
    if (any_rules)
      choose_rules(&job, &line);
    const int tried = job.tries ? strokes_of_file : 0;
    FILE *out = output_open(job.flags.shared.output);
    if (out != NULL) {
      code = plan(&job, &line, shot_file_name(file), out, strokes, tried, &result);
      if (code == EXIT_USAGE)
        output_abandon();
      else if (!output_commit())
        code = EXIT_USAGE;
      else if (job.plot != NULL && job.sequence)
        code = plan_sequence_draw(job.plot) ? code : EXIT_SOME;
      else if (job.plot != NULL) {
        char what[PLAN_TEXT];
        plan_describe(&line, &result.best, what);
        code = plan_draw(job.plot, &line, &result, job.plan.seed, what) ? code : EXIT_SOME;
      }
    }
    shot_line_free(&line);
  }
  shot_file_close(file);
  return code;
}
