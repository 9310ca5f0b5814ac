/* What a stroke of a match meant, and what its errors cost. The meant stroke is the aim at the ball
 * and the pocket that were called; without a call, at the ball that was met first and the pocket
 * whose aim is nearest. It is played often with the errors of the player. Let it keep the turn with
 * the chance p, be worth V, and U or L where it keeps the turn or does not. The stroke that was
 * played kept the turn (k = 1) or did not (k = 0), and was worth W. Then V = p U + (1 - p) L, and
 *
 *     V - W = (p - k) (U - L) + (k U + (1 - k) L - W),
 *
 * the first of which is the cost of the miss, and the second the cost of the position of the balls.
 * Both have the mean 0 for a player with these errors. */
#include "carom_coach.h"
#include "coach.h"
#include "player.h"
#include "rules.h"

#include <math.h>
#include <string.h>

/* The strokes with errors; farther off an aim, degrees, another ball or pocket was meant. */
enum { STROKES = 100 };
static const double FARTHEST = 10.0, THIN = 45.0, STRAIGHT = 15.0, LONG = 1.2;

/* Plays a stroke and rules it: what it is worth, and whether the player plays on. */
static double play(const carom_plan_job *job, const carom_cue *cue, carom_call call,
                   carom_ruling *ruling, bool *keeps) {
  carom_stroke_room room;
  carom_play_stroke(job, cue, call, &room, &(carom_shot){.events = NULL}, ruling);
  *keeps = ruling->turn.outcome == CAROM_TURN_KEEP || ruling->turn.outcome == CAROM_TURN_WIN;
  return carom_worth_left(job, ruling);
}

/* Aims at a ball and a pocket as the stroke was played, and keeps the aim that is nearest to it. */
static void try_aim(const carom_plan_job *job, const carom_cue *played, carom_call call,
                    carom_review *review) {
  carom_pot pot = {.ball = call.ball, .pocket = call.pocket};
  carom_cue aim = *played;
  const carom_status status =
      carom_aim(job->table, job->balls, (int)job->count, job->shot, &pot, &aim);
  if (status != CAROM_OK || pot.outcome != CAROM_POT_FALLS)
    return;
  const double off = carom_turned(played->phi - aim.phi + 180.0) - 180.0;
  if (fabs(off) > FARTHEST || (review->ball >= 0 && fabs(off) > fabs(review->off)))
    return;
  const double *place = job->balls[call.ball].state.r;
  review->aim = aim;
  review->ball = call.ball;
  review->pocket = call.pocket;
  review->off = off;
  review->cut = pot.cut;
  review->distance = sqrt(carom_square(job->balls[played->ball].state.r, place)) +
                     sqrt(carom_square(place, job->table->pocket[call.pocket].centre));
}

/* The group of a stroke that was meant to pot a ball. */
static int32_t group_of(const carom_review *review) {
  const bool is_long = review->distance > LONG;
  if (fabs(review->cut) > THIN)
    return is_long ? CAROM_PRACTICE_LONG_THIN : CAROM_PRACTICE_THIN;
  if (fabs(review->cut) < STRAIGHT)
    return is_long ? CAROM_PRACTICE_LONG_STRAIGHT : CAROM_PRACTICE_STRAIGHT;
  return is_long ? CAROM_PRACTICE_LONG_CUT : CAROM_PRACTICE_CUT;
}

/* The costs of a stroke, compared with the intended one with the player's errors. */
static void find_costs(const carom_plan_job *job, carom_call call, carom_ruling *ruling,
                       carom_review *review) {
  const uint64_t seed = job->options != NULL ? job->options->seed : 0;
  double sum[2] = {0.0};
  int count[2] = {0};
  for (uint64_t n = 0; n < STROKES; n++) {
    bool keeps;
    carom_cue stroke = review->aim;
    carom_player_strike(job->player, seed, n, &stroke);
    const double worth = play(job, &stroke, call, ruling, &keeps);
    sum[keeps] += worth;
    count[keeps]++;
  }
  review->told = (double)count[1] / (double)STROKES;
  review->value = (sum[0] + sum[1]) / (double)STROKES;
  const double total = review->value - review->came;

  /* without strokes of both kinds all of the cost is of the one that was played */
  review->miss_cost = review->told == review->kept ? 0.0 : total;
  if (count[0] > 0 && count[1] > 0)
    review->miss_cost = (review->told - review->kept) * (sum[1] / count[1] - sum[0] / count[0]);
  review->place_cost = total - review->miss_cost;
}

/* Finds the aim that was meant; whether the ball and the pocket were called. */
static bool find_aim(const carom_plan_job *job, const carom_cue *played, carom_call call, int first,
                     carom_review *review) {
  const bool is_called = job->rules->calls != 0 && call.ball >= 0 && call.pocket >= 0;
  if (is_called)
    try_aim(job, played, call, review);
  for (int pocket = 0; !is_called && first >= 0 && pocket < job->table->pockets; pocket++)
    try_aim(job, played, (carom_call){first, pocket}, review);
  return is_called;
}

