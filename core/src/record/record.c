/* Recordings: lines of JSON, read and written by one table of keys.
 *
 * A line is {"KIND": {"KEY": VALUE, ...}}. A field of the table below is a key, the type of its
 * value and its position in carom_record. A key that is missing has the value 0; in an object of a
 * list, the value of the object before it. So a writer leaves out the fields that have the bytes of
 * that default, and a reader begins with it. Every other key is rejected, and every key that occurs
 * twice. Only a note may have keys of other programs, with one prefix, which are kept.
 *
 * The command has a second reader of balls and cues, command/shots/shot_file.c, because its files
 * are another format: pooltool's keys and defaults, in JSON that people write by hand and that
 * Jansson parses. This one is in the library, which depends on nothing but C's library, and reads
 * what it wrote to the same bits and the same hash. Both take the numbers of a ball and of a cue
 * from the rows of schema/numbers.h, so a new number is one row for both. */
#include "platform/arithmetic.h"
#include "platform/fingerprint.h"
#include "platform/promise.h"
#include "record/lines.h"
#include "record/number_text.h"
#include "schema/options.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* ---- The format ------------------------------------------------------------------------------ */

#define RAIL_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_rail, member)
#define JAW_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_jaw, member)
#define POCKET_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_pocket, member)
#define STATE_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_ball_state, member)
#define BALL_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_shot_ball, kind.member)
#define PLACE_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_shot_ball, state.member)
#define CUE_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_record, cue.member)
#define OPTION_KEY(member, ...) CAROM_MEMBER_FIELD(#member, carom_record, options.member)

static const carom_field rail_fields[] = {CAROM_RAIL_NUMBERS(RAIL_KEY, RAIL_KEY) CAROM_NO_FIELD};
static const carom_field jaw_fields[] = {CAROM_JAW_NUMBERS(JAW_KEY, JAW_KEY) CAROM_NO_FIELD};
static const carom_field pocket_fields[] = {CAROM_POCKET_NUMBERS(POCKET_KEY, POCKET_KEY)
                                                CAROM_NO_FIELD};
static const carom_field state_fields[] = {CAROM_STATE_NUMBERS(STATE_KEY, STATE_KEY)
                                               CAROM_NO_FIELD};
static const carom_field ball_fields[] = {
    CAROM_NUMBERS(BALL_KEY, BALL_KEY) CAROM_STATE_NUMBERS(PLACE_KEY, PLACE_KEY) CAROM_NO_FIELD};

/* A list of objects of the record or of one of its members. */
#define LISTED(key, most, member, counted, fields)                                      \
  {                                                                                     \
    key, CAROM_VALUE_LIST, false, most, offsetof(carom_record, member),                 \
        sizeof(((carom_record *)0)->member[0]), offsetof(carom_record, counted), fields \
  }

static const carom_field head[] = {CAROM_RECORD_FIELD("format", INT64, true, 1, format),
                                   CAROM_RECORD_FIELD("revision", INT64, true, 1, revision),
                                   CAROM_NO_FIELD};
static const carom_field table[] = {
    CAROM_RECORD_FIELD("width", DOUBLE, true, 1, table.width),
    CAROM_RECORD_FIELD("length", DOUBLE, true, 1, table.length),
    CAROM_RECORD_FIELD("ball_radius", DOUBLE, false, 1, table.ball_radius),
    CAROM_RECORD_FIELD("rail_width", DOUBLE, false, 1, table.rail_width),
    CAROM_RECORD_FIELD("pocket_back", DOUBLE, false, 1, table.pocket_back),
    LISTED("rails", CAROM_RAILS_MOST, table.rail, table.rails, rail_fields),
    LISTED("jaws", CAROM_JAWS_MOST, table.jaw, table.jaws, jaw_fields),
    LISTED("pockets", CAROM_POCKETS_MOST, table.pocket, table.pockets, pocket_fields),
    CAROM_RECORD_FIELD("slope_x", DOUBLE, false, 1, table.slope_x),
    CAROM_RECORD_FIELD("slope_y", DOUBLE, false, 1, table.slope_y),
    CAROM_NO_FIELD};
static const carom_field models[] = {CAROM_MOTION_OPTIONS(OPTION_KEY) CAROM_NO_FIELD};
static const carom_field layout[] = {LISTED("list", CAROM_BALLS_MOST, balls, count, ball_fields),
                                     CAROM_SEAL_FIELD, CAROM_NO_FIELD};
static const carom_field place_fields[] = {CAROM_RECORD_FIELD("ball", INT64, true, 1, placed),
                                           CAROM_RECORD_FIELD("at", DOUBLE, false, 2, place),
                                           CAROM_RECORD_FIELD("hand", INT64, false, 1, hand),
                                           CAROM_RECORD_FIELD("bounds", INT64, false, 1, bounds),
                                           CAROM_SEAL_FIELD,
                                           CAROM_NO_FIELD};
/* How a shot ended. */
#define ENDS                                                         \
  CAROM_RECORD_FIELD("status", INT64, true, 1, recorded.status),     \
      CAROM_RECORD_FIELD("events", INT64, true, 1, recorded.events), \
      CAROM_RECORD_FIELD("time", DOUBLE, true, 1, recorded.time),    \
      CAROM_RECORD_FIELD("hash", HASH, true, 1, recorded.hash)
static const carom_field shot[] = {
    CAROM_CUE_NUMBERS(CUE_KEY, CUE_KEY) CAROM_STOP_OPTIONS(OPTION_KEY) ENDS, CAROM_NO_FIELD};
static const carom_field continued[] = {CAROM_STOP_OPTIONS(OPTION_KEY) ENDS, CAROM_NO_FIELD};
static const carom_field event[] = {CAROM_RECORD_FIELD("time", DOUBLE, true, 1, event.time),
                                    CAROM_RECORD_FIELD("type", INT32, true, 1, event.type),
                                    CAROM_RECORD_FIELD("a", INT32, true, 1, event.a),
                                    CAROM_RECORD_FIELD("b", INT32, false, 1, event.b),
                                    CAROM_RECORD_FIELD("cluster", INT32, false, 1, event.cluster),
                                    CAROM_RECORD_FIELD("impulse", DOUBLE, false, 1, event.impulse),
                                    LISTED("before", 2, event.before, before, state_fields),
                                    LISTED("after", 2, event.after, after, state_fields),
                                    CAROM_NO_FIELD};
static const carom_field end[] = {CAROM_RECORD_FIELD("shots", INT64, true, 1, shots),
                                  CAROM_RECORD_FIELD("hash", HASH, true, 1, hash), CAROM_NO_FIELD};

