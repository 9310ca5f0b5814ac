/* Strikes: pushes of balls that touch or nearly touch the cue ball against its own integrator
 * (strike_reference.h), limits in closed form and symmetries; a raised cue at a single ball against
 * the same integrator. docs/understanding/clusters.md has the law. */
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cluster/hertz.h"
#include "shot/sim.h"
#include "shot_support.h"
#include "strike_reference.h"

static const double R = 0.028575, PI = 3.14159265358979323846, table_size = 4.0;
static const carom_shot_options gripping = {.friction = CAROM_FRICTION_CONSTANT,
                                            .stop_at = CAROM_STOP_AT(CAROM_EVENT_STRIKE)};
static carom_shot_ball balls[REF_BALLS];
static carom_facts facts;
static carom_shot_state stopped_state;

/* The cue ball in the middle, and `count` balls in all. */
static void begin(int count) {
  for (int k = 0; k < count; k++) {
    balls[k] = ball_at(2.0 + 0.3 * k, 2.0);
    balls[k].kind.mu_spin = 1e-12; /* the turn about the vertical stays */
  }
}

/* Ball k with so much of a gap to ball `of`, at so many degrees from +x. */
static void beside(int k, int of, double gap, double degrees) {
  const double far = 2.0 * R + gap, *r = balls[of].state.r;
  balls[k].state.r[0] = r[0] + far * cos(degrees * PI / 180.0);
  balls[k].state.r[1] = r[1] + far * sin(degrees * PI / 180.0);
}

static carom_cue cue_at(double speed, double phi) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = speed;
  cue.phi = phi;
  cue.a = cue.b = 0.0;
  cue.tip_time = CAROM_TIP_TIME;
  return cue;
}

/* Plays the strike alone: final[] are the balls as it leaves them. */
static carom_shot strike_with(const carom_cue *cue, int count, const carom_shot_options *options) {
  const carom_table table = empty_table(table_size);
  carom_shot shot = {
      .events = events, .room = ROOM, .final = final, .facts = &facts, .state = &stopped_state};
  ck_assert_int_eq(carom_shoot(&table, balls, count, cue, options, &shot), CAROM_STOPPED_AT_EVENT);
  return shot;
}

static carom_shot strike(const carom_cue *cue, int count) {
  return strike_with(cue, count, &gripping);
}

static double part_of(double *sorted, int count, double part) {
  return sorted[(int)(part * (count - 1))];
}

/* ---- Against the reference */

/* One to five balls, at the cue ball or at one before, half of them frozen; the cue mostly at the
 * first. Returns how many with the cue ball. */
static int draw(random_source *r, bool raised, carom_cue *cue) {
  const int count = 2 + (int)random_between(r, 0.0, 4.999);
  begin(count);
  const double e = random_between(r, 0.8, 1.0), mu = random_between(r, 0.02, 0.3);
  for (int k = 0; k < count; k++) {
    balls[k].kind.restitution = e;
    balls[k].kind.mu_ball = mu;
  }
  double first = 0.0;
  for (int k = 1; k < count; k++)
    for (bool clear = false; !clear;) {
      const int of = k > 1 && random_between(r, 0.0, 1.0) < 0.5
                         ? (int)random_between(r, 0.0, (double)k - 1e-9)
                         : 0;
      const double gap = random_between(r, 0.0, 1.0) < 0.5 ? 0.0 : random_between(r, 0.0, 0.002);
      const double degrees = random_between(r, 0.0, 360.0);
      beside(k, of, gap, degrees);
      first = k == 1 ? degrees : first;
      clear = true;
      for (int j = 0; j < k; j++)
        clear &= j == of || distance(balls[k].state.r, balls[j].state.r) > 2.0 * R + 1e-6;
    }
  *cue = cue_at(random_between(r, 0.5, 8.0), first + random_between(r, -70.0, 70.0));
  cue->theta = raised ? random_between(r, 3.0, 50.0) : 0.0;
  cue->a = random_between(r, -0.35, 0.35);
  cue->b = random_between(r, -0.35, 0.35);
  cue->tip_time = random_between(r, 0.0006, 0.002);
  cue->tip_restitution = random_between(r, 0.6, 0.95);
  return count;
}

/* The greatest difference of v and R w, over the cue's speed. */
static double error_of(const ref_strike *ref, double speed) {
  double most = 0.0;
  for (int k = 0; k < ref->count; k++)
    for (int axis = 0; axis < 3; axis++) {
      double v = (double)ref->v[k][axis];
      if (axis == 2 && ref->slate && v > 0.0)
        v = carom_rebound(v, 1.0); /* hops end */
      most = fmax(most, fabs(final[k].v[axis] - v));
      most = fmax(most, fabs(R * final[k].w[axis] - (double)ref->W[k][axis]));
    }
  return most / speed;
}

/* Whether other balls are met than those of the reference. */
static bool meet_others(const ref_strike *ref) {
  bool other = false;
  for (int k = 1; k < ref->count; k++)
    other |= (ref_dot(ref->v[k], ref->v[k]) > 0) != (final[k].v[0] != 0.0 || final[k].v[1] != 0.0);
  return other;
}

/* How far the balls start from the positions of the reference, and how far off its lead the tip is,
 * over the way of the cue in the push of a single ball. */
static void place_errors(const ref_strike *ref, const carom_cue *cue, double errors[2]) {
  num places[REF_BALLS][3];
  carom_play play;
  const num lead = ref_places(ref, cue->tip_time, places);
  memcpy(&play, &stopped_state, sizeof play);
  errors[0] = 0.0;
  errors[1] = play.follow.end > 0.0 ? fabs(play.follow.along - (double)lead) : 0.0;
  for (int k = 0; k < ref->count; k++)
    for (int axis = 0; axis < 2; axis++)
      errors[0] = fmax(errors[0], fabs(final[k].r[axis] - (double)places[k][axis]));
  for (int k = 0; k < 2; k++)
    errors[k] /= cue->speed * cue->tip_time;
}

