/* The rows of schema/ at run time, for programs that request them. Nothing here is on the path of
 * an impact. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include "cushion/list.h"
#include "friction/laws.h"
#include "schema/options.h"
#include "schema/rows.h"
#include "schema/synonyms.h"
#include "schema/words.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of a ball. */
#define READ_ALWAYS .reader = CAROM_READ_ALWAYS
#define READ_BY_CUSHION(MODEL) .reader = CAROM_READ_BY_CUSHION, .model = CAROM_CUSHION_##MODEL
#define READ_BY_FRICTION(LAW) .reader = CAROM_READ_BY_FRICTION, .model = CAROM_FRICTION_##LAW
#define READ_WITH(MODEL, number) READ_BY_CUSHION(MODEL)
#define BALL_ROW(member, key, measure, low, high, extra, ERROR, reads, about, in_cushion)  \
  CAROM_ROW(carom_ball_kind, member, key, low, high, extra, ERROR, about, .unit = measure, \
            READ_##reads, .cushion_offset = in_cushion, .words = -1)
#define BALL(...) BALL_ROW(__VA_ARGS__, -1)
#define CUSHION(member, ...) \
  BALL_ROW(member, __VA_ARGS__, (int32_t)offsetof(carom_cushion_options, member))
static const carom_number numbers[] = {CAROM_NUMBERS(BALL, CUSHION)};
#undef BALL
#undef CUSHION
enum { NUMBERS = sizeof numbers / sizeof numbers[0] };
_Static_assert(sizeof(carom_ball_kind) == NUMBERS * sizeof(double), "a row for each number");

/* Of the cue, the table and its parts, and the state of a ball. */
#define PART(STRUCT, member, key, measure, low, high, extra, ERROR, about)        \
  CAROM_ROW(STRUCT, member, key, low, high, extra, ERROR, about, .unit = measure, \
            .cushion_offset = -1, .words = -1)
#define CUE(...) PART(carom_cue, __VA_ARGS__)
#define TABLE(...) PART(carom_table, __VA_ARGS__)
#define RAIL(...) PART(carom_rail, __VA_ARGS__)
#define JAW(...) PART(carom_jaw, __VA_ARGS__)
#define POCKET(...) PART(carom_pocket, __VA_ARGS__)
#define STATE(...) PART(carom_ball_state, __VA_ARGS__)
#define MEASURE(...) PART(carom_measures, __VA_ARGS__)
static const carom_number cue_numbers[] = {CAROM_CUE_NUMBERS(CUE, CUE)},
                          table_numbers[] = {CAROM_TABLE_NUMBERS(TABLE, TABLE)},
                          rail_numbers[] = {CAROM_RAIL_NUMBERS(RAIL, RAIL)},
                          jaw_numbers[] = {CAROM_JAW_NUMBERS(JAW, JAW)},
                          pocket_numbers[] = {CAROM_POCKET_NUMBERS(POCKET, POCKET)},
                          state_numbers[] = {CAROM_STATE_NUMBERS(STATE, STATE)},
                          measures_numbers[] = {CAROM_MEASURES_NUMBERS(MEASURE, MEASURE)};
#undef RAIL

/* Options, of which 0 is always right. */
#define MOTION(...) CAROM_OPTION_ROW(carom_shot_options, ALWAYS, __VA_ARGS__)
#define STOP(...) CAROM_OPTION_ROW(carom_shot_options, TO_STOP, __VA_ARGS__, 0)
#define COMPUTE(...) CAROM_OPTION_ROW(carom_shot_options, TO_COMPUTE, __VA_ARGS__, 0)
#define IMPACT(...) CAROM_OPTION_ROW(carom_options, ALWAYS, __VA_ARGS__, 0)
#define RAIL(...) CAROM_OPTION_ROW(carom_cushion_options, ALWAYS, __VA_ARGS__, 0)
static const carom_number shot_options[] = {CAROM_MOTION_OPTIONS(MOTION) CAROM_STOP_OPTIONS(STOP)
                                                CAROM_COMPUTE_OPTIONS(COMPUTE)},
                          impact_options[] = {CAROM_IMPACT_OPTIONS(IMPACT)},
                          rail_options[] = {CAROM_RAIL_OPTIONS(RAIL)};
#undef PART
#undef RAIL

#ifdef CAROM_WITHOUT_PLAN
const carom_upper_rows carom_upper_schema = {.numbers_count = 0};
#endif

static const struct {
  const carom_number *row;
  int count;
} parts[] = {
#define ROWS(table) \
  { table, sizeof table / sizeof table[0] }
    [CAROM_PART_RAIL] = ROWS(rail_numbers),
    [CAROM_PART_JAW] = ROWS(jaw_numbers),
    [CAROM_PART_POCKET] = ROWS(pocket_numbers),
    [CAROM_PART_BALL] = ROWS(numbers),
    [CAROM_PART_OPTIONS] = ROWS(shot_options),
    [CAROM_PART_IMPACT_OPTIONS] = ROWS(impact_options),
    [CAROM_PART_CUSHION_OPTIONS] = ROWS(rail_options),
    [CAROM_PART_CUE] = ROWS(cue_numbers),
    [CAROM_PART_TABLE] = ROWS(table_numbers),
    [CAROM_PART_STATE] = ROWS(state_numbers),
    [CAROM_PART_MEASURES] = ROWS(measures_numbers),
};

const carom_number *carom_number_of(carom_part_kind part, int k) {
  if (k < 0)
    return NULL;
  if (part == carom_upper_schema.part && k < carom_upper_schema.numbers_count)
    return &carom_upper_schema.numbers[k];
  if ((uint32_t)part >= sizeof parts / sizeof parts[0] || k >= parts[part].count)
    return NULL;
  return &parts[part].row[k];
}

/* ---- Ranges in words */

/* Text that is cut at the end of its room; `length` continues. */
typedef struct words {
  char *text;
  size_t room, length;
} words;

static void add(words *w, const char *text) {
  for (; *text != '\0'; text++, w->length++)
    if (w->length + 1 < w->room)
      w->text[w->length] = *text;
}

static size_t end_of(words *w) {
  if (w->length < w->room)
    w->text[w->length] = '\0';
  else if (w->room > 0)
    w->text[w->room - 1] = '\0';
  return w->length;
}

static void add_whole(words *w, int64_t x) {
  char digits[24];
  int k = sizeof digits;
  digits[--k] = '\0';
  do
    digits[--k] = (char)('0' + x % 10);
  while ((x /= 10) > 0);
  add(w, digits + k);
}

/* Writes m 10^e, m > 0, as 12, 0.5, 1e6 or 1e-12. */
static void add_decimal(words *w, int64_t m, int e) {
  int64_t unit = 1;
  for (int k = 0; k < -e && e >= -4; k++)
    unit *= 10;
  for (; e > 0 && e < 5; e--)
    m *= 10;
  add_whole(w, m / unit);
  if (unit > 1)
    add(w, ".");
  for (int64_t part = unit / 10, rest = m % unit; rest > 0; rest %= part, part /= 10)
    add_whole(w, rest / part);
  if (e != 0 && unit == 1) {
    add(w, "e");
    if (e < 0) {
      add(w, "-");
      e = -e;
    }
    add_whole(w, e);
  }
}

/* Writes a number of at most four digits; writes nothing and returns false where it has more. */
static bool add_short(words *w, double x) {
  const double size = fabs(x);
  double ten = 1e22;
  for (int e = 22; e >= -22 && x != 0; e--) {
    const double m = e > 0 ? size / ten : size * ten;
    if (m < 1e4 && m >= 1 && m == (double)(int)m && (e > 0 ? m * ten : m / ten) == size) {
      if (x < 0)
        add(w, "-");
      add_decimal(w, (int64_t)m, e);
      return true;
    }
    ten = e > 0 ? ten / 10 : ten * 10;
  }
  if (x == 0)
    add(w, "0");
  return x == 0;
}

/* ---- The words of a range */

/* How a range ends on one side: nowhere, at the largest double, before a number, or at it. */
typedef enum range_end { END_NOWHERE, END_FINITE, END_EXCLUDED, END_INCLUDED } range_end;

/* What is before the low end of a range, and what between its low and its high end. */
typedef struct range_phrase {
  const char *before_low, *before_high;
} range_phrase;

/* "0 to 1", "0 or more and finite", "above 0 and at most 1", "between 1 and 2", "at most 1" */
static const range_phrase range_phrases[][4] = {
    [END_NOWHERE] = {[END_NOWHERE] = {"at most ", ""},
                     [END_FINITE] = {"finite", ""},
                     [END_EXCLUDED] = {"at most ", ""},
                     [END_INCLUDED] = {"at most ", ""}},
    [END_EXCLUDED] = {[END_NOWHERE] = {"above ", " or more"},
                      [END_FINITE] = {"above ", " and finite"},
                      [END_EXCLUDED] = {"between ", " and "},
                      [END_INCLUDED] = {"above ", " and at most "}},
    [END_INCLUDED] = {[END_NOWHERE] = {"", " or more"},
                      [END_FINITE] = {"", " or more and finite"},
                      [END_EXCLUDED] = {"", " or more and below "},
                      [END_INCLUDED] = {"", " to "}},
};

/* Writes an end of a range, and reports whether it belongs to the range. The next double to a short
 * number represents an end that does not. */
static range_end add_end(words *w, double x, double outwards) {
  if (add_short(w, x))
    return END_INCLUDED;
  add_short(w, nextafter(x, outwards));
  return END_EXCLUDED;
}

static range_end add_low_end(words *w, const carom_number *n) {
  if (n->low == -DBL_MAX)
    return END_NOWHERE;
  return add_end(w, n->low, -INFINITY);
}

/* An integer that may be as large as its type allows has no end. */
static range_end add_high_end(words *w, const carom_number *n) {
  if (n->high == DBL_MAX)
    return END_FINITE;
  if (n->type != CAROM_TYPE_DOUBLE && n->high >= INT32_MAX)
    return END_NOWHERE;
  return add_end(w, n->high, INFINITY);
}

static void add_interval(words *w, const carom_number *n) {
  char low_text[32], high_text[32];
  words low = {low_text, sizeof low_text, 0}, high = {high_text, sizeof high_text, 0};

  /* The text of an end that is nowhere, or only finite, is empty. */
  const range_end low_end = add_low_end(&low, n);
  const range_end high_end = add_high_end(&high, n);
  end_of(&low);
  end_of(&high);

  const range_phrase phrase = range_phrases[low_end][high_end];
  add(w, phrase.before_low);
  add(w, low_text);
  add(w, phrase.before_high);
  add(w, high_text);
}

static void add_bits(words *w, const carom_number *n) {
  int last_bit = 0;
  for (double above = 2; above < n->high; above *= 2)
    last_bit++;
  add(w, "a set of bits 0 to ");
  add_whole(w, last_bit);
}

/* "a", "a or b", "a, b or c" */
static void add_choices(words *w, carom_words kind) {
  const char *word = carom_word(kind, 0);
  for (int k = 0; word != NULL; k++) {
    const char *next = carom_word(kind, k + 1);
    if (k > 0 && next == NULL)
      add(w, " or ");
    else if (k > 0)
      add(w, ", ");
    add(w, word);
    word = next;
  }
}

/* The number that is right next to a range, where there is one; the interval; the unit. */
static void add_measure(words *w, const carom_number *n) {
  const bool has_other = add_short(w, n->other); /* it is NAN where there is none */
  if (has_other)
    add(w, ", or ");
  add_interval(w, n);
  if (n->unit[0] != '\0') {
    add(w, ", in ");
    add(w, n->unit);
  }
}

/* Text for text[room]; NULL receives none. */
static words words_in(char *text, size_t room) {
  if (text == NULL)
    room = 0;
  return (words){text, room, 0};
}

size_t carom_number_range(const carom_number *n, char *text, size_t room) {
  words w = words_in(text, room);
  if (n == NULL)
    return end_of(&w);
  if (n->type == CAROM_TYPE_UINT64)
    add_bits(&w, n);
  else if (n->words >= 0)
    add_choices(&w, (carom_words)n->words);
  else
    add_measure(&w, n);
  return end_of(&w);
}

/* ---- Faults */

static const carom_number *number_at(size_t offset) {
  return &numbers[offset / sizeof(double)];
}

#define WITHOUT_ALWAYS ""
#define WITHOUT_BY_CUSHION(model) ""
#define WITHOUT_BY_FRICTION(law) ""
#define WITHOUT_WITH(model, number) "0 where " #number " is 0"

const carom_number *carom_ball_fault(const carom_ball_kind *k, char *text, size_t room) {
  words w = words_in(text, room);
  if (k == NULL)
    return NULL;
#define RANGE(member, key, unit, low, high, extra, error, reader, about)  \
  if (!CAROM_IS_RIGHT(member, low, high, extra, ALWAYS)) {                \
    const carom_number *n = number_at(offsetof(carom_ball_kind, member)); \
    carom_number_range(n, text, room);                                    \
    return n;                                                             \
  }
#define ALONE(member, key, unit, low, high, extra, error, reader, about) \
  if (!(CAROM_GIVEN_##reader || k->member == 0)) {                       \
    add(&w, WITHOUT_##reader);                                           \
    end_of(&w);                                                          \
    return number_at(offsetof(carom_ball_kind, member));                 \
  }
#define CONDITION(member, holds, error, about)           \
  if (!(holds)) {                                        \
    add(&w, about);                                      \
    end_of(&w);                                          \
    return number_at(offsetof(carom_ball_kind, member)); \
  }
  CAROM_NUMBERS(RANGE, RANGE)
  CAROM_NUMBERS(ALONE, ALONE)
  CAROM_CONDITIONS(CONDITION, CONDITION)
#undef RANGE
#undef ALONE
#undef CONDITION
  return NULL;
}

/* ---- Starts of fits */

bool carom_cushion_start(carom_cushion_model model, carom_ball_kind *kind) {
#define START(NAME, name, impact, flight, rows, start, ...) {start},
  static const struct start {
    bool known;
    double e, mu, height;
  } starts[] = {CAROM_CUSHION_MODELS(START)};
#undef START
  if ((uint32_t)model >= CAROM_CUSHION_MODEL_COUNT || !starts[model].known)
    return false;
  kind->restitution_cushion = starts[model].e;
  kind->mu_cushion = starts[model].mu;
  kind->nose_height = starts[model].height;
  return true;
}

/* ---- Words */

static const carom_word_row words_of[] = {
#define WORD(OF, VALUE, word, text) {CAROM_WORDS_##OF, CAROM_##VALUE, word, text},
#define CUSHION(NAME, word, impact, flight, rows, start, sources, text) \
  {CAROM_WORDS_CUSHION_MODEL, CAROM_CUSHION_##NAME, word, text},        \
      {CAROM_WORDS_SHOT_CUSHION, CAROM_SHOT_CUSHION_##NAME, word, text},
#define LAW(NAME, word, of, numbers, at, ahead, sources, text) \
  {CAROM_WORDS_BALL_FRICTION, CAROM_FRICTION_##NAME, word, text},
    CAROM_WORD_ROWS(WORD) CAROM_CUSHION_MODELS(CUSHION) CAROM_FRICTION_LAWS(LAW)
#undef WORD
#undef CUSHION
#undef LAW
};

static const carom_word_row *find_in(const carom_word_row *rows, int count, carom_words kind,
                                     int value) {
  for (int k = 0; k < count; k++)
    if (rows[k].kind == (int)kind && rows[k].value == value)
      return &rows[k];
  return NULL;
}

static const carom_word_row *find(carom_words kind, int value) {
  const carom_word_row *found = find_in(words_of, sizeof words_of / sizeof *words_of, kind, value);
  if (found == NULL)
    found = find_in(carom_upper_schema.words, carom_upper_schema.words_count, kind, value);
  return found;
}

const char *carom_word(carom_words kind, int value) {
  const carom_word_row *found = find(kind, value);
  if (found == NULL)
    return NULL;
  return found->word;
}

const char *carom_word_text(carom_words kind, int value) {
  const carom_word_row *found = find(kind, value);
  if (found == NULL)
    return NULL;
  return found->text;
}

/* ---- Words as people write them */

enum { LONGEST_WORD = 24 };

/* The letters of a word in lower case, without hyphens, underscores and blanks. Writes at most
 * LONGEST_WORD of them and returns how many there are. */
static size_t letters_of(const char *word, const char *end, char letters[LONGEST_WORD + 1]) {
  size_t count = 0;
  for (; word < end; word++) {
    char letter = *word;
    if (letter == '-' || letter == '_' || letter == ' ')
      continue;
    if (letter >= 'A' && letter <= 'Z')
      letter = (char)(letter - 'A' + 'a');
    if (count < LONGEST_WORD)
      letters[count] = letter;
    count++;
  }
  letters[count < LONGEST_WORD ? count : LONGEST_WORD] = '\0';
  return count;
}

/* Whether two words have the same letters, or the parts at a hyphen of `word` in the other order:
 * "left side" is "side-left". */
static int has_same_letters(const char *text, const char *word) {
  char text_letters[LONGEST_WORD + 1], word_letters[LONGEST_WORD + 1], turned[LONGEST_WORD + 1];
  const char *end = word + strlen(word), *hyphen = strchr(word, '-');
  const size_t count = letters_of(text, text + strlen(text), text_letters);
  if (count == 0 || count > LONGEST_WORD || count != letters_of(word, end, word_letters))
    return 0;
  if (strcmp(text_letters, word_letters) == 0)
    return 1;
  if (hyphen == NULL)
    return 0;
  const size_t second = letters_of(hyphen, end, turned);
  letters_of(word, hyphen, turned + second);
  return strcmp(text_letters, turned) == 0;
}

static const struct {
  const char *name, *word;
} synonyms[] = {
#define SYNONYM(name, word) {name, word},
    CAROM_SYNONYM_ROWS(SYNONYM)
#undef SYNONYM
};
enum { SYNONYMS = sizeof synonyms / sizeof synonyms[0] };

const char *carom_word_synonym(const char *word, int k) {
  if (word == NULL || k < 0)
    return NULL;
  for (int row = 0; row < SYNONYMS; row++)
    if (strcmp(synonyms[row].word, word) == 0 && k-- == 0)
      return synonyms[row].name;
  return NULL;
}

int carom_word_means(const char *text, const char *word) {
  if (text == NULL || word == NULL)
    return 0;
  if (has_same_letters(text, word))
    return 1;
  for (int k = 0; k < SYNONYMS; k++)
    if (has_same_letters(synonyms[k].word, word) && has_same_letters(text, synonyms[k].name))
      return 1;
  return 0;
}

/* How near a text is to a word: 3 is the word itself, 2 its letters, 1 a synonym, 0 another word.
 * "billiards" is a synonym of one word and the letters of another, which it means. */
static int nearness(const char *text, const char *word) {
  if (strcmp(text, word) == 0)
    return 3;
  if (has_same_letters(text, word))
    return 2;
  return carom_word_means(text, word);
}

int carom_word_value(carom_words kind, const char *text) {
  enum {
    VALUES_MOST = 64,    /* more than any enumeration has; events begin at 1 */
    FLAG_MOST = 1 << 16, /* above it, CHOICE has no power of 2 */
  };
  int found = -1, best = 0;
  if (text == NULL)
    return -1;
  for (int value = 0; value <= FLAG_MOST; value = value < VALUES_MOST ? value + 1 : 2 * value) {
    const char *word = carom_word(kind, value);
    const int rank = word == NULL ? 0 : nearness(text, word);
    if (rank > best) {
      best = rank;
      found = value;
    }
  }
  return found;
}
