/* Numbers are taken from a short list, so that they are exactly equal in every combination; or
 * they are put exactly where something begins or ends, and then moved by a relative amount from
 * 0 over rounding errors to 1e-3. Half of all impacts of two balls lie along the y axis, where
 * zeros stay zero; so do all impacts on cushions but one in four. */
#include "random_impacts.h"

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

/* ---- Of two balls, in the frame of ball_ball/frame.h, or of the first of them and a cushion: x
 * along it, y into it; mu_b is then the friction of the nose, which lies `sine` R above the
 * centre, and s = -1. ---- */

static carom_local at_contact(lab_random *r, bool cushion, carom_slip slip) {
  carom_local c = {.R = 0.028575,
                   .M_i = 0.17,
                   .v_iy = below(r, 2) == 0 ? 1 : lab_log_uniform(r, 0.05, 8),
                   .s = cushion ? -1 : carom_spin_sign(slip)};
  c.M_j = c.M_i * (below(r, 2) == 0 ? 1 : lab_log_uniform(r, 0.5, 2));
  if (cushion)
    c.mu_b = friction(r);
  else
    c.mu_b = below(r, 2) == 0 ? share(r) : U(0, 0.2);
  c.mu_i = friction(r);
  c.mu_j = below(r, 2) == 0 ? c.mu_i : friction(r);
  c.e = restitution(r);
  return c;
}

static void planar(carom_local *c, double *sine, lab_random *r) {
  static const double others[] = {0, 0, -1, 0.5};
  c->v_jy = c->v_iy * others[below(r, COUNT(others))];
  const double v = c->v_iy / c->R, spins[] = {0, -v, v, *sine * v, v * U(-3, 3)};
  c->w_ix = spins[below(r, 5)];
  c->w_jx = 0;
  if (below(r, 2) == 0)
    c->w_jx = spins[below(r, 5)];
  else if (below(r, 2) == 0)
    c->w_jx = -c->w_ix;
}

/* The slip on the cloth or at the nose passes zero, or nearly. */
static void planar_turn(carom_local *c, double *sine, lab_random *r) {
  (void)sine;
  c->w_ix = (below(r, 4) == 0 ? U(-0.3, 0.3) : sign(r) * U(0.3, 2)) * c->v_iy / c->R;
  c->v_ix = tiny(r) * c->v_iy;
  c->w_iy = below(r, 2) == 0 ? 0 : tiny(r) * c->v_iy / c->R;
}

static void roll(carom_local *c, double *sine, lab_random *r) {
  (void)sine;
  c->v_ix = few(r) * c->v_iy;
  c->v_jx = few(r) * c->v_iy;
  c->v_jy = below(r, 2) == 0 ? 0 : -fabs(few(r)) * c->v_iy;
  c->w_ix = c->s * c->v_iy / c->R, c->w_iy = -c->s * c->v_ix / c->R;
  c->w_jx = c->s * c->v_jy / c->R, c->w_jy = -c->s * c->v_jx / c->R;
  c->w_iz = few(r) * c->v_iy / c->R;
}

static void equal(carom_local *c, double *sine, lab_random *r) {
  const double mu = share(r), w = c->v_iy / c->R;
  c->mu_b = c->mu_i = c->mu_j = mu;
  if (below(r, 2) == 0)
    c->e = mu;
  if (below(r, 3) == 0)
    *sine = mu < 1 ? mu : 0;
  c->v_ix = few(r) * c->v_iy, c->v_jx = few(r) * c->v_iy, c->v_jy = -fabs(few(r)) * c->v_iy;
  c->w_ix = few(r) * w, c->w_iy = few(r) * w, c->w_iz = few(r) * w;
  c->w_jx = few(r) * w, c->w_jy = few(r) * w, c->w_jz = few(r) * w;
}

static void grazing(carom_local *c, double *sine, lab_random *r) {
  const double v = lab_log_uniform(r, 0.05, 8);
  (void)sine;
  c->v_ix = sign(r) * v;
  c->v_iy = v * lab_log_uniform(r, 1e-9, 1e-3);
  if (below(r, 3) == 0)
    c->w_ix = c->s * c->v_iy / c->R, c->w_iy = -c->s * c->v_ix / c->R;
  else if (below(r, 2) == 0)
    c->w_ix = U(-1, 1) * v / c->R, c->w_iy = U(-1, 1) * v / c->R, c->w_iz = U(-1, 1) * v / c->R;
  if (below(r, 3) == 0)
    c->w_iz = c->v_ix / c->R + tiny(r) * v / c->R;
}

