/* Random shots: breaks, layouts, racks of other games, and what simulators trip over: frozen
 * racks, lines and clusters of touching balls, balls frozen to rails and in corners, much spin,
 * unlike balls, extreme restitution, up to 32 balls that their spin presses together, and what
 * random numbers never do: events at exactly one instant, gaps of exactly 0, the exact ends of
 * rails. And in space: elevated cues, balls that fall on each other, unlike radii. */
#include "random_shots.h"

#include <stdbool.h>
#include <string.h>

static bool is_free(const random_shot *s, double x, double y, double distance) {
  for (int k = 0; k < s->count; k++)
    if (hypot(s->ball[k].state.r[0] - x, s->ball[k].state.r[1] - y) < distance)
      return false;
  return true;
}

static void add(random_shot *s, carom_game game, double x, double y) {
  carom_shot_ball *b = &s->ball[s->count++];
  *b = (carom_shot_ball){.kind = carom_ball_kind_of(game)};
  b->state.r[0] = x;
  b->state.r[1] = y;
  b->state.r[2] = b->kind.radius;
}

/* A ball anywhere clear of rails and others. */
static void add_anywhere(random_shot *s, lab_random *r, carom_game game) {
  const double R = carom_ball_kind_of(game).radius, room = 2.0 * R + 1e-4;
  for (int trial = 0; trial < 1000; trial++) {
    const double x = lab_uniform(r, R + 1e-4, s->table.width - R - 1e-4),
                 y = lab_uniform(r, R + 1e-4, s->table.length - R - 1e-4);
    bool good = is_free(s, x, y, room);
    for (int k = 0; k < s->table.pockets; k++)
      good &= hypot(s->table.pocket[k].centre[0] - x, s->table.pocket[k].centre[1] - y) >
              s->table.pocket[k].radius + R;
    for (int k = 0; k < s->table.jaws; k++)
      good &= hypot(s->table.jaw[k].centre[0] - x, s->table.jaw[k].centre[1] - y) >
              s->table.jaw[k].radius + R;
    if (good) {
      add(s, game, x, y);
      return;
    }
  }
}

/* A tip within `most` radii of the centre, each position as likely. */
static void any_tip(random_shot *s, lab_random *r, double most) {
  const double off = most * sqrt(lab_uniform(r, 0.0, 1.0)),
               way = lab_uniform(r, 0.0, 6.283185307179586);
  s->cue.a = off * cos(way);
  s->cue.b = off * sin(way);
}

static void any_cue(random_shot *s, lab_random *r, double slow, double fast) {
  s->cue = carom_cue_of(CAROM_GAME_POOLTOOL_POOL);
  s->cue.speed = lab_uniform(r, slow, fast);
  s->cue.phi = lab_uniform(r, 0.0, 360.0);
  any_tip(s, r, 0.7);
  s->cue.theta = lab_uniform(r, 0.0, 1.0) < 0.3 ? lab_uniform(r, 0.0, 70.0) : 0.0;
}

/* At ball 1, give or take some degrees. */
static void aim(random_shot *s, lab_random *r, double off) {
  if (s->count > 1)
    s->cue.phi = 57.29577951308232 * atan2(s->ball[1].state.r[1] - s->ball[0].state.r[1],
                                           s->ball[1].state.r[0] - s->ball[0].state.r[0]) +
                 lab_uniform(r, -off, off);
}

static void break_of(random_shot *s, lab_random *r, carom_rack_kind rack, carom_table_kind table,
                     double gap) {
  carom_table_make(table, &s->table);
  carom_rack(rack, &s->table, gap, lab_bits(r), s->ball, CAROM_BALLS_MOST);
  s->count = carom_rack_size(rack);
  any_cue(s, r, 2.0, 12.0);
  aim(s, r, 4.0);
}

static carom_table_kind any_pool_table(lab_random *r) {
  return (carom_table_kind)lab_whole(r, CAROM_TABLE_POOL_7FT, CAROM_TABLE_POOL_9FT);
}

