/* random EXECUTIONS [SEED]: the fuzz target without a fuzzer, on random bytes, each from a seed of its own. Every hundredth
 * seed is printed, so a failure is among the hundred from the last one on: `random 100 THAT`. */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int main(int count, char **arguments) {
  enum { SIZE = 512 };
  const long executions = count > 1 ? strtol(arguments[1], NULL, 10) : 1000;
  const char *const given = getenv("CAROM_TEST_SEED");
  const uint64_t seed = strtoull(count > 2 ? arguments[2] : given != NULL ? given : "20141", NULL, 10);
  static uint8_t data[SIZE];
  for (long n = 0; n < executions; n++) {
    if (n % 100 == 0) {
      printf("seed %" PRIu64 "\n", seed + (uint64_t)n);
      fflush(stdout);
    }
    uint64_t state = (seed + (uint64_t)n) * 0x2545f4914f6cdd1du;
    for (int k = 0; k < SIZE; k++) {
      /* splitmix64 */
      uint64_t z = state += 0x9e3779b97f4a7c15u;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      data[k] = (uint8_t)(z >> 56);
    }
    LLVMFuzzerTestOneInput(data, SIZE);
  }
  return 0;
}
