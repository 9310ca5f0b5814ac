/* carom_match.h: a match of 2 to 8 seats: the table, the balls, the rules, the players with their
 * cues, the last shot and the recording in one object, which is changed by acts.
 *
 *     static carom_match match;  // all zero
 *     carom_table_make(CAROM_TABLE_POOL_9FT, &table);
 *     carom_match_begin(&match, CAROM_RULES_EIGHTBALL, &table, 1, 0);
 *     while (match.phase != CAROM_MATCH_OVER) {
 *       fwrite(match.text, 1, (size_t)match.size, file);  // the lines of the last act
 *       int seat = match.seat;
 *       if (match.phase == CAROM_MATCH_PLACE)
 *         status = carom_match_place(&match, seat, x, y);
 *       else if (wants to call)
 *         status = carom_match_call(&match, seat, (carom_call){ball, pocket});
 *       else {
 *         carom_cue cue = match.cue;  // of this seat, at the cue ball: aim it
 *         status = carom_match_stroke(&match, seat, &cue, NULL, NULL);
 *       }
 *       if (status == CAROM_ERROR_ACT)
 *         printf("%s\n", match.fault);  // such as "place: the cue ball must be within ..."
 *     }
 *
 * Words go into the recording by carom_match_note(): a comment, the time that a stroke took, an
 * offer of a draw and its answer. A note is no act. It changes neither the game nor a hash, and
 * the rules have no draw by agreement and no take-back: after both sides have agreed, the
 * caller ends the match with carom_match_end(), or reads the lines before the last act again
 * (carom_match_undone()).
 *
 * An act that the rules forbid is rejected with CAROM_ERROR_ACT: match.refusal is the reason, and
 * match.fault describes what would be right. Nothing else has changed, and match.size is 0.
 *
 * Three words, in all languages. A seat acts: match.seat is at the table, record.actor acted last,
 * and each act has the argument `seat`. A side wins: it is one seat, or the seats of partners.
 * record.side is at the table, a beginning names the side that breaks, match.winner is 1 + a side,
 * and the arrays of carom_standing are of sides. A player, carom_player, is how exactly somebody
 * aims. carom_seating has the side of each seat; of the usual two seats, seat 0 is side 0 and seat
 * 1 is side 1. In the lines of recordings, "player" is the side of a "game" and the seat of an
 * "act".
 *
 * Each act is a line of a recording, of format 3, and so is each ruling. Two functions read lines,
 * and both judge them again:
 *
 *     carom_match_read()      the lines of a file, in order: a game is saved by writing match.text
 *                             after each act, and loaded by reading the lines. Nothing is read
 *                             behind a line that is not by the rules.
 *     carom_match_receive()   a line of a peer, such as a client of a server. A line that is
 *                             refused leaves the match as it was, to the bit.
 *
 * A game that goes on where its file ends, even where that was cut off within a line:
 *
 *     static carom_match match;     // all zero
 *     static carom_record scratch;
 *     static char line[CAROM_RECORD_TEXT];
 *     long whole = 0;
 *     while (fgets(line, sizeof line, file) != NULL && strchr(line, '\n') != NULL) {
 *       if (carom_match_read(&match, &scratch, line, strlen(line)) < 0)
 *         return printf("%s\n", match.fault);                // begin again with a match of zeros
 *       whole = ftell(file);
 *     }
 *     fseek(file, whole, SEEK_SET);
 *     if (whole == 0)                                       // a new file
 *       carom_match_begin(&match, CAROM_RULES_EIGHTBALL, &table, 1, 0);
 *     fwrite(match.text, 1, (size_t)match.size, file);      // what the file lacks
 *     while (match.phase != CAROM_MATCH_OVER) {
 *       status = act(&match);                               // any act, such as a stroke
 *       fwrite(match.text, 1, (size_t)match.size, file);    // before the next call replaces it
 *     }
 *
 * A server, whose clients have the seats 0, 1, ...:
 *
 *     static carom_match match, scratch;
 *     carom_match_begin_with(&match, &setup);
 *     send_all(match.text, match.size);                   // the first lines, to every client
 *     while (next_line(&line, &size, &seat)) {            // of any client
 *       const int64_t before = match.record.line;
 *       if (carom_match_receive(&match, &scratch, line, size, seat) < 0)
 *         send(seat, match.fault);                        // nothing has changed
 *       else if (match.record.line != before)
 *         send_all(match.text, match.size);   // the act with its ruling, to every client
 *     }
 *
 * A client has a separate match. It receives the server's lines with seat -1, acts on a copy, sends
 * the copy's text, and waits until the server sends it back. examples/server has whole servers and
 * clients.
 *
 * Nothing here allocates. */
