/* No call takes more than its stated number of iterations of the precise solver, each of which
 * computes the rates at eight nodes: CAROM_IMPACT_ITERATIONS for an impact, and as many for each
 * sample of a trace, in addition to the rest of the step in which that is reached. The linker puts
 * the counter below between the solver's entry and its loop; no time is measured. */
#include "random_impacts.h"
#include "support.h"

#include "contact_law/impact.h"
#include "cushion/models.h"

enum {
  STEP = 12, /* iterations of one step, MOST_ITERATIONS of contact_law/step.h */
  IMPACT = CAROM_IMPACT_ITERATIONS + STEP,
  FAST = 1000,  /* evaluations that collocation may have spent before */
  DRAWS = 1500, /* before a release */
  POINTS = 9
};

static int spent, most_spent;

carom_status __real_carom_impact_advance_plain(carom_trajectory *path, double to, int most);
carom_status __wrap_carom_impact_advance_plain(carom_trajectory *path, double to, int most);
carom_status __wrap_carom_impact_advance_plain(carom_trajectory *path, double to, int most) {
  const int before = path->iterations;
  const carom_status status = __real_carom_impact_advance_plain(path, to, most);
  spent += path->iterations - before;
  return status;
}

/* Looks at what has been spent since the last time. */
static void expect_spent(int most, const char *what) {
  ck_assert_msg(spent <= most, "%s: %d iterations", what, spent);
  if (most <= IMPACT && spent > most_spent)
    most_spent = spent;
  spent = 0;
}

static void expect_bounded_cushion(const carom_cushion_impact *in, const char *what) {
  carom_motion out[3];
  carom_cushion_point points[POINTS];
  const carom_cushion_impact rows[3] = {*in, *in, *in};
  for (int law = CAROM_CUSHION_LAW_CONSTANT; law <= CAROM_CUSHION_LAW_HAN; law++) {
    const carom_cushion_options options = {.law = (carom_cushion_law)law};
    const carom_status status = carom_cushion(in, &options, &out[0]);
    expect_spent(IMPACT, what);
    carom_cushion_batch(rows, 3, &options, out, NULL);
    expect_spent(3 * IMPACT + IMPACT, what); /* the first row in error is solved again, for its
                                                status */
    for (int n = 2; n <= POINTS; n += POINTS - 2) {
      /* the call, the way to the end, and the samples */
      const carom_status traced = carom_cushion_trace(in, &options, (size_t)n, points);
      expect_spent((n + 2) * IMPACT, what);
      if (status != CAROM_OK)
        ck_assert_int_eq(traced, status);
    }
  }
}

static void expect_bounded_balls(const carom_impact *in, carom_slip slip, const char *what) {
  const carom_options options = {.slip = slip};
  carom_result out[3];
  carom_detail detail;
  carom_trace_point points[POINTS];
  const carom_impact rows[3] = {*in, *in, *in};
  carom_collide(in, &options, &out[0]);
  expect_spent(IMPACT, what);
  if (carom_collide_detail(in, &options, &out[0], &detail) == CAROM_OK)
    ck_assert_msg(detail.evaluations <= 8 * IMPACT + FAST, "%s: %lld evaluations", what,
                  (long long)detail.evaluations);
  expect_spent(IMPACT, what);
  carom_collide_batch(rows, 3, &options, out, NULL);
  expect_spent(3 * IMPACT + IMPACT, what);
  for (int n = 2; n <= POINTS; n += POINTS - 2) {
    carom_trace(in, &options, (size_t)n, points);
    expect_spent((n + 1) * IMPACT, what);
  }
}

