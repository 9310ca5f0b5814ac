#include "loops.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void carom_python_mu_ball(const carom_impact *in, size_t n, carom_speed_law law, double *mu) {
  for (size_t k = 0; k < n; k++)
    mu[k] = carom_mu_ball(&in[k], law);
}

carom_status carom_python_orientations(const carom_shot_ball *balls, int count,
                                       const carom_shot *shot, const double *times, size_t n,
                                       double *turned) {
  carom_ball_state *states = malloc((n * (size_t)count + 1) * sizeof *states);
  if (states == NULL)
    return CAROM_ERROR_NULL;
  const carom_status status =
      carom_shot_frames(balls, count, shot, times, n, NULL, states, (double(*)[4])turned);
  free(states);
  return status;
}

/* ---- A look at many shots -------------------------------------------------------------------- */

/* What one thread needs for shots that are played again, and the job. */
typedef struct looking {
  const carom_shot_job *job;
  int64_t room;
  carom_event *events;
  carom_ball_state *final, *states; /* at the end of a shot played again, and at all times */
  carom_shot_ball balls[CAROM_BALLS_MOST];
} looking;

/* The balls of shot k, whose kinds and states the job may have apart. */
static const carom_shot_ball *balls_of(looking *with, size_t k) {
  const carom_shot_job *job = with->job;
  const size_t first = k * (size_t)job->ball_stride;
  if (job->balls != NULL)
    return job->balls + first;
  for (size_t i = 0; i < (size_t)job->count; i++)
    with->balls[i] = (carom_shot_ball){job->kinds[i], job->states[first + i]};
  return with->balls;
}

/* Room for so many events. */
static bool make_room(looking *with, int64_t room) {
  with->room = room;
  free(with->events);
  with->events = malloc((size_t)room * sizeof *with->events);
  return with->events != NULL;
}

/* Plays shot k with room for all of its events. A shot of more than there is room for is played
 * again, with enough. */
static bool play_whole(looking *with, size_t k, carom_shot *shot, carom_status *status) {
  const carom_shot_job *job = with->job;
  const carom_cue *cue = job->cues == NULL ? NULL : job->cues + k * job->cue_stride;
  do {
    if (shot->count > with->room && !make_room(with, shot->count))
      return false;
    shot->events = with->events;
    shot->brief = NULL;
    shot->room = with->room;
    *status = carom_shoot(job->table, balls_of(with, k), (int)job->count, cue, job->options, shot);
  } while (shot->count > with->room);
  return true;
}

/* The states at the times, and what of them is unknown. */
static carom_status look_at_times(looking *with, size_t k, const carom_shot *shot,
                                  const double *times, size_t m, carom_ball_state *states) {
  const size_t count = (size_t)with->job->count;
  const carom_ball_state unknown = {
      .r = {NAN, NAN, NAN}, .v = {NAN, NAN, NAN}, .w = {NAN, NAN, NAN}, .label = -1};
  for (size_t i = 0; i < m * count; i++)
    states[i] = unknown;
  return shot == NULL
             ? CAROM_ERROR_TIME
             : carom_shot_frames(balls_of(with, k), (int)count, shot, times, m, NULL, states, NULL);
}

/* One shot. False: there is no memory. */
static bool look_at_shot(looking *with, size_t k, const double *times, size_t m,
                         carom_ball_state *states, double *positions, int8_t *status) {
  const carom_shot_job *job = with->job;
  const size_t count = (size_t)job->count;
  carom_shot *source = &job->shots[k], shot = *source;
  shot.slope_x = job->table->slope_x;
  shot.slope_y = job->table->slope_y;
  carom_status played = (carom_status)job->status[k], look = CAROM_OK;

  /* The shot with all of its events; none of one whose arguments were refused. */
  const bool has_events = source->count <= source->room && source->events != NULL;
  bool known = true;
  if (source->count == 0 && played < 0 && !(source->time > 0.0)) {
    known = false;
  } else if (!has_events) {
    carom_status repeat_status;
    shot.final = with->final;
    if (!play_whole(with, k, &shot, &repeat_status))
      return false;
    known = repeat_status == played && shot.count == source->count && shot.time == source->time &&
            memcmp(with->final, source->final, count * sizeof *with->final) == 0;
    look = known ? CAROM_OK : CAROM_ERROR_STATE;
  }

  carom_ball_state *target = states != NULL ? &states[k * m * count] : with->states;
  if (target != NULL) {
    const carom_status late = look_at_times(with, k, known ? &shot : NULL, times, m, target);
    look = look == CAROM_OK ? late : look;
  }
  for (size_t i = 0; positions != NULL && i < m * count; i++)
    memcpy(&positions[3 * (k * m * count + i)], target[i].r, sizeof target[i].r);
  status[k] = (int8_t)look;
  return true;
}

