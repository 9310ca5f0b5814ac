/* What a game asks in addition to shots: whether a table is sound, whether a position is free, how
 * balls have turned, and names. */
#include "carom_shot.h"
#include "support.h"

enum { TABLES = CAROM_TABLE_FOURBALL + 1 };

static double radius_on(int kind) {
  return carom_ball_kind_of(carom_game_of_table((carom_table_kind)kind)).radius;
}

/* ---- Tables */

/* Takes the part out: rails come first, then jaws, then pockets. */
static void take_out(carom_table *t, int part) {
  const struct {
    void *parts;
    int64_t *count;
    size_t size;
  } lists[] = {{t->rail, &t->rails, sizeof *t->rail},
               {t->jaw, &t->jaws, sizeof *t->jaw},
               {t->pocket, &t->pockets, sizeof *t->pocket}};
  int k = 0;
  for (; part >= *lists[k].count; k++)
    part -= (int)*lists[k].count;
  char *const place = (char *)lists[k].parts + (size_t)part * lists[k].size;
  *lists[k].count -= 1;
  memmove(place, place + lists[k].size, (size_t)(*lists[k].count - part) * lists[k].size);
}

/* Plays some shots of a lone ball: how many lose it, and how often it meets a rail. */
static int lost_balls(const carom_table *t, double R, int rail, int shots, random_source *r,
                      int *met) {
  int lost = 0;
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  ball.kind.radius = R;
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_MIRROR};
  *met = 0;
  for (int k = 0; k < shots; k++) {
    carom_place_ball(t, &ball, 1, 0, 0.5 * t->width, 0.5 * t->length, NULL);
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = 9.0;
    cue.phi = random_between(r, 0.0, 360.0);
    carom_brief_event events[100];
    carom_shot shot = {.brief = events, .room = 100};
    lost += carom_shoot(t, &ball, 1, &cue, &options, &shot) == CAROM_ERROR_LEFT_TABLE;
    for (int64_t e = 0; e < shot.count && e < shot.room; e++)
      *met += events[e].type == CAROM_EVENT_RAIL && events[e].b == rail;
  }
  return lost;
}

/* The built-in tables are sound; a table without any one of their parts is found open exactly
 * where a ball can get out, and the hole is next to what is missing; a rail with the wrong side,
 * or a line that is not its own, is named. */
TEST(tables_are_checked) {
  random_source r = {test_seed()};
  int holes = 0, sides = 0, rails = 0;
  for (int kind = 0; kind < TABLES; kind++) {
    const double R = radius_on(kind);
    carom_table sound, t;
    carom_table_fault fault;
    carom_table_make((carom_table_kind)kind, &sound);
    expect_ok(carom_table_check(&sound, R, &fault));
    ck_assert(fault.part.kind == CAROM_PART_NONE && fault.gap == 0.0);
    for (int part = 0; part < sound.rails + sound.jaws + sound.pockets; part++) {
      t = sound;
      take_out(&t, part);
      const carom_status status = carom_table_check(&t, R, &fault);
      ck_assert_msg(status == CAROM_OK || status == CAROM_ERROR_TABLE_OPEN,
                    "%s without part %d: %s", carom_word(CAROM_WORDS_TABLE, kind), part,
                    carom_status_name(status));
      int met;
      const int lost = lost_balls(&t, R, -1, kind == CAROM_TABLE_POOL_9FT ? 1000 : 100, &r, &met);
      ck_assert_msg(status == CAROM_ERROR_TABLE_OPEN || lost == 0,
                    "%s without part %d: %d balls are lost, and it is ok",
                    carom_word(CAROM_WORDS_TABLE, kind), part, lost);
      /* a long rail is a hole as wide as itself but for its jaws */
      if (part < sound.rails) {
        const carom_rail *rail = &sound.rail[part];
        const double length = distance(rail->q, rail->p);
        const double middle[2] = {0.5 * (rail->p[0] + rail->q[0]), 0.5 * (rail->p[1] + rail->q[1])};
        const double off = distance(fault.place, middle);
        if (length > 0.3) {
          ck_assert_int_eq(status, CAROM_ERROR_TABLE_OPEN);
          ck_assert_msg(off < 0.1 * length &&
                            fabs(fault.gap - length) < 0.1 * length + 2.0 * sound.jaw[0].radius,
                        "%d/%d: a hole of %g m, %g m off", kind, part, fault.gap, off);
          ck_assert(fault.part.kind != CAROM_PART_NONE && fault.other.kind != CAROM_PART_NONE);
        }
      }
      holes += status == CAROM_ERROR_TABLE_OPEN;
    }
    for (int k = 0; k < sound.rails; k++, rails++) {
      t = sound;
      t.rail[k].side = 1 - t.rail[k].side;
      const carom_status status = carom_table_check(&t, R, &fault);
      if (status == CAROM_OK) { /* some facings of snooker's pockets are never met, so that their
                                   side does not matter */
        int met;
        lost_balls(&sound, R, k, 400, &r, &met);
        ck_assert_int_eq(met, 0);
        continue;
      }
      ck_assert_msg(status == CAROM_ERROR_RAIL_SIDE && fault.part.kind == CAROM_PART_RAIL &&
                        fault.part.index == k,
                    "%s, rail %d turned: %s", carom_word(CAROM_WORDS_TABLE, kind), k,
                    carom_status_name(status));
      for (int c = 0; c < 2; c++)
        ck_assert_double_eq(fault.place[c], 0.5 * (t.rail[k].p[c] + t.rail[k].q[c]));
      sides++;
      t = sound;
      t.rail[k].line[2] += 1e-4 * hypot(t.rail[k].line[0], t.rail[k].line[1]);
      ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_RAIL_LINE);
      ck_assert_int_eq(fault.part.index, k);
      ck_assert_double_eq(fault.place[0], 0.5 * (t.rail[k].p[0] + t.rail[k].q[0]));
    }
  }
  ck_assert(holes >= 60 && sides >= rails - 12);
}

