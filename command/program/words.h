/* Lists of words with bars or blanks between them: which of them a text is, and which it nearly
 * is. */
#ifndef CAROM_CLI_WORDS_H
#define CAROM_CLI_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

/* The text where `condition` is set, else "". */
const char *text_if(bool condition, const char *text);

/* The text, or the other one where it is NULL or "". */
const char *text_or(const char *text, const char *fallback);

/* Adds to a list in a text of so many bytes, as far as there is room; behind the separator, unless
 * the list is empty. */
__attribute__((format(printf, 4, 5))) void append(char *text, size_t room, const char *separator,
                                                  const char *format, ...);

/* The last part of a path. */
const char *name_of_file(const char *path);

/* Whether two texts are the same to the letter. */
bool same_text(const char *a, const char *b);

/* "left" of a number above 0, else "right"; "below" of a number below 0, else "above". */
const char *left_or_right(double to_left);
const char *above_or_below(double above);

/* The place of `text`, of `size` characters, among the words; -1 if it is none of them. */
int place_among(const char *words, const char *text, size_t size);

/* Whether a text is a word as players write it, by carom_word_means(): "left-side" is "side-left",
 * and "9-ball" is "nineball". */
bool same_word(const char *text, size_t size, const char *word, size_t length);

/* The place of such a text among words with bars between them; -1 if it is none of them. */
int word_among(const char *words, const char *text, size_t size);

/* "; did you mean 'follow'?" where `text` is nearly one of the words, or the beginning of one; else
 * "". Where players use `text` for something that is no value anywhere, "; try " and what does it.
 * Returns `hint`. */
enum { HINT_TEXT = 128 };
const char *did_you_mean(const char *text, const char *words, char hint[HINT_TEXT]);

/* Whether did_you_mean() has a suggestion. */
bool is_nearly(const char *text, const char *words);

/* What to try instead of `text`: the word that it nearly is; else all words where they are few, or
 * the first two: "paper or pooltool". Returns `list`. */
const char *words_to_try(const char *text, const char *words, char list[HINT_TEXT]);

#endif
