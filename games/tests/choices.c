/* What plans choose: the same on all machines, with the chances that are told, of what is named. */
#include "carom_coach.h"
#include "carom_match.h"
#include "plan_support.h"

/* The choices of 20 layouts, by plain: the same hash on all machines, with one thread and with
 * two. Where a change of the method or of the physics is meant to change them, the new hash is
 * the one that this test prints. */
TEST(golden_choices) {
  static const uint64_t golden = UINT64_C(0xd805f4ded3f43471);
  uint64_t h = UINT64_C(0xcbf29ce484222325);
  int pots = 0;
  for (int k = 0; k < 20; k++) {
    carom_plan_stroke choices[2][3];
    int found[2];
    make_layout((uint64_t)k + 1, 2 + k % 8);
    options.seed = (uint64_t)k;
    if (k % 5 == 4)
      rules = carom_plan_rules_of(k % 2 == 0 ? CAROM_RULES_NINEBALL : CAROM_RULES_POTTING);
    make_memory();
    for (int threads = 0; threads < 2; threads++) {
      options.threads = 2 * threads;
      ck_assert_int_eq(k % 4 == 3
                           ? carom_plan_hand(&job, NULL, NULL, choices[threads], 3, &found[threads])
                           : carom_plan(&job, choices[threads], 3, &found[threads]),
                       CAROM_OK);
    }
    ck_assert_int_eq(found[0], found[1]);
    ck_assert_int_eq(memcmp(choices[0], choices[1], (size_t)found[0] * sizeof choices[0][0]), 0);
    const carom_plan_stroke *best = &choices[0][0];
    ck_assert(best->value >= 0.0 && best->value <= 1.0 && best->error >= 0.0 && best->seen > 0);
    ck_assert(found[0] == 1 || best->value >= choices[0][1].value);
    pots += best->ball > 0;
    h = hash_of(h, choices[0], (size_t)found[0] * sizeof choices[0][0]);
    edge_free(&memory);
  }
  printf("choices of 20 layouts: 0x%016llx; %d pot\n", (unsigned long long)h, pots);
  ck_assert_int_gt(pots, 10);
  ck_assert_msg(h == golden, "the choices are others: 0x%016llx", (unsigned long long)h);
}

/* The chances that plans tell are those of the same strokes with other errors: in the mean of 120
 * layouts, and 40 with ball in hand, the chance to win is within 0.01, and those to keep the turn
 * and of a foul within 0.015; of fewer layouts by the root of their number. The shots that choose
 * tell more, so each choice has been played by at least 30 that have not. */
TEST(told_is_what_comes) {
  enum { LAYOUTS = 160 };
  const int layouts = draws_of_test(LAYOUTS / 4, LAYOUTS);
  const int placed = layouts / 4;
  const double wider = sqrt((double)LAYOUTS / layouts);
  double more[2][3] = {{0.0}};
  for (int k = 0; k < layouts; k++) {
    make_layout((uint64_t)k + 1, 7);
    player = carom_player_of(3.0);
    options.shots = k % 2 == 0 ? 300 : 1000;
    carom_plan_stroke best;
    const bool hand = k < placed;
    plan(hand, &best, 1);
    ck_assert_int_ge(best.seen, (options.shots > 300 ? options.shots / 10 : 30) + 10);
    place_ball(0, best.place[0], best.place[1]);
    options.shots = 1000;
    const carom_plan_stroke repeated = repeat(&best.cue);
    ck_assert(repeated.ball == best.ball && repeated.pocket == best.pocket);
    ck_assert(repeated.kind == CAROM_PLAN_GIVEN && repeated.seen == options.shots);
    const double n = hand ? placed : layouts - placed;
    more[hand][0] += (best.value - repeated.value) / n;
    more[hand][1] += (best.keep - repeated.keep) / n;
    more[hand][2] += (best.foul - repeated.foul) / n;
  }
  for (int hand = 0; hand < 2; hand++)
    ck_assert_msg(fabs(more[hand][0]) < 0.01 * wider && fabs(more[hand][1]) < 0.015 * wider &&
                      fabs(more[hand][2]) < 0.015 * wider,
                  "in hand %d: told %+.4f more, keep %+.4f, foul %+.4f", hand, more[hand][0],
                  more[hand][1], more[hand][2]);
}

