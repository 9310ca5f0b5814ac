/* One collision from above as a picture: a whole shot that begins just after it, on a cloth whose cushions are out of sight. */
#include "hit_picture.h"

#include "message.h"
#include "output.h"
#include "shot_picture.h"

#include <math.h>
#include <string.h>

enum { BALLS = 2, MOST_EVENTS = 64, SAMPLES = 8, MOST_TEXT = 4096, MOST_MARKS = 7 };
static const double reach = 24.0, away = 1000.0; /* of the faster ball on the picture; of the cushions: in radii */
static const double least_friction = 1e-6;       /* the library's motion needs some; balls slide straight on by so little */

/* Four cushions around the collision, which is at the origin. */
static carom_table wide_table(double radius) {
  const double far = away * radius, corner[4][2] = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  carom_table t = {.width = 2.0 * far, .length = 2.0 * far, .rails = 4};
  for (int k = 0; k < 4; k++) {
    t.rail[k] = (carom_rail){.height = 1.25 * radius, .side = 1};
    memcpy(t.rail[k].p, corner[k], sizeof corner[k]);
    memcpy(t.rail[k].q, corner[(k + 1) % 4], sizeof corner[k]);
  }
  return t;
}

/* A ball where it touched the other, moving as after the collision. */
static carom_shot_ball ball_of(const carom_ball *ball, const carom_motion *after) {
  carom_shot_ball b = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  b.kind.mass = ball->mass;
  b.kind.radius = ball->radius;
  b.kind.mu_slide = fmax(ball->mu_cloth, least_friction);
  memcpy(b.state.r, ball->r, sizeof b.state.r);
  memcpy(b.state.v, after->v, sizeof b.state.v);
  memcpy(b.state.w, after->w, sizeof b.state.w);
  return b;
}

static void include(shot_extra *x, const double r[2], double around) {
  for (int k = 0; k < 2; k++) {
    x->low[k] = fmin(x->low[k], r[k] - around);
    x->high[k] = fmax(x->high[k], r[k] + around);
  }
}

static void add_mark(shot_extra *x, shot_mark marks[MOST_MARKS], const double from[2], const double to[2], const char *label) {
  marks[x->marks++] = (shot_mark){{from[0], from[1]}, {to[0], to[1]}, label};
}

/* The line of centres, the tangent line, the way there, and the directions in which the balls part. */
static void mark_contact(shot_extra *x, shot_mark marks[MOST_MARKS], const carom_impact *in, const carom_result *out,
                         const double start[2]) {
  const double R = in->a.radius, n[2] = {(in->b.r[0] - in->a.r[0]) / (2.0 * R), (in->b.r[1] - in->a.r[1]) / (2.0 * R)};
  const double c[2] = {0.5 * (in->a.r[0] + in->b.r[0]), 0.5 * (in->a.r[1] + in->b.r[1])};
  add_mark(x, marks, (const double[]){c[0] + 5.0 * R * n[0], c[1] + 5.0 * R * n[1]},
           (const double[]){c[0] - 5.0 * R * n[0], c[1] - 5.0 * R * n[1]}, "line of centres");
  add_mark(x, marks, (const double[]){c[0] + 4.0 * R * n[1], c[1] - 4.0 * R * n[0]},
           (const double[]){c[0] - 4.0 * R * n[1], c[1] + 4.0 * R * n[0]}, "tangent line");
  add_mark(x, marks, start, in->a.r, NULL);
  for (int k = 0; k < BALLS; k++) {
    const double *r = k == 0 ? in->a.r : in->b.r, *v = k == 0 ? out->a.v : out->b.v, speed = hypot(v[0], v[1]);
    if (speed > 0.0)
      add_mark(x, marks, r, (const double[]){r[0] + 6.0 * R * v[0] / speed, r[1] + 6.0 * R * v[1] / speed}, NULL);
  }
}

/* How long it takes the faster ball, sliding or rolling, to get as far as the picture goes. */
static double time_shown(const carom_impact *in, const carom_result *out) {
  double fastest = 0.0, rolling[3];
  for (int k = 0; k < BALLS; k++) {
    const carom_motion *m = k == 0 ? &out->a : &out->b;
    carom_rolling_velocity(m->v, m->w, in->a.radius, rolling);
    fastest = fmax(fastest, fmax(hypot(m->v[0], m->v[1]), hypot(rolling[0], rolling[1])));
  }
  return reach * in->a.radius / fastest;
}

bool hit_draw(const char *path, const carom_impact *in, const carom_result *out, const char *text) {
  const double R = in->a.radius, back = 7.0 * R / hypot(in->a.v[0], in->a.v[1]);
  const double start[2] = {in->a.r[0] - back * in->a.v[0], in->a.r[1] - back * in->a.v[1]};
  const named_table table = {.table = wide_table(R)};
  shot_line line = {.table = &table,
                    .count = BALLS,
                    .ball = {ball_of(&in->a, &out->a), ball_of(&in->b, &out->b)},
                    .name = {(char[]){"cue"}, (char[]){"1"}}};
  /* The shot, of which the picture shows the beginning. */
  carom_event events[MOST_EVENTS];
  carom_ball_state final[BALLS], states[BALLS];
  carom_shot shot = {.events = events, .room = MOST_EVENTS, .final = final};
  const carom_shot_options options = {.events_most = MOST_EVENTS, .time_most = 1e12};
  const carom_status status = carom_shoot(&table.table, line.ball, BALLS, NULL, &options, &shot);
  const double end = time_shown(in, out);
  if (status != CAROM_OK && shot.time < end) {
    complain("cannot draw %s: %s (%s)", path, carom_status_string(status), carom_status_name(status));
    return false;
  }
  shot_mark marks[MOST_MARKS];
  char lines[MOST_TEXT];
  snprintf(lines, sizeof lines,
           "Thin dashed lines from the balls: direction just after contact. Dots: the ball rolls from here.\n%s", text);
  shot_extra x = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}, .mark = marks, .text = lines};
  /* What is to be seen: both balls, the last of the way there, both paths. */
  include(&x, start, R);
  include(&x, in->a.r, 4.0 * R);
  include(&x, in->b.r, 4.0 * R);
  for (int k = 1; k <= SAMPLES; k++) {
    carom_shot_at(line.ball, BALLS, &shot, end * k / SAMPLES, states);
    for (int ball = 0; ball < BALLS; ball++)
      include(&x, states[ball].r, 1.5 * R);
  }
  mark_contact(&x, marks, in, out, start);
  for (int64_t k = 0; k < shot.count && events[k].time <= end; k++)
    if (events[k].type == CAROM_EVENT_SLIDING_ROLLING)
      add_mark(&x, marks, events[k].after[0].r, events[k].after[0].r, NULL);
  shot.time = end;
  memcpy(final, states, sizeof final);
  FILE *file = output_open(path);
  if (file == NULL)
    return false;
  shot_draw(file, &line, &shot, &x);
  return output_commit();
}
