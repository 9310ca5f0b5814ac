/* Collisions of balls with each other and with cushions, by the model that the options ask for. */
#include "cushion/models.h"
#include "cluster/cluster.h"
#include "friction/laws.h"
#include "platform/ranges.h"
#include "schema/numbers.h"
#include "shot/rules.h"

#include <math.h>
#include <string.h>

/* Across the line of centres: along t = n x z, and up; the slip of the first ball's surface on
 * the second's. */
typedef struct contact_slip {
  double t[2], along, up;
} contact_slip;

static contact_slip slip_of(const double n[2], double R, const carom_ball_state *a,
                            const carom_ball_state *b) {
  contact_slip s = {.t = {n[1], -n[0]}};
  s.along = (a->v[0] - b->v[0]) * s.t[0] + (a->v[1] - b->v[1]) * s.t[1] - R * (a->w[2] + b->w[2]);
  s.up = R * ((a->w[0] + b->w[0]) * s.t[0] + (a->w[1] + b->w[1]) * s.t[1]);
  return s;
}

#define IN_ORDER(NAME, ...) \
  _Static_assert(CAROM_FRICTION_##NAME == (int)CAROM_LAW_##NAME, "rows stand by their values");
CAROM_FRICTION_LAWS(IN_ORDER)
#undef IN_ORDER

/* law_a, law_b and law_c, or Alciatore's where all are 0. */
static inline void carom_own_law(const carom_ball_kind *kind, double k[3]) {
  const bool has_law = kind->law_a + kind->law_b + kind->law_c > 0.0;
  const carom_speed_law law = has_law ? (carom_speed_law){0} : carom_alciatore();
  k[0] = law.a + kind->law_a;
  k[1] = law.b + kind->law_b;
  k[2] = law.c + kind->law_c;
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
  double p[3], q[3];
  carom_law_of_ball(law, sim->layout->kind[i], p);
  carom_law_of_ball(law, sim->layout->kind[j], q);
  const double pair[3] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])};
  return carom_friction_at((int)law, pair, slip);
}

/* Normal velocities by the restitution: w, the same for each unit of mass. */
static void exchange(double e, double m_a, double m_b, const double n[2], carom_ball_state *a,
                     carom_ball_state *b) {
  const double closing = (a->v[0] - b->v[0]) * n[0] + (a->v[1] - b->v[1]) * n[1];
  const double P = (1.0 + e) * closing / (1.0 / m_a + 1.0 / m_b);
  for (int k = 0; k < 2; k++) {
    a->v[k] -= P / m_a * n[k];
    b->v[k] += P / m_b * n[k];
  }
}

/* One closed-form impulse. Friction stops the slip, which takes -c/7 for each unit of mass, or
 * slides to the end with mu times the speed at which the balls part; the vertical velocities
 * that it gives are dropped. As pooltool's default, for equal masses. */
static void inelastic(const double n[2], double R, double e, double mu, const contact_slip *s,
                      carom_ball_state *a, carom_ball_state *b) {
  const double closing = (a->v[0] - b->v[0]) * n[0] + (a->v[1] - b->v[1]) * n[1];
  const double slip = sqrt(s->along * s->along + s->up * s->up), most = mu * e * fabs(closing);
  const double share = 7.0 * most >= slip ? 1.0 / 7.0 : most / slip;
  const double along = -share * s->along, up = -share * s->up;
  exchange(e, 1.0, 1.0, n, a, b);
  for (int k = 0; k < 2; k++) {
    a->v[k] += along * s->t[k];
    b->v[k] -= along * s->t[k];
    a->w[k] += 2.5 / R * up * s->t[k];
    b->w[k] += 2.5 / R * up * s->t[k];
  }
  a->w[2] -= 2.5 / R * along;
  b->w[2] -= 2.5 / R * along;
}

static carom_ball impact_ball(const carom_ball_kind *kind, const carom_ball_state *s) {
  return (carom_ball){.v = {s->v[0], s->v[1], s->v[2]},
                      .w = {s->w[0], s->w[1], s->w[2]},
                      .radius = kind->radius,
                      .mass = kind->mass,
                      .mu_slide = kind->mu_slide};
}

static void take_motion(const carom_motion *motion, carom_ball_state *s) {
  for (int k = 0; k < 3; k++) {
    s->v[k] = motion->v[k];
    s->w[k] = motion->w[k];
  }
}

void carom_line_of_centres(const carom_ball_kind *kind_a, const carom_ball_state *a,
                           const carom_ball_kind *kind_b, const carom_ball_state *b, double n[3]) {
  n[0] = b->r[0] - a->r[0];
  n[1] = b->r[1] - a->r[1];
  n[2] = (carom_flies(b) ? b->r[2] : kind_b->radius) - (carom_flies(a) ? a->r[2] : kind_a->radius);
  const double size = carom_space_size(n);
  for (int k = 0; k < 3; k++)
    n[k] /= size;
}

