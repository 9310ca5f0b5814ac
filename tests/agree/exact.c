/* The exact solver against the exact references and against the reference of lab/stress, which
 * shares nothing with it.
 *
 * Random collisions come by regime (tests/regimes.c): slow and fast, grazing and head-on, draw,
 * follow and stun, sidespin, both moving, stick at every moment and just missed, the cloth's
 * slip passing near zero or through it, friction and restitution from 0 to 1, unequal masses.
 * $CAROM_TEST_DRAWS says how many of each.
 */
#include "accuracy.h"
#include "cases.h"
#include "kept.h"
#include "precisely.h"
#include "regimes.h"
#include "support.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/reduced.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void expect_references(carom_slip slip, const char *file) {
  case_set cases;
  reference_set reference;
  pair_accuracy each[204];
  carom_options options = {0};
  options.slip = slip;
  ck_assert_int_eq(options.solver, CAROM_SOLVER_EXACT);
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert(reference_load(CAROM_TEST_DATA, file, &cases, &reference));
  FOR_EACH_ISA(isa) {
    for (size_t k = 0; k < cases.count; k++) {
      carom_result out;
      ck_assert_int_eq(carom_collide(&cases.impact[k], &options, &out), CAROM_OK);
      each[k] = accuracy_of(&out, &reference.result[k], cases.impact[k].a.radius);
    }
    const accuracy_summary s = accuracy_summarise(each, cases.count);
    ck_assert_double_le(s.max, 1e-6);
    ck_assert_double_le(s.median, 5e-9);
  }
  reference_free(&reference);
  cases_free(&cases);
}

TEST(references) {
  expect_references(CAROM_SLIP_PAPER, "reference-exact-paper.csv");
  expect_references(CAROM_SLIP_POOLTOOL, "reference-exact-pooltool.csv");
}

/* The reference itself against the data: what it is trusted for. */
TEST(reference_agrees_with_the_data) {
  case_set cases;
  reference_set reference;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  ck_assert(reference_load(CAROM_TEST_DATA, "reference-exact-paper.csv", &cases, &reference));
  for (size_t k = 0; k < cases.count; k += 7) {
    carom_result out;
    ck_assert_int_eq(reference_collide(&cases.impact[k], CAROM_SLIP_PAPER, &out, NULL),
                     REFERENCE_OK);
    ck_assert_double_le(result_distance(&out, &reference.result[k], cases.impact[k].a.radius),
                        1e-11);
  }
  reference_free(&reference);
  cases_free(&cases);
}

enum { FILL = 96 }; /* rows of a batch that every instruction set solves in lanes */

/* What the solver tells of a collision: the impulses balance, the works are in the ratio of
 * restitution, stick is seen. `normal`: the impulse and the work of the reference. */
static void expect_details(const carom_impact *in, const carom_result *out, const carom_detail *d,
                           const double normal[2]) {
  /* what is subtracted on the way: speeds of both balls */
  const double speed = fabs(in->a.v[0]) + fabs(in->a.v[1]) + fabs(in->b.v[0]) + fabs(in->b.v[1]);
  const double scale = fabs(d->normal) + in->a.mass * speed;
  const double length = hypot(in->b.r[0] - in->a.r[0], in->b.r[1] - in->a.r[1]);
  for (int c = 0; c < 2; c++) { /* in the plane of the table */
    const double y = (in->b.r[c] - in->a.r[c]) / length;
    const double on_a = -d->normal * y + d->friction[c] + d->cloth_a[c];
    const double on_b = d->normal * y - d->friction[c] + d->cloth_b[c];
    ck_assert_double_le(fabs(in->a.mass * (out->a.v[c] - in->a.v[c]) - on_a), 1e-12 * scale);
    ck_assert_double_le(fabs(in->b.mass * (out->b.v[c] - in->b.v[c]) - on_b),
                        1e-11 * (scale + in->b.mass * speed));
  }
  ck_assert_double_eq_tol(d->work, (1.0 + in->restitution * in->restitution) * d->work_compression,
                          1e-12 * fabs(d->work));
  ck_assert_double_eq_tol(d->normal, normal[0], 1e-4 * normal[0] + 1e-15 * scale);
  ck_assert_double_eq_tol(d->work_compression, normal[1],
                          1e-3 * normal[1] + 1e-14 * speed * normal[0]);
  ck_assert(d->steps == 0 && d->evaluations >= 0);
  ck_assert((d->stick == CAROM_STICK_NEVER) == (isnan(d->stick_normal) != 0));
}

/* A few say that they are unresolved. `carom-lab stress` has the same regimes in batches, in single
 * precision and in far greater numbers (agree/stress). */
