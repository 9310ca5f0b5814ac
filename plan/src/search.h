/* The search for the best shot: its state, and what its sources do for each other. Each calls only
 * those that stand before it: drawn_tables.c, rows.c (plays shots), ranking.c (compares
 * candidates), choice_kind.c, candidates.c (makes strokes), search.c (the stages), plan.c. */
#ifndef CAROM_PLAN_SEARCH_H
#define CAROM_PLAN_SEARCH_H

#include "platform/clock.h"
#include "platform/threads.h"
#include "shot/shot.h"
#include "view.h"

/* Stages of draws. */
enum { DRAW_STROKES = 1, DRAW_SCAN, DRAW_PLACES, DRAW_BREAKS = 5, DRAW_TABLES, DRAW_ROUND = 16 };
enum { PLACES_PLANNED = 6 }; /* of a cue ball in hand */
enum { ROWS_LEAST = 4 };     /* rows worth a thread */

/* A stroke that may be chosen, and what its shots have told. `sum`, `squares`, `keep`, `foul`,
 * `lose` and `seen` count the shots with errors. Until there is one, they hold the shot without. */
typedef struct carom_candidate {
  double speed, phi, theta, a, b; /* as in carom_cue */
  double sum, squares;            /* of the worths of its shots, and of their squares */
  int64_t seen;                   /* number of shots */
  int64_t keep, foul, lose;       /* shots by which the player keeps his turn, fouls, loses */
  int32_t order;       /* when it was added; of two that are as good, the first is chosen */
  int32_t votes;       /* for the pot that is named, where rules have no calls */
  int16_t kind, round; /* a carom_plan_kind; rounds that it was played in */
  int16_t aimed_ball, aimed_pocket;           /* the direct pot that it was aimed at */
  int16_t ball, pocket, cushions;             /* the pot that is named, */
  int16_t pots;                               /* 1: the shot without errors pots a ball: */
  int16_t own_ball, own_pocket, own_cushions; /* this one */
} carom_candidate;

/* What one shot tells. */
typedef struct carom_outcome {
  double worth;        /* to the player, 0 to 1 */
  int8_t is, foul;     /* a carom_turn_is; 1: a foul */
  int8_t ball, pocket; /* the pot that keeps the turn, or -1 */
  int16_t cushions;    /* impacts of that ball on cushions */
  int8_t first;        /* the ball that was met first, or -1 */
  uint8_t events;      /* of the shot, at most 255 */
} carom_outcome;

/* A stage plays each of some candidates several times. Row k is the shot of candidate
 * first + k / each, with the errors number k % each of the draws. */
typedef struct carom_stage {
  carom_part_worker *work;
  int64_t first, each, rows;
  int64_t done;   /* rows that have been played */
  uint32_t draws; /* 0: without errors */
} carom_stage;

/* What the search does when all rows of its stage have been played. */
typedef enum carom_search_next {
  NEXT_ENDED, /* nothing: the best candidate is the first */
  NEXT_AIMED, /* it plays the pots that could be aimed, once without errors */
  NEXT_TAKEN, /* it takes them as candidates, and begins the scan */
  NEXT_SCAN,  /* it takes the strokes of a block of the scan, and plays the next block */
  NEXT_ROUND, /* it sorts the candidates of a round with errors, and begins the next round */
  NEXT_NEAR,  /* it takes strokes near the best one into the round */
  NEXT_LOOK,  /* it compares another pot, which was played again, with the best */
  NEXT_GENTLE /* it ends: a gentle stroke is the only one */
} carom_search_next;

/* A direct pot that is a candidate. */
typedef struct carom_pot_found {
  carom_way way;
  int ball, pocket;
} carom_pot_found;

/* A place of a cue ball in hand, and the value of the layout with it. */
typedef struct carom_place_in_hand {
  double r[2], value;
} carom_place_in_hand;

/* A table as it may be, where the player does not know it; the kinds are those of the balls in
 * play. */
enum { TABLES = 32 };
typedef struct carom_drawn_table {
  carom_table table;
  carom_ball_kind kind[CAROM_BALLS_MOST];
} carom_drawn_table;

/* All of a plan. It is in the caller's memory, since shots need most of a small stack. */
typedef struct carom_search {
  carom_crew *crew;   /* the threads that play its shots */
  carom_plan_job job; /* with shot and options of its own */
  carom_shot_options shot;
  carom_plan_options options;
  carom_features features; /* of the table, for */
  carom_prepared layout;   /* all balls */
  carom_view view;
  carom_player player;
  uint32_t in_play, on;                     /* balls in play; those of them that may be met first */
  uint32_t permissions;                     /* of the stroke: the bits CAROM_MAY_... */
  uint32_t pockets;                         /* that count */
  bool breaks;                              /* the stroke is a break */
  bool blind;                               /* no pot is direct */
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
  /* the balls in play, which alone take part in shots: which they are, and their set in shots
   * of the balls that are on, where the first contact decides */
  carom_shot_ball played[CAROM_BALLS_MOST];
  int32_t plays, which[CAROM_BALLS_MOST], cue_ball;
  carom_pot_found pot[CAROM_BALLS_MOST * CAROM_POCKETS_MOST];
  carom_brief_event event[128];                       /* of a stroke whose kind is asked */
  carom_place_in_hand best_place[PLACES_PLANNED + 1]; /* the best first */
  const carom_cue *cues;                              /* `tries` strokes of the caller, */
  carom_choice *choices;                              /* and the room for their choices */
  int places, tries;
  /* The state of a plan in slices between two calls. */
  uint64_t fingerprint;  /* of the job; 0: no plan */
  carom_crew_caller *go; /* the function that goes on with it */
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
  int64_t shots;                  /* of all stages, about, */
  int64_t scan, scan_end, tried;  /* those of the scan; where its candidates end; tried so far */
  int64_t better;                 /* the candidate that is looked at again */
  int64_t entered;                /* candidates of that round from the one before, */
  int64_t near;                   /* and strokes near the best that join it; -1: none yet */
  int round, look, place, chosen; /* of places in hand: on its way, the best */
  carom_candidate best;           /* and the stroke from there */
} carom_search;

