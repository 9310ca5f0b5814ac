/* What must hold for any collision, without a reference.
 *
 * Balance. With C = 5/(2 M R) of each ball and Δ the change over the collision, whatever
 * friction does,
 *
 *     M_i Δv_ix + M_j Δv_jx + Δw_iy/C_i + Δw_jy/C_j = 0        (the cloth's impulse along x
 *                                                              turns the pressed ball about y)
 *     M_i Δv_iy + M_j Δv_jy = ± (Δw_ix/C_i - Δw_jx/C_j)        (+ if only ball i feels the
 *                                                              cloth, - if only j does)
 *     Δw_iz/C_i = Δw_jz/C_j
 *
 * Every solver is held to all of it. Energy never rises with the paper's slip. Turning the scene
 * by a quarter turn, mirroring it and swapping the balls permute and negate numbers exactly, so
 * the results must agree in every bit.
 */
#include "ball_ball/frame.h"
#include "contact_law/impact.h"
#include "support.h"

enum { COLLISIONS = 1000 };

static carom_solver solving; /* by which solver collide() goes */

#define EACH_SOLVER \
  FOR_EACH_ISA(isa) \
  for (int which = 0; solving = (carom_solver)which, which < CAROM_SOLVER_COUNT; which++)

static carom_result collide(const carom_impact *in, carom_slip slip) {
  carom_options options = {0};
  options.solver = solving;
  carom_result out;
  options.slip = slip;
  expect_ok(carom_collide(in, &options, &out));
  return out;
}

static random_source start(void) {
  return (random_source){test_seed()};
}

static void unequal_masses(random_source *source, carom_impact *in) {
  in->b.mass = in->a.mass * pow(10.0, random_between(source, -1.0, 1.0));
}

static carom_impact after(const carom_impact *in, const carom_result *out) {
  carom_impact end = *in;
  memcpy(end.a.v, out->a.v, sizeof end.a.v);
  memcpy(end.a.w, out->a.w, sizeof end.a.w);
  memcpy(end.b.v, out->b.v, sizeof end.b.v);
  memcpy(end.b.w, out->b.w, sizeof end.b.w);
  return end;
}

static void expect_balance(const carom_impact *in, carom_slip slip) {
  const carom_result out = collide(in, slip);
  const carom_impact end = after(in, &out);
  const carom_frame frame = carom_frame_of(in);
  const carom_local b = carom_to_frame(&frame, in, slip), e = carom_to_frame(&frame, &end, slip);
  const double C_i = 5.0 / (2.0 * b.M_i * b.R), C_j = 5.0 / (2.0 * b.M_j * b.R);
  const double scale =
      (b.M_i + b.M_j) * (fabs(b.v_iy) + fabs(b.v_jy) + fabs(b.v_ix) + fabs(b.v_jx));
  const double along_x = b.M_i * (e.v_ix - b.v_ix) + b.M_j * (e.v_jx - b.v_jx) +
                         (e.w_iy - b.w_iy) / C_i + (e.w_jy - b.w_jy) / C_j;
  const double along_y = b.M_i * (e.v_iy - b.v_iy) + b.M_j * (e.v_jy - b.v_jy);
  const double about_x = (e.w_ix - b.w_ix) / C_i - (e.w_jx - b.w_jx) / C_j;
  const double about_z = (e.w_iz - b.w_iz) / C_i - (e.w_jz - b.w_jz) / C_j;
  ck_assert_double_le(fabs(along_x), 1e-11 * scale);
  ck_assert_double_le(fabs(about_z), 1e-11 * scale);
  if (in->a.mu_slide == 0.0)
    ck_assert_double_le(fabs(along_y + about_x), 1e-11 * scale);
  if (in->b.mu_slide == 0.0)
    ck_assert_double_le(fabs(along_y - about_x), 1e-11 * scale);
}

TEST(momentum_balances) {
  EACH_SOLVER {
    random_source source = start();
    for (int k = 0; k < COLLISIONS; k++) {
      carom_impact in = random_impact(&source);
      if (k % 8 >= 4)
        unequal_masses(&source, &in);
      if (k % 4 == 0 || k % 4 == 1)
        in.a.mu_slide = 0.0;
      if (k % 4 == 0 || k % 4 == 2)
        in.b.mu_slide = 0.0;
      expect_balance(&in, CAROM_SLIP_PAPER);
      expect_balance(&in, CAROM_SLIP_POOLTOOL);
    }
  }
}

