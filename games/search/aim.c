/* Aims at a pocket, by shots of only the balls on the way, and finally by shots of all balls.
 *
 * The way is a row of links: the cue ball meets rails or ball 1, which meets rails or ball 2, up to
 * the ball that is wanted, which meets rails. A direction phi of the cue does the first few of
 * them. Where it does all, the ball continues to the pocket, and
 *
 *   e(phi) = psi(o) - the direction of v,
 *
 * v being its velocity just before anything ends this last piece: a jaw, a cushion, the pocket,
 * or rest. o is the position on the line of v that is as far from the pocket as the position of the
 * last link. psi, of pots.c, is the middle of the directions from there that pass the jaws. So
 * a path may curve on its way.
 *
 * Directions that do most links are few: the range of phi is sampled, and shrinks to those, as long
 * as links are gained. Then e is continuous but for jumps; its roots are bracketed by neighbours
 * and halved. The samples are spaced like a sine, under which the cut at the first ball changes in
 * equal steps.
 *
 * A cue that the caller leaves to the stick has in each direction the least elevation of the stick,
 * so a root is the direction of the stroke that is played. That elevation jumps where the butt
 * passes over a cushion; where no other root is left, all directions have the greater elevation.
 *
 * A ball that runs along a rail, or is met right off one, has no root. Then directions are played,
 * and the middle of the widest range in which the ball falls is taken. */
#include "ball_aim.h"
#include "platform/elementary.h"
#include "random_draws.h"
#include "stick.h"
#include "table/table.h"
#include "view.h"

#include <math.h>
#include <string.h>

enum { LINKS = CAROM_VIA_MOST + 1, EVENTS = 96, SAMPLES = 180, HALVINGS = 48, SWEPT = 600 };
static const carom_shot_options no_options;
/* a fraction of the time since the start: a velocity before an event is evaluated so much
 * earlier */
static const double just_before = 1e-6;
/* rad: a root with more is a jump; neighbours that differ by more are none */
static const double root_most = 1e-4, step_most = 1.0;
static const double least_time = 1e-9; /* s */
/* degrees on either side, for each rail before the first ball */
static const double kick_wide = 20.0;
static const double speed_most = 15.0, speed_least = 0.05; /* m/s, of the cue */
/* how often a cue is raised and aimed again: each time the direction changes less */
enum { RAISED_MOST = 16 };

/* A way: its links, and its balls, the cue ball first. */
typedef struct way {
  const carom_table *table;
  carom_shot_options options;
  const carom_pocket *pocket;
  carom_mouth mouth;
  const carom_shot_ball *layout; /* the complete layout, of `count` balls */
  int count, balls, links;
  bool raised;                      /* the caller leaves the elevation to the stick */
  bool swept;                       /* the cue ball may touch a rail just before the first ball */
  carom_part link[LINKS];           /* balls and rails, as they are met */
  int ball[LINKS + 1];              /* indices in the layout */
  carom_shot_ball alone[LINKS + 1]; /* the balls as their own layout */
  carom_brief_event *events;        /* room for the events of one shot */
  double *jump;                     /* the greatest elevation at a jump of e, degrees */
} way;

/* How far a shot got on its way. */
typedef struct progress {
  int links;
  double first, last_contact,
      end_time;          /* s: of the first link, of the last one, of what ended the rest */
  carom_brief_event end; /* that; of type 0: nothing did */
} progress;

/* Whether two rails are on one line. */
static bool in_line(const carom_rail *r, const carom_rail *s) {
  const double x = r->q[0] - r->p[0], y = r->q[1] - r->p[1], length = x * x + y * y;
  const double start = x * (s->p[1] - r->p[1]) - y * (s->p[0] - r->p[0]);
  const double end = x * (s->q[1] - r->p[1]) - y * (s->q[0] - r->p[0]);
  return fmax(fabs(start), fabs(end)) < 1e-6 * length;
}

/* ---- A shot and its way */

/* Whether a link is the line of this rail. */
static bool is_on(const way *w, const carom_part *link, int rail) {
  return link->kind == CAROM_PART_RAIL &&
         in_line(&w->table->rail[link->index], &w->table->rail[rail]);
}

