/* What a game asks besides shots: whether a table is sound, whether a place is free, how balls
 * have turned, and names. */
#include "carom_shot.h"
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { TABLES = CAROM_TABLE_FOURBALL + 1 };

static double radius_on(int kind) {
  static const carom_game game_of[TABLES] = {[CAROM_TABLE_SNOOKER] = CAROM_GAME_SNOOKER,
                                             [CAROM_TABLE_THREECUSHION] = CAROM_GAME_BILLIARD,
                                             [CAROM_TABLE_BLACKBALL] = CAROM_GAME_BLACKBALL,
                                             [CAROM_TABLE_PYRAMID] = CAROM_GAME_PYRAMID,
                                             [CAROM_TABLE_FOURBALL] = CAROM_GAME_FOURBALL};
  return carom_ball_kind_of(game_of[kind]).radius;
}

/* ---- Tables */

static void take_out(carom_table *t, int part) {
  if (part < t->rails) {
    memmove(&t->rail[part], &t->rail[part + 1], (size_t)(t->rails - part - 1) * sizeof *t->rail);
    t->rails--;
  } else if (part < t->rails + t->jaws) {
    part -= (int)t->rails;
    memmove(&t->jaw[part], &t->jaw[part + 1], (size_t)(t->jaws - part - 1) * sizeof *t->jaw);
    t->jaws--;
  } else {
    part -= (int)(t->rails + t->jaws);
    memmove(&t->pocket[part], &t->pocket[part + 1],
            (size_t)(t->pockets - part - 1) * sizeof *t->pocket);
    t->pockets--;
  }
}

/* Plays some shots of a lone ball: how many lose it, and how often it meets a rail. */
static int lost_balls(const carom_table *t, double R, int rail, int shots, random_source *r,
                      int *contacts) {
  int lost = 0;
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  ball.kind.radius = R;
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_MIRROR};
  *contacts = 0;
  for (int k = 0; k < shots; k++) {
    carom_place_ball(t, &ball, 1, 0, 0.5 * t->width, 0.5 * t->length, NULL);
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = 9.0;
    cue.phi = random_between(r, 0.0, 360.0);
    carom_brief_event events[100];
    carom_shot shot = {.brief = events, .room = 100};
    lost += carom_shoot(t, &ball, 1, &cue, &options, &shot) == CAROM_ERROR_LEFT_TABLE;
    for (int64_t e = 0; e < shot.count && e < shot.room; e++)
      *contacts += events[e].type == CAROM_EVENT_RAIL && events[e].b == rail;
  }
  return lost;
}

/* The built-in tables are sound; a table without any one of their parts is found open exactly
 * where a ball can get out, and the hole is beside what is missing; a rail with the wrong side,
 * or a line that is not its own, is named. */
