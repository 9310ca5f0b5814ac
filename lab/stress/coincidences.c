/* Numbers are taken from a short list, so that they are exactly equal in every combination; or
 * they are put exactly where something begins or ends, and then moved by a relative amount from
 * 0 over rounding errors to 1e-3. Half of all impacts of two balls lie along the y axis, where
 * zeros stay zero; so do all impacts on cushions but one in four. */
#include "draws.h"

#include <string.h>

#define U(low, high) lab_uniform(r, low, high)
#define COUNT(list) (sizeof(list) / sizeof(list)[0])

static int below(lab_random *r, int n) {
  return (int)U(0, n);
}

static double sign(lab_random *r) {
  return below(r, 2) == 0 ? 1 : -1;
}

/* 0, or an amount from far below rounding to 1e-3. */
static double tiny(lab_random *r) {
  return below(r, 3) == 0 ? 0 : sign(r) * lab_log_uniform(r, 1e-18, 1e-3);
}

static double share(lab_random *r) {
  static const double list[] = {0, 0.05, 0.1, 0.2, 0.25, 2 / 7.0, 0.4, 0.5, 1};
  return list[below(r, COUNT(list))];
}

static double friction(lab_random *r) {
  return below(r, 2) == 0 ? share(r) : U(0, 0.5);
}

static double restitution(lab_random *r) {
  return below(r, 3) == 0 ? share(r) : U(0.5, 1);
}

static double few(lab_random *r) {
  static const double list[] = {-2, -1, -0.5, 0, 0, 0.5, 1, 2};
  return list[below(r, COUNT(list))];
}

/* ---- Two balls: in the frame of ball_ball/frame.h ---- */

static carom_local two_balls(lab_random *r, carom_slip slip) {
  carom_local c = {.R = 0.028575,
                   .M_i = 0.17,
                   .v_iy = below(r, 2) == 0 ? 1 : lab_log_uniform(r, 0.05, 8),
                   .s = carom_spin_sign(slip)};
  c.M_j = c.M_i * (below(r, 2) == 0 ? 1 : lab_log_uniform(r, 0.5, 2));
  c.mu_b = below(r, 2) == 0 ? share(r) : U(0, 0.2);
  c.mu_i = friction(r);
  c.mu_j = below(r, 2) == 0 ? c.mu_i : friction(r);
  c.e = restitution(r);
  return c;
}

static void planar(carom_local *c, lab_random *r) {
  static const double others[] = {0, 0, -1, 0.5};
  c->v_jy = c->v_iy * others[below(r, COUNT(others))];
  const double rolling = -c->v_iy / c->R, spins[] = {0, rolling, -rolling, rolling * U(-3, 3)};
  c->w_ix = spins[below(r, 4)];
  c->w_jx = below(r, 2) == 0 ? spins[below(r, 4)] : below(r, 2) == 0 ? -c->w_ix : 0;
}

/* The slip on the cloth passes zero, or nearly. */
static void planar_turn(carom_local *c, lab_random *r) {
  c->w_ix = -U(0.3, 2) * c->v_iy / c->R;
  c->v_ix = tiny(r) * c->v_iy;
  if (below(r, 2) == 0)
    c->w_ix = -c->w_ix;
}

/* The slip of the balls vanishes at the end of a phase, or nearly: all rates are constant. The
 * pressed ball is the second, which rests, or the first, whose slip on the cloth is large. */
static void planar_stick(carom_local *c, lab_random *r) {
  const bool second = below(r, 2) == 0;
  const double kappa = 1 + (second ? c->M_j / c->M_i : c->M_i / c->M_j), t = second ? -1 : 1;
  const double F = -t * (second ? c->mu_j : c->mu_i) * c->mu_b;
  const double p = (1 + (below(r, 2) == 0 ? c->e : 0)) / (kappa - F),
               u = (2.5 * kappa * c->mu_b - 2.5 * F) * p * (1 + tiny(r));
  c->w_ix = t * c->v_iy * u / c->R;
  if (below(r, 4) == 0)
    c->v_ix = tiny(r) * c->v_iy;
}

