/* Games that are planned: values of points, strokes that are chosen, and whole games, which no
 * machine changes. */
#include "game_support.h"

/* Chances: more points are better, and so are fewer that the other has; those of both players add
 * up to about one where nothing can be potted. */
TEST(values_of_points) {
  for (int game = 0; game < 2; game++) {
    const carom_rules_kind kind = game == 0 ? CAROM_RULES_STRAIGHT : CAROM_RULES_SNOOKER;
    carom_plan_rules of = carom_plan_rules_of(kind);
    const int count = lay_out(game == 0 ? CAROM_RACK_EIGHTBALL : CAROM_RACK_SNOOKER,
                              game == 0 ? CAROM_TABLE_POOL_9FT : CAROM_TABLE_SNOOKER, ALL);
    carom_cue cue = carom_cue_of(game == 0 ? CAROM_GAME_POOL : CAROM_GAME_SNOOKER);
    const carom_player player = carom_player_of(1.0);
    carom_plan_job job = job_of(count, &cue, &player, &of, NULL);
    double last = -1.0, value;
    for (int own = 0; own <= 99; own += 9) {
      of.state.score[0] = own;
      of.state.score[1] = 40;
      ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
      ck_assert_msg(value >= last && value >= 0.0 && value <= 1.0, "%d: %g after %g", own, value,
                    last);
      last = value;
    }
    last = 2.0;
    for (int other = 0; other <= 99; other += 9) {
      of.state.score[0] = 40;
      of.state.score[1] = other;
      ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
      ck_assert(value <= last);
      last = value;
    }
    ck_assert(last < 0.25);
    of.state.score[1] = 40;
    ck_assert_int_eq(carom_plan_value(&job, 1, &value), CAROM_OK);
    ck_assert(value > 0.3 && value < 0.95);
    free(job.memory);
  }
}

/* With the black alone a lead of eight points has won the frame, whoever is at the table; one of
 * seven has not. */
TEST(values_of_a_claim) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, BK | 1);
  const carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
  const carom_player player = carom_player_of(1.0);
  for (int lead = -9; lead <= 9; lead++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.score[0] = 50 + lead;
    of.state.score[1] = 50;
    carom_plan_job job = job_of(count, &cue, &player, &of, NULL);
    double value;
    ck_assert_int_eq(carom_plan_value(&job, 0, &value), CAROM_OK);
    if (lead > 7 || lead < -7)
      ck_assert_msg(value == (lead > 0 ? 1.0 : 0.0), "%d ahead: %g", lead, value);
    else
      ck_assert_msg(value > 0.0 && value < 1.0, "%d ahead: %g", lead, value);
    free(job.memory);
  }
}

/* One-pocket: a ball before a pocket is worth much to its player only, who plays it there; fewer
 * balls that are needed, or owed, are better. */
TEST(pocket_of_ones_own) {
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0x7);
  put(0, 0.6, 1.6);
  put(1, table.width - 0.15, table.length - 0.15);
  put(2, 0.5 * table.width, 0.1);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(1.0);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  double value[5];
  for (int k = 0; k < 5; k++) {
    const bool mine = k < 4;
    of.state = (carom_rules_state){.pocket = {mine ? MINE : HIS, mine ? HIS : MINE},
                                   .score = {k == 1 ? 6 : 7, k == 2 ? 7 : 6},
                                   .lost = {k == 3}};
    carom_choice best;
    int found;
    ck_assert_int_eq(carom_plan_value(&job, 0, &value[k]), CAROM_OK);
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    ck_assert_msg(!mine || (best.ball == 1 && best.pocket == MINE), "%d: ball %d", k, best.ball);
  }
  ck_assert_msg(value[0] > value[4] + 0.2 && value[0] > value[1] + 0.01 && value[0] > value[2] &&
                    fabs(value[3] - value[1]) < 1e-9,
                "%g %g %g %g %g", value[0], value[1], value[2], value[3], value[4]);
  free(job.memory);
}

/* Snooker: after a red a plan takes the black, where it is as easy as the yellow; and the yellow
 * where the black is out of reach. */
