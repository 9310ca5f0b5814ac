/* swift.c - the exact limit of Mathavan's model for the collisions of ordinary balls, in a hundredth of the time of Euler's
 * method.
 *
 * exact.c has the equations, and solves any collision, patiently, in double precision. Here is the same for balls whose
 * friction is mild and whose restitution is not small: nearly all. Three things make it fast.
 *
 * - Friction between the balls is some hundredths of the normal impulse, and the cloth's some hundredths of that. So what
 * friction does may be computed in single precision, four nodes of a quadrature in one register; the approach, the frame and
 * what is added to the velocities are double.
 * - The chain of dependent operations is short: an arc in the impulse p (impulse_arc.h) starts from directions that are nearly
 *   right, and one or two sweeps, each an inverse root deep, end it. Two of three collisions are a single arc.
 * - The end needs no search. v_n' = kappa - f_y times v_n says kappa d(int v_n dp) = d(v_n^2 / 2 + K) with K = int v_n dF_y:
 * with K_c at v_n = 0, restitution in the sense of work is v_n^2 = e^2 v_n0^2 + 2 (1 - e^2) K_c - 2 K. K is small; without it
 *   p = (1 + e) |v_n0| / kappa is known before the first operation, and K and F mend it by a series. K_c hardly depends on
 * where v_n = 0 is, v_n being 0 there.
 *
 * Where most of the slip between the balls is lost, arcs follow each other, each up to a share of the way to stick; near it, or
 * where stick is certain, one arc (stick_arc.h) runs to stick, and beyond it v_n has slope kappa. Where the pressed ball's slip
 * on the cloth turns close to zero, arcs are as short as its direction asks for (`clear_way`).
 *
 * What is out of range is not solved here, and the caller goes the patient way: friction beyond MILD, restitution below
 * LEAST_E, one ball ten times as heavy as the other, speeds that single precision cannot square; and all bad input. */
#include "swift/swift.h"

#include "arguments.h"
#include "impulse_arc.h"
#include "stick_arc.h"
#include "swift/rules.h"

static const float MILD_PULL = 0.15f, MILD_FRICTION = 0.25f, LEAST_E = 0.1f, HEAVY = 10, SLOWEST = 1e-9f, FASTEST = 1e9f;
/* Limits by trial on 50,000 collisions: docs/numerics.md. Shares of the way to stick: */
static const float SINGLE = 0.6f;                 /* an arc that ends the collision */
static const float ONE_OF = 0.5f;                 /* and one of several */
static const float CERTAIN = 0.97f, SURE = 1.02f; /* from where on an arc to stick is worth it, and will get there */
static const float LATE = 4;                      /* the whole way over that to stick, below which it should get there */
static const float FAR = 16,
                   NEAR = 40; /* the whole way over that to stick: 4 nodes do; they do even where stick is not reached */
static const float FELT =
    0.02f; /* mu mu_b from which the cloth moves the ends of compression and collision too much to ignore */
static const float ROOM = 4, STICK_ROOM = 3.5f, FAR_ROOM = 6; /* see `clear` */
static const float RESTING = 3e-8f;                           /* mu mu_b |d| that makes no odds, over the approach */
static const float TURN_ENOUGH = 2e-8f;                       /* error of F where d turns, over the approach */
static const float LEAST_WAY = 1e-8f;   /* impulse times friction, over the approach, that makes no odds */
static const float BEYOND = 0.02f;      /* share of an arc beyond its end that its polynomials are trusted */
static const float SERIES = 0.025f;     /* the same way, over that from the end of compression: of the series' first term */
static const float ROUGH_SLOPE = 1e-4f; /* highest coefficient of p on a stick arc whose inside is asked for */
enum { MOST_ARCS = 60 };

typedef struct state {
  pair u, d; /* slips: u_x, u_z; d_x, d_y */
  double v, p;
  pair Q, F; /* Q_1, Q_2; F_x, F_y */
  double K;
} state;
typedef struct course {
  double v_n0, e, kappa, per, mu, mu_b, s;
  double K_c; /* once `seen` */
  double p_stick;
  int seen, stuck, evaluations;
} course;

