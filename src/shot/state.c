/* A stopped shot in the keeping of the caller, so that it can go on: carom_shot_state has the
 * carom_sim of the shot.
 *
 * The caller may have kept it in a file, so nothing in it is believed. A state is taken only
 * with its seal, which depends on each of its bits; then every index and number is checked
 * nevertheless. A number that follows from others of the state must have their bits: a path
 * those with which it begins at its start, columns and firsts those that detect.c derives.
 *
 * With the state are kept fingerprints of the table, the balls and the options that it is of, so
 * that it does not go on with others. */
#include "platform/fingerprint.h"
#include "shot/rules.h"
#include "shot/sim.h"

#include <math.h>
#include <string.h>

/* The first number of a state: another version, or another layout, is refused. */
static const uint64_t resumable = (uint64_t)CAROM_VERSION_NUMBER << 32 | sizeof(carom_sim);
_Static_assert(sizeof(carom_sim) <= sizeof(carom_shot_state),
               "a shot on its way fits in the bytes of callers");

/* ---- Fingerprints */

/* Of a table, without the rows of its arrays that it does not use. */
static uint64_t of_table(const carom_table *t) {
  uint64_t h = carom_fingerprint(0, t, offsetof(carom_table, rail));
  h = carom_fingerprint(h, t->rail, (size_t)t->rails * sizeof *t->rail);
  h = carom_fingerprint(h, t->jaw, (size_t)t->jaws * sizeof *t->jaw);
  h = carom_fingerprint(h, t->pocket, (size_t)t->pockets * sizeof *t->pocket);
  return carom_fingerprint(h, &t->ball_radius, sizeof *t - offsetof(carom_table, ball_radius));
}

/* Of the options that decide the motion, and not only when the shot stops. */
static uint64_t of_options(const carom_shot_options *o) {
  const uint64_t words[] = {(uint32_t)o->world | (uint64_t)(uint32_t)o->ball_model << 32,
                            (uint32_t)o->cushion_model | (uint64_t)(uint32_t)o->friction << 32,
                            (uint32_t)o->space | (uint64_t)(uint32_t)o->steps << 32,
                            (uint32_t)o->plain | (uint64_t)(uint32_t)o->simultaneous << 32,
                            (uint32_t)o->cluster_steps};
  return carom_fingerprint(0, words, sizeof words);
}

/* Of the kinds and states of the balls, wherever they are. */
static uint64_t of_balls(const carom_sim *sim) {
  uint64_t h = 0;
  for (int i = 0; i < sim->count; i++) {
    h = carom_fingerprint(h, carom_kind_in(sim->ball, i), sizeof(carom_ball_kind));
    h = carom_fingerprint(h, carom_state_in(sim->ball, i), sizeof(carom_ball_state));
  }
  return h;
}

void carom_state_begin(carom_sim *sim) {
  sim->of_table = of_table(sim->table);
  sim->of_balls = of_balls(sim);
  sim->of_options = of_options(sim->opt);
}

/* ---- Saving */

enum { SEAL = 1, SEALED = 2 }; /* words of a state: its seal, and the first after it */
_Static_assert(offsetof(carom_sim, seal) == SEAL * sizeof(uint64_t), "the seal is the second word");

static uint64_t seal_of(const carom_shot_state *state) {
  return carom_fingerprint(resumable, state->opaque + SEALED,
                           sizeof(carom_sim) - SEALED * sizeof(uint64_t));
}

void carom_state_seal(carom_shot_state *state) {
  state->opaque[SEAL] = seal_of(state);
}

void carom_state_save(carom_sim *sim, carom_shot_state *state) {
  sim->can_go_on = resumable;
  sim->rules = NULL; /* these come with the next call */
  sim->table = NULL;
  sim->features = NULL;
  memset(&sim->ball, 0, sizeof sim->ball);
  sim->opt = NULL;
  sim->cue = NULL;
  sim->shot = NULL;
  memcpy(state, sim, sizeof *sim);
  carom_state_seal(state);
}

/* ---- Checks */

static bool same_bits(const double *a, const double *b, int n) {
  return memcmp(a, b, (size_t)n * sizeof *a) == 0;
}

static bool all_finite(const double *x, int n) {
  bool good = true;
  for (int k = 0; k < n; k++)
    good &= (bool)isfinite(x[k]);
  return good;
}

/* Whether the byte is one that a bool may have. */
static bool is_bool(const bool *x) {
  unsigned char byte;
  memcpy(&byte, x, sizeof byte);
  return byte <= 1;
}

/* Whether ball i is on a path that begins with its state there, or goes on to the second piece
 * of a pair. */
static bool good_path(const carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  const carom_ball_state *from = &path->from;
  const bool flat = sim->rules->flat || sim->opt->space == CAROM_SPACE_FLAT;
  if (from->label < CAROM_BALL_STATIONARY ||
      from->label > (flat ? CAROM_BALL_POCKETED : CAROM_BALL_OFF) || !all_finite(from->r, 3) ||
      !all_finite(from->v, 3) || !all_finite(from->w, 3) ||
      !(path->start >= 0.0 && path->start <= sim->now) || !is_bool(&path->goes_on) ||
      !is_bool(&path->ends_pair) || !is_bool(&path->last_pair))
    return false;
  carom_path anew = *path;
  carom_path_begin(&anew, &sim->rates[i], path->start);
  /* the second piece has the direction of the first, and the state that was known there */
  if (path->ends_pair) {
    if (from->label != CAROM_BALL_ROLLING || !(sim->rates[i].drag > 0.0) ||
        !(path->second[1] >= 0.0) || !(fabs(path->second[0]) <= 1e9) ||
        !(fabs(path->e[0]) <= 2.0) || !(fabs(path->e[1]) <= 2.0))
      return false;
    anew = *path;
    anew.goes_on = !path->last_pair;
    anew.end = path->start + path->second[1];
    for (int k = 0; k < 2; k++)
      anew.a[k] = -0.5 * path->second[0] * path->e[k];
  }
  return anew.goes_on == path->goes_on && anew.ends_pair == path->ends_pair &&
         anew.last_pair == path->last_pair && same_bits(&anew.end, &path->end, 1) &&
         same_bits(anew.a, path->a, 3) && same_bits(anew.e, path->e, 2) &&
         same_bits(anew.second, path->second, 2);
}

