/* One collocation step of an impact, over eight Gauss nodes.
 *
 * EQUATIONS. They are the equations of law.h in one regime. With u = a/|a| and t = b/|b| the
 * directions of the slips, and w the friction of the cloth per unit of p (its load times its
 * coefficient),
 *
 *     a' = (S_x u_x - C_x w t_x, A_0 + S_y u_y - C_y w t_y)          v' = V_0 + V_u u_y - V_w w t_y
 *     b' = (R_x u_x - H_x w t_x, B_0 + R_y u_y - H_y w t_y)
 *     w  = (w_0 + w_u u_y) / (1 - w_t t_y)
 *
 * Where the driving contact holds there is no u, and where the cloth holds or bears no load w =
 * 0; the coefficients contain the holding contacts (contact.c).
 *
 *   symbol   meaning; speeds are over the speed of approach at the start of the impact
 *   p        normal impulse of the driving contact over the mass of the ball
 *   a, b     slips at the driving contact and on the cloth
 *   u, t     their directions
 *   v        speed of approach; in `iterate` its rate v'
 *   w        friction of the cloth per unit of p
 *   X        position within a step, 0 to 1
 *   z        dp/dX
 *   M        the matrix of INTEGRAL
 *   E        integrating factor of the map
 *   D        z da'/dphi or z db'/dpsi
 *
 * COLLOCATION. A map takes X in [0, 1] to p, with dp = z dX. With M the matrix that integrates
 * the polynomial through the nodes, the directions u, t at the nodes have to be those of
 *
 *     a = a_0 + M(z a'),     b = b_0 + M(z b')
 *
 * ITERATION. The directions give a and b, whose directions differ from u and t by angles. Let r be
 * the ratio of a to u. A rotation of u by d rotates a too, by (1/|a|) times the component across u
 * of the integral of z da'/dphi d. Newton's method requires
 *
 *     d = r - (1/|a|) M(z k d),     k = -(component of da'/dphi across u)
 *
 * An integrating factor E with E' = -z k E / |a| solves this: d = r - (E/|a|) M(z k r / E). The map
 * includes an estimate of E. A step that is stiff solves the linear equations for d instead
 * (`exact`). For t, the kernel E(X) / E(X') of the integral is replaced by 1/(1 + M(z k)(X') /
 * |b|).
 *
 * END. The step ends at a given p or at one of the events of `enum goal`. Then its length is
 * unknown, and each iteration corrects it by Newton's method from the rates at the last node.
 *
 * ERROR. The error at the end is of the order of the square of the misfit of the polynomials of a'
 * and b'. The estimate of the misfit is the coefficient of their highest Legendre polynomial. */
#ifndef CAROM_SRC_CONTACT_LAW_STEP_H
#define CAROM_SRC_CONTACT_LAW_STEP_H

#include "contact_law/impact.h"
#include "contact_law/nodes.h"
#include "contact_law/variation.h"

/* Found by trial with `carom-lab stress --cushion 20000` and the times of
 * docs/understanding/cushion.md. Angles are in radians, lengths in units
 * of p. With half of CONVERGED play takes 5 % longer, and twice changes nothing. With half of
 * TOLERANCE_EXACT the largest error falls from 1.5e-6 to 8.2e-7. TOLERANCE and NEARLY_CONVERGED
 * matter little. */
static const double CONVERGED = 4e-8;       /* error that the iteration may leave in directions */
static const double TOLERANCE = 4e-7;       /* square of the error estimate, over the length of
                                               the step, */
static const double TOLERANCE_EXACT = 1e-9; /* and where the step is exact */
static const double SETTLED = 1e-6;         /* last correction of the length, as a fraction of it */
static const double EVENT_TOLERANCE = 1e-8; /* event function that does not yet end a regime, */
static const double LATE = 1e-5;            /* and within a step that ends at its event */
static const double NEARLY_STOPPED = 1e-8;  /* v that counts as 0 where the cloth's slip has
                                               stopped */
