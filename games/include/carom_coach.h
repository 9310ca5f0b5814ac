/* carom_coach.h: advice for a player: every way to pot, to score or to reach a position; why a
 * stroke of a plan is good, and what it leaves; a run-out planned in one call; the results of many
 * breaks of a rack; reviews of the strokes of a match, and drills for them; and the odds of a
 * match.
 *
 *     carom_player player = carom_player_fargo(550.0);
 *     static carom_shot_way ways[1000];
 *     carom_ways_job job = {.table = &table, .balls = balls, .count = 16, .player = &player};
 *     job.cues = &cue;  // a stroke, which is tried in all directions
 *     job.strokes = 1;
 *     job.scan = 1800;
 *     job.ball = job.pocket = -1;  // any
 *     job.rails = 2;
 *     job.memory_size = carom_ways_memory(1000);
 *     job.memory = malloc(job.memory_size);
 *     carom_ways_result result;
 *     // ways[0].cue is the stroke with the best chance, ways[0].chance
 *     carom_status status = carom_ways(&job, ways, 1000, &result);
 *
 * Units, axes and statuses are as in carom.h, carom_shot.h and carom_plan.h. Nothing here allocates
 * or prints either. docs/using/plan.md shows the same functions of the command. */
#ifndef CAROM_COACH_H
#define CAROM_COACH_H

#include "carom_plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Ways ------------------------------------------------------------------------------------ */

/* Reports the progress of a call: `done` of `total` of a stage, "strokes" or "ways". */
typedef void carom_coach_progress(void *context, const char *stage, double done, double total);

/* What a way is for. */
typedef enum carom_way_goal {
  CAROM_WAY_POT = 0,   /* a ball falls, and the cue ball does not */
  CAROM_WAY_SCORE = 1, /* the cue ball meets three cushions before the second ball */
  CAROM_WAY_PLACE = 2  /* the cue ball stops at a position */
} carom_way_goal;

enum {
  CAROM_WAY_PARTS = 12,  /* the largest number of rails and balls of a way. */
  CAROM_WAY_EVENTS = 300 /* the largest number of events of a shot whose way is read. */
};

/* A way: the rails and balls that are met, in their order, and the best stroke for it. */
typedef struct carom_shot_way {
  carom_cue cue;                    /* the stroke: one of the job's cues, in the best direction. */
  carom_part part[CAROM_WAY_PARTS]; /* the rails and balls that are met, in their order. */
  double cut;       /* degrees: the cut of the cue ball on its first ball, as in carom_pot; NaN if
                       it meets no ball. */
  double phi[2];    /* degrees: the directions between which the stroke succeeds. */
  double speed[2];  /* m/s: the speeds of the cue between which a pot succeeds in this direction,
                       within 0.05 to 15. */
  double chance;    /* fraction of 400 strokes with the errors of the player that succeed, 0 to
                       1. */
  double error;     /* the standard error of `chance`. */
  int64_t found;    /* how many of the strokes in all directions took this way. */
  int32_t kind;     /* a carom_plan_kind; -1 unless the goal is a pot. */
  int32_t ball;     /* the ball that falls; -1 unless the goal is a pot. */
  int32_t pocket;   /* the pocket of that ball, or -1. */
  int32_t parts;    /* number of elements of part[]. */
  int32_t stroke;   /* index of its stroke among the job's cues. */
  int32_t reserved; /* 0. */
} carom_shot_way;

/* The job of a search for ways. The caller sets all members except the ones that may be NULL or
 * 0. */
