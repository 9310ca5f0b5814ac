/* The opponent of a match: by rating, or by Bayes' rule from the strokes of the match so far.
 *
 * By chances.c a player whose error of aim is e keeps the turn from a layout with the chance p(e).
 * Strokes that kept it or not make an error as likely as the product of p(e) and 1 - p(e) over
 * them. Before the first stroke, ln e is normal about the value of the player who asks for advice,
 * with a standard deviation of ln 2: a convention, the same as for ratings, in which 150 points
 * double the error. The opponent has the mean of ln e behind the strokes. It is a sum over errors
 * in steps of sqrt(2). */
#include "match.h"
#include "platform/elementary.h"
#include "player.h"
#include "rules.h"
#include "seats.h"
#include "view.h"

#include <math.h>

static const double ln2 = 0x1.62e42fefa39efp-1, usual_speed = 2.0; /* m/s */

/* The logarithm of error k of the sum, degrees, at the usual speed. */
static double log_error_of(int k) {
  const double least = 0.0125;
  return carom_log(least) + 0.5 * ln2 * k;
}

/* Whether chances of pots give information about the players of a game. */
static bool tells_skill(const carom_match *match) {
  const carom_plan_rules *rules = &match->rules;
  return match->record.table.pockets > 0 && rules->value == NULL && rules->left != NULL &&
         rules->race != CAROM_RACE_ALONE && rules->race != CAROM_RACE_SEATS;
}

void carom_match_weigh(carom_match *match) {
  const carom_turn_outcome outcome = match->ruling.turn.outcome;
  if (!tells_skill(match) || match->rules.state.opening == 1 ||
      match->call.ball == CAROM_CALL_PUSH || outcome == CAROM_TURN_DRAW)
    return;

  /* the layout before the stroke, whose rules still apply */
  const carom_record *record = &match->record;
  const int count = (int)record->count;
  carom_cue cue = match->stroke;
  const carom_player player = carom_player_of(1.0);
  const carom_plan_options options = {0};
  const carom_plan_job job = {.table = &record->table,
                              .balls = match->before,
                              .count = count,
                              .cue = &cue,
                              .player = &player,
                              .rules = &match->rules};
  carom_ball_state state[CAROM_BALLS_MOST];
  for (int k = 0; k < count; k++)
    state[k] = match->before[k].state;
  const uint32_t balls = carom_in_play(state, count);
  carom_view view;
  carom_view_make(&view, &job, &options);

  /* the likelihood of the result for each error; the chances allow for what they do not know */
  const bool keeps = outcome == CAROM_TURN_KEEP || outcome == CAROM_TURN_WIN;
  double *likely = match->log_likelihood[match->seat];
  for (int k = 0; k < CAROM_MATCH_ERRORS; k++) {
    double x[NEXT_NUMBERS];
    const double error = carom_exp(log_error_of(k));
    view.sigma[0] = error * degree;
    view.log_error[0] = carom_log(error / 0.1);
    carom_plan_features(&view, state, balls, match->rules.on(&match->rules.state, balls),
                        carom_pockets_of(&match->rules, &match->rules.state), 0, false, NULL, x);
    const double p = carom_within(carom_chance_next(&view, x), 0.02, 0.98);
    likely[k] += carom_log(keeps ? p : 1.0 - p);
  }
  match->weighed[match->seat]++;
}

carom_status carom_match_opponent(const carom_match *match, const carom_player *player,
                                  carom_player *opponent) {
  if (match == NULL || player == NULL || opponent == NULL)
    return CAROM_ERROR_NULL;
  *opponent = *player;
  if (match->phase == CAROM_MATCH_NONE || match->rules.race == CAROM_RACE_SEATS)
    return CAROM_OK;
  const int32_t next = carom_seat_of_side(match, 1 - match->record.side);
  const double rating = match->seating.seat[next].rating;
  if (rating != 0.0) {
    *opponent = carom_player_rated(rating, (carom_rules_kind)match->record.rules);
    return CAROM_OK;
  }

  /* all strokes of the other side */
  double likely[CAROM_MATCH_ERRORS] = {0.0}, most = -INFINITY, sum = 0.0, first = 0.0;
  int64_t strokes = 0;
  const double grown = carom_player_growth(player, usual_speed);
  const double own = fmax(player->phi * grown, carom_exp(log_error_of(0)));
  for (int64_t seat = 0; seat < match->seating.count; seat++) {
    if (match->seating.seat[seat].side == match->record.side)
      continue;
    strokes += match->weighed[seat];
    for (int k = 0; k < CAROM_MATCH_ERRORS; k++)
      likely[k] += match->log_likelihood[seat][k];
  }
  if (strokes == 0)
    return CAROM_OK;

  /* the mean behind them */
  for (int k = 0; k < CAROM_MATCH_ERRORS; k++) {
    const double off = (log_error_of(k) - carom_log(own)) / ln2;
    likely[k] -= 0.5 * off * off;
    most = fmax(most, likely[k]);
  }
  for (int k = 0; k < CAROM_MATCH_ERRORS; k++) {
    const double weight = carom_exp(likely[k] - most);
    sum += weight;
    first += weight * log_error_of(k);
  }
  const double scale = carom_exp(first / sum) / own;
  opponent->phi = scale * own / grown;
  opponent->theta *= scale;
  opponent->speed *= scale;
  opponent->speed_share *= scale;
  opponent->a *= scale;
  opponent->b *= scale;
  return CAROM_OK;
}
