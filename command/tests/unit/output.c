/* A file that appears whole or not at all, whenever the process is told to end.
 *
 * The linker puts the functions below in place of those of the C library that touch files,
 * signals or memory. Each is a moment: a child process writes a file, and at the moment of its
 * number a signal ends it, just before the call or just after. Children go through all moments
 * one by one. Each must die of that signal, leave the old file or the new one, and nothing
 * beside it; and its handler must unlink nothing but the file beside. The same where no file can
 * be made beside the old one, which is then overwritten. Freed memory is overwritten first, so
 * that a handler that reads it is seen without an address sanitizer too. */
#include "program/output.h"
#include "program/message.h"
#include "support.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STRANGE = 99, MOST_MOMENTS = 400, SIGNALS = 5 };
static const int signals[SIGNALS] = {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGXFSZ};
static const char old_text[] = "old, and longer\n", new_text[] = "new\n";

static volatile int moment, told_to_end = -1, signal_number;
static volatile sig_atomic_t counting;
static char folder[4096], path[4200], beside[4200];
static bool sealed, full; /* no file can be made in the folder; the disk is full */

static void pass_moment(void) {
  if (!counting)
    return;
  if (moment++ == told_to_end)
    raise(signal_number);
}

#define AROUND(type, call) \
  pass_moment();           \
  type result = (call);    \
  const int kept = errno;  \
  pass_moment();           \
  errno = kept;            \
  return result

#define WRAP(type, name, declared, given)                \
  type __real_##name declared;                           \
  type __wrap_##name declared; /* which has no header */ \
  type __wrap_##name declared {                          \
    AROUND(type, __real_##name given);                   \
  }

int __real_mkostemp(char *name, int flags);
int __wrap_mkostemp(char *name, int flags);
int __wrap_mkostemp(char *name, int flags) {
  if (sealed)
    errno = EACCES;
  AROUND(int, sealed ? -1 : __real_mkostemp(name, flags));
}

int __real_posix_fallocate(int descriptor, off_t from, off_t size);
int __wrap_posix_fallocate(int descriptor, off_t from, off_t size);
int __wrap_posix_fallocate(int descriptor, off_t from, off_t size) {
  AROUND(int, full ? ENOSPC : __real_posix_fallocate(descriptor, from, size));
}

WRAP(FILE *, tmpfile, (void), ())
WRAP(int, ftruncate, (int descriptor, off_t size), (descriptor, size))
WRAP(int, rename, (const char *from, const char *to), (from, to))
WRAP(int, fclose, (FILE * file), (file))
WRAP(int, fflush, (FILE * file), (file))
WRAP(FILE *, fdopen, (int descriptor, const char *mode), (descriptor, mode))
WRAP(FILE *, fopen, (const char *name, const char *mode), (name, mode))
WRAP(int, fchmod, (int descriptor, mode_t mode), (descriptor, mode))
WRAP(int, fchown, (int descriptor, uid_t owner, gid_t group), (descriptor, owner, group))
WRAP(int, sigprocmask, (int how, const sigset_t *set, sigset_t *old), (how, set, old))
WRAP(char *, realpath, (const char *name, char *resolved), (name, resolved))

int __real_unlink(const char *name);
int __wrap_unlink(const char *name);
int __wrap_unlink(const char *name) {
  if (!counting)
    return __real_unlink(name);
  if (strncmp(name, beside, strlen(beside)) != 0)
    _exit(STRANGE); /* not the file beside: what was read is not its name */
  AROUND(int, __real_unlink(name));
}

void __real_free(void *memory);
void __wrap_free(void *memory);
void __wrap_free(void *memory) {
  pass_moment();
  if (memory != NULL && counting)
    memset(memory, 0x5a, malloc_usable_size(memory));
  __real_free(memory);
  pass_moment();
}

/* What a child does: writes a file, and keeps it or drops it. Returns its exit code. */
static int write_file(bool keep) {
  FILE *out = output_open(path);
  if (out == NULL)
    return 1;
  fputs(new_text, out);
  if (!keep)
    output_abandon();
  else if (!output_commit())
    return 1;
  counting = 0;
  return 0;
}

