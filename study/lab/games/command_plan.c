/* `carom-lab plan`: how strong the planner is. Racks after a break that pots nothing, run out from
 * ball in hand by a player with errors, or played to the end by two; and how often shots succeed
 * and games are won compared with the predicted chances. Of games of points also how many a visit
 * makes. */
#include "comparison.h"
#include "game/ratings.h"
#include "pot_kind.h"
#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/monotonic.h"
#include "program/options.h"
#include "rack_play.h"
#include "rated_match.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 10, STROKES_MOST = 2000 };

typedef struct strength_job {
  shared_options shared;
  int rules, racks, shots, seed, left, target;
  bool games, run_out, told;
  double errors, against, unsure, rating[CAROM_SEATS_MOST];
} strength_job;

OPTION(strength_job, option_rules, "rules", rules, NULL, set_named, CAROM_WORDS_RULES,
       "the game (default eightball). If the break of a game is a stroke like others, two players "
       "play it from its rack");
FLAG(strength_job, option_games, "games", games,
     "two players play each rack to the end; report the chances to win");

OPTION(strength_job, option_players, "players", rating, "A,B", set_ratings, 0,
       "play matches of two players of these ratings, who break alternately; report how many the "
       "first one wins");
FLAG(strength_job, option_told, "told", told,
     "with --players: they plan with --shots, see positions of balls with errors and never "
     "consider only pots; report by kind of stroke the predicted chances to play on, to foul, to "
     "lose at once and to win, next to the results; without --rules, for every game");
FLAG(strength_job, option_run_out, "run-out", run_out, "plan to run out");
OPTION(strength_job, option_racks, "racks", racks, "N", set_count, 1,
       "number of racks to play (default 100)");
OPTION(strength_job, option_shots, "shots", shots, "N", set_count, 100,
       "shots of a plan (default 2000)");
OPTION(strength_job, option_errors, "errors", errors, "SCALE", set_amount, 0,
       "scale of the player's errors (default 1)");
OPTION(strength_job, option_against, "against", against, "SCALE", set_amount, 0,
       "with --games: scale of the errors of the second player (default: as --errors)");
OPTION(strength_job, option_unsure, "unsure", unsure, "SHARE", set_amount, 0,
       "how little the player knows about the table, 0 to 1 (default 0)");
OPTION(strength_job, option_seed, "seed", seed, "N", set_count, 0,
       "seed of racks, plans and strokes (default 0)");

OPTION(strength_job, option_left, "left", left, "N", set_count, 1,
       "end games: N balls of the player, one more of the opponent, and the eight; in nine-ball N "
       "balls");

OPTION(strength_job, option_target, "target", target, "N", set_count, 1,
       "points that win: in straight pool (default 100), and in the matches of --players (default: "
       "the usual target of the game)");

typedef struct tally {
  long racks, wins, strokes, pots, plans, fouls, visits;
  double points, best; /* of all visits, of one */
  double seconds;
  lab_comparison bins[BINS], games[BINS], kinds[CAROM_PLAN_KINDS];
  double *odds; /* of the values of all strokes, logarithms, */
  bool *won;    /* and whether that player won */
  size_t values, odds_room, won_room;
} tally;

static int bin_of(double chance) {
  return chance < 1.0 ? (int)(BINS * chance) : BINS - 1;
}

/* The players of a stroke: the one at the table, and the opponent. */
static void seat(const strength_job *job, int striker, lab_rack *rack) {
  static carom_player opponent;
  const double errors[2] = {job->errors, job->against > 0.0 ? job->against : job->errors};
  rack->player = carom_player_of(errors[striker]);
  opponent = carom_player_of(errors[1 - striker]);
  rack->options.opponent = &opponent;
}

