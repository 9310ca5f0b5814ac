/* A line of the file: the key of an impact and its status in hexadecimal, then the bits of the
 * numbers of its solution; those that are zero at the end are left out. The key is a hash of the
 * numbers of the impact and of its slip. */
#include "kept.h"
#include "support.h"

#include <inttypes.h>

enum { NUMBERS = 14, MOST_KEPT = 8192, CHECKED_OF = 32 };

typedef struct solution {
  uint64_t key;
  reference_status status;
  double number[NUMBERS]; /* 12 of a result or 6 of a motion; then, of a result, impulse and work */
} solution;

static const char path[] = CAROM_TEST_SOURCE "/agree/references.csv";
static solution kept[MOST_KEPT];
static size_t kept_count;

static void load(void) {
  static bool loaded;
  char line[512];
  FILE *file = loaded ? NULL : fopen(path, "r");
  loaded = true;
  while (file != NULL && kept_count < MOST_KEPT && fgets(line, sizeof line, file) != NULL) {
    solution *const s = &kept[kept_count++];
    char *at;
    s->key = strtoull(line, &at, 16);
    s->status = (reference_status)strtoul(at + 1, &at, 16);
    for (int k = 0; k < NUMBERS && *at == ','; k++) {
      const uint64_t bits = strtoull(at + 1, &at, 16);
      memcpy(&s->number[k], &bits, sizeof bits);
    }
  }
  if (file != NULL)
    fclose(file);
}

static void add(const solution *s) {
  FILE *file = fopen(path, "a");
  ck_assert_msg(file != NULL, "%s cannot be written", path);
  fprintf(file, "%016" PRIx64 ",%x", s->key, (unsigned)s->status);
  int last = NUMBERS;
  while (last > 0 && s->number[last - 1] == 0)
    last--;
  for (int k = 0; k < last; k++) {
    uint64_t bits;
    memcpy(&bits, &s->number[k], sizeof bits);
    fprintf(file, ",%" PRIx64, bits);
  }
  ck_assert(fputc('\n', file) != EOF && fclose(file) == 0);
}

/* FNV-1a */
static uint64_t key_of(const void *in, size_t size, int slip) {
  uint64_t hash = 0xcbf29ce484222325u + (uint64_t)slip;
  for (size_t k = 0; k < size; k++)
    hash = (hash ^ ((const unsigned char *)in)[k]) * 0x100000001b3u;
  return hash;
}

/* Makes *s the solution of its key: the one in the file, or else what `solve` finds. */
static void find(solution *s, void solve(solution *s, const void *in, carom_slip slip),
                 const void *in, carom_slip slip) {
  load();
  size_t k = 0;
  while (k < kept_count && kept[k].key != s->key)
    k++;
  const bool known = k < kept_count, update = getenv("UPDATE") != NULL;
  if (known && !update && s->key % CHECKED_OF != test_seed() % CHECKED_OF) {
    *s = kept[k];
    return;
  }
  solve(s, in, slip);
  if (s->status != REFERENCE_OK)
    memset(s->number, 0, sizeof s->number);
  if (known) {
    double scale = 0, apart = 0;
    for (int c = 0; c < NUMBERS; c++) {
      scale = fmax(scale, fabs(s->number[c]));
      apart = fmax(apart, fabs(s->number[c] - kept[k].number[c]));
    }
    ck_assert_msg(s->status == kept[k].status && apart <= 1e-9 * scale,
                  "%s: line %zu is not what the reference gives", path, k + 1);
  } else if (update)
    add(s);
}

static void solve_balls(solution *s, const void *in, carom_slip slip) {
  carom_result out;
  s->status = reference_collide(in, slip, &out, s->number + 12);
  memcpy(s->number, &out, sizeof out);
}

static void solve_cushion(solution *s, const void *in, carom_slip slip) {
  carom_motion out;
  (void)slip;
  s->status = reference_cushion(in, &out);
  memcpy(s->number, &out, sizeof out);
}

reference_status kept_collide(const carom_impact *in, carom_slip slip, carom_result *out,
                              double normal[2]) {
  solution s = {.key = key_of(in, sizeof *in, (int)slip)};
  find(&s, solve_balls, in, slip);
  memcpy(out, s.number, sizeof *out);
  if (normal != NULL)
    memcpy(normal, s.number + 12, 2 * sizeof *normal);
  return s.status;
}

reference_status kept_cushion(const carom_cushion_impact *in, carom_motion *out) {
  solution s = {.key = key_of(in, sizeof *in, 0)};
  find(&s, solve_cushion, in, CAROM_SLIP_PAPER);
  memcpy(out, s.number, sizeof *out);
  return s.status;
}