static carom_facts seen; /* by the rules, of the last stroke */
static carom_plan_rules played_rules;

static carom_turn judge_and_see(carom_rules_state *state, uint32_t in_play, int cue_ball,
                                const carom_facts *facts, carom_call call) {
  seen = *facts;
  return played_rules.judge(state, in_play, cue_ball, facts, call);
}

/* The pots of strokes without errors: the ball that falls first is named, in nine-ball whichever it
 * is, in eight-ball of those that are on; and only a ball that falls. Strokes in which the lowest
 * ball of those that fall is not the first are among them. What the rules see, though balls that
 * are down take no part in the shots of plans, is what the shot of all balls tells. */
TEST(the_first_ball_that_falls) {
  enum { CUES = 40 };
  enum { LAYOUTS = 60 };
  const int layouts = draws_of_test(LAYOUTS / 3, LAYOUTS);
  int named = 0, second = 0, others = 0;
  for (int layout = 0; layout < layouts; layout++) {
    make_layout((uint64_t)layout, 10);
    rules = carom_plan_rules_of(layout % 2 == 0 ? CAROM_RULES_NINEBALL : CAROM_RULES_EIGHTBALL);
    player = carom_player_of(0.0);
    uint32_t in_play = 0;
    for (int i = 0; i < BALLS; i++)
      in_play |= (uint32_t)(balls[i].state.label != CAROM_BALL_POCKETED) << i;
    const uint32_t targets = rules.on(&rules.state, in_play);
    carom_cue cues[CUES];
    carom_plan_stroke chosen[CUES];
    for (int k = 0; k < CUES; k++) {
      cues[k] = cue;
      cues[k].speed = 7.0;
      cues[k].phi = 9.0 * k;
    }
    make_memory();
    played_rules = rules;
    rules.judge = judge_and_see;

    /* the first by the facts, and whether a later one has a lower number */
    for (int k = 0; k < CUES; k++) {
      carom_facts facts;
      carom_ball_state final[BALLS];
      carom_shot shot = {.final = final, .facts = &facts};
      expect_ok(carom_plan_try(&job, &cues[k], 1, &chosen[k]));
      expect_ok(carom_shoot(&table, balls, BALLS, &cues[k], &shot_options, &shot));
      if (facts.first[0] >= 0 &&
          (targets >> facts.first[0] & 1)) /* else the shot may have been stopped */
        ck_assert_mem_eq(&seen, &facts, sizeof facts);
      const uint32_t down = facts.down & (rules.calls ? targets : 0xfffe);
      int first = -1;
      for (int i = 1; i < BALLS; i++)
        if ((down >> i & 1) && (first < 0 || facts.pocket_time[i] < facts.pocket_time[first]))
          first = i;
      const carom_call call = {first, first < 0 ? -1 : facts.pocket[first]};
      carom_plan_rules game_rules = played_rules;
      const carom_turn turn = game_rules.judge(&game_rules.state, in_play, 0, &facts, call);
      const bool keeps = turn.outcome == CAROM_TURN_KEEP || turn.outcome == CAROM_TURN_WIN;
      const int ball = keeps ? first : -1;
      ck_assert_msg(chosen[k].ball == ball && chosen[k].pocket == (ball < 0 ? -1 : call.pocket),
                    "layout %d, stroke %d: ball %d is named, %d fell first", layout, k,
                    chosen[k].ball, ball);
      ck_assert(chosen[k].keep == keeps);
      named += ball >= 0;
      second += ball >= 0 && (down & ((UINT32_C(1) << ball) - 1)) != 0;
      others += ball >= 0 && !(targets >> ball & 1);
    }
    edge_free(&memory);
  }
  printf("%d pots named, %d before one of a lower number, %d of balls that were not on\n", named,
         second, others);
  ck_assert(named > layouts * 2 / 3 && others > 0);
  ck_assert(layouts < LAYOUTS || (second > 3 && others > 3));
}

