/* `carom-lab verify`: every kernel against the references, with a bound on each. */
#include "accuracy.h"
#include "cases.h"
#include "kernel.h"
#include "program/program.h"
#include "sheet.h"
#include "subcommands.h"

/* The sentence below the table about the ladder. */
typedef struct ladder_summary {
  size_t comparisons, pass;
  size_t pass_paper, most_over;      /* by the seed paper's criterion; cases above 1 % */
  double worst_double, worst_single; /* pair errors */
} ladder_summary;

/* One kernel in one build against one reference. */
typedef struct comparison {
  carom_slip slip;
  int steps;
  const char *reference;
  double bound;
  size_t refused; /* cases */
  bool pass;
} comparison;

/* How the library is called: pair by pair, or as a batch in the lanes of one instruction set. */
enum { SINGLE_CALLS = -1 };

typedef struct verification {
  shared_options shared;
  const kernel *only;
  const char *config;
  const char *folder;
  int way; /* SINGLE_CALLS or a carom_isa; of no meaning to the ladder */
  case_set cases;
  int steps; /* 0: the steps of the claims */
  carom_result *result;
  int8_t *status;
  pair_accuracy *each;
  FILE *out, *rows;
  bool csv, all_pass;
  char parity[1024]; /* sentences for below the table */
  ladder_summary ladder;
} verification;

/* The seed paper's count of cases at its number of steps, NA where it gives none. */
static void print_count(FILE *out, const kernel *candidate, int steps,
                        int (*count)(const ladder_rung *rung)) {
  int counted = -1;
  if (candidate->is_rung && steps == candidate->claims[0].steps)
    counted = count(ladder_rung_find(candidate->name));
  if (counted < 0)
    fputs(",NA", out);
  else
    fprintf(out, ",%d", counted);
}

static int count_1e3(const ladder_rung *rung) {
  return rung->over_1e3;
}

static int count_1e2(const ladder_rung *rung) {
  return rung->over_1e2;
}

static const char *verdict(bool pass) {
  if (pass)
    return "pass";
  return "fail";
}

static void print_claim(const verification *v, const kernel *candidate, const ladder_module *module,
                        const comparison *c, const accuracy_summary *s) {
  char lanes[32] = "";
  if (module == NULL && v->way != SINGLE_CALLS)
    snprintf(lanes, sizeof lanes, "-%s", carom_word(CAROM_WORDS_ISA, v->way));
  fprintf(v->rows, "%s,%s%s,%s,%d,%s,%zu,%zu,%zu,%.3g,%.3g,%.3g,%.3g,%.3g,%zu,%zu,%zu",
          candidate->name, config_name(module), lanes, carom_word(CAROM_WORDS_SLIP, (int)c->slip),
          c->steps, c->reference, s->cases, c->refused, s->identical, s->mean, s->median, s->p99,
          s->max, c->bound, s->component_1e3, s->component_1e2, s->strict_1e3);
  print_count(v->rows, candidate, c->steps, count_1e3);
  fprintf(v->rows, ",%zu", s->strict_1e2);
  print_count(v->rows, candidate, c->steps, count_1e2);
  fprintf(v->rows, ",%s,%s\n", verdict(c->pass), verdict(s->strict_1e2 == 0));
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
  fprintf(v->out,
          "\nby the seed paper's criterion, each component within 1 %% of pooltool's, %zu of %zu "
          "builds pass; the others fail in at most %zu of %zu cases\n",
          l->pass_paper, l->comparisons, l->most_over, v->cases.count);
}

static void count_in_ladder(verification *v, const kernel *candidate, const comparison *c,
                            const accuracy_summary *s) {
  ladder_summary *l = &v->ladder;
  double *worst = &l->worst_double;
  if (same_text(candidate->precision, "single"))
    worst = &l->worst_single;
  *worst = fmax(*worst, s->max);
  l->comparisons++;
  l->pass += c->pass;
  l->pass_paper += s->strict_1e2 == 0;
  if (s->strict_1e2 > l->most_over)
    l->most_over = s->strict_1e2;
}