/* ---- Of two balls alone ---- */

/* The slip of the balls vanishes at the end of a phase, or nearly: all rates are constant. The
 * pressed ball is the second, which rests, or the first, whose slip on the cloth is large. */
static void planar_stick(carom_local *c, double *unused, lab_random *r) {
  (void)unused;
  const bool second = below(r, 2) == 0;
  const double kappa = 1 + (second ? c->M_j / c->M_i : c->M_i / c->M_j), t = second ? -1 : 1;
  const double F = -t * (second ? c->mu_j : c->mu_i) * c->mu_b;
  const double p = (1 + (below(r, 2) == 0 ? c->e : 0)) / (kappa - F),
               u = (2.5 * kappa * c->mu_b - 2.5 * F) * p * (1 + tiny(r));
  c->w_ix = t * c->v_iy * u / c->R;
  if (below(r, 4) == 0)
    c->v_ix = tiny(r) * c->v_iy;
}

static void rounding(carom_local *c, double *unused, lab_random *r) {
  (void)unused;
  const double v = c->v_iy;
  c->v_ix = few(r) * v;
  c->w_jz = below(r, 2) == 0 ? 0 : few(r) * v / c->R;
  c->w_iz = (c->v_ix - tiny(r) * v) / c->R - c->w_jz;
  c->w_ix = below(r, 2) == 0 ? few(r) * v / c->R : (c->s * v + tiny(r) * v) / c->R;
  c->w_iy = (-c->s * c->v_ix + tiny(r) * v) / c->R;
  c->w_jx = tiny(r) * v / c->R - (below(r, 2) == 0 ? c->w_ix : 0);
}

/* Without slip along x and with the slip of pooltool nothing drives the slip on the cloth at
 * mu_b = 2/5. */
