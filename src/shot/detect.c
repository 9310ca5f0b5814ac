/* Looking for the next meeting of a ball: with rails, jaws and pockets, then with other balls.
 *
 * A ball's horizon is the earlier of the end of its phase and its meeting with the table: it has
 * another path after that at the latest, and is looked at again. So pairs are searched up to the
 * nearer of two horizons only. Most things are rejected without solving: features of the table
 * by boxes; pairs along the line of centres, where n . d(t) > R_i + R_j on the whole way, n =
 * d(0)/|d(0)|. */
#include "motion/gap.h"
#include "shot/rules.h"

#include <math.h>

/* A path seen from now on: r + v t + a t^2. */
typedef struct line_of_motion {
  double r[2], v[2], a[2];
} motion;

static motion motion_now(const carom_sim *sim, int i) {
  const double t = sim->now - sim->start[i];
  return (motion){{sim->x[i] + t * (sim->v_x[i] + t * sim->a_x[i]),
                   sim->y[i] + t * (sim->v_y[i] + t * sim->a_y[i])},
                  {sim->v_x[i] + 2.0 * t * sim->a_x[i], sim->v_y[i] + 2.0 * t * sim->a_y[i]},
                  {sim->a_x[i], sim->a_y[i]}};
}

/* The range of one coordinate on [0, T]. */
static void range_of(double r, double v, double a, double T, double *low, double *high) {
  const double end = r + T * (v + T * a);
  *low = carom_lesser(r, end);
  *high = carom_greater(r, end);
  const double turn = -v / (2.0 * a);
  if (turn > 0.0 && turn < T) {
    const double there = r + 0.5 * turn * v;
    *low = carom_lesser(*low, there);
    *high = carom_greater(*high, there);
  }
}

static double place(const double line[3], const motion *m, double t) {
  return line[0] * (m->r[0] + t * (m->v[0] + t * m->a[0])) +
         line[1] * (m->r[1] + t * (m->v[1] + t * m->a[1])) + line[2];
}

/* When the ball touches rail k, at `reach` from its line, up to T; or infinity. */
static double meet_rail(const carom_sim *sim, int k, double reach, const motion *m, double T) {
  const double *n = sim->features->line[k], *along = sim->features->along[k];
  const double g[3] = {n[0] * m->r[0] + n[1] * m->r[1] + n[2] - reach,
                       n[0] * m->v[0] + n[1] * m->v[1], n[0] * m->a[0] + n[1] * m->a[1]};
  double times[2];
  const int count = sim->rules->touch_rail(g, T, times);
  for (int z = 0; z < count; z++) {
    const double s = place(along, m, times[z]);
    if (s >= 0.0 && s <= 1.0)
      return times[z];
  }
  return INFINITY;
}

static carom_separation from_point(const double centre[2], const motion *m) {
  return (carom_separation){{m->r[0] - centre[0], m->r[1] - centre[1], 0.0},
                            {m->v[0], m->v[1], 0.0},
                            {m->a[0], m->a[1], 0.0}};
}

/* Whether n . d(t) > reach on [0, T]: see above. */
static bool stays_away(const carom_separation *d, double reach, double T) {
  const double c0 = d->d0[0] * d->d0[0] + d->d0[1] * d->d0[1], l = sqrt(c0);
  const double h0 = c0 - reach * l, h1 = d->d0[0] * d->d1[0] + d->d0[1] * d->d1[1],
               h2 = d->d0[0] * d->d2[0] + d->d0[1] * d->d2[1];
  const double turn = h2 > 0.0 ? carom_lesser(carom_greater(-h1 / (2.0 * h2), 0.0), T) : T;
  return h0 > 1e-12 * reach * reach && h0 + T * (h1 + T * h2) > 0.0 &&
         h0 + turn * (h1 + turn * h2) > 0.0;
}

static double meet_jaw(const carom_sim *sim, int k, double radius, const motion *m, double T) {
  const carom_jaw *jaw = &sim->table->jaw[k];
  const carom_separation d = from_point(jaw->centre, m);
  const double reach = jaw->radius + radius;
  if (stays_away(&d, reach, T))
    return INFINITY;
  return sim->rules->touch_jaw(&d, reach, T);
}

