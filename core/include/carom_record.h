/* carom_record.h: recordings of games that verify themselves.
 *
 * A recording is text in lines of JSON: the table, the balls, the options, and each stroke of the
 * cue with a hash of all lines up to it and of the bits in which its shot ended.
 * docs/reference/files.md has the format. If you play a recording again with this library, you get
 * the same bits, or the library reports where they differ.
 *
 *     static carom_record game;                                         // all zero
 *     static char text[CAROM_RECORD_TEXT];
 *     carom_table_make(CAROM_TABLE_POOL_9FT, &game.table);
 *     game.count = carom_rack_size(CAROM_RACK_NINEBALL);
 *     carom_rack(CAROM_RACK_NINEBALL, &game.table, 1e-4, 1, game.balls, 10);
 *     fwrite(text, 1, carom_record_write(&game, CAROM_RECORD_HEAD, text, sizeof text), stdout);
 *     fwrite(text, 1, carom_record_write(&game, CAROM_RECORD_TABLE, text, sizeof text), stdout);
 *     fwrite(text, 1, carom_record_write(&game, CAROM_RECORD_BALLS, text, sizeof text), stdout);
 *     game.cue = carom_cue_of(CAROM_GAME_POOL);
 *     game.cue.speed = 8.0;
 *     carom_status status = carom_record_play(&game, CAROM_RECORD_SHOT, NULL);
 *     fwrite(text, 1, carom_record_write(&game, CAROM_RECORD_SHOT, text, sizeof text), stdout);
 *     fwrite(text, 1, carom_record_write(&game, CAROM_RECORD_END, text, sizeof text), stdout);
 *
 * Nothing here allocates, reads a file or writes one. */
#ifndef CAROM_RECORD_H
#define CAROM_RECORD_H

#include "carom_shot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The lines of a recording. */
typedef enum carom_record_kind {
  CAROM_RECORD_BLANK = 0,    /* no line yet, or an empty one */
  CAROM_RECORD_HEAD = 1,     /* "recording": the first line, with the revision of the physics */
  CAROM_RECORD_TABLE = 2,    /* "table" */
  CAROM_RECORD_OPTIONS = 3,  /* "options": the models; without this line, the defaults */
  CAROM_RECORD_BALLS = 4,    /* "balls": their constants, positions and motion */
  CAROM_RECORD_PLACE = 5,    /* "place": a ball is in hand, or is placed from the hand */
  CAROM_RECORD_SHOT = 6,     /* "shot": a stroke, when its shot is stopped, and how the shot
                                ended */
  CAROM_RECORD_CONTINUE = 7, /* "continue": a stopped shot is continued */
  CAROM_RECORD_EVENT = 8,    /* "event": an event of the shot before it; may be left out */
  CAROM_RECORD_END = 9,      /* "end": the last line; a recording without it was cut off */
  CAROM_RECORD_GAME = 10,    /* "game": the rules, the side at the table, and the state of the
                                game */
  CAROM_RECORD_WRONG = 11,   /* a line that was rejected; nothing is read after it */
  CAROM_RECORD_ACT = 12,     /* "act", of a match: a player's decision other than a stroke or a
                              placement */
  CAROM_RECORD_SEATS = 13,   /* "seats", of a match: the players, their cues, and the limits of
                              strokes */
  CAROM_RECORD_SET = 14,     /* "set", of a match: the set that it belongs to */
  CAROM_RECORD_NOTE = 15     /* "note": words about the game, anywhere between the head and the end
                              */
} carom_record_kind;

/* What the last shot of a recording waits for. */
typedef enum carom_record_pending {
  CAROM_PENDING_NONE = 0, /* no shot waits to be played or written */
  CAROM_PENDING_SHOT = 1, /* the last line is a shot, which carom_record_play() has to play */
  CAROM_PENDING_LINE = 2  /* the last shot was played; carom_record_write() may write its line */
} carom_record_pending;

/* Enough bytes for any line, even for 32 balls with different constants. */
enum { CAROM_RECORD_TEXT = 65536 };

/* How a shot ended, or the portion of it up to a stop. */
typedef struct carom_record_end {
  int64_t status; /* a carom_status. */
  int64_t events; /* number of events. */
  double time;    /* s: carom_shot.time. */
  uint64_t hash;  /* hash of the lines so far, the stroke, these three numbers and all final states.
                     It is equal if every bit is equal; otherwise it differs, except with a
                     probability of 1 in 2^64. It is not a signature. */
} carom_record_end;

