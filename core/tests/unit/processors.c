/* The processors that the process may use: its affinity, and the limits of control groups in
 * made-up trees of both versions. */
#define _GNU_SOURCE /* sched_setaffinity */
#include "platform/processors.h"
#include "support.h"

#include <limits.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

static char root[] = "groups-......"; /* in the build folder; the dots become what no other test
                                         has */

/* Writes ROOT/path, with the folders on the way to it. */
static void put(const char *path, const char *text) {
  char full[500];
  snprintf(full, sizeof full, "%s/%s", root, path);
  for (char *slash = strchr(full + strlen(root) + 1, '/'); slash != NULL;
       slash = strchr(slash + 1, '/')) {
    *slash = '\0';
    mkdir(full, 0700);
    *slash = '/';
  }
  FILE *file = fopen(full, "w");
  ck_assert_ptr_nonnull(file);
  fputs(text, file);
  ck_assert_int_eq(fclose(file), 0);
}

/* The limit for a process in these groups. */
static int limit(const char *groups) {
  char self[500];
  put("self", groups);
  snprintf(self, sizeof self, "%s/self", root);
  return carom_group_limit(self, root);
}

static void set_up(void) {
  memset(root + strlen(root) - 6, 'X', 6);
  ck_assert_ptr_nonnull(mkdtemp(root));
}

static void tear_down(void) {
  char command[200];
  snprintf(command, sizeof command, "rm -rf '%s'", root);
  ck_assert_int_eq(system(command), 0);
}

/* INT_MAX: there is no limit. */
static void expect_limit(const char *groups, int expected) {
  ck_assert_msg(limit(groups) == expected, "%s: %d", groups, limit(groups));
}

TEST(groups_of_version_2) {
  set_up();
  put("cpu.max", "max 100000\n");
  put("jobs/one/cpu.max", "250000 100000\n");
  put("jobs/two/cpu.max", "max 100000\n");
  put("jobs/half/cpu.max", "50000 100000\n");

  /* two and a half, rounded up */
  expect_limit("0::/jobs/one\n", 3);
  expect_limit("0::/jobs/half\n", 1);
  expect_limit("0::/jobs/two\n", INT_MAX);
  expect_limit("0::/\n", INT_MAX);

  /* a group above is stricter */
  put("jobs/cpu.max", "200000 100000\n");
  expect_limit("0::/jobs/one\n", 2);
  expect_limit("0::/jobs/two\n", 2);

  /* a neighbour whose name begins the same way does not count */
  put("jobs/on/cpu.max", "100000 100000\n");
  expect_limit("0::/jobs/one\n", 2);

  /* groups that are not mounted say nothing */
  expect_limit("0::/jobs/two/inner/most\n", 2);

  /* as in a container: its own group is the mount */
  put("cpu.max", "100000 100000\n");
  expect_limit("0::/somewhere/of/the/host\n", 1);
  expect_limit("0::/../..\n", 1);
  tear_down();
}

TEST(groups_of_version_1) {
  set_up();
  put("cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  put("cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  put("cpu,cpuacct/box/cpu.cfs_quota_us", "400000\n");
  put("cpu,cpuacct/box/cpu.cfs_period_us", "100000\n");

  /* another controller: not asked */
  put("cpuset/box/cpu.cfs_quota_us", "100000\n");
  put("cpuset/box/cpu.cfs_period_us", "100000\n");

  expect_limit("12:cpuset:/box\n4:cpu,cpuacct:/box\n1:name=systemd:/box\n0::/box\n", 4);
  expect_limit("12:cpuset:/box\n4:cpu,cpuacct:/\n", INT_MAX);
  expect_limit("4:cpu,cpuacct:/box/deeper", 4);
  tear_down();
}

TEST(strange_files_are_no_limit) {
  set_up();
  expect_limit("", INT_MAX);
  expect_limit("\n\nrubbish\n::\n0:\n", INT_MAX);

  /* strange limits */
  put("a/cpu.max", "");
  expect_limit("0::/a\n", INT_MAX);
  put("a/cpu.max", "100000 0\n");
  expect_limit("0::/a\n", INT_MAX);
  put("a/cpu.max", "-5 100000\n");
  expect_limit("0::/a\n", INT_MAX);
  put("a/cpu.max", "9999999999999999999999 1\n");
  expect_limit("0::/a\n", INT_MAX);
  ck_assert_int_eq(carom_group_limit("/nowhere/at/all", root), INT_MAX);
  char path[6000] = "0::";
  memset(path + 3, '/', 5990);
  ck_assert_int_eq(limit(path), INT_MAX); /* too long to open */
  tear_down();
}

TEST(affinity_counts) {
  cpu_set_t before, one;
  ck_assert_int_ge(carom_processors(), 1);
  ck_assert_int_eq(sched_getaffinity(0, sizeof before, &before), 0);
  ck_assert_int_le(carom_processors(), CPU_COUNT(&before));
  for (size_t cpu = 0; cpu < CPU_SETSIZE; cpu++)
    if (CPU_ISSET(cpu, &before)) {
      CPU_ZERO(&one);
      CPU_SET(cpu, &one);
      ck_assert_int_eq(sched_setaffinity(0, sizeof one, &one), 0);
      ck_assert_int_eq(carom_processors(), 1);
      break;
    }
  ck_assert_int_eq(sched_setaffinity(0, sizeof before, &before), 0);
}
