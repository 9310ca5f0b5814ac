/* The direction of a shot from words that aims at a ball or at a pocket, and what is told of it. */
#ifndef CAROM_CLI_SHOOT_AIM_H
#define CAROM_CLI_SHOOT_AIM_H

#include "shots/shot_table.h"

#include "carom_shot.h"

#include <stdbool.h>

enum { PLACE_NAME = 16, AIMED_TEXT = 400 };
enum { NAMES_TEXT = CAROM_BALLS_MOST * (PLACE_NAME + 1) + 128 };

/* The balls on the table, the cue ball first. */
typedef struct layout {
  carom_game game;
  const named_table *named; /* with the slope of a fit; and the same without the names */
  carom_table table;
  carom_shot_ball ball[CAROM_BALLS_MOST];
  char name[CAROM_BALLS_MOST][PLACE_NAME];
  int count;
  uint64_t own_numbers; /* as in a shot_line */
  bool *missed;         /* becomes true where there is no aim, */
  bool *fell_short;     /* and this where the ball comes to rest on its way; */
  bool quiet;           /* nothing is told of it */
} layout;

/* The ball other than that of the cue with this name, or -1; their names, with bars between. */
int ball_named(const layout *l, const char *name, size_t size, char names[NAMES_TEXT]);

/* The same names as a message has them, "1, 2, black"; changes the text. */
const char *names_there(char names[NAMES_TEXT]);

/* Ball 3, the black, red11; and "the cue ball" or one of these. */
enum { BALL_TEXT = PLACE_NAME + 8 };
const char *named_ball(const char *name, char text[BALL_TEXT]);
const char *ball_words(const layout *l, int ball, char text[BALL_TEXT]);

/* What stands in the way of a ball that met ball `index` or a part of the table. */
const char *obstacle(const layout *l, int type, int index, char text[BALL_TEXT]);

/* The ball nearest to ball 0: that in front of a rack. */
int ball_in_front(const carom_shot_ball *ball, int count);

/* Aims a cue at a ball, that of --at-ball, at a cut; false after a complaint. */
bool aim_at_ball(const char *name, const layout *l, const carom_shot_options *options, double cut,
                 carom_cue *cue);

/* Aims a cue at a pocket, as --pocket and --via say, and tells of it; via may be NULL. False after
 * a complaint. */
bool aim_at_pocket(const char *pocket, const char *via, const layout *l,
                   const carom_shot_options *options, carom_cue *cue, char report[AIMED_TEXT]);

/* The pocket of a name or an id, or -1; adds the names to a text, with bars between. */
int pocket_named(const carom_table *t, char *const id[], const char *name, char names[NAMES_TEXT]);

#endif
