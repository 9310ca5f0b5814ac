/* How far tangents reach: the change, in the unit of a direction, at which to first order a ball's own sequence of events
 * changes. The least of
 *
 *     order     two successive events of a ball swap: (T2 - T1) / |dT2 - dT1|
 *     miss      a hit on a ball, a jaw or a pocket becomes a miss: (r - |s|) / |ds|, s = d x v / |v| the distance at which the
 *               straight line along the relative velocity would pass the centre, r the sum of the radii
 *     hit       a miss becomes a hit: the least distance of the surfaces on the way over its derivative n . (d_b - d_a), also
 *               where a ball comes to rest short of something
 */
#include "shot/reach.h"
#include "shot/sim.h"

#include <math.h>
#include <string.h>

static const double NEAR = 0.2;      /* m: gaps beyond are not asked for; */
static const double TOUCHING = 2e-4; /* nor those of balls that have just parted */
enum { PARTS_OF_WAY = 6, BISECTIONS = 30 };

void carom_reach_begin(carom_reach *reach, const carom_table *table, const carom_tangent_ball *ball, int count, int m,
                       const double *time, double *to) {
  *reach = (carom_reach){.table = table, .ball = ball, .count = count, .m = m, .reach = to, .time = time};
  for (int i = 0; i < count; i++)
    reach->last_event[i] = -1;
  for (int j = 0; j < m; j++)
    to[j] = INFINITY;
}

static void take(carom_reach *reach, int j, double gap, double rate) {
  if (rate != 0.0)
    reach->reach[j] = carom_lesser(reach->reach[j], gap / fabs(rate));
}

/* The separation to what a ball may meet, quadratic in the time since `from`: d + v t + a t^2. */
typedef struct separation {
  double from, d[2], v[2], a[2];
} separation;

static double distance_at(const separation *s, double t, double place[2]) {
  for (int k = 0; k < 2; k++)
    place[k] = s->d[k] + t * (s->v[k] + t * s->a[k]);
  return sqrt(place[0] * place[0] + place[1] * place[1]);
}

/* Half of the rate of the squared distance. */
static double opens_at(const separation *s, double t) {
  double place[2];
  distance_at(s, t, place);
  return place[0] * (s->v[0] + 2.0 * t * s->a[0]) + place[1] * (s->v[1] + 2.0 * t * s->a[1]);
}

/* What the gap at a time is worth in each direction. other: the ball that is missed, or NULL. */
__attribute__((noinline)) static void take_gap(carom_reach *reach, const carom_tangent_ball *ball,
                                               const carom_tangent_ball *other, double time, const double n[2], double gap) {
  carom_row d[CAROM_STATE_NUMBERS];
  carom_row along;
  double rate[CAROM_STATE_NUMBERS];
  carom_tangent_flow(ball, time, reach->m, rate, d);
  for (int j = 0; j < reach->m; j++)
    along[j] = -(n[0] * d[S_X][j] + n[1] * d[S_Y][j]);
  if (other != NULL) {
    carom_tangent_flow(other, time, reach->m, rate, d);
    for (int j = 0; j < reach->m; j++)
      along[j] += n[0] * d[S_X][j] + n[1] * d[S_Y][j];
  }
  for (int j = 0; j < reach->m; j++)
    take(reach, j, gap, along[j]);
}

/* The least distances on the way from t = 0 to T; stops: the end of the way counts as one. */
static void search(carom_reach *reach, const carom_tangent_ball *ball, const carom_tangent_ball *other, const separation *s,
                   double T, double reaches, bool stops) {
  double place[2];
  const double way = T * (fabs(s->v[0]) + fabs(s->v[1]) + T * (fabs(s->a[0]) + fabs(s->a[1])));
  if (!(T > 0.0) || distance_at(s, 0.0, place) - way > reaches + NEAR)
    return;
  double before = opens_at(s, 0.0);
  for (int k = 1; k <= PARTS_OF_WAY; k++) {
    double low = T * (k - 1) / (double)PARTS_OF_WAY, high = T * k / (double)PARTS_OF_WAY;
    const double now = opens_at(s, high);
    const bool least = before < 0.0 && now >= 0.0, end = stops && k == PARTS_OF_WAY && before < 0.0 && !least;
    before = now;
    if (!least && !end)
      continue;
    for (int n = 0; n < BISECTIONS && least; n++) {
      const double middle = 0.5 * (low + high);
      *(opens_at(s, middle) < 0.0 ? &low : &high) = middle;
    }
    const double distance = distance_at(s, high, place), gap = distance - reaches;
    if (gap > TOUCHING && gap < NEAR) {
      const double n[2] = {place[0] / distance, place[1] / distance};
      take_gap(reach, ball, other, s->from + high, n, gap);
    }
  }
}

/* Place, velocity and half the acceleration of a path at a time. */
static void motion_at(const carom_path *path, double time, double r[2], double v[2], double a[2]) {
  const double tau = time - path->start;
  const bool moves = carom_translates(path->from.label);
  for (int k = 0; k < 2; k++) {
    r[k] = path->from.r[k] + (moves ? tau * (path->from.v[k] + tau * path->a[k]) : 0.0);
    v[k] = moves ? path->from.v[k] + 2.0 * tau * path->a[k] : 0.0;
    a[k] = moves ? path->a[k] : 0.0;
  }
}

