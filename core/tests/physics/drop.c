/* Pocketed balls, drawn: they fall without a jump, inside their pocket and not in each other, and
 * lie there next to each other; the others are where they are. */
#include "carom_shot.h"
#include "random.h"
#include "support.h"

enum { COUNT = 10, ROOM = 2000, SAMPLES = 400 };

static carom_event events[ROOM];
static carom_ball_state final[COUNT];
static carom_table table;
static carom_shot_ball balls[COUNT];
static carom_shot shot;

static double between(const double *a, const double *b, int numbers) {
  double square = 0.0;
  for (int c = 0; c < numbers; c++)
    square += (a[c] - b[c]) * (a[c] - b[c]);
  return sqrt(square);
}

/* A state a little before or after a time; no jump of its ball between both. */
static void check_no_jump(int ball, double time, carom_ball_state after[COUNT]) {
  const double times[2] = {time - 1e-9, time + 1e-9};
  carom_ball_state states[2 * COUNT];
  expect_ok(carom_shot_drawn(&table, balls, COUNT, &shot, times, 2, states));
  ck_assert_double_lt(between(states[ball].r, states[COUNT + ball].r, 3), 1e-4);
  memcpy(after, &states[COUNT], sizeof states[0] * COUNT);
}

/* The end of a fall into a pocket in which others lie: when it is still for the first time. */
static double end_of_fall(const carom_event *event, double latest) {
  carom_ball_state drawn[COUNT];
  double low = 0.0, high = latest;
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (low + high), time = event->time + middle;
    carom_shot_drawn(&table, balls, COUNT, &shot, &time, 1, drawn);
    const double *v = drawn[event->a].v;
    *(v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0 ? &high : &low) = middle;
  }
  return high;
}

/* Those that lie in the pocket of an event after it are next to or on each other. Returns how many
 * lay there before. */
static int check_pile(const carom_event *event, const carom_ball_state *drawn) {
  int lay = 0;
  for (const carom_event *e = events; e < event; e++)
    if (e->type == CAROM_EVENT_POCKET && e->b == event->b) {
      ck_assert_double_ge(between(drawn[e->a].r, drawn[event->a].r, 3),
                          2.0 * balls[0].kind.radius - 1e-6);
      lay++;
    }
  return lay;
}

/* One ball from the edge down to the depth. */
static void check_fall(const carom_event *event) {
  const carom_pocket *pocket = &table.pocket[event->b];
  const carom_ball_state *from = &event->before[0];
  const double g = balls[event->a].kind.gravity, fastest = planar_size(from->v);
  const double end =
      (from->v[2] + sqrt(from->v[2] * from->v[2] + 2.0 * g * (from->r[2] + pocket->depth))) / g;
  const double step = end / SAMPLES;
  carom_ball_state drawn[COUNT], before[COUNT], there[COUNT];

  /* it ends where it falls */
  const double lies = end_of_fall(event, 1.5);
  check_no_jump(event->a, event->time + lies, drawn);
  ck_assert_double_eq(planar_size(drawn[event->a].v), 0.0);
  ck_assert_double_le(between(drawn[event->a].r, pocket->centre, 2), pocket->radius + 1e-9);
  if (check_pile(event, drawn) > 0)
    return;
  ck_assert_double_eq_tol(drawn[event->a].r[2], -pocket->depth, 1e-9);
  ck_assert_double_eq_tol(lies, end, 1e-9);

  for (int k = 0; k < SAMPLES; k++) {
    const double t = k * step, time = event->time + t;
    expect_ok(carom_shot_drawn(&table, balls, COUNT, &shot, &time, 1, drawn));
    const carom_ball_state *ball = &drawn[event->a];
    /* free fall, inside the circle, no faster along the cloth than at its edge */
    const double height = from->r[2] + from->v[2] * t - 0.5 * g * t * t;
    ck_assert_double_le(fabs(ball->r[2] - height), 1e-12);
    ck_assert_double_le(between(ball->r, pocket->centre, 2), pocket->radius + 1e-9);
    ck_assert_double_le(planar_size(ball->v), fastest + 1e-9);
    ck_assert_int_eq(ball->label, CAROM_BALL_POCKETED);
    /* no jump, and the velocity is that of the way: but for where the wall takes a part of it */
    const double *last = k == 0 ? from->r : before[event->a].r;
    const double way = between(ball->r, last, 2), most = fastest * step;
    ck_assert_double_le(way, most + 1e-12);
    /* the others */
    expect_ok(carom_shot_at(balls, COUNT, &shot, time, there));
    for (int i = 0; i < COUNT; i++)
      if (there[i].label != CAROM_BALL_POCKETED)
        ck_assert_mem_eq(&drawn[i], &there[i], sizeof there[i]);
    memcpy(before, drawn, sizeof before);
  }
}

