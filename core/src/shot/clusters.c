/* Contacts that last, core/src/cluster/, for the balls of a shot, and carom_cluster(). */
#include "shot/clusters.h"
#include "cluster/vectors.h"
#include "platform/promise.h"
#include "platform/sphere.h"
#include "shot/rules.h"

#include <math.h>
#include <string.h>

static const double neighborhood = 0.01; /* m; members.c looks closer */

/* The steps of a cluster in the duration of a contact, as requested or as usual. */
static double steps_of(const carom_shot_options *opt) {
  if (opt->cluster_steps > 0)
    return (double)opt->cluster_steps;
  return CAROM_CLUSTER_STEPS;
}

/* One of the balls of a cluster. On the cloth all centres are at the height of their radius. */
static carom_cluster_ball member_of(const carom_ball_kind *kind, const carom_ball_state *state,
                                    const carom_shot_options *opt, bool flies, int ball) {
  carom_cluster_ball member;
  memset(&member, 0, sizeof member);
  for (int axis = 0; axis < 3; axis++) {
    member.r[axis] = state->r[axis];
    member.v[axis] = state->v[axis];
    member.W[axis] = kind->radius * state->w[axis];
  }
  if (!flies) {
    member.r[2] = kind->radius;
    member.v[2] = 0.0;
  }

  /* what it is made of, where 0 means the usual value */
  member.flies = flies;
  member.index = (int8_t)ball;
  member.radius = kind->radius;
  member.inverse_mass = 1.0 / kind->mass;
  member.mu_slide = kind->mu_slide;
  member.restitution = kind->restitution;
  member.modulus = carom_or_usual(kind->modulus, CAROM_USUAL_MODULUS);
  member.friction = (int8_t)opt->friction;

  /* a mirror has no friction with others: all numbers of the law 0 */
  if (opt->ball_model != CAROM_BALL_MODEL_MIRROR)
    carom_law_of_ball(opt->friction, kind, member.law);
  return member;
}

static void motion_of(const carom_cluster_ball *ball, double v[3], double w[3]) {
  for (int axis = 0; axis < 3; axis++) {
    v[axis] = ball->v[axis];
    w[axis] = ball->W[axis] / ball->radius;
  }
}

/* The contacts that had an impulse, in the order in which they touched first; those that touch
 * at one time by their indices. Returns how many. */
static int in_order(const carom_cluster_state *cluster, uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  int count = 0;
  const double tie = CAROM_SIMULTANEOUS_TOUCHES * cluster->duration;
  CAROM_PROMISE(cluster->contacts <= CAROM_CLUSTER_CONTACTS);
  for (int index = 0; index < cluster->contacts; index++) {
    if (!(cluster->contact[index].impulse > 0.0))
      continue;
    /* put in its position from behind: before all that touch later by more than a tie */
    int place = count++;
    for (;
         place > 0 && cluster->contact[index].time < cluster->contact[order[place - 1]].time - tie;
         place--)
      order[place] = order[place - 1];
    order[place] = (uint8_t)index;
  }
  return count;
}

/* ---- In a shot */

bool carom_lasts(const carom_shot_options *opt) {
  const carom_ball_model model = carom_ball_model_of(opt);
  return opt->simultaneous == CAROM_SIMULTANEOUS_CLUSTER &&
         (model == CAROM_BALL_MODEL_EXACT || model == CAROM_BALL_MODEL_MIRROR);
}

bool carom_third_is_near(const carom_sim *sim, int i, int j) {
  const double reach = 2.0 * sim->features->radius + neighborhood, most = reach * reach;
  const double ti = sim->time - sim->start[i], tj = sim->time - sim->start[j];
  const double xi = sim->x[i] + ti * (sim->v_x[i] + ti * sim->a_x[i]),
               yi = sim->y[i] + ti * (sim->v_y[i] + ti * sim->a_y[i]);
  const double xj = sim->x[j] + tj * (sim->v_x[j] + tj * sim->a_x[j]),
               yj = sim->y[j] + tj * (sim->v_y[j] + tj * sim->a_y[j]);

  /* without branches, so that compilers turn the loop into vectors */
  int near_them = 0; /* i and j are near themselves */
  for (int index = 0; index < sim->count; index++) {
    const double elapsed = sim->time - sim->start[index];
    const double x = sim->x[index] + elapsed * (sim->v_x[index] + elapsed * sim->a_x[index]),
                 y = sim->y[index] + elapsed * (sim->v_y[index] + elapsed * sim->a_y[index]);
    const double to_i = (x - xi) * (x - xi) + (y - yi) * (y - yi),
                 to_j = (x - xj) * (x - xj) + (y - yj) * (y - yj);
    near_them += (to_i < most) | (to_j < most);
  }
  return near_them > 2;
}

