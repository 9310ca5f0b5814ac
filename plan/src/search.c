/* The choice: sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013) of the candidates. All
 * of a round have the same errors, so that luck counts less than what they are worth. */
#include "search.h"
#include "draws.h"

#include "candidates.h"
#include "leaves.h"
#include "listing.h"
#include "miss.h"
#include "places.h"
#include "platform/promise.h"
#include "prepare.h"
#include "ranking.h"
#include "rows.h"
#include "rules.h"
#include "steer.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;
typedef carom_search search;

/* In round NEAR_ROUND strokes near the best one join. Where no pot is direct, those near the best
 * BLIND_PARENTS do in all rounds but the first, and more of the scan stay. Of 51 layouts of
 * nine-ball whose ball is snookered, plans of 2,000 shots are worth 0.603 without that, 0.647 with
 * it, and the best of 20,000 random strokes, played 200,000 times, 0.665. */
enum { ROUNDS = 4, NEAR_ROUND = 2, BLIND_PARENTS = 4 };

/* Moves the candidates of the first round to the front, and returns how many they are. Of the best
 * `keep` all pots stay, and of the scan up to a third of `keep`, or half where no pot is direct.
 * All strokes of a break stay, and all on a table without pockets. */
static int64_t first_round(search *plan, int64_t keep) {
  const int64_t n = carom_min(plan->count, keep);
  int64_t share = keep / 3;
  if (plan->blind)
    share = keep / 2;
  share = carom_max(share, 3);
  int64_t scanned = 0, good = 0;
  for (int64_t k = 0; k < n; k++) {
    candidate *c = &plan->found[k];
    bool stays = c->kind == CAROM_PLAN_POT || plan->breaks || plan->view.pockets == 0;
    if (!stays && scanned < share) {
      scanned++;
      stays = true;
    }
    if (stays) {
      const candidate candidate_copy = *c;
      *c = plan->found[good];
      plan->found[good++] = candidate_copy;
    }
  }
  CAROM_PROMISE(good >= 1 && good <= n);
  return good;
}

/* A gentle stroke towards the nearest ball that is on: nothing better is known. */
static candidate gentle(const search *plan) {
  const double *c = plan->played[plan->cue_ball].state.r;
  double least = INFINITY, phi = 0.0;
  for (int k = 0; k < plan->view.count; k++) {
    const double x = plan->job.balls[k].state.r[0] - c[0], y = plan->job.balls[k].state.r[1] - c[1];
    if ((plan->targets >> k & 1) && x * x + y * y < least) {
      least = x * x + y * y;
      phi = carom_angle_of(x, y) / degree;
    }
  }
  return (candidate){.speed = plan->player.speed_least,
                     .phi = carom_turned(phi),
                     .kind = CAROM_PLAN_FOUL,
                     .ball = -1,
                     .pocket = -1};
}

/* ---- The course of a search: each of these sets the next stage, and what comes after it */

/* Shots of the rounds: at least a third of all. */
static int64_t left_for_rounds(const search *plan) {
  int64_t left = plan->shots - plan->count;
  if (plan->cushions >= 0)
    left = plan->shots;
  if (plan->blind)
    left -= plan->shots / 4;
  return carom_max(left, plan->shots / 3);
}

/* Whether one of the best has lost the game. In an equalizing inning each miss does. */
static bool loses(const search *plan) {
  enum { BEST = 4 };
  int64_t lost = 0;
  if (plan->job.rules->state.innings == CAROM_LAST_INNING)
    return false;
  for (int64_t k = 0; k < plan->count && k < BEST; k++)
    if (plan->found[k].round > 0)
      lost += plan->found[k].chose.lose;
  return lost > 0;
}

/* Plays the best again, by shots that choose nothing: its reported chances come from them. */
static void replay(search *plan) {
  enum { SHARE = 10 };
  plan->next = NEXT_ENDED;
  if (carom_is_stopped(plan))
    return;
  carom_search_stage(plan, 0, 1, carom_max(plan->shots / SHARE, plan->fresh_least), DRAW_REPLAY);
  plan->next = NEXT_REPLAY;
}

/* The best is known once the leaves are that the player may hand over. */
static void hand_over(search *plan) {
  plan->next = NEXT_ENDED;
  if (carom_is_stopped(plan))
    return;
  if (!carom_leaves_begin(plan)) {
    replay(plan);
    return;
  }
  carom_search_stage(plan, 0, 0, 1, 0);
  plan->next = NEXT_LEAVE;
}

