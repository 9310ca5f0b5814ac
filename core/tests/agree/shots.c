/* Complete shots have equal bits in a batch and in single calls, whatever the threads and the
 * cut. */
#include "carom_tangent.h"
#include "random_shots.h"
#include "shot/sim.h"
#include "support.h"

enum { SHOTS = 150, ROOM = 1000 }; /* threads take 64 shots at a time */

static carom_table table;
static carom_shot_ball balls[SHOTS * 16];
static carom_cue cues[SHOTS];

/* Eight-ball breaks, each with its own rack and cue; the fifth has a cue that misses. */
static void make_breaks(void) {
  lab_random r = {test_seed()};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int k = 0; k < SHOTS; k++) {
    carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, (uint64_t)k, balls + 16 * k, 16);
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = lab_uniform(&r, 3.0, 10.0);
    cues[k].phi = lab_uniform(&r, 88.0, 92.0);
    cues[k].a = lab_uniform(&r, -0.3, 0.3);
  }
  cues[4].a = 2.0;
}

/* Plays the first rack, and continues with it. */
static carom_status shoot(const carom_cue *cue, const carom_shot_options *options,
                          carom_shot *shot) {
  return carom_shoot(&table, balls, 16, cue, options, shot);
}

static carom_status go_on(const carom_shot_options *options, carom_shot *shot) {
  return carom_shot_continue(&table, balls, 16, options, shot);
}

typedef struct results {
  carom_shot shot[SHOTS];
  carom_event *events;
  carom_ball_state final[SHOTS][16];
  carom_facts facts[SHOTS];
  carom_shot_state state[SHOTS];
  int8_t status[SHOTS];
} results;

static results *make_results(void) {
  results *r = calloc(1, sizeof *r);
  r->events = calloc((size_t)SHOTS * ROOM, sizeof *r->events);
  for (int k = 0; k < SHOTS; k++)
    r->shot[k] = (carom_shot){.events = r->events + (size_t)k * ROOM,
                              .room = ROOM,
                              .final = r->final[k],
                              .facts = &r->facts[k],
                              .state = &r->state[k]};
  return r;
}

/* Plays n shots as a batch like this one, from one of its shots on. */
static carom_status play_batch(const carom_shot_job *like, int from, int n, results *r) {
  carom_shot_job job = *like;
  job.table = &table;
  if (like->kinds == NULL)
    job.balls = balls + like->ball_stride * (uint64_t)from;
  else
    job.states += like->ball_stride * (uint64_t)from;
  job.cues = cues + like->cue_stride * (uint64_t)from;
  job.n = (uint64_t)n;
  job.shots = r->shot + from;
  job.status = r->status + from;
  return carom_shoot_batch(&job);
}

static void same_results(const results *a, const results *b) {
  for (int k = 0; k < SHOTS; k++) {
    ck_assert_int_eq(a->status[k], b->status[k]);
    ck_assert_int_eq(a->shot[k].count, b->shot[k].count);
    ck_assert_mem_eq(&a->shot[k].time, &b->shot[k].time, sizeof a->shot[k].time);
  }
  ck_assert_mem_eq(a->final, b->final, sizeof a->final);
  ck_assert_mem_eq(a->facts, b->facts, sizeof a->facts);
  ck_assert_mem_eq(a->state, b->state, sizeof a->state);
  ck_assert_mem_eq(a->events, b->events, (size_t)SHOTS * ROOM * sizeof *a->events);
}

static void free_results(results *r) {
  free(r->events);
  free(r);
}

/* Plays n shots by themselves, and as batches like this one by any number of threads, which have
 * the same results; a batch has the status of its first error. Returns the results. */
static results *play_both(const carom_shot_job *like, int n) {
  static const int threads[] = {0, 1, 2, 3, 7, CAROM_ALL_THREADS};
  results *single = make_results();
  carom_status first = CAROM_OK;
  for (int k = 0; k < n; k++) {
    const carom_status status =
        carom_shoot(&table, balls + like->ball_stride * (uint64_t)k, (int)like->count,
                    &cues[like->cue_stride * (uint64_t)k], like->options, &single->shot[k]);
    single->status[k] = (int8_t)status;
    first = first < 0 ? first : status;
  }
  for (size_t t = 0; t < COUNT_OF(threads); t += SANITIZED ? 3 : 1) {
    results *batch = make_results();
    carom_shot_options options = *like->options;
    carom_shot_job job = *like;
    options.threads = threads[t];
    job.options = &options;
    ck_assert_int_eq(play_batch(&job, 0, n, batch), first);
    same_results(single, batch);
    free_results(batch);
  }
  return single;
}

TEST(batch_is_singles) {
  make_breaks();
  for (int world = 0; world < 2; world++) {
    const carom_shot_options options = {.world = (carom_world)world,
                                        .cushion_model = CAROM_SHOT_CUSHION_HAN};
    const carom_shot_job job = {
        .count = 16, .ball_stride = 16, .cue_stride = 1, .options = &options};
    results *single = play_both(&job, SHOTS);
    ck_assert_int_eq(single->status[4], CAROM_ERROR_MISCUE);
    expect_ok(single->status[5]);
    /* any cut */
    lab_random r = {test_seed()};
    results *cut = make_results();
    for (int from = 0, size; from < SHOTS; from += size) {
      size = (int)lab_uniform(&r, 1.0, 9.0);
      size = from + size <= SHOTS ? size : SHOTS - from;
      play_batch(&job, from, size, cut);
    }
    same_results(single, cut);
    free_results(cut);
    free_results(single);
  }
}

/* Each layout is checked and played with its own radius and its own kinds of balls, whatever the
 * radius of the others: too large for the nose, too small for it, in the cushion with this
 * radius and not with that. */
