/* Memory that is there or ends the program: with a complaint, exit code 2, and no half-written
 * output left behind. */
#ifndef CAROM_CLI_MEMORY_H
#define CAROM_CLI_MEMORY_H

#include <stddef.h>
#include <stdio.h>

/* Ends the program so; command.c has seen to the output. */
__attribute__((noreturn)) void out_of_memory(void);

/* `count` elements of `size` bytes, all zero; to be freed. */
void *allocate(size_t count, size_t size);

/* A new text, to be freed. */
char *copy_text(const char *text);

/* A stream into a new text, and its end, after which the text is there and is to be freed. */
FILE *open_text(char **text, size_t *size);
void close_text(FILE *stream, char *const *text);

/* An array of `*room` elements, made larger where it holds fewer than `needed`: to twice its
 * size at least, so that growing one by one costs the same for each. Gives the block, which may
 * have moved; a new one begins as NULL with `*room` 0. */
void *grow(void *block, size_t *room, size_t needed, size_t size);

#endif
