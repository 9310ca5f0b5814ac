/* `carom plan`: which shot to play from a layout. */
#include "game/plan_game.h"
#include "game/plan_why.h"
#include "game/ways.h"
#include "pictures/picture.h"
#include "pictures/plan_picture.h"
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
  bool hand, csv, json, tries, value, why, run_out;
  const char *plot;
} plan_job;

OPTION(plan_job, option_rules, "rules", game.rules, 0, NULL, set_named, CAROM_WORDS_RULES,
       "the game; potting has no rules: all balls count. The cue ball is named cue, and the others "
       "by their numbers, or in snooker as in "
       "its rack: red1, yellow; potting, cowboy and games without pockets take any names, in the "
       "order of the rack",
       .else_usual = "eightball, or potting where no ball is named 8");
OPTION(plan_job, option_group, "group", game.group, 0, "open|solids|stripes", set_choice, 0,
       "the balls of the player, where each has a group; open: any but the eight", .usual = "open");
OPTION(plan_job, option_permission, "may", game.permission, 0, "shoot|push-out|pass|free-ball",
       set_choice, 0,
       "what the player may do; shoot: nothing but a shot; free-ball: pass, or play any ball",
       .usual = "shoot");
OPTION(plan_job, option_score, "score", game.score, 0, "OWN,OTHER", set_score, 0,
       "points, or balls, of the player and of the opponent; below 0 if the player lost or owes "
       "them",
       .usual = "0,0");
OPTION(plan_job, option_own_pocket, "own-pocket", game.pocket, 0, "foot-right|foot-left",
       set_choice, 0, "the player's pocket, in games where each player has one",
       .else_usual = "foot-right");
OPTION(plan_job, option_target, "target", game.target, 0, "N", set_count, 1,
       "points that win, where the rules leave it open");
OPTION(plan_job, option_colour, "colour", game.colour, 0, NULL, set_flag, 0,
       "in snooker: a colour is on, after a red");
OPTION(plan_job, option_last_inning, "last-inning", game.last_inning, 0, NULL, set_flag, 0,
       "in three-cushion and straight rail: this is the equalizing inning, in which a miss loses");
OPTION(plan_job, option_opening, "opening", game.opening, 0, NULL, set_flag, 0,
       "the stroke is the break. With --in-hand the cue ball is put on the head string, or behind "
       "it");
OPTION(plan_job, option_hand, "in-hand", hand, 0, NULL, set_flag, 0,
       "the cue ball is in hand: the plan also says where to put it, within the rules");
OPTION(plan_job, option_run_out, "run-out", run_out, 0, NULL, set_flag, 0,
       "plan to run out: a turn that ends before the game is won is worth nothing");
static const option_row options_of_plan = {
    .set = set_option, .field = offsetof(plan_job, plan), .part = CAROM_PART_PLAN_OPTIONS};
OPTION(plan_job, option_try, "try", tries, 0, NULL, set_flag, 0,
       "instead of a plan: the chances of the strokes in the file, that of the first shot and "
       "those of up to 999 more shots from the same layout, in their order");
OPTION(plan_job, option_value, "value", value, 0, NULL, set_flag, 0,
       "instead of a plan: the chance to win from the layout, an estimate for which carom plays no "
       "shot");
OPTION(plan_job, option_csv, "csv", csv, 0, NULL, set_flag, 0,
       "write rows of CSV instead of words");
OPTION(plan_job, option_plan_json, "json", json, 0, NULL, set_flag, 0,
       "write each shot as the line of its stroke, for `carom shoot`");
OPTION(plan_job, option_why, "why", why, 0, NULL, set_flag, 0,
       "explain each shot: how to aim it, what it leaves, how often it misses and what a miss "
       "leaves, and what errors cost");
OPTION(
    plan_job, option_plan_plot, "plot", plot, 0, "OUT", set_picture, 0,
    "draw the best shot: its paths without errors, thin lines with errors, and what can go wrong");

