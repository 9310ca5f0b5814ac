/* Why a shot of a plan: the stroke without errors, and some with, are played and told. */
#include "plan_why.h"
#include "shot_story.h"

#include <math.h>
#include <string.h>

enum { MISSES = 300, EVENTS = 64 };
static const double degrees = 180.0 / 3.14159265358979323846;

/* What a stroke leaves: the balls, the rules' state, and whether the cue ball is in hand. */
typedef struct left_layout {
  carom_turn turn;
  carom_shot_ball balls[CAROM_BALLS_MOST];
  carom_plan_rules rules;
} left_layout;

static void play(const carom_plan_job *job, const carom_cue *cue, carom_call call, carom_shot *shot,
                 left_layout *to) {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST];
  uint32_t in_play = 0;
  for (int k = 0; k < job->count; k++)
    in_play |= (uint32_t)(job->balls[k].state.label != CAROM_BALL_POCKETED) << k;
  shot->final = final;
  shot->facts = &facts;
  carom_shoot(job->table, job->balls, (int)job->count, cue, job->shot, shot);
  to->rules = *job->rules;
  to->turn = to->rules.judge(to->rules.user, in_play, (int)cue->ball, &facts, call);
  for (int k = 0; k < job->count; k++) {
    to->balls[k] = job->balls[k];
    to->balls[k].state = final[k];
  }
  for (int k = 0; k < job->count; k++)
    if (to->turn.spot >> k & 1)
      carom_spot_ball(job->table, to->balls, (int)job->count, k);
}

/* A job from what is left, for whoever plays next. */
static carom_plan_job job_after(const carom_plan_job *job, const left_layout *left) {
  carom_plan_job next = *job;
  next.balls = left->balls;
  next.rules = &left->rules;
  return next;
}

/* Speeds of the ball in words: billiards.colostate.edu, "typical shot speeds". */
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

/* The cut and how much of the ball is hit; the tip as the hand of a clock; the speed. */
static void tell_aim(FILE *out, const carom_plan_job *job, const carom_cue *cue,
                     const carom_shot *shot) {
  const carom_event *meets = NULL;
  for (int64_t k = 0; k < shot->count && k < shot->room && meets == NULL; k++)
    if (shot->events[k].type == CAROM_EVENT_BALL_BALL &&
        (shot->events[k].a == cue->ball || shot->events[k].b == cue->ball))
      meets = &shot->events[k];
  fputs("   aim          ", out);
  if (meets != NULL) {
    const int own = meets->a == cue->ball ? 0 : 1;
    const carom_ball_state *c = &meets->before[own], *o = &meets->before[1 - own];
    const double x = o->r[0] - c->r[0], y = o->r[1] - c->r[1];
    const double cross = c->v[0] * y - c->v[1] * x, dot = c->v[0] * x + c->v[1] * y;
    const double cut = atan2(cross, dot), part = 1.0 - fabs(sin(cut));
    fprintf(out, "cut of %.0f degrees to the %s, %.0f/8 of the ball; ", fabs(cut) * degrees,
            cut > 0.0 ? "left" : "right", fmax(1.0, round(8.0 * part)));
  }

  /* how far the tip is from the centre, and where */
  const double right = 0.0 - cue->a, off = hypot(right, cue->b);
  const double hour = fmod(atan2(right, cue->b) * degrees / 30.0 + 12.5, 12.0);
  if (off < 0.02)
    fputs("tip at the centre; ", out);
  else
    fprintf(out, "tip at %d o'clock, %.0f %% of the way to the edge; ",
            (int)hour == 0 ? 12 : (int)hour, 100.0 * off);
  carom_motion struck;
  carom_strike(cue, &job->balls[cue->ball].kind, &struck);
  const double v = hypot(struck.v[0], struck.v[1]);
  fprintf(out, "%s, the ball at %.2g m/s\n", speed_words(v), v);
}

