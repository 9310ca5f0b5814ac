/* Lines of peers: whatever a peer sends, a refused line leaves the match as it was, and an honest
 * line is accepted after it. hostile.txt has the lines that the tests of all languages send. */
#include "hostile.h"
#include "match_support.h"

#include <stdio.h>

static carom_match peer, room;
static char line[CAROM_RECORD_TEXT];

static const char *line_end(const char *from) {
  return strchr(from, '\n') + 1;
}

/* Receives all lines of text[size]; expects that each is accepted. */
static void receive_all(carom_match *to, const char *text, size_t size, int seat) {
  for (const char *at = text; at < text + size; at = line_end(at)) {
    const carom_status status =
        carom_match_receive(to, &room, at, (size_t)(line_end(at) - at), seat);
    ck_assert_msg(status == CAROM_OK, "%s", to->fault);
  }
}

/* The match of hostile.txt, in `match`; `reader` is the server's, and `peer` has the honest act. */
static void begin_hostile(void) {
  static carom_match begun;
  expect_ok(hostile_begin(&begun, &match, &peer));
  memset(&reader, 0, sizeof reader);
  receive_all(&reader, begun.text, (size_t)begun.size, -1);
  receive_all(&reader, match.text, (size_t)match.size, 0);
}

/* Whether the match is as it was, to the bit, but for the reason of the refusal. */
static bool is_as_before(void) {
  memcpy(before.fault, reader.fault, sizeof before.fault);
  before.refusal = reader.refusal;
  return memcmp(&before, &reader, sizeof before) == 0;
}

TEST(an_honest_line_after_each_hostile_one) {
  FILE *rows = fopen(CAROM_TEST_HOSTILE, "r");
  ck_assert_msg(rows != NULL, "%s cannot be read", CAROM_TEST_HOSTILE);
  begin_hostile();
  static char text[HOSTILE_MOST];
  static hostile_row row;
  int sent = 0;
  while (fgets(text, sizeof text, rows) != NULL) {
    if (text[0] == '#')
      continue;
    ck_assert_msg(hostile_read(text, &match, &peer, &row), "%s", text);
    before = reader;
    const carom_status status = carom_match_receive(&reader, &room, row.line, row.size, row.seat);
    ck_assert_msg(status < 0 || hostile_is_empty(&row), "%s from seat %d is accepted", row.name,
                  row.seat);
    ck_assert_msg(status >= 0 || reader.fault[0] != '\0', "%s has no reason", row.name);
    ck_assert_msg(is_as_before(), "%s changed the match", row.name);

    /* the honest act, on a copy: its line alone, then with those of the ruling */
    const carom_match kept = reader;
    receive_all(&reader, peer.text, (size_t)(line_end(peer.text) - peer.text), 0);
    ck_assert_mem_eq(&reader.ruling, &peer.ruling, sizeof peer.ruling);
    ck_assert(reader.record.hash == peer.record.hash && reader.size == peer.size);
    receive_all(&reader, peer.text, (size_t)peer.size, 0);
    ck_assert(reader.record.hash == peer.record.hash && reader.size == peer.size);
    reader = kept;
    sent++;
  }
  fclose(rows);
  ck_assert_int_gt(sent, 30);
}

