/* A shot that plays in a picture: one SVG whose balls move, for pages that take no script. Each
 * ball is a group that an animation carries from place to place at equal steps of time; at the end
 * the balls rest for a while, and the shot begins again. */
#include "pictures/moving_picture.h"

#include "pictures/labels.h"
#include "pictures/table_picture.h"
#include "program/program.h"
#include "shots/shot_story.h"

static const double step = 1.0 / 30.0, rest = 2.0; /* s */

/* The attribute of an animation that says at which share of the whole a ball is gone for good. */
static void write_gone(FILE *out, double when, double whole) {
  fprintf(out,
          "<animate attributeName=\"visibility\" values=\"visible;hidden\" keyTimes=\"0;%.4f\" "
          "calcMode=\"discrete\" dur=\"%.3fs\" repeatCount=\"indefinite\"/>\n",
          when / whole, whole);
}

/* Carries a ball through its states at all steps; `count` states lie between two of one ball. */
static void write_way(const view *v, const carom_ball_state *states, size_t steps, size_t count,
                      double whole) {
  size_t gone = 0;
  fputs("<animateTransform attributeName=\"transform\" type=\"translate\" values=\"", v->out);
  for (size_t k = 0; k < steps; k++) {
    const carom_ball_state *s = &states[k * count];
    if (gone == 0 && is_out_of_play(s))
      gone = k;
    fprintf(v->out, "%s%.1f %.1f", k > 0 ? ";" : "", across(v, s->r), down(v, s->r));
  }
  fprintf(v->out, "\" dur=\"%.3fs\" repeatCount=\"indefinite\"/>\n", whole);
  if (gone > 0)
    write_gone(v->out, (double)gone * step, whole);
}

void shot_move(FILE *out, const played *p) {
  const shot_line *line = p->line;
  const size_t balls = (size_t)line->count;
  const size_t steps = (size_t)ceil((p->shot->time + rest) / step) + 1;
  const double whole = (double)(steps - 1) * step;
  static labels none;
  view v = view_of(out, &line->table->table);
  v.labels = &none;
  none = (labels){.out = out, .size = picture_letters(&v)};
  draw_table(&v, &line->table->table, 0.0);

  double *times = allocate(steps, sizeof *times);
  carom_ball_state *states = allocate(steps * balls, sizeof *states);
  for (size_t k = 0; k < steps; k++)
    times[k] = fmin((double)k * step, p->shot->time);
  double(*turned)[4] = allocate(steps * balls, sizeof *turned);
  carom_shot_frames(line->ball, line->count, p->shot, times, steps, NULL, states, turned);
  free(turned);
  for (int ball = 0; ball < line->count; ball++) {
    if (is_out_of_play(&line->ball[ball].state))
      continue;
    const double *r = line->ball[ball].state.r;
    fprintf(out, "<g class=\"ball\" transform=\"translate(%.1f %.1f)\">\n", across(&v, r),
            down(&v, r));
    draw_disc(&v, line, ball, 0.0, 0.0, line->name[ball], NULL);
    if (ball_moved(p->shot, ball))
      write_way(&v, states + ball, steps, balls, whole);
    fputs("</g>\n", out);
  }
  free(states);
  free(times);
  fputs("</svg>\n", out);
}
