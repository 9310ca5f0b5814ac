/* How far tangents reach: the change, in the unit of a direction, at which to first order a
 * ball's own sequence of events changes. The least of
 *
 *     order     two successive events of a ball swap: (T2 - T1) / |dT2 - dT1|
 *     miss      a hit on a ball, a nose or a pocket becomes a miss: (r - |s|) / |ds|,
 *               s = d x v / |v| the distance at which the straight line along the relative
 *               velocity would pass the centre, r the sum of the radii
 *     hit       a miss becomes a hit: the least distance of the surfaces on the way over its
 *               derivative n . (d_b - d_a), also where a ball stops short of something,
 *               or lands next to a pocket
 *     end       a ball on a rail comes to its end, where a jaw stands, or the other way round
 *     tip       the same of the tip of a cue that continues, which also ends its way
 *     spin      a spin about the vertical ends before a contact, or lasts until it: the spin
 *               there over its derivative, at a fixed time of the contact
 *     hop       the last hop of a ball on the slate: its fall less the least one after which
 *               there is a hop
 *     turn      the velocity of a ball behind a contact of a cluster changes by itself:
 *               |v| / |dv|
 *
 * In flight the tops of rails, the backs of pockets and the edge of the table do not count. */
#include "tangent/reach.h"
#include "cluster/cue.h"
#include "shot/shot.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double NEAR = 0.2;      /* m: gaps beyond are not requested; */
static const double TOUCHING = 2e-4; /* nor those up to this, of bodies that touched or nearly did
                                        as the way began */
enum { PARTS_OF_WAY = 6, BISECTIONS = 30 };

void carom_reach_go_on(carom_tangent_work *work, int i) {
  carom_tangent_ball *ball = &work->ball[i];
  const carom_ball_rates rates =
      carom_rates_on_slope(ball->kind, work->table->slope_x, work->table->slope_y);
  carom_path path = {.from = ball->origin};
  carom_path_begin(&path, &rates, ball->origin_time);
  memcpy(ball->a, path.a, sizeof ball->a);
}

void carom_reach_begin(carom_reach *reach, carom_tangent_work *work) {
  reach->work = work;
  reach->reach = work->tangent->reach + work->pass.first;
  for (int i = 0; i < work->count; i++) {
    reach->last_event[i] = -1;
    carom_reach_go_on(work, i);
  }
  for (int j = 0; j < work->pass.columns; j++)
    reach->reach[j] = INFINITY;
}

/* A gap below 0 is a rounding error, of a hit that only just is one. */
static void take(carom_reach *reach, int j, double gap, double rate) {
  if (rate != 0.0)
    reach->reach[j] = carom_lesser(reach->reach[j], carom_greater(gap, 0.0) / fabs(rate));
}

/* ---- Misses */

/* A ball and what it may miss, from a time on: the way from the ball to the middle of that, d +
 * v t + a t^2, or to an end of a rail, across whose line they touch. The distance is that from a
 * ring around the middle, or behind the line; they touch at `reach`. */
typedef struct miss {
  int type, ball, partner; /* of the event that does not happen */
  double start, d[3], v[3], a[3], line[3];
  double ring, reach;
} miss;

/* Position, velocity and half the acceleration of a ball at a time; on the cloth, at the height of
 * its radius. */
static void motion_at(const carom_tangent_ball *ball, double time, double r[3], double v[3],
                      double a[3]) {
  const double tau = time - ball->origin_time;
  const bool moves = carom_translates(ball->origin.label);
  for (int k = 0; k < 3; k++) {
    r[k] = ball->origin.r[k];
    v[k] = a[k] = 0.0;
    if (moves) {
      r[k] += tau * (ball->origin.v[k] + tau * ball->a[k]);
      v[k] = ball->origin.v[k] + 2.0 * tau * ball->a[k];
      a[k] = ball->a[k];
    }
  }
  if (!carom_flies(&ball->origin))
    r[2] = ball->kind->radius;
}

