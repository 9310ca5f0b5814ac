/* The loop of a shot: find the next event, bring the balls in it there, resolve it, and look for
 * their next meetings. */
#include "cluster/cue.h"
#include "cluster/hertz.h"
#include "motion/strike.h"
#include "platform/promise.h"
#include "platform/threads.h"
#include "shot/clusters.h"
#include "shot/facts.h"
#include "shot/rules.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* m: two balls that rest overlap by no more, which a layout may do (CAROM_MOST_BALL_OVERLAP). */
#define CAROM_REST_OVERLAP 5e-5

/* Counts an event, and gives the position where its states go: in the caller's list, or a spare one
 * where that has no room. */
static inline carom_event *note(carom_sim *sim, carom_event *spare,
                                const carom_due *pending_event) {
  carom_shot *shot = sim->shot;
  CAROM_PROMISE(shot->count >= 0);
  const bool room = shot->count < shot->room;
  carom_event *event = spare;
  if (room && shot->brief != NULL)
    shot->brief[shot->count] =
        (carom_brief_event){sim->time, pending_event->type, pending_event->a, pending_event->b, 0};
  if (room && shot->events != NULL)
    event = &shot->events[shot->count];
  if (shot->facts != NULL)
    carom_facts_event(sim, pending_event);
  shot->count++;
  shot->time = sim->time;
  event->time = sim->time;
  event->type = pending_event->type;
  event->a = pending_event->a;
  event->b = pending_event->b;
  event->cluster = 0;
  event->impulse = 0.0;
  if (pending_event->type != CAROM_EVENT_BALL_BALL)
    memset(&event->before[1], 0, sizeof event->before[1]);
  return event;
}

/* The size of the change of momentum of an event's first ball, N s, for types with a contact. */
static double impulse_of(const carom_sim *sim, const carom_event *event) {
  const unsigned with_contact = 1U << CAROM_EVENT_STRIKE | 1U << CAROM_EVENT_BALL_BALL |
                                1U << CAROM_EVENT_RAIL | 1U << CAROM_EVENT_JAW |
                                1U << CAROM_EVENT_SLATE | 1U << CAROM_EVENT_RAIL_TOP;
  if (!(with_contact >> event->type & 1U))
    return 0.0;
  const double *v = event->before[0].v, *u = event->after[0].v;
  const double x = u[0] - v[0], y = u[1] - v[1], z = u[2] - v[2];
  return sim->layout->kind[event->a]->mass * sqrt(x * x + y * y + z * z);
}

/* A cluster that changes positions may move a ball on the cloth beyond a nose that it had not
 * reached: it stays at the nose, whose impact then follows. */
static void stay_before_noses(const carom_sim *sim, int ball, const carom_ball_state *before,
                              carom_ball_state *state) {
  const carom_features *features = sim->features;
  const carom_ball_kind *kind = sim->layout->kind[ball];
  if (carom_flies(state) || (state->r[0] == before->r[0] && state->r[1] == before->r[1]))
    return;
  for (int index = 0; index < features->rails; index++) {
    const double *line = features->line[index], *along = features->along[index];
    const double reach =
        carom_reach_on_cloth(kind, sim->table->rail[index].height, features->reference);
    const double gap = carom_plane_dot(line, state->r) + line[2] - reach;
    const double was = carom_plane_dot(line, before->r) + line[2] - reach;
    const double place = carom_plane_dot(along, state->r) + along[2];
    if (gap < 0.0 && was >= -CAROM_BEHIND && place >= 0.0 && place <= 1.0) {
      state->r[0] -= gap * line[0];
      state->r[1] -= gap * line[1];
    }
  }
  for (int index = 0; index < features->jaws; index++) {
    const carom_jaw *jaw = &sim->table->jaw[index];
    const double reach = jaw->radius + carom_reach_on_cloth(kind, jaw->height, features->reference);
    const double x = state->r[0] - jaw->centre[0], y = state->r[1] - jaw->centre[1];
    const double distance = sqrt(x * x + y * y);
    const double from_x = before->r[0] - jaw->centre[0], from_y = before->r[1] - jaw->centre[1];
    if (distance < reach && sqrt(from_x * from_x + from_y * from_y) >= reach - CAROM_BEHIND) {
      state->r[0] = jaw->centre[0] + x * (reach / distance);
      state->r[1] = jaw->centre[1] + y * (reach / distance);
    }
  }
}

/* How far a ball on the cloth is in another one, m, and the way out of it. */
static double overlap_with(const carom_sim *sim, int partner, double radius,
                           const carom_ball_state *state, double out[2]) {
  carom_ball_state neighbor;
  carom_path_at(&sim->path[partner], &sim->rates[partner], sim->time, &neighbor);
  if (carom_is_out(neighbor.label) || carom_flies(&neighbor))
    return 0.0;

  /* on the cloth centres are 2 sqrt(R_i R_j) apart, seen from above, where balls touch */
  const double reach = 2.0 * sqrt(radius * sim->rates[partner].radius);
  const double x = state->r[0] - neighbor.r[0], y = state->r[1] - neighbor.r[1];
  const double distance = sqrt(x * x + y * y);
  out[0] = distance > 0.0 ? x / distance : 1.0;
  out[1] = distance > 0.0 ? y / distance : 0.0;
  return reach - distance;
}

