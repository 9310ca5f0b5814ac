/* Snooker: every branch of its rules beside rulings written down, spots and free balls. */
#include "game_support.h"

typedef struct snooker_case {
  const char *what;
  uint32_t in_play;
  int colour, after_foul, first;
  uint32_t down, off;
  int call;
  int outcome, leave, foul, own, other; /* points made, by each */
  uint32_t spot;
  int colour_next, after_foul_next;
} snooker_case;

static const snooker_case snooker[] = {
    {"a red", ALL, 0, 0, 1, R1, 0, 1, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"two reds", ALL, 0, 0, 3, R1 | R2, 0, NONE, KEEP, AFTER, 0, 2, 0, 0, 1, 0},
    {"a miss at the reds", ALL, 0, 0, 1, 0, 0, 1, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"a red without a cushion is none", ALL, 0, 0, 2, 0, 0, NONE, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"no ball, on reds", ALL, 0, 0, -1, 0, 0, NONE, PASS, AFTER, NO_BALL, 0, 4, 0, 0, MAY},
    {"the yellow first, on reds", ALL, 0, 0, YELLOW, 0, 0, 1, PASS, AFTER, FIRST, 0, 4, 0, 0, MAY},
    {"the black first, on reds", ALL, 0, 0, BLACK, 0, 0, 1, PASS, AFTER, FIRST, 0, 7, 0, 0, MAY},
    {"the black falls, on reds", ALL, 0, 0, 1, BK, 0, 1, PASS, AFTER, POT, 0, 7, BK, 0, MAY},
    {"a red and the blue", ALL, 0, 0, 1, R1 | BL, 0, 1, PASS, AFTER, POT, 0, 5, BL, 0, MAY},
    {"a red, the cue ball", ALL, 0, 0, 1, R1 | 1, 0, 1, PASS, D, CUE_BALL, 0, 4, 0, 0, MAY | HAND},
    {"the cue ball is off", ALL, 0, 0, 1, 0, 1, 1, PASS, D, CUE_BALL, 0, 4, 0, 0, MAY | HAND},
    {"a red leaves the table", ALL, 0, 0, 1, 0, R2, 1, PASS, AFTER, OFF, 0, 4, 0, 0, MAY},
    {"the pink leaves the table", ALL, 0, 0, 1, 0, PI, 1, PASS, AFTER, OFF, 0, 6, PI, 0, MAY},

    {"the black after a red", ALL & ~R1, 1, 0, BLACK, BK, 0, BLACK, KEEP, AFTER, 0, 7, 0, BK, 0, 0},
    {"a colour without a call", ALL & ~R1, 1, 0, BLUE, BL, 0, NONE, KEEP, AFTER, 0, 5, 0, BL, 0, 0},
    {"another colour than named", ALL & ~R1, 1, 0, BLUE, BL, 0, BLACK, PASS, AFTER, FIRST, 0, 7, BL,
     0, MAY},
    {"the black first, the yellow named", ALL & ~R1, 1, 0, BLACK, 0, 0, YELLOW, PASS, AFTER, FIRST,
     0, 7, 0, 0, MAY},
    {"a red first, the yellow named", ALL & ~R1, 1, 0, 2, 0, 0, YELLOW, PASS, AFTER, FIRST, 0, 4, 0,
     0, MAY},
    {"two fall", ALL & ~R1, 1, 0, GREEN, G | PI, 0, GREEN, PASS, AFTER, POT, 0, 6, G | PI, 0, MAY},
    {"a red with the colour", ALL & ~R1, 1, 0, GREEN, G | R2, 0, GREEN, PASS, AFTER, POT, 0, 4, G,
     0, MAY},
    {"the cue ball with the black", ALL & ~R1, 1, 0, BLACK, BK | 1, 0, BLACK, PASS, D, CUE_BALL, 0,
     7, BK, 0, MAY | HAND},
    {"a miss at the colour", ALL & ~R1, 1, 0, PINK, 0, 0, PINK, PASS, AFTER, 0, 0, 0, 0, 0, 0},
    {"no ball, the brown named", ALL & ~R1, 1, 0, -1, 0, 0, BROWN, PASS, AFTER, NO_BALL, 0, 4, 0, 0,
     MAY},
    {"no ball, none named", ALL & ~R1, 1, 0, -1, 0, 0, NONE, PASS, AFTER, NO_BALL, 0, 7, 0, 0, MAY},
    {"a colour after the last red", COLOURS | 1, 1, 0, YELLOW, Y, 0, YELLOW, KEEP, AFTER, 0, 2, 0,
     Y, 0, 0},

    {"the yellow in order", COLOURS | 1, 0, 0, YELLOW, Y, 0, YELLOW, KEEP, AFTER, 0, 2, 0, 0, 0, 0},
    {"the green early", COLOURS | 1, 0, 0, GREEN, G, 0, GREEN, PASS, AFTER, FIRST, 0, 4, G, 0, MAY},
    {"the green next", (COLOURS & ~Y) | 1, 0, 0, GREEN, G, 0, NONE, KEEP, AFTER, 0, 3, 0, 0, 0, 0},
    {"the brown with the green", (COLOURS & ~Y) | 1, 0, 0, GREEN, G | BR, 0, GREEN, PASS, AFTER,
     POT, 0, 4, G | BR, 0, MAY},
    {"none, the pink on", PI | BK | 1, 0, 0, -1, 0, 0, NONE, PASS, AFTER, NO_BALL, 0, 6, 0, 0, MAY},

    {"a free ball falls", ALL, 0, MAY | FREE, BROWN, BR, 0, BROWN, KEEP, AFTER, 0, 1, 0, BR, 1, 0},
    {"a free ball, a red", ALL, 0, FREE, BROWN, BR | R1, 0, BROWN, KEEP, AFTER, 0, 2, 0, BR, 1, 0},
    {"a red by a free ball", ALL, 0, FREE, BROWN, R1, 0, BROWN, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"the red, with a free ball", ALL, 0, FREE, 1, R1, 0, 1, KEEP, AFTER, 0, 1, 0, 0, 1, 0},
    {"a red, the brown named", ALL, 0, FREE, 1, R1, 0, BROWN, PASS, AFTER, FIRST, 0, 4, 0, 0, MAY},
    {"the black as a free ball, missed", ALL, 0, FREE, -1, 0, 0, BLACK, PASS, AFTER, NO_BALL, 0, 4,
     0, 0, MAY},
    {"the blue as a free ball, off the table", ALL, 0, FREE, BLUE, 0, BL, BLUE, PASS, AFTER, OFF, 0,
     4, BL, 0, MAY},
    {"another colour with the free ball", ALL, 0, FREE, BROWN, BR | PI, 0, BROWN, PASS, AFTER, POT,
     0, 6, BR | PI, 0, MAY},
    {"a free ball for the yellow", COLOURS | 1, 0, FREE, BLACK, BK, 0, BLACK, KEEP, AFTER, 0, 2, 0,
     BK, 0, 0},
    {"both, of colours", COLOURS | 1, 0, FREE, BLACK, BK | Y, 0, BLACK, KEEP, AFTER, 0, 2, 0, BK, 0,
     0},
    {"the yellow by a free ball", COLOURS | 1, 0, FREE, BLACK, Y, 0, BLACK, KEEP, AFTER, 0, 2, 0, 0,
     0, 0},
    {"a free ball without a call", ALL, 0, FREE, BLUE, BL, 0, NONE, KEEP, AFTER, 0, 1, 0, BL, 1, 0},
};

