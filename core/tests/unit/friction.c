/* The laws of the friction between balls. */
#include "friction/laws.h"
#include "support.h"

TEST(known_slips) {
  carom_impact in = {.a = {.radius = 0.03}, .b = {.r = {0.0, 0.06, 0.0}, .radius = 0.03}};
  const carom_speed_law law = carom_alciatore();
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108, 1e-15); /* no slip */
  /* across the line of centres */
  in.a.v[0] = 3.0;
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 3.0), 1e-15);
  in.b.w[0] = 4.0 / 0.03; /* and a surface that rises at 4 m/s: 5 m/s in all */
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 5.0), 1e-15);
  in.a.v[1] = 7.0; /* along it: no slip */
  ck_assert_double_eq_tol(carom_mu_ball(&in, law), 0.009951 + 0.108 * exp(-1.088 * 5.0), 1e-15);
  ck_assert_double_eq(carom_mu_ball(&in, (carom_speed_law){0.07, 0.0, 1.0}), 0.07);
  in.a.v[0] = NAN;
  ck_assert(isnan(carom_mu_ball(&in, law)));
  ck_assert(isnan(carom_mu_ball(NULL, law)));
}

TEST(rolling) {
  const double v[3] = {1.4, -0.7, 0.0}, still[3] = {0.0, 0.0, 5.0},
               rolls[3] = {0.7 / 0.03, 1.4 / 0.03, 0.0};
  double end[3];
  carom_rolling_velocity(v, still, 0.03, end);
  ck_assert_double_eq_tol(end[0], 1.0, 1e-15);
  ck_assert_double_eq_tol(end[1], -0.5, 1e-15);
  carom_rolling_velocity(v, rolls, 0.03, end); /* what rolls already continues */
  NEAR_EACH(end, v, 3, 1e-15);
  double in_place[3] = {rolls[0], rolls[1], rolls[2]};
  carom_rolling_velocity(v, in_place, 0.03, in_place);
  ck_assert_mem_eq(in_place, end, sizeof end);
}

/* A contact that lasts has the friction of two balls, by every law: where it slips to the end,
 * friction's impulse is mu, at the greatest slip, times that of the contact. */
TEST(laws_act_in_contacts_that_last) {
  for (int law = 0; law < CAROM_LAW_COUNT; law++) {
    carom_shot_ball ball[2];
    for (int i = 0; i < 2; i++) {
      ball[i] = (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
      carom_ball_kind *kind = &ball[i].kind;
      kind->mu_ball = 0.03;
      kind->law_a = 0.02;
      kind->law_b = 0.1;
      kind->law_c = 0.3;
      kind->restitution = 1.0;
      ball[i].state.r[1] = 2.0 * i * kind->radius;
      ball[i].state.r[2] = kind->radius;
    }
    ball[0].state.v[1] = 1.0;
    ball[0].state.w[2] = 200.0;
    const carom_shot_options options = {.friction = (carom_ball_friction)law};
    carom_motion after[2];
    expect_ok(carom_cluster(ball, 2, &options, after, NULL, 0, NULL));
    const double numbers[3] = {law == CAROM_LAW_CONSTANT ? 0.03 : 0.02, 0.1, 0.3},
                 R = ball[0].kind.radius, lost = 0.4 * R * (200.0 - after[0].w[2]); /* m/s */
    ck_assert_double_eq_tol(lost / after[1].v[1], carom_friction_at(law, numbers, 200.0 * R), 1e-5);
  }
}

/* The model MIRROR has numbers of 0. */
TEST(no_number_is_no_friction) {
  static const double none[3] = {0.0, 0.0, 0.0};
  for (int law = 0; law < CAROM_LAW_COUNT; law++)
    ck_assert(carom_friction_at(law, none, 0.7) == 0.0 &&
              carom_friction_ahead(law, none, 0.0, 0.3) == 0.0);
}