/* Ball i, and ball or part b. */
static miss miss_of(const carom_tangent_work *w, int i, int type, int b) {
  const carom_tangent_ball *ball = &w->ball[i];
  const carom_table *table = w->table;
  miss m = {.type = type, .ball = i, .partner = b, .start = ball->origin_time};
  double r[2][3], v[2][3] = {{0}}, a[2][3] = {{0}};
  if (type == CAROM_EVENT_BALL_BALL) {
    m.start = fmax(ball->origin_time, w->ball[b].origin_time);
    motion_at(&w->ball[b], m.start, r[1], v[1], a[1]);
    m.reach = ball->kind->radius + w->ball[b].kind->radius;
  }
  motion_at(ball, m.start, r[0], v[0], a[0]);

  /* a pocket has no height, nor has a cushion for a ball on the cloth */
  if (type == CAROM_EVENT_POCKET) {
    memcpy(r[1], table->pocket[b].centre, sizeof table->pocket[b].centre);
    r[1][2] = r[0][2];
    m.reach = table->pocket[b].radius;
  } else if (type != CAROM_EVENT_BALL_BALL) {
    const bool rail = type == CAROM_EVENT_RAIL, flies = carom_flies(&ball->origin);
    double height;
    if (rail) {
      height = table->rail[b].height;
      memcpy(r[1], table->rail[b].p, 2 * sizeof r[1][0]);
      carom_rail_line(&table->rail[b], m.line);
    } else { /* the ring of a jaw */
      height = table->jaw[b].height;
      memcpy(r[1], table->jaw[b].centre, 2 * sizeof r[1][0]);
      m.ring = table->jaw[b].radius;
    }

    /* a nose in flight is inside its wall, where the ball touches it at R */
    r[1][2] = r[0][2];
    if (flies) {
      const double nose = carom_nose_height(ball->kind, height);
      r[1][2] = nose;
      m.ring += carom_nose_shift(nose, w->reference);
      m.reach = ball->kind->radius;
    } else {
      m.reach = carom_reach_on_cloth(ball->kind, height, w->reference);
    }
  }

  for (int k = 0; k < 3; k++) {
    m.d[k] = r[1][k] - r[0][k];
    m.v[k] = v[1][k] - v[0][k];
    m.a[k] = a[1][k] - a[0][k];
  }
  return m;
}

/* The distance at a time, below 0 behind a rail on the cloth; and whether it grows: above 0. */
static double distance_at(const miss *m, double t, double *opens) {
  double d[3], v[3];
  for (int k = 0; k < 3; k++) {
    d[k] = m->d[k] + t * (m->v[k] + t * m->a[k]);
    v[k] = m->v[k] + 2.0 * t * m->a[k];
  }

  /* the horizontal part of the path, or the part across the line of a rail */
  const bool rail = m->type == CAROM_EVENT_RAIL;
  const double q = carom_plane_size(d);
  double away = q, rate;
  if (rail) {
    away = -carom_plane_dot(m->line, d);
    rate = -carom_plane_dot(m->line, v);
  } else {
    rate = carom_plane_dot(d, v) / q;
  }
  const double level = away - m->ring;
  *opens = level * rate + d[2] * v[2];
  if (rail && d[2] == 0.0)
    return level;
  return sqrt(level * level + d[2] * d[2]);
}

/* When the cue that continues reaches the end of its path, s, and its tangents. */
static double end_of_tip(const carom_tangent_work *w, carom_tangent_row d) {
  const carom_tangent_tip *tip = &w->tip;
  const double speed = carom_arm_speed(w->cue, tip->V), time = tip->left / speed;
  const bool slow = speed > tip->V; /* the arm, whose speed has no tangent here */
  for (int j = 0; j < w->pass.columns; j++)
    d[j] = tip->start[j] + (tip->left_row[j] - (slow ? 0.0 : time * tip->V_row[j])) / speed;
  return tip->start_time + time;
}

/* What the gap at a time is worth in each direction, where it is one that a change may close.
 * first: the gap where the way began. */
static void take_gap(carom_reach *reach, const miss *m, double t, double first) {
  double opens;
  if (distance_at(m, t, &opens) - m->reach >= NEAR)
    return;

  /* its value, too, by the path itself, whose pieces with drag m does not know */
  carom_tangent_row d = {0.0};
  const carom_event event = {.time = m->start + t, .type = m->type, .a = m->ball, .b = m->partner};
  const double gap = carom_tangent_gap(reach->work, &event, d);
  if (m->type == CAROM_EVENT_STRIKE) {
    carom_tangent_row end;
    end_of_tip(reach->work, end);
    for (int j = 0; j < reach->work->pass.columns; j++)
      d[j] += d[CAROM_TANGENT_COLUMNS] * end[j];
  }
  for (int j = 0; j < reach->work->pass.columns; j++)
    if (gap > (first <= TOUCHING ? TOUCHING : 0.0))
      take(reach, j, gap, d[j]);
}

