/* How far a stroke misses a pocket or a ball, and how it is turned until it does not.
 *
 * The way of a ball is a row of straight pieces between its events. A piece misses a pocket by its
 * angle to the middle psi of the directions that lead into the pocket (pots.c), in half ranges of
 * these; and a ball by the distance of its centre from the line of the piece, in radii of both
 * balls together. So a miss m is within -1 to 1 where the goal is reached. Pieces of one ball with
 * the same goal and number of contacts before are one way. Along it m is a smooth function of the
 * direction phi of the cue, and secants find its root. There the stroke may err by 1 / |dm/dphi| to
 * either side, so an error s of the direction leaves it on its way with the chance
 *
 *   erf(1 / (s |dm/dphi| sqrt 2)),
 *
 * which a hundred shots with errors would show less well. */
#include "miss.h"
#include "random_draws.h"

#include "platform/elementary.h"
#include "player.h"
#include "rows.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;

static const carom_miss no_miss = {.miss = INFINITY, .ball = -1, .target = -1, .piece = -1};

/* ---- The goals */

/* The number of cushions that the cue ball has to meet before the second ball, as the rules judge a
 * stroke that meets two balls; -1: that is no point. */
static int cushions_of_point(const carom_search *search) {
  enum { MOST = 3 };
  const int cue_ball = search->view.cue_ball;
  carom_facts facts = carom_no_facts;
  int met = 0;
  for (int k = search->view.count - 1; k >= 0 && met < 2; k--)
    if (k != cue_ball && (search->in_play >> k & 1))
      facts.first[met++] = k;
  if (search->view.pockets > 0 || met < 2)
    return -1;
  facts.first_set = UINT32_C(1) << facts.first[0];
  facts.touches = 1;
  for (int n = 0; n <= MOST; n++) {
    facts.cushions_before[1] = n;
    carom_rules_state game = search->job.rules->state; /* rules change it as they judge */
    const carom_call call = {facts.first[0], -1};
    if (search->job.rules->judge(&game, search->in_play, cue_ball, &facts, call).points > 0.0)
      return n;
  }
  return -1;
}

void carom_search_find_goals(carom_search *search) {
  search->cushions = cushions_of_point(search);
  search->deciding = 0;
  for (int k = 0; k < search->plays; k++) {
    const uint32_t ball = UINT32_C(1) << search->layout_ball[k];
    bool decides = search->job.rules->calls != 1 || (search->targets & ball) != 0;
    if (k == search->cue_ball || search->cushions >= 0)
      decides = k == search->cue_ball && search->cushions >= 0;
    if (decides)
      search->deciding |= UINT32_C(1) << k;
  }
}

bool carom_search_is_steered(const carom_search *search) {
  return search->places == 0 && !search->breaks && !search->only_safeties;
}

/* ---- How far a shot misses */

/* A piece of the way of a ball. */
typedef struct piece {
  double p[2], u[2], length; /* m: where it begins; its direction */
  int ball, contacts;        /* of the shot; of the ball before it */
} piece;

/* A shot whose misses are compared. */
typedef struct measure {
  const carom_search *search;
  const carom_miss *same; /* NULL: each way counts */
  carom_miss best;
  uint32_t met; /* by the cue ball */
  int cushions; /* that the cue ball has met */
  double start[CAROM_BALLS_MOST][2];
  int contacts[CAROM_BALLS_MOST];
} measure;

static void compare(measure *s, const piece *w, int target, double miss) {
  const carom_miss *same = s->same;
  if (same != NULL &&
      (w->ball != same->ball || target != same->target || w->contacts != same->piece))
    return;
  if (fabs(miss) < fabs((double)s->best.miss))
    s->best = (carom_miss){.miss = (float)miss,
                           .ball = (int8_t)w->ball,
                           .target = (int8_t)target,
                           .piece = (int16_t)w->contacts};
}

