/* Lists of words. */
#include "program/words.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_WORD = 24 };

/* What players also say: each stands for the word where that is one of those that may be said. */
static const struct {
  const char *alias, *word;
} also[] = {{"8ball", "eightball"},
            {"9ball", "nineball"},
            {"10ball", "tenball"},
            {"4ball", "fourball"},
            {"3cushion", "threecushion"},
            {"carom", "threecushion"},
            {"billiards", "threecushion"},
            {"10ft", "threecushion"},
            {"12ft", "snooker"},
            {"pool", "9ft"},
            {"14.1", "straight"},
            {"straightpool", "straight"},
            {"bankpool", "bank"},
            {"1pocket", "onepocket"},
            {"englishpool", "blackball"},
            {"chineseeightball", "heyball"},
            {"chinese8ball", "heyball"},
            {"freepyramid", "pyramid"},
            {"russianpyramid", "pyramid"},
            {"center", "centre"},
            {"middle", "centre"},
            {"head", "head-spot"},
            {"foot", "foot-spot"},
            {"top-left", "foot-left"},
            {"top-right", "foot-right"},
            {"middle-left", "side-left"},
            {"middle-right", "side-right"},
            {"bottom-left", "head-left"},
            {"bottom-right", "head-right"},
            {"rolling", "roll"},
            {"topspin", "follow"},
            {"backspin", "draw"},
            {"screw", "draw"},
            {"stop", "stun"},
            {"gentle", "soft"},
            {"firm", "fast"},
            {"hard", "fast"},
            {"slow", "slow_cloth"},
            {"dirty", "slow_cloth"},
            {"medium", "medium_cloth"},
            {"fast", "fast_cloth"},
            {"old", "old_cushion"},
            {"new", "new_cushion"},
            {"humid", "humid_cushion"},
            {"check", "reverse"},
            {"top", "high"},
            {"follow", "high"},
            {"bottom", "low"},
            {"draw", "low"},
            {"screw", "low"},
            {"stun", "centre"}};

/* What players ask for by a word that is no value, and what says it. */
static const struct {
  const char *word, *advice;
} advices[] = {
    {"kitchen", "head-spot is on its line; `carom plan --in-hand --opening` chooses a place in it"},
    {"lag", "`carom shoot --cue 1d,2d --leave 1d,0.2d` finds it"},
    {"straight", "`carom plan --rules straight --balls straight --opening` plans its break"}};

/* The letters of a word in lower case, without hyphens, underscores and blanks. */
static size_t plain(const char *text, size_t size, char letters[LONGEST_WORD + 1]) {
  size_t n = 0;
  for (size_t k = 0; k < size; k++)
    if (strchr("-_ ", text[k]) == NULL && n < LONGEST_WORD)
      letters[n++] = (char)tolower((unsigned char)text[k]);
  letters[n] = '\0';
  return n;
}

/* Whether two words have the same letters, or the parts at a hyphen in the other order. */
static bool same_letters(const char *a, size_t size, const char *b, size_t length) {
  char letters_a[LONGEST_WORD + 1], letters_b[LONGEST_WORD + 1], turned[LONGEST_WORD + 1];
  const size_t n = plain(a, size, letters_a);
  if (n == 0 || n != plain(b, length, letters_b) || size > LONGEST_WORD || length > LONGEST_WORD)
    return false;
  if (same_text(letters_a, letters_b))
    return true;
  const char *hyphen = memchr(b, '-', length);
  if (hyphen == NULL)
    return false;
  const size_t first = (size_t)(hyphen - b);
  const size_t second = plain(hyphen, length - first, turned);
  plain(b, first, turned + second);
  return same_text(letters_a, turned);
}

bool same_word(const char *text, size_t size, const char *word, size_t length) {
  bool same = same_letters(text, size, word, length);
  for (size_t k = 0; k < COUNT_OF(also) && !same; k++)
    same = same_letters(also[k].word, strlen(also[k].word), word, length) &&
           same_letters(text, size, also[k].alias, strlen(also[k].alias));
  return same;
}

