/* Every function runs on a thread with 76 KiB of stack, of which the C library
 * takes its share too. The stack is painted before, with a page that may not be touched below
 * it; what lost its paint was used. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include "functions.h"
#include "random_impacts.h"

#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

/* Compilers that do not optimise keep every temporary on the stack; the promise is for a build
 * that does. */
#ifdef __OPTIMIZE__
enum { STACK = 76 * 1024 };
#else
enum { STACK = 1024 * 1024 };
#endif
enum { PAINT = 0xA5, VARIANTS = 6 };

static void *nothing(void *unused) {
  return unused;
}

/* One of functions.h; a call for one collision of each that there are, of all regimes. */
static int function;
static bool of_one_collision;
static carom_impact regimes[BATCH];

static void *any_function(void *unused) {
  functions[function].call();
  for (int k = 0; k < BATCH && of_one_collision; k++) {
    impacts[0] = regimes[k];
    functions[function].call();
  }
  return unused;
}

/* A batch that is worth threads. */
enum { MANY = 20000 };
static carom_impact many[MANY];
static carom_result many_results[MANY];

static void *many_rows(void *unused) {
  carom_collide_batch(many, MANY, &(carom_options){.threads = threads}, many_results, NULL);
  return unused;
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

/* Measures what a body uses in addition to `own` bytes, by each instruction set, and prints the
 * most. */
static void measure(void *(*body)(void *), const char *name, size_t own) {
  size_t most = 0;
  carom_isa_limit(CAROM_ISA_ANY);
  const int best = (int)carom_isa_in_force();
  for (variant = 1; variant <= VARIANTS; variant++) {
    set_up();
    for (int k = 0; k < BATCH; k++) {
      impacts[k] = regimes[k];
      impacts_f32[k] = narrowed(&regimes[k]);
    }
    FOR_EACH_ISA(isa) {
      if (variant > 2 && isa != best)
        continue;
      carom_isa_limit((carom_isa)isa); /* which one of the functions lifts */
      const size_t used = stack_used(body);
      ck_assert_msg(used < STACK, "%s", name);
      most = used > most ? used : most;
    }
  }
  if (most - own >= 2048)
    printf("  %s with %d threads: %zu\n", name, threads, most - own);
}

/* Every function that the library exports, without its own threads and with some. */
TEST(every_function_fits) {
  random_source source = {test_seed()};
  lab_random rng = {test_seed()};
  for (int k = 0; k < BATCH; k++)
    regimes[k] = regimes_draw(k % regimes_count(), -1.0, &rng);
  for (int k = 0; k < MANY; k++)
    many[k] = random_impact(&source);
  const size_t own = stack_used(nothing);
  printf("a thread that does nothing uses %zu bytes of its stack of %d; the functions besides\n",
         own, STACK);
  for (threads = 0; threads <= 7; threads += 7) {
    for (function = 0; function < COUNT; function++) {
      const char *name = functions[function].name;
      of_one_collision = strncmp(name, "carom_collide", 13) == 0 && strstr(name, "batch") == NULL;
      of_one_collision |= strcmp(name, "carom_trace") == 0;
      measure(any_function, name, own);
    }
    measure(many_rows, "carom_collide_batch", own);
  }
}
