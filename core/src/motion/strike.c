/* The strike of a cue: an instantaneous impact of the tip, with squirt.
 *
 * With m the ball's mass, M the cue's, m_e the mass of its end, e the restitution of the tip,
 * (a, b) the offset in units of R and I = 2/5 m R^2:
 *
 *   V = (1 + e) V0 / (1 + m/M + 5/2 (a^2 + b^2))     speed along the cue
 *   v = V (cos(alpha) (cos(theta) d - sin(theta) z) + sin(alpha) l)
 *   tan(alpha) = -(5/2) a sqrt(1 - a^2) / (1 + m/m_e + 5/2 (1 - a^2))
 *   w = 5 V/(2R) (b, a sin(theta), -a cos(theta))     turned about z by phi + 90 degrees
 *
 *      along the cue                     from the side, d to the left
 *           ___                                ___
 *         /  a  \                            /   \ ___
 *        | *---+ |                          |  o  |   ---___
 *        |     |b|     * the tip             \___/          ---___  cue, raised by theta
 *        |     o |     o the centre    ______________________________---
 *         \_____/
 *
 * d is the horizontal direction of phi, l the horizontal to its left. In space this is only the
 * strike, which drives the ball into the slate; shot/raised.c has what the slate does meanwhile. In
 * flat play the downward component of the strike is lost. pooltool turns what is left of it: v = V
 * cos(theta) in the direction phi + alpha. With theta = 0 all three are the same, to the last bit.
 * Sources: D. Alciatore, TP A-30 and TP A-31; pooltool's. */
#include "motion/strike.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "schema/numbers.h"

#include <math.h>
#include <stddef.h>

/* m R^2 / I of a solid ball, I = 2/5 m R^2. A macro for the same reason as those of path.c. */
#define OVER_INERTIA 2.5

carom_status carom_check_cue(const carom_cue *cue) {
  const carom_cue *k = cue;
  CAROM_CUE_NUMBERS(CAROM_CHECK_ROW, CAROM_NO_ROW)
  const double limit = cue->miscue > 0.0 ? cue->miscue : 1.0;
  return cue->a * cue->a + cue->b * cue->b < limit * limit ? CAROM_OK : CAROM_ERROR_MISCUE;
}

double carom_strike_speed(const carom_cue *cue, const carom_ball_kind *kind) {
  const double a = cue->a, b = cue->b;
  return (1.0 + carom_tip_of(cue)) * cue->speed /
         (1.0 + kind->mass / cue->mass + OVER_INERTIA * (a * a + b * b));
}

carom_status carom_strike_motion(const carom_cue *cue, const carom_ball_kind *kind,
                                 carom_strike_kind how, carom_motion *out) {
  /* the directions of the cue, and the speed of the ball along it */
  const double a = cue->a, b = cue->b, inside = 1.0 - a * a;
  const double speed = carom_strike_speed(cue, kind);
  double sin_phi, cos_phi, sin_theta, cos_theta;
  carom_sincos_degrees(cue->phi, &sin_phi, &cos_phi);
  carom_sincos_degrees(carom_above(cue->theta, CAROM_LEAST_ELEVATION), &sin_theta, &cos_theta);

  /* squirt as a turn of v, by its sine and cosine */
  const double aside = -OVER_INERTIA * a * sqrt(inside);
  const double ahead = 1.0 + kind->mass / cue->end_mass + OVER_INERTIA * inside;
  const double size = sqrt(aside * aside + ahead * ahead);
  const double sin_squirt = aside / size, cos_squirt = ahead / size;

  /* 5 V/(2R), by which the offset makes spin */
  const double turn = OVER_INERTIA * speed / kind->radius;
  if (!(size < INFINITY && fabs(turn) < INFINITY))
    return CAROM_ERROR_OVERFLOW;

  /* v and w along the cloth by their parts along d and l, which phi turns to the table's axes */
  const double roll = turn * b, masse = turn * a * sin_theta;
  *out =
      (carom_motion){.v = {speed * (cos_squirt * cos_theta * cos_phi - sin_squirt * sin_phi),
                           speed * (cos_squirt * cos_theta * sin_phi + sin_squirt * cos_phi), 0.0},
                     .w = {-roll * sin_phi - masse * cos_phi, roll * cos_phi - masse * sin_phi,
                           -turn * a * cos_theta}};

  /* what becomes of the part that goes down: carom_strike_kind */
  if (how == CAROM_STRIKE_IN_SPACE && carom_is_raised(cue))
    out->v[2] = -speed * cos_squirt * sin_theta;
  if (how == CAROM_STRIKE_TURNED) {
    out->v[0] = speed * cos_theta * (cos_phi * cos_squirt - sin_phi * sin_squirt);
    out->v[1] = speed * cos_theta * (sin_phi * cos_squirt + cos_phi * sin_squirt);
  }
  return CAROM_OK;
}

carom_status carom_strike(const carom_cue *cue, const carom_ball_kind *kind, carom_motion *out) {
  if (cue == NULL || kind == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_status error = carom_check_cue(cue);
  if (error != CAROM_OK)
    return error;
  if (!carom_is_positive(kind->mass))
    return CAROM_ERROR_MASS;
  return carom_is_positive(kind->radius)
             ? carom_strike_motion(cue, kind, CAROM_STRIKE_ON_CLOTH, out)
             : CAROM_ERROR_RADIUS;
}
