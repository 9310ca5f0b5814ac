/* `carom ways`: which ways there are to pot a ball, or on a table without pockets to score.
 *
 * Direct pots, banks, kicks and combinations are aimed by carom_aim(), each with every stroke. What
 * it does not aim, caroms and the points of three-cushion, is read off strokes in all directions:
 * those that pot or score are counted by the rails and balls that they meet, and a way's best
 * stroke is the middle of the widest run of neighbouring directions. */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "options.h"
#include "output.h"
#include "picture.h"
#include "shoot_flags.h"
#include "shot_file.h"
#include "shot_picture.h"
#include "shot_story.h"
#include "subcommands.h"
#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST_STROKES = 320,
  MOST_WAYS = 2000,
  MOST_PARTS = 12,
  MOST_DRAWN = 8,
  PARTS_TEXT = 160,
  WAY_TEXT = 400
};
/* strokes with errors for a chance; those of one batch; events of one that are read */
enum { TRIES = 400, BLOCK = 256, ROOM = 300 };
/* directions of all strokes together */
enum { SCANNED = 20000, SCANNED_TO_SCORE = 100000, HALVINGS = 10 };

/* Where the cue ball shall end: within a radius of a place. */
typedef struct leave {
  bool given;
  value x, y, radius;
} leave;

typedef struct ways_job {
  shoot_flags from;
  leave leave;
  const char *ball, *pocket, *plot;
  int rails, scanned;
  bool csv, json, each;
} ways_job;

OPTION(ways_job, option_ball, "ball", ball, 0, "NAME|any", set_text, 0,
       "the ball to be potted (default any)");
OPTION(ways_job, option_to_pocket, "pocket", pocket, 0, "NAME|any", set_text, 0,
       "the pocket that it shall fall into, such as foot-left (default any)");
OPTION(ways_job, option_rails, "rails", rails, 0, "0|1|2", set_choice, 0,
       "most rails of banks, kicks and caroms (default 2)");
static OPTION_SET(set_leave) {
  leave *to = field;
  char copy[PLACE_TEXT], spelt[PLACE_TEXT], *rest = NULL;
  value *part[] = {&to->x, &to->y, &to->radius};
  int parts = 0;
  bool good = strlen(text) < sizeof copy;
  snprintf(copy, sizeof copy, "%s", place_spelt(text, spelt));
  value_of(MEASURE_LENGTH, "0.15", &to->radius);
  for (char *one = strtok_r(copy, ",", &rest); one != NULL && good;
       one = strtok_r(NULL, ",", &rest), parts++)
    good = parts < 3 && value_of(parts == 2 ? MEASURE_LENGTH : MEASURE_PLACE, one, part[parts]);
  to->given = good && parts >= 2 && to->radius.x > 0.0;
  if (!to->given)
    complain("--%s is X,Y or X,Y,R in m, or with units: 2d,4d,20cm, or PLACE or PLACE,R: " PLACES
             "; not '%.60s'",
             row->name, text);
  return to->given;
}

OPTION(ways_job, option_leave, "leave", leave, 0, "X,Y[,R]|PLACE[,R]", set_leave, 0,
       "the cue ball shall end within R (default 0.15 m) of this place, m, or with units, "
       "2d,4d,20cm, or named as in --cue, foot-spot,20cm. It counts for the chance, so that of "
       "several speeds and tips the one is told "
       "that brings it there. The cue ball alone is sent there without a pot");
OPTION(ways_job, option_scan, "scan", scanned, 0, "N", set_count, 0,
       "strokes in all directions that are searched for caroms (default 20000), or for points "
       "(default 100000); 0: none");
OPTION(
    ways_job, option_each, "each", each, 0, NULL, set_flag, 0,
    "tell each stroke by which a way comes off, in the order of the strokes, instead of the best "
    "one: how wide it is over speeds and tips");
OPTION(ways_job, option_ways_csv, "csv", csv, 0, NULL, set_flag, 0, "write rows instead of words");
OPTION(ways_job, option_ways_json, "json", json, 0, NULL, set_flag, 0,
       "write each way as the line of its stroke, for `carom shoot`, with an object `way`");
OPTION(ways_job, option_ways_plot, "plot", plot, 0, "OUT", set_picture, 0,
       "draw the eight best ways over each other");