/* The misses of the pockets that count, for a ball that passes near them. */
static void miss_pockets(measure *s, const piece *w) {
  static const double farthest[2] = {0.3, 1.2},
                      beyond[2] = {0.12, 0.6}; /* m: from the line; behind its end */
  const carom_search *search = s->search;
  const int known = s->same != NULL;
  const double radius = search->view.radius[search->layout_ball[w->ball]];
  for (int p = 0; p < search->view.pockets; p++) {
    const carom_mouth *mouth = &search->view.mouth[p];
    const double x = mouth->centre[0] - w->p[0], y = mouth->centre[1] - w->p[1];
    const double along = x * w->u[0] + y * w->u[1], off = x * w->u[1] - y * w->u[0];
    if (!(search->pockets >> p & 1) || along <= 0.0 || along > w->length + beyond[known] ||
        fabs(off) > farthest[known])
      continue;
    const carom_window window = carom_window_of(mouth, w->p, radius);
    const double sine = window.cosine * w->u[1] - window.sine * w->u[0];
    if (window.half > 0.0)
      compare(s, w, p, carom_asin(carom_within(sine, -1.0, 1.0)) / window.half);
  }
}

/* The misses of the balls that the cue ball has not met. */
static void miss_balls(measure *s, const piece *w) {
  const carom_shot_ball *played = s->search->played;
  for (int k = 0; k < s->search->plays; k++) {
    if (k == s->search->cue_ball || (s->met >> k & 1))
      continue;
    const double x = played[k].state.r[0] - w->p[0], y = played[k].state.r[1] - w->p[1];
    const double along = x * w->u[0] + y * w->u[1];
    const double both = played[k].kind.radius + played[s->search->cue_ball].kind.radius;
    if (along > 0.0 && along <= w->length + both)
      compare(s, w, k, (x * w->u[1] - y * w->u[0]) / both);
  }
}

/* Measures the piece that ends in an event of a ball; `partner` is the other one, or -1. */
static void measure_piece(measure *s, const carom_event *e, int side, int partner) {
  static const double least = 1e-3; /* m */
  const carom_search *search = s->search;
  const int ball = side == 0 ? e->a : e->b;
  double *start = s->start[ball];
  const double x = e->before[side].r[0] - start[0], y = e->before[side].r[1] - start[1];
  const double length = sqrt(x * x + y * y);
  const piece w = {{start[0], start[1]}, {x / length, y / length}, length, ball, s->contacts[ball]};
  const bool may_score = s->met != 0 && s->cushions >= search->cushions;
  if (length > least && ball != search->cue_ball)
    miss_pockets(s, &w);
  else if (length > least && (search->cushions < 0 || may_score))
    miss_balls(s, &w);

  /* the next piece */
  memcpy(start, e->after[side].r, sizeof s->start[ball]);
  s->contacts[ball] += partner >= 0 || e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW;
  if (ball == search->cue_ball && e->type == CAROM_EVENT_RAIL)
    s->cushions++;
  if (ball == search->cue_ball && partner >= 0)
    s->met |= UINT32_C(1) << partner;
}

/* The least miss of a shot of a candidate; or the least on the way of `same`. */
static carom_miss miss_of(const carom_search *search, const candidate *c, const carom_event *events,
                          int64_t count, const carom_miss *same) {
  measure s = {.search = search, .same = same, .best = no_miss};
  const uint32_t balls = same == NULL ? search->deciding : UINT32_C(1) << same->ball;
  for (int k = 0; k < search->plays; k++)
    memcpy(s.start[k], search->played[k].state.r, sizeof s.start[k]);
  memcpy(s.start[search->cue_ball], c->r, sizeof s.start[0]);
  for (int64_t n = 0; n < carom_min(count, PATH_EVENTS); n++) {
    const carom_event *e = &events[n];
    const bool pair = e->type == CAROM_EVENT_BALL_BALL;
    if (balls >> e->a & 1)
      measure_piece(&s, e, 0, pair ? e->b : -1);
    if (pair && (balls >> e->b & 1))
      measure_piece(&s, e, 1, e->a);
  }
  return s.best;
}

/* ---- Steering */

static const double step = 0.02, turned_most = 4.0; /* degrees */
static const double slope_most = 25.0;              /* 1/degree */
static const double good = 0.3, fair = 0.8;         /* misses of strokes that are steered enough */

/* The miss of a candidate without errors in another direction, on the way of `same`; NaN where it
 * leaves it. */
static double miss_at(const carom_search *search, const candidate *c, const carom_miss *same,
                      double phi, carom_trail *path) {
  carom_shot shot = {.events = path->event, .room = PATH_EVENTS, .facts = &path->facts};
  carom_cue cue = carom_search_stroke(search, c, 0, 0);
  cue.phi = carom_turned(phi);
  cue.ball = search->cue_ball;
  const carom_prepared layout = carom_search_layout(search, c, 0, 0, path->drawn);
  const carom_status status = carom_shoot_prepared(&layout, &cue, &shot);
  path->work += carom_search_work(&shot);
  if (status < 0)
    return (double)NAN;
  const carom_miss m = miss_of(search, c, path->event, shot.count, same);
  if (m.ball < 0)
    return (double)NAN;
  return (double)m.miss;
}

