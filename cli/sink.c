/* Where results go. */
#include "sink.h"

#include "message.h"
#include "npy.h"
#include "output.h"

#include <csv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBERS = 12 };

struct result_sink {
  FILE *file;
  bool array, single;
  size_t rows;
};

result_sink *sink_open(const char *path, bool single) {
  result_sink *s = calloc(1, sizeof *s);
  if (s == NULL) {
    complain("out of memory");
    return NULL;
  }
  *s = (result_sink){.file = output_open(path), .array = npy_is_name(path), .single = single};
  if (s->file == NULL) {
    free(s);
    return NULL;
  }
  if (s->array)
    npy_write_header(s->file, single ? "<f4" : "<f8", 0, NUMBERS);
  else
    fputs("id,v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z,status\n", s->file);
  return s;
}

static void write_id(FILE *out, const char *id) {
  if (strpbrk(id, ",\"\r\n") != NULL)
    csv_fwrite(out, id, strlen(id));
  else
    fputs(id, out);
}

static void write_csv(result_sink *s, const char *id, const void *result, const char *status, bool bad) {
  if (id != NULL)
    write_id(s->file, id);
  else
    fprintf(s->file, "%zu", s->rows);
  for (int k = 0; k < NUMBERS; k++)
    if (bad)
      fputs(",nan", s->file);
    else
      fprintf(s->file, ",%.17g", s->single ? (double)((const float *)result)[k] : ((const double *)result)[k]);
  fprintf(s->file, ",%s\n", status);
}

/* Rows in error are NaN throughout already. */
static void write_array(result_sink *s, const void *result) {
  fwrite(result, s->single ? sizeof(float) : sizeof(double), NUMBERS, s->file);
}

void sink_write(result_sink *s, const char *id, const void *result, carom_status status, const char *error) {
  s->rows++;
  if (s->array)
    write_array(s, result);
  else
    write_csv(s, id, result, error != NULL ? error : carom_status_name(status), error != NULL || status < 0);
}

bool sink_commit(result_sink *s) {
  bool good = true;
  if (s->array) { /* now that the rows have been counted */
    good = fseek(s->file, 0, SEEK_SET) == 0;
    if (good)
      npy_write_header(s->file, s->single ? "<f4" : "<f8", s->rows, NUMBERS);
    else
      complain("a .npy file needs a place that can be sought, not a pipe");
  }
  if (good)
    good = output_commit();
  else
    output_abandon();
  free(s);
  return good;
}

void sink_abandon(result_sink *s) {
  output_abandon();
  free(s);
}
