/* The rules of the world pooltool: all in which its default engine differs, for the same
 * histories.
 *
 * ORDER. Only times that are equal as doubles are simultaneous. Of each kind the entry that was
 * computed first leads (in one round: by index), then lower tiers, then higher energies, then
 * the order of kinds: ends of phases, rails, jaws, pockets, pairs.
 *
 * ZEROS. A rail or a jaw is met wherever the gap is 0, coming or going, and a pocket where its
 * circle is crossed; two balls that overlap collide now, even if they part.
 *
 * CONTACTS. Before the model the things in contact are set 1e-6 m apart along their velocities,
 * the clock standing still; where that would take them farther than 5e-6 m, along the line
 * between them instead. After the collision of two balls that keep touching, at less than 1 cm/s
 * and in nearly the same direction, a tenth of the faster normal velocity passes from one to the
 * other. Every ball slides then.
 *
 * Source: pooltool, commit 9a8abfe0. */
#include "ball_ball/arguments.h"
#include "ball_ball/euler.h"
#include "motion/gap.h"
#include "shot/rules.h"

#include <math.h>
#include <stddef.h>

/* s: pooltool's EPS; earlier zeros are no contact with a rail */
static const double root_least = 2.220446049250313e-14;
static const double spacer = 1e-6, longest = 5e-6; /* m */
/* Balls keep touching where their normal velocities, m/s, differ by less than this, and the cosine
 * of their directions is above that; this fraction of the faster one is passed on. */
static const double keeps_touching = 0.01, nearly_parallel = 0.9, passed_over = 0.1;
static const double nearly_real = 1e-3; /* imaginary part of a zero, relative to its real part */

/* ---- ORDER */

static double energy_of(const carom_sim *sim, int ball) {
  const carom_ball_kind *kind = sim->layout->kind[ball];
  carom_ball_state state;
  carom_path_at(&sim->path[ball], &sim->rates[ball], sim->time, &state);
  const double v2 = carom_space_dot(state.v, state.v), w2 = carom_space_dot(state.w, state.w);
  return 0.5 * kind->mass * v2 + 0.5 * 0.4 * kind->mass * kind->radius * kind->radius * w2 +
         kind->mass * kind->gravity * (state.r[2] - kind->radius);
}

static double energy_of_event(const carom_sim *sim, const carom_due *pending_event) {
  if (pending_event->type != CAROM_EVENT_BALL_BALL)
    return energy_of(sim, pending_event->a);
  carom_ball_state a, b;
  carom_path_at(&sim->path[pending_event->a], &sim->rates[pending_event->a], sim->time, &a);
  carom_path_at(&sim->path[pending_event->b], &sim->rates[pending_event->b], sim->time, &b);
  const double x = a.v[0] - b.v[0], y = a.v[1] - b.v[1];
  return x * x + y * y;
}

static int kind_of(int type) { /* in the order of pooltool's candidates */
  switch (type) {
  case CAROM_EVENT_RAIL:
    return 1;
  case CAROM_EVENT_JAW:
    return 2;
  case CAROM_EVENT_POCKET:
    return 3;
  case CAROM_EVENT_BALL_BALL:
    return 4;
  default:
    return 0;
  }
}
static int tier_of(int kind) {
  if (kind == 0 || kind == 3)
    return 2;
  return 3;
}
static int round_of(const carom_sim *sim, const carom_due *pending_event) {
  if (pending_event->type == CAROM_EVENT_BALL_BALL)
    return sim->pair_round[pending_event->a][pending_event->b];
  if (pending_event->type < CAROM_EVENT_SLIDING_ROLLING)
    return sim->meeting_round[pending_event->a];
  return 0;
}

static carom_due choose(const carom_sim *sim, const carom_due *pending_events, int count) {
  const carom_due *of_kind[5] = {NULL}, *best = NULL;
  for (int index = 0; index < count; index++) {
    const carom_due **leader = &of_kind[kind_of(pending_events[index].type)];
    if (*leader == NULL || round_of(sim, &pending_events[index]) < round_of(sim, *leader))
      *leader = &pending_events[index];
  }
  for (int index = 0; index < 5; index++) {
    if (of_kind[index] == NULL)
      continue;
    int tiers = -1;
    if (best != NULL)
      tiers = tier_of(index) - tier_of(kind_of(best->type));
    if (tiers < 0 ||
        (tiers == 0 && energy_of_event(sim, of_kind[index]) > energy_of_event(sim, best)))
      best = of_kind[index];
  }
  return *best;
}

