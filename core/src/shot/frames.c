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

/* A shot at a time. If `turns` is set, balls turn; then each path is begun when its event
 * occurs. */
typedef struct replay {
  uint64_t balls_hash; /* fingerprint of the slope and the balls */
  uint64_t last_of;    /* and of the last event until then */
  int64_t count;       /* of balls; 0 before the first time */
  int64_t next, turns; /* next: the first event that is later */
  double time;
  replayed ball[CAROM_BALLS_MOST];
} replay;

/* What a caller keeps: the replay at the last time, and before. */
typedef struct film {
  replay current;
  uint64_t slots[13968];
} film;
_Static_assert(sizeof(film) <= sizeof(carom_frames), "a film fits in the words of callers");

/* Keyframes: replays at some times, from which an earlier time is near.
 *
 * A shot has spans, and a span has cells, all of the same length. Each span has a slot for its
 * begin. The further cells of all spans share slots, so that they hold the cells of the span in
 * which the film was last. So a film that runs back replays each span once, and then each frame
 * from its cell. */
typedef struct keyframes {
  unsigned char *slots;
  size_t size; /* bytes of a slot */
  int64_t spans, cells;
  double length; /* of a cell, s */
} keyframes;

/* Bytes of a replay of so many balls. */
static size_t size_of(int64_t count) {
  return offsetof(replay, ball) + (size_t)count * sizeof(replayed);
}

/* Of the last event that a replay has passed, 0 before the first. */
static uint64_t last_of(const carom_shot *shot, int64_t next) {
  if (next == 0)
    return 0;
  return carom_fingerprint(0, &shot->events[next - 1], sizeof *shot->events);
}

/* As the shot begins: nothing has turned. */
static void begin(replay *state, const carom_shot_ball *balls, int count, const carom_shot *shot,
                  bool turns) {
  state->count = count;
  state->turns = turns;
  state->next = 0;
  state->time = 0.0;
  for (int i = 0; i < count; i++) {
    replayed *ball = &state->ball[i];
    ball->rates = carom_rates_on_slope(&balls[i].kind, shot->slope_x, shot->slope_y);
    ball->path.from = balls[i].state;
    ball->path.start = 0.0;
    ball->begun = 0;
    carom_label_of_layout(&ball->path.from, ball->rates.radius);
    memcpy(ball->turning.q, (double[]){1.0, 0.0, 0.0, 0.0}, sizeof ball->turning.q);
  }
}

/* The path of a ball to a time, and its turn; false where that takes more steps than any shot. */
static bool go_along(const replay *state, replayed *ball, double time, double *left) {
  if (!ball->begun) {
    carom_path_begin(&ball->path, &ball->rates, ball->path.start);
    if (state->turns)
      carom_turning_begin(&ball->turning, &ball->path, &ball->rates);
  }
  ball->begun = 1;
  return (!state->turns ||
          carom_turning_go_to(&ball->turning, &ball->path, &ball->rates, time, left)) &&
         carom_path_go_to(&ball->path, &ball->rates, time);
}

/* Goes forward to a time: the last event of each ball until then. */
static bool go_to(replay *state, const carom_shot *shot, int64_t known, double time, double *left) {
  const carom_event *events = shot->events;
  for (; state->next < known && events[state->next].time <= time; state->next++) {
    const carom_event *event = &events[state->next];
    const int moved[2] = {event->a, event->b};
    for (int side = 0; side < 1 + (event->type == CAROM_EVENT_BALL_BALL); side++) {
      if (moved[side] < 0 || moved[side] >= state->count)
        continue;
      replayed *ball = &state->ball[moved[side]];
      if (state->turns) {
        if (!go_along(state, ball, event->time, left))
          return false;
        carom_turning_at(&ball->turning, event->time, ball->turning.q);
      }
      ball->path.from = event->after[side];
      ball->path.start = event->time;
      ball->begun = 0;
    }
  }
  state->time = time;
  return true;
}

/* ---- Keyframes ------------------------------------------------------------------------------- */

static keyframes keyframes_of(film *store, int count, const carom_shot *shot) {
  keyframes keys = {.slots = (unsigned char *)store->slots, .size = size_of(count)};
  const int64_t slots = (int64_t)(sizeof store->slots / keys.size);
  keys.spans = slots / 2;
  keys.cells = slots - keys.spans + 1;
  keys.length = shot->time / (double)(keys.spans * keys.cells);
  return keys;
}

