/* A program for Windows without a C library, so that it can be compiled and linked as by MSVC where
 * there is no SDK: plays a break and writes the line of its recording, with the hash of its bits.
 */
#include <carom_record.h>

#define WINDOWS __declspec(dllimport)
WINDOWS void *__stdcall GetStdHandle(unsigned long which);
WINDOWS int __stdcall WriteFile(void *file, const void *bytes, unsigned long size,
                                unsigned long *written, void *unused);
WINDOWS void __stdcall ExitProcess(unsigned code);

int _fltused; /* what MSVC requires where there are doubles */

static carom_record game;
static char text[CAROM_RECORD_TEXT];

void start(void) {
  unsigned long written;
  carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
  game.count = 10;
  carom_rack(CAROM_RACK_NINEBALL, &game.table, 1e-4, 1, game.balls, 10);
  carom_record_write(&game, CAROM_RECORD_HEAD, text, sizeof text);
  game.cue = carom_cue_of(CAROM_GAME_POOL);
  game.cue.speed = 8.0;
  const carom_status status = carom_record_play(&game, CAROM_RECORD_SHOT, 0);
  const size_t size = carom_record_write(&game, CAROM_RECORD_SHOT, text, sizeof text);
  WriteFile(GetStdHandle((unsigned long)-11), text, (unsigned long)size, &written, 0);
  ExitProcess(status != CAROM_OK || size == 0);
}