/* ---- ZEROS */

static int touch_rail(const double gap[3], double horizon, double times[2]) {
  double zero[2];
  const int zeros = carom_quadratic_zeros(gap[2], gap[1], gap[0], zero);
  int count = 0;
  for (int index = 0; index < zeros; index++)
    if (zero[index] > root_least && zero[index] <= horizon)
      times[count++] = zero[index];
  return count;
}

static double touch_ball(const carom_separation *separation, double reach, double horizon) {
  if (carom_plane_dot(separation->d0, separation->d0) < reach * reach)
    return 0.0;
  return carom_first_crossing(separation, reach, horizon);
}

/* ---- CONTACTS */

/* The zero of smallest size of a t^2 + b t + c; those that are nearly real count. NaN if there
 * is none. */
static double nearest_zero(double a, double b, double c) {
  double zero[2];
  const int zeros = carom_quadratic_zeros(a, b, c, zero);
  if (zeros == 0) {
    const double real = -b / (2.0 * a), imaginary = sqrt(4.0 * a * c - b * b) / (2.0 * a);
    if (fabs(imaginary) < nearly_real * fabs(real))
      return real;
    return NAN;
  }
  if (zeros == 2 && fabs(zero[1]) < fabs(zero[0]))
    return zero[1];
  return zero[0];
}

/* Two balls, set apart; the normal becomes the direction from a to b. False where pooltool has no
 * answer. */
static bool kiss_balls(double radius, double normal[2], carom_ball_state *a, carom_ball_state *b) {
  const double reach = 2.0 * radius + spacer;
  const double x = b->r[0] - a->r[0], y = b->r[1] - a->r[1], v_x = b->v[0] - a->v[0],
               v_y = b->v[1] - a->v[1];
  const double time =
      nearest_zero(v_x * v_x + v_y * v_y, 2.0 * (x * v_x + y * v_y), x * x + y * y - reach * reach);
  if (isnan(time))
    return false;
  const double m_x = 0.5 * time * (a->v[0] + b->v[0]), m_y = 0.5 * time * (a->v[1] + b->v[1]);
  const double apart = sqrt(x * x + y * y), half = 0.5 * (reach - apart) / apart;
  const bool along = sqrt(m_x * m_x + m_y * m_y) <= longest;
  if (along) {
    a->r[0] += time * a->v[0];
    a->r[1] += time * a->v[1];
    b->r[0] += time * b->v[0];
    b->r[1] += time * b->v[1];
  } else {
    a->r[0] -= half * x;
    a->r[1] -= half * y;
    b->r[0] += half * x;
    b->r[1] += half * y;
  }
  normal[0] = b->r[0] - a->r[0];
  normal[1] = b->r[1] - a->r[1];
  const double size = carom_plane_size(normal);
  normal[0] /= size;
  normal[1] /= size;
  return true;
}

/* See above. n from a to b. */
static void keep_touching(const double normal[2], carom_ball_state *a, carom_ball_state *b) {
  const double speed_a = carom_plane_size(a->v), speed_b = carom_plane_size(b->v);
  if (!(speed_a > 0.0 && speed_b > 0.0))
    return;
  const double normal_a = carom_plane_dot(a->v, normal), normal_b = carom_plane_dot(b->v, normal);
  if (!(fabs(normal_b - normal_a) < keeps_touching) ||
      !(carom_plane_dot(a->v, b->v) / (speed_a * speed_b) > nearly_parallel))
    return;
  double passed = -passed_over * normal_b;
  if (normal_a > normal_b)
    passed = passed_over * normal_a;
  for (int axis = 0; axis < 2; axis++) {
    a->v[axis] -= passed * normal[axis];
    b->v[axis] += passed * normal[axis];
  }
}

