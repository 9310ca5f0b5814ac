/* Plans: rules beside shots written down, choices that no thread and no machine changes, chances
 * beside shots that are played, arguments in error. */
#include "carom_plan.h"
#include "support.h"
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BALLS = 16, SOLIDS = 1, STRIPES = 2 };
static const double per_degree = 3.14159265358979323846 / 180.0;

static carom_table table;
static carom_shot_ball balls[BALLS];
static carom_cue cue;
static carom_player player;
static carom_plan_rules rules;
static carom_plan_options options;
static carom_shot_options shot_options;
static carom_plan_job job;
static edge memory;

/* Balls of eight-ball at random places of which some are down; the seed is the layout's. */
static void make_layout(uint64_t seed, int in_play) {
  random_source r = {seed};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, 1, balls, BALLS);
  for (int k = 0; k < BALLS; k++)
    balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  for (int n = 0; n < in_play; n++) {
    const int k = n == 0 ? 0 : n == 1 ? 8 : n;
    double x, y;
    do { /* one draw after the other: the order of arguments is the compiler's */
      y = random_between(&r, 0.05, 2.49);
      x = random_between(&r, 0.05, 1.22);
    } while (carom_place_ball(&table, balls, BALLS, k, x, y, NULL) != CAROM_OK);
  }
  cue = carom_cue_of(CAROM_GAME_POOL);
  player = carom_player_of(1.0);
  rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  rules.user[0] = SOLIDS;
  options = (carom_plan_options){.shots = 300};
  shot_options = (carom_shot_options){0};
  job = (carom_plan_job){.table = &table,
                         .balls = balls,
                         .count = BALLS,
                         .cue = &cue,
                         .player = &player,
                         .rules = &rules,
                         .shot = &shot_options,
                         .options = &options};
}

static void make_memory(void) {
  job.memory_size = carom_plan_memory(&options);
  memory = edge_make(job.memory_size, true);
  job.memory = memory.memory;
}

/* ---- Rules */

typedef struct ruling {
  const char *what;
  int kind;
  uint32_t in_play, down;
  int group, first, cushions_after, call, is, foul, leave, group_after;
} ruling;

/* Everything is on the table but for what is said; all that falls goes into pocket 3, which is
 * called. */
TEST(rulings) {
  enum { E = CAROM_RULES_EIGHTBALL, N = CAROM_RULES_NINEBALL, P = CAROM_RULES_POTTING };
  enum {
    KEEP = CAROM_TURN_KEEP,
    PASS = CAROM_TURN_PASS,
    WIN = CAROM_TURN_WIN,
    LOSE = CAROM_TURN_LOSE
  };
  enum { AFTER = CAROM_LEAVE_AFTER, HAND = CAROM_LEAVE_HAND };
  enum {
    CUE_BALL = CAROM_FOUL_CUE_BALL,
    NO_BALL = CAROM_FOUL_NO_BALL,
    FIRST = CAROM_FOUL_FIRST,
    CUSHION = CAROM_FOUL_CUSHION
  };
  static const ruling given[] = {
      {"a solid on an open table", E, 0xffff, 0x0008, 0, 3, 0, 3, KEEP, 0, AFTER, SOLIDS},
      {"a stripe on an open table", E, 0xffff, 0x0400, 0, 10, 2, 10, KEEP, 0, AFTER, STRIPES},
      {"the eight met first on an open table", E, 0xffff, 0, 0, 8, 1, -1, PASS, FIRST, HAND, 0},
      {"an own ball", E, 0xffff, 0x0400, 2, 9, 0, 10, KEEP, 0, AFTER, STRIPES},
      {"an own ball that was not called", E, 0xffff, 0x0400, 2, 9, 0, 11, PASS, 0, AFTER, SOLIDS},
      {"a ball of the other", E, 0xffff, 0x0008, 2, 9, 0, 3, PASS, 0, AFTER, SOLIDS},
      {"the wrong ball first", E, 0xffff, 0x0400, 2, 3, 1, 10, PASS, FIRST, HAND, SOLIDS},
      {"no ball met", E, 0xffff, 0, 1, -1, 0, -1, PASS, NO_BALL, HAND, STRIPES},
      {"no cushion after the contact", E, 0xffff, 0, 1, 3, 0, -1, PASS, CUSHION, HAND, STRIPES},
      {"a safety", E, 0xffff, 0, 1, 3, 1, -1, PASS, 0, AFTER, STRIPES},
      {"the cue ball down too", E, 0xffff, 0x0009, 1, 3, 1, 3, PASS, CUE_BALL, HAND, STRIPES},
      {"the eight too early", E, 0xffff, 0x0100, 1, 3, 1, 8, LOSE, 0, AFTER, SOLIDS},
      {"the eight at last", E, 0xff01, 0x0100, 1, 8, 0, 8, WIN, 0, AFTER, SOLIDS},
      {"the eight at last, not called", E, 0xff01, 0x0100, 1, 8, 0, -1, LOSE, 0, AFTER, SOLIDS},
      {"the eight with the cue ball", E, 0xff01, 0x0101, 1, 8, 0, 8, LOSE, CUE_BALL, AFTER, SOLIDS},
      {"the lowest ball", N, 0x03f9, 0x0008, 0, 3, 0, -1, KEEP, 0, AFTER, 0},
      {"another ball by the lowest", N, 0x03f9, 0x0080, 0, 3, 0, -1, KEEP, 0, AFTER, 0},
      {"not the lowest first", N, 0x03f9, 0x0080, 0, 4, 0, -1, PASS, FIRST, HAND, 0},
      {"the nine by the lowest", N, 0x03f9, 0x0200, 0, 3, 0, -1, WIN, 0, AFTER, 0},
      {"the nine by a foul", N, 0x03f9, 0x0200, 0, 4, 0, -1, PASS, FIRST, HAND, 0},
      {"the eight, where the nine is down", N, 0x01f9, 0x0100, 0, 3, 0, -1, WIN, 0, AFTER, 0},
      {"a pot of the drill", P, 0x000f, 0x0004, 0, 1, 0, -1, KEEP, 0, AFTER, 0},
      {"the last ball of the drill", P, 0x0005, 0x0004, 0, 2, 0, -1, WIN, 0, AFTER, 0},
      {"a miss of the drill", P, 0x000f, 0, 0, 1, 3, -1, PASS, 0, AFTER, 0},
  };
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const ruling *g = &given[k];
    carom_facts facts = {
        .first = {g->first, -1}, .cushions_after = g->cushions_after, .down = g->down};
    for (int i = 0; i < CAROM_BALLS_MOST; i++)
      facts.pocket[i] = g->down >> i & 1 ? 3 : -1;
    carom_plan_rules of = carom_plan_rules_of((carom_rules_kind)g->kind);
    of.user[0] = (uint64_t)g->group;
    const carom_turn turn =
        of.judge(of.user, g->in_play, 0, &facts, (carom_call){g->call, g->call < 0 ? -1 : 3});
    ck_assert_msg((int)turn.is == g->is && turn.foul == g->foul && (int)turn.leave == g->leave &&
                      of.user[0] == (uint64_t)g->group_after,
                  "%s: turn %d, foul %d, leave %d, group %d", g->what, (int)turn.is, turn.foul,
                  (int)turn.leave, (int)of.user[0]);
  }
  ck_assert_str_eq(carom_rules_name(CAROM_RULES_NINEBALL), "nineball");
  ck_assert_ptr_null(carom_rules_name((carom_rules_kind)7));
}

/* A break of eight-ball: one is enough, the table is open whatever falls, and the eight comes
 * back. */
TEST(breaks_of_eightball) {
  static const struct {
    uint32_t down;
    int driven, is, leave;
    uint32_t spot;
  } given[] = {{0, 4, CAROM_TURN_PASS, CAROM_LEAVE_AFTER, 0},
               {0, 3, CAROM_TURN_PASS, CAROM_LEAVE_HAND, 0},
               {0x0008, 0, CAROM_TURN_KEEP, CAROM_LEAVE_AFTER, 0},
               {0x0100, 0, CAROM_TURN_KEEP, CAROM_LEAVE_AFTER, 0x0100},
               {0x0001, 4, CAROM_TURN_PASS, CAROM_LEAVE_KITCHEN, 0}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    carom_facts facts = {.first = {1, -1}, .cushions_after = given[k].driven};
    facts.down = given[k].down;
    for (int i = 1; i <= given[k].driven; i++)
      facts.cushions[i] = 1;
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
    of.user[1] = 1;
    const carom_turn turn = of.judge(of.user, 0xffff, 0, &facts, (carom_call){-1, -1});
    ck_assert_msg((int)turn.is == given[k].is && (int)turn.leave == given[k].leave &&
                      turn.spot == given[k].spot,
                  "break %zu: turn %d, leave %d", k, (int)turn.is, (int)turn.leave);
    ck_assert(of.user[0] == 0 && of.user[1] == 0);
  }
}

/* A stroke of nine-ball that meets a ball and drives so many to cushions, after which ball `down`
 * is down, or none for -1. */
static carom_turn nine(carom_plan_rules *of, int first, int driven, int down, int call) {
  carom_facts facts = {.first = {first, -1}, .cushions_after = driven};
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    facts.pocket[k] = -1;
  for (int k = 1; k <= driven; k++)
    facts.cushions[k] = 1;
  facts.down = down >= 0 ? UINT32_C(1) << down : 0;
  return of->judge(of->user, 0x3ff, 0, &facts, (carom_call){call, -1});
}

/* The third foul of a player in a row loses; a legal stroke in between forgets them. */
TEST(three_fouls) {
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  for (int stroke = 0; stroke < 4; stroke++) { /* of each player two */
    ck_assert_int_eq(nine(&of, -1, 0, -1, -1).is, CAROM_TURN_PASS);
    ck_assert_uint_eq(of.user[3], (uint64_t)(stroke / 2 + 1));
  }
  carom_plan_rules other = of;
  const carom_turn third = nine(&of, 2, 1, -1, -1);
  ck_assert(third.is == CAROM_TURN_LOSE && third.foul == CAROM_FOUL_FIRST);
  ck_assert(nine(&other, 1, 1, -1, -1).foul == CAROM_FOUL_NONE && other.user[3] == 0);
  ck_assert_uint_eq(other.user[2], 2);
}

