/* A shot at times after it was played: each ball's path since its last event until then, and how it
 * has turned. */
#include "motion/orientation.h"
#include "platform/fingerprint.h"
#include "shot/sim.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* The steps of a call that turns balls: about a second. All balls of a break turn by some 1,000
 * parts. */
static const double most_steps = 1e7;

/* A ball on its way. */
typedef struct replayed {
  carom_ball_rates rates;
  carom_path path; /* after its last event */
  carom_turning turning;
  int64_t begun; /* 0 where the path has no more than its start and the state there */
} replayed;

/* A shot at a time. Where `turns`, balls turn; then each path is begun as its event comes. */
typedef struct replay {
  uint64_t of;         /* fingerprint of the balls */
  uint64_t last_of;    /* and of the last event until then */
  int64_t count;       /* of balls; 0 before the first time */
  int64_t next, turns; /* next: the first event that is later */
  double time;
  replayed ball[CAROM_BALLS_MOST];
} replay;
_Static_assert(sizeof(replay) <= sizeof(carom_frames), "a replay fits in the words of callers");

/* As the shot begins: nothing has turned. */
static void begin(replay *at, const carom_shot_ball *balls, int count, bool turns) {
  at->count = count;
  at->turns = turns;
  at->next = 0;
  at->time = 0.0;
  for (int i = 0; i < count; i++) {
    replayed *ball = &at->ball[i];
    ball->rates = carom_rates_of(&balls[i].kind);
    ball->path.from = balls[i].state;
    ball->path.start = 0.0;
    ball->begun = 0;
    carom_label_of_layout(&ball->path.from, ball->rates.radius);
    memcpy(ball->turning.q, (double[]){1.0, 0.0, 0.0, 0.0}, sizeof ball->turning.q);
  }
}

/* The path of a ball to a time, and its turn; false where that takes more steps than any shot. */
static bool go_along(const replay *at, replayed *ball, double time, double *left) {
  if (!ball->begun) {
    carom_path_begin(&ball->path, &ball->rates, ball->path.start);
    if (at->turns)
      carom_turning_begin(&ball->turning, &ball->path, &ball->rates);
  }
  ball->begun = 1;
  return (!at->turns ||
          carom_turning_go_to(&ball->turning, &ball->path, &ball->rates, time, left)) &&
         carom_path_go_to(&ball->path, &ball->rates, time);
}

/* Goes forward to a time: the last event of each ball until then. */
static bool go_to(replay *at, const carom_shot *shot, int64_t known, double time, double *left) {
  const carom_event *events = shot->events;
  for (; at->next < known && events[at->next].time <= time; at->next++) {
    const carom_event *event = &events[at->next];
    const int moved[2] = {event->a, event->type == CAROM_EVENT_BALL_BALL ? event->b : -1};
    for (int side = 0; side < 2; side++) {
      if (moved[side] < 0 || moved[side] >= at->count)
        continue;
      replayed *ball = &at->ball[moved[side]];
      if (at->turns) {
        if (!go_along(at, ball, event->time, left))
          return false;
        carom_turning_at(&ball->turning, event->time, ball->turning.q);
      }
      ball->path.from = event->after[side];
      ball->path.start = event->time;
      ball->begun = 0;
    }
  }
  at->time = time;
  return true;
}

/* The states at a time to which the replay has gone, and the turns; false where they are not to be
 * found. */
static bool find_states(replay *at, double *left, carom_ball_state *states, double (*turned)[4]) {
  for (int i = 0; i < at->count; i++) {
    replayed *ball = &at->ball[i];
    if (!go_along(at, ball, at->time, left))
      return false;
    carom_path_at(&ball->path, &ball->rates, at->time, &states[i]);
    double size = 0.0;
    for (int k = 0; k < 3; k++)
      size += fabs(states[i].r[k]) + fabs(states[i].v[k]) + fabs(states[i].w[k]);
    if (!(size < INFINITY))
      return false;
    if (turned != NULL)
      carom_turning_at(&ball->turning, at->time, turned[i]);
  }
  return true;
}

/* The frames of a shot, onward from those before where `at` is of the same shot; turned may be
 * NULL. */
