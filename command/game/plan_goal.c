/* --leave of `carom plan`: what the stroke is to leave, by the words of the library's goals. */
#include "game/plan_goal.h"

#include "program/message.h"
#include "shots/places.h"
#include "shots/shoot_aim.h"

#include <string.h>

OPTION_SET(set_goal) {
  given_goal *goal = field;
  const size_t size = strcspn(text, ":");
  char *target = text[size] == ':' ? text + size + 1 : NULL;
  for (int kind = CAROM_GOAL_HIDDEN; kind <= CAROM_GOAL_APART; kind++) {
    const char *word = carom_word(CAROM_WORDS_GOAL, kind);
    const bool is_word = strlen(word) == size && strncmp(word, text, size) == 0;
    if (!is_word || (target == NULL) != (kind == CAROM_GOAL_HIDDEN))
      continue;
    *goal = (given_goal){.kind = kind, .target = target};
    return kind != CAROM_GOAL_NEAR || set_leave(row, target, &goal->place);
  }
  return refuse_value(row, text,
                      "no such goal; try hidden, snooker:8, near:foot-spot,20cm or apart:1,2");
}

/* The ball on the table with this name; -1 after a complaint. */
static int ball_of(const shot_line *line, const char *name, size_t size) {
  for (int k = 1; k < line->count; k++)
    if (strlen(line->name[k]) == size && strncmp(line->name[k], name, size) == 0 &&
        !is_out_of_play(&line->ball[k].state))
      return k;
  complain("--leave: no ball '%.*s' is on the table; give the name of one that is", (int)size,
           name);
  return -1;
}

bool plan_goal_of(const given_goal *given, const shot_line *line, const carom_plan_rules *rules,
                  carom_plan_goal *goal) {
  const carom_table *table = &line->table->table;
  const bool hides = given->kind == CAROM_GOAL_HIDDEN || given->kind == CAROM_GOAL_SNOOKER;
  *goal = (carom_plan_goal){.kind = given->kind, .distance = 2.0 * line->ball[0].kind.radius};
  if (hides && (rules->race == CAROM_RACE_ALONE || table->pockets == 0 || rules->any_cue_ball ||
                rules->own_cue_balls)) {
    complain(
        "--leave %s: the game has no opponent who must hit a ball with the same cue ball; give "
        "--rules eightball, nineball, snooker or another game of two with pockets",
        carom_word(CAROM_WORDS_GOAL, given->kind));
    return false;
  }
  if (given->kind == CAROM_GOAL_NEAR) {
    goal->place[0] = place_along(&given->place.x, 0.25 * table->width);
    goal->place[1] = place_along(&given->place.y, 0.125 * table->length);
    goal->distance = place_along(&given->place.radius, 0.125 * table->length);
    const bool on_table = goal->place[0] >= 0.0 && goal->place[0] <= table->width &&
                          goal->place[1] >= 0.0 && goal->place[1] <= table->length;
    if (!on_table)
      complain("--leave near: the place %.4g, %.4g m is not on the table, which is %.4g by %.4g m",
               goal->place[0], goal->place[1], table->width, table->length);
    return on_table;
  }

  /* the balls, with commas between */
  for (const char *name = given->target; name != NULL;) {
    const size_t size = given->kind == CAROM_GOAL_APART ? strcspn(name, ",") : strlen(name);
    goal->ball = ball_of(line, name, size);
    if (goal->ball < 0)
      return false;
    goal->balls |= UINT32_C(1) << goal->ball;
    name = name[size] == ',' ? name + size + 1 : NULL;
  }
  return true;
}
