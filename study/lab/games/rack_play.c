/* Racks and breaks, and strokes by plans. */
#include "rack_play.h"
#include "program/memory.h"
#include "program/message.h"

bool lab_game_is_played(int rules) {
  const bool known = carom_rules_about_of((carom_rules_kind)rules)->last > 0;
  if (!known)
    complain("--rules: a game of two players is needed");
  return known;
}

carom_table_kind lab_table_of(carom_rules_kind game) {
  if (game == CAROM_RULES_EIGHTBALL || game == CAROM_RULES_NINEBALL)
    return CAROM_TABLE_POOL_7FT; /* the table of run-outs */
  return (carom_table_kind)carom_rules_about_of(game)->table;
}

void lab_rack_begin(lab_rack *rack, carom_rules_kind game, double errors) {
  const carom_rules_about *about = carom_rules_about_of(game);
  carom_table_make(lab_table_of(game), &rack->table);
  rack->cue = carom_cue_of((carom_game)about->balls);
  rack->player = carom_player_of(errors);
  rack->shot = (carom_shot_options){.space = CAROM_SPACE_FLAT};
  rack->plan = (carom_plan_job){.table = &rack->table,
                                .cue = &rack->cue,
                                .player = &rack->player,
                                .shot = &rack->shot,
                                .memory_size = carom_plan_memory(&rack->options)};
  rack->plan.memory = allocate(1, rack->plan.memory_size);
}

void lab_rack_make(lab_rack *rack, carom_rules_kind game, uint64_t seed) {
  const carom_rules_about *about = carom_rules_about_of(game);
  const carom_rack_kind kind = (carom_rack_kind)about->rack;
  rack->state = (lab_random){seed};
  rack->rules = carom_plan_rules_of(game);
  rack->plan.rules = &rack->rules;
  rack->plan.balls = rack->balls;
  rack->plan.count = carom_rack_size(kind);
  rack->plan.options = &rack->options;
  rack->hand = true;
  rack->plan.leave = CAROM_LEAVE_ANYWHERE;
  const int count = (int)rack->plan.count;
  if (rack->rules.breaks != 1) {
    if (about->opening == CAROM_LEAVE_KITCHEN)
      rack->plan.leave = CAROM_LEAVE_KITCHEN;
    const char *range;
    rack->rules.state.opening = 1;
    if (carom_rules_fault(game, &rack->rules.state, &range) != NULL)
      rack->rules.state.opening = 0;
    carom_rack(kind, rack->plan.table, 1e-4, lab_bits(&rack->state), rack->balls, count);
    return;
  }
  carom_facts facts = {.down = 1};
  carom_ball_state final[RACK_BALLS];
  while (facts.down != 0 || facts.off != 0) {
    carom_cue opening = *rack->plan.cue;
    opening.speed = lab_uniform(&rack->state, 7.0, 8.0) * 2.0 / (1.0 + opening.tip_restitution);
    opening.phi = lab_uniform(&rack->state, 89.0, 91.0);
    carom_rack(kind, rack->plan.table, 1e-4, (uint64_t)lab_uniform(&rack->state, 0.0, 1e9),
               rack->balls, count);
    carom_shot played = {.final = final, .facts = &facts};
    if (carom_shoot(rack->plan.table, rack->balls, count, &opening, rack->plan.shot, &played) !=
        CAROM_OK)
      facts.down = 1;
  }
  for (int k = 0; k < count; k++)
    rack->balls[k].state = final[k];
}

void lab_rack_end(lab_rack *rack, int left) {
  enum { GROUP = 7, EIGHT = 8 };
  const int count = (int)rack->plan.count;
  const bool groups = count > 10; /* eight-ball; else the last balls of nine-ball */
  left = left < GROUP ? left : GROUP - 1;
  rack->rules.state.group = groups ? CAROM_GROUP_SOLIDS : 0;
  rack->hand = false;
  rack->plan.leave = CAROM_LEAVE_AFTER;
  for (int k = 0; k < count; k++)
    rack->balls[k].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  for (int k = 0; k < count; k++) {
    double x, y;
    do {
      x = lab_uniform(&rack->state, 0.0, rack->plan.table->width);
      y = lab_uniform(&rack->state, 0.0, rack->plan.table->length);
    } while ((k == 0 ||
              (groups ? k <= left || (k >= EIGHT && k <= EIGHT + left + 1) : k >= count - left)) &&
             carom_place_ball(rack->plan.table, rack->balls, count, k, x, y, NULL) != CAROM_OK);
  }
}

/* Where any ball may be the cue ball, one that is in play: the plan chooses among all. */
static void choose_cue_ball(lab_rack *rack) {
  const bool any = rack->rules.any_cue_ball != 0;
  rack->cue.ball = 0;
  while (any && rack->cue.ball + 1 < rack->plan.count &&
         rack->balls[rack->cue.ball].state.label == CAROM_BALL_POCKETED)
    rack->cue.ball++;
}

bool lab_rack_stroke(lab_rack *rack, carom_plan_stroke *choice, carom_turn *turn) {
  const carom_plan_job *job = &rack->plan;
  const int count = (int)job->count;
  int found;
  choose_cue_ball(rack);
  rack->options.seed = rack->state.state;
  const carom_status status = rack->hand ? carom_plan_hand(job, NULL, NULL, choice, 1, &found)
                                         : carom_plan(job, choice, 1, &found);
  if (status < 0) {
    complain("a plan: %s", carom_status_string(status));
    return false;
  }
  if (rack->hand)
    carom_place_ball(job->table, rack->balls, count, 0, choice->place[0], choice->place[1], NULL);

  /* the stroke, with errors */
  carom_facts facts = {.first = {-1, -1}};
  carom_ball_state final[RACK_BALLS];
  carom_shot played = {.final = final, .facts = &facts};
  uint32_t in_play = 0;
  for (int k = 0; k < count; k++) {
    final[k] = rack->balls[k].state;
    in_play |= (uint32_t)(final[k].label != CAROM_BALL_POCKETED) << k;
  }
  carom_cue cue = choice->cue;
  carom_player_strike(job->player, rack->state.state, 0, &cue);
  lab_bits(&rack->state); /* the next stroke has other errors */
  if (choice->kind != CAROM_PLAN_PASS)
    carom_shoot(job->table, rack->balls, count, &cue, job->shot, &played);
  int cue_ball = 0;
  if (rack->rules.any_cue_ball != 0)
    cue_ball = (int)choice->cue.ball;
  *turn = rack->rules.judge(&rack->rules.state, in_play, cue_ball, &facts,
                            (carom_call){choice->ball, choice->pocket});

  /* the next layout; a ball that left the table is down */
  for (int k = 0; k < count; k++) {
    rack->balls[k].state = final[k];
    if (final[k].label == CAROM_BALL_OFF)
      rack->balls[k].state.label = CAROM_BALL_POCKETED;
  }
  carom_turn_settle(&rack->rules, &rack->rules.state, job->table, rack->balls, count, turn);
  rack->hand = turn->leave != CAROM_LEAVE_AFTER;
  rack->plan.leave = (int64_t)turn->leave;
  return true;
}
