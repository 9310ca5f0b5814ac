/* What every shot must satisfy. The motion between events is written here once more, from the
 * equations and not from the library, so that a wrong path shows: as a jump at the next event,
 * an overlap, or a rise of energy. */
#include "invariants.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* m, m/s: what the cloth does to balls in the time of a cluster */
static const double rubbed = 1e-5, rubbed_speed = 4e-3;

static double length2(double x, double y) {
  return sqrt(x * x + y * y);
}

static int is_out(const carom_ball_state *s) {
  return s->label == CAROM_BALL_POCKETED || s->label == CAROM_BALL_OFF;
}
static int flies(const carom_ball_state *s) {
  return s->label == CAROM_BALL_AIRBORNE;
}

/* The state of a ball some time after it was *s. */
static void move(const carom_ball_kind *k, const carom_ball_state *s, double t,
                 carom_ball_state *out) {
  *out = *s;
  if (s->label == CAROM_BALL_STATIONARY || is_out(s))
    return;
  if (s->label == CAROM_BALL_AIRBORNE) {
    for (int axis = 0; axis < 3; axis++)
      out->r[axis] += s->v[axis] * t;
    out->r[2] -= 0.5 * k->gravity * t * t;
    out->v[2] -= k->gravity * t;
    return;
  }
  const double fall = 2.5 * k->mu_spin * k->gravity / k->radius * t;
  out->w[2] = fabs(s->w[2]) > fall ? s->w[2] - copysign(fall, s->w[2]) : 0.0;
  if (s->label == CAROM_BALL_SPINNING)
    return;
  const int slides = s->label == CAROM_BALL_SLIDING;
  const double x = slides ? s->v[0] - k->radius * s->w[1] : s->v[0],
               y = slides ? s->v[1] + k->radius * s->w[0] : s->v[1];
  const double size = length2(x, y), a = (slides ? k->mu_slide : k->mu_roll) * k->gravity;
  const double e[2] = {size > 0.0 ? x / size : 0.0, size > 0.0 ? y / size : 0.0};
  for (int axis = 0; axis < 2; axis++) {
    out->r[axis] = s->r[axis] + s->v[axis] * t - 0.5 * a * e[axis] * t * t;
    out->v[axis] = s->v[axis] - a * e[axis] * t;
  }
  if (slides) {
    out->w[0] = s->w[0] - 2.5 * a / k->radius * t * e[1];
    out->w[1] = s->w[1] + 2.5 * a / k->radius * t * e[0];
  } else {
    out->w[0] = -out->v[1] / k->radius;
    out->w[1] = out->v[0] / k->radius;
  }
}

static double energy_of(const carom_ball_kind *k, const carom_ball_state *s) {
  double v2 = 0.0, w2 = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    v2 += s->v[axis] * s->v[axis];
    w2 += s->w[axis] * s->w[axis];
  }
  const double height = flies(s) ? s->r[2] - k->radius : 0.0;
  return 0.5 * k->mass * v2 + 0.2 * k->mass * k->radius * k->radius * w2 +
         k->mass * k->gravity * height;
}

/* Whether an event is a contact of spheres in space. */
static int in_space(const carom_shot_ball *balls, const carom_event *e) {
  return flies(&e->before[0]) || flies(&e->before[1]) ||
         balls[e->a].kind.radius != balls[e->b].kind.radius;
}

/* The fraction of a contact of two balls that the cloth has a part in, core/src/cluster/cluster.h:
 * all of it where equal balls lie on it, none 1 mm above it, or where the line of centres is
 * steep. */
static double share_of_cloth(const carom_shot_ball *balls, const carom_event *e) {
  double z[2], height = 0.0;
  for (int side = 0; side < 2; side++) {
    const double R = balls[side == 0 ? e->a : e->b].kind.radius;
    z[side] = flies(&e->before[side]) ? e->before[side].r[2] : R;
    height = fmax(height, z[side] - R);
  }
  const double tilt = (z[1] - z[0]) / (balls[e->a].kind.radius + balls[e->b].kind.radius) / 0.1;
  return fmax(1.0 - height / 1e-3 - tilt * tilt, 0.0);
}

