/* The one place where the arguments of a shot are checked, by the conditions of the comments in carom_shot.h: what is common to
 * a batch once; a layout, its cue, and whether the table suits the radius of its balls, for each. */
#include "shot/rules.h"

#include <math.h>
#include <stddef.h>

static const double most_overlap = 1e-6; /* m */

static bool positive(double x) {
  return x > 0.0 && x < INFINITY;
}
static bool unit_interval(double x) {
  return x >= 0.0 && x <= 1.0;
}
static bool friction(double x) {
  return x > 0.0 && x <= 1.0;
}
static bool zero_or_positive(double x) {
  return x >= 0.0 && x < INFINITY;
}
static bool is_flat(const carom_shot_options *o) {
  return carom_rules_of(o->world)->flat || o->space == CAROM_SPACE_FLAT;
}

carom_status carom_check_shot_options(const carom_shot_options *o) {
  bool reserved = false;
  for (size_t k = 0; k < sizeof o->reserved / sizeof o->reserved[0]; k++)
    reserved |= o->reserved[k] != 0;
  /* enumerations may be signed or not; a number below 0 is a large one here */
  const bool good = (uint32_t)o->world <= CAROM_WORLD_POOLTOOL && (uint32_t)o->ball_model <= CAROM_BALL_MODEL_MIRROR &&
                    (uint32_t)o->cushion_model <= CAROM_SHOT_CUSHION_EULER &&
                    (uint32_t)o->friction <= CAROM_FRICTION_CONSTANT && (uint32_t)o->space <= CAROM_SPACE_FLAT &&
                    o->events_most >= 0 && (o->plain & ~1) == 0 && (uint32_t)o->simultaneous <= CAROM_SIMULTANEOUS_PAIRS &&
                    (uint32_t)o->cluster_steps <= 10000 && o->unused == 0 && !reserved && o->time_most >= 0.0 &&
                    o->time_most < INFINITY && o->stop_at >> CAROM_DUE_PIECE == 0;
  if (!good)
    return CAROM_ERROR_SHOT_OPTIONS;
  if (o->steps < 0)
    return CAROM_ERROR_STEPS;
  return o->threads >= 0 || o->threads == CAROM_ALL_THREADS ? CAROM_OK : CAROM_ERROR_THREADS;
}

/* 0 where all are finite, else NaN. The parts of a table are checked for each shot that is played alone, so without a branch
 * for each number. */
static inline double zero_if_finite(const double *x, int n) {
  double sum = 0.0;
  for (int k = 0; k < n; k++)
    sum += 0.0 * x[k];
  return sum;
}

static inline bool good_rail(const carom_rail *r) {
  const double x = r->q[0] - r->p[0], y = r->q[1] - r->p[1];
  return zero_if_finite(r->p, 2) + zero_if_finite(r->line, 3) == 0.0 && positive(x * x + y * y) && (uint64_t)r->side <= 1 &&
         unit_interval(r->mu_cushion) && unit_interval(r->restitution);
}
static inline bool good_circle(const double centre[2], double radius, double least) {
  return zero_if_finite(centre, 2) == 0.0 && radius >= least && radius < INFINITY;
}

static inline bool good_jaw(const carom_jaw *j) {
  return good_circle(j->centre, j->radius, 0.0) && unit_interval(j->mu_cushion) && unit_interval(j->restitution);
}
/* Every nose is above the cloth and below the top of a ball. */
static bool good_height(double height, double R) {
  return height > 0.0 && height < 2.0 * R;
}

/* What is wrong, and where. */
static carom_status at(int *where, int index, carom_status status) {
  *where = index;
  return status;
}

