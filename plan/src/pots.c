/* A direct pot: the directions in which a ball gets into a pocket, and how likely it does.
 *
 * A ball at o gets into a pocket between the tangents from o to its two jaws, moved by 0.93 R: a
 * window of directions with the middle psi and the half width h. The cue ball has to come to the
 * ghost, g = o - (R + R') (cos psi, sin psi), over a distance d, and cuts by an angle c. An
 * error s of its direction becomes one of s d / ((R + R') cos c) of the ball's, to which the
 * uncertainty of throw adds 1.5 degrees sqrt(1.2 - cos c). With e the sum of both in squares the
 * chance is erf(h / (e sqrt 2)). It is 0 where a ball is in either way, where the ghost is in a
 * cushion, or the cut is above 80 degrees. */
#include "platform/elementary.h"
#include "view.h"

#include <math.h>
#include <string.h>

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

  /* jaws farther off than three radii are those of other pockets */
  mouth.jaws = least[1] < 9.0 * pocket->radius * pocket->radius;
  for (int side = 0; side < 2 && mouth.jaws; side++) {
    const carom_jaw *jaw = &table->jaw[nearest[side]];
    memcpy(mouth.jaw[side], jaw->centre, sizeof jaw->centre);
    mouth.jaw[side][2] = jaw->radius;
  }
  return mouth;
}

/* Whether no ball but i and j is nearer to the segment from p to q than its own radius and R
 * together. */
static bool is_clear(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
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

carom_window carom_window_of(const carom_mouth *mouth, const double o[2], double R) {
  const double x = mouth->centre[0] - o[0], y = mouth->centre[1] - o[1], mid = carom_angle_of(x, y);
  carom_window window = {.psi = mid, .half = 0.5}; /* of a ball between the jaws */
  if (!mouth->jaws) {
    const double sine = mouth->jaw[0][2] / sqrt(x * x + y * y);
    if (sine < 1.0)
      window.half = carom_asin(sine);
  } else {
    /* Where the jaws are from the middle, and how far their tangents are turned. */
    double turn[2], tangent[2];
    bool has_jaws = false;
    for (int side = 0; side < 2 && !has_jaws; side++) {
      const double jx = mouth->jaw[side][0] - o[0], jy = mouth->jaw[side][1] - o[1];
      const double sine = (mouth->jaw[side][2] + 0.93 * R) / sqrt(jx * jx + jy * jy);
      has_jaws = sine >= 1.0;
      turn[side] = carom_angle_of(jx, jy) - mid;
      double back = 0.0;
      if (turn[side] > pi)
        back = -2.0 * pi;
      else if (turn[side] < -pi)
        back = 2.0 * pi;
      turn[side] += back;
      tangent[side] = carom_asin(fmin(sine, 1.0));
    }

    /* Between the left one and the right one; from the side both may be on one side of the
     * pocket's centre. */
    if (!has_jaws) {
      const int left = turn[1] > turn[0];
      const double high = turn[left] - tangent[left], low = turn[1 - left] + tangent[1 - left];
      window.psi = mid + 0.5 * (low + high);
      window.half = 0.5 * (high - low);
    }
  }
  carom_sincos(window.psi, &window.sine, &window.cosine);
  return window;
}

carom_way carom_way_of(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       int k, int pocket, int seat, bool in_hand, double least) {
  const carom_mouth *mouth = &view->mouth[pocket];
  const double *o = balls[k].r, *c = balls[view->cue_ball].r;
  const double R = view->radius[view->cue_ball], both = R + view->radius[k];
  const bool is_unmoved = o[0] == view->place[k][0] && o[1] == view->place[k][1];
  carom_window window;
  if (is_unmoved)
    window = view->window[k][pocket];
  else
    window = carom_window_of(mouth, o, view->radius[k]);
  carom_way way = {.psi = window.psi, .half = window.half};
  if (!(way.half > 0.0))
    return way;

  /* The ghost has to be on the table. */
  const double sine = window.sine, cosine = window.cosine;
  const double g[2] = {o[0] - both * cosine, o[1] - both * sine}, edge = 0.9 * R;
  if (g[0] < edge || g[1] < edge || g[0] > view->width - edge || g[1] > view->length - edge)
    return way;

  /* Distance and cut; in hand they are those of an easy shot. */
  const double dx = g[0] - c[0], dy = g[1] - c[1];
  double d = sqrt(dx * dx + dy * dy), cut = 1.0;
  if (d >= 0.01)
    cut = (dx * cosine + dy * sine) / d;
  if (in_hand) {
    d = 0.3;
    cut = 0.97;
  }
  const double cosine_most = 0.17; /* of 80 degrees */
  if (cut < cosine_most)
    return way;

  /* Whether something is in the way takes longest, and is asked last. */
  const double aim = view->sigma[seat] * d / (both * cut), by_throw = 1.5 * pi / 180.0;
  const double error = sqrt(aim * aim + by_throw * by_throw * (1.2 - cut));
  const double chance = carom_erf(way.half / (error * 1.4142135623730951));
  if (chance > least &&
      is_clear(view, balls, in_play, o, mouth->centre, view->cue_ball, k, view->radius[k]) &&
      (in_hand || is_clear(view, balls, in_play, c, g, view->cue_ball, k, R)))
    way.chance = chance;
  return way;
}
