/* Places and offsets of the tip, as players write them: X,Y in m or in diamonds, names, lists and
 * ranges. */
#include "places.h"

#include "message.h"
#include "words.h"

#include "carom_shot.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TEXT = 1024 };
static const char frozen[] = "frozen-";

/* In diamonds, as every table has them: corners and middles of the long rails lie at the noses. */
static const struct {
  const char *name, *place;
} places[] = {{"head-spot", "2d,2d"},  {"centre", "2d,4d"},     {"foot-spot", "2d,6d"},
              {"head-left", "0d,0d"},  {"head-right", "4d,0d"}, {"side-left", "0d,4d"},
              {"side-right", "4d,4d"}, {"foot-left", "0d,8d"},  {"foot-right", "4d,8d"}};

const char *const colours_of_snooker[COLOURS] = {"yellow", "green", "brown",
                                                 "blue",   "pink",  "black"};

/* Which of the words a text begins with, up to a comma or its end; -1: none. */
static int colour_at(const char *text) {
  const size_t size = strcspn(text, ",");
  for (int k = 0; k < COLOURS; k++)
    if (strlen(colours_of_snooker[k]) == size && strncmp(colours_of_snooker[k], text, size) == 0)
      return k;
  return -1;
}

char *place_spelt(char *text, char to[PLACE_TEXT]) {
  enum { YELLOW = 16 };
  const size_t size = strcspn(text, ",");
  const int colour = colour_at(text);
  char spot[PLACE_TEXT / 2];
  const char *place = NULL;
  for (size_t k = 0; k < sizeof places / sizeof places[0]; k++)
    if (strlen(places[k].name) == size && strncmp(text, places[k].name, size) == 0)
      place = places[k].place;

  /* the spots of snooker, on a table on which a diamond is 1 m */
  if (colour >= 0) {
    const carom_table table = {.width = 4.0, .length = 8.0};
    double at[2] = {0.0, 0.0};
    carom_spot_of(CAROM_RACK_SNOOKER, &table, YELLOW + colour, at);
    snprintf(spot, sizeof spot, "%.15gd,%.15gd", at[0], at[1]);
    place = spot;
  }
  return place != NULL && snprintf(to, PLACE_TEXT, "%s%s", place, text + size) < PLACE_TEXT ? to
                                                                                            : text;
}

static bool refuse(const option_row *row, const char *text) {
  char hint[HINT_TEXT] = "", racks[MOST_WORDS] = "", known[2 * MOST_WORDS];
  const bool tip = row->least == MEASURE_TIP;
  if (row->words != 0)
    words_of(row->words, true, racks);
  snprintf(known, sizeof known, "%s", racks);
  for (size_t k = 0; k < sizeof places / sizeof places[0]; k++)
    snprintf(known + strlen(known), sizeof known - strlen(known), "|%s", places[k].name);
  for (int k = 0; k < COLOURS; k++)
    snprintf(known + strlen(known), sizeof known - strlen(known), "|%s", colours_of_snooker[k]);
  complain("--%s is %s%s%s; not '%.60s'%s", row->name,
           tip ? "RIGHT,ABOVE in radii of the ball, such as 0.2,-0.3, or in tips: 1,0.5tip; "
                 "several with colons: 0,0:0.2,0, or a range of either: 0,-0.4..0.4..0.2"
               : "X,Y in m, or with a unit: 2,3ft, or 2,3d in diamonds, or a place: " PLACES
                 "; or frozen-left,4d, frozen-1,90, which touches a rail or a ball; several with "
                 "colons: 0.6,1.5:foot-spot",
           row->words != 0 ? "; or a rack: " : "", racks, text,
           tip ? hint : did_you_mean(text, known, hint));
  return false;
}

/* Reads "A", "A..B" or "A..B..STEP", at most MOST_PLACES values of a measure; how many, or 0. A
 * range without a step has five. */
