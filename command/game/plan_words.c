/* What a stroke of a plan does, and how it is played, in words. */
#include "game/plan_words.h"

#include "program/words.h"
#include "shots/shoot_aim.h"
#include "shots/shot_story.h"

#include "carom_coach.h"

#include <math.h>

/* What a choice that names no ball does. */
static const char *words_without_ball(const shot_line *line, const carom_plan_stroke *c) {
  static const double often = 0.15; /* fouls of a stroke that is no safe one */
  if (line->table->table.pockets == 0)
    return "no point";
  int objects = 0;
  for (int k = 1; k < line->count; k++)
    objects += line->ball[k].state.label < CAROM_BALL_POCKETED;
  if (c->keep >= 0.1 && objects == 1) /* below it balls fall by luck, as for carom_names_ball() */
    return "no sure pot: whether the ball falls is luck";
  if (c->keep >= 0.1)
    return "no sure pot: which ball falls is luck";
  if (c->foul >= often)
    return "a risky safety: it often fouls";
  if (c->keep < 0.005)
    return "a safety: nothing is potted";
  return objects == 1 ? "a safety: the ball falls by luck alone"
                      : "a safety: balls fall by luck alone";
}

/* By which kind of stroke a ball falls: ", by a bank"; nothing where it is direct. */
static void kind_words(const carom_plan_stroke *c, char text[40]) {
  text[0] = '\0';
  if (c->kind == CAROM_PLAN_SCAN)
    snprintf(text, 40, ", by several ways");
  else if (c->kind == CAROM_PLAN_RAIL_FIRST)
    snprintf(text, 40, ", rail first");
  else if (c->kind != CAROM_PLAN_POT && c->kind != CAROM_PLAN_GIVEN)
    snprintf(text, 40, ", by a %s", carom_word_text(CAROM_WORDS_PLAN_KIND, c->kind));
}

/* What a choice does, by the names of the file. */
void plan_describe(const shot_line *line, const carom_plan_stroke *c, char text[PLAN_TEXT]) {
  char pocket[WHERE_TEXT], ball[BALL_TEXT], way_words[40];
  if (c->kind == CAROM_PLAN_FOUL)
    snprintf(text, PLAN_TEXT, "no shot without a foul was found");
  else if (c->kind == CAROM_PLAN_PASS)
    snprintf(text, PLAN_TEXT, "pass: the other plays");
  else if (c->kind == CAROM_PLAN_PUSH || c->kind == CAROM_PLAN_BREAK)
    snprintf(text, PLAN_TEXT, "a %s", carom_word_text(CAROM_WORDS_PLAN_KIND, c->kind));
  else if (!carom_names_ball(c))
    snprintf(text, PLAN_TEXT, "%s", words_without_ball(line, c));
  else if (c->pocket < 0)
    snprintf(text, PLAN_TEXT,
             c->kind == CAROM_PLAN_CAROM ? "a point, %s first" : "a point, off a cushion, %s first",
             named_ball(line->name[c->ball], ball));
  else {
    kind_words(c, way_words);
    snprintf(text, PLAN_TEXT, "%s into %s%s", named_ball(line->name[c->ball], ball),
             pocket_words(line->table, c->pocket, pocket), way_words);
  }
}

void plan_tell_stroke(FILE *out, const carom_plan_stroke *c, bool hand) {
  if (hand)
    fprintf(out, "   cue ball at  %.4f, %.4f m\n", c->place[0], c->place[1]);
  fprintf(out, "   stroke       speed %.3g m/s, direction %.3f degrees, raised %.1f, ",
          c->cue.speed, c->cue.phi, c->cue.theta);
  fprintf(out, "tip %.2f %s, %.2f %s\n", fabs(c->cue.a), left_or_right(c->cue.a), fabs(c->cue.b),
          above_or_below(c->cue.b));
}
