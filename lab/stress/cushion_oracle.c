/* cushion_oracle.c - the impact on a cushion integrated from its impulses, in long double, with no reduction and no cleverness.
 *
 * The unknowns are the five velocities of the frame of the cushion (spins times R) and the work of the normal force; the
 * variable is the normal impulse over the mass. The right-hand side is the 2010 paper's, word for word, with friction at rest
 * found by solving the linear equations for slips that stay zero. Steps are Gragg's modified midpoint rule extrapolated eight
 * times (order 16), each a small share of the way to where a slip vanishes, so that the mesh is geometric on both sides of such
 * a point. A slip under REST is zero. What begins or ends between two steps (compression, restitution, friction that cannot
 * hold any more, a cloth without load) is located by bisection of the step.
 *
 * A slip that begins from zero does so in a direction u to which its own rate is parallel. u is found by a scan of angles and
 * bisection, and used until the slip is FRESH; the error of that is of the order of FRESH squared. */
#include "cushion_oracle.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef long double real;
enum { V_X, V_Y, W_X, W_Y, W_Z, WORK, SIZE };
enum { NOSE, CLOTH, CONTACTS };
enum { COLUMNS = 8, ANGLES = 32, BISECTIONS = 64 };
static const real REST = 1e-14L, FRESH = 1e-7L, TOLERANCE = 1e-16L, SHARE = 0.25L, LONGEST = 0.1L;
static const long MOST = 3000000; /* right-hand sides */

typedef struct model {
  real sine, cosine, mu[CONTACTS], e, rest;
  bool sticks[CONTACTS], fresh[CONTACTS], loaded;
  real u[CONTACTS][2]; /* directions of fresh slips */
  long evaluations;
} model;

/* Frictions on the ball at nose (x, t) and cloth (x, y), per unit of p. */
typedef struct forces {
  real f[CONTACTS][2];
} forces;

static void rates(const model *m, const forces *k, const real y[SIZE], real dy[SIZE]) {
  const real *f = k->f[NOSE], *F = k->f[CLOTH];
  dy[V_X] = f[0] + F[0];
  dy[V_Y] = -m->cosine - m->sine * f[1] + F[1];
  dy[W_X] = 2.5L * (f[1] + F[1]);
  dy[W_Y] = 2.5L * (m->sine * f[0] - F[0]);
  dy[W_Z] = -2.5L * m->cosine * f[0];
  dy[WORK] = y[V_Y] * m->cosine;
}

/* Also of rates. */
static void slip(const model *m, int contact, const real y[SIZE], real s[2]) {
  if (contact == NOSE) {
    s[0] = y[V_X] + m->sine * y[W_Y] - m->cosine * y[W_Z];
    s[1] = y[W_X] - m->sine * y[V_Y];
  } else {
    s[0] = y[V_X] - y[W_Y];
    s[1] = y[V_Y] + y[W_X];
  }
}

static real load(const model *m, const forces *k) {
  return m->sine - m->cosine * k->f[NOSE][1];
}

static real size(const real s[2]) {
  return sqrtl(s[0] * s[0] + s[1] * s[1]);
}

/* Solves a x = b, n at most 4, by elimination with pivots. */
static bool solve(int n, real a[4][4], real b[4]) {
  for (int c = 0; c < n; c++) {
    int best = c;
    for (int r = c + 1; r < n; r++)
      if (fabsl(a[r][c]) > fabsl(a[best][c]))
        best = r;
    if (a[best][c] == 0)
      return false;
    for (int j = 0; j < n; j++) {
      const real swap = a[c][j];
      a[c][j] = a[best][j];
      a[best][j] = swap;
    }
    const real swap = b[c];
    b[c] = b[best];
    b[best] = swap;
    for (int r = 0; r < n; r++) {
      const real share = r != c ? a[r][c] / a[c][c] : 0;
      for (int j = c; j < n; j++)
        a[r][j] -= share * a[c][j];
      b[r] -= share * b[c];
    }
  }
  for (int c = 0; c < n; c++)
    b[c] /= a[c][c];
  return true;
}