/* ---- In turn
 *
 * Touches that do not overlap are successive events. Each has its contact by the model of two
 * balls, where their paths bring them together. A ball then starts now, from where and as fast as
 * its last path was, followed back to now; so friction with the cloth counts from the touch on. If
 * that would raise the energy, what friction and weight changed meanwhile is followed back by a
 * share. A ball that a touch presses on the slate lands at that instant, as it would in an event.
 *
 * With f the separation of a cluster (places.c), its balls get f times that result plus 1 - f times
 * the integrator's. So a cluster that falls into two leaves no jump. f is less where the impulses
 * of the two differ: touches that begin at one instant are not successive, and a small one of them
 * would become a large one if it went first. */

double carom_agreement_in_turn(double difference, double most) {
  static const double alike = 0.03, unlike = 0.1; /* of the largest impulse; conventions */
  const double apart = (difference - alike * most) / ((unlike - alike) * most);
  if (!(apart > 0.0))
    return 1.0;
  return apart < 1.0 ? (1.0 - apart) * (1.0 - apart) : 0.0;
}

/* A touch has left a ball at the slate moving into it. */
static void land_in_turn(const carom_ball_kind *kind, carom_ball_state *state) {
  if (!carom_flies(state) || state->v[2] >= 0.0 || state->r[2] > kind->radius)
    return;
  carom_hit_slate(kind, state);
  carom_label_after(true, kind, state);
}

void carom_touch_in_turn(const carom_sim *sim, const carom_due *pair, carom_ball_state *state_a,
                         carom_ball_state *state_b, double last, double since[2], double *impulse) {
  enum { ITERATIONS = 6 };
  carom_ball_state *const ball[2] = {state_a, state_b}, now[2];
  const carom_ball_kind *const kind[2] = {sim->layout->kind[pair->a], sim->layout->kind[pair->b]};
  carom_ball_rates rates[2];
  carom_path path[2];
  for (int side = 0; side < 2; side++) {
    rates[side] = carom_rates_of(kind[side]);
    path[side].from = *ball[side];
    carom_path_begin(&path[side], &rates[side], since[side]);
  }

  /* the time of the touch, by Newton's method */
  const double first = carom_greater(since[0], since[1]);
  double time = first, gap = 0.0, closing = 0.0, normal[3];
  for (int iteration = 0; iteration <= ITERATIONS; iteration++) {
    time = carom_greater(time + (iteration > 0 ? gap / closing : 0.0), first);
    for (int side = 0; side < 2; side++)
      carom_path_at(&path[side], &rates[side], time, &now[side]);
    carom_line_of_centres(kind[0], &now[0], kind[1], &now[1], normal);
    closing = carom_closing(&now[0], &now[1], normal);
    if (!(closing >= carom_slow_speed(sim->slow_instants)))
      return;
    double apart[3];
    cluster_minus(false, now[1].r, now[0].r, apart);
    gap = cluster_dot(false, apart, normal) - kind[0]->radius - kind[1]->radius;
  }

  const bool in_space =
      carom_flies(state_a) || carom_flies(state_b) || kind[0]->radius != kind[1]->radius;
  const carom_ball_state touching[2] = {now[0], now[1]};
  if (!(gap < CAROM_TOUCHING && time <= last) ||
      carom_model_balls(sim, pair, normal, in_space, &now[0], &now[1]) < 0)
    return;

  /* the motions after it, and the mean of both impulses, in each of which the cloth takes part */
  for (int side = 0; side < 2; side++) {
    double change[3];
    cluster_minus(false, now[side].v, touching[side].v, change);
    *impulse += 0.5 * kind[side]->mass * sqrt(cluster_dot(false, change, change));
    carom_label_after(in_space, kind[side], &now[side]);
    land_in_turn(kind[side], &now[side]);
    *ball[side] = now[side];
    since[side] = time;
  }
}