static void roll(carom_local *c, lab_random *r) {
  c->v_ix = few(r) * c->v_iy;
  c->v_jx = few(r) * c->v_iy;
  c->v_jy = below(r, 2) == 0 ? 0 : -fabs(few(r)) * c->v_iy;
  c->w_ix = c->s * c->v_iy / c->R, c->w_iy = -c->s * c->v_ix / c->R;
  c->w_jx = c->s * c->v_jy / c->R, c->w_jy = -c->s * c->v_jx / c->R;
  c->w_iz = few(r) * c->v_iy / c->R;
}

static void rounding(carom_local *c, lab_random *r) {
  const double v = c->v_iy;
  c->v_ix = few(r) * v;
  c->w_jz = below(r, 2) == 0 ? 0 : few(r) * v / c->R;
  c->w_iz = (c->v_ix - tiny(r) * v) / c->R - c->w_jz;
  c->w_ix = below(r, 2) == 0 ? few(r) * v / c->R : (c->s * v + tiny(r) * v) / c->R;
  c->w_iy = (-c->s * c->v_ix + tiny(r) * v) / c->R;
  c->w_jx = tiny(r) * v / c->R - (below(r, 2) == 0 ? c->w_ix : 0);
}

static void equal(carom_local *c, lab_random *r) {
  const double mu = share(r), w = c->v_iy / c->R;
  c->mu_b = c->mu_i = c->mu_j = mu;
  if (below(r, 2) == 0)
    c->e = mu;
  c->v_ix = few(r) * c->v_iy, c->v_jx = few(r) * c->v_iy, c->v_jy = -fabs(few(r)) * c->v_iy;
  c->w_ix = few(r) * w, c->w_iy = few(r) * w, c->w_iz = few(r) * w;
  c->w_jx = few(r) * w, c->w_jy = few(r) * w, c->w_jz = few(r) * w;
}

/* Without slip along x and with the slip of pooltool nothing drives the slip on the cloth at
 * mu_b = 2/5. */
static void no_drive(carom_local *c, lab_random *r) {
  const double v = c->v_iy;
  c->mu_b = 0.4 * (1 + tiny(r));
  c->v_ix = c->v_jx = (below(r, 2) == 0 ? 0 : tiny(r)) * v;
  c->v_jy = below(r, 2) == 0 ? 0 : -U(0, 1) * v;
  c->w_iy = tiny(r) * v / c->R;
  c->w_ix = (c->s * v + (below(r, 2) == 0 ? tiny(r) : U(-1, 1)) * v) / c->R;
  c->w_jx = below(r, 2) == 0 ? 0 : U(-2, 2) * v / c->R;
}

static void grazing(carom_local *c, lab_random *r) {
  const double v = lab_log_uniform(r, 0.05, 8);
  c->v_ix = sign(r) * v;
  c->v_iy = v * lab_log_uniform(r, 1e-9, 1e-3);
  if (below(r, 3) == 0)
    c->w_ix = c->s * c->v_iy / c->R, c->w_iy = -c->s * c->v_ix / c->R;
  else if (below(r, 2) == 0)
    c->w_ix = U(-1, 1) * v / c->R, c->w_iy = U(-1, 1) * v / c->R, c->w_iz = U(-1, 1) * v / c->R;
  if (below(r, 3) == 0)
    c->w_iz = c->v_ix / c->R + tiny(r) * v / c->R;
}

/* Stick exactly at the end of a phase, or exact zeros: those regimes of regimes.c. */
static carom_impact corner(lab_random *r, carom_slip slip) {
  static const char *const exact[] = {"stick_at_v0", "stick_at_end", "turn_exact", "u_z_zero",
                                      "u_x_zero",    "u_zero",       "u_z_tiny"};
  const char *const name = exact[below(r, COUNT(exact))];
  int regime = 0;
  while (strcmp(regimes_name(regime), name) != 0)
    regime++;
  return regimes_draw(regime, carom_spin_sign(slip), r);
}

/* ---- A ball and a cushion: x along it, y into it ---- */

