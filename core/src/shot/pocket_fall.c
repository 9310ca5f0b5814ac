/* States for drawing: pocketed balls that fall.
 *
 * For the shot a ball that reaches a pocket's circle is down. For drawing it falls freely from
 * there, until it lies at the pocket's depth, where it stays. Let p be its place from the pocket's
 * middle, and v its horizontal velocity, where it reaches the circle. It goes straight,
 *     p(t) = p + v t,
 * to the wall, which is the circle of radius W on which its centre can be; then with the part of
 * v along the wall, u, around on it by the angle u t / W. W is the pocket's radius less the ball's;
 * where its way passes the middle farther off than that, W is that distance, and where it flies
 * across the circle and is on its way out, W is where it is.
 *
 * A ball that comes down on one that lies, at q, goes on around it in the direction in which it
 * touched it, at the level distance
 *     D = sqrt((R + R_q)^2 - (z - z_q)^2),
 * or in the nearest direction in which that is within the wall. Where there is none, or it touches
 * a third one, it lies there. */
#include "carom_shot.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "shot/shot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Where a ball lies. */
typedef struct lying {
  int64_t pocket;
  double r[3], radius;
} lying;

/* A fall: its ball, and those that lie in its pocket. */
typedef struct fall {
  const carom_pocket *pocket;
  const carom_ball_kind *kind;
  const carom_ball_state *entry;
  double wall, hit; /* W, and when the ball is there, s */
  double end;       /* when it lies, s */
  const lying *others[CAROM_BALLS_MOST];
  int count;
  /* that which it touches, when, s, and how far from the pocket's middle at most; in the frame of
   * the one that lies, whose x points to the middle, the direction of the touch */
  const lying *touched;
  double touch, most, inward, aside;
} fall;

static double height_of(const fall *f, double t) {
  return f->entry->r[2] + t * (f->entry->v[2] - 0.5 * f->kind->gravity * t);
}

/* The wall, and when the ball comes to it. */
static void find_wall(fall *f) {
  /* the middle of the way is nearest to the pocket's; W */
  const double x = f->entry->r[0] - f->pocket->centre[0], y = f->entry->r[1] - f->pocket->centre[1],
               vx = f->entry->v[0], vy = f->entry->v[1];
  const double speed2 = vx * vx + vy * vy, inward = -(x * vx + y * vy);
  double middle = 0.0;
  if (speed2 > 0.0)
    middle = inward / speed2;
  const double nearest2 = carom_greater(x * x + y * y - middle * inward, 0.0);
  f->wall = carom_greater(f->pocket->radius - f->kind->radius, sqrt(nearest2));
  f->hit = INFINITY;
  if (speed2 > 0.0)
    f->hit = middle + sqrt(carom_greater(f->wall * f->wall - nearest2, 0.0) / speed2);
  if (f->hit < 0.0) {
    f->hit = 0.0;
    f->wall = sqrt(x * x + y * y);
  }
}

/* The way of a ball in an empty pocket: place from the pocket's middle, and velocity. */
static void fall_alone(const fall *f, double t, double p[2], double v[2]) {
  /* straight to the wall */
  const double straight = carom_lesser(t, f->hit);
  for (int k = 0; k < 2; k++) {
    v[k] = f->entry->v[k];
    p[k] = f->entry->r[k] - f->pocket->centre[k] + straight * v[k];
  }
  if (!(t > f->hit && f->wall > 0.0))
    return;

  /* and around on it */
  const double along = (p[0] * v[1] - p[1] * v[0]) / f->wall;
  double s, c;
  carom_sincos(along * (t - f->hit) / f->wall, &s, &c);
  const double x = p[0] * c - p[1] * s, y = p[0] * s + p[1] * c;
  p[0] = x;
  p[1] = y;
  v[0] = -along * y / f->wall;
  v[1] = along * x / f->wall;
}

