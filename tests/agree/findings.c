/* What a hostile review of an earlier solver found, as tests: results that were wrong with
 * status ok, calls without a bound, and draws in which they could come back. Rows are in
 * findings/, as `carom resolve` reads them.
 */
#include "cases.h"
#include "kept.h"
#include "precisely.h"
#include "regimes.h"
#include "support.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "impact/impact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILL = 96 }; /* rows of a batch that every instruction set solves in lanes */
/* Right-hand sides of one call: those of the precise solver, whose last step may exceed its
 * budget, and what collocation spent.
 */
enum { MOST_EVALUATIONS = 8 * (CAROM_IMPACT_ITERATIONS + 12) + 1000 };

static const double accepted = 1e-5, realistic = 1e-6, precisely = 1e-7, in_single = 2e-5;

static carom_options options_for(carom_slip slip) {
  carom_options options = {0};
  options.slip = slip;
  return options;
}

/* Solved within `bound` of the reference, or said to be unresolved; alone and in a batch, with
 * every instruction set; within the bound on evaluations. Returns whether it was solved. */
static bool expect_solved(const carom_impact *in, carom_slip slip, double bound, const char *what) {
  const carom_options options = options_for(slip);
  carom_result exact, out, many[FILL];
  carom_impact rows[FILL];
  bool solved = false;
  for (int k = 0; k < FILL; k++)
    rows[k] = *in;
  const bool known = kept_collide(in, slip, &exact, NULL) == REFERENCE_OK;
  FOR_EACH_ISA(isa) {
    carom_detail detail;
    const carom_status status = carom_collide_detail(in, &options, &out, &detail);
    ck_assert_msg(status == CAROM_OK || status == CAROM_ERROR_UNRESOLVED, "%s: status %s", what,
                  carom_status_name(status));
    ck_assert_int_le(detail.evaluations, MOST_EVALUATIONS);
    ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL), status);
    for (int k = 0; k < FILL; k++)
      ck_assert_mem_eq(&many[k], &out, sizeof out);
    solved = status == CAROM_OK;
    if (solved && known) {
      const double error = result_distance(&out, &exact, in->a.radius);
      ck_assert_msg(error <= bound, "%s: %g off with %s", what, error,
                    carom_isa_name((carom_isa)isa));
    }
  }
  if (solved && known && collide_precisely(in, slip, PRECISELY, &out) == CAROM_OK) {
    const double error = result_distance(&out, &exact, in->a.radius);
    ck_assert_msg(error <= precisely, "%s: the precise solver is %g off", what, error);
  }
  return solved;
}

/* What carom.h calls collisions of play. */
static bool of_play(const carom_impact *in) {
  const double ratio = in->a.mass / in->b.mass;
  return in->mu_ball <= 0.2 && fmax(in->a.mu_cloth, in->b.mu_cloth) <= 0.5 &&
         in->restitution >= 0.5 && ratio >= 0.5 && ratio <= 2;
}

/* The same in single precision, by calls and in batches. Beyond play nothing is promised; some
 * rows are right all the same. */
static void expect_in_single(const carom_impact *in, carom_slip slip, bool beyond_play,
                             const char *what) {
  const carom_options options = options_for(slip);
  carom_impact_f32 rows[FILL];
  carom_result_f32 out, many[FILL];
  carom_result exact;
  for (int row = 0; row < FILL; row++)
    rows[row] = narrowed(in);
  const carom_impact wide = widened(&rows[0]);
  const bool known =
      (beyond_play || of_play(&wide)) && kept_collide(&wide, slip, &exact, NULL) == REFERENCE_OK;
  FOR_EACH_ISA(isa) {
    const carom_status status = carom_collide_one(CAROM_F32, &rows[0], &options, &out);
    ck_assert_int_eq(carom_collide_batch_f32(rows, FILL, &options, many, NULL), status);
    for (int row = 0; row < FILL; row++)
      ck_assert_mem_eq(&many[row], &out, sizeof out);
    if (status != CAROM_OK || !known)
      continue;
    const carom_result seen = widened_result(&out);
    const double error = result_distance(&seen, &exact, wide.a.radius);
    ck_assert_msg(error <= in_single, "%s in single precision: %g off with %s", what, error,
                  carom_isa_name((carom_isa)isa));
  }
}

