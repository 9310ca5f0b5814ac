/* Notes in matches: who may say what and when, and that no note changes the game. */
#include "match_support.h"

static carom_match peer, room;

static carom_note note_of(const char *words) {
  carom_note note = {.by = 0};
  snprintf(note.comment, sizeof note.comment, "%s", words);
  return note;
}

/* A note of a seat, which is kept in the file too. */
static void say(int seat, const char *words) {
  const carom_note note = note_of(words);
  expect_ok(carom_match_note(&match, seat, &note));
  ck_assert_int_eq(match.record.note.by, 1 + seat);
  keep();
}

/* The match without what a note may change. */
static void forget_notes(carom_match *of) {
  forget_refusal(of);
  carom_record *record = &of->record;
  memset(&record->note, 0, sizeof record->note);
  record->line = 0;
  if (record->kind == CAROM_RECORD_NOTE)
    record->kind = record->before_notes;
  record->before_notes = 0;
}

static void stroke(double speed) {
  if (match.phase == CAROM_MATCH_PLACE)
    expect_ok(carom_match_place(&match, match.seat, 0.6, 0.5));
  keep();
  carom_cue cue = match.cue;
  cue.speed = speed;
  expect_ok(carom_match_stroke(&match, match.seat, &cue, NULL, NULL));
  keep();
}

TEST(notes_in_every_phase) {
  static carom_match quiet;
  for (int has_notes = 0; has_notes < 2; has_notes++) {
    begin(CAROM_RULES_NINEBALL, 5, 0, 0);
    if (has_notes)
      say(-1, "ball in hand");
    expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
    keep();
    if (has_notes)
      say(1, "good luck");
    carom_cue cue = match.cue;
    cue.speed = 7.0;
    const carom_shot_options stop = {.time_most = 0.5};
    ck_assert_int_eq(carom_match_stroke(&match, 0, &cue, &stop, NULL), CAROM_STOPPED_AT_TIME);
    keep();
    if (has_notes)
      say(0, "it rolls");
    expect_ok(carom_match_continue(&match, NULL, NULL));
    keep();
    expect_ok(carom_match_concede(&match, 1));
    keep();
    if (has_notes)
      say(1, "well played");
    if (!has_notes)
      quiet = match;
  }
  before = match;
  forget_notes(&before);
  forget_notes(&quiet);
  ck_assert_mem_eq(&before, &quiet, sizeof before);
  expect_ok(carom_match_end(&match));
  keep();
  check_recording("a match with notes");
  const carom_note note = note_of("too late");
  before = match;
  check_refusal("behind the end", carom_match_note(&match, 0, &note), "over", "has ended");
}

/* In a file a note may come between an act and its ruling. */
TEST(a_note_before_a_ruling) {
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  stroke(7.0);
  static const char note[] = "{\"note\":{\"comment\":\"a good break\",\"x_cam\":3}}\n";
  memset(&reader, 0, sizeof reader);
  int notes = 0;
  for (const char *at = file, *end; at < file + file_size; at = end + 1) {
    end = strchr(at, '\n');
    expect_ok(carom_match_read(&reader, &scratch, at, (size_t)(end + 1 - at)));
    const int64_t due = reader.due;
    const uint64_t hash = reader.record.hash;
    expect_ok(carom_match_read(&reader, &scratch, note, sizeof note - 1));
    ck_assert_str_eq(reader.record.note.comment, "a good break");
    ck_assert(reader.due == due && reader.record.hash == hash);
    notes++;
  }
  ck_assert_int_gt(notes, 5);
  ck_assert(reader.record.hash == match.record.hash && reader.size == 0);
  ck_assert_mem_eq(&reader.ruling, &match.ruling, sizeof match.ruling);
  static const char none[] = "{\"note\":{\"comment\":\"x\",\"seat\":2}}";
  ck_assert_int_lt(carom_match_read(&reader, &scratch, none, sizeof none - 1), 0);
  ck_assert_ptr_nonnull(strstr(reader.fault, "the seats of the match are 0 to 1"));
}

TEST(notes_that_a_match_refuses) {
  static carom_match none;
  memset(&none, 0, sizeof none);
  carom_note note = note_of("hello");
  ck_assert_int_eq(carom_match_note(&none, 0, &note), CAROM_ERROR_ACT);
  ck_assert_int_eq(none.refusal, CAROM_REFUSED_NOT_BEGUN);
  ck_assert_int_eq(carom_match_note(NULL, 0, &note), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_match_note(&none, 0, NULL), CAROM_ERROR_NULL);
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  before = match;
  check_refusal("a seat", carom_match_note(&match, 2, &note), "turn", "seat 2 is not one of");
  before = match;
  check_refusal("a seat", carom_match_note(&match, -2, &note), "turn", "seats are 0 to 1");
  note = note_of("two\nlines");
  before = match;
  check_refusal("lines", carom_match_note(&match, 0, &note), "note",
                "comment must have no control");
  memset(note.comment, 'a', sizeof note.comment);
  before = match;
  check_refusal("long", carom_match_note(&match, 0, &note), "note", "comment has no closing 0");
  note = note_of("");
  before = match;
  check_refusal("empty", carom_match_note(&match, 0, &note), "note", "it says nothing");
}