/* Traces of these impacts on a cushion once took up to 64 s. */
TEST(found_ones) {
  static const carom_cushion_impact found[] = {
      {.v = {0, 1, 0},
       .w = {0, 0, 0},
       .normal = {1, 8.6e-06},
       .height = 0.0285750000554355,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0,
       .mu_cushion = 0.0925,
       .restitution = 0.39},
      {.v = {0, 1, 0},
       .w = {0, 0, 0},
       .normal = {1, 8.6e-06},
       .height = 0.028575,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.0925,
       .restitution = 0.39},
      {.v = {0, 1, 0},
       .w = {0, 0, 0},
       .normal = {1, 8.6e-06},
       .height = 0.0365,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.0925,
       .restitution = 0.39},
      {.v = {0, 1, 0},
       .w = {0, 0, 0},
       .normal = {1, 0.0001},
       .height = 0.0365,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.2,
       .restitution = 0.85},
      {.v = {0, 1, 0},
       .w = {0, 0, 0},
       .normal = {1, 3e-05},
       .height = 0.0365,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.2,
       .restitution = 0.85},
      {.v = {1, 3e-05, 0},
       .w = {0, 0, 0},
       .normal = {0, 1},
       .height = 0.0365,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.2,
       .restitution = 0.85},
      {.v = {1, 1e-09, 0},
       .w = {0, 0, 0},
       .normal = {0, 1},
       .height = 0.0365,
       .radius = 0.028575,
       .mass = 0.17,
       .mu_slide = 0.2,
       .mu_cushion = 0.2,
       .restitution = 0.85},
      {.v = {-1.7540932055044138, -1.7786453671343132, 0},
       .w = {-43.380836063317105, 24.537838577154645, -40.353408657758592},
       .normal = {-0.10491475906268877, 0.10345954784428317},
       .height = 0.0289107243746126,
       .radius = 0.025954938432107773,
       .mass = 0.11096816627216578,
       .mu_slide = 0.36657122128857067,
       .mu_cushion = 1,
       .restitution = 0.033157282050875647},
      {.v = {-3.6815134920072037, 20.623196625156162, 0},
       .w = {24.945243230845751, 16.415280566218946, -18.354654011588298},
       .normal = {0.83535655154386834, 0.5497084971080004},
       .height = 1.0510489826456098,
       .radius = 1.0510489826456098,
       .mass = 0.14344923993504211,
       .mu_slide = 0.74910559650907449,
       .mu_cushion = 0.15990382034678507,
       .restitution = 1}};
  carom_isa_limit(CAROM_ISA_PLAIN);
  for (size_t k = 0; k < COUNT_OF(found); k++) {
    char what[40];
    snprintf(what, sizeof what, "found %zu", k);
    expect_bounded_cushion(&found[k], what);
  }
}

TEST(coincidences) {
  carom_isa_limit(CAROM_ISA_PLAIN);
  const uint64_t draws = (uint64_t)draws_of_test(DRAWS / 3, DRAWS);
  for (int kind = 0; kind < coincidence_kinds(); kind++)
    for (uint64_t k = 0; k < draws; k++) {
      const drawn c = coincidence_draw(kind, test_seed(), k);
      char what[60];
      snprintf(what, sizeof what, "%s, draw %d", coincidence_name(kind), (int)k);
      if (c.cushion)
        expect_bounded_cushion(&c.rail, what);
      else
        expect_bounded_balls(&c.balls, c.slip, what);
    }
  printf("coincidences: %d iterations at most\n", most_spent);
}

TEST(everything_that_is_accepted) {
  carom_isa_limit(CAROM_ISA_PLAIN);
  const uint64_t draws = 4 * (uint64_t)draws_of_test(DRAWS / 3, DRAWS);
  for (uint64_t k = 0; k < draws; k++) {
    char what[40];
    snprintf(what, sizeof what, "draw %d", (int)k);
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      for (int kind = DRAW_REGIMES; kind <= DRAW_EXTREME; kind++) {
        const carom_impact in = draw_collision((draw_kind)kind, (carom_slip)slip, test_seed(), k);
        expect_bounded_balls(&in, (carom_slip)slip, what);
      }
    carom_cushion_impact wall = draw_cushion(CUSHION_ANY, test_seed(), k);
    expect_bounded_cushion(&wall, what);
    for (int c = 0; c < 3; c++)
      wall.w[c] *= 1e4; /* slips far above the approach */
    expect_bounded_cushion(&wall, what);
  }
  printf("everything: %d iterations at most\n", most_spent);
  ck_assert_int_gt(most_spent, 0);
}

/* Euler's steps: at most ten times N in each phase, and the halved ones between. */
TEST(steps_of_a_cushion) {
  enum { N = 50 };
  const carom_cushion_options options = {.model = CAROM_CUSHION_EULER, .steps = N};
  carom_cushion_point points[POINTS];
  for (uint64_t k = 0; k < DRAWS; k++) {
    const carom_cushion_impact in = draw_cushion(CUSHION_ANY, test_seed(), k);
    const carom_cushion_frame frame = carom_cushion_frame_of(&in);
    carom_contact c = carom_to_cushion(&frame, &in, &options);
    carom_cushion_run run;
    carom_cushion_euler(&c, N, 0, k % 2 == 0, INT64_MAX, &run);
    ck_assert_int_le(run.steps, 2 * (10 * N + 1) + 8);
    carom_cushion_trace(&in, &options, POINTS, points);
    expect_spent(0, "Euler's steps");
  }
}
