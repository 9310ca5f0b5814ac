/* A direct pot: the directions in which a ball gets into a pocket, and how likely it does.
 *
 * A ball of radius R at o gets into a pocket between two directions, one at each jaw: a window with
 * the middle psi and the half width h. At a jaw of radius j the ball may come nearer than to touch
 * it, to the distance (R + j) (1 - p), because it still falls. The overlap p depends on the angle
 * of the way to the middle of the mouth. A ball that moves along a rail also gets in by the rail:
 * at an angle d to it, and from a gap g, it leaves the rail by 0.68 d, which may be as much as the
 * farther jaw lets in. The numbers come from sweeps of a ball that rolls at 1.5 m/s; the test
 * games/windows repeats them. At 1 m/s windows are 0.15 wider, at 2.5 m/s 0.05 narrower.
 *
 * The cue ball has to reach the ghost, g = o - (R + R') (cos psi, sin psi), over a distance d, and
 * cuts by an angle c. An error s of its direction becomes one of s d / ((R + R') cos c) of the
 * ball's, to which the uncertainty of throw adds 1.5 degrees sqrt(1.2 - cos c). With e the sum of
 * both in squares the chance is erf(h / (e sqrt 2)). It is 0 where a ball is in either way, where
 * the ghost is in a cushion, or the cut is above 80 degrees. */
#include "platform/elementary.h"
#include "random_draws.h"
#include "table/table.h"
#include "view.h"

#include <math.h>
#include <string.h>

/* The direction of the cushion that ends nearest to a jaw, to its end; 0 where there is none. */
static void find_rail(const carom_table *table, const double jaw[3], double direction[2]) {
  double least = INFINITY;
  for (int k = 0; k < table->rails; k++) {
    const double *const end[2] = {table->rail[k].p, table->rail[k].q};
    for (int n = 0; n < 2 && !carom_is_cut(table, k); n++) {
      const double x = end[n][0] - jaw[0], y = end[n][1] - jaw[1];
      if (x * x + y * y >= least)
        continue;
      least = x * x + y * y;
      const double along[2] = {end[n][0] - end[1 - n][0], end[n][1] - end[1 - n][1]};
      const double length = sqrt(along[0] * along[0] + along[1] * along[1]);
      direction[0] = along[0] / length;
      direction[1] = along[1] / length;
    }
  }
}

/* Finds the middle of the mouth, its left jaw, and whether the rails next to it lead into it, as
 * those next to a side pocket do not. */
static void find_rails(const carom_table *table, carom_mouth *mouth) {
  double(*jaw)[3] = mouth->jaw;
  const double x = jaw[1][0] - jaw[0][0], y = jaw[1][1] - jaw[0][1];
  const double inward[2] = {mouth->centre[0] - 0.5 * (jaw[0][0] + jaw[1][0]),
                            mouth->centre[1] - 0.5 * (jaw[0][1] + jaw[1][1])};
  mouth->left = x * inward[1] - y * inward[0] < 0.0;
  mouth->axis = mouth->left ? carom_angle_of(y, -x) : carom_angle_of(-y, x);

  double sine, cosine;
  carom_sincos(mouth->axis, &sine, &cosine);
  mouth->rails = true;
  for (int side = 0; side < 2; side++) {
    double *rail = mouth->rail[side];
    find_rail(table, jaw[side], rail);
    mouth->rails &= rail[0] * cosine + rail[1] * sine > 0.5;
  }
}

/* The two jaws nearest to the centre of a pocket, where both are near. */
carom_mouth carom_mouth_of(const carom_table *table, int index) {
  const carom_pocket *pocket = &table->pocket[index];
  carom_mouth mouth = {.centre = {pocket->centre[0], pocket->centre[1]},
                       .jaw = {{0.0, 0.0, pocket->radius}}};
  double least[2] = {INFINITY, INFINITY};
  int nearest[2] = {-1, -1};
  for (int k = 0; k < table->jaws; k++) {
    const double x = table->jaw[k].centre[0] - pocket->centre[0],
                 y = table->jaw[k].centre[1] - pocket->centre[1];
    const double square = x * x + y * y;
    int slot = 2; /* among the two nearest, or behind them */
    if (square < least[0])
      slot = 0;
    else if (square < least[1])
      slot = 1;
    if (slot == 0) {
      least[1] = least[0];
      nearest[1] = nearest[0];
    }
    if (slot < 2) {
      least[slot] = square;
      nearest[slot] = k;
    }
  }

  /* jaws farther away than three radii belong to other pockets */
  mouth.jaws = least[1] < 9.0 * pocket->radius * pocket->radius;
  for (int side = 0; side < 2 && mouth.jaws; side++) {
    const carom_jaw *jaw = &table->jaw[nearest[side]];
    memcpy(mouth.jaw[side], jaw->centre, sizeof jaw->centre);
    mouth.jaw[side][2] = jaw->radius;
  }
  if (mouth.jaws)
    find_rails(table, &mouth);
  return mouth;
}