carom_status carom_python_look(const carom_shot_job *job, const double *times, size_t m,
                               carom_ball_state *states, double *positions, int8_t *status) {
  const size_t count = (size_t)job->count;
  looking with = {.job = job};
  bool room = make_room(&with, 512);
  with.final = malloc(count * sizeof *with.final);
  room = room && with.final != NULL;
  if (positions != NULL && states == NULL && m > 0) {
    with.states = malloc(m * count * sizeof *with.states);
    room = room && with.states != NULL;
  }
  for (size_t k = 0; k < job->n && room; k++)
    room = look_at_shot(&with, k, times, m, states, positions, status);
  free(with.events);
  free(with.final);
  free(with.states);
  return room ? CAROM_OK : CAROM_ERROR_NULL;
}

/* ---- Rules over many shots ------------------------------------------------------------------- */

void carom_python_judge(const carom_plan_rules *rules, size_t n, const int8_t *status,
                        const carom_facts *facts, const uint32_t *in_play, const carom_call *calls,
                        carom_rules_state *states, carom_turn *turns) {
  const carom_facts none = {.first = {-1, -1}};
  const carom_call no_call = {-1, -1};
  for (size_t k = 0; k < n; k++) {
    carom_rules_state state = rules->state;
    turns[k] = rules->judge(states != NULL ? &states[k] : &state, in_play[k], 0,
                            status[k] < 0 ? &none : &facts[k], calls != NULL ? calls[k] : no_call);
  }
}

/* ---- Games for agents ------------------------------------------------------------------------ */

static double within(double x) {
  return fmin(fmax(x, -1.0), 1.0);
}

bool carom_python_cues(const carom_python_game *game, size_t n, const double *actions, size_t acts,
                       const uint64_t *seeds, carom_cue *cues) {
  const carom_player *player = &game->player;
  const double least = player->speed_least, most = player->speed_most;
  for (size_t k = 0; k < n; k++) {
    const double *action = &actions[k * acts];
    for (size_t i = 0; i < acts; i++)
      if (!isfinite(action[i]))
        return false;

    // the stroke that is meant, then the one that is made
    cues[k] = game->cue;
    cues[k].phi = 180.0 * within(action[0]);
    cues[k].speed = least + (most - least) * (within(action[1]) + 1.0) / 2.0;
    cues[k].a = player->tip_most * within(action[2]);
    cues[k].b = player->tip_most * within(action[3]);
    if (seeds != NULL)
      carom_player_strike(player, seeds[k], 0, &cues[k]);
  }
  return true;
}

/* What a shot was by the rules, and the layout after it. */
static void settle(const carom_python_game *game, const carom_shot_ball *previous,
                   const carom_shot *shot, int8_t status, carom_shot_ball *next,
                   carom_python_stroke *stroke) {
  const size_t count = (size_t)game->balls;
  uint32_t in_play = 0;
  bool failed = status < 0;
  for (size_t i = 0; i < count; i++) {
    const int64_t label = previous[i].state.label;
    in_play |= (uint32_t)(label != CAROM_BALL_POCKETED && label != CAROM_BALL_OFF) << i;
    failed |= shot->final[i].label == CAROM_BALL_OFF;
  }
  carom_turn turn;
  carom_python_judge(game->rules, 1, &status, shot->facts, &in_play, NULL, NULL, &turn);
  *stroke = (carom_python_stroke){
      .time = shot->time, .foul = turn.foul, .status = status, .cleared = true};

  // A stroke that failed is taken back.
  memcpy(next, previous, count * sizeof *next);
  for (size_t i = 0; i < count; i++) {
    if (!failed)
      next[i].state = shot->final[i];
    const bool down = next[i].state.label == CAROM_BALL_POCKETED;
    const bool falls = down && previous[i].state.label != CAROM_BALL_POCKETED;
    stroke->scratch |= i == 0 && falls;
    stroke->potted += i > 0 && falls;
    stroke->cleared &= i == 0 || down;
  }
  const bool points = game->table->pockets == 0;
  stroke->reward = points ? turn.points : (double)stroke->potted - (turn.foul != 0);
}

