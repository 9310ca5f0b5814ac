/* Where collisions come from. */
#include "source.h"

#include "message.h"
#include "npy.h"

#include <ctype.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ID_SHOWN = 64 };

struct row_source {
  const char *name;
  impact_reader *csv; /* NULL for an array */
  npy_array array;
  size_t next;
  _Atomic double share; /* read by another thread than the reading one */
};

/* A block of CSV rows owns its memory; rows that could not be read have 0 for numbers. */
typedef struct csv_block {
  carom_impact impact[CSV_BLOCK];
  impact_row row[CSV_BLOCK];
} csv_block;

row_source *source_open(const char *path, bool mu_ball_needed) {
  row_source *s = calloc(1, sizeof *s);
  if (s == NULL) {
    complain("out of memory");
    return NULL;
  }
  s->name = path;
  bool good;
  if (npy_is_name(path))
    good = npy_open(path, IMPACT_FIELDS, &s->array);
  else
    good = (s->csv = impact_open(path, mu_ball_needed)) != NULL;
  if (!good) {
    free(s);
    return NULL;
  }
  return s;
}

bool source_is_single(const row_source *s) {
  return s->csv == NULL && s->array.single;
}

static read_result read_csv(row_source *s, source_block *block) {
  if (block->own == NULL)
    block->own = calloc(1, sizeof(csv_block));
  csv_block *own = block->own;
  if (own == NULL) {
    complain("out of memory");
    return READ_FAILED;
  }
  block->impact = own->impact;
  block->row = own->row;
  read_result result = READ_ONE;
  for (block->count = 0; block->count < CSV_BLOCK; block->count++) {
    impact_row *row = &own->row[block->count];
    result = impact_next(s->csv, row);
    if (result != READ_ONE)
      break;
    own->impact[block->count] = row->error == NULL ? row->impact : (carom_impact){0};
  }
  const double total = record_bytes_total(impact_records(s->csv));
  atomic_store(&s->share, total > 0.0 ? record_bytes_read(impact_records(s->csv)) / total : -1.0);
  return result;
}

static read_result read_array(row_source *s, source_block *block) {
  const size_t left = s->array.rows - s->next;
  const size_t size = s->array.single ? sizeof(carom_impact_f32) : sizeof(carom_impact);
  block->count = left < NPY_BLOCK ? left : NPY_BLOCK;
  block->impact = (const char *)s->array.data + s->next * size;
  atomic_store(&s->share, (double)(s->next + block->count) / (double)s->array.rows);
  return READ_ONE;
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
  csv_block *own = block->own;
  for (size_t k = 0; own != NULL && k < CSV_BLOCK; k++)
    free(own->row[k].id);
  free(own);
  *block = (source_block){0};
}

static double number_at(const row_source *s, const source_block *block, size_t k, int field) {
  const size_t at = k * IMPACT_FIELDS + (size_t)field;
  return source_is_single(s) ? ((const float *)block->impact)[at] : ((const double *)block->impact)[at];
}

/* An id as a message shows it: not without end, and nothing that a terminal would obey. */
static const char *shown(const char *id, char text[ID_SHOWN]) {
  snprintf(text, ID_SHOWN, "%s", id);
  if (strlen(id) >= ID_SHOWN)
    memcpy(text + ID_SHOWN - 4, "...", 3);
  for (char *at = text; *at != '\0'; at++)
    if (iscntrl((unsigned char)*at))
      *at = '?';
  return text;
}

static void report_csv(const row_source *s, const source_block *block, size_t k, int field, carom_status status) {
  const impact_row *row = &block->row[k];
  const char *file = record_file_name(impact_records(s->csv));
  char text[ID_SHOWN];
  const char *id = shown(row->id, text);
  if (row->error != NULL)
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, id, row->message, row->error);
  else if (field >= 0)
    complain("%s:%lld: id '%s': %s = %.17g: %s (%s)", file, row->line, id, impact_column(s->csv, field),
             number_at(s, block, k, field), carom_status_string(status), carom_status_name(status));
  else
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, id, carom_status_string(status), carom_status_name(status));
}

void source_report(const row_source *s, const source_block *block, size_t k, const carom_options *options,
                   carom_status status) {
  carom_impact impact;
  for (int field = 0; field < IMPACT_FIELDS; field++)
    ((double *)&impact)[field] = number_at(s, block, k, field);
  int field;
  carom_check(&impact, options, &field);
  if (s->csv != NULL)
    report_csv(s, block, k, field, status);
  else if (field >= 0)
    complain("%s: row %zu: %s (number %d) = %.17g: %s (%s)", s->name, block->first + k, carom_field_name(field), field,
             number_at(s, block, k, field), carom_status_string(status), carom_status_name(status));
  else
    complain("%s: row %zu: %s (%s)", s->name, block->first + k, carom_status_string(status), carom_status_name(status));
}

double source_share(const row_source *s) {
  return atomic_load(&s->share);
}

void source_close(row_source *s) {
  if (s == NULL)
    return;
  impact_close(s->csv);
  npy_close(&s->array);
  free(s);
}