typedef struct follower {
  carom_shot before; /* the shot up to the next event */
  bool drag;         /* some ball has it: the library has the motion, since its path is an
                        approximation */
  const carom_table *table;
  const carom_shot_ball *balls;
  int count;
  double since[CAROM_BALLS_MOST];
  carom_ball_state from[CAROM_BALLS_MOST], at[CAROM_BALLS_MOST];
  shot_measures m;
  double energy, most_energy;
  int last_type;
  /* m: how deep two balls that a cluster or a push has moved into each other still are, as they
   * part */
  double left[CAROM_BALLS_MOST][CAROM_BALLS_MOST];
} follower;

static void go(follower *f, double time) {
  f->before.time = time;
  if (f->drag)
    carom_shot_at(f->balls, f->count, &f->before, time, f->at);
  else
    for (int i = 0; i < f->count; i++)
      move(&f->balls[i].kind, &f->from[i], time - f->since[i], &f->at[i]);
}

static void measure_energy(follower *f) {
  double sum = 0.0;
  for (int i = 0; i < f->count; i++)
    sum += energy_of(&f->balls[i].kind, &f->at[i]);
  f->most_energy = fmax(f->most_energy, sum);
  if (f->most_energy > 0.0)
    f->m.gain = fmax(f->m.gain, (sum - f->energy) / f->most_energy);
  f->energy = sum;
}

static const char *type_name(int type) {
  static const char *const names[] = {"begin",  "strike",   "ball_ball", "rail",  "jaw",
                                      "pocket", "rolls",    "spins",     "stops", "stops",
                                      "slate",  "rail_top", "left_table"};
  return names[type];
}

/* The distance of two centres; what is on the cloth is at z = R. */
static double distance(const follower *f, int i, int j) {
  const carom_ball_state *a = &f->at[i], *b = &f->at[j];
  const double z_a = flies(a) ? a->r[2] : f->balls[i].kind.radius,
               z_b = flies(b) ? b->r[2] : f->balls[j].kind.radius;
  return hypot(length2(a->r[0] - b->r[0], a->r[1] - b->r[1]), z_a - z_b);
}

/* The radius for which rails are placed: the table's, or the commonest, or the largest of these. */
static double reference_of(const follower *f) {
  double best = 0.0;
  int most = 0;
  if (f->table->ball_radius > 0.0)
    return f->table->ball_radius;
  for (int i = 0; i < f->count; i++) {
    const double radius = f->balls[i].kind.radius;
    int alike = 0;
    for (int j = 0; j < f->count; j++)
      alike += f->balls[j].kind.radius == radius;
    if (alike > most || (alike == most && radius > best))
      best = radius;
    most = alike > most ? alike : most;
  }
  return best;
}

/* Noses are inside the walls that represent them, so that balls of the table's radius touch
 * those on the cloth. */
static double nose_shift(const follower *f, double h) {
  const double reference = reference_of(f);
  return reference - sqrt(h * (2.0 * reference - h));
}
static double reach_on_cloth(const follower *f, double h, double R) {
  return R == reference_of(f) ? R : nose_shift(f, h) + sqrt(h * (2.0 * R - h));
}
/* How deep ball i is in a nose at a distance from its wall; of what is behind or under a flying one
 * the library judges. */
static double depth_of(const follower *f, int i, double left, double height) {
  const carom_ball_kind *kind = &f->balls[i].kind;
  const double h = kind->nose_height > 0.0 ? kind->nose_height : height,
               across = left - nose_shift(f, h);
  if (!flies(&f->at[i]))
    return reach_on_cloth(f, height, kind->radius) - left;
  return across >= 0.0 ? kind->radius - hypot(across, f->at[i].r[2] - h) : -INFINITY;
}