carom_status carom_python_strokes(const carom_python_game *game, size_t begin, size_t n,
                                  const carom_shot_ball *balls, size_t ball_stride,
                                  const carom_cue *cues, size_t cue_stride, carom_shot_ball *next,
                                  carom_python_stroke *strokes) {
  const size_t count = (size_t)game->balls;
  carom_shot *shots = calloc(n + 1, sizeof *shots);
  carom_facts *facts = calloc(n + 1, sizeof *facts);
  carom_ball_state *final = calloc(n * count + 1, sizeof *final);
  int8_t *status = calloc(n + 1, sizeof *status);
  carom_status code = CAROM_ERROR_NULL;
  if (shots != NULL && facts != NULL && final != NULL && status != NULL) {
    for (size_t k = 0; k < n; k++) {
      shots[k].final = &final[k * count];
      shots[k].facts = &facts[k];
    }
    balls += begin * ball_stride;
    cues += begin * cue_stride;
    code = carom_shoot_batch(&(carom_shot_job){.table = game->table,
                                               .balls = balls,
                                               .cues = cues,
                                               .count = game->balls,
                                               .ball_stride = ball_stride,
                                               .cue_stride = cue_stride,
                                               .n = n,
                                               .options = game->options,
                                               .shots = shots,
                                               .status = status});
    for (size_t k = 0; k < n; k++)
      settle(game, &balls[k * ball_stride], &shots[k], status[k], &next[(begin + k) * count],
             &strokes[begin + k]);
  }
  free(shots);
  free(facts);
  free(final);
  free(status);
  return code;
}

/* m, the least distance between balls that are placed, and to what is fixed. */
static const double gap = 1e-3;

/* Whether a place is farther than `least` from another one. */
static bool beyond(const double r[], const double place[], double least) {
  const double x = r[0] - place[0], y = r[1] - place[1];
  return x * x + y * y > least * least;
}

bool carom_python_free(const carom_python_game *game, const carom_shot_ball *balls, int many) {
  const carom_table *table = game->table;
  const double radius = balls->kind.radius;
  for (int i = 0; i < many; i++) {
    const double *r = balls[i].state.r;
    for (int64_t k = 0; k < table->pockets; k++)
      if (!beyond(r, table->pocket[k].centre, table->pocket[k].radius + radius + gap))
        return false;
    for (int64_t k = 0; k < table->jaws; k++)
      if (!beyond(r, table->jaw[k].centre, table->jaw[k].radius + radius + gap))
        return false;
    for (int j = i + 1; j < game->balls; j++)
      if (balls[j].state.label != CAROM_BALL_POCKETED &&
          !beyond(r, balls[j].state.r, 2.0 * radius + gap))
        return false;
  }
  return true;
}

/* The next number of SplitMix64, from 0 to 1, without 1. */
static double draw(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return (double)(z >> 11) * 0x1p-53;
}

bool carom_python_place(const carom_python_game *game, size_t n, uint64_t *draws, int many,
                        carom_shot_ball *balls) {
  for (size_t k = 0; k < n; k++, balls += game->balls) {
    const double low = balls->kind.radius + gap;
    const double width = game->table->width - low - low, length = game->table->length - low - low;
    int tries = 0;
    do {
      if (tries++ == 10000)
        return false;
      for (int i = 0; i < many; i++) {
        carom_ball_state *state = &balls[i].state;
        state->r[0] = low + width * draw(&draws[k]);
        state->r[1] = low + length * draw(&draws[k]);
        state->r[2] = balls->kind.radius;
        state->label = CAROM_BALL_STATIONARY;
      }
    } while (!carom_python_free(game, balls, many));
  }
  return true;
}

void carom_python_seen(const carom_shot_ball *balls, size_t n, size_t count, double *seen) {
  for (size_t k = 0; k < n; k++, seen++)
    for (size_t i = 0; i < count; i++, balls++, seen += 3) {
      const bool down = balls->state.label == CAROM_BALL_POCKETED;
      seen[0] = down ? 0.0 : balls->state.r[0];
      seen[1] = down ? 0.0 : balls->state.r[1];
      seen[2] = !down;
    }
}

/* ---- Pieces of a track --------------------------------------------------------------------------
 *
 * Dynamic programming. For each end j the beginning i goes back from it, and sums over the
 * samples of u^k w, and of u^k w d for both coordinates, grow by one sample; u and d are from
 * the last sample, which keeps digits. chi^2 is what is left of the sum of w d^2 after the
 * projections on 1, u and u^2, made orthogonal one after another. */

