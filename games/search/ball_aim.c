/* Aims at a ball by its cut, by the path of one shot on an empty cloth.
 *
 * Up to its first contact the ball of the cue follows a path whose shape does not depend on the
 * direction phi of the cue: phi only turns it about the place where the ball starts. So the path
 * is computed once, for phi = 0. Let p(t) be the ball's place on it, from its start, v(t) its
 * velocity, and h(t) the height of its centre above that of the ball aimed at. At time t it
 * touches a ball, at the cut c, whose centre is
 *
 *   q(t) = p(t) + sqrt((R1 + R2)^2 - h^2) (cos c, sin c),   where the angles are from the
 *                                                           direction of v
 *
 * The ball aimed at is D away in the direction delta. So |q(t)| = D, and phi = delta - direction
 * of q(t). q is continuous between events, and its roots there are bracketed by samples and
 * halved. Something else may be met before, or the same ball at another cut: each root is played
 * up to the first contact, in their order, and the first that holds is taken.
 *
 * A ball that is met while the cue pushes has the cut at which the ball of the cue would come
 * without it, straight from its place: the direction that it gets by both is another. */
#include "ball_aim.h"

#include "platform/elementary.h"
#include "random_draws.h"
#include "small_math.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_EVENTS = 64, SAMPLES = 512, HALVINGS = 60 };
/* the cushions of an endless cloth: in radii */
static const double far_away = 1e5;
/* samples beside an event, of the time to the next one */
static const double edge = 1e-12;
static const double same_cut = 0.01, same_length = 1e-9; /* degrees, m */

/* The size of a vector in the plane of the cloth. */
static double plane_size(const double a[2]) {
  return sqrt(a[0] * a[0] + a[1] * a[1]);
}

/* The angle from one direction to another one, degrees, above 0 to the left. */
static double angle_between(const double a[2], const double b[2]) {
  const double along = a[0] * b[0] + a[1] * b[1], across = a[0] * b[1] - a[1] * b[0];
  return carom_angle_of(along, across) / degree;
}

typedef struct path {
  carom_shot_ball ball;
  carom_event events[MOST_EVENTS];
  carom_ball_state final;
  carom_shot shot;
  double touch, height; /* R1 + R2 and the height of the ball aimed at, m */
  double sine, cosine;  /* of the cut */
} path;

/* What is aimed at, and how. */
typedef struct target {
  const carom_table *table;
  const carom_shot_ball *balls;
  int count, index;
  carom_shot_options options;
  double x, y, distance, cut; /* from the ball of the cue, m; degrees */
  double touch, turn; /* R1 + R2, m; the direction in which the struck ball leaves, alone and
                                 for phi = 0, degrees */
} target;

/* A table whose cushions no ball reaches, with the origin in its middle. */
static carom_table endless_cloth(double radius) {
  const double far = far_away * radius;
  const double corner[4][2] = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  carom_table table = {.width = 2.0 * far, .length = 2.0 * far, .rails = 4};
  for (int k = 0; k < 4; k++) {
    table.rail[k] = (carom_rail){.height = 1.25 * radius, .side = 1};
    memcpy(table.rail[k].p, corner[k], sizeof corner[k]);
    memcpy(table.rail[k].q, corner[(k + 1) % 4], sizeof corner[k]);
  }
  return table;
}

/* Computes q for a state on the path; returns its length, which is NaN where the ball has no
 * direction. */
static double ball_met(const path *p, const carom_ball_state *s, double q[2]) {
  const double h = s->r[2] - p->height, speed = plane_size(s->v);
  const double share = sqrt(fmax(p->touch * p->touch - h * h, 0.0)) / speed;
  const double x = share * p->cosine, y = share * p->sine;
  q[0] = s->r[0] + x * s->v[0] - y * s->v[1];
  q[1] = s->r[1] + y * s->v[0] + x * s->v[1];
  return plane_size(q);
}

static double ball_met_at(const path *p, double time, double q[2]) {
  carom_ball_state s;
  carom_shot_at(&p->ball, 1, &p->shot, time, &s);
  return ball_met(p, &s, q);
}

/* The next time from *time on, up to `end`, at which |q| is `distance`, to *time; false where
 * there is none. Samples are `step` apart. *reached becomes true where |q| is `distance` or more
 * at one of them. */
static bool next_root(const path *p, double distance, double step, double end, double *time,
                      double q[2], bool *reached) {
  double early = *time, early_gap = ball_met_at(p, early, q) - distance;
  *reached |= early_gap >= 0.0;
  for (double late = early; late < end; early = late) {
    *time = late = fmin(late + step, end);
    const double late_gap = ball_met_at(p, late, q) - distance;
    *reached |= late_gap >= 0.0;
    if ((late_gap > 0.0) == (early_gap > 0.0))
      continue;
    for (int k = 0; k < HALVINGS; k++) {
      const double middle = 0.5 * (early + late);
      *((ball_met_at(p, middle, q) - distance > 0.0) == (early_gap > 0.0) ? &early : &late) =
          middle;
    }
    return true;
  }
  return false;
}

