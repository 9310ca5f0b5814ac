/* Why a shot of a plan, in words: what the library finds about it. */
#include "game/plan_why.h"
#include "program/words.h"
#include "rows/quantities.h"
#include "shots/shoot_aim.h"
#include "shots/shot_story.h"

#include "carom_coach.h"

#include <math.h>

/* A share of the strokes, %. One that is not 0 is not told as 0. */
static const char *percent(double share, char text[16]) {
  const double of_hundred = 100.0 * share;
  snprintf(text, 16, of_hundred > 0.0 && of_hundred < 0.5 ? "below 1 %%" : "%.0f %%", of_hundred);
  return text;
}

/* A share in tenths of a percent, of which none is -0. */
static double tenths(double share) {
  return round(1000.0 * share) / 10.0 + 0.0;
}

/* ---- The stroke in the words of a coach */

/* Speeds of the ball in words, by billiards.colostate.edu/faq/speed/typical. */
static const char *speed_words(double v) {
  static const struct {
    double most;
    const char *words;
  } speeds[] = {{0.45, "a soft touch"}, {0.89, "slow"},          {1.9, "medium"},
                {3.2, "fast"},          {4.5, "a power stroke"}, {8.0, "a very hard stroke"}};
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

/* The cushions before the first ball, the cut and how much of the ball is hit; nothing where
 * nothing is met. */
static void tell_aim(FILE *out, const shot_line *line, const carom_why *why) {
  char rail[WHERE_TEXT];
  for (int k = 0; k < why->rails; k++)
    fprintf(out, "%s %s at diamond %.2f", k > 0 ? ", then" : "off",
            rail_words(line->table, why->rail[k], rail),
            diamonds_at(&line->table->table, why->rail[k], why->contact[k]));
  const double degrees = round(fabs(why->cut));
  if (why->first >= 0)
    fputs(text_if(why->rails > 0, "; "), out);
  if (why->first >= 0 && degrees == 0.0)
    fprintf(out, "straight, %s", part_words(why->part));
  else if (why->first >= 0)
    fprintf(out, "cut of %.0f degree%s to the %s, %s", degrees, text_if(degrees != 1.0, "s"),
            left_or_right(why->cut), part_words(why->part));
  if (why->first >= 0 || why->rails > 0)
    fputs("; ", out);
}

/* "at 6 o'clock, 30 % of the way to the edge" */
static void tell_tip(FILE *out, const carom_cue *cue) {
  const double right = 0.0 - cue->a, off = hypot(right, cue->b);
  const double hour = fmod(atan2(right, cue->b) / degree / 30.0 + 12.5, 12.0);
  if (off < 0.02)
    fputs("at the centre", out);
  else
    fprintf(out, "at %d o'clock, %.0f %% of the way to the edge", (int)hour == 0 ? 12 : (int)hour,
            100.0 * off);
}

/* Where the cue ball stops, and the best shot from there. */
static void tell_next(FILE *out, const carom_plan_job *job, const shot_line *line,
                      const carom_plan_stroke *choice, const carom_why *why) {
  const carom_ruling *ruling = &why->ruling;
  const carom_ball_state *cue = &ruling->balls[job->cue->ball].state;
  const carom_plan_stroke *c = &why->next;
  const bool passes = ruling->turn.outcome == CAROM_TURN_PASS;
  const bool seldom = carom_names_ball(choice) && !passes && choice->keep < 0.5;
  char pocket[WHERE_TEXT], ball[BALL_TEXT];
  fprintf(out, "   leaves       %s", text_if(seldom, "where it succeeds: "));
  if (ruling->turn.outcome == CAROM_TURN_WIN) {
    fputs("the game won\n", out);
    return;
  }
  if (ruling->turn.outcome == CAROM_TURN_DRAW) {
    fputs("the game drawn\n", out);
    return;
  }
  if (ruling->hand)
    fputs("ball in hand; ", out);
  else if (cue->label == CAROM_BALL_STATIONARY)
    fprintf(out, "the cue ball at %.2f, %.2f m; ", cue->r[0], cue->r[1]);
  if ((passes && job->rules->race == CAROM_RACE_ALONE) || ruling->turn.outcome >= CAROM_TURN_WIN)
    fputs("the visit ends\n", out);
  else if (passes && isnan(why->leave))
    fputs("the other plays\n", out);
  else if (passes && choice->leave[0] > 0.0)
    fprintf(out, "the other wins %.0f %% by playing; given back, the player wins %.0f %%\n",
            100.0 * choice->leave[0], 100.0 * choice->leave[1]);
  else if (passes)
    fprintf(out, "the other wins %.0f %%\n", 100.0 * (1.0 - why->leave));
  else if (!why->has_next)
    fputs("nothing to play\n", out);
  else if (line->table->table.pockets == 0)
    fprintf(out, "then it scores %.0f %%\n", 100.0 * c->keep);
  else if (c->ball < 0 || c->pocket < 0)
    fprintf(out, "then no ball is sure, and the player wins %.0f %%\n",
            100.0 * (isnan(why->leave) ? c->value : why->leave));
  else
    fprintf(out, "then %s into %s, %.0f %%\n", named_ball(line->name[c->ball], ball),
            pocket_words(line->table, c->pocket, pocket), 100.0 * c->keep);
}

/* How often a stroke with errors misses, and what that leaves the other; and what errors cost. */
static void tell_misses(FILE *out, const carom_plan_stroke *choice, const carom_why *why) {
  static const char *const of_error[CAROM_WHY_ERRORS] = {[CAROM_WHY_AIM] = "aim",
                                                         [CAROM_WHY_SPEED] = "speed",
                                                         [CAROM_WHY_TIP] = "the tip",
                                                         [CAROM_WHY_EYE] = "the eye"};
  char text[16];
  /* a safety is meant to pass the turn */
  fprintf(out, "   %s       %s", carom_names_ball(choice) ? "misses" : "passes",
          percent(why->misses, text));
  if (!isnan(why->opponent))
    fprintf(out, ", and the other then wins %.0f %%", 100.0 * why->opponent);
  if (why->loses > 0.0)
    fprintf(out, "; loses the game %s", percent(why->loses, text));
  fprintf(out, "\n   errors       cost %.1f %%:", tenths(why->flawless_value - why->value));
  for (int k = 0; k < CAROM_WHY_ERRORS; k++)
    fprintf(out, "%s those of %s %.1f %%", text_if(k > 0, ","), of_error[k], tenths(why->cost[k]));
  fputc('\n', out);
}

void plan_tell_why(FILE *out, const carom_plan_job *job, const shot_line *line,
                   const carom_plan_stroke *choice) {
  static carom_why why;
  if (choice->kind == CAROM_PLAN_PASS)
    return;
  if (carom_why_of(job, choice, &why) != CAROM_OK)
    return;
  fputs("   aim          ", out);
  tell_aim(out, line, &why);
  fputs("tip ", out);
  tell_tip(out, &choice->cue);
  fprintf(out, "; %s, the ball at %.2g m/s\n", speed_words(why.speed), why.speed);
  tell_next(out, job, line, choice, &why);
  tell_misses(out, choice, &why);
}
