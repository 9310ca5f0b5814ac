/* Where the nose of a cushion is, for balls that touch it at any height.
 *
 * A rail represents a wall at L: a ball on the cloth touches it when its centre is its radius
 * from L, though it touches the nose at its height h. So the true nose is the line at height h,
 *
 *   delta = R_ref - sqrt(h (2 R_ref - h))
 *
 *      L, the wall             .-'''-.
 *      |                     .'       '.
 *      | delta              (     o     )    s: from L to the centre, R_ref at the contact
 *      |--->o nose           '.       .'     d: from the nose to the centre
 *      |    | h                '-...-'
 *     _|____|___________________________ cloth
 *
 * inside L (1.143 mm for pool balls), R_ref being the radius of the balls that the table is
 * meant for. With s the distance of the centre from L, the centre is at d = (s - delta, z - h)
 * from the nose, across it and up; |d| = R at the contact. At z = R that is s = R for R = R_ref,
 * so flat and flying balls agree. Smaller and larger balls on the cloth touch at delta + sqrt(h
 * (2 R - h)). A jaw of radius rho is the circle of radius rho + delta at height h, s - delta
 * being the distance from that circle.
 */
#include "table/table.h"

#include <math.h>

double carom_nose_height(const carom_ball_kind *kind, double height) {
  return carom_or_usual(kind->nose_height, height);
}

double carom_nose_shift(double height, double reference) {
  return reference - sqrt(height * (2.0 * reference - height));
}

double carom_reach_on_cloth(const carom_ball_kind *kind, double height, double reference) {
  const double radius = kind->radius, nose_height = carom_nose_height(kind, height);
  return radius == reference ? radius
                             : carom_nose_shift(nose_height, reference) +
                                   sqrt(nose_height * (2.0 * radius - nose_height));
}
