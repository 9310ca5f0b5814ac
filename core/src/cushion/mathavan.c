/* The exact limit of the model of the 2010 paper: contact.h in the terms of contact_law/law.h.
 *
 * The driving contact is the nose, where y points along t. With p = P / M the slips and the
 * speed of approach change by
 *
 *     s_x' = 7/2 f_x + (1 - 5/2 sin) F_x
 *     s_t' = sin cos + (5/2 + sin^2) f_t + (5/2 - sin) F_y
 *     c_x' = (1 - 5/2 sin) f_x + 7/2 F_x            c_y' = -cos + (5/2 - sin) f_t + 7/2 F_y
 *     v_y' = -cos - sin f_t + F_y
 *
 * and vertical forces balance at the cloth: its load is sin - cos f_t, but never below 0: the
 * cloth does not pull. */

#include "cushion/models.h"

void carom_mathavan_begin(const carom_contact *contact, double tolerance, int plain,
                          carom_trajectory *path) {
  const double per = 1 / contact->v_y;
  const carom_law law = carom_mathavan_law(contact);
  carom_impact_begin(&law, tolerance, plain, per * carom_slip_x(contact),
                     per * carom_slip_t(contact), per * carom_cloth_x(contact),
                     per * carom_cloth_y(contact), 0, path);
}

carom_impulse carom_mathavan_impulse(const carom_contact *contact, const carom_trajectory *path) {
  const carom_impulses impulses = carom_impact_impulses(path);
  const double approach = contact->v_y;
  return (carom_impulse){.P = approach * impulses.p,
                         .f_x = approach * impulses.f_x,
                         .f_t = approach * impulses.f_y,
                         .F_x = approach * impulses.F_x,
                         .F_y = approach * impulses.F_y};
}

carom_status carom_mathavan(carom_contact *contact, int plain) {
  carom_trajectory path;
  carom_mathavan_begin(contact, 1, plain, &path);
  const carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  if (status == CAROM_OK) {
    const carom_impulse impulse = carom_mathavan_impulse(contact, &path);
    carom_push(contact, &impulse);
  }
  return status;
}