/* After a break without a foul one may push out, and the other may then pass. */
TEST(push_outs) {
  carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_NINEBALL), again;
  of.user[1] = 1;
  again = of;
  ck_assert(nine(&again, 1, 3, -1, -1).foul == CAROM_FOUL_BREAK && again.may(again.user) == 0);
  ck_assert_int_eq(nine(&of, 1, 4, -1, -1).is, CAROM_TURN_PASS);
  ck_assert_uint_eq(of.may(of.user), CAROM_MAY_PUSH);

  /* a push-out meets what it likes; what falls stays down, but for the nine */
  again = of;
  carom_turn turn = nine(&again, -1, 0, -1, CAROM_CALL_PUSH);
  ck_assert(turn.is == CAROM_TURN_PASS && turn.foul == 0 && turn.leave == CAROM_LEAVE_AFTER);
  ck_assert_uint_eq(again.may(again.user), CAROM_MAY_PASS);
  again = of;
  turn = nine(&again, 5, 0, 9, CAROM_CALL_PUSH);
  ck_assert(turn.is == CAROM_TURN_PASS && turn.foul == 0 && turn.spot == 0x200);
  again = of;
  turn = nine(&again, 5, 0, 0, CAROM_CALL_PUSH);
  ck_assert(turn.foul == CAROM_FOUL_CUE_BALL && again.may(again.user) == 0);

  /* the other passes, and neither may do so again; without the right, a push-out is a stroke */
  nine(&of, -1, 0, -1, CAROM_CALL_PUSH);
  turn = nine(&of, -1, 0, -1, CAROM_CALL_PASS);
  ck_assert(turn.is == CAROM_TURN_PASS && turn.foul == 0 && turn.leave == CAROM_LEAVE_AFTER);
  ck_assert_uint_eq(of.may(of.user), 0);
  ck_assert_int_eq(nine(&of, -1, 0, -1, CAROM_CALL_PUSH).foul, CAROM_FOUL_NO_BALL);
}

/* Balls on the foot spot, then behind it, then, where there is no room behind it, before it. */
TEST(spots) {
  make_layout(1, 1);
  carom_place_ball(&table, balls, BALLS, 0, 0.2, 0.2, NULL);
  double least = INFINITY, most = 0.0;
  for (int k = 1; k < BALLS; k++) {
    ck_assert_int_eq(carom_spot_ball(&table, balls, BALLS, k), CAROM_OK);
    ck_assert(balls[k].state.r[0] == 0.5 * table.width);
    least = fmin(least, balls[k].state.r[1]);
    most = fmax(most, balls[k].state.r[1]);
  }
  ck_assert(balls[1].state.r[1] == 0.75 * table.length &&
            balls[2].state.r[1] > 0.75 * table.length);
  ck_assert(least < 0.75 * table.length - 0.1 && most < table.length - 0.028);

  /* on a long table the search has longer steps, a ten-thousandth of it */
  const carom_corner corner[] = {
      {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 40.0, 0.0}, {0.0, 40.0, 0.0}};
  carom_table alley;
  ck_assert_int_eq(carom_table_polygon(corner, 4, 0.0365, 0.0, 0.028575, &alley, NULL), CAROM_OK);
  for (int k = 0; k < BALLS; k++)
    ck_assert_int_eq(carom_spot_ball(&alley, balls, BALLS, k), CAROM_OK);
  const double second = balls[1].state.r[1] - (30.0 + 2.0 * 0.028575);
  ck_assert(balls[0].state.r[1] == 30.0 && second > -1e-6 && second < 4e-3);
  ck_assert_int_eq(carom_spot_ball(NULL, balls, BALLS, 1), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_spot_ball(&table, balls, BALLS, BALLS), CAROM_ERROR_BALLS);
}

/* ---- Choices */

/* The choices of 20 layouts, by plain: the same hash on all machines, with one thread and with
 * two. Where a change of the method or of the physics is meant to change them, the new hash is
 * the one that this test prints. */
TEST(golden_choices) {
  static const uint64_t golden = UINT64_C(0x730b84601e24533b);
  uint64_t h = UINT64_C(0xcbf29ce484222325);
  int pots = 0;
  for (int k = 0; k < 20; k++) {
    carom_choice choices[2][3];
    int found[2];
    make_layout((uint64_t)k + 1, 2 + k % 8);
    options.seed = (uint64_t)k;
    if (k % 5 == 4)
      rules = carom_plan_rules_of(k % 2 == 0 ? CAROM_RULES_NINEBALL : CAROM_RULES_POTTING);
    make_memory();
    for (int threads = 0; threads < 2; threads++) {
      options.threads = 2 * threads;
      ck_assert_int_eq(k % 4 == 3
                           ? carom_plan_hand(&job, NULL, NULL, choices[threads], 3, &found[threads])
                           : carom_plan(&job, choices[threads], 3, &found[threads]),
                       CAROM_OK);
    }
    ck_assert_int_eq(found[0], found[1]);
    ck_assert_int_eq(memcmp(choices[0], choices[1], (size_t)found[0] * sizeof choices[0][0]), 0);
    const carom_choice *best = &choices[0][0];
    ck_assert(best->value >= 0.0 && best->value <= 1.0 && best->error >= 0.0 && best->seen > 0);
    ck_assert(found[0] == 1 || best->value >= choices[0][1].value);
    pots += best->ball > 0;
    h = hash_of(h, choices[0], (size_t)found[0] * sizeof choices[0][0]);
    edge_free(&memory);
  }
  printf("choices of 20 layouts: 0x%016llx; %d pot\n", (unsigned long long)h, pots);
  ck_assert_int_gt(pots, 10);
  ck_assert_msg(h == golden, "the choices are others: 0x%016llx", (unsigned long long)h);
}

/* A stroke may be between those of the grid: then its speed or its tip is. */
TEST(strokes_between_those_of_the_grid) {
  static const double grid[] = {0.8, 1.2, 1.7, 2.4, 3.4, 4.8, 1.0, 1.8, 3.0, 5.0, 7.5},
                      tips[] = {0.0, 0.25, 0.3, 0.35};
  enum { SPEEDS = sizeof grid / sizeof grid[0], TIPS = sizeof tips / sizeof tips[0] };
  int between = 0;
  for (int k = 0; k < 20; k++) {
    carom_choice best;
    int found;
    make_layout((uint64_t)k + 1, 8);
    options.shots = 1000;
    make_memory();
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    edge_free(&memory);
    int of_grid = 0;
    for (int n = 0; n < SPEEDS; n++)
      of_grid += fabs(best.cue.speed * 0.5 * (1.0 + cue.tip_restitution) - grid[n]) < 1e-9;
    for (int n = 0; n < TIPS; n++)
      of_grid +=
          (fabs(fabs(best.cue.a) - tips[n]) < 1e-9) + (fabs(fabs(best.cue.b) - tips[n]) < 1e-9);
    between += of_grid < 3;
  }
  printf("%d of 20 strokes are between those of the grid\n", between);
  ck_assert(between >= 4 && between < 20);
}

/* A player plays as well with any tip: his strokes give the ball the same speeds, and a plan finds
 * the same choices, by cues that are faster by 2/(1 + e). */
TEST(players_of_any_tip) {
  static const double gain = 2.0 / (1.0 + CAROM_TIP_LEATHER);
  carom_choice choices[2][3];
  int found[2];
  for (int tip = 0; tip < 2; tip++) {
    make_layout(17, 3);
    cue.tip_restitution = tip == 0 ? 1.0 : CAROM_TIP_LEATHER;
    make_memory();
    ck_assert_int_eq(carom_plan(&job, choices[tip], 3, &found[tip]), CAROM_OK);
    edge_free(&memory);
  }
  ck_assert_int_eq(found[0], found[1]);
  const carom_choice *a = &choices[0][0], *b = &choices[1][0];
  ck_assert_double_eq_tol(b->cue.speed, gain * a->cue.speed, 1e-12);
  ck_assert_double_eq_tol(b->cue.phi, a->cue.phi, 1e-9);
  ck_assert_double_eq_tol(b->value, a->value, 0.01);

  /* strokes; at the default bounds too */
  for (uint64_t n = 0; n < 200; n++) {
    const carom_player errs = carom_player_of(n < 100 ? 1.0 : 40.0);
    double speed[2];
    for (int tip = 0; tip < 2; tip++) {
      cue = carom_cue_of(CAROM_GAME_POOL);
      cue.tip_restitution = tip == 0 ? 0.0 : CAROM_TIP_LEATHER;
      cue.speed = 3.0 * (tip == 0 ? 1.0 : gain);
      carom_player_strike(&errs, 7, n, &cue);
      speed[tip] = cue.speed;
    }
    ck_assert_double_eq_tol(speed[1], gain * speed[0], 1e-14);
  }
}

/* Errors fall with the rating, evenly between its steps, and stay beyond the ends. */
TEST(ratings) {
  double last = INFINITY;
  for (int rating = 300; rating <= 850; rating += 5) {
    const carom_player p = carom_player_fargo(rating);
    ck_assert(p.phi < last && p.phi > 0.0 && p.phi == p.speed && p.a == p.b);
    last = p.phi;
  }
  ck_assert(carom_player_fargo(200.0).phi == carom_player_fargo(300.0).phi);
  ck_assert(carom_player_fargo(900.0).phi == last);
  const double half = carom_player_fargo(525.0).phi,
               ends = carom_player_fargo(500.0).phi + carom_player_fargo(550.0).phi;
  ck_assert(fabs(half - 0.5 * ends) < 1e-15);
}

/* A player's strokes have his errors, and stay within his bounds. */
TEST(strokes_err) {
  enum { STROKES = 4000 };
  const carom_player wild = {.speed = 0.3, .speed_share = 0.2, .phi = 2.0, .b = 0.4};
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < STROKES; k++) {
    carom_cue made = {.speed = 2.0, .phi = 30.0, .theta = 5.0, .a = 0.1, .b = 0.2}, again = made;
    carom_player_strike(&wild, test_seed(), (uint64_t)k, &made);
    carom_player_strike(&wild, test_seed(), (uint64_t)k, &again);
    ck_assert(memcmp(&made, &again, sizeof made) == 0);
    ck_assert(made.speed >= 0.5 && made.speed <= 8.0 && fabs(made.b) <= 0.5);
    ck_assert(made.theta == 5.0 && made.a == 0.1);
    sum += made.phi - 30.0;
    squares += (made.speed - 2.0) * (made.speed - 2.0);
  }
  /* 0.3 and 0.2 of 2 m/s make 0.5; five standard errors */
  ck_assert(fabs(sum / STROKES) < 5.0 * 2.0 / sqrt(STROKES));
  ck_assert(fabs(sqrt(squares / STROKES) - 0.5) < 5.0 * 0.5 / sqrt(2.0 * STROKES));

  /* a bound that is beyond the other one's default */
  const carom_player slow = {.speed_most = 0.3}, fast = {.speed_least = 9.0};
  carom_cue made[2] = {{.speed = 0.1}, {.speed = 10.0}};
  carom_player_strike(&slow, 1, 1, &made[0]);
  carom_player_strike(&fast, 1, 1, &made[1]);
  ck_assert(made[0].speed == 0.3 && made[1].speed == 9.0);
}

