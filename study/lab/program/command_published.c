/* `carom-lab published`: study/lab/published.py, which compares the values of data/measured.csv
 * with carom's, and study/lab/film.py, which does so with filmed shots. It reads carom's headers
 * and calls the shared library. */
#include "program/program.h"
#include "python.h"
#include "subcommands.h"

#include <limits.h>

typedef struct published_job {
  shared_options shared;
  bool csv, cushions;
  const char *film;
} published_job;

FLAG(published_job, published_csv, "csv", csv,
     "as CSV: quantity,published,low,high,unit,carom,error,verdict,conditions,source");
FLAG(published_job, published_cushions, "cushions", cushions,
     "instead: tables of the cushions of pool and snooker (study/lab/cushions.py), which take a "
     "minute");

OPTION(
    published_job, published_film, "film", film, "FILM.csv", set_text, 0,
    "instead: filmed shots, rows shot,ball,t,x,y (data/README.md), compared with carom's, and the "
    "constants of snooker that they determine (study/lab/film.py); half a minute for 21 shots");

static const command_form form = {
    .name = "published",
    .usage = "[OPTIONS]",
    .about = "Prints values that others measured or stated (data/measured.csv) next to carom's "
             "values. The verdict is low or high if carom's value is outside the bounds of the "
             "source. A fraction of breaks is counted in 1600 breaks, and has its standard error. "
             "docs/understanding/published.md explains the table.\n",
    .options = (const option_row *const[]){&option_data, &published_csv, &published_cushions,
                                           &published_film, &option_output, NULL},
    .details = "exit code: 0; 1 if a value that measured.csv calls ok is outside its bounds; 2 "
               "for bad usage or unreadable data\n",
    .example = "carom-lab published --csv -o published.csv",
};

int command_published(int argc, char **argv) {
  published_job job = {.shared = {.options = COMMAND_OPTIONS}};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  const char *module = "study.lab.published", *needs = "jinja2 pycparser";
  if (job.cushions)
    module = "study.lab.cushions";
  char measured[PATH_MAX];
  snprintf(measured, sizeof measured, "%s/measured.csv", data_folder(job.shared.folder));
  const char *input = measured;
  if (job.film != NULL) {
    module = "study.lab.film";
    needs = "jinja2 numpy pycparser";
    input = job.film;
  }
  const char *const words[] = {LAB_LIBRARY, input, text_if(job.csv, "csv"), NULL};
  return python_command(needs, module, words, job.shared.output);
}
