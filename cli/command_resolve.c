/* `carom resolve`: collisions from a CSV file, resolved, to a CSV file. */
#include "command.h"
#include "impacts.h"
#include "kernel.h"
#include "message.h"
#include "output.h"
#include "progress.h"

#include <csv.h>
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: carom resolve [OPTIONS] IN.csv\n\n"
    "Reads one collision a row and writes the state after it. IN.csv may be - for standard input.\n\n"
    "options:\n"
    "  --kernel NAME           how to compute (see `carom kernels`)\n"
    "  --config NAME           which build of a ladder kernel (see `carom kernels`; default: default)\n"
    "  --slip paper|pooltool   sign of the spin in the slip over the cloth: the 2014 paper's (default), or pooltool's\n"
    "  --steps N               steps of Euler's method, 1 or more (default 1000)\n"
    "  -o, --output OUT        file to write, - for standard output (default); a file appears whole or not at all\n"
    "  --summary               counts and time on standard error at the end\n"
    "  -h, --help              this text\n\n"
    "columns of IN.csv, by name in any order (others are ignored), SI units:\n"
    "  id                      optional; the number of the row if absent\n"
    "  r1x r1y r1z             centre of ball 1, m                       likewise r2x ... for ball 2\n"
    "  v1x v1y v1z             velocity, m/s; v1z must be 0\n"
    "  w1x w1y w1z             angular velocity, rad/s\n"
    "  R                       radius, m (or R1 and R2, which must be equal)\n"
    "  M                       mass, kg (or M1 and M2)\n"
    "  u_s1 u_s2               friction of each ball with the cloth, 0 to 1\n"
    "  u_b                     friction between the balls, 0 to 1\n"
    "  e_b                     restitution, 0 to 1\n\n"
    "columns written: id,v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z,status\n"
    "  status is ok, separating (the balls do not approach; their state is unchanged) or the name of an error, with nan\n"
    "  for the numbers.\n\n"
    "exit code: 0 if every row is ok or separating, 1 if some rows are in error (each is named on standard error, the\n"
    "others are resolved), 2 for bad usage or unreadable input\n";

enum { BLOCK = 1024 };

typedef struct resolve_job {
  const kernel *kernel;
  const ladder_module *module;
  carom_options options;
  impact_reader *in;
  FILE *out;
  long long ok, separating, errors;
  double solving; /* s */
} resolve_job;

typedef struct row_block {
  size_t count;
  impact_row row[BLOCK];
  carom_impact impact[BLOCK];
  carom_result result[BLOCK];
  uint8_t status[BLOCK];
} row_block;

/* Fills the block; false once the input has failed. */
static bool read_block(resolve_job *job, row_block *block, bool *more) {
  block->count = 0;
  read_result result = READ_ONE;
  while (block->count < BLOCK && (result = impact_next(job->in, &block->row[block->count])) == READ_ONE) {
    impact_row *row = &block->row[block->count];
    /* A row that could not be read is all zero to the solver, which refuses it; its own error is reported instead. */
    block->impact[block->count] = row->error == NULL ? row->impact : (carom_impact){0};
    block->count++;
  }
  *more = result == READ_ONE;
  return result != READ_FAILED;
}

static void report_row(const resolve_job *job, const impact_row *row, carom_status status) {
  const char *file = record_file_name(impact_records(job->in));
  if (row->error != NULL) {
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, row->id, row->message, row->error);
    return;
  }
  int field;
  if (carom_check(&row->impact, &job->options, &field) != CAROM_OK && field >= 0)
    complain("%s:%lld: id '%s': %s = %.17g: %s (%s)", file, row->line, row->id, impact_column(job->in, field),
             ((const double *)&row->impact)[field], carom_status_string(status), carom_status_name(status));
  else
    complain("%s:%lld: id '%s': %s (%s)", file, row->line, row->id, carom_status_string(status), carom_status_name(status));
}

static void write_id(FILE *out, const char *id) {
  if (strpbrk(id, ",\"\r\n") != NULL)
    csv_fwrite(out, id, strlen(id));
  else
    fputs(id, out);
}

static void write_row(resolve_job *job, const impact_row *row, const carom_result *result, carom_status status) {
  const bool bad = row->error != NULL || status < 0;
  const double *number = (const double *)result;
  write_id(job->out, row->id);
  for (int k = 0; k < 12; k++)
    if (bad)
      fputs(",nan", job->out);
    else
      fprintf(job->out, ",%.17g", number[k]);
  fprintf(job->out, ",%s\n", row->error != NULL ? row->error : carom_status_name(status));
  job->ok += !bad && status == CAROM_OK;
  job->separating += !bad && status == CAROM_SEPARATING;
  job->errors += bad;
}

