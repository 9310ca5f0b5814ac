/* Ways in words, and as the lines of their strokes. */
#ifndef CAROM_CLI_WAY_WORDS_H
#define CAROM_CLI_WAY_WORDS_H

#include "ways.h"

enum { PARTS_TEXT = 160, WAY_TEXT = 400, CUT_TEXT = 24 };

/* "left, 2": the rails and balls of a way. */
const char *parts_text(const ways_search *s, const way *w, char text[PARTS_TEXT]);

/* "1 to foot-left, bank: left" */
const char *way_text(const ways_search *s, const way *w, char text[WAY_TEXT]);

/* "30.6 left"; nothing where the cut is not known. */
const char *cut_text(const way *w, char text[CUT_TEXT]);

/* The line of a way's stroke, for `carom shoot`; to be released. */
json_t *way_line(const ways_search *s, const way *w);

#endif
