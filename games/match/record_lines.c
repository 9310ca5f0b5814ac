/* Lines of games in recordings: "game", the state of a game, and "act", the decision of a
 * player. */
#include "carom_plan.h"
#include "platform/arithmetic.h"
#include "record/lines.h"
#include "schema/numbers.h"
#include "seats.h"
#include "state_members.h"

#include <string.h>

#define MEMBER_FIELD(NAME, member, ...) CAROM_MEMBER_FIELD(#member, carom_record, standing.member)
static const carom_field game_fields[] = {
    CAROM_RECORD_FIELD("rules", INT64, true, 1, rules),
    CAROM_RECORD_FIELD("player", INT64, false, 1, side),
    CAROM_STATE_MEMBERS(MEMBER_FIELD) CAROM_RECORD_FIELD("user", INT64, false, 8, standing.user),
    CAROM_RECORD_FIELD("winner", INT64, false, 1, winner),
    CAROM_RECORD_FIELD("foul", INT64, false, 1, foul),
    CAROM_SEAL_FIELD,
    CAROM_LATER_MEMBERS(MEMBER_FIELD) CAROM_NO_FIELD};
static const carom_field act_fields[] = {CAROM_RECORD_FIELD("act", INT64, true, 1, act),
                                         CAROM_RECORD_FIELD("player", INT64, false, 1, actor),
                                         CAROM_RECORD_FIELD("choice", INT64, false, 1, choice),
                                         CAROM_RECORD_FIELD("call", INT64, false, 2, call),
                                         CAROM_SEAL_FIELD,
                                         CAROM_NO_FIELD};

#define SEAT_FIELD(member) CAROM_MEMBER_FIELD(#member, carom_seat, member)
#define STICK_FIELD(member, ...) CAROM_MEMBER_FIELD(#member, carom_seat, cue.member)
static const carom_field seat_fields[] = {
    {"name", CAROM_VALUE_TEXT, false, 1, offsetof(carom_seat, name), CAROM_SEAT_NAME, 0, NULL},
    SEAT_FIELD(side) SEAT_FIELD(handicap) SEAT_FIELD(rating)
        CAROM_CUE_NUMBERS(STICK_FIELD, STICK_FIELD) CAROM_NO_FIELD};
#define LIMIT_FIELD(member) CAROM_MEMBER_FIELD(#member, carom_record, seating.limits.member)
static const carom_field seats_fields[] = {
    {"list", CAROM_VALUE_LIST, true, CAROM_SEATS_MOST, offsetof(carom_record, seating.seat),
     sizeof(carom_seat), offsetof(carom_record, seating.count), seat_fields},
    CAROM_RECORD_FIELD("alternate", INT64, false, 1, seating.alternate),
    CAROM_STROKE_LIMITS(LIMIT_FIELD) CAROM_NO_FIELD};
#define SET_FIELD(member) CAROM_MEMBER_FIELD(#member, carom_record, set.member)
static const carom_field set_fields[] = {CAROM_SET_NUMBERS(SET_FIELD) CAROM_NO_FIELD};

enum { RULES_MOST = 1000 }; /* more kinds of rules than there will be */

/* The state of the game: each member within its row, or 0 for a game without it. */
static const char *find_fault_of_game(const carom_record *record, const char **key) {
  const carom_rules_state *state = &record->standing;
  int32_t value[2];
#define CHECK_MEMBER(NAME, member, low, high, range)                \
  *key = #member;                                                   \
  memcpy(value, &state->member, sizeof state->member);              \
  for (size_t k = 0; k < sizeof state->member / sizeof *value; k++) \
    if (value[k] != 0 && (value[k] < (low) || value[k] > (high)))   \
      return "must be " range;
  CAROM_ALL_MEMBERS(CHECK_MEMBER)
  *key = "rules";
  if (record->rules < 0 || record->rules > RULES_MOST)
    return "must be a carom_rules_kind";
  *key = "winner";
  if (record->winner < 0 || record->winner > CAROM_DRAWN)
    return "must be 0 to 9";
  *key = "player";
  if (record->side < 0 || record->side >= CAROM_SEATS_MOST)
    return "must be 0 to 7";
  return NULL;
}

static const char *find_fault_of_act(const carom_record *record, const char **key) {
  *key = "player";
  if (record->actor < 0 || record->actor >= CAROM_SEATS_MOST)
    return "must be 0 to 7";
  return NULL;
}

static const char *find_fault_of_seats(const carom_record *record, const char **key) {
  return carom_seating_fault(&record->seating, key);
}

static const char *find_fault_of_set(const carom_record *record, const char **key) {
  return carom_set_fault(&record->set, key);
}

/* Where a ball in hand may be placed. */
static const char *find_fault_of_place(const carom_record *record, const char **key) {
  *key = "bounds";
  if (record->bounds < CAROM_LEAVE_AFTER || record->bounds > CAROM_LEAVE_BAULK)
    return "must be a carom_leave";
  return NULL;
}

const carom_line carom_upper_lines[CAROM_LINE_KINDS] = {
    [CAROM_RECORD_GAME] = {.key = "game",
                           .fields = game_fields,
                           .is_sealed = true,
                           .find_fault = find_fault_of_game},
    [CAROM_RECORD_ACT] = {.key = "act",
                          .fields = act_fields,
                          .is_sealed = true,
                          .is_of_match = true,
                          .find_fault = find_fault_of_act},
    [CAROM_RECORD_SEATS] = {.key = "seats",
                            .fields = seats_fields,
                            .is_of_match = true,
                            .find_fault = find_fault_of_seats},
    [CAROM_RECORD_SET] = {.key = "set",
                          .fields = set_fields,
                          .is_of_match = true,
                          .find_fault = find_fault_of_set},
    [CAROM_RECORD_PLACE] = {.find_fault = find_fault_of_place}};
