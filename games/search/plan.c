/* The best shot of a layout, by playing many.
 *
 * 1. Pots: every direct pot whose chance is above 3 %, with six speeds and five positions of the
 *    tip. The aim is solved by shots of two balls that stop at the contact: three fixed-point
 *    steps for throw, the squirt once for each tip.
 * 2. Scan: strokes in all directions. One that meets a ball first that is not on is stopped
 *    there. The others are candidates: banks, kicks, combinations, caroms, safeties, breaks.
 * 3. Each candidate is played once without errors. Its worth is 1 for a win, 0 for a loss, else
 *    the value of the layout that it leaves, to whoever plays next.
 * 4. Sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013): four rounds with equal
 *    fractions of the shots. In each, the candidates that are left are played with errors, the same
 *    errors for all; a quarter of them stays. In the third round strokes near the best one join,
 *    with another speed, tip or direction; where no pot is direct, after each round.
 * 5. The best is played again, with errors that were not used to choose, to estimate its chances.
 *
 * With ball in hand, candidates are made from several positions, and race together.
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
#include "listing.h"
#include "places.h"
#include "platform/fingerprint.h"
#include "prepare.h"
#include "random_draws.h"
#include "ranking.h"
#include "rows.h"
#include "rules.h"
#include "search.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef carom_candidate candidate;

/* FIRST: of the first round of doubling; IN_HAND_LEAST: of a plan whose positions race */
enum { IN_HAND_LEAST = 600, FIRST = 100 };

size_t carom_plan_memory(const carom_plan_options *options) {
  const carom_plan_options *o = carom_search_options(options);
  if (carom_search_check_options(o) != CAROM_OK)
    return 0;
  size_t bytes = carom_search_memory(o, true);
  if (o->unsure > 0.0)
    bytes += TABLES * sizeof(carom_drawn_table);
  return bytes;
}

/* Where a search is in the caller's memory; NULL where there is too little of it, or nothing to
 * plan. */
static carom_search *place(const carom_plan_job *job) {
  if (job == NULL || job->memory_size < carom_plan_memory(job->options))
    return NULL;
  return job->memory;
}

