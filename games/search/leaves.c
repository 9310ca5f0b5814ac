/* Leaves that are searched. After a push-out the opponent plays from the leave, or gives the stroke
 * back, whichever is better for him. So a push-out that leaves L is worth
 *
 *     min(1 - V'(L), V(L)),
 *
 * V' and V being the chances to win of the opponent and of the player, each at the table. A pass is
 * worth 1 - V'. The values of value.c consider only direct pots and are nearly the same for all L,
 * so both chances come from separate plans, which search the leave with the errors of the player.
 *
 * The positions where push-outs leave the cue ball are spread over the table: the first is the
 * position of the softest push-out, and each other one is as far as possible from the previous
 * ones. Each is searched where a stroke with errors leaves it, and the best two again where further
 * ones do.
 *
 * Measured on 2026-11-30, by plans of 800 shots of both sides: in 30 layouts of nine-ball after dry
 * breaks, plans of 300 shots for ratings of 750 chose push-outs that were worth 0.052 +- 0.013 more
 * than random ones. Chosen by value.c they were worth 0.034 +- 0.014 more. Of 750 against 600 it is
 * 0.051 +- 0.017, and 0.003 +- 0.020 by value.c. */
#include "leaves.h"
#include "random_draws.h"

#include "coach.h"
#include "listing.h"
#include "prepare.h"
#include "ranking.h"
#include "rows.h"
#include "rules.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;

/* Shots of the best stroke of a plan from a leave that are not used to choose, from which the value
 * is estimated: if a leave is searched again, they are more. */
enum { FRESH = 30, FRESH_AGAIN = 100 };
/* Push-outs that are searched, one for so many shots of the plan; and the best of them, with so
 * many strokes with errors each. */
enum { SHOTS_A_PLACE = 40, SPREAD_LEAST = 8, SPREAD_MOST = 24, BEST = 2, DRAWS = 4 };
/* By how much a push-out or a pass may look worse than the best stroke. */
static const double worse_most = 0.1;
static const carom_call pass_call = {CAROM_CALL_PASS, -1};

static bool may_hand_over(const carom_search *search) {
  return (search->permissions & (CAROM_CHOICE_PASS | CAROM_CHOICE_PUSH)) != 0 &&
         search->places == 0;
}

/* Keeps the softest push-outs, whose positions have the smallest errors. */
static void keep_soft(carom_leaves *leaves, const candidate *c) {
  int index = leaves->count;
  if (leaves->count < LEAVES_TRIED)
    leaves->count++;
  for (; index > 0 && leaves->item[index - 1].c.speed > c->speed; index--)
    if (index < LEAVES_TRIED)
      leaves->item[index].c = leaves->item[index - 1].c;
  if (index < LEAVES_TRIED)
    leaves->item[index].c = *c;
}

void carom_leaves_collect(carom_search *search) {
  carom_leaves *leaves = search->leaves;
  if (!may_hand_over(search))
    return;
  memset(leaves, 0, sizeof *leaves);
  int64_t count = 0;
  for (int64_t k = 0; k < search->count; k++) {
    const candidate *c = &search->found[k];
    if (c->kind != CAROM_PLAN_PUSH)
      search->found[count++] = *c;
    else if (!c->chose.foul)
      keep_soft(leaves, c);
  }
  search->count = count;
}

static double mean_of(const candidate *c) {
  return c->chose.sum / (double)c->chose.seen;
}

/* What a push-out or a pass is worth; -1: not known. */
static double worth_of(const carom_handed_over *h) {
  if (h->count == 0)
    return -1.0;
  return h->worth / h->count;
}

/* The pass by the value that carom_search_leave() has for it. */
static candidate pass_of(const carom_search *search) {
  const carom_plan_rules *rules = search->job.rules;
  carom_rules_state game = rules->state; /* rules change it as they judge */
  const carom_turn turn =
      rules->judge(&game, search->in_play, search->view.cue_ball, &carom_no_facts, pass_call);
  const double value = carom_search_leave(search, &game, search->state, &turn);
  return (candidate){.chose = {.sum = value, .squares = value * value, .seen = 1},
                     .kind = CAROM_PLAN_PASS,
                     .ball = CAROM_CALL_PASS,
                     .pocket = -1,
                     .order = -1}; /* of shots that are worth as much, none is played */
}

bool carom_leaves_begin(carom_search *search) {
  if (!may_hand_over(search))
    return false;
  carom_leaves *leaves = search->leaves;
  if (search->permissions & CAROM_CHOICE_PASS)
    leaves->pass = pass_of(search);

  /* chances that the caller gives are no player's, and search nothing */
  leaves->best = mean_of(&search->found[0]);
  if (search->view.set_chance[0] > 0.0 || search->view.set_chance[1] > 0.0)
    leaves->best = INFINITY;
  return true;
}

