/* Notes in recordings: words that change no hash, come back as they were, and are refused where a
 * terminal, a page or a line of JSON could not carry them. */
#include "carom_record.h"
#include "support.h"

enum { ROOM = 200000 };

static carom_record game, again, before;
static char text[ROOM];
static size_t size;

static void put(carom_record_kind kind) {
  const size_t written = carom_record_write(&game, kind, text + size, ROOM - size);
  ck_assert_msg(written > 0, "a line of kind %d", (int)kind);
  size += written;
}

/* Every key, with all characters that are escaped or longer than one byte. */
static carom_note full_note(void) {
  carom_note note = {.date = "2026-11-30T20:15:00Z",
                     .event = "Club \"Carambole\"",
                     .site = "Zürich",
                     .round = "3",
                     .name = "Łucja \\ 😀",
                     .comment = "a kiss/push?",
                     .offer = "draw",
                     .answer = "no",
                     .seconds = 12.5,
                     .by = 2,
                     .extras = 2};
  note.extra[0] = (carom_note_extra){.key = "x_elo", .text = "-1.50e+3", .is_number = 1};
  note.extra[1] = (carom_note_extra){.key = "x_app_2", .text = "\"0x1p+1\""};
  return note;
}

static void comment(const char *words) {
  memset(&game.note, 0, sizeof game.note);
  snprintf(game.note.comment, sizeof game.note.comment, "%s", words);
  put(CAROM_RECORD_NOTE);
}

/* A game of one shot with its events, with a comment between all lines or without any. */
static uint64_t write_game(bool has_notes) {
  static carom_event events[100];
  carom_shot shot = {.events = events, .room = 100};
  memset(&game, 0, sizeof game);
  size = 0;
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.count = 3;
  carom_rack(CAROM_RACK_THREECUSHION, &game.table, 1e-4, 1, game.balls, 3);
  const carom_record_kind kinds[] = {CAROM_RECORD_HEAD, CAROM_RECORD_TABLE, CAROM_RECORD_BALLS};
  for (size_t k = 0; k < COUNT_OF(kinds); k++) {
    put(kinds[k]);
    if (has_notes)
      comment("before the first stroke");
  }
  game.cue = carom_cue_of(CAROM_GAME_POOL);
  game.options.time_most = 0.4;
  ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_SHOT, &shot), CAROM_STOPPED_AT_TIME);
  if (has_notes)
    comment("between a shot and its line");
  put(CAROM_RECORD_SHOT);
  for (int64_t k = 0; k < shot.count; k++) {
    if (has_notes)
      comment("before an event");
    game.event = events[k];
    game.before = game.after = 0;
    put(CAROM_RECORD_EVENT);
  }
  if (has_notes)
    comment("while balls move");
  game.options.time_most = 0.0;
  expect_ok(carom_record_play(&game, CAROM_RECORD_CONTINUE, NULL));
  put(CAROM_RECORD_CONTINUE);
  if (has_notes) {
    game.note = full_note();
    put(CAROM_RECORD_NOTE);
  }
  const uint64_t hash = game.hash;
  put(CAROM_RECORD_END);
  return hash;
}

TEST(notes_change_no_hash) {
  const uint64_t without = write_game(false);
  ck_assert_uint_eq(write_game(true), without);

  /* what was written is read again, and each note is written as it was */
  static char copy[CAROM_RECORD_TEXT];
  int notes = 0, shots = 0;
  memset(&again, 0, sizeof again);
  for (const char *line = text, *end; line < text + size; line = end + 1) {
    end = strchr(line, '\n');
    ck_assert_msg(carom_record_read(&again, line, (size_t)(end - line)) == CAROM_OK, "%s",
                  again.fault);
    if (again.pending == CAROM_PENDING_SHOT) {
      carom_record_play(&again, (carom_record_kind)again.kind, NULL);
      ck_assert(again.played.hash == again.recorded.hash);
      shots++;
    }
    if (again.kind != CAROM_RECORD_NOTE)
      continue;
    notes++;
    before = again;
    const size_t length = carom_record_write(&before, CAROM_RECORD_NOTE, copy, sizeof copy);
    ck_assert_uint_eq(length, (size_t)(end + 1 - line));
    ck_assert_mem_eq(copy, line, length);
  }
  ck_assert_int_eq(shots, 2);
  ck_assert_int_gt(notes, 6);
  const carom_note wanted = full_note();
  ck_assert_mem_eq(&again.note, &wanted, sizeof wanted);
  ck_assert_uint_eq(again.hash, without);
}