TEST(details_in_every_regime) {
  int count = 0, unresolved = 0, stuck[3] = {0};
  const int draws = draws_of_each(FEWER(8));
  for (int regime = 0; regime < regimes_count(); regime++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
      lab_random rng = {test_seed() + 1000003u * (uint64_t)(2 * regime + slip)};
      const carom_options options = {.slip = (carom_slip)slip};
      for (int k = 0; k < draws; k++) {
        const carom_impact in = regimes_draw(regime, carom_spin_sign(options.slip), &rng);
        carom_result out, exact;
        carom_detail detail;
        double normal[2];
        const carom_status status = carom_collide_detail(&in, &options, &out, &detail);
        if (status == CAROM_SEPARATING ||
            kept_collide(&in, options.slip, &exact, normal) != REFERENCE_OK)
          continue;
        unresolved += status == CAROM_ERROR_UNRESOLVED;
        if (status == CAROM_ERROR_UNRESOLVED)
          continue;
        const double error = result_distance(&out, &exact, in.a.radius);
        ck_assert_msg(error <= 1e-5, "%s, slip %d, draw %d is %g off", regimes_name(regime), slip,
                      k, error);
        expect_details(&in, &out, &detail, normal);
        stuck[detail.stick]++;
        count++;
      }
    }
  /* of 400 seeds 389 of 211,200 draws are unresolved; eight standard deviations more may be */
  const double expected = count / 543.0;
  ck_assert_double_le(unresolved, expected + 8.0 * sqrt(expected));
  for (int k = 0; k < 3; k++)
    ck_assert_int_gt(stuck[k], 10);
}

/* Real shots are not left to the fallback. */
TEST(collocation_takes_the_references) {
  case_set cases;
  ck_assert(cases_load(CAROM_TEST_DATA, "collisions-204.csv", &cases));
  FOR_EACH_ISA(isa) for (int sign = -1; sign <= 1; sign += 2) {
    carom_result out;
    for (size_t k = 0; k < cases.count; k++)
      ck_assert_int_gt(
          carom_kernels_of_call(0)->call[CAROM_F64](&cases.impact[k], sign, &out, NULL), 0);
  }
  cases_free(&cases);
}

/* The same collision at other speeds, down to where squares vanish and up to where they are
 * infinite. */
TEST(speeds_scale) {
  static const int powers[] = {-980, -600, -100, -40, 40, 100, 600, 980};
  random_source source = {test_seed()};
  for (int k = 0; k < 200; k++) {
    const carom_impact in = random_impact(&source);
    carom_result out, scaled;
    ck_assert_int_eq(carom_collide(&in, NULL, &out), CAROM_OK);
    for (size_t j = 0; j < sizeof powers / sizeof powers[0]; j++) {
      carom_impact other = in;
      for (int c = 0; c < 3; c++) {
        other.a.v[c] = ldexp(in.a.v[c], powers[j]), other.b.v[c] = ldexp(in.b.v[c], powers[j]);
        other.a.w[c] = ldexp(in.a.w[c], powers[j]), other.b.w[c] = ldexp(in.b.w[c], powers[j]);
      }
      ck_assert_int_eq(carom_collide(&other, NULL, &scaled), CAROM_OK);
      for (int c = 0; c < 12; c++)
        ((double *)&scaled)[c] = ldexp(((double *)&scaled)[c], -powers[j]);
      const double distance = result_distance(&scaled, &out, in.a.radius);
      ck_assert_msg(distance <= 3e-6, "collision %d at 2^%d times its speed: %g apart", k,
                    powers[j], distance);
    }
  }
}

/* Collisions that a class of arcs once accepted wrongly: stick just at the end, hardly any u_z,
 * strong friction beside a light ball, no ball slip at all, a light pressed ball on rough cloth,
 * friction so weak that the sweeps leave p rough. In the units of reduced.h, |v_n0| / kappa
 * being 1. */
