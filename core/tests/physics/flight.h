/* Motions of one ball in a vertical plane in closed form: struck, in flight, landing. Tests of
 * balls that fly compare shots with them. The ball is ball_at(); the cue is pooltool's, and its
 * tip touches for no time, so that the blow and the landing on the slate are two events. */
#ifndef CAROM_TESTS_FLIGHT_H
#define CAROM_TESTS_FLIGHT_H

#include "shot_support.h"

static const double R = 0.028575;                   /* m */
static const double g = 9.81;                       /* m/s^2 */
static const double mu_slide = 0.2;                 /* ball and cloth */
static const double mu_spin = 4.0 / 9.0 * 0.028575; /* m, turning on the spot */
static const double slate_restitution = 0.5;        /* ball and slate */
static const double loss = 0.02;                    /* m/s, the fixed loss of a hop */
static const double mass_of_ball = 0.170097;        /* kg */
static const double mass_of_cue = 0.567;            /* kg */

/* A speed along the cloth, one upwards, and R times the spin: where spin and along are equal, the
 * ball rolls. */
typedef struct flight {
  double along;
  double up;
  double spin;
} flight;

/* The speed at which a ball leaves the slate that it meets at `speed`; 0 where the hops end. */
static inline double bounce(double speed) {
  const double square = slate_restitution * slate_restitution * speed * speed - loss * loss;
  return square > 0.0 ? sqrt(square) : 0.0;
}

/* What the slate makes of a ball that moves down. Friction slows the slip by 7/2 of what it takes
 * from the speed, and not beyond 0. */
static inline flight landed(flight in) {
  const double up = bounce(-in.up);
  const double slip = in.along - in.spin;
  const double slowed = fmin(mu_slide * (up - in.up), 2.0 / 7.0 * fabs(slip));
  const double change = copysign(slowed, slip);
  return (flight){in.along - change, up, in.spin + 2.5 * change};
}

/* What a cue of elastic tip makes of a ball: raised by `theta` degrees, b R above the middle. */
static inline flight struck(double speed, double theta, double b) {
  const double raised = theta * 3.14159265358979323846 / 180.0;
  const double blow = 2.0 * speed / (1.0 + mass_of_ball / mass_of_cue + 2.5 * b * b);
  return (flight){blow * cos(raised), -blow * sin(raised), 2.5 * b * blow};
}

static inline carom_shot_ball spinning(carom_shot_ball b, double w_x, double w_y, double w_z) {
  b.state.w[0] = w_x;
  b.state.w[1] = w_y;
  b.state.w[2] = w_z;
  return b;
}

/* One ball that is let go, so far from the rails that it meets none. */
static inline carom_shot let_go(carom_shot_ball ball) {
  const carom_table table = empty_table(4000.0);
  ball.state.r[0] = 2000.0;
  ball.state.r[1] = 2000.0;
  return play(&table, &ball, 1, NULL, NULL, CAROM_OK);
}

/* pooltool's cue, raised, in the middle of the ball but for b. */
static inline carom_cue raised_cue(double speed, double theta, double b) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOLTOOL_POOL);
  cue.speed = speed;
  cue.theta = theta;
  cue.b = b;
  cue.tip_time = -1.0;
  return cue;
}

/* Where raised_strike() leaves the ball, m from either wall. */
static const double struck_at = 20.0;

/* Such a strike of a single ball, along +y. */
static inline carom_shot raised_strike(double speed, double theta, double b, carom_space space) {
  const carom_table table = empty_table(2.0 * struck_at);
  const carom_shot_ball ball = ball_at(struck_at, struck_at);
  const carom_cue cue = raised_cue(speed, theta, b);
  return play(&table, &ball, 1, &cue, &(carom_shot_options){.space = space}, CAROM_OK);
}

#endif