/* Frictions of contacts that slip, in the directions u; those that stick keep what is in *k. */
static void slide(const model *m, real u[CONTACTS][2], forces *k) {
  for (int i = 0; i < 2 && !m->sticks[NOSE]; i++)
    k->f[NOSE][i] = -m->mu[NOSE] * u[NOSE][i];
  const real g = m->loaded ? load(m, k) : 0;
  for (int i = 0; i < 2 && !m->sticks[CLOTH]; i++)
    k->f[CLOTH][i] = -m->mu[CLOTH] * g * u[CLOTH][i];
}

/* All frictions, given the directions: those that hold are the solution of linear equations, whose columns are found by trying.
 */
static bool all_forces(const model *m, real u[CONTACTS][2], forces *k) {
  int unknown[4], n = 0;
  const real still[SIZE] = {0};
  for (int j = 0; j < 2 * CONTACTS; j++)
    if (m->sticks[j / 2])
      unknown[n++] = j;
  real a[4][4], b[4];
  for (int c = n; c >= 0; c--) { /* the columns, and last the right-hand side */
    *k = (forces){0};
    if (c < n)
      k->f[unknown[c] / 2][unknown[c] % 2] = 1;
    slide(m, u, k);
    real dy[SIZE], rate[CONTACTS][2];
    rates(m, k, still, dy);
    for (int contact = 0; contact < CONTACTS; contact++)
      slip(m, contact, dy, rate[contact]);
    for (int r = 0; r < n; r++) {
      const real value = rate[unknown[r] / 2][unknown[r] % 2];
      if (c < n)
        a[r][c] = value;
      else
        b[r] = value;
    }
  }
  /* a held the rates with one unit each; without, they are b */
  for (int r = 0; r < n; r++)
    for (int c = 0; c < n; c++)
      a[r][c] -= b[r];
  for (int r = 0; r < n; r++)
    b[r] = -b[r];
  if (n > 0 && !solve(n, a, b))
    return false;
  *k = (forces){0};
  for (int c = 0; c < n; c++)
    k->f[unknown[c] / 2][unknown[c] % 2] = b[c];
  slide(m, u, k);
  return true;
}

/* The rate of a slip across and along a direction of a given angle. */
static void rate_at(const model *m, real u[CONTACTS][2], int contact, real angle, real *across, real *along) {
  const real still[SIZE] = {0};
  forces k;
  real dy[SIZE], rate[2];
  u[contact][0] = cosl(angle);
  u[contact][1] = sinl(angle);
  all_forces(m, u, &k);
  rates(m, &k, still, dy);
  slip(m, contact, dy, rate);
  *across = rate[1] * u[contact][0] - rate[0] * u[contact][1];
  *along = rate[0] * u[contact][0] + rate[1] * u[contact][1];
}

/* Turns u of a contact to a direction that its rate is parallel to. */
static bool find_direction(const model *m, real u[CONTACTS][2], int contact) {
  const real step = 2 * acosl(-1.0L) / ANGLES, at = atan2l(u[contact][1], u[contact][0]);
  real best = -INFINITY, found = 0;
  for (int k = 0; k < ANGLES; k++) {
    real low = at + ((real)k - 0.5L) * step, high = low + step, across, along, other;
    rate_at(m, u, contact, low, &across, &along);
    rate_at(m, u, contact, high, &other, &along);
    if (!(across >= 0 && other < 0))
      continue;
    for (int j = 0; j < BISECTIONS; j++) {
      const real middle = (low + high) / 2;
      rate_at(m, u, contact, middle, &across, &along);
      *(across >= 0 ? &low : &high) = middle;
    }
    rate_at(m, u, contact, low, &across, &along);
    if (along > best) {
      best = along;
      found = low;
    }
  }
  u[contact][0] = cosl(found);
  u[contact][1] = sinl(found);
  return best >= -1e-12L; /* at the boundary of the cone it is zero */
}

/* Directions of all slips at y. */
static bool directions(const model *m, const real y[SIZE], real u[CONTACTS][2]) {
  memcpy(u, m->u, sizeof m->u);
  for (int contact = 0; contact < CONTACTS; contact++) {
    real s[2];
    slip(m, contact, y, s);
    const real length = size(s);
    if (!m->sticks[contact] && !m->fresh[contact] && length > 0) {
      u[contact][0] = s[0] / length;
      u[contact][1] = s[1] / length;
    }
  }
  bool good = true;
  for (int round = 0; round < (m->fresh[NOSE] && m->fresh[CLOTH] ? 8 : 1); round++)
    for (int contact = 0; contact < CONTACTS; contact++)
      if (m->fresh[contact])
        good &= find_direction(m, u, contact);
  return good;
}

