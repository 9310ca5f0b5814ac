/* Recordings: lines of JSON, read and written by one table of keys.
 *
 * A line is {"KIND": {"KEY": VALUE, ...}}. A field of the table below is a key, the type of its
 * value and its place in carom_record. A key that is missing has the value 0; in an object of a
 * list, the value of the object before it. So a writer leaves out the fields that have the bytes of
 * that default, and a reader begins with it. Every other key is refused, and every one that comes
 * twice. */
#include "carom_record.h"
#include "platform/arithmetic.h"
#include "platform/fingerprint.h"
#include "platform/promise.h"
#include "record/number_text.h"
#include "schema/options.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* ---- The format ------------------------------------------------------------------------------ */

typedef enum type { DOUBLE, INT32, INT64, HASH, LIST } type;

typedef struct field {
  const char *key;
  type type;
  bool always;                /* written whatever it is, and required */
  int count;                  /* of its values: [x, y] of 2; the most objects of a list */
  size_t offset;              /* its offset in the object, */
  size_t size, counted;       /* of a list: bytes of an object, offset of their number (int64_t), */
  const struct field *fields; /* and its fields. Tables of fields end with a key of NULL. */
} field;

#define END \
  { NULL, DOUBLE, false, 0, 0, 0, 0, NULL }

/* The type of a member and how many it has; and of members of structs that have rows. */
#define KEY_TYPE(x) \
  _Generic(x, double *: DOUBLE, double: DOUBLE, int64_t: INT64, uint64_t: INT64, default: INT32)
#define MEMBER(name, STRUCT, member)                                                         \
  {name,                                                                                     \
   KEY_TYPE(((STRUCT *)NULL)->member),                                                       \
   false,                                                                                    \
   sizeof(((STRUCT *)NULL)->member) / (KEY_TYPE(((STRUCT *)NULL)->member) == INT32 ? 4 : 8), \
   offsetof(STRUCT, member),                                                                 \
   0,                                                                                        \
   0,                                                                                        \
   NULL},
#define RAIL_KEY(member, ...) MEMBER(#member, carom_rail, member)
#define JAW_KEY(member, ...) MEMBER(#member, carom_jaw, member)
#define POCKET_KEY(member, ...) MEMBER(#member, carom_pocket, member)
#define STATE_KEY(member, ...) MEMBER(#member, carom_ball_state, member)
#define BALL_KEY(member, ...) MEMBER(#member, carom_shot_ball, kind.member)
#define PLACE_KEY(member, ...) MEMBER(#member, carom_shot_ball, state.member)
#define CUE_KEY(member, ...) MEMBER(#member, carom_record, cue.member)
#define OPTION_KEY(member, ...) MEMBER(#member, carom_record, options.member)

static const field rail_fields[] = {CAROM_RAIL_NUMBERS(RAIL_KEY, RAIL_KEY) END};
static const field jaw_fields[] = {CAROM_JAW_NUMBERS(JAW_KEY, JAW_KEY) END};
static const field pocket_fields[] = {CAROM_POCKET_NUMBERS(POCKET_KEY, POCKET_KEY) END};
static const field state_fields[] = {CAROM_STATE_NUMBERS(STATE_KEY, STATE_KEY) END};
static const field ball_fields[] = {CAROM_NUMBERS(BALL_KEY, BALL_KEY)
                                        CAROM_STATE_NUMBERS(PLACE_KEY, PLACE_KEY) END};

/* Of the record itself: a key and the member of carom_record that it is. */
#define R(key, type, always, n, member) \
  { key, type, always, n, offsetof(carom_record, member), 0, 0, NULL }
#define LISTED(key, most, member, counted, fields)                                      \
  {                                                                                     \
    key, LIST, false, most, offsetof(carom_record, member),                             \
        sizeof(((carom_record *)0)->member[0]), offsetof(carom_record, counted), fields \
  }

static const field head[] = {R("format", INT64, true, 1, format),
                             R("revision", INT64, true, 1, revision), END};
