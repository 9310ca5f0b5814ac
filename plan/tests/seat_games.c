/* Whole games of the planner by the referee alone: killer and cut-throat with all numbers of seats,
 * and English billiards. CAROM_TEST_GAMES: how many of each; CAROM_TEST_TELL: each stroke of one.
 */
#include "game_support.h"
#include "games.h"
#include "rules.h"

/* What holds after each stroke: sets are the balls on the table, at most one life is lost, and the
 * next seat has something left. */
static void check_state(carom_rules_kind kind, const carom_rules_state *before,
                        const carom_ruling *ruling, uint32_t in_play) {
  const carom_rules_state *after = &ruling->state;
  uint64_t sets = 0;
  int lost = 0, others = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++) {
    sets |= after->user[seat];
    lost += (int)(before->user[seat] - after->user[seat]);
    others += seat != after->seat && after->user[seat] != 0;
  }
  if (kind == CAROM_RULES_CUTTHROAT)
    ck_assert_uint_eq(sets, in_play & 0xfffe);
  if (kind == CAROM_RULES_KILLER)
    ck_assert(lost == 0 ||
              (lost == 1 && after->user[before->seat] + 1 == before->user[before->seat]));
  if (kind == CAROM_RULES_BILLIARDS)
    return;
  ck_assert(after->user[after->seat] != 0);
  ck_assert_int_eq(ruling->turn.outcome >= CAROM_TURN_WIN, others == 0);
  if (ruling->turn.outcome == CAROM_TURN_KEEP)
    ck_assert_int_eq(after->seat, before->seat);
}

static void tell(int number, const carom_rules_state *state, const carom_plan_stroke *stroke,
                 const carom_ruling *ruling, int count) {
  char words[300];
  carom_ruling_string(ruling, words, sizeof words);
  printf(
      "%d. seat %d group %d: %s ball %d value %.2f; met %d,%d down %x: %s; points %g score %d,%d "
      "seat %d:",
      number, state->seat, state->group, carom_plan_kind_name(stroke->kind), stroke->ball,
      stroke->value, ruling->facts.first[0], ruling->facts.first[1], ruling->facts.down, words,
      ruling->turn.points, ruling->state.score[0], ruling->state.score[1], ruling->state.seat);
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++)
    printf(" %llx", (unsigned long long)ruling->state.user[seat]);
  for (int k = 0; k < count && count < 5; k++)
    printf(" %d@%.3f,%.3f%s", k, ruling->balls[k].state.r[0], ruling->balls[k].state.r[1],
           ruling->balls[k].state.label == CAROM_BALL_POCKETED ? " down" : "");
  printf("\n");
}

/* Plays a game to its end, and returns its strokes; *winner is the seat, or the cue ball, that has
 * won. */
static int play_game(carom_rules_kind kind, int seats, uint64_t seed, int *winner) {
  enum { STROKES_MOST = 3000 };
  const carom_rules_about *about = carom_rules_about_of(kind);
  const carom_rack_kind rack = (carom_rack_kind)about->rack;
  const carom_player player = carom_player_of(kind == CAROM_RULES_KILLER ? 1.5 : 1.0);
  const carom_plan_options options = {.shots = 100, .seed = seed};
  carom_plan_rules rules = carom_plan_rules_of(kind);
  expect_ok(carom_begin_seats(kind, seats, &rules.state));
  rules.state.opening = carom_has_opening(kind);
  rules.state.target = (int32_t)carom_min(rules.state.target, 50);
  carom_table_make((carom_table_kind)about->table, &table);
  const int count = carom_rack_size(rack);
  expect_ok(carom_rack(rack, &table, 1e-4, seed, balls, CAROM_BALLS_MOST));
  carom_cue cue = carom_cue_of((carom_game)about->balls);
  carom_plan_job job = job_of(count, &cue, &player, &rules, &options);
  job.leave = about->opening;
  static carom_ruling ruling;
  bool hand = true;
  for (int strokes = 1; strokes <= STROKES_MOST; strokes++) {
    carom_plan_stroke best;
    int found = 0;
    cue.ball = carom_cue_ball_of(&rules);
    carom_status status;
    if (hand)
      status = carom_plan_hand(&job, NULL, NULL, &best, 1, &found);
    else
      status = carom_plan(&job, &best, 1, &found);
    ck_assert_msg(status >= 0 && found == 1, "%s: %s", about->name, carom_status_name(status));
    if (hand)
      expect_ok(carom_place_ball(&table, balls, count, (int)cue.ball, best.place[0], best.place[1],
                                 NULL));
    cue = best.cue;
    carom_player_strike(&player, seed, (uint64_t)strokes, &cue);
    carom_facts facts;
    carom_ball_state final[CAROM_BALLS_MOST];
    carom_shot shot = {.facts = &facts, .final = final};
    ck_assert(carom_shoot(&table, balls, count, &cue, NULL, &shot) >= 0);
    facts.barred = carom_barred_from(&rules, (carom_leave)job.leave, &facts, &table, balls, count);
    expect_ok(carom_referee(&rules, &table, balls, count, (int)cue.ball, &shot,
                            (carom_call){best.ball, best.pocket}, &ruling));
    if (getenv("CAROM_TEST_TELL") != NULL)
      tell(strokes, &rules.state, &best, &ruling, count);
    memcpy(balls, ruling.balls, sizeof balls);
    hand = ruling.hand != 0;
    job.leave = ruling.turn.leave;
    check_state(kind, &rules.state, &ruling, carom_on_table(balls, count));
    const int32_t group = rules.state.group;
    rules.state = ruling.state;
    *winner = rules.state.seat;
    if (kind == CAROM_RULES_BILLIARDS)
      *winner = (ruling.turn.outcome == CAROM_TURN_WIN) == (group == 2);
    if (ruling.turn.outcome >= CAROM_TURN_WIN) {
      free(job.memory);
      return strokes;
    }
  }
  free(job.memory);
  return 0;
}

