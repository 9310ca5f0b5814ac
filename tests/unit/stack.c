/* Every function runs on a thread with the smallest usual stack, 64 KiB, of which the C library
 * takes its share too. The stack is painted before, with a page that may not be touched below
 * it; what lost its paint was used. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include "every_function.h"
#include "regimes.h"
#include "support.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Compilers that do not optimise keep every temporary on the stack; the promise is for a build
 * that does. */
#ifdef __OPTIMIZE__
enum { STACK = 64 * 1024 };
#else
enum { STACK = 1024 * 1024 };
#endif
enum { PAINT = 0xA5, EACH = 8, POINTS = 20, MANY = 20000 };

/* Rows of all regimes, and many ordinary ones. */
static carom_impact *rows, *many;
static carom_impact_f32 *rows_f32;
static carom_result *out;
static carom_result_f32 *out_f32;
static size_t count;
static carom_options options;

static void *nothing(void *argument) {
  return argument;
}

static void *single_calls(void *argument) {
  for (size_t k = 0; k < count; k++) {
    carom_detail detail;
    carom_collide(&rows[k], &options, &out[k]);
    carom_collide_detail(&rows[k], &options, &out[k], &detail);
  }
  return argument;
}

static void *single_calls_f32(void *argument) {
  for (size_t k = 0; k < count; k++)
    carom_collide_f32(&rows_f32[k], &options, &out_f32[k]);
  return argument;
}

static void *batch(void *argument) {
  carom_collide_batch(rows, count, &options, out, NULL);
  return argument;
}

static void *batch_f32(void *argument) {
  carom_collide_batch_f32(rows_f32, count, &options, out_f32, NULL);
  return argument;
}

static void *batch_in_threads(void *argument) {
  carom_options own = options;
  own.steps = 20;
  own.threads = 7;
  carom_collide_batch(many, MANY, &own, out, NULL);
  own.threads = CAROM_ALL_THREADS;
  carom_collide_batch(many, MANY, &own, out, NULL);
  return argument;
}

static void *trace(void *argument) {
  carom_trace_point point[POINTS];
  carom_options own = options;
  own.steps = 20;
  for (size_t k = 0; k < count; k++)
    carom_trace(&rows[k], &own, POINTS, point);
  return argument;
}

/* Breaks of all racks, by both worlds, one by one and in a batch. */
static void *shots(void *argument) {
  static carom_shot_ball balls[CAROM_BALLS_MOST];
  static carom_table table;
  static carom_shot shot[8];
  for (int world = 0; world < 2; world++)
    for (int rack = CAROM_RACK_NINEBALL; rack <= CAROM_RACK_SNOOKER; rack++) {
      carom_table_make(rack == CAROM_RACK_SNOOKER ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT,
                       &table);
      carom_rack((carom_rack_kind)rack, &table, 1e-4, 1, balls, CAROM_BALLS_MOST);
      carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
      cue.speed = 7.0;
      const carom_shot_options own = {.world = (carom_world)world, .threads = world};
      carom_shoot(&table, balls, carom_rack_size((carom_rack_kind)rack), &cue, &own, &shot[0]);
      const carom_shot_job job = {.table = &table,
                                  .balls = balls,
                                  .cues = &cue,
                                  .count = carom_rack_size((carom_rack_kind)rack),
                                  .n = 8,
                                  .options = &own,
                                  .shots = shot};
      carom_shoot_batch(&job);
    }
  return argument;
}

/* One of every_function.h. */
static every_input all_input;
static every_room *all_room;
static const struct every_function *one;

static void *any_function(void *argument) {
  one->body(&all_input, all_room, 1);
  return argument;
}

