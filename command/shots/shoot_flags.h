/* The options of a shot: `carom shoot --cue 0.6,0.8 --at-ball 1 --cut 20 --balls 0.6,1.5`.
 * given_shots.h has the shots that they describe. */
#ifndef CAROM_CLI_SHOOT_FLAGS_H
#define CAROM_CLI_SHOOT_FLAGS_H

#include "rows/values.h"
#include "shots/places.h"
#include "shots/shoot_aim.h"

#include <stdio.h>

#define GAP_MOST 0.02 /* m: below the radius of every ball */

enum { MOST_SHOTS = 16, MOST_ROWS = 1001 };

/* The job of a subcommand that has these options begins with it. */
typedef struct shoot_flags {
  shared_options shared;
  struct chosen_table {
    int kind;         /* 1 + a carom_table_kind; 0: none was given */
    const char *text; /* its name and measures; NULL: only the kind */
  } table;
  const char *at_ball, *pocket, *via;
  values speed, ball_speed, aim, cut, elevation, gap, seed;
  given_numbers cue_numbers; /* numbers of the cue ball alone, and of the tip */
  place_list cue, balls, tip, target;
  bool json;
  bool tries;            /* shots that cannot be aimed are left out, without a complaint */
  int written, left_out; /* of the shots that were asked for */
  bool fell_short;       /* the last ball came to rest on its way to a pocket */
  char aimed[MOST_SHOTS][AIMED_TEXT]; /* what is told of the aim of each shot, or "" */
} shoot_flags;

extern const option_row option_table, option_cue, option_cue_ball, option_balls, option_aim,
    option_to, option_at_ball, option_pocket, option_via, option_shot_cut, option_shot_speed,
    option_ball_speed, option_tip, option_elevation, option_tip_time, option_tip_restitution,
    option_json, option_gap, option_seed, option_one_gap, option_one_seed;

/* Whether one of them is given. */
bool has_flags(const shoot_flags *f);

/* Fills in what is not given; false after a complaint where options exclude or need each other, or
 * where one is out of its range. */
bool flags_complete(shoot_flags *f);

#endif
