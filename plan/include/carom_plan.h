/* carom_plan.h: which shot to play. Players who err, rules of games, the chance of a shot, and
 * the best shots of a layout.
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
 *     carom_choice best[5];
 *     int found;
 *     // best[0].cue is the shot, best[0].value the chance to win
 *     carom_status status = carom_plan(&job, best, 5, &found);
 *
 * Units, axes and statuses are those of carom.h and carom_shot.h. Like them, nothing here
 * allocates or prints. The method is told in docs/understanding/plan.md. */
#ifndef CAROM_PLAN_H
#define CAROM_PLAN_H

#include "carom_shot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Players --------------------------------------------------------------------------------- */

/* How the stroke of a player differs from the one that was meant: standard deviations of
 * independent normal errors. What the errors make of a stroke is kept within the bounds. Each
 * number is 0 to 1000. */
typedef struct carom_player {
  double speed;       /* m/s, of a cue whose tip loses nothing; with a tip of restitution e
                         2/(1 + e) times as much, so that the ball's is the same, */
  double speed_share; /* and as a share of the speed; both are added in squares. */
  double phi, theta;  /* degrees. */
  double a, b;        /* radii of the ball. */
  double speed_least; /* bounds of the speed of the cue, m/s, of all strokes. 0: 0.5
                         times 2/(1 + e), or speed_most if that is lower; */
  double speed_most;  /* and 0: 8 times 2/(1 + e), or speed_least if that is higher: 9.2 with a
                         tip of leather. */
  double tip_most;    /* bound of |a| and |b|, radii, 0 to 1. 0: 0.5. */
  double reserved[3]; /* must be 0. */
} carom_player;

/* A player with all errors proportional to `scale` >= 0: 0.1 m/s, 0.1 degrees of direction and
 * of elevation, and 0.003 radii each way, times scale. These are the errors of a public
 * benchmark of eight-ball (AI3603, 2025). One scale for all errors is a convention. The scale
 * is not checked here: carom_plan() refuses a player with an error that is not 0 to 1000. */
CAROM_API carom_player carom_player_of(double scale);

/* A player by a Fargo rating, 300 to 850; others count as the nearest of these. With plans of 300
 * shots he runs out eight-ball about as often as players of the rating are said to, on the table
 * CAROM_TABLE_POOLTOOL, from ball in hand after a break that pots nothing. More shots make him
 * stronger. docs/understanding/plan.md has the sources. */
CAROM_API carom_player carom_player_fargo(double rating);

/* Turns the stroke that a player means into one that he makes, by errors drawn from `seed` and the
 * number of the stroke. The same arguments give the same errors on every machine. */
CAROM_API void carom_player_strike(const carom_player *player, uint64_t seed, uint64_t number,
                                   carom_cue *cue);

/* Games that a player won and lost against one of a Fargo rating, 0 to 1000. Both are 0 to 1e9;
 * fractions are fine, such as for games that count less. */
typedef struct carom_score {
  double against, won, lost;
} carom_score;

/* What is known of a rating. */
typedef struct carom_rating {
  double mean, low, high; /* 95 % of the likely ratings are low to high, 2.5 % on each side. */
  int64_t row;            /* of a score that is wrong; else -1. */
} carom_rating;

/* The rating of a player, 300 to 850, by games. Of ratings r and d, the odds that r wins a game are
 * 2^((r - d)/100) : 1. Before the first game ratings are normal around 400 with a spread of 150.
 * CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_SCORE, with rating->row and numbers of NaN. About 0.1 ms
 * a row, of any numbers of games. */
CAROM_API carom_status carom_rating_of(const carom_score *scores, int64_t count,
                                       carom_rating *rating);

/* ---- Rules ----------------------------------------------------------------------------------- */

/* What becomes of the turn of the player who has played. */
typedef enum carom_turn_is {
  CAROM_TURN_KEEP = 0, /* he plays on */
  CAROM_TURN_PASS = 1, /* the other plays; without another, the visit ends */
  CAROM_TURN_WIN = 2,  /* he has won */
  CAROM_TURN_LOSE = 3  /* he has lost */
} carom_turn_is;

