/* Places on a table and offsets of the tip, as players write them. */
#ifndef CAROM_CLI_PLACES_H
#define CAROM_CLI_PLACES_H

#include "rows/values.h"
#include "shots/shoot_aim.h"

enum { MOST_PLACES = 64 };

/* The rails by their names, with bars between them, in the order of rail_name. */
#define RAILS "head|foot|left|right"
typedef enum rail_name { RAIL_NONE = -1, RAIL_HEAD, RAIL_FOOT, RAIL_LEFT, RAIL_RIGHT } rail_name;

/* The rail that the first `size` letters of a text name. */
rail_name rail_named(const char *text, size_t size);

/* A pair of numbers, with the name that stood before it. Of a ball that touches a rail or another
 * ball, x is how far along the rail, or the direction from that ball, degrees, and y the gap
 * between the balls, m. */
typedef struct given_place {
  char name[PLACE_NAME], touches[PLACE_NAME];
  value x, y;
} given_place;

typedef struct place_list {
  int count;
  int rack; /* 1 + the carom_rack_kind that stood there, whose balls have these places; or 0 */
  given_place place[MOST_PLACES];
} place_list;

/* 1 + the carom_rack_kind with which a game is played, by the name of its rules; else 0. */
int rack_of_game(const char *text);

/* For a place_list: X,Y:X,Y:..., each perhaps behind NAME=, where balls are named, also beside the
 * name of a rack or of a game, by row->words. Of a ball on a spot of snooker that is its name.
 * RAIL,X in place of X,Y touches a rail, frozen-BALL,X a ball. */
OPTION_SET(set_places);

/* Places that have a name, as help and complaints list them. */
#define PLACES                                                                              \
  "head-spot, centre, foot-spot, head-left, head-right, side-left, side-right, foot-left, " \
  "foot-right; or a spot of snooker: yellow, green, brown, blue, pink, black"

enum { COLOURS = 6 };
extern const char *const colours_of_snooker[COLOURS];

/* Reads the name of a place, or RAIL,NUMBER, up to a comma or the end of the text. Returns what
 * follows, or `text` where it begins with neither. */
const char *place_named(const char *text, value *x, value *y);

/* Reads a position and a radius, X,Y, X,Y,R, PLACE or PLACE,R, without which the radius is the
 * usual one. False where the text is none of these, or the radius is not above 0. */
bool read_disc(const char *text, const char *usual_radius, value *x, value *y, value *radius);

/* A place, m: `diamond` is the distance of two diamonds. */
double place_along(const value *v, double diamond);

#endif
