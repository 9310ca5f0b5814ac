/* A run-out as one answer: each stroke is planned from what the one before leaves without errors.
 *
 * A landing zone is star-shaped about the place of the cue ball. Along each of CAROM_ZONE_CORNERS
 * rays, the value of the layout is asked every STEP metres until it has fallen too far or a ball or
 * cushion is in the way; the last step is halved. The tolerance of a stroke is found likewise:
 * strokes without errors, every step of speed and of direction until one misses its pot or its
 * zone. How often strokes with errors do so is played; and some of those that play on outside the
 * zone are planned on, which shows where the plan turns.
 *
 * The chance of the whole is no product of these: it comes from whole run-outs with errors, in
 * which each stroke is planned anew. */
#include "carom_coach.h"
#include "coach.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "rules.h"
#include "search_state.h"

#include <math.h>
#include <string.h>

enum { STRAYS = 8, STRAY_SHOTS = 200, HALVINGS = 4 };
static const double STEP = 0.04; /* m, along a ray */

/* What a run-out has before its plans in the job's memory. */
typedef struct workspace {
  carom_stroke_room room;
  carom_ruling ruling;                     /* of a stroke with errors; */
  carom_ruling stray[STRAYS];              /* of those that leave the zone */
  carom_shot_ball balls[CAROM_BALLS_MOST]; /* the layout that is played */
} workspace;

/* A layout of the run-out, and all that its plan needs. */
typedef struct run_out {
  workspace *work;
  carom_plan_options options;
  carom_plan_rules rules;
  carom_plan_job job; /* its balls are those of the workspace */
  bool hand;
} run_out;

static size_t bytes_of_workspace(void) {
  return (sizeof(workspace) + 63) / 64 * 64;
}

size_t carom_sequence_memory(const carom_plan_options *options) {
  const size_t plan = carom_plan_memory(options);
  if (plan == 0)
    return 0;
  return bytes_of_workspace() + plan;
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL && job->memory != NULL &&
         job->memory_size >= carom_sequence_memory(job->options);
}

/* Lays out the first layout of a job, whose plans run out. */
static carom_status begin(run_out *r, const carom_plan_job *job, int in_hand) {
  if (!is_whole(job))
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  if (job->goal != NULL || (job->options != NULL && job->options->safeties))
    return CAROM_ERROR_OPTIONS;
  r->work = job->memory;
  r->options = (carom_plan_options){0};
  if (job->options != NULL)
    r->options = *job->options;
  r->options.chance_opponent = 1.0;
  r->options.slice = 0;
  r->rules = *job->rules;
  r->job = *job;
  r->job.options = &r->options;
  r->job.rules = &r->rules;
  r->job.balls = r->work->balls;
  r->job.memory = (char *)job->memory + bytes_of_workspace();
  r->job.memory_size = job->memory_size - bytes_of_workspace();
  memcpy(r->work->balls, job->balls, (size_t)job->count * sizeof *job->balls);
  r->hand = in_hand != 0;
  return CAROM_OK;
}

/* The best stroke of a layout. */
static carom_status plan_layout(const carom_plan_job *job, bool hand, carom_plan_stroke *choice) {
  int found;
  if (hand)
    return carom_plan_hand(job, NULL, NULL, choice, 1, &found);
  return carom_plan(job, choice, 1, &found);
}

/* The best stroke of the layout that is played. The cue ball in hand is put on its place. */
static carom_status plan_stroke(const run_out *r, carom_plan_stroke *choice) {
  const carom_status status = plan_layout(&r->job, r->hand, choice);
  if (status != CAROM_OK || !r->hand)
    return status;
  return carom_place_ball(r->job.table, r->work->balls, (int)r->job.count, (int)r->job.cue->ball,
                          choice->place[0], choice->place[1], NULL);
}

/* Goes on with the layout and the state that a stroke leaves. */
static void go_on(run_out *r, const carom_ruling *ruling) {
  memcpy(r->work->balls, ruling->balls, (size_t)r->job.count * sizeof *ruling->balls);
  r->rules.state = ruling->state;
  r->job.leave = (int64_t)ruling->turn.leave;
  r->hand = ruling->hand != 0;
}

