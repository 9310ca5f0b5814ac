/* The ways of carom_coach.h: strokes in all directions. Those that pot or score are counted by the
 * rails and balls that they meet, and a way's best direction is the middle of the widest run of
 * neighbouring ones, whose ends are bisected. For one ball, and where no way was found, there are
 * at least FINE directions, because the window of a frozen ball is often narrower than 0.2
 * degrees. */
#include "carom_coach.h"
#include "coach.h"
#include "eye.h"
#include "platform/ranges.h"
#include "player.h"
#include "pot_kind.h"
#include "random_draws.h"
#include "view.h"

#include <math.h>
#include <string.h>

typedef carom_shot_way way;

/* strokes with errors for a chance; strokes of one batch */
enum { TRIES = 400, BLOCK = 256, HALVINGS = 10, FINE = 18000 };
/* m/s, of the cue; and degrees, of a pot */
static const double speed_least = 0.05, speed_most = 15.0, window_least = 0.02;

/* The run of neighbouring directions of a way, and the longest one, degrees; the last direction of
 * a way, counted as those of a search; and the number of the way before they are sorted. */
typedef struct way_run {
  int64_t last, number;
  double start, low, high;
} way_run;

/* The shots of a batch, with where the balls of each lie, and of one stroke whose events are
 * read. */
typedef struct workspace {
  carom_features features;
  carom_ball_kind kind[CAROM_BALLS_MOST];
  carom_ball_state drawn[BLOCK][CAROM_BALLS_MOST];
  carom_shot shot[BLOCK];
  carom_facts facts[BLOCK];
  carom_cue cue[BLOCK];
  carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  carom_event event[CAROM_WAY_EVENTS];
  carom_facts read_facts;
  carom_ball_state read_final[CAROM_BALLS_MOST];
} workspace;

/* A search on its way. */
typedef struct ways_search {
  const carom_ways_job *job;
  carom_shot_options options;
  workspace *work;
  way_run *run; /* of each way */
  way *found;   /* with room for so many: */
  int64_t room;
  carom_ways_result result;
  carom_status status; /* of the last shots */
} ways_search;

static int cue_ball_of(const ways_search *s) {
  return (int)s->job->cues->ball;
}

/* Plays strokes of the layout, or with `elsewhere` of the layouts that were drawn; false after an
 * error. */
static bool play(ways_search *s, int n, bool elsewhere) {
  carom_shot_job shots = {.table = s->job->table,
                          .balls = s->job->balls,
                          .cues = s->work->cue,
                          .count = s->job->count,
                          .cue_stride = 1,
                          .n = (uint64_t)n,
                          .options = &s->options,
                          .shots = s->work->shot};
  if (elsewhere) {
    shots.balls = NULL;
    shots.kinds = s->work->kind;
    shots.states = s->work->drawn[0];
    shots.ball_stride = CAROM_BALLS_MOST;
  }
  for (int k = 0; k < n; k++)
    s->work->shot[k] = (carom_shot){.facts = &s->work->facts[k], .final = s->work->final[k]};
  s->status = carom_shoot_batch(&shots);
  return s->status >= 0;
}

/* Whether a shot reaches the goal, of a way with this ball and pocket. */
static bool is_good(const carom_ways_job *job, const carom_facts *facts,
                    const carom_ball_state *final, const way *w) {
  const int cue = (int)job->cues->ball;

  /* a stroke that loses the cue ball is none, nor is a double hit, as games rule on it */
  const uint32_t faults = CAROM_MARK_SCRATCH | CAROM_MARK_DOUBLE_HIT;
  if ((carom_stroke_marks(facts, cue) & faults) != 0 || (facts->off >> cue & 1) != 0)
    return false;

  const double x = final[cue].r[0] - job->place[0], y = final[cue].r[1] - job->place[1];
  if (job->radius > 0.0 && sqrt(x * x + y * y) > job->radius)
    return false;
  if (job->goal == CAROM_WAY_PLACE)
    return true;
  if (job->goal == CAROM_WAY_SCORE)
    return facts->first[1] >= 0 && facts->cushions_before[1] >= 3;
  return w->ball >= 0 && (facts->down >> w->ball & 1) != 0 && facts->pocket[w->ball] == w->pocket;
}