double carom_energy_in_turn(const carom_ball_kind *kind, const carom_ball_state *state) {
  const double spin = kind->radius * kind->radius * cluster_dot(false, state->w, state->w);
  return kind->mass * (0.5 * cluster_dot(false, state->v, state->v) + CAROM_SPHERE_ENERGY * spin +
                       carom_rates_of(kind).gravity * state->r[2]);
}

double carom_share_in_turn(double before, double touched, double started) {
  static const double rounding = 1e-12;
  const double most = (1.0 - rounding) * before;
  if (!(started > most))
    return 1.0;
  return touched < most ? (most - touched) / (started - touched) : 0.0;
}

void carom_start_in_turn(const carom_ball_kind *kind, double since, double share,
                         carom_ball_state *state) {
  const carom_ball_rates rates = carom_rates_of(kind);
  carom_ball_state later;
  carom_path path;
  path.from = *state;
  carom_path_begin(&path, &rates, 0.0);
  carom_path_at(&path, &rates, since, &later);
  for (int axis = 0; axis < 3; axis++) {
    const double change = share * since * path.a[axis]; /* a: half of the acceleration */
    state->r[axis] -= since * (state->v[axis] - change);
    state->v[axis] -= 2.0 * change;
    state->w[axis] += share * (state->w[axis] - later.w[axis]);
  }
  /* none starts from below the slate */
  if (carom_flies(state))
    state->r[2] = carom_greater(state->r[2], kind->radius);
}

/* The touches of a cluster, to be resolved successively. */
static void note_touches(const carom_cluster_state *cluster, carom_in_turn *turn) {
  turn->balls = cluster->balls;
  turn->touches = cluster->touches;
  turn->duration = cluster->duration;
  for (int index = 0; index < cluster->balls; index++)
    turn->ball[index].index = cluster->ball[index].index;
  for (int index = 0; index < cluster->touches; index++) {
    const carom_cluster_contact_state *contact = &cluster->contact[cluster->touch[index].contact];
    turn->touch[index] = (carom_in_turn_touch){0, contact->i, contact->j};
  }
}

void carom_take_in_turn(const carom_sim *sim, carom_in_turn *turn) {
  double since[CAROM_CLUSTER_IN_TURN], before = 0.0, touched = 0.0, started = 0.0;
  for (int index = 0; index < turn->balls; index++) {
    const int ball = turn->ball[index].index;
    carom_path_at(&sim->path[ball], &sim->rates[ball], sim->time, &turn->ball[index].state);
    before += carom_energy_in_turn(sim->layout->kind[ball], &turn->ball[index].state);
    since[index] = 0.0;
  }

  /* touch by touch, each ball at the time of its last one */
  for (int index = 0; index < turn->touches; index++) {
    carom_in_turn_touch *touch = &turn->touch[index];
    carom_in_turn_ball *ball_a = &turn->ball[touch->a], *ball_b = &turn->ball[touch->b];
    const carom_due pair = {sim->time, CAROM_EVENT_BALL_BALL, ball_a->index, ball_b->index};
    double times[2] = {since[touch->a], since[touch->b]}, impulse = 0.0;
    carom_touch_in_turn(sim, &pair, &ball_a->state, &ball_b->state, turn->duration, times,
                        &impulse);
    touch->impulse = (float)impulse;
    since[touch->a] = times[0];
    since[touch->b] = times[1];
  }

  /* followed back to now: all of the change, or the share that does not raise the energy */
  for (int index = 0; index < turn->balls; index++) {
    const carom_ball_kind *kind = sim->layout->kind[turn->ball[index].index];
    carom_ball_state state = turn->ball[index].state, slowed = state;
    carom_start_in_turn(kind, since[index], 0.0, &state);
    touched += carom_energy_in_turn(kind, &state);
    carom_start_in_turn(kind, since[index], 1.0, &slowed);
    started += carom_energy_in_turn(kind, &slowed);
  }
  const double share = carom_share_in_turn(before, touched, started);
  for (int index = 0; index < turn->balls; index++)
    carom_start_in_turn(sim->layout->kind[turn->ball[index].index], since[index], share,
                        &turn->ball[index].state);
  turn->known = true;
}

