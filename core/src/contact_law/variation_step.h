/* The variational equations over one collocation step: variation.c has the method.
 *
 * With D = z da'/dphi and so on at the nodes, and the integrals M of step.h, the angles of all
 * slips solve
 *
 *     (|a| - u x M D_phi) dphi -        u x M D_psi  dpsi = u x (da_0 + M z da'/d parameter)
 *           -  t x M B_phi dphi + (|b| - t x M B_psi) dpsi = t x (db_0 + M z db'/d parameter)
 *
 * in blocks of eight: the first is inverted, and then its Schur complement, both without pivots
 * as in step.h. */
#ifndef CAROM_SRC_CONTACT_LAW_VARIATION_STEP_H
#define CAROM_SRC_CONTACT_LAW_VARIATION_STEP_H

#include "contact_law/step.h"

#include <stddef.h>

/* Found on the shots of seeds 7 and 28 of core/tests/agree/tangents.c, which reports errors for
 * another seed. With ESTIMATE = 3e-7 impacts on cushions take 6 % longer. With ESTIMATE in stiff
 * steps too, an error of 5e-5 remains; with ESTIMATE_STIFF = 1e-9 they take 3 % longer. With
 * ESTIMATE at stick, 1 of 1000 errors is above 1e-6 instead of 2e-7. With SHARE = 1, 1 of 100 is
 * above 1.4e-7 instead of 5e-8. */
static const double ESTIMATE = 1e-6;           /* square of the error estimate of a step,
                                                  relative; */
static const double ESTIMATE_STIFF = 1e-8;     /* of a stiff one, whose error at the end is not
                                                  of the order of the square; */
static const double ESTIMATE_AT_STICK = 1e-12; /* of one at whose end a slip is zero, where
                                                  solutions are not smooth */
static const double SHORTEST = 1e-8;           /* length of a step that is taken in any case */
static const double SHARE = 0.8;  /* of the longest step that slides: a longer one would often be
                                     refused, or be inaccurate */
static const double SMALL = 0.05; /* a slip that may turn fast: the change by a shift along
                                     the motion is split off */

/* Rates at the nodes times z, or their derivatives: of a_x, a_y, b_x, b_y, v. */
typedef nodes node_rates[5];

/* Eight times eight numbers: by columns of a matrix; and by rows of eight variables. */
typedef double matrix[NODES][NODES] __attribute__((aligned(PART_BYTES)));
typedef nodes table[NODES];
_Static_assert((int)CAROM_VARIABLES == (int)NODES, "both fill a vector");

/* A block of the matrix by columns: minus u x M D; of the slip whose angles these are too, |a|
 * on the diagonal, or NULL. */
always void block(const part *u_x, const part *u_y, const part *D_x, const part *D_y,
                  const part *length, matrix columns) {
  unrolled for (int j = 0; j < NODES; j++) {
    const part x = splat(AT(D_x, j)), y = splat(-AT(D_y, j));
    nodes column;
    EACH column[i] = PART(INTEGRAL[j], i) * madd(u_y[i], x, u_x[i] * y);
    if (length != NULL)
      AT(column, j) += AT(length, j);
    EACH((part_of_row *)columns[j])[i] = (part_of_row)column[i];
  }
}

/* |a| at the nodes: the component of a along u. */
always void lengths(double x, double y, const part *za_x, const part *za_y, const part *u_x,
                    const part *u_y, part *length) {
  nodes a_x, a_y;
  integrate_slip(x, y, za_x, za_y, a_x, a_y);
  EACH length[i] = madd(u_x[i], a_x[i], u_y[i] * a_y[i]);
}