/* One rack: strokes until the turn is not kept, or until the game is won. */
static void play(const strength_job *job, uint64_t number, lab_rack *rack, tally *sums) {
  const carom_rules_kind rules = (carom_rules_kind)job->rules;
  lab_rack_make(rack, rules, ((uint64_t)job->seed << 32) + 7919 * (number + 1));
  if (rules == CAROM_RULES_STRAIGHT && job->target > 0)
    rack->rules.state.target = job->target;
  if (job->left > 0)
    lab_rack_end(rack, job->left);
  carom_turn turn = {.outcome = CAROM_TURN_KEEP};
  int striker = 0, n = 0;
  static int player_of[STROKES_MOST];
  static double value[STROKES_MOST];
  double visit = 0.0;
  while (n < STROKES_MOST &&
         (turn.outcome == CAROM_TURN_KEEP || (job->games && turn.outcome == CAROM_TURN_PASS))) {
    carom_plan_stroke best;
    const double begin = processor_ns();
    striker = turn.outcome == CAROM_TURN_PASS ? 1 - striker : striker;
    seat(job, striker, rack);
    if (!lab_rack_stroke(rack, &best, &turn))
      return;
    sums->seconds += 1e-9 * (processor_ns() - begin);
    sums->plans++;

    /* predictions compared with results */
    visit += turn.points;
    if (turn.outcome != CAROM_TURN_KEEP) {
      sums->visits++;
      sums->points += visit;
      sums->best = fmax(sums->best, visit);
      visit = 0.0;
    }
    const bool keeps = turn.outcome == CAROM_TURN_KEEP || turn.outcome == CAROM_TURN_WIN;
    lab_compare(&sums->bins[bin_of(best.keep)], best.keep, keeps);
    lab_compare(&sums->kinds[best.kind], best.keep, keeps);
    player_of[n] = striker;
    value[n++] = best.value;
    sums->strokes++;
    sums->pots += keeps;
    sums->fouls += best.foul > 0.5;
  }
  int winner = -1;
  if (turn.outcome == CAROM_TURN_WIN)
    winner = striker;
  else if (turn.outcome == CAROM_TURN_LOSE)
    winner = 1 - striker;
  sums->wins += winner == 0;
  for (int k = 0; k < n && winner >= 0; k++) {
    const double v = fmin(fmax(value[k], 1e-6), 1.0 - 1e-6);
    lab_compare(&sums->games[bin_of(value[k])], value[k], player_of[k] == winner);
    sums->odds = grow(sums->odds, &sums->odds_room, sums->values + 1, sizeof *sums->odds);
    sums->won = grow(sums->won, &sums->won_room, sums->values + 1, sizeof *sums->won);
    sums->odds[sums->values] = log(v / (1.0 - v));
    sums->won[sums->values++] = player_of[k] == winner;
  }
  lab_compare_end(sums->bins, BINS);
  lab_compare_end(sums->games, BINS);
  lab_compare_end(sums->kinds, CAROM_PLAN_KINDS);
}

static void tell_bins(const lab_comparison *bins, int count, const char *const names[],
                      const char *came) {
  printf("%spredicted,strokes,%s,standard_error\n", names != NULL ? "kind," : "", came);
  for (int k = 0; k < count; k++) {
    const lab_comparison *b = &bins[k];
    const double n = (double)b->strokes;
    if (b->strokes == 0)
      continue;
    if (names != NULL)
      printf("%s,", names[k]);
    printf("%.3f,%ld,%.3f,%.3f\n", b->predicted / n, b->strokes, b->came / n, lab_compare_error(b));
  }
}

/* By what the log-odds of the values are to be stretched for the greatest likelihood. */
static double stretch_of(const tally *t) {
  enum { STEPS = 20 };
  double stretch = 1.0;
  for (int step = 0; step < STEPS; step++) {
    double slope = 0.0, bend = 1e-6;
    for (size_t k = 0; k < t->values; k++) {
      const double p = 1.0 / (1.0 + exp(-stretch * t->odds[k]));
      slope += ((double)t->won[k] - p) * t->odds[k];
      bend += p * (1.0 - p) * t->odds[k] * t->odds[k];
    }
    stretch += fmin(fmax(slope / bend, -0.5), 0.5);
  }
  return stretch;
}

static void report(const tally *t, const strength_job *job) {
  const double n = (double)t->racks, p = (double)t->wins / n;
  double bounds[2];
  lab_interval((double)t->wins, n, bounds);
  printf("%d shots a plan, errors %g: %s %ld of %ld, %.1f %% (95 %%: %.1f to %.1f), pots a "
         "stroke %.3f, %.1f ms a plan\n",
         job->shots, job->errors, job->games ? "won by the first" : "run out", t->wins, t->racks,
         100.0 * p, 100.0 * bounds[0], 100.0 * bounds[1], (double)t->pots / (double)t->strokes,
         1e3 * t->seconds / (double)t->plans);
  if (t->points > 0.0)
    printf("%g points in %ld visits: %.2f a visit, at most %g\n", t->points, t->visits,
           t->points / (double)t->visits, t->best);
  tell_bins(t->bins, BINS, NULL, "kept");
  const char *kinds[CAROM_PLAN_KINDS];
  for (int k = 0; k < CAROM_PLAN_KINDS; k++)
    kinds[k] = carom_word_text(CAROM_WORDS_PLAN_KIND, k);
  tell_bins(t->kinds, CAROM_PLAN_KINDS, kinds, "kept");
  if (job->games) {
    printf("planned to foul: %ld of %ld strokes\n", t->fouls, t->strokes);
    tell_bins(t->games, BINS, NULL, "won");
    printf("log-odds to be stretched by %.2f\n", stretch_of(t));
  }
}