TEST(snooker_rulings) {
  for (size_t k = 0; k < sizeof snooker / sizeof snooker[0]; k++) {
    const snooker_case *c = &snooker[k];
    const carom_facts facts = facts_of(c->first, 0, c->down, c->off);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.on = c->colour;
    of.state.score[0] = 20;
    of.state.score[1] = 30;
    of.state.may = c->after_foul;
    const carom_turn turn = of.judge(&of.state, c->in_play, 0, &facts, (carom_call){c->call, -1});
    ruled(c->what, &turn, c->outcome, c->leave, c->foul, c->spot);
    const bool gives = c->outcome == PASS;
    ck_assert_msg(of.state.score[gives] == 20 + c->own && of.state.score[!gives] == 30 + c->other,
                  "%s: scores %d, %d", c->what, of.state.score[0], of.state.score[1]);
    ck_assert_msg(of.state.on == c->colour_next && of.state.may == c->after_foul_next,
                  "%s: colour %d, after a foul %d", c->what, of.state.on, of.state.may);
    ck_assert_msg(turn.points == (double)c->own, "%s", c->what);
  }
}

/* What is on. */
TEST(snooker_on) {
  static const struct {
    uint32_t in_play;
    int colour, after_foul;
    uint32_t on;
  } given[] = {
      {ALL, 0, 0, 0xfffe},          {ALL & ~R1, 1, 0, COLOURS},      {ALL, 0, FREE, ALL & ~1},
      {COLOURS | 1, 1, 0, COLOURS}, {COLOURS | 1, 0, 0, Y},          {PI | BK | 1, 0, MAY, PI},
      {BK | 1, 0, 0, BK},           {COLOURS | 1, 0, FREE, COLOURS}, {COLOURS | R2 | 1, 0, 0, R2}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.on = given[k].colour;
    of.state.may = given[k].after_foul;
    ck_assert_uint_eq(of.on(&of.state, given[k].in_play), given[k].on);
  }
}

