/* A run-out as one answer: each stroke is planned from what the one before leaves without errors.
 *
 * A landing zone is star-shaped about the position of the cue ball. Along each of
 * CAROM_ZONE_CORNERS rays, the value of the layout is evaluated every STEP metres until it has
 * fallen too far or a ball or cushion is in the way; the last step is halved. The tolerance of a
 * stroke is found likewise: strokes without errors, every step of speed and of direction until one
 * misses its pot or its zone. How often strokes with errors do so is played; and some of those that
 * play on outside the zone are planned on, which shows where the plan turns.
 *
 * The stages of a stroke are divided into pieces: a slice of a plan, a value, or a shot. Between
 * two pieces all of the run-out is in the caller's memory, so slices change no bit.
 *
 * The chance of the run-out is not a product of these: it is counted in complete run-outs with
 * errors, in which each stroke is planned again. */
#include "carom_coach.h"
#include "coach.h"
#include "platform/elementary.h"
#include "platform/ranges.h"
#include "random_draws.h"
#include "rules.h"
#include "search.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* VALUE: about as many events of a shot take as long as a value */
enum { STRAYS = 8, STRAY_SHOTS = 200, HALVINGS = 4, VALUE = 25 };
static const double STEP = 0.04; /* m, along a ray */

/* The stages of a stroke, in their order. */
typedef enum stage { PLAN, TURN, LEAVE, ZONE, TOLERANCE, SHARES, END } stage;

/* A search along a line: full steps while they are good, then half ones. */
typedef struct probe {
  double reach, step;  /* the last good position, and how far beyond it the next one is */
  int tries, halvings; /* that are left */
} probe;

/* A run-out in the job's memory, before its plans: the layout that is played, all that its plan
 * needs, and the progress of the stages. */
typedef struct run_out {
  carom_plan_options options, stray_options;
  carom_plan_rules rules, stray_rules;
  carom_plan_job job, stray_job; /* job.balls are those below */
  carom_shot_ball balls[CAROM_BALLS_MOST];
  bool hand;
  carom_stroke_room room;
  carom_ruling ruling;        /* of a stroke with errors; */
  carom_ruling stray[STRAYS]; /* of those that leave the zone, */
  carom_plan_stroke stray_choice[STRAYS];
  int strays, good; /* how many of them, and of those that succeed */

  /* for the next slice */
  uint64_t fingerprint; /* of the caller's job; 0: none continues */
  carom_sequence_stroke *strokes;
  int strokes_most, stroke; /* room for them, and which one it is now */
  double within;
  stage stage;
  int done;      /* pieces of the stage */
  bool is_begun; /* a plan, or a search along a line */
  probe probe;
  carom_status status;
} run_out;

static size_t bytes_of_run_out(void) {
  return (sizeof(run_out) + 63) / 64 * 64;
}

size_t carom_sequence_memory(const carom_plan_options *options) {
  const size_t plan = carom_plan_memory(options);
  if (plan == 0)
    return 0;
  return bytes_of_run_out() + plan;
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL && job->memory != NULL &&
         job->memory_size >= carom_sequence_memory(job->options);
}

static bool has_balls(const carom_plan_job *job) {
  return job->count >= 2 && job->count <= CAROM_BALLS_MOST;
}

/* Lays out the first layout of a job, whose plans run out. */
static carom_status begin(const carom_plan_job *job, int in_hand, run_out **made) {
  if (!is_whole(job))
    return CAROM_ERROR_NULL;
  run_out *r = job->memory;
  r->fingerprint = 0;
  if (!has_balls(job))
    return CAROM_ERROR_BALLS;
  if (job->goal != NULL || (job->options != NULL && job->options->safeties))
    return CAROM_ERROR_OPTIONS;
  memset(r, 0, sizeof *r);
  if (job->options != NULL)
    r->options = *job->options;
  r->options.chance_opponent = 1.0;
  r->options.slice = 0;
  r->rules = *job->rules;
  r->job = *job;
  r->job.options = &r->options;
  r->job.rules = &r->rules;
  r->job.balls = r->balls;
  r->job.memory = (char *)job->memory + bytes_of_run_out();
  r->job.memory_size = job->memory_size - bytes_of_run_out();
  memcpy(r->balls, job->balls, (size_t)job->count * sizeof *job->balls);
  r->hand = in_hand != 0;
  *made = r;
  return CAROM_OK;
}

