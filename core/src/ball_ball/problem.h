/* A collision as the collocation steps see it: constants, variables, predictions, the
 * solution. In units of |v_n0| / kappa, so that the impulse that stops
 * a ball without friction is 1; reduced.h has the symbols. Instead of v_n there is v = v_n /
 * kappa, which starts at -1 and has the slope 1 - f with f = f_y / kappa = -pull_y sigma t_y.
 *
 * THE END of the collision: v' = 1 - f times v, integrated, gives v^2 / 2 + K = int v dp with K
 * = int v f dp, the work on the cloth's friction. Restitution returns e^2 of the work of
 * compression, so that v^2 = e^2 + 2 (1 - e^2) K_c - 2 K at the end, with K_c for K at v = 0,
 * where it is stationary. K is small, so no difference of large numbers is taken. */
#ifndef CAROM_SRC_BALL_BALL_PROBLEM_H
#define CAROM_SRC_BALL_BALL_PROBLEM_H

#include "ball_ball/carrier.h"
#include "ball_ball/kernels.h"

static const real TINY = REAL(1e-36); /* keeps 0 / 0 away */
/* Of a step's tolerance, for the error after its iteration. By `carom-lab stress --draws 60000`
 * errors reach 8.2e-7 with twice of it instead of 3.5e-7, and with half no time is lost beyond
 * the 4 % that times vary. */
static const real ITERATION_SHARE = REAL(0.5);

/* The constants of a collision. */
typedef struct problem {
  vreal kappa, per_kappa, mu, mu_b, e;
  vreal mu_mu_b, mu_mu_b_y; /* mu mu_b; mu mu_b / kappa */
  real spin;                /* 5/2 s */
  vreal tolerance;          /* of a step's error estimate, in p */
  vreal no_slip;            /* square of the mu mu_b |d| below which the cloth slip does not
                               matter */
  vmask sensitive;          /* see is_sensitive() */
} problem;

/* The variables, number by number or as columns. */
enum { STATE_COLUMNS = 13 };
typedef struct state {
  union {
    struct {
      vreal u_x, u_z, d_x, d_y, v;
      vreal K, K_c;             /* int v f dp so far, and at v = 0 */
      vreal c_0, z_0;           /* direction of u at the start of the collision */
      vreal J_c, J_z, I_x, I_y; /* integrals over p of c - c_0, sigma - z_0, sigma t */
    };
    vreal column[STATE_COLUMNS];
  };
  vmask restitution; /* v = 0 has been passed */
} state;

always state choose_state(vmask m, const state *yes, const state *no) {
  state s;
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) s.column[c] =
      v_select(m, yes->column[c], no->column[c]);
  s.restitution = (m & yes->restitution) | (v_not(m) & no->restitution);
  return s;
}

/* The solution: those integrals over the complete collision, the overshoot of p beyond 1 + e, p
 * where the balls stuck (-1: they did not), K_c. */
typedef struct solution {
  vreal J_c, J_z, I_x, I_y, overshoot, stick, K_c;
} solution;

/* A prediction from a state, for a step of a given length in p. */
typedef struct prediction {
  vreal inverse_u, c, z; /* 1 / |u| and the direction of u */
  vreal t_x, t_y;        /* direction of d half way */
  vreal rate;            /* fraction of |u| lost per p; its inverse is about p to stick */
} prediction;

/* sqrt(x^2 + y^2) inverted, as closely as needed. */
always vreal inverse_length(vreal x, vreal y) {
  return v_reciprocal_sqrt(v_fma(x, x, v_fma(y, y, v_splat(TINY))));
}

/* A pressed ball has no slip on the cloth if mu mu_b |d| is below this fraction of the tolerance;
 * in sensitive collisions, if its square is below this number, which is true for a ball at rest. */
static const real NO_SLIP = REAL(0.03);
static const real NO_SLIP_SENSITIVE = REAL(1e-26);

always vmask has_no_slip(const problem *a, const state *s) {
  return v_less(a->mu_mu_b * a->mu_mu_b * v_fma(s->d_x, s->d_x, s->d_y * s->d_y), a->no_slip);
}

/* Is the result sensitive to the direction t of the cloth slip where |d| is small? With
 * pooltool's slip, friction of the cloth drives d along t, by own = (5/2 s - 1) mu mu_b per p,
 * and friction of the balls drives it in one direction, by
 * 1 - 5/2 s mu_b or more. While |d| grows at the rate drift, the difference of the two, an error
 * of t decreases only like |d|^(own / drift - 1), and an error of d made at |d| = w reaches the
 * result multiplied by w^(-own / drift). */
static const real SENSITIVE = REAL(0.12); /* own / drift; at twice this, errors of 1e-6 occur in
                                         collisions of play */
always vmask is_sensitive(const problem *a) {
  const vreal drive = (a->spin - 1) * a->mu_mu_b,
              drift = v_fma(v_splat(-a->spin), a->mu_b, 1 - drive);
  return v_less(SENSITIVE * drift, drive);
}

