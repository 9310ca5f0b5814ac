/* Players: how their strokes differ from those that they mean. */
#include "player.h"
#include "platform/elementary.h"
#include "random_draws.h"
#include "schema/rows.h"
#include "shot/shot.h"
#include "small_math.h"

#include <float.h>
#include <math.h>

/* The errors of a stroke of 2 m/s: of its direction, degrees, of its tip, radii, and of its speed,
 * a share. They grow with the speed. */
static carom_player player_with(double aim, double tip, double share) {
  static const double growth = 0.25, speed = 2.0; /* s/m; m/s */
  const double grown = sqrt(1.0 + growth * speed * growth * speed);
  return (carom_player){.speed_share = share,
                        .phi = aim / grown,
                        .theta = aim,
                        .a = tip / grown,
                        .b = tip / grown,
                        .growth = growth};
}

carom_player carom_player_of(double scale) {
  carom_player player = player_with(0.1 * scale, 0.003 * scale, 0.05 * scale);
  if (scale == 0.0)
    player.eye = -1.0;
  return player;
}

/* The numbers of players by rating, in steps of 100 from 200. Between them shots and the fraction
 * are linear, and the error of aim is exponential, which also continues beyond the ends where a
 * game has greater steps: a difference of 100 points in the game is one of steps[0] points of
 * carom_player_fargo() below a rating of 500, and of steps[1] above it. docs/understanding/plan.md
 * has the games from which they were measured. */
static carom_player player_stepped(double rating, const double steps[2]) {
  /* the error of aim of a stroke of 2 m/s, degrees; shots; the fraction of strokes that only pot */
  static const double at_rating[][3] = {
      {0.978, 146.0, 1.0},  {0.621, 163.0, 0.97}, {0.394, 183.0, 0.92}, {0.25, 205.0, 0.79},
      {0.159, 230.0, 0.57}, {0.101, 257.0, 0.31}, {0.05, 500.0, 0.0},   {0.012, 500.0, 0.0}};
  enum { STEPS = sizeof at_rating / sizeof at_rating[0] - 1 };
  static const double least = 200.0, even = 500.0, most = 850.0, step = 100.0;
  const double given = fmin(fmax(rating, least), most); /* the least of NaN too */
  const double r = even + 0.01 * steps[given > even] * (given - even);
  const int k = (int)carom_max(0, carom_min((int64_t)((r - least) / step), STEPS - 1));
  const double part = (r - least) / step - k, *low = at_rating[k], *high = at_rating[k + 1];

  /* the other errors of a stroke of this speed, as a power of the error of aim */
  const double aim = low[0] * carom_exp(part * carom_log(high[0] / low[0]));
  const double power = carom_exp(0.7 * carom_log(aim / 0.1));
  carom_player player = player_with(aim, 0.02 * power, carom_within(0.035 * power, 0.0, 0.25));
  player.speed = 0.02;
  player.only_pots = carom_within(low[2] + part * (high[2] - low[2]), 0.0, 1.0);
  player.shots = carom_within(round(low[1] + part * (high[1] - low[1])), PLAYER_SHOTS_LEAST,
                              PLAYER_SHOTS_MOST);
  return player;
}

carom_player carom_player_fargo(double rating) {
  static const double steps[2] = {100.0, 100.0};
  return player_stepped(rating, steps);
}

/* By how many points of carom_player_fargo() players differ who differ by 100 points in a game:
 * below a rating of 500, and above it. With these, 100 points are odds of 2 to 1 in the unit of the
 * comment, as `carom-lab plan --rules GAME --players A,B` shows; with twice as many points they
 * would be odds of about 4 to 1. Games without a row use the steps of eight-ball. */
static const double rating_steps[][2] = {
    [CAROM_RULES_EIGHTBALL] = {70.0, 95.0},    /* a rack */
    [CAROM_RULES_NINEBALL] = {118.0, 110.0},   /* a rack */
    [CAROM_RULES_TENBALL] = {108.0, 88.0},     /* a rack */
    [CAROM_RULES_ROTATION] = {68.0, 78.0},     /* a rack */
    [CAROM_RULES_ONEPOCKET] = {60.0, 53.0},    /* a rack */
    [CAROM_RULES_BANK] = {48.0, 34.0},         /* a rack */
    [CAROM_RULES_STRAIGHT] = {52.0, 52.0},     /* 15 points, about a rack */
    [CAROM_RULES_SNOOKER] = {47.0, 47.0},      /* a frame */
    [CAROM_RULES_THREECUSHION] = {36.0, 36.0}, /* 15 points */
};

carom_player carom_player_rated(double rating, carom_rules_kind kind) {
  const size_t rows = sizeof rating_steps / sizeof *rating_steps;
  const double *steps = rating_steps[CAROM_RULES_EIGHTBALL];
  if ((size_t)kind < rows && rating_steps[kind][0] > 0.0)
    steps = rating_steps[kind];
  return player_stepped(rating, steps);
}