/* A sentence about single calls of the library. */
static void tell_solver(verification *v, const kernel *candidate, const comparison *c,
                        const accuracy_summary *s) {
  const size_t used = strlen(v->parity);
  if (c->bound > 0.0)
    snprintf(v->parity + used, sizeof v->parity - used,
             "%s, %s slip: pair error against %s at most %.2g\n", candidate->name,
             carom_word(CAROM_WORDS_SLIP, (int)c->slip), c->reference, s->max);
  else
    snprintf(v->parity + used, sizeof v->parity - used,
             "%s: %zu of %zu cases bit-identical to %s\n", candidate->name, s->identical, s->cases,
             c->reference);
}

static void resolve_cases(verification *v, const kernel *candidate, const ladder_module *module,
                          const carom_options *options) {
  if (module != NULL || v->way != SINGLE_CALLS) {
    kernel_resolve(candidate, module, v->cases.impact, v->cases.count, options, v->result,
                   v->status);
    return;
  }
  for (size_t k = 0; k < v->cases.count; k++)
    v->status[k] = (int8_t)carom_collide(&v->cases.impact[k], options, &v->result[k]);
}

/* Compares the cases that the kernel solves; with other steps than the claim's it may reject some,
 * because its precision does not resolve a step. */
static void compare(verification *v, const kernel *candidate, const ladder_module *module,
                    comparison *c, const carom_result *reference) {
  size_t count = 0;
  for (size_t k = 0; k < v->cases.count; k++)
    if (v->status[k] != CAROM_ERROR_TOO_SLOW || c->steps == candidate->claims[0].steps)
      v->each[count++] = accuracy_of(&v->result[k], &reference[k], v->cases.impact[k].a.radius);
  c->refused = v->cases.count - count;
  if (count == 0)
    return;
  const accuracy_summary s = accuracy_summarise(v->each, count);
  c->pass = s.max <= c->bound;
  if (c->bound == 0.0)
    c->pass = s.identical == s.cases;
  v->all_pass &= c->pass;
  print_claim(v, candidate, module, c, &s);
  if (module != NULL)
    count_in_ladder(v, candidate, c, &s);
  else if (v->way == SINGLE_CALLS)
    tell_solver(v, candidate, c, &s);
}

/* pooltool's results with as many steps: from the library's Euler, which has its bits. */
static carom_result *solve_by_euler(const verification *v, const carom_options *options) {
  carom_options euler = *options;
  euler.solver = CAROM_SOLVER_EULER;
  carom_result *reference = allocate(v->cases.count, sizeof *reference);
  for (size_t k = 0; k < v->cases.count; k++)
    carom_collide(&v->cases.impact[k], &euler, &reference[k]);
  return reference;
}

static bool verify_claim(verification *v, const kernel *candidate, const ladder_module *module,
                         const kernel_claim *claim) {
  comparison c = {.slip = claim->slip, .steps = claim->steps, .reference = claim->reference};
  if (v->steps > 0) {
    c.steps = v->steps;
    c.reference = "euler";
  }
  c.bound = kernel_bound(claim->bound, claim, c.steps);
  const carom_options options = {.slip = c.slip, .steps = c.steps, .solver = candidate->solver};
  reference_set references = {0};
  if (v->steps > 0)
    references.result = solve_by_euler(v, &options);
  else if (!reference_load(v->folder, claim->reference, &v->cases, &references)) {
    reference_free(&references);
    return false;
  }
  resolve_cases(v, candidate, module, &options);
  compare(v, candidate, module, &c, references.result);
  reference_free(&references);
  return true;
}

static bool verify_module(verification *v, const kernel *candidate, const ladder_module *module) {
  for (const kernel_claim *claim = candidate->claims; claim->reference != NULL; claim++)
    if (!verify_claim(v, candidate, module, claim))
      return false;
  return true;
}

/* By single calls and in the lanes of every instruction set that this processor has; the sentences
 * are about single calls only.
 */
static bool verify_solver(verification *v, const kernel *candidate) {
  if (v->config != NULL)
    return true;
  bool good = verify_module(v, candidate, NULL);
  const carom_isa previous = carom_isa_in_force();
  for (int isa = 0; good && isa <= (int)previous; isa++)
    if (carom_isa_available((carom_isa)isa)) {
      carom_isa_limit((carom_isa)isa);
      v->way = isa;
      good = verify_module(v, candidate, NULL);
    }
  carom_isa_limit(previous);
  v->way = SINGLE_CALLS;
  return good;
}

/* In the one configuration given, or in all. */
static bool verify_config(verification *v, const kernel *candidate, const char *name) {
  const ladder_module *module;
  return kernel_module(candidate, name, &module) && verify_module(v, candidate, module);
}

