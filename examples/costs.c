/* What the calls of a game cost: a row of a table each, in us of processor time, the median of many
 * runs. docs/using/games.md has the table.
 *
 *     costs         prints the table; on a busy machine its numbers are too large
 *     costs quick   runs each call three times, as a test that the calls are served
 */
#define _POSIX_C_SOURCE 200809L
#include "carom_plan.h"
#include "carom_record.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BALLS = 16, EVENTS = 512, MOST = 201 };

static carom_table table;
static carom_shot_ball rack[BALLS], lie[BALLS]; /* before the break, and after it */
static carom_cue cue, soft;
static carom_event events[EVENTS];
static carom_ball_state states[BALLS];
static carom_facts facts;
static carom_shot_state state;
static carom_shot shot, parts; /* the break; another shot */
static carom_frames film;
static double turned[BALLS][4], at;
static carom_shot_options options;
static carom_plan_options wanted;
static carom_player player;
static carom_plan_rules rules;
static carom_plan_job job;
static carom_record record;
static char text[CAROM_RECORD_TEXT];
static carom_plan_stroke choice;
static int found;

/* ---- The calls: each tells whether it was served. */

static bool play_break(void) {
  shot.count = 0;
  return carom_shoot(&table, rack, BALLS, &cue, NULL, &shot) == CAROM_OK;
}
static bool play_soft(void) {
  parts = (carom_shot){.final = states};
  return carom_shoot(&table, lie, BALLS, &soft, NULL, &parts) == CAROM_OK;
}
static bool play_to_contact(void) {
  parts = (carom_shot){.facts = &facts};
  options = (carom_shot_options){.stop_at = CAROM_STOP_AT_CONTACT};
  return carom_shoot(&table, rack, BALLS, &cue, &options, &parts) == CAROM_STOPPED_AT_EVENT;
}
static bool go_on(void) { /* a sixtieth of a second of the break */
  if (options.time_most == 0.0 || options.time_most > 5.0) {
    parts = (carom_shot){.final = states, .state = &state};
    options = (carom_shot_options){.time_most = 1.0 / 60.0};
    return carom_shoot(&table, rack, BALLS, &cue, &options, &parts) == CAROM_STOPPED_AT_TIME;
  }
  options.time_most += 1.0 / 60.0;
  return carom_shot_continue(&table, rack, BALLS, &options, &parts) == CAROM_STOPPED_AT_TIME;
}
static bool next_frame(void) {
  at = at + 1.0 / 60.0 < shot.time ? at + 1.0 / 60.0 : 0.0;
  return carom_shot_frames(rack, BALLS, &shot, &at, 1, &film, states, turned) == CAROM_OK;
}
static bool last_frame(void) {
  at = at > 0.0 ? fmax(0.0, at - 1.0 / 60.0) : shot.time;
  return carom_shot_frames(rack, BALLS, &shot, &at, 1, &film, states, turned) == CAROM_OK;
}
static bool any_states(void) {
  return carom_shot_at(rack, BALLS, &shot, 0.5 * shot.time, states) == CAROM_OK;
}
static bool any_drawn(void) {
  const double time = 0.5 * shot.time;
  return carom_shot_drawn(&table, rack, BALLS, &shot, &time, 1, states) == CAROM_OK;
}
static bool any_turns(void) {
  return carom_shot_frames(rack, BALLS, &shot, &(double){0.5 * shot.time}, 1, NULL, NULL, turned) ==
         CAROM_OK;
}
static bool check(void) {
  return carom_shot_check(&table, lie, BALLS, &cue, NULL, NULL) == CAROM_OK;
}
static bool put_ball(void) {
  carom_part part;
  return carom_place_ball(&table, lie, BALLS, 0, 0.6, 0.3, &part) == CAROM_OK;
}
static bool aim(void) {
  carom_pot pot = {.ball = 1, .pocket = 1};
  carom_cue aimed = soft;
  return carom_aim(&table, lie, BALLS, NULL, &pot, &aimed) == CAROM_OK;
}
static bool value(void) {
  double chance;
  return carom_plan_value(&job, 0, &chance) == CAROM_OK;
}
static bool plan(void) {
  wanted = (carom_plan_options){.shots = 300};
  return carom_plan(&job, &choice, 1, &found) == CAROM_OK && found == 1;
}
static bool plan_slice(void) {
  static bool goes;
  wanted = (carom_plan_options){.shots = 300, .slice = 500};
  const carom_status status =
      goes ? carom_plan_continue(&job, &choice, 1, &found) : carom_plan(&job, &choice, 1, &found);
  goes = found == 0;
  return status == CAROM_OK;
}
static bool record_shot(void) {
  memset(&record, 0, sizeof record);
  record.table = table;
  record.count = BALLS;
  memcpy(record.balls, lie, sizeof lie);
  record.cue = soft;
  return carom_record_write(&record, CAROM_RECORD_HEAD, text, sizeof text) > 0 &&
         carom_record_write(&record, CAROM_RECORD_TABLE, text, sizeof text) > 0 &&
         carom_record_write(&record, CAROM_RECORD_BALLS, text, sizeof text) > 0 &&
         carom_record_play(&record, CAROM_RECORD_SHOT, NULL) == CAROM_OK &&
         carom_record_write(&record, CAROM_RECORD_SHOT, text, sizeof text) > 0;
}

