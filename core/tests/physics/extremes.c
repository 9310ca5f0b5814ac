/* Extreme numbers that are legal: masses to 1:50, radii to 1:3, frictions of 1e-9 and 1,
 * restitutions of 0 and 1, moduli and gravities over many powers of 10, up to 32 balls. Balls that
 * have come to rest are a layout that may be played, no cluster raises the energy, and all numbers
 * are finite. */
#include "random.h"
#include "support.h"

enum { LAYOUTS = 1200, LAYOUTS_OF_RELEASE = 40000, ROOM = 20000 };
static const double rounding = 1e-9; /* of the energy */

typedef struct extreme {
  carom_table table;
  carom_shot_ball ball[CAROM_BALLS_MOST];
  int count;
  carom_cue cue;
  carom_shot_options options;
} extreme;

/* True once in so many. */
static bool once_in(lab_random *random, int times) {
  return lab_whole(random, 1, times) == 1;
}

/* Either end of a range, or between them. */
static double pick(lab_random *random, double low, double high) {
  switch (lab_whole(random, 0, 5)) {
  case 0:
    return low;
  case 1:
    return high;
  case 2:
    return lab_log_uniform(random, low, high);
  default:
    return lab_uniform(random, low, high);
  }
}

static void draw_kind(lab_random *random, carom_ball_kind *kind) {
  if (once_in(random, 2))
    kind->mass *= lab_log_uniform(random, 0.14, 7.1);
  if (once_in(random, 3))
    kind->radius *= lab_log_uniform(random, 0.58, 1.7);
  if (once_in(random, 3))
    kind->mu_slide = pick(random, 1e-6, 1.0);
  if (once_in(random, 3))
    kind->mu_roll = pick(random, 1e-3, 1.0);
  if (once_in(random, 3))
    kind->mu_spin = pick(random, 1e-4, 1.0);
  kind->mu_ball = pick(random, 1e-9, 1.0);
  if (once_in(random, 2))
    kind->restitution = pick(random, 1e-9, 1.0);
  if (once_in(random, 3))
    kind->mu_cushion = pick(random, 1e-9, 1.0);
  if (once_in(random, 3))
    kind->restitution_cushion = pick(random, 1e-9, 1.0);
  if (once_in(random, 8))
    kind->gravity = lab_log_uniform(random, 0.1, 1e4);
  if (once_in(random, 4))
    kind->restitution_table = pick(random, 1e-6, 0.98);
  if (once_in(random, 4))
    kind->modulus = lab_log_uniform(random, 1e6, 1e15);
}

/* Balls somewhere, or frozen to others. False where ball 0 found no place. */
static bool place_balls(extreme *x, lab_random *random) {
  for (int k = 0; k < x->count; k++)
    for (int trial = 0; trial < 40; trial++) {
      double r[2] = {lab_uniform(random, 0.0, x->table.width),
                     lab_uniform(random, 0.0, x->table.length)};
      if (k > 0 && once_in(random, 3)) {
        const carom_shot_ball *other = &x->ball[lab_whole(random, 0, k - 1)];
        const double angle = lab_uniform(random, 0.0, 6.283185307179586);
        double across = 2.0 * sqrt(x->ball[k].kind.radius * other->kind.radius);
        across += once_in(random, 2) ? lab_log_uniform(random, 1e-10, 1e-3) : 0.0;
        r[0] = other->state.r[0] + across * cos(angle);
        r[1] = other->state.r[1] + across * sin(angle);
      }
      if (carom_place_ball(&x->table, x->ball, x->count, k, r[0], r[1], NULL) == CAROM_OK)
        break;
    }
  return x->ball[0].state.label != CAROM_BALL_POCKETED;
}

static void draw_cue(lab_random *random, carom_cue *cue) {
  *cue = carom_cue_of(CAROM_GAME_POOL);
  cue->phi = lab_uniform(random, 0.0, 360.0);
  cue->theta = once_in(random, 2) ? lab_uniform(random, 0.0, 85.0) : 0.0;
  cue->speed =
      once_in(random, 4) ? lab_log_uniform(random, 0.01, 30.0) : lab_uniform(random, 0.1, 10.0);
  const double off = 0.999 * sqrt(lab_uniform(random, 0.0, 1.0)),
               way = lab_uniform(random, 0.0, 6.283185307179586);
  cue->a = off * cos(way);
  cue->b = off * sin(way);
  if (once_in(random, 3))
    cue->mass = lab_log_uniform(random, 0.01, 100.0);
}

