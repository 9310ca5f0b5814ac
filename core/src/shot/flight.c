/* The next meeting of a ball in flight with the table: noses of rails and jaws, tops of rails,
 * pockets, and the end of the table. nose.c has the geometry. In flight x and y are linear in t,
 * and z = z0 + v_z t - g/2 t^2. On a slope x and y have an acceleration 2a as well, which is small.
 *
 *     TOP  . . . . . . . .           z = h + R        '.     the track of the centre
 *                                                       '.
 *     ----------------.  nose,                            o
 *      rail, W wide    \  at the height h             .-'    d, from the nose to the
 *                       o - - - - - - - - - - - - -'         centre; |d| = R: contact
 *     __________________|_____________________________________ cloth
 *                       s = delta            s: distance from the wall
 *
 * RAIL. |d|^2 = (s - delta)^2 + (z - h)^2 is a quartic in t, that of two centres with d in two
 * coordinates (gap.c); a contact beyond the ends of the rail is none, since a jaw or another
 * rail is there.
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
 * rails, and over the disc of a jaw. A ball that is on it, with v_z = 0, has left the table.
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

/* s: a track is inside a circle so soon after it has crossed it, unless it only grazes it */
static const double just_inside = 1e-9;
/* m: rounding of the edges of tops, and of a ball's height on them */
static const double on_top = 1e-9;

/* The track of a ball from now on: r + v t + a t^2 - g/2 t^2 z. */
typedef struct flight {
  double r[3], v[3], gravity, radius;
  double a[2], bend; /* half the acceleration by a slope; 2|a| at most */
} flight;

/* A coordinate of the track, and its rate. */
static double place_at(const flight *track, int axis, double time) {
  return track->r[axis] + time * (track->v[axis] + time * track->a[axis]);
}
static double speed_at(const flight *track, int axis, double time) {
  return track->v[axis] + 2.0 * time * track->a[axis];
}

/* z at a time. */
static double height_at(const flight *track, double time) {
  return track->r[2] + time * (track->v[2] - 0.5 * track->gravity * time);
}

/* ---- Jaws */

/* A circle at a height above the cloth, its axis through `centre`. */
typedef struct nose_circle {
  double centre[2], radius, height;
} nose_circle;

/* What F depends on. */
typedef struct jaw_gap {
  const flight *track;
  const nose_circle *circle;
} jaw_gap;

/* How fast the ball leaves the axis, q', from a position seen from there. */
static double leaving(const flight *track, double time, double x, double y, double q) {
  return q > 0.0 ? (x * speed_at(track, 0, time) + y * speed_at(track, 1, time)) / q : 0.0;
}

/* F and F' at a time. */
static carom_gap_at gap_at(const void *context, double time) {
  const flight *track = ((const jaw_gap *)context)->track;
  const nose_circle *circle = ((const jaw_gap *)context)->circle;
  const double x = place_at(track, 0, time) - circle->centre[0],
               y = place_at(track, 1, time) - circle->centre[1], q = sqrt(x * x + y * y);
  const double z = height_at(track, time) - circle->height,
               v_z = track->v[2] - track->gravity * time, beyond = q - circle->radius;
  return (carom_gap_at){beyond * beyond + z * z - track->radius * track->radius,
                        2.0 * (beyond * leaving(track, time, x, y, q) + z * v_z)};
}

/* q' and q at a time. */
static double leaving_at(const jaw_gap *gap, double time, double *q) {
  const double x = place_at(gap->track, 0, time) - gap->circle->centre[0],
               y = place_at(gap->track, 1, time) - gap->circle->centre[1];
  *q = sqrt(x * x + y * y);
  return leaving(gap->track, time, x, y, *q);
}

/* The bound of F''/2 from `start` to `end`. */
static double least_half_curvature(const void *context, double start, double end) {
  const jaw_gap *gap = context;
  const flight *track = gap->track;

  /* min q'^2: at an end, or 0 where q' changes its sign; on a slope q' may fall between */
  double across = 0.0, q[2];
  const double fall = (end - start) * track->bend; /* of q', at most */
  const double first = leaving_at(gap, start, &q[0]) - fall,
               last = leaving_at(gap, end, &q[1]) + fall;
  if (first >= 0.0)
    across = first * first;
  else if (last <= 0.0)
    across = last * last;

  /* z'^2 - g (z - h) = v_z^2 - g (z0 - h) - 3 g v_z t + 3/2 g^2 t^2, least at t = v_z / g */
  const double top = carom_lesser(carom_greater(track->v[2] / track->gravity, start), end);
  const double upright = track->v[2] * track->v[2] -
                         track->gravity * (track->r[2] - gap->circle->height) +
                         top * track->gravity * (1.5 * track->gravity * top - 3.0 * track->v[2]);

  /* on a slope (q - c) q'' is -2|a| times the greatest distance at least */
  const double farthest = carom_greater(q[0], q[1]) + 0.5 * fall * (end - start);
  return across + upright - track->bend * carom_greater(farthest - gap->circle->radius, 0.0);
}

