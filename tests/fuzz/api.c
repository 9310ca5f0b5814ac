/* Calls every public function that computes with inputs made of the bytes of a fuzzer: ordinary numbers, special ones (zeros,
 * equal ones, infinities, NaN, the ends of the range) and arbitrary bits, options too. Aborts where carom.h's contract is
 * broken: a result that is not finite with a status that is no error, or is with one that is, a batch with other bits than
 * calls, a trace that does not begin with the input. Crashes, hangs and undefined behaviour are for the fuzzer and the
 * sanitizers to see. */
#include "carom_shot.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const uint8_t *bytes;
static size_t left;

static unsigned byte(void) {
  if (left == 0)
    return 0;
  left--;
  return *bytes++;
}

static int choice(int n) {
  return (int)(byte() % (unsigned)n);
}

/* Mostly n, sometimes a number that names nothing. */
static int mostly(int n) {
  return choice(20) == 0 ? choice(256) - 128 : n;
}

static void arbitrary(void *to, size_t size) {
  for (size_t k = 0; k < size; k++)
    ((unsigned char *)to)[k] = (unsigned char)byte();
}

/* Mostly between low and high. */
static double number(double low, double high) {
  static const double special[] = {0,      -0.0,  1,       -1,       0.5,          0.2,       0.4,        1e-9,
                                   -1e-9,  1e-17, 1e-300,  DBL_MIN,  DBL_TRUE_MIN, 1e9,       -1e9,       1e100,
                                   -1e160, 1e300, DBL_MAX, -DBL_MAX, INFINITY,     -INFINITY, (double)NAN};
  static double last;
  double x;
  const unsigned how = byte();
  if (how < 4)
    arbitrary(&x, sizeof x);
  else if (how < 24)
    x = special[byte() % (sizeof special / sizeof special[0])];
  else if (how < 40)
    x = last;
  else if (how < 56)
    x = -last;
  else if (how < 96)
    x = how % 2 == 0 ? low : high;
  else if (how < 104)
    x = last * (1 + ldexp(1, -(int)(byte() % 60)));
  else
    x = low + (high - low) * ((256 * byte() + byte()) / 65535.0);
  last = x;
  return x;
}

static void fail(const char *what) {
  fprintf(stderr, "api: %s\n", what);
  abort();
}

/* All finite if `should`, else all NaN. */
static void expect(const double *x, size_t n, bool should, const char *what) {
  for (size_t k = 0; k < n; k++)
    if (should ? !isfinite(x[k]) : !isnan(x[k]))
      fail(what);
}

/* Whether energies, and what is on the way to a result, are within the range of double. Details and traces are held to that
 * only. */
static bool moderate(const double *x, size_t n) {
  for (size_t k = 0; k < n; k++)
    if (!(fabs(x[k]) < 1e100) || (x[k] != 0 && fabs(x[k]) < 1e-100))
      return false;
  return true;
}

static void vector(double v[3], double most, double z) {
  v[0] = number(-most, most);
  v[1] = number(-most, most);
  v[2] = z;
}

static carom_ball make_ball(void) {
  carom_ball b = {.radius = 0.028575};
  vector(b.v, 10, 0);
  vector(b.w, 300, number(-300, 300));
  b.mass = number(0.1, 0.25);
  b.mu_cloth = number(0, 0.5);
  return b;
}

static void reserve(uint64_t *reserved) {
  if (choice(50) == 49)
    *reserved = 1;
}

enum { ROWS = 40, POINTS = 12 };