/* Whether the player is still at the table, or has won. */
static bool plays_on(const carom_ruling *ruling) {
  return ruling->turn.outcome == CAROM_TURN_KEEP || ruling->turn.outcome == CAROM_TURN_WIN;
}

static void play(const run_out *r, const carom_cue *cue, carom_call call, carom_ruling *ruling) {
  carom_play_stroke(&r->job, cue, call, &r->work->room, &(carom_shot){.events = NULL}, ruling);
}

static carom_call call_of(const carom_plan_stroke *choice) {
  return (carom_call){choice->ball, choice->pocket};
}

/* ---- Landing zones */

/* The estimated value of what a stroke leaves, with the cue ball at a place; -1 where it cannot
 * lie there. */
static double value_at(const run_out *r, carom_ruling *ruling, const double place[2]) {
  carom_plan_rules rules;
  const carom_plan_job next = carom_job_after(&r->job, ruling, &rules);
  carom_ball_state *cue = &ruling->balls[r->job.cue->ball].state;
  const double own[2] = {cue->r[0], cue->r[1]};
  double value = -1.0;
  memcpy(cue->r, place, sizeof own);
  carom_plan_value(&next, 0, &value);
  memcpy(cue->r, own, sizeof own);
  return value;
}

/* Sets the zone about the cue ball of a ruling, and the value there. */
static void find_zone(const run_out *r, double within, carom_sequence_stroke *s) {
  carom_ruling *ruling = &s->ruling;
  const double *middle = ruling->balls[r->job.cue->ball].state.r;
  for (int k = 0; k < CAROM_ZONE_CORNERS; k++)
    memcpy(s->zone[k], middle, sizeof s->zone[k]);
  s->leave_value = ruling->turn.outcome == CAROM_TURN_WIN;
  if (ruling->turn.outcome != CAROM_TURN_KEEP || ruling->hand)
    return;
  s->leave_value = value_at(r, ruling, middle);
  const double least = s->leave_value - within;
  for (int k = 0; k < CAROM_ZONE_CORNERS; k++) {
    double sine, cosine, reach = 0.0, step = STEP;
    carom_sincos(2.0 * pi * k / (double)CAROM_ZONE_CORNERS, &sine, &cosine);

    /* whole steps to the first place that is too bad, then half ones */
    for (int halvings = 0; halvings < HALVINGS;) {
      const double far = reach + step;
      const double place[2] = {middle[0] + far * cosine, middle[1] + far * sine};
      const double value = value_at(r, ruling, place);
      if (value >= 0.0 && value >= least) {
        reach = far;
        continue;
      }
      step *= 0.5;
      halvings++;
    }
    s->zone[k][0] = middle[0] + reach * cosine;
    s->zone[k][1] = middle[1] + reach * sine;
  }
}

/* Whether a place is in the zone: a ray from it crosses the border an odd number of times. */
static bool is_in_zone(const carom_sequence_stroke *s, const double place[2]) {
  bool inside = false;
  for (int k = 0; k < CAROM_ZONE_CORNERS; k++) {
    const double *a = s->zone[k], *b = s->zone[(k + 1) % CAROM_ZONE_CORNERS];
    if ((a[1] > place[1]) == (b[1] > place[1]))
      continue;
    const double x = a[0] + (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1]);
    if (x > place[0])
      inside = !inside;
  }
  return inside;
}

/* Whether a stroke wins, or plays on with the cue ball in the zone. */
static bool succeeds(const run_out *r, const carom_sequence_stroke *s, const carom_ruling *ruling) {
  if (ruling->turn.outcome == CAROM_TURN_WIN)
    return true;
  if (ruling->turn.outcome != CAROM_TURN_KEEP || s->ruling.turn.outcome == CAROM_TURN_WIN)
    return false;
  return ruling->hand || is_in_zone(s, ruling->balls[r->job.cue->ball].state.r);
}

