/* The search of `carom ways`.
 *
 * Direct pots, banks, kicks and combinations are aimed by carom_aim(), each with every stroke. What
 * it does not aim, caroms and the points of three-cushion, is read off strokes in all directions:
 * those that pot or score are counted by the rails and balls that they meet, and a way's best
 * stroke is the middle of the widest run of neighbouring directions. */
#include "ways.h"
#include "memory.h"
#include "message.h"
#include "shot_story.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* strokes with errors for a chance; those of one batch; events of one that are read */
enum { TRIES = 400, BLOCK = 256, ROOM = 300, HALVINGS = 10 };

const char *const way_names[] = {"direct", "bank",  "kick", "combination",
                                 "carom",  "point", "place"};

bool player_of(const given_player *given, carom_player *player) {
  *player = given->rated ? carom_player_fargo(given->rating)
                         : carom_player_of(given->errs ? given->scale : 1.0);
  if (given->rated && given->errs)
    complain("--player is a rating, --errors are errors: give one of both");
  return !(given->rated && given->errs);
}

void without_bounds(carom_player *player) {
  player->speed_least = 0.01;
  player->speed_most = 1000.0;
  player->tip_most = 1.0;
}

bool is_out_of_play(const shot_line *line, int ball) {
  const int64_t label = line->ball[ball].state.label;
  return label == CAROM_BALL_POCKETED || label == CAROM_BALL_OFF;
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
  const carom_status bad = carom_shoot_batch(&job);
  if (bad < 0)
    complain("the strokes cannot be played: %s", carom_status_string(bad));
  return bad >= 0;
}

