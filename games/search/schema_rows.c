/* The options of a plan and the words of games, for programs that ask what there is. */
#include "carom_match.h"
#include "games.h"
#include "plan_options.h"
#include "platform/arithmetic.h"
#include "schema/rows.h"
#include "words.h"

#define PLAN_OPTION(...) CAROM_OPTION_ROW(carom_plan_options, ALWAYS, __VA_ARGS__, 0)
static const carom_number plan_options[] = {CAROM_PLAN_OPTIONS(PLAN_OPTION)};

#define GAME_WORD(NAME, rules, word, text, ...) {CAROM_WORDS_RULES, CAROM_RULES_##NAME, word, text},
static const carom_word_row rules_words[] = {CAROM_GAMES(GAME_WORD)};

const carom_upper_rows carom_upper_schema = {
    .part = CAROM_PART_PLAN_OPTIONS,
    .numbers = plan_options,
    .numbers_count = sizeof plan_options / sizeof *plan_options,
    .words = rules_words,
    .words_count = sizeof rules_words / sizeof *rules_words};

/* ---- Words of games */

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
