/* Plans, aims, players and rules with inputs made of the bytes of a fuzzer (draws.h). Aborts where
 * the contract of carom_plan.h is broken: a choice that is not finite, or a chance that is none;
 * choices that depend on threads or on what was in the memory before; bytes written with an error
 * or next to the results. Crashes, hangs and undefined behaviour are for the fuzzer and the
 * sanitizers to see. */
#include "carom_plan.h"
#include "draws.h"

#include <math.h>

enum { ROOM = 4 };

static carom_table table;
static carom_shot_ball balls[CAROM_BALLS_MOST];
static carom_player player, opponent;
static carom_cue cue;
static carom_plan_rules rules;
static carom_shot_options shot;
static carom_plan_options options;
static carom_plan_job job;

static carom_player make_player(void) {
  carom_player p = choice(2) ? carom_player_of(number(0, 3)) : carom_player_fargo(number(200, 850));
  if (choice(4) == 0)
    (&p.speed)[choice(11)] = number(0, 1);
  return p;
}

static void make_balls(void) {
  const int count = 2 + choice(5);
  job.count = choice(40) == 0 ? choice(256) - 128 : count;
  memset(balls, 0, sizeof balls);
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    balls[k].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    if (choice(64) == 0)
      balls[k].kind.radius *= number(0.8, 1.2);
    balls[k].state = (carom_ball_state){.r = {0, 0, -0.1}, .label = CAROM_BALL_POCKETED};
  }
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    if (k < count && (k == 0 || choice(4) != 0))
      carom_place_ball(&table, balls, CAROM_BALLS_MOST, k, table.width * byte() / 255.0,
                       table.length * byte() / 255.0, NULL);
  }
  if (choice(16) == 0)
    balls[choice(count)].state.r[choice(3)] = number(0, 1);
}

static void make_inputs(void) {
  job = (carom_plan_job){.table = &table,
                         .balls = balls,
                         .cue = &cue,
                         .player = &player,
                         .rules = &rules,
                         .shot = choice(4) ? &shot : NULL,
                         .options = &options};
  carom_table_make((carom_table_kind)choice(choice(8) == 0 ? 6 : 3), &table);
  table.pockets = choice(32) == 0 ? choice(9) : table.pockets;
  table.length = choice(32) == 0 ? number(0.5, 10) : table.length;
  make_balls();
  player = make_player();
  opponent = make_player();
  cue = carom_cue_of(CAROM_GAME_POOL);
  cue.ball = choice(16) == 0 ? choice(40) - 4 : 0;
  rules = carom_plan_rules_of((carom_rules_kind)choice(7));
  (&rules.state.opening)[choice(14)] = choice(4);
  rules.race = choice(32) == 0 ? choice(6) - 1 : rules.race;
  rules.rack = choice(32) == 0 ? choice(7) - 1 : rules.rack;
  shot = (carom_shot_options){.fast = choice(2),
                              .space = (carom_space)(choice(16) == 0 ? 2 : choice(2))};

  /* budgets of one stage, so that an input takes milliseconds */
  options = (carom_plan_options){.shots = 100 + choice(8),
                                 .seed = byte(),
                                 .threads = choice(16) == 0 ? choice(5) - 2 : choice(3),
                                 .opponent = choice(2) ? &opponent : NULL};
  options.level = choice(32) == 0 ? choice(4) - 1 : choice(2);
  options.scan = choice(3) == 0 ? number(-0.5, 0.9) : 0;
  options.chance_me = choice(4) == 0 ? number(0, 1) : 0;
  options.chance_opponent = choice(4) == 0 ? number(0, 1) : 0;
  options.unsure = choice(3) == 0 ? number(0, 1) : 0;
  static const volatile int32_t at_once = 1;
  options.stop = choice(8) == 0 ? &at_once : NULL;
  RESERVE(options);
}

static void check_choices(const carom_plan_stroke *c, int n) {
  for (int k = 0; k < n; k++) {
    const double chances[] = {c[k].value, c[k].keep, c[k].foul, c[k].lose};
    const double finite[] = {c[k].cue.speed, c[k].cue.phi,  c[k].cue.theta, c[k].cue.a,
                             c[k].cue.b,     c[k].place[0], c[k].place[1],  c[k].error};
    expect(finite, sizeof finite / sizeof finite[0], true, "a choice");
    const bool unplayed = c[k].kind == CAROM_PLAN_GIVEN && c[k].seen == 0; /* as it was stopped */
    for (int m = 0; m < 4; m++)
      if (unplayed ? !isnan(chances[m]) : !(chances[m] >= -1e-9 && chances[m] <= 1 + 1e-9))
        fail("a chance is none");
  }
}