/* The first zero of F + raise from `start`, where that is positive, to `end`, with q >= c between;
 * or infinity. */
static double zero_from_left(const jaw_gap *gap, double raise, double start, double end) {
  return carom_first_zero(gap_at, least_half_curvature, gap, raise, start, end, 0.0);
}

/* The first contact from `start` to `end`, with q >= c between. Balls that touch at the start and
 * do not close are in contact where the gap has fallen by CAROM_SLACK from that at the start, or,
 * if it has been greater than that on the way, where it is 0: as PRESSED in gap.c.
 */
static double touch_circle(const flight *track, const nose_circle *circle, double start,
                           double end) {
  const jaw_gap context = {track, circle};
  const carom_gap_at gap = gap_at(&context, start);
  const double touching = 2.0 * track->radius * CAROM_SLACK;
  if (gap.value > touching)
    return zero_from_left(&context, 0.0, start, end);
  if (gap.value < -2.0 * track->radius * CAROM_BEHIND)
    return INFINITY;
  if (gap.slope < -2.0 * track->radius * CAROM_NO_SPEED)
    return start;
  const double back = zero_from_left(&context, touching - gap.value, start, end),
               middle = 0.5 * (start + back);
  return back < INFINITY && gap_at(&context, middle).value > touching
             ? zero_from_left(&context, 0.0, middle, end)
             : back;
}

/* The times at which the track crosses a circle, seen from above; the number of them, 0 or 2,
 * infinite where it is inside. On a slope those up to the horizon, the first of them 0 inside.
 */
static int cross_circle(const flight *track, const double centre[2], double radius, double horizon,
                        double times[2]) {
  const double x = track->r[0] - centre[0], y = track->r[1] - centre[1],
               c = x * x + y * y - radius * radius;

  /* on a slope: from outside in, or 0, and from soon after that out again */
  if (track->bend > 0.0) {
    const carom_separation separation = {
        {x, y, 0.0}, {track->v[0], track->v[1], 0.0}, {track->a[0], track->a[1], 0.0}};
    times[0] = c > 0.0 ? carom_first_crossing(&separation, radius, horizon) : 0.0;
    if (!(times[0] <= horizon))
      return 0;
    const double soon = times[0] + just_inside;
    const carom_separation inside = {
        {place_at(track, 0, soon) - centre[0], place_at(track, 1, soon) - centre[1], 0.0},
        {speed_at(track, 0, soon), speed_at(track, 1, soon), 0.0},
        {track->a[0], track->a[1], 0.0}};
    times[1] = soon + carom_first_crossing(&inside, radius, carom_greater(horizon - soon, 0.0));
    return 2;
  }

  /* else by a t^2 + 2 b t + c = 0 */
  const double a = carom_plane_dot(track->v, track->v), b = x * track->v[0] + y * track->v[1];
  times[0] = -INFINITY;
  times[1] = INFINITY;
  if (a == 0.0)
    return c < 0.0 ? 2 : 0;
  return carom_quadratic_zeros(a, 2.0 * b, c, times);
}

/* When the ball touches the nose of a jaw: before it is over the disc, or after that. */
static double meet_jaw(const flight *track, const nose_circle *circle, double horizon) {
  double over[2];
  if (cross_circle(track, circle->centre, circle->radius, horizon, over) < 2 ||
      over[0] >= horizon || over[1] <= 0.0)
    return touch_circle(track, circle, 0.0, horizon);
  const double first = over[0] > 0.0 ? touch_circle(track, circle, 0.0, over[0]) : INFINITY;
  return first < INFINITY || over[1] >= horizon ? first
                                                : touch_circle(track, circle, over[1], horizon);
}

/* ---- Rails and tops */

/* Distance from a line, or position along a rail. */
static double across(const double line[3], const flight *track, double time) {
  return line[0] * place_at(track, 0, time) + line[1] * place_at(track, 1, time) + line[2];
}
static bool is_between_ends(const double along[3], const flight *track, double time) {
  const double place = across(along, track, time);
  return place >= 0.0 && place <= 1.0;
}

/* The part of the time up to the horizon in which the ball is between the ends of a rail: the
 * position is linear in t. False where there is none. On a slope the part in which its chord is, or
 * it could be by its bulge. */
