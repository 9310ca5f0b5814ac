/* Games as data: who may be met first, what a shot amounts to, how many balls are left. World
 * Standardized Rules of the WPA (2016), sections 2 and 3, with the simplifications that
 * carom_plan.h names. Games of points have files of their own. */
#include "rules.h"
#include "games.h"

#include <stddef.h>

enum { FOULS_MOST = 3 };
enum { OPEN = CAROM_GROUP_OPEN, SOLIDS = CAROM_GROUP_SOLIDS, STRIPES = CAROM_GROUP_STRIPES };
static const uint32_t balls_of[] = {0xfefe, 0xfe, 0xfe00}, eight = 0x100;

static const carom_turn win = {CAROM_TURN_WIN, CAROM_LEAVE_AFTER, 0, 0, 0.0};

static carom_turn foul_for(int32_t why) {
  return (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_HAND, why, 0, 0.0};
}

/* ---- Eight-ball */

/* Of a game that is not over. */
static uint32_t eightball_targets(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t own = in_play & balls_of[(uint32_t)game->group <= STRIPES ? game->group : OPEN];
  if (game->opening != 0)
    return in_play & 0xfffe;
  return own != 0 ? own : in_play & eight;
}

static uint32_t eightball_on(const carom_rules_state *game, uint32_t in_play) {
  return (in_play & eight) != 0 ? eightball_targets(game, in_play) : 0;
}

static void eightball_left(const carom_rules_state *game, uint32_t in_play, int32_t left[2]) {
  const int solids = carom_count_of(in_play & balls_of[SOLIDS]),
            stripes = carom_count_of(in_play & balls_of[STRIPES]);
  const bool open = game->group == OPEN;
  const int fewer = solids < stripes ? solids : stripes;
  const int more = solids < stripes ? stripes : solids;
  const bool has_solids = game->group == SOLIDS;
  left[0] = 1 + (has_solids ? solids : stripes);
  left[1] = 1 + (has_solids ? stripes : solids);
  if (open) {
    left[0] = 1 + fewer;
    left[1] = 1 + more;
  }
}

/* The turn goes to the other: the state becomes his. */
static carom_turn give(carom_rules_state *game, carom_turn turn) {
  if (game->group == SOLIDS || game->group == STRIPES)
    game->group = SOLIDS + STRIPES - game->group;
  return turn;
}

/* The break, by the WPA, 3.3: nothing is called, the eight comes back, and the table is open. */
static carom_turn eightball_break(carom_rules_state *game, const carom_facts *facts, int cue_ball,
                                  int32_t foul) {
  const uint32_t eight_gone = (facts->down | facts->off) & eight;
  const bool cue_ball_gone = (facts->down | facts->off) >> cue_ball & 1;
  carom_turn turn = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, foul, eight_gone, 0.0};
  game->may = eight_gone != 0 ? CAROM_MAY_RACK : 0;

  /* a foul: the other has the cue ball behind the head string, or leaves it where it lies */
  if (foul != CAROM_FOUL_NONE) {
    turn.leave = CAROM_LEAVE_KITCHEN;
    game->may |= cue_ball_gone ? 0 : CAROM_MAY_STAY;
    return turn;
  }

  /* a break that is not legal is no foul: the other has the table as it is, or a new rack */
  if (!carom_is_break(facts, cue_ball)) {
    turn.foul = CAROM_FOUL_BREAK;
    game->may = CAROM_MAY_RACK | CAROM_MAY_OTHER_RACK;
    return turn;
  }
  turn.is = (facts->down & 0xfffe) != 0 ? CAROM_TURN_KEEP : CAROM_TURN_PASS;
  return turn;
}

/* A choice after a break, which the state allows. False of any other call. */
static bool eightball_chooses(carom_rules_state *game, int32_t call, carom_turn *turn) {
  static const struct {
    int32_t call, may;
  } choices[] = {{CAROM_CALL_RACK, CAROM_MAY_RACK},
                 {CAROM_CALL_OTHER_RACK, CAROM_MAY_OTHER_RACK},
                 {CAROM_CALL_STAY, CAROM_MAY_STAY}};
  bool chosen = false;
  for (size_t k = 0; k < sizeof choices / sizeof choices[0]; k++)
    chosen |= call == choices[k].call && (game->may & choices[k].may) != 0;
  if (!chosen)
    return false;
  *turn = call == CAROM_CALL_OTHER_RACK ? carom_pass : carom_keep;
  game->may = 0;
  if (call != CAROM_CALL_STAY) {
    game->opening = 1;
    turn->leave = CAROM_LEAVE_KITCHEN;
    turn->spot = 0xfffe;
  }
  return true;
}

static carom_turn eightball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                  const carom_facts *facts, carom_call call) {
  carom_turn turn;
  if (eightball_chooses(game, call.ball, &turn))
    return turn;
  const uint32_t on = eightball_targets(game, in_play);
  const int32_t foul = (int32_t)carom_foul_of(facts, on, cue_ball);
  const bool opening = game->opening != 0;
  game->opening = game->may = 0;
  if (opening)
    return eightball_break(game, facts, cue_ball, foul);

  /* The eight wins as the last ball, in the pocket that was called, without a foul. */
  const bool called = carom_is_called(facts, call);
  if (((facts->down | facts->off) & eight) != 0)
    return on == eight && !foul && called && call.ball == 8
               ? win
               : (carom_turn){CAROM_TURN_LOSE, CAROM_LEAVE_AFTER, foul, 0, 0.0};
  if (foul)
    return give(game, foul_for(foul));

  /* The first ball that is called and falls decides the groups. */
  if (!called || !(on >> call.ball & 1))
    return give(game, carom_pass);
  if (game->group == OPEN)
    game->group = balls_of[SOLIDS] >> call.ball & 1 ? SOLIDS : STRIPES;
  return carom_keep;
}

