/* driver: runs one rung on the cases of standard input, so that callgrind can count its instructions.
 *
 *     driver STEPS < cases          one case a line: the 26 numbers of carom_impact in the order of the struct
 *
 * The rung is chosen when this file is compiled, -DCHOSEN_RUNG=carom_rung_base, so that a program holds one rung and its
 * disassembly is short. The way into the collision frame and out of it stands in two functions of its own, frame_in and
 * frame_out: they are counted too, as a row of their own. The sum of the results is printed, so that nothing is optimised away.
 */
#include "rung.h"

#include <stdio.h>
#include <stdlib.h>

carom_local frame_in(const carom_impact *in, carom_frame *frame);
void frame_out(const carom_frame *frame, const carom_local *state, carom_result *out);

__attribute__((noinline)) carom_local frame_in(const carom_impact *in, carom_frame *frame) {
  *frame = carom_frame_of(in);
  return carom_to_frame(frame, in, CAROM_SLIP_POOLTOOL);
}

__attribute__((noinline)) void frame_out(const carom_frame *frame, const carom_local *state, carom_result *out) {
  carom_from_frame(frame, state, out);
}

static int read_ball(carom_ball *ball) {
  double *field[] = {&ball->r[0], &ball->r[1], &ball->r[2], &ball->v[0],   &ball->v[1], &ball->v[2],
                     &ball->w[0], &ball->w[1], &ball->w[2], &ball->radius, &ball->mass, &ball->mu_cloth};
  for (size_t k = 0; k < sizeof field / sizeof *field; k++)
    if (scanf("%lf", field[k]) != 1)
      return 0;
  return 1;
}

int main(int argc, char **argv) {
  const int steps = argc > 1 ? atoi(argv[1]) : 0;
  if (steps < 1) {
    fprintf(stderr, "driver: usage: driver STEPS < cases, with STEPS at least 1\n");
    return 2;
  }
  carom_impact in;
  double sum = 0.0;
  while (read_ball(&in.a) && read_ball(&in.b) && scanf("%lf %lf", &in.mu_ball, &in.restitution) == 2) {
    carom_frame frame;
    carom_result out;
    carom_local state = frame_in(&in, &frame);
    CHOSEN_RUNG(&state, steps);
    frame_out(&frame, &state, &out);
    sum += out.a.v[0] + out.b.v[1] + out.a.w[2];
  }
  printf("%.17g\n", sum);
  return 0;
}
