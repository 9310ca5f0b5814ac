/* The events, and how they are opened.
 *
 * Names and codes are from the tables of Linux, tools/perf/pmu-events/arch/x86: amdzen2 to amdzen5
 * (floating-point.json; other.json, for Zen 5 decode.json), skylake, skylakex, icelakex,
 * sapphirerapids (floating-point.json, pipeline.json). They follow AMD's Processor Programming
 * References (PMCx003, PMCx0AE, PMCx0AF) and Intel's perfmon lists. A raw code is the event, its
 * unit mask << 8, and its counter mask << 24. No event of Intel's counts only divisions or fused
 * multiply-adds, so those columns have no Intel row. */
#include "counters.h"

#include "program/program.h"

#include <errno.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

enum {
  ZEN = CORE_ZEN2 + CORE_ZEN3 + CORE_ZEN4 + CORE_ZEN5,
  ZEN2_TO_4 = CORE_ZEN2 + CORE_ZEN3 + CORE_ZEN4,
  ALL_SKYLAKE = CORE_SKYLAKE + CORE_SKYLAKE_SERVER,
  INTEL_AVX512 = CORE_SKYLAKE_SERVER + CORE_ICE_LAKE + CORE_SAPPHIRE_RAPIDS,
  INTEL = CORE_SKYLAKE + INTEL_AVX512,
  MOST_IN_GROUP = 32
};

/* AMD counts a fused multiply-add as two operations, hence the weight 0.5 of "fma". Intel's events
 * count vectors, once for each kind of vector and twice where an instruction adds and multiplies,
 * hence the weights of "flops"; they include least and greatest, and approximations of 1/x.
 *
 * The paper's token stalls are cycles in which an instruction could be dispatched, and a resource
 * is missing: an entry in a scheduler, a register, an entry in the retire queue. AMD has an
 * event for each of them. Intel has one for all of them together, "stalls_resources": a cycle on
 * Skylake, and a slot on its successors, which issue in 5 or 6 slots a cycle, hence the weights.
 * Another event, "stalls_execution", counts cycles in which no unit begins anything. The paper
 * reads no such event. */