static carom_status replay_times(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                 const double *times, size_t n, replay *at,
                                 carom_ball_state *states, double (*turned)[4]) {
  if (balls == NULL || shot == NULL || (n > 0 && (times == NULL || states == NULL)))
    return CAROM_ERROR_NULL;
  const carom_status bad = carom_check_room(shot);
  if (bad != CAROM_OK)
    return bad;
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  const int64_t room = shot->events != NULL ? shot->room : 0; /* brief events have no states */
  const int64_t known = shot->count < room ? shot->count : room;
  double left = most_steps;
  for (size_t k = 0; k < n; k++) {
    if (!(times[k] >= 0.0))
      return CAROM_ERROR_TIME;
    const double time = carom_lesser(times[k], shot->time);
    if (shot->count > room && (room == 0 || time > shot->events[room - 1].time))
      return CAROM_ERROR_EVENTS_LOST;
    /* an earlier time than the last begins anew */
    if (at->count == 0 || time < at->time)
      begin(at, balls, count, turned != NULL);
    bool found = go_to(at, shot, known, time, &left);
    /* the motion after the end of the shot is unknown */
    for (int i = 0; i < count && times[k] > shot->time; i++)
      if (at->ball[i].path.from.label != CAROM_BALL_STATIONARY &&
          !carom_is_out(at->ball[i].path.from.label))
        return CAROM_ERROR_TIME;
    const size_t first = k * (size_t)count;
    found = found && find_states(at, &left, &states[first], turned ? &turned[first] : NULL);
    if (!found) {
      at->count = 0;
      return CAROM_ERROR_UNRESOLVED;
    }
  }
  return CAROM_OK;
}

carom_status carom_shot_at_times(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                 const double *times, size_t n, carom_ball_state *states) {
  replay at;
  at.count = 0;
  return replay_times(balls, count, shot, times, n, &at, states, NULL);
}

carom_status carom_shot_at(const carom_shot_ball *balls, int count, const carom_shot *shot,
                           double time, carom_ball_state *states) {
  return carom_shot_at_times(balls, count, shot, &time, 1, states);
}

/* Of the last event that a replay has passed, 0 before the first. */
static uint64_t last_of(const carom_shot *shot, int64_t next) {
  return next > 0 ? carom_fingerprint(0, &shot->events[next - 1], sizeof *shot->events) : 0;
}

carom_status carom_shot_frames(const carom_shot_ball *balls, int count, const carom_shot *shot,
                               const double *times, size_t n, carom_frames *onward,
                               carom_ball_state *states, double (*turned)[4]) {
  if (n > 0 && turned == NULL)
    return CAROM_ERROR_NULL;
  replay at;
  at.count = 0;
  const bool sound = onward != NULL && balls != NULL && count > 0 && count <= CAROM_BALLS_MOST &&
                     shot != NULL && carom_check_room(shot) == CAROM_OK;
  const size_t size = offsetof(replay, ball) + (size_t)(sound ? count : 0) * sizeof *at.ball;
  uint64_t of = 0;
  if (sound) {
    /* frames of another shot begin anew */
    const int64_t room = shot->events != NULL ? shot->room : 0,
                  known = shot->count < room ? shot->count : room;
    of = carom_fingerprint(0, balls, (size_t)count * sizeof *balls);
    memcpy(&at, onward, size);
    if (at.count != count || at.of != of || at.next < 0 || at.next > known || at.turns != 1 ||
        at.last_of != last_of(shot, at.next))
      at.count = 0;
  }
  const carom_status status = replay_times(balls, count, shot, times, n, &at, states, turned);
  if (sound) {
    at.of = of;
    at.last_of = at.count > 0 ? last_of(shot, at.next) : 0;
    memcpy(onward, &at, at.count > 0 ? size : offsetof(replay, ball));
  }
  return status;
}

carom_status carom_shot_orientation(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                    double time, double (*turned)[4]) {
  carom_ball_state then[CAROM_BALLS_MOST];
  return carom_shot_frames(balls, count, shot, &time, 1, NULL, then, turned);
}
