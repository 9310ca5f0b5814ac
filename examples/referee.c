/* A referee: plays every shot of a recording again, and rejects the one that ended otherwise.
 *
 * A player sends the lines of a recording (carom_record.h): each stroke of the cue, how its shot
 * ended, and a hash of all of that. The referee computes the shot from the stroke. Where the ends
 * differ, the player's program is damaged, of another build, or forged, and the game is stopped at
 * that shot. The referee's own state after it, game.final and game.facts, is the truth
 * by which rules are applied.
 *
 *     referee FILE     judges a recording; - is standard input: a server gives it a connection
 *     referee          plays 5,000 strokes itself, judges them, and tells how many a second */
#define _POSIX_C_SOURCE 200809L
#include "carom_record.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STROKES = 5000, BALLS = 16 };

/* ---- The referee */

typedef enum verdict { GOOD, REJECTED, ENDED } verdict;

/* Judges one line. */
static verdict judge(carom_record *game, const char *line, size_t size) {
  const carom_status status = carom_record_read(game, line, size);
  if (status == CAROM_ERROR_REVISION) {
    printf("rejected: revision %" PRId64 " of the physics, not %d\n", game->revision,
           carom_physics_revision());
    return REJECTED;
  }
  if (status < 0) {
    printf("rejected: line %" PRId64 ": %s\n", game->line, game->fault);
    return REJECTED;
  }
  if (game->kind == CAROM_RECORD_SHOT || game->kind == CAROM_RECORD_CONTINUE) {
    const carom_status played = carom_record_play(game, (carom_record_kind)game->kind, NULL);
    if (game->pending == CAROM_PENDING_SHOT) { /* nothing was played */
      printf("rejected: shot %" PRId64 ": %s\n", game->shots, carom_status_string(played));
      return REJECTED;
    }
    if (memcmp(&game->played, &game->recorded, sizeof game->played) != 0) {
      printf("rejected: shot %" PRId64 " ends otherwise, after %.6f s with %" PRId64 " events\n",
             game->shots, game->played.time, game->played.events);
      return REJECTED;
    }
  }
  return game->kind == CAROM_RECORD_END ? ENDED : GOOD;
}

/* Judges a whole recording in memory; returns how many of its shots were good. */
static int64_t judge_all(carom_record *game, const char *text) {
  memset(game, 0, sizeof *game);
  verdict found = GOOD;
  while (found == GOOD && *text != '\0') {
    const char *end = strchr(text, '\n') + 1;
    found = judge(game, text, (size_t)(end - text));
    text = end;
  }
  return game->shots - (found == REJECTED);
}

static int judge_file(carom_record *game, FILE *in) {
  char *line = NULL;
  size_t room = 0;
  ssize_t size;
  verdict found = GOOD;
  while (found == GOOD && (size = getline(&line, &room, in)) >= 0)
    found = judge(game, line, (size_t)size);
  free(line);
  if (found == ENDED)
    printf("accepted: %" PRId64 " shots\n", game->shots);
  else if (found == GOOD)
    printf("rejected: cut off after %" PRId64 " shots\n", game->shots);
  return found != ENDED;
}

/* ---- A player, for the demonstration */

typedef struct paper {
  char *text;
  size_t size, room;
} paper;

static void put(paper *to, carom_record *game, carom_record_kind kind) {
  if (to->room - to->size < CAROM_RECORD_TEXT) {
    to->room = 2 * to->room + CAROM_RECORD_TEXT;
    char *more = (char *)realloc(to->text, to->room);
    if (more == NULL)
      exit(EXIT_FAILURE);
    to->text = more;
  }
  to->size += carom_record_write(game, kind, to->text + to->size, to->room - to->size);
}

/* Strokes of 1 to 4 m/s in all directions, from a rack that is set up anew every 40 strokes. */
static void play_game(carom_record *game, paper *to) {
  memset(game, 0, sizeof *game);
  carom_table_make(CAROM_TABLE_POOL_9FT, &game->table);
  put(to, game, CAROM_RECORD_HEAD);
  put(to, game, CAROM_RECORD_TABLE);
  game->cue = carom_cue_of(CAROM_GAME_POOL);
  for (int k = 0; k < STROKES; k++) {
    if (k % 40 == 0) {
      game->moved = 0; /* the balls are picked up */
      game->count = BALLS;
      carom_rack(CAROM_RACK_EIGHTBALL, &game->table, 1e-4, (uint64_t)k, game->balls, BALLS);
      put(to, game, CAROM_RECORD_BALLS);
    } else if (game->final[0].label >= CAROM_BALL_POCKETED) { /* ball in hand, where it is free */
      double y = 0.3;
      while (carom_record_place(game, 0, 0.6, y, NULL) != CAROM_OK)
        y += 0.01;
      put(to, game, CAROM_RECORD_PLACE);
    }
    game->cue.speed = k % 40 == 0 ? 8.0 : 1.0 + 0.01 * (k * 7 % 300);
    game->cue.phi = k % 40 == 0 ? 90.0 : k * 137.508 - 360.0 * (double)(k * 137 / 360);
    if (carom_record_play(game, CAROM_RECORD_SHOT, NULL) != CAROM_OK)
      exit(EXIT_FAILURE);
    put(to, game, CAROM_RECORD_SHOT);
  }
  put(to, game, CAROM_RECORD_END);
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv) {
  static carom_record game;
  if (argc > 1) {
    FILE *in = strcmp(argv[1], "-") == 0 ? stdin : fopen(argv[1], "rb");
    if (in == NULL) {
      perror(argv[1]);
      return 2;
    }
    return judge_file(&game, in);
  }

  paper sent = {0};
  play_game(&game, &sent);
  const double begun = seconds();
  const int64_t good = judge_all(&game, sent.text);
  const double took = seconds() - begun;
  printf("%" PRId64 " of %d shots accepted, %.0f a second on one core\n", good, STROKES,
         STROKES / took);

  /* a player who changes one digit of one stroke, and keeps the hash of the honest one */
  char *stroke = strstr(sent.text + sent.size / 2, "\"speed\":");
  stroke[8] = stroke[8] == '1' ? '2' : '1';
  const int64_t before = judge_all(&game, sent.text);
  free(sent.text);
  return good != STROKES || before >= STROKES;
}
