/* The maps from X in [0, 1] to p over which steps collocate, and the directions that steps begin
 * to iterate with.
 *
 * EVEN. p = length X.
 *
 * SINH. The direction of b changes fast where b passes near zero. Let b go along a straight
 * line, nearest to zero at p_c, at the distance d (in units of p). Then p = p_c + d sinh x makes
 * the direction of b smooth in x.
 *
 * STRETCHED. Let t be constant and friction isotropic, so that a' = D - m u with a constant
 * vector D of size D, and let
 * dp = r dtau, r = |a|. With psi the angle from D to u,
 *
 *     psi' = -D sin psi        r' = (D cos psi - m) r        so        tan(psi/2) = q_0 e^(-D tau)
 *     r = A e^((D - m) tau) + B e^(-(D + m) tau),     A = r_0 / (1 + q_0^2),     B = r_0 - A
 *
 * D, psi_0 and m follow from a' and its derivative by the direction of u at the beginning of the
 * step. A slip that passes near zero is smooth in tau, and one that goes to zero decays
 * exponentially. e^(-m tau) is the E of step.h. */
#ifndef CAROM_SRC_CONTACT_LAW_MAP_H
#define CAROM_SRC_CONTACT_LAW_MAP_H

#include "contact_law/step.h"

/* Found by trial with `carom-lab stress --cushion 20000`. With an ellipse of 2.2 errors in play
 * reach 7.3e-7 instead of 1.1e-7, and with one of 6 impacts of any kind take 5 % longer. With
 * twice of SINH_LENGTH they take 13 % longer. */
static const double ELLIPSE = 3; /* b passes near zero if its complex zero lies within this
                                    ellipse: see nearest() */
/* least d, as a share of the distance to p_c */
static const double LEAST_D = 1e-3, LEAST_D_UNSTABLE = 1e-14;
static const double SINH_LENGTH = 3; /* length of a step in x */

/* The state in which a step begins. */
typedef struct step_start {
  double r, q;                          /* |a|, |b| */
  double u_x, u_y, t_x, t_y;            /* their directions */
  double w, da_x, da_y, db_x, db_y, dv; /* w, a', b', v' */
  double line_x, line_y;                /* b' without half of the cloth's own friction: its mean
                                           where b passes zero */
  double to_goal;                       /* p to the goal, */
  enum goal goal;                       /* which is the end of the phase, or closer */
  double target;
} step_start;

static void even_map(step *s, double length) {
  EACH {
    s->z[i] = splat(length);
    s->p[i] = length * PART(NODE, i);
    s->E[i] = splat(1);
  }
  s->length = length;
}

/* Where a straight line is nearest to zero. */
typedef struct passage {
  double p_c, d;
  bool matters; /* a step of the length asked for has to take account of it */
} passage;

static passage nearest(const carom_point *point, double rate_x, double rate_y, double length) {
  const double per = 1 / (rate_x * rate_x + rate_y * rate_y);
  passage g = {.p_c = -(point->b_x * rate_x + point->b_y * rate_y) * per,
               .d = fabs(point->b_x * rate_y - point->b_y * rate_x) * per};
  /* b is zero at p_c +- i d: in units of the step, from -1 to 1, the sum of the distances to the
   * ends tells the ellipse */
  const double x = 2 * g.p_c / length - 1, y = 2 * g.d / length;
  g.matters = sqrt((x - 1) * (x - 1) + y * y) + sqrt((x + 1) * (x + 1) + y * y) < ELLIPSE;
  return g;
}

/* How b passes zero. It goes at its present rate, or if that does not lead near zero, at the
 * mean rate beyond. */
static passage passage_of_b(const carom_point *point, const carom_terms *k, const step_start *s,
                            double length) {
  const double rate =
      fabs(s->db_x) + fabs(s->db_y) + (k->H_x < 0 ? fabs(s->line_x) + fabs(s->line_y) : 0);
  passage g = {.matters = false};
  if (s->q == 0 || s->q > 2 * length * rate)
    return g;
  /* friction that drives the slip slows b on its way to zero: then the mean rate comes first */
  if (k->H_x > 0)
    g = nearest(point, s->db_x, s->db_y, length);
  if (!g.matters)
    g = nearest(point, s->line_x, s->line_y, length);
  if (!g.matters && k->H_x < 0)
    g = nearest(point, s->db_x, s->db_y, length);
  /* a slip that friction drives stays near zero for long: there the map has to resolve more */
  const double least = (k->H_x > 0 ? LEAST_D : LEAST_D_UNSTABLE) * s->q / rate;
  g.d = g.d > least ? g.d : least;
  return g;
}

/* log(x) to 0.06, for x > 0: the exponent, and linear in between. */
static double rough_log(double x) {
  union {
    double value;
    int64_t bits;
  } u = {.value = x};
  return 0.6931471805599453 * (0x1p-52 * (double)u.bits - 1023);
}

/* asinh(x) to 2e-5: a rough logarithm, and a step of Halley's method. */
static double near_asinh(double x) {
  const double y = fabs(x) + sqrt(x * x + 1), guess = rough_log(y),
               e = exponential(splat(guess))[0];
  return copysign(guess + 2 * (y - e) / (y + e), x);
}

/* The sinh map to p = length, or as far as SINH_LENGTH allows. Returns whether that is `length`,
 * but for the error of near_asinh(). */
