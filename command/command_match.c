/* `carom match`: matches of two rated players, played, saved, gone on with and told in words, by
 * carom_match.h. */
#include "game/ratings.h"
#include "program/program.h"
#include "shots/places.h"
#include "subcommands.h"

#include "carom_match.h"

#include <errno.h>
#include <inttypes.h>

enum { USUAL_RATING = 600 };

typedef struct match_job {
  shared_options shared; /* --output */
  int rules;             /* a carom_rules_kind; -1: eight-ball, or the game of the file */
  int table;             /* a carom_table_kind; -1: that of the game */
  bool shows;
  double rating[CAROM_SEATS_MOST]; /* 0: not given */
  int breaks, seed, shots, strokes, target, race;
  bool equal, winner_breaks;
} match_job;

OPTION(match_job, option_rules, "rules", rules, NULL, set_named, CAROM_WORDS_RULES, "the game",
       .else_usual = "eightball, or the game of the file", .noun = "game");
OPTION(match_job, option_table, "table", table, NULL, set_named, CAROM_WORDS_TABLE, "the table",
       .else_usual = "the game's table", .noun = "table");
OPTION(match_job, option_players, "players", rating, "A,B,...", set_ratings, 0,
       "the Fargo ratings of 2 to 8 players, 200 to 850; in games of two sides, players 1, 3, ... "
       "are partners",
       .else_usual = "600 each");
OPTION(match_job, option_race, "race", race, "N", set_count, 1,
       "play a set, until a side has won this many matches; the sides break alternately",
       .else_usual = "one match");
FLAG(match_job, option_winner_breaks, "winner-breaks", winner_breaks,
     "in a set, the winner of a match breaks the next one");
OPTION(match_job, option_breaks, "breaks", breaks, "1|2", set_choice, 0, "the player who breaks",
       .usual = "1");
OPTION(match_job, option_seed, "seed", seed, "N", set_count, 0,
       "seed of the gaps of the rack and of the errors", .usual = "1");
OPTION(match_job, option_shots, "shots", shots, "N", set_count, 100,
       "how many shots a player tries in planning a stroke", .usual = "300");
OPTION(match_job, option_strokes, "strokes", strokes, "N", set_count, 1,
       "stop after this many strokes; the recording has no end, and can be continued");
OPTION(match_job, option_target, "target", target, "N", set_count, 1,
       "the points that win, in games of points", .else_usual = "the game's");
FLAG(match_job, option_equal, "equal-innings", equal,
     "in three-cushion and straight rail: if the player who broke reaches the target first, the "
     "other has one more inning, and the match may be drawn");
FLAG(match_job, option_show, "show", shows,
     "instead of playing: judge GAME, and describe each stroke");

static const command_form match_form = {
    .name = "match",
    .usage = "[OPTIONS] [GAME]",
    .about =
        "Plays a match between players whose errors follow from their ratings, by the rules of "
        "a game, and writes its recording, which `carom verify` judges. With GAME it continues "
        "a saved match: with the same --seed and --shots, the match ends as if it had not "
        "been interrupted. GAME may be -.\n",
    .options =
        (const option_row *const[]){&option_rules, &option_table, &option_players, &option_breaks,
                                    &option_race, &option_winner_breaks, &option_target,
                                    &option_equal, &option_seed, &option_shots, &option_strokes,
                                    &option_show, &option_output, NULL},
    .details = "exit code: 0 for success; 1 if a line of GAME breaks the rules, which carom names; "
               " 2 for bad usage or unreadable input\n",
    .example = "carom match --players 650,500 -o game.jsonl",
    .files = FILE_OR_NONE,
};

static carom_match match;

/* ---- Words */

/* What the player has decided since the last ruling. */
static char decided[160];

static bool is_line(const char *line, const char *kind) {
  return strncmp(line, "{\"", 2) == 0 && strncmp(line + 2, kind, strlen(kind)) == 0;
}

static void add_words(const char *words) {
  append(decided, sizeof decided, ", ", "%s", words);
}

enum { NAME_OF_BALL = 32, FIRST_COLOUR = 16 };

