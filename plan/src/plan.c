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
 *
 * A shot is a row, whose errors are a function of seed, round and number. Rows are computed by
 * threads and added up in their order, so no bit of a sum depends on threads. The rows of a stage
 * are played at once or in slices, between which all of the plan is in the caller's memory. */
#include "anytime.h"
#include "candidates.h"
#include "choice_kind.h"
#include "drawn_tables.h"
#include "plan_options.h"
#include "platform/fingerprint.h"
#include "platform/ranges.h"
#include "ranking.h"
#include "rows.h"
#include "schema/options.h"
#include "search.h"
#include "table/spots.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;
typedef carom_search search;

enum { PLACES = 60 }; /* of a cue ball in hand, of which PLACES_PLANNED are planned from */

/* ---- Arguments */

static const carom_plan_options no_options = {0};
static const carom_shot_options no_shot = {0};
/* FIRST: of the first round of doubling */
enum { SHOTS_LEAST = 100, SHOTS_USUAL = 2000, SHOTS_IN_TIME = 200000, FIRST = 100, SPARE = 160 };
static const double player_most = 1000.0; /* of each number of a player */

static carom_status check_options(const carom_plan_options *o) {
  CAROM_PLAN_OPTIONS(CAROM_CHECK_OPTION)
  const bool good = o->slice >= 0 && o->unused == 0 && CAROM_RESERVED_IS_ZERO(o);
  return good ? CAROM_OK : CAROM_ERROR_OPTIONS;
}

static bool good_player(const carom_player *p) {
  const double numbers[] = {p->speed,    p->speed_share, p->phi,         p->theta,
                            p->a,        p->b,           p->speed_least, p->speed_most,
                            p->tip_most, p->growth,      p->only_pots};
  bool good = p->tip_most <= 1.0 && (p->speed_most == 0.0 || p->speed_most >= p->speed_least);
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    good &= numbers[k] >= 0.0 && numbers[k] <= player_most;
  const bool has_shots = p->shots >= SHOTS_LEAST && p->shots <= SHOTS_USUAL;
  return good && p->only_pots <= 1.0 && (p->shots == 0.0 || has_shots);
}

static int64_t shots_of(const carom_plan_options *o) {
  if (o->shots > 0)
    return o->shots;
  return o->seconds > 0.0 ? SHOTS_IN_TIME : SHOTS_USUAL;
}

/* A quarter of the shots are strokes of pots, each of which is played once without errors; then
 * those that the scan keeps, half as many again of the block that it tries, and room for the
 * least numbers of both. */
static int64_t most_candidates(int64_t shots, double scan) {
  return (int64_t)((1.0 - scan) * (double)shots / 4.0) + (int64_t)(1.5 * scan * (double)shots) +
         SPARE;
}

/* Rows of the largest stage. */
static int64_t most_rows(int64_t shots, double scan) {
  return shots + most_candidates(shots, scan);
}

static size_t bytes_of(int64_t shots, double scan, bool unsure) {
  const size_t rows = (size_t)most_rows(shots, scan);
  return sizeof(search) + (size_t)most_candidates(shots, scan) * sizeof(candidate) +
         rows * sizeof(outcome) + (unsure ? TABLES * sizeof(carom_drawn_table) : 0);
}

size_t carom_plan_memory(const carom_plan_options *options) {
  const carom_plan_options *o = options != NULL ? options : &no_options;
  if (check_options(o) != CAROM_OK)
    return 0;
  return bytes_of(shots_of(o), carom_scan_of(o), o->unsure > 0.0);
}

/* Where a plan is in the caller's memory; NULL where there is too little of it, or nothing to
 * plan. */
static search *place(const carom_plan_job *job) {
  const bool room =
      job != NULL && job->memory != NULL && job->memory_size >= carom_plan_memory(job->options);
  return room ? job->memory : NULL;
}

/* Checks the cue of a plan with the stroke of another one. A speed of 0 is raised later by the
 * bounds of the player, so the rest of the cue counts. */