/* Whether no ball but i and j is nearer to the segment from p to q than its own radius and R
 * together. */
bool carom_is_free_way(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       const double p[2], const double q[2], int i, int j, double R) {
  double d[2] = {q[0] - p[0], q[1] - p[1]};
  const double length = sqrt(d[0] * d[0] + d[1] * d[1]);
  if (length < 1e-9)
    return true;
  d[0] /= length;
  d[1] /= length;
  in_play &= ~(UINT32_C(1) << i | UINT32_C(1) << j);
  for (int k = 0; in_play >> k != 0; k++) {
    const double offset[2] = {balls[k].r[0] - p[0], balls[k].r[1] - p[1]};
    if ((in_play >> k & 1) && carom_is_near_way(offset, d, length, R + view->radius[k]))
      return false;
  }
  return true;
}

/* The fraction of the sum of the radii of a ball and a jaw by which a ball that gets in may be
 * nearer to the jaw than in touch. The way in is turned by `turn`, rad, from the middle of the
 * mouth to the farther jaw; below 0 to this one. The face behind the farther jaw lets an oblique
 * ball in; `roundness` is the radius of the jaw over the ball's. */
static double overlap_at(bool corner, double turn, double roundness) {
  /* of side and corner pockets: straight in; per rad; and of round jaws more */
  static const double straight[2] = {0.19, 0.11}, nearer[2] = {0.28, 0.18};
  static const double farther[2] = {0.33, 0.30}, rounder[2] = {0.18, 0.05};
  if (turn > 0.0)
    return fmax(straight[corner] - nearer[corner] * turn, 0.0);
  return fmin(straight[corner] - (farther[corner] + rounder[corner] * roundness) * turn, 0.6);
}

/* How far behind the tangent to the jaw at `side` a way by the rail next to it still leads into the
 * pocket, rad; `tangent` is its angle to the rail. A rail returns 0.68 of the angle to it. */
static double by_rail(const carom_mouth *mouth, int side, const double o[2], double R,
                      double tangent) {
  /* the least way behind the rail, m, and that on which it counts wholly */
  static const double returned = 0.68, shortest = 0.12, enough = 0.32;
  const double *jaw = mouth->jaw[side], *other = mouth->jaw[1 - side], *t = mouth->rail[side];
  const double x = jaw[0] - o[0], y = jaw[1] - o[1];

  /* along the rail to the farther jaw, and away from it: the gap of the ball, and that jaw */
  const double sign = side == mouth->left ? 1.0 : -1.0;
  const double n[2] = {sign * t[1], -sign * t[0]};
  const double along = (other[0] - o[0]) * t[0] + (other[1] - o[1]) * t[1];
  const double gap = -(x * n[0] + y * n[1]) - jaw[2] - R;
  const double beyond = (other[0] - jaw[0]) * n[0] + (other[1] - jaw[1]) * n[1] - jaw[2] - R;

  /* how far the ball may be off the rail at the farther jaw, in its direction before the rail */
  const double nearest = (1.0 - overlap_at(true, -0.25 * pi, other[2] / R)) * (other[2] + R);
  const double off = (beyond - nearest) / returned;
  if (!(along > 0.0 && gap > -R && off > 0.0))
    return 0.0;

  /* the direction to the rail; the less way is behind it, the less it counts */
  const double into = off + fmax(gap, 0.0);
  const double share = (along * off / into - shortest) / (enough - shortest);
  return carom_within(share, 0.0, 1.0) * fmax(into / along - tangent, 0.0);
}

