/* hostile.h: the match of hostile.txt, and its rows as lines. */
#ifndef CAROM_TEST_HOSTILE_H
#define CAROM_TEST_HOSTILE_H

#include <carom_match.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { HOSTILE_MOST = 1 << 18 }; /* bytes of a row, and of its line. */

typedef struct hostile_row {
  char name[100];
  int seat;                /* that sends the line. */
  size_t size;             /* bytes of the line, without its end. */
  char line[HOSTILE_MOST]; /* the line. */
} hostile_row;

/* How many bytes the first line of a text has, without its end. */
static inline size_t hostile_size(const char *text) {
  return strcspn(text, "\n");
}

/* The last line of a text. */
static inline const char *hostile_last(const char *text, size_t size) {
  const char *last = text + size - 1;
  while (last > text && last[-1] != '\n')
    last--;
  return last;
}

/* Begins the match of hostile.txt: `begun` has its first lines, `placed` also the place of the cue
 * ball, and `act` the honest act. */
static inline carom_status hostile_begin(carom_match *begun, carom_match *placed,
                                         carom_match *act) {
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_status status = carom_match_begin(begun, CAROM_RULES_NINEBALL, &table, 5, 0);
  if (status != CAROM_OK)
    return status;
  *placed = *begun;
  status = carom_match_place(placed, 0, 0.6, 0.5);
  if (status != CAROM_OK)
    return status;
  *act = *placed;
  carom_cue cue = act->cue;
  cue.speed = 7.0;
  cue.phi = 120.0;
  return carom_match_stroke(act, 0, &cue, NULL, NULL);
}

/* The line with the first `old` replaced by `new`. */
static inline bool hostile_replace(hostile_row *row, const char *old, const char *new) {
  static char changed[HOSTILE_MOST];
  const char *found = strstr(row->line, old);
  if (found == NULL)
    return false;
  row->size = (size_t)snprintf(changed, sizeof changed, "%.*s%s%s", (int)(found - row->line),
                               row->line, new, found + strlen(old));
  memcpy(row->line, changed, row->size + 1);
  return true;
}

/* The line of an act that a seat makes in its own match; false: the text names no such act. */
static inline bool hostile_act(hostile_row *row, const char *text, const carom_match *placed) {
  static carom_match made;
  int seat;
  made = *placed;
  carom_status status = CAROM_ERROR_ACT;
  if (sscanf(text, "CONCEDE %d", &seat) == 1)
    status = carom_match_concede(&made, seat);
  else if (sscanf(text, "CLOCK %d", &seat) == 1)
    status = carom_match_clock(&made, seat);
  else if (sscanf(text, "PLACE %d", &seat) == 1)
    status = carom_match_place(&made, seat, 0.7, 0.4);
  if (status != CAROM_OK)
    return false;
  row->size = hostile_size(made.text);
  memcpy(row->line, made.text, row->size);
  return true;
}

/* Reads a row of hostile.txt. False: it is not as the head of that file says. */
static inline bool hostile_read(const char *text, const carom_match *placed, const carom_match *act,
                                hostile_row *row) {
  int number, seat;
  char old[200], new[200], form[1000] = "";
  if (sscanf(text, "%99[^|]| %d | %999[^\n]", row->name, &seat, form) < 2)
    return false;
  row->name[strlen(row->name) - 1] = '\0'; /* the blank before the bar */
  row->seat = seat;
  row->size = hostile_size(act->text);
  memcpy(row->line, act->text, row->size);
  row->line[row->size] = '\0';
  if (strcmp(form, "STROKE") == 0)
    return true;
  if (sscanf(form, "STROKE s/%199[^/]/%199[^/]/", old, new) == 2)
    return hostile_replace(row, old, new);
  if (sscanf(form, "STROKE cut %d", &number) == 1) {
    row->size = (size_t)number;
    return true;
  }
  if (strcmp(form, "GAME") == 0) {
    const char *last = hostile_last(act->text, (size_t)act->size);
    row->size = hostile_size(last);
    memcpy(row->line, last, row->size);
    return true;
  }
  if (sscanf(form, "spaces %d", &number) == 1 || sscanf(form, "brackets %d", &number) == 1) {
    const int byte = form[0] == 's' ? ' ' : '[';
    row->size = (size_t)number;
    memset(row->line, byte, row->size);
    return true;
  }
  if (hostile_act(row, form, placed))
    return true;
  row->size = strlen(form);
  memcpy(row->line, form, row->size);
  return true;
}

/* Whether the line of a row may be received without a refusal: it is blank, or an event. */
static inline bool hostile_is_empty(const hostile_row *row) {
  static const char event[] = "{\"event\"";
  size_t blanks = 0;
  while (blanks < row->size && row->line[blanks] == ' ')
    blanks++;
  return blanks == row->size ||
         (row->size > sizeof event && memcmp(row->line, event, sizeof event - 1) == 0);
}

#endif