/* ---- Notes of peers */

static carom_status receive(const char *line, int seat) {
  return carom_match_receive(&reader, &room, line, strlen(line), seat);
}

/* The match of a server is `reader`, and `match` has an act that the server has not yet. */
static void begin_server(void) {
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
  keep();
  expect_ok(read_all(file, file_size));
  carom_cue cue = match.cue;
  cue.speed = 7.0;
  expect_ok(carom_match_stroke(&match, 0, &cue, NULL, NULL));
}

TEST(a_server_passes_notes_on) {
  static const char offer[] = "{\"note\":{\"seat\":1,\"offer\":\"draw\",\"x_from\":\"lobby\"}}\n";
  static const char answer[] = "{\"note\":{\"seat\":0,\"answer\":\"no\"}}\n";
  begin_server();
  const int64_t line = reader.record.line;
  expect_ok(receive(offer, 1));
  ck_assert_int_eq(reader.record.line, line + 1);
  ck_assert_int_eq(reader.size, (int64_t)sizeof offer - 1);
  ck_assert_mem_eq(reader.text, offer, sizeof offer - 1);
  before = reader;
  expect_ok(receive(offer, 1)); /* once more: it is known */
  ck_assert_mem_eq(&before, &reader, sizeof before);

  /* notes between the lines of an act: those that come behind them are known still */
  char *at = match.text;
  for (int k = 0; at < match.text + match.size; k++) {
    char *end = strchr(at, '\n');
    *end = '\0';
    ck_assert_msg(receive(at, 0) == CAROM_OK, "%s", reader.fault);
    ck_assert_msg(receive(k % 2 == 0 ? answer : offer, k % 2) == CAROM_OK, "%s", reader.fault);
    *end = '\n';
    at = end + 1;
  }
  ck_assert(reader.record.hash == match.record.hash);
  ck_assert_mem_eq(&reader.ruling, &match.ruling, sizeof match.ruling);
}

TEST(hostile_notes) {
  static const struct {
    const char *line;
    int seat;
    const char *refusal, *words;
  } rows[] = {
      {"{\"note\":{\"seat\":0,\"comment\":\"I concede\"}}", 1, "turn", "a note of seat 0"},
      {"{\"note\":{\"comment\":\"anonymous\"}}", 1, "turn", "without its seat"},
      {"{\"note\":{\"seat\":2,\"comment\":\"x\"}}", 2, "turn", "seat 2 is not one of"},
      {"{\"note\":{\"seat\":2,\"comment\":\"x\"}}", -1, "turn", "seat 2 is not one of"},
      {"{\"note\":{\"seat\":0,\"comment\":\"\\u001b[2J\"}}", 0, "line", "no control characters"},
      {"{\"note\":{\"seat\":0,\"comment\":\"\xff\"}}", 0, "line", "must be UTF-8"},
      {"{\"note\":{\"seat\":0,\"winner\":1}}", 0, "line", "note.winner is not a key"},
      {"{\"note\":{\"seat\":0}}", 0, "line", "says nothing"},
      {"{\"note\":{\"seat\":0,\"comment\":\"x\"}", 0, "line", "cut off"},
      {"{\"note\":{\"seat\":0,\"comment\":\"x\"},\"end\":{}}", 0, "line", "only key"},
      {"{ \"note\":[]}", 0, "line", "must be an object"}};
  begin_server();
  for (size_t k = 0; k < COUNT_OF(rows); k++) {
    before = reader;
    ck_assert_msg(receive(rows[k].line, rows[k].seat) < 0, "%s is accepted", rows[k].line);
    ck_assert_msg(strcmp(carom_word(CAROM_WORDS_REFUSAL, reader.refusal), rows[k].refusal) == 0 &&
                      strstr(reader.fault, rows[k].words) != NULL,
                  "%s: %s, %s", rows[k].line, carom_word(CAROM_WORDS_REFUSAL, reader.refusal),
                  reader.fault);
    memcpy(before.fault, reader.fault, sizeof before.fault);
    before.refusal = reader.refusal;
    ck_assert_msg(memcmp(&before, &reader, sizeof before) == 0, "%s changed the match",
                  rows[k].line);

    /* the honest act, on a copy */
    peer = reader;
    const size_t size = strcspn(match.text, "\n");
    expect_ok(carom_match_receive(&peer, &room, match.text, size, 0));
    ck_assert(peer.record.hash == match.record.hash);
  }
}

/* Notes in the room of lines that are long already. */
TEST(many_notes) {
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  static char words[1024];
  memset(words, '"', sizeof words - 1);
  for (int k = 0; k < 1000; k++)
    say(k % 2, words);
  ck_assert_int_lt(match.size + match.known, CAROM_MATCH_TEXT);
  expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
  keep();
  check_recording("many notes");
  ck_assert_uint_lt(carom_match_undone(file, file_size), file_size);
}
