/* Balls and cues of the games. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

carom_cue carom_cue_of(carom_game game) {
  const bool snooker = game == CAROM_GAME_SNOOKER || game == CAROM_GAME_POOLTOOL_SNOOKER;
  const bool pooltool = game == CAROM_GAME_POOLTOOL_POOL || game == CAROM_GAME_POOLTOOL_SNOOKER ||
                        game == CAROM_GAME_POOLTOOL_BILLIARD;
  return (carom_cue){.speed = 2.0,
                     .phi = 90.0,
                     .b = 0.25,
                     .mass = snooker ? 0.478 : 0.567,
                     .end_mass = carom_ball_kind_of(game).mass / 30.0,
                     .tip_restitution = pooltool ? 1.0 : CAROM_TIP_LEATHER,
                     .tip_radius = 0.0106045,
                     .follow = pooltool ? 0.0 : CAROM_CUE_FOLLOW};
}

carom_ball_kind carom_ball_kind_of(carom_game game) {
  /* pool, by pooltool too */
  carom_ball_kind kind = {.mass = 0.170097,
                          .radius = 0.028575,
                          .mu_slide = 0.2,
                          .mu_roll = 0.01,
                          .mu_ball = 0.05,
                          .restitution = 0.95,
                          .mu_cushion = 0.2,
                          .restitution_cushion = 0.85,
                          .gravity = 9.81};
  if (game == CAROM_GAME_SNOOKER || game == CAROM_GAME_POOLTOOL_SNOOKER) {
    kind.mass = 0.140;
    kind.radius = 0.02619375;
    kind.mu_slide = kind.mu_cushion = 0.5;
  } else if (game == CAROM_GAME_BILLIARD || game == CAROM_GAME_POOLTOOL_BILLIARD) {
    kind.mass = 0.210;
    kind.radius = 0.03075;
    kind.mu_cushion = 0.15;
  }
  kind.mu_spin = 10.0 * 2.0 / 5.0 / 9.0 * kind.radius;

  /* measured: m/s^2 over g, or the coefficient itself */
  if (game == CAROM_GAME_SNOOKER) {
    kind.mu_slide = 2.075 / 9.81;
    kind.mu_roll = 0.125 / 9.81;
    kind.restitution = 0.89;
    /* of Han's closed form: rolling balls rebound as measured, at 0.5 to 2.5 m/s (physics/terms) */
    kind.mu_cushion = 0.2;
    kind.restitution_cushion = 0.948;
    kind.restitution_log = 0.0079;
    kind.restitution_log2 = -0.0948;
    kind.nose_height = 0.03074;
  } else if (game == CAROM_GAME_BILLIARD) {
    kind.mu_slide = 0.196;
    kind.mu_roll = 0.0042;
    kind.drag = 0.0118;
    kind.mu_spin = 0.0038;
    kind.restitution = 0.947;
    kind.mu_ball = 0.08;
    kind.law_a = 0.049;
    kind.law_b = 0.165;
    kind.law_c = 0.56;
    /* of the smooth cushion, the default of a ball that has its numbers */
    kind.mu_cushion = 0.255;
    kind.mu_log = -0.010;
    kind.restitution_cushion = 0.798;
    kind.nose_height = 0.0365;
    kind.roll_loss = 0.091;
    kind.roll_loss_log = 0.034;
    kind.smooth_q = 0.35;
    kind.smooth_x = 1.3;
    kind.smooth_t = 1.18;
    kind.smooth_a = 0.25;
    kind.smooth_g = 0.067;
    kind.smooth_g_log = -0.059;
    kind.smooth_e = 0.06;
  }
  return kind;
}

int carom_ball_kind_for(carom_game game, carom_shot_cushion cushion, carom_ball_kind *kind) {
  carom_ball_kind made = carom_ball_kind_of(game);
  const bool billiard = game == CAROM_GAME_BILLIARD, snooker = game == CAROM_GAME_SNOOKER;
  const bool exact = cushion == CAROM_SHOT_CUSHION_MATHAVAN || cushion == CAROM_SHOT_CUSHION_EULER;
  const carom_cushion_model model =
      exact ? CAROM_CUSHION_MATHAVAN : (carom_cushion_model)((int)cushion - 1);
  const bool usual = cushion == CAROM_SHOT_CUSHION_DEFAULT ||
                     cushion == (billiard ? CAROM_SHOT_CUSHION_SMOOTH : CAROM_SHOT_CUSHION_HAN);
  int own = usual || game != CAROM_GAME_POOL || cushion != CAROM_SHOT_CUSHION_SMOOTH;

  if (!usual && (billiard || (snooker && exact))) {
    /* what the default's model has besides is none of this one */
    made.mu_log = made.restitution_log = made.restitution_log2 = made.roll_loss_log = 0.0;
    made.smooth_q = made.smooth_x = made.smooth_t = made.smooth_a = 0.0;
    made.smooth_g = made.smooth_g_log = made.smooth_e = 0.0;
    made.mu_cushion = 0.14;
    made.restitution_cushion = 0.98;
    made.nose_height = 0.0;
    if (billiard) {
      own = carom_cushion_start(model, &made);
      made.roll_loss = cushion == CAROM_SHOT_CUSHION_MIRROR ? 0.0 : 0.087;
    }
  } else if (!usual && snooker) {
    own = 0;
  }
  if (kind != NULL)
    *kind = own ? made : carom_ball_kind_of(game);
  return own;
}
