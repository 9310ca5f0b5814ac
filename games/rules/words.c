/* The names of a game's values, for programs that request them. */
#include "words.h"

#include "carom_match.h"
#include "platform/arithmetic.h"
#include "schema/rows.h"

#define WORD(OF, VALUE, word, text) {CAROM_GAME_WORDS_##OF, CAROM_##VALUE, word, text},
static const carom_word_row game_words[] = {CAROM_GAME_WORD_ROWS(WORD)};
#undef WORD

static const carom_word_row *find(carom_game_words kind, int value) {
  for (size_t k = 0; k < sizeof game_words / sizeof *game_words; k++)
    if (game_words[k].kind == (int)kind && game_words[k].value == value)
      return &game_words[k];
  return NULL;
}

const char *carom_game_word(carom_game_words of, int value) {
  const carom_word_row *row = find(of, value);
  if (row == NULL)
    return NULL;
  return row->word;
}

const char *carom_game_word_text(carom_game_words of, int value) {
  const carom_word_row *row = find(of, value);
  if (row == NULL)
    return NULL;
  return row->text;
}
