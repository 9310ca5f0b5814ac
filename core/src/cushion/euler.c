/* Euler's steps of the 2010 paper, as the simulator pooltool takes them: for comparison with it,
 * and with the exact limit.
 *
 * METHOD. A step is a normal impulse dP at the nose with the friction that the slips before it
 * give. Compression takes steps of M v_y / N until v_y would fall to 0; the last one is replaced by
 * up to eight of dP/2, dP/4, ..., each taken only if v_y stays positive. Restitution takes steps
 * until the work sum |v_y| cos(theta) dP reaches e^2 of the work of compression; the last step is
 * as long as its work should be. The work of a step is taken with the v_y after it.
 *
 * The steps of restitution are e M v_y / N. pooltool takes the number of joules to return,
 * over N, for newton seconds, and so does its convention here. No step is below `least`. As
 * there, a phase of more than 10 N steps is given up.
 *
 * Slips that vanish chatter between two steps, so results jump in fine sweeps of the input. */
#include "cushion/models.h"

#include <stdbool.h>

enum { HALVINGS = 8, MOST_TURNS = 10 };

/* A direction: the slip over its size. Without a slip there is no friction; but with pooltool its
 * direction is x. */
static void slip_direction(double x, double y, bool pooltool, double *to_x, double *to_y) {
  const double size = sqrt(x * x + y * y);
  *to_x = pooltool ? 1 : 0;
  *to_y = 0;
  if (size > 0) {
    *to_x = x / size;
    *to_y = y / size;
  }
}

static void euler_step(carom_contact *contact, double P, bool pooltool) {
  double at_x, at_t, over_x, over_y;
  slip_direction(carom_slip_x(contact), carom_slip_t(contact), pooltool, &at_x, &at_t);
  slip_direction(carom_cloth_x(contact), carom_cloth_y(contact), pooltool, &over_x, &over_y);
  /* the load on the cloth for each unit of P */
  const double load = contact->sine + contact->mu_w * at_t * contact->cosine;
  const double borne = pooltool || load > 0 ? load : 0;
  const carom_impulse impulse = {.P = P,
                                 .f_x = -contact->mu_w * at_x * P,
                                 .f_t = -contact->mu_w * at_t * P,
                                 .F_x = -contact->mu_s * borne * over_x * P,
                                 .F_y = -contact->mu_s * borne * over_y * P};
  carom_push(contact, &impulse);
}

/* A step that counts. */
static void take_euler_step(carom_contact *contact, double P, bool pooltool,
                            carom_cushion_run *run) {
  euler_step(contact, P, pooltool);
  run->impulse += P;
  run->work += P * fabs(contact->v_y) * contact->cosine;
  run->steps++;
}

carom_status carom_cushion_euler(carom_contact *contact, int N, double least, int pooltool,
                                 int64_t most, carom_cushion_run *run) {
  const double approach = contact->v_y;
  *run = (carom_cushion_run){.work_compression = NAN};
  /* compression */
  double P = fmax(approach / N, least);
  for (int64_t steps = 0; contact->v_y > 0; steps++) {
    if (run->steps >= most)
      return CAROM_OK;
    if (steps > (int64_t)MOST_TURNS * N)
      return CAROM_ERROR_TOO_SLOW;
    /* a step that stays within compression is taken; the one that would end it is halved */
    carom_contact next = *contact;
    euler_step(&next, P, pooltool);
    if (next.v_y > 0) {
      take_euler_step(contact, P, pooltool, run);
      continue;
    }
    for (int halving = 0; halving < HALVINGS && run->steps < most; halving++) {
      P /= 2;
      next = *contact;
      euler_step(&next, P, pooltool);
      if (next.v_y > 0)
        take_euler_step(contact, P, pooltool, run);
    }
    break;
  }

  /* restitution */
  const double work_c = run->work_compression = run->work,
               target = contact->e * contact->e * work_c;
  P = fmax(pooltool ? target / N : contact->e * approach / N, least);
  for (int64_t steps = 0; run->work - work_c < target && run->steps < most; steps++) {
    if (steps > (int64_t)MOST_TURNS * N)
      return CAROM_ERROR_TOO_SLOW;
    /* the last step does what is left of the work */
    const double left = target - (run->work - work_c), speed = fabs(contact->v_y) * contact->cosine;
    if (speed * P > left) {
      take_euler_step(contact, left / speed, pooltool, run);
      break;
    }
    take_euler_step(contact, P, pooltool, run);
  }
  return CAROM_OK;
}
