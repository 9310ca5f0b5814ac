/* Derivatives of an impact with two frictional contacts, in one pass of the precise solver.
 *
 * Within a regime the variational equations are linear. Let a prime be the derivative by p at
 * fixed variables, d that by a variable at fixed p. The rates depend on the directions u =
 * a/|a|, t = b/|b| and on the variables, and a direction turns by the angle
 *
 *     |a| dphi = u x da,     |b| dpsi = t x db.
 *
 * They are solved by collocation over the nodes of the solver's own step, where z = dp/dX and M
 * integrates (step.h):
 *
 *     |a|_i dphi_i - u_i x sum_j M_ij z_j (a'_phi dphi + a'_psi dpsi)_j
 *         = u_i x (da_0 + sum_j M_ij z_j (da')_j)
 *
 * and the same for dpsi: 16 linear equations with a column for each variable. Written with |a|
 * instead of its inverse they remain regular where a slip begins from zero. The end of the step
 * follows by quadrature.
 *
 * SHIFTS. Nothing depends on p itself, so y' is a solution too: that of a start a little later.
 * Where a slip is small its direction, y' and dy turn fast, but most of dy is a shift, alpha y'.
 * There dy = alpha y' + rest, with the alpha for which the rest of da is smallest, and only the
 * rest is followed over the step.
 *
 * EVENTS. Where a regime ends because a slip is zero, at p_s, friction changes, and so do the
 * rates:
 *
 *     d p_s = -(u . da)/(u . a'),     dy+ = dy- + (y'- - y'+) d p_s,     da = 0 from there on.
 *
 * Rates are continuous where a load begins or ends and where friction leaves its cone. The
 * impact ends where W = -e^2 W_c.
 *
 * HELD FROM THE START. Friction ends a small slip da at once, in a p of the order of da. There
 * it is f and not the f_h that holds, and all rates are linear in f - f_h as long as the load
 * keeps its sign. With M of contact.c, a' = M (f - f_h), so
 *
 *     int (f - f_h) dp = -M^-1 da,     int (F - F_h) dp = mu_c g_1 t (M^-1 da)_y,
 *     da = 0 from there on,
 *
 * and db and dv change by their rates for these impulses. A slip db that the cloth holds ends by
 * int (F - F_h) dp = -db/H. Where the load may change its sign on the way, the derivatives
 * depend on the direction of da.
 *
 * Where these equations do not say how an impact goes on, its derivatives are central
 * differences of order 4: motion in a plane, whose perturbations leave it; balls that jam; a
 * slip that passes through zero. A kink is seen there by the differences to each side. */
#include "contact_law/variation.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double TOLERANCE = 1e-2;   /* of the solver: see impact.h */
static const double UNRESOLVED = 1e-5;  /* of a slip's derivative, that is left where the slip
                                           ends */
static const double COEFFICIENT = 1e-5; /* share of a variable by which coefficients are
                                           differentiated */
static const double CONE = 0.02;        /* 1 - (|f| / mu)^2 of a slip that friction hardly holds:
                                           core/tests/agree/tangents.c */
static const double KINK = 1e-4;        /* difference of the slopes to both sides, over the
                                           largest, that is a kink */

void carom_variation_rates(const carom_terms *k, const double lead[4], double v,
                           double rate[CAROM_VARIED]) {
  const double w = (k->w_0 + k->w_u * lead[1]) / (1 - k->w_t * lead[3]), x = w * lead[2],
               y = w * lead[3];
  rate[OF_A_X] = k->S_x * lead[0] - k->C_x * x;
  rate[OF_A_Y] = k->A_0 + k->S_y * lead[1] - k->C_y * y;
  rate[OF_B_X] = k->R_x * lead[0] - k->H_x * x;
  rate[OF_B_Y] = k->B_0 + k->R_y * lead[1] - k->H_y * y;
  rate[OF_V] = k->V_0 + k->V_u * lead[1] - k->V_w * y;
  rate[OF_W] = v;
}