/* The layout of the next stroke. */
typedef enum carom_leave {
  CAROM_LEAVE_AFTER = 0,   /* as the balls lie */
  CAROM_LEAVE_BEFORE = 1,  /* as the balls lay: the shot is taken back */
  CAROM_LEAVE_HAND = 2,    /* as the balls lie, but for the cue ball, which is in hand, anywhere */
  CAROM_LEAVE_KITCHEN = 3, /* the same behind the head string; carom_plan() values it as HAND */
  CAROM_LEAVE_D = 4        /* the same in the D of a snooker table */
} carom_leave;

/* Why a shot is a foul: the first of these that holds, but DOUBLE_HIT before CUSHION and BREAK. */
typedef enum carom_foul {
  CAROM_FOUL_NONE = 0,      /* it is none */
  CAROM_FOUL_CUE_BALL = 1,  /* the cue ball fell or left the table */
  CAROM_FOUL_NO_BALL = 2,   /* the cue ball met no ball */
  CAROM_FOUL_FIRST = 3,     /* it met a ball first that is not on */
  CAROM_FOUL_OFF = 4,       /* a ball left the table */
  CAROM_FOUL_CUSHION = 5,   /* nothing fell, and nothing met a cushion after the first contact; a
                               cushion that a ball lay at counts too, as it does not by the WPA */
  CAROM_FOUL_BREAK = 6,     /* a break that potted nothing drove too few balls to cushions: fewer
                              than four; in straight pool the cue ball and two more, in bank
                              pool two */
  CAROM_FOUL_OTHER = 7,     /* by another rule, such as one of the caller's */
  CAROM_FOUL_POT = 8,       /* a ball fell that was not on */
  CAROM_FOUL_DOUBLE_HIT = 9 /* the cue ball met a ball that was not frozen to it before the tip
                               left it, be it the finest graze, which rules allow, or the tip
                               touched it twice. A frozen ball may be played through; in snooker
                               and three-cushion that is a push. Later touches are not known. */
} carom_foul;

/* The foul of a shot by the rules that all games share, up to CAROM_FOUL_CUSHION, and
 * DOUBLE_HIT; `on` are the balls that may be met first, as a set. */
CAROM_API carom_foul carom_foul_of(const carom_facts *facts, uint32_t on, int cue_ball);

/* Why, in words, such as "the cue ball met no ball"; "" for NONE and for a value not listed. */
CAROM_API const char *carom_foul_string(int foul);

/* What a shot means by the rules: who plays next, the foul, the points. */
typedef struct carom_turn {
  carom_turn_is is;
  carom_leave leave;
  int32_t foul;  /* a carom_foul; 0 for a legal shot. */
  uint32_t spot; /* balls that are put back, by carom_turn_settle(), as a set. */
  double points; /* of the shot. A plan reads them without an opponent only. */
} carom_turn;

/* The ball and the pocket that were called. ball -1: none, a safety. Rules without calls read the
 * other two values of it only: */
typedef struct carom_call {
  int32_t ball, pocket;
} carom_call;
enum {
  CAROM_CALL_PUSH = -2, /* the stroke is a push-out */
  CAROM_CALL_PASS = -3  /* the player does not play: the other has the table as it is */
};

/* What a player may do besides a stroke by the rules; a sum. */
typedef enum carom_may {
  CAROM_MAY_PASS = 1,      /* leave the table to the other, by the call CAROM_CALL_PASS */
  CAROM_MAY_PUSH = 2,      /* push out, by the call CAROM_CALL_PUSH */
  CAROM_MAY_FREE_BALL = 4, /* name any ball as one that is on */
  CAROM_MAY_PLACE = 8      /* in the D, where the cue ball is after the foul: who passes leaves it
                              in hand */
} carom_may;

/* Whose the balls of eight-ball are. */
typedef enum carom_group {
  CAROM_GROUP_OPEN = 0,   /* the table is open */
  CAROM_GROUP_SOLIDS = 1, /* 1 to 7 */
  CAROM_GROUP_STRIPES = 2 /* 9 to 15 */
} carom_group;

/* Whose balls are to be potted before the game is won. */
typedef enum carom_race {
  CAROM_RACE_OWN = 0,    /* each player has his own */
  CAROM_RACE_SHARED = 1, /* both have the same */
  CAROM_RACE_ALONE = 2,  /* there is no opponent: the value is the share of the balls that are
                            potted in a visit */
  CAROM_RACE_POINTS = 3  /* both make points: left() tells how many each of both needs */
} carom_race;

/* The functions of rules. A set of balls has bit k for ball k; `in_play` are the balls on the
 * table. They may be called from several threads at once, and depend on their arguments only.
 *
 * carom_rules_on: the balls that may be met first, and potted. */
