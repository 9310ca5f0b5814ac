/* The table as a player sees it, the chances of pots, and the values of layouts. */
#ifndef CAROM_PLAN_VIEW_H
#define CAROM_PLAN_VIEW_H

#include "carom_plan.h"
#include "small_math.h"

#include <stdbool.h>

/* s: contacts with one rail that follow so soon are one, as a hop along it. */
static const double carom_same_contact = 0.1;

/* The pockets in which balls count for the player at the table, as a set. */
static inline uint32_t carom_pockets_of(const carom_plan_rules *rules,
                                        const carom_rules_state *game) {
  if (rules->pockets == NULL)
    return ~UINT32_C(0);
  return rules->pockets(game);
}

/* Whether a cue ball in hand is always in the D. */
static inline bool carom_has_d(const carom_plan_rules *rules) {
  return rules->rack == CAROM_RACK_SNOOKER || rules->rack == CAROM_RACK_BILLIARDS;
}

/* Whether a cue ball that meets two balls scores on a table with pockets. */
static inline bool carom_has_cannons(const carom_plan_rules *rules) {
  return rules->rack == CAROM_RACK_BILLIARDS || rules->rack == CAROM_RACK_COWBOY;
}

/* The points of a ball if it falls in the next stroke, or with ball -1 the mean of a later pot; 1
 * in games without points. */
static inline double carom_points_of(const carom_plan_rules *rules, const carom_rules_state *game,
                                     uint32_t in_play, int ball) {
  if (rules->points == NULL)
    return 1.0;
  return rules->points(game, in_play, ball);
}

enum { MOST_LEFT = 15 }; /* balls of a player that a chain counts */

/* Two jaws, between which the way into a pocket is. */
typedef struct carom_mouth {
  double centre[2], jaw[2][3]; /* of the pocket; of each jaw, with its radius */
  bool jaws;                   /* whether there are such jaws; else jaw[0][2] is the pocket's
                                  radius */
  bool rails;                  /* whether rails lead into it, */
  double rail[2][2];           /* in these directions, to each jaw */
  double axis;                 /* the direction of the middle of the mouth, rad */
  int left;                    /* the jaw on the left of it */
} carom_mouth;

/* The directions in which a ball gets into a pocket: their middle psi, with its sine and cosine,
 * and half their range, rad, which is below 0 where there is none. */
typedef struct carom_window {
  double psi, half, sine, cosine;
} carom_window;

/* A layout's surroundings, made once for a plan. */
typedef struct carom_view {
  const carom_plan_rules *rules;
  carom_mouth mouth[CAROM_POCKETS_MOST];
  int pockets, count, cue_ball;
  double width, length;
  double radius[CAROM_BALLS_MOST];
  /* of the player and of his opponent: error of the direction, rad; the logarithm of that in 0.1
   * degrees, at least 0.01 degrees; the caller's chance of a pot, or 0 */
  double sigma[2], log_error[2], set_chance[2];
  double
      log_miss[2]; /* log_error, larger on a table whose ways are longer than where racks taught */
  /* chance to win at one's turn, by the balls left to oneself and to the other: of the player,
   * of his opponent */
  double win[2][MOST_LEFT + 1][MOST_LEFT + 1];
  /* how much better the player is than the opponent, by the balls that each has left: half the
   * difference of their log-odds to win at their turns */
  double edge[MOST_LEFT + 1];
  /* of the balls where they are before the shot; most of them stay there */
  double place[CAROM_BALLS_MOST][2];
  carom_window window[CAROM_BALLS_MOST][CAROM_POCKETS_MOST];
} carom_view;

/* A direct pot. */
typedef struct carom_way {
  double chance;
  double psi, half; /* the middle of the directions in which the ball gets in, and half their
                       range, rad */
} carom_way;

/* Of a shot in error, and of none: no ball was met. */
extern const carom_facts carom_no_facts;

