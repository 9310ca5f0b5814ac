/* Players: how their strokes differ from those that they mean. */
#include "shot/shot.h"
#include "view.h"

#include <math.h>

/* The stage of draws of strokes outside plans; plan.c has the others. */
enum { DRAW_PLAYED = 4 };

carom_player carom_player_of(double scale) {
  return (carom_player){.speed = 0.1 * scale,
                        .phi = 0.1 * scale,
                        .theta = 0.1 * scale,
                        .a = 0.003 * scale,
                        .b = 0.003 * scale};
}

/* Errors by rating, in steps of 50 from 300, between which they are linear.
 * docs/understanding/plan.md has the run-outs from which they follow; build/carom-lab plan --racks
 * 1000 --shots 300 --errors E makes one of them again. */
carom_player carom_player_fargo(double rating) {
  static const double errors[] = {12.4, 8.5,  5.8,  4.1,  3.06, 2.48,
                                  1.99, 1.51, 1.15, 0.81, 0.58, 0.36};
  enum { LAST = sizeof errors / sizeof errors[0] - 1 };
  double at = (rating - 300.0) / 50.0;
  at = at > 0.0 ? at : 0.0;
  const int k = at < (double)LAST ? (int)at : LAST - 1;
  const double part = at < (double)LAST ? at - k : 1.0;
  return carom_player_of(errors[k] + part * (errors[k + 1] - errors[k]));
}

carom_player carom_player_bounded(const carom_player *player, const carom_cue *cue) {
  carom_player bounded = *player;
  const double gain = carom_tip_gain(cue), usual_least = 0.5 * gain, usual_most = 8.0 * gain;
  bounded.speed = gain * player->speed;
  const double least = player->speed_least, most = player->speed_most;
  const bool is_slow = most > 0.0 && most < usual_least;
  if (!(least > 0.0))
    bounded.speed_least = is_slow ? most : usual_least;
  if (!(most > 0.0))
    bounded.speed_most = least > usual_most ? least : usual_most;
  bounded.tip_most = player->tip_most > 0.0 ? player->tip_most : 0.5;
  return bounded;
}

void carom_player_errs(const carom_player *player, const double z[6], carom_cue *cue) {
  const double share = player->speed_share * cue->speed;
  const double speed = sqrt(player->speed * player->speed + share * share);
  cue->speed = carom_within(cue->speed + z[0] * speed, player->speed_least, player->speed_most);
  cue->phi += z[1] * player->phi;
  cue->theta = carom_within(cue->theta + z[2] * player->theta, 0.0, 90.0);
  cue->a = carom_within(cue->a + z[3] * player->a, -player->tip_most, player->tip_most);
  cue->b = carom_within(cue->b + z[4] * player->b, -player->tip_most, player->tip_most);
}

void carom_player_strike(const carom_player *player, uint64_t seed, uint64_t number,
                         carom_cue *cue) {
  if (player == NULL || cue == NULL)
    return;
  const carom_player bounded = carom_player_bounded(player, cue);
  double z[6];
  carom_normals(seed, DRAW_PLAYED, number, z);
  carom_player_errs(&bounded, z, cue);
}
