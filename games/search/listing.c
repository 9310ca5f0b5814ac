/* Choices. Shots that compare a stroke overestimate the one that they choose, so the reported
 * chances of a choice come from fresh shots, which were not used to choose. */
#include "listing.h"

#include "choice_kind.h"
#include "platform/promise.h"

#include <math.h>

typedef carom_candidate candidate;

/* A coach names no stroke that is much worse than the first one. */
static const double points_most = 0.1;
/* And no safety that fouls so often, nor such a soft opening. */
static const double foul_most = 0.25, opening_foul_most = 0.1;
enum { SAFETIES = 6 }; /* that are played anew, of which the best is listed */
/* A chance of fewer shots is none. */
enum { TOLD_LEAST = 20 };

/* The results of the shots of a candidate. */
typedef struct shot_chances {
  double value, error, keep, foul, lose;
} shot_chances;

static double mean_of(const carom_tally *t) {
  return t->sum / (double)t->seen;
}

/* The standard error of the mean of the worths. */
static double error_of(const carom_tally *t) {
  const double n = (double)t->seen;
  const double mean = mean_of(t);
  const double variance = t->squares / n - mean * mean;
  if (t->seen <= 1 || !(variance > 0.0))
    return 0.0;
  return sqrt(variance / (n - 1.0));
}

/* Some shots; NaN stays NaN. */
static shot_chances told_by(const carom_tally *t) {
  const double n = (double)t->seen;
  return (shot_chances){mean_of(t), error_of(t), (double)t->keep / n, (double)t->foul / n,
                        (double)t->lose / n};
}

/* The shots of a candidate. Fresh ones are few, so as many of those that chose as count `shots`
 * are next to them. */
static shot_chances told_of(const candidate *c) {
  static const double shots = 10.0;
  const shot_chances chose = told_by(&c->chose);
  if (c->fresh.seen == 0)
    return chose;
  const shot_chances fresh = told_by(&c->fresh);
  double used = 0.0;
  if (c->round > 0)
    used = fmin((double)c->chose.seen, shots);
  const double part = used / ((double)c->fresh.seen + used), rest = 1.0 - part;
  return (shot_chances){part * chose.value + rest * fresh.value, rest * fresh.error,
                        part * chose.keep + rest * fresh.keep,
                        part * chose.foul + rest * fresh.foul,
                        part * chose.lose + rest * fresh.lose};
}

/* A pot that a choice names; ball and pocket -1: none. */
typedef struct named_pot {
  int ball, pocket, cushions;
} named_pot;

/* Luck does not name a pot: if most strokes with errors pot nothing, the pot is the one of the shot
 * without errors. A break names none. */
static named_pot pot_of(const candidate *c) {
  const bool often = told_of(c).keep >= 0.5;
  const bool has_pot = c->ball < 0 || c->pots || often;
  if (c->kind == CAROM_PLAN_BREAK || !has_pot)
    return (named_pot){-1, -1, 0};
  if (c->pots && !often)
    return (named_pot){c->own_ball, c->own_pocket, c->own_cushions};
  return (named_pot){c->ball, c->pocket, c->cushions};
}

/* The kind of a candidate as far as the candidate determines it: a direct pot is one of the ball
 * that was aimed at, and any other pot is a find of the scan. */
static int kind_of(const candidate *c, const named_pot *pot) {
  const bool aimed = pot->ball == c->aimed_ball && pot->pocket == c->aimed_pocket;
  if (c->kind == CAROM_PLAN_POT && !aimed)
    return CAROM_PLAN_SCAN;
  return c->kind;
}

carom_plan_stroke carom_search_choice(const carom_search *search, const candidate *c) {
  const named_pot pot = pot_of(c);
  const shot_chances chances = told_of(c);

  /* by about so many standard errors a plan that was stopped overestimates what it has chosen */
  const bool strikes = c->kind != CAROM_PLAN_PASS;
  const bool lucky = c->fresh.seen == 0 && strikes && c->kind != CAROM_PLAN_GIVEN;
  double value = chances.value;
  if (lucky)
    value -= 0.75 * chances.error;
  if (value < 0.0)
    value = 0.0;
  const double unsure = (double)c->leave_error;
  carom_plan_stroke choice = {.cue = *search->job.cue,
                              .place = {c->r[0], c->r[1]},
                              .kind = kind_of(c, &pot),
                              .ball = pot.ball,
                              .pocket = pot.pocket,
                              .cushions = pot.cushions,
                              .value = value,
                              .error = sqrt(chances.error * chances.error + unsure * unsure),
                              .leave = {(double)c->leave[0], (double)c->leave[1]},
                              .keep = chances.keep,
                              .foul = chances.foul,
                              .lose = chances.lose};
  if (strikes)
    choice.seen = c->fresh.seen;
  if (strikes && c->round > 0)
    choice.seen += c->chose.seen;

  /* its stroke, by the caller's cue */
  choice.cue.speed = c->speed;
  choice.cue.phi = c->phi;
  choice.cue.theta = c->theta;
  choice.cue.a = c->a;
  choice.cue.b = c->b;
  return choice;
}

/* Whether two choices have the same ball, pocket and kind; for safeties, also about the same
 * direction. */
static bool is_same(const carom_search *search, const carom_plan_stroke *a,
                    const carom_plan_stroke *b) {
  static const double apart = 5.0; /* degrees */
  const double turn = fabs(a->cue.phi - b->cue.phi);
  const bool is_near = !search->only_safeties || fmin(turn, 360.0 - turn) <= apart;
  return a->ball == b->ball && a->pocket == b->pocket && a->kind == b->kind && is_near;
}

