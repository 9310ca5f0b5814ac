/* Games as data: who may be met first, what a shot amounts to, how many balls are left. World
 * Standardized Rules of the WPA (2016), sections 2 and 3, with the simplifications that
 * carom_plan.h names. Games of points have their own files. */
#include "rules.h"
#include "games.h"

#include <stddef.h>

enum { OPEN = CAROM_GROUP_OPEN, SOLIDS = CAROM_GROUP_SOLIDS, STRIPES = CAROM_GROUP_STRIPES };
static const uint32_t balls_of[] = {0xfefe, 0xfe, 0xfe00}, eight = 0x100;

static const carom_turn win = {CAROM_TURN_WIN, CAROM_LEAVE_AFTER, 0, 0, 0.0};

static carom_turn foul_for(int32_t why) {
  return (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_ANYWHERE, why, 0, 0.0};
}

/* ---- Eight-ball */

/* The balls of the player; on an open table, of both. */
static uint32_t own_of(const carom_rules_state *game) {
  if ((uint32_t)game->group > STRIPES)
    return balls_of[OPEN];
  return balls_of[game->group];
}

/* Of a game that is not over. In blackball, free_ball means that the stroke is free. */
static uint32_t eightball_targets(const carom_rules_state *game, uint32_t in_play) {
  const uint32_t group = in_play & own_of(game);
  if (game->opening != 0 || game->free_ball != 0)
    return in_play & 0xfffe;
  if (group == 0)
    return in_play & eight;
  return group;
}

static uint32_t eightball_on(const carom_rules_state *game, uint32_t in_play) {
  if ((in_play & eight) == 0)
    return 0;
  return eightball_targets(game, in_play);
}

/* On an open table the player takes the group of which fewer balls are left. */
static void eightball_left(const carom_rules_state *game, uint32_t in_play, int32_t left[2]) {
  const int solids = carom_count_of(in_play & balls_of[SOLIDS]),
            stripes = carom_count_of(in_play & balls_of[STRIPES]);
  const bool open = game->group == OPEN;
  left[0] = 1 + stripes;
  left[1] = 1 + solids;
  if (game->group == SOLIDS || (open && solids < stripes)) {
    left[0] = 1 + solids;
    left[1] = 1 + stripes;
  }
}

static void swap_groups(carom_rules_state *game) {
  if (game->group == SOLIDS || game->group == STRIPES)
    game->group = SOLIDS + STRIPES - game->group;
}

/* The turn goes to the other: the state becomes his. */
static carom_turn give(carom_rules_state *game, carom_turn turn) {
  swap_groups(game);
  return carom_give(game, turn);
}

/* Whether the player may leave the cue ball where it is: it is on the table. */
static int32_t may_stay(const carom_facts *facts, int cue_ball) {
  if ((facts->down | facts->off) >> cue_ball & 1)
    return 0;
  return CAROM_CHOICE_STAY;
}

/* The turn after a foul in blackball: the cue ball is placed in baulk or stays, balls that left the
 * table return, and the next stroke is free. */
static carom_turn free_stroke_for(carom_rules_state *game, const carom_facts *facts, int cue_ball,
                                  int32_t foul, int32_t choices) {
  game->free_ball = 1;
  game->may = choices | may_stay(facts, cue_ball);
  return (carom_turn){CAROM_TURN_PASS, CAROM_LEAVE_BAULK, foul, facts->off & 0xfffe, 0.0};
}

/* The break, by the WPA, 3.3: nothing is called, the eight returns, and the table is open. */
static carom_turn eightball_break(carom_rules_state *game, const carom_facts *facts, int cue_ball,
                                  int32_t foul) {
  const uint32_t eight_gone = (facts->down | facts->off) & eight;
  const bool legal = carom_is_break(facts, cue_ball);
  carom_turn turn = {CAROM_TURN_PASS, CAROM_LEAVE_AFTER, foul, eight_gone, 0.0};
  if (eight_gone != 0)
    game->may = CAROM_CHOICE_RACK;
  if (!legal)
    game->may = CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK;

  /* a break that is not legal: the other has the table as it is, or a new rack, 3.3(d); that it
   * meets no cushion, or no ball, adds nothing to that */
  if (!legal && foul != CAROM_FOUL_CUE_BALL && foul != CAROM_FOUL_DOUBLE_HIT) {
    if (foul != CAROM_FOUL_NO_BALL)
      turn.foul = CAROM_FOUL_BREAK;
    return turn;
  }

  /* a foul: the other has the cue ball behind the head string, or leaves it where it is */
  if (foul != CAROM_FOUL_NONE) {
    turn.leave = CAROM_LEAVE_KITCHEN;
    game->may |= may_stay(facts, cue_ball);
    return turn;
  }
  if ((facts->down & 0xfffe) != 0)
    turn.outcome = CAROM_TURN_KEEP;
  return turn;
}

