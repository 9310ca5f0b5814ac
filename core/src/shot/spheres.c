/* The impact of two spheres along any line of centres, of any radii and masses.
 *
 * n is the unit vector from a to b, B = 1/m_a + 1/m_b, v_n = (v_a - v_b) . n > 0 the closing
 * speed, e the restitution:
 *
 *   u = v_a - v_b - v_n n + (R_a w_a + R_b w_b) x n                    the slip of a's surface on
 *                                                                      b's, across n
 *   J = (1 + e) v_n / B,   J_t = min(mu J, |u| / (7/2 B)),   t = u/|u|
 *   the impulses along n and against t
 *   v_a -= (J n + J_t t) / m_a           v_b += (J n + J_t t) / m_b
 *   w_a -= 5 J_t / (2 m_a R_a) n x t     w_b -= 5 J_t / (2 m_b R_b) n x t
 *
 * A solid sphere's inertia 2/5 m R^2 makes the radii drop out of the tangential mass: an impulse
 * J_t against t takes 7/2 B J_t from |u|, whatever the radii, and does not turn u. So one branch
 * is exact for Coulomb's friction. Momentum is kept, and
 *
 *   dE = -(1 - e^2) v_n^2 / (2 B) - J_t (|u| - 7/4 B J_t) <= 0,   the bracket being at least
 *                                                                 |u|/2.
 *
 * The cloth takes no part: a ball on it that is pressed down lands on it afterwards (slate.c),
 * as the balls part within 0.2 ms.
 */
#include "shot/sim.h"

#include <math.h>
#include <stdbool.h>

/* Closing speed and slip. */
static double relative_motion(const carom_impact *in, const double n[3], double u[3]) {
  double v[3], turn[3], W[3];
  for (int k = 0; k < 3; k++) {
    v[k] = in->a.v[k] - in->b.v[k];
    W[k] = in->a.radius * in->a.w[k] + in->b.radius * in->b.w[k];
  }
  const double v_n = carom_space_dot(v, n);
  carom_cross(W, n, turn);
  for (int k = 0; k < 3; k++)
    u[k] = v[k] - v_n * n[k] + turn[k];
  return v_n;
}

/* |u|, by the largest component first where a square would overflow or vanish. */
static double size_of(const double u[3]) {
  const double square = carom_space_dot(u, u);
  if (square > 1e-280 && square < 1e300)
    return sqrt(square);
  const double most = fmax(fmax(fabs(u[0]), fabs(u[1])), fabs(u[2]));
  if (!(most > 0.0 && most < INFINITY))
    return sqrt(square);
  const double unit[3] = {u[0] / most, u[1] / most, u[2] / most};
  return most * carom_space_size(unit);
}

double carom_spheres_slip(const carom_impact *in, const double n[3]) {
  double u[3];
  relative_motion(in, n, u);
  return size_of(u);
}

void carom_spheres_collide(const carom_impact *in, const double n[3], carom_result *out) {
  const carom_ball *a = &in->a, *b = &in->b;
  double u[3], turn[3];
  const double v_n = relative_motion(in, n, u), slip = size_of(u),
               B = 1.0 / a->mass + 1.0 / b->mass;
  const double J = (1.0 + in->restitution) * v_n / B, stops = slip / (3.5 * B),
               most = in->mu_ball * J;
  double J_t = most < stops ? most : stops;
  /* u becomes the direction t; where it is 0, J_t t stays u / (7/2 B), which has derivatives */
  if (slip > 0.0) {
    for (int k = 0; k < 3; k++)
      u[k] /= slip;
  } else if (most > 0.0) {
    J_t = 1.0 / (3.5 * B);
  }
  carom_cross(n, u, turn);
  for (int k = 0; k < 3; k++) {
    const double impulse = J * n[k] + J_t * u[k];
    out->a.v[k] = a->v[k] - impulse / a->mass;
    out->b.v[k] = b->v[k] + impulse / b->mass;
    out->a.w[k] = a->w[k] - 2.5 * J_t / (a->mass * a->radius) * turn[k];
    out->b.w[k] = b->w[k] - 2.5 * J_t / (b->mass * b->radius) * turn[k];
  }
}

/* ---- The public entry */

static carom_status check_ball(const carom_ball *ball) {
  if (!carom_is_finite(ball->r))
    return CAROM_ERROR_POSITION;
  if (!carom_is_finite(ball->v))
    return CAROM_ERROR_VELOCITY;
  if (!carom_is_finite(ball->w))
    return CAROM_ERROR_SPIN;
  if (!(ball->radius > 0.0 && ball->radius < INFINITY))
    return CAROM_ERROR_RADIUS;
  return ball->mass > 0.0 && ball->mass < INFINITY ? CAROM_OK : CAROM_ERROR_MASS;
}

/* The unit vector from a to b, of any distance but 0. */
static carom_status direction(const carom_impact *in, double n[3]) {
  double size = 0.0;
  for (int k = 0; k < 3; k++) {
    n[k] = in->b.r[k] - in->a.r[k];
    size = fmax(size, fabs(n[k]));
  }
  if (!(size > 0.0))
    return CAROM_ERROR_COINCIDENT;
  if (!(size < INFINITY))
    return CAROM_ERROR_OVERFLOW;
  /* by the largest first, so that no square overflows or vanishes */
  for (int k = 0; k < 3; k++)
    n[k] /= size;
  size = carom_space_size(n);
  for (int k = 0; k < 3; k++)
    n[k] /= size;
  return CAROM_OK;
}

/* Whether no impulse overflows or vanishes: closing speed v_n, slip, impulse along n. */
static bool in_range(const carom_impact *in, double v_n, double slip) {
  const double least = 1e-290, most = 1e300, B = 1.0 / in->a.mass + 1.0 / in->b.mass, J = v_n / B;
  return v_n < most && slip < most && B < most && J < most && J > least && slip / B < most;
}

static carom_status solve(const carom_impact *in, carom_result *out) {
  double n[3], u[3];
  carom_status status = check_ball(&in->a);
  status = status == CAROM_OK ? check_ball(&in->b) : status;
  if (status == CAROM_OK && !(in->mu_ball >= 0.0 && in->mu_ball <= 1.0))
    status = CAROM_ERROR_MU_BALL;
  if (status == CAROM_OK && !(in->restitution >= 0.0 && in->restitution <= 1.0))
    status = CAROM_ERROR_RESTITUTION;
  status = status == CAROM_OK ? direction(in, n) : status;
  if (status != CAROM_OK)
    return status;
  const double v_n = relative_motion(in, n, u);
  if (v_n <= 0.0) {
    for (int k = 0; k < 3; k++) {
      out->a.v[k] = in->a.v[k];
      out->a.w[k] = in->a.w[k];
      out->b.v[k] = in->b.v[k];
      out->b.w[k] = in->b.w[k];
    }
    return CAROM_SEPARATING;
  }
  if (!in_range(in, v_n, size_of(u)))
    return CAROM_ERROR_OVERFLOW;
  carom_spheres_collide(in, n, out);
  const bool good = carom_is_finite(out->a.v) && carom_is_finite(out->a.w) &&
                    carom_is_finite(out->b.v) && carom_is_finite(out->b.w);
  return good ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

carom_status carom_impact3(const carom_impact *in, carom_result *out) {
  if (in == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = solve(in, out);
  if (status < 0)
    *out = (carom_result){{{NAN, NAN, NAN}, {NAN, NAN, NAN}}, {{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
  return status;
}