void carom_variation_leads(const carom_point *point, const double otherwise[4], double lead[4]) {
  const double a = sqrt(point->a_x * point->a_x + point->a_y * point->a_y),
               b = sqrt(point->b_x * point->b_x + point->b_y * point->b_y);
  lead[0] = a > 0 ? point->a_x / a : otherwise[0];
  lead[1] = a > 0 ? point->a_y / a : otherwise[1];
  lead[2] = b > 0 ? point->b_x / b : otherwise[2];
  lead[3] = b > 0 ? point->b_y / b : otherwise[3];
}

/* The coefficients of the regime with one variable changed by a small amount, over twice of
 * which their difference is their derivative: of this and the opposite change. */
static double changed_terms(const carom_trajectory *path, enum carom_variable variable,
                            carom_terms *more, carom_terms *less) {
  const carom_law *law = &path->law, *d = path->variation->d_law;
  carom_law l[2] = {*law, *law};

  /* a friction by a share of itself; else all coefficients along their derivatives */
  double step = COEFFICIENT;
  for (int k = 0; k < 2; k++) {
    const double s = k == 0 ? COEFFICIENT : -COEFFICIENT;
    if (variable == BY_MU) {
      l[k].mu += s * law->mu;
      step = COEFFICIENT * law->mu;
    } else if (variable == BY_MU_C) {
      l[k].mu_c += s * law->mu_c;
      step = COEFFICIENT * law->mu_c;
    } else {
      /* of the driving contact, of the cloth, of its load and of the approach: law.h */
      l[k].A_0 += s * d->A_0;
      l[k].K_x += s * d->K_x;
      l[k].K_y += s * d->K_y;
      l[k].C_x += s * d->C_x;
      l[k].C_y += s * d->C_y;
      l[k].B_0 += s * d->B_0;
      l[k].L_x += s * d->L_x;
      l[k].L_y += s * d->L_y;
      l[k].H += s * d->H;
      l[k].g_0 += s * d->g_0;
      l[k].g_1 += s * d->g_1;
      l[k].V_0 += s * d->V_0;
      l[k].V_f += s * d->V_f;
      l[k].V_F += s * d->V_F;
    }
  }

  *more = carom_impact_terms(&l[0], &path->regime);
  *less = carom_impact_terms(&l[1], &path->regime);
  return 2 * step;
}

void carom_variation_begin_regime(carom_trajectory *path) {
  carom_variation *g = path->variation;
  const int regime = 1 + path->regime.held + 2 * path->regime.cloth_held + 4 * path->regime.loaded;
  if (g->regime == regime)
    return;
  g->regime = regime;
  for (int c = BY_MU; c < CAROM_VARIABLES; c++) {
    carom_terms more, less;
    if (!(g->requests & CAROM_PARAMETERS & 1u << c))
      continue;
    const double apart = changed_terms(path, (enum carom_variable)c, &more, &less);
    const double *high = (const double *)&more, *low = (const double *)&less;
    for (size_t k = 0; k < sizeof g->d_terms / sizeof g->d_terms[0]; k++)
      g->d_terms[k][c] = apart > 0 ? (high[k] - low[k]) / apart : 0;
  }
}

void carom_variation_straight(carom_trajectory *path, const carom_point *start, bool planar) {
  carom_variation *g = path->variation;
  const double length = path->point.p - start->p, none[4] = {0};
  /* constant rates, which no direction changes */
  g->lost |= planar && ((!path->regime.held && path->law.mu > 0) || path->regime.loaded);
  for (int c = 0; c < CAROM_VARIABLES; c++)
    g->d[OF_W][c] += length * g->d[OF_V][c];
  carom_variation_begin_regime(path);
  static const size_t term[5] = {0, offsetof(carom_terms, A_0), 0, offsetof(carom_terms, B_0),
                                 offsetof(carom_terms, V_0)};
  for (int c = BY_MU; c < CAROM_VARIABLES; c++) {
    for (int r = 1; r < 5; r += r == 1 ? 2 : 1)
      g->d[r][c] += length * g->d_terms[term[r] / sizeof(double)][c];
    g->d[OF_W][c] += 0.5 * length * length * g->d_terms[term[OF_V] / sizeof(double)][c];
  }
  carom_variation_leads(&path->point, none, g->lead);
  carom_variation_rates(&path->terms, g->lead, path->point.v, g->rate);
}

