/* Places and offsets of the tip, as players write them: X,Y in m or in diamonds, names, lists and
 * ranges. */
#include "shots/places.h"

#include "program/program.h"

#include "carom_shot.h"

#include <ctype.h>

enum { MOST_TEXT = 4096, PLACE_TEXT = 128, RANGE = 1 };
static const char frozen[] = "frozen-";

/* In diamonds, as every table has them: corners and middles of the long rails lie at the noses. */
static const struct {
  const char *name;
  double place[2];
} places[] = {{"head-spot", {2, 2}},  {"centre", {2, 4}},     {"foot-spot", {2, 6}},
              {"head-left", {0, 0}},  {"head-right", {4, 0}}, {"side-left", {0, 4}},
              {"side-right", {4, 4}}, {"foot-left", {0, 8}},  {"foot-right", {4, 8}}};

const char *const colours_of_snooker[COLOURS] = {"yellow", "green", "brown",
                                                 "blue",   "pink",  "black"};

/* Which of the words a text begins with, up to a comma or its end; -1: none. */
static int colour_at(const char *text) {
  const size_t size = strcspn(text, ",");
  for (int k = 0; k < COLOURS; k++)
    if (same_word(text, size, colours_of_snooker[k], strlen(colours_of_snooker[k])))
      return k;
  return -1;
}

/* A place in diamonds. */
static void set_diamonds(const double place[2], value *x, value *y) {
  value_in_unit(MEASURE_PLACE, place[0], "d", x);
  value_in_unit(MEASURE_PLACE, place[1], "d", y);
}

rail_name rail_named(const char *text, size_t size) {
  return (rail_name)word_among(RAILS, text, size);
}

/* The point of a rail's nose in "left,4d" and what follows; `text` where it is none. */
static const char *point_of_rail(const char *text, value *x, value *y) {
  static const double noses[][2] = {
      [RAIL_HEAD] = {0, 0}, [RAIL_FOOT] = {0, 8}, [RAIL_LEFT] = {0, 0}, [RAIL_RIGHT] = {4, 0}};
  char number[PLACE_TEXT];
  const size_t size = strcspn(text, ",");
  const rail_name rail = rail_named(text, size);
  if (text[size] != ',' || rail == RAIL_NONE)
    return text;
  const char *digits = text + size + 1, *rest = digits + strcspn(digits, ",");
  snprintf(number, sizeof number, "%.*s", (int)(rest - digits), digits);
  set_diamonds(noses[rail], x, y);
  value *along = x;
  if (rail == RAIL_LEFT || rail == RAIL_RIGHT)
    along = y;
  if (!value_of(MEASURE_PLACE, number, along))
    return text;
  return rest;
}

const char *place_named(const char *text, value *x, value *y) {
  enum { YELLOW = 16 };
  const double digits = 1e14; /* of a diamond: recorded layouts have these bits */
  const size_t size = strcspn(text, ",");
  const int colour = colour_at(text);
  const char *rest = point_of_rail(text, x, y);
  if (rest != text)
    return rest;
  for (size_t k = 0; k < COUNT_OF(places); k++)
    if (same_word(text, size, places[k].name, strlen(places[k].name))) {
      set_diamonds(places[k].place, x, y);
      return text + size;
    }
  if (colour < 0)
    return text;

  /* the spots of snooker, on a table on which a diamond is 1 m */
  const carom_table table = {.width = 4.0, .length = 8.0};
  double position[2] = {0.0, 0.0};
  carom_spot_of(CAROM_RACK_SNOOKER, &table, YELLOW + colour, position);
  for (int k = 0; k < 2; k++)
    position[k] = round(position[k] * digits) / digits;
  set_diamonds(position, x, y);
  return text + size;
}

/* Reads where the tip touches by words, such as low, left-low or right,0: as far from the centre as
 * a chalked tip holds. False of other texts. */