/* A table is searched for a position in rings around the middle of its box, in tenths of the box up
 * to four. Each of these positions is found where it is the only free one: four posts, so large
 * that they are nearly straight, close a room of 10 cm around it and cover all others. Without one
 * of the posts the room is open. */
TEST(the_only_free_place) {
  enum { HALF = 4 };
  static const double way[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const double R = 0.028575, radius = 10.0, room = 0.05;
  for (int k = -HALF; k <= HALF; k++)
    for (int l = -HALF; l <= HALF; l++) {
      carom_table t = {.width = 1.0, .length = 1.0, .jaws = 4};
      carom_table_fault fault;
      const double x = 0.5 + 0.1 * k, y = 0.5 + 0.1 * l;
      for (int post = 0; post < 4; post++)
        t.jaw[post] = (carom_jaw){
            .centre = {x + (radius + room) * way[post][0], y + (radius + room) * way[post][1]},
            .radius = radius,
            .height = 0.036};
      ck_assert_msg(carom_table_check(&t, R, &fault) == CAROM_OK, "the room at %g, %g", x, y);
      t.jaws = 3;
      ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
    }
}

/* ---- Ball in hand */

/* A position is free exactly where carom_shot_check() has nothing against it, and what is in the
 * way is there. */
TEST(places) {
  random_source r = {test_seed()};
  int free_ones = 0, seen[5] = {0};
  for (int kind = 0; kind < TABLES; kind++) {
    carom_table t;
    carom_shot_ball balls[10], before[10];
    carom_table_make((carom_table_kind)kind, &t);
    for (int n = 0; n < 3000; n++) {
      carom_rack(CAROM_RACK_NINEBALL, &t, 1e-4, 1, balls, 10);
      for (int k = 0; k < 10; k++) {
        balls[k].kind.radius = balls[k].state.r[2] = radius_on(kind);
        balls[k].state.r[1] += n % 2 * 1e-3; /* larger balls overlap in this rack, which is no
                                                matter of place */
      }
      const int ball = (int)random_between(&r, 0.0, 10.0);
      balls[ball].state.label = n % 3 == 0 ? CAROM_BALL_POCKETED : CAROM_BALL_STATIONARY;
      balls[ball].state.w[0] = n % 2;
      double x = random_between(&r, -0.1, t.width + 0.1),
             y = random_between(&r, -0.1, t.length + 0.1);
      if (n % 4 == 0) { /* near another ball */
        x = balls[(ball + 1) % 10].state.r[0] + random_between(&r, -0.07, 0.07);
        y = balls[(ball + 1) % 10].state.r[1] + random_between(&r, -0.07, 0.07);
      }
      memcpy(before, balls, sizeof balls);
      carom_part part;
      const carom_status status = carom_place_ball(&t, balls, 10, ball, x, y, &part);
      /* the ball with each of the others, or alone */
      carom_shot_ball pair[2] = {before[ball]};
      pair[0].state = (carom_ball_state){.r = {x, y, radius_on(kind)}};
      bool stands = carom_shot_check(&t, pair, 1, NULL, NULL, NULL) == CAROM_OK, overlaps = false;
      for (int k = 0; k < 10 && stands; k++) {
        pair[1] = before[k];
        overlaps |=
            k != ball && carom_shot_check(&t, pair, 2, NULL, NULL, NULL) == CAROM_ERROR_OVERLAP;
      }
      const carom_status of_stand = overlaps ? CAROM_ERROR_OVERLAP : CAROM_OK;
      ck_assert_int_eq(status, stands ? of_stand : CAROM_ERROR_OFF_TABLE);
      seen[part.kind]++;
      if (status == CAROM_OK) {
        ck_assert(balls[ball].state.r[0] == x && balls[ball].state.r[1] == y &&
                  balls[ball].state.w[0] == 0.0);
        ck_assert(balls[ball].state.label == CAROM_BALL_STATIONARY && part.kind == CAROM_PART_NONE);
        balls[ball].state = before[ball].state;
        free_ones++;
      }
      ck_assert_mem_eq(balls, before, sizeof balls);
      if (part.kind == CAROM_PART_BALL)
        ck_assert(hypot(x - balls[part.index].state.r[0], y - balls[part.index].state.r[1]) <
                  2.0 * radius_on(kind));
      if (part.kind == CAROM_PART_POCKET)
        ck_assert(hypot(x - t.pocket[part.index].centre[0], y - t.pocket[part.index].centre[1]) <
                  t.pocket[part.index].radius);
    }
  }
  ck_assert(free_ones > 1000);
  for (int k = 0; k < 5; k++)
    ck_assert_int_gt(seen[k], 20);
}

/* ---- Positions on tables of one's own */

/* Some times as fast as hypot(), of which floods take most of their time. */
static double length(double x, double y) {
  return sqrt(x * x + y * y);
}

/* How far the surface of a ball at a position is from the next cushion. */
static double room_at(const carom_table *t, double R, double x, double y) {
  double room = INFINITY;
  for (int k = 0; k < t->rails; k++) {
    const double *p = t->rail[k].p, *q = t->rail[k].q;
    const double e[2] = {q[0] - p[0], q[1] - p[1]}, d[2] = {x - p[0], y - p[1]};
    const double along = (d[0] * e[0] + d[1] * e[1]) / (e[0] * e[0] + e[1] * e[1]);
    const double place = fmin(fmax(along, 0.0), 1.0);
    room = fmin(room, length(d[0] - place * e[0], d[1] - place * e[1]) - R);
  }
  for (int k = 0; k < t->jaws; k++)
    room =
        fmin(room, length(x - t->jaw[k].centre[0], y - t->jaw[k].centre[1]) - t->jaw[k].radius - R);
  return room;
}

/* How far a position is from the next pocket; negative inside. */
static double off_pockets(const carom_table *t, double x, double y) {
  double off = INFINITY;
  for (int k = 0; k < t->pockets; k++)
    off = fmin(off, length(x - t->pocket[k].centre[0], y - t->pocket[k].centre[1]) -
                        t->pocket[k].radius);
  return off;
}

enum { MOST_PLACES = 540 }; /* of a grid, along each side */
static uint8_t reached[MOST_PLACES][MOST_PLACES];
static const double margin = 0.3; /* m: of the grid, beyond the table */

/* Finds the positions of a grid to which a ball can be rolled from one of them, by flooding; n
 * becomes their numbers. */
static void flood(const carom_table *t, double R, double step, const double from[2], int n[2]) {
  static int queue[MOST_PLACES * MOST_PLACES];
  int waiting = 0;
  n[0] = (int)((t->width + 2.0 * margin) / step);
  n[1] = (int)((t->length + 2.0 * margin) / step);
  ck_assert(n[0] < MOST_PLACES && n[1] < MOST_PLACES);
  memset(reached, 0, sizeof reached);
  const int i0 = (int)((from[0] + margin) / step), j0 = (int)((from[1] + margin) / step);
  queue[waiting++] = i0 * MOST_PLACES + j0;
  reached[i0][j0] = 1;
  while (waiting > 0) {
    const int at = queue[--waiting];
    for (int way = 0; way < 4; way++) {
      const int i = at / MOST_PLACES + (way == 0) - (way == 1),
                j = at % MOST_PLACES + (way == 2) - (way == 3);
      const double x = i * step - margin, y = j * step - margin;
      ck_assert_msg(i > 0 && i < n[0] && j > 0 && j < n[1], "the table has a hole");
      if (!reached[i][j] && room_at(t, R, x, y) > 0.0 && off_pockets(t, x, y) >= 0.0) {
        reached[i][j] = 1;
        queue[waiting++] = i * MOST_PLACES + j;
      }
    }
  }
}

/* Both ways to ask whether a ball may be at a position. */
static void expect_place(const carom_table *t, double R, double x, double y, bool free_one) {
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  const carom_status expected = free_one ? CAROM_OK : CAROM_ERROR_OFF_TABLE;
  ball.kind.radius = R;
  const carom_status status = carom_place_ball(t, &ball, 1, 0, x, y, NULL);
  ck_assert_msg(status == expected, "(%.17g, %.17g): %s", x, y, carom_status_name(status));
  ball.state = (carom_ball_state){.r = {x, y, R}};
  ck_assert_int_eq(carom_shot_check(t, &ball, 1, NULL, NULL, NULL), expected);
}

/* A ball may be at all positions of a grid to which it can be rolled, and nowhere else. */
static void expect_flooded(const carom_table *t, double R, double step, const double from[2]) {
  int n[2];
  flood(t, R, step, from, n);
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++) {
      const double x = i * step - margin, y = j * step - margin;
      if (fabs(room_at(t, R, x, y)) > 1.1e-6)
        expect_place(t, R, x, y, reached[i][j]);
    }
}