int carom_way_succeeds(const carom_ways_job *job, const carom_shot *shot, const way *w) {
  if (job == NULL || job->cues == NULL || shot == NULL || shot->facts == NULL ||
      shot->final == NULL || w == NULL)
    return 0;
  return is_good(job, shot->facts, shot->final, w);
}

/* Sets the chance of a way, by strokes in batches, each of which draws the errors of the stroke and
 * of the positions of balls, as plans do; false after an error. */
static bool find_chance(ways_search *s, way *w) {
  workspace *work = s->work;
  const double eye = carom_player_bounded(s->job->player, &w->cue).eye;
  carom_prepared layout;
  int where;
  s->status = carom_prepare(s->job->table, s->job->balls, s->job->count, &s->options,
                            &work->features, &layout, &where);
  if (s->status < 0)
    return false;
  for (int k = 0; k < layout.count; k++)
    work->kind[k] = *layout.kind[k];

  int good = 0;
  for (int first = 0; first < TRIES; first += BLOCK) {
    const int n = (int)carom_min(TRIES - first, BLOCK);
    for (int k = 0; k < n; k++) {
      const uint64_t number = (uint64_t)(first + k);
      work->cue[k] = w->cue;
      carom_player_strike(s->job->player, 0, number, &work->cue[k]);
      carom_eye_draw(&layout, (int)w->cue.ball, eye, 0, DRAW_PLAYED, number, work->drawn[k]);
    }
    if (!play(s, n, true))
      return false;
    for (int k = 0; k < n; k++)
      good += is_good(s->job, &s->work->facts[k], s->work->final[k], w);
  }
  const double tries = TRIES;
  w->chance = good / tries;
  w->error = sqrt(w->chance * (1.0 - w->chance) / tries);
  return true;
}

/* ---- Results of a shot */

/* The first rail of a name, or -1. */
static int first_rail(const carom_table *t, const char *name) {
  for (int k = 0; k < t->rails; k++) {
    const char *rail_name = carom_rail_name(t, k);
    if (rail_name != NULL && strcmp(rail_name, name) == 0)
      return k;
  }
  return -1;
}

/* Adds a part to a way. False where there is no room. */
static bool add_part(way *w, carom_part part) {
  if (w->parts == CAROM_WAY_PARTS)
    return false;
  w->part[w->parts++] = part;
  return true;
}

/* Adds the rail of an event, by the first one of its name, to what a ball meets; the cut of a
 * pocket is none, nor is a hop on the rail before. False where there is no room. */
static bool add_rail(const ways_search *s, const carom_event *e, bool hop, way *w, int *rails) {
  const carom_table *t = s->job->table;
  if (hop || carom_is_cut(t, e->b))
    return true;
  const char *name = carom_rail_name(t, e->b);
  ++*rails;
  return add_part(w, (carom_part){CAROM_PART_RAIL, name != NULL ? first_rail(t, name) : e->b});
}

static bool is_of(const carom_event *e, int type, int ball) {
  return e->type == type && (e->a == ball || (type == CAROM_EVENT_BALL_BALL && e->b == ball));
}

/* The first contact of a ball; among contacts of one instant, the one with the cue ball. */
static const carom_event *first_contact(const carom_shot *shot, int ball, int cue) {
  const carom_event *first = NULL;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_event *e = &shot->events[k];
    if (!is_of(e, CAROM_EVENT_BALL_BALL, ball))
      continue;
    if (first == NULL || (e->time == first->time && (e->a == cue || e->b == cue)))
      first = e;
  }
  return first;
}

