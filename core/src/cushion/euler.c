/* Euler's steps of the 2010 paper, as the simulator pooltool takes them: for comparison with it,
 * and with the exact limit.
 *
 * METHOD. A step is a normal impulse dP at the nose with the friction that the slips before it
 * give. Compression takes steps of M v_y / N until v_y would fall to 0; the last one is replaced
 * by up to eight of dP/2, dP/4, ..., each taken only if v_y stays positive. Restitution takes
 * steps until the work sum |v_y| cos(theta) dP reaches e^2 of that of compression; the last step
 * is as long as its work should be. The work of a step is taken with the v_y after it.
 *
 * The steps of restitution are e M v_y / N. pooltool takes the number of joules to give back,
 * over N, for newton seconds, and so does its convention here. No step is below `least`. As
 * there, a phase of more than 10 N steps is given up.
 *
 * Slips that vanish chatter between two steps, so results jump in fine sweeps of the input. */
#include "cushion/models.h"

#include <stdbool.h>

enum { HALVINGS = 8, MOST_TURNS = 10 };

/* A direction: the slip over its size. Without one there is no friction; but with pooltool it is
 * that of x. */
static void slip_direction(double x, double y, bool pooltool, double *to_x, double *to_y) {
  const double size = sqrt(x * x + y * y);
  *to_x = pooltool ? 1 : 0;
  *to_y = 0;
  if (size > 0) {
    *to_x = x / size;
    *to_y = y / size;
  }
}

static void euler_step(carom_contact *c, double P, bool pooltool) {
  double at_x, at_t, over_x, over_y;
  slip_direction(carom_slip_x(c), carom_slip_t(c), pooltool, &at_x, &at_t);
  slip_direction(carom_cloth_x(c), carom_cloth_y(c), pooltool, &over_x, &over_y);
  /* the load on the cloth for each unit of P */
  const double load = c->sine + c->mu_w * at_t * c->cosine, g = pooltool || load > 0 ? load : 0;
  const carom_impulse q = {.P = P,
                           .f_x = -c->mu_w * at_x * P,
                           .f_t = -c->mu_w * at_t * P,
                           .F_x = -c->mu_s * g * over_x * P,
                           .F_y = -c->mu_s * g * over_y * P};
  carom_push(c, &q);
}

/* A step that counts. */
static void take_euler_step(carom_contact *c, double P, bool pooltool, carom_cushion_run *run) {
  euler_step(c, P, pooltool);
  run->impulse += P;
  run->work += P * fabs(c->v_y) * c->cosine;
  run->steps++;
}

carom_status carom_cushion_euler(carom_contact *c, int N, double least, int pooltool, int64_t most,
                                 carom_cushion_run *run) {
  const double approach = c->v_y;
  *run = (carom_cushion_run){.work_compression = NAN};
  /* compression */
  double P = fmax(approach / N, least);
  for (int64_t k = 0; c->v_y > 0; k++) {
    if (run->steps >= most)
      return CAROM_OK;
    if (k > (int64_t)MOST_TURNS * N)
      return CAROM_ERROR_TOO_SLOW;
    /* a step that stays within compression is taken; the one that would end it is halved */
    carom_contact next = *c;
    euler_step(&next, P, pooltool);
    if (next.v_y > 0) {
      take_euler_step(c, P, pooltool, run);
      continue;
    }
    for (int halving = 0; halving < HALVINGS && run->steps < most; halving++) {
      P /= 2;
      next = *c;
      euler_step(&next, P, pooltool);
      if (next.v_y > 0)
        take_euler_step(c, P, pooltool, run);
    }
    break;
  }

  /* restitution */
  const double work_c = run->work_compression = run->work, target = c->e * c->e * work_c;
  P = fmax(pooltool ? target / N : c->e * approach / N, least);
  for (int64_t k = 0; run->work - work_c < target && run->steps < most; k++) {
    if (k > (int64_t)MOST_TURNS * N)
      return CAROM_ERROR_TOO_SLOW;
    /* the last step does what is left of the work */
    const double left = target - (run->work - work_c), speed = fabs(c->v_y) * c->cosine;
    if (speed * P > left) {
      take_euler_step(c, left / speed, pooltool, run);
      break;
    }
    take_euler_step(c, P, pooltool, run);
  }
  return CAROM_OK;
}
