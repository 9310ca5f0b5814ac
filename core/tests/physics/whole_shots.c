/* Complete shots: invariants of random shots of every kind, the physics that players know, and the
 * cases in which pooltool fails.
 */
#include "invariants.h"
#include "random_shots.h"
#include "shot_support.h"

/* ---- Invariants */

/* Random shots of every kind, by three models of cushions: a third with the terms of measured
 * tables, a third with the butt raised. They are sound as core/tests/shots judges, and
 * carom_shot_at() has the states at events and at the end. */
TEST(invariants) {
  static random_shot s;
  static const carom_shot_cushion models[] = {CAROM_SHOT_CUSHION_HAN, CAROM_SHOT_CUSHION_STRONGE,
                                              CAROM_SHOT_CUSHION_MATHAVAN};
  const int each = draws_of_test(10, 30), flat = random_shot_kinds();
  random_source random = {test_seed()};
  int64_t landings = 0, many = 0, shots = 0;
  double start = 0.0, again = 0.0;
  for (int kind = 0; kind < random_shot_kinds_in_space(); kind++)
    for (int n = 0; n < each; n++, shots++) {
      random_shot_make(kind, test_seed(), (uint64_t)n, &s);
      const bool terms = n % 3 == 1 && kind < flat;
      if (terms)
        give_terms(s.ball, s.count, &random);
      if (n % 3 == 2 && kind < flat && s.cue.speed > 0.0 && strcmp(s.kind, "coincident") != 0)
        s.cue.theta = 2.0 + 58.0 * n / each;
      const carom_shot_options options = {.cushion_model = models[n % 15 == 14 ? 2 : n % 2]};
      carom_shot shot = empty_shot();
      const carom_status status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &options, &shot);
      many += status == CAROM_ERROR_TOO_MANY_EVENTS;
      ck_assert_msg(status == CAROM_OK || (kind >= flat && status == CAROM_ERROR_TOO_MANY_EVENTS),
                    "%s %d: %s", s.kind, n, carom_status_name(status));
      const shot_measures m = shot_measure(&s.table, s.ball, s.count, &shot, status, 3);
      EXPECT_SOUND(m, terms ? 1e-9 : 1e-11, s.kind, n);
      start = fmax(start, m.start);
      again = fmax(again, m.again);
      carom_ball_state at[CAROM_BALLS_MOST];
      for (int64_t k = 1; k < shot.count && k < 60; k++) {
        const carom_shot before = {.events = events, .room = k, .count = k, .time = events[k].time};
        landings += events[k].type == CAROM_EVENT_SLATE;
        expect_ok(carom_shot_at(s.ball, s.count, &before, events[k].time, at));
        for (int axis = 0; axis < 3; axis++)
          NEAR(at[events[k].a].r[axis], events[k].before[0].r[axis], terms ? 1e-9 : 1e-12);
      }
      if (status != CAROM_OK)
        continue;
      expect_ok(carom_shot_at(s.ball, s.count, &shot, 2.0 * shot.time + 1.0, at));
      for (int k = 0; k < s.count; k++)
        ck_assert_mem_eq(&at[k], &final[k], sizeof at[k]);
    }
  printf("invariants: %d shots, %d landings, %d with too many events; balls start up to %.1e m in "
         "each other, %.1e before they meet again\n",
         (int)shots, (int)landings, (int)many, start, again);
  ck_assert_int_gt(landings, 10 * each);
  ck_assert_int_le(many, 2 + shots / 500);
}

/* A mirrored or turned table gives the mirrored or turned history, bit for bit about the origin. */
typedef struct isometry {
  const char *name;
  double of_x[2], of_y[2], sign; /* x and y become these sums; sign: the determinant */
} isometry;
static const isometry isometries[] = {{"mirrored", {-1.0, 0.0}, {0.0, 1.0}, -1.0},
                                      {"turned by 90 degrees", {0.0, -1.0}, {1.0, 0.0}, 1.0},
                                      {"turned by 180 degrees", {-1.0, 0.0}, {0.0, -1.0}, 1.0}};
enum { ISOMETRIES = COUNT_OF(isometries) };

static void map(const isometry *by, double sign, double xy[2]) {
  const double x = xy[0], y = xy[1];
  xy[0] = sign * (by->of_x[0] * x + by->of_x[1] * y);
  xy[1] = sign * (by->of_y[0] * x + by->of_y[1] * y);
}

