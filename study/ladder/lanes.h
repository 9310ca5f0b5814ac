/* The text of the rungs across collisions: Mathavan's steps on WIDTH collisions at once, one
 * collision in each lane of a vector.
 *
 * A rung that includes this file once says before it what a vector is: `real`, `vector`, `mask`,
 * LANES (the lanes of a vector), WIDTH (the collisions of a call, a multiple of LANES),
 * LANES_TARGET, and these operations:
 *
 *     every(x)             x in each lane
 *     less(a, b)           the lanes where a < b
 *     at_most(a, b)        the lanes where a <= b
 *     any(m)               whether m has a lane
 *     all_lanes()          every lane
 *     keep(m, a)           a in the lanes of m, 0 in the others
 *     choose(m, a, b)      a in the lanes of m, b in the others
 *     magnitude(x)         |x|
 *     plus_product(s, a, b), minus_product(s, a, b)
 *                          s + ab and s - ab as one operation, which fast-math may not regroup
 *     rsqrt(x)             about 1/sqrt(x), infinity for 0
 *
 * The arithmetic of a step is that of `double`. The lanes of a vector are at different points of
 * their collisions, so there are no branches: the pressed ball is chosen in each lane, and the
 * impulses on the other ball are 0. A lane that has ended receives impulses of 0 only, so that
 * it keeps its own final state while others still run.
 *
 * A vector waits for its own chain of operations as a single collision does. WIDTH / LANES
 * vectors side by side fill that time.
 */
typedef struct lane_group {
  vector v_ix, v_iy, w_ix, w_iy, w_iz;
  vector v_jx, v_jy, w_jx, w_jy, w_jz;
  vector R, sR, recM, C;
  vector mu_b_DP; /* -mu_b DP */
  vector mu_i, mu_j;
  vector DP_recM;
  vector work_ratio; /* 1 + e², of all work to that of compression */
  vector v_n, W, W_f;
  mask running, compressing;
} lane_group;

LANES_TARGET static inline void put_lane(lane_group *g, int lane, const carom_local *c, int N) {
  const double recM = 1.0 / c->M_i;
  const double v_n = c->v_jy - c->v_iy;
  const double DP = 0.5 * (1.0 + c->e) * c->M_i * fabs(v_n) / N;

  g->v_ix[lane] = (real)c->v_ix;
  g->v_iy[lane] = (real)c->v_iy;
  g->w_ix[lane] = (real)c->w_ix;
  g->w_iy[lane] = (real)c->w_iy;
  g->w_iz[lane] = (real)c->w_iz;
  g->v_jx[lane] = (real)c->v_jx;
  g->v_jy[lane] = (real)c->v_jy;
  g->w_jx[lane] = (real)c->w_jx;
  g->w_jy[lane] = (real)c->w_jy;
  g->w_jz[lane] = (real)c->w_jz;

  g->R[lane] = (real)c->R;
  g->sR[lane] = (real)(c->s * c->R);
  g->recM[lane] = (real)recM;
  g->C[lane] = (real)(2.5 * recM / c->R);
  g->mu_b_DP[lane] = (real)(-c->mu_b * DP);
  g->mu_i[lane] = (real)c->mu_i;
  g->mu_j[lane] = (real)-c->mu_j;
  g->DP_recM[lane] = (real)(DP * recM);
  g->work_ratio[lane] = (real)(1.0 + c->e * c->e);
  g->v_n[lane] = (real)v_n;
}

LANES_TARGET static inline void take_lane(const lane_group *g, int lane, carom_local *c) {
  c->v_ix = g->v_ix[lane];
  c->v_iy = g->v_iy[lane];
  c->w_ix = g->w_ix[lane];
  c->w_iy = g->w_iy[lane];
  c->w_iz = g->w_iz[lane];
  c->v_jx = g->v_jx[lane];
  c->v_jy = g->v_jy[lane];
  c->w_jx = g->w_jx[lane];
  c->w_jy = g->w_jy[lane];
  c->w_jz = g->w_jz[lane];
}

