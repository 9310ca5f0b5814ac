/* Shots in JSON Lines: tables and shots read, tables and results written. docs/reference/files.md
 * has the format. */
#ifndef CAROM_CLI_SHOT_FILE_H
#define CAROM_CLI_SHOT_FILE_H

#include "shots/shot_table.h"

#include "carom_shot.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Whether a ball is down or has left the table. */
static inline bool is_out_of_play(const carom_ball_state *state) {
  return state->label == CAROM_BALL_POCKETED || state->label == CAROM_BALL_OFF;
}

/* Which numbers the options of a shot gave, which its line of JSON has to say: bit k is number k.
 * */
typedef struct given_keys {
  bool by_options; /* false: of a file, all else is 0 */
  carom_game game;
  uint64_t of_balls, of_cue_ball, of_cue;
} given_keys;

/* A shot, of a line of a file or by options. */
typedef struct shot_line {
  size_t number;            /* of the line, or of the shot by options, from 1 */
  char *id;                 /* as JSON text, or NULL where there is none */
  char *title;              /* the id where it is a text; else NULL */
  const named_table *table; /* NULL where the line is in error */
  int count;
  carom_shot_ball ball[CAROM_BALLS_MOST];
  char *name[CAROM_BALLS_MOST]; /* the balls' ids */
  carom_cue cue;
  uint64_t own_numbers; /* numbers of balls that are not those of the game: bit k is number k */
  char *error;          /* what is wrong with the line, or NULL */
  json_t *json;         /* the line; NULL where it is no JSON, and of a shot by options */
  given_keys given;     /* of a shot by options */
} shot_line;

typedef struct shot_file shot_file;

/* Which balls a line of a shot lays out: those before it, or those of its `final` states. By
 * default a line with `final` states is in error, so that no layout before a break is planned for
 * the one after it. */
typedef enum layout_moment { LAYOUT_DEFAULT, LAYOUT_START, LAYOUT_FINAL } layout_moment;

/* Opens a file, "-" for stdin, of which games have their constants for the model of the cushion.
 * Complains and returns NULL if that fails. */
shot_file *shot_file_open(const char *path, carom_shot_cushion cushion, layout_moment moment);

/* Shots by options, none yet, that are read as those of a file; `name` is for messages. */
shot_file *shot_file_given(const char *name);
/* Adds a shot, which the file takes over; drops all; and tells how many there are. */
void shot_file_add(shot_file *file, const shot_line *shot);
void shot_file_clear(shot_file *file);
size_t shot_file_count(const shot_file *file);
/* Writes those that have not been read, as the lines that a file would have, with the shortest
 * numbers. */
void shot_file_print(FILE *out, const shot_file *file);

/* The table of this name: one of the lines so far, or one that is built in, which the file keeps.
 * NULL where there is none, with the reason in *f, or "" if none of that name is built in. */
const named_table *shot_file_table(shot_file *file, const char *name, json_fault *f);

/* The balls of a game for a model of the cushion; tells once where the game has none for it. */
void kind_of_game(carom_game game, carom_shot_cushion cushion, carom_ball_kind *kind);

/* The numbers in which two kinds of balls differ: bit k is number k. */
uint64_t numbers_that_differ(const carom_ball_kind *a, const carom_ball_kind *b);

/* The name of the file for messages. */
const char *shot_file_name(const shot_file *file);

typedef enum shot_read { SHOT_END, SHOT_SHOT, SHOT_TABLE, SHOT_FAILED } shot_read;

/* Reads on to the next shot or table; other kinds of lines are passed over. SHOT_SHOT: *line is
 * to be freed by shot_line_free(). SHOT_TABLE: *text is the line, until the next call. A table
 * that is wrong is a shot in error. SHOT_FAILED: after a complaint. */
shot_read shot_file_next(shot_file *file, shot_line *line, const char **text);

/* Reads on to the next shot, over tables. */
shot_read shot_file_next_shot(shot_file *file, shot_line *line);

/* Gives all balls their number `k`, besides those that were read; the line says so where it is
 * written. */
void shot_line_give(shot_line *line, int k, double x);

/* Keeps what the line of a shot has where it is written, before a subcommand adds balls or changes
 * their order. */
void shot_line_keep(shot_line *line);

/* Plays a shot that was read without error; shot->events, all of them, are to be freed. */
carom_status shot_line_play(const shot_line *line, const carom_shot_options *options,
                            carom_shot *shot);

void shot_line_free(shot_line *line);
void shot_file_close(shot_file *file);

/* The name of an event's type as it stands in the files ("ball_ball"), or NULL. */
const char *shot_event_name(int type);
/* How many events a shot had room for. */
int64_t shot_events_kept(const carom_shot *shot);
/* On which side of an event, 0 or 1, the states of a ball are; -1 where the ball is not in it. */
int shot_event_side(const carom_event *event, int ball);
/* The id of the rail, jaw or pocket that ball a met, or NULL where the event is of no such
 * thing. */
const char *shot_part_name(const named_table *table, const carom_event *event);

enum { EVENTS_NONE, EVENTS_BRIEF, EVENTS_FULL };

/* What the line of a shot has under a key: as it was read, or as options gave it; NULL where it has
 * no such key. */
json_t *shot_line_value(const shot_line *line, const char *key);

/* The line that a file would have of a shot by options. */
json_t *shot_line_of_options(const shot_line *line);

/* A line of a shot: its head, to which results may be added. Takes over the parts, and leaves out
 * those that are NULL. */
json_t *shot_json(json_t *id, json_t *family, const char *table, json_t *cue, json_t *balls);

/* The line with its balls as they lie, and with a cue: for shot_json_write(). */
json_t *shot_line_json(const shot_line *line, json_t *id, const carom_cue *cue);

/* Writes a line of JSON, and frees it. */
void shot_json_write(FILE *out, json_t *line);

/* Writes a shot with its result as one line; `spread` may be NULL, else it is taken over. */
void shot_write(FILE *out, const shot_line *line, const carom_shot *shot, carom_status status,
                int events, json_t *spread);
/* Writes a line in error. */
void shot_write_error(FILE *out, const shot_line *line, const char *status, const char *error);

#endif
