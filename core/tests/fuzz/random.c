/* random CORPUS EXECUTIONS [SEED]: a fuzz target without a fuzzer: first on the inputs of the
 * corpus, one in hexadecimal digits a line, then on random bytes, each from its own seed.
 * Every hundredth seed is printed, so a failure is among the hundred from the last one on:
 * `random /dev/null 100 THAT`. An input that takes 5 s of processor time is a failure too. */
#include <ctype.h>
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { SIZE = 640, MOST = 4096 };
static uint8_t data[MOST];

static void run(size_t size) {
  const clock_t before = clock();
  LLVMFuzzerTestOneInput(data, size);
  if (clock() - before > 5 * CLOCKS_PER_SEC) {
    fprintf(stderr, "random: an input takes %.1f s\n", (double)(clock() - before) / CLOCKS_PER_SEC);
    abort();
  }
}

/* One of 16 digits, or -1. */
static int digit(int character) {
  if (isdigit(character))
    return character - '0';
  return character >= 'a' && character <= 'f' ? character - 'a' + 10 : -1;
}

/* Runs every line; the number of them, or -1 where the file cannot be read. */
static long replay(const char *path) {
  FILE *const file = fopen(path, "r");
  if (file == NULL)
    return -1;
  long lines = 0;
  size_t size = 0;
  for (int high = getc(file); high != EOF; high = getc(file)) {
    const int low = high == '\n' ? 0 : getc(file);
    if (high == '\n') {
      lines++;
      run(size);
      size = 0;
    } else if (digit(high) < 0 || digit(low) < 0 || size == MOST) {
      fclose(file);
      return -1;
    } else
      data[size++] = (uint8_t)(16 * digit(high) + digit(low));
  }
  fclose(file);
  return lines;
}

int main(int count, char **arguments) {
  if (count < 3) {
    fprintf(stderr, "usage: random CORPUS EXECUTIONS [SEED]\n");
    return 2;
  }
  const long lines = replay(arguments[1]), executions = strtol(arguments[2], NULL, 10);
  if (lines < 0) {
    fprintf(stderr, "random: %s: lines of at most %d bytes in hexadecimal digits are needed\n",
            arguments[1], MOST);
    return 2;
  }
  printf("%ld inputs of the corpus\n", lines);
  const char *const given = getenv("CAROM_TEST_SEED");
  const char *seed_text = given != NULL ? given : "20141";
  if (count > 3)
    seed_text = arguments[3];
  const uint64_t seed = strtoull(seed_text, NULL, 10);
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
    run(SIZE);
  }
  return 0;
}
