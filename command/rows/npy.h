/* NumPy's .npy files: arrays of plain numbers, read and written through a stream.
 *
 * Taken are arrays in C order of little-endian float64 ('<f8') or float32 ('<f4') and shape (n,
 * columns); anything else is refused with a sentence that says what would be right. Format: NEP
 * 1, versions 1.0 to 3.0.
 */
#ifndef CAROM_CLI_NPY_H
#define CAROM_CLI_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct npy_array {
  const char *name;
  FILE *file;
  size_t rows, row_size; /* the latter in bytes */
  bool single;           /* float32, else float64 */
} npy_array;

/* Whether the name ends in ".npy". */
bool npy_is_name(const char *path);

/* Opens `path`, which must have `columns` columns. Complains and returns false if it cannot. */
bool npy_open(const char *path, size_t columns, npy_array *array);

/* Reads the next rows as doubles, of which there must be so many left; false after a complaint. */
bool npy_read(npy_array *array, size_t rows, double *target);
void npy_close(npy_array *array);

/* Writes the header of an array of type `descr` ("<f8", "<f4") and shape (rows, columns). It has
 * the same length for every number of rows, so it can be written again once they have been
 * counted. */
void npy_write_header(FILE *out, const char *descr, size_t rows, size_t columns);

#endif