/* z times the derivatives of the rates by the angles of u and of t, and by the parameters. */
always void node_derivatives(const carom_terms *k, const part *z, const part *u_x, const part *u_y,
                             const part *t_x, const part *t_y, const part *w, const part *per,
                             node_rates by_u, node_rates by_t) {
  EACH {
    const part w_u = k->w_u * u_x[i] * per[i], w_t = w[i] * k->w_t * t_x[i] * per[i];
    /* w t by the angles */
    const part x_u = w_u * t_x[i], y_u = w_u * t_y[i], x_t = w_t * t_x[i] - w[i] * t_y[i],
               y_t = w_t * t_y[i] + w[i] * t_x[i];
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
}

/* The parts of a vector over the variables that have parameters: the upper half. */
#define EACH_PARAMETER unrolled for (int i = PARTS / 2; i < PARTS; i++)
_Static_assert((int)BY_MU == NODES / 2, "the upper half");

/* z times the derivatives of the rates by the parameters, at each node over the variables. */
always void parameter_derivatives(const carom_terms *k, const carom_variation *g, const part *z,
                                  const part *u_x, const part *u_y, const part *t_x,
                                  const part *t_y, const part *w, const part *per,
                                  table *by_parameters) {
#define D(name) PART(g->d_terms[offsetof(carom_terms, name) / sizeof(double)], i)
  for (int j = 0; j < NODES; j++) {
    const part a_x = splat(AT(u_x, j)), a_y = splat(AT(u_y, j)), b_x = splat(AT(t_x, j)),
               b_y = splat(AT(t_y, j));
    const part w_j = splat(AT(w, j)), scale = splat(AT(z, j)), x = w_j * b_x, y = w_j * b_y,
               held = splat(AT(per, j));
    EACH_PARAMETER {
      const part d_w = madd(y, D(w_t), madd(a_y, D(w_u), D(w_0))) * held, d_x = d_w * b_x,
                 d_y = d_w * b_y;
      by_parameters[OF_A_X][j][i] = scale * madd(a_x, D(S_x), -madd(x, D(C_x), k->C_x * d_x));
      by_parameters[OF_A_Y][j][i] =
          scale * (madd(a_y, D(S_y), D(A_0)) - madd(y, D(C_y), k->C_y * d_y));
      by_parameters[OF_B_X][j][i] = scale * madd(a_x, D(R_x), -madd(x, D(H_x), k->H_x * d_x));
      by_parameters[OF_B_Y][j][i] =
          scale * (madd(a_y, D(R_y), D(B_0)) - madd(y, D(H_y), k->H_y * d_y));
      by_parameters[OF_V][j][i] =
          scale * (madd(a_y, D(V_u), D(V_0)) - madd(y, D(V_w), k->V_w * d_y));
    }
  }
#undef D
}

/* The product of a matrix by columns with a matrix by rows, whose numbers in a row belong to the
 * variables. */
always void multiply(matrix m, table f, table product) {
  for (int k = 0; k < NODES; k++) {
    nodes sum;
    EACH sum[i] = splat(m[0][k]) * f[0][i];
    unrolled for (int j = 1; j < NODES; j++) EACH sum[i] = madd(splat(m[j][k]), f[j][i], sum[i]);
    EACH product[k][i] = sum[i];
  }
}

/* u x (da_0 + M z da'), where `by` has z da' of the parameters. */
always void right_sides(nodes *d, table *by_parameters, int first, bool parameters, const part *u_x,
                        const part *u_y, table right) {
  for (int k = 0; k < NODES; k++) {
    nodes x, y;
    EACH {
      x[i] = d[first][i];
      y[i] = d[first + 1][i];
    }
    if (parameters)
      unrolled for (int j = 0; j < NODES; j++) EACH_PARAMETER {
        x[i] = madd(splat(INTEGRAL[j][k]), by_parameters[first][j][i], x[i]);
        y[i] = madd(splat(INTEGRAL[j][k]), by_parameters[first + 1][j][i], y[i]);
      }
    EACH right[k][i] = madd(splat(AT(u_x, k)), y[i], splat(-AT(u_y, k)) * x[i]);
  }
}

/* A step that was taken, at its nodes, and the derivatives of its rates there. */
typedef struct step_rates {
  nodes z, u_x, u_y, t_x, t_y, w, per; /* per: 1 over 1 - w_t t_y, of which w is a part */
  node_rates by_u, by_t;               /* by the angles */
  table by_parameters[5];              /* by the parameters, where there are any */
  bool driving_slips, loaded, parameters;
} step_rates;

/* The slip whose motion is split off, by its first row: one that is about to end, or is so small
 * that its direction may turn fast; -1: none. */
always int split_slip(const carom_point *start, bool driving_slips, bool loaded, int vanishes) {
  const double size_a = start->a_x * start->a_x + start->a_y * start->a_y,
               size_b = start->b_x * start->b_x + start->b_y * start->b_y;
  if (vanishes >= 0)
    return vanishes;
  if (driving_slips && size_a > 0 && size_a < SMALL * SMALL)
    return OF_A_X;
  if (loaded && size_b > 0 && size_b < SMALL * SMALL)
    return OF_B_X;
  return -1;
}

/* A shift along the motion, by alpha in p, is a solution. Takes its part from the derivatives d,
 * by the rates of the slip `split` at the start of the step. */
always void split_shift(const carom_trajectory *path, const carom_point *start, int split, nodes *d,
                        part *alpha) {
  const double begins[4] = {path->regime.u_x, path->regime.u_y, path->regime.t_x, path->regime.t_y};
  double lead[4], rate[CAROM_VARIED];
  carom_variation_leads(start, begins, lead);
  carom_variation_rates(&path->terms, lead, start->v, rate);
  const double x = rate[split], y = rate[split + 1], square = x * x + y * y;
  if (!(square > 0))
    return;
  EACH alpha[i] = (x * d[split][i] + y * d[split + 1][i]) / square;
  for (int r = 0; r < CAROM_VARIED; r++)
    EACH d[r][i] -= alpha[i] * rate[r];
}

always void take_rates(const carom_trajectory *path, bool driving_slips, step_rates *n) {
  const carom_variation *g = path->variation;
  const carom_kept_step *s = &g->record;
  const carom_terms *k = &path->terms;
  EACH {
    n->z[i] = PART(s->z, i);
    n->u_x[i] = PART(s->u_x, i);
    n->u_y[i] = PART(s->u_y, i);
    n->t_x[i] = PART(s->t_x, i);
    n->t_y[i] = PART(s->t_y, i);
    n->per[i] = 1 / (1 - k->w_t * n->t_y[i]);
    n->w[i] = (k->w_0 + k->w_u * n->u_y[i]) * n->per[i];
  }
  n->driving_slips = driving_slips;
  n->loaded = path->regime.loaded;
  n->parameters = (g->requests & CAROM_PARAMETERS) != 0;
  node_derivatives(k, n->z, n->u_x, n->u_y, n->t_x, n->t_y, n->w, n->per, n->by_u, n->by_t);
  if (n->parameters)
    parameter_derivatives(k, g, n->z, n->u_x, n->u_y, n->t_x, n->t_y, n->w, n->per,
                          n->by_parameters);
}

/* The inverse of the block of u, and phi as far as it does not depend on psi. */
always void solve_u(const carom_terms *k, const carom_point *start, step_rates *n, nodes *d,
                    matrix of_u, table phi) {
  table right;
  nodes rate_x, rate_y, along;
  EACH { /* the rates of the slip, z a' */
    rate_x[i] = n->z[i] * (k->S_x * n->u_x[i] - k->C_x * n->w[i] * n->t_x[i]);
    rate_y[i] = n->z[i] * (k->A_0 + k->S_y * n->u_y[i] - k->C_y * n->w[i] * n->t_y[i]);
  }
  lengths(start->a_x, start->a_y, rate_x, rate_y, n->u_x, n->u_y, along);
  block(n->u_x, n->u_y, n->by_u[OF_A_X], n->by_u[OF_A_Y], along, of_u);
  invert(of_u);
  right_sides(d, n->by_parameters, OF_A_X, n->parameters, n->u_x, n->u_y, right);
  multiply(of_u, right, phi);
}

/* Takes from the block and the right sides of t what phi takes from them: the Schur complement is
 * what remains of the block. of_ut becomes the product of the inverse and its block. */
always void eliminate_u(step_rates *n, matrix of_u, table phi, matrix of_ut, matrix of_t,
                        table right) {
  matrix of_tu;
  table share;
  block(n->u_x, n->u_y, n->by_t[OF_A_X], n->by_t[OF_A_Y], NULL, of_ut);
  block(n->t_x, n->t_y, n->by_u[OF_B_X], n->by_u[OF_B_Y], NULL, of_tu);

  /* column by column */
  for (int j = 0; j < NODES; j++) {
    nodes column, product;
    EACH column[i] = PART(of_ut[j], i);
    apply((const double(*)[NODES])of_u, column, product);
    EACH((part_of_row *)of_ut[j])[i] = (part_of_row)product[i];
    apply((const double(*)[NODES])of_tu, product, column);
    EACH((part_of_row *)of_t[j])[i] -= (part_of_row)column[i];
  }

  /* likewise of the right sides */
  multiply(of_tu, phi, share);
  for (int j = 0; j < NODES; j++)
    EACH right[j][i] -= share[j][i];
}

/* psi by the Schur complement, and what psi takes from phi. */
always void solve_t(const carom_terms *k, const carom_point *start, step_rates *n, nodes *d,
                    matrix of_u, table phi, table psi) {
  matrix of_t, of_ut;
  table right;
  nodes rate_x, rate_y, along;
  EACH { /* the rates of the slip, z b' */
    rate_x[i] = n->z[i] * (k->R_x * n->u_x[i] - k->H_x * n->w[i] * n->t_x[i]);
    rate_y[i] = n->z[i] * (k->B_0 + k->R_y * n->u_y[i] - k->H_y * n->w[i] * n->t_y[i]);
  }
  lengths(start->b_x, start->b_y, rate_x, rate_y, n->t_x, n->t_y, along);
  block(n->t_x, n->t_y, n->by_t[OF_B_X], n->by_t[OF_B_Y], along, of_t);
  right_sides(d, n->by_parameters, OF_B_X, n->parameters, n->t_x, n->t_y, right);
  if (n->driving_slips)
    eliminate_u(n, of_u, phi, of_ut, of_t, right);
  invert(of_t);
  multiply(of_t, right, psi);
  if (!n->driving_slips)
    return;
  multiply(of_ut, psi, right);
  for (int j = 0; j < NODES; j++)
    EACH phi[j][i] -= right[j][i];
}

/* The changes of all rows over the step, by quadrature, where `end` of W begins as the change that
 * v brings about. Returns the estimate of the error, relative: that of the solver, the coefficient
 * of the highest Legendre polynomial of the rates. */
always double integrate_rates(const carom_variation *g, step_rates *n, double length, table phi,
                              table psi, nodes *end) {
  /* weights of the integral of an integral, which W is */
  double to_end[NODES];
  for (int j = 0; j < NODES; j++)
    to_end[j] = WEIGHT[j] * (length - g->record.p[j]);
  nodes size, error;
  EACH {
    size[i] = splat(1e-300);
    error[i] = splat(0);
  }

  /* each rate at the nodes, by all that it depends on: its sum, and its highest coefficient */
  for (int r = 0; r < 5; r++) {
    nodes highest;
    EACH end[r][i] = highest[i] = splat(0);
    for (int j = 0; j < NODES; j++) {
      nodes x;
      EACH x[i] = splat(0);
      if (n->parameters)
        EACH_PARAMETER x[i] = n->by_parameters[r][j][i];
      if (n->driving_slips)
        EACH x[i] = madd(splat(AT(n->by_u[r], j)), phi[j][i], x[i]);
      if (n->loaded)
        EACH x[i] = madd(splat(AT(n->by_t[r], j)), psi[j][i], x[i]);

      /* the sums, and for W that of v once more */
      EACH {
        end[r][i] = madd(splat(WEIGHT[j]), x[i], end[r][i]);
        highest[i] = madd(splat(HIGHEST[j]), x[i], highest[i]);
        if (r == OF_V)
          end[OF_W][i] = madd(splat(to_end[j]), x[i], end[OF_W][i]);
      }
    }

    /* the largest derivative of all rows, and the largest coefficient */
    EACH {
      size[i] = greater(greater(magnitude(PART(g->d[r], i)), magnitude(end[r][i])), size[i]);
      error[i] = greater(magnitude(highest[i]), error[i]);
    }
  }
  EACH error[i] /= size[i];
  return largest(error);
}

/* The largest square of the estimate of an error with which a step is accepted. */
always double limit_of_step(bool stiff, int vanishes) {
  if (vanishes >= 0)
    return ESTIMATE_AT_STICK;
  return stiff ? ESTIMATE_STIFF : ESTIMATE;
}

/* The rates at the end, which the next step needs. The direction of a slip that is zero there is
 * that of the polynomial. */
always void take_end_rates(carom_trajectory *path, const step_rates *n) {
  carom_variation *g = path->variation;
  const double last[4] = {dot(AT_END, n->u_x), dot(AT_END, n->u_y), dot(AT_END, n->t_x),
                          dot(AT_END, n->t_y)};
  carom_variation_leads(&path->point, last, g->lead);
  carom_variation_rates(&path->terms, g->lead, path->point.v, g->rate);
}

/* After a step from `start`: see variation.h. Vectors over the nodes, and those over the
 * variables, have eight numbers. */
static double variation_step(carom_trajectory *path, const carom_point *start, bool driving_slips,
                             bool stiff, int vanishes) {
  carom_variation *g = path->variation;
  const double length = path->point.p - start->p;
  carom_variation_begin_regime(path);

  /* the derivatives at the start, without a shift along the motion */
  nodes alpha, d[CAROM_VARIED];
  for (int r = 0; r < CAROM_VARIED; r++)
    EACH d[r][i] = PART(g->d[r], i);
  EACH alpha[i] = splat(0);
  const int split = split_slip(start, driving_slips, path->regime.loaded, vanishes);
  if (split >= 0)
    split_shift(path, start, split, d, alpha);

  /* the angles: of u as if t did not change, of t by the Schur complement, and the change of u
   * by t */
  step_rates n;
  matrix of_u;
  table phi, psi;
  take_rates(path, driving_slips, &n);
  if (n.driving_slips)
    solve_u(&path->terms, start, &n, d, of_u, phi);
  if (n.loaded)
    solve_t(&path->terms, start, &n, d, of_u, phi, psi);

  /* refused where the estimate is too large, and the step can be shorter */
  nodes end[CAROM_VARIED];
  EACH end[OF_W][i] = length * d[OF_V][i];
  const double error = integrate_rates(g, &n, length, phi, psi, end);
  const double worst = error * error / limit_of_step(stiff, vanishes);
  if (worst > 1 && length > SHORTEST)
    return worst;

  /* the derivatives at the end, with the shift along the motion there */
  take_end_rates(path, &n);
  double sum = 0;
  for (int r = 0; r < CAROM_VARIED; r++) {
    EACH {
      d[r][i] += end[r][i] + alpha[i] * g->rate[r];
      *(part_of_row *)&g->d[r][NODES / PARTS * i] = (part_of_row)d[r][i];
    }
    sum += dot(WEIGHT, d[r]);
  }
  g->lost |= !(fabs(sum) < INFINITY);
  return 0;
}

#endif