static const struct {
  const char *what;
  bool (*call)(void);
  int least; /* runs in a row of one measurement */
} calls[] = {
    {"carom_shoot(): the break, with its events", play_break, 1},
    {"a stroke of 2 m/s, its end alone", play_soft, 10},
    {"the break up to the first contact", play_to_contact, 10},
    {"carom_shot_continue(): the break, for 1/60 s", go_on, 10},
    {"carom_shot_frames(): the next frame of the break", next_frame, 10},
    {"the frame before it, of a film that runs back", last_frame, 10},
    {"carom_shot_at(): states in the middle of the break", any_states, 10},
    {"carom_shot_drawn(): the same, with balls that fall", any_drawn, 10},
    {"carom_shot_frames(): turns in the middle of the break", any_turns, 1},
    {"carom_shot_check(): a layout", check, 100},
    {"carom_place_ball(): ball in hand", put_ball, 100},
    {"carom_aim(): a pot", aim, 1},
    {"carom_plan_value(): a layout", value, 10},
    {"carom_plan(): 300 shots", plan, 1},
    {"carom_plan_continue(): 500 events of it", plan_slice, 1},
    {"a recording of one stroke: four lines and its shot", record_shot, 1},
};

static double microseconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}
static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv) {
  const int runs = argc > 1 && strcmp(argv[1], "quick") == 0 ? 3 : MOST;

  /* the rack of eight-ball, its break, and the layout that it leaves */
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, 7, rack, BALLS);
  cue = soft = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 8.0;
  soft.phi = 70.0;
  shot = (carom_shot){.events = events, .room = EVENTS, .final = states};
  if (!play_break())
    return 1;
  memcpy(lie, rack, sizeof lie);
  for (int k = 0; k < BALLS; k++)
    lie[k].state = states[k];
  put_ball();

  player = carom_player_of(1.0);
  rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  wanted.shots = 300;
  job = (carom_plan_job){.table = &table,
                         .balls = lie,
                         .count = BALLS,
                         .cue = &soft,
                         .player = &player,
                         .rules = &rules,
                         .options = &wanted,
                         .memory_size = carom_plan_memory(&wanted)};
  job.memory = malloc(job.memory_size);

  printf("%-60s %8s %8s\n", "16 balls, us", "median", "longest");
  for (size_t k = 0; k < sizeof calls / sizeof calls[0]; k++) {
    static double took[MOST];
    for (int run = 0; run < runs; run++) {
      const double begun = microseconds();
      for (int n = 0; n < calls[k].least; n++)
        if (!calls[k].call()) {
          printf("%s: refused\n", calls[k].what);
          return 1;
        }
      took[run] = (microseconds() - begun) / calls[k].least;
    }
    qsort(took, (size_t)runs, sizeof *took, ascending);
    printf("%-60s %8.1f %8.1f\n", calls[k].what, took[runs / 2], took[runs - 1]);
  }
  free(job.memory);
  return 0;
}