/* On the built-in tables a ball may be at all positions of a grid to which it can be rolled from
 * the middle, and nowhere else: not behind a cushion, not in a pocket. */
TEST(places_on_built_in_tables) {
  const double step = 0.016;
  for (int kind = 0; kind < TABLES; kind++) {
    if (kind == CAROM_TABLE_PYRAMID)
      continue; /* its mouths are wider than a ball by less than a step */
    carom_table t;
    const double R = radius_on(kind);
    carom_table_make((carom_table_kind)kind, &t);
    const double middle[2] = {0.5 * t.width, 0.5 * t.length};
    expect_flooded(&t, R, step, middle);
    /* in line with a pocket, through which one sees the cushion beyond: in the directions that
     * the check looks in */
    static const double quarter[4][2] = {{5, 1}, {3, 2}, {2, 3}, {1, 5}};
    for (int k = 0; k < t.pockets * 16 * 12; k++) {
      const double *c = t.pocket[k / 192].centre, *u = quarter[k / 12 % 4],
                   turn[4] = {u[0], -u[1], -u[0], u[1]};
      const double x = c[0] + 0.03 * (k % 12 + 1) * turn[k / 48 % 4],
                   y = c[1] + 0.03 * (k % 12 + 1) * turn[(k / 48 + 3) % 4];
      if (x < -0.15 || x > t.width + 0.15 || y < -0.15 || y > t.length + 0.15)
        expect_place(&t, R, x, y, false);
    }
  }
}

/* The jaws of a pocket are tangent to their rails, its mouth apart, and mirror images of each
 * other; the order of the corners turns only the order of the parts round. */
