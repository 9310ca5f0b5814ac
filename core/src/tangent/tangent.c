/* Derivatives of shots, of collisions and of impacts on cushions: the calls, which check
 * arguments and take the directions in passes. follow.cpp differentiates. */
#include "tangent/work.h"

#include "platform/threads.h"
#include "shot/shot.h"
#include "tangent/reach.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef carom_tangent_work work;

/* The work after the checks of arguments. */
#ifdef CAROM_WITH_TANGENTS
static const carom_status BUILT = CAROM_OK;
#else
static const carom_status BUILT = CAROM_ERROR_NO_TANGENTS;
#endif

/* ---- Arguments ---- */

/* Whether an event can be one of the shot. */
static carom_status check_event(const carom_table *table, int count, const carom_cue *cue,
                                const carom_event *event, double last) {
  const int type = event->type;
  if (type < CAROM_EVENT_STRIKE || type > CAROM_EVENT_LEFT_TABLE || event->a < 0 ||
      event->a >= count || event->cluster < 0 || !(event->time >= last && event->time < INFINITY))
    return CAROM_ERROR_STATE;
  const bool two = type == CAROM_EVENT_BALL_BALL;
  const int64_t parts = carom_others_of(table, count, type);
  if ((parts < INT64_MAX && (event->b < 0 || event->b >= parts)) || (two && event->a == event->b) ||
      (type == CAROM_EVENT_STRIKE && cue == NULL))
    return CAROM_ERROR_STATE;
  return CAROM_OK;
}

/* How many contacts are resolved with an event: the contacts of its cluster, or one. */
static int contacts_of(const carom_event *event) {
  if (event->cluster == 0)
    return 1;
  return event->cluster;
}

/* Whether an event may be that one of a cluster: tip and nose are the first two. */
static bool may_be_in_cluster(const carom_event *event, int64_t place) {
  return event->type == CAROM_EVENT_BALL_BALL ||
         (place < 2 && (event->type == CAROM_EVENT_STRIKE || carom_is_nose(event)));
}

/* Whether the contacts of each cluster are all there, at one time. */
static carom_status check_clusters(const carom_shot *shot) {
  for (int64_t k = 0; k < shot->count;) {
    const carom_event *first = &shot->events[k];
    const int64_t contacts = contacts_of(first);
    if (contacts > shot->count - k)
      return CAROM_ERROR_STATE;
    for (const carom_event *e = first; first->cluster > 0 && e < first + contacts; e++)
      if (!may_be_in_cluster(e, e - first) || e->cluster != first->cluster ||
          e->time != first->time)
        return CAROM_ERROR_STATE;
    k += contacts;
  }
  return CAROM_OK;
}

/* Whether a shot has been played: nothing happens only where nothing moves. */
static bool is_played(const carom_prepared *p, const carom_cue *cue, const carom_shot *shot) {
  return (cue == NULL && carom_is_at_rest(p, -1)) || shot->count > 0 || shot->time > 0.0;
}