/* The chance to play on is that of shots which are played with errors of other seeds, within
 * four standard errors. */
TEST(chances_are_kept) {
  for (int k = 0; k < 6; k++) {
    make_layout(test_seed() + (uint64_t)k, 8);
    options.shots = 1000;
    make_memory();
    carom_choice best, again;
    int found;
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    options.seed = 77;
    ck_assert_int_eq(carom_plan_try(&job, &best.cue, 1, &again), CAROM_OK);
    ck_assert(again.ball == best.ball && again.pocket == best.pocket &&
              again.kind == CAROM_PLAN_GIVEN);
    ck_assert_int_eq(again.seen, 1000);
    const double p = again.keep, n = (double)best.seen, least = 0.5 / n;
    const double error = sqrt((p * (1.0 - p) + least) * (1.0 / n + 1e-3));
    /* the best of many is chosen because it was lucky, too: at most by a third of the way to 1 */
    ck_assert_msg(best.keep - p < 4.0 * error + 0.05 && p - best.keep < 4.0 * error,
                  "%g after %lld, %g after 1000", best.keep, (long long)best.seen, p);
    edge_free(&memory);
  }
}

/* The chances that plans tell are those of the same strokes with other errors: in the mean of 60
 * layouts within 0.02. The shots that chose them tell more. */
TEST(luck_of_the_choice) {
  enum { LAYOUTS = 60 };
  double more = 0.0, luck = 0.0;
  for (uint64_t k = 0; k < LAYOUTS; k++) {
    make_layout(k + 1, 7);
    player = carom_player_of(3.0);
    make_memory();
    carom_choice best, again;
    int found;
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    options.seed = 77;
    ck_assert_int_eq(carom_plan_try(&job, &best.cue, 1, &again), CAROM_OK);
    more += (best.value - again.value) / LAYOUTS;
    luck += 0.75 * best.error / LAYOUTS;
    edge_free(&memory);
  }
  ck_assert_msg(fabs(more) < 0.02 && more + luck > 0.02, "told %+.4f more, with luck %+.4f", more,
                more + luck);
}

/* The pots of strokes without errors: the ball that falls first is named, in nine-ball whichever it
 * is, in eight-ball of those that are on; and only a ball that falls. Strokes in which the lowest
 * ball of those that fall is not the first are among them. */
TEST(the_first_ball_that_falls) {
  enum { CUES = 40 };
  int named = 0, second = 0, others = 0;
  for (int layout = 0; layout < 40; layout++) {
    make_layout((uint64_t)layout, 10);
    rules = carom_plan_rules_of(layout % 2 == 0 ? CAROM_RULES_NINEBALL : CAROM_RULES_EIGHTBALL);
    player = carom_player_of(0.0);
    uint32_t in_play = 0;
    for (int i = 0; i < BALLS; i++)
      in_play |= (uint32_t)(balls[i].state.label != CAROM_BALL_POCKETED) << i;
    const uint32_t on = rules.on(rules.user, in_play);
    carom_cue cues[CUES];
    carom_choice told[CUES];
    for (int k = 0; k < CUES; k++) {
      cues[k] = cue;
      cues[k].speed = 7.0;
      cues[k].phi = 9.0 * k;
    }
    make_memory();
    ck_assert_int_eq(carom_plan_try(&job, cues, CUES, told), CAROM_OK);
    edge_free(&memory);

    /* the first by the facts, and whether a later one has a lower number */
    for (int k = 0; k < CUES; k++) {
      carom_facts facts;
      carom_ball_state final[BALLS];
      carom_shot shot = {.final = final, .facts = &facts};
      ck_assert_int_eq(carom_shoot(&table, balls, BALLS, &cues[k], &shot_options, &shot), CAROM_OK);
      const uint32_t down = facts.down & (rules.calls ? on : 0xfffe);
      int first = -1;
      for (int i = 1; i < BALLS; i++)
        if ((down >> i & 1) && (first < 0 || facts.pocket_time[i] < facts.pocket_time[first]))
          first = i;
      const carom_call call = {first, first < 0 ? -1 : facts.pocket[first]};
      carom_plan_rules of = rules;
      const carom_turn turn = of.judge(of.user, in_play, 0, &facts, call);
      const bool keeps = turn.is == CAROM_TURN_KEEP || turn.is == CAROM_TURN_WIN;
      const int ball = keeps ? first : -1;
      ck_assert_msg(told[k].ball == ball && told[k].pocket == (ball < 0 ? -1 : call.pocket),
                    "layout %d, stroke %d: ball %d is named, %d fell first", layout, k,
                    told[k].ball, ball);
      ck_assert(told[k].keep == keeps);
      named += ball >= 0;
      second += ball >= 0 && (down & ((UINT32_C(1) << ball) - 1)) != 0;
      others += ball >= 0 && !(on >> ball & 1);
    }
  }
  printf("%d pots named, %d before one of a lower number, %d of balls that were not on\n", named,
         second, others);
  ck_assert(named > 40 && second > 3 && others > 3);
}

/* Nine-ball, with the one in line with the nine before a pocket: the choice names the nine, and is
 * no direct pot. A choice that keeps the turn in most strokes names a ball, but for a break. The
 * choices are of different pots, and sorted by their values. */
TEST(what_is_named_falls) {
  carom_choice best[5];
  int found;
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_place_ball(&table, balls, BALLS, 0, 0.6, 0.6, NULL);
  carom_place_ball(&table, balls, BALLS, 1, 0.2, 0.2, NULL);
  carom_place_ball(&table, balls, BALLS, 9, 0.12, 0.12, NULL);
  job.count = 10;
  make_memory();
  ck_assert_int_eq(carom_plan(&job, best, 5, &found), CAROM_OK);
  ck_assert_msg(best[0].ball == 9 && best[0].kind == CAROM_PLAN_COMBINATION && best[0].keep > 0.8,
                "ball %d, kind %d, keep %g", best[0].ball, best[0].kind, best[0].keep);
  edge_free(&memory);

  int without = 0, pots = 0;
  for (int k = 0; k < 12; k++) {
    make_layout((uint64_t)k + 1, 10);
    rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    make_memory();
    ck_assert_int_eq(carom_plan(&job, best, 5, &found), CAROM_OK);
    for (int n = 0; n < found; n++) {
      const bool aimed = best[n].kind == CAROM_PLAN_POT;
      ck_assert(best[n].seen > 0 && (n == 0 || best[n].value <= best[n - 1].value));
      for (int m = 0; m < n; m++)
        ck_assert(best[n].ball != best[m].ball || best[n].pocket != best[m].pocket ||
                  best[n].kind != best[m].kind);
      without += best[n].ball < 0 && best[n].keep > 0.5;
      pots += aimed && best[n].ball < 0;
    }
    edge_free(&memory);
  }
  ck_assert_msg(without == 0 && pots == 0, "%d keep the turn and name no ball, %d pots of none",
                without, pots);
}

/* The distance from a point to the axis of the stick behind the tip, and how far behind it is. */
static double off_axis(const carom_cue *c, const double p[3], double *behind) {
  const double R = balls[0].kind.radius, t = c->theta * per_degree, f = c->phi * per_degree;
  const double u[3] = {cos(t) * cos(f), cos(t) * sin(f), -sin(t)}, left[3] = {-sin(f), cos(f), 0.0},
               up[3] = {sin(t) * cos(f), sin(t) * sin(f), cos(t)};
  double d[3], along = 0.0, square = 0.0;
  for (int x = 0; x < 3; x++) {
    d[x] = p[x] - balls[0].state.r[x] - R * (c->a * left[x] + c->b * up[x]);
    along += d[x] * u[x];
  }
  for (int x = 0; x < 3; x++)
    square += (d[x] - along * u[x]) * (d[x] - along * u[x]);
  *behind = -along;
  return sqrt(square);
}

/* The radius of a stick of usual make, less 0.2 mm. */
static double stick_at(double behind) {
  return 0.0063 + 0.0055 * behind;
}

/* The point of a rail, or of the circle of a jaw, at a share of it. */
static void point_of_nose(const carom_rail *rail, const carom_jaw *jaw, double share,
                          double point[3]) {
  const double turn = share * 360.0 * per_degree;
  for (int k = 0; k < 2; k++)
    point[k] = rail != NULL ? rail->p[k] + share * (rail->q[k] - rail->p[k])
                            : jaw->centre[k] + jaw->radius * (k == 0 ? cos(turn) : sin(turn));
  point[2] = rail != NULL ? rail->height : jaw->height;
}

/* Whether a stick is over all balls and noses: by points of the noses behind the ball. */
static bool is_clear(const carom_cue *stick) {
  bool clear = true;
  double behind;
  for (int i = 1; i < BALLS; i++)
    if (balls[i].state.label != CAROM_BALL_POCKETED) {
      const double off = off_axis(stick, balls[i].state.r, &behind);
      clear &= behind < 0.0 || behind > 1.4 || off > balls[i].kind.radius + stick_at(behind);
    }
  for (int of = 0; of < table.rails + table.jaws; of++)
    for (int part = 0; part <= 2000; part++) {
      const carom_rail *rail = of < table.rails ? &table.rail[of] : NULL;
      double nose[3];
      point_of_nose(rail, rail == NULL ? &table.jaw[of - table.rails] : NULL, part / 2000.0, nose);
      const double off = off_axis(stick, nose, &behind);
      clear &= behind < 0.0 || behind > 1.4 || off > stick_at(behind);
    }
  return clear;
}

/* The kind of a choice is that of the stroke without errors, where the ball falls in it: by its
 * facts. Where most strokes with errors pot nothing, the ball that is named falls in it. The stick
 * is over all balls and noses, also of balls before a cushion and another ball; and no choice is
 * raised more than it has to be: raised by a degree less, the stick touches. */
