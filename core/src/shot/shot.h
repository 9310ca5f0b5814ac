/* What other rooms may know of shots: layouts, their checks, a shot without them, its models, and
 * the slate. sim.h is only for this folder, and for tangent/text.h, which differentiates it. */
#ifndef CAROM_SRC_SHOT_SHOT_H
#define CAROM_SRC_SHOT_SHOT_H

#include "motion/path.h"
#include "motion/strike.h"
#include "schema/numbers.h"
#include "table/table.h"

/* A layout that has been checked, on its table, with its balls wherever they are. Only
 * carom_prepare() and carom_prepare_row() make one, so its users need not check again. */
typedef struct carom_prepared {
  const carom_table *table;
  const carom_features *features; /* of the table, prepared for the balls */
  const carom_shot_options *opt;
  int count;
  const carom_ball_kind *kind[CAROM_BALLS_MOST];
  const carom_ball_state *state[CAROM_BALLS_MOST];
} carom_prepared;

/* check.c: the arguments that the shots of a batch share; */
carom_status carom_check_common(const carom_table *table, int64_t count,
                                const carom_shot_options *opt, int *where);
/* what a job needs in addition to them; */
carom_status carom_check_job(const carom_shot_job *job);
/* one layout on the table and with the same options, for which this prepares *features, unless
 * they are for its radii; */
carom_status carom_prepare_row(carom_prepared *prepared, carom_features *features, int *where);
/* The last ball of the radius that most balls have, and of such radii of the largest: a table that
 * names no radius is meant for this one. */
int carom_reference_ball(const carom_prepared *prepared);
/* all of it. *where becomes the index of the part or the ball at fault, or -1. */
carom_status carom_prepare(const carom_table *table, const carom_shot_ball *balls, int64_t count,
                           const carom_shot_options *opt, carom_features *features,
                           carom_prepared *prepared, int *where);
/* The cue of a prepared layout; NULL: none. */
carom_status carom_check_strike(const carom_prepared *prepared, const carom_cue *cue);
/* Whether all balls are at rest or out of play, but one (-1: none). */
bool carom_is_at_rest(const carom_prepared *prepared, int but);
/* Balls that are not checked yet: of an array, or of shot k of a job. */
void carom_take_balls(carom_prepared *prepared, const carom_shot_ball *balls, int64_t count);
void carom_take_row(carom_prepared *prepared, const carom_shot_job *job, size_t row);
/* shoot.c: carom_shoot() with a prepared layout. */
carom_status carom_shoot_prepared(const carom_prepared *prepared, const carom_cue *cue,
                                  carom_shot *shot);

/* The number of balls or parts of the table for an event's b; INT64_MAX: b is neither. */
static inline int64_t carom_others_of(const carom_table *table, int count, int type) {
  switch (type) {
  case CAROM_EVENT_BALL_BALL:
    return count;
  case CAROM_EVENT_RAIL:
    return table->rails;
  case CAROM_EVENT_JAW:
    return table->jaws;
  case CAROM_EVENT_POCKET:
    return table->pockets;
  case CAROM_EVENT_RAIL_TOP:
    return table->rails + table->jaws;
  default:
    return INT64_MAX;
  }
}

/* The options of a shot that its caller gave, or those that NULL represents. */
static inline const carom_shot_options *carom_options_or_usual(const carom_shot_options *opt) {
  static carom_shot_options usual; /* all zero; never written: C++ wants no initializer here */
  return opt != NULL ? opt : &usual;
}

/* The last label that a ball may have: in flat play no ball leaves the table. */
static inline int64_t carom_last_label(bool flat) {
  return flat ? CAROM_BALL_POCKETED : CAROM_BALL_OFF;
}

/* How many events of a shot its caller has in full: brief events have no states. */
static inline int64_t carom_events_kept(const carom_shot *shot) {
  if (shot->events == NULL)
    return 0;
  return shot->count < shot->room ? shot->count : shot->room;
}

/* The models of a shot, where 0 is the default of its rules of contact. A cushion that was measured
 * goes with the balls that have its numbers. */
static inline carom_ball_model carom_ball_model_of(const carom_shot_options *options) {
  if (options->ball_model != CAROM_BALL_MODEL_DEFAULT)
    return options->ball_model;
  if (options->world == CAROM_WORLD_POOLTOOL)
    return CAROM_BALL_MODEL_INELASTIC;
  return CAROM_BALL_MODEL_EXACT;
}
static inline carom_cushion_model carom_cushion_model_of(const carom_shot_options *options,
                                                         const carom_ball_kind *kind) {
  if (options->cushion_model != CAROM_SHOT_CUSHION_DEFAULT)
    return (carom_cushion_model)((int)options->cushion_model - 1);
  if (options->world == CAROM_WORLD_POOLTOOL)
    return CAROM_CUSHION_STRONGE;
  return kind->smooth_q > 0 ? CAROM_CUSHION_SMOOTH : CAROM_CUSHION_HAN;
}

/* slate.c: the restitution of a ball with the slate, from restitution_table of its kind: 0 means
 * the default, -1 none. */
static inline double carom_slate_restitution(double value) {
  return value >= 0.0 ? carom_or_usual(value, CAROM_USUAL_RESTITUTION_TABLE) : 0.0;
}
/* The speed at which a ball that falls at v_n on the slate leaves it, for a restitution e. */
double carom_rebound(double v_n, double restitution);
/* The ball, with v[2] < 0, falls on the slate or the top of a rail, at the height at which it
 * is. Its label does not change. */
void carom_hit_slate(const carom_ball_kind *kind, carom_ball_state *state);

/* What a raised cue leaves behind its strike. */
typedef struct carom_raised {
  double impulse;  /* of the tip, N s */
  double V, lead;  /* of the cue: speed, m/s; of its tip, m: cluster/places.c */
  double second;   /* closing speed of the second touch, m/s */
  double leaves;   /* the speed at which the slate lets the ball go, but for the end of hops */
  int touches;     /* of the tip */
  unsigned course; /* a hash of the phases: which ended, and by what */
} carom_raised;

/* raised.c: a raised cue, cue->tip_time >= 0, strikes a ball at rest on the slate that nothing else
 * touches. *state has the motion by only the strike, carom_strike_motion() in space, and gets the
 * motion after it. Returns false where that takes too many steps; *state is as it was then. */
bool carom_push_alone(const carom_ball_kind *kind, const carom_cue *cue, carom_ball_state *state,
                      carom_raised *out);

#endif
