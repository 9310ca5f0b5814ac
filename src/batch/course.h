/* Whole collisions: most are one arc, of a class foreseen by their q and by how near zero the slip over the cloth will come;
 * the others are followed arc by arc. Every limit here was tried on the reference cases and on ten thousand random collisions.
 */
#ifndef CAROM_SRC_BATCH_COURSE_H
#define CAROM_SRC_BATCH_COURSE_H

#include "ends.h"

/* (|d| + |d + way|) / |way|, which is 1 where d passes through zero on its way along g, and otherwise measures the ellipse on
 * which its direction is analytic. */
always vreal room_of(const problem *c, const forecast *f, vreal way) {
  const vreal w_x = way * f->g_x, w_y = way * f->g_y, e_x = c->d_x + w_x, e_y = c->d_y + w_y;
  return (v_root(c->d_x * c->d_x + c->d_y * c->d_y + TINY) + v_root(e_x * e_x + e_y * e_y + TINY)) *
         v_reciprocal_sqrt(w_x * w_x + w_y * w_y + TINY);
}

/* Whether arcs in single precision are to be trusted: not where strong friction lets small causes grow, sooner so with the
 * pooltool sign, where the cloth pushes its slip apart. */
always vmask within_reach(const problem *c) {
  return v_less(c->mu * c->mu_b, NUMBER(c->s > 0 ? 0.1 : 0.15));
}

/* Whether the ball slip is so small, and stick so sure, that it ends at once. */
always vmask sticks_at_once(const problem *c, const forecast *f) {
  const vreal u_2 = c->u_x * c->u_x + c->u_z * c->u_z;
  return v_less(u_2, NUMBER(1e-28)) | (v_less(u_2, NUMBER(1e-14)) & v_less(v_splat(2), f->q));
}

/* The classes of collisions, in the order in which they are done: what the first do not fit goes on to a later one. */
enum { EARLY_STICK, LATE_STICK, COARSE, MIDDLE, FINE, FOLLOWED, CLASSES };

/* Which class a collision within reach is tried in. */
always vreal class_of(const problem *c, const forecast *f) {
  const vreal pull = c->mu * c->mu_b, one = v_splat(1);
  const vmask mild = v_less(c->mu_b, NUMBER(0.25));
  const vmask rest = v_less(pull * (v_abs(c->d_x) + v_abs(c->d_y)), NUMBER(3e-7) * c->slack);
  const vreal way = f->p_f * v_min(one, (real)1.2 * v_reciprocal(v_max(f->q, one)));
  const vreal room = v_select(rest, NUMBER(100), room_of(c, f, way));
#define BELOW(x, y) v_less(x, NUMBER(y))
#define ABOVE(x, y) v_less(NUMBER(y), x)
  const vmask slips = mild & BELOW(f->q, 0.985), sticks = mild & ABOVE(f->q, 0.985);
  vreal class = v_splat(FOLLOWED);
  class = v_select(slips & ABOVE(room, 1.3), v_splat(FINE), class);
  class = v_select(slips & ABOVE(room, 2) & BELOW(f->q, 0.6), v_splat(MIDDLE), class);
  class = v_select(slips & ABOVE(room, 6) & BELOW(f->q, 0.12) & BELOW(pull, 0.06) & BELOW(c->mu, 0.55) & ABOVE(c->e, 0.85),
                   v_splat(COARSE), class);
  class = v_select(sticks & ABOVE(room, 1.5), v_splat(LATE_STICK), class);
  return v_select(sticks & ABOVE(room, 2.5) & ABOVE(f->q, 2), v_splat(EARLY_STICK), class);
#undef BELOW
#undef ABOVE
}

