/* A file that appears whole or not at all. */
#include "output.h"

#include "message.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static FILE *file;
static const char *name; /* for messages */
static char *place;      /* NULL where the output streams */
static char *temporary;  /* beside it; read by the signal handler */

static void on_signal(int number) {
  if (temporary != NULL)
    unlink(temporary);
  signal(number, SIG_DFL);
  raise(number);
}

static void forget(void) {
  free(place);
  free(temporary);
  file = NULL;
  place = temporary = NULL;
}

static FILE *open_beside(const char *path) {
  place = realpath(path, NULL); /* so that a link stays a link to the new file */
  if (place == NULL)
    place = strdup(path);
  if (place == NULL)
    return NULL;
  signal(SIGINT, on_signal);
  signal(SIGTERM, on_signal);
  signal(SIGHUP, on_signal);
  char *beside;
  if (asprintf(&beside, "%s.XXXXXX", place) < 0)
    return NULL;
  const int descriptor = mkostemp(beside, O_CLOEXEC);
  if (descriptor < 0) {
    free(beside); /* which keeps errno */
    return NULL;
  }
  temporary = beside;
  /* A file's mode stays; a new one's is what the umask leaves. */
  const mode_t mask = umask(0);
  umask(mask);
  struct stat old;
  fchmod(descriptor, stat(path, &old) == 0 ? old.st_mode & 07777 : 0666 & ~mask);
  return fdopen(descriptor, "wb");
}

FILE *output_open(const char *path) {
  struct stat status;
  name = strcmp(path, "-") == 0 ? "standard output" : path;
  if (strcmp(path, "-") == 0)
    file = stdout;
  else if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
    file = fopen(path, "wb");
  else
    file = open_beside(path);
  if (file == NULL) {
    complain("cannot write %s: %s", name, strerror(errno));
    output_abandon();
    return NULL;
  }
  return file;
}

bool output_commit(void) {
  bool good = fflush(file) == 0 && !ferror(file);
  if (file != stdout)
    good = fclose(file) == 0 && good;
  file = NULL;
  if (good && place != NULL)
    good = rename(temporary, place) == 0;
  if (!good) {
    complain("cannot write %s: %s", name, strerror(errno));
    output_abandon();
    return false;
  }
  forget();
  return true;
}

void output_abandon(void) {
  if (file != NULL && file != stdout)
    fclose(file);
  if (temporary != NULL)
    unlink(temporary);
  forget();
}
