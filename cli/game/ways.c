/* The search of `carom ways`: strokes in all directions. Those that pot or score are counted by the
 * rails and balls that they meet, and a way's best direction is the middle of the widest run of
 * neighbouring ones, whose ends are bisected. */
#include "game/ways.h"
#include "program/memory.h"
#include "program/message.h"
#include "shots/shot_story.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* strokes with errors for a chance; those of one batch; events of one that are read */
enum { TRIES = 400, BLOCK = 256, ROOM = 300, HALVINGS = 10 };
/* m/s, of the cue; and degrees, of a pot */
static const double SPEED_LEAST = 0.05, SPEED_MOST = 15.0, WINDOW_LEAST = 0.04;

const char *way_name(const ways_search *s, const way *w) {
  if (s->aim == TO_POT)
    return carom_plan_kind_name((carom_plan_kind)w->kind);
  return s->aim == TO_SCORE ? "point" : "place";
}

bool player_of(const given_player *options, carom_player *player) {
  if (options->rated && options->errs) {
    complain("--player is a rating, --errors are errors: give only one of them");
    return false;
  }
  if (options->rated)
    *player = carom_player_fargo(options->rating);
  else
    *player = carom_player_of(options->errs ? options->scale : 1.0);

  /* a player who is advised thinks of all strokes */
  player->only_pots = player->shots = 0.0;
  return true;
}

void without_bounds(carom_player *player) {
  player->speed_least = 0.01;
  player->speed_most = 1000.0;
  player->tip_most = 1.0;
}

/* Plays strokes of the layout; false after a complaint. */
static bool play(const ways_search *s, const carom_cue *cues, int n, carom_shot *shots) {
  const carom_shot_job job = {.table = &s->line->table->table,
                              .balls = s->line->ball,
                              .cues = cues,
                              .count = s->line->count,
                              .cue_stride = 1,
                              .n = (uint64_t)n,
                              .options = &s->options,
                              .shots = shots};
  const carom_status status = carom_shoot_batch(&job);
  if (status < 0)
    complain("the strokes cannot be played: %s", carom_status_string(status));
  return status >= 0;
}

bool way_is_good(const ways_search *s, const carom_facts *f, const carom_ball_state *final,
                 const way *w) {
  const int cue = (int)s->line->cue.ball;

  /* a stroke that loses the cue ball is none, nor is a double hit, as games rule on it */
  const uint32_t faults = CAROM_MARK_SCRATCH | CAROM_MARK_DOUBLE_HIT;
  if ((carom_stroke_marks(f, cue) & faults) != 0 || (f->off >> cue & 1) != 0)
    return false;

  const double *r = final[cue].r;
  if (s->radius > 0.0 && hypot(r[0] - s->place[0], r[1] - s->place[1]) > s->radius)
    return false;
  if (s->aim == TO_PLACE)
    return true;
  if (s->aim == TO_SCORE)
    return f->first[1] >= 0 && f->cushions_before[1] >= 3;
  return w->ball >= 0 && (f->down >> w->ball & 1) != 0 && f->pocket[w->ball] == w->pocket;
}

bool ways_chance(const ways_search *s, way *w) {
  static carom_shot shot[TRIES];
  static carom_facts facts[TRIES];
  static carom_cue cue[TRIES];
  static carom_ball_state final[TRIES][CAROM_BALLS_MOST];
  int good = 0;
  for (int k = 0; k < TRIES; k++) {
    cue[k] = w->cue;
    carom_player_strike(&s->player, 0, (uint64_t)k, &cue[k]);
    shot[k] = (carom_shot){.facts = &facts[k], .final = final[k]};
  }
  if (!play(s, cue, TRIES, shot))
    return false;
  for (int k = 0; k < TRIES; k++)
    good += way_is_good(s, &facts[k], final[k], w);
  w->chance = (double)good / TRIES;
  w->error = sqrt(w->chance * (1.0 - w->chance) / TRIES);
  return true;
}

