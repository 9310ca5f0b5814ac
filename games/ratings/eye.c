/* Positions that a player cannot know exactly: in each play of a stroke the balls are displaced.
 *
 * Every ball at rest is moved by eye z in x and in y, with z normal, including a ball that the
 * referee spotted and a cue ball that the player placed: nobody places a ball better than he sees.
 * What a player does know is then restored, because the error of a gap is no larger than the gap. A
 * gap g of the layout, between two balls, or of a ball and a cushion or the edge of a pocket, is
 * drawn within
 *
 *     0 <= gap <= 2 g,                                                                         (1)
 *
 * so balls that touch do so in each play, along another direction, and a rack stays as tight as it
 * is. Balls that overlap, as layouts may by 0.05 mm, keep at most half of the overlap. The referee
 * reports whether a ball touches the cue ball (CAROM_RULES_TOUCH), so that stays too.
 *
 * The bounds (1) are met by alternating projections (L. M. Bregman, Doklady 162, 1965): two balls
 * whose gap is beyond a bound are moved along their line of centres, each by half, and a ball at a
 * cushion along its normal. The layout itself meets all bounds, so the projections converge where
 * the bounds are about linear, for errors that are small against the balls. Where they do not
 * converge, errors of half the size are tried. */
#include "eye.h"
#include "random_draws.h"

#include "rules.h"
#include "table/table.h"

#include <math.h>

enum { SWEEPS = 100 };
static const double moved_least = 1e-7; /* m: sweeps end when no ball is moved farther */
/* standard deviations within which a gap may be beyond its bounds */
static const double reach_of_errors = 12.0;

/* A draw that is being made. */
typedef struct eye_draw {
  const carom_prepared *layout;
  int struck;
  double reach;            /* m: a larger gap is beyond no bound */
  carom_ball_state *drawn; /* of each ball */
  double moved;            /* m: by the farthest projection of a sweep */
} eye_draw;

/* By how much a gap is short of its bounds, or above 0 beyond them; `gap` is the gap in the
 * layout. */
static double excess_of(double gap, double drawn_gap, bool of_cue_ball) {
  static const double margin = 1e-6; /* m */
  double low = fmin(0.5 * gap, 0.0), high = fmax(2.0 * gap, 0.0);
  if (of_cue_ball && gap < CAROM_RULES_TOUCH)
    high = fmin(high, fmax(gap, CAROM_RULES_TOUCH - margin));
  else if (of_cue_ball)
    low = fmin(gap, CAROM_RULES_TOUCH + margin);
  return drawn_gap - carom_within(drawn_gap, low, high);
}

static void move(eye_draw *d, int ball, const double direction[2], double distance) {
  d->drawn[ball].r[0] += distance * direction[0];
  d->drawn[ball].r[1] += distance * direction[1];
  d->moved = fmax(d->moved, fabs(distance));
}

/* The distance from b to a, and its direction. */
static double distance_of(const double a[2], const double b[2], double direction[2]) {
  const double offset[2] = {a[0] - b[0], a[1] - b[1]};
  const double distance = sqrt(offset[0] * offset[0] + offset[1] * offset[1]);
  direction[0] = offset[0] / distance;
  direction[1] = offset[1] / distance;
  return distance;
}

/* Two balls on the cloth touch where their centres are so far apart, seen from above. */
static double touch_of(const eye_draw *d, int a, int b) {
  return 2.0 * sqrt(d->layout->kind[a]->radius * d->layout->kind[b]->radius);
}

static void keep_apart(eye_draw *d, int a, int b) {
  const double square = carom_square(d->layout->state[a]->r, d->layout->state[b]->r);
  const double touch = touch_of(d, a, b), far = touch + d->reach;
  if (square > far * far)
    return;
  double direction[2];
  const double gap = distance_of(d->drawn[a].r, d->drawn[b].r, direction) - touch;
  const double excess = excess_of(sqrt(square) - touch, gap, a == d->struck || b == d->struck);
  if (excess == 0.0)
    return;
  move(d, a, direction, -0.5 * excess);
  move(d, b, direction, 0.5 * excess);
}

static void keep_off_rails(eye_draw *d, int ball) {
  const carom_features *f = d->layout->features;
  const carom_ball_kind *kind = d->layout->kind[ball];
  const double *r = d->layout->state[ball]->r, *drawn = d->drawn[ball].r;
  for (int k = 0; k < f->rails; k++) {
    const double *line = f->line[k], *along = f->along[k];
    const double distance = line[0] * r[0] + line[1] * r[1] + line[2];
    const double place = along[0] * r[0] + along[1] * r[1] + along[2];
    if (!(distance > 0.0 && distance < 2.0 * kind->radius + d->reach) || !(place >= 0.0) ||
        !(place <= 1.0))
      continue;
    const double touch = carom_reach_on_cloth(kind, d->layout->table->rail[k].height, f->reference);
    const double gap = line[0] * drawn[0] + line[1] * drawn[1] + line[2] - touch;
    move(d, ball, line, -excess_of(distance - touch, gap, false));
  }
}

