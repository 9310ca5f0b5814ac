/* Words that the command has of its own are those of the library. */
#include "options.h"
#include "support.h"

#include <string.h>

TEST(models_of_cushions) {
  char names[200] = "";
  for (int k = 0; carom_cushion_model_name((carom_cushion_model)k) != NULL; k++) {
    strcat(names, k > 0 ? "|" : "");
    strcat(names, carom_cushion_model_name((carom_cushion_model)k));
  }
  ck_assert_str_eq(names, CUSHION_WORDS);
}
