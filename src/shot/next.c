/* The next event: the earliest of the times that detect.c keeps, by a plain scan; and the order of events at one instant.
 *
 * World carom: events within 1e-12 s of the earliest count as simultaneous, since rounding decides between them. Of those,
 * balls that fall into pockets come first, then ends of phases on the cloth and balls that leave the table, then contacts,
 * landings among them, the one that closes fastest first; where that too is equal to a part in 1e9, the one of the lower index,
 * and of one ball its landing, then cushions, then balls. So a symmetrical layout is resolved in an order that rounding does
 * not change.
 *
 * World pooltool: only times that are equal as doubles are simultaneous. Of each kind the entry that was computed first leads
 * (in one round: by index), then lower tiers, then higher energies, then the order of kinds: ends of phases, rails, jaws,
 * pockets, pairs. */
#include "shot/sim.h"

#include <math.h>

static const double simultaneous = 1e-12; /* s */
static const double equal_speeds = 1e-9;  /* relative */
enum { MOST_DUE = 128 };

static int type_of_end(const carom_sim *sim, int i) {
  const carom_path *path = &sim->path[i];
  if (path->from.label == CAROM_BALL_SLIDING)
    return CAROM_EVENT_SLIDING_ROLLING;
  if (path->from.label == CAROM_BALL_SPINNING)
    return CAROM_EVENT_SPINNING_STATIONARY;
  if (carom_flies(&path->from))
    return CAROM_EVENT_SLATE;
  if (path->goes_on)
    return CAROM_DUE_PIECE;
  carom_ball_state end;
  carom_path_end(path, &sim->rates[i], &end);
  return end.label == CAROM_BALL_SPINNING ? CAROM_EVENT_ROLLING_SPINNING : CAROM_EVENT_ROLLING_STATIONARY;
}

static carom_due end_of(const carom_sim *sim, int i) {
  return (carom_due){sim->path[i].end, type_of_end(sim, i), i, -1};
}
static carom_due meeting_of(const carom_sim *sim, int i) {
  return (carom_due){sim->meeting[i].time, sim->meeting[i].type, i, sim->meeting[i].what};
}
static carom_due pair_of(const carom_sim *sim, int i, int j) {
  return (carom_due){sim->pair[i][j], CAROM_EVENT_BALL_BALL, i, j};
}

/* All that is due up to a time. */
static int list_due(const carom_sim *sim, double limit, carom_due due[MOST_DUE]) {
  int count = 0;
  for (int i = 0; i < sim->count && count < MOST_DUE - CAROM_BALLS_MOST - 2; i++) {
    if (sim->own[i] <= limit && sim->path[i].end <= limit)
      due[count++] = end_of(sim, i);
    if (sim->own[i] <= limit && sim->meeting[i].time <= limit)
      due[count++] = meeting_of(sim, i);
    for (int j = i + 1; sim->first[i] <= limit && j < sim->count; j++)
      if (sim->pair[i][j] <= limit)
        due[count++] = pair_of(sim, i, j);
  }
  return count;
}

/* ---- World carom */

/* How fast a contact of a ball that flies, or of unlike balls, closes. */
static double closing_in_space(const carom_sim *sim, const carom_due *due, const carom_ball_state *a) {
  if (due->type == CAROM_EVENT_SLATE || due->type == CAROM_EVENT_RAIL_TOP)
    return -a->v[2];
  carom_ball_state b = {.v = {0.0}};
  double n[3], closing = 0.0;
  if (due->type == CAROM_EVENT_BALL_BALL) {
    carom_path_at(&sim->path[due->b], &sim->rates[due->b], due->time, &b);
    carom_line_of_centres(&sim->ball[due->a].kind, a, &sim->ball[due->b].kind, &b, n);
  } else {
    carom_into_nose(sim, &sim->ball[due->a].kind, due->type, due->b, a->r, n);
  }
  for (int k = 0; k < 3; k++)
    closing += (a->v[k] - b.v[k]) * n[k];
  return closing;
}

/* How fast the contact closes, m/s. */
static double closing_speed(const carom_sim *sim, const carom_due *due) {
  carom_ball_state a, b = {.v = {0.0}};
  double n[2];
  carom_path_at(&sim->path[due->a], &sim->rates[due->a], due->time, &a);
  const int64_t other = due->type == CAROM_EVENT_BALL_BALL ? sim->path[due->b].from.label : CAROM_BALL_STATIONARY;
  if (a.label == CAROM_BALL_AIRBORNE || other == CAROM_BALL_AIRBORNE || (sim->unlike && due->type == CAROM_EVENT_BALL_BALL))
    return closing_in_space(sim, due, &a);
  if (due->type == CAROM_EVENT_RAIL) {
    n[0] = -sim->features->line[due->b][0];
    n[1] = -sim->features->line[due->b][1];
  } else {
    if (due->type == CAROM_EVENT_BALL_BALL)
      carom_path_at(&sim->path[due->b], &sim->rates[due->b], due->time, &b);
    const double *to = due->type == CAROM_EVENT_JAW ? sim->table->jaw[due->b].centre : b.r;
    n[0] = to[0] - a.r[0];
    n[1] = to[1] - a.r[1];
    const double size = sqrt(n[0] * n[0] + n[1] * n[1]);
    n[0] /= size;
    n[1] /= size;
  }
  return (a.v[0] - b.v[0]) * n[0] + (a.v[1] - b.v[1]) * n[1];
}