/* Four balls that roll into one corner pocket behind each other, straight or a little aside: two or
 * three get to the bottom, which has room for three, and the rest lie on others. */
TEST(beside_each_other) {
  carom_table_make(CAROM_TABLE_POOL_7FT, &table);
  for (int n = 0; n < 25; n++) {
    carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, COUNT);
    const carom_pocket *pocket = &table.pocket[0];
    const double middle[2] = {0.5 * table.width, 0.5 * table.length},
                 towards[2] = {pocket->centre[0] - middle[0], pocket->centre[1] - middle[1]};
    const double x = copysign(sqrt(0.5), towards[0]), y = copysign(sqrt(0.5), towards[1]);
    for (int i = 0; i < 4; i++) {
      const double far = 0.15 + (0.12 + 0.01 * (n % 5)) * i,
                   aside = n == 0 ? 0.0 : 0.004 * ((n * (i + 2)) % 5 - 2), speed = 0.6 + 0.02 * n;
      balls[i].state.r[0] = pocket->centre[0] - far * x - aside * y;
      balls[i].state.r[1] = pocket->centre[1] - far * y + aside * x;
      balls[i].state.v[0] = speed * x;
      balls[i].state.v[1] = speed * y;
      balls[i].state.w[0] = -speed * y / balls[i].kind.radius;
      balls[i].state.w[1] = speed * x / balls[i].kind.radius;
    }
    for (int i = 4; i < COUNT; i++)
      balls[i].state.label = CAROM_BALL_POCKETED;
    shot = (carom_shot){.events = events, .room = ROOM, .final = final};
    expect_ok(carom_shoot(&table, balls, COUNT, NULL, NULL, &shot));
    int fell = 0, on_floor = 0, on_others = 0;
    carom_ball_state drawn[COUNT];
    const double last = shot.time + 1.0;
    expect_ok(carom_shot_drawn(&table, balls, COUNT, &shot, &last, 1, drawn));
    for (int k = 0; k < shot.count; k++)
      if (events[k].type == CAROM_EVENT_POCKET) {
        check_fall(&events[k]);
        const double up = drawn[events[k].a].r[2] + pocket->depth;
        ck_assert_double_ge(up, -1e-9);
        ck_assert_double_le(up, 4.0 * balls[0].kind.radius);
        on_floor += up <= 1e-9;
        on_others += up >= 0.02;
        ck_assert_int_eq(check_pile(&events[k], drawn), fell);
        fell++;
      }
    ck_assert_int_eq(fell, 4);
    ck_assert_int_ge(on_floor, 2);
    ck_assert_int_ge(on_others, 1);
  }
}

/* Balls that fly into a pocket, to its middle and next to it. */
TEST(out_of_the_air) {
  int in_flight = 0;
  carom_table_make(CAROM_TABLE_POOL_7FT, &table);
  for (int n = 0; n < 60; n++) {
    carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, COUNT);
    const double *centre = table.pocket[n % table.pockets].centre, g = balls[0].kind.gravity;
    const double speed = 0.5 + 0.05 * n, height = 0.2, aside = 0.02 * (n % 5 - 2);
    const double lands = sqrt(2.0 * (height - balls[0].kind.radius) / g);
    /* from the middle of the table, so far that it lands in the circle */
    const double to[2] = {centre[0] - 0.5 * table.width, centre[1] - 0.5 * table.length},
                 far = planar_size(to), way[2] = {to[0] / far, to[1] / far};
    balls[0].state =
        (carom_ball_state){.r = {centre[0] - lands * speed * way[0] - aside * way[1],
                                 centre[1] - lands * speed * way[1] + aside * way[0], height},
                           .v = {speed * way[0], speed * way[1]},
                           .label = CAROM_BALL_AIRBORNE};
    shot = (carom_shot){.events = events, .room = ROOM, .final = final};
    if (carom_shoot(&table, balls, COUNT, NULL, NULL, &shot) != CAROM_OK || shot.count > ROOM)
      continue;
    for (int k = 0; k < shot.count; k++)
      if (events[k].type == CAROM_EVENT_POCKET) {
        in_flight += events[k].before[0].label == CAROM_BALL_AIRBORNE;
        check_fall(&events[k]);
      }
  }
  printf("%d balls fell out of the air\n", in_flight);
  ck_assert_int_gt(in_flight, 20);
}