/* Whether the cue ball meets the first ball right after event k. */
static bool meets_soon(const int *ball, const carom_brief_event *events, int64_t count, int64_t k) {
  const double deadline = events[k].time + carom_same_contact;
  while (++k < count && events[k].time < deadline)
    if (events[k].type == CAROM_EVENT_BALL_BALL && events[k].a + events[k].b == ball[0] + ball[1] &&
        (events[k].a == ball[0] || events[k].b == ball[0]))
      return true;
  return false;
}

/* Whether an event is a contact or an end of the ball that is on its way. */
static bool concerns(const carom_brief_event *e, int ball) {
  if (e->type == CAROM_EVENT_STRIKE || e->type == CAROM_EVENT_SLATE ||
      e->type == CAROM_EVENT_SLIDING_ROLLING)
    return false;
  return e->a == ball || (e->type == CAROM_EVENT_BALL_BALL && e->b == ball);
}

/* The ball that a ball meets in an event of two balls. */
static int other_of(const carom_brief_event *e, int ball) {
  if (e->a == ball)
    return e->b;
  return e->a;
}

/* Whether an event is the next link: `ball` is on its way, and `target` the ball behind it. */
static bool is_next_link(const way *w, const progress *p, const carom_brief_event *e, int ball,
                         int target) {
  if (p->links == w->links)
    return false;
  const carom_part *next = &w->link[p->links];
  if (e->type == CAROM_EVENT_BALL_BALL)
    return next->kind == CAROM_PART_BALL && other_of(e, ball) == target;
  return e->type == CAROM_EVENT_RAIL && is_on(w, next, e->b);
}

/* Whether the ball on its way, of this index, meets the one before it again: in the instant of the
 * last link; or the cue ball follows a ball that it touched from the start. */
static bool meets_last_again(const progress *p, const int *ball, int index,
                             const carom_brief_event *e) {
  if (e->type != CAROM_EVENT_BALL_BALL || index == 0)
    return false;
  const bool touched = index == 1 && p->last_contact == 0.0;
  return other_of(e, ball[index]) == ball[index - 1] && (e->time == p->last_contact || touched);
}

/* Whether event k is a contact with a rail that may be: a hop along the rail of the last link; or,
 * where directions are swept, one of the cue ball just before it meets the first ball. */
static bool may_touch_rail(const way *w, const progress *p, const int *ball,
                           const carom_brief_event *events, int64_t count, int64_t k) {
  const carom_brief_event *e = &events[k];
  if (e->type != CAROM_EVENT_RAIL)
    return false;
  if (p->links > 0 && is_on(w, &w->link[p->links - 1], e->b) &&
      e->time - p->last_contact < carom_same_contact)
    return true;
  return w->swept && p->links == 0 && meets_soon(ball, events, count, k);
}

/* The first event of the instant of event k. */
static int64_t first_of_instant(const carom_brief_event *events, int64_t k) {
  const double time = events[k].time;
  while (k > 0 && events[k - 1].time == time)
    k--;
  return k;
}

/* Follows the events of a shot along the way; `ball` are the indices of its balls there. */
static progress follow(const way *w, const int *ball, const carom_brief_event *events,
                       int64_t count) {
  progress p = {0};
  int index = 0; /* of the ball that is on its way */
  int64_t k = 0;
  while (k < count && p.end.type == 0) {
    const carom_brief_event *e = &events[k];
    int64_t next = k + 1;
    if (!concerns(e, ball[index])) {
      k = next;
      continue;
    }
    int target = -1;
    if (index + 1 < w->balls)
      target = ball[index + 1];
    if (is_next_link(w, &p, e, ball[index], target)) {
      p.last_contact = e->time;
      p.links++;
      if (e->type == CAROM_EVENT_BALL_BALL) {
        /* the next ball is on its way; the contacts of one instant are in any order */
        if (index == 0)
          p.first = e->time;
        index++;
        next = first_of_instant(events, k);
      }
    } else if (!meets_last_again(&p, ball, index, e) &&
               !may_touch_rail(w, &p, ball, events, count, k)) {
      p.end = *e;
    }
    k = next;
  }
  p.end_time = p.end.time;
  return p;
}