/* Keeps the deepest, and after which event it was. */
static void deepen(follower *f, double *deepest, double depth) {
  if (depth > *deepest) {
    *deepest = depth;
    f->m.worst_at = type_name(f->last_type);
  }
}

static double overlap_of(const follower *f, int i, int j) {
  return f->balls[i].kind.radius + f->balls[j].kind.radius - distance(f, i, j);
}

/* The overlap of two balls beyond that in which they part, which only falls. */
static void measure_overlap(follower *f, int i, int j) {
  double *left = &f->left[i][j];
  const double overlap = overlap_of(f, i, j);
  deepen(f, &f->m.overlap, overlap - *left);
  *left = fmax(fmin(*left, overlap), 0.0);
}

static void measure_places(follower *f) {
  for (int i = 0; i < f->count; i++) {
    if (is_out(&f->at[i]))
      continue;
    const double *r = f->at[i].r, R = f->balls[i].kind.radius;
    if (flies(&f->at[i]))
      f->m.depth = fmax(f->m.depth, R - r[2]);
    for (int j = 0; j < i; j++) {
      if (is_out(&f->at[j]))
        continue;
      measure_overlap(f, i, j);
    }
    for (int k = 0; k < f->table->rails; k++) {
      const carom_rail *rail = &f->table->rail[k];
      const double e_x = rail->q[0] - rail->p[0], e_y = rail->q[1] - rail->p[1],
                   x = r[0] - rail->p[0], y = r[1] - rail->p[1];
      const double size = length2(e_x, e_y), place = (x * e_x + y * e_y) / (size * size);
      /* distance on the left of p -> q */
      double left = (e_x * y - e_y * x) / size;
      /* whether the given line counts that as positive */
      const double line = rail->line[0] * -e_y + rail->line[1] * e_x;
      left = (rail->side == 1) == (line >= 0.0) ? left : -left;
      if (place >= 0.0 && place <= 1.0 && (flies(&f->at[i]) || left > -R))
        deepen(f, &f->m.intrusion, depth_of(f, i, left, rail->height));
    }
    for (int k = 0; k < f->table->jaws; k++) {
      const carom_jaw *jaw = &f->table->jaw[k];
      const double left = length2(r[0] - jaw->centre[0], r[1] - jaw->centre[1]) - jaw->radius;
      deepen(f, &f->m.intrusion, depth_of(f, i, left, jaw->height));
    }
  }
}

static double jump_of(const carom_ball_state *a, const carom_ball_state *b, double R) {
  double worst = 0.0;
  for (int axis = 0; axis < 3; axis++)
    worst =
        fmax(worst, fmax(fabs(a->r[axis] - b->r[axis]),
                         fmax(fabs(a->v[axis] - b->v[axis]), R * fabs(a->w[axis] - b->w[axis]))));
  return worst;
}

/* Friction of balls at no slip, the greatest of their laws; Alciatore's is below 0.12. */
static double friction_most(const carom_ball_kind *kind) {
  return fmax(0.12, kind->law_a + kind->law_b);
}

/* The cloth takes at most mu_slide times the vertical impulse, which is friction's, at most
 * friction_most() of the normal one (or mu_ball). */
