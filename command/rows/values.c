/* Lists and ranges of numbers with units.
 *
 * Percent of english: 100 % is the spin of a ball that a level cue strikes half a radius off its
 * centre, without loss, 5/2 (1/2) V/R; of a tip, half a radius. A tip is an offset of 13 mm, the
 * width of a usual tip. Percent of follow and draw are of the spin of a rolling ball, V/R.
 *
 * Words of speed are the middles of the ranges of a ball's speed at
 * billiards.colostate.edu/faq/speed/typical.
 */
#include "rows/values.h"

#include "program/program.h"
#include "rows/number.h"
#include "rows/quantities.h"

enum { POINTS = 161, MOST_TEXT = 256, LIST_TEXT = MOST_VALUES * VALUE_NAME };

#define BALL_FRACTION \
  ((double)NAN) /* an angle by the part x of the ball that is hit, 0 to 1:
                                       asin(1 - x) */
static const double strike = 2.5, tip_width = 0.013, mph = 0.44704, inch = 0.0254, foot = 0.3048;

/* Measures that share units. */
#define OF(measure) (1U << (measure))
enum {
  NUMBERS = OF(MEASURE_NUMBER) | OF(MEASURE_FRICTION),
  ANGLES = OF(MEASURE_ANGLE) | OF(MEASURE_ELEVATION) | OF(MEASURE_CUT),
  LENGTHS = OF(MEASURE_LENGTH) | OF(MEASURE_PLACE),
  MASSES = OF(MEASURE_MASS) | OF(MEASURE_OBJECT_MASS),
  SIDES = OF(MEASURE_SIDE) | OF(MEASURE_SIDE_RAIL),
  SPINS = OF(MEASURE_SPIN) | SIDES
};

const char part_of_ball[] = "part of the ball that is hit";

/* Every unit of the program. The first one of a measure is that of a bare number; a spin has
 * none. */
static const struct {
  unsigned measures;
  const char *name, *axis;
  double factor;
  int times;
} units[] = {
    {NUMBERS, "", "", 1.0, FIXED},
    {OF(MEASURE_SPEED), "m/s", "m/s", 1.0, FIXED},
    {OF(MEASURE_SPEED), "cm/s", "cm/s", 1e-2, FIXED},
    {OF(MEASURE_SPEED), "ft/s", "feet/s", foot, FIXED},
    {OF(MEASURE_SPEED), "in/s", "inches/s", inch, FIXED},
    {OF(MEASURE_SPEED), "mph", "mph", mph, FIXED},
    {OF(MEASURE_SPEED), "km/h", "km/h", 1.0 / 3.6, FIXED},
    {ANGLES, "deg", "degrees", 1.0, FIXED},
    {OF(MEASURE_CUT), "ball", part_of_ball, BALL_FRACTION, FIXED},
    {ANGLES, "\u00b0", "degrees", 1.0, FIXED},
    {ANGLES, "rad", "rad", 1.0 / degree, FIXED},
    {LENGTHS, "m", "m", 1.0, FIXED},
    {LENGTHS, "mm", "mm", 1e-3, FIXED},
    {LENGTHS, "cm", "cm", 1e-2, FIXED},
    {LENGTHS, "in", "inches", inch, FIXED},
    {LENGTHS, "ft", "feet", foot, FIXED},
    {OF(MEASURE_PLACE), "d", "diamonds", 1.0, DIAMONDS},
    {MASSES, "kg", "kg", 1.0, FIXED},
    {MASSES, "g", "g", 1e-3, FIXED},
    {MASSES, "oz", "ounces", 0.028349523125, FIXED},
    {OF(MEASURE_TIME), "s", "s", 1.0, FIXED},
    {OF(MEASURE_TIME), "ms", "ms", 1e-3, FIXED},
    {OF(MEASURE_TIP), "R", "R", 1.0, FIXED},
    {OF(MEASURE_TIP), "tip", "tips", tip_width, OFFSET},
    {OF(MEASURE_TIP), "mm", "mm", 1e-3, OFFSET},
    {OF(MEASURE_TIP), "cm", "cm", 1e-2, OFFSET},
    {OF(MEASURE_TIP), "in", "inches", inch, OFFSET},
    {OF(MEASURE_TIP), "%", "% of english", 0.005, FIXED},
    {OF(MEASURE_SHARE), "%", "%", 0.01, FIXED},
    {OF(MEASURE_SPIN), "rad/s", "rad/s", 1.0, FIXED},
    {SIDES, "rad/s", "rad/s counterclockwise", 1.0, FIXED},
    {SPINS, "rpm", "turns a minute", 6.0 * degree, FIXED},
    {OF(MEASURE_SPIN), "%", "% of rolling", 0.01, ROLLING},
    {SIDES, "%", "% of right english", 0.01 * strike * 0.5, ROLLING},
    {OF(MEASURE_SPIN), "tip", "tips above the centre", strike *tip_width, OFFSET},
    {SIDES, "tip", "tips to the right", strike *tip_width, OFFSET},
    {SPINS, "mm", "mm from the centre", strike * 1e-3, OFFSET},
};