/* Moves a ball out of all others, and of noses. Returns whether it is out of all then. */
static bool move_out(const carom_sim *sim, int ball, carom_ball_state *state) {
  enum { ROUNDS = 100 };
  const double radius = sim->rates[ball].radius;
  const carom_ball_state start = *state;
  for (int round = 0; round < ROUNDS; round++) {
    bool moved = false;
    for (int partner = 0; partner < sim->count; partner++) {
      double out[2];
      const double overlap = partner == ball ? 0.0 : overlap_with(sim, partner, radius, state, out);
      if (!(overlap > CAROM_TOUCHING))
        continue;
      moved = true;
      state->r[0] += overlap * out[0];
      state->r[1] += overlap * out[1];
    }
    if (!moved)
      return true;
    stay_before_noses(sim, ball, &start, state);
  }
  return false;
}

/* A cluster may leave balls that overlap (cluster/places.c). They separate, unless friction stops
 * them before, or something else does. Two that rest would then be deeper in each other than a
 * layout may be: the one that stops last comes to rest in front of the other. */
static void rest_in_front(const carom_sim *sim, int ball, carom_ball_state *state) {
  if (carom_flies(state) || carom_translates(state->label) || carom_is_out(state->label))
    return;
  const double radius = sim->rates[ball].radius;
  bool too_deep = false;
  for (int partner = 0; partner < sim->count; partner++) {
    const carom_ball_state *neighbor = &sim->path[partner].from;
    const double x = state->r[0] - neighbor->r[0], y = state->r[1] - neighbor->r[1];
    double way[2];
    /* most are far away, and others move */
    if (x * x + y * y >= 4.0 * radius * sim->rates[partner].radius || partner == ball ||
        carom_translates(neighbor->label))
      continue;
    too_deep |= overlap_with(sim, partner, radius, state, way) > CAROM_REST_OVERLAP;
  }
  carom_ball_state moved = *state;
  if (too_deep && move_out(sim, ball, &moved))
    *state = moved;
}

/* Resolves an event: event->before to the paths of its balls. The change itself is made in
 * path->from. */
static carom_status resolve(carom_sim *sim, const carom_due *pending_event,
                            const carom_event *event) {
  const int ball = pending_event->a, partner = pending_event->b;
  carom_ball_state *state = &sim->path[ball].from;
  switch (pending_event->type) {
  case CAROM_EVENT_BALL_BALL:
    *state = event->before[0];
    sim->path[partner].from = event->before[1];
    return sim->rules->resolve(sim, pending_event, state, &sim->path[partner].from);
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    *state = event->before[0];
    return sim->rules->resolve(sim, pending_event, state, NULL);
  case CAROM_EVENT_POCKET: {
    const carom_pocket *pocket = &sim->table->pocket[partner];
    *state = (carom_ball_state){.r = {pocket->centre[0], pocket->centre[1], -pocket->depth},
                                .label = CAROM_BALL_POCKETED};
    return CAROM_OK;
  }
  case CAROM_EVENT_SLATE:
  case CAROM_EVENT_RAIL_TOP:
    *state = event->before[0];
    carom_hit_slate(sim->layout->kind[ball], state);
    carom_label_after(true, sim->layout->kind[ball], state);
    rest_in_front(sim, ball, state);
    return CAROM_OK;
  case CAROM_EVENT_LEFT_TABLE:
    *state = (carom_ball_state){.label = CAROM_BALL_OFF};
    memcpy(state->r, event->before[0].r, sizeof state->r);
    return CAROM_OK;
  default: /* the end of a phase */
    carom_path_end(&sim->path[ball], &sim->rates[ball], state);
    rest_in_front(sim, ball, state);
    return CAROM_OK;
  }
}

/* Whether the struck ball touches a nose meanwhile. */
static inline bool has_nose(const carom_cluster_state *cluster) {
  return cluster->struck && cluster->nose_near && cluster->nose.lasted > 0.0;
}

/* How many events a cluster has: so many contacts of balls, the strike, and the nose. */
static inline int together_with(const carom_cluster_state *cluster, int count) {
  return count + cluster->struck + has_nose(cluster);
}

/* Each contact of a cluster is an event. A ball changes at its first one, unless it is among
 * changed[], and has the same state before and after the others. *pending_event becomes the first
 * contact of the struck ball, where it has one. */
static carom_status note_contacts(carom_sim *sim, const carom_cluster_state *cluster,
                                  const uint8_t order[], int count, bool changed[],
                                  carom_due *pending_event) {
  carom_status status = CAROM_OK;
  const int struck = sim->struck;
  for (int index = 0; index < count; index++) {
    /* one contact as its own event; balls are in the caller's order */
    const carom_cluster_contact_state *touching = &cluster->contact[order[index]];
    const carom_cluster_ball *two[2] = {&cluster->ball[touching->i], &cluster->ball[touching->j]};
    const carom_due contact = {sim->time, CAROM_EVENT_BALL_BALL, two[0]->index, two[1]->index};
    CAROM_PROMISE(contact.a < contact.b);
    /* the first contact of the struck ball decides whether the shot stops */
    if ((contact.a == struck || contact.b == struck) && pending_event->a != struck &&
        pending_event->b != struck)
      *pending_event = contact;

    carom_event spare, *event = note(sim, &spare, &contact);
    event->cluster = together_with(cluster, count);
    event->impulse = carom_cluster_size_of_impulse(touching);
    for (int side = 0; side < 2; side++) {
      const int ball = two[side]->index;
      carom_path *path = &sim->path[ball];
      /* a ball changes once: before a further contact it is as after its first */
      if (changed[ball]) {
        event->before[side] = path->from;
      } else {
        changed[ball] = true;
        carom_path_at(path, &sim->rates[ball], sim->time, &event->before[side]);
        path->from = event->before[side];
        carom_cluster_rest(sim, cluster, (int)(two[side] - cluster->ball), &path->from);
        carom_label_after(cluster->in_space, sim->layout->kind[ball], &path->from);
        stay_before_noses(sim, ball, &event->before[side], &path->from);
        /* a motion that overflows is not taken: the shot ends there */
        if (!carom_is_finite(path->from.v) || !carom_is_finite(path->from.w)) {
          status = CAROM_ERROR_OVERFLOW;
          path->from = event->before[side];
        }
        carom_path_begin(path, &sim->rates[ball], sim->time);
      }
      event->after[side] = path->from;
    }
  }
  return status;
}

