/* The exact collision in lanes: the reduced equations, marched through by a Runge-Kutta pair with error control.
 *
 * Reduction. Only one ball is ever pressed into the cloth, since u_z does not change sign; the frame is turned so that u_z >= 0
 * (reduce() in exact_lanes.c). With p the normal impulse over the pressed ball's mass, κ = 1 + M_pressed/M_other, (c, σ) the
 * direction of the slip u between the balls, t that of the pressed ball's slip d over the cloth and f = -μ_s μ_b σ t,
 *
 *     du_x/dp = -7/2 κ μ_b c + f_x     du_z/dp = -5/2 κ μ_b σ + 5/2 f_y     dv_n/dp = κ - f_y
 *     dd/dp   = (-μ_b c + (1 - 5/2 s) f_x,  -1 + 5/2 s μ_b σ + (1 - 5/2 s) f_y).
 *
 * Variable. λ with u_z = u_z0 λ⁵ falls from 1 and reaches 0 when the balls stick to each other; x = 1 - λ marches. It takes the
 * decay of the slip, singular in p, out of the equations. With u_x = g λ⁷, W = g λ², U = sqrt(u_z0² + W²), τ = t/(κ + μ_s t_y)
 * and E = 1/(κ + μ_s t_y) what remains to be integrated is slow:
 *
 *     dp/dx = (2/μ_b) λ⁴ U E     dF/dx = -2 μ_s u_z0 λ⁴ τ     dg/dx = -(μ_s/λ³) (2 u_z0 τ_x - 7 τ_y W)     dJ/dx = F_y dp/dx
 *
 * F = ∫ f dp is the cloth's impulse, J = ∫ F_y dp. All else is algebra: Q_1 = ∫ μ_b c dp = (u_x0 - u_x + F_x)/(7/2 κ),
 * Q_2 = ∫ μ_b σ dp = (u_z0 - u_z + 5/2 F_y)/(5/2 κ), d from Q_1, Q_2, p and F, v_n = v_n0 + κ p - F_y, and the work
 * S = ∫ v_n dp = (v_n0 + κ p/2) p - J.
 *
 * Events. Compression ends at the minimum of S, the collision where S has come back to (1 - e²) S_min. Both are found on the
 * interpolant of the step that holds them, so no step has to end there. Near stick, at λ = `stuck_below`, what is left of F and
 * p follows in closed form; from there on u = 0 and v_n rises with slope κ.
 *
 * Method. The pair of orders 5 and 4 of Dormand and Prince with its interpolant (J. R. Dormand, P. J. Prince, J. Comp. Appl.
 * Math. 6 (1980) 19-26; E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, II.5 and II.6). Every
 * lane has its own step; a lane that has arrived is frozen, so what it yields does not depend on its neighbours.
 */
#ifndef CAROM_SRC_BATCH_MARCH_H
#define CAROM_SRC_BATCH_MARCH_H

#include "lanes.h"

#ifdef CAROM_LANES_SINGLE
#define MARCH_TINY 1e-36f
#define MARCH_NO_FRICTION 1e-18f
static const real step_tolerance = 2e-6f; /* of a step's error, over the speeds' scale */
static const real rest_nudge = 1e-4f;     /* how far from rest a slip begins, over |v_n|/κ */
static const real stuck_below = 0.3f;
static const real from_rest_share = 0.012f;
static const real fade = 1e-3f;
static const real longest_first = 0.25f;
#else
#define MARCH_TINY 1e-300
#define MARCH_NO_FRICTION 1e-30
static const real step_tolerance = 3e-7;
static const real rest_nudge = 1e-9;
static const real stuck_below = 0.25;
static const real from_rest_share = 0.004;
static const real fade = 3e-7;
static const real longest_first = 0.12;
#endif

enum { MOST_STEPS = 100 };

/* What a collision is after the reduction. */
typedef struct problem {
  vreal u_x, u_z; /* slip between the balls, u_z >= 0 */
  vreal d_x, d_y; /* slip of the pressed ball over the cloth */
  vreal v_n;      /* approach, < 0 */
  vreal kappa, mu, mu_b, e;
} problem;

/* What it comes to. */
typedef struct outcome {
  vreal u_x, u_z, p, F_x, F_y;
  vmask good;
} outcome;