#define NOTE_TEXT(member)                                                      \
  {                                                                            \
#member, CAROM_VALUE_WORDS, false, 1, offsetof(carom_record, note.member), \
        sizeof(((carom_record *)0)->note.member), 0, NULL                      \
  }
static const carom_field note_fields[] = {
    CAROM_RECORD_FIELD("seat", SEAT, false, 1, note.by),
    NOTE_TEXT(date),
    NOTE_TEXT(event),
    NOTE_TEXT(site),
    NOTE_TEXT(round),
    NOTE_TEXT(name),
    NOTE_TEXT(comment),
    NOTE_TEXT(offer),
    NOTE_TEXT(answer),
    CAROM_RECORD_FIELD("seconds", DOUBLE, false, 1, note.seconds),
    {"x_", CAROM_VALUE_EXTRAS, false, CAROM_NOTE_EXTRAS, offsetof(carom_record, note.extra),
     sizeof(carom_note_extra), offsetof(carom_record, note.extras), NULL},
    CAROM_NO_FIELD};
/* The value of an extra. */
static const carom_field extra_text = {NULL,
                                       CAROM_VALUE_WORDS,
                                       true,
                                       1,
                                       offsetof(carom_note_extra, text),
                                       sizeof(((carom_note_extra *)0)->text),
                                       0,
                                       NULL};

static const char *find_fault_of_note(const carom_record *record, const char **key) {
  return carom_note_fault(&record->note, key);
}

static const char *find_fault_of_place(const carom_record *record, const char **key) {
  *key = "hand";
  if (record->hand < 0 || record->hand > 1)
    return "must be 0 or 1";
  return NULL;
}

/* The lines of shots, by carom_record_kind. */
static const carom_line lines[CAROM_LINE_KINDS] = {
    [CAROM_RECORD_HEAD] = {.key = "recording", .fields = head},
    [CAROM_RECORD_TABLE] = {.key = "table", .fields = table},
    [CAROM_RECORD_OPTIONS] = {.key = "options", .fields = models},
    [CAROM_RECORD_BALLS] = {.key = "balls", .fields = layout, .is_sealed = true},
    [CAROM_RECORD_PLACE] = {.key = "place",
                            .fields = place_fields,
                            .is_sealed = true,
                            .find_fault = find_fault_of_place},
    [CAROM_RECORD_SHOT] = {.key = "shot", .fields = shot},
    [CAROM_RECORD_CONTINUE] = {.key = "continue", .fields = continued},
    [CAROM_RECORD_EVENT] = {.key = "event", .fields = event},
    [CAROM_RECORD_END] = {.key = "end", .fields = end},
    [CAROM_RECORD_NOTE] = {
        .key = "note", .fields = note_fields, .is_note = true, .find_fault = find_fault_of_note}};

#ifdef CAROM_WITHOUT_PLAN
const carom_line carom_upper_lines[CAROM_LINE_KINDS] = {{.key = NULL}};
#endif

/* The row of a kind; NULL: there is no such line. */
static const carom_line *line_of(int kind) {
  if (kind < 0 || kind >= CAROM_LINE_KINDS)
    return NULL;
  if (lines[kind].key != NULL)
    return &lines[kind];
  if (carom_upper_lines[kind].key != NULL)
    return &carom_upper_lines[kind];
  return NULL;
}

static bool is_shot(int kind) {
  return kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_CONTINUE;
}

/* The kind of the last line that is no note. */
static int kind_before_notes(const carom_record *record) {
  if (record->kind == CAROM_RECORD_NOTE)
    return (int)record->before_notes;
  return (int)record->kind;
}

/* A line of a kind is now the last one. */
static void set_kind(carom_record *record, int kind) {
  record->before_notes = 0;
  if (kind == CAROM_RECORD_NOTE)
    record->before_notes = kind_before_notes(record);
  record->kind = kind;
}

static bool is_list(const carom_field *f) {
  return f->type == CAROM_VALUE_LIST || f->type == CAROM_VALUE_EXTRAS;
}

static bool is_text(const carom_field *f) {
  return f->type == CAROM_VALUE_TEXT || f->type == CAROM_VALUE_WORDS;
}

static size_t size_of(const carom_field *f) {
  if (is_list(f) || is_text(f))
    return f->size;
  if (f->type == CAROM_VALUE_INT32)
    return sizeof(int32_t);
  return sizeof(int64_t);
}

static const int64_t MOST_WHOLE = 9007199254740991; /* of a double, 2^53 - 1 */

/* ---- The hash of the lines ------------------------------------------------------------------- */

/* Of recordings of shots, and of matches. */
enum { FORMAT = 2, FORMAT_OF_MATCH = 3 };

/* Adds a text in `size` bytes, by words of 8 bytes. */
static uint64_t stir_text(uint64_t hash, const unsigned char *text, size_t size) {
  for (size_t k = 0; k < size; k += 8) {
    uint64_t word;
    memcpy(&word, text + k, sizeof word);
    hash = carom_stir(hash, word);
  }
  return hash;
}

/* Adds an object to a hash: each of its numbers that is not 0, behind its position among them,
 * counted from 1; of a list the number of its objects and these; and 0 as its end. So a key that a
 * later version adds behind the others changes no hash where it is missing. */
static uint64_t stir_object(uint64_t hash, const carom_field *fields, const unsigned char *object) {
  uint64_t place = 0;
  for (const carom_field *f = fields; f->key != NULL; f++) {
    const unsigned char *element = object + f->offset;
    int64_t n = f->count;
    if (f->type == CAROM_VALUE_LIST) {
      memcpy(&n, object + f->counted, sizeof n);
      place++;
      if (n != 0)
        hash = carom_stir(carom_stir(hash, place), (uint64_t)n);
    }
    for (int64_t k = 0; k < n; k++, element += size_of(f)) {
      int64_t word = 0;
      int32_t half = 0;
      if (f->type == CAROM_VALUE_LIST) {
        hash = stir_object(hash, f->fields, element);
        continue;
      }
      if (f->type == CAROM_VALUE_TEXT) {
        place++;
        if (element[0] != '\0')
          hash = stir_text(carom_stir(hash, place), element, size_of(f));
        continue;
      }
      memcpy(f->type == CAROM_VALUE_INT32 ? (void *)&half : (void *)&word, element, size_of(f));
      word += half;
      place++;
      if (word != 0)
        hash = carom_stir(carom_stir(hash, place), (uint64_t)word);
    }
  }
  return carom_stir(hash, 0);
}

