/* What the coach finds: choices are replayed and explained, and breaks add up in any parts. ways.c
 * tests the ways. */
#include "carom_coach.h"
#include "plan_support.h"

static carom_plan_stroke best[5];
static int found;

/* The choices of a plan of a layout. */
static void plan_layout(uint64_t seed, int in_play) {
  make_layout(seed, in_play);
  make_memory();
  expect_ok(carom_plan(&job, best, 5, &found));
}

/* Replayed choices have the chances of 300 strokes each, best first; what they are stays. */
TEST(choices_are_replayed) {
  for (uint64_t seed = 1; seed <= 4; seed++) {
    plan_layout(seed, 5);
    carom_plan_stroke again[5];
    memcpy(again, best, sizeof best);
    expect_ok(carom_plan_replay(&job, again, found));
    for (int k = 0; k < found; k++) {
      const carom_plan_stroke *c = &again[k];
      ck_assert(c->seen == CAROM_WHY_STROKES && c->error < 0.05);
      ck_assert(c->value >= 0.0 && c->value <= 1.0 && c->keep + c->lose <= 1.0);
      ck_assert(k == 0 || c->value <= again[k - 1].value);
      int same = 0;
      for (int n = 0; n < found; n++)
        if (memcmp(&best[n].cue, &c->cue, sizeof c->cue) == 0) {
          same++;
          ck_assert_double_eq_tol(best[n].value, c->value, 0.25);
        }
      ck_assert_int_ge(same, 1);
    }
    edge_free(&memory);
  }
}

/* A straight pot of the eight is explained: no cushion, a full hit, and the game is won. */
TEST(a_pot_is_explained) {
  make_layout(1, 1);
  place_ball(8, 0.2, 0.2);
  place_ball(0, 0.5, 0.5);
  make_memory();
  expect_ok(carom_plan(&job, best, 5, &found));
  static carom_why why;
  expect_ok(carom_why_of(&job, &best[0], &why));
  ck_assert(carom_names_ball(&best[0]) == 1);
  ck_assert(why.rails == 0 && why.first == 8 && fabs(why.cut) < 10.0 && why.part > 0.8);
  ck_assert(why.ruling.turn.outcome == CAROM_TURN_WIN && why.has_next == 0 && why.speed > 0.3);
  ck_assert(why.misses < 0.2 && why.flawless_value == 1.0);
  ck_assert_int_eq(why.strokes, CAROM_WHY_STROKES);

  /* the cushion of a kick is named, and its position is at that rail */
  carom_plan_stroke kick = {
      .kind = CAROM_PLAN_GIVEN, .ball = -1, .pocket = -1, .place = {0.5, 0.5}};
  kick.cue = cue;
  kick.cue.speed = 2.0;
  kick.cue.phi = 0.0;
  expect_ok(carom_why_of(&job, &kick, &why));
  ck_assert(why.rails >= 1 && why.first == -1 && isnan(why.cut) && isnan(why.part));
  ck_assert_double_eq_tol(why.contact[0][0], table.width - balls[0].kind.radius, 0.005);
  ck_assert(why.misses > 0.9 && why.opponent > 0.0 && why.has_next == 1);
  ck_assert(carom_names_ball(&kick) == 0);
  kick.kind = CAROM_PLAN_PASS;
  ck_assert_int_eq(carom_why_of(&job, &kick, &why), CAROM_ERROR_OPTIONS);
  edge_free(&memory);
}

/* A list names a stroke that is meant to pass the turn, as well as those that pot by luck. */
TEST(lists_have_safeties) {
  enum { LAYOUTS = 15, LEAST = 13 };
  int lists = 0, lucky = 0;
  for (uint64_t seed = 1; seed <= LAYOUTS; seed++) {
    make_layout(seed, 5 + (int)(seed % 5));
    rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    job.count = 10;
    options.shots = 1000;
    make_memory();
    expect_ok(carom_plan(&job, best, 5, &found));
    bool is_safe = false;
    for (int k = 0; k < found; k++) {
      is_safe |= best[k].kind == CAROM_PLAN_SAFETY && best[k].foul <= 0.25;
      lucky += best[k].kind == CAROM_PLAN_SCAN && best[k].ball < 0;
    }
    lists += is_safe;
    edge_free(&memory);
  }
  printf("%d of %d lists have a safety, and %d strokes pot by luck\n", lists, LAYOUTS, lucky);
  ck_assert_int_ge(lists, LEAST);
}

/* The value of a choice to a player without some errors, by strokes that are played anew. */
static double value_with(const carom_plan_stroke *choice, const carom_player *some) {
  carom_plan_stroke again = *choice;
  job.player = some;
  expect_ok(carom_plan_replay(&job, &again, 1));
  job.player = &player;
  return again.value;
}

