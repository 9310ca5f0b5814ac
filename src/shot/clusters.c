/* Contacts that last, src/cluster/, for the balls of a shot, and carom_cluster(). */
#include "shot/clusters.h"
#include "cluster/vectors.h"
#include "platform/promise.h"
#include "shot/rules.h"

#include <math.h>
#include <string.h>

static const double neighborhood = 0.01; /* m; members.c looks closer */
static const double simultaneous = 1e-9; /* of a contact's duration: touches that are nearer in
                                            time count as one */

/* The steps of a cluster in the duration of a contact, as asked or as usual. */
static double steps_of(const carom_shot_options *opt) {
  if (opt->cluster_steps > 0)
    return (double)opt->cluster_steps;
  return CAROM_CLUSTER_STEPS;
}

/* One of the balls of a cluster. On the cloth all centres are at the height of their radius. */
static carom_cluster_ball member_of(const carom_ball_kind *kind, const carom_ball_state *s,
                                    const carom_shot_options *opt, bool flies, int ball) {
  carom_cluster_ball b;
  memset(&b, 0, sizeof b);
  for (int k = 0; k < 3; k++) {
    b.r[k] = s->r[k];
    b.v[k] = s->v[k];
    b.W[k] = kind->radius * s->w[k];
  }
  if (!flies) {
    b.r[2] = kind->radius;
    b.v[2] = 0.0;
  }

  /* what it is made of, where 0 stands for usual */
  b.flies = flies;
  b.index = (int8_t)ball;
  b.radius = kind->radius;
  b.inverse_mass = 1.0 / kind->mass;
  b.mu_slide = kind->mu_slide;
  b.restitution = kind->restitution;
  b.modulus = carom_or_usual(kind->modulus, CAROM_USUAL_MODULUS);
  b.friction = (int8_t)opt->friction;

  /* a mirror has no friction with others: all numbers of the law 0 */
  if (opt->ball_model != CAROM_BALL_MODEL_MIRROR)
    carom_law_of_ball(opt->friction, kind, b.law);
  return b;
}

static void motion_of(const carom_cluster_ball *b, double v[3], double w[3]) {
  for (int k = 0; k < 3; k++) {
    v[k] = b->v[k];
    w[k] = b->W[k] / b->radius;
  }
}

/* The contacts that had an impulse, in the order in which they touched first; those that touch
 * at one time by their indices. Returns how many. */
