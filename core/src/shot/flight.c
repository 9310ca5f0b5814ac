/* The next meeting of a ball in flight with the table: noses of rails and jaws, tops of rails,
 * pockets, and the end of the table. nose.c has the geometry. In flight x and y are linear in t,
 * and z = z0 + v_z t - g/2 t^2. On a slope x and y have an acceleration 2a as well, which is small.
 *
 * RAIL. |d|^2 = (s - delta)^2 + (z - h)^2 is a quartic in t, that of two centres with d in two
 * coordinates (gap.c); a contact beyond the ends of the rail is none, since a jaw or another
 * rail stands there.
 *
 * JAW. With q the horizontal distance from the axis, c = rho + delta and F = (q - c)^2 + (z -
 * h)^2 - R^2, squaring twice would give degree 8. But q'' >= 0 on a straight track, so where q
 * >= c
 *
 *   F''/2 >= min q'^2 + min (z'^2 - g (z - h))
 *
 * on any interval: q' rises, so the least q'^2 is at an end, or 0; the second term is a parabola
 * opening upward. That is the bound for first_zero.h. On a slope q'' >= -2|a|, which lowers both
 * parts. [0, T] is cut where q = c, two zeros of a quadratic; between them the ball is over the
 * disc, and the contact is that of the top.
 *
 * TOP. The plane z = h + R over the strip -W <= s < delta behind a nose, W the width of the
 * rails, and over the disc of a jaw. A ball that lies on it, with v_z = 0, has left the table.
 *
 * POCKET. The ball is over the circle from t_in to t_out, zeros of a quadratic. Where t_in is
 * before its landing it is looked at at t* = min(t_out, landing): if its centre is not above the
 * pocket's back there, it falls into the pocket at t*. So a ball that lands in the circle always
 * falls.
 *
 * LEAVING. The ball has left the table where its centre leaves the hull grown by W, or where it
 * would land outside the cushions. */
#include "motion/first_zero.h"
#include "motion/gap.h"
#include "shot/sim.h"

#include <math.h>

static const double on_top = 1e-9; /* m: rounding of the edges of tops, and of a ball's height on
                                      them */

typedef struct flight {
  double r[3], v[3], g, radius;
  double a[2], bend; /* half the acceleration by a slope; 2|a| at most */
} flight;

/* A coordinate of the track, and its rate. */
static double place_at(const flight *f, int k, double t) {
  return f->r[k] + t * (f->v[k] + t * f->a[k]);
}
static double speed_at(const flight *f, int k, double t) {
  return f->v[k] + 2.0 * t * f->a[k];
}

static double height_at(const flight *f, double t) {
  return f->r[2] + t * (f->v[2] - 0.5 * f->g * t);
}

/* ---- Jaws */

/* A circle at a height above the cloth, its axis through `centre`. */
typedef struct circle {
  double centre[2], radius, height;
} circle;

typedef struct jaw_gap {
  const flight *f;
  const circle *c;
} jaw_gap;

/* How fast the ball leaves the axis, q', from a place seen from there. */
static double leaving(const flight *f, double t, double x, double y, double q) {
  return q > 0.0 ? (x * speed_at(f, 0, t) + y * speed_at(f, 1, t)) / q : 0.0;
}

static carom_gap_at gap_at(const void *context, double t) {
  const flight *f = ((const jaw_gap *)context)->f;
  const circle *c = ((const jaw_gap *)context)->c;
  const double x = place_at(f, 0, t) - c->centre[0], y = place_at(f, 1, t) - c->centre[1],
               q = sqrt(x * x + y * y);
  const double z = height_at(f, t) - c->height, v_z = f->v[2] - f->g * t, s = q - c->radius;
  return (carom_gap_at){s * s + z * z - f->radius * f->radius,
                        2.0 * (s * leaving(f, t, x, y, q) + z * v_z)};
}

static double leaving_at(const jaw_gap *g, double t, double *q) {
  const double x = place_at(g->f, 0, t) - g->c->centre[0],
               y = place_at(g->f, 1, t) - g->c->centre[1];
  *q = sqrt(x * x + y * y);
  return leaving(g->f, t, x, y, *q);
}

