/* Games as data: who may be met first, what a shot amounts to, how many balls are left. World
 * Standardized Rules of the WPA (2016), sections 2 and 3, with the simplifications that
 * carom_plan.h names. Games of points have files of their own. */
#include "rules.h"
#include "games.h"

#include <stddef.h>

enum { FOULS_MOST = 3 };
enum { OPEN = CAROM_GROUP_OPEN, SOLIDS = CAROM_GROUP_SOLIDS, STRIPES = CAROM_GROUP_STRIPES };
static const uint32_t balls_of[] = {0xfefe, 0xfe, 0xfe00}, eight = 0x100, nine = 0x200;

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

/* The turn after an opening break: nothing is called. */
static carom_turn turn_of_break(const carom_facts *facts, int cue_ball, int32_t foul) {
  if (foul != CAROM_FOUL_NONE)
    return foul_for(foul);
  if (!carom_is_break(facts, cue_ball))
    return foul_for(CAROM_FOUL_BREAK);
  return (facts->down & 0xfffe) != 0 ? carom_keep : carom_pass;
}

static carom_turn eightball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                  const carom_facts *facts, carom_call call) {
  const uint32_t on = eightball_targets(game, in_play);
  const int32_t foul = (int32_t)carom_foul_of(facts, on, cue_ball);

  /* The break: nothing is called, the eight comes back, and the table is open after it. */
  if (game->opening != 0) {
    game->opening = 0;
    carom_turn turn = turn_of_break(facts, cue_ball, foul);
    turn.leave = foul != 0 ? CAROM_LEAVE_KITCHEN : turn.leave;
    turn.spot = (facts->down | facts->off) & eight;
    return turn;
  }

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

const carom_plan_rules carom_eightball = {.on = eightball_on,
                                          .judge = eightball_judge,
                                          .left = eightball_left,
                                          .race = CAROM_RACE_OWN,
                                          .first_decides = 1,
                                          .breaks = 1};

/* ---- Nine-ball */

static uint32_t nineball_on(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t balls = in_play & 0x3fe; /* 1 to 9 */
  (void)game;
  return balls & (~balls + 1); /* the lowest */
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

static carom_turn nineball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                 const carom_facts *facts, carom_call call) {
  const bool opening = game->opening != 0;
  const bool pushes = (game->may & CAROM_MAY_PUSH) && call.ball == CAROM_CALL_PUSH;
  const bool passes = (game->may & CAROM_MAY_PASS) && call.ball == CAROM_CALL_PASS;
  game->opening = game->may = 0;
  if (passes)
    return carom_give(game, carom_pass);

  /* the foul, of a push-out or of another stroke */
  int32_t foul = (int32_t)carom_foul_of(facts, nineball_on(game, in_play), cue_ball);
  if (pushes && foul != CAROM_FOUL_CUE_BALL)
    foul = (int32_t)push_out_foul_of(facts);
  if (foul == CAROM_FOUL_NONE && opening && !carom_is_break(facts, cue_ball))
    foul = CAROM_FOUL_BREAK;
  if (foul != CAROM_FOUL_NONE) {
    carom_turn turn = foul_for(foul);
    turn.spot = (facts->down | facts->off) & nine;
    carom_add(&game->fouls[0], 1);
    turn.is = game->fouls[0] >= FOULS_MOST ? CAROM_TURN_LOSE : turn.is;
    return carom_give(game, turn);
  }
  if (pushes) {
    carom_turn turn = carom_pass;
    turn.spot = facts->down & nine;
    game->may = CAROM_MAY_PASS;
    return carom_give(game, turn);
  }

  /* The nine wins, or the highest ball in games that do not put the nine back. A set of balls is
   * above half of the set that it is from if it has its highest ball. */
  const uint32_t balls = in_play & 0x3fe;
  game->fouls[0] = 0;
  game->may = opening ? CAROM_MAY_PUSH : 0;
  if ((facts->down & balls) > balls >> 1)
    return win;
  return facts->down != 0 ? carom_keep : carom_give(game, carom_pass);
}

const carom_plan_rules carom_nineball = {.on = nineball_on,
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
    turn.points = 0.0;
    return turn;
  }
  carom_turn turn = carom_pass;
  if (facts->down != 0)
    turn = (facts->down & on) == on ? win : carom_keep;
  turn.points = carom_count_of(facts->down & on);
  return turn;
}

const carom_plan_rules carom_potting = {
    .on = potting_on, .judge = potting_judge, .left = potting_left, .race = CAROM_RACE_ALONE};

/* ---- Three-cushion */

static void threecushion_left(const carom_rules_state *game, uint32_t in_play, int32_t left[2]) {
  (void)game, (void)in_play;
  left[0] = left[1] = 1;
}

/* A point: before the cue ball meets the second ball, it meets three cushions. */
static carom_turn threecushion_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                     const carom_facts *facts, carom_call call) {
  (void)game, (void)in_play, (void)cue_ball, (void)call;
  int32_t foul = CAROM_FOUL_NONE;
  if (facts->off != 0)
    foul = CAROM_FOUL_OFF;
  else if (facts->pushed != 0 || facts->touches > 1)
    foul = CAROM_FOUL_DOUBLE_HIT;
  if (foul != CAROM_FOUL_NONE || facts->first[1] < 0 || facts->cushions_before[1] < 3)
    return (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_AFTER, foul, 0, 0.0};
  carom_turn turn = carom_keep;
  turn.points = 1.0;
  return turn;
}

/* What follows is not estimated. */
static double threecushion_value(const carom_rules_state *game, const carom_ball_state *layout,
                                 int count, int in_hand) {
  (void)game, (void)layout, (void)count, (void)in_hand;
  return 0.0;
}

const carom_plan_rules carom_threecushion = {.on = potting_on,
                                             .judge = threecushion_judge,
                                             .left = threecushion_left,
                                             .value = threecushion_value,
                                             .race = CAROM_RACE_ALONE};
