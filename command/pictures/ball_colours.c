/* The colours of balls in pictures, by their names. */
#include "pictures/ball_colours.h"

#include <stdlib.h>
#include <string.h>

const char *const ball_colours[16] = {
    "#ffffff", "#ffd84a", "#8fc1ff", "#ff8d80", "#d3b3ff", "#ffb466", "#b6f09c", "#f2a0bd",
    "#111111", "#ffd84a", "#8fc1ff", "#ff8d80", "#d3b3ff", "#ffb466", "#b6f09c", "#f2a0bd"};

const char *named_colour(const char *name) {
  static const struct {
    const char *name, *colour;
  } named[] = {{"cue", "#ffffff"},   {"white", "#ffffff"}, {"yellow", "#ffd84a"},
               {"green", "#b6f09c"}, {"brown", "#c9a27a"}, {"blue", "#8fc1ff"},
               {"pink", "#f2a0bd"},  {"black", "#111111"}};
  for (size_t k = 0; k < sizeof named / sizeof named[0]; k++)
    if (strcmp(name, named[k].name) == 0)
      return named[k].colour;
  return strncmp(name, "red", 3) == 0 ? "#ff8d80" : NULL;
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

const char *colour_of(const char *name, int index, double radius) {
  if (is_of_pyramid(radius))
    return ball_colours[index == 0];
  const char *named = named_colour(name);
  if (named != NULL)
    return named;
  const long number = number_of(name);
  return number > 0 ? ball_colours[number] : ball_colours[index % 16];
}

bool is_striped(const char *name, double radius) {
  return !is_of_pyramid(radius) && number_of(name) >= 9;
}