static double momentum_change(const follower *f, const carom_event *e) {
  const carom_ball_kind *a = &f->balls[e->a].kind, *b = &f->balls[e->b].kind;
  double change[2], normal[2];
  for (int axis = 0; axis < 2; axis++) {
    const double p_a = a->mass * (e->after[0].v[axis] - e->before[0].v[axis]),
                 p_b = b->mass * (e->after[1].v[axis] - e->before[1].v[axis]);
    change[axis] = p_a + p_b;
    normal[axis] = p_b;
  }
  const double share = share_of_cloth(f->balls, e);
  const double friction = fmax(friction_most(a), friction_most(b));
  const double allowed = share * fmax(a->mu_slide, b->mu_slide) * friction * 1.01 *
                             length2(normal[0], normal[1]) / (1.0 - friction) +
                         1e-13;
  if (in_space(f->balls, e)) { /* heights count, but for a ball that stays on the cloth */
    const double p_a = a->mass * (e->after[0].v[2] - e->before[0].v[2]),
                 p_b = b->mass * (e->after[1].v[2] - e->before[1].v[2]);
    bool lies = false;
    for (int side = 0; side < 2; side++)
      lies |= !flies(&e->before[side]) && !flies(&e->after[side]);
    return hypot(length2(change[0], change[1]), lies ? 0.0 : p_a + p_b) /
           (allowed + 1e-9 * (a->mass + b->mass));
  }
  return length2(change[0], change[1]) / allowed;
}

/* Whether two balls move away from each other. */
static bool part(const follower *f, int i, int j) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; axis++)
    if (axis < 2 || flies(&f->at[i]) || flies(&f->at[j]))
      sum += (f->at[i].r[axis] - f->at[j].r[axis]) * (f->at[i].v[axis] - f->at[j].v[axis]);
  return sum > 0.0;
}

/* A cluster or a push starts its balls from where their contacts would have left them, each at an
 * instant (core/src/cluster/places.c). Two of them may overlap then, if they part. Without a cue
 * their centre of mass stays, unless the cloth rubs balls between touches that are taken in turn.
 * */
static void measure_start(follower *f, const carom_event *e) {
  double moved[2] = {0.0}, mass = 0.0;
  bool changed[CAROM_BALLS_MOST] = {false};
  for (int side = 0; side < 2 * e->cluster; side++) {
    const carom_event *one = &e[side / 2];
    const int i = side % 2 == 0 ? one->a : one->b;
    if (i < 0 || changed[i])
      continue;
    changed[i] = true;
    mass += f->balls[i].kind.mass;
    for (int axis = 0; axis < 2; axis++)
      moved[axis] +=
          f->balls[i].kind.mass * (one->after[side % 2].r[axis] - one->before[side % 2].r[axis]);
  }
  if (e->type == CAROM_EVENT_BALL_BALL)
    f->m.jump = fmax(f->m.jump, length2(moved[0], moved[1]) / mass - rubbed);
  for (int i = 0; i < f->count; i++)
    for (int j = 0; j < i; j++)
      if ((changed[i] || changed[j]) && !is_out(&f->at[i]) && !is_out(&f->at[j])) {
        f->left[i][j] = fmax(overlap_of(f, i, j), 0.0);
        f->m.start = fmax(f->m.start, f->left[i][j]);
        if (!part(f, i, j))
          f->m.again = fmax(f->m.again, f->left[i][j]);
      }
}

/* How far a ball that comes to rest may move out of others that rest: twice its overlaps, if one is
 * deeper than a layout may have it. */
static double way_out(const follower *f, int i) {
  double deepest = 0.0, sum = 0.0;
  for (int j = 0; j < f->count; j++) {
    if (j == i || is_out(&f->at[j]) || flies(&f->at[j]))
      continue;
    const double overlap = i > j ? overlap_of(f, i, j) : overlap_of(f, j, i);
    deepest = fmax(deepest, overlap);
    sum += fmax(overlap, 0.0);
  }
  return deepest > 5e-5 ? 2.0 * sum : 0.0;
}

/* An event by itself leaves its balls where they are, but for one that falls into a pocket, and for
 * one that rests. */
static double way_of(const follower *f, const carom_event *e, int side) {
  const double *r = e->before[side].r, *q = e->after[side].r;
  if (e->cluster > 0 || e->type == CAROM_EVENT_STRIKE || e->type == CAROM_EVENT_POCKET)
    return 0.0;
  const double way = hypot(length2(q[0] - r[0], q[1] - r[1]), q[2] - r[2]);
  const bool rests =
      e->after[0].label == CAROM_BALL_STATIONARY || e->after[0].label == CAROM_BALL_SPINNING;
  if (way > 0.0 && rests && e->type != CAROM_EVENT_BALL_BALL)
    return fmax(way - way_out(f, e->a), 0.0);
  return way;
}

