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
 * SHIFTS. Nothing depends on p itself, so y' is a solution too: for a start a little later. Where a
 * slip is small its direction, y' and dy turn fast, but most of dy is a shift, alpha y'. There dy =
 * alpha y' + rest, with the alpha for which the rest of da is smallest, and only the rest is
 * followed over the step.
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
 * Where these equations do not say how an impact continues, its derivatives are central
 * differences of order 4: motion in a plane, whose perturbations leave it; balls that jam; a
 * slip that passes through zero. A kink is seen there by the differences to each side. */
#include "contact_law/variation.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double TOLERANCE = 1e-2;   /* of the solver: see impact.h */
static const double UNRESOLVED = 1e-5;  /* of a slip's derivative, that is left where the slip
                                           ends */
static const double COEFFICIENT = 1e-5; /* fraction of a variable by which coefficients are
                                           differentiated */
static const double CONE = 0.02;        /* 1 - (|f| / mu)^2 of a slip that friction hardly holds:
                                           core/tests/agree/tangents.c */
/* Central differences, which `differentiate` explains: */
static const double STEP = 1e-4;         /* change of a friction or of lambda, */
static const double STEP_OF_E = 1e-3;    /* of restitution, */
static const double STEP_OF_SLIP = 2e-3; /* and of a slip; where slips are beyond LONG_SLIP, over
                                            that times as much */
static const double LONG_SLIP = 0.01;    /* 1 over such a slip */
static const double STEP_SHARE = 0.4;    /* of the variable itself, which a step is below, so that
                                            two steps to each side are in its range */
static const double GOOD = 1e-5;         /* error with which no smaller step is tried, */
static const double POOR = 1e-4;         /* and above which there may be a kink */
static const double KINK = 1e-4;         /* difference of the slopes to both sides, over the
                                           largest, that is a kink */

void carom_variation_rates(const carom_terms *terms, const double lead[4], double v,
                           double rate[CAROM_VARIED]) {
  const double w = (terms->w_0 + terms->w_u * lead[1]) / (1 - terms->w_t * lead[3]),
               x = w * lead[2], y = w * lead[3];
  rate[OF_A_X] = terms->S_x * lead[0] - terms->C_x * x;
  rate[OF_A_Y] = terms->A_0 + terms->S_y * lead[1] - terms->C_y * y;
  rate[OF_B_X] = terms->R_x * lead[0] - terms->H_x * x;
  rate[OF_B_Y] = terms->B_0 + terms->R_y * lead[1] - terms->H_y * y;
  rate[OF_V] = terms->V_0 + terms->V_u * lead[1] - terms->V_w * y;
  rate[OF_W] = v;
}

void carom_variation_leads(const carom_point *point, const double otherwise[4], double lead[4]) {
  const double size_a = sqrt(point->a_x * point->a_x + point->a_y * point->a_y),
               size_b = sqrt(point->b_x * point->b_x + point->b_y * point->b_y);
  lead[0] = size_a > 0 ? point->a_x / size_a : otherwise[0];
  lead[1] = size_a > 0 ? point->a_y / size_a : otherwise[1];
  lead[2] = size_b > 0 ? point->b_x / size_b : otherwise[2];
  lead[3] = size_b > 0 ? point->b_y / size_b : otherwise[3];
}

/* The coefficients of the regime with one variable changed by a small amount, over twice of
 * which their difference is their derivative: of this and the opposite change. */
static double changed_terms(const carom_trajectory *path, enum carom_variable variable,
                            carom_terms *more, carom_terms *less) {
  const carom_law *law = &path->law, *d_law = path->variation->d_law;
  carom_law changed[2] = {*law, *law};

  /* a friction by a fraction of itself; else all coefficients along their derivatives */
  double step = COEFFICIENT;
  for (int side = 0; side < 2; side++) {
    const double share = side == 0 ? COEFFICIENT : -COEFFICIENT;
    if (variable == BY_MU) {
      changed[side].mu += share * law->mu;
      step = COEFFICIENT * law->mu;
    } else if (variable == BY_MU_C) {
      changed[side].mu_c += share * law->mu_c;
      step = COEFFICIENT * law->mu_c;
    } else {
      /* of the driving contact, of the cloth, of its load and of the approach: law.h */
      changed[side].A_0 += share * d_law->A_0;
      changed[side].K_x += share * d_law->K_x;
      changed[side].K_y += share * d_law->K_y;
      changed[side].C_x += share * d_law->C_x;
      changed[side].C_y += share * d_law->C_y;
      changed[side].B_0 += share * d_law->B_0;
      changed[side].L_x += share * d_law->L_x;
      changed[side].L_y += share * d_law->L_y;
      changed[side].H += share * d_law->H;
      changed[side].g_0 += share * d_law->g_0;
      changed[side].g_1 += share * d_law->g_1;
      changed[side].V_0 += share * d_law->V_0;
      changed[side].V_f += share * d_law->V_f;
      changed[side].V_F += share * d_law->V_F;
    }
  }

  *more = carom_impact_terms(&changed[0], &path->regime);
  *less = carom_impact_terms(&changed[1], &path->regime);
  return 2 * step;
}