/* Nine-ball, with the one in line with the nine before a pocket: the choice names the nine, and is
 * no direct pot. A choice that keeps the turn in most strokes names a ball, but for a break. The
 * choices are of different pots, and sorted by their values. */
TEST(what_is_named_falls) {
  carom_plan_stroke best[5];
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  place_ball(0, 0.6, 0.6);
  place_ball(1, 0.2, 0.2);
  place_ball(9, 0.12, 0.12);
  job.count = 10;
  plan(false, best, 5);
  ck_assert_msg(best[0].ball == 9 && best[0].kind == CAROM_PLAN_COMBINATION && best[0].keep > 0.5,
                "ball %d, kind %d, keep %g", best[0].ball, best[0].kind, best[0].keep);

  int without = 0, pots = 0;
  for (int k = 0; k < 12; k++) {
    make_layout((uint64_t)k + 1, 10);
    rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    const int found = plan(false, best, 5);
    for (int n = 0; n < found; n++) {
      const bool aimed = best[n].kind == CAROM_PLAN_POT;
      ck_assert(best[n].seen > 0 && (n == 0 || best[n].value <= best[n - 1].value));
      for (int m = 0; m < n; m++)
        ck_assert(best[n].ball != best[m].ball || best[n].pocket != best[m].pocket ||
                  best[n].kind != best[m].kind || (best[n].keep < 0.1) != (best[m].keep < 0.1));
      without += best[n].ball < 0 && best[n].keep > 0.5;
      pots += aimed && best[n].ball < 0;
    }
  }
  ck_assert_msg(without == 0 && pots == 0, "%d keep the turn and name no ball, %d pots of none",
                without, pots);
}

/* Three-cushion: plans, whose chances are those of strokes with errors
 * of another seed, and whose ball is the one that is met first. */
TEST(three_cushion) {
  random_source r = {3};
  double sum = 0.0;
  for (int k = 0; k < 4; k++) {
    carom_plan_stroke best[5];
    lay_out_game(CAROM_RULES_THREECUSHION, 0);
    for (int ball = 0; ball < 3 && k > 0; ball++) {
      double x, y;
      do {
        x = random_between(&r, 0.05, 1.37);
        y = random_between(&r, 0.05, 2.79);
      } while (carom_place_ball(&table, balls, 3, ball, x, y, NULL) != CAROM_OK);
    }
    const int found = plan(false, best, 5);
    options.shots = 1000;
    const carom_plan_stroke repeated = repeat(&best[0].cue);
    const double p = repeated.keep, n = (double)best[0].seen;
    ck_assert(fabs(best[0].value - best[0].keep) < 1e-12 && best[0].pocket == -1);
    ck_assert(repeated.value == repeated.keep);
    ck_assert(fabs(best[0].keep - p) < 0.05 + 4.0 * sqrt((p * (1.0 - p) + 0.5 / n) / n));
    for (int i = 0; i < found; i++) {
      carom_facts facts;
      carom_shot shot = {.facts = &facts};
      carom_shoot(&table, balls, 3, &best[i].cue, &shot_options, &shot);
      const bool point = facts.first[1] >= 0 && facts.cushions_before[1] >= 3;
      ck_assert(!point || best[i].ball == facts.first[0]);
      ck_assert(!point || (best[i].kind == CAROM_PLAN_CAROM) == (facts.cushions_before[0] == 0));
      ck_assert((best[i].ball < 0 && best[i].keep < 0.1) == (best[i].kind == CAROM_PLAN_SAFETY));
    }
    sum += p;
  }
  printf("three-cushion: %g of four strokes score\n", sum);
  ck_assert(sum > 3.0);
}

static void make_break(carom_rules_kind kind, uint64_t seed, double fargo) {
  lay_out_game(kind, seed);
  rules.state.opening = 1;
  player = carom_player_fargo(fargo);
  options.shots = 1000;
}

/* Breaks: the cue ball in hand is put on the head string, a ball that may be met is struck, hard
 * and about full, and few are fouls, also of a weak player, who cannot want one. */
