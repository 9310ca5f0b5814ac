/* Keeping the benchmark on one core. Real-time priority is the lowest there is: it comes before
 * everything ordinary and after everything that knows better. */
#include "pinning.h"

#include <errno.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

typedef struct placement {
  cpu_set_t cores;
  int policy;
  struct sched_param priority;
} placement;

static placement before, pinned;
static bool active;

/* The first of the isolated cores, which Linux lists as "2-3,7", or -1. */
static int isolated_core(void) {
  FILE *file = fopen("/sys/devices/system/cpu/isolated", "r");
  int core;
  const bool found = file != NULL && fscanf(file, "%d", &core) == 1;
  if (file != NULL)
    fclose(file);
  return found && core >= 0 && core < CPU_SETSIZE ? core : -1;
}

static int last_core(const cpu_set_t *allowed) {
  for (int core = CPU_SETSIZE - 1; core >= 0; core--)
    if (CPU_ISSET((size_t)core, allowed))
      return core;
  return 0;
}

static void place(const placement *p) {
  sched_setaffinity(0, sizeof p->cores, &p->cores);
  sched_setscheduler(0, p->policy, &p->priority);
}

static bool pin_to(int core) {
  CPU_ZERO(&pinned.cores);
  CPU_SET((size_t)core, &pinned.cores);
  return sched_setaffinity(0, sizeof pinned.cores, &pinned.cores) == 0;
}

const char *pinning_begin(void) {
  static char text[200];
  if (sched_getaffinity(0, sizeof before.cores, &before.cores) != 0) {
    snprintf(text, sizeof text, "not pinned (%s)", strerror(errno));
    return text;
  }
  before.policy = sched_getscheduler(0);
  sched_getparam(0, &before.priority);
  pinned = before;
  /* An isolated core is not among those that a process gets unasked. Who was given one core
   * only, keeps it. */
  const int isolated = CPU_COUNT(&before.cores) > 1 ? isolated_core() : -1;
  int core = isolated;
  if (isolated < 0 || !pin_to(isolated)) {
    core = last_core(&before.cores);
    if (!pin_to(core)) {
      snprintf(text, sizeof text, "not pinned (%s)", strerror(errno));
      return text;
    }
  }
  active = true;
  int used = snprintf(text, sizeof text, "pinned to core %d%s, ", core,
                      core == isolated ? " (isolated)" : " (not isolated)");
  const struct sched_param lowest = {.sched_priority = sched_get_priority_min(SCHED_FIFO)};
  if (sched_setscheduler(0, SCHED_FIFO, &lowest) == 0) {
    pinned.policy = SCHED_FIFO;
    pinned.priority = lowest;
    snprintf(text + used, sizeof text - (size_t)used, "real-time priority");
  } else {
    snprintf(text + used, sizeof text - (size_t)used, "no real-time priority (%s)",
             strerror(errno));
  }
  return text;
}

void pinning_end(void) {
  if (active)
    place(&before);
  active = false;
}

/* With the priority kept: threads inherit it, and one thread and two are then equally
 * undisturbed. */
void pinning_suspend(void) {
  placement loose = pinned;
  loose.cores = before.cores;
  if (active)
    place(&loose);
}

void pinning_resume(void) {
  if (active)
    place(&pinned);
}

void pinning_breathe(double busy_ns) {
  static double owed;
  if (!active || pinned.policy != SCHED_FIFO)
    return;
  owed += 0.07 * busy_ns;
  if (owed < 2e6)
    return;
  const struct timespec pause = {.tv_sec = (time_t)(owed / 1e9),
                                 .tv_nsec = (long)owed % 1000000000};
  nanosleep(&pause, NULL);
  owed = 0.0;
}
