/* Coulomb's law at the nose and at the cloth, in the limit of small impulses.
 *
 * With the prime for the derivative by p = P / M, frictions f at the nose and F at the cloth (per unit of p, on the ball), the
 * slips of contact.h obey
 *
 *     s_x' = 7/2 f_x + k_x F_x                     c_x' = k_x f_x + 7/2 F_x
 *     s_t' = sin cos + k_t f_t + k_y F_y           c_y' = -cos + k_y f_t + 7/2 F_y
 *     k_x = 1 - 5/2 sin      k_t = 5/2 + sin^2      k_y = 5/2 - sin           (sine and cosine of theta)
 *
 * and the vertical balance says what the cloth bears, which is never negative:   g = max(0, sin - f_t cos).
 *
 * SLIPPING, friction is opposite to the slip: f = -mu_w s/|s|, F = -mu_s g c/|c|.
 *
 * STICKING, it is what keeps the slip at zero. At the nose alone, with the cloth slipping in the direction (t_x, t_y), that
 * gives
 *
 *     f_t = sin (b - cos) / (k_t + b cos),  b = k_y mu_s t_y          g = 7/2 sin / (k_t + b cos)          f_x = -2/7 k_x F_x
 *
 * so the cloth is loaded if and only if the nose is above the centre. At the cloth alone
 *
 *     F_x = -2/7 k_x f_x          F_y = 2/7 (cos - k_y f_t)
 *
 * and at both the four equations for zero rates have the solution
 *
 *     f_x = F_x = 0          F_y = -f_t = cos / (1 + sin)          g = 1
 *
 * Both slips are zero only if v_y = (c_y - s_t) / (1 + sin) is: the ball is wedged between cushion and cloth for good.
 *
 * WHICH. A contact whose slip is zero sticks if the friction that holds it is inside the cone, |f| < mu_w or |F| < mu_s g. If
 * not it begins to slip, in the direction u that its own rate then has: s'(u) parallel to u.
 *
 * SLOW SLIPS. Where friction leaves the cone the slip begins with rate zero, and its direction follows the quasi-steady one at
 * a distance of the order of its size: (r u)' = s'(u) means s'(u) - r u' parallel to u. As a differential equation that is
 * stiff, so up to a small r the direction is computed from this condition, with u' from its solution for r = 0. The error is of
 * order r^3.
 *
 * Source: the model is that of the 2010 paper named in carom_shot.h; sticking is derived in docs/cushion.md. */
#include "cushion/coulomb.h"

#include <math.h>

static const double CONVERGED = 1e-15;
static const double NEWTON_CONVERGED = 3e-8; /* where the derivative is known */
static const double BACKWARDS = 1e-6;        /* rate along a direction found that MARGIN may cause */
static const double MARGIN = 1e-7;           /* inside the cone, as a share of it, that friction must be to begin to hold */
enum { MOST_ITERATIONS = 60 };

static double length(carom_vector a) {
  return sqrt(a.x * a.x + a.y * a.y);
}

static carom_vector direction(carom_vector slip, carom_vector otherwise) {
  const double size = length(slip);
  return size > 0 ? (carom_vector){slip.x / size, slip.y / size} : otherwise;
}

carom_friction carom_friction_of(const carom_coulomb *law, const carom_regime *regime, const carom_slips *slips) {
  carom_friction r = {.g = 1};
  if (regime->nose_sticks && regime->cloth_sticks) {
    r.F.y = law->cosine / (1 + law->sine);
    r.f.y = -r.F.y;
    return r;
  }
  if (regime->nose_sticks) {
    const carom_vector t = direction(slips->c, regime->cloth);
    const double b = regime->loaded ? law->k_y * law->mu_s * t.y : 0, by = 1 / (law->k_t + b * law->cosine);
    r.g = regime->loaded ? 3.5 * law->sine * by : 0;
    r.F = (carom_vector){-law->mu_s * r.g * t.x, -law->mu_s * r.g * t.y};
    r.f = (carom_vector){-2.0 / 7.0 * law->k_x * r.F.x, law->sine * (b - law->cosine) * by};
    return r;
  }
  const carom_vector u = direction(slips->s, regime->nose);
  r.f = (carom_vector){-law->mu_w * u.x, -law->mu_w * u.y};
  r.g = law->sine - law->cosine * r.f.y;
  if (regime->cloth_sticks)
    r.F = (carom_vector){-2.0 / 7.0 * law->k_x * r.f.x, 2.0 / 7.0 * (law->cosine - law->k_y * r.f.y)};
  else if (regime->loaded) {
    const carom_vector t = direction(slips->c, regime->cloth);
    r.F = (carom_vector){-law->mu_s * r.g * t.x, -law->mu_s * r.g * t.y};
  }
  return r;
}