TEST(radii) {
  enum { LAYOUTS = 144, BALLS = 2 };
  static const double factor[] = {1.0, 1.0, 1.1, 0.7, 1.0, 1.95, 0.4, 1.1, 0.0};
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  const carom_shot_job job = {
      .count = BALLS, .ball_stride = BALLS, .cue_stride = 1, .options = &options};
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  int played = 0, refused = 0;
  const int step = SANITIZED ? 4 : 1;
  for (int from = 0; from < 9; from += step) { /* each may be the first */
    for (int k = 0; k < LAYOUTS; k++) {
      for (int i = 0; i < BALLS; i++) {
        carom_shot_ball *b = &balls[BALLS * k + i];
        *b = (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_BILLIARD)};
        b->kind.radius *= factor[(from + k) % 9];
        b->kind.mass *= 1.0 + 0.3 * i + 0.01 * k; /* every other constant is the ball's own too */
        b->kind.mu_roll *= 1.0 + 0.02 * k;
        b->kind.restitution_cushion -= 0.001 * k;
        b->state = (carom_ball_state){.r = {0.055 + 0.3 * i, 0.5 + 0.005 * k, b->kind.radius}};
      }
      cues[k] = carom_cue_of(CAROM_GAME_BILLIARD);
      cues[k].phi = 37.0 + 10.0 * k;
    }
    results *single = play_both(&job, LAYOUTS);
    for (int k = 0; k < LAYOUTS; k++) {
      played += single->status[k] == CAROM_OK;
      refused += single->status[k] == CAROM_ERROR_NOSE_HEIGHT ||
                 single->status[k] == CAROM_ERROR_OFF_TABLE;
    }
    free_results(single);
  }
  ck_assert_int_eq(played * step, (8 + step) * 96);
  ck_assert_int_eq(refused * step, (8 + step) * 32);
}

/* One layout for all cues, one cue for all layouts; layouts and cues further apart than they are
 * long. */
TEST(one_for_all) {
  make_breaks();
  cues[4].a = 0.0;
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  const carom_shot_job jobs[] = {
      {.count = 16, .cue_stride = 1, .options = &options},
      {.count = 16, .ball_stride = 16, .options = &options},
      {.count = 11, .ball_stride = 48, .cue_stride = 2, .options = &options}};
  for (int k = 0; k < 3; k++)
    free_results(play_both(&jobs[k], k < 2 ? SHOTS : SHOTS / 3));
}

/* Brief events instead of full ones tell what those do; the fuzzer has both next to each other,
 * and less room. States at a time need the full ones. */
TEST(brief_events) {
  static carom_brief_event brief[ROOM];
  static carom_event full[ROOM];
  make_breaks();
  carom_shot a = {.events = full, .room = ROOM}, b = {.brief = brief, .room = ROOM};
  expect_ok(shoot(&cues[0], NULL, &a));
  expect_ok(shoot(&cues[0], NULL, &b));
  ck_assert(a.count > 0 && a.count <= ROOM && a.count == b.count);
  for (int64_t k = 0; k < a.count; k++) {
    const carom_brief_event told = {full[k].time, full[k].type, full[k].a, full[k].b, 0};
    ck_assert_mem_eq(&brief[k], &told, sizeof told);
  }
  carom_ball_state states[16];
  ck_assert_int_eq(carom_shot_at(balls, 16, &b, 0.5, states), CAROM_ERROR_EVENTS_LOST);
}

/* ---- Kinds and states by reference, instead of balls */

enum { LAYOUTS = 60, BALLS = 6 };
static carom_ball_kind kinds[BALLS];
static carom_ball_state lies[LAYOUTS * BALLS];

/* Random positions of balls whose kinds differ; layout 7 has balls that overlap, and the cue of
 * shot 11 is bad. */
static void make_layouts(void) {
  lab_random r = {test_seed()};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int i = 0; i < BALLS; i++) {
    kinds[i] = carom_ball_kind_of(CAROM_GAME_POOL);
    kinds[i].mu_slide = 0.15 + 0.02 * i;
    kinds[i].mu_roll = 0.008 + 0.001 * i;
    kinds[i].restitution = 0.9 + 0.01 * i;
    kinds[i].restitution_cushion = 0.8 + 0.02 * i;
  }
  for (int k = 0; k < LAYOUTS; k++) {
    carom_shot_ball *const b = balls + BALLS * k;
    for (int i = 0; i < BALLS; i++)
      b[i] = (carom_shot_ball){.kind = kinds[i], .state.label = CAROM_BALL_POCKETED};
    for (int i = 0; i < BALLS; i++)
      while (carom_place_ball(&table, b, BALLS, i, lab_uniform(&r, 0.0, table.width),
                              lab_uniform(&r, 0.0, table.length), NULL) != CAROM_OK) {
      }
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = lab_uniform(&r, 1.0, 4.0);
    cues[k].phi = lab_uniform(&r, 0.0, 360.0);
  }
  memcpy(balls[7 * BALLS + 3].state.r, balls[7 * BALLS + 2].state.r, sizeof balls->state.r);
  cues[11].phi = NAN;
  for (int k = 0; k < LAYOUTS * BALLS; k++)
    lies[k] = balls[k].state;
}

/* The bits of single shots with whole balls; layouts of their own or the first one for all, to rest
 * or stopped, with states to continue. */
TEST(kinds_and_states_have_the_bits_of_balls) {
  make_layouts();
  for (int k = 0; k < 6; k++) {
    const carom_shot_options options = {.world = (carom_world)(k % 2),
                                        .time_most = k < 4 ? 0.0 : 1.5};
    const carom_shot_job job = {.kinds = kinds,
                                .states = lies,
                                .count = BALLS,
                                .ball_stride = k < 2 ? 0 : BALLS,
                                .cue_stride = 1,
                                .options = &options};
    results *single = play_both(&job, LAYOUTS);
    ck_assert_int_eq(single->status[7], k < 2 ? CAROM_OK : CAROM_ERROR_OVERLAP);
    ck_assert_int_eq(single->status[11], CAROM_ERROR_CUE_PHI);
    int contacts = 0, in_error = 0;
    for (int n = 0; n < LAYOUTS; n++) {
      contacts += single->facts[n].first[0] >= 0;
      in_error += single->status[n] < 0;
    }
    ck_assert(k >= 4 || contacts > LAYOUTS / 4);
    ck_assert_int_le(in_error, 2 + LAYOUTS / 10);
    free_results(single);
  }
}

