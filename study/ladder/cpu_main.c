/* ladder_cpu FILE: writes this machine's processor as a C header, unless the file says so
 * already. */
#include "cpu.h"

int main(int argc, char **argv) {
  char cpu[LADDER_CPU_SIZE], line[2 * LADDER_CPU_SIZE], old[2 * LADDER_CPU_SIZE] = "";
  if (argc != 2)
    return 2;
  ladder_cpu(cpu);
  snprintf(line, sizeof line, "#define LADDER_CPU \"%s\"\n", cpu);
  FILE *file = fopen(argv[1], "r");
  if (file != NULL) {
    const size_t length = fread(old, 1, sizeof old - 1, file);
    old[length] = '\0';
    fclose(file);
  }
  if (strcmp(old, line) == 0)
    return 0;
  file = fopen(argv[1], "w");
  if (file == NULL || fputs(line, file) < 0 || fclose(file) != 0) {
    perror(argv[1]);
    return 1;
  }
  return 0;
}
