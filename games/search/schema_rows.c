/* The options of a plan and the names of games, as the schema shows them to programs. */
#include "carom_match.h"
#include "games.h"
#include "plan_options.h"
#include "platform/arithmetic.h"
#include "schema/rows.h"

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
