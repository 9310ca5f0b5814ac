/* Impacts of a ball on a cushion from the columns of a CSV file. */
#include "cushion_rows.h"

#include "memory.h"
#include "message.h"
#include "number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The columns in the order of the numbers of a carom_cushion_impact. */
static const char *const columns[CUSHION_FIELDS] = {"vx", "vy", "vz", "wx",   "wy",   "wz", "nx", "ny",
                                                    "h",  "R",  "M",  "mu_s", "mu_w", "e",  "rho"};
static const carom_cushion_impact defaults = {.normal = {0, 1}};

struct cushion_reader {
  record_reader *records;
  size_t id_at, at[CUSHION_FIELDS]; /* indices of columns, or SIZE_MAX */
  size_t width;
  long long rows;
};

#define ROW(row, name, member, argument, set, help) \
  const option_row row = {name, 0, argument, help, set, offsetof(cushion_job, member), 0}
ROW(option_model, "model", cushion.model, "mathavan|stronge|han|mirror|euler", set_choice,
    "how the impact is computed: the exact limit of Mathavan's model (default), Stronge's or\n"
    "Han's closed form, a mirror, or Mathavan's model in N steps");
ROW(option_convention, "convention", cushion.convention, "paper|pooltool", set_choice,
    "whose conventions hold where pooltool departs from the papers (default: paper)");
ROW(option_law, "law", cushion.law, "constant|han", set_choice,
    "restitution and friction of the cushion: the columns (default), or Han's fits by speed\nand angle");
ROW(option_least_step, "least-step", cushion.least_step, "P", set_number,
    "euler takes no smaller step, N s (default 0; pooltool: 0.001)");

const option_row option_cushion = {
    .name = "cushion",
    .set = set_flag,
    .help = "impacts of a ball on a cushion instead, which have their own columns and options:\nsee --cushion --help"};

carom_cushion_options cushion_options_of(const cushion_job *job) {
  return (carom_cushion_options){.model = (carom_cushion_model)job->cushion.model,
                                 .convention = (carom_cushion_convention)job->cushion.convention,
                                 .law = (carom_cushion_law)job->cushion.law,
                                 .steps = job->shared.options.steps,
                                 .threads = job->shared.options.threads,
                                 .least_step = job->cushion.least_step};
}

bool cushion_asked(int *argc, char **argv) {
  for (int k = 1; k < *argc; k++)
    if (strcmp(argv[k], "--cushion") == 0) {
      memmove(argv + k, argv + k + 1, (size_t)(*argc - k) * sizeof *argv); /* with the NULL behind them */
      --*argc;
      return true;
    }
  return false;
}

int cushion_field(const char *column) {
  for (int k = 0; k < CUSHION_FIELDS; k++)
    if (strcmp(columns[k], column) == 0)
      return k;
  return -1;
}

const char *cushion_column(int field) {
  return columns[field];
}

static bool find(const record *header, const char *file, const char *name, size_t *at) {
  *at = SIZE_MAX;
  for (size_t k = 0; k < header->count; k++)
    if (strcmp(header->field[k], name) == 0) {
      if (*at != SIZE_MAX) {
        complain("%s:%lld: column '%s' appears twice; which one is meant?", file, header->line, name);
        return false;
      }
      *at = k;
    }
  return true;
}

static bool find_columns(cushion_reader *r, const record *header) {
  const char *file = record_file_name(r->records);
  char missing[128] = " ";
  r->width = header->count;
  if (record_is_numbers(header)) {
    complain("%s:%lld: no header: the first row holds numbers; the names of the columns come first (`%s resolve --cushion "
             "--help` lists them)",
             file, header->line, program_name);
    return false;
  }
  if (!find(header, file, "id", &r->id_at))
    return false;
  for (int k = 0; k < CUSHION_FIELDS; k++) {
    if (!find(header, file, columns[k], &r->at[k]))
      return false;
    const bool optional = strcmp(columns[k], "nx") == 0 || strcmp(columns[k], "ny") == 0 || strcmp(columns[k], "rho") == 0;
    if (r->at[k] == SIZE_MAX && !optional)
      strcat(strcat(missing, columns[k]), " ");
  }
  if ((r->at[6] == SIZE_MAX) != (r->at[7] == SIZE_MAX))
    strcat(missing, r->at[6] == SIZE_MAX ? "nx " : "ny ");
  size_t ball;
  const bool of_balls = missing[1] != '\0' && find(header, file, "r2x", &ball) && ball != SIZE_MAX;
  if (missing[1] != '\0')
    complain("%s:%lld: missing columns:%s(%snames are case-sensitive; `%s resolve --cushion --help` lists them)", file,
             header->line, missing, of_balls ? "collisions of two balls are read without --cushion; " : "", program_name);
  return missing[1] == '\0';
}

