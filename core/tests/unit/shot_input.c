/* Bad input of a shot next to the rows of refusals.txt: each number out of its range, with its own
 * status and place, and nothing else written. Many times and the built-in tables, too. */
#include "functions.h"

/* The shot is rejected for this reason, at this ball or part. */
static void expect(carom_status expected, int index) {
  ck_assert_int_eq(carom_shot_check(&table, balls, count, &cue, &options, &where), expected);
  ck_assert_int_eq(where, index);
  shot.count = 77;
  ck_assert_int_eq(carom_shoot(&table, balls, count, &cue, &options, &shot), expected);
  ck_assert_int_eq(shot.count, 0);
  ck_assert_int_eq(shoot_pair(), expected);
}

/* The same of a field that has its own status, whose name and text say the field: `text` is
 * "cue.mass must". */
static void expect_named(const char *field, carom_status error) {
  snprintf(text, sizeof text, "%s must", field);
  ck_assert_ptr_nonnull(strstr(carom_status_name(error), strchr(field, '.') + 1));
  ck_assert_ptr_eq(strstr(carom_status_string(error), text), carom_status_string(error));
}
/* Each number of a struct of the set-up, beyond its range, is rejected by its status, and told. */
static void expect_ranges(carom_part_kind part_kind, int index, void *object, const char *name) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(part_kind, k)) != NULL; k++)
    for (int way = 0; set_up(), set_bad(object, n, way); way++) {
      char field[64];
      const bool counted = part_kind >= CAROM_PART_RAIL && part_kind <= CAROM_PART_BALL;
      expect(n->error, counted || part_kind == CAROM_PART_STATE ? index : -1);
      ck_assert_int_eq(
          carom_shot_fault(&table, balls, count, &cue, &options, &fault, text, sizeof text),
          n->error);
      ck_assert_ptr_eq(fault.row, n);
      ck_assert_int_eq(fault.part.kind, part_kind);
      ck_assert_int_eq(fault.part.index, index);
      ck_assert_uint_eq(carom_number_range(n, text, sizeof text), strlen(text));
      snprintf(field, sizeof field, "%s.%s", name, n->name);
      if (name[0] != '\0' && n->error != CAROM_ERROR_MISCUE)
        expect_named(field, n->error);
    }
}

TEST(ranges) {
  const struct {
    carom_part_kind part_kind;
    int index;
    void *object;
    const char *name;
  } parts[] = {{CAROM_PART_BALL, 9, &balls[9].kind, ""},
               {CAROM_PART_STATE, 2, &balls[2].state, ""},
               {CAROM_PART_CUE, 0, &cue, "cue"},
               {CAROM_PART_TABLE, 0, &table, ""},
               {CAROM_PART_RAIL, 4, &table.rail[4], ""},
               {CAROM_PART_JAW, 5, &table.jaw[5], ""},
               {CAROM_PART_POCKET, 1, &table.pocket[1], ""},
               {CAROM_PART_OPTIONS, 0, &options, "options"}};
  for (size_t k = 0; k < COUNT_OF(parts); k++)
    expect_ranges(parts[k].part_kind, parts[k].index, parts[k].object, parts[k].name);
  expect_named("cue.ball", CAROM_ERROR_CUE_BALL);
  expect_named("cue.ball", CAROM_ERROR_CUE_BALL_OUT);
  expect_named("shot.room", CAROM_ERROR_ROOM);
}

/* Exactly as many parts as there is room for, and a table of posts with a pocket between them. */
TEST(many_parts_and_few) {
  set_up();
  while (table.rails < CAROM_RAILS_MOST)
    table.rail[table.rails++] = table.rail[0];
  while (table.jaws < CAROM_JAWS_MOST)
    table.jaw[table.jaws++] = table.jaw[0];
  while (table.pockets < CAROM_POCKETS_MOST)
    table.pocket[table.pockets++] = table.pocket[0];
  expect_ok(carom_shot_check(&table, balls, count, &cue, &options, &where));
  ck_assert_int_eq(where, -1);
  expect_ok(carom_shoot(&table, balls, count, &cue, &options, &shot));
  expect_ok(shoot_pair());
  table = (carom_table){
      .jaws = 2, .pockets = 1, .jaw = {{.centre = {-5.0, -5.0}, .radius = 0.1, .height = 0.036}}};
  table.jaw[1] = (carom_jaw){.centre = {5.0, 5.0}, .radius = 0.1, .height = 0.036};
  table.pocket[0] = (carom_pocket){{3.0, -2.0}, 1.0, 0.08};
  expect_ok(carom_shot_check(&table, balls, count, NULL, NULL, NULL));
}