static carom_ball_state mapped(const isometry *by, carom_ball_state s) {
  map(by, 1.0, s.r);
  map(by, 1.0, s.v);
  map(by, by->sign, s.w);
  s.w[2] *= by->sign;
  return s;
}

static void map_table(const isometry *by, carom_table *t) {
  double middle[2] = {t->width, t->length}; /* twice the middle, which is on the table */
  map(by, 1.0, middle);
  t->width = middle[0];
  t->length = middle[1];
  for (int k = 0; k < t->rails; k++) {
    map(by, 1.0, t->rail[k].p);
    map(by, 1.0, t->rail[k].q);
    t->rail[k].side = by->sign < 0.0 ? 1 - t->rail[k].side : t->rail[k].side;
  }
  for (int k = 0; k < t->jaws; k++)
    map(by, 1.0, t->jaw[k].centre);
  for (int k = 0; k < t->pockets; k++)
    map(by, 1.0, t->pocket[k].centre);
}

/* With the origin in the middle, and lines that follow from the segments. */
static void centre_table(random_shot *s) {
  const double half = 0.5 * s->table.width;
  for (int k = 0; k < s->table.rails; k++) {
    carom_rail *r = &s->table.rail[k];
    const double line = r->line[0] * -(r->q[1] - r->p[1]) + r->line[1] * (r->q[0] - r->p[0]);
    r->side = line >= 0.0 ? r->side : 1 - r->side;
    memset(r->line, 0, sizeof r->line);
    r->p[0] -= half;
    r->q[0] -= half;
  }
  for (int k = 0; k < s->table.jaws; k++)
    s->table.jaw[k].centre[0] -= half;
  for (int k = 0; k < s->table.pockets; k++)
    s->table.pocket[k].centre[0] -= half;
  for (int k = 0; k < s->count; k++)
    s->ball[k].state.r[0] -= half;
}

static bool same(const carom_ball_state *a, const carom_ball_state *b) {
  bool good = a->label == b->label;
  for (int k = 0; k < 3; k++) /* by value: 0 and -0 are the same */
    good = good && a->r[k] == b->r[k] && a->v[k] == b->v[k] && a->w[k] == b->w[k];
  return good;
}

/* Shot number n of a kind about the origin. Its first ball moves, since the direction of a cue is
 * an angle; but where all coincides. */
static void make_about_origin(int kind, int n, random_source *random, random_shot *s) {
  random_shot_make(kind, test_seed(), (uint64_t)n, s);
  centre_table(s);
  s->cue.speed = 0.0;
  if (strncmp(s->kind, "coincident", 10) != 0) {
    s->ball[0].state.v[0] = random_between(random, -4.0, 4.0);
    s->ball[0].state.v[1] = random_between(random, 2.0, 6.0);
    s->ball[0].state.v[2] = n % 3 == 0 ? random_between(random, 0.0, 2.0) : 0.0;
    s->ball[0].state.w[2] = random_between(random, -50.0, 50.0);
  }
  if (n % 2 == 1)
    give_terms(s->ball, s->count, random);
}

/* Whether a ball is hit from above: such contacts have directions across them of which one is
 * along the x axis (core/src/cluster/vectors.h), so a quarter turn changes their rounding. */
static bool hits_from_above(const carom_shot *shot) {
  for (int64_t k = 0; k < shot->count; k++) {
    const double *a = shot->events[k].before[0].r, *b = shot->events[k].before[1].r;
    if (shot->events[k].type == CAROM_EVENT_BALL_BALL && distance(a, b) < 0.11 * fabs(a[2] - b[2]))
      return true;
  }
  return false;
}