TEST(games_end) {
  const char *setting = getenv("CAROM_TEST_GAMES");
  const int games = setting != NULL ? atoi(setting) : 1;
  static const struct {
    carom_rules_kind kind;
    int seats;
  } rows[] = {{CAROM_RULES_KILLER, 2},    {CAROM_RULES_KILLER, 3},    {CAROM_RULES_KILLER, 8},
              {CAROM_RULES_CUTTHROAT, 3}, {CAROM_RULES_CUTTHROAT, 5}, {CAROM_RULES_BILLIARDS, 2}};
  for (size_t k = 0; k < COUNT_OF(rows); k++) {
    int total = 0, won[CAROM_SEATS_MOST] = {0};
    for (int game = 0; game < games; game++) {
      int winner = 0;
      const int strokes =
          play_game(rows[k].kind, rows[k].seats, test_seed() + (uint64_t)game, &winner);
      ck_assert_int_gt(strokes, 0);
      total += strokes;
      won[winner]++;
    }
    printf("%s, %d seats: %d games, %d strokes; won by seat:",
           carom_rules_about_of(rows[k].kind)->name, rows[k].seats, games, total);
    for (int seat = 0; seat < rows[k].seats; seat++)
      printf(" %d", won[seat]);
    printf("\n");
  }
}

/* How many seats a game may have, and that each of them begins with as much. */
TEST(numbers_of_seats) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++)
    for (int seats = 0; seats <= CAROM_SEATS_MOST + 1; seats++) {
      carom_rules_state state = carom_plan_rules_of((carom_rules_kind)kind).state;
      bool may = seats == 2;
      if (kind == CAROM_RULES_KILLER)
        may = seats >= 2 && seats <= 8;
      if (kind == CAROM_RULES_CUTTHROAT)
        may = seats == 3 || seats == 5;
      const carom_status status = carom_begin_seats((carom_rules_kind)kind, seats, &state);
      ck_assert_int_eq(status == CAROM_OK, may);
      for (int seat = 0; seat < CAROM_SEATS_MOST && may && kind == CAROM_RULES_CUTTHROAT; seat++)
        ck_assert_int_eq(carom_count_of((uint32_t)state.user[seat]), seat < seats ? 15 / seats : 0);
    }
}

/* A seat with more left wins more often, and one that is alone has won. */
TEST(values_of_seats) {
  for (int kind = CAROM_RULES_KILLER; kind <= CAROM_RULES_CUTTHROAT; kind++) {
    carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)kind);
    const bool lives = kind == CAROM_RULES_KILLER;
    const uint64_t more[] = {lives ? 3 : 0x3e, lives ? 2 : 0xc0, lives ? 2 : 0x1800};
    memcpy(rules.state.user, more, sizeof more);
    const double first = rules.value(&rules.state, &balls->state, 0, 0);
    rules.state.seat = 1;
    const double second = rules.value(&rules.state, &balls->state, 0, 0);
    ck_assert(first > 1.0 / 3.0 && second > 0.0 && second < first && first < 1.0);
    rules.state.seat = 0;
    rules.state.user[1] = rules.state.user[2] = 0;
    ck_assert_double_eq_tol(rules.value(&rules.state, &balls->state, 0, 0), 1.0, 1e-6);
  }
}