/* ---- What a shot tells */

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
  if (w->parts == MOST_PARTS)
    return false;
  w->part[w->parts++] = part;
  return true;
}

/* Adds the rail of an event, by the first one of its name, to what a ball meets; the cut of a
 * pocket is none, nor is a hop on the rail before. False where there is no room. */
static bool add_rail(const ways_search *s, const carom_event *e, bool hop, way *w, int *rails) {
  const carom_table *t = &s->line->table->table;
  if (hop || !is_cushion(t, e->b))
    return true;
  const char *name = carom_rail_name(t, e->b);
  ++*rails;
  return add_part(w, (carom_part){CAROM_PART_RAIL, name != NULL ? first_rail(t, name) : e->b});
}

static bool is_of(const carom_event *e, int type, int ball) {
  return e->type == type && (e->a == ball || (type == CAROM_EVENT_BALL_BALL && e->b == ball));
}

/* The first contact of a ball; of those of one instant that with the cue ball. */
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

/* Rails of a way, and the last ones of them, beside the pocket, that the ball touches as it
 * falls. */
typedef struct rail_count {
  int total, at_pocket;
} rail_count;

/* Adds to a way the rails and other balls that ball n of the chain meets from its first contact on,
 * up to that with the next one, or to its fall. False where there is no room. */
static bool add_link(const ways_search *s, const carom_shot *shot, const pot_chain *chain, int n,
                     way *w, rail_count *rails) {
  const carom_table *t = &s->line->table->table;
  const int ball = chain->ball[n], cue = (int)s->line->cue.ball;
  const double end = n > 0 ? chain->start[n - 1] : shot->facts->pocket_time[ball];
  int last = -1; /* rail */
  for (int64_t k = 0; k < shot->count && shot->events[k].time <= end; k++) {
    const carom_event *e = &shot->events[k];
    if (e->time < chain->start[n])
      continue;
    if (is_of(e, CAROM_EVENT_RAIL, ball)) {
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
  const int cue = (int)s->line->cue.ball;
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
  w->kind = carom_pot_kind(&s->line->table->table, shot, cue, w->ball, w->pocket);
  return w->kind >= 0 && rails.total - rails.at_pocket <= s->rails;
}

/* The way of a point or to a place: what the cue ball meets, of a point up to the second ball. */
static bool read_point(const ways_search *s, const carom_shot *shot, way *w) {
  const int cue = (int)s->line->cue.ball;
  int balls = 0, rails = 0, hit_balls[2] = {-1, -1};
  const carom_event *last = NULL;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_event *e = &shot->events[k];
    const int partner = e->a == cue ? e->b : e->a;
    if (is_of(e, CAROM_EVENT_RAIL, cue)) {
      const bool hop = last != NULL && last->b == e->b && e->time - last->time < SAME_CONTACT;
      if (!add_rail(s, e, hop, w, &rails))
        return false;
      last = e;
    }
    if (is_of(e, CAROM_EVENT_BALL_BALL, cue) && partner != hit_balls[0] &&
        partner != hit_balls[1]) {
      if (balls == 2 || !add_part(w, (carom_part){CAROM_PART_BALL, partner}))
        return false;
      hit_balls[balls++] = partner;
      if (s->aim == TO_SCORE && balls == 2)
        return rails >= 3;
    }
  }
  return rails <= s->rails && s->aim == TO_PLACE;
}

/* The angle from the way of the cue ball, just before its first contact, to the line of centres,
 * degrees; NAN where there is none. */
static double cut_of(const carom_shot *shot, int cue) {
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_event *e = &shot->events[k];
    if (!is_of(e, CAROM_EVENT_BALL_BALL, cue))
      continue;
    const carom_ball_state *striker = &e->before[e->a != cue], *object = &e->before[e->a == cue];
    const double x = object->r[0] - striker->r[0], y = object->r[1] - striker->r[1];
    return atan2(striker->v[0] * y - striker->v[1] * x, striker->v[0] * x + striker->v[1] * y) *
           57.29577951308232;
  }
  return NAN;
}