/* Room for events that are nowhere, and less than none; a batch without a part, without shots, and
 * one that is good. */
TEST(calls) {
  const int64_t rooms[] = {5, -1};
  for (int k = 0; k < 2; k++) {
    set_up();
    shot = (carom_shot){.room = rooms[k], .count = 77, .state = &state};
    const carom_status returned[] = {carom_shoot(&table, balls, count, &cue, NULL, &shot),
                                     carom_shoot_batch(&job),
                                     carom_shot_continue(&table, balls, count, NULL, &shot),
                                     carom_shot_at(balls, count, &shot, 0.0, states), statuses[0]};
    for (int call = 0; call < 5; call++)
      ck_assert_int_eq(returned[call], CAROM_ERROR_ROOM);
    ck_assert_int_eq(shot.count, 77);
  }
  for (int k = 0; k < 3; k++) {
    set_up();
    job.table = k == 0 ? NULL : &table;
    job.balls = k == 1 ? NULL : balls;
    job.shots = k == 2 ? NULL : &shot;
    ck_assert_int_eq(carom_shoot_batch(&job), CAROM_ERROR_NULL);
    ck_assert_int_eq(statuses[0], 77);
  }
  expect_ok(carom_shoot_batch(&(carom_shot_job){0}));
  set_up();
  expect_ok(carom_shoot(&table, balls, count, NULL, NULL, &shot));
  ck_assert_int_eq(shot.count, 0);
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_BALLS), "count"));
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_SHOT_OPTIONS), "reserved"));
}

static carom_status states_at(const double *looks, size_t many, carom_ball_state *at) {
  return carom_shot_frames(balls, count, &shot, looks, many, NULL, at, NULL);
}

static carom_status state_at(double time, carom_ball_state *at) {
  return carom_shot_at(balls, count, &shot, time, at);
}

/* Many times have the bits of one after another, in any order, with drag too; an error leaves
 * the times before it written. */
TEST(many_times) {
  enum { TIMES = 400 };
  static carom_ball_state together[TIMES][10], alone[10];
  static double looks[TIMES];
  for (int drag = 0; drag < 2; drag++) {
    set_up();
    for (int i = 0; i < 10; i++)
      balls[i].kind.drag = 0.02 * drag;
    expect_ok(carom_shoot(&table, balls, count, &cue, NULL, &shot));
    ck_assert(shot.count > 20 && shot.count < ROOM);
    for (int order = 0; order < 3; order++) { /* forwards with every event among them, backwards,
                                                 to and fro */
      for (int k = 0; k < TIMES; k++) {
        const double even = k / (TIMES - 1.0) * 1.1 * shot.time;
        looks[order == 1 ? TIMES - 1 - k : k] =
            order == 2 && k % 3 == 0 ? fabs(shot.time - even) : even;
      }
      for (int k = 0; order == 0 && k < 20; k++)
        looks[10 * k] = events[k].time;
      expect_ok(states_at(looks, TIMES, together[0]));
      for (int k = 0; k < TIMES; k++) {
        expect_ok(state_at(looks[k], alone));
        ck_assert_mem_eq(alone, together[k], sizeof alone);
      }
    }
    looks[0] = 0.5;
    looks[1] = NAN;
    memset(together, 0, sizeof together);
    ck_assert_int_eq(states_at(looks, 2, together[0]), CAROM_ERROR_TIME);
    expect_ok(state_at(0.5, alone));
    ck_assert_mem_eq(alone, together[0], sizeof alone);
    ck_assert_double_eq(together[1][0].r[2], 0.0);
    expect_ok(states_at(NULL, 0, NULL));
    ck_assert_int_eq(states_at(NULL, 1, alone), CAROM_ERROR_NULL);
  }
}

