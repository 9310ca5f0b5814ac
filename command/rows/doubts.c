/* Rows that can be resolved but hardly were meant. */
#include "rows/doubts.h"

#include "program/message.h"

#include <math.h>

/* Balls in contact are R1 + R2 apart; simulators leave them some 1e-4 of it apart. */
static const double looseness = 0.01;

/* No break is faster than 20 m/s, no ball larger than a bowling ball; beyond half a radius
 * chalked tips slip off a ball. */
static const struct {
  const char *name, *has, *unit, *guess;
  double most;
} bounds[DOUBTS] = {
    [DOUBT_APART] = {.name = "not_touching"},
    [DOUBT_SPEED] = {"implausible_speed", "a ball has", "m/s", "are speeds in m/s?", 50.0},
    [DOUBT_SPIN] = {"implausible_spin", "a ball has", "rad/s", "are spins in rad/s?", 2000.0},
    [DOUBT_RADIUS] = {"implausible_radius", "the radius is", "m", "is R in mm or cm?", 0.5},
    [DOUBT_MASS] = {"implausible_mass", "the mass is", "kg", "is M in g?", 10.0},
    [DOUBT_TIP] = {"implausible_tip", "the tip is", "R from the centre",
                   "a chalked tip slips off the ball there (a miscue)", TIP_LIMIT *(1.0 + 1e-9)},
};

static double length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

static bool is_doubtful(int kind, double x) {
  if (kind == DOUBT_APART)
    return !(fabs(x - 1.0) <= looseness);
  return x > bounds[kind].most;
}

/* Counts the first of the numbers that is beyond its bound; returns its name. */
static const char *count_doubt(doubts *d, const double numbers[DOUBTS]) {
  d->rows++;
  for (int k = 0; k < DOUBTS; k++)
    if (is_doubtful(k, numbers[k])) {
      if (++d->count[k] == 1)
        d->first[k] = numbers[k];
      return bounds[k].name;
    }
  return NULL;
}

/* The distance of the centres over R1 + R2. */
static double share_of(const double *in) {
  const carom_impact *impact = (const carom_impact *)(const void *)in;
  const carom_ball *a = &impact->a, *b = &impact->b;
  const double offset[3] = {b->r[0] - a->r[0], b->r[1] - a->r[1], b->r[2] - a->r[2]};
  return length(offset) / (a->radius + b->radius);
}

const char *doubts_about(doubts *d, const row_kind *kind, const double *in) {
  double numbers[DOUBTS] = {kind == &ball_kind ? share_of(in) : 1.0, 0.0, 0.0, in[kind->radius],
                            in[kind->radius + 1]};
  /* The fastest of the balls. */
  for (int k = 0; k < 2 && kind->motion[k] >= 0; k++) {
    const double *v = in + kind->motion[k], *w = v + 3;
    numbers[DOUBT_SPEED] = fmax(numbers[DOUBT_SPEED], length(v));
    numbers[DOUBT_SPIN] = fmax(numbers[DOUBT_SPIN], length(w));
  }
  return count_doubt(d, numbers);
}

const char *doubts_about_tip(doubts *d, double offset) {
  return count_doubt(d, (const double[DOUBTS]){[DOUBT_APART] = 1.0, [DOUBT_TIP] = offset});
}

static bool is_near(double x, double expected) {
  return fabs(x / expected - 1.0) < 0.03;
}

/* What the distance of the centres over R1 + R2 may come from. */
static const char *guess(double share) {
  static const struct {
    double share;
    const char *guess;
  } mistakes[] = {{100.0, "; are the positions in cm?"},
                  {1000.0, "; are the positions in mm?"},
                  {0.5, "; is R the diameter?"},
                  {0.01, "; is R in cm?"},
                  {0.001, "; is R in mm?"}};
  for (size_t k = 0; k < sizeof mistakes / sizeof mistakes[0]; k++)
    if (is_near(share, mistakes[k].share))
      return mistakes[k].guess;
  return share < 1.0 ? "; the balls overlap" : "; the balls do not touch";
}

void doubts_report(const doubts *d, const char *noun, const char *file) {
  if (d->count[DOUBT_APART] > 0)
    complain("%s: in %lld of %lld collisions the centres are not R1 + R2 apart, in the first of "
             "them %.4g times as far%s",
             file, d->count[DOUBT_APART], d->rows, d->first[DOUBT_APART],
             guess(d->first[DOUBT_APART]));
  for (int k = DOUBT_SPEED; k < DOUBTS; k++)
    if (d->count[k] > 0)
      complain("%s: in %lld of %lld %ss %s more than %g %s, in the first of them %.4g; %s", file,
               d->count[k], d->rows, noun, bounds[k].has, bounds[k].most, bounds[k].unit,
               d->first[k], bounds[k].guess);
}