/* The escapes of JSON, as other programs write them. */
TEST(escapes) {
  static const char line[] =
      " { \"note\" : {\"comment\":\"\\u017Bubr\\/ \\ud83d\\ude00 \\\"\\\\\",\"x_a\": 0 , "
      "\"seat\":0,\"x_b\":\"\"} } ";
  write_game(false);
  memset(&again, 0, sizeof again);
  expect_ok(carom_record_read(&again, text, strcspn(text, "\n")));
  ck_assert_msg(carom_record_read(&again, line, sizeof line - 1) == CAROM_OK, "%s", again.fault);
  ck_assert_str_eq(again.note.comment, "Żubr/ 😀 \"\\");
  ck_assert_int_eq(again.note.by, 1);
  ck_assert_int_eq(again.note.extras, 2);
  ck_assert_str_eq(again.note.extra[0].text, "0");
  ck_assert_int_eq(again.note.extra[0].is_number, 1);
  ck_assert_int_eq(again.note.extra[1].is_number, 0);
}

static void refused(const char *object, const char *said) {
  static char line[CAROM_RECORD_TEXT];
  const int n = snprintf(line, sizeof line, "{\"note\":%s}", object);
  memset(&again, 0, sizeof again);
  expect_ok(carom_record_read(&again, text, strcspn(text, "\n")));
  const uint64_t hash = again.hash;
  ck_assert_msg(carom_record_read(&again, line, (size_t)n) == CAROM_ERROR_RECORD, "%s is read",
                object);
  ck_assert_msg(strstr(again.fault, said) != NULL, "%s: '%s', not '%s'", object, again.fault, said);
  ck_assert_int_eq(again.kind, CAROM_RECORD_WRONG);
  ck_assert_uint_eq(again.hash, hash);
}

/* An object of one key, whose text is one character many times. */
static const char *long_text(const char *key, int length) {
  static char object[8192];
  char *at = object + sprintf(object, "{\"%s\":\"", key);
  memset(at, 'a', (size_t)length);
  strcpy(at + length, "\"}");
  return object;
}