/* What a choice that names no ball does. */
static const char *words_without_ball(const shot_line *line, const carom_plan_stroke *c) {
  static const double often = 0.15; /* fouls of a stroke that is no safe one */
  if (line->table->table.pockets == 0)
    return "no point";
  if (c->keep >= 0.1) /* below it balls fall by luck, as for carom_names_ball() */
    return "no sure pot: which ball falls is luck";
  if (c->foul >= often)
    return "a risky safety: it often fouls";
  return c->keep < 0.005 ? "a safety: nothing is potted" : "a safety: balls fall by luck alone";
}

/* By which kind of stroke a ball falls: ", by a bank"; nothing where it is direct. */
static void kind_words(const carom_plan_stroke *c, char text[40]) {
  text[0] = '\0';
  if (c->kind == CAROM_PLAN_SCAN)
    snprintf(text, 40, ", by several ways");
  else if (c->kind != CAROM_PLAN_POT && c->kind != CAROM_PLAN_GIVEN)
    snprintf(text, 40, ", by a %s", carom_plan_kind_name((carom_plan_kind)c->kind));
}

/* What a choice does, by the names of the file. */
static void describe(const shot_line *line, const carom_plan_stroke *c, char text[200]) {
  char pocket[WHERE_TEXT], ball[BALL_TEXT], way_words[40];
  if (c->kind == CAROM_PLAN_FOUL)
    snprintf(text, 200, "no shot without a foul was found");
  else if (c->kind == CAROM_PLAN_PASS)
    snprintf(text, 200, "pass: the other plays");
  else if (c->kind == CAROM_PLAN_PUSH || c->kind == CAROM_PLAN_BREAK)
    snprintf(text, 200, "a %s", carom_plan_kind_name((carom_plan_kind)c->kind));
  else if (!carom_names_ball(c))
    snprintf(text, 200, "%s", words_without_ball(line, c));
  else if (line->table->table.pockets == 0)
    snprintf(text, 200,
             c->kind == CAROM_PLAN_KICK ? "a point, off a cushion, %s first" : "a point, %s first",
             named_ball(line->name[c->ball], ball));
  else {
    kind_words(c, way_words);
    snprintf(text, 200, "%s into %s%s", named_ball(line->name[c->ball], ball),
             pocket_words(line->table, c->pocket, pocket), way_words);
  }
}

/* Whether the game is one of points on a table without pockets. */
static bool is_carom(const plan_job *job) {
  const int balls = carom_rules_about_of((carom_rules_kind)job->game.rules)->balls;
  return balls == CAROM_GAME_BILLIARD || balls == CAROM_GAME_FOURBALL;
}

static const char *value_words(const plan_job *job) {
  if (job->game.rules == CAROM_RULES_POTTING)
    return "share potted";
  return is_carom(job) ? "scores" : "wins";
}

static void tell(FILE *out, const plan_job *job, const carom_plan_job *request,
                 const shot_line *line, const carom_plan_stroke *choices, int n) {
  for (int k = 0; k < n; k++) {
    const carom_plan_stroke *c = &choices[k];
    char text[200];
    describe(line, c, text);
    fprintf(out, "%d. %s\n", k + 1, text);
    if (job->hand)
      fprintf(out, "   cue ball at  %.4f, %.4f m\n", c->place[0], c->place[1]);
    fprintf(out, "   stroke       speed %.3g m/s, direction %.3f degrees, raised %.1f, ",
            c->cue.speed, c->cue.phi, c->cue.theta);
    fprintf(out, "tip %.2f %s, %.2f %s\n", fabs(c->cue.a), left_or_right(c->cue.a), fabs(c->cue.b),
            above_or_below(c->cue.b));
    fprintf(out,
            "   chances      %s %.1f %% (error %.1f), plays on %.0f %%, foul %.0f %%; played %lld "
            "times\n",
            value_words(job), 100.0 * c->value, 100.0 * c->error, 100.0 * c->keep, 100.0 * c->foul,
            (long long)c->seen);
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
            k + 1, carom_plan_kind_name((carom_plan_kind)c->kind),
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
    char text[200];
    describe(line, c, text);
    json_t *written = shot_line_json(&placed, json_string(text), &c->cue);
    json_object_set_new(written, "plan",
                        json_pack("{s: s, s: f, s: f, s: f, s: f}", "kind",
                                  carom_plan_kind_name((carom_plan_kind)c->kind), "value", c->value,
                                  "error", c->error, "keep", c->keep, "foul", c->foul));
    shot_json_write(out, written);
  }
}

