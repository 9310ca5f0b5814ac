/* A batch is n single calls, bit for bit: every instruction set that the processor has, both
 * precisions, every solver and slip.
 *
 * All sizes from 0 to a vector more than what is solved by calls, rows in error and rows of junk
 * between good ones, all regimes side by side, batches cut at random positions, in random order,
 * over any number of threads. Arrays end where memory ends, so that reading or writing past them
 * is seen, and begin at odd places. */
#include "carom_shot.h"
#include "random_impacts.h"
#include "support.h"

#include "ball_ball/kernels.h"

/* FEWEST: rows from which on every batch is solved in lanes; kernels.c has the numbers of each
 * instruction set. */
enum { WIDEST = 16, FEWEST = 80, MOST = FEWEST + WIDEST + 1, MANY = 29000 };

/* ---- Both precisions of rows by the same calls */

enum { ROW_PRECISIONS = CAROM_F32 + 1 };

static const size_t in_size[] = {sizeof(carom_impact), sizeof(carom_impact_f32)};
static const size_t out_size[] = {sizeof(carom_result), sizeof(carom_result_f32)};

static carom_status collide_batch(int precision, const void *in, size_t n,
                                  const carom_options *options, void *out, int8_t *status) {
  return precision == CAROM_F64 ? carom_collide_batch(in, n, options, out, status)
                                : carom_collide_batch_f32(in, n, options, out, status);
}

static void put_row(int precision, void *rows, size_t k, const carom_impact *in) {
  if (precision == CAROM_F64)
    ((carom_impact *)rows)[k] = *in;
  else
    ((carom_impact_f32 *)rows)[k] = narrowed(in);
}

/* ---- Rows */

typedef carom_impact make_row(random_source *source, size_t k);

static carom_impact good_row(random_source *source, size_t k) {
  (void)k;
  return random_impact(source);
}

static size_t draw_index(random_source *source, size_t count) {
  return (size_t)random_between(source, 0.0, (double)count);
}

/* Good rows, separating rows, and rows in which one of the 26 numbers is spoilt. */
static carom_impact mixed_row(random_source *source, size_t k) {
  static const double spoilt[] = {NAN, INFINITY, -INFINITY, -1.0, 0.0, 1e300, 1e-300, -0.0};
  carom_impact in = random_impact(source);
  double *number = (double *)&in;
  if (k % 3 == 1)
    number[draw_index(source, 26)] = spoilt[draw_index(source, 8)];
  if (k % 7 == 2)
    for (int c = 0; c < 3; c++) {
      in.a.v[c] = -in.a.v[c];
      in.b.v[c] = -in.b.v[c];
    }
  if (k % 11 == 5)
    in.a.mu_slide = in.b.mu_slide = in.mu_ball = 0.0;
  if (k % 13 == 6)
    memset(in.a.w, 0, sizeof in.a.w), memset(in.b.w, 0, sizeof in.b.w);
  if (k % 17 == 7)
    memset(in.b.v, 0, sizeof in.b.v), memset(in.b.w, 0, sizeof in.b.w);
  if (k % 19 == 8) /* about what is still one radius */
    in.b.radius *= 1.0 + random_between(source, -2e-9, 2e-9);
  return in;
}

/* The motion has zeros of both signs in random positions, and the line of centres is along an
 * axis. The products in the collision frame are then zeros, and their signs decide the sign of a
 * sum. */
