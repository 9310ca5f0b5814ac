/* The choice: sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013) of the candidates. All
 * of a round have the same errors, so that luck counts less than what they are worth. */
#include "search.h"
#include "random_draws.h"

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

/* In round NEAR_ROUND strokes near the best one join. Where no pot is direct, those near the best
 * BLIND_PARENTS do in all rounds but the first, and more of the scan stay. Of 51 layouts of
 * nine-ball whose ball is snookered, plans of 2,000 shots are worth 0.603 without that, 0.647 with
 * it, and the best of 20,000 random strokes, played 200,000 times, 0.665. */
enum { ROUNDS = 4, NEAR_ROUND = 2, BLIND_PARENTS = 4 };

/* Moves the candidates of the first round to the front, and returns how many they are. Of the best
 * `keep` all pots stay, and of the scan up to a third of `keep`, or half where no pot is direct.
 * All strokes of a break stay, and all on a table without pockets. */
static int64_t first_round(carom_search *search, int64_t keep) {
  const int64_t n = carom_min(search->count, keep);
  int64_t share = keep / 3;
  if (search->blind)
    share = keep / 2;
  share = carom_max(share, 3);
  int64_t scanned = 0, good = 0;
  for (int64_t k = 0; k < n; k++) {
    candidate *c = &search->found[k];
    bool stays = c->kind == CAROM_PLAN_POT || search->breaks || search->view.pockets == 0;
    if (!stays && scanned < share) {
      scanned++;
      stays = true;
    }
    if (stays) {
      const candidate candidate_copy = *c;
      *c = search->found[good];
      search->found[good++] = candidate_copy;
    }
  }
  CAROM_PROMISE(good >= 1 && good <= n);
  return good;
}

/* A gentle stroke towards the nearest ball that is on: nothing better is known. */
static candidate gentle(const carom_search *search) {
  const double *c = search->played[search->cue_ball].state.r;
  double least = INFINITY, phi = 0.0;
  for (int k = 0; k < search->view.count; k++) {
    const double x = search->job.balls[k].state.r[0] - c[0],
                 y = search->job.balls[k].state.r[1] - c[1];
    if ((search->targets >> k & 1) && x * x + y * y < least) {
      least = x * x + y * y;
      phi = carom_angle_of(x, y) / degree;
    }
  }
  return (candidate){.speed = search->player.speed_least,
                     .phi = carom_turned(phi),
                     .kind = CAROM_PLAN_FOUL,
                     .ball = -1,
                     .pocket = -1};
}

/* ---- The course of a search: each of these sets the next stage, and what follows it */

/* Shots of the rounds: at least a third of all. */
static int64_t left_for_rounds(const carom_search *search) {
  int64_t left = search->shots - search->count;
  if (search->cushions >= 0)
    left = search->shots;
  if (search->blind)
    left -= search->shots / 4;
  return carom_max(left, search->shots / 3);
}

/* Whether one of the best has lost the game. In an equalizing inning each miss does. */
static bool loses(const carom_search *search) {
  enum { BEST = 4 };
  int64_t lost = 0;
  if (search->job.rules->state.innings == CAROM_LAST_INNING)
    return false;
  for (int64_t k = 0; k < search->count && k < BEST; k++)
    if (search->found[k].round > 0)
      lost += search->found[k].chose.lose;
  return lost > 0;
}

/* Plays the best again, by shots that are not used to choose: its reported chances come from
 * them. */
static void replay(carom_search *search) {
  enum { SHARE = 10 };
  search->next = NEXT_ENDED;
  if (carom_is_stopped(search))
    return;
  carom_search_stage(search, 0, 1, carom_max(search->shots / SHARE, search->fresh_least),
                     DRAW_REPLAY);
  search->next = NEXT_REPLAY;
}

/* The best is known once the leaves are that the player may hand over. */
static void hand_over(carom_search *search) {
  search->next = NEXT_ENDED;
  if (carom_is_stopped(search))
    return;
  if (!carom_leaves_begin(search)) {
    replay(search);
    return;
  }
  carom_search_stage(search, 0, 0, 1, 0);
  search->next = NEXT_LEAVE;
}

/* Begins the plan from the next leave, or ends with them. */
static void next_leave(carom_search *search) {
  if (carom_is_stopped(search) || carom_leaves_ended(search)) {
    carom_leaves_end(search);
    replay(search);
    return;
  }
  search->leave = carom_leaves_next(search);
  if (search->leave == NULL)
    return;
  carom_search_begin(search->leave, search->leave->options.shots);
  search->next = NEXT_SEARCH;
}

