/* The same game in each language: plays the recording that is named, a break, and the frames of
 * that. Prints a hash of the bits of each, which is the same in C, C++, C#, Rust, Python and
 * JavaScript. */
#include <carom_record.h>

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static carom_record record;
static char line[CAROM_RECORD_TEXT];

/* FNV-1a of the bits of numbers, the lowest byte first. */
static uint64_t add(uint64_t hash, const double *number, int count) {
  for (int k = 0; k < count; k++) {
    uint64_t bits;
    memcpy(&bits, &number[k], sizeof bits);
    for (int byte = 0; byte < 8; byte++)
      hash = (hash ^ (bits >> 8 * byte & 255)) * 0x100000001b3u;
  }
  return hash;
}

int main(int count, char **arguments) {
  FILE *file = count == 2 ? fopen(arguments[1], "rb") : NULL;
  if (!file)
    return 2;
  while (fgets(line, sizeof line, file)) {
    if (carom_record_read(&record, line, strlen(line)) < 0) {
      fprintf(stderr, "%s\n", record.fault);
      return 1;
    }
    if (record.pending == CAROM_PENDING_SHOT)
      carom_record_play(&record, (carom_record_kind)record.kind, NULL);
    if (record.played.hash != record.recorded.hash) {
      fprintf(stderr, "shot %" PRId64 " has other bits than were recorded\n", record.shots);
      return 1;
    }
  }
  fclose(file);
  printf("recording: %" PRId64 " shots, %016" PRIx64 "\n", record.shots, record.hash);

  static carom_event events[1000];
  carom_table table;
  carom_shot_ball balls[10];
  carom_ball_state last[10];
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_shot_options options = {0};
  carom_shot shot = {.events = events, .room = 1000, .final = last};
  cue.speed = 8.0;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, 10);
  if (carom_shoot(&table, balls, 10, &cue, &options, &shot) != CAROM_OK)
    return 1;
  uint64_t hash = 0xcbf29ce484222325u;
  for (int k = 0; k < shot.count; k++)
    hash = add(hash, &events[k].time, 1);
  for (int k = 0; k < 10; k++)
    hash = add(add(add(hash, last[k].r, 3), last[k].v, 3), last[k].w, 3);
  printf("break: %" PRId64 " events, %016" PRIx64 "\n", shot.count, hash);

  /* each frame onward from the one before, with the balls that fall, and how events sound */
  static carom_frames film;
  carom_ball_state then[10];
  double turned[10][4];
  int frames = 0;
  for (; frames / 60.0 < shot.time; frames++) {
    const double time = frames / 60.0;
    if (carom_shot_frames(balls, 10, &shot, &time, 1, &film, then, turned) != CAROM_OK ||
        carom_shot_falls(&table, balls, 10, &shot, &time, 1, then) != CAROM_OK)
      return 1;
    for (int k = 0; k < 10; k++)
      hash = add(add(hash, then[k].r, 3), turned[k], 4);
  }
  for (int k = 0; k < shot.count; k++) {
    const double slip = carom_event_slip(&table, balls, 10, &events[k]);
    hash = add(hash, &slip, 1);
  }
  printf("film: %d frames, %016" PRIx64 "\n", frames, hash);
  return 0;
}
