/* The game of `carom plan`: its options, the state of its rules, and balls by their numbers. */
#include "game/plan_game.h"
#include "program/message.h"
#include "program/words.h"
#include "shots/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OPTION_SET(set_score) {
  int *score = field, end = 0;
  const bool good = sscanf(text, "%9d,%9d%n", &score[0], &score[1], &end) == 2 && text[end] == 0;
  return good || refuse_value(row, text, "not two whole numbers, OWN,OTHER; try 40,25");
}

enum { YELLOW = 16 }; /* of the balls of snooker: the first colour */

/* The number of a ball by its name; 0 where it has none. */
static int number_of(const char *name, bool snooker) {
  enum { RED = 3 };
  for (int k = 0; k < COLOURS && snooker; k++)
    if (strcmp(name, colours_of_snooker[k]) == 0)
      return YELLOW + k;
  char *end;
  const char *digits = snooker && strncmp(name, "red", RED) == 0 ? name + RED : name;
  const long number = strtol(digits, &end, 10);
  const bool is_number = end != digits && *end == '\0';
  return is_number && number >= 1 && number <= CAROM_BALLS_MOST ? (int)number : 0;
}

/* The pocket at the foot of a table; -1 where it has none of that name. */
static int foot_of(const shot_line *line, bool is_left) {
  const carom_table *table = &line->table->table;
  for (int k = 0; k < table->pockets; k++) {
    const char *name = carom_pocket_name(table, k);
    if (name != NULL && strcmp(name, is_left ? "foot-left" : "foot-right") == 0)
      return k;
  }
  return -1;
}

/* The balls of a line, by their numbers in a game; NULL is the name of one that is missing. */
typedef struct numbered_balls {
  carom_shot_ball ball[CAROM_BALLS_MOST];
  char *name[CAROM_BALLS_MOST];
} numbered_balls;

int rack_of_game(const char *text) {
  char games[MOST_WORDS];
  const int game = word_among(words_of(CAROM_WORDS_RULES, true, games), text, strlen(text));
  return game < 0 ? 0 : 1 + carom_rules_about_of((carom_rules_kind)game)->rack;
}

/* Puts each ball where its number is; false after a complaint. */
static bool number_balls(const shot_line *line, const char *file, const carom_rules_about *about,
                         numbered_balls *numbered) {
  const bool snooker = about->rack == CAROM_RACK_SNOOKER;
  const char *known = about->last == 9 ? "1 to 9" : "1 to 15";
  if (snooker)
    known = "red1 to red15, yellow, green, brown, blue, pink, black";
  for (int k = 0; k < line->count; k++) {
    const bool cue = k == line->cue.ball;
    const int number = cue ? 0 : number_of(line->name[k], snooker);
    const bool good = cue || (number >= 1 && number <= about->last);
    if (!good || numbered->name[number] != NULL) {
      complain("%s:%zu: ball '%s': the balls of this game are the cue ball and %s, each once", file,
               line->number, line->name[k], known);
      return false;
    }
    numbered->ball[number] = line->ball[k];
    numbered->name[number] = line->name[k];
  }
  return true;
}

/* The name of a ball by its number; to be freed. */
static char *name_of(int number, bool snooker) {
  char text[16];
  if (snooker && number >= YELLOW)
    return strdup(colours_of_snooker[number - YELLOW]);
  snprintf(text, sizeof text, snooker ? "red%d" : "%d", number);
  return strdup(text);
}

/* Puts the balls where their numbers are, with those that are missing in a pocket: the line's
 * balls and names change. */
bool plan_game_order(const plan_game *game, shot_line *line, const char *file) {
  const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)game->rules);
  const carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)game->rules);
  const int last = about->last;
  if (last == 0)
    return true;
  if (rules.pockets != NULL && (foot_of(line, true) < 0 || foot_of(line, false) < 0)) {
    complain("%s:%zu: %s needs a table with corner pockets at the foot", file, line->number,
             about->name);
    return false;
  }
  numbered_balls numbered = {.name = {NULL}};
  if (!number_balls(line, file, about, &numbered))
    return false;

  /* where balls count, those are down */
  int scored = 0;
  for (int seat = 0; seat < 2; seat++)
    if (game->score[seat] > 0)
      scored += game->score[seat];
  const int down = last + 1 - line->count;
  if (rules.race == CAROM_RACE_OWN && scored > down) {
    complain("%s:%zu: --score: %d balls count, but %d of %d are down", file, line->number, scored,
             down, last);
    return false;
  }

  /* missing balls are down */
  for (int k = 0; k <= last; k++)
    if (numbered.name[k] == NULL) {
      numbered.name[k] = name_of(k, about->rack == CAROM_RACK_SNOOKER);
      numbered.ball[k] = line->ball[0];
      numbered.ball[k].state =
          (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
    }
  shot_line_keep(line);
  memcpy(line->ball, numbered.ball, sizeof numbered.ball);
  memcpy(line->name, numbered.name, sizeof numbered.name);
  line->count = last + 1;
  line->cue.ball = 0;
  return true;
}

void plan_game_state(const plan_game *game, const shot_line *line, carom_plan_rules *rules) {
  enum { LAST_INNING = 3 }; /* of carom_rules_state.innings */
  static const int32_t permissions[] = {0, CAROM_CHOICE_PUSH, CAROM_CHOICE_PASS,
                                        CAROM_CHOICE_PASS | CAROM_CHOICE_FREE_BALL};
  *rules = carom_plan_rules_of((carom_rules_kind)game->rules);
  carom_rules_state *state = &rules->state;
  state->opening = game->opening;
  state->group = game->group;
  state->may = permissions[game->permission];
  state->on = game->colour;
  state->innings = game->last_inning ? LAST_INNING : 0;
  if (game->target > 0)
    state->target = game->target;
  for (int seat = 0; seat < 2; seat++) {
    const int score = game->score[seat];
    state->score[seat] = score > 0 ? score : 0;
    state->lost[seat] = score < 0 ? -score : 0;
    if (rules->pockets != NULL || game->pocket >= 0)
      state->pocket[seat] = line != NULL ? foot_of(line, (game->pocket == 1) == (seat == 0)) : 1;
  }
}

/* The option that gives a number of the state of a game's rules. */
static const char *option_of(const char *number) {
  static const struct {
    const char *number, *option;
  } named[] = {
      {"on", "colour"}, {"lost", "score"}, {"pocket", "own-pocket"}, {"innings", "last-inning"}};
  for (size_t k = 0; k < sizeof named / sizeof named[0]; k++)
    if (strcmp(number, named[k].number) == 0)
      return named[k].option;
  return number;
}

/* What is given and the game does not have, by the library's rows. */
bool plan_game_fits(const plan_game *game) {
  const char *range;
  carom_plan_rules rules;
  plan_game_state(game, NULL, &rules);
  const char *wrong = carom_rules_fault((carom_rules_kind)game->rules, &rules.state, &range);
  if (wrong != NULL)
    complain("--rules %s: --%s: it must be %s", carom_word(CAROM_WORDS_RULES, game->rules),
             option_of(wrong), range);
  return wrong == NULL;
}
