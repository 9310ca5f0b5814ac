/* An arc in the impulse p: four Gauss nodes, and on them the directions of both slips, found by sweeps.
 *
 * With x from 0 to 1 along the arc, L its length in p, c = u_x / |u| and sigma = u_z / |u|, everything is linear in C, Z and S,
 * the integrals of c, sigma and sigma t over x (the equations, and the sign s, are those of exact.c):
 *
 *     u_x = u_x0 - 7/2 kappa mu_b L C - mu mu_b L S_x        u_z = u_z0 - 5/2 kappa mu_b L Z - 5/2 mu mu_b L S_y
 *     d_x = d_x0 - mu_b L C - (1 - 5/2 s) mu mu_b L S_x      d_y = d_y0 - L x + 5/2 s mu_b L Z - (1 - 5/2 s) mu mu_b L S_y
 *
 * A sweep takes c, sigma and sigma t at the nodes to the slips there, by one matrix, and these to new directions, by two
 * inverse roots: no longer chain of operations stands between two sweeps. What the cloth does gains a factor of about 50 by a
 * sweep; u, which turns by itself, gains less the more of it is lost on the arc. Part of that is foreseen: a new direction is
 * mixed with the old one (`keep`), since what turns u back is the friction of the direction itself.
 *
 * Single precision is enough: the integrals are multiplied by mu_b, some hundredths. */
#ifndef CAROM_SRC_SWIFT_IMPULSE_ARC_H
#define CAROM_SRC_SWIFT_IMPULSE_ARC_H

#include "law.h"

/* part: coefficients of the integrals up to x, as polynomials of x over x; last, bend: value and slope at x = 1 */
typedef struct gauss_rule {
  const quad *node, *sum, *all, *part, *last, *bend;
} gauss_rule;

typedef struct impulse_arc {
  float L;
  quad c, z, s_x, s_y; /* at the nodes: c, sigma, sigma t */
  quad v;              /* and v_n */
  float pull;          /* mu mu_b L: F = -pull S */
  int sweeps;
  int settled; /* sweeps came to an end */
} impulse_arc;

static const float ENOUGH = 2.5e-7f; /* what a sweep may leave of friction, over the normal impulse */
static const float KEEP = 0.25f;     /* found by trial: 0.15 to 0.3 cost about the same */
enum { SWEEPS = 8 };

/* From what `g` saw, L onwards. */
always impulse_arc run_impulse_arc(const law *m, const glance *g, const gauss_rule *r, float L) {
  const float mb = m->mu_b * L, pull = m->mu * mb, on_d = (1 - m->spin) * -pull, on_y = m->spin * mb;
  const float k_x = -3.5f * m->kappa * mb, k_z = -2.5f * m->kappa * mb;
  const quad x = r->node[0], d_y0 = g->d_y - L * x;
  /* the first directions: d straight on; u turning as at first, to third order */
  const float beta = m->kappa * mb * g->i, c2 = g->c * g->c, loss = beta * (2.5f + c2), turning = beta * g->c * g->z;
  const float w_1 = pull * g->z * g->i * (2.5f * g->t_y * g->c - g->t_x * g->z) - turning,
              w_2 = -beta * turning * (0.75f + 1.5f * c2), w_3 = -beta * beta * turning * (1 + c2 * (2 + 3 * c2));
  const quad w = x * (w_1 + x * (w_2 + x * w_3)), w2 = (0.5f * w) * w;
  const quad f_x = g->d_x - (mb * x) * g->c, f_y = d_y0 + (on_y * x) * g->z, f_2 = f_x * f_x + f_y * f_y + NOTHING,
             f_r = rough_inverse_root(f_2), f_i = f_r * finer(f_2, f_r);
  impulse_arc q = {.L = L, .pull = pull};
  quad c = g->c + g->z * w - g->c * w2, z = g->z - g->c * w - g->z * w2, s_x = (z * f_i) * f_x, s_y = (z * f_i) * f_y, S_y;
  const quad back = (KEEP * beta * (2.5f + g->z * g->z)) * x, keep = back / (1 - (g->rate * L) * x + back), take = 1 - keep;
  const quad limit = all4(ENOUGH / (2 * m->pull + loss * (0.1f + 0.3f * loss * loss) + 0.003f));
  quad moved;
  do {
    quad C, Z, S_x;
    apply(r->sum, &c, &C, 1);
    apply(r->sum, &z, &Z, 1);
    apply(r->sum, &s_x, &S_x, 1);
    apply(r->sum, &s_y, &S_y, 1);
    const quad u_x = g->u_x + k_x * C - pull * S_x, u_z = g->u_z + k_z * Z - (2.5f * pull) * S_y;
    const quad d_x = g->d_x - mb * C + on_d * S_x, d_y = d_y0 + on_y * Z + on_d * S_y;
    const quad u2 = u_x * u_x + u_z * u_z + NOTHING, d2 = d_x * d_x + d_y * d_y + NOTHING;
    const quad u_i = rough_inverse_root(u2), d_i = rough_inverse_root(d2), u_f = finer(u2, u_i), d_f = finer(d2, d_i);
    const quad u_c = (u_x * u_i) * u_f, u_s = (u_z * u_i) * u_f, new_z = take * u_s + keep * z;
    const quad new_x = new_z * ((d_x * d_i) * d_f), new_y = new_z * ((d_y * d_i) * d_f);
    moved = m->mu_b * (size4(u_c - c) + size4(u_s - z)) + m->pull * (size4(new_x - s_x) + size4(new_y - s_y));
    c = take * u_c + keep * c;
    z = new_z;
    s_x = new_x;
    s_y = new_y;
    q.sweeps++;
    q.settled = !any4(moved > limit);
  } while (!q.settled && q.sweeps < SWEEPS);
  q.c = c;
  q.z = z;
  q.s_x = s_x;
  q.s_y = s_y;
  q.v = g->v + (m->kappa * L) * x + pull * S_y;
  return q;
}

/* { C, Z, S_x, S_y } over the whole arc, and by the slope there a little (dx) further */
always quad arc_integrals(const impulse_arc *q, const gauss_rule *r) {
  return dots(r->all, &q->c, &q->z, &q->s_x, &q->s_y, 1);
}
always quad arc_integrals_beyond(const impulse_arc *q, const gauss_rule *r, quad all, float dx) {
  const quad slope = dots(r->last, &q->c, &q->z, &q->s_x, &q->s_y, 1), bend = dots(r->bend, &q->c, &q->z, &q->s_x, &q->s_y, 1);
  return all + dx * (slope + (0.5f * dx) * bend);
}
/* { int v_n dF_y over the arc, the same up to x_c, -f_y L at its end, S_y up to x_c } */
always quad arc_work(const impulse_arc *q, const gauss_rule *r, float x_c) {
  const quad part = x_c * ((r->part[0] + x_c * r->part[1]) + (x_c * x_c) * (r->part[2] + x_c * r->part[3]));
  const quad g = -q->pull * (q->v * q->s_y);
  return sums4(r->all[0] * g, part * g, q->pull * (r->last[0] * q->s_y), part * q->s_y);
}

#endif