/* The end of the impact, or of compression: where W, or v, has its value. */
static void end_phase(carom_trajectory *path) {
  carom_variation *g = path->variation;
  const double e = path->law.e;
  const bool compression = path->point.v == 0 && !(path->ended && e > 0);
  for (int c = 0; c < CAROM_VARIABLES; c++) {
    double d_p = 0;
    if (compression) {
      g->d_W_c[c] = g->d[OF_W][c];
      g->d[OF_W][c] = 0;
      d_p = -g->d[OF_V][c] / g->rate[OF_V];
    } else {
      const double d_target = -e * e * g->d_W_c[c] - (c == BY_E ? 2 * e * path->W_c : 0);
      d_p = (d_target - g->d[OF_W][c]) / g->rate[OF_W];
    }
    if (!path->ended)
      continue;
    for (int r = 0; r < CAROM_VARIED; r++)
      g->d[r][c] += g->rate[r] * d_p;
    g->d_p[c] = d_p;
  }
}

void carom_variation_follow(carom_trajectory *path, const carom_point *start, bool phase_ended) {
  carom_variation *g = path->variation;
  const carom_point *point = &path->point;
  if (phase_ended)
    end_phase(path);
  if (path->ended)
    return;

  /* a slip that has become zero */
  const bool a_ends = point->a_x == 0 && point->a_y == 0 && (start->a_x != 0 || start->a_y != 0) &&
                      path->law.mu > 0;
  const bool b_ends = point->b_x == 0 && point->b_y == 0 && (start->b_x != 0 || start->b_y != 0) &&
                      path->law.mu_c > 0;
  if (!a_ends && !b_ends)
    return;
  if ((a_ends && b_ends) || (a_ends && !path->regime.held) ||
      (b_ends && !path->regime.cloth_held)) {
    g->lost = true;
    return;
  }

  /* along which it ends, and how fast; the rates behind its end */
  const int first = a_ends ? OF_A_X : OF_B_X;
  const double u_x = g->lead[a_ends ? 0 : 2], u_y = g->lead[a_ends ? 1 : 3];
  const double falls = u_x * g->rate[first] + u_y * g->rate[first + 1];
  const double begins[4] = {path->regime.u_x, path->regime.u_y, path->regime.t_x, path->regime.t_y};
  double lead[4], next_rate[CAROM_VARIED];
  carom_variation_leads(point, begins, lead);
  carom_variation_rates(&path->terms, lead, point->v, next_rate);

  /* it ends a little earlier or later; rates change there. By the rates at its end and not by
   * the direction of the slip alone: that of a slip which is negligible, but not zero, still
   * turns, and the part of da across the motion falls with |a| */
  for (int c = 0; c < CAROM_VARIABLES; c++) {
    const double d_p = falls < 0 ? -(u_x * g->d[first][c] + u_y * g->d[first + 1][c]) / falls : 0;
    /* the rest of da, which has to be 0, tells how well the end of the slip was resolved */
    const double x = g->d[first][c] + g->rate[first] * d_p,
                 y = g->d[first + 1][c] + g->rate[first + 1] * d_p;
    if ((g->requests >> c & 1) &&
        fabs(x) + fabs(y) > UNRESOLVED * fmax(fabs(g->d[first][c]) + fabs(g->d[first + 1][c]), 1))
      g->lost = true;
    for (int r = 0; r < CAROM_VARIED; r++)
      g->d[r][c] += (g->rate[r] - next_rate[r]) * d_p;
    g->d[first][c] = g->d[first + 1][c] = 0;
  }
}

