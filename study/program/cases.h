/* The reference collisions in data/: inputs, and the results that others computed for them. */
#ifndef CAROM_LAB_CASES_H
#define CAROM_LAB_CASES_H

#include "carom.h"
#include "rows/records.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct case_set {
  size_t count;
  char **id;
  carom_impact *impact;
} case_set;

typedef struct reference_set {
  size_t count;
  carom_result *result;
  int64_t *steps; /* the reference's step counts, or NULL if the file has no such column */
} reference_set;

/* Loads `folder`/`name`. Complains and returns false if anything in it is wrong: this is our own
 * data. */
bool cases_load(const char *folder, const char *name, case_set *out);

/* Loads results for exactly the ids of `cases`, in that order. */
bool reference_load(const char *folder, const char *name, const case_set *cases,
                    reference_set *out);

/* The n numbers of a row behind its id; false if there are fewer. */
bool numbers_of(const record *row, size_t n, double number[]);

void cases_free(case_set *cases);
void reference_free(reference_set *reference);

#endif