/* The balls of a pot from the ball that falls back to the cue ball, each first met by the next one,
 * and when; of the cue ball 0. */
enum { LINKS_MOST = 4 };
typedef struct pot_chain {
  int links; /* ball[links] is the cue ball */
  int ball[LINKS_MOST + 1];
  double start[LINKS_MOST + 1];
} pot_chain;

/* False where a ball was met by none, or the chain is too long. */
static bool find_chain(const carom_shot *shot, int ball, int cue, pot_chain *chain) {
  int links = 0;
  for (; ball != cue; links++) {
    const carom_event *e = first_contact(shot, ball, cue);
    if (links == LINKS_MOST || e == NULL)
      return false;
    chain->ball[links] = ball;
    chain->start[links] = e->time;
    ball = e->a == ball ? e->b : e->a;
  }
  chain->ball[links] = cue;
  chain->start[links] = 0.0;
  chain->links = links;
  return true;
}

/* Whether a ball is ball n of a chain or a neighbour of it there. */
static bool is_neighbour(const pot_chain *chain, int n, int ball) {
  for (int k = n - 1; k <= n + 1; k++)
    if (k >= 0 && k <= chain->links && chain->ball[k] == ball)
      return true;
  return false;
}

/* Rails of a way, and the last ones of them, next to the pocket, that the ball touches as it
 * falls. */
typedef struct rail_count {
  int total, at_pocket;
} rail_count;

/* Adds to a way the rails and other balls that ball n of the chain meets from its first contact on,
 * up to that with the next one, or to its fall. False where there is no room. */
static bool add_link(const ways_search *s, const carom_shot *shot, const pot_chain *chain, int n,
                     way *w, rail_count *rails) {
  const carom_table *t = s->job->table;
  const int ball = chain->ball[n], cue = cue_ball_of(s);
  const double end = n > 0 ? chain->start[n - 1] : shot->facts->pocket_time[ball];
  int last = -1; /* rail */
  for (int64_t k = 0; k < shot->count && shot->events[k].time <= end; k++) {
    const carom_event *e = &shot->events[k];
    if (e->time < chain->start[n])
      continue;
    if (is_of(e, CAROM_EVENT_RAIL, ball) && (shot->facts->rails[ball] >> e->b & 1) != 0) {
      const int parts = w->parts;
      if (!add_rail(s, e, e->b == last, w, &rails->total))
        return false;
      last = e->b;
      const bool falls_by = n == 0 && carom_is_beside(t, e->b, w->pocket);
      rails->at_pocket = falls_by ? rails->at_pocket + w->parts - parts : 0;
    } else if (is_of(e, CAROM_EVENT_BALL_BALL, ball)) {
      const int partner = e->a == ball ? e->b : e->a;
      if (partner == cue || is_neighbour(chain, n, partner))
        continue;
      if (!add_part(w, (carom_part){CAROM_PART_BALL, partner}))
        return false;
      rails->at_pocket = 0;
    }
  }
  return true;
}

/* The way of a shot that pots its ball: from the cue ball on, by the balls of which each is first
 * met by the one before, the rails and other balls that each meets up to the next. */
static bool read_pot(const ways_search *s, const carom_shot *shot, way *w) {
  const int cue = cue_ball_of(s);
  pot_chain chain;
  rail_count rails = {0, 0};
  if (!find_chain(shot, w->ball, cue, &chain))
    return false;
  for (int n = chain.links; n >= 0; n--) {
    if (!add_link(s, shot, &chain, n, w, &rails))
      return false;
    if (n > 1 && !add_part(w, (carom_part){CAROM_PART_BALL, chain.ball[n - 1]}))
      return false;
  }
  w->parts -= rails.at_pocket;
  w->kind = carom_pot_kind(shot, cue, w->ball, w->pocket);
  return w->kind >= 0 && rails.total - rails.at_pocket <= s->job->rails;
}

/* The way of a point or to a position: what the cue ball meets, of a point up to the second
 * ball. */