static carom_status check_table(const carom_table *t, int *where) {
  *where = -1;
  if (t->rails < 0 || t->rails > CAROM_RAILS_MOST || t->jaws < 0 || t->jaws > CAROM_JAWS_MOST || t->pockets < 0 ||
      t->pockets > CAROM_POCKETS_MOST || t->rails + t->jaws < 1)
    return CAROM_ERROR_TABLE;
  if (!zero_or_positive(t->ball_radius) || !zero_or_positive(t->rail_width) || !zero_or_positive(t->pocket_back))
    return CAROM_ERROR_TABLE;
  for (int k = 0; k < t->rails; k++)
    if (!good_rail(&t->rail[k]))
      return at(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->jaws; k++)
    if (!good_jaw(&t->jaw[k]))
      return at(where, k, CAROM_ERROR_TABLE);
  for (int k = 0; k < t->pockets; k++)
    if (!good_circle(t->pocket[k].centre, t->pocket[k].radius, 1e-9) || !isfinite(t->pocket[k].depth))
      return at(where, k, CAROM_ERROR_TABLE);
  return CAROM_OK;
}

/* Prepares the table, which is meant for balls of the radius `reference`, for those from a least to a greatest radius, unless
 * that has been done. */
static carom_status prepare(const carom_table *t, double least, double greatest, double reference, carom_features *features,
                            int *where) {
  if (features->radius == greatest && features->least == least && features->reference == reference)
    return CAROM_OK;
  const double lowest = carom_lesser(least, reference);
  for (int k = 0; k < t->rails; k++)
    if (!good_height(t->rail[k].height, lowest))
      return at(where, k, CAROM_ERROR_NOSE_HEIGHT);
  for (int k = 0; k < t->jaws; k++)
    if (!good_height(t->jaw[k].height, lowest))
      return at(where, k, CAROM_ERROR_NOSE_HEIGHT);
  carom_features_of(t, greatest, reference, features);
  features->least = least;
  return CAROM_OK;
}

static double reference_of(const carom_table *t, double usual) {
  return t->ball_radius > 0.0 ? t->ball_radius : usual;
}

/* The same for the balls of a layout. In flat play all radii are to be that of the first. */
static carom_status prepare_for(const carom_table *t, const carom_shot_ball *balls, int count, bool flat,
                                carom_features *features, int *where) {
  double least = balls[0].kind.radius, greatest = least;
  for (*where = 0; *where < (flat ? 1 : count); ++*where) {
    const double R = balls[*where].kind.radius;
    if (!positive(R))
      return CAROM_ERROR_RADIUS;
    least = carom_lesser(least, R);
    greatest = carom_greater(greatest, R);
  }
  const double reference = flat ? least : reference_of(t, balls[count - 1].kind.radius);
  return prepare(t, least, greatest, reference, features, where);
}

static carom_status check_kind(const carom_ball_kind *k) {
  if (!positive(k->mass))
    return CAROM_ERROR_MASS;
  if (!positive(k->radius))
    return CAROM_ERROR_RADIUS;
  if (!friction(k->mu_slide) || !friction(k->mu_roll) || !friction(k->mu_spin))
    return CAROM_ERROR_MU_MOTION;
  if (!unit_interval(k->drag))
    return CAROM_ERROR_DRAG;
  if (!unit_interval(k->mu_ball) || !(k->law_a >= 0.0 && k->law_b >= 0.0 && k->law_a + k->law_b <= 1.0) ||
      !(k->law_c >= 0.0 && k->law_c < INFINITY))
    return CAROM_ERROR_MU_BALL;
  const bool slate = k->restitution_table == -1.0 || (k->restitution_table >= 0.0 && k->restitution_table <= 0.98);
  if (!unit_interval(k->restitution) || !unit_interval(k->restitution_cushion) || !slate)
    return CAROM_ERROR_RESTITUTION;
  if (!unit_interval(k->mu_cushion))
    return CAROM_ERROR_MU_CUSHION;
  const bool ratio = k->omega_ratio == 0.0 || (k->omega_ratio > 1.0 && k->omega_ratio < 2.0);
  if (!unit_interval(k->roll_loss) || !(k->nose_height >= 0.0 && k->nose_height < 2.0 * k->radius) || !ratio)
    return CAROM_ERROR_BALL_CUSHION;
  if (!(k->modulus == 0.0 || (k->modulus >= 1e6 && k->modulus <= 1e15)))
    return CAROM_ERROR_MODULUS;
  return positive(k->gravity) ? CAROM_OK : CAROM_ERROR_GRAVITY;
}