TEST(kinds_and_sticks) {
  enum { KINDS = CAROM_PLAN_SAFETY + 1 };
  int of_kind[KINDS] = {0}, raised = 0, seldom = 0;
  for (int k = 0; k < 24; k++) {
    carom_choice best[5];
    int found;
    make_layout((uint64_t)k + 1, 10);
    if (k % 2 == 0)
      rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    if (k % 3 == 0)
      carom_place_ball(&table, balls, BALLS, 0, 0.4, 0.03, NULL);
    if (k % 3 == 1)
      carom_place_ball(&table, balls, BALLS, 7, balls[0].state.r[0] + 0.07,
                       balls[0].state.r[1] - 0.04, NULL);
    make_memory();
    ck_assert_int_eq(carom_plan(&job, best, 5, &found), CAROM_OK);
    for (int n = 0; n < found; n++) {
      const carom_choice *c = &best[n];
      carom_facts facts;
      carom_shot shot = {.facts = &facts};
      carom_shoot(&table, balls, BALLS, &c->cue, &shot_options, &shot);
      of_kind[c->kind]++;
      ck_assert((c->kind == CAROM_PLAN_SAFETY) == (c->ball < 0 && c->kind != CAROM_PLAN_FOUL));
      seldom += c->ball > 0 && c->keep < 0.5;
      ck_assert(c->ball <= 0 || c->keep >= 0.5 || facts.pocket[c->ball] == c->pocket);
      if (c->ball > 0 && facts.pocket[c->ball] == c->pocket) {
        const bool kick = facts.cushions_before[0] > 0, first = facts.first[0] == c->ball;
        ck_assert(c->kind != CAROM_PLAN_POT || (first && !kick));
        ck_assert(c->kind != CAROM_PLAN_BANK || (first && !kick && facts.cushions[c->ball] > 0));
        ck_assert(c->kind != CAROM_PLAN_KICK || (first && kick));
        ck_assert(c->kind != CAROM_PLAN_COMBINATION || !first);
        ck_assert(c->kind != CAROM_PLAN_CAROM || !first);
      }

      ck_assert(c->cue.theta >= 0.0 && c->cue.theta <= 60.0);
      for (int lower = 0; lower < 2; lower++) {
        carom_cue stick = c->cue;
        stick.theta -= lower ? 1.0 : 0.0;
        if (stick.theta < 0.0)
          continue;
        ck_assert_msg(lower != is_clear(&stick), "layout %d, choice %d: raised by %g, %d", k, n,
                      c->cue.theta, lower);
        raised += !lower && c->cue.theta > 5.0;
      }
    }
    edge_free(&memory);
  }
  for (int kind = 0; kind < KINDS; kind++)
    printf("kind %d: %d\n", kind, of_kind[kind]);
  printf("%d pot in less than half of the strokes\n", seldom);
  ck_assert(raised > 10 && seldom > 10 && of_kind[CAROM_PLAN_POT] > 10 &&
            of_kind[CAROM_PLAN_BANK] > 0 && of_kind[CAROM_PLAN_KICK] > 0 &&
            of_kind[CAROM_PLAN_SAFETY] > 0);
}

/* By a level cue each choice is level, where the stick had to be raised. */
TEST(a_level_cue) {
  int raised = 0;
  for (int k = 0; k < 8; k++) {
    carom_choice best[5];
    int found;
    make_layout((uint64_t)k + 1, 10);
    carom_place_ball(&table, balls, BALLS, 0, 0.4, 0.03, NULL);
    for (options.level = 0; options.level < 2; options.level++) {
      make_memory();
      ck_assert(carom_plan(&job, best, 5, &found) == CAROM_OK && found > 0);
      for (int n = 0; n < found; n++) {
        raised += best[n].cue.theta > 1.0;
        ck_assert(best[n].cue.theta == 0.0 || !options.level);
      }
      edge_free(&memory);
    }
    options.level = 0;
  }
  ck_assert_int_gt(raised, 10);
}

/* Three-cushion: what is a point; and plans of it, whose chances are those of strokes with errors
 * of another seed, and whose ball is the one that is met first. */
TEST(three_cushion) {
  static const struct {
    int second, before;
    uint32_t off;
    int is;
  } given[] = {{2, 3, 0, CAROM_TURN_KEEP},
               {2, 7, 0, CAROM_TURN_KEEP},
               {2, 2, 0, CAROM_TURN_PASS},
               {-1, 0, 0, CAROM_TURN_PASS},
               {2, 3, 4, CAROM_TURN_PASS}};
  for (size_t k = 0; k < sizeof given / sizeof given[0]; k++) {
    const carom_facts facts = {.first = {1, given[k].second},
                               .cushions_before = {1, given[k].before},
                               .off = given[k].off};
    carom_plan_rules of = carom_plan_rules_of(CAROM_RULES_THREECUSHION);
    const carom_turn turn = of.judge(of.user, 7, 0, &facts, (carom_call){-1, -1});
    ck_assert((int)turn.is == given[k].is && turn.points == (given[k].is == CAROM_TURN_KEEP));
    ck_assert_int_eq(turn.foul, given[k].off ? CAROM_FOUL_OFF : CAROM_FOUL_NONE);
  }

  random_source r = {3};
  double sum = 0.0;
  for (int k = 0; k < 4; k++) {
    carom_choice best[5], again;
    int found;
    make_layout(1, 1);
    carom_table_make(CAROM_TABLE_THREECUSHION, &table);
    carom_rack(CAROM_RACK_THREECUSHION, &table, 0.0, 0, balls, 3);
    for (int ball = 0; ball < 3 && k > 0; ball++) {
      double x, y;
      do {
        x = random_between(&r, 0.05, 1.37);
        y = random_between(&r, 0.05, 2.79);
      } while (carom_place_ball(&table, balls, 3, ball, x, y, NULL) != CAROM_OK);
    }
    cue = carom_cue_of(CAROM_GAME_BILLIARD);
    rules = carom_plan_rules_of(CAROM_RULES_THREECUSHION);
    job.count = 3;
    options.shots = 1000;
    make_memory();
    ck_assert_int_eq(carom_plan(&job, best, 5, &found), CAROM_OK);
    options.seed = 77;
    ck_assert_int_eq(carom_plan_try(&job, &best[0].cue, 1, &again), CAROM_OK);
    const double p = again.keep, n = (double)best[0].seen;
    const double told = fmax(best[0].keep - 0.75 * best[0].error, 0.0);
    ck_assert(fabs(best[0].value - told) < 1e-12 && best[0].pocket == -1);
    ck_assert(again.value == again.keep);
    ck_assert(fabs(best[0].keep - p) < 0.05 + 4.0 * sqrt((p * (1.0 - p) + 0.5 / n) / n));
    for (int i = 0; i < found; i++) {
      carom_facts facts;
      carom_shot shot = {.facts = &facts};
      carom_shoot(&table, balls, 3, &best[i].cue, &shot_options, &shot);
      const bool point = facts.first[1] >= 0 && facts.cushions_before[1] >= 3;
      ck_assert(!point || best[i].ball == facts.first[0]);
      ck_assert(!point || (best[i].kind == CAROM_PLAN_KICK) == (facts.cushions_before[0] > 0));
      ck_assert(best[i].ball >= 0 || best[i].kind == CAROM_PLAN_SAFETY);
    }
    sum += p;
    edge_free(&memory);
  }
  printf("three-cushion: %g of four strokes score\n", sum);
  ck_assert(sum > 1.5);
}

/* Breaks: the cue ball in hand is put on the head string, a ball that may be met is struck, hard
 * and about full, and few are fouls, also of a weak player, who cannot want one. */
TEST(breaks) {
  for (int k = 0; k < 4; k++) {
    carom_choice best[5];
    int found;
    make_layout(1, 1);
    const bool nine_balls = k % 2 == 1;
    rules = carom_plan_rules_of(nine_balls ? CAROM_RULES_NINEBALL : CAROM_RULES_EIGHTBALL);
    rules.user[1] = 1;
    job.count = nine_balls ? 10 : BALLS;
    carom_rack(nine_balls ? CAROM_RACK_NINEBALL : CAROM_RACK_EIGHTBALL, &table, 1e-4, 1, balls,
               BALLS);
    player = carom_player_fargo(400.0);
    options.shots = 1000;
    make_memory();
    ck_assert_int_eq(k < 2 ? carom_plan_hand(&job, NULL, NULL, best, 5, &found)
                           : carom_plan(&job, best, 5, &found),
                     CAROM_OK);
    for (int n = 0; n < found; n++) {
      ck_assert(best[n].kind == CAROM_PLAN_BREAK && best[n].ball == -1 && best[n].pocket == -1);
      ck_assert(best[n].cue.speed > 5.0 && (k >= 2 || best[n].place[1] == 0.25 * table.length));
      ck_assert(best[n].cue.phi > 45.0 && best[n].cue.phi < 135.0);
    }
    ck_assert_msg(best[0].foul < 0.5, "break %d: foul %g", k, best[0].foul);
    edge_free(&memory);
  }
}

/* ---- Aims */

enum { WAYS = 6, TRIED = 3000, EVENTS = 200 };

/* The way by which ball 8 falls in the direction phi, read off the events: directly, by ball 2,
 * or one of both balls off rails, whose sides have names; false where it falls otherwise or not. */
static bool way_of(double phi, carom_pot *pot) {
  static carom_event events[EVENTS];
  carom_cue c = cue;
  carom_shot shot = {.events = events, .room = EVENTS};
  c.phi = phi;
  carom_shoot(&table, balls, BALLS, &c, &shot_options, &shot);
  *pot = (carom_pot){.ball = 8};
  int on = 0; /* the ball whose turn it is */
  for (int64_t k = 0; k < shot.count && k < EVENTS; k++) {
    const carom_event *e = &events[k];
    const bool contact = e->type == CAROM_EVENT_BALL_BALL;
    if (e->a != on && !(contact && e->b == on))
      continue;
    if (contact && on != 8) {
      on = e->a == on ? e->b : e->a;
      if (on == 0)
        return false;
      /* ball 8 is named after a kick only */
      if (on == 2 || (pot->vias > 0 && pot->via[pot->vias - 1].kind == CAROM_PART_RAIL))
        pot->via[pot->vias++] = (carom_part){CAROM_PART_BALL, on};
    } else if (e->type == CAROM_EVENT_RAIL && on != 2 && pot->vias < 2 &&
               carom_rail_name(&table, e->b) != NULL) {
      pot->via[pot->vias++] = (carom_part){CAROM_PART_RAIL, e->b};
    } else if (e->type == CAROM_EVENT_POCKET && on == 8) {
      pot->pocket = e->b;
      return true;
    } else if (contact || e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW) {
      return false;
    }
  }
  return false;
}