/* Sets the ball at the spacer's distance from a rail; the normal becomes the direction into it. */
static void kiss_rail(const carom_rail *rail, const double line[3], double radius, double normal[2],
                      carom_ball_state *state) {
  const double reach = radius + spacer;
  double turn = -1.0;
  if (carom_plane_dot(line, state->v) > 0.0)
    turn = 1.0;
  normal[0] = turn * line[0];
  normal[1] = turn * line[1];
  const double distance =
                   (state->r[0] - rail->p[0]) * normal[0] + (state->r[1] - rail->p[1]) * normal[1],
               closing = carom_plane_dot(state->v, normal);
  const double front = (reach - distance) / closing;
  double time = (-reach - distance) / closing;
  if (fabs(front) < fabs(time))
    time = front;
  const double speed = carom_plane_size(state->v);
  if (fabs(time) * speed <= longest) {
    state->r[0] += time * state->v[0];
    state->r[1] += time * state->v[1];
  } else {
    double more = -reach - distance;
    if (distance > 0.0)
      more = reach - distance;
    state->r[0] += more * normal[0];
    state->r[1] += more * normal[1];
  }
}

static bool kiss_jaw(const carom_jaw *jaw, double radius, double normal[2],
                     carom_ball_state *state) {
  const double reach = radius + jaw->radius + spacer;
  const double x = state->r[0] - jaw->centre[0], y = state->r[1] - jaw->centre[1],
               square = carom_plane_dot(state->v, state->v);
  const double time = nearest_zero(square, 2.0 * (x * state->v[0] + y * state->v[1]),
                                   x * x + y * y - reach * reach);
  if (isnan(time))
    return false;
  if (fabs(time) * sqrt(square) <= longest) {
    state->r[0] += time * state->v[0];
    state->r[1] += time * state->v[1];
  } else {
    const double size = sqrt(x * x + y * y);
    state->r[0] = jaw->centre[0] + reach * x / size;
    state->r[1] = jaw->centre[1] + reach * y / size;
  }
  normal[0] = jaw->centre[0] - state->r[0];
  normal[1] = jaw->centre[1] - state->r[1];
  return true;
}

static bool kiss_cushion(const carom_sim *sim, const carom_due *pending_event, double normal[2],
                         carom_ball_state *state) {
  const double radius = sim->rates[pending_event->a].radius;
  if (pending_event->type == CAROM_EVENT_JAW)
    return kiss_jaw(&sim->table->jaw[pending_event->b], radius, normal, state);
  kiss_rail(&sim->table->rail[pending_event->b], sim->features->line[pending_event->b], radius,
            normal, state);
  return true;
}

static carom_status resolve(carom_sim *sim, const carom_due *pending_event, carom_ball_state *a,
                            carom_ball_state *b) {
  double normal[3] = {0.0};
  bool kissed;
  if (b != NULL)
    kissed = kiss_balls(sim->rates[pending_event->a].radius, normal, a, b);
  else
    kissed = kiss_cushion(sim, pending_event, normal, a);
  if (!kissed)
    return CAROM_ERROR_UNRESOLVED;
  carom_status status;
  if (b != NULL)
    status = carom_model_balls(sim, pending_event, normal, false, a, b);
  else
    status = carom_model_cushion(sim, pending_event, normal, a);
  a->label = CAROM_BALL_SLIDING;
  if (status < 0)
    return status;
  if (b == NULL)
    return CAROM_OK;
  keep_touching(normal, a, b);
  b->label = CAROM_BALL_SLIDING;
  return CAROM_OK;
}

/* Balls that part, as balls may that the spacers push into each other in a rack: pooltool takes
 * its steps of Euler's method nevertheless. The first ends the compression, the second the
 * restitution, so the balls part faster by 2 (1 + e) / N of their speed. Balls that neither part
 * nor close stay as they are; its loop has no end there. */
static void part_by_steps(const carom_impact *in, const carom_options *options, carom_result *out) {
  const carom_frame frame = carom_frame_of(in);
  carom_local local = carom_to_frame(&frame, in, options->slip);
  carom_euler_run run;
  if (local.v_jy > local.v_iy &&
      carom_euler(&local, carom_steps(options), INT64_MAX, &run) == CAROM_OK)
    carom_from_frame(&frame, &local, out);
}

static const carom_rules rules = {
    .flat = true,
    .one_mass = true,
    .contacts_slide = true,
    .abrupt_jaws = true,
    .simultaneous = 0.0,
    .euler_slip = CAROM_SLIP_POOLTOOL,
    .convention = CAROM_CONVENTION_POOLTOOL,
    .least_step = 0.001,
    .choose = choose,
    .touch_rail = touch_rail,
    .touch_jaw = carom_first_crossing,
    .touch_ball = touch_ball,
    .enter_pocket = carom_first_crossing,
    .resolve = resolve,
    .part_by_steps = part_by_steps,
};

const carom_rules *carom_rules_pooltool(void) {
  return &rules;
}
