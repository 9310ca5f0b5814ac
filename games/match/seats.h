/* Seats of a match: who plays, with what, and what a stroke may be. */
#ifndef CAROM_PLAN_SEATS_H
#define CAROM_PLAN_SEATS_H

#include "carom_match.h"

#include <stdbool.h>

/* Numbers of lines "seats" and "set". */
#define CAROM_STROKE_LIMITS(MEMBER) \
  MEMBER(speed)                     \
  MEMBER(theta)                     \
  MEMBER(tip)                       \
  MEMBER(mass_least)                \
  MEMBER(mass_most) MEMBER(end_mass_least) MEMBER(tip_restitution_most) MEMBER(own_cue)
#define CAROM_SET_NUMBERS(MEMBER) \
  MEMBER(race)                    \
  MEMBER(order)                   \
  MEMBER(first)                   \
  MEMBER(number)                  \
  MEMBER(won)                     \
  MEMBER(seed)                    \
  MEMBER(target)                  \
  MEMBER(equal_innings) MEMBER(clock) MEMBER(extension) MEMBER(extensions) MEMBER(timeouts)

/* What a member must be that is wrong, and its key; NULL: nothing is. */
const char *carom_seating_fault(const carom_seating *seating, const char **key);
const char *carom_set_fault(const carom_set *set, const char **key);

/* What keeps the rules from being played by these seats; NULL: nothing. */
const char *carom_seats_fault(const carom_plan_rules *rules, carom_rules_kind kind,
                              const carom_seating *seating);

/* The state of a game that begins: handicaps, and what each seat has. */
void carom_seats_begin(const carom_seating *seating, carom_rules_kind kind, int64_t side,
                       carom_plan_rules *rules);

/* A text with the limit that a stroke exceeds; false: none. */
bool carom_is_beyond(const carom_match *match, const carom_cue *cue, char *text, size_t room);

/* Whose turn of a side it is behind a ruling: of a stroke or not, which passes the table or not. */
void carom_end_visit(carom_match *match, bool struck, bool passes);
/* The seat of a side whose turn it is. */
int32_t carom_seat_of_side(const carom_match *match, int64_t side);
/* Brings the seat whose turn it is to the table. */
void carom_take_seat(carom_match *match);

/* How many sides there are. */
int carom_sides_of(const carom_seating *seating);

#endif
