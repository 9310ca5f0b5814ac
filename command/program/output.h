/* Files that are read; and a file that appears whole or not at all: written beside its place,
 * renamed when it is complete.
 *
 * "-" is stdout, and what exists already but is no regular file (a terminal, a pipe, /dev/null)
 * is written in place: there the output streams. A symbolic link stays, and what it leads to is
 * written. Mode and owner of a file stay too. Where they could not, or where no file can be made
 * beside it, the text is gathered in an unnamed file first and then copied over the old one;
 * signals wait for the end of that copy.
 *
 * Until then every signal but SIGKILL leaves the old file, and nothing beside it. A signal that
 * the command was told to ignore stays ignored.
 */
#ifndef CAROM_CLI_OUTPUT_H
#define CAROM_CLI_OUTPUT_H

#include <stdbool.h>
#include <stdio.h>

/* Opens a file for reading, "-" as stdin. Complains and returns NULL if that fails. */
FILE *input_open(const char *path);

/* Gives each line of a file to read(), with its end of line, until that returns false. Returns
 * whether all lines were read; complains of a file that cannot be. */
bool input_lines(const char *path, bool (*read)(void *context, const char *line, size_t size),
                 void *context);

/* What messages call a file that is read. */
const char *input_name(const char *path);

/* Opens the output for writing. Complains and returns NULL if that fails. One at a time. */
FILE *output_open(const char *path);

/* Whether output_open() would open the path, which may be NULL; complains where it would not. */
bool output_possible(const char *path);

/* Puts the file in its place. Complains and returns false if anything could not be written. */
bool output_commit(void);

/* Drops what has been written. */
void output_abandon(void);

/* Copies a whole file that can be sought to a stream; returns how much there was. */
size_t output_copy(FILE *source, FILE *target);

#endif
