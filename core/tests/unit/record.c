/* Recordings: numbers as text, a game written and played again, and every way in which a
 * recording is rejected. */
#include "carom_record.h"
#include "platform/fingerprint.h"
#include "record/number_text.h"
#include "recorded_game.h"
#include "support.h"

#include <limits.h>

enum { ROOM = 400000, EVENTS = 600 };

static carom_record game, again;
static char text[ROOM];
static size_t size;
static carom_event events[EVENTS];

/* ---- Numbers */

static void round_trip(double x) {
  char number[CAROM_NUMBER_TEXT];
  const int n = carom_number_write(x, number);
  double y = 0.0;
  const char *why, *end = carom_number_read(number, number + n, &y, &why);
  ck_assert_msg(end == number + n && memcmp(&x, &y, sizeof x) == 0, "%a is written %.*s", x, n,
                number);
  /* as the C library reads it, too */
  const int quoted = number[0] == '"';
  number[n - quoted] = '\0';
  ck_assert_msg(strtod(number + quoted, NULL) == x, "%a is written %s", x, number);
}

TEST(numbers_come_back) {
  static const double chosen[] = {0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  0.1,
                                  0.028575,
                                  1e15,
                                  1e22,
                                  1e-22,
                                  1e300,
                                  -1e-300,
                                  5e-324,
                                  0x1.fffffffffffffp+1023,
                                  0x1p-1022,
                                  0x1.5555555555555p-2,
                                  123.456,
                                  2e-320,
                                  0x1p53,
                                  0x1.0000000000001p+53};
  random_source r = {test_seed()};
  for (size_t k = 0; k < COUNT_OF(chosen); k++)
    round_trip(chosen[k]);
  for (int k = 0; k < FEWER(200000); k++) {
    /* any bits; and what people type */
    uint64_t bits = 0;
    for (int part = 0; part < 4; part++)
      bits = bits << 16 | (uint64_t)random_between(&r, 0.0, 65536.0);
    double x;
    memcpy(&x, &bits, sizeof x);
    if (isfinite(x))
      round_trip(x);
    const int places = (int)random_between(&r, 0.0, 9.0);
    round_trip(rint(random_between(&r, -1e6, 1e6)) / pow(10.0, places));
  }
  char number[CAROM_NUMBER_TEXT];
  ck_assert_int_eq(carom_number_write(0.028575, number), 8);
  ck_assert_mem_eq(number, "0.028575", 8);
}

TEST(numbers_that_are_refused) {
  static const char bad[] = "\n-\n01\n1.\n.5\n1e\n1e99999\nnan\ninf\n+1\n1e23\n1e-23\n\"0x1\"\n"
                            "\"0x2p+0\"\n\"0x1p+1024\"\n\"0x1.p+0\"\n\"0x0p+0\"\n\"0x1p+1\n\"\n"
                            "\"0x1.00000000000001p+0\"\n0.12345678901234567\n";
  int count = 0;
  for (const char *from = bad, *end; (end = strchr(from, '\n')) != NULL; from = end + 1, count++) {
    double x;
    const char *why = NULL;
    ck_assert_msg(carom_number_read(from, end, &x, &why) != end, "%.*s is read", (int)(end - from),
                  from);
  }
  ck_assert_int_eq(count, 21);
}

/* ---- A game, written */

static void add_line(carom_record *record, carom_record_kind kind) {
  const size_t written = carom_record_write(record, kind, text + size, ROOM - size);
  ck_assert_msg(written > 0, "a line of kind %d", (int)kind);
  size += written;
}

static void put(carom_record_kind kind) {
  add_line(&game, kind);
}

static void play(carom_record_kind kind, carom_status expected) {
  carom_shot shot = {.events = events, .room = EVENTS};
  ck_assert_int_eq(carom_record_play(&game, kind, &shot), expected);
  put(kind);
  for (int64_t k = 0; kind == CAROM_RECORD_SHOT && k < shot.count; k++) {
    game.event = events[k];
    game.before = game.after = k % 3 == 0 ? 0 : 1 + (events[k].type == CAROM_EVENT_BALL_BALL);
    put(CAROM_RECORD_EVENT);
  }
}