/* The shot ends at this instant, before a cluster or a push that cannot be solved. */
static carom_status unresolved(carom_sim *sim) {
  sim->shot->time = sim->time;
  return CAROM_ERROR_UNRESOLVED;
}

/* Resolves those contacts by the cluster; false if its touches must first be resolved successively.
 * *count becomes the number of its contacts. This is its own function because a cluster needs 30
 * KiB of stack. */
__attribute__((noinline, cold)) static bool step_cluster(carom_sim *sim, carom_due *pending_event,
                                                         carom_in_turn *turn, int *count,
                                                         carom_status *status) {
  carom_cluster_state cluster;
  uint8_t order[CAROM_CLUSTER_CONTACTS];
  *count = carom_cluster_now(sim, pending_event->a, pending_event->b, turn, &cluster, order);
  if (*count == CAROM_TAKE_IN_TURN)
    return false;
  if (*count <= 0)
    return true;
  bool changed[CAROM_BALLS_MOST] = {false};
  *status = note_contacts(sim, &cluster, order, *count, changed, pending_event);
  return true;
}

/* Resolves the contact that is due together with the contacts that last at the same time. Returns
 * false where there are no others. *pending_event becomes the first contact of the struck ball,
 * where it has one. */
__attribute__((noinline, cold)) static bool step_together(carom_sim *sim, carom_due *pending_event,
                                                          carom_status *status) {
  carom_in_turn turn;
  int count;
  turn.known = false;
  if (!step_cluster(sim, pending_event, &turn, &count, status)) {
    carom_take_in_turn(sim, &turn);
    step_cluster(sim, pending_event, &turn, &count, status);
  }
  if (count < 0)
    *status = unresolved(sim);
  else if (count > 0)
    carom_detect_all(sim);
  return count != 0;
}

/* Which strike a push is: the first strike of a ball with others nearby, the first strike of a ball
 * without, a further touch of the tip, or one while the ball touches the nose of a cushion. */
typedef enum push_kind { PUSH_OF_SEVERAL, PUSH_OF_ONE, PUSH_AGAIN, PUSH_IN_NOSE } push_kind;

/* Whether a push is none: no other ball takes part in a PUSH_OF_SEVERAL, a PUSH_AGAIN closes below
 * CAROM_LEAST_TOUCH, or in a PUSH_IN_NOSE the tip has no force. */
static bool is_none(const carom_cluster_state *cluster, push_kind kind, int count) {
  switch (kind) {
  case PUSH_AGAIN:
    return cluster->tip.first < CAROM_LEAST_TOUCH;
  case PUSH_OF_SEVERAL:
    return count == 0;
  case PUSH_IN_NOSE:
    return count >= 0 && !(cluster->tip.impulse > 0.0);
  default:
    return false;
  }
}

/* The cue after a push, which has taken the ball from one state to another. */
static void follow_push(carom_play *play, const carom_cluster_state *cluster,
                        const carom_ball_state *start, const carom_ball_state *end) {
  const carom_cluster_tip *tip = &cluster->tip;
  if (tip->slides) {
    carom_next_tip next = carom_cluster_next_tip(cluster);
    const double *shift = cluster->ball[tip->ball].shift;
    for (int axis = 0; axis < 3; axis++)
      next.moved[axis] += end->r[axis] - start->r[axis] - shift[axis];
    carom_follow_moved(play, next.moved);
    carom_follow_on(play, tip->V, next.travel, next.arm);
  } else {
    const double lead = carom_cluster_tip_lead(cluster);
    carom_follow_on(play, tip->V, lead, lead);
  }
  if (tip->gone) /* it has passed the ball, or does not follow through */
    play->follow.end = -1.0;
}

/* The events of the tip and of the nose, in the order in which they begin. The first one has the
 * whole change, and the other one the same state before and after. */
static carom_status note_push(carom_play *play, const carom_cluster_state *cluster,
                              const uint8_t order[], int count, carom_push_nose *nose,
                              bool nose_leads) {
  carom_sim *sim = &play->sim;
  const int i = sim->struck, together = together_with(cluster, count);
  carom_ball_state start, end;
  carom_path_at(&sim->path[i], &sim->rates[i], sim->time, &start);
  end = start;
  carom_cluster_rest(sim, cluster, cluster->tip.ball, &end);
  carom_label_after(cluster->in_space, sim->layout->kind[i], &end);
  stay_before_noses(sim, i, &start, &end);
  const bool finite = carom_is_finite(end.v) && carom_is_finite(end.w);
  if (!finite)
    end = start;

  const int events = 1 + has_nose(cluster);
  for (int index = 0; index < events; index++) {
    const bool of_tip = events == 1 || (index == 1) == nose_leads;
    carom_due contact = {sim->time, CAROM_EVENT_STRIKE, i, -1};
    if (!of_tip)
      contact = nose->event;
    carom_event spare, *event = note(sim, &spare, &contact);
    if (of_tip)
      carom_facts_push(sim, cluster, order, count);
    event->before[0] = index == 0 ? start : end;
    event->after[0] = end;
    memset(&event->after[1], 0, sizeof event->after[1]);
    event->impulse =
        of_tip ? cluster->tip.impulse : cluster->nose.impulse * sim->layout->kind[i]->mass;
    if (together > 1)
      event->cluster = together;
    if (index > 0)
      continue;
    sim->path[i].from = end;
    carom_path_begin(&sim->path[i], &sim->rates[i], sim->time);
  }
  follow_push(play, cluster, &start, &end);
  if (events > 1)
    nose->touches = true;
  return finite ? CAROM_OK : CAROM_ERROR_OVERFLOW;
}

