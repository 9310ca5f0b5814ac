/* What a choice does, by what happens: the events of the first of its strokes, without errors and
 * then with some, in which the ball that is named falls. */
#include "search.h"
#include "table/table.h"

typedef carom_search search;

/* The way by which a ball comes into a pocket, as a carom_plan_kind, or -1 where it does not. */
static int way_of(const carom_table *table, const carom_shot *shot, int cue_ball, int ball,
                  int pocket) {
  int by = -1, others = 0, before = 0, after = 0; /* who met the ball; what the cue ball met before,
                                                     and its cushions; the ball's cushions */
  for (int64_t k = 0; k < shot->count && k < shot->room; k++) {
    const carom_brief_event *e = &shot->brief[k];
    if (e->type == CAROM_EVENT_POCKET && e->a == ball)
      return by < 0 || e->b != pocket ? -1
             : before > 0             ? CAROM_PLAN_KICK
             : by != cue_ball         ? CAROM_PLAN_COMBINATION
             : others > 0             ? CAROM_PLAN_CAROM
             : after > 0              ? CAROM_PLAN_BANK
                                      : CAROM_PLAN_POT;
    const bool meets = e->type == CAROM_EVENT_BALL_BALL;
    const bool rail = e->type == CAROM_EVENT_RAIL && !carom_is_cut(table, e->b);
    if (meets && by < 0 && (e->a == ball || e->b == ball))
      by = e->a == ball ? e->b : e->a;
    else if (meets && by < 0)
      others += e->a == cue_ball || e->b == cue_ball;
    before += rail && e->a == cue_ball && by < 0 && others == 0;
    after += rail && e->a == ball && by >= 0;
  }
  return -1;
}

int32_t carom_search_kind(search *plan, const carom_candidate *c, const carom_choice *choice) {
  enum { TRIES = 8, EVENTS = sizeof plan->event / sizeof plan->event[0] };
  if (choice->kind != CAROM_PLAN_SCAN)
    return choice->kind;
  if (choice->ball < 0)
    return CAROM_PLAN_SAFETY;
  int ball = 0;
  while (plan->which[ball] != choice->ball)
    ball++;
  for (int64_t n = 0; n < TRIES; n++) {
    carom_facts facts;
    carom_shot shot = {.brief = plan->event, .room = EVENTS, .facts = &facts};
    const uint32_t draws = n == 0 ? 0 : DRAW_ROUND;
    carom_cue cue = carom_search_stroke(plan, c, draws, n);
    const carom_prepared layout = carom_search_layout(plan, draws, n);
    cue.ball = plan->cue_ball;
    carom_shoot_prepared(&layout, &cue, &shot);
    const int kind = plan->view.pockets > 0
                         ? way_of(plan->job.table, &shot, plan->cue_ball, ball, choice->pocket)
                     : facts.first[0] != ball || facts.first[1] < 0 ? -1
                     : facts.cushions_before[0] > 0                 ? CAROM_PLAN_KICK
                                                                    : CAROM_PLAN_CAROM;
    if (kind >= 0)
      return kind;
  }
  return CAROM_PLAN_SCAN;
}
