/* Keeping the benchmark on one core. Real-time priority is the lowest there is: it precedes
 * everything ordinary and yields to everything with a deliberate priority. */
#include "pinning.h"

#include <errno.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static cpu_set_t allowed, pinned; /* the cores before, and the one that is pinned to */
static bool active, real_time;

/* The first of the isolated cores, which Linux lists as "2-3,7", or -1. An isolated core is not
 * among those that a process gets unasked. */
static int isolated_core(void) {
  FILE *file = fopen("/sys/devices/system/cpu/isolated", "r");
  int core;
  const bool found = file != NULL && fscanf(file, "%d", &core) == 1;
  if (file != NULL)
    fclose(file);
  if (!found || core < 0 || core >= CPU_SETSIZE)
    return -1;
  return core;
}

static bool pin_to(int core) {
  CPU_ZERO(&pinned);
  CPU_SET((size_t)core, &pinned);
  return sched_setaffinity(0, sizeof pinned, &pinned) == 0;
}

const char *pinning_begin(void) {
  static char text[200];
  active = sched_getaffinity(0, sizeof allowed, &allowed) == 0;
  /* who was given one core only, keeps it */
  int isolated = -1;
  if (active && CPU_COUNT(&allowed) > 1)
    isolated = isolated_core();
  int core = isolated;
  if (active && (isolated < 0 || !pin_to(isolated))) {
    for (core = CPU_SETSIZE - 1; core > 0 && !CPU_ISSET((size_t)core, &allowed);)
      core--;
    active = pin_to(core);
  }
  if (!active) {
    snprintf(text, sizeof text, "not pinned (%s)", strerror(errno));
    return text;
  }
  const struct sched_param lowest = {.sched_priority = sched_get_priority_min(SCHED_FIFO)};
  real_time = sched_setscheduler(0, SCHED_FIFO, &lowest) == 0;
  const char *no[] = {"no ", ""}, *not [] = {"not ", ""};
  snprintf(text, sizeof text, "pinned to core %d (%sisolated), %sreal-time priority", core,
           not [core == isolated], no[real_time]);
  return text;
}

void pinning_end(void) {
  pinning_suspend();
  if (active && real_time)
    sched_setscheduler(0, SCHED_OTHER, &(struct sched_param){0});
  active = real_time = false;
}

void pinning_suspend(void) {
  if (active)
    sched_setaffinity(0, sizeof allowed, &allowed);
}

void pinning_resume(void) {
  if (active)
    sched_setaffinity(0, sizeof pinned, &pinned);
}

void pinning_breathe(double busy_ns) {
  static double owed;
  owed += 0.07 * busy_ns;
  if (!active || !real_time || owed < 2e6)
    return;
  nanosleep(&(struct timespec){(time_t)(owed / 1e9), (long)owed % 1000000000}, NULL);
  owed = 0.0;
}
