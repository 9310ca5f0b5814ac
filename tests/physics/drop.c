/* Pocketed balls, drawn: they fall without a jump, inside their pocket, and the others are where
 * they are. */
#include "carom_shot.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* One ball from the edge down to the depth. */
static void check_fall(const carom_event *event) {
  const carom_pocket *pocket = &table.pocket[event->b];
  const carom_ball_state *from = &event->before[0];
  const double g = balls[event->a].kind.gravity, fastest = hypot(from->v[0], from->v[1]);
  const double end =
      (from->v[2] + sqrt(from->v[2] * from->v[2] + 2.0 * g * (from->r[2] + pocket->depth))) / g;
  const double step = end / SAMPLES;
  carom_ball_state drawn[COUNT], before[COUNT], there[COUNT];

  for (int k = 0; k < SAMPLES; k++) {
    const double t = k * step, time = event->time + t;
    ck_assert_int_eq(carom_shot_drawn(&table, balls, COUNT, &shot, &time, 1, drawn), CAROM_OK);
    const carom_ball_state *ball = &drawn[event->a];
    /* free fall, inside the circle, no faster along the cloth than at its edge */
    const double height = from->r[2] + from->v[2] * t - 0.5 * g * t * t;
    ck_assert_double_le(fabs(ball->r[2] - height), 1e-12);
    ck_assert_double_le(between(ball->r, pocket->centre, 2), pocket->radius + 1e-9);
    ck_assert_double_le(hypot(ball->v[0], ball->v[1]), fastest + 1e-9);
    ck_assert_int_eq(ball->label, CAROM_BALL_POCKETED);
    /* no jump, and the velocity is that of the way: but for where the wall takes a part of it */
    const double *last = k == 0 ? from->r : before[event->a].r;
    const double way = between(ball->r, last, 2), most = fastest * step;
    ck_assert_double_le(way, most + 1e-12);
    /* the others */
    ck_assert_int_eq(carom_shot_at(balls, COUNT, &shot, time, there), CAROM_OK);
    for (int i = 0; i < COUNT; i++)
      if (there[i].label != CAROM_BALL_POCKETED)
        ck_assert_mem_eq(&drawn[i], &there[i], sizeof there[i]);
    memcpy(before, drawn, sizeof before);
  }

  /* where it lies it is as the shot says */
  const double after = event->time + 1.01 * end;
  ck_assert_int_eq(carom_shot_drawn(&table, balls, COUNT, &shot, &after, 1, drawn), CAROM_OK);
  ck_assert_mem_eq(&drawn[event->a], &event->after[0], sizeof drawn[0]);
}

TEST(balls_fall) {
  int fell = 0, along_the_wall = 0;
  carom_table_make(CAROM_TABLE_POOL_7FT, &table);
  for (uint64_t seed = 1; seed <= 60; seed++) {
    carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, seed, balls, COUNT);
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = 9.0;
    shot = (carom_shot){.events = events, .room = ROOM, .final = final};
    if (carom_shoot(&table, balls, COUNT, &cue, NULL, &shot) != CAROM_OK || shot.count > ROOM)
      continue;
    for (int k = 0; k < shot.count; k++)
      if (events[k].type == CAROM_EVENT_POCKET) {
        check_fall(&events[k]);
        fell++;
        /* a fast one, of 0.7 m/s at least, reaches the wall before it lies */
        along_the_wall += hypot(events[k].before[0].v[0], events[k].before[0].v[1]) > 1.0;
      }
  }
  printf("%d balls fell, %d fast\n", fell, along_the_wall);
  ck_assert_int_gt(fell, 60);
  ck_assert_int_gt(along_the_wall, 5);
}

/* Balls that fly into a pocket, to its middle and beside it. */
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
                 far = hypot(to[0], to[1]), way[2] = {to[0] / far, to[1] / far};
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

/* What cannot be drawn. */
TEST(refused) {
  const double time = 0.0;
  carom_ball_state drawn[COUNT];
  carom_table_make(CAROM_TABLE_POOL_7FT, &table);
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, COUNT);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  shot = (carom_shot){.events = events, .room = ROOM, .final = final};
  ck_assert_int_eq(carom_shoot(&table, balls, COUNT, &cue, NULL, &shot), CAROM_OK);
  ck_assert_int_eq(carom_shot_drawn(NULL, balls, COUNT, &shot, &time, 1, drawn), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_shot_drawn(&table, balls, COUNT, &shot, NULL, 1, drawn), CAROM_ERROR_NULL);
}