TEST(mirror_and_turns) {
  static random_shot s, m;
  static carom_event other[ROOM];
  random_source random = {test_seed()};
  int64_t clusters = 0;
  for (int kind = 0; kind < random_shot_kinds_in_space(); kind++)
    for (int n = 0; n < 20; n++) {
      make_about_origin(kind, n, &random, &s);
      const carom_shot_options options = {.cushion_model = n % 4 == 0 ? 0 : CAROM_SHOT_CUSHION_HAN};
      carom_shot a = {.events = events, .room = ROOM}, b = {.events = other, .room = ROOM};
      const carom_status status = carom_shoot(&s.table, s.ball, s.count, NULL, &options, &a);
      for (const isometry *by = isometries; by < isometries + ISOMETRIES; by++) {
        m = s;
        map_table(by, &m.table);
        for (int k = 0; k < m.count; k++)
          m.ball[k].state = mapped(by, s.ball[k].state);
        ck_assert_int_eq(carom_shoot(&m.table, m.ball, m.count, NULL, &options, &b), status);
        if (by->of_x[0] == 0.0 && hits_from_above(&a))
          continue;
        ck_assert_msg(b.count == a.count, "%s %d %s: %d events", s.kind, n, by->name, (int)b.count);
        for (int k = 0; k < a.count; k++) {
          const carom_event *e = &events[k], *f = &other[k];
          clusters += e->cluster > 0;
          ck_assert_msg(e->time == f->time && e->type == f->type && e->a == f->a && e->b == f->b,
                        "%s %d %s: event %d", s.kind, n, by->name, k);
          for (int side = 0; side < 2; side++) {
            const carom_ball_state before = mapped(by, e->before[side]),
                                   after = mapped(by, e->after[side]);
            ck_assert_msg(same(&before, &f->before[side]) && same(&after, &f->after[side]),
                          "%s %d %s: states of event %d, type %d", s.kind, n, by->name, k, e->type);
          }
        }
      }
    }
  ck_assert_int_gt(clusters, 1000);
}

/* ---- Splitting */

/* A ball rolls into one that has another behind it, at a gap and `aside` m off their line. Returns
 * whether the contacts are one cluster; final[] has the balls shortly after. */
static bool play_three(double speed, double aside, double gap) {
  const carom_table t = empty_table(50.0);
  carom_shot_ball b[3] = {ball_at(20.0, 20.0), ball_at(20.1, 20.0), ball_at(0.0, 0.0)};
  const double R = b[0].kind.radius, y = 4.0 * aside;
  b[1].state.r[1] += aside;
  b[2].state.r[0] = 20.1 + sqrt((2.0 * R + gap) * (2.0 * R + gap) - y * y);
  b[2].state.r[1] = b[1].state.r[1] + y;
  b[0].state.v[0] = speed;
  b[0].state.w[1] = speed / R;
  b[0].state.w[2] = 30.0;
  const carom_shot_options options = {.time_most = 0.1 / speed};
  play(&t, b, 3, NULL, &options, CAROM_STOPPED_AT_TIME);
  for (int k = 0;; k++)
    if (events[k].type == CAROM_EVENT_BALL_BALL)
      return events[k].cluster > 0;
}

/* At the gap at which a cluster falls into two events, nothing jumps. */
TEST(splitting) {
  static const double speeds[] = {0.5, 2.0, 6.0};
  for (int n = 0; n < 9; n++) {
    const double speed = speeds[n / 3], aside = n % 3 * 0.005;
    double one = 0.0, two = 2e-3;
    ck_assert(play_three(speed, aside, one) && !play_three(speed, aside, two));
    for (int k = 0; k < 60; k++) {
      const double gap = 0.5 * (one + two);
      *(play_three(speed, aside, gap) ? &one : &two) = gap;
    }
    carom_ball_state together[3];
    play_three(speed, aside, one);
    memcpy(together, final, sizeof together);
    play_three(speed, aside, two);
    for (int k = 0; k < 3; k++)
      for (int axis = 0; axis < 3; axis++) {
        ck_assert_double_eq_tol(together[k].r[axis], final[k].r[axis], 1e-12);
        ck_assert_double_eq_tol(together[k].v[axis], final[k].v[axis], 1e-11);
        ck_assert_double_eq_tol(together[k].w[axis], final[k].w[axis], 1e-9);
      }
  }
}

/* ---- Small changes */

/* Whether a shot's first contact of balls is a cluster with no cushion before it, hit at more than
 * 0.3 m/s; its time and speed. */
static bool first_cluster(const carom_shot *shot, double *time, double *speed) {
  int64_t k = 0;
  while (k < shot->count &&
         (events[k].type == CAROM_EVENT_STRIKE || events[k].type >= CAROM_EVENT_SLIDING_ROLLING))
    k++;
  const carom_event *e = &events[k];
  if (k == shot->count || e->type != CAROM_EVENT_BALL_BALL || e->cluster == 0)
    return false;
  *time = e->time;
  *speed = hypot(planar_size(e->before[0].v), planar_size(e->before[1].v));
  return *speed > 0.3;
}