static void two_balls(void) {
  carom_impact in = {.a = make_ball(), .b = make_ball(), .mu_ball = number(0, 0.2), .restitution = number(0.5, 1)};
  const double angle = choice(2) == 0 ? 0 : number(-3.2, 3.2);
  in.b.r[0] = isfinite(angle) ? 2 * in.a.radius * sin(angle) : angle;
  in.b.r[1] = isfinite(angle) ? 2 * in.a.radius * cos(angle) : angle;
  if (choice(8) == 0)
    in.a.radius = in.b.radius = number(0.02, 0.04);
  if (choice(30) == 0)
    arbitrary(&in, sizeof in);
  carom_options o = {.solver = (carom_solver)(choice(16) == 0 ? choice(256) - 128 : choice(8) == 0),
                     .slip = (carom_slip)(choice(16) == 0 ? choice(256) - 128 : choice(2)),
                     .steps = choice(16) == 0 ? -choice(3) : 1 + choice(200),
                     .threads = choice(32) == 0 ? choice(5) - 2 : 0,
                     .plain = choice(16) == 0 ? choice(5) - 2 : choice(2)};
  reserve(&o.reserved[choice(5)]);
  carom_isa_limit((carom_isa)choice(CAROM_ISA_AVX512 + 1));
  carom_result out, many[ROWS];
  int8_t statuses[ROWS];
  const carom_status status = carom_collide(&in, &o, &out);
  expect((double *)&out, 12, status >= 0, "carom_collide");
  if (carom_check(&in, &o, NULL) < 0 && status >= 0)
    fail("carom_check refuses what carom_collide solves");
  /* a batch of it among others */
  carom_impact rows[ROWS];
  const int n = 1 + choice(ROWS), at = choice(n);
  for (int k = 0; k < n; k++) {
    rows[k] = in;
    if (k != at)
      rows[k].a.v[k % 2] += 0.01 * k;
  }
  if (carom_collide_batch(rows, (size_t)n, &o, many, statuses) != CAROM_ERROR_THREADS && o.steps >= 0 && o.threads >= -1) {
    bool bad_options = (o.plain & ~1) != 0;
    for (int k = 0; k < 5; k++)
      bad_options |= o.reserved[k] != 0;
    if (!bad_options && (unsigned)o.solver <= 1 && (unsigned)o.slip <= 1 &&
        (statuses[at] != status || (status >= 0 && memcmp(&many[at], &out, sizeof out) != 0)))
      fail("a batch differs from a call");
  }
  carom_result seen;
  carom_detail detail;
  if (carom_collide_detail(&in, &o, &seen, &detail) != status || (status >= 0 && memcmp(&seen, &out, sizeof out) != 0))
    fail("carom_collide_detail differs from carom_collide");
  const bool energies = moderate((double *)&in, sizeof in / sizeof(double));
  if (status == CAROM_OK && energies &&
      !(isfinite(detail.normal) && isfinite(detail.work) && isfinite(detail.work_compression)))
    fail("a detail is not finite");
  carom_trace_point points[POINTS];
  const size_t samples = (size_t)choice(POINTS + 1);
  const carom_status traced = carom_trace(&in, &o, samples, points);
  for (size_t k = 0; k < samples && samples >= 2 && energies; k++) {
    expect((double *)&points[k].state, 12, traced >= 0, "carom_trace");
    expect(&points[k].normal, 1, traced >= 0, "the impulse of carom_trace");
  }
  /* in single precision */
  carom_impact_f32 narrow;
  carom_result_f32 out32;
  for (int k = 0; k < 26; k++) {
    const double x = ((double *)&in)[k];
    ((float *)&narrow)[k] = fabs(x) <= (double)FLT_MAX || !isfinite(x) ? (float)x : FLT_MAX;
  }
  const carom_status narrowly = carom_collide_f32(&narrow, &o, &out32);
  for (int k = 0; k < 12; k++)
    if (isfinite(((float *)&out32)[k]) != (narrowly >= 0))
      fail("carom_collide_f32");
  /* as spheres in space */
  if (choice(2) == 0)
    in.b.r[2] += number(-0.06, 0.06);
  const carom_status in_space = carom_impact3(&in, &out);
  expect((double *)&out, 12, in_space >= 0, "carom_impact3");
  double rolling[3];
  carom_rolling_velocity(in.a.v, in.a.w, in.a.radius, rolling);
  (void)carom_mu_ball(&in, carom_alciatore());
}

