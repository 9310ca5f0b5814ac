/* Pages of the manual: the help as roff, with man's macros. command/manual.cmake adds the head and
 * SEE ALSO. */
#ifndef CAROM_CLI_MANUAL_H
#define CAROM_CLI_MANUAL_H

#include <stdio.h>

/* NAME and SYNOPSIS of a command, or of the program where that is NULL; the name's line is the
 * first sentence of `about`. */
void manual_begin(FILE *out, const char *program, const char *command, const char *usage,
                  const char *about);

/* Begins a section with a text, which may be "". */
void manual_section(FILE *out, const char *name, const char *text);

/* An item with its text. The head is bold; `argument`, NULL for none, stands behind it. */
void manual_item(FILE *out, const char *head, const char *argument, const char *text);

/* EXIT STATUS and EXAMPLES. */
void manual_end(FILE *out, const char *exits, const char *example);

#endif