/* Where the balls are 20 ms after a first contact that is a cluster changes little where the cue
 * turns by 1e-6 rad, and where all distances from ball 1 grow by 1e-7, so that frozen balls have
 * gaps of 6 nm. It may change where a touch comes within a cluster or as a later event. */
TEST(small_changes) {
  static random_shot s, m;
  static const double later = 0.02, large = 1e-2, per_1000[2] = {2.0, 5.0};
  const int each = draws_of_test(50, 150);
  int shots = 0, over[2] = {0};
  for (int kind = 0; kind < random_shot_kinds(); kind++)
    for (int n = 0; n < each; n++) {
      carom_shot shot = {.events = events, .room = ROOM};
      carom_ball_state at[CAROM_BALLS_MOST], other[CAROM_BALLS_MOST];
      double time, speed;
      random_shot_make(kind, test_seed() + 1, (uint64_t)n, &s);
      if (strcmp(s.kind, "coincident") == 0 || strcmp(s.kind, "frozen_to_rail") == 0 ||
          carom_shoot(&s.table, s.ball, s.count, &s.cue, NULL, &shot) != CAROM_OK ||
          !first_cluster(&shot, &time, &speed))
        continue;
      shots++;
      expect_ok(carom_shot_at(s.ball, s.count, &shot, time + later, at));
      for (int gaps = 0; gaps < 2; gaps++) {
        m = s;
        m.cue.phi += gaps ? 0.0 : 57.3e-6;
        for (int k = 1; k < s.count && gaps; k++)
          for (int axis = 0; axis < 2; axis++)
            m.ball[k].state.r[axis] += 1e-7 * (s.ball[k].state.r[axis] - s.ball[1].state.r[axis]);
        expect_ok(carom_shoot(&m.table, m.ball, m.count, &m.cue, NULL, &shot));
        expect_ok(carom_shot_at(m.ball, m.count, &shot, time + later, other));
        double most = 0.0;
        for (int k = 0; k < s.count; k++)
          for (int axis = 0; axis < 3; axis++)
            most = fmax(most, fabs(other[k].r[axis] - at[k].r[axis]));
        over[gaps] += most > large * speed * later;
      }
    }
  ck_assert_int_gt(shots, 3 * each);
  for (int gaps = 0; gaps < 2; gaps++) {
    printf("with other %s: %d of %d clusters move a ball by over 1 %% of the cue ball's way\n",
           gaps ? "gaps" : "aims", over[gaps], shots);
    /* three deviations of a count above what is allowed, for any seed */
    const double allowed = per_1000[gaps] * 1e-3 * shots;
    ck_assert_double_le(over[gaps], 4.0 + allowed + 3.0 * sqrt(allowed));
  }
}

/* ---- Positions */

/* A rail ends with its ends, and is the same from either: a short wall in the middle of a table. */
TEST(both_ends_of_a_rail) {
  static const double ends[2] = {0.75, 1.25};
  static const double sides[2] = {0.99, 1.01};
  const double beyond[2] = {nextafter(ends[0], 0.0), nextafter(ends[1], 2.0)};
  carom_table t = empty_table(2.0);
  t.rails = 5;
  for (int n = 0; n < 8; n++) {
    const int from = n % 2;
    const int at = n / 2 % 2;
    const double y = sides[n / 4];
    carom_shot_ball ball = ball_at(1.0, 0.5);
    carom_part part;
    t.rail[4] = (carom_rail){{ends[from], 1.0}, {ends[1 - from], 1.0}, 0.036576, .side = 1 - from};
    ck_assert_int_eq(carom_place_ball(&t, &ball, 1, 0, ends[at], y, &part), CAROM_ERROR_OFF_TABLE);
    ck_assert_int_eq(part.kind, CAROM_PART_RAIL);
    ck_assert_int_eq(part.index, 4);
    expect_ok(carom_place_ball(&t, &ball, 1, 0, beyond[at], y, &part));
    ck_assert_int_eq(part.kind, CAROM_PART_NONE);
  }
}

/* ---- Balls that press on each other */

static void ends_well(const carom_table *t, const carom_shot_ball *b, int count, int most_events) {
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  const carom_shot shot = play(t, b, count, NULL, &options, CAROM_OK);
  const shot_measures m = shot_measure(t, b, count, &shot, CAROM_OK, 3);
  EXPECT_SOUND(m, 1e-9, "pressed balls", count);
  ck_assert_int_le(shot.count, most_events);
}