/* ---- Push-outs whose positions are spread over the table */

/* Plays a push-out, with errors for draw 1, 2 and so on, or passes. Returns whether that leaves the
 * opponent a choice: no foul, and no cue ball in hand. */
static bool hand_over(const carom_search *search, const candidate *c, int draw) {
  carom_leaves *leaves = search->leaves;
  const carom_plan_job *job = &search->job;
  carom_ruling *ruling = &leaves->ruling;
  if (c->kind == CAROM_PLAN_PASS) {
    carom_referee(job->rules, job->table, job->balls, (int)job->count, search->view.cue_ball, NULL,
                  pass_call, ruling);
  } else {
    carom_cue cue = carom_search_stroke(search, c, draw > 0 ? DRAW_LEAVES : 0, draw);
    cue.ball = search->view.cue_ball;
    carom_play_stroke(job, &cue, (carom_call){CAROM_CALL_PUSH, -1}, &leaves->room,
                      &(carom_shot){.events = NULL}, ruling);
  }
  return ruling->turn.outcome == CAROM_TURN_PASS && ruling->turn.foul == 0 && !ruling->hand;
}

static bool is_worth_search(const carom_leaves *leaves, const candidate *c) {
  return c->chose.seen > 0 && mean_of(c) >= leaves->best - worse_most;
}

/* Finds the position of the next push-out; one that is not worth a search is dropped. */
static void find_place(carom_search *search) {
  carom_leaves *leaves = search->leaves;
  carom_handed_over *h = &leaves->item[leaves->placed];
  if (is_worth_search(leaves, &h->c) && hand_over(search, &h->c, 0)) {
    memcpy(h->place, leaves->ruling.balls[search->view.cue_ball].state.r, sizeof h->place);
    leaves->placed++;
  } else {
    *h = leaves->item[--leaves->count];
  }
}

/* The square of the distance from a position to the nearest one of the first n. */
static double distance_of(const carom_handed_over *item, int n, const double place[2]) {
  double nearest = INFINITY;
  for (int k = 0; k < n; k++)
    nearest = fmin(nearest, carom_square(item[k].place, place));
  return nearest;
}

static void swap(carom_handed_over *a, carom_handed_over *b) {
  const carom_handed_over first = *a;
  *a = *b;
  *b = first;
}

/* Keeps push-outs whose positions are far from each other. */
static void choose_spread(carom_leaves *leaves, int64_t shots) {
  const int64_t spread = carom_max(carom_min(shots / SHOTS_A_PLACE, SPREAD_MOST), SPREAD_LEAST);
  const int most = (int)carom_min(leaves->count, spread);
  for (int n = 1; n < most; n++) {
    int farthest = n;
    for (int k = n + 1; k < leaves->count; k++)
      if (distance_of(leaves->item, n, leaves->item[k].place) >
          distance_of(leaves->item, n, leaves->item[farthest].place))
        farthest = k;
    swap(&leaves->item[n], &leaves->item[farthest]);
  }
  leaves->count = most;
  leaves->is_spread = true;
  leaves->draw = 1;
}

/* ---- Searches */

/* The items that are searched with errors: the best push-outs, and the pass. */
static void choose_best(carom_leaves *leaves) {
  for (int n = 0; n < leaves->count; n++)
    for (int k = leaves->count - 1; k > n; k--)
      if (worth_of(&leaves->item[k]) > worth_of(&leaves->item[k - 1]))
        swap(&leaves->item[k], &leaves->item[k - 1]);
  leaves->count = (int)carom_min(leaves->count, BEST);
  for (int n = 0; n < leaves->count; n++)
    leaves->item[n] = (carom_handed_over){.c = leaves->item[n].c};
  if (leaves->pass.kind == CAROM_PLAN_PASS && is_worth_search(leaves, &leaves->pass))
    leaves->item[leaves->count++] = (carom_handed_over){.c = leaves->pass};
  leaves->is_again = true;
  leaves->index = 0;
  leaves->draw = 2;
}

static void next_draw(carom_leaves *leaves) {
  leaves->side = 0;
  if (leaves->is_again && leaves->draw <= DRAWS) {
    leaves->draw++;
    return;
  }
  leaves->index++;
  leaves->draw = leaves->is_again ? 2 : 1;
}

