/* Whole games of the planner against itself through matches: none has a dead end, and one of
 * each is read again. CAROM_TEST_GAMES: how many of each game; CAROM_TEST_GAME: of which alone. */
#include "carom_match.h"
#include "game_support.h"

static carom_match match;

/* Puts the cue ball in hand somewhere within its bounds, where a plan found no place. */
static void place_anywhere(random_source *r) {
  const carom_bounds *b = &match.bounds;
  const double x = random_between(r, b->low[0], b->high[0]);
  carom_match_place(&match, (int)match.record.player, x, random_between(r, b->low[1], b->high[1]));
}

/* One stroke by a plan, with a player's errors. */
static carom_status play_planned(carom_plan_job *job, random_source *r, uint64_t number) {
  const int player = (int)match.record.player;
  carom_cue cue =
      carom_cue_of((carom_game)carom_rules_about_of((carom_rules_kind)match.record.rules)->balls);
  cue.ball = match.cue_ball;
  job->cue = &cue;
  carom_choice best;
  int found = 0;
  const carom_status planned = carom_match_plan(&match, job, &best, 1, &found);
  if (planned != CAROM_OK || found == 0) {
    place_anywhere(r);
    return planned;
  }
  if (match.phase == CAROM_MATCH_PLACE &&
      carom_match_place(&match, player, best.place[0], best.place[1]) != CAROM_OK)
    place_anywhere(r);
  if (best.kind == CAROM_PLAN_PASS)
    return carom_match_choose(&match, player, CAROM_MAY_PASS);
  if (best.kind == CAROM_PLAN_PUSH)
    carom_match_choose(&match, player, CAROM_MAY_PUSH);
  else if (match.rules.calls != 0 && best.ball >= 0)
    carom_match_call(&match, player, (carom_call){best.ball, best.pocket});
  carom_player_strike(job->player, 7, number, &best.cue);
  return carom_match_stroke(&match, player, &best.cue, NULL, NULL);
}

/* The strokes of one game; 0 where it did not end. */
static int strokes_of_game(carom_rules_kind kind, uint64_t seed) {
  enum { STROKES_MOST = 2000, SHOTS = 100 };
  const carom_player player = carom_player_of(0.5);
  const carom_plan_options options = {.shots = SHOTS, .seed = seed};
  const bool tells = getenv("CAROM_TEST_TELL") != NULL;
  carom_plan_job job = {.player = &player, .options = &options};
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  random_source r = {seed};
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  ck_assert_int_eq(carom_match_begin(&match, kind, &table, seed, (int)(seed & 1)), CAROM_OK);
  ck_assert_int_eq(match.cue_ball, carom_cue_ball_of(&match.rules));
  int strokes = 0;
  while (match.phase != CAROM_MATCH_OVER && strokes < STROKES_MOST) {
    const int64_t who = match.record.player;
    const carom_status status = play_planned(&job, &r, (uint64_t)strokes++);
    char text[300] = "";
    carom_ruling_string(&match.ruling, text, sizeof text);
    if (tells)
      printf("%d. player %d, ball %d, met %d, down %x: %s; score %d, %d, lost %d\n", strokes,
             (int)who, (int)match.record.cue.ball, match.ruling.facts.first[0],
             match.ruling.facts.down, text, match.rules.state.score[0], match.rules.state.score[1],
             match.rules.state.lost[0]);
    ck_assert_msg(status >= 0 || match.phase == CAROM_MATCH_STROKE, "%s, seed %llu: %s: %s",
                  carom_rules_about_of(kind)->name, (unsigned long long)seed,
                  carom_status_name(status), match.fault);
  }
  free(job.memory);
  return match.phase == CAROM_MATCH_OVER ? strokes : 0;
}

TEST(games_end) {
  const char *given = getenv("CAROM_TEST_GAMES"), *only = getenv("CAROM_TEST_GAME");
  const int games = given != NULL ? atoi(given) : 1;
  for (int kind = CAROM_RULES_BLACKBALL; kind <= CAROM_RULES_COWBOY; kind++) {
    const char *name = carom_rules_about_of((carom_rules_kind)kind)->name;
    if (only != NULL && strcmp(name, only) != 0)
      continue;
    int ended = 0, strokes = 0;
    for (int k = 0; k < games; k++) {
      const int played = strokes_of_game((carom_rules_kind)kind, test_seed() + (uint64_t)k);
      ended += played > 0;
      strokes += played;
    }
    printf("%s: %d of %d games ended, %d strokes\n", name, ended, games, strokes);
    ck_assert_int_eq(ended, games);
  }
}