#ifndef CAROM_MATCH_H
#define CAROM_MATCH_H

#include "carom_plan.h"
#include "carom_record.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Ball in hand ---------------------------------------------------------------------------- */

/* Where a ball in hand may be put: its centre is within low[0] <= x <= high[0] and low[1] <= y <=
 * high[1], and if `radius` is above 0 also in the half circle around `centre`, towards y = 0. */
typedef struct carom_bounds {
  double low[2], high[2]; /* m */
  double centre[2];       /* m: of the D */
  double radius;          /* m: of the D; 0: no D */
} carom_bounds;

/* The bounds that a leave sets on a table for balls of this radius, m: ANYWHERE the complete table,
 * KITCHEN behind the head string or on it, D the D of snooker, BAULK behind the baulk line of
 * blackball or on it, a fifth of the length from the head. AFTER and BEFORE, when no ball is in
 * hand, are as ANYWHERE. Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_ACT for a value not
 * listed; CAROM_ERROR_RADIUS for a radius that is not 0 or more and finite. */
CAROM_API carom_status carom_hand_bounds(carom_leave leave, const carom_table *table, double radius,
                                         carom_bounds *bounds);

/* 1 if a position is within the bounds, otherwise 0. carom_place_ball() reports whether another
 * ball is there. */
CAROM_API int carom_is_within(const carom_bounds *bounds, double x, double y);

/* ---- A match --------------------------------------------------------------------------------- */

/* What a match waits for. */
typedef enum carom_match_phase {
  CAROM_MATCH_NONE = 0,   /* nothing: the match has not begun */
  CAROM_MATCH_STROKE = 1, /* a stroke, or one of the choices in match.may */
  CAROM_MATCH_PLACE = 2,  /* the cue ball is in hand: a position within match.bounds, or a choice */
  CAROM_MATCH_MOVING = 3, /* the shot was stopped while balls are moving: its continuation */
  CAROM_MATCH_OVER = 4    /* nothing: match.winner has won, or the match is drawn */
} carom_match_phase;

/* Who breaks in a set. */
typedef enum carom_break_order {
  CAROM_BREAKS_ALTERNATE = 0, /* the sides alternately */
  CAROM_BREAKS_WINNER = 1,    /* the side that has won the previous match; after a draw, the other
                                 side */
  CAROM_BREAKS_LOSER = 2      /* the side after it */
} carom_break_order;

/* The acts of lines "act". */
typedef enum carom_act {
  CAROM_ACT_CHOOSE = 1,  /* one of the choices */
  CAROM_ACT_CALL = 2,    /* a ball and a pocket */
  CAROM_ACT_CONCEDE = 3, /* the seat concedes the game */
  CAROM_ACT_CLOCK = 4,   /* the time for a stroke is over: a foul */
  CAROM_ACT_EXTEND = 5,  /* the seat takes an extension of the time for this stroke */
  CAROM_ACT_TIMEOUT = 6  /* the seat takes a timeout */
} carom_act;

/* Why an act was rejected. */
typedef enum carom_refusal {
  CAROM_REFUSED_NOT = 0,       /* the act was not rejected */
  CAROM_REFUSED_NOT_BEGUN = 1, /* the match has not begun */
  CAROM_REFUSED_OVER = 2,      /* the match is over */
  CAROM_REFUSED_TURN = 3,      /* another seat is at the table, or sent the line */
  CAROM_REFUSED_MOVING = 4,    /* balls move */
  CAROM_REFUSED_AT_REST = 5,   /* no ball moves, so no shot can be continued */
  CAROM_REFUSED_IN_HAND = 6,   /* the cue ball must be placed first */
  CAROM_REFUSED_NO_HAND = 7,   /* the cue ball is not in hand */
  CAROM_REFUSED_BOUNDS = 8,    /* the position is outside the bounds */
  CAROM_REFUSED_OCCUPIED = 9,  /* a ball or a cushion is in the way */
  CAROM_REFUSED_CHOICE = 10,   /* the rules do not allow this choice now */
  CAROM_REFUSED_CALL = 11,     /* the game does not have this call, or the ball is not on */
  CAROM_REFUSED_CUE_BALL = 12, /* a ball other than the cue ball would be struck */
  CAROM_REFUSED_STROKE = 13,   /* the stroke cannot be played: its status is in match.fault */
  CAROM_REFUSED_BEGIN = 14,    /* a match cannot begin in this way */
  CAROM_REFUSED_LINE = 15,     /* a line that was read breaks the rules */
  CAROM_REFUSED_LIMIT = 16,    /* the stroke is beyond the limits of the match */
  CAROM_REFUSED_TIME = 17,     /* no extension or timeout is left */
  CAROM_REFUSED_NOTE = 18      /* a value of the note is not allowed */
} carom_refusal;

