/* The impact of a ball with something that does not move. With N the unit vector from the ball
 * into it, v_n = v . N > 0, and v' the speed of parting:
 *
 *   J = m (v_n + v')   u = v - v_n N + R w x N   J_t = min(mu J, 2/7 m |u|)   t = u/|u|
 *   v := v - (J N + J_t t) / m                   w := w - 5 J_t / (2 m R) N x t
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
 * END OF HOPS. v' = sqrt(e^2 v_n^2 - s^2), and 0 where e v_n <= s or v' < 1e-9 m/s, s = 0.02
 * m/s: besides e a fixed loss of m s^2/2, a hop of 20 um. It is continuous in v_n, so no hop of
 * finite height vanishes. With v_k^2 = e^2 v_(k-1)^2 - s^2 a ball that falls at v_0 lands at
 * most
 *
 *   n = 2 + ln(1 + v_0^2 (1 - e^2) / s^2) / ln(1 / e^2)
 *
 * times: for 8 m/s 9 times with e = 0.5, 217 times with 0.98, which is the most that a ball may
 * have. While a ball slips, hops do not change the mean friction: lying and hopping balls slow
 * equally. s is a convention; half of it, 10 mm/s, gives one hop more of 5 um
 * (tests/physics/air.c counts them).
 *
 * STRIKE. A raised cue presses the ball on the slate for the time T of the tip, within which the
 * slate answers several times. The blow alone would give the ball a speed v_n into the slate and
 * a slip u of its surface there; it comes as a half-sine pulse, of which the part Phi has come at
 * the time t. d is the overlap of ball and slate, F/m = k d^1.5 Hertz's force with the
 * restitution e of the slate (cluster/hertz.h). The cloth takes a slip s as it comes:
 *
 *   d'' = v_n Phi' - F/m             Phi = (1 - cos(pi t / T)) / 2
 *   s'  = |u| Phi' - 7/2 mu F/m      s >= 0
 *
 * The direction of u never changes: the pulse gives it, and friction is against it. So the impact
 * is that above, with the J and the J_t of this integral, and the direction in which the ball
 * rolls at last is that of the blow alone, as Coriolis found: J_t does not change the angular
 * momentum about the point that touches the slate. Leapfrog in STEPS steps of the pulse;
 * positions stay, and weight has no part. What the contact does afterwards has a closed form, by
 * its energy.
 *
 * Only T over the duration of the slate's contact counts: with e = 0.5, v' is 0.46 v_n where that
 * ratio is 0.75, and 0.13 v_n where it is 2 (physics/air). The contact of ball, cloth and slate
 * lasts 0.8 ms at 1 m/s and changes as v_n^-0.2: a convention, as no measurement was found.
 * Hertz's law of a ball on bare slate gives 0.36 ms. e below 0.2 is computed as 0.2, and v'
 * multiplied by e/0.2.
 *
 * 256 steps leave v' within 2e-4 of v_n, 128 within 4e-4 but for one case in a thousand, which has
 * 4e-2; the order is 2. v' has jumps where a contact that has nearly ended is loaded again, since
 * one that has ended takes energy once more (physics/air looks for them). */
#include "cluster/hertz.h"
#include "cushion/contact.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "shot/together.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double hop_loss = 0.02, least_hop = 1e-9; /* m/s: s, and the least speed of a hop */

enum { STEPS = 256 };                    /* of a pulse */
static const double contact_at_1 = 8e-4; /* s: of ball and slate at 1 m/s */
static const double least_e = 0.2;

carom_touch carom_touch_of(const double N[3], double R, const carom_ball_state *s) {
  const double *v = s->v, *w = s->w;
  carom_touch touch = {.N = {N[0], N[1], N[2]}, .closing = v[0] * N[0] + v[1] * N[1] + v[2] * N[2]};
  const double turn[3] = {w[1] * N[2] - w[2] * N[1], w[2] * N[0] - w[0] * N[2],
                          w[0] * N[1] - w[1] * N[0]};
  double u[3], square = 0.0;
  for (int k = 0; k < 3; k++) {
    u[k] = v[k] - touch.closing * N[k] + R * turn[k];
    square += u[k] * u[k];
  }
  touch.slip = sqrt(square);
  for (int k = 0; k < 3 && touch.slip > 0.0; k++)
    touch.t[k] = u[k] / touch.slip;
  return touch;
}

void carom_take_impulse(const carom_touch *touch, double R, double J, double J_t,
                        carom_ball_state *s) {
  const double *N = touch->N, *t = touch->t;
  const double turn[3] = {N[1] * t[2] - N[2] * t[1], N[2] * t[0] - N[0] * t[2],
                          N[0] * t[1] - N[1] * t[0]};
  for (int k = 0; k < 3; k++) {
    s->v[k] -= J * N[k] + J_t * t[k];
    s->w[k] -= 2.5 * J_t / R * turn[k];
  }
}

double carom_rebound(double v_n, double e) {
  const double square = e * e * v_n * v_n - hop_loss * hop_loss;
  return square > least_hop * least_hop ? sqrt(square) : 0.0;
}

/* The impulses J and J_t of the slate, after which the ball leaves it at the speed `up`. */
static void answer(const carom_ball_kind *kind, const carom_touch *touch, double up, double J_t,
                   carom_ball_state *s) {
  const double J = touch->closing + up;
  carom_take_impulse(touch, kind->radius, J, J_t, s);
  s->v[2] = up; /* without the rounding of -v + (v + up) */
  const double fall = 2.5 * kind->mu_spin * J / kind->radius;
  s->w[2] = fabs(s->w[2]) <= fall ? 0.0 : s->w[2] - copysign(fall, s->w[2]);
}