/* Resolves the push of a cue together with the contacts of balls that last meanwhile, and with a
 * nose; the events of balls follow those of tip and nose. Returns false, with nothing changed,
 * where it is none. *contact becomes the first contact of the struck ball with another one. */
__attribute__((noinline, cold)) static bool push(carom_play *play, const carom_cue_push *task,
                                                 push_kind kind, carom_due *contact,
                                                 carom_status *status) {
  carom_sim *sim = &play->sim;
  carom_cluster_state cluster;
  carom_cluster_slate slates[CAROM_CLUSTER_BALLS];
  uint8_t order[CAROM_CLUSTER_CONTACTS];
  cluster.slate = slates;
  const int count = carom_cluster_strike(sim, task, &cluster, order), i = sim->struck;
  if (is_none(&cluster, kind, count))
    return false;
  if (count < 0) {
    *status = unresolved(sim);
    return true;
  }

  if (cluster.tip.touches == 0) /* it closes, and is thrown off by the set */
    cluster.tip.touches = 1;
  *status = note_push(play, &cluster, order, count, task->nose, kind == PUSH_IN_NOSE);

  bool changed[CAROM_BALLS_MOST] = {false};
  changed[i] = true;
  *contact = (carom_due){sim->time, CAROM_DUE_NOTHING, -1, -1};
  if (count > 0)
    contact->type = CAROM_EVENT_BALL_BALL;
  const carom_status of_contacts = note_contacts(sim, &cluster, order, count, changed, contact);
  if (*status == CAROM_OK)
    *status = of_contacts;
  return true;
}

/* Whether a contact may be one of several that last. */
static inline bool may_last(const carom_sim *sim, const carom_due *pending_event) {
  return pending_event->type == CAROM_EVENT_BALL_BALL && sim->rules->clusters &&
         carom_lasts(sim->opt) && carom_third_is_near(sim, pending_event->a, pending_event->b);
}

/* One event, or the events of a cluster. */
static carom_status step(carom_sim *sim, carom_due *pending_event) {
  carom_status together;
  if (may_last(sim, pending_event) && step_together(sim, pending_event, &together))
    return together;
  carom_event spare, *event = note(sim, &spare, pending_event);
  const int ball = pending_event->a;
  int partner = -1;
  if (pending_event->type == CAROM_EVENT_BALL_BALL)
    partner = pending_event->b;
  CAROM_PROMISE(ball >= 0 && ball < sim->count &&
                (partner < 0 || (ball < partner && partner < sim->count)));

  /* the states of its balls where it happens */
  carom_path_at(&sim->path[ball], &sim->rates[ball], sim->time, &event->before[0]);
  if (pending_event->type == CAROM_EVENT_SLATE)
    carom_path_land(&sim->path[ball], &sim->rates[ball], sim->time, &event->before[0]);
  else if (pending_event->type == CAROM_EVENT_RAIL_TOP) /* exactly on it */
    event->before[0].r[2] = carom_height_on_top(sim, ball, pending_event->b);
  if (partner >= 0)
    carom_path_at(&sim->path[partner], &sim->rates[partner], sim->time, &event->before[1]);

  /* the states after it, on their paths; an error leaves those before it */
  const carom_status status = resolve(sim, pending_event, event);
  if (status < 0) {
    sim->path[ball].from = event->before[0];
    if (partner >= 0)
      sim->path[partner].from = event->before[1];
  }

  /* what the caller keeps of it */
  if (event != &spare) {
    event->after[0] = sim->path[ball].from;
    if (partner >= 0)
      event->after[1] = sim->path[partner].from;
    else
      memset(&event->after[1], 0, sizeof event->after[1]);
    event->impulse = impulse_of(sim, event);
  }

  /* the paths from here on, and what is met on them */
  carom_path_begin(&sim->path[ball], &sim->rates[ball], sim->time);
  if (partner >= 0)
    carom_path_begin(&sim->path[partner], &sim->rates[partner], sim->time);
  if (status >= 0)
    carom_detect(sim, ball, partner);
  return status;
}

/* Whether the cue strikes at all: it moves, and every ball in play is at rest. */
static bool may_strike(const carom_sim *sim) {
  if (sim->cue == NULL || !(sim->cue->speed > 0.0))
    return false;
  for (int ball = 0; ball < sim->count; ball++) {
    const int64_t label = sim->path[ball].from.label;
    if (label != CAROM_BALL_STATIONARY && !carom_is_out(label))
      return false;
  }
  return true;
}

/* How the rules of the world take a strike. */
static carom_strike_kind strike_kind_of(const carom_sim *sim) {
  if (sim->rules->flat)
    return CAROM_STRIKE_TURNED;
  if (sim->opt->space == CAROM_SPACE_FLAT)
    return CAROM_STRIKE_ON_CLOTH;
  return CAROM_STRIKE_IN_SPACE;
}

