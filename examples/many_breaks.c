/* A thousand breaks: the same nine-ball rack, the aim and the tip's place varied, on all
 * processors.
 *
 * A shot is a chain of events. Between two of them each ball moves in closed form, so that
 * nothing is stepped through:
 *
 *     sliding   r = r0 + v0 t - mu g/2 u/|u| t^2      until t = 2 |u| / (7 mu g), u the slip
 *     rolling   r = r0 + v0 t - mu_r g/2 v0/|v0| t^2  until t = |v0| / (mu_r g)
 *
 * Only the final states are requested, so a shot needs no memory but those. One shot more is
 * played with its events, and looked at while the balls run. */
#include "carom_shot.h"

#include <math.h>
#include <stdio.h>

enum { BALLS = 10, BREAKS = 1000, EVENTS = 512 };

static carom_cue cues[BREAKS];
static carom_shot shots[BREAKS];
static carom_ball_state final[BREAKS][BALLS];
static carom_event events[EVENTS];

/* The number of object balls that fell; -1 if the cue ball did. */
static int fallen(const carom_ball_state *states) {
  int count = 0;
  for (int k = 1; k < BALLS; k++)
    count += states[k].label == CAROM_BALL_POCKETED;
  return states[0].label == CAROM_BALL_POCKETED ? -1 : count;
}

int main(void) {
  /* the table, the rack with gaps of a tenth of a millimetre, and a cue for each break */
  carom_table table;
  carom_shot_ball balls[BALLS];
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, BALLS);
  for (int k = 0; k < BREAKS; k++) {
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = 8.0;
    cues[k].phi = 89.0 + 2.0 * k / BREAKS; /* degrees */
    cues[k].b = 0.1 + 0.002 * (k % 100);
    shots[k].final = final[k];
  }

  /* one layout for all cues */
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN,
                                      .threads = CAROM_ALL_THREADS};
  const carom_shot_job job = {.table = &table,
                              .balls = balls,
                              .cues = cues,
                              .count = BALLS,
                              .cue_stride = 1,
                              .n = BREAKS,
                              .options = &options,
                              .shots = shots};
  carom_status status = carom_shoot_batch(&job);
  if (status != CAROM_OK) {
    fprintf(stderr, "a break failed: %s\n", carom_status_string(status));
    return 1;
  }
  int best = 0, dry = 0;
  for (int k = 0; k < BREAKS; k++) {
    best = fallen(final[k]) > fallen(final[best]) ? k : best;
    dry += fallen(final[k]) == 0;
  }
  printf("%d of %d breaks are dry; the best, at %.3f degrees, drops %d balls\n", dry, BREAKS,
         cues[best].phi, fallen(final[best]));

  /* the best one again, with its events: it ends as it did in the batch, and can be looked at at
   * any time */
  carom_ball_state end[BALLS], then[BALLS];
  carom_shot shot = {.events = events, .room = EVENTS, .final = end};
  status = carom_shoot(&table, balls, BALLS, &cues[best], &options, &shot);
  if (status != CAROM_OK || fallen(end) != fallen(final[best]) ||
      end[0].r[0] != final[best][0].r[0])
    return 1;
  for (double time = 0.0; time < shot.time; time += 2.0) {
    carom_shot_at(balls, BALLS, &shot, time, then);
    double fastest = 0.0;
    for (int k = 0; k < BALLS; k++)
      fastest = fmax(fastest, hypot(then[k].v[0], then[k].v[1]));
    printf("after %4.1f s the fastest ball runs at %.2f m/s\n", time, fastest);
  }
  return 0;
}
