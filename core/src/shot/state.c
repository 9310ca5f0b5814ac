/* A stopped shot in the keeping of the caller, so that it can continue: carom_shot_state has the
 * carom_sim of the shot, and behind it what the caller has of the result so far.
 *
 * The caller may have kept it in a file, so nothing in it is believed. A state is taken only
 * with its seal, which depends on each of its bits; then every index and number is checked
 * nevertheless. Numbers that follow from others are computed again: rates, the ends of paths,
 * columns and firsts.
 *
 * With the state are kept fingerprints of the table, the balls and the options that it is of, so
 * that it does not continue with others. */
#include "platform/fingerprint.h"
#include "schema/options.h"
#include "shot/rules.h"

#include <math.h>
#include <string.h>

/* The result so far. The events are the caller's; of those are fingerprints. */
typedef struct result {
  int64_t events;
  double time;
  uint64_t of_events, of_brief;
  carom_facts facts;
} result;

enum { SIZE = sizeof(carom_play) + sizeof(result) };

/* The first number of a state: another version, another revision of the physics, and another size
 * are rejected. */
static uint64_t resumable(void) {
  const uint64_t revision = (uint64_t)carom_physics_revision();
  return (uint64_t)CAROM_VERSION_NUMBER << 32 | revision << 20 | SIZE;
}
_Static_assert(SIZE < 1 << 20, "the revision stands beside the size");
_Static_assert(SIZE <= sizeof(carom_shot_state), "a shot on its way fits in the bytes of callers");

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
  uint64_t words[5] = {[3] = (uint32_t)o->fast};
#define PACK(member, key, FORM, low, high, ERROR, text, place) \
  words[place / 2] |= (uint64_t)(uint32_t)o->member << place % 2 * 32;
  CAROM_MOTION_OPTIONS(PACK)
#undef PACK
  return carom_fingerprint(0, words, sizeof words);
}

/* Of the kinds and states of the balls, wherever they are. */
static uint64_t of_balls(const carom_sim *sim) {
  uint64_t hash = 0;
  for (int ball = 0; ball < sim->count; ball++) {
    hash = carom_fingerprint(hash, sim->layout->kind[ball], sizeof(carom_ball_kind));
    hash = carom_fingerprint(hash, sim->layout->state[ball], sizeof(carom_ball_state));
  }
  return hash;
}

void carom_state_begin(carom_sim *sim) {
  sim->of_table = of_table(sim->table);
  sim->of_balls = of_balls(sim);
  sim->of_options = of_options(sim->opt);
}

/* Of events, full or brief, with those `first` to `end`; 0 where there are none. */
static uint64_t of_events(uint64_t hash, const void *events, size_t size, size_t first,
                          size_t end) {
  if (events == NULL)
    return 0;
  for (size_t index = first; index < end; index++)
    hash = carom_fingerprint(hash, (const unsigned char *)events + index * size, size);
  return hash;
}

/* Adds the events of a shot up to so many, as far as its caller has them. */
static void add_events(result *so_far, const carom_shot *shot, int64_t count) {
  const size_t first = (size_t)(so_far->events < shot->room ? so_far->events : shot->room),
               end = (size_t)(count < shot->room ? count : shot->room);
  so_far->of_events = of_events(so_far->of_events, shot->events, sizeof *shot->events, first, end);
  so_far->of_brief = of_events(so_far->of_brief, shot->brief, sizeof *shot->brief, first, end);
  so_far->events = count;
}

/* ---- Saving */

enum { SEAL = 1, SEALED = 2 }; /* words of a state: its seal, and the first after it */
_Static_assert(offsetof(carom_sim, seal) == SEAL * sizeof(uint64_t), "the seal is the second word");

static uint64_t seal_of(const carom_shot_state *state) {
  return carom_fingerprint(resumable(), state->opaque + SEALED, SIZE - SEALED * sizeof(uint64_t));
}

/* Whether nothing is in the bytes behind the shot. */
static bool ends_empty(const carom_shot_state *state) {
  uint64_t any = 0;
  for (size_t index = SIZE / sizeof any; index < sizeof *state / sizeof any; index++)
    any |= state->opaque[index];
  return any == 0;
}
_Static_assert(sizeof(carom_play) % 8 == 0 && SIZE % 8 == 0, "its parts end with a word");

