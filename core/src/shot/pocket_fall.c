/* States for drawing: pocketed balls that fall.
 *
 * For the shot a ball that reaches a pocket's circle is down. For drawing it falls freely from
 * there, until it is at the pocket's depth, where it stays. Let p be its position from the pocket's
 * middle, and v its horizontal velocity, where it reaches the circle. It goes straight,
 *     p(t) = p + v t,
 * to the wall, which is the circle of radius W on which its centre can be; then with the component
 * of v along the wall, u, around on it by the angle u t / W. W is the pocket's radius minus the
 * ball's; if its path passes the middle at a greater distance, W is that distance, and if it flies
 * across the circle and is leaving, W is its present distance.
 *
 *         .-'''''-.   pocket       v   p: from the middle to where the ball comes in
 *       .' .-'''-. '.          .-'     W: the wall, on which its centre goes around
 *      /  '   W   ' <----- . -'
 *      |  |   o---+--|   p             from above
 *      \  '.     .'  /
 *       '.  '---'  .'
 *         '-.....-'
 *
 * A ball that comes down on one that lies, at q, continues around it in the direction in which it
 * touched it, at the level distance
 *     D = sqrt((R + R_q)^2 - (z - z_q)^2),
 * or in the nearest direction in which that is within the wall. Where there is none, or it touches
 * a third one, it is there. */
#include "carom_shot.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "shot/shot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Where a ball rests. */
typedef struct lying {
  int64_t pocket;
  double r[3], radius;
} lying;

/* A fall: its ball, and those that lie in its pocket. */
typedef struct pocket_fall {
  const carom_pocket *pocket;
  const carom_ball_kind *kind;
  const carom_ball_state *entry;
  double wall, hit; /* W, and when the ball is there, s */
  double end;       /* when it comes to rest, s */
  const lying *others[CAROM_BALLS_MOST];
  int count;
  /* that which it touches, when, s, and how far from the pocket's middle at most; in the frame of
   * the one that lies, whose x points to the middle, the direction of the touch */
  const lying *touched;
  double touch, most, inward, aside;
} pocket_fall;

/* z at a time since it reached the circle. */
static double height_of(const pocket_fall *fall, double time) {
  return fall->entry->r[2] + time * (fall->entry->v[2] - 0.5 * fall->kind->gravity * time);
}

/* The wall, and when the ball reaches it. */
static void find_wall(pocket_fall *fall) {
  /* the middle of the way is nearest to the pocket's; W */
  const double x = fall->entry->r[0] - fall->pocket->centre[0],
               y = fall->entry->r[1] - fall->pocket->centre[1], vx = fall->entry->v[0],
               vy = fall->entry->v[1];

  const double speed2 = vx * vx + vy * vy, inward = -(x * vx + y * vy);
  double middle = 0.0;
  if (speed2 > 0.0)
    middle = inward / speed2;
  const double nearest2 = carom_greater(x * x + y * y - middle * inward, 0.0);
  fall->wall = carom_greater(fall->pocket->radius - fall->kind->radius, sqrt(nearest2));

  /* when it is there; a ball on its way out goes around where it is */
  fall->hit = INFINITY;
  if (speed2 > 0.0)
    fall->hit = middle + sqrt(carom_greater(fall->wall * fall->wall - nearest2, 0.0) / speed2);
  if (fall->hit < 0.0) {
    fall->hit = 0.0;
    fall->wall = sqrt(x * x + y * y);
  }
}

/* The path of a ball in an empty pocket: position from the pocket's middle, and velocity. */
static void fall_alone(const pocket_fall *fall, double time, double place[2], double velocity[2]) {
  /* straight to the wall */
  const double straight = carom_lesser(time, fall->hit);
  for (int axis = 0; axis < 2; axis++) {
    velocity[axis] = fall->entry->v[axis];
    place[axis] = fall->entry->r[axis] - fall->pocket->centre[axis] + straight * velocity[axis];
  }
  if (!(time > fall->hit && fall->wall > 0.0))
    return;

  /* and around on it */
  const double along = (place[0] * velocity[1] - place[1] * velocity[0]) / fall->wall;
  double sine, cosine;
  carom_sincos(along * (time - fall->hit) / fall->wall, &sine, &cosine);
  const double x = place[0] * cosine - place[1] * sine, y = place[0] * sine + place[1] * cosine;
  place[0] = x;
  place[1] = y;
  velocity[0] = -along * y / fall->wall;
  velocity[1] = along * x / fall->wall;
}