/* The touch of the slate by a ball with v[2] <= 0. */
static carom_touch touch_slate(const carom_ball_kind *kind, const carom_ball_state *s) {
  static const double down[3] = {0.0, 0.0, -1.0};
  carom_touch touch = carom_touch_of(down, kind->radius, s);
  touch.closing = touch.closing > 0.0 ? touch.closing : 0.0;
  return touch;
}

void carom_hit_slate(const carom_ball_kind *kind, carom_ball_state *s) {
  const double e = carom_slate_restitution(kind->restitution_table);
  const carom_touch touch = touch_slate(kind, s);
  const double up = carom_rebound(touch.closing, e);
  answer(kind, &touch, up, carom_coulomb(touch.slip, kind->mu_slide, touch.closing + up), s);
}

/* The contact of ball and slate; forces and impulses over the mass. */
typedef struct press {
  double k, e, d, d_max;
  double v;        /* down, m/s */
  double slip;     /* s */
  double friction; /* 7/2 mu */
} press;

/* A step of h, in which the blow gives a speed down and a slip. */
static void press_step(press *p, double h, double down, double slip) {
  /* the force at half a step */
  const double middle = p->d + 0.5 * h * p->v, v0 = p->v;
  const double J = middle > 0.0 ? h * carom_hertz_force(p->k, p->e, middle, &p->d_max) : 0.0;
  p->v += down - J;
  p->slip = carom_greater(p->slip + slip - p->friction * J, 0.0);
  p->d = middle + 0.5 * h * p->v;

  /* where the force has reached 0 the rest of the overlap is forgotten */
  if (p->d_max > 0.0) {
    p->d_max = carom_hertz_vertex(middle, p->d_max, h, v0, p->v);
    const double rest = (1.0 - p->e * p->e) * p->d_max;
    if (p->d <= rest) {
      p->d -= rest;
      p->d_max = 0.0;
    }
  }
}

/* The speed at which the ball leaves the slate, with no blow any more. */
static double press_parts(const press *p) {
  const double k = 0.4 * p->k, e2 = p->e * p->e, kinetic = 0.5 * p->v * p->v;
  if (p->d <= 0.0)
    return p->v > 0.0 ? p->e * p->v : -p->v;
  if (p->d >= p->d_max) /* loading */
    return p->e * sqrt(2.0 * (kinetic + k * p->d * p->d * sqrt(p->d)));
  const double y = carom_greater(p->d - (1.0 - e2) * p->d_max, 0.0);
  const double energy = kinetic + k / (p->e * e2) * y * y * sqrt(y),
               work = k * p->d_max * p->d_max * sqrt(p->d_max);
  /* loading again takes only the energy above that given back so far */
  const bool again = p->v > 0.0 && energy > e2 * work;
  return again ? p->e * sqrt(2.0 * (work + energy - e2 * work)) : sqrt(2.0 * energy);
}

double carom_tip_time(const carom_cue *cue) {
  return cue->tip_time > 0.0 ? cue->tip_time : CAROM_TIP_TIME;
}

carom_cluster_slate carom_slate_under(const carom_ball_kind *kind) {
  const double size = contact_at_1 / CAROM_HERTZ_DURATION;
  carom_cluster_slate slate;
  memset(&slate, 0, sizeof slate);
  slate.k = 1.25 / (size * size * sqrt(size));
  slate.e = carom_greater(carom_slate_restitution(kind->restitution_table), least_e);
  return slate;
}

void carom_leave_slate(const carom_ball_kind *kind, double J, carom_ball_state *s) {
  const double fall = 2.5 * kind->mu_spin * J / kind->radius;
  s->w[2] = fabs(s->w[2]) <= fall ? 0.0 : s->w[2] - copysign(fall, s->w[2]);
  s->v[2] = s->v[2] > 0.0 ? carom_rebound(s->v[2], 1.0) : s->v[2];
}

double carom_press_on_slate(const carom_ball_kind *kind, double tip_time, carom_ball_state *s) {
  const double pi = 3.14159265358979324, size = contact_at_1 / CAROM_HERTZ_DURATION;
  const double e = carom_slate_restitution(kind->restitution_table),
               T = tip_time > 0.0 ? tip_time : CAROM_TIP_TIME;
  const carom_touch touch = touch_slate(kind, s);
  press p = {.k = 1.25 / (size * size * sqrt(size)),
             .e = carom_greater(e, least_e),
             .friction = 3.5 * kind->mu_slide};

  /* Phi grows by sin(pi/(2 STEPS)) sin(pi (n + 1/2)/STEPS) in step n; the sine is turned from
   * step to step */
  double sine, cosine, turn_s, turn_c;
  carom_sincos(0.5 * pi / (double)STEPS, &sine, &cosine);
  carom_sincos(pi / (double)STEPS, &turn_s, &turn_c);
  const double first = sine;
  for (int n = 0; n < STEPS; n++) {
    const double part = first * sine;
    press_step(&p, T / (double)STEPS, touch.closing * part, touch.slip * part);
    const double next = sine * turn_c + cosine * turn_s;
    cosine = cosine * turn_c - sine * turn_s;
    sine = next;
  }

  /* the rest of the contact, and the end of hops */
  const double parts = press_parts(&p);
  const double slip = carom_greater(p.slip - p.friction * (parts + p.v), 0.0);
  const double leaves = parts * (e / p.e), up = carom_rebound(leaves, 1.0);
  answer(kind, &touch, up,
         carom_lesser(2.0 / 7.0 * (touch.slip - slip), kind->mu_slide * (touch.closing + up)), s);
  return leaves;
}
