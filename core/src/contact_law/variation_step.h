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
                                     rejected, or be inaccurate */
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
  unrolled for (int node = 0; node < NODES; node++) {
    const part x = splat(AT(D_x, node)), y = splat(-AT(D_y, node));
    nodes column;
    EACH column[i] = PART(INTEGRAL[node], i) * madd(u_y[i], x, u_x[i] * y);
    if (length != NULL)
      AT(column, node) += AT(length, node);
    EACH((part_of_row *)columns[node])[i] = (part_of_row)column[i];
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
always void node_derivatives(const carom_terms *terms, const part *z, const part *u_x,
                             const part *u_y, const part *t_x, const part *t_y, const part *w,
                             const part *per, node_rates by_u, node_rates by_t) {
  EACH {
    const part w_u = terms->w_u * u_x[i] * per[i], w_t = w[i] * terms->w_t * t_x[i] * per[i];
    /* w t by the angles */
    const part x_u = w_u * t_x[i], y_u = w_u * t_y[i], x_t = w_t * t_x[i] - w[i] * t_y[i],
               y_t = w_t * t_y[i] + w[i] * t_x[i];
    by_u[0][i] = z[i] * (-terms->S_x * u_y[i] - terms->C_x * x_u);
    by_u[1][i] = z[i] * (terms->S_y * u_x[i] - terms->C_y * y_u);
    by_u[2][i] = z[i] * (-terms->R_x * u_y[i] - terms->H_x * x_u);
    by_u[3][i] = z[i] * (terms->R_y * u_x[i] - terms->H_y * y_u);
    by_u[4][i] = z[i] * (terms->V_u * u_x[i] - terms->V_w * y_u);
    by_t[0][i] = z[i] * (-terms->C_x * x_t);
    by_t[1][i] = z[i] * (-terms->C_y * y_t);
    by_t[2][i] = z[i] * (-terms->H_x * x_t);
    by_t[3][i] = z[i] * (-terms->H_y * y_t);
    by_t[4][i] = z[i] * (-terms->V_w * y_t);
  }
}

/* The parts of a vector over the variables that have parameters: the upper half. */
#define EACH_PARAMETER unrolled for (int i = PARTS / 2; i < PARTS; i++)
_Static_assert((int)BY_MU == NODES / 2, "the upper half");

/* z times the derivatives of the rates by the parameters, at each node over the variables. */
always void parameter_derivatives(const carom_terms *terms, const carom_variation *variation,
                                  const part *z, const part *u_x, const part *u_y, const part *t_x,
                                  const part *t_y, const part *w, const part *per,
                                  table *by_parameters) {
#define TERM(name) PART(variation->d_terms[offsetof(carom_terms, name) / sizeof(double)], i)
  for (int node = 0; node < NODES; node++) {
    const part a_x = splat(AT(u_x, node)), a_y = splat(AT(u_y, node)), b_x = splat(AT(t_x, node)),
               b_y = splat(AT(t_y, node));
    const part w_j = splat(AT(w, node)), scale = splat(AT(z, node)), x = w_j * b_x, y = w_j * b_y,
               held = splat(AT(per, node));
    EACH_PARAMETER {
      const part d_w = madd(y, TERM(w_t), madd(a_y, TERM(w_u), TERM(w_0))) * held, d_x = d_w * b_x,
                 d_y = d_w * b_y;
      by_parameters[OF_A_X][node][i] =
          scale * madd(a_x, TERM(S_x), -madd(x, TERM(C_x), terms->C_x * d_x));
      by_parameters[OF_A_Y][node][i] =
          scale * (madd(a_y, TERM(S_y), TERM(A_0)) - madd(y, TERM(C_y), terms->C_y * d_y));
      by_parameters[OF_B_X][node][i] =
          scale * madd(a_x, TERM(R_x), -madd(x, TERM(H_x), terms->H_x * d_x));
      by_parameters[OF_B_Y][node][i] =
          scale * (madd(a_y, TERM(R_y), TERM(B_0)) - madd(y, TERM(H_y), terms->H_y * d_y));
      by_parameters[OF_V][node][i] =
          scale * (madd(a_y, TERM(V_u), TERM(V_0)) - madd(y, TERM(V_w), terms->V_w * d_y));
    }
  }
#undef TERM
}

/* The product of a matrix by columns with a matrix by rows, whose numbers in a row belong to the
 * variables. */
always void multiply(matrix columns, table factor, table product) {
  for (int row = 0; row < NODES; row++) {
    nodes sum;
    EACH sum[i] = splat(columns[0][row]) * factor[0][i];
    unrolled for (int node = 1; node < NODES; node++) {
      EACH sum[i] = madd(splat(columns[node][row]), factor[node][i], sum[i]);
    }
    EACH product[row][i] = sum[i];
  }
}

/* u x (da_0 + M z da'), where `by` has z da' of the parameters. */
always void right_sides(nodes *changes, table *by_parameters, int first, bool parameters,
                        const part *u_x, const part *u_y, table right) {
  for (int row = 0; row < NODES; row++) {
    nodes x, y;
    EACH {
      x[i] = changes[first][i];
      y[i] = changes[first + 1][i];
    }
    if (parameters)
      unrolled for (int node = 0; node < NODES; node++) EACH_PARAMETER {
        x[i] = madd(splat(INTEGRAL[node][row]), by_parameters[first][node][i], x[i]);
        y[i] = madd(splat(INTEGRAL[node][row]), by_parameters[first + 1][node][i], y[i]);
      }
    EACH right[row][i] = madd(splat(AT(u_x, row)), y[i], splat(-AT(u_y, row)) * x[i]);
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
  for (int row = 0; row < CAROM_VARIED; row++)
    EACH d[row][i] -= alpha[i] * rate[row];
}

always void take_rates(const carom_trajectory *path, bool driving_slips, step_rates *at_nodes) {
  const carom_variation *variation = path->variation;
  const carom_kept_step *kept = &variation->record;
  const carom_terms *terms = &path->terms;
  EACH {
    at_nodes->z[i] = PART(kept->z, i);
    at_nodes->u_x[i] = PART(kept->u_x, i);
    at_nodes->u_y[i] = PART(kept->u_y, i);
    at_nodes->t_x[i] = PART(kept->t_x, i);
    at_nodes->t_y[i] = PART(kept->t_y, i);
    at_nodes->per[i] = 1 / (1 - terms->w_t * at_nodes->t_y[i]);
    at_nodes->w[i] = (terms->w_0 + terms->w_u * at_nodes->u_y[i]) * at_nodes->per[i];
  }
  at_nodes->driving_slips = driving_slips;
  at_nodes->loaded = path->regime.loaded;
  at_nodes->parameters = (variation->requests & CAROM_PARAMETERS) != 0;
  node_derivatives(terms, at_nodes->z, at_nodes->u_x, at_nodes->u_y, at_nodes->t_x, at_nodes->t_y,
                   at_nodes->w, at_nodes->per, at_nodes->by_u, at_nodes->by_t);
  if (at_nodes->parameters)
    parameter_derivatives(terms, variation, at_nodes->z, at_nodes->u_x, at_nodes->u_y,
                          at_nodes->t_x, at_nodes->t_y, at_nodes->w, at_nodes->per,
                          at_nodes->by_parameters);
}

/* The inverse of the block of u, and phi as far as it does not depend on psi. */
always void solve_u(const carom_terms *terms, const carom_point *start, step_rates *at_nodes,
                    nodes *d, matrix of_u, table phi) {
  table right;
  nodes rate_x, rate_y, along;
  EACH { /* the rates of the slip, z a' */
    rate_x[i] = at_nodes->z[i] *
                (terms->S_x * at_nodes->u_x[i] - terms->C_x * at_nodes->w[i] * at_nodes->t_x[i]);
    rate_y[i] = at_nodes->z[i] * (terms->A_0 + terms->S_y * at_nodes->u_y[i] -
                                  terms->C_y * at_nodes->w[i] * at_nodes->t_y[i]);
  }
  lengths(start->a_x, start->a_y, rate_x, rate_y, at_nodes->u_x, at_nodes->u_y, along);
  block(at_nodes->u_x, at_nodes->u_y, at_nodes->by_u[OF_A_X], at_nodes->by_u[OF_A_Y], along, of_u);
  invert(of_u);
  right_sides(d, at_nodes->by_parameters, OF_A_X, at_nodes->parameters, at_nodes->u_x,
              at_nodes->u_y, right);
  multiply(of_u, right, phi);
}

/* Takes from the block and the right sides of t what phi takes from them: the Schur complement is
 * what remains of the block. of_ut becomes the product of the inverse and its block. */
always void eliminate_u(step_rates *at_nodes, matrix of_u, table phi, matrix of_ut, matrix of_t,
                        table right) {
  matrix of_tu;
  table share;
  block(at_nodes->u_x, at_nodes->u_y, at_nodes->by_t[OF_A_X], at_nodes->by_t[OF_A_Y], NULL, of_ut);
  block(at_nodes->t_x, at_nodes->t_y, at_nodes->by_u[OF_B_X], at_nodes->by_u[OF_B_Y], NULL, of_tu);

  /* column by column */
  for (int node = 0; node < NODES; node++) {
    nodes column, product;
    EACH column[i] = PART(of_ut[node], i);
    apply((const double(*)[NODES])of_u, column, product);
    EACH((part_of_row *)of_ut[node])[i] = (part_of_row)product[i];
    apply((const double(*)[NODES])of_tu, product, column);
    EACH((part_of_row *)of_t[node])[i] -= (part_of_row)column[i];
  }

  /* likewise of the right sides */
  multiply(of_tu, phi, share);
  for (int row = 0; row < NODES; row++)
    EACH right[row][i] -= share[row][i];
}

/* psi by the Schur complement, and what psi takes from phi. */
always void solve_t(const carom_terms *terms, const carom_point *start, step_rates *at_nodes,
                    nodes *d, matrix of_u, table phi, table psi) {
  matrix of_t, of_ut;
  table right;
  nodes rate_x, rate_y, along;
  EACH { /* the rates of the slip, z b' */
    rate_x[i] = at_nodes->z[i] *
                (terms->R_x * at_nodes->u_x[i] - terms->H_x * at_nodes->w[i] * at_nodes->t_x[i]);
    rate_y[i] = at_nodes->z[i] * (terms->B_0 + terms->R_y * at_nodes->u_y[i] -
                                  terms->H_y * at_nodes->w[i] * at_nodes->t_y[i]);
  }
  lengths(start->b_x, start->b_y, rate_x, rate_y, at_nodes->t_x, at_nodes->t_y, along);
  block(at_nodes->t_x, at_nodes->t_y, at_nodes->by_t[OF_B_X], at_nodes->by_t[OF_B_Y], along, of_t);
  right_sides(d, at_nodes->by_parameters, OF_B_X, at_nodes->parameters, at_nodes->t_x,
              at_nodes->t_y, right);
  if (at_nodes->driving_slips)
    eliminate_u(at_nodes, of_u, phi, of_ut, of_t, right);
  invert(of_t);
  multiply(of_t, right, psi);
  if (!at_nodes->driving_slips)
    return;
  multiply(of_ut, psi, right);
  for (int row = 0; row < NODES; row++)
    EACH phi[row][i] -= right[row][i];
}

/* The changes of all rows over the step, by quadrature, where `end` of W begins as the change that
 * v brings about. Returns the estimate of the error, relative: as in the solver, the coefficient of
 * the highest Legendre polynomial of the rates. */
always double integrate_rates(const carom_variation *variation, step_rates *at_nodes, double length,
                              table phi, table psi, nodes *end) {
  /* weights of the integral of an integral, which W is */
  double to_end[NODES];
  for (int node = 0; node < NODES; node++)
    to_end[node] = WEIGHT[node] * (length - variation->record.p[node]);
  nodes size, error;
  EACH {
    size[i] = splat(1e-300);
    error[i] = splat(0);
  }

  /* each rate at the nodes, by all that it depends on: its sum, and its highest coefficient */
  for (int row = 0; row < 5; row++) {
    nodes highest;
    EACH end[row][i] = highest[i] = splat(0);
    for (int node = 0; node < NODES; node++) {
      nodes rate;
      EACH rate[i] = splat(0);
      if (at_nodes->parameters)
        EACH_PARAMETER rate[i] = at_nodes->by_parameters[row][node][i];
      if (at_nodes->driving_slips)
        EACH rate[i] = madd(splat(AT(at_nodes->by_u[row], node)), phi[node][i], rate[i]);
      if (at_nodes->loaded)
        EACH rate[i] = madd(splat(AT(at_nodes->by_t[row], node)), psi[node][i], rate[i]);

      /* the sums, and for W the sum of v once more */
      EACH {
        end[row][i] = madd(splat(WEIGHT[node]), rate[i], end[row][i]);
        highest[i] = madd(splat(HIGHEST[node]), rate[i], highest[i]);
        if (row == OF_V)
          end[OF_W][i] = madd(splat(to_end[node]), rate[i], end[OF_W][i]);
      }
    }

    /* the largest derivative of all rows, and the largest coefficient */
    EACH {
      size[i] =
          greater(greater(magnitude(PART(variation->d[row], i)), magnitude(end[row][i])), size[i]);
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

/* The rates at the end, which the next step needs. A slip that is zero there has the direction of
 * the polynomial. */
always void take_end_rates(carom_trajectory *path, const step_rates *at_nodes) {
  carom_variation *variation = path->variation;
  const double last[4] = {dot(AT_END, at_nodes->u_x), dot(AT_END, at_nodes->u_y),
                          dot(AT_END, at_nodes->t_x), dot(AT_END, at_nodes->t_y)};
  carom_variation_leads(&path->point, last, variation->lead);
  carom_variation_rates(&path->terms, variation->lead, path->point.v, variation->rate);
}

/* After a step from `start`: see variation.h. Vectors over the nodes, and those over the
 * variables, have eight numbers. */
static double variation_step(carom_trajectory *path, const carom_point *start, bool driving_slips,
                             bool stiff, int vanishes) {
  carom_variation *variation = path->variation;
  const double length = path->point.p - start->p;
  carom_variation_begin_regime(path);

  /* the derivatives at the start, without a shift along the motion */
  nodes alpha, d[CAROM_VARIED];
  for (int row = 0; row < CAROM_VARIED; row++)
    EACH d[row][i] = PART(variation->d[row], i);
  EACH alpha[i] = splat(0);
  const int split = split_slip(start, driving_slips, path->regime.loaded, vanishes);
  if (split >= 0)
    split_shift(path, start, split, d, alpha);

  /* the angles: of u as if t did not change, of t by the Schur complement, and the change of u
   * by t */
  step_rates at_nodes;
  matrix of_u;
  table phi, psi;
  take_rates(path, driving_slips, &at_nodes);
  if (at_nodes.driving_slips)
    solve_u(&path->terms, start, &at_nodes, d, of_u, phi);
  if (at_nodes.loaded)
    solve_t(&path->terms, start, &at_nodes, d, of_u, phi, psi);

  /* rejected where the estimate is too large, and the step can be shorter */
  nodes end[CAROM_VARIED];
  EACH end[OF_W][i] = length * d[OF_V][i];
  const double error = integrate_rates(variation, &at_nodes, length, phi, psi, end);
  const double worst = error * error / limit_of_step(stiff, vanishes);
  if (worst > 1 && length > SHORTEST)
    return worst;

  /* the derivatives at the end, with the shift along the motion there */
  take_end_rates(path, &at_nodes);
  double sum = 0;
  for (int row = 0; row < CAROM_VARIED; row++) {
    EACH {
      d[row][i] += end[row][i] + alpha[i] * variation->rate[row];
      *(part_of_row *)&variation->d[row][NODES / PARTS * i] = (part_of_row)d[row][i];
    }
    sum += dot(WEIGHT, d[row]);
  }
  variation->lost |= !(fabs(sum) < INFINITY);
  return 0;
}

#endif
