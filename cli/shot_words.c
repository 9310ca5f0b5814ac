/* A shot in words: whom each ball met, its cushions, where it came to rest. */
#include "shot_words.h"

#include "derived.h"

#include <math.h>

enum { MOST_LEGS = 6 };
static const double same_contact = 0.1, least_leg = 0.01; /* s, m */

static bool has_ball(const carom_event *e, int ball) {
  return e->a == ball || (e->type == CAROM_EVENT_BALL_BALL && e->b == ball);
}

static double length_of(const carom_rail *r) {
  return hypot(r->q[0] - r->p[0], r->q[1] - r->p[1]);
}

bool is_cushion(const carom_table *t, int rail) {
  double longest = 0.0;
  for (int r = 0; r < t->rails; r++)
    longest = fmax(longest, length_of(&t->rail[r]));
  return length_of(&t->rail[rail]) > 0.2 * longest;
}

bool counts_as_rail(const shot_line *line, const carom_shot *shot, int64_t k, int ball) {
  const carom_event *e = &shot->events[k];
  const carom_table *t = &line->table->table;
  bool counts = e->type == CAROM_EVENT_RAIL && e->a == ball && is_cushion(t, (int)e->b);
  for (int64_t before = k - 1;
       before >= 0 && counts && e->time - shot->events[before].time < same_contact; before--)
    counts = !(shot->events[before].type == e->type && shot->events[before].a == ball &&
               shot->events[before].b == e->b);
  return counts;
}

bool ball_moved(const carom_shot *shot, int ball) {
  for (int64_t k = 0; k < shot->count && k < shot->room; k++)
    if (has_ball(&shot->events[k], ball))
      return true;
  return false;
}

/* "meets 1 after 0.32 s at a cut of 20.0 degrees" */
static void tell_contact(FILE *out, const shot_line *line, const carom_event *e, int ball) {
  const int side = e->a == ball ? 0 : 1;
  const carom_ball_state *own = &e->before[side], *other = &e->before[1 - side];
  const double along[2] = {other->r[0] - own->r[0], other->r[1] - own->r[1]};
  fprintf(out, "meets %s after %.2f s", line->name[side == 0 ? e->b : e->a], e->time);
  if (hypot(other->v[0], other->v[1]) == 0.0)
    fprintf(out, " at a cut of %.1f degrees", fabs(angle_between(own->v, along)));
}

/* The directions of the straight lines from contact to contact. */
static void tell_legs(FILE *out, const shot_line *line, const carom_shot *shot, int ball) {
  const double *from = line->ball[ball].state.r;
  int told = 0;
  for (int64_t k = 0; k <= shot->count && k <= shot->room && told < MOST_LEGS; k++) {
    const bool ends = k == shot->count || k == shot->room;
    const carom_event *e = &shot->events[k];
    if (!ends && !counts_as_rail(line, shot, k, ball) &&
        !(e->type == CAROM_EVENT_BALL_BALL && has_ball(e, ball)))
      continue;
    const double *to = ends ? shot->final[ball].r : e->before[e->a == ball ? 0 : 1].r;
    if (hypot(to[0] - from[0], to[1] - from[1]) < least_leg)
      continue;
    const double angle = atan2(to[1] - from[1], to[0] - from[0]) / degree;
    fprintf(out, "%s%.1f", told++ > 0 ? ", " : "legs at ", angle < 0.0 ? angle + 360.0 : angle);
    from = to;
  }
  fputs(" degrees\n       ", out);
}

static void tell_ball(FILE *out, const shot_line *line, const carom_shot *shot, int ball) {
  const carom_ball_state *final = &shot->final[ball];
  int rails = 0;
  double last = 0.0;
  const carom_event *first = NULL;
  fprintf(out, "%-6s ", line->name[ball]);
  for (int64_t k = 0; k < shot->count && k < shot->room; k++) {
    const carom_event *e = &shot->events[k];
    first = first == NULL && e->type == CAROM_EVENT_BALL_BALL && has_ball(e, ball) ? e : first;
    rails += counts_as_rail(line, shot, k, ball);
    last = has_ball(e, ball) ? e->time : last;
  }
  if (first != NULL && ball == line->cue.ball) {
    tell_contact(out, line, first, ball);
    fputs("\n       ", out);
  }
  /* The cushions, with the times of the first of them. */
  fprintf(out, rails == 1 ? "%d rail" : "%d rails", rails);
  for (int64_t k = 0, told = 0; k < shot->count && k < shot->room && told < 5; k++)
    if (counts_as_rail(line, shot, k, ball))
      fprintf(out, "%s%.2f", told++ > 0 ? ", " : " after ", shot->events[k].time);
  fputs(rails > 5 ? ", ... s; " : rails > 0 ? " s; " : "; ", out);
  if (rails > 0 && ball == line->cue.ball)
    tell_legs(out, line, shot, ball);
  if (final->label == CAROM_BALL_POCKETED) {
    const named_table *t = line->table;
    int in = 0;
    while (in < t->table.pockets - 1 && (t->table.pocket[in].centre[0] != final->r[0] ||
                                         t->table.pocket[in].centre[1] != final->r[1]))
      in++;
    fprintf(out, "falls into pocket %s after %.2f s\n", t->pocket[in], last);
  } else
    fprintf(out, "%s at x = %.3f, y = %.3f m after %.2f s\n",
            final->label == CAROM_BALL_STATIONARY ? "rests" : "is", final->r[0], final->r[1],
            final->label == CAROM_BALL_STATIONARY ? last : shot->time);
}

void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s) {
  const carom_cue *cue = &line->cue;
  const double *v = shot->events[0].after[0].v;
  fprintf(out, "%s table, %s at %.4g m/s, aim %.2f degrees", line->table->id, line->name[cue->ball],
          hypot(v[0], v[1]), cue->phi);
  if (cue->theta != 0.0)
    fprintf(out, ", cue raised by %.4g degrees", cue->theta);
  if (cue->a == 0.0 && cue->b == 0.0)
    fputs(", tip at the centre\n", out);
  else
    fprintf(out, ", tip %.3g R %s and %.3g R %s the centre\n", fabs(cue->a),
            cue->a > 0.0 ? "left" : "right", fabs(cue->b), cue->b < 0.0 ? "below" : "above");
  for (int k = 0; k < line->count; k++)
    if (ball_moved(shot, k)) {
      tell_ball(out, line, shot, k);
      if (s != NULL && shot->final[k].label != CAROM_BALL_POCKETED)
        spread_tell_ball(out, s, k);
    }
  if (s != NULL)
    spread_tell(out, s, line);
}