/* A line of frozen balls that the spin of the first presses along; it took 32,184 events. */
TEST(pressed_line) {
  const carom_table t = empty_table(8.0);
  carom_shot_ball b[CAROM_BALLS_MOST];
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    b[k] = ball_at(1.0 + 2.0 * k * ball_at(0.0, 0.0).kind.radius, 4.0);
  const double step = 300.0 / draws_within(2, 6);
  for (b[0].state.w[1] = step; b[0].state.w[1] <= 300.0; b[0].state.w[1] += step) {
    ends_well(&t, b, 27, 8000);
    ends_well(&t, b, CAROM_BALLS_MOST, 8000);
  }
  /* balls that hardly hop stay nearly together: as far as one by one with s = 0.1 mm/s
   * throughout, 95,821 events */
  b[0].state.w[1] = 200.0;
  ends_well(&t, b, 4, 3000);
  for (int k = 0; k < 4; k++)
    ck_assert_double_eq_tol(final[k].r[0] - b[k].state.r[0], 0.7486, 0.06);
}

/* Twice that of two balls, over the mass. */
static long double energy(long double R, const carom_ball_state s[2]) {
  long double sum = 0.0L;
  for (int k = 0; k < 6; k++) {
    const long double v = s[k / 3].v[k % 3], w = R * s[k / 3].w[k % 3];
    sum += v * v + 0.4L * w * w;
  }
  return sum;
}

/* A slow contact lets two balls part by energy of their spins. It keeps momentum, and takes at
 * least the energy that it gives, so that thousands of them add none by rounding. */
TEST(slow_contacts_lose) {
  const carom_table t = empty_table(8.0);
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  const double R = ball_at(0.0, 0.0).kind.radius;
  int slow = 0;
  for (double spin = 100.0; spin <= 300.0; spin += 10.0) {
    carom_shot_ball b[4];
    for (int k = 0; k < 4; k++)
      b[k] = ball_at(1.0 + 2.0 * k * R, 4.0);
    b[0].state.w[1] = spin;
    const carom_shot shot = play(&t, b, 4, NULL, &options, CAROM_OK);
    for (int64_t e = 0; e < shot.count; e++) {
      const carom_ball_state *before = events[e].before, *after = events[e].after;
      const double closing = before[0].v[0] - before[1].v[0];
      if (events[e].type != CAROM_EVENT_BALL_BALL || events[e].cluster != 0 || closing >= 1e-3)
        continue;
      slow++;
      NEAR(before[0].v[0] + before[1].v[0], after[0].v[0] + after[1].v[0], 1e-15);
      const long double there = energy(R, before), left = energy(R, after);
      ck_assert_double_le((double)((left - there) / there), 1e-15);
    }
  }
  printf("%d slow contacts lose energy\n", slow);
  ck_assert_int_gt(slow, 1000);
}

/* A frozen triangle that a ball with spin presses on: balls at relative rest that only rounding
 * presses were in contact without end. */
TEST(pressed_triangle) {
  const carom_table t = empty_table(8.0);
  for (int rows = 2; rows <= 7; rows++) {
    carom_shot_ball b[CAROM_BALLS_MOST];
    const double R = ball_at(0.0, 0.0).kind.radius;
    int count = 0;
    for (int row = 0; row < rows; row++)
      for (int place = 0; place <= row; place++)
        b[count++] = ball_at(2.0 + row * sqrt(3.0) * R, 2.0 + (2.0 * place - row) * R);
    for (int spinning = 0; spinning < count; spinning += 3) {
      b[spinning].state.w[1] = 200.0;
      ends_well(&t, b, count, 9000);
      b[spinning].state.w[1] = 0.0;
    }
  }
}

/* Balls without any room between two rails cannot part, so their contacts have no end: a bound ends
 * them, with a state. */