/* ---- From the start to the end ---- */

static void begin(const carom_law *law, const double slips[4], double tolerance, int plain,
                  carom_trajectory *path) {
  carom_impact_begin(law, tolerance, plain, slips[0], slips[1], slips[2], slips[3], 0, path);
}

/* The impulses, without derivatives. */
static carom_status impulses_of(const carom_law *law, const double slips[4], double tolerance,
                                int plain, double q[5]) {
  carom_trajectory path;
  begin(law, slips, tolerance, plain, &path);
  const carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  const carom_impulses i = carom_impact_impulses(&path);
  memcpy(q, (const double[5]){i.p, i.f_x, i.f_y, i.F_x, i.F_y}, 5 * sizeof *q);
  return status;
}

/* A law and slips with one variable changed. */
static void change(carom_law *law, const carom_law *d_law, double slips[4], int variable,
                   double step) {
  switch (variable) {
  case BY_MU:
    law->mu += step;
    break;
  case BY_MU_C:
    law->mu_c += step;
    break;
  case BY_E:
    law->e += step;
    break;
  case BY_LAMBDA: {
    const double *d = (const double *)d_law;
    double *l = (double *)law;
    for (int k = 0; k < 14; k++)
      l[k] += step * d[k];
    break;
  }
  default:
    slips[variable] += step;
  }
}
_Static_assert(sizeof(carom_law) == 17 * sizeof(double) &&
                   offsetof(carom_law, mu) == 14 * sizeof(double),
               "14 coefficients, then frictions and restitution");

/* Central differences of order 4 by one variable, with smaller steps where two orders differ. */
__attribute__((noinline)) static void differentiate(const carom_law *law, const carom_law *d_law,
                                                    const double slips[4], double tolerance,
                                                    int plain, int variable,
                                                    carom_impact_tangent *out) {
  const double size =
      fmax(fmax(fabs(slips[0]), fabs(slips[1])), fmax(fabs(slips[2]), fabs(slips[3])));
  double h = variable == BY_E ? 1e-3 : 1e-4, best = INFINITY, bends = INFINITY;
  if (variable <= BY_B_Y)
    h = 2e-3 * fmax(1, 0.01 * size);
  const double value[5] = {out->q.p, out->q.f_x, out->q.f_y, out->q.F_x, out->q.F_y};
  if (variable == BY_MU || variable == BY_MU_C)
    h = fmin(h, 0.4 * (variable == BY_MU ? law->mu : law->mu_c));
  if (variable == BY_E)
    h = fmin(h, 0.4 * law->e);
  for (int attempt = 0; attempt < 4 && (best > 1e-5 || bends > KINK) && h > 0; attempt++, h /= 8) {
    static const double steps[4] = {-2, -1, 1, 2};
    double f[4][5], error = 0, bend = 0, most = 1;
    bool fine = true;
    for (int s = 0; s < 4 && fine; s++) {
      carom_law l = *law;
      double x[4] = {slips[0], slips[1], slips[2], slips[3]};
      change(&l, d_law, x, variable, steps[s] * h);
      fine = impulses_of(&l, x, tolerance, plain, f[s]) == CAROM_OK;
    }
    for (int r = 0; r < 5 && fine; r++) {
      const double narrow = (f[2][r] - f[1][r]) / (2 * h), far = (f[3][r] - f[0][r]) / (4 * h);
      error = fmax(error, fabs(narrow - far) / 3);
      most = fmax(most, fabs(narrow));
      /* the difference of the slopes to both sides, less a smooth function's, which is in
       * proportion to h */
      const double less = f[2][r] + f[1][r] - 2 * value[r], more = f[3][r] + f[0][r] - 2 * value[r];
      bend = fmax(bend, fabs(2 * less - 0.5 * more) / h);
    }
    if (fine)
      bends = fmin(bends, bend / most);
    if (fine && error / most < best) {
      best = error / most;
      for (int r = 0; r < 5; r++)
        out->d[r][variable] = (8 * (f[2][r] - f[1][r]) - (f[3][r] - f[0][r])) / (12 * h);
    }
  }
  if (!(best < INFINITY) && tolerance < 1) {
    differentiate(law, d_law, slips, 1, plain, variable, out);
    return;
  }
  out->differences = true;
  out->error = fmax(out->error, best < INFINITY ? best : 1);
  out->kink |= !(best < 1e-4) || !(bends < KINK);
}

