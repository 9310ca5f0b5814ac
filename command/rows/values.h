/* Lists and ranges of numbers with units, as players and students write them: 0:80, 1,3,7mph,
 * 0:100%, half; 0..80 is read as 0:80. */
#ifndef CAROM_CLI_VALUES_H
#define CAROM_CLI_VALUES_H

#include "program/options.h"

#include <math.h>

enum { MOST_VALUES = 1001, VALUE_NAME = 24 };

/* What a number measures, which decides its units. */
enum measure {
  MEASURE_NUMBER,
  MEASURE_SPEED,
  MEASURE_CUT,
  MEASURE_ANGLE,
  MEASURE_ELEVATION, /* an angle, or the least one of the stick: NaN */
  MEASURE_LENGTH,
  MEASURE_PLACE, /* a length, or diamonds of a table */
  MEASURE_TIME,
  MEASURE_MASS,
  MEASURE_OBJECT_MASS, /* or that of the other ball: NaN */
  MEASURE_FRICTION,    /* of two balls, or by a law: NaN */
  MEASURE_MODEL,       /* no number but a carom_cushion_model */
  MEASURE_TIP,
  MEASURE_SHARE,
  MEASURE_SPIN,
  MEASURE_SIDE,     /* of the cue ball at a collision, */
  MEASURE_SIDE_RAIL /* and at a cushion */
};

/* The words of a speed, as help lists them. */
#define SPEED_WORDS "soft|slow|medium|fast|power|break"
#define SPEEDS "soft 0.22, slow 0.67, medium 1.34, fast 2.46, power 3.8, break 12.3 m/s"

/* What a number is a multiple of. Of a spin: 1 rad/s; V/R, the spin of a ball that rolls; V/R^2, m,
 * by the offset of a tip; the side spin of a ball that rolls on the other without slip, or V/R to
 * its side. Of a place: DIAMONDS. Of a speed: that of the ball, also where speeds are the cue's. */
enum spin_unit { FIXED, ROLLING, OFFSET, GEARING, GEARED, DIAMONDS, OF_BALL };

typedef struct value {
  double x;              /* SI units; angles in degrees */
  double number;         /* in the unit of the list */
  int times;             /* enum spin_unit */
  char name[VALUE_NAME]; /* as it was given, with its unit: "7mph" */
} value;

typedef struct values {
  int count;
  bool range;
  bool comma;       /* two numbers that look like one with a decimal comma, of which set_values()
                       warned */
  const char *unit; /* as an axis says it: "mph" */
  value item[MOST_VALUES];
} values;

/* For `values` of a measure, row->least: numbers with commas, or a range A:B or A:B:STEP.
 * Numbers without a unit have that of the last one. Complains where one is none, where a spin
 * has no unit, and, but as a warning, where a list looks like one number with a decimal comma,
 * 1,5, unless it is for another kind of option. */
OPTION_SET(set_values);

/* Whether a text is the name of a unit, such as m/s. */
bool is_unit(const char *text);

/* Says how many values an option has, and the most it takes; returns false. */
bool too_many(const option_row *row, double count, int most);

/* Reads what set_values() would, for defaults; `text` is not changed. */
void values_default(values *list, int measure, const char *text);

/* The unit of a cut that is a part of the ball, as an axis says it. */
extern const char part_of_ball[];

/* The measure of the library's numbers that have a unit, "m"; MEASURE_NUMBER where no other unit is
 * read. */
int measure_of_unit(const char *unit);

/* A number in a unit of a measure, as a value of that name; false where it is none. */
bool value_in_unit(int measure, double number, const char *unit, value *v);

/* Reads one number of a measure, with a unit or without; false where it is none. */
bool value_of(int measure, const char *text, value *v);

/* How far from the centre, in R, a tip is that gives all spins that are given in tips. */
double tip_offset(const value *const *offsets, int count, double radius);

/* What a sentence says after the name of a spin: of what its percents are, "-71% of rolling". */
const char *share_of_rolling(const value *v);

/* A spin, rad/s, of a ball of that speed and radius. `gearing` is what GEARING stands for. */
double spin_of(const value *v, double speed, double radius, double gearing);

/* A value that was given, or the usual one where it is NaN. */
static inline double value_or(const value *v, double usual) {
  return isnan(v->x) ? usual : v->x;
}

#endif