static int rank(int type) {
  switch (type) {
  case CAROM_EVENT_POCKET:
    return 0;
  case CAROM_EVENT_BALL_BALL:
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
  case CAROM_EVENT_SLATE:
  case CAROM_EVENT_RAIL_TOP:
    return 2;
  default:
    return 1;
  }
}

static carom_due choose_carom(const carom_sim *sim, const carom_due *due, int count) {
  int best = 0;
  double speed = -1.0; /* of the best, where it is a contact and had to be compared */
  for (int k = 1; k < count; k++) {
    const int order = rank(due[k].type) - rank(due[best].type);
    if (order > 0 || (order == 0 && rank(due[k].type) < 2))
      continue;
    if (order == 0) {
      speed = speed < 0.0 ? closing_speed(sim, &due[best]) : speed;
      const double other = closing_speed(sim, &due[k]);
      if (!(other > speed * (1.0 + equal_speeds)))
        continue;
      speed = other;
    } else {
      speed = -1.0;
    }
    best = k;
  }
  return due[best];
}

/* ---- World pooltool */

static double energy_of(const carom_sim *sim, int i) {
  const carom_ball_kind *k = &sim->ball[i].kind;
  carom_ball_state s;
  carom_path_at(&sim->path[i], &sim->rates[i], sim->now, &s);
  const double v2 = s.v[0] * s.v[0] + s.v[1] * s.v[1] + s.v[2] * s.v[2],
               w2 = s.w[0] * s.w[0] + s.w[1] * s.w[1] + s.w[2] * s.w[2];
  return 0.5 * k->mass * v2 + 0.5 * 0.4 * k->mass * k->radius * k->radius * w2 + k->mass * k->gravity * (s.r[2] - k->radius);
}

static double pooltool_energy(const carom_sim *sim, const carom_due *due) {
  if (due->type != CAROM_EVENT_BALL_BALL)
    return energy_of(sim, due->a);
  carom_ball_state a, b;
  carom_path_at(&sim->path[due->a], &sim->rates[due->a], sim->now, &a);
  carom_path_at(&sim->path[due->b], &sim->rates[due->b], sim->now, &b);
  const double x = a.v[0] - b.v[0], y = a.v[1] - b.v[1];
  return x * x + y * y;
}

static int kind_of(int type) { /* in the order of pooltool's candidates */
  switch (type) {
  case CAROM_EVENT_RAIL:
    return 1;
  case CAROM_EVENT_JAW:
    return 2;
  case CAROM_EVENT_POCKET:
    return 3;
  case CAROM_EVENT_BALL_BALL:
    return 4;
  default:
    return 0;
  }
}
static int tier_of(int kind) {
  return kind == 0 || kind == 3 ? 2 : 3;
}
static int round_of(const carom_sim *sim, const carom_due *due) {
  return due->type == CAROM_EVENT_BALL_BALL        ? sim->pair_round[due->a][due->b]
         : due->type < CAROM_EVENT_SLIDING_ROLLING ? sim->meeting_round[due->a]
                                                   : 0;
}

static carom_due choose_pooltool(const carom_sim *sim, const carom_due *due, int count) {
  const carom_due *of_kind[5] = {NULL}, *best = NULL;
  for (int k = 0; k < count; k++) {
    const carom_due **leader = &of_kind[kind_of(due[k].type)];
    if (*leader == NULL || round_of(sim, &due[k]) < round_of(sim, *leader))
      *leader = &due[k];
  }
  for (int k = 0; k < 5; k++) {
    if (of_kind[k] == NULL)
      continue;
    const int tiers = best == NULL ? -1 : tier_of(k) - tier_of(kind_of(best->type));
    if (tiers < 0 || (tiers == 0 && pooltool_energy(sim, of_kind[k]) > pooltool_energy(sim, best)))
      best = of_kind[k];
  }
  return *best;
}

carom_due carom_next(const carom_sim *sim) {
  double first = INFINITY;
  for (int i = 0; i < sim->count; i++) {
    const double soonest = carom_lesser(sim->own[i], sim->first[i]);
    first = carom_lesser(soonest, first);
  }
  if (!(first < INFINITY))
    return (carom_due){INFINITY, -1, -1, -1};
  carom_due due[MOST_DUE];
  const int count = list_due(sim, sim->pooltool ? first : first + simultaneous, due);
  if (count == 1)
    return due[0];
  return sim->pooltool ? choose_pooltool(sim, due, count) : choose_carom(sim, due, count);
}
