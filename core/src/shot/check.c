/* The only place where the arguments of a shot are checked, by the conditions of the comments in
 * carom_shot.h: the table and the options once for a batch; a layout, its cue, and whether the
 * table suits the radius of its balls, for each. */
#include "cushion/list.h"
#include "cushion/models.h"
#include "friction/laws.h"
#include "motion/strike.h"
#include "schema/options.h"
#include "shot/rules.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static bool is_flat(const carom_shot_options *options) {
  return carom_rules_of(options->world)->flat || options->space == CAROM_SPACE_FLAT;
}

carom_status carom_check_shot_options(const carom_shot_options *o) {
  CAROM_SHOT_OPTIONS(CAROM_CHECK_OPTION)
  return carom_ok_if(o->unused == 0 && CAROM_RESERVED_IS_ZERO(o), CAROM_ERROR_SHOT_OPTIONS);
}

int carom_reference_ball(const carom_prepared *prepared) {
  int best = prepared->count - 1, most = 0;
  for (int index = prepared->count - 1; index >= 0; index--) {
    const double radius = prepared->kind[index]->radius;
    int alike = 0;
    for (int partner = 0; partner < prepared->count; partner++)
      alike += prepared->kind[partner]->radius == radius;
    const bool larger = radius > prepared->kind[best]->radius;
    if (alike > most || (alike == most && larger)) {
      best = index;
      most = alike;
    }
  }
  return best;
}

/* Prepares the table for the balls of a layout. In flat play all radii must be equal to the
 * first. */
static carom_status prepare_table(const carom_prepared *prepared, bool flat,
                                  carom_features *features, int *where) {
  double least = prepared->kind[0]->radius, greatest = least;
  int radii = prepared->count;
  if (flat)
    radii = 1;
  for (*where = 0; *where < radii; ++*where) {
    const double radius = prepared->kind[*where]->radius;
    if (!carom_is_positive(radius))
      return CAROM_ERROR_RADIUS;
    least = carom_lesser(least, radius);
    greatest = carom_greater(greatest, radius);
  }
  double reference = least;
  if (!flat && least != greatest)
    reference = prepared->kind[carom_reference_ball(prepared)]->radius;
  if (!flat)
    reference = carom_reference_of(prepared->table, reference);
  return carom_prepare_table(prepared->table, least, greatest, reference, features, where);
}

static carom_status check_kind(const carom_ball_kind *k) {
  CAROM_NUMBERS(CAROM_CHECK_NUMBER, CAROM_CHECK_NUMBER)
  CAROM_CONDITIONS(CAROM_CHECK_CONDITION, CAROM_CHECK_CONDITION)
  return CAROM_OK;
}

static bool bounded(const double x[3], double most) {
  return fabs(x[0]) <= most && fabs(x[1]) <= most && fabs(x[2]) <= most;
}

static carom_status check_state(const carom_ball_state *state, double radius, bool flat) {
  if (state->label < CAROM_BALL_STATIONARY || state->label > carom_last_label(flat))
    return CAROM_ERROR_LABEL;
  if (!bounded(state->r, 1e6))
    return CAROM_ERROR_POSITION;
  if (!bounded(state->v, 1e4))
    return CAROM_ERROR_VELOCITY;
  if (!bounded(state->w, 1e6))
    return CAROM_ERROR_SPIN;
  if (carom_is_out(state->label))
    return CAROM_OK;
  if (!flat)
    return carom_ok_if(state->r[2] - radius >= -CAROM_MOST_OVERLAP, CAROM_ERROR_OFF_TABLE);
  if (state->v[2] != 0.0)
    return CAROM_ERROR_VERTICAL;
  return carom_ok_if(fabs(state->r[2] - radius) <= CAROM_MOST_OVERLAP, CAROM_ERROR_OFF_TABLE);
}

carom_status carom_check_ball(const carom_shot_ball *ball, bool flat) {
  const carom_status status = check_kind(&ball->kind);
  if (status != CAROM_OK)
    return status;
  return check_state(&ball->state, ball->kind.radius, flat);
}

/* The height of a ball's centre above the cloth as the shot takes it: a ball on the cloth is at
 * z = R. */
static inline double height_of(const carom_ball_state *state, double radius) {
  return carom_flies_in_layout(state, radius) ? state->r[2] : radius;
}

/* Whether a ball at r, of a radius, overlaps another in play of radius R_other, which is at height
 * z. */
static inline bool overlaps(const double r[3], double radius, const carom_ball_state *neighbor,
                            double R_other, double z) {
  const double along[3] = {r[0] - neighbor->r[0], r[1] - neighbor->r[1], r[2] - z};
  const double reach = radius + R_other - CAROM_MOST_BALL_OVERLAP;
  return !carom_is_out(neighbor->label) && carom_space_dot(along, along) < reach * reach;
}

