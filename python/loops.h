/* Loops over single calls, for the Python package: one crossing of the language for many. */
#ifndef CAROM_PYTHON_LOOPS_H
#define CAROM_PYTHON_LOOPS_H

#include <carom_plan.h>
#include <stdbool.h>

/* mu[k] = carom_mu_ball(&in[k], law), k = 0 ... n - 1. */
void carom_python_mu_ball(const carom_impact *in, size_t n, carom_speed_law law, double *mu);

/* How all balls have turned at n times: carom_shot_frames() without the states, those of time k to
 * turned[4 k count ...]. Returns what it does; stops at the first error. */
carom_status carom_python_orientations(const carom_shot_ball *balls, int count,
                                       const carom_shot *shot, const double *times, size_t n,
                                       double *turned);

/* Judges n shots by the facts of each: turns[k] becomes what shot k amounts to for a player with
 * states[k], which is changed; NULL: that of the rules. calls may be NULL: none.
 * in_play[k] are the balls before it; the cue ball is ball 0. A status below 0 stands for facts in
 * which no ball was met. */
void carom_python_judge(const carom_plan_rules *rules, size_t n, const int8_t *status,
                        const carom_facts *facts, const uint32_t *in_play, const carom_call *calls,
                        carom_rules_state *states, carom_turn *turns);

/* How the strokes of carom.potting are played, and by which rules of the library. */
typedef struct carom_python_game {
  const carom_table *table;
  const carom_shot_options *options;
  const carom_plan_rules *rules;
  carom_cue cue;       /* of all strokes, but for direction, speed and tip */
  carom_player player; /* the errors; and the bounds, which actions of -1 and 1 are */
  int32_t balls;       /* of a layout, the cue ball among them */
} carom_python_game;

/* What a stroke was: `potted` and `scratch` are the balls and the cue ball that fell in it. */
typedef struct carom_python_stroke {
  double reward; /* `potted`, less 1 for a foul; without pockets the points */
  double time;   /* how long the balls moved, s */
  int64_t potted;
  int32_t foul;  /* a carom_foul */
  int8_t status; /* a carom_status */
  bool scratch;
  bool cleared; /* whether all balls but the cue ball are down after it */
} carom_python_stroke;

/* The strokes of n actions of `acts` numbers each, at least 4, of which what is beyond -1 to 1
 * counts as the bound; with seeds each errs as the player does. Returns whether all numbers are
 * finite. */
bool carom_python_cues(const carom_python_game *game, size_t n, const double *actions, size_t acts,
                       const uint64_t *seeds, carom_cue *cues);

/* Plays the strokes `begin` up to, without it, begin + n, and judges them. Stroke k is of
 * balls[k * ball_stride ...] and cues[k * cue_stride]. next[k * balls ...] becomes the layout
 * after it: that before it, where it ended in an error or a ball left the table. Returns what
 * carom_shoot_batch() does, or CAROM_ERROR_NULL without memory. */
carom_status carom_python_strokes(const carom_python_game *game, size_t begin, size_t n,
                                  const carom_shot_ball *balls, size_t ball_stride,
                                  const carom_cue *cues, size_t cue_stride, carom_shot_ball *next,
                                  carom_python_stroke *strokes);

/* Whether the first `many` balls of a layout are clear of each other and of the others in play, by
 * 1 mm, and of pockets and the rounded ends of cushions. */
bool carom_python_free(const carom_python_game *game, const carom_shot_ball *balls, int many);

/* Places the first `many` balls of n layouts at random, at rest, where they are free. draws[k] is
 * where the numbers of game k stand, which go on: those of SplitMix64. Returns false where 10,000
 * draws found no places. */
bool carom_python_place(const carom_python_game *game, size_t n, uint64_t *draws, int many,
                        carom_shot_ball *balls);

/* What agents see of n layouts of `count` balls: seen[(3 count + 1) k + 3 i ...] become x, y (m)
 * and 1 of ball i of layout k, or 0, 0, 0 of one that is down. The last number of a layout is not
 * written. */
void carom_python_seen(const carom_shot_ball *balls, size_t n, size_t count, double *seen);

/* Looks at the shots of a job, each of which has been played. A shot of which not all events
 * were kept in full is played again, which has the same bits. `states`, (n, times, count), and
 * `positions`, (n, times, count, 3), at `times`, ascending times, may each be NULL. What is not
 * known (all of a shot whose arguments are in error, and what comes after a shot was stopped
 * while balls moved) is NaN, its labels -1. status[k] becomes the error of shot k: CAROM_OK,
 * CAROM_ERROR_TIME where states are unknown, CAROM_ERROR_STATE where a shot played again is not
 * as it was, as its layout or cue has been changed meanwhile. Returns CAROM_OK, or
 * CAROM_ERROR_NULL without memory. */