/* The collisions of a vector, all of one class, each by one arc. Lanes that turn out not to belong to it are not good. */
always void solve_class(int class, int abreast, const problem *c, const vreal *hint, const vmask *mask, outcome *o) {
  static const plan ways[FOLLOWED] = {
      [EARLY_STICK] = {.r = &stick_4, .n = 4, .most = 6, .sticks = true},
      [LATE_STICK] = {.r = &stick_6, .n = 6, .most = 8, .sticks = true},
      [COARSE] = {.r = &gauss_2, .n = 2, .most = 4},
      [MIDDLE] = {.r = &gauss_4, .n = 4, .most = 6},
      [FINE] = {.r = &gauss_6, .n = 6, .most = 8, .aimed = true},
  };
  static const struct {
    real F, p;
  } most[FOLLOWED] = {[EARLY_STICK] = {8e-6f, 3e-5f},
                      [LATE_STICK] = {4e-6f, 3e-5f},
                      [COARSE] = {1, 1},
                      [MIDDLE] = {2e-5f, 1e-4f},
                      [FINE] = {2e-5f, 2.5e-4f}};
  const plan *way = &ways[class];
  const real slack = c[0].slack;
  forecast f[MOST_ABREAST];
  vreal h[MOST_ABREAST], aim[MOST_ABREAST], change[MOST_ABREAST], enough[MOST_ABREAST];
  arc a[MOST_ABREAST];
  mark m[MOST_ABREAST];
  EACH_VECTOR(b) {
    f[b] = foresee(&c[b], 1 + c[b].e);
    const vreal q = way->sticks ? f[b].q : v_splat(1);
    const vreal pull = way->sticks ? f[b].pull + (real)0.1 * c[b].mu * c[b].mu_b : f[b].pull;
    change[b] = v_max(slack * (real)3e-6 * q * v_reciprocal(pull + (real)1e-9), v_splat(least_change));
    const vreal feel = f[b].pull + (way->sticks ? (real)0.1 * c[b].mu * c[b].mu_b : (real)0.2 * c[b].mu * f[b].z);
    const vreal wish = slack * (real)2e-8 * q * v_reciprocal((feel + (real)1e-9) * (feel + (real)0.003));
    enough[b] = v_max(v_min(wish, change[b]), v_splat(least_change));
    h[b] = class == FINE ? v_select(v_less(v_splat(0), hint[b]), hint[b], share_of_lambda(f[b].q, f[b].z))
                         : power_share(f[b].q, f[b].z);
    aim[b] = f[b].p_f;
  }
  run_arcs(way, abreast, a, c, f, h, aim, enough, mask);
  EACH_VECTOR(b) {
    if (way->sticks)
      arrive_stuck(way, &a[b], &c[b], &o[b]);
    else
      arrive_by_arc(way, &a[b], &c[b], way->n > 4 ? (real)0.06 : (real)0.03, &o[b], &m[b]);
    /* What an error of p costs: of a stick arc little, but near its end it decides whether the balls stick at all. */
    const vreal sticks_late = v_select(v_less(f[b].q, NUMBER(1.25)), c[b].mu_b, f[b].pull);
    if (!way->sticks) /* beyond, 1/λ³ is more than six nodes can follow */
      o[b].good &= v_less(a[b].h, NUMBER(0.62));
    o[b].good &= mask[b] & v_less_equal(a[b].change, change[b]) &
                 fits(way, &a[b], slack * most[class].F, way->sticks ? sticks_late : c[b].mu_b, slack * most[class].p);
  }
}

/* The longest way along d' that is clear of zero by arc_room. */
static const real arc_room = 1.4f;
always vreal clear_way(const problem *c, const forecast *f) {
  const vreal i = v_reciprocal_sqrt(c->d_x * c->d_x + c->d_y * c->d_y + TINY), pull = c->mu * c->mu_b;
  const vreal d = (c->d_x * c->d_x + c->d_y * c->d_y) * i, drag = (1 - (real)2.5 * c->s) * f->pull * i;
  const vreal g_x = f->g_x - drag * c->d_x, g_y = f->g_y - drag * c->d_y,
              per_g = v_reciprocal_sqrt(g_x * g_x + g_y * g_y + TINY);
  const vreal way = 2 * ((c->d_x * g_x + c->d_y * g_y) * per_g + arc_room * d) * per_g * (1 / (arc_room * arc_room - 1));
  return v_select(v_less(pull * d, NUMBER(1e-7) * c->slack), NUMBER(1e30),
                  v_max(way, c->slack * (real)1e-6 * v_reciprocal(pull + TINY)));
}
/* The direction half way once more, now with the drift of the slip along x and its spin: with the pooltool sign and strong
 * friction the slip may set out along +y, and a start along -y would settle on a branch that nothing real follows. */
always void face(const problem *c, vreal reach, forecast *f) {
  const vreal x = c->d_x + (real)0.5 * reach * f->g_x, y = c->d_y + (real)0.5 * reach * f->g_y;
  const vreal i = v_reciprocal(c->kappa * v_root(x * x + y * y + TINY) + c->mu * y + TINY);
  f->tau_x = x * i;
  f->tau_y = y * i;
}

/* Stick is so near that the direction of the slip over the cloth will not change: F follows from Q_2. */
always void finish_stick(const problem *c, const forecast *f, outcome *o) {
  const vreal F = (real)-0.4 * c->mu * c->u_z, per_kappa = v_reciprocal(c->kappa);
  o->F_x = F * f->tau_x;
  o->F_y = F * f->tau_y;
  o->Q_1 = (c->u_x + o->F_x) * per_kappa * (real)(1 / 3.5);
  o->Q_2 = (c->u_z + (real)2.5 * o->F_y) * per_kappa * (real)0.4;
  const vreal K = c->K + (c->v_n + (real)0.5 * c->kappa * f->p_f * v_reciprocal(f->q)) * o->F_y;
  o->K_c = v_select(c->seen, c->K_c, K);
  o->excess = excess_of(c, o->K_c, K, v_splat(0));
}

