/* The reference collisions of data/, for tests of the core: the 204 impacts, and the results that
 * references have for them. The study reads the same files with the command's reader of rows
 * (study/program/cases.h), which the core does not know. */
#ifndef CAROM_TEST_CASES_H
#define CAROM_TEST_CASES_H

#include "carom.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct case_set {
  size_t count;
  char (*id)[32];
  carom_impact *impact;
} case_set;

typedef struct reference_set {
  size_t count;
  carom_result *result;
  int64_t *steps; /* step counts of the reference, or NULL if the file has none */
} reference_set;

/* Loads `folder`/`name`. Prints what is wrong with the file and returns false if it is not as
 * expected. */
bool cases_load(const char *folder, const char *name, case_set *out);

/* Loads the results of `folder`/`name`, which must have the ids of `cases` in the same order. */
bool reference_load(const char *folder, const char *name, const case_set *cases,
                    reference_set *out);

void cases_free(case_set *cases);
void reference_free(reference_set *reference);

#endif
