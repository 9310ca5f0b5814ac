/* Pictures that gnuplot draws, in a temporary folder: the CSV and the picture are moved or dropped when it is done. */
#include "picture.h"

#include "gnuplot.h"
#include "message.h"
#include "output.h"
#include "place.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool picture_name_fits(const char *path) {
  const size_t size = strlen(path);
  if (size > 4 && (strcmp(path + size - 4, ".svg") == 0 || strcmp(path + size - 4, ".png") == 0))
    return true;
  complain("--plot draws a picture whose name ends in .svg or .png, not '%s'", path);
  return false;
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

static bool draw(const char *path, const char *name, const char *title, const char *folder, const char *extension) {
  char scripts[PATH_MAX], script[PATH_MAX + 64], file[16], picture[PATH_MAX + 32];
  place_find(CAROM_SOURCE_LAB "/figures", CAROM_INSTALLED_SHARE "/figures", scripts);
  snprintf(script, sizeof script, "%s/%s.gp", scripts, name);
  snprintf(file, sizeof file, "picture%s", extension);
  snprintf(picture, sizeof picture, "%s/%s", folder, file);
  const int code = gnuplot_run(folder, script, "data.csv", file, title);
  const bool drawn = code == 0 && access(picture, R_OK) == 0;
  if (code == NO_GNUPLOT)
    complain("cannot draw %s: %s", path, no_gnuplot);
  else if (!drawn)
    complain("cannot draw %s: gnuplot failed on %s", path, script);
  const bool good = drawn && move(picture, path);
  unlink(picture);
  return good;
}

/* A new folder that only this user may enter; complains if there can be none. */
static bool make_folder(char folder[PATH_MAX]) {
  const char *temporary = getenv("TMPDIR");
  if (temporary == NULL || temporary[0] == '\0')
    temporary = P_tmpdir;
  for (int attempt = 0; attempt < 100; attempt++) {
    snprintf(folder, PATH_MAX, "%s/carom-%ld-%d", temporary, (long)getpid(), attempt);
    if (mkdir(folder, 0700) == 0)
      return true;
    if (errno != EEXIST)
      break;
  }
  complain("cannot make a folder in %s: %s", temporary, strerror(errno));
  return false;
}

bool picture_draw(const char *path, const char *name, const char *title, void (*write)(FILE *out, const void *data),
                  const void *data) {
  char folder[PATH_MAX], csv[PATH_MAX + 16];
  if (!make_folder(folder))
    return false;
  snprintf(csv, sizeof csv, "%s/data.csv", folder);
  const bool good = write_csv(csv, write, data) && draw(path, name, title, folder, path + strlen(path) - 4);
  unlink(csv);
  rmdir(folder);
  return good;
}