static separation between(const carom_path *path, const carom_path *other, const double *point, double from) {
  separation s = {.from = from};
  double r[2][2], v[2][2] = {{0}}, a[2][2] = {{0}};
  motion_at(path, from, r[0], v[0], a[0]);
  if (other != NULL)
    motion_at(other, from, r[1], v[1], a[1]);
  else
    memcpy(r[1], point, sizeof r[1]);
  for (int k = 0; k < 2; k++) {
    s.d[k] = r[1][k] - r[0][k];
    s.v[k] = v[1][k] - v[0][k];
    s.a[k] = a[1][k] - a[0][k];
  }
  return s;
}

/* What ball i missed on its path, up to the event; `with` is the part or ball that it met. */
static void misses_of(carom_reach *reach, int i, const carom_event *event) {
  const carom_tangent_ball *ball = &reach->ball[i];
  const carom_path *path = &ball->path;
  const double R = ball->kind->radius, now = event->time;
  const bool stops = event->type == CAROM_EVENT_ROLLING_SPINNING || event->type == CAROM_EVENT_ROLLING_STATIONARY;
  const bool moves = carom_translates(path->from.label);
  for (int q = 0; q < reach->count; q++) {
    const carom_tangent_ball *other = &reach->ball[q];
    const bool met = event->type == CAROM_EVENT_BALL_BALL && (q == event->a || q == event->b);
    if (q == i || met || other->path.from.label == CAROM_BALL_POCKETED || !(moves || carom_translates(other->path.from.label)))
      continue;
    const double from = fmax(path->start, other->path.start);
    const separation s = between(path, &other->path, NULL, from);
    search(reach, ball, other, &s, now - from, 2.0 * R, stops);
  }
  if (!moves)
    return;
  const carom_table *table = reach->table;
  for (int64_t k = 0; k < table->jaws; k++) {
    const separation s = between(path, NULL, table->jaw[k].centre, path->start);
    if (event->type != CAROM_EVENT_JAW || event->b != k)
      search(reach, ball, NULL, &s, now - path->start, table->jaw[k].radius + R, stops);
  }
  for (int64_t k = 0; k < table->pockets; k++) {
    const separation s = between(path, NULL, table->pocket[k].centre, path->start);
    if (event->type != CAROM_EVENT_POCKET || event->b != k)
      search(reach, ball, NULL, &s, now - path->start, table->pocket[k].radius, stops);
  }
  /* rails, which a ball misses only where it stops short of them */
  for (int64_t k = 0; stops && k < table->rails; k++) {
    double line[3];
    carom_rail_line(&table->rail[k], line);
    const double *r = event->before[0].r, gap = line[0] * r[0] + line[1] * r[1] + line[2] - R;
    const double n[2] = {-line[0], -line[1]};
    if (gap > TOUCHING && gap < NEAR)
      take_gap(reach, ball, NULL, now, n, gap);
  }
}

void carom_reach_misses(carom_reach *reach, const carom_event *event) {
  misses_of(reach, event->a, event);
  if (event->type == CAROM_EVENT_BALL_BALL)
    misses_of(reach, event->b, event);
}

void carom_reach_event(carom_reach *reach, int64_t k, const carom_event *event, carom_row (*d)[CAROM_STATE_NUMBERS]) {
  const int m = reach->m;
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  /* the order of the events of each ball */
  for (int side = 0; side <= two; side++) {
    const int i = side == 0 ? event->a : event->b;
    const int64_t last = reach->last_event[i];
    for (int j = 0; j < m && last >= 0; j++)
      take(reach, j, event->time - reach->last_time[i], reach->time[k * m + j] - reach->time[last * m + j]);
    reach->last_event[i] = k;
    reach->last_time[i] = event->time;
  }
  /* a hit that would be a miss */
  const carom_ball_state *a = &event->before[0], *b = &event->before[1];
  double to[2] = {0}, r;
  const double R = reach->ball[event->a].kind->radius;
  if (two) {
    to[0] = b->r[0];
    to[1] = b->r[1];
    r = 2.0 * R;
  } else if (event->type == CAROM_EVENT_JAW) {
    memcpy(to, reach->table->jaw[event->b].centre, sizeof to);
    r = reach->table->jaw[event->b].radius + R;
  } else if (event->type == CAROM_EVENT_POCKET) {
    memcpy(to, reach->table->pocket[event->b].centre, sizeof to);
    r = reach->table->pocket[event->b].radius;
  } else {
    return;
  }
  const double x = to[0] - a->r[0], y = to[1] - a->r[1];
  const double v_x = a->v[0] - (two ? b->v[0] : 0.0), v_y = a->v[1] - (two ? b->v[1] : 0.0), V2 = v_x * v_x + v_y * v_y;
  const double s = (x * v_y - y * v_x) / sqrt(V2);
  for (int j = 0; j < m; j++) {
    const double dx = (two ? d[1][S_X][j] : 0.0) - d[0][S_X][j], dy = (two ? d[1][S_Y][j] : 0.0) - d[0][S_Y][j];
    const double dv_x = d[0][S_V_X][j] - (two ? d[1][S_V_X][j] : 0.0), dv_y = d[0][S_V_Y][j] - (two ? d[1][S_V_Y][j] : 0.0);
    const double ds = (dx * v_y - dy * v_x + x * dv_y - y * dv_x) / sqrt(V2) - s * (v_x * dv_x + v_y * dv_y) / V2;
    take(reach, j, r - fabs(s), ds);
  }
}
