/* carom_plan.h: which shot to play. It contains players who make errors, rules of games, the chance
 * of a shot, and the search for the best shots of a layout.
 *
 *     carom_player player = carom_player_of(1.0);
 *     carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
 *     rules.state.group = CAROM_GROUP_SOLIDS;  // of the player at the table
 *     static carom_plan_job job;
 *     job.table = &table;  // table, balls and cue as of carom_shoot()
 *     job.balls = balls;
 *     job.count = 16;
 *     job.cue = &cue;
 *     job.player = &player;
 *     job.rules = &rules;
 *     job.memory_size = carom_plan_memory(NULL);
 *     job.memory = malloc(job.memory_size);
 *     carom_plan_stroke best[5];
 *     int found;
 *     // best[0].cue is the shot, best[0].value the chance to win
 *     carom_status status = carom_plan(&job, best, 5, &found);
 *
 * Units, axes and statuses are as in carom.h and carom_shot.h. Nothing here allocates or prints
 * either. docs/understanding/plan.md explains the method. */
#ifndef CAROM_PLAN_H
#define CAROM_PLAN_H

#include "carom_record.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Players --------------------------------------------------------------------------------- */

/* How the stroke of a player differs from the intended one: standard deviations of independent
 * normal errors. The stroke with errors stays within the bounds. Every member except `eye` is 0 to
 * 1000. */
typedef struct carom_player {
  double speed;       /* m/s, for a cue whose tip loses nothing. With a tip of restitution e it is
                         2/(1 + e) times as much, so that the error of the ball's speed is the
                         same. */
  double speed_share; /* relative error of the cue's speed; the squares of this error and of `speed`
                         are added. */
  double phi, theta;  /* degrees. */
  double a, b;        /* radii of the ball. */
  double speed_least; /* least speed of the cue, m/s, for all strokes. 0: 0.5 times 2/(1 + e), or
                         speed_most if that is lower. */
  double speed_most;  /* greatest speed of the cue, m/s, for all strokes. 0: 8 times 2/(1 + e), or
                         speed_least if that is higher: 9.2 with a tip of leather. */
  double tip_most;    /* bound of |a| and |b|, radii, 0 to 1. 0: 0.5. */
  double growth;      /* s/m: how the errors of phi, a and b grow with the speed v of the cue, by
                         sqrt(1 + (growth v)^2), for a tip as above; the error of phi also grows as
                         1/cos(theta) with the elevation. 0: the errors are the same for all
                         strokes. Above 0, a plan's strokes except breaks are at most half as fast
                         as speed_most. */
  double only_pots;   /* fraction of the strokes, without breaks, for which the player considers
                         only pots, 0 to 1. carom_plan() and carom_plan_hand() decide from their
                         seed and the layout whether the stroke is one of them. They then plan as if
                         the opponent made every ball and the player 90 % of the later pots, and
                         carom_plan_stroke.value is the chance under these assumptions. 0 for advice
                         to a player. */
  double shots;       /* number of shots of this player's plans, if the options set neither shots
                         nor seconds: 100 to 2000. 0: 2000. */
  double eye;         /* m, at most 0.01: how exactly the player sees the balls: the standard
                         deviation of each ball's perceived position along x and along y. Whenever a
                         plan plays a stroke with errors, the balls are displaced by such errors,
                         the same for all strokes that it compares. A gap between balls, or to a
                         cushion, becomes at most twice as wide, so balls that touch stay in touch.
                         0: 0.0002, which is 0.2 mm. Below 0: no error, the balls are in their given
                         positions. */
} carom_player;

/* A player with all errors proportional to `scale` >= 0. For a stroke of 2 m/s they are 0.1 m/s,
 * 0.1 degrees of direction and of elevation, and 0.003 radii along a and along b, times scale. A
 * public benchmark of eight-ball (AI3603, 2025) has these errors at every speed. Here they grow
 * with the speed, as for rated players: the error of the speed is 5 % of it times scale, and
 * `growth` is 0.25. One scale for all errors is a convention. The eye has its default, but with
 * scale 0 the player also sees positions exactly. The scale is not checked here: carom_plan()
 * rejects a player with an error that is not 0 to 1000. */
CAROM_API carom_player carom_player_of(double scale);

/* A player with a Fargo rating, 200 to 850; other values are limited to this range. The player has
 * errors that grow with the speed, a number of shots for a plan, and a fraction of strokes for
 * which only pots are considered, and plays as rated if the options of plans set neither shots nor
 * seconds. The parameters are chosen so that a player beats one who is 100 points weaker in 2 of 3
 * games. docs/understanding/plan.md has the parameters, and how often each player wins and runs
 * out. */
CAROM_API carom_player carom_player_fargo(double rating);

/* Adds errors to the stroke that a player intends. The errors depend on `seed` and the number of
 * the stroke, so the same arguments give the same errors on every machine. If a pointer is NULL,
 * the call does nothing. */
CAROM_API void carom_player_strike(const carom_player *player, uint64_t seed, uint64_t number,
                                   carom_cue *cue);

/* How many games a player won and lost against an opponent with a Fargo rating, 0 to 1000. won and
 * lost are 0 to 1e9; fractions are allowed, for example for games with a smaller weight. */
typedef struct carom_score {
  double against, won, lost; /* against: the Fargo rating of the opponent, 0 to 1000; won, lost:
                                numbers of games, 0 to 1e9. */
} carom_score;

/* An estimated rating. */
typedef struct carom_rating {
  double mean, low, high; /* the rating is from low to high with a probability of 95 %, with 2.5 %
                             on each side. */
  int64_t row;            /* index of an invalid score; otherwise -1. */
} carom_rating;

/* Estimates the rating of a player, 200 to 850, from games. A player with rating r beats one with
 * rating d with odds of 2^((r - d)/100) : 1. Before the first game, ratings have a normal
 * distribution around 400 with a standard deviation of 150, cut at 200 and 850: a convention, with
 * which the mean without games is 426. Such a player is unrated. Returns CAROM_OK;
 * CAROM_ERROR_NULL; or CAROM_ERROR_SCORE for an invalid score or a negative count, with
 * rating->row, which is -1 for the count, and NaN in the other members. A call takes about 0.1 ms
 * per row, for any number of games. */
CAROM_API carom_status carom_rating_of(const carom_score *scores, int64_t count,
                                       carom_rating *rating);

/* ---- Rules ----------------------------------------------------------------------------------- */

/* What happens to the turn of the player who has just played. WIN and the values after it end the
 * game. */
