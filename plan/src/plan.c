/* The best shot of a layout, by playing many.
 *
 * 1. Pots: every direct pot whose chance is above 3 %, with six speeds and five places of the
 *    tip. The aim is solved by shots of two balls that stop at the contact: three fixed-point
 *    steps for throw, the squirt once for each tip.
 * 2. Scan: strokes in all directions. One that meets a ball first that is not on is stopped
 *    there. The others are candidates: banks, kicks, combinations, caroms, safeties, breaks.
 * 3. Each candidate is played once without errors. Its worth is 1 for a win, 0 for a loss, else
 *    the value of the layout that it leaves, to whoever plays next.
 * 4. Sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013): four rounds with equal
 *    shares of the shots. In each, the candidates that are left are played with errors, the same
 *    errors for all; a quarter of them stays. In the third round strokes near the best one join,
 *    with another speed, tip or direction; where no pot is direct, after each round.
 * 5. The best is played again, with errors that have chosen nothing, which tell its chances.
 *
 * With ball in hand, candidates are made from several places, and race together.
 *
 * A shot is a row, whose errors are a function of seed, round and number. Rows are computed by
 * threads and added up in their order, so no bit of a sum depends on threads. The rows of a stage
 * are played at once or in slices, between which all of the plan is in the caller's memory. */
#include "anytime.h"
#include "candidates.h"
#include "carom_coach.h"
#include "coach.h"
#include "drawn_tables.h"
#include "goals.h"
#include "leaves.h"
#include "listing.h"
#include "places.h"
#include "plan_options.h"
#include "platform/fingerprint.h"
#include "platform/ranges.h"
#include "ranking.h"
#include "rows.h"
#include "rules.h"
#include "schema/options.h"
#include "search.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;
typedef carom_search search;

/* ---- Arguments */

static const carom_plan_options no_options = {0};
static const carom_shot_options no_shot = {0};
/* FIRST: of the first round of doubling; IN_HAND_LEAST: of a plan whose places race */
enum { IN_HAND_LEAST = 600, SHOTS_USUAL = 2000, SHOTS_IN_TIME = 200000, FIRST = 100, SPARE = 400 };

static carom_status check_options(const carom_plan_options *o) {
  CAROM_PLAN_OPTIONS(CAROM_CHECK_OPTION)
  if (o->slice < 0 || !CAROM_RESERVED_IS_ZERO(o))
    return CAROM_ERROR_OPTIONS;
  return CAROM_OK;
}

static int64_t shots_of(const carom_plan_options *o) {
  if (o->shots > 0)
    return o->shots;
  if (o->seconds > 0.0)
    return SHOTS_IN_TIME;
  return SHOTS_USUAL;
}

/* A quarter of the shots are strokes of pots, each of which is played once without errors; then
 * those that the scan keeps, half as many again of the block that it tries, and room for the
 * least numbers of both. */
static int64_t most_candidates(int64_t shots, double scan) {
  return (int64_t)((1.0 - scan) * (double)shots / 4.0) + (int64_t)(1.5 * scan * (double)shots) +
         carom_min(shots, SCAN_MORE) + SPARE;
}

/* Rows of the largest stage; those of reasons are of one candidate. */
static int64_t most_rows(int64_t shots, double scan) {
  return carom_max(shots + most_candidates(shots, scan), CAROM_WHY_STROKES);
}

static const carom_plan_options *or_usual(const carom_plan_options *options) {
  if (options == NULL)
    return &no_options;
  return options;
}

size_t carom_search_memory(const carom_plan_options *options, bool searches_leaves) {
  const int64_t shots = shots_of(options);
  const double scan = carom_scan_of(options);
  return sizeof(search) + (size_t)most_candidates(shots, scan) * sizeof(candidate) +
         (size_t)most_rows(shots, scan) * sizeof(outcome) + carom_leaves_memory(searches_leaves);
}

size_t carom_plan_memory(const carom_plan_options *options) {
  const carom_plan_options *o = or_usual(options);
  if (check_options(o) != CAROM_OK)
    return 0;
  size_t bytes = carom_search_memory(o, true);
  if (o->unsure > 0.0)
    bytes += TABLES * sizeof(carom_drawn_table);
  return bytes;
}

/* Where a plan is in the caller's memory; NULL where there is too little of it, or nothing to
 * plan. */
static search *place(const carom_plan_job *job) {
  if (job == NULL || job->memory_size < carom_plan_memory(job->options))
    return NULL;
  return job->memory;
}