/* The strike of a ball that meets no other meanwhile, whose motion after it is `alone`. */
static void note_strike(carom_sim *sim, const carom_ball_state *alone, const carom_raised *raised,
                        bool in_space, bool is_push) {
  const int ball = sim->struck;
  const carom_due strike_event = {0.0, CAROM_EVENT_STRIKE, ball, -1};
  carom_event spare, *event = note(sim, &spare, &strike_event);
  carom_ball_state *state = &sim->path[ball].from;
  carom_facts_touches(sim, raised->touches, sim->cue->speed, raised->second);
  event->before[0] = *state;
  *state = *alone;
  carom_label_after(in_space, sim->layout->kind[ball], state);
  if (sim->rules->contacts_slide)
    state->label = CAROM_BALL_SLIDING;
  event->after[0] = *state;
  memset(&event->after[1], 0, sizeof event->after[1]);
  event->impulse = impulse_of(sim, event);
  if (is_push)
    event->impulse = raised->impulse;
  carom_path_begin(&sim->path[ball], &sim->rates[ball], 0.0);
}

/* The strike, if the cue strikes. *contact becomes a contact of its push. */
static carom_status strike(carom_play *play, carom_due *contact) {
  carom_sim *sim = &play->sim;
  if (!may_strike(sim))
    return CAROM_OK;
  const carom_cue *cue = sim->cue;
  const int ball = (int)cue->ball;
  const carom_ball_kind *kind = sim->layout->kind[ball];
  carom_motion motion;
  const carom_status status = carom_strike_motion(cue, kind, strike_kind_of(sim), &motion);
  if (status < 0)
    return status;
  carom_facts_frozen(sim);
  memcpy(play->follow.origin, sim->path[ball].from.r, sizeof play->follow.origin);
  play->follow.along = 0.0;
  play->follow.left = cue->follow;

  /* together with the balls that the struck ball meets while the cue pushes */
  carom_status together;
  const double *v = motion.v, most = carom_space_size(v);
  const bool down = v[2] != 0.0;
  const carom_cue_push task = {.cue = cue, .most = most, .slate = down};
  if (carom_may_push(sim, &motion) && push(play, &task, PUSH_OF_SEVERAL, contact, &together))
    return together;

  /* alone: a level strike has a closed form, a raised one presses the ball on the slate, unless
   * the strike takes no time */
  carom_ball_state alone = sim->path[ball].from;
  carom_raised raised = {.touches = 1};
  raised.lead = cue->speed * carom_linear_lag(carom_tip_time(cue), carom_tip_of(cue));
  raised.V = cue->speed - kind->mass / cue->mass * carom_strike_speed(cue, kind);
  memcpy(alone.v, motion.v, sizeof alone.v);
  memcpy(alone.w, motion.w, sizeof alone.w);
  const bool is_push = down && cue->tip_time >= 0.0;
  if (is_push && !carom_push_alone(kind, cue, &alone, &raised)) {
    push(play, &task, PUSH_OF_ONE, contact, &together);
    return together;
  }
  carom_follow_on(play, raised.V, raised.lead, raised.lead);
  note_strike(sim, &alone, &raised, down, is_push);
  return CAROM_OK;
}

static void begin(carom_sim *sim) {
  carom_take_rates(sim);
  for (int i = 0; i < sim->count; i++) {
    carom_ball_state *state = &sim->path[i].from;
    *state = *sim->layout->state[i];
    carom_label_of_layout(state, sim->rates[i].radius);
    carom_path_begin(&sim->path[i], &sim->rates[i], 0.0);
  }
}

/* Takes note of an event of the struck ball. Returns whether it is its first contact with another
 * ball. */
static bool note_event(carom_sim *sim, const carom_due *event) {
  const bool of_struck = event->a == sim->struck;
  const bool contact =
      event->type == CAROM_EVENT_BALL_BALL && (of_struck || event->b == sim->struck);
  const bool cushion =
      (event->type == CAROM_EVENT_RAIL || event->type == CAROM_EVENT_JAW) && of_struck;
  const bool first = contact && !sim->has_hit;
  sim->has_hit |= contact;
  sim->turned |= contact || cushion;
  return first;
}

/* Whether the shot stops after an event: where the caller's set of events has its type, or where it
 * is the first contact of the struck ball, and that is with a ball that is not one of first_of. */
static bool stops_at(const carom_sim *sim, const carom_due *event, bool first) {
  const bool of_struck = event->a == sim->struck;
  const bool contact =
      event->type == CAROM_EVENT_BALL_BALL && (of_struck || event->b == sim->struck);
  int partner = event->a;
  if (of_struck)
    partner = event->b;
  if (first && sim->opt->first_of != 0 && !(sim->opt->first_of >> partner & 1))
    return true;
  if (contact && (sim->opt->stop_at & CAROM_STOP_AT_CONTACT) != 0)
    return true;
  return (sim->opt->stop_at & CAROM_STOP_AT(event->type)) != 0;
}

/* The tip touches the struck ball again, or the follow-through ends. *pending_event becomes what
 * happens; *lies whether the tip closes too slowly, and stays at the ball. */
