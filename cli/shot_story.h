/* What a ball does in a shot, moment by moment: contacts, the start of a roll, balls that it just
 * passes, and its end; in words and as rows. */
#ifndef CAROM_CLI_SHOT_STORY_H
#define CAROM_CLI_SHOT_STORY_H

#include "spread.h"

/* Whether a rail is no cut of a pocket: those are short. */
bool is_cushion(const carom_table *t, int rail);

/* s: contacts of a ball with one cushion, or with one ball, that are nearer are one */
#define SAME_CONTACT 0.1

/* Whether event k is a contact of the ball with a cushion that a player would count: no jaw, no
 * cut of a pocket, and no further hop at the same cushion. */
bool counts_as_rail(const shot_line *line, const carom_shot *shot, int64_t k, int ball);

/* A place along a rail in diamonds: 8 on a long side, 4 on a short one, from the head or left. */
double diamonds_at(const carom_table *t, int rail, const double r[2]);

/* Whether the ball is in any event: the others lie where they lay. */
bool ball_moved(const carom_shot *shot, int ball);

typedef enum moment_kind {
  MOMENT_LEAVES, /* the ball of the cue, struck */
  MOMENT_MEETS,  /* another ball; value: the cut, degrees, NaN where that ball moves */
  MOMENT_RAIL,   /* a cushion; value: where, in diamonds */
  MOMENT_JAW,    /* the cut of a pocket, or its jaw */
  MOMENT_ROLLS,  /* it rolls from here on */
  MOMENT_PASSES, /* another ball, without contact; value: the gap, m */
  MOMENT_FALLS,  /* into a pocket */
  MOMENT_OFF,    /* it leaves the table */
  MOMENT_RESTS,
  MOMENT_MOVES /* still, at the end */
} moment_kind;

typedef struct moment {
  moment_kind kind;
  int with; /* a ball, a rail or a pocket; -1 */
  double time, x, y, value;
  double speed, direction; /* just after, m/s and degrees counterclockwise from +x; NaN at rest */
} moment;

enum { MOST_MOMENTS = 512, WHERE_TEXT = 64 };

/* The moments of a ball in their order, at most MOST_MOMENTS; how many. */
int story_of(const shot_line *line, const carom_shot *shot, int ball, moment to[MOST_MOMENTS]);

/* "the left rail", by carom_rail_name(); by its id where it has no name. */
const char *rail_words(const named_table *t, int rail, char text[WHERE_TEXT]);

/* "the foot-left pocket" */
const char *pocket_words(const named_table *t, int pocket, char text[WHERE_TEXT]);

/* "the left rail": the rail beyond which a place lies. */
const char *side_words(const named_table *t, double x, double y);

/* Writes the rows of all moments of the balls that moved; `number` is that of the shot. */
#define STORY_COLUMNS \
  "shot,id,ball,what,with,time_s,x_m,y_m,speed_m_s,direction_deg,cut_deg,diamonds,gap_mm"
void story_rows(FILE *out, int number, const shot_line *line, const carom_shot *shot);

/* Tells what each ball does that moved: its moments, or in a line where `shortly` is set; with the
 * spread of a player where `s` is not NULL. */
void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s,
               bool shortly);

#endif