cushion_reader *cushion_open(const char *path) {
  cushion_reader *r = allocate(1, sizeof *r);
  record header;
  r->records = record_open(path);
  const read_result result = r->records != NULL ? record_next(r->records, &header) : READ_FAILED;
  if (result == READ_END)
    complain("%s: empty; a header with the names of the columns is needed", record_file_name(r->records));
  else if (result == READ_ONE && header.malformed)
    complain("%s:%lld: no header: the first row is longer than a mebibyte", record_file_name(r->records), header.line);
  else if (result == READ_ONE && find_columns(r, &header))
    return r;
  cushion_close(r);
  return NULL;
}

/* NULL, or the name of what is wrong. */
static const char *fill(const cushion_reader *r, const record *in, cushion_row *row) {
  if (in->malformed) {
    snprintf(row->message, sizeof row->message, "the row is longer than a mebibyte; is a quote left open?");
    return "malformed_row";
  }
  for (size_t k = r->width; k < in->count; k++)
    if (in->field[k][0] != '\0') {
      snprintf(row->message, sizeof row->message, "%zu fields, but the header has %zu", in->count, r->width);
      return "too_many_fields";
    }
  for (int k = 0; k < CUSHION_FIELDS; k++) {
    if (r->at[k] == SIZE_MAX)
      continue;
    if (r->at[k] >= in->count || in->field[r->at[k]][0] == '\0') {
      snprintf(row->message, sizeof row->message, "%s is missing", columns[k]);
      return "missing_value";
    }
    const char *text = in->field[r->at[k]];
    if (!parse_number(text, (double *)&row->impact + k)) {
      snprintf(row->message, sizeof row->message, "%s = '%.60s' is not a number%s", columns[k], text,
               strchr(text, ',') != NULL ? "; decimals have a point, not a comma" : "");
      return "not_a_number";
    }
  }
  return NULL;
}

read_result cushion_next(cushion_reader *r, cushion_row *row) {
  record in;
  const read_result result = record_next(r->records, &in);
  if (result != READ_ONE)
    return result;
  r->rows++;
  row->line = in.line;
  row->impact = defaults;
  char number[24];
  snprintf(number, sizeof number, "%lld", r->rows);
  const char *id = !in.malformed && r->id_at < in.count ? in.field[r->id_at] : number;
  row->id = grow(row->id, &row->id_room, strlen(id) + 1, 1);
  strcpy(row->id, id);
  row->error = fill(r, &in, row);
  return READ_ONE;
}

void cushion_report(const cushion_reader *r, const cushion_row *row, const carom_cushion_options *options,
                    carom_status status) {
  char what[64] = "", text[NUMBER_TEXT], id[ID_TEXT];
  int field;
  const char *file = record_file_name(r->records);
  id_text(row->id, id);
  if (row->error != NULL) {
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, id, row->message, row->error);
    return;
  }
  carom_cushion_check(&row->impact, options, &field);
  if (field >= 0)
    snprintf(what, sizeof what, "%s = %s: ", columns[field], number_text(((const double *)&row->impact)[field], text));
  complain("%s:%lld: id '%s': %s%s (%s)", file, row->line, id, what, carom_status_string(status), carom_status_name(status));
}

void cushion_close(cushion_reader *r) {
  if (r == NULL)
    return;
  record_close(r->records);
  free(r);
}

bool cushion_pick(const char *path, const char *id, const carom_cushion_options *options, carom_cushion_impact *impact) {
  cushion_reader *r = cushion_open(path);
  cushion_row row = {0};
  read_result result = READ_FAILED;
  while (r != NULL && (result = cushion_next(r, &row)) == READ_ONE && strcmp(row.id, id) != 0) {
  }
  bool good = false;
  if (result == READ_ONE) {
    const carom_status status = carom_cushion_check(&row.impact, options, NULL);
    good = row.error == NULL && status == CAROM_OK;
    *impact = row.impact;
    if (!good)
      cushion_report(r, &row, options, status);
  } else if (result == READ_END)
    complain("%s has no impact '%s' among its %lld", record_file_name(r->records), id, r->rows);
  free(row.id);
  cushion_close(r);
  return good;
}