/* The last black, by the scores. */
TEST(snooker_ends) {
  static const struct {
    const char *what;
    int own, other, first;
    uint32_t down;
    int outcome, leave;
    uint32_t spot;
  } given[] = {{"wins", 50, 56, BLACK, BK, WIN, AFTER, 0},
               {"is not enough", 50, 58, BLACK, BK, LOSE, AFTER, 0},
               {"draws level", 50, 57, BLACK, BK, PASS, D, BK},
               {"a foul loses", 50, 50, -1, 0, LOSE, AFTER, 0},
               {"a foul in the lead", 60, 50, BLACK, 1, WIN, AFTER, 0},
               {"a foul draws level", 57, 50, -1, 0, PASS, D, BK},
               {"potted with the cue ball", 52, 50, BLACK, BK | 1, LOSE, AFTER, 0},
               {"a miss", 50, 50, BLACK, 0, PASS, AFTER, 0},
               {"a miss, seven behind", 50, 57, BLACK, 0, PASS, AFTER, 0},
               {"a miss, and the other claims", 50, 58, BLACK, 0, LOSE, AFTER, 0}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const carom_facts facts = facts_of(given[k].first, 0, given[k].down, 0);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.score[0] = given[k].own;
    of.state.score[1] = given[k].other;
    const carom_turn turn = of.judge(&of.state, BK | 1, 0, &facts, (carom_call){BLACK, -1});
    ck_assert_msg((int)turn.outcome == given[k].outcome && (int)turn.leave == given[k].leave &&
                      turn.spot == given[k].spot,
                  "%s: turn %d, leave %d, spot %x", given[k].what, (int)turn.outcome,
                  (int)turn.leave, turn.spot);
    /* a black that comes back begins anew: nobody may pass */
    ck_assert_int_eq(of.state.may, 0);
  }
}

/* The pink leaves the last black: with more than seven points ahead the frame is claimed. */
TEST(snooker_claim) {
  for (int other = 43; other < 52; other++) {
    const carom_facts facts = facts_of(PINK, 0, PI, 0);
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.score[0] = 44;
    of.state.score[1] = other;
    const carom_turn turn = of.judge(&of.state, PI | BK | 1, 0, &facts, (carom_call){PINK, -1});
    ck_assert_int_eq((int)turn.outcome, 44 + 6 > other + 7 ? WIN : KEEP);
    ck_assert(turn.points == 6.0 && turn.foul == 0 && turn.spot == 0 && of.state.score[0] == 50);
  }
}

