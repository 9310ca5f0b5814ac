/* The impact integrated from impulses and momenta, in long double, by an implicit method that
 * needs no regimes.
 *
 * MECHANICS. A ball of mass m, radius 1 and moment of inertia 2/5 m has the velocity v and the
 * spin w (times the radius). A force F at the point r of its surface changes v by F/m and w by
 * 5/2 (r x F)/m; the surface at r has the velocity v + w x r. There are two contacts with
 * friction: the DRIVING contact, where a normal impulse p pushes, and the CLOTH under the ball
 * that is pressed down. Their slips s (two numbers each) and the speed of approach v are linear
 * in the impulses, so
 *
 *     s' = S_p + S_f f        v' = v_p + v_f f        f the four frictions per unit of p, the prime
 *                                                     the derivative by p.
 *
 * The coefficients are found by applying one unit of each impulse to balls at rest.
 *
 * FRICTION. Coulomb's law, made smooth: f = -mu N s / sqrt(|s|^2 + eps^2), N being 1 at the
 * driving contact and the load at the cloth, which is max(0, g_0 + g_1 f_y). For eps -> 0 that
 * is Coulomb's law with sticking and all: a contact that sticks creeps by less than eps. So
 * nothing needs to be decided where a slip vanishes, both vanish, or friction holds no longer.
 * The price is stiffness, 1/eps, which the implicit method takes. eps is 1e-12 of the approach
 * or less.
 *
 * METHOD. Radau IIA, eight stages, order 15, L-stable; stages by Newton's method. A step is
 * accepted if the highest two Legendre coefficients of the frictions over the step are small,
 * and their polynomials are right at its start. Three events are located by repeating a step
 * with other lengths: the end of compression, v = 0; the end of the impact, where e^2 of the
 * work of compression is returned; and a load that passes zero.
 *
 * CHECKS. Each impact is integrated with tolerances and eps that tighten until two solutions in
 * a row agree, and again with initial slips and approach changed by about one rounding error of
 * the input. */
#include "reference.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef long double real;
enum { STAGES = 8, SLIPS = 4, UNKNOWNS = STAGES * SLIPS };
enum { NEWTON_MOST = 25, STEPS_MOST = 4000, ROOT_MOST = 100, LEVELS = 4 };
static const real AGREED = 1e-11L;    /* difference of two solutions that ends the tightening, */
static const real TOO_FAR = 1e-8L;    /* and above which there is no result */
static const real TOO_SHAKY = 1e-7L;  /* change by one rounding error above which the result
                                         depends on rounding */
static const real ROUNDING = 3e-16L;  /* of the input */
static const real START_SHARE = 0.1L; /* of an error at the start of a step, in its estimate */
static const real KEPT = 0.1L;        /* fall of Newton's corrections for which its matrix is
                                         kept */
static const real CONVERGED = 1e-17L; /* change of the impulses of a step */

/* Tolerances of one integration. */
typedef struct tolerances {
  real rate;    /* highest coefficients of the rates of a step, */
  real impulse; /* and times its length: either is enough */
  real eps;     /* of the friction law */
} tolerances;
static const tolerances level_of[LEVELS] = {{1e-6L, 1e-14L, 1e-12L},
                                            {1e-7L, 1e-15L, 1e-13L},
                                            {1e-9L, 1e-16L, 1e-14L},
                                            {1e-11L, 1e-17L, 1e-15L}};

/* ---- Mechanics ---- */

typedef struct vector {
  real x, y, z;
} vector;

typedef struct body {
  vector v, w;
  real m;
} body;