/* The same for the contacts of a cluster together; of a push, by how much their momentum is above
 * that which the cue gave. The loads of all its balls press on the
 * cloth: friction's part of the normal impulses, of which each contact has at most as much as
 * the balls of the cluster change together. */
static double momentum_change_of_cluster(const follower *f, const carom_event *e) {
  double change[3] = {0.0}, sum = 0.0, mass = 0.0, mu = 0.0, friction = 0.0;
  double share = 0.0;
  bool space = false, changed[CAROM_BALLS_MOST] = {false};
  for (int k = 0; k < e->cluster; k++) {
    if (e[k].type == CAROM_EVENT_BALL_BALL)
      share = fmax(share, share_of_cloth(f->balls, &e[k]));
    for (int side = 0; side < 2; side++) {
      const int i = side == 0 ? e[k].a : e[k].b;
      if (i < 0 || changed[i])
        continue;
      changed[i] = true;
      const carom_ball_kind *kind = &f->balls[i].kind;
      double own[3];
      for (int axis = 0; axis < 3; axis++) {
        own[axis] = kind->mass * (e[k].after[side].v[axis] - e[k].before[side].v[axis]);
        change[axis] += own[axis];
      }
      sum += hypot(length2(own[0], own[1]), own[2]);
      mass += kind->mass;
      mu = fmax(mu, kind->mu_slide);
      friction = fmax(friction, friction_most(kind));
      space |= flies(&e[k].before[side]) || kind->radius != f->balls[e->a].kind.radius;
    }
  }
  const double given = e->type == CAROM_EVENT_STRIKE ? e->impulse : 0.0,
               size = fmax(hypot(length2(change[0], change[1]), change[2]) - given, 0.0);
  const double meanwhile = e->type == CAROM_EVENT_BALL_BALL ? rubbed_speed * mass : 0.0,
               cloth = mu * friction * e->cluster * sum + meanwhile;
  return size / (1e-13 + (space ? 1e-9 * mass + share * cloth : cloth));
}

static double impulse_on(const follower *f, const carom_event *e, int side) {
  const carom_ball_state *from = &e->before[side], *to = &e->after[side];
  double change[3];
  for (int axis = 0; axis < 3; axis++)
    change[axis] = to->v[axis] - from->v[axis];
  return f->balls[side == 0 ? e->a : e->b].kind.mass *
         hypot(length2(change[0], change[1]), change[2]);
}

/* How far the impulses of an event, or of all `together` of a cluster, are from what its balls
 * show, over what they show. In a cluster the cloth takes some of it. */
