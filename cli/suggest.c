/* What may have been meant by a mistyped word: the distance of Damerau and Levenshtein, without regard to case. */
#include "suggest.h"

#include <ctype.h>
#include <string.h>

enum { LONGEST = 32 };

static int least(int a, int b) {
  return a < b ? a : b;
}

static bool same(char a, char b) {
  return tolower((unsigned char)a) == tolower((unsigned char)b);
}

bool resembles(const char *typed, const char *name) {
  const size_t m = strlen(typed), n = strlen(name);
  if (m >= LONGEST || n >= LONGEST)
    return false;
  /* at[i][j]: mistakes between the first i letters of one and the first j of the other */
  int at[LONGEST][LONGEST];
  for (size_t i = 0; i <= m; i++)
    for (size_t j = 0; j <= n; j++) {
      if (i == 0 || j == 0) {
        at[i][j] = (int)(i + j);
        continue;
      }
      at[i][j] = least(at[i - 1][j - 1] + !same(typed[i - 1], name[j - 1]), 1 + least(at[i - 1][j], at[i][j - 1]));
      if (i > 1 && j > 1 && same(typed[i - 1], name[j - 2]) && same(typed[i - 2], name[j - 1]))
        at[i][j] = least(at[i][j], at[i - 2][j - 2] + 1);
    }
  return at[m][n] <= (n > 5 ? 2 : 1);
}