typedef enum carom_turn_outcome {
  CAROM_TURN_KEEP = 0, /* the player plays on */
  CAROM_TURN_PASS = 1, /* the opponent plays; without an opponent, the visit ends */
  CAROM_TURN_WIN = 2,  /* the player has won */
  CAROM_TURN_LOSE = 3, /* the player has lost */
  CAROM_TURN_DRAW = 4  /* the game ends without a winner */
} carom_turn_outcome;

/* The winner of a drawn game. A winner is 1 + a player, CAROM_DRAWN, or 0: none yet. */
enum { CAROM_DRAWN = 9 }; /* beyond 1 + the last seat */

/* The layout of the next stroke. */
typedef enum carom_leave {
  CAROM_LEAVE_AFTER = 0,    /* the balls stay where they are */
  CAROM_LEAVE_BEFORE = 1,   /* the balls go back to where they were before the shot */
  CAROM_LEAVE_ANYWHERE = 2, /* the balls stay where they are, but the cue ball is in hand,
                               anywhere */
  CAROM_LEAVE_KITCHEN = 3,  /* in hand behind the head string; carom_plan() values it as ANYWHERE */
  CAROM_LEAVE_D = 4,        /* in hand in the D of a snooker table */
  CAROM_LEAVE_BAULK = 5     /* in hand behind the baulk line, a fifth of the length from the head;
                               any ball may be hit from there */
} carom_leave;

/* Why a shot is a foul. The first value that applies is reported, except that DOUBLE_HIT precedes
 * CUSHION and BREAK. */
typedef enum carom_foul {
  CAROM_FOUL_NONE = 0,       /* no foul: the shot is legal */
  CAROM_FOUL_CUE_BALL = 1,   /* the cue ball fell or left the table */
  CAROM_FOUL_NO_BALL = 2,    /* the cue ball met no ball */
  CAROM_FOUL_FIRST = 3,      /* the cue ball first hit a ball that is not on */
  CAROM_FOUL_OFF = 4,        /* a ball left the table */
  CAROM_FOUL_CUSHION = 5,    /* nothing fell, and nothing met a cushion after the first contact.
                                Unlike in the WPA's rules, a cushion that a ball already touched
                                counts here */
  CAROM_FOUL_BREAK = 6,      /* a break that potted nothing drove too few balls to cushions. It
                                needs four; in straight pool the cue ball and two more, in bank pool
                                two */
  CAROM_FOUL_OTHER = 7,      /* another rule, such as a custom one */
  CAROM_FOUL_POT = 8,        /* a ball fell that was not on */
  CAROM_FOUL_DOUBLE_HIT = 9, /* before the tip left the cue ball, the cue ball met a ball that was
                                not frozen to it; or the tip touched the cue ball twice. The
                                thinnest contact is a foul too, although rules allow it. A player
                                may play through a frozen ball; in snooker and three-cushion that is
                                a push. Later touches are not detected. */
  CAROM_FOUL_JUMP = 10       /* in snooker: before it met a ball, the cue ball flew over one (WPBSA,
                          section 2, rule 19) */
} carom_foul;

/* The foul of a shot by the rules that all games share: the fouls up to CAROM_FOUL_CUSHION, and
 * DOUBLE_HIT. `on` is the set of the balls that the cue ball may hit first. Without facts the foul
 * is CAROM_FOUL_NO_BALL. */
CAROM_API carom_foul carom_foul_of(const carom_facts *facts, uint32_t on, int cue_ball);

/* The consequences of a shot by the rules: who plays next, the foul, the points. */
typedef struct carom_turn {
  carom_turn_outcome outcome; /* what happens to the turn. */
  carom_leave leave;          /* the layout of the next stroke. */
  int32_t foul;               /* a carom_foul; 0 for a legal shot. */
  uint32_t spot;              /* the set of the balls that carom_turn_settle() puts back. */
  double points;              /* the points of the shot. A plan only reads them if there is no
                                 opponent. */
} carom_turn;

/* The ball and the pocket that were called. ball -1: none, a safety. Rules without calls only read
 * the following values of ball: */
typedef struct carom_call {
  int32_t ball, pocket; /* indices of the ball, -1 for a safety, and of the pocket. */
} carom_call;
enum {
  CAROM_CALL_PUSH = -2, /* the stroke is a push-out */
  CAROM_CALL_PASS = -3, /* the player does not play: the opponent plays from the same layout */
  CAROM_CALL_RACK = -4, /* the other choices of carom_choice, likewise: the player breaks again, */
  CAROM_CALL_OTHER_RACK = -5, /* the opponent breaks again, */
  CAROM_CALL_STAY = -6,       /* the cue ball stays where it is, */
  CAROM_CALL_SPOT = -7        /* touching balls go to their spots; or a ball to the foot spot, the
                                 nearest to the head string, or the one that `pocket` names among
                                 those equally near */
};

/* What the rules allow a player to do in addition to a stroke; a sum. */
typedef enum carom_choice {
  CAROM_CHOICE_PASS = 1,      /* leave the table to the opponent, with the call CAROM_CALL_PASS */
  CAROM_CHOICE_PUSH = 2,      /* push out, with the call CAROM_CALL_PUSH */
  CAROM_CHOICE_FREE_BALL = 4, /* name any ball as one that is on */
  CAROM_CHOICE_PLACE = 8, /* place the cue ball in the D, where it is after the foul. A player who
                                passes leaves it in hand */
  CAROM_CHOICE_RACK = 16, /* have the balls racked and break, with the call CAROM_CALL_RACK */
  CAROM_CHOICE_OTHER_RACK = 32, /* have the balls racked and let the opponent break, with the call
                                CAROM_CALL_OTHER_RACK */
  CAROM_CHOICE_STAY = 64,       /* leave the cue ball, which is in hand, where it is, with the call
                             CAROM_CALL_STAY */
  CAROM_CHOICE_SPOT = 128 /* have the balls that touch put on their spots; or, with the cue ball
                                in hand behind the head string and all balls that are on behind it
                                too, the nearest one on the foot spot (WPA 1.5). The call is
                                CAROM_CALL_SPOT */
} carom_choice;

/* The group of a player in eight-ball. */
typedef enum carom_group {
  CAROM_GROUP_OPEN = 0,   /* the table is open */
  CAROM_GROUP_SOLIDS = 1, /* 1 to 7 */
  CAROM_GROUP_STRIPES = 2 /* 9 to 15 */
} carom_group;