TEST(breaks) {
  for (int k = 0; k < 4; k++) {
    carom_plan_stroke best[5];
    make_break(k % 2 == 1 ? CAROM_RULES_NINEBALL : CAROM_RULES_EIGHTBALL, 1, 400.0);
    const int found = plan(k < 2, best, 5);
    for (int n = 0; n < found; n++) {
      ck_assert(best[n].kind == CAROM_PLAN_BREAK && best[n].ball == -1 && best[n].pocket == -1);
      ck_assert(best[n].cue.speed > 5.0 && (k >= 2 || best[n].place[1] == 0.25 * table.length));
      ck_assert(best[n].cue.phi > 45.0 && best[n].cue.phi < 135.0);
    }
    ck_assert_msg(best[0].foul < 0.5, "break %d: foul %g", k, best[0].foul);
  }
}

/* Breaks of new racks by the player of a plan, and the mean of their values. */
static double worth_of_breaks(carom_rack_kind rack, const carom_cue *stroke, const double place[2],
                              carom_break_aim aim) {
  enum { BREAKS = 800 };
  carom_break_counts counts = {0};
  carom_break_job series = {.table = &table,
                            .balls = balls,
                            .count = job.count,
                            .cue = stroke,
                            .player = &player,
                            .rack = (int32_t)rack,
                            .aim = (int32_t)aim,
                            .gap = 1e-4,
                            .seed = 1000,
                            .memory_size = carom_break_memory()};
  edge space = edge_make(series.memory_size, true);
  series.memory = space.memory;
  balls[0].state.r[0] = place[0];
  balls[0].state.r[1] = place[1];
  expect_ok(carom_break_play(&series, 0, BREAKS, &counts));
  edge_free(&space);
  return counts.wins / BREAKS;
}

/* Breaks of strong players on the cloth of events: on new racks, the break that a plan chooses is
 * worth no less than a break as at events, a full hit at 10 m/s from beside the middle of the head
 * string. The difference of two means of 800 breaks has an error of about 0.01. Nine-ball is left
 * out: docs/understanding/plan.md states what its planned breaks lose. */
TEST(breaks_of_events) {
  static const struct {
    carom_rules_kind rules;
    carom_rack_kind rack;
    double beside; /* m */
  } event[] = {{CAROM_RULES_EIGHTBALL, CAROM_RACK_EIGHTONSPOT, 0.35},
               {CAROM_RULES_TENBALL, CAROM_RACK_TENBALL, 0.35}};
  for (size_t k = 0; k < sizeof event / sizeof *event; k++) {
    carom_plan_stroke best;
    make_break(event[k].rules, 1, 750.0);
    expect_ok(carom_rack(event[k].rack, &table, 1e-4, 1, balls, ROOM_OF_BALLS));
    for (int64_t ball = 0; ball < job.count; ball++)
      ck_assert_int_eq(carom_condition_give(CAROM_CONDITION_FAST_CLOTH, &balls[ball].kind), 1);
    plan(true, &best, 1);
    const double chosen =
        worth_of_breaks(event[k].rack, &best.cue, best.place, CAROM_BREAK_DIRECTION);

    carom_cue usual = cue;
    usual.a = usual.b = usual.theta = 0.0;
    usual.speed = 7.51; /* m/s: of a cue whose ball leaves at 10 m/s */
    const double beside[2] = {0.5 * table.width + event[k].beside, 0.25 * table.length};
    const double as_events = worth_of_breaks(event[k].rack, &usual, beside, CAROM_BREAK_FULL);
    printf("break %zu: %g by the plan, %g as at events\n", k, chosen, as_events);
    ck_assert_msg(chosen > as_events - 0.04, "break %zu: %g, %g", k, chosen, as_events);
  }
}

/* Of a cue ball in hand behind the head string: a ball that is there too is not met directly (WPA
 * 6.11), however easy it is. */