/* A ball that is met while the tip is on the cue ball: `frozen` before the stroke, `pushed` in it.
 * In snooker reds are on. Before the same shot without a touch of a cushion, and after a loss. */
TEST(double_hits) {
  static const struct {
    const char *what;
    uint32_t frozen, pushed;
    int touches, pool, snooker, three;
  } given[] = {{"as usual", 0, 0, 1, LEGAL, LEGAL, LEGAL},
               {"through a frozen ball", R1, R1, 1, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"the same, touched twice", R1, R1, 2, LEGAL, DOUBLE_HIT, DOUBLE_HIT},
               {"away from it", R1, 0, 1, LEGAL, LEGAL, LEGAL},
               {"a near ball", 0, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball, touched twice", 0, R1, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"a near ball beside a frozen one", R2, R1, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"one of each", R2, R1 | R2, 1, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT},
               {"touched twice, with no ball", 0, 0, 2, DOUBLE_HIT, DOUBLE_HIT, DOUBLE_HIT}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts f = facts_of(1, 1, 0, 0), other = f;
    f.frozen = given[k].frozen;
    f.pushed = given[k].pushed;
    f.touches = given[k].touches;
    ck_assert_msg((int)carom_foul_of(&f, R1, 0) == given[k].pool, "%s", given[k].what);
    for (int game = 0; carom_rules_about_of((carom_rules_kind)game) != NULL; game++) {
      if (game == CAROM_RULES_FOURBALL)
        continue; /* ball 1 may not be met */
      carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)game);
      int foul = given[k].pool;
      if (game == CAROM_RULES_SNOOKER || game == CAROM_RULES_BLACKBALL)
        foul = given[k].snooker;
      else if (game == CAROM_RULES_THREECUSHION || game == CAROM_RULES_STRAIGHTRAIL)
        foul = given[k].three;
      const carom_turn turn = rules.judge(&rules.state, 0xffff, 0, &f, (carom_call){NONE, -1});
      ck_assert_msg((int)turn.foul == foul, "%s: %s", carom_word(CAROM_WORDS_RULES, game),
                    given[k].what);
    }

    /* before a cushion, after a ball that is not on, and in a push-out too */
    f.cushions_after = other.cushions_after = 0;
    ck_assert_int_eq(carom_foul_of(&f, R1, 0), given[k].pool == LEGAL ? CUSHION : DOUBLE_HIT);
    ck_assert_int_eq(carom_foul_of(&f, R2, 0), FIRST);
    carom_plan_rules nine = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    nine.state.may = CAROM_MAY_PUSH;
    ck_assert_int_eq(nine.judge(&nine.state, 0x3ff, 0, &f, (carom_call){CAROM_CALL_PUSH, -1}).foul,
                     given[k].pool);
  }
}

/* A cue ball that flies over a ball before it meets one is a foul in snooker (WPBSA, section 2,
 * rule 19), which costs what the ball that it flew over is worth. */