/* Plays a stroke, and reads its way, of which kind, ball and pocket are given. What comes of it: */
typedef enum stroke_read { NO_WAY, NO_ROOM, A_WAY } stroke_read;
static stroke_read read_stroke(const ways_search *s, const carom_cue *cue, way *w) {
  static carom_event event[ROOM];
  static carom_facts facts;
  static carom_ball_state final[CAROM_BALLS_MOST];
  carom_shot shot = {.events = event, .room = ROOM, .facts = &facts, .final = final};
  if (carom_shoot(&s->line->table->table, s->line->ball, s->line->count, cue, &s->options, &shot) <
          0 ||
      !way_is_good(s, &facts, final, w))
    return NO_WAY;
  w->parts = 0;
  if (shot.count > ROOM)
    return NO_ROOM;
  const bool read = s->aim == TO_POT ? read_pot(s, &shot, w) : read_point(s, &shot, w);
  if (read) {
    w->cut = cut_of(&shot, (int)cue->ball);
    return A_WAY;
  }
  return s->aim == TO_SCORE && w->parts == MOST_PARTS ? NO_ROOM : NO_WAY;
}

static bool is_same(const way *a, const way *b) {
  return a->kind == b->kind && a->ball == b->ball && a->pocket == b->pocket &&
         a->parts == b->parts && memcmp(a->part, b->part, (size_t)a->parts * sizeof *a->part) == 0;
}

/* ---- Strokes in all directions */

/* Counts a way of direction k of a stroke. Of pots each window of a stroke is a way. */
static void count_way(ways_search *s, const way *seen, int stroke, int64_t k, double step) {
  const bool pots = s->aim == TO_POT;
  int index = 0;
  while (index < s->ways &&
         !(is_same(&s->way[index], seen) &&
           (!pots || (s->way[index].stroke == stroke && s->way[index].last == k - 1))))
    index++;
  if (index == MOST_WAYS) {
    s->left_out++;
    return;
  }
  way *w = &s->way[index];
  if (index == s->ways) {
    *w = *seen;
    w->stroke = stroke;
    w->last = -2;
    s->ways++;
  }
  w->found++;
  w->run = w->last == k - 1 ? w->run + 1 : 1;
  w->last = k;
  if (w->run > w->longest) {
    w->longest = w->run;
    w->end = step * (double)k;
    w->stroke = stroke;
  }
}

/* Counts the way of the ball, -1 of points and places, by the stroke of direction k where its shot
 * is good, or that there was no room for it. */
static void read_shot(ways_search *s, const carom_shot *shot, const carom_cue *cue, int ball,
                      int stroke, int64_t k, double step) {
  way seen = {.kind = -1, .ball = ball, .pocket = -1};
  if (ball >= 0)
    seen.pocket = shot->facts->pocket[ball];
  if (!way_is_good(s, shot->facts, shot->final, &seen))
    return;
  switch (read_stroke(s, cue, &seen)) {
  case A_WAY:
    s->good++;
    count_way(s, &seen, stroke, k, step);
    break;
  case NO_ROOM:
    s->left_out++;
    break;
  case NO_WAY:
    break;
  }
}

/* Whether the way is that of its stroke with another value of *field, of its cue. */
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

/* The best stroke of a way that was counted, the window around it, and its chance; false after a
 * complaint. */
static bool finish_way(ways_search *s, way *w, double step) {
  const double begin = w->end - step * (double)(w->longest - 1);
  w->cue = s->stroke[w->stroke];
  w->phi[0] = edge_of(s, w, &w->cue.phi, begin, 1.0, -step, w->end - 360.0, w->end);
  w->phi[1] = edge_of(s, w, &w->cue.phi, w->end, 1.0, step, begin, begin + 360.0);
  const double middle = 0.5 * (w->phi[0] + w->phi[1]);
  w->cue.phi = w->end - step * (double)((w->longest - 1) / 2);
  if (holds(s, w, &w->cue.phi, middle))
    w->cue.phi = middle;
  way probe = {.kind = -1, .ball = w->ball, .pocket = w->pocket};
  if (read_stroke(s, &w->cue, &probe) == A_WAY)
    w->cut = probe.cut;
  w->speed[0] = w->speed[1] = w->cue.speed;
  const bool pots = s->aim == TO_POT, narrow = pots && w->phi[1] - w->phi[0] < WINDOW_LEAST;
  for (int end = 0; end < 2 && pots && !narrow; end++)
    w->speed[end] = edge_of(s, w, &w->cue.speed, w->cue.speed, end == 0 ? 1.0 / 1.1 : 1.1, 0.0,
                            SPEED_LEAST, SPEED_MOST);
  return narrow || ways_chance(s, w);
}

