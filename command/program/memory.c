/* Memory that is there or ends the program. */
#include "program/memory.h"

#include "program/command.h"
#include "program/message.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void out_of_memory(void) {
  complain("out of memory");
  exit(EXIT_USAGE);
}

static void *checked(void *block) {
  if (block == NULL)
    out_of_memory();
  return block;
}

void *allocate(size_t count, size_t size) {
  return checked(calloc(count > 0 ? count : 1, size));
}

char *copy_text(const char *text) {
  return strcpy(allocate(strlen(text) + 1, 1), text);
}

FILE *open_text(char **text, size_t *size) {
  return checked(open_memstream(text, size));
}

void close_text(FILE *stream, char *const *text) {
  const bool failed = ferror(stream) != 0;
  if (fclose(stream) != 0 || failed || *text == NULL)
    out_of_memory();
}

void *grow(void *block, size_t *room, size_t needed, size_t size) {
  if (needed <= *room)
    return block;
  const size_t larger = needed > 2 * *room ? needed : 2 * *room;
  block = checked(larger <= SIZE_MAX / size ? realloc(block, larger * size) : NULL);
  *room = larger;
  return block;
}