typedef enum way_kind { DIRECT, BANK, KICK, COMBINATION, CAROM, POINT, PLACE } way_kind;
static const char *const kinds[] = {"direct", "bank",  "kick", "combination",
                                    "carom",  "point", "place"};

/* A way: the rails and balls that are met in their order, and its best stroke. NAN: not known. */
typedef struct way {
  way_kind kind;
  int ball, pocket; /* -1 of a point and a place */
  int parts;
  carom_part part[MOST_PARTS];
  carom_cue cue;
  double cut, margin, phi[2], speed[2]; /* as in carom_pot */
  double chance, error;                 /* of a player, and its standard error */
  int64_t found;                        /* of the strokes in all directions */
  /* of these: its run of neighbouring directions, and the longest one with its middle */
  int64_t last, run, longest;
  double middle;
  int stroke;
} way;

/* What is searched, and what was found. */
typedef struct search {
  way_kind counted; /* what strokes in all directions are read for: CAROM, POINT or PLACE */
  double place[2];  /* of --leave, m */
  const ways_job *job;
  const shot_line *line;
  carom_shot_options options;
  carom_player player;
  const carom_cue *stroke;
  int strokes;
  way *way;
  int ways;
  int64_t scanned, good;
} search;

static bool is_out(const search *s, int ball) {
  const int64_t label = s->line->ball[ball].state.label;
  return label == CAROM_BALL_POCKETED || label == CAROM_BALL_OFF;
}

/* Plays strokes of the layout; false after a complaint. */
static bool play(const search *s, const carom_cue *cues, int n, carom_shot *shots) {
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

/* Whether a shot pots the ball of a way without losing the cue ball, or scores: both balls met, the
 * second one after three cushions; and whether the cue ball ends where it shall. */
static bool is_good(const search *s, const carom_facts *f, const carom_ball_state *final,
                    const way *w) {
  const uint32_t cue = (uint32_t)1 << s->line->cue.ball;
  if ((f->down | f->off) & cue)
    return false;
  const double *r = final[s->line->cue.ball].r;
  if (s->job->leave.given && hypot(r[0] - s->place[0], r[1] - s->place[1]) > s->job->leave.radius.x)
    return false;
  if (w->kind == PLACE)
    return true;
  return w->kind == POINT
             ? f->first[1] >= 0 && f->cushions_before[1] >= 3
             : w->ball >= 0 && (f->down >> w->ball & 1) && f->pocket[w->ball] == w->pocket;
}

/* The share of strokes with errors that are good, with its error; false after a complaint. */
static bool find_chance(const search *s, way *w) {
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
    good += is_good(s, &facts[k], final[k], w);
  w->chance = (double)good / TRIES;
  w->error = sqrt(w->chance * (1.0 - w->chance) / TRIES);
  return true;
}

/* ---- Ways that carom_aim() aims */

/* Aims a way with each stroke, and keeps the one with the best chance; false after a complaint. */
static bool try_way(search *s, way_kind kind, int ball, int pocket, const carom_part *via,
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
    way w = {.kind = kind, .ball = ball, .pocket = pocket, .cue = cue, .cut = pot.cut};
    w.margin = pot.margin;
    memcpy(w.phi, pot.phi, sizeof w.phi);
    memcpy(w.speed, pot.speed, sizeof w.speed);
    for (int n = 0; n < vias; n++)
      if (via[n].kind != CAROM_PART_BALL || via[n].index != ball)
        w.part[w.parts++] = via[n];
    if (!find_chance(s, &w))
      return false;
    if (s->job->each && s->ways < MOST_WAYS)
      s->way[s->ways++] = w;
    else if (w.chance > best.chance)
      best = w;
  }
  if (best.chance >= 0.0 && s->ways < MOST_WAYS)
    s->way[s->ways++] = best;
  return true;
}

/* The first rail of each name. */
static int named_rails(const carom_table *t, carom_part rail[4]) {
  static const char *const names[] = {"head", "foot", "left", "right"};
  int count = 0;
  for (int n = 0; n < 4; n++)
    for (int k = 0; k < t->rails; k++) {
      const char *name = carom_rail_name(t, k);
      if (name != NULL && strcmp(name, names[n]) == 0) {
        rail[count++] = (carom_part){CAROM_PART_RAIL, k};
        break;
      }
    }
  return count;
}

