/* How far tangents reach: the change, in the unit of a direction, at which to first order a
 * ball's own sequence of events changes. The least of
 *
 *     order     two successive events of a ball swap: (T2 - T1) / |dT2 - dT1|
 *     miss      a hit on a ball, a nose or a pocket becomes a miss: (r - |s|) / |ds|,
 *               s = d x v / |v| the distance at which the straight line along the relative
 *               velocity would pass the centre, r the sum of the radii
 *     hit       a miss becomes a hit: the least distance of the surfaces on the way over its
 *               derivative n . (d_b - d_a), also where a ball comes to rest short of something,
 *               or lands beside a pocket
 *     end       a ball on a rail comes to its end, where a jaw stands, or the other way round
 *     spin      a spin about the vertical ends before a contact, or lasts until it: the spin
 *               there over its derivative, at a fixed time of the contact
 *     hop       the last hop of a ball on the slate: its fall less the least one after which
 *               there is a hop
 *
 * In flight the tops of rails, the backs of pockets and the edge of the table do not count. */
#include "tangent/reach.h"
#include "shot/shot.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double NEAR = 0.2;      /* m: gaps beyond are not asked for; */
static const double TOUCHING = 2e-4; /* nor those up to this, of bodies that touched or nearly did
                                        as the way began */
enum { PARTS_OF_WAY = 6, BISECTIONS = 30 };

void carom_reach_go_on(carom_tangent_work *work, int i) {
  carom_tangent_ball *ball = &work->ball[i];
  const carom_ball_rates rates = carom_rates_of(ball->kind);
  carom_path path = {.from = ball->from};
  carom_path_begin(&path, &rates, ball->since);
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

/* The separation to a ball or part, quadratic in the time since `from`: d + v t + a t^2.
 * It may be a point, or the nearest point of a ring around it, at its height; or of a level
 * line, from which `across` points to the ball. */
typedef struct separation {
  double from, d[3], v[3], a[3];
  double ring;
  const double *across;
  bool centre; /* the distance of the ball's centre counts, and not that of its surface */
} separation;

/* The distance, the unit vector n along it, and its rate. */
typedef struct distance {
  double size, n[3], opens;
} distance;

static distance distance_at(const separation *s, double t) {
  double place[3], v[3];
  distance is = {0};
  for (int k = 0; k < 3; k++) {
    place[k] = s->d[k] + t * (s->v[k] + t * s->a[k]);
    v[k] = s->v[k] + 2.0 * t * s->a[k];
  }
  if (s->across != NULL) {
    const double level = s->across[0] * place[0] + s->across[1] * place[1];
    place[0] = level * s->across[0];
    place[1] = level * s->across[1];
  } else if (s->ring > 0.0) {
    const double q = sqrt(place[0] * place[0] + place[1] * place[1]), share = 1.0 - s->ring / q;
    place[0] *= share;
    place[1] *= share;
  }
  is.size = sqrt(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]);
  for (int k = 0; k < 3; k++) {
    is.n[k] = place[k] / is.size;
    is.opens += is.n[k] * v[k];
  }
  return is;
}

/* Whether a gap is one that a change may close. first: the gap where the way began. */
static bool is_missed(double gap, double first) {
  return gap > (first <= TOUCHING ? TOUCHING : 0.0) && gap < NEAR;
}

/* What the gap at a time is worth in each direction. other: the ball that is missed, or NULL.
 * surface: of the ball, and not its centre. */
