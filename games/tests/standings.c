/* Lines of recordings that say the state of a game. tests/unit/record.c tests the other lines. */
#include "carom_record.h"
#include "support.h"

static carom_record game, again;
static char text[4000];
static size_t size;

static size_t write_line(carom_record_kind kind) {
  return carom_record_write(&game, kind, text + size, sizeof text - size);
}

/* A recording of which only the first line is written. */
static void begin_recording(void) {
  memset(&game, 0, sizeof game);
  size = 0;
  size = write_line(CAROM_RECORD_HEAD);
  ck_assert_uint_gt(size, 0);
}

/* Reads that line into `again`. */
static void begin_reading(void) {
  memset(&again, 0, sizeof again);
  expect_ok(carom_record_read(&again, text, size));
}

/* The state of the game is read as it was written. */
TEST(standings_come_back) {
  begin_recording();
  game.standing = (carom_rules_state){.score = {0, 7}, .target = 100, .user = {1, [7] = 9}};
  game.rules = 4;
  game.side = 1;
  const size_t length = write_line(CAROM_RECORD_GAME);
  ck_assert_uint_gt(length, 0);
  begin_reading();
  expect_ok(carom_record_read(&again, text + size, length));
  ck_assert_int_eq(again.rules, 4);
  ck_assert_int_eq(again.side, 1);
  ck_assert_uint_eq(again.hash, game.hash);
  ck_assert_mem_eq(&again.standing, &game.standing, sizeof game.standing);
}

/* What no game can be is rejected, and named. */
TEST(standings_that_are_refused) {
  static const struct {
    const char *part;
    const char *fault;
  } standings[] = {{"\"group\":3", "game.group must be 0, 1 or 2"},
                   {"\"fouls\":[0,3]", "game.fouls must be 0, 1 or 2"},
                   {"\"target\":-1", "game.target must be 1 to 1000000"},
                   {"\"player\":8", "game.player must be 0 to 7"},
                   {"\"pocket\":[1]", "game.pocket has too few numbers"},
                   {"\"gruop\":1", "game.gruop is not a key of the format"}};
  begin_recording();
  for (size_t k = 0; k < COUNT_OF(standings); k++) {
    char line[100];
    const int length =
        snprintf(line, sizeof line, "{\"game\":{\"rules\":0,%s}}", standings[k].part);
    begin_reading();
    ck_assert_int_eq(carom_record_read(&again, line, (size_t)length), CAROM_ERROR_RECORD);
    ck_assert_msg(strstr(again.fault, standings[k].fault) != NULL, "%s: %s", line, again.fault);
  }
}

/* Whether the standing of `game` is written, as the second line of its recording. */
static bool is_written(void) {
  carom_record copy = game;
  return carom_record_write(&copy, CAROM_RECORD_GAME, text + size, sizeof text - size) > 0;
}

#define NOT_WRITTEN(number, value)                      \
  do {                                                  \
    begin_recording();                                  \
    ck_assert(is_written());                            \
    number = value;                                     \
    ck_assert_msg(!is_written(), #number " = " #value); \
  } while (0)

/* What the reader rejects is not written. */
TEST(standings_that_are_not_written) {
  NOT_WRITTEN(game.rules, -5);
  NOT_WRITTEN(game.side, 77);
  NOT_WRITTEN(game.standing.group, 9);
  NOT_WRITTEN(game.standing.fouls[0], 50);
  NOT_WRITTEN(game.winner, 10);
  NOT_WRITTEN(game.standing.innings, 4);
  NOT_WRITTEN(game.standing.user[3], UINT64_C(1) << 53); /* no number of JSON is sure to be that */
}
