/* Velocities and spins in words. */
#include "telling.h"

#include "derived.h"

#include <math.h>

const char *side_of(double degrees) {
  return degrees > 0.0 ? "left" : "right";
}

const char *velocity_text(const double v[2], double scale, char text[64]) {
  const double speed = hypot(v[0], v[1]), angle = angle_between((const double[]){1.0, 0.0}, v);
  if (speed < 1e-9 * scale)
    snprintf(text, 64, "at rest");
  else {
    const int size = snprintf(text, 64, speed < 1e6 ? "%.3f m/s, " : "%.4g m/s, ", speed);
    if (fabs(angle) < 0.005 || fabs(angle) > 179.995)
      snprintf(text + size, (size_t)(64 - size), "straight %s", fabs(angle) < 90.0 ? "on" : "back");
    else
      snprintf(text + size, (size_t)(64 - size), "%.2f degrees to the %s", fabs(angle),
               side_of(angle));
  }
  return text;
}

void tell_spin(FILE *out, const double w[3]) {
  const double level = hypot(w[0], w[1]), upright = fabs(w[2]) < 0.005 ? 0.0 : w[2]; /* not -0.00 */
  fprintf(out,
          fmax(fabs(w[2]), level) < 1e9 ? "              spin after:  %.2f rad/s about the "
                                          "vertical, %.2f rad/s about a horizontal axis\n"
                                        : "              spin after:  %.4g rad/s about the "
                                          "vertical, %.4g rad/s about a horizontal axis\n",
          upright, level);
}