TEST(ball_behind_the_head_string) {
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_STRAIGHT);
  place_ball(1, 0.15, 0.15);
  place_ball(2, 0.635, 2.5);
  carom_plan_stroke best;
  job.leave = CAROM_LEAVE_KITCHEN;
  plan(true, &best, 1);
  ck_assert(best.place[1] <= 0.25 * table.length);
  ck_assert_msg(best.ball != 1 || best.cue.phi < 180.0, "ball %d, %g degrees", best.ball,
                best.cue.phi);

  /* nor where it has been placed there, 0.3 m from that ball */
  for (int64_t leave = 0; leave <= CAROM_LEAVE_KITCHEN; leave += CAROM_LEAVE_KITCHEN) {
    place_ball(0, 0.36, 0.36);
    job.leave = leave;
    plan(false, &best, 1);
    const bool direct = best.ball == 1 && best.cue.phi > 180.0 && best.kind != CAROM_PLAN_KICK;
    ck_assert_msg(direct == (leave == 0), "ball %d, %g degrees", best.ball, best.cue.phi);
  }
}

/* The leave reports whether a stroke is from behind the head string, and a bound does not: an upper
 * bound on that string, or 1 um next to it, has one plan. The only target is behind the string. */
TEST(leave_and_not_a_bound) {
  static const double places[][2] = {{0.6, 0.6}, {0.4, 0.35}, {0.9, 2.1}};
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  options.shots = 2000;
  for (int k = 0; k < 3; k++)
    place_ball(k, places[k][0], places[k][1]);
  make_memory();
  const double low[2] = {0.03, 0.03};
  double foul[2];
  for (int barred = 0; barred < 2; barred++) {
    carom_plan_stroke best[3];
    job.leave = barred != 0 ? CAROM_LEAVE_KITCHEN : CAROM_LEAVE_ANYWHERE;
    for (int k = 0; k < 3; k++) {
      const double high[2] = {1.24, 0.25 * table.length + 1e-6 * (k - 1)};
      int found;
      expect_ok(carom_plan_hand(&job, low, high, &best[k], 1, &found));
      ck_assert_msg(best[k].kind == best[0].kind && best[k].ball == best[0].ball,
                    "leave %d, bound %d: %s of ball %d", (int)job.leave, k,
                    carom_word_text(CAROM_WORDS_PLAN_KIND, best[k].kind), best[k].ball);
      ck_assert_double_eq_tol(best[k].cue.phi, best[0].cue.phi, 0.1);
      ck_assert_double_eq_tol(best[k].value, best[0].value, 0.01);
    }
    foul[barred] = best[0].cue.phi;
  }
  ck_assert(fabs(foul[0] - foul[1]) > 1.0); /* the barred ball is not met directly */
  edge_free(&memory);
}

/* Every leave bounds the position of a ball in hand, with the plan's place on or within its
 * bounds. */
TEST(bounds_of_every_leave) {
  static const double high[] = {1.0, 1.0, 1.0, 0.25, 0.2, 0.2}; /* of the length, from the head */
  make_layout(3, 4);
  for (int leave = CAROM_LEAVE_AFTER; leave <= CAROM_LEAVE_BAULK; leave++) {
    const double radius = balls[0].kind.radius;
    carom_bounds bounds;
    carom_plan_stroke best;
    job.leave = leave;
    expect_ok(carom_hand_bounds((carom_leave)leave, &table, radius, &bounds));
    ck_assert((bounds.radius > 0.0) == (leave == CAROM_LEAVE_D));
    ck_assert_double_le(bounds.high[1], high[leave] * table.length + 0.02);
    plan(true, &best, 1);
    ck_assert_msg(carom_is_within(&bounds, best.place[0], best.place[1]), "leave %d: %g, %g", leave,
                  best.place[0], best.place[1]);
  }
}

/* Straight pool is opened thinly and softly, hardly ever by a foul, and much of the rack stays.
 * Strokes at 6 to 9 m/s were chosen, which open it, up to a fifth of them fouls. */