static int play_ratings(const strength_job *job) {
  if (job->rating[2] > 0.0) {
    complain("--players: two ratings are needed");
    return EXIT_USAGE;
  }
  lab_ratings wanted = {.rules = (carom_rules_kind)job->rules,
                        .target = job->target,
                        .matches = job->racks,
                        .seed = job->seed,
                        .threads = job->shared.options.threads,
                        .rating = job->rating};
  if (!job->told)
    return lab_play_ratings(&wanted) ? EXIT_GOOD : EXIT_USAGE;
  wanted.shots = job->shots;
  puts("game,kind,chance,strokes,told,came,difference,standard_error");
  if (job->rules >= 0)
    return lab_play_told(&wanted) ? EXIT_GOOD : EXIT_USAGE;
  bool plays = true;
  for (int k = 0; plays && carom_rules_about_of((carom_rules_kind)k) != NULL; k++) {
    wanted.rules = (carom_rules_kind)k;
    plays = k == CAROM_RULES_POTTING || lab_play_told(&wanted); /* a single player pots */
  }
  return plays ? EXIT_GOOD : EXIT_USAGE;
}

static const command_form form = {
    .name = "plan",
    .usage = "[OPTIONS]",
    .about =
        "Plays racks with plans. A player who makes errors tries to run out each rack, from ball "
        "in hand after a break that potted nothing. Reports how many racks are run out, and how "
        "often shots keep the turn, next to the predicted chance. With --games each rack is played "
        "to the end, and the report compares the predicted chances to win with the fraction of "
        "games won.\n",
    .options =
        (const option_row *const[]){&option_rules, &option_games, &option_players, &option_told,
                                    &option_run_out, &option_left, &option_target, &option_racks,
                                    &option_shots, &option_errors, &option_against, &option_unsure,
                                    &option_seed, &option_threads, NULL},
    .details = "exit code: 0; 2 for bad usage\n",
    .example = "carom-lab plan --racks 100 --shots 1000",
    .files = NO_FILES,
};

int command_plan(int argc, char **argv) {
  static strength_job job;
  const char *path;
  job = (strength_job){.shared = {.options = {.threads = 0}},
                       .rules = -1,
                       .racks = 100,
                       .shots = 2000,
                       .errors = 1.0};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  if (job.told && !(job.rating[0] > 0.0)) {
    complain("--told: give two ratings, --players A,B");
    return EXIT_USAGE;
  }
  if (job.rules < 0 && !job.told)
    job.rules = CAROM_RULES_EIGHTBALL;
  if (job.rating[0] > 0.0)
    return play_ratings(&job);
  if (!lab_game_is_played(job.rules))
    return EXIT_USAGE;
  const bool racked = carom_plan_rules_of((carom_rules_kind)job.rules).breaks != 1;
  if (racked && job.left > 0) {
    complain("--left is for eight-ball and nine-ball");
    return EXIT_USAGE;
  }
  job.games |= racked;
  static lab_rack rack;
  rack.options = (carom_plan_options){.shots = job.shots,
                                      .threads = job.shared.options.threads,
                                      .chance_opponent = job.run_out,
                                      .unsure = job.unsure};
  if (carom_plan_memory(&rack.options) == 0) {
    complain("--shots: it must be 100 to 1000000; --unsure: 0 to 1");
    return EXIT_USAGE;
  }
  lab_rack_begin(&rack, (carom_rules_kind)job.rules, job.errors);
  static tally t;
  for (; t.racks < job.racks; t.racks++) {
    play(&job, (uint64_t)t.racks, &rack, &t);
    progress_show("racks", (double)t.racks, job.racks);
  }
  progress_clear();
  free(rack.plan.memory);
  report(&t, &job);
  return EXIT_GOOD;
}
