/* Ways: each window of directions that a sweep finds is listed, with its kind, and direct aims find
 * those at rails. The kind is read off the events here too, from the ball's side. */
#include "carom_coach.h"
#include "plan_support.h"
#include "pot_kind.h"

/* LEAST, ASKED: directions of the narrowest windows that are listed, of any ball and of one that is
 * requested */
enum { SWEPT = 18000, LEAST = 10, ASKED = 3, ROOM = 300, SPEEDS = 3 };
static const double speed[SPEEDS] = {1.0, 1.5, 2.5};

enum { MOST_WAYS = 20000 };
typedef carom_shot_way way;

/* What was found, and how many. */
static way found[MOST_WAYS];
static int64_t ways;
static carom_cue stroke[SPEEDS];

/* Plays a stroke from the layout; its events and facts are kept until the next one. */
static carom_shot play(const carom_cue *cue_of_stroke) {
  static carom_event events[ROOM];
  static carom_facts facts;
  carom_shot shot = {.events = events, .room = ROOM, .facts = &facts};
  carom_shoot(&table, balls, BALLS, cue_of_stroke, &shot_options, &shot);
  return shot;
}

/* Whether a rail ends within three radii of the pocket. */
static bool is_beside(int rail, int pocket) {
  const carom_rail *r = &table.rail[rail];
  const double *c = table.pocket[pocket].centre;
  return fmin(distance(r->p, c), distance(r->q, c)) < 3.0 * table.pocket[pocket].radius;
}

/* Whether there is no room for the cue ball between the ball at r and a rail. */
static bool is_narrow(int rail, const double *r) {
  const double *p = table.rail[rail].p, *q = table.rail[rail].q, R = balls[0].kind.radius;
  const double across = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return fabs(across) / distance(p, q) < 3.0 * R;
}

/* Whether a ball meets a rail, and no cut; not where it lay at first. */
static bool is_rail(const carom_event *e) {
  return e->type == CAROM_EVENT_RAIL && carom_rail_name(&table, e->b) != NULL &&
         distance(e->before[0].r, balls[e->a].state.r) >= CAROM_RULES_TOUCH;
}

/* The kind of the pot of a ball: who met it first, and what they met before and after. */
static int kind_of(const carom_shot *shot, int ball, int pocket) {
  const double contact_time = shot->facts->first_time[0];
  double time = INFINITY;
  int driver = -1, balls_before = 0, kisses = 0, banks = 0;
  uint32_t earlier = 0;
  for (int64_t k = 0; k < shot->count && k < ROOM; k++) {
    const carom_event *e = &shot->events[k];
    const bool contact = e->type == CAROM_EVENT_BALL_BALL, ours = e->a == ball || e->b == ball;
    const bool rail = is_rail(e);
    if (e->type == CAROM_EVENT_POCKET && e->a == ball)
      break;
    if (contact && ours && (driver < 0 || (e->time == time && e->a == 0))) {
      kisses += driver > 0; /* that was met at the same time */
      driver = e->a == ball ? e->b : e->a;
      time = e->time;
    } else if (contact && ours && e->a != 0 && e->b != 0 && e->time >= time)
      kisses++;
    earlier |= (uint32_t)(rail && e->a == 0 && e->time <= contact_time) << (rail ? e->b : 0);
    balls_before += contact && !ours && (e->a == 0 || e->b == 0) && e->time <= time;
    banks += rail && e->a == ball && driver >= 0 && !is_beside(e->b, pocket);
  }
  if (driver != 0)
    return CAROM_PLAN_COMBINATION;
  if (balls_before > 0)
    return CAROM_PLAN_CAROM;
  if (kisses > 0)
    return CAROM_PLAN_KISS;
  for (int k = 0; k < table.rails && earlier != 0; k++)
    if (earlier == 1U << k && is_narrow(k, balls[ball].state.r))
      return CAROM_PLAN_RAIL_FIRST;
  if (earlier > 0)
    return CAROM_PLAN_KICK;
  return banks > 0 ? CAROM_PLAN_BANK : CAROM_PLAN_POT;
}

/* A ball within 2 R of a rail, some frozen, with the cue ball; or two to four balls anywhere. */
static void make_balls(random_source *r, int layout, bool at_rail) {
  make_layout(test_seed() + (uint64_t)layout, at_rail ? 1 : 3 + layout % 3);
  const double R = balls[0].kind.radius, gap = fmax(0.0, random_between(r, -0.4, 2.0)) + 1e-9;
  const bool side = layout / 2 % 2;
  carom_status placed = at_rail ? CAROM_ERROR_BALLS : CAROM_OK;
  while (placed != CAROM_OK) {
    const double along = random_between(r, R, table.width - R);
    placed = place_ball(8, side ? R * (1.0 + gap) : along, side ? 2.0 * along : R * (1.0 + gap));
  }
}

