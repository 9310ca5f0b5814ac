/* The kind of a jump. The events of both shots are followed as long as they agree. The first that
 * do not give the kind its name, with X and Y the tip, a ball, a cushion, the slate, or the top of
 * a cushion:
 *
 *     after X          the states before X agree, and those behind it do not
 *     X alone          one shot alone has the contact X, which changes the motion of its balls
 *     slow X           the same two, where X changes a speed by no more than slow contacts do
 *     end of X         X alone, at the very end of a rail
 *     X or Y           another contact of the same ball at the same instant
 *     order of X, Y    both have both, at one instant
 *     split of X       X is part of clusters that differ in size
 *     split of X at Y  the same, where the balls meet Y within `meanwhile`
 *     level tip        the cue is level in one shot alone
 *     unseen before X  states differ before X, behind events that agree
 *     pinched ball     the struck ball has met the tip and a cushion just before
 *     raised tip       a kind of the tip, under a raised cue
 *
 * A contact that one shot has alone and that changes nothing explains nothing: a ball that just
 * touches gets no impulse. Explained is what an event makes: it comes just before the stop of the
 * shot, or just behind; a ball falls into a pocket or leaves the table, or stays; the tip touches
 * just before the end of the follow-through, or just does not. */
#include "jumps.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double agreement = 2e-7;     /* of states at events, m/s and m */
static const double nothing = 1e-5;       /* m/s: what a contact that only touches changes */
static const double slow_level = 2.5e-3;  /* m/s: what slow contacts change (resolve.c), */
static const double slow_on_top = 2.1e-2; /* and those of flying balls */
static const double instant = 1e-9;       /* s */
static const double before_stop = 1e-7;   /* s */
static const double meanwhile = 1e-3;     /* s: the duration of tip and slate, about */
static const double further = 1e-9;       /* of the follow-through */
static const double at_end = 1e-6;        /* of the length of a rail */

bool recipe_play(const recipe *r, played *p) {
  static _Thread_local recipe_layout l;
  carom_shot shot = {.events = p->event, .room = JUMP_ROOM, .final = p->final};
  recipe_lay(r, &l);
  const carom_status status = carom_shoot(&l.table, l.ball, l.count, &l.cue, &l.options, &shot);
  p->count = (int)shot.count;
  return status >= 0 && shot.count <= JUMP_ROOM;
}

/* ---- What differs */

static bool is_out(const carom_ball_state *s) {
  return s->label == CAROM_BALL_POCKETED || s->label == CAROM_BALL_OFF;
}

static void compare(const carom_ball_state *s, const carom_ball_state *q, difference *d) {
  static const double R = 0.028575;
  if (is_out(s) || is_out(q))
    return;
  for (int axis = 0; axis < 3; axis++) {
    d->place = fmax(d->place, fabs(s->r[axis] - q->r[axis]));
    d->speed = fmax(d->speed, fabs(s->v[axis] - q->v[axis]));
    d->speed = fmax(d->speed, R * fabs(s->w[axis] - q->w[axis]));
  }
}

difference final_difference(const recipe *r, const played *p, const played *q) {
  difference d = {0.0, 0.0};
  for (int k = 0; k < r->count; k++)
    compare(&p->final[k], &q->final[k], &d);
  return d;
}

double change_of(const recipe *r, const played *p, const played *q) {
  const difference d = final_difference(r, p, q);
  for (int k = 0; k < r->count; k++)
    if (is_out(&p->final[k]) != is_out(&q->final[k]))
      return INFINITY;
  return fmax(d.place, d.speed);
}

static double apart(const carom_ball_state s[2], const carom_ball_state q[2]) {
  difference d = {0.0, 0.0};
  compare(&s[0], &q[0], &d);
  compare(&s[1], &q[1], &d);
  return fmax(d.place, d.speed);
}

/* How much an event changes speeds. */
static double effect_of(const carom_event *e) {
  difference d = {0.0, 0.0};
  compare(&e->before[0], &e->after[0], &d);
  compare(&e->before[1], &e->after[1], &d);
  return d.speed;
}

/* ---- Events */

static const char out[] = "out";

static const char *word_of(const carom_event *e) {
  switch (e->type) {
  case CAROM_EVENT_STRIKE:
    return "tip";
  case CAROM_EVENT_BALL_BALL:
    return "ball";
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    return "cushion";
  case CAROM_EVENT_SLATE:
    return "slate";
  case CAROM_EVENT_RAIL_TOP:
    return "top";
  case CAROM_EVENT_POCKET:
  case CAROM_EVENT_LEFT_TABLE:
    return out;
  default:
    return NULL; /* the end of a phase, where nothing changes */
  }
}

static bool is_same(const carom_event *x, const carom_event *y) {
  return x->type == y->type && x->a == y->a && x->b == y->b;
}

static bool is_now(const carom_event *x, const carom_event *y) {
  return fabs(x->time - y->time) < instant;
}

static bool flies(const carom_event *e) {
  return e->before[0].label == CAROM_BALL_AIRBORNE || e->before[1].label == CAROM_BALL_AIRBORNE;
}

