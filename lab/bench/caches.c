/* Data caches from sysfs. sysconf() would answer for the whole package, of which a core reaches a part only. */
#include "caches.h"

#include <stdio.h>
#include <string.h>

enum { MOST_CACHES = 8 };

/* The first word of a file in the k-th cache's folder, or "". */
static const char *word_of(int k, const char *name, char word[32]) {
  char path[128];
  snprintf(path, sizeof path, "/sys/devices/system/cpu/cpu0/cache/index%d/%s", k, name);
  FILE *file = fopen(path, "r");
  if (file == NULL || fscanf(file, "%31s", word) != 1)
    word[0] = '\0';
  if (file != NULL)
    fclose(file);
  return word;
}

size_t cache_size(int level) {
  for (int k = 0; k < MOST_CACHES; k++) {
    char word[32], unit = ' ';
    int found;
    size_t size;
    if (sscanf(word_of(k, "level", word), "%d", &found) != 1 || found != level ||
        strcmp(word_of(k, "type", word), "Instruction") == 0)
      continue;
    if (sscanf(word_of(k, "size", word), "%zu%c", &size, &unit) >= 1)
      return unit == 'K' ? size << 10 : unit == 'M' ? size << 20 : size;
  }
  return 0;
}

const char *cache_holding(size_t bytes) {
  static const char *const names[] = {"L1", "L2", "L3", "L4"};
  for (int level = 1; level <= 4; level++)
    if (bytes <= cache_size(level))
      return names[level - 1];
  return cache_size(1) > 0 ? "memory" : "NA";
}