static const field table[] = {
    R("width", DOUBLE, true, 1, table.width),
    R("length", DOUBLE, true, 1, table.length),
    R("ball_radius", DOUBLE, false, 1, table.ball_radius),
    R("rail_width", DOUBLE, false, 1, table.rail_width),
    R("pocket_back", DOUBLE, false, 1, table.pocket_back),
    LISTED("rails", CAROM_RAILS_MOST, table.rail, table.rails, rail_fields),
    LISTED("jaws", CAROM_JAWS_MOST, table.jaw, table.jaws, jaw_fields),
    LISTED("pockets", CAROM_POCKETS_MOST, table.pocket, table.pockets, pocket_fields),
    END};
static const field models[] = {CAROM_MOTION_OPTIONS(OPTION_KEY) END};
/* The hash so far, with which a line of a match ends. */
#define SEAL R("hash", HASH, false, 1, seal)
static const field layout[] = {LISTED("list", CAROM_BALLS_MOST, balls, count, ball_fields), SEAL,
                               END};
#define MEMBER_KEY(NAME, member, ...) MEMBER(#member, carom_record, standing.member)
static const field game_fields[] = {R("rules", INT64, true, 1, rules),
                                    R("player", INT64, false, 1, player),
                                    CAROM_STATE_MEMBERS(MEMBER_KEY)
                                        R("user", INT64, false, 8, standing.user),
                                    R("winner", INT64, false, 1, winner),
                                    R("foul", INT64, false, 1, foul),
                                    SEAL,
                                    CAROM_LATER_MEMBERS(MEMBER_KEY) END};
static const field place_fields[] = {R("ball", INT64, true, 1, placed),
                                     R("at", DOUBLE, false, 2, place),
                                     R("hand", INT64, false, 1, hand),
                                     R("bounds", INT64, false, 1, bounds),
                                     SEAL,
                                     END};
static const field act_fields[] = {R("act", INT64, true, 1, act),
                                   R("player", INT64, false, 1, actor),
                                   R("choice", INT64, false, 1, choice),
                                   R("call", INT64, false, 2, call),
                                   SEAL,
                                   END};

/* How a shot ended. */
#define ENDS                                                                                  \
  R("status", INT64, true, 1, recorded.status), R("events", INT64, true, 1, recorded.events), \
      R("time", DOUBLE, true, 1, recorded.time), R("hash", HASH, true, 1, recorded.hash)
static const field shot[] = {
    CAROM_CUE_NUMBERS(CUE_KEY, CUE_KEY) CAROM_STOP_OPTIONS(OPTION_KEY) ENDS, END};
static const field goes_on[] = {CAROM_STOP_OPTIONS(OPTION_KEY) ENDS, END};
static const field event[] = {R("time", DOUBLE, true, 1, event.time),
                              R("type", INT32, true, 1, event.type),
                              R("a", INT32, true, 1, event.a),
                              R("b", INT32, false, 1, event.b),
                              R("cluster", INT32, false, 1, event.cluster),
                              R("impulse", DOUBLE, false, 1, event.impulse),
                              LISTED("before", 2, event.before, before, state_fields),
                              LISTED("after", 2, event.after, after, state_fields),
                              END};
static const field end[] = {R("shots", INT64, true, 1, shots), R("hash", HASH, true, 1, hash), END};

/* The lines, by carom_record_kind. */
static const struct {
  const char *key;
  const field *fields;
} lines[] = {{"", NULL},          {"recording", head},   {"table", table},
             {"options", models}, {"balls", layout},     {"place", place_fields},
             {"shot", shot},      {"continue", goes_on}, {"event", event},
             {"end", end},        {"game", game_fields}, {"", NULL},
             {"act", act_fields}};
enum { KINDS = sizeof lines / sizeof lines[0] };

static size_t size_of(const field *f) {
  if (f->type == LIST)
    return f->size;
  if (f->type == INT32)
    return sizeof(int32_t);
  return sizeof(int64_t);
}