static carom_status check(const carom_prepared *p, const carom_cue *cue, const carom_shot *shot,
                          const carom_tangent_seeds *seeds, const carom_tangent *tangent) {
  const carom_shot_options *opt = p->opt;
  if (p->count < 1 || p->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (seeds->directions < 1 || seeds->directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  if (!CAROM_RESERVED_IS_ZERO(seeds))
    return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_status error = carom_check_common(p->table, p->count, opt, &where);
  if (error != CAROM_OK)
    return error;
  if (shot->count > 0 && (shot->events == NULL || shot->count > shot->room))
    return CAROM_ERROR_EVENTS_LOST;
  /* times, and whether the motion is known there */
  if (tangent->reach != NULL && tangent->time == NULL && shot->count > 0)
    return CAROM_ERROR_NULL;
  if (tangent->times_count > 0 && (tangent->times == NULL || tangent->at == NULL))
    return CAROM_ERROR_NULL;
  for (int64_t k = 0; k < tangent->times_count; k++)
    if (!(tangent->times[k] >= 0.0 && tangent->times[k] < INFINITY) ||
        (k > 0 && tangent->times[k] < tangent->times[k - 1]))
      return CAROM_ERROR_TIME;
  if (opt->world == CAROM_WORLD_POOLTOOL || opt->ball_model == CAROM_BALL_MODEL_EULER)
    return CAROM_ERROR_TANGENT;
  double last = 0.0;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_status status = check_event(p->table, p->count, cue, &shot->events[k], last);
    if (status != CAROM_OK)
      return status;
    last = shot->events[k].time;
  }
  if (!is_played(p, cue, shot))
    return CAROM_ERROR_STATE;
  const carom_status played = check_clusters(shot);
  /* a further touch of the tip is of the ball that it struck first */
  const carom_event *e = shot->events;
  for (int64_t k = 1; played == CAROM_OK && k < shot->count; k++)
    if (e[k].type == CAROM_EVENT_STRIKE &&
        (!carom_touches_again(&e[k]) || e[0].type != CAROM_EVENT_STRIKE || e[k].a != e[0].a))
      return CAROM_ERROR_STATE;
  return played;
}

/* ---- A pass ---- */

static carom_tangent_pass pass_of(int m, int first) {
  carom_tangent_pass pass = {m, first, CAROM_TANGENT_COLUMNS};
  if (m - first < CAROM_TANGENT_COLUMNS)
    pass.columns = m - first;
  return pass;
}

static const carom_tangent_row zeros;

/* Tangents of a state into rows of the caller's; NULL means zeros. */
static void put(const work *w, carom_tangent_row *d, double *rows, int64_t index) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    memcpy(carom_tangent_columns(&w->pass, rows, index * CAROM_STATE_NUMBERS + k),
           d != NULL ? d[k] : zeros, sizeof(double) * (size_t)w->pass.columns);
}

/* Where all balls begin. */
static void begin(work *w, const carom_prepared *p) {
  w->reference_ball = carom_reference_ball(p);
  w->reference = p->kind[w->reference_ball]->radius;
  if (w->table->ball_radius > 0.0 && w->opt->space != CAROM_SPACE_FLAT)
    w->reference = w->table->ball_radius;
  w->slow_instants = 0;
  w->slow_last = -1.0;
  w->margin = INFINITY; /* until a ball has been met */
  memset(&w->tip, 0, sizeof w->tip);
  for (int i = 0; i < w->count; i++) {
    carom_tangent_ball *ball = &w->ball[i];
    ball->kind = p->kind[i];
    ball->last_contact = -INFINITY;
    ball->origin = *p->state[i];
    carom_label_of_layout(&ball->origin, ball->kind->radius);
    carom_tangent_begin(w, i);
  }
}

/* The rows that the caller requests for event k, with the balls after it. */
static void tell(work *w, int64_t k, const carom_event *event, carom_reach *reach) {
  const carom_tangent *t = w->tangent;
  const size_t columns = sizeof(double) * (size_t)w->pass.columns;
  if (t->time != NULL)
    memcpy(carom_tangent_columns(&w->pass, t->time, k), w->time, columns);
  if (t->reach != NULL)
    carom_reach_event(reach, k, event);
  const int balls[2] = {event->a, event->b};
  for (int side = 0; side < 2; side++) {
    const bool has = side == 0 || event->type == CAROM_EVENT_BALL_BALL;
    const int i = balls[side];
    if (t->before != NULL && event->cluster == 0)
      put(w, has ? w->approach[side] : NULL, t->before, 2 * k + side);
    for (int n = 0; n < CAROM_STATE_NUMBERS && t->after != NULL; n++) {
      const double *source =
          has ? carom_tangent_columns(&w->pass, t->final, i * CAROM_STATE_NUMBERS + n) : zeros;
      memcpy(carom_tangent_columns(&w->pass, t->after, (2 * k + side) * CAROM_STATE_NUMBERS + n),
             source, columns);
    }
    if (has && t->reach != NULL)
      carom_reach_go_on(w, i);
  }
}

