/* oracle.c - the collision integrated from its impulses, with no reduction and no cleverness.
 *
 * The unknowns are the ten velocities of the collision frame and the signed work S = int v_n dP; the independent variable
 * is the normal impulse P. The right-hand side is the impulse model word for word (both balls, both cloth contacts), in
 * long double. Steps are Gragg's modified midpoint rule extrapolated eight times (order 16). The right-hand side is smooth
 * except where a slip vanishes; no step is longer than a fixed share of the way to such a point, so the mesh is geometric
 * on both sides of it, and the last 1e-13 (cloth) or 1e-15 (ball) of the way is crossed in one stride, which costs an error
 * of that size. Two events are landed on: v_n = 0, which fixes the work of compression, and S = (1 - e^2) S_min, the end. */
#include "oracle.h"
#include <math.h>
#include <string.h>

enum { V_IX, V_IY, W_IX, W_IY, W_IZ, V_JX, V_JY, W_JX, W_JY, W_JZ, WORK, SIZE };
enum { COLUMNS = 8 };
typedef long double real;

typedef struct model {
  real M_i, M_j, R, mu_b, mu_i, mu_j, s;
  real cloth_zero; /* cloth slips under this count as none: their direction is that of their derivative */
  int stuck;
  long evaluations;
} model;

typedef struct slips {
  real u_x, u_z, d_x, d_y, b_x, b_y, v_n;
} slips;

static slips slips_of(const model *m, const real y[SIZE]) {
  slips k;
  k.u_x = y[V_IX] - y[V_JX] - m->R * (y[W_IZ] + y[W_JZ]);
  k.u_z = m->R * (y[W_IX] + y[W_JX]);
  k.d_x = y[V_IX] + m->s * m->R * y[W_IY];
  k.d_y = y[V_IY] - m->s * m->R * y[W_IX];
  k.b_x = y[V_JX] + m->s * m->R * y[W_JY];
  k.b_y = y[V_JY] - m->s * m->R * y[W_JX];
  k.v_n = y[V_JY] - y[V_IY];
  return k;
}

/* Rates per unit P from the six friction impulses per unit P. */
static void rates(const model *m, real P1, real P2, real P_ix, real P_iy, real P_jx, real P_jy, real v_n, real f[SIZE]) {
  const real C_i = 5 / (2 * m->M_i * m->R), C_j = 5 / (2 * m->M_j * m->R);
  f[V_IX] = (P1 + P_ix) / m->M_i;
  f[V_IY] = (-1 + P_iy) / m->M_i;
  f[W_IX] = C_i * (P2 + P_iy);
  f[W_IY] = -C_i * P_ix;
  f[W_IZ] = -C_i * P1;
  f[V_JX] = (-P1 + P_jx) / m->M_j;
  f[V_JY] = (1 + P_jy) / m->M_j;
  f[W_JX] = C_j * (P2 + P_jy);
  f[W_JY] = -C_j * P_jx;
  f[W_JZ] = -C_j * P1;
  f[WORK] = v_n;
}

static void slope(model *m, const real y[SIZE], real f[SIZE]) {
  const slips k = slips_of(m, y);
  const real u = hypotl(k.u_x, k.u_z);
  m->evaluations++;
  if (m->stuck || u == 0) {
    rates(m, 0, 0, 0, 0, 0, 0, k.v_n, f);
    return;
  }
  const real P1 = -m->mu_b * k.u_x / u, P2 = -m->mu_b * k.u_z / u;
  if (P2 == 0) {
    rates(m, P1, P2, 0, 0, 0, 0, k.v_n, f);
    return;
  }
  const int on_j = P2 > 0;
  real t_x = on_j ? k.b_x : k.d_x, t_y = on_j ? k.b_y : k.d_y, t = hypotl(t_x, t_y);
  if (t <= m->cloth_zero) { /* at rest: the slip is about to grow along its own derivative, taken without cloth friction */
    rates(m, P1, P2, 0, 0, 0, 0, k.v_n, f);
    const slips g = slips_of(m, f);
    t_x = on_j ? g.b_x : g.d_x;
    t_y = on_j ? g.b_y : g.d_y;
    t = hypotl(t_x, t_y);
    if (t == 0)
      return;
  }
  if (on_j)
    rates(m, P1, P2, 0, 0, -m->mu_j * P2 * t_x / t, -m->mu_j * P2 * t_y / t, k.v_n, f);
  else
    rates(m, P1, P2, m->mu_i * P2 * t_x / t, m->mu_i * P2 * t_y / t, 0, 0, k.v_n, f);
}

