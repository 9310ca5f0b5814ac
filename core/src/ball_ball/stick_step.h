/* The step in the slip between the balls, to where they stick.
 *
 * With u_z = u_z0 lambda^5, lambda falls from 1 to 0. Nothing can be overshot, and functions
 * singular in p are smooth in lambda. With tau = t / (kappa + mu t_y) and W = u_x / lambda^5 the
 * equations of reduced.h become
 *
 *     p = 2 / (mu_b kappa) int lambda^4 sqrt(u_z0^2 + W^2) (1 - mu tau_y)
 *     F = -2 mu u_z0 int lambda^4 tau
 *     lambda W' = 2 W - mu (7 tau_y W - 2 u_z0 tau_x)
 *
 * integrals from lambda to 1. For a constant tau = tau_s, W is W_s = A + (u_x0 - A) lambda^(2 -
 * b) with b = 7 mu tau_sy and A = 2 mu u_z0 tau_sx / (b - 2). By variation of constants a tau
 * that differs from tau_s gives W = W_s - lambda^(2 - b) T,
 *
 *     T = 2 mu int lambda^(b - 3) (u_z0 (tau_x - tau_sx) - 7/2 (tau_y - tau_sy) W)
 *
 * tau_s is the tau where the balls stick, since the difference must vanish there.
 *
 * The predictor moves d along a straight line. For W at a node it takes the formula W_s with the
 * tau of a point between: the weighted mean of tau up to the node. The iteration takes tau to T
 * and W at the nodes, both to p and F, these to d, and d to a new tau; the impulses between the
 * balls follow from u and F. Behind stick no more work is done on friction, and the end of the
 * collision has a closed form.
 *
 * The rule has the weight lambda^4 built in (Gauss and Jacobi). */
#ifndef CAROM_SRC_BALL_BALL_STICK_STEP_H
#define CAROM_SRC_BALL_BALL_STICK_STEP_H

#include "ball_ball/problem.h"
#include "ball_ball/quadrature.h"

enum { STICK_NODES = 6 };
enum { STICK_LEAST = 2, STICK_MOST = 5 }; /* iterations; the first does not change W */
/* The error after an iteration of a step to stick, over its move, at least and by mu. With twice
 * or half of each,
 * `carom-lab stress --draws 60000` shows the same errors and times. */
static const real CONTRACTION_STICK = REAL(0.05);
static const real CONTRACTION_STICK_MU = REAL(0.25);

/* tau at the nodes, from d there. */
always void tau_of(const problem *a, reg d_x, reg d_y, reg *tau_x, reg *tau_y) {
  const reg i_d = reg_reciprocal_sqrt(MADD(d_x, d_x, MADD(d_y, d_y, TINY))), t_y = d_y * i_d;
  const reg per = reg_reciprocal(MADD(a->mu, t_y, a->kappa));
  *tau_x = (d_x * i_d) * per;
  *tau_y = t_y * per;
}

/* K at v = 0 on the step, given v where the balls stick, the mean of f, and at the nodes W,
 * tau_y and slope = v' / lambda^4.
 *
 * v = 0 is found on the polynomial through the slopes: v is its value at stick less lambda^5
 * times a polynomial. From the start to there Gauss's rule, with the slopes not of that
 * polynomial but of those through W and tau_y, which are smoother. */
always vreal K_at_v_0_to_stick(const problem *a, const stick_rule *r, const state *s, vreal c,
                               vreal v, const reg *slope, const reg *W, const reg *tau_y,
                               vreal u_z2, vreal per_p, vreal per_f, vreal f) {
  enum { n = STICK_NODES };
  /* the polynomials through the nodes: v' / lambda^4, tau_y, W */
  vreal v_power[MOST_NODES], tau_power[MOST_NODES], W_power[MOST_NODES];
  sum_polynomials(r->powers, n, slope, v_power);
  sum_polynomials(r->basis, n, tau_y, tau_power);
  sum_polynomials(r->basis, n, W, W_power);

  /* |u| falls as lambda^(5 + 2 c^2) at first and more slowly then, so Newton's method converges
   * from one side */
  const vreal left = v_max(v * v_reciprocal(v - s->v), v_splat(REAL(1e-10))),
              power = v_reciprocal(v_fma(2 * c, c, v_splat(5)));
  vreal x_c = v_min(1 - ONE_OF(exponential(SPREAD(power) * logarithm(SPREAD(left)))), v_splat(1));

  /* two of its steps for x = 1 - lambda at v = 0 */
  for (int i = 0; i < 2; i++) {
    const vreal l = 1 - x_c, l4 = (l * l) * (l * l);
    vreal sum_slope;
    const vreal sum = polynomial_and_slope(v_power, n, 2 * l - 1, &sum_slope),
                v_c = v_fma(-l4 * l, sum, v);
    const vreal rise = v_max(l4 * v_fma(2 * l, sum_slope, 5 * sum), v_splat(TINY));
    x_c = v_min(v_max(x_c - v_c * v_reciprocal(rise), v_splat(0)), v_splat(1));
  }

  /* v' and tau at the nodes of Gauss's rule from the start to there */
  reg dv[MOST_REGS], tau[MOST_REGS], on_way[MOST_REGS], part[MOST_REGS];
  EACH_REG(k, n) {
    const reg l = MADD(-x_c, AT(gauss_6.node, k), REAL(1.0)), l4 = (l * l) * (l * l), t = 2 * l - 1;
    const reg W_k = polynomial_at_nodes(W_power, n, t),
              tau_k = polynomial_at_nodes(tau_power, n, t);
    dv[k] = (x_c * l4) * MADD(per_p * reg_root(MADD(W_k, W_k, u_z2)),
                              MADD(-a->mu, tau_k, REAL(1.0)), -per_f * tau_k);
    tau[k] = (x_c * l4) * tau_k;
  }

  /* v at those nodes; K = int v f dp up to there, and the little that is left for a mean f */
  apply(gauss_6.sum, dv, on_way, n);
  EACH_REG(k, n) part[k] = tau[k] * (s->v + on_way[k]);
  const vreal v_c = s->v + dot(gauss_6.whole, dv, n);
  return v_fma(per_f, dot(gauss_6.whole, part, n), s->K) -
         REAL(0.5) * f * v_c * v_c * v_reciprocal(1 - f);
}