/* The states of the balls of the way at a time of their shot. */
static void states_at(const way *w, const carom_cue *cue, double time,
                      carom_ball_state states[LINKS + 1]) {
  carom_shot_options options = w->options;
  carom_shot shot = {.final = states};
  options.time_most = fmax(time, least_time); /* 0 would be no bound */
  carom_shoot(w->table, w->alone, w->balls, cue, &options, &shot);
}

/* How far only the balls of the way get, and the time of their shot. */
static progress alone(const way *w, const carom_cue *cue, double *time) {
  static const int indices[LINKS + 1] = {0, 1, 2, 3, 4, 5};
  carom_shot_options options = w->options;
  carom_shot shot = {.brief = w->events, .room = EVENTS};
  options.stop_at = CAROM_STOP_AT(CAROM_EVENT_POCKET);
  carom_shoot(w->table, w->alone, w->balls, cue, &options, &shot);
  *time = shot.time;
  return follow(w, indices, w->events, carom_min(shot.count, EVENTS));
}

/* The least elevation of the stick of a cue of the way in its direction, degrees. */
static double stick_of(const way *w, carom_cue cue) {
  cue.ball = w->ball[0];
  return carom_least_elevation(w->table, w->layout, w->count, &cue);
}

/* The elevation with which a cue is played: as given, or the least. */
static double elevation_of(const way *w, const carom_cue *cue) {
  if (isnan(cue->theta))
    return stick_of(w, *cue);
  return cue->theta;
}

/* e, and half the range of directions that pass the jaws; both NaN where the way is not done or
 * the ball goes nowhere, or away from the pocket. */
static progress attempt(const way *w, double phi, carom_cue cue, double *e, double *half) {
  carom_ball_state states[LINKS + 1];
  double time;
  cue.ball = 0;
  cue.phi = phi;
  cue.theta = elevation_of(w, &cue);
  const progress p = alone(w, &cue, &time);
  *e = *half = (double)NAN;
  if (p.links < w->links)
    return p;

  /* Where the last link left the ball, and where it went just before the end. */
  const double *c = w->mouth.centre;
  const carom_ball_state *s = &states[w->balls - 1];
  states_at(w, &cue, p.last_contact, states);
  /* a ball that lay still was met there, and starts from another position where contacts last */
  const bool lay = w->link[w->links - 1].kind == CAROM_PART_BALL;
  const double *from = lay ? w->alone[w->balls - 1].state.r : s->r;
  const double x = c[0] - from[0], y = c[1] - from[1], far = sqrt(x * x + y * y);
  if (p.end.type != 0)
    time = p.end_time;
  states_at(w, &cue, fmax(p.last_contact, time * (1.0 - just_before)), states);
  const double speed = sqrt(s->v[0] * s->v[0] + s->v[1] * s->v[1]);
  if (!(speed > 0.0))
    return p;

  /* The line of v, from as far away. */
  const double u[2] = {s->v[0] / speed, s->v[1] / speed};
  if (u[0] * x + u[1] * y < 0.0)
    return p;
  const double back = u[0] * (c[0] - s->r[0]) + u[1] * (c[1] - s->r[1]) - far;
  const double o[2] = {s->r[0] + back * u[0], s->r[1] + back * u[1]};
  const carom_window window = carom_window_of(&w->mouth, o, w->alone[w->balls - 1].kind.radius);
  *half = window.half;
  *e = carom_wrapped(window.psi - carom_angle_of(u[0], u[1]));
  return p;
}

/* Whether a cushion that the ball met is next to the pocket. */
static bool is_beside(const way *w, const carom_brief_event *e) {
  const int pocket = (int)(w->pocket - w->table->pocket);
  if (e->type == CAROM_EVENT_JAW)
    return carom_is_near_pocket(w->table, pocket, w->table->jaw[e->b].centre);
  return carom_is_beside(w->table, e->b, pocket);
}