TEST(snooker_jumps) {
  static const struct {
    const char *what;
    double theta, speed, x, at[2]; /* how far beside the way the blue is; of the red and the blue */
    uint32_t jumped;
    int foul, other;
  } given[] = {{"over the blue", 30.0, 4.0, 0.0, {1.0, 0.35}, UINT32_C(1) << BLUE, JUMP, 5},
               {"beside it", 30.0, 4.0, 0.06, {1.0, 0.35}, 0, LEGAL, 0},
               {"level, with the blue behind", 0.0, 4.0, 0.0, {0.3, 0.9}, 0, LEGAL, 0}};
  carom_table_make(CAROM_TABLE_SNOOKER, &table);
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_rack(CAROM_RACK_SNOOKER, &table, 1e-4, 1, balls, 22);
    for (int ball = 2; ball < 22; ball++)
      balls[ball].state.label = CAROM_BALL_POCKETED;
    const double x = 0.5 * table.width;
    carom_place_ball(&table, balls, 22, 0, x, 1.0, NULL);
    carom_place_ball(&table, balls, 22, 1, x, 1.0 + given[k].at[0], NULL);
    carom_place_ball(&table, balls, 22, BLUE, x + given[k].x, 1.0 + given[k].at[1], NULL);
    carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
    cue.speed = given[k].speed;
    cue.theta = given[k].theta;
    cue.a = cue.b = 0.0;
    carom_facts facts;
    carom_ball_state final[22];
    carom_shot shot = {.facts = &facts, .final = final};
    ck_assert_int_eq(carom_shoot(&table, balls, 22, &cue, NULL, &shot), CAROM_OK);
    ck_assert_msg(facts.jumped == given[k].jumped && facts.first[0] == 1, "%s: %x, %d",
                  given[k].what, facts.jumped, (int)facts.first[0]);
    const carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    carom_ruling ruling;
    carom_referee(&rules, &table, balls, 22, 0, &shot, (carom_call){NONE, -1}, &ruling);
    ck_assert_msg(ruling.turn.foul == given[k].foul, "%s: %d", given[k].what,
                  (int)ruling.turn.foul);
    ck_assert_int_eq(ruling.state.score[0], given[k].other);
  }
}

/* A ball on that touches the cue ball has been met by who plays away from it, whatever comes then;
 * of colours only the one that is named. A push costs what the ball is worth. */
TEST(snooker_touching) {
  static const struct {
    const char *what;
    int colour, first, call;
    uint32_t frozen, pushed;
    int foul, other;
  } given[] = {{"no other", 0, -1, NONE, R2, 0, LEGAL, 0},
               {"then a colour", 0, PINK, NONE, R2, 0, LEGAL, 0},
               {"a colour that is not on", 0, -1, NONE, PI, 0, NO_BALL, 4},
               {"the colour named", 1, -1, PINK, PI, 0, LEGAL, 0},
               {"the colour not named", 1, -1, BLUE, PI, 0, NO_BALL, 5},
               {"none named", 1, -1, NONE, PI, 0, LEGAL, 0},
               {"the red pushed", 0, 2, NONE, R2, R2, DOUBLE_HIT, 4},
               {"the pink pushed behind a red", 0, 1, NONE, 0, R1 | PI, DOUBLE_HIT, 6}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts f = facts_of(given[k].first, 0, 0, 0);
    f.frozen = given[k].frozen;
    f.pushed = given[k].pushed;
    f.touches = 1;
    carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    rules.state.on = given[k].colour;
    const carom_turn turn = rules.judge(&rules.state, ALL, 0, &f, (carom_call){given[k].call, -1});
    ck_assert_msg((int)turn.foul == given[k].foul, "%s", given[k].what);
    ck_assert_msg(rules.state.score[0] == given[k].other, "%s", given[k].what); /* his turn now */
  }
}

/* After a foul the other may let the offender play again, from hand if the cue ball was; and has no
 * free ball then. */
TEST(snooker_again) {
  for (int hand = 0; hand < 2; hand++) {
    const carom_facts none = {.first = {-1, -1}};
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.score[0] = 9;
    of.state.may = (MAY | FREE | (hand ? HAND : 0));
    ck_assert_int_eq(of.state.may & CAROM_MAY_PASS, CAROM_MAY_PASS);
    const carom_turn turn = of.judge(&of.state, ALL, 0, &none, (carom_call){CAROM_CALL_PASS, -1});
    ck_assert(turn.outcome == CAROM_TURN_PASS && turn.foul == 0 && turn.spot == 0);
    ck_assert_int_eq(turn.leave, hand ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER);
    ck_assert(of.state.score[1] == 9 && of.state.may == 0 && of.on(&of.state, ALL) == 0xfffe);
    /* without the right it is a stroke that meets nothing */
    ck_assert_int_eq(of.judge(&of.state, ALL, 0, &none, (carom_call){CAROM_CALL_PASS, -1}).foul,
                     CAROM_FOUL_NO_BALL);
  }
}

