/* A draw shot, and what the choice of the cloth's slip does to it.
 *
 * A cue ball meets a resting ball full on, spinning backwards at the rate at which it would roll
 * the other way. The balls exchange velocities, nearly; the spin stays, and draws the cue ball
 * back once the collision is over: a sliding ball comes to roll with (5/7) v + (2/7) R (w_y,
 * -w_x). Physics: docs/understanding/physics.md.
 */
#include <carom.h>
#include <stdio.h>

int main(void) {
  const double speed = 2.0, radius = 0.028575;
  carom_impact in = {
      .a = {.v = {0.0, speed, 0.0},
            .w = {speed / radius, 0.0, 0.0},
            .radius = radius,
            .mass = 0.17,
            .mu_slide = 0.2},
      .restitution = 0.95,
  };
  in.b =
      (carom_ball){.r = {0.0, 2.0 * radius, 0.0}, .radius = radius, .mass = 0.17, .mu_slide = 0.2};
  in.mu_ball = carom_mu_ball(&in, carom_alciatore());

  carom_options options = {0};
  for (int slip = CAROM_SLIP_PAPER; slip <= CAROM_SLIP_POOLTOOL; slip++) {
    carom_result out;
    carom_detail detail;
    double rolling[3];
    options.slip = (carom_slip)slip;
    const carom_status status = carom_collide_detail(&in, &options, &out, &detail);
    if (status != CAROM_OK) {
      fprintf(stderr, "%s\n", carom_status_string(status));
      return 1;
    }
    carom_rolling_velocity(out.a.v, out.a.w, radius, rolling);
    printf("%-8s  cue ball: %+.4f m/s, rolls back at %+.4f m/s; object ball: %+.4f m/s; normal "
           "impulse %.4f N s\n",
           carom_word(CAROM_WORDS_SLIP, (int)options.slip), out.a.v[1], rolling[1], out.b.v[1],
           detail.normal);
  }
  return 0;
}