/* The same for a jaw or a pocket, in which the centre of no ball is nearer than `touch`. */
static void keep_out(eye_draw *d, int ball, const double centre[2], double touch) {
  double direction[2];
  const double gap = distance_of(d->layout->state[ball]->r, centre, direction) - touch;
  if (gap > d->reach)
    return;
  const double drawn_gap = distance_of(d->drawn[ball].r, centre, direction) - touch;
  move(d, ball, direction, -excess_of(gap, drawn_gap, false));
}

static void keep_on_table(eye_draw *d, int ball) {
  const carom_table *table = d->layout->table;
  const carom_features *f = d->layout->features;
  keep_off_rails(d, ball);
  for (int k = 0; k < f->jaws; k++)
    keep_out(d, ball, table->jaw[k].centre,
             table->jaw[k].radius +
                 carom_reach_on_cloth(d->layout->kind[ball], table->jaw[k].height, f->reference));
  for (int k = 0; k < f->pockets; k++)
    keep_out(d, ball, table->pocket[k].centre, table->pocket[k].radius);
}

/* Whether a ball is so far from all cushions and pockets that none bounds its draw. */
static bool is_free(const eye_draw *d, int ball) {
  const carom_features *f = d->layout->features;
  const double *r = d->layout->state[ball]->r;
  return fabs(r[0] - f->eye[0]) <= f->clear[0] - d->reach &&
         fabs(r[1] - f->eye[1]) <= f->clear[1] - d->reach;
}

/* Projects all balls of a set; `bounded` is the set of those near the bounds of the table. */
static bool sweep(eye_draw *d, uint32_t in_play, uint32_t bounded) {
  d->moved = 0.0;
  for (int a = 0; in_play >> a != 0; a++)
    for (int b = 0; b < a && (in_play >> a & 1) != 0; b++)
      if (in_play >> b & 1)
        keep_apart(d, a, b);

  /* last, because a layout may have less overlap there */
  for (int k = 0; bounded >> k != 0; k++)
    if (bounded >> k & 1)
      keep_on_table(d, k);
  return d->moved <= moved_least;
}

/* Whether two balls overlap by more than layouts may. */
static bool overlap(const eye_draw *d, int a, int b) {
  const double least = touch_of(d, a, b) - CAROM_MOST_BALL_OVERLAP;
  return carom_square(d->drawn[a].r, d->drawn[b].r) < least * least;
}

/* Whether the sweeps have made a layout of the draws. */
static bool settle(eye_draw *d, uint32_t in_play, uint32_t bounded) {
  int sweeps = 0;
  while (!sweep(d, in_play, bounded) && sweeps < SWEEPS)
    sweeps++;
  bool good = true;
  for (int k = 0; in_play >> k != 0 && good; k++) {
    if (bounded >> k & 1)
      good = carom_stands_on_table(d->layout->table, d->layout->features, d->layout->kind[k],
                                   d->drawn[k].r);
    for (int b = 0; b < k && sweeps == SWEEPS && (in_play >> k & 1) != 0; b++)
      good &= !(in_play >> b & 1) || !overlap(d, k, b);
  }
  return good;
}

void carom_eye_draw(const carom_prepared *layout, int struck, double eye, uint64_t seed,
                    uint32_t stage, uint64_t row, carom_ball_state *drawn) {
  enum { OF_STROKE = 6, HALVES = 12 }; /* draws of a play that are the errors of its stroke */
  eye_draw d = {.layout = layout, .struck = struck, .drawn = drawn};
  d.reach = reach_of_errors * eye;
  double z[CAROM_BALLS_MOST][2];
  uint32_t in_play = 0, bounded = 0;
  for (int k = 0; k < layout->count; k++) {
    drawn[k] = *layout->state[k];
    if (carom_is_out(drawn[k].label) || !(eye > 0.0))
      continue;
    carom_normal_pair(seed, stage, row, OF_STROKE + 2 * (uint32_t)k, z[k]);
    in_play |= UINT32_C(1) << k;
    if (!is_free(&d, k))
      bounded |= UINT32_C(1) << k;
  }

  /* the last size is the layout itself */
  for (int halves = 0; halves <= HALVES; halves++) {
    double size = ldexp(eye, -halves);
    if (halves == HALVES)
      size = 0.0;
    for (int k = 0; in_play >> k != 0; k++)
      for (int x = 0; x < 2 && (in_play >> k & 1) != 0; x++)
        drawn[k].r[x] = layout->state[k]->r[x] + size * z[k][x];
    if (size == 0.0 || settle(&d, in_play, bounded))
      return;
  }
}