always prediction predict(const problem *a, const state *s, vreal length) {
  prediction g;
  g.inverse_u = inverse_length(s->u_x, s->u_z);
  const vreal rough =
      v_rough_reciprocal_sqrt(v_fma(s->u_x, s->u_x, v_fma(s->u_z, s->u_z, v_splat(TINY))));
  g.c = s->u_x * g.inverse_u;
  g.z = s->u_z * g.inverse_u;
  /* d runs straight, but for the friction between the balls */
  const vreal half = REAL(0.5) * length, friction = half * a->mu_b * rough;
  const vreal d_x = v_fma(-friction, s->u_x, s->d_x),
              d_y = v_fma(friction * a->spin, s->u_z, s->d_y - half);
  const vreal i_d = v_rough_reciprocal_sqrt(v_fma(d_x, d_x, v_fma(d_y, d_y, v_splat(TINY))));
  g.t_x = d_x * i_d;
  g.t_y = d_y * i_d;
  /* |u|' at first; as u turns towards z it falls more slowly, which the last factor represents */
  const vreal c2 = g.c * g.c, cloth = a->mu * g.z * v_fma(REAL(2.5) * g.t_y, g.z, g.t_x * g.c);
  g.rate = (a->mu_b * g.inverse_u) * v_fma(a->kappa, REAL(2.5) + c2, cloth) *
           v_fma(REAL(-0.182) * c2, 1 - c2, v_splat(1));
  return g;
}

/* v^2 at the end beyond e^2, if no more work were done on the cloth's friction than so far. */
always vreal work_returned(const problem *a, vreal K_c, vreal K) {
  return 2 * v_fma(v_fma(-a->e, a->e, v_splat(1)), K_c, -K);
}

/* p to the end of the collision, if no work were done on friction from here. */
always vreal impulse_to_end(const problem *a, const state *s) {
  const vreal square =
      v_fma(a->e, a->e, work_returned(a, v_select(s->restitution, s->K_c, s->K), s->K));
  return v_sqrt(v_max(square, v_splat(0))) - s->v;
}

/* Columns of kernels.h, in a register each. */
#ifdef CAROM_LANES_ONE
typedef real column;
typedef const real in_column;
#define COLUMN(columns, k) ((columns)[k])
#else
typedef lane_column column, in_column;
#define COLUMN(columns, k) v_load(LANE_NUMBERS((columns)[k]))
#endif

always problem problem_of(in_column *columns, real spin, real tolerance) {
  problem a;
  a.kappa = COLUMN(columns, IN_KAPPA);
  a.mu = COLUMN(columns, IN_MU);
  a.mu_b = COLUMN(columns, IN_MU_B);
  a.e = COLUMN(columns, IN_E);
  a.spin = spin;
  /* the smaller e, the more an error in p changes the velocities at the end */
  a.tolerance = tolerance * v_min(2 * a.e, v_splat(1));
  a.per_kappa = v_reciprocal(a.kappa);
  a.mu_mu_b = a.mu * a.mu_b;
  a.mu_mu_b_y = a.mu_mu_b * a.per_kappa;
  a.sensitive = is_sensitive(&a);
  a.tolerance = v_select(a.sensitive, REAL(0.5) * a.tolerance, a.tolerance);
  a.no_slip = v_select(a.sensitive, v_splat(NO_SLIP_SENSITIVE),
                       (NO_SLIP * a.tolerance) * (NO_SLIP * a.tolerance));
  return a;
}

/* At the start. */
always state state_of(const problem *a, in_column *columns) {
  state s;
  s.u_x = COLUMN(columns, IN_U_X);
  s.u_z = COLUMN(columns, IN_U_Z);
  s.d_x = COLUMN(columns, IN_D_X);
  s.d_y = COLUMN(columns, IN_D_Y);
  s.v = v_splat(-1);
  s.K = s.K_c = s.J_c = s.J_z = s.I_x = s.I_y = v_splat(0);
  s.restitution = v_less(v_splat(0), v_splat(0));
  const prediction g = predict(a, &s, v_splat(1));
  s.c_0 = g.c;
  s.z_0 = g.z;
  return s;
}

always void put_column(column *columns, int k, vreal x) {
#ifdef CAROM_LANES_ONE
  columns[k] = x;
#else
  v_store(LANE_NUMBERS(columns[k]), x);
#endif
}

always void put_solution(const solution *s, column *out) {
  put_column(out, OUT_J_C, s->J_c);
  put_column(out, OUT_J_Z, s->J_z);
  put_column(out, OUT_I_X, s->I_x);
  put_column(out, OUT_I_Y, s->I_y);
  put_column(out, OUT_OVERSHOOT, s->overshoot);
  put_column(out, OUT_STICK, s->stick);
  put_column(out, OUT_K_C, s->K_c);
}

#endif