void carom_python_cuts(const double *samples, const double *weight, int n, int longest,
                       double penalty, double *best, int32_t *back) {
  best[0] = 0.0;
  for (int j = 1; j <= n; j++) {
    const double *last = &samples[3 * (j - 1)];
    double s[5] = {0}, q[2][3] = {{0}}, square[2] = {0};
    best[j] = HUGE_VAL;
    for (int i = j - 1; i >= 0 && j - i <= longest; i--) {
      /* one more sample */
      const double u = samples[3 * i] - last[0];
      double power = weight[i];
      for (int k = 0; k < 5; k++, power *= u) {
        s[k] += power;
        for (int x = 0; x < 2 && k < 3; x++)
          q[x][k] += power * (samples[3 * i + 1 + x] - last[1 + x]);
      }

      /* chi^2 of the quadratic through samples i ... j - 1 */
      const int count = j - i;
      const double p11 = s[2] - s[1] * s[1] / s[0], p12 = s[3] - s[1] * s[2] / s[0];
      const double p22 = count > 2 ? s[4] - s[2] * s[2] / s[0] - p12 * p12 / p11 : 0.0;
      double chi2 = 0.0;
      for (int x = 0; x < 2; x++) {
        const double d = samples[3 * i + 1 + x] - last[1 + x];
        square[x] += weight[i] * d * d;
        double left = square[x] - q[x][0] * q[x][0] / s[0];
        const double q1 = q[x][1] - s[1] * q[x][0] / s[0];
        if (count > 1)
          left -= q1 * q1 / p11;
        const double q2 = p22 > 0.0 ? q[x][2] - s[2] * q[x][0] / s[0] - p12 * q1 / p11 : 0.0;
        if (p22 > 0.0)
          left -= q2 * q2 / p22;
        chi2 += left > 0.0 ? left : 0.0;
      }

      const double total = best[i] + chi2 + penalty + (count < 3 ? 4.0 * (3 - count) : 0.0);
      if (total < best[j]) {
        best[j] = total;
        back[j] = i;
      }
    }
  }
}

/* ---- Misfit -------------------------------------------------------------------------------------
 *
 * Between two events of a ball its way is taken as the cubic through the states at both ends:
 * r(s) = c0 + s (c1 + s (c2 + s c3)), s the time since the first. A sample then costs a few
 * multiplications; carom_shot_at() would search the events for every sample. With constant
 * friction the motion is quadratic and the cubic exact. A ball that rolls against drag, whose
 * deceleration is A + k v^2, is off by |d^4 r/dt^4| T^4 / 384 = 2 k (A + 3 k v^2)(A + k v^2) T^4
 * / 384 at most. Its pieces last at most 1 s, so that is 1.2e-6 m at 2 m/s with the k and A of
 * docs/reference/constants.md, and 2e-5 m at 5 m/s. */

enum {
  EVENTS_MOST = 1000, /* of a break of 15 balls some 500 */
  PIECES_MOST = 800,
  STRIKE = 6,
  KICKS = 5, /* of a contact */
  KICKED_MOST = 16,
  CONSTANTS_MOST = 24,
  SUMS = 4, /* cost, squares, samples, basin: before the gradient */
  PLAYS_MOST = 1 + STRIKE + KICKS * KICKED_MOST + CONSTANTS_MOST
};
static const double piece_most = 1.0; /* s */

typedef struct piece {
  double start, c[4][2];
} piece;

/* The way of one ball: pieces in the order of time, each up to the next. */
typedef struct way {
  int pieces;
  piece piece[PIECES_MOST];
} way;

/* The cubic from one state to another. */
static piece piece_of(double start, const carom_ball_state *a, double end,
                      const carom_ball_state *b) {
  piece p = {.start = start};
  const double T = end - start;
  for (int k = 0; k < 2; k++) {
    p.c[0][k] = a->r[k];
    p.c[1][k] = a->v[k];
    if (T > 1e-9) {
      const double slope = (b->r[k] - a->r[k]) / T;
      p.c[2][k] = (3.0 * slope - 2.0 * a->v[k] - b->v[k]) / T;
      p.c[3][k] = (a->v[k] + b->v[k] - 2.0 * slope) / (T * T);
    }
  }
  return p;
}

/* The place and velocity of a ball that has rolled against drag for a time t, exactly: dv/dt =
 * -(A + k v^2) takes v0, with q = tan(sqrt(A k) t) / sqrt(A k), to v = (v0 - A q) / (1 + k v0 q)
 * and log(cos(sqrt(A k) t) (1 + k v0 q)) / k further. */
