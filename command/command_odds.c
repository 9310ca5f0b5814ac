/* `carom odds`: the chances of a match of two rated players, and its fair handicap. */
#include "game/ratings.h"
#include "program/program.h"
#include "subcommands.h"

#include "carom_coach.h"
#include "carom_match.h"

typedef struct odds_job {
  shared_options shared; /* --output */
  double rating[CAROM_SEATS_MOST];
  double games[2], sets[2];
  double break_points;
  int breaks; /* 0: by lot */
  bool csv, winner_breaks;
} odds_job;

OPTION(odds_job, option_players, "players", rating, "A,B", set_ratings, 0,
       "the Fargo ratings of both, 200 to 850");
OPTION(odds_job, option_race, "race", games, "N[,M]", set_lengths, 0,
       "how many games a player needs to win a set; N,M with a handicap", .usual = "1");
OPTION(odds_job, option_sets, "sets", sets, "N[,M]", set_lengths, 0,
       "how many sets a player needs to win the match", .usual = "1");
FLAG(odds_job, option_winner_breaks, "winner-breaks", winner_breaks,
     "the winner of a game breaks the next one; otherwise the players break alternately");
OPTION(odds_job, option_breaks, "breaks", breaks, "lot|1|2", set_choice, 0,
       "the player who breaks first", .usual = "lot");
OPTION(odds_job, option_break_points, "break-points", break_points, "X", set_number, 0,
       "the value of the break in a game, in points of rating; below 0 it is a disadvantage",
       .usual = "0");
FLAG(odds_job, option_csv, "csv", csv, "write each final score and its chance as CSV");

static const command_form form = {
    .name = "odds",
    .usage = "[OPTIONS] --players A,B",
    .about = "Reports how likely each of two rated players wins a game, a set and a match, the "
             "final scores, and the handicap that makes it fair. A player rated 100 points higher "
             "wins two games for each one of the opponent.\n",
    .options = (const option_row *const[]){&option_players, &option_race, &option_sets,
                                           &option_winner_breaks, &option_breaks,
                                           &option_break_points, &option_csv, &option_output, NULL},
    .details = "columns of --csv: player1,player2,chance\n"
               "  player1 player2      sets won by each player, or games if one set decides\n"
               "\n"
               "exit code: 0; 2 for bad usage\n",
    .example = "carom odds --players 600,500 --race 9,7",
    .files = NO_FILES,
};

static void tell_chance(FILE *out, const char *name, double chance) {
  fprintf(out, "%-12s player 1 wins %.1f %%, player 2 %.1f %%\n", name, 100.0 * chance,
          100.0 * (1.0 - chance));
}

/* The scores that end a match, those of player 1 first, each with its chance. */
static void tell_scores(FILE *out, const int32_t needed[2], const carom_odds *odds, bool csv) {
  for (int side = 0; side < 2; side++)
    for (int k = 0; k < needed[1 - side]; k++) {
      /* the best scores of player 1 stand first, and the best ones of player 2 last */
      const int other = side == 0 ? k : needed[0] - 1 - k;
      int won[2];
      won[side] = needed[side];
      won[1 - side] = other;
      const double chance = odds->score[side][other];
      if (csv)
        fprintf(out, "%d,%d,%.9f\n", won[0], won[1], chance);
      else
        fprintf(out, "  %3d : %-3d %6.1f %%\n", won[0], won[1], 100.0 * chance);
    }
}

static void tell(FILE *out, const odds_job *job, const carom_series *match,
                 const carom_odds *odds) {
  const bool has_sets = match->sets[0] + match->sets[1] > 2;
  const int32_t *needed = has_sets ? match->sets : match->games;
  if (job->csv) {
    fputs("player1,player2,chance\n", out);
    tell_scores(out, needed, odds, true);
    return;
  }
  tell_chance(out, "a game", odds->game);
  if (match->games[0] + match->games[1] > 2) {
    char name[40];
    snprintf(name, sizeof name, "to %d : %d", match->games[0], match->games[1]);
    tell_chance(out, name, odds->set);
  }
  if (has_sets)
    tell_chance(out, "the match", odds->match);
  fprintf(out, "games        %.1f in the mean\n", odds->games);

  carom_series fair;
  carom_odds of_fair;
  carom_fair_series(match, &fair);
  carom_odds_of(&fair, &of_fair);
  fprintf(out, "fair         to %d : %d games, by which player 1 wins %.1f %%\n", fair.games[0],
          fair.games[1], 100.0 * of_fair.match);
  fprintf(out, "final scores in %s\n", has_sets ? "sets" : "games");
  tell_scores(out, needed, odds, false);
}

int command_odds(int argc, char **argv) {
  static odds_job job;
  static carom_odds odds;
  job = (odds_job){0};
  const int parsed = parse_arguments(&form, argc, argv, &job, NULL);
  if (parsed >= 0)
    return parsed;
  if (job.rating[1] == 0.0 || job.rating[2] > 0.0) {
    complain("--players: two ratings are needed; give 600,500");
    return usage_hint(&form);
  }
  carom_series match = {
      .break_points = job.break_points, .order = job.winner_breaks, .side = job.breaks - 1};
  for (int k = 0; k < 2; k++) {
    match.rating[k] = job.rating[k];
    match.games[k] = (int32_t)job.games[k];
    match.sets[k] = (int32_t)job.sets[k];
  }
  if (carom_odds_of(&match, &odds) != CAROM_OK) {
    complain("--break-points '%g': out of range; give -1000 to 1000", job.break_points);
    return EXIT_USAGE;
  }
  FILE *out = output_open(job.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  tell(out, &job, &match, &odds);
  return output_commit() ? EXIT_GOOD : EXIT_USAGE;
}