static double meet_pocket(const carom_sim *sim, int k, const motion *m, double T) {
  const carom_pocket *pocket = &sim->table->pocket[k];
  const carom_separation d = from_point(pocket->centre, m);
  return stays_away(&d, pocket->radius, T) ? INFINITY
                                           : sim->rules->enter_pocket(&d, pocket->radius, T);
}

/* When the centre leaves the hull, up to T; or infinity. */
static double leave_hull(const carom_features *f, const motion *m, double T) {
  double first = INFINITY;
  for (int k = 0; k < 2; k++) {
    const double low[3] = {m->r[k] - f->hull[2 * k], m->v[k], m->a[k]},
                 high[3] = {f->hull[2 * k + 1] - m->r[k], -m->v[k], -m->a[k]};
    first = carom_lesser(
        first, carom_lesser(carom_first_touch(low, 0.0, T), carom_first_touch(high, 0.0, T)));
  }
  return first;
}

/* `unlike`, a constant: whether noses and jaws are reached at distances of their own, nose.c. */
static inline __attribute__((always_inline)) carom_meeting
meet_table_as(const carom_sim *sim, int i, const motion *m, double T, const bool unlike) {
  const carom_features *f = sim->features;
  carom_meeting first = {INFINITY, 0, 0};
  /* the box of the path; a path that leads out of the hull ends there */
  double low_x, high_x, low_y, high_y;
  range_of(m->r[0], m->v[0], m->a[0], T, &low_x, &high_x);
  range_of(m->r[1], m->v[1], m->a[1], T, &low_y, &high_y);
  if (low_x < f->hull[0] || high_x > f->hull[1] || low_y < f->hull[2] || high_y > f->hull[3]) {
    first.time = leave_hull(f, m, T);
    T = carom_lesser(T, first.time);
    range_of(m->r[0], m->v[0], m->a[0], T, &low_x, &high_x);
    range_of(m->r[1], m->v[1], m->a[1], T, &low_y, &high_y);
  }
  const float lx = (float)low_x, hx = (float)high_x, ly = (float)low_y, hy = (float)high_y;
  uint8_t near[MOST_FEATURES];
  for (int k = 0; k < f->count; k++)
    near[k] =
        (f->low_x[k] <= hx) & (f->high_x[k] >= lx) & (f->low_y[k] <= hy) & (f->high_y[k] >= ly);
  const double radius = sim->rates[i].radius;
  /* each narrows the horizon of those behind it; a pocket goes first where it comes at the same
   * time */
  for (int k = 0; k < f->count; k++) {
    if (!near[k])
      continue;
    const int jaw = k - f->rails, pocket = jaw - f->jaws;
    const int type = jaw < 0 ? CAROM_EVENT_RAIL : pocket < 0 ? CAROM_EVENT_JAW : CAROM_EVENT_POCKET;
    /* how far from the line of a rail, or beyond the circle of a jaw, the ball touches it */
    double reach = radius;
    if (unlike && pocket < 0)
      reach = carom_reach_on_cloth(
          &sim->ball[i].kind, jaw < 0 ? sim->table->rail[k].height : sim->table->jaw[jaw].height,
          f->reference);
    const double t = jaw < 0      ? meet_rail(sim, k, reach, m, T)
                     : pocket < 0 ? meet_jaw(sim, jaw, reach, m, T)
                                  : meet_pocket(sim, pocket, m, T);
    if (t < first.time ||
        (t <= first.time && (first.type == 0 || type == CAROM_EVENT_POCKET) && t <= T)) {
      first = (carom_meeting){t, type, jaw < 0 ? k : pocket < 0 ? jaw : pocket};
      T = t;
    }
  }
  return first;
}

__attribute__((noinline, cold)) static carom_meeting meet_table_unlike(const carom_sim *sim, int i,
                                                                       const motion *m, double T) {
  return meet_table_as(sim, i, m, T, true);
}
static carom_meeting meet_table(const carom_sim *sim, int i, const motion *m, double T) {
  return sim->unlike ? meet_table_unlike(sim, i, m, T) : meet_table_as(sim, i, m, T, false);
}

/* When balls i and j meet; their separation is d from now on. */
static inline double meet_ball(const carom_sim *sim, const carom_separation *d, double reach,
                               double T, bool space) {
  return space ? carom_first_contact_in_space(d, reach, T) : sim->rules->touch_ball(d, reach, T);
}