/* Makes the plan of a side from the leave of a ruling. */
static carom_status make_search(const carom_search *search) {
  carom_leaves *leaves = search->leaves;
  carom_plan_rules *rules = &leaves->rules;
  carom_plan_job next = carom_job_after(&search->job, &leaves->ruling, rules);
  if (leaves->side == 1) {
    rules->judge(&rules->state, search->in_play, search->view.cue_ball, &carom_no_facts, pass_call);
    next.player = search->job.player;
    next.opponent = search->job.opponent;
  }
  rules->state.may = 0;
  leaves->options = search->options;
  leaves->options.shots = LEAVE_SHOTS;
  leaves->options.seconds = leaves->options.unsure = 0.0;
  leaves->options.seed += UINT64_C(0x9e3779b97f4a7c15) * (uint64_t)(1 + leaves->draw);
  next.options = &leaves->options;
  carom_search *leave = (carom_search *)(leaves + 1);
  const carom_status status = carom_search_make(leave, &next, false, 1);
  leave->crew = search->crew;
  leave->end = search->end;
  leave->fresh_least = leaves->is_again ? FRESH_AGAIN : FRESH;
  return status;
}

carom_search *carom_leaves_next(carom_search *search) {
  enum { COST = 100 }; /* events of a shot that take as long as a plan that begins */
  carom_leaves *leaves = search->leaves;
  carom_search_spend(search, COST);
  if (!leaves->is_spread) {
    if (leaves->placed < leaves->count)
      find_place(search);
    else
      choose_spread(leaves, search->shots);
    return NULL;
  }
  if (leaves->index == leaves->count) {
    choose_best(leaves);
    return NULL;
  }
  if (hand_over(search, &leaves->item[leaves->index].c, leaves->draw) &&
      make_search(search) == CAROM_OK)
    return (carom_search *)(leaves + 1);
  next_draw(leaves);
  return NULL;
}

bool carom_leaves_ended(const carom_search *search) {
  const carom_leaves *leaves = search->leaves;
  return leaves->is_again && leaves->index == leaves->count;
}

void carom_leaves_take(carom_search *search) {
  carom_leaves *leaves = search->leaves;
  const carom_search *leave = (carom_search *)(leaves + 1);
  const double value = carom_search_choice(leave, &leave->found[0]).value;
  carom_handed_over *h = &leaves->item[leaves->index];
  leaves->chance[leaves->side] = value;
  if (leaves->side == 0) {
    /* nobody gives a pass back; equal players have the same chance there; and what the opponent
     * takes with more than he has at the best leave so far he does not return */
    double best = -1.0;
    for (int k = 0; k < leaves->index && !leaves->is_again; k++)
      best = fmax(best, worth_of(&leaves->item[k]));
    const bool is_equal =
        memcmp(leave->job.player, search->job.player, sizeof *search->job.player) == 0;
    leaves->chance[1] = is_equal ? value : 1.0 - value;
    leaves->side = h->c.kind != CAROM_PLAN_PASS && 1.0 - value > best && !is_equal;
    if (leaves->side == 1)
      return;
  }
  double worth = 1.0 - leaves->chance[0];
  if (h->c.kind != CAROM_PLAN_PASS)
    worth = fmin(worth, leaves->chance[1]);
  h->sum[0] += leaves->chance[0];
  h->sum[1] += leaves->chance[1];
  h->worth += worth;
  h->squares += worth * worth;
  h->count++;
  next_draw(leaves);
}

/* Adds an item as a candidate with the results of its searches. */
static void add(carom_search *search, const carom_handed_over *h) {
  candidate c = h->c;
  if (h->count > 0) {
    const double n = h->count, worth = worth_of(h), seen = (double)c.chose.seen;
    const double variance = fmax(h->squares / n - worth * worth, 0.0);
    c.leave[0] = (float)(h->sum[0] / n);
    c.leave[1] = (float)(h->sum[1] / n);
    c.leave_worth = (float)worth;
    c.leave_error = (float)sqrt(variance / fmax(n - 1.0, 1.0));

    /* strokes that foul leave about what there is */
    const double fouls = (double)c.chose.foul / seen;
    const double mixed = (1.0 - fouls) * worth + fouls * search->foul_value;
    c.chose.sum = seen * mixed;
    c.chose.squares = seen * mixed * mixed;
  }
  c.round = search->found[0].round;
  if (search->count == search->most)
    search->count--;
  search->found[search->count++] = c;
  carom_search_lead(search, search->count - 1);
}

void carom_leaves_end(carom_search *search) {
  const carom_leaves *leaves = search->leaves;
  const carom_handed_over *best = NULL, *pass = &(carom_handed_over){.c = leaves->pass};
  for (int k = 0; k < leaves->count; k++) {
    const carom_handed_over *h = &leaves->item[k];
    if (h->c.kind == CAROM_PLAN_PASS)
      pass = h;
    else if (h->count > 0 && (best == NULL || worth_of(h) > worth_of(best)))
      best = h;
  }
  if (best != NULL)
    add(search, best);
  if (pass->c.kind == CAROM_PLAN_PASS)
    add(search, pass);
}
