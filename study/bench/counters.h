/* Hardware counters of the calling thread, in user mode, by the system call perf_event_open(2).
 *
 * An event is a row of a table, because each maker of processors has its own names and codes. The
 * counts of one or several events make a column. A column is NAN where the processor has no such
 * event or the kernel does not count it, and counters_describe() gives the reason. Nothing is
 * scaled: events that do not fit into the processor together form several groups, one of which
 * counts at a time. */
#ifndef CAROM_BENCH_COUNTERS_H
#define CAROM_BENCH_COUNTERS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* X(NAME, column in the CSV) */
#define COUNTER_LIST(X)                         \
  X(CYCLES, "cycles")                           \
  X(INSTRUCTIONS, "instructions")               \
  X(FLOPS, "flops")                             \
  X(DIV_SQRT, "div_sqrt")                       \
  X(FMA, "fma")                                 \
  X(STALLS_FP_SCHEDULER, "stalls_fp_scheduler") \
  X(STALLS_FP_REGISTERS, "stalls_fp_registers") \
  X(STALLS_RETIRE, "stalls_retire")             \
  X(STALLS_RESOURCES, "stalls_resources")       \
  X(STALLS_EXECUTION, "stalls_execution")

typedef enum counter_column {
#define COUNTER_ENUM(NAME, column) COUNTER_##NAME,
  COUNTER_LIST(COUNTER_ENUM)
#undef COUNTER_ENUM
      COUNTER_COLUMNS
} counter_column;

/* The name of a column in a CSV. */
const char *counter_column_name(counter_column column);

/* Kinds of cores that have the same events; a set of them is a sum. */
typedef enum counter_core {
  CORE_UNKNOWN = 1,
  CORE_ZEN2 = 2,
  CORE_ZEN3 = 4,
  CORE_ZEN4 = 8,
  CORE_ZEN5 = 16,
  CORE_SKYLAKE = 32,
  CORE_SKYLAKE_SERVER = 64,
  CORE_ICE_LAKE = 128,
  CORE_SAPPHIRE_RAPIDS = 256,
  CORE_ANY = 511
} counter_core;

/* The core of a processor by what the instruction cpuid reports: "AuthenticAMD", 0x17, 0x71. */
counter_core counter_core_of(const char *vendor, unsigned family, unsigned model);

typedef struct counter_row {
  unsigned cores; /* a set of counter_core */
  counter_column column;
  const char *name;
  uint32_t type; /* and code: as struct perf_event_attr has them */
  uint64_t code;
  double weight; /* a count of the event adds so much to the column */
} counter_row;

extern const counter_row counter_table[];
extern const size_t counter_table_size;

typedef struct counter_set counter_set;

/* Opens the events of counter_table for this processor, or the events of `rows` for `core`. What
 * cannot be counted is left out. */
counter_set *counters_open_here(void);
counter_set *counters_open(const counter_row *rows, size_t count, counter_core core);
void counters_close(counter_set *set);

/* One line: which columns are counted by which events, which are not, and why. */
void counters_describe(const counter_set *set, FILE *out);

size_t counters_groups(const counter_set *set);
size_t counters_events(const counter_set *set);

/* Counts what the thread does between the two calls by the events of one group. count[k] is the
 * count of event k, NAN for events of other groups, or where the kernel did not count all the
 * time. */
void counters_start(const counter_set *set, size_t group);
void counters_stop(const counter_set *set, size_t group, double *count);

/* The columns from the counts of all events. */
void counters_columns(const counter_set *set, const double *count, double column[COUNTER_COLUMNS]);

#endif