/* Bytes of a thread's stack that `body` takes. */
static size_t stack_used(void *(*body)(void *)) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  unsigned char *memory =
      mmap(NULL, STACK + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ck_assert_ptr_ne(memory, MAP_FAILED);
  unsigned char *stack = memory + page;
  memset(stack, PAINT, STACK);
  ck_assert_int_eq(mprotect(memory, page, PROT_NONE), 0); /* going below the stack ends the test */
  pthread_attr_t attributes;
  pthread_t thread;
  ck_assert_int_eq(pthread_attr_init(&attributes), 0);
  ck_assert_int_eq(pthread_attr_setstack(&attributes, stack, STACK), 0);
  ck_assert_int_eq(pthread_create(&thread, &attributes, body, NULL), 0);
  ck_assert_int_eq(pthread_join(thread, NULL), 0);
  size_t untouched = 0;
  while (untouched < STACK && stack[untouched] == PAINT)
    untouched++;
  pthread_attr_destroy(&attributes);
  munmap(memory, STACK + page);
  return STACK - untouched;
}

static const struct {
  const char *name;
  void *(*body)(void *);
} bodies[] = {
    {"carom_collide", single_calls},
    {"carom_collide_f32", single_calls_f32},
    {"carom_collide_batch", batch},
    {"carom_collide_batch_f32", batch_f32},
    {"the same in threads", batch_in_threads},
    {"carom_trace", trace},
    {"carom_shoot", shots},
};

static void make_rows(void) {
  random_source source = {test_seed()};
  lab_random rng = {test_seed()};
  count = (size_t)regimes_count() * EACH;
  rows = malloc(count * sizeof *rows);
  rows_f32 = malloc(count * sizeof *rows_f32);
  many = malloc(MANY * sizeof *many);
  out = malloc(MANY * sizeof *out);
  out_f32 = malloc(count * sizeof *out_f32);
  for (size_t k = 0; k < count; k++) {
    rows[k] = regimes_draw((int)k % regimes_count(), -1.0, &rng);
    for (int c = 0; c < 26; c++)
      ((float *)&rows_f32[k])[c] = (float)((const double *)&rows[k])[c];
  }
  for (size_t k = 0; k < MANY; k++)
    many[k] = random_impact(&source);
}

TEST(each_function_fits_64_KiB) {
  make_rows();
  const size_t own = stack_used(nothing);
  printf(
      "a thread that does nothing uses %zu bytes of its stack of %d; the functions use besides\n",
      own, STACK);
  for (size_t k = 0; k < sizeof bodies / sizeof bodies[0]; k++)
    for (int solver = 0; solver < CAROM_SOLVER_COUNT; solver++) {
      options = (carom_options){.solver = (carom_solver)solver, .steps = 50};
      printf("  %-24s %-6s", bodies[k].name, carom_solver_name(options.solver));
      FOR_EACH_ISA(isa) {
        const size_t used = stack_used(bodies[k].body);
        ck_assert_uint_lt(used, STACK);
        printf("  %s %zu", carom_isa_name((carom_isa)isa), used - own);
      }
      printf("\n");
    }
  free(rows), free(rows_f32), free(many), free(out), free(out_f32);
}

/* Every function that the library exports, with threads where it starts any. */
TEST(every_function_fits_64_KiB) {
  every_function_is_there();
  every_input_make(&all_input, 0, 3);
  all_room = calloc(1, sizeof *all_room);
  const size_t own = stack_used(nothing);
  FOR_EACH_ISA(isa) {
    size_t most = 0;
    const char *of = "";
    for (int k = 0; k < EVERY_COUNT; k++) {
      one = &every_functions[k];
      carom_isa_limit((carom_isa)isa); /* which one of the functions lifts */
      const size_t used = stack_used(any_function);
      ck_assert_msg(used < STACK, "%s", one->name);
      if (used > most) {
        most = used;
        of = one->name;
      }
      if (isa == CAROM_ISA_PLAIN && used - own >= 4096)
        printf("  %-24s %zu\n", one->name, used - own);
    }
    printf("  of all with %s %s takes most, %zu\n", carom_isa_name((carom_isa)isa), of, most - own);
  }
  free(all_room);
}
