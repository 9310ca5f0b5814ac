/* Follows the events of a shot that has been played, with numbers that carry their derivatives
 * in up to CAROM_TANGENT_COLUMNS directions, and by time.
 *
 * VALUES are equal to the shot's, to the bit: after each step they are set to the played ones, so
 * only derivatives flow.
 *
 * TIME OF AN EVENT. Let d be the derivatives of the states of its balls at a fixed time, and x'
 * their rates: both are in the state at that time, x' in the direction CLOCK. An event is where
 * a gap g of these states is zero, so
 *
 *     dT = -(dg . d) / (dg . x'),      dx- = d + x' dT.
 *
 * The end of a phase is a number that knows its own derivatives. So contacts are resolved from
 * dx-, by the sources of the shot, and their result is the state from which the next
 * path begins, at T + dT.
 *
 * CLUSTERS. All balls of a cluster change at the time of the contact that starts it. Their
 * states there are in the rows of the result, from which each direction is taken through the
 * cluster by itself.
 *
 * LABELS. A ball that rolls after an event, or rests, is assumed to keep doing so where a change of
 * the first order would make it slide for a time of the first order: a slip du becomes the speed
 * -2/7 du. */
#include "schema/options.h"
#include "tangent/text.h"
extern "C" {
#include "tangent/follow_cluster.h"
}

#include <stdlib.h>

namespace {
using text::carom_ball_state;
using text::carom_sim;

/* s: events less than this apart are simultaneous. Contacts that close slower than so much of
 * the speed graze. */
const real SIMULTANEOUS = 1e-9, GRAZING = 0.01;
/* s: at the beginning of a path its motion is evaluated after a time that is too short to change
 * any value. */
const real AT_ONCE = 1e-200;

number &number_of(carom_ball_state *s, int k) {
  switch (k) {
  case S_X:
  case S_Y:
    return s->r[k - S_X];
  case S_V_X:
  case S_V_Y:
    return s->v[k - S_V_X];
  case S_W_X:
  case S_W_Y:
  case S_W_Z:
    return s->w[k - S_W_X];
  default:
    return k == S_Z ? s->r[2] : s->v[2];
  }
}

/* ---- Rows ---- */

void load(const carom_tangent_pass &pass, const real *rows, int64_t at, number *to) {
  const real *from = rows != nullptr ? rows + at * pass.m + pass.first : nullptr;
  to->d = row{};
  if (rows != nullptr && pass.columns == CAROM_TANGENT_COLUMNS)
    memcpy(&to->d, from, sizeof(real) * CAROM_TANGENT_COLUMNS); /* of a size that is known */
  else if (rows != nullptr)
    memcpy(&to->d, from, sizeof(real) * (size_t)pass.columns);
}
/* A value with its tangents. */
number known(real x, const carom_tangent_row d) {
  number n = x;
  memcpy(&n.d, d, sizeof n.d);
  n.d[CLOCK] = 0;
  return n;
}
void unload(const carom_tangent_pass &pass, const number &from, real *rows, int64_t at) {
  real *to = carom_tangent_columns(&pass, rows, at);
  if (pass.columns == CAROM_TANGENT_COLUMNS)
    memcpy(to, &from.d, sizeof(real) * CAROM_TANGENT_COLUMNS);
  else
    memcpy(to, &from.d, sizeof(real) * (size_t)pass.columns);
}
void store(const number &from, carom_tangent_row to) {
  memcpy(to, &from.d, sizeof from.d);
}
void store_state(carom_ball_state *s, carom_tangent_rows to) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    store(number_of(s, k), to[k]);
}

/* All numbers of a struct that has nothing else. */
template <class plain, class type>
void load_struct(const carom_tangent_pass &pass, const plain *from, const real *rows, type *to) {
  enum { NUMBERS = sizeof(type) / sizeof(number) };
  static_assert(sizeof(plain) == NUMBERS * sizeof(real), "it has nothing but numbers");
  const real *value = reinterpret_cast<const real *>(from);
  number *x = reinterpret_cast<number *>(to);
  for (int k = 0; k < NUMBERS; k++) {
    x[k].x = value[k];
    load(pass, rows, k, &x[k]);
  }
}
void load_kind(const carom_tangent_work *w, int i, text::carom_ball_kind *to) {
  const real *rows = w->seeds->kind;
  load_struct(w->pass, w->ball[i].kind,
              rows != nullptr ? rows + (int64_t)i * CAROM_KIND_NUMBERS * w->pass.m : nullptr, to);
}

/* Values are those that were played. */
void set(const ::carom_ball_state &played, carom_ball_state *s) {
  for (int k = 0; k < 3; k++) {
    s->r[k].x = played.r[k];
    s->v[k].x = played.v[k];
    s->w[k].x = played.w[k];
  }
  s->label = played.label;
}

/* ---- An event ---- */

/* The data for the sources of the shot: two balls at indices 0 and 1, and one part of the table. */
struct scene {
  carom_tangent_work *w;
  const carom_event *event;
  bool two;
  int side[2];                 /* which balls */
  text::carom_prepared layout; // its two balls
  carom_sim sim;
  text::carom_shot_ball ball[2];
  text::carom_shot_options opt;
  text::carom_rules rules;
  text::carom_table table;
  text::carom_features features;
};

CAROM_APART void begin_ball(const carom_tangent_work *w, int i, int side, scene *s) {
  const carom_tangent_ball *ball = &w->ball[i];
  text::carom_ball_kind *kind = &s->ball[side].kind;
  load_kind(w, i, kind);
  number slope[] = {w->table->slope_x, w->table->slope_y};
  for (int k = 0; k < 2; k++)
    load(w->pass, w->seeds->slope, k, &slope[k]);
  s->sim.rates[side] = text::carom_rates_on_slope(kind, slope[0], slope[1]);
  text::carom_path *path = &s->sim.path[side];
  set(ball->origin, &path->from);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    load(w->pass, w->tangent->final, (int64_t)i * CAROM_STATE_NUMBERS + k,
         &number_of(&path->from, k));
  text::carom_path_begin(path, &s->sim.rates[side], known(0.0, ball->start));
}

/* Where velocity and spin are in a state. */
const int S_OF_V[3] = {S_V_X, S_V_Y, S_V_Z}, S_OF_W[3] = {S_W_X, S_W_Y, S_W_Z};

/* The state at a time, with derivatives at that fixed time and, by CLOCK, its rate. A path
 * begins at 0 on its own clock. */
CAROM_APART void state_at(const carom_tangent_work *w, int i, int side, real time, scene *s,
                          carom_ball_state *to) {
  text::carom_path *path = &s->sim.path[side];
  const real tau = time - w->ball[i].origin_time;
  number at = tau > AT_ONCE ? tau : AT_ONCE;
  at.d[CLOCK] = 1;
  /* pieces of a roll with drag */
  while (path->goes_on && path->end.x < tau - 1e-13)
    text::carom_path_go_on(path, &s->sim.rates[side]);
  text::carom_path_at(path, &s->sim.rates[side], at, to);
  /* a spin of 0 that a change brings about takes time to end */
  if (!(tau > 0) && path->from.w[2].x == 0 && path->from.label != text::CAROM_BALL_STATIONARY)
    to->w[2].d = path->from.w[2].d;
}

/* Converts derivatives at a fixed time into derivatives of an event, whose time has the derivatives
 * dT. */
void add_time(const row &dT, number *x) {
  const real rate = x->d[CLOCK];
  x->d += rate * dT;
  x->d[CLOCK] = 0;
}
CAROM_APART void add_time(const row &dT, carom_ball_state *s) {
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    add_time(dT, &number_of(s, k));
}

/* The numbers of a nose that have seeds, of a rail or a jaw. */
template <class plain, class type>
void take_nose(const carom_tangent_work *w, const plain &from, type *to) {
  const real value[] = {from.height, from.mu_cushion, from.restitution};
  number *const nose[] = {&to->height, &to->mu_cushion, &to->restitution};
  for (int k = 0; k < 3; k++) {
    *nose[k] = value[k];
    load(w->pass, w->seeds->table, k, nose[k]);
  }
}