/* Begins the plan from the next leave, or ends with them. */
static void next_leave(search *plan) {
  if (carom_is_stopped(plan) || carom_leaves_ended(plan)) {
    carom_leaves_end(plan);
    replay(plan);
    return;
  }
  plan->leave = carom_leaves_next(plan);
  if (plan->leave == NULL)
    return;
  carom_search_begin(plan->leave, plan->leave->options.shots);
  plan->next = NEXT_SEARCH;
}

/* Goes on with the plan from a leave, whose time and slice are those of this one. */
static void search_leave(search *plan) {
  search *leave = plan->leave;
  leave->crew = plan->crew;
  leave->end = plan->end;
  leave->slice = plan->slice;
  const bool ended = carom_search_run(leave);
  plan->slice = leave->slice;
  plan->late |= leave->late;
  if (!ended)
    return;
  if (!carom_is_stopped(plan))
    carom_leaves_take(plan);
  plan->next = NEXT_LEAVE;
}

/* Takes the shots of the best that choose nothing, and looks for the other choices of the list. A
 * plan that a greater one follows has no list. */
static void begin_list(search *plan) {
  if (plan->found[0].kind != CAROM_PLAN_PASS)
    carom_search_replayed(plan);
  plan->next = NEXT_ENDED;
  if (carom_is_stopped(plan) || plan->choices_most == 1 || plan->rest > 0)
    return;
  carom_search_sort(plan, plan->count);
  plan->examined = 1;
  carom_search_stage(plan, 0, 0, 1, 0);
  plan->next = NEXT_LIST;
}

/* They are played by shots that choose nothing, too, but by fewer. */
static void replay_list(search *plan) {
  enum { SHARE = 40, LEAST = 20 };
  if (!carom_is_stopped(plan) && !carom_search_list(plan))
    return;
  plan->next = NEXT_ENDED;
  if (carom_is_stopped(plan) || plan->listed == 1)
    return;
  carom_search_stage(plan, 1, plan->listed - 1, carom_max(plan->shots / SHARE, LEAST), DRAW_REPLAY);
  plan->next = NEXT_LISTED;
}

/* Plays the few best against each other, by the same errors, up to twice: where many strokes have
 * few shots each, or one of the best may lose the game at once. Returns whether it does. */
static bool duel(search *plan) {
  enum { DUELS = 2 };
  if (plan->duels == DUELS || !(plan->blind || loses(plan)))
    return false;
  int64_t most = 2, shots = plan->shots / 10;
  if (plan->duels == 0) {
    most = (int64_t)carom_within((double)plan->shots / 200.0, 4.0, 10.0);
    shots = plan->shots / 6;
  }
  const int64_t n = carom_min(plan->count, most);
  const int64_t each = carom_min(carom_max(shots / n, 10), plan->room / n);
  carom_search_stage(plan, 0, n, each, DRAW_ROUND + ROUNDS + (uint32_t)plan->duels);
  plan->duels++;
  plan->next = NEXT_DUEL;
  return true;
}

/* A pot that looks better than the best one after fewer strokes is played as often as the best one
 * in the last round, before the plan reports it. */
static void look_again(search *plan) {
  enum { LOOKS = 2 };
  if (plan->look == LOOKS || plan->duels > 0 || carom_is_stopped(plan)) {
    hand_over(plan);
    return;
  }
  const candidate *best = &plan->found[0];
  double most = best->chose.sum / (double)best->chose.seen;
  plan->better = 0;
  for (int64_t k = 1; k < plan->count; k++) {
    const candidate *c = &plan->found[k];
    const bool is_different = c->ball != best->ball || c->pocket != best->pocket;
    if (is_different && c->round > 0 && c->round < ROUNDS &&
        c->chose.sum / (double)c->chose.seen > most) {
      plan->better = k;
      most = c->chose.sum / (double)c->chose.seen;
    }
  }
  if (plan->better == 0) {
    hand_over(plan);
    return;
  }

  /* it is played in the place of the best, with which it is compared then */
  const candidate first = plan->found[0];
  plan->found[0] = plan->found[plan->better];
  plan->found[plan->better] = first;
  plan->found[0].round = ROUNDS - 1;
  const int64_t share = left_for_rounds(plan) / ROUNDS / 2;
  const int64_t each = carom_max(carom_min(share, plan->room), 2);
  carom_search_stage(plan, 0, 1, each, DRAW_ROUND + ROUNDS - 1);
  plan->look++;
  plan->next = NEXT_LOOK;
}

/* How many candidates of the round before stay in this one: a quarter. */
static int64_t in_round(search *plan) {
  enum { SHOTS_EACH = 25, FIRST_LEAST = 6, LEAST = 2 };
  const int64_t keep = carom_max(plan->shots / SHOTS_EACH, FIRST_LEAST);
  const int64_t n = carom_max(keep >> (2 * plan->round), LEAST);
  if (plan->round == 0)
    return first_round(plan, n);
  return carom_min(n, plan->count);
}

