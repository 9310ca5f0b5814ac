/* The choice: sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013) of the candidates. All
 * of a round have the same errors, so that luck counts less than what they are worth. */
#include "search.h"
#include "platform/promise.h"

#include <math.h>
#include <string.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;
typedef carom_search search;

/* In round NEAR_ROUND strokes near the best PARENTS ones join. */
enum { ROUNDS = 4, NEAR_ROUND = 2, PARENTS = 1 };

static bool is_better(const candidate *a, const candidate *b) {
  if (a->round != b->round)
    return a->round > b->round;
  const double of_a = a->sum / (double)a->seen, of_b = b->sum / (double)b->seen;
  return of_a > of_b || (of_a == of_b && a->order < b->order);
}

/* Puts candidate k first if it is better than the first. */
static void lead(search *of, int64_t k) {
  if (is_better(&of->found[k], &of->found[0])) {
    const candidate first = of->found[0];
    of->found[0] = of->found[k];
    of->found[k] = first;
  }
}

static void name(candidate *c, const outcome *o) {
  c->ball = o->ball;
  c->pocket = o->pocket;
  c->cushions = o->cushions;
}

/* Where nothing is called, the pot that is named is the one that comes most often, by the vote of
 * R. S. Boyer and J S. Moore: with more than half of the pots, it is sure to be named. */
static void vote(candidate *c, const outcome *o) {
  if (o->ball < 0)
    return;
  if (c->votes == 0)
    name(c, o);
  c->votes += o->ball == c->ball && o->pocket == c->pocket ? 1 : -1;
}

void carom_search_take(search *of, int64_t k, const outcome *o) {
  CAROM_PROMISE(k >= 0 && k < of->count);
  candidate *c = &of->found[k];
  c->sum = o->worth;
  c->seen = 1;
  name(c, o);
  c->votes = c->pots = o->ball >= 0;
  c->own_ball = c->ball;
  c->own_pocket = c->pocket;
  c->own_cushions = c->cushions;
  c->foul = o->foul;
  lead(of, k);
}

/* Sorts the first n candidates, by Shell's method, without memory. The order is total, so that it
 * does not matter how it is found. To sort half a million takes longer than a plan has to stop; a
 * sort that is stopped leaves the first in its place if that is the best. */
static void sort(const search *of, int64_t n) {
  candidate *c = of->found;
  for (int64_t gap = n / 2; gap > 0; gap = gap == 2 ? 1 : (gap * 5) / 11)
    for (int64_t k = gap; k < n && !carom_is_stopped(of); k++) {
      const candidate moved = c[k];
      int64_t at = k;
      for (; at >= gap && is_better(&moved, &c[at - gap]); at -= gap)
        c[at] = c[at - gap];
      c[at] = moved;
    }
}

void carom_search_add_up(search *of) {
  const carom_stage *s = &of->stage;
  const int64_t n = s->rows / s->each, each = n == 1 ? s->done : s->each;
  CAROM_PROMISE(n >= 1 && n <= of->count && each >= 1 && s->rows <= of->room);
  for (int64_t k = 0; k < s->done / each; k++) {
    candidate *c = &of->found[k];
    if (c->round == 0) { /* the shot without errors is forgotten */
      c->sum = c->squares = 0.0;
      c->seen = c->foul = 0;
    }
    for (int64_t j = 0; j < each; j++) {
      const outcome *o = &of->outcome[k * each + j];
      if (!of->job.rules->calls && c->kind != CAROM_PLAN_PUSH)
        vote(c, o);
      c->sum += o->worth;
      c->squares += o->worth * o->worth;
      c->keep += o->is == CAROM_TURN_KEEP || o->is == CAROM_TURN_WIN;
      c->lose += o->is == CAROM_TURN_LOSE;
      c->foul += o->foul;
    }
    c->seen += each;
    c->round++;
  }
  for (int64_t k = 1; k < n; k++)
    lead(of, k);
}

/* The candidates of the first round: the best `keep`, of which pots come first, and a third of
 * `keep` of the scan; of tables without pockets the best. */
static int64_t first_round(search *of, int64_t keep) {
  const int64_t n = of->count < keep ? of->count : keep;
  int64_t scanned = 0, good = 0;
  for (int64_t k = 0; k < n; k++) {
    candidate *c = &of->found[k];
    const bool stays = c->kind == CAROM_PLAN_POT || of->breaks || of->view.pockets == 0 ||
                       scanned++ < (keep / 3 > 3 ? keep / 3 : 3);
    if (stays) {
      const candidate kept = *c;
      *c = of->found[good];
      of->found[good++] = kept;
    }
  }
  CAROM_PROMISE(good >= 1 && good <= n);
  return good;
}