/* Begins the plan of a layout, or continues with it. r->is_begun remains while it has not ended. */
static carom_status plan_layout(run_out *r, const carom_plan_job *job, bool hand,
                                carom_plan_stroke *choice) {
  int found = 0;
  carom_status status;
  if (r->is_begun)
    status = carom_plan_continue(job, choice, 1, &found);
  else if (hand)
    status = carom_plan_hand(job, NULL, NULL, choice, 1, &found);
  else
    status = carom_plan(job, choice, 1, &found);
  r->is_begun = status == CAROM_OK && found == 0;
  return status;
}

/* The same of the layout that is played. At the end, the cue ball in hand is put on its
 * position. */
static carom_status plan_stroke(run_out *r, carom_plan_stroke *choice) {
  const carom_status status = plan_layout(r, &r->job, r->hand, choice);
  if (status != CAROM_OK || r->is_begun || !r->hand)
    return status;
  return carom_place_ball(r->job.table, r->balls, (int)r->job.count, (int)r->job.cue->ball,
                          choice->place[0], choice->place[1], NULL);
}

/* Continues the layout and the state that a stroke leaves. */
static void go_on(run_out *r, const carom_ruling *ruling) {
  memcpy(r->balls, ruling->balls, (size_t)r->job.count * sizeof *ruling->balls);
  r->rules.state = ruling->state;
  r->job.leave = (int64_t)ruling->turn.leave;
  r->hand = ruling->hand != 0;
}

/* Whether the player is still at the table, or has won. */
static bool plays_on(const carom_ruling *ruling) {
  return ruling->turn.outcome == CAROM_TURN_KEEP || ruling->turn.outcome == CAROM_TURN_WIN;
}

/* Plays the stroke of a choice by another cue. Returns the number of its events. */
static int64_t play(run_out *r, const carom_cue *cue, const carom_plan_stroke *choice,
                    carom_ruling *ruling) {
  carom_shot shot = {.events = NULL};
  carom_play_stroke(&r->job, cue, (carom_call){choice->ball, choice->pocket}, &r->room, &shot,
                    ruling);
  return shot.count + 1;
}

/* Takes the result of a probe at reach + step. Returns whether the search continues. */
static bool advance(probe *p, bool is_good) {
  p->tries--;
  if (is_good) {
    p->reach += p->step;
  } else {
    p->step *= 0.5;
    p->halvings--;
  }
  return p->tries > 0 && p->halvings > 0;
}

/* ---- Landing zones */

/* The estimated value of what a stroke leaves, with the cue ball at a position; -1 where it cannot
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

/* The next value of a zone: of the leave, then of positions along the rays. Returns whether there
 * are more. */
static bool probe_zone(run_out *r, carom_sequence_stroke *s) {
  carom_ruling *ruling = &s->ruling;
  const double *middle = ruling->balls[r->job.cue->ball].state.r;
  if (!r->is_begun) {
    for (int k = 0; k < CAROM_ZONE_CORNERS; k++)
      memcpy(s->zone[k], middle, sizeof s->zone[k]);
    s->leave_value = ruling->turn.outcome == CAROM_TURN_WIN;
    if (ruling->turn.outcome != CAROM_TURN_KEEP || ruling->hand)
      return false;
    s->leave_value = value_at(r, ruling, middle);
    r->probe = (probe){.step = STEP, .tries = INT_MAX, .halvings = HALVINGS};
    r->is_begun = true;
    return true;
  }

  /* the next position along the ray */
  double sine, cosine;
  carom_sincos(2.0 * pi * r->done / (double)CAROM_ZONE_CORNERS, &sine, &cosine);
  const double far = r->probe.reach + r->probe.step;
  const double place[2] = {middle[0] + far * cosine, middle[1] + far * sine};
  const double value = value_at(r, ruling, place);
  if (advance(&r->probe, value >= 0.0 && value >= s->leave_value - r->within))
    return true;

  /* the corner, and the next ray */
  s->zone[r->done][0] = middle[0] + r->probe.reach * cosine;
  s->zone[r->done][1] = middle[1] + r->probe.reach * sine;
  r->probe = (probe){.step = STEP, .tries = INT_MAX, .halvings = HALVINGS};
  r->done++;
  r->is_begun = r->done < CAROM_ZONE_CORNERS;
  return r->is_begun;
}

/* Whether a position is in the zone: a ray from it crosses the border an odd number of times. */
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

/* ---- Results of strokes with errors */

/* The next shot of a tolerance: how far the speed, then the direction may change to either side.
 * Returns its events. */