/* Derivatives with respect to the cue, of a job by reference and of one with balls. */
TEST(derivatives_have_the_bits_of_balls) {
  enum { DIRECTIONS = 2, FINAL = BALLS * CAROM_STATE_NUMBERS * DIRECTIONS };
  static double final[2][LAYOUTS][FINAL], seed[CAROM_CUE_NUMBERS * DIRECTIONS];
  static int8_t status[2][LAYOUTS];
  make_layouts();
  for (int k = 0; k < CAROM_CUE_NUMBERS * DIRECTIONS; k++)
    seed[k] = 0.01 * (k + 1);
  const carom_tangent_seeds seeds = {.directions = DIRECTIONS, .cue = seed};
  const carom_shot_options options = {.threads = 3};
  for (int by_reference = 0; by_reference < 2; by_reference++) {
    results *r = make_results();
    carom_tangent tangents[LAYOUTS];
    for (int k = 0; k < LAYOUTS; k++)
      tangents[k] = (carom_tangent){.final = final[by_reference][k]};
    carom_shot_job job = {.table = &table,
                          .balls = by_reference ? NULL : balls,
                          .kinds = by_reference ? kinds : NULL,
                          .states = by_reference ? lies : NULL,
                          .cues = cues,
                          .count = BALLS,
                          .ball_stride = BALLS,
                          .cue_stride = 1,
                          .n = LAYOUTS,
                          .options = &options,
                          .shots = r->shot,
                          .status = r->status};
    carom_shoot_batch(&job);
    carom_tangent_job own = {
        .played = &job, .seeds = &seeds, .tangents = tangents, .status = status[by_reference]};
    ck_assert_int_eq(carom_shot_tangent_batch(&own), r->status[7]);
    /* rejected as in a batch */
    job.kinds = by_reference ? NULL : kinds;
    ck_assert_int_eq(carom_shot_tangent_batch(&own),
                     by_reference ? CAROM_ERROR_NULL : CAROM_ERROR_SHOT_OPTIONS);
    free_results(r);
  }
  int known = 0;
  for (int k = 0; k < LAYOUTS; k++)
    known += status[0][k] >= 0;
  ck_assert_int_gt(known, LAYOUTS / 2);
  ck_assert_mem_eq(status[0], status[1], sizeof status[0]);
  ck_assert_mem_eq(final[0], final[1], sizeof final[0]);
}

/* Half of it, or both ways at once: an error of the call, with nothing written. A bad kind costs
 * every shot, as each has it. */
TEST(balls_or_kinds_with_states) {
  make_layouts();
  carom_shot shot[2] = {{.count = 77}};
  int8_t status[2];
  carom_shot_job job = {.table = &table,
                        .cues = cues,
                        .count = BALLS,
                        .ball_stride = BALLS,
                        .n = 1,
                        .shots = shot,
                        .status = status};
  for (int k = 0; k < 8; k++) {
    const bool has_balls = k & 1, has_kinds = k & 2, has_states = k & 4;
    job.balls = has_balls ? balls : NULL;
    job.kinds = has_kinds ? kinds : NULL;
    job.states = has_states ? lies : NULL;
    status[0] = 99;
    shot[0].count = 77;
    const bool good = has_balls ? !has_kinds && !has_states : has_kinds && has_states;
    const carom_status of_bad = has_balls ? CAROM_ERROR_SHOT_OPTIONS : CAROM_ERROR_NULL;
    ck_assert_int_eq(carom_shoot_batch(&job), good ? CAROM_OK : of_bad);
    ck_assert_int_eq(status[0], good ? CAROM_OK : 99);
    ck_assert(good ? shot[0].count > 0 && shot[0].count != 77 : shot[0].count == 77);
  }
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_SHOT_OPTIONS), "kinds"));
  job.balls = NULL;
  job.n = 2;
  kinds[2].mu_roll = -1.0;
  ck_assert_int_eq(carom_shoot_batch(&job), CAROM_ERROR_MU_MOTION);
  ck_assert(status[0] == CAROM_ERROR_MU_MOTION && status[1] == CAROM_ERROR_MU_MOTION);
}

/* ---- Stopping and going on */

/* A shot, unbroken and in parts. */
typedef struct broken {
  carom_event events[ROOM];
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_shot_state state;
  carom_facts facts;
  carom_shot shot;
  carom_status status;
} broken;

static broken *make_broken(void) {
  broken *b = calloc(1, sizeof *b);
  b->shot = (carom_shot){.events = b->events, .room = ROOM, .final = b->final};
  b->shot.state = &b->state;
  b->shot.facts = &b->facts;
  return b;
}

/* All but the events. */
static void same_end(const broken *whole, const broken *parts, int count) {
  ck_assert_int_eq(whole->status, parts->status);
  ck_assert_int_eq(whole->shot.count, parts->shot.count);
  ck_assert_mem_eq(&whole->shot.time, &parts->shot.time, sizeof whole->shot.time);
  ck_assert_mem_eq(whole->final, parts->final, (size_t)count * sizeof *whole->final);
  ck_assert_mem_eq(&whole->facts, &parts->facts, sizeof whole->facts);
}

static void same_shot(const broken *whole, const broken *parts, int count) {
  same_end(whole, parts, count);
  ck_assert_mem_eq(whole->events, parts->events, sizeof whole->events);
}

/* The frame of a film at a time is that of the complete shot. */
static void same_frame(const random_shot *s, const broken *whole, const broken *parts, double time,
                       carom_frames *film) {
  carom_ball_state states[2][CAROM_BALLS_MOST];
  double turned[2][CAROM_BALLS_MOST][4];
  expect_ok(
      carom_shot_frames(s->ball, s->count, &parts->shot, &time, 1, film, states[0], turned[0]));
  expect_ok(carom_shot_at(s->ball, s->count, &whole->shot, time, states[1]));
  expect_ok(carom_shot_frames(s->ball, s->count, &whole->shot, &time, 1, NULL, NULL, turned[1]));
  ck_assert_mem_eq(states[0], states[1], (size_t)s->count * sizeof *states[0]);
  ck_assert_mem_eq(turned[0], turned[1], (size_t)s->count * sizeof *turned[0]);
}

/* A state that is loaded into its own shot, without the events so far, has all but a film;
 * with other events than those so far it is rejected, and nothing is written. */
static void load(const random_shot *s, const broken *whole, const broken *parts,
                 const carom_shot_options *options) {
  broken *b = make_broken();
  memcpy(&b->state, &parts->state, sizeof b->state);
  for (int64_t had = 0; had < parts->shot.count; had += parts->shot.count / 3 + 1) {
    memcpy(b->events, parts->events, (size_t)had * sizeof *b->events);
    ck_assert_int_eq(carom_shot_continue(&s->table, s->ball, s->count, options, &b->shot),
                     CAROM_ERROR_EVENTS_LOST);
    ck_assert(b->shot.count == 0 && b->shot.time == 0.0 && b->final[0].r[2] == 0.0);
    ck_assert_mem_eq(&b->state, &parts->state, sizeof b->state);
  }
  b->shot.events = NULL;
  b->shot.room = 0;
  b->status = carom_shot_continue(&s->table, s->ball, s->count, options, &b->shot);
  same_end(whole, b, s->count);
  carom_ball_state then[CAROM_BALLS_MOST];
  ck_assert_int_eq(carom_shot_at(s->ball, s->count, &b->shot, 0.5 * b->shot.time, then),
                   whole->shot.count > 0 ? CAROM_ERROR_EVENTS_LOST : CAROM_OK);
  free(b);
}

