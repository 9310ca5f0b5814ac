/* Loaded before the C library (LD_PRELOAD), refuses the allocation of number CAROM_REFUSE, from
 * 1, and all that follow, or where CAROM_REFUSE_ONE is not empty that one alone. Says "refused"
 * to standard error at the first. */
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

static atomic_long requests;
static long first, last;

__attribute__((constructor)) static void begin(void) {
  const char *const text = getenv("CAROM_REFUSE"), *const single = getenv("CAROM_REFUSE_ONE");
  first = text != NULL ? strtol(text, NULL, 10) : 0;
  last = single != NULL && *single != '\0' ? first : 1000000000;
}

static int refused(void) {
  const long number = first == 0 ? 0 : ++requests;
  if (number < first || number > last || first == 0)
    return 0;
  if (number == first && write(STDERR_FILENO, "refused\n", 8) != 8)
    _exit(3);
  errno = ENOMEM;
  return 1;
}

void *malloc(size_t size) {
  return refused() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
  return refused() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *block, size_t size) {
  return refused() ? NULL : __libc_realloc(block, size);
}