/* The result of a cue, with the complete layout. */
static carom_pot_outcome fate(const way *w, const carom_shot_ball *balls, int count,
                              const carom_cue *cue, carom_brief_event *contact) {
  carom_facts facts;
  carom_shot shot = {.brief = w->events, .room = EVENTS, .facts = &facts};
  carom_shoot(w->table, balls, count, cue, &w->options, &shot);
  const progress p = follow(w, w->ball, w->events, carom_min(shot.count, EVENTS));
  const int last = w->ball[w->balls - 1];
  const bool falls = facts.pocket[last] >= 0 && &w->table->pocket[facts.pocket[last]] == w->pocket;
  *contact = p.end;

  /* After the last link it may touch what is next to the pocket, and nothing else. */
  const int type = p.end.type;
  const bool done = p.links == w->links, ends_free = type == 0 || type == CAROM_EVENT_POCKET;
  const bool at_cushion = type == CAROM_EVENT_RAIL || type == CAROM_EVENT_JAW;
  if (done && falls && (ends_free || (at_cushion && is_beside(w, &p.end))))
    return CAROM_POT_FALLS;
  if (done && (ends_free || at_cushion))
    return CAROM_POT_REJECTED;
  if (type == CAROM_EVENT_ROLLING_SPINNING || type == CAROM_EVENT_ROLLING_STATIONARY || type == 0)
    return CAROM_POT_SHORT;
  return CAROM_POT_BARRED;
}

/* The last value of *field, of the cue, from its own on and up to `end`, with which the ball falls:
 * by steps that grow, until one misses, then by halvings. */
static double last_good(const way *w, const carom_shot_ball *balls, int count, const carom_cue *cue,
                        double *field, double step, double growth, double end) {
  const double original = *field;
  double falls, misses = original;
  carom_brief_event unused;
  do {
    falls = misses;
    misses = falls + step;
    if ((misses < end) != (step > 0.0))
      misses = end;
    step *= growth;
    *field = misses;
  } while (misses != falls && fate(w, balls, count, cue, &unused) == CAROM_POT_FALLS);
  for (int k = 0; k < HALVINGS / 2 && misses != falls; k++) {
    *field = 0.5 * (falls + misses);
    if (fate(w, balls, count, cue, &unused) == CAROM_POT_FALLS)
      falls = *field;
    else
      misses = *field;
  }
  *field = original;
  return falls;
}

/* ---- The search */

/* The stroke and half width of a root of e between two directions, in the first of which it has the
 * value e0; false for a jump. */
static bool root_of(const way *w, const carom_cue *cue, const double bracket[2], double e0,
                    carom_cue *found, double *half) {
  double e = e0, low = bracket[0], high = bracket[1];
  *found = *cue;
  for (int k = 0; k < HALVINGS && !isnan(e); k++) {
    found->phi = 0.5 * (low + high);
    attempt(w, found->phi, *cue, &e, half);
    if ((e > 0.0) == (e0 > 0.0))
      low = found->phi;
    else
      high = found->phi;
  }
  found->theta = elevation_of(w, found);
  for (int side = 0; side < 2 && fabs(e) >= root_most; side++) {
    carom_cue end = *cue;
    end.phi = (double[]){low, high}[side];
    *w->jump = fmax(*w->jump, elevation_of(w, &end));
  }
  return fabs(e) < root_most;
}

/* The angle from the way of the cue ball, just before its first contact, to the line of centres,
 * degrees. */
static double cut_of(const way *w, carom_cue cue) {
  carom_ball_state s[LINKS + 1];
  carom_motion struck = {0};
  double unused[2];
  const progress p = attempt(w, cue.phi, cue, &unused[0], &unused[1]);
  cue.ball = 0;
  states_at(w, &cue, p.first * (1.0 - just_before), s);
  const double *v = s[0].v;
  if (p.first == 0.0) { /* the balls touch from the start */
    carom_strike(&cue, &w->alone[0].kind, &struck);
    v = struck.v;
  }
  return carom_wrapped(carom_angle_of(s[1].r[0] - s[0].r[0], s[1].r[1] - s[0].r[1]) -
                       carom_angle_of(v[0], v[1])) /
         degree;
}