/* Which balls must be potted before the game is won. */
typedef enum carom_race {
  CAROM_RACE_OWN = 0,    /* each player has separate balls */
  CAROM_RACE_SHARED = 1, /* the balls are shared by both players */
  CAROM_RACE_ALONE = 2,  /* there is no opponent: the value is the fraction of the balls that the
                            player pots in a visit */
  CAROM_RACE_POINTS = 3, /* players make points: left() returns how many each of them needs */
  CAROM_RACE_SEATS = 4   /* each of 2 to 8 seats plays for itself: state.seat is at the table, and
                            state.user has what each seat has left. judge() sets state.seat to the
                            seat that plays next, or that has won with CAROM_TURN_WIN; value() is
                            the chance that state.seat wins */
} carom_race;

/* The functions of rules. A set of balls has bit k for ball k; `in_play` is the set of the balls on
 * the table. Several threads may call these functions at once, and their results must depend only
 * on their arguments.
 *
 * carom_rules_on: the balls that the cue ball may hit first, and that may be potted. */
typedef uint32_t carom_rules_on(const carom_rules_state *state, uint32_t in_play);

/* carom_rules_judge: the outcome of a shot. `in_play` is the set of the balls before it; cue_ball
 * is the index of the cue ball. If a shot ended in an error, or the player passed, the facts are
 * the same as for a shot in which the cue ball hit no ball. */
typedef carom_turn carom_rules_judge(carom_rules_state *state, uint32_t in_play, int cue_ball,
                                     const carom_facts *facts, carom_call call);

/* carom_rules_pockets: the pockets in which balls count for the player at the table, as a set. */
typedef uint32_t carom_rules_pockets(const carom_rules_state *state);

/* carom_rules_left: how many balls the player at the table, left[0], and the opponent, left[1],
 * have to pot to win. In a race for points: how many points they need, 0 for a player who has
 * won. */
typedef void carom_rules_left(const carom_rules_state *state, uint32_t in_play, int32_t left[2]);

/* carom_rules_value: the chance that the player at the table wins from a layout, 0 to 1; in_hand: 1
 * if this player has ball in hand. Without an opponent: the expected number of balls that the
 * player still pots. */
typedef double carom_rules_value(const carom_rules_state *state, const carom_ball_state *layout,
                                 int count, int in_hand);

/* carom_rules_points: in a race for points, the points of ball `ball` if it falls in the next
 * stroke; with ball -1 the mean points of a later pot. */
typedef double carom_rules_points(const carom_rules_state *state, uint32_t in_play, int ball);

/* carom_rules_settle: applies the rules that depend on the positions of the balls after a stroke
 * was judged. It spots all balls of turn->spot, and may change the state and the turn. */
typedef void carom_rules_settle(carom_rules_state *state, const carom_table *table,
                                carom_shot_ball *balls, int count, carom_turn *turn);

/* The rules of a game. The state is always from the view of the player at the table: judge() leaves
 * the state for the player who plays next. */
typedef struct carom_plan_rules {
  carom_rules_state state;      /* a shot may change it. */
  carom_rules_on *on;           /* the balls that may be hit first; required. */
  carom_rules_judge *judge;     /* the outcome of a shot; required. */
  carom_rules_left *left;       /* how much both players need to win; required. */
  carom_rules_value *value;     /* NULL: an estimate from the two best pots and the balls that are
                                   left. */
  carom_rules_pockets *pockets; /* NULL: all. */
  int32_t race;                 /* a carom_race. */
  int32_t calls;                /* 1: shots are called. A candidate then calls the pot that it makes
                                   without errors. 2: as 1, but a ball that is not in on() may also
                                   be called. */
  int32_t first_decides;        /* 1: a shot whose first contact is not with a ball of on() is
                                   always a foul. The plan does not play such shots to their end. */
  int32_t breaks;               /* 1: if state.opening is 1, the plan tries strokes of a break: it
                                   hits the nearest balls about full and hard. 2: it tries safe
                                   opening strokes: it hits the outer balls of the rack thin and
                                   soft; also with the cue ball in hand before an intact rack. A cue
                                   ball in hand is placed on the upper edge of its bounds; NULL: on
                                   the head string. */
  carom_rules_points *points;   /* NULL: each ball is worth one. */
  carom_rules_settle *settle;   /* NULL: balls are spotted, and nothing else happens. */
  int32_t rack;                 /* a carom_rack_kind, whose spots are used. 0: the spots of pool.
                                   With the rack of snooker or billiards, a cue ball in hand is in
                                   the D. */
  int32_t learned;              /* 1 + the carom_rules_kind from whose played games the chances were
                                   learned. 0, or if no games of this kind were played: a kind with
                                   the same race. */
  int32_t any_cue_ball;         /* 1: except in the opening, a player may strike any ball. */
  int32_t own_cue_balls; /* 1: each of two players has a cue ball: ball 1 where state.group is 2,
                            otherwise ball 0, as in three-cushion, whose rack implies it. */
  uint64_t reserved[3];  /* must be 0. */
} carom_plan_rules;

/* The ball that the player at the table strikes: in carom games each player has one. Ball 0 if any
 * ball may be struck. 0 for NULL. */
CAROM_API int carom_cue_ball_of(const carom_plan_rules *rules);

/* Built-in rules. The index of a ball is its number, and the cue ball is ball 0.
 *
 * EIGHTBALL and NINEBALL are the World Standardized Rules of the WPA (2016). From behind the head
 * string, the cue ball may first hit a ball that is also behind it, unless facts->barred names that
 * ball, as a carom_match does. */
