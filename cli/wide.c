/* How wide a pot is.
 *
 * With u the direction from the ball to the middle of the pocket's mouth, the cue ball comes along
 * u turned by the cut to the right, and meets the ball with its centre 2 R before it. From there
 * the distance is counted back along its path. Throw, squirt and swerve are left to carom_aim(), so
 * the cut at which the ball falls differs a little from that of the place. */
#include "wide.h"

#include "derived.h"
#include "message.h"
#include "number.h"
#include "picture.h"

#include <math.h>
#include <string.h>

enum { AXES = 4, CUT = 0, DISTANCE, TIP, SPEED, MOST_CURVES = 16 };

/* The direction from a place to the middle between the two jaws nearest to a pocket, where a ball
 * of that radius passes them; to its centre where they are not near. */
static double way_into(const carom_table *t, int pocket, const double from[2], double radius) {
  const double *centre = t->pocket[pocket].centre;
  const double straight = atan2(centre[1] - from[1], centre[0] - from[0]);
  double near[2] = {INFINITY, INFINITY}, turn[2] = {0.0, 0.0};
  for (int k = 0; k < t->jaws; k++) {
    const double *c = t->jaw[k].centre;
    const double off = hypot(c[0] - centre[0], c[1] - centre[1]);
    const double far = hypot(c[0] - from[0], c[1] - from[1]);
    const double side = remainder(atan2(c[1] - from[1], c[0] - from[0]) - straight, 360.0 * degree);
    const double tangent = asin(fmin((t->jaw[k].radius + radius) / far, 1.0));
    const int at = off < near[0] ? 0 : off < near[1] ? 1 : 2;
    if (at == 0) {
      near[1] = near[0];
      turn[1] = turn[0];
    }
    if (at < 2) {
      near[at] = off;
      turn[at] = side < 0.0 ? side + tangent : side - tangent;
    }
  }
  return straight + (near[1] < 3.0 * t->pocket[pocket].radius ? 0.5 * (turn[0] + turn[1]) : 0.0);
}

/* Moves the cue ball to a cut and a distance; whether it can lie there. */
static bool put_cue_ball(shot_line *line, const ways_search *s, double cut, double distance) {
  const carom_table *t = &line->table->table;
  const carom_shot_ball *ball = &line->ball[s->ball];
  const double *at = ball->state.r, own = line->ball[line->cue.ball].kind.radius;
  const double to = way_into(t, s->pocket, at, ball->kind.radius), from = to - cut * degree;
  double *r = line->ball[line->cue.ball].state.r;
  int where;
  r[0] = at[0] - (ball->kind.radius + own) * cos(to) - distance * cos(from);
  r[1] = at[1] - (ball->kind.radius + own) * sin(to) - distance * sin(from);
  return carom_shot_check(t, line->ball, line->count, &s->stroke[0], &s->options, &where) ==
         CAROM_OK;
}

/* Adds pots that are left out to a text, "cut 60 deg from 1.2 m (2), ...", up to its room. */
enum { LEFT_TEXT = 240 };
static void name_left_out(const wide_job *job, int cut, int distance, int strokes,
                          char text[LEFT_TEXT]) {
  char one[80];
  snprintf(one, sizeof one, "%scut %s from %s", text[0] != '\0' ? ", " : "", job->cut->at[cut].name,
           job->distance->at[distance].name);
  if (strokes > 1)
    snprintf(one + strlen(one), sizeof one - strlen(one), " (%d)", strokes);
  const bool fits = strlen(text) + strlen(one) + 6 < LEFT_TEXT;
  if (text[0] == '\0' || text[strlen(text) - 1] != '.') /* all before had room */
    snprintf(text + strlen(text), LEFT_TEXT - strlen(text), "%s", fits ? one : ", ...");
}

bool wide_find(const wide_job *job, shot_line *line, ways_search *s) {
  const int pots = job->cut->count * job->distance->count * s->strokes;
  int found = 0, no_place = 0;
  char outside[LEFT_TEXT] = "", fallen[LEFT_TEXT] = "";
  for (int k = 0; k < job->cut->count; k++)
    if (!(fabs(job->cut->at[k].x) < 90.0)) {
      complain("--cut is between -90 and 90 degrees");
      return false;
    }
  for (int k = 0; k < job->distance->count; k++)
    if (!(job->distance->at[k].x > 0.0)) {
      complain("--distance is above 0");
      return false;
    }
  if (pots > MOST_WAYS) {
    complain("these are %d pots: at most %d", pots, MOST_WAYS);
    return false;
  }
  for (int cut = 0; cut < job->cut->count; cut++)
    for (int distance = 0; distance < job->distance->count; distance++) {
      const double at_cut = job->cut->at[cut].x, far = job->distance->at[distance].x;
      if (!put_cue_ball(line, s, at_cut, far)) {
        no_place += s->strokes;
        name_left_out(job, cut, distance, s->strokes, outside);
        continue;
      }
      if (!ways_find_direct(s))
        return false;
      if (s->ways - found < s->strokes)
        name_left_out(job, cut, distance, s->strokes - (s->ways - found), fallen);
      for (; found < s->ways; found++) {
        s->way[found].at_cut = at_cut;
        s->way[found].distance = far;
        memcpy(s->way[found].place, line->ball[line->cue.ball].state.r, sizeof s->way[found].place);
      }
      progress_show("pots", (double)((cut * job->distance->count + distance) * s->strokes),
                    (double)pots);
    }
  progress_clear();
  if (no_place > 0)
    complain(
        "%d of %d pots are left out: the cue ball would lie outside the table or in a ball: %s",
        no_place, pots, outside);
  if (found + no_place < pots)
    complain(
        "%d of %d pots are left out: no direction makes the ball fall, or a ball or cushion is "
        "in the way: %s",
        pots - found - no_place, pots, fallen);
  return true;
}

