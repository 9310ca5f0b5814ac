/* What a player's error makes of a shot: covariances of the places of its balls, to first order,
 * by the library's tangents. */
#ifndef CAROM_CLI_SPREAD_H
#define CAROM_CLI_SPREAD_H

#include "rows/values.h"
#include "shots/shot_file.h"

/* Standard deviations of a player's errors, which are independent of each other. The speed's is
 * a share of the cue's, that of the aim is in degrees; those of the tip to the right and above
 * are in R, or in tips. */
enum { ERROR_SPEED, ERROR_AIM, ERROR_RIGHT, ERROR_ABOVE, ERRORS };
typedef struct player_error {
  bool is_set;
  value deviation[ERRORS];
} player_error;

/* For a player_error: SPEED,AIM,RIGHT,ABOVE such as 1%,0.05,0.01,0.01; without ABOVE it is that
 * of RIGHT. */
OPTION_SET(set_player_error);

/* Standard deviations beyond this, m, are not shown: tangents say nothing there. */
extern const double spread_most;

/* A point of a ball's path with its band. */
typedef struct band_point {
  double time, r[2], side[2]; /* the band goes from r - side to r + side, one standard deviation
                                 across the path, m */
  bool begins;                /* after a contact, where the band begins anew */
} band_point;

typedef struct spread {
  carom_status status;  /* an error where it is not known: then there is nothing else */
  double error[ERRORS]; /* standard deviations of the shot's cue: m/s, degrees, R, R */
  double reach[ERRORS]; /* the least change of each at which a ball meets something else, in
                           standard deviations, */
  double together;      /* and of all errors together, at least */
  double end;           /* s: when the first event is for which one standard deviation is beyond
                           reach; or infinite */
  int64_t flags;        /* of all events: carom_tangent_flag */
  /* Of each ball: covariance of its place at the end, m^2: xx, xy, yy, 0 in a pocket; and its
   * band, up to where its place has a standard deviation above spread_most, at which it is cut. */
  double final[CAROM_BALLS_MOST][3];
  band_point *band[CAROM_BALLS_MOST];
  int points[CAROM_BALLS_MOST];
  bool cut[CAROM_BALLS_MOST];
} spread;

/* Finds it for a shot with all of its events, with bands or without; to be freed. */
void spread_of(const player_error *error, const shot_line *line, const carom_shot *shot,
               const carom_shot_options *options, bool bands, spread *result);
void spread_free(spread *s);

/* The axes of a covariance: standard deviations along the longer one and across it, m, and its
 * direction, degrees from +x. */
typedef struct spread_axes {
  double along, across, degrees;
} spread_axes;
spread_axes axes_of(const double covariance[3]);

/* Tells where a ball ends, to stand behind its place. */
void spread_tell_ball(FILE *out, const spread *s, int ball);

/* Tells the errors and the reach, a line each. */
void spread_tell(FILE *out, const spread *s, const shot_line *line);

/* As JSON. */
json_t *spread_json(const spread *s, const shot_line *line);

#endif