typedef uint32_t carom_rules_on(const carom_rules_state *state, uint32_t in_play);

/* carom_rules_judge: the outcome of a shot. `in_play` are the balls before it; cue_ball is the
 * index of the cue ball. Facts in which no ball was met stand for a shot that ended in an error,
 * and for one that was passed. */
typedef carom_turn carom_rules_judge(carom_rules_state *state, uint32_t in_play, int cue_ball,
                                     const carom_facts *facts, carom_call call);

/* carom_rules_pockets: the pockets in which balls count for the player at the table, as a set. */
typedef uint32_t carom_rules_pockets(const carom_rules_state *state);

/* carom_rules_left: how many balls the player at the table, left[0], and the other one, left[1],
 * have to pot to win; in a race for points how many points they need, 0 of one who has won. */
typedef void carom_rules_left(const carom_rules_state *state, uint32_t in_play, int32_t left[2]);

/* carom_rules_value: the chance that the player at the table wins from a layout, 0 to 1;
 * in_hand: 1 where he has ball in hand. Without an opponent, how many balls he pots yet. */
typedef double carom_rules_value(const carom_rules_state *state, const carom_ball_state *layout,
                                 int count, int in_hand);

/* carom_rules_points: of a race for points, the points of ball `ball` if it falls in the next
 * stroke; with ball -1 those of a later pot, in the mean. */
typedef double carom_rules_points(const carom_rules_state *state, uint32_t in_play, int ball);

/* carom_rules_settle: what depends on where balls lie after a stroke that was judged. It puts back
 * all of turn->spot, and may change the state and the turn. */
typedef void carom_rules_settle(carom_rules_state *state, const carom_table *table,
                                carom_shot_ball *balls, int count, carom_turn *turn);

/* The rules of a game. The state is always that of the player at the table: judge() leaves it as
 * the next player has it. */
typedef struct carom_plan_rules {
  carom_rules_state state; /* a shot may change it. */
  carom_rules_on *on;
  carom_rules_judge *judge;
  carom_rules_left *left;
  carom_rules_value *value; /* NULL: an estimate from the best two pots and from the balls left. */
  carom_rules_pockets *pockets; /* NULL: all. */
  int32_t race;                 /* a carom_race. */
  int32_t calls;                /* 1: shots are called. Then a candidate calls the pot that it makes
                               without errors. */
  int32_t first_decides;        /* 1: a shot whose first contact is not with a ball of on() is a
                               foul, whatever else happens. Such shots are not played to their
                               end. */
  int32_t breaks;               /* 1: where state.opening is 1, the plan tries strokes as players
                                   break: the nearest balls about full, hard. 2: as they open who
                                   leave little: the outer balls of the rack thinly, softly. In
                                   hand the cue ball is on the upper edge of its bounds; NULL: on
                                   the head string. */
  carom_rules_points *points;   /* NULL: each ball is worth one. */
  carom_rules_settle *settle;   /* NULL: balls go back to their spots, and nothing else comes. */
  int32_t rack;                 /* a carom_rack_kind, whose spots the balls have. 0: pool's. With
                                   that of snooker a cue ball in hand is in the D. */
  int32_t learned;              /* 1 + the carom_rules_kind whose played games tell chances; 0, and
                                   where none were played: one with the same race. */
  uint64_t reserved[4];         /* must be 0. */
} carom_plan_rules;

/* Rules that are built in. A ball's index is its number, and the cue ball is ball 0.
 *
 * EIGHTBALL and NINEBALL are the World Standardized Rules of the WPA (2016), but for a break of
 * eight-ball that is not legal: the opponent has ball in hand. Nobody chooses a new rack, also not
 * where the eight falls; and a ball behind the head string may be met first from there. */
