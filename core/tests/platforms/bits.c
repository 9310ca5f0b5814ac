/* CAROM_ISA=plain gives the same bits on every machine and with every compiler: a hash of
 * results for each part of the library. Inputs are drawn by correctly rounded operations alone,
 * so they have the same bits everywhere too. bits.expected has the hashes. They change only with
 * the numerics, in the commit that explains why.
 *
 *     bits            prints a line for each part: what was computed, and the hash of its
 *                     results
 *     bits best       the same by the best instruction set there is, of collisions of balls
 *                     alone
 *     bits numbers    prints results of the exact solver instead, as hexadecimal floats, by the
 *                     best instruction set
 *
 * This program is run under emulators, so it needs nothing but the library. */
#include <carom.h>
#include <carom_shot.h>
#ifndef CAROM_WITHOUT_PLAN
#include <carom_plan.h>
#endif

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF /* gcc has -ffp-contract=off of the command line */
#endif

enum {
  ROWS = 4000,
  EDGES = 800,
  CUSHIONS = 800,
  SHOTS = 4,
  ROOM = 4096,
  NUMBERS = 1500,
  LOOKS = 400,
  TRACES = 40,
  AIMS = 60,
  POINTS = 9
};

/* splitmix64 */
static uint64_t state;

static uint64_t random_bits(void) {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static double between(double low, double high) {
  return low + (high - low) * (double)(random_bits() >> 11) * 0x1p-53;
}

/* A power of two between 2^low and 2^high, by products that are exact. */
static double power_of_two(double low, double high) {
  double x = 1.0;
  const double exponent = between(low, high);
  for (int k = 1; k <= exponent; k++)
    x *= 2.0;
  for (int k = -1; k >= exponent; k--)
    x *= 0.5;
  return x;
}

/* FNV-1a, in an order that does not depend on that of bytes in memory. NaN has many bits: only
 * that it is NaN counts. */
static const uint64_t START = 0xcbf29ce484222325u;

static uint64_t add(uint64_t hash, uint64_t bits) {
  for (int k = 0; k < 8; k++)
    hash = (hash ^ (bits >> 8 * k & 0xff)) * 0x100000001b3u;
  return hash;
}

static uint64_t add_numbers(uint64_t hash, const double *x, size_t n) {
  for (size_t k = 0; k < n; k++) {
    uint64_t bits = 1;
    if (!isnan(x[k]))
      memcpy(&bits, &x[k], sizeof bits);
    hash = add(hash, bits);
  }
  return hash;
}

static uint64_t add_singles(uint64_t hash, const float *x, size_t n) {
  for (size_t k = 0; k < n; k++) {
    uint32_t bits = 1;
    if (!isnan(x[k]))
      memcpy(&bits, &x[k], sizeof bits);
    hash = add(hash, bits);
  }
  return hash;
}

static void show(const char *what, uint64_t hash) {
  printf("%s %08lx%08lx\n", what, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
}

/* ---- Two balls ------------------------------------------------------------------------------- */

/* Plain shots, in turn with friction and motion of all sizes; some rows in error. */
static carom_impact draw_collision(size_t k) {
  const int wild = k % 2 == 1;
  const double radius = 0.028575, x = between(-1.0, 1.0), y = between(-1.0, 1.0);
  const double length = sqrt(x * x + y * y) + 0x1p-60;
  carom_ball a = {.radius = radius, .mass = 0.17, .mu_slide = between(0.0, wild ? 1.0 : 0.4)},
             b = a;
  b.mu_slide = between(0.0, wild ? 1.0 : 0.4);
  b.mass = wild ? 0.17 * power_of_two(-3.0, 3.0) : 0.17;
  b.r[0] = 2.0 * radius * x / length;
  b.r[1] = 2.0 * radius * y / length;
  for (int c = 0; c < 2; c++) {
    a.v[c] = between(-2.0, 2.0);
    b.v[c] = wild ? between(-2.0, 2.0) : 0.0;
    if (wild)
      b.v[c] *= power_of_two(-30.0, 2.0);
  }
  for (int c = 0; c < 3; c++) {
    a.w[c] = between(-100.0, 100.0);
    if (wild)
      a.w[c] *= power_of_two(-30.0, 3.0);
    b.w[c] = wild ? between(-100.0, 100.0) : 0.0;
  }
  carom_impact in = {.a = a, .b = b};
  in.mu_ball = between(0.0, wild ? 1.0 : 0.12);
  in.restitution = between(wild ? 0.0 : 0.8, 1.0);
  if (k % 97 == 50)
    in.restitution = 2.0;
  return in;
}

/* What users type: a ball that rolls along an axis onto a resting one, with round numbers that
 * are equal or 0 in pairs. */
static carom_impact draw_edge(size_t k) {
  static const double frictions[] = {0.0, 0.05, 0.2, 0.4, 1.0}, cuts[] = {0.0, 0.25, 0.5, 0.75};
  const double R = 0.028575, side = cuts[k % 4], speed = 0.5 * (double)(1 + k % 3);
  carom_impact in = {
      .a = {.v = {speed, 0.0, 0.0}, .radius = R, .mass = 0.17, .mu_slide = frictions[k / 4 % 5]},
      .mu_ball = frictions[k / 20 % 5],
      .restitution = k / 100 % 2 == 0 ? 1.0 : 0.9};
  in.a.w[1] = k / 200 % 2 == 0 ? speed / R : 0.0;
  in.a.w[2] = k / 400 % 2 == 0 ? 0.0 : 20.0;
  in.b = in.a;
  memset(in.b.v, 0, sizeof in.b.v);
  memset(in.b.w, 0, sizeof in.b.w);
  in.b.r[0] = 2.0 * R * sqrt(1.0 - side * side);
  in.b.r[1] = 2.0 * R * side;
  return in;
}

static carom_impact in[ROWS];
static carom_impact_f32 in_f32[ROWS];

static void collisions(const char *drawn, size_t n) {
  static carom_result out[ROWS];
  static carom_result_f32 out_f32[ROWS];
  static int8_t status[ROWS];
  char what[100];
  for (size_t k = 0; k < n; k++)
    for (int c = 0; c < 26; c++)
      ((float *)&in_f32[k])[c] = (float)((const double *)&in[k])[c];
  for (int way = 0; way < 4; way++) {
    const carom_options options = {.solver = way < 2 ? CAROM_SOLVER_EXACT : CAROM_SOLVER_EULER,
                                   .slip = way % 2 == 0 ? CAROM_SLIP_PAPER : CAROM_SLIP_POOLTOOL,
                                   .steps = 100,
                                   /* where there are threads; no bit depends on them */
                                   .threads = 3};
    const char *solver = carom_word(CAROM_WORDS_SOLVER, (int)options.solver),
               *slip = carom_word(CAROM_WORDS_SLIP, (int)options.slip);
    carom_collide_batch(in, n, &options, out, status);
    uint64_t hash = add_numbers(START, (const double *)out, n * 12);
    for (size_t k = 0; k < n; k++)
      hash = add(hash, (uint64_t)(uint8_t)status[k]);
    snprintf(what, sizeof what, "%s: %s, slip %s, double", drawn, solver, slip);
    show(what, hash);
    carom_collide_batch_f32(in_f32, n, &options, out_f32, status);
    snprintf(what, sizeof what, "%s: %s, slip %s, single", drawn, solver, slip);
    show(what, add_singles(START, (const float *)out_f32, n * 12));
  }
  uint64_t hash = START;
  for (size_t k = 0; k < n; k++) {
    const double mu = carom_mu_ball(&in[k], carom_alciatore());
    hash = add_numbers(hash, &mu, 1);
  }
  snprintf(what, sizeof what, "%s: carom_mu_ball()", drawn);
  show(what, hash);
}

/* A few collisions on their way, and what else is known of them. Of a point the doubles are
 * hashed; NaN is one of them. */
static void looks(void) {
  static carom_trace_point points[POINTS];
  for (int way = 0; way < 4; way++) {
    const carom_options options = {.solver = way < 2 ? CAROM_SOLVER_EXACT : CAROM_SOLVER_EULER,
                                   .slip = way % 2 == 0 ? CAROM_SLIP_PAPER : CAROM_SLIP_POOLTOOL,
                                   .steps = 100};
    uint64_t details = START, traces = START;
    for (int k = 0; k < LOOKS; k++) {
      carom_result out;
      carom_detail detail;
      carom_collide_detail(&in[k], &options, &out, &detail);
      details = add(add_numbers(details, (const double *)&out, 12), (uint64_t)detail.evaluations);
      details = add(add_numbers(details, &detail.normal, 12), (uint64_t)detail.stick);
      details = add_numbers(details, &detail.stick_normal, 1);
    }
    for (int k = 0; k < TRACES; k++) {
      traces = add(traces, (uint64_t)(int64_t)carom_trace(&in[k], &options, POINTS, points));
      for (int n = 0; n < POINTS; n++) {
        traces = add(add_numbers(traces, &points[n].normal, 2),
                     (uint64_t)((int)points[n].phase * 2 + points[n].sticks));
        traces = add_numbers(add_numbers(traces, &points[n].v_n, 7),
                             (const double *)&points[n].state, 12);
      }
    }
    char what[100];
    const char *solver = carom_word(CAROM_WORDS_SOLVER, (int)options.solver),
               *slip = carom_word(CAROM_WORDS_SLIP, (int)options.slip);
    snprintf(what, sizeof what, "details: %s, slip %s", solver, slip);
    show(what, details);
    snprintf(what, sizeof what, "traces: %s, slip %s", solver, slip);
    show(what, traces);
  }
}

/* ---- A ball and a cushion -------------------------------------------------------------------- */

/* Impacts of play; every fourth has a ball that rolls or does not turn, straight at the cushion
 * or not. */
static carom_cushion_impact draw_cushion(size_t k) {
  carom_cushion_impact rail = {
      .normal = {0.0, 1.0}, .height = 0.0365, .radius = 0.028575, .mass = 0.17};
  rail.v[0] = between(-3.0, 3.0);
  rail.v[1] = between(0.05, 4.0);
  for (int c = 0; c < 3; c++)
    rail.w[c] = between(-120.0, 120.0);
  rail.mu_slide = between(0.0, 0.4);
  rail.mu_cushion = between(0.0, 0.6);
  rail.restitution = between(0.4, 1.0);
  rail.jaw_radius = k % 3 == 0 ? 0.02 : 0.0;
  if (k % 4 == 3) {
    const int rolls = k / 4 % 2 == 0;
    if (k / 8 % 2 == 0)
      rail.v[0] = 0.0;
    rail.w[0] = rolls ? -rail.v[1] / rail.radius : 0.0;
    rail.w[1] = rolls ? rail.v[0] / rail.radius : 0.0;
    rail.w[2] = k / 16 % 2 == 0 ? 0.0 : rail.w[2];
  } else if (k % 2 == 0) {
    rail.normal[0] = between(-1.0, 1.0);
    rail.normal[1] = between(-1.0, 1.0);
  }
  return rail;
}

static void cushions(void) {
  static carom_cushion_impact rail[CUSHIONS];
  static carom_motion out[CUSHIONS];
  static int8_t status[CUSHIONS];
  state = 3;
  for (size_t k = 0; k < CUSHIONS; k++)
    rail[k] = draw_cushion(k);
  for (int model = CAROM_CUSHION_MATHAVAN; model <= CAROM_CUSHION_SMOOTH; model++)
    for (int way = 0; way < 4; way++) {
      const carom_cushion_options options = {
          .model = (carom_cushion_model)model,
          .convention = way % 2 == 0 ? CAROM_CONVENTION_PAPER : CAROM_CONVENTION_POOLTOOL,
          .law = way < 2 ? CAROM_CUSHION_LAW_CONSTANT : CAROM_CUSHION_LAW_HAN,
          .steps = 100,
          .omega_ratio = way == 3 ? 1.3 : 0.0};
      carom_cushion_batch(rail, CUSHIONS, &options, out, status);
      uint64_t hash = add_numbers(START, (const double *)out, CUSHIONS * 6);
      for (size_t k = 0; k < CUSHIONS; k++)
        hash = add(hash, (uint64_t)(uint8_t)status[k]);
      char what[100];
      snprintf(what, sizeof what, "cushions: %s, convention %s, law %s",
               carom_word(CAROM_WORDS_CUSHION_MODEL, (int)options.model),
               way % 2 == 0 ? "paper" : "pooltool", way < 2 ? "constant" : "han");
      show(what, hash);
    }
}

/* Neither slip nor sideways motion at the nose at first, to the last bit: where friction cannot
 * hold it, the slip begins. */
static void slips_that_begin(void) {
  const double R = 0x1p-5;
  uint64_t hash = START;
  state = 5;
  for (int k = 0; k < 600; k++) {
    const double sine = (k % 9 - 4) / 16.0,
                 v_x = k % 2 == 0 || sine == 0.0 ? 0.0 : (k % 7 - 3) / 4.0;
    const carom_cushion_impact rail = {.v = {v_x, 1.0, 0.0},
                                       .w = {sine / R, v_x == 0.0 ? 0.0 : -v_x / sine / R, 0.0},
                                       .normal = {0.0, 1.0},
                                       .height = (1.0 + sine) * R,
                                       .radius = R,
                                       .mass = 0.17,
                                       .mu_slide = between(0.0, 0.6),
                                       .mu_cushion = between(0.0, 0.3),
                                       .restitution = 0.8};
    carom_motion out;
    hash = add(hash, (uint64_t)(int64_t)carom_cushion(&rail, NULL, &out));
    hash = add_numbers(hash, (const double *)&out, 6);
  }
  show("cushions: slips that begin", hash);
}

/* A few impacts on their way. */
static void cushion_traces(void) {
  static carom_cushion_point points[POINTS];
  state = 5;
  for (int way = 0; way < 2; way++) {
    const carom_cushion_options options = {
        .model = way == 0 ? CAROM_CUSHION_MATHAVAN : CAROM_CUSHION_EULER, .steps = 100};
    uint64_t hash = START;
    for (size_t k = 0; k < TRACES; k++) {
      const carom_cushion_impact rail = draw_cushion(k);
      hash = add(hash, (uint64_t)(int64_t)carom_cushion_trace(&rail, &options, POINTS, points));
      for (int n = 0; n < POINTS; n++) {
        hash = add_numbers(hash, &points[n].normal, 2);
        hash = add(hash, (uint64_t)((int)points[n].phase * 4 + points[n].nose_sticks * 2 +
                                    points[n].cloth_sticks));
        hash =
            add_numbers(add_numbers(hash, &points[n].v_n, 5), (const double *)&points[n].state, 6);
      }
    }
    show(way == 0 ? "cushion traces: mathavan" : "cushion traces: euler", hash);
  }
}

/* ---- Complete shots -------------------------------------------------------------------------- */

static uint64_t add_state(uint64_t hash, const carom_ball_state *s) {
  return add(add_numbers(hash, s->r, 9), (uint64_t)s->label);
}

static uint64_t add_shot(uint64_t hash, const carom_shot *shot, int balls, carom_status status) {
  hash = add(add(hash, (uint64_t)(int64_t)status), (uint64_t)shot->count);
  for (int64_t k = 0; k < shot->count && k < ROOM; k++) {
    const carom_event *e = &shot->events[k];
    hash = add(add_numbers(hash, &e->time, 1), (uint64_t)(e->type * 10000 + e->a * 100 + e->b));
    for (int side = 0; side < (e->type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++)
      hash = add_state(add_state(hash, &e->before[side]), &e->after[side]);
  }
  for (int k = 0; k < balls; k++)
    hash = add_state(hash, &shot->final[k]);
  return add_numbers(hash, &shot->time, 1);
}

static void shots(void) {
  static const struct {
    const char *name;
    carom_rack_kind rack;
    carom_table_kind table;
    carom_game game;
  } games[] = {{"nine-ball", CAROM_RACK_NINEBALL, CAROM_TABLE_POOL_9FT, CAROM_GAME_POOL},
               {"eight-ball", CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_7FT, CAROM_GAME_POOL},
               {"snooker", CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, CAROM_GAME_POOLTOOL_SNOOKER},
               {"three-cushion", CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION,
                CAROM_GAME_POOLTOOL_BILLIARD},
               {"snooker as measured", CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, CAROM_GAME_SNOOKER},
               {"three-cushion as measured", CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION,
                CAROM_GAME_BILLIARD}};
  /* the options of a shot: its world, its models of balls and cushions, its friction */
  static const struct {
    const char *name;
    carom_shot_options options;
  } models[] = {
      {"default", {0}},
      {"stronge", {.cushion_model = CAROM_SHOT_CUSHION_STRONGE}},
      {"han", {.cushion_model = CAROM_SHOT_CUSHION_HAN, .friction = CAROM_FRICTION_CONSTANT}},
      {"mirror",
       {.cushion_model = CAROM_SHOT_CUSHION_MIRROR, .ball_model = CAROM_BALL_MODEL_INELASTIC}},
      {"euler",
       {.cushion_model = CAROM_SHOT_CUSHION_EULER,
        .ball_model = CAROM_BALL_MODEL_EULER,
        .steps = 100}},
      {"world pooltool", {.world = CAROM_WORLD_POOLTOOL}},
      {"mathavan", {.cushion_model = CAROM_SHOT_CUSHION_MATHAVAN}},
      {"smooth", {.cushion_model = CAROM_SHOT_CUSHION_SMOOTH}}};
  static carom_event events[ROOM];
  static carom_shot_ball balls[CAROM_BALLS_MOST];
  static carom_ball_state final[CAROM_BALLS_MOST], later[CAROM_BALLS_MOST];
  static carom_table table;
  state = 4;
  for (int n = 0; n < 72; n++) {
    /* each of six models with four games, then with the two measured ones; then mathavan with all
     * six; then five models with all six in space. Later rows leave the draws of others alone */
    const bool space = n >= 42;
    int m = 6, g = n - 36;
    if (n < 24) {
      m = n / 4;
      g = n % 4;
    } else if (n < 36) {
      m = n / 2 - 12;
      g = 4 + n % 2;
    } else if (space) {
      m = (n - 42) / 6;
      g = (n - 42) % 6;
    }
    carom_shot_options options = models[m].options;
    options.space = space ? CAROM_SPACE_3D : CAROM_SPACE_FLAT;
    uint64_t hash = START;
    carom_table_make(games[g].table, &table);
    for (int k = 0; k < SHOTS; k++) {
      /* a break from a rack with gaps, or frozen; in three-cushion in any direction; every
       * fourth with the butt raised */
      const int count = carom_rack_size(games[g].rack);
      carom_rack(games[g].rack, &table, k == 1 ? 0.0 : 1e-4, (uint64_t)k, balls, count);
      for (int i = 0; i < count; i++) {
        balls[i].kind = carom_ball_kind_of(games[g].game);
        balls[i].state.r[2] = balls[i].kind.radius;
      }
      carom_cue cue = carom_cue_of(games[g].game);
      cue.speed = between(0.5, 8.5);
      cue.phi =
          games[g].rack == CAROM_RACK_THREECUSHION ? between(0.0, 360.0) : between(80.0, 100.0);
      cue.theta = k == 3 ? between(0.0, 60.0) : 2.0;
      cue.a = between(-0.4, 0.4);
      cue.b = between(-0.4, 0.4);
      carom_shot shot = {.events = events, .room = ROOM, .final = final};
      const carom_status status = carom_shoot(&table, balls, count, &cue, &options, &shot);
      /* the bits of a refusal say nothing of shots */
      if (status < 0) {
        fprintf(stderr, "%s: %s\n", games[g].name, carom_status_string(status));
        exit(1);
      }
      hash = add_shot(hash, &shot, count, status);
      if (carom_shot_at(balls, count, &shot, 1.25, later) == CAROM_OK)
        for (int i = 0; i < count; i++)
          hash = add_state(hash, &later[i]);
    }
    char what[100];
    snprintf(what, sizeof what, "shots%s: %s, %s", space ? " in space" : "", games[g].name,
             models[m].name);
    show(what, hash);
  }
}

/* Continues the hash of a shot of a cue ball at (x, 0.6) at another at (0.5, y). */
static uint64_t add_near_ball(uint64_t hash, const carom_cue *cue, double x, double y) {
  static carom_table table;
  static carom_event events[ROOM];
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_shot_ball balls[2] = {{.kind = carom_ball_kind_of(CAROM_GAME_POOL)},
                              {.kind = carom_ball_kind_of(CAROM_GAME_POOL)}};
  carom_place_ball(&table, balls, 1, 0, x, 0.6, NULL);
  carom_place_ball(&table, balls, 2, 1, 0.5, y, NULL);
  carom_ball_state final[2];
  carom_shot shot = {.events = events, .room = ROOM, .final = final};
  const carom_status status = carom_shoot(&table, balls, 2, cue, NULL, &shot);
  return add_shot(hash, &shot, 2, status);
}

/* Straight shots at a near ball, which the tip of a cue that follows through touches twice; some
 * with the butt raised. */
static void follow_through(void) {
  uint64_t hash = START;
  state = 7;
  for (int k = 0; k < 40; k++) {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = between(0.5, 8.0);
    cue.theta = k % 4 == 3 ? between(0.0, 40.0) : 0.0;
    const double x = between(0.4, 0.6), y = 0.66 + between(0.0, 0.03);
    hash = add_near_ball(hash, &cue, x, y);
  }
  show("shots: follow-through", hash);
}

/* The same with a cue that touches once: it does not follow through. */
static void no_follow_through(void) {
  uint64_t hash = START;
  state = 8;
  for (int k = 0; k < 40; k++) {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = between(0.5, 8.0);
    cue.theta = between(0.0, 50.0);
    cue.a = cue.b = 0.0;
    cue.follow = 0.0;
    hash = add_near_ball(hash, &cue, 0.5, 0.66 + between(0.0, 0.004));
  }
  show("shots: no follow-through", hash);
}

/* ---- Positions and aims ---------------------------------------------------------------------- */

/* Which positions of a grid are on a table of one's own, whose rails are short. */
static void places(void) {
  static const carom_corner corner[9] = {
      {0, 0.9375, 0.125},     {0.125, 0.625, 0.125}, {0.25, 0.28125, 0.125},
      {0.5, 0.125, 0.125},    {0.8125, 0, 0.125},    {1.375, 0.4375, 0.125},
      {1.125, 1.1875, 0.125}, {0.75, 1.4375, 0.125}, {0.4375, 1.6875, 0}};
  static carom_table table;
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  uint64_t hash = add(START, (uint64_t)carom_table_polygon(corner, 9, 0.0365, 0.025,
                                                           ball.kind.radius, &table, NULL));
  for (int i = -8; i < 60; i++)
    for (int j = -8; j < 70; j++)
      hash = add(hash, (uint64_t)(int64_t)carom_place_ball(&table, &ball, 1, 0, i * 0.03125 + 0.001,
                                                           j * 0.03125 + 0.001, NULL));
  show("places: polygon", hash);
}

#ifndef CAROM_WITHOUT_PLAN
/* Aims of a cue that is left to the stick, next to the head cushion. */
static void aims(void) {
  static carom_table table;
  carom_shot_ball balls[2] = {{.kind = carom_ball_kind_of(CAROM_GAME_POOL)},
                              {.kind = carom_ball_kind_of(CAROM_GAME_POOL)}};
  uint64_t hash = START;
  state = 5;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int k = 0; k < AIMS; k++) {
    carom_pot pot = {.ball = 1, .pocket = k % 6};
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.speed = between(1.5, 4.0);
    cue.theta = (double)NAN;
    /* one draw a statement: arguments are computed in any order */
    double at[4];
    for (int c = 0; c < 4; c++)
      at[c] = between(0.0, 1.0);
    carom_place_ball(&table, balls, 1, 0, 0.1 + at[0], 0.03 + 0.25 * at[1], NULL);
    carom_place_ball(&table, balls, 2, 1, 0.1 + at[2], 0.4 + 2.0 * at[3], NULL);
    hash = add(hash, (uint64_t)(int64_t)carom_aim(&table, balls, 2, NULL, &pot, &cue));
    hash = add_numbers(add(hash, (uint64_t)pot.outcome), &pot.elevation, 1);
    if (pot.outcome == CAROM_POT_FALLS)
      hash = add_numbers(add_numbers(hash, &cue.phi, 1), pot.phi, 2);
  }
  show("aims: least elevation", hash);
}
#endif

int main(int argc, char **argv) {
  if (argc > 1 && strcmp(argv[1], "revision") == 0)
    return printf("%d\n", carom_physics_revision()) < 0;
  const int numbers = argc > 1 && strcmp(argv[1], "numbers") == 0;
  if (argc == 1)
    carom_isa_limit(CAROM_ISA_PLAIN);
  state = 1;
  for (size_t k = 0; k < ROWS; k++)
    in[k] = draw_collision(k);
  for (size_t k = 0; numbers && k < NUMBERS; k++) {
    carom_result out;
    if (carom_collide(&in[k], NULL, &out) != CAROM_OK)
      continue;
    for (int c = 0; c < 12; c++)
      printf("%a%c", ((const double *)&out)[c], c < 11 ? ' ' : '\n');
  }
  if (numbers)
    return 0;
  collisions("collisions", ROWS);
  if (argc == 1)
    looks();
  for (size_t k = 0; k < EDGES; k++)
    in[k] = draw_edge(k);
  collisions("edges", EDGES);
  if (argc > 1)
    return 0;
  cushions();
  slips_that_begin();
  cushion_traces();
  shots();
  follow_through();
  no_follow_through();
  places();
#ifndef CAROM_WITHOUT_PLAN
  aims();
#endif
  return 0;
}