/* Finds the ways of a ball, -1: of all, by the first `strokes` speeds. */
static void find(int strokes, int ball) {
  const carom_player exact = carom_player_of(1.0);
  for (int k = 0; k < SPEEDS; k++) {
    stroke[k] = cue;
    stroke[k].speed = speed[k];
  }
  carom_ways_job search = {.table = &table,
                           .balls = balls,
                           .count = BALLS,
                           .cues = stroke,
                           .strokes = strokes,
                           .player = &exact,
                           .scan = 1800 * strokes,
                           .ball = ball,
                           .pocket = -1,
                           .rails = CAROM_WAY_PARTS,
                           .each = 1,
                           .memory_size = carom_ways_memory(MOST_WAYS)};
  edge space = edge_make(search.memory_size, true);
  carom_ways_result result;
  search.memory = space.memory;
  expect_ok(carom_ways(&search, found, MOST_WAYS, &result));
  ck_assert(result.left_out == 0);
  edge_free(&space);
  ways = result.ways;
}

/* Sweeps the directions of a stroke for a ball: counts the windows, and those that are listed. */
static void compare(int number, int ball, int least, int *windows, int *listed) {
  int pocket[SWEPT + 1], kind[SWEPT + 1], run = 0;
  pocket[SWEPT] = -1;
  for (int k = 0; k < SWEPT; k++) {
    carom_cue aimed = stroke[number];
    aimed.phi = 360.0 / SWEPT * k;
    const carom_shot shot = play(&aimed);
    const carom_facts *f = shot.facts;
    const bool is_repeated = f->touches > 1 && (f->pushed == 0 || f->second_time > 0.0);
    const bool good = !((f->down | f->off) & 1) && !is_repeated && (f->pushed & ~f->frozen) == 0;
    pocket[k] = good ? f->pocket[ball] : -1;
    kind[k] = pocket[k] >= 0 ? kind_of(&shot, ball, pocket[k]) : -1;
  }
  for (int k = 1; k <= SWEPT; k++) {
    run = pocket[k] == pocket[k - 1] && kind[k] == kind[k - 1] ? run + 1 : 0;
    const bool ends = k == SWEPT || pocket[k + 1] != pocket[k] || kind[k + 1] != kind[k];
    if (!ends || run < least || pocket[k] < 0)
      continue;
    const double high = 360.0 / SWEPT * k, low = high - 360.0 / SWEPT * run;
    bool outcome = false;
    for (int n = 0; n < ways; n++) {
      const way *w = &found[n];
      for (double turn = -360.0; turn <= 360.0; turn += 360.0)
        outcome |= w->ball == ball && w->pocket == pocket[k] && w->stroke == number &&
                   w->kind == kind[k] && w->phi[0] + turn <= high && w->phi[1] + turn >= low;
    }
    ++*windows;
    *listed += outcome;
    if (!outcome)
      printf("ball %d to pocket %d by %s, %.1f m/s, %.2f to %.2f degrees: not listed\n", ball,
             pocket[k], carom_word_text(CAROM_WORDS_PLAN_KIND, kind[k]), stroke[number].speed, low,
             high);
  }
}

TEST(every_window_is_a_way) {
  random_source r = {test_seed()};
  const int layouts = 2 * draws_of_test(1, 3);
  int windows = 0, listed = 0;
  for (int layout = 0; layout < layouts; layout++) {
    const bool at_rail = layout % 2;
    make_balls(&r, layout, at_rail);
    find(SPEEDS, at_rail ? 8 : -1);
    for (int ball = 1; ball < BALLS; ball++)
      for (int k = 0; k < SPEEDS && balls[ball].state.label != CAROM_BALL_POCKETED; k++)
        compare(k, ball, at_rail ? ASKED : LEAST, &windows, &listed);
  }
  printf("%d of %d windows are listed\n", listed, windows);
  ck_assert(windows > layouts && listed == windows);
}

/* The kind of a pot has one name: of each way of random layouts `carom ways`, the planner and the
 * reading of this test say the same. */