/* With gaps up to 0.3 mm. */
static void pool_break(random_shot *s, lab_random *r, carom_rack_kind rack) {
  break_of(s, r, rack, any_pool_table(r), pow(10.0, lab_uniform(r, -6.0, -3.5)));
}

static void nineball(random_shot *s, lab_random *r) {
  pool_break(s, r, CAROM_RACK_NINEBALL);
}
static void eightball(random_shot *s, lab_random *r) {
  pool_break(s, r, CAROM_RACK_EIGHTBALL);
}
static void tenball(random_shot *s, lab_random *r) {
  pool_break(s, r, CAROM_RACK_TENBALL);
}
static void frozen_rack(random_shot *s, lab_random *r) {
  break_of(s, r, (carom_rack_kind)lab_whole(r, CAROM_RACK_NINEBALL, CAROM_RACK_TENBALL),
           any_pool_table(r), 0.0);
}
static void snooker(random_shot *s, lab_random *r) {
  break_of(s, r, CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, lab_whole(r, 0, 1) ? 0.0 : 1e-4);
  s->cue.phi = lab_uniform(r, 0.0, 360.0);
  for (int k = 0; k < s->count; k++) {
    s->ball[k].kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_SNOOKER);
    s->ball[k].kind.radius = s->ball[k].state.r[2]; /* in the size in which the rack was laid */
  }
}

static void layout(random_shot *s, lab_random *r) {
  carom_table_make(any_pool_table(r), &s->table);
  const int count = lab_whole(r, 1, 15);
  for (int k = 0; k < count; k++)
    add_anywhere(s, r, CAROM_GAME_POOLTOOL_POOL);
  any_cue(s, r, 0.1, 8.0);
  aim(s, r, 10.0);
}

static void threecushion(random_shot *s, lab_random *r) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &s->table);
  for (int k = 0; k < 3; k++)
    add_anywhere(s, r, CAROM_GAME_POOLTOOL_BILLIARD);
  any_cue(s, r, 0.5, 8.0);
  aim(s, r, 3.0);
}

/* Balls that already roll, slide and spin. */
static void moving(random_shot *s, lab_random *r) {
  layout(s, r);
  s->cue.speed = 0.0;
  for (int k = 0; k < s->count; k++) {
    const double speed = lab_whole(r, 0, 3) == 0 ? 0.0 : lab_uniform(r, 0.0, 3.0),
                 way = lab_uniform(r, 0.0, 6.283185307179586);
    carom_ball_state *b = &s->ball[k].state;
    b->v[0] = speed * cos(way);
    b->v[1] = speed * sin(way);
    for (int axis = 0; axis < 3; axis++)
      b->w[axis] = lab_uniform(r, -300.0, 300.0) * (lab_whole(r, 0, 2) == 0);
  }
}

/* A line of touching balls, hit straight or nearly, along an axis or not. */
static void cradle(random_shot *s, lab_random *r) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &s->table);
  const double R = carom_ball_kind_of(CAROM_GAME_POOLTOOL_BILLIARD).radius,
               phi = lab_whole(r, 0, 1) ? 0.0 : lab_uniform(r, 0.0, 30.0);
  const double c = cos(phi / 57.29577951308232), n = sin(phi / 57.29577951308232), x = 0.2, y = 1.0;
  const int count = lab_whole(r, 2, 7);
  add(s, CAROM_GAME_POOLTOOL_BILLIARD, x, y);
  for (int k = 0; k < count; k++) {
    const double at = 0.3 + 2.0 * R * k;
    add(s, CAROM_GAME_POOLTOOL_BILLIARD, x + at * c, y + at * n);
  }
  any_cue(s, r, 0.3, 6.0);
  s->cue.phi = phi;
  s->cue.theta = 0.0;
  s->cue.a = lab_whole(r, 0, 1) ? 0.0 : s->cue.a;
  if (lab_whole(r, 0, 1))
    aim(s, r, 0.5);
}

/* A ball in contact with a rail or in a corner, with another in contact with it, hit or spinning
 * against it. */
