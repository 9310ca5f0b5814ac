/* Places of a cue ball in hand. They and strokes are candidates of one race. */
#include "places.h"
#include "draws.h"

#include "platform/elementary.h"
#include "rows.h"

#include <math.h>

typedef carom_search search;

enum { PLACES = 120 }; /* that are tried */

/* Where the cue ball may be: within the bounds of its leave, and those of the caller, low and high,
 * or NULL. False where there is no place: the range is empty, or has NaN. */
static bool find_range(search *plan, const double low[2], const double high[2]) {
  const carom_plan_job *job = &plan->job;
  const double R = plan->view.radius[plan->view.cue_ball];
  carom_leave leave = (carom_leave)job->leave;
  if (carom_has_d(job->rules))
    leave = CAROM_LEAVE_D;
  carom_bounds *range = &plan->range;
  if (carom_hand_bounds(leave, job->table, R, range) != CAROM_OK)
    return false;
  for (int x = 0; x < 2; x++) {
    if (low != NULL && !(low[x] <= range->low[x]))
      range->low[x] = low[x];
    if (high != NULL && !(high[x] >= range->high[x]))
      range->high[x] = high[x];
  }
  /* a game is opened from the head line, if the caller has no upper bound */
  if (plan->breaks && high == NULL)
    range->high[1] = fmin(range->high[1], 0.25 * plan->view.length);
  return range->low[0] <= range->high[0] && range->low[1] <= range->high[1];
}

/* The place number k from which a ball that is on could be potted: 0.12 to 0.72 m from the ball,
 * and a cut of at most 50 degrees. Ball, pocket, cut and distance are drawn. False: the ball does
 * not get into that pocket. */
static bool draw_place_of_pot(const search *plan, uint64_t k, double r[2]) {
  static const double cut_most = 50.0 * degree, nearest = 0.12, farther = 0.6; /* rad, m */
  double u[4];
  for (uint32_t n = 0; n < 4; n++)
    u[n] = carom_uniform(plan->options.seed, DRAW_PLACES, k, n);
  /* the ball and the pocket */
  int targets[CAROM_BALLS_MOST], count = 0;
  for (int n = 0; n < plan->view.count; n++)
    if (plan->targets >> n & 1)
      targets[count++] = n;
  if (count == 0 || plan->view.pockets == 0)
    return false;
  const int ball = targets[(int)(count * u[0])], pocket = (int)(plan->view.pockets * u[1]);
  const carom_window *window = &plan->view.window[ball][pocket];
  if (!(window->half > 0.0))
    return false;

  /* the place */
  double sine, cosine;
  carom_sincos(window->psi + (2.0 * u[2] - 1.0) * cut_most, &sine, &cosine);
  const double far = nearest + farther * u[3];
  r[0] = plan->view.place[ball][0] - far * cosine;
  r[1] = plan->view.place[ball][1] - far * sine;
  return true;
}

/* The place number k at random in the range. Every second one is a place of a pot, because few
 * places of the whole table are good ones: of 120 layouts of nine-ball, errors of 2 and plans of
 * 2,000 shots, the chosen strokes were worth 0.012 +- 0.007 more than with 60 places of the table,
 * and with other draws, of 98 of these layouts, 0.029 +- 0.008. */
static void draw_place(const search *plan, uint64_t k, double r[2]) {
  if (k % 2 == 1 && draw_place_of_pot(plan, k, r))
    return;
  const carom_bounds *range = &plan->range;
  for (int x = 0; x < 2; x++) {
    const double share = carom_uniform(plan->options.seed, DRAW_PLACES, k, (uint32_t)x);
    r[x] = range->low[x] + (range->high[x] - range->low[x]) * share;
  }
}

enum { BREAK_PLACES = 6 };
/* The place number k of a break: one of six across, where the range ends. */
static void break_place(const search *plan, uint64_t k, double r[2]) {
  static const double across[BREAK_PLACES] = {0.5, 0.3, 0.7, 0.15, 0.85, 0.0};
  const carom_bounds *range = &plan->range;
  r[0] = range->low[0] + (range->high[0] - range->low[0]) * across[k % BREAK_PLACES];
  r[1] = range->high[1];
}

/* Puts the cue ball in hand on a place. */
static bool place_in_hand(search *plan, const double r[2]) {
  const carom_plan_job *job = &plan->job;
  return carom_is_within(&plan->range, r[0], r[1]) &&
         carom_place_ball(job->table, plan->hand, (int)job->count, plan->view.cue_ball, r[0], r[1],
                          NULL) == CAROM_OK;
}

/* Sorts the place on which the cue ball is in among the best, by the value of the layout. */
static void keep_place(search *plan, const double r[2]) {
  const int cue_ball = plan->view.cue_ball;
  plan->state[cue_ball] = plan->hand[cue_ball].state;
  const double value = carom_value_of(&plan->view, &plan->job.rules->state, plan->state, 0, false);
  int index = PLACES_MOST;
  if (plan->places < PLACES_MOST)
    index = plan->places++;
  for (; index > 0 && plan->best_place[index - 1].value < value; index--)
    plan->best_place[index] = plan->best_place[index - 1];
  plan->best_place[index] = (carom_place_in_hand){{r[0], r[1]}, value};
}

/* Tries the next place. False: there is none. */
static bool try_place(search *plan) {
  enum { COST = 30 }; /* events of a shot that take as long as a value */
  const uint64_t draws = plan->breaks ? BREAK_PLACES : 50 * PLACES;
  if (plan->drawn_places == draws || plan->tried_places == PLACES)
    return false;
  double r[2];
  if (plan->breaks)
    break_place(plan, plan->drawn_places, r);
  else
    draw_place(plan, plan->drawn_places, r);
  plan->drawn_places++;
  if (place_in_hand(plan, r)) {
    plan->tried_places++;
    keep_place(plan, r);
    carom_search_spend(plan, COST);
  }
  return true;
}

bool carom_search_find_place(search *plan, const double low[2], const double high[2]) {
  plan->places = plan->tried_places = 0;
  plan->drawn_places = 0;
  if (!find_range(plan, low, high))
    return false;
  while (plan->places == 0 && try_place(plan))
    continue;
  return plan->places > 0;
}

bool carom_search_find_places(search *plan) {
  while (!carom_is_stopped(plan) && try_place(plan))
    if (plan->slice == 0)
      return false;
  return true;
}

bool carom_search_put(search *plan, const double r[2]) {
  if (plan->places == 0)
    return true;
  const bool good = place_in_hand(plan, r);
  if (good)
    carom_search_lay_out(plan, plan->hand);
  return good;
}

void carom_search_next_place(search *plan) {
  if (plan->places == 0)
    return;
  plan->place = (plan->place + 1) % plan->raced;
  carom_search_put(plan, plan->best_place[plan->place].r);
}