typedef enum carom_rules_kind {
  CAROM_RULES_EIGHTBALL = 0,    /* 15 balls; the game is over without the eight. Ball and pocket are
                                   called. State: opening, group; may, after a break: to have a new
                                   rack if the break was not legal or the eight fell, and to leave
                                   the cue ball where it is after a foul. */
  CAROM_RULES_NINEBALL = 1,     /* 9 balls. The nine wins; in layouts without it, the highest ball.
                                   State: opening; fouls: a third one loses; target: how many balls
                                   a break must pot or drive to the head string, 0 to begin with, 3
                                   by the three-point rule; may: to push out just after a break
                                   without a foul, to pass after a push-out or a break below the
                                   target. */
  CAROM_RULES_POTTING = 2,      /* a drill for one player, who may pot any ball until a miss or a
                                   foul. */
  CAROM_RULES_THREECUSHION = 3, /* three-cushion, UMB: a player scores a point if the cue ball meets
                                   three cushions before the second ball. The opening must hit the
                                   red first. Balls that left the table are spotted. The value of a
                                   shot is the chance of its point, also in an equalizing inning;
                                   later strokes are not estimated. The table needs no pockets.
                                   State: opening; group: 1 if ball 0 is the cue ball of the player,
                                   2 if ball 1 is, 0 if both play with ball 0; score; target, 40 to
                                   begin with, 0: none; innings: 0 to begin with. With 1, equal
                                   innings: if the player who began reaches the target, the balls
                                   are placed for an opening of the opponent, who draws the game by
                                   reaching it too, and loses it by a miss. May: to have the balls
                                   that touch the cue ball spotted. */
  CAROM_RULES_STRAIGHT = 4,     /* straight pool, 14.1, WPA: 15 balls, of which any may be played;
                                   ball and pocket are called. When one ball is left, the others are
                                   racked again. State: opening; target, 100 to begin with; score,
                                   lost; fouls: a third one costs 15 more points, and the player
                                   must break again; may: to pass just after a break of the opponent
                                   that was not legal, so that the opponent breaks again. */
  CAROM_RULES_SNOOKER = 5,      /* snooker, WPBSA: white 0, reds 1 to 15, yellow 16, green 17, brown
                                   18, blue 19, pink 20, black 21, on any table. The call names a
                                   colour or a free ball; without a call it is the ball that the cue
                                   ball hits first. A striker who is more than seven points ahead
                                   claims the frame when only the black is left. The caller has to
                                   judge a miss, because only the caller knows the better stroke.
                                   State: on, score, free_ball; may,
                                   after a foul of the opponent: to pass, so that the opponent plays
                                   again, and a free ball. */
  CAROM_RULES_ONEPOCKET = 6,    /* one-pocket, BCA: 15 balls, of which any may be played; nothing is
                                   called. Eight balls win. Potted balls that count for no one are
                                   spotted at the end of the visit. State: pocket, at first the foot
                                   right and the foot left pocket of carom_table_make(); the player
                                   who breaks chooses one of them; score; lost: balls that are owed;
                                   fouls: a third one loses. */
  CAROM_RULES_BANK = 7,         /* bank pool, BCA: 15 balls, of which any may be played; ball and
                                   pocket are called. A ball counts if the cue ball hit it first,
                                   without a cushion before, and if it meets a cushion before it
                                   falls. It may kiss another ball on its way. Other balls that fall
                                   are spotted at the end of the visit. Eight balls win. State:
                                   opening; score; lost: balls that are owed; fouls: a third one
                                   loses; may: to pass just after a break of the opponent that was
                                   not legal, so that the opponent breaks again. */
  CAROM_RULES_TENBALL = 8,      /* ten-ball, WPA: 10 balls, of which the lowest must be met first.
                                   Any ball and its pocket are called, except on the break. The ten
                                   wins as the last ball, and is spotted if it falls before; in
                                   layouts without it, the highest ball wins. State: opening; target
                                   as in NINEBALL; fouls: a third one loses; may: to push out just
                                   after a break without a foul, and to pass after a push-out of the
                                   opponent, or after a ball that the opponent potted without
                                   calling it. */
  CAROM_RULES_STRAIGHTRAIL = 9, /* straight rail, UMB: a player scores a point if the cue ball meets
                                   both other balls. There are no barred corners. If a ball leaves
                                   the table, or a player whose cue ball touches another ball
                                   requests it, all three are placed as for the opening. Everything
                                   else is as in THREECUSHION; target is 100 to begin with. */
  CAROM_RULES_BLACKBALL = 10, /* blackball, WPA: as EIGHTBALL without calls. A break that pots none
                                 drives two balls past the middle. After a foul the cue ball is in
                                 baulk or stays, and the first stroke is free: it may meet and pot
                                 any ball but the black, and does not end the visit. A ball of the
                                 opponent may fall only together with an own ball. State: opening,
                                 group; free_ball: 1 for a free stroke; on: 1 if other balls hide
                                 all balls that are on, so that no cushion is needed; may: to leave
                                 the cue ball where it is, and to have a new rack. */
  CAROM_RULES_HEYBALL = 11,   /* heyball: as EIGHTBALL without calls. State: as in EIGHTBALL, and
                                 fouls: a third one loses. */
  CAROM_RULES_ROTATION = 12,  /* rotation, BCA: 15 balls, of which the lowest must be met first.
                                   Each ball counts its number, and 61 win. State: opening; score;
                                   fouls: a third one loses; may, after a break that was not legal:
                                   to have a new rack and break. */
  CAROM_RULES_PYRAMID = 13,   /* free pyramid: 16 balls, of which any may be struck and any counts
                                   one, also the struck one after a contact. A foul gives the
                                   opponent one. Eight win. State: opening; score; may, as in
                                   ROTATION. */
  CAROM_RULES_FOURBALL = 14,  /* four-ball as in Korea: white 0, yellow 1, reds 2 and 3. A player
                                   scores a point if the cue ball meets both reds, and loses one if
                                   it meets no red or the other cue ball. State: as in STRAIGHTRAIL,
                                   and lost; target 10 to begin with. */
  CAROM_RULES_COWBOY = 15,    /* cowboy, BCA: balls 1, 2 and 3 have the numbers 1, 3 and 5. Up to
                                 exactly 90 points, a ball that falls counts its number, and a
                                 contact with two or three balls counts 1 or 2; up to 100 only the
                                 latter counts. The last point is made with the cue ball off the 1
                                 into the called pocket. State: opening; score; lost: the points of
                                 this visit, which a foul costs; may, after an opening that did not
                                 meet the 3 first: to break, or to have the opponent break. */
  CAROM_RULES_KILLER = 16,    /* killer, by clubs: 2 to 8 seats, each for itself, play one stroke
                                 each in rotation, and lose one of three lives by a stroke without a
                                 pot or by a foul. The last seat with a life wins. State: opening,
                                 seat; user: lives, at first 3 for each of two seats. */
  CAROM_RULES_CUTTHROAT = 17, /* cut-throat, BCA: 3 or 5 seats with five or three of 15 balls each,
                                 by their numbers. The balls of the others are on, and the last seat
                                 with a ball wins. After a foul a ball of each other seat is
                                 spotted. State: opening, seat; target: the balls of a seat at
                                 first, 5 to begin with; user: the sets that are left; may, after a
                                 break that was not legal: to have a new rack and break. */
  CAROM_RULES_BILLIARDS = 18  /* English billiards, WPBSA: cue balls 0 and 1, red 2, on any table.
                                 Cannons count 2, hazards 2 or 3. State: group: 1 + the cue ball of
                                 the player; score; target, 100 to begin with; on: 1 if a miss is
                                 not a foul; user: runs of hazards and cannons, and where the red is
                                 spotted; may, after a foul: CAROM_CHOICE_RACK, the balls placed on
                                 their spots, and the cue ball in the D. */
} carom_rules_kind;

