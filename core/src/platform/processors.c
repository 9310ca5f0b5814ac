/* How many processors this process may use. A container or a job scheduler often allows fewer
 * than the machine has: by affinity, or by a control group, which limits the processor time in a
 * period:
 *
 *     version 2   a line "0::PATH" in /proc/self/cgroup; the file ROOT/PATH/cpu.max holds "QUOTA
 *                 PERIOD", or "max PERIOD"
 *     version 1   a line "N:CONTROLLERS:PATH" with cpu among them;
 *                 ROOT/CONTROLLERS/PATH/cpu.cfs_quota_us, -1 for none, and cpu.cfs_period_us
 *
 * A group's limit holds for all groups below it, so the smallest on the way up counts. Inside a
 * container the path may be the path on the host, which is not mounted; the directory mounted at
 * ROOT then is the container's own group, and the way up ends there. Source: the Linux kernel's
 * documentation, admin-guide/cgroup-v2.rst and scheduler/sched-bwc.rst.
 */
#if defined(__linux__)
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include <sched.h>
#endif
#include "platform/processors.h"

#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 4096 };

/* Reads a small file as text, cut at TEXT - 1 characters; false where there is none. */
static bool read_text(const char *path, char text[TEXT]) {
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return false;
  size_t size = 0;
  ssize_t got;
  while (size < TEXT - 1 && (got = read(file, text + size, TEXT - 1 - size)) > 0)
    size += (size_t)got;
  close(file);
  text[size] = '\0';
  return true;
}

/* The number of processors of a quota, rounded up: half a processor is one thread. */
static int processors_of(long quota, long period) {
  if (quota <= 0 || period <= 0)
    return INT_MAX;
  const long count = quota / period + (quota % period != 0);
  if (count > INT_MAX)
    return INT_MAX;
  return (int)count;
}

static int lesser(int a, int b) {
  return a < b ? a : b;
}

/* The limit of one group, whose folder is the first `length` characters of `folder`. */
static int limit_of(const char *folder, int length, bool second_version) {
  char path[TEXT], text[TEXT], *rest;
  static const char *const names[] = {"cpu.cfs_quota_us", "cpu.max"};
  if (snprintf(path, sizeof path, "%.*s/%s", length, folder, names[second_version]) >= TEXT ||
      !read_text(path, text))
    return INT_MAX;
  const long quota = strtol(text, &rest, 10); /* "max" reads as 0, which is none */
  if (second_version)
    return processors_of(quota, strtol(rest, NULL, 10));
  if (snprintf(path, sizeof path, "%.*s/cpu.cfs_period_us", length, folder) >= TEXT ||
      !read_text(path, text))
    return INT_MAX;
  return processors_of(quota, strtol(text, NULL, 10));
}

/* The smallest limit from the group `path` up to the mount. */
static int least_on_the_way_up(const char *mount, const char *path, bool second_version) {
  char folder[TEXT];
  int limit = INT_MAX, length = snprintf(folder, sizeof folder, "%s%s", mount, path);
  if (length >= TEXT)
    return limit;
  for (const int top = (int)strlen(mount); length >= top; length--)
    if (length == top || (folder[length] == '\0' && folder[length - 1] != '/') ||
        folder[length] == '/') {
      limit = lesser(limit_of(folder, length, second_version), limit);
    }
  return limit;
}

/* Whether `word` is in a list of names with commas between them. */
static bool is_among(const char *names, const char *word) {
  const size_t size = strlen(word);
  for (const char *name = names; name != NULL; name = strchr(name, ',')) {
    name += *name == ',';
    if (strncmp(name, word, size) == 0 && (name[size] == ',' || name[size] == '\0'))
      return true;
  }
  return false;
}

int carom_group_limit(const char *self, const char *root) {
  char groups[TEXT], mount[TEXT], *next;
  int limit = INT_MAX;
  if (!read_text(self, groups))
    return limit;
  for (char *line = groups; *line != '\0'; line = next) {
    next = line + strcspn(line, "\n");
    if (*next != '\0')
      *next++ = '\0';
    /* number:controllers:path */
    char *controllers = strchr(line, ':'),
         *path = controllers != NULL ? strchr(controllers + 1, ':') : NULL;
    if (path == NULL)
      continue;
    *controllers++ = *path++ = '\0';
    const bool second_version = *controllers == '\0';
    if (!second_version && !is_among(controllers, "cpu"))
      continue;
    if (snprintf(mount, sizeof mount, "%s%s%s", root, second_version ? "" : "/", controllers) >=
        TEXT)
      continue;
    limit = lesser(least_on_the_way_up(mount, path, second_version), limit);
  }
  return limit;
}

static int affinity(void) {
#if defined(__linux__)
  cpu_set_t sets[8]; /* 8,192 processors */
  memset(sets, 0, sizeof sets);
  if (sched_getaffinity(0, sizeof sets, sets) == 0)
    return CPU_COUNT_S(sizeof sets, sets);
#endif
  const long online = sysconf(_SC_NPROCESSORS_ONLN);
  if (online <= 0 || online >= INT_MAX)
    return 1;
  return (int)online;
}

int carom_processors(void) {
  const int allowed = affinity(), limit = carom_group_limit("/proc/self/cgroup", "/sys/fs/cgroup");
  const int count = lesser(allowed, limit);
  if (count < 1)
    return 1;
  return count;
}
