/* The exact limit of the model of the 2010 paper: impulses at nose and cloth as a differential equation in p = P / M.
 *
 * coulomb.c has the law of friction. sliding.c takes the steps while what slips has a direction; else equations.c has the
 * equation for the slips, and platform/integrate.c takes the steps. The impulses of friction Q = int f dp and G = int F dp
 * follow at the end from the changes of the slips, in which they are linear:
 *
 *     7/2 Q_x + k_x G_x = s_x - s_x0                              k_x Q_x + 7/2 G_x = c_x - c_x0
 *     k_t Q_t + k_y G_y = s_t - s_t0 - sin cos p                  k_y Q_t + 7/2 G_y = c_y - c_y0 + cos p
 *
 * so the balance of momentum is exact.
 *
 * REGIMES. A regime is what sticks, and whether the cloth is loaded. It ends where a slip is zero (REST; within NEARLY, where
 * the rest of the way is straight to REST), where the friction that holds a contact leaves the cone, and where the load of the
 * cloth passes zero. carom_decide() says what follows. Slips whose rate is small go by slow.c.
 *
 * PHASES. Compression ends at v_y = 0, the impact where the work given back is e^2 of that of compression. Both are located to
 * CAROM_CUSHION_EVENT_TOLERANCE, and the parabola of the work, v_y being all but linear, takes the rest of the way.
 *
 * PLANAR IMPACTS, without motion along the cushion, have constant rates in each regime: closed form.
 *
 * WEDGED. If both contacts stick, v_y = 0 and stays so whatever the impulse: the impact ends there, and what has not been given
 * back is lost. Near that point contacts can come to rest in turns without end; slips below CORNER are taken to zero together,
 * once.
 *
 * BOUNDS. MOST_CHANGES of the regime and CAROM_CUSHION_BUDGET right-hand sides; beyond either the result is
 * CAROM_ERROR_UNRESOLVED. */
#include "cushion/mathavan.h"

#include "cushion/equations.h"
#include "cushion/models.h"
#include "cushion/sliding.h"
#include "cushion/slow.h"

static const double NEARLY = 1e-6;
static const double REST = 2e-11;      /* a slip that is none, over the approach and the largest slip together */
static const double CORNER = 5e-9;     /* slips at both contacts together that are none, likewise */
static const double MOST_SLIP = 1e100; /* over the approach; squares of more would overflow */
/* First steps of a regime: both slip, one sticks, a slip begins from zero. By `carom-lab bench --shots`; a step too long is
 * only refused. */
static const double FIRST = 2, FIRST_STUCK = 0.6, FIRST_FRESH = 0.5;
enum { MOST_CHANGES = 64 };

/* The regime from here on. */
static carom_status change(carom_cushion_way *w) {
  carom_slips at = slips_of(w->point.y);
  if (w->changes++ >= MOST_CHANGES || !carom_decide(&w->law, &at, w->rest, &w->regime))
    return CAROM_ERROR_UNRESOLVED;
  w->point.y[S_X] = at.s.x;
  w->point.y[S_T] = at.s.y;
  w->point.y[C_X] = at.c.x;
  w->point.y[C_Y] = at.c.y;
  w->nose_singular = w->law.mu_w > 0 && !w->regime.nose_sticks && length(at.s) > 0;
  w->cloth_singular = w->law.mu_s > 0 && w->regime.loaded && !w->regime.cloth_sticks && length(at.c) > 0;
  w->wedged = w->regime.nose_sticks && w->regime.cloth_sticks;
  w->slow = CAROM_NO_SLIP_IS_SLOW;
  const bool stuck = w->regime.nose_sticks || w->regime.cloth_sticks;
  w->point.next = stuck ? FIRST_STUCK : w->nose_singular && w->cloth_singular ? FIRST : FIRST_FRESH;
  const carom_ode ode = carom_cushion_equations(w);
  carom_ode_set(&ode, &w->point);
  /* slips that begin with a small rate */
  if (!w->nose_singular && carom_slip_is_stiff(w, false))
    carom_slow_begin(w, false, false, w->regime);
  else if (!w->cloth_singular && carom_slip_is_stiff(w, true))
    carom_slow_begin(w, true, false, w->regime);
  return CAROM_OK;
}

carom_status carom_cushion_way_begin(const carom_contact *c, carom_cushion_way *w) {
  const double per = 1 / c->v_y;
  *w = (carom_cushion_way){
      .per_sine = 1 / (1 + c->sine),

      .law = {.sine = c->sine,
              .cosine = c->cosine,
              .mu_s = c->mu_s,
              .mu_w = c->mu_w,
              .k_x = 1 - 2.5 * c->sine,
              .k_t = 2.5 + c->sine * c->sine,
              .k_y = 2.5 - c->sine},
      .e = c->e,
      .approach = c->v_y,
      .start = {{per * carom_slip_x(c), per * carom_slip_t(c)}, {per * carom_cloth_x(c), per * carom_cloth_y(c)}}};
  const double most = fabs(w->start.s.x) + fabs(w->start.s.y) + fabs(w->start.c.x) + fabs(w->start.c.y);
  if (!(most < MOST_SLIP))
    return CAROM_ERROR_OVERFLOW;
  w->rest = REST * (1 + most);
  w->point = (carom_ode_point){.y = {w->start.s.x, w->start.s.y, w->start.c.x, w->start.c.y}, .next = FIRST};
  return change(w);
}