TEST(tables_are_checked) {
  random_source r = {test_seed()};
  int holes = 0, sides = 0, rails = 0;
  for (int kind = 0; kind < TABLES; kind++) {
    const double R = radius_on(kind);
    carom_table sound, t;
    carom_table_fault fault;
    carom_table_make((carom_table_kind)kind, &sound);
    ck_assert_int_eq(carom_table_check(&sound, R, &fault), CAROM_OK);
    ck_assert(fault.part.kind == CAROM_PART_NONE && fault.gap == 0.0);
    for (int part = 0; part < sound.rails + sound.jaws + sound.pockets; part++) {
      t = sound;
      take_out(&t, part);
      const carom_status status = carom_table_check(&t, R, &fault);
      ck_assert_msg(status == CAROM_OK || status == CAROM_ERROR_TABLE_OPEN,
                    "%s without part %d: %s", carom_table_name((carom_table_kind)kind), part,
                    carom_status_name(status));
      int contacts;
      const int lost =
          lost_balls(&t, R, -1, kind == CAROM_TABLE_POOL_9FT ? 1000 : 100, &r, &contacts);
      ck_assert_msg(status == CAROM_ERROR_TABLE_OPEN || lost == 0,
                    "%s without part %d: %d balls are lost, and it is ok",
                    carom_table_name((carom_table_kind)kind), part, lost);
      /* a long rail is a hole as wide as itself but for its jaws */
      if (part < sound.rails) {
        const carom_rail *rail = &sound.rail[part];
        const double length = hypot(rail->q[0] - rail->p[0], rail->q[1] - rail->p[1]);
        const double off = hypot(fault.place[0] - 0.5 * (rail->p[0] + rail->q[0]),
                                 fault.place[1] - 0.5 * (rail->p[1] + rail->q[1]));
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
        int contacts;
        lost_balls(&sound, R, k, 400, &r, &contacts);
        ck_assert_int_eq(contacts, 0);
        continue;
      }
      ck_assert_msg(status == CAROM_ERROR_RAIL_SIDE && fault.part.kind == CAROM_PART_RAIL &&
                        fault.part.index == k,
                    "%s, rail %d turned: %s", carom_table_name((carom_table_kind)kind), k,
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

/* Parts that are bad by themselves are named with their kind; tables that are not convex, or
 * have posts, are no trouble. */
TEST(other_tables) {
  carom_table t;
  carom_table_fault fault;
  const double R = 0.028575;
  ck_assert_int_eq(carom_table_check(NULL, R, &fault), CAROM_ERROR_NULL);
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  ck_assert_int_eq(carom_table_check(&t, 0.0, NULL), CAROM_ERROR_RADIUS);
  t.jaw[3].height = 0.2;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_NOSE_HEIGHT);
  ck_assert(fault.part.kind == CAROM_PART_JAW && fault.part.index == 3);
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  t.pocket[2].radius = -1.0;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE);
  ck_assert(fault.part.kind == CAROM_PART_POCKET && fault.part.index == 2);
  /* an L, played on the left of its rails, counter-clockwise */
  static const double corner[6][2] = {{0, 0}, {2, 0}, {2, 0.8}, {1.2, 0.8}, {1.2, 2}, {0, 2}};
  t = (carom_table){.width = 1.2, .length = 1.2, .rails = 6};
  for (int k = 0; k < 6; k++)
    t.rail[k] = (carom_rail){.p = {corner[k][0], corner[k][1]},
                             .q = {corner[(k + 1) % 6][0], corner[(k + 1) % 6][1]},
                             .height = 0.036,
                             .side = 1};
  /* its inner corner must be rounded: detection lets a ball in between the ends of two rails */
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
  ck_assert(hypot(fault.place[0] - 1.2, fault.place[1] - 0.8) < R && fault.part.index == 2 &&
            fault.other.index == 3);
  t.jaw[t.jaws++] = (carom_jaw){.centre = {1.2, 0.8}, .height = 0.036};
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_OK);
  /* a post in the middle, and a wall that is played from one side */
  t.jaw[t.jaws++] = (carom_jaw){.centre = {0.6, 0.6}, .radius = 0.05, .height = 0.036};
  t.rail[t.rails++] = (carom_rail){.p = {0.3, 1.0}, .q = {0.3, 1.5}, .height = 0.036};
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_OK);
  /* a narrow slit is none where the rails still meet; wider, it needs a jaw; then it is a hole */
  t.rail[1].p[1] = 0.028;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_OK);
  t.rail[1].p[1] = 0.05;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
  ck_assert_double_eq_tol(fault.gap, 0.05 - R, 1e-9);
  t.rail[1].p[1] = 0.06;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
  ck_assert_double_eq_tol(fault.gap, 0.06, 1e-9);
  ck_assert_double_eq_tol(fault.place[0], 2.0, 1e-9);
  ck_assert_double_eq_tol(fault.place[1], 0.03, 1e-9);
  /* one rail is no ring */
  t = (carom_table){
      .width = 1, .length = 1, .rails = 1, .rail = {{.p = {0, 0}, .q = {1, 0}, .height = 0.036}}};
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
  ck_assert(fault.part.kind == CAROM_PART_NONE && fault.other.kind == CAROM_PART_NONE);
}

/* A table is searched for a place in rings around the middle of its box, in tenths of the box up to
 * four. Each of these places is found where it is the only free one: four posts, so large that
 * they are nearly straight, close a room of 10 cm around it and cover all others. Without one of
 * the posts the room is open. */
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

/* Two rails of an island that are played from between them. Where a ball does not fit in there, it
 * can only come to their backs, through which it would pass: the first is named. Where it fits,
 * each is met. */
TEST(rails_that_face_each_other) {
  const double R = 0.028575;
  const double gaps[] = {R, 2.0 * R - 1e-5, 2.0 * R + 1e-5, 4.0 * R};
  for (int n = 0; n < 4; n++) {
    carom_table t;
    carom_table_fault fault;
    carom_table_make(CAROM_TABLE_THREECUSHION, &t);
    const int first = (int)t.rails;
    const double x = 0.3 * t.width, y = 0.3 * t.length, height = t.rail[0].height;
    t.rail[t.rails++] = (carom_rail){.p = {x, y}, .q = {x, y + 0.4}, .height = height, .side = 0};
    t.rail[t.rails++] = (carom_rail){
        .p = {x + gaps[n], y}, .q = {x + gaps[n], y + 0.4}, .height = height, .side = 1};
    const carom_status status = carom_table_check(&t, R, &fault);
    if (gaps[n] > 2.0 * R) {
      ck_assert_int_eq(status, CAROM_OK);
      continue;
    }
    ck_assert_int_eq(status, CAROM_ERROR_RAIL_SIDE);
    ck_assert(fault.part.kind == CAROM_PART_RAIL && fault.part.index == first);
    ck_assert_double_eq_tol(fault.place[0], x, 1e-12);
    ck_assert_double_eq_tol(fault.place[1], y + 0.2, 1e-12);
  }
}

/* ---- Ball in hand */

/* A place is free exactly where carom_shot_check() has nothing against it, and what is in the
 * way is there. */
