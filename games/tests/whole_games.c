/* What every game owes its players, in matches of two equal players with fixed seeds: the winner
 * has the most points; plans win as often as they report at the first stroke; and a stroke does
 * what it is called. CAROM_TEST_GAMES: how many matches of each game; CAROM_TEST_GAME: of which.
 * Before a release there are two of each. */
#include "carom_coach.h"
#include "carom_match.h"
#include "game_support.h"

enum { SHOTS = 100, STROKES_MOST = 2000 };

static carom_match match;

/* Chances that were told, and the results of them. Where they are true, the difference has the
 * variance of as many coins. */
typedef struct told_chances {
  double told, came, variance;
  int count;
} told_chances;

static void compare(told_chances *row, double told, bool came) {
  row->told += told;
  row->came += came;
  row->variance += told * (1.0 - told);
  row->count++;
}

static void check(const char *game, const char *what, const told_chances *row) {
  static const double deviations = 3.5, whole = 1.0; /* of one stroke */
  printf("%s: %s: told %.1f, came %g of %d\n", game, what, row->told, row->came, row->count);
  ck_assert_msg(fabs(row->told - row->came) < deviations * sqrt(row->variance) + whole,
                "%s: %s: told %g, came %g of %d", game, what, row->told, row->came, row->count);
}

/* The strokes of a game, by what they are called. */
typedef struct deeds {
  told_chances first, pots, others;
  int safeties, safe;
} deeds;

/* Whether a stroke did what one that names a ball means to: it kept the turn, or in games that each
 * plays for itself it potted. */
static bool has_scored(uint32_t on) {
  const carom_turn *turn = &match.ruling.turn;
  if (match.rules.race == CAROM_RACE_SEATS && turn->outcome == CAROM_TURN_PASS)
    return turn->foul == CAROM_FOUL_NONE && (match.ruling.facts.down & on) != 0;
  return turn->outcome == CAROM_TURN_KEEP || turn->outcome == CAROM_TURN_WIN;
}

/* A match; returns whether its winner has the most points. */
static bool play(carom_rules_kind kind, int number, carom_plan_job *job, deeds *of) {
  static const int targets[] = {[CAROM_RULES_STRAIGHT] = 15,
                                [CAROM_RULES_BILLIARDS] = 20,
                                [CAROM_RULES_THREECUSHION] = 2,
                                [CAROM_RULES_STRAIGHTRAIL] = 10,
                                [CAROM_RULES_FOURBALL] = 3};
  const carom_rules_kind targets_count = (carom_rules_kind)(sizeof targets / sizeof targets[0]);
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  const carom_match_setup setup = {.rules = kind,
                                   .table = &table,
                                   .target = kind < targets_count ? targets[kind] : 0,
                                   .side = number % 2,
                                   .seed = 100 + (uint64_t)number};
  carom_plan_options options = *job->options;
  job->options = &options;
  expect_ok(carom_match_begin_with(&match, &setup));
  double first = -1.0;
  int seat_of_first = 0;
  for (int stroke = 0; match.phase != CAROM_MATCH_OVER && stroke < STROKES_MOST; stroke++) {
    carom_plan_stroke best;
    int found;
    const int seat = (int)match.seat;
    options.seed = (uint64_t)(1000 * number + stroke);
    job->cue = NULL;
    expect_ok(carom_match_plan(&match, job, &best, 1, &found));
    if (first < 0.0) {
      first = best.value;
      seat_of_first = seat;
    }
    expect_ok(carom_match_prepare(&match, seat, &best));
    if (best.kind == CAROM_PLAN_PASS)
      continue;
    const uint32_t on = match.on;
    carom_player_strike(job->player, options.seed, 0, &best.cue);
    expect_ok(carom_match_stroke(&match, seat, &best.cue, NULL, NULL));
    const bool scored = has_scored(on);
    compare(carom_names_ball(&best) ? &of->pots : &of->others, best.keep, scored);
    of->safeties += best.kind == CAROM_PLAN_SAFETY;
    of->safe += best.kind == CAROM_PLAN_SAFETY && !scored;
  }
  ck_assert_int_eq(match.phase, CAROM_MATCH_OVER);

  carom_standing standing;
  expect_ok(carom_match_standing(&match, &standing));
  const int64_t winner = match.winner - 1;
  if (match.rules.race != CAROM_RACE_ALONE)
    compare(&of->first, first, standing.side_of[seat_of_first] == winner);
  bool leads = true;
  int64_t sum = 0;
  for (int64_t side = 0; side < standing.sides; side++) {
    sum += llabs(standing.points[side]);
    leads &= side == winner || standing.points[side] < standing.points[winner];
  }
  return leads || sum == 0;
}

TEST(games_keep_their_words) {
  const char *setting = getenv("CAROM_TEST_GAMES"), *only = getenv("CAROM_TEST_GAME");
  const int matches = setting != NULL ? atoi(setting) : draws_of_test(1, 2);
  const carom_plan_options options = {.shots = SHOTS};
  carom_plan_job job = {.memory_size = carom_plan_memory(&options)};
  job.memory = malloc(job.memory_size);
  told_chances all = {0};
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    const char *name = carom_rules_about_of((carom_rules_kind)kind)->name;
    if (kind == CAROM_RULES_POTTING || (only != NULL && strcmp(name, only) != 0))
      continue;
    carom_player player = carom_player_rated(600.0, (carom_rules_kind)kind);
    player.only_pots = 0.0;
    job.player = &player;
    deeds of = {0};
    int count = matches;
    if (kind == CAROM_RULES_SNOOKER) /* a frame has hundreds of strokes */
      count = (matches + 1) / 2;
    for (int number = 0; number < count; number++) {
      job.options = &options;
      ck_assert_msg(play((carom_rules_kind)kind, number, &job, &of),
                    "%s, match %d: the winner has not the most points", name, number);
    }
    check(name, "won", &of.first);
    check(name, "strokes that name a ball", &of.pots);
    check(name, "other strokes that keep the turn", &of.others);
    printf("%s: %d of %d safeties pass the turn\n", name, of.safe, of.safeties);
    ck_assert_msg(of.safe >= 0.85 * of.safeties - 1.0, "%s: %d of %d safeties pass the turn", name,
                  of.safe, of.safeties);
    all.told += of.first.told;
    all.came += of.first.came;
    all.variance += of.first.variance;
    all.count += of.first.count;
  }
  check("all games", "won", &all);
  free(job.memory);
}