/* Where the shot stops next: by frames, after each event of each type or some, at any time, at a
 * bound, or any of these. */
static carom_shot_options next_stop(const carom_shot_options *options, int way,
                                    const carom_shot *shot, random_source *r) {
  carom_shot_options o = *options;
  switch (way) {
  case 0:
    o.time_most = (floor(shot->time * 60.0 + 1e-6) + 1.0) / 60.0;
    break;
  case 1:
    o.stop_at = 2 * (CAROM_STOP_AT(CAROM_EVENT_SPINNING_STATIONARY) - 1);
    break;
  case 2:
    o.stop_at = CAROM_STOP_AT_CONTACT | CAROM_STOP_AT(CAROM_EVENT_STRIKE) |
                CAROM_STOP_AT(CAROM_EVENT_RAIL) | CAROM_STOP_AT(CAROM_EVENT_SLATE);
    break;
  case 3:
    o.events_most = (int)shot->count + 1 + (int)random_between(r, 0.0, 9.0);
    break;
  case 4:
    o.first_of = 1;
    o.time_most = shot->time + 1.0;
    break;
  default:
    o.time_most = shot->time + random_between(r, 0.0, 1.0);
    o.stop_at = CAROM_STOP_AT(CAROM_EVENT_ROLLING_STATIONARY);
  }
  return o;
}

/* Forges the numbers of a state that follow from others, which are computed again. */
static void forge(carom_shot_state *state) {
  carom_sim sim;
  memcpy(&sim, state, sizeof sim);
  double *const columns[] = {sim.x,   sim.y,   sim.v_x,   sim.v_y,     sim.a_x,     sim.a_y,  sim.z,
                             sim.v_z, sim.a_z, sim.start, sim.own_end, sim.horizon, sim.first};
  for (int i = 0; i < sim.count; i++) {
    for (size_t k = 0; k < COUNT_OF(columns); k++)
      columns[k][i] = 0.25;
    sim.path[i].end = sim.path[i].a[0] = sim.rates[i].roll = -1.0;
  }
  sim.widest = 0.0;
  sim.unlike = !sim.unlike;
  sim.flying += 3;
  memcpy(state, &sim, sizeof sim);
  carom_state_seal(state);
}

/* However often a shot is stopped, and in whichever shot its state continues, it has the bits,
 * facts and film of the unbroken one; and where it stops, it has the states of that time. */
TEST(stopped_and_continued) {
  static random_shot s;
  static carom_frames film;
  random_source r = {test_seed()};
  long stops = 0;
  for (int n = 0; n < 40; n++) {
    random_shot_make(n % random_shot_kinds_in_space(), test_seed() + 7, (uint64_t)n, &s);
    if (n % 4 == 2 && n % random_shot_kinds_in_space() < random_shot_kinds())
      s.cue.theta = 30.0;
    for (int k = 0; k < s.count && n % 3 == 1; k++)
      s.ball[k].kind.drag = 0.0129;
    s.table.slope_x = n % 4 == 1 ? 2e-3 : 0.0;
    s.table.slope_y = n % 8 == 5 ? -1e-3 : 0.0;
    const carom_shot_options options = {
        .world = n % 4 == 3 ? CAROM_WORLD_POOLTOOL : CAROM_WORLD_CAROM,
        .cushion_model = n % 5 == 0 ? CAROM_SHOT_CUSHION_DEFAULT : CAROM_SHOT_CUSHION_HAN};
    broken *whole = make_broken();
    whole->status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &options, &whole->shot);
    if (whole->shot.count > ROOM || whole->status < 0) { /* by pooltool's rules, as a rule */
      free(whole);
      continue;
    }
    for (int way = 0; way < 6; way++) {
      broken *parts = make_broken();
      carom_shot_options o = next_stop(&options, way, &parts->shot, &r);
      parts->status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &o, &parts->shot);
      while (parts->status != CAROM_OK) {
        carom_status expected = CAROM_STOPPED_AT_EVENT;
        if (way == 3)
          expected = CAROM_ERROR_TOO_MANY_EVENTS;
        else if (o.time_most > 0.0 && parts->shot.time >= o.time_most)
          expected = CAROM_STOPPED_AT_TIME;
        ck_assert_int_eq(parts->status, expected);
        if (parts->status == CAROM_STOPPED_AT_TIME) {
          ck_assert_double_eq(parts->shot.time, o.time_most);
          /* as the unbroken shot was then, and nothing is known of later */
          carom_ball_state then[CAROM_BALLS_MOST];
          expect_ok(carom_shot_at(s.ball, s.count, &whole->shot, o.time_most, then));
          ck_assert_mem_eq(then, parts->final, (size_t)s.count * sizeof *then);
          ck_assert_int_eq(carom_shot_at(s.ball, s.count, &parts->shot, o.time_most + 1e-9, then),
                           CAROM_ERROR_TIME);
        } else if (parts->status == CAROM_STOPPED_AT_EVENT) {
          const carom_event *last = &parts->events[parts->shot.count - 1];
          ck_assert_double_eq(parts->shot.time, last->time);
          bool contact = false; /* of the cue ball: the last event, or one of the cluster that
                                   ends with it */
          for (int k = 0; last->type == CAROM_EVENT_BALL_BALL &&
                          k <= (last->cluster > 0 ? last->cluster - 1 : 0);
               k++)
            contact |= last[-k].a == s.cue.ball || last[-k].b == s.cue.ball;
          ck_assert((o.stop_at & CAROM_STOP_AT(last->type)) ||
                    ((o.stop_at & CAROM_STOP_AT_CONTACT || o.first_of != 0) && contact));
          for (int k = 0; k < s.count; k++)
            if (k == last->a)
              ck_assert_mem_eq(&parts->final[k], &last->after[0], sizeof *parts->final);
        }
        if (parts->shot.time > 0.0) /* of simultaneous events some may be due */
          same_frame(&s, whole, parts, random_between(&r, 0.0, parts->shot.time), &film);
        o = next_stop(&options, way, &parts->shot, &r);
        if (stops % 3 == 0)
          forge(&parts->state);
        if (stops % 8 == 0)
          load(&s, whole, parts, &options);
        if (stops % 4 == 1) { /* as another process, with what was kept */
          broken *other = make_broken();
          memcpy(other->events, parts->events, (size_t)parts->shot.count * sizeof *parts->events);
          memcpy(&other->state, &parts->state, sizeof other->state);
          free(parts);
          parts = other;
        } else if (stops % 4 == 2) { /* what the shot says of itself does not count */
          parts->shot.count = stops % 7;
          parts->shot.time = 1e3;
          memset(&parts->facts, 0x55, sizeof parts->facts);
        }
        parts->status = carom_shot_continue(&s.table, s.ball, s.count, &o, &parts->shot);
        stops++;
      }
      same_shot(whole, parts, s.count);
      /* at rest it stays as it is */
      parts->status = carom_shot_continue(&s.table, s.ball, s.count, &options, &parts->shot);
      same_shot(whole, parts, s.count);
      free(parts);
    }
    free(whole);
  }
  ck_assert_int_gt(stops, 2000);
}