carom_status carom_python_look(const carom_shot_job *job, const double *times, size_t m,
                               carom_ball_state *states, double *positions, int8_t *status);

/* Cuts a track of n samples t, x, y (s, m), weights 1/s^2, into pieces of at most `longest`
 * samples that are quadratic in time: the cuts minimise the sum over pieces of chi^2 of the
 * quadratic, of `penalty`, and of 4 for each sample less than 3. back[j], j = 1 ... n, becomes
 * the beginning of the last piece of the best cut of the first j samples. `best` has room for n
 * + 1. */
void carom_python_cuts(const double *samples, const double *weight, int n, int longest,
                       double penalty, double *best, int32_t *back);

/* Recorded shots, and how they are played: for carom_python_misfit(). Shot s has counts[s] balls at
 * rest, balls[s * count ...], of which struck[s] is struck; the samples of its ball i are
 * samples[first[s * count + i]] up to, without it, samples[first[s * count + i + 1]], each t, x, y
 * (s, m), in the order of time. Constants are numbers of the balls or of the table: `balls` has the
 * `shots` layouts and `tables` the table, and after them, for each of `constants` constants, the
 * same with that constant changed by steps[]. */
typedef struct carom_python_tracks {
  const carom_table *tables;         /* 1 + constants */
  const carom_shot_options *options; /* time_most and events_most are not read */
  const carom_shot_ball *balls;
  const int32_t *struck, *counts;
  const double *samples;
  const double *evening; /* of each sample a matrix of two rows by which d is multiplied for the
                            cost, or NULL: unity */
  const int64_t *first;
  const double *steps; /* of the constants */
  int32_t count;       /* the most balls of a shot */
  int32_t shots, constants;
  int32_t kicks; /* contacts of a play, from its first on, that have kicks: at most 16 */
  double step;   /* of the differences by the strike, m/s and s */
  double huber;  /* c of the cost, the sum of 2 c^2 (sqrt(1 + d^2/c^2) - 1) over the distances
                     d, m; 0: the sum of d^2 */
} carom_python_tracks;

/* How far n plays are from what was recorded. Play k is of shot shots[k] by the strike strikes[(6 +
 * 5 kicks) k ...]: v_x, v_y, R w_x, R w_y, R w_z (m/s) of the struck ball just after the strike,
 * the strike's time (s), and five kicks of each of the first contacts; samples up to the time
 * ends[k] count.
 *
 * Kicks are changes of the motion just after a contact, over the speed V before it. Of a ball at a
 * cushion, with n into it and t = (n_y, -n_x): velocity along t and away from it, roll along t and
 * away from it, R w_z; V is the ball's speed. Of balls a and b, with n from a to b, V is the speed
 * of closing: velocity of b along n and of a against it; of a along t and of b against it; R w
 * along t of both; R w_z of a, and of b. Contacts are the CAROM_EVENT_BALL_BALL, CAROM_EVENT_RAIL
 * and CAROM_EVENT_JAW, a cushion too, in the order of the events; of a cluster the last has the
 * kicks.
 *
 * With m = 6 + 5 kicks + constants, sums[(4 + m + m (m + 1)/2) k ...] becomes: the cost; the sum
 * of d^2; the number of samples; the basin, an integer that is the same for plays with the same
 * contacts in the same order; and, where the cost is below most[k], J^T W d (m) and J^T W J
 * (the lower triangle by rows): W are the weights that make the cost a weighted sum of squares
 * nearby, J is by forward differences, of the strike, the kicks and then the constants. A play
 * that ends in an error has infinite cost. Returns CAROM_OK, or CAROM_ERROR_NULL without memory or
 * for too many numbers. */
carom_status carom_python_misfit(const carom_python_tracks *tracks, size_t n, const int32_t *shots,
                                 const double *strikes, const double *ends, const double *most,
                                 double *sums);

/* One such play: its events, 1000 of them at most, whose states `after` are those before kicks,
 * the number of them in *many, and the places places[(n ball + k) 2 ...] of the balls at the
 * times times[k], ascending, of the recording's clock. The status is that of the play;
 * CAROM_ERROR_ROOM: it has too many events. */
carom_status carom_python_kicked(const carom_python_tracks *tracks, int32_t shot,
                                 const double *strike, double end, size_t n, const double *times,
                                 carom_event *events, int32_t *many, double *places);

#endif
