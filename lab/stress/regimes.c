/* regimes.c - every regime is a choice made in the collision frame (slips, spins, frictions),
 * then turned by a random angle (in half of the draws by none, so that zeros stay exactly zero). */
#include "draws.h"

/* clang-format off */
#define REGIMES(X) \
  X(real_shot) X(slow) X(fast) X(grazing) X(head_on) X(draw) X(follow) X(stun) X(sidespin) \
  X(both_moving) X(both_rolling) X(pressed_rolling) X(stick_early) X(stick_compression) \
  X(stick_restitution) X(stick_at_v0) X(stick_at_end) X(stick_marginal) X(turn) X(turn_exact) \
  X(turn_stick) X(near_rest) X(friction_corners) X(friction_any) X(restitution_corners) \
  X(u_z_zero) X(u_x_zero) X(u_zero) X(u_z_tiny) X(tiny_approach) X(unequal) X(very_unequal) \
  X(wild)
/* clang-format on */

typedef enum {
#define X(name) R_##name,
  REGIMES(X)
#undef X
      R_COUNT
} regime_id;

static const char *const names[] = {
#define X(name) #name,
    REGIMES(X)
#undef X
};

int regimes_count(void) {
  return R_COUNT;
}
const char *regimes_name(int regime) {
  return names[regime];
}

#define U(low, high) lab_uniform(r, low, high)
static int one_in(lab_random *r, unsigned n) {
  return lab_bits(r) % n == 0;
}
static double sign(lab_random *r) {
  return one_in(r, 2) ? 1 : -1;
}

carom_impact draw_turned(const carom_local *c, double angle) {
  const double y[2] = {sin(angle), cos(angle)}, x[2] = {y[1], -y[0]};
  carom_impact in = {
      .a = {.w = {0, 0, c->w_iz}, .radius = c->R, .mass = c->M_i, .mu_cloth = c->mu_i},
      .b = {.w = {0, 0, c->w_jz}, .radius = c->R, .mass = c->M_j, .mu_cloth = c->mu_j},
      .mu_ball = c->mu_b,
      .restitution = c->e};
  for (int k = 0; k < 2; k++) {
    in.b.r[k] = 2 * c->R * y[k];
    in.a.v[k] = x[k] * c->v_ix + y[k] * c->v_iy;
    in.b.v[k] = x[k] * c->v_jx + y[k] * c->v_jy;
    in.a.w[k] = x[k] * c->w_ix + y[k] * c->w_iy;
    in.b.w[k] = x[k] * c->w_jx + y[k] * c->w_jy;
  }
  return in;
}

carom_local draw_exchanged(const carom_local *c) {
  carom_local o = *c;
  o.v_ix = -c->v_jx, o.v_iy = -c->v_jy, o.w_ix = -c->w_jx, o.w_iy = -c->w_jy, o.w_iz = c->w_jz;
  o.v_jx = -c->v_ix, o.v_jy = -c->v_iy, o.w_jx = -c->w_ix, o.w_jy = -c->w_iy, o.w_jz = c->w_iz;
  o.M_i = c->M_j, o.M_j = c->M_i, o.mu_i = c->mu_j, o.mu_j = c->mu_i;
  return o;
}

void draw_ball(carom_local *c, bool second, double v_x, double v_y, double roll, double side) {
  *(second ? &c->v_jx : &c->v_ix) = v_x;
  *(second ? &c->v_jy : &c->v_iy) = v_y;
  *(second ? &c->w_jx : &c->w_ix) = -v_y * roll / c->R;
  *(second ? &c->w_jy : &c->w_iy) = v_x * roll / c->R;
  *(second ? &c->w_jz : &c->w_iz) = side / c->R;
}

/* A ball of speed v at angle phi to y. */
static void move(carom_local *c, int j, double v, double phi, double roll, double side) {
  draw_ball(c, j != 0, v * sin(phi), v * cos(phi), roll, side);
}

/* Sets u_x and u_z exactly as far as rounding lets, by the side spin of i and the spin of j
 * (keeping its cloth slip free). */
static void set_slip(carom_local *c, double u_x, double u_z) {
  c->w_jz = 0;
  c->w_iz = (c->v_ix - c->v_jx - u_x) / c->R;
  c->w_jx = u_z / c->R - c->w_ix;
}
/* Gives the ball that is pressed the cloth slip (d_x, d_y) through its velocity along x and
 * spin; keeps u_z, u_x and v_n. */
static void set_cloth_slip(carom_local *c, double d_x, double d_y) {
  const double u_z = c->R * (c->w_ix + c->w_jx);
  if (u_z >= 0) {
    c->w_iy = (d_x - c->v_ix) / (c->s * c->R);
    c->w_ix = (c->v_iy - d_y) / (c->s * c->R);
    c->w_jx = u_z / c->R - c->w_ix;
  } else {
    c->w_jy = (d_x - c->v_jx) / (c->s * c->R);
    c->w_jx = (c->v_jy - d_y) / (c->s * c->R);
    c->w_ix = u_z / c->R - c->w_jx;
  }
}