TEST(openings) {
  for (uint64_t seed = 1; seed < 6; seed++) {
    carom_plan_stroke best;
    carom_ball_state final[BALLS];
    carom_shot shot = {.final = final};
    int moved = 0;
    make_break(CAROM_RULES_STRAIGHT, seed, 600.0);
    plan(true, &best, 1);
    place_ball(0, best.place[0], best.place[1]);
    expect_ok(carom_shoot(&table, balls, BALLS, &best.cue, NULL, &shot));
    for (int n = 1; n < BALLS; n++)
      moved += fabs(final[n].r[0] - balls[n].state.r[0]) > 0.05;
    ck_assert_msg(best.cue.speed < 5.0 && best.foul < 0.1 && moved < 10,
                  "seed %d: %g m/s, foul %g, %d balls moved", (int)seed, best.cue.speed, best.foul,
                  moved);
  }
}

/* Where six balls are around the one, the player pushes out if he may; if he may pass, he does.
 * Where the one is before a pocket and another ball free, he plays. */
TEST(what_one_may_do) {
  carom_plan_stroke best;
  for (int easy = 0; easy < 2; easy++)
    for (int permission = 1; permission <= 2; permission++) {
      make_layout(1, 1);
      rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
      rules.state.may = permission == 1 ? CAROM_CHOICE_PUSH : CAROM_CHOICE_PASS;
      put_ring(easy ? 1 : 6);
      if (easy)
        place_ball(1, 0.1, 0.1);
      options.shots = 1000;
      job.count = 10;
      plan(false, &best, 1);
      const int kind = permission == 1 ? CAROM_PLAN_PUSH : CAROM_PLAN_PASS;
      int ball = permission == 1 ? CAROM_CALL_PUSH : CAROM_CALL_PASS;
      if (easy)
        ball = 1;
      ck_assert_msg((easy || best.kind == kind) && best.ball == ball,
                    "easy %d, may %d: kind %d, ball %d, %g", easy, permission, best.kind, best.ball,
                    best.value);
      ck_assert(best.kind != CAROM_PLAN_PASS || (best.foul == 0.0 && best.seen == 0));
    }
}

/* The chance to win of a side from a match's layout, without the choices that it may have. */
static double chance_of(const carom_match *match, const carom_player *striker,
                        const carom_player *opponent) {
  static carom_match copy;
  carom_plan_stroke best;
  int found;
  copy = *match;
  copy.rules.state.may = 0;
  options.shots = 600;
  job.player = striker;
  job.opponent = opponent;
  make_memory();
  expect_ok(carom_match_plan(&copy, &job, &best, 1, &found));
  edge_free(&memory);
  return best.value;
}

/* What a push-out without errors is worth by plans of both sides from its leave. */
static double worth_of_push(const carom_cue *stroke, const carom_player *opponent) {
  static carom_match match;
  expect_ok(carom_match_begin_with(&match, &(carom_match_setup){.rules = CAROM_RULES_NINEBALL,
                                                                .of = &rules,
                                                                .table = &table,
                                                                .balls = balls,
                                                                .count = 10}));
  expect_ok(carom_match_choose(&match, 0, CAROM_CHOICE_PUSH));
  expect_ok(carom_match_stroke(&match, 0, stroke, NULL, NULL));
  const double worth = 1.0 - chance_of(&match, opponent, &player);
  if (match.ruling.turn.foul != 0)
    return worth;
  expect_ok(carom_match_choose(&match, 1, CAROM_CHOICE_PASS));
  return fmin(worth, chance_of(&match, &player, opponent));
}

/* Push-outs are chosen by what they leave, against an opponent who is as good and one who is not:
 * they are worth more than push-outs in other directions, and about as much as plans tell, in one
 * call or in slices. */