/* All ways of a ball into a pocket that can be aimed; false after a complaint. */
static bool try_ways(search *s, int ball, int pocket) {
  carom_part rail[4], via[3];
  const int rails = named_rails(&s->line->table->table, rail);
  const carom_part own = {CAROM_PART_BALL, ball};
  bool good = try_way(s, DIRECT, ball, pocket, NULL, 0);
  for (int other = 0; other < s->line->count && good; other++)
    if (other != ball && other != s->line->cue.ball && !is_out(s, other)) {
      via[0] = (carom_part){CAROM_PART_BALL, other};
      good = try_way(s, COMBINATION, ball, pocket, via, 1);
    }

  /* banks name the rails alone; of kicks the ball comes behind them */
  for (int a = 0; a < rails && good; a++)
    for (int b = -1; b < rails && good; b++) {
      const int count = b < 0 ? 1 : 2;
      if (count > s->job->rails || a == b)
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
  int first = 0;
  while (name != NULL && first < rail) {
    const char *other = carom_rail_name(t, first);
    if (other != NULL && strcmp(other, name) == 0)
      break;
    first++;
  }
  *part = (carom_part){CAROM_PART_RAIL, name != NULL ? first : rail};
  return true;
}

/* The way of a good shot: what the cue ball meets up to the ball of the way, or of a point up to
 * the second ball; then the rails of that ball. False where it is none that is told here. */
static bool read_way(const search *s, const carom_shot *shot, way *w) {
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
  return rails <= s->job->rails && (w->kind == PLACE || (w->kind == CAROM && reached && balls > 0));
}

/* Counts a way of direction k of a stroke. */
static void count_way(search *s, const way *seen, int stroke, int64_t k, double phi, double step) {
  int at = 0;
  while (at < s->ways) {
    const way *w = &s->way[at];
    if (w->kind == seen->kind && w->ball == seen->ball && w->pocket == seen->pocket &&
        w->parts == seen->parts &&
        memcmp(w->part, seen->part, (size_t)w->parts * sizeof *w->part) == 0)
      break;
    at++;
  }
  if (at == MOST_WAYS)
    return;
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
    w->middle = phi - step * (double)((w->run - 1) / 2); /* of these directions */
    w->stroke = stroke;
  }
}

/* Whether the way is that of a stroke in this direction. */
static bool holds(const search *s, const way *w, double phi) {
  static carom_brief_event brief[ROOM];
  carom_facts facts;
  carom_cue cue = w->cue;
  cue.phi = phi;
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_shot shot = {.brief = brief, .room = ROOM, .facts = &facts, .final = final};
  way seen = {.kind = w->kind, .ball = w->ball, .pocket = w->pocket};
  return carom_shoot(&s->line->table->table, s->line->ball, s->line->count, &cue, &s->options,
                     &shot) >= 0 &&
         is_good(s, &facts, final, w) && read_way(s, &shot, &seen) && seen.parts == w->parts &&
         memcmp(seen.part, w->part, (size_t)w->parts * sizeof *w->part) == 0;
}

/* The best stroke of a way that was counted, the window around it, and its chance; false after a
 * complaint. */
static bool finish_way(search *s, way *w, double step) {
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
  return find_chance(s, w);
}

/* Plays strokes in all directions; false after a complaint. */
static bool scan(search *s, int only_ball, int only_pocket) {
  static carom_shot shot[BLOCK];
  static carom_facts facts[BLOCK];
  static carom_cue cue[BLOCK];
  static carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  const int64_t each = s->job->scanned / s->strokes;
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
        const carom_facts *f = &facts[k];
        s->scanned++;
        if (s->counted != CAROM) {
          way seen = {.kind = s->counted, .ball = -1, .pocket = -1};
          if (!is_good(s, f, final[k], &seen) || !read_way(s, &shot[k], &seen))
            continue;
          s->good++;
          count_way(s, &seen, stroke, from + k, cue[k].phi, step);
        }
        for (int ball = 0; ball < s->line->count && s->counted == CAROM; ball++) {
          way seen = {.kind = CAROM, .ball = ball, .pocket = f->pocket[ball]};
          if (ball != s->line->cue.ball && (only_ball < 0 || ball == only_ball) &&
              (f->down >> ball & 1) && (only_pocket < 0 || f->pocket[ball] == only_pocket) &&
              is_good(s, f, final[k], &seen) && read_way(s, &shot[k], &seen))
            count_way(s, &seen, stroke, from + k, cue[k].phi, step);
        }
      }
      progress_show("strokes", (double)s->scanned, (double)(each * s->strokes));
    }
  progress_clear();
  free(brief);
  for (int k = first; k < s->ways && fine; k++)
    fine = finish_way(s, &s->way[k], step);
  return fine;
}

