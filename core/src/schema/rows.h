/* How rows of numbers.h and options.h become those that programs request, and what a layer above
 * the library's own adds to them. */
#ifndef CAROM_SRC_SCHEMA_ROWS_H
#define CAROM_SRC_SCHEMA_ROWS_H

#include "carom_shot.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A row of any struct; its text is followed by further members of carom_number. */
#define CAROM_TYPE_OF(x) \
  _Generic(x, double *: CAROM_TYPE_DOUBLE, double: CAROM_TYPE_DOUBLE, \
           int64_t: CAROM_TYPE_INT64, uint64_t: CAROM_TYPE_UINT64, default: CAROM_TYPE_INT32)
#define CAROM_ROW(STRUCT, member, named, least, most, extra, ERROR, about, ...)                    \
  {.name = #member,                                                                                \
   .key = named,                                                                                   \
   .text = about,                                                                                  \
   .low = (double)(least),                                                                         \
   .high = (double)(most),                                                                         \
   .other = extra,                                                                                 \
   .offset = offsetof(STRUCT, member),                                                             \
   .error = CAROM_ERROR_##ERROR,                                                                   \
   .type = CAROM_TYPE_OF(((STRUCT *)NULL)->member),                                                \
   .count =                                                                                        \
       sizeof(((STRUCT *)NULL)->member) > 8 ? (int32_t)(sizeof(((STRUCT *)NULL)->member) / 8) : 1, \
   __VA_ARGS__},

/* An option, of which 0 is always right. */
#define CAROM_FORM_WORDS(KIND) .unit = "", .words = CAROM_WORDS_##KIND
#define CAROM_FORM_SET(KIND) CAROM_FORM_WORDS(KIND)
#define CAROM_FORM_NUMBER(measure) .unit = measure, .words = -1
#define CAROM_FORM_COUNT CAROM_FORM_NUMBER("")
#define CAROM_FORM_FLAG CAROM_FORM_COUNT
#define CAROM_FORM_SEED CAROM_FORM_COUNT
#define CAROM_WORDS_BALLS -1
#define CAROM_OPTION_ROW(STRUCT, READER, member, key, FORM, low, high, ERROR, about, ...)         \
  CAROM_ROW(STRUCT, member, key, low, high, (low) > 0 ? 0 : NAN, ERROR, about, CAROM_FORM_##FORM, \
            .cushion_offset = -1, .reader = CAROM_READ_##READER)

/* The word of a value of an enumeration. */
typedef struct carom_word_row {
  int kind, value;
  const char *word, *text;
} carom_word_row;

/* The numbers of a part, and named values, that a layer above adds. */
typedef struct carom_upper_rows {
  carom_part_kind part;
  const carom_number *numbers;
  int numbers_count;
  const carom_word_row *words;
  int words_count;
} carom_upper_rows;

extern const carom_upper_rows carom_upper_schema;

/* The start of a fit of recorded shots for a model of the cushion: writes the restitution_cushion,
 * mu_cushion and nose_height that the model needs for single impacts on the table of
 * CAROM_GAME_BILLIARD; false, with nothing written, if the model has no such start. */
bool carom_cushion_start(carom_cushion_model model, carom_ball_kind *kind);

#endif
