/* What the user sees on stderr: messages, and a progress line for work of more than a second. */
#ifndef CAROM_CLI_MESSAGE_H
#define CAROM_CLI_MESSAGE_H

#include <stdio.h>

/* The program's name, which stands before every message. */
extern const char *program_name;

/* Prints the program's name, the message and a newline, clear of a progress line that may stand
 * there. Texts of the user's may stand in a message as they are: characters that a terminal
 * would obey are shown as '?'. */
__attribute__((format(printf, 1, 2))) void complain(const char *format, ...);

/* Prints paragraphs, a line each, broken between words where one is longer than `width`; the
 * further lines of a paragraph begin below the text behind its first words where blanks make a
 * table of it. */
void print_wrapped(FILE *out, const char *text, int width);

/* An id as a message shows it: whole up to 60 characters, else cut there with "..." behind it.
 * Returns `text`. */
enum { ID_TEXT = 64 };
const char *id_text(const char *id, char text[ID_TEXT]);

/* Says that `done` of `total` units ("rows") are done; `total` < 0 where it is not known. Draws
 * at most ten times a second, and nothing in the first second or when stderr is no terminal. */
void progress_show(const char *unit, double done, double total);

/* Removes the line, if one stands there. */
void progress_clear(void);

/* The end of a template that mkstemp() and mkdtemp() make a name of. */
extern const char random_name[7];

#endif
