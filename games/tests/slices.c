/* Plans that are stopped, and plans and run-outs in slices. */
#include "carom_coach.h"
#include "carom_match.h"
#include "plan_support.h"

/* Rules that stop the plan when they have judged so many shots. */
static carom_plan_rules stopped_rules;
static volatile int32_t stop;
static int64_t judged, judged_most;
static carom_turn judge_and_stop(carom_rules_state *state, uint32_t in_play, int cue_ball,
                                 const carom_facts *facts, carom_call call) {
  stop |= ++judged == judged_most;
  return stopped_rules.judge(state, in_play, cue_ball, facts, call);
}

/* Plans, of a cue ball in hand or not, in the memory of the job. Returns how many choices there
 * are, 0 if the plan continues. */
static int start_plan(bool in_hand, carom_plan_stroke *choices, int most) {
  int found = 0;
  expect_ok(in_hand ? carom_plan_hand(&job, NULL, NULL, choices, most, &found)
                    : carom_plan(&job, choices, most, &found));
  return found;
}

static int continue_plan(carom_plan_stroke *choices, int most) {
  int found = 0;
  expect_ok(carom_plan_continue(&job, choices, most, &found));
  return found;
}

/* A plan that is stopped judges no other shot, but for one of a stage that has not begun. It gives
 * the best so far: of ball in hand no worse a position than it had before. */
TEST(stopped_plans) {
  enum { PLAN, HAND, TRY };
  for (int kind = PLAN; kind <= TRY; kind++) {
    carom_plan_stroke best[2];
    int found = 1;
    double value = 0.0;
    make_layout(3, 6);
    stopped_rules = rules;
    rules.judge = judge_and_stop;
    options.shots = 3000;
    options.stop = &stop;
    make_memory();
    const carom_cue cues[2] = {{.speed = 2.0, .phi = 80.0}, {.speed = 3.0, .phi = 100.0}};
    for (judged_most = 1; judged_most <= 2900; judged_most += judged_most < 3 ? 1 : 289) {
      judged = stop = 0;
      if (kind == TRY)
        expect_ok(carom_plan_try(&job, cues, 2, best));
      else
        found = start_plan(kind == HAND, best, 2);
      if (stop == 0)
        break;
      ck_assert_int_le(judged, judged_most + 2);
      ck_assert(found == 1 && best[0].seen <= judged);
      ck_assert((best[0].value >= 0.0 && best[0].value <= 1.0) || (kind == TRY && judged == 1));
      if (kind == HAND && best[0].seen > 0) {
        ck_assert(best[0].value > value - 0.05);
        value = best[0].value;
      }
    }
    if (kind == TRY)
      ck_assert(best[0].seen == 1500 && best[1].seen > 0 && best[1].seen < 1500);
    edge_free(&memory);
  }
}

/* A plan that is stopped at once gives a choice that the match takes. */
TEST(stopped_plans_can_be_played) {
  static carom_match match;
  make_layout(1, 2);
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++)
    for (uint64_t seed = 0; seed < 20; seed++) {
      const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)kind);
      carom_plan_stroke best;
      int found;
      carom_table_make((carom_table_kind)about->table, &table);
      expect_ok(carom_match_begin(&match, (carom_rules_kind)kind, &table, seed, 0));
      cue = carom_cue_of((carom_game)about->balls);
      stop = 1;
      options = (carom_plan_options){.shots = 200, .seed = seed, .stop = &stop};
      make_memory();
      expect_ok(carom_match_plan(&match, &job, &best, 1, &found));
      edge_free(&memory);
      ck_assert_msg(carom_match_prepare(&match, 0, &best) == CAROM_OK, "%s, seed %d: %s",
                    about->name, (int)seed, match.fault);
    }
}

/* A plan in slices has the choices of one call, bit for bit, and a slice plays no more shots than
 * it has events. */