/* A ball by its name, as layouts of its game have it. */
static const char *name_ball(int64_t ball, char text[NAME_OF_BALL]) {
  snprintf(text, NAME_OF_BALL, "ball %" PRId64, ball);
  if (match.record.rules == CAROM_RULES_SNOOKER && ball >= FIRST_COLOUR)
    snprintf(text, NAME_OF_BALL, "the %s", colours_of_snooker[ball - FIRST_COLOUR]);
  else if (match.record.rules == CAROM_RULES_SNOOKER)
    snprintf(text, NAME_OF_BALL, "red%" PRId64, ball);
  return text;
}

/* Adds what the line of an act says. */
static void add_act(const carom_record *record, const char *line) {
  static const char *const choices[] = {"passes",
                                        "pushes out",
                                        "",
                                        "",
                                        "has the balls racked",
                                        "has the balls racked for the other",
                                        "leaves the cue ball",
                                        "has the balls that touch spotted"};
  char words[80] = "", ball[NAME_OF_BALL];
  if (is_line(line, "place") && record->hand == 0)
    snprintf(words, sizeof words, "puts the cue ball at %.3f, %.3f m", record->place[0],
             record->place[1]);
  if (is_line(line, "act"))
    switch (record->act) {
    case CAROM_ACT_CALL:
      if (record->call[0] < 0)
        snprintf(words, sizeof words, "calls a safety");
      else if (record->call[1] < 0)
        snprintf(words, sizeof words, "calls %s", name_ball(record->call[0], ball));
      else
        snprintf(words, sizeof words, "calls %s, %s", name_ball(record->call[0], ball),
                 carom_pocket_name(&record->table, (int)record->call[1]));
      break;
    case CAROM_ACT_CHOOSE:
      for (size_t k = 0; k < COUNT_OF(choices); k++)
        if (record->choice == INT64_C(1) << k)
          snprintf(words, sizeof words, "%s", choices[k]);
      break;
    case CAROM_ACT_CLOCK:
      snprintf(words, sizeof words, "has no time left");
      break;
    default:
      snprintf(words, sizeof words, "concedes");
    }
  if (words[0] != '\0')
    add_words(words);
}

/* Tells an act of a player by its line, once it is ruled. `out` NULL: nothing. */
static void tell_act(FILE *out, const char *line, int64_t player, int64_t rulings) {
  char ruling[160];
  add_act(&match.record, line);
  if (match.rulings == rulings && match.winner == 0)
    return;
  carom_ruling_string(&match.ruling, ruling, sizeof ruling);
  const bool concedes = match.rulings == rulings;
  for (int64_t k = 0; !concedes && k < match.ruling.falls; k++) {
    char words[40] = "scratches", ball[NAME_OF_BALL];
    if (match.ruling.fall[k].ball != match.cue_ball)
      snprintf(words, sizeof words, "pots %s", name_ball(match.ruling.fall[k].ball, ball));
    add_words(words);
  }
  if (out != NULL && decided[0] != '\0')
    fprintf(out, "player %" PRId64 " %s%s%s\n", player + 1, decided, text_if(!concedes, ": "),
            text_if(!concedes, ruling));
  else if (out != NULL)
    fprintf(out, "player %" PRId64 ": %s\n", player + 1, ruling);
  decided[0] = '\0';
}

/* ---- Reading */

/* A saved match that is read: its file, where its lines are kept, and where they are told; NULL:
 * nowhere. */
typedef struct saved_match {
  const char *path;
  FILE *text, *words;
  bool failed;
} saved_match;

static bool read_line(void *context, const char *line, size_t size) {
  static carom_record scratch;
  saved_match *saved = context;
  const int64_t player = match.seat, rulings = match.rulings;
  const bool goes_on = match.phase != CAROM_MATCH_NONE && match.phase != CAROM_MATCH_OVER;
  if (carom_match_read(&match, &scratch, line, size) != CAROM_OK) {
    complain("%s: %s", saved->path, match.fault);
    saved->failed = true;
    return false;
  }
  if (goes_on && (match.phase != CAROM_MATCH_OVER || match.winner != 0))
    tell_act(saved->words, line, player, rulings);
  fwrite(line, 1, size, saved->text);
  return true;
}