/* Whether strokes of the grid seldom succeed, so that those near the best join each round. */
static bool is_sparse(const search *plan) {
  const bool has_place = plan->job.goal != NULL && plan->job.goal->kind == CAROM_GOAL_NEAR;
  return plan->blind || has_place;
}

/* Strokes near the best are turned, and played once without errors. False where there are none. */
static bool add_near(search *plan) {
  const int64_t first = plan->count;
  int64_t parents = 1;
  if (is_sparse(plan))
    parents = BLIND_PARENTS;
  plan->neighbours = 0;
  plan->entered = in_round(plan);
  carom_search_near(plan, carom_min(plan->entered, parents));
  if (plan->count == first)
    return false;
  carom_search_steer_added(plan, first);
  plan->next = NEXT_TURNED;
  return true;
}

/* Strokes near the best that meet a ball that is on join behind the candidates of the round, and
 * count as if they had played every round before. The others are left out. */
static void take_near(search *plan) {
  const int64_t first = plan->stage.first;
  for (int64_t k = 0; k < plan->stage.done; k++) {
    if (!carom_search_may_join(plan, &plan->outcome[k]))
      continue;
    carom_search_take(plan, first + k, &plan->outcome[k]);
    candidate c = plan->found[first + k];
    c.chose = (carom_tally){0};
    c.round = (int16_t)plan->round;
    plan->found[first + plan->neighbours] = plan->found[plan->entered + plan->neighbours];
    plan->found[plan->entered + plan->neighbours++] = c;
  }
  plan->count = first + plan->neighbours;
}

static void next_round(search *plan) {
  if (plan->round == ROUNDS || carom_is_stopped(plan)) {
    if (carom_is_stopped(plan) || !duel(plan))
      look_again(plan);
    return;
  }
  const bool joined = plan->round == NEAR_ROUND || (is_sparse(plan) && plan->round > 0);
  if (joined && plan->neighbours < 0 && add_near(plan))
    return;
  int64_t n;
  if (joined)
    n = plan->entered + plan->neighbours;
  else
    n = in_round(plan);
  const int64_t share = carom_max(left_for_rounds(plan) / ROUNDS / n, 2);
  const int64_t each = carom_min(share, plan->room / n);
  carom_search_stage(plan, 0, n, each, DRAW_ROUND + (uint32_t)plan->round);
  plan->round++;
  plan->neighbours = -1;
  plan->next = NEXT_ROUND;
}

/* The best of the round of doubling before becomes a candidate that is in the first round. */
static void join(search *plan) {
  candidate c = plan->best;
  if (!plan->joins || c.kind == CAROM_PLAN_FOUL || c.kind == CAROM_PLAN_PASS ||
      plan->count == plan->most)
    return;
  c.chose = (carom_tally){.sum = 2.0, .seen = 1}; /* sorts before all that were played once */
  c.fresh = (carom_tally){0};
  c.round = 0;
  c.votes = c.pots;
  c.order = (int32_t)plan->count;
  plan->found[plan->count++] = c;
}

/* A block of the scan, or the first round behind the last one. */
static void scan(search *plan) {
  if (carom_search_scan(plan)) {
    plan->next = NEXT_SCAN;
    return;
  }
  if (carom_search_steer(plan)) {
    plan->next = NEXT_STEER;
    return;
  }
  carom_leaves_collect(plan);
  if (plan->count == 0) {
    carom_search_add(plan, gentle(plan));
    carom_search_stage(plan, 0, 1, plan->shots / 10, DRAW_ROUND);
    plan->next = NEXT_GENTLE;
  } else {
    join(plan);
    carom_search_sort(plan, plan->count);
    next_round(plan);
  }
}

/* The share of the scan in the shots. A break has none; and where a direct pot is nearly sure, few
 * other strokes suffice. With a share of 0.1 there, plans of 300 shots ran out 247 of 400 racks of
 * eight-ball, without 217, in 0.71 of the time; of 1,000 shots as many with both. */
static double scan_share(const search *plan) {
  static const double sure = 0.8, least = 0.1, saved = 120.0; /* shots */
  const double share = carom_scan_of(&plan->options);
  if (plan->breaks)
    return 0.0;
  if (plan->options.scan != 0.0 || plan->places > 0 || plan->view.pockets == 0)
    return share;
  double x[NEXT_NUMBERS];
  carom_plan_features(&plan->view, plan->state, plan->in_play, plan->targets, plan->pockets, 0,
                      false, NULL, x);
  if (x[3] < sure)
    return share;
  return fmax(share - saved / (double)plan->shots, least);
}