/* The rails that a jaw continues, as the only ones. */
void take_seams(scene *s, int index) {
  const carom_table *table = s->w->table;
  ::carom_seam seam[CAROM_SEAMS_MOST];
  const int count = ::carom_seams_of(table, index, seam);
  s->table.rails = count;
  for (int k = 0; k < count; k++) {
    const carom_rail *from = &table->rail[seam[k].rail];
    text::carom_rail *to = &s->table.rail[k];
    for (int axis = 0; axis < 2; axis++) {
      to->p[axis] = from->p[axis];
      to->q[axis] = from->q[axis];
    }
    take_nose(s->w, *from, to);
  }
}

/* The part of the table that an event has, as the only one. */
CAROM_APART void take_part(scene *s) {
  const carom_tangent_work *w = s->w;
  const carom_event *e = s->event;
  s->table.rails = s->features.rails = 1;
  s->table.jaws = s->features.jaws = 1;

  /* noses are placed by the radius of the table's balls */
  s->features.reference = w->reference;

  /* the commonest radius determines the position of the nose, unless the table names one */
  if (!(w->table->ball_radius > 0) && w->seeds->kind != nullptr)
    load(w->pass, w->seeds->kind,
         (int64_t)w->reference_ball * CAROM_KIND_NUMBERS +
             (int)(offsetof(carom_ball_kind, radius) / sizeof(real)),
         &s->features.reference);

  /* the part: tops count rails first, then jaws */
  const int b = e->type == CAROM_EVENT_RAIL_TOP && e->b >= w->table->rails
                    ? e->b - (int)w->table->rails
                    : e->b;
  const bool rail =
      e->type == CAROM_EVENT_RAIL || (e->type == CAROM_EVENT_RAIL_TOP && e->b < w->table->rails);

  /* its position has no seeds */
  if (rail) {
    real line[3];
    ::carom_rail_line(&w->table->rail[b], line);
    for (int k = 0; k < 3; k++)
      s->features.line[0][k] = line[k];
    take_nose(w, w->table->rail[b], &s->table.rail[0]);
  } else {
    const carom_jaw *jaw = &w->table->jaw[b];
    for (int k = 0; k < 2; k++)
      s->table.jaw[0].centre[k] = jaw->centre[k];
    s->table.jaw[0].radius = jaw->radius;
    take_nose(w, *jaw, &s->table.jaw[0]);
    take_seams(s, b);
  }
}

/* Whether the event is the landing of its ball, which has no separate event. */
bool lands(const scene *s) {
  const carom_event *e = s->event;
  const ::carom_ball_state *at = &e->before[0];
  /* over the circle, and not at its far side */
  if (e->type == CAROM_EVENT_POCKET && at->label == CAROM_BALL_AIRBORNE) {
    const carom_pocket *p = &s->w->table->pocket[e->b];
    const real x = at->r[0] - p->centre[0], y = at->r[1] - p->centre[1];
    return __builtin_sqrt(x * x + y * y) < p->radius - SIMULTANEOUS;
  }
  const real start = s->w->ball[e->a].origin_time;
  return e->type == CAROM_EVENT_SLATE ||
         (e->type == CAROM_EVENT_LEFT_TABLE && !(at->v[2] == 0 && e->time <= start) &&
          e->time >= start + s->sim.path[0].end.x - 1e-12);
}

/* The numbers of the cue, with their seeds; times and lengths have no seeds. */
CAROM_APART void load_cue(const carom_tangent_work *w, text::carom_cue *cue) {
  *cue = {};
  number *x = &cue->speed;
  for (int k = 0; k < CAROM_CUE_NUMBERS; k++) {
    x[k] = (&w->cue->speed)[k];
    load(w->pass, w->seeds->cue, k, &x[k]);
  }
  cue->tip_time = w->cue->tip_time;
  cue->follow = w->cue->follow;
}

/* The tip that continues, at the time of an event, from the middle of the struck ball; the cue,
 * with the speed that it has then. Returns what is left of its follow-through. */
CAROM_APART number tip_at(const scene *s, text::carom_cue *cue, number *along, number axes[3][3],
                          number p[3]) {
  const carom_tangent_work *w = s->w;
  const carom_tangent_tip *tip = &w->tip;
  const int64_t struck = s->event->a;
  load_cue(w, cue);
  const number arm = text::carom_arm_speed(cue, known(tip->V, tip->V_row));
  cue->speed = known(tip->V, tip->V_row);
  number since = s->event->time - tip->start_time, from[3];
  since.d[CLOCK] = 1;
  since -= known(0.0, tip->start);
  *along = known(tip->along, tip->along_row) + cue->speed * since;

  /* from where it struck */
  for (int k = 0; k < 2; k++) {
    from[k] = tip->origin[k];
    load(w->pass, w->seeds->state, struck * CAROM_STATE_NUMBERS + S_X + k, &from[k]);
  }
  from[2] = s->ball[0].kind.radius;
  for (int k = 0; k < 3; k++)
    from[k] += known(tip->moved[k], tip->moved_row[k]);
  text::carom_tip_from(cue, s->ball[0].kind.radius, from, *along, s->ball[0].state.r, axes, p);
  return known(tip->left, tip->left_row) - arm * since;
}

/* d and v of the struck ball and the tip, a point, as bodies() has them. */
CAROM_APART void to_tip(const scene *s, number d[3], number v[3]) {
  text::carom_cue cue;
  number along, axes[3][3];
  tip_at(s, &cue, &along, axes, d);
  for (int k = 0; k < 3; k++)
    v[k] = s->ball[0].state.v[k] - cue.speed * axes[0][k];
}

/* Of a ball that leaves the table in flight: how far it is from the nearest edge of the rails. No
 * flight begins beyond them: a layout there is rejected. */
CAROM_APART number edge(scene *s, const carom_ball_state *a) {
  ::carom_features f;
  ::carom_features_of(s->w->table, s->w->ball[s->event->a].kind->radius, s->w->reference, &f);
  number nearest = INFINITY;
  for (int side = 0; side < 4; side++) {
    const number gap = a->r[side / 2] - (f.hull[side] + (side % 2 == 0 ? -f.width : f.width));
    nearest = fabs(gap).x < fabs(nearest).x ? gap : nearest;
  }
  return nearest;
}

/* The distance of a ball from the line of a rail. */
number off_line(const scene *s, const carom_ball_state *a) {
  const number *line = s->features.line[0];
  return line[0] * a->r[0] + line[1] * a->r[1] + line[2];
}

/* The distance at which a ball on the cloth touches a rail, or a jaw beyond its radius. */
number reach_on_cloth(const scene *s, const number &height) {
  const text::carom_ball_kind *kind = &s->ball[0].kind;
  return s->w->opt->space == CAROM_SPACE_FLAT
             ? kind->radius
             : text::carom_reach_on_cloth(kind, height, s->features.reference);
}

/* Two round bodies that touch at an event: d from ball a to the middle of the other one, v how a
 * comes nearer to it. Returns the distance at which they touch; 0 where the event is no touch of
 * such bodies. A nose is one in the plane across it: level, and up. */
