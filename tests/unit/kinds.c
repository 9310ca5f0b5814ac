/* Kinds and states by reference in a batch: the bits of a batch with whole balls, its kept states
 * and its derivatives; and what is refused. */
#include "carom_tangent.h"
#include "support.h"

enum { SHOTS = 60, BALLS = 6, ROOM = 400 };

/* The same layouts, whole and by reference. */
static carom_table table;
static carom_ball_kind kinds[BALLS];
static carom_ball_state states[SHOTS][BALLS];
static carom_shot_ball balls[SHOTS][BALLS];
static carom_cue cues[SHOTS];

/* What a batch gives. */
typedef struct played {
  carom_shot shot[SHOTS];
  carom_event event[SHOTS][ROOM];
  carom_ball_state final[SHOTS][BALLS];
  carom_facts facts[SHOTS];
  carom_shot_state state[SHOTS];
  int8_t status[SHOTS];
} played;

static played one, other; /* of a batch with balls, and by reference */

static void empty(played *to) {
  memset(to, 0, sizeof *to);
  for (int k = 0; k < SHOTS; k++)
    to->shot[k] = (carom_shot){.events = to->event[k],
                               .room = ROOM,
                               .final = to->final[k],
                               .facts = &to->facts[k],
                               .state = &to->state[k]};
}

/* Random places of balls whose kinds differ; layout 7 has balls that overlap, and the cue of shot
 * 11 is bad. */
static void set_up(void) {
  random_source random = {test_seed()};
  expect_ok(carom_table_make(CAROM_TABLE_POOL_9FT, &table));
  for (int i = 0; i < BALLS; i++) {
    kinds[i] = carom_ball_kind_of(CAROM_GAME_POOL);
    kinds[i].mu_slide = 0.15 + 0.02 * i;
    kinds[i].mu_roll = 0.008 + 0.001 * i;
    kinds[i].restitution = 0.9 + 0.01 * i;
    kinds[i].restitution_cushion = 0.8 + 0.02 * i;
  }
  for (int k = 0; k < SHOTS; k++) {
    memset(balls[k], 0, sizeof balls[k]);
    for (int i = 0; i < BALLS; i++) {
      balls[k][i].kind = kinds[i];
      balls[k][i].state.label = CAROM_BALL_POCKETED;
    }
    for (int i = 0; i < BALLS; i++) {
      while (carom_place_ball(&table, balls[k], BALLS, i, random_between(&random, 0.0, table.width),
                              random_between(&random, 0.0, table.length), NULL) != CAROM_OK) {
      }
    }
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = random_between(&random, 1.0, 4.0);
    cues[k].phi = random_between(&random, 0.0, 360.0);
  }
  memcpy(balls[7][3].state.r, balls[7][2].state.r, sizeof balls[7][3].state.r);
  cues[11].phi = NAN;
  for (int k = 0; k < SHOTS; k++)
    for (int i = 0; i < BALLS; i++)
      states[k][i] = balls[k][i].state;
}

static carom_shot_job job_of(const carom_shot_options *options, played *to, bool by_reference,
                             size_t stride) {
  carom_shot_job job = {.table = &table,
                        .cues = cues,
                        .count = BALLS,
                        .ball_stride = stride,
                        .cue_stride = 1,
                        .n = SHOTS,
                        .options = options,
                        .shots = to->shot,
                        .status = to->status};
  if (by_reference) {
    job.kinds = kinds;
    job.states = states[0];
  } else {
    job.balls = balls[0];
  }
  return job;
}

/* Both ways are the same in every bit. */
static void compare(const played *a, const played *b) {
  ck_assert_mem_eq(a->status, b->status, sizeof a->status);
  ck_assert_mem_eq(a->facts, b->facts, sizeof a->facts);
  ck_assert_mem_eq(a->final, b->final, sizeof a->final);
  ck_assert_mem_eq(a->state, b->state, sizeof a->state);
  ck_assert_mem_eq(a->event, b->event, sizeof a->event);
}

/* Layouts of their own, or the first one for all; to rest, or stopped, with states to go on. */
static void same_bits(carom_world world, size_t stride, double time_most) {
  empty(&one);
  const carom_shot_options one_thread = {.world = world, .time_most = time_most};
  const carom_shot_job expected = job_of(&one_thread, &one, false, stride);
  const carom_status status = carom_shoot_batch(&expected);
  ck_assert_int_lt(status, 0);
  ck_assert_int_eq(one.status[7], stride > 0 ? CAROM_ERROR_OVERLAP : CAROM_OK);
  ck_assert_int_eq(one.status[11], CAROM_ERROR_CUE_PHI);
  int contacts = 0, in_error = 0;
  for (int k = 0; k < SHOTS; k++) {
    contacts += one.facts[k].first[0] >= 0;
    in_error += one.status[k] < 0;
  }
  ck_assert(time_most > 0.0 || contacts > SHOTS / 4);
  ck_assert_int_le(in_error, 2 + SHOTS / 10);
  const int threads[] = {1, 3};
  for (int k = 0; k < 2; k++) {
    empty(&other);
    carom_shot_options options = one_thread;
    options.threads = threads[k];
    const carom_shot_job job = job_of(&options, &other, true, stride);
    ck_assert_int_eq(carom_shoot_batch(&job), status);
    compare(&one, &other);
  }
}