TEST(colours_by_value_and_position) {
  for (int k = 0; k < 2; k++) {
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_SNOOKER);
    of.state.on = 1;
    const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, 1 | R1 | Y | BK);
    const double w = table.width, l = table.length;
    put(0, 0.5 * w, 0.5 * l);
    put(1, 0.5 * w, 0.6 * l);
    /* both before a corner, or the black far along a rail */
    put(YELLOW, 0.15, 0.15);
    put(BLACK, w - 0.15, k == 0 ? 0.15 : l - 0.5);
    if (k == 1)
      put(BLACK, 0.027, 0.7 * l);
    carom_cue cue = carom_cue_of(CAROM_GAME_SNOOKER);
    const carom_player player = carom_player_of(0.3);
    const carom_plan_options options = {.shots = 2000};
    carom_plan_job job = job_of(count, &cue, &player, &of, &options);
    carom_choice best;
    int found;
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    ck_assert_msg(best.ball == (k == 0 ? BLACK : YELLOW), "%d: ball %d", k, best.ball);
    free(job.memory);
  }
}

/* What a ruling says besides of the turn: falls in their order, balls that were put, words. */
static void check_ruling(const carom_ruling *r, const carom_ball_state *left, int count) {
  char words[200];
  uint32_t down = 0, put = 0;
  for (int64_t k = 0; k < r->falls; k++) {
    down |= UINT32_C(1) << r->fall[k].ball;
    ck_assert(k == 0 || r->fall[k].time >= r->fall[k - 1].time);
    ck_assert_int_eq(r->fall[k].pocket, r->facts.pocket[r->fall[k].ball]);
  }
  for (int k = 0; k < count && left != NULL; k++)
    put |= (uint32_t)(r->balls[k].state.label != left[k].label ||
                      memcmp(r->balls[k].state.r, left[k].r, sizeof left[k].r) != 0)
           << k;
  ck_assert(down == r->facts.down && put == r->put);
  ck_assert_int_eq(r->next, r->winner >= 0 ? -1 : r->turn.outcome == CAROM_TURN_PASS);
  ck_assert_int_eq(r->hand, r->turn.leave >= CAROM_LEAVE_HAND);
  ck_assert((r->on & 1) == 0 && (r->on != 0) == (r->next >= 0));
  const size_t length = carom_ruling_string(r, words, sizeof words);
  ck_assert(length == strlen(words) && carom_ruling_string(r, words, 5) == length && words[4] == 0);
}

/* A whole game between two plans of few shots: the same strokes, scores and layouts on all
 * machines. Where a change of the method or of the physics is meant to change them, the new hash is
 * the one that this test prints. All layouts are such that a shot can be played from, and the
 * points add up. */