/* Whether the columns of ball i have its path, as take_path() of detect.c puts it there. */
static bool good_columns(const carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  const carom_ball_state *from = &path->from;
  const bool moves = carom_translates(from->label), flies = carom_flies(from);
  const double own = moves ? carom_lesser(path->end, sim->meeting[i].time) : path->end;
  const double is[] = {sim->start[i], sim->x[i],   sim->y[i],   sim->v_x[i],
                       sim->v_y[i],   sim->a_x[i], sim->a_y[i], sim->z[i],
                       sim->v_z[i],   sim->a_z[i], sim->own[i], sim->horizon[i]};
  const double should[] = {path->start,
                           from->r[0],
                           from->r[1],
                           moves ? from->v[0] : 0.0,
                           moves ? from->v[1] : 0.0,
                           path->a[0],
                           path->a[1],
                           flies ? from->r[2] : sim->rates[i].radius,
                           flies ? from->v[2] : 0.0,
                           path->a[2],
                           own,
                           carom_is_out(from->label) ? -INFINITY
                           : moves                   ? own
                                                     : INFINITY};
  return same_bits(is, should, sizeof is / sizeof *is);
}

/* Whether ball i can meet that on the table. */
static bool good_meeting(const carom_sim *sim, int i) {
  const carom_meeting *m = &sim->meeting[i];
  const carom_table *t = sim->table;
  if (isnan(m->time) || (m->time < INFINITY && !carom_translates(sim->path[i].from.label)))
    return false;
  switch (m->type) {
  case 0:
    return m->part == 0;
  case CAROM_EVENT_RAIL:
    return m->part >= 0 && m->part < t->rails;
  case CAROM_EVENT_JAW:
    return m->part >= 0 && m->part < t->jaws;
  case CAROM_EVENT_POCKET:
    return m->part >= 0 && m->part < t->pockets;
  case CAROM_EVENT_RAIL_TOP:
    return m->part >= 0 && m->part < t->rails + t->jaws;
  case CAROM_EVENT_LEFT_TABLE:
    return m->part == -1;
  default:
    return false;
  }
}

/* Whether the pairs of ball i with those behind it can meet when they are said to, and the first
 * of them is the first. */
static bool good_pairs(const carom_sim *sim, int i) {
  double first = INFINITY;
  bool good = true;
  for (int j = i + 1; j < sim->count; j++) {
    const double t = sim->pair[i][j];
    const bool out = carom_is_out(sim->path[i].from.label) || carom_is_out(sim->path[j].from.label);
    good &= out ? t == INFINITY : !isnan(t);
    first = carom_lesser(first, t);
  }
  return good && same_bits(&sim->first[i], &first, 1);
}

/* Whether all indices and numbers are those of a shot of sim->ball on sim->table. */
static bool is_sound(const carom_sim *sim) {
  static const int64_t many = INT64_C(1) << 62;
  if (!(sim->now >= 0.0 && sim->now < INFINITY) || sim->round < 0 || sim->round > many ||
      sim->slow_instants < 0 || sim->slow_instants > many || isnan(sim->slow_last) ||
      isnan(sim->one_by_one) || !is_bool(&sim->unlike) || !is_bool(&sim->met) || sim->struck < 0 ||
      sim->struck >= sim->count)
    return false;
  int flying = 0;
  bool unlike = false;
  double widest = 0.0;
  for (int i = 0; i < sim->count; i++) {
    const carom_ball_rates rates = carom_rates_of(carom_kind_in(sim->ball, i));
    widest = carom_greater(widest, rates.radius);
    unlike |= rates.radius != sim->features->reference;
    if (memcmp(&rates, &sim->rates[i], sizeof rates) != 0 || !good_path(sim, i) ||
        !good_meeting(sim, i) || !good_columns(sim, i))
      return false;
    flying += carom_flies(&sim->path[i].from);
  }
  for (int i = 0; i < sim->count; i++)
    if (!good_pairs(sim, i))
      return false;
  return sim->flying == flying && sim->unlike == unlike && same_bits(&sim->widest, &widest, 1);
}

carom_status carom_state_check(const carom_sim *sim, const carom_shot_state *state, int count) {
  if (sim->can_go_on != resumable || state->opaque[SEAL] != seal_of(state))
    return CAROM_ERROR_STATE;
  /* the table, the balls and the options */
  if (sim->world != sim->opt->world || sim->of_options != of_options(sim->opt))
    return CAROM_ERROR_STATE_OPTIONS;
  if (sim->of_table != of_table(sim->table))
    return CAROM_ERROR_STATE_TABLE;
  if (sim->count != count || sim->of_balls != of_balls(sim))
    return CAROM_ERROR_STATE_BALLS;
  return is_sound(sim) ? CAROM_OK : CAROM_ERROR_STATE;
}
