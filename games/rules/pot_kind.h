/* What a stroke was, in the names of the game. The command and the planner name strokes by it, and
 * the page, Python and JavaScript get the kinds that plans name. docs/using/glossary.md has the
 * same terms (docs/tests/terms.py compares them).
 *
 * The terms are from the glossaries of the BCA and the WPA. These do not exclude each other: a cue
 * ball can leave a cushion and drive one ball by another. One order of precedence therefore
 * decides, by what is between the tip and the pocket. Balls come before cushions, because they make
 * a stroke harder; and the driver of the ball precedes its own way to the pocket:
 *
 *   1. combination: another object ball drives the ball.
 *   2. carom: the cue ball drives it, and met another ball before.
 *   3. kiss: the cue ball drives it, and the ball glances off another ball on its way.
 *   4. kick: the cue ball drives it, and met a cushion before.
 *   5. rail first: the same, but the cushion is next to the ball.
 *   6. bank: the ball meets a cushion on its way.
 *   7. pot: none of these; the pot is direct.
 *
 * A ball is driven by the ball of its first contact; of several contacts of one instant the cue
 * ball's counts. A second contact with the cue ball is no kiss. Which cushions count is decided
 * once, where the facts of a shot are noted (carom_facts.approach and banked, facts.c), so rulings
 * and kinds agree. A jaw or a cut of a pocket is no cushion. A ball that touches a cushion from the
 * start is not driven to it (WPA rules of play, 8.4). A cushion that ends next to the pocket makes
 * no bank, because a ball that meets it and falls was on its way into that pocket.
 */
#ifndef CAROM_PLAN_POT_KIND_H
#define CAROM_PLAN_POT_KIND_H

#include "carom_plan.h"

#include <stdbool.h>

/* A term, and what it means: a sentence or two. A value of a plan that is no term of the game has
 * no meaning: "". */
typedef struct carom_term {
  const char *name, *meaning;
} carom_term;

/* The number of kinds of strokes. */
enum { CAROM_PLAN_KINDS = CAROM_PLAN_RAIL_FIRST + 1 };

/* Term k, or NULL beyond the last one. The first CAROM_PLAN_KINDS are the values of
 * carom_plan_kind. */
const carom_term *carom_term_of(int k);

/* Whether rules call it a double hit, with a push through a ball that was not frozen. */
bool carom_is_double_hit(const carom_facts *facts);

/* How the cue ball reached its first ball: CAROM_PLAN_KICK, RAIL_FIRST, or POT where it met that
 * ball directly. */
int32_t carom_approach_kind(const carom_facts *facts);

/* The number of object balls that met a cushion or are no longer on the table. */
int carom_driven(const carom_facts *facts, int cue_ball);

/* Whether an opening break is legal: a ball fell, or four object balls were driven to cushions. */
bool carom_is_break(const carom_facts *facts, int cue_ball);

#endif