/* What is integrated, and its rates. */
typedef struct march_state {
  vreal p, F_x, F_y, g, J;
} march_state;

/* Constants of the lanes. */
typedef struct march_law {
  vreal unit;  /* |v_n|/κ: the impulse that a collision without friction needs to come to rest */
  vreal scale; /* at most about the largest speed, to which errors are relative */
  vreal c_p, c_F, c_g, u_z2;
  vreal per_35, X, Y, Z, base_x, base_y; /* d = base + ... */
} march_law;

static inline march_law law_of(const problem *c, real s) {
  const vreal per = v_reciprocal(c->kappa);
  const real spin = (real)2.5 * s;
  march_law m;
  m.unit = -c->v_n * per;
  const vreal u_2 = c->u_x * c->u_x + c->u_z * c->u_z, d_2 = c->d_x * c->d_x + c->d_y * c->d_y;
  m.scale = v_sqrt(v_max(m.unit * m.unit, v_max((real)(1 / 16.0) * u_2, (real)(1 / 4.0) * d_2)));
  m.c_p = 2 * v_reciprocal(c->mu_b + (real)MARCH_NO_FRICTION);
  m.c_F = -2 * c->mu * c->u_z;
  m.c_g = -c->mu;
  m.u_z2 = c->u_z * c->u_z + (real)MARCH_TINY;
  m.per_35 = per * (real)(1 / 3.5);
  m.X = (1 - spin) - m.per_35;
  m.Y = (1 - spin) + spin * per;
  m.Z = spin * (real)0.4 * per * c->u_z;
  /* A slip that begins at rest has the direction of its derivative. */
  const vreal i = v_reciprocal_sqrt(c->u_x * c->u_x + m.u_z2);
  const vreal nudge = rest_nudge * m.unit;
  m.base_x = c->d_x - nudge * c->mu_b * c->u_x * i - m.per_35 * c->u_x;
  m.base_y = c->d_y - nudge * (1 - spin * c->mu_b * c->u_z * i);
  return m;
}

/* 1 - λ⁵ for λ = 1 - x, without cancellation. */
static inline vreal lost_of_fifth(vreal x) {
  return x * (5 - x * (10 - x * (10 - x * (5 - x))));
}

typedef struct cloth_slip {
  vreal x, y, size;
} cloth_slip;

static inline cloth_slip cloth_slip_at(const problem *c, const march_law *m, vreal x, const march_state *y) {
  const vreal l = 1 - x, l2 = l * l, l7 = l2 * l2 * l2 * l;
  cloth_slip d;
  d.x = v_fma(m->X, y->F_x, v_fma(m->per_35 * l7, y->g, m->base_x));
  d.y = v_fma(m->Y, y->F_y, v_fma(m->Z, lost_of_fifth(x), m->base_y - y->p));
  d.size = v_sqrt(v_fma(d.x, d.x, d.y * d.y));
  (void)c;
  return d;
}

static inline march_state rates(const problem *c, const march_law *m, vreal x, const march_state *y) {
  const vreal l = 1 - x, l2 = l * l, l4 = l2 * l2;
  const vreal W = l2 * y->g, U = v_root(v_fma(W, W, m->u_z2));
  const cloth_slip d = cloth_slip_at(c, m, x, y);
  const vreal below = v_fma(c->kappa, d.size, v_fma(c->mu, d.y, v_splat((real)MARCH_TINY))), l3 = l2 * l;
  const vreal both = v_reciprocal(below * l3), i = both * l3; /* 1/below; and both * below is 1/l3 */
  const vreal tau_x = d.x * i, tau_y = d.y * i;
  march_state r;
  r.p = m->c_p * l4 * U * (d.size * i);
  r.F_x = m->c_F * l4 * tau_x;
  r.F_y = m->c_F * l4 * tau_y;
  r.g = m->c_g * (2 * c->u_z * tau_x - 7 * (tau_y * W)) * (both * below);
  r.J = y->F_y * r.p;
  return r;
}