typedef enum carom_rules_kind {
  CAROM_RULES_EIGHTBALL = 0,    /* 15 balls; the game is over without the eight. Ball and pocket are
                                   called. State: opening, group. */
  CAROM_RULES_NINEBALL = 1,     /* 9 balls. The nine wins; without it, the highest ball. State:
                                   opening; fouls, of which a third loses; may: to push out just
                                   after a break without a foul, to pass after a push-out. */
  CAROM_RULES_POTTING = 2,      /* a drill for one: any ball may be potted, until one misses or
                                   fouls. */
  CAROM_RULES_THREECUSHION = 3, /* for one: a point where the cue ball meets three cushions before
                                   the second ball. The value of a shot is the chance of its point,
                                   and what follows is not estimated. No pockets are needed. */
  CAROM_RULES_STRAIGHT = 4,     /* straight pool, 14.1, WPA: 15 balls, any may be played; ball and
                                   pocket are called. Where one ball is left, the others are racked.
                                   State: opening; target, 100 to begin with; score, lost; fouls, of
                                   which a third costs 15 more, and a break; may: to pass just after
                                   a break of the other that was not legal, so that he breaks
                                   again. */
  CAROM_RULES_SNOOKER = 5,      /* snooker, WPBSA: white 0, reds 1 to 15, yellow 16, green 17, brown
                                   18, blue 19, pink 20, black 21, on any table. The call names a
                                   colour or a free ball; without one it is the ball that is met
                                   first. A striker more than seven points ahead claims the frame
                                   when the black alone is left. A miss is left to the caller, who
                                   knows the better stroke; a jump shot is not seen. State: on,
                                   score, free_ball; may, after a foul of the other: to pass, so
                                   that he plays again, and a free ball. */
  CAROM_RULES_ONEPOCKET = 6,    /* one-pocket, BCA: 15 balls, any may be played, nothing is called.
                                   Eight balls win. Balls that are down and count for no one come
                                   back at the end of the visit. State: pocket, to begin with the
                                   foot right and the foot left one of carom_table_make(), of which
                                   who breaks chooses; score; lost, balls that are owed; fouls, of
                                   which a third loses. */
  CAROM_RULES_BANK = 7          /* bank pool, BCA: 15 balls, any may be played; ball and pocket are
                                   called. A ball counts that meets a cushion before it falls, where
                                   the cue ball met it first, without a cushion before; what falls
                                   otherwise comes back at the end of the visit. Eight balls win.
                                   A ball that kisses another on its way counts. State: opening;
                                   score; lost, balls that are owed; fouls, of which a third loses;
                                   may: to pass just after a break of the other that was not legal,
                                   so that he breaks again. */
} carom_rules_kind;

/* What a game is. */
typedef struct carom_rules_about {
  const char *name, *text; /* "nineball", and what it is in a few words. */
  int32_t balls, rack;     /* the usual ones: a carom_game and a carom_rack_kind. */
  int32_t last;            /* the highest number of a ball; 0: balls have any. */
  int32_t opening, hand;   /* the carom_leave before the first stroke, and after a foul that leaves
                              the cue ball in hand. */
} carom_rules_about;

/* NULL for a value not listed. */
CAROM_API const carom_rules_about *carom_rules_about_of(carom_rules_kind kind);

/* Whether a game can stand so: returns the name of the first member that is wrong, and *range
 * becomes what it must be, such as "0 to 7"; NULL where all are right. */
CAROM_API const char *carom_rules_fault(carom_rules_kind kind, const carom_rules_state *state,
                                        const char **range);

/* The rules, with the state after the break; those of EIGHTBALL for a value not listed. */
CAROM_API carom_plan_rules carom_plan_rules_of(carom_rules_kind kind);

/* Puts balls[ball] on the foot spot, or as near to it as there is room on the long string: behind
 * it, else before it. CAROM_OK, CAROM_ERROR_OFF_TABLE where there is none, or an error of
 * carom_place_ball(). */
CAROM_API carom_status carom_spot_ball(const carom_table *table, carom_shot_ball *balls, int count,
                                       int ball);

/* The same by the rules of a rack's game: a colour of snooker goes to its own spot; if that is
 * taken, to the free spot of the highest value; else as near to its own as there is room, towards
 * the top cushion, else away from it. Also CAROM_ERROR_RACK where the rack has no such ball. */
CAROM_API carom_status carom_spot_ball_of(carom_rack_kind kind, const carom_table *table,
                                          carom_shot_ball *balls, int count, int ball);

/* Makes the layout of the next stroke of the balls that a shot left, after judge(): puts back the
 * balls of turn->spot, and does what else depends on where balls lie. In straight pool 14 balls are
 * racked, and the last one and the cue ball leave the rack: the cue ball may come to be in hand. In
 * snooker a player who is snookered after a foul has a free ball; to leave the other so behind the
 * free ball is a foul. *state is the one that judge() left; it and *turn may change. A cue ball
 * in hand that is in the way is down. CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_BALLS where spot
 * names a ball beyond count; or the first error of carom_spot_ball_of(). */
