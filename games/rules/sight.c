/* Which balls the cue ball, ball 0, can hit in a straight line, past other balls. Cushions and jaws
 * are not looked at.
 *
 * The directions in which the cue ball meets a ball lie between the two that graze its edges.
 * Another ball hides those in which it would be met before. In snooker both edges must be free, in
 * blackball any portion of the ball. Of the free directions the first and the last one graze an
 * edge of that ball or of another one, so only these are tried, and the one to its middle. */
#include "rules.h"

#include <math.h>

/* m: so much nearer to a ball is in its way; one that touches is not in the way of others. */
static const double GRAZE = 1e-9;

/* The direction u from c in which the cue ball grazes ball k, `gap` beyond its edge, on a side: -1
 * or 1; 0: to its middle. Returns how far it is to there; 0 where the balls touch. */
static double direction_of(const carom_shot_ball *balls, const double c[2], int k, int side,
                           double gap, double u[2]) {
  const double x = balls[k].state.r[0] - c[0], y = balls[k].state.r[1] - c[1];
  const double reach = balls[0].kind.radius + balls[k].kind.radius + gap, d = sqrt(x * x + y * y);
  if (d <= reach)
    return 0.0;
  const double length = sqrt(d * d - reach * reach);
  double cosine = 1.0, sine = 0.0;
  if (side != 0) {
    cosine = length / d;
    sine = side * reach / d;
  }
  u[0] = (x * cosine - y * sine) / d;
  u[1] = (x * sine + y * cosine) / d;
  return length;
}

/* Whether a ball of `obstacles` is in the way, so far in the direction u. */
static bool is_barred(const carom_shot_ball *balls, uint32_t obstacles, const double c[2],
                      const double u[2], double length) {
  for (int k = 1; obstacles >> k != 0; k++) {
    const double offset[2] = {balls[k].state.r[0] - c[0], balls[k].state.r[1] - c[1]};
    const double least = balls[0].kind.radius + balls[k].kind.radius - GRAZE;
    if ((obstacles >> k & 1) && carom_is_near_way(offset, u, length, least))
      return true;
  }
  return false;
}

bool carom_is_hidden(const carom_shot_ball *balls, uint32_t others, const double c[2], int k) {
  for (int side = -1; side <= 1; side += 2) {
    double u[2];
    const double length = direction_of(balls, c, k, side, 0.0, u);
    if (length > 0.0 && is_barred(balls, others & ~carom_only(k), c, u, length))
      return true;
  }
  return false;
}

/* Whether the cue ball, from c in the direction u, meets ball k before those of `others`. */
static bool meets(const carom_shot_ball *balls, uint32_t others, const double c[2],
                  const double u[2], int k) {
  const double *r = balls[k].state.r, both = balls[0].kind.radius + balls[k].kind.radius;
  const double along = (r[0] - c[0]) * u[0] + (r[1] - c[1]) * u[1];
  const double square = both * both - (carom_square(r, c) - along * along);
  return along > 0.0 && square >= 0.0 && !is_barred(balls, others, c, u, along - sqrt(square));
}

bool carom_is_seen(const carom_shot_ball *balls, uint32_t others, const double c[2], int k) {
  const double reach = balls[0].kind.radius + balls[k].kind.radius + CAROM_RULES_TOUCH;
  if (carom_square(balls[k].state.r, c) <= reach * reach)
    return true;
  others &= ~carom_only(k);
  const uint32_t edges = others | carom_only(k);
  for (int n = 1; edges >> n != 0; n++) {
    double gap = 0.0, u[2];
    if (n == k)
      gap = -GRAZE;
    for (int side = -1; side <= 1 && (edges >> n & 1); side++)
      if (direction_of(balls, c, n, side, gap, u) > 0.0 && meets(balls, others, c, u, k))
        return true;
  }
  return false;
}