carom_status carom_check_strike(const carom_prepared *prepared, const carom_cue *cue) {
  if (cue == NULL || cue->speed == 0.0)
    return CAROM_OK;
  if (cue->ball < 0 || cue->ball >= prepared->count)
    return CAROM_ERROR_CUE_BALL;
  if (prepared->opt->first_of >> prepared->count != 0)
    return CAROM_ERROR_SHOT_OPTIONS;
  if (carom_is_out(prepared->state[(int)cue->ball]->label))
    return CAROM_ERROR_CUE_BALL_OUT;
  return carom_check_cue(cue);
}

bool carom_is_at_rest(const carom_prepared *prepared, int but) {
  bool rests = true;
  for (int index = 0; index < prepared->count; index++) {
    carom_ball_state state = *prepared->state[index];
    const int64_t label = carom_label_of_layout(&state, prepared->kind[index]->radius);
    rests &= index == but || label == CAROM_BALL_STATIONARY || carom_is_out(label);
  }
  return rests;
}

carom_status carom_check_common(const carom_table *table, int64_t count,
                                const carom_shot_options *opt, int *where) {
  *where = -1;
  const carom_status status = carom_check_shot_options(opt);
  if (status != CAROM_OK)
    return status;
  if (count < 1 || count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;
  return carom_check_table(table, where);
}

carom_status carom_check_room(const carom_shot *shot) {
  const bool good =
      shot->room == 0 || (shot->room > 0 && (shot->events != NULL || shot->brief != NULL));
  return carom_ok_if(good, CAROM_ERROR_ROOM);
}

carom_status carom_check_job(const carom_shot_job *job) {
  const bool by_reference = job->kinds != NULL && job->states != NULL;
  if (job->table == NULL || job->shots == NULL || (job->balls == NULL && !by_reference))
    return CAROM_ERROR_NULL;
  const bool unused = job->balls != NULL && (job->kinds != NULL || job->states != NULL);
  return carom_ok_if(!unused && CAROM_RESERVED_IS_ZERO(job), CAROM_ERROR_SHOT_OPTIONS);
}

void carom_take_balls(carom_prepared *prepared, const carom_shot_ball *balls, int64_t count) {
  prepared->count = (int)count;
  for (int index = 0; index < count && index < CAROM_BALLS_MOST; index++) {
    prepared->kind[index] = &balls[index].kind;
    prepared->state[index] = &balls[index].state;
  }
}

void carom_take_row(carom_prepared *prepared, const carom_shot_job *job, size_t row) {
  const size_t first = row * (size_t)job->ball_stride;
  if (job->balls != NULL)
    carom_take_balls(prepared, job->balls + first, job->count);
  prepared->count = (int)job->count;
  for (int i = 0; i < prepared->count && job->balls == NULL; i++) {
    prepared->kind[i] = &job->kinds[i];
    prepared->state[i] = &job->states[first + (size_t)i];
  }
}

/* What the rules of contact and the options require of the balls of a row. */
typedef struct row_rules {
  bool flat, one_mass;
} row_rules;

/* A ball by itself, next to the first one, and for the table. */
static carom_status check_alone(const carom_prepared *prepared, const row_rules *rules, int index) {
  const carom_ball_kind *kind = prepared->kind[index], *first = prepared->kind[0];
  /* most balls are of the kind of the one before, which is good */
  const bool known = index > 0 && memcmp(kind, prepared->kind[index - 1], sizeof *kind) == 0;
  if (!known) {
    const carom_status status = check_kind(kind);
    if (status != CAROM_OK)
      return status;
    const double x = prepared->table->slope_x, y = prepared->table->slope_y,
                 grip = carom_lesser(kind->mu_roll, kind->mu_slide);
    if (x * x + y * y >= grip * grip)
      return CAROM_ERROR_SLOPE;
  }
  if (rules->flat && kind->radius != first->radius)
    return CAROM_ERROR_RADII_DIFFER;
  if (kind->nose_height >= 2.0 * prepared->features->reference)
    return CAROM_ERROR_BALL_CUSHION;
  if (rules->one_mass && kind->mass != first->mass)
    return CAROM_ERROR_MASSES_DIFFER;
  return check_state(prepared->state[index], kind->radius, rules->flat);
}

/* Where a ball is: on the table or above it, and next to the balls before it, whose centres have
 * these heights. */
static carom_status check_position(const carom_prepared *prepared, int index,
                                   const double *height) {
  const carom_ball_kind *kind = prepared->kind[index];
  const carom_ball_state *state = prepared->state[index];
  const bool flies = carom_flies_in_layout(state, kind->radius);
  if (flies && !carom_is_above_table(prepared->table, prepared->features, kind, state->r))
    return CAROM_ERROR_OFF_TABLE;
  if (!flies && !carom_stands_on_table(prepared->table, prepared->features, kind, state->r))
    return CAROM_ERROR_OFF_TABLE;
  const double centre[3] = {state->r[0], state->r[1], height[index]};
  for (int earlier = 0; earlier < index; earlier++)
    if (overlaps(centre, kind->radius, prepared->state[earlier], prepared->kind[earlier]->radius,
                 height[earlier]))
      return CAROM_ERROR_OVERLAP;
  return CAROM_OK;
}

carom_status carom_prepare_row(carom_prepared *prepared, carom_features *features, int *where) {
  const row_rules rules = {.flat = is_flat(prepared->opt),
                           .one_mass = carom_rules_of(prepared->opt->world)->one_mass ||
                                       prepared->opt->ball_model == CAROM_BALL_MODEL_INELASTIC};
  prepared->features = features;
  carom_status status = prepare_table(prepared, rules.flat, features, where);
  if (status != CAROM_OK)
    return status;

  double height[CAROM_BALLS_MOST];
  for (int index = 0; index < prepared->count; index++) {
    *where = index;
    status = check_alone(prepared, &rules, index);
    height[index] = height_of(prepared->state[index], prepared->kind[index]->radius);
    if (status == CAROM_OK && !carom_is_out(prepared->state[index]->label))
      status = check_position(prepared, index, height);
    if (status != CAROM_OK)
      return status;
  }
  *where = -1;
  return CAROM_OK;
}

carom_status carom_prepare(const carom_table *table, const carom_shot_ball *balls, int64_t count,
                           const carom_shot_options *opt, carom_features *features,
                           carom_prepared *prepared, int *where) {
  const carom_status status = carom_check_common(table, count, opt, where);
  if (status != CAROM_OK)
    return status;
  prepared->table = table;
  prepared->opt = opt;
  carom_take_balls(prepared, balls, count);
  features->radius = 0.0; /* of nothing yet */
  return carom_prepare_row(prepared, features, where);
}

carom_status carom_shot_check(const carom_table *table, const carom_shot_ball *balls, int count,
                              const carom_cue *cue, const carom_shot_options *opt, int *where) {
  carom_features features;
  carom_prepared prepared;
  int unused;
  if (where == NULL)
    where = &unused;
  *where = -1;
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status =
      carom_prepare(table, balls, count, carom_options_or_usual(opt), &features, &prepared, where);
  if (status != CAROM_OK)
    return status;
  return carom_check_strike(&prepared, cue);
}

carom_status carom_place_ball(const carom_table *table, carom_shot_ball *balls, int count, int ball,
                              double x, double y, carom_part *in_the_way) {
  carom_part unused;
  if (in_the_way == NULL)
    in_the_way = &unused;
  *in_the_way = (carom_part){CAROM_PART_NONE, 0};
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  if (count < 1 || count > CAROM_BALLS_MOST || ball < 0 || ball >= count)
    return CAROM_ERROR_BALLS;
  carom_features features;
  carom_prepared layout;
  carom_take_balls(&layout, balls, count);
  const carom_ball_kind *kind = &balls[ball].kind;
  const double R = kind->radius, r[3] = {x, y, R},
               usual = balls[carom_reference_ball(&layout)].kind.radius;
  const carom_status checked = carom_check_parts(table, R, usual, &features, in_the_way);
  if (checked != CAROM_OK)
    return checked;
  if (!bounded(r, 1e6))
    return CAROM_ERROR_POSITION;
  if (!carom_stands_on_table(table, &features, kind, r)) {
    carom_ground ground;
    carom_ground_of(table, &features, kind, &ground);
    *in_the_way = carom_part_there(&ground, r);
    return CAROM_ERROR_OFF_TABLE;
  }
  for (int index = 0; index < count; index++) {
    const double radius = balls[index].kind.radius, z = height_of(&balls[index].state, radius);
    if (index != ball && overlaps(r, R, &balls[index].state, radius, z)) {
      *in_the_way = (carom_part){CAROM_PART_BALL, index};
      return CAROM_ERROR_OVERLAP;
    }
  }
  balls[ball].state = (carom_ball_state){.r = {x, y, R}, .label = CAROM_BALL_STATIONARY};
  return CAROM_OK;
}

/* The law whose numbers a law reads. */
static const int numbers_of_law[] = {
#define OF(NAME, name, of, ...) [CAROM_LAW_##NAME] = CAROM_LAW_##of,
    CAROM_FRICTION_LAWS(OF)
#undef OF
};

int carom_number_is_read(const carom_number *number, const carom_ball_kind *kind,
                         const carom_shot_options *opt) {
  opt = carom_options_or_usual(opt);
  if (number == NULL || kind == NULL)
    return 0;
  if (number->reader == CAROM_READ_BY_CUSHION)
    return number->model == (int)carom_cushion_model_of(opt, kind);
  if (number->reader == CAROM_READ_BY_FRICTION)
    return (unsigned)opt->friction < CAROM_LAW_COUNT &&
           number->model == numbers_of_law[opt->friction] &&
           opt->ball_model != CAROM_BALL_MODEL_MIRROR;
  return 1;
}