/* The largest number of seats of a match, and the bytes of a name with its closing 0. */
enum { CAROM_SEATS_MOST = 8, CAROM_SEAT_NAME = 32 };

/* A seat of a match: the player and the cue. */
typedef struct carom_seat {
  char name[CAROM_SEAT_NAME]; /* UTF-8 without control characters, quotes and backslashes; "": no
                                 name. */
  int64_t side;               /* 0 to 7: the seats of one side play together, in their order. */
  int64_t handicap; /* of the first seat of a side, 0 to 1,000,000: in games of points the points
                       with which the side begins, so that a player who needs 25 of 40 points begins
                       with 15; in nine-ball, up to 8, how many balls below the nine win too; in
                       killer, up to 97, lives beyond the usual ones; in other games 0. */
  double rating;    /* a Fargo rating, 200 to 850; 0: unknown. */
  carom_cue cue;    /* the stick and the tip; the members of the stroke itself are not read. */
} carom_seat;

/* Bounds of a fair stroke. 0: no bound. */
typedef struct carom_stroke_limits {
  double speed;                 /* m/s, at most. */
  double theta;                 /* degrees, at most. */
  double tip;                   /* radii of the ball: sqrt(a^2 + b^2) at most. */
  double mass_least, mass_most; /* kg. */
  double end_mass_least;        /* kg. */
  double tip_restitution_most;  /* at most, where the 0 of a stroke means 1. */
  int64_t own_cue;              /* 1: stick and tip must be equal to the cue of the seat, bit by
                                   bit. */
} carom_stroke_limits;

/* The seats of a match. */
typedef struct carom_seating {
  int64_t count;                     /* 2 to CAROM_SEATS_MOST. */
  carom_seat seat[CAROM_SEATS_MOST]; /* the seats, in the order in which they play. */
  int64_t alternate;                 /* when the seats of one side alternate: 0: after each visit;
                                        1: after each stroke, as in Scotch doubles. */
  carom_stroke_limits limits;        /* the limits of all strokes. */
} carom_seating;

/* The most keys of other programs in a note. */
enum { CAROM_NOTE_EXTRAS = 8 };

/* A key of another program in a note. Recordings keep it, and this library does not interpret
 * it. */
typedef struct carom_note_extra {
  char key[32];      /* "x_" and letters, digits or "_": 30 bytes at most. */
  char text[256];    /* its value. */
  int64_t is_number; /* 1: the text is a number of JSON, written without quotes, else 0. */
} carom_note_extra;

/* Words about a game: a line "note". Notes are not sealed: they change neither the game nor a hash,
 * so anybody who can edit a recording can add, change and remove them. Texts are UTF-8 with a
 * closing 0 and without control characters; "" and 0: the note does not have this key. */
typedef struct carom_note {
  char date[32];      /* when, such as "2026-11-30" or "2026-11-30T20:15:00Z" (ISO 8601). */
  char event[128];    /* the tournament or the league. */
  char site[128];     /* where it is played. */
  char round[32];     /* the round of the event. */
  char name[64];      /* of the seat, or of the author of a note that no seat says. */
  char comment[1024]; /* any text. */
  char offer[16];     /* "draw" or "take_back": what the seat offers or asks for. */
  char answer[16];    /* "yes" or "no": to the last offer of another seat. */
  double seconds;     /* s: the time that the last stroke, or a part of it, took the player. */
  int64_t by;     /* 1 + the seat that says it; 0: nobody in particular, such as a judge. The line
                         has the seat itself. */
  int64_t extras; /* how many keys of other programs the note has. */
  carom_note_extra extra[CAROM_NOTE_EXTRAS]; /* the keys of other programs, with their values. */
} carom_note;

/* A set: matches that are played one after the other, until a side has won `race` of them. */
typedef struct carom_set {
  int64_t race;                  /* 1 to 1000; 0: the match belongs to no set. Best of n is a race
                                    to n / 2 + 1. */
  int64_t order;                 /* who breaks: a carom_break_order of carom_match.h. */
  int64_t first;                 /* the side that breaks first, such as by the lag. */
  int64_t number;                /* of this match, from 1. */
  int64_t won[CAROM_SEATS_MOST]; /* how many matches each side had won before it. */
  int64_t seed;            /* of the rack of match 1, 0 to 2^53 - 1; match n has seed + n - 1. */
  int64_t target;          /* as in carom_match_setup. */
  int64_t equal_innings;   /* 1: the match may have an equalizing inning, else 0. */
  double clock, extension; /* s: the time for a stroke, and by how much an extension lengthens it.
                              The caller measures the time; 0: no clock, no extensions. */
  int64_t extensions, timeouts; /* how many extensions a side has in a match, and how many timeouts
                                    in the set. */
} carom_set;

