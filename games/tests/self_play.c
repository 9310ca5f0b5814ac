/* Complete games of the planner against itself through matches: none has a dead end, and some are
 * the same on all machines. CAROM_TEST_GAMES: how many of each game; CAROM_TEST_GAME: of which. */
#include "carom_match.h"
#include "game_support.h"

static carom_match match;

/* What a ruling has in addition to the turn: falls in their order, who plays, words. */
static void check_ruling(const carom_ruling *r) {
  char words[300];
  uint32_t down = 0;
  for (int64_t k = 0; k < r->falls; k++) {
    down |= UINT32_C(1) << r->fall[k].ball;
    ck_assert(k == 0 || r->fall[k].time >= r->fall[k - 1].time);
    ck_assert_int_eq(r->fall[k].pocket, r->facts.pocket[r->fall[k].ball]);
  }
  ck_assert(down == r->facts.down);
  ck_assert_int_eq(r->hand, r->turn.leave >= CAROM_LEAVE_ANYWHERE);
  ck_assert((r->on != 0) == (r->turn.outcome < CAROM_TURN_WIN));
  const size_t length = carom_ruling_string(r, words, sizeof words);
  ck_assert(length == strlen(words) && carom_ruling_string(r, words, 5) == length && words[4] == 0);
}

/* Puts the cue ball in hand somewhere within its bounds, where a plan found no place. */
static void place_anywhere(random_source *r) {
  const carom_bounds *b = &match.bounds;
  const double x = random_between(r, b->low[0], b->high[0]);
  carom_match_place(&match, (int)match.record.side, x, random_between(r, b->low[1], b->high[1]));
}

/* One stroke by a plan, with a player's errors. */
static carom_status play_planned(carom_plan_job *job, random_source *r, uint64_t number) {
  const int player = (int)match.record.side;
  carom_cue cue =
      carom_cue_of((carom_game)carom_rules_about_of((carom_rules_kind)match.record.rules)->balls);
  cue.ball = match.cue_ball;
  job->cue = &cue;
  carom_plan_stroke best;
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
    return carom_match_choose(&match, player, CAROM_CHOICE_PASS);
  if (best.kind == CAROM_PLAN_PUSH)
    carom_match_choose(&match, player, CAROM_CHOICE_PUSH);
  else if (match.rules.calls != 0 && best.pocket >= 0)
    carom_match_call(&match, player, (carom_call){best.ball, best.pocket});
  carom_player_strike(job->player, 7, number, &best.cue);
  return carom_match_stroke(&match, player, &best.cue, NULL, NULL);
}

/* The strokes of one game, with equal innings or without; 0 where it did not end. *all: a hash of
 * strokes, states and layouts. */
static int strokes_of_game(carom_rules_kind kind, uint64_t seed, bool equal, uint64_t *total) {
  enum { STROKES_MOST = 2000, SHOTS = 100, EQUAL_TARGET = 10 };
  const carom_player player = carom_player_of(0.5);
  const carom_plan_options options = {.shots = SHOTS, .seed = seed};
  const bool tells = getenv("CAROM_TEST_TELL") != NULL;
  carom_plan_job job = {.player = &player, .options = &options};
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  random_source r = {seed};
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  ck_assert_int_eq(carom_match_begin(&match, kind, &table, seed, (int)(seed & 1)), CAROM_OK);
  if (equal)
    begin_equal(&match, kind, seed, (int)(seed & 1), EQUAL_TARGET);
  ck_assert_int_eq(match.cue_ball, carom_cue_ball_of(&match.rules));
  int strokes = 0;
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  while (match.phase != CAROM_MATCH_OVER && strokes < STROKES_MOST) {
    const int64_t seat = match.record.side;
    const carom_status status = play_planned(&job, &r, (uint64_t)strokes++);
    char text[300] = "";
    carom_ruling_string(&match.ruling, text, sizeof text);
    if (match.rulings > 0)
      check_ruling(&match.ruling);
    hash = hash_of(hash, &match.record.cue, sizeof match.record.cue);
    hash = hash_of(hash, &match.rules.state, offsetof(carom_rules_state, context));
    for (int k = 0; k < match.record.count; k++)
      hash = hash_of(hash, match.record.balls[k].state.r, sizeof match.record.balls[k].state.r);
    if (tells)
      printf("%d. player %d, ball %d, met %d, down %x: %s; score %d, %d, lost %d\n", strokes,
             (int)seat, (int)match.record.cue.ball, match.ruling.facts.first[0],
             match.ruling.facts.down, text, match.rules.state.score[0], match.rules.state.score[1],
             match.rules.state.lost[0]);
    ck_assert_msg(status >= 0 || match.phase == CAROM_MATCH_STROKE, "%s, seed %llu: %s: %s",
                  carom_rules_about_of(kind)->name, (unsigned long long)seed,
                  carom_status_name(status), match.fault);
  }
  free(job.memory);
  *total = hash;
  return match.phase == CAROM_MATCH_OVER ? strokes : 0;
}

TEST(games_end) {
  const char *setting = getenv("CAROM_TEST_GAMES"), *only = getenv("CAROM_TEST_GAME");
  const int games = setting != NULL ? atoi(setting) : 1;
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    const char *name = carom_rules_about_of((carom_rules_kind)kind)->name;
    const bool equal = knows_equal_innings((carom_rules_kind)kind);
    if (only != NULL ? strcmp(name, only) != 0 : kind < CAROM_RULES_TENBALL && !equal)
      continue;
    int ended = 0, strokes = 0, drawn = 0;
    uint64_t hash;
    for (int k = 0; k < games; k++) {
      const uint64_t seed = test_seed() + (uint64_t)k;
      const int played = strokes_of_game((carom_rules_kind)kind, seed, equal, &hash);
      ended += played > 0;
      strokes += played;
      drawn += match.winner == CAROM_DRAWN;
    }
    printf("%s: %d of %d games ended, %d drawn, %d strokes\n", name, ended, games, drawn, strokes);
    ck_assert_int_eq(ended, games);
  }
}

/* Where a change of the method or of the physics is meant to change them, the new hash is the one
 * that this test prints. */
TEST(golden_games) {
  static const struct {
    carom_rules_kind kind;
    uint64_t hash;
  } cases[] = {{CAROM_RULES_SNOOKER, UINT64_C(0x0edc4c35b7c28287)},
               {CAROM_RULES_ONEPOCKET, UINT64_C(0xfbc49eb6216c8eef)},
               {CAROM_RULES_COWBOY, UINT64_C(0x76ca18af27086cb5)}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    uint64_t hash;
    const int strokes = strokes_of_game(cases[k].kind, 5, false, &hash);
    printf("%s: 0x%016llx; %d strokes\n", carom_rules_about_of(cases[k].kind)->name,
           (unsigned long long)hash, strokes);
    ck_assert(strokes >= 6);
    ck_assert_uint_eq(hash, cases[k].hash);
  }
}