/* Reads and judges the lines of a saved match. Returns an exit code. */
static int read_match(saved_match *saved) {
  if (!input_lines(saved->path, read_line, saved))
    return saved->failed ? EXIT_SOME : EXIT_USAGE;
  fwrite(match.text, 1, (size_t)match.size, saved->text); /* what a file that was cut off lacks */
  if (match.phase != CAROM_MATCH_NONE)
    return EXIT_GOOD;
  complain("%s: no line tells how a match begins", saved->path);
  return EXIT_USAGE;
}

/* ---- Playing */

typedef struct players {
  const match_job *job;
  carom_player player[CAROM_SEATS_MOST];
  carom_plan_options options;
  void *memory;
  FILE *text, *words;
} players;

/* Keeps the lines of an act that was played, and tells it. */
static bool keep(const players *p, carom_status status, int player, int64_t rulings) {
  if (status != CAROM_OK) {
    complain("%s", match.fault);
    return false;
  }
  fwrite(match.text, 1, (size_t)match.size, p->text);
  tell_act(p->words, match.text, player, rulings);
  return true;
}

/* Plays the best stroke of the player at the table, or passes. */
static bool play_stroke(players *p) {
  const int player = match.seat;
  p->options.opponent = &p->player[(player + 1) % (int)match.seating.count];
  carom_plan_job job = {.player = &p->player[player], .options = &p->options};
  job.memory = p->memory;
  job.memory_size = carom_plan_memory(&p->options);

  /* the stroke, and what comes before it */
  int found;
  carom_plan_stroke best;
  const carom_status status = carom_match_plan(&match, &job, &best, 1, &found);
  if (status != CAROM_OK) {
    complain("%s", text_or(match.fault, carom_status_string(status)));
    return false;
  }
  const int64_t rulings = match.rulings;
  if (best.kind == CAROM_PLAN_PASS)
    return keep(p, carom_match_choose(&match, player, CAROM_CHOICE_PASS), player, rulings);
  if (match.phase == CAROM_MATCH_PLACE &&
      !keep(p, carom_match_place(&match, player, best.place[0], best.place[1]), player, rulings))
    return false;
  if (best.kind == CAROM_PLAN_PUSH &&
      !keep(p, carom_match_choose(&match, player, CAROM_CHOICE_PUSH), player, rulings))
    return false;
  const carom_call call = {best.ball, best.pocket};
  if (match.rules.calls != 0 && best.pocket >= 0 &&
      !keep(p, carom_match_call(&match, player, call), player, rulings))
    return false;
  carom_player_strike(&p->player[player], (uint64_t)p->job->seed, (uint64_t)match.record.shots,
                      &best.cue);
  return keep(p, carom_match_stroke(&match, player, &best.cue, NULL, NULL), player, rulings);
}

/* How many players were named; 0: none. */
static int count_players(const match_job *job) {
  int count = 0;
  while (count < CAROM_SEATS_MOST && job->rating[count] > 0.0)
    count++;
  return count;
}

/* The rating of a seat: the one that was given, or that of the file, or the usual one. */
static double rating_of(const match_job *job, int seat) {
  if (job->rating[seat] > 0.0)
    return job->rating[seat];
  if (match.seating.seat[seat].rating >= 200.0)
    return match.seating.seat[seat].rating;
  return USUAL_RATING;
}