static bool bounded(const double x[3], double most) {
  return fabs(x[0]) <= most && fabs(x[1]) <= most && fabs(x[2]) <= most;
}

static carom_status check_state(const carom_ball_state *s, double R, bool flat) {
  if (s->label < CAROM_BALL_STATIONARY || s->label > (flat ? CAROM_BALL_POCKETED : CAROM_BALL_OFF))
    return CAROM_ERROR_LABEL;
  if (!bounded(s->r, 1e6))
    return CAROM_ERROR_POSITION;
  if (!bounded(s->v, 1e4))
    return CAROM_ERROR_VELOCITY;
  if (!bounded(s->w, 1e6))
    return CAROM_ERROR_SPIN;
  if (carom_is_out(s->label))
    return CAROM_OK;
  if (!flat)
    return s->r[2] - R >= -most_overlap ? CAROM_OK : CAROM_ERROR_OFF_TABLE;
  if (s->v[2] != 0.0)
    return CAROM_ERROR_VERTICAL;
  return fabs(s->r[2] - R) <= most_overlap ? CAROM_OK : CAROM_ERROR_OFF_TABLE;
}

carom_status carom_check_ball(const carom_shot_ball *ball, bool flat) {
  const carom_status bad = check_kind(&ball->kind);
  return bad != CAROM_OK ? bad : check_state(&ball->state, ball->kind.radius, flat);
}

static double distance_to(const carom_features *f, int rail, const double r[2]) {
  return f->line[rail][0] * r[0] + f->line[rail][1] * r[1] + f->line[rail][2];
}
/* Along a rail, 0 at one of its ends and 1 at the other. */
static double place_along(const carom_features *f, int rail, const double r[2]) {
  return f->along[rail][0] * r[0] + f->along[rail][1] * r[1] + f->along[rail][2];
}
static bool is_beside(const carom_features *f, int rail, const double r[2]) {
  const double place = place_along(f, rail, r);
  return place >= 0.0 && place <= 1.0;
}
/* Whether a place is behind a rail, or up to the rail's length farther: a place beyond a corner is beside neither of its rails.
 */
static bool is_behind(double place, double distance) {
  return place >= -1.0 && place <= 2.0 && distance < 0.0;
}

static bool is_in_hull(const carom_features *f, const double r[2]) {
  return r[0] >= f->hull[0] && r[0] <= f->hull[1] && r[1] >= f->hull[2] && r[1] <= f->hull[3];
}
static bool beyond_ends(const carom_features *f, const double r[2]) {
  return f->rails > 0 && (r[0] < f->ends[0] || r[0] > f->ends[1] || r[1] < f->ends[2] || r[1] > f->ends[3]);
}

bool carom_place_is_outside(const carom_table *table, const carom_features *f, const carom_ball_kind *kind, const double r[2]) {
  if (!is_in_hull(f, r))
    return true;
  /* only behind a rail, or beyond the ends of all rails, can it be outside */
  bool behind = beyond_ends(f, r);
  for (int k = 0; k < f->rails; k++)
    behind |= is_behind(place_along(f, k, r), distance_to(f, k, r));
  return behind && carom_is_cut_off(table, f, kind, r);
}