/* The slot of a cell, counted from the beginning of the shot. */
static void *slot_of(const keyframes *keep, int64_t cell) {
  const int64_t place = cell % keep->cells;
  int64_t slot = cell / keep->cells;
  if (place != 0)
    slot = keep->spans + place - 1;
  return keep->slots + keep->size * (size_t)slot;
}

/* Takes the replay back, or further on, to the latest keyframe of this shot until a time; to the
 * begin, where there is none. */
static void seek(replay *state, const keyframes *keep, const carom_shot_ball *balls,
                 const carom_shot *shot, int64_t known, double time) {
  const int64_t slots = keep->spans + keep->cells - 1;
  const int count = (int)state->count;
  const uint64_t balls_hash = state->balls_hash;
  const double earliest = time < state->time ? 0.0 : state->time;
  replay *best;
  do {
    double least = earliest;
    best = NULL;
    for (int64_t index = 0; index < slots; index++) {
      replay *slot = (replay *)(void *)(keep->slots + keep->size * (size_t)index);
      if (slot->count != count || slot->balls_hash != balls_hash || slot->time > time ||
          slot->time <= least)
        continue;
      best = slot;
      least = slot->time;
    }
    if (best == NULL)
      break;

    /* a shot that was played again has other events */
    if (best->next <= known && best->last_of == last_of(shot, best->next)) {
      memcpy(state, best, keep->size);
      return;
    }
    best->count = 0;
  } while (best != NULL);
  if (time < state->time)
    begin(state, balls, count, shot, true);
}

/* Goes forward to a time, and keeps the replay at the begin of each cell on the way. */
static bool go_by_cells(replay *state, const keyframes *keep, const carom_shot *shot, int64_t known,
                        double time, double *left) {
  const int64_t cells = keep->spans * keep->cells;
  for (int64_t cell = (int64_t)(state->time / keep->length) + 1; cell < cells; cell++) {
    const double begins = (double)cell * keep->length;
    if (begins > time)
      break;
    if (begins <= state->time)
      continue;
    if (!go_to(state, shot, known, begins, left))
      return false;
    for (int i = 0; i < state->count; i++)
      if (!go_along(state, &state->ball[i], begins, left))
        return false;
    state->last_of = last_of(shot, state->next);
    memcpy(slot_of(keep, cell), state, keep->size);
  }
  return go_to(state, shot, known, time, left);
}

/* ---- Frames ---------------------------------------------------------------------------------- */

/* The states at a time to which the replay has gone, and the turns; false where they are not to be
 * found. */
static bool find_states(replay *state, double *left, carom_ball_state *states,
                        double (*turned)[4]) {
  for (int i = 0; i < state->count; i++) {
    replayed *ball = &state->ball[i];
    if (!go_along(state, ball, state->time, left))
      return false;
    carom_ball_state now;
    carom_path_at(&ball->path, &ball->rates, state->time, &now);
    double size = 0.0;
    for (int axis = 0; axis < 3; axis++)
      size += fabs(now.r[axis]) + fabs(now.v[axis]) + fabs(now.w[axis]);
    if (!(size < INFINITY))
      return false;
    if (states != NULL)
      states[i] = now;
    if (turned != NULL)
      carom_turning_at(&ball->turning, state->time, turned[i]);
  }
  return true;
}

/* The shot whose frames are requested. */
typedef struct shown_shot {
  const carom_shot_ball *balls;
  int count;
  const carom_shot *shot;
  int64_t known;         /* events that the caller has */
  const keyframes *keep; /* NULL: none */
} shown_shot;

/* Whether the states at a time follow from the events that the caller has. */
static carom_status check_time(const shown_shot *shown, double time) {
  const carom_shot *shot = shown->shot;
  if (!(time >= 0.0))
    return CAROM_ERROR_TIME;
  const double last = shown->known > 0 ? shot->events[shown->known - 1].time : -INFINITY;
  if (shot->count > shown->known && carom_lesser(time, shot->time) > last)
    return CAROM_ERROR_EVENTS_LOST;
  return CAROM_OK;
}