/* The hash of the lines up to one of a kind whose values the record has. */
static uint64_t stir_line(uint64_t hash, int kind, const carom_record *record) {
  return stir_object(carom_stir(hash, (uint64_t)kind), line_of(kind)->fields,
                     (const unsigned char *)record);
}

/* The hash behind a line: that of a shot covers the lines before it, so that a forged stroke is
 * reported once and not by every line that follows. Notes are not covered. */
static uint64_t hash_behind(uint64_t hash, int kind, const carom_record *record) {
  if (line_of(kind)->is_note)
    return hash;
  if (is_shot(kind))
    return record->recorded.hash;
  return stir_line(hash, kind, record);
}

/* ---- Faults ---------------------------------------------------------------------------------- */

/* A line on its way in, with the keys that led to the value that is read. */
typedef struct reader {
  carom_record *record;
  const char *position, *end;
  const char *line, *list, *key; /* "balls", "list", "mass"; NULL where there is none */
  int index;                     /* in the list */
} reader;

static char *put(char *tail, const char *limit, const char *text) {
  while (*text != '\0' && tail < limit)
    *tail++ = *text++;
  return tail;
}

/* Writes the fault of the value of a key, with its complete path; returns false. */
static bool wrong(reader *in, const char *what) {
  carom_record *record = in->record;
  char *tail = record->fault, *limit = tail + sizeof record->fault - 1;
  if (in->line != NULL)
    tail = put(tail, limit, in->line);
  if (in->list != NULL) {
    char number[CAROM_NUMBER_TEXT];
    number[carom_number_write(in->index, number)] = '\0';
    tail = put(put(put(put(put(tail, limit, "."), limit, in->list), limit, "["), limit, number),
               limit, "]");
  }
  if (in->key != NULL)
    tail = put(put(tail, limit, "."), limit, in->key);
  if (tail > record->fault)
    tail = put(tail, limit, " ");
  *put(tail, limit, what) = '\0';
  return false;
}

/* ---- Reading --------------------------------------------------------------------------------- */

static void skip_blanks(reader *in) {
  while (in->position < in->end && (*in->position == ' ' || *in->position == '\t' ||
                                    *in->position == '\r' || *in->position == '\n'))
    in->position++;
}

/* Passes over the next character, behind blanks, if it is c. Returns whether it is. */
static bool pass_over(reader *in, char c) {
  skip_blanks(in);
  if (in->position == in->end || *in->position != c)
    return false;
  in->position++;
  return true;
}

static bool expect(reader *in, char c, const char *what) {
  if (pass_over(in, c))
    return true;
  if (in->position == in->end)
    what = "is cut off: the line ends too soon";
  return wrong(in, what);
}

/* A key with its colon, into `key`, cut where it is longer than any. */
enum { KEY_TEXT = 32 };
static bool read_key(reader *in, char key[KEY_TEXT]) {
  int n = 0;
  if (!expect(in, '"', "must be an object, with a key in quotes here"))
    return false;
  for (; in->position < in->end && *in->position != '"'; in->position++) {
    char shown = *in->position;
    if (shown < ' ' || shown > '~')
      shown = '?';
    if (n < KEY_TEXT - 1)
      key[n++] = shown;
  }
  key[n] = '\0';
  return expect(in, '"', "") && expect(in, ':', "has a key without ':' after it");
}

static bool read_number(reader *in, double *x) {
  const char *why;
  skip_blanks(in);
  if (in->position == in->end)
    return wrong(in, "is cut off: the line ends too soon");
  const char *following = carom_number_read(in->position, in->end, x, &why);
  if (following == NULL)
    return wrong(in, why);
  in->position = following;
  return true;
}

/* 16 digits in quotes. */
static bool read_hash(reader *in, uint64_t *hash) {
  static const char digits[] = "0123456789abcdef";
  const char *digit;
  *hash = 0;
  bool good = pass_over(in, '"') && in->end - in->position > 16;
  for (int k = 0; good && k < 16; k++, in->position++) {
    good = *in->position != '\0' && (digit = strchr(digits, *in->position)) != NULL;
    if (good)
      *hash = *hash << 4 | (uint64_t)(digit - digits);
  }
  return (good && pass_over(in, '"')) || wrong(in, "must be 16 hexadecimal digits in quotes");
}

/* A text in quotes, without escapes. */
static bool read_text(reader *in, unsigned char *text) {
  int n = 0;
  memset(text, 0, CAROM_SEAT_NAME);
  if (!pass_over(in, '"'))
    return wrong(in, "must be a text in quotes");
  for (; in->position < in->end && *in->position != '"'; in->position++) {
    if (n == CAROM_SEAT_NAME - 1 || !carom_is_in_text(*in->position))
      return wrong(in, "must have at most 31 bytes, without control characters and backslashes");
    text[n++] = (unsigned char)*in->position;
  }
  return expect(in, '"', "");
}

/* The bytes of a text that is read, and how many of them it may have. */
typedef struct words {
  unsigned char *text;
  size_t size, most;
} words;

/* Adds a byte to a text. */
static bool add_byte(reader *in, words *target, unsigned char byte) {
  if (target->size == target->most) {
    char what[64], number[CAROM_NUMBER_TEXT];
    number[carom_number_write((double)target->most, number)] = '\0';
    char *tail = put(what, what + 48, "must have at most ");
    *put(put(tail, what + 48, number), what + 56, " bytes") = '\0';
    return wrong(in, what);
  }
  if (byte < ' ' || byte == 127)
    return wrong(in, "must have no control characters and line ends");
  target->text[target->size++] = byte;
  return true;
}

/* Adds a code point as UTF-8. */
static bool add_code_point(reader *in, words *target, uint32_t point) {
  if (point < 0x80)
    return add_byte(in, target, (unsigned char)point);
  int more = 1; /* continuation bytes, of 6 bits each */
  uint32_t mark = 0xc0;
  if (point >= 0x800) {
    more = 2;
    mark = 0xe0;
  }
  if (point >= 0x10000) {
    more = 3;
    mark = 0xf0;
  }
  if (!add_byte(in, target, (unsigned char)(mark | point >> 6 * more)))
    return false;
  while (more-- > 0)
    if (!add_byte(in, target, (unsigned char)(0x80 | (point >> 6 * more & 0x3f))))
      return false;
  return true;
}