/* The bound of F''/2 on [t, T]. */
static double least_half_curvature(const void *context, double t, double T) {
  const jaw_gap *g = context;
  const flight *f = g->f;
  double across = 0.0, q[2];
  const double fall = (T - t) * f->bend; /* of q', at most */
  const double first = leaving_at(g, t, &q[0]) - fall, last = leaving_at(g, T, &q[1]) + fall;
  if (first >= 0.0)
    across = first * first;
  else if (last <= 0.0)
    across = last * last;
  /* z'^2 - g (z - h) = v_z^2 - g (z0 - h) - 3 g v_z t + 3/2 g^2 t^2, least at t = v_z / g */
  const double top = carom_lesser(carom_greater(f->v[2] / f->g, t), T);
  const double upright = f->v[2] * f->v[2] - f->g * (f->r[2] - g->c->height) +
                         top * f->g * (1.5 * f->g * top - 3.0 * f->v[2]);
  const double farthest = carom_greater(q[0], q[1]) + 0.5 * fall * (T - t);
  return across + upright - f->bend * carom_greater(farthest - g->c->radius, 0.0);
}

/* The first zero of F + raise from t on, where that is positive, up to T, with q >= c between;
 * or infinity. */
static double zero_from_left(const jaw_gap *g, double raise, double t, double T) {
  return carom_first_zero(gap_at, least_half_curvature, g, raise, t, T, 0.0);
}

/* The first contact on [t, T], with q >= c between. Balls that touch at t and do not close are
 * in contact where the gap has fallen by CAROM_SLACK from that at t, or, if it has been greater
 * than that on the way, where it is 0: as PRESSED in gap.c.
 */
static double touch_circle(const flight *f, const circle *c, double t, double T) {
  const jaw_gap g = {f, c};
  const carom_gap_at gap = gap_at(&g, t);
  const double touching = 2.0 * f->radius * CAROM_SLACK;
  if (gap.value > touching)
    return zero_from_left(&g, 0.0, t, T);
  if (gap.value < -2.0 * f->radius * CAROM_BEHIND)
    return INFINITY;
  if (gap.slope < -2.0 * f->radius * CAROM_NO_SPEED)
    return t;
  const double back = zero_from_left(&g, touching - gap.value, t, T), middle = 0.5 * (t + back);
  return back < INFINITY && gap_at(&g, middle).value > touching ? zero_from_left(&g, 0.0, middle, T)
                                                                : back;
}

/* The times at which the track crosses a circle, seen from above; the number of them, 0 or 2,
 * infinite where it stands inside. On a slope those up to T, the first of them 0 inside.
 */
static int cross_circle(const flight *f, const double centre[2], double radius, double T,
                        double t[2]) {
  const double x = f->r[0] - centre[0], y = f->r[1] - centre[1],
               c = x * x + y * y - radius * radius;
  if (f->bend > 0.0) {
    const carom_separation d = {{x, y, 0.0}, {f->v[0], f->v[1], 0.0}, {f->a[0], f->a[1], 0.0}};
    t[0] = c > 0.0 ? carom_first_crossing(&d, radius, T) : (double)0.0;
    if (!(t[0] <= T))
      return 0;
    const double s = t[0] + 1e-9; /* s: inside, unless the track only grazes the circle */
    const carom_separation inside = {
        {place_at(f, 0, s) - centre[0], place_at(f, 1, s) - centre[1], 0.0},
        {speed_at(f, 0, s), speed_at(f, 1, s), 0.0},
        {f->a[0], f->a[1], 0.0}};
    t[1] = s + carom_first_crossing(&inside, radius, carom_greater(T - s, 0.0));
    return 2;
  }
  const double a = carom_plane_dot(f->v, f->v), b = x * f->v[0] + y * f->v[1];
  t[0] = -INFINITY;
  t[1] = INFINITY;
  if (a == 0.0)
    return c < 0.0 ? 2 : 0;
  return carom_quadratic_zeros(a, 2.0 * b, c, t);
}

static double meet_jaw(const flight *f, const circle *c, double T) {
  double over[2];
  if (cross_circle(f, c->centre, c->radius, T, over) < 2 || over[0] >= T || over[1] <= 0.0)
    return touch_circle(f, c, 0.0, T);
  const double first = over[0] > 0.0 ? touch_circle(f, c, 0.0, over[0]) : INFINITY;
  return first < INFINITY || over[1] >= T ? first : touch_circle(f, c, over[1], T);
}

/* ---- Rails and tops */

static double across(const double line[3], const flight *f, double t) {
  return line[0] * place_at(f, 0, t) + line[1] * place_at(f, 1, t) + line[2];
}
static bool is_between_ends(const double along[3], const flight *f, double t) {
  const double place = across(along, f, t);
  return place >= 0.0 && place <= 1.0;
}

/* The part of [0, T] in which the ball is between the ends of a rail: place is linear in t. False
 * where there is none. On a slope the part in which its chord is, or it could be by its bulge. */