TEST(wedged) {
  enum { WEDGED = 5 };
  carom_shot_ball b[WEDGED];
  const double R = ball_at(0.0, 0.0).kind.radius;
  const carom_table t = empty_table(2.0 * WEDGED * R);
  for (int k = 0; k < WEDGED; k++)
    b[k] = ball_at(R + 2.0 * k * R, 3.0 * R);
  b[0].state.w[1] = 100.0;
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN, .events_most = 3000};
  play(&t, b, WEDGED, NULL, &options, CAROM_ERROR_TOO_MANY_EVENTS);
  for (int k = 0; k < WEDGED; k++)
    ck_assert_double_eq_tol(final[k].r[0], b[k].state.r[0], 1e-9);
}

/* A ball that touches a rail, at rest or moving along it, whatever the direction of the rail:
 * rounding presses it against the rail or lifts it off. */
TEST(along_a_rail) {
  for (int turn = 0; turn < 90; turn++)
    for (int way = 0; way < 4; way++) {
      const double c = cos(turn / 57.29577951308232), s = sin(turn / 57.29577951308232);
      carom_table t = empty_table(8.0);
      for (int k = 0; k < 4; k++)
        for (int end = 0; end < 2; end++) {
          double *p = end == 0 ? t.rail[k].p : t.rail[k].q;
          const double x = p[0], y = p[1];
          p[0] = c * x - s * y;
          p[1] = s * x + c * y;
        }
      carom_shot_ball b = ball_at(0.0, 0.0);
      const double R = b.kind.radius, speed = way == 0 ? 0.0 : 1.0;
      b.state.r[0] = c * 2.0 - s * R;
      b.state.r[1] = s * 2.0 + c * R;
      b.state.v[0] = c * speed;
      b.state.v[1] = s * speed;
      if (way >= 2) { /* rolls, or draws back */
        b.state.w[0] = (way == 2 ? -1.0 : 2.0) * b.state.v[1] / R;
        b.state.w[1] = (way == 2 ? 1.0 : -2.0) * b.state.v[0] / R;
      }
      ends_well(&t, &b, 1, 40);
    }
}

/* Han's and Stronge's formulas leave a ball moving into the cushion where its restitution is
 * small or its nose far from the height of the centre. The shot turns it back in the same event. */
TEST(left_moving_into_the_cushion) {
  static const double restitutions[] = {0.0, 0.02, 0.1, 0.3, 0.85},
                      heights[] = {0.01, 0.5, 1.0, 1.28, 1.7, 1.999};
  random_source r = {test_seed()};
  int turned = 0;
  for (int n = 0; n < 6000; n++) {
    carom_table t = empty_table(8.0);
    carom_shot_ball b = ball_at(4.0, random_between(&r, 0.03, 0.2));
    const double R = b.kind.radius, e = restitutions[n % 5],
                 speed = pow(10.0, random_between(&r, -2.5, 1.0));
    for (int k = 0; k < 4; k++)
      t.rail[k].height = heights[n / 5 % 6] * R;
    b.kind.restitution_cushion = e;
    b.kind.mu_cushion = random_between(&r, 0.0, 0.6);
    b.state.v[0] = random_between(&r, -1.0, 1.0) * speed;
    b.state.v[1] = -speed;
    for (int axis = 0; axis < 3; axis++)
      b.state.w[axis] = random_between(&r, -2.0, 2.0) * speed / R;
    const carom_shot_options options = {.cushion_model = n % 2 == 0 ? CAROM_SHOT_CUSHION_HAN
                                                                    : CAROM_SHOT_CUSHION_STRONGE};
    const carom_shot shot = play(&t, &b, 1, NULL, &options, CAROM_OK);
    const shot_measures m = shot_measure(&t, &b, 1, &shot, CAROM_OK, 3);
    EXPECT_SOUND(m, 1e-9, "one ball", n);
    ck_assert_int_le(shot.count, 3000);
    for (int k = 0; k < shot.count; k++) {
      if (events[k].type != CAROM_EVENT_RAIL || events[k].b != 0)
        continue;
      const carom_ball_state *before = &events[k].before[0];
      ck_assert_msg(events[k].after[0].v[1] >= 0.0,
                    "shot %d: event %d leaves %g m/s into the cushion", n, k,
                    -events[k].after[0].v[1]);
      carom_cushion_impact in = at_cushion(&b.kind, before->v, before->w, 0.0, -1.0);
      in.height = t.rail[0].height;
      const carom_cushion_options of_model = {.model =
                                                  (carom_cushion_model)(options.cushion_model - 1)};
      carom_motion out;
      turned += carom_cushion(&in, &of_model, &out) == CAROM_OK && out.v[1] < 0.0;
    }
  }
  ck_assert_int_gt(turned, 1000);
}

