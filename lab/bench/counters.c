/* The table of counters: what they are called, whoever counts. */
#include "counters.h"

#include <stddef.h>

#define COLUMN(NAME, column, text, ...) column,
static const char *const columns[] = {COUNTER_LIST(COLUMN)};
#undef COLUMN
#define TEXT(NAME, column, text, ...) text,
static const char *const texts[] = {COUNTER_LIST(TEXT)};
#undef TEXT

const char *counter_column(int k) {
  return columns[k];
}

const char *counter_text(int k) {
  return texts[k];
}