static void frozen_to_rail(random_shot *s, lab_random *r) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &s->table);
  const double R = carom_ball_kind_of(CAROM_GAME_POOLTOOL_BILLIARD).radius, w = s->table.width;
  const double y = lab_whole(r, 0, 3) == 0 ? R : lab_uniform(r, 0.5, 2.0);
  add(s, CAROM_GAME_POOLTOOL_BILLIARD, w - R, y);
  if (lab_whole(r, 0, 1))
    add(s, CAROM_GAME_POOLTOOL_BILLIARD, w - 3.0 * R, y);
  if (lab_whole(r, 0, 1))
    add(s, CAROM_GAME_POOLTOOL_BILLIARD, w - R, y + 2.0 * R);
  if (lab_whole(r, 0, 1))
    add_anywhere(s, r, CAROM_GAME_POOLTOOL_BILLIARD);
  any_cue(s, r, 0.2, 5.0);
  s->cue.ball = lab_whole(r, 0, s->count - 1);
  if (lab_whole(r, 0, 1)) {
    s->cue.speed = 0.0;
    for (int k = 0; k < s->count; k++) {
      s->ball[k].state.w[0] = lab_uniform(r, -200.0, 200.0);
      s->ball[k].state.w[1] = lab_uniform(r, -200.0, 200.0);
    }
  }
}

/* Touching balls in a random cluster. */
static void cluster(random_shot *s, lab_random *r) {
  carom_table_make(any_pool_table(r), &s->table);
  const double R = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL).radius;
  add(s, CAROM_GAME_POOLTOOL_POOL, 0.5 * s->table.width, 0.3 * s->table.length);
  add(s, CAROM_GAME_POOLTOOL_POOL, 0.5 * s->table.width, 0.6 * s->table.length);
  const int count = lab_whole(r, 3, 12);
  for (int trial = 0; trial < 200 && s->count < count; trial++) {
    const carom_ball_state *to = &s->ball[lab_whole(r, 1, s->count - 1)].state;
    const double way = lab_uniform(r, 0.0, 6.283185307179586);
    const double x = to->r[0] + 2.0 * R * cos(way), y = to->r[1] + 2.0 * R * sin(way);
    if (is_free(s, x, y, 2.0 * R - 1e-12) && x > 2.0 * R && x < s->table.width - 2.0 * R &&
        y < 0.9 * s->table.length && y > 0.4)
      add(s, CAROM_GAME_POOLTOOL_POOL, x, y);
  }
  any_cue(s, r, 0.5, 8.0);
  aim(s, r, 6.0);
}

/* Balls that differ in mass and in all frictions and restitutions, in a layout or a cluster. */
static void unlike(random_shot *s, lab_random *r) {
  if (lab_whole(r, 0, 1))
    layout(s, r);
  else
    cluster(s, r);
  for (int k = 0; k < s->count; k++) {
    carom_ball_kind *b = &s->ball[k].kind;
    b->mass *= lab_uniform(r, 0.6, 1.6);
    b->mu_slide = lab_uniform(r, 0.05, 0.5);
    b->mu_roll = lab_uniform(r, 0.003, 0.03);
    b->mu_spin = lab_uniform(r, 0.003, 0.03);
    if (lab_whole(r, 0, 4) == 0)
      b->restitution = 0.0;
    else
      b->restitution = lab_whole(r, 0, 4) == 0 ? 1.0 : lab_uniform(r, 0.0, 1.0);
    b->restitution_cushion = lab_whole(r, 0, 4) == 0 ? 0.0 : lab_uniform(r, 0.0, 1.0);
    b->mu_cushion = lab_uniform(r, 0.0, 0.6);
  }
}

/* Slow balls close to pockets and jaws. */
static void near_pocket(random_shot *s, lab_random *r) {
  carom_table_make(any_pool_table(r), &s->table);
  for (int k = 0; k < 3; k++)
    add_anywhere(s, r, CAROM_GAME_POOLTOOL_POOL);
  const carom_pocket *p = &s->table.pocket[lab_whole(r, 0, (int)s->table.pockets - 1)];
  any_cue(s, r, 0.2, 3.0);
  s->cue.phi = 57.29577951308232 * atan2(p->centre[1] - s->ball[0].state.r[1],
                                         p->centre[0] - s->ball[0].state.r[0]) +
               lab_uniform(r, -3.0, 3.0);
}

