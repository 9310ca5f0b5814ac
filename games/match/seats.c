/* Seats of a match: checks, handicaps, limits of strokes, whose turn it is, and the score of a
 * match by sides. */
#include "seats.h"
#include "games.h"
#include "record/lines.h"
#include "rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Checks */

int carom_sides_of(const carom_seating *seating) {
  int64_t sides = 0;
  for (int64_t k = 0; k < seating->count; k++)
    if (seating->seat[k].side >= sides)
      sides = seating->seat[k].side + 1;
  return (int)sides;
}

static bool is_name(const char name[CAROM_SEAT_NAME]) {
  int size = 0;
  while (size < CAROM_SEAT_NAME && carom_is_in_text(name[size]))
    size++;
  return size < CAROM_SEAT_NAME && name[size] == '\0';
}

/* The cue is valid for strokes, and specifies no stroke. */
static bool is_stick(const carom_cue *cue) {
  const carom_ball_kind ball = carom_ball_kind_of(CAROM_GAME_POOL);
  const bool strikes =
      cue->speed != 0.0 || cue->phi != 0.0 || cue->theta != 0.0 || cue->a != 0.0 || cue->b != 0.0;
  carom_motion motion;
  return !strikes && cue->ball == 0 && carom_strike(cue, &ball, &motion) == CAROM_OK;
}

static const char *seat_fault(const carom_seat *seat, const char **key) {
  *key = "name";
  if (!is_name(seat->name))
    return "must have at most 31 bytes, without control characters, quotes and backslashes";
  *key = "side";
  if (seat->side < 0 || seat->side >= CAROM_SEATS_MOST)
    return "must be 0 to 7";
  *key = "handicap";
  if (seat->handicap < 0 || seat->handicap > 1000000)
    return "must be 0 to 1000000";
  *key = "rating";
  if (seat->rating != 0.0 && !(seat->rating >= 200.0 && seat->rating <= 850.0))
    return "must be 0 or 200 to 850";
  *key = "M";
  if (!is_stick(&seat->cue))
    return "and the other members of the stick must be valid for a cue, without a stroke";
  return NULL;
}

const char *carom_seating_fault(const carom_seating *seating, const char **key) {
  *key = "list";
  if (seating->count < 2 || seating->count > CAROM_SEATS_MOST)
    return "must have 2 to 8 seats";
  uint32_t sides = 0;
  for (int64_t k = 0; k < seating->count; k++) {
    const char *fault = seat_fault(&seating->seat[k], key);
    if (fault != NULL)
      return fault;
    sides |= UINT32_C(1) << seating->seat[k].side;
  }
  *key = "side";
  if ((sides & (sides + 1)) != 0 || sides == 1)
    return "must be 0, 1 and so on: two sides or more, without a gap";
  *key = "alternate";
  if (seating->alternate < 0 || seating->alternate > 1)
    return "must be 0 or 1";
  const carom_stroke_limits *limits = &seating->limits;
#define CHECK_LIMIT(member)                                    \
  *key = #member;                                              \
  if (!(limits->member >= 0 && (double)limits->member <= 1e9)) \
    return "must be 0 to 1e9";
  CAROM_STROKE_LIMITS(CHECK_LIMIT)
  *key = "own_cue";
  if (limits->own_cue > 1)
    return "must be 0 or 1";
  return NULL;
}

const char *carom_set_fault(const carom_set *set, const char **key) {
  static const int64_t most_seed = INT64_C(9007199254740991);
#define CHECK_WHOLE(member, low, high, range)      \
  *key = #member;                                  \
  if (set->member < (low) || set->member > (high)) \
    return "must be " range;
  CHECK_WHOLE(race, 1, 1000, "1 to 1000")
  CHECK_WHOLE(order, 0, CAROM_BREAKS_LOSER, "a carom_break_order")
  CHECK_WHOLE(first, 0, CAROM_SEATS_MOST - 1, "a side")
  CHECK_WHOLE(number, 1, 1000000, "1 to 1000000")
  CHECK_WHOLE(seed, 0, most_seed, "0 to 2^53 - 1")
  CHECK_WHOLE(target, 0, 1000000, "0 to 1000000")
  CHECK_WHOLE(equal_innings, 0, 1, "0 or 1")
  CHECK_WHOLE(extensions, 0, 1000, "0 to 1000")
  CHECK_WHOLE(timeouts, 0, 1000, "0 to 1000")
  for (int k = 0; k < CAROM_SEATS_MOST; k++) {
    CHECK_WHOLE(won[k], 0, set->race - 1, "below the race")
  }
  *key = "clock";
  if (!(set->clock >= 0.0 && set->clock <= 1e6 && set->extension >= 0.0 && set->extension <= 1e6))
    return "and extension must be 0 to 1e6";
  return NULL;
}

