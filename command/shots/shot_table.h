/* Tables from JSON, and those that are built in. */
#ifndef CAROM_CLI_SHOT_TABLE_H
#define CAROM_CLI_SHOT_TABLE_H

#include "shots/json_values.h"

#include "carom_shot.h"

#include <stdbool.h>

/* A table by its id, with the ids of its parts. */
typedef struct named_table {
  char *id;
  carom_table table;
  char *rail[CAROM_RAILS_MOST], *jaw[CAROM_JAWS_MOST], *pocket[CAROM_POCKETS_MOST];
} named_table;

/* Reads a line of kind table into *t, which is all zero. False where it is wrong; *t is to be
 * freed either way. */
bool read_table(const json_t *json, named_table *t, json_fault *f);

/* The name of a table with its measures as built_in_table() knows it: "12ft" is "snooker". */
char *table_spelt(char *text);

/* A new table of this name, behind which measures may stand, "9ft,corner=4.25in"; NULL where that
 * cannot be, with the reason in *f, or "" if none of that name is built in. */
named_table *built_in_table(const char *id, json_fault *f);

/* The table on which a rack stands where none is given: that of its name, or the 9ft table. */
carom_table_kind table_of_rack(carom_rack_kind rack);

void free_table(named_table *t);

#endif