/* Up to 32 touching balls, in a line or a triangle, in the open or against a rail, whose spin
 * presses them together. */
static void pressed(random_shot *s, lab_random *r) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &s->table);
  const int which = lab_whole(r, 0, 2),
            count = lab_whole(r, 2, which == 1 ? CAROM_BALLS_MOST / 2 : CAROM_BALLS_MOST),
            shape = lab_whole(r, 0, 2);
  const double R = carom_ball_kind_of(CAROM_GAME_POOLTOOL_BILLIARD).radius,
               spin = lab_uniform(r, 20.0, 300.0);
  for (int k = 0, row = 0, place = 0; k < count; k++, place++) {
    if (place > row) {
      row++;
      place = 0;
    }
    if (shape == 2)
      add(s, CAROM_GAME_POOLTOOL_BILLIARD, 0.5 * s->table.width + (2.0 * place - row) * R,
          0.5 + row * sqrt(3.0) * R);
    else
      add(s, CAROM_GAME_POOLTOOL_BILLIARD, 0.5, (shape == 0 ? R : 0.5) + 2.0 * R * k);
  }
  /* the first along the line, both ends against each other, or all at random; rolling along +y
   * has w_x < 0 */
  for (int k = 0; k < count; k++) {
    double *w = s->ball[k].state.w;
    if (which == 2) {
      w[0] = lab_uniform(r, -spin, spin);
      w[1] = lab_uniform(r, -spin, spin) * lab_whole(r, 0, 1);
    } else if (k == 0) {
      w[0] = -spin;
    } else if (which == 1 && k == count - 1) {
      w[0] = spin;
    }
  }
}

/* Balls on a lattice of their diameter, on a table whose sides are multiples of it, with
 * velocities along an axis or a diagonal: in doubles without rounding. Neighbours touch, balls
 * at the sides touch the rails, many meet at one instant, and rails end where balls meet them. */
static void coincident(random_shot *s, lab_random *r) {
  const double R = 0.03125, height = 0.0375;
  s->table = (carom_table){.width = 1.0, .length = 2.0};
  const double corner[5][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {0.0, 2.0}, {0.0, 0.0}};
  const int parts = lab_whole(r, 0, 1) ? 1 : 4; /* ends of rails at the positions of balls */
  for (int k = 0; k < 4 * parts; k++) {
    const double *p = corner[k / parts], *q = corner[k / parts + 1],
                 from = (double)(k % parts) / parts, step = 1.0 / parts;
    carom_rail *rail = &s->table.rail[s->table.rails++];
    *rail = (carom_rail){.height = height, .side = 1};
    for (int axis = 0; axis < 2; axis++) {
      rail->p[axis] = p[axis] + from * (q[axis] - p[axis]);
      rail->q[axis] = p[axis] + (from + step) * (q[axis] - p[axis]);
    }
  }
  if (lab_whole(r, 0, 1)) /* a post, met at its exact side */
    s->table.jaw[s->table.jaws++] =
        (carom_jaw){.centre = {0.5, 1.0}, .radius = 0.03125, .height = height};
  /* positions k + 1/2 diameters from the sides; where rails end and a post stands, whole ones */
  const double shift = lab_whole(r, 0, 1) ? R : 2.0 * R;
  const int count = lab_whole(r, 1, 12), lines = lab_whole(r, 1, 3);
  const double e = 0.25 * lab_whole(r, 0, 4);
  for (int trial = 0; trial < 100 && s->count < count; trial++) {
    const double x = shift + 2.0 * R * lab_whole(r, 0, 14),
                 y = shift + 2.0 * R * (lab_whole(r, 0, 1) ? 15 : lab_whole(r, 0, 30) / lines);
    if (!is_free(s, x, y, 2.0 * R) || (s->table.jaws > 0 && hypot(x - 0.5, y - 1.0) < 2.0 * R))
      continue;
    add(s, CAROM_GAME_POOLTOOL_POOL, x, y);
    carom_shot_ball *b = &s->ball[s->count - 1];
    b->kind.radius = b->state.r[2] = R;
    b->kind.restitution = b->kind.restitution_cushion = e;
    static const double speeds[] = {0.0, 0.0, 1.0, -1.0, 2.0, -0.5};
    const int way = lab_whole(r, 0, 2), roll = lab_whole(r, 0, 3);
    b->state.v[0] = way == 1 ? 0.0 : speeds[lab_whole(r, 0, 5)];
    b->state.v[1] = way == 0 ? 0.0 : speeds[lab_whole(r, 0, 5)];
    if (roll < 2) { /* rolling, or as much the other way */
      b->state.w[0] = (roll == 0 ? -32.0 : 32.0) * b->state.v[1];
      b->state.w[1] = (roll == 0 ? 32.0 : -32.0) * b->state.v[0];
    }
  }
}