static carom_impact zero_row(random_source *source, size_t k) {
  static const double zeros[] = {0.0, -0.0, 0.0, -0.0, 1.0, -1.0};
  carom_impact in = random_impact(source);
  const double reach = in.a.radius + in.b.radius, along = k % 2 == 0 ? reach : -reach,
               zero = k % 4 < 2 ? 0.0 : -0.0;
  for (int c = 0; c < 3; c++) {
    in.a.r[c] = zeros[draw_index(source, 2)];
    in.b.r[c] = zero;
    in.a.w[c] = zeros[draw_index(source, 6)];
    in.b.w[c] = zeros[draw_index(source, 6)];
    in.a.v[c] = c == 2 ? zeros[k % 2] : zeros[draw_index(source, 6)];
    in.b.v[c] = c == 2 ? zeros[k % 2] : zeros[draw_index(source, 4)];
  }
  const int axis = k % 3 == 0;
  in.b.r[axis] = along;
  in.a.v[axis] = k % 2 == 0 ? 2.0 : -2.0;
  if (k % 5 == 4) { /* the friction on a spin of 0 underflows, and leaves the sign of that 0 */
    in.a.v[axis] *= 1e-200;
    in.a.w[2] = random_between(source, -1.0, 1.0) > 0.0 ? 1e150 : -1e150;
    memset(in.b.v, 0, sizeof in.b.v);
    in.a.v[1 - axis] = 0.0;
  }
  return in;
}

static carom_options options_for(int solver, int slip) {
  return (carom_options){.solver = (carom_solver)solver, .slip = (carom_slip)slip, .steps = 100};
}

/* What the rows of a batch must come to. */
static void alone(int precision, const void *in, size_t n, const carom_options *options, void *out,
                  int8_t *status) {
  for (size_t k = 0; k < n; k++) {
    const void *from = (const char *)in + k * in_size[precision];
    void *to = (char *)out + k * out_size[precision];
    status[k] = (int8_t)carom_collide_one((carom_precision)precision, from, options, to);
  }
}

/* The rows of in[0..n-1] as one batch, in memory that ends exactly, small ones without an array
 * of statuses too. */
static void expect_batch(int precision, const void *in, size_t n, const carom_options *options,
                         const void *out, const int8_t *status) {
  const size_t bytes = n * out_size[precision];
  const edge from = edge_make(n * in_size[precision], n % 2 == 1),
             to = edge_make(bytes, n % 2 == 1), said = edge_make(n, false);
  memcpy(from.memory, in, n * in_size[precision]);
  carom_status first_error = CAROM_OK;
  for (size_t k = 0; k < n && first_error == CAROM_OK; k++)
    first_error = status[k] < 0 ? status[k] : CAROM_OK;
  for (int with = n <= MOST ? 0 : 1; with < 2; with++) {
    memset(to.memory, 0xA5, bytes);
    ck_assert_int_eq(
        collide_batch(precision, from.memory, n, options, to.memory, with ? said.memory : NULL),
        first_error);
    for (size_t k = 0; k < n; k++)
      ck_assert_msg(memcmp((const char *)to.memory + k * out_size[precision],
                           (const char *)out + k * out_size[precision], out_size[precision]) == 0,
                    "%s, %s, slip %s, %s, %d threads: row %zu of %zu has other bits than alone",
                    carom_word(CAROM_WORDS_ISA, (int)carom_isa_in_force()),
                    carom_word(CAROM_WORDS_SOLVER, (int)options->solver),
                    carom_word(CAROM_WORDS_SLIP, (int)options->slip),
                    precision == CAROM_F64 ? "double" : "single", options->threads, k, n);
  }
  ck_assert(n == 0 || memcmp(said.memory, status, n) == 0);
  ck_assert(n == 0 || memcmp(from.memory, in, n * in_size[precision]) == 0);
  edge_free(&from), edge_free(&to), edge_free(&said);
}

/* Rows with what they come to alone, in both precisions. */
typedef struct table {
  size_t n;
  void *in, *out;
  int8_t *status;
} table;

static table table_make(size_t n) {
  return (table){n, malloc(n * sizeof(carom_impact) + 1), malloc(n * sizeof(carom_result) + 1),
                 malloc(n + 1)};
}

static void table_free(const table *t) {
  free(t->in), free(t->out), free(t->status);
}

#define FOR_EACH_WAY(solver, slip, precision)                 \
  for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) \
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)       \
      for (int precision = 0; precision < ROW_PRECISIONS; precision++)