static bool draw(lab_random *random, extreme *x) {
  static const carom_table_kind tables[] = {CAROM_TABLE_POOL_7FT, CAROM_TABLE_POOL_9FT,
                                            CAROM_TABLE_THREECUSHION, CAROM_TABLE_HEYBALL};
  static const carom_shot_cushion cushions[] = {CAROM_SHOT_CUSHION_DEFAULT, CAROM_SHOT_CUSHION_HAN,
                                                CAROM_SHOT_CUSHION_STRONGE};
  memset(x, 0, sizeof *x);
  carom_table_make(tables[lab_whole(random, 0, 3)], &x->table);
  x->count = lab_whole(random, 1, CAROM_BALLS_MOST);
  for (int k = 0; k < x->count; k++) {
    x->ball[k].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    draw_kind(random, &x->ball[k].kind);
    x->ball[k].state = (carom_ball_state){.r = {-5.0 - k, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  }
  draw_cue(random, &x->cue);
  x->options.cushion_model = cushions[lab_whole(random, 0, 2)];
  x->options.friction = (carom_ball_friction)lab_whole(random, 0, 1);
  return place_balls(x, random);
}

static double energy_of(const carom_ball_kind *kind, const carom_ball_state *s) {
  double v2 = 0.0, w2 = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    v2 += s->v[axis] * s->v[axis];
    w2 += s->w[axis] * s->w[axis];
  }
  return kind->mass * (0.5 * v2 + 0.2 * kind->radius * kind->radius * w2 +
                       kind->gravity * (s->r[2] - kind->radius));
}

/* By how much a cluster of balls, whose events begin at index *k, raises their energy, as a
 * fraction. *k becomes its last event. */
static double gain_of_cluster(const extreme *x, const carom_event *event, int64_t *k) {
  double before = 0.0, after = 0.0;
  bool seen[CAROM_BALLS_MOST] = {false};
  const int64_t end = *k + event[*k].cluster;
  for (int64_t index = *k; index < end; index++)
    for (int side = 0; side < 1 + (event[index].type == CAROM_EVENT_BALL_BALL); side++) {
      const int ball = side == 0 ? event[index].a : event[index].b;
      if (seen[ball])
        continue;
      seen[ball] = true;
      before += energy_of(&x->ball[ball].kind, &event[index].before[side]);
      after += energy_of(&x->ball[ball].kind, &event[index].after[side]);
    }
  *k = end - 1;
  return (after - before) / fmax(before, 1e-12);
}

/* Whether a cue pushes the balls of a cluster: its strike is the first event, or the second after
 * a nose. */
static bool is_push(const carom_event *first) {
  return first[0].type == CAROM_EVENT_STRIKE || first[1].type == CAROM_EVENT_STRIKE;
}

/* The greatest one of a shot, of those that no cue gives energy. */
static double gain_of(const extreme *x, const carom_shot *shot) {
  double most = 0.0;
  for (int64_t k = 0; k < shot->count; k++) {
    if (shot->events[k].cluster == 0)
      continue;
    if (is_push(&shot->events[k]))
      k += shot->events[k].cluster - 1;
    else
      most = fmax(most, gain_of_cluster(x, shot->events, &k));
  }
  return most;
}

TEST(what_rests_may_be_played) {
  static extreme x;
  static carom_event event[ROOM];
  static carom_ball_state final[CAROM_BALLS_MOST];
  const int layouts = draws_of_test(LAYOUTS, LAYOUTS_OF_RELEASE);
  int rested = 0, bad = 0;
  for (int index = 0; index < layouts; index++) {
    lab_random random = {test_seed() ^ ((uint64_t)index * 0xd1342543de82ef95u)};
    if (!draw(&random, &x))
      continue;
    carom_shot shot = {.events = event, .room = ROOM, .final = final};
    const carom_status status = carom_shoot(&x.table, x.ball, x.count, &x.cue, &x.options, &shot);
    if (status < 0 || shot.count > ROOM)
      continue;
    const double gain = gain_of(&x, &shot);
    bool finite = true;
    for (int k = 0; k < x.count; k++) {
      x.ball[k].state = final[k];
      for (int axis = 0; axis < 3; axis++)
        finite &= isfinite(final[k].r[axis]) && isfinite(final[k].v[axis]);
    }
    const carom_status again = carom_shot_check(&x.table, x.ball, x.count, NULL, &x.options, NULL);
    rested++;
    if (again == CAROM_OK && finite && gain <= rounding)
      continue;
    bad++;
    printf("seed %llu, layout %d of %d balls: %s; energy of a cluster rises by %g of it\n",
           (unsigned long long)test_seed(), index, x.count, carom_status_string(again), gain);
  }
  fflush(stdout);
  ck_assert_int_gt(rested, layouts / 3);
  ck_assert_int_eq(bad, 0);
}
