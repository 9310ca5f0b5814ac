/* Counters by PAPI. One event set for each event: asking for all at once would make the kernel share out the few registers in
 * turns and scale the counts up, which is an estimate. */
#include "counters.h"

#include <math.h>
#include <papi.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST_NAMES = 4 };

typedef struct counter {
  const char *names[MOST_NAMES];
  int set; /* PAPI's event set, PAPI_NULL where there is none */
  const char *reason;
} counter;

static counter counters[COUNTER_COUNT] = {
#define COUNTER(NAME, column, text, ...) {.names = {__VA_ARGS__}, .set = PAPI_NULL},
    COUNTER_LIST(COUNTER)
#undef COUNTER
};
static bool begun;
static char overall[300];

/* Why the component that reads the processor's counters is off, or NULL if it is on. */
static const char *core_component_reason(void) {
  for (int k = 0; k < PAPI_num_components(); k++) {
    const PAPI_component_info_t *component = PAPI_get_component_info(k);
    if (component != NULL && strcmp(component->name, "perf_event") == 0)
      return component->disabled != 0 ? component->disabled_reason : NULL;
  }
  return "PAPI was built without perf_event";
}

static void drop(counter *c, const char *reason) {
  if (c->set != PAPI_NULL) {
    PAPI_cleanup_eventset(c->set);
    PAPI_destroy_eventset(&c->set);
  }
  c->set = PAPI_NULL;
  c->reason = reason;
}

/* Adds the first name that is known, and tries it: some machines list events and refuse to count them. */
static void open_counter(counter *c) {
  int code = PAPI_create_eventset(&c->set);
  if (code == PAPI_OK) {
    for (int k = 0; k < MOST_NAMES && c->names[k] != NULL; k++) {
      code = PAPI_add_named_event(c->set, c->names[k]);
      if (code == PAPI_OK)
        break;
    }
  }
  long long count;
  if (code == PAPI_OK)
    code = PAPI_start(c->set);
  if (code == PAPI_OK)
    code = PAPI_stop(c->set, &count);
  if (code != PAPI_OK)
    drop(c, PAPI_strerror(code));
}

const char *counters_begin(void) {
  const int version = PAPI_library_init(PAPI_VER_CURRENT);
  const char *reason = NULL;
  begun = version == PAPI_VER_CURRENT;
  if (!begun)
    reason = version > 0 ? "PAPI's library and header are of different versions" : PAPI_strerror(version);
  else
    reason = core_component_reason();
  int open = 0;
  for (int k = 0; k < COUNTER_COUNT; k++) {
    counters[k].reason = reason;
    if (reason == NULL)
      open_counter(&counters[k]);
    open += counters[k].reason == NULL;
  }
  if (open == COUNTER_COUNT)
    snprintf(overall, sizeof overall, "available (PAPI)");
  else if (open > 0)
    snprintf(overall, sizeof overall, "%d of %d available (PAPI)", open, COUNTER_COUNT);
  else
    snprintf(overall, sizeof overall, "NA: PAPI finds no hardware counters here (%s)",
             counters[0].reason != NULL ? counters[0].reason : "no reason given");
  return overall;
}

const char *counter_reason(int k) {
  return counters[k].reason;
}

void counters_measure(void (*work)(void *), void *context, double value[COUNTER_COUNT]) {
  for (int k = 0; k < COUNTER_COUNT; k++) {
    long long count;
    value[k] = NAN;
    if (counters[k].set == PAPI_NULL || PAPI_start(counters[k].set) != PAPI_OK)
      continue;
    work(context);
    if (PAPI_stop(counters[k].set, &count) == PAPI_OK)
      value[k] = (double)count;
  }
}

void counters_end(void) {
  if (!begun)
    return;
  for (int k = 0; k < COUNTER_COUNT; k++)
    drop(&counters[k], NULL);
  PAPI_shutdown();
  begun = false;
}
