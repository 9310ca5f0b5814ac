/* swift.c - the exact limit of Mathavan's model for the collisions of ordinary balls, in a hundredth of the time of Euler's
 * method: checks, the frame, and back.
 *
 * exact.c has the equations, and solves any collision, patiently, in double precision. Here is the same for balls whose
 * friction is mild and whose restitution is not small: nearly all. Three things make it fast.
 *
 * - Friction between the balls is some hundredths of the normal impulse, and the cloth's some hundredths of that. So what
 *   friction does may be computed in single precision, four nodes of a quadrature in one register. The approach, the frame and
 *   what is added to the velocities are double.
 * - The chain of dependent operations is short: an arc in the impulse (impulse_arc.h) starts from directions that are nearly
 *   right, and one or two sweeps, each an inverse root deep, end it. Two of three collisions are a single arc.
 * - The end needs no search (course.h).
 *
 * What is out of range is not solved here, and the caller goes the patient way: friction beyond MILD, restitution below
 * LEAST_E, one ball HEAVY times as heavy as the other, an approach beyond SLOWEST and FASTEST; and all bad input. */
#include "swift/swift.h"

#include "arguments.h"
#include "course.h"

static const float MILD_PULL = 0.1f, MILD_FRICTION = 0.25f;                    /* mu mu_b; mu_b */
static const float MILD_CLOTH = 0.7f, LEAST_ROOM = 0.75f, FAINT_PULL = 0.001f; /* mu and kappa - mu, unless mu mu_b is faint */
static const float LEAST_E = 0.2f, HEAVY = 10, SLOWEST = 1e-9f, FASTEST = 1e9f;

/* x times the first element of v, plus y times the second */
always pair combined(pair v, pair x, pair y) {
  return rounded(first(v) * x) + rounded(second(v) * y);
}

#define SWIFT_NAME(suffix) SWIFT_JOIN(carom_swift_, suffix)
#define SWIFT_JOIN(a, b) a##b

