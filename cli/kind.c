/* What every kind has alike. */
#include "kind.h"

#include <string.h>

bool kind_fills(const row_kind *k, int number, const char *name) {
  const column *c = &k->columns[number];
  return strcmp(c->name, name) == 0 || (c->both != NULL && strcmp(c->both, name) == 0);
}
