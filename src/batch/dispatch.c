/* Run-time dispatch: the fastest instruction set that the processor has, or a lower one where that is asked for.
 *
 * The one piece of global state of the library is here: the set in force, an atomic that the first use fills. Asking for a
 * lower set is for tests, comparisons and bug reports; results agree within the solvers' contract on all of them.
 */
#include "batch.h"
#include "swift/swift.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static carom_batch_solver *const solvers[CAROM_ISA_COUNT][CAROM_SOLVER_COUNT][CAROM_PRECISIONS] = {
#define ROW(NAME, suffix)                                                                                \
  [CAROM_ISA_##NAME] = {                                                                                 \
      [CAROM_SOLVER_EXACT] = {carom_exact_lanes_##suffix##_double, carom_exact_lanes_##suffix##_single}, \
      [CAROM_SOLVER_EULER] = {carom_euler_lanes_##suffix##_double, carom_euler_lanes_##suffix##_single}, \
  },
    CAROM_BUILT_ISAS(ROW)
#undef ROW
};

static carom_swift_solver *const swift_solvers[CAROM_ISA_COUNT] = {
#define ROW(NAME, suffix) [CAROM_ISA_##NAME] = carom_swift_##suffix,
    CAROM_BUILT_ISAS(ROW)
#undef ROW
};

static bool processor_has(carom_isa isa) {
  switch (isa) {
#if defined(__x86_64__)
  case CAROM_ISA_SSE2:
    return true;
  case CAROM_ISA_AVX2:
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  case CAROM_ISA_AVX512:
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#elif defined(__aarch64__)
  case CAROM_ISA_NEON:
    return true;
#endif
  case CAROM_ISA_PLAIN:
    return true;
  default:
    return false;
  }
}

int carom_isa_available(carom_isa isa) {
  return (int)isa >= 0 && isa < CAROM_ISA_COUNT && solvers[isa][CAROM_SOLVER_EULER][CAROM_DOUBLE] != NULL && processor_has(isa);
}

const char *carom_isa_name(carom_isa isa) {
  static const char *const names[] = {
#define NAME_OF(NAME, name) [CAROM_ISA_##NAME] = name,
      CAROM_ISA_LIST(NAME_OF)
#undef NAME_OF
  };
  return (int)isa >= 0 && isa < CAROM_ISA_COUNT ? names[isa] : NULL;
}

/* The best set that is available and not above `limit`: sets of one processor family are listed from low to high. */
static carom_isa best_up_to(carom_isa limit) {
  for (int isa = (int)limit; isa > CAROM_ISA_PLAIN; isa--)
    if (carom_isa_available((carom_isa)isa))
      return (carom_isa)isa;
  return CAROM_ISA_PLAIN;
}

static carom_isa from_environment(void) {
  const char *wanted = getenv("CAROM_ISA");
  for (int isa = 0; wanted != NULL && isa < CAROM_ISA_COUNT; isa++)
    if (strcmp(wanted, carom_isa_name((carom_isa)isa)) == 0)
      return best_up_to((carom_isa)isa);
  return best_up_to((carom_isa)(CAROM_ISA_COUNT - 1));
}

enum { UNDECIDED = -1 };
static atomic_int in_force = UNDECIDED;

carom_isa carom_isa_in_force(void) {
  int isa = atomic_load_explicit(&in_force, memory_order_relaxed);
  if (isa == UNDECIDED) {
    isa = (int)from_environment(); /* threads that race here all find the same */
    int expected = UNDECIDED;
    if (!atomic_compare_exchange_strong(&in_force, &expected, isa))
      isa = expected;
  }
  return (carom_isa)isa;
}

carom_isa carom_isa_limit(carom_isa isa) {
  const carom_isa now = (int)isa >= 0 && isa < CAROM_ISA_COUNT ? best_up_to(isa) : from_environment();
  atomic_store(&in_force, (int)now);
  return now;
}

/* Of fewer pairs than this the exact solver is faster by single calls: lanes are sorted into classes and filled first, and cost
 * about as much half empty (docs/batch.md). */
static const unsigned short exact_few[CAROM_ISA_COUNT][CAROM_PRECISIONS] = {
    [CAROM_ISA_PLAIN] = {0, 44}, [CAROM_ISA_SSE2] = {200, 18},  [CAROM_ISA_NEON] = {200, 18},
    [CAROM_ISA_AVX2] = {30, 12}, [CAROM_ISA_AVX512] = {34, 14},
};

carom_batch_solver *carom_batch_solver_for(carom_solver solver, carom_precision precision, size_t n) {
  const carom_isa isa = carom_isa_in_force();
  if (solver == CAROM_SOLVER_EXACT && n < exact_few[isa][precision])
    return precision == CAROM_DOUBLE ? carom_singles_double : carom_singles_single;
  return solvers[isa][solver][precision];
}

carom_swift_solver *carom_swift(void) {
  return swift_solvers[carom_isa_in_force()];
}