TEST(push_outs_by_their_leaves) {
  enum { OTHERS = 3 };
  const int layouts = draws_of_test(3, 6);
  random_source r = {5};
  double chosen = 0.0, other = 0.0, told = 0.0;
  int listed = 0;
  for (uint64_t seed = 1; listed < layouts; seed++) {
    make_layout(seed, 1);
    for (int k = 1; k < 10; k += 2)
      while (place_ball(k, random_between(&r, 0.05, 1.2), random_between(&r, 0.05, 2.4)) != 0)
        continue;
    rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    rules.state.may = CAROM_CHOICE_PUSH;
    player = carom_player_of(0.5);
    const carom_player opponent = carom_player_of(seed % 2 == 0 ? 0.5 : 1.5);
    job.count = 10;
    job.opponent = &opponent;
    carom_plan_stroke whole[4], sliced[4];
    int push = 0, parts = 0;
    const int found = plan(false, whole, 4);
    while (push < found && whole[push].kind != CAROM_PLAN_PUSH)
      push++;
    if (push == found)
      continue;

    /* the same in slices */
    options.slice = 2000;
    make_memory();
    expect_ok(carom_plan(&job, sliced, 4, &parts));
    while (parts == 0)
      expect_ok(carom_plan_continue(&job, sliced, 4, &parts));
    edge_free(&memory);
    options.slice = 0;
    ck_assert(parts == found && memcmp(whole, sliced, (size_t)found * sizeof whole[0]) == 0);

    carom_cue stroke = whole[push].cue;
    ck_assert(whole[push].value <= 1.0 - whole[push].leave[0] + 1e-6 &&
              whole[push].value <= whole[push].leave[1] + 1e-6);
    told += whole[push].value;
    chosen += worth_of_push(&stroke, &opponent);
    for (int n = 0; n < OTHERS; n++) {
      stroke.phi = random_between(&r, 0.0, 360.0);
      stroke.theta = 10.0;
      other += worth_of_push(&stroke, &opponent) / OTHERS;
    }
    listed++;
  }
  printf("push-outs told %.3f, came %.3f, others %.3f\n", told / layouts, chosen / layouts,
         other / layouts);
  ck_assert_double_gt(chosen, other);
  ck_assert_double_le(fabs(told - chosen) / layouts, 0.06);
}

/* A plan that is stopped at once has a choice still; one without a legal shot says so. */
TEST(little_to_choose) {
  const volatile int32_t at_once = 1;
  carom_plan_stroke best;
  make_layout(3, 6);
  options.stop = &at_once;
  ck_assert(plan(false, &best, 1) == 1 && best.seen == 0);
  best = repeat(&best.cue);
  ck_assert(best.seen == 0 && isnan(best.value));

  /* six balls are around the only one that is on */
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  put_ring(6);
  job.count = 10;
  ck_assert(plan(false, &best, 1) == 1 && best.kind == CAROM_PLAN_FOUL && best.foul == 1.0 &&
            best.ball == -1 && best.pocket == -1);
}

/* A game of safe play is opened by a soft stroke that fouls seldom; so are others of the list. */
TEST(soft_openings) {
  for (uint64_t k = 0; k < 4; k++) {
    lay_out_game(k % 2 == 0 ? CAROM_RULES_ONEPOCKET : CAROM_RULES_SNOOKER, k);
    options = (carom_plan_options){.shots = 300, .seed = k};
    make_memory();
    carom_plan_stroke listed[5];
    int found;
    const double high[2] = {table.width, 0.25 * table.length};
    expect_ok(carom_plan_hand(&job, NULL, high, listed, 5, &found));
    for (int n = 0; n < found; n++)
      ck_assert(listed[n].cue.speed < 4.5 && listed[n].foul <= 0.1 && listed[n].seen >= 20);
    ck_assert(found >= 1 && listed[0].seen >= 40);
    edge_free(&memory);
  }
}

/* A stroke that made no point in its fresh shots is behind those that made one. */
TEST(what_is_worth_nothing_is_not_first) {
  enum { SEEDS = 12, ROOM = 5 };
  int points = 0;
  for (uint64_t seed = 0; seed < SEEDS; seed++) {
    lay_out_game(CAROM_RULES_THREECUSHION, 1);
    rules.state.opening = 1;
    options = (carom_plan_options){.shots = 200, .seed = seed};
    carom_plan_stroke choices[ROOM];
    const int found = plan(false, choices, ROOM);
    for (int k = 1; k < found; k++)
      ck_assert_msg(choices[0].value > 0.0 || choices[k].keep == 0.0, "seed %d: choice %d keeps %g",
                    (int)seed, k, choices[k].keep);
    points += choices[0].value > 0.0;
  }
  ck_assert_int_gt(points, SEEDS / 2);
}
