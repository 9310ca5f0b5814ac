/* Plans before their searches: arguments are checked, and the layout is read by the rules. */
#include "prepare.h"
#include "player.h"

#include "carom_coach.h"
#include "goals.h"
#include "plan_options.h"
#include "platform/ranges.h"
#include "rows.h"
#include "rules.h"
#include "schema/options.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;

static const carom_plan_options no_options = {0};
static const carom_shot_options no_shot = {0};
enum { SHOTS_USUAL = 2000, SHOTS_IN_TIME = 200000, SPARE = 400 };

carom_status carom_search_check_options(const carom_plan_options *o) {
  CAROM_PLAN_OPTIONS(CAROM_CHECK_OPTION)
  if (o->slice < 0 || !CAROM_RESERVED_IS_ZERO(o))
    return CAROM_ERROR_OPTIONS;
  return CAROM_OK;
}

int64_t carom_search_shots(const carom_plan_options *o) {
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

/* Rows of the largest stage; the rows of reasons belong to one candidate. */
static int64_t most_rows(int64_t shots, double scan) {
  return carom_max(shots + most_candidates(shots, scan), CAROM_WHY_STROKES);
}

const carom_plan_options *carom_search_options(const carom_plan_options *options) {
  if (options == NULL)
    return &no_options;
  return options;
}

double carom_scan_of(const carom_plan_options *o) {
  static const double usual = 0.5;
  if (o->scan == 0.0)
    return usual;
  return fmax(o->scan, 0.0);
}

size_t carom_leaves_memory(bool searches) {
  size_t bytes = PATH_ROWS * sizeof(carom_trail);
  if (searches)
    bytes = carom_search_memory(&(carom_plan_options){.shots = LEAVE_SHOTS, .scan = 0.9}, false);
  return sizeof(carom_leaves) + bytes;
}

size_t carom_search_memory(const carom_plan_options *options, bool searches_leaves) {
  const int64_t shots = carom_search_shots(options);
  const double scan = carom_scan_of(options);
  return sizeof(carom_search) + (size_t)most_candidates(shots, scan) * sizeof(candidate) +
         (size_t)most_rows(shots, scan) * sizeof(outcome) + carom_leaves_memory(searches_leaves);
}

/* Checks the cue of a plan with the stroke of another one. A speed of 0 is raised later by the
 * bounds of the player, so the rest of the cue counts. */
carom_status carom_search_check_stroke(const carom_search *search, const carom_cue *stroke) {
  carom_cue cue = *search->job.cue;
  cue.speed = stroke->speed;
  if (stroke->speed == 0.0)
    cue.speed = 1.0;
  cue.phi = stroke->phi;
  cue.theta = stroke->theta;
  cue.a = stroke->a;
  cue.b = stroke->b;
  return carom_check_strike(&search->layout, &cue);
}

/* Once for all shots of a plan; with_cue: and its cue, whose stroke is not looked at. */
carom_status carom_search_check(carom_search *search, const carom_shot_ball *balls, bool with_cue) {
  int where;
  const carom_status status =
      carom_prepare(search->job.table, balls, search->job.count, &search->shot, &search->features,
                    &search->layout, &where);
  if (status != CAROM_OK || !with_cue)
    return status;
  return carom_search_check_stroke(search, &(carom_cue){0});
}

bool carom_search_is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL;
}

bool carom_search_has_good_rules(const carom_plan_rules *rules) {
  if (rules->on == NULL || rules->judge == NULL || rules->left == NULL)
    return false;
  return (uint32_t)rules->breaks <= 2 && (uint32_t)rules->race <= CAROM_RACE_SEATS &&
         (rules->race != CAROM_RACE_SEATS || rules->value != NULL) &&
         carom_rack_size((carom_rack_kind)rules->rack) > 0 && rules->learned >= 0 &&
         (uint32_t)rules->own_cue_balls <= 1 && CAROM_RESERVED_IS_ZERO(rules);
}

/* Checks the job itself; the table and the balls are checked with the layout. */
static carom_status check_job(const carom_plan_job *job) {
  if (!carom_search_is_whole(job))
    return CAROM_ERROR_NULL;
  const carom_plan_options *options = carom_search_options(job->options);
  const bool good_players =
      carom_player_is_good(job->player) && carom_player_is_good(carom_opponent_of(job, options));
  if (carom_search_check_options(options) != CAROM_OK || !good_players ||
      !carom_search_has_good_rules(job->rules) || (uint64_t)job->leave > CAROM_LEAVE_BAULK ||
      !carom_goal_is_good(job) || !CAROM_RESERVED_IS_ZERO(job))
    return CAROM_ERROR_OPTIONS;
  return CAROM_OK;
}

/* Takes a job, its options and its player. Shots have the caller's options except the stopping
 * options, which the plan sets itself. */
static void take_job(carom_search *search, const carom_plan_job *job) {
  search->job = *job;
  search->options = *carom_search_options(job->options);
  search->player = carom_player_bounded(job->player, job->cue);
  if (search->options.shots == 0 && search->options.seconds == 0.0)
    search->options.shots = (int64_t)job->player->shots;
  search->shot = no_shot;
  if (job->shot != NULL)
    search->shot = *job->shot;
  search->shot.threads = 0;
  search->shot.stop_at = 0;
  search->shot.first_of = 0;
  search->shot.time_most = 0.0;
}

/* Checks the layout once for all shots of a plan. In hand the cue's ball may be down, and its
 * stroke is checked when it is placed. */
