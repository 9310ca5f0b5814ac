/* The maps from X in [0, 1] to p over which steps collocate, and the directions that steps begin
 * to iterate with.
 *
 * EVEN. p = length X.
 *
 * SINH. The direction of b changes fast where b passes near zero. Let b go along a straight
 * line, nearest to zero at p_c, at the distance d (in units of p). Then p = p_c + d sinh x makes
 * the direction of b smooth in x.
 *
 *      path of b
 *      ------*-----*----*---*----*-----*------       nodes are dense where the direction of b
 *                       | d                           turns fast
 *                       0, at p_c
 *
 * STRETCHED. Let t be constant and friction isotropic, so that a' = D - m u with a constant
 * vector D of size D, and let dp = r dtau, r = |a|. With psi the angle from D to u,
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
static const double ELLIPSE = 3; /* b passes near zero if its complex zero is within this
                                    ellipse: see nearest() */
/* least d, as a fraction of the distance to p_c */
static const double LEAST_D = 1e-3, LEAST_D_UNSTABLE = 1e-14;
static const double SINH_LENGTH = 3; /* length of a step in x */
/* Less than these would divide by 0: D of a drive, and the sine of psi_0 */
static const double LEAST_DRIVE = 1e-12, LEAST_SINE = 1e-14;
/* D - m below which r is constant in the integral of a map */
static const double NO_EXPONENT = 1e-9;
static const double LN_2 = 0.6931471805599453;
enum { EXPONENT_BIAS = 1023 }; /* of a double of IEEE 754, whose fraction has 52 bits */

/* The state in which a step begins. */
typedef struct step_start {
  double size_a, size_b;                /* |a| and |b|; |a| is r of STRETCHED */
  double u_x, u_y, t_x, t_y;            /* their directions */
  double w, da_x, da_y, db_x, db_y, dv; /* w, a', b', v' */
  double line_x, line_y;                /* b' without half of the cloth's own friction: its mean
                                           where b passes zero */
  double to_goal;                       /* p to the goal, */
  enum goal goal;                       /* which is the end of the phase, or closer */
  double target;
} step_start;

static void even_map(planned_step *step, double length) {
  EACH {
    step->z[i] = splat(length);
    step->p[i] = length * PART(NODE, i);
    step->E[i] = splat(1);
  }
  step->length = length;
}

/* Where a straight line is nearest to zero. */
typedef struct passage {
  double p_c, d;
  bool matters; /* a step of the length requested has to take account of it */
} passage;

static passage nearest(const carom_point *point, double rate_x, double rate_y, double length) {
  const double per = 1 / (rate_x * rate_x + rate_y * rate_y);
  passage passing = {.p_c = -(point->b_x * rate_x + point->b_y * rate_y) * per,
                     .d = fabs(point->b_x * rate_y - point->b_y * rate_x) * per};
  /* b is zero at p_c +- i d: in units of the step, from -1 to 1, the sum of the distances to the
   * ends determines the ellipse */
  const double center = 2 * passing.p_c / length - 1, offset = 2 * passing.d / length;
  passing.matters = sqrt((center - 1) * (center - 1) + offset * offset) +
                        sqrt((center + 1) * (center + 1) + offset * offset) <
                    ELLIPSE;
  return passing;
}

/* How b passes zero. It goes at its present rate, or if that does not lead near zero, at the
 * mean rate beyond. */
static passage passage_of_b(const carom_point *point, const carom_terms *terms,
                            const step_start *origin, double length) {
  const double rate = fabs(origin->db_x) + fabs(origin->db_y) +
                      (terms->H_x < 0 ? fabs(origin->line_x) + fabs(origin->line_y) : 0);
  passage passing = {.matters = false};
  if (origin->size_b == 0 || origin->size_b > 2 * length * rate)
    return passing;
  /* friction that drives the slip slows b on its way to zero: then the mean rate is used first */
  if (terms->H_x > 0)
    passing = nearest(point, origin->db_x, origin->db_y, length);
  if (!passing.matters)
    passing = nearest(point, origin->line_x, origin->line_y, length);
  if (!passing.matters && terms->H_x < 0)
    passing = nearest(point, origin->db_x, origin->db_y, length);
  /* a slip that friction drives stays near zero for long: there the map has to resolve more */
  const double least = (terms->H_x > 0 ? LEAST_D : LEAST_D_UNSTABLE) * origin->size_b / rate;
  passing.d = passing.d > least ? passing.d : least;
  return passing;
}

/* log(x) to 0.06, for x > 0: the exponent, and linear in between. */
static double rough_log(double x) {
  union {
    double value;
    int64_t bits;
  } number = {.value = x};
  return LN_2 * (0x1p-52 * (double)number.bits - (double)EXPONENT_BIAS);
}

/* asinh(x) to 2e-5: a rough logarithm, and a step of Halley's method. */
static double near_asinh(double x) {
  const double e_to_asinh = fabs(x) + sqrt(x * x + 1), guess = rough_log(e_to_asinh),
               e_to_guess = exponential(splat(guess))[0];
  return copysign(guess + 2 * (e_to_asinh - e_to_guess) / (e_to_asinh + e_to_guess), x);
}

/* The sinh map to p = length, or as far as SINH_LENGTH allows. Returns whether that is `length`,
 * but for the error of near_asinh(). */
