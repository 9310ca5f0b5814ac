/* The state of a search for the best shot: all that its sources share. What they do is in a header
 * of each. A source includes this file, coach.h and the headers before its own, in this order:
 * goals.h, drawn_tables.h, rows.h, prepare.h, ranking.h, choice_kind.h, listing.h, places.h,
 * miss.h, candidates.h, mirrors.h, steer.h, leaves.h, search.h, anytime.h. */
#ifndef CAROM_PLAN_SEARCH_STATE_H
#define CAROM_PLAN_SEARCH_STATE_H

#include "carom_match.h"
#include "coach.h"
#include "platform/clock.h"
#include "platform/threads.h"
#include "shot/shot.h"
#include "view.h"

enum { PLACES_MOST = 24 }; /* of a cue ball in hand, from which strokes are candidates */
enum { ROWS_LEAST = 4 };   /* rows worth a thread */
enum { SCAN_MORE = 1000 }; /* strokes of the scan more on a table without pockets, at most */
enum { LISTED_MOST = 16 }; /* choices behind the best that are played anew */

/* A chance to play on below which balls fall by luck. */
static const double carom_luck = 0.1;

/* The results of shots with errors. */
typedef struct carom_tally {
  double sum, squares;      /* of the worths of the shots, and of their squares */
  double near;              /* sum of how near they were to a goal that is a position */
  int32_t seen;             /* number of shots */
  int32_t keep, foul, lose; /* shots by which the player keeps his turn, fouls, loses */
} carom_tally;

/* How far a shot misses a pocket or a ball; steer.c has the measure. */
typedef struct carom_miss {
  float miss; /* within -1 to 1 where the goal is reached; infinite: none is near; NaN: not known */
  float slope;         /* by the direction of the cue, 1/degree; 0: not known */
  int8_t ball, target; /* of the shot; a pocket, or another ball of the shot */
  int16_t piece;       /* contacts of the ball before the piece of its way */
} carom_miss;

/* A stroke that may be chosen, and the results of its shots. */
typedef struct carom_candidate {
  double r[2];                    /* the position of the cue ball, m */
  double speed, phi, theta, a, b; /* as in carom_cue */
  carom_tally chose;   /* the shots that compare it. Until there is one with errors, that without */
  carom_tally fresh;   /* and those with errors that have chosen nothing */
  int32_t order;       /* when it was added; of two that are as good, the first is chosen */
  int32_t votes;       /* for the pot that is named, where rules have no calls */
  int16_t kind, round; /* a carom_plan_kind; rounds that it was played in */
  int16_t aimed_ball, aimed_pocket;           /* the direct pot that it was aimed at */
  int16_t ball, pocket, cushions;             /* the pot that is named, */
  int16_t pots;                               /* 1: the shot without errors pots a ball: */
  int16_t own_ball, own_pocket, own_cushions; /* this one */
  int16_t seen_kind, seen_ball, seen_pocket;  /* 1 + the kind by which it was seen to make a pot, */
                                              /* 0: not yet; and that pot */
  carom_miss miss; /* of the shot without errors, where it was measured */
  carom_miss lead; /* of a kick: the miss of the first ball with which it is met as it has to be */
  bool turns;      /* it is to be turned before it is played */
  double chance;   /* of the direct pot that it was aimed at */
  float leave[2];  /* of a push-out or a pass that was searched: carom_plan_stroke.leave, */
  float leave_worth, leave_error; /* and what it is worth without a foul, with its error */
} carom_candidate;

/* The result of one shot. */
typedef struct carom_outcome {
  double worth;      /* to the player, 0 to 1 */
  int8_t turn, foul; /* a carom_turn_outcome, KEEP for each good one, or 1 of a pot that was aimed;
                          1: a foul */
  int8_t ball, pocket; /* the pot that keeps the turn, or -1 */
  int16_t cushions;    /* impacts of that ball on cushions */
  int8_t first;        /* the ball that was met first, or -1 */
  uint16_t events;     /* of the shot */
  float near;          /* 1 on the position that is the goal, 0 from 1 m on */
  carom_miss miss;     /* where the stage measures misses */
} carom_outcome;

/* Rows of a stage that measures misses, and the events of each that are kept. */
enum { PATH_ROWS = 32, PATH_EVENTS = 40 };
/* Room for a shot that is measured: a small stack is not enough. */
typedef struct carom_trail {
  carom_event event[PATH_EVENTS];
  carom_ball_state drawn[CAROM_BALLS_MOST];
  carom_facts facts;
  int64_t work; /* of the shots that were measured, in events */
} carom_trail;
/* The miss of a shot of a candidate without errors, which had so many events. */
typedef struct carom_search carom_search;
typedef struct carom_leaves carom_leaves;
typedef carom_miss carom_measurer(const carom_search *search, const carom_candidate *c,
                                  carom_trail *path, int64_t count);

