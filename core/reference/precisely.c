/* Whole impacts by the precise solver alone. */
#include "reference.h"

#include "ball_ball/reduced.h"
#include "cushion/models.h"

#include <math.h>

carom_status collide_precisely(const carom_impact *in, carom_slip slip, double tolerance,
                               carom_result *out) {
  const carom_frame frame = carom_frame_of(in);
  carom_local local = carom_to_frame(&frame, in, slip);
  if (local.v_jy >= local.v_iy)
    return CAROM_SEPARATING;
  const carom_reduced c = carom_reduce(&local);
  carom_trajectory path;
  const carom_status status = carom_precise(&c, tolerance, 0, &path);
  const carom_integrals total = carom_precise_integrals(&c, &path);
  carom_restore(&c, &total, &local);
  carom_from_frame(&frame, &local, out);
  return status;
}

carom_status cushion_precisely(const carom_cushion_impact *in, double tolerance,
                               carom_motion *out) {
  const carom_cushion_options options = {0};
  const carom_cushion_frame frame = carom_cushion_frame_of(in);
  carom_contact contact = carom_to_cushion(&frame, in, &options);
  if (contact.v_y <= 0)
    return CAROM_SEPARATING;
  carom_trajectory path;
  carom_mathavan_begin(&contact, tolerance, 0, &path);
  const carom_status status = carom_impact_advance(&path, INFINITY, CAROM_IMPACT_ITERATIONS);
  const carom_impulse total = carom_mathavan_impulse(&contact, &path);
  carom_push(&contact, &total);
  carom_from_cushion(&frame, &contact, in->radius, out);
  return status;
}
