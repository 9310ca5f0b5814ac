/* Contacts in the world pooltool: what its default engine does around the model, for the same histories.
 *
 * Before the model the things in contact are set 1e-6 m apart along their velocities, the clock standing still; where that
 * would take them farther than 5e-6 m, along the line between them instead. After the collision of two balls that keep
 * touching, at less than 1 cm/s and in nearly the same direction, a tenth of the faster normal velocity passes from one to the
 * other. Every ball slides then. Source: pooltool, commit 9a8abfe0. */
#include "shot/contact.h"
#include "shot/sim.h"

#include <math.h>

static const double spacer = 1e-6, longest = 5e-6; /* m */

/* The zero of smallest size of a t^2 + b t + c; those that are nearly real count. NaN if there is none. */
static double nearest_zero(double a, double b, double c) {
  double zero[2];
  const int zeros = carom_quadratic_zeros(a, b, c, zero);
  if (zeros == 0) {
    const double real = -b / (2.0 * a), imaginary = sqrt(4.0 * a * c - b * b) / (2.0 * a);
    return fabs(imaginary) < 1e-3 * fabs(real) ? real : NAN;
  }
  return zeros == 2 && fabs(zero[1]) < fabs(zero[0]) ? zero[1] : zero[0];
}

/* Two balls, set apart. False where pooltool has no answer. */
static bool kiss_balls(double R, carom_ball_state *a, carom_ball_state *b) {
  const double reach = 2.0 * R + spacer;
  const double x = b->r[0] - a->r[0], y = b->r[1] - a->r[1], v_x = b->v[0] - a->v[0], v_y = b->v[1] - a->v[1];
  const double t = nearest_zero(v_x * v_x + v_y * v_y, 2.0 * (x * v_x + y * v_y), x * x + y * y - reach * reach);
  if (isnan(t))
    return false;
  const double m_x = 0.5 * t * (a->v[0] + b->v[0]), m_y = 0.5 * t * (a->v[1] + b->v[1]);
  if (sqrt(m_x * m_x + m_y * m_y) <= longest) {
    for (int k = 0; k < 2; k++) {
      a->r[k] += t * a->v[k];
      b->r[k] += t * b->v[k];
    }
    return true;
  }
  const double size = sqrt(x * x + y * y), half = 0.5 * (reach - size) / size;
  a->r[0] -= half * x;
  a->r[1] -= half * y;
  b->r[0] += half * x;
  b->r[1] += half * y;
  return true;
}

/* See above. n from a to b. */
static void keep_touching(const double n[2], carom_ball_state *a, carom_ball_state *b) {
  const double speed_a = sqrt(a->v[0] * a->v[0] + a->v[1] * a->v[1]), speed_b = sqrt(b->v[0] * b->v[0] + b->v[1] * b->v[1]);
  if (!(speed_a > 0.0 && speed_b > 0.0))
    return;
  const double p = a->v[0] * n[0] + a->v[1] * n[1], q = b->v[0] * n[0] + b->v[1] * n[1];
  if (!(fabs(q - p) < 0.01) || !((a->v[0] * b->v[0] + a->v[1] * b->v[1]) / (speed_a * speed_b) > 0.9))
    return;
  const double passed = p > q ? 0.1 * p : -0.1 * q;
  for (int k = 0; k < 2; k++) {
    a->v[k] -= passed * n[k];
    b->v[k] += passed * n[k];
  }
}

carom_status carom_pooltool_balls(carom_sim *sim, int i, int j, carom_ball_state *a, carom_ball_state *b) {
  if (!kiss_balls(sim->rates[i].radius, a, b))
    return CAROM_ERROR_UNRESOLVED;
  double n[2] = {b->r[0] - a->r[0], b->r[1] - a->r[1]};
  const double size = sqrt(n[0] * n[0] + n[1] * n[1]);
  n[0] /= size;
  n[1] /= size;
  const carom_status status = carom_model_balls(sim, i, j, n, a, b);
  if (status < 0)
    return status;
  keep_touching(n, a, b);
  a->label = b->label = CAROM_BALL_SLIDING;
  return CAROM_OK;
}

/* Sets the ball at the spacer's distance from a rail; n becomes the direction into it. */
static void kiss_rail(const carom_rail *rail, const double line[3], double R, double n[2], carom_ball_state *s) {
  const double reach = R + spacer;
  const double turn = line[0] * s->v[0] + line[1] * s->v[1] > 0.0 ? 1.0 : -1.0;
  n[0] = turn * line[0];
  n[1] = turn * line[1];
  const double d = (s->r[0] - rail->p[0]) * n[0] + (s->r[1] - rail->p[1]) * n[1], v = s->v[0] * n[0] + s->v[1] * n[1];
  const double t1 = (reach - d) / v, t2 = (-reach - d) / v, t = fabs(t1) < fabs(t2) ? t1 : t2;
  const double speed = sqrt(s->v[0] * s->v[0] + s->v[1] * s->v[1]);
  if (fabs(t) * speed <= longest) {
    s->r[0] += t * s->v[0];
    s->r[1] += t * s->v[1];
  } else {
    const double more = (d > 0.0 ? reach : -reach) - d;
    s->r[0] += more * n[0];
    s->r[1] += more * n[1];
  }
}

static bool kiss_jaw(const carom_jaw *jaw, double R, double n[2], carom_ball_state *s) {
  const double reach = R + jaw->radius + spacer;
  const double x = s->r[0] - jaw->centre[0], y = s->r[1] - jaw->centre[1], v2 = s->v[0] * s->v[0] + s->v[1] * s->v[1];
  const double t = nearest_zero(v2, 2.0 * (x * s->v[0] + y * s->v[1]), x * x + y * y - reach * reach);
  if (isnan(t))
    return false;
  if (fabs(t) * sqrt(v2) <= longest) {
    s->r[0] += t * s->v[0];
    s->r[1] += t * s->v[1];
  } else {
    const double size = sqrt(x * x + y * y);
    s->r[0] = jaw->centre[0] + reach * x / size;
    s->r[1] = jaw->centre[1] + reach * y / size;
  }
  n[0] = jaw->centre[0] - s->r[0];
  n[1] = jaw->centre[1] - s->r[1];
  return true;
}

carom_status carom_pooltool_cushion(carom_sim *sim, int i, const carom_due *due, carom_ball_state *s) {
  const double R = sim->rates[i].radius;
  const carom_nose nose = carom_nose_of(sim->table, due);
  double n[2];
  if (due->type == CAROM_EVENT_RAIL) {
    kiss_rail(&sim->table->rail[due->b], sim->features->line[due->b], R, n, s);
  } else if (!kiss_jaw(&sim->table->jaw[due->b], R, n, s)) {
    return CAROM_ERROR_UNRESOLVED;
  }
  const carom_status status = carom_model_cushion(sim, i, n, &nose, s);
  s->label = CAROM_BALL_SLIDING;
  return status < 0 ? status : CAROM_OK;
}