/* A stage plays each of some candidates several times. Row k is the shot of candidate
 * first + k / each, with the errors number k % each of the draws. */
typedef struct carom_stage {
  carom_part_worker *work;
  int64_t first, each, rows;
  int64_t done;            /* rows that have been played */
  uint32_t draws;          /* 0: without errors */
  carom_measurer *measure; /* of misses, in at most PATH_ROWS rows; NULL: none */
} carom_stage;

/* What the search does when all rows of its stage have been played. */
typedef enum carom_search_next {
  NEXT_ENDED,  /* nothing: the best candidate is the first */
  NEXT_AIMED,  /* it plays the pots that could be aimed, once without errors */
  NEXT_TAKEN,  /* it takes them as candidates, and begins the scan */
  NEXT_SCAN,   /* it takes the strokes of a block of the scan, and plays the next block */
  NEXT_STEER,  /* it keeps the strokes that could be steered, and plays them */
  NEXT_PLAYED, /* it takes those */
  NEXT_ROUND,  /* it sorts the candidates of a round with errors, and begins the next round */
  NEXT_TURNED, /* it keeps the strokes near the best that could be turned, and plays them */
  NEXT_NEAR,   /* it takes these into the round */
  NEXT_DUEL,   /* it sorts the few best, which were played against each other */
  NEXT_LOOK,   /* it compares another pot, which was played again, with the best */
  NEXT_LEAVE,  /* it searches the leaves of push-outs and of a pass, */
  NEXT_SEARCH, /* each by its own plan, */
  NEXT_REPLAY, /* it takes the shots of the best that have chosen nothing, */
  NEXT_LIST,   /* it looks for other choices among the candidates, */
  NEXT_LISTED, /* and takes their shots that have chosen nothing */
  NEXT_GENTLE  /* it takes a gentle stroke, the only one */
} carom_search_next;

/* A direct pot that is a candidate. */
typedef struct carom_pot_found {
  carom_way way;
  int ball, pocket;
} carom_pot_found;

/* A position of a cue ball in hand, and the value of the layout with it. */
typedef struct carom_place_in_hand {
  double r[2], value;
} carom_place_in_hand;

/* A table as it may be, if the player does not know it; with the kinds of the balls in play. */
enum { TABLES = 32 };
typedef struct carom_drawn_table {
  carom_table table;
  carom_ball_kind kind[CAROM_BALLS_MOST];
} carom_drawn_table;

enum { LEAVE_SHOTS = 100 }; /* of a plan from a leave */
enum { LEAVES_TRIED = 64 }; /* push-outs whose positions are compared */

/* A push-out or a pass, and the results of its searches. */
typedef struct carom_handed_over {
  carom_candidate c;
  double place[2];       /* where the stroke without errors leaves the cue ball, m */
  double sum[2];         /* of the chances of the opponent and of the player */
  double worth, squares; /* sums of the worths of leaves, and of their squares */
  int count;             /* of leaves that have been searched */
} carom_handed_over;

/* The leaves of a plan: of push-outs; then of the best of them again, and of the pass. */
struct carom_leaves {
  carom_handed_over item[LEAVES_TRIED + 1];
  int count;             /* of items */
  int placed;            /* of them, whose positions are found */
  bool is_spread;        /* the items are those that are searched; */
  bool is_again;         /* they are the best, and the pass */
  int index, draw, side; /* of the next search; side 0: the opponent plays */
  double chance[2];      /* of both sides, at the leave that is searched */
  double best;           /* the mean of the best stroke */
  carom_candidate pass;  /* kind 0: the player may not pass */
  carom_plan_options options;
  carom_plan_rules rules;
  carom_ruling ruling;
  carom_stroke_room room;
};

/* All of a search for a plan. It is in the caller's memory, because shots need most of a small
 * stack. */