/* Whether a single contact has a third ball so near that a small change may make it touch
 * before. */
__attribute__((noinline)) static bool is_in_pile(const work *w, const carom_event *e) {
  static const double reach = 1e-3; /* m; gaps of racks are half of it at most */
  for (int i = 0; i < w->count && e->type == CAROM_EVENT_BALL_BALL; i++) {
    const carom_ball_rates rates =
        carom_rates_on_slope(w->ball[i].kind, w->table->slope_x, w->table->slope_y);
    carom_path path = {.from = w->ball[i].origin};
    carom_ball_state s;
    carom_path_begin(&path, &rates, w->ball[i].origin_time);
    carom_path_at(&path, &rates, e->time, &s);
    for (int side = 0; side < 2 && i != e->a && i != e->b && !carom_is_out(s.label); side++) {
      const double *r = e->before[side].r, x = s.r[0] - r[0], y = s.r[1] - r[1], z = s.r[2] - r[2];
      if (sqrt(x * x + y * y + z * z) - rates.radius - w->ball[e->a].kind->radius < reach)
        return true;
    }
  }
  return false;
}

/* Whether the struck ball meets a ball or a cushion, so that it may return to the tip. */
static bool turns_to_tip(const carom_event *e, int struck) {
  const bool ball = e->type == CAROM_EVENT_BALL_BALL && (e->a == struck || e->b == struck);
  return ball || (carom_is_nose(e) && e->a == struck);
}

/* The directions of one pass. */
static carom_status differentiate(work *w, const carom_prepared *p, const carom_shot *shot) {
  carom_tangent *tangent = w->tangent;
  carom_tangent_row *d = w->approach[0]; /* free before and behind an event */
  carom_reach reach;
  int64_t next = 0, end_of_cluster = 0;
  const bool one_by_one = w->opt->simultaneous == CAROM_SIMULTANEOUS_PAIRS ||
                          w->opt->ball_model == CAROM_BALL_MODEL_INELASTIC;
  begin(w, p);
  for (int k = 0; k < 2 && shot->count > 0; k++)
    w->tip.origin[k] = shot->events[0].before[0].r[k];
  if (tangent->reach != NULL)
    carom_reach_begin(&reach, w);
  for (int64_t k = 0; k <= shot->count; k++) {
    const carom_event *event = NULL;
    if (k < shot->count)
      event = &shot->events[k];
    /* the times before it; after the end nothing moves */
    for (; next < tangent->times_count && (event == NULL || tangent->times[next] < event->time);
         next++)
      for (int i = 0; i < w->count; i++) {
        carom_tangent_at(w, i, fmin(tangent->times[next], shot->time), d);
        put(w, d, tangent->at, next * w->count + i);
      }
    if (event == NULL)
      break;
    w->inner = k < end_of_cluster;
    const int contacts = contacts_of(event);
    for (int c = 0; c < contacts && !w->inner && tangent->reach != NULL; c++)
      carom_reach_misses(&reach, &event[c]);
    carom_status status = CAROM_OK;
    if (event->cluster == 0 && !carom_touches_again(event)) {
      status = carom_tangent_follow(w, event);
      if (one_by_one && is_in_pile(w, event))
        w->note.flags |= CAROM_TANGENT_CLUSTER;
    } else if (!w->inner) { /* all of it at once */
      status = carom_tangent_follow_cluster(w, event, contacts, k);
      end_of_cluster = k + contacts;
    }
    if (status < 0)
      return status;
    tell(w, k, event, &reach);
    if (carom_touches_again(event) && !w->inner)
      w->tip.turned = false;
    w->tip.turned |= w->cue != NULL && turns_to_tip(event, (int)w->cue->ball);
    if (tangent->flags != NULL && w->pass.first == 0)
      tangent->flags[k] = 0;
    if (tangent->flags != NULL)
      tangent->flags[k] |= w->note.flags;
    tangent->all_flags |= w->note.flags;
    tangent->error = fmax(tangent->error, w->note.error);
  }

  /* the end of the shot, where balls may still move; how they continue is not known */
  for (int i = 0; i < w->count && tangent->times_count > 0; i++) {
    const int64_t label = w->ball[i].origin.label;
    if (tangent->times[tangent->times_count - 1] > shot->time && label != CAROM_BALL_STATIONARY &&
        !carom_is_out(label))
      return CAROM_ERROR_TIME;
  }
  for (int i = 0; i < w->count; i++) {
    carom_tangent_at(w, i, shot->time, d);
    put(w, d, tangent->final, i);
  }
  return CAROM_OK;
}

