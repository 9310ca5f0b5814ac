/* `carom resolve --cushion`: impacts on cushions from a CSV file, resolved, as CSV. */
#include "command.h"
#include "cushion_rows.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "sink.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 4096, NUMBERS = sizeof(carom_motion) / sizeof(double) };

typedef struct run {
  cushion_reader *in;
  FILE *out;
  carom_cushion_options options;
  cushion_row *row;
  carom_cushion_impact *impact;
  carom_motion *motion;
  int8_t *status;
  long long errors;
} run;

static void write_row(run *r, size_t k) {
  const cushion_row *row = &r->row[k];
  const carom_status status = (carom_status)r->status[k];
  if (row->error != NULL || status < 0) {
    cushion_report(r->in, row, &r->options, status);
    r->errors++;
  }
  write_id(r->out, row->id);
  carom_motion motion = r->motion[k];
  for (int c = 0; c < NUMBERS && row->error != NULL; c++)
    ((double *)&motion)[c] = (double)NAN;
  write_numbers(r->out, (const double *)&motion, NUMBERS);
  fprintf(r->out, ",%s\n", row->error != NULL ? row->error : carom_status_name(status));
}

/* False after a complaint. */
static bool resolve_all(run *r) {
  read_result result = READ_ONE;
  fputs("id,vx,vy,vz,wx,wy,wz,status\n", r->out);
  while (result == READ_ONE) {
    size_t count = 0;
    while (count < BLOCK && (result = cushion_next(r->in, &r->row[count])) == READ_ONE) {
      r->impact[count] = r->row[count].impact;
      count++;
    }
    carom_cushion_batch(r->impact, count, &r->options, r->motion, r->status);
    for (size_t k = 0; k < count; k++)
      write_row(r, k);
  }
  return result == READ_END;
}

static const command_form form = {
    .name = "resolve --cushion",
    .usage = "[OPTIONS] IN",
    .about = "Reads one impact of a ball on a cushion a row and writes the motion after it. IN is a CSV file, - for standard "
             "input.\n",
    .options = (const option_row *const[]){&option_model, &option_convention, &option_law, &option_steps, &option_least_step,
                                           &option_threads, &option_output, NULL},
    .details = CUSHION_COLUMNS_HELP
    "columns written: id,vx,vy,vz,wx,wy,wz,status\n"
    "  status is ok, separating (the ball does not move into the cushion; its motion is unchanged) or the name of an error,\n"
    "  with nan for the numbers. Each number is the shortest text that reads back to the same double.\n\n"
    "exit code: 0 if every row is ok or separating, 1 if some rows are in error (each is named on standard error, the\n"
    "others are resolved), 2 for bad usage or unreadable input\n",
    .example = "carom resolve --cushion --model stronge -o after.csv before.csv",
    .files = ONE_FILE,
};

int cushion_resolve(int argc, char **argv) {
  cushion_job job = {.shared = {.options = COMMAND_OPTIONS, .output = "-"}};
  const char *file;
  int code = parse_arguments(&form, argc, argv, &job, &file);
  if (code >= 0)
    return code;
  run r = {.in = cushion_open(file), .options = cushion_options_of(&job)};
  code = EXIT_USAGE;
  if (r.in == NULL)
    return code;
  r.row = allocate(BLOCK, sizeof *r.row);
  r.impact = allocate(BLOCK, sizeof *r.impact);
  r.motion = allocate(BLOCK, sizeof *r.motion);
  r.status = allocate(BLOCK, 1);
  const carom_status bad = carom_cushion_check(&(carom_cushion_impact){0}, &r.options, &(int){0});
  if (bad == CAROM_ERROR_CUSHION_OPTIONS)
    complain("--least-step is a number of newton seconds, 0 or more");
  else if ((r.out = output_open(job.shared.output)) != NULL) {
    if (!resolve_all(&r))
      output_abandon();
    else if (output_commit())
      code = r.errors > 0 ? EXIT_SOME : EXIT_GOOD;
  }
  for (size_t k = 0; k < BLOCK; k++)
    free(r.row[k].id);
  free(r.row);
  free(r.impact);
  free(r.motion);
  free(r.status);
  cushion_close(r.in);
  return code;
}