/* Level distance that a ball at height z has to keep from one that lies. */
static double distance_from(const fall *f, const lying *neighbor, double z) {
  const double sum = f->kind->radius + neighbor->radius, up = z - neighbor->r[2];
  return sqrt(carom_greater(sum * sum - up * up, 0.0));
}

/* That one of those that lie, other than the touched one, in which a ball would be at a place. */
static const lying *in_its_way(const fall *f, double t, const double p[2]) {
  const double z = height_of(f, t);
  for (int k = 0; k < f->count; k++) {
    const lying *neighbor = f->others[k];
    const double x = f->pocket->centre[0] + p[0] - neighbor->r[0],
                 y = f->pocket->centre[1] + p[1] - neighbor->r[1];
    if (neighbor != f->touched &&
        x * x + y * y < distance_from(f, neighbor, z) * distance_from(f, neighbor, z))
      return neighbor;
  }
  return NULL;
}

/* From one that lies, the direction of the pocket's middle, and its distance. */
static double to_middle(const fall *f, const lying *neighbor, double e[2]) {
  const double x = f->pocket->centre[0] - neighbor->r[0], y = f->pocket->centre[1] - neighbor->r[1],
               far = sqrt(x * x + y * y);
  e[0] = 1.0;
  e[1] = 0.0;
  if (far > 0.0) {
    e[0] = x / far;
    e[1] = y / far;
  }
  return far;
}

/* The place from the pocket's middle around the one that was touched. Returns whether there is
 * one within the wall. */
static bool around(const fall *f, double t, double p[2]) {
  double e[2];
  const double far = to_middle(f, f->touched, e), D = distance_from(f, f->touched, height_of(f, t));
  /* |q + D way| <= most */
  double least = far + D <= f->most ? -1.0 : 2.0;
  if (far * D > 0.0)
    least = (far * far + D * D - f->most * f->most) / (2.0 * far * D);
  const double inward = carom_greater(f->inward, least),
               across = copysign(sqrt(carom_greater(1.0 - inward * inward, 0.0)), f->aside);
  p[0] = -far * e[0] + D * (inward * e[0] - across * e[1]);
  p[1] = -far * e[1] + D * (inward * e[1] + across * e[0]);
  return least <= 1.0;
}

/* The place from the pocket's middle, and the velocity of a ball that touches none. Returns whether
 * it is free. */
static bool place_at(const fall *f, double t, double p[2], double v[2]) {
  fall_alone(f, t, p, v);
  const bool within = f->touched == NULL || t < f->touch || around(f, t, p);
  return within && in_its_way(f, t, p) == NULL;
}

/* The last time up to the end at which the place is still free, from a time on. */
static double last_free(const fall *f, double start) {
  static const int parts = 200;
  enum { BISECTIONS = 40 };
  double p[2], v[2];
  for (int k = 0; k <= parts && f->count > 0; k++) {
    double low = start + (f->end - start) * (k - 1) / parts,
           high = start + (f->end - start) * k / parts;
    if (place_at(f, high, p, v))
      continue;
    for (int n = 0; n < BISECTIONS && k > 0; n++) {
      const double middle = 0.5 * (low + high);
      if (place_at(f, middle, p, v))
        low = middle;
      else
        high = middle;
    }
    if (k == 0)
      return start;
    return high;
  }
  return f->end;
}

/* The first touch, and when the ball lies: at the depth, or on others. */
static void find_end(fall *f) {
  const double g = f->kind->gravity, rise = f->entry->v[2],
               down = carom_greater(f->entry->r[2] + f->pocket->depth, 0.0);
  double p[2], v[2], e[2];
  f->end = (rise + sqrt(rise * rise + 2.0 * g * down)) / g;
  f->touched = NULL;
  f->touch = last_free(f, 0.0);
  fall_alone(f, f->touch, p, v);
  const lying *neighbor = in_its_way(f, f->touch, p);
  if (neighbor == NULL)
    return;

  /* the direction, inward where the ball is right above the other one */
  const double far = to_middle(f, neighbor, e), x = p[0] + far * e[0], y = p[1] + far * e[1],
               apart = sqrt(x * x + y * y);
  f->inward = 1.0;
  if (apart > 0.0)
    f->inward = (x * e[0] + y * e[1]) / apart;
  f->aside = y * e[0] - x * e[1];
  f->most = carom_greater(f->wall, carom_plane_size(p));
  f->touched = neighbor;
  f->end = last_free(f, f->touch);
}