static bool are_finite(const double *x, int64_t count) {
  for (int64_t k = 0; x != NULL && k < count; k++)
    if (!isfinite(x[k]))
      return false;
  return true;
}

static carom_status shot_tangent(const carom_prepared *p, const carom_cue *cue,
                                 const carom_shot *shot, const carom_tangent_seeds *seeds,
                                 carom_tangent *tangent) {
  if (tangent->final == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = check(p, cue, shot, seeds, tangent);
  if (status != CAROM_OK && status != CAROM_ERROR_TANGENT)
    return status;
  if (status == CAROM_OK)
    status = BUILT;
  tangent->error = 0.0;
  tangent->all_flags = 0;

  /* pass by pass, as many directions at a time as a number carries */
  work w;
  w.table = p->table;
  w.cue = cue;
  w.opt = p->opt;
  w.seeds = seeds;
  w.tangent = tangent;
  w.count = p->count;
  const int m = (int)seeds->directions;
  for (int first = 0; first < m && status == CAROM_OK; first += CAROM_TANGENT_COLUMNS) {
    w.pass = pass_of(m, first);
    status = differentiate(&w, p, shot);
  }

  /* derivatives that overflow, or of an error, are NaN */
  const int64_t finals = (int64_t)p->count * CAROM_STATE_NUMBERS * seeds->directions;
  const int64_t times = shot->count * seeds->directions;
  if (status == CAROM_OK &&
      !(are_finite(tangent->final, finals) && are_finite(tangent->time, times)))
    status = CAROM_ERROR_OVERFLOW;
  for (int64_t k = 0; status != CAROM_OK && k < finals; k++)
    tangent->final[k] = NAN;
  return status;
}

carom_status carom_shot_tangent(const carom_table *table, const carom_shot_ball *balls, int count,
                                const carom_cue *cue, const carom_shot_options *opt,
                                const carom_shot *shot, const carom_tangent_seeds *seeds,
                                carom_tangent *tangent) {
  if (table == NULL || balls == NULL || shot == NULL || seeds == NULL || tangent == NULL)
    return CAROM_ERROR_NULL;
  carom_prepared p;
  p.table = table;
  p.opt = carom_options_or_usual(opt);
  carom_take_balls(&p, balls, count);
  return shot_tangent(&p, cue, shot, seeds, tangent);
}

/* ---- Many ---- */

static carom_status row(const carom_tangent_job *job, size_t k) {
  const carom_shot_job *played = job->played;
  if (played->status != NULL && played->status[k] < 0)
    return (carom_status)played->status[k];
  const carom_cue *cue = NULL;
  if (played->cues != NULL)
    cue = played->cues + k * played->cue_stride;
  carom_prepared p;
  p.table = played->table;
  p.opt = carom_options_or_usual(played->options);
  carom_take_row(&p, played, k);
  return shot_tangent(&p, cue, &played->shots[k], job->seeds + k * job->seeds_stride,
                      &job->tangents[k]);
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
  if (job->seeds == NULL || job->tangents == NULL)
    return CAROM_ERROR_NULL;
  if (!CAROM_RESERVED_IS_ZERO(job))
    return CAROM_ERROR_SHOT_OPTIONS;
  int where;
  const carom_shot_options *opt = carom_options_or_usual(played->options);
  carom_status error = carom_check_job(played);
  if (error == CAROM_OK)
    error = carom_check_common(played->table, played->count, opt, &where);
  if (error != CAROM_OK)
    return error;
  const size_t first_bad = carom_in_threads(rows, job, (size_t)played->n, opt->threads, 4);
  if (first_bad == played->n)
    return CAROM_OK;
  return row(job, first_bad);
}

/* ---- Single contacts ---- */

/* What following a contact that the call has solved gives: rounding, or Euler's steps next to it,
 * may end in an error that the call has not. */
static carom_status found(carom_status followed) {
  if (followed < 0)
    return CAROM_ERROR_TANGENT;
  return followed;
}

carom_status carom_collide_tangent(const carom_impact *in, const carom_options *opt,
                                   int64_t directions, const double *seeds, double *tangent,
                                   int32_t *flags) {
  static const carom_options defaults = {.plain = 0};
  if (in == NULL || seeds == NULL || tangent == NULL)
    return CAROM_ERROR_NULL;
  if (directions < 1 || directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  const size_t m = (size_t)directions;
  carom_result out;
  carom_tangent_note note = {0, 0.0};

  /* the impact itself, which checks the arguments; other models have no derivatives */
  carom_status status = carom_collide(in, opt, &out);
  if (opt == NULL)
    opt = &defaults;
  memset(tangent, 0, 12 * m * sizeof *tangent);
  if (status >= 0 && (opt->solver == CAROM_SOLVER_EULER || opt->slip != CAROM_SLIP_PAPER))
    status = CAROM_ERROR_TANGENT;
  if (status >= 0 && BUILT < 0)
    status = BUILT;

  /* balls that part keep their motion: v and w of both among the numbers of an impact */
  if (status == CAROM_SEPARATING) {
    static const int row_of[12] = {3, 4, 5, 6, 7, 8, 15, 16, 17, 18, 19, 20};
    for (int k = 0; k < 12; k++)
      memcpy(tangent + (size_t)k * m, seeds + (size_t)row_of[k] * m, m * sizeof *tangent);
  }
  for (int first = 0; first < (int)m && status == CAROM_OK; first += CAROM_TANGENT_COLUMNS) {
    const carom_tangent_pass pass = pass_of((int)m, first);
    status = found(carom_tangent_of_balls(in, opt, &pass, seeds, tangent, &note));
  }
  if (flags != NULL)
    *flags = note.flags;
  for (size_t k = 0; status < 0 && k < 12 * m; k++)
    tangent[k] = NAN;
  return status;
}

carom_status carom_cushion_tangent(const carom_cushion_impact *in, const carom_cushion_options *opt,
                                   int64_t directions, const double *seeds, double *tangent,
                                   int32_t *flags) {
  static const carom_cushion_options defaults = {.plain = 0};
  if (in == NULL || seeds == NULL || tangent == NULL)
    return CAROM_ERROR_NULL;
  if (directions < 1 || directions > CAROM_DIRECTIONS_MOST)
    return CAROM_ERROR_DIRECTIONS;
  const size_t m = (size_t)directions;
  carom_motion out;
  carom_tangent_note note = {0, 0.0};
  carom_status status = carom_cushion(in, opt, &out);
  if (opt == NULL)
    opt = &defaults;
  if (status >= 0 && opt->convention != CAROM_CONVENTION_PAPER)
    status = CAROM_ERROR_TANGENT;
  if (status >= 0 && BUILT < 0)
    status = BUILT;
  if (status == CAROM_SEPARATING)
    memcpy(tangent, seeds, 6 * m * sizeof *tangent);
  for (int first = 0; first < (int)m && status == CAROM_OK; first += CAROM_TANGENT_COLUMNS) {
    const carom_tangent_pass pass = pass_of((int)m, first);
    status = found(carom_tangent_of_cushion(in, opt, &pass, seeds, tangent, &note));
  }
  if (flags != NULL)
    *flags = note.flags;
  for (size_t k = 0; status < 0 && k < 6 * m; k++)
    tangent[k] = NAN;
  return status;
}