static inline bool carom_is_stopped(const carom_search *plan) {
  return plan->late || (plan->options.stop != NULL && *plan->options.stop != 0);
}

/* Whether the seconds of a plan are over, whose clock runs in its calls. */
static inline bool carom_is_late(const carom_search *plan) {
  return plan->end > 0.0 && carom_seconds() >= plan->end;
}

/* drawn_tables.c: draws the tables, into the caller's memory. */
void carom_search_tables(carom_search *plan, carom_drawn_table *room);
/* The balls in play on the table of a row. */
carom_prepared carom_search_layout(const carom_search *plan, uint32_t draws, int64_t row);

/* rows.c: takes the balls in play of a layout as those of shots. */
void carom_search_lay_out(carom_search *plan, const carom_shot_ball *balls);
/* Sets the next stage: candidates from the one of index `first` on, `each` times with the errors of
 * these draws; 0: without errors. */
void carom_search_stage(carom_search *plan, int64_t first, int64_t candidates, int64_t each,
                        uint32_t draws);
/* Plays rows of the stage, whose outcomes come in their order. Returns whether the stage is done:
 * all rows are played, or those before the plan was stopped, at least one. It is not done where the
 * slice has ended. */
bool carom_search_play(carom_search *plan);
/* The stroke of a candidate, with the errors of a row; draws 0: without errors. */
carom_cue carom_search_stroke(const carom_search *plan, const carom_candidate *c, uint32_t draws,
                              int64_t row);
/* Whether a stroke of the scan met a ball first that is on. */
bool carom_search_begins_well(const carom_search *plan, int first);
/* What a foul counts that is worth `worth`. Values of layouts are right to some hundredths, and a
 * legal stroke that is as good is to be chosen. */
static inline double carom_search_foul(double worth) {
  const double less = 0.03;
  return worth > less ? worth - less : 0.0;
}
/* Points as a share of the balls left before the shot. */
double carom_search_share(const carom_search *plan, double points);

/* ranking.c: gives candidate k the outcome of its shot without errors. The best of those that have
 * one is always the first, so that a plan can be stopped at any time. */
void carom_search_take(carom_search *plan, int64_t k, const carom_outcome *o);
/* Adds the outcomes of a round to its candidates. Of a round that was stopped, those count that
 * were played `each` times; of a round of one candidate all its rows. */
void carom_search_add_up(carom_search *plan);
/* Puts candidate k first if it is better than the first; sorts the first n. */
void carom_search_lead(carom_search *plan, int64_t k);
void carom_search_sort(const carom_search *plan, int64_t n);

/* choice_kind.c: the carom_plan_kind of a choice, by what happens. */
int32_t carom_search_kind(carom_search *plan, const carom_candidate *c, const carom_choice *choice);

/* candidates.c: makes direct pots, up to `most` of them, with the stage that aims them; keeps those
 * that could be aimed. */
void carom_search_pots(carom_search *plan, int64_t most);
void carom_search_aimed(carom_search *plan);
/* Makes the next block of strokes in all directions, with its stage; false where they are enough.
 * Takes those that were played and begin without a foul. */
bool carom_search_scan(carom_search *plan);
void carom_search_scanned(carom_search *plan);
/* Makes strokes near the best `parents`; strokes of a break, in place of pots and scan. */
void carom_search_near(carom_search *plan, int64_t parents);
void carom_search_breaks(carom_search *plan, int64_t most);
void carom_search_add(carom_search *plan, carom_candidate c);

/* search.c: begins all stages with so many shots, and goes on with them. Returns whether the end is
 * reached, where the best candidate is the first. */
void carom_search_begin(carom_search *plan, int64_t shots);
bool carom_search_run(carom_search *plan);
/* Adds the choice not to play as one more candidate. */
void carom_search_pass(carom_search *plan);
carom_choice carom_search_choice(const carom_search *plan, const carom_candidate *c);
/* The share of the shots that the scan has. */
double carom_scan_of(const carom_plan_options *o);

/* anytime.c: whether a plan doubles, as it may be stopped. Begins one of so many shots: at once,
 * or by rounds, of which the first has `first`. Ends a round: true if the next one has begun; else
 * the best so far is the first, and plan->best. */
bool carom_search_doubles(const carom_search *plan);
void carom_search_begin_doubling(carom_search *plan, int64_t first, int64_t shots);
bool carom_search_double(carom_search *plan);

#endif