/* ---- What players know */

/* The strike of a tip of any restitution: momentum along the cue, the speed at which tip and ball
 * part, and the energy that is lost. The restitution 1, for which 0 stands, loses nothing. */
TEST(tips) {
  static const double restitution[] = {0.0, 0.2, CAROM_TIP_LEATHER, 0.85, 1.0},
                      mass[] = {0.1, 0.567, 0.9};
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const double m = kind.mass, V0 = 3.0;
  for (int n = 0; n < 5 * 3 * 81; n++) {
    const double e = restitution[n % 5], M = mass[n / 5 % 3], part = e == 0.0 ? 1.0 : e;
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    ck_assert(cue.tip_restitution == CAROM_TIP_LEATHER);
    cue.speed = V0;
    cue.phi = 0.0;
    cue.mass = M;
    cue.tip_restitution = e;
    cue.a = (n / 15 % 9 - 4) / 8.0;
    cue.b = (n / 135 - 4) / 8.0;
    carom_motion out;
    expect_ok(carom_strike(&cue, &kind, &out));

    /* the point that is struck recedes at V (1 + 5/2 (a^2 + b^2)), the cue continues at U */
    const double arm = 2.5 * (cue.a * cue.a + cue.b * cue.b), V = planar_size(out.v),
                 U = V0 - m / M * V;
    ck_assert_double_eq_tol(V * (1.0 + arm) - U, part * V0, 1e-14);
    const double w2 = out.w[0] * out.w[0] + out.w[1] * out.w[1] + out.w[2] * out.w[2],
                 lost = 0.5 * (M * V0 * V0 - M * U * U - m * V * V -
                               0.4 * m * kind.radius * kind.radius * w2),
                 met = 1.0 / (1.0 / M + (1.0 + arm) / m);
    ck_assert_double_eq_tol(lost, 0.5 * (1.0 - part * part) * met * V0 * V0, 1e-14);

    /* without loss it has the bits of the formula without e; 0 is 1 */
    if (part == 1.0 && cue.a == 0.0)
      ck_assert(out.v[0] == 2.0 * V0 / (1.0 + m / M + 2.5 * (cue.b * cue.b)));
    carom_motion same;
    cue.tip_restitution = part;
    expect_ok(carom_strike(&cue, &kind, &same));
    ck_assert_mem_eq(&same, &out, sizeof out);
  }

  /* which tips the cues of games have */
  for (int game = CAROM_GAME_POOL; game <= CAROM_GAME_POOLTOOL_BILLIARD; game++)
    ck_assert(carom_cue_of((carom_game)game).tip_restitution ==
              (game < CAROM_GAME_POOLTOOL_POOL ? CAROM_TIP_LEATHER : 1.0));
}

/* A single ball: it slides to 5/7 v + 2/7 R w, then rolls v^2 / (2 mu g). */
TEST(alone) {
  random_source r = {test_seed()};
  const carom_table t = empty_table(200.0);
  for (int n = 0; n < 200; n++) {
    carom_shot_ball b = ball_at(100.0, 100.0);
    random_vector(&r, 2, -3.0, 3.0, b.state.v);
    random_vector(&r, 3, -150.0, 150.0, b.state.w);
    const double R = b.kind.radius, g = b.kind.gravity, *v = b.state.v, *w = b.state.w;
    const double u[2] = {v[0] - R * w[1], v[1] + R * w[0]}, size = planar_size(u);
    const double slide = 2.0 * size / (7.0 * b.kind.mu_slide * g);
    double rolling[3];
    carom_rolling_velocity(v, w, R, rolling);
    const double speed = planar_size(rolling);
    const carom_shot shot = play(&t, &b, 1, NULL, NULL, CAROM_OK);
    ck_assert_double_eq_tol(events[0].time, slide, 1e-13);
    for (int k = 0; k < 2; k++) {
      const double rolled = 0.5 * speed * rolling[k] / (b.kind.mu_roll * g);
      ck_assert_double_eq_tol(events[0].after[0].v[k], rolling[k], 1e-13);
      ck_assert_double_eq_tol(final[0].r[k],
                              b.state.r[k] + 0.5 * (v[k] + rolling[k]) * slide + rolled, 1e-11);
    }
    const double spin = fabs(w[2]) * 2.0 * R / (5.0 * b.kind.mu_spin * g),
                 roll = slide + speed / (b.kind.mu_roll * g);
    ck_assert_double_eq_tol(shot.time, fmax(spin, roll), 1e-10);
  }
}