const char *carom_seats_fault(const carom_plan_rules *rules, carom_rules_kind kind,
                              const carom_seating *seating) {
  const int sides = carom_sides_of(seating);
  if (rules->race != CAROM_RACE_SEATS && sides != 2)
    return "this game has two sides";
  if (rules->race == CAROM_RACE_SEATS && sides != seating->count)
    return "in this game each seat is a side";
  for (int64_t k = 0; rules->race == CAROM_RACE_SEATS && k < seating->count; k++)
    if (seating->seat[k].side != k)
      return "in this game the side of a seat is its index";
  for (int64_t k = 0; k < seating->count; k++)
    if (seating->seat[k].handicap > carom_handicap_most(kind))
      return "the handicap is more than this game has";
  return NULL;
}

/* ---- Beginning */

carom_status carom_seating_make(carom_rules_kind kind, int seats, carom_seating *seating) {
  if (seating == NULL)
    return CAROM_ERROR_NULL;
  const carom_rules_about *about = carom_rules_about_of(kind);
  carom_game game = CAROM_GAME_POOL;
  if (about != NULL)
    game = (carom_game)about->balls;
  memset(seating, 0, sizeof *seating);
  if (seats == 0)
    seats = carom_usual_seats(kind);
  if (seats < 2 || seats > CAROM_SEATS_MOST)
    return CAROM_ERROR_ACT;
  carom_cue cue = carom_cue_of(game);
  cue.speed = cue.phi = cue.theta = cue.a = cue.b = 0.0;
  seating->count = seats;
  for (int k = 0; k < seats; k++) {
    seating->seat[k].side = k;
    seating->seat[k].cue = cue;
  }
  seating->limits = (carom_stroke_limits){.speed = 15.0,
                                          .theta = 90.0,
                                          .tip = 0.75,
                                          .mass_least = 0.2,
                                          .mass_most = 1.2,
                                          .end_mass_least = 0.001};
  carom_plan_rules rules = carom_plan_rules_of(kind);
  const bool is_own = about != NULL && rules.race == CAROM_RACE_SEATS;
  if (is_own && carom_begin_seats(kind, seats, &rules.state) != CAROM_OK)
    return CAROM_ERROR_ACT;
  if (about != NULL && !is_own && seats != 2) /* partners: every other seat */
    for (int k = 0; k < seats; k++)
      seating->seat[k].side = k % 2;
  return CAROM_OK;
}

/* The handicap of a side: of its first seat. */
static int64_t handicap_of(const carom_seating *seating, int64_t side) {
  for (int64_t k = 0; k < seating->count; k++)
    if (seating->seat[k].side == side)
      return seating->seat[k].handicap;
  return 0;
}

void carom_seats_begin(const carom_seating *seating, carom_rules_kind kind, int64_t side,
                       carom_plan_rules *rules) {
  carom_rules_state *state = &rules->state;
  if (rules->race == CAROM_RACE_SEATS) {
    state->seat = (int32_t)side;
    for (int64_t k = 0; k < seating->count; k++)
      if (state->user[k] != 0)
        state->user[k] += (uint64_t)seating->seat[k].handicap;
    return;
  }
  int32_t *pair = state->score;
  if (kind == CAROM_RULES_NINEBALL)
    pair = state->lost;
  for (int64_t k = 0; k < 2; k++)
    carom_add(&pair[k], (int)handicap_of(seating, side ^ k));
}

/* ---- Limits */

bool carom_is_beyond(const carom_match *match, const carom_cue *cue, char *text, size_t room) {
  const carom_stroke_limits *limits = &match->seating.limits;
  double restitution = cue->tip_restitution;
  if (restitution == 0.0)
    restitution = 1.0;
  const struct {
    const char *name, *unit;
    double value, least, most;
  } bounds[] = {
      {"cue.speed", " m/s", cue->speed, 0.0, limits->speed},
      {"cue.theta", " degrees", cue->theta, 0.0, limits->theta},
      {"sqrt(a^2 + b^2)", " radii", sqrt(cue->a * cue->a + cue->b * cue->b), 0.0, limits->tip},
      {"cue.mass", " kg", cue->mass, limits->mass_least, limits->mass_most},
      {"cue.end_mass", " kg", cue->end_mass, limits->end_mass_least, 0.0},
      {"cue.tip_restitution", "", restitution, 0.0, limits->tip_restitution_most},
  };
  for (size_t k = 0; k < sizeof bounds / sizeof *bounds; k++) {
    if (bounds[k].most > 0.0 && !(bounds[k].value <= bounds[k].most)) {
      snprintf(text, room, "%s must be at most %g%s in this match", bounds[k].name, bounds[k].most,
               bounds[k].unit);
      return true;
    }
    if (bounds[k].least > 0.0 && !(bounds[k].value >= bounds[k].least)) {
      snprintf(text, room, "%s must be at least %g%s in this match", bounds[k].name,
               bounds[k].least, bounds[k].unit);
      return true;
    }
  }
  carom_cue stick = *cue;
  stick.speed = stick.phi = stick.theta = stick.a = stick.b = 0.0;
  stick.ball = 0;
  if (limits->own_cue == 0 ||
      memcmp(&stick, &match->seating.seat[match->seat].cue, sizeof stick) == 0)
    return false;
  snprintf(text, room, "stick and tip must be the same as for seat %d", (int)match->seat);
  return true;
}