static const double NEARLY_CONVERGED =
    3e-3; /* correction, of directions and of the length, after which Newton's method updates
             inverse lengths, */
static const double FRESH = 0.02; /* and that after which an exact step keeps its matrix */
/* Limits of the iteration. An exact step turns a direction by this at most, rad. */
static const double MOST_ANGLE = 0.6;
/* The rate of convergence, as long as none has been seen. */
static const double FIRST_RATE = 0.3;
/* Of a correction of t, because a later iteration corrects far less of it. */
static const double LATER_SHARE = 0.3;
/* An iteration has diverged where its correction is larger than LOST, or after PATIENCE iterations
 * where it converges slowly and is still coarse. A coarse one has not converged in any case. */
static const double LOST = 10, SLOW_RATE = 0.6, COARSE = 1e-3;
/* One correction of the length is within these fractions of it. */
static const double MOST_SHORTENED = -0.4, MOST_LENGTHENED = 0.5;
/* The fraction of the length by which a step grows that sees no way to its work, or to its
 * event. */
static const double BLIND_WORK = 0.3, BLIND_EVENT = 0.2;
/* SOFTENED: the first iterations, which compute `ease`. */
enum { MOST_ITERATIONS = 12, PATIENCE = 3, SOFTENED = 2 };

/* Where a step ends. */
enum goal {
  AT_LENGTH,          /* at the length of its map */
  AT_P,               /* where p has grown by target */
  AT_END_OF_APPROACH, /* at v = 0 */
  AT_WORK,            /* where W = target */
  AT_STICK,           /* where the slip at the driving contact becomes zero, */
  AT_CLOTH_STICK,     /* and that on the cloth */
  AT_EVENT            /* where the regime ends: carom_terms.event */
};

enum outcome {
  TAKEN,
  DIVERGED,
  INACCURATE,
  EVENT_WITHIN,
  BEYOND_PHASE /* of compression or restitution */
};

/* For which directions the iteration solves Newton's equations exactly. */
enum exact { FOR_NONE, FOR_U, FOR_BOTH };

/* A step that has been planned. */
typedef struct planned_step {
  nodes z, p, E;            /* dp/dX; p from the beginning of the step; see above */
  nodes u_x, u_y, t_x, t_y; /* directions to begin with */
  double length;            /* p at X = 1 */
  enum goal goal;
  double target;
  bool restitution; /* v <= 0, and W >= least_work */
  double least_work;
  double tolerance;        /* scales CONVERGED and TOLERANCE */
  carom_kept_step *record; /* where the step is kept for derivatives, or NULL */
} planned_step;

/* The values of the iteration at the nodes. */
typedef struct iterate {
  nodes u_x, u_y, t_x, t_y;     /* directions */
  nodes w, v;                   /* friction of the cloth, v' */
  nodes za_x, za_y, zb_x, zb_y; /* z a', z b' */
} iterate;

/* The rates from the directions. scale: of z. */
always void rates(const carom_terms *terms, const part *z, double scale, const bool driving_slips,
                  const bool loaded, iterate *guess) {
  EACH {
    const part zs = scale * z[i];
    part a_x = splat(0), a_y = splat(terms->A_0), b_x = splat(0), b_y = splat(terms->B_0),
         v = splat(terms->V_0);
    /* friction of the driving contact */
    if (driving_slips) {
      a_x = terms->S_x * guess->u_x[i];
      a_y = madd(guess->u_y[i], splat(terms->S_y), a_y);
      b_x = terms->R_x * guess->u_x[i];
      b_y = madd(guess->u_y[i], splat(terms->R_y), b_y);
      v = madd(guess->u_y[i], splat(terms->V_u), v);
    }
    /* friction of the cloth */
    if (loaded) {
      if (driving_slips)
        guess->w[i] = madd(guess->u_y[i], splat(terms->w_u), splat(terms->w_0));
      else
        guess->w[i] = terms->w_0 / (1 - terms->w_t * guess->t_y[i]);
      const part x = guess->w[i] * guess->t_x[i], y = guess->w[i] * guess->t_y[i];
      a_x = madd(x, splat(-terms->C_x), a_x);
      a_y = madd(y, splat(-terms->C_y), a_y);
      b_x = madd(x, splat(-terms->H_x), b_x);
      b_y = madd(y, splat(-terms->H_y), b_y);
      v = madd(y, splat(-terms->V_w), v);
    }
    /* over the length of the step */
    guess->za_x[i] = zs * a_x;
    guess->za_y[i] = zs * a_y;
    guess->zb_x[i] = zs * b_x;
    guess->zb_y[i] = zs * b_y;
    guess->v[i] = v;
  }
}

