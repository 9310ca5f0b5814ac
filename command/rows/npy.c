/* NumPy's .npy files. */
#include "rows/npy.h"

#include "program/program.h"

#include <errno.h>
#include <sys/stat.h>

enum { HEADER = 128, LONGEST_HEADER = 1 << 20 };

bool npy_is_name(const char *path) {
  const size_t size = strlen(path);
  return size > 4 && same_text(path + size - 4, ".npy");
}

/* The text after 'key': in the header's dictionary, or NULL. */
static const char *value_of(const char *header, const char *key) {
  char quoted[32];
  snprintf(quoted, sizeof quoted, "'%s'", key);
  const char *place = strstr(header, quoted);
  if (place == NULL)
    return NULL;
  place += strlen(quoted);
  place += strspn(place, " ");
  return *place == ':' ? place + 1 + strspn(place + 1, " ") : NULL;
}

static bool parse_header(const char *path, const char *header, size_t columns, npy_array *array) {
  const char *descr = value_of(header, "descr"), *order = value_of(header, "fortran_order"),
             *shape = value_of(header, "shape");
  if (descr == NULL || order == NULL || shape == NULL) {
    complain("%s: not a .npy header: descr, fortran_order and shape are needed", path);
    return false;
  }
  array->single = strncmp(descr, "'<f4'", 5) == 0;
  if (!array->single && strncmp(descr, "'<f8'", 5) != 0) {
    complain("%s: dtype %.*s; float64 or float32, little-endian, is needed: array.astype('<f8')",
             path, (int)strcspn(descr, ",}"), descr);
    return false;
  }
  if (strncmp(order, "False", 5) != 0) {
    complain("%s: the array is in Fortran order; C order is needed: numpy.ascontiguousarray(array)",
             path);
    return false;
  }
  unsigned long long rows, width;
  char close;
  if (strcspn(shape, "-") < strcspn(shape, ")") ||
      sscanf(shape, "(%llu , %llu %c", &rows, &width, &close) != 3 || width != columns ||
      close != ')') {
    complain("%s: shape %.*s; (n, %zu) is needed; `carom resolve --help` has the numbers of a row",
             path, (int)strcspn(shape, ")") + 1, shape, columns);
    return false;
  }
  array->rows = (size_t)rows;
  return true;
}

/* The header's text, to be freed; NULL if the file is none of NumPy's. */
static char *read_header(FILE *in) {
  unsigned char head[12] = {0};
  const bool first = fread(head, 1, 10, in) == 10 && memcmp(head, "\x93NUMPY", 6) == 0 &&
                     head[6] >= 1 && head[6] <= 3;
  if (!first || (head[6] > 1 && fread(head + 10, 1, 2, in) != 2))
    return NULL;
  const size_t length =
      head[8] | (size_t)head[9] << 8 | (size_t)head[10] << 16 | (size_t)head[11] << 24;
  char *header = length <= LONGEST_HEADER ? allocate(length + 1, 1) : NULL;
  if (header != NULL && fread(header, 1, length, in) == length)
    return header;
  free(header);
  return NULL;
}

bool npy_open(const char *path, size_t columns, npy_array *array) {
  struct stat status;
  *array = (npy_array){.name = path, .file = fopen(path, "rb"), .row_size = columns};
  if (array->file == NULL || fstat(fileno(array->file), &status) != 0) {
    complain("cannot read %s: %s", path, strerror(errno));
    npy_close(array);
    return false;
  }
  char *header = read_header(array->file);
  if (header == NULL)
    complain("%s: not a .npy file", path);
  bool good = header != NULL && parse_header(path, header, columns, array);
  free(header);
  array->row_size *= array->single ? sizeof(float) : sizeof(double);
  const size_t left = good ? (size_t)(status.st_size - ftell(array->file)) : 0;
  if (good && S_ISREG(status.st_mode) && array->rows > left / array->row_size) {
    complain("%s: cut off: %zu rows of %zu bytes are promised, %zu bytes are there", path,
             array->rows, array->row_size, left);
    good = false;
  }
  if (!good)
    npy_close(array);
  return good;
}

bool npy_read(npy_array *array, size_t rows, double *target) {
  const size_t numbers = rows * array->row_size / (array->single ? sizeof(float) : sizeof(double));
  /* Floats are read behind the room that they leave, and made double from the first on. */
  float *narrow = (float *)(void *)target + numbers;
  const bool good =
      fread(array->single ? (void *)narrow : target, array->row_size, rows, array->file) == rows;
  for (size_t k = 0; good && array->single && k < numbers; k++) {
    float x;
    memcpy(&x, narrow + k, sizeof x);
    target[k] = (double)x;
  }
  if (good)
    return true;
  complain("cannot read %s: %s", array->name,
           ferror(array->file) ? strerror(errno) : "it is cut off");
  return false;
}

void npy_close(npy_array *array) {
  if (array->file != NULL)
    fclose(array->file);
  *array = (npy_array){0};
}

void npy_write_header(FILE *out, const char *descr, size_t rows, size_t columns) {
  char header[HEADER + 1];
  const int used =
      snprintf(header, sizeof header,
               "\x93NUMPY%c%c%c%c{'descr': '%s', 'fortran_order': False, 'shape': (%zu, %zu), }", 1,
               'x', HEADER - 10, 'x', descr, rows, columns);
  header[7] = 0;
  header[9] = 0;
  memset(header + used, ' ', (size_t)(HEADER - used));
  header[HEADER - 1] = '\n';
  fwrite(header, 1, HEADER, out);
}