/* The same in the air, where time is without rounding too, as g = 8 m/s^2: balls at the heights
 * of others, of the noses and of their tops, thrown upward, downward and level, next to each
 * other or a diameter apart; and a pocket with its edge at their positions. */
static void coincident_in_space(random_shot *s, lab_random *r) {
  coincident(s, r);
  const double R = 0.03125, nose = s->table.rail[0].height, lies = R;
  const double heights[] = {lies, 2.0 * R, 3.0 * R, 5.0 * R, nose, nose + R, nose + 2.0 * R};
  static const double speeds[] = {0.0, 0.0, 1.0, -1.0, 0.5};
  const double x = 0.25, y = 0.5 + 2.0 * R * lab_whole(r, 0, 1);
  if (lab_whole(r, 0, 1) && is_free(s, x, y, 2.0 * R))
    s->table.pocket[s->table.pockets++] = (carom_pocket){.centre = {x, y}, .radius = 2.0 * R};
  for (int k = 0; k < s->count; k++) {
    carom_shot_ball *b = &s->ball[k];
    b->kind.gravity = 8.0;
    b->kind.restitution_table = 0.25 * lab_whole(r, 0, 3);
    /* from the post, if there is one */
    const double *at = b->state.r, centre = hypot(at[0] - 0.5, at[1] - 1.0);
    const bool beside = at[0] < 2.0 * R || at[0] > 1.0 - 2.0 * R || at[1] < 2.0 * R ||
                        at[1] > 2.0 - 2.0 * R || centre < 4.0 * R;
    /* at a nose it would be in it */
    b->state.r[2] = heights[beside ? 3 * lab_whole(r, 0, 1) : lab_whole(r, 0, 6)];
    b->state.v[2] = b->state.r[2] > lies || lab_whole(r, 0, 1) ? speeds[lab_whole(r, 0, 4)] : 0.0;
    if (b->state.r[2] == lies && b->state.v[2] < 0.0)
      b->state.v[2] = -b->state.v[2];
    b->state.label =
        b->state.r[2] > lies || b->state.v[2] > 0.0 ? CAROM_BALL_AIRBORNE : b->state.label;
  }
}

/* A layout, and a cue that makes the ball jump; every third time at the next ball, from near. */
static void jump(random_shot *s, lab_random *r) {
  layout(s, r);
  any_cue(s, r, 0.5, 6.0);
  aim(s, r, 10.0);
  s->cue.theta = lab_uniform(r, 2.0, 80.0);
  any_tip(s, r, 0.5);
  for (int k = 0; k < s->count; k++)
    s->ball[k].kind.restitution_table = lab_whole(r, 0, 2) == 0 ? lab_uniform(r, 0.1, 0.98) : 0.0;
  s->cue.tip_time = (double[]){0.0, 0.0006, -1.0}[lab_whole(r, 0, 2)];
}

/* Whether a ball of radius R at a position is clear of all others, in space. */
static bool is_free_in_space(const random_shot *s, const double at[3], double R) {
  for (int k = 0; k < s->count; k++) {
    const double *p = s->ball[k].state.r;
    if (hypot(hypot(p[0] - at[0], p[1] - at[1]), p[2] - at[2]) < R + s->ball[k].kind.radius + 1e-9)
      return false;
  }
  return true;
}

