/* The strike of a cue: an instantaneous impact of the tip, with squirt.
 *
 * With m the ball's mass, M the cue's, m_e the mass of its end, e the restitution of the tip,
 * (a, b) the offset in units of R and I = 2/5 m R^2:
 *
 *   V = (1 + e) V0 / (1 + m/M + 5/2 (a^2 + b^2))     speed along the cue
 *   v = V cos(theta) in the direction phi + alpha
 *   tan(alpha) = -(5/2) a sqrt(1 - a^2) / (1 + m/m_e + 5/2 (1 - a^2))
 *   w = 5 V/(2R) (b, a sin(theta), -a cos(theta))     turned about z by phi + 90 degrees
 *
 * In flat play the part of the blow that goes down into the table is lost. In space, with d the
 * horizontal direction of phi and l the horizontal to its left,
 *
 *   v = V (cos(alpha) (cos(theta) d - sin(theta) z) + sin(alpha) l)
 *
 * the blow alone, which drives the ball into the slate; shot/slate.c has the impact of the
 * ball on it. With theta = 0 both are the same, to the last bit. Sources: D. Alciatore, TP A-30
 * and TP A-31; pooltool's. */
#include "motion/strike.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "schema/numbers.h"

#include <math.h>
#include <stddef.h>

carom_status carom_check_cue(const carom_cue *cue) {
  const carom_cue *k = cue;
  CAROM_CUE_NUMBERS(CAROM_CHECK_ROW, CAROM_NO_ROW)
  const double limit = cue->miscue > 0.0 ? cue->miscue : 1.0;
  return cue->a * cue->a + cue->b * cue->b < limit * limit ? CAROM_OK : CAROM_ERROR_MISCUE;
}

double carom_speed_of_blow(const carom_cue *cue, const carom_ball_kind *kind) {
  const double a = cue->a, b = cue->b;
  return (1.0 + carom_tip_of(cue)) * cue->speed /
         (1.0 + kind->mass / cue->mass + 2.5 * (a * a + b * b));
}

carom_status carom_blow(const carom_cue *cue, const carom_ball_kind *kind, bool in_space,
                        carom_motion *out) {
  /* the directions of the cue, and the speed of the ball along it */
  const double a = cue->a, b = cue->b, inside = 1.0 - a * a, V = carom_speed_of_blow(cue, kind);
  double sin_phi, cos_phi, sin_theta, cos_theta;
  carom_sincos_degrees(cue->phi, &sin_phi, &cos_phi);
  carom_sincos_degrees(cue->theta, &sin_theta, &cos_theta);

  /* squirt as a turn of v, by its sine and cosine */
  const double aside = -2.5 * a * sqrt(inside),
               ahead = 1.0 + kind->mass / cue->end_mass + 2.5 * inside;
  const double size = sqrt(aside * aside + ahead * ahead), s = aside / size, c = ahead / size;

  const double turn = 2.5 * V / kind->radius;
  if (!(size < INFINITY && fabs(turn) < INFINITY))
    return CAROM_ERROR_OVERFLOW;

  /* flat: the vertical part of the blow is lost; in space the slate takes it */
  const double x = turn * b, y = turn * a * sin_theta;
  *out = (carom_motion){
      .v = {V * cos_theta * (cos_phi * c - sin_phi * s),
            V * cos_theta * (sin_phi * c + cos_phi * s), 0.0},
      .w = {-x * sin_phi - y * cos_phi, x * cos_phi - y * sin_phi, -turn * a * cos_theta}};
  if (in_space && sin_theta > 0.0) {
    out->v[0] = V * (c * cos_theta * cos_phi - s * sin_phi);
    out->v[1] = V * (c * cos_theta * sin_phi + s * cos_phi);
    out->v[2] = -V * c * sin_theta;
  }
  return CAROM_OK;
}

carom_status carom_strike(const carom_cue *cue, const carom_ball_kind *kind, carom_motion *out) {
  if (cue == NULL || kind == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_status bad = carom_check_cue(cue);
  if (bad != CAROM_OK)
    return bad;
  if (!carom_is_positive(kind->mass))
    return CAROM_ERROR_MASS;
  return carom_is_positive(kind->radius) ? carom_blow(cue, kind, false, out) : CAROM_ERROR_RADIUS;
}