/* The direction in which ball 0 leaves its collision with ball 1, in degrees from its own, once
 * it rolls. fullness: 1 full, 0 a miss. */
static double deflection(double fullness, double speed, double roll,
                         const carom_shot_options *options, double *at_once) {
  const carom_table t = empty_table(50.0);
  carom_shot_ball b[2] = {ball_at(20.0, 20.0), ball_at(20.1, 20.0)};
  const double R = b[0].kind.radius;
  b[1].state.r[1] += 2.0 * R * (1.0 - fullness);
  b[0].state.v[0] = speed;
  b[0].state.w[1] = roll * speed / R;
  for (int k = 0; k < 2; k++)
    b[k].kind.restitution = 1.0;
  b[0].kind.mu_slide = b[1].kind.mu_slide = 0.2;
  play(&t, b, 2, NULL, options, CAROM_OK);
  int k = 0;
  while (events[k].type != CAROM_EVENT_BALL_BALL)
    k++;
  *at_once = 57.29577951308232 * atan2(-events[k].after[0].v[1], events[k].after[0].v[0]);
  while (events[k].a != 0 || events[k].type != CAROM_EVENT_SLIDING_ROLLING)
    k++;
  return 57.29577951308232 * atan2(-events[k].after[0].v[1], events[k].after[0].v[0]);
}

/* A stun shot leaves along the tangent line; a rolling ball by the angle of 30 degrees at
 * half-ball hits (33.7 by the formula tan = sin a cos a / (sin^2 a + 2/5), a the cut angle), for
 * perfect balls and nearly for real ones. */
TEST(tangent_line_and_thirty_degrees) {
  const carom_shot_options smooth = {.ball_model = CAROM_BALL_MODEL_MIRROR};
  double at_once;
  for (double fullness = 0.2; fullness < 0.95; fullness += 0.05) {
    const double cut = asin(1.0 - fullness);
    /* slides without spin over so short a way that what it gains of it turns the tangent line by
     * little */
    deflection(fullness, 5.0, 0.0, &smooth, &at_once);
    ck_assert_double_eq_tol(at_once, 90.0 - 57.29577951308232 * cut, 0.5);
    const double rolls = 57.29577951308232 * atan2(sin(cut) * cos(cut), sin(cut) * sin(cut) + 0.4);
    ck_assert_double_eq_tol(deflection(fullness, 1.5, 1.0, &smooth, &at_once), rolls, 0.1);
    ck_assert_double_eq_tol(deflection(fullness, 1.5, 1.0, NULL, &at_once), rolls, 3.0);
  }
  ck_assert_double_eq_tol(deflection(0.5, 1.5, 1.0, &smooth, &at_once), 33.67, 0.1);
}

/* Draw and follow: a full hit leaves the cue ball with its spin, 2/7 R w of speed backward or
 * forward. */
TEST(draw_and_follow) {
  const carom_table t = empty_table(50.0);
  const carom_shot_options smooth = {.ball_model = CAROM_BALL_MODEL_MIRROR};
  for (int way = -1; way <= 1; way += 2) {
    carom_shot_ball b[2] = {ball_at(20.0, 20.0), ball_at(20.2, 20.0)};
    b[0].kind.restitution = b[1].kind.restitution = 1.0;
    b[0].state.v[0] = 2.0;
    b[0].state.w[1] = way * 80.0;
    play(&t, b, 2, NULL, &smooth, CAROM_OK);
    int k = 0;
    while (events[k].type != CAROM_EVENT_BALL_BALL)
      k++;
    const double v = 2.0 / 7.0 * b[0].kind.radius * events[k].before[0].w[1];
    const double slid = 0.5 * v * 2.0 * b[0].kind.radius * fabs(events[k].before[0].w[1]) /
                        (7.0 * b[0].kind.mu_slide * b[0].kind.gravity);
    const double distance = slid + 0.5 * v * fabs(v) / (b[0].kind.mu_roll * b[0].kind.gravity);
    ck_assert_double_eq_tol(final[0].r[0] - events[k].after[0].r[0], distance, 1e-9);
    ck_assert(distance * way > 0.0);
  }
}
