/* Jaws where they continue rails, seams.c: the rebounds of a ball on both sides of a seam are one,
 * on the tables that are built in, on a polygon, and with jaws so short that passages overlap. */
#include "shot_support.h"
#include "table/table.h"

/* A seam: the end of a rail, the normal there, and the direction from the rail to the jaw. */
typedef struct seam {
  int rail, jaw;
  double end[2], normal[2], along[2];
} seam;

enum { SEAMS_MOST = 2 * CAROM_JAWS_MOST };

static int list_seams(const carom_table *t, seam seams[SEAMS_MOST]) {
  int count = 0;
  for (int j = 0; j < t->jaws; j++)
    for (int k = 0; k < 2 * t->rails; k++) {
      const carom_rail *rail = &t->rail[k / 2];
      const double *end = k % 2 == 0 ? rail->p : rail->q, *far = k % 2 == 0 ? rail->q : rail->p;
      const double x = end[0] - t->jaw[j].centre[0], y = end[1] - t->jaw[j].centre[1],
                   rho = hypot(x, y), e_x = end[0] - far[0], e_y = end[1] - far[1],
                   length = hypot(e_x, e_y);
      if (fabs(rho - t->jaw[j].radius) < 1e-6 && fabs(x * e_x + y * e_y) < 1e-6 * length)
        seams[count++] =
            (seam){k / 2, j, {end[0], end[1]}, {x / rho, y / rho}, {e_x / length, e_y / length}};
    }
  return count;
}

/* How a ball comes to a seam: radians from the normal; in units of its speed the spins and the
 * speed upward; m above the cloth. */
typedef struct approach {
  double speed, angle, spin[3], up, height;
} approach;

static approach draw(random_source *random) {
  approach a = {.speed = pow(10.0, random_between(random, -0.7, 0.8)),
                .angle = random_between(random, -1.3, 1.3)};
  random_vector(random, 3, -1.0, 1.0, a.spin);
  const double lot = random_between(random, 0.0, 3.0);
  if (lot > 1.0) {
    a.height = lot > 2.0 ? random_between(random, 1e-3, 8e-3) : random_between(random, 1e-5, 1e-3);
    a.up = random_between(random, -0.05, 0.05);
  }
  return a;
}

/* Rolls or throws a ball at a nose, `place` beyond a seam along the rail. The first event with a
 * cushion, or NULL. */
static const carom_event *meet(const carom_table *t, carom_shot_ball ball, const seam *s,
                               const approach *a, double place, const carom_shot_options *options) {
  const double R = ball.kind.radius, way = 4e-3;
  const double c = cos(a->angle), d = sin(a->angle);
  for (int k = 0; k < 2; k++) {
    const double toward = -c * s->normal[k] + d * s->along[k];
    ball.state.v[k] = a->speed * toward;
    ball.state.r[k] = s->end[k] + place * s->along[k] + R * s->normal[k] - way * toward;
  }
  for (int k = 0; k < 3; k++)
    ball.state.w[k] = a->spin[k] * a->speed / R;
  ball.state.r[2] = R + a->height;
  ball.state.v[2] = a->up * a->speed;
  ball.state.label = a->height > 0.0 ? CAROM_BALL_AIRBORNE : CAROM_BALL_SLIDING;
  carom_shot_options first = *options;
  first.events_most = 4;
  carom_shot shot = {.events = events, .room = ROOM};
  const carom_status status = carom_shoot(t, &ball, 1, NULL, &first, &shot);
  if (status < 0 && status != CAROM_ERROR_TOO_MANY_EVENTS)
    return NULL;
  for (int64_t k = 0; k < shot.count && k < 4; k++)
    if (events[k].type == CAROM_EVENT_RAIL || events[k].type == CAROM_EVENT_JAW)
      return &events[k];
  return NULL;
}

/* Of v and R w over the speed, of all seams of a table so far. Steps of Euler's model jump. */
static double largest_jump, largest_of_steps;

/* Halves the way between a rail and its jaw down to neighbouring places, and compares the rebounds.
 * False where something else is met. */