static bool same_way(const carom_pot *a, const carom_pot *b) {
  bool same = a->pocket == b->pocket && a->vias == b->vias;
  for (int k = 0; k < a->vias && same; k++)
    same =
        a->via[k].kind == b->via[k].kind &&
        (a->via[k].kind == CAROM_PART_BALL ? a->via[k].index == b->via[k].index
                                           : strcmp(carom_rail_name(&table, a->via[k].index),
                                                    carom_rail_name(&table, b->via[k].index)) == 0);
  return same;
}

/* 0 direct, 1 a combination, 2 off one rail, 3 off two, 4 and 5 kicks off one and two, -1 none of
 * these. */
static int kind_of(const carom_pot *pot) {
  if (pot->vias == 0)
    return 0;
  const carom_part *last = &pot->via[pot->vias - 1];
  if (last->kind == CAROM_PART_RAIL)
    return pot->via[0].kind == CAROM_PART_RAIL && (pot->vias == 1 || last[-1].kind == last->kind)
               ? 1 + pot->vias
               : -1;
  return last->index == 8 && last[-1].kind == CAROM_PART_RAIL ? 2 + pot->vias
         : last->index == 2 && pot->vias == 1                 ? 1
                                                              : -1;
}

static void make_stroke(random_source *r, uint64_t seed) {
  make_layout(seed, 3);
  cue.tip_restitution = 1.0;
  cue.speed = random_between(r, 1.5, 5.0);
  cue.a = random_between(r, -0.3, 0.3);
  cue.b = random_between(r, -0.3, 0.3);
  cue.theta = fmax(0.0, random_between(r, -20.0, 10.0));
}

/* Ways by which a random direction pots are found, but for a few whose middle of the mouth is out
 * of reach; the ball falls in that direction and within the bounds that are told. */
TEST(aims) {
  random_source r = {test_seed()};
  int found[WAYS][CAROM_POT_REJECTED + 1] = {0};
  const int most = draws_of_each(FEWER(24));
  int asked = 0, inside = 0;
  for (uint64_t seed = 1; seed < 200000; seed++) {
    carom_pot pot;
    make_stroke(&r, test_seed() + seed);
    const double phi =
        atan2(balls[seed % 2 ? 2 : 8].state.r[1] - balls[0].state.r[1],
              balls[seed % 2 ? 2 : 8].state.r[0] - balls[0].state.r[0]) /
            per_degree +
        (seed % 3 == 0 ? random_between(&r, -180.0, 180.0) : random_between(&r, -4.0, 4.0));
    const int kind = way_of(phi, &pot) ? kind_of(&pot) : -1;
    int so_far = 0;
    for (int k = 0; k <= CAROM_POT_REJECTED && kind >= 0; k++)
      so_far += found[kind][k];
    if (kind < 0 || so_far >= most)
      continue;
    carom_cue one = cue;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
    found[kind][pot.is]++;
    if (pot.is != CAROM_POT_FALLS)
      continue;

    ck_assert(pot.margin >= 0.0 && fabs(pot.cut) < 90.0 && pot.phi[0] < pot.phi[1]);
    for (int side = -1; side <= 1; side++)
      for (int of = 0; of < 2; of++) {
        carom_facts facts;
        carom_shot shot = {.facts = &facts};
        carom_cue c = one;
        if (of == 0 && side != 0)
          c.phi = side < 0 ? pot.phi[0] + 1e-6 : pot.phi[1] - 1e-6;
        if (of == 1 && side != 0)
          c.speed = side < 0 ? pot.speed[0] + 1e-6 : pot.speed[1] - 1e-6;
        carom_shoot(&table, balls, BALLS, &c, &shot_options, &shot);
        if (facts.pocket[8] != pot.pocket)
          printf("layout %llu, side %d of %d: does not fall\n", (unsigned long long)seed, side, of);
        inside += facts.pocket[8] == pot.pocket;
        asked++;
      }
  }
  /* beside the bounds a jaw may yet send the ball back, once in a thousand */
  ck_assert_int_ge(inside, asked - 1 - asked / 1000);
  int good = 0, others = 0;
  for (int kind = 0; kind < WAYS; kind++) {
    const int *n = found[kind];
    printf("way %d: %d fall, %d no way, %d barred, %d short, %d rejected\n", kind, n[0], n[1], n[2],
           n[3], n[4]);
    good += n[0];
    others += n[1] + n[2] + n[3] + n[4];
    ck_assert_int_gt(n[0], most / 2);
  }
  /* some six in a hundred; of all ways together, as one way is often drawn few times */
  ck_assert_int_le(others, (good + others) / 10 + 12);
}

/* ---- Aims of a cue that is left to the stick */

/* The least elevation, degrees, of a stick in the cue's direction that is `radius` and more from a
 * point: by halving the distance of the point from the axis. Below 0 for a point that is not below
 * the stick: how far it is from there. */
static double least_over(const carom_cue *c, const double point[3], double radius) {
  const double R = balls[0].kind.radius, f = c->phi * per_degree, *r = balls[0].state.r;
  const double u[2] = {cos(f), sin(f)}, h = point[2] - R;
  const double x = point[0] - r[0] + c->a * R * u[1], y = point[1] - r[1] - c->a * R * u[0];
  const double D = -x * u[0] - y * u[1], L = u[0] * y - u[1] * x;
  const double both = radius + 0.0065 + 0.0055 * D;
  const double off = fmax(fmax(-D, D - 1.47), fabs(L) - both);
  if (off >= 0.0)
    return -off;
  double low = 0.0, high = 90.0;
  for (int k = 0; k < 60; k++) {
    const double theta = 0.5 * (low + high), s = sin(theta * per_degree),
                 t = cos(theta * per_degree), below = c->b * R + D * s - h * t;
    *(copysign(sqrt(below * below + L * L), below) < both ? &low : &high) = theta;
  }
  return high < 1e-9 ? 0.0 : high;
}

/* The same over a point of a nose. */
static double over_nose(const carom_cue *c, const carom_rail *rail, const carom_jaw *jaw,
                        double share) {
  double point[3];
  point_of_nose(rail, jaw, share, point);
  return least_over(c, point, 0.0);
}

/* The same over all points of a nose: the worst of many, and of places beside that, by thirds. */
static double over_points(const carom_cue *c, const carom_rail *rail, const carom_jaw *jaw) {
  enum { POINTS = 1000 };
  double worst = -INFINITY, low = 0.0, high = 0.0;
  for (int k = 0; k <= POINTS; k++) {
    const double least = over_nose(c, rail, jaw, (double)k / POINTS);
    if (least > worst) {
      worst = least;
      low = (rail != NULL ? fmax(k - 1.0, 0.0) : k - 1.0) / POINTS;
      high = (rail != NULL ? fmin(k + 1.0, POINTS) : k + 1.0) / POINTS;
    }
  }
  for (int k = 0; k < 80; k++) {
    const double one = low + (high - low) / 3.0, two = high - (high - low) / 3.0;
    const double at_one = over_nose(c, rail, jaw, one), at_two = over_nose(c, rail, jaw, two);
    *(at_one < at_two ? &low : &high) = at_one < at_two ? one : two;
    worst = fmax(worst, fmax(at_one, at_two));
  }
  return worst;
}

static double least_of_all(const carom_cue *c) {
  double most = 0.0;
  for (int k = 1; k < BALLS; k++)
    if (balls[k].state.label != CAROM_BALL_POCKETED)
      most = fmax(most, least_over(c, balls[k].state.r, balls[k].kind.radius));
  for (int k = 0; k < table.rails; k++)
    most = fmax(most, over_points(c, &table.rail[k], NULL));
  for (int k = 0; k < table.jaws; k++)
    most = fmax(most, over_points(c, NULL, &table.jaw[k]));
  return most;
}

/* Whether an elevation is that of the reference in the cue's direction, or beside it, where the
 * reference jumps. */
static bool is_least(double elevation, carom_cue c) {
  bool good = false;
  const double phi = c.phi;
  for (int side = -1; side <= 1; side++) {
    c.phi = phi + 1e-6 * side;
    good |= fabs(elevation - least_of_all(&c)) < 1e-3;
  }
  return good;
}

/* Aims the eight at a pocket with a cue that is left to the stick. Where it falls, the cue is
 * raised by the least elevation that the reference has, or by more where that jumps; a stick
 * that crosses a nose or a ball is over all; and the stroke pots. A level cue and one that is
 * raised as far by the caller keep their elevation, and are told the same; but a very thin cut may
 * slip through the directions that are tried. Returns whether the stroke falls. */
static bool aims_raised(int pocket, carom_cue *c) {
  carom_pot pot = {.ball = 8, .pocket = pocket}, given = pot;
  carom_cue same;
  carom_facts facts;
  carom_shot shot = {.facts = &facts};
  c->theta = (double)NAN;
  ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, c), CAROM_OK);
  if (pot.is != CAROM_POT_FALLS)
    return false;
  ck_assert(is_least(pot.elevation, *c));
  ck_assert(c->theta >= pot.elevation && c->theta <= 60.0);
  ck_assert(pot.elevation == 0.0 || is_clear(c));
  carom_shoot(&table, balls, BALLS, c, &shot_options, &shot);
  ck_assert_int_eq(facts.pocket[8], pocket);
  for (int level = 0; level < 2; level++) {
    same = *c;
    same.theta = level ? 0.0 : c->theta;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &given, &same), CAROM_OK);
    ck_assert(same.theta == (level ? 0.0 : c->theta));
    if (!level && given.is == CAROM_POT_NO_WAY && fabs(pot.cut) > 80.0)
      continue;
    ck_assert(level || (given.is == CAROM_POT_FALLS && fabs(same.phi - c->phi) < 1e-3));
    if (given.is == CAROM_POT_FALLS)
      ck_assert(is_least(given.elevation, same));
  }
  return true;
}

/* The stick crosses noses at any angle, also almost along them, and over the jaws of pockets. */
TEST(noses_under_the_stick) {
  random_source r = {test_seed()};
  int raised = 0;
  for (int k = 0; k < 400; k++) {
    make_stroke(&r, test_seed() + (uint64_t)k);
    carom_table_make(k % 2 ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, &table);
    carom_place_ball(&table, balls, BALLS, 0, random_between(&r, 0.05, 0.6),
                     random_between(&r, 0.04, 0.4), NULL);
    balls[2].state.label = balls[8].state.label = CAROM_BALL_POCKETED;
    carom_cue one = cue;
    one.phi = random_between(&r, 3.0, 177.0);
    one.a = random_between(&r, -0.6, 0.6);
    one.b = random_between(&r, -0.6, 0.3);
    const double least = carom_least_elevation(&table, balls, BALLS, &one);
    ck_assert_msg(least > 60.0 || fabs(least - least_of_all(&one)) < 1e-5,
                  "raised by %.12g degrees, not %.12g", least, least_of_all(&one));
    raised += least > 1.0 && least < 60.0;
  }
  ck_assert_int_gt(raised, 100);
}

