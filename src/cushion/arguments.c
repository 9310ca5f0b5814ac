/* The one place where the arguments of an impact on a cushion are checked, by the conditions of the comments in carom_shot.h.
 */
#include "cushion/models.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* A vertical velocity that is no more than this share of the others is rounding of the caller's. */
static const double level = 1e-9;

enum { FIELDS = 15 };
_Static_assert(sizeof(carom_cushion_impact) == FIELDS * sizeof(double), "an impact is 15 doubles without gaps");
_Static_assert(sizeof(carom_motion) == 6 * sizeof(double), "a motion is 6 doubles without gaps");

#define FIELD(member) ((int)(offsetof(carom_cushion_impact, member) / sizeof(double)))

carom_status carom_cushion_check_options(const carom_cushion_options *opt) {
  bool reserved = (opt->plain & ~1) != 0;
  for (size_t k = 0; k < sizeof opt->reserved / sizeof opt->reserved[0]; k++)
    reserved |= opt->reserved[k] != 0;
  if (carom_cushion_model_name(opt->model) == NULL)
    return CAROM_ERROR_CUSHION_MODEL;
  if (opt->steps < 0)
    return CAROM_ERROR_STEPS;
  if (opt->threads < 0 && opt->threads != CAROM_ALL_THREADS)
    return CAROM_ERROR_THREADS;
  if (reserved)
    return CAROM_ERROR_OPTIONS;
  const bool convention = (int)opt->convention >= 0 && opt->convention <= CAROM_CONVENTION_POOLTOOL;
  const bool law = (int)opt->law >= 0 && opt->law <= CAROM_CUSHION_LAW_HAN;
  const bool step = opt->least_step >= 0 && opt->least_step < INFINITY;
  const bool ratio = opt->omega_ratio == 0 || (opt->omega_ratio > 1 && opt->omega_ratio < 2);
  return convention && law && step && ratio ? CAROM_OK : CAROM_ERROR_CUSHION_OPTIONS;
}

static bool unit_interval(double x) {
  return x >= 0 && x <= 1;
}

static bool positive(double x) {
  return x > 0 && x < INFINITY;
}

/* The first number at fault, or -1. */
static int fault(const carom_cushion_impact *in) {
  for (int k = 0; k < 3; k++)
    if (!isfinite(in->v[k]))
      return FIELD(v) + k;
  for (int k = 0; k < 3; k++)
    if (!isfinite(in->w[k]))
      return FIELD(w) + k;
  for (int k = 0; k < 2; k++)
    if (!isfinite(in->normal[k]))
      return FIELD(normal) + k;
  if (in->normal[0] == 0 && in->normal[1] == 0)
    return FIELD(normal);
  if (!positive(in->radius))
    return FIELD(radius);
  if (!(in->height > 0 && in->height / 2 < in->radius))
    return FIELD(height);
  if (!positive(in->mass))
    return FIELD(mass);
  if (!unit_interval(in->mu_cloth))
    return FIELD(mu_cloth);
  if (!unit_interval(in->mu_cushion))
    return FIELD(mu_cushion);
  if (!unit_interval(in->restitution))
    return FIELD(restitution);
  if (!(in->jaw_radius >= 0 && in->jaw_radius < INFINITY))
    return FIELD(jaw_radius);
  if (fabs(in->v[2]) > level * (fabs(in->v[0]) + fabs(in->v[1])))
    return FIELD(v) + 2;
  return -1;
}

carom_status carom_cushion_check_impact(const carom_cushion_impact *in, int *field) {
  const int at = *field = fault(in);
  if (at < 0)
    return CAROM_OK;
  if (at == FIELD(v) + 2 && isfinite(in->v[2]))
    return CAROM_ERROR_VERTICAL;
  static const carom_status of_field[FIELDS] = {
      CAROM_ERROR_VELOCITY, CAROM_ERROR_VELOCITY, CAROM_ERROR_VELOCITY,   CAROM_ERROR_SPIN,        CAROM_ERROR_SPIN,
      CAROM_ERROR_SPIN,     CAROM_ERROR_NORMAL,   CAROM_ERROR_NORMAL,     CAROM_ERROR_NOSE_HEIGHT, CAROM_ERROR_RADIUS,
      CAROM_ERROR_MASS,     CAROM_ERROR_MU_CLOTH, CAROM_ERROR_MU_CUSHION, CAROM_ERROR_RESTITUTION, CAROM_ERROR_JAW_RADIUS};
  return of_field[at];
}

carom_status carom_cushion_check(const carom_cushion_impact *in, const carom_cushion_options *opt, int *field) {
  int unused;
  int *where = field != NULL ? field : &unused;
  *where = -1;
  if (in == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = opt != NULL ? carom_cushion_check_options(opt) : CAROM_OK;
  return status != CAROM_OK ? status : carom_cushion_check_impact(in, where);
}

const char *carom_cushion_field_name(int field) {
  static const char *const names[FIELDS] = {"v[0]", "v[1]",      "v[2]",       "w[0]",        "w[1]",
                                            "w[2]", "normal[0]", "normal[1]",  "height",      "radius",
                                            "mass", "mu_cloth",  "mu_cushion", "restitution", "jaw_radius"};
  return field >= 0 && field < FIELDS ? names[field] : NULL;
}

const char *carom_cushion_model_name(carom_cushion_model model) {
  switch (model) {
  case CAROM_CUSHION_MATHAVAN:
    return "mathavan";
  case CAROM_CUSHION_STRONGE:
    return "stronge";
  case CAROM_CUSHION_HAN:
    return "han";
  case CAROM_CUSHION_MIRROR:
    return "mirror";
  case CAROM_CUSHION_EULER:
    return "euler";
  }
  return NULL;
}
