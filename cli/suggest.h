/* What may have been meant by a mistyped word. */
#ifndef CAROM_CLI_SUGGEST_H
#define CAROM_CLI_SUGGEST_H

#include <stdbool.h>

/* Whether `typed` is close to `name`: the same but for the case of letters, or with one letter wrong, missing or too many, or
 * two neighbours swapped; in words of more than five letters two such mistakes. */
bool resembles(const char *typed, const char *name);

#endif
