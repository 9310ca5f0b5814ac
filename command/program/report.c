/* What a report of a bug needs: versions, compiler, system and processor. */
#include "program/report.h"

#include "carom.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>
#include <unistd.h>

#ifdef __clang__
#define COMPILER "clang " __clang_version__
#else
#define COMPILER "gcc " __VERSION__
#endif

int print_report(const char *name) {
  struct utsname system = {.sysname = "unknown system"};
  uname(&system);
  printf("%s %s, physics revision %d\n", name, carom_version(), carom_physics_revision());
  printf("compiled by %s\n", COMPILER);
  printf("on %s %s, %s, %ld processors\n", system.sysname, system.release, system.machine,
         sysconf(_SC_NPROCESSORS_ONLN));

  /* the instruction sets that this processor has and the library was built for */
  printf("instruction sets");
  const char *set;
  for (int isa = 0; (set = carom_word(CAROM_WORDS_ISA, isa)) != NULL; isa++)
    if (carom_isa_available((carom_isa)isa))
      printf(" %s", set);
  printf("; in force: %s\n", carom_word(CAROM_WORDS_ISA, (int)carom_isa_in_force()));

  /* what changes results or messages */
  static const char *const variables[] = {"CAROM_ISA", "LC_ALL", "LANG"};
  for (size_t k = 0; k < sizeof variables / sizeof variables[0]; k++)
    if (getenv(variables[k]) != NULL)
      printf("%s=%s\n", variables[k], getenv(variables[k]));
  puts("\nAdd the command or call, its input (of a shot: what `carom shoot ... --json` writes), "
       "what "
       "it\nsaid, and what you expected. With CAROM_ISA=plain, do others see the same?");
  if (CAROM_TRACKER[0] != '\0')
    puts("Report at " CAROM_TRACKER);
  return 0;
}