TEST(places) {
  random_source r = {test_seed()};
  int free_ones = 0, seen[5] = {0};
  for (int kind = 0; kind < TABLES; kind++) {
    carom_table t;
    carom_shot_ball balls[10], original[10];
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
      memcpy(original, balls, sizeof balls);
      carom_part part;
      const carom_status status = carom_place_ball(&t, balls, 10, ball, x, y, &part);
      /* the ball with each of the others, or alone */
      carom_shot_ball pair[2] = {original[ball]};
      pair[0].state = (carom_ball_state){.r = {x, y, radius_on(kind)}};
      bool stands = carom_shot_check(&t, pair, 1, NULL, NULL, NULL) == CAROM_OK, overlaps = false;
      for (int k = 0; k < 10 && stands; k++) {
        pair[1] = original[k];
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
        balls[ball].state = original[ball].state;
        free_ones++;
      }
      ck_assert_int_eq(memcmp(balls, original, sizeof balls), 0);
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
  carom_table t;
  carom_shot_ball single = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  ck_assert_int_eq(carom_place_ball(&t, &single, 1, 1, 0.5, 0.5, NULL), CAROM_ERROR_BALLS);
  ck_assert_int_eq(carom_place_ball(&t, &single, 1, 0, NAN, 0.5, NULL), CAROM_ERROR_POSITION);
  ck_assert_int_eq(carom_place_ball(NULL, &single, 1, 0, 0.5, 0.5, NULL), CAROM_ERROR_NULL);
  single.kind.radius = -1.0;
  ck_assert_int_eq(carom_place_ball(&t, &single, 1, 0, 0.5, 0.5, NULL), CAROM_ERROR_RADIUS);
}

/* ---- Places on tables of one's own */

/* Some times as fast as hypot(), of which floods take most of their time. */
static double length(double x, double y) {
  return sqrt(x * x + y * y);
}

/* How far the surface of a ball at a place is from the next cushion. */
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

/* How far a place is from the next pocket; negative inside. */
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

/* Finds the places of a grid to which a ball can be rolled from one of them, by flooding; n
 * becomes their numbers. */
static void flood(const carom_table *t, double R, double step, const double start[2], int n[2]) {
  static int queue[MOST_PLACES * MOST_PLACES];
  int waiting = 0;
  n[0] = (int)((t->width + 2.0 * margin) / step);
  n[1] = (int)((t->length + 2.0 * margin) / step);
  ck_assert(n[0] < MOST_PLACES && n[1] < MOST_PLACES);
  memset(reached, 0, sizeof reached);
  const int i0 = (int)((start[0] + margin) / step), j0 = (int)((start[1] + margin) / step);
  queue[waiting++] = i0 * MOST_PLACES + j0;
  reached[i0][j0] = 1;
  while (waiting > 0) {
    const int index = queue[--waiting];
    for (int way = 0; way < 4; way++) {
      const int i = index / MOST_PLACES + (way == 0) - (way == 1),
                j = index % MOST_PLACES + (way == 2) - (way == 3);
      const double x = i * step - margin, y = j * step - margin;
      ck_assert_msg(i > 0 && i < n[0] && j > 0 && j < n[1], "the table has a hole");
      if (!reached[i][j] && room_at(t, R, x, y) > 0.0 && off_pockets(t, x, y) >= 0.0) {
        reached[i][j] = 1;
        queue[waiting++] = i * MOST_PLACES + j;
      }
    }
  }
}

/* Both ways to ask whether a ball may stand at a place. */
static void expect_place(const carom_table *t, double R, double x, double y, bool free_one) {
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  const carom_status expected = free_one ? CAROM_OK : CAROM_ERROR_OFF_TABLE;
  ball.kind.radius = R;
  const carom_status status = carom_place_ball(t, &ball, 1, 0, x, y, NULL);
  ck_assert_msg(status == expected, "(%.17g, %.17g): %s", x, y, carom_status_name(status));
  ball.state = (carom_ball_state){.r = {x, y, R}};
  ck_assert_int_eq(carom_shot_check(t, &ball, 1, NULL, NULL, NULL), expected);
}

/* A ball may stand at all places of a grid to which it can be rolled, and nowhere else. */
static void expect_flooded(const carom_table *t, double R, double step, const double start[2]) {
  int n[2];
  flood(t, R, step, start, n);
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++) {
      const double x = i * step - margin, y = j * step - margin;
      if (fabs(room_at(t, R, x, y)) > 1.1e-6)
        expect_place(t, R, x, y, reached[i][j]);
    }
}

