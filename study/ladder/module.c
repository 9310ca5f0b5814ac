/* The table of contents of one module; the build defines LADDER_COMPILER, LADDER_CONFIG and
 * LADDER_FLAGS. */
#include "module.h"

#include "ladder_cpu.h"

const ladder_contents *carom_ladder_contents(void) {
  static const struct ladder_entry entries[] = {
#define RUNG(name, parent, precision, isa, width, bound, paper, over_1e3, over_1e2, idea) \
  {#name, carom_rung_##name},
#include "kernels.def"
#undef RUNG
  };
  static const ladder_contents contents = {
      .state_size = sizeof(carom_local),
      .compiler = LADDER_COMPILER,
      .version = __VERSION__,
      .config = LADDER_CONFIG,
      .flags = LADDER_FLAGS,
      .cpu = LADDER_CPU,
      .count = sizeof entries / sizeof entries[0],
      .rung = entries,
  };
  return &contents;
}
