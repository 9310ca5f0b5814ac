/* The impact of a ball with something that does not move. With N the unit vector from the ball
 * into it, v_n = v . N > 0, and v' the speed of parting:
 *
 *   J = m (v_n + v')   u = v - v_n N + R w x N   J_t = min(mu J, 2/7 m |u|)   t = u/|u|
 *   v := v - (J N + J_t t) / m                   w := w - 5 J_t / (2 m R) N x t
 *
 *          .-'''-.
 *        .'   v   '.        v_n   along N, closing
 *       (    o-->   )       u     slip of the surface at the touch, across N
 *        '.  |N   .'        J     from the surface, against N
 *    ______'-V-.-'______    J_t   from its friction, against t = u/|u|
 *       <-- J_t   u -->
 *
 * The size of u falls by 7/2 J_t / m and its direction stays, so one branch is exact for
 * Coulomb's friction, with the restitution of Newton, Poisson or Stronge alike. The work is
 *
 *   dE = -m/2 (v_n^2 - v'^2) - J_t (|u| - 7 J_t / (4 m)) <= 0,   the bracket being at least
 *                                                                |u|/2.
 *
 * SLATE. N = -z. The contact at a point does not change w_z; the friction of turning on the spot
 * acts for the same normal impulse as in the motion on the cloth, so |w_z| falls by 5 mu_sp J /
 * (2 m R), not below 0. The top of a rail is taken for slate.
 *
 * END OF HOPS. v' = sqrt(e^2 v_n^2 - s^2), and 0 where e v_n <= s or v' < 1e-9 m/s, s = 0.02 m/s:
 * in addition to e a fixed loss of m s^2/2, a hop of 20 um. It is continuous in v_n, so no hop of
 * finite height vanishes. With v_k^2 = e^2 v_(k-1)^2 - s^2 a ball that falls at v_0 lands at most
 *
 *   n = 2 + ln(1 + v_0^2 (1 - e^2) / s^2) / ln(1 / e^2)
 *
 * times: for 8 m/s 9 times with e = 0.5, 217 times with 0.98, which is the most that a ball may
 * have. While a ball slips, hops do not change the mean friction: lying and hopping balls slow
 * equally. s is a convention; half of it, 10 mm/s, gives one hop more of 5 um
 * (core/tests/physics/air.c counts them). */
#include "cushion/contact.h"
#include "platform/ranges.h"
#include "platform/sphere.h"
#include "shot/sim.h"

#include <math.h>
#include <stdbool.h>

/* END OF HOPS, m/s: s; and the least speed of a hop, below which rounding decides */
static const double hop_loss = 0.02, least_hop = 1e-9;

/* The touch of a surface along N: closing speed, slip and its direction. */
carom_touch carom_touch_of(const double N[3], double radius, const carom_ball_state *state) {
  const double *velocity = state->v, *rotation = state->w, closing = carom_space_dot(velocity, N);

  /* u: the velocity across N, and the velocity of the turn */
  double turn[3], sliding[3];
  carom_cross(rotation, N, turn);
  for (int axis = 0; axis < 3; axis++)
    sliding[axis] = velocity[axis] - closing * N[axis] + radius * turn[axis];

  /* t: of any size where there is no slip, as friction is 0 then */
  const double slip = carom_space_size(sliding), size = slip > 0.0 ? slip : 1.0;
  return (carom_touch){
      {N[0], N[1], N[2]}, closing, slip, {sliding[0] / size, sliding[1] / size, sliding[2] / size}};
}

/* Impulses over the mass: J against N and J_t against t. */
void carom_take_impulse(const carom_touch *touch, double radius, double J, double J_t,
                        carom_ball_state *state) {
  const double *N = touch->N, *t = touch->t, turn = CAROM_SPHERE_TURN * J_t / radius;
  double across[3];
  carom_cross(N, t, across);
  for (int axis = 0; axis < 3; axis++) {
    state->v[axis] -= J * N[axis] + J_t * t[axis];
    state->w[axis] -= turn * across[axis];
  }
}

/* v', END OF HOPS. */
double carom_rebound(double v_n, double restitution) {
  const double square = restitution * restitution * v_n * v_n - hop_loss * hop_loss;
  return square > least_hop * least_hop ? sqrt(square) : 0.0;
}

/* The impulses J and J_t of the slate, after which the ball leaves it at the speed `up`. */
void carom_answer_of_slate(const carom_ball_kind *kind, const carom_touch *touch, double up,
                           double J_t, carom_ball_state *state) {
  const double J = touch->closing + up;
  carom_take_impulse(touch, kind->radius, J, J_t, state);
  state->v[2] = up; /* without the rounding of -v + (v + up) */

  /* the turn about the vertical falls, not below 0 */
  const double fall = CAROM_SPHERE_TURN * kind->mu_spin * J / kind->radius;
  state->w[2] = fabs(state->w[2]) <= fall ? 0.0 : state->w[2] - copysign(fall, state->w[2]);
}

/* The touch of the slate by a ball with v[2] <= 0. */
carom_touch carom_touch_slate(const carom_ball_kind *kind, const carom_ball_state *state) {
  static const double down[3] = {0.0, 0.0, -1.0};
  carom_touch touch = carom_touch_of(down, kind->radius, state);
  touch.closing = touch.closing > 0.0 ? touch.closing : 0.0;
  return touch;
}

/* A ball falls on the slate, and hops or stays. */
void carom_hit_slate(const carom_ball_kind *kind, carom_ball_state *state) {
  const double restitution = carom_slate_restitution(kind->restitution_table);
  const carom_touch touch = carom_touch_slate(kind, state);
  const double up = carom_rebound(touch.closing, restitution);
  carom_answer_of_slate(kind, &touch, up,
                        carom_coulomb(touch.slip, kind->mu_slide, touch.closing + up), state);
}
