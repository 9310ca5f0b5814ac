/* Pictures that gnuplot draws. It reads the CSV and writes the picture in memory, so that no temporary file can stay behind; a
 * picture that is whole then goes to its place. */
#include "picture.h"

#include "message.h"
#include "output.h"
#include "place.h"

#include <errno.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NO_GNUPLOT = 127 };

OPTION_SET(set_picture) {
  const size_t size = strlen(text);
  *(const char **)field = text;
  if (size > 4 && (strcmp(text + size - 4, ".svg") == 0 || strcmp(text + size - 4, ".png") == 0))
    return true;
  complain("--%s draws a picture whose name ends in .svg or .png, not '%s'", row->name, text);
  return false;
}

/* Files in memory: nothing has to be removed, however this process or gnuplot ends. */
typedef struct work {
  FILE *csv, *noise, *picture;
} work;

/* A file in memory, which the child inherits. Complains and returns NULL if there can be none. */
static FILE *in_memory(const char *name) {
  const int descriptor = memfd_create(name, 0);
  FILE *file = descriptor >= 0 ? fdopen(descriptor, "w+b") : NULL;
  if (file == NULL)
    complain("cannot make a file in memory: %s", strerror(errno));
  return file;
}

static void forget(const work *w) {
  FILE *const files[] = {w->csv, w->noise, w->picture};
  for (size_t k = 0; k < sizeof files / sizeof files[0]; k++)
    if (files[k] != NULL)
      fclose(files[k]);
}

/* What gnuplot says is shown only if it fails: it also warns of every part of a plot that a CSV has no rows for, and those are
 * optional. False after a complaint. */
static bool run_gnuplot(const work *w, const char *path, const char *name, const char *title) {
  char scripts[PATH_MAX], script[PATH_MAX + 64], data[32];
  int status;
  snprintf(script, sizeof script, "%s/%s.gp", place_find("figures", scripts), name);
  snprintf(data, sizeof data, "/dev/fd/%d", fileno(w->csv));
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) {
    if (dup2(fileno(w->picture), STDOUT_FILENO) >= 0 && dup2(fileno(w->noise), STDERR_FILENO) >= 0)
      execlp("gnuplot", "gnuplot", "-c", script, data, path + strlen(path) - 4, title, (char *)NULL);
    _exit(NO_GNUPLOT);
  }
  if (child < 0 || waitpid(child, &status, 0) != child)
    status = -1;
  if (status == 0)
    return true;
  if (WIFEXITED(status) && WEXITSTATUS(status) == NO_GNUPLOT)
    complain("cannot draw %s: gnuplot is not installed (Debian: gnuplot-nox)", path);
  else {
    output_copy(w->noise, stderr);
    complain("cannot draw %s: gnuplot failed on %s", path, script);
  }
  return false;
}

bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data) {
  const work w = {in_memory("data"), in_memory("noise"), in_memory("picture")};
  FILE *out = NULL;
  if (w.csv != NULL && w.noise != NULL && w.picture != NULL) {
    write(w.csv, data);
    out = run_gnuplot(&w, path, name, title) ? output_open(path) : NULL;
  }
  bool good = out != NULL && output_copy(w.picture, out) > 0;
  if (out != NULL && !good) {
    complain("cannot draw %s: gnuplot drew nothing", path);
    output_abandon();
  }
  good = good && output_commit();
  forget(&w);
  return good;
}
