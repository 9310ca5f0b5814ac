/* A file that appears whole or not at all. */
#include "program/output.h"

#include "program/message.h"

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
static volatile sig_atomic_t unfinished;
/* Or the file itself, -1 if it is not open: where none can stand beside it, an unnamed file
 * takes the text until it is whole.
 */
static int itself = -1;

static void on_signal(int number) {
  if (unfinished)
    unlink(temporary);
  signal(number, SIG_DFL);
  raise(number);
}

static void forget(void) {
  file = NULL;
  unfinished = 0;
  itself = -1;
}

/* The signals that by default end a program: all but these. */
static void list_ending(sigset_t *set) {
  static const int others[] = {SIGKILL, SIGSTOP, SIGCHLD, SIGCONT, SIGTSTP,
                               SIGTTIN, SIGTTOU, SIGURG,  SIGWINCH};
  sigfillset(set);
  for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
    sigdelset(set, others[k]);
}

/* Has them handled, but for those that are ignored, as nohup and a shell's & leave them, or that
 * someone else handles. */
static void handle_signals(void) {
  struct sigaction current, handler = {.sa_handler = on_signal};
  list_ending(&handler.sa_mask);
  for (int number = 1; number <= SIGRTMAX; number++)
    if (sigismember(&handler.sa_mask, number) == 1 && sigaction(number, NULL, &current) == 0 &&
        (current.sa_flags & SA_SIGINFO) == 0 && current.sa_handler == SIG_DFL)
      sigaction(number, &handler, NULL);
}

/* Has them wait while a file appears or goes that the handler must know of, or while a file is
 * overwritten. */
static void hold_signals(bool hold) {
  static sigset_t previous;
  sigset_t set;
  list_ending(&set);
  if (hold)
    sigprocmask(SIG_BLOCK, &set, &previous);
  else
    sigprocmask(SIG_SETMASK, &previous, NULL);
}

/* Writes into `place` where a path leads in the end, through symbolic links even to what is not
 * there yet: the system makes that for a moment. False with errno. */
static bool follow_links(const char *path) {
  if (realpath(path, place) != NULL)
    return true;
  hold_signals(true);
  const int descriptor = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  bool good = descriptor >= 0 && close(descriptor) == 0 && realpath(path, place) != NULL;
  good = good && unlink(place) == 0;
  hold_signals(false);
  return good;
}

/* Makes the file beside the place, under a name that is short however long that of the place is.
 * False with errno. */
static bool make_beside(void) {
  const char *slash = strrchr(place, '/');
  int folder = 0;
  if (slash != NULL)
    folder = (int)(slash + 1 - place);
  if (snprintf(temporary, PATH_MAX, "%.*s.carom-%s", folder, place, random_name) >= PATH_MAX) {
    errno = ENAMETOOLONG;
    return false;
  }
  handle_signals();
  hold_signals(true);
  const int descriptor = mkostemp(temporary, O_CLOEXEC);
  unfinished = descriptor >= 0;
  hold_signals(false);
  if (unfinished && (file = fdopen(descriptor, "wb")) == NULL) {
    close(descriptor);
    output_abandon();
  }
  return file != NULL;
}

/* NULL with errno where there is no such file, or it cannot be written. */
static FILE *open_itself(void) {
  itself = open(place, O_WRONLY | O_CLOEXEC);
  if (itself < 0)
    return NULL;
  hold_signals(true); /* some systems give the unnamed file a name for a moment */
  FILE *unnamed = tmpfile();
  hold_signals(false);
  return unnamed;
}

/* NULL with errno where it cannot be written. */
static FILE *open_beside(const char *path) {
  struct stat old;
  if (!follow_links(path))
    return NULL;
  const bool exists = stat(place, &old) == 0;
  if (exists && access(place, W_OK) != 0)
    return NULL;
  if (!make_beside() && !exists)
    return NULL;
  if (file == NULL)
    return open_itself();
  /* A file's owner and mode stay; a new one's are what the system and the umask leave. */
  const mode_t mask = umask(0);
  umask(mask);
  if (exists && fchown(fileno(file), old.st_uid, old.st_gid) != 0) {
    output_abandon();
    return open_itself();
  }
  fchmod(fileno(file), exists ? old.st_mode & 07777 : 0666 & ~mask);
  return file;
}