/* ---- What is told */

static int by_chance(const void *a, const void *b) {
  const way *one = a, *other = b;
  if (one->chance != other->chance)
    return one->chance < other->chance ? 1 : -1;
  const double wide = one->phi[1] - one->phi[0], others = other->phi[1] - other->phi[0];
  return wide < others ? 1 : wide > others ? -1 : 0;
}

/* "left, 2": the rails and balls of a way. */
static const char *say_parts(const search *s, const way *w, char text[PARTS_TEXT]) {
  text[0] = '\0';
  for (int k = 0; k < w->parts; k++) {
    const bool rail = w->part[k].kind == CAROM_PART_RAIL;
    const char *name = rail ? carom_rail_name(&s->line->table->table, w->part[k].index) : NULL;
    snprintf(text + strlen(text), PARTS_TEXT - strlen(text), "%s%s", k > 0 ? ", " : "",
             name != NULL ? name
             : rail       ? s->line->table->rail[w->part[k].index]
                          : s->line->name[w->part[k].index]);
  }
  return text;
}

/* "1 to foot-left, bank: left" */
static const char *say_way(const search *s, const way *w, char text[WAY_TEXT]) {
  char parts[PARTS_TEXT];
  const char *pocket = w->pocket >= 0 ? carom_pocket_name(&s->line->table->table, w->pocket) : NULL;
  say_parts(s, w, parts);
  if (w->ball < 0)
    snprintf(text, WAY_TEXT, "%s", w->parts > 0 ? parts : "straight");
  else
    snprintf(text, WAY_TEXT, "%s to %s, %s%s%s", s->line->name[w->ball],
             pocket != NULL ? pocket : s->line->table->pocket[w->pocket], kinds[w->kind],
             w->parts > 0 ? ": " : "", parts);
  return text;
}

static void tell(FILE *out, const search *s, int most) {
  const bool counted = s->counted != CAROM;
  char text[WAY_TEXT];
  if (s->ways == 0)
    fputs("There is no way.\n", out);
  else
    fprintf(out, "    chance   window  %s   speed   tip           aim  way\n",
            counted ? "    of all" : "       cut");
  for (int k = 0; k < s->ways && k < most; k++) {
    const way *w = &s->way[k];
    char middle[24] = "";
    if (counted)
      snprintf(middle, sizeof middle, "%.3f %%", 100.0 * (double)w->found / (double)s->scanned);
    else if (!isnan(w->cut))
      snprintf(middle, sizeof middle, "%.1f %s", fabs(w->cut), w->cut < 0.0 ? "right" : "left");
    fprintf(out, "%8.1f %% %8.2f  %10s %7.3g  %+.2f,%+.2f  %7.2f  %s\n", 100.0 * w->chance,
            w->phi[1] - w->phi[0], middle, w->cue.speed, 0.0 - w->cue.a, w->cue.b, w->cue.phi,
            say_way(s, w, text));
  }
  if (counted)
    fprintf(out, "%lld of %lld strokes %s, %.2f %%, by %d ways.\n", (long long)s->good,
            (long long)s->scanned, s->counted == POINT ? "score" : "get there",
            100.0 * (double)s->good / (double)(s->scanned + !s->scanned), s->ways);
}

static void write_rows(FILE *out, const search *s) {
  char parts[PARTS_TEXT];
  fputs("rank,kind,ball,pocket,way,speed,phi,theta,a,b,cut,margin,phi_low,phi_high,speed_low,"
        "speed_high,chance,error,found,scanned\n",
        out);
  for (int k = 0; k < s->ways; k++) {
    const way *w = &s->way[k];
    fprintf(out, "%d,%s,%s,%s,\"%s\",%.17g,%.17g,%.17g,%.17g,%.17g,", k + 1, kinds[w->kind],
            w->ball >= 0 ? s->line->name[w->ball] : "",
            w->pocket >= 0 ? s->line->table->pocket[w->pocket] : "", say_parts(s, w, parts),
            w->cue.speed, w->cue.phi, w->cue.theta, w->cue.a, w->cue.b);
    const double more[] = {w->cut, w->margin, w->phi[0], w->phi[1], w->speed[0], w->speed[1]};
    for (size_t n = 0; n < sizeof more / sizeof more[0]; n++)
      fprintf(out, isnan(more[n]) ? "," : "%.10g,", more[n]);
    fprintf(out, "%.6f,%.6f,%lld,%lld\n", w->chance, w->error, (long long)w->found,
            (long long)s->scanned);
  }
}