TEST(plans_in_slices) {
  static const int64_t slices[] = {1, 37, 1000};
  for (int kind = 0; kind < 6; kind++) {
    const bool hand = kind % 2 == 1;
    carom_plan_stroke whole[3], best[3];
    make_layout((uint64_t)kind + 1, kind < 4 ? 6 : 1);
    rules = carom_plan_rules_of(kind < 2 ? CAROM_RULES_EIGHTBALL : CAROM_RULES_NINEBALL);
    if (kind >= 4) { /* nothing is to be hit, or the player may pass */
      put_ring(6);
      job.count = 10;
      rules.state.may = kind == 5 ? CAROM_CHOICE_PASS : 0;
    }
    stopped_rules = rules;
    rules.judge = judge_and_stop;
    options.unsure = kind == 1 || kind == 2 ? 0.5 : 0.0;
    options.threads = kind % 3;
    options.seconds = kind < 2 ? 1e5 : 0.0; /* these double */
    options.shots = kind < 2 ? 1500 : 300;
    make_memory();
    judged_most = -1;
    const int found_whole = start_plan(hand, whole, 3);
    for (size_t k = 0; k < COUNT_OF(slices); k++) {
      options.slice = slices[k];
      options.threads = 0; /* the judge counts */
      judged = 0;
      int64_t calls = 1;
      memset(job.memory, 0x55, job.memory_size);
      int found = start_plan(hand, best, 3);
      int64_t previous = judged;
      for (; found == 0; calls++) {
        previous = judged;
        found = continue_plan(best, 3);
        ck_assert_int_le(judged - previous, slices[k] + 1); /* one is not to play */
      }
      ck_assert_int_eq(found, found_whole);
      ck_assert_mem_eq(best, whole, (size_t)found * sizeof *best);
      ck_assert(calls >= judged / slices[k]);

      /* what has ended stays as it is */
      previous = judged;
      found = continue_plan(best, 3);
      ck_assert_mem_eq(best, whole, (size_t)found * sizeof *best);
      ck_assert_int_eq(judged, previous);
    }
    edge_free(&memory);
  }
}

/* A run-out in slices has the strokes of one call, bit for bit, and a slice judges no more shots
 * than it has events, but those of a plan that begins. Another job is rejected. */
TEST(run_outs_in_slices) {
  static const int64_t slices[] = {1, 40, 1000};
  static carom_sequence_stroke whole[CAROM_SEQUENCE_MOST], strokes[CAROM_SEQUENCE_MOST];
  for (int hand = 0; hand < 2; hand++) {
    int found_whole, found;
    make_layout(4, 3);
    job.leave = hand ? CAROM_LEAVE_ANYWHERE : CAROM_LEAVE_AFTER;
    stopped_rules = rules;
    rules.judge = judge_and_stop;
    judged_most = -1;
    options = (carom_plan_options){.shots = 200, .seed = 4};
    job.memory_size = carom_sequence_memory(&options);
    memory = edge_make(job.memory_size, true);
    job.memory = memory.memory;
    expect_ok(carom_sequence(&job, hand, 0.03, whole, CAROM_SEQUENCE_MOST, &found_whole));
    ck_assert_int_gt(found_whole, 1);
    for (size_t k = 0; k < COUNT_OF(slices); k++) {
      options.slice = slices[k];
      memset(job.memory, 0x55, job.memory_size);
      memset(strokes, 0x55, sizeof strokes);
      int64_t most = 0, calls = 0;
      judged = 0;
      expect_ok(carom_sequence(&job, hand, 0.03, strokes, CAROM_SEQUENCE_MOST, &found));
      for (; found == 0; calls++) {
        const int64_t previous = judged;
        expect_ok(carom_sequence_continue(&job, &found));
        if (judged - previous > most)
          most = judged - previous;
      }
      ck_assert_int_le(most, slices[k] + 2);
      ck_assert_int_gt(calls, judged / (slices[k] + 2));
      ck_assert_int_eq(found, found_whole);
      ck_assert_mem_eq(strokes, whole, (size_t)found * sizeof *strokes);
      expect_ok(carom_sequence_continue(&job, &found)); /* what has ended stays */
      ck_assert_int_eq(found, found_whole);
    }
    options.seed++;
    ck_assert_int_eq(carom_sequence_continue(&job, &found), CAROM_ERROR_STATE);
    edge_free(&memory);
  }
}

/* Values of layouts that were requested. */
static int64_t values;
static double count_values(const carom_rules_state *state, const carom_ball_state *layout,
                           int count, int in_hand) {
  (void)state, (void)layout, (void)count, (void)in_hand;
  values++;
  return 0.5;
}

/* No slice tries all positions of a cue ball in hand, which would take longer than its shots. */
TEST(places_in_slices) {
  carom_plan_stroke best;
  int found;
  make_layout(3, 6);
  rules.value = count_values;
  options.slice = 100;
  make_memory();
  values = 0;
  found = start_plan(true, &best, 1);
  while (found == 0) {
    ck_assert_int_le(values, options.slice / 5);
    values = 0;
    found = continue_plan(&best, 1);
  }
  edge_free(&memory);
}

/* Further touches of the tip before the last two shots of a slice, which may be played together,
 * and of these. */
static int64_t touches, last_touches[2];
static carom_turn count_touches(carom_rules_state *state, uint32_t in_play, int cue_ball,
                                const carom_facts *facts, carom_call call) {
  touches += last_touches[0];
  last_touches[0] = last_touches[1];
  last_touches[1] = facts->touches > 1 ? facts->touches - 1 : 0;
  return stopped_rules.judge(state, in_play, cue_ball, facts, call);
}