/* How far from the wall of a cushion the centre is when a ball on the cloth touches its nose. */
static inline double reach_of(const carom_features *f, const carom_ball_kind *kind, double height, bool usual) {
  return usual ? kind->radius : carom_reach_on_cloth(kind, height, f->reference);
}
/* Whether a ball on the cloth is in a rail; in a jaw; with its centre in a pocket. */
static inline bool in_rail(const carom_features *f, int k, const double r[3], double reach, bool *behind) {
  const double distance = distance_to(f, k, r), place = place_along(f, k, r);
  const bool beside = place >= 0.0 && place <= 1.0;
  *behind |= is_behind(place, distance);
  return beside && distance < reach - most_overlap && distance > -reach;
}
static inline bool in_circle(const double centre[2], double reach, const double r[3]) {
  const double d_x = r[0] - centre[0], d_y = r[1] - centre[1];
  return d_x * d_x + d_y * d_y < reach * reach;
}
static inline bool in_jaw(const carom_jaw *jaw, const double r[3], double reach) {
  return in_circle(jaw->centre, jaw->radius + reach - most_overlap, r);
}

/* Whether the ball, on the cloth, stands within the cushions, in no pocket. Inlined twice, so that the loops for balls of the
 * usual radius, `usual`, have no calls in them. */
static inline bool stands_on_table(const carom_table *table, const carom_features *f, const carom_ball_kind *kind,
                                   const double r[3], bool usual) {
  bool good = is_in_hull(f, r), behind = beyond_ends(f, r);
  for (int k = 0; k < f->rails; k++)
    good &= !in_rail(f, k, r, reach_of(f, kind, table->rail[k].height, usual), &behind);
  for (int k = 0; k < f->jaws; k++)
    good &= !in_jaw(&table->jaw[k], r, reach_of(f, kind, table->jaw[k].height, usual));
  for (int k = 0; k < f->pockets; k++)
    good &= !in_circle(table->pocket[k].centre, table->pocket[k].radius, r);
  return good && !(behind && carom_is_cut_off(table, f, kind, r));
}
static bool on_table(const carom_table *table, const carom_features *f, const carom_ball_kind *kind, const double r[3]) {
  return kind->radius == f->reference ? stands_on_table(table, f, kind, r, true) : stands_on_table(table, f, kind, r, false);
}

/* Whether an airborne ball is clear of a nose that is `across` in front of it and `down` below its centre, or on its top. */
static bool clear_of_nose(double across, double down, double R) {
  const double reach = R - most_overlap;
  return across >= 0.0 ? across * across + down * down >= reach * reach : down >= reach;
}

/* Whether an airborne ball is above the table or its rails, and in no cushion. Below the tops it must be within the cushions.
 */
__attribute__((noinline, cold)) static bool above_table(const carom_table *table, const carom_features *f,
                                                        const carom_ball_kind *kind, const double r[3]) {
  bool good =
      r[2] >= carom_nose_height(kind, f->nose_low) + kind->radius - most_overlap || !carom_place_is_outside(table, f, kind, r);
  for (int axis = 0; axis < 2; axis++)
    good &= r[axis] >= f->hull[2 * axis] - f->width && r[axis] <= f->hull[2 * axis + 1] + f->width;
  for (int k = 0; k < f->rails; k++) {
    const double h = carom_nose_height(kind, table->rail[k].height), across = distance_to(f, k, r);
    if (is_beside(f, k, r) && across >= -f->width)
      good &= clear_of_nose(across - carom_nose_shift(h, f->reference), r[2] - h, kind->radius);
  }
  for (int k = 0; k < f->jaws; k++) {
    const carom_jaw *jaw = &table->jaw[k];
    const double h = carom_nose_height(kind, jaw->height), d_x = r[0] - jaw->centre[0], d_y = r[1] - jaw->centre[1];
    const double across = sqrt(d_x * d_x + d_y * d_y) - jaw->radius - carom_nose_shift(h, f->reference);
    good &= clear_of_nose(across, r[2] - h, kind->radius);
  }
  return good;
}

/* The height of a ball's centre above the cloth as the shot takes it: what lies on the cloth is at z = R. */
static inline double height_of(const carom_shot_ball *ball) {
  return carom_flies_in_layout(&ball->state, ball->kind.radius) ? ball->state.r[2] : ball->kind.radius;
}