static void expect_file(const char *file, carom_slip slip) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, file, &cases));
  size_t solved = 0;
  for (size_t k = 0; k < cases.count; k++) {
    solved += expect_solved(&cases.impact[k], slip,
                            of_play(&cases.impact[k]) ? realistic : accepted, cases.id[k]);
    expect_in_single(&cases.impact[k], slip, false, cases.id[k]);
  }
  ck_assert_uint_ge(3 * solved, cases.count);
  cases_free(&cases);
}

TEST(results_that_were_wrong) {
  expect_file("exact-wrong-paper.csv", CAROM_SLIP_PAPER);
  expect_file("exact-wrong-pooltool.csv", CAROM_SLIP_POOLTOOL);
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
    expect_file("stick-before-the-end.csv", (carom_slip)slip);
  expect_file("pooltool-turns.csv", CAROM_SLIP_POOLTOOL);
}

/* Full hits with the slip of pooltool, in which friction makes motion across the line of centres
 * of what counts as none: up to 20 % of the fastest speed, by a reference of 34 digits. */
TEST(rounding_errors_that_friction_drives) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "pooltool-no-drive.csv", &cases));
  const carom_options options = options_for(CAROM_SLIP_POOLTOOL);
  ck_assert_uint_eq(cases.count, 30);
  for (size_t k = 0; k < cases.count; k++)
    FOR_EACH_ISA(isa) {
      carom_result out;
      ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_UNRESOLVED);
    }
  cases_free(&cases);
}

/* The rows are for the pooltool slip; here both. */
TEST(single_precision_that_lost_restitution) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "f32-batch-wrong.csv", &cases));
  for (size_t k = 0; k < cases.count; k++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      expect_in_single(&cases.impact[k], (carom_slip)slip, true, cases.id[k]);
  cases_free(&cases);
}

/* Euler's method says at once that it would take too long, and never takes more than 16 N steps. */
TEST(euler_is_bounded) {
  case_set cases;
  carom_result out;
  carom_detail detail;
  carom_options options = options_for(CAROM_SLIP_PAPER);
  options.solver = CAROM_SOLVER_EULER;
  ck_assert(cases_load(CAROM_TEST_FINDINGS, "euler-hang.csv", &cases));
  for (size_t k = 0; k < cases.count; k++) {
    ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_ERROR_TOO_SLOW);
    ck_assert_int_eq(carom_collide_batch(&cases.impact[k], 1, &options, &out, NULL),
                     CAROM_ERROR_TOO_SLOW);
    expect_solved(&cases.impact[k], CAROM_SLIP_PAPER, accepted, "euler-hang.csv");
  }
  random_source source = {test_seed()};
  options.steps = 100;
  for (int k = 0; k < 3000; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0, 1);
    in.a.mu_cloth = in.b.mu_cloth = random_between(&source, 0, 1);
    in.a.mass = in.b.mass * exp(random_between(&source, -20, 20));
    if (carom_collide_detail(&in, &options, &out, &detail) == CAROM_OK)
      ck_assert_int_le(detail.steps, 16 * options.steps);
  }
  cases_free(&cases);
}

/* A pressed ball that rolls, so that the cloth slip starts at zero: 1e-6 was exceeded mostly
 * there. */
TEST(rolling_balls) {
  random_source source = {test_seed()};
  for (int k = 0; k < FEWER(120); k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0.05, 0.2);
    in.a.mu_cloth = in.b.mu_cloth = random_between(&source, 0.1, 0.5);
    in.restitution = random_between(&source, 0.5, 1);
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      /* no slip by that sign */
      const double per = -carom_spin_sign((carom_slip)slip) / in.a.radius;
      in.a.w[0] = -per * -in.a.v[1], in.a.w[1] = per * in.a.v[0];
      in.b.w[0] = -per * -in.b.v[1], in.b.w[1] = per * in.b.v[0];
      ck_assert(expect_solved(&in, (carom_slip)slip, realistic, "a rolling ball"));
    }
  }
}

/* Masses within 1 : 2, mu_b <= 0.5, mu <= 0.8. */
TEST(strong_friction) {
  random_source source = {test_seed()};
  int solved = 0;
  enum { DRAWS = FEWER(150) };
  for (int k = 0; k < DRAWS; k++) {
    carom_impact in = random_impact(&source);
    in.mu_ball = random_between(&source, 0, 0.5);
    in.a.mu_cloth = random_between(&source, 0, 0.8),
    in.b.mu_cloth = random_between(&source, 0, 0.8);
    in.a.mass = in.b.mass * exp2(random_between(&source, -1, 1));
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      solved += expect_solved(&in, (carom_slip)slip, accepted, "strong friction");
  }
  ck_assert_int_ge(solved, DRAWS * CAROM_SLIP_COUNT - 3);
}

