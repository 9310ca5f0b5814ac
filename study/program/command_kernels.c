/* `carom-lab kernels`: the table of kernels. */
#include "kernel.h"
#include "program/program.h"
#include "sheet.h"
#include "subcommands.h"

#include <csv.h>

typedef struct kernels_job {
  shared_options shared;
  bool csv;
} kernels_job;

FLAG(kernels_job, option_csv, "csv", csv,
     "as CSV: kernel,precision,parent,needs,paper,idea. The idea may be quoted. A solver has no "
     "parent. A kernel of the ladder needs scalar, avx2 or avx512. paper is the speedup in the "
     "seed paper, a number or words");

static const command_form form = {
    .name = "kernels",
    .usage = "[OPTIONS]",
    .about = "Lists the kernels that `resolve --kernel` takes and `verify` checks; the first is "
             "the default. The ladder has the seed paper's kernels, built by every compiler in "
             "every configuration: --config names both, such as gcc-o3, or only the configuration, "
             "for the first compiler in the list.\n",
    .options = (const option_row *const[]){&option_csv, &option_output, NULL},
    .details = "exit code: 0, or 2 for bad usage\n",
    .example = "carom-lab kernels",
};

/* The text for people lists the kernels that run here, and the builds of the ladder. */
static void print_kernels(FILE *out, bool csv) {
  sheet table;
  FILE *rows = sheet_begin(&table, out, csv);
  const kernel *candidate;
  fputs("kernel,precision,parent,needs,paper,idea\n", rows);
  for (size_t k = 0; (candidate = kernel_at(k)) != NULL; k++) {
    const ladder_rung *rung = NULL;
    if (candidate->is_rung)
      rung = ladder_rung_find(candidate->name);
    if (!csv && rung != NULL && !ladder_rung_runs(rung))
      continue;
    fprintf(rows, "%s,%s,", candidate->name, candidate->precision);
    if (rung != NULL)
      fprintf(rows, "%s,%s,%s,", rung->parent, ladder_isa_name(rung->isa), rung->paper);
    else
      fputs(",,,", rows);
    csv_fwrite(rows, candidate->text, strlen(candidate->text));
    fputc('\n', rows);
  }
  sheet_end(&table, rows);
  if (csv)
    return;
  fprintf(out, "\nconfigurations of the ladder:");
  const char *module;
  for (size_t k = 0; (module = ladder_module_name(k)) != NULL; k++)
    fprintf(out, " %s", module);
  char why[LADDER_WHY_SIZE] = "";
  if (ladder_module_name(0) == NULL)
    ladder_module_find("default", why);
  fprintf(out, "%s%s\n", text_if(why[0] != '\0', " none; "), why);
}

int command_kernels(int argc, char **argv) {
  kernels_job job = {0};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  FILE *out = output_open(job.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  print_kernels(out, job.csv);
  if (!output_commit())
    return EXIT_USAGE;
  return EXIT_GOOD;
}