/* Checks the cue of a plan with the stroke of another one. A speed of 0 is raised later by the
 * bounds of the player, so the rest of the cue counts. */
static carom_status check_stroke(const search *plan, const carom_cue *stroke) {
  carom_cue cue = *plan->job.cue;
  cue.speed = stroke->speed;
  if (stroke->speed == 0.0)
    cue.speed = 1.0;
  cue.phi = stroke->phi;
  cue.theta = stroke->theta;
  cue.a = stroke->a;
  cue.b = stroke->b;
  return carom_check_strike(&plan->layout, &cue);
}

/* Once for all shots of a plan; with_cue: and its cue, whose stroke is not looked at. */
static carom_status prepare(search *plan, const carom_shot_ball *balls, bool with_cue) {
  int where;
  const carom_status status = carom_prepare(plan->job.table, balls, plan->job.count, &plan->shot,
                                            &plan->features, &plan->layout, &where);
  if (status != CAROM_OK || !with_cue)
    return status;
  return check_stroke(plan, &(carom_cue){0});
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL;
}

uint64_t carom_fingerprint_of_job(const carom_plan_job *job) {
  uint64_t h = carom_fingerprint(1, job, sizeof *job);
  h = carom_fingerprint(h, job->table, sizeof *job->table);
  h = carom_fingerprint(h, job->balls, (size_t)job->count * sizeof *job->balls);
  h = carom_fingerprint(h, job->cue, sizeof *job->cue);
  h = carom_fingerprint(h, job->player, sizeof *job->player);
  h = carom_fingerprint(h, job->rules, sizeof *job->rules);
  if (job->shot != NULL)
    h = carom_fingerprint(h, job->shot, sizeof *job->shot);
  if (job->options != NULL)
    h = carom_fingerprint(h, job->options, sizeof *job->options);
  if (job->goal != NULL)
    h = carom_fingerprint(h, job->goal, sizeof *job->goal);
  return h;
}

/* Whether rules have their functions, and numbers that this version knows. */
static bool good_rules(const carom_plan_rules *rules) {
  if (rules->on == NULL || rules->judge == NULL || rules->left == NULL)
    return false;
  return (uint32_t)rules->breaks <= 2 && (uint32_t)rules->race <= CAROM_RACE_SEATS &&
         (rules->race != CAROM_RACE_SEATS || rules->value != NULL) &&
         carom_rack_size((carom_rack_kind)rules->rack) > 0 && rules->learned >= 0 &&
         (uint32_t)rules->own_cue_balls <= 1 && CAROM_RESERVED_IS_ZERO(rules);
}

/* Checks what a job says of itself; the table and the balls are checked with the layout. */
static carom_status check_job(const carom_plan_job *job) {
  if (!is_whole(job))
    return CAROM_ERROR_NULL;
  const carom_plan_options *options = or_usual(job->options);
  const bool good_players =
      carom_player_is_good(job->player) && carom_player_is_good(carom_opponent_of(job, options));
  if (check_options(options) != CAROM_OK || !good_players || !good_rules(job->rules) ||
      (uint64_t)job->leave > CAROM_LEAVE_BAULK || !carom_goal_is_good(job) ||
      !CAROM_RESERVED_IS_ZERO(job))
    return CAROM_ERROR_OPTIONS;
  return CAROM_OK;
}

/* Takes a job, its options and its player. Shots have the caller's options but for when to stop,
 * which the plan says itself. */
static void take_job(search *plan, const carom_plan_job *job) {
  plan->job = *job;
  plan->options = *or_usual(job->options);
  plan->player = carom_player_bounded(job->player, job->cue);
  if (plan->options.shots == 0 && plan->options.seconds == 0.0)
    plan->options.shots = (int64_t)job->player->shots;
  plan->shot = no_shot;
  if (job->shot != NULL)
    plan->shot = *job->shot;
  plan->shot.threads = 0;
  plan->shot.stop_at = 0;
  plan->shot.first_of = 0;
  plan->shot.time_most = 0.0;
}

/* Checks the layout once for all shots of a plan. In hand the cue's ball may be down, and its
 * stroke is checked when it is placed. */