carom_slips carom_slip_rates(const carom_coulomb *law, const carom_friction *r) {
  return (carom_slips){.s = {3.5 * r->f.x + law->k_x * r->F.x, law->sine * law->cosine + law->k_t * r->f.y + law->k_y * r->F.y},
                       .c = {law->k_x * r->f.x + 3.5 * r->F.x, law->k_y * r->f.y + 3.5 * r->F.y - law->cosine}};
}

/* Whether the cloth bears anything. */
static bool is_loaded(const carom_coulomb *law, const carom_regime *regime, const carom_slips *slips) {
  if (regime->nose_sticks)
    return law->sine > 0;
  return law->sine + law->cosine * law->mu_w * direction(slips->s, regime->nose).y > 0;
}

/* The search for a direction u to which a rate is parallel. Turning u by a small angle lowers the rate across u by the angle
 * times the rate along u, and by what friction does: `slope`, guessed at first and then taken from the last step. */
typedef struct search {
  carom_vector *u;
  double slope, across, along, angle;
} search;

/* One step of Newton's method; how far it went. The rate along u should be positive, unless the slip falls. */
static double turn(search *s, carom_vector rate, bool falls) {
  const double across = rate.y * s->u->x - rate.x * s->u->y, along = rate.x * s->u->x + rate.y * s->u->y;
  const double slope = s->angle != 0 ? (s->across - across) / s->angle - s->along : 0;
  if (slope > 0.2 * s->slope && slope < 5 * s->slope)
    s->slope = slope;
  const double angle = across / fmax(s->slope + (falls ? along : fmax(along, 0)), 0.02 * s->slope);
  s->across = across;
  s->along = along;
  const bool far = (along < 0 && !falls) || fabs(angle) > 0.5;
  s->angle = far ? 0 : angle;
  /* far from the direction sought, the rate without the friction along u is the better guess */
  const carom_vector to = far ? (carom_vector){rate.x + 2 * s->slope * s->u->x, rate.y + 2 * s->slope * s->u->y}
                              : (carom_vector){s->u->x - angle * s->u->y, s->u->y + angle * s->u->x};
  const double size = length(to);
  if (!(size > 0))
    return 0;
  const carom_vector next = {to.x / size, to.y / size};
  const double way = fabs(next.x - s->u->x) + fabs(next.y - s->u->y);
  *s->u = next;
  return way;
}

/* Finds the directions in which contacts begin to slip, and the load. False if the iteration finds none. */
static bool begin(const carom_coulomb *law, const carom_slips *slips, bool nose, bool cloth, carom_regime *regime) {
  /* begin with what would happen without friction */
  const carom_friction none = {.g = 0};
  const carom_slips free = carom_slip_rates(law, &none);
  regime->nose = direction(free.s, (carom_vector){0, 1});
  regime->cloth = direction(free.c, (carom_vector){0, -1});
  search s = {.u = &regime->nose, .slope = 3 * law->mu_w}, c = {.u = &regime->cloth};
  double way = INFINITY;
  for (int k = 0; k < MOST_ITERATIONS && way > CONVERGED; k++) {
    regime->loaded = regime->cloth_sticks || is_loaded(law, regime, slips);
    const carom_friction friction = carom_friction_of(law, regime, slips);
    const carom_slips rates = carom_slip_rates(law, &friction);
    way = 0;
    if (nose)
      way = fmax(way, turn(&s, rates.s, false));
    if (cloth && regime->loaded) {
      c.slope = 3.5 * law->mu_s * friction.g;
      c.angle = 0;
      way = fmax(way, turn(&c, rates.c, false));
    }
  }
  return way < 1e-9 && !(nose && s.along < -BACKWARDS) && !(cloth && regime->loaded && c.along < -BACKWARDS);
}