/* A fall among those that lie already, all pockets' `known`. */
static void begin(fall *f, const lying *others, int known, int64_t pocket) {
  f->count = 0;
  for (int k = 0; k < known; k++)
    if (others[k].pocket == pocket)
      f->others[f->count++] = &others[k];
  find_wall(f);
  find_end(f);
}

/* The state at a time since its begin. */
static void state_at(const fall *f, double t, carom_ball_state *state) {
  static const double soon = 1e-7; /* s */
  double p[2], v[2], previous[2], none[2];
  const bool lies = t >= f->end;
  t = carom_lesser(t, f->end);
  place_at(f, t, p, v);
  /* around another one the velocity is that of the way */
  if (!lies && f->touched != NULL && t > f->touch) {
    place_at(f, carom_greater(t - soon, 0.0), previous, none);
    for (int k = 0; k < 2; k++)
      v[k] = (p[k] - previous[k]) / soon;
  }
  for (int k = 0; k < 2; k++) {
    state->r[k] = f->pocket->centre[k] + p[k];
    state->v[k] = v[k];
  }
  state->r[2] = height_of(f, t);
  state->v[2] = f->entry->v[2] - f->kind->gravity * t;
  if (lies)
    memset(state->v, 0, sizeof state->v);
}

carom_status carom_shot_falls(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_shot *shot, const double *times, size_t n,
                              carom_ball_state *states) {
  if (table == NULL || (n > 0 && (times == NULL || states == NULL)))
    return CAROM_ERROR_NULL;
  const carom_status status = carom_shot_at_times(balls, count, shot, NULL, 0, NULL);
  if (status < 0)
    return status;
  for (size_t k = 0; k < n; k++)
    if (!(times[k] >= 0.0))
      return CAROM_ERROR_TIME;

  /* balls that fall, in the order in which they do; those that lie in the pockets already */
  const int64_t known = carom_events_kept(shot);
  lying others[CAROM_BALLS_MOST];
  int down = 0;
  for (int64_t e = 0; e < known; e++) {
    const carom_event *event = &shot->events[e];
    if (event->type != CAROM_EVENT_POCKET || event->a < 0 || event->a >= count || event->b < 0 ||
        event->b >= table->pockets || !(balls[event->a].kind.gravity > 0.0))
      continue;

    /* its fall, seen at all times that are later */
    fall f = {.pocket = &table->pocket[event->b],
              .kind = &balls[event->a].kind,
              .entry = &event->before[0]};
    begin(&f, others, down, event->b);
    for (size_t k = 0; k < n; k++)
      if (times[k] >= event->time)
        state_at(&f, times[k] - event->time, &states[k * (size_t)count + (size_t)event->a]);

    /* where it lies at last, for those that fall on it */
    if (down == CAROM_BALLS_MOST) /* events that no shot has */
      continue;
    carom_ball_state last = event->before[0];
    state_at(&f, f.end, &last);
    others[down].pocket = event->b;
    others[down].radius = f.kind->radius;
    memcpy(others[down++].r, last.r, sizeof last.r);
  }
  return status;
}

carom_status carom_shot_drawn(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_shot *shot, const double *times, size_t n,
                              carom_ball_state *states) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_shot_at_times(balls, count, shot, times, n, states);
  if (status < 0)
    return status;
  return carom_shot_falls(table, balls, count, shot, times, n, states);
}