static int in_order(const carom_cluster_state *c, uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  int count = 0;
  const double tie = simultaneous * c->duration;
  CAROM_PROMISE(c->contacts <= CAROM_CLUSTER_CONTACTS);
  for (int k = 0; k < c->contacts; k++) {
    if (!(c->contact[k].impulse > 0.0))
      continue;
    /* put in its place from behind: before all that touch later by more than a tie */
    int place = count++;
    for (; place > 0 && c->contact[k].time < c->contact[order[place - 1]].time - tie; place--)
      order[place] = order[place - 1];
    order[place] = (uint8_t)k;
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
  int near_them = 0; /* i and j are near themselves */
  for (int k = 0; k < sim->count; k++) {
    const double t = sim->time - sim->start[k];
    const double x = sim->x[k] + t * (sim->v_x[k] + t * sim->a_x[k]),
                 y = sim->y[k] + t * (sim->v_y[k] + t * sim->a_y[k]);
    const double to_i = (x - xi) * (x - xi) + (y - yi) * (y - yi),
                 to_j = (x - xj) * (x - xj) + (y - yj) * (y - yj);
    near_them += (to_i < most) | (to_j < most);
  }
  return near_them > 2;
}

/* ---- In turn
 *
 * Touches that do not overlap are what events in turn are. Each has its contact by the model of two
 * balls, where their paths bring them together. A ball then starts now, from where and as fast as
 * its last path was, followed back to now; so friction with the cloth counts from the touch on. If
 * that would raise the energy, speeds are followed back by a share. With f the separation of a
 * cluster (places.c), its balls get f of that and 1 - f of what the integrator has. So a cluster
 * that falls into two leaves no jump. */

void carom_touch_in_turn(const carom_sim *sim, const carom_due *pair, carom_ball_state *a,
                         carom_ball_state *b, double last, double since[2], double *impulse) {
  enum { ITERATIONS = 6 };
  carom_ball_state *const ball[2] = {a, b}, now[2];
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
  double time = first, gap = 0.0, closing = 0.0, n[3];
  for (int k = 0; k <= ITERATIONS; k++) {
    time = carom_greater(time + (k > 0 ? gap / closing : (double)0.0), first);
    for (int side = 0; side < 2; side++)
      carom_path_at(&path[side], &rates[side], time, &now[side]);
    carom_line_of_centres(kind[0], &now[0], kind[1], &now[1], n);
    closing = carom_closing(&now[0], &now[1], n);
    if (!(closing >= carom_slow_speed(sim->slow_instants)))
      return;
    double d[3];
    cluster_minus(false, now[1].r, now[0].r, d);
    gap = cluster_dot(false, d, n) - kind[0]->radius - kind[1]->radius;
  }

  const bool in_space = carom_flies(a) || carom_flies(b) || kind[0]->radius != kind[1]->radius;
  const double v[3] = {now[0].v[0], now[0].v[1], now[0].v[2]};
  if (!(gap < CAROM_TOUCHING && time <= last) ||
      carom_model_balls(sim, pair, n, in_space, &now[0], &now[1]) < 0)
    return;
  double change[3];
  cluster_minus(false, now[0].v, v, change);
  *impulse += kind[0]->mass * sqrt(cluster_dot(false, change, change));
  for (int side = 0; side < 2; side++) {
    carom_label_after(in_space, kind[side], &now[side]);
    *ball[side] = now[side];
    since[side] = time;
  }
}

double carom_energy_in_turn(const carom_ball_kind *kind, const carom_ball_state *s) {
  const double spin = kind->radius * kind->radius * cluster_dot(false, s->w, s->w);
  return kind->mass * (0.5 * cluster_dot(false, s->v, s->v) + 0.2 * spin +
                       carom_rates_of(kind).gravity * s->r[2]);
}

double carom_share_in_turn(double before, double touched, double started) {
  static const double rounding = 1e-12;
  const double most = (1.0 - rounding) * before;
  if (!(started > most))
    return 1.0;
  return touched < most ? (most - touched) / (started - touched) : (double)0.0;
}

void carom_start_in_turn(const carom_ball_kind *kind, double since, double share,
                         carom_ball_state *s) {
  const carom_ball_rates rates = carom_rates_of(kind);
  carom_ball_state later;
  carom_path path;
  path.from = *s;
  carom_path_begin(&path, &rates, 0.0);
  carom_path_at(&path, &rates, since, &later);
  for (int k = 0; k < 3; k++) {
    s->r[k] = later.r[k] - 2.0 * since * s->v[k];
    s->v[k] += share * (s->v[k] - later.v[k]);
    s->w[k] += share * (s->w[k] - later.w[k]);
  }
}

/* The touches of a cluster, to be taken in turn. */
static void note_touches(const carom_cluster_state *c, carom_in_turn *turn) {
  turn->balls = c->balls;
  turn->touches = c->touches;
  turn->duration = c->duration;
  for (int k = 0; k < c->balls; k++)
    turn->ball[k].index = c->ball[k].index;
  for (int k = 0; k < c->touches; k++) {
    const carom_cluster_contact_state *x = &c->contact[c->touch[k].contact];
    turn->touch[k] = (carom_in_turn_touch){0, x->i, x->j};
  }
}

void carom_take_in_turn(const carom_sim *sim, carom_in_turn *turn) {
  double since[CAROM_CLUSTER_IN_TURN], before = 0.0, touched = 0.0, started = 0.0;
  for (int k = 0; k < turn->balls; k++) {
    const int i = turn->ball[k].index;
    carom_path_at(&sim->path[i], &sim->rates[i], sim->time, &turn->ball[k].state);
    before += carom_energy_in_turn(sim->layout->kind[i], &turn->ball[k].state);
    since[k] = 0.0;
  }
  for (int k = 0; k < turn->touches; k++) {
    carom_in_turn_touch *touch = &turn->touch[k];
    carom_in_turn_ball *a = &turn->ball[touch->a], *b = &turn->ball[touch->b];
    const carom_due pair = {sim->time, CAROM_EVENT_BALL_BALL, a->index, b->index};
    double times[2] = {since[touch->a], since[touch->b]}, impulse = 0.0;
    carom_touch_in_turn(sim, &pair, &a->state, &b->state, turn->duration, times, &impulse);
    touch->impulse = (float)impulse;
    since[touch->a] = times[0];
    since[touch->b] = times[1];
  }
  for (int k = 0; k < turn->balls; k++) {
    const carom_ball_kind *kind = sim->layout->kind[turn->ball[k].index];
    carom_ball_state s = turn->ball[k].state;
    touched += carom_energy_in_turn(kind, &s);
    carom_start_in_turn(kind, since[k], 1.0, &s);
    started += carom_energy_in_turn(kind, &s);
  }
  const double share = carom_share_in_turn(before, touched, started);
  for (int k = 0; k < turn->balls; k++)
    carom_start_in_turn(sim->layout->kind[turn->ball[k].index], since[k], share,
                        &turn->ball[k].state);
  turn->known = true;
}

/* Gives balls and contacts so much of what touches in turn have. */
static void pass_on(const carom_sim *sim, const carom_in_turn *turn, double share,
                    carom_cluster_state *c) {
  double impulse[CAROM_CLUSTER_CONTACTS] = {0.0};
  for (int k = 0; k < c->balls; k++) {
    carom_cluster_ball *p = &c->ball[k];
    const carom_ball_state *to = &turn->ball[k].state;
    carom_ball_state from;
    carom_path_at(&sim->path[p->index], &sim->rates[p->index], sim->time, &from);
    for (int axis = 0; axis < 3; axis++) {
      p->v[axis] += share * (to->v[axis] - p->v[axis]);
      p->W[axis] += share * (p->radius * to->w[axis] - p->W[axis]);
      p->shift[axis] += share * (to->r[axis] - from.r[axis] - p->shift[axis]);
    }
  }
  for (int k = 0; k < c->touches; k++)
    impulse[c->touch[k].contact] += (double)turn->touch[k].impulse;
  for (int k = 0; k < c->contacts; k++) {
    carom_cluster_contact_state *x = &c->contact[k];
    const double size = carom_cluster_size_of_impulse(x);
    const double factor = size > 0.0 ? 1.0 + share * (impulse[k] - size) / size : (double)1.0;
    x->impulse *= factor;
    x->rubbed[0] *= factor;
    x->rubbed[1] *= factor;
  }
}

int carom_cluster_now(carom_sim *sim, int i, int j, carom_in_turn *turn, carom_cluster_state *c,
                      uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  CAROM_PROMISE(i < j);

  /* all balls in play, as they are now; the two that meet, by their places in the list */
  c->balls = 0;
  c->struck = c->on_slate = false;
  c->steps = steps_of(sim->opt);
  c->slow = carom_slow_speed(sim->slow_instants);
  int first = 0, second = 0;
  for (int k = 0; k < sim->count; k++) {
    const carom_path *path = &sim->path[k];
    if (carom_is_out(path->from.label))
      continue;
    carom_ball_state current;
    carom_path_at(path, &sim->rates[k], sim->time, &current);
    if (k == i)
      first = c->balls;
    if (k == j)
      second = c->balls;
    c->ball[c->balls++] =
        member_of(sim->layout->kind[k], &current, sim->opt, carom_flies(&current), k);
  }

  /* those that the contact can reach; with none of them it is a contact like any other */
  const int size = carom_cluster_members(c, first, second);
  if (size == 0 || size == 1)
    return 0;

  /* too many contacts, or too many steps */
  if (size < 0 || !carom_cluster_solve(c))
    return -1;

  int count = in_order(c, order);
  const double share = count > 1 ? carom_cluster_separation(c) : (double)0.0;
  if (share > 0.0 && !turn->known) {
    note_touches(c, turn);
    return CAROM_TAKE_IN_TURN;
  }
  if (share > 0.0) {
    pass_on(sim, turn, share, c);
    count = in_order(c, order);
  }

  /* the contact that is due goes first */
  for (int k = 1; k < count; k++) {
    const carom_cluster_contact_state *x = &c->contact[order[k]];
    if (c->ball[x->i].index != i || c->ball[x->j].index != j)
      continue;
    const uint8_t contact = order[k];
    memmove(&order[1], &order[0], (size_t)k);
    order[0] = contact;
  }
  for (int k = 1; k < count; k++)
    CAROM_PROMISE(c->ball[c->contact[order[k]].i].index != i ||
                  c->ball[c->contact[order[k]].j].index != j);
  if (count == 1)
    return 0;
  return count;
}

bool carom_may_push(const carom_sim *sim, const carom_motion *alone) {
  const carom_cue *cue = sim->cue;
  const int i = sim->struck;
  if (!sim->rules->clusters || cue->tip_time < 0.0 || !carom_lasts(sim->opt))
    return false;
  const double *v = alone->v, *r = sim->path[i].from.r;
  const double most = carom_tip_time(cue) * carom_space_size(v);
  for (int k = 0; k < sim->count; k++) {
    const double *q = sim->path[k].from.r;
    const double x = q[0] - r[0], y = q[1] - r[1];
    const double reach = sim->rates[i].radius + sim->rates[k].radius + most + neighborhood;
    if (k != i && !carom_is_out(sim->path[k].from.label) && x * x + y * y < reach * reach)
      return true;
  }
  return false;
}

/* The slate under the balls of a push. */
static void put_on_slate(const carom_sim *sim, carom_cluster_state *c) {
  carom_cluster_put_on_slate(c);
  for (int k = 0; k < c->balls; k++)
    if (!c->ball[k].flies)
      c->slate[k].restitution = carom_slate_under(sim->layout->kind[c->ball[k].index]);
}

/* The tip of a cue at ball[struck]. */
static void put_tip(const carom_cue *cue, int struck, bool again, carom_cluster_state *c) {
  const double numbers[8] = {cue->speed, cue->phi,  cue->theta,    cue->a,
                             cue->b,     cue->mass, cue->end_mass, cue->tip_restitution};
  carom_cluster_tip_of(c, struck, numbers, carom_tip_time(cue));
  c->tip.reach = cue->follow;
  if (again)
    carom_cluster_tip_slides(c, numbers, carom_tip_friction(cue));
}

/* A ball as it is now, as one of a cluster. */
static carom_cluster_ball member_now(const carom_sim *sim, int k) {
  carom_ball_state current;
  carom_path_at(&sim->path[k], &sim->rates[k], sim->time, &current);
  return member_of(sim->layout->kind[k], &current, sim->opt, carom_flies(&current), k);
}

int carom_cluster_strike(carom_sim *sim, const carom_cue *cue, double most, bool slate,
                         carom_cluster_state *c, uint8_t order[CAROM_CLUSTER_CONTACTS]) {
  c->balls = 0;
  c->steps = steps_of(sim->opt);
  c->slow = carom_slow_speed(sim->slow_instants);
  c->struck = true;
  c->on_slate = false;
  int struck = 0;
  for (int k = 0; k < sim->count; k++) {
    if (carom_is_out(sim->path[k].from.label))
      continue;
    if (k == sim->struck)
      struck = c->balls;
    c->ball[c->balls++] = member_now(sim, k);
  }

  /* those that the ball can reach, and of a raised cue the slate */
  const bool again = sim->shot->count > 0;
  put_tip(cue, struck, again, c);
  if (carom_cluster_members_of_tip(c, most) < 0)
    return -1;
  if (slate)
    put_on_slate(sim, c);
  const bool alone = c->contacts == 0 && !slate && !again;
  if (!alone && !carom_cluster_solve(c))
    return -1;
  int count = 0;
  if (c->contacts > 0)
    count = in_order(c, order);

  /* none of those near was touched: all is as if it were alone */
  if (count == 0 && !slate && !again) {
    struck = c->tip.ball;
    c->ball[struck] = member_now(sim, sim->struck);
    put_tip(cue, struck, again, c);
    carom_cluster_push_alone(c);
  }
  return count;
}

void carom_cluster_rest(const carom_sim *sim, const carom_cluster_state *c, int k,
                        carom_ball_state *s) {
  const carom_ball_kind *kind = sim->layout->kind[c->ball[k].index];
  carom_cluster_take(&c->ball[k], s);
  if (c->on_slate)
    carom_leave_slate(kind, carom_cluster_slate_impulse(c, k) / kind->mass, s);
}

void carom_cluster_take(const carom_cluster_ball *b, carom_ball_state *s) {
  motion_of(b, s->v, s->w);
  for (int k = 0; k < 3; k++)
    s->r[k] += b->shift[k];
}

/* ---- The public entry */

static carom_cluster_contact contact_of(const carom_cluster_state *c,
                                        const carom_cluster_contact_state *x) {
  carom_cluster_contact out = {c->ball[x->i].index, c->ball[x->j].index,         x->time,
                               x->impulse,          {x->n[0], x->n[1], x->n[2]}, {0.0}};
  double t[3], third[3];
  cluster_across(!c->in_space, x->n, t, third);
  for (int k = 0; k < 3; k++)
    out.friction[k] = x->rubbed[0] * t[k] + x->rubbed[1] * third[k];
  return out;
}

/* The balls that are left, as a cluster of which the members are not known yet. */
static void gather(const carom_shot_ball *balls, int count, const carom_shot_options *opt,
                   const bool done[], carom_cluster_state *c) {
  c->balls = 0;
  c->struck = c->on_slate = false;
  c->steps = steps_of(opt);
  c->slow = carom_slow_speed(0);
  for (int k = 0; k < count; k++) {
    if (done[k])
      continue;
    const carom_ball_kind *kind = &balls[k].kind;
    const bool flies =
        opt->space != CAROM_SPACE_FLAT && carom_flies_in_layout(&balls[k].state, kind->radius);
    c->ball[c->balls++] = member_of(kind, &balls[k].state, opt, flies, k);
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
  for (int k = 0; k < count; k++) {
    const carom_status status = carom_check_ball(&balls[k], opt->space == CAROM_SPACE_FLAT);
    if (status != CAROM_OK)
      return status;
    if (opt->space == CAROM_SPACE_FLAT && balls[k].kind.radius != balls[0].kind.radius)
      return CAROM_ERROR_RADII_DIFFER;
    for (int i = 0; i < k; i++)
      if (memcmp(balls[i].state.r, balls[k].state.r, sizeof balls[i].state.r) == 0 &&
          !carom_is_out(balls[i].state.label))
        return CAROM_ERROR_COINCIDENT;
  }
  return CAROM_OK;
}

/* Cluster by cluster, the fastest contact first; balls far from each other are in clusters of
 * their own. */
static carom_status solve(const carom_shot_ball *balls, int count, const carom_shot_options *opt,
                          carom_motion *out, carom_cluster_contact *contacts, int room,
                          int *found) {
  carom_cluster_state c;
  bool done[CAROM_CLUSTER_BALLS];

  /* balls keep their motion that are in no cluster */
  for (int k = 0; k < count; k++) {
    done[k] = carom_is_out(balls[k].state.label);
    memcpy(out[k].v, balls[k].state.v, sizeof out[k].v);
    memcpy(out[k].w, balls[k].state.w, sizeof out[k].w);
  }

  for (;;) {
    /* the fastest contact of the balls that are left, with all that it can reach */
    gather(balls, count, opt, done, &c);
    const int size = carom_cluster_members(&c, -1, -1);
    if (size == 0)
      return carom_ok_if(*found > 0, CAROM_SEPARATING);
    if (size < 0 || !carom_cluster_solve(&c))
      return CAROM_ERROR_UNRESOLVED;

    /* its balls are done, */
    for (int k = 0; k < c.balls; k++) {
      const int i = c.ball[k].index;
      done[i] = true;
      motion_of(&c.ball[k], out[i].v, out[i].w);
      if (!carom_is_finite(out[i].v) || !carom_is_finite(out[i].w))
        return CAROM_ERROR_OVERFLOW;
    }

    /* and its contacts are told */
    uint8_t order[CAROM_CLUSTER_CONTACTS];
    const int touched = in_order(&c, order);
    for (int k = 0; k < touched; k++, ++*found)
      if (*found < room)
        contacts[*found] = contact_of(&c, &c.contact[order[k]]);
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
  for (int k = 0; k < count && status < 0; k++)
    out[k] = (carom_motion){{NAN, NAN, NAN}, {NAN, NAN, NAN}};
  if (contacts_count != NULL)
    *contacts_count = found * (status >= 0);
  return status;
}