/* The slope of a miss, by the stroke next to it; infinite where that leaves the way. */
static float slope_of(const carom_search *search, const candidate *c, const carom_miss *m,
                      carom_trail *path) {
  const double slope = (miss_at(search, c, m, c->phi + step, path) - (double)m->miss) / step;
  if (isnan(slope))
    return INFINITY;
  return (float)slope;
}

carom_miss carom_search_measure(const carom_search *search, const candidate *c, carom_trail *path,
                                int64_t count) {
  static const float most = 12.0f;
  carom_miss m = miss_of(search, c, path->event, count, NULL);
  if (fabsf(m.miss) < most)
    m.slope = slope_of(search, c, &m, path);
  return m;
}

bool carom_search_is_good(const carom_miss *m) {
  return fabs((double)m->miss) < good;
}

bool carom_search_is_in_reach(const carom_miss *m) {
  const double slope = fabs((double)m->slope);
  return slope > 0.0 && slope < slope_most && fabs((double)m->miss) < slope * turned_most;
}

/* Turns a kick until the cue ball meets the first ball about as it has to: a secant each step. */
static void turn_to_ball(const carom_search *search, candidate *c, carom_trail *path) {
  enum { STEPS = 3 };
  static const double first = 0.5, enough = 0.1; /* degrees; misses */
  double change = first, off = 0.0;
  for (int n = 0; n <= STEPS; n++) {
    const double phi = n == 0 ? c->phi : c->phi + change;
    const double next = miss_at(search, c, &c->lead, phi, path) - (double)c->lead.miss;
    if (isnan(next))
      return;
    if (n > 0)
      change *= next / (off - next);
    off = next;
    c->phi = phi;
    if (fabs(off) < enough || !(fabs(change) < turned_most))
      return;
  }
}

bool carom_search_turn(const carom_search *search, candidate *c, carom_trail *path) {
  enum { STEPS = 4 };
  if (c->lead.piece > 0 && isnan(c->miss.miss))
    turn_to_ball(search, c, path);
  if (isnan(c->miss.miss))
    c->miss.miss = (float)miss_at(search, c, &c->miss, c->phi, path);
  if (c->miss.slope == 0.0f)
    c->miss.slope = slope_of(search, c, &c->miss, path);
  if (!carom_search_is_in_reach(&c->miss))
    return false;

  /* secants; a step that leaves the way is halved */
  double miss = (double)c->miss.miss, slope = (double)c->miss.slope, turned = 0.0;
  double change = -miss / slope;
  for (int n = 0; n < STEPS && fabs(miss) >= good; n++) {
    if (fabs(change) < step)
      change = step;
    if (!(fabs(turned + change) <= turned_most))
      break;
    const double next = miss_at(search, c, &c->miss, c->phi + turned + change, path);
    if (isnan(next)) {
      change *= 0.5;
      continue;
    }
    slope = (next - miss) / change;
    if (!(fabs(slope) > 0.0 && fabs(slope) < slope_most))
      return false;
    turned += change;
    miss = next;
    change = -miss / slope;
  }
  c->phi = carom_turned(c->phi + turned);
  c->miss.miss = (float)miss;
  c->miss.slope = (float)slope;
  return fabs(miss) < fair;
}

double carom_search_expected(const carom_search *search, double chance, double worth) {
  double missed = fmin(search->foul_value, worth);
  if (search->cushions >= 0)
    missed = 0.0;
  return missed + chance * (worth - missed);
}

double carom_search_worth(const carom_search *search, const candidate *c, double worth) {
  const double phi = search->player.phi * carom_player_growth(&search->player, c->speed);
  const double spread = 1.4142135623730951 * fmax(phi, 1e-3) * fabs((double)c->miss.slope);
  double chance = 0.0;
  for (int side = -1; side <= 1; side += 2) {
    const double room = (1.0 + side * (double)c->miss.miss) / spread;
    chance += 0.5 * copysign(carom_erf(fabs(room)), room);
  }
  return carom_search_expected(search, chance, worth);
}
