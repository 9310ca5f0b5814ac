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
 * SEVERAL. All balls of a pocket fall together, in steps of 0.5 ms. Each falls as above until it
 * would be in another one; from then on a step is
 *     v_z -= g h,   r += h v,   and several times: out of each other, the wall and the floor.
 * Two balls move apart by half of their overlap each, or one by all of it if the other lies. A ball
 * that is still on the table, and falls within 0.1 s, comes at the velocity that it has at the
 * circle, and does not give way. Contacts take the speed at which two things close, so a ball's
 * energy does not rise but by another ball, and both together lose some. A ball lies where it is
 * slow for 20 ms, or after 0.7 s. */
#include "carom_shot.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "platform/vectors.h"
#include "shot/shot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double step_time = 5e-4;   /* s */
static const double longest_fall = 0.7; /* s */
static const double foresight = 0.1;    /* s: how long before its fall a ball on the table counts */
static const double slow = 0.02;        /* m/s: a ball lies that is slower for STILL steps */
static const double drag_of_touch = 5.0;  /* 1/s: what rubs a ball that touches something */
static const double inward_speed = 1.0;   /* m/s: at which the wall pushes a ball that comes in */
static const double least_overlap = 1e-9; /* m */
enum { ROUNDS = 12, LAST_ROUNDS = 400, STILL = 40 };

typedef enum fall_phase { ON_TABLE, ALONE, TOUCHING, LYING } fall_phase;

/* A fall. */
typedef struct pocket_fall {
  const carom_pocket *pocket;
  const carom_ball_kind *kind;
  const carom_ball_state *entry;
  int64_t ball;
  double start;     /* s: when it begins */
  double wall, hit; /* W, and when the ball is there, s from its begin */
  double end;       /* when it would be at the depth, s from its begin */
  fall_phase phase;
  bool is_alone;             /* it has met no other */
  bool counts;               /* it falls, lies, or comes soon */
  bool touches;              /* something, in this step */
  int still;                 /* steps since it was slow */
  double r[3], v[3];         /* at the end of a step, */
  double old_r[3], old_v[3]; /* and at its begin */
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

/* Where a ball is that meets no other, at a time: on the table, in its fall, or at the depth. */
static void go_alone(pocket_fall *fall, double time) {
  const double since = time - fall->start;
  if (since < 0.0) {
    for (int axis = 0; axis < 3; axis++) {
      fall->v[axis] = axis < 2 ? fall->entry->v[axis] : 0.0;
      fall->r[axis] = fall->entry->r[axis] + since * fall->v[axis];
    }
    return;
  }
  const double tau = carom_lesser(since, fall->end);
  double place[2], velocity[2];
  fall_alone(fall, tau, place, velocity);
  for (int axis = 0; axis < 2; axis++) {
    fall->r[axis] = fall->pocket->centre[axis] + place[axis];
    fall->v[axis] = velocity[axis];
  }
  fall->r[2] = height_of(fall, tau);
  fall->v[2] = fall->entry->v[2] - fall->kind->gravity * tau;
  if (since >= fall->end)
    memset(fall->v, 0, sizeof fall->v);
}

/* How deep two balls of a pocket are in each other, and the direction from the second one. */
static double overlap_of(const pocket_fall *fall, const pocket_fall *neighbor, double normal[3]) {
  double square = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    normal[axis] = fall->r[axis] - neighbor->r[axis];
    square += normal[axis] * normal[axis];
  }
  const double distance = sqrt(square);
  for (int axis = 0; axis < 3; axis++)
    normal[axis] = distance > 0.0 ? normal[axis] / distance : (double)(axis == 2);
  return fall->kind->radius + neighbor->kind->radius - distance;
}

/* Whether two balls may meet in a pocket. */
static bool may_meet(const pocket_fall *fall, const pocket_fall *neighbor) {
  return fall != neighbor && fall->pocket == neighbor->pocket && fall->counts && neighbor->counts;
}

static bool gives_way(const pocket_fall *fall) {
  return fall->phase == TOUCHING;
}

/* Moves two balls out of each other, and takes the speed at which they close. */
static void part(pocket_fall *fall, pocket_fall *neighbor) {
  double normal[3];
  const double overlap = overlap_of(fall, neighbor, normal);
  if (!(overlap > least_overlap) || (!gives_way(fall) && !gives_way(neighbor)))
    return;
  double share = 0.5;
  if (!gives_way(neighbor))
    share = 1.0;
  else if (!gives_way(fall))
    share = 0.0;
  double closing = 0.0;
  for (int axis = 0; axis < 3; axis++)
    closing -= (fall->v[axis] - neighbor->v[axis]) * normal[axis];
  closing = carom_greater(closing, 0.0);
  for (int axis = 0; axis < 3; axis++) {
    fall->r[axis] += share * overlap * normal[axis];
    neighbor->r[axis] -= (1.0 - share) * overlap * normal[axis];
    fall->v[axis] += share * closing * normal[axis];
    neighbor->v[axis] -= (1.0 - share) * closing * normal[axis];
  }
  fall->touches = neighbor->touches = true;
}

