/* Looking for the next meeting of a ball: with rails, jaws and pockets, then with other balls.
 *
 * A ball's horizon is the earlier of the end of its phase and its meeting with the table: it has
 * another path after that at the latest, and is looked at again. So pairs are searched up to the
 * nearer of two horizons only. Most things are rejected without solving: features of the table
 * by boxes, then all by their chords.
 *
 * CHORD. On [0, T] the separation d = p + e t + a t^2 has the chord T c, c = e + T a, and differs
 * from it by -a t (T - t), which is a T^2/4 at most. So it stays farther from the origin than
 *
 *   (|p x c| - |a x e| T^2/4) / |c|               across the chord, and along it
 *   (p . c - |a . c| T^2/4) / |c|                 where it leads away, or
 *   (-(p + T c) . c - |a . c| T^2/4) / |c|        where it ends before it comes near. */
#include "motion/gap.h"
#include "platform/promise.h"
#include "shot/rules.h"

#include <math.h>

_Static_assert((int)CAROM_COLUMN == (int)CAROM_BALLS_MOST, "a column has a place for each ball");

/* A path seen from now on: r + v t + a t^2. */
typedef struct line_of_motion {
  double r[2], v[2], a[2];
} motion;

static motion motion_now(const carom_sim *sim, int i) {
  const double t = sim->time - sim->start[i];
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
    const double vertex = r + 0.5 * turn * v;
    *low = carom_lesser(*low, vertex);
    *high = carom_greater(*high, vertex);
  }
}

static double place(const double line[3], const motion *m, double t) {
  return line[0] * (m->r[0] + t * (m->v[0] + t * m->a[0])) +
         line[1] * (m->r[1] + t * (m->v[1] + t * m->a[1])) + line[2];
}