struct carom_search {
  carom_crew *crew;   /* the threads that play its shots */
  carom_plan_job job; /* with its own shot and options */
  carom_shot_options shot;
  carom_plan_options options;
  carom_features features; /* of the table, for */
  carom_prepared layout;   /* all balls */
  carom_view view;
  carom_player player;
  uint32_t in_play, targets;                /* balls in play; the ones that may be met first */
  uint32_t permissions;                     /* of the stroke: the bits CAROM_CHOICE_... */
  uint32_t pockets;                         /* that count */
  bool breaks;                              /* the stroke is a break */
  bool blind;                               /* no pot is direct */
  bool only_safeties;                       /* strokes without errors pass the turn, or count not */
  bool first_decides;                       /* a shot ends at a wrong first ball */
  double foul_value;                        /* of a foul at the first contact */
  int32_t left;                             /* balls before the shot */
  carom_candidate *found;                   /* all candidates, the best first after a round */
  carom_outcome *outcome;                   /* of the rows of a stage */
  carom_drawn_table *drawn;                 /* TABLES of them; NULL: the table is known */
  int64_t count, most;                      /* of candidates */
  int64_t room;                             /* of outcomes */
  carom_ball_state state[CAROM_BALLS_MOST]; /* of the layout that is laid out */
  carom_shot_ball hand[CAROM_BALLS_MOST];   /* the layout with the cue ball in hand */
  /* the balls in play, the only ones in shots: their indices, and the set of the balls that are on,
   * by their indices in shots, if the first contact decides */
  carom_shot_ball played[CAROM_BALLS_MOST];
  int32_t plays, layout_ball[CAROM_BALLS_MOST], cue_ball;
  carom_pot_found pot[CAROM_BALLS_MOST * CAROM_POCKETS_MOST];
  carom_brief_event event[128];                    /* of a stroke whose kind is determined */
  carom_place_in_hand best_place[PLACES_MOST + 1]; /* the best first */
  carom_bounds range;                              /* where the cue ball in hand may be put */
  const carom_cue *cues;                           /* `tries` strokes of the caller, */
  carom_plan_stroke *choices;                      /* and the room for their choices */
  int places, tries;                               /* `places` 0: the cue ball is not in hand */
  /* The state of a plan in slices between two calls. */
  uint64_t fingerprint;  /* of the job; 0: no plan */
  carom_crew_caller *go; /* the function that continues with it */
  bool ended;
  bool late;      /* its seconds are over */
  bool joins;     /* `best` is of a round of doubling, and joins the next one */
  int64_t slice;  /* events that this call may still play */
  int64_t first;  /* shots of the next round of doubling, */
  int64_t rest;   /* and of all that have not begun */
  double seconds; /* that are left to it between two calls, */
  double end;     /* and when they are over; 0: never */
  carom_stage stage;
  carom_search_next next;
  int64_t fresh_least;           /* shots of the best that choose nothing, at least */
  int64_t shots;                 /* of all stages, about, */
  double share;                  /* of them that the scan has */
  carom_trail *path;             /* of the rows of a stage that measures misses */
  carom_leaves *leaves;          /* instead of them, after the rounds, */
  carom_search *leave;           /* and the search from the one that is looked at */
  uint32_t deciding;             /* balls of the shot whose ways reach a goal */
  int cushions;                  /* of a point; -1: pots are the goals */
  int steered;                   /* stages of strokes that were steered */
  int64_t scan, scan_end, tried; /* the scan's; where its candidates end; tried so far */
  int64_t better;                /* the candidate that is looked at again */
  int64_t entered;               /* candidates of that round from the one before, */
  int64_t neighbours;            /* and strokes near the best that join it; -1: none yet */
  int round, look, duels;        /* that have begun */
  int place, raced;              /* from which candidates are made; how many positions are tried */
  int choices_most, listed;      /* choices that the caller has room for; that are first */
  carom_plan_stroke listing[LISTED_MOST]; /* the choices of the list while it is made */
  int64_t examined;                       /* candidates that have been checked for the list */
  uint64_t drawn_places;                  /* positions of a cue ball in hand that have been drawn */
  int tried_places;                       /* and the ones that could be tried */
  carom_candidate best;                   /* of the rounds of doubling before */
};

/* plan.c: prepares a job once for all that is played of it: its search, in the job's memory, from
 * which shots can be played. */
carom_status carom_search_prepare(const carom_plan_job *job, bool in_hand, int choices,
                                  carom_search **prepared);
/* Does a part of a search, `work`, with the threads that the options request. */
void carom_search_with_crew(carom_search *search, carom_crew_caller *work);

static inline bool carom_is_stopped(const carom_search *search) {
  return search->late || (search->options.stop != NULL && *search->options.stop != 0);
}

/* Whether the seconds of a plan are over, whose clock runs in its calls. */
static inline bool carom_is_late(const carom_search *search) {
  return search->end > 0.0 && carom_seconds() >= search->end;
}

#endif