/* The description of a game. */
typedef struct carom_rules_about {
  const char *name, *text; /* "nineball", and a short description. */
  int32_t balls, rack;     /* the usual balls and rack: a carom_game and a carom_rack_kind. */
  int32_t last;            /* the highest number of a ball; 0: balls have any number. */
  int32_t opening, hand;   /* the carom_leave before the first stroke, and after a foul that leaves
                              the cue ball in hand. */
  int32_t table;           /* the usual table: a carom_table_kind. */
} carom_rules_about;

/* The description of a game, or NULL for a value not listed. */
CAROM_API const carom_rules_about *carom_rules_about_of(carom_rules_kind kind);

/* Checks the state of a game. Returns the name of the first invalid member, and sets *range to its
 * allowed values, such as "0 to 7". Returns NULL if all members are valid. */
CAROM_API const char *carom_rules_fault(carom_rules_kind kind, const carom_rules_state *state,
                                        const char **range);

/* The rules, with the state after the break; the rules of EIGHTBALL for a value not listed. */
CAROM_API carom_plan_rules carom_plan_rules_of(carom_rules_kind kind);

/* A player with a rating in a game, as in the seats of a match. 100 points are odds of 2 to 1 in a
 * rack, a frame of snooker, or a game to 15 points of three-cushion or straight pool. A player
 * rated 500 has the errors of carom_player_fargo() in each game. For other ratings the function
 * uses the errors of a rating that is nearer to 500 the more often the better player wins in the
 * game. A value not listed is treated as eight-ball. */
CAROM_API carom_player carom_player_rated(double rating, carom_rules_kind rules);

/* Puts balls[ball] on the foot spot, or as near to it as there is room on the long string: behind
 * the spot if possible, otherwise in front of it. Returns CAROM_OK, CAROM_ERROR_OFF_TABLE if there
 * is no room, or an error of carom_place_ball(). */
CAROM_API carom_status carom_spot_ball(const carom_table *table, carom_shot_ball *balls, int count,
                                       int ball);

/* The same by the rules of a rack's game. A colour of snooker is put on its own spot. If that is
 * occupied, it is put on the free spot of the highest value. If no spot is free, it is put as near
 * to its own spot as there is room: towards the top cushion if possible, otherwise away from it.
 * Also returns CAROM_ERROR_RACK if the rack has no such ball. */
CAROM_API carom_status carom_spot_ball_of(carom_rack_kind kind, const carom_table *table,
                                          carom_shot_ball *balls, int count, int ball);

/* Makes the layout of the next stroke from the balls that a shot left, after judge(). It spots the
 * balls of turn->spot, and does everything else that depends on the positions of the balls. In
 * straight pool it racks 14 balls, and moves the last ball and the cue ball out of the rack; the
 * cue ball may then be in hand. In snooker, a player who is snookered after a foul gets a free
 * ball, and it is a foul to snooker the opponent behind the free ball. *state is the one that
 * judge() left; it and *turn may change. A cue ball in hand that is in the way is removed. Returns
 * CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_BALLS if spot names a ball beyond count; or the first
 * error of carom_spot_ball_of(). */
CAROM_API carom_status carom_turn_settle(const carom_plan_rules *rules, carom_rules_state *state,
                                         const carom_table *table, carom_shot_ball *balls,
                                         int count, carom_turn *turn);

/* A ball that fell into a pocket, at a time, s. */
typedef struct carom_fall {
  double time;          /* when it fell, s. */
  int32_t ball, pocket; /* indices of the ball and of the pocket. */
} carom_fall;

/* The result of a stroke by the rules. */
typedef struct carom_ruling {
  carom_turn turn;                         /* as carom_turn_settle() left it. */
  carom_rules_state state;                 /* for the player who plays next; `may` has what this
                                              player may do in addition to a stroke. */
  int32_t hand;                            /* 1: the cue ball is in hand. */
  uint32_t on;                             /* the set of the balls that the cue ball may hit first
                                              in the next stroke. */
  uint32_t put;                            /* the set of the balls that are no longer where the shot
                                              left them. */
  uint32_t touching;                       /* the set of the balls that touch the cue ball, within
                                              CAROM_RULES_TOUCH; empty if it is in hand. */
  int64_t falls;                           /* how many balls fell. */
  carom_fall fall[CAROM_BALLS_MOST];       /* the balls that fell, in the order in which they
                                              fell. */
  carom_facts facts;                       /* of the shot. */
  carom_shot_ball balls[CAROM_BALLS_MOST]; /* the layout of the next stroke, with all spotted balls.
                                              A cue ball in hand is where the shot left it, or
                                              down. */
} carom_ruling;

/* Judges a shot that was played, without playing it again. The rules have the state before the
 * shot, `balls` are the balls before it, and the shot has facts and final states. shot NULL: the
 * player has passed, with the call CAROM_CALL_PASS, or the shot ended in an error; the balls then
 * stay where they were. Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_BALLS for an invalid count
 * or cue ball; or an error of carom_turn_settle(), with the ruling. */
CAROM_API carom_status carom_referee(const carom_plan_rules *rules, const carom_table *table,
                                     const carom_shot_ball *balls, int count, int cue_ball,
                                     const carom_shot *shot, carom_call call, carom_ruling *ruling);

/* Writes the text of a ruling, such as "foul: the cue ball met no ball; the other plays, cue ball
 * in hand", to text[], at most `room` bytes with a closing 0. Returns the length of the complete
 * text without the 0, or 0 for an invalid ruling. */
CAROM_API size_t carom_ruling_string(const carom_ruling *ruling, char *text, size_t room);

/* ---- Plans ----------------------------------------------------------------------------------- */