static bool while_beside(const double along[3], const flight *track, double horizon,
                         double window[2]) {
  const double bent = horizon * carom_plane_dot(along, track->a);
  const double bulge = 0.25 * horizon * fabs(bent), place = across(along, track, 0.0),
               speed = carom_plane_dot(along, track->v) + bent;

  /* all of it, or nothing, of a ball that moves across the rail */
  window[0] = 0.0;
  window[1] = horizon;
  if (speed == 0.0)
    return place >= -bulge && place <= 1.0 + bulge;

  /* between the times at which it passes both ends */
  const double leave_p = (-place - copysign(bulge, speed)) / speed,
               leave_q = (1.0 - place + copysign(bulge, speed)) / speed;
  window[0] = carom_greater(0.0, carom_lesser(leave_p, leave_q));
  window[1] = carom_lesser(horizon, carom_greater(leave_p, leave_q));
  return window[0] <= window[1];
}

/* When the ball touches the nose of a rail, between its ends; or infinity. */
static double meet_rail(const carom_features *features, int rail, double height, double shift,
                        const flight *track, double horizon) {
  double window[2];
  if (!while_beside(features->along[rail], track, horizon, window))
    return INFINITY;
  const double *line = features->line[rail], start = window[0],
               above = height_at(track, start) - height;
  const carom_separation separation = {
      {across(line, track, start) - shift, above, 0.0},
      {line[0] * speed_at(track, 0, start) + line[1] * speed_at(track, 1, start),
       track->v[2] - track->gravity * start, 0.0},
      {carom_plane_dot(line, track->a), -0.5 * track->gravity, 0.0}};
  const double reach = track->radius - CAROM_BEHIND;
  if (separation.d0[0] * separation.d0[0] + above * above < reach * reach)
    return INFINITY;
  const double time = start + carom_first_contact(&separation, track->radius, window[1] - start);
  if (track->bend > 0.0 && time < INFINITY && !is_between_ends(features->along[rail], track, time))
    return INFINITY;
  return time;
}

/* When the ball falls on a plane; *lies becomes whether it is already on it. A ball that is hardly
 * lower counts as on it, unless it rises over it. */
static double fall_on(const flight *track, double plane, bool *lies) {
  double above = track->r[2] - plane;
  if (fabs(above) <= on_top) {
    *lies = track->v[2] == 0.0;
    if (!(track->v[2] > 0.0 && track->v[2] * track->v[2] + 2.0 * track->gravity * above > 0.0))
      above = carom_greater(above, 0.0);
  }
  return carom_fall_time(above, track->v[2], track->gravity);
}

/* ---- All of it */

/* Replaces the first meeting by an earlier one. */
static void take_earlier(carom_meeting *first, double time, int type, int part, double *horizon) {
  if (!(time <= *horizon) || (time >= first->time && type != CAROM_EVENT_POCKET))
    return;
  *first = (carom_meeting){time, type, part};
  *horizon = time;
}

static bool is_beside(const carom_features *features, int index, const float box[4]) {
  return features->low_x[index] <= box[1] && features->high_x[index] >= box[0] &&
         features->low_y[index] <= box[3] && features->high_y[index] >= box[2];
}

/* The box of the track from above and `more` around it, in single precision, for which the boxes of
 * the features allow. */
static void box_of(const flight *track, double horizon, double more, float box[4]) {
  for (int axis = 0; axis < 2; axis++) {
    const double end = place_at(track, axis, horizon),
                 around = more + 0.25 * horizon * horizon * fabs(track->a[axis]);
    box[2 * axis] = (float)(carom_lesser(track->r[axis], end) - around);
    box[2 * axis + 1] = (float)(carom_greater(track->r[axis], end) + around);
  }
}

/* The centre leaves the hull grown by the width of the rails. */
static double leave(const carom_features *features, const flight *track) {
  double first = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    const double low = features->hull[2 * axis] - features->width,
                 high = features->hull[2 * axis + 1] + features->width;
    if (track->r[axis] < low || track->r[axis] > high)
      return 0.0;
    double zero[2];
    const double bounds[2] = {low, high};
    for (int side = 0; side < 2 && track->bend > 0.0; side++) {
      const int zeros = carom_quadratic_zeros(track->a[axis], track->v[axis],
                                              track->r[axis] - bounds[side], zero);
      for (int index = 0; index < zeros; index++)
        if (zero[index] >= 0.0)
          first = carom_lesser(first, zero[index]);
    }
    if (track->v[axis] != 0.0 && !(track->bend > 0.0))
      first = carom_lesser(first,
                           ((track->v[axis] < 0.0 ? low : high) - track->r[axis]) / track->v[axis]);
  }
  return first;
}

/* Whether the ball is over a top at a time. */
static bool over_rail(const carom_features *features, int rail, double shift, const flight *track,
                      double time) {
  const double distance = across(features->line[rail], track, time);
  return distance >= -features->width && distance <= shift + on_top &&
         is_between_ends(features->along[rail], track, time);
}
static bool over_jaw(const nose_circle *circle, const flight *track, double time) {
  const double x = place_at(track, 0, time) - circle->centre[0],
               y = place_at(track, 1, time) - circle->centre[1], reach = circle->radius + on_top;
  return x * x + y * y <= reach * reach;
}