/* A break that is stopped and continues, ball in hand, a shot with other models, a layout changed
 * by hand. */
static void write_game(void) {
  memset(&game, 0, sizeof game);
  size = 0;
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.count = carom_rack_size(CAROM_RACK_NINEBALL);
  carom_rack(CAROM_RACK_NINEBALL, &game.table, 1e-4, 5, game.balls, CAROM_BALLS_MOST);
  put(CAROM_RECORD_HEAD);
  put(CAROM_RECORD_TABLE);
  put(CAROM_RECORD_BALLS);
  game.cue = carom_cue_of(CAROM_GAME_POOL);
  game.cue.speed = 7.3;
  game.cue.phi = 90.2;
  game.options.time_most = 0.5;
  play(CAROM_RECORD_SHOT, CAROM_STOPPED_AT_TIME);
  game.options.time_most = 1.0;
  play(CAROM_RECORD_CONTINUE, CAROM_STOPPED_AT_TIME);
  game.options.time_most = 0.0;
  play(CAROM_RECORD_CONTINUE, CAROM_OK);
  ck_assert_int_eq(carom_record_hand(&game, 10), CAROM_ERROR_BALLS);
  expect_ok(carom_record_hand(&game, 0));
  put(CAROM_RECORD_PLACE);
  ck_assert(strstr(text, "\n{\"place\":{\"ball\":0,\"hand\":1}}\n") != NULL);
  expect_ok(carom_record_place(&game, 0, 0.6, 0.5, NULL));
  put(CAROM_RECORD_PLACE);
  game.options.cushion_model = CAROM_SHOT_CUSHION_STRONGE;
  put(CAROM_RECORD_OPTIONS);
  game.cue.phi = 1.0 / 3.0;
  play(CAROM_RECORD_SHOT, CAROM_OK);
  carom_record_settle(&game);
  game.balls[3].kind.mass = 0.18;
  game.balls[0].state.w[2] = 3.0;
  put(CAROM_RECORD_BALLS);
  play(CAROM_RECORD_SHOT, CAROM_OK);
  put(CAROM_RECORD_END);
}

/* All that a reader can see of the lines so far, and how many shots ended otherwise. */
static uint64_t told;
static int differing;

#define SEEN(member) \
  { &again.member, sizeof again.member }
static uint64_t tell(uint64_t h) {
  const struct {
    const void *at;
    size_t size;
  } seen[] = {SEEN(kind),   SEEN(table),    SEEN(balls), SEEN(options),  SEEN(cue),
              SEEN(placed), SEEN(hand),     SEEN(place), SEEN(recorded), SEEN(event),
              SEEN(before), SEEN(revision), SEEN(format)};
  for (size_t k = 0; k < COUNT_OF(seen); k++)
    h = carom_fingerprint(h, seen[k].at, seen[k].size);
  return h;
}

/* Reads and plays it; returns how many shots have the hash that was recorded, or a status. */
static int replay(const char *from, size_t length) {
  int same = 0;
  memset(&again, 0, sizeof again);
  told = 0;
  differing = 0;
  for (const char *line = from; line < from + length;) {
    const char *next = (const char *)memchr(line, '\n', (size_t)(from + length - line));
    next = next == NULL ? from + length : next + 1;
    const carom_status status = carom_record_read(&again, line, (size_t)(next - line));
    told = status < 0 ? told : tell(told);
    if (status < 0)
      return status;
    line = next;
    if (again.kind != CAROM_RECORD_SHOT && again.kind != CAROM_RECORD_CONTINUE)
      continue;
    carom_shot shot = {.events = events, .room = EVENTS};
    carom_record_play(&again, (carom_record_kind)again.kind, &shot);
    const bool agrees = again.pending == CAROM_PENDING_LINE &&
                        memcmp(&again.played, &again.recorded, sizeof again.played) == 0;
    same += agrees;
    differing += !agrees;
  }
  return same;
}