static void roll(const carom_ball_kind *kind, double t, carom_ball_state *s) {
  const double A = kind->mu_roll * kind->gravity, k = kind->drag, turn = sqrt(A * k);
  const double v = hypot(s->v[0], s->v[1]), q = turn > 0.0 ? tan(turn * t) / turn : t;
  const double way = log(cos(turn * t) * (1.0 + k * v * q)) / k,
               later = (v - A * q) / (1.0 + k * v * q);
  for (int axis = 0; axis < 2; axis++) {
    s->r[axis] += way * s->v[axis] / v;
    s->v[axis] *= later / v;
  }
}

/* Appends the way from a state to an end, whose state may be NULL: then it follows from the
 * motion. An end before the start, of a ball that is falling into its pocket, adds nothing. */
static bool go(way *w, const carom_table *table, const carom_shot_ball *ball, double start,
               double end, const carom_ball_state *target) {
  if (end < start)
    return true;
  carom_ball_state state = ball->state, next;
  const bool sloped = table->slope_x != 0.0 || table->slope_y != 0.0;
  const bool rolls = state.label == CAROM_BALL_ROLLING, slides = state.label == CAROM_BALL_SLIDING;
  const bool cuts = (rolls && ball->kind.drag > 0.0) || (sloped && (rolls || slides));
  const double most = sloped ? 0.5 * piece_most : piece_most;
  const int parts = cuts && end - start > most ? (int)fmin(ceil((end - start) / most), 64.0) : 1;
  for (int k = 1; k <= parts; k++) {
    const double elapsed = (end - start) * k / parts;
    const carom_shot shot = {.time = elapsed, .slope_x = table->slope_x, .slope_y = table->slope_y};
    if (k == parts && target != NULL) {
      next = *target;
    } else if (k == parts || sloped) {
      if (carom_shot_at(ball, 1, &shot, elapsed, &next) < 0)
        return false;
    } else {
      next = state;
      roll(&ball->kind, (end - start) / parts, &next);
    }
    if (w->pieces == PIECES_MOST)
      return false;
    w->piece[w->pieces++] =
        piece_of(start + (end - start) * (k - 1) / parts, &state, start + elapsed, &next);
    state = next;
  }
  return true;
}

/* Adds the five kicks of a contact to the balls, whose states before it the event has. */
static void kick(const carom_table *table, const carom_event *e, const double k[KICKS],
                 carom_shot_ball *balls) {
  carom_ball_state *a = &balls[e->a].state, *b = &balls[e->b].state;
  const carom_ball_state *ball_state = &e->before[0], *partner_state = &e->before[1];
  const bool two = e->type == CAROM_EVENT_BALL_BALL;
  const double R = balls[e->a].kind.radius;

  /* The normal, from a into what it meets, and the speed before. */
  double n[2];
  if (two) {
    for (int x = 0; x < 2; x++)
      n[x] = partner_state->r[x] - ball_state->r[x];
  } else if (e->type == CAROM_EVENT_JAW) {
    for (int x = 0; x < 2; x++)
      n[x] = table->jaw[e->b].centre[x] - ball_state->r[x];
  } else {
    const carom_rail *rail = &table->rail[e->b];
    n[0] = rail->q[1] - rail->p[1];
    n[1] = rail->p[0] - rail->q[0];
  }
  const double size = hypot(n[0], n[1]);
  double closing = 0.0;
  for (int x = 0; x < 2; x++) {
    n[x] /= size;
    closing += n[x] * (ball_state->v[x] - (two ? partner_state->v[x] : 0.0));
  }
  for (int x = 0; x < 2 && !two && closing < 0.0; x++)
    n[x] = -n[x];
  const double t[2] = {n[1], -n[0]}, V = two ? closing : hypot(ball_state->v[0], ball_state->v[1]);

  for (int x = 0; x < 2; x++) {
    const double push = V * k[0] * n[x], throw = V * k[1] * t[x], lift = V / R * k[2] * t[x];
    if (two) {
      a->v[x] += throw -push;
      b->v[x] += push - throw;
      a->w[x] += lift;
      b->w[x] += lift;
    } else {
      a->v[x] += V * (k[0] * t[x] - k[1] * n[x]);
      a->w[x] += V / R * (k[2] * n[x] + k[3] * t[x]);
    }
  }
  a->w[2] += V / R * k[two ? 3 : 4];
  if (two)
    b->w[2] += V / R * k[4];
}

/* A ball that falls goes on for the radius of the pocket and stays there, in the middle or nearby:
 * so its place is continuous, and a descent sees samples on both sides of the fall. Returns when it
 * stops. */
