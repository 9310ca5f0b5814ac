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
 * An act that the rules forbid is rejected with CAROM_ERROR_ACT: match.refusal is the reason, and
 * match.fault describes what would be right. Nothing else has changed, and match.size is 0.
 *
 * Each act and each ruling is a line of a recording of format 3. carom_match_read() judges the
 * lines again, and rejects a line that breaks the rules. Nothing here allocates. */
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
  CAROM_ACT_CONCEDE = 3, /* the player concedes the game */
  CAROM_ACT_CLOCK = 4,   /* the time for a stroke is over: a foul */
  CAROM_ACT_EXTEND = 5,  /* the player takes an extension of the time for this stroke */
  CAROM_ACT_TIMEOUT = 6  /* the player takes a timeout */
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
  CAROM_REFUSED_TIME = 17      /* no extension or timeout is left */
} carom_refusal;

enum {
  CAROM_MATCH_TEXT = 135168, /* bytes with room for the lines of any act. */
  CAROM_MATCH_ERRORS = 17    /* number of errors of aim for which strokes are weighed. */
};

/* A match. The caller reads it, and changes it only by calls. It may be copied. */
typedef struct carom_match {
  carom_record record;    /* table, balls, count, options; player, who is at the table; hand,
                             whether the cue ball is to be placed. Its final states and facts belong
                             to the last shot. */
  carom_plan_rules rules; /* their state is from the view of the player at the table. */
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
  int64_t weighed[CAROM_SEATS_MOST]; /* for each seat: number of strokes in the set from which its
                                        errors are estimated. */
  double log_likelihood[CAROM_SEATS_MOST][CAROM_MATCH_ERRORS]; /* for each seat: the log-likelihood
                                                                  of these strokes for a player
                                                                  whose error of aim, at 2 m/s, is
                                                                  0.0125 degrees times sqrt(2) to
                                                                  the power of 0, 1, 2 ... */
  uint32_t on;                 /* the balls that may be met first in the next stroke, as a set. */
  uint32_t touching;           /* the balls that touch the cue ball, as a set. */
  carom_bounds bounds;         /* of a cue ball in hand, until the stroke. */
  int32_t leave;               /* the carom_leave of these bounds. */
  int32_t refusal;             /* of the last act: a carom_refusal. */
  carom_call call;             /* of the next stroke; {-1, -1}: none. */
  carom_ruling ruling;         /* the last one; all zero before the first. */
  int64_t rulings;             /* number of rulings so far. */
  int64_t size;                /* bytes of text[]: the lines of the last act; after lines that were
                                  read: the lines that are still missing. */
  int64_t due;                 /* the bytes of these that carom_match_read() expects. */
  char fault[256];             /* why the last act was rejected. */
  char text[CAROM_MATCH_TEXT]; /* lines: `size` bytes of them. */
} carom_match;

/* Begins a match with the rack of a game, with gaps of 0.1 mm and the seed, on a table that it
 * fits; `player`, 0 or 1, breaks. Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_ACT for a game
 * not listed or another player; or an error of carom_rack(). */
CAROM_API carom_status carom_match_begin(carom_match *match, carom_rules_kind rules,
                                         const carom_table *table, uint64_t seed, int player);

/* The same to `target` points; 0: the usual target of the game. With `equal_innings` 1 the player
 * who does not break has an equalizing inning, and the match may be drawn; 0: not. Also returns
 * CAROM_ERROR_ACT for a game without a target or without equal innings. */
CAROM_API carom_status carom_match_begin_to(carom_match *match, carom_rules_kind rules,
                                            int32_t target, int equal_innings,
                                            const carom_table *table, uint64_t seed, int player);

/* The same from any layout. `of` NULL: the rules of this kind, with their state at the beginning;
 * otherwise these rules, with their state. To read the match again, match->rules must have the same
 * custom rules. With `leave` ANYWHERE, KITCHEN, D or BAULK the cue ball is in hand. `options`,
 * which may be NULL, has the models. May also return an error of carom_shot_check(). */
CAROM_API carom_status carom_match_begin_at(carom_match *match, carom_rules_kind rules,
                                            const carom_plan_rules *of, const carom_table *table,
                                            const carom_shot_ball *balls, int count,
                                            const carom_shot_options *options, carom_leave leave,
                                            int player);

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
  const carom_plan_rules *of;        /* as in carom_match_begin_at(); NULL: the rules of this
                                        kind. */
  const carom_table *table;          /* the table. */
  const carom_shot_ball *balls;      /* a layout; NULL: the rack of the game. */
  int64_t count;                     /* how many balls the layout has. */
  const carom_shot_options *options; /* NULL: the defaults. */
  carom_leave leave;                 /* of a layout. */
  int32_t target, equal_innings;     /* as in carom_match_begin_to(). */
  int64_t side;                      /* the side that breaks, or plays first. */
  uint64_t seed;                     /* of the rack. */
  const carom_seating *seating;      /* NULL: the usual two seats. */
  const carom_set *set;              /* race, order, clock, extension, extensions and timeouts of a
                                        set; the call sets the other members. NULL: no set. */
} carom_match_setup;