TEST(rows_of_all_kinds_at_every_size) {
  static make_row *const kinds[] = {good_row, mixed_row, zero_row};
  const table t = table_make(MOST);
  const size_t kinds_of_each = (size_t)draws_within(1, 3);
  FOR_EACH_ISA(isa)
  FOR_EACH_WAY(solver, slip, precision)
  for (size_t kind = 0; kind < 3; kind++) {
    random_source source = {test_seed()};
    const carom_options options = options_for(solver, slip);
    for (size_t n = 0; n <= MOST; n++) {
      if ((n + kind) % 3 >= kinds_of_each)
        continue;
      for (size_t k = 0; k < n; k++) {
        const carom_impact in = kinds[kind](&source, k);
        put_row(precision, t.in, k, &in);
      }
      alone(precision, t.in, n, &options, t.out, t.status);
      expect_batch(precision, t.in, n, &options, t.out, t.status);
    }
  }
  table_free(&t);
}

/* Moves row `from` of a table to place `to` of another. */
static void copy_row(int precision, const table *source, size_t from, const table *target,
                     size_t to) {
  const size_t in = in_size[precision], out = out_size[precision];
  memcpy((char *)target->in + to * in, (const char *)source->in + from * in, in);
  memcpy((char *)target->out + to * out, (const char *)source->out + from * out, out);
  target->status[to] = source->status[from];
}

/* Rows of all kinds and regimes in random order, cut at random positions into batches, each with 1,
 * 2, 3 or 7 threads. Euler's method takes fewer rows to be worth a thread. */
TEST(cut_anywhere_in_any_order) {
  static const int threads[] = {1, 2, 3, 7};
  const table t = table_make(MANY), mixed = table_make(MANY);
  size_t *order = malloc(MANY * sizeof *order);
  const size_t many = (size_t)draws_within(MANY / 4, MANY);
  random_source source = {test_seed()};
  lab_random rng = {test_seed()};
  FOR_EACH_ISA(isa)
  FOR_EACH_WAY(solver, slip, precision) {
    carom_options options = options_for(solver, slip);
    const size_t n = solver != CAROM_SOLVER_EULER ? many : many / 15;
    for (size_t k = 0; k < n; k++) {
      const double s = slip == CAROM_SLIP_POOLTOOL ? 1.0 : -1.0;
      carom_impact in;
      if (k % 8 == 7)
        in = mixed_row(&source, k);
      else if (k % 64 == 6)
        in = regimes_draw((int)(k / 64) % regimes_count(), s, &rng);
      else
        in = good_row(&source, k);
      put_row(precision, t.in, k, &in);
      order[k] = k;
    }
    alone(precision, t.in, n, &options, t.out, t.status);
    for (size_t k = 0; k < n; k++) { /* Fisher and Yates */
      const size_t other = k + draw_index(&source, n - k), kept = order[k];
      order[k] = order[other];
      order[other] = kept;
      copy_row(precision, &t, order[k], &mixed, k);
    }
    /* as a whole by each number of threads, then in pieces */
    for (int k = 0; k < 4; k++) {
      options.threads = threads[k];
      expect_batch(precision, mixed.in, n, &options, mixed.out, mixed.status);
    }
    for (size_t from = 0, end; from < n; from = end) {
      end = from + (size_t)random_between(
                       &source, 0.0, random_between(&source, 0.0, 1.0) < 0.5 ? 100.0 : (double)n);
      end = end < n ? end : n;
      options.threads = threads[draw_index(&source, 4)];
      expect_batch(precision, (char *)mixed.in + from * in_size[precision], end - from, &options,
                   (char *)mixed.out + from * out_size[precision], mixed.status + from);
    }
  }
  table_free(&t), table_free(&mixed), free(order);
}

/* All that a call may compute of some rows, by both precisions; cushions too. */
typedef struct everything {
  carom_result one[MOST], batch[MOST], one_fast[MOST], batch_fast[MOST];
  carom_result_f32 one_f32[MOST], batch_f32[MOST];
  carom_detail detail[MOST];
  carom_trace_point trace[MOST][4];
  carom_motion cushion[MOST], cushions[MOST];
  carom_cushion_point followed[MOST][4];
} everything;