/* Horizontal distance that a ball at a height has to keep from a resting one. */
static double distance_from(const pocket_fall *fall, const lying *neighbor, double height) {
  const double sum = fall->kind->radius + neighbor->radius, up = height - neighbor->r[2];
  return sqrt(carom_greater(sum * sum - up * up, 0.0));
}

/* That one of those that lie, other than the touched one, in which a ball would be at a
 * position. */
static const lying *in_its_way(const pocket_fall *fall, double time, const double place[2]) {
  const double height = height_of(fall, time);
  for (int index = 0; index < fall->count; index++) {
    const lying *neighbor = fall->others[index];
    const double x = fall->pocket->centre[0] + place[0] - neighbor->r[0],
                 y = fall->pocket->centre[1] + place[1] - neighbor->r[1];
    if (neighbor != fall->touched && x * x + y * y < distance_from(fall, neighbor, height) *
                                                         distance_from(fall, neighbor, height))
      return neighbor;
  }
  return NULL;
}

/* From a resting ball, the direction of the pocket's middle, and its distance. */
static double to_middle(const pocket_fall *fall, const lying *neighbor, double toward[2]) {
  const double x = fall->pocket->centre[0] - neighbor->r[0],
               y = fall->pocket->centre[1] - neighbor->r[1], far = sqrt(x * x + y * y);
  toward[0] = 1.0;
  toward[1] = 0.0;
  if (far > 0.0) {
    toward[0] = x / far;
    toward[1] = y / far;
  }
  return far;
}

/* The position from the pocket's middle around the one that was touched. Returns whether there is
 * one within the wall. */
static bool around(const pocket_fall *fall, double time, double place[2]) {
  double toward[2];
  const double far = to_middle(fall, fall->touched, toward),
               D = distance_from(fall, fall->touched, height_of(fall, time));

  /* |q + D way| <= most: how far inward the direction of way is at least, by its cosine */
  double least = far + D <= fall->most ? -1.0 : 2.0;
  if (far * D > 0.0)
    least = (far * far + D * D - fall->most * fall->most) / (2.0 * far * D);

  /* the direction of the touch, or the nearest that is within the wall */
  const double inward = carom_greater(fall->inward, least),
               across = copysign(sqrt(carom_greater(1.0 - inward * inward, 0.0)), fall->aside);
  place[0] = -far * toward[0] + D * (inward * toward[0] - across * toward[1]);
  place[1] = -far * toward[1] + D * (inward * toward[1] + across * toward[0]);
  return least <= 1.0;
}

/* The position from the pocket's middle, and the velocity of a ball that touches none. Returns
 * whether it is free. */
static bool place_at(const pocket_fall *fall, double time, double place[2], double velocity[2]) {
  fall_alone(fall, time, place, velocity);
  const bool within = fall->touched == NULL || time < fall->touch || around(fall, time, place);
  return within && in_its_way(fall, time, place) == NULL;
}

/* The last time up to the end at which the position is still free, from a time on. */
static double last_free(const pocket_fall *fall, double start) {
  static const int parts = 200; /* of the time: drawings show no shorter passage */
  enum { BISECTIONS = 40 };     /* to rounding */
  double place[2], velocity[2];
  for (int part = 0; part <= parts && fall->count > 0; part++) {
    double low = start + (fall->end - start) * (part - 1) / parts,
           high = start + (fall->end - start) * part / parts;
    if (place_at(fall, high, place, velocity))
      continue;

    /* between the last part that is free and this one */
    for (int bisection = 0; bisection < BISECTIONS && part > 0; bisection++) {
      const double middle = 0.5 * (low + high);
      if (place_at(fall, middle, place, velocity))
        low = middle;
      else
        high = middle;
    }
    if (part == 0)
      return start;
    return high;
  }
  return fall->end;
}

