/* Places and offsets of the tip, as players write them: X,Y in m or in diamonds, names, lists and
 * ranges. */
#include "shots/places.h"

#include "program/message.h"
#include "program/words.h"

#include "carom_shot.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TEXT = 4096, RANGE = 1 };
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
                 "several with colons: 0,0:0.2,0, or a range of either: 0,-0.4:0.4:0.2"
               : "X,Y in m, or with a unit: 2,3ft, or 2,3d in diamonds, or a place: " PLACES
                 "; or frozen-left,4d, frozen-1,90, which touches a rail or a ball; several with "
                 "colons: 0.6,1.5:foot-spot",
           row->words != 0 ? "; or a rack: " : "", racks, text,
           tip ? hint : did_you_mean(text, known, hint));
  return false;
}

/* Copies pairs, in which ranges get RANGE for ":" or "..". A colon parts two pairs where commas
 * stand on both sides of it before the next one. */
static void spell_ranges(const char *text, char *to) {
  for (bool comma = false; *text != '\0'; text++) {
    const bool dots = strncmp(text, "..", 2) == 0,
               next = memchr(text + 1, ',', strcspn(text + 1, ":")) != NULL,
               range = dots || (*text == ':' && !(comma && next));
    comma = *text == ',' || (comma && (*text != ':' || range));
    *to++ = (char)(range ? RANGE : *text);
    text += dots;
  }
  *to = '\0';
}

/* Adds all pairs of two ranges, A:B,C:D; of one without a step five values. False after a
 * complaint. */
static bool add_ranges(const option_row *row, char *text, place_list *list) {
  static values axis[2];
  int count[2], stride[2];
  char *part[2] = {text, strchr(text, ',')};
  *part[1]++ = '\0';
  for (int k = 0; k < 2; k++) {
    int parts = 1;
    for (char *at = part[k]; (at = strchr(at, RANGE)) != NULL; parts++)
      *at = ':';
    if (!set_values(row, part[k], &axis[k]))
      return false;
    stride[k] = parts == 2 ? axis[k].count / 4 : 1;
    count[k] = 1 + (axis[k].count - 1) / stride[k];
  }
  const int all = list->count + count[0] * count[1];
  if (all > MOST_PLACES)
    return too_many(row, all, MOST_PLACES);
  for (int k = 0; list->count < all; k++) {
    list->at[list->count].x = axis[0].at[k / count[1] * stride[0]];
    list->at[list->count++].y = axis[1].at[k % count[1] * stride[1]];
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
  if (strlen(text) >= sizeof copy)
    return refuse(row, text);
  if (row->least == MEASURE_TIP)
    spell_ranges(text, copy);
  else
    memcpy(copy, text, strlen(text) + 1);
  int several = 1;
  for (const char *at = copy; (at = strchr(at, ':')) != NULL; at++)
    several++;
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
    if (list->count == MOST_PLACES)
      return too_many(row, several, MOST_PLACES);
    if (name >= PLACE_NAME || (name > 0 && row->words == 0))
      return refuse(row, text);
    if (!touches && (strspn(numbers, "+-.,0123456789/ eEacdfhimnprtR\"\1") != strlen(numbers) ||
                     strchr(numbers, ',') == NULL))
      return refuse(row, text);
    for (size_t k = 0; k < name; k++)
      if (!isalnum((unsigned char)one[k]) && one[k] != '-' && one[k] != '_')
        return refuse(row, text);
    if (row->least == MEASURE_TIP && strchr(numbers, RANGE) != NULL) {
      if (!add_ranges(row, numbers, list))
        return false;
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