/* When the ball touches rail k, at `reach` from its line, up to T; or infinity. */
static double meet_rail(const carom_sim *sim, int k, double reach, const motion *m, double T) {
  const double *n = sim->features->line[k], *along = sim->features->along[k];
  const double g[3] = {carom_plane_dot(n, m->r) + n[2] - reach, carom_plane_dot(n, m->v),
                       carom_plane_dot(n, m->a)};
  double times[2];
  const int count = sim->rules->touch_rail(g, T, times);
  CAROM_PROMISE(count >= 0 && count <= 2);
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

/* Positive where a path p + e t + a t^2 surely stays farther from the origin than `reach` on [0,
 * T]: see CHORD. In squares, times |c|^2; a part in 1e9 of reach^2 is for rounding. */
static inline double clearance(const double p[2], const double e[2], const double a[2],
                               double reach, double T) {
  const double c_x = e[0] + T * a[0], c_y = e[1] + T * a[1], square = c_x * c_x + c_y * c_y;
  const double quarter = 0.25 * T * T, along = p[0] * c_x + p[1] * c_y;
  const double bulge = quarter * fabs(a[0] * c_x + a[1] * c_y);
  const double ahead = -along - T * square;
  const double off = fabs(p[0] * c_y - p[1] * c_x) - quarter * fabs(a[0] * e[1] - a[1] * e[0]);
  const double gap = (along > ahead ? along : ahead) - bulge, most = off > gap ? off : gap;
  return most * fabs(most) - (1.0 + 1e-9) * reach * reach * square;
}

static double meet_jaw(const carom_sim *sim, int k, double radius, const motion *m, double T) {
  const carom_jaw *jaw = &sim->table->jaw[k];
  const carom_separation d = from_point(jaw->centre, m);
  const double reach = jaw->radius + radius;
  return clearance(d.d0, d.d1, d.d2, reach, T) > 0.0 ? INFINITY
                                                     : sim->rules->touch_jaw(&d, reach, T);
}

static double meet_pocket(const carom_sim *sim, int k, const motion *m, double T) {
  const carom_pocket *pocket = &sim->table->pocket[k];
  const carom_separation d = from_point(pocket->centre, m);
  return clearance(d.d0, d.d1, d.d2, pocket->radius, T) > 0.0
             ? INFINITY
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

/* The box of a path up to T: its range of x, then that of y. */
static inline void box_of(const motion *m, double T, double box[4]) {
  range_of(m->r[0], m->v[0], m->a[0], T, &box[0], &box[1]);
  range_of(m->r[1], m->v[1], m->a[1], T, &box[2], &box[3]);
}

/* Lists the features of the table whose boxes meet that of a path. Without branches, since which
 * ones they are cannot be predicted. */
static inline int list_near(const carom_features *f, const double box[4],
                            uint8_t neighbors[MOST_FEATURES]) {
  CAROM_PROMISE(f->count == f->rails + f->jaws + f->pockets && f->count <= MOST_FEATURES);
  const float low_x = (float)box[0], high_x = (float)box[1];
  const float low_y = (float)box[2], high_y = (float)box[3];
  uint32_t is_near[MOST_FEATURES]; /* as wide as the numbers that are compared */
  for (int k = 0; k < f->count; k++)
    is_near[k] = (f->low_x[k] <= high_x) & (f->high_x[k] >= low_x) & (f->low_y[k] <= high_y) &
                 (f->high_y[k] >= low_y);
  int count = 0;
  for (int k = 0; k < f->count; k++) {
    neighbors[count] = (uint8_t)k;
    count += (int)is_near[k];
  }
  return count;
}

/* When ball i meets feature k, up to T. `unlike`, a constant: whether noses and jaws are reached at
 * distances of their own, nose.c. */
static inline __attribute__((always_inline)) carom_meeting
meet_feature(const carom_sim *sim, int i, int k, const motion *m, double T, const bool unlike) {
  const carom_features *f = sim->features;
  const carom_ball_kind *kind = sim->layout->kind[i];
  double reach = sim->rates[i].radius;
  if (k < f->rails) {
    if (unlike)
      reach = carom_reach_on_cloth(kind, sim->table->rail[k].height, f->reference);
    return (carom_meeting){meet_rail(sim, k, reach, m, T), CAROM_EVENT_RAIL, k};
  }
  const int jaw = k - f->rails;
  if (jaw < f->jaws) {
    if (unlike)
      reach = carom_reach_on_cloth(kind, sim->table->jaw[jaw].height, f->reference);
    return (carom_meeting){meet_jaw(sim, jaw, reach, m, T), CAROM_EVENT_JAW, jaw};
  }
  const int pocket = jaw - f->jaws;
  return (carom_meeting){meet_pocket(sim, pocket, m, T), CAROM_EVENT_POCKET, pocket};
}

static inline __attribute__((always_inline)) carom_meeting
meet_table_as(const carom_sim *sim, int i, const motion *m, double T, const bool unlike) {
  const carom_features *f = sim->features;
  carom_meeting first = {INFINITY, CAROM_DUE_NOTHING, 0};

  /* a path that leads out of the hull ends there */
  double box[4];
  box_of(m, T, box);
  if (box[0] < f->hull[0] || box[1] > f->hull[1] || box[2] < f->hull[2] || box[3] > f->hull[3]) {
    first.time = leave_hull(f, m, T);
    T = carom_lesser(T, first.time);
    box_of(m, T, box);
  }

  /* each feature narrows the horizon of those behind it */
  uint8_t neighbors[MOST_FEATURES];
  const int count = list_near(f, box, neighbors);
  for (int index = 0; index < count; index++) {
    const carom_meeting next = meet_feature(sim, i, neighbors[index], m, T, unlike);
    /* at the same time a pocket goes first, and anything before the end of the hull */
    const bool first_of_equals = first.type == CAROM_DUE_NOTHING || next.type == CAROM_EVENT_POCKET;
    if (next.time < first.time || (next.time <= first.time && first_of_equals && next.time <= T)) {
      first = next;
      T = next.time;
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

/* When balls i and j meet, up to T from now on. */
static double meet_ball(const carom_sim *sim, int i, const motion *a, int j, double T) {
  const motion b = motion_now(sim, j);
  carom_separation d = {{b.r[0] - a->r[0], b.r[1] - a->r[1], 0.0},
                        {b.v[0] - a->v[0], b.v[1] - a->v[1], 0.0},
                        {b.a[0] - a->a[0], b.a[1] - a->a[1], 0.0}};
  const double reach = sim->rates[i].radius + sim->rates[j].radius;
  if (!carom_in_space(sim))
    return sim->rules->touch_ball(&d, reach, T);
  const double t = sim->time - sim->start[j], elapsed = sim->time - sim->start[i];
  d.d0[2] = sim->z[j] + t * (sim->v_z[j] + t * sim->a_z[j]) -
            (sim->z[i] + elapsed * (sim->v_z[i] + elapsed * sim->a_z[i]));
  d.d1[2] = sim->v_z[j] + 2.0 * t * sim->a_z[j] - (sim->v_z[i] + 2.0 * elapsed * sim->a_z[i]);
  d.d2[2] = sim->a_z[j] - sim->a_z[i];
  return carom_first_contact_in_space(&d, reach, T);
}

/* Pairs of ball i with all others but `done`: rejected in one loop that compilers turn into
 * vectors, then solved. */
static void meet_balls(carom_sim *sim, int i, int done) {
  const motion m = motion_now(sim, i);
  const int n = sim->count;
  const double time = sim->time, horizon = sim->horizon[i] - time,
               reach = sim->rates[i].radius + sim->widest;
  double clear[CAROM_BALLS_MOST], end[CAROM_BALLS_MOST];
  for (int j = 0; j < n; j++) {
    const double t = time - sim->start[j];
    const double p[2] = {sim->x[j] + t * (sim->v_x[j] + t * sim->a_x[j]) - m.r[0],
                         sim->y[j] + t * (sim->v_y[j] + t * sim->a_y[j]) - m.r[1]};
    const double e[2] = {sim->v_x[j] + 2.0 * t * sim->a_x[j] - m.v[0],
                         sim->v_y[j] + 2.0 * t * sim->a_y[j] - m.v[1]};
    const double a[2] = {sim->a_x[j] - m.a[0], sim->a_y[j] - m.a[1]};
    const double T0 = sim->horizon[j] - time, T = T0 < horizon ? T0 : horizon;
    clear[j] = clearance(p, e, a, reach, T);
    end[j] = T;
  }
  for (int j = 0; j < n; j++) {
    if (j == i || j == done)
      continue;
    double t = INFINITY;
    if (end[j] >= 0.0 && end[j] < INFINITY && !(clear[j] > 0.0))
      t = time + meet_ball(sim, i, &m, j, end[j]);
    const int low = i < j ? i : j, high = i < j ? j : i;
    CAROM_PROMISE(low < high && !(t < time));
    sim->pair[low][high] = t;
    sim->pair_round[low][high] = (int32_t)sim->round;
  }
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
  CAROM_PROMISE(with > i || first == INFINITY);
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
  CAROM_PROMISE(sim->flying >= 0 && sim->flying <= sim->count);
}

__attribute__((noinline, cold)) static carom_meeting meet_in_flight(carom_sim *sim, int i) {
  carom_ball_state s;
  carom_path_at(&sim->path[i], &sim->rates[i], sim->time, &s);
  return carom_meet_in_flight(sim, i, s.r, s.v, sim->path[i].end - sim->time);
}

/* Puts the path of ball i into the columns. */
static inline void take_columns(carom_sim *sim, int i) {
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
}

/* Until when the path and the meeting of ball i hold. A ball that stays where it is does so for
 * any time, and one that is out of play meets nothing. */
static inline void take_horizon(carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  sim->own_end[i] = carom_lesser(path->end, sim->meeting[i].time);
  if (carom_is_out(path->from.label))
    sim->horizon[i] = -INFINITY;
  else
    sim->horizon[i] = carom_translates(path->from.label) ? sim->own_end[i] : INFINITY;
}

/* The path of ball i, and its next meeting with the table. */
static void take_path(carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  CAROM_PROMISE(!(path->end < sim->time));
  take_columns(sim, i);
  sim->meeting[i] = (carom_meeting){INFINITY, 0, 0};
  sim->meeting_round[i] = (int32_t)sim->round;
  if (carom_flies(&path->from)) {
    sim->meeting[i] = meet_in_flight(sim, i);
  } else if (carom_translates(path->from.label)) {
    const motion m = motion_now(sim, i);
    sim->meeting[i] = meet_table(sim, i, &m, path->end - sim->time);
  }
  CAROM_PROMISE(!(sim->meeting[i].time < 0.0));
  sim->meeting[i].time += sim->time;
  take_horizon(sim, i);
}

void carom_detect(carom_sim *sim, int i, int j) {
  CAROM_PROMISE(i >= 0 && i < sim->count && j >= -1 && j < sim->count && i != j);
  take_path(sim, i);
  if (j >= 0)
    take_path(sim, j);
  meet_balls(sim, i, -1);
  if (j >= 0)
    meet_balls(sim, j, i);
  scan_row(sim, i);
  update_rows(sim, i);
  if (j >= 0) {
    scan_row(sim, j);
    update_rows(sim, j);
  }
}

/* The third column, as of balls on the cloth. */
static void no_heights(carom_sim *sim) {
  sim->flying = 0;
  for (int i = 0; i < sim->count; i++) {
    sim->z[i] = sim->rates[i].radius;
    sim->v_z[i] = sim->a_z[i] = 0.0;
  }
}

void carom_detect_columns(carom_sim *sim) {
  no_heights(sim);
  for (int i = 0; i < sim->count; i++) {
    take_columns(sim, i);
    take_horizon(sim, i);
    scan_row(sim, i);
  }
}

void carom_detect_all(carom_sim *sim) {
  const int n = sim->count;
  no_heights(sim);
  for (int i = 0; i < n; i++) {
    take_path(sim, i);
    for (int j = i + 1; j < n; j++) {
      sim->pair[i][j] = INFINITY;
      sim->pair_round[i][j] = 0;
    }
  }
  for (int i = 0; i < n; i++)
    if (carom_translates(sim->path[i].from.label))
      meet_balls(sim, i, -1);
  for (int i = 0; i < n; i++)
    scan_row(sim, i);
}

void carom_take_rates(carom_sim *sim) {
  sim->unlike = false;
  sim->widest = 0.0;
  for (int i = 0; i < sim->count; i++) {
    sim->rates[i] =
        carom_rates_on_slope(sim->layout->kind[i], sim->table->slope_x, sim->table->slope_y);
    sim->widest = carom_greater(sim->widest, sim->rates[i].radius);
    sim->unlike |= sim->rates[i].radius != sim->features->reference;
  }
}