/* A slip at the nodes, from where it begins and its rate times z. */
always void integrate_slip(double x, double y, const part *zx, const part *zy, part *to_x,
                           part *to_y) {
  integrate(zx, to_x);
  integrate(zy, to_y);
  EACH {
    to_x[i] += x;
    to_y[i] += y;
  }
}

/* x, y over their length, whose inverse becomes *inverse. approximate: *inverse has the inverse for
 * a similar length. */
always void normalise(part *x, part *y, bool approximate, part *inverse) {
  EACH {
    const part square = madd(x[i], x[i], madd(y[i], y[i], splat(1e-300)));
    if (approximate) { /* one step of third order */
      const part left = 1 - square * (inverse[i] * inverse[i]);
      inverse[i] = madd(inverse[i] * left, madd(left, splat(0.375), splat(0.5)), inverse[i]);
    } else
      inverse[i] = 1 / square_root(square);
    x[i] *= inverse[i];
    y[i] *= inverse[i];
  }
}

/* One step of Newton's method for the directions u of the slip a, by an integrating factor. zk:
 * z times k of the head of this file; before: 1/E; after: E. a becomes a unit vector.
 * correction: by which angles. */
always void rotate(part *a_x, part *a_y, const part *zk, const part *previous, const part *next,
                   bool approximate, part *inverse, part *u_x, part *u_y, part *correction) {
  nodes across, integrand, angle;
  /* the sine of the angle from u to a, once a has length 1 */
  EACH across[i] = madd(u_x[i], a_y[i], -(u_y[i] * a_x[i]));
  normalise(a_x, a_y, approximate, inverse);
  /* (E / |a|) M(z k r / E): by this angle a is turned back, which gives the new u */
  EACH integrand[i] = zk[i] * previous[i] * across[i] * inverse[i];
  integrate(integrand, angle);
  EACH {
    angle[i] *= next[i] * inverse[i];
    correction[i] = magnitude(across[i] * inverse[i] - angle[i]);
    u_x[i] = madd(a_y[i], angle[i], a_x[i]);
    u_y[i] = madd(a_x[i], -angle[i], a_y[i]);
  }
}

/* The same by solving the linear equations for the angles d of rotation, where D = z da'/dphi:
 *
 *     (u . a) d - u x M(D d) = u x a
 *
 * which also holds where a is nearly zero. solved: the inverse of the matrix, computed anew or
 * kept. Returns whether a points along u at all nodes. */
always bool rotate_exactly(const part *a_x, const part *a_y, const part *D_x, const part *D_y,
                           bool anew, double (*solved)[NODES], part *u_x, part *u_y,
                           part *correction) {
  nodes across, along, angle;
  /* u x a and u . a */
  EACH {
    across[i] = u_x[i] * a_y[i] - u_y[i] * a_x[i];
    along[i] = u_x[i] * a_x[i] + u_y[i] * a_y[i];
  }
  /* the matrix by columns, (u . a) on the diagonal less u x M(D), and its inverse */
  if (anew) {
    for (int node = 0; node < NODES; node++) {
      EACH((part_of_row *)solved[node])
      [i] = (part_of_row)(PART(INTEGRAL[node], i) *
                          (u_y[i] * splat(AT(D_x, node)) - u_x[i] * splat(AT(D_y, node))));
      solved[node][node] += AT(along, node);
    }
    invert(solved);
  }
  /* the angles d, limited; u turned by d to first order, and made a unit vector again */
  apply((const double(*)[NODES])solved, across, angle);
  EACH {
    const part old_x = u_x[i], turn = within(angle[i], MOST_ANGLE);
    u_x[i] = old_x - u_y[i] * turn;
    u_y[i] = u_y[i] + old_x * turn;
    along[i] = -along[i];
    correction[i] = magnitude(angle[i]);
  }
  normalise(u_x, u_y, false, angle);
  return largest(along) <= 0;
}