static void cushion(void) {
  carom_cushion_impact in = {.radius = 0.028575, .jaw_radius = number(0, 0.03)};
  vector(in.v, 5, 0);
  vector(in.w, 300, number(-300, 300));
  in.normal[0] = number(-1, 1);
  in.normal[1] = number(-1, 1);
  in.height = choice(4) == 0 ? in.radius : in.radius * number(1.2, 1.45);
  in.mass = number(0.1, 0.25);
  in.mu_cloth = number(0, 0.5);
  in.mu_cushion = number(0, 0.5);
  in.restitution = number(0.5, 1);
  if (choice(30) == 0)
    arbitrary(&in, sizeof in);
  carom_cushion_options o = {.model = (carom_cushion_model)(choice(16) == 0  ? choice(256) - 128
                                                            : choice(3) == 0 ? choice(5)
                                                                             : 0),
                             .convention = (carom_cushion_convention)choice(2),
                             .law = (carom_cushion_law)choice(2),
                             .steps = choice(16) == 0 ? -choice(3) : 1 + choice(200),
                             .least_step = choice(8) == 0 ? number(0, 0.001) : 0,
                             .omega_ratio = choice(8) == 0 ? number(1, 2) : 0,
                             .plain = choice(2)};
  reserve(&o.reserved[choice(4)]);
  carom_motion out, many[3];
  int8_t statuses[3] = {1, 1, 1};
  const carom_status status = carom_cushion(&in, &o, &out);
  expect((double *)&out, 6, status >= 0, "carom_cushion");
  if (carom_cushion_check(&in, &o, NULL) < 0 && status >= 0)
    fail("carom_cushion_check refuses what carom_cushion solves");
  const carom_cushion_impact rows[3] = {in, in, in};
  carom_cushion_batch(rows, 3, &o, many, statuses);
  if (status == CAROM_OK && (statuses[1] != status || memcmp(&many[1], &out, sizeof out) != 0))
    fail("a batch of impacts on a cushion differs from a call");
  carom_cushion_point points[POINTS];
  const size_t samples = (size_t)choice(POINTS + 1);
  const carom_status traced = carom_cushion_trace(&in, &o, samples, points);
  for (size_t k = 0; k < samples && samples >= 2 && moderate((double *)&in, sizeof in / sizeof(double)); k++) {
    expect((double *)&points[k].state, 6, traced >= 0, "carom_cushion_trace");
    expect(&points[k].normal, 1, traced >= 0, "the impulse of carom_cushion_trace");
  }
}

enum { EVENTS = 60, SHOTS = 3 };