__attribute__((noinline)) static void take_gap(carom_reach *reach, const carom_tangent_ball *ball,
                                               const carom_tangent_ball *other, double time,
                                               const double n[3], double gap, bool surface) {
  const carom_tangent_work *w = reach->work;
  const int m = w->pass.columns, radius = (int)(offsetof(carom_ball_kind, radius) / sizeof(double));
  carom_tangent_rows d;
  carom_tangent_row along;
  for (int side = 0; side < (other != NULL ? 2 : 1); side++) {
    const carom_tangent_ball *one = side == 0 ? ball : other;
    const int i = (int)(one - w->ball);
    const double *dR =
        w->seeds->kind != NULL
            ? w->seeds->kind + (i * CAROM_KIND_NUMBERS + radius) * w->pass.m + w->pass.first
            : NULL;
    carom_tangent_at(w, i, time, d);
    for (int j = 0; j < m; j++) {
      const double moves = n[0] * d[S_X][j] + n[1] * d[S_Y][j] + n[2] * d[S_Z][j];
      along[j] = side == 0 ? -moves : along[j] + moves;
      along[j] -= surface && dR != NULL ? dR[j] : 0.0;
    }
  }
  for (int j = 0; j < m; j++)
    take(reach, j, gap, along[j]);
}

/* The least distances on the way from t = 0 to T; stops: the end of the way counts as one. rail:
 * between whose ends they count, or NULL. */
static void search(carom_reach *reach, const carom_tangent_ball *ball,
                   const carom_tangent_ball *other, const separation *s, double T, double reaches,
                   bool stops, const carom_rail *rail) {
  /* nothing is missed that is too far for the whole way */
  double way = 0.0;
  for (int k = 0; k < 3; k++)
    way += T * (fabs(s->v[k]) + T * fabs(s->a[k]));
  const distance first = distance_at(s, 0.0);
  if (!(T > 0.0) || first.size - way > reaches + NEAR)
    return;
  double before = first.opens;
  for (int k = 1; k <= PARTS_OF_WAY; k++) {
    double low = T * (k - 1) / (double)PARTS_OF_WAY, high = T * k / (double)PARTS_OF_WAY;
    /* a part of the way at whose end the distance grows has a least one within */
    const double now = distance_at(s, high).opens;
    const bool least = before < 0.0 && now >= 0.0,
               end = stops && k == PARTS_OF_WAY && before < 0.0 && !least;
    before = now;
    if (!least && !end)
      continue;
    for (int n = 0; n < BISECTIONS && least; n++) {
      const double middle = 0.5 * (low + high);
      *(distance_at(s, middle).opens < 0.0 ? &low : &high) = middle;
    }

    /* what the gap there is worth */
    const distance there = distance_at(s, high);
    const double gap = there.size - reaches;
    if (!is_missed(gap, first.size - reaches))
      continue;
    if (rail != NULL) { /* d points to p */
      const double e_x = rail->q[0] - rail->p[0], e_y = rail->q[1] - rail->p[1];
      const double x = s->d[0] + high * (s->v[0] + high * s->a[0]),
                   y = s->d[1] + high * (s->v[1] + high * s->a[1]);
      const double along = -(x * e_x + y * e_y) / (e_x * e_x + e_y * e_y);
      if (!(along >= 0.0 && along <= 1.0))
        continue;
    }
    take_gap(reach, ball, other, s->from + high, there.n, gap, !s->centre);
  }
}

/* Place, velocity and half the acceleration of a ball at a time; on the cloth, at the height of
 * its radius. */
static void motion_at(const carom_tangent_ball *ball, double time, double r[3], double v[3],
                      double a[3]) {
  const double tau = time - ball->since;
  const bool moves = carom_translates(ball->from.label);
  for (int k = 0; k < 3; k++) {
    r[k] = ball->from.r[k] + (moves ? tau * (ball->from.v[k] + tau * ball->a[k]) : 0.0);
    v[k] = moves ? ball->from.v[k] + 2.0 * tau * ball->a[k] : 0.0;
    a[k] = moves ? ball->a[k] : 0.0;
  }
  if (!carom_flies(&ball->from))
    r[2] = ball->kind->radius;
}

/* From a ball to another one, or to a point, whose height is that of the ball if it is not a
 * number. */