/* Cue balls anywhere, frozen to a rail, and before another ball, which may touch. */
TEST(aims_of_the_stick) {
  random_source r = {test_seed()};
  int falls = 0, raised = 0;
  const int draws = 4 * draws_of_each(FEWER(40));
  for (int k = 0; k < draws; k++) {
    make_stroke(&r, test_seed() + 3000 + (uint64_t)k);
    if (k % 4 == 1)
      carom_place_ball(&table, balls, BALLS, 0, random_between(&r, 0.2, 1.0), balls[0].kind.radius,
                       NULL);
    if (k % 4 > 1) {
      const double far = k % 4 == 2 ? 2.0 * balls[0].kind.radius : random_between(&r, 0.06, 0.5),
                   x = balls[8].state.r[0] - balls[0].state.r[0],
                   y = balls[8].state.r[1] - balls[0].state.r[1];
      carom_place_ball(&table, balls, BALLS, 2, balls[0].state.r[0] - far * x / hypot(x, y),
                       balls[0].state.r[1] - far * y / hypot(x, y), NULL);
    }
    carom_cue one = cue;
    const bool good = aims_raised(k / 4 % 6, &one);
    falls += good;
    raised += good && one.theta > 5.0;
  }
  printf("%d fall, %d of them raised by more than 5 degrees\n", falls, raised);
  ck_assert(falls > draws / 16 && raised > 0);
}

/* The elevation where it begins: balls beside a level stick, which they just touch or do not, and
 * the end of the stick over a cushion. Below the middle it jumps there. */
TEST(where_the_stick_begins_to_touch) {
  int jumps = 0, held = 0;
  for (int k = 0; k < FEWER(120); k++) {
    make_layout(1, 2);
    carom_place_ball(&table, balls, BALLS, 8, 0.4, 2.2, NULL);
    carom_place_ball(&table, balls, BALLS, 0, 0.62, k % 3 == 0 ? 1.6 : 1.7828 + 1e-5 * k, NULL);
    const double R = balls[0].kind.radius, D = 0.1 + 0.002 * k;
    carom_cue one = cue;
    one.speed = 2.5;
    one.a = k % 3 == 0 ? 0.0 : 0.3;
    one.b = k % 2 == 0 ? -0.2 : 0.1;
    ck_assert(aims_raised(2, &one));
    held += one.theta > least_of_all(&one) + 0.1;
    if (k % 3 != 0)
      continue;

    /* the cue ball is too far from the head cushion; then a ball beside the stick */
    ck_assert(one.theta == 0.0);
    const carom_cue level = one;
    for (int inside = 0; inside < 2; inside++) {
      const double f = level.phi * per_degree,
                   L = R + 0.0065 + 0.0055 * D + (inside ? -1e-9 : 1e-9);
      carom_place_ball(&table, balls, BALLS, 2, balls[0].state.r[0] - D * cos(f) - L * sin(f),
                       balls[0].state.r[1] - D * sin(f) + L * cos(f), NULL);
      carom_pot pot = {.ball = 8, .pocket = 2};
      one = level;
      ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
      ck_assert(pot.is == CAROM_POT_FALLS && one.phi == level.phi);
      ck_assert(inside == (pot.elevation > 0.0) || (inside && one.b > 0.0));
      jumps += pot.elevation > 0.5;
      ck_assert(aims_raised(2, &one));
    }
  }
  printf("%d jumps, held %d times\n", jumps, held);
  ck_assert(jumps > 0 && held > 0);
}

/* A ball that touches the cue ball behind it: a tip far below the middle would need more than 60
 * degrees, which is told with the elevation. */
TEST(no_stick_reaches) {
  make_layout(1, 2);
  carom_place_ball(&table, balls, BALLS, 8, 0.4, 2.2, NULL);
  carom_place_ball(&table, balls, BALLS, 0, 0.62, 1.6, NULL);
  carom_pot pot = {.ball = 8, .pocket = 2};
  const double R = balls[0].kind.radius;
  for (int k = 0; k < 3; k++) {
    carom_cue one = cue;
    one.speed = k == 2 ? 8.0 : 2.5;
    one.a = 0.0;
    one.b = k == 0 ? 0.1 : -0.5;
    ck_assert(aims_raised(2, &one));
    carom_place_ball(&table, balls, BALLS, 2,
                     balls[0].state.r[0] - 2.0 * R * cos(one.phi * per_degree),
                     balls[0].state.r[1] - 2.0 * R * sin(one.phi * per_degree), NULL);
    one.theta = (double)NAN;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
    const double least = asin((R + 0.0065 + 0.011 * R - one.b * R) / (2.0 * R)) / per_degree;
    ck_assert_msg(pot.is == (k == 0 ? CAROM_POT_FALLS : CAROM_POT_STICK), "%d: %d", k, pot.is);
    ck_assert_double_eq_tol(pot.elevation, least, 1.0);
    carom_place_ball(&table, balls, BALLS, 2, 1.1, 0.2, NULL);
  }
}

/* Where no aim is found, no direction around the first ball pots it by this way, but for a few
 * layouts in which it falls off the middle of the mouth. */
TEST(no_aims) {
  random_source r = {test_seed()};
  int refused = 0, off_middle = 0;
  const int draws = draws_of_each(FEWER(48));
  for (int k = 0; k < draws; k++) {
    make_stroke(&r, test_seed() + 1000 + (uint64_t)k);
    const int kind = k % WAYS, first = kind == 1 ? 2 : 8;
    carom_pot pot = {.ball = 8, .pocket = (int)random_between(&r, 0.0, 6.0)}, met;
    pot.vias = kind < 2 ? kind : kind < 4 ? kind - 1 : kind - 2;
    for (int via = 0; via < pot.vias; via++)
      pot.via[via] = kind == 1 ? (carom_part){CAROM_PART_BALL, 2}
                     : kind >= 4 && via == pot.vias - 1
                         ? (carom_part){CAROM_PART_BALL, 8}
                         : (carom_part){CAROM_PART_RAIL, (int)random_between(&r, 0.0, 6.0)};
    const carom_pot asked = pot;
    carom_cue one = cue;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
    if (pot.is != CAROM_POT_NO_WAY)
      continue;
    ck_assert(memcmp(&one, &cue, sizeof one) == 0);
    refused++;
    const double x = balls[first].state.r[0] - balls[0].state.r[0],
                 y = balls[first].state.r[1] - balls[0].state.r[1],
                 wide = kind >= 4 ? 180.0
                                  : 8.0 + asin(fmin(1.0, 0.06 / sqrt(x * x + y * y))) / per_degree;
    bool falls = false;
    for (int n = 0; n < TRIED && !falls; n++) {
      const double phi = atan2(y, x) / per_degree + wide * (2.0 * n / TRIED - 1.0);
      falls = way_of(phi, &met) && same_way(&met, &asked);
    }
    off_middle += falls;
  }
  printf("%d ways are refused, by %d the ball falls off the middle\n", refused, off_middle);
  ck_assert_int_le(off_middle, 4); /* one in two hundred refused */
  ck_assert_int_gt(refused, draws / 4);
}

/* Balls in a row before a pocket without jaws: the margin is the half angle at which its circle is
 * seen from the last ball. The longest way has a ball and four before it; the first may touch the
 * cue ball. A stroke that is too weak tells which ball comes to rest. */
TEST(rows_before_a_pocket) {
  for (int others = 0; others <= CAROM_VIA_MOST; others++) {
    make_layout(1, 1);
    table.jaws = 0;
    const carom_pocket *pocket = &table.pocket[0];
    carom_pot pot = {.ball = 1, .pocket = 0, .vias = others};
    for (int k = 0; k <= others + 1; k++) { /* from the pocket to the cue ball */
      const double far = 0.3 + 0.06 * k - (k > others && others == 0 ? 0.06 - 2.0 * 0.028575 : 0.0);
      const double side = far * sqrt(0.5);
      const int ball = k > others ? 0 : k + 1;
      ck_assert_int_eq(carom_place_ball(&table, balls, BALLS, ball, pocket->centre[0] + side,
                                        pocket->centre[1] + side, NULL),
                       CAROM_OK);
      if (ball > 1)
        pot.via[others - k] = (carom_part){CAROM_PART_BALL, ball};
    }
    carom_cue one = cue;
    one.speed = 4.0;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
    ck_assert_msg(pot.is == CAROM_POT_FALLS, "%d others: %d", others, pot.is);
    ck_assert_double_eq_tol(pot.margin, asin(pocket->radius / 0.3) / per_degree, 0.01);

    one.speed = 0.1;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &one), CAROM_OK);
    ck_assert_msg(pot.is == CAROM_POT_SHORT, "%d others: %d", others, pot.is);
    ck_assert(pot.met.type == CAROM_EVENT_ROLLING_STATIONARY ||
              pot.met.type == CAROM_EVENT_ROLLING_SPINNING);
    ck_assert(others > 0 || pot.met.a == 1);
  }
}

/* Ways that cannot be are refused. */
TEST(ways_that_cannot_be) {
  make_layout(test_seed(), 4);
  const carom_part ball = {CAROM_PART_BALL, 2}, rail = {CAROM_PART_RAIL, 0};
  const carom_pot wrong[] = {
      {.ball = 0, .pocket = 1},
      {.ball = 8, .pocket = 6},
      {.ball = 8, .pocket = -1},
      {.ball = BALLS, .pocket = 1},
      {.ball = 5, .pocket = 1}, /* which is down */
      {.ball = 8, .pocket = 1, .vias = CAROM_VIA_MOST + 1},
      {.ball = 8, .pocket = 1, .vias = 2, .via = {{CAROM_PART_BALL, 8}, ball}},
      {.ball = 8, .pocket = 1, .vias = 1, .via = {{CAROM_PART_RAIL, 18}}},
      {.ball = 8, .pocket = 1, .vias = 1, .via = {{CAROM_PART_JAW, 0}}},
      {.ball = 8, .pocket = 1, .vias = 2, .via = {ball, ball}},
      {.ball = 8, .pocket = 1, .vias = 3, .via = {rail, ball, ball}}};
  for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
    carom_pot pot = wrong[k];
    carom_cue one = cue;
    ck_assert_int_eq(carom_aim(&table, balls, BALLS, NULL, &pot, &one), CAROM_ERROR_BALLS);
    ck_assert_mem_eq(&pot, &wrong[k], sizeof pot);
  }
}