/* A shot that is stopped at every event of one type, or at every contact of the cue ball, has the
 * bits of the unbroken one: random shots of all kinds, whose cues follow through and touch
 * again. */
TEST(stopped_at_each_type_of_event) {
  static random_shot s;
  long stops = 0, touches = 0;
  const int kinds_of_shots = random_shot_kinds_in_space();
  for (int n = 0; n < 60 * kinds_of_shots; n++) {
    random_shot_make(n % kinds_of_shots, test_seed(), (uint64_t)(n / kinds_of_shots), &s);
    s.cue.follow = 0.03;
    s.cue.tip_time = 0.0; /* the default */
    const carom_shot_options options = {0};
    broken *whole = make_broken();
    whole->status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &options, &whole->shot);
    const bool kept = whole->status == CAROM_OK && whole->shot.count <= ROOM;
    uint64_t types = CAROM_STOP_AT_CONTACT;
    long strikes = 0;
    for (int64_t k = 0; kept && k < whole->shot.count; k++) {
      types |= CAROM_STOP_AT(whole->events[k].type);
      strikes += whole->events[k].type == CAROM_EVENT_STRIKE;
    }
    touches += strikes > 1;
    const bool tried = kept && (strikes > 1 || n < 6 * kinds_of_shots);
    for (int type = 0; tried && type <= CAROM_EVENT_LEFT_TABLE; type++) {
      if (!(types >> type & 1))
        continue;
      const carom_shot_options stop = {.stop_at = CAROM_STOP_AT(type)};
      broken *parts = make_broken();
      parts->status = carom_shoot(&s.table, s.ball, s.count, &s.cue, &stop, &parts->shot);
      while (parts->status == CAROM_STOPPED_AT_EVENT) {
        parts->status = carom_shot_continue(&s.table, s.ball, s.count, &stop, &parts->shot);
        stops++;
      }
      same_shot(whole, parts, s.count);
      free(parts);
    }
    free(whole);
  }
  ck_assert_int_gt(stops, 2000);
  ck_assert_int_gt(touches, 10);
}

/* A ball that is stopped right before any cushion, jaw or pocket continues to it. */
TEST(stopped_before_every_part) {
  static carom_event events[2][ROOM];
  static carom_shot_state state;
  uint64_t seen[CAROM_EVENT_POCKET + 1] = {0};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (double phi = 0.0; phi < 360.0; phi += 0.1) {
    carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.phi = phi;
    expect_ok(carom_place_ball(&table, &ball, 1, 0, 0.6, 1.2, NULL));
    carom_shot whole = {.events = events[0], .room = ROOM},
               parts = {.events = events[1], .room = ROOM, .state = &state};
    expect_ok(carom_shoot(&table, &ball, 1, &cue, NULL, &whole));
    const carom_event *met = events[0];
    while (met->type < CAROM_EVENT_RAIL || met->type > CAROM_EVENT_POCKET)
      ck_assert_int_lt(++met - events[0], whole.count);
    seen[met->type] |= UINT64_C(1) << met->b;
    carom_shot_options options = {.time_most = met->time - 1e-6};
    ck_assert_int_eq(carom_shoot(&table, &ball, 1, &cue, &options, &parts), CAROM_STOPPED_AT_TIME);
    options.time_most = 0.0;
    expect_ok(carom_shot_continue(&table, &ball, 1, &options, &parts));
    ck_assert_int_eq(parts.count, whole.count);
    ck_assert_mem_eq(events[1], events[0], (size_t)whole.count * sizeof *events[0]);
  }
  ck_assert_uint_eq(seen[CAROM_EVENT_RAIL] & 0x3f, 0x3f); /* the cushions, without facings */
  ck_assert_uint_eq(seen[CAROM_EVENT_JAW], 0xfff);
  ck_assert_uint_eq(seen[CAROM_EVENT_POCKET], 0x3f);
}

/* A state without any, or with a bit changed, is rejected, and nothing is written;
 * unit/refusals.txt has those of other shots. */
TEST(bad_states) {
  make_breaks();
  broken *b = make_broken();
  carom_shot_options options = {.time_most = 0.2};
  ck_assert_int_eq(go_on(&options, &b->shot), CAROM_ERROR_STATE);
  b->status = shoot(&cues[0], &options, &b->shot);
  ck_assert_int_eq(b->status, CAROM_STOPPED_AT_TIME);
  broken *before = malloc(sizeof *before);
  memcpy(before, b, sizeof *before);
  options.time_most = 0.3;
  b->shot.state = NULL;
  ck_assert_int_eq(go_on(&options, &b->shot), CAROM_ERROR_NULL);
  b->shot.state = &b->state;
  for (size_t bit = 0; bit < 8 * sizeof b->state; bit += bit < 4096 ? 1 : 61) {
    b->state.opaque[bit / 64] ^= UINT64_C(1) << bit % 64;
    ck_assert_int_eq(go_on(&options, &b->shot), CAROM_ERROR_STATE);
    b->state.opaque[bit / 64] ^= UINT64_C(1) << bit % 64;
  }
  ck_assert_mem_eq(b, before, sizeof *b);
  ck_assert_int_eq(go_on(&options, &b->shot), CAROM_STOPPED_AT_TIME);
  free(before);
  free(b);
}

/* What lay on the stack before. */
__attribute__((noinline)) static void soil_stack(int with) {
  volatile unsigned char stack[60000];
  for (size_t k = 0; k < sizeof stack; k++)
    stack[k] = (unsigned char)with;
}

/* A state has the same bytes whatever was on the stack and in its memory, in a batch and alone:
 * nothing else of the process gets into what a game saves. */
