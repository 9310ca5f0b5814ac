/* Odds of a series of games, by ratings. Side 0 wins a game that side b breaks with the odds
 * 2^(x/100) : 1, where x is the lead of its rating, plus the points e that the break is worth if b
 * is 0, or minus e. Let q(i, j, b) be the chance that the score becomes i : j and side b breaks the
 * next game. Then, from q(0, 0, first) = 1, with p(b) the chance of side 0,
 *
 *     q(i, j, b) p(b)        flows to q(i + 1, j, the side that breaks next),
 *     q(i, j, b) (1 - p(b))  flows to q(i, j + 1, the side that breaks next),
 *
 * until a side has the games that it needs. A match of sets is the same chain: its p(b) is the
 * chance to win a set whose first game side b breaks. */
#include "carom_coach.h"
#include "carom_match.h"
#include "platform/elementary.h"
#include "small_math.h"

#include <math.h>
#include <string.h>

/* A chain of games, or of sets. */
typedef struct series {
  int32_t needed[2]; /* of each side, to win */
  int32_t order;     /* a carom_break_order */
  double wins[2];    /* the chance of side 0 where side b breaks */
  double games[2];   /* the mean number of games where side b breaks */
} series;

/* The results of a chain that begins with the break of one side. */
typedef struct series_end {
  double wins, games; /* the chance of side 0, and the mean number of games */
  double score[2][CAROM_SERIES_MOST];
} series_end;

static double chance_of_game(double lead) {
  static const double ln2 = 0x1.62e42fefa39efp-1;
  const double e = carom_exp(-0.01 * ln2 * fabs(lead));
  return lead > 0.0 ? 1.0 / (1.0 + e) : e / (1.0 + e);
}

static int side_that_breaks(int32_t order, int breaks, int winner) {
  if (order == CAROM_BREAKS_ALTERNATE)
    return 1 - breaks;
  return order == CAROM_BREAKS_WINNER ? winner : 1 - winner;
}

static void follow(const series *s, int first, series_end *end) {
  double row[CAROM_SERIES_MOST + 1][2] = {{0.0}}, next[CAROM_SERIES_MOST + 1][2];
  *end = (series_end){0};
  row[0][first] = 1.0;
  for (int i = 0; i < s->needed[0]; i++) {
    memset(next, 0, sizeof next);
    for (int j = 0; j < s->needed[1]; j++)
      for (int b = 0; b < 2; b++) {
        const double won = row[j][b] * s->wins[b], lost = row[j][b] - won;
        end->games += row[j][b] * s->games[b];
        next[j][side_that_breaks(s->order, b, 0)] += won;
        row[j + 1][side_that_breaks(s->order, b, 1)] += lost;
      }
    /* the games by which side 1 has won in this row */
    end->score[1][i] = row[s->needed[1]][0] + row[s->needed[1]][1];
    memcpy(row, next, sizeof row);
  }
  for (int j = 0; j < s->needed[1]; j++) {
    end->score[0][j] = row[j][0] + row[j][1];
    end->wins += end->score[0][j];
  }
}

/* The ends of a chain, for the first break of either side. */
static void follow_both(const series *s, series_end end[2]) {
  for (int b = 0; b < 2; b++)
    follow(s, b, &end[b]);
}

static bool is_good(const carom_series *s) {
  bool good = fabs(s->break_points) <= 1000.0 && (uint32_t)s->order <= CAROM_BREAKS_LOSER &&
              s->side >= -1 && s->side <= 1;
  for (int k = 0; k < 2; k++)
    good &= s->rating[k] >= 0.0 && s->rating[k] <= 1000.0 && s->games[k] >= 1 &&
            s->games[k] <= CAROM_SERIES_MOST && s->sets[k] >= 0 && s->sets[k] <= CAROM_SERIES_MOST;
  return good;
}

carom_status carom_odds_of(const carom_series *match, carom_odds *odds) {
  if (match == NULL || odds == NULL)
    return CAROM_ERROR_NULL;
  if (!is_good(match))
    return CAROM_ERROR_OPTIONS;

  /* a set of games, then the match of sets, in which the first breaks alternate */
  const double lead = match->rating[0] - match->rating[1], edge = match->break_points;
  const series games = {.needed = {match->games[0], match->games[1]},
                        .order = match->order,
                        .wins = {chance_of_game(lead + edge), chance_of_game(lead - edge)},
                        .games = {1.0, 1.0}};
  series_end set[2], end[2];
  follow_both(&games, set);
  const series sets = {
      .needed = {(int32_t)carom_max(match->sets[0], 1), (int32_t)carom_max(match->sets[1], 1)},
      .order = CAROM_BREAKS_ALTERNATE,
      .wins = {set[0].wins, set[1].wins},
      .games = {set[0].games, set[1].games}};
  follow_both(&sets, end);

  /* by lot each side breaks first in half of the matches */
  const bool has_sets = sets.needed[0] + sets.needed[1] > 2;
  *odds = (carom_odds){.game = chance_of_game(lead)};
  for (int b = 0; b < 2; b++) {
    const double share = match->side < 0 ? 0.5 : (double)(match->side == b);
    const series_end *scores = has_sets ? &end[b] : &set[b];
    odds->set += share * set[b].wins;
    odds->match += share * end[b].wins;
    odds->games += share * end[b].games;
    for (int k = 0; k < CAROM_SERIES_MOST; k++) {
      odds->score[0][k] += share * scores->score[0][k];
      odds->score[1][k] += share * scores->score[1][k];
    }
  }
  return CAROM_OK;
}

carom_status carom_fair_series(const carom_series *match, carom_series *fair) {
  carom_odds odds;
  if (fair == NULL)
    return CAROM_ERROR_NULL;
  carom_status status = carom_odds_of(match, &odds);
  if (status != CAROM_OK)
    return status;
  carom_series tried = *match;
  const int weaker = match->rating[0] < match->rating[1] ? 0 : 1;
  const int32_t most = (int32_t)carom_max(match->games[0], match->games[1]);
  tried.games[0] = tried.games[1] = most;
  double least = 1.0;
  for (int32_t games = most; games >= 1; games--) {
    tried.games[weaker] = games;
    carom_odds_of(&tried, &odds);
    const double off = fabs(odds.match - 0.5);
    if (off < least) {
      least = off;
      *fair = tried;
    }
  }
  return CAROM_OK;
}