/* Whether a stroke of the job, with a player and rules that can be reviewed, can be played. */
static carom_status check(const carom_plan_job *job, const carom_cue *stroke) {
  if (job == NULL || stroke == NULL || job->table == NULL || job->balls == NULL ||
      job->player == NULL || job->rules == NULL)
    return CAROM_ERROR_NULL;
  const int32_t race = job->rules->race;
  if (!carom_player_is_good(job->player) || race == CAROM_RACE_SEATS || race == CAROM_RACE_ALONE ||
      job->table->pockets == 0)
    return CAROM_ERROR_OPTIONS;
  return carom_shot_check(job->table, job->balls, (int)job->count, stroke, job->shot, NULL);
}

carom_status carom_review_of(const carom_plan_job *job, const carom_cue *played, carom_call call,
                             carom_review *review) {
  const carom_status status = check(job, played);
  if (status < 0 || review == NULL)
    return review == NULL ? CAROM_ERROR_NULL : status;
  *review = (carom_review){.aim = *played,
                           .off = NAN,
                           .cut = NAN,
                           .distance = NAN,
                           .told = NAN,
                           .ball = -1,
                           .pocket = -1};
  carom_ruling ruling;
  bool keeps;
  review->came = play(job, played, call, &ruling, &keeps);
  review->kept = keeps;
  const bool is_called = find_aim(job, played, call, ruling.facts.first[0], review);
  if (review->ball < 0) {
    review->group = is_called || keeps ? CAROM_PRACTICE_INDIRECT : CAROM_PRACTICE_OTHER;
    return CAROM_OK;
  }
  review->group = group_of(review);
  find_costs(job, is_called ? call : (carom_call){review->ball, review->pocket}, &ruling, review);
  return CAROM_OK;
}

/* Whether the stroke of a drill by a player, or without errors, pots its ball; end[] becomes the
 * position of the cue ball. */
static bool makes_pot(const carom_plan_job *job, const carom_drill *drill,
                      const carom_player *player, uint64_t n, double end[2]) {
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_facts facts;
  carom_shot shot = {.final = final, .facts = &facts};
  carom_cue stroke = drill->aim;
  carom_player_strike(player, 1, n, &stroke);
  if (carom_shoot(job->table, job->balls, (int)job->count, &stroke, job->shot, &shot) < 0)
    return false;
  memcpy(end, final[stroke.ball].r, 2 * sizeof *end);
  return facts.pocket[drill->ball] == drill->pocket && facts.off == 0 &&
         (facts.down & carom_only((int)stroke.ball)) == 0;
}

/* The fraction of strokes of a player that make a drill. */
static double share_made(const carom_plan_job *job, const carom_drill *drill,
                         const carom_player *player) {
  int made = 0;
  double end[2];
  for (uint64_t n = 0; n < STROKES; n++)
    if (makes_pot(job, drill, player, n, end))
      made +=
          drill->radius == 0.0 || carom_square(end, drill->place) <= drill->radius * drill->radius;
  return (double)made / (double)STROKES;
}

/* The radius around the position of a drill within which half of the player's pots leave the cue
 * ball. */
static double median_radius(const carom_plan_job *job, const carom_drill *drill) {
  double far[STROKES], end[2];
  int pots = 0;
  for (uint64_t n = 0; n < STROKES; n++)
    if (makes_pot(job, drill, job->player, n, end)) {
      const double distance = sqrt(carom_square(end, drill->place));
      int k = pots++;
      for (; k > 0 && far[k - 1] > distance; k--)
        far[k] = far[k - 1];
      far[k] = distance;
    }
  return pots > 0 ? far[pots / 2] : 0.0;
}

carom_status carom_drill_of(const carom_plan_job *job, const carom_review *review,
                            carom_drill *drill) {
  if (review == NULL || drill == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status = check(job, &review->aim);
  if (status < 0)
    return status;
  if (review->ball < 0 || review->ball >= job->count || review->pocket < 0 ||
      review->pocket >= job->table->pockets)
    return CAROM_ERROR_OPTIONS;
  *drill = (carom_drill){.aim = review->aim, .ball = review->ball, .pocket = review->pocket};
  makes_pot(job, drill, NULL, 0, drill->place);
  if (review->place_cost > review->miss_cost)
    drill->radius = median_radius(job, drill);

  /* the rating whose errors make it in half of the tries */
  double low = 200.0, high = 850.0;
  while (high - low > 5.0) {
    const double rating = 0.5 * (low + high);
    const carom_player player = carom_player_fargo(rating);
    if (share_made(job, drill, &player) < 0.5)
      low = rating;
    else
      high = rating;
  }
  drill->rating = 0.5 * (low + high);
  return CAROM_OK;
}