/* The state of a game for the player at the table. The first number of a pair belongs to this
 * player, the second to the opponent. A game of carom_plan.h reads the members that
 * carom_rules_kind names; the others are 0. */
typedef struct carom_rules_state {
  int32_t opening;   /* 1: the stroke is a break, else 0. */
  int32_t group;     /* a carom_group of carom_plan.h, the player's; in three-cushion 1 + the index
                        of the player's cue ball. */
  int32_t fouls[2];  /* successive fouls in their last strokes, 0 to 2. */
  int32_t score[2];  /* points, or balls that count, 0 to 1,000,000. The score of a player is score
                        minus lost. */
  int32_t lost[2];   /* points lost by fouls, or balls owed, 0 to 1,000,000. */
  int32_t pocket[2]; /* indices of the pockets in which balls count for each of them, 0 to
                        CAROM_POCKETS_MOST - 1. */
  int32_t may;       /* the sum of the carom_choice of the player. */
  int32_t on;        /* 1: a colour is on after a red; in blackball the player is snookered.
                        Otherwise 0. */
  int32_t free_ball; /* in snooker the ball that the opponent has just named as a free ball,
                        otherwise 0: judge() sets it, and carom_turn_settle() reads it. In blackball
                        1: the stroke is free. */
  int32_t target;    /* points that win, 1 to 1,000,000; or points that a break must make. */
  int32_t innings; /* equal innings, in three-cushion and straight rail: 1 if the player began, 2 if
                      the opponent did, 3 in the equalizing inning of the player. 0: the first
                      player who reaches the target wins. */
  int32_t seat;    /* in matches of more than two seats the seat at the table, 0 to CAROM_SEATS_MOST
                      - 1, otherwise 0. In games where each seat plays for itself, after the last
                      stroke the seat that has won. */
  uint64_t user[8]; /* integers. In games where each seat plays for itself: what the seat of this
                       index has left, such as lives or a set of balls; 0: it is out, or there is no
                       such seat. In English billiards, runs of hazards and cannons. Otherwise
                       integers for custom rules. */
  uint64_t context; /* for custom rules, such as the address of an object. It is copied with the
                       state, but not written to lines; no built-in game reads it. */
} carom_rules_state;

