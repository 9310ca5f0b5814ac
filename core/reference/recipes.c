/* Families of layouts in which contacts come near each other in time: a strike in company or at a
 * cushion, balls that meet others with gaps, balls at cushions, at their ends and in corners, hops
 * and falls. */
#include "recipes.h"
#include "random.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double degree = 0.017453292519943295;

/* A gap: none, a hair, or wide. */
static double any_gap(lab_random *r, double most) {
  switch (lab_whole(r, 0, 2)) {
  case 0:
    return 0.0;
  case 1:
    return lab_uniform(r, 0.0, 2e-4);
  default:
    return lab_uniform(r, 0.0, most);
  }
}

/* Balls `first` to `last` near earlier ones, the first of them ahead of ball 0. */
static void add_company(recipe *r, lab_random *random, int first, int last, double ahead) {
  for (int k = first; k <= last; k++) {
    r->anchor[k] = k == first ? first - 1 : lab_whole(random, 0, k - 1);
    r->gap[k] = any_gap(random, 5e-3);
    r->bearing[k] =
        k == first ? ahead + lab_uniform(random, -80.0, 80.0) : lab_uniform(random, -180.0, 180.0);
  }
  r->count = last + 1;
}

static void add_cue(recipe *r, lab_random *random, double phi) {
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  r->speed = lab_uniform(random, 0.5, 8.0);
  r->phi = phi;
  r->a = lab_uniform(random, -0.3, 0.3);
  r->b = lab_uniform(random, -0.3, 0.3);
  r->follow = cue.follow;
  r->mass = cue.mass;
  switch (lab_whole(random, 0, 3)) {
  case 0:
    r->theta = pow(10.0, lab_uniform(random, -7.0, 0.0));
    break;
  case 1:
    r->theta = lab_uniform(random, 1.0, 60.0);
    break;
  default:
    break;
  }
}

/* The last ball moves. */
static void add_motion(recipe *r, lab_random *random, double heading) {
  r->pace = lab_uniform(random, 0.3, 6.0);
  r->heading = heading;
  r->roll = lab_whole(random, 0, 1) ? 1.0 : lab_uniform(random, -1.0, 2.0);
  r->side = lab_whole(random, 0, 1) ? 0.0 : lab_uniform(random, -1.0, 1.0);
}

/* A ball that comes at one that is in company. */
static void add_attacker(recipe *r, lab_random *random, int target, double heading) {
  const int k = r->count++;
  r->anchor[k] = target;
  r->gap[k] = lab_uniform(random, 1e-3, 0.03);
  r->bearing[k] = heading + 180.0 + lab_uniform(random, -50.0, 50.0);
  add_motion(r, random, heading);
}

/* Ball 0 next to a cushion, far from its ends. */
static void put_at_cushion(recipe *r, lab_random *random) {
  r->table = lab_whole(random, 0, 1) ? CAROM_TABLE_POOL_9FT : CAROM_TABLE_THREECUSHION;
  r->rail = lab_whole(random, 0, r->table == CAROM_TABLE_POOL_9FT ? 5 : 3);
  r->end = lab_whole(random, 0, 1);
  r->along = lab_uniform(random, 0.3, 0.7);
  r->away = any_gap(random, 0.02);
}

/* ---- Families. Bearings, phi and headings of balls at cushions are taken from the direction into
 * the cushion. */

static void company(recipe *r, lab_random *random) {
  add_company(r, random, 1, lab_whole(random, 1, 4), 90.0);
  add_cue(r, random, 90.0);
}

static void cushion(recipe *r, lab_random *random) {
  put_at_cushion(r, random);
  add_cue(r, random, lab_uniform(random, -75.0, 75.0));
}

static void cushion_company(recipe *r, lab_random *random) {
  put_at_cushion(r, random);
  add_company(r, random, 1, lab_whole(random, 1, 2), lab_whole(random, 0, 1) ? 90.0 : 180.0);
  add_cue(r, random, lab_uniform(random, -75.0, 75.0));
}