TEST(kinds_and_states_have_the_bits_of_balls) {
  set_up();
  for (int world = CAROM_WORLD_CAROM; world <= CAROM_WORLD_POOLTOOL; world++) {
    same_bits((carom_world)world, BALLS, 0.0);
    same_bits((carom_world)world, BALLS, 1.5);
    same_bits((carom_world)world, 0, 0.0);
  }
}

/* Derivatives with respect to the cue, of a job by reference and of one with balls. */
TEST(derivatives_have_the_bits_of_balls) {
  enum { DIRECTIONS = 2, FINAL = BALLS * CAROM_STATE_NUMBERS * DIRECTIONS };
  static double final[2][SHOTS][FINAL], seed[CAROM_CUE_NUMBERS * DIRECTIONS];
  static int8_t status[2][SHOTS];
  set_up();
  for (int k = 0; k < CAROM_CUE_NUMBERS * DIRECTIONS; k++)
    seed[k] = 0.01 * (k + 1);
  const carom_tangent_seeds seeds = {.directions = DIRECTIONS, .cue = seed};
  const carom_shot_options options = {.threads = 3};
  for (int by_reference = 0; by_reference < 2; by_reference++) {
    empty(&one);
    carom_tangent tangents[SHOTS];
    for (int k = 0; k < SHOTS; k++)
      tangents[k] = (carom_tangent){.final = final[by_reference][k]};
    carom_shot_job job = job_of(&options, &one, by_reference == 1, BALLS);
    carom_shoot_batch(&job);
    carom_tangent_job own = {
        .played = &job, .seeds = &seeds, .tangents = tangents, .status = status[by_reference]};
    ck_assert_int_eq(carom_shot_tangent_batch(&own), one.status[7]);
    /* refused as in a batch */
    job.kinds = by_reference ? NULL : kinds;
    ck_assert_int_eq(carom_shot_tangent_batch(&own),
                     by_reference ? CAROM_ERROR_NULL : CAROM_ERROR_SHOT_OPTIONS);
  }
  int known = 0;
  for (int k = 0; k < SHOTS; k++)
    known += status[0][k] >= 0;
  ck_assert_int_gt(known, SHOTS / 2);
  ck_assert_mem_eq(status[0], status[1], sizeof status[0]);
  ck_assert_mem_eq(final[0], final[1], sizeof final[0]);
}

/* Half of it, or both ways at once: an error of the call, with nothing written. */
TEST(balls_or_kinds_with_states) {
  set_up();
  const carom_ball_kind *const kind[] = {NULL, kinds};
  const carom_ball_state *const state[] = {NULL, states[0]};
  const carom_shot_ball *const ball[] = {NULL, balls[0]};
  empty(&one);
  for (int k = 0; k < 8; k++) {
    carom_shot_job job = job_of(NULL, &one, false, BALLS);
    const bool has_balls = k & 1, has_kinds = k & 2, has_states = k & 4;
    job.balls = ball[has_balls];
    job.kinds = kind[has_kinds];
    job.states = state[has_states];
    job.n = 1;
    one.status[0] = 99;
    one.shot[0].count = 77;
    const bool good = has_balls ? !has_kinds && !has_states : has_kinds && has_states;
    const carom_status of_bad = has_balls ? CAROM_ERROR_SHOT_OPTIONS : CAROM_ERROR_NULL;
    const carom_status expected = good ? CAROM_OK : of_bad;
    ck_assert_int_eq(carom_shoot_batch(&job), expected);
    ck_assert_int_eq(one.status[0], good ? CAROM_OK : 99);
    ck_assert(good ? one.shot[0].count > 0 && one.shot[0].count != 77 : one.shot[0].count == 77);
  }
  ck_assert_ptr_nonnull(strstr(carom_status_string(CAROM_ERROR_SHOT_OPTIONS), "kinds"));

  /* a bad kind costs every shot, as each has it */
  empty(&one);
  carom_shot_job job = job_of(NULL, &one, true, BALLS);
  kinds[2].mu_roll = -1.0;
  ck_assert_int_eq(carom_shoot_batch(&job), CAROM_ERROR_MU_MOTION);
  for (int k = 0; k < SHOTS; k++)
    ck_assert_int_eq(one.status[k], CAROM_ERROR_MU_MOTION);
}
