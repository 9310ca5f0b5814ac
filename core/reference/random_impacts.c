/* Draws are made in the collision frame, where slips and spins have meaning, and turned by a
 * random angle, in half of the draws by none, so that zeros stay zero. A number of its own seeds
 * every draw: any of them can be made again alone. */
#include "random_impacts.h"

#include "platform/enumerations.h"

#define U(low, high) lab_uniform(r, low, high)

static bool chance(lab_random *r, double p) {
  return U(0, 1) < p;
}

/* Balls meet: one that would not has its velocity along the line of centres reversed. */
static void make_approach(carom_local *c) {
  if (!(c->v_jy < c->v_iy))
    c->v_jy -= 2 * (c->v_jy - c->v_iy) + 0.01;
}

static carom_impact realistic(double s, lab_random *r) {
  carom_local c = {.R = chance(r, 0.5) ? 0.028575 : 0.02625, .M_i = U(0.1, 0.25), .s = s};
  c.M_j = c.M_i * (chance(r, 0.5) ? 1 : lab_log_uniform(r, 0.5, 2));
  if (chance(r, 0.5)) {
    c.mu_b = U(0, 0.2), c.mu_i = U(0, 0.5), c.e = U(0.5, 1);
    c.mu_j = chance(r, 0.5) ? c.mu_i : U(0, 0.5);
  } else
    c.mu_b = U(0.02, 0.12), c.mu_i = c.mu_j = U(0.1, 0.4), c.e = U(0.85, 0.99);
  const double v = lab_log_uniform(r, 0.05, 10);
  for (int j = 0; j < 2; j++) {
    /* the second rests in half of the draws, and else goes any way but with the first */
    double speed = v;
    if (j != 0)
      speed = chance(r, 0.5) ? 0 : v * U(0, 1);
    const double angle = j == 0 ? U(-1.5, 1.5) : U(1.6, 4.6);
    double roll = 1;
    if (!chance(r, 0.3))
      roll = chance(r, 0.15) ? 0 : U(-2, 1.5);
    double side = 0;
    if (!(speed == 0 && chance(r, 0.7))) {
      side = U(-1, 1);
      side *= (chance(r, 0.2) ? 4 : 1) * v;
    }
    draw_ball(&c, j, speed * sin(angle), speed * cos(angle), roll, side);
    if (speed > 0 && chance(r, 0.15)) {
      *(j ? &c.w_jx : &c.w_ix) += U(-1, 1) * v / c.R;
      *(j ? &c.w_jy : &c.w_iy) += U(-1, 1) * v / c.R;
    }
  }
  make_approach(&c);
  if (chance(r, 0.5))
    c = draw_exchanged(&c);
  return draw_turned(&c, chance(r, 0.5) ? 0 : U(-3.2, 3.2));
}

/* A share that is often 0 or 1, or near to it. */
static double corner(lab_random *r) {
  if (chance(r, 0.1))
    return 0;
  if (chance(r, 0.1))
    return 1;
  return chance(r, 0.3) ? lab_log_uniform(r, 1e-9, 1) : U(0, 1);
}
static double any(lab_random *r, double scale) {
  if (chance(r, 0.15))
    return 0;
  const int sign = chance(r, 0.5) ? 1 : -1;
  const double size = chance(r, 0.5) ? lab_log_uniform(r, 1e-6, 1e3) : U(0, 2);
  return sign * scale * size;
}

static carom_impact extreme(double s, lab_random *r) {
  carom_local c = {.R = lab_log_uniform(r, 1e-3, 1), .M_i = lab_log_uniform(r, 1e-2, 10), .s = s};
  c.M_j = c.M_i * (chance(r, 0.3) ? 1 : lab_log_uniform(r, 1e-3, 1e3));
  c.mu_b = corner(r), c.mu_i = corner(r), c.e = corner(r);
  c.mu_j = chance(r, 0.5) ? c.mu_i : corner(r);
  const double v = lab_log_uniform(r, 1e-6, 1e4);
  for (int j = 0; j < 2; j++)
    draw_ball(&c, j, any(r, v), any(r, v), chance(r, 0.3) ? 1 : any(r, 1), any(r, v));
  make_approach(&c);
  return draw_turned(&c, chance(r, 0.5) ? 0 : U(-3.2, 3.2));
}

carom_impact draw_collision(draw_kind kind, carom_slip slip, uint64_t seed, uint64_t k) {
  /* states of neighbouring draws are far apart in the generator's sequence */
  lab_random r = {(seed * 0x9E3779B97F4A7C15u) ^ (k * 0xD1B54A32D192ED03u + (uint64_t)slip)};
  lab_uniform(&r, 0, 1);
  const double s = carom_spin_sign(slip);
  switch (kind) {
  case DRAW_REALISTIC:
    return realistic(s, &r);
  case DRAW_REGIMES:
    return regimes_draw((int)(k % (uint64_t)regimes_count()), s, &r);
  default:
    return extreme(s, &r);
  }
}