/* The break of blackball: the black has the balls racked again, without a foul; and a foul gives a
 * free stroke. A break that pots none drives two balls past the middle. */
static carom_turn blackball_break(carom_rules_state *game, const carom_facts *facts, int cue_ball,
                                  int32_t foul) {
  enum { PAST_MIDDLE = 2 };
  if ((facts->down & eight) != 0) {
    game->opening = 1;
    return (carom_turn){CAROM_TURN_KEEP, CAROM_LEAVE_BAULK, CAROM_FOUL_NONE, 0xfffe, 0.0};
  }
  const bool pots = (facts->down & 0xfffe) != 0;
  int32_t choices = 0;
  if (foul == CAROM_FOUL_CUSHION)
    foul = CAROM_FOUL_NONE;
  if (!pots && carom_count_of(facts->past_middle & 0xfffe) < PAST_MIDDLE) {
    choices = CAROM_CHOICE_RACK;
    if (foul == CAROM_FOUL_NONE)
      foul = CAROM_FOUL_BREAK;
  }
  if (foul != CAROM_FOUL_NONE)
    return free_stroke_for(game, facts, cue_ball, foul, choices);
  if (pots)
    return carom_keep;
  return carom_pass;
}

/* How the games with two groups differ. */
typedef struct eight_game {
  bool calls;        /* ball and pocket are called */
  bool free_strokes; /* after a foul, as in blackball */
  bool counts_fouls; /* a third one in a row loses */
} eight_game;

/* The turn after a foul that is not on the break. */
static carom_turn eight_foul(const eight_game *as, carom_rules_state *game,
                             const carom_facts *facts, int cue_ball, int32_t foul) {
  if (as->free_strokes)
    return give(game, free_stroke_for(game, facts, cue_ball, foul, 0));
  if (!as->counts_fouls)
    return give(game, foul_for(foul));
  swap_groups(game);
  return carom_give_hand(game, foul, 0);
}

/* The balls that keep the turn, and decide the groups of an open table: the one that was called, or
 * those that fell. */
static uint32_t eight_made(const eight_game *as, const carom_facts *facts, carom_call call) {
  if (!as->calls)
    return facts->down & balls_of[OPEN];
  if (!carom_is_called(facts, call))
    return 0;
  return carom_only(call.ball);
}

/* The foul of a stroke. In blackball a ball that touches is not played towards, none is jumped, and
 * a ball of the other group may fall only together with an own ball, or in a free stroke. */
static int32_t eight_foul_of(const eight_game *as, const carom_rules_state *game, uint32_t targets,
                             int cue_ball, const carom_facts *facts) {
  if (!as->free_strokes)
    return (int32_t)carom_foul_of(facts, targets, cue_ball);

  /* a ball on that touches is met by playing away from it */
  carom_facts played = *facts;
  const int first = carom_first_of(facts, targets);
  if (first != facts->first[0]) {
    played.first[0] = first;
    played.first_set = carom_only(first);
    played.cushions_after += facts->cushions[cue_ball];
  }
  const int32_t foul = (int32_t)carom_foul_of(&played, targets, cue_ball);
  const bool excused = foul == CAROM_FOUL_CUSHION && game->on != 0; /* snookered, 5g */
  if (foul != CAROM_FOUL_NONE && !excused)
    return foul;
  if (facts->pushed != 0)
    return CAROM_FOUL_DOUBLE_HIT;
  if ((facts->jumped & 0xfffe) != 0)
    return CAROM_FOUL_JUMP;

  const uint32_t fell = facts->down & balls_of[OPEN];
  const bool binds = game->opening == 0 && game->free_ball == 0;
  if (binds && fell != 0 && (fell & own_of(game)) == 0)
    return CAROM_FOUL_POT;
  return CAROM_FOUL_NONE;
}

/* The eight is gone: it wins as the last ball, without a foul, and where shots are called in its
 * pocket. In blackball it may fall with the last balls of the group. */
static carom_turn eight_ends(const eight_game *as, uint32_t remain, const carom_facts *facts,
                             carom_call call, int32_t foul) {
  if (as->free_strokes)
    remain &= ~facts->down;
  const bool called = !as->calls || (carom_is_called(facts, call) && call.ball == 8);
  if (remain == 0 && foul == CAROM_FOUL_NONE && called)
    return win;
  return (carom_turn){CAROM_TURN_LOSE, CAROM_LEAVE_AFTER, foul, 0, 0.0};
}