typedef struct carom_ways_job {
  const carom_table *table;     /* the table. */
  const carom_shot_ball *balls; /* the layout, at rest. */
  int64_t count;                /* number of balls, 1 to CAROM_BALLS_MOST. */
  const carom_cue *cues;        /* strokes of one ball, each of which is tried in all directions. */
  int64_t strokes;              /* number of strokes, at least 1. */
  const carom_player *player;   /* the player with whose errors the chances are computed. */
  const carom_shot_options *shot; /* models, space, fast and threads; NULL: the defaults. */
  int64_t scan;                   /* number of directions of all strokes together, at least one for
                                     each stroke. 1800 for one stroke are steps of 0.2 degrees. For
                                     pots of one ball, and where no way was found, each stroke has
                                     at least 18000. */
  int32_t goal;                   /* a carom_way_goal. */
  int32_t ball;                   /* for pots: the ball, or -1 for any. */
  int32_t pocket;                 /* for pots: the pocket, or -1 for any. */
  int32_t rails;                  /* for pots and positions: the largest number of rails. */
  int32_t each;     /* 1: a pot has one way for each stroke that makes it, in the order of the
                       strokes; 0: only the stroke with the best chance. */
  int32_t reserved; /* must be 0. */
  double place[2];  /* m: where the cue ball must stop, for all goals. */
  double radius;    /* m: the largest distance to that position; 0: anywhere. */
  carom_coach_progress *progress; /* NULL: nothing is reported. */
  void *context;                  /* of progress(). */
  void *memory;                   /* room for the search, aligned as by malloc(). */
  size_t memory_size;             /* bytes of `memory`, at least carom_ways_memory(). */
} carom_ways_job;

/* Counts of a search. */
typedef struct carom_ways_result {
  int64_t ways;     /* number of ways that were written. */
  int64_t scanned;  /* strokes that were played in all directions. */
  int64_t good;     /* strokes that succeeded, by all ways together. */
  int64_t left_out; /* strokes that succeeded, but were left out for lack of room: for a way, for
                       its parts, or for the events of the shot. */
} carom_ways_result;

/* The number of bytes that a search for up to `room` ways needs. 0 if room is below 1. */
CAROM_API size_t carom_ways_memory(int64_t room);

/* Finds the ways to the goal, and writes up to `room` of them to ways[]: the best chance first, and
 * for equal chances the widest range of directions first. With `each` 1 they are in the order of
 * the strokes. A pot whose directions are less than 0.02 degrees apart is left out. Returns
 * CAROM_OK; CAROM_ERROR_NULL if a pointer is NULL or there is too little memory;
 * CAROM_ERROR_OPTIONS for a number out of its range, an invalid player, or cues of different balls;
 * or an error of carom_shoot(), with *result up to that point of the search, which is 0 if it did
 * not begin. The ways depend only on the arguments, not on the number of threads. */
CAROM_API carom_status carom_ways(const carom_ways_job *job, carom_shot_way *ways, int64_t room,
                                  carom_ways_result *result);

/* Plays a way's stroke 400 times with the errors of the player, including those of the eye, and
 * sets way->chance and way->error. The caller may change way->cue first. Statuses are as for
 * carom_ways(). */
CAROM_API carom_status carom_way_chance(const carom_ways_job *job, carom_shot_way *way);

/* 1 if a shot reaches the goal: it pots way->ball into way->pocket, scores, or brings the cue ball
 * to the position; the cue ball stays on the table; and there is no double hit. Otherwise 0. The
 * shot has facts and final states. */
CAROM_API int carom_way_succeeds(const carom_ways_job *job, const carom_shot *shot,
                                 const carom_shot_way *way);

/* ---- Reasons --------------------------------------------------------------------------------- */

enum {
  CAROM_WHY_STROKES = 300, /* strokes with errors that are played for a choice. */
  CAROM_WHY_RAILS = 16,    /* the largest number of rails that carom_why lists. */
  CAROM_WHY_ERRORS = 4     /* values of carom_why_error. */
};

/* The kinds of errors of a player, for the value that a stroke loses by each. */
typedef enum carom_why_error {
  CAROM_WHY_AIM = 0,   /* of direction and elevation */
  CAROM_WHY_SPEED = 1, /* of speed */
  CAROM_WHY_TIP = 2,   /* of the contact point of the tip */
  CAROM_WHY_EYE = 3    /* of the positions of balls as the player sees them */
} carom_why_error;