TEST(bytes_of_states) {
  enum { TIMES = 4, FEW = 12 };
  static carom_shot_state state[TIMES];
  static carom_event events[ROOM];
  make_breaks();
  for (int n = 0; n < FEW; n++) {
    carom_shot_ball *layout = balls + 16 * n;
    const int count = n % 3 == 0 ? 16 : 2 + n;
    cues[n].a = 0.2;
    cues[n].theta = n % 2 == 0 ? 0.0 : 20.0;
    for (int k = 0; k < count && n % 4 == 3; k++)
      layout[k].kind.drag = 0.01;
    carom_shot_options options = {.time_most = 0.1 * (1 + n % 5),
                                  .stop_at = n % 3 == 1 ? CAROM_STOP_AT_CONTACT : 0,
                                  .world = n % 4 == 2 ? CAROM_WORLD_POOLTOOL : CAROM_WORLD_CAROM};
    for (int k = 0; k < TIMES; k++) {
      memset(&state[k], 0x11 * k, sizeof state[k]);
      carom_shot shot = {.events = events, .room = ROOM, .state = &state[k]};
      soil_stack(0x31 * k + 1);
      if (k % 2 == 0) {
        carom_shoot(&table, layout, count, &cues[n], &options, &shot);
      } else {
        const carom_shot_job job = {.table = &table,
                                    .balls = layout,
                                    .cues = &cues[n],
                                    .count = count,
                                    .n = 1,
                                    .options = &options,
                                    .shots = &shot};
        carom_shoot_batch(&job);
      }
      ck_assert_msg(memcmp(&state[k], &state[0], sizeof *state) == 0, "shot %d, state %d", n, k);
    }
    ck_assert_uint_ne(state[0].opaque[0], 0);
  }
}

/* How the cue ball came to a ball at r, after it met a set of rails. */
static int approach_of(uint32_t rails, const double *r) {
  if (rails == 0)
    return CAROM_APPROACH_DIRECT;
  for (int k = 0; k < table.rails; k++) {
    const double *p = table.rail[k].p, *q = table.rail[k].q, way = distance(p, q);
    const double along = ((r[0] - p[0]) * (q[0] - p[0]) + (r[1] - p[1]) * (q[1] - p[1])) / way;
    const double gap = sqrt(fmax(0.0, pow(distance(r, p), 2.0) - along * along)) - r[2];
    if (rails == 1U << k && gap < 2.0 * r[2])
      return CAROM_APPROACH_RAIL_FIRST;
  }
  return CAROM_APPROACH_KICK;
}

/* What the cue ball meets in a contact: the order of its balls, those of the first instant, and
 * where it was then. */
static void meet(carom_facts *f, const carom_event *e, int cue) {
  const int side = e->a == cue ? 0 : 1, other = side == 0 ? e->b : e->a;
  int place = 0;
  while (f->order[place] >= 0 && f->order[place] != other)
    place++;
  f->order[place] = other;
  if (f->first[0] == -1) {
    memcpy(f->first_place, e->before[side].r, sizeof f->first_place);
    f->approach = approach_of(f->rails[cue], e->before[1 - side].r);
  }
  if (f->first[0] == -1 || e->time <= f->first_time[0] + CAROM_RULES_INSTANT)
    f->first_set |= 1U << other;
}

static void meet_cushion(carom_facts *f, const carom_event *e) {
  f->cushions[e->a]++;
  if (e->type == CAROM_EVENT_RAIL && !carom_is_cut(&table, e->b))
    f->rails[e->a] |= 1U << e->b;
  f->cushions_after += f->first[0] != -1;
}

static void fall(carom_facts *f, const carom_event *e) {
  f->down |= 1U << e->a;
  f->pocket[e->a] = e->b;
  f->pocket_time[e->a] = e->time;
  for (int rail = 0; rail < table.rails; rail++)
    if ((f->rails[e->a] >> rail & 1) && !carom_is_beside(&table, rail, e->b))
      f->banked |= 1U << e->a;
}

/* The facts of a shot by a walk over its events. */
static carom_facts facts_of(const carom_event *events, int64_t count, int cue) {
  carom_facts f = {.first = {-1, -1}, .first_time = {INFINITY, INFINITY}, .second_time = INFINITY};
  for (int i = 0; i < CAROM_BALLS_MOST; i++) {
    f.pocket[i] = -1;
    f.pocket_time[i] = INFINITY;
    f.order[i] = -1;
  }
  for (int64_t k = 0; k < count; k++) {
    const carom_event *e = &events[k];
    const int other = e->a == cue ? e->b : e->a;
    f.touches += e->type == CAROM_EVENT_STRIKE;
    if (e->type == CAROM_EVENT_STRIKE && f.touches == 2) {
      f.second_time = e->time;
      memcpy(f.second_place, e->before[0].r, sizeof f.second_place);
    }
    if (e->type == CAROM_EVENT_STRIKE || e->type == CAROM_EVENT_BALL_BALL)
      f.moved |= 1U << e->a;
    if (e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW) {
      meet_cushion(&f, e);
    } else if (e->type == CAROM_EVENT_POCKET) {
      fall(&f, e);
    } else if (e->type == CAROM_EVENT_LEFT_TABLE) {
      f.off |= 1U << e->a;
    } else if (e->type == CAROM_EVENT_BALL_BALL) {
      f.moved |= 1U << e->b;
      if (e->a == cue || e->b == cue)
        meet(&f, e, cue);
      const int n = f.first[0] == -1 ? 0 : 1;
      if ((e->a == cue || e->b == cue) && f.first[1] == -1 && f.first[0] != other) {
        f.first[n] = other;
        f.first_time[n] = e->time;
        f.cushions_before[n] = f.cushions[cue];
      }
    }
  }
  return f;
}

/* The balls of a layout that the cue ball flew over before it met one: somewhere between two of its
 * events it was next to each of them, and nearer to it than both radii. */
static uint32_t jumped_over(const carom_event *events, int64_t count, int cue,
                            const carom_shot_ball *lie, int on_table) {
  uint32_t set = 0;
  const carom_ball_state *from = NULL;
  for (int64_t k = 0; k < count; k++) {
    const carom_event *e = &events[k];
    const bool two = e->type == CAROM_EVENT_BALL_BALL;
    if (e->a != cue && !(two && e->b == cue))
      continue;
    const int side = e->a == cue ? 0 : 1;
    const double *to = e->before[side].r;
    for (int i = 0; from != NULL && from->label == CAROM_BALL_AIRBORNE && i < on_table; i++) {
      const double *at = lie[i].state.r, both = lie[i].kind.radius + lie[cue].kind.radius;
      const double way = distance(to, from->r);
      const double x = (to[0] - from->r[0]) / way, y = (to[1] - from->r[1]) / way;
      const double along = (at[0] - from->r[0]) * x + (at[1] - from->r[1]) * y;
      const double apart = hypot(from->r[0] + along * x - at[0], from->r[1] + along * y - at[1]);
      if (i != cue && along > 0.0 && along < way && apart < both)
        set |= 1U << i;
    }
    if (two)
      return set;
    from = &e->after[side];
  }
  return set;
}

