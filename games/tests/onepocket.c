/* One-pocket: what each player needs, and in which pocket. situations.txt has its rulings. */
#include "game_support.h"

TEST(left_in_onepocket) {
  for (int k = 0; k < 8 * 3; k++) {
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
    game_rules.state.score[0] = k / 3;
    game_rules.state.lost[1] = k % 3;
    int32_t needs[2];
    game_rules.left(&game_rules.state, 0xffff, needs);
    ck_assert(needs[0] == 8 - k / 3 && needs[1] == 8 + k % 3);
    ck_assert_uint_eq(game_rules.on(&game_rules.state, 0xff03), 0xff02);

    /* a miss gives the table, and with it the pocket, to the other */
    ck_assert_uint_eq(game_rules.pockets(&game_rules.state), 1U << MINE);
    const carom_facts miss = facts_of(3, 1, 0, 0);
    game_rules.judge(&game_rules.state, 0xffff, 0, &miss, (carom_call){NONE, -1});
    ck_assert_uint_eq(game_rules.pockets(&game_rules.state), 1U << HIS);
  }
}