static bool while_beside(const double along[3], const flight *f, double T, double window[2]) {
  const double bent = T * carom_plane_dot(along, f->a);
  const double bulge = 0.25 * T * fabs(bent), place = across(along, f, 0.0),
               speed = carom_plane_dot(along, f->v) + bent;
  window[0] = 0.0;
  window[1] = T;
  if (speed == 0.0)
    return place >= -bulge && place <= 1.0 + bulge;
  const double leave_p = (-place - copysign(bulge, speed)) / speed,
               leave_q = (1.0 - place + copysign(bulge, speed)) / speed;
  window[0] = carom_greater(0.0, carom_lesser(leave_p, leave_q));
  window[1] = carom_lesser(T, carom_greater(leave_p, leave_q));
  return window[0] <= window[1];
}

static double meet_rail(const carom_features *features, int k, double height, double shift,
                        const flight *f, double T) {
  double window[2];
  if (!while_beside(features->along[k], f, T, window))
    return INFINITY;
  const double *line = features->line[k], start = window[0], z = height_at(f, start) - height;
  const carom_separation d = {{across(line, f, start) - shift, z, 0.0},
                              {line[0] * speed_at(f, 0, start) + line[1] * speed_at(f, 1, start),
                               f->v[2] - f->g * start, 0.0},
                              {carom_plane_dot(line, f->a), -0.5 * f->g, 0.0}};
  const double reach = f->radius - CAROM_BEHIND;
  if (d.d0[0] * d.d0[0] + z * z < reach * reach)
    return INFINITY;
  const double t = start + carom_first_contact(&d, f->radius, window[1] - start);
  if (f->bend > 0.0 && t < INFINITY && !is_between_ends(features->along[k], f, t))
    return INFINITY;
  return t;
}

/* When the ball falls on a plane; *lies becomes whether it lies on it now. A ball that is hardly
 * lower counts as on it, unless it rises over it. */
static double fall_on(const flight *f, double plane, bool *lies) {
  double above = f->r[2] - plane;
  if (fabs(above) <= on_top) {
    *lies = f->v[2] == 0.0;
    if (!(f->v[2] > 0.0 && f->v[2] * f->v[2] + 2.0 * f->g * above > 0.0))
      above = carom_greater(above, 0.0);
  }
  return carom_fall_time(above, f->v[2], f->g);
}

/* ---- All of it */

/* Replaces the first meeting by an earlier one. */
static void take_earlier(carom_meeting *first, double t, int type, int part, double *T) {
  if (!(t <= *T) || (t >= first->time && type != CAROM_EVENT_POCKET))
    return;
  *first = (carom_meeting){t, type, part};
  *T = t;
}

static bool is_beside(const carom_features *f, int k, const float box[4]) {
  return f->low_x[k] <= box[1] && f->high_x[k] >= box[0] && f->low_y[k] <= box[3] &&
         f->high_y[k] >= box[2];
}

/* The box of the track from above and `more` around it, in single precision, which those of the
 * features allow for. */
static void box_of(const flight *f, double T, double more, float box[4]) {
  for (int k = 0; k < 2; k++) {
    const double end = place_at(f, k, T), around = more + 0.25 * T * T * fabs(f->a[k]);
    box[2 * k] = (float)(carom_lesser(f->r[k], end) - around);
    box[2 * k + 1] = (float)(carom_greater(f->r[k], end) + around);
  }
}

/* The centre leaves the hull grown by the width of the rails. */
static double leave(const carom_features *features, const flight *f) {
  double first = INFINITY;
  for (int k = 0; k < 2; k++) {
    const double low = features->hull[2 * k] - features->width,
                 high = features->hull[2 * k + 1] + features->width;
    if (f->r[k] < low || f->r[k] > high)
      return 0.0;
    double zero[2];
    const double bounds[2] = {low, high};
    for (int side = 0; side < 2 && f->bend > 0.0; side++) {
      const int zeros = carom_quadratic_zeros(f->a[k], f->v[k], f->r[k] - bounds[side], zero);
      for (int z = 0; z < zeros; z++)
        if (zero[z] >= 0.0)
          first = carom_lesser(first, zero[z]);
    }
    if (f->v[k] != 0.0 && !(f->bend > 0.0))
      first = carom_lesser(first, ((f->v[k] < 0.0 ? low : high) - f->r[k]) / f->v[k]);
  }
  return first;
}