TEST(a_game_played_again) {
  write_game();
  ck_assert_int_eq(replay(text, size), 5);
  ck_assert_int_eq(again.kind, CAROM_RECORD_END);
  ck_assert_int_eq(again.shots, 5);
  ck_assert_int_eq(again.line, game.line);
  ck_assert_mem_eq(again.final, game.final, sizeof game.final);
  ck_assert_mem_eq(again.balls, game.balls, sizeof game.balls);
  ck_assert_mem_eq(&again.facts, &game.facts, sizeof game.facts);
}

/* ---- What is rejected */

/* One change of the text: what it becomes, and a part of what is said about it. */
static void refused(const char *what, const char *with, const char *said) {
  static char changed[ROOM];
  char *place = strstr(text, what);
  ck_assert_msg(place != NULL, "%s is not in the recording", what);
  const int n = snprintf(changed, sizeof changed, "%.*s%s%s", (int)(place - text), text, with,
                         place + strlen(what));
  ck_assert_int_lt(n, (int)sizeof changed);
  const int status = replay(changed, (size_t)n);
  ck_assert_msg(status == CAROM_ERROR_RECORD, "%s for %s: %d", with, what, status);
  ck_assert_msg(strstr(again.fault, said) != NULL, "%s: '%s', not '%s'", with, again.fault, said);
  ck_assert_int_eq(again.kind, CAROM_RECORD_WRONG);
}

TEST(lines_that_are_refused) {
  static const struct {
    const char *part;
    const char *becomes;
    const char *fault;
  } changes[] = {
      {"\"format\":2", "\"format\":4", "recording.format must be 2 or 3"},
      {"\"format\":2", "\"format\":3", "balls.hash is missing"},
      {"\"format\":2", "\"format\":1", "recording.format is 1, whose hashes do not cover"},
      {"\"width\":", "\"widht\":", "table.widht is not a key of the format"},
      {"\"width\":1.27,", "", "table.width is missing"},
      {"\"width\":1.27", "\"width\":1.27,\"width\":1.27", "table.width comes twice"},
      {"\"width\":1.27", "\"width\":\"wide\"", "table.width is not a hexadecimal number"},
      {"\"width\":1.27", "\"width\":nan", "table.width must be a number"},
      {"\"width\":1.27", "\"width\":0.1234567890123456789", "15, and 22 places"},
      {"\"side\":1", "\"side\":1.5", "side must be a whole number"},
      {"{\"p\":[", "{\"p\":[0,", "table.rails[0].p has too many numbers"},
      {"\"hash\":\"", "\"hash\":\"g", "shot.hash must be 16 hexadecimal digits"},
      {"{\"balls\"", "{\"bals\"", "bals is not a line of a recording"},
      {"{\"recording\"", "[\"recording\"", "must be an object"},
      {"{\"place\":{\"ball\":0", "{\"place\":{\"ball\":10", "place "}};
  write_game();
  for (size_t k = 0; k < COUNT_OF(changes); k++)
    refused(changes[k].part, changes[k].becomes, changes[k].fault);
  ck_assert_int_eq(replay(text, size), 5);
  ck_assert_int_eq(carom_record_read(&again, "{\"end\":{}}", 10), CAROM_ERROR_RECORD);
  ck_assert_str_eq(again.fault, "end follows the end of the recording");
  refused("{\"table\":", "{\"event\":{\"time\":0,\"type\":1,\"a\":0}}\n{\"table\":",
          "must follow a shot");
  refused("\"shots\":5", "\"shots\":4", "end.shots does not match the lines above");

  /* a line less, and a line cut off: the shot's hashes are those of a chain */
  char *line = strstr(text, "{\"continue\":"), *next = strchr(line, '\n') + 1;
  static char shorter[ROOM];
  int n = snprintf(shorter, sizeof shorter, "%.*s%s", (int)(line - text), text, next);
  ck_assert_int_eq(replay(shorter, (size_t)n), CAROM_ERROR_RECORD);
  ck_assert_int_eq(replay(text, size - 30), CAROM_ERROR_RECORD);
  ck_assert_ptr_nonnull(strstr(again.fault, "cut off"));
  ck_assert_int_lt(replay(text, (size_t)(next - text)), 5);
  ck_assert_int_ne(again.kind, CAROM_RECORD_END);

  /* another revision; a shot that was not played, or cannot be */
  char head[100];
  n = snprintf(head, sizeof head, "{\"recording\":{\"format\":2,\"revision\":%d}}",
               carom_physics_revision() + 1);
  ck_assert_int_eq(replay(head, (size_t)n), CAROM_ERROR_REVISION);
  ck_assert_int_eq(again.revision, carom_physics_revision() + 1);
  expect_ok(carom_record_read(&again, "\n", 1));
  ck_assert_int_eq(carom_record_read(&again, "{", 1), CAROM_ERROR_RECORD);
  ck_assert_int_eq(carom_record_play(&again, CAROM_RECORD_SHOT, NULL), CAROM_ERROR_RECORD);
  ck_assert_uint_eq(carom_record_write(&game, CAROM_RECORD_SHOT, text, ROOM), 0);
  memset(&game, 0, sizeof game);
  ck_assert_uint_eq(carom_record_write(&game, CAROM_RECORD_TABLE, text, ROOM), 0);
  ck_assert_uint_eq(carom_record_write(&game, CAROM_RECORD_HEAD, text, 10), 0);
  ck_assert_uint_gt(carom_record_write(&game, CAROM_RECORD_HEAD, text, ROOM), 10);
  game.table.width = NAN;
  ck_assert_uint_eq(carom_record_write(&game, CAROM_RECORD_TABLE, text, ROOM), 0);
}