static bool is_slow(const carom_event *e) {
  const bool on_top = flies(e) && e->type == CAROM_EVENT_BALL_BALL;
  return effect_of(e) < (on_top ? slow_on_top : slow_level);
}

/* Whether two events share a ball. */
static bool are_linked(const carom_event *x, const carom_event *y) {
  const bool x_pair = x->type == CAROM_EVENT_BALL_BALL, y_pair = y->type == CAROM_EVENT_BALL_BALL;
  return x->a == y->a || (x_pair && x->b == y->a) || (y_pair && x->a == y->b) ||
         (x_pair && y_pair && x->b == y->b);
}

/* The first event from *index on that is a contact, or NULL. */
static const carom_event *contact_from(const played *p, int *index) {
  while (*index < p->count && word_of(&p->event[*index]) == NULL)
    ++*index;
  return *index < p->count ? &p->event[*index] : NULL;
}

/* The same event of a shot at that instant, at `index` or later, or NULL. */
static const carom_event *find_now(const played *p, int index, const carom_event *e) {
  for (int k = index; k < p->count; k++)
    if (is_same(&p->event[k], e) && is_now(&p->event[k], e))
      return &p->event[k];
  return NULL;
}

/* ---- Kinds */

/* A kind of two words, the lesser one first. */
static void name_pair(const char *form, const carom_event *x, const carom_event *y,
                      char name[JUMP_NAME]) {
  const char *first = word_of(x), *second = word_of(y);
  const bool ordered = strcmp(first, second) <= 0;
  snprintf(name, JUMP_NAME, form, ordered ? first : second, ordered ? second : first);
}

/* Whether a touch of the tip comes or goes with the end of the follow-through. */
static bool ends_follow(const recipe *r, const carom_event *touch) {
  static _Thread_local played moved;
  recipe longer = *r;
  longer.follow *= 1.0 + further;
  return recipe_play(&longer, &moved) && find_now(&moved, 0, touch) != NULL;
}

static bool is_at_end(const recipe *r, const carom_event *e) {
  static _Thread_local carom_table table;
  if (e->type != CAROM_EVENT_RAIL)
    return false;
  carom_table_make((carom_table_kind)r->table, &table);
  const double *p = table.rail[e->b].p, *q = table.rail[e->b].q, *c = e->before[0].r;
  const double x = q[0] - p[0], y = q[1] - p[1];
  const double along = ((c[0] - p[0]) * x + (c[1] - p[1]) * y) / (x * x + y * y);
  return fmin(fabs(along), fabs(1.0 - along)) < at_end;
}

/* A contact e of the shot `with` alone: whether another contact of its ball, at that instant, comes
 * in both shots, but not out of the same motion. Then the order of the two decides. */
static bool name_order(const played *with, const carom_event *e, const played *without, int index,
                       char name[JUMP_NAME]) {
  for (const carom_event *rival = e + 1; rival < with->event + with->count; rival++) {
    if (!is_now(rival, e))
      return false;
    if (word_of(rival) == NULL || is_same(rival, e) || !are_linked(rival, e))
      continue;
    const carom_event *its = find_now(without, index, rival);
    if (its == NULL || apart(its->before, rival->before) < agreement)
      continue;
    name_pair("order of %s, %s", rival, e, name);
    return true;
  }
  return false;
}

/* A contact that one shot has alone; `r` is the recipe of the other one. False where it explains
 * the jump. */
static bool name_alone(const recipe *r, const carom_event *e, char name[JUMP_NAME]) {
  if (word_of(e) == out || (e->type == CAROM_EVENT_STRIKE && ends_follow(r, e)))
    return false;
  const char *form = "%s alone";
  if (is_at_end(r, e))
    form = "end of %s";
  else if (is_slow(e))
    form = "slow %s";
  snprintf(name, JUMP_NAME, form, word_of(e));
  return true;
}

/* Clusters of other sizes at the event e of a shot. */
static void name_split(const played *p, const carom_event *e, char name[JUMP_NAME]) {
  snprintf(name, JUMP_NAME, "split of %s", word_of(e));
  for (int k = 0; k < p->count; k++) {
    const carom_event *x = &p->event[k];
    const bool one =
        x->type == CAROM_EVENT_RAIL || x->type == CAROM_EVENT_JAW || x->type == CAROM_EVENT_SLATE;
    if (!one || !are_linked(x, e) || fabs(x->time - e->time) > meanwhile)
      continue;
    snprintf(name, JUMP_NAME, "split of %s at %s", word_of(e), word_of(x));
    return;
  }
}

/* The same contact in both shots. False where its states agree. */
static bool name_same(const played *a, const carom_event *x, const played *b, const carom_event *y,
                      char name[JUMP_NAME]) {
  if (x->cluster != y->cluster) {
    name_split(a, x, name);
    if (strstr(name, " at ") == NULL)
      name_split(b, y, name);
    return true;
  }
  const char *form = NULL;
  if (apart(x->before, y->before) > agreement || fabs(x->time - y->time) > agreement)
    form = "unseen before %s";
  else if (apart(x->after, y->after) > agreement)
    form = is_slow(x) && is_slow(y) ? "slow %s" : "after %s";
  if (form != NULL)
    snprintf(name, JUMP_NAME, form, word_of(x));
  return form != NULL;
}