static separation between(const carom_tangent_ball *ball, const carom_tangent_ball *other,
                          const double *point, double height, double from) {
  separation s = {.from = from};
  double r[2][3], v[2][3] = {{0}}, a[2][3] = {{0}};
  motion_at(ball, from, r[0], v[0], a[0]);
  if (other != NULL) {
    motion_at(other, from, r[1], v[1], a[1]);
  } else {
    memcpy(r[1], point, 2 * sizeof *point);
    r[1][2] = isnan(height) ? r[0][2] : height;
  }
  for (int k = 0; k < 3; k++) {
    s.d[k] = r[1][k] - r[0][k];
    s.v[k] = v[1][k] - v[0][k];
    s.a[k] = a[1][k] - a[0][k];
  }
  return s;
}

/* The noses that a flying ball missed. */
static void noses_missed(carom_reach *reach, const carom_tangent_ball *ball,
                         const carom_event *event) {
  const carom_table *table = reach->work->table;
  const double start = ball->since, R = ball->kind->radius, ref = reach->work->reference;
  for (int64_t k = 0; k < table->rails; k++) {
    if (event->type == CAROM_EVENT_RAIL && event->b == k)
      continue;
    const carom_rail *rail = &table->rail[k];
    const double h = carom_nose_height(ball->kind, rail->height), shift = carom_nose_shift(h, ref);
    double line[3];
    carom_rail_line(rail, line);
    const double p[2] = {rail->p[0] + shift * line[0], rail->p[1] + shift * line[1]};
    separation s = between(ball, NULL, p, h, start);
    s.across = line;
    search(reach, ball, NULL, &s, event->time - start, R, false, rail);
  }
  for (int64_t k = 0; k < table->jaws; k++) {
    if (event->type == CAROM_EVENT_JAW && event->b == k)
      continue;
    const carom_jaw *jaw = &table->jaw[k];
    const double h = carom_nose_height(ball->kind, jaw->height);
    separation s = between(ball, NULL, jaw->centre, h, start);
    s.ring = jaw->radius + carom_nose_shift(h, ref);
    search(reach, ball, NULL, &s, event->time - start, R, false, NULL);
  }
}

/* The cushions and pockets that a ball on the cloth missed; stops: it came to rest. */
static void cushions_missed(carom_reach *reach, const carom_tangent_ball *ball,
                            const carom_event *event, bool stops) {
  const carom_table *table = reach->work->table;
  const double start = ball->since, T = event->time - start;
  for (int64_t k = 0; k < table->jaws; k++) {
    const separation s = between(ball, NULL, table->jaw[k].centre, NAN, start);
    const double R = carom_reach_on_cloth(ball->kind, table->jaw[k].height, reach->work->reference);
    if (event->type != CAROM_EVENT_JAW || event->b != k)
      search(reach, ball, NULL, &s, T, table->jaw[k].radius + R, stops, NULL);
  }
  for (int64_t k = 0; k < table->pockets; k++) {
    separation s = between(ball, NULL, table->pocket[k].centre, NAN, start);
    s.centre = true;
    if (event->type != CAROM_EVENT_POCKET || event->b != k)
      search(reach, ball, NULL, &s, T, table->pocket[k].radius, stops, NULL);
  }
  /* rails, which a ball misses only where it stops short of them */
  for (int64_t k = 0; stops && k < table->rails; k++) {
    double line[3];
    carom_rail_line(&table->rail[k], line);
    const double *r = event->before[0].r,
                 R = carom_reach_on_cloth(ball->kind, table->rail[k].height,
                                          reach->work->reference);
    const double gap = line[0] * r[0] + line[1] * r[1] + line[2] - R,
                 n[3] = {-line[0], -line[1], 0.0};
    const double *from = ball->from.r, first = line[0] * from[0] + line[1] * from[1] + line[2] - R;
    if (is_missed(gap, first))
      take_gap(reach, ball, NULL, event->time, n, gap, true);
  }
}

