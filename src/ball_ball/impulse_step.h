/* The step in the normal impulse, over Gauss nodes in p or, where the cloth slip turns, over those of turn.h. It leaves a part of
 * the way, or comes near the end of the collision, and from there by a Taylor series to the end. */
#ifndef CAROM_SRC_BALL_BALL_IMPULSE_STEP_H
#define CAROM_SRC_BALL_BALL_IMPULSE_STEP_H

#include "ball_ball/beyond.h"
#include "ball_ball/rules.h"
#include "ball_ball/turn.h"

/* How far the Taylor series is trusted, over the length of the step before it. */
static const float MOST_BEYOND = 0.03f, MOST_BEYOND_TURN = 0.1f;

/* The state behind a step of the length in *l, with the integrals of s_x and s_y over it, and those of c and sigma against their
 * values at first; K at v = 0 stays what it is. */
always state behind(const prediction *g, const step_law *l, const state *s, vreal X, vreal Y, vreal dC, vreal dZ, vreal K) {
  const vreal C = g->c + dC, Z = g->z + dZ;
  state end = *s;
  end.u_x = s->u_x + v_fma(l->k_x, C, -l->pull * X);
  end.u_z = s->u_z + v_fma(l->k_z, Z, l->k_y * Y);
  end.d_x = s->d_x + v_fma(l->on_d, X, -l->mu_b * C);
  end.d_y = (s->d_y - l->length) + v_fma(l->on_y, Z, l->on_d * Y);
  end.v = s->v + v_fma(l->pull_y, Y, l->length);
  end.K = s->K + K;
  end.J_c = v_fma(l->length, (g->c - s->c_0) + dC, s->J_c);
  end.J_z = v_fma(l->length, (g->z - s->z_0) + dZ, s->J_z);
  end.I_x = v_fma(l->length, X, s->I_x);
  end.I_y = v_fma(l->length, Y, s->I_y);
  return end;
}

/* K at v = 0, which lies at x in the rule's variable, or near it: from there by one more term, for a mean f.
 *
 * By parts, so that nothing but w_y is interpolated: int v w_y dX = v S - int S v' dX, with S for int w_y dX and
 * v' = L + pull_y w_y. */
always vreal K_by_parts(const gauss_rule *r, int n, const step_law *l, const state *s, vreal x, vreal f, const reg *w_y) {
  reg once[MOST_REGS], twice[MOST_REGS];
  integrals_up_to(r, n, x, once);
  polynomials_at(r->twice, n, 2 * x - 1, twice);
  const vreal S = sum_of_products(once, w_y, n), int_S = (x * x) * sum_of_products(twice, w_y, n);
  const vreal v = v_fma(l->length, x, v_fma(l->pull_y, S, s->v)), by_parts = v_fma(v_fma(0.5f * l->pull_y, S, -v), S, l->length * int_S);
  return v_fma(l->pull_y, by_parts, v_fma(-0.5f * f * (1 + f), v * v, s->K));
}

/* From *s on for a length, for which *g has been predicted. *next becomes the state behind the step; in the lanes of `last` that is
 * near the end of the collision, and *out becomes the solution. `turn`: over the nodes of that plan, else `turn` is NULL;
 * `by_parts`: v = 0 is where the first guess is. Returns an estimate of the error, in p; infinite if the end is not near. */