enum {
  CAROM_MATCH_TEXT = 135168, /* bytes with room for the lines of any act. */
  CAROM_MATCH_ERRORS = 17    /* number of errors of aim for which strokes are weighed. */
};

/* A match. The caller reads it, and changes it only by calls. It may be copied. */
typedef struct carom_match {
  carom_record record;    /* table, balls, count, options; side, the side at the table; actor,
                                  the seat that acted last; hand, whether the cue ball is to be
                                  placed. Its final states and facts are of the last shot. */
  carom_plan_rules rules; /* their state is that of the player at the table. */
  int32_t phase;          /* what the match waits for: a carom_match_phase. */
  int32_t seat;           /* the seat at the table. */
  int32_t winner;         /* 1 + the side that has won; CAROM_DRAWN; 0: none yet. */
  int32_t may;            /* the choices for carom_match_choose(), as a set: a sum of carom_choice.
                             CAROM_CHOICE_FREE_BALL is named by a call, and with CAROM_CHOICE_PLACE
                             the cue ball is in hand. */
  int32_t cue_ball;       /* the ball that the player at the table strikes. */
  carom_cue cue; /* the cue of the seat at the table, for the cue ball: aim it. Its stroke is
                             the usual one of the game. */
  carom_seating seating;                /* who plays, and the limits of strokes. */
  int32_t turns[CAROM_SEATS_MOST];      /* for each side: which of its seats plays next, counted
                                           from 0. */
  int32_t extensions[CAROM_SEATS_MOST]; /* for each side: how many it has taken in this match. */
  int32_t timeouts[CAROM_SEATS_MOST];   /* for each side: how many it has taken in the set. */
  carom_shot_ball before[CAROM_BALLS_MOST]; /* the balls before the last stroke. */
  carom_cue stroke;                  /* the last stroke, whose shot carom_match_replay() plays
                                        again. */
  carom_player player;               /* of the seat at the table, by its rating. */
  carom_player opponent;             /* of the last plan, by carom_match_opponent(). */
  int64_t weighed[CAROM_SEATS_MOST]; /* of each seat: how many strokes in the set tell how it
                                        errs. */
  double log_likelihood[CAROM_SEATS_MOST][CAROM_MATCH_ERRORS]; /* of each seat: how likely these
                                  strokes are for a player whose error of aim, at 2 m/s, is 0.0125
                                  degrees times sqrt(2) to the power of 0, 1, 2 ... */
  uint32_t on;         /* the balls that may be met first in the next stroke, as a set. */
  uint32_t touching;   /* the balls that touch the cue ball, as a set. */
  carom_bounds bounds; /* of a cue ball in hand, until the stroke. */
  int32_t leave;       /* the carom_leave of these bounds. */
  int32_t refusal;     /* of the last act: a carom_refusal. */
  carom_call call;     /* of the next stroke; {-1, -1}: none. */
  carom_ruling ruling; /* the last one; all zero before it. */
  int64_t rulings;     /* how many there were. */
  int64_t size;        /* bytes of text[], the lines of the last call: those of an act and its
                                  ruling; after carom_match_read(), only those that were not read
                                  yet. */
  int64_t known;       /* how many bytes of text[] behind these are lines of the last act before
                                  the notes: carom_match_receive() recognises them. */
  int64_t due;         /* how many of these bytes the next lines of the file must have, for
                                  carom_match_read(): all or none; 0 after an act and after
                                  carom_match_receive(). */
  char fault[256];     /* of the last act, why it was refused. */
  char text[CAROM_MATCH_TEXT]; /* lines: `size` bytes of them, which the next call replaces. */
} carom_match;