/* The line of a way's stroke. */
static json_t *line_of(const search *s, const way *w) {
  char text[WAY_TEXT], parts[PARTS_TEXT];
  json_t *to = json_object(), *cue = json_object();
  json_object_set_new(to, "kind", json_string("shot"));
  json_object_set_new(to, "id", json_string(say_way(s, w, text)));
  json_object_set_new(to, "table", json_string(s->line->table->id));
  const json_t *given = json_object_get(s->line->json, "cue");
  if (given != NULL)
    json_object_update(cue, (json_t *)given);
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x = 0.0;
    if (n->key[0] != '\0')
      memcpy(&x, (const char *)&w->cue + n->offset, sizeof x);
    if (n->offset <= (int32_t)offsetof(carom_cue, b))
      json_object_set_new(cue, n->key, json_real(x + 0.0));
  }
  json_object_set_new(to, "cue", cue);
  json_object_set(to, "balls", json_object_get(s->line->json, "balls"));
  json_t *about = json_pack("{s: s, s: s, s: f, s: f, s: [f, f]}", "kind", kinds[w->kind], "by",
                            say_parts(s, w, parts), "chance", w->chance, "error", w->error,
                            "window", w->phi[0], w->phi[1]);
  if (w->ball < 0)
    json_object_set_new(about, "share", json_real((double)w->found / (double)s->scanned));
  else
    json_object_set_new(about, "ball", json_string(s->line->name[w->ball]));
  if (!isnan(w->cut))
    json_object_set_new(about, "cut", json_real(w->cut));
  json_object_set_new(to, "way", about);
  return to;
}

typedef struct drawn_ways {
  const played *shot;
  int count;
  const char *words;
} drawn_ways;

static void draw(FILE *out, const void *data) {
  const drawn_ways *d = data;
  shots_draw(out, d->shot, d->count, d->words);
}

static bool plot(const search *s) {
  static shot_line line[MOST_DRAWN];
  static carom_shot shot[MOST_DRAWN];
  static carom_ball_state final[MOST_DRAWN][CAROM_BALLS_MOST];
  static played drawn[MOST_DRAWN];
  const int count = s->ways < MOST_DRAWN ? s->ways : MOST_DRAWN;
  if (count == 0) {
    complain("nothing to draw: there is no way");
    return false;
  }
  char *words;
  size_t size;
  FILE *said = open_text(&words, &size);
  for (int k = 0; k < count; k++)
    fprintf(said, "%d: chance %.1f %%, window %.2f degrees, %.3g m/s\n", k + 1,
            100.0 * s->way[k].chance, s->way[k].phi[1] - s->way[k].phi[0], s->way[k].cue.speed);
  close_text(said, &words);
  for (int k = 0; k < count; k++) {
    line[k] = *s->line;
    line[k].cue = s->way[k].cue;
    line[k].json = line_of(s, &s->way[k]);
    shot[k] = (carom_shot){.final = final[k]};
    shot_line_play(&line[k], &s->options, &shot[k]);
    drawn[k] = (played){.line = &line[k], .shot = &shot[k]};
  }
  const drawn_ways all = {drawn, count, words};
  const bool good = svg_draw(s->job->plot, draw, &all);
  for (int k = 0; k < count; k++) {
    free(shot[k].events);
    json_decref(line[k].json);
  }
  free(words);
  return good;
}

/* ---- The command */

/* The ball of a name, -1 for any; -2 after a complaint. */
static int ball_asked(const search *s, const char *name) {
  char known[CAROM_BALLS_MOST * (PLACE_NAME + 1)] = "any", hint[HINT_TEXT];
  if (name == NULL || strcmp(name, "any") == 0)
    return -1;
  for (int k = 0; k < s->line->count; k++) {
    if (k == s->line->cue.ball || is_out(s, k))
      continue;
    if (strcmp(s->line->name[k], name) == 0)
      return k;
    snprintf(known + strlen(known), sizeof known - strlen(known), "|%s", s->line->name[k]);
  }
  complain("--ball is a ball of the layout or any, not '%.40s'%s", name,
           did_you_mean(name, known, hint));
  return -2;
}