static bool tip_named(const char *text, value *x, value *y) {
  static const struct {
    const char *word;
    double right, above;
  } words[] = {{"centre", 0.0, 0.0},
               {"right", 0.5, 0.0},
               {"left", -0.5, 0.0},
               {"high", 0.0, 0.5},
               {"low", 0.0, -0.5}};
  enum { TIP_WORDS = COUNT_OF(words) };
  const double digits = 1e4; /* of a radius */
  const char *rest = text;
  double right = 0.0, above = 0.0;
  do {
    size_t size = strcspn(rest, "-,"), k = 0;
    while (k < TIP_WORDS && !same_word(rest, size, words[k].word, strlen(words[k].word)))
      k++;
    if (k < TIP_WORDS) {
      right += words[k].right;
      above += words[k].above;
    } else {
      char *end = NULL;
      const double number = strtod(rest, &end);
      size = (size_t)(end - rest);
      if (rest == text || number != 0.0 || size == 0) /* a bare 0 beside a word adds nothing */
        return false;
    }
    rest += size;
    if (rest[0] != '\0' && rest[0] != '-' && rest[0] != ',')
      return false;
  } while (*rest++ != '\0');
  const double far = hypot(right, above), scale = far > 0.5 ? 0.5 / far : 1.0;
  return value_in_unit(MEASURE_TIP, round(right * scale * digits) / digits, "R", x) &&
         value_in_unit(MEASURE_TIP, round(above * scale * digits) / digits, "R", y);
}

/* Whether a text has two numbers' characters, units included, and a comma. */
static bool looks_like_pair(const char *text) {
  return strspn(text, "+-.,:0123456789/ eEacdfhimnprstR%\"\1") == strlen(text) &&
         strchr(text, ',') != NULL;
}

/* What a text with blanks or semicolons may mean: commas and colons. False: it has none. */
static bool respell(const char *text, char *spelt, size_t room) {
  size_t size = 0;
  bool changed = false;
  for (; *text != '\0' && size + 1 < room; text++) {
    if (*text == ' ' && size > 0 && spelt[size - 1] == ',')
      continue;
    spelt[size] = *text;
    if (*text == ' ')
      spelt[size] = ',';
    if (*text == ';')
      spelt[size] = ':';
    changed |= spelt[size] != *text;
    size++;
  }
  spelt[size] = '\0';
  return changed;
}

/* Complains of positions, or offsets of the tip, that cannot be read. */
static bool refuse(const option_row *row, const char *text) {
  char racks[MOST_WORDS] = "", known[2 * MOST_WORDS], list[HINT_TEXT], spelt[PLACE_TEXT];
  const bool has_digits = strpbrk(text, "0123456789") != NULL;
  const char *nouns = "position";
  if (row->words != 0)
    nouns = "position or rack";
  if (has_digits && respell(text, spelt, sizeof spelt) && looks_like_pair(spelt))
    return refuse_value(row, text, "no such %s; try %s", nouns, spelt);
  if (row->least == MEASURE_TIP)
    return refuse_value(row, text, "not an offset RIGHT,ABOVE; try 0.2,-0.3, 1,0.5tip or low-left");
  if (row->words != 0)
    words_of(row->words, true, racks);
  snprintf(known, sizeof known, "%s", racks);
  for (size_t k = 0; k < COUNT_OF(places); k++)
    append(known, sizeof known, "|", "%s", places[k].name);
  for (int k = 0; k < COLOURS; k++)
    append(known, sizeof known, "|", "%s", colours_of_snooker[k]);
  if (strncmp(text, frozen, strlen(frozen)) == 0)
    return refuse_value(row, text, "not frozen-RAIL,Y or frozen-BALL,DEGREES; try frozen-left,4d");
  if (!has_digits && is_nearly(text, known))
    return refuse_value(row, text, "no such %s; try %s", nouns, words_to_try(text, known, list));
  if (row->words != 0)
    return refuse_value(row, text, "no such position or rack; try 0.8,1.9 or nineball");
  return refuse_value(row, text, "no such position; try 0.6,0.8, 2d,4d or foot-spot");
}

/* Copies pairs, in which ranges get RANGE for ":" or "..". A colon parts two pairs where commas
 * stand on both sides of it before the next one. */
