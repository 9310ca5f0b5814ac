/* States for drawing: pocketed balls that fall.
 *
 * For the shot a ball that reaches a pocket's circle is down. For drawing it falls freely from
 * there, until it lies at the pocket's depth. Let p be its place from the pocket's middle, and v
 * its horizontal velocity, where it reaches the circle. It goes straight,
 *     p(t) = p + v t,
 * to the wall, which is the circle of radius W on which its centre can be; then with the part of
 * v along the wall, u, around on it by the angle u t / W. W is the pocket's radius less the ball's;
 * where its way passes the middle farther off than that, W is that distance, and where it flies
 * across the circle and is on its way out, W is where it is. So nothing jumps but the end: the
 * ball is seen no longer. */
#include "carom_shot.h"
#include "platform/elementary.h"
#include "platform/ranges.h"

#include <math.h>

/* A ball that came to a pocket in the state `from`, after the time t. */
static void fall(const carom_pocket *pocket, const carom_ball_kind *kind,
                 const carom_ball_state *from, double t, carom_ball_state *state) {
  /* down to the depth */
  const double top = from->r[2], rise = from->v[2], g = kind->gravity;
  const double height = top + t * (rise - 0.5 * g * t);
  if (!(g > 0.0) || (height <= -pocket->depth && rise - g * t <= 0.0))
    return;

  /* the middle of the way is nearest to the pocket's; W */
  const double x = from->r[0] - pocket->centre[0], y = from->r[1] - pocket->centre[1],
               vx = from->v[0], vy = from->v[1];
  const double speed2 = vx * vx + vy * vy, inward = -(x * vx + y * vy);
  const double middle = speed2 > 0.0 ? inward / speed2 : 0.0;
  const double nearest2 = carom_greater(x * x + y * y - middle * inward, 0.0);
  double wall = carom_greater(pocket->radius - kind->radius, sqrt(nearest2));
  double hit = INFINITY;
  if (speed2 > 0.0)
    hit = middle + sqrt(carom_greater(wall * wall - nearest2, 0.0) / speed2);
  if (hit < 0.0) {
    hit = 0.0;
    wall = sqrt(x * x + y * y);
  }

  /* straight to the wall */
  const double straight = carom_lesser(t, hit);
  double px = x + straight * vx, py = y + straight * vy, wx = vx, wy = vy;
  if (t > hit && wall > 0.0) {
    /* and around on it */
    const double along = (px * vy - py * vx) / wall;
    double s, c;
    carom_sincos(along * (t - hit) / wall, &s, &c);
    const double qx = px * c - py * s, qy = px * s + py * c;
    px = qx;
    py = qy;
    wx = -along * py / wall;
    wy = along * px / wall;
  }
  state->r[0] = pocket->centre[0] + px;
  state->r[1] = pocket->centre[1] + py;
  state->r[2] = height;
  state->v[0] = wx;
  state->v[1] = wy;
  state->v[2] = rise - g * t;
}

carom_status carom_shot_drawn(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_shot *shot, const double *times, size_t n,
                              carom_ball_state *states) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_shot_at_times(balls, count, shot, times, n, states);
  if (status < 0)
    return status;
  const int64_t known = shot->count < shot->room ? shot->count : shot->room;
  for (int64_t e = 0; shot->events != NULL && e < known; e++) {
    const carom_event *event = &shot->events[e];
    if (event->type != CAROM_EVENT_POCKET || event->a < 0 || event->a >= count || event->b < 0 ||
        event->b >= table->pockets)
      continue;
    for (size_t k = 0; k < n; k++)
      if (times[k] >= event->time)
        fall(&table->pocket[event->b], &balls[event->a].kind, &event->before[0],
             times[k] - event->time, &states[k * (size_t)count + (size_t)event->a]);
  }
  return status;
}
