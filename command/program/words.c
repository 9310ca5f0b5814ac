/* Lists of words. */
#include "program/words.h"

#include "carom_shot.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_WORD = 24 };

/* What players ask for by a word that is no value, and what to try instead. */
static const struct {
  const char *word, *advice;
} advices[] = {{"kitchen", "head-spot, which is on its line; `carom plan --in-hand --opening`"},
               {"lag", "`carom shoot --cue 1d,2d --to 1d,8d --stop 1d,0.2d`"},
               {"straight", "`carom plan --rules straight --balls straight --opening`"}};

const char *name_of_file(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash != NULL && slash[1] != '\0' ? slash + 1 : path;
}

bool same_word(const char *text, size_t size, const char *word, size_t length) {
  char text_copy[LONGEST_WORD + 1], word_copy[LONGEST_WORD + 1];
  if (size > LONGEST_WORD || length > LONGEST_WORD)
    return false;
  snprintf(text_copy, sizeof text_copy, "%.*s", (int)size, text);
  snprintf(word_copy, sizeof word_copy, "%.*s", (int)length, word);
  return carom_word_means(text_copy, word_copy) != 0;
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

static const char *advice_for(const char *text) {
  for (size_t k = 0; k < COUNT_OF(advices); k++)
    if (same_word(text, strlen(text), advices[k].word, strlen(advices[k].word)))
      return advices[k].advice;
  return NULL;
}

/* The only word that begins with a text of one character, such as 9ft for 9. */
static const char *only_beginning(const char *text, const char *words) {
  const char *found = NULL;
  for (size_t length; *words != '\0'; words += length + (words[length] != '\0')) {
    length = strcspn(words, " |");
    if (words[0] != text[0])
      continue;
    if (found != NULL)
      return NULL;
    found = words;
  }
  return found;
}

/* How many letters of a text are wrong for a word, or for its nearest synonym. */
static int misspelt_anyhow(const char *text, const char *word, int length) {
  char copy[LONGEST_WORD + 1];
  const char *synonym;
  const int size = (int)strlen(text);
  int least = misspelt(text, size, word, length);
  snprintf(copy, sizeof copy, "%.*s", length < LONGEST_WORD ? length : LONGEST_WORD, word);
  for (int k = 0; (synonym = carom_word_synonym(copy, k)) != NULL; k++)
    least = lesser(least, misspelt(text, size, synonym, (int)strlen(synonym)));
  return least;
}

/* The word that a text nearly is; NULL: none is. */
static const char *nearest_word(const char *text, const char *words) {
  const int size = (int)strlen(text);
  int least = (size + 4) / 3; /* a third of the letters may be wrong, and one of few */
  const char *nearest = NULL;
  if (place_among(words, text, strlen(text)) >= 0) /* it is something else that is wrong */
    return NULL;
  if (size == 1)
    return only_beginning(text, words);
  for (int length; *words != '\0'; words += length + (words[length] != '\0')) {
    length = (int)strcspn(words, " |");
    const int wrong = length > 0 ? misspelt_anyhow(text, words, length) : least;
    if (wrong < least) {
      least = wrong;
      nearest = words;
    }
  }
  return nearest;
}

const char *did_you_mean(const char *text, const char *words, char hint[HINT_TEXT]) {
  const char *advice = advice_for(text), *nearest = nearest_word(text, words);
  hint[0] = '\0';
  if (advice != NULL)
    snprintf(hint, HINT_TEXT, "; try %s", advice);
  else if (nearest != NULL)
    snprintf(hint, HINT_TEXT, "; did you mean '%.*s'?", (int)strcspn(nearest, " |"), nearest);
  return hint;
}

bool is_nearly(const char *text, const char *words) {
  return advice_for(text) != NULL || nearest_word(text, words) != NULL;
}

const char *words_to_try(const char *text, const char *words, char list[HINT_TEXT]) {
  enum { SHORT_LIST = 48, FIRST_WORDS = 2 }; /* a longer list is cut after its first words */
  const char *advice = advice_for(text), *nearest = nearest_word(text, words);
  list[0] = '\0';
  if (advice != NULL) {
    snprintf(list, HINT_TEXT, "%s", advice);
    return list;
  }
  if (nearest != NULL) {
    snprintf(list, HINT_TEXT, "%.*s", (int)strcspn(nearest, " |"), nearest);
    return list;
  }
  const bool is_short = strlen(words) <= SHORT_LIST;
  int count = 0;
  for (const char *word = words; *word != '\0' && (is_short || count < FIRST_WORDS); count++) {
    const size_t length = strcspn(word, " |");
    const bool ends = word[length] == '\0' || word[length + 1] == '\0';
    const bool last = ends || (!is_short && count + 1 == FIRST_WORDS);
    append(list, HINT_TEXT, last ? " or " : ", ", "%.*s", (int)length, word);
    word += length + (word[length] != '\0');
  }
  return list;
}
