/* A search for the best shot on its way, which the parts of a plan share: rows.c plays shots,
 * candidates.c makes strokes, search.c chooses. */
#ifndef CAROM_SRC_PLAN_SEARCH_H
#define CAROM_SRC_PLAN_SEARCH_H

#include "plan/view.h"
#include "platform/threads.h"
#include "shot/shot.h"

/* Stages of draws. */
enum { DRAW_STROKES = 1, DRAW_SCAN, DRAW_PLACES, DRAW_BREAKS = 5, DRAW_TABLES, DRAW_ROUND = 16 };
enum { PLACES_PLANNED = 6 }; /* of a cue ball in hand */
enum { ROWS_LEAST = 4 };     /* rows worth a thread */

typedef struct carom_candidate {
  double speed, phi, theta, a, b;
  double sum, squares; /* of its worth, over `seen` shots with errors; at first of the one
                          without */
  int64_t seen;
  int64_t keep, foul, lose; /* how often */
  int32_t order;
  int32_t votes; /* for the pot that is named, of rules without calls */
  int16_t kind, round;
  int16_t aimed_ball, aimed_pocket; /* of a direct pot */
  int16_t ball, pocket, cushions;   /* of the pot that is named, */
  int16_t pots;                     /* and whether there is one without errors: */
  int16_t own_ball, own_pocket, own_cushions;
} carom_candidate;

/* Of a row. */
typedef struct carom_outcome {
  double worth;
  int8_t is, foul, ball, pocket;
  int16_t cushions;
  int8_t first, unused;
} carom_outcome;

/* The rows of a stage: row k is of candidate first + k / each, with the errors of k % each. So many
 * are `done`. */
typedef struct carom_stage {
  carom_part_worker *work;
  int64_t first, each, rows, done;
  uint32_t draws; /* 0: without errors */
} carom_stage;

/* What comes when the rows of the stage are done. */
typedef enum carom_search_next {
  NEXT_ENDED, /* nothing: the best candidate is the first */
  NEXT_AIMED, /* those that can be aimed are played, */
  NEXT_TAKEN, /* and taken, and strokes in all directions tried, */
  NEXT_SCAN,  /* in blocks; */
  NEXT_ROUND, /* rounds with errors, */
  NEXT_NEAR,  /* in one of which strokes near the best join; */
  NEXT_LOOK,  /* and a look at those that might be better */
  NEXT_GENTLE /* or the only stroke that is left */
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
  uint32_t in_play, on, may, pockets;
  bool breaks;                              /* the stroke is a break */
  bool first_decides;                       /* a shot ends at a wrong first ball */
  double foul_value;                        /* of a foul at the first contact */
  int32_t left;                             /* balls before the shot */
  carom_candidate *found;                   /* all candidates, the best first after a round */
  carom_outcome *outcome;                   /* of the rows of a stage */
  carom_drawn_table *drawn;                 /* TABLES of them; NULL: the table is known */
  int64_t count, most;                      /* of candidates */
  int64_t room;                             /* of outcomes */
  carom_ball_state state[CAROM_BALLS_MOST]; /* of the layout */
  carom_shot_ball hand[CAROM_BALLS_MOST];   /* the layout with the cue ball in hand */
  /* the balls in play, which alone take part in shots: which they are, and their set in shots
   * of the balls that are on, where the first contact decides */
  carom_shot_ball played[CAROM_BALLS_MOST];
  int32_t plays, which[CAROM_BALLS_MOST], cue_ball;
  carom_pot_found pot[CAROM_BALLS_MOST * CAROM_POCKETS_MOST];
  carom_brief_event event[128];                       /* of a stroke whose kind is asked */
  carom_place_in_hand best_place[PLACES_PLANNED + 1]; /* the best first */
  const carom_cue *cues;                              /* that the caller gave, `tries` of them, */
  carom_choice *choices;                              /* and where he wants what they are worth */
  int places, tries;
  /* how far it is: between two calls all of it is here */
  uint64_t of;           /* fingerprint of the job; 0: no plan */
  carom_crew_caller *go; /* what goes on with it */
  bool ended;
  int64_t slice; /* rows that this call may still play */
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

static inline double carom_within(double x, double least, double most) {
  return x < least ? least : x > most ? most : x;
}
static inline bool carom_is_stopped(const carom_search *of) {
  return of->options.stop != NULL && *of->options.stop != 0;
}

/* rows.c: the balls in play of a layout become those of shots. */
void carom_search_lay_out(carom_search *of, const carom_shot_ball *balls);
/* The next stage: candidates from the one of index `first` on, `each` times with the errors of
 * these draws; 0: without errors. */
void carom_search_stage(carom_search *of, int64_t first, int64_t candidates, int64_t each,
                        uint32_t draws);
/* Plays rows of the stage, whose outcomes come in their order. Returns whether that is done: all
 * are played, or those before the plan was stopped, at least one; false where the slice has
 * ended. */
bool carom_search_play(carom_search *of);
/* The stroke of a candidate, with the errors of a row; draws 0: without errors. */
carom_cue carom_search_stroke(const carom_search *of, const carom_candidate *c, uint32_t draws,
                              int64_t row);
/* unsure.c: draws the tables, into the caller's memory. */
void carom_search_tables(carom_search *of, carom_drawn_table *room);
/* The balls in play on the table of a row. */
carom_prepared carom_search_layout(const carom_search *of, uint32_t draws, int64_t row);
/* Whether a stroke of the scan met a ball first that is on. */
bool carom_search_begins_well(const carom_search *of, int first);
/* What a foul that is worth `worth` counts. Values of layouts are right to some hundredths, and a
 * legal stroke that is as good is to be chosen. */
static inline double carom_search_foul(double worth) {
  const double less = 0.03;
  return worth > less ? worth - less : 0.0;
}
/* Points as a share of the balls left before the shot. */
double carom_search_share(const carom_search *of, double points);

/* candidates.c: direct pots, up to `most` of them, with the stage that aims them; of these, those
 * that can be aimed. */
void carom_search_pots(carom_search *of, int64_t most);
void carom_search_aimed(carom_search *of);
/* The next block of strokes in all directions, with its stage; false where they are enough. Of
 * those that were played, the ones that are candidates. */
bool carom_search_scan(carom_search *of);
void carom_search_scanned(carom_search *of);
void carom_search_near(carom_search *of, int64_t parents);
void carom_search_breaks(carom_search *of, int64_t most); /* in place of both */
void carom_search_add(carom_search *of, carom_candidate c);

/* search.c: what the shot without errors says of candidate k. The best of those that were taken is
 * the first, whenever a plan is stopped. */
void carom_search_take(carom_search *of, int64_t k, const carom_outcome *o);
/* All stages with so many shots: begins them, and goes on. Returns whether the end is reached; the
 * best candidate is the first then. */
void carom_search_begin(carom_search *of, int64_t shots);
bool carom_search_run(carom_search *of);
/* Not to play, as one more candidate. */
void carom_search_pass(carom_search *of);
/* Adds up what the candidates of a round are worth. Of a round that was stopped, those count that
 * were played so often; or any rows of the only one. */
void carom_search_add_up(carom_search *of);
/* kinds.c: the carom_plan_kind of a choice, by what happens. */
int32_t carom_search_kind(carom_search *of, const carom_candidate *c, const carom_choice *choice);

carom_choice carom_search_choice(const carom_search *of, const carom_candidate *c);
/* The share of the shots that the scan has. */
double carom_scan_of(const carom_plan_options *o);

#endif