TEST(polygon_tables) {
  static const carom_corner pool[6] = {{0, 0, 0.118},       {1.27, 0, 0.118}, {1.27, 1.27, 0.137},
                                       {1.27, 2.54, 0.118}, {0, 2.54, 0.118}, {0, 1.27, 0.137}};
  static const double R = 0.028575, r = 0.01;
  carom_corner other[6];
  for (int k = 0; k < 6; k++)
    other[k] = pool[5 - k];
  carom_table t, turned;
  carom_table_fault fault;
  expect_ok(carom_table_polygon(pool, 6, 0.0366, r, R, &t, &fault));
  expect_ok(carom_table_polygon(other, 6, 0.0366, r, R, &turned, NULL));
  ck_assert_int_eq(t.rails + t.jaws + t.pockets, 6 + 12 + 6);
  ck_assert(t.width == 1.27 && t.length == 2.54 && t.ball_radius == R);
  for (int k = 0; k < 6; k++) {
    const double *before = t.jaw[2 * k].centre, *after = t.jaw[2 * k + 1].centre;
    const carom_rail *one = &t.rail[(k + 5) % 6], *two = &t.rail[k];
    ck_assert_double_eq_tol(distance(after, before), pool[k].mouth + 2.0 * r, 1e-12);
    ck_assert_double_eq_tol(distance(after, two->p), r, 1e-12);
    ck_assert_double_eq_tol(distance(before, one->q), r, 1e-12);
    bool found = false;
    for (int i = 0; i < 6; i++)
      found |= distance(t.pocket[k].centre, turned.pocket[i].centre) < 1e-12;
    ck_assert(found);
  }
  /* no rail of a U has a name */
  static const carom_corner u[8] = {{0, 0, 0}, {3, 0, 0}, {3, 2.4, 0}, {2, 2.4, 0},
                                    {2, 1, 0}, {1, 1, 0}, {1, 2.4, 0}, {0, 2.4, 0}};
  expect_ok(carom_table_polygon(u, 8, 0.0366, r, R, &t, &fault));
  for (int k = 0; k < t.rails; k++)
    ck_assert_ptr_null(carom_rail_name(&t, k));
}

/* A polygon from any origin is the same table. */
TEST(polygons_take_any_origin) {
  static const double R = 0.028575, from[3][2] = {{-1.0, -2.0}, {-8.0, 4.0}, {16.0, 32.0}};
  static const carom_corner square[4] = {{0, 0, 0.125}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0.125}};
  carom_table at_origin, t;
  expect_ok(carom_table_polygon(square, 4, 0.0366, 0.01, R, &at_origin, NULL));
  for (int k = 0; k < 3; k++) {
    carom_corner moved[4];
    for (int n = 0; n < 4; n++)
      moved[n] =
          (carom_corner){square[n].x + from[k][0], square[n].y + from[k][1], square[n].mouth};
    expect_ok(carom_table_polygon(moved, 4, 0.0366, 0.01, R, &t, NULL));
    ck_assert_mem_eq(&t, &at_origin, sizeof t);
  }
}

/* A polygon that is rejected names the corner at fault, and a second one where there is. The other
 * way round it has the same status, and its corners have other numbers. */
TEST(faults_of_polygons) {
  enum { CORNERS = 4, NONE = -1 };
  static const struct {
    carom_corner corner[CORNERS];
    carom_status status;
    int corner_at_fault;
    int other_corner;
  } faults[] = {{{{0, 0, 0}, {NAN, 0, 0}, {2, 2, 0}, {0, 2, 0}}, CAROM_ERROR_CORNER, 1, NONE},
                {{{0, 0, 0}, {2, 0, 0}, {2, 2e6, 0}, {0, 2, 0}}, CAROM_ERROR_CORNER, 2, NONE},
                {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, -0.1}}, CAROM_ERROR_CORNER, 3, NONE},
                {{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0, 2, 0}}, CAROM_ERROR_CORNERS_MEET, 1, 2},
                {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 4}}, CAROM_ERROR_MOUTHS, 2, 3}};
  for (size_t k = 0; k < COUNT_OF(faults); k++) {
    carom_corner other_way[CORNERS];
    for (int n = 0; n < CORNERS; n++)
      other_way[n] = faults[k].corner[CORNERS - 1 - n];
    carom_table t;
    carom_table_fault fault;
    ck_assert_int_eq(
        carom_table_polygon(faults[k].corner, CORNERS, 0.0366, 0.01, 0.028575, &t, &fault),
        faults[k].status);
    ck_assert_int_eq(fault.part.kind, CAROM_PART_CORNER);
    ck_assert_int_eq(fault.part.index, faults[k].corner_at_fault);
    if (faults[k].other_corner == NONE) {
      ck_assert_int_eq(fault.other.kind, CAROM_PART_NONE);
    } else {
      ck_assert_int_eq(fault.other.kind, CAROM_PART_CORNER);
      ck_assert_int_eq(fault.other.index, faults[k].other_corner);
    }
    ck_assert_int_eq(carom_table_polygon(other_way, CORNERS, 0.0366, 0.01, 0.028575, &t, &fault),
                     faults[k].status);
    ck_assert_int_eq(fault.part.kind, CAROM_PART_CORNER);
  }
}

/* A star with a pocket at each point: the ninth pocket is one too many. */
TEST(star_with_too_many_pockets) {
  carom_corner star[CAROM_RAILS_MOST];
  for (int k = 0; k < CAROM_RAILS_MOST; k++) {
    const bool is_point = k % 2 == 0;
    const double angle = 2.0 * 3.14159265358979323846 * k / CAROM_RAILS_MOST;
    const double far = is_point ? 3.0 : 1.5;
    star[k] = (carom_corner){far * cos(angle), far * sin(angle), is_point ? 0.1 : 0.0};
  }
  carom_table t;
  carom_table_fault fault;
  ck_assert_int_eq(carom_table_polygon(star, CAROM_RAILS_MOST, 0.0366, 0.01, 0.028575, &t, &fault),
                   CAROM_ERROR_POCKETS);
  ck_assert_int_eq(fault.part.kind, CAROM_PART_CORNER);
  ck_assert_int_eq(fault.part.index, 2 * CAROM_POCKETS_MOST);
}