/* The file's text, which is the old or the new one, and nothing else is in the folder. */
static const char *text_there(void) {
  static char text[64];
  FILE *in = fopen(path, "rb");
  ck_assert_ptr_nonnull(in);
  text[fread(text, 1, sizeof text - 1, in)] = '\0';
  fclose(in);
  DIR *listing = opendir(folder);
  int others = 0;
  for (const struct dirent *entry; (entry = readdir(listing)) != NULL;)
    others += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
              strcmp(entry->d_name, "out") != 0;
  closedir(listing);
  ck_assert_msg(others == 0, "moment %d, signal %d: a file is left behind", told_to_end,
                signal_number);
  return text;
}

static void put_old(void) {
  FILE *out = fopen(path, "wb");
  ck_assert_ptr_nonnull(out);
  fputs(old_text, out);
  fclose(out);
}

/* Returns how the child ended, as waitpid() has it. */
static int run_child(bool keep) {
  fflush(NULL);
  const pid_t child = fork();
  ck_assert_int_ge(child, 0);
  if (child == 0) {
    for (size_t k = 0; k < SIGNALS; k++)
      signal(signals[k], SIG_DFL); /* Check has handlers of its own */
    counting = 1;
    _exit(write_file(keep));
  }
  int status;
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  return status;
}

/* Goes through all moments; checks that there were enough of them before the new file is in its
 * place, and some behind. */
static void go_through_moments(void) {
  int kept_old = 0, kept_new = 0, ended = 0;
  for (int keep = 0; keep < 2; keep++) {
    int status = -1;
    for (told_to_end = 0; told_to_end < MOST_MOMENTS && status != 0; told_to_end++) {
      signal_number = signals[told_to_end % SIGNALS];
      put_old();
      status = run_child(keep != 0);
      const char *text = text_there();
      const bool is_new = strcmp(text, new_text) == 0;
      ck_assert_msg(is_new || strcmp(text, old_text) == 0, "moment %d: '%s'", told_to_end, text);
      if (status == 0) {
        ck_assert_int_eq(is_new, keep);
        break;
      }
      ck_assert_msg(WIFSIGNALED(status) && WTERMSIG(status) == signal_number,
                    "moment %d, signal %d: ended with status %#x", told_to_end, signal_number,
                    (unsigned)status);
      kept_old += !is_new;
      kept_new += is_new;
      ended++;
    }
    ck_assert_int_eq(status, 0); /* the last went through all moments */
  }
  ck_assert_int_ge(ended, 30);
  ck_assert(kept_old > 20 && kept_new > 0);
}

START_TEST(a_signal_at_every_moment) {
  go_through_moments();
}
END_TEST

START_TEST(a_signal_at_every_moment_in_a_sealed_folder) {
  sealed = true;
  go_through_moments();
  sealed = false;
}
END_TEST

START_TEST(a_full_disk_in_a_sealed_folder) {
  sealed = full = true;
  told_to_end = -1;
  put_old();
  const int status = run_child(true);
  sealed = full = false;
  ck_assert_int_eq(WEXITSTATUS(status), 1);
  ck_assert_str_eq(text_there(), old_text);
}
END_TEST

int main(void) {
  const char *temporary = getenv("TMPDIR");
  snprintf(folder, sizeof folder, "%s/carom-output-%s", temporary != NULL ? temporary : P_tmpdir,
           random_name);
  if (mkdtemp(folder) == NULL)
    return 1;
  char *whole = realpath(folder, NULL); /* as output.c has it, whatever links lead there */
  snprintf(path, sizeof path, "%s/out", whole);
  snprintf(beside, sizeof beside, "%s/.carom-", whole);
  free(whole);
  const int code =
      RUN_TESTS("output", a_signal_at_every_moment, a_signal_at_every_moment_in_a_sealed_folder,
                a_full_disk_in_a_sealed_folder);
  __real_unlink(path);
  rmdir(folder);
  return code;
}