/* A kind of line that is none, and a number of balls that cannot be, are rejected wherever they
 * come from. */
TEST(records_that_cannot_be) {
  static const int64_t counts[] = {-1, INT64_MIN, CAROM_BALLS_MOST + 1, 100000, INT64_MAX};
  static const int kinds[] = {-1, -100, INT_MIN, 12, 64, INT_MAX};
  for (size_t k = 0; k < COUNT_OF(counts); k++) {
    write_game();
    for (size_t j = 0; j < COUNT_OF(kinds); j++) {
      again = game;
      ck_assert_uint_eq(carom_record_write(&again, (carom_record_kind)kinds[j], text, ROOM), 0);
      ck_assert_int_lt(carom_record_play(&again, (carom_record_kind)kinds[j], NULL), 0);
    }
    again.count = counts[k];
    again.moved = 1;
    ck_assert_int_eq(carom_record_settle(&again), CAROM_ERROR_BALLS);
    ck_assert_int_eq(carom_record_place(&again, 0, 0.5, 0.5, NULL), CAROM_ERROR_BALLS);
  }
}

/* A shot with a wrong argument changes nothing. */
TEST(a_refused_shot_changes_nothing) {
  write_game();
  ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_SHOT, NULL), CAROM_ERROR_RECORD);
  ck_assert_str_eq(game.fault, "follows the end of the recording");
  game.kind = CAROM_RECORD_EVENT; /* the line before its end */
  game.cue.phi = NAN;
  again = game;
  ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_SHOT, NULL), CAROM_ERROR_CUE_PHI);
  ck_assert_mem_eq(game.final, again.final, sizeof game.final);
  ck_assert_mem_eq(&game.played, &again.played, sizeof game.played);
  ck_assert_uint_eq(game.hash, again.hash);
  ck_assert_int_eq(game.pending, again.pending);
}

/* A shot that ran to its end cannot continue, whatever the one before left. */
TEST(an_ended_shot_does_not_go_on) {
  memset(&game, 0, sizeof game);
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.count = 2;
  game.cue = carom_cue_of(CAROM_GAME_POOL);
  game.cue.speed = 1.5;
  for (int stopped = 1; stopped >= 0; stopped--) {
    carom_rack(CAROM_RACK_THREECUSHION, &game.table, 1e-4, 5, game.balls, CAROM_BALLS_MOST);
    game.moved = 0;
    game.options.time_most = stopped ? 0.5 : 0.0;
    ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_SHOT, NULL),
                     stopped ? CAROM_STOPPED_AT_TIME : CAROM_OK);
  }
  ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_CONTINUE, NULL), CAROM_ERROR_STATE);
}

