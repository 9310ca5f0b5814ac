/* Rows from a file, resolved, to a file.
 *
 * While one block of rows is solved and written, in the order of the file, another thread reads
 * the next.
 */
#include "rows/row_solver.h"

#include "program/program.h"
#include "rows/doubts.h"
#include "rows/precision.h"
#include "rows/sink.h"
#include "rows/source.h"

#include <pthread.h>

enum { MOST_NAMED = 1000 };             /* rows in error that are named */
static const double least_timed = 10e6; /* ns; less is mostly cold caches, and no time is told */

/* A block of the input, and how reading it ended. */
typedef struct reading {
  row_source *in;
  source_block block;
  read_result result;
} reading;

typedef struct run {
  const row_job *job;
  const shared_options *shared;
  const row_kind *kind;
  bool single;
  row_source *in;
  result_sink *out;
  long long ok, separating, errors;
  double solving; /* ns */
  doubts doubts;
  double *result;
  float *narrow, *narrow_result; /* rows and results in single precision */
  int8_t *status;
} run;

static void *read_block(void *argument) {
  reading *r = argument;
  r->result = source_read(r->in, &r->block);
  return NULL;
}

/* Writes row k of a block that has been solved, counts it, and says what is wrong with it. */
static void finish_row(run *r, const source_block *block, size_t k) {
  const row_note *note = row_note_of(block, k);
  const carom_status status = r->status[k];
  const size_t results = (size_t)r->kind->results;
  const double *row = source_row(r->in, block, k);
  double *result = r->result + k * results;
  /* What --strict refuses has no results. */
  const char *id = NULL, *error = NULL, *doubt = NULL;
  if (note != NULL) {
    id = note->id;
    error = note->error;
  }
  if (error == NULL && status >= 0)
    doubt = doubts_about(&r->doubts, r->kind, row);
  if (r->shared->strict && doubt != NULL) {
    error = doubt;
    memset(result, 0xff, results * sizeof *result); /* NaN throughout */
  }
  const bool in_error = error != NULL || status < 0;
  if (in_error && r->errors < MOST_NAMED)
    source_report(r->in, block, k, status, doubt);
  sink_write(r->out, id, row, result, status, error);
  r->ok += !in_error && status == CAROM_OK;
  r->separating += !in_error && status == CAROM_SEPARATING;
  r->errors += in_error;
}

static void solve_and_write(run *r, const source_block *block) {
  const size_t count = block->count, numbers = count * (size_t)r->kind->numbers,
               results = count * (size_t)r->kind->results;
  const bool narrow = r->single && r->kind->has_single;
  const void *in = block->numbers;
  void *out = r->result;
  if (narrow) {
    in = r->narrow;
    out = r->narrow_result;
  }
  /* Single precision: rows and results are rounded to it, whoever solves. */
  if (r->single)
    to_single(block->numbers, r->narrow, numbers);
  if (r->single && !narrow)
    to_double(r->narrow, block->numbers, numbers);
  const double start = clock_ns();
  if (r->job->solve != NULL)
    r->job->solve(r->job->context, &r->shared->options, narrow, in, count, out, r->status);
  else
    r->kind->solve(r->shared, narrow, in, count, out, r->status);
  r->solving += clock_ns() - start;
  if (r->single && !narrow)
    to_single(r->result, r->narrow_result, results);
  if (r->single)
    to_double(r->narrow_result, r->result, results);
  for (size_t k = 0; k < block->count; k++)
    finish_row(r, block, k);
}

/* Two readings take turns: one is solved and written while the other is filled. False after a
 * complaint. */
static bool resolve_all(run *r) {
  reading readings[2] = {{.in = r->in}, {.in = r->in}}, *current = &readings[0],
          *next = &readings[1];
  read_block(current);
  while (current->result == READ_ONE) {
    pthread_t reader;
    /* Where no thread can be started, the next block is read when this one is done. */
    const bool apart = pthread_create(&reader, NULL, read_block, next) == 0;
    solve_and_write(r, &current->block);
    if (apart)
      pthread_join(reader, NULL);
    else
      read_block(next);
    const double share = source_share(r->in), rows = (double)(r->ok + r->separating + r->errors);
    double duration = -1.0;
    if (share > 0.0)
      duration = rows / share;
    progress_show("rows", rows, duration);
    reading *const done = current;
    current = next;
    next = done;
  }
  progress_clear();
  if (r->errors > MOST_NAMED)
    complain("%lld more rows are in error; the column status says of each why",
             r->errors - MOST_NAMED);
  doubts_report(&r->doubts, r->kind->noun, source_name(r->in));
  source_free_block(&current->block);
  source_free_block(&next->block);
  return current->result == READ_END;
}

static void print_summary(const run *r) {
  fprintf(stderr, "%lld rows: %lld ok, %lld separating, %lld in error",
          r->ok + r->separating + r->errors, r->ok, r->separating, r->errors);
  if (r->solving >= least_timed)
    fprintf(stderr, "; %s took %.3g s, %.3g us per %s",
            r->job->solve != NULL ? r->job->solver : r->kind->name(r->shared), 1e-9 * r->solving,
            1e-3 * r->solving / (double)(r->ok > 0 ? r->ok : 1), r->kind->noun);
  fputc('\n', stderr);
}

int resolve_file(const row_job *job, const char *file) {
  run r = {.job = job,
           .shared = &job->shared,
           .kind = kind_of(&job->shared),
           .in = source_open(file, &job->shared)};
  int code = EXIT_USAGE;
  if (r.in == NULL)
    return code;
  const int precision = job->shared.precision;
  r.single =
      precision == SINGLE_PRECISION || (precision == ANY_PRECISION && source_is_single(r.in));
  r.result = allocate(NPY_BLOCK, (size_t)r.kind->results * sizeof *r.result);
  r.narrow = allocate(NPY_BLOCK, (size_t)r.kind->numbers * sizeof *r.narrow);
  r.narrow_result = allocate(NPY_BLOCK, (size_t)r.kind->results * sizeof *r.narrow_result);
  r.status = allocate(NPY_BLOCK, 1);
  /* Nothing is written before the input has been opened; what stands there appears when all is
   * written. */
  r.out = sink_open(&job->shared, r.single);
  if (r.out != NULL && sink_close(r.out, resolve_all(&r)))
    code = exit_of(r.errors == 0);
  free(r.narrow);
  free(r.narrow_result);
  free(r.result);
  free(r.status);
  source_close(r.in);
  if (job->shared.summary && code != EXIT_USAGE)
    print_summary(&r);
  return code;
}
