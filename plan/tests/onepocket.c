/* One-pocket: every branch of its rules beside rulings written down. */
#include "game_support.h"

typedef struct onepocket_case {
  const char *what;
  uint32_t in_play; /* the others are down: those that do not count come back */
  int first, cushions;
  uint32_t mine, his, neutral, off; /* the cue ball is gone with bit 0 of neutral or off */
  int balls[2], owed[2], fouls;     /* before, of the one who plays and of the other; his fouls */
  int outcome, leave, foul;
  uint32_t spot;
  int balls_after[2], owed_after[2], fouls_after; /* of the same two */
} onepocket_case;

/* clang-format off */
static const onepocket_case onepocket[] = {
    {"a ball in his pocket", 0xffff, 3, 0, 8, 0, 0, 0, {0, 0}, {0, 0}, 2,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"two of them, off another", 0xffff, 9, 0, 0x18, 0, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {2, 0}, {0, 0}, 0},
    {"one in the pocket of the other", 0xffff, 3, 0, 0, 8, 0, 0, {0, 0}, {0, 0}, 1,
     PASS, AFTER, 0, 0, {0, 1}, {0, 0}, 0},
    {"one in each", 0xffff, 3, 0, 8, 0x10, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 1}, {0, 0}, 0},
    {"one in no one's", 0xfff9, 3, 0, 0, 0, 8, 0, {1, 1}, {0, 0}, 0,
     PASS, AFTER, 0, 8, {1, 1}, {0, 0}, 0},
    {"the same with one of his own", 0xffff, 3, 0, 0x10, 0, 8, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"one of the two comes back after a miss", 0xffe7, 5, 1, 0, 0, 0, 0, {1, 0}, {0, 0}, 0,
     PASS, AFTER, 0, 8, {1, 0}, {0, 0}, 0},
    {"and with it one that falls then", 0xffe7, 5, 1, 0, 0, 0x20, 0, {1, 0}, {0, 0}, 0,
     PASS, AFTER, 0, 0x28, {1, 0}, {0, 0}, 0},
    {"a safety to a cushion", 0xffff, 3, 1, 0, 0, 0, 0, {0, 0}, {0, 0}, 2,
     PASS, AFTER, 0, 0, {0, 0}, {0, 0}, 0},
    {"no cushion, without a ball to pay", 0xfff1, 4, 0, 0, 0, 0, 0, {0, 3}, {0, 0}, 0,
     PASS, AFTER, CUSHION, 0, {0, 3}, {1, 0}, 1},
    {"no ball met, with three", 0xfff1, -1, 0, 0, 0, 0, 0, {3, 0}, {0, 0}, 1,
     PASS, AFTER, NO_BALL, 2, {2, 0}, {0, 0}, 2},
    {"the cue ball falls with one of his", 0xffff, 3, 0, 8, 0, 1, 0, {0, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 8, {0, 0}, {1, 0}, 1},
    {"and leaves the table with one of the other", 0xffff, 3, 0, 0, 8, 0, 1, {0, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 8, {0, 0}, {1, 0}, 1},
    {"a ball off the table, others fall", 0xffff, 3, 1, 8, 0x10, 0, 0x20, {0, 0}, {0, 0}, 0,
     PASS, AFTER, OFF, 0x28, {0, 1}, {1, 0}, 1},
    {"a foul in a visit: what fell before, too", 0xffe3, 5, 0, 0, 0, 0, 0, {1, 1}, {0, 0}, 0,
     PASS, AFTER, CUSHION, 0xc, {0, 1}, {0, 0}, 1},
    {"a ball that is owed", 0xffff, 3, 0, 8, 0, 0, 0, {0, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {0, 0}, {0, 0}, 0},
    {"the next one counts", 0xfff7, 4, 0, 0x10, 0, 0, 0, {0, 0}, {0, 0}, 0,
     KEEP, AFTER, 0, 0, {1, 0}, {0, 0}, 0},
    {"one owed of three", 0xffff, 3, 0, 0x38, 0, 0, 0, {0, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {2, 0}, {0, 0}, 0},
    {"the other owes one", 0xffff, 3, 0, 0, 0x18, 0, 0, {0, 0}, {0, 1}, 0,
     PASS, AFTER, 0, 8, {0, 1}, {0, 0}, 0},
    {"the eighth", 0xff01, 9, 0, 0x200, 0, 0, 0, {7, 0}, {0, 0}, 0,
     WIN, AFTER, 0, 0, {8, 0}, {0, 0}, 0},
    {"the eighth pays a debt", 0xff01, 9, 0, 0x200, 0, 0, 0, {7, 0}, {1, 0}, 0,
     KEEP, AFTER, 0, 0, {7, 0}, {0, 0}, 0},
    {"the eighth of both", 0xc001, 14, 0, 0x4000, 0x8000, 0, 0, {7, 7}, {0, 0}, 0,
     WIN, AFTER, 0, 0, {8, 8}, {0, 0}, 0},
    {"the eighth on a foul", 0xff01, 9, 0, 0x200, 0, 1, 0, {7, 0}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 0x202, {6, 0}, {0, 0}, 1},
    {"the eighth of the other", 0xff01, 9, 0, 0, 0x200, 0, 0, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, 0, 0, {0, 8}, {0, 0}, 0},
    {"the same, and one of his", 0xff01, 9, 0, 0x400, 0x200, 0, 0, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, 0, 0, {1, 8}, {0, 0}, 0},
    {"the same, and the cue ball", 0xff01, 9, 0, 0, 0x200, 1, 0, {0, 7}, {0, 0}, 0,
     PASS, KITCHEN, CUE_BALL, 0x200, {0, 7}, {1, 0}, 1},
    {"the same, and a ball off the table", 0xff01, 9, 0, 0, 0x200, 0, 0x400, {0, 7}, {0, 0}, 0,
     LOSE, AFTER, OFF, 0, {0, 8}, {1, 0}, 1},
    {"a third foul", 0xfff1, -1, 0, 0, 0, 0, 0, {3, 0}, {0, 0}, 2,
     LOSE, AFTER, NO_BALL, 0, {2, 0}, {0, 0}, 3},
    {"the last ball: two that fell come back", 0x0009, 3, 0, 8, 0, 0, 0, {6, 6}, {0, 0}, 0,
     KEEP, AFTER, 0, 0x6, {7, 6}, {0, 0}, 0},
};
/* clang-format on */

TEST(onepocket_rulings) {
  for (size_t k = 0; k < sizeof onepocket / sizeof onepocket[0]; k++) {
    const onepocket_case *c = &onepocket[k];
    carom_facts facts = facts_of(c->first, c->cushions, c->mine | c->his | c->neutral, c->off);
    for (int ball = 0; ball < CAROM_BALLS_MOST; ball++)
      if (c->mine >> ball & 1)
        facts.pocket[ball] = MINE;
      else if (c->his >> ball & 1)
        facts.pocket[ball] = HIS;
      else if (facts.down >> ball & 1)
        facts.pocket[ball] = NEUTRAL;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
    ck_assert(of.state.pocket[0] == MINE && of.state.pocket[1] == HIS);
    ck_assert_uint_eq(of.pockets(&of.state), 1U << MINE);
    for (int who = 0; who < 2; who++) {
      of.state.score[who] = c->balls[who];
      of.state.lost[who] = c->owed[who];
    }
    of.state.fouls[0] = c->fouls;
    of.state.fouls[1] = 1;

    /* what each needs; then the ruling, and the state of whoever plays next */
    int32_t needs[2];
    of.left(&of.state, c->in_play, needs);
    for (int who = 0; who < 2; who++)
      ck_assert_msg(needs[who] == 8 - c->balls[who] + c->owed[who], "%s: left", c->what);
    const carom_turn turn = of.judge(&of.state, c->in_play, 0, &facts, (carom_call){NONE, -1});
    const int other = c->outcome == PASS ? 1 : 0;
    ruled(c->what, &turn, c->outcome, c->leave, c->foul, c->spot);
    for (int who = 0; who < 2; who++)
      ck_assert_msg(of.state.score[other ^ who] == c->balls_after[who] &&
                        of.state.lost[other ^ who] == c->owed_after[who],
                    "%s: balls %d, owed %d", c->what, of.state.score[other ^ who],
                    of.state.lost[other ^ who]);
    ck_assert_msg(of.state.fouls[other] == c->fouls_after && of.state.fouls[1 - other] == 1,
                  "%s: fouls", c->what);
    ck_assert_uint_eq(of.pockets(&of.state), 1U << (other ? HIS : MINE));
    ck_assert_uint_eq(of.on(&of.state, c->in_play), c->in_play & 0xfffe);
  }
}