/* On the built-in tables a ball may stand at all places of a grid to which it can be rolled from
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
  carom_corner reversed[6];
  for (int k = 0; k < 6; k++)
    reversed[k] = pool[5 - k];
  carom_table t, turned;
  carom_table_fault fault;
  ck_assert_int_eq(carom_table_polygon(pool, 6, 0.0366, r, R, &t, &fault), CAROM_OK);
  ck_assert_int_eq(carom_table_polygon(reversed, 6, 0.0366, r, R, &turned, NULL), CAROM_OK);
  ck_assert_int_eq(t.rails + t.jaws + t.pockets, 6 + 12 + 6);
  ck_assert(t.width == 1.27 && t.length == 2.54 && t.ball_radius == R);
  for (int k = 0; k < 6; k++) {
    const double *previous = t.jaw[2 * k].centre, *next = t.jaw[2 * k + 1].centre;
    const carom_rail *rail = &t.rail[(k + 5) % 6], *two = &t.rail[k];
    ck_assert_double_eq_tol(hypot(next[0] - previous[0], next[1] - previous[1]),
                            pool[k].mouth + 2.0 * r, 1e-12);
    ck_assert_double_eq_tol(hypot(next[0] - two->p[0], next[1] - two->p[1]), r, 1e-12);
    ck_assert_double_eq_tol(hypot(previous[0] - rail->q[0], previous[1] - rail->q[1]), r, 1e-12);
    bool found = false;
    for (int i = 0; i < 6; i++)
      found |= hypot(t.pocket[k].centre[0] - turned.pocket[i].centre[0],
                     t.pocket[k].centre[1] - turned.pocket[i].centre[1]) < 1e-12;
    ck_assert(found);
  }
  /* the middle may be outside of the table: an L, and a U, in both arms of which balls can lie */
  static const carom_corner bent[6] = {{0, 0, 0},     {2, 0, 0},   {2, 0.5, 0},
                                       {0.5, 0.5, 0}, {0.5, 2, 0}, {0, 2, 0}};
  static const carom_corner u[8] = {{0, 0, 0}, {3, 0, 0}, {3, 2.4, 0}, {2, 2.4, 0},
                                    {2, 1, 0}, {1, 1, 0}, {1, 2.4, 0}, {0, 2.4, 0}};
  ck_assert_int_eq(carom_table_polygon(bent, 6, 0.0366, r, R, &t, &fault), CAROM_OK);
  for (int open = 0; open < 2; open++) {
    ck_assert_int_eq(carom_table_polygon(u, 8, 0.0366, r, R, &t, &fault), CAROM_OK);
    if (open) { /* a hole in the bottom of the U */
      t.rail[0].q[0] = 1.5;
      ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_TABLE_OPEN);
      break;
    }
    carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
    static const double corners[4][2] = {{0.5, 2.0}, {2.5, 2.0}, {1.5, 0.5}, {1.5, 1.8}};
    carom_part part;
    for (int k = 0; k < 4; k++)
      ck_assert_int_eq(carom_place_ball(&t, &ball, 1, 0, corners[k][0], corners[k][1], &part) ==
                           CAROM_OK,
                       k < 3);
    for (int k = 0; k < t.rails; k++)
      ck_assert_ptr_null(carom_rail_name(&t, k));
  }
  ck_assert_int_eq(carom_table_polygon(pool, 2, 0.0366, r, R, &t, &fault), CAROM_ERROR_CORNERS);
  /* a bow, by which the area may be 0, and a spike that touches the opposite side */
  static const carom_corner bow[4] = {{0, 0, 0}, {2, 1, 0}, {2, 0, 0}, {0, 1, 0}},
                            spike[5] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  ck_assert_int_eq(carom_table_polygon(bow, 4, 0.0366, r, R, &t, &fault), CAROM_ERROR_SIDES_CROSS);
  ck_assert(fault.part.kind == CAROM_PART_RAIL && fault.part.index == 0 && fault.other.index == 2);
  ck_assert_int_eq(carom_table_polygon(spike, 5, 0.0366, r, R, &t, NULL), CAROM_ERROR_SIDES_CROSS);
  ck_assert_int_eq(carom_table_polygon(pool, 6, 0.0366, -r, R, &t, NULL), CAROM_ERROR_JAW_RADIUS);
  ck_assert_int_eq(carom_table_polygon(pool, 6, 0.2, r, R, &t, NULL), CAROM_ERROR_NOSE_HEIGHT);
  ck_assert_int_eq(carom_table_polygon(pool, 6, 0.0366, r, NAN, &t, NULL), CAROM_ERROR_RADIUS);
  ck_assert_int_eq(carom_table_polygon(NULL, 6, 0.0366, r, R, &t, NULL), CAROM_ERROR_NULL);
}

/* Each fault of a polygon has a status of its own, and names its corners. */
TEST(faults_of_polygons) {
  static const double R = 0.028575, r = 0.01;
  static const carom_corner square[4] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                            line[3] = {{0, 0, 0}, {1, 1, 0}, {3, 3, 0}};
  carom_table t;
  carom_table_fault fault;
  const struct {
    int position;
    carom_corner corner;
    carom_status status;
    int first, second; /* -1: none */
  } wrong[] = {{1, {NAN, 0, 0}, CAROM_ERROR_CORNER, 1, -1},
               {2, {2, 2e6, 0}, CAROM_ERROR_CORNER, 2, -1},
               {3, {0, 2, -0.1}, CAROM_ERROR_CORNER, 3, -1},
               {2, {2, 0, 0}, CAROM_ERROR_CORNERS_MEET, 1, 2},
               {3, {0, 2, 4.0}, CAROM_ERROR_MOUTHS, 2, 3}};
  for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++)
    for (int turned = 0; turned < 2; turned++) {
      /* the same corners the other way round, in which a fault has another place */
      carom_corner corner[4];
      for (int n = 0; n < 4; n++)
        corner[turned ? 3 - n : n] = n == wrong[k].position ? wrong[k].corner : square[n];
      ck_assert_int_eq(carom_table_polygon(corner, 4, 0.0366, r, R, &t, &fault), wrong[k].status);
      ck_assert_int_eq(fault.part.kind, CAROM_PART_CORNER);
      if (turned)
        continue;
      ck_assert_int_eq(fault.part.index, wrong[k].first);
      ck_assert_int_eq(fault.other.kind, wrong[k].second < 0 ? CAROM_PART_NONE : CAROM_PART_CORNER);
      ck_assert(wrong[k].second < 0 || fault.other.index == wrong[k].second);
    }
  ck_assert_int_eq(carom_table_polygon(line, 3, 0.0366, r, R, &t, &fault),
                   CAROM_ERROR_CORNERS_IN_LINE);

  /* the ninth pocket, and the jaws of a star */
  carom_corner round[32];
  for (int k = 0; k < 32; k++) {
    const double way = 6.283185307179586 * k / 32.0, far = k % 2 == 0 ? 3.0 : 1.5;
    round[k] = (carom_corner){far * cos(way), far * sin(way), 0.0};
  }
  for (int k = 0; k < 32; k++)
    round[k].mouth = k % 2 == 0 && k < 18 ? 0.1 : 0.0;
  ck_assert_int_eq(carom_table_polygon(round, 32, 0.0366, r, R, &t, &fault), CAROM_ERROR_POCKETS);
  ck_assert(fault.part.kind == CAROM_PART_CORNER && fault.part.index == 16);
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  t.pockets = 9;
  ck_assert_int_eq(carom_table_check(&t, R, &fault), CAROM_ERROR_POCKETS);
  ck_assert(fault.part.kind == CAROM_PART_POCKET && fault.part.index == 8);
}

