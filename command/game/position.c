/* Where the cue ball shall end. `carom ways` counts it for the chance of a way; here it chooses the
 * speed and the tip of a shot: each stroke is played without errors, and of those by which the cue
 * ball ends there the one with the best chance is taken. */
#include "game/position.h"

#include "game/ways.h"
#include "program/message.h"
#include "shots/given_shots.h"
#include "shots/strokes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

OPTION_SET(set_leave) {
  leave *target = field;
  target->is_set = read_disc(text, "0.15", &target->x, &target->y, &target->radius);
  if (target->is_set)
    return true;
  return refuse_value(row, text, "not a position, X,Y or X,Y,R; try 2d,4d,20cm or foot-spot,20cm");
}

void leave_into(const leave *target, ways_search *s) {
  const carom_table *t = &s->line->table->table;
  s->job.radius = target->is_set ? place_along(&target->radius, 0.125 * t->length) : 0.0;
  s->job.place[0] = place_along(&target->x, 0.25 * t->width);
  s->job.place[1] = place_along(&target->y, 0.125 * t->length);
}

/* The strokes of all values, without those by which the ball cannot be aimed. NULL after a
 * complaint. */
static shot_file *strokes_of(const shoot_flags *f, const carom_shot_options *options) {
  static shoot_flags usual; /* what is not given becomes what is usual */
  usual = *f;
  usual.tries = true;
  if (f->speed.count == 0 && f->ball_speed.count == 0)
    values_default(&usual.speed, MEASURE_SPEED, "0.5:4:0.1");
  if (f->tip.count == 0)
    option_tip.set(&option_tip, (char[]){TIPS_TO_LEAVE}, &usual.tip);
  shot_file *file = flags_open(&usual, options, MOST_ROWS);
  if (file == NULL || shot_file_count(file) > 0)
    return file;
  complain("--leave: none of the speeds and tips that carom tries has such an aim");
  shot_file_close(file);
  return NULL;
}

/* The ball and the pocket of --pocket, which has been aimed at. */
static void name_pot(const char *pocket, const shot_line *line, way *w) {
  const char *colon = strchr(pocket, ':');
  char known[NAMES_TEXT] = "";
  w->kind = CAROM_PLAN_POT;
  w->pocket = pocket_named(&line->table->table, line->table->pocket, colon + 1, known);
  for (int k = 0; k < line->count; k++)
    if (strncmp(line->name[k], pocket, (size_t)(colon - pocket)) == 0 &&
        line->name[k][colon - pocket] == '\0')
      w->ball = k;
}

/* How far from the place the cue ball ends without errors, m; `good` where all is as it shall. */
static double miss_of(const ways_search *s, const way *w, bool *good) {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_shot shot = {.facts = &facts, .final = final};
  const carom_status status = carom_shoot(&s->line->table->table, s->line->ball, s->line->count,
                                          &w->cue, &s->options, &shot);
  *good = status >= 0 && carom_way_succeeds(&s->job, &shot, w);
  const carom_ball_state *cue = &final[s->line->cue.ball];
  if (status < 0 || cue->label != CAROM_BALL_STATIONARY)
    return INFINITY;
  return hypot(cue->r[0] - s->job.place[0], cue->r[1] - s->job.place[1]);
}

/* Gives the flags the one stroke. */
static void take(shoot_flags *f, const carom_cue *cue) {
  const place_list tip = {.count = 1, .place = {{.x = {.x = 0.0 - cue->a}, .y = {.x = cue->b}}}};
  f->ball_speed.count = 0;
  f->speed.count = f->elevation.count = 1;
  f->speed.item[0] = (value){.x = cue->speed};
  f->elevation.item[0] = (value){.x = cue->theta};
  f->tip = tip;
  if (f->pocket != NULL) /* is aimed at again */
    return;
  f->at_ball = NULL;
  f->cut.count = f->target.count = 0;
  f->aim.count = 1;
  f->aim.item[0] = (value){.x = cue->phi};
}

/* Whether a stroke follows another in the range of its speeds. */
static bool follows(const carom_cue *b, const carom_cue *a) {
  return a->a == b->a && a->b == b->b && a->theta == b->theta && b->speed > a->speed;
}