static const struct {
  unsigned measures;
  const char *name;
  double x;
  int times;
} words[] = {
    {OF(MEASURE_CUT), "full", 0.0, FIXED},
    {OF(MEASURE_CUT), "three-quarter", 14.477512185929925, FIXED},
    {OF(MEASURE_CUT), "half", 30.0, FIXED},
    {OF(MEASURE_CUT), "quarter", 48.590377890729144, FIXED},
    {OF(MEASURE_CUT), "thin", 61.044975628140819, FIXED}, /* an eighth */
    {OF(MEASURE_ELEVATION), "least", (double)NAN, FIXED},
    {OF(MEASURE_OBJECT_MASS), "same", (double)NAN, FIXED},
    {OF(MEASURE_FRICTION), "alciatore", (double)NAN, FIXED},
    {OF(MEASURE_SPEED), "soft", 0.5 * mph, OF_BALL},
    {OF(MEASURE_SPEED), "slow", 1.5 * mph, OF_BALL},
    {OF(MEASURE_SPEED), "medium", 3.0 * mph, OF_BALL},
    {OF(MEASURE_SPEED), "fast", 5.5 * mph, OF_BALL},
    {OF(MEASURE_SPEED), "power", 8.5 * mph, OF_BALL},
    {OF(MEASURE_SPEED), "break", 27.5 * mph, OF_BALL},
    {OF(MEASURE_SPIN), "stun", 0.0, FIXED},
    {OF(MEASURE_SPIN), "follow", 1.0, ROLLING},
    {OF(MEASURE_SPIN), "roll", 1.0, ROLLING},
    {OF(MEASURE_SPIN), "draw", -1.0, ROLLING},
    {SIDES, "none", 0.0, FIXED},
    {SIDES, "right", 1.25, ROLLING},
    {SIDES, "left", -1.25, ROLLING},
    {OF(MEASURE_SIDE), "outside", 1.25, GEARED},
    {OF(MEASURE_SIDE), "inside", -1.25, GEARED},
    {OF(MEASURE_SIDE_RAIL), "running", 1.25, GEARED},
    {OF(MEASURE_SIDE_RAIL), "reverse", -1.25, GEARED},
    {SIDES, "gearing", 1.0, GEARING},
};

enum { UNITS = COUNT_OF(units), WORDS = COUNT_OF(words), NO_UNIT = -1 };

/* The unit of that name, "" for that of a bare number; NO_UNIT if there is none. */
static int find_unit(int measure, const char *name) {
  if (same_text(name, "tips"))
    name = "tip";
  for (int k = 0; k < UNITS; k++)
    if ((units[k].measures & OF(measure)) != 0 &&
        ((name[0] == '\0' && measure < MEASURE_SPIN) || same_text(name, units[k].name)))
      return k;
  return NO_UNIT;
}

