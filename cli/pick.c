/* Some rows out of a file. */
#include "pick.h"

#include "doubts.h"
#include "memory.h"
#include "message.h"
#include "place.h"
#include "source.h"

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

/* Those asked for, and which of them have been met. */
typedef struct search {
  const shared_options *asked;
  const char *const *id;
  size_t count, found;
  double (*row)[MOST_NUMBERS];
  bool *there, good;
} search;

/* Row k of the block is number `which` of those asked for. */
static void take(search *s, row_source *source, const source_block *block, size_t k, size_t which) {
  const row_kind *kind = kind_of(s->asked);
  double *row = s->row[which];
  memcpy(row, source_row(source, block, k), (size_t)kind->numbers * sizeof *row);
  const carom_status status = kind->check(row, s->asked, NULL);
  bool good = status == CAROM_OK && (block->note == NULL || block->note[k].error == NULL);
  /* What hardly was meant is warned of, or refused. */
  doubts found = {0};
  const char *doubt = good ? doubts_about(&found, kind, row) : NULL;
  doubts_report(&found, kind->noun, source_name(source));
  good &= !(s->asked->strict && doubt != NULL);
  if (!good)
    source_report(source, block, k, status, doubt);
  s->there[which] = true;
  s->found++;
  s->good &= good;
}

/* False after a complaint, which names the ids that are there. */
static bool find_rows(search *s, row_source *source, source_block *block) {
  const char *noun = kind_of(s->asked)->noun;
  char there[400] = "", more[40] = "", number[24];
  long long left_out = 0;
  read_result result = READ_ONE;
  while (s->found < s->count && (result = source_read(source, block)) == READ_ONE)
    for (size_t k = 0; k < block->count && s->found < s->count; k++) {
      snprintf(number, sizeof number, "%zu", block->first + k + 1);
      const char *own = block->note != NULL ? block->note[k].id : number;
      for (size_t which = 0; which < s->count; which++)
        if (!s->there[which] && strcmp(own, s->id[which]) == 0)
          take(s, source, block, k, which);
      list_id(there, sizeof there, own, &left_out);
    }
  if (left_out > 0)
    snprintf(more, sizeof more, " and %lld more", left_out);
  for (size_t which = 0; which < s->count && result == READ_END; which++)
    if (!s->there[which]) {
      complain("%s has no %s '%s'; it has %s%s", source_name(source), noun, s->id[which],
               there[0] != '\0' ? there : "none at all", more);
      break;
    }
  return s->found == s->count && s->good;
}

bool pick_rows(const shared_options *asked, const char *file, const char *const *id, size_t count,
               double (*row)[MOST_NUMBERS]) {
  char path[PATH_MAX];
  if (file == NULL && asked->cushion) {
    complain("--cushion needs the name of a file: the reference cases are collisions of two balls");
    return false;
  }
  if (file == NULL) {
    snprintf(path, sizeof path, "%s/collisions-204.csv", data_folder(asked->folder));
    file = path;
  }
  row_source *source = source_open(file, asked);
  source_block block = {0};
  search s = {.asked = asked, .id = id, .count = count, .row = row, .good = true};
  s.there = allocate(count, sizeof *s.there);
  const bool good = source != NULL && find_rows(&s, source, &block);
  free(s.there);
  source_free_block(&block);
  source_close(source);
  return good;
}
