/* One collision out of a file. */
#include "pick.h"

#include "doubts.h"
#include "memory.h"
#include "message.h"
#include "place.h"
#include "source.h"
#include "suggest.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Adds an id to the text, with ", " between them, while there is room; counts what is left out. */
static void list_id(char *text, size_t room, const char *id, long long *left_out) {
  const size_t used = strlen(text);
  if (*left_out > 0 || used + strlen(id) + 3 > room)
    ++*left_out;
  else
    snprintf(text + used, room - used, "%s%s", used > 0 ? ", " : "", id);
}

/* Whether two ids have the same digits, so that mistyping one made the other. */
static bool same_digits(const char *a, const char *b) {
  static const char digits[] = "0123456789";
  for (;; a++, b++) {
    a += strcspn(a, digits);
    b += strcspn(b, digits);
    if (*a != *b || *a == '\0')
      return *a == *b;
  }
}

/* Those asked for, and which of them have been met. */
typedef struct search {
  const shared_options *asked;
  const char *const *id;
  size_t count, found;
  carom_impact *impact;
  bool *there, good;
  char (*meant)[64]; /* for each, an id that may have been meant, or "" */
} search;

/* Row k of the block is number `which` of those asked for. */
static void take(search *s, row_source *source, const source_block *block, size_t k, size_t which) {
  carom_impact *impact = &s->impact[which];
  *impact = source_impact(source, block, k);
  if (s->asked->friction.given)
    impact->mu_ball = carom_mu_ball(impact, s->asked->friction.law);
  const carom_status status = carom_check(impact, NULL, NULL);
  bool good = status == CAROM_OK && (block->row == NULL || block->row[k].error == NULL);
  doubts found = {0};
  const char *doubt = good ? doubts_about(&found, impact, true) : NULL;
  doubts_report(&found, source_name(source));
  good &= !(s->asked->strict && doubt != NULL);
  if (!good)
    source_report(source, block, k, NULL, status, doubt);
  s->there[which] = true;
  s->found++;
  s->good &= good;
}

/* False after a complaint, which names the ids that are there. */
static bool find_rows(search *s, row_source *source, source_block *block) {
  char there[400] = "", more[40] = "", number[24];
  long long left_out = 0;
  read_result result = READ_ONE;
  while (s->found < s->count && (result = source_read(source, block)) == READ_ONE)
    for (size_t k = 0; k < block->count && s->found < s->count; k++) {
      snprintf(number, sizeof number, "%zu", block->first + k + 1);
      const char *own = block->row != NULL ? block->row[k].id : number;
      for (size_t which = 0; which < s->count; which++)
        if (!s->there[which] && strcmp(own, s->id[which]) == 0)
          take(s, source, block, k, which);
        else if (s->meant[which][0] == '\0' && resembles(s->id[which], own) && same_digits(s->id[which], own))
          snprintf(s->meant[which], sizeof s->meant[which], "%s", own);
      list_id(there, sizeof there, own, &left_out);
    }
  if (left_out > 0)
    snprintf(more, sizeof more, " and %lld more", left_out);
  for (size_t which = 0; which < s->count && result == READ_END; which++)
    if (!s->there[which]) {
      if (s->meant[which][0] != '\0')
        complain("%s has no collision '%s'; is '%s' meant?", source_name(source), s->id[which], s->meant[which]);
      else
        complain("%s has no collision '%s'; it has %s%s", source_name(source), s->id[which],
                 there[0] != '\0' ? there : "none at all", more);
      break;
    }
  return s->found == s->count && s->good;
}

bool pick_impacts(const shared_options *asked, const char *file, const char *const *id, size_t count, carom_impact *impact) {
  char path[PATH_MAX];
  if (file == NULL) {
    snprintf(path, sizeof path, "%s/collisions-204.csv", data_folder(asked->folder));
    file = path;
  }
  row_source *source = source_open(file, !asked->friction.given);
  source_block block = {0};
  search s = {.asked = asked, .id = id, .count = count, .impact = impact, .good = true};
  s.there = allocate(count, sizeof *s.there);
  s.meant = allocate(count, sizeof *s.meant);
  const bool good = source != NULL && find_rows(&s, source, &block);
  free(s.there);
  free(s.meant);
  source_free_block(&block);
  source_close(source);
  return good;
}

bool pick_impact(const shared_options *asked, const char *file, carom_impact *impact) {
  return pick_impacts(asked, file, &asked->id, 1, impact);
}

void pick_describe(FILE *out, const shared_options *asked, const carom_impact *impact) {
  const carom_options *options = &asked->options;
  fprintf(out, "# collision: %s\n# slip: %s\n# steps: %d\n", asked->id, carom_slip_name(options->slip), options->steps);
  fprintf(out, "# friction between the balls: %.3g\n# friction of the cloth: %.3g and %.3g\n# restitution: %.3g\n",
          impact->mu_ball, impact->a.mu_cloth, impact->b.mu_cloth, impact->restitution);
}
