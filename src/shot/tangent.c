/* Derivatives of a whole shot in several directions at once: tangents that follow the events of a shot that has been played.
 * tangent_work.h has the equations. Tangents live in tangent->final, so nothing is kept but the paths. */
#include "platform/threads.h"
#include "shot/reach.h"
#include "shot/tangent_work.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double SIMULTANEOUS = 1e-9; /* s */

typedef carom_tangent_work work;

void carom_tangent_total(work *w, int side) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    for (int j = 0; j < w->m; j++)
      w->d[side][k][j] += w->rate[side][k] * w->d_time[j];
}

/* ---- From event to event ---- */

/* Tangents into rows of m of the caller's. */
static void put(double *to, carom_row d[CAROM_STATE_NUMBERS], int m) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    memcpy(to + k * m, d[k], sizeof(double) * (size_t)m);
}

/* Puts a ball behind its event, where its path begins anew. */
static void go_on(work *w, int i, int side, const carom_event *event) {
  carom_tangent_ball *ball = &w->ball[i];
  const carom_ball_state *after = &event->after[side];
  const carom_ball_rates rates = carom_rates_of(ball->kind);
  const int m = w->m;
  if (event->type == CAROM_EVENT_POCKET)
    for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
      memset(w->d[side][k], 0, sizeof(double) * (size_t)m);
  carom_tangent_settle(after, ball, m, w->d[side]);
  ball->path.from = *after;
  carom_path_begin(&ball->path, &rates, event->time);
}

/* From total tangents to those at a fixed time. */
static void fix_time(work *w, int i, int side) {
  carom_tangent_ball *ball = &w->ball[i];
  double rate[CAROM_STATE_NUMBERS];
  put(ball->d, w->d[side], w->m);
  carom_tangent_flow(ball, ball->path.start, 0, rate, w->d[side]); /* no direction: the rate alone */
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    for (int j = 0; j < w->m; j++)
      ball->d[k * w->m + j] -= rate[k] * w->d_time[j];
}

/* A ball that is about to land, and whose landing may come before or after another event of this instant. */
static bool lands_now(const carom_tangent_ball *ball, double time) {
  return carom_flies(&ball->path.from) && ball->path.end - time < SIMULTANEOUS;
}

/* Contacts so close that a small change reverses their order. A ball that is pressed into the slate lands in the same instant,
 * whatever changes. */
static void note_order(work *w, const carom_event *event) {
  const bool two = event->type == CAROM_EVENT_BALL_BALL, lands = event->type == CAROM_EVENT_SLATE;
  if (event->type == CAROM_EVENT_STRIKE || (event->type > CAROM_EVENT_JAW && !lands && event->type != CAROM_EVENT_RAIL_TOP))
    return;
  carom_tangent_ball *ball[2] = {&w->ball[event->a], two ? &w->ball[event->b] : NULL};
  for (int side = 0; side <= two; side++) {
    const bool at_once = lands && event->time <= ball[side]->path.start;
    if ((event->time - ball[side]->last_contact < SIMULTANEOUS && !at_once) || (!lands && lands_now(ball[side], event->time)))
      w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
    ball[side]->last_contact = event->time;
  }
}

/* Whether a change of the elevation lets the ball leave the cloth, which a level cue does not. */
static bool rises(const work *w) {
  bool any = false;
  for (int j = 0; j < w->m && w->opt->space != CAROM_SPACE_FLAT && w->cue->theta == 0.0; j++)
    any |= w->d[0][S_V_Z][j] != 0.0;
  return any;
}

