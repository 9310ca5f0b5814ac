/* A stroke in the words of a coach. */
#include "stroke_words.h"

#include "derived.h"
#include "shot_story.h"

#include <math.h>

/* Speeds of the ball in words, by billiards.colostate.edu/faq/speed/typical. */
static const char *speed_words(double v) {
  static const struct {
    double most;
    const char *words;
  } speeds[] = {{0.45, "a soft touch"},
                {0.89, "slow"},
                {1.9, "medium"},
                {3.2, "fast"},
                {4.5, "a power stroke"}};
  for (size_t k = 0; k < sizeof speeds / sizeof speeds[0]; k++)
    if (v < speeds[k].most)
      return speeds[k].words;
  return "as hard as a break";
}

/* How much of the ball is hit. */
static const char *part_words(double part) {
  static const char *const eighths[] = {"a thin hit",
                                        "1/8 of the ball",
                                        "a quarter ball",
                                        "3/8 of the ball",
                                        "half a ball",
                                        "5/8 of the ball",
                                        "three quarters of the ball",
                                        "7/8 of the ball",
                                        "a full hit"};
  return eighths[(int)round(8.0 * part)];
}

bool tell_aim(FILE *out, const shot_line *line, const carom_cue *cue, const carom_shot *shot) {
  const carom_event *meets = NULL;
  char rail[WHERE_TEXT];
  bool before = false;
  for (int64_t k = 0; k < shot->count && k < shot->room && meets == NULL; k++) {
    const carom_event *e = &shot->events[k];
    if (e->type == CAROM_EVENT_BALL_BALL && (e->a == cue->ball || e->b == cue->ball))
      meets = e;
    else if (counts_as_rail(line, shot, k, (int)cue->ball)) {
      fprintf(out, "%s %s at diamond %.2f", before ? ", then" : "off",
              rail_words(line->table, (int)e->b, rail),
              diamonds_at(&line->table->table, (int)e->b, e->after[0].r));
      before = true;
    }
  }
  if (meets != NULL) {
    const int own = meets->a == cue->ball ? 0 : 1;
    const carom_ball_state *c = &meets->before[own], *o = &meets->before[1 - own];
    const double x = o->r[0] - c->r[0], y = o->r[1] - c->r[1];
    const double cross = c->v[0] * y - c->v[1] * x, dot = c->v[0] * x + c->v[1] * y;
    const double cut = atan2(cross, dot), part = 1.0 - fabs(sin(cut));
    fprintf(out, "%scut of %.0f degrees to the %s, %s", before ? "; " : "", fabs(cut) / degree,
            cut > 0.0 ? "left" : "right", part_words(part));
  }
  return before || meets != NULL;
}

void tell_tip(FILE *out, const carom_cue *cue) {
  const double right = 0.0 - cue->a, off = hypot(right, cue->b);
  const double hour = fmod(atan2(right, cue->b) / degree / 30.0 + 12.5, 12.0);
  if (off < 0.02)
    fputs("at the centre", out);
  else
    fprintf(out, "at %d o'clock, %.0f %% of the way to the edge", (int)hour == 0 ? 12 : (int)hour,
            100.0 * off);
}

void tell_speed(FILE *out, const carom_cue *cue, const carom_ball_kind *ball) {
  carom_motion struck = {{0.0}, {0.0}};
  carom_strike(cue, ball, &struck);
  const double v = hypot(struck.v[0], struck.v[1]);
  fprintf(out, "%s, the ball at %.2g m/s", speed_words(v), v);
}