/* Noses and tops of rails and jaws. Each narrows the horizon of those behind it. */
static void meet_cushions(const carom_sim *sim, const carom_ball_kind *kind, const flight *track,
                          carom_meeting *first, double *horizon) {
  const carom_features *features = sim->features;
  const double low = carom_nose_height(kind, features->nose_low),
               rise = track->v[2] > 0.0 ? 0.5 * track->v[2] * track->v[2] / track->gravity : 0.0;

  /* it is or will be higher than a rail */
  const bool above = track->r[2] + rise >= low + track->radius - on_top;

  /* of the parts next to the track only, as noses are inside their walls by less than a radius;
   * their tops from above */
  float box[4];
  box_of(track, *horizon, features->reference, box);

  /* of the height of the last part, which most parts share */
  double height = -1.0, shift = 0.0, top = INFINITY;
  bool lies = false;
  for (int index = 0; index < features->rails + features->jaws; index++) {
    const bool is_near = is_beside(features, index, box);
    if (!above && !is_near)
      continue;
    const int jaw_index = index - features->rails;

    /* its nose, or the circle of that */
    const double nose = carom_nose_height(kind, jaw_index < 0 ? sim->table->rail[index].height
                                                              : sim->table->jaw[jaw_index].height);
    if (nose != height) {
      height = nose;
      shift = carom_nose_shift(nose, features->reference);
      lies = false;
      top = above ? fall_on(track, nose + track->radius, &lies) : INFINITY;
    }
    nose_circle circle = {.height = nose};
    if (jaw_index >= 0) {
      const carom_jaw *jaw = &sim->table->jaw[jaw_index];
      circle = (nose_circle){{jaw->centre[0], jaw->centre[1]}, jaw->radius + shift, nose};
    }

    /* its top, on which a ball that rests has left the table; then the nose */
    if (top <= *horizon && (jaw_index < 0 ? over_rail(features, index, shift, track, top)
                                          : over_jaw(&circle, track, top)))
      take_earlier(first, top, lies ? CAROM_EVENT_LEFT_TABLE : CAROM_EVENT_RAIL_TOP,
                   lies ? -1 : index, horizon);
    if (is_near && jaw_index < 0)
      take_earlier(first, meet_rail(features, index, nose, shift, track, *horizon),
                   CAROM_EVENT_RAIL, index, horizon);
    else if (is_near)
      take_earlier(first, meet_jaw(track, &circle, *horizon), CAROM_EVENT_JAW, jaw_index, horizon);
  }
}

/* Pockets that the ball falls into. */
static void meet_pockets(const carom_sim *sim, const flight *track, double landing,
                         carom_meeting *first, double *horizon) {
  const carom_features *features = sim->features;
  float box[4];
  box_of(track, *horizon, 0.0, box);
  for (int index = 0; index < features->pockets; index++) {
    const carom_pocket *pocket = &sim->table->pocket[index];
    double over[2];
    if (!is_beside(features, features->rails + features->jaws + index, box) ||
        cross_circle(track, pocket->centre, pocket->radius, landing, over) < 2 || over[1] < 0.0 ||
        over[0] >= landing)
      continue;
    const double time = carom_lesser(over[1], landing);
    if (over[1] >= landing || height_at(track, time) <= features->pocket_back)
      take_earlier(first, time, CAROM_EVENT_POCKET, index, horizon);
  }
}

carom_meeting carom_meet_in_flight(const carom_sim *sim, int ball, const double r[3],
                                   const double v[3], double landing) {
  const carom_ball_kind *kind = sim->layout->kind[ball];
  const double *half_acceleration = sim->path[ball].a;
  const flight track = {{r[0], r[1], r[2]},
                        {v[0], v[1], v[2]},
                        kind->gravity,
                        kind->radius,
                        {half_acceleration[0], half_acceleration[1]},
                        2.0 * (fabs(half_acceleration[0]) + fabs(half_acceleration[1]))};
  carom_meeting first = {INFINITY, CAROM_DUE_NOTHING, 0};
  double horizon = landing;
  take_earlier(&first, leave(sim->features, &track), CAROM_EVENT_LEFT_TABLE, -1, &horizon);
  meet_cushions(sim, kind, &track, &first, &horizon);
  meet_pockets(sim, &track, landing, &first, &horizon);
  if (first.type == CAROM_DUE_NOTHING) { /* it lands */
    const double place[2] = {place_at(&track, 0, landing), place_at(&track, 1, landing)};
    if (carom_place_is_outside(sim->table, sim->features, kind, place))
      first = (carom_meeting){landing, CAROM_EVENT_LEFT_TABLE, -1};
  }
  return first;
}