static bool compare_at(const carom_table *t, const carom_shot_ball *ball, const seam *s,
                       const approach *a, const carom_shot_options *options) {
  static const int types[2] = {CAROM_EVENT_RAIL, CAROM_EVENT_JAW};
  const int parts[2] = {s->rail, s->jaw};
  double places[2] = {-5e-4, 5e-4};
  carom_event last[2];
  for (int side = 0; side < 2; side++) {
    const carom_event *e = meet(t, *ball, s, a, places[side], options);
    if (e == NULL || e->type != types[side] || e->b != parts[side])
      return false;
    last[side] = *e;
  }
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (places[0] + places[1]);
    const carom_event *e = meet(t, *ball, s, a, middle, options);
    if (e == NULL)
      return false;
    const int side = e->type == CAROM_EVENT_JAW;
    if (e->b != parts[side])
      return false;
    places[side] = middle;
    last[side] = *e;
  }

  double most = 0.0;
  const carom_ball_state *rail = &last[0].after[0], *jaw = &last[1].after[0];
  for (int k = 0; k < 3; k++) {
    most = fmax(most, fabs(rail->v[k] - jaw->v[k]));
    most = fmax(most, ball->kind.radius * fabs(rail->w[k] - jaw->w[k]));
  }
  double *largest =
      options->cushion_model == CAROM_SHOT_CUSHION_EULER ? &largest_of_steps : &largest_jump;
  *largest = fmax(*largest, most / a->speed);
  for (int side = 0; side < 2; side++) {
    const double was = state_energy(&ball->kind, &last[side].before[0]);
    ck_assert_double_le(state_energy(&ball->kind, &last[side].after[0]), was * (1.0 + 1e-12));
  }
  return true;
}

/* All seams of a table, by each model. */
static void compare_table(const carom_table *t, carom_game game, const char *name,
                          random_source *random) {
  seam seams[SEAMS_MOST];
  const int count = list_seams(t, seams);
  int compared = 0, draws = 0;
  largest_jump = largest_of_steps = 0.0;
  for (int model = CAROM_SHOT_CUSHION_DEFAULT; model <= 1 + (int)CAROM_CUSHION_SMOOTH; model++)
    for (int k = 0; k < count; k++)
      for (int n = 0; n < draws_of_test(1, 4); n++) {
        const carom_shot_options options = {.cushion_model = (carom_shot_cushion)model};
        const carom_shot_ball ball = {.kind = carom_ball_kind_of(game)};
        const approach a = draw(random);
        draws++;
        compared += compare_at(t, &ball, &seams[k], &a, &options);
      }
  printf(
      "%s: %d seams, %d of %d draws meet rail and jaw; jumps up to %.1e of the speed, by Euler's "
      "steps %.1e\n",
      name, count, compared, draws, largest_jump, largest_of_steps);
  fflush(stdout);
  ck_assert_int_gt(compared, draws / 2);
  ck_assert_double_lt(largest_jump, 1e-6);
  ck_assert_double_lt(largest_of_steps, 1e-3);
}

TEST(built_in_tables) {
  random_source random = {test_seed()};
  carom_table t;
  for (int kind = 0; carom_table_make((carom_table_kind)kind, &t) == CAROM_OK; kind++) {
    carom_game game = CAROM_GAME_POOL;
    if (kind == CAROM_TABLE_SNOOKER)
      game = CAROM_GAME_SNOOKER;
    else if (kind == CAROM_TABLE_BLACKBALL)
      game = CAROM_GAME_BLACKBALL;
    else if (kind == CAROM_TABLE_PYRAMID)
      game = CAROM_GAME_PYRAMID;
    if (t.pockets > 0)
      compare_table(&t, game, carom_word(CAROM_WORDS_TABLE, kind), &random);
  }
}

/* Each part has its own numbers. */
static void differ(carom_table *t, random_source *random) {
  for (int k = 0; k < t->rails; k++) {
    t->rail[k].mu_cushion = random_between(random, 0.05, 0.4);
    t->rail[k].restitution = random_between(random, 0.5, 0.95);
  }
  for (int k = 0; k < t->jaws; k++) {
    t->jaw[k].mu_cushion = random_between(random, 0.05, 0.4);
    t->jaw[k].restitution = random_between(random, 0.5, 0.95);
  }
}