always vreal impulse_step(int n, int iterations, const problem *a, const prediction *g, vreal length, const turn_plan *turn, vmask last,
                          const state *s, state *next, solution *out) {
  const gauss_rule *r = n == 8 ? &gauss_8 : &gauss_4;
  const step_law l = law_of(a, g, length);
  mesh m;
  turn_range range = {0};
  if (turn != NULL)
    range = lay_nodes(r, turn, length, &m);
  else
    EACH_REG(k, n) m.X[k] = SPREAD(AT(r->node, k));
  directions f;
  find_directions(n, iterations, turn != NULL, r, a, g, s, &l, &m, &f);

  /* the whole step */
  reg work[MOST_REGS];
  EACH_REG(k, n) work[k] = -(l.pull_y * f.w_y[k]) * MADD(l.pull_y, f.S_y[k], MADD(length, m.X[k], s->v));
  const vreal X = dot(r->all, f.w_x, n), Y = dot(r->all, f.w_y, n);
  vreal dC, dZ;
  mean_turning(r, n, g, &f, &dC, &dZ);
  state end = behind(g, &l, s, X, Y, dC, dZ, dot(r->all, work, n));

  /* K at v = 0, where the mean f lets it be; if that is not near enough, at the second of Newton's points */
  const bool ends = out != NULL && turn == NULL;
  vmask passes = v_not(s->restitution) & v_less(v_splat(0), end.v);
  if (out != NULL)
    passes = passes | (v_not(s->restitution) & last);
  if (ends || v_any(passes)) {
    const vreal mean = -a->pull_y * Y, per = v_reciprocal((1 - mean) * length), zero = v_splat(0), one = v_splat(1);
    vreal share = v_min(v_max(-s->v * per, zero), one), K_c;
    if (ends)
      K_c = K_by_parts(r, n, &l, s, share, mean, f.w_y);
    else {
      reg up_to[MOST_REGS];
      vreal v_c = zero;
      lanes_rolled for (int i = 0; i < 2; i++) {
        share = i == 0 ? share : v_min(v_max(share - v_c * per, zero), one);
        integrals_up_to(r, n, turn != NULL ? node_of_share(&range, share) : share, up_to);
        v_c = s->v + v_fma(length, share, l.pull_y * sum_of_products(up_to, f.w_y, n));
      }
      K_c = s->K + (sum_of_products(up_to, work, n) - 0.5f * mean * v_c * v_c);
    }
    end.K_c = v_select(passes, K_c, s->K_c);
  }
  end.restitution = s->restitution | passes;

  const arrival at_end = arrive(a, &end);
  vreal error = iteration_error(a, &l, f.moved);
  if (!ends) {
    /* the defect of the polynomials at the end, which is the first coefficient that the nodes leave out */
    const vreal defect = v_abs(dot(r->end, f.c, n) - at_end.c) + v_abs(dot(r->end, f.z, n) - at_end.z);
    error = v_fma(4 * l.mu_b, defect * defect, error);
    *next = end;
  }
  if (out == NULL || !v_any(last))
    return error;

  /* to the end of the collision */
  vreal third_x = v_splat(0), third_y = third_x;
  if (turn == NULL) {
    const vreal per = v_reciprocal(length), per_2 = per * per;
    third_x = per_2 * dot(r->third, f.s_x, n);
    third_y = per_2 * dot(r->third, f.s_y, n);
  }
  const vreal way = v_abs(finish(a, &end, &at_end, third_x, third_y, out));
  if (turn != NULL) {
    /* the third term, as large as the distance from the turn lets it be */
    const vreal apart = length - turn->at, left_out = a->pull * way * (way * way) * v_reciprocal(v_fma(apart, apart, turn->width * turn->width));
    error = error + v_select(last, left_out, v_splat(0));
  }
  const vmask in_reach = v_less(way, (turn != NULL ? MOST_BEYOND_TURN : MOST_BEYOND) * length);
  return v_select(in_reach | v_not(last), error, v_splat(HUGE_VALF));
}

/* To the end, of which `to_end` is the way that would be left without work on friction. */
always vreal end_step(int n, int iterations, const problem *a, const prediction *g, const state *s, vreal to_end, solution *out) {
  const vreal f = -a->pull_y * g->z * g->t_y;
  return impulse_step(n, iterations, a, g, to_end * v_fma(f, 1 + f, v_splat(1)), NULL, v_all(), s, NULL, out);
}

#endif