/* Pairs of ball i with all others: rejected in one loop that compilers turn into vectors, then
 * solved. `space`, a constant: with the third coordinate and each ball's own radius. Two balls
 * on the cloth have the same result with it as without. */
static inline __attribute__((always_inline)) void meet_balls_as(carom_sim *sim, int i,
                                                                const bool space) {
  const motion m = motion_now(sim, i);
  const int n = sim->count;
  const double now = sim->now, radius = sim->rates[i].radius, twice = 2.0 * radius,
               horizon = sim->horizon[i] - now;
  const double own = now - sim->start[i],
               own_z = space ? sim->z[i] + own * (sim->v_z[i] + own * sim->a_z[i]) : 0.0,
               own_v = space ? sim->v_z[i] + 2.0 * own * sim->a_z[i] : 0.0;
  double d_x[CAROM_BALLS_MOST], d_y[CAROM_BALLS_MOST], e_x[CAROM_BALLS_MOST], e_y[CAROM_BALLS_MOST];
  double d_z[CAROM_BALLS_MOST], e_z[CAROM_BALLS_MOST], reach[CAROM_BALLS_MOST];
  double least[CAROM_BALLS_MOST], until[CAROM_BALLS_MOST];
  for (int j = 0; j < n; j++) {
    const double t = now - sim->start[j];
    d_x[j] = sim->x[j] + t * (sim->v_x[j] + t * sim->a_x[j]) - m.r[0];
    d_y[j] = sim->y[j] + t * (sim->v_y[j] + t * sim->a_y[j]) - m.r[1];
    e_x[j] = sim->v_x[j] + 2.0 * t * sim->a_x[j] - m.v[0];
    e_y[j] = sim->v_y[j] + 2.0 * t * sim->a_y[j] - m.v[1];
    const double a_x = sim->a_x[j] - m.a[0], a_y = sim->a_y[j] - m.a[1];
    const double T0 = sim->horizon[j] - now, T = T0 < horizon ? T0 : horizon;
    double c0 = d_x[j] * d_x[j] + d_y[j] * d_y[j];
    double h1 = d_x[j] * e_x[j] + d_y[j] * e_y[j], h2 = d_x[j] * a_x + d_y[j] * a_y;
    if (space) {
      reach[j] = radius + sim->rates[j].radius;
      d_z[j] = sim->z[j] + t * (sim->v_z[j] + t * sim->a_z[j]) - own_z;
      e_z[j] = sim->v_z[j] + 2.0 * t * sim->a_z[j] - own_v;
      c0 += d_z[j] * d_z[j];
      h1 += d_z[j] * e_z[j];
      h2 += d_z[j] * (sim->a_z[j] - sim->a_z[i]);
    }
    const double h0 = c0 - (space ? reach[j] : twice) * sqrt(c0);
    /* the least of h0 + h1 t + h2 t^2 on [0, T]; where the turning point is a maximum, its value
     * does no harm */
    double turn = -h1 / (2.0 * h2);
    turn = turn > 0.0 ? turn : 0.0;
    turn = turn < T ? turn : T;
    const double end = h0 + T * (h1 + T * h2), middle = h0 + turn * (h1 + turn * h2);
    const double low = end < middle ? end : middle;
    least[j] = low < h0 ? low : h0;
    until[j] = T;
  }
  for (int j = 0; j < n; j++) {
    if (j == i)
      continue;
    double t = INFINITY;
    const double both = space ? reach[j] : twice, touching = 1e-11 * both * both;
    if (until[j] >= 0.0 && until[j] < INFINITY && !(least[j] > touching)) {
      const carom_separation d = {
          {d_x[j], d_y[j], space ? d_z[j] : 0.0},
          {e_x[j], e_y[j], space ? e_z[j] : 0.0},
          {sim->a_x[j] - m.a[0], sim->a_y[j] - m.a[1], space ? sim->a_z[j] - sim->a_z[i] : 0.0}};
      t = now + meet_ball(sim, &d, both, until[j], space);
    }
    const int low = i < j ? i : j, high = i < j ? j : i;
    sim->pair[low][high] = t;
    sim->pair_round[low][high] = (int32_t)sim->round;
  }
}

static __attribute__((noinline)) void meet_balls_in_space(carom_sim *sim, int i) {
  meet_balls_as(sim, i, true);
}
static void meet_balls(carom_sim *sim, int i) {
  if (carom_in_space(sim))
    meet_balls_in_space(sim, i);
  else
    meet_balls_as(sim, i, false);
}