bool way_is_good(const ways_search *s, const carom_facts *f, const carom_ball_state *final,
                 const way *w) {
  const uint32_t cue = (uint32_t)1 << s->line->cue.ball;
  if ((f->down | f->off) & cue)
    return false;
  const double *r = final[s->line->cue.ball].r;
  if (s->radius > 0.0 && hypot(r[0] - s->place[0], r[1] - s->place[1]) > s->radius)
    return false;
  if (w->kind == PLACE)
    return true;
  return w->kind == POINT
             ? f->first[1] >= 0 && f->cushions_before[1] >= 3
             : w->ball >= 0 && (f->down >> w->ball & 1) && f->pocket[w->ball] == w->pocket;
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

/* ---- Ways that carom_aim() aims */

static void add_way(ways_search *s, const way *w) {
  if (s->ways < MOST_WAYS)
    s->way[s->ways++] = *w;
  else
    s->left_out++;
}

/* Aims a way with each stroke, and keeps the one with the best chance; false after a complaint. */
static bool try_way(ways_search *s, way_kind kind, int ball, int pocket, const carom_part *via,
                    int vias) {
  way best = {.chance = -1.0};
  for (int k = 0; k < s->strokes; k++) {
    carom_pot pot = {.ball = ball, .pocket = pocket, .vias = vias};
    if (vias > 0)
      memcpy(pot.via, via, (size_t)vias * sizeof *via);
    carom_cue cue = s->stroke[k];
    const carom_status bad =
        carom_aim(&s->line->table->table, s->line->ball, s->line->count, &s->options, &pot, &cue);
    if (bad < 0) {
      complain("the layout cannot be played: %s", carom_status_string(bad));
      return false;
    }
    if (kind != KICK && (pot.is == CAROM_POT_NO_WAY || pot.is == CAROM_POT_BARRED))
      return true; /* by every stroke */
    if (pot.is != CAROM_POT_FALLS)
      continue;
    way w = {.kind = kind, .ball = ball, .pocket = pocket, .cue = cue, .cut = pot.cut, .stroke = k};
    w.margin = pot.margin;
    memcpy(w.phi, pot.phi, sizeof w.phi);
    memcpy(w.speed, pot.speed, sizeof w.speed);
    for (int n = 0; n < vias; n++)
      if (via[n].kind != CAROM_PART_BALL || via[n].index != ball)
        w.part[w.parts++] = via[n];
    if (!ways_chance(s, &w))
      return false;
    if (s->each)
      add_way(s, &w);
    else if (w.chance > best.chance)
      best = w;
  }
  if (best.chance >= 0.0)
    add_way(s, &best);
  return true;
}

/* The first rail of a name, or -1. */
static int first_rail(const carom_table *t, const char *name) {
  for (int k = 0; k < t->rails; k++) {
    const char *own = carom_rail_name(t, k);
    if (own != NULL && strcmp(own, name) == 0)
      return k;
  }
  return -1;
}

static int named_rails(const carom_table *t, carom_part rail[4]) {
  static const char *const names[] = {"head", "foot", "left", "right"};
  int count = 0;
  for (int n = 0; n < 4; n++) {
    const int k = first_rail(t, names[n]);
    if (k >= 0)
      rail[count++] = (carom_part){CAROM_PART_RAIL, k};
  }
  return count;
}

/* All ways of a ball into a pocket that can be aimed; false after a complaint. */
static bool try_ways(ways_search *s, int ball, int pocket) {
  carom_part rail[4], via[3];
  const int rails = named_rails(&s->line->table->table, rail);
  const carom_part own = {CAROM_PART_BALL, ball};
  bool good = try_way(s, DIRECT, ball, pocket, NULL, 0);
  for (int other = 0; other < s->line->count && good; other++)
    if (other != ball && other != s->line->cue.ball && !is_out_of_play(s->line, other)) {
      via[0] = (carom_part){CAROM_PART_BALL, other};
      good = try_way(s, COMBINATION, ball, pocket, via, 1);
    }

  /* banks name the rails alone; of kicks the ball comes behind them */
  for (int a = 0; a < rails && good; a++)
    for (int b = -1; b < rails && good; b++) {
      const int count = b < 0 ? 1 : 2;
      if (count > s->rails || a == b)
        continue;
      via[0] = rail[a];
      via[1] = b < 0 ? own : rail[b];
      via[2] = own;
      good = try_way(s, BANK, ball, pocket, via, count) &&
             try_way(s, KICK, ball, pocket, via, count + 1);
    }
  return good;
}

/* ---- Ways that are read off strokes in all directions */

/* Adds a part to a way. False where there is no room. */
static bool add_part(way *w, carom_part part) {
  if (w->parts == MOST_PARTS)
    return false;
  w->part[w->parts++] = part;
  return true;
}

/* The rail of an event by the first one of its name; false for the cut of a pocket. */
static bool rail_of(const carom_table *t, int rail, carom_part *part) {
  if (!is_cushion(t, rail))
    return false;
  const char *name = carom_rail_name(t, rail);
  *part = (carom_part){CAROM_PART_RAIL, name != NULL ? first_rail(t, name) : rail};
  return true;
}

/* The way of a good shot: what the cue ball meets up to the ball of the way, or of a point up to
 * the second ball; then the rails of that ball. False where it is none that is told here. */
static bool read_way(const ways_search *s, const carom_shot *shot, way *w) {
  const int cue = (int)s->line->cue.ball;
  int balls = 0, rails = 0, met[2] = {-1, -1};
  double last = -INFINITY; /* when a rail was met, */
  int same = -1;           /* and which: a further hop there at once is none */
  bool reached = false;
  if (shot->count > ROOM)
    return false;
  for (int64_t k = 0; k < shot->count; k++) {
    const carom_brief_event *e = &shot->brief[k];
    carom_part part;
    const int mover = reached ? w->ball : cue;
    if (e->type == CAROM_EVENT_POCKET && e->a == w->ball)
      break;
    if (e->type == CAROM_EVENT_RAIL && e->a == mover &&
        rail_of(&s->line->table->table, e->b, &part)) {
      const bool hop = e->b == same && e->time - last < SAME_CONTACT;
      same = e->b;
      last = e->time;
      if (!hop && !add_part(w, part))
        return false;
      rails += !hop;
    }
    if (e->type != CAROM_EVENT_BALL_BALL)
      continue;
    const bool own = e->a == cue || e->b == cue;
    const int other = e->a == cue ? e->b : e->a;
    if (w->kind != POINT && (e->a == w->ball || e->b == w->ball)) {
      if (!own || reached) /* another ball pots it, or the cue ball once more */
        return false;
      reached = true;
    } else if (own && !reached && other != met[0] && other != met[1]) {
      if (balls == 2 || !add_part(w, (carom_part){CAROM_PART_BALL, other}))
        return false;
      met[balls++] = other;
      if (w->kind == POINT && balls == 2)
        return rails >= 3;
    }
  }
  return rails <= s->rails && (w->kind == PLACE || (w->kind == CAROM && reached && balls > 0));
}

/* Whether a way was not read because its shot or a point has too many parts; other ways with so
 * many have too many rails. */
static bool has_no_room(const carom_shot *shot, const way *w) {
  return shot->count > ROOM || (w->kind == POINT && w->parts == MOST_PARTS);
}

/* Counts a way of direction k of a stroke. */
static void count_way(ways_search *s, const way *seen, int stroke, int64_t k, double step) {
  int at = 0;
  while (at < s->ways) {
    const way *w = &s->way[at];
    if (w->kind == seen->kind && w->ball == seen->ball && w->pocket == seen->pocket &&
        w->parts == seen->parts &&
        memcmp(w->part, seen->part, (size_t)w->parts * sizeof *w->part) == 0)
      break;
    at++;
  }
  if (at == MOST_WAYS) {
    s->left_out++;
    return;
  }
  way *w = &s->way[at];
  if (at == s->ways) {
    *w = *seen;
    w->last = -2;
    s->ways++;
  }
  w->found++;
  w->run = w->last == k - 1 ? w->run + 1 : 1;
  w->last = k;
  if (w->run > w->longest) {
    w->longest = w->run;
    /* of these directions */
    w->middle = step * (double)k - step * (double)((w->run - 1) / 2);
    w->stroke = stroke;
  }
}

/* Counts the way of the ball, -1 of points and places, by the shot of direction k of a stroke where
 * the shot is good, or that there was no room for it. */
static void read_shot(ways_search *s, const carom_shot *shot, int ball, int stroke, int64_t k,
                      double step) {
  way seen = {.kind = s->counted, .ball = ball, .pocket = -1};
  if (ball >= 0)
    seen.pocket = shot->facts->pocket[ball];
  if (!way_is_good(s, shot->facts, shot->final, &seen))
    return;
  if (!read_way(s, shot, &seen))
    s->left_out += has_no_room(shot, &seen);
  else {
    s->good++;
    count_way(s, &seen, stroke, k, step);
  }
}

/* Whether the way is that of a stroke in this direction. */
static bool holds(const ways_search *s, const way *w, double phi) {
  static carom_brief_event brief[ROOM];
  carom_facts facts;
  carom_cue cue = w->cue;
  cue.phi = phi;
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_shot shot = {.brief = brief, .room = ROOM, .facts = &facts, .final = final};
  way seen = {.kind = w->kind, .ball = w->ball, .pocket = w->pocket};
  return carom_shoot(&s->line->table->table, s->line->ball, s->line->count, &cue, &s->options,
                     &shot) >= 0 &&
         way_is_good(s, &facts, final, w) && read_way(s, &shot, &seen) && seen.parts == w->parts &&
         memcmp(seen.part, w->part, (size_t)w->parts * sizeof *w->part) == 0;
}

/* The best stroke of a way that was counted, the window around it, and its chance; false after a
 * complaint. */
static bool finish_way(ways_search *s, way *w, double step) {
  w->cue = s->stroke[w->stroke];
  for (int end = 0; end < 2; end++) {
    const double away = (end == 0 ? -1.0 : 1.0) * step;
    double in = w->middle, out = in + away * (0.5 * (double)w->longest + 1.0);
    for (int k = 0; k < HALVINGS; k++) {
      const double middle = 0.5 * (in + out);
      *(holds(s, w, middle) ? &in : &out) = middle;
    }
    w->phi[end] = in;
  }
  const double middle = 0.5 * (w->phi[0] + w->phi[1]);
  w->cue.phi = holds(s, w, middle) ? middle : w->middle;
  w->cut = w->margin = w->speed[0] = w->speed[1] = NAN;
  return ways_chance(s, w);
}

/* Plays strokes in all directions; false after a complaint. */
static bool scan(ways_search *s) {
  static carom_shot shot[BLOCK];
  static carom_facts facts[BLOCK];
  static carom_cue cue[BLOCK];
  static carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  const int64_t each = s->scan / s->strokes;
  const double step = 360.0 / (double)each;
  const int first = s->ways;
  carom_brief_event *brief = allocate((size_t)BLOCK * ROOM, sizeof *brief);
  bool fine = true;
  for (int stroke = 0; stroke < s->strokes && fine; stroke++)
    for (int64_t from = 0; from < each && fine; from += BLOCK) {
      const int n = (int)(each - from < BLOCK ? each - from : BLOCK);
      for (int k = 0; k < n; k++) {
        cue[k] = s->stroke[stroke];
        cue[k].phi = step * (double)(from + k);
        shot[k] = (carom_shot){
            .brief = brief + k * ROOM, .room = ROOM, .facts = &facts[k], .final = final[k]};
      }
      fine = play(s, cue, n, shot);
      for (int k = 0; k < n && fine; k++) {
        s->scanned++;
        if (s->counted != CAROM)
          read_shot(s, &shot[k], -1, stroke, from + k, step);
        for (int ball = 0; ball < s->line->count && s->counted == CAROM; ball++)
          if (ball != s->line->cue.ball && (s->ball < 0 || ball == s->ball) &&
              (s->pocket < 0 || facts[k].pocket[ball] == s->pocket))
            read_shot(s, &shot[k], ball, stroke, from + k, step);
      }
      progress_show("strokes", (double)s->scanned, (double)(each * s->strokes));
    }
  progress_clear();
  free(brief);
  for (int k = first; k < s->ways && fine; k++)
    fine = finish_way(s, &s->way[k], step);
  return fine;
}

/* ---- All of it */

bool ways_find(ways_search *s) {
  const int pockets = (int)s->line->table->table.pockets;
  bool good = true;
  for (int k = 0; k < s->line->count && good && s->counted == CAROM; k++)
    for (int p = 0; p < pockets && good; p++)
      if (k != s->line->cue.ball && !is_out_of_play(s->line, k) && (s->ball < 0 || k == s->ball) &&
          (s->pocket < 0 || p == s->pocket)) {
        good = try_ways(s, k, p);
        progress_show("pots", (double)(k * pockets + p), (double)(s->line->count * pockets));
      }
  progress_clear();
  if (good && s->scan >= s->strokes)
    good = scan(s);
  if (good && s->left_out > 0)
    complain("%lld strokes are left out: there is room for %d ways, %d rails and balls of a point "
             "and %d events of a shot",
             (long long)s->left_out, MOST_WAYS, MOST_PARTS, ROOM);
  return good;
}