/* A number that is 0 in one of four draws, and else anything from 1e-14 to 1e-3. */
static double near_zero(random_source *source) {
  const double size = exp10(random_between(source, -14, -3)), kind = random_between(source, 0, 4);
  return kind < 1 ? 0 : kind < 2.5 ? size : -size;
}

/* A planar collision, or nearly one: u and d lie along u_z and d_y. The balls stick shortly
 * before the end of the collision if `stick`, and the cloth slip passes zero on the way if
 * `pass`; else it begins or ends near zero. Units: those of reduced.h over |v_n| / kappa. */
static carom_impact planar_impact(random_source *source, double s, bool play, bool stick,
                                  bool pass) {
  const double R = 0.03;
  const bool corner = random_between(source, 0, 1) < 0.4;
  const double ratio = random_between(source, 0, 1) < 0.5
                           ? 1
                           : exp2(random_between(source, play ? -1 : -4, play ? 1 : 4));
  const double mu_b = play && corner ? 0.2 : random_between(source, 0.01, play ? 0.2 : 0.5);
  const double mu = play && corner ? 0.5 : random_between(source, 0, play ? 0.5 : 1);
  const double e = random_between(source, play ? 0.5 : 0, 1);
  const double t_y = random_between(source, -1, 1) < 0 ? -1 : 1, kappa = 1 + ratio,
               f_y = -mu * mu_b * t_y;
  /* p at the end, and where the balls stick */
  const double p_end = (1 + e) / (1 - f_y / kappa),
               at_stick = 1 - exp10(random_between(source, -5, -1));
  const double u_z = stick ? p_end * at_stick * (2.5 * mu_b * kappa - 2.5 * f_y)
                           : exp2(random_between(source, -4, 3));
  const double p_zero = pass ? random_between(source, 0, p_end)
                             : near_zero(source) + (random_between(source, 0, 2) < 1 ? p_end : 0);
  const double u_x = near_zero(source), d_x = near_zero(source),
               rate = 2.5 * s * mu_b - 1 + (1 - 2.5 * s) * f_y;
  const double d_y = p_zero == 0 ? near_zero(source) : -rate * p_zero;
  const double w_x = (kappa - d_y) / (s * R);
  carom_impact in = {
      .a = {.v = {d_x, kappa}, .w = {w_x}, .radius = R, .mass = ratio, .mu_cloth = mu},
      .b = {.r = {0, 2 * R},
            .v = {d_x - u_x},
            .w = {u_z / R - w_x},
            .radius = R,
            .mass = 1,
            .mu_cloth = mu},
      .mu_ball = mu_b,
      .restitution = e};
  if (d_x == 0 && d_y == 0) { /* a lies still */
    in.a.v[1] = in.a.w[0] = 0;
    in.b.v[1] = -kappa;
    in.b.w[0] = u_z / R;
  }
  if (random_between(source, 0, 2) < 1)
    return in;
  /* seen from elsewhere, which leaves rounding errors of what was zero */
  const double angle = random_between(source, -3, 3), sine = sin(angle), cosine = cos(angle);
  double *const vectors[] = {in.a.v, in.a.w, in.b.r, in.b.v, in.b.w};
  for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++) {
    const double x = vectors[k][0], y = vectors[k][1];
    vectors[k][0] = cosine * x - sine * y;
    vectors[k][1] = sine * x + cosine * y;
  }
  return in;
}

/* Bits of batches and calls are equal; errors against the precise solver, and where that
 * differs, or is unresolved, against the reference. Returns the number of collisions that were
 * solved. */
