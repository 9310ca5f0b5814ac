/* Which part of a job carom_plan() rejects with CAROM_ERROR_OPTIONS, as a text: the member, its
 * value and its range. The order follows the checks in prepare.c. */
#include "goals.h"
#include "plan_options.h"
#include "player.h"
#include "prepare.h"
#include "view.h"

#include "platform/arithmetic.h"
#include "platform/ranges.h"

#include <math.h>
#include <stdio.h>

/* A text of limited room. */
typedef struct fault_text {
  char *text;
  size_t room;
} fault_text;

/* Writes "OBJECT->MEMBER is VALUE; it must be RANGE". */
static size_t write_number(fault_text out, const char *object, const carom_number *number,
                           double value) {
  char range[100];
  carom_number_range(number, range, sizeof range);
  const int size = snprintf(out.text, out.room, "%s->%s is %.9g; it must be %s", object,
                            number->name, value, range);
  return (size_t)carom_max(size, 0);
}

static size_t write_words(fault_text out, const char *words) {
  const int size = snprintf(out.text, out.room, "%s", words);
  return (size_t)carom_max(size, 0);
}

/* The value of a number of an object; a seed may have any value. */
static double value_of(const carom_number *number, const void *object) {
  const void *at = (const char *)object + number->offset;
  switch (number->type) {
  case CAROM_TYPE_INT32:
    return *(const int32_t *)at;
  case CAROM_TYPE_INT64:
    return (double)*(const int64_t *)at;
  case CAROM_TYPE_UINT64:
    return number->low;
  default:
    return *(const double *)at;
  }
}

static bool is_in_range(const carom_number *number, double value) {
  return (value >= number->low && value <= number->high) || value == number->other;
}

static size_t options_fault(const carom_plan_options *options, fault_text out) {
  const carom_number *number;
  for (int k = 0; (number = carom_number_of(CAROM_PART_PLAN_OPTIONS, k)) != NULL; k++) {
    const double value = value_of(number, options);
    if (!is_in_range(number, value))
      return write_number(out, "options", number, value);
  }
  if (options->slice < 0) {
    const int size = snprintf(out.text, out.room, "options->slice is %lld; it must be 0 or more",
                              (long long)options->slice);
    return (size_t)carom_max(size, 0);
  }
  if (!CAROM_RESERVED_IS_ZERO(options))
    return write_words(out, "options->reserved[0] must be 0");
  return 0;
}

static size_t player_fault(const carom_player *player, const char *name, fault_text out) {
  const carom_number *number = carom_player_wrong_number(player);
  if (number != NULL)
    return write_number(out, name, number, value_of(number, player));
  if (carom_player_is_good(player))
    return 0;
  const int size = snprintf(out.text, out.room,
                            "%s->speed_most is %.9g; it must be 0, or at least speed_least, which "
                            "is %.9g, in m/s",
                            name, player->speed_most, player->speed_least);
  return (size_t)carom_max(size, 0);
}

static size_t rules_fault(const carom_plan_rules *rules, fault_text out) {
  if (rules->on == NULL || rules->judge == NULL || rules->left == NULL)
    return write_words(out, "rules->on, rules->judge and rules->left must be functions, not NULL");
  if ((uint32_t)rules->breaks > 2)
    return write_words(out, "rules->breaks must be 0 to 2");
  if ((uint32_t)rules->race > CAROM_RACE_SEATS)
    return write_words(out, "rules->race must be one of carom_race");
  if (rules->race == CAROM_RACE_SEATS && rules->value == NULL)
    return write_words(out, "rules->value must be a function in a race of seats, not NULL");
  if (carom_rack_size((carom_rack_kind)rules->rack) == 0)
    return write_words(out, "rules->rack must be one of carom_rack_kind");
  if (rules->learned < 0)
    return write_words(out, "rules->learned must be 0 or more");
  if ((uint32_t)rules->own_cue_balls > 1)
    return write_words(out, "rules->own_cue_balls must be 0 or 1");
  return write_words(out, "rules->reserved must be 0");
}

size_t carom_plan_fault(const carom_plan_job *job, char *text, size_t room) {
  fault_text out = {text, room};
  if (text == NULL)
    out.room = 0;
  if (out.room > 0)
    text[0] = '\0';
  if (job == NULL)
    return 0;

  /* callers need the memory of the options before they have a complete job */
  const carom_plan_options *options = carom_search_options(job->options);
  size_t size = options_fault(options, out);
  if (size > 0 || !carom_search_is_whole(job))
    return size;

  size = player_fault(job->player, "player", out);
  if (size == 0)
    size = player_fault(carom_opponent_of(job, options), "opponent", out);
  if (size == 0 && !carom_search_has_good_rules(job->rules))
    size = rules_fault(job->rules, out);
  if (size == 0 && (uint64_t)job->leave > CAROM_LEAVE_BAULK)
    size = write_words(out, "job->leave must be one of carom_leave");
  if (size == 0 && !carom_goal_is_good(job))
    size = write_words(out, "job->goal is not possible in this layout or with these rules");
  if (size == 0 && !CAROM_RESERVED_IS_ZERO(job))
    size = write_words(out, "job->reserved[0] must be 0");
  return size;
}