/* Two shots, and the events up to which they agree. */
typedef struct two_shots {
  const recipe *low, *high;
  const played *a, *b;
  int i, j;
} two_shots;

/* A contact e that the shot a, or the shot b, has alone: it is the stop of the shot, or changes
 * nothing, or has a kind. */
static verdict name_single(two_shots *s, const carom_event *e, bool in_a, char name[JUMP_NAME]) {
  if (e->time > s->low->time - before_stop)
    return STOPPED;
  if (word_of(e) != out && effect_of(e) < nothing) {
    *(in_a ? &s->i : &s->j) += 1;
    return AGREED;
  }
  const bool named = in_a ? name_order(s->a, e, s->b, s->j, name) || name_alone(s->high, e, name)
                          : name_order(s->b, e, s->a, s->i, name) || name_alone(s->low, e, name);
  return named ? NAMED : EXPLAINED;
}

/* The next contacts of both shots. */
static verdict name_two(two_shots *s, const carom_event *x, const carom_event *y,
                        char name[JUMP_NAME], double *time) {
  *time = fmin(x->time, y->time);
  if (is_same(x, y)) {
    s->i++;
    s->j++;
    return name_same(s->a, x, s->b, y, name) ? NAMED : AGREED;
  }

  /* a ball falls at that instant in one shot alone */
  const bool falls = word_of(x) == out || word_of(y) == out;
  if (falls && is_now(x, y) && x->a == y->a)
    return EXPLAINED;

  /* at one instant, both in both shots, or one instead of the other */
  const bool x_in_b = find_now(s->b, s->j, x) != NULL, y_in_a = find_now(s->a, s->i, y) != NULL;
  const bool instead = !x_in_b && !y_in_a && is_now(x, y) && x->a == y->a;
  if (!falls && (instead || (x_in_b && y_in_a))) {
    name_pair(instead ? "%s or %s" : "order of %s, %s", x, y, name);
    return NAMED;
  }

  const bool in_a = y_in_a || (!x_in_b && x->time <= y->time);
  const carom_event *e = in_a ? x : y;
  *time = e->time;
  return name_single(s, e, in_a, name);
}

/* Whether the struck ball has met a cushion and the tip at that time, or within `meanwhile` before.
 */
static bool is_pinched(const played *p, double time) {
  bool tip = false, cushion = false;
  for (int k = 0; k < p->count; k++) {
    const carom_event *e = &p->event[k];
    if (e->a != 0 || e->time > time + instant || e->time < time - meanwhile)
      continue;
    tip |= e->type == CAROM_EVENT_STRIKE;
    cushion |= e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW;
  }
  return tip && cushion;
}

/* Names of touches of the tip, or of a cushion, that are those of a ball between both; and of
 * touches of a raised cue, which presses the ball on the slate. */
static void name_company(const recipe *r, const played *a, const played *b, double time,
                         char name[JUMP_NAME]) {
  const bool tip = strstr(name, "tip") != NULL;
  const bool free = strstr(name, "order") == NULL && strstr(name, "end") == NULL;
  if (r->speed > 0.0 && (tip || (free && strstr(name, "cushion") != NULL)) &&
      (is_pinched(a, time) || is_pinched(b, time)))
    snprintf(name, JUMP_NAME, "pinched ball");
  else if (tip && r->theta > CAROM_LEAST_ELEVATION)
    snprintf(name, JUMP_NAME, "raised tip");
}

static verdict find_jump(const recipe *low, const recipe *high, const played *a, const played *b,
                         char name[JUMP_NAME], double *time) {
  *time = 0.0;
  if ((low->theta < CAROM_LEAST_ELEVATION) != (high->theta < CAROM_LEAST_ELEVATION)) {
    snprintf(name, JUMP_NAME, "level tip");
    return NAMED;
  }

  two_shots s = {low, high, a, b, 0, 0};
  verdict found = AGREED;
  while (found == AGREED) {
    const carom_event *x = contact_from(a, &s.i), *y = contact_from(b, &s.j);
    if (x == NULL && y == NULL)
      break;
    if (x != NULL && y != NULL) {
      found = name_two(&s, x, y, name, time);
      continue;
    }
    const carom_event *e = x != NULL ? x : y;
    *time = e->time;
    found = name_single(&s, e, x != NULL, name);
  }
  if (found != AGREED)
    return found;
  snprintf(name, JUMP_NAME, "no event");
  *time = low->time;
  return NAMED;
}

verdict name_jump(const recipe *low, const recipe *high, const played *a, const played *b,
                  char name[JUMP_NAME], double *time) {
  const verdict found = find_jump(low, high, a, b, name, time);
  if (found == NAMED && strcmp(name, "level tip") != 0)
    name_company(low, a, b, *time, name);
  return found;
}