CAROM_APART number bodies(const scene *s, number d[3], number v[3]) {
  const carom_event *e = s->event;
  const carom_ball_state *a = &s->ball[0].state, *b = &s->ball[1].state;
  const text::carom_ball_kind *kind = &s->ball[0].kind;
  const bool flies = text::carom_flies(a), jaw = e->type == CAROM_EVENT_JAW;
  for (int k = 0; k < 3; k++) {
    d[k] = s->two ? b->r[k] - a->r[k] : number(0);
    v[k] = k < 2 ? a->v[k] : number(0);
    if (s->two)
      v[k] = a->v[k] - b->v[k];
  }
  if (carom_touches_again(e)) {
    to_tip(s, d, v);
    return kind->radius;
  }
  if (s->two) { /* a ball on the cloth is at the height of its radius */
    d[2] = (text::carom_flies(b) ? b->r[2] : s->ball[1].kind.radius) -
           (flies ? a->r[2] : kind->radius);
    return kind->radius + s->ball[1].kind.radius;
  }

  /* on the cloth, the circle of a jaw or a pocket */
  if (e->type == CAROM_EVENT_POCKET || (jaw && !flies)) {
    for (int k = 0; k < 2; k++)
      d[k] =
          (jaw ? s->table.jaw[0].centre[k] : number(s->w->table->pocket[e->b].centre[k])) - a->r[k];
    return jaw ? s->table.jaw[0].radius + reach_on_cloth(s, s->table.jaw[0].height)
               : number(s->w->table->pocket[e->b].radius);
  }
  if (!flies || !(jaw || e->type == CAROM_EVENT_RAIL))
    return 0.0;

  /* one that flies meets the nose itself, which is inside the wall */
  number across = off_line(s, a), out[2] = {s->features.line[0][0], s->features.line[0][1]};
  if (jaw) {
    const number x = a->r[0] - s->table.jaw[0].centre[0], y = a->r[1] - s->table.jaw[0].centre[1],
                 q = sqrt(x * x + y * y);
    across = q - s->table.jaw[0].radius;
    out[0] = x / q;
    out[1] = y / q;
  }
  const number height =
      text::carom_nose_height(kind, jaw ? s->table.jaw[0].height : s->table.rail[0].height);
  d[0] = text::carom_nose_shift(height, s->features.reference) - across;
  d[2] = height - a->r[2];
  v[0] = out[0] * a->v[0] + out[1] * a->v[1];
  v[1] = 0.0;
  v[2] = a->v[2];
  return kind->radius;
}

/* The gap whose zero is the event. */
CAROM_APART number gap(scene *s) {
  const carom_event *e = s->event;
  const carom_tangent_work *w = s->w;
  const carom_ball_state *a = &s->ball[0].state;
  number d[3], v[3];
  const number touch = bodies(s, d, v);
  if (touch.x > 0)
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - touch;
  switch (e->type) {
  case CAROM_EVENT_RAIL:
    return off_line(s, a) - reach_on_cloth(s, s->table.rail[0].height);
  case CAROM_EVENT_RAIL_TOP:
    return a->r[2] - text::carom_height_on_top(&s->sim, 0, e->b < w->table->rails ? 0 : 1);
  case CAROM_EVENT_LEFT_TABLE: /* it stops on a rail, or reaches the edge of the rails */
    return e->before[0].v[2] == 0 && e->time <= w->ball[e->a].origin_time ? a->v[2] : edge(s, a);
  default: /* the strike */
    return 0.0;
  }
}

/* How far a hit is from a miss: the distance at which bodies touch less that at which the straight
 * line along v would pass. For reach. */
CAROM_APART void note_margin(scene *s) {
  carom_tangent_work *w = s->w;
  number d[3], v[3], V2 = 0.0, along = 0.0, square = 0.0;
  const number touch = bodies(s, d, v);
  w->margin = INFINITY;
  if (!(touch.x > 0) ||
      (s->event->type == CAROM_EVENT_POCKET && text::carom_flies(&s->ball[0].state)))
    return;
  for (int k = 0; k < 3; k++) {
    V2 += v[k] * v[k];
    along += d[k] * v[k];
  }
  for (int k = 0; k < 3; k++) {
    const number across = d[k] - along / V2 * v[k];
    square += across * across;
  }
  const number margin = touch - sqrt(square);
  w->margin = square.x > 0 ? margin.x : (real)INFINITY;
  store(margin, w->margin_row);
}

/* ---- Flags of an event ---- */

bool is_contact(const carom_event *e) {
  return e->type == CAROM_EVENT_BALL_BALL || e->type == CAROM_EVENT_RAIL ||
         e->type == CAROM_EVENT_JAW || carom_touches_again(e);
}

bool ends_phase(const carom_event *e) {
  return e->type >= CAROM_EVENT_SLIDING_ROLLING && e->type <= CAROM_EVENT_SPINNING_STATIONARY;
}

/* A contact that closes slowly, or the last hop of a ball, or nearly so: there the derivative of
 * v' grows without bound. */
CAROM_APART void note_grazing(scene *s, real rate) {
  const carom_event *e = s->event;
  const ::carom_ball_state *a = &e->before[0], *b = &e->before[1];
  bool grazes = false;
  if (is_contact(e) || (e->type == CAROM_EVENT_POCKET && !lands(s))) {
    real square = 0;
    for (int k = 0; k < (e->type == CAROM_EVENT_POCKET ? 2 : 3); k++) {
      const real v = a->v[k] - (s->two ? b->v[k] : 0);
      square += v * v;
    }
    if (carom_touches_again(e)) {
      number d[3], v[3];
      bodies(s, d, v);
      square = v[0].x * v[0].x + v[1].x * v[1].x + v[2].x * v[2].x;
    }
    grazes = __builtin_fabs(rate) < GRAZING * __builtin_sqrt(square);
  } else if (e->type == CAROM_EVENT_SLATE || e->type == CAROM_EVENT_RAIL_TOP) {
    const real rebound = ::carom_slate_restitution(s->ball[0].kind.restitution_table.x),
               v_n = -a->v[2];
    const real up = ::carom_rebound(v_n > 0 ? v_n : 0, rebound);
    grazes = GRAZING * rebound * v_n > up && ::carom_rebound((1 + GRAZING) * v_n, rebound) > 0;
  }
  s->w->note.flags |= grazes ? CAROM_TANGENT_GRAZING : 0;
}

/* Contacts so close that a small change reverses their order, or at the start so close that it
 * parts the balls. A ball that is pressed into the slate lands in the same instant, whatever
 * changes. */
CAROM_APART void note_order(scene *s, const number &g) {
  const carom_event *e = s->event;
  const bool slate = e->type == CAROM_EVENT_SLATE;
  if (!is_contact(e) && !slate && e->type != CAROM_EVENT_RAIL_TOP)
    return;
  for (int i = 0; i <= s->two; i++) {
    carom_tangent_ball *ball = &s->w->ball[s->side[i]];
    const bool at_once = slate && e->time <= ball->origin_time;
    const bool lands_now = ball->origin.label == CAROM_BALL_AIRBORNE &&
                           ball->origin_time + s->sim.path[i].end.x - e->time < SIMULTANEOUS;
    if ((e->time - ball->last_contact < SIMULTANEOUS && !at_once) || (!slate && lands_now))
      s->w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
    ball->last_contact = e->time;
  }
  if (is_contact(e) && e->time < SIMULTANEOUS)
    for (int j = 0; j < s->w->pass.columns; j++)
      if (__builtin_fabs(g.d[j]) > 1e-100)
        s->w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
}

/* ---- The states after an event ---- */

/* Whether the phases of a raised strike are others where the time of the tip or the elevation
 * changes by a thousandth. There a derivative changes. */
bool phases_change(const scene *s) {
  const carom_tangent_work *w = s->w;
  const ::carom_ball_kind *kind = w->ball[s->event->a].kind;
  unsigned course = 0;
  bool change = false;
  for (int k = 0; k < 5; k++) {
    ::carom_cue cue = *w->cue;
    ::carom_motion motion;
    ::carom_ball_state state = {};
    ::carom_raised raised;
    const real off = k == 0 ? 0 : 1e-3, scale = k % 2 == 0 ? 1 + off : 1 - off;
    if (k <= 2)
      cue.tip_time = scale * ::carom_tip_time(&cue);
    else
      cue.theta = __builtin_fmin(scale * cue.theta, 90);
    ::carom_strike_motion(&cue, kind, CAROM_STRIKE_IN_SPACE, &motion);
    memcpy(state.v, motion.v, sizeof state.v);
    memcpy(state.w, motion.w, sizeof state.w);
    ::carom_push_alone(kind, &cue, &state, &raised);
    course = k == 0 ? raised.course : course;
    change |= raised.course != course;
  }
  return change;
}