static void corner(recipe *r, lab_random *random) {
  put_at_cushion(r, random);
  r->table = CAROM_TABLE_THREECUSHION;
  r->rail %= 4;
  r->along = carom_ball_kind_of(CAROM_GAME_POOL).radius + any_gap(random, 0.02);
  if (lab_whole(random, 0, 1))
    add_cue(r, random, lab_uniform(random, -180.0, 180.0));
  else
    add_motion(r, random, lab_uniform(random, -75.0, 75.0));
}

static void cluster(recipe *r, lab_random *random) {
  add_company(r, random, 1, lab_whole(random, 1, 3), 90.0);
  add_attacker(r, random, 0, 90.0);
}

static void seam(recipe *r, lab_random *random) {
  put_at_cushion(r, random);
  r->table = CAROM_TABLE_POOL_9FT;
  r->along = lab_uniform(random, -0.01, 0.02);
  r->away = lab_uniform(random, 2e-3, 0.03);
  add_motion(r, random, lab_uniform(random, -60.0, 60.0));
}

static void cushion_between(recipe *r, lab_random *random) {
  put_at_cushion(r, random);
  if (lab_whole(random, 0, 1))
    add_company(r, random, 1, 1, lab_whole(random, 0, 1) ? 90.0 : -90.0);
  add_attacker(r, random, 0, lab_uniform(random, -60.0, 60.0));
}

static void hop(recipe *r, lab_random *random) {
  const int others = lab_whole(random, 0, 2);
  if (lab_whole(random, 0, 1))
    put_at_cushion(r, random);
  if (others > 0)
    add_company(r, random, 1, others, 90.0);
  for (int k = 1; k <= others; k++)
    r->gap[k] *= 20.0;
  add_cue(r, random, lab_uniform(random, 60.0, 120.0));
  r->theta = lab_uniform(random, 3.0, 75.0);
  r->time = 0.25;
}

static void fall(recipe *r, lab_random *random) {
  if (lab_whole(random, 0, 1))
    put_at_cushion(r, random);
  if (lab_whole(random, 0, 1))
    add_company(r, random, 1, 1, 0.0);
  add_attacker(r, random, 0, lab_uniform(random, -60.0, 60.0));
  r->height = lab_uniform(random, 1e-3, 0.08);
  r->rise = lab_uniform(random, -1.0, 1.0);
  r->time = 0.15;
}

/* A rack of three to five rows, its balls with one gap, and a ball that comes at its head. */
static void rack(recipe *r, lab_random *random) {
  const int rows = lab_whole(random, 3, 5);
  const double gap = any_gap(random, 5e-4);
  int k = 0;
  for (int row = 0; row < rows; row++)
    for (int place = 0; place <= row; place++, k++) {
      /* behind the ball before it in the row, or from the begin of the row before */
      r->anchor[k] = place > 0 ? k - 1 : k - row;
      r->bearing[k] = place > 0 ? 0.0 : 120.0;
      r->gap[k] = gap;
    }
  r->count = k;
  add_attacker(r, random, 0, 90.0);
}

/* Company of unlike radii and masses. */
static void unlike(recipe *r, lab_random *random) {
  if (lab_whole(random, 0, 1))
    company(r, random);
  else
    cluster(r, random);
  for (int k = 0; k < r->count; k++) {
    r->radius[k] = lab_whole(random, 0, 1) ? lab_uniform(random, 0.7, 1.3) : 1.0;
    r->weight[k] = lab_whole(random, 0, 1) ? lab_uniform(random, 0.5, 2.0) : 1.0;
  }
}

/* Other models of cushions and of friction. */
static void models(recipe *r, lab_random *random) {
  static const carom_shot_cushion cushions[] = {CAROM_SHOT_CUSHION_MATHAVAN,
                                                CAROM_SHOT_CUSHION_STRONGE, CAROM_SHOT_CUSHION_HAN};
  if (lab_whole(random, 0, 1))
    cushion_between(r, random);
  else
    cushion_company(r, random);
  r->cushion_model = (int)cushions[lab_whole(random, 0, 2)];
  r->friction = lab_whole(random, 0, 1);
}