TEST(notes_that_are_refused) {
  write_game(false);
  refused("{}", "note says nothing");
  refused("{\"seat\":1}", "note says nothing");
  refused("{\"chat\":\"hi\"}", "note.chat is not a key of the format");
  refused("{\"X_a\":\"hi\"}", "note.X_a is not a key of the format");
  refused("{\"comment\":7}", "note.comment must be a text in quotes");
  refused("{\"comment\":\"a\",\"comment\":\"b\"}", "note.comment comes twice");
  refused("{\"comment\":\"\x1b[2J\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\\u001b[2J\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\\u0000\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"a\\nb\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\\u009b2J\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\xc2\x9b\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\\u2028\"}", "note.comment must have no control characters");
  refused("{\"comment\":\"\xff\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\xc0\xaf\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\xed\xa0\x80\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\xf4\x90\x80\x80\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\xe2\x82\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\\udc00\"}", "note.comment must be UTF-8");
  refused("{\"comment\":\"\\ud800x\"}", "second half of a surrogate pair");
  refused("{\"comment\":\"\\ud800\\u0041\"}", "second half of a surrogate pair");
  refused("{\"comment\":\"\\u00g0\"}", "4 hexadecimal digits");
  refused("{\"comment\":\"\\x\"}", "unknown escape");
  refused("{\"comment\":\"open", "is cut off");
  refused("{\"comment\":\"\\\"}", "is cut off");
  refused(long_text("comment", 1024), "note.comment must have at most 1023 bytes");
  refused(long_text("date", 32), "note.date must have at most 31 bytes");
  refused(long_text("x_a", 256), "note.x_a must have at most 255 bytes");
  refused("{\"offer\":\"money\"}", "note.offer must be draw or take_back");
  refused("{\"answer\":\"maybe\"}", "note.answer must be yes or no");
  refused("{\"seconds\":-1}", "note.seconds must be 0 or more");
  refused("{\"seconds\":NaN}", "note.seconds must be a number");
  refused("{\"comment\":\"a\",\"seat\":8}", "note.seat must be 0 to 7");
  refused("{\"comment\":\"a\",\"seat\":-1}", "note.seat must be 0 to 7");
  refused("{\"comment\":\"a\",\"seat\":0.5}", "note.seat must be 0 to 7");
  refused("{\"comment\":\"a\",\"hash\":\"0123456789abcdef\"}", "note.hash is not a key");
  refused("{\"x_\":1}", "must have keys of x_");
  refused("{\"x_a-b\":1}", "must have keys of x_");
  refused("{\"x_a234567890123456789012345678901\":1}", "must have keys of x_");
  refused("{\"x_a\":1,\"x_a\":2}", "note.x_a comes twice");
  refused("{\"x_a\":true}", "note.x_a must be a text in quotes or a number");
  refused("{\"x_a\":[1]}", "note.x_a must be a text in quotes or a number");
  refused("{\"x_a\":01}", "note.x_a must be a text in quotes or a number");
  refused("{\"x_a\":1.}", "note.x_a must be a text in quotes or a number");
  refused("{\"x_a\":--1}", "note.x_a must be a text in quotes or a number");
  refused("{\"x_1\":1,\"x_2\":1,\"x_3\":1,\"x_4\":1,\"x_5\":1,\"x_6\":1,\"x_7\":1,\"x_8\":1,"
          "\"x_9\":1}",
          "note.x_9 is one key too many");
  expect_ok(carom_record_read(memset(&again, 0, sizeof again), text, strcspn(text, "\n")));
  const char *longest = long_text("comment", 1023);
  static char line[CAROM_RECORD_TEXT];
  const int n = snprintf(line, sizeof line, "{\"note\":%s}", longest);
  ck_assert_msg(carom_record_read(&again, line, (size_t)n) == CAROM_OK, "%s", again.fault);
  static const char head[] = "{\"note\":{\"comment\":\"too early\"}}";
  memset(&again, 0, sizeof again);
  ck_assert_int_eq(carom_record_read(&again, head, sizeof head - 1), CAROM_ERROR_RECORD);
}

/* What a caller's struct may not have is not written, and nothing changes. */
TEST(notes_that_are_not_written) {
  static char line[CAROM_RECORD_TEXT];
  write_game(false);
  for (int k = 0; k < 9; k++) {
    memset(&again, 0, sizeof again);
    expect_ok(carom_record_read(&again, text, strcspn(text, "\n")));
    again.note = full_note();
    switch (k) {
    case 0:
      memset(again.note.comment, 'a', sizeof again.note.comment);
      break;
    case 1:
      strcpy(again.note.site, "two\nlines");
      break;
    case 2:
      again.note.seconds = NAN;
      break;
    case 3:
      again.note.by = 9;
      break;
    case 4:
      again.note.extras = 9;
      break;
    case 5:
      again.note.extras = -1;
      break;
    case 6:
      strcpy(again.note.extra[1].key, "y_app");
      break;
    case 7:
      strcpy(again.note.extra[0].text, "1,\"hash\":0");
      break;
    default:
      memset(again.note.extra[0].key, 'a', sizeof again.note.extra[0].key);
    }
    before = again;
    ck_assert_msg(carom_record_write(&again, CAROM_RECORD_NOTE, line, sizeof line) == 0, "%d: %s",
                  k, line);
    ck_assert_mem_eq(&again, &before, sizeof again);
  }
  again.note = full_note();
  before = again;
  ck_assert_uint_eq(carom_record_write(&again, CAROM_RECORD_NOTE, line, 40), 0);
  ck_assert_mem_eq(&again, &before, sizeof again);
}