/* The first of row i again. */
static void scan_row(carom_sim *sim, int i) {
  double first = INFINITY;
  int with = 0;
  for (int j = i + 1; j < sim->count; j++)
    if (sim->pair[i][j] < first) {
      first = sim->pair[i][j];
      with = j;
    }
  sim->first[i] = first;
  sim->first_with[i] = (int8_t)with;
}

/* Column i of the pairs has changed: the firsts of the rows above. */
static void update_rows(carom_sim *sim, int i) {
  for (int k = 0; k < i; k++) {
    if (sim->pair[k][i] < sim->first[k]) {
      sim->first[k] = sim->pair[k][i];
      sim->first_with[k] = (int8_t)i;
    } else if (sim->first_with[k] == i) {
      scan_row(sim, k);
    }
  }
}

/* The third column, which changes where a ball takes off or lands. A ball on the cloth is at z =
 * R exactly, though a layout may be 1e-6 m off. */
__attribute__((noinline, cold)) static void take_height(carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  const bool flies = carom_flies(&path->from);
  sim->flying += flies - (sim->a_z[i] != 0.0);
  sim->z[i] = flies ? path->from.r[2] : sim->rates[i].radius;
  sim->v_z[i] = flies ? path->from.v[2] : 0.0;
  sim->a_z[i] = path->a[2];
}

__attribute__((noinline, cold)) static carom_meeting meet_in_flight(carom_sim *sim, int i) {
  carom_ball_state s;
  carom_path_at(&sim->path[i], &sim->rates[i], sim->now, &s);
  return carom_meet_in_flight(sim, i, s.r, s.v, sim->path[i].end - sim->now);
}

/* Puts the path of ball i into the columns, and looks for its next meeting with the table. */
static void take_path(carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  const bool translates = carom_translates(path->from.label);
  sim->start[i] = path->start;
  sim->x[i] = path->from.r[0];
  sim->y[i] = path->from.r[1];
  sim->v_x[i] = translates ? path->from.v[0] : 0.0;
  sim->v_y[i] = translates ? path->from.v[1] : 0.0;
  sim->a_x[i] = path->a[0];
  sim->a_y[i] = path->a[1];
  if (path->a[2] != 0.0 || sim->a_z[i] != 0.0)
    take_height(sim, i);
  sim->meeting[i] = (carom_meeting){INFINITY, 0, 0};
  sim->meeting_round[i] = (int32_t)sim->round;
  sim->own[i] = path->end;
  /* a ball that stays where it is does so for any time, and one that is out of play meets
   * nothing */
  sim->horizon[i] = carom_is_out(path->from.label) ? -INFINITY : INFINITY;
  if (!translates)
    return;
  if (carom_flies(&path->from)) {
    sim->meeting[i] = meet_in_flight(sim, i);
  } else {
    const motion m = motion_now(sim, i);
    sim->meeting[i] = meet_table(sim, i, &m, path->end - sim->now);
  }
  sim->meeting[i].time += sim->now;
  sim->own[i] = sim->horizon[i] = carom_lesser(path->end, sim->meeting[i].time);
}

void carom_detect(carom_sim *sim, int i, int j) {
  take_path(sim, i);
  if (j >= 0)
    take_path(sim, j);
  meet_balls(sim, i);
  if (j >= 0)
    meet_balls(sim, j);
  scan_row(sim, i);
  update_rows(sim, i);
  if (j >= 0) {
    scan_row(sim, j);
    update_rows(sim, j);
  }
}

void carom_detect_all(carom_sim *sim) {
  const int n = sim->count;
  sim->flying = 0;
  for (int i = 0; i < n; i++) { /* as of balls on the cloth */
    sim->z[i] = sim->rates[i].radius;
    sim->v_z[i] = sim->a_z[i] = 0.0;
  }
  for (int i = 0; i < n; i++) {
    take_path(sim, i);
    for (int j = i + 1; j < n; j++) {
      sim->pair[i][j] = INFINITY;
      sim->pair_round[i][j] = 0;
    }
  }
  for (int i = 0; i < n; i++)
    if (carom_translates(sim->path[i].from.label))
      meet_balls(sim, i);
  for (int i = 0; i < n; i++)
    scan_row(sim, i);
}