/* Whether two balls overlap that are at these heights. */
static inline bool overlap(const carom_shot_ball *a, double z_a, const carom_shot_ball *b, double z_b) {
  const double x = a->state.r[0] - b->state.r[0], y = a->state.r[1] - b->state.r[1], z = z_a - z_b;
  const double reach = a->kind.radius + b->kind.radius - most_overlap;
  return x * x + y * y + z * z < reach * reach;
}

static carom_status check_cue(const carom_shot_ball *balls, int count, const carom_cue *cue) {
  if (cue == NULL || cue->speed == 0.0)
    return CAROM_OK;
  if (cue->ball < 0 || cue->ball >= count || carom_is_out(balls[cue->ball].state.label))
    return CAROM_ERROR_CUE;
  return carom_check_cue(cue);
}

carom_status carom_check_common(const carom_table *table, int64_t count, const carom_shot_options *opt, int *where) {
  *where = -1;
  const carom_status bad = carom_check_shot_options(opt);
  if (bad != CAROM_OK)
    return bad;
  return count < 1 || count > CAROM_BALLS_MOST ? CAROM_ERROR_BALLS : check_table(table, where);
}

carom_status carom_check_layout(const carom_table *table, carom_features *features, const carom_shot_ball *balls, int count,
                                const carom_cue *cue, const carom_shot_options *opt, int *where) {
  const bool one_mass = carom_rules_of(opt->world)->one_mass || opt->ball_model == CAROM_BALL_MODEL_INELASTIC;
  const bool flat = is_flat(opt);
  carom_status bad = prepare_for(table, balls, count, flat, features, where);
  if (bad != CAROM_OK)
    return bad;
  double height[CAROM_BALLS_MOST];
  for (*where = 0; *where < count; ++*where) {
    const carom_shot_ball *ball = &balls[*where];
    bad = check_kind(&ball->kind);
    if (bad == CAROM_OK && flat && ball->kind.radius != balls[0].kind.radius)
      bad = CAROM_ERROR_RADII_DIFFER;
    if (bad == CAROM_OK && ball->kind.nose_height >= 2.0 * features->reference)
      bad = CAROM_ERROR_BALL_CUSHION;
    if (bad == CAROM_OK && one_mass && ball->kind.mass != balls[0].kind.mass)
      bad = CAROM_ERROR_MASSES_DIFFER;
    if (bad == CAROM_OK)
      bad = check_state(&ball->state, ball->kind.radius, flat);
    if (bad != CAROM_OK)
      return bad;
    if (carom_is_out(ball->state.label))
      continue;
    const bool flies = carom_flies_in_layout(&ball->state, ball->kind.radius);
    if (flies ? !above_table(table, features, &ball->kind, ball->state.r)
              : !on_table(table, features, &ball->kind, ball->state.r))
      return CAROM_ERROR_OFF_TABLE;
    const double z = height[*where] = height_of(ball);
    for (int k = 0; k < *where; k++)
      if (!carom_is_out(balls[k].state.label) && overlap(ball, z, &balls[k], height[k]))
        return CAROM_ERROR_OVERLAP;
  }
  *where = -1;
  return check_cue(balls, count, cue);
}

carom_status carom_shot_check(const carom_table *table, const carom_shot_ball *balls, int count, const carom_cue *cue,
                              const carom_shot_options *opt, int *where) {
  static const carom_shot_options no_options = {0};
  int unused;
  where = where != NULL ? where : &unused;
  *where = -1;
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  opt = opt != NULL ? opt : &no_options;
  const carom_status bad = carom_check_common(table, count, opt, where);
  carom_features features;
  features.radius = 0.0;
  return bad != CAROM_OK ? bad : carom_check_layout(table, &features, balls, count, cue, opt, where);
}

