/* A file that appears whole or not at all. */
#include "output.h"

#include "message.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static FILE *file;
static const char *name;     /* for messages */
static char place[PATH_MAX]; /* where the file is to be */
/* Beside it, and whether it is there: read by the signal handler, and so never freed. */
static char temporary[PATH_MAX];
static volatile sig_atomic_t there;

static void on_signal(int number) {
  if (there)
    unlink(temporary);
  signal(number, SIG_DFL);
  raise(number);
}

static void forget(void) {
  file = NULL;
  there = 0;
}

/* Signals that end the program wait while a file appears or goes that the handler must know of. */
static void hold_signals(bool hold) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  sigprocmask(hold ? SIG_BLOCK : SIG_UNBLOCK, &set, NULL);
}

/* Writes into `place` where a path leads in the end, through symbolic links even to what is not there yet. */
static bool follow_links(const char *path) {
  char link[PATH_MAX], folder[PATH_MAX];
  struct stat status;
  if (realpath(path, place) != NULL)
    return true;
  bool good = snprintf(place, PATH_MAX, "%s", path) < PATH_MAX;
  for (int k = 0; good && k < 40 && lstat(place, &status) == 0 && S_ISLNK(status.st_mode); k++) {
    const ssize_t size = readlink(place, link, PATH_MAX - 1);
    good = size > 0;
    link[good ? size : 0] = '\0';
    strcpy(folder, place);
    good = good && (link[0] == '/' ? snprintf(place, PATH_MAX, "%s", link)
                                   : snprintf(place, PATH_MAX, "%s/%s", dirname(folder), link)) < PATH_MAX;
  }
  return good;
}

/* NULL with errno where it cannot be written. */
static FILE *open_beside(const char *path) {
  struct stat old;
  if (!follow_links(path)) {
    errno = ENAMETOOLONG;
    return NULL;
  }
  const bool exists = stat(place, &old) == 0;
  if (exists && access(place, W_OK) != 0)
    return NULL;
  if (snprintf(temporary, PATH_MAX, "%s.%s", place, random_name) >= PATH_MAX) {
    errno = ENAMETOOLONG;
    return NULL;
  }
  signal(SIGINT, on_signal);
  signal(SIGTERM, on_signal);
  signal(SIGHUP, on_signal);
  hold_signals(true);
  const int descriptor = mkostemp(temporary, O_CLOEXEC);
  there = descriptor >= 0;
  hold_signals(false);
  if (descriptor < 0)
    return exists ? fopen(place, "wb") : NULL;
  /* A file's owner and mode stay; a new one's are what the system and the umask leave. */
  const mode_t mask = umask(0);
  umask(mask);
  if (exists && fchown(descriptor, old.st_uid, old.st_gid) != 0) {
    close(descriptor);
    unlink(temporary);
    there = 0;
    return fopen(place, "wb");
  }
  fchmod(descriptor, exists ? old.st_mode & 07777 : 0666 & ~mask);
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
  if (good && there) {
    hold_signals(true);
    good = rename(temporary, place) == 0;
    there = !good;
    hold_signals(false);
  }
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
  if (there)
    unlink(temporary);
  forget();
}
