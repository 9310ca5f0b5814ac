/* Run-time choice of the instruction set: the highest that the processor has, or a lower one
 * where that is requested.
 *
 * The one piece of global state of the library is here: the set in force, an atomic that the
 * first use fills. Asking for a lower set is for tests, comparisons and bug reports; the results
 * of the exact solver agree within its contract on all of them.
 */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* secure_getenv: the environment is ignored by programs with more rights than
                       their user */
#endif
#include "platform/isa.h"

#include "platform/enumerations.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif
#if defined(__ANDROID__) /* without secure_getenv */
#include <sys/auxv.h>
#ifndef AT_SECURE
#define AT_SECURE 23
#endif
#define secure_getenv(name) (getauxval(AT_SECURE) ? NULL : getenv(name))
#endif
#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* clang has no macro for some flags by which it changes results. They show in the expressions it
 * takes for constant whatever x is; the call that this leads to is then an error of the compiler.
 * Without optimisation the flags have no effect, nor has this. */
#if defined(__has_attribute)
#if __has_attribute(error)
#define REFUSE(name, flag)        \
  void carom_refuses_##name(void) \
      __attribute__((error("carom promises bits: compile its sources without " flag)))
REFUSE(associative_math,
       "-fassociative-math (which -funsafe-math-optimizations and -ffp-model=fast set)");
REFUSE(reciprocal_math,
       "-freciprocal-math (which -funsafe-math-optimizations and -ffp-model=fast set)");
REFUSE(no_signed_zeros,
       "-fno-signed-zeros (which -funsafe-math-optimizations and -ffp-model=fast set)");
REFUSE(no_honor_nans, "-fno-honor-nans");
REFUSE(no_honor_infinities, "-fno-honor-infinities");

static uint64_t bits_of(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

__attribute__((used)) static void refuse_flags(double x) {
  const double added = (x + 1.0) - x;
  const bool divided = bits_of(x / 3.0) == bits_of(x * (1.0 / 3.0)),
             zero = bits_of(x + 0.0) == bits_of(x);
  const bool nan = isnan(x), infinite = isinf(x);
  if (__builtin_constant_p(added))
    carom_refuses_associative_math();
  if (__builtin_constant_p(divided))
    carom_refuses_reciprocal_math();
  if (__builtin_constant_p(zero))
    carom_refuses_no_signed_zeros();
  if (__builtin_constant_p(nan))
    carom_refuses_no_honor_nans();
  if (__builtin_constant_p(infinite))
    carom_refuses_no_honor_infinities();
}
#endif
#endif

static const bool built[CAROM_ISA_COUNT] = {
#define BUILT(NAME, suffix) [CAROM_ISA_##NAME] = true,
    CAROM_BUILT_ISAS(BUILT)
#undef BUILT
};

#if defined(__x86_64__)
/* Has the processor AVX2 or AVX-512 as carom uses them, and does the system keep their
 * registers? Not by __builtin_cpu_supports(): the run-time library of zig has a stub for it,
 * which knows no processor. Source: Intel's Software Developer's Manual, volume 1, sections
 * "Detection of AVX Instructions" and "Detection of AVX-512 Foundation Instructions". */
static bool processor_has_avx(bool wide) {
  unsigned a, b, c, d, saved_registers, high;
  /* Leaf 1: AVX, fused multiply-add, and whether xgetbv may be used. */
  const unsigned first = bit_AVX | bit_FMA | bit_OSXSAVE;
  if (!__get_cpuid(1, &a, &b, &c, &d) || (c & first) != first)
    return false;
  /* Registers that the system keeps: bits 1 and 2 for SSE and AVX, 5 to 7 for AVX-512. macOS
   * sets these at the first use. */
  __asm__ volatile("xgetbv" : "=a"(saved_registers), "=d"(high) : "c"(0));
#if defined(__APPLE__)
  const unsigned needed = 0x06;
#else
  const unsigned needed = wide ? 0xe6 : 0x06;
#endif
  /* Leaf 7: the sets themselves. */
  const unsigned sets = wide ? bit_AVX512F | bit_AVX512DQ | bit_AVX512VL : bit_AVX2;
  return (saved_registers & needed) == needed && __get_cpuid_count(7, 0, &a, &b, &c, &d) &&
         (b & sets) == sets;
}
#endif

static bool processor_has(carom_isa isa) {
  switch (isa) {
#if defined(__x86_64__)
  case CAROM_ISA_SSE2:
    return true;
  case CAROM_ISA_AVX2:
    return processor_has_avx(false);
  case CAROM_ISA_AVX512:
    return processor_has_avx(true);
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

/* The best set that is available and not above `limit`: sets of one processor family are listed
 * from low to high. */
static carom_isa best_up_to(carom_isa limit) {
  for (int isa = (int)limit; isa > CAROM_ISA_PLAIN; isa--)
    if (carom_isa_available((carom_isa)isa))
      return (carom_isa)isa;
  return CAROM_ISA_PLAIN;
}

static carom_isa from_environment(void) {
#if defined(__linux__)
  const char *name = secure_getenv("CAROM_ISA");
#else
  const char *name = getenv("CAROM_ISA");
#endif
  for (int isa = 0; name != NULL && isa < CAROM_ISA_COUNT; isa++)
    if (strcmp(name, carom_word(CAROM_WORDS_ISA, isa)) == 0)
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
  carom_isa current;
  if ((int)isa >= 0 && isa < CAROM_ISA_COUNT)
    current = best_up_to(isa);
  else
    current = from_environment();
  atomic_store(&in_force, (int)current);
  return current;
}
