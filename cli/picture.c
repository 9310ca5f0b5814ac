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

bool picture_name_fits(const char *path) {
  const size_t size = strlen(path);
  if (size > 4 && (strcmp(path + size - 4, ".svg") == 0 || strcmp(path + size - 4, ".png") == 0))
    return true;
  complain("--plot draws a picture whose name ends in .svg or .png, not '%s'", path);
  return false;
}

/* Its exit code. gnuplot's words come out on stderr only if it fails: it warns of parts for which a CSV has no rows. */
static int run_gnuplot(const char *script, const char *csv, const char *picture, const char *title) {
  FILE *noise = tmpfile();
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) {
    if (noise == NULL || dup2(fileno(noise), STDERR_FILENO) >= 0)
      execlp("gnuplot", "gnuplot", "-c", script, csv, picture, title, (char *)NULL);
    _exit(NO_GNUPLOT);
  }
  int status;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status);
  const int code = ended ? WEXITSTATUS(status) : 1;
  if (noise != NULL && code != 0 && code != NO_GNUPLOT) {
    char block[4096];
    rewind(noise);
    for (size_t size; (size = fread(block, 1, sizeof block, noise)) > 0;)
      fwrite(block, 1, size, stderr);
  }
  if (noise != NULL)
    fclose(noise);
  return code;
}

static bool move(const char *from, const char *to) {
  FILE *in = fopen(from, "rb"), *out = in != NULL ? output_open(to) : NULL;
  char block[65536];
  for (size_t size; out != NULL && (size = fread(block, 1, sizeof block, in)) > 0;)
    fwrite(block, 1, size, out);
  if (in != NULL)
    fclose(in);
  return out != NULL && output_commit();
}

static bool write_csv(const char *path, void (*write)(FILE *out, const void *data), const void *data) {
  FILE *out = fopen(path, "wb");
  if (out != NULL)
    write(out, data);
  const bool good = out != NULL && !ferror(out);
  if ((out == NULL || fclose(out) != 0 || !good)) {
    complain("cannot write %s: %s", path, strerror(errno));
    return false;
  }
  return true;
}

static bool draw(const char *path, const char *name, const char *title, const char *csv, const char *picture) {
  char folder[PATH_MAX], script[PATH_MAX + 64];
  place_find(CAROM_SOURCE_LAB "/figures", CAROM_INSTALLED_SHARE "/figures", folder);
  snprintf(script, sizeof script, "%s/%s.gp", folder, name);
  const int code = run_gnuplot(script, csv, picture, title);
  if (code == NO_GNUPLOT)
    complain("cannot draw %s: gnuplot is not installed (Debian: gnuplot-nox)", path);
  else if (code != 0 || access(picture, R_OK) != 0)
    complain("cannot draw %s: gnuplot failed on %s", path, script);
  return code == 0 && access(picture, R_OK) == 0 && move(picture, path);
}

bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data) {
  const char *temporary = getenv("TMPDIR");
  char folder[PATH_MAX], csv[PATH_MAX + 16], picture[PATH_MAX + 16];
  snprintf(folder, sizeof folder, "%s/carom-XXXXXX", temporary != NULL && temporary[0] != '\0' ? temporary : "/tmp");
  if (mkdtemp(folder) == NULL) {
    complain("cannot make a folder beside %s: %s", folder, strerror(errno));
    return false;
  }
  snprintf(csv, sizeof csv, "%s/data.csv", folder);
  snprintf(picture, sizeof picture, "%s/picture%s", folder, path + strlen(path) - 4);
  const bool good = write_csv(csv, write, data) && draw(path, name, title, csv, picture);
  unlink(csv);
  unlink(picture);
  rmdir(folder);
  return good;
}