/* Begins a match with any seats. Works as carom_match_begin_at(), or carom_match_begin_to() without
 * balls. Also returns CAROM_ERROR_ACT for invalid seats or an invalid set; a set needs a rack. */
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

/* All return CAROM_OK, CAROM_ERROR_NULL or CAROM_ERROR_ACT. `player` is the seat that acts. */

/* Makes one of the choices match->may. CAROM_CHOICE_PUSH applies to the next stroke; the others
 * replace it. */
CAROM_API carom_status carom_match_choose(carom_match *match, int player, carom_choice choice);

/* Places the cue ball in hand at a position within match->bounds, m. Until the stroke it may be
 * placed again. The choice to leave it where it was is then no longer available. */
CAROM_API carom_status carom_match_place(carom_match *match, int player, double x, double y);

/* Calls the ball and the pocket of the next stroke; ball -1: a safety. In snooker it names a colour
 * or a free ball, and the pocket is not read. Without a call a stroke is a safety; in snooker it
 * calls the ball that is met first. */
CAROM_API carom_status carom_match_call(carom_match *match, int player, carom_call call);

/* The acts that a stroke of a plan requires before it is played: places a cue ball in hand, pushes
 * out and calls. A stroke of the kind CAROM_PLAN_PASS passes, and no stroke follows. match->text
 * has the lines of all these acts; if one is rejected, it has the lines of the preceding acts,
 * which remain. */
CAROM_API carom_status carom_match_prepare(carom_match *match, int player,
                                           const carom_plan_stroke *stroke);

/* Plays a stroke of match->cue_ball, and judges it. `stop` has the stopping options time_most,
 * stop_at, first_of and events_most; NULL: the shot is played to its end. `shot` may be NULL;
 * otherwise the caller sets events, brief and room in it, and the call sets the rest. A stopped
 * shot is not judged yet; the call returns CAROM_STOPPED_AT_TIME or CAROM_STOPPED_AT_EVENT. A shot
 * that ends in an error is judged as a shot that met nothing, and the balls stay where they were
 * before. */
CAROM_API carom_status carom_match_stroke(carom_match *match, int player, const carom_cue *cue,
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
CAROM_API carom_status carom_match_extend(carom_match *match, int player);

/* Takes a timeout: the caller measures the time, and the match counts the timeouts. The act is
 * refused where none is left. */
CAROM_API carom_status carom_match_timeout(carom_match *match, int player);

/* Concedes the game to the other side. A seat that plays for itself leaves the game. Any seat may
 * do this at any time. */
CAROM_API carom_status carom_match_concede(carom_match *match, int player);

/* Ends the time of the player at the table: the match rules this as a stroke that met no ball,
 * which is a foul. */
CAROM_API carom_status carom_match_clock(carom_match *match, int player);

/* Ends the recording: match->text is its last line. Nothing follows it. */
CAROM_API carom_status carom_match_end(carom_match *match);

/* ---- Reading and planning -------------------------------------------------------------------- */

/* Reads a line of a match, with its end of line or without; `scratch` is overwritten. It applies
 * the line by the rules, and compares the lines of the ruling with the lines that follow.
 * match->text has the lines that are still missing, for example after a file that was cut off after
 * a shot. Returns CAROM_OK; CAROM_ERROR_NULL; an error of carom_record_read(), with record.fault in
 * match->fault; or CAROM_ERROR_ACT for a line that breaks the rules, which match->fault names.
 * Nothing is read after it. */
CAROM_API carom_status carom_match_read(carom_match *match, carom_record *scratch, const char *line,
                                        size_t size);

/* The same for a line that `seat` has sent, for example another player over a network: an act of
 * another seat is rejected, with nothing changed. A stroke beyond match->seating.limits is rejected
 * as a line that breaks the rules. seat -1: a judge, or a file. */
CAROM_API carom_status carom_match_read_from(carom_match *match, carom_record *scratch,
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

/* Plans for the seat at the table: sets table, balls, count, rules, shot and leave of the job; its
 * cue to match->cue if it is NULL, and the ball of the cue to the cue ball if no other ball may be
 * struck; its player by the rating of the seat if it is NULL; and its opponent by
 * carom_match_opponent() if it and the opponent of the options are NULL. The caller sets options
 * and memory. A cue ball in hand is placed within its bounds. Otherwise works as carom_plan() and
 * carom_plan_hand(); carom_plan_continue() continues the plan, with the match unchanged. Returns
 * CAROM_ERROR_ACT if no stroke may be played. */
CAROM_API carom_status carom_match_plan(carom_match *match, carom_plan_job *job,
                                        carom_plan_stroke *choices, int room, int *found);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_MATCH_H */