/* A game in which balls count in one pocket only. */
static uint32_t one_pocket(const uint64_t *user) {
  return UINT32_C(1) << user[7];
}

/* Values: the eight alone before a pocket, and the same with a ball in the way; ball in hand is
 * no worse. */
TEST(values) {
  double easy, blocked, hand;
  make_layout(1, 2);
  carom_place_ball(&table, balls, BALLS, 8, 0.12, 0.12, NULL);
  carom_place_ball(&table, balls, BALLS, 0, 0.5, 0.5, NULL);
  ck_assert_int_eq(carom_plan_value(&job, 0, &easy), CAROM_OK);
  carom_place_ball(&table, balls, BALLS, 9, 0.35, 0.35, NULL);
  ck_assert_int_eq(carom_plan_value(&job, 0, &blocked), CAROM_OK);
  ck_assert_int_eq(carom_plan_value(&job, 1, &hand), CAROM_OK);
  ck_assert(easy > 0.85 && easy <= 1.0 && blocked < easy - 0.1 && hand > blocked);

  /* a pocket that does not count is worth nothing */
  double corner;
  make_layout(1, 2);
  carom_place_ball(&table, balls, BALLS, 8, 0.12, 0.12, NULL);
  carom_place_ball(&table, balls, BALLS, 0, 0.5, 0.5, NULL);
  rules.pockets = one_pocket;
  for (uint64_t pocket = 0; pocket < 6; pocket++) {
    rules.user[7] = pocket;
    ck_assert_int_eq(carom_plan_value(&job, 0, &corner), CAROM_OK);
    const double *centre = table.pocket[pocket].centre;
    if (centre[0] < 0.5 && centre[1] < 0.5)
      ck_assert_double_gt(corner, 0.9);
    else
      ck_assert_double_lt(corner, 0.8);
  }

  /* players who pot next to nothing */
  options.chance_me = options.chance_opponent = 1e-17;
  ck_assert_int_eq(carom_plan_value(&job, 0, &blocked), CAROM_OK);
  ck_assert(blocked >= 0.0 && blocked <= 1.0);
}

/* Where six balls are around the one, the player pushes out if he may; if he may pass, he does.
 * Where the one is before a pocket and another ball free, he plays. */
static void put_ring(int most) {
  static const double ring[6][2] = {{2, 0},  {1, 1.7320508},   {-1, 1.7320508},
                                    {-2, 0}, {-1, -1.7320508}, {1, -1.7320508}};
  carom_place_ball(&table, balls, BALLS, 0, 0.3, 0.3, NULL);
  carom_place_ball(&table, balls, BALLS, 1, 0.6, 1.0, NULL);
  for (int k = 0; k < most; k++)
    carom_place_ball(&table, balls, BALLS, k + 2, 0.6 + 0.0287 * ring[k][0],
                     1.0 + 0.0287 * ring[k][1], NULL);
}
TEST(what_one_may_do) {
  carom_choice best;
  int found;
  for (int easy = 0; easy < 2; easy++)
    for (int may = 1; may <= 2; may++) {
      make_layout(1, 1);
      rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
      rules.user[4] = (uint64_t)may;
      put_ring(easy ? 1 : 6);
      if (easy)
        carom_place_ball(&table, balls, BALLS, 1, 0.1, 0.1, NULL);
      options.shots = 1000;
      job.count = 10;
      make_memory();
      ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
      const int kind = may == 1 ? CAROM_PLAN_PUSH : CAROM_PLAN_PASS;
      const int ball = easy ? 1 : may == 1 ? CAROM_CALL_PUSH : CAROM_CALL_PASS;
      ck_assert_msg((easy || best.kind == kind) && best.ball == ball,
                    "easy %d, may %d: kind %d, ball %d, %g", easy, may, best.kind, best.ball,
                    best.value);
      ck_assert(best.kind != CAROM_PLAN_PASS || (best.foul == 0.0 && best.seen == 0));
      edge_free(&memory);
    }
}

/* Of a game in which balls count in one pocket only. */
TEST(pockets_that_count) {
  for (int pocket = 0; pocket < 6; pocket++) {
    carom_choice best[3];
    int found;
    make_layout(9, 6);
    rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
    rules.user[7] = (uint64_t)pocket;
    rules.pockets = one_pocket;
    make_memory();
    ck_assert_int_eq(carom_plan(&job, best, 3, &found), CAROM_OK);
    for (int k = 0; k < found; k++)
      ck_assert(best[k].pocket == pocket || best[k].pocket == -1);
    edge_free(&memory);
  }
}

/* Rules that stop the plan when they have judged so many shots. */
static carom_plan_rules stopped_rules;
static volatile int32_t stop;
static int64_t judged, judged_most;
static carom_turn judge_and_stop(uint64_t *user, uint32_t in_play, int cue_ball,
                                 const carom_facts *facts, carom_call call) {
  stop |= ++judged == judged_most;
  return stopped_rules.judge(user, in_play, cue_ball, facts, call);
}

/* A plan that is stopped judges no other shot, but for one of a stage that has not begun. It gives
 * the best so far: of ball in hand no worse a place than it had before. */
TEST(stopped_plans) {
  enum { PLAN, HAND, TRY };
  for (int which = PLAN; which <= TRY; which++) {
    carom_choice best[2];
    int found = 1;
    double value = 0.0;
    make_layout(3, 6);
    stopped_rules = rules;
    rules.judge = judge_and_stop;
    options.shots = 3000;
    options.stop = &stop;
    make_memory();
    const carom_cue cues[2] = {{.speed = 2.0, .phi = 80.0}, {.speed = 3.0, .phi = 100.0}};
    for (judged_most = 1; judged_most <= 2900; judged_most += judged_most < 3 ? 1 : 289) {
      judged = stop = 0;
      ck_assert_int_eq(which == PLAN   ? carom_plan(&job, best, 2, &found)
                       : which == HAND ? carom_plan_hand(&job, NULL, NULL, best, 2, &found)
                                       : carom_plan_try(&job, cues, 2, best),
                       CAROM_OK);
      if (stop == 0)
        break;
      ck_assert_int_le(judged, judged_most + 2);
      ck_assert(found == 1 && best[0].seen <= judged);
      ck_assert((best[0].value >= 0.0 && best[0].value <= 1.0) || (which == TRY && judged == 1));
      if (which == HAND && best[0].seen > 0) {
        ck_assert(best[0].value > value - 0.05);
        value = best[0].value;
      }
    }
    if (which == TRY)
      ck_assert(best[0].seen == 1500 && best[1].seen > 0 && best[1].seen < 1500);
    printf("plan %d: stopped until %lld, %lld seen\n", which, (long long)judged_most,
           (long long)best[0].seen);
    edge_free(&memory);
  }

  /* long before its end */
  make_layout(3, 6);
  stopped_rules = rules;
  rules.judge = judge_and_stop;
  options.shots = 1000000;
  options.stop = &stop;
  make_memory();
  carom_choice best;
  int found;
  for (judged_most = 10; judged_most < 10000; judged_most *= 10) {
    judged = stop = 0;
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
    ck_assert(judged <= judged_most + 2 && found == 1);
  }
  edge_free(&memory);
}

/* A plan in slices has the choices of one call, bit for bit, and a slice plays no more shots than
 * it has. */
TEST(plans_in_slices) {
  static const int64_t slices[] = {1, 37, 1000};
  for (int which = 0; which < 6; which++) {
    const bool hand = which % 2 == 1;
    carom_choice whole[3], best[3];
    int found, found_whole;
    make_layout((uint64_t)which + 1, which < 4 ? 6 : 1);
    rules = carom_plan_rules_of(which < 2 ? CAROM_RULES_EIGHTBALL : CAROM_RULES_NINEBALL);
    if (which >= 4) { /* nothing is to be hit, or the player may pass */
      put_ring(6);
      job.count = 10;
      rules.user[4] = which == 5 ? 2 : 0;
    }
    stopped_rules = rules;
    rules.judge = judge_and_stop;
    options.unsure = which == 1 || which == 2 ? 0.5 : 0.0;
    options.threads = which % 3;
    make_memory();
    judged_most = -1;
    ck_assert_int_eq(hand ? carom_plan_hand(&job, NULL, NULL, whole, 3, &found_whole)
                          : carom_plan(&job, whole, 3, &found_whole),
                     CAROM_OK);
    for (size_t k = 0; k < sizeof slices / sizeof slices[0]; k++) {
      options.slice = slices[k];
      options.threads = 0; /* the judge counts */
      judged = 0;
      int64_t calls = 1;
      memset(job.memory, 0x55, job.memory_size);
      ck_assert_int_eq(hand ? carom_plan_hand(&job, NULL, NULL, best, 3, &found)
                            : carom_plan(&job, best, 3, &found),
                       CAROM_OK);
      int64_t before = judged;
      for (; found == 0; calls++) {
        before = judged;
        ck_assert_int_eq(carom_plan_continue(&job, best, 3, &found), CAROM_OK);
        ck_assert_int_le(judged - before, slices[k] + 1); /* one is not to play */
      }
      ck_assert_int_eq(found, found_whole);
      ck_assert_mem_eq(best, whole, (size_t)found * sizeof *best);
      ck_assert(calls >= judged / slices[k]);

      /* what has ended stays as it is */
      before = judged;
      ck_assert_int_eq(carom_plan_continue(&job, best, 3, &found), CAROM_OK);
      ck_assert_mem_eq(best, whole, (size_t)found * sizeof *best);
      ck_assert_int_eq(judged, before);
    }
    edge_free(&memory);
  }
}