TEST(a_pot_has_one_name) {
  random_source r = {test_seed()};
  int of_kind[CAROM_PLAN_KINDS] = {0}, all = 0;
  for (int layout = 0; layout < draws_of_test(6, 12); layout++) {
    make_balls(&r, layout, layout % 3 == 0);
    find(SPEEDS, -1);
    for (int n = 0; n < ways; n++) {
      const way *w = &found[n];
      const carom_shot shot = play(&w->cue);
      const int planned = carom_pot_kind(&shot, 0, w->ball, w->pocket);
      const int read = kind_of(&shot, w->ball, w->pocket);
      ck_assert_msg(w->kind == planned && w->kind == read,
                    "layout %d, ball %d at %.3f degrees: ways %s, planner %s, here %s", layout,
                    w->ball, w->cue.phi, carom_word_text(CAROM_WORDS_PLAN_KIND, w->kind),
                    carom_word_text(CAROM_WORDS_PLAN_KIND, planned),
                    carom_word_text(CAROM_WORDS_PLAN_KIND, read));
      of_kind[w->kind]++;
      all++;
    }
  }
  printf("%d ways", all);
  for (int kind = 0; kind < CAROM_PLAN_KINDS; kind++)
    if (of_kind[kind] > 0)
      printf(", %s %d", carom_word_text(CAROM_WORDS_PLAN_KIND, kind), of_kind[kind]);
  puts("");
  ck_assert(of_kind[CAROM_PLAN_POT] > 0 && of_kind[CAROM_PLAN_BANK] > 0 &&
            of_kind[CAROM_PLAN_KICK] > 0 && of_kind[CAROM_PLAN_COMBINATION] > 0 &&
            of_kind[CAROM_PLAN_RAIL_FIRST] > 0);
}

/* Whether the stroke of this direction pots ball 1 into the right side pocket. */
static bool pots_at(double phi, int pocket) {
  carom_cue aimed = stroke[0];
  aimed.phi = phi;
  const carom_facts *f = play(&aimed).facts;
  return f->pocket[1] == pocket && (f->down & 1) == 0;
}

/* Directions end at 360 degrees, where a sweep begins anew: a window across is one way, and its
 * ends are those of the window. */
TEST(a_window_across_zero_degrees) {
  const double side = 1e-3, y = 1.27;
  make_layout(1, 1);
  expect_ok(place_ball(0, 0.4, y));
  expect_ok(place_ball(1, 0.7, y));
  find(1, -1);
  const way *only = NULL;
  for (int n = 0; n < ways; n++) {
    const way *w = &found[n];
    if (w->ball != 1 || w->kind != CAROM_PLAN_POT || fabs(remainder(w->cue.phi, 360.0)) > 20.0)
      continue;
    ck_assert_msg(only == NULL, "the window is listed twice");
    only = w;
  }
  ck_assert(only != NULL && only->phi[0] < 360.0 - 2.0 * side && only->phi[1] > 360.0 + 2.0 * side);
  for (int end = 0; end < 2; end++) {
    const double out = end == 0 ? -side : side;
    ck_assert(pots_at(only->phi[end] - out, only->pocket));
    ck_assert(!pots_at(only->phi[end] + out, only->pocket));
  }
}

/* Whether the cue ball meets a ball directly, or right off one rail. */
static bool is_met_soon(const carom_cue *aimed) {
  const carom_shot shot = play(aimed);
  const carom_event *event = shot.events;
  for (int64_t k = 0; k < shot.count && event[k].time < shot.facts->first_time[0] - 0.1; k++)
    if (event[k].type == CAROM_EVENT_RAIL)
      return false;
  return true;
}

/* Direct aims find each pot above 0.25 degrees of a ball within 2 R of a rail that is met directly
 * or right off a rail, and touches at most rails next to its pocket, but for one in 30. */
TEST(pots_at_rails) {
  random_source r = {test_seed()};
  int pots = 0, falls = 0;
  for (int layout = 0; layout < draws_of_test(20, 60); layout++) {
    make_balls(&r, layout, true);
    find(1, 8);
    for (int n = 0; n < ways; n++) {
      const way *w = &found[n];
      carom_pot pot = {.ball = 8, .pocket = w->pocket};
      carom_cue aimed = stroke[0];
      const bool direct =
          w->kind == CAROM_PLAN_POT || (w->kind == CAROM_PLAN_RAIL_FIRST && w->parts == 1);
      if (!direct || w->phi[1] - w->phi[0] < 0.25 || !is_met_soon(&w->cue))
        continue;
      expect_ok(carom_aim(&table, balls, BALLS, &shot_options, &pot, &aimed));
      pots++;
      falls += pot.outcome == CAROM_POT_FALLS;
      if (pot.outcome != CAROM_POT_FALLS)
        printf("layout %d: pocket %d at %.1f degrees is not aimed at\n", layout, w->pocket,
               w->cue.phi);
    }
  }
  printf("%d of %d pots of balls near a rail are aimed at\n", falls, pots);
  ck_assert(pots > FEWER(6) - 1 && falls >= pots - 1 - pots / 30);
}
