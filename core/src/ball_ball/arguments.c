/* The only place where the arguments of a collision are checked.
 *
 * Two passes: a branch-free one that every call takes and nearly every call passes, and a slow one
 * that finds the first field at fault and names it. Both state the same conditions, which are in
 * the field comments in carom.h.
 */
#include "ball_ball/arguments.h"

#include "platform/ranges.h"
#include "schema/options.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Radii, heights and vertical velocities are results of other programs' arithmetic; an amount below
 * this fraction of the radius, of the distance or of the speed moves no result beyond rounding of
 * the solvers' own size. */
static const double level = 1e-9;

enum { BALL_FIELDS = 12, FIELDS = 26 };
_Static_assert(sizeof(carom_ball) == BALL_FIELDS * sizeof(double),
               "a ball is 12 doubles without gaps");
_Static_assert(sizeof(carom_impact) == FIELDS * sizeof(double),
               "an impact is 26 doubles without gaps");
_Static_assert(sizeof(carom_result) == 12 * sizeof(double), "a result is 12 doubles without gaps");

static int field_at(size_t offset) {
  return (int)(offset / sizeof(double));
}
#define FIELD(member) field_at(offsetof(carom_impact, member))

carom_status carom_check_options(const carom_options *o) {
  CAROM_IMPACT_OPTIONS(CAROM_CHECK_OPTION)
  return carom_ok_if(o->unused == 0 && CAROM_RESERVED_IS_ZERO(o), CAROM_ERROR_OPTIONS);
}

static bool vertical(const carom_ball *ball) {
  return fabs(ball->v[2]) > level * (fabs(ball->v[0]) + fabs(ball->v[1]));
}

static bool heights_differ(const carom_impact *in) {
  const double dx = in->b.r[0] - in->a.r[0], dy = in->b.r[1] - in->a.r[1],
               dz = in->b.r[2] - in->a.r[2];
  return fabs(dz) > level * (fabs(dx) + fabs(dy));
}

/* Two radii: the computation uses ball a's. */
static bool radii_differ(const carom_impact *in) {
  return !(fabs(in->b.radius - in->a.radius) <= level * in->a.radius);
}

static bool coincident(const carom_impact *in) {
  return in->a.r[0] == in->b.r[0] && in->a.r[1] == in->b.r[1] && in->a.r[2] == in->b.r[2];
}

static bool motion_is_finite(const carom_ball *ball) {
  double sum = 0.0; /* stays 0 unless a term is infinite or NaN */
  for (int axis = 0; axis < 3; axis++)
    sum += ball->r[axis] * 0.0 + ball->v[axis] * 0.0 + ball->w[axis] * 0.0;
  return sum == 0.0;
}

/* Of a ball, and of the numbers behind the two balls. */
static const carom_range of_ball[BALL_FIELDS] = {
    {CAROM_FINITE, CAROM_ERROR_POSITION}, {CAROM_FINITE, CAROM_ERROR_POSITION},
    {CAROM_FINITE, CAROM_ERROR_POSITION}, {CAROM_FINITE, CAROM_ERROR_VELOCITY},
    {CAROM_FINITE, CAROM_ERROR_VELOCITY}, {CAROM_FINITE, CAROM_ERROR_VELOCITY},
    {CAROM_FINITE, CAROM_ERROR_SPIN},     {CAROM_FINITE, CAROM_ERROR_SPIN},
    {CAROM_FINITE, CAROM_ERROR_SPIN},     {CAROM_POSITIVE, CAROM_ERROR_RADIUS},
    {CAROM_POSITIVE, CAROM_ERROR_MASS},   {CAROM_UNIT_INTERVAL, CAROM_ERROR_MU_SLIDE},
};
static const carom_range of_pair[] = {
    {CAROM_UNIT_INTERVAL, CAROM_ERROR_MU_BALL},
    {CAROM_UNIT_INTERVAL, CAROM_ERROR_RESTITUTION},
};

static carom_status blame(const carom_impact *in, int *field) {
  const double *x = (const double *)in;
  *field = carom_first_outside(x, 2 * BALL_FIELDS, of_ball, BALL_FIELDS);
  if (*field < 2 * BALL_FIELDS)
    return of_ball[*field % BALL_FIELDS].error;
  const int index = carom_first_outside(x + 2 * BALL_FIELDS, 2, of_pair, 2);
  *field += index;
  if (index < 2)
    return of_pair[index].error;
  *field = -1;
  if (radii_differ(in)) {
    *field = FIELD(b.radius);
    return CAROM_ERROR_RADII_DIFFER;
  }
  if (coincident(in))
    return CAROM_ERROR_COINCIDENT;
  if (heights_differ(in)) {
    *field = FIELD(b.r[2]);
    return CAROM_ERROR_HEIGHTS_DIFFER;
  }
  if (vertical(&in->a) || vertical(&in->b)) {
    *field = FIELD(b.v[2]);
    if (vertical(&in->a))
      *field = FIELD(a.v[2]);
    return CAROM_ERROR_VERTICAL;
  }
  return CAROM_OK;
}

carom_status carom_check_impact(const carom_impact *in, int *field) {
  *field = -1;
  bool good = true; /* joined by & so that all conditions are evaluated and only one branch is
                       taken */
  good &= motion_is_finite(&in->a);
  good &= motion_is_finite(&in->b);
  good &= carom_is_positive(in->a.radius);
  good &= carom_is_positive(in->a.mass);
  good &= carom_is_positive(in->b.mass);
  good &= carom_in_unit_interval(in->a.mu_slide);
  good &= carom_in_unit_interval(in->b.mu_slide);
  good &= carom_in_unit_interval(in->mu_ball);
  good &= carom_in_unit_interval(in->restitution);
  good &= !radii_differ(in);
  good &= !coincident(in);
  good &= !heights_differ(in);
  good &= !vertical(&in->a);
  good &= !vertical(&in->b);
  if (good)
    return CAROM_OK;
  return blame(in, field);
}

carom_status carom_check(const carom_impact *in, const carom_options *opt, int *field) {
  int unused, *where = &unused;
  if (field != NULL)
    where = field;
  *where = -1;
  if (in == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = CAROM_OK;
  if (opt != NULL)
    status = carom_check_options(opt);
  if (status != CAROM_OK)
    return status;
  return carom_check_impact(in, where);
}