static void no_drive(carom_local *c, double *unused, lab_random *r) {
  (void)unused;
  const double v = c->v_iy;
  c->mu_b = 0.4 * (1 + tiny(r));
  c->v_ix = c->v_jx = (below(r, 2) == 0 ? 0 : tiny(r)) * v;
  c->v_jy = below(r, 2) == 0 ? 0 : -U(0, 1) * v;
  c->w_iy = tiny(r) * v / c->R;
  c->w_ix = (c->s * v + (below(r, 2) == 0 ? tiny(r) : U(-1, 1)) * v) / c->R;
  c->w_jx = below(r, 2) == 0 ? 0 : U(-2, 2) * v / c->R;
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

/* ---- Of a ball and a cushion alone ---- */

static void rounding_rail(carom_local *c, double *sine, lab_random *r) {
  const double v = c->v_iy, cosine = sqrt(1 - *sine * *sine);
  c->v_ix = few(r) * v;
  c->w_iy = (c->v_ix - tiny(r) * v) / c->R;
  c->w_ix = ((below(r, 2) == 0 ? -1 : *sine) * v + tiny(r) * v) / c->R;
  c->w_iz = below(r, 2) == 0 ? few(r) * v / c->R
                             : (c->v_ix / c->R + c->w_iy * *sine + tiny(r) * v / c->R) / cosine;
}

/* The nose at the height of the centre, or nearly. */
static void centre(carom_local *c, double *sine, lab_random *r) {
  equal(c, sine, r);
  c->mu_i = friction(r), c->mu_b = friction(r);
  *sine = below(r, 2) == 0 ? 0 : tiny(r);
  if (below(r, 2) == 0)
    c->w_ix = tiny(r) * c->v_iy / c->R;
}

/* The friction of the nose is exactly what unloads the cloth, or holds the nose while the cloth
 * slips to either side or bears nothing, or what holds both; or that of the cloth is what holds
 * both. The formulas: contact_law/law.h and contact.c. */
static void cones(carom_local *c, double *sine, lab_random *r) {
  (below(r, 2) == 0 ? planar_turn : equal)(c, sine, r);
  const double s = *sine, cosine = sqrt(1 - s * s), A = s * cosine, K = 2.5 + s * s, C = 2.5 - s,
               det = 3.5 * K - C * C, f = (-C * cosine - 3.5 * A) / det,
               F = (C * A + K * cosine) / det, t = sign(r);
  const double w = c->mu_i * (s + cosine * A / K) / (1 + c->mu_i * cosine * C / K * t);
  const double edges[] = {s / cosine, A / K, (C * w * t - A) / K, f, f};
  const int edge = below(r, COUNT(edges));
  if (edge == 4) /* the cloth's */
    c->mu_i = fmin(1, fabs(F / (s - cosine * f)) * (1 + tiny(r)));
  if (edge != 4 || below(r, 2) == 0)
    c->mu_b = fmin(1, fabs(edges[edge]) * (1 + tiny(r)));
}

/* ---- All kinds ---- */

static const struct {
  const char *name;
  void (*change)(carom_local *c, double *sine, lab_random *r);
  bool cushion;
} kinds[] = {{"planar", planar, false},
             {"planar turn", planar_turn, false},
             {"planar stick", planar_stick, false},
             {"rolling", roll, false},
             {"rounding", rounding, false},
             {"equal", equal, false},
             {"corners", NULL, false},
             {"no drive", no_drive, false},
             {"grazing", grazing, false},
             {"planar, cushion", planar, true},
             {"planar turn, cushion", planar_turn, true},
             {"rolling, cushion", roll, true},
             {"rounding, cushion", rounding_rail, true},
             {"equal, cushion", equal, true},
             {"centre, cushion", centre, true},
             {"cones, cushion", cones, true},
             {"grazing, cushion", grazing, true}};

int coincidence_kinds(void) {
  return (int)COUNT(kinds);
}

const char *coincidence_name(int kind) {
  return kinds[kind].name;
}

/* Impact `c` at a cushion that runs in any direction, or along x. */
static carom_cushion_impact at_rail(const carom_local *c, double sine, lab_random *r) {
  const double turn = below(r, 4) == 0 ? U(-3.2, 3.2) : 0, x = cos(turn), y = sin(turn);
  return (carom_cushion_impact){
      .v = {c->v_ix * x + c->v_iy * y, c->v_iy * x - c->v_ix * y, 0},
      .w = {c->w_ix * x + c->w_iy * y, c->w_iy * x - c->w_ix * y, c->w_iz},
      .normal = {y, x},
      .height = c->R * (1 + sine),
      .radius = c->R,
      .mass = c->M_i,
      .mu_slide = c->mu_i,
      .mu_cushion = c->mu_b,
      .restitution = c->e};
}

drawn coincidence_draw(int kind, uint64_t seed, uint64_t k) {
  static const double noses[] = {0.2, 0.25, 0.27, 0.4, 0.5, 0, -0.1};
  lab_random state = {(seed * 0x9E3779B97F4A7C15u) ^
                      (k * 0xD1B54A32D192ED03u + (uint64_t)kind * 0x2545f4914f6cdd1du)},
             *r = &state;
  drawn d = {.cushion = kinds[kind].cushion,
             .slip = k % 2 == 0 && kinds[kind].change != no_drive ? CAROM_SLIP_PAPER
                                                                  : CAROM_SLIP_POOLTOOL};
  U(0, 1);
  if (kinds[kind].change == NULL) {
    d.balls = corner(r, d.slip);
    d.of_play = is_of_play(&d.balls);
    return d;
  }
  carom_local c = at_contact(r, d.cushion, d.slip);
  double sine = 0;
  if (d.cushion)
    sine = below(r, 2) == 0 ? noses[below(r, COUNT(noses))] : U(0.2, 0.45);
  kinds[kind].change(&c, &sine, r);
  if (d.cushion) {
    d.rail = at_rail(&c, sine, r);
    /* for cushions nose 1.2 to 1.45 R, mu to 0.4, e from 0.5 */
    d.of_play = sine >= 0.2 && sine <= 0.45 && c.mu_i <= 0.4 && c.mu_b <= 0.4 && c.e >= 0.5;
  } else {
    d.balls = draw_turned(&c, below(r, 2) == 0 ? 0 : U(-3.2, 3.2));
    d.of_play = is_of_play(&d.balls);
  }
  return d;
}
