/* Why a shot of a plan: the stroke without errors is played and told; then some with errors, and
 * the same without those of speed and without those of aim, which tells what these cost. */
#include "game/plan_why.h"
#include "program/words.h"
#include "rows/quantities.h"
#include "shots/shoot_aim.h"
#include "shots/shot_story.h"

#include "carom_match.h"

#include <math.h>
#include <string.h>

enum { EVENTS = 64 };
/* Plays a stroke and rules it: what it leaves, to whom, and where a cue ball in hand may be put. */
static void play(const carom_plan_job *job, const carom_cue *cue, carom_call call, carom_shot *shot,
                 carom_ruling *ruling) {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST];
  shot->final = final;
  shot->facts = &facts;
  const bool played =
      carom_shoot(job->table, job->balls, (int)job->count, cue, job->shot, shot) >= 0;
  carom_referee(job->rules, job->table, job->balls, (int)job->count, (int)cue->ball,
                played ? shot : NULL, call, ruling);
}

/* A job from what is left, for whoever plays next, with room for the rules. */
static carom_plan_job job_after(const carom_plan_job *job, const carom_ruling *ruling,
                                carom_plan_rules *rules) {
  carom_plan_job next = *job;
  *rules = *job->rules;
  rules->state = ruling->state;
  next.rules = rules;
  next.balls = ruling->balls;
  next.leave = (int64_t)ruling->turn.leave;
  return next;
}

/* The best shot from what is left. */
static carom_status plan_next(const carom_plan_job *job, const carom_ruling *ruling,
                              carom_choice *choice) {
  carom_plan_rules rules;
  const carom_plan_job next = job_after(job, ruling, &rules);
  int found;
  if (!ruling->hand)
    return carom_plan(&next, choice, 1, &found);
  return carom_plan_hand(&next, NULL, NULL, choice, 1, &found);
}

/* Where the cue ball stops, and the best shot from there. */
static void tell_next(FILE *out, const carom_plan_job *job, const shot_line *line,
                      const carom_ruling *ruling, int cue_ball) {
  const double *r = ruling->balls[cue_ball].state.r;
  fputs("   leaves       ", out);
  if (ruling->winner == 0) {
    fputs("the game won\n", out);
    return;
  }
  if (ruling->winner == CAROM_DRAWN) {
    fputs("the game drawn\n", out);
    return;
  }
  if (ruling->hand)
    fputs("ball in hand; ", out);
  else if (ruling->balls[cue_ball].state.label == CAROM_BALL_STATIONARY)
    fprintf(out, "the cue ball at %.2f, %.2f m; ", r[0], r[1]);
  const bool passes = ruling->next == 1;
  if ((passes && job->rules->race == CAROM_RACE_ALONE) || ruling->next < 0) {
    fputs("the visit ends\n", out);
    return;
  }
  carom_choice c;
  char pocket[WHERE_TEXT], ball[BALL_TEXT];
  if (plan_next(job, ruling, &c) != CAROM_OK)
    fputs("nothing to play\n", out);
  else if (passes)
    fprintf(out, "the other wins %.0f %%\n", 100.0 * c.value);
  else if (line->table->table.pockets == 0)
    fprintf(out, "then it scores %.0f %%\n", 100.0 * c.keep);
  else if (c.ball < 0 || c.pocket < 0)
    fprintf(out, "then no ball is sure, and the player wins %.0f %%\n", 100.0 * c.value);
  else
    fprintf(out, "then %s into %s, %.0f %%\n", named_ball(line->name[c.ball], ball),
            pocket_words(line->table, c.pocket, pocket), 100.0 * c.keep);
}

/* What came of strokes with errors. */
typedef struct strokes {
  int keeps, misses, fouls, lost;
  double worth, squares,
      opponent; /* sums: to the player, and of their squares; of the misses to the
                                   other */
} strokes;

static int left_of(const carom_plan_job *job, const carom_shot_ball *balls) {
  uint32_t in_play = 0;
  int32_t left[2];
  for (int k = 0; k < job->count; k++)
    in_play |= (uint32_t)(balls[k].state.label != CAROM_BALL_POCKETED) << k;
  job->rules->left(&job->rules->state, in_play, left);
  return left[0] > 1 ? left[0] : 1;
}