/* Whether n choices hold the same one. */
static bool has_same(const carom_search *search, const carom_plan_stroke *choices, int n,
                     const carom_plan_stroke *choice) {
  for (int k = 0; k < n; k++)
    if (is_same(search, &choices[k], choice))
      return true;
  return false;
}

/* The result of a candidate, with its kind. */
static carom_plan_stroke with_kind(carom_search *search, candidate *c) {
  carom_plan_stroke choice = carom_search_choice(search, c);
  choice.kind = carom_search_kind(search, c, &choice);
  return choice;
}

/* Whether a candidate is worth a position in the list. A candidate that was not played has no
 * result; a candidate without a ball is not listed for a single player; and a candidate that looks
 * better than the best was played too seldom. */
static bool is_listed(const carom_search *search, const candidate *c) {
  const candidate *best = &search->found[0];
  const bool alone = search->job.rules->race == CAROM_RACE_ALONE && !search->breaks;
  if (c->kind == CAROM_PLAN_PASS)
    return true;
  if (c->round == 0 || (alone && pot_of(c).ball < 0))
    return false;
  if (search->only_safeties && carom_luck * c->chose.seen < c->chose.keep)
    return false;
  const double mean = mean_of(&c->chose), best_mean = mean_of(&best->chose);
  return mean >= best_mean - points_most && !(mean > best_mean && c->round < best->round);
}

static void swap(candidate *a, candidate *b) {
  const candidate first = *a;
  *a = *b;
  *b = first;
}

/* The same of a candidate. */
static bool is_safety(const candidate *c) {
  return c->kind == CAROM_PLAN_SCAN && pot_of(c).ball == -1 && told_of(c).keep < carom_luck;
}

/* Puts the safeties that look best, of those that are not listed, behind the list. */
static void list_safeties(carom_search *search) {
  for (int n = 0; n < SAFETIES; n++) {
    int64_t best = -1;
    for (int64_t k = search->listed; k < search->count; k++) {
      const candidate *c = &search->found[k];
      const bool safe = is_safety(c) && 2 * c->chose.foul < c->chose.seen;
      if (safe && (best < 0 || mean_of(&c->chose) > mean_of(&search->found[best].chose)))
        best = k;
    }
    if (best < 0)
      return;
    swap(&search->found[search->listed++], &search->found[best]);
  }
}

bool carom_search_list(carom_search *search) {
  carom_plan_stroke *listed = search->listing; /* the stack is for shots */
  for (int k = 0; k < search->listed; k++)
    listed[k] = with_kind(search, &search->found[k]);
  for (; search->examined < search->count && search->listed < search->choices_most;
       search->examined++) {
    if (search->slice == 0)
      return false;
    candidate *c = &search->found[search->examined];
    if (!is_listed(search, c))
      continue;
    listed[search->listed] = with_kind(search, c);
    if (!has_same(search, listed, search->listed, &listed[search->listed]))
      swap(&search->found[search->listed++], c);
  }

  bool safe = false;
  for (int k = 0; k < search->listed; k++)
    safe |= listed[k].kind == CAROM_PLAN_SAFETY;
  const bool alone = search->job.rules->race == CAROM_RACE_ALONE;
  if (search->choices_most > 1 && !safe && !alone && !search->breaks && search->view.pockets > 0)
    list_safeties(search);
  return true;
}

/* Sorts a choice in behind n choices, the best first; of two of one value the one that keeps the
 * turn more often, then the earlier, is first. */
static void sort_in(carom_plan_stroke *choices, int n, const carom_plan_stroke *choice) {
  int index = n;
  for (; index > 1; index--) {
    const carom_plan_stroke *previous = &choices[index - 1];
    const bool better = choice->value > previous->value ||
                        (choice->value == previous->value && choice->keep > previous->keep);
    if (!better)
      break;
    choices[index] = *previous;
  }
  choices[index] = *choice;
}

/* A first choice that was worth nothing in its fresh shots gives its position to one that was worth
 * something in its own: small plans of carom games chose strokes that make no point. */
static void promote(carom_plan_stroke *first, carom_plan_stroke *second) {
  if (first->value > 0.0 || second->value <= 0.0)
    return;
  const carom_plan_stroke demoted = *first;
  *first = *second;
  *second = demoted;
}

int carom_search_give(carom_search *search, carom_plan_stroke *choices, int room) {
  carom_plan_stroke choice_list[LISTED_MOST + SAFETIES];
  int n = 0, written = 0;
  for (int k = 0; k < carom_max(search->listed, 1) && !(n > 0 && carom_is_stopped(search)); k++) {
    carom_plan_stroke choice = with_kind(search, &search->found[k]);
    if (n > 0) {
      bool risky = choice.kind == CAROM_PLAN_SAFETY && choice.foul > foul_most;
      if (search->breaks && choice.kind != CAROM_PLAN_BREAK)
        risky = choice.foul > opening_foul_most;
      if ((choice.seen < TOLD_LEAST && choice.kind != CAROM_PLAN_PASS) || risky)
        continue;
      promote(&choice_list[0], &choice);
      choice.value = fmin(choice.value, choice_list[0].value);
    }
    sort_in(choice_list, n++, &choice);
  }

  /* the best of each ball, pocket and kind; the best safety takes the last position at least, and a
   * player who may pass is offered this */
  for (int k = 0; k < n; k++) {
    const bool safety = choice_list[k].kind == CAROM_PLAN_SAFETY;
    const bool is_close = choice_list[k].value >= choice_list[0].value - points_most ||
                          choice_list[k].kind == CAROM_PLAN_PASS;
    if (has_same(search, choices, written, &choice_list[k]) || !(is_close || safety))
      continue;
    if (written < room)
      choices[written++] = choice_list[k];
    else if (safety && room > 1)
      choices[room - 1] = choice_list[k];
  }
  return written;
}