static const int64_t MOST_WHOLE = 9007199254740991; /* of a double, 2^53 - 1 */

/* ---- The hash of the lines ------------------------------------------------------------------- */

/* Of recordings of shots, and of matches. */
enum { FORMAT = 2, FORMAT_OF_MATCH = 3 };

/* Whether lines of a kind end with the hash so far in a match. */
static bool is_sealed(int kind) {
  return kind == CAROM_RECORD_BALLS || kind == CAROM_RECORD_PLACE || kind == CAROM_RECORD_GAME ||
         kind == CAROM_RECORD_ACT;
}

/* Adds an object to a hash: each of its numbers that is not 0, behind its place among them, counted
 * from 1; of a list the number of its objects and these; and 0 as its end. So a key that a later
 * version adds behind the others changes no hash where it is missing. */
static uint64_t stir_object(uint64_t hash, const field *fields, const unsigned char *object) {
  uint64_t place = 0;
  for (const field *f = fields; f->key != NULL; f++) {
    const unsigned char *element = object + f->offset;
    int64_t n = f->count;
    if (f->type == LIST) {
      memcpy(&n, object + f->counted, sizeof n);
      place++;
      if (n != 0)
        hash = carom_stir(carom_stir(hash, place), (uint64_t)n);
    }
    for (int64_t k = 0; k < n; k++, element += size_of(f)) {
      int64_t word = 0;
      int32_t half = 0;
      if (f->type == LIST) {
        hash = stir_object(hash, f->fields, element);
        continue;
      }
      memcpy(f->type == INT32 ? (void *)&half : (void *)&word, element, size_of(f));
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
  return stir_object(carom_stir(hash, (uint64_t)kind), lines[kind].fields,
                     (const unsigned char *)record);
}

/* The hash behind a line: that of a shot covers the lines before it, so that a forged stroke is
 * told once and not by every line that follows. */
static uint64_t hash_behind(uint64_t hash, int kind, const carom_record *record) {
  const bool is_shot = kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_CONTINUE;
  if (is_shot)
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

/* Writes the fault of the value of a key, by its whole path; returns false. */
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

/* Whether the next character, behind blanks, is c; then it is passed. */
static bool next_is(reader *in, char c) {
  skip_blanks(in);
  if (in->position == in->end || *in->position != c)
    return false;
  in->position++;
  return true;
}

static bool expect(reader *in, char c, const char *what) {
  if (next_is(in, c))
    return true;
  if (in->position == in->end)
    what = "is cut off: the line ends too soon";
  return wrong(in, what);
}

/* A key with its colon, into `key`, cut where it is longer than any. */
enum { KEY_TEXT = 32 };
static bool read_key(reader *in, char key[KEY_TEXT]) {
  int n = 0;
  if (!expect(in, '"', "must be an object: a key in quotes comes here"))
    return false;
  for (; in->position < in->end && *in->position != '"'; in->position++) {
    char shown = *in->position;
    if (shown < ' ' || shown > '~')
      shown = '?';
    if (n < KEY_TEXT - 1)
      key[n++] = shown;
  }
  key[n] = '\0';
  return expect(in, '"', "") && expect(in, ':', "has a key without ':' behind it");
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
  bool good = next_is(in, '"') && in->end - in->position > 16;
  for (int k = 0; good && k < 16; k++, in->position++) {
    good = *in->position != '\0' && (digit = strchr(digits, *in->position)) != NULL;
    if (good)
      *hash = *hash << 4 | (uint64_t)(digit - digits);
  }
  return (good && next_is(in, '"')) || wrong(in, "must be 16 hexadecimal digits in quotes");
}

/* One value of a field that is no list. */
static bool read_value(reader *in, const field *f, unsigned char *value) {
  double x;
  if (f->type == HASH) {
    uint64_t hash;
    if (!read_hash(in, &hash))
      return false;
    memcpy(value, &hash, sizeof hash);
    return true;
  }
  if (!read_number(in, &x))
    return false;
  if (f->type == DOUBLE) {
    memcpy(value, &x, sizeof x);
    return true;
  }
  double most = (double)MOST_WHOLE;
  if (f->type == INT32)
    most = INT32_MAX;
  if (!(x >= -most && x <= most) || x != (double)(int64_t)x)
    return wrong(in, "must be a whole number");
  if (f->type == INT32)
    memcpy(value, &(int32_t){(int32_t)x}, sizeof(int32_t));
  else
    memcpy(value, &(int64_t){(int64_t)x}, sizeof(int64_t));
  return true;
}

static bool read_object(reader *in, const field *fields, unsigned char *object);

/* [object, object, ...], each of which begins as a copy of the one before. */
static bool read_list(reader *in, const field *f, unsigned char *object) {
  int64_t n = 0;
  in->list = f->key;
  in->key = NULL;
  if (!expect(in, '[', "must be a list of objects"))
    return false;
  if (!next_is(in, ']'))
    do {
      unsigned char *element = object + f->offset + (size_t)n * f->size;
      in->index = (int)n;
      if (n == f->count)
        return wrong(in, "is one object too many");
      if (n > 0)
        memcpy(element, element - f->size, f->size);
      else
        memset(element, 0, f->size);
      if (!read_object(in, f->fields, element))
        return false;
      in->key = NULL;
      n++;
    } while (next_is(in, ','));
  else
    n = -1; /* an empty list is closed already */
  if (n >= 0 && !expect(in, ']', "must be followed by ',' or ']'"))
    return false;
  if (n < 0)
    n = 0;
  memcpy(object + f->counted, &n, sizeof n);
  in->list = NULL;
  return true;
}

static bool read_field(reader *in, const field *f, unsigned char *object) {
  if (f->type == LIST)
    return read_list(in, f, object);
  if (f->count > 1 && !expect(in, '[', "must be a list of numbers"))
    return false;
  for (int k = 0; k < f->count; k++)
    if ((k > 0 && !expect(in, ',', "has too few numbers")) ||
        !read_value(in, f, object + f->offset + (size_t)k * size_of(f)))
      return false;
  return f->count == 1 || expect(in, ']', "has too many numbers");
}

static bool read_object(reader *in, const field *fields, unsigned char *object) {
  uint64_t seen = 0;
  if (!expect(in, '{', "must be an object"))
    return false;
  if (!next_is(in, '}')) {
    do {
      /* the field of that key */
      char key[KEY_TEXT];
      int k = 0;
      if (!read_key(in, key))
        return false;
      while (fields[k].key != NULL && strcmp(fields[k].key, key) != 0)
        k++;

      /* keys are known, and come once */
      in->key = key;
      if (fields[k].key == NULL)
        return wrong(in, "is no key of the format");
      CAROM_PROMISE(k < 64);
      if (seen >> k & 1)
        return wrong(in, "comes twice");
      seen |= UINT64_C(1) << k;
      /* its value */
      in->key = fields[k].key;
      if (!read_field(in, &fields[k], object))
        return false;
      in->key = NULL;
    } while (next_is(in, ','));
    if (!expect(in, '}', "must be followed by ',' or '}'"))
      return false;
  }

  /* those that must be there */
  for (int k = 0; fields[k].key != NULL; k++)
    if (fields[k].always && !(seen >> k & 1)) {
      in->key = fields[k].key;
      return wrong(in, "is missing");
    }
  return true;
}

/* All fields of a line as they are where their keys are missing. */
static void clear(carom_record *record, const field *fields) {
  unsigned char *object = (unsigned char *)record;
  for (const field *f = fields; f->key != NULL; f++) {
    memset(object + f->offset, 0, (size_t)f->count * size_of(f));
    if (f->type == LIST)
      memset(object + f->counted, 0, sizeof(int64_t));
  }
}

/* ---- What lines mean ------------------------------------------------------------------------- */

/* Whether a line of a kind may follow those before it; else why not. */
static const char *out_of_place(const carom_record *record, int kind) {
  const bool shot_before = record->kind == CAROM_RECORD_SHOT ||
                           record->kind == CAROM_RECORD_CONTINUE ||
                           record->kind == CAROM_RECORD_EVENT;
  if (record->kind == CAROM_RECORD_END)
    return "stands behind the end of the recording";
  if (record->kind == CAROM_RECORD_WRONG)
    return "stands behind a line that is wrong";
  if (record->format == 0 && kind != CAROM_RECORD_HEAD)
    return "stands where {\"recording\": ...} must: in the first line";
  if (record->format != 0 && kind == CAROM_RECORD_HEAD)
    return "comes twice";
  if (kind == CAROM_RECORD_ACT && record->match != 1)
    return "is a line of matches, format 3, in a recording of format 2";
  if (kind == CAROM_RECORD_EVENT && !shot_before)
    return "must follow a shot, its continuation, or another event";
  if ((kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_PLACE) && record->count == 0)
    return "has no balls: a line {\"balls\": ...} must come before";
  if ((kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_PLACE) && record->table.rails == 0)
    return "has no table: a line {\"table\": ...} must come before";
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

enum { RULES_MOST = 1000 }; /* more kinds of rules than there will be */

/* How the game stands: each member within its row, or 0 of a game without it. Lines that are
 * written are checked too. */
static bool check_standing(reader *in) {
#define CHECK_MEMBER(NAME, member, low, high, range)                \
  in->key = #member;                                                \
  memcpy(value, &state->member, sizeof state->member);              \
  for (size_t k = 0; k < sizeof state->member / sizeof *value; k++) \
    if (value[k] != 0 && (value[k] < (low) || value[k] > (high)))   \
      return wrong(in, "must be " range);
  const carom_rules_state *state = &in->record->standing;
  int32_t value[2];
  CAROM_ALL_MEMBERS(CHECK_MEMBER)
  in->key = "rules";
  if (in->record->rules < 0 || in->record->rules > RULES_MOST)
    return wrong(in, "must be a carom_rules_kind");
  in->key = "winner";
  if (in->record->winner < 0 || in->record->winner > 3)
    return wrong(in, "must be 0, 1, 2 or 3");
  in->key = "player";
  return (in->record->player >> 1) == 0 || wrong(in, "must be 0 or 1");
}

/* Whether the place of a ball in hand can be one. */
static bool check_place(reader *in) {
  enum { LEAVES = 6 };
  in->key = "hand";
  if ((in->record->hand >> 1) != 0)
    return wrong(in, "must be 0 or 1");
  in->key = "bounds";
  return (in->record->bounds >= 0 && in->record->bounds < LEAVES) ||
         wrong(in, "must be a carom_leave");
}

/* What a player decided. */
static bool check_act(reader *in) {
  in->key = "player";
  return (in->record->actor >> 1) == 0 || wrong(in, "must be 0 or 1");
}

/* Whether the seal of a line that was read is the hash so far, which the line becomes a part of. */
static bool check_seal(reader *in, int kind, uint64_t seal) {
  const carom_record *record = in->record;
  in->key = "hash";
  if (!is_sealed(kind))
    return true;
  if (record->match != 1)
    return seal == 0 || wrong(in, "stands in lines of matches alone, format 3");
  if (seal == 0 && record->hash != 0)
    return wrong(in, "is missing");
  return seal == record->hash || wrong(in, "is not that of the lines up to here");
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

/* A ball comes in hand, or is placed by the rules of carom_place_ball(). */
static bool apply_place(reader *in) {
  carom_record *record = in->record;
  if (!check_place(in))
    return false;
  in->key = NULL;
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

/* A line that was read is applied to the game. */
static bool apply(reader *in, int kind, int64_t shots, uint64_t hash) {
  carom_record *record = in->record;
  in->key = NULL;
  switch (kind) {
  /* what the game begins with */
  case CAROM_RECORD_HEAD:
    return check_head(in);
  case CAROM_RECORD_BALLS:
    record->moved = 0;
    in->key = "list";
    return record->count > 0 || wrong(in, "must have 1 to 32 balls");

  /* a ball is placed by the rules of carom_place_ball() */
  case CAROM_RECORD_PLACE:
    return apply_place(in);

  /* the caller is to play it before the next line */
  case CAROM_RECORD_SHOT:
  case CAROM_RECORD_CONTINUE:
    record->pending = 1;
    record->played.hash = hash; /* for carom_record_play() */
    record->shots++;
    return true;
  case CAROM_RECORD_EVENT:
    return record->before == record->after ||
           wrong(in, "has states of other balls before and after");

  case CAROM_RECORD_GAME:
    return check_standing(in);
  case CAROM_RECORD_ACT:
    return check_act(in);

  /* of what was read up to here */
  case CAROM_RECORD_END: {
    const bool same_shots = record->shots == shots, same_hash = record->hash == hash;
    record->shots = shots;
    record->hash = hash;
    in->key = "shots";
    if (same_shots)
      in->key = "hash";
    return (same_shots && same_hash) || wrong(in, "is not that of the lines above");
  }
  default:
    return true;
  }
}

/* The line, which is not blank, up to its kind. */
static bool read_line(reader *in, int *kind) {
  carom_record *record = in->record;
  char key[KEY_TEXT];
  if (!expect(in, '{', "is no line of a recording: it must be an object") || !read_key(in, key))
    return false;
  in->line = key;
  for (*kind = 1; *kind < KINDS && strcmp(lines[*kind].key, key) != 0; ++*kind)
    continue;
  if (*kind == KINDS || lines[*kind].fields == NULL)
    return wrong(in, "is no line of a recording");
  const char *why = out_of_place(record, *kind);
  if (why == NULL && record->pending == 1 && *kind != CAROM_RECORD_EVENT &&
      *kind != CAROM_RECORD_END)
    why = "comes before the shot above was played";
  if (why != NULL)
    return wrong(in, why);
  in->line = lines[*kind].key;
  const int64_t shots = record->shots;
  const uint64_t hash = record->hash;
  clear(record, lines[*kind].fields);
  record->seal = 0;
  if (!read_object(in, lines[*kind].fields, (unsigned char *)record) ||
      !expect(in, '}', "must be the only key of its line"))
    return false;
  skip_blanks(in);
  if (in->position != in->end)
    return wrong(in, "has more text behind its object");
  if (!apply(in, *kind, shots, hash))
    return false;
  if (*kind == CAROM_RECORD_END)
    return true;
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
  record->kind = CAROM_RECORD_WRONG; /* nothing is read behind a fault */
  if (!good)
    return CAROM_ERROR_RECORD;
  if (kind == CAROM_RECORD_HEAD && record->revision != carom_physics_revision())
    return CAROM_ERROR_REVISION;
  record->kind = kind;
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

carom_status carom_record_play(carom_record *record, carom_record_kind kind,
                               carom_shot *caller_shot) {
  static const carom_shot none = {0};
  enum { UNTOUCHED = -1 }; /* a label that no ball has */
  if (record == NULL)
    return CAROM_ERROR_NULL;
  const bool goes = kind == CAROM_RECORD_CONTINUE;
  const bool ended = record->kind == CAROM_RECORD_END || record->kind == CAROM_RECORD_WRONG;
  if (ended) {
    reader in = {.record = record};
    wrong(&in, out_of_place(record, (int)kind));
    return CAROM_ERROR_RECORD;
  }
  if ((!goes && kind != CAROM_RECORD_SHOT) || record->count < 1 ||
      record->count > CAROM_BALLS_MOST || (goes && record->moved == 0)) {
    reader in = {.record = record};
    wrong(&in, "there is no shot to be played");
    return CAROM_ERROR_RECORD;
  }
  if (!goes && record->cue.speed > 0.0 && is_moving(record)) {
    reader in = {.record = record};
    wrong(&in, "balls move, so that no ball is struck: the shot before is to be continued");
    return CAROM_ERROR_RECORD;
  }

  /* recordings promise the bits that all machines share */
  carom_shot local = none, *played = &local;
  if (caller_shot != NULL)
    played = caller_shot;
  carom_shot_options options = record->options;
  options.fast = 0;
  options.threads = 0;

  /* the end that the shot before left; a copy of the state costs as much as a short shot */
  const carom_ball_state first = record->final[0];
  if (!goes)
    carom_record_settle(record);
  else {
    played->count = record->played.events;
    played->time = record->played.time;
  }
  played->final = record->final;
  played->facts = &record->facts;
  played->state = NULL;
  if (goes || stops(&options))
    played->state = &record->state;
  else
    record->state.opaque[0] = 0;

  /* whether anything is played shows in the states at the end */
  record->final[0].label = UNTOUCHED;
  const int count = (int)record->count;
  carom_status status;
  if (goes)
    status = carom_shot_continue(&record->table, record->balls, count, &options, played);
  else
    status = carom_shoot(&record->table, record->balls, count, &record->cue, &options, played);
  if (record->final[0].label == UNTOUCHED) { /* nothing was played */
    record->final[0] = first;
    return status;
  }

  /* the lines before, the stroke, and how it ended, as 3 words and 10 of each ball */
  const carom_record_end recorded = record->recorded;
  uint64_t hash = record->hash;
  if (record->pending == 1)
    hash = record->played.hash;
  memset(&record->recorded, 0, sizeof recorded);
  hash = stir_line(hash, (int)kind, record);
  record->recorded = recorded;
  record->played = (carom_record_end){status, played->count, played->time, 0};
  hash = carom_fingerprint(hash, &record->played, 3 * sizeof(uint64_t));
  hash = carom_fingerprint(hash, record->final, (size_t)count * sizeof *record->final);
  record->played.hash = hash;
  record->moved = 1;
  record->pending = 2;
  record->kind = kind;
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

static void write_value(writer *out, const field *f, const unsigned char *value) {
  char text[CAROM_NUMBER_TEXT];
  if (f->type == HASH) {
    uint64_t hash;
    memcpy(&hash, value, sizeof hash);
    text[0] = text[17] = '"';
    for (int k = 0; k < 16; k++)
      text[1 + k] = "0123456789abcdef"[hash >> (60 - 4 * k) & 15];
    text[18] = '\0';
  } else {
    double x = 0.0;
    int64_t whole = 0;
    int32_t half = 0;
    if (f->type == DOUBLE)
      memcpy(&x, value, sizeof x);
    else if (f->type == INT64)
      memcpy(&whole, value, sizeof whole);
    else
      memcpy(&half, value, sizeof half);
    if (f->type != DOUBLE) /* -0 stays */
      x = (double)(whole + half);
    if (f->type == INT64 && (whole > MOST_WHOLE || whole < -MOST_WHOLE)) /* nor such a whole one */
      out->position = out->end;
    if (!(x - x == 0.0)) /* JSON has no such number */
      out->position = out->end;
    const int size = carom_number_write(x, text);
    CAROM_PROMISE(size > 0 && size < CAROM_NUMBER_TEXT);
    text[size] = '\0';
  }
  write_text(out, text);
}

static void write_object(writer *out, const field *fields, const unsigned char *object,
                         const unsigned char *previous);

static void write_list(writer *out, const field *f, const unsigned char *object, int64_t n) {
  static const unsigned char nothing[sizeof(carom_shot_ball)] = {0};
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

/* The fields that are not as in `before`, or where that is NULL not all 0. */
static void write_object(writer *out, const field *fields, const unsigned char *object,
                         const unsigned char *previous) {
  static const unsigned char zeros[8 * sizeof(double)] = {0};
  bool first = true;
  write_text(out, "{");
  for (const field *f = fields; f->key != NULL; f++) {
    /* how many numbers or elements; a count that was damaged writes nothing */
    int64_t n = f->count;
    if (f->type == LIST)
      memcpy(&n, object + f->counted, sizeof n);
    if (n < 0 || n > f->count) {
      out->position = out->end;
      return;
    }
    /* an empty list, and a number as before, are left out */
    if (f->type == LIST && n == 0)
      continue;
    const unsigned char *last = zeros;
    if (previous != NULL)
      last = previous + f->offset;
    if (f->type != LIST && !f->always &&
        memcmp(object + f->offset, last, (size_t)n * size_of(f)) == 0)
      continue;

    /* the key, then a list, a number, or numbers in brackets */
    if (!first)
      write_text(out, ",");
    write_text(out, "\"");
    write_text(out, f->key);
    write_text(out, "\":");
    first = false;
    if (f->type == LIST) {
      write_list(out, f, object, n);
      continue;
    }
    if (n != 1)
      write_text(out, "[");
    for (int k = 0; k < n; k++) {
      if (k > 0)
        write_text(out, ",");
      write_value(out, f, object + f->offset + (size_t)k * size_of(f));
    }
    if (n != 1)
      write_text(out, "]");
  }
  write_text(out, "}");
}

/* Whether the reader takes the values of a line by the same ranges. */
static bool can_be_read(carom_record *record, int kind) {
  reader in = {.record = record};
  switch (kind) {
  case CAROM_RECORD_BALLS:
    return record->count > 0;
  case CAROM_RECORD_GAME:
    return check_standing(&in);
  case CAROM_RECORD_PLACE:
    return check_place(&in);
  case CAROM_RECORD_ACT:
    return check_act(&in);
  default:
    return true;
  }
}

/* Whether a line of a kind can be written here: the reader would take it. */
static bool can_be_written(carom_record *record, int kind) {
  const bool is_shot = kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_CONTINUE;
  if (out_of_place(record, kind) != NULL || !can_be_read(record, kind))
    return false;
  return !is_shot || (record->pending == 2 && record->kind == kind);
}

size_t carom_record_write(carom_record *record, carom_record_kind kind, char *text, size_t room) {
  if (record == NULL || text == NULL || room == 0 || kind == CAROM_RECORD_BLANK ||
      (uint32_t)kind >= KINDS || lines[kind].fields == NULL) /* enumerations may be signed or not */
    return 0;
  const bool is_shot = kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_CONTINUE;
  if (!can_be_written(record, (int)kind))
    return 0;

  /* what the line says beside what is there */
  if (kind == CAROM_RECORD_HEAD) {
    record->format = FORMAT;
    if (record->match == 1)
      record->format = FORMAT_OF_MATCH;
    record->revision = carom_physics_revision();
  }
  if (is_shot)
    record->recorded = record->played;

  record->seal = 0;
  const uint64_t hash = hash_behind(record->hash, (int)kind, record);
  if (record->match == 1 && is_sealed((int)kind))
    record->seal = hash;

  /* the text; where there is no room for it nothing has happened */
  writer out = {text, text + room};
  write_text(&out, "{\"");
  write_text(&out, lines[kind].key);
  write_text(&out, "\":");
  write_object(&out, lines[kind].fields, (const unsigned char *)record, NULL);
  write_text(&out, "}\n");
  if (out.position == out.end) {
    if (kind == CAROM_RECORD_HEAD)
      record->format = 0;
    return 0;
  }

  /* what the line means for those behind it */
  *out.position = '\0';
  if (is_shot) {
    record->pending = 0;
    record->shots++;
  }
  if (kind != CAROM_RECORD_END)
    record->hash = hash;
  record->kind = kind;
  record->line++;
  return (size_t)(out.position - text);
}