/* pots.c */
carom_mouth carom_mouth_of(const carom_table *table, int pocket);
/* Of a ball of radius R at o. */
carom_window carom_window_of(const carom_mouth *mouth, const double o[2], double R);
/* The pot of ball k into a pocket by the player `seat`, 0 or 1; in_hand: the cue ball may be put
 * anywhere. A chance of at most `least` is returned as 0. */
carom_way carom_way_of(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       int k, int pocket, int seat, bool in_hand, double least);
/* The cue ball's contact with a ball that goes through a window: its position, half the range of
 * its directions there, rad, and the chance. */
typedef struct carom_hit {
  double ghost[2], half, chance;
} carom_hit;
/* The contact with a ball at o that goes through a window, from c, or an easy one if c is NULL, by
 * the player `seat`. False where there is none. */
bool carom_way_into(const carom_view *view, const double o[2], double radius, const double c[2],
                    const carom_window *window, int seat, carom_hit *hit);
/* Whether no ball but i and j is nearer to the segment from p to q than its radius and R
 * together. */
bool carom_is_free_way(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       const double p[2], const double q[2], int i, int j, double R);
/* chances.c */
/* What a chance to pot is made of, the numbers of learned.h: 1; view->log_error; the mean of the
 * best pots of the balls of `targets`; the best pot; the pot of the next best ball; whether one
 * ball is left; whether the cue ball is in hand. For later pots of a visit they are 1,
 * view->log_miss, 1 / the balls that are left then, and the mean; for the first after a turn of the
 * other those but the mean. each[k] becomes the best pot of ball k, where it is not NULL. */
enum { NEXT_NUMBERS = 7, LATER_NUMBERS = 4, FIRST_NUMBERS = 3 };
void carom_plan_features(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                         uint32_t targets, uint32_t pockets, int seat, bool in_hand,
                         double each[CAROM_BALLS_MOST], double x[NEXT_NUMBERS]);
/* Chances of the next pot, by carom_plan_features(); of a later one with n balls left, in a layout
 * with this mean; of the first of a visit. */
double carom_chance_next(const carom_view *view, const double x[NEXT_NUMBERS]);
double carom_chance_later(const carom_view *view, int seat, double mean, int n);
double carom_chance_first(const carom_view *view, int seat, int n);
/* Whether the chances were learned from games with these rules, not from others. */
bool carom_is_learned(const carom_view *view);
/* The logarithm of the table's width relative to the table of the racks from which the chances were
 * learned. */
double carom_log_size(const carom_view *view);
/* The mean over the balls of a usual layout. */
double carom_chance_usual(const carom_view *view);
void carom_find_edges(carom_view *view);
/* A value to `seat`, who has n balls left, with its log-odds stretched about the edge of that
 * player. */
double carom_stretched(const carom_view *view, double value, int seat, int n);
/* The value to `seat` of a layout that both would as soon play as leave, as after a push-out. */
double carom_even(const carom_view *view, int seat, int n);

/* The opponent of a job. */
static inline const carom_player *carom_opponent_of(const carom_plan_job *job,
                                                    const carom_plan_options *options) {
  if (job->opponent != NULL)
    return job->opponent;
  if (options != NULL && options->opponent != NULL)
    return options->opponent;
  return job->player;
}

/* value.c */
void carom_view_make(carom_view *view, const carom_plan_job *job,
                     const carom_plan_options *options);
/* The chance that player `seat`, who is at the table, wins; alone: the expected number of balls
 * that the player still pots. In games where each seat plays for itself, seat 0 is the seat of the
 * view's rules, and seat 1 all others. */
double carom_value_of(const carom_view *view, const carom_rules_state *game,
                      const carom_ball_state *balls, int seat, bool in_hand);
uint32_t carom_in_play(const carom_ball_state *balls, int count);
/* points.c: the chance that player `seat` wins a race for points. */
double carom_points_value(const carom_view *view, const carom_rules_state *game,
                          const carom_ball_state *balls, uint32_t in_play, int seat, bool in_hand);

#endif
