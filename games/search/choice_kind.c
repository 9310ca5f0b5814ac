/* The kind of a choice: the kind of the first of its strokes, without errors and then with some, in
 * which the named ball falls. */
#include "choice_kind.h"

#include "pot_kind.h"
#include "random_draws.h"
#include "rows.h"

/* On a table without pockets: the kind of a stroke that meets the ball first and scores, or -1. */
static int32_t point_kind(const carom_facts *facts, int ball) {
  if (facts->first[0] != ball || facts->first[1] < 0)
    return -1;
  const int32_t approach = carom_approach_kind(facts);
  if (approach == CAROM_PLAN_POT)
    return CAROM_PLAN_CAROM;
  return approach;
}

/* The kind by which a stroke of the scan pots the ball that a choice names. */
static int32_t seen_kind(carom_search *search, const carom_candidate *c,
                         const carom_plan_stroke *choice) {
  enum { TRIES = 8, EVENTS = sizeof search->event / sizeof search->event[0] };
  int ball = 0;
  while (search->layout_ball[ball] != choice->ball)
    ball++;
  for (int64_t n = 0; n < TRIES; n++) {
    carom_facts facts;
    carom_shot shot = {.brief = search->event, .room = EVENTS, .facts = &facts};
    uint32_t draws = DRAW_ROUND;
    if (n == 0) /* without errors */
      draws = 0;
    carom_cue cue = carom_search_stroke(search, c, draws, n);
    carom_ball_state drawn[CAROM_BALLS_MOST];
    const carom_prepared layout = carom_search_layout(search, c, draws, n, drawn);
    cue.ball = search->cue_ball;
    carom_shoot_prepared(&layout, &cue, &shot);
    carom_search_spend(search, shot.count);
    int32_t kind;
    if (search->view.pockets > 0 && choice->pocket >= 0)
      kind = carom_pot_kind(&shot, search->cue_ball, ball, choice->pocket);
    else
      kind = point_kind(&facts, ball);
    if (kind >= 0)
      return kind;
  }
  return CAROM_PLAN_SCAN;
}

int32_t carom_search_kind(carom_search *search, carom_candidate *c,
                          const carom_plan_stroke *choice) {
  if (choice->kind != CAROM_PLAN_SCAN)
    return choice->kind;
  if (choice->ball < 0 && choice->keep < carom_luck)
    return CAROM_PLAN_SAFETY;
  if (choice->ball < 0)
    return CAROM_PLAN_SCAN;
  const bool is_seen = c->seen_kind > 0 && c->seen_ball == choice->ball;
  if (!is_seen || c->seen_pocket != choice->pocket) {
    c->seen_kind = (int16_t)(1 + seen_kind(search, c, choice));
    c->seen_ball = (int16_t)choice->ball;
    c->seen_pocket = (int16_t)choice->pocket;
  }
  return c->seen_kind - 1;
}