static void shots(void) {
  static carom_table table;
  static carom_shot_ball balls[SHOTS * CAROM_BALLS_MOST];
  static carom_event events[SHOTS][EVENTS];
  static carom_ball_state final[SHOTS][CAROM_BALLS_MOST], states[CAROM_BALLS_MOST];
  memset(balls, 0, sizeof balls);
  carom_table_make((carom_table_kind)choice(6), &table);
  int count = 0;
  if (choice(3) == 0) {
    const carom_rack_kind rack = (carom_rack_kind)choice(6);
    count = carom_rack_size(rack);
    if (carom_rack(rack, &table, choice(4) == 0 ? 0 : number(0, 1e-3), byte(), balls, CAROM_BALLS_MOST) != CAROM_OK)
      return;
  } else {
    count = 1 + choice(5);
    for (int k = 0; k < count; k++) {
      carom_ball_state *s = &balls[k].state;
      balls[k].kind = carom_ball_kind_of((carom_game)choice(3));
      s->r[0] = number(0, table.width);
      s->r[1] = number(0, table.length);
      s->r[2] = balls[k].kind.radius;
      if (choice(3) == 0) {
        vector(s->v, 5, 0);
        vector(s->w, 200, number(-200, 200));
      }
      if (choice(4) == 0) { /* it flies */
        s->r[2] += number(0, 0.4);
        s->v[2] = number(-5, 5);
        s->label = choice(CAROM_BALL_OFF + 2);
      }
      if (choice(8) == 0)
        balls[k].kind.radius *= number(0.8, 1.2);
    }
  }
  /* one number of one ball, or of the table, changed */
  double *const kind = (double *)&balls[choice(count)].kind;
  if (choice(3) == 0)
    kind[choice((int)(sizeof(carom_ball_kind) / sizeof(double)))] = number(0, 1);
  if (choice(10) == 0)
    table.rail[choice(4)].height = number(0, 0.06);
  if (choice(20) == 0)
    table.rails = choice(40) - 2;
  if (choice(10) == 0)
    (&table.ball_radius)[choice(3)] = number(0, 0.2);
  carom_cue cues[SHOTS];
  for (int k = 0; k < SHOTS; k++) {
    cues[k] = carom_cue_of((carom_game)choice(3));
    cues[k].speed = number(0, 8);
    cues[k].phi = number(0, 360);
    cues[k].theta = choice(4) == 0 ? number(0, 90) : 0;
    cues[k].a = number(-0.6, 0.6);
    cues[k].b = number(-0.6, 0.6);
    cues[k].ball = choice(10) == 0 ? choice(256) - 128 : 0;
    cues[k].miscue = choice(10) == 0 ? number(0, 1) : 0;
  }
  carom_shot_options o = {.world = (carom_world)mostly(choice(3) == 0),
                          .ball_model = (carom_ball_model)mostly(choice(2) * choice(5)),
                          .cushion_model = (carom_shot_cushion)mostly(choice(2) * choice(6)),
                          .friction = (carom_ball_friction)choice(2),
                          .space = (carom_space)mostly(choice(4) == 0),
                          .steps = 1 + choice(100),
                          .events_most = 1 + choice(120),
                          .time_most = choice(3) == 0 ? number(0, 10) : 0,
                          .plain = choice(2)};
  if (choice(3) == 0)
    o.stop_at = choice(4) == 0 ? (uint64_t)choice(256) << choice(64) : CAROM_STOP_AT(choice(CAROM_EVENT_LEFT_TABLE + 1));
  reserve(&o.reserved[choice(3)]);
  static carom_shot_state state;
  carom_shot one = {.events = events[0], .room = choice(EVENTS + 1), .final = final[0], .state = &state};
  const carom_status status = carom_shoot(&table, balls, count, &cues[0], &o, &one);
  const bool played = status >= 0 || status == CAROM_ERROR_TOO_MANY_EVENTS || status == CAROM_ERROR_TOO_LONG;
  for (int k = 0; k < count && played; k++)
    for (int c = 0; c < 9; c++)
      if (!isfinite(c < 3 ? final[0][k].r[c] : c < 6 ? final[0][k].v[c - 3] : final[0][k].w[c - 6]))
        fail("the end of a shot is not finite");
  if (played && (!isfinite(one.time) || one.count < 0))
    fail("the time of a shot is not finite");
  if (carom_shot_check(&table, balls, count, &cues[0], &o, NULL) != CAROM_OK && played)
    fail("carom_shot_check refuses what carom_shoot plays");
  const carom_status at = carom_shot_at(balls, count, &one, choice(4) == 0 ? number(0, 10) : number(0, 1) * one.time, states);
  for (int k = 0; k < count && played && at == CAROM_OK; k++)
    if (isnan(states[k].r[0]) || isnan(states[k].v[0]))
      fail("carom_shot_at is not a number"); /* where a time that is not finite was asked, see below */
  double turned[CAROM_BALLS_MOST][4];
  if (at == CAROM_OK && one.time < 100 && carom_shot_orientation(balls, count, &one, one.time, turned) == CAROM_OK)
    for (int k = 0; k < count; k++)
      if (!(fabs(turned[k][0]) <= 1.001))
        fail("an orientation is no rotation");
  const carom_event first = events[0][0];
  carom_shot many[SHOTS];
  int8_t statuses[SHOTS] = {1, 1, 1};
  for (int k = 0; k < SHOTS; k++)
    many[k] = (carom_shot){.events = events[k], .room = EVENTS, .final = final[k]};
  const carom_shot_job job = {.table = &table,
                              .balls = balls,
                              .cues = cues,
                              .count = count,
                              .cue_stride = (uint64_t)choice(2),
                              .n = SHOTS,
                              .options = &o,
                              .shots = many,
                              .status = statuses};
  const int64_t first_count = one.count;
  carom_shoot_batch(&job);
  if (played && (statuses[0] != (int8_t)status || many[0].count != first_count ||
                 (one.room > 0 && one.count > 0 && memcmp(&first, &events[0][0], sizeof first) != 0)))
    fail("a batch of shots differs from a shot");
  /* on from where the shot stopped */
  if (status > 0) {
    carom_shot_options on = o;
    on.time_most = 0;
    on.stop_at = 0;
    const carom_status then = carom_shot_continue(&table, balls, count, &on, &one);
    if (then == CAROM_ERROR_STATE || one.count < first_count)
      fail("carom_shot_continue refuses the state of a shot that was stopped");
  }
  carom_motion struck;
  if (carom_strike(&cues[0], &balls[0].kind, &struck) == CAROM_OK)
    expect((double *)&struck, 6, true, "carom_strike");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  bytes = data;
  left = size;
  switch (choice(4)) {
  case 0:
    shots();
    break;
  case 1:
    cushion();
    break;
  default:
    two_balls();
  }
  return 0;
}