TEST(pushes_are_those_of_the_reference) {
  random_source r = {test_seed()};
  enum { EACH = 100 };
  const int each = draws_of_test(EACH / 2, EACH);
  const double wider = each < EACH ? 4.0 : 1.0; /* few say little of the rare ones */
  double *error = calloc((size_t)each, sizeof *error), *place = calloc((size_t)each, sizeof *place),
         *lead = calloc((size_t)each, sizeof *lead);
  for (int raised = 0; raised < 2; raised++) {
    int others = 0, twice = 0, at = 0;
    while (at < each) {
      carom_cue cue;
      const int count = draw(&r, raised, &cue);
      strike(&cue, count);
      if (facts.pushed == 0)
        continue; /* as alone */
      ref_strike ref;
      ref_begin(&ref, balls, count, &cue);
      ref_solve(&ref, raised ? 1e-7L : 3e-7L);
      twice += ref.touches > 1;
      if (meet_others(&ref)) { /* met just before or just after the end of the push */
        others++;
        continue;
      }
      ck_assert_int_eq(ref.touches, facts.touches);
      double off[2];
      place_errors(&ref, &cue, off);
      place[at] = off[0];
      lead[at] = off[1];
      error[at++] = error_of(&ref, cue.speed);
      if (getenv("CAROM_SHOW") != NULL && error[at - 1] > 3e-3)
        printf("raised %d, %d balls, %g m/s, theta %g, T %g, touches %d %d: %g\n", raised, count,
               cue.speed, cue.theta, cue.tip_time, ref.touches, facts.touches, error[at - 1]);
    }
    qsort(error, (size_t)each, sizeof *error, by_size);
    printf("%s: %d pushes, %d touched twice, %d that end at another contact: errors %.1e, 9 in 10 "
           "%.1e, 99 in 100 %.1e, at most %.1e\n",
           raised ? "raised" : "level", each, twice, others, part_of(error, each, 0.5),
           part_of(error, each, 0.9), part_of(error, each, 0.99), error[each - 1]);
    qsort(place, (size_t)each, sizeof *place, by_size);
    qsort(lead, (size_t)each, sizeof *lead, by_size);
    printf("places %.1e, 9 in 10 %.1e, at most %.1e; lead %.1e, 9 in 10 %.1e, at most %.1e\n",
           part_of(place, each, 0.5), part_of(place, each, 0.9), place[each - 1],
           part_of(lead, each, 0.5), part_of(lead, each, 0.9), lead[each - 1]);
    ck_assert_int_le(others, 2 + each / 50);
    ck_assert(part_of(error, each, 0.5) < 2e-4);
    ck_assert(part_of(error, each, 0.9) < wider * 5e-4);
    ck_assert(part_of(error, each, 0.98) < wider * 2e-3);
    ck_assert(part_of(place, each, 0.5) < 2e-4);
    ck_assert(part_of(place, each, 0.9) < wider * 2e-4);
    ck_assert(part_of(lead, each, 0.9) < wider * 5e-3);
  }
  free(lead);
  free(place);
  free(error);
}

/* ---- Limits */

/* The ball ahead of the cue ball, at a gap, struck straight: speeds of both. */
static void straight(double gap, double speed, double T, double speeds[2]) {
  begin(2);
  beside(1, 0, gap, 90.0);
  carom_cue cue = cue_at(speed, 90.0);
  cue.tip_time = T;
  strike(&cue, 2);
  speeds[0] = final[0].v[1];
  speeds[1] = final[1].v[1];
}

/* Frozen and straight, by a tip that touches for 1 ms: as a separate program has it. */
TEST(straight_push) {
  double v[2];
  straight(0.0, 2.0, 0.001, v);
  NEAR(v[0], 1.8770, 2e-4);
  NEAR(v[1], 2.4087, 2e-4);
}

/* A tip that touches for 10 ms pushes both balls together, nearly as one body. */
TEST(long_touch_pushes_together) {
  double v[2];
  straight(0.0, 2.0, 0.01, v);
  const carom_cue cue = cue_at(2.0, 90.0);
  const double mass = 2.0 * balls[0].kind.mass;
  const double together = (1.0 + cue.tip_restitution) * cue.speed / (1.0 + mass / cue.mass);
  NEAR(together, 2.162, 1e-3);
  NEAR(v[0], together, 0.02);
  NEAR(v[1], together, 0.02);
}

/* Level and without friction: all of the tip's impulse is in the balls, along the push; the energy
 * falls, counting the cue. The facts are as they should be. */
TEST(momentum_and_energy) {
  random_source r = {test_seed()};
  int pushes = 0;
  for (int n = 0; n < draws_of_test(100, 300); n++) {
    carom_cue cue;
    const int count = draw(&r, false, &cue);
    for (int k = 0; k < count; k++)
      balls[k].kind.mu_ball = 0.0;
    const carom_shot shot = strike(&cue, count);
    pushes += facts.pushed != 0;
    const double J = events[0].impulse, V = cue.speed - J / cue.mass, m = balls[0].kind.mass;
    double P[2] = {0.0, 0.0}, energy = 0.5 * cue.mass * V * V;
    for (int k = 0; k < count; k++) {
      energy += state_energy(&balls[k].kind, &final[k]);
      for (int axis = 0; axis < 2; axis++)
        P[axis] += m * final[k].v[axis];
    }
    NEAR(planar_size(P), J, 1e-12 * J);
    ck_assert_double_le(energy, 0.5 * cue.mass * cue.speed * cue.speed);
    ck_assert(shot.count >= 1 && facts.touches >= 1 && (facts.pushed & 1) == 0);
    for (int k = 1; k < count; k++) {
      const double far = hypot(balls[k].state.r[0] - 2.0, balls[k].state.r[1] - 2.0);
      ck_assert_int_eq(facts.frozen >> k & 1, far < 2.0 * R + CAROM_RULES_TOUCH);
    }
  }
  ck_assert_int_gt(pushes, draws_of_test(100, 300) / 3);
}

/* A ball that the cue ball does not meet changes no bit, and alone and level it is
 * carom_strike(). */
TEST(alone) {
  random_source r = {test_seed()};
  int apart = 0;
  for (int n = 0; n < draws_of_test(100, 300); n++) {
    carom_cue cue;
    const bool raised = n % 2 != 0;
    carom_motion out;
    draw(&r, raised, &cue);
    beside(1, 0, n % 3 == 0 ? 0.0 : 0.002, cue.phi + random_between(&r, 100.0, 260.0));
    strike(&cue, 1);
    const carom_ball_state state = final[0];
    strike(&cue, 2);
    ck_assert_int_eq(facts.pushed, 0);
    ck_assert_int_eq(facts.frozen, n % 3 == 0 ? 2 : 0);
    ck_assert(memcmp(&state, &final[0], sizeof state) == 0);
    if (raised)
      continue;
    apart++;
    carom_strike(&cue, &balls[0].kind, &out);
    ck_assert(memcmp(out.v, state.v, sizeof out.v) == 0 &&
              memcmp(out.w, state.w, sizeof out.w) == 0);
  }
  ck_assert_int_gt(apart, 0);
}