/* A layout is worth the same to every player, so that values follow from strokes alone. */
static double by_balls(const carom_rules_state *state, const carom_ball_state *layout, int count,
                       int in_hand) {
  (void)state;
  int left = 0;
  for (int k = 1; k < count; k++)
    left += layout[k].label < CAROM_BALL_POCKETED;
  return 0.5 + 0.1 * in_hand + 0.3 * layout[0].r[1] / (1.0 + left);
}

/* The costs of errors are those of strokes that players without these errors play, they add up to
 * the cost of all, and the chances of a choice do not contradict each other. */
TEST(costs_of_errors) {
  enum { LAYOUTS = 12 };
  static carom_why why;
  int meant = 0, passing = 0;
  for (uint64_t seed = 1; seed <= LAYOUTS; seed++) {
    make_layout(seed, 2 + (int)(seed % 5));
    rules.value = by_balls;
    make_memory();
    expect_ok(carom_plan(&job, best, 5, &found));
    for (int k = 0; k < found; k++) {
      carom_plan_stroke choice = best[k];
      expect_ok(carom_plan_replay(&job, &choice, 1));
      expect_ok(carom_why_of(&job, &choice, &why));
      ck_assert(why.value == choice.value);
      double sum = 0.0;
      for (int error = 0; error < CAROM_WHY_ERRORS; error++)
        sum += why.cost[error];
      ck_assert_double_eq_tol(why.flawless_value - why.value, sum, 1e-12);

      /* of speed, between aim and tip: the mean of what it costs with aim, and with tip and eye */
      const carom_player none = {.growth = player.growth, .eye = -1.0};
      carom_player aims = none, tips = none, others = player, timed = player;
      aims.phi = player.phi, aims.theta = player.theta;
      tips.a = player.a, tips.b = player.b, tips.eye = player.eye;
      timed.a = timed.b = 0.0;
      timed.eye = -1.0;
      others.phi = others.theta = 0.0;
      const double cost = 0.5 * (value_with(&choice, &aims) - value_with(&choice, &timed) +
                                 value_with(&choice, &tips) - value_with(&choice, &others));
      ck_assert_double_eq_tol(why.cost[CAROM_WHY_SPEED], cost, 1e-12);
      ck_assert_double_eq_tol(why.flawless_value, value_with(&choice, &none), 1e-12);

      /* the turn passes, is kept or loses; what it leaves is between the worst and the best */
      ck_assert_double_eq_tol(choice.keep + why.misses + why.loses, 1.0, 1e-12);
      double passed = 0.0;
      if (why.misses > 0.0)
        passed = why.misses * (1.0 - why.opponent);
      ck_assert(choice.value >= passed - 1e-12 && choice.value <= passed + choice.keep + 1e-12);
      const bool passes = why.ruling.turn.outcome == CAROM_TURN_PASS;
      if (carom_names_ball(&choice)) {
        ck_assert_double_eq_tol(why.leave, why.flawless_value, 1e-12);
        meant++;
      } else if (why.misses > 0.5) {
        ck_assert(passes);
        ck_assert_double_eq_tol(why.leave, 1.0 - why.opponent, 0.2);
        passing++;
      }
    }
    edge_free(&memory);
  }
  ck_assert(meant > LAYOUTS && passing > LAYOUTS / 4);
}

/* A hard break of a rack of so many balls, with the cue ball; without memory. */
static carom_break_job break_job(carom_rack_kind rack, int count) {
  carom_rack(rack, &table, 1e-4, 1, balls, BALLS);
  cue.speed = 9.0;
  return (carom_break_job){.table = &table,
                           .balls = balls,
                           .count = count,
                           .cue = &cue,
                           .player = &player,
                           .rack = (int32_t)rack,
                           .gap = 1e-4,
                           .seed = 1,
                           .memory_size = carom_break_memory()};
}

/* Breaks: two parts add up to the whole, the counts fit each other, and a wider error makes the cue
 * ball end elsewhere. */