/* What friction does to the rate across u at the nose if u turns, with the sign of `search`: the change of u is across u, that
 * of f is -mu_w times that, and F follows. */
static double slope_at_nose(const carom_coulomb *law, const carom_regime *regime, const carom_friction *now) {
  const carom_vector n = {-regime->nose.y, regime->nose.x};
  carom_friction change = {.f = {-law->mu_w * n.x, -law->mu_w * n.y}};
  if (regime->cloth_sticks)
    change.F = (carom_vector){-2.0 / 7.0 * law->k_x * change.f.x, -2.0 / 7.0 * law->k_y * change.f.y};
  else if (now->g != 0) {
    const double share = -law->cosine * change.f.y / now->g;
    change.F = (carom_vector){share * now->F.x, share * now->F.y};
  }
  return -(n.x * (3.5 * change.f.x + law->k_x * change.F.x) + n.y * (law->k_t * change.f.y + law->k_y * change.F.y));
}

bool carom_slow_direction(const carom_coulomb *law, const carom_slips *slips, bool at_cloth, bool falls, double slip,
                          carom_vector turning, carom_regime *regime) {
  if (at_cloth && !regime->nose_sticks) {
    /* friction at the cloth has no part in that at the nose and acts along u: u is the direction of the rest */
    const carom_vector at = direction(slips->s, regime->nose);
    const double x = -law->k_x * law->mu_w * at.x - slip * turning.x,
                 y = -law->k_y * law->mu_w * at.y - law->cosine - slip * turning.y;
    regime->cloth = direction((carom_vector){x, y}, regime->cloth);
    return true;
  }
  search s = {.u = at_cloth ? &regime->cloth : &regime->nose, .slope = 3 * law->mu_w};
  /* with the derivative itself what is left is the square of the last step */
  const double converged = at_cloth ? CONVERGED : NEWTON_CONVERGED;
  double way = INFINITY;
  for (int k = 0; k < MOST_ITERATIONS && way > converged; k++) {
    const carom_friction friction = carom_friction_of(law, regime, slips);
    const carom_slips rates = carom_slip_rates(law, &friction);
    const carom_vector rate = at_cloth ? rates.c : rates.s;
    if (at_cloth)
      s.slope = 3.5 * law->mu_s * friction.g;
    else {
      s.slope = slope_at_nose(law, regime, &friction);
      s.angle = 0;
    }
    way = turn(&s, (carom_vector){rate.x - slip * turning.x, rate.y - slip * turning.y}, falls);
  }
  return way <= fmax(converged, 1e-9);
}

bool carom_decide(const carom_coulomb *law, carom_slips *slips, double rest, carom_regime *regime) {
  const bool nose_rests = law->mu_w > 0 && length(slips->s) <= rest;
  const bool cloth_rests = law->mu_s > 0 && length(slips->c) <= rest;
  if (nose_rests)
    slips->s = (carom_vector){0, 0};
  if (cloth_rests)
    slips->c = (carom_vector){0, 0};
  /* of what is possible, that which sticks most: 3 both, 2 the nose, 1 the cloth, 0 none */
  for (int choice = 3; choice >= 0; choice--) {
    const bool nose = (choice & 2) != 0, cloth = (choice & 1) != 0;
    if ((nose && !nose_rests) || (cloth && !cloth_rests))
      continue;
    carom_regime r = {.nose_sticks = nose, .cloth_sticks = cloth};
    if (!begin(law, slips, nose_rests && !nose, cloth_rests && !cloth, &r))
      continue;
    const carom_friction friction = carom_friction_of(law, &r, slips);
    if ((nose && !(length(friction.f) < (1 - MARGIN) * law->mu_w)) ||
        (cloth && !(friction.g > 0 && length(friction.F) < (1 - MARGIN) * law->mu_s * friction.g)))
      continue;
    *regime = r;
    return true;
  }
  return false;
}