/* A ball on the cloth takes part in a contact whose line of centres n is level; n_z is dropped. The
 * radii are equal. */
static carom_status balls_on_cloth(const carom_sim *sim, const carom_due *pending_event,
                                   const double n[3], carom_ball_state *a, carom_ball_state *b) {
  const carom_ball_kind *kind_a = sim->layout->kind[pending_event->a],
                        *kind_b = sim->layout->kind[pending_event->b];
  const double R = kind_a->radius, e = 0.5 * (kind_a->restitution + kind_b->restitution);
  const carom_ball_model model = carom_ball_model_of(sim->opt);
  carom_result out;

  /* closed forms */
  if (model == CAROM_BALL_MODEL_MIRROR) {
    exchange(e, kind_a->mass, kind_b->mass, n, a, b);
    return CAROM_OK;
  }

  const contact_slip s = slip_of(n, R, a, b);
  const double mu =
      friction_of(sim, pending_event->a, pending_event->b, sqrt(s.along * s.along + s.up * s.up));
  if (model == CAROM_BALL_MODEL_INELASTIC) {
    inelastic(n, R, e, mu, &s, a, b);
    return CAROM_OK;
  }

  /* the 2014 model; the first ball is at the origin, since only the direction counts */
  carom_impact in = {
      .a = impact_ball(kind_a, a), .b = impact_ball(kind_b, b), .mu_ball = mu, .restitution = e};
  in.b.radius = R;
  in.b.r[0] = n[0];
  in.b.r[1] = n[1];
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

/* Spheres in space; without friction where the model has none. */
static void balls_in_space(const carom_sim *sim, const carom_due *pending_event, const double n[3],
                           carom_ball_state *a, carom_ball_state *b) {
  const carom_ball_kind *kind_a = sim->layout->kind[pending_event->a],
                        *kind_b = sim->layout->kind[pending_event->b];
  const double e = 0.5 * (kind_a->restitution + kind_b->restitution);
  carom_impact in = {.a = impact_ball(kind_a, a), .b = impact_ball(kind_b, b), .restitution = e};
  if (carom_ball_model_of(sim->opt) != CAROM_BALL_MODEL_MIRROR)
    in.mu_ball = friction_of(sim, pending_event->a, pending_event->b, carom_spheres_slip(&in, n));
  carom_result out;
  carom_spheres_collide(&in, n, &out);
  take_motion(&out.a, a);
  take_motion(&out.b, b);
}

/* Turns the plane of n and the level direction across it into that of the cloth: n to `level`, and
 * k, which is up across n, to z. Or back. */
static void turn_plane(const double source[2][3], const double target[2][3], double x[3]) {
  double along[2];
  for (int axis = 0; axis < 2; axis++)
    along[axis] = carom_space_dot(x, source[axis]);
  for (int k = 0; k < 3; k++)
    x[k] += along[0] * (target[0][k] - source[0][k]) + along[1] * (target[1][k] - source[1][k]);
}

/* Two balls as balls_on_cloth() has them, though n is tilted or the radii differ: all vectors are
 * turned until n is level, and R_b w_b is kept, as the law has R and w only as this product. The
 * velocities along k stay. */
static carom_status balls_on_tilted_cloth(const carom_sim *sim, const carom_due *pending_event,
                                          const double n[3], carom_ball_state *a,
                                          carom_ball_state *b) {
  const double size = carom_plane_size(n);
  const double level[3] = {n[0] / size, n[1] / size, 0.0};
  const double tilted[2][3] = {{n[0], n[1], n[2]}, {-level[0] * n[2], -level[1] * n[2], size}};
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
  for (int k = 0; k < 3; k++)
    b->w[k] *= ratio;

  const carom_status status = balls_on_cloth(sim, pending_event, level, a, b);

  for (int k = 0; k < 3; k++)
    b->w[k] /= ratio;
  for (int side = 0; side < 2; side++) {
    ball[side]->v[2] = rise[side];
    turn_plane(upright, tilted, ball[side]->v);
    turn_plane(upright, tilted, ball[side]->w);
  }
  return status;
}

static double height_above_cloth(const carom_ball_kind *kind, const carom_ball_state *s) {
  return carom_flies(s) ? s->r[2] - kind->radius : (double)0.0;
}

double carom_freedom_of_pair(const carom_sim *sim, const carom_due *pending_event,
                             const double n[3], const carom_ball_state *a,
                             const carom_ball_state *b) {
  const double height = carom_greater(height_above_cloth(sim->layout->kind[pending_event->a], a),
                                      height_above_cloth(sim->layout->kind[pending_event->b], b));
  return carom_freedom_of_balls(height, n[2]);
}

__attribute__((noinline)) carom_status carom_model_balls(const carom_sim *sim,
                                                         const carom_due *pending_event,
                                                         const double n[3], bool in_space,
                                                         carom_ball_state *a, carom_ball_state *b) {
  if (!in_space)
    return balls_on_cloth(sim, pending_event, n, a, b);

  /* how free of the cloth they are; without friction the cloth takes no part at all */
  const double freedom = carom_freedom_of_pair(sim, pending_event, n, a, b);
  carom_ball_state held[2] = {*a, *b}, *ball[2] = {a, b};
  balls_in_space(sim, pending_event, n, a, b);
  if (freedom >= 1.0 || carom_ball_model_of(sim->opt) == CAROM_BALL_MODEL_MIRROR)
    return CAROM_OK;

  const carom_status status = balls_on_tilted_cloth(sim, pending_event, n, &held[0], &held[1]);
  for (int side = 0; side < 2 && status >= 0; side++)
    for (int k = 0; k < 3; k++) {
      double *v = &ball[side]->v[k], *w = &ball[side]->w[k];
      *v = (1.0 - freedom) * held[side].v[k] + freedom * *v;
      *w = (1.0 - freedom) * held[side].w[k] + freedom * *w;
    }
  return status;
}

carom_nose carom_nose_of(const carom_sim *sim, const carom_due *pending_event,
                         const carom_ball_state *s) {
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
    carom_blend_jaw(table, pending_event->b, kind, s->r, &nose.mu_cushion, &nose.restitution);
  return nose;
}

#define AGREES(NAME, ...)                                                    \
  _Static_assert(CAROM_SHOT_CUSHION_##NAME == 1 + (int)CAROM_CUSHION_##NAME, \
                 "the models of a shot are those of an impact, behind the default");
CAROM_CUSHION_MODELS(AGREES)
#undef AGREES

/* Number by number, where they are read: each copy of the whole costs 1 % of a shot. */
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
                        const carom_nose *nose, carom_ball_state *s) {
  carom_cushion_options options;
  take_cushion_options(sim, kind, &options);
  const carom_touch touch = carom_touch_of(N, kind->radius, s);

  /* restitution and friction by the closing speed; of a ball on the cloth it is v_y cos(theta) */
  const double sine = carom_nose_height(kind, nose->height) / kind->radius - 1.0;
  carom_contact c = {.v_y = touch.closing / sqrt((1.0 - sine) * (1.0 + sine)),
                     .mu_w = nose->mu_cushion,
                     .e = nose->restitution};
  carom_apply_law(&c, &options);

  const double J_t = friction_in_flight(&c, touch.closing, touch.slip, &options);
  carom_take_impulse(&touch, kind->radius, (1.0 + c.e) * touch.closing, J_t, s);
}