__attribute__((noinline, cold)) static carom_status
touch_again(carom_play *play, carom_due *pending_event, bool *lies) {
  carom_sim *sim = &play->sim;
  carom_follow *f = &play->follow;
  const carom_follow until_now = *f;
  carom_ball_state ball;
  carom_path_at(&sim->path[sim->struck], &sim->rates[sim->struck], sim->time, &ball);
  carom_cue cue;
  double tip_place[3];
  carom_status status = CAROM_OK;
  const bool touches = carom_follow_cue(play, &cue, tip_place);
  /* its force has a part down or up under a level cue too */
  carom_push_nose nose;
  const bool nose_near = carom_find_nose(sim, &ball, &nose);
  const carom_cue_push task = {.cue = &cue,
                               .tip_place = tip_place,
                               .nose = nose_near ? &nose : NULL,
                               .most = 2.0 * fabs(cue.speed) + carom_space_size(ball.v),
                               .slowest = CAROM_SLOWEST_ARM * sim->cue->speed,
                               .slate = sim->opt->space != CAROM_SPACE_FLAT};
  carom_follow_now(play);
  f->end = -1.0;
  pending_event->type = CAROM_DUE_NOTHING;
  const bool pushes = touches && push(play, &task, PUSH_AGAIN, pending_event, &status);
  *lies = touches && !pushes;
  if (pushes) {
    const bool in_nose = nose_near && nose.touches;
    sim->turned = in_nose || f->V < 0.0; /* it may follow a cue that it has thrown back */
    carom_detect_all(sim);
    const carom_due strike_event = {sim->time, CAROM_EVENT_STRIKE, sim->struck, -1};
    bool stops = stops_at(sim, &strike_event, false);
    if (in_nose)
      stops |= stops_at(sim, &nose.event, false);
    if (status == CAROM_OK && stops)
      status = CAROM_STOPPED_AT_EVENT;
  } else if (touches) { /* the cue continues */
    *f = until_now;
    f->time = INFINITY;
  }
  /* whether the shot stops at the strike is decided here; at a contact next to it, in go_on() */
  if (pending_event->type == CAROM_DUE_NOTHING)
    pending_event->type = CAROM_DUE_PIECE;
  return status;
}

/* The struck ball, as it is now, meets a cushion while the cue follows through. Returns whether the
 * tip presses it meanwhile: then both are over, and the shot has *status. */
__attribute__((noinline, cold)) static bool push_in_nose(carom_play *play, const carom_due *event,
                                                         carom_ball_state *ball,
                                                         carom_status *status) {
  carom_sim *sim = &play->sim;
  carom_path_at(&sim->path[sim->struck], &sim->rates[sim->struck], sim->time, ball);
  if (!carom_tip_is_near(play, ball))
    return false;
  carom_cue cue;
  double tip_place[3];
  carom_due contact;
  carom_push_nose nose;
  carom_nose_now(sim, ball, event, &nose);
  carom_follow_cue(play, &cue, tip_place);
  const carom_cue_push task = {.cue = &cue,
                               .tip_place = tip_place,
                               .nose = &nose,
                               .most = 2.0 * fabs(cue.speed) + carom_space_size(ball->v),
                               .slowest = CAROM_SLOWEST_ARM * sim->cue->speed,
                               .slate = sim->opt->space != CAROM_SPACE_FLAT};
  const carom_follow saved = play->follow;
  carom_follow_now(play);
  if (!push(play, &task, PUSH_IN_NOSE, &contact, status)) {
    play->follow = saved;
    return false;
  }

  /* the strike and a contact of balls may stop the shot; the cushion does in go_on() */
  carom_detect_all(sim);
  const carom_due strike_event = {sim->time, CAROM_EVENT_STRIKE, sim->struck, -1};
  const bool first = note_event(sim, &contact);
  bool stops = stops_at(sim, &strike_event, false);
  if (contact.type != CAROM_DUE_NOTHING)
    stops |= stops_at(sim, &contact, first);
  if (*status == CAROM_OK && stops)
    *status = CAROM_STOPPED_AT_EVENT;
  return true;
}

/* Whether a cushion is due of the struck ball, which the cue follows. */
static inline bool meets_nose(const carom_play *play, const carom_due *pending_event) {
  return (pending_event->type == CAROM_EVENT_RAIL || pending_event->type == CAROM_EVENT_JAW) &&
         pending_event->a == play->sim.struck && play->sim.time < play->follow.end;
}

/* What is due happens: another touch of the tip, a cushion that the cue follows the ball to, or any
 * other event. *lies becomes whether the tip stays at the ball. */
static inline carom_status happen(carom_play *play, carom_due *pending_event, bool touches_again,
                                  bool *lies) {
  carom_sim *sim = &play->sim;
  if (touches_again)
    return touch_again(play, pending_event, lies);
  const bool by_nose = meets_nose(play, pending_event);
  carom_ball_state ball;
  carom_status status = CAROM_OK;
  if (by_nose && push_in_nose(play, pending_event, &ball, &status))
    return status;
  status = step(sim, pending_event);
  if (by_nose && status >= 0) /* the cue goes on by the time of the cushion */
    carom_follow_nose(play, &ball, &sim->path[sim->struck].from);
  return status;
}

/* From event to event, until nothing moves or the shot is to stop. Nothing is changed by
 * stopping, so the loop continues later as if it had not. */