static const struct {
  const char *name;
  void (*make)(recipe *r, lab_random *random);
} families[] = {
    {"company", company},
    {"cushion", cushion},
    {"cushion and company", cushion_company},
    {"corner", corner},
    {"cluster", cluster},
    {"seam", seam},
    {"between", cushion_between},
    {"hop", hop},
    {"fall", fall},
    {"rack", rack},
    {"unlike", unlike},
    {"models", models},
};
enum { FAMILIES = sizeof families / sizeof families[0], OF_FEW = 9 };

/* Whether its balls lie apart from each other and from the cushions. */
static bool has_room(const recipe *r) {
  recipe_layout l;
  carom_shot shot = {0};
  recipe_lay(r, &l);
  l.options.events_most = 1;
  const carom_status status = carom_shoot(&l.table, l.ball, l.count, &l.cue, &l.options, &shot);
  return status != CAROM_ERROR_OVERLAP && status != CAROM_ERROR_OFF_TABLE;
}

static void draw(int family, lab_random *random, recipe *r) {
  *r = (recipe){.family = families[family].name,
                .count = 1,
                .table = CAROM_TABLE_POOL_9FT,
                .rail = -1,
                .restitution = carom_ball_kind_of(CAROM_GAME_POOL).restitution,
                .time = 0.05};
  families[family].make(r, random);
}

int recipe_families(void) {
  return FAMILIES;
}

const char *recipe_family(int family) {
  return families[family].name;
}

void recipe_make_of(int family, uint64_t seed, uint64_t index, recipe *r) {
  lab_random random = {seed ^ (index * 0xd1342543de82ef95u)};
  lab_bits(&random);
  do
    draw(family, &random, r);
  while (!has_room(r));
}

void recipe_make(uint64_t seed, uint64_t index, recipe *r) {
  recipe_make_of((int)(index % OF_FEW), seed, index, r);
}

/* ---- Numbers */

static void add(const recipe *r, const char *name, const double *number, double low, double high,
                recipe_number numbers[RECIPE_NUMBERS], int *count) {
  const size_t offset = (size_t)((const char *)number - (const char *)r);
  numbers[(*count)++] = (recipe_number){name, offset, low, high};
}

int recipe_numbers(const recipe *r, recipe_number numbers[RECIPE_NUMBERS]) {
  int count = 0;
  const bool attacked = r->speed == 0.0 && r->count > 1;
  for (int k = 1; k < r->count; k++) {
    if (attacked && k == r->count - 1)
      continue;
    const double most = strcmp(r->family, "hop") == 0 ? 0.1 : 5e-3;
    add(r, "gap", &r->gap[k], 0.0, r->gap[k] < 2e-4 ? 3e-4 : most, numbers, &count);
  }
  const int last = r->count - 1;
  if (last > 0)
    add(r, "restitution", &r->restitution, 0.8, 1.0, numbers, &count);
  if (last > 0)
    add(r, "bearing", &r->bearing[last], r->bearing[last] - 40.0, r->bearing[last] + 40.0, numbers,
        &count);
  if (r->rail >= 0) {
    const bool at_end = strcmp(r->family, "seam") == 0;
    const double ends = at_end ? 0.02 : 3e-3;
    add(r, "along", &r->along, r->along - ends, r->along + ends, numbers, &count);
    add(r, "away", &r->away, 0.0, r->away < 2e-4 ? 3e-4 : 0.02, numbers, &count);
  }
  if (r->speed > 0.0) {
    add(r, "speed", &r->speed, 0.3, 8.0, numbers, &count);
    add(r, "phi", &r->phi, r->phi - 20.0, r->phi + 20.0, numbers, &count);
    add(r, "theta", &r->theta, 0.0, r->theta < 1e-3 ? 1e-5 : 75.0, numbers, &count);
    add(r, "a", &r->a, -0.5, 0.5, numbers, &count);
    add(r, "b", &r->b, -0.5, 0.5, numbers, &count);
    add(r, "follow", &r->follow, 1e-3, 0.05, numbers, &count);
    add(r, "mass", &r->mass, 0.3, 0.7, numbers, &count);
  } else {
    add(r, "pace", &r->pace, 0.1, 6.0, numbers, &count);
    add(r, "heading", &r->heading, r->heading - 20.0, r->heading + 20.0, numbers, &count);
    add(r, "roll", &r->roll, -1.0, 2.0, numbers, &count);
    add(r, "side", &r->side, -1.0, 1.0, numbers, &count);
  }
  if (r->height > 0.0) {
    add(r, "height", &r->height, 1e-4, 0.08, numbers, &count);
    add(r, "rise", &r->rise, -1.0, 1.0, numbers, &count);
  }
  return count;
}

