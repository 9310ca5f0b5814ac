/* A shot at a time after it was played: each ball's path since its last event until then. */
#include "shot/sim.h"

#include <math.h>
#include <stddef.h>

/* A shot at a time: the path of each ball after its last event until then. */
typedef struct replay {
  const carom_shot_ball *balls;
  const carom_shot *shot;
  int count;
  int64_t known, next; /* events that were kept, and the first of them that is later */
  carom_path path[CAROM_BALLS_MOST];
  bool begun[CAROM_BALLS_MOST]; /* whether path[i] has more than its start and the state there */
} replay;

static void replay_begin(replay *at) {
  at->next = 0;
  for (int i = 0; i < at->count; i++) {
    at->path[i].from = at->balls[i].state;
    at->path[i].start = 0.0;
    at->begun[i] = false;
    carom_label_of_layout(&at->path[i].from, at->balls[i].kind.radius);
  }
}

/* Goes forward to a time: the last event of each ball until then. */
static void replay_go(replay *at, double time) {
  const carom_event *events = at->shot->events;
  for (; at->next < at->known && events[at->next].time <= time; at->next++) {
    const carom_event *event = &events[at->next];
    const int ball[2] = {event->a, event->type == CAROM_EVENT_BALL_BALL ? event->b : -1};
    for (int side = 0; side < 2; side++)
      if (ball[side] >= 0 && ball[side] < at->count) {
        at->path[ball[side]].from = event->after[side];
        at->path[ball[side]].start = event->time;
        at->begun[ball[side]] = false;
      }
  }
}

/* The states at a time to which the replay has gone; false where they are not to be found. */
static bool replay_states(replay *at, double time, carom_ball_state *states) {
  for (int i = 0; i < at->count; i++) {
    carom_path *path = &at->path[i];
    const carom_ball_rates rates = carom_rates_of(&at->balls[i].kind);
    if (!at->begun[i])
      carom_path_begin(path, &rates, path->start);
    at->begun[i] = true;
    if (!carom_path_go_to(path, &rates, time))
      return false;
    carom_path_at(path, &rates, time, &states[i]);
    double size = 0.0;
    for (int k = 0; k < 3; k++)
      size += fabs(states[i].r[k]) + fabs(states[i].v[k]) + fabs(states[i].w[k]);
    if (!(size < INFINITY))
      return false;
  }
  return true;
}

carom_status carom_shot_at_times(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                 const double *times, size_t n, carom_ball_state *states) {
  if (balls == NULL || shot == NULL || (n > 0 && (times == NULL || states == NULL)))
    return CAROM_ERROR_NULL;
  const carom_status bad = carom_check_room(shot);
  if (bad != CAROM_OK)
    return bad;
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  const int64_t room = shot->events != NULL ? shot->room : 0; /* brief events have no states */
  replay at;
  at.balls = balls;
  at.shot = shot;
  at.count = count;
  at.known = shot->count < room ? shot->count : room;
  double last = 0.0;
  for (size_t k = 0; k < n; k++) {
    if (isnan(times[k]))
      return CAROM_ERROR_TIME;
    const double time = carom_greater(carom_lesser(times[k], shot->time), 0.0);
    if (shot->count > room && (room == 0 || time > shot->events[room - 1].time))
      return CAROM_ERROR_EVENTS_LOST;
    /* an earlier time than the last begins anew */
    if (k == 0 || time < last)
      replay_begin(&at);
    replay_go(&at, time);
    last = time;
    /* the motion after the end of the shot is unknown */
    for (int i = 0; i < count && times[k] > shot->time; i++)
      if (at.path[i].from.label != CAROM_BALL_STATIONARY && !carom_is_out(at.path[i].from.label))
        return CAROM_ERROR_TIME;
    if (!replay_states(&at, time, &states[k * (size_t)count]))
      return CAROM_ERROR_UNRESOLVED;
  }
  return CAROM_OK;
}

carom_status carom_shot_at(const carom_shot_ball *balls, int count, const carom_shot *shot,
                           double time, carom_ball_state *states) {
  return carom_shot_at_times(balls, count, shot, &time, 1, states);
}