/* ---- Turns */

int32_t carom_seat_of_side(const carom_match *match, int64_t side) {
  int32_t seats[CAROM_SEATS_MOST], count = 0;
  for (int32_t k = 0; k < match->seating.count; k++)
    if (match->seating.seat[k].side == side)
      seats[count++] = k;
  if (count == 0)
    return 0;
  return seats[match->turns[side] % count];
}

void carom_take_seat(carom_match *match) {
  carom_record *record = &match->record;
  if (match->rules.race == CAROM_RACE_SEATS)
    record->player = match->rules.state.seat;
  match->seat = carom_seat_of_side(match, record->player);
  if (match->seating.count > 2)
    match->rules.state.seat = record->standing.seat = match->seat;
}

void carom_end_visit(carom_match *match, bool struck, bool passes) {
  if (struck && (passes || match->seating.alternate != 0))
    match->turns[match->record.player]++;
}

/* ---- How a match stands */

carom_status carom_match_standing(const carom_match *match, carom_standing *standing) {
  if (match == NULL || standing == NULL)
    return CAROM_ERROR_NULL;
  const carom_record *record = &match->record;
  const carom_rules_state *state = &match->rules.state;
  memset(standing, 0, sizeof *standing);
  standing->sides = carom_sides_of(&match->seating);
  for (int64_t k = 0; k < match->seating.count; k++)
    standing->side_of[k] = match->seating.seat[k].side;
  for (int64_t k = 0; k < standing->sides; k++) {
    if (match->rules.race == CAROM_RACE_SEATS)
      standing->points[k] = carom_seat_points((carom_rules_kind)record->rules, state->user[k]);
    else {
      const bool other = k != record->player;
      standing->points[k] = (int64_t)state->score[other];
      if (carom_owes_points((carom_rules_kind)record->rules))
        standing->points[k] -= state->lost[other];
    }
    standing->won[k] = record->set.won[k] + (record->set.race > 0 && match->winner == 1 + k);
    if (record->set.race > 0 && standing->won[k] >= record->set.race)
      standing->set_winner = 1 + k;
  }
  return CAROM_OK;
}

/* The name of a seat, such as "Ann (seat 0)". */
static void put_name(const carom_match *match, int64_t seat, char *text, size_t room) {
  const char *name = match->seating.seat[seat].name;
  if (name[0] != '\0')
    snprintf(text, room, "%s (seat %d)", name, (int)seat);
  else
    snprintf(text, room, "seat %d", (int)seat);
}

size_t carom_match_string(const carom_match *match, char *text, size_t room) {
  if (match == NULL)
    return 0;
  if (text == NULL)
    room = 0;
  int size;
  char name[64];
  if (match->phase == CAROM_MATCH_OVER && match->winner == CAROM_DRAWN)
    size = snprintf(text, room, "the match is drawn");
  else if (match->phase == CAROM_MATCH_OVER && match->winner > 0) {
    char names[CAROM_SEATS_MOST * 64] = "";
    size_t used = 0;
    int count = 0;
    for (int64_t k = 0; k < match->seating.count; k++)
      if (match->seating.seat[k].side == match->winner - 1) {
        put_name(match, k, name, sizeof name);
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s",
                                 count++ > 0 ? " and " : "", name);
      }
    size = snprintf(text, room, "%s %s won", names, count > 1 ? "have" : "has");
  } else if (match->phase == CAROM_MATCH_NONE || match->phase == CAROM_MATCH_OVER)
    size = snprintf(text, room, "%s", carom_word_text(CAROM_WORDS_PHASE, match->phase));
  else {
    put_name(match, match->seat, name, sizeof name);
    size = snprintf(text, room, "%s: %s", name, carom_word_text(CAROM_WORDS_PHASE, match->phase));
  }
  return (size_t)carom_max(size, 0);
}
