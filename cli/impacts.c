/* Collisions from the columns of a CSV file. */
#include "impacts.h"

#include "memory.h"
#include "message.h"
#include "number.h"
#include "suggest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The columns that fill the numbers of a carom_impact, ball 1, ball 2 and the two of the pair. */
static const char *const own[IMPACT_FIELDS] = {"r1x", "r1y", "r1z",  "v1x", "v1y", "v1z",  "w1x", "w1y", "w1z",
                                               "R1",  "M1",  "u_s1", "r2x", "r2y", "r2z",  "v2x", "v2y", "v2z",
                                               "w2x", "w2y", "w2z",  "R2",  "M2",  "u_s2", "u_b", "e_b"};
enum { RADIUS = 9, MASS = 10, OF_A_BALL = 12, MU_BALL = 24 };

/* The column that fills a number of both balls, or NULL. */
static const char *both_of(int field) {
  const int place = field < MU_BALL ? field % OF_A_BALL : -1;
  return place == RADIUS ? "R" : place == MASS ? "M" : NULL;
}

struct impact_reader {
  record_reader *records;
  size_t width;                    /* fields of the header */
  size_t id_at;                    /* index of the column id, or SIZE_MAX */
  size_t at[IMPACT_FIELDS];        /* index of the column that fills each number, or SIZE_MAX, */
  const char *name[IMPACT_FIELDS]; /* and its name */
  long long rows;
};

unsigned impact_fields(const char *name) {
  unsigned fields = 0;
  for (int k = 0; k < IMPACT_FIELDS; k++)
    if (strcmp(own[k], name) == 0 || (both_of(k) != NULL && strcmp(both_of(k), name) == 0))
      fields |= 1u << k;
  return fields;
}

/* The index of the column, SIZE_MAX if there is none; false after a complaint if there are two. */
static bool find_once(const record *header, const char *file, const char *name, size_t *at) {
  *at = SIZE_MAX;
  for (size_t k = 0; k < header->count && name != NULL; k++) {
    if (strcmp(header->field[k], name) != 0)
      continue;
    if (*at != SIZE_MAX) {
      complain("%s:%lld: column '%s' appears twice; which one is meant?", file, header->line, name);
      return false;
    }
    *at = k;
  }
  return true;
}

/* Finds the column of a number; false after a complaint if it has two. */
static bool find_column(impact_reader *r, const record *header, int field) {
  const char *file = record_file_name(r->records), *both = both_of(field);
  const char *others = both == NULL ? NULL : own[(field + OF_A_BALL) % (2 * OF_A_BALL)];
  size_t at_own, at_both, at_others;
  if (!find_once(header, file, own[field], &at_own) || !find_once(header, file, both, &at_both) ||
      !find_once(header, file, others, &at_others))
    return false;
  if (at_own != SIZE_MAX && at_both != SIZE_MAX) {
    complain("%s:%lld: columns '%s' and '%s' say the same; give one of them", file, header->line, both, own[field]);
    return false;
  }
  r->at[field] = at_own != SIZE_MAX ? at_own : at_both;
  /* What is missing should have been for both balls, unless the other one has a column of its own. */
  const bool alone = both == NULL || at_own != SIZE_MAX || (at_both == SIZE_MAX && at_others != SIZE_MAX);
  r->name[field] = alone ? own[field] : both;
  return true;
}

/* A column that may have been meant by a missing one, or NULL. */
static const char *meant_by(const record *header, const char *missing) {
  for (size_t k = 0; k < header->count; k++)
    if (impact_fields(header->field[k]) == 0 && strcmp(header->field[k], "id") != 0 && resembles(header->field[k], missing))
      return header->field[k];
  return NULL;
}

