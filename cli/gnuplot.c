/* Running gnuplot on a script of lab/figures, quiet unless it fails. */
#include "gnuplot.h"

#include <stdbool.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

const char no_gnuplot[] = "gnuplot is not installed (Debian: gnuplot-nox)";

static void show(FILE *noise) {
  char block[4096];
  rewind(noise);
  for (size_t size; (size = fread(block, 1, sizeof block, noise)) > 0;)
    fwrite(block, 1, size, stderr);
}

int gnuplot_run(const char *folder, const char *script, const char *csv, const char *picture, const char *title) {
  FILE *noise = tmpfile();
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) {
    if ((noise == NULL || dup2(fileno(noise), STDERR_FILENO) >= 0) && chdir(folder) == 0)
      execlp("gnuplot", "gnuplot", "-c", script, csv, picture, title, (char *)NULL);
    _exit(NO_GNUPLOT);
  }
  int status;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status);
  const int code = ended ? WEXITSTATUS(status) : 1;
  if (noise != NULL && code != 0)
    show(noise);
  if (noise != NULL)
    fclose(noise);
  return code;
}