carom_cushion_impact draw_cushion(cushion_draw kind, uint64_t seed, uint64_t k) {
  /* ranges of impacts of play, and of any */
  static const double friction[2][2] = {{0.1, 0.4}, {0, 1}}, restitution[2] = {0.6, 0},
                      height[2][2] = {{1.2, 1.45}, {0.05, 1.95}}, spins[2] = {100, 300};
  lab_random state = {seed * 0x2545f4914f6cdd1du + k * 0x9e3779b97f4a7c15u};
  const bool any = kind == CUSHION_ANY;
  const double degree = 3.14159265358979323846 / 180, speed = lab_uniform(&state, 0.05, 5),
               turn = lab_uniform(&state, -180, 180) * degree;
  /* from square to grazing, on both sides */
  const double angle = lab_uniform(&state, -89.5, 89.5) * degree, spin = spins[any];
  carom_cushion_impact in = {
      .normal = {cos(turn), sin(turn)},
      .v = {speed * cos(turn + angle), speed * sin(turn + angle)},
      .radius = lab_uniform(&state, 0.025, 0.031),
      .mass = lab_uniform(&state, 0.13, 0.21),
      .mu_slide = lab_uniform(&state, friction[any][0], friction[any][1]),
      .mu_cushion = lab_uniform(&state, friction[any][0], friction[any][1]),
      .restitution = lab_uniform(&state, restitution[any], 1),
      .jaw_radius = lab_uniform(&state, 0, 1) < 0.5 ? 0 : lab_uniform(&state, 0.005, 0.03)};
  in.height = in.radius * lab_uniform(&state, height[any][0], height[any][1]);
  for (int c = 0; c < 3; c++)
    in.w[c] = lab_uniform(&state, -spin, spin);
  const double what = lab_uniform(&state, 0, 1);
  if (what < 0.3) { /* a rolling ball, with side */
    in.w[0] = -in.v[1] / in.radius;
    in.w[1] = in.v[0] / in.radius;
  } else if (what < 0.4) { /* a perpendicular one, with top or draw but no side */
    const double top = lab_uniform(&state, -1, 1) * spin;
    in = (carom_cushion_impact){.v = {0, speed, 0},
                                .w = {what < 0.35 ? top : -speed / in.radius, 0, 0},
                                .normal = {0, 1},
                                .height = in.height,
                                .radius = in.radius,
                                .mass = in.mass,
                                .mu_slide = in.mu_slide,
                                .mu_cushion = in.mu_cushion,
                                .restitution = in.restitution};
  } else if (what < 0.5) /* a ball that slides without spin */
    in.w[0] = in.w[1] = in.w[2] = 0;
  return in;
}

int draw_groups(draw_kind kind) {
  if (kind == DRAW_COINCIDENCES)
    return coincidence_kinds();
  return kind == DRAW_CUSHION ? CUSHION_DRAWS : CAROM_SLIP_COUNT;
}

const char *draw_name(draw_kind kind, int group) {
  if (kind == DRAW_COINCIDENCES)
    return coincidence_name(group);
  if (kind != DRAW_CUSHION)
    return carom_word(CAROM_WORDS_SLIP, group);
  return group == CUSHION_PLAY ? "play" : "any";
}

bool is_of_play(const carom_impact *in) {
  const double ratio = in->a.mass / in->b.mass;
  return in->mu_ball <= 0.2 && fmax(in->a.mu_slide, in->b.mu_slide) <= 0.5 &&
         in->restitution >= 0.5 && ratio >= 0.5 && ratio <= 2;
}

drawn draw(draw_kind kind, int group, uint64_t seed, uint64_t k) {
  drawn drawn_case = {.cushion = kind == DRAW_CUSHION, .slip = (carom_slip)group};
  if (kind == DRAW_COINCIDENCES)
    return coincidence_draw(group, seed, k);
  if (drawn_case.cushion) {
    drawn_case.rail = draw_cushion((cushion_draw)group, seed, k);
    drawn_case.of_play = group == CUSHION_PLAY;
    drawn_case.slip = CAROM_SLIP_PAPER;
  } else {
    drawn_case.balls = draw_collision(kind, drawn_case.slip, seed, k);
    drawn_case.of_play = is_of_play(&drawn_case.balls);
  }
  return drawn_case;
}

double cushion_distance(const carom_cushion_impact *in, const carom_motion *a,
                        const carom_motion *b) {
  double most = 0, scale = 0;
  for (int c = 0; c < 3; c++) {
    most = fmax(most, fmax(fabs(a->v[c] - b->v[c]), in->radius * fabs(a->w[c] - b->w[c])));
    scale = fmax(scale, fmax(fabs(in->v[c]), in->radius * fabs(in->w[c])));
  }
  return most / scale;
}