/* A gentle stroke towards the nearest ball that is on: nothing better is known. */
static candidate gentle(const search *of) {
  const double *c = of->job.balls[of->view.cue_ball].state.r;
  double least = INFINITY, phi = 0.0;
  for (int k = 0; k < of->view.count; k++) {
    const double x = of->job.balls[k].state.r[0] - c[0], y = of->job.balls[k].state.r[1] - c[1];
    if ((of->on >> k & 1) && x * x + y * y < least) {
      least = x * x + y * y;
      phi = carom_angle_of(x, y) / degree;
    }
  }
  return (candidate){.speed = of->player.speed_least,
                     .phi = phi < 0.0 ? phi + 360.0 : phi,
                     .kind = CAROM_PLAN_FOUL,
                     .ball = -1,
                     .pocket = -1};
}

carom_choice carom_search_choice(const search *of, const candidate *c) {
  CAROM_PROMISE(c->seen > 0 || carom_is_stopped(of));
  const double n = (double)c->seen, mean = c->sum / n, variance = c->squares / n - mean * mean;
  const double error = c->seen > 1 && variance > 0.0 ? sqrt(variance / (n - 1.0)) : 0.0;
  /* The shots that chose a stroke were lucky for it, by about so much: the games of
   * understanding/plan.md tell it. What is not a number stays none. */
  const double luck = c->kind == CAROM_PLAN_GIVEN ? 0.0 : 0.75 * error, told = mean - luck;
  const double *place = of->job.balls[of->view.cue_ball].state.r;
  /* Luck alone names no pot: where most strokes with errors pot nothing, it is that without. A
   * direct pot is that of the ball that was aimed at. */
  const bool often = 2 * c->keep >= c->seen, own = c->pots && !often;
  const bool named = c->kind != CAROM_PLAN_BREAK && (c->ball < 0 || c->pots || often);
  const int ball = own ? c->own_ball : c->ball, pocket = own ? c->own_pocket : c->pocket;
  const bool aimed = named && ball == c->aimed_ball && pocket == c->aimed_pocket;
  carom_choice made = {.cue = *of->job.cue,
                       .place = {place[0], place[1]},
                       .kind = c->kind == CAROM_PLAN_POT && !aimed ? CAROM_PLAN_SCAN : c->kind,
                       .ball = named ? ball : -1,
                       .pocket = named ? pocket : -1,
                       .cushions = !named ? 0
                                   : own  ? c->own_cushions
                                          : c->cushions,
                       .value = told < 0.0 ? 0.0 : told,
                       .error = error,
                       .keep = (double)c->keep / n,
                       .foul = (double)c->foul / n,
                       .lose = (double)c->lose / n,
                       .seen = c->round > 0 && c->kind != CAROM_PLAN_PASS ? c->seen : 0};
  made.cue.speed = c->speed;
  made.cue.phi = c->phi;
  made.cue.theta = c->theta;
  made.cue.a = c->a;
  made.cue.b = c->b;
  return made;
}

double carom_scan_of(const carom_plan_options *o) {
  return o->scan == 0.0 ? 0.5 : o->scan > 0.0 ? o->scan : 0.0;
}

/* ---- The course of a search: each of these sets the next stage, and what comes after it */

/* Shots of the rounds. */
static int64_t left_for_rounds(const search *of) {
  return of->shots > of->count ? of->shots - of->count : 0;
}

/* Another pot that looks better than the best, after fewer strokes, is played as often as the best
 * in the last round before it is told. */
static void look_again(search *of) {
  enum { LOOKS = 2 };
  of->next = NEXT_ENDED;
  if (of->look == LOOKS || carom_is_stopped(of))
    return;
  const candidate *best = &of->found[0];
  double most = best->sum / (double)best->seen;
  of->better = 0;
  for (int64_t k = 1; k < of->count; k++) {
    const candidate *c = &of->found[k];
    const bool other = c->ball != best->ball || c->pocket != best->pocket;
    if (other && c->round > 0 && c->round < ROUNDS && c->sum / (double)c->seen > most) {
      of->better = k;
      most = c->sum / (double)c->seen;
    }
  }
  if (of->better == 0)
    return;

  /* it is played in the place of the best, with which it is compared then */
  const candidate first = of->found[0];
  of->found[0] = of->found[of->better];
  of->found[of->better] = first;
  of->found[0].round = ROUNDS - 1;
  int64_t each = left_for_rounds(of) / ROUNDS / 2;
  each = each < 2 ? 2 : each > of->room ? of->room : each;
  carom_search_stage(of, 0, 1, each, DRAW_ROUND + ROUNDS - 1);
  of->look++;
  of->next = NEXT_LOOK;
}

/* The candidates of a round that were in the one before. */
static int64_t in_round(search *of) {
  const int64_t keep = of->shots / 25 > 6 ? of->shots / 25 : 6;
  int64_t n = keep >> (2 * of->round);
  n = n < 2 ? 2 : n;
  return of->round == 0 ? first_round(of, n) : n < of->count ? n : of->count;
}

/* Strokes near the best are played once without errors. False where there are none. */
static bool add_near(search *of) {
  const int64_t first = of->count;
  of->near = 0;
  of->entered = in_round(of);
  carom_search_near(of, of->entered < PARENTS ? of->entered : PARENTS);
  if (of->count == first)
    return false;
  carom_search_stage(of, first, of->count - first, 1, 0);
  of->next = NEXT_NEAR;
  return true;
}

