/* The variational equations over one collocation step: variation.c has the method.
 *
 * With D = z da'/dphi and so on at the nodes, and the integrals M of step.h, the angles of all slips solve
 *
 *     (|a| - u x M D_phi) dphi -        u x M D_psi  dpsi = u x (da_0 + M z da'/d parameter)
 *           -  t x M B_phi dphi + (|b| - t x M B_psi) dpsi = t x (db_0 + M z db'/d parameter)
 *
 * in blocks of eight: the first is inverted, and then its Schur complement, both without pivots as in step.h. */
#ifndef CAROM_SRC_IMPACT_VARIATION_STEP_H
#define CAROM_SRC_IMPACT_VARIATION_STEP_H

#include "impact/step.h"

#include <string.h>

/* With 20,000 impacts of shots (`build/tests/test_tangents` prints their errors): */
static const double ESTIMATE = 1e-6; /* square of the error estimate of a step, relative */
static const double SHORTEST = 1e-8; /* length of a step that is taken in any case */
static const double SMALL = 0.05;    /* a slip that may turn fast: what a shift along the motion changes is split off */

/* Rates at the nodes times z, or their derivatives: of a_x, a_y, b_x, b_y, v. */
typedef nodes node_rates[5];

typedef double matrix[NODES][NODES] __attribute__((aligned(PART_BYTES)));

/* A block of the matrix by columns: minus u x M D. */
always void block(const part *u_x, const part *u_y, const part *D_x, const part *D_y, matrix to) {
  for (int j = 0; j < NODES; j++) {
    const double x = AT(D_x, j), y = AT(D_y, j);
    EACH((part_of_row *)to[j])[i] = (part_of_row)(PART(INTEGRAL[j], i) * (u_y[i] * splat(x) - u_x[i] * splat(y)));
  }
}

/* z times the derivatives of the rates by the angles of u and of t, and by the parameters. */
always void node_derivatives(const carom_terms *k, const carom_variation *g, const part *z, const part *u_x, const part *u_y,
                             const part *t_x, const part *t_y, const part *w, const part *per, node_rates by_u,
                             node_rates by_t) {
  EACH {
    const part w_u = k->w_u * u_x[i] * per[i], w_t = w[i] * k->w_t * t_x[i] * per[i];
    /* w t by the angles */
    const part x_u = w_u * t_x[i], y_u = w_u * t_y[i], x_t = w_t * t_x[i] - w[i] * t_y[i], y_t = w_t * t_y[i] + w[i] * t_x[i];
    by_u[0][i] = z[i] * (-k->S_x * u_y[i] - k->C_x * x_u);
    by_u[1][i] = z[i] * (k->S_y * u_x[i] - k->C_y * y_u);
    by_u[2][i] = z[i] * (-k->R_x * u_y[i] - k->H_x * x_u);
    by_u[3][i] = z[i] * (k->R_y * u_x[i] - k->H_y * y_u);
    by_u[4][i] = z[i] * (k->V_u * u_x[i] - k->V_w * y_u);
    by_t[0][i] = z[i] * (-k->C_x * x_t);
    by_t[1][i] = z[i] * (-k->C_y * y_t);
    by_t[2][i] = z[i] * (-k->H_x * x_t);
    by_t[3][i] = z[i] * (-k->H_y * y_t);
    by_t[4][i] = z[i] * (-k->V_w * y_t);
  }
  (void)g;
}

/* z times the derivatives of the rates by a parameter, which changes the coefficients by *d. */
always void parameter_derivatives(const carom_terms *k, const carom_terms *d, const part *z, const part *u_x, const part *u_y,
                                  const part *t_x, const part *t_y, const part *w, const part *per, node_rates by) {
  EACH {
    const part d_w = (d->w_0 + d->w_u * u_y[i] + w[i] * d->w_t * t_y[i]) * per[i];
    const part x = w[i] * t_x[i], y = w[i] * t_y[i], d_x = d_w * t_x[i], d_y = d_w * t_y[i];
    by[0][i] = z[i] * (d->S_x * u_x[i] - d->C_x * x - k->C_x * d_x);
    by[1][i] = z[i] * (d->A_0 + d->S_y * u_y[i] - d->C_y * y - k->C_y * d_y);
    by[2][i] = z[i] * (d->R_x * u_x[i] - d->H_x * x - k->H_x * d_x);
    by[3][i] = z[i] * (d->B_0 + d->R_y * u_y[i] - d->H_y * y - k->H_y * d_y);
    by[4][i] = z[i] * (d->V_0 + d->V_u * u_y[i] - d->V_w * y - k->V_w * d_y);
  }
}

