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

/* Writes the files of the rows of core/tests/texts.txt with this name, and checks their limits. */
static void check_rows(const char *name) {
  char rows[80][TEXT];
  const int end = 3 * read_texts(name, 3, rows);
  for (int k = 0; k < end; k += 3)
    if (*rows[k] != '\0')
      put(rows[k], rows[k + 1]);
    else
      ck_assert_msg(limit(rows[k + 1]) == atoi(rows[k + 2]), "%s: %s", name, rows[k + 1]);
}

TEST(both_versions) {
  static const char *const names[] = {"groups_2", "groups_1"};
  for (int k = 0; k < 2; k++) {
    set_up();
    check_rows(names[k]);
    tear_down();
  }
}

TEST(strange_files_are_no_limit) {
  set_up();
  check_rows("groups_strange");
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
