/* The reference collisions in data/. */
#include "cases.h"

#include "impacts.h"
#include "message.h"
#include "records.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *cases_folder(const char *given) {
  static char installed[PATH_MAX + sizeof CAROM_INSTALLED_DATA + 8];
  if (given != NULL)
    return given;
  const char *variable = getenv("CAROM_DATA");
  if (variable != NULL && variable[0] != '\0')
    return variable;
  if (access(CAROM_SOURCE_DATA, R_OK) == 0)
    return CAROM_SOURCE_DATA;
  char program[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", program, sizeof program - 1);
  if (size <= 0)
    return CAROM_SOURCE_DATA;
  program[size] = '\0';
  char *slash = strrchr(program, '/');
  *(slash != NULL ? slash : program) = '\0';
  snprintf(installed, sizeof installed, "%s/../%s", program, CAROM_INSTALLED_DATA);
  return installed;
}

static void *one_more(void *block, size_t count, size_t size) {
  if ((count & (count - 1)) != 0) /* grown at powers of two */
    return block;
  void *larger = realloc(block, (count == 0 ? 1 : 2 * count) * size);
  if (larger == NULL) {
    complain("out of memory");
    exit(2);
  }
  return larger;
}

bool cases_load(const char *folder, const char *name, case_set *out) {
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  *out = (case_set){0};
  impact_reader *reader = impact_open(path, true);
  if (reader == NULL)
    return false;
  impact_row row = {0};
  read_result result;
  while ((result = impact_next(reader, &row)) == READ_ONE) {
    if (row.error != NULL) {
      complain("%s:%lld: %s", path, row.line, row.message);
      result = READ_FAILED;
      break;
    }
    out->id = one_more(out->id, out->count, sizeof *out->id);
    out->impact = one_more(out->impact, out->count, sizeof *out->impact);
    out->id[out->count] = strdup(row.id);
    if (out->id[out->count] == NULL) {
      complain("out of memory");
      exit(2);
    }
    out->impact[out->count++] = row.impact;
  }
  free(row.id);
  impact_close(reader);
  if (result == READ_END && out->count == 0)
    complain("%s: no cases", path);
  return result == READ_END && out->count > 0;
}

static const char *const result_columns[] = {"v1x", "v1y", "v1z", "w1x", "w1y", "w1z",
                                             "v2x", "v2y", "v2z", "w2x", "w2y", "w2z"};
enum { RESULT_COLUMNS = 12 };

typedef struct reference_layout {
  size_t id, number[RESULT_COLUMNS], steps;
} reference_layout;

static size_t column_at(const record *header, const char *name) {
  for (size_t k = 0; k < header->count; k++)
    if (strcmp(header->field[k], name) == 0)
      return k;
  return SIZE_MAX;
}

static bool find_layout(const record *header, reference_layout *layout) {
  layout->id = column_at(header, "id");
  layout->steps = column_at(header, "steps");
  bool complete = layout->id != SIZE_MAX;
  for (int k = 0; k < RESULT_COLUMNS; k++) {
    layout->number[k] = column_at(header, result_columns[k]);
    complete &= layout->number[k] != SIZE_MAX;
  }
  return complete;
}

static bool read_result_row(const record *in, const reference_layout *layout, const char *id, carom_result *result,
                            int64_t *steps) {
  double *number = (double *)result, count = 0.0;
  if (in->malformed || layout->id >= in->count || strcmp(in->field[layout->id], id) != 0)
    return false;
  for (int k = 0; k < RESULT_COLUMNS; k++)
    if (layout->number[k] >= in->count || !parse_number(in->field[layout->number[k]], &number[k]))
      return false;
  if (steps != NULL) {
    if (layout->steps >= in->count || !parse_number(in->field[layout->steps], &count))
      return false;
    *steps = (int64_t)count;
  }
  return true;
}

static bool read_references(record_reader *reader, const case_set *cases, reference_set *out) {
  const char *file = record_file_name(reader);
  record in;
  reference_layout layout;
  if (record_next(reader, &in) != READ_ONE || !find_layout(&in, &layout)) {
    complain("%s: needs the columns id, v1x ... w2z", file);
    return false;
  }
  out->result = calloc(cases->count, sizeof *out->result);
  out->steps = layout.steps != SIZE_MAX ? calloc(cases->count, sizeof *out->steps) : NULL;
  if (out->result == NULL || (layout.steps != SIZE_MAX && out->steps == NULL)) {
    complain("out of memory");
    return false;
  }
  for (; out->count < cases->count; out->count++) {
    const size_t k = out->count;
    if (record_next(reader, &in) != READ_ONE ||
        !read_result_row(&in, &layout, cases->id[k], &out->result[k], out->steps != NULL ? &out->steps[k] : NULL)) {
      complain("%s: row %zu should hold the result for '%s'", file, k + 1, cases->id[k]);
      return false;
    }
  }
  return true;
}

bool reference_load(const char *folder, const char *name, const case_set *cases, reference_set *out) {
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  *out = (reference_set){0};
  record_reader *reader = record_open(path);
  if (reader == NULL)
    return false;
  const bool good = read_references(reader, cases, out);
  record_close(reader);
  return good;
}

void cases_free(case_set *cases) {
  for (size_t k = 0; k < cases->count; k++)
    free(cases->id[k]);
  free(cases->id);
  free(cases->impact);
}

void reference_free(reference_set *reference) {
  free(reference->result);
  free(reference->steps);
}