/* y + h (a[0] k[0] + ... ), rate by rate; coefficients of 0 are left out. */
static inline march_state combine(const march_state *y, vreal h, const march_state k[], const real a[], int n) {
  march_state sum = {v_splat(0), v_splat(0), v_splat(0), v_splat(0), v_splat(0)};
  lanes_unrolled for (int j = 0; j < n; j++) if (a[j] != 0) {
    const vreal w = v_splat(a[j]);
    sum.p = v_fma(w, k[j].p, sum.p);
    sum.F_x = v_fma(w, k[j].F_x, sum.F_x);
    sum.F_y = v_fma(w, k[j].F_y, sum.F_y);
    sum.g = v_fma(w, k[j].g, sum.g);
    sum.J = v_fma(w, k[j].J, sum.J);
  }
  return (march_state){v_fma(h, sum.p, y->p), v_fma(h, sum.F_x, y->F_x), v_fma(h, sum.F_y, y->F_y), v_fma(h, sum.g, y->g),
                       v_fma(h, sum.J, y->J)};
}

static inline march_state select_state(vmask m, const march_state *yes, const march_state *no) {
  return (march_state){v_select(m, yes->p, no->p), v_select(m, yes->F_x, no->F_x), v_select(m, yes->F_y, no->F_y),
                       v_select(m, yes->g, no->g), v_select(m, yes->J, no->J)};
}

/* A step of the pair: its rates, the new state, its error; h is its length. */
typedef struct march_step {
  march_state k[7], end;
  vreal h, error;
} march_step;

#define ONE(x) ((real)(x))
static const real step_at[7] = {0, ONE(1 / 5.0), ONE(3 / 10.0), ONE(4 / 5.0), ONE(8 / 9.0), 1, 1};
static const real step_from[7][6] = {
    {0},
    {ONE(1 / 5.0)},
    {ONE(3 / 40.0), ONE(9 / 40.0)},
    {ONE(44 / 45.0), ONE(-56 / 15.0), ONE(32 / 9.0)},
    {ONE(19372 / 6561.0), ONE(-25360 / 2187.0), ONE(64448 / 6561.0), ONE(-212 / 729.0)},
    {ONE(9017 / 3168.0), ONE(-355 / 33.0), ONE(46732 / 5247.0), ONE(49 / 176.0), ONE(-5103 / 18656.0)},
    {ONE(35 / 384.0), 0, ONE(500 / 1113.0), ONE(125 / 192.0), ONE(-2187 / 6784.0), ONE(11 / 84.0)},
};
static const real step_less[7] = {
    ONE(71 / 57600.0), 0, ONE(-71 / 16695.0), ONE(71 / 1920.0), ONE(-17253 / 339200.0), ONE(22 / 525.0), ONE(-1 / 40.0)};

/* The interpolant of one component over the step, from its values y_0, y_1 and rates: value at share q of the step. */
typedef struct interpolant {
  vreal y_0, r_2, r_3, r_4, r_5;
} interpolant;

#define INTERPOLANT(s, y, name)                                                                                    \
  interpolant_of((y)->name, (s)->end.name, (s)->h, (s)->k[0].name, (s)->k[2].name, (s)->k[3].name, (s)->k[4].name, \
                 (s)->k[5].name, (s)->k[6].name)

static inline interpolant interpolant_of(vreal y_0, vreal y_1, vreal h, vreal k_1, vreal k_3, vreal k_4, vreal k_5, vreal k_6,
                                         vreal k_7) {
  interpolant i;
  i.y_0 = y_0;
  i.r_2 = y_1 - y_0;
  i.r_3 = h * k_1 - i.r_2;
  i.r_4 = i.r_2 - h * k_7 - i.r_3;
  i.r_5 = h * ((real)(-12715105075.0 / 11282082432.0) * k_1 + (real)(87487479700.0 / 32700410799.0) * k_3 +
               (real)(-10690763975.0 / 1880347072.0) * k_4 + (real)(701980252875.0 / 199316789632.0) * k_5 +
               (real)(-1453857185.0 / 822651844.0) * k_6 + (real)(69997945.0 / 29380423.0) * k_7);
  return i;
}

static inline vreal value_at(const interpolant *i, vreal q) {
  const vreal r = 1 - q;
  return v_fma(q, v_fma(r, v_fma(q, v_fma(r, i->r_5, i->r_4), i->r_3), i->r_2), i->y_0);
}

static inline vreal work_of(const problem *c, vreal p, vreal J) {
  return (c->v_n + (real)0.5 * c->kappa * p) * p - J;
}

