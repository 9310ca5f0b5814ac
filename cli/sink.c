/* Where results go. */
#include "sink.h"

#include "derived.h"
#include "memory.h"
#include "message.h"
#include "npy.h"
#include "number.h"
#include "output.h"
#include "precision.h"

#include <csv.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBERS = 12 };

struct result_sink {
  FILE *file;
  bool array, single, derived;
  size_t rows;
};

result_sink *sink_open(const char *path, bool single, bool more) {
  if (more && npy_is_name(path)) {
    complain("--derived adds columns to CSV, which an array has not: %s", path);
    return NULL;
  }
  FILE *file = output_open(path);
  if (file == NULL)
    return NULL;
  result_sink *s = allocate(1, sizeof *s);
  *s = (result_sink){.file = file, .array = npy_is_name(path), .single = single, .derived = more};
  if (s->array)
    npy_write_header(s->file, single ? "<f4" : "<f8", 0, NUMBERS);
  else
    fprintf(s->file, "id,%s,status%s\n", RESULT_COLUMNS, more ? "," DERIVED_COLUMNS : "");
  return s;
}

void write_id(FILE *out, const char *id) {
  if (strpbrk(id, ",\"\r\n") != NULL)
    csv_fwrite(out, id, strlen(id));
  else
    fputs(id, out);
}

static void write_csv(result_sink *s, const char *id, const carom_impact *impact, const void *result, const char *status,
                      bool good) {
  double wide[NUMBERS];
  if (s->single)
    to_double(result, wide, NUMBERS);
  if (id == NULL)
    fprintf(s->file, "%zu", s->rows);
  else
    write_id(s->file, id);
  write_numbers(s->file, s->single ? wide : result, NUMBERS);
  fprintf(s->file, ",%s", status);
  if (s->derived) {
    double numbers[DERIVED_NUMBERS];
    for (int k = 0; k < DERIVED_NUMBERS; k++)
      numbers[k] = (double)NAN;
    carom_result after;
    memcpy(&after, s->single ? wide : result, sizeof after);
    const struct derived d = derive(impact, &after);
    if (good)
      memcpy(numbers, &d, sizeof d);
    write_numbers(s->file, numbers, DERIVED_NUMBERS);
  }
  fputc('\n', s->file);
}

void sink_write(result_sink *s, const char *id, const carom_impact *impact, const void *result, carom_status status,
                const char *error) {
  s->rows++;
  if (s->array)
    fwrite(result, s->single ? sizeof(float) : sizeof(double), NUMBERS, s->file);
  else
    write_csv(s, id, impact, result, error != NULL ? error : carom_status_name(status), error == NULL && status == CAROM_OK);
}

bool sink_close(result_sink *s, bool good) {
  if (good && s->array && fseek(s->file, 0, SEEK_SET) != 0) {
    if (errno == ESPIPE)
      complain("a .npy file needs a place that can be sought, not a pipe");
    else
      complain("cannot write the .npy file: %s", strerror(errno));
    good = false;
  }
  if (good && s->array) /* now that the rows have been counted */
    npy_write_header(s->file, s->single ? "<f4" : "<f8", s->rows, NUMBERS);
  if (!good)
    output_abandon();
  free(s);
  return good && output_commit();
}