/* One of the three plans, in memory of its own that was filled with a byte; in slices, as the
 * options say. */
static carom_status plan(int which, int fill, const carom_cue *cues, const double *low,
                         const double *high, carom_plan_stroke *choices, int *found) {
  carom_plan_job own = job;
  own.memory_size = carom_plan_memory(job.options);
  own.memory = malloc(own.memory_size + 1);
  memset(own.memory, fill, own.memory_size);
  memset(choices, GUARD, (ROOM + 1) * sizeof *choices);
  *found = which == 2 ? ROOM : 0;
  carom_status status;
  if (which == 0)
    status = carom_plan(&own, choices, ROOM, found);
  else if (which == 1)
    status = carom_plan_hand(&own, low, high, choices, ROOM, found);
  else
    status = carom_plan_try(&own, cues, ROOM, choices);
  while (status == CAROM_OK && *found == 0)
    status = carom_plan_continue(&own, choices, ROOM, found);
  free(own.memory);
  return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  begin(data, size);
  tame = choice(4) != 0; /* else almost all is rejected */
  make_inputs();
  carom_cue cues[ROOM], aimed = cue;
  for (int k = 0; k < ROOM; k++) {
    cues[k] = cue;
    cues[k].speed = number(0.5, 8);
    cues[k].phi = number(0, 360);
    cues[k].b = number(-0.5, 0.5);
  }
  const double low[2] = {number(0, 1), number(0, 1)}, high[2] = {number(0, 1), number(0, 2)};
  const int which = choice(3);
  carom_plan_stroke choices[ROOM + 1], again[ROOM + 1];
  int found, found_again;
  const carom_status status = plan(which, 0, cues, low, high, choices, &found);
  if (status > 0 || carom_status_string(status)[0] == '\0')
    fail("the status of a plan");
  if (status != CAROM_OK)
    found = 0;
  else if (found < 1 || found > ROOM)
    fail("the number of choices");
  check_choices(choices, found);
  UNWRITTEN(choices, found, "a plan writes beside");

  /* Neither threads nor slices nor what was in the memory count. */
  if (status == CAROM_OK) {
    options.threads = 1 + choice(5);
    options.slice = choice(2) ? 0 : 1 + 40 * choice(60);
  }
  if (plan(which, 0xff, cues, low, high, again, &found_again) != status ||
      memcmp(choices, again, sizeof again) != 0)
    fail("a plan depends on threads, slices or memory");

  double value = 0;
  const int in_hand = choice(2);
  if (carom_plan_value(&job, in_hand, &value) == CAROM_OK && !(value >= -1e-9 && value <= 1 + 1e-9))
    fail("carom_plan_value is no chance");

  carom_pot pot = {.ball = choice(6), .pocket = choice(8) - 1, .vias = choice(4) ? 0 : choice(6)};
  aimed.speed = number(0.5, 8);
  aimed.theta = choice(2) ? (double)NAN : aimed.theta;
  for (int k = 0; k < CAROM_VIA_MOST; k++)
    pot.via[k] = (carom_part){(carom_part_kind)choice(4), choice(20) - 1};
  if (carom_aim(&table, balls, (int)job.count, &shot, &pot, &aimed) == CAROM_OK) {
    const double seen[] = {pot.elevation, pot.cut,      pot.margin,   pot.phi[0],
                           pot.phi[1],    pot.speed[0], pot.speed[1], aimed.phi};
    expect(seen, sizeof seen / sizeof seen[0], true, "carom_aim");
  }
  /* one of these, which may try ten thousand places on a table of many corners */
  const int put = choice(3), ball = choice(CAROM_BALLS_MOST);
  carom_turn turn = {.outcome = (carom_turn_outcome)choice(4),
                     .leave = (carom_leave)choice(5),
                     .foul = choice(9),
                     .spot = (uint32_t)byte() << 8 | (uint32_t)byte() << 16};
  if (put == 0)
    carom_spot_ball(&table, balls, CAROM_BALLS_MOST, ball);
  else if (put == 1)
    carom_spot_ball_of((carom_rack_kind)(choice(7) - 1), &table, balls, CAROM_BALLS_MOST, ball);
  else
    carom_turn_settle(&rules, &rules.state, &table, balls, choice(CAROM_BALLS_MOST + 1), &turn);
  return 0;
}
