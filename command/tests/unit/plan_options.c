/* Options of `carom plan` are those of the library. */
#include "program/options.h"
#include "support.h"

#include "carom_plan.h"

#include <string.h>

TEST(options_of_plans_are_those_of_the_library) {
  const option_row for_all = {.part = CAROM_PART_PLAN_OPTIONS};
  option_row rows[MOST_OF_LIBRARY];
  const int count = rows_of(&for_all, rows);
  carom_plan_options options = {0};
  const carom_number *n;
  int keys = 0;
  for (int k = 0; (n = carom_number_of(CAROM_PART_PLAN_OPTIONS, k)) != NULL; k++)
    keys += n->key[0] != '\0';
  ck_assert_int_eq(count, keys);
  char *field = (char *)&options, shots[] = "300", seed[] = "9007199254740992", few[] = "99",
       half[] = "0.5", beyond[] = "9007199254740994", more[] = "1.5";
  for (int k = 0; k < count; k++) {
    const bool share = strcmp(rows[k].name, "unsure") == 0,
               whole = !share && strcmp(rows[k].name, "seconds") != 0;
    ck_assert(rows[k].set(&rows[k], half, field + rows[k].field) != whole);
    ck_assert((whole || share) != rows[k].set(&rows[k], more, field + rows[k].field));
    if (strcmp(rows[k].name, "shots") == 0)
      ck_assert(rows[k].set(&rows[k], shots, field + rows[k].field) &&
                !rows[k].set(&rows[k], few, field + rows[k].field));
    if (strcmp(rows[k].name, "seed") == 0)
      ck_assert(rows[k].set(&rows[k], seed, field + rows[k].field) &&
                !rows[k].set(&rows[k], beyond, field + rows[k].field));
  }
  ck_assert(options.shots == 300 && options.seed == (uint64_t)1 << 53 && options.unsure == 0.5 &&
            options.seconds == 1.5);
}