static carom_status follow(work *w, const carom_event *event) {
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  carom_tangent_ball *a = &w->ball[event->a], *b = two ? &w->ball[event->b] : NULL;
  w->note = (carom_tangent_note){0, 0.0};
  carom_tangent_flow(a, event->time, w->m, w->rate[0], w->d[0]);
  if (two)
    carom_tangent_flow(b, event->time, w->m, w->rate[1], w->d[1]);
  if ((a->path.from.label == CAROM_BALL_ROLLING && a->kind->drag > 0.0) ||
      (two && b->path.from.label == CAROM_BALL_ROLLING && b->kind->drag > 0.0))
    w->note.flags |= CAROM_TANGENT_DRAG;
  note_order(w, event);
  const bool in_space = carom_flies(&event->before[0]);
  switch (event->type) {
  case CAROM_EVENT_STRIKE:
    carom_tangent_strike(w, event);
    return rises(w) ? carom_tangent_level_strike(w, event) : CAROM_OK;
  case CAROM_EVENT_BALL_BALL:
    return (in_space || carom_flies(&event->before[1]) || a->kind->radius != b->kind->radius ? carom_tangent_spheres
                                                                                             : carom_tangent_balls)(w, event);
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    return (in_space ? carom_tangent_nose_in_flight : carom_tangent_cushion)(w, event);
  case CAROM_EVENT_SLATE:
  case CAROM_EVENT_RAIL_TOP:
    return carom_tangent_fall(w, event);
  case CAROM_EVENT_POCKET:
    carom_tangent_pocket(w, event);
    return CAROM_OK;
  case CAROM_EVENT_LEFT_TABLE:
    carom_tangent_leave(w, event);
    return CAROM_OK;
  default:
    carom_tangent_end(a, w->m, w->d[0], w->d_time);
    carom_tangent_total(w, 0);
    return CAROM_OK;
  }
}

/* ---- Arguments ---- */

/* Whether an event can be one of the shot. */
static carom_status check_event(const carom_table *table, int count, const carom_cue *cue, const carom_event *event,
                                double since) {
  const int type = event->type;
  if (type < CAROM_EVENT_STRIKE || type > CAROM_EVENT_LEFT_TABLE || event->a < 0 || event->a >= count ||
      !(event->time >= since && event->time < INFINITY))
    return CAROM_ERROR_STATE;
  const bool two = type == CAROM_EVENT_BALL_BALL;
  const int64_t parts = two                            ? count
                        : type == CAROM_EVENT_RAIL     ? table->rails
                        : type == CAROM_EVENT_JAW      ? table->jaws
                        : type == CAROM_EVENT_POCKET   ? table->pockets
                        : type == CAROM_EVENT_RAIL_TOP ? table->rails + table->jaws
                                                       : INT64_MAX;
  if ((parts < INT64_MAX && (event->b < 0 || event->b >= parts)) || (two && event->a == event->b) ||
      (type == CAROM_EVENT_STRIKE && cue == NULL))
    return CAROM_ERROR_STATE;
  return CAROM_OK;
}

static carom_status check(const carom_table *table, int count, const carom_cue *cue, const carom_shot_options *opt,
                          const carom_shot *shot, const carom_tangent_seeds *seeds, const carom_tangent *tangent) {
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (seeds->directions < 1 || seeds->directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  for (size_t k = 0; k < sizeof seeds->reserved / sizeof seeds->reserved[0]; k++)
    if (seeds->reserved[k] != 0)
      return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_status bad = carom_check_common(table, count, opt, &where);
  if (bad != CAROM_OK)
    return bad;
  if (shot->count > 0 && (shot->events == NULL || shot->count > shot->room))
    return CAROM_ERROR_EVENTS_LOST;
  /* times, and whether the motion is known there */
  if (tangent->reach != NULL && tangent->time == NULL && shot->count > 0)
    return CAROM_ERROR_NULL;
  if (tangent->times_count > 0 && (tangent->times == NULL || tangent->at == NULL))
    return CAROM_ERROR_NULL;
  for (int64_t k = 0; k < tangent->times_count; k++)
    if (!(fabs(tangent->times[k]) < INFINITY) || (k > 0 && tangent->times[k] < tangent->times[k - 1]))
      return CAROM_ERROR_TIME;
  if (opt->world == CAROM_WORLD_POOLTOOL || opt->ball_model == CAROM_BALL_MODEL_EULER)
    return CAROM_ERROR_TANGENT;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_status status = check_event(table, count, cue, &shot->events[k], k > 0 ? shot->events[k - 1].time : 0.0);
    if (status != CAROM_OK)
      return status;
  }
  return CAROM_OK;
}