/* Reads, resolves and writes block by block; false after a complaint. */
static bool resolve_all(resolve_job *job, row_block *block) {
  fputs("id,v1x,v1y,v1z,w1x,w1y,w1z,v2x,v2y,v2z,w2x,w2y,w2z,status\n", job->out);
  const record_reader *records = impact_records(job->in);
  for (bool more = true; more;) {
    if (!read_block(job, block, &more))
      return false;
    const double before = seconds_now();
    kernel_resolve(job->kernel, job->module, block->impact, block->count, &job->options, block->result, block->status);
    job->solving += seconds_now() - before;
    for (size_t k = 0; k < block->count; k++) {
      const carom_status status = carom_status_of_byte(block->status[k]);
      if (block->row[k].error != NULL || status < 0)
        report_row(job, &block->row[k], status);
      write_row(job, &block->row[k], &block->result[k], status);
      free(block->row[k].id);
    }
    const double share = record_bytes_total(records) > 0.0 ? record_bytes_read(records) / record_bytes_total(records) : -1.0;
    const double done = (double)(job->ok + job->separating + job->errors);
    progress_show("rows", done, share > 0.0 ? done / share : -1.0);
  }
  progress_clear();
  return true;
}

static int resolve_file(resolve_job *job, const char *in, const char *out, bool summary) {
  job->in = impact_open(in);
  if (job->in == NULL)
    return EXIT_USAGE;
  int code = EXIT_USAGE;
  row_block *block = malloc(sizeof *block);
  if (block == NULL)
    complain("out of memory");
  else if ((job->out = output_open(out)) != NULL) {
    if (!resolve_all(job, block))
      output_abandon();
    else if (output_commit())
      code = job->errors > 0 ? EXIT_SOME : EXIT_GOOD;
  }
  free(block);
  impact_close(job->in);
  if (summary && code != EXIT_USAGE) {
    const long long rows = job->ok + job->separating + job->errors, solved = job->ok > 0 ? job->ok : 1;
    fprintf(stderr, "%lld rows: %lld ok, %lld separating, %lld in error; %s took %.3g s, %.3g us per collision\n", rows,
            job->ok, job->separating, job->errors, job->kernel->name, job->solving, 1e6 * job->solving / (double)solved);
  }
  return code;
}

static bool parse_slip(const char *text, carom_slip *slip) {
  for (int k = 0; k < CAROM_SLIP_COUNT; k++)
    if (strcmp(text, carom_slip_name((carom_slip)k)) == 0) {
      *slip = (carom_slip)k;
      return true;
    }
  complain("--slip is paper or pooltool, not '%s'", text);
  return false;
}

static bool parse_steps(const char *text, int *steps) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || errno != 0 || value < 1 || value > 2147483647) {
    complain("--steps is a whole number from 1 to 2147483647, not '%s'", text);
    return false;
  }
  *steps = (int)value;
  return true;
}

int command_resolve(int argc, char **argv) {
  static const struct option options[] = {
      {"kernel", required_argument, NULL, 'k'}, {"config", required_argument, NULL, 'c'},
      {"slip", required_argument, NULL, 's'},   {"steps", required_argument, NULL, 'n'},
      {"output", required_argument, NULL, 'o'}, {"summary", no_argument, NULL, 'S'},
      {"help", no_argument, NULL, 'h'},         {0},
  };
  resolve_job job = {.kernel = kernel_at(0), .options = carom_default_options()};
  const char *out = "-", *config = NULL;
  bool summary = false;
  int option;
  while ((option = getopt_long(argc, argv, "o:h", options, NULL)) != -1)
    switch (option) {
    case 'k':
      job.kernel = kernel_find(optarg);
      if (job.kernel == NULL) {
        complain("no kernel '%s'; `carom kernels` lists them", optarg);
        return EXIT_USAGE;
      }
      break;
    case 'c':
      config = optarg;
      break;
    case 's':
      if (!parse_slip(optarg, &job.options.slip))
        return EXIT_USAGE;
      break;
    case 'n':
      if (!parse_steps(optarg, &job.options.steps))
        return EXIT_USAGE;
      break;
    case 'o':
      out = optarg;
      break;
    case 'S':
      summary = true;
      break;
    case 'h':
      fputs(help, stdout);
      return EXIT_GOOD;
    default:
      return usage_hint("resolve");
    }
  if (argc - optind != 1) {
    complain(optind == argc ? "resolve needs the name of a CSV file" : "resolve takes one CSV file, but got %d", argc - optind);
    return usage_hint("resolve");
  }
  if (!kernel_module(job.kernel, config, &job.module))
    return EXIT_USAGE;
  return resolve_file(&job, argv[optind], out, summary);
}