carom_status carom_search_prepare(const carom_plan_job *job, bool in_hand, int choices,
                                  carom_search **prepared) {
  carom_search *search = place(job);
  if (search == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_search_make(search, job, in_hand, choices);
  if (status == CAROM_OK && search->options.unsure > 0.0)
    carom_search_tables(search,
                        (carom_drawn_table *)((char *)search->leaves + carom_leaves_memory(true)));
  *prepared = search;
  return status;
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

/* A player who thinks of nothing but potting believes in later pots, and that a turn which ends
 * before is lost. There is nothing to pot in a break, and another goal has priority. */
static void think(carom_search *search) {
  /* the layout takes part in the draw, so that plans of one seed have the share in their mean */
  uint64_t layout = 1;
  for (int k = 0; k < search->view.count; k++)
    layout = carom_fingerprint(layout, search->state[k].r, sizeof search->state[k].r);
  const double mind = carom_uniform(search->options.seed, DRAW_MIND, layout, 0);
  const bool has_other_goal =
      search->breaks || search->only_safeties || carom_has_goal(&search->job);
  if (has_other_goal || mind >= search->player.only_pots)
    return;
  search->options.chance_me = 0.9;
  search->options.chance_opponent = 1.0;
  carom_view_make(&search->view, &search->job, &search->options);
  search->foul_value = carom_search_foul_value(search);
}

/* ---- What callers have */

void carom_search_with_crew(carom_search *search, carom_crew_caller *work) {
  const bool timed = search->seconds > 0.0;
  search->end = 0.0;
  if (timed)
    search->end = carom_seconds() + search->seconds;
  carom_with_crew(work, search, search->options.threads, (size_t)search->room / ROWS_LEAST);
  if (timed)
    search->seconds = fmax(search->end - carom_seconds(), 1e-9);
}

static void plan_here(void *context, carom_crew *crew) {
  carom_search *search = context;
  search->crew = crew;
  do {
    if (!carom_search_run(search))
      return;
  } while (carom_search_double(search));
  search->ended = true;
}

/* First of all finds the positions of a cue ball in hand. */
static void find_places(void *context, carom_crew *crew) {
  carom_search *search = context;
  search->crew = crew;
  if (!carom_search_find_places(search))
    return;
  search->go = plan_here;
  carom_search_begin_doubling(search, FIRST,
                              carom_max(carom_search_shots(&search->options), IN_HAND_LEAST));
  plan_here(context, crew);
}

/* Strokes that the caller gave, each with its fraction of the shots. */
static void try_all(void *context, carom_crew *crew) {
  carom_search *search = context;
  search->crew = crew;
  const int64_t each = carom_search_shots(&search->options) / carom_max(search->tries, 1);
  for (int k = 0; k < search->tries; k++) {
    const carom_cue *cue = &search->cues[k];
    search->count = 0;
    carom_search_add(search, (candidate){.speed = cue->speed,
                                         .phi = cue->phi,
                                         .theta = cue->theta,
                                         .a = cue->a,
                                         .b = cue->b,
                                         .kind = CAROM_PLAN_GIVEN,
                                         .ball = -1,
                                         .pocket = -1});

    /* once without errors, which names the pot; then with errors, as the last round of a plan */
    if (!carom_is_stopped(search)) {
      carom_search_stage(search, 0, 1, 1, 0);
      carom_search_play(search);
      carom_search_take(search, 0, &search->outcome[0]);
      carom_search_stage(search, 0, 1, carom_max(each, 10), DRAW_ROUND);
      carom_search_play(search);
      carom_search_add_up(search);
    }
    search->choices[k] = carom_search_choice(search, &search->found[0]);
  }
}

/* Plays a slice of a search, or what is left of it; and gives what it found if that is the end. */
static carom_status play_slice(carom_search *search, carom_plan_stroke *choices, int room,
                               int *found) {
  search->slice = INT64_MAX;
  if (search->options.slice > 0)
    search->slice = search->options.slice;
  if (!search->ended)
    carom_search_with_crew(search, search->go);
  *found = 0;
  if (search->ended)
    *found = carom_search_give(search, choices, room);
  return CAROM_OK;
}

carom_status carom_plan(const carom_plan_job *job, carom_plan_stroke *choices, int room,
                        int *found) {
  if (found != NULL)
    *found = 0;
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  carom_search *search;
  const carom_status status = carom_search_prepare(job, false, room, &search);
  if (status != CAROM_OK)
    return status;
  search->fingerprint = carom_fingerprint_of_job(job);
  think(search);
  search->go = plan_here;
  carom_search_begin_doubling(search, FIRST, carom_search_shots(&search->options));
  return play_slice(search, choices, room, found);
}

carom_status carom_plan_continue(const carom_plan_job *job, carom_plan_stroke *choices, int room,
                                 int *found) {
  if (found != NULL)
    *found = 0;
  if (choices == NULL || found == NULL || room < 1 || !carom_search_is_whole(job))
    return CAROM_ERROR_NULL;
  carom_search *search = place(job);
  if (search == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST ||
      search->fingerprint != carom_fingerprint_of_job(job))
    return CAROM_ERROR_STATE;
  return play_slice(search, choices, room, found);
}

carom_status carom_plan_hand(const carom_plan_job *job, const double low[2], const double high[2],
                             carom_plan_stroke *choices, int room, int *found) {
  if (found != NULL)
    *found = 0;
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  carom_search *search;
  carom_status status = carom_search_prepare(job, true, room, &search);
  if (status != CAROM_OK)
    return status;
  think(search);
  memcpy(search->hand, job->balls, (size_t)job->count * sizeof *search->hand);
  if (!carom_search_find_place(search, low, high))
    return CAROM_ERROR_OFF_TABLE;

  /* with the cue ball on a position the layout can be checked */
  search->job.balls = search->hand;
  carom_search_put(search, search->best_place[0].r);
  status = carom_search_check(search, search->hand, true);
  if (status != CAROM_OK)
    return status;
  search->fingerprint = carom_fingerprint_of_job(job);
  search->go = find_places;
  return play_slice(search, choices, room, found);
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
  carom_search *search;
  carom_status status = carom_search_prepare(job, false, 1, &search);
  for (int k = 0; k < n && status == CAROM_OK; k++)
    status = carom_search_check_stroke(search, &cues[k]);
  if (status != CAROM_OK)
    return status;
  search->cues = cues;
  search->choices = choices;
  search->tries = n;
  carom_search_with_crew(search, try_all);
  return CAROM_OK;
}

carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value) {
  carom_search search;
  if (value == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = carom_search_make(&search, job, in_hand != 0, 1);
  if (status != CAROM_OK)
    return status;
  *value = carom_value_of(&search.view, &job->rules->state, search.state, 0, in_hand != 0);
  if (job->rules->race == CAROM_RACE_ALONE && job->rules->value == NULL)
    *value = carom_search_share(&search, *value);
  return CAROM_OK;
}

double carom_worth_left(const carom_plan_job *job, const carom_ruling *ruling) {
  carom_search search; /* which plays no shot */
  if (carom_search_make(&search, job, false, 1) != CAROM_OK)
    return 0.0;
  return carom_search_ruled(&search, ruling);
}