/* options.plain of a call is what the whole process may be limited to: the same bits, and
 * nothing else is changed by it. The exact solver in double precision has these bits anyway. */
TEST(plain_for_one_call) {
  static carom_impact in[MOST];
  static carom_impact_f32 in_f32[MOST];
  static carom_cushion_impact on[MOST];
  static everything seen[3];
  random_source source = {test_seed()};
  for (int k = 0; k < MOST; k++) {
    in[k] = good_row(&source, (size_t)k);
    in_f32[k] = narrowed(&in[k]);
    on[k] = random_cushion(&source);
  }
  /* by the process; by the call; and by neither */
  const carom_isa best = carom_isa_limit(CAROM_ISA_ANY);
  for (int way = 0; way < 3; way++) {
    carom_isa_limit(way == 0 ? CAROM_ISA_PLAIN : CAROM_ISA_ANY);
    const carom_options options = {.plain = way == 1},
                        fast = {.solver = CAROM_SOLVER_FAST, .plain = way == 1};
    const carom_cushion_options cushion_options = {.plain = way == 1};
    everything *e = &seen[way];
    for (int k = 0; k < MOST; k++) {
      carom_collide_detail(&in[k], &options, &e->one[k], &e->detail[k]);
      carom_collide(&in[k], &fast, &e->one_fast[k]);
      carom_collide_one(CAROM_F32, &in_f32[k], &options, &e->one_f32[k]);
      carom_trace(&in[k], &options, 4, e->trace[k]);
      carom_cushion(&on[k], &cushion_options, &e->cushion[k]);
      carom_cushion_trace(&on[k], &cushion_options, 4, e->followed[k]);
    }
    carom_collide_batch(in, MOST, &options, e->batch, NULL);
    carom_collide_batch(in, MOST, &fast, e->batch_fast, NULL);
    carom_collide_batch_f32(in_f32, MOST, &options, e->batch_f32, NULL);
    carom_cushion_batch(on, MOST, &cushion_options, e->cushions, NULL);
    ck_assert_int_eq(carom_isa_in_force(), way == 0 ? CAROM_ISA_PLAIN : best);
  }
#define SAME(field) (memcmp(seen[way].field, seen[0].field, sizeof seen[0].field) == 0)
  for (int way = 1; way < 3; way++) {
    const bool plain = way == 1 || best == CAROM_ISA_PLAIN;
    ck_assert_msg(SAME(one) && SAME(detail) && SAME(batch), "exact, %d", way);
    ck_assert_msg(SAME(one_fast) == plain && SAME(one_f32) == plain, "calls, %d", way);
    ck_assert_msg(SAME(batch_fast) == plain && SAME(batch_f32) == plain, "batches, %d", way);
    /* the precise solver has two kinds of vectors, of which one is plain */
    const bool precise = way == 1 || best < CAROM_ISA_AVX2;
    ck_assert_msg(SAME(trace) == precise && SAME(cushion) == precise && SAME(followed) == precise,
                  "traces, %d", way);
    ck_assert_msg(SAME(cushions) == precise, "cushions, %d", way);
  }
#undef SAME
}

TEST(lower_sets_can_be_asked_for) {
  const carom_isa best = carom_isa_limit(CAROM_ISA_ANY);
  ck_assert(carom_isa_available(best));
  ck_assert_int_eq(carom_isa_limit(CAROM_ISA_PLAIN), CAROM_ISA_PLAIN);
  ck_assert_int_eq(carom_isa_in_force(), CAROM_ISA_PLAIN);
  ck_assert_int_eq(carom_isa_limit((carom_isa)-1), best);
  ck_assert_int_eq(carom_isa_available((carom_isa)99), 0);
  ck_assert_ptr_null(carom_word(CAROM_WORDS_ISA, 99));
  printf("instruction sets tested:");
  FOR_EACH_ISA(isa) printf(" %s", carom_word(CAROM_WORDS_ISA, isa));
  printf("\n");
}
