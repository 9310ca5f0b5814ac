/* `carom-lab paper`: study/paper.py, which measures what the seed paper claims, or takes it from a
 * report, and judges each claim. */
#include "program/program.h"
#include "python.h"
#include "subcommands.h"

typedef struct paper_job {
  shared_options shared;
  const char *source;
  double budget;
  bool csv, matrix;
  const char *record;
} paper_job;

OPTION(paper_job, paper_source, "from", source, "DIR", set_text, 0,
       "measure nothing: judge the CSV files of this report, such as build/results/report");
OPTION(
    paper_job, paper_budget, "budget", budget, "SECONDS", set_amount, 0,
    "how long to time the kernels (default 60); counting their operations takes additional time");
FLAG(paper_job, paper_csv, "csv", csv,
     "as CSV: the columns of study/claims.csv without its measure and direction, then "
     "here,uncertainty,verdict,cause");

OPTION(paper_job, paper_record, "record", record, "NAME", set_text, 0,
       "add this run to study/machines.csv and verdicts.csv under that name of the machine, and to "
       "the tables of docs/study/paper.md; a run of the same machine, compiler and target is "
       "replaced");
FLAG(paper_job, paper_matrix, "matrix", matrix,
     "build and judge every installed clang from 14 on, and gcc, each for -march=native and for "
     "-march=znver2: a column each. The budget is for each column");

static const command_form form = {
    .name = "paper",
    .usage = "[OPTIONS]",
    .about =
        "Judges the claims of the seed paper, in the order of its sections (study/claims.csv): the "
        "paper's value, the limits between which the claim holds, the value of this run, and "
        "whether the claim holds, is indistinguishable from its limit, is weaker, does not hold "
        "here, or is not measurable here. If it does not hold, the causes that apply to this run "
        "are named. The table ends with sentences that compare the paper's best kernel with the "
        "best of this run.\n",
    .options = (const option_row *const[]){&paper_source, &paper_budget, &paper_csv, &paper_record,
                                           &paper_matrix, &option_output, NULL},
    .details = "study/paper.py explains the verdicts and the limits at its head, and "
               "study/causes.csv has the causes with what they are tested by.\n"
               "\n"
               "exit code: 0; 1 if a file of the run could not be measured; 2 for bad usage\n",
    .example = "carom-lab paper --from build/results/report",
};

int command_paper(int argc, char **argv) {
  paper_job job = {.shared = {.options = COMMAND_OPTIONS}, .budget = 60.0};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  char budget[32];
  snprintf(budget, sizeof budget, "%.17g", job.budget);
  const char *words[12] = {"--build", STUDY_BUILD, "--budget", budget};
  size_t count = 4;
  if (job.csv)
    words[count++] = "--csv";
  if (job.matrix)
    words[count++] = "--matrix";
  python_option(words, "--from", job.source);
  python_option(words, "--record", job.record);
  return python_command("jinja2", "study.paper", words, job.shared.output);
}
