/* match FILE STROKES: a game of eight-ball between two programs of unlike strength, kept in FILE.
 *
 * Each plans its stroke, errs as players of its rating do, and is ruled by the library. Where FILE
 * has a game that was saved, by whichever program, or cut off by a crash, this one goes on.
 * match.cpp, Match.cs, match.rs, match.mjs and match.py write the same bytes. */
#include <carom_match.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static carom_match match;
static FILE *file;

/* Keeps the lines of an act; an act that was refused ends the program. */
static void keep(carom_status status) {
  fwrite(match.text, 1, (size_t)match.size, file);
  if (status >= 0)
    return;
  fprintf(stderr, "%s: %s\n", carom_status_string(status), match.fault);
  exit(EXIT_FAILURE);
}

/* Reads whole lines; what a crash left of the last one is written over. */
static void read_file(void) {
  static carom_record scratch;
  static char line[CAROM_RECORD_TEXT];
  long whole = 0;
  while (fgets(line, sizeof line, file) != NULL && strchr(line, '\n') != NULL) {
    const carom_status status = carom_match_read(&match, &scratch, line, strlen(line));
    if (status < 0)
      keep(status);
    whole = ftell(file);
  }
  fseek(file, whole, SEEK_SET);
}

int main(int count, char **arguments) {
  if (count != 3)
    return EXIT_FAILURE;
  const carom_player players[] = {carom_player_rated(550.0, CAROM_RULES_EIGHTBALL),
                                  carom_player_rated(650.0, CAROM_RULES_EIGHTBALL)};
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  carom_plan_options options = {.shots = 300};
  carom_plan_job job = {.cue = &cue, .options = &options};
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  file = fopen(arguments[1], "r+b");
  if (file != NULL) {
    read_file();
    keep(CAROM_OK); /* the lines that are missing behind a shot */
  } else {
    carom_table table;
    carom_table_make(CAROM_TABLE_POOL_9FT, &table);
    file = fopen(arguments[1], "wb");
    keep(carom_match_begin(&match, CAROM_RULES_EIGHTBALL, &table, 5, 0));
  }
  for (int k = atoi(arguments[2]); k > 0 && match.phase != CAROM_MATCH_OVER; k--) {
    const int me = (int)match.seat;
    carom_plan_stroke best;
    int found;
    job.player = &players[me];
    options.opponent = &players[1 - me];
    keep(carom_match_plan(&match, &job, &best, 1, &found));
    keep(carom_match_prepare(&match, me, &best));
    carom_player_strike(&players[me], 9, (uint64_t)match.record.shots, &best.cue);
    keep(carom_match_stroke(&match, me, &best.cue, NULL, NULL));
    char words[256];
    carom_ruling_string(&match.ruling, words, sizeof words);
    printf("%d: %s\n", me + 1, words);
    if (match.phase == CAROM_MATCH_OVER)
      keep(carom_match_end(&match));
  }
  free(job.memory);
  return fclose(file) != 0;
}
