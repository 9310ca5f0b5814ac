/* Batches: collisions by the exact limit, sorted by the collocation step that they need next.
 *
 * Every row has the bits of carom_collide: its steps are decided by its own numbers, and
 * computed lane by lane. The lists only decide which rows share a register.
 *
 *     first       all rows in order, a register at a time: reduced, and solved if an easy step
 *                 does, which is most of them
 *     lists       rows that need another step, by its kind: from their start, where their
 *                 numbers are enough, as the rows are in the cache; or from where they stand
 *     one by one  rows that collocation rejects or that are not good: carom_collide_one(), which
 *                 tries collocation again, and then the precise solver
 *
 * A list is worked off when it fills a register, and all of them at the end. Batches of few rows
 * would leave most lanes empty: they are solved one by one, and so are all rows by Euler's
 * method. */
#include "ball_ball/arguments.h"
#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "platform/promise.h"
#include "platform/threads.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Rows wait for a register of their kind, so a list rarely holds two. More room would take
 * stack. */
enum { ROOM = 2 * MOST_LANES };

/* Where the rows of a list are. */
enum { AT_START, ON_THEIR_WAY, PLACES };

typedef struct row_list {
  int count;
  uint32_t row[ROOM];
} row_list;

/* Rows, few enough for 32 bits. */
typedef struct work {
  const carom_kernels *with;
  carom_precision precision;
  const char *in;
  char *out;
  size_t in_size, out_size;
  const carom_options *opt;
  double s;
  int8_t *status;
  size_t first_bad;
  row_list list[STEP_KINDS][PLACES];
  union {
    float single_numbers[LANE_COLUMNS][ROOM];
    double double_numbers[LANE_COLUMNS][ROOM / 2];
  } state[STEP_KINDS]; /* of rows on their way, as in their list */
} work;

/* Twice the lanes. */
static int room_of(const work *w) {
  return w->precision == CAROM_F64 ? ROOM / 2 : ROOM;
}

/* The state of a row on its way, between its position in a list and a lane. */
static void put_state(work *w, enum step_kind kind, int place, lane_state lanes, int lane) {
  if (w->precision == CAROM_F64)
    for (int c = 0; c < LANE_COLUMNS; c++)
      w->state[kind].double_numbers[c][place] = lanes[c].double_numbers[lane];
  else
    for (int c = 0; c < LANE_COLUMNS; c++)
      w->state[kind].single_numbers[c][place] = lanes[c].single_numbers[lane];
}
static void take_state(const work *w, enum step_kind kind, int place, lane_state lanes, int lane) {
  if (w->precision == CAROM_F64)
    for (int c = 0; c < LANE_COLUMNS; c++)
      lanes[c].double_numbers[lane] = w->state[kind].double_numbers[c][place];
  else
    for (int c = 0; c < LANE_COLUMNS; c++)
      lanes[c].single_numbers[lane] = w->state[kind].single_numbers[c][place];
}
/* The same for all lanes, of rows consecutively. */
static void take_states(const work *w, enum step_kind kind, int first, int lanes,
                        lane_state gathered) {
  const size_t numbers = (size_t)lanes;
  if (w->precision == CAROM_F64)
    for (int c = 0; c < LANE_COLUMNS; c++)
      memcpy(gathered[c].double_numbers, w->state[kind].double_numbers[c] + first,
             numbers * sizeof(double));
  else
    for (int c = 0; c < LANE_COLUMNS; c++)
      memcpy(gathered[c].single_numbers, w->state[kind].single_numbers[c] + first,
             numbers * sizeof(float));
}

enum { MOST_ROWS = 1 << 30, CACHE_LINE = 64 };

static void one_by_one(work *w, uint32_t row) {
  const carom_status status =
      carom_collide_one(w->precision, w->in + row * w->in_size, w->opt, w->out + row * w->out_size);
  if (w->status != NULL)
    w->status[row] = (int8_t)status;
  if (status < 0 && row < w->first_bad)
    w->first_bad = row;
}

/* A list that has no room, which should not happen, is no reason to fail: a single call has the
 * same bits. */
static void add_row(work *w, enum step_kind kind, int place, uint32_t row, lane_state lanes,
                    int lane) {
  row_list *list = &w->list[kind][place];
  if (list->count == room_of(w)) {
    one_by_one(w, row);
    return;
  }
  if (place == ON_THEIR_WAY)
    put_state(w, kind, list->count, lanes, lane);
  list->row[list->count++] = row;
}