/* The event function where the direction u, or w t, is x, y. */
always double event_of(const carom_terms *terms, double x, double y) {
  return terms->event[0] + y * (terms->event[1] + y * terms->event[3]) + x * x * terms->event[2];
}

/* The same at the nodes. */
always void events(const carom_terms *terms, const iterate *guess, const bool driving_slips,
                   part *event) {
  EACH {
    const part x = driving_slips ? guess->u_x[i] : guess->w[i] * guess->t_x[i],
               y = driving_slips ? guess->u_y[i] : guess->w[i] * guess->t_y[i];
    event[i] = madd(y, madd(y, splat(terms->event[3]), splat(terms->event[1])),
                    madd(x * x, splat(terms->event[2]), splat(terms->event[0])));
  }
}

/* The event function at a point; 0 where the slip has no direction. */
static double event_gap(const carom_terms *terms, const carom_point *point,
                        const bool driving_slips) {
  const double x = driving_slips ? point->a_x : point->b_x,
               y = driving_slips ? point->a_y : point->b_y, size = sqrt(x * x + y * y);
  if (!(size > 0))
    return 0;
  const double w = driving_slips ? 1 : terms->w_0 / (1 - terms->w_t * y / size);
  return event_of(terms, w * x / size, w * y / size);
}

/* p from the beginning of the step to where the event function, at the nodes *f, first becomes
 * positive, by linear interpolation between nodes. scale: of z. */
static double first_event(const carom_terms *terms, const carom_point *point,
                          const planned_step *step, double scale, const part *event,
                          const bool driving_slips) {
  double p = 0, value = event_gap(terms, point, driving_slips);
  for (int node = 0; node <= NODES; node++) {
    const double next_p = scale * (node < NODES ? AT(step->p, node) : step->length),
                 next = node < NODES ? AT(event, node) : 1;
    if (next > 0 && node == NODES)
      return 0.5 * (p + next_p);
    if (next > 0)
      return value < 0 ? p + (next_p - p) * value / (value - next) : p;
    p = next_p;
    value = next;
  }
  return p;
}

/* int v dp from *point to the end of the step. to_end: weights of the integral of an integral. */
always double work(const carom_point *point, double length, double scale, const double *to_end,
                   const iterate *guess) {
  return point->v * length + scale * scale * dot(to_end, guess->v);
}