/* Balls above each other that fall, on the cloth, on rails and into pockets; some lie below.
 * Alike, or unlike in radius and mass. */
static void falling(random_shot *s, lab_random *r) {
  carom_table_make(any_pool_table(r), &s->table);
  const int count = lab_whole(r, 2, 12), alike = lab_whole(r, 0, 1);
  const double wide = lab_uniform(r, 0.05, 0.5), width = s->table.width, length = s->table.length;
  const double x = lab_uniform(r, wide, width - wide), y = lab_uniform(r, wide, length - wide);
  for (int trial = 0; trial < 400 && s->count < count; trial++) {
    carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL);
    kind.radius *= alike ? 1.0 : lab_uniform(r, 0.9, 1.1);
    kind.mass *= alike ? 1.0 : lab_uniform(r, 0.7, 1.4);
    kind.restitution_table = lab_whole(r, 0, 2) == 0 ? lab_uniform(r, 0.1, 0.98) : 0.0;
    const double R = kind.radius;
    const bool lies = lab_whole(r, 0, 1);
    const double at[3] = {x + lab_uniform(r, -wide, wide), y + lab_uniform(r, -wide, wide),
                          lies ? R : R + lab_uniform(r, 0.0, 0.4)};
    if (at[0] < 0.1 || at[0] > width - 0.1 || at[1] < 0.1 || at[1] > length - 0.1 ||
        !is_free_in_space(s, at, R))
      continue;
    carom_shot_ball *b = &s->ball[s->count++];
    *b = (carom_shot_ball){.kind = kind};
    memcpy(b->state.r, at, sizeof at);
    for (int axis = 0; axis < 3; axis++) {
      if (axis < 2)
        b->state.v[axis] = lab_uniform(r, -2.0, 2.0);
      else
        b->state.v[axis] = lies ? 0.0 : lab_uniform(r, -3.0, 2.0);
      b->state.w[axis] = lab_whole(r, 0, 1) * lab_uniform(r, -150.0, 150.0);
    }
  }
}

/* Balls of unlike radii and masses on the cloth, one of them struck, with the butt raised or
 * not. */
static void unlike_radii(random_shot *s, lab_random *r) {
  layout(s, r);
  for (int k = 0; k < s->count; k++) {
    carom_shot_ball *b = &s->ball[k];
    b->kind.radius *= lab_uniform(r, 0.9, 1.0);
    b->kind.mass *= lab_uniform(r, 0.7, 1.4);
    b->state.r[2] = b->kind.radius;
  }
  s->table.ball_radius = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL).radius;
  s->cue.theta *= lab_whole(r, 0, 1);
}

static const struct {
  const char *name;
  void (*make)(random_shot *shot, lab_random *r);
} kinds[] = {
    {"nineball", nineball},
    {"eightball", eightball},
    {"tenball", tenball},
    {"frozen_rack", frozen_rack},
    {"snooker", snooker},
    {"layout", layout},
    {"threecushion", threecushion},
    {"moving", moving},
    {"cradle", cradle},
    {"frozen_to_rail", frozen_to_rail},
    {"cluster", cluster},
    {"unlike", unlike},
    {"near_pocket", near_pocket},
    {"pressed", pressed},
    {"coincident", coincident},
    {"jump", jump},
    {"falling", falling},
    {"unlike_radii", unlike_radii},
    {"coincident_air", coincident_in_space},
};
enum { IN_SPACE_ONLY = 4 };

int random_shot_kinds(void) {
  return random_shot_kinds_in_space() - IN_SPACE_ONLY;
}
int random_shot_kinds_in_space(void) {
  return sizeof kinds / sizeof kinds[0];
}
const char *random_shot_kind(int kind) {
  return kinds[kind].name;
}

void random_shot_make(int kind, uint64_t seed, uint64_t index, random_shot *shot) {
  lab_random r = {seed ^ (index * 0xd1342543de82ef95u + (uint64_t)kind)};
  lab_bits(&r);
  memset(shot, 0, sizeof *shot);
  shot->kind = kinds[kind].name;
  kinds[kind].make(shot, &r);
}
