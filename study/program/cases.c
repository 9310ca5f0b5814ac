/* The reference collisions in data/. */
#include "cases.h"

#include "program/program.h"
#include "rows/number.h"
#include "rows/source.h"

#include <limits.h>
#include <stdint.h>

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
      memcpy(&out->impact[out->count], source_row(source, &block, k), sizeof *out->impact);
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

bool numbers_of(const record *row, size_t n, double number[]) {
  bool good = !row->malformed && row->count > n;
  for (size_t k = 0; good && k < n; k++)
    good = parse_number(row->field[k + 1], &number[k]);
  return good;
}

enum { RESULT_NUMBERS = sizeof(carom_result) / sizeof(double) };

/* The results and, where there is one more column, the step counts. */
static bool read_references(record_reader *reader, const case_set *cases, reference_set *out) {
  const char *file = record_file_name(reader);
  record header;
  const bool steps = record_next(reader, &header) == READ_ONE && header.count == RESULT_NUMBERS + 2;
  out->result = allocate(cases->count, sizeof *out->result);
  out->steps = steps ? allocate(cases->count, sizeof *out->steps) : NULL;
  for (; out->count < cases->count; out->count++) {
    const size_t k = out->count;
    record row;
    double number[RESULT_NUMBERS + 1];
    if (record_next(reader, &row) != READ_ONE ||
        !numbers_of(&row, RESULT_NUMBERS + steps, number) ||
        !same_text(row.field[0], cases->id[k])) {
      complain("%s: row %zu should hold the result for '%s'", file, k + 1, cases->id[k]);
      return false;
    }
    memcpy(&out->result[k], number, sizeof out->result[k]);
    if (steps)
      out->steps[k] = (int64_t)number[RESULT_NUMBERS];
  }
  return true;
}

bool reference_load(const char *folder, const char *name, const case_set *cases,
                    reference_set *out) {
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