static vector cross(vector a, vector b) {
  return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static real dot(vector a, vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector sum(vector a, real share, vector b) {
  return (vector){a.x + share * b.x, a.y + share * b.y, a.z + share * b.z};
}

/* A force at r on the surface, but for what it does to the vertical motion: the table or the
 * ball's weight sees to that. */
static void push(body *b, vector r, vector force) {
  b->v = sum(b->v, 1 / b->m, (vector){force.x, force.y, 0});
  b->w = sum(b->w, 2.5L / b->m, cross(r, force));
}

static vector surface(const body *b, vector r) {
  return sum(b->v, 1, cross(b->w, r));
}

static const vector BOTTOM = {0, 0, -1};

/* Who meets whom: two balls, the second at +y of the first; or ball 0 and a cushion. */
typedef struct meeting {
  body ball[2];
  bool cushion;
  int pressed;     /* the ball whose contact with the cloth has friction, */
  real spin_sign;  /* and the factor of its spin in its slip: 1, or -1 for the slip of pooltool */
  vector nose, up; /* directions from the centre of the ball to the nose, and up along it */
} meeting;

typedef struct impulses {
  real p, f[SLIPS]; /* normal impulse; friction at the driving contact (x, then z or up), on the
                       cloth (x, y) */
} impulses;

static void apply(meeting *k, const impulses *q) {
  const vector across = k->cushion ? k->nose : (vector){0, 1, 0},
               up = k->cushion ? k->up : (vector){0, 0, 1};
  const vector force = sum(sum((vector){q->f[0], 0, 0}, q->f[1], up), -q->p, across);
  push(&k->ball[0], across, force);
  if (!k->cushion)
    push(&k->ball[1], (vector){0, -1, 0}, (vector){-force.x, -force.y, -force.z});
  push(&k->ball[k->pressed], BOTTOM, (vector){q->f[2], q->f[3], 0});
}

/* The four slips, and the speed of approach along the normal. */
static real slips_of(const meeting *k, real s[SLIPS]) {
  const vector across = k->cushion ? k->nose : (vector){0, 1, 0},
               up = k->cushion ? k->up : (vector){0, 0, 1};
  vector at_nose = surface(&k->ball[0], across);
  if (!k->cushion)
    at_nose = sum(at_nose, -1, surface(&k->ball[1], (vector){0, -1, 0}));
  const body *b = &k->ball[k->pressed];
  const vector turning = cross(b->w, BOTTOM);
  s[0] = at_nose.x;
  s[1] = dot(at_nose, up);
  s[2] = b->v.x + k->spin_sign * turning.x;
  s[3] = b->v.y + k->spin_sign * turning.y;
  return dot(at_nose, across);
}

/* The linear equations of an impact; speeds over that of approach. */
typedef struct equations {
  real s[SLIPS], v; /* at the start */
  real S_p[SLIPS], S_f[SLIPS][SLIPS], v_p, v_f[SLIPS];
  real mu, mu_slide, e, g_0, g_1;
} equations;

static void derive(const meeting *start, equations *q) {
  q->v = slips_of(start, q->s);
  for (int k = -1; k < SLIPS; k++) {
    meeting rest = *start;
    rest.ball[0].v = rest.ball[0].w = rest.ball[1].v = rest.ball[1].w = (vector){0, 0, 0};
    impulses unit = {.p = k < 0};
    if (k >= 0)
      unit.f[k] = 1;
    apply(&rest, &unit);
    real change[SLIPS];
    *(k < 0 ? &q->v_p : &q->v_f[k]) = slips_of(&rest, change);
    for (int i = 0; i < SLIPS; i++)
      *(k < 0 ? &q->S_p[i] : &q->S_f[i][k]) = change[i];
  }
  for (int i = 0; i < SLIPS; i++)
    q->s[i] /= q->v;
}

/* ---- Friction ---- */

/* One contact: f = -weight s / sqrt(|s|^2 + eps^2), and its derivatives by s. */
static void coulomb(real weight, const real s[2], real eps, real f[2], real by_s[2][2]) {
  const real size = sqrtl(s[0] * s[0] + s[1] * s[1] + eps * eps);
  const real u[2] = {s[0] / size, s[1] / size};
  for (int i = 0; i < 2; i++) {
    f[i] = -weight * u[i];
    for (int j = 0; j < 2; j++)
      by_s[i][j] = -weight / size * ((i == j) - u[i] * u[j]);
  }
}

/* All frictions; by_s: their derivatives. Returns the load. */
static real frictions(const equations *q, const real s[SLIPS], real eps, bool loaded, real f[SLIPS],
                      real by_s[SLIPS][SLIPS]) {
  real d[2][2], t[2];
  memset(by_s, 0, SLIPS * sizeof *by_s);
  coulomb(q->mu, s, eps, f, d);
  const real load = q->g_0 + q->g_1 * f[1];
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      by_s[i][j] = d[i][j];
  f[2] = f[3] = 0;
  if (!loaded)
    return load;
  coulomb(q->mu_slide, s + 2, eps, t, d);
  for (int i = 0; i < 2; i++) {
    f[2 + i] = load * t[i];
    for (int j = 0; j < 2; j++) {
      by_s[2 + i][2 + j] = load * d[i][j];
      by_s[2 + i][j] = q->g_1 * by_s[1][j] * t[i];
    }
  }
  return load;
}

/* ---- Radau IIA ---- */

typedef struct rule {
  real c[STAGES], A[STAGES][STAGES];
  real high[2][STAGES], start[STAGES]; /* from values at the nodes: the highest Legendre
                                          coefficients, the value at the start */
} rule;

static real legendre(int n, real x) {
  real previous = 1, current = x;
  if (n == 0)
    return 1;
  for (int k = 2; k <= n; k++) {
    const real next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  return current;
}

/* The nodes are the zeros of P_(n-1) - P_n, over [-1, 1], the last of which is 1. */
static rule make_rule(void) {
  enum { n = STAGES, PIECES = 100 };
  rule r;
  real weight[n], x[n];
  int found = 0;
  for (int k = 0; k < PIECES && found < n - 1; k++) {
    real low = -1 + 2 * (real)k / PIECES, high = -1 + 2 * (real)(k + 1) / PIECES;
    const real sign = legendre(n - 1, low) - legendre(n, low);
    if (k + 1 == PIECES || sign * (legendre(n - 1, high) - legendre(n, high)) > 0)
      continue;
    for (int j = 0; j < 70; j++) {
      const real middle = (low + high) / 2;
      *(sign * (legendre(n - 1, middle) - legendre(n, middle)) > 0 ? &low : &high) = middle;
    }
    x[found++] = low;
  }
  x[n - 1] = 1;
  for (int k = 0; k < n; k++) {
    const real P = legendre(n - 1, x[k]);
    r.c[k] = (1 + x[k]) / 2;
    weight[k] = (1 + x[k]) / (2 * n * n * P * P);
    for (int j = 0; j < 2; j++)
      r.high[j][k] = (real)(2 * (n - 1 - j) + 1) * weight[k] * legendre(n - 1 - j, x[k]);
  }
  for (int j = 0; j < n; j++) {
    r.start[j] = 1;
    for (int l = 0; l < n; l++)
      r.start[j] *= l != j ? r.c[l] / (r.c[l] - r.c[j]) : 1;
  }
  /* Lagrange's polynomials integrated by the rule itself */
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      r.A[i][j] = 0;
      for (int k = 0; k < n; k++) {
        real value = 1;
        for (int l = 0; l < n; l++)
          if (l != j)
            value *= (r.c[i] * r.c[k] - r.c[l]) / (r.c[j] - r.c[l]);
        r.A[i][j] += r.c[i] * weight[k] * value;
      }
    }
  return r;
}

/* ---- One step ---- */

typedef struct state {
  real s[SLIPS], v, W; /* slips, approach, int v dp since the phase began */
  impulses so_far;
} state;

typedef struct integration {
  const equations *q;
  const rule *r;
  tolerances t;
  bool loaded, restitution;
  real target; /* W at the end of restitution */
} integration;

/* The matrix of Newton's method, factored with pivots. It need not be exact, so it is in double
 * precision, and is kept for as long as Newton's corrections fall by KEPT. */
typedef struct factored {
  double M[UNKNOWNS][UNKNOWNS];
  int pivot[UNKNOWNS];
} factored;

static bool factor(factored *a) {
  for (int c = 0; c < UNKNOWNS; c++) {
    int best = c;
    for (int r = c + 1; r < UNKNOWNS; r++)
      if (fabs(a->M[r][c]) > fabs(a->M[best][c]))
        best = r;
    if (!(fabs(a->M[best][c]) > 0))
      return false;
    a->pivot[c] = best;
    for (int j = 0; j < UNKNOWNS && best != c; j++) {
      const double swap = a->M[c][j];
      a->M[c][j] = a->M[best][j];
      a->M[best][j] = swap;
    }
    for (int r = c + 1; r < UNKNOWNS; r++) {
      const double share = a->M[r][c] /= a->M[c][c];
      if (share != 0)
        for (int j = c + 1; j < UNKNOWNS; j++)
          a->M[r][j] -= share * a->M[c][j];
    }
  }
  return true;
}

static void solve(const factored *a, double d[UNKNOWNS]) {
  for (int c = 0; c < UNKNOWNS; c++) {
    const double swap = d[c];
    d[c] = d[a->pivot[c]];
    d[a->pivot[c]] = swap;
  }
  for (int r = 0; r < UNKNOWNS; r++)
    for (int j = 0; j < r; j++)
      d[r] -= a->M[r][j] * d[j];
  for (int r = UNKNOWNS - 1; r >= 0; r--) {
    for (int j = r + 1; j < UNKNOWNS; j++)
      d[r] -= a->M[r][j] * d[j];
    d[r] /= a->M[r][r];
  }
}

/* The rates of the slips under these frictions. */
static void rates_of(const equations *q, const real f[SLIPS], real rate[SLIPS]) {
  for (int i = 0; i < SLIPS; i++) {
    rate[i] = q->S_p[i];
    for (int j = 0; j < SLIPS; j++)
      rate[i] += q->S_f[i][j] * f[j];
  }
}

/* How far each stage is from its equation. */
static void defects(const integration *g, const state *start, real h, real Y[STAGES][SLIPS],
                    real rate[STAGES][SLIPS], double d[UNKNOWNS]) {
  for (int k = 0; k < STAGES; k++)
    for (int i = 0; i < SLIPS; i++) {
      real defect = start->s[i] - Y[k][i];
      for (int l = 0; l < STAGES; l++)
        defect += h * g->r->A[k][l] * rate[l][i];
      d[k * SLIPS + i] = (double)defect;
    }
}

/* The derivatives of the defects by the slips, negated. */
static void newton_matrix(const integration *g, real h, real by_s[STAGES][SLIPS][SLIPS],
                          factored *a) {
  for (int l = 0; l < STAGES; l++)
    for (int i = 0; i < SLIPS; i++)
      for (int j = 0; j < SLIPS; j++) {
        real J = 0;
        for (int c = 0; c < SLIPS; c++)
          J += g->q->S_f[i][c] * by_s[l][c][j];
        for (int k = 0; k < STAGES; k++)
          a->M[k * SLIPS + i][l * SLIPS + j] = (double)((k == l && i == j) - h * g->r->A[k][l] * J);
      }
}

/* The slips and frictions at the stages of a step of length h. False if Newton's method does not
 * converge. */
static bool solve_stages(const integration *g, const state *start, real h, real Y[STAGES][SLIPS],
                         real f[STAGES][SLIPS]) {
  const equations *q = g->q;
  real by_s[STAGES][SLIPS][SLIPS], rate[STAGES][SLIPS], previous[STAGES][SLIPS];
  factored a;
  double d[UNKNOWNS];
  real last = 0;
  /* begin with the rates of the start */
  frictions(q, start->s, g->t.eps, g->loaded, f[0], by_s[0]);
  rates_of(q, f[0], rate[0]);
  for (int k = 0; k < STAGES; k++)
    for (int i = 0; i < SLIPS; i++)
      Y[k][i] = start->s[i] + h * g->r->c[k] * rate[0][i];

  for (int n = 0; n < NEWTON_MOST; n++) {
    real moved = 0;
    for (int k = 0; k < STAGES; k++) {
      memcpy(previous[k], f[k], sizeof previous[k]);
      frictions(q, Y[k], g->t.eps, g->loaded, f[k], by_s[k]);
      rates_of(q, f[k], rate[k]);
      for (int i = 0; i < SLIPS; i++)
        moved = fmaxl(moved, h * fabsl(f[k][i] - previous[k][i]));
    }
    if (n > 0 && moved <= CONVERGED)
      return true;
    if (isnan(moved))
      return false;

    /* the matrix is kept while the corrections fall fast */
    defects(g, start, h, Y, rate, d);
    const bool is_fast = n > 1 && moved < KEPT * last;
    if (!is_fast)
      newton_matrix(g, h, by_s, &a);
    if (!is_fast && !factor(&a))
      return false;
    solve(&a, d);
    last = moved;
    for (int k = 0; k < STAGES; k++)
      for (int i = 0; i < SLIPS; i++)
        Y[k][i] += (real)d[k * SLIPS + i];
  }
  return false;
}

/* A step of length h. Returns its error over the tolerance; infinite if Newton's method fails. */
static real try_step(const integration *g, const state *start, real h, state *end) {
  const equations *q = g->q;
  real Y[STAGES][SLIPS], f[STAGES][SLIPS], v[STAGES], high = 0;
  if (!solve_stages(g, start, h, Y, f))
    return INFINITY;
  *end = *start;
  end->so_far.p += h;
  memcpy(end->s, Y[STAGES - 1], sizeof end->s);
  for (int k = 0; k < STAGES; k++) {
    v[k] = start->v + h * g->r->c[k] * q->v_p;
    for (int l = 0; l < STAGES; l++)
      for (int i = 0; i < SLIPS; i++)
        v[k] += h * g->r->A[k][l] * q->v_f[i] * f[l][i];
  }
  end->v = v[STAGES - 1];
  for (int k = 0; k < STAGES; k++) {
    end->W += h * g->r->A[STAGES - 1][k] * v[k];
    for (int i = 0; i < SLIPS; i++)
      end->so_far.f[i] += h * g->r->A[STAGES - 1][k] * f[k][i];
  }
  /* no stage is at the start, where a slip may just be about to vanish: hence the difference
   * there */
  real at_start[SLIPS], by_s[SLIPS][SLIPS];
  frictions(q, start->s, g->t.eps, g->loaded, at_start, by_s);
  for (int i = 0; i < SLIPS; i++) {
    real coefficient[2] = {0}, difference = -at_start[i];
    for (int k = 0; k < STAGES; k++) {
      difference += g->r->start[k] * f[k][i];
      for (int j = 0; j < 2; j++)
        coefficient[j] += g->r->high[j][k] * f[k][i];
    }
    high = fmaxl(high, fmaxl(START_SHARE * fabsl(difference),
                             fmaxl(fabsl(coefficient[0]), fabsl(coefficient[1]))));
  }
  return fminl(high / g->t.rate, h * high / g->t.impulse);
}

/* ---- The way ---- */

enum { END_OF_PHASE, LOAD, EVENTS };

/* Positive once the event has happened. A load that is zero all the time must not count: hence
 * the last term. */
static real event(const integration *g, int index, const state *point) {
  if (index == END_OF_PHASE)
    return g->restitution ? g->target - point->W : -point->v;
  real f[SLIPS], by_s[SLIPS][SLIPS];
  const real load = frictions(g->q, point->s, g->t.eps, g->loaded, f, by_s);
  return (g->loaded ? -load : load) - 1e-13L;
}

/* The length of the step at whose end the event happens: regula falsi with halving. */
static real locate(const integration *g, int index, const state *start, real h, state *end) {
  real low = 0, high = h, at_low = event(g, index, start), at_high = event(g, index, end);
  for (int k = 0; k < ROOT_MOST && high - low > 1e-18L * h && at_high > 1e-18L; k++) {
    real middle = (low * at_high - high * at_low) / (at_high - at_low);
    if (k % 3 == 2 || !(middle > low && middle < high))
      middle = (low + high) / 2;
    if (!isfinite(try_step(g, start, middle, end)))
      return NAN;
    const real value = event(g, index, end);
    *(value > 0 ? &high : &low) = middle;
    *(value > 0 ? &at_high : &at_low) = value;
  }
  return isfinite(try_step(g, start, high, end)) ? high : (real)NAN;
}

/* From contact to parting. */
static bool integrate(const rule *r, const equations *q, const tolerances *t, impulses *total,
                      real *W_c) {
  integration g = {.q = q, .r = r, .t = *t};
  state point = {.v = 1};
  memcpy(point.s, q->s, sizeof point.s);
  real h = -0.05L / q->v_p, f[SLIPS], by_s[SLIPS][SLIPS];
  g.loaded = frictions(q, point.s, t->eps, false, f, by_s) > 0 && q->mu_slide > 0;
  const real small = 1e4L * t->eps;
  for (int n = 0; n < STEPS_MOST; n++) {
    state next;
    const real error = try_step(&g, &point, h, &next);
    if (!(error <= 1)) {
      h *= isfinite(error) ? fmaxl(0.1L, 0.8L * powl(error, -1.0L / (STAGES - 1))) : 0.25L;
      if (h < 1e-25L)
        break;
      continue;
    }
    const real longer = fminl(4, 0.8L * powl(fmaxl(error, 1e-30L), -1.0L / (STAGES - 1)));
    /* what happens first */
    int first = -1;
    real length = h;
    for (int index = 0; index < EVENTS; index++)
      if ((index != LOAD || q->mu_slide > 0) && event(&g, index, &next) > 0 &&
          event(&g, index, &point) <= 0) {
        length = locate(&g, index, &point, length, &next);
        first = index;
        if (isnan(length))
          return false;
      }
    point = next;
    if (first == LOAD)
      g.loaded = !g.loaded;
    else if (first == END_OF_PHASE && (g.restitution || q->e == 0)) {
      *total = point.so_far;
      *W_c = g.restitution ? *W_c : point.W;
      return true;
    } else if (first == END_OF_PHASE) {
      g.restitution = true;
      *W_c = point.W;
      point.W = point.v = 0;
      g.target = -q->e * q->e * *W_c;
    }
    /* a ball that is jammed between nose and cloth stays so */
    if (first < 0 && h > 0.1L &&
        fabsl(point.v) + fabsl(point.s[0]) + fabsl(point.s[1]) + fabsl(point.s[2]) +
                fabsl(point.s[3]) <
            small) {
      *total = point.so_far;
      return true;
    }
    if (first < 0)
      h *= longer;
  }
  return false;
}

/* ---- Checks ---- */

/* The largest velocity or spin, and the largest difference of two meetings. */
static real fastest(const meeting *a) {
  real most = 0;
  for (int k = 0; k < 2; k++)
    for (int c = 0; c < 6; c++)
      most = fmaxl(most, fabsl(c < 3 ? (&a->ball[k].v.x)[c] : (&a->ball[k].w.x)[c - 3]));
  return most;
}

static real apart(meeting a, const meeting *b) {
  for (int k = 0; k < 2; k++) {
    a.ball[k].v = sum(a.ball[k].v, -1, b->ball[k].v);
    a.ball[k].w = sum(a.ball[k].w, -1, b->ball[k].w);
  }
  return fastest(&a);
}

/* Integrates the impact from *k, which it leaves as it is after it. W_c: in units of mass and
 * speed. */
static bool pass(meeting *k, const rule *r, const equations *parameters, const tolerances *t,
                 real *P, real *W_c) {
  equations q = *parameters;
  impulses total = {0};
  derive(k, &q);
  if (!integrate(r, &q, t, &total, W_c))
    return false;
  *P = total.p *= q.v;
  *W_c *= q.v * q.v;
  for (int i = 0; i < SLIPS; i++)
    total.f[i] *= q.v;
  apply(k, &total);
  return true;
}

/* One rounding error, up or down, in number `c` of variant `n`: relative, so that zeros stay. */
static double nudged(double x, int n, int c) {
  const unsigned bits = (unsigned)(n * 40503 + c) * 2654435761u;
  const int sign = (bits >> 20 & 1) != 0 ? 1 : -1;
  return n == 0 ? x : x * (1 + sign * (double)ROUNDING);
}

/* Variant n of an impact: its meeting and parameters; false if it does not approach. */
typedef bool set_up(const void *in, int slip, int n, meeting *k, equations *q);

static reference_status solve_checked(set_up *prepare, const void *in, int slip, meeting *out,
                                      double unit, double normal[2]) {
  enum { VARIANTS = 3 };
  const rule r = make_rule();
  meeting start;
  equations q = {0};
  double error = INFINITY, rounding = 0;
  real P = 0, W_c = 0;
  if (!prepare(in, slip, 0, &start, &q)) {
    *out = start;
    return REFERENCE_SEPARATING;
  }
  const real scale = fastest(&start);
  meeting rough = start, last;
  bool solved = pass(&rough, &r, &q, &level_of[0], &P, &W_c);
  *out = rough;
  for (int level = 1; level < LEVELS && solved && error > (double)AGREED; level++) {
    last = *out;
    *out = start;
    solved = pass(out, &r, &q, &level_of[level], &P, &W_c);
    error = (double)(apart(*out, &last) / scale);
  }
  if (normal != NULL) {
    normal[0] = unit * (double)P;
    normal[1] = unit * (double)W_c;
  }
  for (int n = 1; n < VARIANTS && solved; n++) {
    meeting second;
    if (!prepare(in, slip, n, &second, &q) || !pass(&second, &r, &q, &level_of[0], &P, &W_c))
      rounding = INFINITY;
    else
      rounding = fmax(rounding, (double)(apart(second, &rough) / scale));
  }
  if (rounding > (double)TOO_SHAKY)
    return REFERENCE_ROUNDING;
  return solved && error < (double)TOO_FAR ? REFERENCE_OK : REFERENCE_FAILED;
}

/* A ball in the axes x = (y_y, -y_x), y. */
static void look(const double v[3], const double w[3], real R, const real y[2], int n, int c,
                 body *b) {
  double value[5];
  for (int k = 0; k < 5; k++)
    value[k] = nudged(k < 2 ? v[k] : w[k - 2], n, c + k);
  b->v = (vector){value[0] * y[1] - value[1] * y[0], value[0] * y[0] + value[1] * y[1], 0};
  b->w = (vector){R * (value[2] * y[1] - value[3] * y[0]), R * (value[2] * y[0] + value[3] * y[1]),
                  R * value[4]};
}

static carom_motion as_seen(const body *b, real R, const real y[2]) {
  return (carom_motion){
      .v = {(double)(b->v.x * y[1] + b->v.y * y[0]), (double)(b->v.y * y[1] - b->v.x * y[0]), 0},
      .w = {(double)((b->w.x * y[1] + b->w.y * y[0]) / R),
            (double)((b->w.y * y[1] - b->w.x * y[0]) / R), (double)(b->w.z / R)}};
}

static void direction(double x, double y, real out[2]) {
  const real length = hypotl(x, y);
  out[0] = x / length;
  out[1] = y / length;
}

typedef struct pair_of_balls {
  const carom_impact *in;
  real y[2];
} pair_of_balls;

static bool set_up_balls(const void *subject, int slip, int n, meeting *k, equations *q) {
  const pair_of_balls *pair = subject;
  const carom_impact *in = pair->in;
  const real R = in->a.radius, M_a = in->a.mass, M_b = in->b.mass;
  *k = (meeting){.spin_sign = slip == CAROM_SLIP_POOLTOOL ? -1 : 1};
  look(in->a.v, in->a.w, R, pair->y, n, 0, &k->ball[0]);
  look(in->b.v, in->b.w, R, pair->y, n, 5, &k->ball[1]);
  /* in units of the mass that makes v' = -1 without friction */
  k->ball[0].m = 1 + M_a / M_b;
  k->ball[1].m = 1 + M_b / M_a;
  /* friction pulls the surface of the first ball against its slip, upwards or down, and presses
   * one ball: which one cannot change, since all that changes the vertical slip is in proportion
   * to it */
  real s[SLIPS];
  const real v = slips_of(k, s);
  k->pressed = s[1] < 0;
  const double mu_pressed = k->pressed == 1 ? in->b.mu_slide : in->a.mu_slide;
  *q = (equations){.mu = nudged(in->mu_ball, n, 10),
                   .mu_slide = s[1] == 0 ? 0 : nudged(mu_pressed, n, 11),
                   .e = in->restitution,
                   .g_1 = k->pressed == 1 ? 1 : -1};
  return v > 0;
}

static bool set_up_cushion(const void *subject, int slip, int n, meeting *k, equations *q) {
  const carom_cushion_impact *in = subject;
  const real R = in->radius, sine = (in->height - R) / R, cosine = sqrtl((1 - sine) * (1 + sine));
  real y[2];
  (void)slip;
  direction(in->normal[0], in->normal[1], y);
  *k = (meeting){
      .cushion = true, .spin_sign = 1, .nose = {0, cosine, sine}, .up = {0, -sine, cosine}};
  look(in->v, in->w, R, y, n, 0, &k->ball[0]);
  k->ball[0].m = k->ball[1].m = 1;
  /* the cloth bears what pushes the ball down: p along the nose, less the friction that pulls it
   * up */
  *q = (equations){.mu = nudged(in->mu_cushion, n, 10),
                   .mu_slide = nudged(in->mu_slide, n, 11),
                   .e = in->restitution,
                   .g_0 = sine,
                   .g_1 = -cosine};
  return k->ball[0].v.y > 0;
}

reference_status reference_collide(const carom_impact *in, carom_slip slip, carom_result *out,
                                   double normal[2]) {
  pair_of_balls pair = {.in = in};
  const real R = in->a.radius, unit = 1 / (1 / (real)in->a.mass + 1 / (real)in->b.mass);
  meeting end;
  direction(in->b.r[0] - in->a.r[0], in->b.r[1] - in->a.r[1], pair.y);
  const reference_status status =
      solve_checked(set_up_balls, &pair, (int)slip, &end, (double)unit, normal);
  *out = (carom_result){as_seen(&end.ball[0], R, pair.y), as_seen(&end.ball[1], R, pair.y)};
  return status;
}

reference_status reference_cushion(const carom_cushion_impact *in, carom_motion *out) {
  meeting end;
  real y[2];
  direction(in->normal[0], in->normal[1], y);
  const reference_status status = solve_checked(set_up_cushion, in, 0, &end, in->mass, NULL);
  *out = as_seen(&end.ball[0], in->radius, y);
  return status;
}