always glance look(const law *m, const state *a, float way) {
  glance g;
  const quad slips = narrow(a->u, a->d), ahead = slips - (quad){0, 0, 0, 0.5f * way}, square = ahead * ahead;
  const quad sum = square + (quad){square[1], square[0], square[3], square[2]} + NOTHING, rough = rough_inverse_root(sum),
             inverse = rough * finer(sum, rough), unit = ahead * inverse;
  g.u_x = slips[0];
  g.u_z = slips[1];
  g.d_x = slips[2];
  g.d_y = slips[3];
  g.v = (float)a->v;
  g.i = inverse[0];
  g.c = unit[0];
  g.z = unit[1];
  g.t_x = unit[2];
  g.t_y = unit[3];
  /* |u|' at first; as u turns towards z, or the cloth helps, it falls more slowly */
  const float c2 = g.c * g.c, cloth = m->mu * m->per * g.z * (2.5f * g.t_y * g.z + g.t_x * g.c);
  g.rate = (m->kappa * m->mu_b * g.i) * (2.5f + c2 + cloth) * (1 - 0.182f * c2 * (1 - c2));
  return g;
}

/* Does d, on its way of p = `way`, stay so clear of zero that its direction is smooth? The distances of zero from both ends,
 * over the length of the way, are 1 on the way itself and measure the ellipse on which t is analytic. */
always bool clear(const law *m, const glance *g, float way, float room) {
  const float e_x = g->d_x - m->mu_b * g->c * way, e_y = g->d_y - way;
  const quad far = root4((quad){g->d_x * g->d_x + g->d_y * g->d_y, e_x * e_x + e_y * e_y, 0, 0});
  return (far[0] + far[1] > room * way) | (m->pull * far[0] <= RESTING * m->unit); /* or it starts from rest */
}
/* The longest way that is clear enough: t on an arc of length w errs by about rho^-8, for 4 nodes and the ellipse's rho, and F
 * by mu mu_b w times that. */
static __attribute__((noinline)) float clear_way(law m, glance g) {
  const float d = sqrtf(g.d_x * g.d_x + g.d_y * g.d_y) + NOTHING, drag = (1 - m.spin) * m.pull * g.z / d;
  const float g_x = -m.mu_b * g.c - drag * g.d_x, g_y = m.spin * m.mu_b * g.z - 1 - drag * g.d_y,
              speed = sqrtf(g_x * g_x + g_y * g_y) + NOTHING, along = (g.d_x * g_x + g.d_y * g_y) / speed;
  const float least = LEAST_WAY * m.unit / m.pull;
  float way = 2 * d / speed;
  for (int k = 0; k < 2; k++) {
    const float error = at_most(TURN_ENOUGH * m.unit / (m.pull * way), 0.1f), rho = 1 / sqrtf(sqrtf(sqrtf(error))),
                room = 0.5f * (rho + 1 / rho);
    way = 2 * (along + room * d) / ((room * room - 1) * speed);
  }
  return way > least ? way : least;
}

/* What friction has done on the way to the slip u_x, u_z, where F has grown by F_x, F_y. */
always void add_friction(const course *s, state *a, double u_x, double u_z, double F_x, double F_y) {
  a->F += (pair){F_x, F_y};
  a->Q += (pair){(a->u[0] - u_x + F_x) * (s->per / 3.5), (a->u[1] - u_z + 2.5 * F_y) * (s->per * 0.4)};
}

/* Where the balls stick, and the speed of the end. */
typedef struct stick_point {
  double p, F_x, F_y, v, K, K_c, square_end, v_end;
} stick_point;

always stick_point stick_of(const law *m, const course *s, const glance *g, const stick_rule *r, int n, const stick_arc *q,
                            const state *a) {
  const double e2 = s->e * s->e;
  stick_point t = {.p = (double)q->per_p * q->all[0],
                   .F_x = (double)q->per_F * q->all[1],
                   .F_y = (double)q->per_F * q->all[2],
                   .K = a->K + q->all[3]};
  t.v = a->v + s->kappa * t.p - t.F_y;
  t.K_c = s->seen ? s->K_c : t.K; /* v_n = 0 was before, or comes after stick */
  if (!s->seen && t.v > 0) {
    const float weight = -q->per_F * m->per / q->per_p, left = (float)t.v * m->per / q->per_p;
    t.K_c = t.K - (double)stand_at(r, n, q, lambda_where(r, n, q, 5 + 2 * g->c * g->c, weight, left, 1)).rest[3];
  }
  t.square_end = e2 * s->v_n0 * s->v_n0 + 2 * (1 - e2) * t.K_c;
  t.v_end = sqrt(t.square_end - 2 * t.K);
  return t;
}