/* Why a choice of a plan is good. */
typedef struct carom_why {
  int32_t rails;                 /* number of cushions that the cue ball meets before any ball. */
  int32_t rail[CAROM_WHY_RAILS]; /* the rails of these cushions. */
  double contact[CAROM_WHY_RAILS][2]; /* m: the positions of the cue ball there. */
  int32_t first;                      /* the ball that the cue ball meets first; -1: none. */
  double cut;                         /* degrees: the cut on that ball, above 0 to its left, as in
                                         carom_pot; NaN: no ball is met. */
  double part;                        /* the fraction of that ball that is hit, 0 to 1; NaN: no ball
                                         is met. */
  double speed;                       /* m/s: of the cue ball, just after the stroke. */
  carom_ruling ruling; /* what the stroke leaves without errors. If carom_names_ball() is 0, the
                          stroke has errors, and its leave is about the mean of the strokes that
                          pass the turn. */
  double leave; /* the value of that leave to the player who strikes; NaN for a goal of the job. */
  carom_plan_stroke next; /* the best stroke of the player who plays next. */
  int32_t has_next;       /* 1 if `next` has a stroke, otherwise 0. */
  double value;           /* of the choice, as carom_plan_replay() finds it. */
  double misses, loses;   /* fractions of the strokes with errors that pass the turn, and that lose
                             the game. */
  double opponent;        /* the opponent's chance to win after the strokes that pass the turn; NaN
                             if none does, without an opponent, and for a goal. */
  double flawless_value;  /* of the choice without errors of the player. */
  double cost[CAROM_WHY_ERRORS]; /* value lost by each carom_why_error: the mean of its loss when it
                                    is added after the preceding kinds and after the following
                                    kinds. The sum is flawless_value - value. Below 0: the error
                                    helps, for example if the stroke without errors leaves the
                                    opponent more than most others. */
  int64_t strokes;               /* CAROM_WHY_STROKES. */
} carom_why;

/* Explains a choice of a plan: how it is aimed, what it leaves, how often it misses and how much
 * value the errors of the player lose. All values use the plan's own estimate of what a stroke
 * leaves. The job is the one of the plan; its memory is overwritten. Returns CAROM_OK;
 * CAROM_ERROR_OPTIONS for a choice to pass, which has no stroke; or an error of carom_plan() or
 * carom_place_ball(). */
CAROM_API carom_status carom_why_of(const carom_plan_job *job, const carom_plan_stroke *choice,
                                    carom_why *why);

/* 1 if the ball that a choice names is intended to fall; 0 if the choice names no ball, or if that
 * ball falls by luck: the player plays on in less than a tenth of the strokes. */
CAROM_API int carom_names_ball(const carom_plan_stroke *choice);

/* Plays n choices of a plan CAROM_WHY_STROKES times each, with the same errors for all, and sorts
 * them by the values of these strokes, best first. value, error, keep, foul, lose and seen are set
 * from these strokes. A choice to pass keeps its value. The chances of a plan are partly lucky for
 * choices that were seldom played; these chances are not. Returns CAROM_OK; CAROM_ERROR_OPTIONS if
 * n is below 0; or an error of carom_plan() or carom_place_ball(), with the preceding choices
 * sorted. */
CAROM_API carom_status carom_plan_replay(const carom_plan_job *job, carom_plan_stroke *choices,
                                         int n);

/* ---- Run-outs -------------------------------------------------------------------------------- */

enum {
  CAROM_ZONE_CORNERS = 36,   /* corners of a landing zone. */
  CAROM_SEQUENCE_MOST = 36,  /* the largest number of strokes of a run-out. */
  CAROM_SEQUENCE_TRIES = 100 /* strokes with errors that are played for each of them. */
};