/* The result of a root; if the ball falls, with the margins of error. */
static void judge(const way *w, const carom_shot_ball *balls, int count, const carom_cue *root,
                  double half, carom_pot *pot, carom_cue *cue) {
  cue->phi = carom_turned(root->phi);
  pot->elevation = stick_of(w, *cue);
  cue->theta = root->theta;
  if (w->raised)
    cue->theta = fmax(root->theta, pot->elevation);
  pot->outcome = (int32_t)fate(w, balls, count, cue, &pot->met);
  if (w->raised && pot->elevation > STICK_MOST)
    pot->outcome = CAROM_POT_STICK;
  pot->cut = cut_of(w, *cue);
  pot->margin = fmax(half, 0.0) / degree;
  if (pot->outcome != CAROM_POT_FALLS)
    return;
  pot->met = (carom_brief_event){0};
  carom_cue c = *cue;
  for (int side = 0; side < 2; side++) {
    static const double sign[2] = {-1.0, 1.0}, growth[2] = {1.0 / 1.1, 1.1};
    const double bound[2] = {speed_least, speed_most};
    pot->phi[side] =
        last_good(w, balls, count, &c, &c.phi, 1e-3 * sign[side], 1.5, c.phi + 10.0 * sign[side]);
    pot->speed[side] = last_good(w, balls, count, &c, &c.speed, c.speed * (growth[side] - 1.0),
                                 growth[side], bound[side]);
  }
}

/* Searches mid - wide to mid + wide, degrees, for directions with which the ball falls. */
static void search(const way *w, const carom_shot_ball *balls, int count, double mid, double wide,
                   carom_pot *pot, carom_cue *cue) {
  const carom_cue stroke = *cue;
  int best = -1;
  pot->outcome = CAROM_POT_NO_WAY;

  /* as long as links are gained, and once more for the roots */
  for (bool gains = true; gains;) {
    const bool roots = best == w->links;
    double low = 0.0, high = 0.0, last = mid - wide, previous = (double)NAN;
    int most = -1;
    bool short_of = true; /* whether all that do most stop */
    progress at_rest = {0};

    /* directions at the positions of a sine, from one end of the range to the other */
    for (int k = 0; k <= SAMPLES; k++) {
      double sine, cosine, e, half, phi;
      carom_sincos(pi * k / (double)SAMPLES - 0.5 * pi, &sine, &cosine);
      phi = mid + wide * sine;
      const progress p = attempt(w, phi, stroke, &e, &half);
      const bool rests = p.end.type == CAROM_EVENT_ROLLING_STATIONARY ||
                         p.end.type == CAROM_EVENT_ROLLING_SPINNING;

      /* The range of those that do most, with a neighbour on either side. */
      if (p.links > most) {
        most = p.links;
        low = last;
        short_of = true;
      }
      if (p.links == most) {
        at_rest = p;
        short_of = short_of && rests;
        carom_sincos(pi * (double)carom_min(k + 1, SAMPLES) / (double)SAMPLES - 0.5 * pi, &sine,
                     &cosine);
        high = mid + wide * sine;
      }

      /* a root between this direction and the last one, where the ball may fall */
      carom_cue root;
      double width = 0.0;
      if (roots && (e > 0.0) != (previous > 0.0) && fabs(e - previous) < step_most &&
          root_of(w, &stroke, (double[]){last, phi}, previous, &root, &width)) {
        judge(w, balls, count, &root, width, pot, cue);
        if (pot->outcome == CAROM_POT_FALLS)
          return;
      }
      previous = e;
      last = phi;
    }

    /* once more where links were gained, and then for the roots */
    gains = most > best;
    best = most;
    mid = 0.5 * (low + high);
    wide = 0.5 * (high - low);
    if (!gains && best < w->links && short_of) {
      pot->outcome = CAROM_POT_SHORT;
      pot->met = at_rest.end;
      pot->met.a = w->ball[pot->met.a];
    }
  }
}

/* Whether the first ball is near a rail, by way of which it may be met. */
static bool is_near_rail(const way *w) {
  const carom_shot_ball *first = &w->alone[1];
  bool is_near = false;
  for (int k = 0; k < w->table->rails; k++) {
    double l[3];
    carom_rail_line(&w->table->rail[k], l);
    is_near |=
        fabs(l[0] * first->state.r[0] + l[1] * first->state.r[1] + l[2]) < 5.0 * first->kind.radius;
  }
  return is_near;
}

