/* Error bars: where does the object ball end if the player errs a little?
 *
 * A derivative of a shot tells how the end r of a ball changes with an input x. For small errors
 * with standard deviations s the covariance of the end is the sum over inputs of s^2 d d^T, with
 * d = dr/dx. Here the same is found by playing 2,000 shots with drawn errors, and compared. */
#include <carom_shot.h>
#include <carom_tangent.h>
#include <math.h>
#include <stdio.h>

enum { SAMPLES = 2000, BALLS = 2, EVENTS = 64 };
static carom_event events[EVENTS];
static carom_shot shot;
static double seed[CAROM_CUE_NUMBERS][2];
static double change[BALLS][CAROM_STATE_NUMBERS][2];

/* A normally distributed number: twelve uniform ones, their mean taken off. */
static double drawn(void) {
  static unsigned state = 1;
  double sum = -6.0;
  for (int k = 0; k < 12; k++) {
    state = state * 1664525u + 1013904223u;
    sum += state / 4294967296.0;
  }
  return sum;
}

int main(void) {
  const double errors[2] = {0.01, 0.02}; /* of the speed, m/s; of the direction, degrees */
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_shot_ball balls[BALLS] = {{.kind = carom_ball_kind_of(CAROM_GAME_POOL)}};
  balls[1] = balls[0];
  const double places[BALLS][2] = {{0.6, 0.8}, {0.65, 1.1}};
  for (int k = 0; k < BALLS; k++) {
    balls[k].state.r[0] = places[k][0], balls[k].state.r[1] = places[k][1];
    balls[k].state.r[2] = balls[k].kind.radius;
  }
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 0.9, cue.phi = 81.0;
  shot.events = events, shot.room = EVENTS;
  carom_ball_state final[BALLS];
  shot.final = final;
  carom_status status = carom_shoot(&table, balls, BALLS, &cue, NULL, &shot);

  /* the derivatives by speed and direction */
  seed[0][0] = seed[1][1] = 1.0;
  const carom_tangent_seeds seeds = {.directions = 2, .cue = &seed[0][0]};
  carom_tangent tangent = {.final = &change[0][0][0]};
  if (status == CAROM_OK)
    status = carom_shot_tangent(&table, balls, BALLS, &cue, NULL, &shot, &seeds, &tangent);
  if (status != CAROM_OK) {
    fprintf(stderr, "%s\n", carom_status_string(status));
    return 1;
  }
  const double centre[2] = {final[1].r[0], final[1].r[1]};

  /* the same by samples */
  double sampled[2] = {0.0, 0.0};
  const double speed = cue.speed, phi = cue.phi;
  shot.events = NULL, shot.room = 0;
  for (int k = 0; k < SAMPLES; k++) {
    cue.speed = speed + errors[0] * drawn(), cue.phi = phi + errors[1] * drawn();
    if (carom_shoot(&table, balls, BALLS, &cue, NULL, &shot) != CAROM_OK)
      return 1;
    for (int axis = 0; axis < 2; axis++)
      sampled[axis] += pow(final[1].r[axis] - centre[axis], 2.0) / SAMPLES;
  }
  int bad = 0;
  for (int axis = 0; axis < 2; axis++) {
    const double told = hypot(change[1][axis][0] * errors[0], change[1][axis][1] * errors[1]);
    const double found = sqrt(sampled[axis]);
    printf("%c: %.4f m, standard deviation %.2f mm by derivatives, %.2f mm by %d shots\n",
           "xy"[axis], centre[axis], 1e3 * told, 1e3 * found, SAMPLES);
    bad |= fabs(told - found) > 0.1 * found;
  }
  return bad;
}