TEST(breaks_add_up) {
  enum { BREAKS = 40, FIRST = 13, RACK = 16 };
  make_layout(1, 1);
  carom_break_job breaks = break_job(CAROM_RACK_EIGHTBALL, RACK);
  edge space = edge_make(breaks.memory_size, true);
  carom_break_counts whole = {0}, parts = {0};
  breaks.memory = space.memory;
  expect_ok(carom_break_play(&breaks, 0, BREAKS, &whole));
  expect_ok(carom_break_play(&breaks, FIRST, BREAKS - FIRST, &parts));
  expect_ok(carom_break_play(&breaks, 0, FIRST, &parts));
  ck_assert_double_eq_tol(whole.squares, parts.squares, 1e-9);
  ck_assert_double_eq_tol(whole.win_squares, parts.win_squares, 1e-9);
  parts.x = whole.x, parts.y = whole.y, parts.squares = whole.squares;
  parts.wins = whole.wins, parts.win_squares = whole.win_squares;
  ck_assert_int_eq(memcmp(&whole, &parts, sizeof whole), 0);

  int64_t fell = 0;
  for (int ball = 1; ball < RACK; ball++)
    for (int pocket = 0; pocket < table.pockets; pocket++)
      fell += whole.fell[ball][pocket];
  ck_assert(whole.breaks == BREAKS && whole.balls == fell && whole.makes <= whole.balls);
  ck_assert(whole.makes > 5 && whole.makes < BREAKS && whole.plays_on <= whole.makes);
  ck_assert(whole.stays >= BREAKS - whole.scratches - whole.off && whole.wing <= whole.makes);
  const double stays = (double)whole.stays, x = whole.x / stays, y = whole.y / stays;
  const double spread = sqrt(whole.squares / stays - x * x - y * y);
  ck_assert(spread > 0.1 && spread < 1.5 && x > 0.0 && x < table.width);

  /* the stroke without errors goes at the middle of the ball in front */
  carom_shot_ball rack[RACK];
  carom_cue stroke;
  expect_ok(carom_break_stroke(&breaks, -1, rack, &stroke));
  ck_assert_double_eq_tol(stroke.phi, 90.0, 0.1);
  breaks.aim = CAROM_BREAK_DIRECTION;
  cue.phi = 77.0;
  expect_ok(carom_break_stroke(&breaks, -1, rack, &stroke));
  ck_assert(stroke.phi == 77.0);
  breaks.aim = CAROM_BREAK_CUT;
  expect_ok(carom_break_stroke(&breaks, -1, rack, &stroke));
  ck_assert_double_eq_tol(stroke.phi, 77.0, 1e-9); /* in the job's own rack */
  breaks.aim = CAROM_BREAK_CUT + 1;
  ck_assert_int_eq(carom_break_play(&breaks, 0, 1, &whole), CAROM_ERROR_OPTIONS);
  breaks.memory_size--;
  ck_assert_int_eq(carom_break_play(&breaks, 0, 1, &whole), CAROM_ERROR_NULL);
  ck_assert(carom_break_has_rules(CAROM_RACK_NINEONSPOT) == 1);
  ck_assert(carom_break_has_rules(CAROM_RACK_SNOOKER) == 0);
  edge_free(&space);
}

/* The best breaks win more often than the soft one of the job at other racks too, in the order that
 * is told; their place is legal, and a player without errors pays nothing for them. */
TEST(the_best_break_wins_more_often) {
  enum { BREAKS = 128, ROOM = 3, RACK = 10 };
  make_layout(1, 1);
  carom_break_job breaks = break_job(CAROM_RACK_NINEBALL, RACK);
  breaks.seed = 7;
  player = carom_player_fargo(700.0);
  edge space = edge_make(breaks.memory_size, true);
  breaks.memory = space.memory;
  static carom_break_choice choice[CAROM_BREAK_CHOICES];
  expect_ok(carom_break_best(&breaks, BREAKS, choice, ROOM));
  for (int k = 0; k < ROOM; k++) {
    const carom_break_choice *c = &choice[k];
    ck_assert(c->counts.breaks == BREAKS && c->cue.speed <= cue.speed);
    ck_assert(c->place[1] <= 0.25 * table.length && fabs(c->cue.phi - 90.0) < 40.0);
    ck_assert(k == 0 || c->counts.wins <= choice[k - 1].counts.wins);
    ck_assert(isnan(c->cost) == (k > 0));
  }

  /* at racks of another seed, compared with a third of the speed */
  carom_break_counts again = {0}, soft = {0};
  breaks.seed = 90000;
  cue.speed = 3.0;
  expect_ok(carom_break_play(&breaks, 0, BREAKS, &soft));
  memcpy(balls[0].state.r, choice[0].place, sizeof choice[0].place);
  cue = choice[0].cue;
  breaks.aim = choice[0].aim;
  expect_ok(carom_break_play(&breaks, 0, BREAKS, &again));
  ck_assert(again.wins > soft.wins + 4.0);
  const double spread = sqrt(choice[0].counts.win_squares - pow(choice[0].counts.wins, 2) / BREAKS);
  ck_assert(fabs(again.wins - choice[0].counts.wins) < 5.0 * 1.5 * spread);

  /* without errors; and what is rejected */
  player = carom_player_of(0.0);
  expect_ok(carom_break_best(&breaks, 16, choice, 1));
  ck_assert(choice[0].cost == 0.0 && choice[0].aim_cost == 0.0 && choice[0].tip_cost == 0.0);
  ck_assert_int_eq(carom_break_best(&breaks, 15, choice, 1), CAROM_ERROR_OPTIONS);
  ck_assert_int_eq(carom_break_best(&breaks, 16, choice, CAROM_BREAK_CHOICES + 1),
                   CAROM_ERROR_OPTIONS);
  breaks.memory = NULL;
  ck_assert_int_eq(carom_break_best(&breaks, 16, choice, 1), CAROM_ERROR_NULL);
  edge_free(&space);
}
