/* The only place where the arguments of an impact on a cushion are checked, by the conditions of
 * the comments in carom_shot.h.
 */
#include "cushion/models.h"
#include "platform/ranges.h"
#include "schema/options.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* A vertical velocity that is no more than this fraction of the others is rounding of the
 * caller's. */
static const double level = 1e-9;

enum { FIELDS = 15 };
_Static_assert(sizeof(carom_cushion_impact) == FIELDS * sizeof(double),
               "an impact is 15 doubles without gaps");
_Static_assert(sizeof(carom_motion) == 6 * sizeof(double), "a motion is 6 doubles without gaps");

#define FIELD(member) ((int)(offsetof(carom_cushion_impact, member) / sizeof(double)))

carom_status carom_cushion_check_options(const carom_cushion_options *opt) {
  const carom_cushion_options *o = opt;
  CAROM_RAIL_OPTIONS(CAROM_CHECK_OPTION)
  if (!CAROM_RESERVED_IS_ZERO(opt))
    return CAROM_ERROR_OPTIONS;
  const carom_cushion_options *k = opt;
  CAROM_NUMBERS(CAROM_NO_ROW, CAROM_CHECK_NUMBER)
  CAROM_CONDITIONS(CAROM_NO_ROW, CAROM_CHECK_CONDITION)
  return CAROM_OK;
}

static const carom_range of_field[FIELDS] = {
    {CAROM_FINITE, CAROM_ERROR_VELOCITY},
    {CAROM_FINITE, CAROM_ERROR_VELOCITY},
    {CAROM_FINITE, CAROM_ERROR_VELOCITY},
    {CAROM_FINITE, CAROM_ERROR_SPIN},
    {CAROM_FINITE, CAROM_ERROR_SPIN},
    {CAROM_FINITE, CAROM_ERROR_SPIN},
    {CAROM_FINITE, CAROM_ERROR_NORMAL},
    {CAROM_FINITE, CAROM_ERROR_NORMAL},
    {CAROM_POSITIVE, CAROM_ERROR_NOSE_HEIGHT},
    {CAROM_POSITIVE, CAROM_ERROR_RADIUS},
    {CAROM_POSITIVE, CAROM_ERROR_MASS},
    {CAROM_UNIT_INTERVAL, CAROM_ERROR_MU_SLIDE},
    {CAROM_UNIT_INTERVAL, CAROM_ERROR_MU_CUSHION},
    {CAROM_UNIT_INTERVAL, CAROM_ERROR_RESTITUTION},
    {CAROM_NOT_NEGATIVE, CAROM_ERROR_JAW_RADIUS},
};

carom_status carom_cushion_check_impact(const carom_cushion_impact *in, int *field) {
  *field = carom_first_outside((const double *)in, FIELDS, of_field, FIELDS);
  if (*field < FIELDS)
    return of_field[*field].error;
  /* conditions on several numbers */
  *field = FIELD(normal);
  if (in->normal[0] == 0 && in->normal[1] == 0)
    return CAROM_ERROR_NORMAL;
  *field = FIELD(height);
  if (!(in->height / 2 < in->radius))
    return CAROM_ERROR_NOSE_HEIGHT;
  *field = FIELD(v) + 2;
  if (fabs(in->v[2]) > level * (fabs(in->v[0]) + fabs(in->v[1])))
    return CAROM_ERROR_VERTICAL;
  *field = -1;
  return CAROM_OK;
}

carom_status carom_cushion_check(const carom_cushion_impact *in, const carom_cushion_options *opt,
                                 int *field) {
  int unused, *where = &unused;
  if (field != NULL)
    where = field;
  *where = -1;
  if (in == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = CAROM_OK;
  if (opt != NULL)
    status = carom_cushion_check_options(opt);
  if (status != CAROM_OK)
    return status;
  return carom_cushion_check_impact(in, where);
}

const char *carom_cushion_field_name(int field) {
  static const char *const names[FIELDS] = {
      "v[0]",   "v[1]",   "v[2]", "w[0]",     "w[1]",       "w[2]",        "normal[0]", "normal[1]",
      "height", "radius", "mass", "mu_slide", "mu_cushion", "restitution", "jaw_radius"};
  if (field < 0 || field >= FIELDS)
    return NULL;
  return names[field];
}