/* How far the successive touches agree with the integrator. */
static double agreement_of(const carom_in_turn *turn, const carom_cluster_state *cluster) {
  double impulse[CAROM_CLUSTER_CONTACTS] = {0.0}, most = 0.0, difference = 0.0;
  for (int index = 0; index < cluster->touches; index++)
    impulse[cluster->touch[index].contact] += (double)turn->touch[index].impulse;
  for (int index = 0; index < cluster->contacts; index++) {
    const double size = carom_cluster_size_of_impulse(&cluster->contact[index]);
    most = carom_greater(most, size);
    difference = carom_greater(difference, fabs(impulse[index] - size));
  }
  return carom_agreement_in_turn(difference, most);
}

/* Mixes the result of successive touches into balls and contacts, by this fraction. */
static void pass_on(const carom_sim *sim, const carom_in_turn *turn, double share,
                    carom_cluster_state *cluster) {
  double impulse[CAROM_CLUSTER_CONTACTS] = {0.0};
  for (int index = 0; index < cluster->balls; index++) {
    carom_cluster_ball *ball = &cluster->ball[index];
    const carom_ball_state *to = &turn->ball[index].state;
    carom_ball_state from;
    carom_path_at(&sim->path[ball->index], &sim->rates[ball->index], sim->time, &from);
    for (int axis = 0; axis < 3; axis++) {
      ball->v[axis] += share * (to->v[axis] - ball->v[axis]);
      ball->W[axis] += share * (ball->radius * to->w[axis] - ball->W[axis]);
      ball->shift[axis] += share * (to->r[axis] - from.r[axis] - ball->shift[axis]);
    }
  }
  carom_cluster_limit_shifts(cluster);
  for (int index = 0; index < cluster->touches; index++)
    impulse[cluster->touch[index].contact] += (double)turn->touch[index].impulse;
  for (int index = 0; index < cluster->contacts; index++) {
    carom_cluster_contact_state *contact = &cluster->contact[index];
    const double size = carom_cluster_size_of_impulse(contact);
    const double factor = size > 0.0 ? 1.0 + share * (impulse[index] - size) / size : 1.0;
    contact->impulse *= factor;
    contact->rubbed[0] *= factor;
    contact->rubbed[1] *= factor;
  }
}

int carom_cluster_now(carom_sim *sim, int i, int j, carom_in_turn *turn,
                      carom_cluster_state *cluster, uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  CAROM_PROMISE(i < j);

  /* all balls in play, as they are now; the two that meet, by their positions in the list */
  cluster->balls = 0;
  cluster->struck = cluster->on_slate = cluster->nose_near = false;
  cluster->steps = steps_of(sim->opt);
  cluster->slow = carom_slow_speed(sim->slow_instants);
  int first = 0, second = 0;
  for (int index = 0; index < sim->count; index++) {
    const carom_path *path = &sim->path[index];
    if (carom_is_out(path->from.label))
      continue;
    carom_ball_state current;
    carom_path_at(path, &sim->rates[index], sim->time, &current);
    if (index == i)
      first = cluster->balls;
    if (index == j)
      second = cluster->balls;
    cluster->ball[cluster->balls++] =
        member_of(sim->layout->kind[index], &current, sim->opt, carom_flies(&current), index);
  }

  /* those that the contact can reach; with none of them it is a contact like any other */
  const int size = carom_cluster_members(cluster, first, second);
  if (size == 0 || size == 1)
    return 0;

  /* too many contacts, or too many steps */
  if (size < 0 || !carom_cluster_solve(cluster))
    return -1;

  int count = in_order(cluster, order);
  const double share = count > 1 ? carom_cluster_separation(cluster) : 0.0;
  if (share > 0.0 && !turn->known) {
    note_touches(cluster, turn);
    return CAROM_TAKE_IN_TURN;
  }
  if (share > 0.0) {
    pass_on(sim, turn, share * agreement_of(turn, cluster), cluster);
    count = in_order(cluster, order);
  }

  /* the contact that is due goes first */
  for (int index = 1; index < count; index++) {
    const carom_cluster_contact_state *touching = &cluster->contact[order[index]];
    if (cluster->ball[touching->i].index != i || cluster->ball[touching->j].index != j)
      continue;
    const uint8_t contact = order[index];
    memmove(&order[1], &order[0], (size_t)index);
    order[0] = contact;
  }
  for (int index = 1; index < count; index++)
    CAROM_PROMISE(cluster->ball[cluster->contact[order[index]].i].index != i ||
                  cluster->ball[cluster->contact[order[index]].j].index != j);
  if (count == 1)
    return 0;
  return count;
}