static int64_t probe_tolerance(run_out *r, carom_sequence_stroke *s) {
  static const double speed_step = 0.04, phi_step = 0.1; /* fraction of the speed; degrees */
  enum { STEPS = 60 };
  const int side = r->done / 2;
  const bool is_speed = r->done % 2 == 0;
  carom_cue cue = s->choice.cue;
  double *number = is_speed ? &cue.speed : &cue.phi;
  double *limit = is_speed ? &s->speed[side] : &s->phi[side];
  if (!r->is_begun) {
    const double step = is_speed ? speed_step * cue.speed : phi_step;
    r->probe = (probe){.step = (2.0 * side - 1.0) * step, .tries = STEPS, .halvings = HALVINGS + 1};
  }

  const double own = *number;
  *number = own + r->probe.reach + r->probe.step;
  const int64_t events = play(r, &cue, &s->choice, &r->ruling);
  r->is_begun = advance(&r->probe, *number > 0.0 && succeeds(r, s, &r->ruling));
  if (!r->is_begun) {
    *limit = own + r->probe.reach;
    r->done++;
  }
  return events;
}

/* The stroke with the errors of a number. */
static carom_cue struck_by(const run_out *r, const carom_plan_stroke *choice, int number) {
  carom_cue cue = choice->cue;
  carom_player_strike(r->job.player, r->options.seed, (uint64_t)number, &cue);
  return cue;
}

/* Plays the next stroke with errors, and keeps it if it is one of the first that leave the zone.
 * Returns its events. */
static int64_t play_share(run_out *r, carom_sequence_stroke *s) {
  const carom_cue cue = struck_by(r, &s->choice, r->done);
  if (r->done++ == 0)
    r->good = r->strays = 0;
  const int64_t events = play(r, &cue, &s->choice, &r->ruling);
  if (succeeds(r, s, &r->ruling))
    r->good++;
  else if (r->ruling.turn.outcome == CAROM_TURN_KEEP && r->strays++ < STRAYS)
    r->stray[r->strays - 1] = r->ruling;
  s->zone_share = r->good / (double)CAROM_SEQUENCE_TRIES;
  s->stray_share = r->strays / (double)CAROM_SEQUENCE_TRIES;
  return events;
}

/* Plans on from the next stray. Returns whether there are more. */
static bool plan_stray(run_out *r) {
  const int kept = (int)carom_min(r->strays, STRAYS);
  if (r->done == kept)
    return false;
  const carom_ruling *stray = &r->stray[r->done];
  if (!r->is_begun) {
    r->stray_options = r->options;
    if (r->options.shots == 0 || r->options.shots > STRAY_SHOTS)
      r->stray_options.shots = STRAY_SHOTS;
    r->stray_job = carom_job_after(&r->job, stray, &r->stray_rules);
    r->stray_job.options = &r->stray_options;
  }
  carom_plan_stroke *choice = &r->stray_choice[r->done];
  if (plan_layout(r, &r->stray_job, stray->hand != 0, choice) != CAROM_OK)
    choice->ball = -1;
  r->done += !r->is_begun;
  return r->done < kept;
}