/* A shot that is to stop at a contact, or at a first ball that is not of a set, stops after a push,
 * and continues to the same end. */
TEST(stops_after_a_push) {
  static carom_shot_state state;
  const carom_table table = empty_table(table_size);
  const carom_cue cue = cue_at(2.0, 80.0);
  const carom_shot_options stops[] = {{.stop_at = CAROM_STOP_AT_CONTACT}, {.first_of = 4}};
  for (int k = 0; k < 2; k++) {
    carom_facts whole, parts;
    carom_ball_state end[REF_BALLS], end_parts[REF_BALLS];
    begin(3);
    beside(1, 0, 0.0, 90.0);
    for (int n = 0; n < 3; n++)
      balls[n].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    carom_shot shot = {.facts = &whole, .final = end};
    expect_ok(carom_shoot(&table, balls, 3, &cue, NULL, &shot));
    carom_shot cut = {.facts = &parts, .final = end_parts, .state = &state};
    ck_assert_int_eq(carom_shoot(&table, balls, 3, &cue, &stops[k], &cut), CAROM_STOPPED_AT_EVENT);
    ck_assert(cut.time == 0.0 && parts.pushed == 2 && parts.frozen == 2 && parts.first[0] == 1);
    carom_status status = CAROM_STOPPED_AT_EVENT;
    for (int n = 0; n < 20 && status == CAROM_STOPPED_AT_EVENT; n++)
      status = carom_shot_continue(&table, balls, 3, &stops[k], &cut);
    expect_ok(status);
    ck_assert(memcmp(&whole, &parts, sizeof whole) == 0);
    ck_assert(memcmp(end, end_parts, 3 * sizeof *end) == 0);
  }
}

/* ---- The cue continues */

/* A complete shot of 0.07 s with its facts. */
static carom_shot follow_with(const carom_cue *cue, int count, double until) {
  const carom_table table = empty_table(table_size);
  const carom_shot_options options = {.friction = CAROM_FRICTION_CONSTANT, .time_most = until};
  carom_shot shot = {.events = events, .room = ROOM, .final = final, .facts = &facts};
  ck_assert_int_ge(carom_shoot(&table, balls, count, cue, &options, &shot), 0);
  return shot;
}

/* The same straight and centred at a ball ahead, in short steps of all that moves: cue, both balls
 * on their cloth, tip and balls pressed (strike_reference.h). Returns how often the tip touches. */
static int follow_in_steps(const carom_cue *cue, num gap, num until, num v[2], num second[2]) {
  const carom_ball_kind *kind = &balls[0].kind;
  const num h = 2e-7L, m = kind->mass, rub = kind->mu_slide * kind->gravity,
            e = cue->tip_restitution;
  const num rate = acosl(-1.0L) / 2 * (1 + e) / cue->tip_time;
  ref_press tip = {.k = rate * rate / (1 / (num)cue->mass + 1 / m), .e = e, .power = 1},
            pair = {.e = kind->restitution, .power = 1.5L, .d = -gap};
  pair.k = 4.0L / 3 * 3.3e9L * sqrtl(kind->radius / 2);
  num V = cue->speed, W[2] = {0, 0}, far = 0;
  int touches = 0;
  v[0] = v[1] = 0;
  for (num t = 0; t < until; t += h) {
    const bool open = !(tip.most > 0), goes = far < cue->follow || (touches < 2 && !open);
    /* in the last 3 mm the arm takes the cue away */
    const num left = (cue->follow - far) / 3e-3L, held = touches < 2 || left > 1 ? 1 : left;
    const num closing = V - v[0];
    tip.d += h * closing;
    pair.d += h * (v[0] - v[1]);
    const num F = goes ? held * ref_force(&tip) : 0, N = ref_force(&pair);
    if (open && tip.most > 0 && ++touches == 2) {
      second[0] = t;
      second[1] = closing;
    }
    far += goes && (touches > 1 || (open && touches > 0)) ? h * V : 0;
    V -= h * F / cue->mass;
    v[0] += h * (F - N) / m;
    v[1] += h * N / m;
    for (int k = 0; k < 2; k++) { /* the cloth takes the slip, and no more than that */
      const num u = v[k] - W[k], most = h * rub,
                f = fabsl(u) / 3.5L < most ? u / 3.5L : copysignl(most, u);
      v[k] -= f;
      W[k] += 2.5L * f;
    }
  }
  return touches;
}

/* How much later than in the shot the second touch begins, as contacts last: the clock of a shot
 * begins at the centroid of the push; and where the cue ball meets the other, it loses its speed at
 * the centroid of that contact, and so is farther ahead of the tip. Of the halves of the contact,
 * loading lasts q = 1.4716 delta/v and unloading e q. */
static double delay_of_touch(const carom_cue *cue) {
  const carom_ball_kind *kind = &balls[0].kind;
  const carom_event *e = events;
  while (e->type != CAROM_EVENT_BALL_BALL)
    e++;
  const double closing = e->before[0].v[1] - e->before[1].v[1],
               slowed = e->before[0].v[1] - e->after[0].v[1];
  const double K = 4.0 / 3.0 * 3.3e9 * sqrt(0.5 * kind->radius), B = 2.0 / kind->mass,
               delta = carom_cluster_compression(K, B, closing), r = kind->restitution;
  const double centroid = delta / closing * (0.5 * CAROM_HERTZ_DURATION * r + 1.0 - r);
  return carom_linear_lag(cue->tip_time, cue->tip_restitution) +
         slowed * centroid / facts.second_speed;
}

/* Counts of touches, when and how fast the second comes, and the speeds behind it; beyond the
 * length there is one. Where no tip follows, none comes. */
