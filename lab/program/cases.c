/* The reference collisions in data/. */
#include "cases.h"

#include "memory.h"
#include "message.h"
#include "number.h"
#include "source.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool cases_load(const char *folder, const char *name, case_set *out) {
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  *out = (case_set){0};
  const shared_options plain = {0};
  row_source *source = source_open(path, &plain);
  if (source == NULL)
    return false;
  size_t ids_room = 0, impacts_room = 0;
  source_block block = {0};
  read_result result;
  while ((result = source_read(source, &block)) == READ_ONE) {
    out->id = grow(out->id, &ids_room, out->count + block.count, sizeof *out->id);
    out->impact = grow(out->impact, &impacts_room, out->count + block.count, sizeof *out->impact);
    size_t k = 0;
    for (; k < block.count && block.note[k].error == NULL; k++, out->count++) {
      out->id[out->count] = copy_text(block.note[k].id);
      source_row(source, &block, k, (double *)&out->impact[out->count]);
    }
    if (k < block.count) {
      complain("%s:%lld: %s", path, block.note[k].line, block.note[k].message);
      result = READ_FAILED;
      break;
    }
  }
  source_free_block(&block);
  source_close(source);
  if (result == READ_END && out->count == 0)
    complain("%s: no cases", path);
  return result == READ_END && out->count > 0;
}

bool read_columns(record_reader *reader, record_columns *out) {
  record header;
  if (record_next(reader, &header) != READ_ONE)
    return false;
  size_t room = 0;
  for (; out->count < header.count; out->count++) {
    out->name = grow(out->name, &room, out->count + 1, sizeof *out->name);
    out->name[out->count] = allocate(strlen(header.field[out->count]) + 1, 1);
    strcpy(out->name[out->count], header.field[out->count]);
  }
  return true;
}

size_t column_named(const record_columns *columns, const char *name) {
  for (size_t k = 0; k < columns->count; k++)
    if (strcmp(columns->name[k], name) == 0)
      return k;
  return SIZE_MAX;
}

void free_columns(record_columns *columns) {
  for (size_t k = 0; k < columns->count; k++)
    free(columns->name[k]);
  free(columns->name);
}

enum { RESULT_NUMBERS = sizeof(carom_result) / sizeof(double) };

typedef struct reference_layout {
  size_t id, number[RESULT_NUMBERS], steps;
} reference_layout;

static bool find_layout(const record_columns *columns, reference_layout *layout) {
  char names[] = RESULT_COLUMNS, *rest = names;
  layout->id = column_named(columns, "id");
  layout->steps = column_named(columns, "steps");
  bool complete = layout->id != SIZE_MAX;
  for (int k = 0; k < RESULT_NUMBERS; k++) {
    layout->number[k] = column_named(columns, strtok_r(rest, ",", &rest));
    complete &= layout->number[k] != SIZE_MAX;
  }
  return complete;
}

static bool number_at(const record *in, size_t at, double *number) {
  return at < in->count && parse_number(in->field[at], number);
}

static bool read_result_row(const record *in, const reference_layout *layout, const char *id, carom_result *result,
                            int64_t *steps) {
  double count = 0.0;
  bool good = !in->malformed && layout->id < in->count && strcmp(in->field[layout->id], id) == 0;
  for (int k = 0; k < RESULT_NUMBERS && good; k++)
    good = number_at(in, layout->number[k], (double *)result + k);
  if (good && steps != NULL) {
    good = number_at(in, layout->steps, &count);
    *steps = (int64_t)count;
  }
  return good;
}

static bool read_references(record_reader *reader, const case_set *cases, reference_set *out) {
  const char *file = record_file_name(reader);
  record_columns columns = {0};
  reference_layout layout = {0};
  record in;
  const bool complete = read_columns(reader, &columns) && find_layout(&columns, &layout);
  free_columns(&columns);
  if (!complete) {
    complain("%s: needs the columns id, v1x ... w2z", file);
    return false;
  }
  out->result = allocate(cases->count, sizeof *out->result);
  out->steps = layout.steps != SIZE_MAX ? allocate(cases->count, sizeof *out->steps) : NULL;
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
