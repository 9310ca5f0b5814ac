/* A batch by the exact limit: collisions sorted by the collocation step that they need next.
 *
 * Every row is n calls of carom_collide, bit for bit: its steps are decided by its own numbers, and computed lane by lane. What
 * the lists below decide is only which rows share a register.
 *
 *     first   all rows in order, a register at a time: reduced, and solved if an easy step does; most are
 *     fresh   rows that need another kind of step at first, by kind: their numbers only, as the rows are in the cache
 *     moving  rows on their way, with where they stand
 *     one by one  what collocation refuses, and rows that are not good: carom_collide_one(), which goes the same way again, and
 *             then on to the fallback
 *
 * A list is worked off when it fills a register, and all of them at the end. */
#include "ball_ball/batch.h"

#include "ball_ball/frame.h"

#include <stdbool.h>
#include <string.h>

/* Rows wait for a register of their kind, so a list rarely holds two. More room would take stack. */
enum { ROOM = 2 * MOST_LANES };

typedef struct fresh_list {
  int count;
  uint32_t row[ROOM];
} fresh_list;

typedef struct moving_list {
  int count;
  uint32_t row[ROOM];
  float state[ROOM][MOVING_COLUMNS];
} moving_list;

/* A stretch of rows; few enough for 32 bits. */
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
  fresh_list fresh[STEP_KINDS];
  moving_list moving[STEP_KINDS];
} work;

enum { MOST_ROWS = 1 << 30, CACHE_LINE = 64 };

static void one_by_one(work *w, uint32_t row) {
  const carom_status status = carom_collide_one(w->precision, w->in + row * w->in_size, w->opt, w->out + row * w->out_size);
  if (w->status != NULL)
    w->status[row] = (int8_t)status;
  if (status < 0 && row < w->first_bad)
    w->first_bad = row;
}

/* A list that has no room, which should not happen, is no reason to fail: a single call has the same bits. */
static void add_fresh(work *w, enum step_kind kind, uint32_t row) {
  fresh_list *list = &w->fresh[kind];
  if (list->count == ROOM)
    one_by_one(w, row);
  else
    list->row[list->count++] = row;
}

static void add_moving(work *w, enum step_kind kind, uint32_t row, carom_moving moving, int lane) {
  moving_list *list = &w->moving[kind];
  if (list->count == ROOM) {
    one_by_one(w, row);
    return;
  }
  for (int c = 0; c < MOVING_COLUMNS; c++)
    list->state[list->count][c] = moving[c][lane];
  list->row[list->count++] = row;
}

/* Rows that share a register: `count` of them, the rest of the lanes repeating the last. */
typedef struct team {
  int count;
  uint32_t row[MOST_LANES];
  const void *from[MOST_LANES];
  void *to[MOST_LANES];
} team;

static void gather(const work *w, team *t) {
  for (int lane = 0; lane < w->with->lanes; lane++) {
    const uint32_t row = t->row[lane < t->count ? lane : t->count - 1];
    t->from[lane] = w->in + row * w->in_size;
    t->to[lane] = w->out + row * w->out_size;
  }
}

/* After a step: writes the rows that are solved, and puts the others where they belong. `stands`: those that have a state in
 * *moving. Rows that are not solved yet are written too, for now. */
static void sort(work *w, const team *t, uint32_t good, const carom_context *context, carom_out out, carom_moving moving,
                 bool all_move, const uint8_t next[MOST_LANES]) {
  const uint32_t finite = w->with->rows_out[w->precision](context, out, t->to);
  for (int lane = 0; lane < t->count; lane++) {
    const uint32_t row = t->row[lane];
    const enum step_kind kind = next[lane];
    if ((good >> lane & 1) == 0 || kind == REFUSED || (kind == SOLVED && (finite >> lane & 1) == 0))
      one_by_one(w, row);
    else if (kind != SOLVED) {
      if (all_move || moving[MOVING_CAUTION][lane] > 0)
        add_moving(w, kind, row, moving, lane);
      else
        add_fresh(w, kind, row);
    } else if (w->status != NULL)
      w->status[row] = CAROM_OK;
  }
}

/* Not inlined, nor are next_steps(): only one of their frames is on the stack at a time. */
__attribute__((noinline)) static void first_steps(work *w, team *t) {
  carom_context context;
  carom_in in;
  carom_out out;
  carom_moving moving;
  uint8_t next[MOST_LANES];
  gather(w, t);
  memset(moving[MOVING_CAUTION], 0, sizeof moving[MOVING_CAUTION]);
  const uint32_t good = w->with->rows_in[w->precision](t->from, w->s, &context, in);
  w->with->first_step(in, (float)(2.5 * w->s), carom_tolerances[w->precision], out, moving, next);
  sort(w, t, good, &context, out, moving, false, next);
}