/* The same on a table in the shape of a U, whose middle is outside of it, with pockets at the ends
 * of its arms; and on one with a corner so sharp that there is room behind its pocket. Rays through
 * slits that no ball passes once told otherwise, and so did places beyond the ends of short
 * rails. */
TEST(places_on_odd_shapes) {
  static const carom_corner narrow_u[] = {{0, 0, 0},       {1.8, 0, 0},   {1.8, 1.5, 0.1},
                                          {1.2, 1.5, 0.1}, {1.2, 0.6, 0}, {0.6, 0.6, 0},
                                          {0.6, 1.5, 0.1}, {0, 1.5, 0.1}};
  static const carom_corner sharp[] = {{0, 0, 0.13}, {2, 0.5, 0}, {2, 1.2, 0}};
  static const carom_corner short_rails[] = {
      {0, 0.939, 0.135},     {0.13, 0.61, 0.135},   {0.26, 0.281, 0.135},
      {0.541, 0.141, 0.135}, {0.822, 0, 0.135},     {1.373, 0.445, 0.135},
      {1.11, 1.166, 0.135},  {0.761, 1.419, 0.135}, {0.412, 1.672, 0}};
  static const struct {
    const carom_corner *corners;
    int count;
    double jaw_radius, inside[2];
  } shapes[] = {{narrow_u, COUNT_OF(narrow_u), 0.01, {0.9, 0.3}},
                {sharp, COUNT_OF(sharp), 0.01, {1.6, 0.7}},
                {short_rails, COUNT_OF(short_rails), 0.0266, {0.7, 0.8}}};
  const double R = 0.028575;
  for (int k = 0; k < 3; k++) {
    carom_table t;
    expect_ok(carom_table_polygon(shapes[k].corners, shapes[k].count, 0.0365, shapes[k].jaw_radius,
                                  R, &t, NULL));
    expect_flooded(&t, R, 0.01, shapes[k].inside);
  }
}

/* In the air and below the tops of the rails, a ball can be nearer to a rail than on the cloth. */
TEST(places_in_the_air) {
  carom_table t;
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL)};
  const double R = ball.kind.radius;
  for (int k = 0; k < 6 * 9; k++) {
    const carom_rail *rail = &t.rail[k / 9];
    const double z = (1.6 + 0.2 * (k % 3)) * R, above = z - rail->height, h0 = rail->height;
    static const double ends[3] = {0.003, 0.5, 0.997};
    const double along = ends[k / 3 % 3];
    const double clear = R - sqrt(h0 * (2.0 * R - h0)) + sqrt(R * R - above * above);
    const int axis = rail->p[0] == rail->q[0] ? 0 : 1; /* that of the rail's normal */
    const double inward = rail->p[axis] == 0.0 ? 1.0 : -1.0;
    for (int off = -1; off <= 1; off += 2) {
      ball.state = (carom_ball_state){.r = {0, 0, z}};
      for (int c = 0; c < 2; c++)
        ball.state.r[c] = rail->p[c] + along * (rail->q[c] - rail->p[c]);
      ball.state.r[axis] += inward * (clear + 3e-6 * off);
      ck_assert_int_eq(carom_shot_check(&t, &ball, 1, NULL, NULL, NULL),
                       off < 0 ? CAROM_ERROR_OFF_TABLE : CAROM_OK);
    }
  }
}

/* ---- How balls have turned */

/* The rotation by plain steps of Q' = [w] Q / 2, of order 4, with w from carom_shot_at(): what
 * the library does in closed form.
 */
static void by_steps(const carom_shot_ball *balls, int count, const carom_shot *shot, int ball,
                     double from, double to, double q[4]) {
  const int steps = 2000 + (int)(5000.0 * (to - from));
  const double h = (to - from) / steps;
  carom_ball_state s[CAROM_BALLS_MOST];
  for (int n = 0; n < steps; n++) {
    double k[4][4];
    for (int stage = 0; stage < 4; stage++) {
      /* just inside the interval, as the spin jumps at events */
      static const double parts[4] = {1e-6, 0.5, 0.5, 1.0 - 1e-6}, shares[4] = {0.0, 0.5, 0.5, 1.0};
      const double part = parts[stage];
      carom_shot_at(balls, count, shot, from + (n + part) * h, s);
      const double *w = s[ball].w;
      double p[4];
      for (int c = 0; c < 4; c++)
        p[c] = stage == 0 ? q[c] : q[c] + h * shares[stage] * k[stage - 1][c];
      k[stage][0] = 0.5 * (-w[0] * p[1] - w[1] * p[2] - w[2] * p[3]);
      k[stage][1] = 0.5 * (w[0] * p[0] + w[1] * p[3] - w[2] * p[2]);
      k[stage][2] = 0.5 * (w[1] * p[0] + w[2] * p[1] - w[0] * p[3]);
      k[stage][3] = 0.5 * (w[2] * p[0] + w[0] * p[2] - w[1] * p[1]);
    }
    for (int c = 0; c < 4; c++)
      q[c] += h / 6.0 * (k[0][c] + 2.0 * k[1][c] + 2.0 * k[2][c] + k[3][c]);
  }
}

static double angle_between(const double a[4], const double b[4]) {
  double inner = 0.0, apart = 0.0;
  for (int k = 0; k < 4; k++)
    inner += a[k] * b[k];
  for (int k = 0; k < 4; k++)
    apart += (a[k] - (inner < 0.0 ? -b[k] : b[k])) * (a[k] - (inner < 0.0 ? -b[k] : b[k]));
  return 2.0 * sqrt(apart);
}

/* Balls with any spin, one shot at a time: from event to event the turn is that of many small
 * steps. */