/* Derivatives of the impulses by one variable, at the end of an impact. A function of its own,
 * so that its stack is not there while the impact is followed. */
__attribute__((noinline)) static void impulses_by(const carom_trajectory *path,
                                                  const carom_variation *g, int c,
                                                  carom_impact_tangent *out) {
  /* impulses are linear in the motion at both ends, with coefficients of the law */
  carom_trajectory d = *path;
  d.start =
      (carom_point){.a_x = c == BY_A_X, .a_y = c == BY_A_Y, .b_x = c == BY_B_X, .b_y = c == BY_B_Y};
  d.point = (carom_point){.a_x = g->d[OF_A_X][c],
                          .a_y = g->d[OF_A_Y][c],
                          .b_x = g->d[OF_B_X][c],
                          .b_y = g->d[OF_B_Y][c],
                          .v = g->d[OF_V][c],
                          .p = g->d_p[c]};
  const carom_impulses q = carom_impact_impulses(&d);
  double sum[5] = {q.p, q.f_x, q.f_y, q.F_x, q.F_y};
  if (c == BY_LAMBDA) {
    carom_impulses end[2];
    double unused[4];
    for (int k = 0; k < 2; k++) {
      carom_trajectory shifted = *path;
      change(&shifted.law, g->d_law, unused, c, k == 0 ? COEFFICIENT : -COEFFICIENT);
      end[k] = carom_impact_impulses(&shifted);
    }
    sum[1] += (end[0].f_x - end[1].f_x) / (2 * COEFFICIENT);
    sum[2] += (end[0].f_y - end[1].f_y) / (2 * COEFFICIENT);
    sum[3] += (end[0].F_x - end[1].F_x) / (2 * COEFFICIENT);
    sum[4] += (end[0].F_y - end[1].F_y) / (2 * COEFFICIENT);
  }
  for (int r = 0; r < 5; r++) {
    out->d[r][c] = sum[r];
    out->kink |= !isfinite(sum[r]);
  }
}