/* The most pots, or strokes of a break, from a place. */
static int64_t pots_of(const search *plan) {
  return (int64_t)((1.0 - plan->share) * (double)plan->shots / 4.0) / carom_max(plan->raced, 1);
}

/* Takes the pots that were aimed as candidates, by what they are worth with their chances. */
static void take_pots(search *plan) {
  plan->count = plan->stage.done;
  for (int64_t k = 0; k < plan->count; k++) {
    outcome o = plan->outcome[k];
    if (o.ball >= 0 && plan->found[k].kind == CAROM_PLAN_POT)
      o.worth = carom_search_expected(plan, plan->found[k].chance, o.worth);
    carom_search_take(plan, k, &o);
  }
  plan->blind = plan->count == 0;
  if (plan->blind && plan->options.scan == 0.0 && plan->view.pockets > 0)
    plan->scan += plan->shots / 5;
  plan->scan_end = plan->count + plan->scan;
}

/* Goes on to the pots from the next place, or to a shot of each that was aimed. */
static void aim_next(search *plan) {
  carom_search_aimed(plan);
  if (plan->place + 1 < plan->raced && !carom_is_stopped(plan)) {
    carom_search_next_place(plan);
    carom_search_pots(plan, pots_of(plan));
    return;
  }
  carom_search_stage(plan, 0, plan->count, 1, 0);
  plan->next = NEXT_TAKEN;
}

static void go_on(search *plan) {
  switch (plan->next) {
  case NEXT_AIMED:
    aim_next(plan);
    break;
  case NEXT_TAKEN:
    take_pots(plan);
    scan(plan);
    break;
  case NEXT_SCAN:
    carom_search_scanned(plan);
    scan(plan);
    break;
  case NEXT_STEER:
    carom_search_steered(plan);
    plan->next = NEXT_PLAYED;
    break;
  case NEXT_PLAYED:
    carom_search_take_steered(plan);
    scan(plan);
    break;
  case NEXT_ROUND:
  case NEXT_DUEL:
    carom_search_add_up(plan);
    carom_search_sort(plan, plan->count);
    next_round(plan);
    break;
  case NEXT_TURNED:
    carom_search_steered(plan);
    plan->next = NEXT_NEAR;
    break;
  case NEXT_NEAR:
    take_near(plan);
    next_round(plan);
    break;
  case NEXT_LOOK:
    carom_search_add_up(plan);
    carom_search_lead(plan, plan->better);
    carom_search_sort(plan, plan->count);
    look_again(plan);
    break;
  case NEXT_LEAVE:
    next_leave(plan);
    break;
  case NEXT_SEARCH:
    search_leave(plan);
    break;
  case NEXT_REPLAY:
    begin_list(plan);
    break;
  case NEXT_LIST:
    replay_list(plan);
    break;
  case NEXT_LISTED:
    carom_search_replayed(plan);
    plan->next = NEXT_ENDED;
    break;
  case NEXT_GENTLE:
    carom_search_add_up(plan);
    hand_over(plan);
    break;
  case NEXT_ENDED:
    break;
  }
}

void carom_search_begin(search *plan, int64_t shots) {
  enum { SHOTS_A_PLACE = 40, PLACES_LEAST = 6 };
  plan->shots = shots;
  carom_search_find_goals(plan);
  plan->share = scan_share(plan);
  plan->scan = (int64_t)(plan->share * (double)shots);
  if (plan->cushions >= 0)
    plan->scan += carom_min(2 * plan->scan, SCAN_MORE);
  plan->count = plan->tried = 0;
  plan->steered = 0;
  plan->round = plan->look = plan->duels = 0;
  plan->neighbours = -1;
  plan->listed = 1;

  /* the first place */
  const int64_t raced = carom_max(shots / SHOTS_A_PLACE, PLACES_LEAST);
  plan->raced = (int)carom_min(plan->places, raced);
  plan->place = -1;
  carom_search_next_place(plan);
  if (!plan->breaks) {
    carom_search_pots(plan, pots_of(plan));
    plan->next = NEXT_AIMED;
    return;
  }
  carom_search_breaks(plan, pots_of(plan));
  while (plan->place + 1 < plan->raced) {
    carom_search_next_place(plan);
    carom_search_breaks(plan, pots_of(plan));
  }
  carom_search_stage(plan, 0, plan->count, 1, 0);
  plan->next = NEXT_TAKEN;
}

bool carom_search_run(search *plan) {
  while (plan->next != NEXT_ENDED) {
    if (plan->slice == 0 || !carom_search_play(plan))
      return false;
    go_on(plan);
  }
  return true;
}