/* What a stroke is worth to the player, by the value of what it leaves: the chance to win, or the
 * share of the balls before it. */
static double worth_of(const carom_plan_job *job, const carom_ruling *ruling, double *opponent) {
  const bool alone = job->rules->race == CAROM_RACE_ALONE, passes = ruling->next == 1;
  if (ruling->next < 0)
    return ruling->winner != 1;
  carom_plan_rules rules;
  const carom_plan_job next = job_after(job, ruling, &rules);
  double chance = 0.0;
  if (!(alone && passes))
    carom_plan_value(&next, ruling->hand, &chance);
  if (alone)
    return fmin(1.0, (ruling->turn.points + chance * left_of(&next, ruling->balls)) /
                         left_of(job, job->balls));
  *opponent = passes ? chance : 0.0;
  return passes ? 1.0 - chance : chance;
}

/* Plays the stroke with the errors of a player. All players have the same luck. */
static strokes play_with(const carom_plan_job *job, const carom_player *player,
                         const carom_cue *cue, carom_call call) {
  strokes s = {0};
  static carom_ruling ruling;
  for (int n = 0; n < WHY_STROKES; n++) {
    carom_cue stroke = *cue;
    carom_shot shot = {.events = NULL};
    double opponent = 0.0;
    carom_player_strike(player, job->options->seed, (uint64_t)n, &stroke);
    play(job, &stroke, call, &shot, &ruling);
    const double worth = worth_of(job, &ruling, &opponent);
    s.worth += worth;
    s.squares += worth * worth;
    s.opponent += opponent;
    s.keeps += ruling.next == 0 || ruling.winner == 0 || ruling.winner == CAROM_DRAWN;
    s.misses += ruling.next == 1;
    s.fouls += ruling.turn.foul != CAROM_FOUL_NONE;
    s.lost += ruling.winner == 1;
  }
  return s;
}

bool plan_names_ball(const carom_choice *choice) {
  const bool is_meant = choice->kind == CAROM_PLAN_POT || choice->kind == CAROM_PLAN_GIVEN;
  return choice->ball >= 0 && (is_meant || choice->keep >= PLAN_LUCK);
}

void plan_play_again(const carom_plan_job *job, carom_choice *choice) {
  const carom_call call = {choice->ball, choice->pocket};
  const strokes s = play_with(job, job->player, &choice->cue, call);
  const double n = WHY_STROKES, mean = s.worth / n;
  choice->value = mean;
  choice->error = sqrt(fmax(s.squares / n - mean * mean, 0.0) / (n - 1.0));
  choice->keep = s.keeps / n;
  choice->foul = s.fouls / n;
  choice->lose = s.lost / n;
  choice->seen = WHY_STROKES;
}

/* A share of the strokes, %. One that is not 0 is not told as 0. */
static const char *percent(double share, char text[16]) {
  const double of_hundred = 100.0 * share;
  snprintf(text, 16, of_hundred > 0.0 && of_hundred < 0.5 ? "below 1 %%" : "%.0f %%", of_hundred);
  return text;
}

/* How often a stroke with errors misses, and what that leaves the other; and what it is worth more
 * without errors of speed, and without those of aim. */