static carom_status go_on(carom_play *play) {
  carom_sim *sim = &play->sim;
  int64_t events_most = 10000;
  if (sim->opt->events_most > 0)
    events_most = sim->opt->events_most;
  double time_most = 1000.0;
  carom_status out_of_time = CAROM_ERROR_TOO_LONG;
  if (sim->opt->time_most > 0.0) {
    time_most = sim->opt->time_most;
    out_of_time = CAROM_STOPPED_AT_TIME;
  }
  carom_status status = CAROM_OK;
  while (status == CAROM_OK) {
    /* what is due: an event, or another touch of the tip, which goes first */
    carom_due pending_event = carom_next(sim);
    const bool follows = play->follow.end >= 0.0 && play->follow.time < INFINITY;
    const bool touches_again = follows && play->follow.time <= pending_event.time;
    if (touches_again)
      pending_event = (carom_due){play->follow.time, CAROM_EVENT_STRIKE, sim->struck, -1};

    /* what ends the shot: rest, or the time that the caller allows */
    if (pending_event.type == CAROM_DUE_REST)
      break;
    if (pending_event.time > time_most) {
      sim->shot->time = time_most;
      return out_of_time;
    }

    /* another piece of a path is not an event: only what it meets is looked for */
    if (pending_event.type == CAROM_DUE_PIECE) {
      sim->shot->time = sim->time = carom_greater(sim->time, pending_event.time);
      sim->round++;
      carom_path_go_on(&sim->path[pending_event.a], &sim->rates[pending_event.a]);
      carom_detect(sim, pending_event.a, -1);
      if (sim->time < play->follow.end)
        carom_follow_find(play);
      continue;
    }

    if (sim->shot->count >= events_most)
      return CAROM_ERROR_TOO_MANY_EVENTS;
    /* a ball on the cloth that finds no part of the table has left it */
    if (pending_event.type == CAROM_DUE_OFF_THE_CLOTH) {
      sim->shot->time = sim->time = carom_greater(sim->time, pending_event.time);
      return CAROM_ERROR_LEFT_TABLE;
    }
    /* the time of an event that is simultaneous with the last one may be a rounding error less */
    sim->time = carom_greater(sim->time, pending_event.time);
    sim->round++;
    bool lies = false;
    status = happen(play, &pending_event, touches_again, &lies);
    /* of a shot that stops at a strike too: the contact beside it turns the ball */
    const bool first = note_event(sim, &pending_event);
    if (status == CAROM_OK && stops_at(sim, &pending_event, first))
      status = CAROM_STOPPED_AT_EVENT;
    if (!lies && sim->time < play->follow.end)
      carom_follow_find(play);
  }
  return status;
}

/* The states at the end; and all of the shot, where the caller keeps it. */
static carom_status finish(carom_play *play, carom_status status) {
  carom_sim *sim = &play->sim;
  carom_shot *shot = sim->shot;
  for (int ball = 0; shot->final != NULL && ball < sim->count; ball++)
    carom_path_at(&sim->path[ball], &sim->rates[ball], shot->time, &shot->final[ball]);

  /* a shot that a bound has cut off continues with a greater one */
  const bool goes_on =
      status >= 0 || status == CAROM_ERROR_TOO_LONG || status == CAROM_ERROR_TOO_MANY_EVENTS;
  if (shot->state != NULL && goes_on)
    carom_state_save(play, shot->state);
  else if (shot->state != NULL)
    memset(shot->state, 0, sizeof *shot->state);
  return status;
}

/* The strike, and whether the shot is to continue after it. */
static carom_status start(carom_play *play) {
  carom_sim *sim = &play->sim;
  carom_due contact = {0.0, CAROM_DUE_NOTHING, -1, -1};
  const carom_status status = strike(play, &contact);
  if (status != CAROM_OK)
    return status;
  carom_detect_all(sim);
  const carom_due strike_event = {0.0, CAROM_EVENT_STRIKE, sim->struck, -1};
  bool stops = sim->shot->count > 0 && stops_at(sim, &strike_event, false);
  if (contact.type != CAROM_DUE_NOTHING) {
    const bool first = note_event(sim, &contact);
    stops |= stops_at(sim, &contact, first);
  }
  if (play->follow.end > 0.0)
    carom_follow_find(play);
  if (stops)
    return CAROM_STOPPED_AT_EVENT;
  return CAROM_OK;
}

/* A shot from its strike, or on from shot->state. */
__attribute__((noinline)) static carom_status
shoot(const carom_prepared *prepared, const carom_cue *cue, carom_shot *shot, bool anew) {
  carom_play play;
  carom_sim *sim = &play.sim;
  if (!anew)
    memcpy(&play, shot->state, sizeof play);
  else if (shot->state != NULL) /* the bytes that are not written below are kept too */
    memset(&play, 0, sizeof play);

  /* what belongs to this call */
  sim->rules = carom_rules_of(prepared->opt->world);
  sim->table = prepared->table;
  sim->features = prepared->features;
  sim->layout = prepared;
  sim->opt = prepared->opt;
  sim->cue = cue;
  sim->shot = shot;
  shot->slope_x = prepared->table->slope_x;
  shot->slope_y = prepared->table->slope_y;

  /* what belongs to the shot: as it begins, or as it was kept */
  carom_status status = CAROM_OK;
  if (anew) {
    sim->count = prepared->count;
    /* a cue of speed 0 is not read, and may name any ball */
    sim->struck = 0;
    if (cue != NULL && cue->ball >= 0 && cue->ball < prepared->count)
      sim->struck = (int)cue->ball;
    sim->world = prepared->opt->world;
    sim->has_hit = sim->turned = false;
    sim->time = 0.0;
    sim->round = 0;
    sim->slow_instants = 0;
    sim->slow_last = play.follow.end = -1.0;
    play.follow.time = INFINITY;
    if (shot->state != NULL)
      carom_state_begin(sim);
    begin(sim);
    status = start(&play);
  } else {
    status = carom_state_check(&play, shot->state, prepared->count);
    if (status != CAROM_OK)
      return status;
    sim->cue = &play.follow.cue;
  }
  CAROM_PROMISE(sim->count > 0 && sim->count <= CAROM_BALLS_MOST && sim->struck < sim->count);
  if (status == CAROM_OK)
    status = go_on(&play);
  return finish(&play, status);
}