const counter_row counter_table[] = {
    {CORE_ANY, COUNTER_CYCLES, "PERF_COUNT_HW_CPU_CYCLES", PERF_TYPE_HARDWARE,
     PERF_COUNT_HW_CPU_CYCLES, 1.0},
    {CORE_ANY, COUNTER_INSTRUCTIONS, "PERF_COUNT_HW_INSTRUCTIONS", PERF_TYPE_HARDWARE,
     PERF_COUNT_HW_INSTRUCTIONS, 1.0},
    {ZEN, COUNTER_FLOPS, "fp_ret_sse_avx_ops (add, mul, div, mac)", PERF_TYPE_RAW, 0x0f03, 1.0},
    {ZEN, COUNTER_DIV_SQRT, "fp_ret_sse_avx_ops.div_flops", PERF_TYPE_RAW, 0x0403, 1.0},
    {ZEN, COUNTER_FMA, "fp_ret_sse_avx_ops.mac_flops", PERF_TYPE_RAW, 0x0803, 0.5},
    {ZEN2_TO_4, COUNTER_STALLS_FP_SCHEDULER, "de_dis_dispatch_token_stalls1.fp_sch_rsrc_stall",
     PERF_TYPE_RAW, 0x40ae, 1.0},
    {CORE_ZEN5, COUNTER_STALLS_FP_SCHEDULER,
     "de_dispatch_stall_cycle_dynamic_tokens_part1.fp_sch_rsrc_stall", PERF_TYPE_RAW, 0x40ae, 1.0},
    {ZEN2_TO_4, COUNTER_STALLS_FP_REGISTERS, "de_dis_dispatch_token_stalls1.fp_reg_file_rsrc_stall",
     PERF_TYPE_RAW, 0x20ae, 1.0},
    {CORE_ZEN2, COUNTER_STALLS_RETIRE, "de_dis_dispatch_token_stalls0.retire_token_stall",
     PERF_TYPE_RAW, 0x20af, 1.0},
    {CORE_ZEN3 + CORE_ZEN4, COUNTER_STALLS_RETIRE,
     "de_dis_dispatch_token_stalls2.retire_token_stall", PERF_TYPE_RAW, 0x20af, 1.0},
    {CORE_ZEN5, COUNTER_STALLS_RETIRE, "de_dispatch_stall_cycle_dynamic_tokens_part2.retq",
     PERF_TYPE_RAW, 0x20af, 1.0},
    {INTEL, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.SCALAR", PERF_TYPE_RAW, 0x03c7, 1.0},
    {INTEL, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.128B_PACKED_DOUBLE", PERF_TYPE_RAW, 0x04c7, 2.0},
    {INTEL, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.4_FLOPS", PERF_TYPE_RAW, 0x18c7, 4.0},
    {CORE_SKYLAKE, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.256B_PACKED_SINGLE", PERF_TYPE_RAW, 0x20c7,
     8.0},
    {INTEL_AVX512, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.8_FLOPS", PERF_TYPE_RAW, 0x60c7, 8.0},
    {INTEL_AVX512, COUNTER_FLOPS, "FP_ARITH_INST_RETIRED.512B_PACKED_SINGLE", PERF_TYPE_RAW, 0x80c7,
     16.0},
    {ALL_SKYLAKE, COUNTER_STALLS_RESOURCES, "RESOURCE_STALLS.ANY", PERF_TYPE_RAW, 0x01a2, 1.0},
    {CORE_ICE_LAKE, COUNTER_STALLS_RESOURCES, "TOPDOWN.BACKEND_BOUND_SLOTS", PERF_TYPE_RAW, 0x02a4,
     1.0 / 5.0},
    {CORE_SAPPHIRE_RAPIDS, COUNTER_STALLS_RESOURCES, "TOPDOWN.BACKEND_BOUND_SLOTS", PERF_TYPE_RAW,
     0x02a4, 1.0 / 6.0},
    {INTEL, COUNTER_STALLS_EXECUTION, "CYCLE_ACTIVITY.STALLS_TOTAL", PERF_TYPE_RAW, 0x040004a3,
     1.0},
};
const size_t counter_table_size = COUNT_OF(counter_table);

const char *counter_column_name(counter_column column) {
#define COUNTER_NAME(NAME, column) column,
  static const char *const names[] = {COUNTER_LIST(COUNTER_NAME)};
#undef COUNTER_NAME
  return names[column];
}

/* ---- The processor */

/* The models are from Linux's mapfile.csv, next to the tables of events. */
counter_core counter_core_of(const char *vendor, unsigned family, unsigned model) {
  static const struct {
    const char *vendor;
    unsigned family, first, last; /* models */
    counter_core core;
  } known[] = {
      {"AuthenticAMD", 0x17, 0x30, 0xff, CORE_ZEN2},
      {"AuthenticAMD", 0x19, 0x00, 0x0f, CORE_ZEN3},
      {"AuthenticAMD", 0x19, 0x20, 0x2f, CORE_ZEN3},
      {"AuthenticAMD", 0x19, 0x40, 0x5f, CORE_ZEN3},
      {"AuthenticAMD", 0x19, 0x10, 0x1f, CORE_ZEN4},
      {"AuthenticAMD", 0x19, 0x60, 0xaf, CORE_ZEN4},
      {"AuthenticAMD", 0x1a, 0x00, 0x2f, CORE_ZEN5},
      {"AuthenticAMD", 0x1a, 0x40, 0x4f, CORE_ZEN5},
      {"AuthenticAMD", 0x1a, 0x60, 0x7f, CORE_ZEN5},
      {"GenuineIntel", 6, 0x4e, 0x4e, CORE_SKYLAKE}, /* Skylake and its successors */
      {"GenuineIntel", 6, 0x5e, 0x5e, CORE_SKYLAKE},
      {"GenuineIntel", 6, 0x8e, 0x8e, CORE_SKYLAKE},
      {"GenuineIntel", 6, 0x9e, 0x9e, CORE_SKYLAKE},
      {"GenuineIntel", 6, 0xa5, 0xa6, CORE_SKYLAKE},
      {"GenuineIntel", 6, 0x55, 0x55, CORE_SKYLAKE_SERVER}, /* Skylake of servers */
      {"GenuineIntel", 6, 0x6a, 0x6a, CORE_ICE_LAKE},       /* Ice, Tiger and Rocket Lake */
      {"GenuineIntel", 6, 0x6c, 0x6c, CORE_ICE_LAKE},
      {"GenuineIntel", 6, 0x7d, 0x7e, CORE_ICE_LAKE},
      {"GenuineIntel", 6, 0x8c, 0x8d, CORE_ICE_LAKE},
      {"GenuineIntel", 6, 0xa7, 0xa7, CORE_ICE_LAKE},
      {"GenuineIntel", 6, 0x8f, 0x8f, CORE_SAPPHIRE_RAPIDS}, /* Sapphire and Emerald Rapids */
      {"GenuineIntel", 6, 0xcf, 0xcf, CORE_SAPPHIRE_RAPIDS},
  };
  for (size_t k = 0; k < COUNT_OF(known); k++)
    if (strcmp(vendor, known[k].vendor) == 0 && family == known[k].family &&
        model >= known[k].first && model <= known[k].last)
      return known[k].core;
  return CORE_UNKNOWN;
}

/* Is this a virtual machine, according to the processor? */
static bool has_hypervisor(void) {
#if defined(__x86_64__)
  unsigned a, b, c, d;
  __cpuid(1, a, b, c, d);
  return (c >> 31 & 1) != 0;
#else
  return false;
#endif
}

static counter_core core_here(void) {
#if defined(__x86_64__)
  unsigned a, b, c, d;
  char vendor[13] = "";
  __cpuid(0, a, b, c, d);
  memcpy(vendor, &b, 4);
  memcpy(vendor + 4, &d, 4);
  memcpy(vendor + 8, &c, 4);
  /* family and model have extensions, which only these two families need */
  __cpuid(1, a, b, c, d);
  unsigned family = a >> 8 & 0xf, model = a >> 4 & 0xf;
  if (family == 0xf || family == 6)
    model += (a >> 16 & 0xf) << 4;
  if (family == 0xf)
    family += a >> 20 & 0xff;
  return counter_core_of(vendor, family, model);
#else
  return CORE_UNKNOWN;
#endif
}

/* ---- Events that are open */

typedef struct event {
  const counter_row *row;
  int file, leader;
  size_t group;
} event;

struct counter_set {
  event *event;
  size_t count, groups;
  bool known[COUNTER_COLUMNS];  /* has it rows for this core? */
  int refusal[COUNTER_COLUMNS]; /* errno of the first of them that could not be opened, or 0 */
};

/* What the kernel writes for a group. */
typedef struct group_reading {
  uint64_t events, enabled, running; /* the times in ns */
  uint64_t count[MOST_IN_GROUP];
} group_reading;

static int open_event(const counter_row *row, int leader) {
  struct perf_event_attr attributes = {.size = sizeof attributes,
                                       .type = row->type,
                                       .config = row->code,
                                       .disabled = leader < 0,
                                       .exclude_kernel = 1,
                                       .exclude_hv = 1,
                                       .read_format = PERF_FORMAT_GROUP |
                                                      PERF_FORMAT_TOTAL_TIME_ENABLED |
                                                      PERF_FORMAT_TOTAL_TIME_RUNNING};
  return (int)syscall(SYS_perf_event_open, &attributes, 0, -1, leader, PERF_FLAG_FD_CLOEXEC);
}

/* Only the leader is enabled and disabled; the kernel does the same with the others. Enabled one by
 * one, events of software would start at the next tick of the kernel only. */
static void start(int leader) {
  ioctl(leader, PERF_EVENT_IOC_RESET, PERF_IOC_FLAG_GROUP);
  ioctl(leader, PERF_EVENT_IOC_ENABLE, 0);
}

static bool stop(int leader, group_reading *reading) {
  ioctl(leader, PERF_EVENT_IOC_DISABLE, 0);
  return read(leader, reading, sizeof *reading) > 0;
}

/* Does the kernel count the group at all? Another user, such as its watchdog, may hold a counter
 * that the group needs; the kernel accepts the group and never lets it run. */
static bool is_counted(int leader) {
  group_reading reading;
  start(leader);
  return stop(leader, &reading) && reading.running > 0 && reading.running == reading.enabled;
}

/* Opens an event within the last group, or else as the first of a new one. False: errno has the
 * reason. */
static bool add_event(counter_set *set, const counter_row *row) {
  int leader = -1;
  size_t others = 0;
  for (size_t k = 0; k < set->count; k++)
    if (set->event[k].group + 1 == set->groups) {
      leader = set->event[k].leader;
      others++;
    }
  int file = -1;
  if (leader >= 0 && others < MOST_IN_GROUP) {
    file = open_event(row, leader);
    if (file >= 0 && !is_counted(leader)) {
      close(file);
      file = -1;
    }
  }
  if (file < 0) {
    leader = file = open_event(row, -1);
    if (file < 0)
      return false;
    if (!is_counted(file)) {
      close(file);
      errno = EBUSY;
      return false;
    }
    set->groups++;
  }
  set->event[set->count++] = (event){row, file, leader, set->groups - 1};
  return true;
}

counter_set *counters_open(const counter_row *rows, size_t count, counter_core core) {
  counter_set *set = allocate(1, sizeof *set);
  set->event = allocate(count + 1, sizeof *set->event);
  for (size_t k = 0; k < count; k++) {
    if ((rows[k].cores & (unsigned)core) == 0)
      continue;
    int *refusal = &set->refusal[rows[k].column];
    set->known[rows[k].column] = true;
    if (!add_event(set, &rows[k]) && *refusal == 0)
      *refusal = errno;
  }
  return set;
}

counter_set *counters_open_here(void) {
  return counters_open(counter_table, counter_table_size, core_here());
}

void counters_close(counter_set *set) {
  if (set == NULL)
    return;
  for (size_t k = set->count; k-- > 0;)
    close(set->event[k].file);
  free(set->event);
  free(set);
}

/* ---- Counting */

size_t counters_groups(const counter_set *set) {
  return set->groups;
}

size_t counters_events(const counter_set *set) {
  return set->count;
}

/* The first event of a group. */
static const event *leader_of(const counter_set *set, size_t group) {
  const event *e = set->event;
  while (e->group != group)
    e++;
  return e;
}

void counters_start(const counter_set *set, size_t group) {
  start(leader_of(set, group)->file);
}

void counters_stop(const counter_set *set, size_t group, double *count) {
  const event *leader = leader_of(set, group);
  group_reading reading;
  const bool whole = stop(leader->file, &reading) && reading.running == reading.enabled;
  for (size_t k = 0; k < set->count; k++)
    count[k] = NAN;
  for (size_t k = 0; whole && k < reading.events; k++)
    count[(size_t)(leader - set->event) + k] = (double)reading.count[k];
}

void counters_columns(const counter_set *set, const double *count, double column[COUNTER_COLUMNS]) {
  for (int c = 0; c < COUNTER_COLUMNS; c++) {
    column[c] = 0.0;
    if (!set->known[c] || set->refusal[c] != 0)
      column[c] = NAN;
  }
  for (size_t k = 0; k < set->count; k++)
    column[set->event[k].row->column] += set->event[k].row->weight * count[k];
}

/* ---- Words */

static void explain(int error, FILE *out) {
  char paranoid[16] = "unknown";
  FILE *file = fopen("/proc/sys/kernel/perf_event_paranoid", "r");
  if (file != NULL && fgets(paranoid, sizeof paranoid, file) != NULL)
    paranoid[strcspn(paranoid, "\n")] = '\0';
  if (file != NULL)
    fclose(file);
  const char *why = strerror(error);
  if (error == ENOENT || error == ENODEV || error == EOPNOTSUPP)
    why = "the kernel sees no such counter in this processor, as in most virtual machines";
  else if (error == EACCES || error == EPERM)
    why = "the kernel does not allow it; sysctl kernel.perf_event_paranoid=2 does, unless a "
          "container forbids the call";
  else if (error == EBUSY)
    why = "others hold the counters, perhaps the kernel's watchdog (sysctl kernel.nmi_watchdog=0)";
  fprintf(out, "%s (perf_event_open: errno %d, perf_event_paranoid %s)", why, error, paranoid);
}

/* Names the columns that are counted (`error` 0), have no event (-1), or are rejected with that
 * errno; false where there are none. */
static bool name_columns(const counter_set *set, int error, FILE *out) {
  bool any = false;
  for (int c = 0; c < COUNTER_COLUMNS; c++) {
    int of_column = set->refusal[c];
    if (!set->known[c])
      of_column = -1;
    if (of_column != error)
      continue;
    const char *separators[] = {"", ", "};
    fprintf(out, "%s%s", separators[any], counter_column_name((counter_column)c));
    any = true;
  }
  return any;
}

void counters_describe(const counter_set *set, FILE *out) {
  if (name_columns(set, 0, out)) {
    fputs(" counted per collision, in user mode, by", out);
    for (size_t k = 0; k < set->count; k++)
      if (set->refusal[set->event[k].row->column] == 0)
        fprintf(out, " %s", set->event[k].row->name);
    fprintf(out, ", in %zu group(s) that take turns by rounds; ", set->groups);
    if (has_hypervisor())
      fputs("this is a virtual machine, and an event that its host hides counts 0; ", out);
  }
  /* each errno once, with its columns */
  for (int c = 0; c < COUNTER_COLUMNS; c++) {
    bool first = set->refusal[c] != 0;
    for (int earlier = 0; earlier < c; earlier++)
      first = first && set->refusal[earlier] != set->refusal[c];
    if (!first)
      continue;
    name_columns(set, set->refusal[c], out);
    fputs(" not measured: ", out);
    explain(set->refusal[c], out);
    fputs("; ", out);
  }
  if (name_columns(set, -1, out))
    fputs(" not measured: no event of this processor is known for them; ", out);
  fputs("ns are of the clock", out);
}