/* Moves a ball to within the wall and above the floor. Its centre is outside of the wall as it
 * comes in: it gets inside at a small speed. */
static void stay_within(pocket_fall *fall) {
  const double *centre = fall->pocket->centre;
  const double x = fall->r[0] - centre[0], y = fall->r[1] - centre[1], far = sqrt(x * x + y * y);
  const double old_x = fall->old_r[0] - centre[0], old_y = fall->old_r[1] - centre[1],
               most = carom_greater(fall->wall,
                                    sqrt(old_x * old_x + old_y * old_y) - inward_speed * step_time);
  if (far > most) {
    const double out[2] = {x / far, y / far},
                 speed = carom_greater(fall->v[0] * out[0] + fall->v[1] * out[1], 0.0);
    for (int axis = 0; axis < 2; axis++) {
      fall->r[axis] = centre[axis] + most * out[axis];
      fall->v[axis] -= speed * out[axis];
    }
  }
  if (fall->r[2] < -fall->pocket->depth) {
    fall->r[2] = -fall->pocket->depth;
    fall->v[2] = carom_greater(fall->v[2], 0.0);
    fall->touches = true;
  }
}

/* Several times: all balls out of each other, the wall and the floor. */
static void separate(pocket_fall *falls, int count, int rounds) {
  for (int round = 0; round < rounds; round++)
    for (int index = 0; index < count; index++) {
      for (int earlier = 0; earlier < index; earlier++)
        if (may_meet(&falls[index], &falls[earlier]))
          part(&falls[index], &falls[earlier]);
      if (gives_way(&falls[index]))
        stay_within(&falls[index]);
    }
}

/* Balls that would be in another one fall with it from here on. Returns whether there is any. */
static bool find_touching(pocket_fall *falls, int count) {
  bool found = false;
  double normal[3];
  for (int index = 0; index < count; index++)
    for (int neighbor = 0; neighbor < count; neighbor++) {
      pocket_fall *fall = &falls[index];
      if (fall->phase != ALONE || !may_meet(fall, &falls[neighbor]) ||
          !(overlap_of(fall, &falls[neighbor], normal) > least_overlap))
        continue;
      /* from where it was as the step began */
      fall->phase = TOUCHING;
      fall->is_alone = false;
      memcpy(fall->r, fall->old_r, sizeof fall->r);
      memcpy(fall->v, fall->old_v, sizeof fall->v);
      found = true;
    }
  return found;
}

/* The free part of a step of a ball that touches others. */
static void move(pocket_fall *fall, double time) {
  fall->touches = false;
  fall->v[2] -= fall->kind->gravity * time;
  for (int axis = 0; axis < 3; axis++)
    fall->r[axis] += time * fall->v[axis];
}

static double speed_of(const pocket_fall *fall) {
  return carom_space_size(fall->v);
}

/* Which balls lie from here on. */
static void find_lying(pocket_fall *falls, int count, double time) {
  for (int index = 0; index < count; index++) {
    pocket_fall *fall = &falls[index];
    const double since = time - fall->start;
    const bool alone = fall->phase == ALONE && since >= fall->end;
    fall->still = fall->touches && speed_of(fall) < slow ? fall->still + 1 : 0;
    const bool rests = fall->phase == TOUCHING && fall->still >= STILL;
    const bool late = fall->phase == TOUCHING && since >= longest_fall;
    if (!alone && !rests && !late)
      continue;
    if (!alone)
      separate(falls, count, LAST_ROUNDS);
    fall->phase = LYING;
    memset(fall->v, 0, sizeof fall->v);
  }
}

/* All balls go on from a time to the next. */
static void step(pocket_fall *falls, int count, double time, double next) {
  for (int index = 0; index < count; index++) {
    pocket_fall *fall = &falls[index];
    memcpy(fall->old_r, fall->r, sizeof fall->r);
    memcpy(fall->old_v, fall->v, sizeof fall->v);
    if (fall->phase == ON_TABLE && next >= fall->start) {
      fall->phase = ALONE;
      memcpy(fall->old_r, fall->entry->r, sizeof fall->r);
      memcpy(fall->old_v, fall->entry->v, sizeof fall->v);
    }
    fall->counts = fall->phase != ON_TABLE || next > fall->start - foresight;
    if (fall->phase == ALONE || fall->phase == ON_TABLE)
      go_alone(fall, next);
    else if (fall->phase == TOUCHING)
      move(fall, next - time);
  }

  /* those that have just touched begin their step again */
  bool touching[CAROM_BALLS_MOST];
  for (int index = 0; index < count; index++)
    touching[index] = falls[index].phase == TOUCHING;
  while (find_touching(falls, count))
    for (int index = 0; index < count; index++)
      if (falls[index].phase == TOUCHING && !touching[index]) {
        touching[index] = true;
        move(&falls[index], next - carom_greater(time, falls[index].start));
      }
  separate(falls, count, ROUNDS);
  for (int index = 0; index < count; index++)
    for (int axis = 0; axis < 3 && falls[index].phase == TOUCHING && falls[index].touches; axis++)
      falls[index].v[axis] *= 1.0 - drag_of_touch * (next - time);
  find_lying(falls, count, next);
}

