/* Whole matches of the planner: killer and cut-throat with several numbers of seats, and English
 * billiards. CAROM_TEST_GAMES: how many of each; CAROM_TEST_TELL: each stroke. */
#include "games.h"
#include "match_support.h"

/* What holds after each stroke: sets are the balls on the table, at most one life is lost, and the
 * next seat has something left. */
static void check_state(carom_rules_kind kind, const carom_rules_state *earlier,
                        const carom_ruling *ruling, uint32_t in_play) {
  const carom_rules_state *after = &ruling->state;
  uint64_t sets = 0;
  int lost = 0, others = 0;
  for (int seat = 0; seat < CAROM_SEATS_MOST; seat++) {
    sets |= after->user[seat];
    lost += (int)(earlier->user[seat] - after->user[seat]);
    others += seat != after->seat && after->user[seat] != 0;
  }
  if (kind == CAROM_RULES_CUTTHROAT)
    ck_assert_uint_eq(sets, in_play & 0xfffe);
  if (kind == CAROM_RULES_KILLER)
    ck_assert(lost == 0 ||
              (lost == 1 && after->user[earlier->seat] + 1 == earlier->user[earlier->seat]));
  if (kind == CAROM_RULES_BILLIARDS)
    return;
  ck_assert(after->user[after->seat] != 0);
  ck_assert_int_eq(ruling->turn.outcome >= CAROM_TURN_WIN, others == 0);
  if (ruling->turn.outcome == CAROM_TURN_KEEP)
    ck_assert_int_eq(after->seat, earlier->seat);
}

static void tell(int number, const carom_plan_stroke *stroke) {
  char words[300], who[200];
  carom_ruling_string(&match.ruling, words, sizeof words);
  carom_match_string(&match, who, sizeof who);
  printf("%d. %s ball %d value %.2f; met %d,%d down %x: %s; points %g; %s:", number,
         carom_word_text(CAROM_WORDS_PLAN_KIND, stroke->kind), stroke->ball, stroke->value,
         match.ruling.facts.first[0], match.ruling.facts.first[1], match.ruling.facts.down, words,
         match.ruling.turn.points, who);
  carom_standing standing;
  carom_match_standing(&match, &standing);
  for (int side = 0; side < standing.sides; side++)
    printf(" %d", (int)standing.points[side]);
  printf("\n");
}

/* Plays a match to its end, and returns its strokes. */
static int play_game(carom_rules_kind kind, int seats, uint64_t seed) {
  enum { STROKES_MOST = 3000, BILLIARDS_TARGET = 50 };
  const carom_player player = carom_player_of(kind == CAROM_RULES_KILLER ? 1.5 : 1.0);
  const carom_plan_options options = {.shots = 100, .seed = seed};
  carom_seating seating;
  carom_match_setup setup = {.rules = kind, .table = &table, .seed = seed, .seating = &seating};
  carom_plan_job job = {.player = &player, .options = &options};
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  expect_ok(carom_seating_make(kind, seats, &seating));
  if (kind == CAROM_RULES_BILLIARDS)
    setup.target = BILLIARDS_TARGET;
  expect_ok(carom_match_begin_with(&match, &setup));
  file_size = 0;
  keep();
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  int strokes = 0;
  while (match.phase != CAROM_MATCH_OVER && strokes < STROKES_MOST) {
    carom_plan_stroke best;
    int found = 0;
    const carom_rules_state state = match.rules.state;
    const carom_status status = carom_match_plan(&match, &job, &best, 1, &found);
    ck_assert_msg(status >= 0 && found == 1, "%s: %s", match.fault, carom_status_name(status));
    expect_ok(carom_match_prepare(&match, match.seat, &best));
    keep();
    carom_player_strike(&player, seed, (uint64_t)++strokes, &best.cue);
    ck_assert_msg(carom_match_stroke(&match, match.seat, &best.cue, NULL, NULL) >= 0, "%s",
                  match.fault);
    keep();
    if (getenv("CAROM_TEST_TELL") != NULL)
      tell(strokes, &best);
    uint32_t in_play = 0;
    for (int k = 0; k < match.record.count; k++)
      in_play |= (uint32_t)(match.record.balls[k].state.label != CAROM_BALL_POCKETED) << k;
    check_state(kind, &state, &match.ruling, in_play);
  }
  free(job.memory);
  check_recording("a game of seats");
  return match.phase == CAROM_MATCH_OVER ? strokes : 0;
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
      const int strokes = play_game(rows[k].kind, rows[k].seats, test_seed() + (uint64_t)game);
      ck_assert_int_gt(strokes, 0);
      total += strokes;
      won[match.winner - 1]++;
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
        ck_assert_int_eq(carom_seat_points((carom_rules_kind)kind, state.user[seat]),
                         seat < seats ? 15 / seats : 0);
    }
}

/* A seat with more left wins more often, and one that is alone has won. */
TEST(values_of_seats) {
  for (int kind = CAROM_RULES_KILLER; kind <= CAROM_RULES_CUTTHROAT; kind++) {
    carom_plan_rules rules = carom_plan_rules_of((carom_rules_kind)kind);
    static const uint64_t lives[] = {3, 2, 2}, sets[] = {0x3e, 0xc0, 0x1800};
    const uint64_t *more = sets;
    if (kind == CAROM_RULES_KILLER)
      more = lives;
    memcpy(rules.state.user, more, sizeof lives);
    const double first = rules.value(&rules.state, &balls->state, 0, 0);
    rules.state.seat = 1;
    const double second = rules.value(&rules.state, &balls->state, 0, 0);
    ck_assert(first > 1.0 / 3.0 && second > 0.0 && second < first && first < 1.0);
    rules.state.seat = 0;
    rules.state.user[1] = rules.state.user[2] = 0;
    ck_assert_double_eq_tol(rules.value(&rules.state, &balls->state, 0, 0), 1.0, 1e-6);
  }
}