static carom_status check_layout(carom_search *search, bool in_hand) {
  const carom_plan_job *job = &search->job;
  const carom_status status = carom_search_check(search, job->balls, !in_hand);
  if (status != CAROM_OK)
    return status;
  if (job->cue->ball < 0 || job->cue->ball >= job->count)
    return CAROM_ERROR_CUE_BALL;
  int moves = -1;
  if (in_hand)
    moves = (int)job->cue->ball;
  if (!carom_is_at_rest(&search->layout, moves))
    return CAROM_ERROR_IN_MOTION;
  return CAROM_OK;
}

/* Candidates, outcomes and tables are behind the plan in the caller's memory. */
static void share_memory(carom_search *search) {
  const int64_t shots = carom_search_shots(&search->options);
  const double scan = carom_scan_of(&search->options);
  search->count = 0;
  search->most = most_candidates(shots, scan);
  search->room = most_rows(shots, scan);
  search->found = (candidate *)(search + 1);
  search->outcome = (outcome *)(search->found + search->most);
  search->leaves = (carom_leaves *)(search->outcome + search->room);
  search->path = (carom_trail *)(search->leaves + 1);
  search->drawn = NULL;
}

/* Whether the rack of a soft break is intact: each ball that is on touches two others. */
static bool is_packed(const carom_search *search) {
  enum { BALLS_LEAST = 10, NEIGHBOURS = 2 };
  static const double apart = 1e-3; /* m */
  for (int k = 0; k < search->view.count; k++) {
    int neighbours = 0;
    for (int n = 0; n < search->view.count && (search->targets >> k & 1); n++) {
      const double reach = search->view.radius[k] + search->view.radius[n] + apart;
      const bool touches = carom_square(search->state[k].r, search->state[n].r) < reach * reach;
      neighbours += n != k && (search->targets >> n & 1) && touches;
    }
    if ((search->targets >> k & 1) && neighbours < NEIGHBOURS)
      return false;
  }
  return carom_count_of(search->targets) >= BALLS_LEAST;
}

/* Reads the layout by the rules: which balls are in play, which of them may be met first, and what
 * the stroke may do. */
static carom_status ask_rules(carom_search *search, bool in_hand) {
  const carom_plan_rules *rules = search->job.rules;
  const uint32_t cue_ball = UINT32_C(1) << search->view.cue_ball;
  for (int k = 0; k < search->job.count; k++)
    search->state[k] = search->job.balls[k].state;

  /* the balls */
  search->in_play = carom_in_play(search->state, search->view.count);
  if (in_hand)
    search->in_play |= cue_ball;
  search->targets = rules->on(&rules->state, search->in_play) & search->in_play & ~cue_ball;
  if (search->targets == 0)
    return CAROM_ERROR_GAME_OVER;

  /* the stroke */
  search->breaks = rules->breaks && rules->state.opening == 1;
  if (rules->breaks == 2 && in_hand)
    search->breaks |= is_packed(search);
  search->only_safeties =
      carom_goal_has_safeties(&search->job, &search->options) && !search->breaks;
  search->permissions = (uint32_t)rules->state.may;
  if (search->only_safeties || carom_has_goal(&search->job))
    search->permissions &= ~(uint32_t)(CAROM_CHOICE_PASS | CAROM_CHOICE_PUSH);
  search->pockets = carom_pockets_of(rules, &rules->state);
  search->first_decides = rules->first_decides && !(search->permissions & CAROM_CHOICE_PUSH);
  carom_search_lay_out(search, search->job.balls);

  /* the balls that are left to the player, at least one */
  int32_t left[2];
  rules->left(&rules->state, search->in_play, left);
  search->left = (int32_t)carom_max(left[0], 1);
  return CAROM_OK;
}

/* The value of a foul at the first contact, which leaves about the layout that there is. */
double carom_search_foul_value(const carom_search *search) {
  const carom_plan_rules *rules = search->job.rules;
  carom_rules_state game = rules->state; /* rules change it as they judge */
  carom_turn turn = rules->judge(&game, search->in_play, search->view.cue_ball, &carom_no_facts,
                                 (carom_call){-1, -1});
  turn = carom_turn_seen(rules, &game, turn);
  if (turn.outcome == CAROM_TURN_LOSE || rules->race == CAROM_RACE_ALONE)
    return 0.0;
  return carom_search_leave(search, &game, search->state, &turn);
}

/* Checks the arguments, and makes all of a plan but its candidates. */
static carom_status begin(carom_search *search, const carom_plan_job *job, bool in_hand) {
  carom_status status = check_job(job);
  if (status != CAROM_OK)
    return status;

  /* The memory is as long as valid options require; no plan is in it from here on. */
  search->fingerprint = 0;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  take_job(search, job);
  status = check_layout(search, in_hand);
  if (status != CAROM_OK)
    return status;
  share_memory(search);

  /* the layout as the player and the rules see it */
  carom_view_make(&search->view, &search->job, &search->options);
  status = ask_rules(search, in_hand);
  if (status != CAROM_OK)
    return status;
  search->foul_value = carom_search_foul_value(search);
  search->ended = false;
  search->slice = INT64_MAX;
  return CAROM_OK;
}

carom_status carom_search_make(carom_search *search, const carom_plan_job *job, bool in_hand,
                               int choices) {
  const carom_status status = begin(search, job, in_hand);
  if (status != CAROM_OK)
    return status;
  search->late = search->joins = false;
  search->places = search->place = 0;
  search->choices_most = (int)carom_min(choices, LISTED_MOST);
  search->fresh_least = 30;
  search->seconds = search->options.seconds;
  return CAROM_OK;
}
