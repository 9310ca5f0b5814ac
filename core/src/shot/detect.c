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
 *            .--''''--.     the path, T^2/4 a at most off its chord
 *          o---- T c --->o
 *        p  \           /  p + T c
 *            \         /
 *             '-- o --'     the origin
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
} line_of_motion;

/* The path of a ball, from its columns. */
static line_of_motion motion_now(const carom_sim *sim, int ball) {
  const double elapsed = sim->time - sim->start[ball];
  return (line_of_motion){{sim->x[ball] + elapsed * (sim->v_x[ball] + elapsed * sim->a_x[ball]),
                           sim->y[ball] + elapsed * (sim->v_y[ball] + elapsed * sim->a_y[ball])},
                          {sim->v_x[ball] + 2.0 * elapsed * sim->a_x[ball],
                           sim->v_y[ball] + 2.0 * elapsed * sim->a_y[ball]},
                          {sim->a_x[ball], sim->a_y[ball]}};
}

/* The range of one coordinate up to the horizon: of its ends, and of its vertex where it turns. */
static void range_of(double start, double speed, double half_acceleration, double horizon,
                     double *low, double *high) {
  const double end = start + horizon * (speed + horizon * half_acceleration);
  *low = carom_lesser(start, end);
  *high = carom_greater(start, end);
  const double turn = -speed / (2.0 * half_acceleration);
  if (turn > 0.0 && turn < horizon) {
    const double vertex = start + 0.5 * turn * speed;
    *low = carom_lesser(*low, vertex);
    *high = carom_greater(*high, vertex);
  }
}

/* Distance from a line, or position along a rail. */
static double place(const double line[3], const line_of_motion *track, double time) {
  return line[0] * (track->r[0] + time * (track->v[0] + time * track->a[0])) +
         line[1] * (track->r[1] + time * (track->v[1] + time * track->a[1])) + line[2];
}

/* When the ball touches a rail, at `reach` from its line, up to the horizon; or infinity. */
static double meet_rail(const carom_sim *sim, int rail, double reach, const line_of_motion *track,
                        double horizon) {
  const double *line = sim->features->line[rail], *along = sim->features->along[rail];
  const double gap[3] = {carom_plane_dot(line, track->r) + line[2] - reach,
                         carom_plane_dot(line, track->v), carom_plane_dot(line, track->a)};

  /* the first of these times at which it is between the ends of the rail */
  double times[2];
  const int count = sim->rules->touch_rail(gap, horizon, times);
  CAROM_PROMISE(count >= 0 && count <= 2);
  for (int index = 0; index < count; index++) {
    const double share = place(along, track, times[index]);
    if (share >= 0.0 && share <= 1.0)
      return times[index];
  }
  return INFINITY;
}

/* The way from a point to the ball. */
static carom_separation from_point(const double centre[2], const line_of_motion *track) {
  return (carom_separation){{track->r[0] - centre[0], track->r[1] - centre[1], 0.0},
                            {track->v[0], track->v[1], 0.0},
                            {track->a[0], track->a[1], 0.0}};
}

/* Positive where a path p + e t + a t^2 surely stays farther from the origin than `reach` on [0,
 * T]: see CHORD. In squares, times |c|^2. */
#define FOR_ROUNDING 1e-9 /* of reach^2: so much farther counts as not sure */
static inline double clearance(const double p[2], const double e[2], const double a[2],
                               double reach, double T) {
  /* c, and T^2/4 */
  const double c_x = e[0] + T * a[0], c_y = e[1] + T * a[1], square = c_x * c_x + c_y * c_y;
  const double quarter = 0.25 * T * T, along = p[0] * c_x + p[1] * c_y;

  /* along the chord: it leads away, or ends before; less the bulge. Across it likewise */
  const double bulge = quarter * fabs(a[0] * c_x + a[1] * c_y);
  const double ahead = -along - T * square;
  const double off = fabs(p[0] * c_y - p[1] * c_x) - quarter * fabs(a[0] * e[1] - a[1] * e[0]);
  const double gap = (along > ahead ? along : ahead) - bulge, most = off > gap ? off : gap;
  return most * fabs(most) - (1.0 + FOR_ROUNDING) * reach * reach * square;
}

/* When the ball touches a jaw, up to the horizon; or infinity. */
static double meet_jaw(const carom_sim *sim, int index, double radius, const line_of_motion *track,
                       double horizon) {
  const carom_jaw *jaw = &sim->table->jaw[index];
  const carom_separation separation = from_point(jaw->centre, track);
  const double reach = jaw->radius + radius;
  return clearance(separation.d0, separation.d1, separation.d2, reach, horizon) > 0.0
             ? INFINITY
             : sim->rules->touch_jaw(&separation, reach, horizon);
}

/* When the centre crosses the circle of a pocket, up to the horizon; or infinity. */
static double meet_pocket(const carom_sim *sim, int index, const line_of_motion *track,
                          double horizon) {
  const carom_pocket *pocket = &sim->table->pocket[index];
  const carom_separation separation = from_point(pocket->centre, track);
  return clearance(separation.d0, separation.d1, separation.d2, pocket->radius, horizon) > 0.0
             ? INFINITY
             : sim->rules->enter_pocket(&separation, pocket->radius, horizon);
}

/* When the centre leaves the hull, up to the horizon; or infinity. */
static double leave_hull(const carom_features *features, const line_of_motion *track,
                         double horizon) {
  double first = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    const double low[3] = {track->r[axis] - features->hull[2 * axis], track->v[axis],
                           track->a[axis]},
                 high[3] = {features->hull[2 * axis + 1] - track->r[axis], -track->v[axis],
                            -track->a[axis]};
    first = carom_lesser(first, carom_lesser(carom_first_touch(low, 0.0, horizon),
                                             carom_first_touch(high, 0.0, horizon)));
  }
  return first;
}

/* The box of a path up to the horizon: its range of x, then of y. */
static inline void box_of(const line_of_motion *track, double horizon, double box[4]) {
  range_of(track->r[0], track->v[0], track->a[0], horizon, &box[0], &box[1]);
  range_of(track->r[1], track->v[1], track->a[1], horizon, &box[2], &box[3]);
}

/* Lists the features of the table whose boxes meet the box of a path. Without branches, since which
 * ones they are cannot be predicted. */
static inline int list_near(const carom_features *features, const double box[4],
                            uint8_t neighbors[MOST_FEATURES]) {
  CAROM_PROMISE(features->count == features->rails + features->jaws + features->pockets &&
                features->count <= MOST_FEATURES);
  const float low_x = (float)box[0], high_x = (float)box[1];
  const float low_y = (float)box[2], high_y = (float)box[3];
  uint32_t is_near[MOST_FEATURES]; /* as wide as the numbers that are compared */
  for (int index = 0; index < features->count; index++)
    is_near[index] = (features->low_x[index] <= high_x) & (features->high_x[index] >= low_x) &
                     (features->low_y[index] <= high_y) & (features->high_y[index] >= low_y);
  int count = 0;
  for (int index = 0; index < features->count; index++) {
    neighbors[count] = (uint8_t)index;
    count += (int)is_near[index];
  }
  return count;
}

/* When a ball meets a feature of the table, up to the horizon. `unlike`, a constant: whether noses
 * and jaws have separate distances of contact, nose.c. */
static inline __attribute__((always_inline)) carom_meeting
meet_feature(const carom_sim *sim, int ball, int feature, const line_of_motion *track,
             double horizon, const bool unlike) {
  const carom_features *features = sim->features;
  const carom_ball_kind *kind = sim->layout->kind[ball];
  double reach = sim->rates[ball].radius;
  if (feature < features->rails) {
    if (unlike)
      reach = carom_reach_on_cloth(kind, sim->table->rail[feature].height, features->reference);
    return (carom_meeting){meet_rail(sim, feature, reach, track, horizon), CAROM_EVENT_RAIL,
                           feature};
  }
  const int jaw = feature - features->rails;
  if (jaw < features->jaws) {
    if (unlike)
      reach = carom_reach_on_cloth(kind, sim->table->jaw[jaw].height, features->reference);
    return (carom_meeting){meet_jaw(sim, jaw, reach, track, horizon), CAROM_EVENT_JAW, jaw};
  }
  const int pocket = jaw - features->jaws;
  return (carom_meeting){meet_pocket(sim, pocket, track, horizon), CAROM_EVENT_POCKET, pocket};
}

static inline __attribute__((always_inline)) carom_meeting
meet_table_as(const carom_sim *sim, int ball, const line_of_motion *track, double horizon,
              const bool unlike) {
  const carom_features *features = sim->features;
  carom_meeting first = {INFINITY, CAROM_DUE_NOTHING, 0};

  /* a path that leads out of the hull ends there */
  double box[4];
  box_of(track, horizon, box);
  if (box[0] < features->hull[0] || box[1] > features->hull[1] || box[2] < features->hull[2] ||
      box[3] > features->hull[3]) {
    first.time = leave_hull(features, track, horizon);
    horizon = carom_lesser(horizon, first.time);
    box_of(track, horizon, box);
  }

  /* each feature narrows the horizon of those behind it */
  uint8_t neighbors[MOST_FEATURES];
  const int count = list_near(features, box, neighbors);
  for (int index = 0; index < count; index++) {
    const carom_meeting next = meet_feature(sim, ball, neighbors[index], track, horizon, unlike);
    /* at the same time a pocket goes first, and anything before the end of the hull */
    const bool first_of_equals = first.type == CAROM_DUE_NOTHING || next.type == CAROM_EVENT_POCKET;
    if (next.time < first.time ||
        (next.time <= first.time && first_of_equals && next.time <= horizon)) {
      first = next;
      horizon = next.time;
    }
  }
  return first;
}

__attribute__((noinline, cold)) static carom_meeting
meet_table_unlike(const carom_sim *sim, int ball, const line_of_motion *track, double horizon) {
  return meet_table_as(sim, ball, track, horizon, true);
}
static carom_meeting meet_table(const carom_sim *sim, int ball, const line_of_motion *track,
                                double horizon) {
  return sim->unlike ? meet_table_unlike(sim, ball, track, horizon)
                     : meet_table_as(sim, ball, track, horizon, false);
}

/* When two balls meet, up to the horizon from now on. */
static double meet_ball(const carom_sim *sim, int ball, const line_of_motion *track, int partner,
                        double horizon) {
  const line_of_motion partner_track = motion_now(sim, partner);
  carom_separation separation = {
      {partner_track.r[0] - track->r[0], partner_track.r[1] - track->r[1], 0.0},
      {partner_track.v[0] - track->v[0], partner_track.v[1] - track->v[1], 0.0},
      {partner_track.a[0] - track->a[0], partner_track.a[1] - track->a[1], 0.0}};
  const double reach = sim->rates[ball].radius + sim->rates[partner].radius;
  if (!carom_in_space(sim))
    return sim->rules->touch_ball(&separation, reach, horizon);
  const double partner_elapsed = sim->time - sim->start[partner],
               elapsed = sim->time - sim->start[ball];
  separation.d0[2] = sim->z[partner] +
                     partner_elapsed * (sim->v_z[partner] + partner_elapsed * sim->a_z[partner]) -
                     (sim->z[ball] + elapsed * (sim->v_z[ball] + elapsed * sim->a_z[ball]));
  separation.d1[2] = sim->v_z[partner] + 2.0 * partner_elapsed * sim->a_z[partner] -
                     (sim->v_z[ball] + 2.0 * elapsed * sim->a_z[ball]);
  separation.d2[2] = sim->a_z[partner] - sim->a_z[ball];
  return carom_first_contact_in_space(&separation, reach, horizon);
}

/* Pairs of a ball with all others but `done`: rejected in one loop that compilers turn into
 * vectors, then solved. */
static void meet_balls(carom_sim *sim, int ball, int done) {
  const line_of_motion track = motion_now(sim, ball);
  const int count = sim->count;
  const double time = sim->time, horizon = sim->horizon[ball] - time,
               reach = sim->rates[ball].radius + sim->widest;
  double clear[CAROM_BALLS_MOST], end[CAROM_BALLS_MOST];

  /* how far they surely stay apart up to their common horizon, by p + e t + a t^2 (CHORD) */
  for (int partner = 0; partner < count; partner++) {
    const double elapsed = time - sim->start[partner];
    const double p[2] = {
        sim->x[partner] + elapsed * (sim->v_x[partner] + elapsed * sim->a_x[partner]) - track.r[0],
        sim->y[partner] + elapsed * (sim->v_y[partner] + elapsed * sim->a_y[partner]) - track.r[1]};
    const double e[2] = {sim->v_x[partner] + 2.0 * elapsed * sim->a_x[partner] - track.v[0],
                         sim->v_y[partner] + 2.0 * elapsed * sim->a_y[partner] - track.v[1]};
    const double a[2] = {sim->a_x[partner] - track.a[0], sim->a_y[partner] - track.a[1]};
    const double limit = sim->horizon[partner] - time, common = limit < horizon ? limit : horizon;
    clear[partner] = clearance(p, e, a, reach, common);
    end[partner] = common;
  }

  /* those that may meet; each pair is at the lower index */
  for (int partner = 0; partner < count; partner++) {
    if (partner == ball || partner == done)
      continue;
    double meeting = INFINITY;
    if (end[partner] >= 0.0 && end[partner] < INFINITY && !(clear[partner] > 0.0))
      meeting = time + meet_ball(sim, ball, &track, partner, end[partner]);
    const int low = ball < partner ? ball : partner, high = ball < partner ? partner : ball;
    CAROM_PROMISE(low < high && !(meeting < time));
    sim->pair[low][high] = meeting;
    sim->pair_round[low][high] = (int32_t)sim->round;
  }
}

/* The first of a row again. */
static void scan_row(carom_sim *sim, int row) {
  double first = INFINITY;
  int with = 0;
  for (int column = row + 1; column < sim->count; column++)
    if (sim->pair[row][column] < first) {
      first = sim->pair[row][column];
      with = column;
    }
  sim->first[row] = first;
  sim->first_with[row] = (int8_t)with;
  CAROM_PROMISE(with > row || first == INFINITY);
}

/* A column of the pairs has changed: the firsts of the rows above. */
static void update_rows(carom_sim *sim, int column) {
  for (int row = 0; row < column; row++) {
    if (sim->pair[row][column] < sim->first[row]) {
      sim->first[row] = sim->pair[row][column];
      sim->first_with[row] = (int8_t)column;
    } else if (sim->first_with[row] == column) {
      scan_row(sim, row);
    }
  }
}

/* The third column, which changes where a ball takes off or lands. A ball on the cloth is at z =
 * R exactly, though a layout may be 1e-6 m off. */
__attribute__((noinline, cold)) static void take_height(carom_sim *sim, int ball) {
  const carom_path *path = &sim->path[ball];
  const bool flies = carom_flies(&path->from);
  sim->flying += flies - (sim->a_z[ball] != 0.0);
  sim->z[ball] = flies ? path->from.r[2] : sim->rates[ball].radius;
  sim->v_z[ball] = flies ? path->from.v[2] : 0.0;
  sim->a_z[ball] = path->a[2];
  CAROM_PROMISE(sim->flying >= 0 && sim->flying <= sim->count);
}

__attribute__((noinline, cold)) static carom_meeting meet_in_flight(carom_sim *sim, int ball) {
  carom_ball_state state;
  carom_path_at(&sim->path[ball], &sim->rates[ball], sim->time, &state);
  return carom_meet_in_flight(sim, ball, state.r, state.v, sim->path[ball].end - sim->time);
}

/* Puts the path of a ball into the columns. */
static inline void take_columns(carom_sim *sim, int ball) {
  const carom_path *path = &sim->path[ball];
  const bool translates = carom_translates(path->from.label);
  sim->start[ball] = path->start;
  sim->x[ball] = path->from.r[0];
  sim->y[ball] = path->from.r[1];
  sim->v_x[ball] = translates ? path->from.v[0] : 0.0;
  sim->v_y[ball] = translates ? path->from.v[1] : 0.0;
  sim->a_x[ball] = path->a[0];
  sim->a_y[ball] = path->a[1];
  if (path->a[2] != 0.0 || sim->a_z[ball] != 0.0)
    take_height(sim, ball);
}

/* Until when the path and the meeting of a ball hold. A ball that stays where it is does so for
 * any time, and one that is out of play meets nothing. */
static inline void take_horizon(carom_sim *sim, int ball) {
  const carom_path *path = &sim->path[ball];
  sim->own_end[ball] = carom_lesser(path->end, sim->meeting[ball].time);
  if (carom_is_out(path->from.label))
    sim->horizon[ball] = -INFINITY;
  else
    sim->horizon[ball] = carom_translates(path->from.label) ? sim->own_end[ball] : INFINITY;
}

/* The path of a ball, and its next meeting with the table. */
static void take_path(carom_sim *sim, int ball) {
  const carom_path *path = &sim->path[ball];
  CAROM_PROMISE(!(path->end < sim->time));
  take_columns(sim, ball);
  sim->meeting[ball] = (carom_meeting){INFINITY, 0, 0};
  sim->meeting_round[ball] = (int32_t)sim->round;
  if (carom_flies(&path->from)) {
    sim->meeting[ball] = meet_in_flight(sim, ball);
  } else if (carom_translates(path->from.label)) {
    const line_of_motion track = motion_now(sim, ball);
    sim->meeting[ball] = meet_table(sim, ball, &track, path->end - sim->time);
  }
  CAROM_PROMISE(!(sim->meeting[ball].time < 0.0));
  sim->meeting[ball].time += sim->time;
  take_horizon(sim, ball);
}

void carom_detect(carom_sim *sim, int ball, int partner) {
  CAROM_PROMISE(ball >= 0 && ball < sim->count && partner >= -1 && partner < sim->count &&
                ball != partner);
  take_path(sim, ball);
  if (partner >= 0)
    take_path(sim, partner);
  meet_balls(sim, ball, -1);
  if (partner >= 0)
    meet_balls(sim, partner, ball);
  scan_row(sim, ball);
  update_rows(sim, ball);
  if (partner >= 0) {
    scan_row(sim, partner);
    update_rows(sim, partner);
  }
}

/* The third column, as of balls on the cloth. */
static void no_heights(carom_sim *sim) {
  sim->flying = 0;
  for (int ball = 0; ball < sim->count; ball++) {
    sim->z[ball] = sim->rates[ball].radius;
    sim->v_z[ball] = sim->a_z[ball] = 0.0;
  }
}

void carom_detect_columns(carom_sim *sim) {
  no_heights(sim);
  for (int ball = 0; ball < sim->count; ball++) {
    take_columns(sim, ball);
    take_horizon(sim, ball);
    scan_row(sim, ball);
  }
}

void carom_detect_all(carom_sim *sim) {
  const int count = sim->count;
  no_heights(sim);
  for (int ball = 0; ball < count; ball++) {
    take_path(sim, ball);
    for (int partner = ball + 1; partner < count; partner++) {
      sim->pair[ball][partner] = INFINITY;
      sim->pair_round[ball][partner] = 0;
    }
  }
  for (int ball = 0; ball < count; ball++)
    if (carom_translates(sim->path[ball].from.label))
      meet_balls(sim, ball, -1);
  for (int ball = 0; ball < count; ball++)
    scan_row(sim, ball);
}

void carom_take_rates(carom_sim *sim) {
  sim->unlike = false;
  sim->widest = 0.0;
  for (int ball = 0; ball < sim->count; ball++) {
    sim->rates[ball] =
        carom_rates_on_slope(sim->layout->kind[ball], sim->table->slope_x, sim->table->slope_y);
    sim->widest = carom_greater(sim->widest, sim->rates[ball].radius);
    sim->unlike |= sim->rates[ball].radius != sim->features->reference;
  }
}