/* The strokes of a choice, and what came of them. */
typedef struct trial {
  const carom_cue *cue;
  int count;
  bool good[MOST_ROWS]; /* whether the cue ball ends there without errors */
  int best;             /* that with the best chance of those; -1: there is none */
  int nearest;          /* -1: by none the cue ball stays on the table */
  int arrivals;         /* how many end there */
  double miss;          /* of the nearest one, m */
  double chance;        /* of the best one */
} trial;

/* Plays the strokes, each as `w` but for its cue; false after a complaint. */
static bool try_strokes(const ways_search *s, way w, trial *t) {
  t->best = t->nearest = -1;
  t->arrivals = 0;
  t->miss = INFINITY;
  t->chance = -1.0;
  bool fine = true;
  for (int k = 0; k < t->count && fine; k++) {
    w.cue = t->cue[k];
    const double miss = miss_of(s, &w, &t->good[k]);
    if (miss < t->miss) {
      t->nearest = k;
      t->miss = miss;
    }
    if (!t->good[k])
      continue;
    t->arrivals++;
    fine = ways_chance(s, &w);
    if (w.chance > t->chance) {
      t->best = k;
      t->chance = w.chance;
    }
    progress_show("strokes", (double)k, (double)t->count);
  }
  progress_clear();
  return fine;
}

/* Says that no stroke does it, and which one comes nearest. */
static void complain_of_none(const trial *t) {
  if (t->nearest < 0) {
    complain("--leave: the cue ball stays on the table with none of %d strokes", t->count);
    return;
  }
  const carom_cue *nearest = &t->cue[t->nearest];
  complain("--leave: none of %d strokes does it; the nearest, with the cue at %.3g m/s and the tip "
           "%.2f R right and %.2f above, leaves the cue ball %.2f m away",
           t->count, nearest->speed, 0.0 - nearest->a, nearest->b, t->miss);
}

/* Tells the best stroke, with the neighbouring speeds of the same tip that do it too. */
static void tell_best(const ways_search *s, const trial *t, char text[LEFT_TEXT]) {
  int low = t->best, high = t->best;
  while (low > 0 && t->good[low - 1] && follows(&t->cue[low], &t->cue[low - 1]))
    low--;
  while (high + 1 < t->count && t->good[high + 1] && follows(&t->cue[high + 1], &t->cue[high]))
    high++;
  snprintf(text, LEFT_TEXT,
           "leave  within %.3g m of x = %.3f, y = %.3f m: %.1f %% of this player's strokes, the "
           "best of %d, of which %d do it\n       with this tip from %.3g to %.3g m/s of the cue "
           "without errors\n",
           s->job.radius, s->job.place[0], s->job.place[1], 100.0 * t->chance, t->count,
           t->arrivals, t->cue[low].speed, t->cue[high].speed);
}

/* Chooses among the strokes of `t`, and gives the flags the best; false after a complaint. */
static bool choose(const leave *target, shoot_flags *f, ways_search *s, trial *t,
                   char text[LEFT_TEXT]) {
  way w = {.kind = -1, .ball = -1, .pocket = -1};
  s->job.goal = f->pocket != NULL ? CAROM_WAY_POT : CAROM_WAY_PLACE;
  leave_into(target, s);
  if (f->pocket != NULL)
    name_pot(f->pocket, s->line, &w);
  if (!try_strokes(s, w, t))
    return false;
  if (t->best < 0) {
    complain_of_none(t);
    return false;
  }
  tell_best(s, t, text);
  take(f, &t->cue[t->best]);
  return true;
}

bool leave_choose(const leave *target, shoot_flags *f, const carom_shot_options *options,
                  char text[LEFT_TEXT]) {
  static carom_cue cue[MOST_ROWS];
  static shot_line line;
  static trial strokes;
  ways_search s = {.line = &line, .options = *options};
  if (!player_of(&f->shared.player, &s.player))
    return false;
  without_bounds(&s.player);
  shot_file *file = strokes_of(f, options);
  strokes.cue = cue;
  f->shared.with.in_lines = true; /* those of the strokes have them */
  strokes.count = file != NULL ? strokes_read(file, &f->shared, &line, cue, MOST_ROWS) : 0;
  bool found = false;
  if (strokes.count > 0) {
    ways_begin(&s, cue, strokes.count, 1);
    s.job.scan = strokes.count;
    s.job.ball = s.job.pocket = -1;
    found = choose(target, f, &s, &strokes, text);
    free(s.job.memory);
    shot_line_free(&line);
  }
  if (file != NULL)
    shot_file_close(file);
  return found;
}