TEST(second_touches) {
  static const double gaps[] = {1e-4, 3e-4, 7e-4, 2e-3, 3e-3, 5e-3, 0.01, 0.02, 0.024, 0.034};
  static const int told[3][10] = {{1, 1, 1, 2, 2, 2, 2, 2, 2, 1},
                                  {1, 1, 1, 2, 2, 2, 2, 2, 2, 1},
                                  {1, 1, 1, 1, 1, 2, 2, 2, 2, 1}};
  double latest = 0.0;
  for (int n = 0; n < 3; n++)
    for (int k = 0; k < 10; k++) {
      begin(2);
      beside(1, 0, gaps[k], 90.0);
      balls[0].kind.mu_ball = balls[1].kind.mu_ball = 0.0;
      carom_cue cue = cue_at(n == 2 ? 4.0 : 1.0 + n, 90.0);
      num v[2], second[2] = {INFINITY, 0};
      const int touches = follow_in_steps(&cue, gaps[k], 0.07L, v, second);
      follow_with(&cue, 2, 0.07);
      printf("%g m/s, %g mm: %d %d touches, %.2f %.2f ms, %.3f %.3f m/s; %.3f %.3f, %.3f %.3f\n",
             cue.speed, 1e3 * gaps[k], facts.touches, touches, 1e3 * facts.second_time,
             (double)(1e3L * second[0]), facts.second_speed, (double)second[1], final[0].v[1],
             (double)v[0], final[1].v[1], (double)v[1]);
      ck_assert_int_eq(touches, told[n][k]);
      ck_assert_int_eq(facts.touches, touches);
      if (touches > 1) {
        const double shown = facts.second_time + delay_of_touch(&cue);
        latest = fmax(latest, fabs(shown - (double)second[0]));
        NEAR(shown, (double)second[0], 1e-4);
      }
      NEAR(facts.second_speed, (double)second[1], 0.01);
      for (int i = 0; i < 2; i++)
        NEAR(final[i].v[1], (double)v[i], 0.01);
    }
  printf("second touches: off by %.1e s at most\n", latest);
}

/* The mirror image of a layout. */
static void mirror(int count, carom_cue *cue) {
  for (int k = 0; k < count; k++)
    balls[k].state.r[0] = table_size - balls[k].state.r[0];
  cue->phi = 180.0 - cue->phi;
  cue->a = -cue->a;
}

/* What the speed that a level cue gives a ball lacks along its axis of what the cue loses: the
 * friction of the slate under it. */
static double off_axis(const carom_cue *cue, const carom_event *e) {
  const double *u = e->before[0].v, *w = e->after[0].v, phi = cue->phi * PI / 180.0;
  return e->impulse / balls[0].kind.mass - cos(phi) * (w[0] - u[0]) - sin(phi) * (w[1] - u[1]);
}

/* On smooth cloth, the sine of the angle of a push from the normal of its position. The turn that
 * it gives, 5/2 p x P/m, is at right angles to P, which gives the part of P upwards, of which the
 * slate gives some back. 0 where that cannot be told. */
static double cone_of(const carom_event *e) {
  double P[3], turn[3];
  for (int k = 0; k < 3; k++) {
    P[k] = e->after[0].v[k] - e->before[0].v[k];
    turn[k] = 0.4 * R * (e->after[0].w[k] - e->before[0].w[k]);
  }
  const double size = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
  if (fabs(turn[2]) < 0.05 * size)
    return 0.0;
  P[2] = -(P[0] * turn[0] + P[1] * turn[1]) / turn[2];
  return size / sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
}

/* Of balls ahead, at angles, level and raised: up to the second touch all is as without a
 * follow-through, there the ball gets along the axis what the cue loses, within the cone of
 * friction and without energy, the mirror image is that of the shot, and a shot that is stopped on
 * the way continues to the same end. */
TEST(second_touches_at_angles) {
  static carom_event stopped[ROOM];
  static carom_shot_state state;
  random_source r = {test_seed()};
  int seconds = 0, bare = 0;
  double most[2] = {0.0}, widest = 0.0; /* of most: on cloth, on smooth cloth */
  for (int n = 0; n < draws_of_test(150, 400); n++) {
    begin(2);
    beside(1, 0, random_between(&r, 5e-4, 0.03), 90.0 + random_between(&r, -25.0, 25.0));
    carom_cue cue = cue_at(random_between(&r, 0.5, 8.0), 90.0);
    cue.theta = n % 4 == 0 ? random_between(&r, 2.0, 40.0) : 0.0;
    cue.a = random_between(&r, -0.3, 0.3);
    cue.b = random_between(&r, -0.5, 0.3);
    carom_facts whole;
    carom_ball_state end[2];
    const bool smooth = n % 4 == 1;
    for (int k = 0; k < 2 && smooth; k++)
      balls[k].kind.mu_slide = 1e-15;
    const carom_shot shot = follow_with(&cue, 2, 0.1);
    const int64_t count = shot.count;
    whole = facts;
    memcpy(end, final, sizeof end);
    memcpy(stopped, events, (size_t)count * sizeof *events);

    /* energy of the touches that are alone */
    const double m = balls[0].kind.mass;
    double V = cue.speed;
    int touches = 0;
    for (int64_t k = 0; k < count; k++) {
      const carom_event *e = &events[k];
      if (e->type != CAROM_EVENT_STRIKE)
        continue;
      const double next = V - e->impulse / cue.mass;
      if (k > 0 && e->cluster == 0 && cue.theta == 0.0) {
        bare++;
        const double of_slate = off_axis(&cue, e);
        most[smooth] = fmax(most[smooth], fabs(of_slate) * m / e->impulse);
        widest = fmax(widest, smooth * cone_of(e));
        ck_assert_double_le(state_energy(&balls[0].kind, &e->after[0]) +
                                0.5 * cue.mass * next * next,
                            state_energy(&balls[0].kind, &e->before[0]) + 0.5 * cue.mass * V * V);
      }
      V = next;
      touches++;
    }
    ck_assert(touches <= whole.touches && V > 0.0);
    seconds += touches > 1;

    /* in two parts */
    const double cut = random_between(&r, 0.0, 0.03);
    carom_table table = empty_table(table_size);
    carom_shot_options options = {.friction = CAROM_FRICTION_CONSTANT, .time_most = cut};
    carom_shot part = {
        .events = events, .room = ROOM, .final = final, .facts = &facts, .state = &state};
    carom_shoot(&table, balls, 2, &cue, &options, &part);
    options.time_most = 0.1;
    ck_assert_int_ge(carom_shot_continue(&table, balls, 2, &options, &part), 0);
    ck_assert(memcmp(end, final, sizeof end) == 0 && memcmp(&whole, &facts, sizeof whole) == 0 &&
              part.count == count);

    /* without a follow-through, and the mirror image */
    carom_cue stops = cue;
    stops.follow = 0.0;
    follow_with(&stops, 2, 0.1);
    for (int64_t k = 0; k < count && stopped[k].time < whole.second_time; k++)
      ck_assert(memcmp(&stopped[k], &events[k], sizeof *events) == 0);
    mirror(2, &cue);
    follow_with(&cue, 2, 0.1);
    ck_assert_int_eq(facts.touches, whole.touches);
    for (int k = 0; k < 2; k++)
      for (int axis = 0; axis < 2; axis++)
        NEAR(final[k].v[axis], (axis == 0 ? -1.0 : 1.0) * end[k].v[axis], 1e-7 * cue.speed);
  }
  printf("%d second touches, %d alone: the slate takes %.3f at most, if smooth %.1e; %.4f off "
         "the normal\n",
         seconds, bare, most[0], most[1], widest);
  ck_assert(most[0] < 0.5 && most[1] < 1e-9);
  ck_assert(widest > 0.3 && widest < 0.55 * (1.0 + 1e-9));
  ck_assert_int_gt(bare, draws_of_test(150, 400) / 8);
}

