/* The options of a plan and the names of games, as the schema shows them to programs. */
#include "carom_coach.h"
#include "carom_match.h"
#include "games.h"
#include "plan_options.h"
#include "platform/arithmetic.h"
#include "schema/rows.h"
#include "words.h"

#define PLAN_OPTION(...) CAROM_OPTION_ROW(carom_plan_options, ALWAYS, __VA_ARGS__, 0)
static const carom_number plan_options[] = {CAROM_PLAN_OPTIONS(PLAN_OPTION)};

#define GAME_WORD(NAME, rules, word, text, ...) {CAROM_WORDS_RULES, CAROM_RULES_##NAME, word, text},
#define WORD(OF, VALUE, word, text) {CAROM_WORDS_##OF, CAROM_##VALUE, word, text},
static const carom_word_row game_words[] = {CAROM_GAMES(GAME_WORD) CAROM_GAME_WORD_ROWS(WORD)};

const carom_upper_rows carom_upper_schema = {.part = CAROM_PART_PLAN_OPTIONS,
                                             .numbers = plan_options,
                                             .numbers_count =
                                                 sizeof plan_options / sizeof *plan_options,
                                             .words = game_words,
                                             .words_count = sizeof game_words / sizeof *game_words};
