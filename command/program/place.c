/* Where files lie that came with carom. CAROM_SHARE is the way from the installed program's
 * folder to theirs. */
#include "program/place.h"

#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

const char *place_find(const char *name, char path[PATH_MAX]) {
  static const char *const ways[] = {CAROM_SHARE, "share/carom"};
  char program[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", program, PATH_MAX - 1);
  program[size > 0 ? size : 0] = '\0'; /* where the system does not tell, the working folder has
                                          to do */
  const char *folder = dirname(program);
  for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++)
    if (snprintf(path, PATH_MAX, "%s/%s/%s", folder, ways[k], name) < PATH_MAX &&
        access(path, R_OK) == 0)
      break;
  return path;
}

const char *data_folder(const char *chosen_folder) {
  static char folder[PATH_MAX];
  const char *variable = getenv("CAROM_DATA");
  if (chosen_folder != NULL)
    return chosen_folder;
  return variable != NULL && variable[0] != '\0' ? variable : place_find("data", folder);
}