static void tell_misses(FILE *out, const carom_plan_job *job, const carom_choice *choice) {
  const carom_cue *cue = &choice->cue;
  const carom_call call = {choice->ball, choice->pocket};
  const strokes played = play_with(job, job->player, cue, call);
  char text[16];
  /* a safety is meant to pass the turn */
  fprintf(out, "   %s       %s", plan_names_ball(choice) ? "misses" : "passes",
          percent((double)played.misses / WHY_STROKES, text));
  if (played.misses > 0 && job->rules->race != CAROM_RACE_ALONE)
    fprintf(out, ", and the other then wins %.0f %%", 100.0 * played.opponent / played.misses);
  if (played.lost > 0)
    fprintf(out, "; loses the game %s", percent((double)played.lost / WHY_STROKES, text));
  fputc('\n', out);

  carom_player aims = *job->player, times = *job->player;
  aims.speed = aims.speed_share = 0.0;
  times.phi = times.theta = times.a = times.b = 0.0;
  const double without_speed = play_with(job, &aims, cue, call).worth,
               without_aim = play_with(job, &times, cue, call).worth;
  fprintf(out, "   errors       those of speed cost %.1f %%, those of aim %.1f %%\n",
          fmax(0.0, 100.0 * (without_speed - played.worth) / WHY_STROKES),
          fmax(0.0, 100.0 * (without_aim - played.worth) / WHY_STROKES));
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

/* The cushions before the first ball, the cut and how much of the ball is hit; false where nothing
 * is met, and nothing is told. */
static bool tell_aim(FILE *out, const shot_line *line, const carom_cue *cue,
                     const carom_shot *shot) {
  const carom_event *meets = NULL;
  char rail[WHERE_TEXT];
  bool has_rails = false;
  for (int64_t k = 0; k < shot->count && k < shot->room && meets == NULL; k++) {
    const carom_event *e = &shot->events[k];
    if (e->type == CAROM_EVENT_BALL_BALL && (e->a == cue->ball || e->b == cue->ball))
      meets = e;
    else if (counts_as_rail(line, shot, k, (int)cue->ball)) {
      fprintf(out, "%s %s at diamond %.2f", has_rails ? ", then" : "off",
              rail_words(line->table, (int)e->b, rail),
              diamonds_at(&line->table->table, (int)e->b, e->after[0].r));
      has_rails = true;
    }
  }
  if (meets != NULL) {
    const int striker = meets->a == cue->ball ? 0 : 1;
    const carom_ball_state *c = &meets->before[striker], *o = &meets->before[1 - striker];
    const double x = o->r[0] - c->r[0], y = o->r[1] - c->r[1];
    const double cross = c->v[0] * y - c->v[1] * x, dot = c->v[0] * x + c->v[1] * y;
    const double cut = atan2(cross, dot), part = 1.0 - fabs(sin(cut));
    const double degrees = round(fabs(cut) / degree);
    fputs(text_if(has_rails, "; "), out);
    if (degrees == 0.0)
      fprintf(out, "straight, %s", part_words(part));
    else
      fprintf(out, "cut of %.0f degree%s to the %s, %s", degrees, text_if(degrees != 1.0, "s"),
              left_or_right(cut), part_words(part));
  }
  return has_rails || meets != NULL;
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

/* "medium, the ball at 1.4 m/s" */
static void tell_speed(FILE *out, const carom_cue *cue, const carom_ball_kind *ball) {
  carom_motion struck = {{0.0}, {0.0}};
  carom_strike(cue, ball, &struck);
  const double v = hypot(struck.v[0], struck.v[1]);
  fprintf(out, "%s, the ball at %.2g m/s", speed_words(v), v);
}

void plan_tell_why(FILE *out, const carom_plan_job *job, const shot_line *line,
                   const carom_choice *choice) {
  if (choice->kind == CAROM_PLAN_PASS)
    return;
  static carom_event events[EVENTS];
  static carom_shot_ball balls[CAROM_BALLS_MOST];
  static carom_ruling ruling;
  carom_plan_job placed = *job;
  memcpy(balls, job->balls, (size_t)job->count * sizeof *balls);
  placed.balls = balls;
  carom_place_ball(job->table, balls, (int)job->count, (int)choice->cue.ball, choice->place[0],
                   choice->place[1], NULL);
  const carom_call call = {choice->ball, choice->pocket};
  carom_shot shot = {.events = events, .room = EVENTS};
  play(&placed, &choice->cue, call, &shot, &ruling);
  fputs("   aim          ", out);
  fputs(tell_aim(out, line, &choice->cue, &shot) ? "; tip " : "tip ", out);
  tell_tip(out, &choice->cue);
  fputs("; ", out);
  tell_speed(out, &choice->cue, &job->balls[choice->cue.ball].kind);
  fputc('\n', out);

  /* a stroke that is not meant to pot leaves what it mostly does, even if it pots without errors */
  for (int n = 0; !plan_names_ball(choice) && ruling.next != 1 && n < WHY_STROKES; n++) {
    carom_cue stroke = choice->cue;
    carom_player_strike(placed.player, placed.options->seed, (uint64_t)n, &stroke);
    play(&placed, &stroke, call, &(carom_shot){.events = NULL}, &ruling);
  }
  tell_next(out, &placed, line, &ruling, (int)choice->cue.ball);
  tell_misses(out, &placed, choice);
}