/* A plan that goes on with something else is refused; one that is stopped between slices ends. */
TEST(slices_of_other_plans) {
  carom_choice best;
  int found;
  make_layout(3, 6);
  options.slice = 50;
  options.stop = &stop;
  make_memory();
  memset(job.memory, 0, job.memory_size);
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
  stop = 0;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_int_eq(found, 0);
  double *numbers[] = {&balls[8].state.r[0], &table.width, &cue.mass, &player.phi,
                       &options.chance_me};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
    const double kept = *numbers[k];
    *numbers[k] += 1e-9;
    ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
    *numbers[k] = kept;
  }
  ck_assert_int_eq(carom_plan_continue(NULL, &best, 1, &found), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_plan_continue(&job, NULL, 1, &found), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_OK);
  ck_assert_int_eq(found, 0);
  stop = 1;
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_OK);
  ck_assert_int_eq(found, 1);

  /* a plan that was refused leaves nothing to go on with */
  stop = 0;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  balls[8].state.v[0] = 1.0;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_ERROR_IN_MOTION);
  balls[8].state.v[0] = 0.0;
  ck_assert_int_eq(carom_plan_continue(&job, &best, 1, &found), CAROM_ERROR_STATE);
  edge_free(&memory);
}

/* A plan that is stopped at once has a choice still; one without a legal shot says so. */
TEST(little_to_choose) {
  const volatile int32_t at_once = 1;
  carom_choice best;
  int found;
  make_layout(3, 6);
  options.stop = &at_once;
  make_memory();
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert(found == 1 && best.seen == 0);
  ck_assert_int_eq(carom_plan_try(&job, &best.cue, 1, &best), CAROM_OK);
  ck_assert(best.seen == 0 && isnan(best.value));
  edge_free(&memory);

  /* six balls are around the only one that is on */
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  put_ring(6);
  job.count = 10;
  make_memory();
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert(found == 1 && best.kind == CAROM_PLAN_FOUL && best.foul == 1.0 && best.ball == -1 &&
            best.pocket == -1);
  edge_free(&memory);
}

/* ---- A table that is not known */

/* A straight pot into the pocket at the origin; or a bank there, off the foot rail. */
static carom_cue put_pot(bool bank) {
  make_layout(1, 1);
  rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  player = carom_player_of(0.3);
  carom_place_ball(&table, balls, BALLS, 8, bank ? 0.9 : 0.3, bank ? 1.2 : 0.3, NULL);
  carom_place_ball(&table, balls, BALLS, 0, bank ? 1.0 : 0.6, bank ? 0.75 : 0.62, NULL);
  carom_pot pot = {.ball = 8, .vias = bank, .via = {{CAROM_PART_RAIL, 0}}};
  for (int p = 0; p < table.pockets; p++)
    if (table.pocket[p].centre[0] + table.pocket[p].centre[1] < 0.2)
      pot.pocket = p;
  for (int r = 0; r < table.rails; r++)
    if (table.rail[r].p[1] > 2.5 && fabs(table.rail[r].p[0] - table.rail[r].q[0]) > 1.0)
      pot.via[0].index = r;
  carom_cue stroke = cue;
  stroke.speed = bank ? 4.0 : 1.5;
  stroke.b = 0.25;
  ck_assert_int_eq(carom_aim(&table, balls, BALLS, &shot_options, &pot, &stroke), CAROM_OK);
  ck_assert_msg(pot.is == CAROM_POT_FALLS, "%s: %d", bank ? "bank" : "pot", pot.is);
  options.shots = 600;
  return stroke;
}

static carom_choice tried(const carom_cue *stroke, double unsure) {
  carom_choice c;
  options.unsure = unsure;
  make_memory();
  ck_assert_int_eq(carom_plan_try(&job, stroke, 1, &c), CAROM_OK);
  edge_free(&memory);
  return c;
}

/* The less of the table a player knows, the less often a bank comes off; a pot near by comes off as
 * often. Rails with numbers of their own are as little known as those with the numbers of the
 * balls. */
TEST(tables_that_are_not_known) {
  static const double unsure[] = {0.0, 0.1, 0.3, 1.0};
  double keep[2][4];
  for (int bank = 0; bank < 2; bank++)
    for (int k = 0; k < 4; k++) {
      const carom_cue stroke = put_pot(bank);
      const carom_choice c = tried(&stroke, unsure[k]);
      keep[bank][k] = c.keep;

      for (int r = 0; r < table.rails; r++) {
        table.rail[r].restitution = balls[0].kind.restitution_cushion;
        table.rail[r].mu_cushion = balls[0].kind.mu_cushion;
      }
      for (int j = 0; j < table.jaws; j++) {
        table.jaw[j].restitution = balls[0].kind.restitution_cushion;
        table.jaw[j].mu_cushion = balls[0].kind.mu_cushion;
      }
      const carom_choice own = tried(&stroke, unsure[k]);
      ck_assert_mem_eq(&own, &c, sizeof c);
    }
  printf("kept with all, much, some and little known: a pot %.2f %.2f %.2f %.2f, a bank %.2f %.2f "
         "%.2f %.2f\n",
         keep[0][0], keep[0][1], keep[0][2], keep[0][3], keep[1][0], keep[1][1], keep[1][2],
         keep[1][3]);
  for (int k = 1; k < 4; k++) {
    ck_assert_double_gt(keep[0][k], keep[0][0] - 0.02);
    ck_assert_double_lt(keep[1][k], keep[1][k - 1] - (k > 1 ? 0.03 : 0.0));
  }
}

static uint32_t none_is_on(const uint64_t *user, uint32_t in_play) {
  (void)user;
  (void)in_play;
  return 0;
}

#define REFUSED(field, wrong, expected)                             \
  do {                                                              \
    make_layout(5, 6);                                              \
    make_memory();                                                  \
    field = wrong;                                                  \
    memset(&best, 0x55, sizeof best);                               \
    ck_assert_int_eq(carom_plan(&job, &best, 1, &found), expected); \
    for (size_t byte = 0; byte < sizeof best; byte++)               \
      ck_assert_int_eq(((const unsigned char *)&best)[byte], 0x55); \
    edge_free(&memory);                                             \
  } while (0)

TEST(arguments_of_plans) {
  carom_choice best;
  int found;
  REFUSED(job.table, NULL, CAROM_ERROR_NULL);
  REFUSED(job.player, NULL, CAROM_ERROR_NULL);
  REFUSED(job.rules, NULL, CAROM_ERROR_NULL);
  REFUSED(job.memory, NULL, CAROM_ERROR_NULL);
  REFUSED(job.memory_size, job.memory_size - 1, CAROM_ERROR_NULL);
  REFUSED(job.count, 1, CAROM_ERROR_BALLS);
  REFUSED(job.count, 33, CAROM_ERROR_BALLS);
  REFUSED(job.reserved[3], 1, CAROM_ERROR_OPTIONS);
  REFUSED(options.shots, -1, CAROM_ERROR_OPTIONS);
  REFUSED(options.shots, 1000001, CAROM_ERROR_OPTIONS);
  REFUSED(options.scan, 0.91, CAROM_ERROR_OPTIONS);
  REFUSED(options.scan, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(options.threads, -2, CAROM_ERROR_OPTIONS);
  REFUSED(options.level, 2, CAROM_ERROR_OPTIONS);
  REFUSED(options.chance_me, 1.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.slice, -1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, -0.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, 1.1, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(options.unsure, 0.5, CAROM_ERROR_NULL); /* for which there is too little memory */
  REFUSED(options.reserved[0], 1, CAROM_ERROR_OPTIONS);
  REFUSED(player.phi, -0.1, CAROM_ERROR_OPTIONS);
  REFUSED(player.speed, NAN, CAROM_ERROR_OPTIONS);
  REFUSED(player.speed, 1001.0, CAROM_ERROR_OPTIONS);
  REFUSED(player.tip_most, 1.5, CAROM_ERROR_OPTIONS);
  REFUSED(rules.judge, NULL, CAROM_ERROR_OPTIONS);
  REFUSED(rules.race, 4, CAROM_ERROR_OPTIONS);
  REFUSED(rules.rack, 5, CAROM_ERROR_OPTIONS);
  REFUSED(rules.reserved[3], 1, CAROM_ERROR_OPTIONS);
  REFUSED(shot_options.unused, 1, CAROM_ERROR_SHOT_OPTIONS);
  REFUSED(balls[1].state, balls[0].state, CAROM_ERROR_OVERLAP);
  REFUSED(cue.ball, BALLS, CAROM_ERROR_CUE_BALL);
  REFUSED(cue.mass, NAN, CAROM_ERROR_CUE_MASS);
  REFUSED(cue.speed = 0.0; cue.mass, NAN, CAROM_ERROR_CUE_MASS);
  REFUSED(balls[0].state.label, CAROM_BALL_POCKETED, CAROM_ERROR_CUE_BALL_OUT);
  REFUSED(balls[3].state.v[0], 0.1, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[0].state.w[2], -1.0, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[3].state.r[2], 0.2, CAROM_ERROR_IN_MOTION);
  REFUSED(balls[8].state.label, CAROM_BALL_POCKETED, CAROM_ERROR_GAME_OVER);
  REFUSED(rules.on, none_is_on, CAROM_ERROR_GAME_OVER);
  make_layout(5, 6);
  make_memory();

  /* the stroke of the job's cue is not read, and those to be tried are */
  carom_choice same;
  ck_assert_int_eq(carom_plan(&job, &same, 1, &found), CAROM_OK);
  cue.phi = NAN;
  cue.speed = 0.0;
  cue.theta = 30.0;
  cue.a = cue.b = 0.2;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_mem_eq(&best, &same, sizeof best);
  ck_assert_int_eq(carom_plan_try(&job, &cue, 1, &best), CAROM_ERROR_CUE_PHI);
  const double low[2] = {0.9, 0.9}, high[2] = {0.5, 2.0}, no[2] = {NAN, 0.0};
  ck_assert_int_eq(carom_plan_hand(&job, low, high, &best, 1, &found), CAROM_ERROR_OFF_TABLE);
  ck_assert_int_eq(carom_plan_hand(&job, no, NULL, &best, 1, &found), CAROM_ERROR_OFF_TABLE);
  const double point[2] = {0.5, 0.6}; /* a range of one place */
  ck_assert_int_eq(carom_plan_hand(&job, point, point, &best, 1, &found), CAROM_OK);
  ck_assert(best.place[0] == point[0] && best.place[1] == point[1]);
  balls[0].state.v[0] = 1.0; /* in hand, it may move */
  ck_assert_int_eq(carom_plan_hand(&job, NULL, NULL, &best, 1, &found), CAROM_OK);
  edge_free(&memory);
  ck_assert_int_eq(carom_plan(&job, NULL, 1, &found), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_plan(NULL, &best, 1, &found), CAROM_ERROR_NULL);
  ck_assert_uint_eq(carom_plan_memory(&(carom_plan_options){.shots = 1}), 0);
}