CAROM_RULES_OBJECT(carom_eightball) = {.on = eightball_on,
                                       .judge = eightball_judge,
                                       .left = eightball_left,
                                       .race = CAROM_RACE_OWN,
                                       .first_decides = 1,
                                       .breaks = 1,
                                       .settle = carom_settle_rack,
                                       .rack = CAROM_RACK_EIGHTBALL};

/* ---- Nine-ball */

static uint32_t nineball_on(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return carom_lowest_of(in_play & 0x3fe); /* of 1 to 9 */
}

static void nineball_left(const carom_rules_state *game, uint32_t in_play, int32_t left[2]) {
  (void)game;
  left[0] = left[1] = carom_count_of(in_play & 0x3fe);
}

/* The foul of a push-out, which may meet any ball or none, and needs no cushion; not that the cue
 * ball is gone. */
static carom_foul push_out_foul_of(const carom_facts *facts) {
  if (facts->off != 0)
    return CAROM_FOUL_OFF;
  return carom_is_double_hit(facts) ? CAROM_FOUL_DOUBLE_HIT : CAROM_FOUL_NONE;
}

int32_t carom_rotation_foul_of(const carom_facts *facts, uint32_t on, int cue_ball, bool opening,
                               bool pushes) {
  int32_t foul = (int32_t)carom_foul_of(facts, on, cue_ball);
  if (pushes && foul != CAROM_FOUL_CUE_BALL)
    foul = (int32_t)push_out_foul_of(facts);
  if (foul == CAROM_FOUL_NONE && opening && !carom_is_break(facts, cue_ball))
    foul = CAROM_FOUL_BREAK;
  return foul;
}

carom_turn carom_give_hand(carom_rules_state *game, int32_t foul, uint32_t spot) {
  carom_turn turn = foul_for(foul);
  turn.spot = spot;
  carom_add(&game->fouls[0], 1);
  if (game->fouls[0] >= FOULS_MOST) {
    game->fouls[0] = 0;
    turn.is = CAROM_TURN_LOSE;
  }
  return carom_give(game, turn);
}

static carom_turn nineball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                 const carom_facts *facts, carom_call call) {
  const bool opening = game->opening != 0;
  const bool pushes = (game->may & CAROM_MAY_PUSH) && call.ball == CAROM_CALL_PUSH;
  const bool passes = (game->may & CAROM_MAY_PASS) && call.ball == CAROM_CALL_PASS;
  game->opening = game->may = 0;
  if (passes)
    return carom_give(game, carom_pass);

  /* the nine wins, or the highest ball of a game without it; it comes back after a foul or a
   * push-out */
  const uint32_t wins = carom_highest_of(in_play & 0x3fe);
  const int32_t foul =
      carom_rotation_foul_of(facts, nineball_on(game, in_play), cue_ball, opening, pushes);
  if (foul != CAROM_FOUL_NONE)
    return carom_give_hand(game, foul, (facts->down | facts->off) & wins);
  if (pushes) {
    carom_turn turn = carom_pass;
    turn.spot = facts->down & wins;
    game->may = CAROM_MAY_PASS;
    return carom_give(game, turn);
  }

  game->fouls[0] = 0;
  if ((facts->down & wins) != 0)
    return win;
  game->may = opening ? CAROM_MAY_PUSH : 0;
  return facts->down != 0 ? carom_keep : carom_give(game, carom_pass);
}

CAROM_RULES_OBJECT(carom_nineball) = {.on = nineball_on,
                                      .judge = nineball_judge,
                                      .left = nineball_left,
                                      .race = CAROM_RACE_SHARED,
                                      .first_decides = 1,
                                      .breaks = 1};

/* ---- Potting */

static uint32_t potting_on(const carom_rules_state *game, uint32_t in_play) {
  (void)game;
  return in_play & ~UINT32_C(1);
}

static void potting_left(const carom_rules_state *game, uint32_t in_play, int32_t left[2]) {
  left[0] = carom_count_of(potting_on(game, in_play));
  left[1] = 1;
}

static carom_turn potting_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                const carom_facts *facts, carom_call call) {
  (void)call;
  const uint32_t on = potting_on(game, in_play);
  int32_t foul = (int32_t)carom_foul_of(facts, on, cue_ball);
  foul = foul == CAROM_FOUL_CUSHION ? CAROM_FOUL_NONE : foul;
  if (foul != CAROM_FOUL_NONE) {
    carom_turn turn = foul_for(foul);
    if ((on & ~(facts->down | facts->off)) == 0) /* no ball is left to be played */
      turn.is = CAROM_TURN_LOSE;
    return turn;
  }
  carom_turn turn = carom_pass;
  if (facts->down != 0)
    turn = (facts->down & on) == on ? win : carom_keep;
  turn.points = carom_count_of(facts->down & on);
  return turn;
}

CAROM_RULES_OBJECT(carom_potting) = {
    .on = potting_on, .judge = potting_judge, .left = potting_left, .race = CAROM_RACE_ALONE};
