/* Where files lie that came with carom. */
#include "place.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

const char *place_find(const char *source, const char *installed, char path[PATH_MAX]) {
  snprintf(path, PATH_MAX, "%s", source);
  if (access(source, R_OK) == 0)
    return path;
  char program[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", program, sizeof program - 1);
  if (size <= 0)
    return path;
  program[size] = '\0';
  char *slash = strrchr(program, '/');
  *(slash != NULL ? slash : program) = '\0';
  if (strlen(program) + strlen(installed) + sizeof "/../" <= PATH_MAX) {
    strcpy(path, program);
    strcat(strcat(path, "/../"), installed);
  }
  return path;
}