/* A stroke of a run-out, from the layout that the preceding stroke leaves without errors. */
typedef struct carom_sequence_stroke {
  carom_plan_stroke choice; /* the stroke; its value is the chance to run out from its layout. */
  carom_ruling ruling;      /* what the stroke leaves without errors. If it then misses, this is
                               the first stroke with errors that plays on. */
  double leave_value;       /* the value of that layout, an estimate for which no shot is played; 1
                               if the game is won. */
  double zone[CAROM_ZONE_CORNERS][2]; /* m: the corners of the landing zone, a polygon around the
                                         cue ball of `ruling`. It contains the positions along
                                         straight lines from there for which leave_value falls by at
                                         most `within`. All corners coincide if the turn ends or the
                                         cue ball is in hand. */
  double speed[2], phi[2];            /* m/s, degrees: the speeds and the directions of the cue
                                         between which the stroke plays on and the cue ball rests in
                                         the zone, with everything else as in choice.cue. */
  double zone_share;  /* fraction of CAROM_SEQUENCE_TRIES strokes with errors that win, or that play
                         on with the cue ball in the zone. */
  double stray_share; /* fraction that plays on with the cue ball outside. */
  double turn_share;  /* fraction of a sample of these strays from which a plan pots turn_ball. */
  int32_t turn_ball, turn_pocket; /* the ball and the pocket of the most frequent pot from strays
                                     that is not the pot of the next stroke; -1: none. */
} carom_sequence_stroke;

/* Counts of played run-outs. All zero before the first one. */
typedef struct carom_sequence_counts {
  int64_t plays, runs; /* number of run-outs that were played, and that won the game or potted all
                          balls. */
  int64_t strokes;     /* number of all their strokes that played on or won. */
} carom_sequence_counts;

/* The number of bytes that run-outs with these options need. 0 for bad options. */
CAROM_API size_t carom_sequence_memory(const carom_plan_options *options);

/* Plans a run-out of the player at the table, as with options->chance_opponent 1: stroke by stroke,
 * each from what the preceding stroke leaves without errors. Writes up to `room` strokes, at most
 * CAROM_SEQUENCE_MOST; *found becomes their number. The last one wins, or is the first after which
 * the player hardly ever plays on. in_hand: 1 if the cue ball is in hand before the first stroke,
 * within the bounds of job->leave. within: how much value the landing zones may lose, above 0 and
 * below 1. A stroke takes about as long as two plans and eight more of at most 200 shots. If
 * options->stop is set, the run-out ends with the stroke that is being planned. If options->slice
 * is above 0, the call returns after about that many events of shots with *found 0, for
 * carom_sequence_continue(). Returns CAROM_OK; CAROM_ERROR_NULL if a pointer is NULL or there is
 * less memory than carom_sequence_memory(); CAROM_ERROR_OPTIONS for `within` out of range, a goal,
 * or options->safeties; or an error of carom_plan() for the first layout. With an error *found is
 * 0. */
CAROM_API carom_status carom_sequence(const carom_plan_job *job, int in_hand, double within,
                                      carom_sequence_stroke *strokes, int room, int *found);

/* Continues a run-out in slices, as carom_plan_continue() continues a plan: *found is 0 until the
 * run-out has ended. Until then strokes[] of carom_sequence() is in use; at the end it has the bits
 * of one call. Returns CAROM_OK; CAROM_ERROR_NULL as in carom_sequence(); CAROM_ERROR_STATE if the
 * memory has no run-out of this job; or an error of carom_plan() for the first layout. */
CAROM_API carom_status carom_sequence_continue(const carom_plan_job *job, int *found);

/* Plays the run-outs with the numbers `first` to first + n - 1 from the layout, and adds their
 * results to *counts. Before each stroke, the player plans the run-out again from the current
 * layout, with options->shots; the stroke has the errors of the player. The ratio runs / plays is
 * the chance of the run-out for a player who plans with that many shots. The errors depend on
 * options->seed and the number. Statuses are as for carom_sequence(). */