/* The cut at which a ball is met that comes straight from its place at the strike, degrees. */
static double pushed_cut(const target *t, double phi) {
  double u[2];
  carom_sincos_degrees(remainder(phi + t->turn, 360.0), &u[1], &u[0]);
  const double along = t->x * u[0] + t->y * u[1], across = t->x * u[1] - t->y * u[0];
  const double way = along - sqrt(fmax(t->touch * t->touch - across * across, 0.0));
  return angle_between(u, (const double[]){t->x - way * u[0], t->y - way * u[1]});
}

/* Turns the cue so that q is where the ball lies. Returns whether its ball meets that ball
 * first, and at the cut. Where something else is met before `time`, that becomes *first, unless
 * *barred is set, which then is set. */
static bool holds(const target *t, const double q[2], double time, carom_cue *cue,
                  carom_event *first, bool *barred) {
  carom_event events[MOST_EVENTS];
  carom_shot shot = {.events = events, .room = MOST_EVENTS};
  cue->phi = remainder((carom_angle_of(t->x, t->y) - carom_angle_of(q[0], q[1])) / degree, 360.0);
  if (carom_shoot(t->table, t->balls, t->count, cue, &t->options, &shot) != CAROM_STOPPED_AT_EVENT)
    return false;
  /* The contacts of a rack that breaks share one instant: that of the cue's ball is wanted. */
  const carom_event *e = &events[shot.count - 1];
  for (const carom_event *c = e; c >= events; c--)
    if (c->type == CAROM_EVENT_BALL_BALL && (c->a == cue->ball || c->b == cue->ball))
      e = c;
  const int side = e->a == cue->ball ? 0 : 1;
  const double *start = e->before[side].r, *end = e->before[1 - side].r;
  const bool pushed =
      events[0].type == CAROM_EVENT_STRIKE && events[0].cluster > 0 && e->time == events[0].time;
  if (pushed && (side == 0 ? e->b : e->a) == t->index)
    return fabs(pushed_cut(t, cue->phi) - t->cut) < same_cut;
  if (e->type == CAROM_EVENT_BALL_BALL && (side == 0 ? e->b : e->a) == t->index)
    return fabs(angle_between(e->before[side].v,
                              (const double[]){end[0] - start[0], end[1] - start[1]}) -
                t->cut) < same_cut;
  if (e->time < time && !*barred) {
    *first = *e;
    *barred = true;
  }
  return false;
}

aim_result carom_aim_at_ball(const carom_table *table, const carom_shot_ball *balls, int count,
                             const carom_shot_options *options, int index, double cut,
                             carom_cue *cue, carom_event *first) {
  const carom_shot_ball *cue_ball = &balls[cue->ball], *target_ball = &balls[index];
  const carom_table cloth = endless_cloth(cue_ball->kind.radius);
  target t = {.table = table, .balls = balls, .count = count, .index = index, .cut = cut};
  bool reached = false, barred = false;
  double q[2];
  t.x = target_ball->state.r[0] - cue_ball->state.r[0];
  t.y = target_ball->state.r[1] - cue_ball->state.r[1];
  t.distance = sqrt(t.x * t.x + t.y * t.y);
  t.options = (carom_shot_options){.world = options->world,
                                   .space = options->space,
                                   .events_most = MOST_EVENTS,
                                   .fast = options->fast};
  /* The path on an endless cloth, for phi = 0. */
  path p = {.ball = *cue_ball,
            .touch = cue_ball->kind.radius + target_ball->kind.radius,
            .height = target_ball->state.r[2]};
  carom_sincos_degrees(cut, &p.sine, &p.cosine);
  carom_cue straight = *cue;
  p.ball.state.r[0] = p.ball.state.r[1] = straight.phi = 0.0;
  p.shot = (carom_shot){.events = p.events, .room = MOST_EVENTS, .final = &p.final};
  straight.ball = 0;
  carom_shoot(&cloth, &p.ball, 1, &straight, &t.options, &p.shot);
  t.touch = p.touch;
  t.turn = carom_angle_of(p.events[0].after[0].v[0], p.events[0].after[0].v[1]) / degree;
  t.options.stop_at = CAROM_STOP_AT_CONTACT | CAROM_STOP_AT(CAROM_EVENT_RAIL) |
                      CAROM_STOP_AT(CAROM_EVENT_JAW) | CAROM_STOP_AT(CAROM_EVENT_POCKET) |
                      CAROM_STOP_AT(CAROM_EVENT_RAIL_TOP) | CAROM_STOP_AT(CAROM_EVENT_LEFT_TABLE);
  /* A ball that touches is met before or after a raised cue's ball meets the slate; roots of
   * each interval between events. */
  for (int64_t k = 0; k < p.shot.count; k++) {
    const double length =
        (k + 1 < p.shot.count ? p.events[k + 1].time : p.shot.time) - p.events[k].time;
    const double end = p.events[k].time + (1.0 - edge) * length;
    double time = p.events[k].time + edge * length;
    if (fabs(ball_met(&p, &p.events[k].after[0], q) - t.distance) < same_length &&
        holds(&t, q, time + same_length, cue, first, &barred))
      return AIM_FOUND;
    while (length > 0.0 &&
           next_root(&p, t.distance, length / (double)SAMPLES, end, &time, q, &reached))
      if (holds(&t, q, time, cue, first, &barred))
        return AIM_FOUND;
  }
  if (barred)
    return AIM_BARRED;
  return reached ? AIM_NONE : AIM_NOT_REACHED;
}
