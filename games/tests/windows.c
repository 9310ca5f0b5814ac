/* The windows of pots.c against sweeps: a single ball that rolls at a usual speed, in all
 * directions near a pocket, from positions of which half are near a rail. */
#include "view.h" /* before the support, whose names it uses for arguments */

#include "plan_support.h"

enum { STEPS = 160 };

/* The range of directions, rad, in which the ball falls, among those within `wide` of psi. */
static double sweep(int pocket, double psi, double wide) {
  int falls = 0;
  for (int k = 0; k < STEPS; k++) {
    static carom_facts facts;
    carom_shot shot = {.facts = &facts};
    cue.phi = (psi + wide * ((2.0 * k + 1.0) / STEPS - 1.0)) / per_degree;
    expect_ok(carom_shoot(&table, balls, 1, &cue, &shot_options, &shot));
    falls += facts.pocket[0] == pocket;
  }
  return 2.0 * wide * falls / STEPS;
}

/* Compares n windows of a table: the mean and the spread of the logarithm of formula by sweep. */
static void compare(random_source *r, carom_table_kind kind, carom_game game, int n,
                    double moments[2]) {
  carom_table_make(kind, &table);
  cue = carom_cue_of(game);
  cue.speed = 1.5;
  cue.b = 0.3;
  carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, 1, balls, BALLS);
  const double R = balls[0].kind.radius;
  double sum = 0.0, squares = 0.0;
  for (int drawn = 0; drawn < n;) {
    const bool at_rail = drawn % 2 == 0;
    double *place = balls[0].state.r;
    place[0] = random_between(r, R + 1e-9, at_rail ? 3.0 * R : table.width - R);
    place[1] = random_between(r, 0.1, 0.9) * table.length;
    const int pocket = (int)random_between(r, 0.0, (double)table.pockets);
    const carom_mouth mouth = carom_mouth_of(&table, pocket);
    const carom_window window = carom_window_of(&mouth, place, R);
    if (!(window.half > 0.2 * per_degree && window.half < 10.0 * per_degree))
      continue;
    const double swept = sweep(pocket, window.psi, 2.0 * window.half + 1.5 * per_degree);
    if (!(swept > 0.0))
      printf("table %d: no window of pocket %d from %.4f, %.4f m\n", (int)kind, pocket, place[0],
             place[1]);
    ck_assert(swept > 0.0);
    const double ratio = log(2.0 * window.half / swept);
    sum += ratio;
    squares += ratio * ratio;
    drawn++;
  }
  moments[0] = sum / n;
  moments[1] = sqrt(squares / n);
  printf("table %d: windows are %.2f times those of sweeps, by %.2f\n", (int)kind, exp(moments[0]),
         moments[1]);
}

TEST(windows_are_those_of_sweeps) {
  const struct {
    carom_table_kind kind;
    carom_game game;
    double mean, spread; /* of the logarithm */
  } tables[] = {{CAROM_TABLE_POOL_9FT, CAROM_GAME_POOL, 0.1, 0.25},
                {CAROM_TABLE_POOL_7FT, CAROM_GAME_POOL, 0.1, 0.25},
                {CAROM_TABLE_HEYBALL, CAROM_GAME_POOL, 0.4, 0.6}};
  random_source r = {test_seed()};
  for (size_t k = 0; k < COUNT_OF(tables); k++) {
    double moments[2];
    compare(&r, tables[k].kind, tables[k].game, 40 * draws_of_test(1, 1), moments);
    ck_assert(fabs(moments[0]) < tables[k].mean && moments[1] < tables[k].spread);
  }
}