/* A touch of the tip behind the first takes as long as many events, so a slice has few of them: in
 * straight rail, with the cue ball close to a cushion, for a player whose errors do not grow. */
TEST(touches_in_slices) {
  enum { TOUCH = 50 }; /* events of a slice, at least */
  carom_plan_stroke best;
  int64_t total = 0;
  lay_out_game(CAROM_RULES_STRAIGHTRAIL, 1);
  balls[0].state.r[0] = balls[0].kind.radius + 0.003;
  player = (carom_player){.speed = 0.1, .phi = 0.1};
  stopped_rules = rules;
  rules.judge = count_touches;
  options.slice = 500;
  make_memory();
  touches = last_touches[0] = last_touches[1] = 0;
  for (int found = start_plan(false, &best, 1); found == 0; found = continue_plan(&best, 1)) {
    ck_assert_int_le(TOUCH * touches, options.slice);
    total += touches + last_touches[0] + last_touches[1];
    touches = last_touches[0] = last_touches[1] = 0;
  }
  ck_assert_int_gt(total, 20);
  edge_free(&memory);
}

/* A plan of many shots that is stopped is about as good as a whole one of half of those that it has
 * played, by fresh strokes; and one whose seconds are over is stopped. */
TEST(stopped_plans_are_worth_their_shots) {
  enum { LAYOUTS = 12, STOPS = 3 };
  static const int64_t stops[STOPS] = {600, 2000, 8000};
  double less[STOPS] = {0.0};
  for (uint64_t seed = 1; seed <= LAYOUTS; seed++) {
    make_layout(seed, 8);
    player = carom_player_fargo(600);
    stopped_rules = rules;
    options.seed = seed;
    make_memory();
    carom_plan_stroke best[STOPS + 1], worth[STOPS + 1];
    int found;
    expect_ok(carom_plan(&job, best, 1, &found));
    edge_free(&memory);
    options.shots = 20000;
    options.stop = &stop;
    make_memory();
    rules.judge = judge_and_stop;
    for (int k = 0; k < STOPS; k++) {
      judged = stop = 0;
      judged_most = stops[k];
      expect_ok(carom_plan(&job, &best[k + 1], 1, &found));
      ck_assert(stop && found == 1 && best[k + 1].seen > 0);
    }
    stop = 0;
    options.seconds = 1e-9;
    expect_ok(carom_plan(&job, worth, 1, &found));
    ck_assert(found == 1 && worth[0].seen == 0);

    /* fresh strokes */
    judged_most = -1;
    options = (carom_plan_options){.shots = (STOPS + 1) * 500, .seed = 777};
    carom_cue cues[STOPS + 1];
    for (int k = 0; k <= STOPS; k++)
      cues[k] = best[k].cue;
    expect_ok(carom_plan_try(&job, cues, STOPS + 1, worth));
    for (int k = 0; k < STOPS; k++)
      less[k] += (worth[0].value - worth[k + 1].value) / LAYOUTS;
    edge_free(&memory);
  }
  printf("stopped after 600, 2000 and 8000 shots: %+.3f, %+.3f, %+.3f to 300 shots\n", -less[0],
         -less[1], -less[2]);
  ck_assert(less[0] < 0.05 && less[1] < 0.02 && less[2] < 0.01);
}

/* A plan that continues with something else is rejected; one that is stopped between slices
 * ends. */
TEST(slices_of_other_plans) {
  carom_plan_stroke best;
  int found;
  make_layout(3, 6);
  options.slice = 50;
  options.stop = &stop;
  make_memory();
  memset(job.memory, 0, job.memory_size);
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
  stop = 0;
  ck_assert_int_eq(start_plan(false, &best, 1), 0);
  double *numbers[] = {&balls[8].state.r[0], &table.width, &cue.mass, &player.phi,
                       &options.chance_me};
  for (size_t k = 0; k < COUNT_OF(numbers); k++) {
    const double original = *numbers[k];
    *numbers[k] += 1e-9;
    ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
    *numbers[k] = original;
  }
  ck_assert_int_eq(continue_plan(&best, 1), 0);
  stop = 1;
  ck_assert_int_eq(continue_plan(&best, 1), 1);

  /* a plan that was rejected leaves nothing to continue with */
  stop = 0;
  expect_ok(carom_plan(&job, &best, 1, &found));
  balls[8].state.v[0] = 1.0;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_ERROR_IN_MOTION);
  balls[8].state.v[0] = 0.0;
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
  edge_free(&memory);
}