CAROM_API carom_status carom_turn_settle(const carom_plan_rules *rules, carom_rules_state *state,
                                         const carom_table *table, carom_shot_ball *balls,
                                         int count, carom_turn *turn);

/* A ball that fell, s. */
typedef struct carom_fall {
  double time;
  int32_t ball, pocket;
} carom_fall;

/* What a stroke comes to. */
typedef struct carom_ruling {
  carom_turn turn;         /* as carom_turn_settle() left it. */
  carom_rules_state state; /* as the next player has it; `may` says what he may do besides. */
  int32_t next;   /* who plays next: 0: the same player, 1: the other; -1: the game is over. */
  int32_t winner; /* 0: who has played, 1: the other; -1: none yet. */
  int32_t hand;   /* 1: the cue ball is in hand. */
  uint32_t on;    /* balls that may be met first in the next stroke, as a set. */
  uint32_t put;   /* balls that lie elsewhere than the shot left them, as a set. */
  int32_t unused; /* 0. */
  int64_t falls;  /* how many balls fell. */
  carom_fall fall[CAROM_BALLS_MOST];       /* them, the first one first. */
  carom_facts facts;                       /* of the shot. */
  carom_shot_ball balls[CAROM_BALLS_MOST]; /* the layout of the next stroke, with all that come
                                              back. A cue ball in hand is where the shot left it,
                                              or down. */
} carom_ruling;

/* Rules what a stroke comes to, from the shot that was played: nothing is played again. The rules
 * have the state before it, `balls` are those before it, and the shot has facts and final states.
 * shot NULL: the player has passed, by the call CAROM_CALL_PASS, or the shot ended in an error:
 * then the balls stay where they were. How the shot sounds is in its events: impulse, and
 * carom_event_slip(). CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_BALLS for a count or a cue ball that
 * cannot be; or an error of carom_turn_settle(), with the ruling. */
CAROM_API carom_status carom_referee(const carom_plan_rules *rules, const carom_table *table,
                                     const carom_shot_ball *balls, int count, int cue_ball,
                                     const carom_shot *shot, carom_call call, carom_ruling *ruling);

/* A ruling in words, such as "foul: the cue ball met no ball; the other plays, cue ball in hand",
 * as much of it as text[room] takes with a closing 0. Returns its whole length without the 0; 0 for
 * a ruling that cannot be. */
CAROM_API size_t carom_ruling_string(const carom_ruling *ruling, char *text, size_t room);

/* ---- Plans ----------------------------------------------------------------------------------- */

/* All zero means the defaults. */
typedef struct carom_plan_options {
  int64_t shots;                /* of the whole layout that a plan plays, about: 100 to
                                   1,000,000. 0: 2000; with `seconds` 200,000. */
  double scan;                  /* share of them for shots in all directions, at most 0.9. 0:
                                   0.5. Below 0: none. */
  uint64_t seed;                /* errors of strokes are a function of the seed, the stage and
                                   the row. */
  int32_t threads;              /* most threads, as in carom_shot_options. No bit of a result
                                   depends on it. */
  int32_t level;                /* 1: strokes are by a level cue, whose stick may be in cushions
                                   and balls, as in programs that have no stick. 0: it is over
                                   them. */
  const carom_player *opponent; /* NULL: he errs as the player does. */
  double chance_me;             /* of each later pot of a visit, 0 to 1, of the player; 0: by the
                                   layout and his error phi, as racks that were played told it.
                                   One below 0.001 counts as 0.001. Values of layouts depend on
                                   it. */
  double chance_opponent;       /* 0 to 1: likewise, of the opponent. 1: he makes every ball, so a
                                   plan is to run out: a turn that ends before is worth nothing. */
  const volatile int32_t *stop; /* not NULL: another thread may set it to end the plan early,
                                   within some ms. Unless `once`, it plays plans of 100, 200, 400
                                   ... shots. It then gives one choice, the best so far; of
                                   carom_plan_try() those that were not played have `seen` 0 and
                                   the value NaN. */
  int64_t slice;                /* events of shots, about, after which carom_plan() and
                                   carom_plan_hand() return with *found 0, for
                                   carom_plan_continue(). 0: they return at the end. Not read by
                                   carom_plan_try(). */
  double unsure;                /* how little the player knows of the table, 0 to 1. Above 0 its
                                   restitution and friction of cushions, rolling resistance and
                                   sliding friction are drawn with the errors of strokes, times
                                   exp(unsure s z), z normal; s is 0.12, 0.17, 0.29 and 0.26, so
                                   that 1 stands for all tables that there are. One of 32 tables
                                   for a stroke, the same for all strokes that are compared. */
  double seconds;               /* s, up to 1,000,000, of all its calls together, at which a plan is
                                   stopped as by `stop`, if it has not played its shots by then; 0:
                                   none. */
  int32_t once;                 /* 1: all shots are one plan, though it may be stopped. */
  int32_t unused;               /* must be 0. */
  uint64_t reserved[1];         /* must be 0. */
} carom_plan_options;