/* Colours go to their own spots; to the highest free one; and where none is free, towards the top
 * cushion, or away from it. */
TEST(snooker_spots) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1);
  const double l = table.length, R = balls[1].kind.radius;
  double spot[BALLS_MOST][2];
  for (int k = 0; k < BALLS_MOST; k++)
    ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, k, spot[k]), CAROM_OK);
  ck_assert(spot[YELLOW][0] > spot[BROWN][0] && spot[GREEN][0] < spot[BROWN][0]);
  ck_assert(spot[BLUE][1] == 0.5 * l && spot[PINK][1] == 0.75 * l);
  ck_assert(fabs(l - spot[BLACK][1] - 0.324) < 1e-3);
  for (int k = YELLOW; k <= BLACK; k++) {
    ck_assert_int_eq(carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, k), CAROM_OK);
    ck_assert(is_at(k, spot[k][0], spot[k][1]));
  }

  /* the brown's is taken: the black's is free, and the highest */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1);
  put(1, spot[BROWN][0] + R, spot[BROWN][1]);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BROWN);
  ck_assert(is_at(BROWN, spot[BLACK][0], spot[BLACK][1]));
  /* now the blue's is taken, too: the pink's is the highest free one */
  put(2, spot[BLUE][0], spot[BLUE][1] - R);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BLUE);
  ck_assert(is_at(BLUE, spot[PINK][0], spot[PINK][1]));

  /* none is free: by reds on all spots */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | 0x7e);
  for (int k = YELLOW; k <= BLACK; k++)
    put(k - YELLOW + 1, spot[k][0], spot[k][1]);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, PINK);
  const double *r = balls[PINK].state.r;
  ck_assert(r[0] == spot[PINK][0] && r[1] > spot[PINK][1] + 2.0 * R - 1e-9 &&
            r[1] < spot[PINK][1] + 2.0 * R + 2e-3);
  /* nor between the black's and the cushion */
  for (int k = 0; k < 5; k++)
    put(7 + k, spot[BLACK][0], spot[BLACK][1] + 2.0 * R * (k + 1) + 0.01);
  carom_spot_ball_of(CAROM_RACK_SNOOKER, &table, balls, count, BLACK);
  r = balls[BLACK].state.r;
  ck_assert(r[0] == spot[BLACK][0] && r[1] < spot[BLACK][1] - 2.0 * R + 1e-9);

  /* two colours at once: the higher one goes first, to its own spot that is free */
  lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1);
  put(1, spot[YELLOW][0], spot[YELLOW][1]);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  carom_turn turn = {.outcome = CAROM_TURN_PASS, .foul = CAROM_FOUL_POT, .spot = Y | BK};
  ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, count, &turn), CAROM_OK);
  ck_assert(is_at(BLACK, spot[BLACK][0], spot[BLACK][1]) &&
            is_at(YELLOW, spot[PINK][0], spot[PINK][1]));
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_SNOOKER, &table, 22, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, &table, -1, spot[0]), CAROM_ERROR_RACK);
  ck_assert_int_eq(carom_spot_of(CAROM_RACK_NINEBALL, NULL, 1, spot[0]), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_turn_settle(&of, NULL, &table, balls, count, &turn), CAROM_ERROR_NULL);
  turn.spot = 1u << 22;
  ck_assert_int_eq(carom_turn_settle(&of, &of.state, &table, balls, count, &turn),
                   CAROM_ERROR_BALLS);
}

/* After a foul: whether the player is snookered, that is, whether no ball on can be hit at both of
 * its edges. */