/* ---- Symmetries */

/* The mirror image of a strike is the strike of the mirror image. */
TEST(mirror_images) {
  random_source r = {test_seed()};
  for (int n = 0; n < draws_of_test(80, 200); n++) {
    carom_cue cue;
    carom_ball_state there[REF_BALLS];
    const int count = draw(&r, n % 2 != 0, &cue);
    strike(&cue, count);
    memcpy(there, final, sizeof there);
    mirror(count, &cue);
    strike(&cue, count);
    for (int k = 0; k < count; k++)
      for (int axis = 0; axis < 3; axis++) {
        const double v = axis == 0 ? -1.0 : 1.0, w = -v, tiny = 1e-8 * cue.speed;
        NEAR(final[k].v[axis], v * there[k].v[axis], tiny);
        NEAR(R * final[k].w[axis], w * R * there[k].w[axis], tiny);
      }
  }
}

/* Two frozen balls, equal to the left and to the right, get equal motions. */
TEST(left_and_right) {
  for (int n = 0; n < 60; n++) {
    begin(3);
    const double aside = 31.0 + n % 10 * 4.0, gap = n % 2 != 0 ? 2e-4 : 0.0;
    beside(1, 0, gap, 90.0 - aside);
    beside(2, 0, gap, 90.0 + aside);
    carom_cue cue = cue_at(1.0 + 0.5 * (n % 7), 90.0);
    cue.b = 0.2;
    cue.theta = n % 3 == 0 ? 15.0 : 0.0;
    strike(&cue, 3);
    ck_assert_int_eq(facts.pushed, 6);
    NEAR(final[0].v[0], 0.0, 1e-9);
    NEAR(final[1].v[0], -final[2].v[0], 1e-9);
    NEAR(final[1].v[1], final[2].v[1], 1e-9);
  }
}

/* Balls that grip, the cue at phi off the line of centres and a to the side: the object ball leaves
 * at tan = (1/7)(tan phi - 2.5 a/cos phi)/nu off that line. nu, the fraction of the push that is
 * handed on, is 1/2 for a long touch. */
TEST(frozen_at_an_angle) {
  static const double times[] = {0.001, 0.002, 0.01}, nus[] = {0.5625, 0.52, 0.5};
  for (int t = 0; t < 3; t++) {
    double low = 1.0, high = 0.0;
    for (int n = 0; n < 9; n++) {
      begin(2);
      for (int k = 0; k < 2; k++)
        balls[k].kind.mu_ball = 1.0;
      beside(1, 0, 0.0, 90.0);
      const double phi = 10.0 + 10.0 * (n % 3), a = 0.1 * (n / 3 - 1);
      carom_cue cue = cue_at(2.0, 90.0 + phi);
      cue.a = a;
      cue.end_mass = 1e-9; /* no squirt */
      cue.tip_time = times[t];
      strike(&cue, 2);
      const double is = tan(phi * PI / 180.0) - 2.5 * a / cos(phi * PI / 180.0);
      const double nu = is / 7.0 / (-final[1].v[0] / final[1].v[1]);
      low = fmin(low, nu);
      high = fmax(high, nu);
    }
    printf("gripping, %g ms: nu is %.3f to %.3f\n", 1e3 * times[t], low, high);
    NEAR(low, nus[t], 0.01);
    NEAR(high, nus[t], 0.01);
  }
}

/* ---- A raised cue */

/* The strike of a raised cue at a single ball. Returns the touches of the tip. */
static int strike_alone(const carom_cue *cue, double e, carom_ball_state *end) {
  begin(1);
  balls[0].kind.restitution_table = e;
  strike(cue, 1);
  *end = final[0];
  return facts.touches;
}

/* A single ball, by its phases, compared with the reference. Ends of hops are left out, as the
 * reference has none. */
TEST(raised_alone) {
  random_source r = {test_seed()};
  const int count = draws_of_test(60, 150);
  double *error = calloc((size_t)count, sizeof *error);
  int again = 0, other = 0;
  for (int n = 0; n < count; n++) {
    carom_cue cue = cue_at(random_between(&r, 0.5, 8.0), random_between(&r, 0.0, 360.0));
    cue.theta = random_between(&r, 1.0, 85.0);
    cue.a = random_between(&r, -0.4, 0.4);
    cue.b = random_between(&r, -0.4, 0.4);
    cue.mass = random_between(&r, 0.2, 0.7);
    cue.tip_time = random_between(&r, 0.0005, 0.002);
    cue.tip_restitution = random_between(&r, 0.5, 0.95);
    cue.follow = n % 2 == 0 ? CAROM_CUE_FOLLOW : 0.0;
    carom_ball_state end;
    const int touches = strike_alone(&cue, random_between(&r, 0.3, 0.9), &end);
    ref_strike ref;
    ref_begin(&ref, balls, 1, &cue);
    ref_solve(&ref, 1e-7L);
    other += touches != ref.touches && cue.follow > 0.0;
    again += touches > 1;
    error[n] = error_of(&ref, cue.speed);
    if (getenv("CAROM_SHOW") != NULL && error[n] > 1e-3)
      printf("theta %g, T %g, e %g %g, M %g: %g, touches %d %d\n", cue.theta, cue.tip_time,
             cue.tip_restitution, balls[0].kind.restitution_table, cue.mass, error[n], touches,
             ref.touches);
  }
  qsort(error, (size_t)count, sizeof *error, by_size);
  printf("raised alone: errors %.1e, 9 in 10 %.1e, 98 in 100 %.1e; %d touch again, %d otherwise\n",
         part_of(error, count, 0.5), part_of(error, count, 0.9), part_of(error, count, 0.98), again,
         other);
  ck_assert(part_of(error, count, 0.5) < 1e-4);
  ck_assert(part_of(error, count, 0.9) < 5e-4);
  ck_assert_int_le(other, 2 + count / 50);
  free(error);
}