CAROM_API carom_status carom_sequence_play(const carom_plan_job *job, int in_hand, int64_t first,
                                           int64_t n, carom_sequence_counts *counts);

/* ---- Breaks ---------------------------------------------------------------------------------- */

/* How a break is aimed. */
typedef enum carom_break_aim {
  CAROM_BREAK_FULL = 0,      /* at the middle of the ball in front */
  CAROM_BREAK_DIRECTION = 1, /* the direction is cue->phi */
  CAROM_BREAK_CUT = 2        /* as far off the middle of the ball in front as cue->phi is in the
                                layout of the job */
} carom_break_aim;

/* Breaks of one stroke. */
typedef struct carom_break_job {
  const carom_table *table;       /* the table. */
  const carom_shot_ball *balls;   /* the rack, with the cue ball as ball 0: the position of the cue
                                     ball, and the kinds of all balls, are read. */
  int64_t count;                  /* number of balls: carom_rack_size(). */
  const carom_cue *cue;           /* the stroke. */
  const carom_player *player;     /* the player with whose errors each stroke is played. */
  const carom_player *opponent;   /* NULL: an opponent with the same errors. */
  const carom_shot_options *shot; /* NULL: the defaults. */
  int32_t rack;                   /* a carom_rack_kind. */
  int32_t aim;                    /* a carom_break_aim. */
  double gap;                     /* m: between the balls, as in carom_rack(). */
  uint64_t seed;                  /* of the first rack, and of the errors. */
  void *memory;                   /* room for the shots, aligned as by malloc(). */
  size_t memory_size;             /* bytes of `memory`, at least carom_break_memory(). */
} carom_break_job;

/* Results of breaks, as counts or sums. All zero before the first one. */
typedef struct carom_break_counts {
  int64_t breaks;                                     /* number of breaks that were played. */
  int64_t makes, balls;                               /* number of breaks that pot a ball; number of
                                                         balls that fell altogether. */
  int64_t plays_on, fouls;                            /* number of breaks after which the player
                                                         plays on, and of fouls, by the rules of the
                                                         rack's game; 0 for a rack whose game has no
                                                         break. */
  int64_t scratches, off, wing;                       /* number of breaks in which the cue ball
                                                         falls, a ball leaves the table, a ball at a
                                                         wing falls. */
  int64_t stays;                                      /* number of breaks in which the cue ball
                                                         stays on the table. */
  int64_t fell[CAROM_BALLS_MOST][CAROM_POCKETS_MOST]; /* how often each ball fell into each
                                                         pocket. */
  double wins, win_squares;                           /* sums of the chances to win from the layout
                                                         that each break leaves, and of their
                                                         squares; 0 without rules. */
  double x, y, squares;                               /* m, m^2: sums over the cue balls that stay
                                                         on the table: of their positions, and of
                                                         x^2 + y^2. */
} carom_break_counts;

/* The number of bytes that carom_break_play() needs. */
CAROM_API size_t carom_break_memory(void);

/* The rack and the stroke of break `number`, from 0 on, with the errors of the player; for number
 * -1 the first rack, and the stroke without errors. Writes job->count balls, and *cue. Returns
 * CAROM_OK, CAROM_ERROR_NULL, or an error of carom_rack(). */
CAROM_API carom_status carom_break_stroke(const carom_break_job *job, int64_t number,
                                          carom_shot_ball *balls, carom_cue *cue);

/* Plays the breaks with the numbers `first` to first + n - 1, and adds their results to *counts.
 * Each break has its own rack and errors. Returns CAROM_OK; CAROM_ERROR_NULL if a pointer is NULL
 * or there is too little memory; CAROM_ERROR_OPTIONS for a number out of its range; or an error of
 * carom_rack() or carom_shoot(). */
CAROM_API carom_status carom_break_play(const carom_break_job *job, int64_t first, int64_t n,
                                        carom_break_counts *counts);