/* The pocket of a name or an id, -1 for any; -2 after a complaint. */
static int pocket_asked(const search *s, const char *name) {
  const carom_table *t = &s->line->table->table;
  char known[400] = "any", hint[HINT_TEXT];
  if (name == NULL || strcmp(name, "any") == 0)
    return -1;
  for (int p = 0; p < t->pockets; p++) {
    const char *own = carom_pocket_name(t, p);
    if (strcmp(s->line->table->pocket[p], name) == 0 || (own != NULL && strcmp(own, name) == 0))
      return p;
    snprintf(known + strlen(known), sizeof known - strlen(known), "|%s",
             own != NULL ? own : s->line->table->pocket[p]);
  }
  complain("--pocket is %s, not '%.40s'%s", known, name, did_you_mean(name, known, hint));
  return -2;
}

/* Finds the ways; false after a complaint. */
static bool find(search *s) {
  const carom_table *t = &s->line->table->table;
  const int ball = ball_asked(s, s->job->ball),
            pocket = ball == -2 ? -2 : pocket_asked(s, s->job->pocket);
  int where;
  const leave *to = &s->job->leave;
  if (ball == -2 || pocket == -2)
    return false;
  s->counted = to->given && s->line->count == 1 ? PLACE : t->pockets == 0 ? POINT : CAROM;
  s->place[0] = place_along(&to->x, 0.25 * t->width);
  s->place[1] = place_along(&to->y, 0.125 * t->length);
  if (s->counted != PLACE && s->line->count < (t->pockets == 0 ? 3 : 2)) {
    complain(t->pockets == 0 ? "to score, three balls are needed"
                             : "the cue ball and one more are needed, or --leave");
    return false;
  }
  const carom_status bad =
      carom_shot_check(t, s->line->ball, s->line->count, &s->stroke[0], &s->options, &where);
  if (bad != CAROM_OK) {
    complain("the layout cannot be played: %s", carom_status_string(bad));
    return false;
  }
  bool good = true;
  for (int k = 0; k < s->line->count && good && s->counted == CAROM; k++)
    for (int p = 0; p < t->pockets && good; p++)
      if (k != s->line->cue.ball && !is_out(s, k) && (ball < 0 || k == ball) &&
          (pocket < 0 || p == pocket)) {
        good = try_ways(s, k, p);
        progress_show("pots", (double)(k * t->pockets + p), (double)(s->line->count * t->pockets));
      }
  progress_clear();
  if (good && s->job->scanned >= s->strokes)
    good = scan(s, ball, pocket);
  if (good && !s->job->each)
    qsort(s->way, (size_t)s->ways, sizeof *s->way, by_chance);
  return good;
}

static const command_form form = {
    .name = "ways",
    .usage = "[OPTIONS] LAYOUT.jsonl | --balls X,Y:... [OPTIONS]",
    .about = "Finds the ways to pot: direct, by a bank, a kick, a combination or a carom; and on a "
             "table without pockets the ways to score in three-cushion: the rails and balls that "
             "the cue ball meets. Of each way it tells the stroke with the best chance for a "
             "player among those that are given: how often it comes off with errors, and between "
             "which directions it does so without. LAYOUT has shots of one layout, of which each "
             "stroke is tried, but for its direction.\n",
    .options = (const option_row *const[]){&option_ball,
                                           &option_to_pocket,
                                           &option_rails,
                                           &option_leave,
                                           &option_each,
                                           &option_scan,
                                           &option_table,
                                           &option_cue,
                                           &option_balls,
                                           &option_gap,
                                           &option_seed,
                                           &option_shot_speed,
                                           &option_ball_speed,
                                           &option_tip,
                                           &option_elevation,
                                           &option_player,
                                           &option_player_errors,
                                           &options_of_motion,
                                           &option_with_of_shots,
                                           &option_ways_csv,
                                           &option_ways_json,
                                           &option_ways_plot,
                                           &option_threads,
                                           &option_output,
                                           NULL},
    .details =
        "strokes where none are given: 1.5, 2.5 and 4 m/s; with --leave 1 to 4 m/s, each with five "
        "tips from draw to follow; of points 3, 4.5 and 6 m/s, each with the tip on either side "
        "and "
        "in the middle; of the cue ball alone 0.5 to 5 m/s\n"
        "columns: chance, of 400 strokes with errors: the ball falls and the cue ball does not, or "
        "it scores, and ends where --leave says; window, degrees of the cue's direction; cut of "
        "the cue ball on its first ball, "
        "degrees, or of points the share of all strokes; speed of the cue, m/s; tip right and "
        "above, R; aim, degrees from +x; and the way, with what is met in its order\n"
        "columns of --csv: "
        "rank,kind,ball,pocket,way,speed,phi,theta,a,b,cut,margin,phi_low,phi_high,speed_low,"
        "speed_high,chance,error,found,scanned\n"
        "Combinations are direct; caroms and points are those of --scan.\n\n"
        "exit code: 0; 1 if there is no way; 2 for bad usage or unreadable input\n",
    .example = "carom ways --cue 0.6,0.8 --balls 0.3,1.9:0.9,1.7 --ball 1 --plot ways.svg",
    .files = FILE_OR_NONE,
};