TEST(turns_agree_with_steps) {
  static carom_event events[200];
  random_source r = {test_seed()};
  carom_table t;
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  double worst = 0.0;
  for (int n = 0; n < 12; n++) {
    carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
    ball.kind.drag = n % 3 == 0 ? 0.0129 : 0.0;
    ball.state = (carom_ball_state){.r = {0.6, 1.2, ball.kind.radius}};
    random_vector(&r, 2, -2.0, 2.0, ball.state.v);
    random_vector(&r, 3, -100.0, 100.0, ball.state.w);
    /* half of them fly, with a constant spin */
    ball.state.v[2] = n % 2 * random_between(&r, -2.0, 2.0);
    carom_shot shot = {.events = events, .room = 200};
    expect_ok(carom_shoot(&t, &ball, 1, NULL, NULL, &shot));
    ck_assert_int_le(shot.count, 200);
    double at = 0.0;
    for (int64_t k = 0; k < shot.count; k++) {
      const double end = events[k].time;
      const double side = k == 0 ? ball.state.w[2] : events[k - 1].after[0].w[2];
      /* reference steps do not cross the end of the side spin */
      const double kink =
          at + fabs(side) / (2.5 * ball.kind.mu_spin * ball.kind.gravity / ball.kind.radius);
      double from[1][4], to[1][4], q[4];
      carom_shot_frames(&ball, 1, &shot, &at, 1, NULL, NULL, from);
      carom_shot_frames(&ball, 1, &shot, &end, 1, NULL, NULL, to);
      memcpy(q, from[0], sizeof q);
      const double cut = kink > at && kink < end ? kink : end;
      by_steps(&ball, 1, &shot, 0, at, cut, q);
      if (cut < end)
        by_steps(&ball, 1, &shot, 0, cut, end, q);
      worst = fmax(worst, angle_between(q, to[0]));
      at = end;
    }
  }
  printf("largest difference from steps of 0.2 ms: %.2g rad\n", worst);
  ck_assert_msg(worst < 1e-7, "%g rad", worst);
}

/* How a ball has turned: an angle about an axis. */
typedef struct turn {
  double angle;
  double axis[3]; /* of size 1 */
} turn;

/* Compares how a ball has turned in a shot that begins in this state with a closed form, until a
 * time and in steps, s. */
static void expect_turns(const carom_ball_state *start, double end, double step,
                         turn (*closed_form)(double time, const carom_ball_state *now)) {
  carom_table t;
  carom_event events[20];
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  const carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL), .state = *start};
  carom_shot shot = {.events = events, .room = COUNT_OF(events)};
  expect_ok(carom_shoot(&t, &ball, 1, NULL, NULL, &shot));
  for (double time = 0.0; time < fmin(end, shot.time); time += step) {
    carom_ball_state now;
    double q[1][4];
    expect_ok(carom_shot_at(&ball, 1, &shot, time, &now));
    expect_ok(carom_shot_frames(&ball, 1, &shot, &time, 1, NULL, NULL, q));
    const turn known = closed_form(time, &now);
    const double sine = sin(0.5 * known.angle);
    const double expected[4] = {cos(0.5 * known.angle), known.axis[0] * sine, known.axis[1] * sine,
                                known.axis[2] * sine};
    ck_assert_double_lt(angle_between(q[0], expected), 1e-12);
  }
}

static const double pool_radius = 0.028575;

/* A ball that rolls straight turns by its way over R about the axis across it. */
static turn of_rolling(double time, const carom_ball_state *now) {
  (void)time;
  return (turn){hypot(now->r[0] - 0.2, now->r[1] - 0.3) / pool_radius, {-0.8, 0.6, 0.0}};
}

TEST(turns_of_a_rolling_ball) {
  const double R = pool_radius;
  const carom_ball_state start = {
      .r = {0.2, 0.3, R}, .v = {0.3, 0.4, 0.0}, .w = {-0.4 / R, 0.3 / R, 0.0}};
  expect_turns(&start, INFINITY, 0.173, of_rolling);
}

/* A ball that spins on the spot turns about the vertical, ever more slowly. */
static turn of_spinning(double time, const carom_ball_state *now) {
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const double slowing = 2.5 * kind.mu_spin * kind.gravity / kind.radius;
  (void)now;
  return (turn){(77.0 - 0.5 * slowing * time) * time, {0.0, 0.0, 1.0}};
}

TEST(turns_of_a_spinning_ball) {
  const carom_ball_state start = {.r = {0.2, 0.3, pool_radius}, .w = {0.0, 0.0, 77.0}};
  expect_turns(&start, INFINITY, 0.11, of_spinning);
}

/* A ball in flight turns about the axis of its spin, as long as it flies: 0.24 s. */
static turn of_flying(double time, const carom_ball_state *now) {
  (void)now;
  return (turn){130.0 * time, {3.0 / 13.0, 4.0 / 13.0, 12.0 / 13.0}};
}

TEST(turns_of_a_flying_ball) {
  const carom_ball_state start = {.r = {0.6, 0.6, pool_radius + 0.3}, .w = {30.0, 40.0, 120.0}};
  expect_turns(&start, 0.24, 0.017, of_flying);
}

/* Frames of a film have the bits of single calls. */
static void same_frames(const carom_shot_ball *balls, const carom_shot *shot, const double *times,
                        size_t many, carom_frames *film) {
  carom_ball_state one[16], frames[3][16];
  double q[16][4], turned[3][16][4];
  expect_ok(carom_shot_frames(balls, 16, shot, times, many, film, frames[0], turned[0]));
  for (size_t k = 0; k < many; k++) {
    expect_ok(carom_shot_at(balls, 16, shot, times[k], one));
    expect_ok(carom_shot_frames(balls, 16, shot, &times[k], 1, NULL, NULL, q));
    ck_assert(memcmp(one, frames[k], sizeof one) == 0 && memcmp(q, turned[k], sizeof q) == 0);
  }
}