static void spell_ranges(const char *text, char *result) {
  for (bool comma = false; *text != '\0'; text++) {
    const bool dots = strncmp(text, "..", 2) == 0,
               next = memchr(text + 1, ',', strcspn(text + 1, ":")) != NULL,
               word = isalpha((unsigned char)text[1]) != 0,
               range = dots || (*text == ':' && !(comma && next) && !word);
    comma = *text == ',' || (comma && (*text != ':' || range));
    *result++ = (char)(range ? RANGE : *text);
    text += dots;
  }
  *result = '\0';
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
    for (char *mark = part[k]; (mark = strchr(mark, RANGE)) != NULL; parts++)
      *mark = ':';
    if (!set_values(row, part[k], &axis[k]))
      return false;
    stride[k] = parts == 2 ? axis[k].count / 4 : 1;
    count[k] = 1 + (axis[k].count - 1) / stride[k];
  }
  const int total = list->count + count[0] * count[1];
  if (total > MOST_PLACES)
    return too_many(row, total, MOST_PLACES);
  for (int k = 0; list->count < total; k++) {
    list->place[list->count].x = axis[0].item[k / count[1] * stride[0]];
    list->place[list->count++].y = axis[1].item[k % count[1] * stride[1]];
  }
  return true;
}

/* Reads "frozen-NAME,X" or, of a ball, "frozen-NAME,ANGLE,GAP"; false where it cannot be read. */
static bool read_touching(const char *text, given_place *place) {
  text += strlen(frozen);
  char number[PLACE_TEXT];
  const char *comma = strchr(text, ',');
  const size_t size = comma != NULL ? (size_t)(comma - text) : 0;
  if (size == 0 || size >= PLACE_NAME)
    return false;
  snprintf(place->touches, PLACE_NAME, "%.*s", (int)size, text);
  if (rail_named(place->touches, size) != RAIL_NONE)
    return value_of(MEASURE_PLACE, comma + 1, &place->x);
  const char *gap = strchr(comma + 1, ',');
  if (gap == NULL)
    return value_of(MEASURE_ANGLE, comma + 1, &place->x);
  snprintf(number, sizeof number, "%.*s", (int)(gap - comma - 1), comma + 1);
  return value_of(MEASURE_ANGLE, number, &place->x) &&
         value_of(MEASURE_LENGTH, gap + 1, &place->y) && place->y.x >= 0.0;
}

/* One of the entries between colons: "NAME=NUMBERS" or "NUMBERS". */
typedef struct place_entry {
  const char *name; /* not terminated */
  size_t name_size; /* 0: no name stands there */
  int colour;       /* of a ball that is named after its spot of snooker; -1: none */
  char *numbers;
  bool touches; /* frozen-NAME,X */
  bool is_read; /* by a name of a place or of the tip, into: */
  value x, y;
} place_entry;

/* Takes an entry apart, and reads the names of places and of the tip. */
static void split_entry(const option_row *row, char *text, place_entry *entry) {
  char *equals = strchr(text, '=');
  const bool balls_are_named = row->words != 0;
  entry->name = text;
  entry->name_size = equals != NULL ? (size_t)(equals - text) : 0;
  entry->colour = balls_are_named && entry->name_size == 0 ? colour_at(text) : -1;
  entry->numbers = equals != NULL ? equals + 1 : text;
  entry->touches = entry->is_read = false;
  if (row->least == MEASURE_TIP)
    entry->is_read = tip_named(entry->numbers, &entry->x, &entry->y);
  if (row->least == MEASURE_PLACE) {
    const char *rest = place_named(entry->numbers, &entry->x, &entry->y);
    entry->is_read = rest != entry->numbers && *rest == '\0';
    entry->touches = strncmp(entry->numbers, frozen, strlen(frozen)) == 0;
  }
}

/* Whether the places of an option are those of balls, which may have names. */
static bool takes_names(const option_row *row) {
  return row->words != 0 || strcmp(row->name, "cue") == 0;
}

