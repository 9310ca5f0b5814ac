/* The colours of pictures. */
#include "pictures/colours.h"

#include "pictures/palette.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* In the order of the numbers of pool. */
enum { SOLIDS = 8, LINES = 8 };
#define LOOK(name, colour, path, ink) {colour, path, ink},
#define NAME(name, colour, path, ink) name,
static const ball_look looks[] = {PALETTE_BALLS(LOOK)};
static const char *const names[] = {PALETTE_BALLS(NAME)};
static const ball_look *const white = &looks[0], *const yellow = &looks[1], *const red = &looks[3];

/* The look that the name of a ball says, or NULL. */
static const ball_look *named_look(const char *name) {
  if (strcmp(name, "cue") == 0)
    return white;
  if (strncmp(name, "red", 3) == 0)
    return red;
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
    if (strcmp(name, names[k]) == 0)
      return &looks[k];
  return NULL;
}

/* The number that a ball has for a name, 1 to 15; 0 where its name is none. */
static long number_of(const char *name) {
  char *end;
  const long number = strtol(name, &end, 10);
  return *end == '\0' && number >= 1 && number <= 15 ? number : 0;
}

/* Whether it is a ball of pyramid, by its size: no other game's is as large. */
static bool is_of_pyramid(double radius) {
  return radius >= 0.0335;
}

ball_look look_of(const char *name, int index, double radius) {
  if (is_of_pyramid(radius))
    return index == 0 ? *yellow : *white;
  const ball_look *named = named_look(name);
  if (named != NULL)
    return *named;
  const long number = number_of(name) > 0 ? number_of(name) : index;
  return number > 0 ? looks[1 + (number - 1) % SOLIDS] : *white;
}

const char *line_colour(int k) {
  return looks[k % LINES].path;
}

bool is_colour(const char *name) {
  return named_look(name) != NULL;
}

bool is_striped(const char *name, double radius) {
  return !is_of_pyramid(radius) && number_of(name) > SOLIDS;
}

/* Longer tables with pockets are those of snooker and pyramid, m. */
static const double longest_pool = 3.0;

#define COLOURS(discipline, cloth, cushion, wood) \
  const table_colours discipline##_colours = {cloth, cushion, wood};
PALETTE_TABLES(COLOURS)

table_colours colours_of(const carom_table *t) {
  if (t->pockets == 0)
    return carom_colours;
  return t->length > longest_pool ? snooker_colours : pool_colours;
}