carom_impact regimes_draw(int regime, double s, lab_random *r) {
  carom_local c = {0};
  c.R = one_in(r, 2) ? 0.028575 : 0.02619375;
  c.M_i = c.M_j = U(0.1, 0.25);
  c.mu_b = U(0.01, 0.12);
  c.mu_i = U(0.1, 0.5);
  c.mu_j = one_in(r, 2) ? c.mu_i : U(0.1, 0.5);
  c.e = U(0.85, 0.98);
  c.s = s;
  const double v = lab_log_uniform(r, 0.05, 8);
  const double cut = U(-1.4, 1.4), roll = U(-1.5, 1.2), side = U(-1.2, 1.2) * v;
  move(&c, 0, v, cut, roll, side);
  const double v_y = c.v_iy; /* approach speed so far */
  const double p_c = 0.5 * v_y, p_f = p_c * (1 + c.e);
  switch ((regime_id)regime) {
  case R_real_shot:
    break;
  case R_slow:
    move(&c, 0, lab_log_uniform(r, 1e-4, 0.05), cut, roll, 0.01 * side);
    break;
  case R_fast:
    move(&c, 0, U(8, 30), cut, roll, U(-40, 40));
    break;
  case R_grazing:
    move(&c, 0, v, sign(r) * (1.5707963267948966 - lab_log_uniform(r, 1e-6, 0.15)), roll, side);
    break;
  case R_head_on:
    move(&c, 0, v, one_in(r, 2) ? 0 : U(-0.02, 0.02), roll, one_in(r, 2) ? 0 : U(-0.1, 0.1) * v);
    break;
  case R_draw:
    move(&c, 0, v, cut, U(-3, -0.2), side);
    break;
  case R_follow:
    move(&c, 0, v, cut, U(0.2, 1.5), side);
    break;
  case R_stun:
    move(&c, 0, v, cut, one_in(r, 2) ? 0 : U(-0.1, 0.1), side * U(0, 1));
    break;
  case R_sidespin:
    move(&c, 0, v, cut, roll, sign(r) * U(3, 60) * v);
    break;
  case R_both_moving:
    move(&c, 1, U(0, 1) * v, U(1.6, 4.6), U(-1.5, 1.2), U(-1, 1) * v);
    break;
  case R_both_rolling:
    move(&c, 0, v, cut, 1, side);
    move(&c, 1, U(0, 1) * v, U(1.6, 4.6), 1, U(-1, 1) * v);
    break;
  case R_pressed_rolling:
    move(&c, 0, v, cut, 1, side);
    move(&c, 1, U(0.05, 0.5) * v_y, U(-3, 3), -s, 0.3 * side);
    break;
  case R_stick_early:
    set_slip(&c, U(-1, 1) * c.mu_b * p_f * 0.5, U(-1, 1) * c.mu_b * p_f * 0.5);
    break;
  case R_stick_compression: {
    const double a = U(0, 6.3), u = U(4, 7) * c.mu_b * p_c * U(0.3, 1);
    set_slip(&c, u * cos(a), u * sin(a));
    break;
  }
  case R_stick_restitution: {
    const double a = U(0, 6.3), u = U(5, 7) * c.mu_b * U(p_c, p_f);
    set_slip(&c, u * cos(a), u * sin(a));
    break;
  }
  case R_stick_at_v0:
  case R_stick_at_end: { /* exact without cloth friction for pure x or z */
    const double p = (regime == R_stick_at_v0 ? p_c : p_f) *
                     (one_in(r, 3) ? 1 : 1 + sign(r) * lab_log_uniform(r, 1e-15, 1e-3));
    const int z = one_in(r, 2);
    if (z && one_in(r, 2))
      c.mu_i = c.mu_j = 0;
    set_slip(&c, z ? 0 : sign(r) * 7 * c.mu_b * p, z ? sign(r) * 5 * c.mu_b * p : 0);
    if (!one_in(r, 3))
      set_slip(&c, z ? 1e-3 * v * U(-1, 1) * c.mu_b : sign(r) * 7 * c.mu_b * p,
               z ? sign(r) * 5 * c.mu_b * p : 1e-3 * c.mu_b * v * U(-1, 1));
    break;
  }
  case R_stick_marginal: {
    const double a = U(0, 6.3), u = U(5, 7) * c.mu_b * p_f * U(0.95, 1.05);
    set_slip(&c, u * cos(a), u * sin(a));
    break;
  }
  case R_turn:
  case R_turn_exact:
  case R_turn_stick: {
    const double along = U(0.02, 1) * p_f,
                 aside =
                     regime == R_turn_exact ? 0 : sign(r) * p_f * lab_log_uniform(r, 1e-12, 1e-1),
                 on_i = sign(r);
    if (regime == R_turn_stick) {
      const double a = U(0, 6.3), u = U(4, 8) * c.mu_b * p_f * U(0.3, 1);
      set_slip(&c, u * cos(a), u * sin(a));
    } else {
      if (one_in(r, 3))
        c.mu_b = U(0.05, 0.3);
      set_slip(&c, one_in(r, 2) ? 0 : U(-1, 1) * v, on_i * U(0.05, 1.5) * v);
    }
    const double u_x = c.v_ix - c.v_jx - c.R * (c.w_iz + c.w_jz), u_z = c.R * (c.w_ix + c.w_jx),
                 u = hypot(u_x, u_z);
    /* the slip runs along (-mu_b c, -1): start so as to pass by */
    const double side_drift = u > 0 ? c.mu_b * u_x / u : 0;
    if (u_z >= 0)
      set_cloth_slip(&c, aside + side_drift * along, along);
    else
      set_cloth_slip(&c, -aside - side_drift * along, -along);
    break;
  }
  case R_near_rest: {
    const double a = U(0, 6.3), d = p_f * lab_log_uniform(r, 1e-12, 0.3);
    set_cloth_slip(&c, d * cos(a), d * sin(a));
    break;
  }
  case R_friction_corners:
    c.mu_b = one_in(r, 2) ? 1 : one_in(r, 2) ? 0 : U(0, 1);
    c.mu_i = one_in(r, 2) ? 1 : one_in(r, 2) ? 0 : U(0, 1);
    c.mu_j = one_in(r, 2) ? 1 : one_in(r, 2) ? 0 : U(0, 1);
    if (one_in(r, 2))
      move(&c, 1, U(0, 1) * v, U(1.6, 4.6), U(-1.5, 1.2), U(-1, 1) * v);
    break;
  case R_friction_any:
    c.mu_b = U(0, 1);
    c.mu_i = U(0, 1);
    c.mu_j = U(0, 1);
    if (one_in(r, 2))
      move(&c, 1, U(0, 1) * v, U(1.6, 4.6), U(-1.5, 1.2), U(-1, 1) * v);
    break;
  case R_restitution_corners:
    c.e = one_in(r, 3)   ? 0
          : one_in(r, 2) ? 1
          : one_in(r, 2) ? lab_log_uniform(r, 1e-9, 0.1)
                         : U(0, 1);
    break;
  case R_u_z_zero:
    set_slip(&c, one_in(r, 2) ? U(-1, 1) * v : U(-1, 1) * 14 * c.mu_b * p_f, 0);
    if (one_in(r, 2))
      c.w_ix = c.w_jx = 0;
    break;
  case R_u_x_zero:
    c.v_ix = c.w_iz = c.w_iy = 0;
    if (one_in(r, 2))
      c.w_jx = -c.w_ix + U(-1, 1) * 10 * c.mu_b * p_f / c.R;
    break;
  case R_u_zero:
    c.v_ix = c.w_iz = 0;
    c.w_jx = -c.w_ix;
    break;
  case R_u_z_tiny:
    set_slip(&c, U(-1, 1) * v, sign(r) * v * lab_log_uniform(r, 1e-16, 1e-2));
    break;
  case R_tiny_approach: {
    c.v_jx = c.v_ix * U(0.9, 1.1);
    c.v_jy = c.v_iy * (1 - lab_log_uniform(r, 1e-12, 1e-2));
    if (one_in(r, 2))
      c.w_jx = -c.v_jy / c.R;
    break;
  }
  case R_unequal:
    c.M_j = c.M_i * lab_log_uniform(r, 0.1, 10);
    if (one_in(r, 2))
      move(&c, 1, U(0, 1) * v, U(1.6, 4.6), U(-1.5, 1.2), U(-1, 1) * v);
    break;
  case R_very_unequal:
    c.M_j = c.M_i * lab_log_uniform(r, 1e-3, 1e3);
    if (one_in(r, 2)) {
      c.mu_b = U(0, 1);
      c.mu_i = U(0, 1);
      c.mu_j = U(0, 1);
    }
    break;
  case R_wild:
  default:
    c.mu_b = U(0, 1) * U(0, 1);
    c.mu_i = U(0, 1);
    c.mu_j = U(0, 1);
    c.e = U(0, 1);
    c.M_j = c.M_i * lab_log_uniform(r, 0.3, 3);
    move(&c, 0, v, U(-1.5, 1.5), U(-3, 3), U(-3, 3) * v);
    move(&c, 1, U(0, 1) * v, U(1.6, 4.6), U(-3, 3), U(-3, 3) * v);
    break;
  }
  if (!(c.v_jy < c.v_iy)) {
    c.v_jy = c.v_iy - U(0.01, 1) * (fabs(c.v_iy) + 0.01);
  }
  if (one_in(r, 2)) /* let the first ball be the one that is struck */
    c = draw_exchanged(&c);
  return draw_turned(&c, one_in(r, 2) ? 0 : U(-3.2, 3.2));
}
