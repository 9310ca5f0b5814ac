/* latency: the latencies of this processor, measured in core cycles without any counter.
 *
 * A chain of dependent integer additions advances by one core cycle an addition on every processor
 * of interest (of registers: some add constants while they rename, several in a cycle), so its time
 * is the length of a cycle, at whatever clock the core runs just now. Chains of other instructions
 * are timed alternately with it, and the least time of many rounds is divided by the cycle.
 * Operands have full significands where a division or a square root might otherwise end early. If a
 * chain needs a helper (a repeated square root converges to 1), the helper's latency is subtracted.
 *
 * Output: CSV, `row,cycles,ns`; the rows are as in latencies.csv, and `cycle`, the integer
 * addition: its ns is one core cycle.
 */
#define _POSIX_C_SOURCE 200809L
#include "monotonic.h"

#include <stdio.h>

/* X(name, row, instructions of one link, its helper or itself, how often the row is in a
 * link). The value of the chain is in xmm0 or rax and begins with 1.618...; 2.718... is in xmm2,
 * 0 in xmm3, 1 in xmm4, scratch memory is at -512(rsp): as compilers address it, and below what
 * the function may use itself. */
#define CHAINS(X)                                                                                 \
  X(cycle, "cycle", "add %%rax, %%rax\n\t", cycle, 1)                                             \
  X(add, "add", "vaddsd %%xmm4, %%xmm0, %%xmm0\n\t", add, 1)                                      \
  X(mul, "mul", "vmulsd %%xmm4, %%xmm0, %%xmm0\n\t", mul, 1)                                      \
  X(fma, "fma", "vfmadd213sd %%xmm3, %%xmm4, %%xmm0\n\t", fma, 1)                                 \
  X(div_d, "div.d", "vdivsd %%xmm0, %%xmm2, %%xmm0\n\t", div_d, 1)                                \
  X(div_s, "div.s", "vdivss %%xmm0, %%xmm2, %%xmm0\n\t", div_s, 1)                                \
  X(sqrt_d, "sqrt.d", "vsqrtsd %%xmm0, %%xmm0, %%xmm0\n\tvmulsd %%xmm2, %%xmm0, %%xmm0\n\t", mul, \
    1)                                                                                            \
  X(sqrt_s, "sqrt.s", "vsqrtss %%xmm0, %%xmm0, %%xmm0\n\tvmulss %%xmm2, %%xmm0, %%xmm0\n\t", mul, \
    1)                                                                                            \
  X(rsqrt, "rsqrt", "vrsqrtss %%xmm0, %%xmm0, %%xmm0\n\t", rsqrt, 1)                              \
  X(convert, "convert",                                                                           \
    "vcvtsd2ss %%xmm0, %%xmm0, %%xmm0\n\tvcvtss2sd %%xmm0, %%xmm0, %%xmm0\n\t", convert, 2)       \
  X(minmax, "minmax", "vmaxsd %%xmm4, %%xmm0, %%xmm0\n\t", minmax, 1)                             \
  X(logic, "logic", "vandpd %%xmm0, %%xmm2, %%xmm0\n\t", logic, 1)                                \
  X(shuffle, "shuffle", "vshufpd $1, %%xmm0, %%xmm0, %%xmm0\n\t", shuffle, 1)                     \
  X(cross, "cross", "vperm2f128 $1, %%ymm0, %%ymm0, %%ymm0\n\t", cross, 1)                        \
  X(extract, "extract", "vextractf128 $1, %%ymm0, %%xmm0\n\t", extract, 1)                        \
  X(broadcast, "broadcast", "vbroadcastsd %%xmm0, %%ymm0\n\t", broadcast, 1)                      \
  X(hadd, "hadd", "vhaddpd %%xmm3, %%xmm0, %%xmm0\n\t", hadd, 1)                                  \
  X(dot, "dot", "vdpps $0x71, %%xmm4, %%xmm0, %%xmm0\n\t", dot, 1)                                \
  X(transfer, "transfer", "vmovq %%xmm0, %%rax\n\tvmovq %%rax, %%xmm0\n\t", transfer, 2)          \
  X(load, "load",                                                                                 \
    "vmovsd %%xmm0, -512(%%rsp)\n\tvmovsd -512(%%rsp), %%xmm0\n\tvaddsd %%xmm3, %%xmm0, "         \
    "%%xmm0\n\t",                                                                                 \
    add, 1)

#if defined(__x86_64__) && defined(__GNUC__)

enum { ROUNDS = 400, TURNS = 50, LINKS = 100 };

static const double full[2][2] = {{1.61803398874989, 1.0}, {2.71828182845904, 1.0}},
                    unit[2] = {1.0, 1.0};

/* The whole loop is one piece of assembly: a value set again between two iterations would let them
 * overlap. */
#define TIME(name, row, instructions, helper, times)                                             \
  static double time_##name(void) {                                                              \
    int turns = TURNS;                                                                           \
    const double begin = clock_ns();                                                             \
    __asm__ volatile("vmovupd %1, %%xmm0\n\tvmovupd %2, %%xmm2\n\tvmovupd %3, %%xmm4\n\tvxorpd " \
                     "%%xmm3, %%xmm3, %%xmm3\n1:\n\t.rept 100\n\t" instructions                  \
                     ".endr\n\tdec %0\n\tjnz 1b\n\tvzeroupper\n\t"                               \
                     : "+r"(turns)                                                               \
                     : "m"(full[0]), "m"(full[1]), "m"(unit)                                     \
                     : "rax", "xmm0", "xmm2", "xmm3", "xmm4", "memory", "cc");                   \
    return (clock_ns() - begin) / (TURNS * LINKS);                                               \
  }
CHAINS(TIME)

enum {
#define NUMBER(name, row, instructions, helper, times) NUMBER_##name,
  CHAINS(NUMBER) COUNT
};

typedef struct chain {
  const char *row;
  int number, helper, times;
  double (*time)(void);
} chain;

int main(void) {
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2")) {
    fprintf(stderr, "skipped: this processor has no AVX2 and FMA, whose latencies are measured\n");
    return 77;
  }
  static const chain chains[] = {
#define ROW(name, row, instructions, helper, times) \
  {row, NUMBER_##name, NUMBER_##helper, times, time_##name},
      CHAINS(ROW)};
  double least[COUNT];
  for (int k = 0; k < COUNT; k++)
    least[k] = 1e9;
  for (int round = 0; round < ROUNDS; round++)
    for (int k = 0; k < COUNT; k++) {
      const double t = chains[k].time();
      least[k] = t < least[k] ? t : least[k];
    }
  printf("row,cycles,ns\n");
  for (int k = 0; k < COUNT; k++) {
    const double helper = chains[k].helper == k ? 0.0 : least[chains[k].helper];
    const double ns = (least[k] - helper) / chains[k].times;
    printf("%s,%.2f,%.4f\n", chains[k].row, ns / least[NUMBER_cycle], ns);
  }
  return 0;
}

#else

int main(void) {
  fprintf(stderr, "skipped: measures x86-64 processors only\n");
  return 77;
}

#endif
