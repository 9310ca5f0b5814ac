/* What other rooms may know of shots: layouts, their checks, a shot without them, its models, and
 * the slate. sim.h is for this room alone, and for tangent/text.h, which differentiates it. */
#ifndef CAROM_SRC_SHOT_SHOT_H
#define CAROM_SRC_SHOT_SHOT_H

#include "motion/path.h"
#include "motion/strike.h"
#include "table/table.h"

/* The balls of a layout, wherever their kinds and states are. */
typedef struct carom_layout {
  const carom_ball_kind *kind;
  const carom_ball_state *state;
  size_t kind_step, state_step; /* bytes from ball to ball */
} carom_layout;

static inline const carom_ball_kind *carom_kind_in(carom_layout layout, int i) {
  const char *at = (const char *)layout.kind + (size_t)i * layout.kind_step;
  return (const carom_ball_kind *)(const void *)at;
}
static inline const carom_ball_state *carom_state_in(carom_layout layout, int i) {
  const char *at = (const char *)layout.state + (size_t)i * layout.state_step;
  return (const carom_ball_state *)(const void *)at;
}
static inline carom_layout carom_layout_of(const carom_shot_ball *balls) {
  const carom_layout layout = {&balls->kind, &balls->state, sizeof *balls, sizeof *balls};
  return layout;
}

/* check.c: the arguments that the shots of a batch share; */
carom_status carom_check_common(const carom_table *table, int64_t count,
                                const carom_shot_options *opt, int *where);
/* what a job needs beside them, and the layout of its shot k; */
carom_status carom_check_job(const carom_shot_job *job);
carom_layout carom_layout_of_row(const carom_shot_job *job, size_t k);
/* one layout, for which this prepares the table, where *features are for other radii; */
carom_status carom_check_layout(const carom_table *table, carom_features *features,
                                carom_layout layout, int count, const carom_shot_options *opt,
                                int *where);
/* the cue of a good layout; NULL: none. */
carom_status carom_check_strike(carom_layout layout, int count, const carom_cue *cue);
/* shoot.c: carom_shoot() with a layout and options that these have found good. */
carom_status carom_shoot_prepared(const carom_table *table, const carom_features *features,
                                  carom_layout layout, int count, const carom_cue *cue,
                                  const carom_shot_options *opt, carom_shot *shot);

/* The models of a shot, where 0 is that of its world. A cushion that was measured goes with the
 * balls that have its numbers. */
static inline carom_ball_model carom_ball_model_of(const carom_shot_options *o) {
  return o->ball_model != CAROM_BALL_MODEL_DEFAULT ? o->ball_model
         : o->world == CAROM_WORLD_POOLTOOL        ? CAROM_BALL_MODEL_INELASTIC
                                                   : CAROM_BALL_MODEL_EXACT;
}
static inline carom_cushion_model carom_cushion_model_of(const carom_shot_options *o,
                                                         const carom_ball_kind *kind) {
  return o->cushion_model != CAROM_SHOT_CUSHION_DEFAULT
             ? (carom_cushion_model)((int)o->cushion_model - 1)
         : o->world == CAROM_WORLD_POOLTOOL ? CAROM_CUSHION_STRONGE
         : kind->smooth_q > 0               ? CAROM_CUSHION_SMOOTH
                                            : CAROM_CUSHION_HAN;
}

/* fixed.c: the restitution of a ball with the slate, from restitution_table of its kind: 0 stands
 * for the default, -1 for none. */
static inline double carom_slate_restitution(double given) {
  return given >= 0.0 ? carom_or_usual(given, 0.5) : 0.0;
}
/* The speed at which a ball that falls at v_n on the slate leaves it, for a restitution e. */
double carom_rebound(double v_n, double e);
/* The ball, with v[2] < 0, falls on the slate or the top of a rail, at the height at which it
 * is. Its label does not change. */
void carom_hit_slate(const carom_ball_kind *kind, carom_ball_state *state);
/* The ball on the slate, with v[2] <= 0 by a blow alone, is pressed for tip_time, s; 0 stands for
 * CAROM_TIP_TIME. Afterwards v[2] >= 0. Returns the speed at which it would leave the slate but
 * for the end of hops. */
double carom_press_on_slate(const carom_ball_kind *kind, double tip_time, carom_ball_state *state);

#endif
