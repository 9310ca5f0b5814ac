/* NumPy's .npy files: arrays of plain numbers, read by mapping them into memory and written through a stream.
 *
 * Taken are arrays in C order of little-endian float64 ('<f8') or float32 ('<f4') and shape (n, columns); anything else is
 * refused with a sentence that says what would be right. Format: NEP 1, versions 1.0 to 3.0.
 */
#ifndef CAROM_CLI_NPY_H
#define CAROM_CLI_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct npy_array {
  const void *data; /* rows x columns numbers */
  size_t rows;
  bool single; /* float32, else float64 */
  void *mapping;
  size_t mapped;
} npy_array;

/* Whether the name ends in ".npy". */
bool npy_is_name(const char *path);

/* Maps `path`, which must have `columns` columns. Complains and returns false if it cannot. */
bool npy_open(const char *path, size_t columns, npy_array *array);
void npy_close(npy_array *array);

/* Writes the header of an array of type `descr` ("<f8", "<f4", "|i1") and shape (rows, columns), or (rows,) where columns is
 * 0. It has the same length for every number of rows, so it can be written again once they have been counted. */
void npy_write_header(FILE *out, const char *descr, size_t rows, size_t columns);

#endif