bool SWIFT_NAME(CAROM_SWIFT_SUFFIX)(const carom_impact *in, double s, carom_result *out, carom_exact_report *report) {
  /* Numbers that would not come out as NaN are checked here, NaN and infinity at the end. */
  const pair zero = both(0), one = both(1), infinite = both(HUGE_VAL);
  const pair size_a = load(&in->a.radius), size_b = load(&in->b.radius), contact = load(&in->mu_ball),
             cloth = {in->a.mu_cloth, in->b.mu_cloth};
  const pair level = {in->b.r[2] - in->a.r[2], in->b.radius - in->a.radius}, upward = {in->a.v[2], in->b.v[2]};
  if (!all2((size_a > zero) & (size_a < infinite) & (size_b > zero) & (size_b < infinite) & (contact >= zero) &
            (contact <= one) & (cloth >= zero) & (cloth <= one)))
    return false;
  int field;
  if (!all2((level == zero) & (upward == zero)) && carom_check_impact(in, &field) != CAROM_OK)
    return false;

  /* the frame: y along the line of centres, x = y turned by -90 degrees; a vector's x and y from its table axes and back */
  const double R = in->a.radius, spin = 2.5 / R;
  const pair_mask minus = (pair_mask)both(-0.0), minus_x = {minus[0], 0}, minus_y = {0, minus[0]};
  const pair apart = load(in->b.r) - load(in->a.r), square = rounded(apart * apart),
             y = apart * both(1 / sqrt(square[0] + square[1]));
  const pair from_1 = exchanged(y), from_2 = flipped(y, minus_x), x = flipped(from_1, minus_y);
  const pair v_a = load(in->a.v), v_b = load(in->b.v), w_a = load(in->a.w), w_b = load(in->b.w);
  const pair v = v_a - v_b, local_v = combined(v, from_1, from_2), w = rounded((w_a + w_b) * x), u_z = R * (w + exchanged(w));
  const pair arm = {s * R, -s * R}, slip_a = v_a + arm * exchanged(w_a), slip_b = v_b + arm * exchanged(w_b);
  const pair_mask on_b = (pair_mask)(u_z < zero), sign = on_b & minus;
  const int b_pressed = on_b[0] != 0;
  const pair slip = chosen(on_b, slip_a, slip_b), d = flipped(combined(slip, from_1, from_2), sign);
  const double u_x = local_v[0] - R * (in->a.w[2] + in->b.w[2]);

  const double M_a = in->a.mass, M_b = in->b.mass;
  const pair other = chosen(on_b, both(M_b), both(M_a)), total = both(M_a + M_b), share = other / total, kappa = total / other,
             mu = chosen(on_b, first(cloth), second(cloth));
  const int upright = fabs(u_z[0]) <= 1e-10 * local_v[1]; /* no ball is pressed worth mentioning: as in exact.c */
  course c = {.v_n0 = -local_v[1],
              .e = contact[1],
              .kappa = kappa[0],
              .per = share[0],
              .mu = upright ? 0 : mu[0],
              .mu_b = contact[0],
              .s = s};
  const law m = {.kappa = (float)c.kappa,
                 .per = (float)c.per,
                 .mu = (float)c.mu,
                 .mu_b = (float)c.mu_b,
                 .spin = (float)(2.5 * s),
                 .pull = (float)c.mu * (float)c.mu_b,
                 .unit = (float)(-c.v_n0 * c.per)};
  if (!(m.pull < MILD_PULL && m.mu_b < MILD_FRICTION &&
        ((m.mu < MILD_CLOTH && m.kappa - m.mu > LEAST_ROOM) || m.pull < FAINT_PULL) && (float)c.e > LEAST_E &&
        m.unit > SLOWEST && m.unit < FASTEST && m.per * (HEAVY + 1) > 1 && m.per * (HEAVY + 1) < HEAVY))
    return false;
  state a = {.u = {u_x, fabs(u_z[0])}, .d = d, .v = c.v_n0};
  if (!follow(&m, &c, &a))
    return false;

  const double ratio = c.kappa - 1;
  const pair x_p = flipped(x, sign), y_p = flipped(y, sign);
  const pair dv = a.F - (pair){a.Q[0], a.p}, dw = spin * ((pair){a.F[1], -a.F[0]} - (pair){a.Q[1], 0});
  const carom_ball *pressed = b_pressed ? &in->b : &in->a, *free = b_pressed ? &in->a : &in->b;
  double *to_pressed = b_pressed ? out->v_b : out->v_a, *to_free = b_pressed ? out->v_a : out->v_b;
  const pair v_p = load(pressed->v) + combined(dv, x_p, y_p), w_p = load(pressed->w) + combined(dw, x_p, y_p),
             v_f = load(free->v) + ratio * combined((pair){a.Q[0], a.p}, x_p, y_p),
             w_f = load(free->w) - (spin * ratio) * (second(a.Q) * x_p);
  const double turn = spin * a.Q[0], z_p = pressed->w[2] + turn, z_f = free->w[2] + ratio * turn;
  store(to_pressed, v_p);
  store(to_free, v_f);
  store(to_pressed + 3, w_p);
  store(to_free + 3, w_f);
  to_pressed[2] = to_free[2] = 0;
  to_pressed[5] = z_p;
  to_free[5] = z_f;
  if (report) {
    const double M = b_pressed ? M_b : M_a, turned = b_pressed ? -1 : 1;
    *report = (carom_exact_report){.P = M * a.p,
                                   .P_ax = -M * a.Q[0],
                                   .P_az = -turned * M * a.Q[1],
                                   .P_cx = turned * M * a.F[0],
                                   .P_cy = turned * M * a.F[1],
                                   .pressed = u_z[0] > 0  ? 1
                                              : b_pressed ? -1
                                                          : 0,
                                   .work_compression = M * (0.5 * c.v_n0 * c.v_n0 - c.K_c) * c.per,
                                   .stuck = c.stuck,
                                   .P_stick = M * c.p_stick,
                                   .evaluations = c.evaluations};
    report->work_total = (1 + c.e * c.e) * report->work_compression;
  }
  return all2((((v_p + w_p) + (v_f + w_f)) + both(z_p + z_f)) * zero == zero);
}