/* Sets a value of a number in a unit; false where it is out of range. */
static bool set_value(value *v, double number, int unit) {
  v->number = number;
  v->times = units[unit].times;
  v->x = number * units[unit].factor;
  if (isnan(units[unit].factor) && number >= 0.0 && number <= 1.0) /* BALL_FRACTION */
    v->x = asin(1.0 - number) / degree;
  const bool apart = units[unit].name[0] >= 'a' && units[unit].times != DIAMONDS; /* 2d, 2 m */
  snprintf(v->name, sizeof v->name, "%.6g%s%s", number, text_if(apart, " "), units[unit].name);
  return isfinite(v->x);
}

/* Splits "7mph" or "1/4ball" into number and unit; the unit of none is ""; false where it is no
 * number. */
static bool split(const char *text, double *number, const char **unit) {
  char digits[64];
  double over = 1.0;
  const size_t size = strspn(text, "+-.0123456789"), power = text[size] == 'e' || text[size] == 'E';
  const size_t more = power ? 1 + strspn(text + size + 1, "+-0123456789") : 0;
  snprintf(digits, sizeof digits, "%.*s", (int)(size + more), text);
  *unit = text + size + more + strspn(text + size + more, " ");
  if (size + more >= sizeof digits || !parse_number(digits, number))
    return false;
  if (**unit == '/') {
    const size_t below = strspn(*unit + 1, "0123456789");
    snprintf(digits, sizeof digits, "%.*s", (int)below, *unit + 1);
    *unit += 1 + below;
    if (below == 0 || !parse_number(digits, &over))
      return false;
    *number /= over;
  }
  return isfinite(*number);
}

/* A word, of parts of a ball also as half-ball. */
static bool set_word(const char *text, int measure, value *v) {
  const char *end = strstr(text, "-ball");
  size_t size = strlen(text);
  if (measure == MEASURE_CUT && end != NULL && end[5] == '\0')
    size = (size_t)(end - text);
  for (int k = 0; k < WORDS; k++)
    if ((words[k].measures & OF(measure)) != 0 &&
        same_word(text, size, words[k].name, strlen(words[k].name))) {
      *v = (value){.x = words[k].x, .number = (double)NAN, .times = words[k].times};
      snprintf(v->name, sizeof v->name, "%s", text);
      return true;
    }
  return false;
}

/* The option that has a word, where it is given for the spin of the other kind; NULL: neither. */
static const char *other_spin(int measure, const char *text) {
  value v;
  if (measure == MEASURE_SPIN &&
      (set_word(text, MEASURE_SIDE, &v) || set_word(text, MEASURE_SIDE_RAIL, &v)))
    return "--side";
  if ((OF(measure) & SIDES) != 0 && set_word(text, MEASURE_SPIN, &v))
    return "--spin";
  return NULL;
}

/* What a measure is called, and values to try. */
static const struct {
  const char *noun, *example, *range;
} measures[] = {[MEASURE_NUMBER] = {"a number", "0.2", "0.1:0.3:0.1"},
                [MEASURE_SPEED] = {"a speed", "2, 5mph or fast", "1:3:0.5"},
                [MEASURE_CUT] = {"a cut", "30 or half", "0:60:5"},
                [MEASURE_ANGLE] = {"an angle", "45 or 0.8rad", "0:90:5"},
                [MEASURE_ELEVATION] = {"an elevation", "5 or least", "0:10:2"},
                [MEASURE_LENGTH] = {"a length", "0.03, 30mm or 1.2in", "10:30:5mm"},
                [MEASURE_PLACE] = {"a position", "0.6 or 2d", "0.5:1:0.1"},
                [MEASURE_TIME] = {"a time", "0.001 or 1ms", "1:3:1ms"},
                [MEASURE_MASS] = {"a mass", "0.17, 170g or 6oz", "150:180:10g"},
                [MEASURE_OBJECT_MASS] = {"a mass", "same, 0.17 or 6oz", "150:180:10g"},
                [MEASURE_FRICTION] = {"a friction", "alciatore or 0.06", "0:0.1:0.01"},
                [MEASURE_MODEL] = {"a model", "smooth", "smooth"},
                [MEASURE_TIP] = {"an offset of the tip", "0.2, 1tip or 10mm", "0:0.5:0.1"},
                [MEASURE_SHARE] = {"a share", "1%", "1:3:1%"},
                [MEASURE_SPIN] = {"a spin", "draw, 50% or 20rad/s", "-50:50%"},
                [MEASURE_SIDE] = {"a side spin", "right, 50% or 20rad/s", "-50:50%"},
                [MEASURE_SIDE_RAIL] = {"a side spin", "running, 50% or 20rad/s", "-50:50%"}};