/* By how much p has to grow for the step to end at its goal: a step of Newton's method. */
always double to_goal(const carom_terms *terms, const carom_point *start, const planned_step *step,
                      const iterate *guess, double scale, const part *to_end,
                      const bool driving_slips) {
  /* a given p, or v = 0 or W = target: Newton's method with v at the end and v' there */
  const double length = scale * step->length;
  if (step->goal == AT_P)
    return step->target - length;
  if (step->goal == AT_END_OF_APPROACH || step->goal == AT_WORK) {
    nodes zv;
    EACH zv[i] = step->z[i] * guess->v[i];
    const double v = start->v + scale * dot(WEIGHT, zv);
    if (step->goal == AT_END_OF_APPROACH)
      return -v / LAST(guess->v);
    return v < 0 ? (step->target - start->W -
                    work(start, length, scale, (const double *)to_end, guess)) /
                       v
                 : BLIND_WORK * length;
  }

  /* the slip at the end, and its rate there */
  const bool driving = step->goal == AT_STICK || (step->goal == AT_EVENT && driving_slips);
  const part *zx = driving ? guess->za_x : guess->zb_x, *zy = driving ? guess->za_y : guess->zb_y;
  const double last = 1 / (scale * LAST(step->z)), dx = LAST(zx) * last, dy = LAST(zy) * last;
  double x = (driving ? start->a_x : start->b_x) + dot(WEIGHT, zx),
         y = (driving ? start->a_y : start->b_y) + dot(WEIGHT, zy);

  /* stick: the slip along its direction over its rate */
  if (step->goal != AT_EVENT) {
    const double u_x = driving ? LAST(guess->u_x) : LAST(guess->t_x),
                 u_y = driving ? LAST(guess->u_y) : LAST(guess->t_y);
    return -(x * u_x + y * u_y) / (dx * u_x + dy * u_y);
  }

  /* the direction at the end, how fast it turns, and its effect on w */
  const double inverse = 1 / sqrt(x * x + y * y), turning = (x * dy - y * dx) * inverse * inverse;
  double w = 1, growth = 0;
  x *= inverse;
  y *= inverse;
  if (!driving_slips) {
    w = terms->w_0 / (1 - terms->w_t * y);
    growth = w * terms->w_t * x * turning / (1 - terms->w_t * y);
  }

  /* the rate of the event function */
  const double event_x = w * x, event_y = w * y;
  const double rate =
      (terms->event[1] + 2 * terms->event[3] * event_y) * (w * x * turning + growth * y) +
      2 * terms->event[2] * event_x * (growth * x - w * y * turning);
  return rate > 0 ? -event_of(terms, event_x, event_y) / rate : BLIND_EVENT * length;
}

/* Takes a step from *point. driving_slips: that contact slips; loaded: the cloth bears a load, and
 * slips. A rejected step leaves *point as it is; then *advice is, for INACCURATE, the squared error
 * estimate over the tolerance, and for EVENT_WITHIN the p from here to the event. */