bool carom_may_push(const carom_sim *sim, const carom_motion *alone) {
  const carom_cue *cue = sim->cue;
  const int struck = sim->struck;
  if (!sim->rules->clusters || cue->tip_time < 0.0 || !carom_lasts(sim->opt))
    return false;
  const double *velocity = alone->v, *centre = sim->path[struck].from.r;
  const double most = carom_tip_time(cue) * carom_space_size(velocity);
  for (int index = 0; index < sim->count; index++) {
    const double *partner = sim->path[index].from.r;
    const double d_x = partner[0] - centre[0], d_y = partner[1] - centre[1];
    const double reach = sim->rates[struck].radius + sim->rates[index].radius + most + neighborhood;
    if (index != struck && !carom_is_out(sim->path[index].from.label) &&
        d_x * d_x + d_y * d_y < reach * reach)
      return true;
  }
  return false;
}

/* The slate under the balls of a push. */
static void put_on_slate(const carom_sim *sim, carom_cluster_state *cluster) {
  carom_cluster_put_on_slate(cluster);
  for (int index = 0; index < cluster->balls; index++)
    if (!cluster->ball[index].flies)
      cluster->slate[index].restitution =
          carom_slate_under(sim->layout->kind[cluster->ball[index].index]);
}

/* The tip of a cue at ball[struck]. */
static void put_tip(const carom_cue_push *push, int struck, carom_cluster_state *cluster) {
  const carom_cue *cue = push->cue;
  const double numbers[8] = {cue->speed, cue->phi,  cue->theta,    cue->a,
                             cue->b,     cue->mass, cue->end_mass, cue->tip_restitution};
  carom_cluster_tip_of(cluster, struck, numbers, carom_tip_time(cue));
  cluster->tip.reach = cue->follow;
  cluster->tip.slowest = push->slowest;
  if (push->tip_place != NULL)
    carom_cluster_tip_slides(cluster, cue->end_mass, carom_tip_friction(cue), push->tip_place);
}

/* A ball as it is now, as one of a cluster. */
static carom_cluster_ball member_now(const carom_sim *sim, int index) {
  carom_ball_state current;
  carom_path_at(&sim->path[index], &sim->rates[index], sim->time, &current);
  return member_of(sim->layout->kind[index], &current, sim->opt, carom_flies(&current), index);
}

/* The struck ball may be above the slate as a further touch presses it down. */
static void put_low_slate(const carom_sim *sim, carom_cluster_state *cluster) {
  const int struck = cluster->tip.ball;
  const carom_cluster_ball *ball = &cluster->ball[struck];
  carom_cluster_slate *slate = &cluster->slate[struck];
  slate->restitution = carom_slate_under(sim->layout->kind[ball->index]);
  slate->falls = carom_lesser(ball->v[2], 0.0);
  slate->overlap = carom_lesser(ball->radius - ball->r[2], 0.0);
}

/* What the cushion leaves of the motion of the struck ball. On the cloth it has no vertical one. */
static bool model_of_nose(void *context, const carom_cluster_ball *ball, double v[3], double W[3]) {
  const carom_push_nose *nose = (const carom_push_nose *)context;
  carom_sim *sim = nose->sim;
  const int64_t slow_instants = sim->slow_instants;
  const double slow_last = sim->slow_last;
  carom_ball_state start;
  carom_path_at(&sim->path[ball->index], &sim->rates[ball->index], sim->time, &start);
  for (int axis = 0; axis < 3; axis++) {
    start.r[axis] += ball->s[axis];
    start.v[axis] = ball->v[axis];
    start.w[axis] = ball->W[axis] / ball->radius;
  }
  if (!ball->flies) {
    start.r[2] = ball->radius;
    start.v[2] = 0.0;
  }
  carom_ball_state end = start;
  const carom_status status = sim->rules->resolve(sim, &nose->event, &end, NULL);
  sim->slow_instants = slow_instants;
  sim->slow_last = slow_last;
  for (int axis = 0; axis < 3; axis++) {
    v[axis] = ball->v[axis] + (end.v[axis] - start.v[axis]);
    W[axis] = ball->W[axis] + ball->radius * (end.w[axis] - start.w[axis]);
  }
  return status >= 0;
}