/* The first touch, and when the ball rests: at the depth, or on others. */
static void find_end(pocket_fall *fall) {
  const double gravity = fall->kind->gravity, rise = fall->entry->v[2],
               down = carom_greater(fall->entry->r[2] + fall->pocket->depth, 0.0);
  double place[2], velocity[2], toward[2];
  fall->end = (rise + sqrt(rise * rise + 2.0 * gravity * down)) / gravity;
  fall->touched = NULL;
  fall->touch = last_free(fall, 0.0);
  fall_alone(fall, fall->touch, place, velocity);
  const lying *neighbor = in_its_way(fall, fall->touch, place);
  if (neighbor == NULL)
    return;

  /* the direction, inward where the ball is right above the other one */
  const double far = to_middle(fall, neighbor, toward), x = place[0] + far * toward[0],
               y = place[1] + far * toward[1], apart = sqrt(x * x + y * y);
  fall->inward = 1.0;
  if (apart > 0.0)
    fall->inward = (x * toward[0] + y * toward[1]) / apart;
  fall->aside = y * toward[0] - x * toward[1];
  fall->most = carom_greater(fall->wall, carom_plane_size(place));
  fall->touched = neighbor;
  fall->end = last_free(fall, fall->touch);
}

/* A fall among those that lie already, all pockets' `known`. */
static void begin(pocket_fall *fall, const lying *others, int known, int64_t pocket) {
  fall->count = 0;
  for (int index = 0; index < known; index++)
    if (others[index].pocket == pocket)
      fall->others[fall->count++] = &others[index];
  find_wall(fall);
  find_end(fall);
}

/* The state at a time since its begin. */
static void state_at(const pocket_fall *fall, double time, carom_ball_state *state) {
  static const double soon = 1e-7; /* s: of a difference, where rounding is 1e-9 m/s */
  double place[2], velocity[2], previous[2], none[2];
  const bool lies = time >= fall->end;
  time = carom_lesser(time, fall->end);
  place_at(fall, time, place, velocity);
  /* around another ball the velocity is the path's */
  if (!lies && fall->touched != NULL && time > fall->touch) {
    place_at(fall, carom_greater(time - soon, 0.0), previous, none);
    for (int axis = 0; axis < 2; axis++)
      velocity[axis] = (place[axis] - previous[axis]) / soon;
  }
  for (int axis = 0; axis < 2; axis++) {
    state->r[axis] = fall->pocket->centre[axis] + place[axis];
    state->v[axis] = velocity[axis];
  }
  state->r[2] = height_of(fall, time);
  state->v[2] = fall->entry->v[2] - fall->kind->gravity * time;
  if (lies)
    memset(state->v, 0, sizeof state->v);
}

carom_status carom_shot_falls(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_shot *shot, const double *times, size_t n,
                              carom_ball_state *states) {
  if (table == NULL || (n > 0 && (times == NULL || states == NULL)))
    return CAROM_ERROR_NULL;
  const carom_status status = carom_shot_frames(balls, count, shot, NULL, 0, NULL, NULL, NULL);
  if (status < 0)
    return status;
  for (size_t instant = 0; instant < n; instant++)
    if (!(times[instant] >= 0.0))
      return CAROM_ERROR_TIME;

  /* balls that fall, in the order in which they do; those that lie in the pockets already */
  const int64_t known = carom_events_kept(shot);
  lying others[CAROM_BALLS_MOST];
  int down = 0;
  for (int64_t index = 0; index < known; index++) {
    const carom_event *event = &shot->events[index];
    if (event->type != CAROM_EVENT_POCKET || event->a < 0 || event->a >= count || event->b < 0 ||
        event->b >= table->pockets || !(balls[event->a].kind.gravity > 0.0))
      continue;

    /* its fall, seen at all times that are later */
    pocket_fall fall = {.pocket = &table->pocket[event->b],
                        .kind = &balls[event->a].kind,
                        .entry = &event->before[0]};
    begin(&fall, others, down, event->b);
    for (size_t instant = 0; instant < n; instant++)
      if (times[instant] >= event->time)
        state_at(&fall, times[instant] - event->time,
                 &states[instant * (size_t)count + (size_t)event->a]);

    /* where it is at last, for those that fall on it */
    if (down == CAROM_BALLS_MOST) /* events that no shot has */
      continue;
    carom_ball_state last = event->before[0];
    state_at(&fall, fall.end, &last);
    others[down].pocket = event->b;
    others[down].radius = fall.kind->radius;
    memcpy(others[down++].r, last.r, sizeof last.r);
  }
  return status;
}

carom_status carom_shot_drawn(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_shot *shot, const double *times, size_t n,
                              carom_ball_state *states) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_shot_frames(balls, count, shot, times, n, NULL, states, NULL);
  if (status < 0)
    return status;
  return carom_shot_falls(table, balls, count, shot, times, n, states);
}