CAROM_APART text::carom_status strike(scene *s) {
  carom_tangent_work *w = s->w;
  text::carom_cue cue;
  load_cue(w, &cue);

  /* a level cue that a change raises is raised as little as counts now */
  const bool flat = w->opt->space == CAROM_SPACE_FLAT,
             level = !flat && !::carom_is_raised(w->cue) && text::changes(cue.theta);
  if (level)
    cue.theta.x = CAROM_LEAST_ELEVATION;
  text::carom_motion motion;
  const text::carom_status status = text::carom_strike_motion(
      &cue, &s->ball[0].kind, flat ? text::CAROM_STRIKE_ON_CLOTH : text::CAROM_STRIKE_IN_SPACE,
      &motion);
  if (status < 0)
    return status;

  /* the cue continues */
  const text::carom_ball_kind *kind = &s->ball[0].kind;
  carom_ball_state *state = &s->ball[0].state;
  text::carom_raised raised = {};
  raised.lead =
      cue.speed * text::carom_linear_lag(text::carom_tip_time(&cue), text::carom_tip_of(&cue));
  raised.V = cue.speed - kind->mass / cue.mass * text::carom_strike_speed(&cue, kind);
  memcpy(state->v, motion.v, sizeof motion.v);
  memcpy(state->w, motion.w, sizeof motion.w);

  /* a strike that goes down presses the ball on the slate, or lands at once */
  const bool down = !flat && cue.theta.x >= CAROM_LEAST_ELEVATION;
  if (down && w->cue->tip_time >= 0) {
    if (!text::carom_push_alone(kind, &cue, state, &raised))
      return text::CAROM_ERROR_TANGENT;
    w->note.flags |= !level && phases_change(s) ? CAROM_TANGENT_KINK : 0;
    const real v = raised.leaves.x;
    if (v > 0 && ::carom_rebound(v, 1) < GRAZING * v && ::carom_rebound((1 + GRAZING) * v, 1) > 0)
      w->note.flags |= CAROM_TANGENT_GRAZING;
  } else if (level) {
    text::carom_hit_slate(kind, state);
  }
  w->note.flags |= level ? CAROM_TANGENT_KINK : 0;
  w->tip.V = raised.V.x;
  store(raised.V, w->tip.V_row);
  w->tip.along = raised.lead.x;
  store(raised.lead, w->tip.along_row);
  w->tip.left = w->cue->follow - raised.lead.x;
  store(-raised.lead, w->tip.left_row);
  return text::CAROM_OK;
}

/* The difference of the values from the shot's, over the largest of them. */
real apart(const ::carom_ball_state *played, carom_ball_state *s) {
  real off = 0, most = 0;
  for (int k = 0; k < 3; k++) {
    off = __builtin_fmax(off, __builtin_fmax(__builtin_fabs(s->v[k].x - played->v[k]),
                                             __builtin_fabs(s->w[k].x - played->w[k])));
    most = __builtin_fmax(
        most, __builtin_fmax(__builtin_fabs(played->v[k]), __builtin_fabs(played->w[k])));
  }
  return off / most;
}

/* A cushion. Where the exact model rejects an impact a shot takes it in steps; the derivatives of
 * the impact may be known all the same, but belong to another motion. */
CAROM_APART text::carom_status meet_cushion(scene *s) {
  const text::carom_due due = {s->event->time, s->event->type, 0, 0};
  const carom_ball_state before = s->ball[0].state;
  text::carom_status status = text::carom_resolve(&s->sim, &due, &s->ball[0].state, nullptr);
  if (s->w->opt->cushion_model != CAROM_SHOT_CUSHION_MATHAVAN ||
      !(status < 0 || apart(&s->event->after[0], &s->ball[0].state) > 1e-6))
    return status;
  const carom_ball_state exact = s->ball[0].state;
  const carom_tangent_note note = watched.note;
  s->ball[0].state = before;
  s->opt.cushion_model = text::CAROM_SHOT_CUSHION_EULER;
  s->sim.slow_instants = s->w->slow_instants;
  s->sim.slow_last = s->w->slow_last;
  const text::carom_status in_steps =
      text::carom_resolve(&s->sim, &due, &s->ball[0].state, nullptr);
  carom_ball_state first = exact;
  if (status >= 0 && (in_steps < 0 || apart(&s->event->after[0], &s->ball[0].state) >
                                          apart(&s->event->after[0], &first))) {
    s->ball[0].state = exact;
    watched.note = note;
    return status;
  }
  return in_steps;
}

CAROM_APART text::carom_status meet_ball(scene *s) {
  const text::carom_due due = {s->event->time, s->event->type, 0, 1};
  return text::carom_resolve(&s->sim, &due, &s->ball[0].state, &s->ball[1].state);
}

text::carom_status resolve(scene *s) {
  const carom_event *e = s->event;
  carom_ball_state *a = &s->ball[0].state;
  switch (e->type) {
  case CAROM_EVENT_STRIKE:
    return strike(s);
  case CAROM_EVENT_BALL_BALL:
    return meet_ball(s);
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    return meet_cushion(s);
  case CAROM_EVENT_SLATE:
  case CAROM_EVENT_RAIL_TOP:
    text::carom_hit_slate(&s->ball[0].kind, a);
    return text::CAROM_OK;
  case CAROM_EVENT_POCKET:
    memset(a, 0, sizeof *a);
    return text::CAROM_OK;
  case CAROM_EVENT_LEFT_TABLE:
    memset(a->v, 0, sizeof a->v);
    memset(a->w, 0, sizeof a->w);
    return text::CAROM_OK;
  default:
    text::carom_path_end(&s->sim.path[0], &s->sim.rates[0], a);
    return text::CAROM_OK;
  }
}

/* Derivatives that the label of a state leaves. */
CAROM_APART void settle(const text::carom_ball_kind *kind, carom_ball_state *s) {
  const int64_t label = s->label;
  if (label == CAROM_BALL_AIRBORNE)
    return;
  s->v[2].d = row{};
  if (!text::carom_is_out(label))
    s->r[2].d = kind->radius.d;
  if (label == CAROM_BALL_ROLLING) {
    const number &R = kind->radius;
    s->v[0].d -= 2.0 / 7.0 * (s->v[0] - R * s->w[1]).d;
    s->v[1].d -= 2.0 / 7.0 * (s->v[1] + R * s->w[0]).d;
    s->w[0].d = (-s->v[1] / R).d;
    s->w[1].d = (s->v[0] / R).d;
  } else if (label != CAROM_BALL_SLIDING) {
    for (int k = 0; k < 3; k++) {
      s->v[k].d = row{};
      if (k < 2 || label != CAROM_BALL_SPINNING)
        s->w[k].d = row{};
    }
  }
}

/* Puts ball i where its path begins, at a time. */
CAROM_APART void put(carom_tangent_work *w, int i, const ::carom_ball_state &played, real time,
                     const row &dT, carom_ball_state *s) {
  carom_tangent_ball *ball = &w->ball[i];
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    unload(w->pass, number_of(s, k), w->tangent->final, (int64_t)i * CAROM_STATE_NUMBERS + k);
  memcpy(ball->start, &dT, sizeof dT);
  ball->origin = played;
  ball->origin_time = time;
}

/* The options of a shot, but when it stops. */
void copy(const carom_tangent_work *w, text::carom_shot_options *to) {
  *to = {};
#define COPY(member, ...) to->member = (decltype(to->member))w->opt->member;
  CAROM_MOTION_OPTIONS(COPY)
  CAROM_COMPUTE_OPTIONS(COPY)
#undef COPY
}

/* The data that all events share. */
void begin_scene(carom_tangent_work *w, scene *s) {
  s->w = w;
  copy(w, &s->opt);
  memset(&s->rules, 0, sizeof s->rules);
  s->sim.rules = &s->rules;
  s->sim.table = &s->table;
  s->sim.features = &s->features;
  s->sim.layout = &s->layout;
  for (int k = 0; k < 2; k++)
    s->layout.kind[k] = &s->ball[k].kind;
  s->sim.opt = &s->opt;
  s->sim.count = 2;
}

