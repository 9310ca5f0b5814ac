/* Where and with what a figure was measured, from what Linux shows; elsewhere most of it is NA. */
#include "machine.h"

#include "commit.h"
#include "program/program.h"

#include <stdarg.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

void machine_note(FILE *out, const char *what, const char *format, ...) {
  char text[2000];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  for (char *c = text; *c != '\0'; c++)
    if (*c == '\n' || *c == '\r')
      *c = ' ';
  fprintf(out, "# %s: %s\n", what, text);
}

#if defined(__x86_64__)
#define CHAIN ".rept 100\n\tadd %0, %0\n\t.endr"
#elif defined(__aarch64__)
#define CHAIN ".rept 100\n\tadd %0, %0, %0\n\t.endr"
#endif

double clock_core_cycle(void) {
#ifdef CHAIN
  /* Reading the thread's time is a system call of up to 1 us, so the chain takes a hundred times as
   * long. Other programs do not lengthen it, so few rounds are enough. */
  enum { TURNS = 5000, LINKS = 100, ROUNDS = 3 };
  double least = INFINITY;
  unsigned long long value = 1;
  for (int round = 0; round < ROUNDS; round++) {
    const double begin = thread_ns();
    for (int turn = 0; turn < TURNS; turn++)
      __asm__ volatile(CHAIN : "+r"(value));
    least = fmin(least, (thread_ns() - begin) / (TURNS * LINKS));
  }
  return least;
#else
  return NAN;
#endif
}

/* The text behind "key ... : " in /proc/cpuinfo, or NULL. */
static const char *cpuinfo(const char *key, char *line, int size) {
  FILE *file = fopen("/proc/cpuinfo", "r");
  const char *found = NULL;
  while (file != NULL && found == NULL && fgets(line, size, file) != NULL) {
    const char *colon = strchr(line, ':');
    if (colon == NULL || strncmp(line, key, strlen(key)) != 0)
      continue;
    line[strcspn(line, "\n")] = '\0';
    found = colon + 1 + strspn(colon + 1, " ");
  }
  if (file != NULL)
    fclose(file);
  return found;
}

static void describe_processor(FILE *out) {
  char name[256], second[256];
  const char *model = cpuinfo("model name", name, sizeof name);
  const char *flags = cpuinfo("flags", (char[8192]){0}, 8192);
  machine_note(out, "processor", "%s", model != NULL ? model : "NA");
  const char *family = cpuinfo("cpu family", name, sizeof name),
             *number = cpuinfo("model\t", second, sizeof second);
  if (family != NULL && number != NULL)
    machine_note(out, "processor family", "%s, model %s", family, number);
  machine_note(out, "cores", "%ld online%s", sysconf(_SC_NPROCESSORS_ONLN),
               flags != NULL && strstr(flags, " hypervisor") != NULL
                   ? ", of a virtual machine: others may share them"
                   : "");
  const double cycle = clock_core_cycle();
  if (cycle > 0)
    machine_note(out, "core cycle", "%.4f ns", cycle);
}

void machine_describe(FILE *out) {
  describe_processor(out);
  struct utsname system;
  if (uname(&system) == 0)
    machine_note(out, "system", "%s %s %s", system.sysname, system.release, system.machine);
  double load;
  if (getloadavg(&load, 1) == 1)
    machine_note(out, "load before", "%.2f runnable threads in the last minute", load);
#if defined(__clang__)
  machine_note(out, "compiler", "%s", __VERSION__);
#else
  machine_note(out, "compiler", "gcc %s", __VERSION__);
#endif
  machine_note(out, "flags", "%s", CAROM_BUILD_FLAGS);
  machine_note(out, "commit", "%s", CAROM_COMMIT);
  char date[32];
  const time_t moment = time(NULL);
  struct tm utc;
  strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&moment, &utc));
  machine_note(out, "date", "%s", date);
}