/* Ends the seeds of slips that friction holds from the start: see the head. */
static void end_held_slips(const carom_trajectory *path, carom_variation *g) {
  const carom_law *l = &path->law;
  const carom_regime *r = &path->regime;
  const carom_point *point = &path->point;
  const double begins[4] = {r->u_x, r->u_y, r->t_x, r->t_y};
  carom_variation_leads(point, begins, g->lead);
  const double t_x = g->lead[2], t_y = g->lead[3], w = r->loaded ? l->mu_c * l->g_1 : 0;

  /* friction that nearly leaves its cone: the smallest change lasts, or is held, depending on
   * its sign */
  const carom_terms *k = &path->terms;
  const double load = k->w_0 / (1 - k->w_t * t_y), x = load * t_x, y = load * t_y;
  const double outside = k->event[0] + k->event[1] * y + k->event[2] * x * x + k->event[3] * y * y;
  const bool edge = r->held && outside > -CONE * l->mu * l->mu;
  for (int c = BY_A_X; c <= BY_B_Y; c++) {
    double f_x = 0, f_y = 0, F_x = 0, F_y = 0;
    const double a_x = g->d[OF_A_X][c], a_y = g->d[OF_A_Y][c];
    /* a slip that begins from zero goes one way, whatever the sign of a change: here, and of b
     * below */
    g->kink |=
        l->mu > 0 && !r->held && point->a_x == 0 && point->a_y == 0 && (a_x != 0 || a_y != 0);
    if (r->held && (a_x != 0 || a_y != 0)) {
      g->kink |= edge;
      f_y = -a_y / (l->K_y - l->C_y * w * t_y);
      F_x = -w * t_x * f_y;
      F_y = -w * t_y * f_y;
      f_x = -(a_x + l->C_x * F_x) / l->K_x;
      /* on the way friction may be anything in the cone, but along x alone if nothing turns it:
       * does the load keep its sign? */
      const double most = a_y != 0 || l->A_0 != 0 || r->loaded ? l->mu * fabs(l->g_1) : 0;
      g->lost |= l->mu_c > 0 && (r->loaded ? l->g_0 < most : l->g_0 > -most);
    } else if (r->cloth_held) {
      F_x = -g->d[OF_B_X][c] / l->H;
      F_y = -g->d[OF_B_Y][c] / l->H;
    }
    g->d[OF_A_X][c] += l->K_x * f_x + l->C_x * F_x;
    g->d[OF_A_Y][c] += l->K_y * f_y + l->C_y * F_y;
    g->d[OF_B_X][c] += l->L_x * f_x + l->H * F_x;
    g->d[OF_B_Y][c] += l->L_y * f_y + l->H * F_y;
    g->d[OF_V][c] += l->V_f * f_y + l->V_F * F_y;
    /* exactly none is left */
    if (r->held)
      g->d[OF_A_X][c] = g->d[OF_A_Y][c] = 0;
    if (r->cloth_held)
      g->d[OF_B_X][c] = g->d[OF_B_Y][c] = 0;
    g->kink |= r->loaded && point->b_x == 0 && point->b_y == 0 &&
               (g->d[OF_B_X][c] != 0 || g->d[OF_B_Y][c] != 0);
  }
}

carom_status carom_impact_differentiate(const carom_law *law, const carom_law *d_law,
                                        const double slips[4], int plain, unsigned requests,
                                        carom_impact_tangent *out) {
  carom_trajectory path;
  carom_variation g;
  begin(law, slips, TOLERANCE, plain, &path);
  memset(&g, 0, sizeof g);
  memset(out, 0, sizeof *out);

  /* each variable asked for begins as its own derivative */
  g.d_law = d_law;
  g.requests = requests;
  for (int c = BY_A_X; c <= BY_B_Y; c++)
    g.d[c][c] = requests >> c & 1;
  if (path.status == CAROM_OK)
    end_held_slips(&path, &g);

  /* the impact with its derivatives */
  double tolerance = TOLERANCE;
  path.variation = &g;
  carom_status status = carom_impact_advance(&path, INFINITY, 10 * CAROM_IMPACT_ITERATIONS);
  if (status == CAROM_ERROR_UNRESOLVED) {
    /* near the frictions at which balls jam only the tolerance of the impact itself leaves a way
     * to the end */
    tolerance = 1;
    g.lost = true;
    begin(law, slips, tolerance, plain, &path);
    status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  }

  path.variation = NULL;
  out->q = carom_impact_impulses(&path);
  if (status != CAROM_OK)
    return status;
  out->kink = g.kink || (law->mu == 0 && (requests >> BY_MU & 1)) ||
              (law->e == 0 && (requests >> BY_E & 1));

  /* where they were lost on the way, differences of impacts take their place */
  g.lost |= !path.ended || g.rate[OF_V] == 0 || (path.regime.held && path.regime.cloth_held);
  for (int c = 0; c < CAROM_VARIABLES; c++) {
    if (!(requests >> c & 1))
      continue;
    if (g.lost) {
      differentiate(law, d_law, slips, tolerance, plain, c, out);
      continue;
    }
    impulses_by(&path, &g, c, out);
  }
  return CAROM_OK;
}