/* A polygon from any origin is the same table. */
TEST(polygons_take_any_origin) {
  static const double R = 0.028575, origin[3][2] = {{-1.0, -2.0}, {-8.0, 4.0}, {16.0, 32.0}};
  static const carom_corner square[4] = {{0, 0, 0.125}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0.125}};
  carom_table at_origin, t;
  ck_assert_int_eq(carom_table_polygon(square, 4, 0.0366, 0.01, R, &at_origin, NULL), CAROM_OK);
  for (int k = 0; k < 3; k++) {
    carom_corner moved[4];
    for (int n = 0; n < 4; n++)
      moved[n] =
          (carom_corner){square[n].x + origin[k][0], square[n].y + origin[k][1], square[n].mouth};
    ck_assert_int_eq(carom_table_polygon(moved, 4, 0.0366, 0.01, R, &t, NULL), CAROM_OK);
    ck_assert_mem_eq(&t, &at_origin, sizeof t);
  }
}

/* The same on a table in the shape of a U, whose middle is outside of it, with pockets at the ends
 * of its arms; and on one with a corner so sharp that there is room behind its pocket. Rays through
 * slits that no ball passes once told otherwise, and so did places beyond the ends of short
 * rails. */
TEST(places_on_odd_shapes) {
  static const carom_corner u[8] = {{0, 0, 0},     {1.8, 0, 0},   {1.8, 1.5, 0.1}, {1.2, 1.5, 0.1},
                                    {1.2, 0.6, 0}, {0.6, 0.6, 0}, {0.6, 1.5, 0.1}, {0, 1.5, 0.1}};
  static const carom_corner sharp[3] = {{0, 0, 0.13}, {2, 0.5, 0}, {2, 1.2, 0}};
  /* behind the short rails of this one, places are beyond the ends of each rail by more than the
   * rail's length */
  static const carom_corner few[9] = {
      {0, 0.939, 0.135},     {0.13, 0.61, 0.135},   {0.26, 0.281, 0.135},
      {0.541, 0.141, 0.135}, {0.822, 0, 0.135},     {1.373, 0.445, 0.135},
      {1.11, 1.166, 0.135},  {0.761, 1.419, 0.135}, {0.412, 1.672, 0}};
  static const double in_u[2] = {0.9, 0.3}, in_sharp[2] = {1.6, 0.7}, in_few[2] = {0.7, 0.8};
  const double R = 0.028575;
  carom_table t;
  ck_assert_int_eq(carom_table_polygon(u, 8, 0.0365, 0.01, R, &t, NULL), CAROM_OK);
  expect_flooded(&t, R, 0.01, in_u);
  ck_assert_int_eq(carom_table_polygon(sharp, 3, 0.0365, 0.01, R, &t, NULL), CAROM_OK);
  expect_flooded(&t, R, 0.01, in_sharp);
  ck_assert_int_eq(carom_table_polygon(few, 9, 0.0365, 0.0266, R, &t, NULL), CAROM_OK);
  expect_flooded(&t, R, 0.01, in_few);
}

/* Under a ball that flies, where one has left the table, and beside balls and cushions of other
 * sizes. */