void carom_variation_begin_regime(carom_trajectory *path) {
  carom_variation *variation = path->variation;
  const int regime = 1 + path->regime.held + 2 * path->regime.cloth_held + 4 * path->regime.loaded;
  if (variation->regime == regime)
    return;
  variation->regime = regime;
  for (int variable = BY_MU; variable < CAROM_VARIABLES; variable++) {
    carom_terms more, less;
    if (!(variation->requests & CAROM_PARAMETERS & 1u << variable))
      continue;
    const double apart = changed_terms(path, (enum carom_variable)variable, &more, &less);
    const double *high = (const double *)&more, *low = (const double *)&less;
    for (size_t term = 0; term < sizeof variation->d_terms / sizeof variation->d_terms[0]; term++)
      variation->d_terms[term][variable] = apart > 0 ? (high[term] - low[term]) / apart : 0;
  }
}

void carom_variation_straight(carom_trajectory *path, const carom_point *start, bool planar) {
  carom_variation *variation = path->variation;
  const double length = path->point.p - start->p, none[4] = {0};
  /* constant rates, which no direction changes */
  variation->lost |= planar && ((!path->regime.held && path->law.mu > 0) || path->regime.loaded);
  for (int variable = 0; variable < CAROM_VARIABLES; variable++)
    variation->d[OF_W][variable] += length * variation->d[OF_V][variable];
  carom_variation_begin_regime(path);
  static const size_t term[5] = {0, offsetof(carom_terms, A_0), 0, offsetof(carom_terms, B_0),
                                 offsetof(carom_terms, V_0)};
  for (int variable = BY_MU; variable < CAROM_VARIABLES; variable++) {
    for (int row = 1; row < 5; row += row == 1 ? 2 : 1)
      variation->d[row][variable] +=
          length * variation->d_terms[term[row] / sizeof(double)][variable];
    variation->d[OF_W][variable] +=
        0.5 * length * length * variation->d_terms[term[OF_V] / sizeof(double)][variable];
  }
  carom_variation_leads(&path->point, none, variation->lead);
  carom_variation_rates(&path->terms, variation->lead, path->point.v, variation->rate);
}

/* The end of the impact, or of compression: where W, or v, has its value. */
static void end_phase(carom_trajectory *path) {
  carom_variation *variation = path->variation;
  const double e = path->law.e;
  const bool compression = path->point.v == 0 && !(path->ended && e > 0);
  for (int variable = 0; variable < CAROM_VARIABLES; variable++) {
    double d_p = 0;
    if (compression) {
      variation->d_W_c[variable] = variation->d[OF_W][variable];
      variation->d[OF_W][variable] = 0;
      d_p = -variation->d[OF_V][variable] / variation->rate[OF_V];
    } else {
      const double d_target =
          -e * e * variation->d_W_c[variable] - (variable == BY_E ? 2 * e * path->W_c : 0);
      d_p = (d_target - variation->d[OF_W][variable]) / variation->rate[OF_W];
    }
    if (!path->ended)
      continue;
    for (int row = 0; row < CAROM_VARIED; row++)
      variation->d[row][variable] += variation->rate[row] * d_p;
    variation->d_p[variable] = d_p;
  }
}