/* One extrapolated step of length h; returns the largest difference of the last two estimates, in m/s. */
static real step(model *m, const real y[SIZE], real h, real out[SIZE]) {
  real table[COLUMNS][SIZE], f0[SIZE], error = 0;
  slope(m, y, f0);
  for (int c = 0; c < COLUMNS; c++) {
    const int n = 2 * (c + 1);
    const real dh = h / n;
    real a[SIZE], b[SIZE], f[SIZE], estimate[SIZE];
    for (int q = 0; q < SIZE; q++) {
      a[q] = y[q];
      b[q] = y[q] + dh * f0[q];
    }
    for (int k = 1; k < n; k++) {
      slope(m, b, f);
      for (int q = 0; q < SIZE; q++) {
        const real next = a[q] + 2 * dh * f[q];
        a[q] = b[q];
        b[q] = next;
      }
    }
    slope(m, b, f);
    for (int q = 0; q < SIZE; q++)
      estimate[q] = (a[q] + b[q] + dh * f[q]) / 2;
    for (int j = 0; j < c; j++) { /* Aitken-Neville; table[j] held the row above */
      const real ratio = (real)n / (2 * (c - j)), w = 1 / (ratio * ratio - 1);
      for (int q = 0; q < SIZE; q++) {
        const real better = estimate[q] + w * (estimate[q] - table[j][q]);
        table[j][q] = estimate[q];
        estimate[q] = better;
      }
    }
    if (c == COLUMNS - 1)
      for (int q = 0; q < SIZE; q++) {
        const real size = q >= W_IX && q <= W_IZ ? m->R : q >= W_JX && q <= W_JZ ? m->R : q == WORK ? 0 : 1;
        error = fmaxl(error, size * fabsl(estimate[q] - table[c - 1][q]));
      }
    memcpy(table[c], estimate, sizeof estimate);
  }
  memcpy(out, table[COLUMNS - 1], sizeof table[COLUMNS - 1]);
  return error;
}

/* Shrinks h until event(out) is 0: sign says v_n (0) or work minus `target` (1). The event lies inside (0, h]. */
static void land(model *m, const real y[SIZE], real h, int on_work, real target, real out[SIZE], real *used) {
  real low = 0, high = h, x = h;
  for (int k = 0; k < 100; k++) {
    step(m, y, x, out);
    const slips g = slips_of(m, out);
    const real value = on_work ? out[WORK] - target : g.v_n;
    if (value > 0)
      high = x;
    else
      low = x;
    real f[SIZE];
    slope(m, out, f);
    const real rate = on_work ? g.v_n : f[V_JY] - f[V_IY];
    real next = rate > 0 ? x - value / rate : (low + high) / 2;
    if (!(next > low && next < high))
      next = (low + high) / 2;
    if (value == 0 || fabsl(next - x) <= 1e-19L * h)
      break;
    x = next;
  }
  *used = x;
}

