/* A cluster with the derivatives of one direction, by its sources (cluster_text.h). follow.cpp
 * gives and takes them. */
extern "C" {
#include "tangent/follow_cluster.h"
}
#include "tangent/cluster_text.h"

namespace {

/* Whether a contact has no vertical friction, at most so much of its impulse, and a change brings
 * some about: upwards it presses one of the two balls on the cloth, downwards the other. */
bool is_level(const text::carom_cluster_contact_state &x, real most) {
  const number &level = x.rubbed[0], &up = x.rubbed[1];
  return __builtin_fabs(up.x) <= most * x.impulse.x &&
         __builtin_fabs(up.d[0]) >
             1e-9 * (__builtin_fabs(x.impulse.d[0]) + __builtin_fabs(level.d[0]));
}

row row_of(real d) {
  row r = {};
  r[0] = d;
  return r;
}

void tell(const number &from, real *x, real *rate) {
  *x = from.x;
  *rate = from.d[0];
}

/* The cue after a push, and the lead of its tip. */
void tell_tip(const text::carom_cluster_state &state, carom_tangent_cluster *c) {
  text::carom_next_tip next = {};
  if (state.tip.slides)
    next = text::carom_cluster_next_tip(&state);
  else
    next.travel = next.arm = text::carom_cluster_tip_lead(&state);
  tell(state.tip.V, &c->V, &c->V_rate);
  tell(next.travel, &c->lead, &c->lead_rate);
  tell(next.arm, &c->arm, &c->arm_rate);
  for (int k = 0; k < 3; k++)
    tell(next.moved[k], &c->moved[k], &c->moved_rate[k]);
}

/* What the model of the nose leaves of a motion, as in shot/clusters.c. */
bool model_of_nose(void *context, const text::carom_cluster_ball *ball, number v[3], number W[3]) {
  const carom_tangent_cluster *c = (const carom_tangent_cluster *)context;
  number from[CAROM_MOTION_NUMBERS];
  for (int k = 0; k < 3; k++) {
    from[k] = ball->r[k] + ball->s[k];
    from[3 + k] = ball->v[k];
    from[6 + k] = ball->W[k];
  }
  if (!ball->flies) {
    from[2] = ball->radius;
    from[5] = 0;
  }
  real x[CAROM_MOTION_NUMBERS], d[CAROM_MOTION_NUMBERS], out[6], rate[6];
  for (int k = 0; k < CAROM_MOTION_NUMBERS; k++)
    tell(from[k], &x[k], &d[k]);
  if (!c->model(c->context, x, d, out, rate))
    return false;
  for (int k = 0; k < 3; k++) {
    v[k] = ball->v[k] + (number(out[k], row_of(rate[k])) - from[3 + k]);
    W[k] = ball->W[k] + (number(out[3 + k], row_of(rate[3 + k])) - from[6 + k]);
  }
  return true;
}

/* The nose near the struck ball, and the slate below it. */
void put_nose(carom_tangent_cluster *c, text::carom_cluster_state *state) {
  text::carom_cluster_nose *nose = &state->nose;
  *nose = {};
  for (int k = 0; k < 3; k++)
    nose->normal[k] = number(c->normal[k], row_of(c->normal_rate[k]));
  nose->gap = nose->first_gap = number(c->gap, row_of(c->gap_rate));
  nose->model = model_of_nose;
  nose->context = c;
  if (c->in_nose)
    text::carom_cluster_put_in_nose(state);
}

/* How far apart the touches are, and in which order they occur. */
void tell_touches(const text::carom_cluster_state &state, carom_tangent_cluster *c) {
  static_assert((int)text::CAROM_CLUSTER_TOUCHES == (int)CAROM_TANGENT_TOUCHES,
                "there is room for each");
  const number separation = text::carom_cluster_separation(&state);
  c->separation = separation.x;
  c->separation_rate = separation.d[0];
  c->duration = state.duration.x;
  c->touches = state.struck ? 0 : state.touches;
  for (int k = 0; k < c->touches; k++) {
    const text::carom_cluster_contact_state &x = state.contact[state.touch[k].contact];
    c->touch[k][0] = x.i;
    c->touch[k][1] = x.j;
    const number impulse = text::carom_cluster_size_of_impulse(&x);
    c->impulse[k] = impulse.x;
    c->impulse_rate[k] = impulse.d[0];
  }
}

/* The position of the end mass in the numbers of a cue. */
enum { END_MASS = 6 };

} // namespace