/* The same for a caller who does not want the facts that belong to the state. This is a separate
 * function so that other shots do not need its stack. */
__attribute__((noinline, cold)) static carom_status shoot_with_facts(const carom_prepared *prepared,
                                                                     const carom_cue *cue,
                                                                     carom_shot *shot, bool anew) {
  carom_facts facts;
  carom_facts_begin(shot->facts = &facts);
  const carom_status status = shoot(prepared, cue, shot, anew);
  shot->facts = NULL;
  return status;
}

/* As a result begins: nothing happened, and there is nothing to continue with. */
static void clear(carom_shot *shot) {
  shot->count = 0;
  shot->time = 0.0;
  if (shot->state != NULL)
    memset(shot->state, 0, sizeof *shot->state);
  if (shot->facts != NULL)
    carom_facts_begin(shot->facts);
}

carom_status carom_shoot_prepared(const carom_prepared *prepared, const carom_cue *cue,
                                  carom_shot *shot) {
  clear(shot);
  const carom_status status = carom_check_strike(prepared, cue);
  if (status != CAROM_OK)
    return status;
  if (shot->state != NULL && shot->facts == NULL)
    return shoot_with_facts(prepared, cue, shot, true);
  return shoot(prepared, cue, shot, true);
}

carom_status carom_shoot(const carom_table *table, const carom_shot_ball *balls, int count,
                         const carom_cue *cue, const carom_shot_options *opt, carom_shot *shot) {
  carom_features features;
  carom_prepared prepared;
  int where;
  if (table == NULL || balls == NULL || shot == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = carom_check_room(shot);
  if (status != CAROM_OK)
    return status;
  clear(shot);
  status =
      carom_prepare(table, balls, count, carom_options_or_usual(opt), &features, &prepared, &where);
  if (status != CAROM_OK)
    return status;
  return carom_shoot_prepared(&prepared, cue, shot);
}

carom_status carom_shot_continue(const carom_table *table, const carom_shot_ball *balls, int count,
                                 const carom_shot_options *opt, carom_shot *shot) {
  carom_features features;
  carom_prepared prepared;
  int where;
  if (table == NULL || balls == NULL || shot == NULL || shot->state == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = carom_check_room(shot);
  if (status == CAROM_OK)
    status = carom_prepare(table, balls, count, carom_options_or_usual(opt), &features, &prepared,
                           &where);
  if (status != CAROM_OK)
    return status;
  if (shot->count < 0 || !(shot->time >= 0.0 && shot->time < INFINITY))
    return CAROM_ERROR_STATE;
  if (shot->facts == NULL)
    return shoot_with_facts(&prepared, NULL, shot, false);
  return shoot(&prepared, NULL, shot, false);
}

/* ---- Many */

/* The layout that was checked last, with which status. It is known by the address of its states,
 * as the rows of a batch that share one have the same. */
typedef struct checked {
  carom_prepared layout;
  carom_features features;
  carom_status status;
} checked;

/* Before the first row no layout is checked: no radius and no address of states is this one. */
static void no_layout(const carom_shot_job *job, checked *last) {
  last->features.radius = 0.0;
  last->layout.table = job->table;
  last->layout.opt = carom_options_or_usual(job->options);
  last->layout.state[0] = NULL;
}

static carom_status shoot_row(const carom_shot_job *job, size_t row, checked *last) {
  const carom_cue *cue = NULL;
  if (job->cues != NULL)
    cue = job->cues + row * job->cue_stride;
  carom_shot *shot = &job->shots[row];
  const carom_status status = carom_check_room(shot);
  if (status != CAROM_OK)
    return status;
  /* a layout that is the last one is not checked again */
  int where;
  const carom_ball_state *states = last->layout.state[0];
  carom_take_row(&last->layout, job, row);
  if (last->layout.state[0] != states)
    last->status = carom_prepare_row(&last->layout, &last->features, &where);
  if (last->status == CAROM_OK)
    return carom_shoot_prepared(&last->layout, cue, shot);
  clear(shot);
  return last->status;
}

static size_t shoot_rows(const void *context, size_t first, size_t end) {
  const carom_shot_job *job = context;
  size_t first_bad = end;
  checked last; /* shared by rows with one layout; its features by those with one radius */
  no_layout(job, &last);
  for (size_t index = first; index < end; index++) {
    const carom_status status = shoot_row(job, index, &last);
    if (job->status != NULL)
      job->status[index] = (int8_t)status;
    if (status < 0 && first_bad == end)
      first_bad = index;
  }
  return first_bad;
}

carom_status carom_shoot_batch(const carom_shot_job *job) {
  if (job == NULL)
    return CAROM_ERROR_NULL;
  if (job->n == 0)
    return CAROM_OK;
  const carom_shot_options *opt = carom_options_or_usual(job->options);
  int where;
  carom_status status = carom_check_job(job);
  if (status == CAROM_OK)
    status = carom_check_common(job->table, job->count, opt, &where);
  if (status != CAROM_OK)
    return status;
  enum { LEAST = 4 }; /* shots worth a thread */
  const size_t first_bad = carom_in_threads(shoot_rows, job, (size_t)job->n, opt->threads, LEAST);
  if (first_bad == job->n)
    return CAROM_OK;
  /* The threads only returned its index; playing the shot again returns its status. */
  checked last;
  no_layout(job, &last);
  return shoot_row(job, first_bad, &last);
}