/* Whether the ball is over a top at a time. */
static bool over_rail(const carom_features *features, int k, double shift, const flight *f,
                      double t) {
  const double s = across(features->line[k], f, t);
  return s >= -features->width && s <= shift + on_top && is_between_ends(features->along[k], f, t);
}
static bool over_jaw(const circle *c, const flight *f, double t) {
  const double x = place_at(f, 0, t) - c->centre[0], y = place_at(f, 1, t) - c->centre[1],
               reach = c->radius + on_top;
  return x * x + y * y <= reach * reach;
}

/* Noses and tops of rails and jaws. Each narrows the horizon of those behind it. */
static void meet_cushions(const carom_sim *sim, const carom_ball_kind *kind, const flight *f,
                          carom_meeting *first, double *T) {
  const carom_features *features = sim->features;
  const double low = carom_nose_height(kind, features->nose_low),
               rise = f->v[2] > 0.0 ? 0.5 * f->v[2] * f->v[2] / f->g : 0.0;
  /* it is or comes to be higher than a rail */
  const bool above = f->r[2] + rise >= low + f->radius - on_top;

  /* of the parts beside the track only; their tops from above */
  float box[4];
  box_of(f, *T, features->reference, box); /* noses are inside their walls, by less than that */
  /* of the height of the last part, which most parts share */
  double height = -1.0, shift = 0.0, top = INFINITY;
  bool lies = false;
  for (int k = 0; k < features->rails + features->jaws; k++) {
    const bool is_near = is_beside(features, k, box);
    if (!above && !is_near)
      continue;
    const int j = k - features->rails;

    /* its nose, or the circle of that */
    const double h =
        carom_nose_height(kind, j < 0 ? sim->table->rail[k].height : sim->table->jaw[j].height);
    if (h != height) {
      height = h;
      shift = carom_nose_shift(h, features->reference);
      lies = false;
      top = above ? fall_on(f, h + f->radius, &lies) : INFINITY;
    }
    circle c = {.height = h};
    if (j >= 0) {
      const carom_jaw *jaw = &sim->table->jaw[j];
      c = (circle){{jaw->centre[0], jaw->centre[1]}, jaw->radius + shift, h};
    }

    /* its top, on which a ball that rests has left the table; then the nose */
    if (top <= *T && (j < 0 ? over_rail(features, k, shift, f, top) : over_jaw(&c, f, top)))
      take_earlier(first, top, lies ? CAROM_EVENT_LEFT_TABLE : CAROM_EVENT_RAIL_TOP, lies ? -1 : k,
                   T);
    if (is_near && j < 0)
      take_earlier(first, meet_rail(features, k, h, shift, f, *T), CAROM_EVENT_RAIL, k, T);
    else if (is_near)
      take_earlier(first, meet_jaw(f, &c, *T), CAROM_EVENT_JAW, j, T);
  }
}

static void meet_pockets(const carom_sim *sim, const flight *f, double landing,
                         carom_meeting *first, double *T) {
  const carom_features *features = sim->features;
  float box[4];
  box_of(f, *T, 0.0, box);
  for (int k = 0; k < features->pockets; k++) {
    const carom_pocket *pocket = &sim->table->pocket[k];
    double over[2];
    if (!is_beside(features, features->rails + features->jaws + k, box) ||
        cross_circle(f, pocket->centre, pocket->radius, landing, over) < 2 || over[1] < 0.0 ||
        over[0] >= landing)
      continue;
    const double t = carom_lesser(over[1], landing);
    if (over[1] >= landing || height_at(f, t) <= features->pocket_back)
      take_earlier(first, t, CAROM_EVENT_POCKET, k, T);
  }
}

carom_meeting carom_meet_in_flight(const carom_sim *sim, int i, const double r[3],
                                   const double v[3], double landing) {
  const carom_ball_kind *kind = sim->layout->kind[i];
  const double *a = sim->path[i].a;
  const flight f = {{r[0], r[1], r[2]}, {v[0], v[1], v[2]}, kind->gravity,
                    kind->radius,       {a[0], a[1]},       2.0 * (fabs(a[0]) + fabs(a[1]))};
  carom_meeting first = {INFINITY, CAROM_DUE_NOTHING, 0};
  double T = landing;
  take_earlier(&first, leave(sim->features, &f), CAROM_EVENT_LEFT_TABLE, -1, &T);
  meet_cushions(sim, kind, &f, &first, &T);
  meet_pockets(sim, &f, landing, &first, &T);
  if (first.type == CAROM_DUE_NOTHING) { /* it lands */
    const double place[2] = {place_at(&f, 0, landing), place_at(&f, 1, landing)};
    if (carom_place_is_outside(sim->table, sim->features, kind, place))
      first = (carom_meeting){landing, CAROM_EVENT_LEFT_TABLE, -1};
  }
  return first;
}
