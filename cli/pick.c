/* One collision out of a file. */
#include "pick.h"

#include "doubts.h"
#include "message.h"
#include "place.h"
#include "source.h"

#include <limits.h>
#include <string.h>

/* Adds an id to the text, with ", " between them, while there is room; counts what is left out. */
static void list_id(char *text, size_t room, const char *id, long long *left_out) {
  const size_t used = strlen(text);
  if (*left_out > 0 || used + strlen(id) + 3 > room)
    ++*left_out;
  else
    snprintf(text + used, room - used, "%s%s", used > 0 ? ", " : "", id);
}

/* Reads on to the row of that id, number k of the block; false after a complaint, which names those that are there. */
static bool find_row(row_source *source, const char *file, const char *id, source_block *block, size_t *k) {
  char there[400] = "", more[40] = "", number[24];
  long long left_out = 0;
  read_result result;
  while ((result = source_read(source, block)) == READ_ONE)
    for (*k = 0; *k < block->count; ++*k) {
      snprintf(number, sizeof number, "%zu", block->first + *k + 1);
      const char *own = block->row != NULL ? block->row[*k].id : number;
      if (strcmp(own, id) == 0)
        return true;
      list_id(there, sizeof there, own, &left_out);
    }
  if (left_out > 0)
    snprintf(more, sizeof more, " and %lld more", left_out);
  if (result == READ_END)
    complain("%s has no collision '%s'; it has %s%s", file, id, there[0] != '\0' ? there : "none at all", more);
  return false;
}

bool pick_impact(const shared_options *asked, const char *file, carom_impact *impact) {
  char path[PATH_MAX];
  size_t k;
  if (file == NULL) {
    snprintf(path, sizeof path, "%s/collisions-204.csv", data_folder(asked->folder));
    file = path;
  }
  row_source *source = source_open(file, !asked->friction.given);
  source_block block = {0};
  bool good = source != NULL && find_row(source, strcmp(file, "-") == 0 ? "standard input" : file, asked->id, &block, &k);
  if (good) {
    *impact = source_impact(source, &block, k);
    if (asked->friction.given)
      impact->mu_ball = carom_mu_ball(impact, asked->friction.law);
    const carom_status status = carom_check(impact, NULL, NULL);
    good = status == CAROM_OK && (block.row == NULL || block.row[k].error == NULL);
    doubts found = {0};
    const char *doubt = good ? doubts_about(&found, impact, true) : NULL;
    doubts_report(&found, source_name(source));
    if (asked->strict && doubt != NULL)
      good = false;
    if (!good)
      source_report(source, &block, k, NULL, status, doubt);
  }
  source_free_block(&block);
  source_close(source);
  return good;
}

void pick_describe(FILE *out, const shared_options *asked, const carom_impact *impact) {
  const carom_options *options = &asked->options;
  fprintf(out, "# collision: %s\n# slip: %s\n# steps: %d\n", asked->id, carom_slip_name(options->slip), options->steps);
  fprintf(out, "# friction between the balls: %.3g\n# friction of the cloth: %.3g and %.3g\n# restitution: %.3g\n",
          impact->mu_ball, impact->a.mu_cloth, impact->b.mu_cloth, impact->restitution);
}