/* Continues the plan from a leave, with the time and slice of this plan. */
static void search_leave(carom_search *search) {
  carom_search *leave = search->leave;
  leave->crew = search->crew;
  leave->end = search->end;
  leave->slice = search->slice;
  const bool ended = carom_search_run(leave);
  search->slice = leave->slice;
  search->late |= leave->late;
  if (!ended)
    return;
  if (!carom_is_stopped(search))
    carom_leaves_take(search);
  search->next = NEXT_LEAVE;
}

/* Takes the shots of the best that choose nothing, and looks for the other choices of the list. A
 * plan that a greater one follows has no list. */
static void begin_list(carom_search *search) {
  if (search->found[0].kind != CAROM_PLAN_PASS)
    carom_search_replayed(search);
  search->next = NEXT_ENDED;
  if (carom_is_stopped(search) || search->choices_most == 1 || search->rest > 0)
    return;
  carom_search_sort(search, search->count);
  search->examined = 1;
  carom_search_stage(search, 0, 0, 1, 0);
  search->next = NEXT_LIST;
}

/* They are played by shots that choose nothing, too, but by fewer. */
static void replay_list(carom_search *search) {
  enum { SHARE = 40, LEAST = 20 };
  if (!carom_is_stopped(search) && !carom_search_list(search))
    return;
  search->next = NEXT_ENDED;
  if (carom_is_stopped(search) || search->listed == 1)
    return;
  carom_search_stage(search, 1, search->listed - 1, carom_max(search->shots / SHARE, LEAST),
                     DRAW_REPLAY);
  search->next = NEXT_LISTED;
}

/* Plays the few best against each other, by the same errors, up to twice: where many strokes have
 * few shots each, or one of the best may lose the game at once. Returns whether it does. */
static bool duel(carom_search *search) {
  enum { DUELS = 2 };
  if (search->duels == DUELS || !(search->blind || loses(search)))
    return false;
  int64_t most = 2, shots = search->shots / 10;
  if (search->duels == 0) {
    most = (int64_t)carom_within((double)search->shots / 200.0, 4.0, 10.0);
    shots = search->shots / 6;
  }
  const int64_t n = carom_min(search->count, most);
  const int64_t each = carom_min(carom_max(shots / n, 10), search->room / n);
  carom_search_stage(search, 0, n, each, DRAW_ROUND + ROUNDS + (uint32_t)search->duels);
  search->duels++;
  search->next = NEXT_DUEL;
  return true;
}

/* A pot that looks better than the best one after fewer strokes is played as often as the best one
 * in the last round, before the plan reports it. */
static void look_again(carom_search *search) {
  enum { LOOKS = 2 };
  if (search->look == LOOKS || search->duels > 0 || carom_is_stopped(search)) {
    hand_over(search);
    return;
  }
  const candidate *best = &search->found[0];
  double most = best->chose.sum / (double)best->chose.seen;
  search->better = 0;
  for (int64_t k = 1; k < search->count; k++) {
    const candidate *c = &search->found[k];
    const bool is_different = c->ball != best->ball || c->pocket != best->pocket;
    if (is_different && c->round > 0 && c->round < ROUNDS &&
        c->chose.sum / (double)c->chose.seen > most) {
      search->better = k;
      most = c->chose.sum / (double)c->chose.seen;
    }
  }
  if (search->better == 0) {
    hand_over(search);
    return;
  }

  /* it is played in the position of the best, with which it is compared then */
  const candidate first = search->found[0];
  search->found[0] = search->found[search->better];
  search->found[search->better] = first;
  search->found[0].round = ROUNDS - 1;
  const int64_t share = left_for_rounds(search) / ROUNDS / 2;
  const int64_t each = carom_max(carom_min(share, search->room), 2);
  carom_search_stage(search, 0, 1, each, DRAW_ROUND + ROUNDS - 1);
  search->look++;
  search->next = NEXT_LOOK;
}

/* How many candidates of the round before stay in this one: a quarter. */
static int64_t in_round(carom_search *search) {
  enum { SHOTS_EACH = 25, FIRST_LEAST = 6, LEAST = 2 };
  const int64_t keep = carom_max(search->shots / SHOTS_EACH, FIRST_LEAST);
  const int64_t n = carom_max(keep >> (2 * search->round), LEAST);
  if (search->round == 0)
    return first_round(search, n);
  return carom_min(n, search->count);
}