always enum outcome collocate(const carom_terms *regime_terms, const planned_step *step,
                              const bool driving_slips, const bool loaded, const enum exact exact,
                              carom_point *point, int *iterations, double *advice) {
  const carom_terms terms = *regime_terms;
  iterate guess;
  nodes per_E, ease, unit, to_end, inverse_a, inverse_b, slip_x, slip_y, D_x, D_y, zk, values,
      correction, correction_t;
  double for_u[NODES][NODES] __attribute__((aligned(PART_BYTES))),
      for_t[NODES][NODES] __attribute__((aligned(PART_BYTES)));

  /* the planned directions; 1/E; `ease`, which represents E(X)/E(X') of t; the weights of the
   * work */
  EACH {
    guess.u_x[i] = step->u_x[i];
    guess.u_y[i] = step->u_y[i];
    guess.t_x[i] = step->t_x[i];
    guess.t_y[i] = step->t_y[i];
    unit[i] = splat(1);
    ease[i] = inverse_a[i] = inverse_b[i] = splat(0);
    per_E[i] = driving_slips && exact == FOR_NONE ? 1 / step->E[i] : splat(1);
    to_end[i] = PART(WEIGHT, i) * step->z[i] * (step->length - step->p[i]);
  }

  /* iterations; `scale` is the length over the planned one, `last` the last correction */
  double scale = 1, last = 1, last_rate = FIRST_RATE;
  bool converged = false, forward = true, approximate = false;
  for (int iteration = 0; iteration < MOST_ITERATIONS && !converged; iteration++) {
    forward = true;
    /* the rates at the nodes, and the correction of the length */
    ++*iterations;
    rates(&terms, step->z, scale, driving_slips, loaded, &guess);
    const double change = step->goal == AT_LENGTH
                              ? 0
                              : to_goal(&terms, point, step, &guess, scale, to_end, driving_slips) /
                                    (scale * step->length);
    EACH correction[i] = splat(0);

    /* u from the slip at the driving contact */
    if (driving_slips) {
      integrate_slip(point->a_x, point->a_y, guess.za_x, guess.za_y, slip_x, slip_y);
      /* z da'/dphi, of which u has a part in the load too */
      EACH {
        const part zs = scale * step->z[i], w_u = loaded ? terms.w_u * guess.u_x[i] : splat(0);
        D_x[i] = -zs * madd(guess.u_y[i], splat(terms.S_x), (terms.C_x * w_u) * guess.t_x[i]);
        D_y[i] = zs * madd(guess.u_x[i], splat(terms.S_y), (-terms.C_y * w_u) * guess.t_y[i]);
        zk[i] = madd(guess.u_y[i], D_x[i], -(guess.u_x[i] * D_y[i]));
      }
      if (exact)
        forward = rotate_exactly(slip_x, slip_y, D_x, D_y, iteration == 0 || last > FRESH, for_u,
                                 guess.u_x, guess.u_y, correction);
      else
        rotate(slip_x, slip_y, zk, per_E, step->E, approximate, inverse_a, guess.u_x, guess.u_y,
               correction);
    }

    /* t from the slip on the cloth */
    if (loaded) {
      integrate_slip(point->b_x, point->b_y, guess.zb_x, guess.zb_y, slip_x, slip_y);
      /* z db'/dphi, of which t has a part in the load where the driving contact holds */
      if (driving_slips && exact != FOR_BOTH)
        EACH zk[i] = (scale * step->z[i]) * (terms.H_x * guess.w[i]);
      else
        EACH {
          const part zw = (scale * step->z[i]) * guess.w[i];
          const part zw_t = driving_slips
                                ? splat(0)
                                : zw * terms.w_t * guess.t_x[i] / (1 - terms.w_t * guess.t_y[i]);
          D_x[i] = terms.H_x * (zw * guess.t_y[i] - zw_t * guess.t_x[i]);
          D_y[i] = -terms.H_y * (zw * guess.t_x[i] + zw_t * guess.t_y[i]);
          zk[i] = guess.t_y[i] * D_x[i] - guess.t_x[i] * D_y[i];
        }
      /* by its linear equations, or by the kernel for t: ITERATION */
      if (exact == FOR_BOTH)
        forward &= rotate_exactly(slip_x, slip_y, D_x, D_y, iteration == 0 || last > FRESH, for_t,
                                  guess.t_x, guess.t_y, correction_t);
      else {
        rotate(slip_x, slip_y, zk, ease, unit, approximate, inverse_b, guess.t_x, guess.t_y,
               correction_t);
        if (iteration < SOFTENED) {
          integrate(zk, values);
          EACH ease[i] = 1 / (1 + values[i] * inverse_b[i]);
        }
        EACH correction_t[i] *= LATER_SHARE;
      }
      EACH correction[i] = greater(correction[i], correction_t[i]);
    }

    /* the error left is the last correction times the rate of convergence; it acts over the length
     * of the step */
    const double remainder = largest(correction),
                 rate = iteration > 0 ? remainder / last : FIRST_RATE,
                 worst = rate > last_rate ? rate : last_rate;
    if (!(remainder < LOST) || (iteration >= PATIENCE && rate > SLOW_RATE && remainder > COARSE))
      return DIVERGED;
    const double share = scale * step->length < 1 ? scale * step->length : 1;
    converged = remainder * (worst < 1 ? worst : 1) * share < CONVERGED * step->tolerance &&
                remainder < COARSE && fabs(change) < SETTLED;

    /* the new length, within limits */
    const double at_least = change > MOST_SHORTENED ? change : MOST_SHORTENED;
    scale *= 1 + (change > MOST_LENGTHENED ? MOST_LENGTHENED : at_least);
    approximate = remainder < NEARLY_CONVERGED && fabs(change) < NEARLY_CONVERGED;
    last = remainder;
    last_rate = rate;
  }
  if (!converged || !forward)
    return DIVERGED;

  /* the point at the end */
  rates(&terms, step->z, scale, driving_slips, loaded, &guess);
  const double length = scale * step->length;
  EACH values[i] = step->z[i] * guess.v[i];
  carom_point reached = {.a_x = point->a_x + dot(WEIGHT, guess.za_x),
                         .a_y = point->a_y + dot(WEIGHT, guess.za_y),
                         .b_x = point->b_x + dot(WEIGHT, guess.zb_x),
                         .b_y = point->b_y + dot(WEIGHT, guess.zb_y),
                         .v = point->v + scale * dot(WEIGHT, values),
                         .W = point->W + work(point, length, scale, (const double *)to_end, &guess),
                         .p = point->p + length,
                         .growth = point->growth};

  /* the estimate of its error */
  double error = 0;
  if (driving_slips)
    error += fabs(dot(HIGHEST, guess.za_x)) + fabs(dot(HIGHEST, guess.za_y));
  if (loaded)
    error += fabs(dot(HIGHEST, guess.zb_x)) + fabs(dot(HIGHEST, guess.zb_y));
  *advice = error * error / ((exact ? TOLERANCE_EXACT : TOLERANCE) * step->tolerance * length);
  if (!(*advice < 1))
    return INACCURATE;

  /* whether the regime has lasted to the end */
  events(&terms, &guess, driving_slips, values);
  const double event = largest(values), end = event_gap(&terms, &reached, driving_slips);
  const bool sticks = step->goal == AT_STICK || step->goal == AT_CLOTH_STICK;
  if (step->goal == AT_EVENT ? event > LATE
                             : event > EVENT_TOLERANCE || (end > EVENT_TOLERANCE && !sticks)) {
    *advice = first_event(&terms, point, step, scale, values, driving_slips);
    return EVENT_WITHIN;
  }

  /* where friction drives the slip on the cloth, an error of its direction grows by exp(int |H|
   * w / |b| dp) */
  if (loaded && terms.H_x < 0) {
    integrate_slip(point->b_x, point->b_y, guess.zb_x, guess.zb_y, slip_x, slip_y);
    normalise(slip_x, slip_y, false, inverse_b);
    EACH values[i] = step->z[i] * guess.w[i] * inverse_b[i];
    reached.growth -= scale * terms.H_x * dot(WEIGHT, values);
  }

  /* the variables that are exactly zero at the goal */
  if (step->goal == AT_STICK)
    reached.a_x = reached.a_y = 0;
  if (step->goal == AT_CLOTH_STICK)
    reached.b_x = reached.b_y = 0;
  if (step->goal == AT_END_OF_APPROACH ||
      (step->goal == AT_CLOTH_STICK && fabs(reached.v) < NEARLY_STOPPED))
    reached.v = 0;
  else if (step->goal != AT_WORK &&
           (step->restitution ? reached.W < step->least_work : reached.v < 0))
    return BEYOND_PHASE;

  /* a slip that takes no part has no direction: the plan did not set one */
  if (step->record != NULL)
    EACH {
      const int first = NODES / PARTS * i;
      const part none = splat(0);
      *(part_of_row *)&step->record->z[first] = (part_of_row)(scale * step->z[i]);
      *(part_of_row *)&step->record->p[first] = (part_of_row)(scale * step->p[i]);
      *(part_of_row *)&step->record->u_x[first] =
          (part_of_row)(driving_slips ? guess.u_x[i] : none);
      *(part_of_row *)&step->record->u_y[first] =
          (part_of_row)(driving_slips ? guess.u_y[i] : none);
      *(part_of_row *)&step->record->t_x[first] = (part_of_row)(loaded ? guess.t_x[i] : none);
      *(part_of_row *)&step->record->t_y[first] = (part_of_row)(loaded ? guess.t_y[i] : none);
    }
  *point = reached;
  return TAKEN;
}

#endif