/* Goes on by a small p along the tangent. */
static void go_on(carom_ode_point *at, double p) {
  for (int k = 0; k < UNKNOWNS; k++)
    at->y[k] += at->f[k] / at->f[P] * p;
}

/* From where a phase has ended, but for CAROM_CUSHION_EVENT_TOLERANCE, to its end by the parabola of the work. */
static void end_phase(carom_cushion_way *w) {
  carom_ode_point *at = &w->point;
  const double v = speed_into(&w->law, at->y), dv = speed_into(&w->law, at->f) / at->f[P];
  if (!w->in_restitution) {
    w->in_restitution = true;
    w->work_c = at->y[WORK] - v * v / (2 * dv);
    w->ended = !(w->e * w->e * w->work_c > 0);
    if (w->ended)
      go_on(at, -v / dv);
  } else {
    /* v q + dv q^2 / 2 = what is missing of the work */
    const double missing = (1 - w->e * w->e) * w->work_c - at->y[WORK], root = sqrt(fmax(v * v + 2 * dv * missing, 0));
    go_on(at, missing != 0 ? 2 * missing / (v - root) : 0);
    w->ended = true;
  }
}

/* One regime, or what is left to `most` (of p) of it, of an impact without motion along the cushion. Then the directions of the
 * slips are constant, and so are all rates: closed form. Returns whether the regime has ended. */
static bool go_straight(carom_cushion_way *w, double most) {
  carom_ode_point *at = &w->point;
  double rate[UNKNOWNS];
  for (int k = 0; k < UNKNOWNS; k++)
    rate[k] = at->f[k] / at->f[P];
  const double v = speed_into(&w->law, at->y), dv = speed_into(&w->law, rate);
  /* the end of the phase */
  double p = -v / dv;
  if (w->in_restitution) {
    const double missing = (1 - w->e * w->e) * w->work_c - at->y[WORK];
    p = 2 * missing / (v - sqrt(v * v + 2 * dv * missing));
  }
  const double to_end = p >= 0 ? p : INFINITY;
  /* slips that come to rest before */
  const bool nose = at->y[S_T] * rate[S_T] < 0 && w->law.mu_w > 0;
  const bool cloth = at->y[C_Y] * rate[C_Y] < 0 && w->law.mu_s > 0 && w->regime.loaded;
  p = fmin(fmin(most, to_end), fmin(nose ? -at->y[S_T] / rate[S_T] : INFINITY, cloth ? -at->y[C_Y] / rate[C_Y] : INFINITY));
  for (int k = 0; k < UNKNOWNS; k++)
    at->y[k] += k == WORK ? p * (v + 0.5 * dv * p) : p * rate[k];
  if (p == to_end)
    end_phase(w);
  at->evaluations++;
  return !w->ended && ((nose && fabs(at->y[S_T]) <= w->rest) || (cloth && fabs(at->y[C_Y]) <= w->rest));
}

/* Whether a slip comes to rest here: it is nearly zero, and what is left goes straight to zero. Then it is taken there. */
static bool comes_to_rest(carom_cushion_way *w, int k_x, int k_y) {
  const double *y = w->point.y, *f = w->point.f, x = y[k_x], t = y[k_y], dx = f[k_x], dt = f[k_y];
  const double left = sqrt(x * x + t * t), rate = sqrt(dx * dx + dt * dt);
  if (!(x * dx + t * dt < 0) || !(left <= w->rest || (left <= NEARLY && fabs(x * dt - t * dx) <= w->rest * rate)))
    return false;
  if (left > w->rest)
    go_on(&w->point, left / rate * f[P]);
  w->point.y[k_x] = w->point.y[k_y] = 0;
  return true;
}

/* Takes to zero what is as good as that: slips along the cushion where both are REST, which leaves a planar impact; and, once
 * in an impact, all slips where they are CORNER. Contacts that come to rest in turns would go round that corner without end.
 * Returns whether there was anything. */
static bool tidy(carom_cushion_way *w) {
  double *y = w->point.y;
  const carom_slips at = slips_of(y);
  if (!w->cornered && length(at.s) + length(at.c) <= CORNER * w->rest / REST) {
    w->cornered = true;
    y[S_X] = y[S_T] = y[C_X] = y[C_Y] = 0;
    return true;
  }
  if (fmax(fabs(y[S_X]), fabs(y[C_X])) > w->rest || (y[S_X] == 0 && y[C_X] == 0))
    return false;
  y[S_X] = y[C_X] = 0;
  return true;
}