static void slope(model *m, const real y[SIZE], real dy[SIZE]) {
  real u[CONTACTS][2];
  forces k;
  m->evaluations++;
  directions(m, y, u);
  all_forces(m, u, &k);
  rates(m, &k, y, dy);
}

/* One extrapolated step; returns the estimate of its error. */
static real try_step(model *m, const real y[SIZE], real H, real out[SIZE]) {
  real row[SIZE][COLUMNS], f[SIZE], error = 0;
  slope(m, y, f);
  for (int k = 0; k < COLUMNS; k++) {
    /* Gragg's rule with n substeps */
    const int n = 2 * (k + 1);
    const real h = H / (real)n;
    real before[SIZE], now[SIZE], d[SIZE];
    for (int i = 0; i < SIZE; i++) {
      before[i] = y[i];
      now[i] = y[i] + h * f[i];
    }
    for (int j = 1; j < n; j++) {
      slope(m, now, d);
      for (int i = 0; i < SIZE; i++) {
        const real next = before[i] + 2 * h * d[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
    slope(m, now, d);
    /* the next row of the table of Aitken and Neville, over the last one */
    error = 0;
    for (int i = 0; i < SIZE; i++) {
      real value = (now[i] + before[i] + h * d[i]) / 2;
      for (int j = 0; j < k; j++) {
        const real ratio = (real)(k + 1) / (real)(k - j), better = value + (value - row[i][j]) / (ratio * ratio - 1);
        row[i][j] = value;
        if (j == k - 1)
          error = fmaxl(error, fabsl(better - value));
        value = better;
      }
      row[i][k] = value;
      out[i] = value;
    }
  }
  return error;
}

/* What follows where a slip is zero: it sticks if the friction that this takes is inside the cone. */
static bool decide(model *m, real y[SIZE]) {
  bool zero[CONTACTS];
  for (int contact = 0; contact < CONTACTS; contact++) {
    real s[2];
    slip(m, contact, y, s);
    zero[contact] = m->mu[contact] > 0 && size(s) <= m->rest;
  }
  for (int choice = 3; choice >= 0; choice--) {
    if (((choice & 1) != 0 && !zero[NOSE]) || ((choice & 2) != 0 && !zero[CLOTH]))
      continue;
    m->sticks[NOSE] = (choice & 1) != 0;
    m->sticks[CLOTH] = (choice & 2) != 0;
    m->fresh[NOSE] = zero[NOSE] && !m->sticks[NOSE];
    m->fresh[CLOTH] = zero[CLOTH] && !m->sticks[CLOTH];
    for (int loaded = 1; loaded >= 0; loaded--) {
      real u[CONTACTS][2];
      forces k;
      m->loaded = loaded;
      if (!directions(m, y, u) || !all_forces(m, u, &k) || (load(m, &k) > 0) != (loaded == 1))
        continue;
      if ((m->sticks[NOSE] && size(k.f[NOSE]) >= m->mu[NOSE]) ||
          (m->sticks[CLOTH] && !(load(m, &k) > 0 && size(k.f[CLOTH]) < m->mu[CLOTH] * load(m, &k))))
        continue;
      memcpy(m->u, u, sizeof m->u);
      return true;
    }
  }
  return false;
}

/* Whether what holds at y is no longer the regime. */
static bool violated(model *m, const real y[SIZE]) {
  real u[CONTACTS][2];
  forces k;
  directions(m, y, u);
  all_forces(m, u, &k);
  const real g = load(m, &k);
  return (m->sticks[NOSE] && size(k.f[NOSE]) >= m->mu[NOSE]) ||
         (m->sticks[CLOTH] && !(g > 0 && size(k.f[CLOTH]) < m->mu[CLOTH] * g)) || (g > 0) != m->loaded;
}

/* The longest step that the slips allow. */
static real longest(model *m, const real y[SIZE]) {
  real dy[SIZE], s[2], rate[2], H = LONGEST / m->cosine;
  slope(m, y, dy);
  for (int contact = 0; contact < CONTACTS; contact++) {
    slip(m, contact, y, s);
    slip(m, contact, dy, rate);
    const bool counts = !m->sticks[contact] && m->mu[contact] > 0 && (contact == NOSE || m->loaded);
    if (counts && size(rate) > 0)
      H = fminl(H, m->fresh[contact] ? 0.7L * FRESH / size(rate) : SHARE * size(s) / size(rate));
  }
  return H;
}

/* After a step: slips that are no longer fresh, or have come to rest. */
static bool sort_slips(model *m, const real y[SIZE]) {
  real dy[SIZE], s[2], rate[2];
  bool rests = false;
  slope(m, y, dy);
  for (int contact = 0; contact < CONTACTS; contact++) {
    slip(m, contact, y, s);
    slip(m, contact, dy, rate);
    const bool falls = s[0] * rate[0] + s[1] * rate[1] < 0;
    if (m->fresh[contact] && size(s) > FRESH / 2)
      m->fresh[contact] = false;
    else if (!m->sticks[contact] && m->mu[contact] > 0 && (contact == NOSE || m->loaded) && size(s) <= m->rest && falls)
      rests = true;
  }
  return rests;
}

/* Whether a fresh slip is larger than it may be for that. */
static bool outgrown(const model *m, const real y[SIZE]) {
  bool large = false;
  for (int contact = 0; contact < CONTACTS; contact++) {
    real s[2];
    slip(m, contact, y, s);
    large |= m->fresh[contact] && size(s) > FRESH;
  }
  return large;
}

/* From contact to parting, in units of the approach. */
static carom_status integrate(model *m, real y[SIZE]) {
  if (!decide(m, y))
    return CAROM_ERROR_UNRESOLVED;
  bool in_restitution = false;
  real work_c = 0, next = LONGEST;
  while (m->evaluations < MOST) {
    if (m->sticks[NOSE] && m->sticks[CLOTH])
      return CAROM_OK; /* wedged: nothing changes any more */
    real out[SIZE], H = fminl(longest(m, y), next), error;
    while (((error = try_step(m, y, H, out)) > TOLERANCE * (1 + m->rest / REST) || outgrown(m, out)) && H > 1e-19L)
      H /= 2;
    next = 2 * H;
    /* the end of the phase or of the regime inside the step: the first point where either holds */
    const real target = (1 - m->e * m->e) * work_c;
    bool ends = in_restitution ? out[WORK] <= target : out[V_Y] <= 0, breaks = violated(m, out);
    if (ends || breaks) {
      real low = 0, high = H;
      for (int k = 0; k < BISECTIONS && high - low > 1e-19L; k++) {
        const real middle = (low + high) / 2;
        try_step(m, y, middle, out);
        const bool end_here = in_restitution ? out[WORK] <= target : out[V_Y] <= 0, break_here = violated(m, out);
        if (end_here || break_here) {
          high = middle;
          ends = end_here;
          breaks = break_here;
        } else
          low = middle;
      }
      try_step(m, y, high, out);
    }
    memcpy(y, out, sizeof out);
    if (ends && in_restitution)
      return CAROM_OK;
    if (ends) {
      in_restitution = true;
      work_c = y[WORK];
      if (m->e == 0)
        return CAROM_OK;
    }
    if (sort_slips(m, y) || breaks) {
      if (!decide(m, y))
        return CAROM_ERROR_UNRESOLVED;
      next = LONGEST;
    }
  }
  return CAROM_ERROR_UNRESOLVED;
}

carom_status cushion_oracle(const carom_cushion_impact *in, carom_motion *out) {
  const real length = hypotl(in->normal[0], in->normal[1]), X = in->normal[1] / length, Y = in->normal[0] / length;
  const real R = in->radius, v_x = in->v[0] * X - in->v[1] * Y, v_y = in->v[0] * Y + in->v[1] * X;
  if (v_y <= 0) {
    memcpy(out->v, in->v, sizeof out->v);
    memcpy(out->w, in->w, sizeof out->w);
    return CAROM_SEPARATING;
  }
  model m = {.sine = (in->height - R) / R, .mu = {in->mu_cushion, in->mu_cloth}, .e = in->restitution, .loaded = true};
  m.cosine = sqrtl(1 - m.sine * m.sine);
  real y[SIZE] = {v_x / v_y, 1, R * (in->w[0] * X - in->w[1] * Y) / v_y, R * (in->w[0] * Y + in->w[1] * X) / v_y,
                  R * in->w[2] / v_y};
  m.rest = REST * (1 + fabsl(y[V_X]) + fabsl(y[W_X]) + fabsl(y[W_Y]) + fabsl(y[W_Z]));
  const carom_status status = integrate(&m, y);
  for (int k = 0; k < WORK; k++)
    y[k] *= v_y;
  *out = (carom_motion){
      .v = {(double)(y[V_X] * X + y[V_Y] * Y), (double)(y[V_Y] * X - y[V_X] * Y), 0},
      .w = {(double)((y[W_X] * X + y[W_Y] * Y) / R), (double)((y[W_Y] * X - y[W_X] * Y) / R), (double)(y[W_Z] / R)}};
  return status;
}

/* ---- Random impacts */

static double between(uint64_t *state, double low, double high) {
  /* splitmix64 */
  uint64_t z = (*state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return low + (high - low) * ((double)((z ^ (z >> 31)) >> 11) * 0x1p-53);
}

carom_cushion_impact draw_cushion(cushion_draw kind, uint64_t seed, uint64_t k) {
  uint64_t state = seed * 0x2545f4914f6cdd1du + k * 0x9e3779b97f4a7c15u;
  const bool any = kind == CUSHION_ANY;
  const double degree = 3.14159265358979323846 / 180, speed = between(&state, 0.05, 5),
               turn = between(&state, -180, 180) * degree;
  /* from square to grazing, on both sides */
  const double angle = between(&state, -89.5, 89.5) * degree, spin = any ? 300 : 100;
  carom_cushion_impact in = {.normal = {cos(turn), sin(turn)},
                             .v = {speed * cos(turn + angle), speed * sin(turn + angle)},
                             .radius = between(&state, 0.025, 0.031),
                             .mass = between(&state, 0.13, 0.21),
                             .mu_cloth = any ? between(&state, 0, 1) : between(&state, 0.1, 0.4),
                             .mu_cushion = any ? between(&state, 0, 1) : between(&state, 0.1, 0.4),
                             .restitution = any ? between(&state, 0, 1) : between(&state, 0.6, 1),
                             .jaw_radius = between(&state, 0, 1) < 0.5 ? 0 : between(&state, 0.005, 0.03)};
  in.height = in.radius * (any ? between(&state, 0.9, 1.6) : between(&state, 1.2, 1.45));
  for (int c = 0; c < 3; c++)
    in.w[c] = between(&state, -spin, spin);
  const double what = between(&state, 0, 1);
  if (what < 0.3) { /* a rolling ball, with side */
    in.w[0] = -in.v[1] / in.radius;
    in.w[1] = in.v[0] / in.radius;
  } else if (what < 0.4) { /* a perpendicular one, with top or draw but no side */
    const double top = between(&state, -1, 1) * spin;
    in = (carom_cushion_impact){.v = {0, speed, 0},
                                .w = {what < 0.35 ? top : -speed / in.radius, 0, 0},
                                .normal = {0, 1},
                                .height = in.height,
                                .radius = in.radius,
                                .mass = in.mass,
                                .mu_cloth = in.mu_cloth,
                                .mu_cushion = in.mu_cushion,
                                .restitution = in.restitution};
  } else if (what < 0.5) /* a ball that slides without spin */
    in.w[0] = in.w[1] = in.w[2] = 0;
  return in;
}

double cushion_distance(const carom_cushion_impact *in, const carom_motion *a, const carom_motion *b) {
  double most = 0, scale = 0;
  for (int c = 0; c < 3; c++) {
    most = fmax(most, fmax(fabs(a->v[c] - b->v[c]), in->radius * fabs(a->w[c] - b->w[c])));
    scale = fmax(scale, fmax(fabs(in->v[c]), in->radius * fabs(in->w[c])));
  }
  return most / scale;
}
