/* What tests of matches share: a match, its recording, and acts that are rejected. */
#ifndef CAROM_TESTS_MATCH_SUPPORT_H
#define CAROM_TESTS_MATCH_SUPPORT_H

#include "game_support.h"

static carom_match match, reader, before;
static carom_record scratch;
static char file[1 << 22];
static size_t file_size;

static inline void keep(void) {
  ck_assert(file_size + (size_t)match.size < sizeof file);
  memcpy(file + file_size, match.text, (size_t)match.size);
  file_size += (size_t)match.size;
}

/* To so many points with equal innings, where there is a target. */
static inline void begin(carom_rules_kind kind, uint64_t seed, int player, int target) {
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  expect_ok(carom_match_begin_to(&match, kind, target, target > 0, &table, seed, player));
  file_size = 0;
  keep();
}

static inline carom_cue cue_of(carom_rules_kind kind) {
  carom_cue cue = carom_cue_of((carom_game)carom_rules_about_of(kind)->balls);
  cue.ball = match.cue_ball;
  return cue;
}

/* Reads text[size] by lines; returns the first status that is no CAROM_OK. */
static inline carom_status read_all(const char *text, size_t size) {
  memset(&reader, 0, sizeof reader);
  for (const char *line = text; line < text + size;) {
    const char *end = memchr(line, '\n', (size_t)(text + size - line));
    const char *next = end != NULL ? end + 1 : text + size;
    const carom_status status = carom_match_read(&reader, &scratch, line, (size_t)(next - line));
    if (status != CAROM_OK)
      return status;
    line = next;
  }
  return CAROM_OK;
}

/* The match that is read again is the one that was played. */
static inline void check_recording(const char *title) {
  ck_assert_msg(read_all(file, file_size) == CAROM_OK && reader.size == 0, "%s: %s", title,
                reader.fault);
  ck_assert_mem_eq(reader.record.balls, match.record.balls, sizeof match.record.balls);
  ck_assert_mem_eq(&reader.rules.state, &match.rules.state, sizeof match.rules.state);
  ck_assert(reader.winner == match.winner && reader.record.hash == match.record.hash);
}

/* What an act that is rejected may change. */
static inline void forget_refusal(carom_match *target) {
  target->refusal = 0;
  target->size = target->known = target->due = 0;
  memset(target->fault, 0, sizeof target->fault);
  memset(target->text, 0, sizeof target->text);
}

/* An act was rejected by this name, with these words, and has changed nothing since `before`. */
static inline void check_refusal(const char *title, carom_status status, const char *name,
                                 const char *words) {
  ck_assert_int_eq(status, CAROM_ERROR_ACT);
  ck_assert_msg(strcmp(carom_word(CAROM_WORDS_REFUSAL, (int)match.refusal), name) == 0 &&
                    strstr(match.fault, words) != NULL,
                "%s: %s: %s", title, carom_word(CAROM_WORDS_REFUSAL, (int)match.refusal),
                match.fault);
  ck_assert_int_eq(match.size, 0);
  reader = match;
  forget_refusal(&before);
  forget_refusal(&reader);
  ck_assert_msg(memcmp(&reader, &before, sizeof reader) == 0, "%s: it changed the match", title);
}

#endif
