/* Collisions from a file, resolved, to a file.
 *
 * While one block of rows is solved and written, in the order of the file, another thread reads the next.
 */
#include "resolving.h"

#include "command.h"
#include "doubts.h"
#include "memory.h"
#include "message.h"
#include "monotonic.h"
#include "precision.h"
#include "sink.h"
#include "source.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char resolve_about[] =
    "Reads one collision a row and writes the state after it. IN is a CSV file, - for CSV on standard input, or a NumPy array\n"
    "IN.npy: float64 or float32, shape (n, 26), each row the numbers of carom_impact in their order. OUT is likewise CSV, or "
    "an\n"
    "array of shape (n, 12) in the precision if its name ends in .npy, with NaN for rows in error.\n";

const char resolve_details[] =
    "columns of IN.csv, by name in any order (others are ignored), SI units:\n"
    "  id                      optional; the number of the row if absent\n"
    "  r1x r1y r1z             centre of ball 1, m                       likewise r2x ... for ball 2\n"
    "  v1x v1y v1z             velocity, m/s; v1z must be 0\n"
    "  w1x w1y w1z             angular velocity, rad/s\n"
    "  R M                     radius, m, and mass, kg (or R1 and R2, which must be equal, and M1 and M2)\n"
    "  u_s1 u_s2               friction of each ball with the cloth, 0 to 1\n"
    "  u_b e_b                 friction between the balls, and restitution, 0 to 1\n\n"
    "columns written: id," RESULT_COLUMNS ",status\n"
    "  status is ok, separating (the balls do not approach; their state is unchanged) or the name of an error, with nan for "
    "the\n"
    "  numbers. Each number is the shortest text that reads back to the same double.\n\n"
    "with --derived also, nan unless the status is ok:\n"
    "  throw_deg               angle of ball 2's change of velocity from the line of centres, degrees, to the left from above\n"
    "  deflection_deg          angle by which ball 1 is turned at once, and deflection_rolling_deg once it rolls\n"
    "  roll1x roll1y           velocity of ball 1 once it rolls, m/s, and roll2x roll2y of ball 2\n"
    "  spin_transfer           ball 2's change of w2z over ball 1's w1z before; nan where that is 0\n"
    "  energy_lost             share of the kinetic energy that is lost, that of spins included\n\n"
    "exit code: 0 if every row is ok or separating, 1 if some rows are in error (each of the first thousand is named on\n"
    "standard error, the others are resolved), 2 for bad usage or unreadable input\n";

enum { MOST_NAMED = 1000 };             /* rows in error that are named */
static const double least_timed = 10e6; /* ns; less is mostly cold caches, and no time is told */

/* A block of the input, and how reading it ended. */
typedef struct reading {
  row_source *in;
  source_block block;
  read_result result;
} reading;

typedef struct run {
  const resolving *job;
  bool single; /* numbers are float from here on */
  row_source *in;
  result_sink *out;
  long long ok, separating, errors;
  double solving; /* ns */
  doubts doubts;
  /* What the solver works on, in the precision of the run. */
  void *impact, *result;
  int8_t *status;
} run;

static void *read_block(void *argument) {
  reading *r = argument;
  r->result = source_read(r->in, &r->block);
  return NULL;
}

/* The numbers of a block as the run wants them: in its precision, and with its friction. */
static void prepare(const run *r, const source_block *block) {
  const size_t numbers = block->count * IMPACT_FIELDS;
  const bool from_single = source_is_single(r->in);
  if (from_single == r->single)
    memcpy(r->impact, block->impact, numbers * (r->single ? sizeof(float) : sizeof(double)));
  else
    (r->single ? to_single : to_double)(block->impact, r->impact, numbers);
  for (size_t k = 0; k < block->count && r->job->shared.friction.given; k++) {
    const carom_impact impact = source_impact(r->in, block, k);
    const double mu = carom_mu_ball(&impact, r->job->shared.friction.law);
    if (r->single)
      ((carom_impact_f32 *)r->impact)[k].mu_ball = (float)mu;
    else
      ((carom_impact *)r->impact)[k].mu_ball = mu;
  }
}