/* Begins a match of two seats with the rack of a game, by gaps of 0.1 mm and the seed, on a table
 * that it fits; `side` 0 or 1 breaks. CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_ACT for a game or a
 * side that is not listed; or an error of carom_rack(). */
CAROM_API carom_status carom_match_begin(carom_match *match, carom_rules_kind rules,
                                         const carom_table *table, uint64_t seed, int side);

/* ---- Seats and sets -------------------------------------------------------------------------- */

/* Makes `seats` seats for a game, 0: the usual number. In games of two sides, every second seat
 * belongs to the same side; in other games each seat is a side. The seats have no names and no
 * handicaps, the game's cue, and these limits: 15 m/s, 90 degrees, 0.75 radii, sticks of 0.2 to 1.2
 * kg whose end has 1 g or more. Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_ACT for a number of
 * seats that the game does not have. */
CAROM_API carom_status carom_seating_make(carom_rules_kind rules, int seats,
                                          carom_seating *seating);

/* How a match begins. All zero except `table`: eight-ball for two, with a rack. */
typedef struct carom_match_setup {
  carom_rules_kind rules;            /* the game. */
  const carom_plan_rules *of;        /* custom rules, with their state; match->rules must have
                                        them before the match is read again. NULL: the rules of
                                        this kind, with their state at the beginning. */
  const carom_table *table;          /* the table. */
  const carom_shot_ball *balls;      /* a layout; NULL: the rack of the game. */
  int64_t count;                     /* how many balls the layout has. */
  const carom_shot_options *options; /* the models; NULL: the defaults. */
  carom_leave leave;                 /* of a layout: with ANYWHERE, KITCHEN, D or BAULK the cue
                                        ball is in hand. */
  int32_t target;                    /* the points that win, of a match with a rack; 0: as usual
                                        in the game. */
  int32_t equal_innings;             /* 1, of a match with a rack: the side that does not break has
                                        an equalizing inning, and the match may be drawn. 0: it has
                                        none. */
  int64_t side;                      /* the side that breaks, or plays first. */
  uint64_t seed;                     /* of the rack. */
  const carom_seating *seating;      /* NULL: the usual two seats. */
  const carom_set *set;              /* race, order, clock, extension, extensions and timeouts of a
                                        set; the call sets the other members. NULL: no set. */
} carom_match_setup;

/* Begins a match with any seats, rules and layout. Returns as carom_match_begin(); CAROM_ERROR_ACT
 * also for invalid seats, an invalid set or a set without a rack, and for a game without a target
 * or without equal innings; an error of carom_shot_check() for a layout. */
CAROM_API carom_status carom_match_begin_with(carom_match *match, const carom_match_setup *setup);

/* Begins the next match of the set, with the same seats. match->text has the end of this match,
 * unless it was already written, and the beginning of the next. Returns CAROM_ERROR_ACT if the
 * match is not over, if it belongs to no set, or if the set is over. */
CAROM_API carom_status carom_match_next(carom_match *match);

/* The score of the match, by sides and seats, independent of who is at the table. */
typedef struct carom_standing {
  int64_t sides;                     /* how many sides play. */
  int64_t points[CAROM_SEATS_MOST];  /* for each side, with its handicap; in games where each seat
                                        plays for itself what it has left, such as lives or balls; 0
                                        in games without points. */
  int64_t won[CAROM_SEATS_MOST];     /* for each side: matches of the set won, including this
                                        one. */
  int64_t side_of[CAROM_SEATS_MOST]; /* for each seat: its side. */
  int64_t set_winner;                /* 1 + the side that has won the set; 0: none yet. */
} carom_standing;
CAROM_API carom_status carom_match_standing(const carom_match *match, carom_standing *standing);

/* Writes what the match waits for, or how it ended, as a text with names of seats, such as "Ann
 * (seat 0) has won". Otherwise works as carom_ruling_string(). */
CAROM_API size_t carom_match_string(const carom_match *match, char *text, size_t room);

/* ---- Acts ------------------------------------------------------------------------------------ */

/* All return CAROM_OK, CAROM_ERROR_NULL or CAROM_ERROR_ACT. `seat` is the seat that acts, not its
 * side. record.actor then has it, until the next act. */

