/* NumPy's .npy files. */
#include "npy.h"

#include "message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { HEADER = 128 };

bool npy_is_name(const char *path) {
  const size_t size = strlen(path);
  return size > 4 && strcmp(path + size - 4, ".npy") == 0;
}

/* The text after 'key': in the header's dictionary, or NULL. */
static const char *value_of(const char *header, const char *key) {
  char quoted[32];
  snprintf(quoted, sizeof quoted, "'%s'", key);
  const char *at = strstr(header, quoted);
  if (at == NULL)
    return NULL;
  at += strlen(quoted);
  at += strspn(at, " ");
  return *at == ':' ? at + 1 + strspn(at + 1, " ") : NULL;
}

static bool parse_header(const char *path, const char *header, size_t columns, npy_array *array) {
  const char *descr = value_of(header, "descr"), *order = value_of(header, "fortran_order"), *shape = value_of(header, "shape");
  if (descr == NULL || order == NULL || shape == NULL) {
    complain("%s: not a .npy header: descr, fortran_order and shape are needed", path);
    return false;
  }
  array->single = strncmp(descr, "'<f4'", 5) == 0;
  if (!array->single && strncmp(descr, "'<f8'", 5) != 0) {
    complain("%s: dtype %.*s; float64 or float32, little-endian, is needed: array.astype('<f8')", path,
             (int)strcspn(descr, ",}"), descr);
    return false;
  }
  if (strncmp(order, "False", 5) != 0) {
    complain("%s: the array is in Fortran order; C order is needed: numpy.ascontiguousarray(array)", path);
    return false;
  }
  char *end = NULL;
  errno = 0;
  const unsigned long long rows = *shape == '(' ? strtoull(shape + 1, &end, 10) : 0;
  unsigned long long width = 0;
  if (end != NULL && *end == ',')
    width = strtoull(end + 1, &end, 10);
  if (end == NULL || end[strspn(end, ", ")] != ')' || width != columns || errno != 0) {
    complain("%s: shape %.*s; (n, %zu) is needed, a row the numbers of carom_impact in their order", path,
             (int)strcspn(shape, ")") + 1, shape, columns);
    return false;
  }
  array->rows = (size_t)rows;
  return true;
}

/* Where the data begin; 0 after a complaint. */
static size_t find_data(const char *path, size_t columns, npy_array *array) {
  const unsigned char *bytes = array->mapping;
  size_t prefix = 0, length = 0;
  if (array->mapped >= 12 && memcmp(bytes, "\x93NUMPY", 6) == 0 && bytes[6] >= 1 && bytes[6] <= 3) {
    prefix = bytes[6] == 1 ? 10 : 12;
    length = bytes[8] | (size_t)bytes[9] << 8;
    if (prefix == 12)
      length |= (size_t)bytes[10] << 16 | (size_t)bytes[11] << 24;
  }
  if (prefix == 0 || length > array->mapped - prefix) {
    complain("%s: not a .npy file", path);
    return 0;
  }
  char *header = strndup((const char *)bytes + prefix, length);
  const bool good = header != NULL && parse_header(path, header, columns, array);
  free(header);
  if (!good)
    return 0;
  const size_t size = columns * (array->single ? sizeof(float) : sizeof(double)), left = array->mapped - prefix - length;
  if (array->rows > left / size) {
    complain("%s: cut off: %zu rows of %zu bytes are promised, %zu bytes are there", path, array->rows, size, left);
    return 0;
  }
  return prefix + length;
}

bool npy_open(const char *path, size_t columns, npy_array *array) {
  *array = (npy_array){0};
  struct stat status;
  const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 || fstat(descriptor, &status) != 0) {
    complain("cannot read %s: %s", path, strerror(errno));
    if (descriptor >= 0)
      close(descriptor);
    return false;
  }
  array->mapped = (size_t)status.st_size;
  array->mapping = array->mapped > 0 ? mmap(NULL, array->mapped, PROT_READ, MAP_PRIVATE, descriptor, 0) : MAP_FAILED;
  close(descriptor);
  if (array->mapping == MAP_FAILED) {
    array->mapping = NULL;
    complain("cannot map %s into memory: %s", path, array->mapped == 0 ? "it is empty or no regular file" : strerror(errno));
    return false;
  }
  const size_t start = find_data(path, columns, array);
  if (start == 0) {
    npy_close(array);
    return false;
  }
  array->data = (const char *)array->mapping + start;
  if ((uintptr_t)array->data % sizeof(double) != 0) {
    complain("%s: the data are not aligned, as NumPy would have them", path);
    npy_close(array);
    return false;
  }
  madvise(array->mapping, array->mapped, MADV_SEQUENTIAL);
  return true;
}

void npy_close(npy_array *array) {
  if (array->mapping != NULL)
    munmap(array->mapping, array->mapped);
  *array = (npy_array){0};
}

void npy_write_header(FILE *out, const char *descr, size_t rows, size_t columns) {
  char header[HEADER + 1];
  char shape[64];
  if (columns > 0)
    snprintf(shape, sizeof shape, "%zu, %zu", rows, columns);
  else
    snprintf(shape, sizeof shape, "%zu,", rows);
  const int used = snprintf(header, sizeof header, "\x93NUMPY%c%c%c%c{'descr': '%s', 'fortran_order': False, 'shape': (%s), }",
                            1, 'x', HEADER - 10, 'x', descr, shape);
  header[7] = 0;
  header[9] = 0;
  memset(header + used, ' ', (size_t)(HEADER - used));
  header[HEADER - 1] = '\n';
  fwrite(header, 1, HEADER, out);
}