/* Takes the replay to a time. An earlier time than the last begins anew, or from a keyframe. */
static bool show(replay *state, const shown_shot *shown, bool turns, double time, double *left) {
  const keyframes *keep = shown->keep;
  if (state->count == 0 || (keep == NULL && time < state->time))
    begin(state, shown->balls, shown->count, shown->shot, turns);
  if (keep == NULL)
    return go_to(state, shown->shot, shown->known, time, left);
  if (!(time >= state->time && time <= state->time + keep->length))
    seek(state, keep, shown->balls, shown->shot, shown->known, time);
  return go_by_cells(state, keep, shown->shot, shown->known, time, left);
}

/* Whether a ball moves when the replay has reached the end: its motion after it is unknown. */
static bool has_moving_ball(const replay *state) {
  for (int i = 0; i < state->count; i++) {
    const int64_t label = state->ball[i].path.from.label;
    if (label != CAROM_BALL_STATIONARY && !carom_is_out(label))
      return true;
  }
  return false;
}

/* One frame, whose states and turns go to the positions given; one of both may be NULL. A film
 * always follows the turns, which its next frame may need. */
static carom_status show_frame(replay *state, const shown_shot *shown, double time, double *left,
                               carom_ball_state *states, double (*turned)[4]) {
  const double end = shown->shot->time;
  const carom_status status = check_time(shown, time);
  if (status != CAROM_OK)
    return status;
  const bool found =
      show(state, shown, turned != NULL || shown->keep != NULL, carom_lesser(time, end), left);
  if (time > end && has_moving_ball(state))
    return CAROM_ERROR_TIME;
  if (found && find_states(state, left, states, turned))
    return CAROM_OK;
  state->count = 0;
  return CAROM_ERROR_UNRESOLVED;
}

/* The frames of a shot, onward from those before where `state` is of the same shot; `keep`
 * and one of states and turned may be NULL. */
static carom_status replay_times(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                 const double *times, size_t n, replay *state,
                                 const keyframes *keep, carom_ball_state *states,
                                 double (*turned)[4]) {
  if (balls == NULL || shot == NULL ||
      (n > 0 && (times == NULL || (states == NULL && turned == NULL))))
    return CAROM_ERROR_NULL;
  carom_status status = carom_check_room(shot);
  if (status == CAROM_OK && (count < 1 || count > CAROM_BALLS_MOST))
    status = CAROM_ERROR_BALLS;
  if (status != CAROM_OK)
    return status;

  const shown_shot shown = {balls, count, shot, carom_events_kept(shot), keep};
  double left = most_steps;
  for (size_t k = 0; k < n && status == CAROM_OK; k++) {
    const size_t first = k * (size_t)count;
    status = show_frame(state, &shown, times[k], &left, states != NULL ? &states[first] : NULL,
                        turned != NULL ? &turned[first] : NULL);
  }
  return status;
}

carom_status carom_shot_at(const carom_shot_ball *balls, int count, const carom_shot *shot,
                           double time, carom_ball_state *states) {
  return carom_shot_frames(balls, count, shot, &time, 1, NULL, states, NULL);
}

carom_status carom_shot_frames(const carom_shot_ball *balls, int count, const carom_shot *shot,
                               const double *times, size_t n, carom_frames *onward,
                               carom_ball_state *states, double (*turned)[4]) {
  replay state;
  state.count = 0;
  const bool sound = onward != NULL && balls != NULL && count > 0 && count <= CAROM_BALLS_MOST &&
                     shot != NULL && carom_check_room(shot) == CAROM_OK;
  film *store = (film *)(void *)onward;
  keyframes keep = {0};
  if (sound) {
    /* frames of another shot begin anew */
    const int64_t known = carom_events_kept(shot);
    const double slope[2] = {shot->slope_x, shot->slope_y};
    const uint64_t balls_hash = carom_fingerprint(carom_fingerprint(0, slope, sizeof slope), balls,
                                                  (size_t)count * sizeof *balls);
    memcpy(&state, &store->current, size_of(count));
    if (state.count != count || state.balls_hash != balls_hash || state.next < 0 ||
        state.next > known || state.turns != 1 || state.last_of != last_of(shot, state.next))
      state.count = 0;
    state.balls_hash = balls_hash;
    keep = keyframes_of(store, count, shot);
  }
  const carom_status status = replay_times(balls, count, shot, times, n, &state,
                                           keep.length > 0.0 ? &keep : NULL, states, turned);
  if (sound) {
    state.last_of = 0;
    if (state.count > 0)
      state.last_of = last_of(shot, state.next);
    memcpy(&store->current, &state, size_of(state.count));
  }
  return status;
}
