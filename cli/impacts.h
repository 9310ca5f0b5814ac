/* Collisions from the columns of a CSV file.
 *
 * Columns are found by name, in any order; unknown ones are ignored. Needed: r1x r1y r1z v1x v1y v1z w1x w1y w1z, the same
 * with 2, R (or R1 and R2), M (or M1 and M2), u_s1 u_s2 u_b e_b. Optional: id; without it the number of the row is the id.
 */
#ifndef CAROM_CLI_IMPACTS_H
#define CAROM_CLI_IMPACTS_H

#include "carom.h"
#include "records.h"

enum { IMPACT_FIELDS = 26 };

typedef struct impact_reader impact_reader;

typedef struct impact_row {
  char *id;       /* grown as needed from row to row; the caller frees it in the end */
  size_t id_room; /* 0 with a NULL id at first */
  long long line;
  const char *error; /* NULL, or the name of what kept the row from being read, */
  char message[160]; /* and a sentence about it */
} impact_row;

/* Which numbers of a carom_impact the column of that name fills: bit k for number k, 0 for no such column. */
unsigned impact_fields(const char *name);

/* Opens `path`, "-" for stdin, and finds the columns; u_b may be missing if it is not `needed`, and is then 0. Complains and
 * returns NULL if the file or a column is missing. */
impact_reader *impact_open(const char *path, bool mu_ball_needed);

/* The next row, or READ_END; READ_FAILED after a complaint. `row` begins as all zero and may be used again; `*impact` is 0
 * throughout where the row could not be read. */
read_result impact_next(impact_reader *reader, impact_row *row, carom_impact *impact);

/* The name of the column that number `field` of a carom_impact comes from, as for carom_check(). */
const char *impact_column(const impact_reader *reader, int field);

const record_reader *impact_records(const impact_reader *reader);

void impact_close(impact_reader *reader);

#endif