/* Where all balls begin. */
static void begin(work *w, const carom_shot_ball *balls, double *final) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  const bool own = w->table->ball_radius > 0.0 && w->opt->space != CAROM_SPACE_FLAT;
  w->reference = own ? w->table->ball_radius : balls[w->count - 1].kind.radius;
  for (int i = 0; i < w->count; i++) {
    carom_tangent_ball *ball = &w->ball[i];
    const carom_ball_rates rates = carom_rates_of(&balls[i].kind);
    *ball = (carom_tangent_ball){.kind = &balls[i].kind, .d = final + i * numbers, .last_contact = -INFINITY};
    if (w->seeds->kind != NULL)
      ball->d_kind = w->seeds->kind + i * CAROM_KIND_NUMBERS * m;
    ball->path.from = balls[i].state;
    carom_label_of_layout(&ball->path.from, rates.radius);
    carom_path_begin(&ball->path, &rates, 0.0);
    for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
      for (int j = 0; j < m; j++)
        w->d[0][k][j] = w->seeds->state != NULL ? w->seeds->state[i * numbers + k * m + j] : 0.0;
    if (carom_is_out(ball->path.from.label))
      memset(w->d[0], 0, sizeof w->d[0]);
    carom_tangent_settle(&ball->path.from, ball, m, w->d[0]);
    put(ball->d, w->d[0], m);
  }
}

/* Total tangents before event k, for those who ask. */
__attribute__((noinline)) static void before_again(const work *w, const carom_event *event, const int ball[2], int64_t k,
                                                   const carom_tangent *tangent, carom_reach *reach) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  carom_row d[2][CAROM_STATE_NUMBERS];
  double rate[CAROM_STATE_NUMBERS];
  for (int side = 0; side < 2; side++) {
    double *before = tangent->before != NULL ? tangent->before + (2 * k + side) * numbers : NULL;
    for (int n = 0; n < numbers && before != NULL && ball[side] < 0; n++)
      before[n] = 0.0;
    if (ball[side] < 0)
      continue;
    carom_tangent_flow(&w->ball[ball[side]], event->time, m, rate, d[side]);
    for (int n = 0; n < CAROM_STATE_NUMBERS; n++)
      for (int j = 0; j < m; j++)
        d[side][n][j] += rate[n] * w->d_time[j];
    if (before != NULL)
      put(before, d[side], m);
  }
  if (tangent->reach != NULL)
    carom_reach_event(reach, k, event, d);
}

static carom_status differentiate(work *w, const carom_shot_ball *balls, const carom_shot *shot, carom_tangent *tangent) {
  const int m = w->m, numbers = CAROM_STATE_NUMBERS * m;
  int64_t next = 0;
  carom_reach reach;
  begin(w, balls, tangent->final);
  if (tangent->reach != NULL)
    carom_reach_begin(&reach, w, tangent->time, tangent->reach);
  for (int64_t k = 0; k <= shot->count; k++) {
    const carom_event *event = k < shot->count ? &shot->events[k] : NULL;
    /* the times before it; after the end nothing moves */
    for (; next < tangent->times_count && (event == NULL || tangent->times[next] < event->time); next++)
      for (int i = 0; i < w->count; i++) {
        carom_tangent_flow(&w->ball[i], fmin(tangent->times[next], shot->time), m, w->rate[0], w->d[0]);
        put(tangent->at + (next * w->count + i) * numbers, w->d[0], m);
      }
    if (event == NULL)
      break;
    const int ball[2] = {event->a, event->type == CAROM_EVENT_BALL_BALL ? event->b : -1};
    if (tangent->reach != NULL)
      carom_reach_misses(&reach, event);
    const carom_status status = follow(w, event);
    if (status < 0)
      return status;
    if (tangent->time != NULL)
      memcpy(tangent->time + k * m, w->d_time, sizeof(double) * (size_t)m);
    /* total tangents before the event once more, since contacts change the rows in place */
    if (tangent->reach != NULL || tangent->before != NULL)
      before_again(w, event, ball, k, tangent, &reach);
    for (int side = 0; side < 2; side++) {
      double *after = tangent->after != NULL ? tangent->after + (2 * k + side) * numbers : NULL;
      if (ball[side] < 0) {
        for (int n = 0; n < numbers && after != NULL; n++)
          after[n] = 0.0;
        continue;
      }
      go_on(w, ball[side], side, event);
      if (after != NULL)
        put(after, w->d[side], m);
      fix_time(w, ball[side], side);
    }
    if (tangent->flags != NULL)
      tangent->flags[k] = w->note.flags;
    tangent->all_flags |= w->note.flags;
    tangent->error = fmax(tangent->error, w->note.error);
  }
  /* the end of the shot, where balls may still move, but nobody knows how they go on */
  for (int i = 0; i < w->count && tangent->times_count > 0; i++) {
    const int64_t label = w->ball[i].path.from.label;
    if (tangent->times[tangent->times_count - 1] > shot->time && label != CAROM_BALL_STATIONARY && !carom_is_out(label))
      return CAROM_ERROR_TIME;
  }
  for (int i = 0; i < w->count; i++) {
    carom_tangent_flow(&w->ball[i], shot->time, m, w->rate[0], w->d[0]);
    put(w->ball[i].d, w->d[0], m);
  }
  return CAROM_OK;
}