TEST(places_in_space) {
  carom_table t;
  carom_part part;
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  carom_shot_ball balls[2] = {{.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL)},
                              {.kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL)}};
  const double R = balls[0].kind.radius;
  for (int k = 0; k < 2; k++) {
    balls[1].state = (carom_ball_state){.r = {0.5, 0.5, (k == 0 ? 3.001 : 2.999) * R}};
    ck_assert_int_eq(carom_place_ball(&t, balls, 2, 0, 0.5, 0.5, &part),
                     k == 0 ? CAROM_OK : CAROM_ERROR_OVERLAP);
    ck_assert_int_eq(part.kind, k == 0 ? CAROM_PART_NONE : CAROM_PART_BALL);
  }
  balls[1].state = (carom_ball_state){.r = {0.5, 0.5, R}, .label = CAROM_BALL_OFF};
  ck_assert_int_eq(carom_place_ball(&t, balls, 2, 0, 0.5, 0.5, &part), CAROM_OK);
  /* in the air and below the tops of the rails, a ball can be nearer to a rail than on the cloth */
  for (int k = 0; k < 6 * 9; k++) {
    const carom_rail *rail = &t.rail[k / 9];
    const double z = (1.6 + 0.2 * (k % 3)) * R, above = z - rail->height, h0 = rail->height;
    static const double ends[3] = {0.003, 0.5, 0.997};
    const double along = ends[k / 3 % 3];
    const double clear = R - sqrt(h0 * (2.0 * R - h0)) + sqrt(R * R - above * above);
    const int axis = rail->p[0] == rail->q[0] ? 0 : 1; /* that of the rail's normal */
    const double inward = rail->p[axis] == 0.0 ? 1.0 : -1.0;
    for (int off = -1; off <= 1; off += 2) {
      balls[1].state = (carom_ball_state){.r = {0, 0, z}};
      for (int c = 0; c < 2; c++)
        balls[1].state.r[c] = rail->p[c] + along * (rail->q[c] - rail->p[c]);
      balls[1].state.r[axis] += inward * (clear + 3e-6 * off);
      ck_assert_int_eq(carom_shot_check(&t, &balls[1], 1, NULL, NULL, NULL),
                       off < 0 ? CAROM_ERROR_OFF_TABLE : CAROM_OK);
    }
  }
  /* a large ball, on a table for small ones: as near to the nose and to the ball as
   * carom_shot_check() lets it */
  balls[0].kind.radius = 0.0302;
  balls[1].state = (carom_ball_state){.r = {0.5, 0.5, R}};
  const double h = t.rail[0].height, shift = R - sqrt(h * (2.0 * R - h)),
               distance = 2.0 * sqrt(R * 0.0302), nose = shift + sqrt(h * (2.0 * 0.0302 - h));
  for (int k = -1; k <= 1; k += 2) {
    const carom_status expected = k < 0 ? CAROM_ERROR_OVERLAP : CAROM_OK;
    ck_assert_int_eq(carom_place_ball(&t, balls, 2, 0, 0.5 + distance + 2e-6 * k, 0.5, &part),
                     expected);
    ck_assert_int_eq(carom_place_ball(&t, balls, 2, 0, nose + 2e-6 * k, 0.7, &part),
                     k < 0 ? CAROM_ERROR_OFF_TABLE : CAROM_OK);
    ck_assert_int_eq(part.kind, k < 0 ? CAROM_PART_RAIL : CAROM_PART_NONE);
  }
  ck_assert_int_eq(carom_shot_check(&t, balls, 2, NULL, NULL, NULL), CAROM_OK);
  /* such tables are sound for such balls too, and bad numbers of a table's space are told */
  t.ball_radius = R;
  ck_assert_int_eq(carom_table_check(&t, 0.0302, NULL), CAROM_OK);
  ck_assert_int_eq(carom_table_check(&t, 0.0262, NULL), CAROM_OK);
  for (int k = 0; k < 3; k++) {
    carom_table wrong = t;
    (&wrong.ball_radius)[k] = -0.01;
    carom_table_fault fault;
    ck_assert_int_eq(carom_table_check(&wrong, R, &fault), CAROM_ERROR_TABLE);
    ck_assert_int_eq(fault.part.kind, CAROM_PART_NONE);
  }
}

/* ---- How balls have turned */

/* The rotation by plain steps of Q' = [w] Q / 2, of order 4, with w from carom_shot_at(): what
 * the library does in closed form.
 */
