/* `carom-lab verify --cushion`: the exact limit against a reference, closed forms and Euler's steps against pooltool's records.
 */
#include "accuracy.h"
#include "cases.h"
#include "command.h"
#include "cushion_lab.h"
#include "draws.h"
#include "memory.h"
#include "message.h"
#include "reference.h"

#include "carom_shot.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_RECORDED = 4096, NUMBERS = 21, IN_NUMBERS = 15 };
static const double play_worst = 1e-6, any_worst = 1e-5, exact_median = 3e-9, record_worst = 1e-9, euler_worst = 1e-5;

/* The errors of one comparison. */
typedef struct comparison {
  const char *model, *reference;
  pair_accuracy *error;
  size_t count, left_out; /* compared; without a result of the reference, or whose result depends on pooltool's rounding */
  size_t unresolved;
  bool complete; /* none may be left out */
  double worst_bound, median_bound;
} comparison;

static bool print(FILE *out, bool csv, comparison *c) {
  const accuracy_summary a =
      c->count > 0 ? accuracy_summarise(c->error, c->count) : (accuracy_summary){.median = NAN, .p99 = NAN, .max = NAN};
  const bool pass =
      a.max <= c->worst_bound && a.median <= c->median_bound && c->unresolved == 0 && !(c->complete && c->left_out > 0);
  if (csv)
    fprintf(out, "%s,%s,%zu,%zu,%zu,%.3g,%.3g,%.3g,%.3g,%s\n", c->model, c->reference, c->count, c->left_out, c->unresolved,
            a.median, a.p99, a.max, c->worst_bound, pass ? "pass" : "fail");
  else
    fprintf(out, "%-9s %-27s %8zu %8zu %10zu %9.2g %9.2g %9.2g %7.1g  %s\n", c->model, c->reference, c->count, c->left_out,
            c->unresolved, a.median, a.p99, a.max, c->worst_bound, pass ? "pass" : "FAIL");
  return pass;
}

/* Against the reference of lab/stress. */
static bool against_reference(FILE *out, bool csv, cushion_draw kind, int draws, uint64_t seed, double done, double total) {
  comparison c = {.model = "mathavan",
                  .reference = kind == CUSHION_PLAY ? "reference: impacts of play" : "reference: any impacts",
                  .error = allocate((size_t)draws, sizeof *c.error),
                  .complete = true,
                  .worst_bound = kind == CUSHION_PLAY ? play_worst : any_worst,
                  .median_bound = exact_median};
  for (int k = 0; k < draws; k++) {
    const carom_cushion_impact in = draw_cushion(kind, seed, (uint64_t)k);
    carom_motion own, exact;
    const carom_status status = carom_cushion(&in, NULL, &own);
    progress_show("impacts", done + k, total);
    if (status != CAROM_OK)
      c.unresolved++;
    else if (reference_cushion(&in, &exact, NULL) != REFERENCE_OK)
      c.left_out++;
    else
      c.error[c.count++].pair = cushion_distance(&in, &own, &exact);
  }
  progress_clear();
  const bool pass = print(out, csv, &c);
  free(c.error);
  return pass;
}

/* A rolling ball slips on the cloth by rounding alone: pooltool's first step goes where its own rounding points. */
static bool depends_on_rounding(const carom_cushion_impact *in) {
  return hypot(in->v[0] - in->radius * in->w[1], in->v[1] + in->radius * in->w[0]) < 1e-9;
}

/* Against pooltool's records: numbers in the order of tools/cushion_events.py. False after a complaint. */
static bool recorded(FILE *out, bool csv, const char *folder, const char *name, carom_cushion_model model, bool *pass) {
  char path[PATH_MAX];
  const carom_cushion_options options = {.model = model, .convention = CAROM_CONVENTION_POOLTOOL, .least_step = 0.001};
  comparison c = {.model = carom_cushion_model_name(model),
                  .reference = name,
                  .error = allocate(MOST_RECORDED, sizeof *c.error),
                  .worst_bound = model == CAROM_CUSHION_EULER ? euler_worst : record_worst,
                  .median_bound = record_worst};
  snprintf(path, sizeof path, "%s/%s", folder, name);
  record_reader *records = record_open(path);
  record row;
  read_result result = records != NULL ? record_next(records, &row) : READ_FAILED; /* the header */
  while (result == READ_ONE && (result = record_next(records, &row)) == READ_ONE && c.count < MOST_RECORDED) {
    double number[NUMBERS];
    if (!numbers_of(&row, NUMBERS, number)) {
      complain("%s:%lld: not a recorded impact of %d numbers", path, row.line, NUMBERS);
      result = READ_FAILED;
      break;
    }
    carom_cushion_impact in;
    carom_motion after, own;
    memcpy(&in, number, sizeof in);
    memcpy(&after, number + IN_NUMBERS, sizeof after);
    if (model == CAROM_CUSHION_EULER && depends_on_rounding(&in)) {
      c.left_out++;
      continue;
    }
    c.unresolved += carom_cushion(&in, &options, &own) != CAROM_OK;
    c.error[c.count++].pair = cushion_distance(&in, &own, &after);
  }
  if (result != READ_FAILED)
    *pass &= print(out, csv, &c);
  free(c.error);
  record_close(records);
  return result != READ_FAILED;
}

bool cushion_verify(FILE *out, const char *folder, int draws, uint64_t seed, bool csv, bool *pass) {
  if (csv)
    fputs("model,reference,cases,left_out,unresolved,median,p99,max,bound,verdict\n", out);
  else
    fprintf(out, "%-9s %-27s %8s %8s %10s %9s %9s %9s %7s\n", "cushion", "reference", "cases", "left out", "unresolved",
            "median", "p99", "max", "bound");
  *pass &= against_reference(out, csv, CUSHION_PLAY, draws, seed, 0, 2 * draws);
  *pass &= against_reference(out, csv, CUSHION_ANY, draws, seed, draws, 2 * draws);
  return recorded(out, csv, folder, "cushion-stronge.csv", CAROM_CUSHION_STRONGE, pass) &&
         recorded(out, csv, folder, "cushion-mathavan2010.csv", CAROM_CUSHION_EULER, pass);
}
