/* A shot in words: the moments of each ball, shot_story.h. */
#include "shot_words.h"

#include "shot_story.h"

#include <math.h>

/* where more balls move, all but that of the cue are told shortly */
enum { MOST_TOLD = 4 };

/* "rests at x = 0.637, y = 0.681 m after 6.16 s"; for a ball that has left the table, where. */
static void tell_end(FILE *out, const shot_line *line, const moment *m) {
  char text[WHERE_TEXT];
  if (m->kind == MOMENT_FALLS)
    fprintf(out, "falls into %s (%s) after %.2f s\n", pocket_words(line->table, m->with, text),
            line->table->pocket[m->with], m->time);
  else if (m->kind == MOMENT_OFF)
    fprintf(out, "leaves the table over %s after %.2f s\n", side_words(line->table, m->x, m->y),
            m->time);
  else
    fprintf(out, "%s at x = %.3f, y = %.3f m after %.2f s\n",
            m->kind == MOMENT_RESTS ? "rests" : "is", m->x, m->y, m->time);
}

/* "meets 1 after 0.32 s at a cut of 20.0 degrees" */
static void tell_contact(FILE *out, const shot_line *line, const moment *m) {
  fprintf(out, "meets %s after %.2f s", line->name[m->with], m->time);
  if (!isnan(m->value))
    fprintf(out, " at a cut of %.1f degrees", m->value);
}

static void tell_direction(FILE *out, const moment *m) {
  if (m->speed > 0.0)
    fprintf(out, "%s at %.1f degrees with %.3g m/s",
            m->kind == MOMENT_LEAVES ? "leaves" : ", leaves", m->direction, m->speed);
}

/* A moment; the start of a roll stands in the line of the contact before it. */
static void tell_moment(FILE *out, const shot_line *line, const moment *m, bool first) {
  char text[WHERE_TEXT];
  if (m->kind == MOMENT_ROLLS && !first) {
    fprintf(out, ",\n         rolls after %.2f s from x = %.3f, y = %.3f m at %.1f degrees",
            m->time, m->x, m->y, m->direction);
    return;
  }
  if (!first)
    fputs("\n       ", out);
  switch (m->kind) {
  case MOMENT_MEETS:
    tell_contact(out, line, m);
    tell_direction(out, m);
    break;
  case MOMENT_RAIL:
    fprintf(out, "meets %s", rail_words(line->table, m->with, text));
    if (!isnan(m->value))
      fprintf(out, " at diamond %.2f", m->value);
    fprintf(out, " after %.2f s", m->time);
    tell_direction(out, m);
    break;
  case MOMENT_JAW:
    fprintf(out, "meets the jaw of %s after %.2f s",
            m->with >= 0 ? pocket_words(line->table, m->with, text) : "a pocket", m->time);
    tell_direction(out, m);
    break;
  case MOMENT_ROLLS:
    fprintf(out, "rolls after %.2f s at %.1f degrees", m->time, m->direction);
    break;
  case MOMENT_PASSES:
    fprintf(out, "passes %s by %.0f mm after %.2f s", line->name[m->with], 1e3 * m->value, m->time);
    break;
  case MOMENT_LEAVES:
    tell_direction(out, m);
    break;
  default:
    tell_end(out, line, m);
  }
}

/* What the ball of the cue meets first, the cushions of a ball in one line, with the times of the
 * first of them, and its end. */
static void tell_shortly(FILE *out, const shot_line *line, const moment *m, int count) {
  int rails = 0, met = m[0].kind == MOMENT_LEAVES ? 0 : count;
  for (int k = 0; k < count; k++)
    rails += m[k].kind == MOMENT_RAIL;
  while (met < count && m[met].kind != MOMENT_MEETS)
    met++;
  if (met < count) {
    tell_contact(out, line, &m[met]);
    fputs("; ", out);
  }
  fprintf(out, rails == 1 ? "%d rail" : "%d rails", rails);
  for (int k = 0, told = 0; k < count && told < 5; k++)
    if (m[k].kind == MOMENT_RAIL)
      fprintf(out, "%s%.2f", told++ > 0 ? ", " : " after ", m[k].time);
  fputs(rails > 5 ? ", ... s; " : rails > 0 ? " s; " : "; ", out);
  tell_end(out, line, &m[count - 1]);
}

static void tell_ball(FILE *out, const shot_line *line, const carom_shot *shot, int ball,
                      bool shortly) {
  static moment m[MOST_MOMENTS];
  const int count = story_of(line, shot, ball, m);
  fprintf(out, "%-6s ", line->name[ball]);
  if (shortly)
    tell_shortly(out, line, m, count);
  else
    for (int k = 0; k < count; k++)
      tell_moment(out, line, &m[k], k == 0);
}

/* What the cue ball meets before the tip has left it. */
static void tell_push(FILE *out, const shot_line *line, const carom_facts *facts) {
  for (int k = 0; k < line->count; k++)
    if (facts->pushed >> k & 1)
      fprintf(out,
              facts->frozen >> k & 1
                  ? "frozen to ball %s: pushed, both go\n"
                  : "a double hit: ball %s is met while the tip is on the cue ball\n",
              line->name[k]);
  if (facts->touches > 1)
    fputs("the tip touches the cue ball twice\n", out);
}

void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s,
               bool shortly) {
  const carom_cue *cue = &line->cue;
  const double *v = shot->events[0].after[0].v;
  fprintf(out, "%s table, cue at %.4g m/s, ball %s at %.4g m/s, aim %.2f degrees", line->table->id,
          cue->speed, line->name[cue->ball], hypot(v[0], v[1]), cue->phi);
  if (cue->theta != 0.0)
    fprintf(out, ", cue raised by %.4g degrees", cue->theta);
  if (cue->a == 0.0 && cue->b == 0.0)
    fputs(", tip at the centre\n", out);
  else
    fputs(", tip ", out);
  if (cue->a != 0.0)
    fprintf(out, "%.3g R %s%s", fabs(cue->a), cue->a > 0.0 ? "left" : "right",
            cue->b != 0.0 ? " and " : " of the centre\n");
  if (cue->b != 0.0)
    fprintf(out, "%.3g R %s the centre\n", fabs(cue->b), cue->b < 0.0 ? "below" : "above");
  if (shot->facts != NULL)
    tell_push(out, line, shot->facts);
  int moved = 0;
  for (int k = 0; k < line->count; k++)
    moved += ball_moved(shot, k);
  for (int k = 0; k < line->count; k++)
    if (ball_moved(shot, k)) {
      tell_ball(out, line, shot, k, shortly || (moved > MOST_TOLD && k != cue->ball));
      if (s != NULL && shot->final[k].label != CAROM_BALL_POCKETED)
        spread_tell_ball(out, s, k);
    }
  if (s != NULL)
    spread_tell(out, s, line);
}