static bool find_columns(impact_reader *r, const record *header, bool mu_ball_needed) {
  const char *file = record_file_name(r->records);
  char missing[256] = " ", meant[160] = "";
  if (record_is_numbers(header)) {
    complain("%s:%lld: no header: the first row holds numbers; the names of the columns come first (`%s resolve --help` lists "
             "them)",
             file, header->line, program_name);
    return false;
  }
  r->width = header->count;
  if (!find_once(header, file, "id", &r->id_at))
    return false;
  for (int field = 0; field < IMPACT_FIELDS; field++) {
    if (!find_column(r, header, field))
      return false;
    const bool named = field >= OF_A_BALL && strcmp(r->name[field], r->name[field - OF_A_BALL]) == 0; /* R, M */
    if (r->at[field] == SIZE_MAX && (field != MU_BALL || mu_ball_needed) && !named) {
      const char *other = meant_by(header, r->name[field]);
      if (other != NULL && meant[0] == '\0')
        snprintf(meant, sizeof meant, "is '%.60s' meant to be %s? ", other, r->name[field]);
      strcat(strcat(missing, r->name[field]), " ");
    }
  }
  size_t rail;
  if (missing[1] != '\0' && find_once(header, file, "mu_w", &rail) && rail != SIZE_MAX)
    snprintf(meant, sizeof meant, "with --cushion impacts on a cushion are read; ");
  if (missing[1] != '\0')
    complain("%s:%lld: missing columns:%s(%s%s; `%s resolve --help` lists them)", file, header->line, missing, meant,
             header->count > 1 ? "names are case-sensitive" : "the header is a single field, without commas", program_name);
  return missing[1] == '\0';
}

impact_reader *impact_open(const char *path, bool mu_ball_needed) {
  impact_reader *r = allocate(1, sizeof *r);
  record header;
  r->records = record_open(path);
  const read_result result = r->records != NULL ? record_next(r->records, &header) : READ_FAILED;
  if (result == READ_END)
    complain("%s: empty; a header with the names of the columns is needed", record_file_name(r->records));
  else if (result == READ_ONE && header.malformed)
    complain("%s:%lld: no header: the first row is longer than a mebibyte", record_file_name(r->records), header.line);
  else if (result == READ_ONE && find_columns(r, &header, mu_ball_needed))
    return r;
  impact_close(r);
  return NULL;
}

static void set_id(impact_reader *r, const record *in, impact_row *row) {
  char number[24];
  snprintf(number, sizeof number, "%lld", r->rows);
  const char *id = !in->malformed && r->id_at < in->count ? in->field[r->id_at] : number;
  row->id = grow(row->id, &row->id_room, strlen(id) + 1, 1);
  strcpy(row->id, id);
}

/* NULL, or the name of what is wrong. */
static const char *fill(const impact_reader *r, const record *in, impact_row *row, carom_impact *impact) {
  if (in->malformed) {
    snprintf(row->message, sizeof row->message, "the row is longer than a mebibyte; is a quote left open?");
    return "malformed_row";
  }
  for (size_t k = r->width; k < in->count; k++)
    if (in->field[k][0] != '\0') {
      snprintf(row->message, sizeof row->message, "%zu fields, but the header has %zu", in->count, r->width);
      return "too_many_fields";
    }
  double *number = (double *)impact;
  for (int field = 0; field < IMPACT_FIELDS; field++) {
    const char *name = r->name[field];
    if (r->at[field] == SIZE_MAX) /* only u_b, where it is not needed */
      continue;
    if (r->at[field] >= in->count || in->field[r->at[field]][0] == '\0') {
      snprintf(row->message, sizeof row->message, "%s is missing", name);
      return "missing_value";
    }
    const char *text = in->field[r->at[field]];
    if (!parse_number(text, &number[field])) {
      snprintf(row->message, sizeof row->message, "%s = '%.60s' is not a number%s", name, text,
               strchr(text, ',') != NULL ? "; decimals have a point, not a comma" : "");
      return "not_a_number";
    }
  }
  return NULL;
}

read_result impact_next(impact_reader *r, impact_row *row, carom_impact *impact) {
  record in;
  const read_result result = record_next(r->records, &in);
  if (result != READ_ONE)
    return result;
  r->rows++;
  row->line = in.line;
  set_id(r, &in, row);
  *impact = (carom_impact){0};
  row->error = fill(r, &in, row, impact);
  if (row->error != NULL)
    *impact = (carom_impact){0};
  return READ_ONE;
}

const char *impact_column(const impact_reader *r, int field) {
  return r->name[field];
}

const record_reader *impact_records(const impact_reader *r) {
  return r->records;
}

void impact_close(impact_reader *r) {
  if (r == NULL)
    return;
  record_close(r->records);
  free(r);
}