/* All zero means the defaults. */
typedef struct carom_plan_options {
  int64_t shots;                /* approximate number of shots of the complete layout that a plan
                                   plays, 100 to 1,000,000. 0: with `seconds` 200,000, otherwise the
                                   number of the player, or 2000. */
  double scan;                  /* fraction of the shots for strokes in all directions, at most 0.9.
                                   0: 0.5. Below 0: no such strokes. */
  uint64_t seed;                /* seed of the errors, which are a function of the seed, the stage
                                   and the row. */
  int32_t threads;              /* largest number of threads, as in carom_shot_options. No bit of a
                                   result depends on it. */
  int32_t level;                /* 1: the cue is level, and its stick may pass through cushions and
                                   balls, as in programs that have no stick. 0: the stick stays
                                   above them. */
  const carom_player *opponent; /* NULL: the opponent makes the same errors as the player. */
  double chance_me;             /* chance of each later pot of a visit, 0 to 1, for the player. 0:
                                   it depends on the layout and on the error phi of the player, as
                                   learned from played racks. A chance below 0.001 counts as 0.001.
                                   Values of layouts depend on it. */
  double chance_opponent;       /* chance of each later pot of a visit, 0 to 1, for the opponent. 0:
                                   it depends on the layout and on the error phi of the opponent. 1:
                                   the opponent makes every ball, so the plan tries to run out,
                                   because a turn that ends before is worth nothing. In games of
                                   points the value of a layout is then the fraction of the points
                                   on the table that the visit makes. */
  const volatile int32_t *stop; /* not NULL: another thread may set *stop to end the plan early,
                                   within some ms. Unless `once` is set, the call makes plans of
                                   100, 200, 400 ... shots. A plan that was stopped returns one
                                   choice, the best so far. After carom_plan_try(), the strokes that
                                   were not played have `seen` 0 and the value NaN. */
  int64_t slice;                /* about how many events of shots to play before carom_plan() and
                                   carom_plan_hand() return with *found 0, for
                                   carom_plan_continue(). An event among more than eight balls
                                   counts more. 0: they return at the end.
                                   carom_plan_try() does not read it. */
  double unsure;                /* how little the player knows about the table, 0 to 1. Above 0,
                                   four constants of the table are drawn at random together with the
                                   errors of strokes: the restitution and friction of cushions, the
                                   rolling resistance and the sliding friction are multiplied by
                                   exp(unsure s z) with z normal. s is 0.12, 0.17, 0.29 and 0.26, so
                                   that 1 represents the variation among all tables. Each stroke is
                                   played on one of 32 such tables, the same for all strokes that
                                   are compared. */
  double seconds;               /* s, up to 1,000,000: a plan whose calls have together taken this
                                   time before all its shots are played is stopped as with `stop`;
                                   0: no limit. */
  int32_t once;                 /* 1: all shots are played for one plan, which may still be
                                   stopped. */
  int32_t safeties;             /* 1: the plan tries only safeties: strokes that without errors pass
                                   the turn without a foul. It lists several, whose directions
                                   differ by more than 5 degrees. A break does not change. */
  uint64_t reserved[1];         /* must be 0. */
} carom_plan_options;

/* The kind of a choice, which follows from what happens in the shot. The kind of a pot is the first
 * of combination, carom, kiss, kick, rail first, bank and pot that applies, by approach and banked
 * of carom_facts. */
typedef enum carom_plan_kind {
  CAROM_PLAN_POT = 0,   /* a direct pot of `ball` into `pocket`: the ball meets nothing else on its
                           way except a cushion at the pocket */
  CAROM_PLAN_SCAN = 1,  /* `ball` falls in half of the strokes, in several ways; or no ball is
                           named, and which one falls is luck */
  CAROM_PLAN_FOUL = 2,  /* the plan found no shot without a foul; this one is gentle */
  CAROM_PLAN_GIVEN = 3, /* a stroke of the caller, for carom_plan_try() */
  CAROM_PLAN_PUSH = 4,  /* a push-out, if the rules allow one */
  CAROM_PLAN_PASS = 5,  /* to pass, if the rules allow it; the stroke is meaningless */
  CAROM_PLAN_BREAK = 6, /* a break, in games that have one; no ball is named */
  CAROM_PLAN_BANK = 7,  /* the cue ball meets `ball`, which meets a cushion and falls */
  CAROM_PLAN_KICK = 8,  /* the cue ball meets a cushion before any ball, except for RAIL_FIRST */
  CAROM_PLAN_COMBINATION = 9, /* another ball meets `ball`, which falls */
  CAROM_PLAN_CAROM = 10,      /* the cue ball meets another ball before `ball`; without pockets: it
                                 meets two */
  CAROM_PLAN_SAFETY = 11,     /* no ball is named: at most one stroke in ten keeps the turn */
  CAROM_PLAN_KISS = 12,       /* the cue ball meets `ball`, which meets another ball and falls */
  CAROM_PLAN_RAIL_FIRST = 13  /* the cue ball meets the cushion next to its first ball, then that
                                 ball */
} carom_plan_kind;

/* The kind of a shot that pots a ball: a carom_plan_kind. It is derived from the facts, and from
 * the events or brief events that were kept. -1 if they do not show that the ball was hit and fell
 * into the pocket. */
CAROM_API int32_t carom_pot_kind(const carom_shot *shot, int cue_ball, int ball, int pocket);

/* Further properties of a stroke, as a set. */
typedef enum carom_stroke_mark {
  CAROM_MARK_SCRATCH = 1,    /* the cue ball fell into a pocket */
  CAROM_MARK_DOUBLE_HIT = 2, /* as CAROM_FOUL_DOUBLE_HIT */
  CAROM_MARK_SPLIT_HIT = 4,  /* the cue ball met its first two balls less than 1 ms apart. Here the
                                first of them counts */
  CAROM_MARK_LEGAL_BREAK = 8 /* an object ball fell, or four met cushions or left the table */
} carom_stroke_mark;

/* The marks of a shot, as a sum of carom_stroke_mark. */
CAROM_API uint32_t carom_stroke_marks(const carom_facts *facts, int cue_ball);

/* A stroke that a plan proposes, and its results. */
typedef struct carom_plan_stroke {
  carom_cue cue;        /* the cue, raised just enough for its stick to clear cushions and balls,
                           unless `level` is set */
  double place[2];      /* the position where the cue ball is or is put, m. */
  int32_t kind;         /* a carom_plan_kind. */
  int32_t ball;         /* the ball that falls and keeps the turn. With called shots this is the
                           ball that falls first without errors. Otherwise it is the ball that falls
                           first most often with errors, if at least half of the strokes with errors
                           pot one, and else the ball of the stroke without errors. -1 if no ball
                           falls without errors, nor in half of the strokes with errors; also -1 for
                           a foul. CAROM_CALL_PUSH and CAROM_CALL_PASS for those kinds, so that ball
                           and pocket are the call. On a table without pockets it is the ball that
                           the cue ball hits first. */
  int32_t pocket;       /* the pocket into which `ball` falls, or -1. */
  int32_t cushions;     /* impacts of that ball on cushions, in one such stroke. */
  double value;         /* chance to win, plus half the chance to draw; without an opponent, the
                           fraction of the balls that are potted; 0 to 1. In four-ball a stroke that
                           loses a point has the value -1. The value of a foul is 0.018 below the
                           value of the position that follows it, so that the plan chooses a legal
                           stroke among equally good ones. The shots by which a stroke was chosen
                           were partly lucky for it. All chances of a choice are therefore estimated
                           from fresh shots, which were not used to choose, and from 10 of the
                           others: a tenth of the shots of the plan, at least 30, for the best
                           choice, and a 40th, at least 20, for each other choice. The value of a
                           choice is at most the value of the best one. A plan that was stopped may
                           have no fresh shots; the value is then 0.75 standard errors less than the
                           mean of the shots. */
  double error;         /* the standard error of the mean of the shots. */
  double keep;          /* chance that the player plays on, wins or draws; this includes the point
                           after which the opponent has the equalizing inning. */
  double foul, lose;    /* chances that the shot is a foul, and that it loses. */
  int64_t seen;         /* how often the shot was played with errors. 0 if the plan was stopped
                           before that; the value is then the value of the shot without errors. */
  double leave[2];      /* for a push-out and a pass: the chance to win of the opponent, who plays
                           from there, and of the player, to whom the opponent may return a
                           push-out; by plans from there. 0 for other kinds, and if these plans were
                           not made: the plan was stopped before, or the best stroke is worth 0.1
                           more. */
  uint64_t reserved[2]; /* 0. */
} carom_plan_stroke;

