/* Pictures that gnuplot draws, in a temporary folder: the CSV and the picture are moved or dropped when it is done. */
#include "picture.h"

#include "message.h"
#include "output.h"
#include "place.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
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

/* The working folder, which only this user may enter, and the files in it. */
typedef struct work {
  char folder[PATH_MAX], csv[PATH_MAX], noise[PATH_MAX], picture[PATH_MAX];
} work;

/* Complains if there can be none. */
static bool make_work(work *w, const char *ending) {
  const char *own = getenv("TMPDIR"), *temporary = own != NULL && own[0] != '\0' ? own : P_tmpdir;
  const int size = snprintf(w->folder, PATH_MAX - 16, "%s/carom-%s", temporary, random_name);
  if (size >= PATH_MAX - 16 || mkdtemp(w->folder) == NULL) {
    complain("cannot make a folder in %s: %s", temporary, strerror(errno));
    return false;
  }
  strcat(strcpy(w->csv, w->folder), "/data.csv");
  strcat(strcpy(w->noise, w->folder), "/noise");
  strcat(strcat(strcpy(w->picture, w->folder), "/picture"), ending);
  return true;
}

/* Copies a file to a stream; false if it cannot be read. */
static bool copy(const char *from, FILE *to) {
  FILE *in = fopen(from, "rb");
  char block[65536];
  for (size_t size; in != NULL && (size = fread(block, 1, sizeof block, in)) > 0;)
    fwrite(block, 1, size, to);
  const bool good = in != NULL && !ferror(in);
  if (in != NULL)
    fclose(in);
  return good;
}

/* What gnuplot says is shown only if it fails: it also warns of every part of a plot that a CSV has no rows for, and those are
 * optional. False after a complaint. */
static bool run_gnuplot(const work *w, const char *path, const char *name, const char *title) {
  char scripts[PATH_MAX], script[PATH_MAX + 64];
  int status;
  snprintf(script, sizeof script, "%s/%s.gp", place_find("figures", scripts), name);
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(w->folder) == 0 && freopen("noise", "wb", stderr) != NULL)
      execlp("gnuplot", "gnuplot", "-c", script, "data.csv", w->picture, title, (char *)NULL);
    _exit(NO_GNUPLOT);
  }
  if (child < 0 || waitpid(child, &status, 0) != child)
    status = -1;
  if (status == 0 && access(w->picture, R_OK) == 0)
    return true;
  if (WIFEXITED(status) && WEXITSTATUS(status) == NO_GNUPLOT)
    complain("cannot draw %s: gnuplot is not installed (Debian: gnuplot-nox)", path);
  else {
    copy(w->noise, stderr);
    complain("cannot draw %s: gnuplot failed on %s", path, script);
  }
  return false;
}

bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data) {
  work w;
  if (!make_work(&w, path + strlen(path) - 4))
    return false;
  FILE *out = output_open(w.csv);
  if (out != NULL)
    write(out, data);
  out = out != NULL && output_commit() && run_gnuplot(&w, path, name, title) ? output_open(path) : NULL;
  const bool good = out != NULL && copy(w.picture, out) && output_commit();
  unlink(w.csv);
  unlink(w.noise);
  unlink(w.picture);
  rmdir(w.folder);
  return good;
}