/* Whether the spin of a ball on the cloth lasts until a contact. Of one that spins not, a change
 * of either sign makes one. */
static void spin_of(carom_reach *reach, int i, const carom_event *event) {
  const carom_tangent_work *w = reach->work;
  const carom_tangent_ball *ball = &w->ball[i];
  if (!carom_translates(ball->from.label) || carom_flies(&ball->from))
    return;
  const double lost = carom_rates_of(ball->kind).spin * (event->time - ball->since);
  const double *d =
      carom_tangent_columns(&w->pass, w->tangent->final, i * CAROM_STATE_NUMBERS + S_W_Z);
  for (int j = 0; j < w->pass.columns && lost > 0.0; j++)
    take(reach, j, fabs(fabs(ball->from.w[2]) - lost), d[j]);
}

/* The misses of ball i on its path, up to the event; `with` is the part or ball that it met. */
static void misses_of(carom_reach *reach, int i, const carom_event *event) {
  const carom_tangent_work *w = reach->work;
  const carom_tangent_ball *ball = &w->ball[i];
  const bool stops =
      event->type == CAROM_EVENT_ROLLING_SPINNING || event->type == CAROM_EVENT_ROLLING_STATIONARY;
  const bool moves = carom_translates(ball->from.label);
  for (int q = 0; q < w->count; q++) {
    const carom_tangent_ball *other = &w->ball[q];
    const bool met = event->type == CAROM_EVENT_BALL_BALL && (q == event->a || q == event->b);
    if (q == i || met || carom_is_out(other->from.label) ||
        !(moves || carom_translates(other->from.label)))
      continue;
    const double from = fmax(ball->since, other->since);
    const separation s = between(ball, other, NULL, NAN, from);
    search(reach, ball, other, &s, event->time - from, ball->kind->radius + other->kind->radius,
           stops, NULL);
  }
  if (carom_flies(&ball->from))
    noses_missed(reach, ball, event);
  else if (moves)
    cushions_missed(reach, ball, event, stops);
}

void carom_reach_misses(carom_reach *reach, const carom_event *event) {
  const bool two = event->type == CAROM_EVENT_BALL_BALL;
  for (int side = 0; side <= two; side++) {
    misses_of(reach, side == 0 ? event->a : event->b, event);
    if (two || event->type == CAROM_EVENT_RAIL || event->type == CAROM_EVENT_JAW)
      spin_of(reach, side == 0 ? event->a : event->b, event);
  }
}

/* A hit on a body that is d away and comes nearer by v, with their tangents in one direction; r:
 * the sum of the radii, 0 for no hit. */
typedef struct hit {
  double d[3], v[3], dd[3], dv[3], r;
} hit;

/* That it would be a miss: r - s, s = |d x v|/|v|. */
static void take_hit(carom_reach *reach, int j, const hit *h) {
  /* the part of d across v */
  double V2 = 0.0, along = 0.0, across[3], s = 0.0, ds = 0.0;
  for (int k = 0; k < 3; k++) {
    V2 += h->v[k] * h->v[k];
    along += h->d[k] * h->v[k];
  }
  for (int k = 0; k < 3; k++) {
    across[k] = h->d[k] - along / V2 * h->v[k];
    s += across[k] * across[k];
    ds += across[k] * (h->dd[k] - along / V2 * h->dv[k]);
  }
  s = sqrt(s);
  if (s > 0.0)
    take(reach, j, h->r - s, ds / s);
}

/* The hit of an event, with tangents t. On a nose in flight it is one in the plane across that:
 * level and up. */
