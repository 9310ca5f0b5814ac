/* Racks of eight-ball after a break that pots nothing, and strokes by plans. */
#include "rack_play.h"
#include "message.h"

void lab_rack_make(lab_rack *rack, uint64_t seed) {
  rack->state = (lab_random){seed};
  rack->rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  rack->plan.rules = &rack->rules;
  rack->plan.balls = rack->balls;
  rack->plan.count = RACK_BALLS;
  rack->plan.options = &rack->options;
  carom_facts facts = {.down = 1};
  carom_ball_state final[RACK_BALLS];
  while (facts.down != 0 || facts.off != 0) {
    carom_cue opening = *rack->plan.cue;
    opening.speed = lab_uniform(&rack->state, 7.0, 8.0) * 2.0 / (1.0 + opening.tip_restitution);
    opening.phi = lab_uniform(&rack->state, 89.0, 91.0);
    carom_rack(CAROM_RACK_EIGHTBALL, rack->plan.table, 1e-4,
               (uint64_t)lab_uniform(&rack->state, 0.0, 1e9), rack->balls, RACK_BALLS);
    carom_shot played = {.final = final, .facts = &facts};
    if (carom_shoot(rack->plan.table, rack->balls, RACK_BALLS, &opening, rack->plan.shot,
                    &played) != CAROM_OK)
      facts.down = 1;
  }
  for (int k = 0; k < RACK_BALLS; k++)
    rack->balls[k].state = final[k];
}

bool lab_rack_stroke(lab_rack *rack, bool hand, carom_choice *choice, carom_turn *turn) {
  const carom_plan_job *of = &rack->plan;
  int found;
  rack->options.seed = rack->state.state;
  const carom_status status =
      hand ? carom_plan_hand(of, NULL, NULL, choice, 1, &found) : carom_plan(of, choice, 1, &found);
  if (status < 0) {
    complain("a plan: %s", carom_status_string(status));
    return false;
  }
  if (hand)
    carom_place_ball(of->table, rack->balls, RACK_BALLS, 0, choice->place[0], choice->place[1],
                     NULL);

  /* the stroke, with errors */
  carom_facts facts;
  carom_ball_state final[RACK_BALLS];
  carom_shot played = {.final = final, .facts = &facts};
  uint32_t in_play = 0;
  for (int k = 0; k < RACK_BALLS; k++)
    in_play |= (uint32_t)(rack->balls[k].state.label != CAROM_BALL_POCKETED) << k;
  carom_cue cue = choice->cue;
  carom_player_strike(of->player, rack->state.state, 0, &cue);
  lab_bits(&rack->state); /* the next stroke has other errors */
  carom_shoot(of->table, rack->balls, RACK_BALLS, &cue, of->shot, &played);
  *turn = rack->rules.judge(rack->rules.user, in_play, 0, &facts,
                            (carom_call){choice->ball, choice->pocket});
  for (int k = 0; k < RACK_BALLS && turn->is == CAROM_TURN_KEEP; k++)
    rack->balls[k].state = final[k];
  return true;
}