/* Whether a position on the way is next to a rail, and not beyond its ends. */
static bool is_beside(const miss *m, const carom_rail *rail, double t) {
  const double e_x = rail->q[0] - rail->p[0], e_y = rail->q[1] - rail->p[1];
  const double along = -((m->d[0] + t * (m->v[0] + t * m->a[0])) * e_x +
                         (m->d[1] + t * (m->v[1] + t * m->a[1])) * e_y);
  return along >= 0.0 && along <= e_x * e_x + e_y * e_y;
}

/* The least distances on the way up to a time; stops: the end of the way counts as one. */
static void search(carom_reach *reach, const miss *m, double end, bool stops) {
  /* what is too far for the complete path is not missed */
  const carom_tangent_work *w = reach->work;
  double way = 0.0, previous, current;
  const double T = end - m->start, first = distance_at(m, 0.0, &previous) - m->reach;
  for (int k = 0; k < 3; k++)
    way += T * (fabs(m->v[k]) + T * fabs(m->a[k]));
  if (!(T > 0.0) || first - way > NEAR)
    return;

  const bool rail = m->type == CAROM_EVENT_RAIL;
  if (rail && !carom_flies(&w->ball[m->ball].origin)) {
    take_gap(reach, m, T, first);
    return;
  }

  /* a section of the path at whose end the distance grows has a minimum within */
  for (int k = 1; k <= PARTS_OF_WAY; k++, previous = current) {
    double low = T * (k - 1) / (double)PARTS_OF_WAY, high = T * k / (double)PARTS_OF_WAY, opens;
    distance_at(m, high, &current);
    const bool least = previous < 0.0 && current >= 0.0;
    for (int n = 0; n < BISECTIONS && least; n++) {
      const double middle = 0.5 * (low + high);
      distance_at(m, middle, &opens);
      if (opens < 0.0)
        low = middle;
      else
        high = middle;
    }
    if ((least || (stops && k == PARTS_OF_WAY && previous < 0.0)) &&
        (!rail || is_beside(m, &w->table->rail[m->partner], high)))
      take_gap(reach, m, high, first);
  }
}

/* Whether the spin of a ball on the cloth lasts until a contact. Of one that spins not, a change
 * of either sign makes one. */
static void spin_of(carom_reach *reach, int i, const carom_event *event) {
  const carom_tangent_work *w = reach->work;
  const carom_tangent_ball *ball = &w->ball[i];
  if (!carom_translates(ball->origin.label) || carom_flies(&ball->origin))
    return;
  const double lost = carom_rates_of(ball->kind).spin * (event->time - ball->origin_time);
  const double *d =
      carom_tangent_columns(&w->pass, w->tangent->final, i * CAROM_STATE_NUMBERS + S_W_Z);
  for (int j = 0; j < w->pass.columns && lost > 0.0; j++)
    take(reach, j, fabs(fabs(ball->origin.w[2]) - lost), d[j]);
}

/* What ball i misses on its path, up to the event: on the cloth a rail only where it stops short of
 * it, in flight no pocket. */
static void misses_of(carom_reach *reach, int i, const carom_event *event) {
  static const int types[] = {CAROM_EVENT_BALL_BALL, CAROM_EVENT_RAIL, CAROM_EVENT_JAW,
                              CAROM_EVENT_POCKET};
  const carom_tangent_work *w = reach->work;
  const int64_t counts[] = {w->count, w->table->rails, w->table->jaws, w->table->pockets};
  const carom_ball_state *state = &w->ball[i].origin;
  const bool moves = carom_translates(state->label), flies = carom_flies(state);
  const bool stops =
      event->type == CAROM_EVENT_ROLLING_SPINNING || event->type == CAROM_EVENT_ROLLING_STATIONARY;
  for (int n = 0; n < 4; n++)
    for (int b = 0; b < counts[n]; b++) {
      const int type = types[n];
      const bool ball = type == CAROM_EVENT_BALL_BALL;
      int64_t label = CAROM_BALL_STATIONARY;
      if (ball)
        label = w->ball[b].origin.label;
      const bool is_hit = event->type == type && (b == event->b || (ball && b == event->a));
      if (is_hit || (ball && b == i) || carom_is_out(label) ||
          !(moves || carom_translates(label)) || (type == CAROM_EVENT_RAIL && !flies && !stops) ||
          (type == CAROM_EVENT_POCKET && flies))
        continue;
      const miss m = miss_of(w, i, type, b);
      search(reach, &m, event->time, stops);
    }
}