__attribute__((noinline)) static void next_steps(work *w, enum step_kind kind, bool fresh, team *t, carom_moving moving) {
  carom_context context;
  carom_in in;
  carom_out out;
  uint8_t next[MOST_LANES];
  gather(w, t);
  const uint32_t good = w->with->rows_in[w->precision](t->from, w->s, &context, in);
  w->with->next_step(kind, fresh, in, (float)(2.5 * w->s), carom_tolerances[w->precision], moving, out, next);
  sort(w, t, good, &context, out, moving, true, next);
}

/* Takes up to a register's worth off the end of a list. */
static void work_off_fresh(work *w, enum step_kind kind) {
  fresh_list *list = &w->fresh[kind];
  carom_moving moving;
  team t = {.count = list->count < w->with->lanes ? list->count : w->with->lanes};
  list->count -= t.count;
  memcpy(t.row, list->row + list->count, (size_t)t.count * sizeof t.row[0]);
  next_steps(w, kind, true, &t, moving);
}

static void work_off_moving(work *w, enum step_kind kind) {
  moving_list *list = &w->moving[kind];
  carom_moving moving;
  team t = {.count = list->count < w->with->lanes ? list->count : w->with->lanes};
  list->count -= t.count;
  memcpy(t.row, list->row + list->count, (size_t)t.count * sizeof t.row[0]);
  for (int lane = 0; lane < w->with->lanes; lane++) {
    const float *state = list->state[list->count + (lane < t.count ? lane : t.count - 1)];
    for (int c = 0; c < MOVING_COLUMNS; c++)
      moving[c][lane] = state[c];
  }
  next_steps(w, kind, false, &t, moving);
}

/* Works off every list that holds at least so many rows. Returns whether there was one. */
static bool work_off(work *w, int least) {
  bool any = false;
  for (int kind = 0; kind < STEP_KINDS; kind++) {
    while (w->fresh[kind].count >= least) {
      work_off_fresh(w, (enum step_kind)kind);
      any = true;
    }
    while (w->moving[kind].count >= least) {
      work_off_moving(w, (enum step_kind)kind);
      any = true;
    }
  }
  return any;
}

static size_t solve(carom_precision precision, const void *in, size_t in_size, size_t n, const carom_options *opt, void *out,
                    size_t out_size, int8_t *status) {
  work w = {.with = carom_kernels_in_force(),
            .precision = precision,
            .in = in,
            .out = out,
            .in_size = in_size,
            .out_size = out_size,
            .opt = opt,
            .s = carom_spin_sign(opt->slip),
            .status = status,
            .first_bad = n};
  const int lanes = w.with->lanes;
  const size_t register_size = (size_t)lanes * in_size, size = n * in_size;
  for (size_t first = 0; first < n; first += (size_t)lanes) {
    /* what comes two registers later, while there is work to hide it */
    const size_t ahead = first * in_size + 2 * register_size;
    for (size_t at = ahead; at < ahead + register_size && at < size; at += CACHE_LINE)
      __builtin_prefetch(w.in + at);
    team t = {.count = n - first < (size_t)lanes ? (int)(n - first) : lanes};
    for (int lane = 0; lane < t.count; lane++)
      t.row[lane] = (uint32_t)(first + (size_t)lane);
    first_steps(&w, &t);
    work_off(&w, lanes);
  }
  while (work_off(&w, 1)) {
  }
  return w.first_bad;
}

static size_t solve_all(carom_precision precision, const char *in, size_t in_size, size_t n, const carom_options *opt,
                        char *out, size_t out_size, int8_t *status) {
  size_t first_bad = n;
  for (size_t from = 0; from < n; from += MOST_ROWS) {
    const size_t rows = n - from < MOST_ROWS ? n - from : MOST_ROWS;
    const size_t bad = solve(precision, in + from * in_size, in_size, rows, opt, out + from * out_size, out_size,
                             status != NULL ? status + from : NULL);
    if (bad < rows && first_bad == n)
      first_bad = from + bad;
  }
  return first_bad;
}

size_t carom_exact_batch_double(const void *in, size_t n, const carom_options *opt, void *out, int8_t *status) {
  return solve_all(CAROM_DOUBLE, in, sizeof(carom_impact), n, opt, out, sizeof(carom_result), status);
}

size_t carom_exact_batch_single(const void *in, size_t n, const carom_options *opt, void *out, int8_t *status) {
  return solve_all(CAROM_SINGLE, in, sizeof(carom_impact_f32), n, opt, out, sizeof(carom_result_f32), status);
}