static const struct {
  double u_x, u_z, d_x, d_y, kappa, mu, mu_b, e, s;
} hard[] = {
    {-0.346526567, 3.01613646e-5, -0.756237458, 3.74993251, 2, 0.177413758, 0.0261219012,
     0.894255291, -1},
    {-0.487295757, 3.88333e-5, -0.884130345, 2.68900569, 2, 0.425788981, 0.0370359968, 0.878621643,
     1},
    {-0.020197479, 0.881732803, -0.0291018688, 2.8817328, 2, 0.265736945, 0.0814308, 0.9285994, -1},
    {1.13442887, 1.50410331, -0.077748, -0.4980382, 1.0060651, 0.93812785, 0.143497623, 0.8986, 1},
    {0.494865807, 3.49382937, -0.42645722, -2.14299239, 1.39717349, 0.95156, 0.468186, 0.249551, 1},
    {0.913426, 0.00031384, 0, 2.2323, 2, 0.480102, 0.068965, 0.892111, -1},
    {0, 0, 0.5, 1, 2, 0.2, 0.05, 0.9, -1},
    {-5.73555028e-4, 4.25e-10, 0.00692701288, -0.725437552, 1.10849, 0.989182, 6.92598e-4, 0.566839,
     -1},
    {-0.2009, 0.00771, 0, 0, 1.2436, 0.705, 0.0384, 0.265, 1},
    {-0.525, 0.0294, 0, 0, 1.30527, 0.674, 0.1077, 0.196, -1},
    {0, 0.4023437, 0, 0.730985, 2, 0.7246, 0.138, 0.4717, 1},
    {-3.064e-8, 3.111e-10, -0.116091, 0.945420, 2, 0.850727, 2.05555e-9, 0.857515, 1},
    {2.496e-9, 1.43e-10, -0.13886, 1.765, 1.3245, 0.66622, 2.5e-10, 0.975, -1},
    {-0.00631, 1.98e-7, 1.248, 0.846, 1.213, 0.749, 7.27e-4, 0.9626, 1}};

TEST(hard_cases) {
  const double R = 0.03;
  for (size_t k = 0; k < sizeof hard / sizeof hard[0]; k++) {
    const double s = hard[k].s, w_x = (hard[k].kappa - hard[k].d_y) / (s * R);
    const carom_impact in = {.a = {.v = {hard[k].d_x, hard[k].kappa},
                                   .w = {w_x},
                                   .radius = R,
                                   .mass = hard[k].kappa - 1,
                                   .mu_cloth = hard[k].mu},
                             .b = {.r = {0, 2 * R},
                                   .v = {hard[k].d_x - hard[k].u_x},
                                   .w = {hard[k].u_z / R - w_x},
                                   .radius = R,
                                   .mass = 1,
                                   .mu_cloth = hard[k].mu},
                             .mu_ball = hard[k].mu_b,
                             .restitution = hard[k].e};
    carom_options options = {0};
    options.slip = s > 0 ? CAROM_SLIP_POOLTOOL : CAROM_SLIP_PAPER;
    carom_impact many[FILL];
    carom_result out, exact, alone, outs[FILL];
    for (int lane = 0; lane < FILL; lane++)
      many[lane] = in;
    ck_assert_int_eq(collide_precisely(&in, options.slip, PRECISELY, &alone), CAROM_OK);
    ck_assert_int_eq(carom_collide(&in, &options, &out), CAROM_OK);
    ck_assert_int_eq(carom_collide_batch(many, FILL, &options, outs, NULL), CAROM_OK);
    ck_assert_int_eq(kept_collide(&in, options.slip, &exact, NULL), REFERENCE_OK);
    /* the two promises of carom.h */
    const bool of_play = hard[k].mu <= 0.5 && hard[k].mu_b <= 0.2 && hard[k].e >= 0.5 &&
                         hard[k].kappa >= 1.5 && hard[k].kappa <= 3;
    const double allowed = of_play ? 1e-6 : 1e-5;
    ck_assert_msg(result_distance(&out, &exact, R) <= allowed, "case %zu is %g off", k,
                  result_distance(&out, &exact, R));
    ck_assert_double_le(result_distance(&outs[FILL - 1], &exact, R), allowed);
    ck_assert_double_le(result_distance(&alone, &exact, R), 1e-9);
  }
}

TEST(details_of_euler_come_near) {
  random_source source = {test_seed()};
  for (int k = 0; k < 200; k++) {
    const carom_impact in = random_impact(&source);
    carom_options options = {0};
    carom_result out;
    carom_detail exact, euler;
    ck_assert_int_eq(carom_collide_detail(&in, &options, &out, &exact), CAROM_OK);
    options.solver = CAROM_SOLVER_EULER;
    options.steps = 20000;
    ck_assert_int_eq(carom_collide_detail(&in, &options, &out, &euler), CAROM_OK);
    ck_assert_int_ge(euler.steps, 10000);
    ck_assert_double_eq_tol(euler.normal, exact.normal, 1e-3 * exact.normal);
    ck_assert_double_eq_tol(euler.work_compression, exact.work_compression,
                            1e-3 * exact.work_compression);
    for (int c = 0; c < 3; c++) {
      ck_assert_double_eq_tol(euler.friction[c], exact.friction[c], 1e-3 * exact.normal);
      if (exact.stick != CAROM_STICK_NEVER)
        continue; /* there Euler's steps press now one ball and now the other into the cloth */
      ck_assert_double_eq_tol(euler.cloth_a[c], exact.cloth_a[c], 1e-3 * exact.normal);
      ck_assert_double_eq_tol(euler.cloth_b[c], exact.cloth_b[c], 1e-3 * exact.normal);
    }
  }
}