/* Finds the most frequent pot from the strays except the pot of the next stroke. */
static void find_turn(const run_out *r, const carom_plan_stroke *next, carom_sequence_stroke *s) {
  const carom_plan_stroke *choice = r->stray_choice;
  const int strays = (int)carom_min(r->strays, STRAYS);
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
 * represents it. Returns the events of the stroke. */
static int64_t play_leave(run_out *r, carom_sequence_stroke *s) {
  carom_cue cue = s->choice.cue;
  if (r->done > 0)
    cue = struck_by(r, &s->choice, r->done - 1);
  r->done++;
  return play(r, &cue, &s->choice, &s->ruling);
}

static bool is_stopped(const run_out *r) {
  return r->options.stop != NULL && *r->options.stop != 0;
}

/* ---- The stages */

static void begin_stage(run_out *r, stage next) {
  r->stage = next;
  r->done = 0;
  r->is_begun = false;
}

static void begin_stroke(run_out *r) {
  carom_sequence_stroke *s = &r->strokes[r->stroke];
  memset(s, 0, sizeof *s);
  s->turn_ball = s->turn_pocket = -1;
  begin_stage(r, PLAN);
}

/* After the last piece of a stroke: the next stroke, or the end. */
static void end_stroke(run_out *r, const carom_sequence_stroke *s) {
  r->stroke++;
  if (s->ruling.turn.outcome != CAROM_TURN_KEEP || !is_pot(&s->choice) || is_stopped(r) ||
      r->stroke == r->strokes_most) {
    begin_stage(r, END);
    return;
  }
  go_on(r, &s->ruling);
  begin_stroke(r);
}

/* Goes through the next piece of a stage. Returns about how many events it takes. */
static int64_t go_through_piece(run_out *r) {
  carom_sequence_stroke *s = &r->strokes[r->stroke];
  int64_t events = r->options.slice;
  switch (r->stage) {
  case PLAN:
    r->status = plan_stroke(r, &s->choice);
    if (!r->is_begun)
      begin_stage(r, r->status == CAROM_OK ? TURN : END);
    break;
  case TURN:
    if (r->stroke > 0 && plan_stray(r))
      break;
    if (r->stroke > 0)
      find_turn(r, &s->choice, s - 1);
    begin_stage(r, LEAVE);
    break;
  case LEAVE:
    events = play_leave(r, s);
    if (r->done > CAROM_SEQUENCE_TRIES || !is_pot(&s->choice) || plays_on(&s->ruling))
      begin_stage(r, ZONE);
    break;
  case ZONE:
    events = VALUE;
    if (!probe_zone(r, s))
      begin_stage(r, TOLERANCE);
    break;
  case TOLERANCE:
    events = probe_tolerance(r, s);
    if (r->done == 4)
      begin_stage(r, SHARES);
    break;
  case SHARES:
    events = play_share(r, s);
    if (r->done == CAROM_SEQUENCE_TRIES)
      end_stroke(r, s);
    break;
  case END:
    break;
  }
  return events;
}

/* Plays a slice of a run-out, or what is left of it. */
static carom_status play_slice(run_out *r, int *found) {
  int64_t left = INT64_MAX;
  if (r->options.slice > 0)
    left = r->options.slice;
  while (r->stage != END && left > 0)
    left -= go_through_piece(r);
  *found = 0;
  if (r->stage != END)
    return CAROM_OK;
  *found = r->stroke;
  return r->stroke > 0 ? CAROM_OK : r->status;
}

carom_status carom_sequence(const carom_plan_job *job, int in_hand, double within,
                            carom_sequence_stroke *strokes, int room, int *found) {
  run_out *r;
  if (found != NULL)
    *found = 0;
  if (strokes == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  carom_status status = begin(job, in_hand, &r);
  if (status == CAROM_OK && !(within > 0.0 && within < 1.0))
    status = CAROM_ERROR_OPTIONS;
  if (status != CAROM_OK)
    return status;
  if (job->options != NULL)
    r->options.slice = job->options->slice;
  r->fingerprint = carom_fingerprint_of_job(job);
  r->strokes = strokes;
  r->strokes_most = (int)carom_min(room, CAROM_SEQUENCE_MOST);
  r->within = within;
  begin_stroke(r);
  return play_slice(r, found);
}

carom_status carom_sequence_continue(const carom_plan_job *job, int *found) {
  if (found != NULL)
    *found = 0;
  if (found == NULL || !is_whole(job))
    return CAROM_ERROR_NULL;
  run_out *r = job->memory;
  if (!has_balls(job) || r->fingerprint != carom_fingerprint_of_job(job))
    return CAROM_ERROR_STATE;
  return play_slice(r, found);
}

/* Plays one run-out; its strokes have their own errors and plans. */
static carom_status play_run(run_out *r, uint64_t number, carom_sequence_counts *counts) {
  enum { STROKES_MOST = 200 };
  const uint64_t seed = r->options.seed;
  carom_status status = CAROM_OK;
  carom_ruling *ruling = &r->ruling;
  for (int n = 0; n < STROKES_MOST; n++) {
    carom_plan_stroke choice;
    r->options.seed = (uint64_t)(0x1p53 * carom_uniform(seed, DRAW_RUN_OUTS, number, (uint32_t)n));
    status = plan_stroke(r, &choice);
    if (status != CAROM_OK || is_stopped(r))
      break;
    const carom_cue cue = struck_by(r, &choice, 0);
    play(r, &cue, &choice, ruling);
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
  run_out *r;
  if (counts == NULL)
    return CAROM_ERROR_NULL;
  if (first < 0 || n < 0)
    return CAROM_ERROR_OPTIONS;
  for (int64_t k = first; k < first + n; k++) {
    carom_status status = begin(job, in_hand, &r);
    if (status == CAROM_OK)
      status = play_run(r, (uint64_t)k, counts);
    if (status != CAROM_OK)
      return status;
    if (is_stopped(r))
      break;
    counts->plays++;
  }
  return CAROM_OK;
}