int oracle_collide(const carom_impact *in, double s, carom_result *out, oracle_story *story) {
  const carom_ball *a = &in->a, *b = &in->b;
  real e_y[3], e_x[3], length = 0;
  for (int k = 0; k < 3; k++) {
    e_y[k] = (real)b->r[k] - a->r[k];
    length += e_y[k] * e_y[k];
  }
  for (int k = 0; k < 3; k++)
    e_y[k] /= sqrtl(length);
  e_x[0] = e_y[1];
  e_x[1] = -e_y[0];
  e_x[2] = 0;

  real y[SIZE] = {0};
  for (int k = 0; k < 3; k++) {
    y[V_IX] += a->v[k] * e_x[k];
    y[V_IY] += a->v[k] * e_y[k];
    y[W_IX] += a->w[k] * e_x[k];
    y[W_IY] += a->w[k] * e_y[k];
    y[V_JX] += b->v[k] * e_x[k];
    y[V_JY] += b->v[k] * e_y[k];
    y[W_JX] += b->w[k] * e_x[k];
    y[W_JY] += b->w[k] * e_y[k];
  }
  y[W_IZ] = a->w[2];
  y[W_JZ] = b->w[2];

  model m = {a->mass, b->mass, a->radius, in->mu_ball, a->mu_cloth, b->mu_cloth, s, 0, 0, 0};
  const slips start = slips_of(&m, y);
  const real M = 1 / (1 / m.M_i + 1 / m.M_j), P_unit = M * -start.v_n, e2 = (real)in->restitution * in->restitution;
  const int on_j = start.u_z < 0;
  const real dv_unit = P_unit / (on_j ? m.M_j : m.M_i); /* how much the pressed ball's slip changes, about */
  const real u_start = hypotl(start.u_x, start.u_z);
  real speed = 0; /* the largest speed about: rounding is relative to it */
  for (int q = 0; q < WORK; q++)
    speed = fmaxl(speed, fabsl(y[q]) * (q >= V_JX ? (q >= W_JX ? m.R : 1) : (q >= W_IX ? m.R : 1)));
  m.cloth_zero = fmaxl(1e-13L * dv_unit, 1e-18L * speed);
  oracle_story tale = {0};
  tale.slip_left = 1;
  tale.cloth_slip_min = (double)(on_j ? hypotl(start.b_x, start.b_y) : hypotl(start.d_x, start.d_y));
  real P = 0, S_end = 0, h_next = P_unit, P_stick = -1;
  int restitution = 0;
  for (long count = 0;; count++) {
    if (count > 100000)
      return -1;
    real f[SIZE], h = fminl(h_next, P_unit / 2), next[SIZE];
    slope(&m, y, f);
    const slips k = slips_of(&m, y), g = slips_of(&m, f);
    const real u = hypotl(k.u_x, k.u_z), du = hypotl(g.u_x, g.u_z);
    tale.slip_left = fmin(tale.slip_left, u_start > 0 ? (double)(u / u_start) : 0);
    if (!m.stuck && u <= fmaxl(1e-15L * du * P_unit, 2e-18L * speed)) {
      m.stuck = 1;
      P_stick = P;
      tale.stuck = restitution ? 2 : 1;
      continue;
    }
    if (!m.stuck) {
      if (du > 0)
        h = fminl(h, 0.3L * u / du);
      const real t = on_j ? hypotl(k.b_x, k.b_y) : hypotl(k.d_x, k.d_y),
                 dt = on_j ? hypotl(g.b_x, g.b_y) : hypotl(g.d_x, g.d_y);
      tale.cloth_slip_min = fmin(tale.cloth_slip_min, (double)t);
      if (k.u_z != 0 && dt > 0)
        h = fminl(h, fmaxl(0.3L * t / dt, 2.2L * m.cloth_zero / dt));
    }
    real error;
    while (error = step(&m, y, h, next), error > -1e-16L * start.v_n + 2e-18L * speed && h > 1e-14L * P_unit)
      h /= 2;
    h_next = 2 * h;
    const real v_n = slips_of(&m, next).v_n;
    if (!restitution && v_n >= 0) {
      land(&m, y, h, 0, 0, next, &h);
      memcpy(y, next, sizeof y);
      P += h;
      tale.W_c = (double)-y[WORK];
      S_end = (1 - e2) * y[WORK];
      restitution = 1;
      if (in->restitution <= 0)
        break;
      continue;
    }
    if (restitution && next[WORK] >= S_end) {
      land(&m, y, h, 1, S_end, next, &h);
      memcpy(y, next, sizeof y);
      P += h;
      break;
    }
    memcpy(y, next, sizeof y);
    P += h;
  }
  tale.P = (double)P;
  tale.P_stick = (double)(P_stick < 0 ? P : P_stick);
  tale.W_f = (1 + in->restitution * in->restitution) * tale.W_c;
  tale.evaluations = m.evaluations;
  if (story)
    *story = tale;
  for (int k = 0; k < 3; k++) {
    out->a.v[k] = (double)(y[V_IX] * e_x[k] + y[V_IY] * e_y[k]);
    out->b.v[k] = (double)(y[V_JX] * e_x[k] + y[V_JY] * e_y[k]);
    out->a.w[k] = k == 2 ? (double)y[W_IZ] : (double)(y[W_IX] * e_x[k] + y[W_IY] * e_y[k]);
    out->b.w[k] = k == 2 ? (double)y[W_JZ] : (double)(y[W_JX] * e_x[k] + y[W_JY] * e_y[k]);
  }
  return 0;
}
