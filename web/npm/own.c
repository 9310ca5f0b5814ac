/* own.c: rules of a game that are written in JavaScript. The module imports their functions;
 * src/own.ts has them. The last word of a state says whose rules they are. */
#include <carom_plan.h>

#define IMPORTED(name) __attribute__((import_module("carom_own"), import_name(name))) extern

IMPORTED("on") carom_rules_on carom_own_on;
IMPORTED("judge") carom_rules_judge carom_own_judge;
IMPORTED("left") carom_rules_left carom_own_left;
IMPORTED("value") carom_rules_value carom_own_value;
IMPORTED("pockets") carom_rules_pockets carom_own_pockets;
IMPORTED("points") carom_rules_points carom_own_points;
IMPORTED("settle") carom_rules_settle carom_own_settle;

/* Rules with the functions of JavaScript, a state that is 0, and the methods of the set `has`: 1
 * value, 2 pockets, 4 points, 8 settle. The library has its own of the others. */
__attribute__((used)) void carom_own_rules(carom_plan_rules *rules, uint32_t has) {
  *rules = (carom_plan_rules){.on = carom_own_on, .judge = carom_own_judge, .left = carom_own_left};
  if ((has & 1) != 0)
    rules->value = carom_own_value;
  if ((has & 2) != 0)
    rules->pockets = carom_own_pockets;
  if ((has & 4) != 0)
    rules->points = carom_own_points;
  if ((has & 8) != 0)
    rules->settle = carom_own_settle;
}