/* 4 hexadecimal digits behind \u. */
static bool read_unit(reader *in, uint32_t *unit) {
  static const char digits[] = "0123456789abcdefABCDEF";
  *unit = 0;
  for (int k = 0; k < 4; k++) {
    const char *digit = NULL;
    if (in->position < in->end && *in->position != '\0')
      digit = strchr(digits, *in->position);
    if (digit == NULL)
      return wrong(in, "must have 4 hexadecimal digits behind \\u");
    uint32_t value = (uint32_t)(digit - digits);
    if (value > 15)
      value -= 6;
    *unit = *unit << 4 | value;
    in->position++;
  }
  return true;
}

/* \u and four digits, or two of them for a code point beyond 16 bits; the "\u" was read. */
static bool read_code_point(reader *in, words *target) {
  uint32_t point, low;
  if (!read_unit(in, &point))
    return false;
  if (point >= 0xd800 && point < 0xdc00) {
    const bool has_low =
        in->end - in->position >= 2 && in->position[0] == '\\' && in->position[1] == 'u';
    if (!has_low)
      return wrong(in, "must have the second half of a surrogate pair");
    in->position += 2;
    if (!read_unit(in, &low))
      return false;
    if (low < 0xdc00 || low > 0xdfff)
      return wrong(in, "must have the second half of a surrogate pair");
    point = 0x10000 + ((point - 0xd800) << 10 | (low - 0xdc00));
  }
  return add_code_point(in, target, point);
}

/* A text in quotes, with the escapes of JSON for characters that it may have. */
static bool read_words(reader *in, const carom_field *f, unsigned char *text) {
  words target = {text, 0, f->size - 1};
  memset(text, 0, f->size);
  if (!pass_over(in, '"'))
    return wrong(in, "must be a text in quotes");
  while (in->position < in->end && *in->position != '"') {
    char c = *in->position++;
    if (c == '\\' && in->position < in->end) {
      c = *in->position++;
      if (c == 'u') {
        if (!read_code_point(in, &target))
          return false;
        continue;
      }
      if (c == 'n' || c == 'r' || c == 't' || c == 'b' || c == 'f')
        c = '\n'; /* a control character, which add_byte() refuses */
      else if (c != '"' && c != '\\' && c != '/')
        return wrong(in, "has an unknown escape: JSON has \\\", \\\\, \\/ and \\u");
    }
    if (!add_byte(in, &target, (unsigned char)c))
      return false;
  }
  return expect(in, '"', "");
}

/* A number as it is written, up to the next character that no number has; carom_note_fault() checks
 * it. */
static bool read_digits(reader *in, const carom_field *f, unsigned char *text) {
  static const char usual[] = "+-.0123456789eE";
  words target = {text, 0, f->size - 1};
  memset(text, 0, f->size);
  while (in->position < in->end && *in->position != '\0' && strchr(usual, *in->position) != NULL)
    if (!add_byte(in, &target, (unsigned char)*in->position++))
      return false;
  return target.size > 0 || wrong(in, "must be a text in quotes or a number");
}

/* The value of a key of another program, which is kept with its key. */
static bool read_extra(reader *in, const carom_field *f, unsigned char *object, const char *key) {
  int64_t n;
  memcpy(&n, object + f->counted, sizeof n);
  if (n == f->count)
    return wrong(in, "is one key too many: a note has at most 8 that begin with x_");
  carom_note_extra *extra = (carom_note_extra *)(void *)(object + f->offset) + n;
  memset(extra, 0, sizeof *extra);
  *put(extra->key, extra->key + sizeof extra->key - 1, key) = '\0';
  skip_blanks(in);
  unsigned char *text = (unsigned char *)extra->text;
  extra->is_number = in->position < in->end && *in->position != '"';
  n++;
  memcpy(object + f->counted, &n, sizeof n);
  if (extra->is_number == 0)
    return read_words(in, &extra_text, text);
  return read_digits(in, &extra_text, text);
}

/* The number of a seat, which the record has as 1 + this number. */
static bool read_seat(reader *in, unsigned char *value) {
  double x;
  if (!read_number(in, &x))
    return false;
  if (!(x >= 0.0 && x < (double)CAROM_SEATS_MOST) || x != (double)(int64_t)x)
    return wrong(in, "must be 0 to 7");
  memcpy(value, &(int64_t){1 + (int64_t)x}, sizeof(int64_t));
  return true;
}

/* One value of a field that is no list. */
static bool read_value(reader *in, const carom_field *f, unsigned char *value) {
  double x;
  if (f->type == CAROM_VALUE_TEXT)
    return read_text(in, value);
  if (f->type == CAROM_VALUE_WORDS)
    return read_words(in, f, value);
  if (f->type == CAROM_VALUE_SEAT)
    return read_seat(in, value);
  if (f->type == CAROM_VALUE_HASH) {
    uint64_t hash;
    if (!read_hash(in, &hash))
      return false;
    memcpy(value, &hash, sizeof hash);
    return true;
  }
  if (!read_number(in, &x))
    return false;
  if (f->type == CAROM_VALUE_DOUBLE) {
    memcpy(value, &x, sizeof x);
    return true;
  }
  double most = (double)MOST_WHOLE;
  if (f->type == CAROM_VALUE_INT32)
    most = INT32_MAX;
  if (!(x >= -most && x <= most) || x != (double)(int64_t)x)
    return wrong(in, "must be a whole number");
  if (f->type == CAROM_VALUE_INT32)
    memcpy(value, &(int32_t){(int32_t)x}, sizeof(int32_t));
  else
    memcpy(value, &(int64_t){(int64_t)x}, sizeof(int64_t));
  return true;
}

static bool read_object(reader *in, const carom_field *fields, unsigned char *object);

/* Element k of a list. It begins as a copy of the one before. */
static unsigned char *begin_element(const carom_field *f, unsigned char *object, int64_t k) {
  unsigned char *element = object + f->offset + (size_t)k * f->size;
  if (k > 0)
    memcpy(element, element - f->size, f->size);
  else
    memset(element, 0, f->size);
  return element;
}

/* The elements of a list up to its bracket, and how many there are. */
static bool read_elements(reader *in, const carom_field *f, unsigned char *object, int64_t *n) {
  if (pass_over(in, ']'))
    return true;
  do {
    in->index = (int)*n;
    if (*n == f->count)
      return wrong(in, "is one object too many");
    if (!read_object(in, f->fields, begin_element(f, object, *n)))
      return false;
    in->key = NULL;
    ++*n;
  } while (pass_over(in, ','));
  return expect(in, ']', "must be followed by ',' or ']'");
}