/* Rows that share a register: `count` of them; the other lanes repeat the last. */
typedef struct lane_group {
  int count;
  uint32_t row[MOST_LANES];
} lane_group;

/* Data between steps and rows. */
typedef struct step_io {
  row_context context;
  step_inputs in;
  step_outputs out;
  lanes_by_step next;
} step_io;

/* Lanes, from the lowest on. */
#define EACH_LANE(lane, bits)                                                     \
  for (uint32_t left_ = (bits), lane; left_ != 0 && (lane = lowest(left_), true); \
       left_ &= left_ - 1)
static inline uint32_t lowest(uint32_t bits) {
  return (uint32_t)__builtin_ctz(bits);
}

/* After a step: writes the rows that are solved, and puts the others on the lists of their next
 * steps. Rows that are not solved yet may be written too, for now. */
static void sort(work *w, const lane_group *t, uint32_t good, const step_io *h, int place,
                 lane_state gathered) {
  const uint32_t present = (uint32_t)((UINT64_C(1) << t->count) - 1), right = present & good;
  uint32_t done = right & h->next[SOLVED];
  if (done != 0)
    done &= w->with->rows_out[w->precision](&h->context, h->out, w->out, t->row);
  for (int kind = 0; kind < STEP_KINDS; kind++) {
    const uint32_t lanes = right & h->next[kind];
    done |= lanes;
    EACH_LANE(lane, lanes)
    add_row(w, (enum step_kind)kind, place, t->row[lane], gathered, (int)lane);
  }
  EACH_LANE(lane, present & ~done) one_by_one(w, t->row[lane]);
}

/* Not inlined, nor is next_steps(): only one of their frames is on the stack at a time. */
__attribute__((noinline)) static void first_steps(work *w, const lane_group *t) {
  step_io h;
  const uint32_t good = w->with->rows_in[w->precision](w->in, t->row, w->s, &h.context, h.in);
  w->with->first_step[w->precision](h.in, good, 2.5 * w->s, carom_tolerances[w->precision], h.out,
                                    h.next);
  sort(w, t, good, &h, AT_START, NULL);
}

__attribute__((noinline)) static void next_steps(work *w, enum step_kind kind, int place,
                                                 const lane_group *t, lane_state lanes) {
  step_io h;
  const uint32_t good = w->with->rows_in[w->precision](w->in, t->row, w->s, &h.context, h.in);
  w->with->next_step[w->precision](kind, place == AT_START, h.in, 2.5 * w->s,
                                   carom_tolerances[w->precision], lanes, h.out, h.next);
  sort(w, t, good, &h, ON_THEIR_WAY, lanes);
}

/* Takes up to a register's worth of rows off the end of a list, and their steps. */
static void work_off(work *w, enum step_kind kind, int place) {
  row_list *list = &w->list[kind][place];
  const int lanes = w->with->lanes[w->precision];
  lane_state gathered;
  lane_group t = {.count = list->count < lanes ? list->count : lanes};
  CAROM_PROMISE(t.count >= 1 && t.count <= lanes);
  list->count -= t.count;
  for (int lane = 0; lane < lanes; lane++)
    t.row[lane] = list->row[list->count + (lane < t.count ? lane : t.count - 1)];
  if (place == ON_THEIR_WAY && t.count == lanes)
    take_states(w, kind, list->count, lanes, gathered);
  else if (place == ON_THEIR_WAY)
    for (int lane = 0; lane < lanes; lane++)
      take_state(w, kind, list->count + (lane < t.count ? lane : t.count - 1), gathered, lane);
  next_steps(w, kind, place, &t, gathered);
}

/* Works off every list that holds at least so many rows. Returns whether there was one. */
static bool work_off_lists(work *w, int least) {
  bool any = false;
  for (int kind = 0; kind < STEP_KINDS; kind++)
    for (int place = 0; place < PLACES; place++)
      for (; w->list[kind][place].count >= least; any = true)
        work_off(w, (enum step_kind)kind, place);
  return any;
}

