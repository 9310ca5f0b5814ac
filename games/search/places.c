/* Positions of a cue ball in hand. They and strokes are candidates of one race. */
#include "places.h"
#include "random_draws.h"

#include "platform/elementary.h"
#include "rows.h"

#include <math.h>

enum { PLACES = 120 }; /* that are tried */

/* Where the cue ball may be: within the bounds of its leave, and the caller's bounds, low and high,
 * or NULL. False if there is no position: the range is empty, or contains NaN. */
static bool find_range(carom_search *search, const double low[2], const double high[2]) {
  const carom_plan_job *job = &search->job;
  const double R = search->view.radius[search->view.cue_ball];
  carom_leave leave = (carom_leave)job->leave;
  if (carom_has_d(job->rules))
    leave = CAROM_LEAVE_D;
  carom_bounds *range = &search->range;
  if (carom_hand_bounds(leave, job->table, R, range) != CAROM_OK)
    return false;
  for (int x = 0; x < 2; x++) {
    if (low != NULL && !(low[x] <= range->low[x]))
      range->low[x] = low[x];
    if (high != NULL && !(high[x] >= range->high[x]))
      range->high[x] = high[x];
  }
  /* a game is opened from the head line, if the caller has no upper bound */
  if (search->breaks && high == NULL)
    range->high[1] = fmin(range->high[1], 0.25 * search->view.length);
  return range->low[0] <= range->high[0] && range->low[1] <= range->high[1];
}

/* The position number k from which a ball that is on could be potted: 0.12 to 0.72 m from the ball,
 * and a cut of at most 50 degrees. Ball, pocket, cut and distance are drawn. False: the ball does
 * not get into that pocket. */
static bool draw_place_of_pot(const carom_search *search, uint64_t k, double r[2]) {
  static const double cut_most = 50.0 * degree, nearest = 0.12, farther = 0.6; /* rad, m */
  double u[4];
  for (uint32_t n = 0; n < 4; n++)
    u[n] = carom_uniform(search->options.seed, DRAW_PLACES, k, n);
  /* the ball and the pocket */
  int targets[CAROM_BALLS_MOST], count = 0;
  for (int n = 0; n < search->view.count; n++)
    if (search->targets >> n & 1)
      targets[count++] = n;
  if (count == 0 || search->view.pockets == 0)
    return false;
  const int ball = targets[(int)(count * u[0])], pocket = (int)(search->view.pockets * u[1]);
  const carom_window *window = &search->view.window[ball][pocket];
  if (!(window->half > 0.0))
    return false;

  /* the position */
  double sine, cosine;
  carom_sincos(window->psi + (2.0 * u[2] - 1.0) * cut_most, &sine, &cosine);
  const double far = nearest + farther * u[3];
  r[0] = search->view.place[ball][0] - far * cosine;
  r[1] = search->view.place[ball][1] - far * sine;
  return true;
}

/* The position number k at random in the range. Every second one is a position of a pot, because
 * few positions of the complete table are good ones: of 120 layouts of nine-ball, errors of 2 and
 * plans of 2,000 shots, the chosen strokes were worth 0.012 +- 0.007 more than with 60 positions of
 * the table, and with other draws, of 98 of these layouts, 0.029 +- 0.008. */
static void draw_place(const carom_search *search, uint64_t k, double r[2]) {
  if (k % 2 == 1 && draw_place_of_pot(search, k, r))
    return;
  const carom_bounds *range = &search->range;
  for (int x = 0; x < 2; x++) {
    const double share = carom_uniform(search->options.seed, DRAW_PLACES, k, (uint32_t)x);
    r[x] = range->low[x] + (range->high[x] - range->low[x]) * share;
  }
}

enum { BREAK_PLACES = 6 };
/* The position number k of a break: one of six across, where the range ends. */
static void break_place(const carom_search *search, uint64_t k, double r[2]) {
  static const double across[BREAK_PLACES] = {0.5, 0.3, 0.7, 0.15, 0.85, 0.0};
  const carom_bounds *range = &search->range;
  r[0] = range->low[0] + (range->high[0] - range->low[0]) * across[k % BREAK_PLACES];
  r[1] = range->high[1];
}

/* Puts the cue ball in hand on a position. */
static bool place_in_hand(carom_search *search, const double r[2]) {
  const carom_plan_job *job = &search->job;
  return carom_is_within(&search->range, r[0], r[1]) &&
         carom_place_ball(job->table, search->hand, (int)job->count, search->view.cue_ball, r[0],
                          r[1], NULL) == CAROM_OK;
}

/* Sorts the position on which the cue ball is in among the best, by the value of the layout. */
static void keep_place(carom_search *search, const double r[2]) {
  const int cue_ball = search->view.cue_ball;
  search->state[cue_ball] = search->hand[cue_ball].state;
  const double value =
      carom_value_of(&search->view, &search->job.rules->state, search->state, 0, false);
  int index = PLACES_MOST;
  if (search->places < PLACES_MOST)
    index = search->places++;
  for (; index > 0 && search->best_place[index - 1].value < value; index--)
    search->best_place[index] = search->best_place[index - 1];
  search->best_place[index] = (carom_place_in_hand){{r[0], r[1]}, value};
}

/* Tries the next position. False: there is none. */
static bool try_place(carom_search *search) {
  enum { COST = 30 }; /* events of a shot that take as long as a value */
  const uint64_t draws = search->breaks ? BREAK_PLACES : 50 * PLACES;
  if (search->drawn_places == draws || search->tried_places == PLACES)
    return false;
  double r[2];
  if (search->breaks)
    break_place(search, search->drawn_places, r);
  else
    draw_place(search, search->drawn_places, r);
  search->drawn_places++;
  if (place_in_hand(search, r)) {
    search->tried_places++;
    keep_place(search, r);
    carom_search_spend(search, COST);
  }
  return true;
}

bool carom_search_find_place(carom_search *search, const double low[2], const double high[2]) {
  search->places = search->tried_places = 0;
  search->drawn_places = 0;
  if (!find_range(search, low, high))
    return false;
  while (search->places == 0 && try_place(search))
    continue;
  return search->places > 0;
}

bool carom_search_find_places(carom_search *search) {
  while (!carom_is_stopped(search) && try_place(search))
    if (search->slice == 0)
      return false;
  return true;
}

bool carom_search_put(carom_search *search, const double r[2]) {
  if (search->places == 0)
    return true;
  const bool good = place_in_hand(search, r);
  if (good)
    carom_search_lay_out(search, search->hand);
  return good;
}

void carom_search_next_place(carom_search *search) {
  if (search->places == 0)
    return;
  search->place = (search->place + 1) % search->raced;
  carom_search_put(search, search->best_place[search->place].r);
}