/* One law: a ball that the cue ball touches by a hair changes nothing, at any elevation. */
TEST(hair_beside) {
  static const double elevations[] = {2.0, 5.0, 8.0, 12.0, 20.0, 30.0, 45.0, 60.0, 75.0};
  for (int n = 0; n < 9; n++) {
    carom_cue cue = cue_at(2.0, 90.0);
    cue.theta = elevations[n];
    carom_ball_state lone;
    strike_alone(&cue, 0.5, &lone);
    begin(2);
    beside(1, 0, 0.0, 0.01);
    strike(&cue, 2);
    ck_assert_int_eq(facts.pushed, 2);
    printf("%s%g: %.4f %.4f", n == 0 ? "" : ", ", cue.theta, lone.v[1], final[0].v[1]);
    NEAR(final[0].v[1], lone.v[1], 1e-3 * lone.v[1]);
    NEAR(final[0].v[2], lone.v[2], 2e-3);
    NEAR(R * final[0].w[0], R * lone.w[0], 2e-3);
  }
  printf("\n");
}

/* In flat play squirt turns a raised push level, alone as next to a hair. */
TEST(flat_squirt) {
  const carom_shot_options flat = {.space = CAROM_SPACE_FLAT,
                                   .stop_at = CAROM_STOP_AT(CAROM_EVENT_STRIKE)};
  for (int n = 0; n < 2; n++) {
    carom_ball_state end[2];
    carom_cue cue = cue_at(2.0, 90.0);
    cue.theta = 45.0;
    cue.a = n == 0 ? 0.4 : -0.4;
    for (int count = 1; count <= 2; count++) {
      begin(count);
      if (count == 2) /* behind it, on the other side of the push */
        beside(1, 0, 0.0, n == 0 ? 179.9 : 0.1);
      strike_with(&cue, count, &flat);
      end[count - 1] = final[0];
    }
    printf("flat, 45 degrees: %.5f %.5f\n", end[0].v[0], end[1].v[0]);
    NEAR(end[1].v[0], end[0].v[0], 1e-3);
    NEAR(end[1].v[1], end[0].v[1], 1e-3);
  }
}

/* An elevation below 1e-6 degrees is level, to the last bit, and a small one nearly so. */
TEST(level_is_level) {
  carom_ball_state level[2];
  for (double theta = 0.0; theta < 0.1; theta = theta == 0.0 ? 1e-300 : 30.0 * theta) {
    begin(2);
    beside(1, 0, 0.0, 90.0);
    carom_cue cue = cue_at(2.0, 90.0);
    cue.theta = theta;
    strike(&cue, 2);
    ck_assert_int_eq(facts.pushed, 2);
    if (theta == 0.0)
      memcpy(level, final, sizeof level);
    if (theta < CAROM_LEAST_ELEVATION)
      ck_assert(memcmp(level, final, sizeof level) == 0);
    for (int k = 0; k < 2; k++)
      NEAR(final[k].v[1], level[k].v[1], 0.01);
  }
}

/* Three balls, the cue ball frozen to the first: a push at any elevation, and never two blows. */
TEST(no_push_becomes_two_blows) {
  static const double elevations[] = {0.0, 1e-6, 0.01, 1.0, 5.0, 20.0};
  double before = 0.0;
  for (int n = 0; n < 6; n++) {
    begin(3);
    beside(1, 0, 0.0, 181.11);
    beside(2, 1, 0.0, -84.3);
    carom_cue cue = cue_at(5.28, 215.8);
    cue.theta = elevations[n];
    cue.a = -0.282;
    cue.b = 0.092;
    for (int k = 0; k < 3; k++)
      balls[k].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    strike(&cue, 3);
    ck_assert(facts.pushed == 2 && facts.touches == 1);
    if (n > 0)
      NEAR(final[0].v[0], before, n < 3 ? 0.02 : 0.6);
    before = final[0].v[0];
  }
}

/* More steps change a push little, up to their bound; times of a tip down to nothing are solved. */
TEST(steps_mean_what_they_say) {
  static const int steps[] = {25, 100, 1000, 10000};
  double coarse = 0.0;
  for (int raised = 0; raised < 2; raised++)
    for (int n = 0; n < 4; n++) {
      carom_shot_options options = gripping;
      options.cluster_steps = steps[n];
      begin(2);
      beside(1, 0, 0.0, 90.0);
      carom_cue cue = cue_at(2.0, 90.0);
      cue.theta = raised ? 20.0 : 0.0;
      strike_with(&cue, 2, &options);
      ck_assert_int_eq(facts.pushed, 2);
      printf("%s%d steps: %.5f", n == 0 ? "" : ", ", steps[n], final[0].v[1]);
      coarse = n == 0 ? final[0].v[1] : coarse;
      NEAR(final[0].v[1], coarse, 1e-3);
    }
  double v[2];
  for (double T = 1e-4; T > 1e-10; T *= 0.1) {
    straight(0.0, 2.0, T, v);
    printf(", T %g: %.4f %.4f", T, v[0], v[1]);
    ck_assert_int_eq(facts.pushed, 2);
    NEAR(v[1], 2.6, 0.02);
  }
  printf("\n");
}

/* A push that takes more steps than are allowed ends the shot, and says so: hard and light balls
 * alternate with soft and heavy ones. */