/* The tip that continues, up to the event: it is looked for from the first contact of the struck
 * ball with another or a cushion on. */
static void misses_of_tip(carom_reach *reach, int i, const carom_event *event) {
  const carom_tangent_work *w = reach->work;
  const carom_tangent_tip *tip = &w->tip;
  const carom_tangent_ball *ball = &w->ball[i];
  if (!tip->turned || !(tip->left > 0.0) || i != w->cue->ball || carom_touches_again(event) ||
      carom_is_out(ball->origin.label))
    return;
  carom_tangent_row d;
  double r[3], v[3], a[3], axes[3][3];
  const double R = ball->kind->radius,
               origin[3] = {tip->origin[0] + tip->moved[0], tip->origin[1] + tip->moved[1],
                            R + tip->moved[2]};
  const double end = end_of_tip(w, d);
  miss m = {.type = CAROM_EVENT_STRIKE, .ball = i, .partner = -1, .reach = R};
  m.start = fmax(ball->origin_time, tip->start_time);
  motion_at(ball, m.start, r, v, a);
  carom_tip_from(w->cue, R, origin, tip->along + tip->V * (m.start - tip->start_time), r, axes,
                 m.d);
  for (int k = 0; k < 3; k++) {
    m.v[k] = tip->V * axes[0][k] - v[k];
    m.a[k] = -a[k];
  }
  search(reach, &m, fmin(event->time, end), end <= event->time);
}

void carom_reach_misses(carom_reach *reach, const carom_event *event) {
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  const int balls[2] = {event->a, event->b};
  for (int side = 0; side <= two; side++) {
    misses_of(reach, balls[side], event);
    misses_of_tip(reach, balls[side], event);
    if (two || event->type == CAROM_EVENT_RAIL || event->type == CAROM_EVENT_JAW)
      spin_of(reach, balls[side], event);
  }
}

/* Whether a jaw rounds an end of a rail. */
static bool rounds(const carom_jaw *jaw, const double end[2]) {
  const double x = jaw->centre[0] - end[0], y = jaw->centre[1] - end[1],
               off = sqrt(x * x + y * y) - jaw->radius;
  return fabs(off) < 1e-4;
}

/* The rails next to an event. A ball that meets a rail beyond its end meets the jaw there instead,
 * one that meets a jaw beyond the end of its rail the rail; and one that falls into a pocket, or
 * meets a jaw, may meet a rail before. */
static void take_rails(carom_reach *reach, const carom_event *event, carom_tangent_rows d) {
  const carom_tangent_work *w = reach->work;
  const carom_ball_state *s = &event->before[0];
  const carom_jaw *jaw = event->type == CAROM_EVENT_JAW ? &w->table->jaw[event->b] : NULL;
  for (int64_t k = 0; k < w->table->rails; k++) {
    const carom_rail *rail = &w->table->rail[k];
    const double e[2] = {rail->q[0] - rail->p[0], rail->q[1] - rail->p[1]},
                 length = carom_plane_size(e);
    const double x = s->r[0] - rail->p[0], y = s->r[1] - rail->p[1],
                 place = (e[0] * x + e[1] * y) / length;
    const double beyond = carom_greater(-place, place - length);
    double line[3];
    carom_rail_line(rail, line);
    const double reaches = carom_reach_on_cloth(w->ball[event->a].kind, rail->height, w->reference);
    const double gap = carom_plane_dot(line, s->r) + line[2] - reaches;
    const bool meets = event->type == CAROM_EVENT_RAIL && event->b == k;
    const bool at_end =
        meets || (jaw != NULL && beyond > 0.0 && rounds(jaw, place < 0.0 ? rail->p : rail->q));
    const bool approaches =
        event->type != CAROM_EVENT_RAIL && beyond <= 0.0 && gap > 0.0 && gap < NEAR;
    for (int j = 0; j < w->pass.columns && (at_end || approaches); j++)
      take(reach, j, at_end ? fabs(beyond) : gap,
           at_end ? (e[0] * d[S_X][j] + e[1] * d[S_Y][j]) / length
                  : line[0] * d[S_X][j] + line[1] * d[S_Y][j]);
  }
}