/* The state of a fall at a time within a step. */
static void tell(const pocket_fall *fall, double time, double begin, double end,
                 carom_ball_state *state) {
  if (fall->is_alone) {
    pocket_fall exact = *fall;
    go_alone(&exact, time);
    memcpy(state->r, exact.r, sizeof state->r);
    memcpy(state->v, exact.v, sizeof state->v);
    return;
  }
  begin = carom_greater(begin, fall->start);
  const double share = (time - begin) / (end - begin);
  for (int axis = 0; axis < 3; axis++) {
    state->r[axis] = fall->old_r[axis] + share * (fall->r[axis] - fall->old_r[axis]);
    state->v[axis] = fall->old_v[axis] + share * (fall->v[axis] - fall->old_v[axis]);
  }
}

/* The times of a caller, and where their states go. */
typedef struct drawing_request {
  const double *times;
  size_t n, count;
  carom_ball_state *states;
} drawing_request;

/* Writes the states of all falls that have begun, at the requested times from `begin` to before
 * `end`. */
static void tell_all(const drawing_request *request, const pocket_fall *falls, int count,
                     double begin, double end) {
  for (size_t instant = 0; instant < request->n; instant++) {
    const double time = request->times[instant];
    if (time < begin || time >= end)
      continue;
    for (int index = 0; index < count; index++)
      if (time >= falls[index].start)
        tell(&falls[index], time, begin, end,
             &request->states[instant * request->count + (size_t)falls[index].ball]);
  }
}

/* Whether anything falls; and when the next fall begins, infinite: never. */
static bool falls_now(const pocket_fall *falls, int count, double *next) {
  bool moving = false;
  *next = INFINITY;
  for (int index = 0; index < count; index++) {
    moving |= falls[index].phase == ALONE || falls[index].phase == TOUCHING;
    if (falls[index].phase == ON_TABLE)
      *next = carom_lesser(*next, falls[index].start);
  }
  return moving;
}

/* The falls of a shot, in the order in which they begin. Returns how many. */
static int list_falls(const carom_table *table, const carom_shot_ball *balls, int count,
                      const carom_shot *shot, pocket_fall falls[CAROM_BALLS_MOST]) {
  const int64_t known = carom_events_kept(shot);
  int found = 0;
  for (int64_t index = 0; index < known && found < CAROM_BALLS_MOST; index++) {
    const carom_event *event = &shot->events[index];
    if (event->type != CAROM_EVENT_POCKET || event->a < 0 || event->a >= count || event->b < 0 ||
        event->b >= table->pockets || !(balls[event->a].kind.gravity > 0.0))
      continue;
    pocket_fall *fall = &falls[found++];
    memset(fall, 0, sizeof *fall);
    fall->pocket = &table->pocket[event->b];
    fall->kind = &balls[event->a].kind;
    fall->entry = &event->before[0];
    fall->ball = event->a;
    fall->start = event->time;
    fall->phase = ON_TABLE;
    fall->is_alone = true;
    find_wall(fall);
    const double gravity = fall->kind->gravity, rise = fall->entry->v[2],
                 down = carom_greater(fall->entry->r[2] + fall->pocket->depth, 0.0);
    fall->end = (rise + sqrt(rise * rise + 2.0 * gravity * down)) / gravity;
  }
  return found;
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

  /* from the first fall on; where nothing falls, to the next one at once */
  const drawing_request request = {times, n, (size_t)count, states};
  pocket_fall falls[CAROM_BALLS_MOST];
  const int found = list_falls(table, balls, count, shot, falls);
  double time, next;
  falls_now(falls, found, &time);
  while (time < INFINITY) {
    next = time + step_time;
    step(falls, found, time, next);
    tell_all(&request, falls, found, time, next);
    time = next;
    if (falls_now(falls, found, &next))
      continue;
    for (int index = 0; index < found; index++) {
      memcpy(falls[index].old_r, falls[index].r, sizeof falls[index].r);
      memcpy(falls[index].old_v, falls[index].v, sizeof falls[index].v);
    }
    tell_all(&request, falls, found, time, next);
    time = next;
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