TEST(free_balls) {
  enum { NOT = 0, IS = 1 };
  static const double R = 0.02625;
  const struct {
    const char *what;
    double red[2], blocker[2];
    bool hand, snookered;
  } given[] = {
      {"nothing in the way", {0.9, 2.0}, {0.2, 2.0}, false, false},
      {"full behind the black", {0.9, 2.0}, {0.9, 1.5}, false, true},
      {"one edge behind it", {0.9, 2.0}, {0.9 + 1.2 * R, 1.9}, false, true},
      {"beside the way", {0.9, 2.0}, {0.9 + 4.1 * R, 1.9}, false, false},
      {"behind the red", {0.9, 2.0}, {0.9, 2.2}, false, false},
      {"in hand, from elsewhere in the D", {0.9, 2.0}, {0.9, 1.5}, true, false},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | BK);
    put(0, 0.9, 1.0);
    put(1, given[k].red[0], given[k].red[1]);
    put(BLACK, given[k].blocker[0], given[k].blocker[1]);
    for (int foul = 0; foul < 2; foul++) {
      carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
      of.state.may = foul ? MAY : 0;
      carom_turn turn = {.outcome = CAROM_TURN_PASS,
                         .leave = given[k].hand ? CAROM_LEAVE_D : CAROM_LEAVE_AFTER,
                         .foul = foul ? CAROM_FOUL_NO_BALL : 0};
      carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
      ck_assert_msg(((of.state.may & FREE) != 0) == (foul && given[k].snookered), "%s, foul %d",
                    given[k].what, foul);
    }
  }

  /* in hand, with a wall of colours close to the D */
  int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, R1 | COLOURS);
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  of.state.may = MAY | HAND;
  carom_turn turn = {
      .outcome = CAROM_TURN_PASS, .leave = CAROM_LEAVE_D, .foul = CAROM_FOUL_CUE_BALL};
  put(1, 1.3, 3.4);
  carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
  ck_assert(!(of.state.may & FREE));
  for (int k = YELLOW; k <= BLACK; k++)
    put(k, 1.3 + 2.0 * R * (k - 18.5), 3.2);
  of.state.may = MAY | HAND;
  carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
  ck_assert(of.state.may & FREE);

  /* a second red that is free ends it */
  balls[2] = balls[1];
  put(2, 0.2, 2.0);
  of.state.may = MAY | HAND;
  carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
  ck_assert(!(of.state.may & FREE));

  /* to leave the other behind the free ball is a foul; behind another it is not, nor with pink and
   * black alone; of two in one way the nearer one is it, of those before two reds none */
  static const struct {
    uint32_t lie;
    int target, named, points;
    double yellow[2];
  } behind[] = {
      {1 | R1 | Y | BK, 1, BLACK, 4, {0.2, 0.2}},  {1 | R1 | Y | BK, 1, YELLOW, 0, {0.2, 0.2}},
      {1 | PI | BK, PINK, BLACK, 0, {0.0, 0.0}},   {1 | BL | PI | BK, BLUE, BLACK, 5, {0.0, 0.0}},
      {1 | R1 | Y | BK, 1, YELLOW, 4, {0.9, 1.3}}, {1 | R1 | R2 | Y | BK, 1, BLACK, 0, {0.6, 1.3}}};
  for (int k = 0; k < 6; k++) {
    count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, behind[k].lie);
    put(0, 0.9, 1.0);
    put(behind[k].target, 0.9, 2.0);
    put(BLACK, 0.9, 1.5);
    if (behind[k].lie & Y)
      put(YELLOW, behind[k].yellow[0], behind[k].yellow[1]);
    if (behind[k].lie & R2)
      put(2, 0.3, 1.6);
    of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.free_ball = behind[k].named;
    turn = (carom_turn){.outcome = CAROM_TURN_PASS};
    carom_turn_settle(&of, &of.state, &table, balls, count, &turn);
    ck_assert_msg((turn.foul != 0) == (behind[k].points > 0) && of.state.free_ball == 0 &&
                      of.state.score[0] == behind[k].points &&
                      of.state.may == (behind[k].points > 0 ? MAY | FREE : 0),
                  "%d: foul %d, %d points", k, turn.foul, of.state.score[0]);
  }
}
