/* `carom-lab verify`: every kernel against the references, with a bound on each. */
#include "accuracy.h"
#include "cases.h"
#include "kernel.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/output.h"
#include "program/place.h"
#include "program/words.h"
#include "sheet.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the sentence below the table says of the ladder. */
typedef struct ladder_summary {
  size_t comparisons, pass;
  double worst_double, worst_single; /* pair errors */
} ladder_summary;

/* How the library is called: pair by pair, or as a batch in the lanes of one instruction set. */
enum { SINGLE_CALLS = -1 };

typedef struct verification {
  shared_options shared;
  const kernel *only;
  const char *config;
  const char *folder;
  int way; /* SINGLE_CALLS or a carom_isa; of no meaning to the ladder */
  case_set cases;
  carom_result *result;
  pair_accuracy *each;
  FILE *out, *rows;
  bool csv, all_pass;
  char parity[1024]; /* sentences for below the table */
  ladder_summary ladder;
} verification;

static void print_claim(const verification *v, const kernel *one, const ladder_module *module,
                        const kernel_claim *claim, const accuracy_summary *s, bool pass) {
  char lanes[32] = "", over_1e3[32] = "NA", over_1e2[32] = "NA"; /* counts of the seed paper */
  if (module == NULL && v->way != SINGLE_CALLS)
    snprintf(lanes, sizeof lanes, "-%s", carom_isa_name((carom_isa)v->way));
  if (one->is_rung) {
    const ladder_rung *rung = ladder_rung_find(one->name);
    if (rung->over_1e3 >= 0)
      snprintf(over_1e3, sizeof over_1e3, "%d", rung->over_1e3);
    if (rung->over_1e2 >= 0)
      snprintf(over_1e2, sizeof over_1e2, "%d", rung->over_1e2);
  }
  fprintf(v->rows, "%s,%s%s,%s,%d,%s,%zu,%zu,%.3g,%.3g,%.3g,%.3g,%.3g,%zu,%s,%zu,%s,%s\n",
          one->name, config_name(module), lanes, carom_slip_name(claim->slip), claim->steps,
          claim->reference, s->cases, s->identical, s->mean, s->median, s->p99, s->max,
          claim->bound, s->component_1e3, over_1e3, s->component_1e2, over_1e2,
          (const char *[]){"fail", "pass"}[pass]);
}

static void tell_ladder(const verification *v) {
  const ladder_summary *l = &v->ladder;
  if (l->comparisons == 0)
    return;
  fprintf(v->out,
          "ladder: %zu of %zu builds of its kernels within their bounds; largest pair error "
          "against pooltool",
          l->pass, l->comparisons);
  if (l->worst_double > 0.0)
    fprintf(v->out, " %.2g in double precision%s", l->worst_double,
            text_if(l->worst_single > 0.0, ","));
  if (l->worst_single > 0.0)
    fprintf(v->out, " %.2g in single", l->worst_single);
  fputc('\n', v->out);
}

static bool verify_claim(verification *v, const kernel *one, const ladder_module *module,
                         const kernel_claim *claim) {
  reference_set reference;
  const bool loaded = reference_load(v->folder, claim->reference, &v->cases, &reference);
  if (loaded) {
    carom_options options = {0};
    options.slip = claim->slip;
    options.steps = claim->steps;
    if (module == NULL && v->way == SINGLE_CALLS) {
      options.solver = one->solver;
      for (size_t k = 0; k < v->cases.count; k++)
        carom_collide(&v->cases.impact[k], &options, &v->result[k]);
    } else
      kernel_resolve(one, module, v->cases.impact, v->cases.count, &options, v->result, NULL);
    for (size_t k = 0; k < v->cases.count; k++)
      v->each[k] = accuracy_of(&v->result[k], &reference.result[k], v->cases.impact[k].a.radius);
    const accuracy_summary s = accuracy_summarise(v->each, v->cases.count);
    bool pass = s.max <= claim->bound;
    if (claim->bound == 0.0)
      pass = s.identical == s.cases;
    v->all_pass &= pass;
    print_claim(v, one, module, claim, &s, pass);
    if (module != NULL) {
      double *worst = &v->ladder.worst_double;
      if (strcmp(one->precision, "single") == 0)
        worst = &v->ladder.worst_single;
      *worst = fmax(*worst, s.max);
      v->ladder.comparisons++;
      v->ladder.pass += pass;
    } else if (v->way == SINGLE_CALLS) {
      const size_t used = strlen(v->parity);
      if (claim->bound > 0.0)
        snprintf(v->parity + used, sizeof v->parity - used,
                 "%s, %s slip: pair error against %s at most %.2g\n", one->name,
                 carom_slip_name(claim->slip), claim->reference, s.max);
      else
        snprintf(v->parity + used, sizeof v->parity - used,
                 "%s: %zu of %zu cases bit-identical to %s\n", one->name, s.identical, s.cases,
                 claim->reference);
    }
  }
  reference_free(&reference);
  return loaded;
}