TEST(parts_that_all_differ) {
  random_source random = {test_seed()};
  carom_measures m;
  carom_table t;
  carom_table_measures(CAROM_TABLE_POOL_9FT, &m);
  for (int short_arcs = 0; short_arcs < 2; short_arcs++) {
    m.corner_jaw = short_arcs ? 4e-3 : 0.05;
    m.side_jaw = short_arcs ? 1e-3 : 0.02;
    expect_ok(carom_table_measured(&m, 0.028575, &t, NULL));
    differ(&t, &random);
    compare_table(&t, CAROM_GAME_POOL, short_arcs ? "short arcs" : "long arcs", &random);
  }
  static const carom_corner corners[] = {
      {0.0, 0.0, 0.11}, {1.4, 0.0, 0.0}, {1.9, 1.0, 0.12}, {0.9, 1.8, 0.13}, {0.0, 1.2, 0.0}};
  expect_ok(carom_table_polygon(corners, COUNT_OF(corners), 0.0363, 0.015, 0.028575, &t, NULL));
  differ(&t, &random);
  compare_table(&t, CAROM_GAME_POOL, "polygon", &random);
}

/* Whether a rebound from a jaw, `degrees` along its arc from a seam, changes with the numbers of
 * the rail. */
static bool depends_on_rail(const carom_table *t, const seam *s, double degrees,
                            const carom_shot_options *options) {
  const carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL)};
  const double turn = degrees * 0.017453292519943295,
               reach = t->jaw[s->jaw].radius + ball.kind.radius;
  const approach a = {.speed = 1.0, .angle = -turn, .spin = {0.2, 0.1, 0.3}};
  seam here = *s;
  for (int k = 0; k < 2; k++)
    here.end[k] += reach * ((cos(turn) - 1.0) * s->normal[k] + sin(turn) * s->along[k]);
  carom_table changed = *t;
  changed.rail[s->rail].restitution = 0.5;
  const carom_event *e = meet(t, ball, &here, &a, 0.0, options);
  ck_assert_ptr_nonnull(e);
  ck_assert_int_eq(e->type, CAROM_EVENT_JAW);
  const carom_ball_state after = e->after[0];
  e = meet(&changed, ball, &here, &a, 0.0, options);
  return memcmp(after.v, e->after[0].v, sizeof after.v) != 0;
}

/* A passage ends at a chord of 8 mm, which is 22 degrees of a corner's arc of 20.95 mm; the world
 * pooltool has none. */
TEST(passage_of_8_mm) {
  carom_table t;
  seam seams[SEAMS_MOST];
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  const carom_shot_options usual = {0}, pooltool = {.world = CAROM_WORLD_POOLTOOL};
  list_seams(&t, seams);
  ck_assert(!carom_is_cut(&t, seams[0].rail));
  const double end = 2.0 * asin(4e-3 / t.jaw[seams[0].jaw].radius) / 0.017453292519943295;
  ck_assert(depends_on_rail(&t, &seams[0], 1.0, &usual));
  ck_assert(depends_on_rail(&t, &seams[0], end - 0.1, &usual));
  ck_assert(!depends_on_rail(&t, &seams[0], end + 0.1, &usual));
  ck_assert(!depends_on_rail(&t, &seams[0], 1.0, &pooltool));
}

/* Rails and jaws may be 0.1 mm apart. */
TEST(tables_to_tenths_of_a_millimetre) {
  carom_table t;
  carom_seam found[CAROM_SEAMS_MOST];
  for (int k = 0; k < 2; k++) {
    carom_table_make(CAROM_TABLE_POOL_9FT, &t);
    for (int j = 0; j < t.jaws; j++) {
      ck_assert_int_eq(carom_seams_of(&t, j, found), 2);
      t.jaw[j].centre[k] += 0.9e-4;
      ck_assert_int_eq(carom_seams_of(&t, j, found), 2);
      t.jaw[j].centre[k] += 1e-4;
      ck_assert_int_lt(carom_seams_of(&t, j, found), 2);
    }
  }
}