static carom_status check_stroke(const search *plan, const carom_cue *stroke) {
  carom_cue cue = *plan->job.cue;
  cue.speed = stroke->speed == 0.0 ? 1.0 : stroke->speed;
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

static const carom_plan_options *options_of(const carom_plan_job *job) {
  return job->options != NULL ? job->options : &no_options;
}

static bool is_whole(const carom_plan_job *job) {
  return job != NULL && job->table != NULL && job->balls != NULL && job->cue != NULL &&
         job->player != NULL && job->rules != NULL;
}

/* Of a job and of all that it points to but its memory. */
static uint64_t fingerprint_of(const carom_plan_job *job) {
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
  return h;
}

/* Whether rules have their functions, and numbers that this version knows. */
static bool good_rules(const carom_plan_rules *rules) {
  if (rules->on == NULL || rules->judge == NULL || rules->left == NULL)
    return false;
  return (uint32_t)rules->breaks <= 2 && (uint32_t)rules->race <= CAROM_RACE_POINTS &&
         (uint32_t)rules->rack <= CAROM_RACK_THREECUSHION && rules->learned >= 0 &&
         CAROM_RESERVED_IS_ZERO(rules);
}

/* Checks what a job says of itself; the table and the balls are checked with the layout. */
static carom_status check_job(const carom_plan_job *job) {
  if (!is_whole(job))
    return CAROM_ERROR_NULL;
  const carom_plan_options *options = options_of(job);
  const bool good_players =
      good_player(job->player) && (options->opponent == NULL || good_player(options->opponent));
  const bool good = check_options(options) == CAROM_OK && good_players && good_rules(job->rules) &&
                    CAROM_RESERVED_IS_ZERO(job);
  return good ? CAROM_OK : CAROM_ERROR_OPTIONS;
}

/* Takes a job, its options and its player. Shots have the caller's options but for when to stop,
 * which the plan says itself. */
static void take_job(search *plan, const carom_plan_job *job) {
  plan->job = *job;
  plan->options = *options_of(job);
  plan->player = carom_player_bounded(job->player, job->cue);
  if (plan->options.shots == 0 && plan->options.seconds == 0.0)
    plan->options.shots = (int64_t)job->player->shots;
  plan->shot = job->shot != NULL ? *job->shot : no_shot;
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
  const bool at_rest = carom_is_at_rest(&plan->layout, in_hand ? (int)job->cue->ball : -1);
  return at_rest ? CAROM_OK : CAROM_ERROR_IN_MOTION;
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
  plan->drawn = NULL;
}

/* Reads the layout by the rules: which balls are in play, which of them may be met first, and what
 * the stroke may do. */
static carom_status ask_rules(search *plan, bool in_hand) {
  const carom_plan_rules *rules = plan->job.rules;
  const uint32_t cue_ball = UINT32_C(1) << plan->view.cue_ball;
  for (int k = 0; k < plan->job.count; k++)
    plan->state[k] = plan->job.balls[k].state;

  /* the balls */
  plan->in_play = carom_in_play(plan->state, plan->view.count) | (in_hand ? cue_ball : 0);
  plan->targets = rules->on(&rules->state, plan->in_play) & plan->in_play & ~cue_ball;
  if (plan->targets == 0)
    return CAROM_ERROR_GAME_OVER;

  /* the stroke */
  plan->breaks = rules->breaks && rules->state.opening == 1;
  plan->permissions = (uint32_t)rules->state.may;
  plan->pockets = carom_pockets_of(rules, &rules->state);
  plan->first_decides = rules->first_decides && !(plan->permissions & CAROM_MAY_PUSH);
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
  const carom_turn turn = rules->judge(&game, plan->in_play, plan->view.cue_ball, &carom_no_facts,
                                       (carom_call){-1, -1});
  if (turn.is == CAROM_TURN_LOSE || rules->race == CAROM_RACE_ALONE)
    return 0.0;
  const bool in_hand = turn.leave >= CAROM_LEAVE_HAND;
  if (turn.is == CAROM_TURN_KEEP)
    return carom_value_of(&plan->view, &game, plan->state, 0, in_hand);
  return carom_search_foul(1.0 - carom_value_of(&plan->view, &game, plan->state, 1, in_hand));
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

/* Prepares a job once for all that is played of it: its plan, in the job's memory, from which shots
 * can be played. */
static carom_status prepare_job(const carom_plan_job *job, bool in_hand, search **prepared) {
  search *plan = place(job);
  if (plan == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = begin(plan, job, in_hand);
  if (status != CAROM_OK)
    return status;
  plan->late = plan->joins = false;
  plan->seconds = plan->options.seconds;
  if (plan->options.unsure > 0.0)
    carom_search_tables(plan, (carom_drawn_table *)(plan->outcome + plan->room));
  *prepared = plan;
  return CAROM_OK;
}

/* A player who thinks of nothing but potting believes in later pots, and that a turn which ends
 * before is lost. */
static void think(search *plan) {
  if (!carom_player_only_pots(&plan->player, plan->options.seed))
    return;
  plan->options.chance_me = 0.9;
  plan->options.chance_opponent = 1.0;
  carom_view_make(&plan->view, &plan->job, &plan->options);
  plan->foul_value = foul_value_of(plan);
}

/* ---- What callers have */

/* Does a part of a plan, `work`, with the threads that the options ask for. */
static void with_crew(search *plan, carom_crew_caller *work) {
  plan->end = plan->seconds > 0.0 ? carom_seconds() + plan->seconds : 0.0;
  carom_with_crew(work, plan, plan->options.threads, (size_t)plan->room / ROWS_LEAST);
  plan->seconds = plan->end > 0.0 ? fmax(plan->end - carom_seconds(), 1e-9) : 0.0;
}

static void plan_here(void *context, carom_crew *crew) {
  search *plan = context;
  plan->crew = crew;
  do {
    if (!carom_search_run(plan))
      return;
  } while (carom_search_double(plan));
  if (plan->permissions & CAROM_MAY_PASS)
    carom_search_pass(plan);
  plan->ended = true;
}

/* Puts the cue ball in hand on the place k of those that are planned from. */
static void put(search *plan, int k) {
  const double *r = plan->best_place[k].r;
  carom_place_ball(plan->job.table, plan->hand, (int)plan->job.count, plan->view.cue_ball, r[0],
                   r[1], NULL);
  carom_search_lay_out(plan, plan->hand);
}

/* The shots of the plan from each place. */
static int64_t small_of(const search *plan) {
  return carom_max(shots_of(&plan->options) / (2 * PLACES_PLANNED), 100);
}

/* A small plan from each place, then one with half of the shots from the best. Where that is
 * stopped before it has told more, the best so far is that of the small plans. */
static void plan_places(void *context, carom_crew *crew) {
  search *plan = context;
  plan->crew = crew;
  const int64_t small = small_of(plan), rest = shots_of(&plan->options) - plan->places * small;
  while (plan->place < plan->places) {
    if (!carom_search_run(plan))
      return;
    const candidate *c = &plan->found[0], *best = &plan->best;
    /* a plan that was stopped before the rounds of the best one tells less */
    const bool stopped = plan->place > 0 && c->round < best->round && carom_is_stopped(plan);
    if (plan->place == 0 ||
        (!stopped && c->sum / (double)c->seen > best->sum / (double)best->seen)) {
      plan->best = *c;
      plan->chosen = plan->place;
    }

    /* the next place; behind the last one the shots that are left, from the best */
    const bool stops = carom_is_stopped(plan);
    plan->place = stops ? plan->places : plan->place + 1;
    const bool is_last = plan->place == plan->places;
    put(plan, is_last ? plan->chosen : plan->place);
    plan->count = 0;
    if (!is_last)
      carom_search_begin(plan, small);
    else if (!stops)
      carom_search_begin_doubling(plan, 2 * small, carom_max(rest, small));
    plan->joins = is_last && carom_search_doubles(plan);
  }
  do {
    if (!carom_search_run(plan))
      return;
  } while (carom_search_double(plan));
  plan->ended = true;
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

/* The shots of the best choice chose it, so they were lucky for it. What the layout was worth
 * before is not, where games have taught it: it counts as so many shots. The games of
 * understanding/plan.md tell how many. */
static void temper(const search *plan, const candidate *best, carom_choice *c) {
  static const double shots = 10.0;
  const bool stroke = c->kind == CAROM_PLAN_POT || c->kind == CAROM_PLAN_SCAN;
  if (!stroke || plan->breaks || !carom_is_learned(&plan->view) ||
      plan->job.rules->race == CAROM_RACE_ALONE)
    return;
  double x[NEXT_NUMBERS];
  carom_plan_features(&plan->view, plan->state, plan->in_play, plan->targets, plan->pockets, 0,
                      false, NULL, x);
  const double value = carom_value_of(&plan->view, &plan->job.rules->state, plan->state, 0, false);
  const double n = (double)best->seen, all = n + shots;
  c->value = (best->sum + shots * value) / all;
  c->keep = (n * c->keep + shots * carom_chance_next(&plan->view, x)) / all;
  c->error *= n / all;
}

/* Whether a further candidate is a choice behind the best. One that was not played tells nothing;
 * one without a ball is none to a player who is alone; and one that looks better than the best was
 * played too seldom. */
static bool is_choice(const search *plan, const candidate *from, const carom_choice *choice) {
  const candidate *best = &plan->found[0];
  const bool alone = plan->job.rules->race == CAROM_RACE_ALONE && !plan->breaks;
  if (choice->seen == 0 && choice->kind != CAROM_PLAN_PASS)
    return false;
  if (choice->ball < 0 && alone)
    return false;
  const double mean = from->sum / (double)from->seen;
  const double best_mean = best->sum / (double)best->seen;
  return !(mean > best_mean && from->round < best->round);
}

/* Whether n choices hold one of the same ball, pocket and kind. */
static bool has_same(const carom_choice *choices, int n, const carom_choice *choice) {
  for (int k = 0; k < n; k++)
    if (choices[k].ball == choice->ball && choices[k].pocket == choice->pocket &&
        choices[k].kind == choice->kind)
      return true;
  return false;
}

/* Sorts a choice in behind n choices, the best first; of two of one value the earlier is first. */
static void sort_in(carom_choice *choices, int n, const carom_choice *choice) {
  int at = n;
  for (; at > 0 && choices[at - 1].value < choice->value; at--)
    choices[at] = choices[at - 1];
  choices[at] = *choice;
}

/* The best choice of each ball, pocket and kind, the best first. A plan that was stopped has not
 * sorted what it found: the first is the best. */
static int give(search *plan, carom_choice *choices, int room) {
  const int most = carom_is_stopped(plan) ? 1 : room;
  int n = 0;
  for (int64_t k = 0; n < most && k < plan->count; k++) {
    const candidate *from = &plan->found[k];
    carom_choice choice = carom_search_choice(plan, from);
    if (n > 0 && !is_choice(plan, from, &choice))
      continue;

    /* the best counts with what the layout was worth; no other is worth more */
    if (n == 0)
      temper(plan, from, &choice);
    else
      choice.value = fmin(choice.value, choices[0].value);
    choice.kind = carom_search_kind(plan, from, &choice);
    if (!has_same(choices, n, &choice))
      sort_in(choices, n++, &choice);
  }
  return n;
}

/* Plays a slice of a plan, or what is left of it; and gives what it found if that is the end. */
static carom_status play_slice(search *plan, carom_choice *choices, int room, int *found) {
  plan->slice = plan->options.slice > 0 ? plan->options.slice : INT64_MAX;
  if (!plan->ended)
    with_crew(plan, plan->go);
  *found = plan->ended ? give(plan, choices, room) : 0;
  return CAROM_OK;
}

carom_status carom_plan(const carom_plan_job *job, carom_choice *choices, int room, int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  search *plan;
  const carom_status status = prepare_job(job, false, &plan);
  if (status != CAROM_OK)
    return status;
  plan->fingerprint = fingerprint_of(job);
  think(plan);
  plan->go = plan_here;
  carom_search_begin_doubling(plan, FIRST, shots_of(&plan->options));
  return play_slice(plan, choices, room, found);
}

carom_status carom_plan_continue(const carom_plan_job *job, carom_choice *choices, int room,
                                 int *found) {
  if (choices == NULL || found == NULL || room < 1 || !is_whole(job))
    return CAROM_ERROR_NULL;
  search *plan = place(job);
  if (plan == NULL)
    return CAROM_ERROR_NULL;
  const bool same =
      job->count >= 2 && job->count <= CAROM_BALLS_MOST && plan->fingerprint == fingerprint_of(job);
  return same ? play_slice(plan, choices, room, found) : CAROM_ERROR_STATE;
}

/* Where a cue ball in hand may be put: the rectangle within the cushions that the caller and the
 * rules allow. */
typedef struct hand_range {
  double low[2], high[2];
} hand_range;

/* The range of places; low and high are the caller's bounds, or NULL. False where there is no
 * place: the range is empty, or has NaN. */
static bool range_of(const search *plan, const double low[2], const double high[2],
                     hand_range *range) {
  const double R = plan->view.radius[plan->view.cue_ball];
  const double size[2] = {plan->view.width, plan->view.length};
  for (int x = 0; x < 2; x++) {
    range->low[x] = R;
    range->high[x] = size[x] - R;
    if (low != NULL && !(low[x] <= R))
      range->low[x] = low[x];
    if (high != NULL && !(high[x] >= size[x] - R))
      range->high[x] = high[x];
  }

  /* in snooker the box around the D */
  if (plan->job.rules->rack == CAROM_RACK_SNOOKER) {
    const carom_d d = carom_d_of(size[0], size[1]);
    const double d_low[2] = {d.x - d.radius, d.y - d.radius}, d_high[2] = {d.x + d.radius, d.y};
    for (int x = 0; x < 2; x++) {
      range->low[x] = fmax(range->low[x], d_low[x]);
      range->high[x] = fmin(range->high[x], d_high[x]);
    }
  }
  return range->low[0] <= range->high[0] && range->low[1] <= range->high[1];
}

/* The place number k at random in the range. */
static void draw_place(const search *plan, const hand_range *range, uint64_t k, double r[2]) {
  for (int x = 0; x < 2; x++) {
    const double share = carom_uniform(plan->options.seed, DRAW_PLACES, k, (uint32_t)x);
    r[x] = range->low[x] + (range->high[x] - range->low[x]) * share;
  }
}

/* The place number k of a break: one of six across, where the range ends, or at the head line, from
 * which a game is opened, if the caller has no upper bound. */
static void break_place(const search *plan, const hand_range *range, bool bounded, uint64_t k,
                        double r[2]) {
  static const double across[PLACES_PLANNED] = {0.5, 0.3, 0.7, 0.15, 0.85, 0.0};
  const double head = 0.25 * plan->view.length;
  r[0] = range->low[0] + (range->high[0] - range->low[0]) * across[k % PLACES_PLANNED];
  r[1] = range->high[1];
  if (!bounded && r[1] > head)
    r[1] = head;
}

/* Puts the cue ball in hand on a place. False where rules or balls do not allow it. */
static bool place_in_hand(search *plan, const double r[2]) {
  const carom_plan_job *job = &plan->job;
  if (job->rules->rack == CAROM_RACK_SNOOKER && !carom_is_in_d(job->table, r[0], r[1]))
    return false;
  return carom_place_ball(job->table, plan->hand, (int)job->count, plan->view.cue_ball, r[0], r[1],
                          NULL) == CAROM_OK;
}

/* Sorts the place on which the cue ball is in among the best, by the value of the layout. */
static void keep_place(search *plan, const double r[2]) {
  const int cue_ball = plan->view.cue_ball;
  plan->state[cue_ball] = plan->hand[cue_ball].state;
  const double value = carom_value_of(&plan->view, &plan->job.rules->state, plan->state, 0, false);
  int at = plan->places < PLACES_PLANNED ? plan->places++ : PLACES_PLANNED;
  for (; at > 0 && plan->best_place[at - 1].value < value; at--)
    plan->best_place[at] = plan->best_place[at - 1];
  plan->best_place[at] = (carom_place_in_hand){{r[0], r[1]}, value};
}

/* Finds the places that are planned from: of places at random the best by the value of the layout;
 * for a break all of those on the upper edge. False where there is none. */
static bool find_places(search *plan, const double low[2], const double high[2]) {
  hand_range range;
  plan->places = 0;
  if (!range_of(plan, low, high, &range))
    return false;
  const uint64_t draws = plan->breaks ? PLACES_PLANNED : 50 * PLACES;
  int tried = 0;
  for (uint64_t k = 0; k < draws && tried < PLACES; k++) {
    double r[2];
    if (plan->breaks)
      break_place(plan, &range, high != NULL, k, r);
    else
      draw_place(plan, &range, k, r);
    if (!place_in_hand(plan, r))
      continue;
    tried++;
    keep_place(plan, r);
  }
  return plan->places > 0;
}

carom_status carom_plan_hand(const carom_plan_job *job, const double low[2], const double high[2],
                             carom_choice *choices, int room, int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  search *plan;
  carom_status status = prepare_job(job, true, &plan);
  if (status != CAROM_OK)
    return status;
  think(plan);
  memcpy(plan->hand, job->balls, (size_t)job->count * sizeof *plan->hand);
  if (!find_places(plan, low, high))
    return CAROM_ERROR_OFF_TABLE;

  /* with the cue ball on the best place the layout can be checked */
  plan->job.balls = plan->hand;
  put(plan, 0);
  status = prepare(plan, plan->hand, true);
  if (status != CAROM_OK)
    return status;

  /* the first of the small plans */
  plan->fingerprint = fingerprint_of(job);
  plan->go = plan_places;
  plan->place = 0;
  carom_search_begin(plan, small_of(plan));
  return play_slice(plan, choices, room, found);
}

carom_status carom_plan_try(const carom_plan_job *job, const carom_cue *cues, int n,
                            carom_choice *choices) {
  enum { MOST = 1000 };
  if (choices == NULL || cues == NULL)
    return CAROM_ERROR_NULL;
  if (place(job) == NULL)
    return CAROM_ERROR_NULL;
  if (n < 0 || n > MOST)
    return CAROM_ERROR_OPTIONS;
  search *plan;
  carom_status status = prepare_job(job, false, &plan);
  for (int k = 0; k < n && status == CAROM_OK; k++)
    status = check_stroke(plan, &cues[k]);
  if (status != CAROM_OK)
    return status;
  plan->cues = cues;
  plan->choices = choices;
  plan->tries = n;
  with_crew(plan, try_all);
  return CAROM_OK;
}

carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value) {
  if (value == NULL)
    return CAROM_ERROR_NULL;
  search plan;
  const carom_status status = begin(&plan, job, in_hand != 0);
  if (status != CAROM_OK)
    return status;
  const double found = carom_value_of(&plan.view, &job->rules->state, plan.state, 0, in_hand != 0);
  const bool is_share = job->rules->race == CAROM_RACE_ALONE && job->rules->value == NULL;
  *value = is_share ? carom_search_share(&plan, found) : found;
  return CAROM_OK;
}