/* The energy of a drawn ball over its mass. */
static double energy_of(const carom_ball_state *state, double gravity) {
  const double *v = state->v;
  return 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + gravity * state->r[2];
}

/* Balls that fall soon after each other, with any speeds and directions: they are hardly in each
 * other, none jumps, and the energy of all of a pocket does not rise but where one comes in. */
TEST(fall_together) {
  enum { LAYOUTS = 150, TIMES = 600, BALLS = 8 };
  static const double step = 1e-3, jump = 0.012, overlap_most = 2e-3;
  static carom_ball_state drawn[TIMES * COUNT];
  static double times[TIMES];
  double deepest = 0.0;
  int pairs = 0;
  for (int n = 0; n < LAYOUTS; n++) {
    lab_random random = {test_seed() + (uint64_t)n};
    carom_table_make(CAROM_TABLE_POOL_7FT, &table);
    carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, COUNT);
    const double *centre = table.pocket[0].centre;
    const double way = atan2(0.5 * table.length - centre[1], 0.5 * table.width - centre[0]);
    for (int i = 0; i < COUNT; i++)
      balls[i].state.label = CAROM_BALL_POCKETED;
    for (int i = 0; i < BALLS; i++) {
      const double far = 0.1 + 0.065 * i + lab_uniform(&random, 0.0, 0.01),
                   speed = lab_uniform(&random, 0.5, 3.0),
                   aside = lab_uniform(&random, -0.02, 0.02);
      balls[i].state = (carom_ball_state){.r = {centre[0] + far * cos(way) - aside * sin(way),
                                                centre[1] + far * sin(way) + aside * cos(way),
                                                balls[i].kind.radius},
                                          .v = {-speed * cos(way), -speed * sin(way)},
                                          .label = CAROM_BALL_SLIDING};
    }
    shot = (carom_shot){.events = events, .room = ROOM, .final = final};
    if (carom_shoot(&table, balls, COUNT, NULL, NULL, &shot) != CAROM_OK || shot.count > ROOM)
      continue;
    for (int k = 0; k < TIMES; k++)
      times[k] = step * k;
    expect_ok(carom_shot_drawn(&table, balls, COUNT, &shot, times, TIMES, drawn));
    double fell[COUNT];
    for (int i = 0; i < COUNT; i++)
      fell[i] = INFINITY;
    for (int k = 0; k < shot.count; k++)
      if (events[k].type == CAROM_EVENT_POCKET && events[k].b == 0)
        fell[events[k].a] = events[k].time;

    for (int k = 1; k < TIMES; k++) {
      double energy = 0.0, earlier = 0.0;
      bool enters = false;
      for (int i = 0; i < BALLS; i++) {
        const carom_ball_state *state = &drawn[k * COUNT + i], *last = state - COUNT;
        enters |= fell[i] > times[k - 1] && fell[i] < times[k] + 0.1;
        if (!(fell[i] < times[k - 1]))
          continue;
        ck_assert_double_lt(between(state->r, last->r, 3), jump);
        energy += energy_of(state, balls[i].kind.gravity);
        earlier += energy_of(last, balls[i].kind.gravity);
        for (int j = 0; j < i; j++)
          if (fell[j] < times[k - 1]) {
            const double apart = between(state->r, drawn[k * COUNT + j].r, 3);
            deepest = fmax(deepest, 2.0 * balls[0].kind.radius - apart);
            pairs++;
          }
      }
      if (!enters)
        ck_assert_double_le(energy, earlier + 1e-3);
    }
  }
  printf("%d pairs of falling balls, up to %.2g m in each other\n", pairs, deepest);
  ck_assert_int_gt(pairs, 10000);
  ck_assert_double_lt(deepest, overlap_most);
}