int command_ways(int argc, char **argv) {
  static ways_job job;
  static carom_cue stroke[MOST_STROKES];
  static shot_line line;
  const char *path;
  char *lines = NULL;
  job = (ways_job){
      .from = {.shared = {.options = COMMAND_OPTIONS, .output = "-"}}, .rails = 2, .scanned = -1};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  search s = {.job = &job, .line = &line, .stroke = stroke, .options = job.from.shared.shot};
  s.options.threads = job.from.shared.options.threads;
  if (!player_of(&job.from.shared.player, &s.player) || !svg_possible(job.plot))
    return EXIT_USAGE;
  without_bounds(&s.player);
  if (job.csv && job.json) {
    complain("--csv and --json: give one of both");
    return EXIT_USAGE;
  }

  /* the usual strokes of the game */
  const bool points = job.from.table == 1 + CAROM_TABLE_THREECUSHION;
  const bool alone = job.leave.given && job.from.balls.count == 0 && job.from.balls.rack == 0;
  if (job.from.speed.count == 0 && job.from.ball_speed.count == 0 && has_flags(&job.from))
    values_default(&job.from.speed, MEASURE_SPEED,
                   alone             ? "0.5:5:0.25"
                   : points          ? "3,4.5,6"
                   : job.leave.given ? "1:4:0.5"
                                     : "1.5,2.5,4");
  if (job.from.tip.count == 0 && job.leave.given && !alone && !points && has_flags(&job.from)) {
    char tips[] = "0,-0.4..0.4..0.2";
    option_tip.set(&option_tip, tips, &job.from.tip);
  }
  if (job.from.tip.count == 0 && points)
    job.from.tip = (place_list){.count = 3,
                                .at = {{.y = {.x = 0.25}},
                                       {.x = {.x = 0.3}, .y = {.x = 0.2}},
                                       {.x = {.x = -0.3}, .y = {.x = 0.2}}}};
  shot_file *file = layout_open(&job.from, path, &s.options, MOST_STROKES, &lines);
  if (file == NULL)
    return EXIT_USAGE;
  s.strokes = strokes_read(file, &line, stroke, MOST_STROKES);
  int code = EXIT_USAGE;
  FILE *out = s.strokes > 0 ? output_open(job.from.shared.output) : NULL;
  if (out != NULL) {
    if (job.scanned < 0)
      job.scanned = line.table->table.pockets == 0 || line.count == 1 ? SCANNED_TO_SCORE : SCANNED;
    s.way = allocate(MOST_WAYS, sizeof *s.way);
    if (find(&s)) {
      code = s.ways > 0 ? EXIT_GOOD : EXIT_SOME;
      if (job.csv)
        write_rows(out, &s);
      else if (!job.json)
        tell(out, &s, s.ways);
      for (int k = 0; k < s.ways && job.json; k++) {
        json_t *way_line = line_of(&s, &s.way[k]);
        json_dumpf(way_line, out, JSON_REAL_PRECISION(17));
        fputc('\n', out);
        json_decref(way_line);
      }
      if (!output_commit())
        code = EXIT_USAGE;
      else if (job.plot != NULL && !plot(&s))
        code = EXIT_SOME;
    } else
      output_abandon();
    free(s.way);
  }
  if (s.strokes > 0)
    shot_line_free(&line);
  shot_file_close(file);
  free(lines);
  return code;
}
