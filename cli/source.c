/* Where collisions come from. */
#include "source.h"

#include "memory.h"
#include "message.h"
#include "npy.h"
#include "number.h"
#include "precision.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct row_source {
  const char *name;
  impact_reader *csv; /* NULL for an array */
  npy_array array;
  size_t next;
};

row_source *source_open(const char *path, bool mu_ball_needed) {
  row_source *s = allocate(1, sizeof *s);
  s->name = path;
  if (npy_is_name(path) ? npy_open(path, IMPACT_FIELDS, &s->array) : (s->csv = impact_open(path, mu_ball_needed)) != NULL)
    return s;
  free(s);
  return NULL;
}

bool source_is_single(const row_source *s) {
  return s->csv == NULL && s->array.single;
}

static read_result read_csv(row_source *s, source_block *block) {
  read_result result = READ_ONE;
  if (block->impact == NULL) {
    block->impact = allocate(CSV_BLOCK, sizeof(carom_impact));
    block->row = allocate(CSV_BLOCK, sizeof *block->row);
  }
  for (block->count = 0; block->count < CSV_BLOCK; block->count++) {
    result = impact_next(s->csv, &block->row[block->count], (carom_impact *)block->impact + block->count);
    if (result != READ_ONE)
      break;
  }
  return result;
}

static read_result read_array(row_source *s, source_block *block) {
  const size_t left = s->array.rows - s->next;
  if (block->impact == NULL)
    block->impact = allocate(NPY_BLOCK, s->array.row_size);
  block->count = left < NPY_BLOCK ? left : NPY_BLOCK;
  return npy_read(&s->array, block->count, block->impact) ? READ_ONE : READ_FAILED;
}

read_result source_read(row_source *s, source_block *block) {
  block->first = s->next;
  read_result result = s->csv != NULL ? read_csv(s, block) : read_array(s, block);
  s->next += block->count;
  if (result == READ_ONE && block->count == 0)
    return READ_END;
  return result == READ_END && block->count > 0 ? READ_ONE : result;
}

void source_free_block(source_block *block) {
  for (size_t k = 0; block->row != NULL && k < CSV_BLOCK; k++)
    free(block->row[k].id);
  free(block->row);
  free(block->impact);
  *block = (source_block){0};
}

carom_impact source_impact(const row_source *s, const source_block *block, size_t k) {
  carom_impact impact;
  if (source_is_single(s))
    to_double((const carom_impact_f32 *)block->impact + k, &impact, IMPACT_FIELDS);
  else
    impact = ((const carom_impact *)block->impact)[k];
  return impact;
}

void source_report(const row_source *s, const source_block *block, size_t k, const carom_options *options, carom_status status,
                   const char *doubt) {
  const impact_row *row = block->row != NULL ? &block->row[k] : NULL;
  const carom_impact impact = source_impact(s, block, k);
  int field;
  char where[256], what[64] = "", id[ID_TEXT], text[NUMBER_TEXT] = "";
  carom_check(&impact, options, &field);
  if (field >= 0)
    number_text(((const double *)&impact)[field], text);
  if (row != NULL)
    snprintf(where, sizeof where, "%s:%lld: id '%s'", record_file_name(impact_records(s->csv)), row->line,
             id_text(row->id, id));
  else
    snprintf(where, sizeof where, "%s: row %zu", s->name, block->first + k);
  if (row != NULL && field >= 0)
    snprintf(what, sizeof what, "%s = %s: ", impact_column(s->csv, field), text);
  else if (field >= 0)
    snprintf(what, sizeof what, "%s (number %d) = %s: ", carom_field_name(field), field, text);
  if (row != NULL && row->error != NULL)
    complain("%s: %s (%s)", where, row->message, row->error);
  else if (doubt != NULL)
    complain("%s: refused by --strict (%s)", where, doubt);
  else
    complain("%s: %s%s (%s)", where, what, carom_status_string(status), carom_status_name(status));
}

const char *source_name(const row_source *s) {
  return s->csv != NULL ? record_file_name(impact_records(s->csv)) : s->name;
}

double source_share(const row_source *s) {
  return s->csv != NULL ? record_share(impact_records(s->csv)) : (double)s->next / (double)s->array.rows;
}

void source_close(row_source *s) {
  if (s == NULL)
    return;
  impact_close(s->csv);
  npy_close(&s->array);
  free(s);
}