/* Whether strokes of the grid seldom succeed, so that those near the best join each round. */
static bool is_sparse(const carom_search *search) {
  const bool has_place = search->job.goal != NULL && search->job.goal->kind == CAROM_GOAL_NEAR;
  return search->blind || has_place;
}

/* Strokes near the best are turned, and played once without errors. False where there are none. */
static bool add_near(carom_search *search) {
  const int64_t first = search->count;
  int64_t parents = 1;
  if (is_sparse(search))
    parents = BLIND_PARENTS;
  search->neighbours = 0;
  search->entered = in_round(search);
  carom_search_near(search, carom_min(search->entered, parents));
  if (search->count == first)
    return false;
  carom_search_steer_added(search, first);
  search->next = NEXT_TURNED;
  return true;
}

/* Strokes near the best that meet a ball that is on join behind the candidates of the round, and
 * count as if they had played every round before. The others are left out. */
static void take_near(carom_search *search) {
  const int64_t first = search->stage.first;
  for (int64_t k = 0; k < search->stage.done; k++) {
    if (!carom_search_may_join(search, &search->outcome[k]))
      continue;
    carom_search_take(search, first + k, &search->outcome[k]);
    candidate c = search->found[first + k];
    c.chose = (carom_tally){0};
    c.round = (int16_t)search->round;
    search->found[first + search->neighbours] = search->found[search->entered + search->neighbours];
    search->found[search->entered + search->neighbours++] = c;
  }
  search->count = first + search->neighbours;
}

static void next_round(carom_search *search) {
  if (search->round == ROUNDS || carom_is_stopped(search)) {
    if (carom_is_stopped(search) || !duel(search))
      look_again(search);
    return;
  }
  const bool joined = search->round == NEAR_ROUND || (is_sparse(search) && search->round > 0);
  if (joined && search->neighbours < 0 && add_near(search))
    return;
  int64_t n;
  if (joined)
    n = search->entered + search->neighbours;
  else
    n = in_round(search);
  const int64_t share = carom_max(left_for_rounds(search) / ROUNDS / n, 2);
  const int64_t each = carom_min(share, search->room / n);
  carom_search_stage(search, 0, n, each, DRAW_ROUND + (uint32_t)search->round);
  search->round++;
  search->neighbours = -1;
  search->next = NEXT_ROUND;
}

/* The best of the round of doubling before becomes a candidate that is in the first round. */
static void join(carom_search *search) {
  candidate c = search->best;
  if (!search->joins || c.kind == CAROM_PLAN_FOUL || c.kind == CAROM_PLAN_PASS ||
      search->count == search->most)
    return;
  c.chose = (carom_tally){.sum = 2.0, .seen = 1}; /* sorts before all that were played once */
  c.fresh = (carom_tally){0};
  c.round = 0;
  c.votes = c.pots;
  c.order = (int32_t)search->count;
  search->found[search->count++] = c;
}

/* A block of the scan, or the first round behind the last one. */
static void scan(carom_search *search) {
  if (carom_search_scan(search)) {
    search->next = NEXT_SCAN;
    return;
  }
  if (carom_search_steer(search)) {
    search->next = NEXT_STEER;
    return;
  }
  carom_leaves_collect(search);
  if (search->count == 0) {
    carom_search_add(search, gentle(search));
    carom_search_stage(search, 0, 1, search->shots / 10, DRAW_ROUND);
    search->next = NEXT_GENTLE;
  } else {
    join(search);
    carom_search_sort(search, search->count);
    next_round(search);
  }
}

/* The fraction of the scan in the shots. A break has no scan; and if a direct pot is nearly sure,
 * few other strokes suffice. With a fraction of 0.1 there, plans of 300 shots ran out 247 of 400
 * racks of eight-ball, without 217, in 0.71 of the time; of 1,000 shots as many with both. */
static double scan_share(const carom_search *search) {
  static const double sure = 0.8, least = 0.1, saved = 120.0; /* shots */
  const double share = carom_scan_of(&search->options);
  if (search->breaks)
    return 0.0;
  if (search->options.scan != 0.0 || search->places > 0 || search->view.pockets == 0)
    return share;
  double x[NEXT_NUMBERS];
  carom_plan_features(&search->view, search->state, search->in_play, search->targets,
                      search->pockets, 0, false, NULL, x);
  if (x[3] < sure)
    return share;
  return fmax(share - saved / (double)search->shots, least);
}