/* Plays directions of this range, for a ball that runs along a rail or is met by way of one: e has
 * no root there. The middle of the widest range in which the ball falls is taken; where there is
 * none, what was found stays. */
static void sweep(way *w, const carom_shot_ball *balls, int count, double mid, double wide,
                  carom_pot *pot, carom_cue *cue) {
  carom_cue c;
  double start = 0.0, last = 0.0, low = 0.0, high = 0.0, unused, half;
  bool fell = false, found = false;
  w->swept = w->links == 1;
  for (int k = 0; k <= SWEPT; k++) {
    double sine, cosine;
    carom_brief_event contact;
    carom_sincos(pi * k / (double)SWEPT - 0.5 * pi, &sine, &cosine);
    c = *cue;
    c.phi = mid + wide * sine;
    c.theta = elevation_of(w, &c);
    /* the complete layout if only the balls of the way get so far */
    carom_cue single = c;
    single.ball = 0;
    const bool falls = alone(w, &single, &unused).links == w->links &&
                       fate(w, balls, count, &c, &contact) == CAROM_POT_FALLS;
    if (falls && !fell)
      start = c.phi;
    if (falls)
      last = c.phi;
    if (falls && last - start >= high - low) {
      low = start;
      high = last;
    }
    fell = falls;
    found |= falls;
  }
  if (!found)
    return;
  c = *cue;
  c.phi = 0.5 * (low + high);
  c.theta = elevation_of(w, &c);
  attempt(w, c.phi, *cue, &unused, &half);
  carom_pot attempted = *pot;
  judge(w, balls, count, &c, half, &attempted, &c);
  if (attempted.outcome != CAROM_POT_FALLS)
    return;
  *pot = attempted;
  *cue = c;
}

/* ---- The call */

/* The links: those that the caller names in via[], and the ball that falls, which follows the last
 * other ball if via[] does not name it. */
static void make_links(const carom_pot *pot, way *w) {
  int last = -1;
  bool named = false;
  for (int k = 0; k < pot->vias; k++)
    if (pot->via[k].kind == CAROM_PART_BALL) {
      last = k;
      named = pot->via[k].index == pot->ball;
    }
  for (int k = -1; k < pot->vias; k++) {
    if (k >= 0)
      w->link[w->links++] = pot->via[k];
    if (k == last && !named)
      w->link[w->links++] = (carom_part){CAROM_PART_BALL, pot->ball};
  }
}

/* The balls of the links, after one another. False where a rail is none of the table's. */
static bool list_balls(const carom_table *table, way *w) {
  for (int k = 0; k < w->links; k++) {
    const carom_part *link = &w->link[k];
    if (link->kind == CAROM_PART_BALL)
      w->ball[w->balls++] = link->index;
    else if (link->kind != CAROM_PART_RAIL || link->index < 0 || link->index >= table->rails)
      return false;
  }
  return true;
}

/* Whether a ball of the layout is on the table. */
static bool is_there(const carom_shot_ball *balls, int count, int ball) {
  return ball >= 0 && ball < count && balls[ball].state.label != CAROM_BALL_POCKETED &&
         balls[ball].state.label != CAROM_BALL_OFF;
}

/* Takes the balls of the way out of the layout. False if one is not there, or occurs twice. */
static bool take_alone(const carom_shot_ball *balls, int count, way *w) {
  for (int k = 0; k < w->balls; k++) {
    if (!is_there(balls, count, w->ball[k]))
      return false;
    for (int earlier = 0; earlier < k; earlier++)
      if (w->ball[earlier] == w->ball[k])
        return false;
    w->alone[k] = balls[w->ball[k]];
  }
  return true;
}

