/* `carom resolve`: collisions from a CSV file, resolved, to a CSV file. */
#include "command.h"
#include "kernel.h"
#include "message.h"
#include "option.h"
#include "progress.h"
#include "sink.h"
#include "source.h"

#include <getopt.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: carom resolve [OPTIONS] IN\n\n"
    "Reads one collision a row and writes the state after it. IN is a CSV file, - for CSV on standard input, or a NumPy array\n"
    "IN.npy: float64 or float32, shape (n, 26), each row the numbers of carom_impact in their order.\n\n"
    "options:\n"
    "  --kernel NAME           how to compute (see `carom kernels`)\n"
    "  --config NAME           which build of a ladder kernel (see `carom kernels`; default: default)\n"
    "  --slip paper|pooltool   sign of the spin in the slip over the cloth: the 2014 paper's (default), or pooltool's\n"
    "  --steps N               steps of Euler's method, 1 or more (default 1000)\n"
    "  --friction LAW          friction between the balls by their slip speed instead of the column u_b: alciatore, which is\n"
    "                          mu = a + b exp(-c |u|) with the usual fit, or alciatore=a,b,c\n"
    "  --precision P           double or single (default: single for a float32 array, else double)\n"
    "  --threads N             most threads for solving; 0, the default: one for each processor\n"
    "  -o, --output OUT        file to write, - for standard output (default); a file appears whole or not at all. A name\n"
    "                          in .npy makes a NumPy array of shape (n, 12) in the precision, NaN for rows in error\n"
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

/* Blocks in flight: one being read, one being solved and written, one waiting. */
enum { BLOCKS = 3 };

typedef struct resolve_job {
  const kernel *kernel;
  const ladder_module *module;
  carom_options options;
  bool single; /* numbers are float from here on */
  bool by_law; /* friction between the balls follows the law, not the input */
  carom_speed_law law;
  row_source *in;
  result_sink *out;
  long long ok, separating, errors;
  double solving; /* s */

  /* The reading thread fills blocks, the main thread empties them, in turn. */
  source_block block[BLOCKS];
  read_result read[BLOCKS];
  sem_t empty, filled;
} resolve_job;

/* What the solver works on, where it is not the source's own memory; all in the precision of the job. */
typedef struct work_space {
  void *impact, *result;
  uint8_t *status;
} work_space;

static void *read_blocks(void *argument) {
  resolve_job *job = argument;
  for (size_t k = 0;; k = (k + 1) % BLOCKS) {
    sem_wait(&job->empty);
    job->read[k] = source_read(job->in, &job->block[k]);
    const bool last = job->read[k] != READ_ONE;
    sem_post(&job->filled);
    if (last)
      return NULL;
  }
}

static void apply_law(const resolve_job *job, size_t count, work_space *work) {
  for (size_t k = 0; k < count; k++)
    if (job->single) {
      carom_impact_f32 *narrow = &((carom_impact_f32 *)work->impact)[k];
      carom_impact wide;
      for (size_t field = 0; field < sizeof wide / sizeof(double); field++)
        ((double *)&wide)[field] = ((const float *)narrow)[field];
      narrow->mu_ball = (float)carom_mu_ball(&wide, job->law);
    } else {
      carom_impact *impact = &((carom_impact *)work->impact)[k];
      impact->mu_ball = carom_mu_ball(impact, job->law);
    }
}

/* The numbers of a block as the job wants them: in its precision, and with its friction. */
static const void *prepare(const resolve_job *job, const source_block *block, work_space *work) {
  const size_t numbers = block->count * sizeof(carom_impact) / sizeof(double);
  const bool from_single = source_is_single(job->in);
  if (from_single == job->single && !job->by_law)
    return block->impact;
  if (from_single == job->single)
    memcpy(work->impact, block->impact, numbers * (job->single ? sizeof(float) : sizeof(double)));
  else if (job->single)
    for (size_t k = 0; k < numbers; k++)
      ((float *)work->impact)[k] = (float)((const double *)block->impact)[k];
  else
    for (size_t k = 0; k < numbers; k++)
      ((double *)work->impact)[k] = ((const float *)block->impact)[k];
  if (job->by_law)
    apply_law(job, block->count, work);
  return work->impact;
}

static void solve_and_write(resolve_job *job, const source_block *block, work_space *work) {
  const void *impact = prepare(job, block, work);
  const double before = seconds_now();
  if (job->single)
    kernel_resolve_f32(job->kernel, impact, block->count, &job->options, work->result, work->status);
  else
    kernel_resolve(job->kernel, job->module, impact, block->count, &job->options, work->result, work->status);
  job->solving += seconds_now() - before;
  const size_t size = job->single ? sizeof(carom_result_f32) : sizeof(carom_result);
  for (size_t k = 0; k < block->count; k++) {
    const impact_row *row = block->row != NULL ? &block->row[k] : NULL;
    const char *error = row != NULL ? row->error : NULL;
    const carom_status status = carom_status_of_byte(work->status[k]);
    const bool bad = error != NULL || status < 0;
    if (bad)
      source_report(job->in, block, k, &job->options, status);
    sink_write(job->out, row != NULL ? row->id : NULL, (const char *)work->result + k * size, status, error);
    job->ok += !bad && status == CAROM_OK;
    job->separating += !bad && status == CAROM_SEPARATING;
    job->errors += bad;
  }
}

