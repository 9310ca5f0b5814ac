/* Run-time choice of the instruction set: the highest that the processor has, or a lower one where that is asked for.
 *
 * The one piece of global state of the library is here: the set in force, an atomic that the first use fills. Asking for a
 * lower set is for tests, comparisons and bug reports; the results of the exact solver agree within its contract on all of
 * them.
 */
#if defined(__linux__)
#define _GNU_SOURCE /* secure_getenv: the environment says nothing to programs with more rights than their user */
#endif
#include "platform/isa.h"

#include "enumerations.h"

#include <float.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#ifdef __FAST_MATH__
#error "carom finds bad input by NaN and infinity, and promises bits: do not build it with -ffast-math"
#endif
/* With more digits between two operations results would not have the promised bits. */
#if FLT_EVAL_METHOD != 0
#error "carom needs float and double computed in their own precision; for 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

static const bool built[CAROM_ISA_COUNT] = {
#define BUILT(NAME, suffix) [CAROM_ISA_##NAME] = true,
    CAROM_BUILT_ISAS(BUILT)
#undef BUILT
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
  return (int)isa >= 0 && isa < CAROM_ISA_COUNT && built[isa] && processor_has(isa);
}

/* The best set that is available and not above `limit`: sets of one processor family are listed from low to high. */
static carom_isa best_up_to(carom_isa limit) {
  for (int isa = (int)limit; isa > CAROM_ISA_PLAIN; isa--)
    if (carom_isa_available((carom_isa)isa))
      return (carom_isa)isa;
  return CAROM_ISA_PLAIN;
}

static carom_isa from_environment(void) {
#if defined(__linux__)
  const char *wanted = secure_getenv("CAROM_ISA");
#else
  const char *wanted = getenv("CAROM_ISA");
#endif
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