/* A stroke cannot be taken back: no option of a line changes how it ends. */
TEST(no_option_of_a_line_changes_a_shot) {
  const carom_shot_options stops[] = {
      {.events_most = 1}, {.time_most = 0.3},
      {.time_most = 1.5}, {.stop_at = CAROM_STOP_AT_CONTACT},
      {.first_of = 2},    {.time_most = 0.7, .stop_at = CAROM_STOP_AT_CONTACT}};
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    begin((carom_rules_kind)kind, 3, 0, 0);
    if (match.phase == CAROM_MATCH_PLACE) {
      const carom_bounds *b = &match.bounds;
      expect_ok(
          carom_match_place(&match, 0, 0.5 * (b->low[0] + b->high[0]) + 0.05, b->high[1] - 0.1));
    }
    carom_cue cue = match.cue;
    cue.speed = 5.0;
    cue.phi = 91.0;
    peer = match;
    expect_ok(carom_match_stroke(&peer, 0, &cue, NULL, NULL));
    for (size_t k = 0; k < COUNT_OF(stops); k++) {
      reader = match;
      carom_status status = carom_match_stroke(&reader, 0, &cue, &stops[k], NULL);
      for (int parts = 0; status > 0; parts++) { /* each part but the last ends early too */
        ck_assert_int_lt(parts, 1000);
        carom_shot_options stop = stops[k];
        if (stop.time_most > 0.0)
          stop.time_most = reader.record.played.time + stops[k].time_most;
        status = carom_match_continue(&reader, &stop, NULL);
      }
      expect_ok(status);
      const char *name = carom_rules_about_of((carom_rules_kind)kind)->name;
      ck_assert_msg(memcmp(&reader.ruling, &peer.ruling, sizeof peer.ruling) == 0,
                    "%s: options %d change the ruling", name, (int)k);
      ck_assert_msg(memcmp(reader.record.balls, peer.record.balls, sizeof peer.record.balls) == 0,
                    "%s: options %d change where the balls lie", name, (int)k);
    }
  }
}

/* ---- The contract of the header */

TEST(rulings_may_be_kept_back) {
  begin_hostile();
  receive_all(&reader, peer.text, (size_t)(line_end(peer.text) - peer.text), 0);
  ck_assert_int_eq(reader.due, 0);
  ck_assert_mem_eq(reader.text, peer.text, (size_t)peer.size);
  match = peer;
  const int seat = peer.seat;
  if (match.phase == CAROM_MATCH_PLACE) {
    expect_ok(carom_match_place(&match, seat, 0.5, 0.5));
    receive_all(&reader, match.text, (size_t)match.size, seat);
  }
  expect_ok(carom_match_concede(&match, seat));
  receive_all(&reader, match.text, (size_t)match.size, seat);
  ck_assert(reader.record.hash == match.record.hash);
}

TEST(a_line_that_comes_twice) {
  begin_hostile();
  for (int times = 0; times < 3; times++)
    receive_all(&reader, peer.text, (size_t)peer.size, 0);
  ck_assert(reader.record.hash == peer.record.hash);
  ck_assert_int_eq(reader.record.shots, 1);
}

TEST(a_match_that_has_not_begun) {
  begin_hostile();
  static carom_match none;
  memset(&none, 0, sizeof none);
  ck_assert_int_eq(carom_match_receive(&none, &room, match.text, (size_t)match.size, 0),
                   CAROM_ERROR_ACT);
  ck_assert_int_eq(none.refusal, CAROM_REFUSED_NOT_BEGUN);
  static const char wrong[] = "{\"table\":{\"kind\":\"moon\"}}\n";
  memset(&none, 0, sizeof none);
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  const char *second = line_end(match.text);
  receive_all(&none, match.text, (size_t)(second - match.text), -1);
  ck_assert_int_lt(carom_match_receive(&none, &room, wrong, sizeof wrong - 1, -1), 0);
  receive_all(&none, second, (size_t)(match.text + match.size - second), -1);
  ck_assert(none.record.hash == match.record.hash && none.phase == match.phase);
}

/* The end, once the match is over, and the next match of a set come from any seat. */
TEST(the_end_of_a_match) {
  carom_set set = {.race = 3};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  expect_ok(carom_match_begin_with(
      &match, &(carom_match_setup){
                  .rules = CAROM_RULES_NINEBALL, .table = &table, .seed = 5, .set = &set}));
  memset(&reader, 0, sizeof reader);
  receive_all(&reader, match.text, (size_t)match.size, -1);
  expect_ok(carom_match_concede(&match, 1));
  receive_all(&reader, match.text, (size_t)match.size, 1);
  expect_ok(carom_match_end(&match));
  receive_all(&reader, match.text, (size_t)match.size, 0);
  expect_ok(carom_match_next(&match));
  receive_all(&reader, match.text, (size_t)match.size, 1);
  ck_assert(reader.record.hash == match.record.hash && reader.phase == match.phase);
  ck_assert_int_eq(reader.record.set.number, 2);
}

