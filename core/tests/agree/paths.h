/* Words, numbers and paths, as rows of edges.txt and lists of directions have them. */
#ifndef CAROM_TESTS_AGREE_PATHS_H
#define CAROM_TESTS_AGREE_PATHS_H

#include "row_file.h"
#include "tangent_support.h"

/* The next word, which is valid until the next call; "" at the end. */
static inline const char *read_word(void) {
  static char word[64];
  cursor += strspn(cursor, " ");
  const int length = (int)strcspn(cursor, " ");
  snprintf(word, sizeof word, "%.*s", length, cursor);
  cursor += length;
  return word;
}

/* A sum of terms, in units of 1, of the radius of a ball, R, or of the reach, X. */
static inline double read_number(void) {
  double sum = 0.0;
  for (bool first = true; first || (*cursor != ' ' && *cursor != '\0'); first = false) {
    char *end;
    const double number = strtod(cursor, &end);
    if (end == cursor)
      reject("no number");
    cursor = end;
    double unit = 1.0;
    if (*cursor == 'R' || *cursor == 'X')
      unit = *cursor++ == 'R' ? 0.028575 : reach[0];
    sum += number * unit;
  }
  return sum;
}

/* The value of a word of the library. */
static inline int read_value(carom_words words) {
  const char *const word = read_word();
  for (int k = 0; k < 32; k++)
    if (carom_word(words, k) != NULL && strcmp(carom_word(words, k), word) == 0)
      return k;
  reject("no such word");
}

/* A number of a layout, and its direction; options have none. */
typedef struct path {
  const carom_number *row;
  char *place;
  direction by;
} path;

/* A path is cue.phi, options.space, 0.v[1] of ball 0, or all.radius. */
static inline path read_path(layout *l) {
  const char *const word = read_word(), *const name = word + strcspn(word, ".") + 1;
  const size_t length = strcspn(name, "[");
  const int ball = isdigit((unsigned char)*word) ? atoi(word) : -1;
  const int index = name[length] == '[' ? atoi(name + length + 1) : 0;
  carom_shot_ball *const first = &l->ball[ball < 0 ? 0 : ball];
  const struct {
    const char *owners;
    carom_part_kind part;
    direction_of of;
    void *address;
  } parts[] = {{"c", CAROM_PART_CUE, OF_CUE, &l->cue},
               {"o", CAROM_PART_OPTIONS, OF_OPTIONS, &l->options},
               {"a0123456789", CAROM_PART_BALL, OF_KIND, &first->kind},
               {"a0123456789", CAROM_PART_STATE, OF_STATE, &first->state}};
  for (size_t p = 0; p < COUNT_OF(parts); p++) {
    path found;
    for (int k = 0; (found.row = carom_number_of(parts[p].part, k)) != NULL; k++) {
      if (strchr(parts[p].owners, *word) == NULL || strlen(found.row->name) != length ||
          strncmp(found.row->name, name, length) != 0)
        continue;
      found.place = (char *)parts[p].address + found.row->offset + 8 * index;
      const int number = found.row->offset / 8 + index;
      found.by = (direction){parts[p].of, ball, number, 1.0};
      /* the rows of a state are in another order */
      for (int row = 0; row < NUMBERS && parts[p].of == OF_STATE; row++)
        found.by.row = number_at[row] == number ? row : found.by.row;
      return found;
    }
  }
  reject("no such path");
}

/* Gives a number of a layout the value that comes next. */
static inline void set_number(path to) {
  const char *const word = cursor + strspn(cursor, " ");
  const char behind = word[strspn(word, "0123456789.e+-RX")];
  const bool is_word = behind != ' ' && behind != '\0';
  const double value = is_word ? read_value((carom_words)to.row->words) : read_number();
  if (to.row->type == CAROM_TYPE_DOUBLE)
    *(double *)(void *)to.place = value;
  else if (to.row->type == CAROM_TYPE_INT32)
    *(int32_t *)(void *)to.place = (int32_t)value;
  else
    *(int64_t *)(void *)to.place = (int64_t)value;
}

/* Whether a path names a number of all balls. */
static inline bool is_of_all(const path *p) {
  const bool of_ball = p->by.of == OF_STATE || p->by.of == OF_KIND;
  return of_ball && p->by.ball < 0;
}

/* Sets numbers of a layout with its balls, as "cue.a 0.1 all.drag 0.0129". */
static inline void set_numbers(layout *l, const char *words) {
  for (cursor = words; *cursor != '\0';) {
    const path to = read_path(l);
    const char *const value = cursor;
    for (int i = 0; i < (is_of_all(&to) ? l->count : 1); i++) {
      path next = to;
      next.place += i * (int)sizeof *l->ball;
      cursor = value;
      set_number(next);
    }
  }
}

/* Directions and their units, as "cue.phi 57 0.r[0] 1". Returns how many. */
static inline int read_directions(const char *words, direction *by) {
  layout unused = {0};
  int count = 0;
  for (cursor = words; *cursor != '\0'; count++) {
    by[count] = read_path(&unused).by;
    by[count].unit = read_number();
  }
  return count;
}

#endif
