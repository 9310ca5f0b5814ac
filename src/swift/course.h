/* A collision arc by arc: which arc comes next, how long it may be, and where the collision ends.
 *
 * THE END. v_n' = kappa - f_y times v_n says kappa d(int v_n dp) = d(v_n^2 / 2 + K) with K = int v_n dF_y: with K_c at v_n = 0,
 * restitution in the sense of work is v_n^2 = e^2 v_n0^2 + 2 (1 - e^2) K_c - 2 K. K is small; without it the end is known in
 * advance, and K and F mend it by a series. K_c hardly depends on where v_n = 0 is, v_n being 0 there.
 *
 * WHICH ARC. `look` tells about where the balls would stick. What ends well before that is one arc in the impulse; where most
 * of the slip between the balls is lost, arcs follow each other, each up to a share of the way to stick; near it, or where
 * stick is certain, one arc runs to stick, and beyond it v_n has slope kappa. Where the pressed ball's slip on the cloth turns
 * close to zero, arcs are as short as its direction asks for (`clear_way`). */
#ifndef CAROM_SRC_SWIFT_COURSE_H
#define CAROM_SRC_SWIFT_COURSE_H

#include "impulse_arc.h"
#include "stick_arc.h"
#include "swift/rules.h"

#include <stdbool.h>

/* Limits, found by trial on some 10,000 collisions of 33 kinds and on sweeps of single inputs: docs/numerics.md.
 * Shares of the way to stick: */
static const float SINGLE = 0.6f;                 /* an arc that ends the collision */
static const float ONE_OF = 0.5f;                 /* and one of several */
static const float CERTAIN = 0.97f, SURE = 1.02f; /* from where on an arc to stick is worth it, and will get there */
/* The whole way of the collision over that to stick: */
static const float LATE = 4;  /* from here on it need not be sure */
static const float FAR = 16;  /* 4 nodes do */
static const float NEAR = 40; /* they do even where the collision may end before */
/* How clear of zero d keeps on an arc in the impulse, on one to stick, and there with 4 nodes: see `clear`. */
static const float ROOM = 4, STICK_ROOM = 3.5f, FAR_ROOM = 6;
/* Over the approach: */
static const float RESTING = 3e-8f;     /* mu mu_b |d| that makes no odds */
static const float LEAST_WAY = 1e-8f;   /* mu mu_b p that makes no odds */
static const float TURN_ENOUGH = 2e-8f; /* error of F where d turns */
static const float ROUGH_SLOPE = 1e-4f; /* highest coefficient of p on a stick arc whose inside is asked for */
static const float FELT = 0.02f;        /* mu mu_b from which the ends of compression and collision are found in two steps */
static const float APART = 0.012f;      /* (1 - e^2) mu mu_b / e from which compression and restitution are arcs of their own */
static const float BEYOND = 0.02f;      /* share of an arc beyond its end that its polynomials are trusted */
static const float SERIES = 0.025f;     /* largest k of `rest_of_way` */
enum { MOST_ARCS = 60 };

