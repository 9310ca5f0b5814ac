/* Gives the reader of recordings a good one with some edits that the bytes choose. Every line is
 * in memory of exactly its size, so that the sanitizers see a byte too many. Aborts if
 * - a line is rejected without a reason, or a reason is not a text,
 * - anything is read behind a line that is wrong,
 * - a line that was read and is written again, then read by a record like the one before it, says
 *   something else,
 * - a shot that is played ends otherwise when it is played once more. */
#include "../unit/recorded_game.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_LINES = 32, LINE = 8192, MOST_EVENTS = 40, MOST_STEPS = 1000 };

typedef struct text {
  size_t size;
  char at[LINE];
} text;

static text good[MOST_LINES], edited[MOST_LINES];
static int good_lines;
static char written[CAROM_RECORD_TEXT];

static void fail(const char *what) {
  fprintf(stderr, "records: %s\n", what);
  abort();
}

static void add_line(carom_record *game, carom_record_kind kind) {
  text *to = &good[good_lines++];
  to->size = carom_record_write(game, kind, to->at, sizeof to->at);
  if (to->size == 0)
    fail("a line cannot be written");
}

/* Puts `size` bytes instead of `old` ones of a line. */
static void splice(text *line, size_t at, size_t old, const char *bytes, size_t size) {
  if (at + old > line->size)
    old = line->size - at;
  if (line->size - old + size > LINE)
    return;
  memmove(line->at + at + size, line->at + at + old, line->size - at - old);
  memcpy(line->at + at, bytes, size);
  line->size = line->size - old + size;
}

/* Four bytes choose an edit: the line, the position in it, and what is done there. */
static void edit(const uint8_t *data, int lines) {
  static const char *const words[] = {
      "1e999", "-1e-400", "9007199254740993",     "-1", "0",  "\"0x1p-1074\"", "\"0x1.8p+1023\"",
      "nan",   "1e22",    "12345678901234567890", "[]", "{}", "\"mass\":1,",   "\"ball\":-5,",
      "null",  "\"",
  };
  static const char letters[] = "{}[]\",:0123456789.-+eExp \\\t\r\n\0\377";
  text *line = &edited[data[0] % lines];
  const size_t at = line->size == 0 ? 0 : (data[1] * 256u + data[2]) % line->size;
  const char *word = words[data[3] / 8 % 16];
  const size_t most = line->size - at;
  char copy[32];
  const size_t length = most < sizeof copy ? most : sizeof copy;
  memcpy(copy, line->at + at, length);
  switch (data[3] % 8) {
  case 0:
    splice(line, at, 1, &letters[data[3] / 8], 1);
    break;
  case 1:
    splice(line, at, (size_t)data[3] / 8, "", 0);
    break;
  case 2:
    splice(line, at, 0, copy, length);
    break;
  case 3:
    line->size = at;
    break;
  case 4:
    splice(line, at, 0, word, strlen(word));
    break;
  case 5: { /* instead of the number, or of the word, that begins here */
    size_t from = at;
    while (from < line->size && strchr(":,[", line->at[from]) == NULL)
      from++;
    from += from < line->size;
    size_t old = 0;
    while (from + old < line->size && strchr(",]}", line->at[from + old]) == NULL)
      old++;
    splice(line, from, old, word, strlen(word));
    break;
  }
  case 6: { /* another digit: a value that is a number still */
    size_t from = at;
    while (from < line->size && (line->at[from] < '0' || line->at[from] > '9'))
      from++;
    if (from < line->size)
      line->at[from] = (char)('0' + data[3] / 8 % 10);
    break;
  }
  default: { /* another line in its place */
    *line = edited[data[3] / 8 % lines];
    break;
  }
  }
}

/* Writes the line that was read, and reads it into what the record was before. */
static void check_written(carom_record *record, carom_record *before) {
  const size_t size =
      carom_record_write(record, (carom_record_kind)record->kind, written, sizeof written);
  if (size == 0)
    fail("a line that was read cannot be written");
  char *exact = malloc(size);
  if (exact == NULL)
    abort();
  memcpy(exact, written, size);
  if (carom_record_read(before, exact, size) != CAROM_OK)
    fail("a line that was written is refused");
  free(exact);
  before->line = record->line;
  if (memcmp(before->balls, record->balls, sizeof record->balls) != 0 ||
      memcmp(&before->table, &record->table, sizeof record->table) != 0 ||
      memcmp(&before->cue, &record->cue, sizeof record->cue) != 0 ||
      memcmp(&before->options, &record->options, sizeof record->options) != 0 ||
      memcmp(&before->event, &record->event, sizeof record->event) != 0)
    fail("a line says something else when it was written again");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static carom_record game, record, before, twice;
  if (good_lines == 0) {
    carom_table_make(CAROM_TABLE_POOL_7FT, &game.table);
    record_game(&game);
    add_line(&game, CAROM_RECORD_END);
  }
  if (size == 0)
    return 0;
  memcpy(edited, good, sizeof good);
  for (int k = 0; k < data[0] % 6 && (size_t)k < (size - 1) / 4; k++)
    edit(data + 1 + 4 * k, good_lines);

  memset(&record, 0, sizeof record);
  bool wrong = false;
  for (int k = 0; k < good_lines; k++) {
    char *exact = malloc(edited[k].size + 1);
    if (exact == NULL)
      abort();
    memcpy(exact + 1, edited[k].at, edited[k].size);
    before = record;
    memset(record.fault, 1, sizeof record.fault);
    const carom_status status = carom_record_read(&record, exact + 1, edited[k].size);
    free(exact);
    if (status != CAROM_OK && status != CAROM_ERROR_RECORD && status != CAROM_ERROR_REVISION)
      fail("a status that reading does not have");
    const char *last = memchr(record.fault, '\0', sizeof record.fault);
    if (status == CAROM_ERROR_RECORD && (last == NULL || last == record.fault))
      fail("a line is refused without a reason");
    if (wrong && status == CAROM_OK && record.kind != CAROM_RECORD_WRONG)
      fail("something is read behind a line that is wrong");
    wrong |= status != CAROM_OK;
    if (status != CAROM_OK || record.kind == before.kind)
      continue;
    if (record.pending != CAROM_PENDING_SHOT) {
      if (record.kind != CAROM_RECORD_HEAD && record.kind != CAROM_RECORD_END)
        check_written(&record, &before);
      continue;
    }

    /* a shot: played twice, unless it would take long */
    if (record.options.steps > MOST_STEPS || record.options.cluster_steps > MOST_STEPS)
      return 0;
    if (record.options.events_most == 0 || record.options.events_most > MOST_EVENTS)
      record.options.events_most = MOST_EVENTS;
    twice = record;
    const carom_status played = carom_record_play(&record, (carom_record_kind)record.kind, NULL);
    carom_record_play(&twice, (carom_record_kind)twice.kind, NULL);
    if (memcmp(&record.played, &twice.played, sizeof record.played) != 0 ||
        memcmp(record.final, twice.final, sizeof record.final) != 0)
      fail("a shot that is played twice has other bits");
    if (record.pending == CAROM_PENDING_SHOT) /* rejected, with nothing played */
      return 0;
    if (played != (carom_status)record.played.status)
      fail("the status that was returned is not the one that was recorded");
    for (int b = 0; b < record.count && played >= 0; b++)
      if (!isfinite(record.final[b].r[0]) || !isfinite(record.final[b].v[0]))
        fail("a shot without an error ends in no number");
  }
  return 0;
}
