/* A table that the player does not know: its cushions and its cloth are drawn, with the errors of
 * his strokes.
 *
 * Of the TABLES tables of a plan each has restitution and friction of the cushions, rolling
 * resistance and sliding friction times exp(unsure s z), with z normal and at most 1 of each
 * number. Tables are made in pairs, the second with -z, so that their mean is the table as it is.
 * Row k of a round has table k, so all candidates meet the same tables.
 *
 * s is the standard deviation of a uniform range over its mean. Three ranges are those that
 * Alciatore gives for pool tables, "physical properties" at billiards.colostate.edu
 * (data/measured.csv): restitution 0.6 to 0.9, rolling 0.005 to 0.015, sliding 0.15 to 0.4. The
 * friction of cushions was measured as 0.14 (Mathavan 2010) and 0.255
 * (docs/reference/constants.md), of one table each. So `unsure` 1 is a player who knows nothing
 * of this table but that it is one. */
#include "drawn_tables.h"

#include "platform/elementary.h"
#include "random_draws.h"

#include <math.h>

enum { RESTITUTION, FRICTION, ROLLING, SLIDING, NUMBERS };
static const double spread[NUMBERS] = {0.1155, 0.1681, 0.2887, 0.2624};

/* At most 1, as all are shares. */
static double times(double number, double factor) {
  return carom_within(number * factor, 0.0, fmax(number, 1.0));
}

void carom_search_tables(carom_search *search, carom_drawn_table *room) {
  search->drawn = room;
  for (int k = 0; k < TABLES; k++) {
    double z[6], factor[NUMBERS];
    carom_normals(search->options.seed, DRAW_TABLES, (uint64_t)k / 2, z);
    const double sign = 1.0 - 2.0 * (k % 2);
    for (int n = 0; n < NUMBERS; n++)
      factor[n] = carom_exp(search->options.unsure * spread[n] * sign * z[n]);

    /* the numbers of the balls; and the numbers of a rail or its own jaw, which are 0 if it has
     * none */
    carom_drawn_table *drawn = &room[k];
    for (int ball = 0; ball < search->plays; ball++) {
      carom_ball_kind *kind = &drawn->kind[ball];
      *kind = search->played[ball].kind;
      kind->restitution_cushion = times(kind->restitution_cushion, factor[RESTITUTION]);
      kind->mu_cushion = times(kind->mu_cushion, factor[FRICTION]);
      kind->mu_roll = times(kind->mu_roll, factor[ROLLING]);
      kind->mu_slide = times(kind->mu_slide, factor[SLIDING]);
    }
    drawn->table = *search->job.table;
    for (int r = 0; r < drawn->table.rails; r++) {
      carom_rail *rail = &drawn->table.rail[r];
      rail->restitution = times(rail->restitution, factor[RESTITUTION]);
      rail->mu_cushion = times(rail->mu_cushion, factor[FRICTION]);
    }
    for (int j = 0; j < drawn->table.jaws; j++) {
      carom_jaw *jaw = &drawn->table.jaw[j];
      jaw->restitution = times(jaw->restitution, factor[RESTITUTION]);
      jaw->mu_cushion = times(jaw->mu_cushion, factor[FRICTION]);
    }
  }
}

carom_prepared carom_search_drawn(const carom_search *search, uint32_t draws, int64_t row) {
  carom_prepared p = search->layout;
  carom_take_balls(&p, search->played, search->plays);
  if (draws == 0 || search->drawn == NULL)
    return p;
  const carom_drawn_table *drawn = &search->drawn[(row + 8 * (int64_t)draws) % TABLES];
  p.table = &drawn->table;
  for (int k = 0; k < p.count; k++)
    p.kind[k] = &drawn->kind[k];
  return p;
}
