/* The native side of bench.mjs, by the instruction set `plain`, on one thread.
 *
 *     native N < ROWS        N collisions of 26 doubles each; prints a line for each task: its
 *                            name and ns for each item
 *
 * bench.mjs compiles it against ../build/libcarom.a and runs it between its own rounds. */
#define _POSIX_C_SOURCE 199309L
#include <carom.h>
#include <carom_shot.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 8192, BREAKS = 100, BALLS = 10 };

static carom_impact in[MOST];
static carom_result out[MOST];
static carom_table table;
static carom_shot_ball balls[BALLS];
static carom_cue cues[BREAKS];
static carom_shot shots[BREAKS];
static carom_ball_state final[BREAKS][BALLS];
static size_t rows, few;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static void exact(void) {
  carom_collide_batch(in, rows, NULL, out, NULL);
}

static void euler(void) {
  const carom_options options = {.solver = CAROM_SOLVER_EULER};
  carom_collide_batch(in, few, &options, out, NULL);
}

static void calls(void) {
  for (size_t k = 0; k < few; k++)
    carom_collide(&in[k], NULL, &out[k]);
}

static void play(carom_shot_cushion cushion) {
  const carom_shot_options options = {.cushion_model = cushion};
  for (int k = 0; k < BREAKS; k++)
    shots[k] = (carom_shot){.final = final[k]};
  const carom_shot_job job = {.table = &table,
                              .balls = balls,
                              .count = BALLS,
                              .cues = cues,
                              .cue_stride = 1,
                              .n = BREAKS,
                              .options = &options,
                              .shots = shots};
  carom_shoot_batch(&job);
}

static void han(void) {
  play(CAROM_SHOT_CUSHION_HAN);
}

static void mathavan(void) {
  play(CAROM_SHOT_CUSHION_MATHAVAN);
}

/* The mean of as many turns as 30 ms hold. */
static void measure(const char *what, void (*task)(void), size_t items) {
  const double begun = now();
  double ended;
  int turns = 0;
  do {
    task();
    turns++;
    ended = now();
  } while (ended - begun < 30e6);
  printf("%s %.1f\n", what, (ended - begun) / turns / (double)items);
}

int main(int argc, char **argv) {
  carom_isa_limit(CAROM_ISA_PLAIN);
  rows = fread(in, sizeof in[0], MOST, stdin);
  few = argc > 1 ? strtoul(argv[1], NULL, 10) : 0;
  if (few == 0 || few > rows)
    return fprintf(stderr,
                   "native: N must be 1 to the number of collisions on standard input, %zu\n",
                   rows) > 0;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, BALLS);
  for (int k = 0; k < BREAKS; k++) {
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = 8.0;
    cues[k].phi = 85.0 + k / 10.0;
  }
  measure("batch", exact, rows);
  measure("calls", calls, few);
  measure("euler", euler, few);
  measure("han", han, BREAKS);
  measure("mathavan", mathavan, BREAKS);
  return 0;
}
