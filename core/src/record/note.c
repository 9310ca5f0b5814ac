/* The values that a note of a recording may have.
 *
 * A note comes from anybody, is shown on terminals and pages, and is written into lines of JSON. So
 * its texts are UTF-8 (RFC 3629: shortest forms, no surrogates) without the control characters of
 * ASCII and Unicode, which could end a line or command a terminal. */
#include "record/lines.h"

#include <stdbool.h>
#include <string.h>

static const char prefix_of_extras[] = "x_";

/* ---- Texts ----------------------------------------------------------------------------------- */

/* The code point at the beginning of a text, and *length becomes its bytes; -1: no UTF-8. */
static int32_t code_point_at(const unsigned char *text, size_t *length) {
  const unsigned char first = text[0];
  int32_t least = 0, point = first;
  *length = 1;
  if (first < 0x80)
    return point;
  if (first >= 0xc0 && first < 0xe0) {
    *length = 2;
    least = 0x80;
    point = first & 0x1f;
  } else if (first >= 0xe0 && first < 0xf0) {
    *length = 3;
    least = 0x800;
    point = first & 0x0f;
  } else if (first >= 0xf0 && first < 0xf8) {
    *length = 4;
    least = 0x10000;
    point = first & 0x07;
  } else {
    return -1;
  }

  /* the closing 0 is no continuation byte, so nothing behind it is read */
  for (size_t k = 1; k < *length; k++) {
    if ((text[k] & 0xc0) != 0x80)
      return -1;
    point = point << 6 | (text[k] & 0x3f);
  }
  const bool is_surrogate = point >= 0xd800 && point <= 0xdfff;
  if (point < least || point > 0x10ffff || is_surrogate)
    return -1;
  return point;
}

static bool is_control(int32_t point) {
  const bool is_line_end = point == 0x2028 || point == 0x2029;
  return point < 0x20 || (point >= 0x7f && point < 0xa0) || is_line_end;
}

/* What is wrong with a text in `room` bytes; NULL: nothing. */
static const char *find_fault_of_text(const char *text, size_t room) {
  if (memchr(text, '\0', room) == NULL)
    return "has no closing 0: the text is too long";
  const unsigned char *at = (const unsigned char *)text;
  while (*at != '\0') {
    size_t length;
    const int32_t point = code_point_at(at, &length);
    if (point < 0)
      return "must be UTF-8";
    if (is_control(point))
      return "must have no control characters and line ends";
    at += length;
  }
  return NULL;
}

/* ---- Keys of other programs ------------------------------------------------------------------ */

static bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

static const char *skip_digits(const char *text) {
  while (is_digit(*text))
    text++;
  return text;
}

/* Whether a text is a number of JSON: -12, 0.5, 1e-9. */
static bool is_json_number(const char *text) {
  if (*text == '-')
    text++;
  if (!is_digit(*text))
    return false;
  if (*text == '0')
    text++;
  else
    text = skip_digits(text);
  if (*text == '.') {
    if (!is_digit(text[1]))
      return false;
    text = skip_digits(text + 1);
  }
  if (*text == 'e' || *text == 'E') {
    text++;
    if (*text == '-' || *text == '+')
      text++;
    if (!is_digit(*text))
      return false;
    text = skip_digits(text);
  }
  return *text == '\0';
}

/* Whether a key is "x_" with letters, digits or "_" behind it. */
static bool is_key_of_extra(const char *key, size_t room) {
  const size_t prefix = sizeof prefix_of_extras - 1;
  const char *end =
      memchr(key, '\0', room - 1); /* a key of 31 bytes may have been cut by a reader */
  if (end == NULL || (size_t)(end - key) <= prefix || memcmp(key, prefix_of_extras, prefix) != 0)
    return false;
  for (const char *c = key + prefix; c < end; c++) {
    const bool is_letter = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z');
    if (!is_letter && !is_digit(*c) && *c != '_')
      return false;
  }
  return true;
}

static const char *find_fault_of_extras(const carom_note *note, const char **key) {
  *key = "extras";
  if (note->extras < 0 || note->extras > CAROM_NOTE_EXTRAS)
    return "must be at most 8 keys that begin with x_";
  for (int64_t k = 0; k < note->extras; k++) {
    const carom_note_extra *extra = &note->extra[k];
    if (!is_key_of_extra(extra->key, sizeof extra->key))
      return "must have keys of x_ and 1 to 28 letters, digits or _";
    *key = extra->key;
    for (int64_t other = 0; other < k; other++)
      if (strcmp(note->extra[other].key, extra->key) == 0)
        return "comes twice";
    const char *fault = find_fault_of_text(extra->text, sizeof extra->text);
    if (fault != NULL)
      return fault;
    if (extra->is_number != 0 && !is_json_number(extra->text))
      return "must be a text in quotes or a number";
    *key = "extras";
  }
  return NULL;
}

/* ---- Notes ----------------------------------------------------------------------------------- */

/* Whether a text is none, or one of two. */
static bool is_one_of(const char *text, const char *a, const char *b) {
  return text[0] == '\0' || strcmp(text, a) == 0 || strcmp(text, b) == 0;
}

const char *carom_note_fault(const carom_note *note, const char **key) {
  const struct {
    const char *key, *text;
    size_t room;
  } texts[] = {
      {"date", note->date, sizeof note->date},    {"event", note->event, sizeof note->event},
      {"site", note->site, sizeof note->site},    {"round", note->round, sizeof note->round},
      {"name", note->name, sizeof note->name},    {"comment", note->comment, sizeof note->comment},
      {"offer", note->offer, sizeof note->offer}, {"answer", note->answer, sizeof note->answer}};
  bool says_something = note->extras > 0 || note->seconds != 0.0;
  for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
    *key = texts[k].key;
    const char *fault = find_fault_of_text(texts[k].text, texts[k].room);
    if (fault != NULL)
      return fault;
    says_something = says_something || texts[k].text[0] != '\0';
  }

  *key = "offer";
  if (!is_one_of(note->offer, "draw", "take_back"))
    return "must be draw or take_back";
  *key = "answer";
  if (!is_one_of(note->answer, "yes", "no"))
    return "must be yes or no";
  *key = "seconds";
  if (!(note->seconds >= 0.0) || note->seconds - note->seconds != 0.0)
    return "must be 0 or more";
  *key = "seat";
  if (note->by < 0 || note->by > CAROM_SEATS_MOST)
    return "must be 0 to 7";

  const char *fault = find_fault_of_extras(note, key);
  if (fault != NULL)
    return fault;
  *key = NULL;
  if (!says_something)
    return "says nothing: it needs a date, an event, a comment or another key besides the seat";
  return NULL;
}