static bool read_point(const ways_search *s, const carom_shot *shot, way *w) {
  const int cue = cue_ball_of(s);
  int balls = 0, rails = 0, hit_balls[2] = {-1, -1};
  const carom_event *last = NULL;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_event *e = &shot->events[k];
    const int partner = e->a == cue ? e->b : e->a;
    if (is_of(e, CAROM_EVENT_RAIL, cue)) {
      const bool hop = last != NULL && last->b == e->b && e->time - last->time < carom_same_contact;
      if (!add_rail(s, e, hop, w, &rails))
        return false;
      last = e;
    }
    if (is_of(e, CAROM_EVENT_BALL_BALL, cue) && partner != hit_balls[0] &&
        partner != hit_balls[1]) {
      if (balls == 2 || !add_part(w, (carom_part){CAROM_PART_BALL, partner}))
        return false;
      hit_balls[balls++] = partner;
      if (s->job->goal == CAROM_WAY_SCORE && balls == 2)
        return rails >= 3;
    }
  }
  return rails <= s->job->rails && s->job->goal == CAROM_WAY_PLACE;
}

/* The cut of the first contact of the cue ball, degrees; NAN where there is none. */
static double cut_of(const carom_shot *shot, int cue) {
  for (int64_t k = 0; k < shot->count; k++)
    if (is_of(&shot->events[k], CAROM_EVENT_BALL_BALL, cue))
      return carom_cut_at(&shot->events[k], cue);
  return (double)NAN;
}

/* Plays a stroke, and reads its way, of which kind, ball and pocket are given. Its results: */
typedef enum stroke_read { NO_WAY, NO_ROOM, A_WAY } stroke_read;
static stroke_read read_stroke(const ways_search *s, const carom_cue *cue, way *w) {
  workspace *work = s->work;
  carom_shot shot = {.events = work->event,
                     .room = CAROM_WAY_EVENTS,
                     .facts = &work->read_facts,
                     .final = work->read_final};
  const carom_status status =
      carom_shoot(s->job->table, s->job->balls, (int)s->job->count, cue, &s->options, &shot);
  if (status < 0 || !is_good(s->job, &work->read_facts, work->read_final, w))
    return NO_WAY;
  w->parts = 0;
  if (shot.count > CAROM_WAY_EVENTS)
    return NO_ROOM;
  const bool read = s->job->goal == CAROM_WAY_POT ? read_pot(s, &shot, w) : read_point(s, &shot, w);
  if (read) {
    w->cut = cut_of(&shot, (int)cue->ball);
    return A_WAY;
  }
  return s->job->goal == CAROM_WAY_SCORE && w->parts == CAROM_WAY_PARTS ? NO_ROOM : NO_WAY;
}

static bool is_same(const way *a, const way *b) {
  return a->kind == b->kind && a->ball == b->ball && a->pocket == b->pocket &&
         a->parts == b->parts && memcmp(a->part, b->part, (size_t)a->parts * sizeof *a->part) == 0;
}

/* ---- Strokes in all directions */

/* Counts a way of direction k, in degrees phi, of a stroke. Of pots each window of a stroke is a
 * way. */
static void count_way(ways_search *s, const way *seen, int stroke, int64_t k, double phi) {
  const bool pots = s->job->goal == CAROM_WAY_POT;
  int64_t index = 0;
  while (index < s->result.ways &&
         !(is_same(&s->found[index], seen) &&
           (!pots || (s->found[index].stroke == stroke && s->run[index].last == k - 1))))
    index++;
  if (index == s->room) {
    s->result.left_out++;
    return;
  }
  way *w = &s->found[index];
  way_run *run = &s->run[index];
  if (index == s->result.ways) {
    *w = *seen;
    w->stroke = stroke;
    *run = (way_run){.last = -2, .low = phi, .high = phi};
    s->result.ways++;
  }
  w->found++;
  if (run->last != k - 1)
    run->start = phi;
  run->last = k;
  if (phi - run->start > run->high - run->low) {
    run->low = run->start;
    run->high = phi;
    w->stroke = stroke;
  }
}

