/* The entry points of the precise solver: where an impact begins, how it continues, and its
 * impulses.
 *
 * IMPULSES. f and F enter the rates of a, b and v linearly, so their integrals Q and G follow
 * from the changes of a, b and v:
 *
 *     K_x Q_x + C_x G_x = a_x - a_x0                K_y Q_y + C_y G_y = a_y - a_y0 - A_0 p
 *     L_x Q_x + H G_x   = b_x - b_x0                V_f Q_y + V_F G_y = v - v_0 - V_0 p
 *
 * The balance of momentum is therefore exact, whatever the error of the solver. */
#include "contact_law/impact.h"

#include "platform/isa.h"

#include <math.h>

static const double NO_SLIP = 1e-9;    /* a slip that counts as zero; */
static const double ROUNDING = 1e-15;  /* at least this fraction of all slips; where H < 0, which
                                          would amplify it, no more */
static const double MOST_SLIP = 1e100; /* squares of more would overflow */

void carom_impact_begin(const carom_law *law, double tolerance, int plain, double a_x, double a_y,
                        double b_x, double b_y, double rounding, carom_trajectory *path) {
  const double driving_slips = fabs(a_x) + fabs(a_y) + fabs(b_x) + fabs(b_y);
  *path =
      (carom_trajectory){.law = *law,
                         .start = {.a_x = a_x, .a_y = a_y, .b_x = b_x, .b_y = b_y, .v = 1},
                         .p_stick = NAN,
                         .plain = plain,
                         .tolerance = tolerance,
                         .no_slip = fmax(law->H < 0 ? ROUNDING : NO_SLIP, ROUNDING * driving_slips),
                         .longest = INFINITY,
                         .event_at = INFINITY};
  path->point = path->start;
  if (!(driving_slips < MOST_SLIP)) {
    path->status = CAROM_ERROR_OVERFLOW;
    return;
  }
  /* slips that count as zero, and motion along x of which there is none */
  carom_point *point = &path->point;
  if (fabs(a_x) <= path->no_slip && fabs(b_x) <= path->no_slip) {
    if (law->H < 0)
      path->across = fabs(a_x) + fabs(b_x) + rounding;
    point->a_x = point->b_x = 0;
  }
  if (fabs(a_x) + fabs(a_y) <= path->no_slip)
    point->a_x = point->a_y = 0;
  if (fabs(b_x) + fabs(b_y) <= path->no_slip)
    point->b_x = point->b_y = 0;
  if (!carom_impact_regime(path, false))
    path->status = CAROM_ERROR_UNRESOLVED;
}

carom_status carom_impact_advance(carom_trajectory *path, double target, int most) {
  if (path->status == CAROM_OK) {
    switch (carom_isa_of_call(path->plain)) {
#if defined(__x86_64__) && !(defined(CAROM_WITHOUT_AVX2) && defined(CAROM_WITHOUT_AVX512))
    case CAROM_ISA_AVX2:
    case CAROM_ISA_AVX512: /* eight numbers in a vector of AVX-512 are not faster: a step is
                              bound by latency */
      path->status = carom_impact_advance_avx2(path, target, most);
      break;
#endif
    default:
      path->status = carom_impact_advance_plain(path, target, most);
    }
  }
  return path->status;
}

carom_impulses carom_impact_impulses(const carom_trajectory *path) {
  const carom_law *law = &path->law;
  const carom_point *start = &path->start, *point = &path->point;

  /* the changes by friction */
  const double a_x = point->a_x - start->a_x;
  const double a_y = point->a_y - start->a_y - law->A_0 * point->p;
  const double b_x = point->b_x - start->b_x;
  const double approach = point->v - start->v - law->V_0 * point->p;
  if (law->mu_c == 0)
    return (carom_impulses){.p = point->p, .f_x = a_x / law->K_x, .f_y = a_y / law->K_y};

  /* f and F by the two pairs of equations of the head, each with its determinant */
  const double per_x = 1 / (law->K_x * law->H - law->C_x * law->L_x),
               per_y = 1 / (law->K_y * law->V_F - law->C_y * law->V_f);
  return (carom_impulses){.p = point->p,
                          .f_x = (law->H * a_x - law->C_x * b_x) * per_x,
                          .f_y = (law->V_F * a_y - law->C_y * approach) * per_y,
                          .F_x = (law->K_x * b_x - law->L_x * a_x) * per_x,
                          .F_y = (law->K_y * approach - law->V_f * a_y) * per_y};
}

double carom_impact_work(const carom_trajectory *path) {
  return path->restitution ? path->W_c - path->point.W : path->point.W;
}