/* The impulse p still to go, from where v_n is `v`, with slope `slope`, and the work is S, to where the work is (1 - e²) S_min;
 * negative if that has been passed. For e = 0 this is where v_n = 0, whatever the works say: their difference, mostly
 * rounding and interpolation there, is faded out. */
static inline vreal to_go(vreal v, vreal slope, vreal S, vreal S_min, vreal e2) {
  const vreal excess = v * v - 2 * slope * (S - S_min), e4 = e2 * e2;
  const vreal square = excess * (e4 / (e4 + fade)) - 2 * slope * e2 * S_min;
  return (v_sqrt(v_max(square, v_splat(0))) - v) / slope;
}

/* The share of λ that a collision loses until the impulse reach, about; q is the share of |u| that it loses at its first rate.
 */
typedef struct forecast {
  vreal q, z, x, room; /* z: share of λ at its first rate */
  vreal p_f;           /* the impulse at the end */
  vreal tau_x, tau_y;  /* τ half way */
  vreal pull;          /* |f| at the start */
  vmask at_rest;       /* the pressed ball's slip begins at 0, and so does not turn */
} forecast;

static inline forecast foresee(const problem *c, real s) {
  const vreal tiny = v_splat((real)MARCH_TINY);
  const vreal reach = (1 + c->e) * -c->v_n * v_reciprocal(c->kappa);
  const vreal mid_y = c->d_y - (real)0.5 * reach;
  const vreal t_i = v_reciprocal_sqrt(c->d_x * c->d_x + mid_y * mid_y + tiny);
  const vreal t_x = c->d_x * t_i, t_y = mid_y * t_i, D = c->kappa + c->mu * t_y;
  const vreal i = v_reciprocal_sqrt(c->u_x * c->u_x + c->u_z * c->u_z + tiny);
  const vreal cosine = c->u_x * i, sigma = c->u_z * i;
  forecast f;
  const vreal per_D = v_reciprocal(D);
  f.tau_x = t_x * per_D;
  f.tau_y = t_y * per_D;
  f.pull = c->mu * c->mu_b * sigma;
  const vreal back = f.pull * f.tau_y;
  f.p_f = reach * (1 - back * (1 - back));
  const vreal rate = (real)3.5 * c->kappa * cosine * cosine + sigma * ((real)2.5 * D * sigma + c->mu * cosine * t_x);
  const vreal scaled = c->mu_b * f.p_f * i;
  f.q = rate * scaled;
  /* λ = (1 - q)^(z/q) */
  const vreal z = f.z = (real)0.5 * D * scaled;
  const vreal fourth = v_reciprocal_sqrt(v_reciprocal_sqrt(v_max(1 - f.q, v_splat((real)1e-3))));
  const vreal less = 1 - fourth * v_reciprocal_sqrt(fourth), per_q = v_reciprocal(v_max(f.q, v_splat((real)0.3)));
  const vmask short_way = v_less(f.q, v_splat((real)0.3));
  const vreal small = v_select(short_way, f.q, less), zs = v_select(short_way, z, 8 * z * less * per_q);
  f.x = zs * (1 + (small - zs) * ((real)0.5 + (2 * small - zs) * ((real)(1 / 6.0) +
                                                                  (3 * small - zs) * ((real)(1 / 24.0) +
                                                                                      (4 * small - zs) * (real)(1 / 120.0)))));
  /* The slip d runs about straight; room is (|d| + |d_end|)/|way|, 1 where it passes through 0. */
  const vreal way = f.p_f * v_min((real)1.2 * per_q, v_splat(1));
  const vreal w_x = -c->mu_b * cosine * way, w_y = ((real)2.5 * s * c->mu_b * sigma - 1) * way;
  const vreal e_x = c->d_x + w_x, e_y = c->d_y + w_y;
  const vreal d = v_sqrt(c->d_x * c->d_x + c->d_y * c->d_y);
  f.room = (d + v_sqrt(e_x * e_x + e_y * e_y)) * v_reciprocal_sqrt(w_x * w_x + w_y * w_y + tiny);
  f.at_rest = v_less(d * c->mu * c->mu_b, (real)1e-7 * reach);
  return f;
}

/* A little beyond the end, so that it lies inside the step. */
static const real aim_beyond = (real)1.02;

