/* The game of `carom plan`: its options, the state of its rules, and balls by their numbers. */
#include "plan_game.h"
#include "message.h"
#include "places.h"

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
  static const int lasts[] = {15, 9, 0, 0, 15, 21, 15}; /* 0: balls have any names */
  const int last = lasts[game->rules];
  const bool snooker = game->rules == CAROM_RULES_SNOOKER;
  if (last == 0)
    return true;
  if (game->rules == CAROM_RULES_ONEPOCKET &&
      (foot_of(line, true) < 0 || foot_of(line, false) < 0)) {
    complain("%s:%zu: one-pocket needs a table with corner pockets at the foot", file,
             line->number);
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

  /* in one-pocket those that count are down */
  const int own = game->score[0] > 0 ? game->score[0] : 0,
            other = game->score[1] > 0 ? game->score[1] : 0;
  const int down = last + 1 - line->count;
  if (game->rules == CAROM_RULES_ONEPOCKET && own + other > down) {
    complain("%s:%zu: --score: %d balls count, but %d of 15 are down", file, line->number,
             own + other, down);
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

/* What may be done in a game: the same, or 0. */
static int may_of(int rules, int may) {
  enum { PUSH = 1, PASS = 2, FREE = 3 };
  const bool nine = rules == CAROM_RULES_NINEBALL, snooker = rules == CAROM_RULES_SNOOKER;
  const bool passes = nine || snooker || rules == CAROM_RULES_STRAIGHT;
  return (may == PUSH && nine) || (may == PASS && passes) || (may == FREE && snooker) ? may : 0;
}

bool plan_game_fits(const plan_game *game) {
  if (game->group != NOT_GIVEN && game->rules != CAROM_RULES_EIGHTBALL)
    complain("--group: it is of eight-ball, so --rules eightball is needed");
  else if (game->may > 0 && game->may != may_of(game->rules, game->may))
    complain(
        "--may: a push-out is of nine-ball, to pass of that, straight pool and snooker, a free "
        "ball of snooker");
  else if (game->opening && game->rules >= CAROM_RULES_POTTING &&
           game->rules != CAROM_RULES_STRAIGHT)
    complain("--opening: it is of eight-ball, nine-ball and straight pool");
  else if ((game->score[0] != 0 || game->score[1] != 0) && game->rules < CAROM_RULES_STRAIGHT)
    complain("--score: it is of straight pool, snooker and one-pocket");
  else if ((game->score[0] < 0 || game->score[1] < 0) && game->rules != CAROM_RULES_ONEPOCKET)
    complain("--score: it must be at least 0; below it are balls that are owed in one-pocket");
  else if (game->target > 0 && game->rules != CAROM_RULES_STRAIGHT)
    complain("--target: it is of straight pool, so --rules straight is needed");
  else if (game->pocket > 0 && game->rules != CAROM_RULES_ONEPOCKET)
    complain("--own-pocket: it is of one-pocket, so --rules onepocket is needed");
  else if (game->colour && game->rules != CAROM_RULES_SNOOKER)
    complain("--colour: it is of snooker, so --rules snooker is needed");
  else
    return true;
  return false;
}

/* The state of a game, as carom_rules_kind has it. */
void plan_game_state(const plan_game *game, const shot_line *line, carom_rules_state *state) {
  state->opening = game->opening;
  state->group = game->group > 0 ? game->group : 0;
  state->on = game->colour;
  state->target = game->target > 0 ? game->target : state->target;
  for (int who = 0; who < 2; who++) {
    state->score[who] = game->score[who] > 0 ? game->score[who] : 0;
    state->lost[who] = game->score[who] < 0 ? -game->score[who] : 0;
    if (game->rules == CAROM_RULES_ONEPOCKET)
      state->pocket[who] = foot_of(line, (game->pocket == 1) == (who == 0));
  }
  static const int32_t may[] = {0, CAROM_MAY_PUSH, CAROM_MAY_PASS,
                                CAROM_MAY_PASS | CAROM_MAY_FREE_BALL};
  state->may = game->may > 0 ? may[game->may] : 0;
}