/* The names of the words of a measure, or of its units, with bars between them. */
static void list_words(int measure, char *text, size_t room) {
  for (int k = 0; k < WORDS; k++)
    if ((words[k].measures & OF(measure)) != 0)
      append(text, room, "|", "%s", words[k].name);
}

static void list_units(int measure, char *text, size_t room) {
  for (int k = 0; k < UNITS; k++)
    if ((units[k].measures & OF(measure)) != 0 && units[k].name[0] != '\0')
      append(text, room, "|", "%s", units[k].name);
}

bool is_unit(const char *text) {
  for (int k = 0; k < UNITS; k++)
    if (units[k].name[0] != '\0' && same_text(units[k].name, text))
      return true;
  return same_text(text, "tips");
}

/* Complains of a value that cannot be read. */
static bool refuse(const option_row *row, const char *text) {
  char known[MOST_TEXT] = "", of_units[MOST_TEXT] = "", list[HINT_TEXT];
  const char *noun = measures[row->least].noun, *example = measures[row->least].example;
  const int digits = (int)strspn(text, "+-.0123456789");
  const char *unit = text + digits + strspn(text + digits, " ");
  const char *spin = other_spin(row->least, text);
  list_words(row->least, known, sizeof known);
  list_units(row->least, of_units, sizeof of_units);
  if (row->least == MEASURE_NUMBER)
    example = text_or(row->example, text_or(row->usual, example));
  if (spin != NULL)
    return refuse_value(row, text, "a word of %s; try %s %s", spin, spin, text);
  if (strchr(text, ':') != NULL || strstr(text, "..") != NULL)
    return refuse_value(row, text, "not a range A:B or A:B:STEP; try %s",
                        measures[row->least].range);
  if (strchr(text, ',') != NULL)
    return refuse_value(row, text, "not %s or a list; try %s", noun, example);
  if (digits > 0 && unit[0] != '\0' && of_units[0] != '\0') {
    if (!is_nearly(unit, of_units)) /* the first unit */
      of_units[strcspn(of_units, "|")] = '\0';
    return refuse_value(row, text, "no such unit; try %.*s%s", digits, text,
                        words_to_try(unit, of_units, list));
  }
  if (known[0] != '\0' && is_nearly(text, known))
    return refuse_value(row, text, "not %s; try %s", noun, words_to_try(text, known, list));
  return refuse_value(row, text, "not %s; try %s", noun, example);
}

bool too_many(const option_row *row, double count, int most) {
  complain("--%s: %.0f values are too many; give at most %d, or a longer step", row->name, count,
           most);
  return false;
}

/* A range, whose ends are split at the colons of `copy`; those of speeds and cuts may be words, in
 * SI units. */
