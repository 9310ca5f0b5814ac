/* The models of an impact on a cushion. Each takes a contact whose ball moves into the cushion
 * and leaves it with the motion after the impact; CAROM_OK, or an error, and then the contact is
 * of no use. */
#ifndef CAROM_SRC_CUSHION_MODELS_H
#define CAROM_SRC_CUSHION_MODELS_H

#include "contact_law/impact.h"
#include "cushion/contact.h"
#include "cushion/list.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "schema/numbers.h"

#include <stdbool.h>
#include <stdint.h>

/* The exact limit. See mathavan.c. */
carom_status carom_mathavan(carom_contact *contact, int plain);

/* Compliant impact. See stronge.c. */
carom_status carom_stronge(carom_contact *contact, const carom_cushion_options *opt);

/* Its friction impulse over the mass, against a slip, m/s, for a ball that meets a nose at v_n,
 * from any side. */
double carom_stronge_friction(const carom_contact *contact, double v_n, double slip,
                              const carom_cushion_options *opt);

/* Puts Han's fits for restitution and friction into a contact. See closed.c. */
void carom_apply_han(carom_contact *contact);

/* Coulomb impact on a rigid nose. See closed.c. */
carom_status carom_han(carom_contact *contact);

/* Its friction impulse over the mass, against a slip, for a ball that meets a nose at v_n. */
static inline double carom_han_friction(const carom_contact *contact, double v_n, double slip) {
  return carom_coulomb(slip, contact->mu_w, (1.0 + contact->e) * v_n);
}

/* Han's impact without its corner. See closed.c. */
carom_status carom_smooth(carom_contact *contact, const carom_cushion_options *opt);

/* Restitution and friction of a contact at its speed v_y, by the changes with ln(v_y). See
 * closed.c. */
void carom_apply_speed(carom_contact *contact, const carom_cushion_options *opt);

/* m/s: the speed below which restitution and friction change no more. */
#define CAROM_LEAST_LOG_SPEED 0.1

/* ln v_y, m/s; below 0.1 m/s as at 0.1. */
static inline double carom_log_of_speed(double v_y) {
  return carom_log(v_y > CAROM_LEAST_LOG_SPEED ? v_y : CAROM_LEAST_LOG_SPEED);
}

/* Restitution and friction of a contact by the law of the options: Han's fits, or the changes by
 * speed. See cushion.c. */
void carom_apply_law(carom_contact *contact, const carom_cushion_options *opt);

carom_status carom_mirror(carom_contact *contact);

/* Takes roll_loss, at 1 m/s across a cushion, of the speed v_t along it, before the impact, from
 * the roll along it, if the options have such a loss. Along t = (n_y, -n_x) a ball rolls at R w .
 * n. The roll does not change sign, so the energy falls. log_v: of the contact. */
void carom_lose_roll(const carom_cushion_options *opt, double radius,
                     const carom_cushion_frame *frame, double log_v, const double v[3],
                     double w[3]);

/* carom_cushion() with options that have been checked. See cushion.c. */
carom_status carom_cushion_solve(const carom_cushion_impact *in, const carom_cushion_options *opt,
                                 carom_motion *out);

/* How a run of Euler's method ended. */
typedef struct carom_cushion_run {
  int64_t steps;                          /* of both phases together */
  double impulse, work, work_compression; /* over the mass: normal impulse, m/s, and work,
                                             m^2/s^2 */
} carom_cushion_run;

/* Euler's N of options that have been checked. */
static inline int carom_cushion_steps(const carom_cushion_options *opt) {
  return opt->steps > 0 ? opt->steps : CAROM_DEFAULT_STEPS;
}

/* N steps of impulse, of which none is below `least` (N s over the mass, m/s); no more than
 * `most` are taken. See euler.c. */
carom_status carom_cushion_euler(carom_contact *contact, int steps, double least, int pooltool,
                                 int64_t most, carom_cushion_run *run);

/* The same to the end, by options; `mass` in kg. */
static inline carom_status carom_cushion_by_steps(carom_contact *contact,
                                                  const carom_cushion_options *opt, double mass) {
  carom_cushion_run run;
  return carom_cushion_euler(contact, carom_cushion_steps(opt), opt->least_step / mass,
                             opt->convention == CAROM_CONVENTION_POOLTOOL, INT64_MAX, &run);
}

/* The exact limit for the precise solver of core/src/contact_law. See mathavan.c. */
static inline carom_law carom_mathavan_law(const carom_contact *contact) {
  const double sine = contact->sine, cosine = contact->cosine;
  return (carom_law){.A_0 = sine * cosine,
                     .K_x = 3.5,
                     .K_y = CAROM_SPIN_PER_IMPULSE + sine * sine,
                     .C_x = 1 - CAROM_SPIN_PER_IMPULSE * sine,
                     .C_y = CAROM_SPIN_PER_IMPULSE - sine,
                     .B_0 = -cosine,
                     .L_x = 1 - CAROM_SPIN_PER_IMPULSE * sine,
                     .L_y = CAROM_SPIN_PER_IMPULSE - sine,
                     .H = 3.5,
                     .g_0 = sine,
                     .g_1 = -cosine,
                     .V_0 = -cosine,
                     .V_f = -sine,
                     .V_F = 1,
                     .mu = contact->mu_w,
                     .mu_c = contact->mu_s,
                     .e = contact->e};
}

/* Puts an impact at its start; tolerance: see impact.h. */
void carom_mathavan_begin(const carom_contact *contact, double tolerance, int plain,
                          carom_trajectory *path);

/* Impulses so far, over the mass. */
carom_impulse carom_mathavan_impulse(const carom_contact *contact, const carom_trajectory *path);

/* ---- Checks of arguments: options once per call, impacts once per row. See arguments.c. ---- */

/* CAROM_OK, or the error of the first option at fault. */
carom_status carom_cushion_check_options(const carom_cushion_options *opt);

/* CAROM_OK, or the error of the first field at fault; `*field` is its index. */
carom_status carom_cushion_check_impact(const carom_cushion_impact *in, int *field);

#endif
