/* Lists of words. */
#include "program/words.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_WORD = 24 };

const char *text_if(bool given, const char *text) {
  return given ? text : "";
}

const char *text_or(const char *text, const char *other) {
  return text != NULL && text[0] != '\0' ? text : other;
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