/* The nose near the struck ball, or at it. */
static void put_nose(carom_push_nose *nose, carom_cluster_state *cluster) {
  memset(&cluster->nose, 0, sizeof cluster->nose);
  memcpy(cluster->nose.normal, nose->normal, sizeof nose->normal);
  cluster->nose.gap = cluster->nose.first_gap = nose->gap;
  cluster->nose.model = model_of_nose;
  cluster->nose.context = nose;
  if (nose->touches)
    carom_cluster_put_in_nose(cluster);
}

int carom_cluster_strike(carom_sim *sim, const carom_cue_push *push, carom_cluster_state *cluster,
                         uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  cluster->balls = 0;
  cluster->steps = steps_of(sim->opt);
  cluster->slow = carom_slow_speed(sim->slow_instants);
  cluster->struck = true;
  cluster->on_slate = false;
  cluster->nose_near = push->nose != NULL;
  int struck = 0;
  for (int index = 0; index < sim->count; index++) {
    if (carom_is_out(sim->path[index].from.label))
      continue;
    if (index == sim->struck)
      struck = cluster->balls;
    cluster->ball[cluster->balls++] = member_now(sim, index);
  }

  /* those that the ball can reach, and of a raised cue the slate */
  const bool again = push->tip_place != NULL;
  put_tip(push, struck, cluster);
  if (carom_cluster_members_of_tip(cluster, push->most) < 0)
    return -1;
  if (push->slate)
    put_on_slate(sim, cluster);
  if (push->slate && again)
    put_low_slate(sim, cluster);
  if (push->nose != NULL)
    put_nose(push->nose, cluster);
  if (push->nose != NULL && push->nose->touches && !carom_cluster_tip_comes(cluster))
    return 0;
  const bool alone = cluster->contacts == 0 && !push->slate && !again;
  if (!alone && !carom_cluster_solve(cluster))
    return -1;
  int count = 0;
  if (cluster->contacts > 0)
    count = in_order(cluster, order);

  /* none of the near balls was touched: the result is the same as for a single contact */
  if (count == 0 && !push->slate && !again) {
    struck = cluster->tip.ball;
    cluster->ball[struck] = member_now(sim, sim->struck);
    put_tip(push, struck, cluster);
    carom_cluster_push_alone(cluster);
  }
  return count;
}

void carom_cluster_rest(const carom_sim *sim, const carom_cluster_state *cluster, int index,
                        carom_ball_state *state) {
  const carom_ball_kind *kind = sim->layout->kind[cluster->ball[index].index];
  carom_cluster_take(&cluster->ball[index], state);
  if (cluster->on_slate)
    carom_leave_slate(kind, carom_cluster_slate_impulse(cluster, index) / kind->mass, state);
}

void carom_cluster_take(const carom_cluster_ball *ball, carom_ball_state *state) {
  motion_of(ball, state->v, state->w);
  for (int axis = 0; axis < 3; axis++)
    state->r[axis] += ball->shift[axis];
}

/* ---- The public entry */

static carom_cluster_contact contact_of(const carom_cluster_state *cluster,
                                        const carom_cluster_contact_state *contact) {
  carom_cluster_contact out = {cluster->ball[contact->i].index,
                               cluster->ball[contact->j].index,
                               contact->time,
                               contact->impulse,
                               {contact->n[0], contact->n[1], contact->n[2]},
                               {0.0}};
  double tangent[3], third[3];
  cluster_across(!cluster->in_space, contact->n, tangent, third);
  for (int axis = 0; axis < 3; axis++)
    out.friction[axis] = contact->rubbed[0] * tangent[axis] + contact->rubbed[1] * third[axis];
  return out;
}

/* The balls that are left, as a cluster of which the members are not known yet. */
static void gather(const carom_shot_ball *balls, int count, const carom_shot_options *opt,
                   const bool done[], carom_cluster_state *cluster) {
  cluster->balls = 0;
  cluster->struck = cluster->on_slate = cluster->nose_near = false;
  cluster->steps = steps_of(opt);
  cluster->slow = carom_slow_speed(0);
  for (int index = 0; index < count; index++) {
    if (done[index])
      continue;
    const carom_ball_kind *kind = &balls[index].kind;
    const bool flies =
        opt->space != CAROM_SPACE_FLAT && carom_flies_in_layout(&balls[index].state, kind->radius);
    cluster->ball[cluster->balls++] = member_of(kind, &balls[index].state, opt, flies, index);
  }
}