/* Where the cue ball stops, and the best shot from there. */
static void tell_next(FILE *out, const carom_plan_job *job, const shot_line *line,
                      const left_layout *left, int cue_ball) {
  const bool alone = job->rules->race == CAROM_RACE_ALONE;
  const double *r = left->balls[cue_ball].state.r;
  fputs("   leaves       ", out);
  if (left->turn.is == CAROM_TURN_WIN) {
    fputs("the game won\n", out);
    return;
  }
  if (left->balls[cue_ball].state.label == CAROM_BALL_STATIONARY)
    fprintf(out, "the cue ball at %.2f, %.2f m; ", r[0], r[1]);
  const bool passes = left->turn.is == CAROM_TURN_PASS;
  const carom_plan_job next = job_after(job, left);
  carom_choice c;
  int found;
  if ((passes && alone) || left->turn.is == CAROM_TURN_LOSE) {
    fputs("the visit ends\n", out);
    return;
  }
  const carom_status status = left->turn.leave == CAROM_LEAVE_AFTER
                                  ? carom_plan(&next, &c, 1, &found)
                                  : carom_plan_hand(&next, NULL, NULL, &c, 1, &found);
  char pocket[WHERE_TEXT];
  if (status != CAROM_OK)
    fputs("nothing to play\n", out);
  else if (passes)
    fprintf(out, "the other wins %.0f %%\n", 100.0 * c.value);
  else if (c.ball < 0 || c.pocket < 0)
    fprintf(out, "then it plays on %.0f %%\n", 100.0 * c.keep);
  else
    fprintf(out, "then ball %s into %s, %.0f %%\n", line->name[c.ball],
            pocket_words(line->table, c.pocket, pocket), 100.0 * c.keep);
}

/* How often a stroke with errors misses, and what that leaves the other. */
static void tell_misses(FILE *out, const carom_plan_job *job, const carom_cue *cue,
                        carom_call call) {
  int misses = 0, lost = 0;
  double other = 0.0;
  static left_layout left;
  for (int n = 0; n < MISSES; n++) {
    carom_cue stroke = *cue;
    carom_shot shot = {.events = NULL};
    carom_player_strike(job->player, job->options->seed, (uint64_t)n, &stroke);
    play(job, &stroke, call, &shot, &left);
    const carom_plan_job next = job_after(job, &left);
    double value = 1.0;
    misses += left.turn.is == CAROM_TURN_PASS;
    lost += left.turn.is == CAROM_TURN_LOSE;
    if (left.turn.is == CAROM_TURN_PASS &&
        carom_plan_value(&next, left.turn.leave != CAROM_LEAVE_AFTER, &value) == CAROM_OK)
      other += value;
  }
  fprintf(out, "   misses       %.0f %%", 100.0 * misses / MISSES);
  if (misses > 0 && job->rules->race != CAROM_RACE_ALONE)
    fprintf(out, ", which leave the other %.0f %%", 100.0 * other / misses);
  if (lost > 0)
    fprintf(out, "; %.0f %% lose", 100.0 * lost / MISSES);
  fputc('\n', out);
}

/* What the stroke is worth more without errors of speed, and without those of aim. */
static void tell_errors(FILE *out, const carom_plan_job *job, const carom_cue *cue) {
  double value[3] = {0.0};
  for (int without = 0; without < 3; without++) {
    carom_player player = *job->player;
    carom_plan_job own = *job;
    own.player = &player;
    if (without == 1)
      player.speed = player.speed_share = 0.0;
    if (without == 2)
      player.phi = player.theta = player.a = player.b = 0.0;
    carom_choice c;
    if (carom_plan_try(&own, cue, 1, &c) != CAROM_OK)
      return;
    value[without] = 100.0 * c.value;
  }
  fprintf(out, "   errors       those of speed cost %.1f %%, those of aim %.1f %%\n",
          fmax(0.0, value[1] - value[0]), fmax(0.0, value[2] - value[0]));
}

void plan_tell_why(FILE *out, const carom_plan_job *job, const shot_line *line,
                   const carom_choice *choice) {
  if (choice->kind == CAROM_PLAN_PASS)
    return;
  static carom_event events[EVENTS];
  static carom_shot_ball balls[CAROM_BALLS_MOST];
  static left_layout left;
  carom_plan_job own = *job;
  memcpy(balls, job->balls, (size_t)job->count * sizeof *balls);
  own.balls = balls;
  carom_place_ball(job->table, balls, (int)job->count, (int)choice->cue.ball, choice->place[0],
                   choice->place[1], NULL);
  const carom_call call = {choice->ball, choice->pocket};
  carom_shot shot = {.events = events, .room = EVENTS};
  play(&own, &choice->cue, call, &shot, &left);
  tell_aim(out, &own, &choice->cue, &shot);
  tell_next(out, &own, line, &left, (int)choice->cue.ball);
  tell_misses(out, &own, &choice->cue, call);
  tell_errors(out, &own, &choice->cue);
}