/* To the end where that can be foreseen. From rest the pair's order is lower, and the error grows as μ_s μ_b h². */
static inline vreal first_step(const problem *c, const forecast *f) {
  const vreal most = v_splat(longest_first);
  const vreal h = v_select(v_less(f->q, v_splat((real)0.97)), v_min(aim_beyond * f->x, most), most);
  const vreal from_rest = v_min(h, from_rest_share / v_sqrt(c->mu * c->mu_b + (real)1e-6));
  return v_select(f->at_rest, from_rest, h);
}

/* A vector of collisions on its way. */
typedef struct walk {
  problem c;
  march_law m;
  vreal w_p; /* what an error of p counts: nothing for Q_1 and Q_2 where the balls will stick */
  vreal x, h, least, S_min;
  march_state y;
  march_step step;
  vmask seen, running, taken;
  vreal size, v_1, S_1, S_end;
  outcome o;
} walk;

static inline void set_out(walk *w, const problem *c, vmask mask, real s) {
  const vreal zero = v_splat(0);
  const forecast f = foresee(c, s);
  w->c = *c;
  w->m = law_of(c, s);
  w->w_p = (real)2.5 * c->mu_b * v_select(v_less(f.q, v_splat((real)1.25)), v_splat(1), c->mu);
  w->x = w->S_min = zero;
  w->h = first_step(c, &f);
  w->least = (real)0.02 * step_tolerance * w->m.scale / (c->mu * c->mu_b + step_tolerance);
  w->y = (march_state){zero, zero, zero, c->u_x, zero};
  w->step.k[0] = rates(c, &w->m, w->x, &w->y);
  /* Without friction there is nothing to march through. */
  const vmask free = mask & (v_less_equal(v_abs(c->u_x) + c->u_z, v_splat((real)MARCH_TINY)) |
                             v_less_equal(c->mu_b, v_splat((real)MARCH_NO_FRICTION)));
  w->o = (outcome){.u_x = c->u_x, .u_z = c->u_z, .p = (1 + c->e) * w->m.unit, .F_x = zero, .F_y = zero, .good = free};
  w->seen = v_not(mask) & mask;
  w->running = mask & v_not(free);
}

/* The step goes not further than the turn of d and the nearness of stick allow. */
static inline void limit(walk *w, real s) {
  const problem *c = &w->c;
  const real room = (real)1.8;
  const cloth_slip d = cloth_slip_at(c, &w->m, w->x, &w->y);
  const vreal l = 1 - w->x, l2 = l * l, W = l2 * w->y.g, i = v_splat(1) / v_sqrt(v_fma(W, W, w->m.u_z2));
  const vreal g_x = -c->mu_b * W * i, g_y = (real)2.5 * s * c->mu_b * c->u_z * i - 1;
  const vreal g2 = v_fma(g_x, g_x, g_y * g_y), g = v_sqrt(g2);
  /* the longest way along g on which (|d| + |d_end|) is `room` times the way */
  const vreal turn = (real)2 / (room * room - 1) * (d.x * g_x + d.y * g_y + room * d.size * g);
  const vreal longest = v_max(turn, w->least * g2) / (g2 * w->step.k[0].p);
  const vmask from_rest = v_less(d.size, 4 * rest_nudge * w->m.unit);
  w->h = v_min(v_select(from_rest, w->h, v_min(w->h, longest)), (real)0.6 * l);
}

static inline void take_stage(walk *w, int stage) {
  const march_state at = combine(&w->y, w->h, w->step.k, step_from[stage], stage);
  w->step.k[stage] = rates(&w->c, &w->m, v_fma(v_splat(step_at[stage]), w->h, w->x), &at);
  if (stage == 6)
    w->step.end = at;
}

/* Whether the step is good enough, and where it leads. */
static inline void judge(walk *w) {
  const problem *c = &w->c;
  const march_state none = {v_splat(0), v_splat(0), v_splat(0), v_splat(0), v_splat(0)};
  const march_state e = combine(&none, w->h, w->step.k, step_less, 7);
  /* As they act on the twelve results: F by 1 + 5/2, g and p through Q_1 and Q_2, each turned into R w by 5/2. */
  const vreal l = 1 - (w->x + w->h), l2 = l * l, l7 = l2 * l2 * l2 * l;
  const vreal error = (real)3.5 * v_max(v_abs(e.F_x), v_abs(e.F_y)) + v_abs(e.g) * l7 + w->w_p * v_abs(e.p);
  /* short steps, of which there may be many, get a smaller share of the tolerance */
  const vreal share = (real)0.1 + (real)0.9 * v_min((w->step.end.p - w->y.p) / w->m.unit, v_splat(1));
  w->size = error / (step_tolerance * w->m.scale * share);
  w->taken = w->running & (v_less_equal(w->size, v_splat(1)) | v_less_equal(w->h * w->step.k[0].p, (real)1.01 * w->least));
  w->step.h = w->h;
  w->v_1 = v_fma(c->kappa, w->step.end.p, c->v_n - w->step.end.F_y);
  w->S_1 = work_of(c, w->step.end.p, w->step.end.J);
}