LANES_TARGET static inline __attribute__((always_inline)) void step(lane_group *g) {
  const mask running = g->running;

  /* Slip and impulses between the balls; both 0 where the balls do not slip. */
  const vector u_x = g->v_ix - g->v_jx - g->R * (g->w_iz + g->w_jz);
  const vector u_z = g->R * (g->w_ix + g->w_jx);
  const vector ru = rsqrt(u_x * u_x + u_z * u_z);
  const mask slipping = at_most(ru, every((real)1e16)) & running;
  const vector t = keep(slipping, g->mu_b_DP * ru);
  const vector DP1 = t * u_x;
  const vector DP2 = t * u_z;

  /* The slip p over the cloth of the ball that is pressed into it, and the impulse of the cloth;
   * 0 where that ball does not slip. */
  const mask j_pressed = less(u_z, every((real)0));
  const mask on_j = j_pressed & running;
  const mask on_i = at_most(every((real)0), u_z) & running;
  const vector p_x =
      choose(j_pressed, g->v_jx, g->v_ix) + g->sR * choose(j_pressed, g->w_jy, g->w_iy);
  const vector p_y =
      choose(j_pressed, g->v_jy, g->v_iy) - g->sR * choose(j_pressed, g->w_jx, g->w_ix);
  const vector rp = rsqrt(p_x * p_x + p_y * p_y);
  const vector mu_DP2 = choose(j_pressed, g->mu_j, g->mu_i) * DP2;
  const vector t_p = keep(less(rp, every((real)INFINITY)), mu_DP2 * rp);
  const vector P_x = t_p * p_x;
  const vector P_y = t_p * p_y;

  /* What acts on both balls comes first, as in `reorder`. */
  g->v_ix = plus_product(g->v_ix, DP1, g->recM);
  g->v_jx = minus_product(g->v_jx, DP1, g->recM);
  g->v_iy -= keep(running, g->DP_recM);
  g->v_jy += keep(running, g->DP_recM);
  g->w_ix = plus_product(g->w_ix, g->C, DP2);
  g->w_jx = plus_product(g->w_jx, g->C, DP2);
  g->w_iz = minus_product(g->w_iz, g->C, DP1);
  g->w_jz = minus_product(g->w_jz, g->C, DP1);

  /* The cloth, on the pressed ball. */
  g->v_ix = plus_product(g->v_ix, keep(on_i, P_x), g->recM);
  g->v_iy = plus_product(g->v_iy, keep(on_i, P_y), g->recM);
  g->w_ix = plus_product(g->w_ix, keep(on_i, P_y), g->C);
  g->w_iy = minus_product(g->w_iy, keep(on_i, P_x), g->C);
  g->v_jx = plus_product(g->v_jx, keep(on_j, P_x), g->recM);
  g->v_jy = plus_product(g->v_jy, keep(on_j, P_y), g->recM);
  g->w_jx = plus_product(g->w_jx, keep(on_j, P_y), g->C);
  g->w_jy = minus_product(g->w_jy, keep(on_j, P_x), g->C);

  const vector v_n = g->v_jy - g->v_iy;
  g->W += keep(running, magnitude(g->v_n + v_n));
  g->v_n = v_n;

  /* Compression ends where v_n is above 0 or NaN, so every lane ends. */
  const mask still_compressing = g->compressing & at_most(v_n, every((real)0));
  const mask turning = g->compressing ^ still_compressing;
  g->W_f = choose(turning, g->work_ratio * g->W, g->W_f);
  g->compressing = still_compressing;
  g->running = running & (still_compressing | less(g->W, g->W_f));
}

LANES_TARGET static inline void run_lanes(carom_local *state, int N) {
  enum { GROUPS = WIDTH / LANES };
  lane_group group[GROUPS];
  for (int k = 0; k < GROUPS; k++) {
    for (int lane = 0; lane < LANES; lane++)
      put_lane(&group[k], lane, &state[k * LANES + lane], N);
    group[k].W = every((real)0);
    group[k].W_f = every((real)0);
    group[k].running = all_lanes();
    group[k].compressing = all_lanes();
  }

  for (bool running = true; running;) {
    running = false;
#pragma GCC unroll 8
    for (int k = 0; k < GROUPS; k++) {
      step(&group[k]);
      running |= any(group[k].running);
    }
  }

  for (int k = 0; k < GROUPS; k++)
    for (int lane = 0; lane < LANES; lane++)
      take_lane(&group[k], lane, &state[k * LANES + lane]);
}
