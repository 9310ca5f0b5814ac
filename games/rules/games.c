/* The games by their rows, for programs that request them; and whether a state is valid for a
 * game. */
#include "games.h"

#include <stddef.h>

/* Members of a state, and as bits. */
#define MEMBER(NAME, ...) PLACE_OF_##NAME,
enum { CAROM_ALL_MEMBERS(MEMBER) MEMBERS };
#undef MEMBER
#define MEMBER(NAME, ...) NAME = 1 << PLACE_OF_##NAME,
enum { CAROM_ALL_MEMBERS(MEMBER) NO_MEMBER = 0 };
#undef MEMBER
#define MEMBER(NAME, member, low, high, range) \
  {#member, range, sizeof(((carom_rules_state *)NULL)->member) / sizeof(int32_t), low, high},
static const struct {
  const char *name, *range;
  size_t count;
  int32_t low, high;
} members[] = {CAROM_ALL_MEMBERS(MEMBER)};
#undef MEMBER

#define GAME(NAME, rules, word, text, BALLS, TABLE, RACK, last, OPENING, HAND, calls, members, \
             may)                                                                              \
  {{word, text, CAROM_GAME_##BALLS, CAROM_RACK_##RACK, last, CAROM_LEAVE_##OPENING,            \
    CAROM_LEAVE_##HAND, CAROM_TABLE_##TABLE},                                                  \
   &rules,                                                                                     \
   calls,                                                                                      \
   members,                                                                                    \
   may},
static const struct {
  carom_rules_about about;
  const carom_plan_rules *rules;
  int calls, members, choices;
} games[] = {CAROM_GAMES(GAME)};
#undef GAME

/* Rows are indexed by their values, and each value has one: a value without a row does not
 * compile. */
#define GAME(NAME, ...) ROW_OF_##NAME,
enum { CAROM_GAMES(GAME) };
#undef GAME
#define GAME(NAME, ...) \
  _Static_assert((int)CAROM_RULES_##NAME == (int)ROW_OF_##NAME, "rows stand by their values");
CAROM_GAMES(GAME)
#undef GAME
#pragma GCC diagnostic error "-Wswitch"
static bool is_game(carom_rules_kind kind) {
#define GAME(NAME, ...) case CAROM_RULES_##NAME:
  switch (kind) {
    CAROM_GAMES(GAME)
    return true;
  }
#undef GAME
  return false;
}

const carom_rules_about *carom_rules_about_of(carom_rules_kind kind) {
  if (!is_game(kind))
    return NULL;
  return &games[kind].about;
}

int64_t carom_handicap_most(carom_rules_kind kind) {
  enum { POINTS = 1000000, MONEY_BALLS = 8, LIVES = 97 };
  if (kind == CAROM_RULES_NINEBALL)
    return MONEY_BALLS;
  if (kind == CAROM_RULES_KILLER)
    return LIVES;
  if (!is_game(kind) || (games[kind].members & SCORE) != 0)
    return POINTS;
  return 0;
}

uint32_t carom_needed_balls(carom_rules_kind kind) {
  switch (kind) {
  case CAROM_RULES_EIGHTBALL:
  case CAROM_RULES_BLACKBALL:
  case CAROM_RULES_HEYBALL:
    return UINT32_C(1) << 8;
  case CAROM_RULES_SNOOKER:
    return UINT32_C(1) << 21;
  case CAROM_RULES_BILLIARDS:
    return UINT32_C(1) << 2;
  case CAROM_RULES_THREECUSHION:
  case CAROM_RULES_STRAIGHTRAIL:
    return 0x7;
  case CAROM_RULES_FOURBALL:
  case CAROM_RULES_COWBOY:
    return 0xf;
  default:
    return 0;
  }
}

int64_t carom_seat_points(carom_rules_kind kind, uint64_t word) {
  if (kind != CAROM_RULES_CUTTHROAT)
    return (int64_t)word;
  int64_t balls = 0;
  for (; word != 0; word &= word - 1)
    balls++;
  return balls;
}

bool carom_owes_points(carom_rules_kind kind) {
  const bool has_score = !is_game(kind) || (games[kind].members & SCORE) != 0;
  return has_score && kind != CAROM_RULES_COWBOY; /* whose `lost` are points of this visit */
}

int carom_usual_seats(carom_rules_kind kind) {
  if (kind == CAROM_RULES_CUTTHROAT)
    return 3;
  return 2;
}

bool carom_has_opening(carom_rules_kind kind) {
  return is_game(kind) && (games[kind].members & OPENING) != 0;
}

carom_plan_rules carom_plan_rules_of(carom_rules_kind kind) {
  if (!is_game(kind))
    kind = CAROM_RULES_EIGHTBALL;
  carom_plan_rules rules = *games[kind].rules;
  rules.calls = games[kind].calls;
  rules.learned = (int32_t)kind + 1;
  return rules;
}

carom_status carom_begin_seats(carom_rules_kind kind, int seats, carom_rules_state *state) {
  enum { LIVES = 3, BALLS = 15 };
  if (state == NULL)
    return CAROM_ERROR_NULL;
  const bool of_seats = is_game(kind) && games[kind].rules->race == CAROM_RACE_SEATS;
  const bool cut_throat = kind == CAROM_RULES_CUTTHROAT;
  bool good = seats == 2 || (of_seats && seats > 2 && seats <= CAROM_SEATS_MOST);
  if (cut_throat)
    good = seats == 3 || seats == 5;
  if (!good)
    return CAROM_ERROR_OPTIONS;
  for (int seat = 0; seat < CAROM_SEATS_MOST && of_seats; seat++) {
    uint64_t has = 0;
    if (seat < seats)
      has = LIVES;
    if (seat < seats && cut_throat)
      has = ((UINT64_C(1) << BALLS / seats) - 1) << (1 + BALLS / seats * seat);
    state->user[seat] = has;
  }
  if (cut_throat)
    state->target = BALLS / seats;
  return CAROM_OK;
}

/* Whether this value of a member is allowed in a game: carom games, and the breaks of others, may
 * have no target. */
static bool may_be(carom_rules_kind kind, size_t member, int32_t value) {
  const bool optional =
      games[kind].rules->race == CAROM_RACE_ALONE || games[kind].rules->race == CAROM_RACE_SHARED;
  if (optional && member == PLACE_OF_TARGET && value == 0)
    return true;
  if (member == PLACE_OF_MAY && (value & ~games[kind].choices) != 0)
    return false;
  return value >= members[member].low && value <= members[member].high;
}

const char *carom_rules_fault(carom_rules_kind kind, const carom_rules_state *state,
                              const char **range) {
  if (!is_game(kind) || state == NULL || range == NULL)
    return NULL;
  const int32_t *value = &state->opening; /* all members, consecutively */
  for (size_t k = 0; k < MEMBERS; k++)
    for (size_t i = 0; i < members[k].count; i++, value++) {
      const bool has = k == PLACE_OF_SEAT || (games[kind].members >> k & 1);
      if ((has && may_be(kind, k, *value)) || (!has && *value == 0))
        continue;
      *range = "0, as the game has none";
      if (has)
        *range = members[k].range;
      return members[k].name;
    }
  return NULL;
}