/* 1 if the rack belongs to a game with a break, by whose rules breaks are judged, otherwise 0. */
CAROM_API int carom_break_has_rules(carom_rack_kind rack);

/* Writes the mean position of the cue balls that stay on the table, m, and returns the standard
 * deviation of their positions, m; all NaN if none stays. If a pointer is NULL, the call returns
 * NaN. */
CAROM_API double carom_break_spread(const carom_break_counts *counts, double place[2]);

enum {
  CAROM_BREAK_CHOICES = 8
}; /* The largest number of breaks that carom_break_best()
                                     returns. */

/* A break that a search proposes. */
typedef struct carom_break_choice {
  carom_cue cue;             /* the stroke, with its direction in the layout of the job. */
  double place[2];           /* m: the position of the cue ball. */
  int32_t aim;               /* a carom_break_aim. */
  int32_t reserved;          /* 0. */
  carom_break_counts counts; /* the results of further breaks, which were not used to choose. */
  double speed_cost, aim_cost, tip_cost; /* how much more often the first choice would win without
                                            the player's errors of speed, of direction and
                                            elevation, and of the tip; NaN for the other choices. */
  double cost; /* how much more often it would win without all these errors. */
} carom_break_choice;

/* Finds the breaks that win most often for the player: the position of the cue ball behind the head
 * string, the speed, at most the speed of the job, the height of the tip, and a cut of up to half
 * of the ball in front. 64 strokes, one of which is the stroke of the job, are compared with the
 * same racks and errors, in rounds each of which keeps the better half. Writes the `room` best to
 * choices[], the best first, with the results of `breaks` further breaks of each. Statuses are as
 * for carom_break_play(); CAROM_ERROR_OPTIONS also for fewer than 16 breaks, for room that is not 1
 * to CAROM_BREAK_CHOICES, and for a rack whose game has no break. */
CAROM_API carom_status carom_break_best(const carom_break_job *job, int64_t breaks,
                                        carom_break_choice *choices, int room);

/* ---- Practice -------------------------------------------------------------------------------- */

/* Kinds of strokes that are practised together. A pot is straight below a cut of 15 degrees and
 * thin above 45, and long if both paths together are longer than 1.2 m. */
typedef enum carom_practice {
  CAROM_PRACTICE_STRAIGHT = 0,      /* short straight pots */
  CAROM_PRACTICE_CUT = 1,           /* short cuts */
  CAROM_PRACTICE_THIN = 2,          /* short thin cuts */
  CAROM_PRACTICE_LONG_STRAIGHT = 3, /* long straight pots */
  CAROM_PRACTICE_LONG_CUT = 4,      /* long cuts */
  CAROM_PRACTICE_LONG_THIN = 5,     /* long thin cuts */
  CAROM_PRACTICE_INDIRECT = 6,      /* a ball was called, or the turn kept, but no direct pot is
                                       possible */
  CAROM_PRACTICE_OTHER = 7          /* safeties, and strokes that aim at no pocket */
} carom_practice;

/* The intention of a stroke of a match, and its result. */
typedef struct carom_review {
  carom_cue aim;      /* the intended stroke: the stroke that was played, but aimed at the middle of
                         the pocket. */
  double off;         /* degrees: how far to the left of that direction the stroke was played; NaN
                         for INDIRECT and OTHER, as are cut, distance and told. */
  double cut;         /* degrees: the cut, as in carom_pot. */
  double distance;    /* m: the length of both paths, of the cue ball to the ball and of the ball to
                         the pocket. */
  double told;        /* chance that the intended stroke keeps the turn. */
  double value, came; /* chance to win with the intended stroke, and after the played one. */
  double miss_cost, place_cost; /* the loss value - came, split into the loss by the miss (negative:
                                   the gain by the pot) and the loss by the positions of the balls.
                                   The means are 0 for a player with the errors of the job. 0 for
                                   INDIRECT and OTHER. */
  int32_t group;                /* a carom_practice. */
  int32_t ball, pocket;         /* the intended ball and pocket, or -1. */
  int32_t kept;                 /* 1: the stroke kept the turn or won. */
} carom_review;