static void by_steps(const carom_shot_ball *balls, int count, const carom_shot *shot, int ball,
                     double start, double end, double q[4]) {
  const int steps = 2000 + (int)(5000.0 * (end - start));
  const double h = (end - start) / steps;
  carom_ball_state s[CAROM_BALLS_MOST];
  for (int n = 0; n < steps; n++) {
    double k[4][4];
    for (int stage = 0; stage < 4; stage++) {
      /* just inside the interval, as the spin jumps at events */
      static const double parts[4] = {1e-6, 0.5, 0.5, 1.0 - 1e-6}, shares[4] = {0.0, 0.5, 0.5, 1.0};
      const double part = parts[stage];
      carom_shot_at(balls, count, shot, start + (n + part) * h, s);
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
    for (int k = 0; k < 2; k++)
      ball.state.v[k] = random_between(&r, -2.0, 2.0);
    for (int k = 0; k < 3; k++)
      ball.state.w[k] = random_between(&r, -100.0, 100.0);
    /* half of them fly, with a constant spin */
    ball.state.v[2] = n % 2 * random_between(&r, -2.0, 2.0);
    carom_shot shot = {.events = events, .room = 200};
    ck_assert_int_eq(carom_shoot(&t, &ball, 1, NULL, NULL, &shot), CAROM_OK);
    ck_assert_int_le(shot.count, 200);
    double time = 0.0;
    for (int64_t k = 0; k < shot.count; k++) {
      const double end = events[k].time;
      const double side = k == 0 ? ball.state.w[2] : events[k - 1].after[0].w[2];
      /* reference steps do not cross the end of the side spin */
      const double kink =
          time + fabs(side) / (2.5 * ball.kind.mu_spin * ball.kind.gravity / ball.kind.radius);
      double start[1][4], turned[1][4], q[4];
      carom_shot_orientation(&ball, 1, &shot, time, start);
      carom_shot_orientation(&ball, 1, &shot, end, turned);
      memcpy(q, start[0], sizeof q);
      const double cut = kink > time && kink < end ? kink : end;
      by_steps(&ball, 1, &shot, 0, time, cut, q);
      if (cut < end)
        by_steps(&ball, 1, &shot, 0, cut, end, q);
      worst = fmax(worst, angle_between(q, turned[0]));
      time = end;
    }
  }
  printf("largest difference from steps of 0.2 ms: %.2g rad\n", worst);
  ck_assert_msg(worst < 1e-7, "%g rad", worst);
}

/* A ball that rolls straight turns by its way over R about the axis across it; on the spot about
 * the vertical. */
TEST(turns_in_closed_form) {
  carom_table t;
  carom_event events[20];
  carom_table_make(CAROM_TABLE_POOL_9FT, &t);
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  const double R = ball.kind.radius;
  ball.state =
      (carom_ball_state){.r = {0.2, 0.3, R}, .v = {0.3, 0.4, 0.0}, .w = {-0.4 / R, 0.3 / R, 0.0}};
  carom_shot shot = {.events = events, .room = 20};
  carom_ball_state s;
  double q[1][4];
  ck_assert_int_eq(carom_shoot(&t, &ball, 1, NULL, NULL, &shot), CAROM_OK);
  for (double time = 0.0; time < shot.time; time += 0.173) {
    carom_shot_at(&ball, 1, &shot, time, &s);
    carom_shot_orientation(&ball, 1, &shot, time, q);
    const double half = 0.5 * hypot(s.r[0] - 0.2, s.r[1] - 0.3) / R,
                 expected[4] = {cos(half), -0.8 * sin(half), 0.6 * sin(half), 0};
    ck_assert_double_lt(angle_between(q[0], expected), 1e-12);
  }
  ball.state = (carom_ball_state){.r = {0.2, 0.3, R}, .w = {0, 0, 77.0}};
  ck_assert_int_eq(carom_shoot(&t, &ball, 1, NULL, NULL, &shot), CAROM_OK);
  for (double time = 0.0; time < shot.time; time += 0.11) {
    carom_shot_orientation(&ball, 1, &shot, time, q);
    const double fall = 2.5 * ball.kind.mu_spin * ball.kind.gravity / R,
                 half = 0.5 * (77.0 - 0.5 * fall * time) * time;
    const double expected[4] = {cos(half), 0, 0, sin(half)};
    ck_assert_double_lt(angle_between(q[0], expected), 1e-12);
  }
  /* in flight about the axis of the spin, as long as it flies */
  ball.state = (carom_ball_state){.r = {0.6, 0.6, R + 0.3}, .w = {30.0, 40.0, 120.0}};
  ck_assert_int_eq(carom_shoot(&t, &ball, 1, NULL, NULL, &shot), CAROM_OK);
  for (double time = 0.0; time < 0.24; time += 0.017) {
    carom_shot_orientation(&ball, 1, &shot, time, q);
    const double half = 65.0 * time, share = sin(half) / 13.0,
                 expected[4] = {cos(half), 3.0 * share, 4.0 * share, 12.0 * share};
    ck_assert_double_lt(angle_between(q[0], expected), 1e-12);
  }
  /* what carom_shot_at() refuses is refused */
  ck_assert_int_eq(carom_shot_orientation(&ball, 1, &shot, NAN, q), CAROM_ERROR_TIME);
  ck_assert_int_eq(carom_shot_orientation(&ball, 1, &shot, 0.0, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shot_orientation(&ball, 1, &(carom_shot){.count = 3, .time = 1.0}, 0.5, q),
                   CAROM_ERROR_EVENTS_LOST);
}

/* A frame of a film has the bits of single calls. */
static void same_frame(const carom_shot_ball *balls, const carom_shot *shot, double time,
                       carom_frames *film) {
  carom_ball_state first[16], second[16];
  double q[16][4], turned[16][4];
  ck_assert_int_eq(carom_shot_frames(balls, 16, shot, &time, 1, film, second, turned), CAROM_OK);
  ck_assert_int_eq(carom_shot_at(balls, 16, shot, time, first), CAROM_OK);
  ck_assert_int_eq(carom_shot_orientation(balls, 16, shot, time, q), CAROM_OK);
  ck_assert(memcmp(first, second, sizeof first) == 0 && memcmp(q, turned, sizeof q) == 0);
}

/* Frames have the bits of single calls, however they are cut, also where a shot goes on, where time
 * goes back, jumps or runs back to the beginning, and where the memory is that of another shot's
 * film. */
TEST(frames) {
  static carom_shot_state state;
  static carom_frames film;
  carom_table t;
  carom_shot_ball balls[16];
  carom_event events[2000];
  carom_ball_state final[16], first[16], second[3 * 16];
  double q[16][4], turned[3 * 16][4];
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
      const size_t many = 1 + (size_t)(3 * random_between(&r, 0.0, 1.0));
      ck_assert_int_eq(carom_shot_frames(balls, 16, &shot, times, many, &film, second, turned),
                       CAROM_OK);
      for (size_t k = 0; k < many; k++) {
        ck_assert_int_eq(carom_shot_at(balls, 16, &shot, times[k], first), CAROM_OK);
        ck_assert_int_eq(carom_shot_orientation(balls, 16, &shot, times[k], q), CAROM_OK);
        ck_assert(memcmp(first, &second[k * 16], sizeof first) == 0);
        ck_assert(memcmp(q, &turned[k * 16], sizeof q) == 0);
      }
      /* back now and then, and on with the shot */
      if (random_between(&r, 0.0, 1.0) < 0.1 && time > 0.2)
        time -= 0.2;
      if (options.time_most > 0.0 && time > 1.4) {
        options.time_most = 0.0;
        ck_assert_int_eq(carom_shot_continue(&t, balls, 16, &options, &shot), CAROM_OK);
      }
    }
    ck_assert(options.time_most == 0.0);
    for (int k = 0; k < 50; k++)
      same_frame(balls, &shot, shot.time * random_between(&r, 0.0, 1.0), &film);
    for (double time = shot.time; time > 0.0; time -= 0.04)
      same_frame(balls, &shot, time, &film);
  }
  ck_assert_int_eq(carom_shot_frames(balls, 16, NULL, NULL, 0, &film, second, turned),
                   CAROM_ERROR_NULL);
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
  ck_assert(cites(NULL, "carom") && cites(NULL, "mathavan2014") && cites(NULL, "han2005"));
  ck_assert(cites(NULL, "joris-accelerating"));
  ck_assert(cites(NULL, "hertz1882") && !cites(NULL, "mathavan2010") && !cites(NULL, "kiefl2024"));
  carom_shot_options o = {.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN};
  ck_assert(cites(&o, "mathavan2010") && !cites(&o, "han2005"));
  o.cushion_model = CAROM_SHOT_CUSHION_SMOOTH;
  ck_assert(cites(&o, "threecushiontool") && cites(&o, "han2005"));
  o = (carom_shot_options){.simultaneous = CAROM_SIMULTANEOUS_PAIRS,
                           .friction = CAROM_FRICTION_CONSTANT};
  ck_assert(!cites(&o, "hertz1882") && !cites(&o, "alciatore-throw"));
  o = (carom_shot_options){.world = CAROM_WORLD_POOLTOOL};
  ck_assert(cites(&o, "kiefl2024") && cites(&o, "stronge2000"));
  ck_assert(!cites(&o, "mathavan2014") && !cites(&o, "bannerman2014") && !cites(&o, "hertz1882"));
  o = (carom_shot_options){.ball_model = CAROM_BALL_MODEL_MIRROR,
                           .cushion_model = CAROM_SHOT_CUSHION_MIRROR,
                           .simultaneous = CAROM_SIMULTANEOUS_PAIRS};
  ck_assert(!cites(&o, "stronge2000") && !cites(&o, "alciatore-throw"));
  ck_assert(!cites(&o, "joris-accelerating"));

  char text[10000], few[100];
  const size_t length = carom_cite(NULL, text, sizeof text);
  ck_assert_uint_eq(carom_cite(NULL, NULL, 0), length);
  ck_assert_uint_eq(carom_cite(NULL, few, sizeof few), length);
  ck_assert(strlen(few) == sizeof few - 1 && strncmp(few, text, sizeof few - 1) == 0);
  o.reserved[0] = 1;
  ck_assert_uint_eq(carom_cite(&o, few, sizeof few), 0);
  ck_assert_str_eq(few, "");
}

