/* Collisions from the columns of a CSV file. */
#include "impacts.h"

#include "message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Which numbers of a carom_impact a column fills; `field[1]` is -1 where there is only one. Ball b follows 12 after ball a. */
typedef struct column {
  const char *name;
  int field[2];
  int group; /* columns of equal group > 0 are two ways to say the same: the shared one, or one for each ball */
} column;

#define MOTION(ball, at, name)                                        \
  {name #ball "x", {at, -1}, 0}, {name #ball "y", {at + 1, -1}, 0}, { \
    name #ball "z", {at + 2, -1}, 0                                   \
  }

static const column columns[] = {
    MOTION(1, 0, "r"),     MOTION(1, 3, "v"),     MOTION(1, 6, "w"),    MOTION(2, 12, "r"),
    MOTION(2, 15, "v"),    MOTION(2, 18, "w"),    {"R", {9, 21}, 1},    {"R1", {9, -1}, 1},
    {"R2", {21, -1}, 1},   {"M", {10, 22}, 2},    {"M1", {10, -1}, 2},  {"M2", {22, -1}, 2},
    {"u_s1", {11, -1}, 0}, {"u_s2", {23, -1}, 0}, {"u_b", {24, -1}, 0}, {"e_b", {25, -1}, 0},
};
enum { COLUMNS = sizeof columns / sizeof columns[0], MU_BALL = 24 };

struct impact_reader {
  record_reader *records;
  size_t width;              /* fields of the header */
  size_t id_at;              /* index of the column id, or SIZE_MAX */
  size_t at[IMPACT_FIELDS];  /* index of the column that fills each number */
  int source[IMPACT_FIELDS]; /* and its place in `columns` */
  long long rows;
};

static bool find_once(const record *header, const char *file, const char *name, size_t *at) {
  *at = SIZE_MAX;
  for (size_t k = 0; k < header->count; k++) {
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

/* The place in `columns` that fills a number: -1 if no column does, -2 after a complaint. */
static int column_for(const impact_reader *r, const record *header, int field, size_t *at) {
  int found = -1;
  for (int c = 0; c < COLUMNS; c++) {
    if (columns[c].field[0] != field && columns[c].field[1] != field)
      continue;
    size_t here;
    if (!find_once(header, record_file_name(r->records), columns[c].name, &here))
      return -2;
    if (here == SIZE_MAX)
      continue;
    if (found >= 0) {
      complain("%s:%lld: columns '%s' and '%s' say the same; give one of them", record_file_name(r->records), header->line,
               columns[found].name, columns[c].name);
      return -2;
    }
    found = c;
    *at = here;
  }
  return found;
}

/* The name under which a missing number should have been given: the first of `columns` that fills it, or the column for its
 * ball alone where the other ball has one. */
static const char *wanted_name(const record *header, int field) {
  const column *first = NULL, *alone = NULL;
  bool other_ball_has_one = false;
  for (int c = 0; c < COLUMNS; c++)
    if (columns[c].field[0] == field || columns[c].field[1] == field)
      *(first == NULL ? &first : &alone) = &columns[c];
  for (int c = 0; c < COLUMNS && alone != NULL; c++)
    for (size_t k = 0; k < header->count; k++)
      other_ball_has_one |= columns[c].group == alone->group && strcmp(header->field[k], columns[c].name) == 0;
  return (other_ball_has_one ? alone : first)->name;
}

/* Adds a name to a list that ends with a blank, unless it is there: R and M fill a number of each ball. */
static void add_name(char *list, size_t room, const char *name) {
  const size_t used = strlen(list);
  char entry[16];
  snprintf(entry, sizeof entry, " %s ", name);
  if (strstr(list, entry) == NULL)
    snprintf(list + used, room - used, "%s", entry + (used > 0));
}

static bool find_columns(impact_reader *r, const record *header, bool mu_ball_needed) {
  const char *file = record_file_name(r->records);
  char missing[256] = "";
  r->width = header->count;
  if (!find_once(header, file, "id", &r->id_at))
    return false;
  for (int field = 0; field < IMPACT_FIELDS; field++) {
    r->source[field] = column_for(r, header, field, &r->at[field]);
    if (r->source[field] == -2)
      return false;
    if (r->source[field] == -1 && (field != MU_BALL || mu_ball_needed))
      add_name(missing, sizeof missing, wanted_name(header, field));
  }
  if (missing[0] != '\0')
    complain("%s:%lld: missing columns:%s(%s; `carom resolve --help` lists them)", file, header->line, missing,
             header->count > 1 ? "names are case-sensitive" : "the header is a single field, without commas");
  return missing[0] == '\0';
}

impact_reader *impact_open(const char *path, bool mu_ball_needed) {
  impact_reader *r = calloc(1, sizeof *r);
  if (r == NULL) {
    complain("out of memory");
    return NULL;
  }
  r->records = record_open(path);
  record header;
  if (r->records != NULL) {
    const read_result result = record_next(r->records, &header);
    if (result == READ_END)
      complain("%s: empty; a header with the names of the columns is needed", record_file_name(r->records));
    else if (result == READ_ONE && header.malformed)
      complain("%s:%lld: no header: the first row is longer than a mebibyte", record_file_name(r->records), header.line);
    else if (result == READ_ONE && find_columns(r, &header, mu_ball_needed))
      return r;
  }
  impact_close(r);
  return NULL;
}

static void set_id(impact_reader *r, const record *in, impact_row *row) {
  char number[24];
  snprintf(number, sizeof number, "%lld", r->rows);
  const char *id = !in->malformed && r->id_at < in->count ? in->field[r->id_at] : number;
  const size_t size = strlen(id) + 1;
  if (size > row->id_room) {
    row->id_room = size < 32 ? 32 : 2 * size;
    row->id = realloc(row->id, row->id_room);
    if (row->id == NULL) {
      complain("out of memory");
      exit(2);
    }
  }
  memcpy(row->id, id, size);
}

static const char *fill(impact_reader *r, const record *in, impact_row *row) {
  if (in->malformed) {
    snprintf(row->message, sizeof row->message, "the row is longer than a mebibyte; is a quote left open?");
    return "malformed_row";
  }
  for (size_t k = r->width; k < in->count; k++)
    if (in->field[k][0] != '\0') {
      snprintf(row->message, sizeof row->message, "%zu fields, but the header has %zu", in->count, r->width);
      return "too_many_fields";
    }
  double *number = (double *)&row->impact;
  for (int field = 0; field < IMPACT_FIELDS; field++) {
    if (r->source[field] < 0) { /* only u_b, where it is not needed */
      number[field] = 0.0;
      continue;
    }
    const char *name = columns[r->source[field]].name;
    if (r->at[field] >= in->count || in->field[r->at[field]][0] == '\0') {
      snprintf(row->message, sizeof row->message, "%s is missing", name);
      return "missing_value";
    }
    const char *text = in->field[r->at[field]];
    if (!parse_number(text, &number[field])) {
      snprintf(row->message, sizeof row->message, "%s = '%.60s' is not a number", name, text);
      return "not_a_number";
    }
  }
  return NULL;
}

read_result impact_next(impact_reader *r, impact_row *row) {
  record in;
  const read_result result = record_next(r->records, &in);
  if (result != READ_ONE)
    return result;
  r->rows++;
  row->line = in.line;
  set_id(r, &in, row);
  row->message[0] = '\0';
  row->error = fill(r, &in, row);
  return READ_ONE;
}

const char *impact_column(const impact_reader *r, int field) {
  return r->source[field] >= 0 ? columns[r->source[field]].name : "u_b";
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