/* The way as the caller requests it; false where that cannot be. */
static bool way_of(const carom_table *table, const carom_shot_ball *balls, int count,
                   const carom_shot_options *options, const carom_pot *pot, int cue_ball, way *w) {
  if (pot->pocket < 0 || pot->pocket >= table->pockets || pot->vias < 0 ||
      pot->vias > CAROM_VIA_MOST)
    return false;
  memset(w, 0, sizeof *w); /* a literal would take its room on the stack a second time */
  w->table = table;
  w->options = *options;
  w->pocket = &table->pocket[pot->pocket];
  w->mouth = carom_mouth_of(table, pot->pocket);
  w->layout = balls;
  w->count = count;
  w->balls = 1;
  w->ball[0] = cue_ball;
  w->options.stop_at = w->options.first_of = 0;
  w->options.time_most = 0.0;
  make_links(pot, w);
  return list_balls(table, w) && take_alone(balls, count, w);
}

/* The position of the first ball, or its image in the rails before it, of which there are
 * *rails. */
static void image_of_first(const way *w, double image[2], int *rails) {
  const carom_shot_ball *first = &w->alone[1];
  image[0] = first->state.r[0];
  image[1] = first->state.r[1];
  *rails = 0;
  while (w->link[*rails].kind == CAROM_PART_RAIL)
    ++*rails;
  for (int k = *rails - 1; k >= 0; k--) {
    double l[3];
    carom_rail_line(&w->table->rail[w->link[k].index], l);
    const double off = l[0] * image[0] + l[1] * image[1] + l[2] - w->alone[0].kind.radius;
    image[0] -= 2.0 * off * l[0];
    image[1] -= 2.0 * off * l[1];
  }
}

/* Directions of the cue, degrees: their middle, and half their range. */
typedef struct directions {
  double mid, half;
} directions;

/* The directions in which a straight path meets the first ball, or its image. No rail reflects as a
 * mirror does, and a raised cue's path curves. `along` gets the greatest elevation of the stick. */
static directions directions_of(const way *w, carom_cue *along) {
  const carom_shot_ball *striker = &w->alone[0], *first = &w->alone[1];
  double image[2];
  int rails;
  image_of_first(w, image, &rails);

  /* to either side of the middle, by the size of the balls */
  const double x = image[0] - striker->state.r[0], y = image[1] - striker->state.r[1];
  const double sine = (striker->kind.radius + first->kind.radius) / sqrt(x * x + y * y);
  directions range;
  range.half = carom_asin(fmin(sine, 1.0)) / degree;
  for (int side = -1; side <= 1 && w->raised; side++) {
    along->phi = carom_angle_of(x, y) / degree + range.half * side;
    along->theta = fmax(along->theta, stick_of(w, *along));
  }

  /* the squirt turns the middle; the curve and rails widen the range */
  carom_motion struck = {.v = {1.0}};
  along->phi = 0.0;
  carom_strike(along, &striker->kind, &struck);
  range.mid = (carom_angle_of(x, y) - carom_angle_of(struck.v[0], struck.v[1])) / degree;
  range.half += kick_wide * rails;
  if (along->theta > 0.0)
    range.half += 2.0 + along->theta;
  return range;
}

/* Searches with the least elevation of each direction; where it jumps over the root, with the
 * greater one. */
static void search_raised(const way *w, directions range, carom_pot *pot, carom_cue *cue) {
  search(w, w->layout, w->count, range.mid, range.half, pot, cue);
  const double jump = *w->jump;
  if (!w->raised || pot->outcome != CAROM_POT_NO_WAY || !(jump > 0.0))
    return;
  carom_cue high = *cue;
  high.theta = jump;
  search(w, w->layout, w->count, range.mid, range.half, pot, &high);
  if (pot->elevation > jump)
    pot->outcome = CAROM_POT_NO_WAY;
  else if (pot->outcome != CAROM_POT_NO_WAY)
    *cue = high;
}

/* ---- Aims without a pocket */

static int32_t outcome_of(aim_result result) {
  switch (result) {
  case AIM_FOUND:
    return CAROM_POT_FALLS;
  case AIM_BARRED:
    return CAROM_POT_BARRED;
  case AIM_NOT_REACHED:
    return CAROM_POT_SHORT;
  default:
    return CAROM_POT_NO_WAY;
  }
}