/* Compression ends inside the step of the lanes in `now`: where v_n = 0, S is least. */
static inline void turn_back(walk *w, vmask now) {
  const problem *c = &w->c;
  const interpolant p = INTERPOLANT(&w->step, &w->y, p), F = INTERPOLANT(&w->step, &w->y, F_y),
                    J = INTERPOLANT(&w->step, &w->y, J);
  const vreal v_0 = v_fma(c->kappa, w->y.p, c->v_n - w->y.F_y);
  /* S is stationary there, so a near miss is mended by its curvature; two secants come near. */
  vreal q = v_0 / (v_0 - w->v_1), p_q = value_at(&p, q), v = v_fma(c->kappa, p_q, c->v_n - value_at(&F, q));
  for (int again = 0; again < 2; again++) {
    const vmask left = v_less(v, v_splat(0));
    const vreal q_o = v_select(left, v_splat(1), v_splat(0)), v_o = v_select(left, w->v_1, v_0);
    q = q - v * (q_o - q) / (v_o - v + (real)MARCH_TINY);
    p_q = value_at(&p, q);
    v = v_fma(c->kappa, p_q, c->v_n - value_at(&F, q));
  }
  const vreal S = work_of(c, p_q, value_at(&J, q)) - (real)0.5 * v * v / c->kappa;
  w->S_min = v_select(now, S, w->S_min);
  w->seen |= now;
}

/* The collision ends inside the step of the lanes in `now`: where S = S_end. */
static inline void arrive(walk *w, vmask now) {
  const problem *c = &w->c;
  const interpolant p = INTERPOLANT(&w->step, &w->y, p), F = INTERPOLANT(&w->step, &w->y, F_y),
                    J = INTERPOLANT(&w->step, &w->y, J);
  const interpolant F_x = INTERPOLANT(&w->step, &w->y, F_x), g = INTERPOLANT(&w->step, &w->y, g);
  const vreal slope = c->kappa - w->step.k[6].F_y / w->step.k[6].p;
  const vreal dp = w->step.end.p - w->y.p, bow = w->step.k[6].p * w->step.h / dp; /* dp/dq at the end, over dp */
  vreal q = v_splat(1), p_q = w->step.end.p, F_q = w->step.end.F_y, S = w->S_1;
  for (int again = 0; again < 3; again++) {
    const vreal more = to_go(v_fma(c->kappa, p_q, c->v_n - F_q), slope, S, w->S_min, c->e * c->e);
    q = v_max(q + more / (dp * (bow + 2 * (1 - bow) * (1 - q))), v_splat(0));
    p_q = value_at(&p, q);
    F_q = value_at(&F, q);
    S = work_of(c, p_q, value_at(&J, q));
  }
  p_q += to_go(v_fma(c->kappa, p_q, c->v_n - F_q), slope, S, w->S_min, c->e * c->e);
  const vreal l = 1 - v_fma(q, w->step.h, w->x), l2 = l * l, l5 = l2 * l2 * l;
  w->o.p = v_select(now, p_q, w->o.p);
  w->o.F_x = v_select(now, value_at(&F_x, q), w->o.F_x);
  w->o.F_y = v_select(now, F_q, w->o.F_y);
  w->o.u_z = v_select(now, c->u_z * l5, w->o.u_z);
  w->o.u_x = v_select(now, value_at(&g, q) * l5 * l2, w->o.u_x);
  w->o.good |= now;
  w->running &= v_not(now);
}