static int read_range(int measure, const char *text, value to[MOST_PLACES]) {
  char copy[MOST_TEXT], *rest = copy;
  value end[3];
  int parts = 0;
  snprintf(copy, sizeof copy, "%s", text);
  for (char *next = rest; next != NULL; rest = next, parts++) {
    next = strstr(rest, "..");
    if (next != NULL) {
      *next = '\0';
      next += 2;
    }
    if (parts == 3 || !value_of(measure, rest, &end[parts]) || end[parts].times != end[0].times)
      return 0;
  }
  to[0] = end[0];
  if (parts == 1)
    return 1;
  const double steps = parts == 3 ? (end[1].x - end[0].x) / end[2].x : 4.0;
  if (!(steps >= 0.0 && steps < MOST_PLACES))
    return 0;
  const int count = (int)(steps + 1e-9) + 1;
  for (int k = 0; k < count; k++) {
    to[k] = end[0];
    to[k].x += (end[1].x - end[0].x) * (k / fmax(steps, 1e-9));
    snprintf(to[k].name, sizeof to[k].name, "%.4g", to[k].x);
  }
  return count;
}

/* Adds all pairs of two ranges, A..B,C..D; false where they cannot be read or are too many. */
static bool add_ranges(int measure, const char *text, place_list *list) {
  static value x[MOST_PLACES], y[MOST_PLACES];
  char first[MOST_TEXT];
  const char *comma = strchr(text, ',');
  snprintf(first, sizeof first, "%.*s", (int)(comma - text), text);
  const int across = read_range(measure, first, x), along = read_range(measure, comma + 1, y);
  if (across == 0 || along == 0 || list->count + across * along > MOST_PLACES)
    return false;
  for (int k = 0; k < across * along; k++) {
    list->at[list->count].x = x[k / along];
    list->at[list->count++].y = y[k % along];
  }
  return true;
}

/* Reads "frozen-NAME,X"; false where it cannot be read. */
static bool read_touching(const char *text, given_place *to) {
  const char *name = text + strlen(frozen), *comma = strchr(name, ',');
  const size_t size = comma != NULL ? (size_t)(comma - name) : 0;
  if (size == 0 || size >= PLACE_NAME)
    return false;
  snprintf(to->touches, PLACE_NAME, "%.*s", (int)size, name);
  const bool rail = place_among(RAILS, to->touches, size) >= 0;
  return value_of(rail ? MEASURE_PLACE : MEASURE_ANGLE, comma + 1, &to->x);
}

OPTION_SET(set_places) {
  place_list *list = field;
  char copy[MOST_TEXT], racks[MOST_WORDS], *rest;
  static values pair;
  *list = (place_list){0};
  list->rack =
      row->words != 0 ? 1 + place_among(words_of(row->words, true, racks), text, strlen(text)) : 0;
  snprintf(copy, sizeof copy, "%s", text);
  for (char *one = strtok_r(copy, ":", &rest); one != NULL && list->rack == 0;
       one = strtok_r(NULL, ":", &rest)) {
    char *equals = strchr(one, '='), *numbers = equals != NULL ? equals + 1 : one;
    const size_t name = equals != NULL ? (size_t)(equals - one) : 0;
    const int colour = row->words != 0 && name == 0 ? colour_at(one) : -1;
    char spelt[PLACE_TEXT];
    if (row->least == MEASURE_PLACE)
      numbers = place_spelt(numbers, spelt);
    const bool touches =
        row->least == MEASURE_PLACE && strncmp(numbers, frozen, strlen(frozen)) == 0;
    if (list->count == MOST_PLACES || name >= PLACE_NAME || (name > 0 && row->words == 0))
      return refuse(row, text);
    if (!touches && (strspn(numbers, "+-.,0123456789/ eEacdfhimnprtR\"") != strlen(numbers) ||
                     strchr(numbers, ',') == NULL))
      return refuse(row, text);
    for (size_t k = 0; k < name; k++)
      if (!isalnum((unsigned char)one[k]) && one[k] != '-' && one[k] != '_')
        return refuse(row, text);
    if (row->least == MEASURE_TIP && strstr(numbers, "..") != NULL) {
      if (!add_ranges(row->least, numbers, list))
        return refuse(row, text);
      continue;
    }
    given_place *to = &list->at[list->count++];
    if (touches ? !read_touching(numbers, to) : !set_values(row, numbers, &pair) || pair.count != 2)
      return refuse(row, text);
    if (colour >= 0)
      snprintf(to->name, PLACE_NAME, "%s", colours_of_snooker[colour]);
    else
      snprintf(to->name, PLACE_NAME, "%.*s", (int)name, one);
    if (!touches) {
      to->x = pair.at[0];
      to->y = pair.at[1];
    }
  }
  return list->rack > 0 || list->count > 0 ? true : refuse(row, text);
}

double place_along(const value *v, double diamond) {
  return v->times == DIAMONDS ? v->x * diamond : v->x;
}