static bool verify_rung(verification *v, const kernel *candidate) {
  if (!ladder_rung_runs(ladder_rung_find(candidate->name)))
    return true;
  if (v->config != NULL)
    return verify_config(v, candidate, v->config);
  const char *name;
  bool good = true;
  for (size_t k = 0; good && (name = ladder_module_name(k)) != NULL; k++)
    good = verify_config(v, candidate, name);
  return good;
}

/* With other steps Euler's method is the reference, and a kernel without steps has none. */
static bool is_compared(const verification *v, const kernel *candidate) {
  return v->steps == 0 || candidate->is_rung;
}

static bool verify_all(verification *v) {
  v->result = allocate(v->cases.count, sizeof *v->result);
  v->status = allocate(v->cases.count, sizeof *v->status);
  v->each = allocate(v->cases.count, sizeof *v->each);
  sheet table;
  v->rows = sheet_begin(&table, v->out, v->csv);
  fputs("kernel,config,slip,steps,reference,cases,refused,identical,mean,median,p99,max,bound,"
        "over_1e3,over_1e2,strict_1e3,paper_1e3,strict_1e2,paper_1e2,verdict,paper_verdict\n",
        v->rows);
  bool good = true;
  const kernel *candidate;
  for (size_t k = 0; good && (candidate = kernel_at(k)) != NULL; k++) {
    if ((v->only != NULL && v->only != candidate) || !is_compared(v, candidate))
      continue;
    if (candidate->is_rung)
      good = verify_rung(v, candidate);
    else
      good = verify_solver(v, candidate);
  }
  sheet_end(&table, v->rows);
  if (!v->csv) {
    fprintf(v->out, "\n%s", v->parity);
    tell_ladder(v);
  }
  return good;
}

OPTION(verification, option_kernel, "kernel", only, "NAME", set_kernel, 0, "only this kernel");
OPTION(verification, option_config, "config", config, "NAME", set_text, 0,
       "only this build of the ladder (see `carom-lab kernels`)");
OPTION(verification, option_other_steps, "steps", steps, "N", set_count, 1,
       "only the kernels of the ladder, with N steps, against the library's Euler with as many");
FLAG(verification, option_csv, "csv", csv, "as CSV; NA where the paper gives no count");

static const char about[] =
    "Solves the reference collisions with every kernel and compares the results with the "
    "references. The kernels of the ladder run in every configuration of every compiler. The "
    "solvers of the library run as single calls and in the lanes of every instruction set of this "
    "processor.\n";

static const char details[] =
    "Pair error: the largest deviation of a velocity or R times an angular velocity, over the "
    "largest such value of the pair; `verdict` compares it with the bound. A bound of 0 requires "
    "the same bits in every component. Component errors compare each number with itself: over_1e3 "
    "and over_1e2 count the cases with one above 0.1 % or 1 %, where numbers below 0.001 of the "
    "largest count as that; strict_1e3 and strict_1e2 count without this floor, as the seed paper "
    "does, and the next columns have the paper's own counts. `paper_verdict` is the paper's "
    "criterion: "
    "no case in strict_1e2.\n"
    "\n"
    "exit code: 0 if every kernel is within its bounds; 1 if some are not; 2 for bad usage or "
    "unreadable data\n";

static const command_form form = {
    .name = "verify",
    .usage = "[OPTIONS]",
    .about = about,
    .options =
        (const option_row *const[]){&option_data, &option_csv, &option_output, &option_kernel,
                                    &option_config, &option_other_steps, NULL},
    .details = details,
    .example = "carom-lab verify --kernel float",
};

int command_verify(int argc, char **argv) {
  verification v = {.way = SINGLE_CALLS, .all_pass = true};
  int code = parse_arguments(&form, argc, argv, &v, NULL);
  if (code >= 0)
    return code;
  /* A build that is not there, or a kernel of the ladder where no build is, would leave nothing
   * to verify. */
  const ladder_module *unused;
  const bool wants_rung =
      v.config != NULL || (v.only != NULL && v.only->is_rung && ladder_module_name(0) == NULL);
  const kernel *request = v.only;
  if (request == NULL)
    request = kernel_find(ladder_rung_at(0)->name);
  if (wants_rung && !kernel_module(request, v.config, &unused))
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
  free(v.status);
  free(v.each);
  cases_free(&v.cases);
  return code;
}