/* Makes one of the choices match->may. CAROM_CHOICE_PUSH applies to the next stroke; the others
 * replace it. */
CAROM_API carom_status carom_match_choose(carom_match *match, int seat, carom_choice choice);

/* Places the cue ball in hand at a position within match->bounds, m. Until the stroke it may be
 * placed again. The choice to leave it where it was is then no longer available. */
CAROM_API carom_status carom_match_place(carom_match *match, int seat, double x, double y);

/* Calls the ball and the pocket of the next stroke; ball -1: a safety. In snooker it names a colour
 * or a free ball, and the pocket is not read. Without a call a stroke is a safety; in snooker it
 * calls the ball that is met first. */
CAROM_API carom_status carom_match_call(carom_match *match, int seat, carom_call call);

/* The acts that a stroke of a plan requires before it is played: places a cue ball in hand, pushes
 * out and calls. A stroke of the kind CAROM_PLAN_PASS passes, and no stroke follows. match->text
 * has the lines of all these acts; if one is rejected, it has the lines of the preceding acts,
 * which remain. */
CAROM_API carom_status carom_match_prepare(carom_match *match, int seat,
                                           const carom_plan_stroke *stroke);

/* Plays a stroke of match->cue_ball, and rules. `stop` says when to stop the shot, by time_most,
 * stop_at and first_of, and may be NULL: at its end. Its events_most is not read, because a shot
 * that reaches it ends in an error, and a player could then take a stroke back. `shot` may be NULL;
 * else events, brief and room in it are the caller's, and the rest is set. A stopped shot is not
 * ruled yet; it returns CAROM_STOPPED_AT_TIME or CAROM_STOPPED_AT_EVENT. A shot that ends in an
 * error is ruled as one that met nothing, and the balls lie as before. */
CAROM_API carom_status carom_match_stroke(carom_match *match, int seat, const carom_cue *cue,
                                          const carom_shot_options *stop, carom_shot *shot);

/* Continues a stopped shot, as carom_shot_continue() does, and judges it at its end. */
CAROM_API carom_status carom_match_continue(carom_match *match, const carom_shot_options *stop,
                                            carom_shot *shot);

/* Plays the last stroke again from its beginning, to obtain the events, paths and frames of a shot
 * that was played, read or loaded. If balls are still moving, it plays the shot up to the current
 * time, and carom_match_continue() then continues this `shot`. `shot` has room for the required
 * results. The balls are match->before. Returns the status of carom_shoot(); CAROM_ERROR_STATE
 * before the first stroke. */
CAROM_API carom_status carom_match_replay(carom_match *match, carom_shot *shot);

/* Takes an extension of the time for this stroke: the caller measures the time, and the match
 * counts the extensions. The act is refused where none is left. */
CAROM_API carom_status carom_match_extend(carom_match *match, int seat);

/* Takes a timeout: the caller measures the time, and the match counts the timeouts. The act is
 * refused where none is left. */
CAROM_API carom_status carom_match_timeout(carom_match *match, int seat);

/* Concedes the game to the other side. A seat that plays for itself leaves the game. Any seat may
 * do this at any time. */
CAROM_API carom_status carom_match_concede(carom_match *match, int seat);

/* Ends the time of the seat at the table: the match rules this as a stroke that met no ball,
 * which is a foul. */
CAROM_API carom_status carom_match_clock(carom_match *match, int seat);

/* Writes a note of a seat into the recording: match->text is its line. `seat` -1: of nobody in
 * particular, such as a judge; note->by is not read. Every seat may do this in every phase,
 * from the beginning to the end of the recording. The game and its hashes do not change, and
 * record.note is the note. CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_ACT with the refusal
 * NOT_BEGUN, OVER behind the end of the recording, TURN for a seat that the match does not
 * have, or NOTE for a value that is not allowed. */
CAROM_API carom_status carom_match_note(carom_match *match, int seat, const carom_note *note);

/* Ends the recording: match->text is its last line, and match->phase is OVER. Only the next match
 * of a set follows it. The caller may end a match early, which then has no winner; a peer's line
 * may not (see carom_match_receive()). */
CAROM_API carom_status carom_match_end(carom_match *match);

/* ---- Reading and planning -------------------------------------------------------------------- */