static double fall(const carom_table *table, const carom_event *e, carom_ball_state *state,
                   way *w) {
  const carom_ball_state *before = &e->before[0];
  const double speed = hypot(before->v[0], before->v[1]);
  if (speed < 1e-3 || w->pieces == PIECES_MOST)
    return e->time;
  const double wait = table->pocket[e->b].radius / speed;
  w->piece[w->pieces++] =
      (piece){.start = e->time, .c = {{before->r[0], before->r[1]}, {before->v[0], before->v[1]}}};
  for (int k = 0; k < 2; k++)
    state->r[k] = before->r[k] + wait * before->v[k];
  return e->time + wait;
}

/* Appends the ways up to some events of all balls, which are at `balls` at the times starts[]. */
static bool follow(const carom_table *table, const carom_event *events, int many,
                   carom_shot_ball *balls, double *starts, way *ways) {
  bool good = true;
  for (const carom_event *e = events; e < events + many; e++)
    for (int side = 0; side < (e->type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++) {
      const int i = side == 0 ? e->a : e->b;
      good = good && go(&ways[i], table, &balls[i], starts[i], e->time, &e->before[side]);
      starts[i] = e->time;
      balls[i].state = e->after[side];
      if (e->type == CAROM_EVENT_POCKET)
        starts[i] = fall(table, e, &balls[i].state, &ways[i]);
    }
  return good;
}

static bool is_contact(const carom_event *e) {
  return e->type == CAROM_EVENT_BALL_BALL || e->type == CAROM_EVENT_RAIL ||
         e->type == CAROM_EVENT_JAW;
}

/* Plays a shot by a strike, and kicks, until a time on the play's own clock, and finds the events,
 * *many of them, and the ways of its balls, whose layout is that of a variant: 0, or 1 + the
 * constant that is changed. CAROM_ERROR_ROOM: it has too many events. */
static carom_status play(const carom_python_tracks *tracks, int32_t shot, int variant,
                         const double *strike, double end, carom_event *events, int *many,
                         way *ways) {
  const int count = tracks->counts[shot];
  const carom_table *table = &tracks->tables[variant];
  carom_shot_ball balls[CAROM_BALLS_MOST], current[CAROM_BALLS_MOST];
  carom_ball_state final[CAROM_BALLS_MOST];
  const size_t layout = (size_t)variant * (size_t)tracks->shots + (size_t)shot;
  memcpy(balls, &tracks->balls[layout * (size_t)tracks->count], (size_t)count * sizeof *balls);

  /* The struck ball moves as it does just after the strike. */
  carom_shot_ball *struck = &balls[tracks->struck[shot]];
  for (int k = 0; k < 2; k++)
    struck->state.v[k] = strike[k];
  for (int k = 0; k < 3; k++)
    struck->state.w[k] = strike[2 + k] / struck->kind.radius;
  memcpy(current, balls, (size_t)count * sizeof *current);

  /* In parts: up to each contact that has kicks, from the states just after them. */
  double starts[CAROM_BALLS_MOST] = {0}, begin = 0.0;
  carom_shot_options options = *tracks->options;
  end = end > 1e-3 ? end : 1e-3;
  bool good = true;
  for (int i = 0; i < count; i++)
    ways[i].pieces = 0;
  *many = 0;
  for (int contact = 0;;) {
    const bool parts = contact < tracks->kicks;
    options.stop_at = parts ? CAROM_STOP_AT(CAROM_EVENT_BALL_BALL) |
                                  CAROM_STOP_AT(CAROM_EVENT_RAIL) | CAROM_STOP_AT(CAROM_EVENT_JAW)
                            : 0;
    options.events_most = EVENTS_MOST;
    options.time_most = end - begin;
    carom_event *first = &events[*many];
    carom_shot played = {.events = first, .room = EVENTS_MOST - *many, .final = final};
    const carom_status status = carom_shoot(table, current, count, NULL, &options, &played);
    if (status < 0)
      return status;
    if (played.count > played.room)
      return CAROM_ERROR_ROOM;
    for (int e = 0; e < (int)played.count; e++) {
      first[e].time += begin;
      contact += parts && is_contact(&first[e]);
    }
    *many += (int)played.count;
    good = good && follow(table, first, (int)played.count, balls, starts, ways);
    begin += played.time;
    if (status != CAROM_STOPPED_AT_EVENT || begin >= end)
      break;

    /* The kicks of the last contact; its balls go on with them, on all other ways nothing ends. */
    for (int i = 0; i < count; i++)
      current[i].state = final[i];
    const carom_event *last = &events[*many - 1];
    if (contact > tracks->kicks)
      continue;
    kick(table, last, &strike[STRIKE + KICKS * (contact - 1)], current);
    balls[last->a].state = current[last->a].state;
    if (last->type == CAROM_EVENT_BALL_BALL)
      balls[last->b].state = current[last->b].state;
  }

  /* What follows a ball's last event goes to the end of the time. */
  for (int i = 0; i < count; i++)
    good = good && go(&ways[i], table, &balls[i], starts[i], end, NULL);
  return good ? CAROM_OK : CAROM_ERROR_ROOM;
}

static void copy(way *target, const way *source) {
  target->pieces = source->pieces;
  memcpy(target->piece, source->piece, (size_t)source->pieces * sizeof *source->piece);
}

/* The place at a time; *at is the piece of the last call, for times that increase. */
static void place(const way *w, double time, int *index, double r[2]) {
  while (*index + 1 < w->pieces && w->piece[*index + 1].start <= time)
    ++*index;
  const piece *p = &w->piece[*index];
  const double s = time > p->start ? time - p->start : 0.0;
  for (int k = 0; k < 2; k++)
    r[k] = p->c[0][k] + s * (p->c[1][k] + s * (p->c[2][k] + s * p->c[3][k]));
}

/* Multiplies a vector by a matrix of two rows; NULL is unity. */
static void even(const double *matrix, double v[2]) {
  if (!matrix)
    return;
  const double x = v[0], y = v[1];
  v[0] = matrix[0] * x + matrix[1] * y;
  v[1] = matrix[2] * x + matrix[3] * y;
}

/* Adds up the sums of a play. ways[0 ... count - 1] are those of the play itself, with start[0]
 * the strike's time; with `plays` above 1, the next `count` are those with the first number
 * changed by step[0], which changes nothing before onset[0] on the play's clock, and so on. */
static void add_up(const carom_python_tracks *tracks, int32_t shot, const way *ways,
                   const double *start, int plays, const double *step, const double *onset,
                   double end, double *sums) {
  const int count = tracks->count, in_play = tracks->counts[shot];
  const double c2 = tracks->huber * tracks->huber;
  double *gradient = &sums[SUMS], *square = &gradient[plays - 1];
  memset(sums, 0, (size_t)(SUMS + (plays - 1) + (plays - 1) * plays / 2) * sizeof *sums);
  for (int i = 0; i < in_play; i++) {
    const int64_t *first = &tracks->first[(size_t)shot * (size_t)count + (size_t)i];
    int indices[PLAYS_MOST] = {0};
    for (int64_t m = first[0]; m < first[1]; m++) {
      const double *sample = &tracks->samples[3 * m];
      const double *matrix = tracks->evening ? &tracks->evening[4 * m] : NULL;
      if (sample[0] > end)
        break;

      /* The distance and its cost; 1 / root is its weight. */
      double d[2], r[2], J[PLAYS_MOST][2];
      place(&ways[i], sample[0] - start[0], &indices[0], r);
      for (int k = 0; k < 2; k++)
        d[k] = r[k] - sample[1 + k];
      sums[1] += d[0] * d[0] + d[1] * d[1];
      even(matrix, d);
      const double size = d[0] * d[0] + d[1] * d[1];
      const double root = c2 > 0.0 ? sqrt(1.0 + size / c2) : 1.0;
      sums[0] += c2 > 0.0 ? 2.0 * c2 * (root - 1.0) : size;
      sums[2] += 1.0;

      /* The derivatives by the numbers that count here, and what they add to J^T W d and
       * J^T W J. */
      int live[PLAYS_MOST], lives = 0;
      for (int a = 0; a + 1 < plays; a++) {
        double moved[2];
        if (sample[0] - start[0] < onset[a])
          continue;
        live[lives++] = a;
        place(&ways[(a + 1) * count + i], sample[0] - start[a + 1], &indices[a + 1], moved);
        for (int k = 0; k < 2; k++)
          J[a][k] = (moved[k] - r[k]) / step[a];
        even(matrix, J[a]);
      }
      for (int p = 0; p < lives; p++) {
        const int a = live[p];
        double *row = &square[a * (a + 1) / 2];
        gradient[a] += (J[a][0] * d[0] + J[a][1] * d[1]) / root;
        for (int q = 0; q <= p; q++) {
          const int b = live[q];
          row[b] += (J[a][0] * J[b][0] + J[a][1] * J[b][1]) / root;
        }
      }
    }
  }
}

/* When each of the numbers of a strike and its kicks begins to change a play, on its clock: its
 * contact, or never. */
static void begins(const carom_python_tracks *tracks, const carom_event *events, int many,
                   double *onset) {
  const int kicks = KICKS * tracks->kicks;
  for (int d = 0; d < STRIKE + kicks + tracks->constants; d++)
    onset[d] = d < STRIKE || d >= STRIKE + kicks ? -HUGE_VAL : HUGE_VAL;
  int contact = 0;
  for (int e = 0; e < many && contact < tracks->kicks; e++)
    if (is_contact(&events[e]))
      for (int k = KICKS * contact++; k < KICKS * contact; k++)
        onset[STRIKE + k] = events[e].time;
}

/* The basin of a play: a hash (FNV-1a) of the kinds and partners of its contacts in their order. A
 * double holds the 53 bits that are kept. */
static double basin_of(const carom_event *events, int many) {
  uint64_t hash = UINT64_C(14695981039346656037);
  for (int e = 0; e < many; e++) {
    if (!is_contact(&events[e]))
      continue;
    const int32_t words[3] = {(int32_t)events[e].type, events[e].a, events[e].b};
    for (int k = 0; k < 3; k++)
      hash = (hash ^ (uint64_t)(uint32_t)words[k]) * UINT64_C(1099511628211);
  }
  return (double)(hash >> 11);
}

carom_status carom_python_misfit(const carom_python_tracks *tracks, size_t n, const int32_t *shots,
                                 const double *strikes, const double *ends, const double *most,
                                 double *sums) {
  if (tracks->constants > CONSTANTS_MOST || tracks->kicks > KICKED_MOST)
    return CAROM_ERROR_NULL;
  const int count = tracks->count, free_numbers = STRIKE + KICKS * tracks->kicks;
  const int numbers = free_numbers + tracks->constants,
            size = SUMS + numbers + numbers * (numbers + 1) / 2;
  carom_event *events = malloc(EVENTS_MOST * sizeof *events);
  way *ways = malloc((1 + (size_t)numbers) * (size_t)count * sizeof *ways);
  const bool room = events != NULL && ways != NULL;
  for (size_t k = 0; k < n && room; k++, strikes += free_numbers, sums += size) {
    /* The play itself, */
    double start[PLAYS_MOST], step[PLAYS_MOST], onset[PLAYS_MOST];
    int many;
    start[0] = strikes[5];
    memset(sums, 0, (size_t)size * sizeof *sums);
    if (play(tracks, shots[k], 0, strikes, ends[k] - start[0], events, &many, ways) < 0) {
      sums[0] = sums[1] = HUGE_VAL;
      continue;
    }
    const double basin = basin_of(events, many);
    add_up(tracks, shots[k], ways, start, 1, step, onset, ends[k], sums);

    /* and, where it is good enough, those beside it. */
    bool good = sums[0] < most[k];
    begins(tracks, events, many, onset);
    for (int d = 0; d < numbers && good; d++) {
      double strike[STRIKE + KICKS * KICKED_MOST];
      memcpy(strike, strikes, (size_t)free_numbers * sizeof *strike);
      step[d] = d < free_numbers ? tracks->step : tracks->steps[d - free_numbers];
      if (d < free_numbers)
        strike[d] += step[d];
      start[d + 1] = strike[5];
      if (onset[d] == HUGE_VAL)
        continue;
      if (d == STRIKE - 1) {
        /* struck later, the balls go the same way */
        for (int i = 0; i < tracks->counts[shots[k]]; i++)
          copy(&ways[(d + 1) * count + i], &ways[i]);
        continue;
      }
      good = play(tracks, shots[k], d < free_numbers ? 0 : 1 + d - free_numbers, strike,
                  ends[k] - start[d + 1], events, &many, &ways[(d + 1) * count]) >= 0;
    }
    if (good)
      add_up(tracks, shots[k], ways, start, 1 + numbers, step, onset, ends[k], sums);
    sums[SUMS - 1] = basin;
  }
  free(events);
  free(ways);
  return room ? CAROM_OK : CAROM_ERROR_NULL;
}

carom_status carom_python_kicked(const carom_python_tracks *tracks, int32_t shot,
                                 const double *strike, double end, size_t n, const double *times,
                                 carom_event *events, int32_t *many, double *places) {
  way *ways = malloc((size_t)tracks->count * sizeof *ways);
  int happened = 0;
  carom_status status = CAROM_ERROR_NULL;
  if (ways != NULL)
    status = play(tracks, shot, 0, strike, end - strike[5], events, &happened, ways);
  *many = happened;
  for (int i = 0; i < tracks->counts[shot] && status >= 0; i++) {
    int index = 0;
    for (size_t k = 0; k < n; k++)
      place(&ways[i], times[k] - strike[5], &index, &places[2 * ((size_t)i * n + k)]);
  }
  free(ways);
  return status;
}