/* From *a to the end of the collision by an arc to stick; false if that is too rough. */
always bool end_by_stick(const law *m, course *s, const glance *g, const stick_rule *r, int n, state *a) {
  stick_arc q;
  run_stick_arc(m, g, r, n, 1 / g->rate, &q);
  s->evaluations += 8 * n * (q.sweeps + 1);
  if (!q.settled)
    return false;
  stick_point t = stick_of(m, s, g, r, n, &q, a);
  if (t.v_end < t.v) { /* it ends before */
    if (!(m->mu_b * settle_W(m, g, r, n, &q) < ROUGH_SLOPE * m->unit))
      return false;
    t = stick_of(m, s, g, r, n, &q, a);
  }
  s->K_c = t.K_c;
  if (t.v_end >= t.v) {
    s->stuck = s->seen || t.v > 0 ? 2 : 1;
    s->p_stick = a->p + t.p;
    a->p = s->p_stick + (t.v_end - t.v) * s->per;
    add_friction(s, a, 0, 0, t.F_x, t.F_y);
    return true;
  }
  const float l = lambda_where(r, n, &q, 5 + 2 * g->c * g->c, 0, (float)((t.v - t.v_end) * s->per) / q.per_p, 2);
  const stick_place at = stand_at(r, n, &q, l);
  const quad there = dots(at.basis, q.tau_x, q.tau_y, q.W, q.W, n);
  const double Y = t.F_y - (double)q.per_F * at.rest[2];
  const double p = (sqrt(t.square_end - 2 * (t.K - (double)at.rest[3])) - a->v + Y) * s->per; /* better than that of lambda */
  const float off = ((float)(t.p - p) / q.per_p - at.rest[0]) / (at.slope + NOTHING), most = 0.3f * l,
              step = off > most    ? most
                     : off < -most ? -most
                                   : off,
              end = l + step, end5 = (end * end) * (end * end) * end, stretch = end / (l + NOTHING), l4 = (l * l) * (l * l);
  a->p += p;
  s->p_stick = a->p;
  add_friction(s, a, end5 * there[2] * (stretch * stretch), end5 * g->u_z,
               t.F_x - (double)q.per_F * (at.rest[1] + l4 * there[0] * step), Y - (double)q.per_F * (l4 * there[1] * step));
  return true;
}