/* A vector of the other collisions on their way: arc by arc, graded towards the turn of the slip over the cloth and towards
 * stick. */
typedef struct walk {
  problem c;     /* what is left of them */
  outcome total; /* what has been done; good where the end is reached */
  vreal longest; /* of the next arc */
  vreal arcs;    /* tried */
  vmask running;
  vmask failed; /* the last arc did not fit */
} walk;
static const real longest_arc = 0.5f, most_arcs = 60;

always walk set_out(const problem *c, vmask mask) {
  const vreal zero = v_splat(0);
  return (walk){
      *c, {zero, zero, zero, zero, zero, zero, zero, v_from_bits(0)}, v_splat(longest_arc), zero, mask, v_from_bits(0)};
}

/* Where the rest is so short that it makes no odds how it goes, the lanes are done. */
always void finish(walk *w, const forecast *f, vreal left, vreal excess) {
  /* Stuck but for a trifle: what remains of p, squared over the slip's own scale, is what its direction can change. */
  const vreal rest = f->p_f * v_reciprocal(v_max(f->q, NUMBER(1e-9)));
  const vreal turned = v_min(rest, rest * rest * v_reciprocal(w->c.d_x * w->c.d_x + w->c.d_y * w->c.d_y + TINY));
  const vmask sticks = w->running & v_less(NUMBER(1.1), f->q) & v_less(f->pull * rest * turned, NUMBER(2e-8));
  if (v_any(sticks)) {
    forecast near = *f;
    outcome o;
    face(&w->c, rest, &near);
    finish_stick(&w->c, &near, &o);
    add(&w->total, &o, sticks);
  }
  const vmask there = w->running & v_not(sticks) & w->c.seen & v_less_equal(left, NUMBER(1e-7));
  w->total.excess = v_select(there, excess, w->total.excess);
  w->total.good |= there;
  w->running &= v_not(sticks | there);
}

/* One arc on: those that it carries to the end are no longer running; those that it does not fit try a shorter one next. */
always void follow(walk *w) {
  static const plan way = {.r = &gauss_6, .n = 6, .most = 8, .aimed = true};
  problem *c = &w->c;
  const vreal zero = v_splat(0), pull = c->mu * c->mu_b, per_kappa = v_reciprocal(c->kappa);
  const vreal excess = v_select(c->seen, excess_of(c, c->K_c, c->K, zero), zero);
  const vreal left = v_max(v_root(v_max(c->e * c->e + excess, v_splat(TINY))) - c->v_n * per_kappa, NUMBER(1e-7));
  forecast f = foresee(c, left);
  finish(w, &f, left, excess);
  if (!v_any(w->running))
    return;
  const vreal turn = clear_way(c, &f);
  const vmask clipped = v_less(turn, f.p_f);
  f = foresee(c, v_min(left, turn));
  face(c, v_min(f.p_f, turn), &f);
  const vreal h = v_select(v_less(f.q, NUMBER(0.98)), share_of_lambda(f.q, f.z), v_splat(1)), shorter = v_min(h, w->longest);
  const vreal aim = v_select(clipped | w->failed | v_less(w->longest, h), zero, f.p_f);
  const vreal wish = c->slack * (real)2e-8 * v_reciprocal((pull + (real)1e-9) * (pull + (real)0.03));
  const vreal enough = v_max(wish, v_splat(least_change));
  outcome o;
  mark m;
  arc a;
  run_arcs(&way, 1, &a, c, &f, &shorter, &aim, &enough, &w->running);
  const vreal beyond = arrive_by_arc(&way, &a, c, (real)0.02, &o, &m);
  const vmask sound = w->running & v_less(a.change * pull * m.p, v_splat((real)1e-6 * c->slack)) &
                      fits(&way, &a, (real)2e-5 * c->slack, c->mu_b, (real)1e-4 * c->slack);
  const vmask ends = sound & o.good, goes_on = sound & v_not(o.good) & v_less_equal(zero, beyond);
  const vmask too_long = sound & v_not(o.good) & v_less(beyond, zero);
  add(&w->total, &o, ends | goes_on);
  w->total.good &= v_not(goes_on);
  w->longest = v_select(goes_on, v_min(8 * a.h, v_splat(longest_arc)), (real)0.5 * a.h);
  w->longest = v_select(too_long, a.h * v_max(1 + beyond, NUMBER(0.3)), w->longest);
  advance(c, &a, &o, &m, goes_on);
  w->failed = w->running & v_not(goes_on);
  w->arcs += 1;
  w->running &= v_not(ends) & v_less(w->arcs, v_splat(most_arcs));
}

#endif