typedef struct local {
  double v_x, v_y, w_x, w_y, w_z, R, sine, mu_c, mu_w, e;
} local;

static local at_rail(lab_random *r) {
  static const double noses[] = {0.2, 0.25, 0.27, 0.4, 0.5, 0, -0.1};
  return (local){.v_y = below(r, 2) == 0 ? 1 : lab_log_uniform(r, 0.05, 8),
                 .R = 0.028575,
                 .sine = below(r, 2) == 0 ? noses[below(r, COUNT(noses))] : U(0.2, 0.45),
                 .mu_c = friction(r),
                 .mu_w = friction(r),
                 .e = restitution(r)};
}

static void planar_rail(local *c, lab_random *r) {
  const double rolling = -c->v_y / c->R,
               spins[] = {0, rolling, -rolling, c->sine * c->v_y / c->R, rolling * U(-3, 3)};
  c->w_x = spins[below(r, COUNT(spins))];
}

/* The slip at the nose or on the cloth passes zero, or nearly. */
static void planar_turn_rail(local *c, lab_random *r) {
  c->w_x = U(-2, 2) * c->v_y / c->R;
  c->v_x = tiny(r) * c->v_y;
  c->w_y = below(r, 2) == 0 ? 0 : tiny(r) * c->v_y / c->R;
}

static void roll_rail(local *c, lab_random *r) {
  c->v_x = few(r) * c->v_y;
  c->w_x = -c->v_y / c->R, c->w_y = c->v_x / c->R;
  c->w_z = few(r) * c->v_y / c->R;
}

static void rounding_rail(local *c, lab_random *r) {
  const double v = c->v_y, cosine = sqrt(1 - c->sine * c->sine);
  c->v_x = few(r) * v;
  c->w_y = (c->v_x - tiny(r) * v) / c->R;
  c->w_x = ((below(r, 2) == 0 ? -1 : c->sine) * v + tiny(r) * v) / c->R;
  c->w_z = below(r, 2) == 0 ? few(r) * v / c->R
                            : (c->v_x / c->R + c->w_y * c->sine + tiny(r) * v / c->R) / cosine;
}

static void equal_rail(local *c, lab_random *r) {
  const double w = c->v_y / c->R;
  c->mu_c = c->mu_w = share(r);
  if (below(r, 2) == 0)
    c->e = c->mu_c;
  if (below(r, 3) == 0)
    c->sine = c->mu_w < 1 ? c->mu_w : 0;
  c->v_x = few(r) * c->v_y;
  c->w_x = few(r) * w, c->w_y = few(r) * w, c->w_z = few(r) * w;
}

/* The nose at the height of the centre, or nearly. */
static void centre_rail(local *c, lab_random *r) {
  equal_rail(c, r);
  c->mu_c = friction(r), c->mu_w = friction(r);
  c->sine = below(r, 2) == 0 ? 0 : tiny(r);
  if (below(r, 2) == 0)
    c->w_x = tiny(r) * c->v_y / c->R;
}

/* The friction of the nose is exactly what unloads the cloth, or holds the nose while the cloth
 * slips to either side or bears nothing, or what holds both; or that of the cloth is what holds
 * both. The formulas: impact/law.h and contact.c. */
static void cone_rail(local *c, lab_random *r) {
  if (below(r, 2) == 0)
    planar_turn_rail(c, r);
  else
    equal_rail(c, r);
  const double sine = c->sine, cosine = sqrt(1 - sine * sine), A = sine * cosine,
               K = 2.5 + sine * sine, C = 2.5 - sine;
  const double det = 3.5 * K - C * C, f = (-C * cosine - 3.5 * A) / det,
               F = (C * A + K * cosine) / det, t = sign(r);
  const double w = c->mu_c * (sine + cosine * A / K) / (1 + c->mu_c * cosine * C / K * t);
  const double edges[] = {sine / cosine, A / K, (C * w * t - A) / K, f, f};
  const int edge = below(r, COUNT(edges));
  if (edge == 4) /* the cloth's */
    c->mu_c = fmin(1, fabs(F / (sine - cosine * f)) * (1 + tiny(r)));
  if (edge != 4 || below(r, 2) == 0)
    c->mu_w = fmin(1, fabs(edges[edge]) * (1 + tiny(r)));
}