/* Goes on from the end of the step where it was taken, and from its beginning with a smaller one where not. */
static inline void go_on(walk *w) {
  const problem *c = &w->c;
  const vmask on = w->taken & w->running;
  w->x = v_select(on, w->x + w->h, w->x);
  w->y = select_state(on, &w->step.end, &w->y);
  w->step.k[0] = select_state(on, &w->step.k[6], &w->step.k[0]);
  const vreal growth = v_min(v_max((real)0.9 / v_sqrt(v_sqrt(w->size + (real)1e-6)), v_splat((real)0.15)), v_splat(20));
  const vreal v = v_fma(c->kappa, w->y.p, c->v_n - w->y.F_y), S = work_of(c, w->y.p, w->y.J);
  /* at least so far that the end is passed, where rounding would stop short of it */
  const vreal left = v_max(v_select(w->seen, to_go(v, c->kappa, S, w->S_min, c->e * c->e), (1 + c->e) * w->m.unit - w->y.p),
                           (real)0.01 * w->m.unit);
  const vreal way = left / w->step.k[0].p;
  w->h = v_min(w->h * growth, aim_beyond * way * (1 + (real)2.5 * way / v_max(1 - w->x, v_splat((real)0.1))));
}

/* The balls of some lanes are about to stick: what is left of F and p, and the rest without friction. Unless the collision ends
 * before; then the march goes on, and leaves this at the latest when no slip is left that counts. */
static inline void stick(walk *w, vmask near) {
  const problem *c = &w->c;
  const march_state *k = &w->step.k[0];
  const vreal l = 1 - w->x, W = l * l * w->y.g, W2 = W * W, zero = v_splat(0);
  const vreal rest = (real)0.2 * l, F_x = w->y.F_x + rest * k->F_x, F_y = w->y.F_y + rest * k->F_y;
  const vreal p = w->y.p + k->p * l / (5 + 2 * W2 / (W2 + w->m.u_z2));
  const vreal J = w->y.J + (p - w->y.p) * (real)0.5 * (w->y.F_y + F_y);
  const vreal v = v_fma(c->kappa, p, c->v_n - F_y), S = work_of(c, p, J);
  const vreal S_min = v_select(w->seen, w->S_min, S - (real)0.5 * v * v / c->kappa);
  const vmask before_end = v_less_equal(v, zero) | v_less(S, (1 - c->e * c->e) * S_min);
  const vmask now = near & (before_end | v_less_equal(l, v_splat((real)0.03)));
  w->o.p = v_select(now, p + to_go(v, c->kappa, S, S_min, c->e * c->e), w->o.p);
  w->o.F_x = v_select(now, F_x, w->o.F_x);
  w->o.F_y = v_select(now, F_y, w->o.F_y);
  w->o.u_x = v_select(now, zero, w->o.u_x);
  w->o.u_z = v_select(now, zero, w->o.u_z);
  w->o.good |= now;
  w->running &= v_not(now);
}

/* Several vectors walk abreast, so that the long chain of operations of one hides behind the others'. */
#define EACH(w, b) lanes_unrolled for (int b = 0; b < ABREAST; b++)
#ifdef CAROM_LANES_ONE
enum { ABREAST = 1 };
#else
enum { ABREAST = 2 };
#endif

/* Marches the lanes to the end of their collisions; set_out() has been called for each. */
static inline void march(walk w[ABREAST], real s) {
  for (int n = 0; n < MOST_STEPS; n++) {
    bool any = false;
    EACH(w, b) any |= v_any(w[b].running);
    if (!any)
      break;
    EACH(w, b) limit(&w[b], s);
    lanes_unrolled for (int stage = 1; stage < 7; stage++) EACH(w, b) take_stage(&w[b], stage);
    EACH(w, b) judge(&w[b]);
    EACH(w, b) {
      const vmask now = w[b].taken & v_not(w[b].seen) & v_less_equal(v_splat(0), w[b].v_1);
      if (v_any(now))
        turn_back(&w[b], now);
    }
    EACH(w, b) {
      w[b].S_end = (1 - w[b].c.e * w[b].c.e) * w[b].S_min;
      const vmask now = w[b].taken & w[b].seen & v_less_equal(w[b].S_end, w[b].S_1);
      if (v_any(now))
        arrive(&w[b], now);
    }
    EACH(w, b) {
      go_on(&w[b]);
      const vmask near = w[b].running & v_less_equal(1 - w[b].x, v_splat(stuck_below));
      if (v_any(near))
        stick(&w[b], near);
    }
  }
}

#endif