/* What a stroke must leave, without a foul. */
typedef enum carom_goal_kind {
  CAROM_GOAL_WIN = 0,     /* nothing but the best chance to win */
  CAROM_GOAL_HIDDEN = 1,  /* the turn passes, and the opponent can hit no ball that is on in a
                             straight line */
  CAROM_GOAL_SNOOKER = 2, /* the turn passes, and other balls hide one edge of `ball` or both */
  CAROM_GOAL_NEAR = 3,    /* the cue ball rests within `distance` of `place` */
  CAROM_GOAL_APART = 4    /* each ball of `balls` is down, or at least `distance` from every other
                             object ball */
} carom_goal_kind;

/* The goal of a plan. A stroke that reaches NEAR or APART keeps the turn; with options->safeties it
 * passes the turn. HIDDEN and SNOOKER need pockets, an opponent and the cue ball 0, and only
 * safeties reach them. */
typedef struct carom_plan_goal {
  int32_t kind;     /* a carom_goal_kind. */
  int32_t ball;     /* for SNOOKER: the ball, which is in play. */
  uint32_t balls;   /* for APART: the set of the balls, which are in play. */
  int32_t reserved; /* must be 0. */
  double place[2];  /* m: for NEAR: the position, on the table. */
  double distance;  /* m: for NEAR: the largest distance of the centre of the cue ball; for APART:
                       the smallest gap between the surfaces of balls. Above 0. */
} carom_plan_goal;

/* The position for which a plan is made. */
typedef struct carom_plan_job {
  const carom_table *table;          /* the table. */
  const carom_shot_ball *balls;      /* the layout, at rest. */
  int64_t count;                     /* number of balls, 2 to CAROM_BALLS_MOST. */
  const carom_cue *cue;              /* the cue: its ball, masses, tip and miscue are read; the
                                        stroke itself is not. */
  const carom_player *player;        /* the player whose stroke is planned, with the errors of this
                                        player. */
  const carom_plan_rules *rules;     /* the rules, with the state of the player at the table. */
  const carom_shot_options *shot;    /* models, space, fast; NULL: the defaults. threads and the
                                        stopping options are not read. */
  const carom_plan_options *options; /* NULL: the defaults. */
  void *memory;                      /* room for the plan, aligned as by malloc(). */
  size_t memory_size;                /* bytes of `memory`, at least carom_plan_memory(). */
  int64_t leave;                     /* a carom_leave: how the cue ball came to its position for
                                        this stroke, in every game. Only this member decides this,
                                        not the position of the ball. AFTER and BEFORE: it was not
                                        in hand. ANYWHERE, KITCHEN, D and BAULK: it is in hand, or
                                        was, within the bounds of carom_hand_bounds(), in which
                                        carom_plan_hand() places it. With KITCHEN, the stroke may
                                        not first meet a ball behind the head string (WPA 6.11).
                                        carom_match_plan() sets it. */
  const carom_plan_goal *goal;       /* NULL: the best chance to win. Otherwise the value of a
                                        choice is the chance that its stroke reaches the goal. */
  const carom_player *opponent;      /* NULL: the opponent of the options. carom_match_plan() sets
                                        it. */
  uint64_t reserved[1];              /* must be 0. */
} carom_plan_job;

/* The number of bytes that a plan with these options needs: about 320,000 for the defaults, and
 * 450,000 more if `unsure` is above 0. NULL: the defaults. 0 for options that carom_plan() rejects:
 * carom_plan_fault() says why. */
CAROM_API size_t carom_plan_memory(const carom_plan_options *options);

/* Finds the best shots of a layout. Writes up to `room` of them to choices[], best first, one for
 * each ball, pocket and kind. The value of every choice is at most 0.1 below the best. However, the
 * best safety that was found is always among them: it names no ball, and plays on in less than a
 * tenth of the shots. *found becomes their number, at least 1.
 *
 * Returns CAROM_OK; CAROM_ERROR_NULL if a pointer is NULL or there is too little memory;
 * CAROM_ERROR_OPTIONS for invalid options, an invalid player, a goal that is not possible in the
 * layout or with the rules, or rules without on(), judge() or left(); CAROM_ERROR_IN_MOTION for a
 * ball that is not at rest; CAROM_ERROR_GAME_OVER if on() names no ball in play; or an error of the
 * layout, as in carom_shot_check(). With an error only *found is written, which is then 0. The
 * choice depends only on the arguments, not on the number of threads. Unless shot->fast is set, it
 * is the same on all machines. */
CAROM_API carom_status carom_plan(const carom_plan_job *job, carom_plan_stroke *choices, int room,
                                  int *found);

/* Writes to text[], at most `room` bytes with a closing 0, which member of a job carom_plan()
 * rejects with CAROM_ERROR_OPTIONS, its value, and the allowed values: "options->shots is 60; it
 * must be 0, or 100 to 1e6". Returns the length of the complete text without the 0; 0 if such a
 * member does not exist, or if a required pointer of the job is NULL. job->memory is not needed. */
CAROM_API size_t carom_plan_fault(const carom_plan_job *job, char *text, size_t room);

/* The same with ball in hand: positions of the cue ball and strokes are compared together, by at
 * least 600 shots, and each choice has its own position. The position is within the bounds of
 * job->leave, where AFTER and BEFORE have the same bounds as ANYWHERE. It is also within low[0] <=
 * x <= high[0] and low[1] <= y <= high[1], m; NULL: no further bound on that side. The cue ball of
 * job->balls may be down. Also returns CAROM_ERROR_OFF_TABLE if the plan finds no free position. */