/* Rows that 32 bits can count. */
static size_t solve_part(carom_precision precision, const char *in, size_t n,
                         const carom_options *opt, char *out, int8_t *status) {
  work w; /* its lists are not cleared: that would take longer than a few rows do */
  w.with = carom_kernels_of_call(opt->plain);
  w.precision = precision;
  w.in = in;
  w.out = out;
  w.in_size = carom_impact_size(precision);
  w.out_size = carom_result_size(precision);
  w.opt = opt;
  w.s = carom_spin_sign(opt->slip);
  w.status = status;
  w.first_bad = n;
  if (opt->solver == CAROM_SOLVER_EULER || n < w.with->fewest[precision]) {
    for (uint32_t row = 0; row < n; row++)
      one_by_one(&w, row);
    return w.first_bad;
  }

  /* empty lists; then a register of rows after the other, whose steps fill them */
  for (int kind = 0; kind < STEP_KINDS; kind++)
    w.list[kind][AT_START].count = w.list[kind][ON_THEIR_WAY].count = 0;
  if (status != NULL)
    memset(status, CAROM_OK, n * sizeof *status); /* rows that no step solves get their own */
  const size_t lanes = (size_t)w.with->lanes[precision], register_size = lanes * w.in_size,
               size = n * w.in_size;
  for (size_t first = 0; first < n; first += lanes) {
    /* the data of two registers later, while there is work to hide it */
    const size_t ahead = (first + 2 * lanes) * w.in_size,
                 end = ahead + register_size < size ? ahead + register_size : size;
    for (size_t offset = ahead; offset < end; offset += CACHE_LINE)
      __builtin_prefetch(w.in + offset);

    /* lanes beyond the last row repeat it */
    lane_group t;
    t.count = n - first < lanes ? (int)(n - first) : (int)lanes;
    for (uint32_t lane = 0; lane < MOST_LANES; lane++)
      t.row[lane] = (uint32_t)first + (lane < (uint32_t)t.count ? lane : (uint32_t)t.count - 1);
    first_steps(&w, &t);
    work_off_lists(&w, (int)lanes);
  }

  /* what is left on the lists, fewer than a register each */
  while (work_off_lists(&w, 1)) {
  }
  return w.first_bad;
}

/* A batch as threads see it. */
typedef struct batch {
  carom_precision precision;
  const char *in;
  char *out;
  int8_t *status;
  const carom_options *opt;
} batch;

/* Pairs from `first` on; returns the first in error, or `end`. */
static size_t solve_rows(const void *job, size_t first, size_t end) {
  const batch *b = job;
  size_t first_bad = end;
  for (size_t start = first; start < end; start += MOST_ROWS) {
    const size_t rows = end - start < MOST_ROWS ? end - start : MOST_ROWS;
    const size_t error_row =
        solve_part(b->precision, b->in + start * carom_impact_size(b->precision), rows, b->opt,
                   b->out + start * carom_result_size(b->precision),
                   b->status != NULL ? b->status + start : NULL);
    if (error_row < rows && first_bad == end)
      first_bad = start + error_row;
  }
  return first_bad;
}

/* Fewer pairs than this are not worth a thread: about 50 us of work, some times the cost of
 * starting one. */
static size_t least_part(const carom_options *opt) {
  const size_t exact = 4096, least = 4, euler = 4000 / (size_t)carom_steps(opt);
  if (opt->solver != CAROM_SOLVER_EULER)
    return exact;
  return euler > least ? euler : least;
}

static carom_status collide_batch(carom_precision precision, const void *in, size_t n,
                                  const carom_options *opt, void *out, int8_t *status) {
  const carom_options defaults = {0};
  if (opt == NULL)
    opt = &defaults;
  carom_status error = carom_check_options(opt);
  if (error == CAROM_OK && n > 0 && (in == NULL || out == NULL))
    error = CAROM_ERROR_NULL;
  if (error != CAROM_OK || n == 0)
    return error;
  const batch job = {.precision = precision, .in = in, .out = out, .status = status, .opt = opt};
  const size_t first_bad = carom_in_threads(solve_rows, &job, n, opt->threads, least_part(opt));
  if (first_bad == n)
    return CAROM_OK;
  /* The threads only returned its index; resolving the pair again returns its status. */
  carom_result unused;
  return carom_collide_one(precision, job.in + first_bad * carom_impact_size(precision), opt,
                           &unused);
}

carom_status carom_collide_batch(const carom_impact *in, size_t n, const carom_options *opt,
                                 carom_result *out, int8_t *status) {
  return collide_batch(carom_precision_of(opt), in, n, opt, out, status);
}

carom_status carom_collide_batch_f32(const carom_impact_f32 *in, size_t n, const carom_options *opt,
                                     carom_result_f32 *out, int8_t *status) {
  return collide_batch(CAROM_F32, in, n, opt, out, status);
}