/* Counts the way of the ball, -1 for points and positions, for a stroke whose shot is good, or
 * counts that there was no room for it. */
static void read_shot(ways_search *s, const carom_shot *shot, const carom_cue *cue, int ball,
                      int stroke, int64_t k) {
  way seen = {.kind = -1, .ball = ball, .pocket = -1};
  if (ball >= 0)
    seen.pocket = shot->facts->pocket[ball];
  if (!is_good(s->job, shot->facts, shot->final, &seen))
    return;
  switch (read_stroke(s, cue, &seen)) {
  case A_WAY:
    s->result.good++;
    count_way(s, &seen, stroke, k, cue->phi);
    break;
  case NO_ROOM:
    s->result.left_out++;
    break;
  case NO_WAY:
    break;
  }
}

/* Whether its stroke takes the same way with another value of *field, of its cue. */
static bool holds(const ways_search *s, way *w, double *field, double number) {
  way seen = {.kind = -1, .ball = w->ball, .pocket = w->pocket};
  const double original = *field;
  *field = number;
  const bool same = read_stroke(s, &w->cue, &seen) == A_WAY && is_same(&seen, w);
  *field = original;
  return same;
}

/* The last value of *field at which the way holds, from `in` on, at which it does: by steps x to
 * x * factor + add up to one at which it does not, or out of bounds, then by halvings. */
static double edge_of(const ways_search *s, way *w, double *field, double in, double factor,
                      double add, double least, double most) {
  double out = in * factor + add;
  while (out > least && out < most && holds(s, w, field, out)) {
    in = out;
    out = in * factor + add;
  }
  for (int k = 0; k < HALVINGS; k++) {
    const double middle = 0.5 * (in + out);
    if (holds(s, w, field, middle))
      in = middle;
    else
      out = middle;
  }
  return in;
}

/* The best stroke of a way that was counted, the window around it, and its chance; false after an
 * error. */
static bool finish_way(ways_search *s, way *w, const way_run *run, double step) {
  const double low = run->low, high = run->high;
  w->cue = s->job->cues[w->stroke];
  w->phi[0] = edge_of(s, w, &w->cue.phi, low, 1.0, -step, high - 360.0, high);
  w->phi[1] = edge_of(s, w, &w->cue.phi, high, 1.0, step, low, low + 360.0);
  const double middle = 0.5 * (w->phi[0] + w->phi[1]);
  w->cue.phi = high;
  if (holds(s, w, &w->cue.phi, middle))
    w->cue.phi = middle;
  way probe = {.kind = -1, .ball = w->ball, .pocket = w->pocket};
  if (read_stroke(s, &w->cue, &probe) == A_WAY)
    w->cut = probe.cut;
  w->speed[0] = w->speed[1] = w->cue.speed;
  const bool pots = s->job->goal == CAROM_WAY_POT,
             narrow = pots && w->phi[1] - w->phi[0] < window_least;
  for (int end = 0; end < 2 && pots && !narrow; end++)
    w->speed[end] = edge_of(s, w, &w->cue.speed, w->cue.speed, end == 0 ? 1.0 / 1.1 : 1.1, 0.0,
                            speed_least, speed_most);
  return narrow || find_chance(s, w);
}

/* Whether a way has a better chance than another, or the same in a wider window. */
static bool is_better(const way *a, const way *b) {
  if (a->chance != b->chance)
    return a->chance > b->chance;
  return a->phi[1] - a->phi[0] > b->phi[1] - b->phi[0];
}

/* Of the ways of pots those that are wide enough stay, each once where directions end; and among
 * ways that differ only by the stroke, unless each is requested, the one with the best chance. */
