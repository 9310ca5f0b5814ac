/* Ratings of players, and lists of numbers like them. */
#include "game/ratings.h"

#include "program/message.h"

#include "carom_coach.h"

#include <stdio.h>
#include <string.h>

/* Reads numbers with commas between them, each from `least` to `most`; returns how many, or 0 where
 * the text is anything else. */
static int read_numbers(const char *text, double least, double most, int room, double *number) {
  int count = 0, length = 0;
  if (strspn(text, "0123456789.,") != strlen(text))
    return 0;
  for (const char *start = text;; start += length + 1) {
    if (count == room || sscanf(start, "%lf%n", &number[count], &length) != 1)
      return 0;
    if (!(number[count] >= least && number[count] <= most))
      return 0;
    count++;
    if (start[length] != ',')
      return start[length] == '\0' ? count : 0;
  }
}

OPTION_SET(set_ratings) {
  if (read_numbers(text, 200.0, 850.0, CAROM_SEATS_MOST, field) >= 2)
    return true;
  return refuse_value(row, text, "not 2 to %d Fargo ratings, 200 to 850; try 600,500",
                      CAROM_SEATS_MOST);
}

OPTION_SET(set_lengths) {
  double *length = field;
  const int count = read_numbers(text, 1.0, CAROM_SERIES_MOST, 2, length);
  if (count == 1)
    length[1] = length[0];
  if (count > 0 && strchr(text, '.') == NULL)
    return true;
  return refuse_value(row, text, "not one or two whole numbers, 1 to %d; try 9 or 9,7",
                      CAROM_SERIES_MOST);
}