/* What moves. */
typedef struct state {
  pair u, d; /* slips: u_x, u_z; d_x, d_y */
  double v, p;
  pair Q, F; /* Q_1, Q_2; F_x, F_y */
  double K;
} state;
/* What stays, and what has been seen on the way. */
typedef struct course {
  double v_n0, e, kappa, per, mu, mu_b, s;
  double K_c, p_stick;
  int seen;  /* v_n = 0: K_c is known */
  int stuck; /* as in carom_exact_report */
  int evaluations;
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
  const float as_expected = (float)t.p * g->rate; /* or W has run away, where 1 / (kappa + mu t_y) is large */
  if (!(as_expected > 0.25f && as_expected < 4))
    return false;
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

/* Which arc comes next. */
typedef struct choice {
  enum { LAST, PART, STICK } arc; /* to the end; part of the way; to where the balls stick */
  float way;
  int far; /* stick is so near that 4 nodes do */
} choice;

/* `length`: to the expected end; `whole`: the same at the start of the collision; `share` of what is usual; `inside`: an arc to
 * stick has not been refused. */
always choice choose(const law *m, const glance *g, float length, float whole, float share, int inside) {
  const float to_stick = g->rate * length, lateness = g->rate * whole;
  choice c = {.arc = LAST, .way = length};
  if (to_stick > SINGLE * share) {
    const int worth = to_stick > CERTAIN && inside && (to_stick > SURE || lateness > LATE);
    c.arc = worth || lateness > NEAR ? STICK : PART;
    c.way = c.arc == PART ? share * ONE_OF / g->rate : to_stick > 1 ? 1.1f / g->rate : length;
  }
  if (!clear(m, g, c.way, c.arc == STICK ? STICK_ROOM : ROOM)) {
    const float most = share * clear_way(*m, *g);
    if (most < c.way) {
      c.arc = PART;
      c.way = at_most(most < 0.9f * c.way ? most : 0.5f * c.way, share * ONE_OF / g->rate);
    }
  }
  c.far = c.arc == STICK && lateness > FAR && clear(m, g, c.way, FAR_ROOM);
  return c;
}

/* The rest of the way after a last arc, over the impulse that stops the balls from v_end; infinite if a series would not do.
 *
 * With v_n = 1 / n - G at the arc's end, b = G n and y = kappa n (p_end - p), the end is where 2 (1 - b) y + (1 - h) y^2 = 2 k
 * + b (2 - b), h = f_y / kappa; so y = b + z, z = k + h (b^2 / 2 + b k) - (1 - h) k^2 / 2 + k^3 / 2 and little more. */
always float rest_of_way(float b, float k, float h) {
  const float z = k * (1 + h * (b + 0.5f * k) - 0.5f * k * (1 - k)) + 0.5f * h * b * b;
  return fabsf(k) < SERIES ? b + z : HUGE_VALF;
}

/* From the start to the end; false if that is not for these arcs. */
always bool follow(const law *m, course *s, state *a) {
  const double e2 = s->e * s->e;
  double v_end = -s->e * s->v_n0, stretch = 1; /* the speed at the end, so far as K is known; correction of the way to it */
  float whole = 0, share = 1;
  int inside = 1;
  const int apart = (float)(1 - e2) * m->pull > APART * (float)s->e;
  for (int arcs = 0; arcs < MOST_ARCS; arcs++) {
    const double left = (v_end - a->v) * s->per;
    double length = left * stretch;
    const glance g = look(m, a, (float)length);
    if (arcs == 0)
      whole = (float)length;
    choice next = choose(m, &g, (float)length, whole, share, inside);
    const float to_c =
        -g.v * m->per; /* about where v_n = 0: integrals up to the end of an arc are better than up to its inside */
    if (next.arc == LAST && apart && to_c > 0.2f * next.way && to_c < 0.9f * next.way)
      next = (choice){.arc = PART, .way = to_c};
    if (next.arc == STICK) {
      if (next.far ? end_by_stick(m, s, &g, &stick_4, 1, a) : end_by_stick(m, s, &g, &stick_8, 2, a))
        return true;
      if (!inside || g.rate * whole > NEAR)
        return false;
      inside = 0;
      continue;
    }
    if (next.arc == PART)
      length = next.way;
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
    if (m->pull > FELT) { /* once more by Newton's method */
      x_c += (g.v + m->kappa * q.L * x_c + q.pull * work[3]) * to_v;
      work = arc_work(&q, &gauss_4, x_c);
    }
    quad end = all;
    if (next.arc == LAST) {
      const float n = 1 / (float)v_end,
                  y = rest_of_way(-(q.pull * n) * all[3] - (m->kappa * n) * (float)(length - left),
                                  (n * n) * ((s->seen ? 0 : (float)(1 - e2) * work[1]) - work[0]),
                                  work[2] * m->per * to_v * m->kappa),
                  dx = y * (m->per / (n * q.L));
      if (!(fabsf(dx) < BEYOND)) {
        if (!(fabsf(dx) < 0.5f))
          return false;
        stretch = length / left * (1 + dx);
        continue;
      }
      end = arc_integrals_beyond(&q, &gauss_4, all, dx);
      a->p += (double)(y * (m->per / n));
    }
    const pair Q = wide_low(end) * both(s->mu_b * length), F = wide_high(end) * both(-s->mu * s->mu_b * length);
    a->Q += Q;
    a->F += F;
    a->p += length;
    if (next.arc == LAST) {
      if (!s->seen)
        s->K_c = a->K + work[1];
      s->p_stick = a->p;
      return true;
    }
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

#endif