static carom_turn judge_eight(const eight_game *as, carom_rules_state *game, uint32_t in_play,
                              int cue_ball, const carom_facts *facts, carom_call call) {
  carom_turn turn;
  if (carom_racks_again(game, call.ball, 0xfffe, &turn)) {
    if (as->free_strokes && turn.spot != 0)
      turn.leave = CAROM_LEAVE_BAULK;
    return turn;
  }
  const uint32_t targets = eightball_targets(game, in_play), group = own_of(game);
  const bool opening = game->opening != 0, is_free = game->free_ball != 0;
  const int32_t foul = eight_foul_of(as, game, targets, cue_ball, facts);
  game->opening = game->may = game->free_ball = game->on = 0;
  if (opening && as->free_strokes)
    return blackball_break(game, facts, cue_ball, foul);
  if (opening)
    return eightball_break(game, facts, cue_ball, foul);

  /* an eight that left the table returns in blackball */
  uint32_t gone = facts->down;
  if (!as->free_strokes)
    gone |= facts->off;
  if ((gone & eight) != 0)
    return eight_ends(as, in_play & group, facts, call, foul);
  if (foul != CAROM_FOUL_NONE)
    return eight_foul(as, game, facts, cue_ball, foul);

  /* the first balls that are made decide the groups, where they are of one */
  game->fouls[0] = 0;
  uint32_t counts = group;
  if (as->calls)
    counts = targets;
  const uint32_t counted = eight_made(as, facts, call) & counts;
  if (counted == 0 && !is_free)
    return give(game, carom_pass);
  if (game->group == OPEN && !is_free) {
    const bool solids = (counted & balls_of[SOLIDS]) != 0,
               stripes = (counted & balls_of[STRIPES]) != 0;
    if (solids && !stripes)
      game->group = SOLIDS;
    else if (!solids)
      game->group = STRIPES;
  }
  return carom_keep;
}

static carom_turn eightball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                  const carom_facts *facts, carom_call call) {
  static const eight_game as = {.calls = true};
  return judge_eight(&as, game, in_play, cue_ball, facts, call);
}

static carom_turn blackball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                  const carom_facts *facts, carom_call call) {
  static const eight_game as = {.free_strokes = true};
  return judge_eight(&as, game, in_play, cue_ball, facts, call);
}

static carom_turn heyball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                const carom_facts *facts, carom_call call) {
  static const eight_game as = {.counts_fouls = true};
  return judge_eight(&as, game, in_play, cue_ball, facts, call);
}

CAROM_RULES_OBJECT(carom_eightball) = {.on = eightball_on,
                                       .judge = eightball_judge,
                                       .left = eightball_left,
                                       .race = CAROM_RACE_OWN,
                                       .first_decides = 1,
                                       .breaks = 1,
                                       .settle = carom_settle_rack,
                                       .rack = CAROM_RACK_EIGHTBALL};

/* Whether the next player is snookered: no part of a ball that is on can be hit in a straight line.
 * A cue ball in hand is not. */
static int32_t is_snookered(const carom_rules_state *game, const carom_shot_ball *balls, int count,
                            const carom_turn *turn) {
  if (turn->leave >= CAROM_LEAVE_ANYWHERE || turn->outcome >= CAROM_TURN_WIN)
    return 0;
  const uint32_t others = carom_on_table(balls, count) & 0xfffe;
  const uint32_t targets = eightball_on(game, others);
  for (int k = 1; targets >> k != 0; k++)
    if ((targets >> k & 1) && carom_is_seen(balls, others, balls[0].state.r, k))
      return 0;
  return targets != 0;
}

static void blackball_settle(carom_rules_state *game, const carom_table *table,
                             carom_shot_ball *balls, int count, carom_turn *turn) {
  carom_plan_rules usual = carom_blackball;
  usual.settle = NULL;
  carom_turn_settle(&usual, game, table, balls, count, turn);
  game->on = is_snookered(game, balls, count, turn);
}

/* Blackball: the rules of the WPA, of 2005 by the titles of the sections 4 (play) and 5 (fouls),
 * and section 8 of those of 2025: the break (8.5), balls that touch, the fouls (8.13), and the
 * black, which loses on a foul or while a ball of the group remains after the stroke. A new rack
 * after a break that is a foul is of 2005; the player who requests it breaks. A player who is
 * snookered needs no cushion (definition 11, 5g): only balls hide others, the jaws of pockets do
 * not. A ball is jumped where the cue ball passes over a part of it before it meets any ball: so
 * clubs that print the English rules of eight-ball define the foul, and the WPA's definition was
 * not at hand. */
CAROM_RULES_OBJECT(carom_blackball) = {.on = eightball_on,
                                       .judge = blackball_judge,
                                       .left = eightball_left,
                                       .race = CAROM_RACE_OWN,
                                       .first_decides = 1,
                                       .breaks = 1,
                                       .settle = blackball_settle,
                                       .rack = CAROM_RACK_BLACKBALL};

