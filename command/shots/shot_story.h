/* What a ball does in a shot, moment by moment: contacts, the start of a roll, balls that it just
 * passes, and its end; in words and as rows. */
#ifndef CAROM_CLI_SHOT_STORY_H
#define CAROM_CLI_SHOT_STORY_H

#include "shots/spread.h"

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

enum { WHERE_TEXT = 64 };

/* "the left rail", by carom_rail_name(); by its id where it has no name. */
const char *rail_words(const named_table *t, int rail, char text[WHERE_TEXT]);

/* "the foot-left pocket" */
const char *pocket_words(const named_table *t, int pocket, char text[WHERE_TEXT]);

/* Writes the rows of all moments of the balls that moved; `number` is that of the shot. */
#define STORY_COLUMNS                                                                             \
  "shot,id,ball,what,with,time_s,x_m,y_m,speed_m_s,direction_deg,cut_deg,diamonds,gap_mm,height_" \
  "mm,flight_m"
void story_rows(FILE *out, int number, const shot_line *line, const carom_shot *shot);

/* Tells what each ball does that moved: its moments, or in a line where `shortly` is set; with the
 * spread of a player where `s` is not NULL. */
void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s,
               bool shortly);

#endif