/* Aims at a ball by its cut. A cue that leaves its elevation to the stick is raised, and aimed
 * again, until the stick is free in the direction of its own aim. */
static carom_status aim_by_cut(const carom_table *table, const carom_shot_ball *balls, int count,
                               const carom_shot_options *options, carom_pot *pot, carom_cue *cue) {
  if (pot->vias != 0 || pot->ball < 0 || pot->ball >= count || pot->ball == cue->ball ||
      balls[pot->ball].state.label == CAROM_BALL_POCKETED)
    return CAROM_ERROR_BALLS;
  if (!(fabs(pot->cut) < 90.0))
    return CAROM_ERROR_OPTIONS;
  const bool raised = isnan(cue->theta);
  carom_cue aimed = *cue;
  if (raised)
    aimed.theta = 0.0;
  carom_event first = {0};
  for (int k = 0; k < RAISED_MOST; k++) {
    pot->outcome = outcome_of(
        carom_aim_at_ball(table, balls, count, options, pot->ball, pot->cut, &aimed, &first));
    pot->elevation = 0.0;
    if (pot->outcome == CAROM_POT_FALLS)
      pot->elevation = carom_least_elevation(table, balls, count, &aimed);
    if (!raised || !(pot->elevation > aimed.theta))
      break;
    if (pot->elevation > STICK_MOST) {
      pot->outcome = CAROM_POT_STICK;
      break;
    }
    aimed.theta = pot->elevation;
  }
  pot->margin = pot->phi[0] = pot->phi[1] = pot->speed[0] = pot->speed[1] = 0.0;
  pot->met = (carom_brief_event){0};
  if (pot->outcome == CAROM_POT_BARRED)
    pot->met =
        (carom_brief_event){.time = first.time, .type = first.type, .a = first.a, .b = first.b};
  if (pot->outcome == CAROM_POT_SHORT)
    pot->met.a = (int32_t)cue->ball;
  if (pot->outcome == CAROM_POT_FALLS)
    *cue = aimed;
  return CAROM_OK;
}

carom_status carom_aim(const carom_table *table, const carom_shot_ball *balls, int count,
                       const carom_shot_options *shot, carom_pot *pot, carom_cue *cue) {
  if (table == NULL || balls == NULL || pot == NULL || cue == NULL)
    return CAROM_ERROR_NULL;
  const carom_shot_options *options = &no_options;
  if (shot != NULL)
    options = shot;
  int where;
  carom_cue along = *cue;
  if (isnan(cue->theta))
    along.theta = 0.0;
  const carom_status status = carom_shot_check(table, balls, count, &along, options, &where);
  if (status != CAROM_OK)
    return status;

  if (pot->pocket == CAROM_POT_NO_POCKET)
    return aim_by_cut(table, balls, count, options, pot, cue);

  /* the way, with its room */
  way w;
  if (!way_of(table, balls, count, options, pot, (int)cue->ball, &w))
    return CAROM_ERROR_BALLS;
  carom_brief_event events[EVENTS];
  double jump = 0.0;
  w.events = events;
  w.jump = &jump;
  w.raised = isnan(cue->theta);
  const directions range = directions_of(&w, &along);

  /* the roots */
  pot->elevation = pot->cut = pot->margin = pot->phi[0] = pot->phi[1] = pot->speed[0] =
      pot->speed[1] = 0.0;
  pot->met = (carom_brief_event){0};
  search_raised(&w, range, pot, cue);

  /* without one, the directions one by one */
  if (pot->outcome == CAROM_POT_NO_WAY || pot->outcome == CAROM_POT_BARRED ||
      pot->outcome == CAROM_POT_REJECTED) {
    double half = range.half;
    if (w.links == 1 && is_near_rail(&w))
      half += kick_wide;
    sweep(&w, balls, count, range.mid, half, pot, cue);
  }

  /* whether only the stick is in the way of all directions */
  along.phi = range.mid;
  if (w.raised && pot->outcome == CAROM_POT_NO_WAY) {
    const double least = stick_of(&w, along);
    if (least > STICK_MOST) {
      pot->outcome = CAROM_POT_STICK;
      pot->elevation = least;
    }
  }
  return CAROM_OK;
}