double carom_player_growth(const carom_player *player, double speed) {
  const double grows = player->growth * speed;
  return sqrt(1.0 + grows * grows);
}

/* m: twice the gap that an eye of normal acuity sees at 0.3 m, CAROM_RULES_TOUCH. A convention. */
static const double usual_eye = 2.0 * CAROM_RULES_TOUCH;

carom_player carom_player_bounded(const carom_player *player, const carom_cue *cue) {
  carom_player bounded = *player;
  const double gain = carom_tip_gain(cue), usual_least = 0.5 * gain, usual_most = 8.0 * gain;
  bounded.speed = gain * player->speed;
  bounded.growth = player->growth / gain;
  const double least = player->speed_least, most = player->speed_most;
  if (!(least > 0.0))
    bounded.speed_least = usual_least;
  if (!(least > 0.0) && most > 0.0)
    bounded.speed_least = fmin(most, usual_least);
  if (!(most > 0.0))
    bounded.speed_most = fmax(least, usual_most);
  bounded.tip_most = carom_or_usual(player->tip_most, 0.5);
  bounded.eye = fmax(player->eye, 0.0);
  if (player->eye == 0.0)
    bounded.eye = usual_eye;
  return bounded;
}

void carom_player_errs(const carom_player *player, const double z[6], carom_cue *cue) {
  const double share = player->speed_share * cue->speed;
  const double speed = sqrt(player->speed * player->speed + share * share);
  double grown = 1.0, turned = 1.0;
  if (player->growth > 0.0) {
    /* the error of the tip is across the stick, so a steep stick turns farther; 80 degrees are the
     * most */
    double sine, cosine;
    carom_sincos(cue->theta * degree, &sine, &cosine);
    grown = carom_player_growth(player, cue->speed);
    turned = grown / carom_within(cosine, 0.17, 1.0);
  }
  cue->speed = carom_within(cue->speed + z[0] * speed, player->speed_least, player->speed_most);
  cue->phi += z[1] * player->phi * turned;
  cue->theta = carom_within(cue->theta + z[2] * player->theta, 0.0, 90.0);
  cue->a = carom_within(cue->a + z[3] * player->a * grown, -player->tip_most, player->tip_most);
  cue->b = carom_within(cue->b + z[4] * player->b * grown, -player->tip_most, player->tip_most);
}

void carom_player_strike(const carom_player *player, uint64_t seed, uint64_t number,
                         carom_cue *cue) {
  if (player == NULL || cue == NULL)
    return;
  const carom_player bounded = carom_player_bounded(player, cue);
  double z[6];
  carom_normals(seed, DRAW_PLAYED, number, z);
  carom_player_errs(&bounded, z, cue);
}

/* The members of a player, with their units and ranges. The bound of errors is a convention. */
#define MEMBER(member, measure, low, high, extra)                                     \
  CAROM_ROW(carom_player, member, "", low, high, extra, OPTIONS, "", .unit = measure, \
            .cushion_offset = -1, .words = -1)
static const carom_number player_members[] = {
    MEMBER(speed, "m/s", 0, 1000, NAN) MEMBER(speed_share, "", 0, 1000, NAN)
        MEMBER(phi, "degrees", 0, 1000, NAN) MEMBER(theta, "degrees", 0, 1000, NAN)
            MEMBER(a, "radii", 0, 1000, NAN) MEMBER(b, "radii", 0, 1000, NAN)
                MEMBER(speed_least, "m/s", 0, 1000, NAN) MEMBER(speed_most, "m/s", 0, 1000, NAN)
                    MEMBER(tip_most, "radii", 0, 1, NAN) MEMBER(growth, "s/m", 0, 1000, NAN)
                        MEMBER(only_pots, "", 0, 1, NAN)
                            MEMBER(shots, "", PLAYER_SHOTS_LEAST, PLAYER_SHOTS_MOST, 0)
                                MEMBER(eye, "m", -DBL_MAX, 0.01, NAN)};
#undef MEMBER

const carom_number *carom_player_wrong_number(const carom_player *player) {
  for (size_t k = 0; k < sizeof player_members / sizeof player_members[0]; k++) {
    const double value =
        *(const double *)(const void *)((const char *)player + player_members[k].offset);
    const bool is_within = value >= player_members[k].low && value <= player_members[k].high;
    if (!is_within && value != player_members[k].other)
      return &player_members[k];
  }
  return NULL;
}

bool carom_player_is_good(const carom_player *player) {
  const bool has_range = player->speed_most == 0.0 || player->speed_most >= player->speed_least;
  return has_range && carom_player_wrong_number(player) == NULL;
}