/* ---- Names */

TEST(names) {
  ck_assert_str_eq(carom_event_name(CAROM_EVENT_POCKET), "ball_pocket");
  ck_assert_str_eq(carom_event_name(CAROM_EVENT_RAIL_TOP), "rail_top");
  ck_assert_str_eq(carom_label_name(CAROM_BALL_ROLLING), "rolling");
  ck_assert_str_eq(carom_table_name(CAROM_TABLE_POOL_9FT), "9ft");
  ck_assert_ptr_null(carom_table_name((carom_table_kind)TABLES));
  ck_assert_str_eq(carom_rack_name(CAROM_RACK_EIGHTBALL), "eightball");

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
  ck_assert_int_eq(carom_table_polygon(bent, 6, 0.0365, 0.02, 0.028575, &t, NULL), CAROM_OK);
  for (int k = 0; k < 6; k++) {
    ck_assert_ptr_null(carom_rail_name(&t, k));
    ck_assert_ptr_null(carom_pocket_name(&t, k));
  }
  for (int index = 0; index < 2; index++)
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
      carom_table_make(CAROM_TABLE_POOL_9FT, &t);
      *(index == 0 ? &t.rails : &t.pockets) = numbers[k];
      for (int part = 0; part < 2000000; part += 99999) {
        ck_assert_ptr_null(carom_rail_name(&t, part + 40));
        ck_assert_ptr_null(carom_pocket_name(&t, part + 40));
      }
    }
  ck_assert_int_ge(carom_physics_revision(), 1);
}