/* ---- Layouts */

/* The position of ball 0, and the bearing of the direction into its cushion. */
static double put_first(const recipe *r, const carom_table *t, double R, double spot[2]) {
  if (r->rail < 0) {
    spot[0] = 0.5 * t->width;
    spot[1] = 0.5 * t->length;
    return 0.0;
  }
  const carom_rail *rail = &t->rail[r->rail];
  const double *start = rail->p, *finish = rail->q;
  if (r->end) {
    start = rail->q;
    finish = rail->p;
  }
  const double x = finish[0] - start[0], y = finish[1] - start[1], size = sqrt(x * x + y * y);
  double out[2] = {-y / size, x / size};
  if (out[0] * (0.5 * t->width - start[0]) + out[1] * (0.5 * t->length - start[1]) < 0.0) {
    out[0] = -out[0];
    out[1] = -out[1];
  }
  spot[0] = start[0] + r->along * x / size + (R + r->away) * out[0];
  spot[1] = start[1] + r->along * y / size + (R + r->away) * out[1];
  return atan2(-out[1], -out[0]) / degree;
}

void recipe_lay(const recipe *r, recipe_layout *l) {
  memset(l, 0, sizeof *l);
  carom_table_make((carom_table_kind)r->table, &l->table);
  l->count = r->count;
  l->options.time_most = r->time;
  l->options.cushion_model = (carom_shot_cushion)r->cushion_model;
  l->options.friction = (carom_ball_friction)r->friction;
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const double R = kind.radius, mass = kind.mass;
  double turn = 0.0;
  kind.restitution = r->restitution;

  /* the balls, each from an earlier one */
  for (int k = 0; k < r->count; k++) {
    carom_ball_state *s = &l->ball[k].state;
    kind.radius = r->radius[k] > 0.0 ? R * r->radius[k] : R;
    kind.mass = r->weight[k] > 0.0 ? mass * r->weight[k] : mass;
    l->ball[k].kind = kind;
    s->r[2] = kind.radius;
    if (k == 0) {
      turn = put_first(r, &l->table, R, s->r);
      continue;
    }
    const double *base = l->ball[r->anchor[k]].state.r, way = (turn + r->bearing[k]) * degree;
    const double base_radius = l->ball[r->anchor[k]].kind.radius,
                 reach = kind.radius + base_radius + r->gap[k], lift = kind.radius - base_radius;
    const double across = lift != 0.0 ? sqrt(reach * reach - lift * lift) : reach;
    s->r[0] = base[0] + across * cos(way);
    s->r[1] = base[1] + across * sin(way);
  }

  l->cue = carom_cue_of(CAROM_GAME_POOL);
  l->cue.speed = r->speed;
  l->cue.phi = turn + r->phi;
  l->cue.theta = r->theta;
  l->cue.a = r->a;
  l->cue.b = r->b;
  l->cue.follow = r->follow;
  l->cue.mass = r->mass > 0.0 ? r->mass : l->cue.mass;
  if (r->speed > 0.0)
    return;

  /* the motion of the last ball */
  carom_ball_state *s = &l->ball[r->count - 1].state;
  const double way = (turn + r->heading) * degree;
  s->v[0] = r->pace * cos(way);
  s->v[1] = r->pace * sin(way);
  s->w[0] = -r->roll * s->v[1] / R;
  s->w[1] = r->roll * s->v[0] / R;
  s->w[2] = r->side * r->pace / R;
  if (r->height > 0.0) {
    s->r[2] += r->height;
    s->v[2] = r->rise;
    s->label = CAROM_BALL_AIRBORNE;
  }
}
