/* regimes.c - every regime is a choice made in the collision frame (slips, spins, frictions),
 * then turned by a random angle (in half of the draws by none, so that zeros stay exactly zero). */
#include "random_impacts.h"

#include <string.h>

/* clang-format off */
static const char *const names[] = {
    "real_shot", "slow", "fast", "grazing", "head_on", "draw", "follow", "stun", "sidespin",
    "both_moving", "both_rolling", "pressed_rolling", "stick_early", "stick_compression",
    "stick_restitution", "stick_at_v0", "stick_at_end", "stick_marginal", "turn", "turn_exact",
    "turn_stick", "near_rest", "friction_corners", "friction_any", "restitution_corners",
    "u_z_zero", "u_x_zero", "u_zero", "u_z_tiny", "tiny_approach", "unequal", "very_unequal",
    "wild",
};
/* clang-format on */

int regimes_count(void) {
  return (int)(sizeof names / sizeof names[0]);
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
      .a = {.w = {0, 0, c->w_iz}, .radius = c->R, .mass = c->M_i, .mu_slide = c->mu_i},
      .b = {.w = {0, 0, c->w_jz}, .radius = c->R, .mass = c->M_j, .mu_slide = c->mu_j},
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
  double *const targets[2][5] = {{&c->v_ix, &c->v_iy, &c->w_ix, &c->w_iy, &c->w_iz},
                                 {&c->v_jx, &c->v_jy, &c->w_jx, &c->w_jy, &c->w_jz}};
  const double numbers[5] = {v_x, v_y, -v_y * roll / c->R, v_x * roll / c->R, side / c->R};
  for (int k = 0; k < 5; k++)
    *targets[second][k] = numbers[k];
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

static void set_slip_at(carom_local *c, double angle, double u) {
  set_slip(c, u * cos(angle), u * sin(angle));
}

/* The second ball moves any way but with the first. */
static void move_other(carom_local *c, lab_random *r, double v) {
  move(c, 1, U(0, 1) * v, U(1.6, 4.6), U(-1.5, 1.2), U(-1, 1) * v);
}

static void any_friction(carom_local *c, lab_random *r) {
  c->mu_b = U(0, 1);
  c->mu_i = U(0, 1);
  c->mu_j = U(0, 1);
}

static double end_or_any(lab_random *r) {
  if (one_in(r, 2))
    return 1;
  return one_in(r, 2) ? 0 : U(0, 1);
}

/* A restitution that is often 0 or 1, or near to 0. */
static double restitution_at_corner(lab_random *r) {
  if (one_in(r, 3))
    return 0;
  if (one_in(r, 2))
    return 1;
  return one_in(r, 2) ? lab_log_uniform(r, 1e-9, 0.1) : U(0, 1);
}

/* What a draw begins with: the regime, the first ball's speed, direction, fraction of rolling and
 * surface speed of side spin; impulses about at the end of compression and of the impact. */
typedef struct first_shot {
  const char *regime;
  double v, cut, roll, side, p_c, p_f;
} first_shot;

#define IS(name) (strcmp(first->regime, #name) == 0)

/* Regimes of how balls move, and of masses, friction and restitution. */
static void draw_motion(carom_local *c, lab_random *r, const first_shot *first) {
  const double v = first->v, cut = first->cut, roll = first->roll, side = first->side,
               v_y = c->v_iy;
  if (IS(slow))
    move(c, 0, lab_log_uniform(r, 1e-4, 0.05), cut, roll, 0.01 * side);
  else if (IS(fast))
    move(c, 0, U(8, 30), cut, roll, U(-40, 40));
  else if (IS(grazing))
    move(c, 0, v, sign(r) * (1.5707963267948966 - lab_log_uniform(r, 1e-6, 0.15)), roll, side);
  else if (IS(head_on))
    move(c, 0, v, one_in(r, 2) ? 0 : U(-0.02, 0.02), roll, one_in(r, 2) ? 0 : U(-0.1, 0.1) * v);
  else if (IS(draw))
    move(c, 0, v, cut, U(-3, -0.2), side);
  else if (IS(follow))
    move(c, 0, v, cut, U(0.2, 1.5), side);
  else if (IS(stun))
    move(c, 0, v, cut, one_in(r, 2) ? 0 : U(-0.1, 0.1), side * U(0, 1));
  else if (IS(sidespin))
    move(c, 0, v, cut, roll, sign(r) * U(3, 60) * v);
  else if (IS(both_moving))
    move_other(c, r, v);
  else if (IS(both_rolling)) {
    move(c, 0, v, cut, 1, side);
    move(c, 1, U(0, 1) * v, U(1.6, 4.6), 1, U(-1, 1) * v);
  } else if (IS(pressed_rolling)) {
    move(c, 0, v, cut, 1, side);
    move(c, 1, U(0.05, 0.5) * v_y, U(-3, 3), -c->s, 0.3 * side);
  } else if (IS(friction_corners)) {
    c->mu_b = end_or_any(r), c->mu_i = end_or_any(r), c->mu_j = end_or_any(r);
    if (one_in(r, 2))
      move_other(c, r, v);
  } else if (IS(friction_any)) {
    any_friction(c, r);
    if (one_in(r, 2))
      move_other(c, r, v);
  } else if (IS(restitution_corners))
    c->e = restitution_at_corner(r);
  else if (IS(tiny_approach)) {
    c->v_jx = c->v_ix * U(0.9, 1.1);
    c->v_jy = c->v_iy * (1 - lab_log_uniform(r, 1e-12, 1e-2));
    if (one_in(r, 2))
      c->w_jx = -c->v_jy / c->R;
  } else if (IS(unequal)) {
    c->M_j = c->M_i * lab_log_uniform(r, 0.1, 10);
    if (one_in(r, 2))
      move_other(c, r, v);
  } else if (IS(very_unequal)) {
    c->M_j = c->M_i * lab_log_uniform(r, 1e-3, 1e3);
    if (one_in(r, 2))
      any_friction(c, r);
  } else if (IS(wild)) {
    any_friction(c, r);
    c->mu_b *= U(0, 1);
    c->e = U(0, 1);
    c->M_j = c->M_i * lab_log_uniform(r, 0.3, 3);
    move(c, 0, v, U(-1.5, 1.5), U(-3, 3), U(-3, 3) * v);
    move(c, 1, U(0, 1) * v, U(1.6, 4.6), U(-3, 3), U(-3, 3) * v);
  }
}

/* Regimes of slips: of the balls, which vanish at a moment of the impact or are zero, */
static void draw_slip(carom_local *c, lab_random *r, const first_shot *first) {
  const double v = first->v, p_c = first->p_c, p_f = first->p_f, angle = U(0, 6.3);
  if (IS(stick_early))
    set_slip(c, U(-1, 1) * c->mu_b * p_f * 0.5, U(-1, 1) * c->mu_b * p_f * 0.5);
  else if (IS(stick_compression))
    set_slip_at(c, angle, U(4, 7) * c->mu_b * p_c * U(0.3, 1));
  else if (IS(stick_restitution))
    set_slip_at(c, angle, U(5, 7) * c->mu_b * U(p_c, p_f));
  else if (IS(stick_marginal))
    set_slip_at(c, angle, U(5, 7) * c->mu_b * p_f * U(0.95, 1.05));
  else if (IS(stick_at_v0) || IS(stick_at_end)) {
    /* exact without cloth friction for pure x or z */
    const double p = (IS(stick_at_v0) ? p_c : p_f) *
                     (one_in(r, 3) ? 1 : 1 + sign(r) * lab_log_uniform(r, 1e-15, 1e-3));
    const int z = one_in(r, 2);
    if (z && one_in(r, 2))
      c->mu_i = c->mu_j = 0;
    const double aside = one_in(r, 3) ? 0 : 1e-3 * v * U(-1, 1) * c->mu_b,
                 along = sign(r) * (z ? 5 : 7) * c->mu_b * p;
    set_slip(c, z ? aside : along, z ? along : aside);
  } else if (IS(u_z_zero)) {
    set_slip(c, one_in(r, 2) ? U(-1, 1) * v : U(-1, 1) * 14 * c->mu_b * p_f, 0);
    if (one_in(r, 2))
      c->w_ix = c->w_jx = 0;
  } else if (IS(u_x_zero)) {
    c->v_ix = c->w_iz = c->w_iy = 0;
    if (one_in(r, 2))
      c->w_jx = -c->w_ix + U(-1, 1) * 10 * c->mu_b * p_f / c->R;
  } else if (IS(u_zero)) {
    c->v_ix = c->w_iz = 0;
    c->w_jx = -c->w_ix;
  } else if (IS(u_z_tiny))
    set_slip(c, U(-1, 1) * v, sign(r) * v * lab_log_uniform(r, 1e-16, 1e-2));
}

/* and on the cloth, which passes zero or begins near it. */
static void draw_turn(carom_local *c, lab_random *r, const first_shot *first) {
  const double v = first->v, p_f = first->p_f, angle = U(0, 6.3);
  if (IS(near_rest)) {
    const double d = p_f * lab_log_uniform(r, 1e-12, 0.3);
    set_cloth_slip(c, d * cos(angle), d * sin(angle));
  }
  if (!IS(turn) && !IS(turn_exact) && !IS(turn_stick))
    return;
  const double along = U(0.02, 1) * p_f,
               aside = IS(turn_exact) ? 0 : sign(r) * p_f * lab_log_uniform(r, 1e-12, 1e-1);
  if (IS(turn_stick))
    set_slip_at(c, angle, U(4, 8) * c->mu_b * p_f * U(0.3, 1));
  else {
    if (one_in(r, 3))
      c->mu_b = U(0.05, 0.3);
    set_slip(c, one_in(r, 2) ? 0 : U(-1, 1) * v, sign(r) * U(0.05, 1.5) * v);
  }
  /* the slip runs along (-mu_b c, -1): start so as to pass by */
  const double u_x = c->v_ix - c->v_jx - c->R * (c->w_iz + c->w_jz),
               u_z = c->R * (c->w_ix + c->w_jx), u = hypot(u_x, u_z), t = u_z >= 0 ? 1 : -1;
  const double side_drift = u > 0 ? c->mu_b * u_x / u : 0;
  set_cloth_slip(c, t * (aside + side_drift * along), t * along);
}

carom_impact regimes_draw(int regime, double s, lab_random *r) {
  carom_local c = {.R = one_in(r, 2) ? 0.028575 : 0.02619375, .s = s};
  c.M_i = c.M_j = U(0.1, 0.25);
  c.mu_b = U(0.01, 0.12);
  c.mu_i = U(0.1, 0.5);
  c.mu_j = one_in(r, 2) ? c.mu_i : U(0.1, 0.5);
  c.e = U(0.85, 0.98);
  first_shot begun = {.regime = names[regime], .v = lab_log_uniform(r, 0.05, 8)};
  begun.cut = U(-1.4, 1.4), begun.roll = U(-1.5, 1.2), begun.side = U(-1.2, 1.2) * begun.v;
  move(&c, 0, begun.v, begun.cut, begun.roll, begun.side);
  begun.p_c = 0.5 * c.v_iy, begun.p_f = begun.p_c * (1 + c.e);
  draw_motion(&c, r, &begun);
  draw_slip(&c, r, &begun);
  draw_turn(&c, r, &begun);
  if (!(c.v_jy < c.v_iy))
    c.v_jy = c.v_iy - U(0.01, 1) * (fabs(c.v_iy) + 0.01);
  if (one_in(r, 2)) /* let the first ball be the one that is struck */
    c = draw_exchanged(&c);
  return draw_turned(&c, one_in(r, 2) ? 0 : U(-3.2, 3.2));
}