static void keep_best(ways_search *s, double step) {
  int64_t retained = 0;
  for (int64_t k = 0; k < s->result.ways; k++) {
    const way w = s->found[k];
    int64_t index = retained;
    if (w.phi[1] - w.phi[0] < window_least || w.phi[0] <= -step)
      continue;
    for (int64_t n = 0; n < retained && !s->job->each; n++)
      if (is_same(&s->found[n], &w))
        index = n;
    if (index == retained || is_better(&w, &s->found[index]))
      s->found[index] = w;
    retained += index == retained;
  }
  s->result.ways = retained;
}

/* Whether a shot pots a ball that is requested into a pocket that is. */
static bool is_asked(const ways_search *s, const carom_facts *facts, int ball) {
  return ball != cue_ball_of(s) && (s->job->ball < 0 || ball == s->job->ball) &&
         (s->job->pocket < 0 || facts->pocket[ball] == s->job->pocket);
}

/* Plays n directions of a stroke, from direction `first` on, and counts their ways; false after an
 * error. */
static bool scan_block(ways_search *s, int stroke, int64_t first, int n, double step) {
  carom_cue *cue = s->work->cue;
  const carom_shot *shot = s->work->shot;
  for (int k = 0; k < n; k++) {
    cue[k] = s->job->cues[stroke];
    cue[k].phi = step * (double)(first + k);
  }
  if (!play(s, n, false))
    return false;

  for (int k = 0; k < n; k++) {
    s->result.scanned++;
    if (s->job->goal != CAROM_WAY_POT)
      read_shot(s, &shot[k], &cue[k], -1, stroke, first + k);
    for (int ball = 0; ball < s->job->count && s->job->goal == CAROM_WAY_POT; ball++)
      if (is_asked(s, shot[k].facts, ball))
        read_shot(s, &shot[k], &cue[k], ball, stroke, first + k);
  }
  return true;
}

static void report(const ways_search *s, const char *stage, int64_t done, int64_t total) {
  if (s->job->progress != NULL)
    s->job->progress(s->job->context, stage, (double)done, (double)total);
}

/* Plays strokes in n directions each; false after an error. */
static bool scan_directions(ways_search *s, int64_t n) {
  const double step = 360.0 / (double)n;
  s->result = (carom_ways_result){0};
  for (int stroke = 0; stroke < s->job->strokes; stroke++)
    for (int64_t start = 0; start < n; start += BLOCK) {
      if (!scan_block(s, stroke, start, (int)carom_min(n - start, BLOCK), step))
        return false;
      report(s, "strokes", s->result.scanned, n * s->job->strokes);
    }
  return true;
}

/* Finds the ways of n directions for each stroke; false after an error. */
static bool find_ways(ways_search *s, int64_t n) {
  const double step = 360.0 / (double)n;
  if (!scan_directions(s, n))
    return false;
  for (int64_t k = 0; k < s->result.ways; k++) {
    if (!finish_way(s, &s->found[k], &s->run[k], step))
      return false;
    report(s, "ways", k, s->result.ways);
  }
  if (s->job->goal == CAROM_WAY_POT)
    keep_best(s, step);
  return true;
}

/* Finds the ways; false after an error. */
static bool scan(ways_search *s) {
  const int64_t each = s->job->scan / s->job->strokes;
  const bool pots = s->job->goal == CAROM_WAY_POT, asked = pots && s->job->ball >= 0;
  const int64_t fine = carom_max(each, FINE);
  if (!find_ways(s, asked ? fine : each))
    return false;
  return !pots || asked || s->result.ways > 0 || find_ways(s, fine);
}

/* ---- The calls */

/* Whether way k precedes way n: a better chance, then a wider window, then the earlier find. */
static bool is_before(const ways_search *s, int64_t k, int64_t n) {
  const way *a = &s->found[k], *b = &s->found[n];
  if (is_better(a, b) || is_better(b, a))
    return is_better(a, b);
  return s->run[k].number < s->run[n].number;
}