/* However frames are cut, also where a shot continues, where time goes back, jumps or runs back to
 * the beginning, and where the memory is that of another shot's film. */
TEST(frames) {
  static carom_shot_state state;
  static carom_frames film;
  carom_table t;
  carom_shot_ball balls[16];
  carom_event events[2000];
  carom_ball_state final[16];
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  carom_shot_options options = {0};
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  random_source r = {test_seed()};
  for (int n = 0; n < 4; n++) {
    carom_rack(CAROM_RACK_EIGHTBALL, &t, 1e-4, (uint64_t)n, balls, 16);
    cue.speed = 4.0 + n;
    cue.phi = 89.0 + 2.0 * random_between(&r, 0.0, 1.0);
    cue.a = 0.3;
    carom_shot shot = {.events = events, .room = 2000, .final = final, .state = &state};
    options.time_most = 1.5;
    ck_assert_int_eq(carom_shoot(&t, balls, 16, &cue, &options, &shot), CAROM_STOPPED_AT_TIME);
    for (double time = 0.0; time < shot.time;) {
      double times[3];
      for (int k = 0; k < 3; k++) {
        times[k] = fmin(time, shot.time);
        time += 0.08 * random_between(&r, 0.0, 1.0);
      }
      same_frames(balls, &shot, times, 1 + (size_t)(3 * random_between(&r, 0.0, 1.0)), &film);
      /* back now and then, and on with the shot */
      if (random_between(&r, 0.0, 1.0) < 0.1 && time > 0.2)
        time -= 0.2;
      if (options.time_most > 0.0 && time > 1.4) {
        options.time_most = 0.0;
        expect_ok(carom_shot_continue(&t, balls, 16, &options, &shot));
      }
    }
    ck_assert(options.time_most == 0.0);
    for (int k = 0; k < 50; k++) {
      const double time = shot.time * random_between(&r, 0.0, 1.0);
      same_frames(balls, &shot, &time, 1, &film);
    }
    for (double time = shot.time; time > 0.0; time -= 0.04)
      same_frames(balls, &shot, &time, 1, &film);
  }
}

/* ---- What to cite */

/* The entries that options call for, and no other; the text is cut where there is no room. */
static bool cites(const carom_shot_options *options, const char *key) {
  char text[10000], with[80];
  const size_t length = carom_cite(options, text, sizeof text);
  ck_assert_uint_eq(strlen(text), length);
  snprintf(with, sizeof with, "{%s,", key);
  return strstr(text, with) != NULL;
}

TEST(sources) {
  static const struct {
    carom_shot_options options;
    const char *keys[8]; /* those behind - are not cited */
  } rows[] = {{{0},
               {"carom", "mathavan2014", "han2005", "joris-accelerating", "hertz1882",
                "-mathavan2010", "-kiefl2024"}},
              {{.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN}, {"mathavan2010", "-han2005"}},
              {{.cushion_model = CAROM_SHOT_CUSHION_SMOOTH}, {"threecushiontool", "han2005"}},
              {{.simultaneous = CAROM_SIMULTANEOUS_PAIRS, .friction = CAROM_FRICTION_CONSTANT},
               {"-hertz1882", "-alciatore-throw"}},
              {{.world = CAROM_WORLD_POOLTOOL},
               {"kiefl2024", "stronge2000", "-mathavan2014", "-bannerman2014", "-hertz1882"}},
              {{.ball_model = CAROM_BALL_MODEL_MIRROR,
                .cushion_model = CAROM_SHOT_CUSHION_MIRROR,
                .simultaneous = CAROM_SIMULTANEOUS_PAIRS},
               {"-stronge2000", "-alciatore-throw", "-joris-accelerating"}}};
  for (size_t k = 0; k < COUNT_OF(rows); k++)
    for (const char *const *key = rows[k].keys; *key != NULL; key++) {
      const bool is_missing = **key == '-';
      ck_assert_msg(cites(&rows[k].options, *key + is_missing) != is_missing, "row %zu: %s", k,
                    *key);
    }

  char all[10000], few[100];
  const size_t length = carom_cite(NULL, all, sizeof all);
  ck_assert_uint_eq(carom_cite(NULL, NULL, 0), length);
  ck_assert_uint_eq(carom_cite(NULL, few, sizeof few), length);
  ck_assert(strlen(few) == sizeof few - 1 && strncmp(few, all, sizeof few - 1) == 0);
  const carom_shot_options wrong = {.reserved = {1}};
  ck_assert_uint_eq(carom_cite(&wrong, few, sizeof few), 0);
  ck_assert_str_eq(few, "");
}

/* ---- Names */