static hit hit_of(const carom_reach *reach, const carom_event *event, carom_tangent_rows *t,
                  int j) {
  static const int X[3] = {S_X, S_Y, S_Z}, V[3] = {S_V_X, S_V_Y, S_V_Z};
  const carom_tangent_work *w = reach->work;
  const carom_table *table = w->table;
  const carom_ball_kind *kind = w->ball[event->a].kind;
  const carom_ball_state *a = &event->before[0], *b = &event->before[1];
  const bool two = event->type == CAROM_EVENT_BALL_BALL, is_jaw = event->type == CAROM_EVENT_JAW;
  const bool in_flight = carom_flies(a),
             at_nose = in_flight && (is_jaw || event->type == CAROM_EVENT_RAIL);
  hit h = {.r = 0.0};
  double to[2];

  /* where the other body's centre is, and the sum of the radii */
  if (two) {
    memcpy(to, b->r, sizeof to);
    h.r = kind->radius + w->ball[event->b].kind->radius;
    h.d[2] = (carom_flies(b) ? b->r[2] : w->ball[event->b].kind->radius) -
             (in_flight ? a->r[2] : kind->radius);
  } else if (is_jaw) {
    const carom_jaw *jaw = &table->jaw[event->b];
    memcpy(to, jaw->centre, sizeof to);
    h.r = jaw->radius + carom_reach_on_cloth(kind, jaw->height, w->reference);
  } else if (event->type == CAROM_EVENT_POCKET && !in_flight) {
    memcpy(to, table->pocket[event->b].centre, sizeof to);
    h.r = table->pocket[event->b].radius;
  } else if (at_nose) {
    memcpy(to, table->rail[event->b].p, sizeof to);
  } else {
    return h;
  }

  /* from the ball to the body, and how it comes nearer, with their tangents */
  for (int k = 0; k < (two || at_nose ? 3 : 2); k++) {
    h.d[k] = k < 2 ? to[k] - a->r[k] : h.d[k];
    h.v[k] = a->v[k] - (two ? b->v[k] : 0.0);
    h.dd[k] = (two ? t[1][X[k]][j] : 0.0) - t[0][X[k]][j];
    h.dv[k] = t[0][V[k]][j] - (two ? t[1][V[k]][j] : 0.0);
  }
  if (!at_nose)
    return h;

  /* along the vector from the nose to the ball, which takes the place of x */
  const double height =
      carom_nose_height(kind, is_jaw ? table->jaw[event->b].height : table->rail[event->b].height);
  const double q = sqrt(h.d[0] * h.d[0] + h.d[1] * h.d[1]);
  double out[3] = {-h.d[0] / q, -h.d[1] / q, 0.0};
  if (!is_jaw)
    carom_rail_line(&table->rail[event->b], out);

  /* the nose is inside the wall; level parts are along that vector from here on */
  const double beyond =
      (is_jaw ? table->jaw[event->b].radius : 0.0) + carom_nose_shift(height, w->reference);
  double *const level[4] = {h.d, h.v, h.dd, h.dv};
  for (int n = 0; n < 4; n++) {
    level[n][0] = out[0] * level[n][0] + out[1] * level[n][1];
    level[n][1] = 0.0;
  }
  h.d[0] += beyond;
  h.d[2] = height - a->r[2];
  h.r = kind->radius;
  return h;
}

/* Whether a jaw rounds an end of a rail. */
static bool rounds(const carom_jaw *jaw, const double end[2]) {
  const double x = jaw->centre[0] - end[0], y = jaw->centre[1] - end[1],
               off = sqrt(x * x + y * y) - jaw->radius;
  return fabs(off) < 1e-4;
}

/* The rails beside an event. A ball that meets a rail beyond its end meets the jaw there
 * instead, one that meets a jaw beyond the end of its rail the rail; and one that falls into a
 * pocket, or meets a jaw, may come to a rail before. */