static carom_status check_layout(search *plan, bool in_hand) {
  const carom_plan_job *job = &plan->job;
  const carom_status status = prepare(plan, job->balls, !in_hand);
  if (status != CAROM_OK)
    return status;
  if (job->cue->ball < 0 || job->cue->ball >= job->count)
    return CAROM_ERROR_CUE_BALL;
  int moves = -1;
  if (in_hand)
    moves = (int)job->cue->ball;
  if (!carom_is_at_rest(&plan->layout, moves))
    return CAROM_ERROR_IN_MOTION;
  return CAROM_OK;
}

/* Candidates, outcomes and tables stand behind the plan in the caller's memory. */
static void share_memory(search *plan) {
  const int64_t shots = shots_of(&plan->options);
  const double scan = carom_scan_of(&plan->options);
  plan->count = 0;
  plan->most = most_candidates(shots, scan);
  plan->room = most_rows(shots, scan);
  plan->found = (candidate *)(plan + 1);
  plan->outcome = (outcome *)(plan->found + plan->most);
  plan->leaves = (carom_leaves *)(plan->outcome + plan->room);
  plan->path = carom_leaves_trails(plan->leaves);
  plan->drawn = NULL;
}

/* Whether the rack of a soft break is whole: each ball that is on touches two others. */
static bool is_packed(const search *plan) {
  enum { BALLS_LEAST = 10, NEIGHBOURS = 2 };
  static const double apart = 1e-3; /* m */
  for (int k = 0; k < plan->view.count; k++) {
    int neighbours = 0;
    for (int n = 0; n < plan->view.count && (plan->targets >> k & 1); n++) {
      const double reach = plan->view.radius[k] + plan->view.radius[n] + apart;
      const bool touches = carom_square(plan->state[k].r, plan->state[n].r) < reach * reach;
      neighbours += n != k && (plan->targets >> n & 1) && touches;
    }
    if ((plan->targets >> k & 1) && neighbours < NEIGHBOURS)
      return false;
  }
  return carom_count_of(plan->targets) >= BALLS_LEAST;
}

/* Reads the layout by the rules: which balls are in play, which of them may be met first, and what
 * the stroke may do. */
static carom_status ask_rules(search *plan, bool in_hand) {
  const carom_plan_rules *rules = plan->job.rules;
  const uint32_t cue_ball = UINT32_C(1) << plan->view.cue_ball;
  for (int k = 0; k < plan->job.count; k++)
    plan->state[k] = plan->job.balls[k].state;

  /* the balls */
  plan->in_play = carom_in_play(plan->state, plan->view.count);
  if (in_hand)
    plan->in_play |= cue_ball;
  plan->targets = rules->on(&rules->state, plan->in_play) & plan->in_play & ~cue_ball;
  if (plan->targets == 0)
    return CAROM_ERROR_GAME_OVER;

  /* the stroke */
  plan->breaks = rules->breaks && rules->state.opening == 1;
  if (rules->breaks == 2 && in_hand)
    plan->breaks |= is_packed(plan);
  plan->only_safeties = carom_goal_has_safeties(&plan->job, &plan->options) && !plan->breaks;
  plan->permissions = (uint32_t)rules->state.may;
  if (plan->only_safeties || carom_has_goal(&plan->job))
    plan->permissions &= ~(uint32_t)(CAROM_CHOICE_PASS | CAROM_CHOICE_PUSH);
  plan->pockets = carom_pockets_of(rules, &rules->state);
  plan->first_decides = rules->first_decides && !(plan->permissions & CAROM_CHOICE_PUSH);
  carom_search_lay_out(plan, plan->job.balls);

  /* the balls that are left to the player, at least one */
  int32_t left[2];
  rules->left(&rules->state, plan->in_play, left);
  plan->left = (int32_t)carom_max(left[0], 1);
  return CAROM_OK;
}

/* The value of a foul at the first contact, which leaves about the layout that there is. */
static double foul_value_of(const search *plan) {
  const carom_plan_rules *rules = plan->job.rules;
  carom_rules_state game = rules->state; /* rules change it as they judge */
  carom_turn turn = rules->judge(&game, plan->in_play, plan->view.cue_ball, &carom_no_facts,
                                 (carom_call){-1, -1});
  turn = carom_turn_seen(rules, &game, turn);
  if (turn.outcome == CAROM_TURN_LOSE || rules->race == CAROM_RACE_ALONE)
    return 0.0;
  return carom_search_leave(plan, &game, plan->state, &turn);
}

