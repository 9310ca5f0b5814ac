/* Tables from JSON, and those that are built in. */
#ifndef CAROM_CLI_SHOT_TABLE_H
#define CAROM_CLI_SHOT_TABLE_H

#include "json_values.h"
#include "shot_file.h"

/* Reads a line of kind table into *t, which is all zero. False where it is wrong; *t is to be freed either way. */
bool read_table(const json_t *json, named_table *t, json_fault *f);

/* A new table of this name, or NULL if there is none that is built in. */
named_table *built_in_table(const char *id);

void free_table(named_table *t);

#endif