/* A game in progress: its state after the lines so far. All zero before the first line. */
typedef struct carom_record {
  int64_t kind;                             /* kind of the last line, a carom_record_kind. */
  int64_t line;                             /* lines so far. */
  int64_t revision;                         /* carom_physics_revision() of the library that recorded
                                               it. */
  int64_t format;                           /* format of the text: 2, or 3 for a match. In a match,
                                               lines "act" contain the decisions of players, and
                                               lines "balls", "place", "game" and "act" contain the
                                               hash of all lines so far. */
  int64_t shots;                            /* number of strokes and continuations so far. */
  uint64_t hash;                            /* hash of all lines so far, except the end. */
  int64_t count;                            /* number of balls. */
  carom_shot_ball balls[CAROM_BALLS_MOST];  /* the balls at the start of the last shot, for
                                               carom_shot_at(). */
  carom_ball_state final[CAROM_BALLS_MOST]; /* the states at the end of the last shot. */
  carom_table table;                        /* the table. */
  carom_shot_options options;               /* fast and threads are not read. The stopping options
                                               apply only to the next shot or continuation. */
  carom_cue cue;                            /* the stroke of the last shot. */
  int64_t placed;                           /* index of the last ball that was taken in hand. */
  double place[2];                          /* m: the position where that ball was put. */
  int64_t hand;                             /* 1: it is in hand and not placed yet. */
  int64_t bounds;                           /* where it may be placed: a carom_leave of
                                               carom_plan.h; 0: anywhere. */
  int64_t rules;                            /* the rules of the game, a carom_rules_kind of
                                               carom_plan.h. */
  int64_t side;                             /* the side at the table: 0 or 1, or the seat in games
                                               where each seat plays for itself. */
  int64_t winner;        /* 1 + the side that has won; CAROM_DRAWN of carom_plan.h; 0: none yet. */
  int64_t foul;          /* the foul of the last stroke, a carom_foul of
                                               carom_plan.h. */
  int64_t act;           /* the last act that was decided, a carom_act of
                                               carom_match.h. */
  int64_t actor;         /* the seat that acted last, of a match also by a stroke
                                               or a place; -1: none has yet. */
  int64_t choice;        /* the choice of the last act, a carom_choice. */
  int64_t call[2];       /* indices of the ball and the pocket that were called
                                               in the last act. */
  uint64_t seal;         /* the hash in the last line that has one. */
  carom_seating seating; /* of a match with a line "seats"; otherwise all zero. */
  carom_set set;         /* of a match with a line "set"; otherwise all zero. */
  int64_t match;         /* 1: the recording is of a match. Set this before the first line is
                            written. */
  /* The state of the game for this player; carom_rules_fault() checks it. */
  carom_rules_state standing;
  carom_record_end recorded; /* how the last shot that was read ended when it was recorded. */
  carom_record_end played;   /* how the shot that was played ended. */
  carom_event event;         /* the event of the last line that had one. */
  int64_t before, after;     /* number of balls for which `event` has states: 0, 1 or 2. */
  int64_t pending;           /* a carom_record_pending. */
  int64_t moved;             /* 1: final[] has not been put into balls[] yet. */
  carom_facts facts;         /* facts of the last shot. */
  carom_shot_state state;    /* where the last shot was stopped. */
  carom_note note;           /* the last note. */
  int64_t before_notes;      /* where `kind` is CAROM_RECORD_NOTE: the kind of the last line that is
                                no note. */
  char fault[192];           /* after CAROM_ERROR_RECORD: what is wrong, with the key. */
} carom_record;

/* Reads a line of `size` bytes, with or without its end of line, into the record, and places a ball
 * in hand. After a line CAROM_RECORD_SHOT or CAROM_RECORD_CONTINUE, call carom_record_play() before
 * you read the next shot.
 *
 * Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_REVISION for a recording made with another
 * revision of the physics, which is not read further because its shots would have other bits; or
 * CAROM_ERROR_RECORD for a line with a wrong key or value, for a line that is not allowed here, or
 * for an end whose number of shots differs from the shots read. record->fault then describes the
 * error. */
CAROM_API carom_status carom_record_read(carom_record *record, const char *line, size_t size);

/* Plays the shot of record->cue, or with CAROM_RECORD_CONTINUE continues a stopped shot, with the
 * same bits on all machines. The balls begin where the previous shot left them. `shot` may be NULL;
 * otherwise the caller sets events, brief and room in it, and the call sets the rest. Returns the
 * status of carom_shoot(), or CAROM_ERROR_NULL, or CAROM_ERROR_RECORD if there is nothing to play,
 * if a stroke would find a ball that moves, or if the recording has ended. record->played is how
 * the shot ended; after a line that was read, compare it with record->recorded. A shot with an
 * invalid argument changes nothing. */
CAROM_API carom_status carom_record_play(carom_record *record, carom_record_kind kind,
                                         carom_shot *shot);

/* Ball in hand: carom_place_ball() after the last shot. */
CAROM_API carom_status carom_record_place(carom_record *record, int ball, double x, double y,
                                          carom_part *in_the_way);

/* Takes a ball in hand after the last shot. The ball is out of play until it is placed: its label
 * is CAROM_BALL_POCKETED. CAROM_RECORD_PLACE writes this as well. CAROM_ERROR_BALLS for an invalid
 * index. */
CAROM_API carom_status carom_record_hand(carom_record *record, int ball);

/* Puts the states at the end of the last shot into record->balls. Call it before you change the
 * balls and write CAROM_RECORD_BALLS. CAROM_ERROR_BALLS for an invalid record->count. */
CAROM_API carom_status carom_record_settle(carom_record *record);

/* Writes the next line of the record, with its end of line and a closing 0, to text[room];
 * CAROM_RECORD_TEXT bytes are enough. Returns its length without the 0. Returns 0 if the room is
 * too small, or if the line is not allowed here, such as the line of a shot that was not played. */
CAROM_API size_t carom_record_write(carom_record *record, carom_record_kind kind, char *text,
                                    size_t room);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_RECORD_H */