/* What a choice is, by what happens. Of a pot the first of combination, carom, kiss, kick, bank and
 * pot that holds; a jaw or a cut of a pocket is no cushion. */
typedef enum carom_plan_kind {
  CAROM_PLAN_POT = 0,   /* a direct pot of `ball` into `pocket`: the ball meets nothing else on its
                          way except a cushion beside the pocket */
  CAROM_PLAN_SCAN = 1,  /* `ball` falls in half of the strokes, by several ways */
  CAROM_PLAN_FOUL = 2,  /* no shot without a foul was found; this one is gentle */
  CAROM_PLAN_GIVEN = 3, /* the caller's, of carom_plan_try() */
  CAROM_PLAN_PUSH = 4,  /* a push-out, where the rules allow one */
  CAROM_PLAN_PASS = 5,  /* not to play, where the rules allow that; the stroke says nothing */
  CAROM_PLAN_BREAK = 6, /* a break, of rules that have them; no ball is named */
  CAROM_PLAN_BANK = 7,  /* the cue ball meets `ball`, which meets a cushion and falls */
  CAROM_PLAN_KICK = 8,  /* the cue ball meets a cushion before any ball */
  CAROM_PLAN_COMBINATION = 9, /* another ball meets `ball`, which falls */
  CAROM_PLAN_CAROM = 10,      /* the cue ball meets another ball before `ball`; without pockets: it
                                 meets two */
  CAROM_PLAN_SAFETY = 11,     /* no ball is named */
  CAROM_PLAN_KISS = 12        /* the cue ball meets `ball`, which meets another ball and falls */
} carom_plan_kind;

/* The word for a kind, such as "bank"; "" for a value not listed. */
CAROM_API const char *carom_plan_kind_name(carom_plan_kind kind);

/* The kind of a shot that pots a ball, read from the events or brief events that were kept: a
 * carom_plan_kind, or -1 where they do not show that the ball was met and fell into the pocket. */
CAROM_API int32_t carom_pot_kind(const carom_table *table, const carom_shot *shot, int cue_ball,
                                 int ball, int pocket);

/* 1 where a rail ends beside a pocket, within three radii of its centre, else 0. A ball that meets
 * such a rail and falls into the pocket is not banked. */
CAROM_API int carom_is_beside(const carom_table *table, int rail, int pocket);

/* What else a stroke was, as a set. */
typedef enum carom_stroke_mark {
  CAROM_MARK_SCRATCH = 1,    /* the cue ball fell into a pocket */
  CAROM_MARK_DOUBLE_HIT = 2, /* as CAROM_FOUL_DOUBLE_HIT */
  CAROM_MARK_SPLIT_HIT = 4,  /* the cue ball met its first two balls less than 1 ms apart. No game
                                here rules on it: the first of them counts */
  CAROM_MARK_LEGAL_BREAK = 8 /* a ball fell, or four object balls met cushions or left the table */
} carom_stroke_mark;

/* The marks of a shot, as a sum of carom_stroke_mark. */
CAROM_API uint32_t carom_stroke_marks(const carom_facts *facts, int cue_ball);