/* The balls of an event at its time, which is fixed, and its part of the table. */
CAROM_APART void begin_event(carom_tangent_work *w, const carom_event *e, scene *s) {
  begin_scene(w, s);
  s->event = e;
  s->two = e->type == CAROM_EVENT_BALL_BALL;
  s->side[0] = e->a;
  s->side[1] = e->b;
  if (e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW || e->type == CAROM_EVENT_RAIL_TOP)
    take_part(s);
  for (int i = 0; i <= s->two; i++) {
    begin_ball(w, s->side[i], i, s);
    state_at(w, s->side[i], i, e->time, s, &s->ball[i].state);
  }
}

/* ---- A cluster ---- */

struct member {
  int ball;
  const carom_event *event; /* its first one, */
  int side;                 /* and which of the two it is there */
};
struct cluster {
  carom_tangent_work *w;
  int direction, count;
  bool on_slate;           /* it is pushed by a raised cue */
  bool again;              /* by a further touch of the tip */
  const carom_event *nose; /* that the struck ball touches too, or null: its plane, and the arm */
  number normal[3], gap, slowest;
  number cue[CAROM_TIP_NUMBERS];
  double apart, most; /* differences from the values of the shot, and the largest of these */
  member members[CAROM_BALLS_MOST];
  const carom_tangent_cluster *task;
  bool in_turn; /* turn[] is read: members as successive touches leave them, */
  struct {
    real x[CAROM_MOTION_NUMBERS], d[CAROM_MOTION_NUMBERS]; /* v, w, shift; in this direction */
  } turn[text::CAROM_CLUSTER_IN_TURN];
  /* the impulses of successive touches, in this direction */
  real touch[text::CAROM_TURN_TOUCHES], touch_rate[text::CAROM_TURN_TOUCHES];
};

/* The balls of the events of a cluster, in the caller's order. */
void find_members(carom_tangent_work *w, const carom_event *events, int count, cluster *c) {
  c->w = w;
  c->count = 0;
  memset(c->cue, 0, sizeof c->cue);
  c->apart = c->most = 0;
  c->again = false;
  c->nose = nullptr;
  for (int k = 0; k < count; k++) {
    c->again |= carom_touches_again(&events[k]);
    if (carom_is_nose(&events[k]))
      c->nose = &events[k];
  }
  for (int i = 0; i < w->count; i++)
    for (int k = 0; k < count; k++)
      if (events[k].a == i || (events[k].type == CAROM_EVENT_BALL_BALL && events[k].b == i)) {
        c->members[c->count++] = {i, &events[k], events[k].a == i ? 0 : 1};
        break;
      }
}
/* -1 of none. */
int place_of(const cluster *c, int ball) {
  int k = 0;
  if (ball < 0)
    return -1;
  while (c->members[k].ball != ball)
    k++;
  return k;
}

/* The cue that pushes: at the start the caller's; of a further touch with the speed that is left,
 * at the position that it touches. */
CAROM_APART void take_cue(const scene *s, const row &dT, cluster *c) {
  carom_tangent_tip *tip = &s->w->tip;
  text::carom_cue cue;
  load_cue(s->w, &cue);
  c->slowest = CAROM_SLOWEST_ARM * cue.speed;
  if (!c->again) {
    for (int j = 0; j < s->w->pass.columns; j++)
      if (!::carom_is_raised(s->w->cue) && cue.theta.d[j] != 0 &&
          s->w->opt->space != CAROM_SPACE_FLAT)
        s->w->note.flags |= CAROM_TANGENT_KINK; /* raised it presses the balls on the slate */
  } else {
    number along, axes[3][3], p[3], on[3];
    number left = tip_at(s, &cue, &along, axes, p);
    text::carom_tip_on(axes, p, on);
    cue.a = on[1];
    cue.b = on[2];
    number *const moving[] = {&cue.a, &cue.b, &along, &left, &p[0], &p[1], &p[2]};
    for (number *x : moving)
      add_time(dT, x);
    memcpy(c->cue + CAROM_CUE_NUMBERS, p, sizeof p);
    tip->along = along.x;
    store(along, tip->along_row);
    tip->left = left.x;
    store(left, tip->left_row);
    tip->touch_left = left.x;
    store(left, tip->touch_left_row);
    tip->start_time = s->event->time;
    memcpy(tip->start, &dT, sizeof dT);
  }
  memcpy(c->cue, &cue.speed, CAROM_CUE_NUMBERS * sizeof *c->cue);
}

/* The plane of the nose of a scene, as the shot has it. */
void take_nose_plane(scene *s, bool touches, cluster *c) {
  const text::carom_due due = {s->event->time, s->event->type, 0, 0};
  text::carom_push_nose nose = {};
  s->sim.struck = 0;
  text::carom_nose_of_part(&s->sim, &s->ball[0].state, &due, &nose);
  for (int k = 0; k < 3; k++)
    c->normal[k] = nose.normal[k];
  c->gap = touches ? number(0) : nose.gap;
}

CAROM_APART void find_nose(carom_tangent_work *w, const carom_event *first, const row &dT,
                           cluster *c) {
  scene s;
  begin_event(w, c->nose, &s);
  add_time(dT, &s.ball[0].state);
  set(first->before[0], &s.ball[0].state);
  take_nose_plane(&s, first == c->nose, c);
}

/* The derivatives of the time of the contact that starts a cluster, and its own two balls, which
 * close. */
CAROM_APART row begin_cluster(carom_tangent_work *w, const carom_event *e, cluster *c) {
  scene s;
  begin_event(w, e, &s);
  if (e->type == CAROM_EVENT_STRIKE && !c->again) { /* at time 0, of a ball at rest */
    take_cue(&s, row{}, c);
    store_state(&s.ball[0].state, w->approach[0]);
    return row{};
  }
  const number g = gap(&s);
  row dT = g.d / -g.d[CLOCK];
  dT[CLOCK] = 0;
  note_grazing(&s, g.d[CLOCK]);
  note_order(&s, g);
  if (c->again)
    take_cue(&s, dT, c);
  if (c->nose != nullptr)
    find_nose(w, e, dT, c);
  for (int i = 0; i <= s.two; i++) {
    add_time(dT, &s.ball[i].state);
    set(e->before[i], &s.ball[i].state);
    store_state(&s.ball[i].state, w->approach[i]);
  }
  if (w->tangent->reach != nullptr)
    note_margin(&s);
  return dT;
}

/* Takes a member to the time of its cluster. */
CAROM_APART void arrive(carom_tangent_work *w, const member *m, const row &dT, bool starts) {
  scene s;
  carom_tangent_ball *ball = &w->ball[m->ball];
  carom_ball_state *state = &s.ball[0].state;
  begin_ball(w, m->ball, 0, &s);
  state_at(w, m->ball, 0, m->event->time, &s, state);
  add_time(dT, state);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    unload(w->pass, number_of(state, k), w->tangent->final,
           (int64_t)m->ball * CAROM_STATE_NUMBERS + k);
  if (!starts && m->event->time - ball->last_contact < SIMULTANEOUS)
    w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
  ball->last_contact = m->event->time;
}

CAROM_APART void load_member(const carom_tangent_work *w, int i, const ::carom_ball_state &played,
                             text::carom_ball_kind *kind, carom_ball_state *s) {
  load_kind(w, i, kind);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    load(w->pass, w->tangent->final, (int64_t)i * CAROM_STATE_NUMBERS + k, &number_of(s, k));
  set(played, s);
}

/* A further contact of balls that touch already, of which a change opens the gap. */
CAROM_APART void note_gap(const cluster *c, const carom_event *e) {
  carom_tangent_work *w = c->w;
  text::carom_ball_kind kind[2];
  carom_ball_state s[2];
  for (int side = 0; side < 2; side++) { /* as they reach their first contact */
    const member *m = &c->members[place_of(c, side == 0 ? e->a : e->b)];
    load_member(w, m->ball, m->event->before[m->side], &kind[side], &s[side]);
  }
  number square = 0.0;
  for (int k = 0; k < 3; k++)
    square += (s[1].r[k] - s[0].r[k]) * (s[1].r[k] - s[0].r[k]);
  const number g = sqrt(square) - kind[0].radius - kind[1].radius;
  for (int j = 0; g.x < SIMULTANEOUS && j < w->pass.columns; j++)
    if (__builtin_fabs(g.d[j]) > 1e-100)
      w->note.flags |= CAROM_TANGENT_SIMULTANEOUS;
}