TEST(another_seat_continues_a_shot) {
  begin_hostile();
  carom_cue cue = match.cue;
  cue.speed = 7.0;
  const carom_shot_options stop = {.time_most = 0.5};
  ck_assert_int_gt(carom_match_stroke(&match, 0, &cue, &stop, NULL), 0);
  receive_all(&reader, match.text, (size_t)match.size, 0);
  expect_ok(carom_match_continue(&match, NULL, NULL));
  receive_all(&reader, match.text, (size_t)match.size, 1);
  ck_assert(reader.record.hash == match.record.hash);
}

/* ---- Random matches, with changed lines between the honest ones */

/* A line of the act in match->text with some bytes changed. */
static size_t spoil(random_source *r) {
  const char *at = match.text;
  const size_t size = (size_t)(line_end(at) - 1 - at);
  memcpy(line, at, size);
  const int changes = 1 + (int)random_between(r, 0.0, 3.0);
  for (int k = 0; k < changes; k++)
    line[(size_t)random_between(r, 0.0, (double)size)] = (char)random_between(r, 32.0, 127.0);
  return size;
}

TEST(random_lines_between_honest_ones) {
  random_source r = {test_seed()};
  int refused = 0;
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    begin((carom_rules_kind)kind, (uint64_t)kind, 0, 0);
    memset(&reader, 0, sizeof reader);
    receive_all(&reader, match.text, (size_t)match.size, -1);
    for (int acts = 0; acts < 12 && match.phase != CAROM_MATCH_OVER; acts++) {
      const int seat = match.seat;
      const carom_bounds *b = &match.bounds;
      carom_cue cue = match.cue;
      cue.speed = random_between(&r, 0.5, 6.0);
      cue.phi = random_between(&r, 0.0, 360.0);
      carom_status status;
      if (match.phase == CAROM_MATCH_PLACE)
        status = carom_match_place(&match, seat, random_between(&r, b->low[0], b->high[0]),
                                   random_between(&r, b->low[1], b->high[1]));
      else
        status = carom_match_stroke(&match, seat, &cue, NULL, NULL);
      if (status < 0)
        continue; /* such as a place in a ball */
      for (int lines = 0; lines < 8; lines++) {
        const size_t size = spoil(&r);
        const int sender = (int)random_between(&r, -1.0, 3.0);
        before = reader;
        if (carom_match_receive(&reader, &room, line, size, sender) < 0)
          refused++;
        else if (size == (size_t)(line_end(match.text) - 1 - match.text) &&
                 memcmp(line, match.text, size) == 0)
          reader = before; /* the changes changed nothing */
        ck_assert_msg(is_as_before(), "%.*s changed the match", (int)size, line);
      }
      receive_all(&reader, match.text, (size_t)(line_end(match.text) - match.text), seat);
      ck_assert(reader.record.hash == match.record.hash);
    }
  }
  ck_assert_int_gt(refused, 500);
}

/* Who acted last is readable, also behind an act that has passed the turn. */
TEST(who_acted_last) {
  begin_hostile();
  static carom_match begun;
  begin(CAROM_RULES_NINEBALL, 5, 0, 0);
  begun = match;
  ck_assert_int_eq(begun.record.actor, -1);
  ck_assert_int_eq(reader.record.actor, 0); /* has placed the cue ball */
  receive_all(&reader, peer.text, (size_t)(line_end(peer.text) - peer.text), 0);
  ck_assert_int_eq(reader.record.actor, 0);
  ck_assert_int_eq(reader.seat, 1);
  match = reader;
  if (match.phase == CAROM_MATCH_PLACE)
    expect_ok(carom_match_place(&match, 1, 0.5, 0.5));
  carom_cue cue = match.cue;
  cue.speed = 1.0;
  expect_ok(carom_match_stroke(&match, 1, &cue, NULL, NULL));
  ck_assert_int_eq(match.record.actor, 1);
  expect_ok(carom_match_concede(&match, 0));
  ck_assert_int_eq(match.record.actor, 0);
}