/* [object, object, ...] */
static bool read_list(reader *in, const carom_field *f, unsigned char *object) {
  int64_t n = 0;
  in->list = f->key;
  in->key = NULL;
  if (!expect(in, '[', "must be a list of objects"))
    return false;
  if (!read_elements(in, f, object, &n))
    return false;
  memcpy(object + f->counted, &n, sizeof n);
  in->list = NULL;
  return true;
}

static bool read_field(reader *in, const carom_field *f, unsigned char *object) {
  if (f->type == CAROM_VALUE_LIST)
    return read_list(in, f, object);
  if (f->count > 1 && !expect(in, '[', "must be a list of numbers"))
    return false;
  for (int k = 0; k < f->count; k++)
    if ((k > 0 && !expect(in, ',', "has too few numbers")) ||
        !read_value(in, f, object + f->offset + (size_t)k * size_of(f)))
      return false;
  return f->count == 1 || expect(in, ']', "has too many numbers");
}

/* Whether a key is that of a field, or begins as those of other programs do. */
static bool is_key_of(const carom_field *f, const char *key) {
  if (f->type == CAROM_VALUE_EXTRAS)
    return strncmp(key, f->key, strlen(f->key)) == 0;
  return strcmp(f->key, key) == 0;
}

/* A key with its value. `seen` has a bit for each field that was read. */
static bool read_entry(reader *in, const carom_field *fields, unsigned char *object,
                       uint64_t *seen) {
  char key[KEY_TEXT];
  if (!read_key(in, key))
    return false;
  int k = 0;
  while (fields[k].key != NULL && !is_key_of(&fields[k], key))
    k++;

  /* keys are known, and occur once; carom_note_fault() looks for those of other programs */
  in->key = key;
  if (fields[k].key == NULL)
    return wrong(in, "is not a key of the format");
  if (fields[k].type == CAROM_VALUE_EXTRAS) {
    if (!read_extra(in, &fields[k], object, key))
      return false;
    in->key = NULL;
    return true;
  }
  CAROM_PROMISE(k < 64);
  if (*seen >> k & 1)
    return wrong(in, "comes twice");
  *seen |= UINT64_C(1) << k;

  in->key = fields[k].key;
  if (!read_field(in, &fields[k], object))
    return false;
  in->key = NULL;
  return true;
}

static bool read_entries(reader *in, const carom_field *fields, unsigned char *object,
                         uint64_t *seen) {
  if (pass_over(in, '}'))
    return true;
  do {
    if (!read_entry(in, fields, object, seen))
      return false;
  } while (pass_over(in, ','));
  return expect(in, '}', "must be followed by ',' or '}'");
}

static bool read_object(reader *in, const carom_field *fields, unsigned char *object) {
  uint64_t seen = 0;
  if (!expect(in, '{', "must be an object"))
    return false;
  if (!read_entries(in, fields, object, &seen))
    return false;
  for (int k = 0; fields[k].key != NULL; k++) {
    if (!fields[k].is_required || (seen >> k & 1))
      continue;
    in->key = fields[k].key;
    return wrong(in, "is missing");
  }
  return true;
}

/* All fields of a line as they are where their keys are missing. */
static void clear(carom_record *record, const carom_field *fields) {
  unsigned char *object = (unsigned char *)record;
  for (const carom_field *f = fields; f->key != NULL; f++) {
    memset(object + f->offset, 0, (size_t)f->count * size_of(f));
    if (is_list(f))
      memset(object + f->counted, 0, sizeof(int64_t));
  }
}

/* ---- What lines mean ------------------------------------------------------------------------- */

/* Whether a line of a kind may follow those before it; else why not. */
static const char *out_of_place(const carom_record *record, int kind) {
  const int before = kind_before_notes(record);
  const bool follows_shot = is_shot(before) || before == CAROM_RECORD_EVENT;
  const bool needs_layout = kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_PLACE;
  const carom_line *line = line_of(kind);
  if (record->kind == CAROM_RECORD_END)
    return "follows the end of the recording";
  if (record->kind == CAROM_RECORD_WRONG)
    return "follows an invalid line";
  if (record->format == 0 && kind != CAROM_RECORD_HEAD)
    return "is the first line, which must be {\"recording\": ...}";
  if (record->format != 0 && kind == CAROM_RECORD_HEAD)
    return "comes twice";
  if (line != NULL && line->is_of_match && record->match != 1)
    return "is a line of matches, format 3, in a recording of format 2";
  if (kind == CAROM_RECORD_EVENT && !follows_shot)
    return "must follow a shot, its continuation, or another event";
  if (needs_layout && record->count == 0)
    return "has no balls: a line {\"balls\": ...} must precede it";
  if (needs_layout && record->table.rails == 0)
    return "has no table: a line {\"table\": ...} must precede it";
  return NULL;
}