void give_cue(void *context, real x[CAROM_TIP_NUMBERS], real d[CAROM_TIP_NUMBERS]) {
  const cluster *c = (const cluster *)context;
  for (int n = 0; n < CAROM_TIP_NUMBERS; n++) {
    x[n] = c->cue[n].x;
    d[n] = c->cue[n].d[c->direction];
  }
}

number in_direction(const cluster *c, real x, real rate) {
  number result = x;
  result.d[c->direction] = rate;
  return result;
}

/* What the cushion leaves of a motion of the struck ball. */
bool give_model(void *context, const real x[CAROM_MOTION_NUMBERS],
                const real d[CAROM_MOTION_NUMBERS], real out[6], real rate[6]) {
  const cluster *c = (const cluster *)context;
  scene s;
  begin_event(c->w, c->nose, &s);
  carom_ball_state *state = &s.ball[0].state;
  const number &R = s.ball[0].kind.radius;
  for (int k = 0; k < 3; k++) {
    state->r[k] = in_direction(c, x[k], d[k]);
    state->v[k] = in_direction(c, x[3 + k], d[3 + k]);
    state->w[k] = in_direction(c, x[6 + k], d[6 + k]) / R;
  }
  state->label = c->members[place_of(c, c->nose->a)].event->before[0].label;
  s.sim.time = c->nose->time;
  s.sim.slow_instants = c->w->slow_instants;
  s.sim.slow_last = c->w->slow_last;
  const text::carom_due due = {c->nose->time, c->nose->type, 0, 0};
  if (text::carom_resolve(&s.sim, &due, state, nullptr) < 0)
    return false;
  for (int k = 0; k < 3; k++) {
    const number W = state->w[k] * R;
    out[k] = state->v[k].x;
    rate[k] = state->v[k].d[c->direction];
    out[3 + k] = W.x;
    rate[3 + k] = W.d[c->direction];
  }
  return true;
}

bool give(void *context, int k, real x[CAROM_MEMBER_NUMBERS + 1],
          real d[CAROM_MEMBER_NUMBERS + 1]) {
  const cluster *c = (const cluster *)context;
  const member *m = &c->members[k];
  text::carom_ball_kind kind;
  carom_ball_state s;
  load_member(c->w, m->ball, m->event->before[m->side], &kind, &s);
  text::carom_shot_options opt;
  copy(c->w, &opt);
  const text::carom_cluster_ball ball =
      text::member_of(&kind, &s, &opt, text::carom_flies(&s), m->ball);
  const number *from = ball.r;
  for (int n = 0; n < CAROM_MEMBER_NUMBERS; n++) {
    x[n] = from[n].x;
    d[n] = from[n].d[c->direction];
  }
  const number slate = text::carom_slate_under(&kind);
  x[CAROM_MEMBER_NUMBERS] = slate.x;
  d[CAROM_MEMBER_NUMBERS] = slate.d[c->direction];
  return ball.flies;
}

/* The members after their successive touches, as in shot/clusters.c. */
CAROM_APART void take_in_turn(cluster *c) {
  carom_tangent_work *w = c->w;
  scene s;
  begin_scene(w, &s);
  s.sim.slow_instants = w->slow_instants;
  carom_ball_state state[text::CAROM_CLUSTER_IN_TURN], before;
  number since[text::CAROM_CLUSTER_IN_TURN], energy = 0, touched = 0, started = 0;
  text::carom_ball_kind *const kind[2] = {&s.ball[0].kind, &s.ball[1].kind};
  for (int k = 0; k < c->count; k++) {
    const member *m = &c->members[k];
    load_member(w, m->ball, m->event->before[m->side], kind[0], &state[k]);
    energy += text::carom_energy_in_turn(kind[0], &state[k]);
    since[k] = 0;
  }

  for (int t = 0; t < c->task->touches; t++) {
    const int8_t *two = c->task->touch[t];
    for (int side = 0; side < 2; side++)
      load_kind(w, c->members[two[side]].ball, kind[side]);
    const text::carom_due pair = {0, CAROM_EVENT_BALL_BALL, 0, 1};
    number impulse = 0, times[2] = {since[two[0]], since[two[1]]};
    text::carom_touch_in_turn(&s.sim, &pair, &state[two[0]], &state[two[1]], c->task->duration,
                              times, &impulse);
    c->touch[t] = impulse.x;
    c->touch_rate[t] = impulse.d[c->direction];
    for (int side = 0; side < 2; side++)
      since[two[side]] = times[side];
  }

  for (int k = 0; k < c->count; k++) {
    load_kind(w, c->members[k].ball, kind[0]);
    carom_ball_state start = state[k], slowed = state[k];
    text::carom_start_in_turn(kind[0], since[k], 0, &start);
    touched += text::carom_energy_in_turn(kind[0], &start);
    text::carom_start_in_turn(kind[0], since[k], 1, &slowed);
    started += text::carom_energy_in_turn(kind[0], &slowed);
  }
  const number share = text::carom_share_in_turn(energy, touched, started);
  for (int k = 0; k < c->count; k++) {
    const member *m = &c->members[k];
    load_member(w, m->ball, m->event->before[m->side], kind[0], &before);
    text::carom_start_in_turn(kind[0], since[k], share, &state[k]);
    for (int n = 0; n < CAROM_MOTION_NUMBERS; n++) {
      const number *const of[] = {state[k].v, state[k].w, state[k].r};
      const number x = n < 6 ? of[n / 3][n % 3] : of[2][n - 6] - before.r[n - 6];
      c->turn[k].x[n] = x.x;
      c->turn[k].d[n] = x.d[c->direction];
    }
  }
}

/* How far the successive touches agree with the integrator, as in shot/clusters.c. */
number agreement_in_turn(const cluster *c) {
  const carom_tangent_cluster *task = c->task;
  number most = 0, difference = 0;
  for (int t = 0; t < task->touches; t++) {
    /* all touches of one contact together */
    const number size = in_direction(c, task->impulse[t], task->impulse_rate[t]);
    number impulse = 0;
    for (int other = 0; other < task->touches; other++)
      if (task->touch[other][0] == task->touch[t][0] && task->touch[other][1] == task->touch[t][1])
        impulse += in_direction(c, c->touch[other], c->touch_rate[other]);
    most = text::carom_greater(most, size);
    difference = text::carom_greater(difference, fabs(impulse - size));
  }
  return text::carom_agreement_in_turn(difference, most);
}