/* From *s, where *g has been predicted for the way to stick. Returns an estimate of the error,
 * in p; infinite if the collision ends before the balls stick. */
always vreal stick_step(const problem *a, const prediction *g, const state *s, solution *out) {
  enum { n = STICK_NODES };
  const stick_rule *r = &jacobi_6;
  const vreal u_z = s->u_z, mu = a->mu, to_stick = v_reciprocal(g->rate), zero = v_splat(0),
              u_z2 = v_fma(u_z, u_z, v_splat(TINY));

  /* factors of the integrals in p, F, v and Q_1, Q_2 */
  const vreal per_mu_b = v_reciprocal(a->mu_b), per_p = 2 * a->per_kappa * per_mu_b;
  const vreal per_F = -2 * mu * u_z, per_f = per_F * a->per_kappa,
              per_x = a->per_kappa * (1 / REAL(3.5)), per_z = a->per_kappa * REAL(0.4);

  /* by how much friction of the balls and p change d up to stick, at the present rates; and the
   * factor of F in d */
  const vreal d_change_x = to_stick * (a->mu_b * g->c),
              d_change_y = to_stick * v_fma(-a->spin * a->mu_b, g->z, v_splat(1));
  const real F_in_d = 1 - a->spin;

  /* tau_s, from d at stick; b and A of W_s */
  const vreal d_stick_x = s->d_x - d_change_x, d_stick_y = s->d_y - d_change_y,
              inverse_d = inverse_length(d_stick_x, d_stick_y);
  const vreal per_stick = v_reciprocal(v_fma(mu, d_stick_y * inverse_d, a->kappa)),
              mean_x = (d_stick_x * inverse_d) * per_stick,
              mean_y = (d_stick_y * inverse_d) * per_stick;
  const vreal b = 7 * mu * mean_y, A = (2 * mu * u_z) * mean_x * v_reciprocal(b - 2);

  reg tau_x[MOST_REGS], tau_y[MOST_REGS], lambda_5[MOST_REGS], W[MOST_REGS],
      W_homogeneous[MOST_REGS], lambda_b[MOST_REGS], T_factor[MOST_REGS];
  EACH_REG(k, n) {
    const reg l2 = SPREAD(AT(r->lambda_2, k)), log_l = SPREAD(AT(r->log, k)),
              passed = SPREAD(AT(r->gone, k));
    lambda_5[k] = SPREAD(AT(r->lambda_5, k));
    /* tau that d has reached along the straight line at this lambda */
    tau_of(a, MADD(-passed, d_change_x, s->d_x), MADD(-passed, d_change_y, s->d_y), &tau_x[k],
           &tau_y[k]);
    /* lambda^-b; the factor of T's integrand, whose rule has lambda^-3 and the factor lambda^2
     * built in; and W_s */
    lambda_b[k] = exponential(-(b * log_l));
    T_factor[k] = mu * reg_reciprocal(lambda_b[k]);
    W_homogeneous[k] = MADD(s->u_x - A, l2 * lambda_b[k], A);
    /* the predictor of W: tau has the weight lambda^-3 in W, so that the mean of a linear tau
     * is at 2 lambda / (1 + lambda)
     */
    const reg passed_mean = SPREAD(AT(r->gone_mean, k));
    reg mean_tau_x, mean_tau_y;
    tau_of(a, MADD(-passed_mean, d_change_x, s->d_x), MADD(-passed_mean, d_change_y, s->d_y),
           &mean_tau_x, &mean_tau_y);
    const reg b_k = (7 * mu) * mean_tau_y,
              A_k = (2 * mu * u_z) * mean_tau_x * reg_reciprocal(b_k - 2);
    W[k] = MADD(s->u_x - A_k, l2 * exponential(-(b_k * log_l)), A_k);
  }

  reg slope[MOST_REGS], Y[MOST_REGS];
  EACH_REG(k, n) Y[k] = SPREAD(REAL(0.0));
  vmask going = v_all();
  vreal error = zero;
  lanes_rolled for (int i = 0; i < STICK_MOST; i++) {
    reg P[MOST_REGS], X[MOST_REGS], new_Y[MOST_REGS], moved[MOST_REGS];
    /* W by T; the predictor's W is better than one from its tau */
    if (i > 0) {
      reg rest[MOST_REGS], T[MOST_REGS];
      EACH_REG(k, n)
      rest[k] = T_factor[k] * MADD(u_z, tau_x[k] - mean_x, REAL(-3.5) * (tau_y[k] - mean_y) * W[k]);
      apply(r->turn, rest, T, n);
      EACH_REG(k, n) REG_MOVE(going, &W[k], MADD(-lambda_b[k], T[k], W_homogeneous[k]));
    }
    /* the integrals of p and F up to each node */
    EACH_REG(k, n) slope[k] = reg_root(MADD(W[k], W[k], u_z2)) * MADD(-mu, tau_y[k], REAL(1.0));
    apply(r->sum, slope, P, n);
    apply(r->sum, tau_x, X, n);
    apply(r->sum, tau_y, new_Y, n);
    EACH_REG(k, n) {
      /* Q_1 and Q_2 follow from the loss of u and from F; then d, and the new tau */
      const reg F_x = per_F * X[k], F_y = per_F * new_Y[k];
      const reg Q_1 = per_x * (MADD(-lambda_5[k], W[k], s->u_x) + F_x),
                Q_2 = per_z * MADD(REAL(2.5), F_y, MADD(-lambda_5[k], u_z, u_z));
      reg new_x, new_y;
      tau_of(a, s->d_x + MADD(F_in_d, F_x, -Q_1),
             MADD(-per_p, P[k], s->d_y) + MADD(a->spin, Q_2, F_in_d * F_y), &new_x, &new_y);
      moved[k] = mu * u_z * (reg_abs(new_x - tau_x[k]) + reg_abs(new_y - tau_y[k]));
      REG_MOVE(going, &tau_x[k], new_x);
      REG_MOVE(going, &tau_y[k], new_y);
      REG_MOVE(going, &Y[k], new_Y[k]);
    }
    /* the error that is left, and whether any lane needs another iteration */
    if (i + 1 < STICK_LEAST)
      continue;
    const vreal left =
        v_max(v_splat(CONTRACTION_STICK), CONTRACTION_STICK_MU * mu) * largest(moved, n);
    error = v_select(going, left, error);
    going = going & v_not(v_less(left, ITERATION_SHARE * a->tolerance));
    if (!v_any(going))
      break;
  }

  /* over the complete step: p, F and v, with v' / lambda^4 at the nodes */
  reg work[MOST_REGS], slope_v[MOST_REGS];
  EACH_REG(k, n) {
    slope[k] = reg_root(MADD(W[k], W[k], u_z2)) * MADD(-mu, tau_y[k], REAL(1.0));
    slope_v[k] = MADD(per_p, slope[k], -per_f * tau_y[k]);
    work[k] = Y[k] * slope_v[k];
  }
  const vreal X_sum = dot(r->whole, tau_x, n), Y_sum = dot(r->whole, tau_y, n),
              p = per_p * dot(r->whole, slope, n);

  /* K by parts, since slope bends where W is about u_z, and tau does not */
  const vreal v = s->v + (p - per_f * Y_sum),
              K = v_fma(per_f, v_fma(v, Y_sum, -dot(r->whole, work, n)), s->K);

  /* F = -mu mu_b I */
  const vreal weight = 2 * u_z * per_mu_b;

  /* K at v = 0; behind stick K does not change */
  const vmask passes = v_not(s->restitution) & v_less(zero, v);
  vreal K_c = v_select(s->restitution, s->K_c, K);
  if (v_any(passes))
    K_c = v_select(passes,
                   K_at_v_0_to_stick(a, r, s, g->c, v, slope_v, W, tau_y, u_z2, per_p, per_f,
                                     per_f * Y_sum * v_reciprocal(p)),
                   K_c);

  /* the collision must not end before stick, and stick must be about where it was expected */
  const vreal returned = work_returned(a, K_c, K),
              v_end = v_sqrt(v_max(v_fma(a->e, a->e, returned), zero)), share = p * g->rate;
  const vmask in_reach =
      v_less_equal(v, v_end) & v_less(v_splat(REAL(0.3)), share) & v_less(share, v_splat(3));

  /* the solution: v at the end by the balance of work, p beyond 1 + e by v_n = v_n0 + kappa p -
   * F_y */
  out->J_c = out->J_z = zero;
  out->I_x = v_fma(weight, X_sum, s->I_x);
  out->I_y = v_fma(weight, Y_sum, s->I_y);
  out->K_c = K_c;
  out->overshoot = returned * v_reciprocal(v_end + a->e) - a->mu_mu_b_y * out->I_y;
  out->stick = v_max(1 + v - a->mu_mu_b_y * out->I_y, zero);
  return v_select(in_reach, error, v_splat(HUGE_VALF));
}

#endif
