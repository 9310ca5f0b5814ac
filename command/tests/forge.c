/* What command/tests/match.sh has verified: a match of eight-ball whose bits and hashes agree. Its
 * player fouls on the break, and keeps the table. */
#include "carom_record.h"

#include <stdio.h>

static carom_record game;

static void put(carom_record_kind kind) {
  static char text[CAROM_RECORD_TEXT];
  fwrite(text, 1, carom_record_write(&game, kind, text, sizeof text), stdout);
}

int main(void) {
  game.match = 1;
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.count = carom_rack_size(CAROM_RACK_EIGHTBALL);
  carom_rack(CAROM_RACK_EIGHTBALL, &game.table, 1e-4, 5, game.balls, CAROM_BALLS_MOST);
  game.standing.opening = 1;
  put(CAROM_RECORD_HEAD);
  put(CAROM_RECORD_TABLE);
  put(CAROM_RECORD_OPTIONS);
  put(CAROM_RECORD_BALLS);
  put(CAROM_RECORD_GAME);
  game.cue = carom_cue_of(CAROM_GAME_POOL);
  game.cue.speed = 0.5;
  game.cue.phi = 180.0;
  carom_record_play(&game, CAROM_RECORD_SHOT, NULL);
  put(CAROM_RECORD_SHOT);
  carom_record_settle(&game);
  game.standing.opening = 0;
  game.standing.group = 1;
  put(CAROM_RECORD_GAME);
  put(CAROM_RECORD_END);
  return 0;
}