/* The part that a ball which does not stand on the table is in; CAROM_PART_NONE for one that is outside the ring. */
static carom_part part_there(const carom_table *table, const carom_features *f, const carom_ball_kind *kind,
                             const double r[3]) {
  bool behind = false;
  for (int k = 0; k < f->pockets; k++)
    if (in_circle(table->pocket[k].centre, table->pocket[k].radius, r))
      return (carom_part){CAROM_PART_POCKET, k};
  for (int k = 0; k < f->rails; k++)
    if (in_rail(f, k, r, reach_of(f, kind, table->rail[k].height, false), &behind))
      return (carom_part){CAROM_PART_RAIL, k};
  for (int k = 0; k < f->jaws; k++)
    if (in_jaw(&table->jaw[k], r, reach_of(f, kind, table->jaw[k].height, false)))
      return (carom_part){CAROM_PART_JAW, k};
  return (carom_part){CAROM_PART_NONE, 0};
}

carom_status carom_check_parts(const carom_table *table, double radius, double usual, carom_features *features,
                               carom_part *part) {
  int where;
  carom_status bad = check_table(table, &where);
  if (bad == CAROM_OK && !(positive(radius) && positive(usual)))
    bad = CAROM_ERROR_RADIUS;
  if (bad == CAROM_OK) {
    features->radius = NAN; /* of nothing yet */
    bad = prepare(table, radius, radius, reference_of(table, usual), features, &where);
  }
  *part = (carom_part){CAROM_PART_NONE, 0};
  /* the checks tell an index alone: they go through rails, jaws and pockets in this order */
  if ((bad == CAROM_ERROR_TABLE || bad == CAROM_ERROR_NOSE_HEIGHT) && where >= 0) {
    const carom_rail *rail = &table->rail[where];
    const double lowest = carom_lesser(radius, reference_of(table, usual));
    const bool of_rail =
        where < table->rails && (bad == CAROM_ERROR_TABLE ? !good_rail(rail) : !good_height(rail->height, lowest));
    const bool of_jaw = where < table->jaws && (bad == CAROM_ERROR_TABLE ? !good_jaw(&table->jaw[where])
                                                                         : !good_height(table->jaw[where].height, lowest));
    *part = (carom_part){of_rail ? CAROM_PART_RAIL : of_jaw ? CAROM_PART_JAW : CAROM_PART_POCKET, where};
  }
  return bad;
}

carom_status carom_place_ball(const carom_table *table, carom_shot_ball *balls, int count, int ball, double x, double y,
                              carom_part *in_the_way) {
  carom_part unused;
  in_the_way = in_the_way != NULL ? in_the_way : &unused;
  *in_the_way = (carom_part){CAROM_PART_NONE, 0};
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  if (count < 1 || count > CAROM_BALLS_MOST || ball < 0 || ball >= count)
    return CAROM_ERROR_BALLS;
  carom_features features;
  carom_shot_ball placed = balls[ball];
  const double R = placed.kind.radius, r[3] = {x, y, R};
  const carom_status bad = carom_check_parts(table, R, balls[count - 1].kind.radius, &features, in_the_way);
  if (bad != CAROM_OK)
    return bad;
  if (!bounded(r, 1e6))
    return CAROM_ERROR_POSITION;
  if (!on_table(table, &features, &placed.kind, r)) {
    *in_the_way = part_there(table, &features, &placed.kind, r);
    return CAROM_ERROR_OFF_TABLE;
  }
  placed.state = (carom_ball_state){.r = {x, y, R}, .label = CAROM_BALL_STATIONARY};
  for (int k = 0; k < count; k++) {
    if (k != ball && !carom_is_out(balls[k].state.label) && overlap(&placed, R, &balls[k], height_of(&balls[k]))) {
      *in_the_way = (carom_part){CAROM_PART_BALL, k};
      return CAROM_ERROR_OVERLAP;
    }
  }
  balls[ball].state = placed.state;
  return CAROM_OK;
}
