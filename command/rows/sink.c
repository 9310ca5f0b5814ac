/* Where results go. */
#include "rows/sink.h"

#include "program/program.h"
#include "rows/npy.h"
#include "rows/number.h"
#include "rows/precision.h"

#include <csv.h>
#include <errno.h>

struct result_sink {
  FILE *file;
  const row_kind *kind;
  bool array, single, derived;
  size_t rows;
};

/* The header of an array; it is written again when the rows have been counted. */
static void write_header(const result_sink *s) {
  npy_write_header(s->file, s->single ? "<f4" : "<f8", s->rows, (size_t)s->kind->results);
}

result_sink *sink_open(const shared_options *shared, bool single) {
  const char *path = shared->output != NULL ? shared->output : "-";
  if (shared->derived && npy_is_name(path)) {
    complain("--derived adds columns to CSV, which an array has not: %s", path);
    return NULL;
  }
  FILE *file = output_open(path);
  if (file == NULL)
    return NULL;
  result_sink *s = allocate(1, sizeof *s);
  *s = (result_sink){.file = file,
                     .kind = kind_of(shared),
                     .array = npy_is_name(path),
                     .single = single,
                     .derived = shared->derived};
  if (s->array)
    write_header(s);
  else
    fprintf(file, "id,%s,status%s%s\n", s->kind->result_columns, text_if(s->derived, ","),
            text_if(s->derived, s->kind->derived_columns));
  return s;
}

/* Writes an id as a field of CSV, in quotes where it needs them. */
static void write_id(FILE *out, const char *id) {
  if (strpbrk(id, ",\"\r\n") != NULL)
    csv_fwrite(out, id, strlen(id));
  else
    fputs(id, out);
}

void write_row_header(FILE *out, const row_kind *kind) {
  fputs("id", out);
  for (int k = 0; k < kind->numbers; k++)
    fprintf(out, ",%s", kind->columns[k].name);
  fputc('\n', out);
}

void write_row(FILE *out, const row_kind *kind, const char *id, const double *row) {
  write_id(out, id);
  write_numbers(out, row, (size_t)kind->numbers);
  fputc('\n', out);
}

static void write_csv(result_sink *s, const char *id, const double *in, const double *result,
                      const char *status, bool good) {
  double derived[MOST_DERIVED];
  if (id == NULL)
    fprintf(s->file, "%zu", s->rows);
  else
    write_id(s->file, id);
  write_numbers(s->file, result, (size_t)s->kind->results);
  fprintf(s->file, ",%s", status);
  /* Nothing derives from a row that was not resolved. */
  if (s->derived && good)
    s->kind->derive(in, result, derived);
  for (int k = 0; s->derived && !good && k < s->kind->derived; k++)
    derived[k] = (double)NAN;
  write_numbers(s->file, derived, s->derived ? (size_t)s->kind->derived : 0);
  fputc('\n', s->file);
}

void sink_write(result_sink *s, const char *id, const double *in, const double *result,
                carom_status status, const char *error) {
  const size_t results = (size_t)s->kind->results;
  float narrow[MOST_RESULTS];
  s->rows++;
  if (s->single)
    to_single(result, narrow, results);
  if (s->array)
    fwrite(s->single ? (const void *)narrow : result, s->single ? sizeof(float) : sizeof(double),
           results, s->file);
  else
    write_csv(s, id, in, result, error != NULL ? error : carom_status_name(status),
              error == NULL && status == CAROM_OK);
}

bool sink_close(result_sink *s, bool good) {
  if (good && s->array && fseek(s->file, 0, SEEK_SET) != 0) {
    if (errno == ESPIPE)
      complain("a .npy file needs a place that can be sought, not a pipe");
    else
      complain("cannot write the .npy file: %s", strerror(errno));
    good = false;
  }
  if (good && s->array)
    write_header(s);
  if (!good)
    output_abandon();
  free(s);
  return good && output_commit();
}