static void solve_and_write(run *r, const source_block *block) {
  prepare(r, block);
  const double before = clock_ns();
  r->job->solve(r->job->context, &r->job->shared.options, r->single, r->impact, block->count, r->result, r->status);
  r->solving += clock_ns() - before;
  const size_t size = r->single ? sizeof(carom_result_f32) : sizeof(carom_result);
  for (size_t k = 0; k < block->count; k++) {
    const impact_row *row = block->row != NULL ? &block->row[k] : NULL;
    const char *error = row != NULL ? row->error : NULL;
    const carom_status status = r->status[k];
    const carom_impact impact = source_impact(r->in, block, k);
    const char *doubt = error == NULL && status >= 0 ? doubts_about(&r->doubts, &impact, true) : NULL;
    if (r->job->shared.strict && doubt != NULL) {
      error = doubt;
      memset((char *)r->result + k * size, 0xff, size); /* NaN throughout */
    }
    const bool bad = error != NULL || status < 0;
    if (bad && r->errors < MOST_NAMED)
      source_report(r->in, block, k, &r->job->shared.options, status, doubt);
    sink_write(r->out, row != NULL ? row->id : NULL, &impact, (const char *)r->result + k * size, status, error);
    r->ok += !bad && status == CAROM_OK;
    r->separating += !bad && status == CAROM_SEPARATING;
    r->errors += bad;
  }
}

/* Two readings take turns: one is solved and written while the other is filled. False after a complaint. */
static bool resolve_all(run *r) {
  reading readings[2] = {{.in = r->in}, {.in = r->in}}, *now = &readings[0], *next = &readings[1];
  for (read_block(now); now->result == READ_ONE; now = next, next = now == &readings[0] ? &readings[1] : &readings[0]) {
    pthread_t reader;
    /* Where no thread can be started, the next block is read when this one is done. */
    const bool apart = pthread_create(&reader, NULL, read_block, next) == 0;
    solve_and_write(r, &now->block);
    if (apart)
      pthread_join(reader, NULL);
    else
      read_block(next);
    const double share = source_share(r->in), rows = (double)(r->ok + r->separating + r->errors);
    progress_show("rows", rows, share > 0.0 ? rows / share : -1.0);
  }
  progress_clear();
  if (r->errors > MOST_NAMED)
    complain("%lld more rows are in error; the column status says of each why", r->errors - MOST_NAMED);
  doubts_report(&r->doubts, source_name(r->in));
  source_free_block(&now->block);
  source_free_block(&next->block);
  return now->result == READ_END;
}

static void print_summary(const run *r) {
  fprintf(stderr, "%lld rows: %lld ok, %lld separating, %lld in error", r->ok + r->separating + r->errors, r->ok, r->separating,
          r->errors);
  if (r->solving >= least_timed)
    fprintf(stderr, "; %s took %.3g s, %.3g us per collision", r->job->solver, 1e-9 * r->solving,
            1e-3 * r->solving / (double)(r->ok > 0 ? r->ok : 1));
  fputc('\n', stderr);
}

int resolve_file(const resolving *job, const char *file) {
  run r = {.job = job, .in = source_open(file, !job->shared.friction.given)};
  int code = EXIT_USAGE;
  if (r.in == NULL)
    return code;
  r.single = job->shared.precision == ANY_PRECISION ? source_is_single(r.in) : job->shared.precision == SINGLE_PRECISION;
  r.impact = allocate(NPY_BLOCK, sizeof(carom_impact));
  r.result = allocate(NPY_BLOCK, sizeof(carom_result));
  r.status = allocate(NPY_BLOCK, 1);
  r.out = sink_open(job->shared.output != NULL ? job->shared.output : "-", r.single, job->shared.derived);
  if (r.out != NULL && sink_close(r.out, resolve_all(&r)))
    code = r.errors > 0 ? EXIT_SOME : EXIT_GOOD;
  free(r.impact);
  free(r.result);
  free(r.status);
  source_close(r.in);
  if (job->shared.summary && code != EXIT_USAGE)
    print_summary(&r);
  return code;
}