/* Reads in one thread, resolves and writes in this one; false after a complaint. */
static bool resolve_all(resolve_job *job, work_space *work) {
  pthread_t reader;
  sem_init(&job->empty, 0, BLOCKS);
  sem_init(&job->filled, 0, 0);
  if (pthread_create(&reader, NULL, read_blocks, job) != 0) {
    complain("cannot start the reading thread");
    return false;
  }
  read_result read;
  for (size_t k = 0;; k = (k + 1) % BLOCKS) {
    sem_wait(&job->filled);
    read = job->read[k];
    if (read != READ_ONE)
      break;
    solve_and_write(job, &job->block[k], work);
    sem_post(&job->empty);
    const double share = source_share(job->in), done = (double)(job->ok + job->separating + job->errors);
    progress_show("rows", done, share > 0.0 ? done / share : -1.0);
  }
  pthread_join(reader, NULL);
  progress_clear();
  return read == READ_END;
}

static void print_summary(const resolve_job *job) {
  const long long rows = job->ok + job->separating + job->errors;
  fprintf(stderr, "%lld rows: %lld ok, %lld separating, %lld in error; %s took %.3g s, %.3g us per collision\n", rows, job->ok,
          job->separating, job->errors, job->kernel->name, job->solving,
          1e6 * job->solving / (double)(job->ok > 0 ? job->ok : 1));
}

static int resolve_file(resolve_job *job, const char *out, bool summary) {
  int code = EXIT_USAGE;
  work_space work = {malloc(NPY_BLOCK * sizeof(carom_impact)), malloc(NPY_BLOCK * sizeof(carom_result)), malloc(NPY_BLOCK)};
  if (work.impact == NULL || work.result == NULL || work.status == NULL)
    complain("out of memory");
  else if ((job->out = sink_open(out, job->single)) != NULL) {
    if (!resolve_all(job, &work))
      sink_abandon(job->out);
    else if (sink_commit(job->out))
      code = job->errors > 0 ? EXIT_SOME : EXIT_GOOD;
  }
  free(work.impact);
  free(work.result);
  free(work.status);
  for (int k = 0; k < BLOCKS; k++)
    source_free_block(&job->block[k]);
  if (summary && code != EXIT_USAGE)
    print_summary(job);
  return code;
}

int command_resolve(int argc, char **argv) {
  static const struct option options[] = {
      {"kernel", required_argument, NULL, 'k'},
      {"config", required_argument, NULL, 'c'},
      {"slip", required_argument, NULL, 's'},
      {"steps", required_argument, NULL, 'n'},
      {"friction", required_argument, NULL, 'f'},
      {"precision", required_argument, NULL, 'p'},
      {"threads", required_argument, NULL, 't'},
      {"output", required_argument, NULL, 'o'},
      {"summary", no_argument, NULL, 'S'},
      {"help", no_argument, NULL, 'h'},
      {0},
  };
  resolve_job job = {.kernel = kernel_at(0), .options = carom_default_options()};
  const char *out = "-", *config = NULL;
  bool summary = false, precision_given = false;
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
      if (!option_slip(optarg, &job.options.slip))
        return EXIT_USAGE;
      break;
    case 'n':
      if (!option_steps(optarg, &job.options.steps))
        return EXIT_USAGE;
      break;
    case 'f':
      if (!option_law(optarg, &job.law))
        return EXIT_USAGE;
      job.by_law = true;
      break;
    case 't':
      if (!option_count("--threads", optarg, 0, &job.options.threads))
        return EXIT_USAGE;
      break;
    case 'p':
      if (!option_precision(optarg, &job.single))
        return EXIT_USAGE;
      precision_given = true;
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
    complain(optind == argc ? "resolve needs the name of a file" : "resolve takes one file, but got %d", argc - optind);
    return usage_hint("resolve");
  }
  if (!kernel_module(job.kernel, config, &job.module))
    return EXIT_USAGE;
  if (job.kernel->is_rung && job.single) {
    complain("the kernels of the ladder have a precision of their own; --precision is for the library's solvers");
    return EXIT_USAGE;
  }
  job.in = source_open(argv[optind], !job.by_law);
  if (job.in == NULL)
    return EXIT_USAGE;
  if (!precision_given)
    job.single = source_is_single(job.in) && !job.kernel->is_rung;
  const int code = resolve_file(&job, out, summary);
  source_close(job.in);
  return code;
}