TEST(names) {
  ck_assert_str_eq(carom_word(CAROM_WORDS_EVENT, CAROM_EVENT_POCKET), "ball_pocket");
  ck_assert_str_eq(carom_word(CAROM_WORDS_EVENT, CAROM_EVENT_RAIL_TOP), "rail_top");
  ck_assert_str_eq(carom_word(CAROM_WORDS_LABEL, CAROM_BALL_ROLLING), "rolling");
  ck_assert_str_eq(carom_word(CAROM_WORDS_TABLE, CAROM_TABLE_POOL_9FT), "9ft");
  ck_assert_ptr_null(carom_word(CAROM_WORDS_TABLE, TABLES));
  ck_assert_str_eq(carom_word(CAROM_WORDS_RACK, CAROM_RACK_EIGHTBALL), "eightball");

  /* rails and pockets of rectangles only, whatever the numbers of parts */
  static const carom_corner bent[6] = {{0, 0, 0.13},  {2.4, 0, 0.13},   {2.4, 1.3, 0.13},
                                       {1.3, 1.3, 0}, {1.3, 2.4, 0.13}, {0, 2.4, 0.13}};
  static const int64_t numbers[] = {-1,      INT64_MIN, CAROM_RAILS_MOST + 1,
                                    1000000, INT64_MAX, 4562254508917369340};
  carom_table t;
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  ck_assert_str_eq(carom_rail_name(&t, 0), "left");
  ck_assert_str_eq(carom_rail_name(&t, 5), "foot");
  ck_assert_str_eq(carom_pocket_name(&t, 0), "head-left");
  expect_ok(carom_table_polygon(bent, 6, 0.0365, 0.02, 0.028575, &t, NULL));
  for (int k = 0; k < 6; k++) {
    ck_assert_ptr_null(carom_rail_name(&t, k));
    ck_assert_ptr_null(carom_pocket_name(&t, k));
  }
  for (int which = 0; which < 2; which++)
    for (size_t k = 0; k < COUNT_OF(numbers); k++) {
      carom_table_make(CAROM_TABLE_POOL_9FT, &t);
      *(which == 0 ? &t.rails : &t.pockets) = numbers[k];
      for (int part = 0; part < 2000000; part += 99999) {
        ck_assert_ptr_null(carom_rail_name(&t, part + 40));
        ck_assert_ptr_null(carom_pocket_name(&t, part + 40));
      }
    }
  ck_assert_int_ge(carom_physics_revision(), 1);
}

/* The cue ball jumps into three balls that touch each other: contacts that last, the slate and
 * cushions read the numbers that may represent defaults. */
static void play_jump(const carom_table *t, const carom_ball_kind *kind,
                      const carom_shot_options *options, carom_game game, carom_ball_state *final) {
  carom_shot_ball balls[4];
  const double R = kind->radius, row = sqrt(3.0) * R;
  const double place[4][2] = {{0.0, -0.5}, {0.0, 0.0}, {-R, row}, {R, row}};
  for (int i = 0; i < 4; i++)
    balls[i] = (carom_shot_ball){
        .kind = *kind,
        .state = {.r = {0.5 * t->width + place[i][0], 0.5 * t->length + place[i][1], R}}};
  carom_cue cue = carom_cue_of(game);
  cue.speed = 3.0;
  cue.phi = 88.0;
  cue.theta = 20.0;
  carom_shot shot = {.final = final};
  ck_assert_int_ge(carom_shoot(t, balls, 4, &cue, options, &shot), 0);
}

/* A shot of resolved balls has the bits of the shot of the balls that were given, and resolving
 * again changes nothing. */
TEST(defaults_are_resolved) {
  for (int table = 0; table < TABLES; table++)
    for (int cushion = 0; cushion <= CAROM_SHOT_CUSHION_SMOOTH; cushion++)
      for (int friction = 0; friction <= CAROM_FRICTION_CONSTANT; friction++) {
        const carom_game game = carom_game_of_table((carom_table_kind)table);
        carom_shot_options options = {.cushion_model = (carom_shot_cushion)cushion,
                                      .friction = (carom_ball_friction)friction};
        carom_table t;
        carom_ball_kind kind;
        carom_ball_state given[4], resolved[4];
        carom_table_make((carom_table_kind)table, &t);
        carom_ball_kind_for(game, options.cushion_model, &kind);
        play_jump(&t, &kind, &options, game, given);
        expect_ok(carom_ball_kind_resolve(&t, &options, &kind));
        ck_assert(options.cushion_model != CAROM_SHOT_CUSHION_DEFAULT);
        ck_assert(kind.law_a + kind.law_b > 0.0 && kind.modulus > 0.0 && kind.nose_height > 0.0);
        play_jump(&t, &kind, &options, game, resolved);
        ck_assert_mem_eq(given, resolved, sizeof given);
        const carom_ball_kind once = kind;
        expect_ok(carom_ball_kind_resolve(NULL, NULL, &kind));
        ck_assert_mem_eq(&once, &kind, sizeof kind);
      }
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_SNOOKER); /* without its own law */
  carom_shot_options wrong = {.friction = (carom_ball_friction)9};
  ck_assert_int_eq(carom_ball_kind_resolve(NULL, NULL, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_ball_kind_resolve(NULL, &wrong, &kind), CAROM_ERROR_FRICTION);
  ck_assert(kind.law_a == 0.0);
}

/* Spots of racks are marks of their table; the marks of a table of snooker are the rule book's. */
TEST(marks_of_tables) {
  carom_table t;
  carom_marks marks;
  for (int kind = 0; kind < TABLES; kind++) {
    double head[2], foot[2];
    carom_table_make((carom_table_kind)kind, &t);
    expect_ok(carom_table_marks(&t, &marks));
    carom_spot_of(CAROM_RACK_EIGHTBALL, &t, 0, head);
    carom_spot_of(CAROM_RACK_EIGHTBALL, &t, 1, foot);
    ck_assert_mem_eq(marks.head_spot, head, sizeof head);
    ck_assert_mem_eq(marks.foot_spot, foot, sizeof foot);
    ck_assert(marks.centre_spot[0] == 0.5 * t.width && marks.centre_spot[1] == 0.5 * t.length);
    ck_assert(marks.baulk_line == 0.2 * t.length);
  }
  carom_table_make(CAROM_TABLE_SNOOKER, &t);
  carom_table_marks(&t, &marks);
  ck_assert(fabs(marks.d_centre[1] - 0.737) < 1e-3 && fabs(marks.d_radius - 0.292) < 1e-3);
}