/* Begins the match, unless one was read, and plays it; an exit code. */
static int play_match(players *p) {
  const match_job *job = p->job;
  carom_table table;
  if (match.phase == CAROM_MATCH_NONE) {
    const carom_rules_kind rules =
        job->rules < 0 ? CAROM_RULES_EIGHTBALL : (carom_rules_kind)job->rules;
    carom_table_kind kind = (carom_table_kind)carom_rules_about_of(rules)->table;
    if (job->table >= 0)
      kind = (carom_table_kind)job->table;
    carom_table_make(kind, &table);
    const carom_set set = {.race = job->race, .order = job->winner_breaks};
    carom_seating seating;
    carom_match_setup setup = {.rules = rules,
                               .target = job->target,
                               .equal_innings = job->equal,
                               .table = &table,
                               .seed = (uint64_t)job->seed,
                               .side = job->breaks};
    const int seats = count_players(job);
    if (seats > 0) {
      setup.seating = &seating;
      if (carom_seating_make(rules, seats, &seating) != CAROM_OK) {
        complain("--players: %s is not played by %d", carom_word(CAROM_WORDS_RULES, (int)rules),
                 seats);
        return EXIT_USAGE;
      }
      for (int k = 0; k < seats; k++)
        seating.seat[k].rating = job->rating[k];
    }
    if (job->race > 0)
      setup.set = &set;
    const carom_status status = carom_match_begin_with(&match, &setup);
    if (status != CAROM_OK) {
      complain("%s", text_or(match.fault, carom_status_string(status)));
      return EXIT_USAGE;
    }
    fwrite(match.text, 1, (size_t)match.size, p->text);
  }
  const carom_rules_kind rules = (carom_rules_kind)match.record.rules;
  for (int k = 0; k < CAROM_SEATS_MOST; k++)
    p->player[k] = carom_player_rated(rating_of(job, k), rules);
  for (int k = 0; match.phase != CAROM_MATCH_OVER; k++) {
    if (job->strokes > 0 && k == job->strokes)
      return EXIT_GOOD;
    if (!play_stroke(p))
      return EXIT_USAGE;
    if (match.phase == CAROM_MATCH_OVER && carom_match_next(&match) == CAROM_OK)
      fwrite(match.text, 1, (size_t)match.size, p->text);
  }
  if (carom_match_end(&match) == CAROM_OK)
    fwrite(match.text, 1, (size_t)match.size, p->text);
  return EXIT_GOOD;
}

/* Whether the match that was read, if any, is of the game that was asked for; complains if not. */
static bool is_of_rules(const match_job *job, const char *path) {
  const struct {
    bool given;
    const char *name;
  } first[] = {{job->equal, "equal-innings"},
               {job->target > 0, "target"},
               {job->race > 0, "race"},
               {job->winner_breaks, "winner-breaks"}};
  for (size_t k = 0; path != NULL && k < sizeof first / sizeof *first; k++)
    if (first[k].given) {
      complain("--%s: %s has begun: leave the option out", first[k].name, path);
      return false;
    }
  if (path == NULL || job->rules < 0 || job->rules == match.record.rules)
    return true;
  complain("--rules: %s is a match of %s: leave the option out", path,
           carom_word(CAROM_WORDS_RULES, (int)match.record.rules));
  return false;
}

int command_match(int argc, char **argv) {
  static match_job job;
  const char *path;
  job = (match_job){.rules = -1, .table = -1};
  int code = parse_arguments(&match_form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  if (job.shows && path == NULL) {
    complain("--show: there is no match to show; give GAME, its file");
    return usage_hint(&match_form);
  }

  /* what was saved is read before the output, which may be the same file, is written */
  FILE *text = tmpfile();
  if (text == NULL) {
    complain("no temporary file: %s", strerror(errno));
    return EXIT_USAGE;
  }
  match = (carom_match){0};
  decided[0] = '\0';
  FILE *out = NULL;
  if (job.shows)
    out = output_open(job.shared.output);
  code = EXIT_GOOD;
  if (path != NULL)
    code = read_match(&(saved_match){.path = path, .text = text, .words = out});
  if (code == EXIT_GOOD && !is_of_rules(&job, path))
    code = EXIT_USAGE;
  if (!job.shows && code == EXIT_GOOD) {
    players p = {.job = &job, .text = text};
    p.options.shots = job.shots;
    p.memory = allocate(carom_plan_memory(&p.options), 1);
    if (strcmp(job.shared.output, "-") != 0)
      p.words = stdout;
    code = play_match(&p);
    free(p.memory);
    if (code == EXIT_GOOD)
      out = output_open(job.shared.output);
    if (out != NULL)
      output_copy(text, out);
  }
  fclose(text);
  if (out == NULL && code != EXIT_GOOD)
    return code;
  if (out == NULL || !output_commit())
    return EXIT_USAGE;
  return code;
}