/* Whether the options go together; complains where they do not. */
static bool are_together(const plan_job *job) {
  carom_player player;
  if (!player_of(&job->flags.shared.player, &player))
    return false;
  if (!plan_game_fits(&job->game))
    return false;
  if (job->tries && (job->value || job->hand))
    complain(
        "--try plays strokes from where the cue ball lies: give it without --value and --in-hand");
  else if (job->value && is_carom(job))
    complain("--value: no estimate of a layout of %s is known; a plan reports chances",
             carom_rules_about_of((carom_rules_kind)job->game.rules)->text);
  else if (job->json && (job->csv || job->value || job->why))
    complain("--json writes strokes alone: give it without --csv, --value and --why");
  else if (job->why && (job->csv || job->value))
    complain("--why explains shots in words: give it without --csv and --value");
  else if (job->value && job->plot != NULL)
    complain("--value finds no shot that --plot could draw");
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
  const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)job->game.rules);
  carom_plan_job placed = *request;
  placed.leave = job->game.opening ? about->opening : about->hand;
  return carom_plan_hand(&placed, NULL, NULL, choices, BEST, n);
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
  carom_plan_job request = {.table = &line->table->table,
                            .balls = line->ball,
                            .count = line->count,
                            .cue = &line->cue,
                            .player = &p->player,
                            .rules = &p->rules,
                            .shot = &job->flags.shared.shot,
                            .options = &options,
                            .memory_size = carom_plan_memory(&options)};
  request.memory = allocate(1, request.memory_size);
  static carom_plan_stroke choices[TRIED_MOST];
  int n;
  const carom_status status = ask(job, &request, strokes, tried, choices, &n, out);
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
        "Finds the shots that win most often from a layout, for a player who makes errors. LAYOUT "
        "is a file as for `carom shoot`. carom reads the table, the balls and the cue of its first "
        "shot, and the stroke only with --try. Balls that are missing count as potted. carom "
        "describes the five best shots in words: what they do, how to strike, and their chances.\n",
    .options =
        (const option_row *const[]){
            &option_rules,         &option_table,      &option_cue,           &option_balls,
            &option_one_gap,       &option_group,      &option_permission,    &option_score,
            &option_target,        &option_own_pocket, &option_colour,        &option_opening,
            &option_last_inning,   &option_hand,       &option_run_out,       &option_try,
            &option_value,         &option_player,     &option_player_errors, &option_player_eye,
            &option_with_of_shots, &option_cue_ball,   &options_of_plan,      &options_of_motion,
            &option_layout,        &option_csv,        &option_plan_json,     &option_why,
            &option_plan_plot,     &option_threads,    &option_output,        NULL},
    .details = "columns of --csv: "
               "rank,kind,ball,pocket,x,y,speed,phi,theta,a,b,value,error,keep,foul,lose,seen\n"
               "  x y                  place of the cue ball, m\n"
               "  value error          chance to win and its standard error; for potting the share "
               "of the balls that are potted\n"
               "  keep foul lose       chances that the player plays on or wins, fouls, loses\n"
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
                   .game = {.rules = NOT_GIVEN, .pocket = NOT_GIVEN}};
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
      else if (job.plot != NULL) {
        char what[200];
        describe(&line, &result.best, what);
        code = plan_draw(job.plot, &line, &result, job.plan.seed, what) ? code : EXIT_SOME;
      }
    }
    shot_line_free(&line);
  }
  shot_file_close(file);
  return code;
}
