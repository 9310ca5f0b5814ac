/* What tests of recordings share: a game with every kind of line but the last. */
#ifndef CAROM_TESTS_RECORDED_GAME_H
#define CAROM_TESTS_RECORDED_GAME_H

#include "carom_record.h"

/* Writes a line; each test has its own. */
static void add_line(carom_record *game, carom_record_kind kind);

/* 3 balls on the table that is made, a stopped shot that continues, events, the state of the game
 * where the library knows games, a cue ball that is placed, and another shot. */
static inline void record_game(carom_record *game) {
  static carom_event events[100];
  carom_shot shot = {0};
  shot.events = events;
  shot.room = 100;
  game->count = 3;
  carom_rack(CAROM_RACK_THREECUSHION, &game->table, 1e-4, 1, game->balls, 3);
  for (int kind = CAROM_RECORD_HEAD; kind <= CAROM_RECORD_BALLS; kind++)
    add_line(game, (carom_record_kind)kind);

  /* a shot up to its first contact, two of its events, and the rest of it */
  game->cue = carom_cue_of(CAROM_GAME_POOL);
  game->cue.speed = 2.0;
  game->options.stop_at = CAROM_STOP_AT_CONTACT;
  carom_record_play(game, CAROM_RECORD_SHOT, &shot);
  add_line(game, CAROM_RECORD_SHOT);
  for (int k = 0; k < 2 && k < shot.count; k++) {
    game->event = events[k];
    game->before = game->after = events[k].type == CAROM_EVENT_BALL_BALL ? 2 : 1;
    add_line(game, CAROM_RECORD_EVENT);
  }
  game->options.stop_at = 0;
  carom_record_play(game, CAROM_RECORD_CONTINUE, NULL);
  add_line(game, CAROM_RECORD_CONTINUE);
#ifndef CAROM_WITHOUT_PLAN
  game->standing = (carom_rules_state){.fouls = {0, 1}, .may = 2, .user = {0, 7}};
  game->rules = game->side = 1;
  add_line(game, CAROM_RECORD_GAME);
#endif
  carom_record_place(game, 0, 0.3, 0.4, NULL);
  add_line(game, CAROM_RECORD_PLACE);
  carom_record_play(game, CAROM_RECORD_SHOT, NULL);
  add_line(game, CAROM_RECORD_SHOT);
}

#endif