TEST(unresolved_ends_the_shot) {
  enum { IN_ROW = 8 };
  const carom_table table = empty_table(40.0);
  const carom_cue cue = cue_at(0.9, 90.0);
  carom_shot_ball row[IN_ROW];
  for (int k = 0; k < IN_ROW; k++) {
    const bool is_soft = k % 2 == 1;
    row[k] = ball_at(20.0, 20.0 + 2.0 * R * k);
    row[k].kind.restitution = 0.2;
    row[k].kind.mass *= is_soft ? 1e3 : 1.0;
    row[k].kind.modulus = is_soft ? 1e6 : 1e15;
  }
  carom_shot shot = empty_shot();
  shot.facts = &facts;
  ck_assert_int_eq(carom_shoot(&table, row, IN_ROW, &cue, NULL, &shot), CAROM_ERROR_UNRESOLVED);
  ck_assert_int_eq(shot.count, 0);
  ck_assert_double_eq(shot.time, 0.0);
  ck_assert_int_eq(facts.touches, 0);
  ck_assert_double_eq(final[0].v[1], 0.0);
}

/* Every ball of a pack has the slate under a raised cue: the numbering does not count. */
TEST(numbering_does_not_count) {
  const carom_table table = empty_table(table_size);
  random_source r = {test_seed()};
  for (int n = 0; n < draws_of_test(20, 60); n++) {
    carom_shot_ball pack[16], other[16];
    carom_ball_state end[2][16];
    const int count = 10 + n % 7;
    for (int k = 0, row = 0, place = 0; k < count; k++) {
      pack[k] = ball_at(2.0, 2.0);
      if (k > 0) {
        pack[k].state.r[0] += (place - 0.5 * row) * 2.0 * R;
        pack[k].state.r[1] += 2.0 * R + row * sqrt(3.0) * R + 1e-10 * k;
        place = place == row ? 0 : place + 1;
        row += place == 0;
      }
    }
    carom_cue cue = cue_at(random_between(&r, 0.5, 8.0), 90.0 + random_between(&r, -25.0, 25.0));
    cue.theta = random_between(&r, 3.0, 45.0);
    for (int turn = 0; turn < 2; turn++) {
      for (int k = 0; k < count; k++)
        other[turn == 0 ? k : count - 1 - k] = pack[k];
      cue.ball = turn == 0 ? 0 : count - 1;
      const carom_shot_options options = {.time_most = 1e-3};
      carom_shot shot = {.events = events, .room = ROOM, .final = end[turn]};
      ck_assert_int_eq(carom_shoot(&table, other, count, &cue, &options, &shot),
                       CAROM_STOPPED_AT_TIME);
      ck_assert_int_gt(events[0].cluster, 1); /* one push, never two blows */
    }
    for (int k = 0; k < count; k++)
      NEAR_EACH(end[1][count - 1 - k].v, end[0][k].v, 3, 1e-9 * cue.speed);
  }
}

/* Pushes of elastic bodies without friction add no energy, level and raised. */
TEST(elastic_pushes) {
  random_source r = {test_seed()};
  double most = -1.0;
  for (int n = 0; n < draws_of_test(100, 300); n++) {
    carom_cue cue;
    const int count = draw(&r, n % 3 == 0, &cue);
    cue.tip_restitution = 1.0;
    for (int k = 0; k < count; k++) {
      balls[k].kind.restitution = 1.0;
      balls[k].kind.mu_ball = 0.0;
    }
    strike(&cue, count);
    const double V = cue.speed - events[0].impulse / cue.mass;
    double energy = 0.5 * cue.mass * (V * V - cue.speed * cue.speed);
    for (int k = 0; k < count; k++)
      energy += state_energy(&balls[k].kind, &final[k]);
    most = fmax(most, energy / (0.5 * cue.mass * cue.speed * cue.speed));
  }
  printf("elastic: energy rises by %.1e at most\n", most);
  ck_assert_double_lt(most, 1e-12);
}

/* ---- Followed to its end */

/* A cue ball that is struck straight into a cushion near it returns onto the tip, in the nose or
 * behind it: a second touch, with its speed and time. A cue that stops touches once. */
TEST(back_from_a_cushion) {
  static const double gaps[] = {0.002, 0.005, 0.01, 0.02};
  const carom_shot_options options = {.time_most = 0.2};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (size_t n = 0; n < COUNT_OF(gaps); n++) {
    carom_shot_ball ball = ball_at(0.0, 0.6);
    ball.kind = carom_ball_kind_of(CAROM_GAME_POOL);
    ball.state.r[0] = table.width - ball.kind.radius - gaps[n];
    carom_cue cue = cue_at(2.0, 0.0);
    carom_shot shot = empty_shot();
    shot.facts = &facts;
    ck_assert_int_eq(carom_shoot(&table, &ball, 1, &cue, &options, &shot), CAROM_STOPPED_AT_TIME);
    ck_assert_int_ge(facts.touches, 2);
    ck_assert_int_le(facts.touches, 4);
    ck_assert_int_eq(events[1].type, CAROM_EVENT_RAIL);
    ck_assert_int_eq(events[2].type, CAROM_EVENT_STRIKE);
    ck_assert_double_eq(facts.second_time, events[2].time);
    ck_assert_double_gt(facts.second_speed, 0.5 * cue.speed);
    cue.follow = 0.0;
    ck_assert_int_eq(carom_shoot(&table, &ball, 1, &cue, &options, &shot), CAROM_STOPPED_AT_TIME);
    ck_assert_int_eq(facts.touches, 1);
  }
}

/* How deep the tip of a cue that continues is in the ball of a stopped shot, m. */
static double depth_of_tip(const carom_play *play, const carom_cue *cue, const double centre[3]) {
  double axes[3][3], tip_place[3];
  carom_tip_from(cue, R, play->follow.origin, play->follow.along, centre, axes, tip_place);
  return R - sqrt(tip_place[0] * tip_place[0] + tip_place[1] * tip_place[1] +
                  tip_place[2] * tip_place[2]);
}

/* How deep the tip comes in the ball between its touches: the stroke is stopped each half
 * millisecond as long as the cue continues. The tip loses the side of the ball, so only a tip whose
 * ball is ahead of it counts. */