/* ---- What strokes with errors come to */

/* How far one number of the stroke, which is within the cue, may change by steps of one sign. */
static double limit_of(const run_out *r, const carom_sequence_stroke *s, carom_cue *cue,
                       double *number, double step) {
  enum { STEPS = 60 };
  const double own = *number;
  double good = 0.0;
  for (int steps = 0, halvings = 0; steps < STEPS && halvings <= HALVINGS; steps++) {
    *number = own + good + step;
    play(r, cue, call_of(&s->choice), &r->work->ruling);
    if (*number > 0.0 && succeeds(r, s, &r->work->ruling)) {
      good += step;
      continue;
    }
    step *= 0.5;
    halvings++;
  }
  *number = own;
  return own + good;
}

static void find_tolerance(const run_out *r, carom_sequence_stroke *s) {
  static const double speed_step = 0.04, phi_step = 0.1; /* share of the speed; degrees */
  carom_cue cue = s->choice.cue;
  for (int side = 0; side < 2; side++) {
    const double sign = 2.0 * side - 1.0;
    s->speed[side] = limit_of(r, s, &cue, &cue.speed, sign * speed_step * cue.speed);
    s->phi[side] = limit_of(r, s, &cue, &cue.phi, sign * phi_step);
  }
}

/* The stroke with the errors of a number. */
static carom_cue struck_by(const run_out *r, const carom_plan_stroke *choice, uint64_t number) {
  carom_cue cue = choice->cue;
  carom_player_strike(r->job.player, r->options.seed, number, &cue);
  return cue;
}

/* Plays strokes with errors, and keeps some of those that leave the zone. Returns how many. */
static int find_shares(const run_out *r, carom_sequence_stroke *s) {
  int good = 0, strays = 0;
  for (int n = 0; n < CAROM_SEQUENCE_TRIES; n++) {
    const carom_cue cue = struck_by(r, &s->choice, (uint64_t)n);
    carom_ruling *ruling = &r->work->ruling;
    play(r, &cue, call_of(&s->choice), ruling);
    if (succeeds(r, s, ruling))
      good++;
    else if (ruling->turn.outcome == CAROM_TURN_KEEP && strays++ < STRAYS)
      r->work->stray[strays - 1] = *ruling;
  }
  s->zone_share = good / (double)CAROM_SEQUENCE_TRIES;
  s->stray_share = strays / (double)CAROM_SEQUENCE_TRIES;
  return (int)carom_min(strays, STRAYS);
}

/* Plans on from strays, and finds the most frequent pot but that of the next stroke. */
static void find_turn(const run_out *r, int strays, const carom_plan_stroke *next,
                      carom_sequence_stroke *s) {
  carom_plan_stroke choice[STRAYS];
  carom_plan_options options = r->options;
  if (options.shots == 0 || options.shots > STRAY_SHOTS)
    options.shots = STRAY_SHOTS;
  for (int k = 0; k < strays; k++) {
    const carom_ruling *stray = &r->work->stray[k];
    carom_plan_rules rules;
    carom_plan_job job = carom_job_after(&r->job, stray, &rules);
    job.options = &options;
    if (plan_layout(&job, stray->hand != 0, &choice[k]) != CAROM_OK)
      choice[k].ball = -1;
  }
  int most = 0;
  for (int k = 0; k < strays; k++) {
    const bool is_next = choice[k].ball == next->ball && choice[k].pocket == next->pocket;
    int times = 0;
    for (int n = 0; n < strays && choice[k].ball >= 0 && !is_next; n++)
      times += choice[n].ball == choice[k].ball && choice[n].pocket == choice[k].pocket;
    if (times <= most)
      continue;
    most = times;
    s->turn_ball = choice[k].ball;
    s->turn_pocket = choice[k].pocket;
    s->turn_share = times / (double)strays;
  }
}