/* The most pots, or strokes of a break, from a position. */
static int64_t pots_of(const carom_search *search) {
  return (int64_t)((1.0 - search->share) * (double)search->shots / 4.0) /
         carom_max(search->raced, 1);
}

/* Takes the pots that were aimed as candidates, by what they are worth with their chances. */
static void take_pots(carom_search *search) {
  search->count = search->stage.done;
  for (int64_t k = 0; k < search->count; k++) {
    outcome o = search->outcome[k];
    if (o.ball >= 0 && search->found[k].kind == CAROM_PLAN_POT)
      o.worth = carom_search_expected(search, search->found[k].chance, o.worth);
    carom_search_take(search, k, &o);
  }
  search->blind = search->count == 0;
  if (search->blind && search->options.scan == 0.0 && search->view.pockets > 0)
    search->scan += search->shots / 5;
  search->scan_end = search->count + search->scan;
}

/* Goes on to the pots from the next place, or to a shot of each that was aimed. */
static void aim_next(carom_search *search) {
  carom_search_aimed(search);
  if (search->place + 1 < search->raced && !carom_is_stopped(search)) {
    carom_search_next_place(search);
    carom_search_pots(search, pots_of(search));
    return;
  }
  carom_search_stage(search, 0, search->count, 1, 0);
  search->next = NEXT_TAKEN;
}

static void go_on(carom_search *search) {
  switch (search->next) {
  case NEXT_AIMED:
    aim_next(search);
    break;
  case NEXT_TAKEN:
    take_pots(search);
    scan(search);
    break;
  case NEXT_SCAN:
    carom_search_scanned(search);
    scan(search);
    break;
  case NEXT_STEER:
    carom_search_steered(search);
    search->next = NEXT_PLAYED;
    break;
  case NEXT_PLAYED:
    carom_search_take_steered(search);
    scan(search);
    break;
  case NEXT_ROUND:
  case NEXT_DUEL:
    carom_search_add_up(search);
    carom_search_sort(search, search->count);
    next_round(search);
    break;
  case NEXT_TURNED:
    carom_search_steered(search);
    search->next = NEXT_NEAR;
    break;
  case NEXT_NEAR:
    take_near(search);
    next_round(search);
    break;
  case NEXT_LOOK:
    carom_search_add_up(search);
    carom_search_lead(search, search->better);
    carom_search_sort(search, search->count);
    look_again(search);
    break;
  case NEXT_LEAVE:
    next_leave(search);
    break;
  case NEXT_SEARCH:
    search_leave(search);
    break;
  case NEXT_REPLAY:
    begin_list(search);
    break;
  case NEXT_LIST:
    replay_list(search);
    break;
  case NEXT_LISTED:
    carom_search_replayed(search);
    search->next = NEXT_ENDED;
    break;
  case NEXT_GENTLE:
    carom_search_add_up(search);
    hand_over(search);
    break;
  case NEXT_ENDED:
    break;
  }
}

void carom_search_begin(carom_search *search, int64_t shots) {
  enum { SHOTS_A_PLACE = 40, PLACES_LEAST = 6 };
  search->shots = shots;
  carom_search_find_goals(search);
  search->share = scan_share(search);
  search->scan = (int64_t)(search->share * (double)shots);
  if (search->cushions >= 0)
    search->scan += carom_min(2 * search->scan, SCAN_MORE);
  search->count = search->tried = 0;
  search->steered = 0;
  search->round = search->look = search->duels = 0;
  search->neighbours = -1;
  search->listed = 1;

  /* the first position */
  const int64_t raced = carom_max(shots / SHOTS_A_PLACE, PLACES_LEAST);
  search->raced = (int)carom_min(search->places, raced);
  search->place = -1;
  carom_search_next_place(search);
  if (!search->breaks) {
    carom_search_pots(search, pots_of(search));
    search->next = NEXT_AIMED;
    return;
  }
  carom_search_breaks(search, pots_of(search));
  while (search->place + 1 < search->raced) {
    carom_search_next_place(search);
    carom_search_breaks(search, pots_of(search));
  }
  carom_search_stage(search, 0, search->count, 1, 0);
  search->next = NEXT_TAKEN;
}

bool carom_search_run(carom_search *search) {
  while (search->next != NEXT_ENDED) {
    if (search->slice == 0 || !carom_search_play(search))
      return false;
    go_on(search);
  }
  return true;
}