bool carom_tangent_solve_cluster(carom_tangent_cluster *c, bool *kink) {
  text::carom_cluster_state state;
  text::carom_cluster_slate slates[CAROM_BALLS_MOST];
  number slate_e[CAROM_BALLS_MOST];
  state.slate = slates;
  state.balls = c->balls;
  state.struck = c->second < 0;
  state.on_slate = c->on_slate;
  state.nose_near = c->nose_near;
  state.steps = c->steps;
  state.slow = c->slow;

  /* the balls, their numbers with one derivative each */
  for (int k = 0; k < c->balls; k++) {
    text::carom_cluster_ball *ball = &state.ball[k];
    number *to = ball->r;
    static_assert(offsetof(text::carom_cluster_ball, flies) ==
                      CAROM_MEMBER_NUMBERS * sizeof(number),
                  "the numbers come first");
    real x[CAROM_MEMBER_NUMBERS + 1], d[CAROM_MEMBER_NUMBERS + 1];
    ball->flies = c->give(c->context, k, x, d);
    ball->index = (int8_t)k;
    ball->friction = (int8_t)c->friction;
    for (int n = 0; n < CAROM_MEMBER_NUMBERS; n++) {
      to[n].x = x[n];
      to[n].d[0] = d[n];
    }
    slate_e[k] = number(x[CAROM_MEMBER_NUMBERS], row_of(d[CAROM_MEMBER_NUMBERS]));
  }

  /* all of them must be members, as when the shot was played */
  int contacts;
  if (state.struck) {
    real x[CAROM_TIP_NUMBERS], d[CAROM_TIP_NUMBERS];
    number cue[CAROM_TIP_NUMBERS];
    c->give_cue(c->context, x, d);
    for (int n = 0; n < CAROM_TIP_NUMBERS; n++)
      cue[n] = number(x[n], row_of(d[n]));
    text::carom_cluster_tip_of(&state, c->first, cue, c->tip_time);
    state.tip.reach = number(c->reach, row_of(c->reach_rate));
    state.tip.slowest = number(c->slowest, row_of(c->slowest_rate));
    contacts = text::carom_cluster_members_of_tip(&state, 1e3);
    if (c->tip_friction > 0)
      text::carom_cluster_tip_slides(&state, cue[END_MASS], c->tip_friction,
                                     cue + CAROM_CUE_NUMBERS);
    if (c->on_slate)
      text::carom_cluster_put_on_slate(&state);
    for (int k = 0; c->on_slate && k < state.balls; k++)
      slates[k].restitution = state.ball[k].flies ? number(0) : slate_e[state.ball[k].index];
    if (c->on_slate && c->tip_friction > 0) {
      const text::carom_cluster_ball &struck = state.ball[state.tip.ball];
      text::carom_cluster_slate *slate = &slates[state.tip.ball];
      slate->restitution = slate_e[struck.index];
      slate->falls = text::carom_lesser(struck.v[2], 0);
      slate->overlap = text::carom_lesser(struck.radius - struck.r[2], 0);
    }
    if (c->nose_near)
      put_nose(c, &state);
  } else {
    contacts = text::carom_cluster_members(&state, c->first, c->second);
  }
  const bool alone = contacts == 0 && state.struck && !c->on_slate && !(c->tip_friction > 0);
  const bool all = contacts >= !state.struck && state.balls == c->balls;
  if (all && alone)
    text::carom_cluster_push_alone(&state);
  if (!all || (!alone && !text::carom_cluster_solve(&state)))
    return false;

  /* of the contact that starts it also where its spin is that of a slide of a millimetre */
  for (int k = 0; k < state.contacts; k++) {
    const text::carom_cluster_contact_state &x = state.contact[k];
    if (state.in_space && x.freedom.x >= 1)
      continue;
    const bool starts =
        (x.i == c->first && x.j == c->second) || (x.i == c->second && x.j == c->first);
    *kink |= is_level(x, starts ? 1e-4 : 1e-9) ||
             (!state.in_space && x.ball_i->radius.d[0] != x.ball_j->radius.d[0]);
  }

  /* their motion after it */
  tell_touches(state, c);
  for (int k = 0; k < c->balls; k++) {
    const text::carom_cluster_ball &ball = state.ball[k];
    real x[CAROM_MOTION_NUMBERS + 1], d[CAROM_MOTION_NUMBERS + 1];
    for (int n = 0; n < CAROM_MOTION_NUMBERS; n++) {
      const number *const of[] = {ball.v, ball.W, ball.shift};
      const number &from = of[n / 3][n % 3];
      x[n] = from.x;
      d[n] = from.d[0];
    }
    const number J = text::carom_cluster_slate_impulse(&state, k);
    x[CAROM_MOTION_NUMBERS] = J.x;
    d[CAROM_MOTION_NUMBERS] = J.d[0];
    c->take(c->context, k, x, d);
  }
  if (state.struck)
    tell_tip(state, c);
  return true;
}