/* Notes that ball i was at the height y of the table. */
static void was_at(carom_facts *f, int i, double y, const carom_shot_ball *lie) {
  const double radius = lie[i].kind.radius;
  if (y + radius < 0.5 * table.length)
    f->past_middle |= 1U << i;
  if (y - radius > 0.5 * table.length)
    f->beyond_middle |= 1U << i;
  if (y - radius <= 0.25 * table.length)
    f->at_head |= 1U << i;
}

/* Where the balls of a layout have been, at their events up to the last one of each, and at
 * rest. */
static void add_places(carom_facts *f, const carom_event *events, int64_t count,
                       const carom_shot_ball *lie) {
  double y[CAROM_BALLS_MOST];
  for (int i = 0; i < 16; i++)
    y[i] = lie[i].state.r[1];
  for (int64_t k = 0; k < count; k++) {
    const carom_event *e = &events[k];
    was_at(f, e->a, y[e->a], lie);
    y[e->a] = e->before[0].r[1];
    if (e->type == CAROM_EVENT_ROLLING_STATIONARY)
      was_at(f, e->a, y[e->a], lie);
    if (e->type == CAROM_EVENT_BALL_BALL) {
      was_at(f, e->b, y[e->b], lie);
      y[e->b] = e->before[1].r[1];
    }
  }
}

/* The balls that a cue ball pushed meets in its push. */
static uint32_t met_in_push(const carom_event *events, int cue) {
  uint32_t met = 0;
  for (int k = 1; k < events[0].cluster; k++)
    if (events[k].a == cue || events[k].b == cue)
      met |= 1U << (events[k].a == cue ? events[k].b : events[k].a);
  return met;
}

/* Facts are those of the events, whichever ball is struck, with a state or without; those of a
 * shot that is rejected say that nothing happened. */
TEST(facts_of_shots) {
  static carom_event events[10 * ROOM];
  static carom_shot_state state;
  make_breaks();
  int down = 0, off = 0, second = 0, pushes = 0, jumps = 0, banks = 0, approaches = 0;
  for (int k = 0; k < 60; k++) {
    carom_cue cue = cues[k == 4 ? 5 : k];
    carom_facts facts;
    memset(&facts, 0x55, sizeof facts);
    cue.ball = k % 3 == 2 ? 7 : 0;
    cue.phi = 6.0 * k;
    cue.theta = k % 4 == 3 ? 35.0 : 0.0;
    carom_shot shot = {.events = events, .room = 10 * ROOM, .facts = &facts};
    shot.state = k % 2 == 0 ? &state : NULL;
    const carom_status whole = carom_shoot(&table, balls + 16 * k, 16, &cue, NULL, &shot);
    ck_assert_int_ge(whole, CAROM_OK);
    carom_facts found = facts_of(events, shot.count, (int)cue.ball);
    found.second_speed = facts.second_speed;
    if (events[0].cluster > 0) { /* what it meets after the tip has left it is not in the set */
      ck_assert_uint_eq(facts.pushed & ~met_in_push(events, (int)cue.ball), 0);
      ck_assert_int_ge(facts.touches, 1);
      found.pushed = facts.pushed;
      found.touches = facts.touches;
      found.second_time = facts.second_time;
      memcpy(found.second_place, facts.second_place, sizeof found.second_place);
      pushes += facts.pushed != 0;
    }

    /* the balls that touch at the strike, and the box of the way to the first contact */
    const carom_shot_ball *lie = balls + 16 * k;
    const double reach = 2.0 * lie[0].kind.radius + CAROM_RULES_TOUCH;
    for (int i = 0; i < 16; i++) {
      const double *a = lie[i].state.r, *b = lie[cue.ball].state.r;
      if (i != cue.ball && distance(a, b) < reach)
        found.frozen |= 1U << i;
    }
    add_places(&found, events, shot.count, lie);
    found.jumped = jumped_over(events, shot.count, (int)cue.ball, lie, 16);
    jumps += found.jumped != 0;
    for (int axis = 0; axis < 2; axis++) {
      const double from = lie[cue.ball].state.r[axis], to = facts.first_place[axis];
      ck_assert_double_le(facts.first_low[axis], fmin(from, facts.first[0] >= 0 ? to : from));
      ck_assert_double_ge(facts.first_high[axis], fmax(from, facts.first[0] >= 0 ? to : from));
    }
    memcpy(found.first_low, facts.first_low, sizeof found.first_low);
    memcpy(found.first_high, facts.first_high, sizeof found.first_high);
    ck_assert_mem_eq(&found, &facts, sizeof facts);
    down += facts.down != 0;
    off += facts.off != 0;
    second += facts.first[1] >= 0;
    banks += facts.banked != 0;
    approaches |= 1 << facts.approach;
  }
  printf("%d shots pot, %d lose a ball over the cushions, in %d the cue ball meets a second ball\n",
         down, off, second);
  ck_assert(down > 5 && second > 5 && pushes > 5 && jumps > 0 && banks > 0);
  ck_assert_int_eq(approaches & ~(1 << CAROM_APPROACH_RAIL_FIRST), 5); /* ways.c has that */
  carom_facts facts;
  const carom_facts nothing = facts_of(events, 0, 0);
  ck_assert_int_lt(shoot(&cues[4], NULL, &(carom_shot){.facts = &facts}), 0);
  ck_assert_mem_eq(&nothing, &facts, sizeof facts);
}

/* A shot stops at the first contact of the cue ball, or only if the other ball is not in the set,
 * and else is as without the option; it continues as if it had not stopped. */
TEST(stops_at_the_first_contact) {
  static carom_shot_state state;
  static const carom_shot_options rows[] = {{.first_of = UINT64_C(0x0a0a)}, /* balls 1, 3, 9, 11 */
                                            {.stop_at = CAROM_STOP_AT_CONTACT}};
  make_breaks();
  int stopped = 0, played = 0;
  for (int k = 10; k < 120; k++) {
    const carom_shot_options *options = &rows[k % 2];
    carom_ball_state final[2][16];
    carom_facts facts, part;
    carom_cue cue = cues[k / 2];
    cue.phi = 80.0 + 0.3 * (k / 2);
    carom_shot whole = {.facts = &facts, .final = final[0]};
    expect_ok(shoot(&cue, NULL, &whole));
    carom_shot shot = {.facts = &part, .final = final[1], .state = &state};
    carom_status status = shoot(&cue, options, &shot);
    const bool stops = facts.first[0] >= 0 && !(options->first_of >> facts.first[0] & 1);
    ck_assert_int_eq(status, stops ? CAROM_STOPPED_AT_EVENT : CAROM_OK);
    if (stops) {
      ck_assert(part.first[0] == facts.first[0] && part.first_time[0] == facts.first_time[0] &&
                shot.time == part.first_time[0]);
      status = go_on(NULL, &shot);
    }
    expect_ok(status);
    ck_assert(memcmp(&part, &facts, sizeof facts) == 0 &&
              memcmp(final[0], final[1], sizeof final[0]) == 0);
    *(stops ? &stopped : &played) += 1;
  }
  ck_assert(stopped > 60 && played > 10);
}