static carom_status check(const carom_shot_ball *balls, int count, const carom_shot_options *opt) {
  const carom_status checked = carom_check_shot_options(opt);
  if (checked != CAROM_OK)
    return checked;
  const bool solves =
      opt->ball_model <= CAROM_BALL_MODEL_EXACT || opt->ball_model == CAROM_BALL_MODEL_MIRROR;
  if (opt->world != CAROM_WORLD_CAROM)
    return CAROM_ERROR_WORLD;
  if (!solves)
    return CAROM_ERROR_BALL_MODEL;
  for (int index = 0; index < count; index++) {
    const carom_status status = carom_check_ball(&balls[index], opt->space == CAROM_SPACE_FLAT);
    if (status != CAROM_OK)
      return status;
    if (opt->space == CAROM_SPACE_FLAT && balls[index].kind.radius != balls[0].kind.radius)
      return CAROM_ERROR_RADII_DIFFER;
    for (int earlier = 0; earlier < index; earlier++)
      if (memcmp(balls[earlier].state.r, balls[index].state.r, sizeof balls[earlier].state.r) ==
              0 &&
          !carom_is_out(balls[earlier].state.label))
        return CAROM_ERROR_COINCIDENT;
  }
  return CAROM_OK;
}

/* Cluster by cluster, the fastest contact first; balls far from each other are in separate
 * clusters. */
static carom_status solve(const carom_shot_ball *balls, int count, const carom_shot_options *opt,
                          carom_motion *out, carom_cluster_contact *contacts, int room,
                          int *found) {
  carom_cluster_state cluster;
  bool done[CAROM_CLUSTER_BALLS];

  /* balls keep their motion that are in no cluster */
  for (int index = 0; index < count; index++) {
    done[index] = carom_is_out(balls[index].state.label);
    memcpy(out[index].v, balls[index].state.v, sizeof out[index].v);
    memcpy(out[index].w, balls[index].state.w, sizeof out[index].w);
  }

  for (;;) {
    /* the fastest contact of the balls that are left, with all that it can reach */
    gather(balls, count, opt, done, &cluster);
    const int size = carom_cluster_members(&cluster, -1, -1);
    if (size == 0)
      return carom_ok_if(*found > 0, CAROM_SEPARATING);
    if (size < 0 || !carom_cluster_solve(&cluster))
      return CAROM_ERROR_UNRESOLVED;

    /* its balls are done, */
    for (int index = 0; index < cluster.balls; index++) {
      const int ball = cluster.ball[index].index;
      done[ball] = true;
      motion_of(&cluster.ball[index], out[ball].v, out[ball].w);
      if (!carom_is_finite(out[ball].v) || !carom_is_finite(out[ball].w))
        return CAROM_ERROR_OVERFLOW;
    }

    /* and its contacts are reported */
    uint8_t order[CAROM_CLUSTER_CONTACTS];
    const int touched = in_order(&cluster, order);
    for (int index = 0; index < touched; index++, ++*found)
      if (*found < room)
        contacts[*found] = contact_of(&cluster, &cluster.contact[order[index]]);
  }
}

carom_status carom_cluster(const carom_shot_ball *balls, int count, const carom_shot_options *opt,
                           carom_motion *out, carom_cluster_contact *contacts, int room,
                           int *contacts_count) {
  int found = 0;
  if (balls == NULL || out == NULL || (contacts == NULL && room != 0) || room < 0)
    return CAROM_ERROR_NULL;
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  opt = carom_options_or_usual(opt);
  carom_status status = check(balls, count, opt);
  if (status == CAROM_OK)
    status = solve(balls, count, opt, out, contacts, room, &found);
  for (int index = 0; index < count && status < 0; index++)
    out[index] = (carom_motion){{NAN, NAN, NAN}, {NAN, NAN, NAN}};
  if (contacts_count != NULL)
    *contacts_count = found * (status >= 0);
  return status;
}
