/* The lines of recordings as rows: keys, the types of their values, and their positions in
 * carom_record. record.c has the lines of shots; lines of a layer above it are rows of
 * carom_upper_lines. */
#ifndef CAROM_SRC_RECORD_LINES_H
#define CAROM_SRC_RECORD_LINES_H

#include "carom_record.h"
#include "platform/arithmetic.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum carom_value_type {
  CAROM_VALUE_DOUBLE,
  CAROM_VALUE_INT32,
  CAROM_VALUE_INT64,
  CAROM_VALUE_HASH,
  CAROM_VALUE_TEXT, /* CAROM_SEAT_NAME bytes with a closing 0 */
  CAROM_VALUE_LIST
} carom_value_type;

typedef struct carom_field {
  const char *key;
  carom_value_type type;
  bool is_required;     /* and written whatever it is */
  int count;            /* of its values: [x, y] of 2; the most objects of a list */
  size_t offset;        /* its position in the object, */
  size_t size, counted; /* of a list: bytes of an object, offset of their number (int64_t), */
  const struct carom_field *fields; /* and its fields. Tables of fields end with a key of NULL. */
} carom_field;

#define CAROM_NO_FIELD \
  { NULL, CAROM_VALUE_DOUBLE, false, 0, 0, 0, 0, NULL }

/* A member of a struct, with its type and how many numbers it has. */
#define CAROM_VALUE_TYPE(x) \
  _Generic(x, double *: CAROM_VALUE_DOUBLE, double: CAROM_VALUE_DOUBLE, \
           int64_t: CAROM_VALUE_INT64, uint64_t: CAROM_VALUE_INT64, default: CAROM_VALUE_INT32)
#define CAROM_MEMBER_FIELD(key, STRUCT, member)                                   \
  {key,                                                                           \
   CAROM_VALUE_TYPE(((STRUCT *)NULL)->member),                                    \
   false,                                                                         \
   sizeof(((STRUCT *)NULL)->member) /                                             \
       (CAROM_VALUE_TYPE(((STRUCT *)NULL)->member) == CAROM_VALUE_INT32 ? 4 : 8), \
   offsetof(STRUCT, member),                                                      \
   0,                                                                             \
   0,                                                                             \
   NULL},

/* A field of the record itself, with the member of carom_record that it is. */
#define CAROM_RECORD_FIELD(key, TYPE, is_required, count, member) \
  { key, CAROM_VALUE_##TYPE, is_required, count, offsetof(carom_record, member), 0, 0, NULL }
/* The hash so far, with which a line of a match ends. */
#define CAROM_SEAL_FIELD CAROM_RECORD_FIELD("hash", HASH, false, 1, seal)

/* A kind of lines. */
typedef struct carom_line {
  const char *key; /* NULL: there is no line of this kind */
  const carom_field *fields;
  bool is_sealed;   /* ends with the hash so far in a match */
  bool is_of_match; /* only in matches */
  /* What is wrong with the values of a line, and *key becomes the key at fault; NULL: nothing. */
  const char *(*find_fault)(const carom_record *record, const char **key);
} carom_line;

/* Whether a text may have a character. */
static inline bool carom_is_in_text(char c) {
  return (unsigned char)c >= ' ' && c != '"' && c != '\\' && c != 127;
}

enum { CAROM_LINE_KINDS = CAROM_RECORD_SET + 1 };

/* Lines that a layer above this one has, by their carom_record_kind. A row without a key, of a
 * kind that record.c has, adds its find_fault to that. */
extern const carom_line carom_upper_lines[CAROM_LINE_KINDS];

#endif