/* From the start to the end. */
always bool follow(const law *m, course *s, state *a) {
  const double e2 = s->e * s->e;
  double v_end = -s->e * s->v_n0, stretch = 1; /* the speed at the end, so far as K is known; correction of the way to it */
  float whole = 0, share = 1;
  int inside = 1;
  for (int arcs = 0; arcs < MOST_ARCS; arcs++) {
    const double left = (v_end - a->v) * s->per;
    double length = left * stretch;
    const glance g = look(m, a, (float)length);
    const float to_stick = g.rate * (float)length;
    if (arcs == 0)
      whole = (float)length;
    /* which arc */
    int last = 1;
    float way = (float)length;
    const int sticks = to_stick > SINGLE * share &&
                       ((to_stick > CERTAIN && inside && (to_stick > SURE || g.rate * whole > LATE)) || g.rate * whole > NEAR);
    if (to_stick > SINGLE * share) {
      last = 0;
      way = sticks ? (to_stick > 1 ? 1.1f / g.rate : way) : share * ONE_OF / g.rate;
    }
    if (!clear(m, &g, way, sticks ? STICK_ROOM : ROOM)) {
      const float most = share * clear_way(*m, g);
      if (most < way) {
        last = 0;
        way = at_most(most < 0.9f * way ? most : 0.5f * way, share * ONE_OF / g.rate);
      }
    }
    if (sticks && way >= at_most((float)length, 1 / g.rate)) {
      const int far = g.rate * whole > FAR && clear(m, &g, way, FAR_ROOM);
      if (far ? end_by_stick(m, s, &g, &stick_4, 1, a) : end_by_stick(m, s, &g, &stick_8, 2, a))
        return true;
      if (g.rate * whole > NEAR)
        return false;
      inside = 0;
      continue;
    }
    if (!last)
      length = way;
    else if (m->pull > FELT && stretch == 1) {
      const float back = m->pull * g.z * g.t_y * m->per;
      length *= 1 - back * (1 - back);
    }
    const impulse_arc q = run_impulse_arc(m, &g, &gauss_4, (float)length);
    s->evaluations += 8 * (q.sweeps + 1);
    if (!q.settled) {
      share *= 0.5f;
      continue;
    }
    const quad all = arc_integrals(&q, &gauss_4);
    const float to_v = -1 / (m->kappa * q.L);
    float x_c = g.v * to_v * (1 + q.pull * g.z * g.t_y * to_v);
    quad work = arc_work(&q, &gauss_4, x_c);
    if (m->pull > FELT) {
      x_c += (g.v + m->kappa * q.L * x_c + q.pull * work[3]) * to_v;
      work = arc_work(&q, &gauss_4, x_c);
    }
    quad end = all;
    if (last) {
      /* With v_n = 1 / n - G at the arc's end and y = kappa n (p - p_end): 2 (1 - G n) y + (1 - h) y^2 = 2 k + G n (2 - G n),
       * h = f_y / kappa; so y = G n + z, z = k + h ((G n)^2 / 2 + G n k) - (1 - h) k^2 / 2 + k^3 / 2 and little more. */
      const float n = 1 / (float)v_end, b = -(q.pull * n) * all[3] - (m->kappa * n) * (float)(length - left);
      const float k = (n * n) * ((s->seen ? 0 : (float)(1 - e2) * work[1]) - work[0]), h = work[2] * m->per * to_v * m->kappa;
      const float y = b + (k * (1 + h * (b + 0.5f * k) - 0.5f * k * (1 - k)) + 0.5f * h * b * b), dx = y * (m->per / (n * q.L));
      if (!(fabsf(dx) < BEYOND && fabsf(k) < SERIES)) {
        if (!(fabsf(dx) < 0.5f))
          return false;
        stretch = length / left * (1 + dx);
        continue;
      }
      end = arc_integrals_beyond(&q, &gauss_4, all, dx);
      a->p += length + (double)(y * (m->per / n));
    }
    const pair Q = wide_low(end) * both(s->mu_b * length), F = wide_high(end) * both(-s->mu * s->mu_b * length);
    a->Q += Q;
    a->F += F;
    if (last) {
      if (!s->seen)
        s->K_c = a->K + work[1];
      s->p_stick = a->p;
      return true;
    }
    a->p += length;
    a->u += s->kappa * (pair){-3.5, -2.5} * Q + (pair){1, 2.5} * F;
    a->d += (pair){-1, 2.5 * s->s} * Q + both(1 - 2.5 * s->s) * F - (pair){0, length};
    a->v += s->kappa * length - F[1];
    if (!s->seen && a->v >= 0) {
      s->seen = 1;
      s->K_c = a->K + work[1];
    }
    a->K += work[0];
    v_end = sqrt(e2 * s->v_n0 * s->v_n0 + 2 * (1 - e2) * (s->seen ? s->K_c : a->K) - 2 * a->K);
    stretch = 1;
    share = 1;
  }
  return false;
}

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
  course c = {
      .v_n0 = -local_v[1], .e = contact[1], .kappa = kappa[0], .per = share[0], .mu = mu[0], .mu_b = contact[0], .s = s};
  const law m = {.kappa = (float)c.kappa,
                 .per = (float)c.per,
                 .mu = (float)c.mu,
                 .mu_b = (float)c.mu_b,
                 .spin = (float)(2.5 * s),
                 .pull = (float)c.mu * (float)c.mu_b,
                 .unit = (float)(-c.v_n0 * c.per)};
  if (!(m.pull < MILD_PULL && m.mu_b < MILD_FRICTION && (float)c.e > LEAST_E && m.unit > SLOWEST && m.unit < FASTEST &&
        m.per * (HEAVY + 1) > 1 && m.per * (HEAVY + 1) < HEAVY))
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
