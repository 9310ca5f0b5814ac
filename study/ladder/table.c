/* The rungs as data, from kernels.def. */
#include "ladder.h"

#include <string.h>

static const ladder_rung rungs[] = {
#define RUNG(name, parent, precision, isa, width, bound, paper, over_1e3, over_1e2, idea) \
  {#name, #parent, LADDER_##precision, LADDER_##isa, width, bound, paper, over_1e3, over_1e2, idea},
#include "kernels.def"
#undef RUNG
};

const ladder_rung *ladder_rung_at(size_t k) {
  return k < sizeof rungs / sizeof rungs[0] ? &rungs[k] : NULL;
}

const ladder_rung *ladder_rung_find(const char *name) {
  const ladder_rung *rung;
  for (size_t k = 0; (rung = ladder_rung_at(k)) != NULL; k++)
    if (strcmp(rung->name, name) == 0)
      return rung;
  return NULL;
}

bool ladder_rung_runs(const ladder_rung *rung) {
#if defined(__x86_64__)
  switch (rung->isa) {
  case LADDER_BASELINE:
    return true;
  case LADDER_AVX2:
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  case LADDER_AVX512:
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("fma");
  }
#endif
  (void)rung;
  return false;
}

const char *ladder_isa_name(ladder_isa isa) {
  static const char *const names[] = {
      [LADDER_BASELINE] = "scalar", [LADDER_AVX2] = "avx2", [LADDER_AVX512] = "avx512"};
  return names[isa];
}
