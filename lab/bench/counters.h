/* Hardware counters through PAPI, where the build has PAPI and the machine has counters. Where one is missing its value is NAN
 * and there is a reason: never 0, never a failure. */
#ifndef CAROM_BENCH_COUNTERS_H
#define CAROM_BENCH_COUNTERS_H

/* X(NAME, column, what it counts, events): the first event that the machine knows is used. The token stalls are cycles in
 * which the processor had something to dispatch and no room for it: the AMD events of Zen 1 and 2, then those of Zen 3 and 4.
 */
#define COUNTER_LIST(X)                                                                                             \
  X(CYCLES, "cycles", "core cycles", "PAPI_TOT_CYC")                                                                \
  X(INSTRUCTIONS, "instructions", "instructions retired", "PAPI_TOT_INS")                                           \
  X(FLOPS, "flops", "floating point operations retired", "RETIRED_SSE_AVX_FLOPS:ANY", "PAPI_FP_OPS", "PAPI_DP_OPS") \
  X(STALL_FP_SCHEDULER, "stall_fp_scheduler", "dispatch cycles without a token of the floating point scheduler",    \
    "DISPATCH_RESOURCE_STALL_CYCLES_1:FP_SCHEDULER_FILE_RSRC_STALL",                                                \
    "DISPATCH_RESOURCE_STALL_CYCLES_1:FP_SCHEDULER_RSRC_STALL")                                                     \
  X(STALL_FP_REGISTERS, "stall_fp_registers", "dispatch cycles without a floating point register",                  \
    "DISPATCH_RESOURCE_STALL_CYCLES_1:FP_REG_FILE_RSRC_STALL")                                                      \
  X(STALL_RETIRE, "stall_retire", "dispatch cycles without a token of the retire queue",                            \
    "DISPATCH_RESOURCE_STALL_CYCLES_0:RETIRE_TOKEN_STALL", "DISPATCH_RESOURCE_STALL_CYCLES_2:RETIRE_TOKEN_STALL")   \
  X(L1_ACCESSES, "l1_accesses", "accesses to the first data cache", "PAPI_L1_DCA", "perf::L1-DCACHE-LOADS")         \
  X(BRANCH_MISSES, "branch_misses", "branches predicted wrongly", "PAPI_BR_MSP", "perf::BRANCH-MISSES")

enum {
#define COUNTER_ENUM(NAME, ...) COUNTER_##NAME,
  COUNTER_LIST(COUNTER_ENUM)
#undef COUNTER_ENUM
      COUNTER_COUNT
};

/* The column's name in a CSV and what it counts, for 0 <= k < COUNTER_COUNT. */
const char *counter_column(int k);
const char *counter_text(int k);

/* Looks which counters there are; to be called first. Returns "available", or "NA" with the reason. Valid until the next call.
 */
const char *counters_begin(void);

/* NULL if counter k works, else why not. */
const char *counter_reason(int k);

/* Counts what `work(context)` does in this thread: each counter in a run of its own, so that none has to share. value[k] is
 * NAN where there is no counter k. */
void counters_measure(void (*work)(void *), void *context, double value[COUNTER_COUNT]);

void counters_end(void);

#endif