static int expect_planar(random_source *source, carom_slip slip, bool play, bool stick, bool pass) {
  const carom_options options = options_for(slip);
  const double s = carom_spin_sign(slip);
  carom_impact rows[FILL], wide[FILL];
  carom_impact_f32 narrow[FILL];
  carom_result right[2][FILL], alone, many[FILL];
  carom_result_f32 alone_f32, many_f32[FILL];
  int8_t status[FILL], status_f32[FILL];
  int solved = 0;
  for (int k = 0; k < FILL; k++) {
    rows[k] = planar_impact(source, s, play, stick, pass);
    narrow[k] = narrowed(&rows[k]);
    wide[k] = widened(&narrow[k]);
    if (collide_precisely(&rows[k], slip, PRECISELY, &right[0][k]) != CAROM_OK)
      right[0][k].a.v[0] = NAN;
    if (collide_precisely(&wide[k], slip, PRECISELY, &right[1][k]) != CAROM_OK)
      right[1][k].a.v[0] = NAN;
  }
  FOR_EACH_ISA(isa) {
    carom_collide_batch(rows, FILL, &options, many, status);
    carom_collide_batch_f32(narrow, FILL, &options, many_f32, status_f32);
    for (int k = 0; k < FILL; k++) {
      ck_assert_int_eq(carom_collide(&rows[k], &options, &alone), status[k]);
      ck_assert_int_eq(carom_collide_one(CAROM_F32, &narrow[k], &options, &alone_f32),
                       status_f32[k]);
      ck_assert_mem_eq(&alone, &many[k], sizeof alone);
      ck_assert_mem_eq(&alone_f32, &many_f32[k], sizeof alone_f32);
      solved += isa == CAROM_ISA_PLAIN && status[k] == CAROM_OK;
      for (int single = 0; single < 2; single++) {
        if ((single ? status_f32 : status)[k] != CAROM_OK || (single && !play))
          continue;
        const carom_impact *const in = single ? &wide[k] : &rows[k];
        const double bound = single ? in_single : play ? realistic : accepted;
        if (single)
          alone = widened_result(&alone_f32);
        double error = result_distance(&alone, &right[single][k], in->a.radius);
        if (!(error <= bound) && kept_collide(in, slip, &right[single][k], NULL) == REFERENCE_OK)
          error = result_distance(&alone, &right[single][k], in->a.radius);
        ck_assert_msg(error <= bound,
                      "slip %d, stick %d, pass %d%s: %g off with %s, mu_b %.17g mu %.17g e %.17g",
                      slip, stick, pass, single ? ", in single precision" : "", error,
                      carom_isa_name((carom_isa)isa), in->mu_ball, in->a.mu_cloth, in->restitution);
      }
    }
  }
  return solved;
}

/* Windows of 1e-5 that random draws miss: the balls are about to stick as the collision ends,
 * the cloth slip begins at zero, passes it or ends there, and the motion is planar, exactly or
 * nearly. */
TEST(planar_collisions) {
  random_source source = {test_seed()};
  for (int kind = 0; kind < 16; kind++) {
    const bool play = kind & 1, stick = kind & 2, pass = kind & 4;
    const carom_slip slip = kind & 8 ? CAROM_SLIP_POOLTOOL : CAROM_SLIP_PAPER;
    int solved = 0;
    for (int k = 0; k < 10; k++)
      solved += expect_planar(&source, slip, play, stick, pass);
    ck_assert_int_gt(solved, play ? 670 : 290);
  }
}

/* At the ends of the range of double precision: the same status and bits alone and in a batch,
 * and nothing but finite numbers with status ok. */
TEST(ends_of_the_range) {
  static const double radii[] = {2e-308, 1e-300, 1e-160, 1e160, 1e300},
                      spins[] = {1e307, 1e200, 1e160, 1e-300};
  random_source source = {test_seed()};
  for (int k = 0; k < 40; k++) {
    carom_impact in = random_impact(&source);
    if (k % 2) {
      const double R = radii[k / 2 % 5];
      for (int c = 0; c < 3; c++)
        in.b.r[c] = in.a.r[c] + (in.b.r[c] - in.a.r[c]) / in.a.radius * R;
      in.a.radius = in.b.radius = R;
    } else
      in.a.w[k / 2 % 3] = spins[k / 2 % 4];
    const carom_options options = options_for((carom_slip)(k / 4 % 2));
    carom_impact rows[FILL];
    for (int row = 0; row < FILL; row++)
      rows[row] = in;
    carom_result out, many[FILL];
    FOR_EACH_ISA(isa) {
      const carom_status status = carom_collide(&in, &options, &out);
      for (int c = 0; c < 12; c++)
        ck_assert_int_eq(isfinite(((const double *)&out)[c]) != 0, status >= 0);
      ck_assert_int_eq(carom_collide_batch(rows, FILL, &options, many, NULL),
                       status < 0 ? status : CAROM_OK);
      for (int row = 0; row < FILL; row++)
        ck_assert(memcmp(&many[row], &out, sizeof out) == 0);
    }
  }
}