/* Whether a stroke often plays on, be it by luck; others are safeties. */
static bool is_pot(const carom_plan_stroke *choice) {
  static const double often = 0.1; /* as carom_names_ball() has it */
  return carom_names_ball(choice) || choice->keep >= often;
}

/* Plays the stroke without errors; where a pot misses, the first one with errors that plays on
 * stands for it. */
static void find_leave(const run_out *r, carom_sequence_stroke *s) {
  play(r, &s->choice.cue, call_of(&s->choice), &s->ruling);
  for (int n = 0; n < CAROM_SEQUENCE_TRIES && is_pot(&s->choice) && !plays_on(&s->ruling); n++) {
    const carom_cue cue = struck_by(r, &s->choice, (uint64_t)n);
    play(r, &cue, call_of(&s->choice), &s->ruling);
  }
}

static bool is_stopped(const run_out *r) {
  return r->options.stop != NULL && *r->options.stop != 0;
}

carom_status carom_sequence(const carom_plan_job *job, int in_hand, double within,
                            carom_sequence_stroke *strokes, int room, int *found) {
  run_out r;
  if (strokes == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  carom_status status = begin(&r, job, in_hand);
  if (status == CAROM_OK && !(within > 0.0 && within < 1.0))
    status = CAROM_ERROR_OPTIONS;
  if (status != CAROM_OK)
    return status;
  int strays = 0, n = 0;
  for (; n < carom_min(room, CAROM_SEQUENCE_MOST); n++) {
    carom_sequence_stroke *s = &strokes[n];
    memset(s, 0, sizeof *s);
    s->turn_ball = s->turn_pocket = -1;
    status = plan_stroke(&r, &s->choice);
    if (status != CAROM_OK)
      break;

    if (n > 0)
      find_turn(&r, strays, &s->choice, &strokes[n - 1]);
    find_leave(&r, s);
    find_zone(&r, within, s);
    find_tolerance(&r, s);
    strays = find_shares(&r, s);
    if (s->ruling.turn.outcome != CAROM_TURN_KEEP || !is_pot(&s->choice) || is_stopped(&r)) {
      n++;
      break;
    }
    go_on(&r, &s->ruling);
  }
  *found = n;
  if (n > 0)
    status = CAROM_OK;
  return status;
}

/* Plays one run-out; its strokes have errors and plans of their own. */
static carom_status play_run(run_out *r, uint64_t number, carom_sequence_counts *counts) {
  enum { STROKES_MOST = 200 };
  const uint64_t seed = r->options.seed;
  carom_status status = CAROM_OK;
  carom_ruling *ruling = &r->work->ruling;
  for (int n = 0; n < STROKES_MOST; n++) {
    carom_plan_stroke choice;
    r->options.seed = (uint64_t)(0x1p53 * carom_uniform(seed, DRAW_RUN_OUTS, number, (uint32_t)n));
    status = plan_stroke(r, &choice);
    if (status != CAROM_OK || is_stopped(r))
      break;
    const carom_cue cue = struck_by(r, &choice, 0);
    play(r, &cue, call_of(&choice), ruling);
    counts->strokes += plays_on(ruling);
    if (ruling->turn.outcome != CAROM_TURN_KEEP) {
      counts->runs += ruling->turn.outcome == CAROM_TURN_WIN;
      break;
    }
    go_on(r, ruling);
  }
  r->options.seed = seed;
  return status;
}

carom_status carom_sequence_play(const carom_plan_job *job, int in_hand, int64_t first, int64_t n,
                                 carom_sequence_counts *counts) {
  run_out r;
  if (counts == NULL)
    return CAROM_ERROR_NULL;
  if (first < 0 || n < 0)
    return CAROM_ERROR_OPTIONS;
  for (int64_t k = first; k < first + n; k++) {
    carom_status status = begin(&r, job, in_hand);
    if (status == CAROM_OK)
      status = play_run(&r, (uint64_t)k, counts);
    if (status != CAROM_OK)
      return status;
    if (is_stopped(&r))
      break;
    counts->plays++;
  }
  return CAROM_OK;
}