static double depth_on_the_way(const carom_table *table, carom_shot_ball *ball,
                               const carom_cue *cue) {
  static carom_shot_state state;
  static carom_play play;
  carom_shot shot = empty_shot();
  shot.state = &state;
  carom_shot_options options = {.time_most = 5e-4};
  double deepest = 0.0;
  for (carom_status status = carom_shoot(table, ball, 1, cue, &options, &shot);
       status == CAROM_STOPPED_AT_TIME;
       status = carom_shot_continue(table, ball, 1, &options, &shot)) {
    memcpy(&play, &state, sizeof play);
    const carom_follow *follow = &play.follow;
    if (!(shot.time <= follow->end))
      break;
    const carom_ball_state *now = &shot.final[0];
    double axes[3][3], tip_place[3], offset[3];
    carom_tip_from(cue, R, follow->origin, follow->along + follow->V * (shot.time - follow->start),
                   now->r, axes, tip_place);
    carom_tip_on(axes, tip_place, offset);
    if (offset[0] < -0.3)
      deepest = fmax(deepest, R - carom_space_size(tip_place));
    options.time_most = shot.time + 5e-4;
  }
  return deepest;
}

/* Strokes of a ball that is frozen to a cushion or next to it, into it, stopped at each touch. A
 * cue that the ball has stopped or thrown back is still there: no touch leaves its tip deep in the
 * ball, unless the ball has slid past it, none comes late, and the ball does not pass through the
 * tip between them. */
TEST(cues_that_have_stopped) {
  static carom_shot_state state;
  static carom_play play;
  random_source r = {test_seed()};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  double deepest = 0.0, latest = 0.0;
  int touches = 0, most = 0, past = 0, frozen = 0;
  for (int n = 0; n < draws_of_test(400, 2000); n++) {
    carom_shot_ball ball = ball_at(0.0, random_between(&r, 0.4, 0.9));
    ball.kind = carom_ball_kind_of(CAROM_GAME_POOL);
    ball.state.r[0] = ball.kind.radius + (n % 2 == 0 ? 0.0 : random_between(&r, 0.0, 0.02));
    carom_cue cue = cue_at(random_between(&r, 0.5, 6.0), 180.0 + random_between(&r, -30.0, 30.0));
    cue.a = random_between(&r, -0.3, 0.3);
    cue.b = random_between(&r, -0.3, 0.3);
    const carom_shot_options options = {.stop_at = CAROM_STOP_AT(CAROM_EVENT_STRIKE)};
    carom_shot shot = empty_shot();
    shot.facts = &facts;
    shot.state = &state;
    carom_status status = carom_shoot(&table, &ball, 1, &cue, &options, &shot);
    for (int stop = 0; status == CAROM_STOPPED_AT_EVENT; stop++) {
      memcpy(&play, &state, sizeof play);
      const bool present = play.follow.end >= 0.0;
      if (stop > 0 && present)
        deepest = fmax(deepest, depth_of_tip(&play, &cue, shot.final[0].r));
      past += stop > 0 && !present;
      latest = fmax(latest, shot.time);
      status = carom_shot_continue(&table, &ball, 1, &options, &shot);
    }
    ck_assert_int_eq(status, CAROM_OK);
    deepest = fmax(deepest, depth_on_the_way(&table, &ball, &cue));
    touches += facts.touches;
    most = facts.touches > most ? facts.touches : most;
    if (n % 2 == 0)
      frozen = facts.touches > frozen ? facts.touches : frozen;
  }
  printf("stopped cues: %d touches, at most %d of a stroke, %d of a frozen ball, the latest after "
         "%.2f s; tips are %.1e m deep at most; the ball slides past %d\n",
         touches, most, frozen, latest, deepest, past);
  ck_assert_double_lt(deepest, 4e-3); /* what a hard stroke compresses a tip by */
  ck_assert_double_lt(latest, 0.35);
  ck_assert_int_le(most, 8);
  ck_assert_int_le(frozen, 4);
  ck_assert_int_lt(3 * past, touches);
}

/* Strokes next to a cushion and other balls: a touch of the tip that is told has an impulse. Where
 * only the balls act in a nose, the tip has not touched. */
TEST(touches_have_an_impulse) {
  random_source r = {test_seed()};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  int touches = 0, noses = 0;
  for (int n = 0; n < draws_of_test(400, 2000); n++) {
    carom_cue cue = cue_at(random_between(&r, 0.5, 6.0), 180.0 + random_between(&r, -70.0, 70.0));
    cue.theta = n % 2 == 0 ? 0.0 : random_between(&r, 0.0, 50.0);
    balls[0] = ball_at(R + random_between(&r, 0.0, 0.02), random_between(&r, 0.4, 0.9));
    balls[1] = ball_at(2.0, 2.0);
    beside(1, 0, random_between(&r, 0.0, 0.02), random_between(&r, -90.0, 90.0));
    for (int k = 0; k < 2; k++)
      balls[k].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    carom_shot shot = empty_shot();
    shot.facts = &facts;
    expect_ok(carom_shoot(&table, balls, 2, &cue, NULL, &shot));
    for (int64_t k = 1; k < shot.count; k++) {
      if (events[k].type != CAROM_EVENT_STRIKE)
        continue;
      ck_assert_double_gt(events[k].impulse, 0.0);
      touches++;
      noses += events[k].cluster > 1;
    }
  }
  printf("%d further touches, %d with other contacts\n", touches, noses);
  ck_assert_int_gt(noses, touches / 10);
}

/* A cue without a follow-through touches once, level and raised. */
TEST(no_follow_through) {
  random_source r = {test_seed()};
  for (int n = 0; n < draws_of_test(100, 300); n++) {
    carom_cue cue;
    const int count = draw(&r, n % 2 != 0, &cue);
    cue.follow = 0.0;
    strike(&cue, count);
    ck_assert_int_eq(facts.touches, 1);
  }

  /* a ball straight ahead that is met once the tip has parted, while its set recovers */
  for (int n = 0; n < draws_of_test(100, 300); n++) {
    begin(2);
    beside(1, 0, random_between(&r, 0.0, 0.006), 90.0);
    carom_cue cue = cue_at(2.0, 90.0);
    cue.theta = random_between(&r, 0.0, 50.0);
    cue.follow = 0.0;
    strike(&cue, 2);
    ck_assert_int_eq(facts.touches, 1);
  }
}