void carom_state_seal(carom_shot_state *state) {
  state->opaque[SEAL] = seal_of(state);
}

void carom_state_save(carom_play *play, carom_shot_state *state) {
  carom_sim *sim = &play->sim;
  const carom_shot *shot = sim->shot;
  result so_far; /* the shot of the state so far, whose events are kept */
  memcpy(&so_far, state->opaque + sizeof *play / sizeof *state->opaque, sizeof so_far);
  add_events(&so_far, shot, shot->count);
  so_far.time = shot->time;
  so_far.facts = *shot->facts;
  sim->can_go_on = resumable();
  sim->rules = NULL; /* the next call provides these */
  sim->table = NULL;
  sim->features = NULL;
  sim->layout = NULL;
  sim->opt = NULL;
  if (play->follow.end >= 0.0 && sim->cue != &play->follow.cue)
    play->follow.cue = *sim->cue;
  sim->cue = NULL;
  sim->shot = NULL;
  memcpy(state, play, sizeof *play);
  memcpy(state->opaque + sizeof *play / sizeof *state->opaque, &so_far, sizeof so_far);
  carom_state_seal(state);
}

/* ---- Checks */

/* Whether the byte is one that a bool may have. */
static bool is_bool(const bool *x) {
  unsigned char byte;
  memcpy(&byte, x, sizeof byte);
  return byte <= 1;
}

/* Whether a ball can be on its path, whose other numbers are computed again: from its state, or, of
 * the second piece of a pair, from what was known of it before. */
static bool restore_path(carom_sim *sim, int i) {
  carom_path *path = &sim->path[i];
  const carom_ball_state *state = &path->from;
  const bool flat = sim->rules->flat || sim->opt->space == CAROM_SPACE_FLAT;
  if (state->label < CAROM_BALL_STATIONARY || state->label > carom_last_label(flat) ||
      !carom_is_finite(state->r) || !carom_is_finite(state->v) || !carom_is_finite(state->w) ||
      !(path->start >= 0.0 && path->start <= sim->time) || !is_bool(&path->ends_pair) ||
      !is_bool(&path->last_pair))
    return false;
  if (!path->ends_pair) {
    carom_path_begin(path, &sim->rates[i], path->start);
    return true;
  }
  /* the second piece has what was known of it, and the state that was known there */
  carom_path_second(path, path->start);
  const bool rolls = state->label == CAROM_BALL_ROLLING,
             slides = state->label == CAROM_BALL_SLIDING;
  const bool in_pairs =
      (rolls && sim->rates[i].drag > 0.0) || ((rolls || slides) && carom_is_sloped(&sim->rates[i]));
  return in_pairs && path->second >= 0.0 && fabs(path->e[0]) <= 1e9 && fabs(path->e[1]) <= 1e9;
}

/* Whether a number is `least` to `most`. */
static bool in(int64_t number, int64_t least, int64_t most) {
  return number >= least && number <= most;
}

/* Whether a ball can meet that on the table. */
static bool good_meeting(const carom_sim *sim, int i) {
  const carom_meeting *m = &sim->meeting[i];
  if (isnan(m->time) || (m->time < INFINITY && !carom_translates(sim->path[i].from.label)))
    return false;
  const int64_t parts = carom_others_of(sim->table, 0, m->type);
  if (m->type == CAROM_DUE_NOTHING)
    return m->part == 0;
  if (m->type == CAROM_EVENT_LEFT_TABLE)
    return m->part == -1;
  return m->part >= 0 && m->part < parts && parts < INT64_MAX;
}

/* Whether the pairs of a ball with later ones can meet at the times given. */
static bool good_pairs(const carom_sim *sim, int i) {
  bool good = true;
  for (int j = i + 1; j < sim->count; j++) {
    const double t = sim->pair[i][j];
    const bool out = carom_is_out(sim->path[i].from.label) || carom_is_out(sim->path[j].from.label);
    good &= out ? t == INFINITY : !isnan(t);
  }
  return good;
}