/* A landing: next to a pocket, and whether it is the last. */
static void take_landing(carom_reach *reach, const carom_event *event, carom_tangent_rows d) {
  const carom_tangent_work *w = reach->work;
  const carom_ball_state *s = &event->before[0];
  const double e = carom_slate_restitution(w->ball[event->a].kind->restitution_table);
  /* the least fall after which the ball hops */
  double low = 0.0, high = 0.0;
  if (e > 0.0)
    high = 1.0 / e;
  for (int k = 0; k < BISECTIONS && e > 0.0; k++) {
    const double middle = 0.5 * (low + high);
    if (carom_rebound(middle, e) > 0.0)
      high = middle;
    else
      low = middle;
  }

  /* the last hop more or less, and pockets that the ball would fall into */
  for (int j = 0; j < w->pass.columns; j++) {
    if (e > 0.0)
      take(reach, j, fabs(-s->v[2] - high), d[S_V_Z][j]);
    for (int64_t k = 0; k < w->table->pockets; k++) {
      const carom_pocket *pocket = &w->table->pocket[k];
      const double x = s->r[0] - pocket->centre[0], y = s->r[1] - pocket->centre[1],
                   q = sqrt(x * x + y * y);
      if (q - pocket->radius < NEAR)
        take(reach, j, q - pocket->radius, (x * d[S_X][j] + y * d[S_Y][j]) / q);
    }
  }
}

/* A ball after a contact of a cluster, in which touches appear and disappear that nobody follows: a
 * change of its velocity by as much as the velocity itself has other touches. */
static void take_turn(carom_reach *reach, int i) {
  const carom_tangent_work *w = reach->work;
  const double *v = w->ball[i].origin.v;
  const int row = i * CAROM_STATE_NUMBERS;
  const double *d_x = carom_tangent_columns(&w->pass, w->tangent->final, row + S_V_X),
               *d_y = carom_tangent_columns(&w->pass, w->tangent->final, row + S_V_Y);
  const double speed = carom_plane_size(v);
  for (int j = 0; j < w->pass.columns && speed > 0.0; j++)
    take(reach, j, speed, sqrt(d_x[j] * d_x[j] + d_y[j] * d_y[j]));
}

/* The order of the events of ball i: event k follows its last one. */
static void take_order(carom_reach *reach, int64_t k, const carom_event *event, int i) {
  carom_tangent_work *w = reach->work;
  const int64_t last = reach->last_event[i];
  /* a ball that is pressed into the slate lands at once, and one that is on a rail is off
   * the table, whatever changes */
  const bool is_forced = event->type == CAROM_EVENT_SLATE || event->type == CAROM_EVENT_LEFT_TABLE;
  const bool at_once = is_forced && event->time <= reach->last_time[i];
  if (last >= 0 && !at_once) {
    const double *last_time = carom_tangent_columns(&w->pass, w->tangent->time, last);
    for (int j = 0; j < w->pass.columns; j++)
      take(reach, j, event->time - reach->last_time[i], w->time[j] - last_time[j]);
  }
  reach->last_event[i] = k;
  reach->last_time[i] = event->time;
}

void carom_reach_event(carom_reach *reach, int64_t k, const carom_event *event) {
  carom_tangent_work *w = reach->work;
  carom_tangent_rows *d = w->approach;
  const int m = w->pass.columns;
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  const int balls[2] = {event->a, event->b};
  for (int side = 0; side <= two; side++)
    take_order(reach, k, event, balls[side]);
  if (event->type == CAROM_EVENT_SLATE)
    take_landing(reach, event, d[0]);
  const bool on_cloth = !carom_flies(&event->before[0]);
  if (event->type == CAROM_EVENT_RAIL || event->type == CAROM_EVENT_JAW ||
      (event->type == CAROM_EVENT_POCKET && on_cloth))
    take_rails(reach, event, d[0]);

  /* a further touch before the end of its way */
  if (carom_touches_again(event))
    for (int j = 0; j < m; j++)
      take(reach, j, w->tip.touch_left, w->tip.touch_left_row[j]);

  /* of a cluster the contact that starts it, and a ball that leaves it quite otherwise */
  if (w->note.flags & CAROM_TANGENT_CLUSTER)
    for (int side = 0; side <= two; side++)
      take_turn(reach, balls[side]);
  for (int j = 0; j < m && !w->inner && w->margin < INFINITY; j++)
    take(reach, j, w->margin, w->margin_row[j]);
}