/* Of the ways of pots those that are wide enough stay, each once where directions end; and of those
 * that differ by the stroke alone, unless each is asked for, that with the best chance. */
static void keep_best(ways_search *s, double step) {
  int retained = 0;
  for (int k = 0; k < s->ways; k++) {
    const way w = s->way[k];
    int index = retained;
    if (w.phi[1] - w.phi[0] < WINDOW_LEAST || w.phi[0] <= -step)
      continue;
    for (int n = 0; n < retained && !s->each; n++)
      if (is_same(&s->way[n], &w))
        index = n;
    if (index == retained || w.chance > s->way[index].chance)
      s->way[index] = w;
    retained += index == retained;
  }
  s->ways = retained;
}

/* Whether a shot pots a ball that is asked for into a pocket that is. */
static bool is_asked(const ways_search *s, const carom_facts *facts, int ball) {
  return ball != s->line->cue.ball && (s->ball < 0 || ball == s->ball) &&
         (s->pocket < 0 || facts->pocket[ball] == s->pocket);
}

/* Plays n directions of a stroke, from direction `first` on, and counts their ways; false after a
 * complaint. */
static bool scan_block(ways_search *s, int stroke, int64_t first, int n, double step) {
  static carom_shot shot[BLOCK];
  static carom_facts facts[BLOCK];
  static carom_cue cue[BLOCK];
  static carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  for (int k = 0; k < n; k++) {
    cue[k] = s->stroke[stroke];
    cue[k].phi = step * (double)(first + k);
    shot[k] = (carom_shot){.facts = &facts[k], .final = final[k]};
  }
  if (!play(s, cue, n, shot))
    return false;

  for (int k = 0; k < n; k++) {
    s->scanned++;
    if (s->aim != TO_POT)
      read_shot(s, &shot[k], &cue[k], -1, stroke, first + k, step);
    for (int ball = 0; ball < s->line->count && s->aim == TO_POT; ball++)
      if (is_asked(s, &facts[k], ball))
        read_shot(s, &shot[k], &cue[k], ball, stroke, first + k, step);
  }
  return true;
}

/* Plays strokes in all directions; false after a complaint. */
static bool scan(ways_search *s) {
  const int64_t each = s->scan / s->strokes;
  const double step = 360.0 / (double)each;
  bool fine = true;
  for (int stroke = 0; stroke < s->strokes && fine; stroke++)
    for (int64_t start = 0; start < each && fine; start += BLOCK) {
      const int64_t left = each - start;
      fine = scan_block(s, stroke, start, left < BLOCK ? (int)left : BLOCK, step);
      progress_show("strokes", (double)s->scanned, (double)(each * s->strokes));
    }
  for (int k = 0; k < s->ways && fine; k++) {
    fine = finish_way(s, &s->way[k], step);
    progress_show("ways", (double)k, (double)s->ways);
  }
  progress_clear();
  if (s->aim == TO_POT && fine)
    keep_best(s, step);
  return fine;
}

/* ---- All of it */

bool ways_find(ways_search *s) {
  const bool good = scan(s);
  if (good && s->left_out > 0)
    complain("%lld strokes are left out: there is room for %d ways, %d rails and balls of a point "
             "and %d events of a shot",
             (long long)s->left_out, MOST_WAYS, MOST_PARTS, ROOM);
  return good;
}