static bool sinh_map(planned_step *step, const passage *passing, double length) {
  /* x at both ends of the step */
  const double low = near_asinh(-passing->p_c / passing->d);
  double high = near_asinh((length - passing->p_c) / passing->d);
  const bool arrives = high - low <= SINH_LENGTH;
  if (!arrives) /* two equal steps rather than a long and a short one */
    high = low + (high - low < 2 * SINH_LENGTH ? 0.5 * (high - low) : SINH_LENGTH);
  /* dp = d cosh(x) span dX and p = d (sinh(x) - sinh(from)), by e^x */
  const double span = high - low;
  const part ends = exponential((part){low, high}), sinh_2 = ends - 1 / ends; /* twice the sine */
  EACH {
    const part e_x = exponential(low + span * PART(NODE, i)), per_e_x = 1 / e_x;
    step->z[i] = (0.5 * span * passing->d) * (e_x + per_e_x);
    step->p[i] = (0.5 * passing->d) * ((e_x - per_e_x) - sinh_2[0]);
    step->E[i] = splat(1);
  }
  step->length = (0.5 * passing->d) * (sinh_2[1] - sinh_2[0]);
  return arrives;
}

/* The closed form of a stretched map. */
typedef struct closed_form {
  double D, m, q_0, A, B, cosine, sine; /* of psi_0 */
} closed_form;

static closed_form closed_form_of(const carom_terms *terms, const step_start *origin) {
  /* the components of a' across u and along it */
  const double across = origin->u_x * origin->da_y - origin->u_y * origin->da_x,
               along = origin->u_x * origin->da_x + origin->u_y * origin->da_y;
  /* the derivative by phi of the component of a' across u */
  const double turned =
      -along + terms->S_x * origin->u_y * origin->u_y + terms->S_y * origin->u_x * origin->u_x -
      terms->w_u * origin->u_x *
          (origin->u_x * terms->C_y * origin->t_y - origin->u_y * terms->C_x * origin->t_x);
  /* D cos psi = along + m and D sin psi = -across, with m = -turned - along */
  closed_form form = {.D = sqrt(across * across + turned * turned) + LEAST_DRIVE,
                      .m = -turned - along};
  form.cosine = -turned / form.D;
  form.sine = -across / form.D;
  /* q_0 = tan(psi / 2), without a difference of nearly equal numbers; then A and B */
  const double sine = fabs(form.sine) > LEAST_SINE ? form.sine : copysign(LEAST_SINE, form.sine);
  form.q_0 = form.cosine > 0 ? form.sine / (1 + form.cosine) : (1 - form.cosine) / sine;
  form.A = origin->size_a / (1 + form.q_0 * form.q_0);
  form.B = origin->size_a - form.A;
  return form;
}

/* tau where p reaches `length`, to a few percent, by two steps of Newton's method; if that is
 * beyond 2 most, some tau beyond it. first: a guess. */
static double tau_at(const closed_form *form, double length, double first, double most) {
  /* the exponents of r */
  const double slow = form->D - form->m, fast = -form->D - form->m;
  double tau = first > 0 && first < most ? first : most;
  for (int step = 0; step < 2 && tau < 2 * most; step++) {
    /* r and p at tau; a step that at most halves or triples tau */
    const part powers = exponential((part){slow * tau, fast * tau});
    const double r = form->A * powers[0] + form->B * powers[1];
    const double p = (fabs(slow) > NO_EXPONENT ? form->A * (powers[0] - 1) / slow : form->A * tau) +
                     form->B * (powers[1] - 1) / fast;
    const double more = (length - p) / r;
    if (more < -0.5 * tau)
      tau += -0.5 * tau;
    else
      tau += more < 2 * tau ? more : 2 * tau;
  }
  return tau;
}

/* To tau, with the directions of u that belong to it. */
static void stretched_map(planned_step *step, const closed_form *form, const step_start *origin,
                          double tau) {
  /* a slip along D keeps its direction, not only nearly */
  const double q_2 = form->q_0 * form->q_0, turns = form->sine != 0;
  EACH {
    /* e^(-D tau), e^(-m tau) and tan(psi / 2) at the nodes */
    const part taus = tau * PART(NODE, i), e_D = exponential(-form->D * taus),
               e_m = exponential(-form->m * taus), q_nodes = form->q_0 * e_D;
    /* (1 - i q_0) (1 + i q) has half the angle by which u has turned */
    const part across = q_nodes - form->q_0, along = 1 + form->q_0 * q_nodes,
               per = 1 / madd(across, across, along * along);
    const part cosine = (along * along - across * across) * per,
               sine = turns * 2 * across * along * per;
    /* dp = r tau dX; u turned by the angle */
    step->E[i] = e_m;
    step->z[i] = (tau * form->A) * e_m * (1 / e_D + q_2 * e_D);
    step->u_x[i] = origin->u_x * cosine - origin->u_y * sine;
    step->u_y[i] = origin->u_y * cosine + origin->u_x * sine;
  }
  integrate(step->z, step->p);
  step->length = dot(WEIGHT, step->z);
}

/* Directions of a slip that goes along a straight line from x, y. A slip of zero has the
 * direction lead_x, lead_y. */
static void aim(const planned_step *step, double x, double y, double rate_x, double rate_y,
                double lead_x, double lead_y, part *to_x, part *to_y) {
  const bool constant = x == 0 && y == 0;
  EACH {
    to_x[i] = constant ? splat(lead_x) : x + step->p[i] * rate_x;
    to_y[i] = constant ? splat(lead_y) : y + step->p[i] * rate_y;
  }
  nodes inverse;
  if (!constant)
    normalise(to_x, to_y, false, inverse);
}

#endif
