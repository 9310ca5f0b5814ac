/* The reference collisions of data/: see cases.h. The head of a file names its columns; `R` and `M`
 * are the radius and the mass of both balls. */
#include "cases.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RESULT_HEAD "id,v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z"

enum { LINE = 1024, ID = 32, CASES_MOST = 1000, COLUMNS_MOST = 32, RESULT_NUMBERS = 12 };

/* A column of numbers, and the member of carom_impact that it fills. */
typedef struct column {
  const char *name;
  size_t offset;
} column;

#define OF_VECTOR(ball, member, number)                               \
  {#member number "x", offsetof(carom_impact, ball.member[0])},       \
      {#member number "y", offsetof(carom_impact, ball.member[1])}, { \
#member number "z", offsetof(carom_impact, ball.member[2])        \
  }
#define OF_BALL(ball, number)                                                         \
  OF_VECTOR(ball, r, number), OF_VECTOR(ball, v, number), OF_VECTOR(ball, w, number), \
      {"R" number, offsetof(carom_impact, ball.radius)},                              \
      {"M" number, offsetof(carom_impact, ball.mass)}, {                              \
    "u_s" number, offsetof(carom_impact, ball.mu_slide)                               \
  }

static const column columns[] = {
    OF_BALL(a, "1"),
    OF_BALL(b, "2"),
    {"R", offsetof(carom_impact, a.radius)},
    {"M", offsetof(carom_impact, a.mass)},
    {"u_b", offsetof(carom_impact, mu_ball)},
    {"e_b", offsetof(carom_impact, restitution)},
};

/* The columns of a file that follow its id, in their order; NULL is a column that is skipped. */
typedef struct file_layout {
  int count;
  const column *column[COLUMNS_MOST];
} file_layout;

static FILE *open_rows(const char *folder, const char *name, char head[LINE]) {
  char path[LINE];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *const file = fopen(path, "r");
  if (file == NULL || fgets(head, LINE, file) == NULL) {
    fprintf(stderr, "%s cannot be read\n", path);
    if (file != NULL)
      fclose(file);
    return NULL;
  }
  head[strcspn(head, "\r\n")] = '\0';
  return file;
}

static bool read_layout(char *head, file_layout *out) {
  *out = (file_layout){0};
  const char *name = strtok(head, ",");
  if (name == NULL || strcmp(name, "id") != 0)
    return false;
  while ((name = strtok(NULL, ",")) != NULL) {
    const column *found = NULL;
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++)
      if (strcmp(columns[k].name, name) == 0)
        found = &columns[k];
    if ((found == NULL && strcmp(name, "source") != 0) || out->count == COLUMNS_MOST)
      return false;
    out->column[out->count++] = found;
  }
  return true;
}

static bool read_case(char *line, const file_layout *layout, char id[ID], carom_impact *impact) {
  *impact = (carom_impact){0};
  const char *field = strtok(line, ",\r\n");
  if (field == NULL || strlen(field) >= ID)
    return false;
  strcpy(id, field);
  for (int k = 0; k < layout->count; k++) {
    field = strtok(NULL, ",\r\n");
    if (field == NULL)
      return false;
    if (layout->column[k] == NULL)
      continue;
    char *end;
    const double number = strtod(field, &end);
    if (end == field || *end != '\0')
      return false;
    memcpy((char *)impact + layout->column[k]->offset, &number, sizeof number);
  }
  /* a file of equal balls has their radius and mass once */
  if (impact->b.radius == 0.0)
    impact->b.radius = impact->a.radius;
  if (impact->b.mass == 0.0)
    impact->b.mass = impact->a.mass;
  return strtok(NULL, ",\r\n") == NULL;
}

bool cases_load(const char *folder, const char *name, case_set *out) {
  *out = (case_set){0};
  char line[LINE];
  FILE *const file = open_rows(folder, name, line);
  if (file == NULL)
    return false;
  file_layout layout;
  out->id = calloc(CASES_MOST, sizeof *out->id);
  out->impact = calloc(CASES_MOST, sizeof *out->impact);
  bool good = read_layout(line, &layout) && out->id != NULL && out->impact != NULL;
  if (!good)
    fprintf(stderr, "%s: the head names a column that is unknown\n", name);
  while (good && fgets(line, sizeof line, file) != NULL) {
    good = out->count < CASES_MOST &&
           read_case(line, &layout, out->id[out->count], &out->impact[out->count]);
    if (good)
      out->count++;
    else
      fprintf(stderr, "%s: row %zu is not a case, or one too many\n", name, out->count + 1);
  }
  fclose(file);
  return good && out->count > 0;
}

/* The numbers of a row of references, after the id that it must have. */
static bool read_result(char *line, const char *id, int count, double number[]) {
  const char *field = strtok(line, ",\r\n");
  if (field == NULL || strcmp(field, id) != 0)
    return false;
  for (int k = 0; k < count; k++) {
    field = strtok(NULL, ",\r\n");
    if (field == NULL)
      return false;
    number[k] = strtod(field, NULL);
  }
  return strtok(NULL, ",\r\n") == NULL;
}

bool reference_load(const char *folder, const char *name, const case_set *cases,
                    reference_set *out) {
  *out = (reference_set){0};
  char line[LINE];
  FILE *const file = open_rows(folder, name, line);
  if (file == NULL)
    return false;
  const bool steps = strcmp(line, RESULT_HEAD ",steps") == 0;
  bool good = steps || strcmp(line, RESULT_HEAD) == 0;
  if (!good)
    fprintf(stderr, "%s: the head is not '%s', with or without ',steps'\n", name, RESULT_HEAD);
  out->result = calloc(cases->count, sizeof *out->result);
  out->steps = steps ? calloc(cases->count, sizeof *out->steps) : NULL;
  for (size_t row = 0; good && row < cases->count; row++) {
    double number[RESULT_NUMBERS + 1];
    good = fgets(line, sizeof line, file) != NULL &&
           read_result(line, cases->id[row], RESULT_NUMBERS + steps, number);
    if (!good) {
      fprintf(stderr, "%s: row %zu is not the result of '%s'\n", name, row + 1, cases->id[row]);
      break;
    }
    memcpy(&out->result[row], number, sizeof *out->result);
    if (steps)
      out->steps[row] = (int64_t)number[RESULT_NUMBERS];
    out->count++;
  }
  fclose(file);
  return good;
}

void cases_free(case_set *cases) {
  free(cases->id);
  free(cases->impact);
}

void reference_free(reference_set *reference) {
  free(reference->result);
  free(reference->steps);
}