/* Whether a name is allowed, and short and plain enough; no name always is. */
static bool name_is_valid(const option_row *row, const place_entry *entry) {
  if (entry->name_size >= PLACE_NAME || (entry->name_size > 0 && !takes_names(row)))
    return false;
  for (size_t k = 0; k < entry->name_size; k++) {
    const char letter = entry->name[k];
    if (!isalnum((unsigned char)letter) && letter != '-' && letter != '_')
      return false;
  }
  return true;
}

/* Reads the numbers of an entry into its place; false where they are none. */
static bool read_numbers(const option_row *row, const place_entry *entry, given_place *place) {
  static values pair;
  if (entry->touches)
    return read_touching(entry->numbers, place);
  if (entry->is_read) {
    place->x = entry->x;
    place->y = entry->y;
    return true;
  }
  if (!set_values(row, entry->numbers, &pair) || pair.count != 2)
    return false;
  place->x = pair.item[0];
  place->y = pair.item[1];
  return true;
}

/* Adds the place of an entry, or the places of a range; false after a complaint. `whole` is the
 * text of all entries, which complaints show. */
static bool add_entry(const option_row *row, const place_entry *entry, const char *whole,
                      place_list *list) {
  if (!name_is_valid(row, entry) ||
      !(entry->touches || entry->is_read || looks_like_pair(entry->numbers)))
    return refuse(row, whole);
  if (row->least == MEASURE_TIP && !entry->is_read && strchr(entry->numbers, RANGE) != NULL)
    return add_ranges(row, entry->numbers, list);
  given_place *place = &list->place[list->count++];
  if (!read_numbers(row, entry, place))
    return refuse(row, whole);
  if (entry->colour >= 0)
    snprintf(place->name, PLACE_NAME, "%s", colours_of_snooker[entry->colour]);
  else
    snprintf(place->name, PLACE_NAME, "%.*s", (int)entry->name_size, entry->name);
  return true;
}

/* 1 + the carom_rack_kind of a text that names a rack, where the option takes racks; else 0. */
static int rack_named(const option_row *row, const char *text) {
  char racks[MOST_WORDS];
  if (row->words == 0)
    return 0;
  const int rack = 1 + word_among(words_of(row->words, true, racks), text, strlen(text));
  return rack > 0 ? rack : rack_of_game(text);
}

OPTION_SET(set_places) {
  place_list *list = field;
  char copy[MOST_TEXT], *rest;
  *list = (place_list){.count = 0};
  if (strlen(text) >= sizeof copy)
    return refuse(row, text);
  if (row->least == MEASURE_TIP)
    spell_ranges(text, copy);
  else
    memcpy(copy, text, strlen(text) + 1);

  int entries = 1;
  for (const char *colon = copy; (colon = strchr(colon, ':')) != NULL; colon++)
    entries++;
  char *next = strtok_r(copy, ":", &rest);
  for (; next != NULL; next = strtok_r(NULL, ":", &rest)) {
    place_entry entry;
    if (list->rack == 0 && (list->rack = rack_named(row, next)) > 0)
      continue;
    if (list->count == MOST_PLACES)
      return too_many(row, entries, MOST_PLACES);
    split_entry(row, next, &entry);
    if (!add_entry(row, &entry, text, list))
      return false;
  }
  return list->rack > 0 || list->count > 0 || refuse(row, text);
}

bool read_disc(const char *text, const char *usual_radius, value *x, value *y, value *radius) {
  char copy[PLACE_TEXT], *rest = NULL;
  value *part[] = {x, y, radius};
  bool good = strlen(text) < sizeof copy;
  const char *numbers = place_named(text, x, y);
  int parts = numbers == text ? 0 : 2;
  snprintf(copy, sizeof copy, "%s", numbers);
  value_of(MEASURE_LENGTH, usual_radius, radius);
  for (char *token = strtok_r(copy, ",", &rest); token != NULL && good;
       token = strtok_r(NULL, ",", &rest), parts++)
    good = parts < 3 && value_of(MEASURE_PLACE, token, part[parts]);
  return good && parts >= 2 && radius->x > 0.0;
}

double place_along(const value *v, double diamond) {
  return v->times == DIAMONDS ? v->x * diamond : v->x;
}
