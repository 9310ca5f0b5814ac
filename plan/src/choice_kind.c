/* The kind of a choice: that of the first of its strokes, without errors and then with some, in
 * which the ball that is named falls. */
#include "choice_kind.h"

#include "pot_kind.h"
#include "rows.h"

typedef carom_search search;

/* On a table without pockets: the kind of a stroke that meets the ball first and scores, or -1. */
static int32_t point_kind(const carom_facts *facts, int ball) {
  if (facts->first[0] != ball || facts->first[1] < 0)
    return -1;
  if (facts->cushions_before[0] > 0)
    return CAROM_PLAN_KICK;
  return CAROM_PLAN_CAROM;
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
    uint32_t draws = DRAW_ROUND;
    if (n == 0) /* without errors */
      draws = 0;
    carom_cue cue = carom_search_stroke(plan, c, draws, n);
    carom_ball_state struck;
    const carom_prepared layout = carom_search_layout(plan, c, draws, n, &struck);
    cue.ball = plan->cue_ball;
    carom_shoot_prepared(&layout, &cue, &shot);
    int32_t kind;
    if (plan->view.pockets > 0)
      kind = carom_pot_kind(plan->job.table, &shot, plan->cue_ball, ball, choice->pocket);
    else
      kind = point_kind(&facts, ball);
    if (kind >= 0)
      return kind;
  }
  return CAROM_PLAN_SCAN;
}