static bool sinh_map(step *s, const passage *g, double length) {
  /* x at both ends of the step */
  const double low = near_asinh(-g->p_c / g->d);
  double high = near_asinh((length - g->p_c) / g->d);
  const bool arrives = high - low <= SINH_LENGTH;
  if (!arrives) /* two equal steps rather than a long and a short one */
    high = low + (high - low < 2 * SINH_LENGTH ? 0.5 * (high - low) : SINH_LENGTH);
  /* dp = d cosh(x) h dX and p = d (sinh(x) - sinh(from)), by e^x */
  const double h = high - low;
  const part ends = exponential((part){low, high}), sinh_2 = ends - 1 / ends; /* twice the sine */
  EACH {
    const part e = exponential(low + h * PART(NODE, i)), per_e = 1 / e;
    s->z[i] = (0.5 * h * g->d) * (e + per_e);
    s->p[i] = (0.5 * g->d) * ((e - per_e) - sinh_2[0]);
    s->E[i] = splat(1);
  }
  s->length = (0.5 * g->d) * (sinh_2[1] - sinh_2[0]);
  return arrives;
}

/* The closed form of a stretched map. */
typedef struct closed_form {
  double D, m, q_0, A, B, cosine, sine; /* of psi_0 */
} closed_form;

static closed_form closed_form_of(const carom_terms *k, const step_start *s) {
  /* the components of a' across u and along it */
  const double across = s->u_x * s->da_y - s->u_y * s->da_x,
               along = s->u_x * s->da_x + s->u_y * s->da_y;
  /* the derivative by phi of the component of a' across u */
  const double turned = -along + k->S_x * s->u_y * s->u_y + k->S_y * s->u_x * s->u_x -
                        k->w_u * s->u_x * (s->u_x * k->C_y * s->t_y - s->u_y * k->C_x * s->t_x);
  /* D cos psi = along + m and D sin psi = -across, with m = -turned - along */
  closed_form c = {.D = sqrt(across * across + turned * turned) + 1e-12, .m = -turned - along};
  c.cosine = -turned / c.D;
  c.sine = -across / c.D;
  /* q_0 = tan(psi / 2), without a difference of nearly equal numbers; then A and B */
  const double sine = fabs(c.sine) > 1e-14 ? c.sine : copysign(1e-14, c.sine);
  c.q_0 = c.cosine > 0 ? c.sine / (1 + c.cosine) : (1 - c.cosine) / sine;
  c.A = s->r / (1 + c.q_0 * c.q_0);
  c.B = s->r - c.A;
  return c;
}

/* tau where p has come to `length`, to a few percent, by two steps of Newton's method; if that
 * is beyond 2 most, some tau beyond it. first: a guess. */
static double tau_at(const closed_form *c, double length, double first, double most) {
  /* the exponents of r */
  const double slow = c->D - c->m, fast = -c->D - c->m;
  double tau = first > 0 && first < most ? first : most;
  for (int n = 0; n < 2 && tau < 2 * most; n++) {
    /* r and p at tau; a step that at most halves or triples tau */
    const part e = exponential((part){slow * tau, fast * tau});
    const double r = c->A * e[0] + c->B * e[1];
    const double p =
        (fabs(slow) > 1e-9 ? c->A * (e[0] - 1) / slow : c->A * tau) + c->B * (e[1] - 1) / fast;
    const double more = (length - p) / r;
    if (more < -0.5 * tau)
      tau += -0.5 * tau;
    else
      tau += more < 2 * tau ? more : 2 * tau;
  }
  return tau;
}

/* To tau, with the directions of u that belong to it. */
static void stretched_map(step *s, const closed_form *c, const step_start *origin, double tau) {
  /* a slip along D keeps its direction, not only nearly */
  const double q_2 = c->q_0 * c->q_0, turns = c->sine != 0;
  EACH {
    /* e^(-D tau), e^(-m tau) and tan(psi / 2) at the nodes */
    const part x = tau * PART(NODE, i), d = exponential(-c->D * x), e = exponential(-c->m * x),
               q = c->q_0 * d;
    /* (1 - i q_0) (1 + i q) has half the angle by which u has turned */
    const part across = q - c->q_0, along = 1 + c->q_0 * q,
               per = 1 / madd(across, across, along * along);
    const part cosine = (along * along - across * across) * per,
               sine = turns * 2 * across * along * per;
    /* dp = r tau dX; u turned by the angle */
    s->E[i] = e;
    s->z[i] = (tau * c->A) * e * (1 / d + q_2 * d);
    s->u_x[i] = origin->u_x * cosine - origin->u_y * sine;
    s->u_y[i] = origin->u_y * cosine + origin->u_x * sine;
  }
  integrate(s->z, s->p);
  s->length = dot(WEIGHT, s->z);
}

/* Directions of a slip that goes along a straight line from x, y. A slip of zero has the
 * direction lead_x, lead_y. */
static void aim(const step *s, double x, double y, double rate_x, double rate_y, double lead_x,
                double lead_y, part *to_x, part *to_y) {
  const bool constant = x == 0 && y == 0;
  EACH {
    to_x[i] = constant ? splat(lead_x) : x + s->p[i] * rate_x;
    to_y[i] = constant ? splat(lead_y) : y + s->p[i] * rate_y;
  }
  nodes inverse;
  if (!constant)
    normalise(to_x, to_y, false, inverse);
}

#endif