CAROM_API carom_status carom_plan_hand(const carom_plan_job *job, const double low[2],
                                       const double high[2], carom_plan_stroke *choices, int room,
                                       int *found);

/* Continues a plan in slices, for an opponent who thinks between the frames of a game: plays
 * options->slice more events. *found is 0 until the plan has ended, and with an error. The choices
 * then have the bits of a plan in one call. 500 events take at most about 1 ms; a slice may take one shot longer, or
 * longer if it sorts candidates. The job, its memory and everything that it points to must not have
 * changed since the previous call. A plan that has ended does not change, and a plan whose
 * options->stop was set ends. Returns CAROM_OK; CAROM_ERROR_NULL as in carom_plan(); or
 * CAROM_ERROR_STATE if the memory has no plan of this job.
 *
 *     options.slice = 1000;  // 2 ms
 *     status = carom_plan(&job, best, 5, &found);
 *     while (status == CAROM_OK && found == 0)
 *       status = carom_plan_continue(&job, best, 5, &found);  // a frame
 */
CAROM_API carom_status carom_plan_continue(const carom_plan_job *job, carom_plan_stroke *choices,
                                           int room, int *found);

/* Estimates the chances of `n` strokes of the caller. Each of them is played options->shots / n
 * times with errors, at least 10 times. choices[k] becomes the estimate for cues[k]. n is 0 to
 * 1000, otherwise CAROM_ERROR_OPTIONS. Only speed, phi, theta, a and b of each cue are read;
 * everything else is read from job->cue. Statuses are as for carom_plan(), and the error of the
 * first invalid stroke, with nothing written. */
CAROM_API carom_status carom_plan_try(const carom_plan_job *job, const carom_cue *cues, int n,
                                      carom_plan_stroke *choices);

/* Estimates the chance that the player at the table wins from the layout, with the rules' value()
 * and without playing a shot. in_hand: 1 with ball in hand, otherwise 0. Statuses are as for
 * carom_plan(); the call needs no memory. */
CAROM_API carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value);

/* ---- Aims ------------------------------------------------------------------------------------ */

/* The largest number of balls and rails on the way of an aim; and the pocket of an aim at a ball by
 * its cut, which no pocket takes. */
enum { CAROM_VIA_MOST = 4, CAROM_POT_NO_POCKET = -1 };

/* The result of an aim, in the shot of the complete layout. */
typedef enum carom_pot_outcome {
  CAROM_POT_FALLS = 0,    /* the ball falls into the pocket */
  CAROM_POT_NO_WAY = 1,   /* no direction of this cue sends the ball to the middle of the mouth on
                             this way; with some directions the ball may still fall, off the
                             middle */
  CAROM_POT_BARRED = 2,   /* a ball on the way meets something else first: `met` */
  CAROM_POT_SHORT = 3,    /* a ball on the way stops: met.a */
  CAROM_POT_REJECTED = 4, /* the jaws send the ball back, at this speed */
  CAROM_POT_STICK = 5     /* theta was NaN, and the stick would have to be raised by more than 60
                             degrees to clear cushions and balls, which nobody plays */
} carom_pot_outcome;

/* A ball and the pocket into which it is to fall. The caller sets the first block, and carom_aim()
 * the second one. */
typedef struct carom_pot {
  int32_t ball, pocket;           /* indices of the ball and of its pocket, or
                                     CAROM_POT_NO_POCKET. */
  int32_t vias;                   /* number of elements of via[], 0 to CAROM_VIA_MOST. */
  carom_part via[CAROM_VIA_MOST]; /* balls and rails in the order in which they are met. A rail is
                                     met by the ball before it. Rails before the first ball are met
                                     by the cue ball (a kick), and rails after `ball` are met by
                                     `ball` (a bank). A ball before `ball` meets `ball` (a
                                     combination). If via[] does not name `ball`, it comes after the
                                     last other ball. A rail stands for all rails on its line, such
                                     as both halves of a long one. */

  int32_t outcome;       /* a carom_pot_outcome. */
  double elevation;      /* degrees: the least elevation in the direction cue->phi with which the
                            stick clears the cushions and balls behind the cue ball. A stroke with a
                            smaller cue->theta cannot be played. 0 if cue->phi stays. */
  double cut;            /* degrees: the cut of the cue ball on the first ball. Above 0, the first
                            ball goes to the left of the cue ball's path. The caller sets it if
                            there is no pocket. */
  double margin;         /* degrees: how far the path of the ball into the pocket may deviate
                            towards either jaw; 0 if a jaw is in the way in every direction. */
  double phi[2];         /* the directions of the cue, degrees, between which the ball falls;
                            cue->phi is between them. */
  double speed[2];       /* the speeds of the cue, m/s, between which the ball falls in the
                            direction cue->phi, within 0.05 to 15. */
  carom_brief_event met; /* the contact of BARRED and SHORT. */
} carom_pot;

/* Aims a pot: cue->phi becomes the direction with which the ball goes to the middle of the pocket's
 * mouth on this way, for the cue's speed, tip and elevation. The call plays shots with the balls on
 * the way, so the aim includes squirt, swerve, throw and the model of the cushion. If cue->theta is
 * NaN, it becomes the least elevation with which the stick clears cushions and balls, and the aim
 * is computed for the raised cue. The call may miss a cut above 80 degrees. pot->outcome is the
 * result of the shot with the other balls and the jaws; if it is CAROM_POT_NO_WAY, cue->phi and
 * cue->theta do not change.
 *
 * If pot->pocket is CAROM_POT_NO_POCKET, which needs no table with pockets, the cue ball meets the
 * ball at the cut pot->cut, above -90 and below 90 degrees, and pot->vias is 0. CAROM_POT_FALLS
 * then means that it does: the cut is exact to 1e-6 degrees, with squirt and swerve. With
 * CAROM_POT_BARRED the cue ball meets something else first, with CAROM_POT_SHORT it comes to rest
 * before; with any outcome but CAROM_POT_FALLS the cue stays. margin, phi and speed are 0.
 *
 * Returns CAROM_OK; CAROM_ERROR_BALLS for an invalid index or order of via[]; CAROM_ERROR_OPTIONS
 * for an invalid cut; or an error of an argument, with nothing written. It takes one to ten ms. */
CAROM_API carom_status carom_aim(const carom_table *table, const carom_shot_ball *balls, int count,
                                 const carom_shot_options *shot, carom_pot *pot, carom_cue *cue);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_PLAN_H */