static void exchange(ways_search *s, int64_t k, int64_t n) {
  const way w = s->found[k];
  const int64_t number = s->run[k].number;
  s->found[k] = s->found[n];
  s->found[n] = w;
  s->run[k].number = s->run[n].number;
  s->run[n].number = number;
}

/* Lets a way sink in the heap of the first `end`, whose root is the last in the order. */
static void sink(ways_search *s, int64_t root, int64_t end) {
  for (int64_t child = 2 * root + 1; child < end; child = 2 * root + 1) {
    if (child + 1 < end && is_before(s, child, child + 1))
      child++;
    if (!is_before(s, root, child))
      return;
    exchange(s, root, child);
    root = child;
  }
}

/* Sorts the ways in place, as a heap. */
static void sort(ways_search *s) {
  const int64_t n = s->result.ways;
  for (int64_t k = 0; k < n; k++)
    s->run[k].number = k;
  for (int64_t k = n / 2 - 1; k >= 0; k--)
    sink(s, k, n);
  for (int64_t end = n - 1; end > 0; end--) {
    exchange(s, 0, end);
    sink(s, 0, end);
  }
}

size_t carom_ways_memory(int64_t room) {
  if (room < 1 || room > INT32_MAX)
    return 0;
  return sizeof(workspace) + (size_t)room * sizeof(way_run);
}

static bool has_pointers(const carom_ways_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cues != NULL &&
         job->player != NULL && job->memory != NULL;
}

/* Whether all numbers of a job are in their ranges, except the numbers of its cues. */
static bool has_good_numbers(const carom_ways_job *job) {
  const bool counts = job->count >= 1 && job->count <= CAROM_BALLS_MOST && job->strokes >= 1 &&
                      job->scan >= job->strokes && job->rails >= 0 && job->reserved == 0;
  const bool names = job->ball >= -1 && job->ball < job->count && job->pocket >= -1;
  return counts && names && (uint32_t)job->goal <= CAROM_WAY_PLACE && job->radius >= 0.0;
}

/* Whether all strokes are of one ball of the layout. */
static bool has_one_cue_ball(const carom_ways_job *job) {
  const int64_t ball = job->cues->ball;
  if (ball < 0 || ball >= job->count)
    return false;
  for (int64_t k = 0; k < job->strokes; k++)
    if (job->cues[k].ball != ball)
      return false;
  return true;
}

/* Checks a job, and begins its search with memory for `room` ways. */
static carom_status begin(ways_search *s, const carom_ways_job *job, int64_t room) {
  static const carom_shot_options usual = {0};
  if (!has_pointers(job) || room < 1 || job->memory_size < carom_ways_memory(room))
    return CAROM_ERROR_NULL;
  if (!has_good_numbers(job) || !carom_player_is_good(job->player) || !has_one_cue_ball(job))
    return CAROM_ERROR_OPTIONS;
  *s = (ways_search){.job = job, .options = usual, .work = job->memory, .room = room};
  if (job->shot != NULL)
    s->options = *job->shot;
  s->run = (way_run *)(s->work + 1);
  s->work->features.radius = 0.0; /* nothing is prepared yet */
  return CAROM_OK;
}

carom_status carom_ways(const carom_ways_job *job, carom_shot_way *ways, int64_t room,
                        carom_ways_result *result) {
  ways_search s;
  if (result != NULL)
    *result = (carom_ways_result){0};
  if (ways == NULL || result == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = begin(&s, job, room);
  if (status != CAROM_OK)
    return status;
  s.found = ways;
  const bool good = scan(&s);
  if (good && !job->each)
    sort(&s);
  *result = s.result;
  return good ? CAROM_OK : s.status;
}

carom_status carom_way_chance(const carom_ways_job *job, carom_shot_way *w) {
  ways_search s;
  if (w == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = begin(&s, job, 1);
  if (status != CAROM_OK)
    return status;
  return find_chance(&s, w) ? CAROM_OK : s.status;
}