/* |a| at the nodes, the component of a along u, on the diagonal. */
always void add_length(double x, double y, const part *za_x, const part *za_y, const part *u_x, const part *u_y, matrix to) {
  nodes a_x, a_y, along;
  integrate_slip(x, y, za_x, za_y, a_x, a_y);
  EACH along[i] = u_x[i] * a_x[i] + u_y[i] * a_y[i];
  for (int j = 0; j < NODES; j++)
    to[j][j] += AT(along, j);
}

/* u x (da_0 + M z da') */
always void right_side(double dx, double dy, const part *z_x, const part *z_y, bool changes, const part *u_x, const part *u_y,
                       part *to) {
  nodes x, y;
  EACH {
    x[i] = splat(dx);
    y[i] = splat(dy);
  }
  if (changes)
    integrate_slip(dx, dy, z_x, z_y, x, y);
  EACH to[i] = u_x[i] * y[i] - u_y[i] * x[i];
}

/* After a step from `before`: see variation.h. */
static double variation_step(carom_trajectory *path, const carom_point *before, bool driving_slips, int vanishes) {
  carom_variation *g = path->variation;
  const carom_kept_step *s = &g->kept;
  const carom_terms *k = &path->terms;
  const bool loaded = path->regime.loaded;
  const double length = path->at.p - before->p;
  carom_variation_begin_regime(path);
  /* a shift along the motion, by alpha in p, is a solution; what it makes of da is split off where the slip is about to end or
   * is so small that its direction may turn fast */
  double alpha[CAROM_VARIABLES] = {0}, rest[CAROM_VARIED][CAROM_VARIABLES];
  memcpy(rest, g->d, sizeof rest);
  int split = vanishes;
  const double size_a = before->a_x * before->a_x + before->a_y * before->a_y,
               size_b = before->b_x * before->b_x + before->b_y * before->b_y;
  if (split < 0 && driving_slips && size_a > 0 && size_a < SMALL * SMALL)
    split = OF_A_X;
  else if (split < 0 && loaded && size_b > 0 && size_b < SMALL * SMALL)
    split = OF_B_X;
  if (split >= 0) {
    const double begins[4] = {path->regime.u_x, path->regime.u_y, path->regime.t_x, path->regime.t_y};
    double lead[4], rate[CAROM_VARIED];
    carom_variation_leads(before, begins, lead);
    carom_variation_rates(k, lead, before->v, rate);
    const double x = rate[split], y = rate[split + 1], square = x * x + y * y;
    for (int n = 0; n < g->columns && square > 0; n++) {
      const int c = g->column[n];
      alpha[c] = (x * g->d[split][c] + y * g->d[split + 1][c]) / square;
      for (int r = 0; r < CAROM_VARIED; r++)
        rest[r][c] -= alpha[c] * rate[r];
    }
  }
  /* the step at the nodes, and the derivatives of the rates */
  nodes z, to_end, u_x, u_y, t_x, t_y, w, per;
  EACH {
    z[i] = PART(s->z, i);
    u_x[i] = PART(s->u_x, i);
    u_y[i] = PART(s->u_y, i);
    t_x[i] = PART(s->t_x, i);
    t_y[i] = PART(s->t_y, i);
    per[i] = 1 / (1 - k->w_t * t_y[i]);
    w[i] = (k->w_0 + k->w_u * u_y[i]) * per[i];
    to_end[i] = PART(WEIGHT, i) * (length - PART(s->p, i));
  }
  node_rates by_u, by_t, by[3];
  node_derivatives(k, g, z, u_x, u_y, t_x, t_y, w, per, by_u, by_t);
  for (int n = 0; n < 3; n++)
    if (g->asked >> CAROM_PARAMETER[n] & 1)
      parameter_derivatives(k, &g->d_terms[n], z, u_x, u_y, t_x, t_y, w, per, by[n]);
  /* the matrix, by blocks */
  matrix of_u, of_t, of_ut, of_tu;
  nodes rate_x, rate_y;
  if (driving_slips) {
    EACH {
      rate_x[i] = z[i] * (k->S_x * u_x[i] - k->C_x * w[i] * t_x[i]);
      rate_y[i] = z[i] * (k->A_0 + k->S_y * u_y[i] - k->C_y * w[i] * t_y[i]);
    }
    block(u_x, u_y, by_u[0], by_u[1], of_u);
    add_length(before->a_x, before->a_y, rate_x, rate_y, u_x, u_y, of_u);
    invert(of_u);
  }
  if (loaded) {
    EACH {
      rate_x[i] = z[i] * (k->R_x * u_x[i] - k->H_x * w[i] * t_x[i]);
      rate_y[i] = z[i] * (k->B_0 + k->R_y * u_y[i] - k->H_y * w[i] * t_y[i]);
    }
    block(t_x, t_y, by_t[2], by_t[3], of_t);
    add_length(before->b_x, before->b_y, rate_x, rate_y, t_x, t_y, of_t);
    if (driving_slips) {
      /* of_ut becomes the product of the inverse and its block */
      block(u_x, u_y, by_t[0], by_t[1], of_ut);
      block(t_x, t_y, by_u[2], by_u[3], of_tu);
      for (int j = 0; j < NODES; j++) {
        nodes column, product;
        EACH column[i] = PART(of_ut[j], i);
        apply((const double(*)[NODES])of_u, column, product);
        EACH((part_of_row *)of_ut[j])[i] = (part_of_row)product[i];
        apply((const double(*)[NODES])of_tu, product, column);
        EACH((part_of_row *)of_t[j])[i] -= (part_of_row)column[i];
      }
    }
    invert(of_t);
  }
  /* each column, and its end by quadrature; W is the integral of an integral. The estimate of the error is that of the solver:
   * the coefficient of the highest Legendre polynomial of the rates */
  double ends[CAROM_VARIABLES][CAROM_VARIED], worst = 0;
  for (int n = 0; n < g->columns; n++) {
    const int c = g->column[n], parameter = c < BY_MU ? -1 : c == BY_MU ? 0 : c == BY_MU_C ? 1 : 2;
    const bool changes = parameter >= 0;
    nodes *b = by[changes ? parameter : 0];
    nodes phi, psi, right, d;
    EACH phi[i] = psi[i] = splat(0);
    if (driving_slips) {
      right_side(rest[OF_A_X][c], rest[OF_A_Y][c], b[0], b[1], changes, u_x, u_y, right);
      apply((const double(*)[NODES])of_u, right, phi);
    }
    if (loaded) {
      right_side(rest[OF_B_X][c], rest[OF_B_Y][c], b[2], b[3], changes, t_x, t_y, right);
      if (driving_slips) {
        apply((const double(*)[NODES])of_tu, phi, d);
        EACH right[i] -= d[i];
      }
      apply((const double(*)[NODES])of_t, right, psi);
      if (driving_slips) {
        apply((const double(*)[NODES])of_ut, psi, d);
        EACH phi[i] -= d[i];
      }
    }
    double size = 0, error = 0;
    for (int r = 0; r < 5; r++) {
      EACH {
        d[i] = changes ? b[r][i] : splat(0);
        if (driving_slips)
          d[i] = madd(by_u[r][i], phi[i], d[i]);
        if (loaded)
          d[i] = madd(by_t[r][i], psi[i], d[i]);
      }
      const double end = dot(WEIGHT, d), highest = fabs(dot(HIGHEST, d));
      const double reaches = fabs(g->d[r][c]) > fabs(end) ? fabs(g->d[r][c]) : fabs(end);
      ends[c][r] = end;
      size = reaches > size ? reaches : size;
      error = highest > error ? highest : error;
    }
    ends[c][OF_W] = length * rest[OF_V][c] + dot((const double *)to_end, d);
    g->lost |= !(error < INFINITY);
    worst = size > 0 && error > worst * size ? error / size : worst;
  }
  if (worst * worst > ESTIMATE && length > SHORTEST)
    return worst * worst / ESTIMATE;
  /* what follows needs the rates at the end; the direction of a slip that is zero there is that of the polynomial */
  const double last[4] = {dot(AT_END, u_x), dot(AT_END, u_y), dot(AT_END, t_x), dot(AT_END, t_y)};
  carom_variation_leads(&path->at, last, g->lead);
  carom_variation_rates(k, g->lead, path->at.v, g->rate);
  for (int n = 0; n < g->columns; n++) {
    const int c = g->column[n];
    for (int r = 0; r < CAROM_VARIED; r++)
      g->d[r][c] = rest[r][c] + ends[c][r] + alpha[c] * g->rate[r];
  }
  return 0;
}

#endif
