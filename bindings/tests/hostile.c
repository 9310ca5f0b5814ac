/* hostile HOSTILE ROWS MATCH SENDS: the lines of games/tests/hostile.txt for the tests of all
 * languages and of the servers, which need no library to have them.
 *
 *     ROWS    begin LINE, place LINE and act LINE: the match, and the honest act with its ruling;
 *             row NAME|SEAT|LINE: a line that a peer sends before that act
 *     MATCH   a complete match that continues from there, as it must end on a server
 *     SENDS   SEAT LINE: the acts of that match, as its clients send them;
 *             stop LINE: the honest act, stopped while balls move */
#include "../../games/tests/hostile.h"

#include <stdlib.h>

static carom_match begun, placed, act, match;

static void put_lines(FILE *file, const char *word, const carom_match *source) {
  const char *line = source->text;
  while (line < source->text + source->size) {
    const int size = (int)hostile_size(line);
    fprintf(file, "%s %.*s\n", word, size, line);
    line += size + 1;
  }
}

static int write_rows(const char *path, FILE *file) {
  static char text[HOSTILE_MOST];
  static hostile_row row;
  FILE *rows = fopen(path, "r");
  if (rows == NULL)
    return -1;
  put_lines(file, "begin", &begun);
  put_lines(file, "place", &placed);
  put_lines(file, "act", &act);
  int count = 0;
  while (fgets(text, sizeof text, rows) != NULL) {
    if (text[0] == '#')
      continue;
    if (!hostile_read(text, &placed, &act, &row))
      return -1;
    fprintf(file, "row %s|%d|%.*s\n", row.name, row.seat, (int)row.size, row.line);
    count++;
  }
  fclose(rows);
  return count;
}

/* The line of an act that a seat has done; the lines of its ruling are not sent. */
static void keep(FILE *file, FILE *sends, carom_status status, int seat) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", carom_status_string(status), match.fault);
    exit(EXIT_FAILURE);
  }
  fwrite(match.text, 1, (size_t)match.size, file);
  if (seat >= 0 && match.size > 0)
    fprintf(sends, "%d %.*s\n", seat, (int)hostile_size(match.text), match.text);
}

static void stop_act(FILE *sends) {
  const carom_shot_options stop = {.time_most = 0.5};
  match = placed;
  carom_match_stroke(&match, 0, &act.stroke, &stop, NULL);
  put_lines(sends, "stop", &match);
}

static void play_match(FILE *file, FILE *sends) {
  enum { STROKES_MOST = 60 };
  const carom_player player = carom_player_rated(500.0, CAROM_RULES_NINEBALL);
  const carom_plan_options options = {.shots = 100};
  carom_plan_job job = {.player = &player, .options = &options};
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  match = begun;
  keep(file, sends, CAROM_OK, -1);
  match = placed;
  keep(file, sends, CAROM_OK, 0);
  match = act;
  keep(file, sends, CAROM_OK, 0);
  for (int k = 0; k < STROKES_MOST && match.phase != CAROM_MATCH_OVER; k++) {
    const int seat = match.seat;
    carom_plan_stroke best;
    int found;
    carom_match_plan(&match, &job, &best, 1, &found);
    if (match.phase == CAROM_MATCH_PLACE)
      keep(file, sends, carom_match_place(&match, seat, best.place[0], best.place[1]), seat);
    carom_player_strike(&player, 9, (uint64_t)match.record.shots, &best.cue);
    keep(file, sends, carom_match_stroke(&match, seat, &best.cue, NULL, NULL), seat);
  }
  if (match.phase != CAROM_MATCH_OVER)
    keep(file, sends, carom_match_concede(&match, 1), 1);
  keep(file, sends, carom_match_end(&match), -1);
  free(job.memory);
}

/* The line of a note, which each language writes too. */
static void write_note(void) {
  carom_note note = {.comment = "He said \"nice\"", .offer = "draw", .seconds = 12.5, .extras = 1};
  note.extra[0] = (carom_note_extra){.key = "x_club", .text = "A \\ B"};
  match = placed;
  carom_match_note(&match, 1, &note);
  printf("%.*s", (int)match.size, match.text);
}

int main(int count, char **arguments) {
  if (count != 5 || hostile_begin(&begun, &placed, &act) != CAROM_OK)
    return EXIT_FAILURE;
  FILE *rows = fopen(arguments[2], "w"), *file = fopen(arguments[3], "w");
  FILE *sends = fopen(arguments[4], "w");
  if (rows == NULL || file == NULL || sends == NULL)
    return EXIT_FAILURE;
  const int written = write_rows(arguments[1], rows);
  play_match(file, sends);
  stop_act(sends);
  fclose(rows);
  fclose(file);
  fclose(sends);
  write_note();
  printf("%d rows\n", written);
  return written < 30;
}
