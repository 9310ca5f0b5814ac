/* The game of `carom plan`: its options, the state of its rules, and balls by their numbers. */
#include "game/plan_game.h"
#include "program/message.h"
#include "shots/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OPTION_SET(set_score) {
  int *score = field, end = 0;
  const bool good = sscanf(text, "%9d,%9d%n", &score[0], &score[1], &end) == 2 && text[end] == 0;
  if (!good)
    complain("--%s is OWN,OTHER, whole numbers, not '%.60s'", row->name, text);
  return good;
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
  return end != digits && *end == '\0' && number >= 1 && number <= CAROM_BALLS_MOST ? (int)number
                                                                                    : 0;
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

/* Puts the balls where their numbers are, with those that are missing in a pocket: the line's
 * balls and names change. */
bool plan_game_order(const plan_game *game, shot_line *line, const char *file) {
  const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)game->rules);
  const carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)game->rules);
  const int last = about->last;
  const bool snooker = about->rack == CAROM_RACK_SNOOKER;
  if (last == 0)
    return true;
  if (rules.pockets != NULL && (foot_of(line, true) < 0 || foot_of(line, false) < 0)) {
    complain("%s:%zu: %s needs a table with corner pockets at the foot", file, line->number,
             about->name);
    return false;
  }

  carom_shot_ball ball[CAROM_BALLS_MOST];
  char *name[CAROM_BALLS_MOST] = {0};
  bool good = true;
  for (int k = 0; k < line->count && good; k++) {
    const bool cue = k == line->cue.ball;
    const int number = cue ? 0 : number_of(line->name[k], snooker);
    good = cue || (number >= 1 && number <= last);
    if (!good || name[number] != NULL) {
      complain("%s:%zu: ball '%s': the balls of this game are the cue ball and %s, each once", file,
               line->number, line->name[k],
               snooker     ? "red1 to red15, yellow, green, brown, blue, pink, black"
               : last == 9 ? "1 to 9"
                           : "1 to 15");
      return false;
    }
    ball[number] = line->ball[k];
    name[number] = line->name[k];
  }

  /* where balls count, those are down */
  const int own = game->score[0] > 0 ? game->score[0] : 0,
            other = game->score[1] > 0 ? game->score[1] : 0;
  const int down = last + 1 - line->count;
  if (rules.race == CAROM_RACE_OWN && own + other > down) {
    complain("%s:%zu: --score: %d balls count, but %d of %d are down", file, line->number,
             own + other, down, last);
    return false;
  }

  /* missing balls are down */
  for (int k = 0; k <= last; k++)
    if (name[k] == NULL) {
      char text[16];
      if (snooker && k >= YELLOW)
        snprintf(text, sizeof text, "%s", colours_of_snooker[k - YELLOW]);
      else
        snprintf(text, sizeof text, snooker ? "red%d" : "%d", k);
      name[k] = strdup(text);
      ball[k] = line->ball[0];
      ball[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
    }
  memcpy(line->ball, ball, sizeof ball);
  memcpy(line->name, name, sizeof name);
  line->count = last + 1;
  line->cue.ball = 0;
  return true;
}

void plan_game_state(const plan_game *game, const shot_line *line, carom_plan_rules *rules) {
  static const int32_t may[] = {0, CAROM_MAY_PUSH, CAROM_MAY_PASS,
                                CAROM_MAY_PASS | CAROM_MAY_FREE_BALL};
  *rules = carom_plan_rules_of((carom_rules_kind)game->rules);
  carom_rules_state *state = &rules->state;
  state->opening = game->opening;
  state->group = game->group;
  state->may = may[game->may];
  state->on = game->colour;
  state->target = game->target > 0 ? game->target : state->target;
  for (int who = 0; who < 2; who++) {
    state->score[who] = game->score[who] > 0 ? game->score[who] : 0;
    state->lost[who] = game->score[who] < 0 ? -game->score[who] : 0;
    if (rules->pockets != NULL || game->pocket >= 0)
      state->pocket[who] = line != NULL ? foot_of(line, (game->pocket == 1) == (who == 0)) : 1;
  }
}

/* What is given and the game does not have, by the library's rows. */
bool plan_game_fits(const plan_game *game) {
  const char *range;
  carom_plan_rules rules;
  plan_game_state(game, NULL, &rules);
  const char *wrong = carom_rules_fault((carom_rules_kind)game->rules, &rules.state, &range);
  if (wrong != NULL)
    complain("--rules %s: --%s: it must be %s", carom_word(CAROM_WORDS_RULES, game->rules),
             strcmp(wrong, "on") == 0       ? "colour"
             : strcmp(wrong, "lost") == 0   ? "score"
             : strcmp(wrong, "pocket") == 0 ? "own-pocket"
                                            : wrong,
             range);
  return wrong == NULL;
}