/* A stroke that a plan proposes, and what comes of it. */
typedef struct carom_choice {
  carom_cue cue;        /* raised as little as its stick has to be over cushions and balls,
                           unless `level` */
  double place[2];      /* where the cue ball lies or is put, m. */
  int32_t kind;         /* a carom_plan_kind. */
  int32_t ball;         /* the ball that falls and keeps the turn: by rules with calls the one that
                           falls first without errors, by others the one that does so most often
                           with errors, where half of the strokes with them pot one, else that
                           without errors. -1 if none falls without errors, nor in half of the
                           strokes with them; of a foul -1; CAROM_CALL_PUSH and _PASS of those
                           kinds. So ball and pocket are the call. On a table without pockets it
                           is the ball that is met first. */
  int32_t pocket;       /* and its pocket, or -1. */
  int32_t cushions;     /* impacts of that ball on cushions, of one such stroke. */
  double value;         /* chance to win; without an opponent, the share of the balls that are
                           potted; 0 to 1. A foul counts 0.03 less than what follows it, so that
                           of strokes that are as good a legal one is chosen. The shots by which a
                           plan chose a stroke were lucky for it: of the best one what the layout
                           was worth before counts as 10 shots more, in games that taught chances;
                           each other one, and that of other games, counts 0.75 standard errors
                           less than the mean of its shots, and at most as much as the first. */
  double error;         /* the standard error of that mean. */
  double keep;          /* chance that the player plays on, or wins, with 10 such shots too, */
  double foul, lose;    /* that the shot is a foul, that it loses. */
  int64_t seen;         /* how often the shot was played with errors. 0 of a plan that was stopped
                           before: the value is that of the shot without errors. */
  uint64_t reserved[4]; /* 0. */
} carom_choice;

/* The position for which a plan is made. */
typedef struct carom_plan_job {
  const carom_table *table;
  const carom_shot_ball *balls; /* the layout, at rest. */
  int64_t count;                /* 2 to CAROM_BALLS_MOST. */
  const carom_cue *cue;         /* its ball, masses, tip and miscue; the stroke itself is not
                                   read. */
  const carom_player *player;
  const carom_plan_rules *rules;
  const carom_shot_options *shot;    /* models, space, fast; NULL: the defaults. threads and
                                        when to stop are not read. */
  const carom_plan_options *options; /* NULL: the defaults. */
  void *memory;                      /* room for the plan, aligned as by malloc(), */
  size_t memory_size;                /* of at least carom_plan_memory() bytes. */
  uint64_t reserved[4];              /* must be 0. */
} carom_plan_job;

/* The bytes that a plan with these options needs; some 320,000 for the defaults, and 450,000 more
 * where `unsure` is above 0. NULL: the defaults. 0 for bad options. */
CAROM_API size_t carom_plan_memory(const carom_plan_options *options);

/* The best shots of a layout, best first: up to `room` of them to choices[], the best of each ball,
 * pocket and kind, and *found becomes their number, at least 1.
 *
 * CAROM_OK; CAROM_ERROR_NULL for a pointer that is NULL or too little memory;
 * CAROM_ERROR_OPTIONS for bad options, a bad player or rules without on(), judge() or left();
 * CAROM_ERROR_IN_MOTION for a ball that is not at rest; CAROM_ERROR_GAME_OVER where on() names
 * no ball that is in play; or an error of the layout, as carom_shot_check() has it. With an
 * error nothing is written. The choice depends on the arguments alone, also for any number of
 * threads; unless shot->fast is set it is the same on all machines. */
CAROM_API carom_status carom_plan(const carom_plan_job *job, carom_choice *choices, int room,
                                  int *found);

/* The same with ball in hand: the cue ball goes to the best place found, which all choices have.
 * The place is within low[0] <= x <= high[0] and low[1] <= y <= high[1], m; NULL: no bound on
 * that side. The cue ball of job->balls may be down. Also: CAROM_ERROR_OFF_TABLE where no free
 * place was found. */
CAROM_API carom_status carom_plan_hand(const carom_plan_job *job, const double low[2],
                                       const double high[2], carom_choice *choices, int room,
                                       int *found);

/* Goes on with a plan in slices, for an opponent who thinks between the frames of a game: plays
 * options->slice events more. *found is 0 until the plan has ended; then the choices are those of
 * one call, bit for bit. 500 events take about 1 ms, and a slice somewhat longer where candidates
 * are made or sorted. The job, its memory and all that it points to are those of the call before,
 * unchanged.
 * A plan that has ended stays as it is; one whose options->stop was set ends. CAROM_OK;
 * CAROM_ERROR_NULL as of carom_plan(); CAROM_ERROR_STATE where the memory has no plan of this job.
 *
 *     options.slice = 1000;  // 2 ms
 *     status = carom_plan(&job, best, 5, &found);
 *     while (status == CAROM_OK && found == 0)
 *       status = carom_plan_continue(&job, best, 5, &found);  // a frame
 */
