/* Shots from words: `carom shoot --cue 0.6,0.8 --at-ball 1 --cut 20 --balls 0.6,1.5`. They
 * become the lines that a file would have, as JSON in memory, so that everything behind is the
 * same. */
#ifndef CAROM_CLI_SHOOT_FLAGS_H
#define CAROM_CLI_SHOOT_FLAGS_H

#include "rows/values.h"
#include "shots/places.h"
#include "shots/shoot_aim.h"
#include "shots/shot_file.h"

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
    option_json, option_layout, option_gap, option_seed, option_one_gap, option_one_seed;

/* Whether one of them is given. */
bool has_flags(const shoot_flags *f);

/* The shots as an array of lines of JSON, one for each combination and at most `most`, aimed for a
 * play by these options; NULL after a complaint. */
json_t *flags_shots(shoot_flags *f, const carom_shot_options *options, int most);

/* Whether the numbers of --with are for the tables of a file; else a complaint. */
bool with_fits_file(const given_numbers *with);

/* The same lines as a file, of this name; NULL after a complaint. */
#define SHOTS_GIVEN "the shot given"
shot_file *flags_open(shoot_flags *f, const carom_shot_options *options, int most);

/* Opens the file of a subcommand, or the shots that its options describe; complains and returns
 * NULL where both or none are given, or it cannot. */
shot_file *layout_open(shoot_flags *f, const char *path, const carom_shot_options *options,
                       int most);

/* The balls that a subcommand takes which plays the shots of a file again: by default those before
 * each shot. */
layout_moment played_again(const shared_options *shared);

/* Reads all shots of the file with the numbers of --with, at most `most`, of which all must have
 * the layout of the first one; where `most` is 1, the first alone. *line is to be freed; how
 * many, with their strokes in cues[]. 0 after a complaint. */
int strokes_read(shot_file *file, const shared_options *shared, shot_line *line, carom_cue *cues,
                 int most);

#endif