static double square(const double x[3]) {
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

static double energy_of(const carom_ball *ball) {
  return 0.5 * ball->mass * (square(ball->v) + 0.4 * ball->radius * ball->radius * square(ball->w));
}

TEST(energy_never_rises) {
  EACH_SOLVER {
    random_source source = start();
    for (int k = 0; k < COLLISIONS; k++) {
      carom_impact in = random_impact(&source);
      if (k % 2 == 1)
        unequal_masses(&source, &in);
      const carom_result out = collide(&in, CAROM_SLIP_PAPER);
      const carom_impact end = after(&in, &out);
      const double before = energy_of(&in.a) + energy_of(&in.b),
                   now = energy_of(&end.a) + energy_of(&end.b);
      ck_assert_msg(now <= before * (1.0 + 1e-12), "collision %d gains %g", k, now / before - 1.0);
    }
  }
}

/* The balls part: the normal relative velocity is positive, and not more than it was. */
TEST(the_balls_part) {
  EACH_SOLVER {
    random_source source = start();
    for (int k = 0; k < COLLISIONS; k++) {
      carom_impact in = random_impact(&source);
      in.mu_ball = 0.0; /* without friction the ratio of the speeds is the restitution, up to a
                           step */
      const carom_result out = collide(&in, CAROM_SLIP_PAPER);
      const carom_impact end = after(&in, &out);
      const carom_frame frame = carom_frame_of(&in);
      const carom_local b = carom_to_frame(&frame, &in, CAROM_SLIP_PAPER),
                        e = carom_to_frame(&frame, &end, CAROM_SLIP_PAPER);
      const double ratio = -(e.v_jy - e.v_iy) / (b.v_jy - b.v_iy);
      ck_assert_double_eq_tol(ratio, in.restitution, solving == CAROM_SOLVER_EULER ? 0.05 : 1e-9);
    }
  }
}

/* A quarter turn, a mirror image in the plane x = 0, and the balls swapped. In the mirror vectors
 * lose the sign of x, and angular velocities, being axial, those of y and z. */
typedef enum { TURN, MIRROR, SWAP, IMAGES } image_kind;

static carom_impact image_of(const carom_impact *in, image_kind kind) {
  carom_impact t = *in;
  if (kind == SWAP) {
    t.a = in->b;
    t.b = in->a;
    return t;
  }
  for (int side = 0; side < 2; side++) {
    carom_ball *ball = side == 0 ? &t.a : &t.b;
    double *const vectors[] = {ball->r, ball->v, ball->w};
    for (int k = 0; k < 3; k++) {
      double *x = vectors[k];
      const double old = x[0];
      if (kind == MIRROR) {
        for (int c = 0; c < 3; c++)
          x[c] = (c == 0) != (k == 2) ? -x[c] : x[c];
      } else {
        x[0] = -x[1];
        x[1] = old;
      }
    }
  }
  return t;
}

TEST(images_are_exact) {
  EACH_SOLVER {
    random_source source = start();
    const int collisions = draws_of_test(COLLISIONS / 4, COLLISIONS);
    for (int k = 0; k < collisions; k++) {
      carom_impact in = random_impact(&source);
      if (k % 2 == 1)
        unequal_masses(&source, &in);
      for (int way = 0; way < IMAGES * CAROM_SLIP_COUNT; way++) {
        const carom_slip slip = (carom_slip)(way / IMAGES);
        const image_kind kind = (image_kind)(way % IMAGES);
        const carom_impact image = image_of(&in, kind);
        const carom_result plain = collide(&in, slip), other = collide(&image, slip);
        const carom_impact end = after(&in, &plain), seen = after(&image, &other),
                           expected = image_of(&end, kind);
        for (int c = 0; c < 26; c++)
          ck_assert_msg(((const double *)&seen)[c] == ((const double *)&expected)[c],
                        "collision %d, image %d, number %d: %.17g, not %.17g", k, (int)kind, c,
                        ((const double *)&seen)[c], ((const double *)&expected)[c]);
      }
    }
  }
}

/* Planar impacts of two balls in which friction drives the slip on the cloth, H < 0, and with it
 * any error of its direction. Where there is exactly no slip across the plane at the start, and
 * no rounding, the mirror image in the plane is the same impact. So there is no slip across it
 * in the end, and no error that friction could drive, also where b passes zero. Where a slip on
 * the cloth begins that friction would drive too strongly, there is no result. */
TEST(planar_impacts_stay_planar) {
  random_source r = {test_seed()};
  int passed_zero = 0;
  for (int n = 0; n < FEWER(4000); n++) {
    const double kappa = random_between(&r, 1.2, 4.0), mu = random_between(&r, 0.0, 1.0);
    const carom_law law = {.K_x = 3.5 * kappa,
                           .K_y = 2.5 * kappa,
                           .C_x = 1.0,
                           .C_y = 2.5,
                           .B_0 = -1.0,
                           .L_x = 1.0,
                           .L_y = -2.5,
                           .H = -1.5,
                           .g_1 = -1.0,
                           .V_0 = -kappa,
                           .V_F = 1.0,
                           .mu = mu,
                           .mu_c = random_between(&r, 0.0, 0.6),
                           .e = random_between(&r, 0.5, 1.0)};
    const double a_y = random_between(&r, 0.0, 3.0), b_y = random_between(&r, -1.0, 1.0);
    carom_trajectory path;
    carom_impact_begin(&law, 1.0, 0, 0.0, a_y, 0.0, b_y, 0.0, &path);
    const carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
    ck_assert(status == CAROM_OK || status == CAROM_ERROR_UNRESOLVED);
    ck_assert_double_eq(path.across, 0.0);
    ck_assert(path.point.a_x == 0.0 && path.point.b_x == 0.0);
    passed_zero += status == CAROM_OK && path.point.b_y * b_y <= 0.0;
  }
  ck_assert_int_gt(passed_zero, 100);
}