/* Whether the result so far can belong to the shot. */
static bool good_result(const carom_sim *sim, const result *so_far) {
  const carom_facts *f = &so_far->facts;
  const int64_t most = so_far->events;
  bool good = so_far->time >= sim->time && so_far->time < INFINITY && in(most, 0, INT32_MAX) &&
              in(f->cushions_after, 0, most) && in(f->approach, 0, CAROM_APPROACH_KICK) &&
              (f->down | f->off | f->moved) >> (sim->count - 1) <= 1;
  good &= f->second_time >= 0.0 && carom_is_positive(1.0 + f->second_speed);
  for (int axis = 0; axis < 2; axis++)
    good &= in(f->first[axis], -1, sim->count - 1) && in(f->cushions_before[axis], 0, most) &&
            f->first_time[axis] >= 0.0;
  for (int i = 0; i < CAROM_BALLS_MOST; i++)
    good &= in(f->pocket[i], -1, sim->table->pockets - 1) && f->pocket_time[i] >= 0.0 &&
            in(f->cushions[i], 0, most) && in(f->order[i], -1, sim->count - 1);
  return good;
}

/* Whether a cue that continues can do so. */
static bool good_follow(const carom_play *play) {
  const carom_sim *sim = &play->sim;
  const carom_follow *f = &play->follow;
  return f->end < 0.0 ||
         (f->end < INFINITY && f->start >= 0.0 && f->start <= sim->time && fabs(f->V) < INFINITY &&
          fabs(f->along) < INFINITY && f->left < INFINITY && carom_is_finite(f->origin) &&
          f->time >= sim->time && carom_check_cue(&f->cue) == CAROM_OK);
}

/* Whether all indices and numbers are possible for a shot of sim->layout on sim->table; those that
 * follow from others are computed again. */
static bool restore(carom_play *play) {
  carom_sim *sim = &play->sim;
  static const int64_t many = INT64_C(1) << 62;
  if (!(sim->time >= 0.0 && sim->time < INFINITY) || !in(sim->round, 0, many) ||
      !in(sim->slow_instants, 0, many) || isnan(sim->slow_last) || !is_bool(&sim->has_hit) ||
      !is_bool(&sim->turned) || !good_follow(play) || !in(sim->struck, 0, sim->count - 1))
    return false;
  carom_take_rates(sim);
  for (int i = 0; i < sim->count; i++)
    if (!restore_path(sim, i) || !good_meeting(sim, i))
      return false;
  for (int i = 0; i < sim->count; i++)
    if (!good_pairs(sim, i))
      return false;
  carom_detect_columns(sim);
  return true;
}

carom_status carom_state_check(carom_play *play, const carom_shot_state *state, int count) {
  carom_sim *sim = &play->sim;
  if (sim->can_go_on != resumable() || state->opaque[SEAL] != seal_of(state) || !ends_empty(state))
    return CAROM_ERROR_STATE;
  /* the table, the balls and the options */
  if (sim->world != sim->opt->world || sim->of_options != of_options(sim->opt))
    return CAROM_ERROR_STATE_OPTIONS;
  if (sim->of_table != of_table(sim->table))
    return CAROM_ERROR_STATE_TABLE;
  if (sim->count != count || sim->of_balls != of_balls(sim))
    return CAROM_ERROR_STATE_BALLS;
  result saved, current = {.events = 0};
  memcpy(&saved, state->opaque + sizeof *play / sizeof *state->opaque, sizeof saved);
  if (!restore(play) || !good_result(sim, &saved))
    return CAROM_ERROR_STATE;

  /* the result so far, in which the events are the caller's */
  carom_shot *shot = sim->shot;
  add_events(&current, shot, saved.events);
  if ((shot->events != NULL && current.of_events != saved.of_events) ||
      (shot->brief != NULL && current.of_brief != saved.of_brief))
    return CAROM_ERROR_EVENTS_LOST;
  if (sim->opt->time_most > 0.0 && sim->opt->time_most < saved.time)
    return CAROM_ERROR_TIME_MOST;
  shot->count = saved.events;
  shot->time = saved.time;
  *shot->facts = saved.facts;
  return CAROM_OK;
}