static bool set_range(const option_row *row, const char *text, char *copy, values *list) {
  char *rest = NULL;
  double end[3];
  const char *unit = "", *own_unit;
  int parts = 0, worded = 0;
  value word = {.times = FIXED};
  for (char *part = strtok_r(copy, ":", &rest); part != NULL;
       part = strtok_r(NULL, ":", &rest), parts++) {
    const bool is_word =
        parts < 3 && row->least < MEASURE_SPIN && set_word(part, row->least, &word);
    worded += is_word;
    if (is_word) {
      end[parts] = word.x;
      continue;
    }
    if (parts == 3 || !split(part, &end[parts], &own_unit))
      return refuse(row, text);
    if (own_unit[0] != '\0')
      unit = own_unit;
  }
  if (worded > 0 && unit[0] != '\0')
    return refuse(row, text);
  const int found = find_unit(row->least, unit);
  double steps = POINTS - 1;
  if (parts == 3)
    steps = (end[1] - end[0]) / end[2];
  if (parts < 2 || found == NO_UNIT || !(steps >= 1.0 - 1e-9) || isinf(steps))
    return refuse(row, text);
  if (steps > MOST_VALUES - 1)
    return too_many(row, floor(steps) + 1.0, MOST_VALUES);
  *list = (values){.count = (int)(steps + 1.0 + 1e-9), .range = true, .unit = units[found].axis};
  for (int k = 0; k < list->count; k++) {
    double x = end[0] + (end[1] - end[0]) * k / steps;
    if (parts == 3)
      x = end[0] + k * end[2];
    if (!set_value(&list->item[k], x, found))
      return refuse(row, text);
    if (worded > 0)
      list->item[k].times = word.times;
  }
  return true;
}

/* The name of a cushion model. */
static bool set_model(const option_row *row, const char *text, value *v) {
  char list[MOST_WORDS];
  int place;
  if (!set_place(row, text, words_of(CAROM_WORDS_CUSHION_MODEL, false, list), &place))
    return false;
  *v = (value){.x = place, .number = (double)NAN};
  snprintf(v->name, sizeof v->name, "%s", text);
  return true;
}

/* One value of a list; `common` is the unit of those without. */
static bool set_one(const option_row *row, const char *text, int common, value *v) {
  const int measure = row->least;
  double number;
  const char *unit;
  if (set_word(text, measure, v))
    return true;
  if (measure == MEASURE_MODEL)
    return set_model(row, text, v);
  if (!split(text, &number, &unit))
    return refuse(row, text);
  const bool bare = unit[0] == '\0';
  int found = common;
  if (!bare)
    found = find_unit(measure, unit);
  if (found == NO_UNIT && bare && number == 0.0) /* 0 of any unit */
    found = find_unit(measure, "rad/s");
  if (found == NO_UNIT && bare && measure >= MEASURE_SPIN) {
    const char *share = " of english";
    if (measure == MEASURE_SPIN)
      share = " of rolling";
    return refuse_value(row, text, "a spin needs a unit; try %s%%%s, %srad/s or %stip", text, share,
                        text, text);
  }
  if (found == NO_UNIT || !set_value(v, number, found))
    return refuse(row, text);
  return true;
}

/* The unit of the last value of a list, which those without have too; NO_UNIT of none. */
static int unit_of_last(int measure, const char *text) {
  const char *last = strrchr(text, ','), *unit;
  double number;
  if (last != NULL)
    text = last + 1;
  if (!split(text, &number, &unit))
    unit = "";
  return find_unit(measure, unit);
}

/* Copies a text with a colon for each "..". */
static void copy_with_colons(const char *source, char *target) {
  for (; *source != '\0'; source++) {
    *target = *source;
    if (strncmp(source, "..", 2) == 0) {
      *target = ':';
      source++;
    }
    target++;
  }
  *target = '\0';
}

