/* Keeping the benchmark on one core. */
#include "pinning.h"

#include <errno.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static cpu_set_t before, pinned;
static bool active;

static void place(const cpu_set_t *cores) {
  if (active)
    sched_setaffinity(0, sizeof *cores, cores);
}

const char *pinning_begin(void) {
  static char text[200];
  int core = CPU_SETSIZE - 1;
  if (sched_getaffinity(0, sizeof before, &before) == 0) {
    while (core > 0 && !CPU_ISSET((size_t)core, &before))
      core--;
    CPU_ZERO(&pinned);
    CPU_SET((size_t)core, &pinned);
    active = sched_setaffinity(0, sizeof pinned, &pinned) == 0;
  }
  if (active)
    snprintf(text, sizeof text, "pinned to core %d", core);
  else
    snprintf(text, sizeof text, "not pinned (%s)", strerror(errno));
  return text;
}

void pinning_end(void) {
  place(&before);
  active = false;
}

void pinning_suspend(void) {
  place(&before);
}

void pinning_resume(void) {
  place(&pinned);
}