/* Heyball: Rules of Heyball of the World Heyball Masters (2017, 2019), sections 4 to 13, in which
 * nothing is called; three fouls in a row are of the rules of the Chinese association. The break is
 * as in eight-ball. Where balls of both groups fall on an open table, it stays open: the texts at
 * hand do not settle it. */
CAROM_RULES_OBJECT(carom_heyball) = {.on = eightball_on,
                                     .judge = heyball_judge,
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
  if (carom_is_double_hit(facts))
    return CAROM_FOUL_DOUBLE_HIT;
  return CAROM_FOUL_NONE;
}

int32_t carom_rotation_foul_of(const carom_facts *facts, uint32_t targets, int cue_ball,
                               bool opening, bool pushes) {
  int32_t foul = (int32_t)carom_foul_of(facts, targets, cue_ball);
  if (pushes && foul != CAROM_FOUL_CUE_BALL)
    foul = (int32_t)push_out_foul_of(facts);
  const bool so_far = foul == CAROM_FOUL_NONE || foul == CAROM_FOUL_CUSHION;
  if (so_far && opening && !carom_is_break(facts, cue_ball))
    foul = CAROM_FOUL_BREAK;
  return foul;
}

bool carom_is_below_target(const carom_rules_state *game, const carom_facts *facts,
                           uint32_t balls) {
  return carom_count_of((facts->down | facts->at_head) & balls) < game->target;
}

carom_turn carom_give_hand(carom_rules_state *game, int32_t foul, uint32_t spot) {
  carom_turn turn = foul_for(foul);
  turn.spot = spot;
  if (carom_is_third_foul(game, true))
    turn.outcome = CAROM_TURN_LOSE;
  return carom_give(game, turn);
}

/* The balls just below the nine that win too, by a handicap. */
static uint32_t money_balls(const carom_rules_state *game) {
  enum { NINE = 9 };
  const int count = (int)carom_min(game->lost[0], NINE - 1);
  return (UINT32_C(1) << NINE) - (UINT32_C(1) << (NINE - count));
}

static carom_turn nineball_judge(carom_rules_state *game, uint32_t in_play, int cue_ball,
                                 const carom_facts *facts, carom_call call) {
  const bool opening = game->opening != 0;
  const bool pushes = (game->may & CAROM_CHOICE_PUSH) && call.ball == CAROM_CALL_PUSH;
  const bool passes = (game->may & CAROM_CHOICE_PASS) && call.ball == CAROM_CALL_PASS;
  game->opening = game->may = 0;
  if (passes)
    return carom_give(game, carom_pass);

  /* the nine wins, or the highest ball of a game without it; it returns after a foul or a
   * push-out */
  const uint32_t wins = carom_highest_of(in_play & 0x3fe);
  const int32_t foul =
      carom_rotation_foul_of(facts, nineball_on(game, in_play), cue_ball, opening, pushes);
  if (foul != CAROM_FOUL_NONE)
    return carom_give_hand(game, foul, (facts->down | facts->off) & wins);
  if (pushes) {
    carom_turn turn = carom_pass;
    turn.spot = facts->down & wins;
    game->may = CAROM_CHOICE_PASS;
    return carom_give(game, turn);
  }

  game->fouls[0] = 0;
  if (opening && carom_is_below_target(game, facts, in_play & 0x3fe)) {
    carom_turn turn = carom_pass;
    turn.spot = facts->down & wins;
    game->may = CAROM_CHOICE_PASS;
    return carom_give(game, turn);
  }
  if ((facts->down & (wins | money_balls(game))) != 0)
    return win;
  if (opening)
    game->may = CAROM_CHOICE_PUSH;
  if (facts->down != 0)
    return carom_keep;
  return carom_give(game, carom_pass);
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
  const uint32_t targets = potting_on(game, in_play);
  const int32_t foul = (int32_t)carom_foul_of(facts, targets, cue_ball);
  if (foul != CAROM_FOUL_NONE && foul != CAROM_FOUL_CUSHION) {
    carom_turn turn = foul_for(foul);
    if ((targets & ~(facts->down | facts->off)) == 0) /* no ball is left to be played */
      turn.outcome = CAROM_TURN_LOSE;
    return turn;
  }
  carom_turn turn = carom_pass;
  if (facts->down != 0)
    turn = carom_keep;
  if (facts->down != 0 && (facts->down & targets) == targets)
    turn = win;
  turn.points = carom_count_of(facts->down & targets);
  return turn;
}

CAROM_RULES_OBJECT(carom_potting) = {
    .on = potting_on, .judge = potting_judge, .left = potting_left, .race = CAROM_RACE_ALONE};