static bool read_values(const option_row *row, const char *text, values *list) {
  static char copy[LIST_TEXT];
  const int common = unit_of_last(row->least, text);
  *list = (values){.unit = ""};
  if (common != NO_UNIT)
    list->unit = units[common].axis;

  /* how many there are */
  double several = 1.0;
  for (const char *letter = text; *letter != '\0'; letter++)
    several += *letter == ',';
  if (several > MOST_VALUES || strlen(text) >= LIST_TEXT)
    return too_many(row, several, MOST_VALUES);

  /* a range, or values with commas */
  copy_with_colons(text, copy);
  if (strchr(copy, ':') != NULL)
    return set_range(row, text, copy, list);
  char *rest = NULL;
  for (char *part = strtok_r(copy, ",", &rest); part != NULL; part = strtok_r(NULL, ",", &rest))
    if (!set_one(row, part, common, &list->item[list->count++]))
      return false;
  return list->count > 0 || refuse(row, text);
}

/* Whether two whole numbers look like one with a decimal comma: 1,5 or 0,90 but not 20,30 or
 * 0,50%, nor 0,40 of degrees. Warns.
 */
static bool warn_of_comma(const option_row *row, const char *text) {
  static const char digits[] = "0123456789";
  const int whole = (int)strspn(text, digits),
            part = text[whole] == ',' ? (int)strspn(text + whole + 1, digits) : 0;
  const char *second = text + whole + 1, *unit = second + part;
  const bool angle =
      row->least == MEASURE_CUT || row->least == MEASURE_ANGLE || row->least == MEASURE_ELEVATION;
  if (whole == 0 || part == 0 || strpbrk(unit, ",.:%") != NULL || unit[0] == 'e' ||
      unit[0] == 'E' || (angle && part > 1) ||
      (whole > 1 && text[0] != '0' && part > 1 && second[0] != '0' && second[part - 1] == '0'))
    return false;
  complain("--%s '%s': read as two values, %.*s and %s; try %.*s.%s for one with decimals, or "
           "%.*s.0,%.*s.0%s for two",
           row->name, text, whole, text, second, whole, text, second, whole, text, part, second,
           unit);
  return true;
}

OPTION_SET(set_values) {
  const bool comma = row->set == set_values && warn_of_comma(row, text),
             good = read_values(row, text, field);
  ((values *)field)->comma = comma;
  return good;
}

int measure_of_unit(const char *unit) {
  static const struct {
    const char *unit;
    int measure;
  } rows[] = {{"m", MEASURE_LENGTH},
              {"kg", MEASURE_MASS},
              {"s", MEASURE_TIME},
              {"m/s", MEASURE_SPEED},
              {"degrees", MEASURE_ANGLE}};
  for (size_t k = 0; k < COUNT_OF(rows); k++)
    if (same_text(rows[k].unit, unit))
      return rows[k].measure;
  return MEASURE_NUMBER;
}

bool value_in_unit(int measure, double number, const char *unit, value *v) {
  const int found = find_unit(measure, unit);
  return found != NO_UNIT && set_value(v, number, found);
}

bool value_of(int measure, const char *text, value *v) {
  double number;
  const char *unit;
  if (!split(text, &number, &unit))
    return false;
  return value_in_unit(measure, number, unit, v);
}

void values_default(values *list, int measure, const char *text) {
  const option_row row = {.name = "default", .least = measure};
  read_values(&row, text, list);
}

double tip_offset(const value *const *offsets, int count, double radius) {
  double square = 0.0;
  for (int k = 0; k < count; k++)
    if (offsets[k]->times == OFFSET)
      square += offsets[k]->x * offsets[k]->x;
  return sqrt(square) / (strike * radius);
}

const char *share_of_rolling(const value *v) {
  return text_if(v->times == ROLLING && !isnan(v->number), " of rolling");
}

double spin_of(const value *v, double speed, double radius, double gearing) {
  switch (v->times) {
  case ROLLING:
    return v->x * speed / radius;
  case OFFSET:
    return v->x * speed / (radius * radius);
  case GEARING:
    return gearing;
  case GEARED:
    return copysign(v->x, v->x * gearing) * speed / radius;
  default:
    return v->x;
  }
}