static double impulse_error(const follower *f, const carom_event *e, int together) {
  const bool touches = e->type == CAROM_EVENT_STRIKE || e->type == CAROM_EVENT_BALL_BALL ||
                       e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW ||
                       e->type == CAROM_EVENT_SLATE || e->type == CAROM_EVENT_RAIL_TOP;
  if (!touches)
    return e->impulse;
  /* Under a raised cue the slate presses against the ball too: it takes part of the push, and
   * throws the ball back, by up to 0.14 of it as seen. Level strokes are compared with their
   * momentum in physics/strike. */
  const double thrown = 1.2;
  if (e->cluster == 0 && e->type == CAROM_EVENT_STRIKE)
    return fmax(impulse_on(f, e, 0) - thrown * e->impulse, 0.0) / (1e-13 + 1e-12 * e->impulse);
  if (e->cluster == 0)
    return fabs(e->impulse - impulse_on(f, e, 0)) / (1e-13 + 1e-12 * e->impulse);
  double sum[CAROM_BALLS_MOST] = {0.0}, shown[CAROM_BALLS_MOST] = {0.0}, worst = 0.0;
  int contacts[CAROM_BALLS_MOST] = {0};
  for (int k = 0; k < together; k++) {
    if (!(e[k].impulse > 0.0))
      return INFINITY;
    for (int side = 0; side < 2; side++) {
      const int i = side == 0 ? e[k].a : e[k].b;
      if (i < 0)
        continue;
      sum[i] += e[k].impulse;
      contacts[i]++;
      shown[i] = fmax(shown[i], impulse_on(f, &e[k], side));
    }
  }

  /* Several impulses on a ball can cancel, one cannot. Friction is at most friction_most() of the
   * normal impulse; its vertical part does not show, and the cloth takes mu_slide times as much. A
   * ball that would move at 1e-12 m/s rests. */
  for (int i = 0; i < f->count; i++) {
    const double off = contacts[i] == 1 ? fabs(shown[i] - sum[i]) : shown[i] - sum[i];
    const double hidden = 0.015 + friction_most(&f->balls[i].kind) * f->balls[i].kind.mu_slide;
    const double meanwhile = e->type == CAROM_EVENT_BALL_BALL ? rubbed_speed : 0.0;
    worst = fmax(worst, off / (1e-12 + meanwhile * f->balls[i].kind.mass + hidden * sum[i]));
  }
  return worst;
}

shot_measures shot_measure(const carom_table *table, const carom_shot_ball *balls, int count,
                           const carom_shot *shot, carom_status status, int samples) {
  follower f = {.before = *shot,
                .table = table,
                .balls = balls,
                .count = count,
                .m = {.worst_at = "-"},
                .energy = INFINITY};
  f.before.room = shot->count;
  f.before.count = 0; /* what the layout is taken for */
  carom_shot_at(balls, count, &f.before, 0.0, f.from);
  for (int i = 0; i < count; i++)
    f.drag |= balls[i].kind.drag > 0.0;
  double now = 0.0;
  go(&f, 0.0);
  measure_energy(&f);
  measure_places(&f);
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_event *e = &shot->events[k];
    for (int s = 1; s <= samples && e->time > now; s++) {
      go(&f, now + (e->time - now) * s / (samples + 1));
      measure_energy(&f);
      measure_places(&f);
    }
    now = e->time;
    go(&f, now);
    measure_energy(&f);
    measure_places(&f);
    /* an event, or all of a cluster, which balance together */
    const int together = e->cluster > 0 ? e->cluster : 1;
    for (int side = 0; side < 2 * together; side++) {
      const carom_event *one = &e[side / 2];
      if (side % 2 == 1 && one->type != CAROM_EVENT_BALL_BALL)
        continue;
      const int i = side % 2 == 0 ? one->a : one->b;
      f.m.jump = fmax(f.m.jump, jump_of(&f.at[i], &one->before[side % 2], balls[i].kind.radius));
      f.m.jump = fmax(f.m.jump, way_of(&f, one, side % 2));
      if (side % 2 == 1)
        f.m.again = fmax(f.m.again, f.left[one->b][one->a]);
      f.from[i] = f.at[i] = one->after[side % 2];
      f.since[i] = now;
    }
    if (e->cluster > 0)
      measure_start(&f, e);
    if (e->cluster > 0)
      f.m.momentum = fmax(f.m.momentum, momentum_change_of_cluster(&f, e));
    else if (e->type == CAROM_EVENT_BALL_BALL)
      f.m.momentum = fmax(f.m.momentum, momentum_change(&f, e));
    f.m.impulse = fmax(f.m.impulse, impulse_error(&f, e, together));
    k += together - 1;
    f.before.count = k + 1;
    f.last_type = e->type;
    if (e->type == CAROM_EVENT_STRIKE)
      f.energy = INFINITY;
    measure_energy(&f);
    measure_places(&f);
  }
  for (int i = 0; i < count && status == CAROM_OK; i++)
    f.m.restless += f.from[i].label != CAROM_BALL_STATIONARY && !is_out(&f.from[i]);
  return f.m;
}
