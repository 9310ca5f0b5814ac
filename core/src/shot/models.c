/* Collisions of balls with each other and with cushions, by the model that the options request. */
#include "cushion/models.h"
#include "cluster/cluster.h"
#include "friction/laws.h"
#include "platform/ranges.h"
#include "platform/sphere.h"
#include "schema/numbers.h"
#include "shot/rules.h"

#include <math.h>
#include <string.h>

/* Across the line of centres: along t = n x z, and up; the slip of the first ball's surface on
 * the second's. */
typedef struct contact_slip {
  double t[2], along, up;
} contact_slip;

static contact_slip slip_of(const double normal[2], double radius, const carom_ball_state *a,
                            const carom_ball_state *b) {
  contact_slip slip = {.t = {normal[1], -normal[0]}};
  slip.along = (a->v[0] - b->v[0]) * slip.t[0] + (a->v[1] - b->v[1]) * slip.t[1] -
               radius * (a->w[2] + b->w[2]);
  slip.up = radius * ((a->w[0] + b->w[0]) * slip.t[0] + (a->w[1] + b->w[1]) * slip.t[1]);
  return slip;
}

#define IN_ORDER(NAME, ...) \
  _Static_assert(CAROM_FRICTION_##NAME == (int)CAROM_LAW_##NAME, "rows stand by their values");
CAROM_FRICTION_LAWS(IN_ORDER)
#undef IN_ORDER

/* law_a, law_b and law_c, or Alciatore's where all are 0. */
static inline void carom_own_law(const carom_ball_kind *kind, double numbers[3]) {
  const bool has_law = kind->law_a + kind->law_b + kind->law_c > 0.0;
  const carom_speed_law law = has_law ? (carom_speed_law){0} : carom_alciatore();
  numbers[0] = law.a + kind->law_a;
  numbers[1] = law.b + kind->law_b;
  numbers[2] = law.c + kind->law_c;
}

void carom_law_of_ball(carom_ball_friction law, const carom_ball_kind *kind, double k[3]) {
  k[0] = k[1] = k[2] = 0.0;
  switch (law) {
#define CASE(NAME, name, pair, numbers, ...) \
  case CAROM_FRICTION_##NAME:                \
    numbers;                                 \
    break;
    CAROM_FRICTION_LAWS(CASE)
#undef CASE
  }
}

/* At a slip, m/s. */
static double friction_of(const carom_sim *sim, int i, int j, double slip) {
  const carom_ball_friction law = sim->opt->friction;
  double law_i[3], law_j[3];
  carom_law_of_ball(law, sim->layout->kind[i], law_i);
  carom_law_of_ball(law, sim->layout->kind[j], law_j);
  const double pair[3] = {0.5 * (law_i[0] + law_j[0]), 0.5 * (law_i[1] + law_j[1]),
                          0.5 * (law_i[2] + law_j[2])};
  return carom_friction_at((int)law, pair, slip);
}

/* Normal velocities by the restitution: w, the same for each unit of mass. */
static void exchange(double restitution, double m_a, double m_b, const double normal[2],
                     carom_ball_state *a, carom_ball_state *b) {
  const double closing = (a->v[0] - b->v[0]) * normal[0] + (a->v[1] - b->v[1]) * normal[1];
  const double impulse = (1.0 + restitution) * closing / (1.0 / m_a + 1.0 / m_b);
  for (int axis = 0; axis < 2; axis++) {
    a->v[axis] -= impulse / m_a * normal[axis];
    b->v[axis] += impulse / m_b * normal[axis];
  }
}

/* One closed-form impulse. Friction stops the slip, which takes -c/7 for each unit of mass, or
 * slides to the end with mu times the speed at which the balls part; the vertical velocities
 * that it gives are dropped. As pooltool's default, for equal masses. */
static void inelastic(const double normal[2], double radius, double restitution, double mu,
                      const contact_slip *sliding, carom_ball_state *a, carom_ball_state *b) {
  const double closing = (a->v[0] - b->v[0]) * normal[0] + (a->v[1] - b->v[1]) * normal[1];
  const double slip = sqrt(sliding->along * sliding->along + sliding->up * sliding->up),
               most = mu * restitution * fabs(closing);
  const double share = 7.0 * most >= slip ? 1.0 / 7.0 : most / slip;
  const double along = -share * sliding->along, up = -share * sliding->up;
  exchange(restitution, 1.0, 1.0, normal, a, b);
  for (int axis = 0; axis < 2; axis++) {
    a->v[axis] += along * sliding->t[axis];
    b->v[axis] -= along * sliding->t[axis];
    a->w[axis] += CAROM_SPHERE_TURN / radius * up * sliding->t[axis];
    b->w[axis] += CAROM_SPHERE_TURN / radius * up * sliding->t[axis];
  }
  a->w[2] -= CAROM_SPHERE_TURN / radius * along;
  b->w[2] -= CAROM_SPHERE_TURN / radius * along;
}

static carom_ball impact_ball(const carom_ball_kind *kind, const carom_ball_state *state) {
  return (carom_ball){.v = {state->v[0], state->v[1], state->v[2]},
                      .w = {state->w[0], state->w[1], state->w[2]},
                      .radius = kind->radius,
                      .mass = kind->mass,
                      .mu_slide = kind->mu_slide};
}

static void take_motion(const carom_motion *motion, carom_ball_state *state) {
  for (int axis = 0; axis < 3; axis++) {
    state->v[axis] = motion->v[axis];
    state->w[axis] = motion->w[axis];
  }
}

void carom_line_of_centres(const carom_ball_kind *kind_a, const carom_ball_state *a,
                           const carom_ball_kind *kind_b, const carom_ball_state *b,
                           double normal[3]) {
  normal[0] = b->r[0] - a->r[0];
  normal[1] = b->r[1] - a->r[1];
  normal[2] =
      (carom_flies(b) ? b->r[2] : kind_b->radius) - (carom_flies(a) ? a->r[2] : kind_a->radius);
  const double size = carom_space_size(normal);
  for (int axis = 0; axis < 3; axis++)
    normal[axis] /= size;
}

/* A ball on the cloth takes part in a contact whose line of centres n is level; n_z is dropped. The
 * radii are equal. */
static carom_status balls_on_cloth(const carom_sim *sim, const carom_due *pending_event,
                                   const double normal[3], carom_ball_state *a,
                                   carom_ball_state *b) {
  const carom_ball_kind *kind_a = sim->layout->kind[pending_event->a],
                        *kind_b = sim->layout->kind[pending_event->b];
  const double radius = kind_a->radius,
               restitution = 0.5 * (kind_a->restitution + kind_b->restitution);
  const carom_ball_model model = carom_ball_model_of(sim->opt);
  carom_result out;

  /* closed forms */
  if (model == CAROM_BALL_MODEL_MIRROR) {
    exchange(restitution, kind_a->mass, kind_b->mass, normal, a, b);
    return CAROM_OK;
  }

  const contact_slip sliding = slip_of(normal, radius, a, b);
  const double mu = friction_of(sim, pending_event->a, pending_event->b,
                                sqrt(sliding.along * sliding.along + sliding.up * sliding.up));
  if (model == CAROM_BALL_MODEL_INELASTIC) {
    inelastic(normal, radius, restitution, mu, &sliding, a, b);
    return CAROM_OK;
  }

  /* the 2014 model; the first ball is at the origin, since only the direction counts */
  carom_impact in = {.a = impact_ball(kind_a, a),
                     .b = impact_ball(kind_b, b),
                     .mu_ball = mu,
                     .restitution = restitution};
  in.b.radius = radius;
  in.b.r[0] = normal[0];
  in.b.r[1] = normal[1];
  const bool euler = model == CAROM_BALL_MODEL_EULER;
  const carom_options options = {.solver = euler ? CAROM_SOLVER_EULER : CAROM_SOLVER_EXACT,
                                 .slip = euler ? sim->rules->euler_slip : CAROM_SLIP_PAPER,
                                 .steps = sim->opt->steps};
  const carom_status status = carom_collide(&in, &options, &out);
  if (status == CAROM_SEPARATING && euler && sim->rules->part_by_steps != NULL)
    sim->rules->part_by_steps(&in, &options, &out);
  if (status >= 0) {
    take_motion(&out.a, a);
    take_motion(&out.b, b);
    a->v[2] = b->v[2] = 0.0;
  }
  return status;
}

/* Spheres in space; without friction if the model has no friction. */
static void balls_in_space(const carom_sim *sim, const carom_due *pending_event,
                           const double normal[3], carom_ball_state *a, carom_ball_state *b) {
  const carom_ball_kind *kind_a = sim->layout->kind[pending_event->a],
                        *kind_b = sim->layout->kind[pending_event->b];
  const double restitution = 0.5 * (kind_a->restitution + kind_b->restitution);
  carom_impact in = {
      .a = impact_ball(kind_a, a), .b = impact_ball(kind_b, b), .restitution = restitution};
  if (carom_ball_model_of(sim->opt) != CAROM_BALL_MODEL_MIRROR)
    in.mu_ball =
        friction_of(sim, pending_event->a, pending_event->b, carom_spheres_slip(&in, normal));
  carom_result out;
  carom_spheres_collide(&in, normal, &out);
  take_motion(&out.a, a);
  take_motion(&out.b, b);
}

/* Turns the plane of the normal n and the level direction across it into the plane of the cloth: n
 * to `level`, and k, which is up across n, to z. Or back. */
static void turn_plane(const double source[2][3], const double target[2][3], double vector[3]) {
  double along[2];
  for (int axis = 0; axis < 2; axis++)
    along[axis] = carom_space_dot(vector, source[axis]);
  for (int component = 0; component < 3; component++)
    vector[component] += along[0] * (target[0][component] - source[0][component]) +
                         along[1] * (target[1][component] - source[1][component]);
}

/* Two balls as balls_on_cloth() has them, though n is tilted or the radii differ: all vectors are
 * turned until n is level, and R_b w_b is kept, as the law has R and w only as this product. The
 * velocities along k stay. */
static carom_status balls_on_tilted_cloth(const carom_sim *sim, const carom_due *pending_event,
                                          const double normal[3], carom_ball_state *a,
                                          carom_ball_state *b) {
  const double size = carom_plane_size(normal);
  const double level[3] = {normal[0] / size, normal[1] / size, 0.0};
  const double tilted[2][3] = {{normal[0], normal[1], normal[2]},
                               {-level[0] * normal[2], -level[1] * normal[2], size}};
  const double upright[2][3] = {{level[0], level[1], 0.0}, {0.0, 0.0, 1.0}};
  const double ratio =
      sim->layout->kind[pending_event->b]->radius / sim->layout->kind[pending_event->a]->radius;
  carom_ball_state *ball[2] = {a, b};
  double rise[2];

  for (int side = 0; side < 2; side++) {
    turn_plane(tilted, upright, ball[side]->v);
    turn_plane(tilted, upright, ball[side]->w);
    rise[side] = ball[side]->v[2];
    ball[side]->v[2] = 0.0;
  }
  for (int axis = 0; axis < 3; axis++)
    b->w[axis] *= ratio;

  const carom_status status = balls_on_cloth(sim, pending_event, level, a, b);

  for (int axis = 0; axis < 3; axis++)
    b->w[axis] /= ratio;
  for (int side = 0; side < 2; side++) {
    ball[side]->v[2] = rise[side];
    turn_plane(upright, tilted, ball[side]->v);
    turn_plane(upright, tilted, ball[side]->w);
  }
  return status;
}

static double height_above_cloth(const carom_ball_kind *kind, const carom_ball_state *state) {
  return carom_flies(state) ? state->r[2] - kind->radius : 0.0;
}

double carom_freedom_of_pair(const carom_sim *sim, const carom_due *pending_event,
                             const double normal[3], const carom_ball_state *a,
                             const carom_ball_state *b) {
  const double height = carom_greater(height_above_cloth(sim->layout->kind[pending_event->a], a),
                                      height_above_cloth(sim->layout->kind[pending_event->b], b));
  return carom_freedom_of_balls(height, normal[2]);
}

__attribute__((noinline)) carom_status carom_model_balls(const carom_sim *sim,
                                                         const carom_due *pending_event,
                                                         const double normal[3], bool in_space,
                                                         carom_ball_state *a, carom_ball_state *b) {
  if (!in_space)
    return balls_on_cloth(sim, pending_event, normal, a, b);

  /* how free of the cloth they are; without friction the cloth takes no part at all */
  const double freedom = carom_freedom_of_pair(sim, pending_event, normal, a, b);
  carom_ball_state held[2] = {*a, *b}, *ball[2] = {a, b};
  balls_in_space(sim, pending_event, normal, a, b);
  if (freedom >= 1.0 || carom_ball_model_of(sim->opt) == CAROM_BALL_MODEL_MIRROR)
    return CAROM_OK;

  const carom_status status = balls_on_tilted_cloth(sim, pending_event, normal, &held[0], &held[1]);
  for (int side = 0; side < 2 && status >= 0; side++)
    for (int axis = 0; axis < 3; axis++) {
      double *velocity = &ball[side]->v[axis], *rotation = &ball[side]->w[axis];
      *velocity = (1.0 - freedom) * held[side].v[axis] + freedom * *velocity;
      *rotation = (1.0 - freedom) * held[side].w[axis] + freedom * *rotation;
    }
  return status;
}

carom_nose carom_nose_of(const carom_sim *sim, const carom_due *pending_event,
                         const carom_ball_state *state) {
  const carom_table *table = sim->table;
  const carom_ball_kind *kind = sim->layout->kind[pending_event->a];
  if (pending_event->type == CAROM_EVENT_RAIL) {
    const carom_rail *rail = &table->rail[pending_event->b];
    return (carom_nose){rail->height, 0.0, carom_or_usual(rail->mu_cushion, kind->mu_cushion),
                        carom_or_usual(rail->restitution, kind->restitution_cushion)};
  }
  const carom_jaw *jaw = &table->jaw[pending_event->b];
  carom_nose nose = {jaw->height, jaw->radius, carom_or_usual(jaw->mu_cushion, kind->mu_cushion),
                     carom_or_usual(jaw->restitution, kind->restitution_cushion)};
  if (!sim->rules->abrupt_jaws)
    carom_blend_jaw(table, pending_event->b, kind, state->r, &nose.mu_cushion, &nose.restitution);
  return nose;
}

#define AGREES(NAME, ...)                                                    \
  _Static_assert(CAROM_SHOT_CUSHION_##NAME == 1 + (int)CAROM_CUSHION_##NAME, \
                 "the models of a shot are those of an impact, behind the default");
CAROM_CUSHION_MODELS(AGREES)
#undef AGREES

/* Number by number, where they are read, because each copy of the complete struct takes 1 % of a
 * shot. */
static void take_cushion_options(const carom_sim *sim, const carom_ball_kind *kind,
                                 carom_cushion_options *options) {
  options->model = carom_cushion_model_of(sim->opt, kind);
  options->convention = sim->rules->convention;
  options->law = CAROM_CUSHION_LAW_CONSTANT;
  options->steps = sim->opt->steps;
  options->threads = 0;
  options->plain = !sim->opt->fast;
  options->least_step = sim->rules->least_step;
  options->reserved[0] = options->reserved[1] = 0;
#define COPY(member, ...) options->member = kind->member;
  CAROM_NUMBERS(CAROM_NO_ROW, COPY)
#undef COPY
}

/* Friction's impulse over the mass on a ball in flight. */
static double friction_in_flight(carom_contact *c, double v_n, double slip,
                                 const carom_cushion_options *opt) {
  switch (opt->model) {
#define CASE(NAME, name, impact, flight, rows, ...) \
  case CAROM_CUSHION_##NAME:                        \
    return flight;
    CAROM_CUSHION_MODELS(CASE)
#undef CASE
  }
  return 0.0;
}

/* A ball in flight, by the model without the cloth. */
static void free_impact(const carom_sim *sim, const carom_ball_kind *kind, const double N[3],
                        const carom_nose *nose, carom_ball_state *state) {
  carom_cushion_options options;
  take_cushion_options(sim, kind, &options);
  const carom_touch touch = carom_touch_of(N, kind->radius, state);

  /* restitution and friction by the closing speed; of a ball on the cloth it is v_y cos(theta) */
  const double sine = carom_nose_height(kind, nose->height) / kind->radius - 1.0;
  carom_contact c = {.v_y = touch.closing / sqrt((1.0 - sine) * (1.0 + sine)),
                     .mu_w = nose->mu_cushion,
                     .e = nose->restitution};
  carom_apply_law(&c, &options);

  const double J_t = friction_in_flight(&c, touch.closing, touch.slip, &options);
  carom_take_impulse(&touch, kind->radius, (1.0 + c.e) * touch.closing, J_t, state);
}

/* A ball on the cloth, by the model requested. */
static carom_status impact_on_cloth(const carom_sim *sim, const carom_ball_kind *kind,
                                    const double normal[2], const carom_nose *nose,
                                    carom_ball_state *state) {
  const carom_cushion_impact in = {.v = {state->v[0], state->v[1], 0.0},
                                   .w = {state->w[0], state->w[1], state->w[2]},
                                   .normal = {normal[0], normal[1]},
                                   .height = carom_nose_height(kind, nose->height),
                                   .radius = kind->radius,
                                   .mass = kind->mass,
                                   .mu_slide = kind->mu_slide,
                                   .mu_cushion = nose->mu_cushion,
                                   .restitution = nose->restitution,
                                   .jaw_radius = nose->jaw_radius};
  carom_cushion_options options;
  take_cushion_options(sim, kind, &options);
  carom_motion out;
  carom_status status = carom_cushion_solve(&in, &options, &out);

  /* a shot continues by the same model's steps where its limit is rejected, as for a ball whose
   * rolling is exact but for rounding
   */
  if (status == CAROM_ERROR_UNRESOLVED && options.model == CAROM_CUSHION_MATHAVAN) {
    options.model = CAROM_CUSHION_EULER;
    status = carom_cushion_solve(&in, &options, &out);
  }
  if (status < 0)
    return status;
  take_motion(&out, state);
  state->v[2] = 0.0;
  return status;
}

/* NEAR THE CLOTH in resolve.c has the blend. */
carom_status carom_model_cushion(const carom_sim *sim, const carom_due *pending_event,
                                 const double normal[3], carom_ball_state *state) {
  const carom_ball_kind *kind = sim->layout->kind[pending_event->a];
  const carom_nose nose = carom_nose_of(sim, pending_event, state);
  if (!carom_flies(state))
    return impact_on_cloth(sim, kind, normal, &nose, state);
  const double chi = carom_freedom_of_height(state->r[2] - kind->radius);
  carom_ball_state flat = *state;
  free_impact(sim, kind, normal, &nose, state);
  if (chi >= 1.0)
    return CAROM_OK;

  /* the flat model, along the horizontal part of n; a ball that does not move into the cushion does
   * not change */
  const double size = carom_plane_size(normal), level[2] = {normal[0] / size, normal[1] / size};
  const double v_z = carom_lesser(flat.v[2], 0.0);
  const carom_status status = impact_on_cloth(sim, kind, level, &nose, &flat);
  flat.v[2] = v_z;
  for (int axis = 0; axis < 3; axis++) {
    state->v[axis] = (1.0 - chi) * flat.v[axis] + chi * state->v[axis];
    state->w[axis] = (1.0 - chi) * flat.w[axis] + chi * state->w[axis];
  }
  return status;
}