/* A ball on the cloth, by the model asked for. */
static carom_status impact_on_cloth(const carom_sim *sim, const carom_ball_kind *kind,
                                    const double n[2], const carom_nose *nose,
                                    carom_ball_state *s) {
  const carom_cushion_impact in = {.v = {s->v[0], s->v[1], 0.0},
                                   .w = {s->w[0], s->w[1], s->w[2]},
                                   .normal = {n[0], n[1]},
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

  /* a shot goes on by the same model's steps where its limit is refused, as for a ball whose
   * rolling is exact but for rounding
   */
  if (status == CAROM_ERROR_UNRESOLVED && options.model == CAROM_CUSHION_MATHAVAN) {
    options.model = CAROM_CUSHION_EULER;
    status = carom_cushion_solve(&in, &options, &out);
  }
  if (status < 0)
    return status;
  take_motion(&out, s);
  s->v[2] = 0.0;
  return status;
}

/* NEAR THE CLOTH in resolve.c has the blend. */
carom_status carom_model_cushion(const carom_sim *sim, const carom_due *pending_event,
                                 const double n[3], carom_ball_state *s) {
  const carom_ball_kind *kind = sim->layout->kind[pending_event->a];
  const carom_nose nose = carom_nose_of(sim, pending_event, s);
  if (!carom_flies(s))
    return impact_on_cloth(sim, kind, n, &nose, s);
  const double chi = carom_freedom_of_height(s->r[2] - kind->radius);
  carom_ball_state flat = *s;
  free_impact(sim, kind, n, &nose, s);
  if (chi >= 1.0)
    return CAROM_OK;

  /* the flat model, along the horizontal part of n; a ball that does not move into the cushion
   * stays as it is */
  const double size = carom_plane_size(n), level[2] = {n[0] / size, n[1] / size};
  const double v_z = carom_lesser(flat.v[2], 0.0);
  const carom_status status = impact_on_cloth(sim, kind, level, &nose, &flat);
  flat.v[2] = v_z;
  for (int k = 0; k < 3; k++) {
    s->v[k] = (1.0 - chi) * flat.v[k] + chi * s->v[k];
    s->w[k] = (1.0 - chi) * flat.w[k] + chi * s->w[k];
  }
  return status;
}