/* Events and balls that were damaged end in an error, or in some state, after bounded work. */
TEST(damaged_events) {
  static const double bad[] = {-1.0,  1e3, 1e9,    1e12, 1e15, 1e18,     1e45,     1e100,
                               1e300, NAN, -1e300, 1e-8, 0.0,  INFINITY, -INFINITY};
  const int bads = (int)COUNT_OF(bad);
  static carom_event good[64];
  set_up();
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  carom_shot_ball two[2] = {{.kind = carom_ball_kind_of(CAROM_GAME_BILLIARD)}};
  two[1].kind = two[0].kind;
  expect_ok(carom_place_ball(&table, two, 2, 0, 0.7, 0.5, NULL));
  expect_ok(carom_place_ball(&table, two, 2, 1, 0.72, 1.5, NULL));
  carom_cue stroke = carom_cue_of(CAROM_GAME_BILLIARD);
  stroke.a = 0.2;
  shot.room = 64;
  expect_ok(carom_shoot(&table, two, 2, &stroke, NULL, &shot));
  ck_assert_int_gt(shot.count, 6);
  const double seed[CAROM_CUE_NUMBERS] = {1.0};
  const carom_tangent_seeds by_speed = {.directions = 1, .cue = seed};
  memcpy(good, events, sizeof good);
  const double time = 0.5 * (good[3].time + good[4].time);
  /* of these values so many in each position, others from place to place; before a release all */
  const int values = draws_within(4, bads);
  int refused = 0, unresolved = 0;
  tangents[0] = (carom_tangent){.final = heap->ends[0]};
  for (size_t word = 0; word < 4 * sizeof *good / sizeof(double); word++)
    for (int k = 0; k < values; k++) {
      const double value = bad[(word * (size_t)values + (size_t)k) % (size_t)bads];
      memcpy(events, good, sizeof good);
      memcpy((char *)events + word * sizeof(double), &value, sizeof(double));
      unresolved += carom_shot_at(two, 2, &shot, time, states) == CAROM_ERROR_UNRESOLVED;
      refused += carom_shot_frames(two, 2, &shot, &time, 1, NULL, NULL, turned) < 0;
      carom_shot_drawn(&table, two, 2, &shot, &time, 1, states);
      carom_shot_tangent(&table, two, 2, &stroke, NULL, &shot, &by_speed, tangents);
    }
  printf("%d states and %d turns are refused\n", unresolved, refused);
  ck_assert(unresolved > 50 * values / bads && refused > unresolved);
  /* a number of contacts that cannot be */
  memcpy(events, good, sizeof good);
  events[0].cluster = -1;
  ck_assert_int_eq(carom_shot_tangent(&table, two, 2, &stroke, NULL, &shot, &by_speed, tangents),
                   CAROM_ERROR_STATE);
  /* constants of a ball */
  memcpy(events, good, sizeof good);
  for (size_t word = 0; word < sizeof(carom_ball_kind) / sizeof(double); word++)
    for (int k = 0; k < values; k++) {
      const double value = bad[(word * (size_t)values + (size_t)k) % (size_t)bads];
      carom_shot_ball other[2] = {two[0], two[1]};
      memcpy((char *)&other[0].kind + word * sizeof(double), &value, sizeof(double));
      carom_shot_at(other, 2, &shot, 2.0, states);
      carom_shot_frames(other, 2, &shot, &(double){2.0}, 1, NULL, NULL, turned);
    }
}

/* ---- The built-in tables */

/* Whether a jaw touches the end of a cushion or of a facing: the end is on the jaw's circle, and
 * the cushion is tangent to it. */
static bool touches(const carom_jaw *jaw, const carom_rail *cushion, const double end[2]) {
  const double d_x = end[0] - jaw->centre[0], d_y = end[1] - jaw->centre[1];
  const double e_x = cushion->q[0] - cushion->p[0], e_y = cushion->q[1] - cushion->p[1];
  return fabs(hypot(d_x, d_y) - jaw->radius) < 1e-9 &&
         fabs(d_x * e_x + d_y * e_y) < 1e-5 * hypot(e_x, e_y);
}

/* How far x is outside [0, length]; negative inside. */
static double outside(double x, double length) {
  return fmax(-x, x - length);
}

#define AT(member) ((int)(offsetof(carom_measures, member) / sizeof(double)))

/* The measures that a player would take, from the parts of the table. The mouth of a pocket lies
 * between the points where its rails would meet its facings. */