int word_among(const char *words, const char *text, size_t size) {
  const int exact = place_among(words, text, size);
  if (exact >= 0)
    return exact;
  for (int place = 0; *words != '\0'; place++) {
    const size_t length = strcspn(words, "|");
    if (same_word(text, size, words, length))
      return place;
    words += length + (words[length] != '\0');
  }
  return -1;
}

const char *text_if(bool condition, const char *text) {
  return condition ? text : "";
}

const char *text_or(const char *text, const char *fallback) {
  return text != NULL && text[0] != '\0' ? text : fallback;
}

void append(char *text, size_t room, const char *separator, const char *format, ...) {
  const size_t used = strlen(text), more = used > 0 ? strlen(separator) : 0;
  va_list arguments;
  if (used + more >= room)
    return;
  memcpy(text + used, separator, more);
  va_start(arguments, format);
  vsnprintf(text + used + more, room - used - more, format, arguments);
  va_end(arguments);
}

bool same_text(const char *a, const char *b) {
  return strcmp(a, b) == 0;
}

const char *left_or_right(double to_left) {
  return to_left > 0.0 ? "left" : "right";
}

const char *above_or_below(double above) {
  return above < 0.0 ? "below" : "above";
}

int place_among(const char *words, const char *text, size_t size) {
  for (int place = 0; *words != '\0'; place++) {
    const size_t length = strcspn(words, " |");
    if (length == size && memcmp(words, text, size) == 0)
      return place;
    words += length + (words[length] != '\0');
  }
  return -1;
}

static int lesser(int a, int b) {
  return a < b ? a : b;
}

/* How many letters are wrong, missing, too many, or swapped with the next, whatever their case.
 * A beginning lacks one. */
static int misspelt(const char *text, int n, const char *word, int m) {
  int cost[LONGEST_WORD + 1][LONGEST_WORD + 1], a[LONGEST_WORD + 1], b[LONGEST_WORD + 1];
  if (n > LONGEST_WORD || m > LONGEST_WORD)
    return LONGEST_WORD;
  for (int i = 0; i <= n; i++)
    for (int j = 0; j <= m; j++) {
      cost[i][j] = i + j;
      if (i == 0 || j == 0)
        continue;
      a[i] = tolower((unsigned char)text[i - 1]);
      b[j] = tolower((unsigned char)word[j - 1]);
      cost[i][j] =
          lesser(cost[i - 1][j - 1] + (a[i] != b[j]), 1 + lesser(cost[i - 1][j], cost[i][j - 1]));
      if (i > 1 && j > 1 && a[i] == b[j - 1] && a[i - 1] == b[j])
        cost[i][j] = lesser(cost[i][j], 1 + cost[i - 2][j - 2]);
    }
  if (n > 1 && n < m && cost[n][n] == 0)
    return 1;
  return cost[n][m];
}

const char *did_you_mean(const char *text, const char *words, char hint[HINT_TEXT]) {
  const int size = (int)strlen(text);
  int least = (size + 4) / 3; /* a third of the letters may be wrong, and one of few */
  hint[0] = '\0';
  for (size_t k = 0; k < COUNT_OF(advices); k++)
    if (same_word(text, strlen(text), advices[k].word, strlen(advices[k].word)))
      snprintf(hint, HINT_TEXT, "; %s", advices[k].advice);
  if (hint[0] != '\0')
    return hint;
  if (place_among(words, text, strlen(text)) >= 0) /* it is something else that is wrong */
    return hint;
  for (int length; *words != '\0'; words += length + (words[length] != '\0')) {
    length = (int)strcspn(words, " |");
    const int wrong = length > 0 ? misspelt(text, size, words, length) : least;
    if (wrong < least) {
      least = wrong;
      snprintf(hint, HINT_TEXT, "; did you mean '%.*s'?", length, words);
    }
  }
  return hint;
}