static void take_rails(carom_reach *reach, const carom_event *event, carom_tangent_rows d) {
  const carom_tangent_work *w = reach->work;
  const carom_ball_state *s = &event->before[0];
  const carom_jaw *jaw = event->type == CAROM_EVENT_JAW ? &w->table->jaw[event->b] : NULL;
  for (int64_t k = 0; k < w->table->rails; k++) {
    const carom_rail *rail = &w->table->rail[k];
    const double e[2] = {rail->q[0] - rail->p[0], rail->q[1] - rail->p[1]},
                 length = sqrt(e[0] * e[0] + e[1] * e[1]);
    const double x = s->r[0] - rail->p[0], y = s->r[1] - rail->p[1],
                 place = (e[0] * x + e[1] * y) / length;
    const double beyond = carom_greater(-place, place - length);
    double line[3];
    carom_rail_line(rail, line);
    const double reaches = carom_reach_on_cloth(w->ball[event->a].kind, rail->height, w->reference);
    const double gap = line[0] * s->r[0] + line[1] * s->r[1] + line[2] - reaches;
    const bool meets = event->type == CAROM_EVENT_RAIL && event->b == k;
    const bool at_end =
        meets || (jaw != NULL && beyond > 0.0 && rounds(jaw, place < 0.0 ? rail->p : rail->q));
    const bool before = event->type != CAROM_EVENT_RAIL && beyond <= 0.0 && gap > 0.0 && gap < NEAR;
    for (int j = 0; j < w->pass.columns && (at_end || before); j++)
      take(reach, j, at_end ? fabs(beyond) : gap,
           at_end ? (e[0] * d[S_X][j] + e[1] * d[S_Y][j]) / length
                  : line[0] * d[S_X][j] + line[1] * d[S_Y][j]);
  }
}

/* A landing: beside a pocket, and whether it is the last. */
static void take_landing(carom_reach *reach, const carom_event *event, carom_tangent_rows d) {
  const carom_tangent_work *w = reach->work;
  const carom_ball_state *s = &event->before[0];
  const double e = carom_slate_restitution(w->ball[event->a].kind->restitution_table);
  /* the least fall after which the ball hops */
  double low = 0.0, high = e > 0.0 ? 1.0 / e : 0.0;
  for (int k = 0; k < BISECTIONS && e > 0.0; k++) {
    const double middle = 0.5 * (low + high);
    *(carom_rebound(middle, e) > 0.0 ? &high : &low) = middle;
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

void carom_reach_event(carom_reach *reach, int64_t k, const carom_event *event) {
  carom_tangent_work *w = reach->work;
  carom_tangent_rows *d = w->before;
  const int m = w->pass.columns;
  const bool two = event->type == CAROM_EVENT_BALL_BALL;

  /* the order of the events of each ball */
  for (int side = 0; side <= two; side++) {
    const int i = side == 0 ? event->a : event->b;
    const int64_t last = reach->last_event[i];
    /* a ball that is pressed into the slate lands at once, and one that lies on a rail is off
     * the table, whatever changes */
    const bool at_once =
        (event->type == CAROM_EVENT_SLATE || event->type == CAROM_EVENT_LEFT_TABLE) && last >= 0 &&
        event->time <= reach->last_time[i];
    const double *before =
        last >= 0 ? carom_tangent_columns(&w->pass, w->tangent->time, last) : NULL;
    for (int j = 0; j < m && last >= 0 && !at_once; j++)
      take(reach, j, event->time - reach->last_time[i], w->time[j] - before[j]);
    reach->last_event[i] = k;
    reach->last_time[i] = event->time;
  }
  if (event->type == CAROM_EVENT_SLATE)
    take_landing(reach, event, d[0]);
  const bool on_cloth = !carom_flies(&event->before[0]);
  if (event->type == CAROM_EVENT_RAIL || event->type == CAROM_EVENT_JAW ||
      (event->type == CAROM_EVENT_POCKET && on_cloth))
    take_rails(reach, event, d[0]);

  /* of a cluster the contact that starts it */
  for (int j = 0; j < m && !w->inner; j++) {
    const hit h = hit_of(reach, event, d, j);
    if (h.r > 0.0)
      take_hit(reach, j, &h);
  }
}