/* |u| of the surfaces of a ball that moves with v and w, as it meets what is along n. */
static double slip_of(const carom_ball_state *s, double R, double n_x, double n_y, double n_z) {
  const double *v = s->v, *w = s->w, v_n = v[0] * n_x + v[1] * n_y + v[2] * n_z;
  const double u_x = v[0] - v_n * n_x + R * (w[1] * n_z - w[2] * n_y),
               u_y = v[1] - v_n * n_y + R * (w[2] * n_x - w[0] * n_z),
               u_z = v[2] - v_n * n_z + R * (w[0] * n_y - w[1] * n_x);
  return sqrt(u_x * u_x + u_y * u_y + u_z * u_z);
}

/* Slips of the events of jumps and breaks: on the slate and at long and short rails by their
 * known normals, of a ball that meets one at rest by the line of centres. */
TEST(slips) {
  static carom_event events[ROOM];
  make_breaks();
  const double R = balls[0].kind.radius;
  int slate = 0, rail = 0, two = 0;
  for (int k = 0; k < 20; k++) {
    carom_cue cue = cues[0];
    cue.speed = 7.0;
    cue.theta = k % 2 == 0 ? 12.0 : 0.0;
    cue.phi = 90.0 + k;
    cue.a = 0.3;
    carom_shot shot = {.events = events, .room = ROOM};
    expect_ok(shoot(&cue, NULL, &shot));
    for (int i = 0; i < shot.count; i++) {
      const carom_event *e = &events[i];
      const carom_ball_state *s = &e->before[0], *o = &e->before[1];
      const double slip = carom_event_slip(&table, balls, 16, e);
      ck_assert(slip >= 0.0 && slip < 100.0);
      if (e->impulse == 0.0 || e->type == CAROM_EVENT_STRIKE)
        ck_assert(slip == 0.0 || e->cluster != 0);
      if (e->type == CAROM_EVENT_SLATE) {
        ck_assert_double_eq_tol(slip, slip_of(s, R, 0.0, 0.0, -1.0), 1e-12);
        slate++;
      }
      if (e->type == CAROM_EVENT_RAIL && s->v[2] == 0.0 && s->r[2] == R) {
        const carom_rail *of = &table.rail[e->b];
        const bool along_x = of->p[1] == of->q[1], along_y = of->p[0] == of->q[0];
        if (along_x || along_y) {
          /* into the rail, as the ball moves */
          ck_assert_double_eq_tol(slip,
                                  slip_of(s, R, along_y ? copysign(1.0, s->v[0]) : 0.0,
                                          along_x ? copysign(1.0, s->v[1]) : 0.0, 0.0),
                                  1e-12);
          rail++;
        }
      }
      if (e->type == CAROM_EVENT_BALL_BALL && o->label == CAROM_BALL_STATIONARY) {
        double n[3], size = 0.0;
        for (int m = 0; m < 3; m++) {
          n[m] = o->r[m] - s->r[m];
          size += n[m] * n[m];
        }
        size = sqrt(size);
        ck_assert_double_eq_tol(slip, slip_of(s, R, n[0] / size, n[1] / size, n[2] / size), 1e-9);
        two++;
      }
    }
  }
  ck_assert(slate > 20 && rail > 50 && two > 50);
  carom_event bad = {.type = CAROM_EVENT_BALL_BALL, .a = 0, .b = 1};
  ck_assert_double_nan(carom_event_slip(NULL, balls, 16, &bad));
  bad.b = 16;
  ck_assert_double_nan(carom_event_slip(&table, balls, 16, &bad));
  bad.a = -1;
  ck_assert_double_nan(carom_event_slip(&table, balls, 16, &bad));
}

/* On every instruction set a shot has the same bits. With options.fast that does not hold of the
 * exact limit of a cushion; then the shot ends well, and the first events, which nothing has
 * amplified yet, are the same except for rounding. */
static void expect_same_by_all_sets(carom_shot_cushion cushion, bool same_if_fast) {
  static carom_event events[ROOM], others[ROOM];
  const carom_shot_options fast = {.cushion_model = cushion, .fast = 1};
  carom_shot_options options = {.cushion_model = cushion};
  carom_shot plain = {.events = events, .room = ROOM};
  expect_ok(shoot(&cues[0], &options, &plain));
  FOR_EACH_ISA(isa) {
    carom_shot shot = {.events = others, .room = ROOM};
    expect_ok(shoot(&cues[0], &fast, &shot));
    for (int k = 0; k < 8; k++) {
      ck_assert_int_eq(others[k].type, events[k].type);
      ck_assert_double_eq_tol(others[k].time, events[k].time, 1e-6);
    }
    const bool same = shot.count == plain.count &&
                      memcmp(events, others, (size_t)plain.count * sizeof *events) == 0;
    ck_assert_int_eq(same, same_if_fast || isa < CAROM_ISA_AVX2);
    /* without options.fast the shot has the bits of plain, in parts too, whatever limits the
     * process */
    static carom_shot_state state;
    options.time_most = 0.7;
    shot.state = &state;
    memset(others, 0, sizeof others);
    ck_assert_int_eq(shoot(&cues[0], &options, &shot), CAROM_STOPPED_AT_TIME);
    options.time_most = 0.0;
    expect_ok(go_on(&options, &shot));
    ck_assert_int_eq(shot.count, plain.count);
    ck_assert_mem_eq(events, others, (size_t)plain.count * sizeof *events);
  }
  carom_isa_limit(CAROM_ISA_ANY);
}

TEST(instruction_sets) {
  make_breaks();
  cues[0].speed = 8.0; /* of a weak break all bits can be the same */
  expect_same_by_all_sets(CAROM_SHOT_CUSHION_HAN, true);
  expect_same_by_all_sets(CAROM_SHOT_CUSHION_MATHAVAN, false);
}