carom_window carom_window_of(const carom_mouth *mouth, const double o[2], double R) {
  const double x = mouth->centre[0] - o[0], y = mouth->centre[1] - o[1], mid = carom_angle_of(x, y);
  carom_window window = {.psi = mid, .half = 0.5}; /* of a ball between the jaws */
  if (!mouth->jaws) {
    const double sine = mouth->jaw[0][2] / sqrt(x * x + y * y);
    if (sine < 1.0)
      window.half = carom_asin(sine);
  } else {
    /* how far the way is turned from the middle of the mouth to the left */
    const int left = mouth->left;
    const double turned = carom_wrapped(mid - mouth->axis);
    double edge[2]; /* of the window at each jaw, from the middle */
    bool has_jaws = false;
    for (int side = 0; side < 2 && !has_jaws; side++) {
      const double sign = side == left ? 1.0 : -1.0, *jaw = mouth->jaw[side];
      const double jx = jaw[0] - o[0], jy = jaw[1] - o[1];
      const double overlap = overlap_at(mouth->rails, -sign * turned, jaw[2] / R);
      const double sine = (jaw[2] + R) * (1.0 - overlap) / sqrt(jx * jx + jy * jy);
      has_jaws = sine >= 1.0;

      /* the tangent to the jaw, and behind it the way by the rail */
      edge[side] = carom_wrapped(carom_angle_of(jx, jy) - mid) - sign * carom_asin(fmin(sine, 1.0));
      if (mouth->rails && sign * turned < 0.0) {
        const double rail = carom_angle_of(mouth->rail[side][0], mouth->rail[side][1]);
        edge[side] +=
            sign * by_rail(mouth, side, o, R, sign * carom_wrapped(mid + edge[side] - rail));
      }
    }

    /* Between the left one and the right one; from the side both may be on one side of the
     * pocket's centre. */
    if (!has_jaws) {
      window.psi = mid + 0.5 * (edge[left] + edge[1 - left]);
      window.half = 0.5 * (edge[left] - edge[1 - left]);
    }
  }
  carom_sincos(window.psi, &window.sine, &window.cosine);
  return window;
}

bool carom_way_into(const carom_view *view, const double o[2], double radius, const double c[2],
                    const carom_window *window, int seat, carom_hit *hit) {
  const double R = view->radius[view->cue_ball], both = R + radius;
  if (!(window->half > 0.0))
    return false;

  /* The ghost has to be on the table. */
  const double sine = window->sine, cosine = window->cosine, edge = 0.9 * R;
  double *g = hit->ghost;
  g[0] = o[0] - both * cosine;
  g[1] = o[1] - both * sine;
  if (g[0] < edge || g[1] < edge || g[0] > view->width - edge || g[1] > view->length - edge)
    return false;

  /* Distance and cut; in hand, of an easy shot. */
  double d = 0.3, cut = 0.97;
  if (c != NULL) {
    const double dx = g[0] - c[0], dy = g[1] - c[1];
    d = sqrt(dx * dx + dy * dy);
    cut = d >= 0.01 ? (dx * cosine + dy * sine) / d : 1.0;
  }
  const double cosine_most = 0.17; /* of 80 degrees */
  if (cut < cosine_most)
    return false;
  const double aim = view->sigma[seat] * d / (both * cut), by_throw = 1.5 * pi / 180.0;
  const double error = sqrt(aim * aim + by_throw * by_throw * (1.2 - cut));
  hit->half = window->half * both * cut / fmax(d, 0.01);
  hit->chance = carom_erf(window->half / (error * 1.4142135623730951));
  return true;
}

carom_way carom_way_of(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       int k, int pocket, int seat, bool in_hand, double least) {
  const carom_mouth *mouth = &view->mouth[pocket];
  const double *o = balls[k].r, *c = balls[view->cue_ball].r;
  const bool is_unmoved = o[0] == view->place[k][0] && o[1] == view->place[k][1];
  carom_window window;
  if (is_unmoved)
    window = view->window[k][pocket];
  else
    window = carom_window_of(mouth, o, view->radius[k]);
  carom_way way = {.psi = window.psi, .half = window.half};
  carom_hit hit;
  if (!carom_way_into(view, o, view->radius[k], in_hand ? NULL : c, &window, seat, &hit))
    return way;

  /* Whether something is in the way takes longest, and is checked last. */
  if (hit.chance > least &&
      carom_is_free_way(view, balls, in_play, o, mouth->centre, view->cue_ball, k,
                        view->radius[k]) &&
      (in_hand || carom_is_free_way(view, balls, in_play, c, hit.ghost, view->cue_ball, k,
                                    view->radius[view->cue_ball])))
    way.chance = hit.chance;
  return way;
}