void carom_variation_follow(carom_trajectory *path, const carom_point *start, bool phase_ended) {
  carom_variation *variation = path->variation;
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
    variation->lost = true;
    return;
  }

  /* along which it ends, and how fast; the rates behind its end */
  const int first = a_ends ? OF_A_X : OF_B_X;
  const double u_x = variation->lead[a_ends ? 0 : 2], u_y = variation->lead[a_ends ? 1 : 3];
  const double falls = u_x * variation->rate[first] + u_y * variation->rate[first + 1];
  const double begins[4] = {path->regime.u_x, path->regime.u_y, path->regime.t_x, path->regime.t_y};
  double lead[4], next_rate[CAROM_VARIED];
  carom_variation_leads(point, begins, lead);
  carom_variation_rates(&path->terms, lead, point->v, next_rate);

  /* it ends a little earlier or later; rates change there. By the rates at its end and not only by
   * the direction of the slip: the direction of a slip which is negligible, but not zero, still
   * turns, and the part of da across the motion falls with |a| */
  for (int variable = 0; variable < CAROM_VARIABLES; variable++) {
    const double d_p =
        falls < 0
            ? -(u_x * variation->d[first][variable] + u_y * variation->d[first + 1][variable]) /
                  falls
            : 0;
    /* the rest of da, which has to be 0, reports how well the end of the slip was resolved */
    const double x = variation->d[first][variable] + variation->rate[first] * d_p,
                 y = variation->d[first + 1][variable] + variation->rate[first + 1] * d_p;
    if ((variation->requests >> variable & 1) &&
        fabs(x) + fabs(y) > UNRESOLVED * fmax(fabs(variation->d[first][variable]) +
                                                  fabs(variation->d[first + 1][variable]),
                                              1))
      variation->lost = true;
    for (int row = 0; row < CAROM_VARIED; row++)
      variation->d[row][variable] += (variation->rate[row] - next_rate[row]) * d_p;
    variation->d[first][variable] = variation->d[first + 1][variable] = 0;
  }
}

/* ---- From the start to the end ---- */

static void begin(const carom_law *law, const double slips[4], double tolerance, int plain,
                  carom_trajectory *path) {
  carom_impact_begin(law, tolerance, plain, slips[0], slips[1], slips[2], slips[3], 0, path);
}

/* The impulses, without derivatives. */
static carom_status impulses_of(const carom_law *law, const double slips[4], double tolerance,
                                int plain, double impulses[5]) {
  carom_trajectory path;
  begin(law, slips, tolerance, plain, &path);
  const carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  const carom_impulses end = carom_impact_impulses(&path);
  memcpy(impulses, (const double[5]){end.p, end.f_x, end.f_y, end.F_x, end.F_y},
         5 * sizeof *impulses);
  return status;
}

enum { COEFFICIENTS = 14 }; /* of a law, by lambda: all before mu */

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
    const double *d_coefficient = (const double *)d_law;
    double *coefficient = (double *)law;
    for (int index = 0; index < COEFFICIENTS; index++)
      coefficient[index] += step * d_coefficient[index];
    break;
  }
  default:
    slips[variable] += step;
  }
}
_Static_assert(sizeof(carom_law) == 17 * sizeof(double) &&
                   offsetof(carom_law, mu) == COEFFICIENTS * sizeof(double),
               "14 coefficients, then frictions and restitution");

/* Central differences of order 4 by one variable, with smaller steps where two orders differ. */
__attribute__((noinline)) static void differentiate(const carom_law *law, const carom_law *d_law,
                                                    const double slips[4], double tolerance,
                                                    int plain, int variable,
                                                    carom_impact_tangent *out) {
  const double size =
      fmax(fmax(fabs(slips[0]), fabs(slips[1])), fmax(fabs(slips[2]), fabs(slips[3])));
  double step = variable == BY_E ? STEP_OF_E : STEP, best = INFINITY, bends = INFINITY;
  if (variable <= BY_B_Y)
    step = STEP_OF_SLIP * fmax(1, LONG_SLIP * size);

  /* the step to begin with */
  const double value[5] = {out->q.p, out->q.f_x, out->q.f_y, out->q.F_x, out->q.F_y};
  if (variable == BY_MU || variable == BY_MU_C)
    step = fmin(step, STEP_SHARE * (variable == BY_MU ? law->mu : law->mu_c));
  if (variable == BY_E)
    step = fmin(step, STEP_SHARE * law->e);
  for (int attempt = 0; attempt < 4 && (best > GOOD || bends > KINK) && step > 0;
       attempt++, step /= 8) {
    static const double steps[4] = {-2, -1, 1, 2};
    double impulses[4][5], error = 0, bend = 0, most = 1;
    bool fine = true;

    /* the impulses at two steps to each side */
    for (int offset = 0; offset < 4 && fine; offset++) {
      carom_law changed_law = *law;
      double changed_slips[4] = {slips[0], slips[1], slips[2], slips[3]};
      change(&changed_law, d_law, changed_slips, variable, steps[offset] * step);
      fine =
          impulses_of(&changed_law, changed_slips, tolerance, plain, impulses[offset]) == CAROM_OK;
    }

    /* slopes over one step and over two, which differ by three times the error of the former */
    for (int row = 0; row < 5 && fine; row++) {
      const double narrow = (impulses[2][row] - impulses[1][row]) / (2 * step),
                   far = (impulses[3][row] - impulses[0][row]) / (4 * step);
      error = fmax(error, fabs(narrow - far) / 3);
      most = fmax(most, fabs(narrow));
      /* the difference of the slopes to both sides, less a smooth function's, which is in
       * proportion to h */
      const double less = impulses[2][row] + impulses[1][row] - 2 * value[row],
                   more = impulses[3][row] + impulses[0][row] - 2 * value[row];
      bend = fmax(bend, fabs(2 * less - 0.5 * more) / step);
    }
    if (fine)
      bends = fmin(bends, bend / most);

    /* the best so far, with the error of order 2 removed */
    if (fine && error / most < best) {
      best = error / most;
      for (int row = 0; row < 5; row++)
        out->d[row][variable] =
            (8 * (impulses[2][row] - impulses[1][row]) - (impulses[3][row] - impulses[0][row])) /
            (12 * step);
    }
  }
  if (!(best < INFINITY) && tolerance < 1) {
    differentiate(law, d_law, slips, 1, plain, variable, out);
    return;
  }
  out->differences = true;
  out->error = fmax(out->error, best < INFINITY ? best : 1);
  out->kink |= !(best < POOR) || !(bends < KINK);
}