void take(void *context, int k, const real x[CAROM_MOTION_NUMBERS + 1],
          const real d[CAROM_MOTION_NUMBERS + 1]) {
  static const int row_of[CAROM_MOTION_NUMBERS] = {S_V_X, S_V_Y, S_V_Z, S_W_X, S_W_Y,
                                                   S_W_Z, S_X,   S_Y,   S_Z};
  cluster *c = (cluster *)context;
  if (c->task->separation > 0 && !c->in_turn)
    return; /* it is solved again, with turn[] */
  const carom_tangent_work *w = c->w;
  const int i = c->members[k].ball;
  const ::carom_ball_state *after = &c->members[k].event->after[c->members[k].side];
  text::carom_ball_kind kind;
  load_kind(w, i, &kind);
  carom_ball_state s = {};
  number *to[CAROM_MOTION_NUMBERS] = {&s.v[0], &s.v[1], &s.v[2], &s.w[0], &s.w[1],
                                      &s.w[2], &s.r[0], &s.r[1], &s.r[2]};
  for (int n = 0; n < CAROM_MOTION_NUMBERS; n++) {
    to[n]->x = x[n];
    to[n]->d[c->direction] = d[n];
    if (n >= 3 && n < 6)
      *to[n] /= kind.radius;
  }
  if (c->in_turn) {
    const number share =
        in_direction(c, c->task->separation, c->task->separation_rate) * agreement_in_turn(c);
    for (int n = 0; n < CAROM_MOTION_NUMBERS; n++)
      *to[n] += share * (in_direction(c, c->turn[k].x[n], c->turn[k].d[n]) - *to[n]);
  }
  if (c->on_slate) {
    number J = x[CAROM_MOTION_NUMBERS];
    J.d[c->direction] = d[CAROM_MOTION_NUMBERS];
    text::carom_leave_slate(&kind, J / kind.mass, &s);
  }
  for (int n = 0; n < CAROM_MOTION_NUMBERS; n++) {
    const int64_t at = (int64_t)i * CAROM_STATE_NUMBERS + row_of[n];
    real *rate = &carom_tangent_columns(&w->pass, w->tangent->final, at)[c->direction];
    if (n >= 6) { /* a shift, for positions that are known to a rounding error */
      *rate += to[n]->d[c->direction];
      continue;
    }
    *rate = to[n]->d[c->direction];
    if (n == 2) /* the label may end it */
      continue;
    const real scale = n < 3 ? 1 : kind.radius.x,
               played = scale * (n < 3 ? after->v[n] : after->w[n - 3]);
    c->apart = __builtin_fmax(c->apart, __builtin_fabs(scale * to[n]->x - played));
    c->most = __builtin_fmax(c->most, __builtin_fabs(played));
  }
}

/* Each direction through the cluster. A motion that is not the one that was played has other
 * derivatives. */
CAROM_APART bool solve_cluster(cluster *c, const carom_event *first) {
  carom_tangent_work *w = c->w;
  const int64_t steps = w->opt->cluster_steps;
  carom_tangent_cluster task = {
      .balls = c->count,
      .first = place_of(c, first->a),
      .second = first->type == CAROM_EVENT_BALL_BALL ? place_of(c, first->b) : -1,
      .steps = steps > 0 ? (real)steps : (real)text::CAROM_CLUSTER_STEPS,
      .slow = text::carom_slow_speed(w->slow_instants).x,
      .friction = (int)w->opt->friction,
      .on_slate = c->on_slate,
      .tip_time = w->cue != nullptr ? ::carom_tip_time(w->cue) : 0,
      .reach = 0,
      .reach_rate = 0,
      .slowest = c->slowest.x,
      .slowest_rate = 0,
      .tip_friction = c->again ? ::carom_tip_friction(w->cue) : 0,
      .nose_near = c->nose != nullptr,
      .in_nose = c->nose == first,
      .normal = {c->normal[0].x, c->normal[1].x, c->normal[2].x},
      .normal_rate = {},
      .gap = c->gap.x,
      .gap_rate = 0,
      .model = give_model,
      .give_cue = give_cue,
      .give = give,
      .take = take,
      .context = c,
      .separation = 0,
      .separation_rate = 0,
      .duration = 0,
      .touches = 0,
      .touch = {},
      .impulse = {},
      .impulse_rate = {},
      .V = 0,
      .V_rate = 0,
      .lead = 0,
      .lead_rate = 0,
      .arm = 0,
      .arm_rate = 0,
      .moved = {},
      .moved_rate = {}};
  c->task = &task;
  carom_tangent_tip *tip = &w->tip;
  if (!c->again && w->cue != nullptr) { /* the first touch */
    tip->left = w->cue->follow;
    memset(tip->left_row, 0, sizeof tip->left_row);
  }
  const carom_tangent_tip was = *tip;
  task.reach = was.left;
  bool kink = false;
  c->in_turn = false;
  for (c->direction = 0; c->direction < w->pass.columns; c->direction++) {
    if (c->in_turn)
      take_in_turn(c);
    task.reach_rate = tip->left_row[c->direction];
    task.slowest_rate = c->slowest.d[c->direction];
    task.gap_rate = c->gap.d[c->direction];
    for (int k = 0; k < 3; k++)
      task.normal_rate[k] = c->normal[k].d[c->direction];
    if (!carom_tangent_solve_cluster(&task, &kink))
      return false;
    if (task.separation > 0 && !c->in_turn) {
      c->in_turn = true;
      c->direction--;
      continue;
    }
    if (task.second < 0) {
      tip->V = task.V;
      tip->along = was.along + task.lead;
      tip->left = was.left - task.arm;
      tip->V_row[c->direction] = task.V_rate;
      tip->along_row[c->direction] += task.lead_rate;
      tip->left_row[c->direction] -= task.arm_rate;
      for (int k = 0; k < 3; k++) {
        tip->moved[k] = was.moved[k] + task.moved[k];
        tip->moved_row[k][c->direction] += task.moved_rate[k];
      }
    }
  }
  if (kink || !(c->apart <= 1e-6 * c->most))
    w->note.flags |= CAROM_TANGENT_KINK;
  return true;
}

/* The rows of a ball where it is now become those before an event. */
void tell_before(const carom_tangent_work *w, int i, int64_t at) {
  for (int k = 0; k < CAROM_STATE_NUMBERS && w->tangent->before != nullptr; k++) {
    number x;
    load(w->pass, w->tangent->final, (int64_t)i * CAROM_STATE_NUMBERS + k, &x);
    unload(w->pass, x, w->tangent->before, at * CAROM_STATE_NUMBERS + k);
  }
}

CAROM_APART void leave(const cluster *c, const member *m, const row &dT) {
  const ::carom_ball_state &after = m->event->after[m->side];
  text::carom_ball_kind kind;
  carom_ball_state s;
  load_member(c->w, m->ball, after, &kind, &s);
  settle(&kind, &s);
  put(c->w, m->ball, after, m->event->time, dT, &s);
}

} // namespace

carom_status carom_tangent_follow_cluster(carom_tangent_work *w, const carom_event *events,
                                          int count, int64_t at) {
  cluster c;
  w->note = {CAROM_TANGENT_CLUSTER, 0};
  watched = {false, {0, 0}};
  find_members(w, events, count, &c);
  c.on_slate = w->opt->space != CAROM_SPACE_FLAT &&
               (c.again || (events[0].type == CAROM_EVENT_STRIKE && ::carom_is_raised(w->cue)));
  const row dT = begin_cluster(w, &events[0], &c);
  for (int k = 0; k < c.count; k++) {
    const member *m = &c.members[k];
    arrive(w, m, dT,
           m->ball == events[0].a ||
               (events[0].type == CAROM_EVENT_BALL_BALL && m->ball == events[0].b));
    tell_before(w, m->ball, 2 * (at + (m->event - events)) + m->side);
  }
  for (int k = 1; k < count; k++)
    if (events[k].type == CAROM_EVENT_BALL_BALL)
      note_gap(&c, &events[k]);
  if (!solve_cluster(&c, &events[0]))
    return CAROM_ERROR_TANGENT;
  for (int k = 0; k < c.count; k++)
    leave(&c, &c.members[k], dT);
  /* before their further events balls are as after the first */
  for (int k = 1; k < count; k++)
    for (int side = 0; side <= (events[k].type == CAROM_EVENT_BALL_BALL); side++) {
      const int i = side == 0 ? events[k].a : events[k].b;
      if (c.members[place_of(&c, i)].event != &events[k])
        tell_before(w, i, 2 * (at + k) + side);
    }
  memcpy(w->time, &dT, sizeof dT);
  return CAROM_OK;
}

void carom_tangent_begin(carom_tangent_work *w, int i) {
  const carom_tangent_ball *ball = &w->ball[i];
  text::carom_ball_state s;
  text::carom_ball_kind kind;
  load_kind(w, i, &kind);
  for (int k = 0; k < CAROM_STATE_NUMBERS; k++)
    load(w->pass, carom_is_out(ball->origin.label) ? nullptr : w->seeds->state,
         (int64_t)i * CAROM_STATE_NUMBERS + k, &number_of(&s, k));
  set(ball->origin, &s);
  settle(&kind, &s);
  put(w, i, ball->origin, 0, row{}, &s);
}