/* ---- Curves */

/* The numbers of a pot: how many values each has, and which one pot has. */
typedef struct grid {
  int count[AXES], range;
} grid;

static const values *speeds_of(const wide_job *job) {
  return job->from->ball_speed.count > 0 ? &job->from->ball_speed : &job->from->speed;
}

static const values *list_of(const wide_job *job, int axis) {
  return axis == CUT ? job->cut : axis == DISTANCE ? job->distance : speeds_of(job);
}

/* Whether the tips differ above the centre; else to the right. */
static bool tips_rise(const place_list *tips) {
  return tips->at[0].y.x != tips->at[tips->count - 1].y.x;
}

/* The range is the number given as one; or the tips, where there are several. */
static grid grid_of(const wide_job *job) {
  grid g = {.range = -1};
  for (int axis = 0; axis < AXES; axis++) {
    g.count[axis] = axis == TIP ? job->from->tip.count : list_of(job, axis)->count;
    if (axis != TIP && list_of(job, axis)->range)
      g.range = axis;
  }
  g.range = g.range < 0 && g.count[TIP] > 1 ? TIP : g.range;
  return g;
}

/* Which value of a number a pot has. */
static int place_on(const grid *g, const wide_job *job, const way *w, int axis) {
  const double at = axis == CUT ? w->at_cut : w->distance;
  int k = 0;
  if (axis == SPEED || axis == TIP)
    return axis == SPEED ? w->stroke % g->count[SPEED]
                         : w->stroke / g->count[SPEED] % g->count[TIP];
  while (list_of(job, axis)->at[k].x != at)
    k++;
  return k;
}

static const char *name_of(int axis) {
  static const char *const names[] = {"cut", "distance", "tip", "speed"};
  return names[axis];
}

/* "cut 30 deg", "tip 0,0.25" */
static void write_value(FILE *out, const wide_job *job, int axis, int k) {
  const place_list *tips = &job->from->tip;
  if (axis == TIP)
    fprintf(out, "tip %.3g,%.3g R", tips->at[k].x.x, tips->at[k].y.x);
  else
    fprintf(out, "%s %s", name_of(axis), list_of(job, axis)->at[k].name);
}

typedef struct drawn_wide {
  const wide_job *job;
  const ways_search *search;
} drawn_wide;

/* The data of figures/curves.gp. */
static void write_curves(FILE *out, const void *data) {
  const wide_job *job = ((const drawn_wide *)data)->job;
  const ways_search *s = ((const drawn_wide *)data)->search;
  const grid g = grid_of(job);
  const place_list *tips = &job->from->tip;
  if (g.range == TIP)
    fprintf(out, "# x: tip %s the centre (R)\n", tips_rise(tips) ? "above" : "to the right of");
  else
    fprintf(out, "# x: %s (%s)\n", name_of(g.range), list_of(job, g.range)->unit);
  fprintf(out, "# y: %s\n# footer: %s into the %s pocket",
          job->quantity == WINDOW   ? "window of the direction of the cue (degrees)"
          : job->quantity == CHANCE ? "how often a player pots it and keeps the cue ball (%)"
                                    : "how often a player pots it (%)",
          s->line->name[s->ball], carom_pocket_name(&s->line->table->table, s->pocket));
  for (int axis = 0; axis < AXES; axis++)
    if (g.count[axis] == 1) {
      fputs(", ", out);
      write_value(out, job, axis, 0);
    }
  /* a curve for each combination of the other numbers, the last of which changes fastest */
  int curves = 1;
  for (int axis = 0; axis < AXES; axis++)
    curves *= axis == g.range ? 1 : g.count[axis];
  for (int curve = 0; curve < curves; curve++) {
    fprintf(out, "\n# curve %d: ", curve + 1);
    for (int axis = 0, each = curves, named = 0; axis < AXES; axis++) {
      if (axis == g.range || g.count[axis] == 1)
        continue;
      each /= g.count[axis];
      fputs(named++ > 0 ? ", " : "", out);
      write_value(out, job, axis, curve / each % g.count[axis]);
    }
  }
  fputs("\ncurve,x,y\n", out);
  for (int k = 0; k < s->ways; k++) {
    const way *w = &s->way[k];
    int curve = 0;
    for (int axis = 0; axis < AXES; axis++)
      curve = axis == g.range ? curve : curve * g.count[axis] + place_on(&g, job, w, axis);
    const int at = place_on(&g, job, w, g.range);
    const double x = g.range != TIP    ? list_of(job, g.range)->at[at].given
                     : tips_rise(tips) ? w->cue.b
                                       : 0.0 - w->cue.a;
    fprintf(out, "%d,%.9g,%.9g\n", curve + 1, x,
            job->quantity == WINDOW   ? w->phi[1] - w->phi[0]
            : job->quantity == CHANCE ? 100.0 * w->chance
                                      : 100.0 * w->falls);
  }
}

bool wide_has_range(const wide_job *job) {
  return grid_of(job).range >= 0;
}

bool wide_plot(const wide_job *job, const ways_search *s, const char *path) {
  const grid g = grid_of(job);
  int curves = 1;
  for (int axis = 0; axis < AXES; axis++)
    curves *= axis == g.range ? 1 : g.count[axis];
  if (s->ways == 0)
    complain("nothing to draw: there is no pot");
  else if (curves > MOST_CURVES || job->from->elevation.count > 1)
    complain(curves > MOST_CURVES ? "%d curves are too many to draw: at most %d"
                                  : "curves have one --elevation",
             curves, MOST_CURVES);
  else
    return picture_draw(path, "curves", "", write_curves, &(drawn_wide){job, s});
  return false;
}
