/* `carom rating`: a player's rating by games that were won and lost, of a table or of recorded
 * matches. */
#include "game/match_lines.h"
#include "program/program.h"
#include "subcommands.h"

typedef struct rating_job {
  shared_options shared; /* --output */
  int player;
} rating_job;

OPTION(rating_job, option_seat, "seat", player, "1|2", set_choice, 0,
       "the player to rate, in recorded matches", .usual = "1");

static const command_form form = {
    .name = "rating",
    .usage = "[OPTIONS] RESULTS",
    .about =
        "Estimates the Fargo rating of a player from games against players with known ratings, "
        "with its 95 % interval. RESULTS is a table with a row for each match or opponent, or "
        "concatenated recordings of `carom match` whose seats have ratings. RESULTS may be "
        "-.\n",
    .options = (const option_row *const[]){&option_seat, &option_output, NULL},
    .details =
        "columns of RESULTS: against,won,lost\n"
        "  against              the rating of the opponent, 0 to 1000\n"
        "  won lost             games that the player won and lost: 9,7 for a match that ended 9 : "
        "7\n"
        "Before the first game, ratings have a normal distribution: mean 400, deviation 150.\n"
        "\n"
        "exit code: 0; 2 for bad usage or unreadable input\n",
    .example = "carom rating results.csv",
    .files = ONE_FILE,
};

/* The results, and how far the file has been read. */
typedef struct results {
  carom_score *score;
  size_t room;
  int64_t count, line;
  const char *path;
  int seat;
} results;

static void add_score(results *r, double against, double won, double lost) {
  r->score = grow(r->score, &r->room, (size_t)r->count + 1, sizeof *r->score);
  r->score[r->count++] = (carom_score){against, won, lost};
}

/* Reads a row of the table; complains and returns false where it is none. */
static bool read_row(results *r, const char *line) {
  carom_score score;
  carom_rating checked;
  char rest;
  if (r->line == 1 && strncmp(line, "against,", 8) == 0)
    return true;
  if (sscanf(line, "%lf,%lf,%lf %c", &score.against, &score.won, &score.lost, &rest) != 3 ||
      carom_rating_of(&score, 1, &checked) != CAROM_OK) {
    complain("%s: line %lld: against,won,lost are needed, a rating of 0 to 1000 and numbers of "
             "games, such as 550,9,7",
             r->path, (long long)r->line);
    return false;
  }
  add_score(r, score.against, score.won, score.lost);
  return true;
}

/* Reads a line of a recording, and counts the match that it ends. */
static bool read_record(results *r, const char *line, size_t size) {
  static carom_match match;
  const int32_t winner = match.winner;
  if (!match_line_read(&match, r->path, line, size))
    return false;
  if (match.winner == 0 || match.winner == winner)
    return true;
  const carom_seating *seats = &match.seating;
  const double against = seats->seat[1 - r->seat].rating;
  if (seats->count != 2 || against == 0.0) {
    complain("%s: line %lld: a match of two seats is needed, of which seat %d has a rating",
             r->path, (long long)r->line, 2 - r->seat);
    return false;
  }
  const double won = match.winner == CAROM_DRAWN ? 0.5 : match.winner == 1 + r->seat;
  add_score(r, against, won, 1.0 - won);
  return true;
}

static bool read_line(void *context, const char *line, size_t size) {
  results *r = context;
  r->line++;
  if (line[0] == '{')
    return read_record(r, line, size);
  return read_row(r, line);
}

int command_rating(int argc, char **argv) {
  static rating_job job;
  results r = {0};
  job = (rating_job){0};
  const int parsed = parse_arguments(&form, argc, argv, &job, &r.path);
  if (parsed >= 0)
    return parsed;
  r.seat = job.player;
  bool good = input_lines(r.path, read_line, &r);
  if (good && r.count == 0) {
    complain("%s: it has no results: rows against,won,lost are needed, or a match that has ended",
             r.path);
    good = false;
  }
  FILE *out = good ? output_open(job.shared.output) : NULL;
  if (out != NULL) {
    carom_rating rating;
    double won = 0.0, lost = 0.0;
    for (int64_t k = 0; k < r.count; k++) {
      won += r.score[k].won;
      lost += r.score[k].lost;
    }
    carom_rating_of(r.score, r.count, &rating);
    fprintf(out, "rating %.0f (95 %%: %.0f to %.0f), by %g games won and %g lost\n", rating.mean,
            rating.low, rating.high, won, lost);
  }
  free(r.score);
  return out != NULL && output_commit() ? EXIT_GOOD : EXIT_USAGE;
}