void carom_tangent_at(const carom_tangent_work *w, int i, double time, carom_tangent_rows d) {
  scene s;
  begin_ball(w, i, 0, &s);
  state_at(w, i, 0, time, &s, &s.ball[0].state);
  store_state(&s.ball[0].state, d);
}

double carom_tangent_gap(carom_tangent_work *w, const carom_event *e, carom_tangent_row d) {
  scene s;
  begin_event(w, e, &s);
  const number g = gap(&s);
  store(g, d);
  return g.x;
}

namespace {

/* The cue continues behind a nose that its tip has not come to, as in shot/follow_through.c. */
CAROM_APART void pass_nose(const scene *s) {
  carom_tangent_tip *tip = &s->w->tip;
  const number &R = s->ball[0].kind.radius;
  text::carom_cluster_ball ball = {};
  text::carom_cluster_nose nose = {};
  text::carom_cue cue;
  number v[3], W[3], moved[3];
  for (int k = 0; k < 3; k++) {
    ball.v[k] = known(s->event->before[0].v[k], s->w->approach[0][S_OF_V[k]]);
    ball.W[k] = known(s->event->before[0].w[k], s->w->approach[0][S_OF_W[k]]) * R;
    v[k] = s->ball[0].state.v[k];
    W[k] = s->ball[0].state.w[k] * R;
  }
  if (!text::nose_of(&ball, v, W, &nose))
    return;
  load_cue(s->w, &cue);
  const number V = known(tip->V, tip->V_row), lasts = text::nose_lasts(&nose),
               along = known(tip->along, tip->along_row) + V * lasts,
               left = known(tip->left, tip->left_row) - text::carom_arm_speed(&cue, V) * lasts;
  text::nose_moves(&nose, ball.v, lasts, moved);
  tip->along = along.x;
  store(along, tip->along_row);
  tip->left = left.x;
  store(left, tip->left_row);
  for (int k = 0; k < 3; k++) {
    const number to = known(tip->moved[k], tip->moved_row[k]) - moved[k];
    tip->moved[k] = to.x;
    store(to, tip->moved_row[k]);
  }
}

} // namespace

carom_status carom_tangent_follow(carom_tangent_work *w, const carom_event *e) {
  scene s;
  begin_event(w, e, &s);
  w->note = {0, 0};
  watched = {false, {0, 0}};

  /* the derivatives of the time of the event */
  row dT = {};
  if (ends_phase(e) || lands(&s)) {
    dT = s.sim.path[0].end.d;
  } else {
    const number g = gap(&s);
    if (g.d[CLOCK] != 0)
      dT = g.d / -g.d[CLOCK];
    note_grazing(&s, g.d[CLOCK]);
    note_order(&s, g);
  }

  /* the states just before the event, with the values that were played */
  dT[CLOCK] = 0;
  for (int i = 0; i <= s.two; i++) {
    add_time(dT, &s.ball[i].state);
    set(e->before[i], &s.ball[i].state);
    store_state(&s.ball[i].state, w->approach[i]);
  }
  if (w->tangent->reach != nullptr)
    note_margin(&s);

  /* a landing is on the slate exactly, at the speed of its fall */
  if (e->type == CAROM_EVENT_SLATE) {
    text::carom_path_land(&s.sim.path[0], &s.sim.rates[0], s.sim.path[0].end, &s.ball[0].state);
    set(e->before[0], &s.ball[0].state);
    note_grazing(&s, 0);
    note_order(&s, 0.0);
  }
  if ((e->type == CAROM_EVENT_SLATE || e->type == CAROM_EVENT_RAIL_TOP) && !(e->before[0].v[2] < 0))
    w->note.flags |= CAROM_TANGENT_KINK;

  /* the contact, which marks the instant of a slow one by the time that it leaves */
  s.sim.time = e->time;
  s.sim.time.d[CLOCK] = 1;
  s.sim.slow_instants = w->slow_instants;
  s.sim.slow_last = w->slow_last;

  const bool raised =
      s.two && (text::changes(s.ball[0].state.v[2]) || text::changes(s.ball[1].state.v[2]) ||
                text::changes(s.ball[1].state.r[2] - s.ball[0].state.r[2]));

  /* the sources of the shot report kinks while they are watched */
  watched.on = is_contact(e) || e->type == CAROM_EVENT_SLATE || e->type == CAROM_EVENT_RAIL_TOP;
  const text::carom_status status = resolve(&s);
  watched.on = false;
  if (status < 0)
    return CAROM_ERROR_TANGENT;

  const bool slow = s.sim.slow_last.d[CLOCK] == 1;
  w->slow_instants = s.sim.slow_instants;
  w->slow_last = s.sim.slow_last.x;
  w->note.flags |= watched.note.flags | (slow ? CAROM_TANGENT_SLOW : 0);
  w->note.error = watched.note.error;

  /* a ball without vertical speed but for rounding stays on the cloth, though a change would
   * lift it */
  const bool in_space = s.two && (e->before[0].label == CAROM_BALL_AIRBORNE ||
                                  e->before[1].label == CAROM_BALL_AIRBORNE ||
                                  w->ball[e->a].kind->radius != w->ball[e->b].kind->radius);
  if (in_space && !slow && raised &&
      (e->after[0].label != CAROM_BALL_AIRBORNE || e->after[1].label != CAROM_BALL_AIRBORNE))
    w->note.flags |= CAROM_TANGENT_KINK;

  /* of two equal balls on the cloth the one that becomes larger is lifted, the other pressed
   * down */
  if (s.two && !in_space && text::changes(s.ball[1].kind.radius - s.ball[0].kind.radius))
    w->note.flags |= CAROM_TANGENT_KINK;

  if (carom_is_nose(e) && w->cue != nullptr && e->a == w->cue->ball)
    pass_nose(&s);

  /* the paths from here on */
  for (int i = 0; i <= s.two; i++) {
    set(e->after[i], &s.ball[i].state);
    settle(&s.ball[i].kind, &s.ball[i].state);
    put(w, s.side[i], e->after[i], e->time, dT, &s.ball[i].state);
  }
  memcpy(w->time, &dT, sizeof dT);
  return CAROM_OK;
}

carom_status carom_tangent_of_balls(const carom_impact *in, const carom_options *opt,
                                    const carom_tangent_pass *pass, const double *seeds,
                                    double *tangent, carom_tangent_note *note) {
  text::carom_impact impact;
  text::carom_options options = {};
  text::carom_result out;
  load_struct(*pass, in, seeds, &impact);
  options.plain = opt->plain;
  watched = {true, *note};
  const text::carom_status status = text::carom_collide(&impact, &options, &out);
  watched.on = false;
  *note = watched.note;
  const number *x = reinterpret_cast<const number *>(&out);
  for (int k = 0; k < (int)(sizeof out / sizeof *x) && status == text::CAROM_OK; k++)
    unload(*pass, x[k], tangent, k);
  return (carom_status)status;
}

carom_status carom_tangent_of_cushion(const carom_cushion_impact *in,
                                      const carom_cushion_options *opt,
                                      const carom_tangent_pass *pass, const double *seeds,
                                      double *tangent, carom_tangent_note *note) {
  text::carom_cushion_impact impact;
  text::carom_cushion_options options = {};
  text::carom_motion out;
  load_struct(*pass, in, seeds, &impact);
#define COPY(member, ...) options.member = (decltype(options.member))opt->member;
  CAROM_RAIL_OPTIONS(COPY)
  CAROM_NUMBERS(CAROM_NO_ROW, COPY)
#undef COPY
  watched = {true, *note};
  const text::carom_status status = text::carom_cushion(&impact, &options, &out);
  watched.on = false;
  *note = watched.note;
  const number *x = reinterpret_cast<const number *>(&out);
  for (int k = 0; k < (int)(sizeof out / sizeof *x) && status >= 0; k++)
    unload(*pass, x[k], tangent, k);
  return (carom_status)status;
}