static const carom_shot_options no_options = {0};

carom_status carom_shot_tangent(const carom_table *table, const carom_shot_ball *balls, int count, const carom_cue *cue,
                                const carom_shot_options *opt, const carom_shot *shot, const carom_tangent_seeds *seeds,
                                carom_tangent *tangent) {
  if (table == NULL || balls == NULL || shot == NULL || seeds == NULL || tangent == NULL || tangent->final == NULL)
    return CAROM_ERROR_NULL;
  opt = opt != NULL ? opt : &no_options;
  carom_status status = check(table, count, cue, opt, shot, seeds, tangent);
  if (status != CAROM_OK && status != CAROM_ERROR_TANGENT)
    return status;
  tangent->error = 0.0;
  tangent->all_flags = 0;
  work w = {
      .table = table, .cue = cue, .opt = opt, .seeds = seeds, .count = count, .m = (int)seeds->directions, .slow_last = -1.0};
  if (status == CAROM_OK)
    status = differentiate(&w, balls, shot, tangent);
  const int64_t finals = (int64_t)count * CAROM_STATE_NUMBERS * seeds->directions;
  for (int64_t k = 0; status == CAROM_OK && k < finals; k++)
    status = isfinite(tangent->final[k]) ? CAROM_OK : CAROM_ERROR_OVERFLOW;
  for (int64_t k = 0; status != CAROM_OK && k < finals; k++)
    tangent->final[k] = NAN;
  return status;
}

/* ---- Many ---- */

static carom_status row(const carom_tangent_job *job, size_t k) {
  const carom_shot_job *played = job->played;
  const carom_status status = played->status != NULL ? (carom_status)played->status[k] : CAROM_OK;
  if (status < 0)
    return status;
  return carom_shot_tangent(played->table, played->balls + k * played->ball_stride, (int)played->count,
                            played->cues != NULL ? played->cues + k * played->cue_stride : NULL, played->options,
                            &played->shots[k], job->seeds + k * job->seeds_stride, &job->tangents[k]);
}

static size_t rows(const void *context, size_t first, size_t end) {
  const carom_tangent_job *job = context;
  size_t first_bad = end;
  for (size_t k = first; k < end; k++) {
    const carom_status status = row(job, k);
    if (job->status != NULL)
      job->status[k] = (int8_t)status;
    if (status < 0 && first_bad == end)
      first_bad = k;
  }
  return first_bad;
}

carom_status carom_shot_tangent_batch(const carom_tangent_job *job) {
  if (job == NULL || job->played == NULL)
    return CAROM_ERROR_NULL;
  const carom_shot_job *played = job->played;
  if (played->n == 0)
    return CAROM_OK;
  if (played->table == NULL || played->balls == NULL || played->shots == NULL || job->seeds == NULL || job->tangents == NULL)
    return CAROM_ERROR_NULL;
  for (size_t k = 0; k < sizeof job->reserved / sizeof job->reserved[0]; k++)
    if (job->reserved[k] != 0)
      return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_shot_options *opt = played->options != NULL ? played->options : &no_options;
  const carom_status bad = carom_check_common(played->table, played->count, opt, &where);
  if (bad != CAROM_OK)
    return bad;
  const size_t first_bad = carom_in_threads(rows, job, (size_t)played->n, opt->threads, 4);
  return first_bad == played->n ? CAROM_OK : row(job, first_bad);
}