/* Reviews a stroke of a game of two sides with pockets. The job has the layout, the rules with
 * their state and the player before it, and options->seed and options->opponent; it needs no
 * memory. `call` is the call of the match; it is read in games with calls. In other games the ball
 * is the one that was met first, and the pocket the one whose aim is nearest, within 10 degrees.
 * Returns CAROM_OK; CAROM_ERROR_NULL; CAROM_ERROR_OPTIONS for an invalid player, and for other
 * games; or an error of carom_shot_check(). */
CAROM_API carom_status carom_review_of(const carom_plan_job *job, const carom_cue *played,
                                       carom_call call, carom_review *review);

/* A layout to practise a stroke. */
typedef struct carom_drill {
  carom_cue aim;   /* the stroke without errors. */
  double place[2]; /* m: where this stroke leaves the cue ball. */
  double radius;   /* m: the largest distance of the cue ball from there, which half of the player's
                      pots reach; 0 if only the pot is practised. */
  double rating;   /* the rating whose errors make the drill in half of the tries, 200 to 850. */
  int32_t ball, pocket; /* the ball that has to fall, and its pocket. */
} carom_drill;

/* Makes a drill from a reviewed stroke, with the same job, whose layout it uses. The position is
 * practised if it lost more than the miss. Statuses are as for carom_review_of();
 * CAROM_ERROR_OPTIONS if the stroke aimed at no pocket directly. */
CAROM_API carom_status carom_drill_of(const carom_plan_job *job, const carom_review *review,
                                      carom_drill *drill);

/* ---- Odds ------------------------------------------------------------------------------------ */

/* The largest number of games of a set, and of sets of a match, that a side may need. */
enum { CAROM_SERIES_MOST = 100 };

/* A match of two rated sides. A game goes to the first side with the odds 2^((r0 - r1)/100) : 1. */
typedef struct carom_series {
  double rating[2];    /* Fargo ratings of both sides, 0 to 1000. */
  double break_points; /* how many rating points stronger a side is in a game that it breaks, -1000
                          to 1000. 0: the break is no advantage. */
  int32_t games[2];    /* how many games each side needs to win a set, 1 to CAROM_SERIES_MOST. */
  int32_t sets[2];     /* how many sets each side needs to win the match, 1 to CAROM_SERIES_MOST;
                          0: one. */
  int32_t order;       /* who breaks within a set: a carom_break_order. The sides begin the sets
                          alternately. */
  int32_t side;        /* which side breaks first, 0 or 1; -1: drawn by lot. */
} carom_series;

/* The chances of a match. The chances of the second side are 1 minus these. */
typedef struct carom_odds {
  double game;  /* that the first side wins a game in which nobody has the break. */
  double set;   /* that it wins the first set. */
  double match; /* that it wins the match. */
  double games; /* the mean number of games of the match. */
  double score[2][CAROM_SERIES_MOST]; /* score[s][k]: the chance that side s wins while the other
                                         has k sets; if one set decides, k games. */
} carom_odds;

/* The odds of a match. Returns CAROM_OK; CAROM_ERROR_NULL; or CAROM_ERROR_OPTIONS for a number out
 * of its range. */
CAROM_API carom_status carom_odds_of(const carom_series *match, carom_odds *odds);

/* The match with the fairest handicap: the stronger side needs the larger of match->games, and the
 * weaker side the number that brings the chance to win the match nearest to a half. Statuses are as
 * for carom_odds_of(). */
CAROM_API carom_status carom_fair_series(const carom_series *match, carom_series *fair);

#ifdef __cplusplus
}
#endif

#endif /* CAROM_COACH_H */