/* One step, no further than the first event. Returns whether it ended there. */
static bool step(carom_cushion_way *w) {
  carom_ode_point *at = &w->point;
  if (!carom_sliding_applies(w)) {
    const carom_ode ode = carom_cushion_equations(w);
    return carom_ode_step(&ode, at, INFINITY) != 0;
  }
  double unused;
  carom_ode_point start = *at;
  carom_sliding_step(w);
  if (!(carom_cushion_event(w, at->y, at->f, &unused) >= 0))
    return false;
  carom_ode_point end = *at;
  carom_sliding_locate(w, &start);
  if (w->in_restitution || fabs(carom_phase_event(w, at->y, at->f, &unused)) > CAROM_CUSHION_EVENT_TOLERANCE ||
      fabs(at->y[P] - w->to) <= CAROM_CUSHION_EVENT_TOLERANCE)
    return true;
  /* v_y = 0 changes nothing but the phase: the step counts to its end, or to the first event of restitution */
  start = *at;
  end_phase(w);
  if (w->ended)
    return false;
  end.evaluations = at->evaluations;
  *at = end;
  if (!(carom_cushion_event(w, at->y, at->f, &unused) >= 0))
    return false;
  carom_sliding_locate(w, &start);
  return true;
}

carom_status carom_cushion_way_on(carom_cushion_way *w, double to, int budget) {
  const double p = w->to = to / w->approach;
  carom_ode_point *at = &w->point;
  while (!w->ended && !w->wedged && at->y[P] < p && at->evaluations < budget) {
    if (at->y[S_X] == 0 && at->y[C_X] == 0) {
      const carom_status status = go_straight(w, p - at->y[P]) ? change(w) : CAROM_OK;
      if (status != CAROM_OK)
        return status;
      continue;
    }
    if (carom_slow_finish(w)) {
      const carom_status status = carom_slow_end(w) ? change(w) : CAROM_OK;
      if (status != CAROM_OK)
        return status;
      continue;
    }
    bool changes = step(w);
    if (changes && fabs(at->y[P] - p) <= CAROM_CUSHION_EVENT_TOLERANCE) {
      go_on(at, p - at->y[P]);
      at->y[P] = p;
      break;
    }
    double unused;
    if (changes && fabs(carom_phase_event(w, at->y, at->f, &unused)) <= CAROM_CUSHION_EVENT_TOLERANCE) {
      end_phase(w);
      changes = false;
    }
    if (w->slow != CAROM_NO_SLIP_IS_SLOW) {
      const bool ends = changes && fabs(carom_slow_event(w, at->y, at->f, &unused)) <= CAROM_CUSHION_EVENT_TOLERANCE;
      if (!w->ended && (!carom_slow_keep(w) || ends))
        changes = carom_slow_end(w);
    } else if (!w->ended && !carom_slow_try(w, false))
      carom_slow_try(w, true);
    if (!w->ended && !w->regime.nose_sticks && w->law.mu_w > 0)
      changes |= comes_to_rest(w, S_X, S_T);
    if (!w->ended && !w->regime.cloth_sticks && w->regime.loaded && w->law.mu_s > 0)
      changes |= comes_to_rest(w, C_X, C_Y);
    if (!w->ended && tidy(w))
      changes = true;
    if (changes && !w->ended) {
      const carom_status status = change(w);
      if (status != CAROM_OK)
        return status;
    }
  }
  return w->ended || w->wedged || at->y[P] >= p ? CAROM_OK : CAROM_ERROR_UNRESOLVED;
}

double carom_cushion_way_work(const carom_cushion_way *w) {
  return w->point.y[WORK];
}

carom_impulse carom_cushion_way_impulse(const carom_cushion_way *w) {
  const carom_coulomb *k = &w->law;
  const double *y = w->point.y, p = y[P], all = w->approach;
  const double s_x = y[S_X] - w->start.s.x, c_x = y[C_X] - w->start.c.x, det_x = 12.25 - k->k_x * k->k_x;
  const double s_t = y[S_T] - w->start.s.y - k->sine * k->cosine * p, c_y = y[C_Y] - w->start.c.y + k->cosine * p;
  const double det_t = 2.5 * (1 + k->sine) * (1 + k->sine);
  return (carom_impulse){.P = all * p,
                         .f_x = all * (3.5 * s_x - k->k_x * c_x) / det_x,
                         .f_t = all * (3.5 * s_t - k->k_y * c_y) / det_t,
                         .F_x = all * (3.5 * c_x - k->k_x * s_x) / det_x,
                         .F_y = all * (k->k_t * c_y - k->k_y * s_t) / det_t};
}

carom_status carom_mathavan(carom_contact *c) {
  carom_cushion_way way;
  carom_status status = carom_cushion_way_begin(c, &way);
  if (status == CAROM_OK)
    status = carom_cushion_way_on(&way, INFINITY, CAROM_CUSHION_BUDGET);
  if (status != CAROM_OK)
    return status;
  const carom_impulse q = carom_cushion_way_impulse(&way);
  carom_push(c, &q);
  return CAROM_OK;
}