/* Derivatives of the impulses by one variable, at the end of an impact. A separate function, so
 * that its stack is not in use while the impact is followed. */
__attribute__((noinline)) static void impulses_by(const carom_trajectory *path,
                                                  const carom_variation *variation, int variable,
                                                  carom_impact_tangent *out) {
  /* impulses are linear in the motion at both ends, with coefficients of the law */
  carom_trajectory changes = *path;
  changes.start = (carom_point){.a_x = variable == BY_A_X,
                                .a_y = variable == BY_A_Y,
                                .b_x = variable == BY_B_X,
                                .b_y = variable == BY_B_Y};
  changes.point = (carom_point){.a_x = variation->d[OF_A_X][variable],
                                .a_y = variation->d[OF_A_Y][variable],
                                .b_x = variation->d[OF_B_X][variable],
                                .b_y = variation->d[OF_B_Y][variable],
                                .v = variation->d[OF_V][variable],
                                .p = variation->d_p[variable]};
  const carom_impulses impulses = carom_impact_impulses(&changes);
  double sum[5] = {impulses.p, impulses.f_x, impulses.f_y, impulses.F_x, impulses.F_y};
  if (variable == BY_LAMBDA) {
    carom_impulses end[2];
    double unused[4];
    for (int side = 0; side < 2; side++) {
      carom_trajectory shifted = *path;
      change(&shifted.law, variation->d_law, unused, variable,
             side == 0 ? COEFFICIENT : -COEFFICIENT);
      end[side] = carom_impact_impulses(&shifted);
    }
    sum[1] += (end[0].f_x - end[1].f_x) / (2 * COEFFICIENT);
    sum[2] += (end[0].f_y - end[1].f_y) / (2 * COEFFICIENT);
    sum[3] += (end[0].F_x - end[1].F_x) / (2 * COEFFICIENT);
    sum[4] += (end[0].F_y - end[1].F_y) / (2 * COEFFICIENT);
  }
  for (int row = 0; row < 5; row++) {
    out->d[row][variable] = sum[row];
    out->kink |= !isfinite(sum[row]);
  }
}

