/* One collision out of a file. */
#include "pick.h"

#include "cases.h"
#include "impacts.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { IDS_SHOWN = 400 }; /* bytes of the list of those that are there */

typedef struct id_list {
  char text[IDS_SHOWN];
  long long count, left_out;
} id_list;

static void add_id(id_list *list, const char *id) {
  const size_t used = strlen(list->text);
  if (list->left_out > 0 || used + strlen(id) + 3 > sizeof list->text)
    list->left_out++;
  else
    snprintf(list->text + used, sizeof list->text - used, "%s%s", used > 0 ? ", " : "", id);
  list->count++;
}

static void complain_of_absence(const char *file, const char *id, const id_list *list) {
  if (list->count == 0)
    complain("%s has no collision '%s': it has none at all", file, id);
  else if (list->left_out > 0)
    complain("%s has no collision '%s'; it has %s and %lld more", file, id, list->text, list->left_out);
  else
    complain("%s has no collision '%s'; it has %s", file, id, list->text);
}

/* The row of that id; false after a complaint. */
static bool find_row(impact_reader *reader, const char *id, impact_row *row) {
  id_list there = {0};
  read_result result;
  while ((result = impact_next(reader, row)) == READ_ONE) {
    if (strcmp(row->id, id) == 0)
      return true;
    add_id(&there, row->id);
  }
  if (result == READ_END)
    complain_of_absence(record_file_name(impact_records(reader)), id, &there);
  return false;
}

static bool check_row(const impact_reader *reader, const pick *asked, impact_row *row) {
  const char *file = record_file_name(impact_records(reader));
  if (row->error != NULL) {
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, row->id, row->message, row->error);
    return false;
  }
  if (asked->by_law)
    row->impact.mu_ball = carom_mu_ball(&row->impact, asked->law);
  int field;
  const carom_status status = carom_check(&row->impact, NULL, &field);
  if (status != CAROM_OK && field >= 0)
    complain("%s:%lld: id '%s': %s = %.17g: %s (%s)", file, row->line, row->id, impact_column(reader, field),
             ((const double *)&row->impact)[field], carom_status_string(status), carom_status_name(status));
  else if (status != CAROM_OK)
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, row->id, carom_status_string(status), carom_status_name(status));
  return status == CAROM_OK;
}

bool pick_impact(const pick *asked, carom_impact *impact) {
  char path[4096];
  const char *file = asked->file;
  if (file == NULL) {
    snprintf(path, sizeof path, "%s/collisions-204.csv", cases_folder(asked->folder));
    file = path;
  }
  impact_reader *reader = impact_open(file, !asked->by_law);
  if (reader == NULL)
    return false;
  impact_row row = {0};
  const bool good = find_row(reader, asked->id, &row) && check_row(reader, asked, &row);
  *impact = row.impact;
  free(row.id);
  impact_close(reader);
  return good;
}

static bool add_solver(const char *name, carom_solver solvers[], int *count) {
  for (int k = 0; k < CAROM_SOLVER_COUNT; k++) {
    if (strcmp(name, carom_solver_name((carom_solver)k)) != 0)
      continue;
    for (int other = 0; other < *count; other++)
      if (solvers[other] == (carom_solver)k)
        return true;
    solvers[(*count)++] = (carom_solver)k;
    return true;
  }
  return false;
}

bool pick_solvers(const char *text, carom_solver solvers[CAROM_SOLVER_COUNT], int *count) {
  char *copy = strdup(text), *rest = NULL;
  *count = 0;
  bool good = copy != NULL;
  for (char *name = good ? strtok_r(copy, ",", &rest) : NULL; name != NULL && good; name = strtok_r(NULL, ",", &rest))
    good = add_solver(name, solvers, count);
  free(copy);
  if (!good || *count == 0)
    complain("--kernel is exact, euler, or both as exact,euler: the library's solvers, not '%s'", text);
  return good && *count > 0;
}

void pick_describe(FILE *out, const pick *asked, const carom_impact *impact, const carom_options *options) {
  fprintf(out, "# collision: %s\n# slip: %s\n# steps: %d\n", asked->id, carom_slip_name(options->slip), options->steps);
  fprintf(out, "# friction between the balls: %.3g\n# friction of the cloth: %.3g and %.3g\n# restitution: %.3g\n",
          impact->mu_ball, impact->a.mu_cloth, impact->b.mu_cloth, impact->restitution);
}
