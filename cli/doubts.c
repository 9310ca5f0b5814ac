/* Collisions that can be resolved but hardly were meant. */
#include "doubts.h"

#include "message.h"

#include <math.h>

/* Balls in contact are R1 + R2 apart; simulators leave them some 1e-4 of it apart. No break is faster than 20 m/s. */
static const double looseness = 0.01, fastest = 50.0, spinning_most = 2000.0;

static double length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

static void count(long long *rows, double *first, double value) {
  if (++*rows == 1)
    *first = value;
}

const char *doubts_about(doubts *d, const carom_impact *in, bool distance) {
  const double between[3] = {in->b.r[0] - in->a.r[0], in->b.r[1] - in->a.r[1], in->b.r[2] - in->a.r[2]};
  const double share = length(between) / (in->a.radius + in->b.radius);
  const double speed = fmax(length(in->a.v), length(in->b.v)), spin = fmax(length(in->a.w), length(in->b.w));
  d->rows++;
  if (distance && !(fabs(share - 1.0) <= looseness)) {
    count(&d->apart, &d->share, share);
    return "not_touching";
  }
  if (speed > fastest) {
    count(&d->fast, &d->speed, speed);
    return "implausible_speed";
  }
  if (spin > spinning_most) {
    count(&d->spinning, &d->spin, spin);
    return "implausible_spin";
  }
  return NULL;
}

static bool near(double x, double wanted) {
  return fabs(x / wanted - 1.0) < 0.03;
}

static const char *guess(double share) {
  return near(share, 100.0)    ? "; are the positions in cm?"
         : near(share, 1000.0) ? "; are the positions in mm?"
         : near(share, 0.5)    ? "; is R the diameter?"
         : near(share, 0.01)   ? "; is R in cm?"
         : near(share, 0.001)  ? "; is R in mm?"
         : share < 1.0         ? "; the balls overlap"
                               : "; the balls do not touch";
}

void doubts_report(const doubts *d, const char *file) {
  if (d->apart > 0)
    complain("%s: in %lld of %lld collisions the centres are not R1 + R2 apart, in the first of them %.4g times as far%s", file,
             d->apart, d->rows, d->share, guess(d->share));
  if (d->fast > 0)
    complain("%s: in %lld of %lld collisions a ball has more than %g m/s, in the first of them %.4g; are speeds in m/s?", file,
             d->fast, d->rows, fastest, d->speed);
  if (d->spinning > 0)
    complain("%s: in %lld of %lld collisions a ball has more than %g rad/s, in the first of them %.4g; are spins in rad/s?",
             file, d->spinning, d->rows, spinning_most, d->spin);
}