/* Those that meet a ball that is on come behind the candidates of the round, as if they had been in
 * all before; the others are left out. */
static void take_near(search *of) {
  const int64_t first = of->stage.first;
  for (int64_t k = 0; k < of->stage.done; k++) {
    if (!carom_search_begins_well(of, of->outcome[k].first))
      continue;
    carom_search_take(of, first + k, &of->outcome[k]);
    candidate c = of->found[first + k];
    c.sum = c.squares = 0.0;
    c.seen = c.keep = c.foul = c.lose = 0;
    c.round = (int16_t)of->round;
    of->found[first + of->near] = of->found[of->entered + of->near];
    of->found[of->entered + of->near++] = c;
  }
  of->count = first + of->near;
}

static void next_round(search *of) {
  if (of->round == ROUNDS || carom_is_stopped(of)) {
    look_again(of);
    return;
  }
  if (of->round == NEAR_ROUND && of->near < 0 && add_near(of))
    return;
  const int64_t n = of->round == NEAR_ROUND ? of->entered + of->near : in_round(of);
  int64_t each = left_for_rounds(of) / ROUNDS / n;
  each = each < 2 ? 2 : each;
  if (each * n > of->room)
    each = of->room / n;
  carom_search_stage(of, 0, n, each, DRAW_ROUND + (uint32_t)of->round);
  of->round++;
  of->next = NEXT_ROUND;
}

/* A block of the scan, or the first round behind the last one. */
static void scan(search *of) {
  if (carom_search_scan(of)) {
    of->next = NEXT_SCAN;
  } else if (of->count == 0) {
    carom_search_add(of, gentle(of));
    carom_search_stage(of, 0, 1, of->shots / 10, DRAW_ROUND);
    of->next = NEXT_GENTLE;
  } else {
    sort(of, of->count);
    next_round(of);
  }
}

static void go_on(search *of) {
  switch (of->next) {
  case NEXT_AIMED:
    carom_search_aimed(of);
    carom_search_stage(of, 0, of->count, 1, 0);
    of->next = NEXT_TAKEN;
    break;
  case NEXT_TAKEN:
    of->count = of->stage.done;
    for (int64_t k = 0; k < of->count; k++)
      carom_search_take(of, k, &of->outcome[k]);
    of->scan_end = of->count + of->scan;
    scan(of);
    break;
  case NEXT_SCAN:
    carom_search_scanned(of);
    scan(of);
    break;
  case NEXT_ROUND:
    carom_search_add_up(of);
    sort(of, of->count);
    next_round(of);
    break;
  case NEXT_NEAR:
    take_near(of);
    next_round(of);
    break;
  case NEXT_LOOK:
    carom_search_add_up(of);
    lead(of, of->better);
    sort(of, of->count);
    look_again(of);
    break;
  case NEXT_GENTLE:
    carom_search_add_up(of);
    of->next = NEXT_ENDED;
    break;
  case NEXT_ENDED:
    break;
  }
}

void carom_search_begin(search *of, int64_t shots) {
  const double share = of->breaks ? 0.0 : carom_scan_of(&of->options);
  const int64_t most = (int64_t)((1.0 - share) * (double)shots / 4.0);
  of->shots = shots;
  of->scan = (int64_t)(share * (double)shots);
  of->count = of->tried = 0;
  of->round = of->look = 0;
  of->near = -1;
  if (of->breaks) {
    carom_search_breaks(of, most);
    carom_search_stage(of, 0, of->count, 1, 0);
    of->next = NEXT_TAKEN;
  } else {
    carom_search_pots(of, most);
    of->next = NEXT_AIMED;
  }
}

bool carom_search_run(search *of) {
  while (of->next != NEXT_ENDED && carom_search_play(of))
    go_on(of);
  return of->next == NEXT_ENDED;
}

/* Not to play, as one more candidate: its worth is that of the layout to the other. */
void carom_search_pass(search *of) {
  uint64_t user[8];
  memcpy(user, of->job.rules->user, sizeof user);
  for (int k = 0; k < of->view.count; k++)
    of->state[k] = of->job.balls[k].state;
  const carom_call call = {CAROM_CALL_PASS, -1};
  of->job.rules->judge(user, of->in_play, of->view.cue_ball, &carom_no_facts, call);
  const double value = 1.0 - carom_value_of(&of->view, user, of->state, 1, false);
  carom_search_add(of, (candidate){.sum = value,
                                   .squares = value * value,
                                   .seen = 1,
                                   .kind = CAROM_PLAN_PASS,
                                   .ball = CAROM_CALL_PASS,
                                   .pocket = -1,
                                   .round = of->found[0].round});
  of->found[of->count - 1].order = -1; /* of shots that are worth as much, none is played */
  lead(of, of->count - 1);
  sort(of, of->count);
}