/* Reads a line of a match, with its end of line or without; `scratch` is room that is overwritten.
 * The function applies the line by the rules, and compares the lines of the ruling with those that
 * follow. match->text has the lines that are still missing, as of a file that was cut off behind a
 * shot. CAROM_OK; CAROM_ERROR_NULL; an error of carom_record_read(), with record.fault in
 * match->fault; CAROM_ERROR_ACT for a line that is not by the rules: match->fault names it. Nothing
 * is read behind it; to go on, read the lines before it into a match of zeros. */
CAROM_API carom_status carom_match_read(carom_match *match, carom_record *scratch, const char *line,
                                        size_t size);

/* Reads a line of a peer, with its end of line or without. `seat` is the seat that has sent it, or
 * -1 for whoever may send every line: the server of a client, or a judge. `scratch` is room, of
 * which only `text` need not be overwritten. Where the line is an act by the rules, the match does
 * it, and match->text has its line and those of the ruling, which the peer may send too or not.
 *
 * Every refusal leaves the match as it was, to the bit, but for `fault` and `refusal`. So do a
 * blank line, a line "event", and a line that equals one of match->text: such an act was taken
 * before, and its line has come twice. An act twice in a row is therefore not received; call the
 * function of the act for a second extension of one stroke.
 *
 * A note of a peer becomes a line of the match too: record.line grows, and match->text is the line,
 * which a server sends to every client. A seat sends its own notes only.
 *
 * A seat sends its own acts only, and these without being asked: its concession at any time, the
 * continuation of a shot that was stopped, whoever played it, the end of the recording once the
 * match is over, and the head of the next match of a set. The lines before the first "game" are
 * received with seat -1. Of the options of a shot a line may carry time_most, stop_at and first_of,
 * which divide the shot and do not change it.
 *
 * CAROM_OK; CAROM_ERROR_NULL; an error of carom_record_read(); CAROM_ERROR_ACT with match->refusal
 * NOT_BEGUN, TURN for an act of another seat, or LINE for a line that is not by the rules or has
 * other values than the match makes. match->fault says why. */
CAROM_API carom_status carom_match_receive(carom_match *match, carom_match *scratch,
                                           const char *line, size_t size, int seat);

/* The number of bytes of the lines of a match before its last act. Reading these lines restores the
 * match before that act, and reading the others repeats it. A copy of a match can also be used to
 * undo. */
CAROM_API size_t carom_match_undone(const char *lines, size_t size);

/* Writes the opponent of the seat at the table: with two sides, the seat of the other side that
 * plays next, with its rating. If that seat has no rating, the opponent is `player` with errors
 * that are scaled according to the strokes of the other side in this set: how often it kept the
 * turn, and how likely that was from each layout. Without such strokes, in games without pockets
 * and in games where each seat plays for itself, the opponent is as good as `player`. Returns
 * CAROM_OK or CAROM_ERROR_NULL. */
CAROM_API carom_status carom_match_opponent(const carom_match *match, const carom_player *player,
                                            carom_player *opponent);

/* A plan for the seat at the table: sets table, balls, count, rules, shot and leave of the job; its
 * cue to match->cue where that is NULL, and the ball of the cue to the cue ball where another one
 * may not be struck; its player, where that is NULL, by the rating of the seat, which must have
 * one; and its opponent by carom_match_opponent() where that and the one of the options are NULL.
 * Options and memory are the caller's; options->shots is 100 or more, or 0 for the default. Plans
 * with a cue ball in hand within its bounds. As carom_plan() and carom_plan_hand(); goes on by
 * carom_plan_continue(), with the match unchanged. CAROM_ERROR_ACT where no stroke may be
 * played. */
CAROM_API carom_status carom_match_plan(carom_match *match, carom_plan_job *job,
                                        carom_plan_stroke *choices, int room, int *found);

/* The comparison of versions of carom_serves(). */
#ifdef CAROM_SERVED
#define carom_match_begin(...) CAROM_SERVED(carom_match_begin(__VA_ARGS__))
#define carom_match_begin_with(...) CAROM_SERVED(carom_match_begin_with(__VA_ARGS__))
#define carom_match_read(...) CAROM_SERVED(carom_match_read(__VA_ARGS__))
#endif

#ifdef __cplusplus
}
#endif

#endif /* CAROM_MATCH_H */