CAROM_API carom_status carom_plan_continue(const carom_plan_job *job, carom_choice *choices,
                                           int room, int *found);

/* The chances of `n` strokes of the caller's, each of which is played options->shots / n times
 * with errors, at least 10 times. choices[k] becomes the estimate of cues[k], in their order. n
 * is 0 to 1000, else CAROM_ERROR_OPTIONS. Of a cue, speed, phi, theta, a and b are read, and the
 * rest is that of job->cue. Statuses as of carom_plan(), and an error of the first bad stroke, with
 * nothing written. */
CAROM_API carom_status carom_plan_try(const carom_plan_job *job, const carom_cue *cues, int n,
                                      carom_choice *choices);

/* The chance that the player at the table wins from the layout, without playing a shot: an
 * estimate, from the rules' value(). in_hand: 1 with ball in hand, else 0. Statuses as of
 * carom_plan(); memory is not needed. */
CAROM_API carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value);

/* ---- Aims ------------------------------------------------------------------------------------ */

/* How many balls and rails an aim may name on its way. */
enum { CAROM_VIA_MOST = 4 };

/* What comes of an aim: of the shot of the whole layout. */
typedef enum carom_pot_is {
  CAROM_POT_FALLS = 0,    /* the ball falls into the pocket */
  CAROM_POT_NO_WAY = 1,   /* no direction of this cue sends the ball to the middle of the mouth by
                            this way; a few may yet make it fall off its middle */
  CAROM_POT_BARRED = 2,   /* a ball on the way meets something else first: `met` */
  CAROM_POT_SHORT = 3,    /* a ball on the way comes to rest: met.a */
  CAROM_POT_REJECTED = 4, /* the jaws send the ball back, at this speed */
  CAROM_POT_STICK = 5     /* theta was NaN, and a stick over cushions and balls is raised by more
                             than 60 degrees, which nobody plays */
} carom_pot_is;

/* A ball and the pocket that it shall fall into. The caller sets the first block, and
 * carom_aim() the second one. */
typedef struct carom_pot {
  int32_t ball, pocket;
  int32_t vias;                   /* elements of via[], 0 to CAROM_VIA_MOST. */
  carom_part via[CAROM_VIA_MOST]; /* balls and rails in the order in which they are met, rails by
                                     the ball before them: those before the first ball by the cue
                                     ball, a kick; those after `ball` by it, a bank. A ball before
                                     `ball` meets it: a combination. Where via[] does not name
                                     `ball`, it comes after the last other ball. A rail stands for
                                     all rails on its line, such as both halves of a long one. */

  int32_t is;            /* a carom_pot_is. */
  double elevation;      /* degrees: the least elevation in the direction cue->phi with which the
                            stick is over the cushions and balls behind the cue ball. A stroke
                            whose cue->theta is less cannot be played. 0 where cue->phi stays. */
  double cut;            /* degrees, of the cue ball on the first ball, which goes to the left of
                            its way where this is above 0. */
  double margin;         /* degrees by which the way of the ball into the pocket may turn, to
                            either jaw; 0 where a jaw is in the way of every direction. */
  double phi[2];         /* directions of the cue, degrees, between which the ball falls; cue->phi
                            is between them. */
  double speed[2];       /* speeds of the cue, m/s, between which it falls in that direction; of
                            0.05 to 15. */
  carom_brief_event met; /* of BARRED and SHORT. */
} carom_pot;

/* Aims a pot: cue->phi becomes the direction in which the ball, by this way, goes to the middle
 * of the pocket's mouth, for the cue's speed, tip and elevation. It is found by shots of the
 * balls on the way, so squirt, swerve, throw and the model of the cushion count. A cue->theta of
 * NaN is left to the stick: it becomes the least elevation with which that is over cushions and
 * balls, and the aim is that of the raised cue. A cut above 80 degrees may be missed. pot->is
 * tells what the other balls and the jaws make of it; where that is CAROM_POT_NO_WAY, cue->phi and
 * cue->theta stay.
 * CAROM_OK; CAROM_ERROR_BALLS for an index or an order of via[] that cannot be; or an error of
 * an argument, with nothing written. One to ten ms. */
CAROM_API carom_status carom_aim(const carom_table *table, const carom_shot_ball *balls, int count,
                                 const carom_shot_options *shot, carom_pot *pot, carom_cue *cue);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_PLAN_H */