/* Ends the seeds of slips that friction holds from the start: see the head. */
static void end_held_slips(const carom_trajectory *path, carom_variation *variation) {
  const carom_law *law = &path->law;
  const carom_regime *regime = &path->regime;
  const carom_point *point = &path->point;
  const double begins[4] = {regime->u_x, regime->u_y, regime->t_x, regime->t_y};
  carom_variation_leads(point, begins, variation->lead);
  const double t_x = variation->lead[2], t_y = variation->lead[3],
               w = regime->loaded ? law->mu_c * law->g_1 : 0;

  /* friction that nearly leaves its cone: the smallest change lasts, or is held, depending on
   * its sign */
  const carom_terms *terms = &path->terms;
  const double load = terms->w_0 / (1 - terms->w_t * t_y), x = load * t_x, y = load * t_y;
  const double outside =
      terms->event[0] + terms->event[1] * y + terms->event[2] * x * x + terms->event[3] * y * y;
  const bool edge = regime->held && outside > -CONE * law->mu * law->mu;
  for (int variable = BY_A_X; variable <= BY_B_Y; variable++) {
    double f_x = 0, f_y = 0, F_x = 0, F_y = 0;
    const double a_x = variation->d[OF_A_X][variable], a_y = variation->d[OF_A_Y][variable];
    /* a slip that begins from zero goes one way, whatever the sign of a change: here, and of b
     * below */
    variation->kink |= law->mu > 0 && !regime->held && point->a_x == 0 && point->a_y == 0 &&
                       (a_x != 0 || a_y != 0);
    if (regime->held && (a_x != 0 || a_y != 0)) {
      variation->kink |= edge;
      f_y = -a_y / (law->K_y - law->C_y * w * t_y);
      F_x = -w * t_x * f_y;
      F_y = -w * t_y * f_y;
      f_x = -(a_x + law->C_x * F_x) / law->K_x;
      /* on the way friction may be anything in the cone, but only along x if nothing turns it: does
       * the load keep its sign? */
      const double most =
          a_y != 0 || law->A_0 != 0 || regime->loaded ? law->mu * fabs(law->g_1) : 0;
      variation->lost |= law->mu_c > 0 && (regime->loaded ? law->g_0 < most : law->g_0 > -most);
    } else if (regime->cloth_held) {
      F_x = -variation->d[OF_B_X][variable] / law->H;
      F_y = -variation->d[OF_B_Y][variable] / law->H;
    }
    variation->d[OF_A_X][variable] += law->K_x * f_x + law->C_x * F_x;
    variation->d[OF_A_Y][variable] += law->K_y * f_y + law->C_y * F_y;
    variation->d[OF_B_X][variable] += law->L_x * f_x + law->H * F_x;
    variation->d[OF_B_Y][variable] += law->L_y * f_y + law->H * F_y;
    variation->d[OF_V][variable] += law->V_f * f_y + law->V_F * F_y;
    /* exactly none is left */
    if (regime->held)
      variation->d[OF_A_X][variable] = variation->d[OF_A_Y][variable] = 0;
    if (regime->cloth_held)
      variation->d[OF_B_X][variable] = variation->d[OF_B_Y][variable] = 0;
    variation->kink |= regime->loaded && point->b_x == 0 && point->b_y == 0 &&
                       (variation->d[OF_B_X][variable] != 0 || variation->d[OF_B_Y][variable] != 0);
  }
}

carom_status carom_impact_differentiate(const carom_law *law, const carom_law *d_law,
                                        const double slips[4], int plain, unsigned requests,
                                        carom_impact_tangent *out) {
  carom_trajectory path;
  carom_variation variation;
  begin(law, slips, TOLERANCE, plain, &path);
  memset(&variation, 0, sizeof variation);
  memset(out, 0, sizeof *out);

  /* each variable requested begins as its own derivative */
  variation.d_law = d_law;
  variation.requests = requests;
  for (int variable = BY_A_X; variable <= BY_B_Y; variable++)
    variation.d[variable][variable] = requests >> variable & 1;
  if (path.status == CAROM_OK)
    end_held_slips(&path, &variation);

  /* the impact with its derivatives */
  double tolerance = TOLERANCE;
  path.variation = &variation;
  carom_status status = carom_impact_advance(&path, INFINITY, 10 * CAROM_IMPACT_ITERATIONS);
  if (status == CAROM_ERROR_UNRESOLVED) {
    /* near the frictions at which balls jam only the tolerance of the impact itself leaves a way
     * to the end */
    tolerance = 1;
    variation.lost = true;
    begin(law, slips, tolerance, plain, &path);
    status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  }

  path.variation = NULL;
  out->q = carom_impact_impulses(&path);
  if (status != CAROM_OK)
    return status;
  out->kink = variation.kink || (law->mu == 0 && (requests >> BY_MU & 1)) ||
              (law->e == 0 && (requests >> BY_E & 1));

  /* where they were lost on the way, differences of impacts replace them */
  variation.lost |=
      !path.ended || variation.rate[OF_V] == 0 || (path.regime.held && path.regime.cloth_held);
  for (int variable = 0; variable < CAROM_VARIABLES; variable++) {
    if (!(requests >> variable & 1))
      continue;
    if (variation.lost) {
      differentiate(law, d_law, slips, tolerance, plain, variable, out);
      continue;
    }
    impulses_by(&path, &variation, variable, out);
  }
  return CAROM_OK;
}