static uint64_t play(carom_rules_kind kind, int target, int *strokes, int64_t made[2]) {
  const bool in_d = kind == CAROM_RULES_SNOOKER;
  const int count = lay_out(in_d ? CAROM_RACK_SNOOKER : CAROM_RACK_EIGHTBALL,
                            in_d ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, ALL);
  carom_plan_rules of = carom_plan_rules_of(kind);
  of.state.target = target;
  of.state.opening = kind == CAROM_RULES_STRAIGHT;
  const carom_cue cue = carom_cue_of(in_d ? CAROM_GAME_SNOOKER : CAROM_GAME_POOL);
  const carom_player player = carom_player_of(in_d ? 0.5 : 1.0);
  carom_plan_options options = {.shots = 100};
  carom_plan_job job = job_of(count, &cue, &player, &of, &options);
  uint64_t h = UINT64_C(0xcbf29ce484222325);
  carom_turn turn = {.outcome = CAROM_TURN_PASS,
                     .leave = in_d ? CAROM_LEAVE_D : CAROM_LEAVE_KITCHEN};
  const double high[2] = {table.width, 0.25 * table.length};
  int who = 1;
  for (*strokes = 0;
       *strokes < 400 && turn.outcome != CAROM_TURN_WIN && turn.outcome != CAROM_TURN_LOSE;
       (*strokes)++) {
    carom_choice best;
    int found;
    who = turn.outcome == CAROM_TURN_PASS ? 1 - who : who;
    options.seed = (uint64_t)*strokes;
    const bool hand = turn.leave == CAROM_LEAVE_KITCHEN || turn.leave == CAROM_LEAVE_D;
    if (hand) {
      const double *bound = turn.leave == CAROM_LEAVE_KITCHEN ? high : NULL;
      ck_assert_int_eq(carom_plan_hand(&job, NULL, bound, &best, 1, &found), CAROM_OK);
      ck_assert_int_eq(
          carom_place_ball(&table, balls, count, 0, best.place[0], best.place[1], NULL), CAROM_OK);
    } else
      ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    if (turn.leave == CAROM_LEAVE_D)
      ck_assert(hypot(best.place[0] - 0.5 * table.width, best.place[1] - 0.737) < 0.2921 &&
                best.place[1] < 0.7371);

    carom_cue stroke = best.cue;
    carom_player_strike(&player, 5, (uint64_t)*strokes, &stroke);
    carom_facts facts;
    carom_ball_state final[BALLS_MOST];
    carom_shot shot = {.final = final, .facts = &facts};
    static carom_ruling ruling;
    const bool plays = best.kind != CAROM_PLAN_PASS;
    if (plays)
      ck_assert_int_eq(carom_shoot(&table, balls, count, &stroke, NULL, &shot), CAROM_OK);
    ck_assert_int_eq(carom_referee(&of, &table, balls, count, 0, plays ? &shot : NULL,
                                   (carom_call){best.ball, best.pocket}, &ruling),
                     CAROM_OK);
    check_ruling(&ruling, plays ? final : NULL, count);
    turn = ruling.turn;
    of.state = ruling.state;
    memcpy(balls, ruling.balls, (size_t)count * sizeof *balls);
    made[who] += (int64_t)turn.points;
    if (turn.leave == CAROM_LEAVE_AFTER)
      ck_assert_int_eq(carom_shot_check(&table, balls, count, NULL, NULL, NULL), CAROM_OK);
    h = hash_of(h, &best, sizeof best);
    h = hash_of(h, &of.state, sizeof of.state);
    for (int k = 0; k < count; k++)
      h = hash_of(h, balls[k].state.r, sizeof balls[k].state.r);
  }
  free(job.memory);
  ck_assert(turn.outcome == CAROM_TURN_WIN || turn.outcome == CAROM_TURN_LOSE);
  if (kind == CAROM_RULES_STRAIGHT)
    ck_assert(of.state.score[0] == made[who] && of.state.score[1] == made[1 - who]);
  else if (!in_d) /* fouls and debts take from them */
    ck_assert(of.state.score[turn.outcome != CAROM_TURN_WIN] >= 8 &&
              of.state.score[0] + of.state.score[1] <= 15);
  else /* fouls come to the pots */
    ck_assert(of.state.score[0] >= made[who] && of.state.score[1] >= made[1 - who]);
  return h;
}

TEST(golden_games) {
  static const struct {
    carom_rules_kind kind;
    int target, points; /* least ones of both together */
    uint64_t hash;
  } given[] = {{CAROM_RULES_STRAIGHT, 40, 40, UINT64_C(0x1e43669d776c02bf)},
               {CAROM_RULES_SNOOKER, 0, 40, UINT64_C(0x6db1c3cb41ad46e8)},
               {CAROM_RULES_ONEPOCKET, 0, 4, UINT64_C(0xd269bb302bc08fca)}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    int strokes;
    int64_t made[2] = {0};
    const uint64_t h = play(given[k].kind, given[k].target, &strokes, made);
    const char *game = carom_word(CAROM_WORDS_RULES, (int)given[k].kind);
    printf("%s: 0x%016llx; %d strokes, %d and %d points\n", game, (unsigned long long)h, strokes,
           (int)made[0], (int)made[1]);
    ck_assert(strokes >= 6 && made[0] + made[1] >= given[k].points);
    ck_assert_msg(h == given[k].hash, "%s is another: 0x%016llx", game, (unsigned long long)h);
  }
}