carom_status carom_record_settle(carom_record *record) {
  if (record == NULL)
    return CAROM_ERROR_NULL;
  if (record->count < 0 || record->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  for (int k = 0; record->moved != 0 && k < record->count; k++)
    record->balls[k].state = record->final[k];
  record->moved = 0;
  return CAROM_OK;
}

carom_status carom_record_place(carom_record *record, int ball, double x, double y,
                                carom_part *in_the_way) {
  const carom_status settled = carom_record_settle(record);
  if (settled < 0)
    return settled;
  const carom_status status =
      carom_place_ball(&record->table, record->balls, (int)record->count, ball, x, y, in_the_way);
  if (status != CAROM_OK)
    return status;
  record->placed = ball;
  record->hand = 0;
  record->bounds = 0;
  record->place[0] = x;
  record->place[1] = y;
  return CAROM_OK;
}

carom_status carom_record_hand(carom_record *record, int ball) {
  const carom_status settled = carom_record_settle(record);
  if (settled < 0)
    return settled;
  if (ball < 0 || ball >= record->count)
    return CAROM_ERROR_BALLS;
  record->placed = ball;
  record->hand = 1;
  record->place[0] = record->place[1] = 0.0;
  record->balls[ball].state.label = CAROM_BALL_POCKETED;
  return CAROM_OK;
}

/* What is wrong with the values of a line, and its key; NULL: nothing. Lines that are written are
 * checked too. */
static const char *find_fault(const carom_record *record, int kind, const char **key) {
  const carom_line *const rows[2] = {&lines[kind], &carom_upper_lines[kind]};
  for (int k = 0; k < 2; k++) {
    const char *fault = NULL;
    if (rows[k]->find_fault != NULL)
      fault = rows[k]->find_fault(record, key);
    if (fault != NULL)
      return fault;
  }
  return NULL;
}

/* Whether the seal of a line that was read is the hash so far, to which the line is then added. */
static bool check_seal(reader *in, int kind, uint64_t seal) {
  const carom_record *record = in->record;
  in->key = "hash";
  if (!line_of(kind)->is_sealed)
    return true;
  if (record->match != 1)
    return seal == 0 || wrong(in, "is only allowed in lines of matches, format 3");
  if (seal == 0 && record->hash != 0)
    return wrong(in, "is missing");
  return seal == record->hash || wrong(in, "does not match the lines up to here");
}

/* The format of the text. */
static bool check_head(reader *in) {
  carom_record *record = in->record;
  in->key = "format";
  record->match = record->format == FORMAT_OF_MATCH;
  if (record->format == FORMAT || record->match == 1)
    return true;
  if (record->format == 1)
    return wrong(in,
                 "is 1, whose hashes do not cover tables and strokes; this carom reads 2 and 3. "
                 "Record the shots again");
  return wrong(in, "must be 2 or 3: a newer carom wrote this");
}

/* A ball is taken in hand, or is placed by the rules of carom_place_ball(). */
static bool apply_place(reader *in) {
  carom_record *record = in->record;
  int ball = -1;
  if (record->placed >= 0 && record->placed < record->count)
    ball = (int)record->placed;
  carom_status status;
  if (record->hand != 0)
    status = carom_record_hand(record, ball);
  else
    status = carom_record_place(record, ball, record->place[0], record->place[1], NULL);
  return status == CAROM_OK || wrong(in, carom_status_string(status));
}

/* The end has the numbers of the lines above it: `shots` and `hash`. */
static bool apply_end(reader *in, int64_t shots, uint64_t hash) {
  carom_record *record = in->record;
  const bool same_shots = record->shots == shots;
  const bool same_hash = record->hash == hash;
  record->shots = shots;
  record->hash = hash;
  in->key = "shots";
  if (same_shots)
    in->key = "hash";
  return (same_shots && same_hash) || wrong(in, "does not match the lines above");
}

/* A line that was read is applied to the game, in which `shots` and `hash` were those before. */
static bool apply(reader *in, int kind, int64_t shots, uint64_t hash) {
  carom_record *record = in->record;
  in->key = NULL;
  const char *fault = find_fault(record, kind, &in->key);
  if (fault != NULL)
    return wrong(in, fault);
  in->key = NULL;
  switch (kind) {
  case CAROM_RECORD_HEAD:
    return check_head(in);
  case CAROM_RECORD_BALLS:
    record->moved = 0;
    in->key = "list";
    return record->count > 0 || wrong(in, "must have 1 to 32 balls");
  case CAROM_RECORD_PLACE:
    return apply_place(in);
  case CAROM_RECORD_SHOT:
  case CAROM_RECORD_CONTINUE:
    /* the caller is to play it before the next line */
    record->pending = CAROM_PENDING_SHOT;
    record->played.hash = hash; /* for carom_record_play() */
    record->shots++;
    return true;
  case CAROM_RECORD_EVENT:
    return record->before == record->after ||
           wrong(in, "has states of other balls before and after");
  case CAROM_RECORD_END:
    return apply_end(in, shots, hash);
  default:
    return true;
  }
}

/* The kind of lines that has a key; -1: none has. */
static int kind_of(const char *key) {
  for (int kind = 0; kind < CAROM_LINE_KINDS; kind++) {
    const carom_line *line = line_of(kind);
    if (line != NULL && strcmp(line->key, key) == 0)
      return kind;
  }
  return -1;
}

/* Whether a line of a kind is allowed here. */
static bool may_come(reader *in, int kind) {
  const carom_record *record = in->record;
  const char *why = out_of_place(record, kind);
  const bool waits = kind != CAROM_RECORD_EVENT && kind != CAROM_RECORD_END;
  if (why == NULL && record->pending == CAROM_PENDING_SHOT && waits)
    why = "is not allowed before the shot above was played";
  return why == NULL || wrong(in, why);
}

/* The object of a line, into the record, and the end of the line. */
static bool read_fields(reader *in, const carom_field *fields) {
  carom_record *record = in->record;
  clear(record, fields);
  if (!read_object(in, fields, (unsigned char *)record))
    return false;
  if (!expect(in, '}', "must be the only key of its line"))
    return false;
  skip_blanks(in);
  return in->position == in->end || wrong(in, "has text after its object");
}

/* The line, which is not blank, and its kind. */
static bool read_line(reader *in, int *kind) {
  carom_record *record = in->record;
  char key[KEY_TEXT];
  if (!expect(in, '{', "is not a line of a recording, which must be an object") ||
      !read_key(in, key))
    return false;
  in->line = key;
  *kind = kind_of(key);
  if (*kind < 0)
    return wrong(in, "is not a line of a recording");
  if (!may_come(in, *kind))
    return false;

  const carom_line *line = line_of(*kind);
  const int64_t shots = record->shots;
  const uint64_t hash = record->hash;
  if (!line->is_note)
    record->seal = 0;
  in->line = line->key;
  if (!read_fields(in, line->fields) || !apply(in, *kind, shots, hash))
    return false;
  if (*kind == CAROM_RECORD_END || line->is_note)
    return true;

  /* the hash after the line covers its seal only through the lines before it */
  const uint64_t seal = record->seal;
  record->seal = 0;
  record->hash = hash_behind(hash, *kind, record);
  record->seal = seal;
  return check_seal(in, *kind, seal);
}

carom_status carom_record_read(carom_record *record, const char *line, size_t size) {
  if (record == NULL || line == NULL)
    return CAROM_ERROR_NULL;
  reader in = {.record = record, .position = line, .end = line + size};
  int kind = CAROM_RECORD_BLANK;
  record->line++;
  skip_blanks(&in);
  if (in.position == in.end)
    return CAROM_OK;
  const bool good = read_line(&in, &kind);
  const int64_t last = record->kind;
  record->kind = CAROM_RECORD_WRONG; /* nothing is read behind a fault */
  if (!good)
    return CAROM_ERROR_RECORD;
  if (kind == CAROM_RECORD_HEAD && record->revision != carom_physics_revision())
    return CAROM_ERROR_REVISION;
  record->kind = last;
  set_kind(record, kind);
  return CAROM_OK;
}

/* ---- Playing --------------------------------------------------------------------------------- */

static bool stops(const carom_shot_options *o) {
  return o->time_most > 0.0 || o->stop_at != 0 || o->first_of != 0 || o->events_most != 0;
}

/* Whether a ball moves where the last shot left them. */
static bool is_moving(const carom_record *record) {
  for (int64_t k = 0; k < record->count; k++) {
    int64_t label = record->balls[k].state.label;
    if (record->moved != 0)
      label = record->final[k].label;
    if (label != CAROM_BALL_STATIONARY && label != CAROM_BALL_POCKETED && label != CAROM_BALL_OFF)
      return true;
  }
  return false;
}

/* Whether the shot that the record has can be played; else why not. */
static const char *not_to_be_played(const carom_record *record, carom_record_kind kind) {
  const bool goes_on = kind == CAROM_RECORD_CONTINUE;
  if (record->kind == CAROM_RECORD_END || record->kind == CAROM_RECORD_WRONG)
    return out_of_place(record, (int)kind);
  if (!is_shot((int)kind) || record->count < 1 || record->count > CAROM_BALLS_MOST)
    return "there is no shot to play";
  if (goes_on && record->moved == 0)
    return "there is no shot to play";
  if (!goes_on && record->cue.speed > 0.0 && is_moving(record))
    return "balls move, so no ball can be struck; continue the previous shot";
  return NULL;
}

/* Prepares a shot whose results go into the record. */
static void prepare_shot(carom_record *record, bool goes_on, bool may_stop, carom_shot *played) {
  if (goes_on) {
    played->count = record->played.events;
    played->time = record->played.time;
  } else {
    carom_record_settle(record);
  }
  played->final = record->final;
  played->facts = &record->facts;
  /* a copy of the state costs as much as a short shot */
  played->state = NULL;
  if (goes_on || may_stop)
    played->state = &record->state;
  else
    record->state.opaque[0] = 0;
}

/* How the shot ended, with the hash of the lines before it, of the stroke, and of its end, as 3
 * words and 10 for each ball. */
static void note_end(carom_record *record, carom_record_kind kind, carom_status status,
                     const carom_shot *played) {
  const carom_record_end recorded = record->recorded;
  uint64_t hash = record->hash;
  if (record->pending == CAROM_PENDING_SHOT)
    hash = record->played.hash;
  memset(&record->recorded, 0, sizeof recorded);
  hash = stir_line(hash, (int)kind, record);
  record->recorded = recorded;
  record->played = (carom_record_end){status, played->count, played->time, 0};
  hash = carom_fingerprint(hash, &record->played, 3 * sizeof(uint64_t));
  hash = carom_fingerprint(hash, record->final, (size_t)record->count * sizeof *record->final);
  record->played.hash = hash;
  record->moved = 1;
  record->pending = CAROM_PENDING_LINE;
  record->kind = kind;
}

carom_status carom_record_play(carom_record *record, carom_record_kind kind,
                               carom_shot *caller_shot) {
  static const carom_shot none = {0};
  enum { UNTOUCHED = -1 }; /* a label that no ball has */
  if (record == NULL)
    return CAROM_ERROR_NULL;
  const char *why = not_to_be_played(record, kind);
  if (why != NULL) {
    wrong(&(reader){.record = record}, why);
    return CAROM_ERROR_RECORD;
  }

  /* recordings promise the bits that all machines share */
  carom_shot_options options = record->options;
  options.fast = 0;
  options.threads = 0;
  carom_shot local = none, *played = &local;
  if (caller_shot != NULL)
    played = caller_shot;
  const carom_ball_state first = record->final[0];
  const bool goes_on = kind == CAROM_RECORD_CONTINUE;
  prepare_shot(record, goes_on, stops(&options), played);

  /* whether anything is played shows in the states at the end */
  record->final[0].label = UNTOUCHED;
  const int count = (int)record->count;
  carom_status status;
  if (goes_on)
    status = carom_shot_continue(&record->table, record->balls, count, &options, played);
  else
    status = carom_shoot(&record->table, record->balls, count, &record->cue, &options, played);
  if (record->final[0].label == UNTOUCHED)
    record->final[0] = first;
  else
    note_end(record, kind, status, played);
  return status;
}

/* ---- Writing --------------------------------------------------------------------------------- */

typedef struct writer {
  char *position, *end; /* equal where the room is too small, or something cannot be written */
} writer;

static void write_text(writer *out, const char *text) {
  const size_t room = (size_t)(out->end - out->position);
  size_t n = strlen(text);
  if (n > room)
    n = room;
  CAROM_PROMISE(out->position <= out->end);
  memcpy(out->position, text, n);
  out->position += n;
}

/* 16 digits in quotes. */
static void write_hash(writer *out, uint64_t hash) {
  char text[CAROM_NUMBER_TEXT];
  text[0] = text[17] = '"';
  for (int k = 0; k < 16; k++)
    text[1 + k] = "0123456789abcdef"[hash >> (60 - 4 * k) & 15];
  text[18] = '\0';
  write_text(out, text);
}

/* A number; JSON has only finite ones, and not all integers beyond 2^53. */
static void write_number(writer *out, const carom_field *f, const unsigned char *value) {
  double x = 0.0;
  int64_t whole = 0;
  int32_t half = 0;
  if (f->type == CAROM_VALUE_DOUBLE)
    memcpy(&x, value, sizeof x);
  else if (f->type == CAROM_VALUE_INT64)
    memcpy(&whole, value, sizeof whole);
  else
    memcpy(&half, value, sizeof half);
  if (f->type != CAROM_VALUE_DOUBLE) /* -0 stays */
    x = (double)(whole + half);
  if (whole > MOST_WHOLE || whole < -MOST_WHOLE || !(x - x == 0.0))
    out->position = out->end;

  char text[CAROM_NUMBER_TEXT];
  const int size = carom_number_write(x, text);
  CAROM_PROMISE(size > 0 && size < CAROM_NUMBER_TEXT);
  text[size] = '\0';
  write_text(out, text);
}

/* A text in quotes, with its quotes and backslashes escaped. */
static void write_words(writer *out, const char *text) {
  write_text(out, "\"");
  for (; *text != '\0'; text++) {
    const char c[2] = {*text, '\0'};
    if (*text == '"' || *text == '\\')
      write_text(out, "\\");
    write_text(out, c);
  }
  write_text(out, "\"");
}

static void write_value(writer *out, const carom_field *f, const unsigned char *value) {
  if (f->type == CAROM_VALUE_WORDS) {
    write_words(out, (const char *)value);
    return;
  }
  if (f->type == CAROM_VALUE_SEAT) {
    int64_t by;
    memcpy(&by, value, sizeof by);
    const char digit[2] = {(char)('0' + by - 1), '\0'};
    write_text(out, digit);
    return;
  }
  if (f->type == CAROM_VALUE_TEXT) {
    write_text(out, "\"");
    write_text(out, (const char *)value);
    write_text(out, "\"");
    return;
  }
  if (f->type != CAROM_VALUE_HASH) {
    write_number(out, f, value);
    return;
  }
  uint64_t hash;
  memcpy(&hash, value, sizeof hash);
  write_hash(out, hash);
}

static void write_object(writer *out, const carom_field *fields, const unsigned char *object,
                         const unsigned char *previous);

static void write_list(writer *out, const carom_field *f, const unsigned char *object, int64_t n) {
  static const unsigned char nothing[sizeof(carom_shot_ball) + sizeof(carom_seat)] = {0};
  const unsigned char *previous = nothing;
  write_text(out, "[");
  for (int64_t k = 0; k < n; k++) {
    const unsigned char *element = object + f->offset + (size_t)k * f->size;
    if (k > 0)
      write_text(out, ",");
    write_object(out, f->fields, element, previous);
    previous = element;
  }
  write_text(out, "]");
}

/* How many numbers or elements a field has; -1: a count that was damaged. */
static int64_t count_of(const carom_field *f, const unsigned char *object) {
  int64_t n = f->count;
  if (is_list(f))
    memcpy(&n, object + f->counted, sizeof n);
  if (n < 0 || n > f->count)
    return -1;
  return n;
}

/* Whether a field is left out: an empty list, or a number as in the object before, or 0 where that
 * is NULL. */
static bool is_left_out(const carom_field *f, const unsigned char *object,
                        const unsigned char *previous, int64_t n) {
  static const unsigned char zeros[8 * sizeof(double)] = {0};
  if (is_list(f))
    return n == 0;
  if (f->is_required)
    return false;
  if (f->type == CAROM_VALUE_WORDS)
    return object[f->offset] == '\0';
  const unsigned char *usual = zeros;
  if (previous != NULL)
    usual = previous + f->offset;
  return memcmp(object + f->offset, usual, (size_t)n * size_of(f)) == 0;
}

static void write_key(writer *out, const char *key) {
  write_text(out, "\"");
  write_text(out, key);
  write_text(out, "\":");
}

/* The keys of other programs with their values. */
static void write_extras(writer *out, const carom_field *f, const unsigned char *object,
                         int64_t n) {
  for (int64_t k = 0; k < n; k++) {
    carom_note_extra extra;
    memcpy(&extra, object + f->offset + (size_t)k * f->size, sizeof extra);
    if (k > 0)
      write_text(out, ",");
    write_key(out, extra.key);
    if (extra.is_number != 0)
      write_text(out, extra.text);
    else
      write_words(out, extra.text);
  }
}

/* A list, a number, or numbers in brackets. */
static void write_field(writer *out, const carom_field *f, const unsigned char *object, int64_t n) {
  if (f->type == CAROM_VALUE_LIST) {
    write_list(out, f, object, n);
    return;
  }
  if (n != 1)
    write_text(out, "[");
  for (int64_t k = 0; k < n; k++) {
    if (k > 0)
      write_text(out, ",");
    write_value(out, f, object + f->offset + (size_t)k * size_of(f));
  }
  if (n != 1)
    write_text(out, "]");
}

static void write_object(writer *out, const carom_field *fields, const unsigned char *object,
                         const unsigned char *previous) {
  bool first = true;
  write_text(out, "{");
  for (const carom_field *f = fields; f->key != NULL; f++) {
    const int64_t n = count_of(f, object);
    if (n < 0) {
      out->position = out->end;
      return;
    }
    if (is_left_out(f, object, previous, n))
      continue;
    if (!first)
      write_text(out, ",");
    first = false;
    if (f->type == CAROM_VALUE_EXTRAS) {
      write_extras(out, f, object, n);
      continue;
    }
    write_key(out, f->key);
    write_field(out, f, object, n);
  }
  write_text(out, "}");
}

/* Whether a line of a kind can be written here: the reader would take it. */
static bool can_be_written(const carom_record *record, int kind) {
  const char *key;
  if (out_of_place(record, kind) != NULL || find_fault(record, kind, &key) != NULL)
    return false;
  if (kind == CAROM_RECORD_BALLS)
    return record->count > 0;
  if (is_shot(kind))
    return record->pending == CAROM_PENDING_LINE && kind_before_notes(record) == kind;
  return true;
}

/* Numbers that a line has in addition to the record. Returns the hash behind the line. */
static uint64_t complete_line(carom_record *record, int kind) {
  if (kind == CAROM_RECORD_HEAD) {
    record->format = FORMAT;
    if (record->match == 1)
      record->format = FORMAT_OF_MATCH;
    record->revision = carom_physics_revision();
  }
  if (is_shot(kind))
    record->recorded = record->played;
  if (line_of(kind)->is_note)
    return record->hash;
  record->seal = 0;
  const uint64_t hash = hash_behind(record->hash, kind, record);
  if (record->match == 1 && line_of(kind)->is_sealed)
    record->seal = hash;
  return hash;
}

/* What a line that was written means for those behind it. */
static void pass_line(carom_record *record, int kind, uint64_t hash) {
  if (is_shot(kind)) {
    record->pending = CAROM_PENDING_NONE;
    record->shots++;
  }
  if (kind != CAROM_RECORD_END)
    record->hash = hash;
  set_kind(record, kind);
  record->line++;
}

size_t carom_record_write(carom_record *record, carom_record_kind kind, char *text, size_t room) {
  if (record == NULL || text == NULL || room == 0)
    return 0;
  const carom_line *line = line_of((int)kind);
  if (line == NULL || !can_be_written(record, (int)kind))
    return 0;
  const uint64_t hash = complete_line(record, (int)kind);

  /* the text; where there is no room for it nothing has happened */
  writer out = {text, text + room};
  write_text(&out, "{\"");
  write_text(&out, line->key);
  write_text(&out, "\":");
  write_object(&out, line->fields, (const unsigned char *)record, NULL);
  write_text(&out, "}\n");
  if (out.position == out.end) {
    if (kind == CAROM_RECORD_HEAD)
      record->format = 0;
    return 0;
  }
  *out.position = '\0';
  pass_line(record, (int)kind, hash);
  return (size_t)(out.position - text);
}