static bool verify_module(verification *v, const kernel *one, const ladder_module *module) {
  for (const kernel_claim *claim = one->claims; claim->reference != NULL; claim++)
    if (!verify_claim(v, one, module, claim))
      return false;
  return true;
}

/* By single calls and in the lanes of every instruction set that this processor has; the
 * sentences tell of single calls only.
 */
static bool verify_solver(verification *v, const kernel *one) {
  if (v->config != NULL)
    return true;
  bool good = verify_module(v, one, NULL);
  const carom_isa before = carom_isa_in_force();
  for (int isa = 0; good && isa <= (int)before; isa++)
    if (carom_isa_available((carom_isa)isa)) {
      carom_isa_limit((carom_isa)isa);
      v->way = isa;
      good = verify_module(v, one, NULL);
    }
  carom_isa_limit(before);
  v->way = SINGLE_CALLS;
  return good;
}

/* In the one configuration given, or in all. */
static bool verify_config(verification *v, const kernel *one, const char *name) {
  const ladder_module *module;
  return kernel_module(one, name, &module) && verify_module(v, one, module);
}

static bool verify_rung(verification *v, const kernel *one) {
  if (!ladder_rung_runs(ladder_rung_find(one->name)))
    return true;
  if (v->config != NULL)
    return verify_config(v, one, v->config);
  const char *name;
  bool good = true;
  for (size_t k = 0; good && (name = ladder_module_name(k)) != NULL; k++)
    good = verify_config(v, one, name);
  return good;
}

static bool verify_all(verification *v) {
  v->result = allocate(v->cases.count, sizeof *v->result);
  v->each = allocate(v->cases.count, sizeof *v->each);
  sheet table;
  v->rows = sheet_begin(&table, v->out, v->csv);
  fputs("kernel,config,slip,steps,reference,cases,identical,mean,median,p99,max,bound,over_1e3,"
        "paper_1e3,over_1e2,paper_1e2,verdict\n",
        v->rows);
  bool good = true;
  const kernel *one;
  for (size_t k = 0; good && (one = kernel_at(k)) != NULL; k++) {
    if (v->only != NULL && v->only != one)
      continue;
    if (one->is_rung)
      good = verify_rung(v, one);
    else
      good = verify_solver(v, one);
  }
  sheet_end(&table, v->rows);
  if (!v->csv) {
    fprintf(v->out, "\n%s", v->parity);
    tell_ladder(v);
  }
  return good;
}

OPTION(verification, option_kernel, "kernel", only, 0, "NAME", set_kernel, 0, "only this kernel");
OPTION(verification, option_config, "config", config, 0, "NAME", set_text, 0,
       "only this build of the ladder (see `carom-lab kernels`)");
OPTION(verification, option_csv, "csv", csv, 0, NULL, set_flag, 0,
       "as CSV; NA where the paper gives no count");

static const char about[] =
    "Solves the reference collisions with every kernel and compares the results with the "
    "references. The kernels of the ladder run in every configuration of every compiler. The "
    "solvers of the library run as single calls and in the lanes of every instruction set of this "
    "processor.\n";

static const char details[] =
    "Pair error: the largest deviation of a velocity or R times an angular velocity, over the "
    "largest such value of the pair. Component errors compare each number with itself; the columns "
    "over_1e3 and over_1e2 count the cases with one above 0.1 % or 1 %, and the next columns are "
    "the seed paper's own counts. A bound of 0 requires the same bits in every component.\n"
    "\n"
    "exit code: 0 if every kernel is within its bounds; 1 if some are not; 2 for bad usage or "
    "unreadable data\n";

static const command_form form = {
    .name = "verify",
    .usage = "[OPTIONS]",
    .about = about,
    .options = (const option_row *const[]){&option_data, &option_csv, &option_output,
                                           &option_kernel, &option_config, NULL},
    .details = details,
    .example = "carom-lab verify --kernel float",
};

int command_verify(int argc, char **argv) {
  verification v = {.shared.output = "-", .way = SINGLE_CALLS, .all_pass = true};
  int code = parse_arguments(&form, argc, argv, &v, NULL);
  if (code >= 0)
    return code;
  /* A build that is not there, or a kernel of the ladder where no build is, would leave nothing
   * to verify. */
  const ladder_module *unused;
  const bool wants_rung =
      v.config != NULL || (v.only != NULL && v.only->is_rung && ladder_module_name(0) == NULL);
  const kernel *wanted = v.only;
  if (wanted == NULL)
    wanted = kernel_find(ladder_rung_at(0)->name);
  if (wants_rung && !kernel_module(wanted, v.config, &unused))
    return EXIT_USAGE;
  v.folder = data_folder(v.shared.folder);
  code = EXIT_USAGE;
  if (cases_load(v.folder, "collisions-204.csv", &v.cases) &&
      (v.out = output_open(v.shared.output)) != NULL) {
    if (!verify_all(&v))
      output_abandon();
    else if (output_commit())
      code = exit_of(v.all_pass);
  }
  free(v.result);
  free(v.each);
  cases_free(&v.cases);
  return code;
}