FILE *input_open(const char *path) {
  if (strcmp(path, "-") == 0)
    return stdin;
  FILE *in = fopen(path, "rb");
  if (in == NULL)
    complain("cannot read %s: %s", path, strerror(errno));
  return in;
}

bool input_lines(const char *path, bool (*read)(void *context, const char *line, size_t size),
                 void *context) {
  FILE *in = input_open(path);
  if (in == NULL)
    return false;
  char *line = NULL;
  size_t space = 0;
  ssize_t size;
  bool good = true;
  while (good && (size = getline(&line, &space, in)) >= 0)
    good = read(context, line, (size_t)size);
  if (good && ferror(in)) {
    complain("cannot read %s: %s", path, strerror(errno));
    good = false;
  }
  free(line);
  if (in != stdin)
    fclose(in);
  return good;
}

const char *input_name(const char *path) {
  return strcmp(path, "-") == 0 ? "standard input" : path;
}

FILE *output_open(const char *path) {
  struct stat status;
  const bool to_stdout = strcmp(path, "-") == 0, exists = !to_stdout && stat(path, &status) == 0;
  name = to_stdout ? "standard output" : path;
  if (to_stdout)
    file = stdout;
  else if (exists && !S_ISREG(status.st_mode))
    file = fopen(path, "wb");
  else if (exists || errno == ENOENT)
    file = open_beside(path);
  /* else no file can be there: a name is too long, links lead in a circle, a folder may not be
   * searched */
  if (file == NULL) {
    if (itself >= 0)
      complain("cannot write %s: its folder cannot be written, and no file can be made in %s: %s",
               name, P_tmpdir, strerror(errno));
    else
      complain("cannot write %s: %s", name, strerror(errno));
    output_abandon();
    return NULL;
  }
  return file;
}

bool output_possible(const char *path) {
  struct stat status;
  if (path == NULL || strcmp(path, "-") == 0 ||
      (stat(path, &status) == 0 && !S_ISREG(status.st_mode)))
    return true; /* what is no file is opened once */
  const bool good = output_open(path) != NULL;
  output_abandon();
  return good;
}

size_t output_copy(FILE *source, FILE *target) {
  char block[65536];
  size_t total = 0;
  rewind(source);
  for (size_t size; (size = fread(block, 1, sizeof block, source)) > 0; total += size)
    fwrite(block, 1, size, target);
  return total;
}

/* Copies the unnamed file over the file itself. The room is taken first, so that a full disk
 * leaves the old text. */
static bool put_in_place(void) {
  struct stat old, whole;
  FILE *target;
  if (fstat(itself, &old) != 0 || fstat(fileno(file), &whole) != 0 ||
      (target = fdopen(itself, "wb")) == NULL)
    return false; /* fdopen() shortens nothing */
  hold_signals(true);
  const int obstacle = whole.st_size > 0 ? posix_fallocate(itself, 0, whole.st_size) : 0;
  bool good = obstacle != ENOSPC && obstacle != EDQUOT && obstacle != EFBIG && obstacle != EIO;
  if (good)
    good = output_copy(file, target) == (size_t)whole.st_size && fflush(target) == 0 &&
           ftruncate(itself, whole.st_size) == 0;
  else if (ftruncate(itself, old.st_size) == 0) /* some of the room may have been taken */
    errno = obstacle;
  good = fclose(target) == 0 && good;
  itself = -1;
  hold_signals(false);
  return good;
}

bool output_commit(void) {
  bool good = fflush(file) == 0 && !ferror(file);
  if (good && itself >= 0)
    good = put_in_place();
  if (file != stdout)
    good = fclose(file) == 0 && good;
  file = NULL;
  if (good && unfinished) {
    hold_signals(true);
    good = rename(temporary, place) == 0;
    unfinished = !good;
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
  if (itself >= 0)
    close(itself);
  if (unfinished)
    unlink(temporary);
  forget();
}