static void grazing_rail(local *c, lab_random *r) {
  const double v = lab_log_uniform(r, 0.05, 8);
  c->v_x = sign(r) * v;
  c->v_y = v * lab_log_uniform(r, 1e-9, 1e-3);
  if (below(r, 3) == 0)
    c->w_x = -c->v_y / c->R, c->w_y = c->v_x / c->R;
  else if (below(r, 2) == 0)
    c->w_x = U(-1, 1) * v / c->R, c->w_y = U(-1, 1) * v / c->R, c->w_z = U(-1, 1) * v / c->R;
}

/* ---- All kinds ---- */

typedef void change_balls(carom_local *c, lab_random *r);
typedef void change_rail(local *c, lab_random *r);

static const struct {
  const char *name;
  change_balls *balls;
  change_rail *rail;
} kinds[] = {{"planar", planar, NULL},
             {"planar turn", planar_turn, NULL},
             {"planar stick", planar_stick, NULL},
             {"rolling", roll, NULL},
             {"rounding", rounding, NULL},
             {"equal", equal, NULL},
             {"corners", NULL, NULL},
             {"no drive", no_drive, NULL},
             {"grazing", grazing, NULL},
             {"planar, cushion", NULL, planar_rail},
             {"planar turn, cushion", NULL, planar_turn_rail},
             {"rolling, cushion", NULL, roll_rail},
             {"rounding, cushion", NULL, rounding_rail},
             {"equal, cushion", NULL, equal_rail},
             {"centre, cushion", NULL, centre_rail},
             {"cones, cushion", NULL, cone_rail},
             {"grazing, cushion", NULL, grazing_rail}};

int coincidence_kinds(void) {
  return (int)COUNT(kinds);
}

const char *coincidence_name(int kind) {
  return kinds[kind].name;
}

drawn coincidence_draw(int kind, uint64_t seed, uint64_t k) {
  lab_random state = {(seed * 0x9E3779B97F4A7C15u) ^
                      (k * 0xD1B54A32D192ED03u + (uint64_t)kind * 0x2545f4914f6cdd1du)},
             *r = &state;
  drawn d = {.cushion = kinds[kind].rail != NULL,
             .slip = k % 2 == 0 ? CAROM_SLIP_PAPER : CAROM_SLIP_POOLTOOL};
  U(0, 1);
  if (d.cushion) {
    local c = at_rail(r);
    kinds[kind].rail(&c, r);
    const double turn = below(r, 4) == 0 ? U(-3.2, 3.2) : 0, x = cos(turn), y = sin(turn);
    d.rail = (carom_cushion_impact){.v = {c.v_x * x + c.v_y * y, c.v_y * x - c.v_x * y, 0},
                                    .w = {c.w_x * x + c.w_y * y, c.w_y * x - c.w_x * y, c.w_z},
                                    .normal = {y, x},
                                    .height = c.R * (1 + c.sine),
                                    .radius = c.R,
                                    .mass = 0.17,
                                    .mu_cloth = c.mu_c,
                                    .mu_cushion = c.mu_w,
                                    .restitution = c.e};
    /* for cushions nose 1.2 to 1.45 R, mu to 0.4, e from 0.5 */
    d.of_play = c.sine >= 0.2 && c.sine <= 0.45 && c.mu_c <= 0.4 && c.mu_w <= 0.4 && c.e >= 0.5;
    return d;
  }
  if (kinds[kind].balls == no_drive)
    d.slip = CAROM_SLIP_POOLTOOL;
  if (kinds[kind].balls == NULL)
    d.balls = corner(r, d.slip);
  else {
    carom_local c = two_balls(r, d.slip);
    kinds[kind].balls(&c, r);
    d.balls = draw_turned(&c, below(r, 2) == 0 ? 0 : U(-3.2, 3.2));
  }
  d.of_play = is_of_play(&d.balls);
  return d;
}