/* Checks the arguments, and makes all of a plan but its candidates. */
static carom_status begin(search *plan, const carom_plan_job *job, bool in_hand) {
  carom_status status = check_job(job);
  if (status != CAROM_OK)
    return status;

  /* The memory is as long as good options ask; no plan is in it from here on. */
  plan->fingerprint = 0;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  take_job(plan, job);
  status = check_layout(plan, in_hand);
  if (status != CAROM_OK)
    return status;
  share_memory(plan);

  /* the layout as the player and the rules see it */
  carom_view_make(&plan->view, &plan->job, &plan->options);
  status = ask_rules(plan, in_hand);
  if (status != CAROM_OK)
    return status;
  plan->foul_value = foul_value_of(plan);
  plan->ended = false;
  plan->slice = INT64_MAX;
  return CAROM_OK;
}

carom_status carom_search_prepare(const carom_plan_job *job, bool in_hand, int choices,
                                  search **prepared) {
  search *plan = place(job);
  if (plan == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_search_make(plan, job, in_hand, choices);
  if (status == CAROM_OK && plan->options.unsure > 0.0)
    carom_search_tables(plan,
                        (carom_drawn_table *)((char *)plan->leaves + carom_leaves_memory(true)));
  *prepared = plan;
  return status;
}

carom_status carom_search_make(search *plan, const carom_plan_job *job, bool in_hand, int choices) {
  const carom_status status = begin(plan, job, in_hand);
  if (status != CAROM_OK)
    return status;
  plan->late = plan->joins = false;
  plan->places = plan->place = 0;
  plan->choices_most = (int)carom_min(choices, LISTED_MOST);
  plan->fresh_least = 30;
  plan->seconds = plan->options.seconds;
  return CAROM_OK;
}

/* A player who thinks of nothing but potting believes in later pots, and that a turn which ends
 * before is lost. There is nothing to pot in a break, and another goal comes first. */
static void think(search *plan) {
  /* the layout takes part in the draw, so that plans of one seed have the share in their mean */
  uint64_t layout = 1;
  for (int k = 0; k < plan->view.count; k++)
    layout = carom_fingerprint(layout, plan->state[k].r, sizeof plan->state[k].r);
  const double mind = carom_uniform(plan->options.seed, DRAW_MIND, layout, 0);
  const bool has_other_goal = plan->breaks || plan->only_safeties || carom_has_goal(&plan->job);
  if (has_other_goal || mind >= plan->player.only_pots)
    return;
  plan->options.chance_me = 0.9;
  plan->options.chance_opponent = 1.0;
  carom_view_make(&plan->view, &plan->job, &plan->options);
  plan->foul_value = foul_value_of(plan);
}

/* ---- What callers have */

void carom_search_with_crew(search *plan, carom_crew_caller *work) {
  const bool timed = plan->seconds > 0.0;
  plan->end = 0.0;
  if (timed)
    plan->end = carom_seconds() + plan->seconds;
  carom_with_crew(work, plan, plan->options.threads, (size_t)plan->room / ROWS_LEAST);
  if (timed)
    plan->seconds = fmax(plan->end - carom_seconds(), 1e-9);
}

static void plan_here(void *context, carom_crew *crew) {
  search *plan = context;
  plan->crew = crew;
  do {
    if (!carom_search_run(plan))
      return;
  } while (carom_search_double(plan));
  plan->ended = true;
}

/* First of all finds the places of a cue ball in hand. */
static void find_places(void *context, carom_crew *crew) {
  search *plan = context;
  plan->crew = crew;
  if (!carom_search_find_places(plan))
    return;
  plan->go = plan_here;
  carom_search_begin_doubling(plan, FIRST, carom_max(shots_of(&plan->options), IN_HAND_LEAST));
  plan_here(context, crew);
}

/* Strokes that the caller gave, each with its share of the shots. */
static void try_all(void *context, carom_crew *crew) {
  search *plan = context;
  plan->crew = crew;
  const int64_t each = shots_of(&plan->options) / carom_max(plan->tries, 1);
  for (int k = 0; k < plan->tries; k++) {
    const carom_cue *cue = &plan->cues[k];
    plan->count = 0;
    carom_search_add(plan, (candidate){.speed = cue->speed,
                                       .phi = cue->phi,
                                       .theta = cue->theta,
                                       .a = cue->a,
                                       .b = cue->b,
                                       .kind = CAROM_PLAN_GIVEN,
                                       .ball = -1,
                                       .pocket = -1});

    /* once without errors, which names the pot; then with errors, as the last round of a plan */
    if (!carom_is_stopped(plan)) {
      carom_search_stage(plan, 0, 1, 1, 0);
      carom_search_play(plan);
      carom_search_take(plan, 0, &plan->outcome[0]);
      carom_search_stage(plan, 0, 1, carom_max(each, 10), DRAW_ROUND);
      carom_search_play(plan);
      carom_search_add_up(plan);
    }
    plan->choices[k] = carom_search_choice(plan, &plan->found[0]);
  }
}

/* Plays a slice of a plan, or what is left of it; and gives what it found if that is the end. */
static carom_status play_slice(search *plan, carom_plan_stroke *choices, int room, int *found) {
  plan->slice = INT64_MAX;
  if (plan->options.slice > 0)
    plan->slice = plan->options.slice;
  if (!plan->ended)
    carom_search_with_crew(plan, plan->go);
  *found = 0;
  if (plan->ended)
    *found = carom_search_give(plan, choices, room);
  return CAROM_OK;
}

carom_status carom_plan(const carom_plan_job *job, carom_plan_stroke *choices, int room,
                        int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  search *plan;
  const carom_status status = carom_search_prepare(job, false, room, &plan);
  if (status != CAROM_OK)
    return status;
  plan->fingerprint = carom_fingerprint_of_job(job);
  think(plan);
  plan->go = plan_here;
  carom_search_begin_doubling(plan, FIRST, shots_of(&plan->options));
  return play_slice(plan, choices, room, found);
}

carom_status carom_plan_continue(const carom_plan_job *job, carom_plan_stroke *choices, int room,
                                 int *found) {
  if (choices == NULL || found == NULL || room < 1 || !is_whole(job))
    return CAROM_ERROR_NULL;
  search *plan = place(job);
  if (plan == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST ||
      plan->fingerprint != carom_fingerprint_of_job(job))
    return CAROM_ERROR_STATE;
  return play_slice(plan, choices, room, found);
}

carom_status carom_plan_hand(const carom_plan_job *job, const double low[2], const double high[2],
                             carom_plan_stroke *choices, int room, int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  search *plan;
  carom_status status = carom_search_prepare(job, true, room, &plan);
  if (status != CAROM_OK)
    return status;
  think(plan);
  memcpy(plan->hand, job->balls, (size_t)job->count * sizeof *plan->hand);
  if (!carom_search_find_place(plan, low, high))
    return CAROM_ERROR_OFF_TABLE;

  /* with the cue ball on a place the layout can be checked */
  plan->job.balls = plan->hand;
  carom_search_put(plan, plan->best_place[0].r);
  status = prepare(plan, plan->hand, true);
  if (status != CAROM_OK)
    return status;
  plan->fingerprint = carom_fingerprint_of_job(job);
  plan->go = find_places;
  return play_slice(plan, choices, room, found);
}

carom_status carom_plan_try(const carom_plan_job *job, const carom_cue *cues, int n,
                            carom_plan_stroke *choices) {
  enum { MOST = 1000 };
  if (choices == NULL || cues == NULL)
    return CAROM_ERROR_NULL;
  if (place(job) == NULL)
    return CAROM_ERROR_NULL;
  if (n < 0 || n > MOST)
    return CAROM_ERROR_OPTIONS;
  search *plan;
  carom_status status = carom_search_prepare(job, false, 1, &plan);
  for (int k = 0; k < n && status == CAROM_OK; k++)
    status = check_stroke(plan, &cues[k]);
  if (status != CAROM_OK)
    return status;
  plan->cues = cues;
  plan->choices = choices;
  plan->tries = n;
  carom_search_with_crew(plan, try_all);
  return CAROM_OK;
}

carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value) {
  search plan;
  if (value == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = begin(&plan, job, in_hand != 0);
  if (status != CAROM_OK)
    return status;
  *value = carom_value_of(&plan.view, &job->rules->state, plan.state, 0, in_hand != 0);
  if (job->rules->race == CAROM_RACE_ALONE && job->rules->value == NULL)
    *value = carom_search_share(&plan, *value);
  return CAROM_OK;
}

double carom_worth_left(const carom_plan_job *job, const carom_ruling *ruling) {
  carom_search plan; /* which plays no shot */
  if (carom_search_make(&plan, job, false, 1) != CAROM_OK)
    return 0.0;
  return carom_search_ruled(&plan, ruling);
}