static void measure(const carom_measures *m, double tolerance) {
  const double w = m->width, l = m->length;
  ck_assert(table.width == w && table.length == l && table.rails == 18 && table.jaws == 12 &&
            table.pockets == 6);
  for (int k = 0; k < 18; k++)
    ck_assert_double_eq_tol(table.rail[k].height, m->nose_height, 1e-12);
  /* each jaw leads from one of the six cushions to one of the twelve facings */
  int corner_jaws = 0;
  for (int k = 0; k < 12; k++) {
    const carom_jaw *jaw = &table.jaw[k];
    const carom_rail *cushion = NULL, *facing = NULL;
    for (int n = 0; n < 6; n++)
      if (touches(jaw, &table.rail[n], table.rail[n].p) ||
          touches(jaw, &table.rail[n], table.rail[n].q))
        cushion = &table.rail[n];
    for (int n = 6; n < 18; n++)
      if (touches(jaw, &table.rail[n], table.rail[n].q))
        facing = &table.rail[n];
    ck_assert_msg(cushion != NULL && facing != NULL, "jaw %d: no cushion, or no facing", k);
    /* where their lines meet, by Cramer's rule */
    const double *a = cushion->line, *b = facing->line, D = a[0] * b[1] - a[1] * b[0];
    const double x = (a[1] * b[2] - a[2] * b[1]) / D, y = (a[2] * b[0] - a[0] * b[2]) / D;
    const bool corner = fabs(y - l / 2.0) > l / 4.0;
    const double half = corner ? (fmin(x, w - x) + fmin(y, l - y)) * sqrt(0.5) : fabs(y - l / 2.0);
    corner_jaws += corner;
    ck_assert_double_eq_tol(2.0 * half, corner ? m->corner_mouth : m->side_mouth, 2e-5);
    ck_assert_double_eq_tol(jaw->radius, corner ? m->corner_jaw : m->side_jaw, 1e-12);
    ck_assert_double_eq_tol(jaw->height, m->nose_height, 1e-12);
    const double angle = acos(-fabs(a[0] * b[0] + a[1] * b[1]) / (planar_size(a) * planar_size(b)));
    ck_assert_double_eq_tol(angle * 180.0 / 3.14159265358979323846,
                            corner ? m->corner_cut : m->side_cut, corner ? 1e-9 : tolerance);
    /* the facing goes back to the depth of the cushion */
    ck_assert_double_eq_tol(fmax(outside(facing->p[0], w), outside(facing->p[1], l)),
                            m->cushion_depth, 1e-12);
  }
  ck_assert_int_eq(corner_jaws, 8);
  /* pockets at the corner_jaws lie on the bisectors; the shelf goes to their edges */
  for (int k = 0; k < 6; k++) {
    const carom_pocket *p = &table.pocket[k];
    const double x = outside(p->centre[0], w), y = outside(p->centre[1], l);
    const bool corner = y > -l / 4.0;
    ck_assert_double_eq_tol(corner ? y : y + l, corner ? x : l / 2.0, 1e-12);
    ck_assert_double_eq_tol(p->radius, corner ? m->corner_hole : m->side_hole, 1e-12);
    ck_assert_double_eq_tol(corner ? hypot(x, y) + 0.5 * m->corner_mouth - m->corner_shelf
                                   : x - m->side_shelf,
                            p->radius, 1e-12);
    corner_jaws += corner;
  }
  ck_assert_int_eq(corner_jaws, 12);
}

/* Of the built-in tables, and of tables made from their measures, some of which are changed. The
 * facings of pooltool's side pockets are 0.064 degrees off the given angle. */
TEST(measures_of_tables) {
  random_source r = {test_seed()};
  carom_measures m;
  for (int size = CAROM_TABLE_POOL_7FT; size <= CAROM_TABLE_POOLTOOL; size++) {
    expect_ok(carom_table_measures((carom_table_kind)size, &m));
    expect_ok(carom_table_make((carom_table_kind)size, &table));
    if (size == CAROM_TABLE_THREECUSHION)
      continue;
    measure(&m, size == CAROM_TABLE_POOLTOOL ? 0.07 : 1e-9);
    /* pool by the rules of the WPA: inches, degrees, parts of a ball of 2.25 in */
    const double in = 0.0254;
    const struct {
      double value, low, high;
    } wpa[] = {{m.corner_mouth / in, 4.5, 4.625},
               {m.side_mouth / in, 5.0, 5.125},
               {m.corner_cut, 141.0, 143.0},
               {m.side_cut, 103.0, 105.0},
               {m.corner_shelf / in, 1.0, 2.25},
               {m.side_shelf / in, 0.0, 0.375},
               {m.nose_height / in / 2.25, 0.625, 0.645},
               {m.cushion_depth / in, 1.875, 2.0}};
    for (size_t k = 0; size <= CAROM_TABLE_POOL_9FT && k < COUNT_OF(wpa); k++)
      ck_assert_msg(wpa[k].value > wpa[k].low && wpa[k].value < wpa[k].high, "%zu: %g", k,
                    wpa[k].value);
    int closed = 0;
    for (int k = 0; k < 20; k++) {
      carom_measures own = m;
      double *x = &own.width;
      for (size_t n = 0; n < sizeof own / sizeof *x; n++)
        x[n] *= random_between(&r, n == AT(side_cut) ? 1.0 : 0.95, 1.05);
      const carom_status fits = carom_table_measured(&own, 0.026, &table, NULL);
      ck_assert(fits == CAROM_OK || fits == CAROM_ERROR_TABLE_OPEN);
      if (fits == CAROM_OK)
        measure(&own, 1e-9);
      closed += fits == CAROM_OK;
    }
    ck_assert_int_gt(closed, 10);
  }
}
