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
#include "platform/sphere.h"
#include "shot/sim.h"

#include <math.h>
#include <stdbool.h>

/* Closing speed and slip. */
static double relative_motion(const carom_impact *in, const double normal[3], double slip[3]) {
  double relative[3], turn[3], spin[3];
  for (int axis = 0; axis < 3; axis++) {
    relative[axis] = in->a.v[axis] - in->b.v[axis];
    spin[axis] = in->a.radius * in->a.w[axis] + in->b.radius * in->b.w[axis];
  }
  const double v_n = carom_space_dot(relative, normal);
  carom_cross(spin, normal, turn);
  for (int axis = 0; axis < 3; axis++)
    slip[axis] = relative[axis] - v_n * normal[axis] + turn[axis];
  return v_n;
}

#define LEAST_SQUARE 1e-280 /* squares between these neither vanish nor overflow */
#define MOST_SQUARE 1e300

/* The size of a vector, by the largest component first where a square would overflow or vanish. */
static double size_of(const double vector[3]) {
  const double square = carom_space_dot(vector, vector);
  if (square > LEAST_SQUARE && square < MOST_SQUARE)
    return sqrt(square);
  const double most = fmax(fmax(fabs(vector[0]), fabs(vector[1])), fabs(vector[2]));
  if (!(most > 0.0 && most < INFINITY))
    return sqrt(square);
  const double unit[3] = {vector[0] / most, vector[1] / most, vector[2] / most};
  return most * carom_space_size(unit);
}

double carom_spheres_slip(const carom_impact *in, const double normal[3]) {
  double slip[3];
  relative_motion(in, normal, slip);
  return size_of(slip);
}

void carom_spheres_collide(const carom_impact *in, const double normal[3], carom_result *out) {
  const carom_ball *a = &in->a, *b = &in->b;
  double across[3], turn[3];
  const double v_n = relative_motion(in, normal, across), slip = size_of(across),
               B = 1.0 / a->mass + 1.0 / b->mass;
  const double J = (1.0 + in->restitution) * v_n / B, stops = slip / (CAROM_SPHERE_SLIP * B),
               most = in->mu_ball * J;
  double J_t = most < stops ? most : stops;
  /* u, across n, becomes the direction t; where it is 0, J_t t stays u / (7/2 B), which has
   * derivatives */
  if (slip > 0.0) {
    for (int axis = 0; axis < 3; axis++)
      across[axis] /= slip;
  } else if (most > 0.0) {
    J_t = 1.0 / (CAROM_SPHERE_SLIP * B);
  }
  carom_cross(normal, across, turn);
  for (int axis = 0; axis < 3; axis++) {
    const double impulse = J * normal[axis] + J_t * across[axis];
    out->a.v[axis] = a->v[axis] - impulse / a->mass;
    out->b.v[axis] = b->v[axis] + impulse / b->mass;
    out->a.w[axis] = a->w[axis] - CAROM_SPHERE_TURN * J_t / (a->mass * a->radius) * turn[axis];
    out->b.w[axis] = b->w[axis] - CAROM_SPHERE_TURN * J_t / (b->mass * b->radius) * turn[axis];
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
static carom_status direction(const carom_impact *in, double normal[3]) {
  double size = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    normal[axis] = in->b.r[axis] - in->a.r[axis];
    size = fmax(size, fabs(normal[axis]));
  }
  if (!(size > 0.0))
    return CAROM_ERROR_COINCIDENT;
  if (!(size < INFINITY))
    return CAROM_ERROR_OVERFLOW;
  /* by the largest first, so that no square overflows or vanishes */
  for (int axis = 0; axis < 3; axis++)
    normal[axis] /= size;
  size = carom_space_size(normal);
  for (int axis = 0; axis < 3; axis++)
    normal[axis] /= size;
  return CAROM_OK;
}

/* Whether no impulse overflows or vanishes: closing speed v_n, slip, impulse along n. */
static bool in_range(const carom_impact *in, double v_n, double slip) {
  const double least = 1e-290, most = 1e300, B = 1.0 / in->a.mass + 1.0 / in->b.mass, J = v_n / B;
  return v_n < most && slip < most && B < most && J < most && J > least && slip / B < most;
}

static carom_status solve(const carom_impact *in, carom_result *out) {
  double normal[3], slip[3];
  carom_status status = check_ball(&in->a);
  status = status == CAROM_OK ? check_ball(&in->b) : status;
  if (status == CAROM_OK && !(in->mu_ball >= 0.0 && in->mu_ball <= 1.0))
    status = CAROM_ERROR_MU_BALL;
  if (status == CAROM_OK && !(in->restitution >= 0.0 && in->restitution <= 1.0))
    status = CAROM_ERROR_RESTITUTION;
  status = status == CAROM_OK ? direction(in, normal) : status;
  if (status != CAROM_OK)
    return status;
  const double v_n = relative_motion(in, normal, slip);
  if (v_n <= 0.0) {
    for (int axis = 0; axis < 3; axis++) {
      out->a.v[axis] = in->a.v[axis];
      out->a.w[axis] = in->a.w[axis];
      out->b.v[axis] = in->b.v[axis];
      out->b.w[axis] = in->b.w[axis];
    }
    return CAROM_SEPARATING;
  }
  if (!in_range(in, v_n, size_of(slip)))
    return CAROM_ERROR_OVERFLOW;
  carom_spheres_collide(in, normal, out);
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