/* A stroke while balls move would strike none, so it is rejected and changes nothing; also once the
 * balls were taken over, and of a recording that is read. */
TEST(no_stroke_while_balls_move) {
  write_game();
  game.kind = CAROM_RECORD_EVENT;
  game.options.time_most = 0.5;
  ck_assert_int_eq(carom_record_play(&game, CAROM_RECORD_SHOT, NULL), CAROM_STOPPED_AT_TIME);
  for (int settled = 0; settled < 2; settled++) {
    again = game;
    if (settled)
      expect_ok(carom_record_settle(&again));
    ck_assert_int_eq(carom_record_play(&again, CAROM_RECORD_SHOT, NULL), CAROM_ERROR_RECORD);
    ck_assert_ptr_nonnull(strstr(again.fault, "balls move"));
    ck_assert_uint_eq(again.hash, game.hash);
    ck_assert_int_eq(again.pending, game.pending);
  }
  game.options.time_most = 0.0;
  expect_ok(carom_record_play(&game, CAROM_RECORD_CONTINUE, NULL));
  expect_ok(carom_record_play(&game, CAROM_RECORD_SHOT, NULL));
}

/* A step of the hash of lines, as files.md has it. */
static uint64_t step(uint64_t h, uint64_t x) {
  h ^= x;
  return (h << 27 | h >> 37) * UINT64_C(0x9e3779b97f4a7c15);
}

/* The hash of lines counts numbers that are not 0, behind their positions: of the first line, and
 * of options of which one is set. */
TEST(hash_of_lines) {
  memset(&game, 0, sizeof game);
  size = 0;
  put(CAROM_RECORD_HEAD);
  uint64_t h = step(0, CAROM_RECORD_HEAD);
  h = step(step(step(step(h, 1), 2), 2), (uint64_t)carom_physics_revision());
  h = step(h, 0);
  ck_assert_uint_eq(game.hash, h);
  game.options.ball_model = CAROM_BALL_MODEL_MIRROR; /* the second number of the line */
  put(CAROM_RECORD_OPTIONS);
  ck_assert_ptr_nonnull(strstr(text, "ball_model"));
  h = step(step(step(step(h, CAROM_RECORD_OPTIONS), 2), CAROM_BALL_MODEL_MIRROR), 0);
  ck_assert_uint_eq(game.hash, h);
}

/* A small game with every kind of line, also such as no shot follows. */
static void write_small_game(void) {
  memset(&game, 0, sizeof game);
  size = 0;
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.table.rail[3].restitution = 0.8;
  record_game(&game);
  carom_record_hand(&game, 0);
  put(CAROM_RECORD_PLACE);
  put(CAROM_RECORD_OPTIONS);
  put(CAROM_RECORD_END);
}

/* Every byte of a recording with one bit of three changed: a shot ends otherwise, or a line is
 * rejected, or a reader sees what he saw. */
TEST(every_changed_bit) {
  static char changed[ROOM];
  write_small_game();
  ck_assert_int_eq(replay(text, size), 3);
  const uint64_t was = told;
  int differences = 0, refusals = 0, equal = 0;
  for (size_t at = 0; at < size; at++)
    for (int bit = 0; bit < 3; bit++) {
      memcpy(changed, text, size);
      changed[at] = (char)(changed[at] ^ 1 << bit);
      const int same = replay(changed, size);
      const bool verifies = same == 3 && again.kind == CAROM_RECORD_END;
      differences += differing > 0;
      refusals += differing == 0 && !verifies;
      equal += verifies;
      const size_t from = at < 20 ? 0 : at - 20;
      ck_assert_msg(!verifies || told == was, "%.40s for %.40s verifies", changed + from,
                    text + from);
    }
  printf("of %d changes a shot ends otherwise after %d, a line is refused after %d, and %d change "
         "no value\n",
         3 * (int)size, differences, refusals, equal);
  ck_assert_int_gt(differences, (int)size / 2);
}
