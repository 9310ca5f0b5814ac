/* The search for jumps by halving, sweep.h. */
#include "sweep.h"

#include <math.h>
#include <string.h>

static const double smooth = 0.2; /* of the change, behind three halvings */

bool sweep_play(recipe *r, const recipe_number *number, double x, played *p) {
  memcpy((char *)r + number->offset, &x, sizeof x);
  p->x = x;
  return recipe_play(r, p);
}

bool sweep_halve(recipe *r, const recipe_number *number, played *low, played *high) {
  static _Thread_local played middle;
  double change = change_of(r, low, high), earlier = change;
  for (int k = 1;; k++) {
    const double x = low->x + 0.5 * (high->x - low->x);
    if (change < SWEEP_LEAST)
      return false;
    if (x == low->x || x == high->x)
      return true;
    if (!sweep_play(r, number, x, &middle))
      return false;
    const double left = change_of(r, low, &middle), right = change_of(r, &middle, high);
    change = fmax(left, right);
    *(left >= right ? high : low) = middle;
    if (k % 3 == 0) {
      if (change < smooth * earlier)
        return false;
      earlier = change;
    }
  }
}

difference sweep_size(const recipe *low, const recipe *high, double time) {
  static _Thread_local played p, q;
  recipe a = *low, b = *high;
  a.time = b.time = fmin(a.time, time + SWEEP_SHORTLY);
  if (!recipe_play(&a, &p) || !recipe_play(&b, &q))
    return (difference){INFINITY, INFINITY};
  return final_difference(&a, &p, &q);
}
