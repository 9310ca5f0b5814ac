/* The referee: the ruling of one played stroke. The shot is not played again: its facts and final
 * states are from carom_shoot() or carom_record_play().
 *
 * judge() of the rules has the facts and the balls that were in play; a shot that ended in an error
 * and one that was passed have the facts of a stroke that met nothing. The layout is the one after
 * the shot, or before it if the shot is taken back; carom_turn_settle() then spots balls, and may
 * change the turn. A cue ball in hand is out of play until it is placed. */
#include "rules.h"

#include <stdio.h>
#include <string.h>

/* Balls that fell, the first one first. */
static int64_t list_falls(const carom_facts *facts, int count, carom_fall *fall) {
  int64_t falls = 0;
  for (int k = 0; k < count; k++) {
    if (!(facts->down >> k & 1))
      continue;
    int64_t index = falls++;
    for (; index > 0 && fall[index - 1].time > facts->pocket_time[k]; index--)
      fall[index] = fall[index - 1];
    fall[index] = (carom_fall){facts->pocket_time[k], k, facts->pocket[k]};
  }
  return falls;
}

/* Whether all that the referee reads is there. */
static bool is_whole(const carom_plan_rules *rules, const carom_table *table,
                     const carom_shot_ball *balls, const carom_shot *shot) {
  if (rules == NULL || rules->judge == NULL || table == NULL || balls == NULL)
    return false;
  return shot == NULL || (shot->facts != NULL && shot->final != NULL);
}

/* The layout that the turn leaves, before balls return; shot NULL: there is none. */
static void lay_out(const carom_shot_ball *balls, int count, const carom_shot *shot,
                    carom_ruling *ruling) {
  const bool taken_back = shot == NULL || ruling->turn.leave == CAROM_LEAVE_BEFORE;
  for (int k = 0; k < count; k++) {
    ruling->balls[k] = balls[k];
    if (!taken_back)
      ruling->balls[k].state = shot->final[k];
  }
}

/* The balls that the referee moves from where the stroke left them, as a set. */
static uint32_t moved_by_referee(const carom_shot_ball *balls, int count, const carom_shot *shot,
                                 const carom_ruling *ruling) {
  uint32_t moved = 0;
  for (int k = 0; k < count; k++) {
    const carom_ball_state *left = &balls[k].state;
    if (shot != NULL)
      left = &shot->final[k];
    moved |= (uint32_t)(memcmp(&ruling->balls[k].state, left, sizeof *left) != 0) << k;
  }
  return moved;
}

/* Whether the game continues after a turn. */
static bool goes_on(const carom_turn *turn) {
  return turn->outcome < CAROM_TURN_WIN;
}

/* The balls that the next player may hit first. */
static uint32_t balls_on(const carom_plan_rules *rules, const carom_ruling *ruling, int count,
                         int cue_ball) {
  if (rules->on == NULL)
    return 0;
  return rules->on(&ruling->state, carom_on_table(ruling->balls, count) & ~carom_only(cue_ball));
}

/* WPA 1.5: with the cue ball in hand behind the head string, and all balls that are on behind it
 * too, the player may have the nearest one spotted. On a table without pockets CAROM_CHOICE_SPOT is
 * another rule. The call's pocket is the ball, where several are equally near. */
static bool spots_nearest(const carom_plan_rules *rules, const carom_table *table, carom_call call,
                          int count, int cue_ball, carom_ruling *ruling) {
  if (table->pockets == 0)
    return false;
  const bool is_allowed = (ruling->state.may & CAROM_CHOICE_SPOT) != 0;
  ruling->state.may &= ~CAROM_CHOICE_SPOT;
  if (!is_allowed || call.ball != CAROM_CALL_SPOT)
    return false;
  const uint32_t nearest =
      carom_nearest_behind(table, ruling->balls, count, balls_on(rules, ruling, count, cue_ball));
  uint32_t ball = carom_lowest_of(nearest);
  if (call.pocket >= 0 && call.pocket < count && (nearest >> call.pocket & 1))
    ball = carom_only(call.pocket);
  ruling->turn = (carom_turn){CAROM_TURN_KEEP, CAROM_LEAVE_KITCHEN, CAROM_FOUL_NONE, ball, 0.0};
  return true;
}

carom_status carom_referee(const carom_plan_rules *rules, const carom_table *table,
                           const carom_shot_ball *balls, int count, int cue_ball,
                           const carom_shot *shot, carom_call call, carom_ruling *ruling) {
  if (ruling == NULL || !is_whole(rules, table, balls, shot))
    return CAROM_ERROR_NULL;
  if (count < 1 || count > CAROM_BALLS_MOST || cue_ball < 0 || cue_ball >= count)
    return CAROM_ERROR_BALLS;

  for (int k = 0; shot != NULL && k < 2; k++)
    if (shot->facts->first[k] < -1 || shot->facts->first[k] >= count)
      return CAROM_ERROR_BALLS;

  /* what happened; without a shot no ball was met */
  memset(ruling, 0, sizeof *ruling);
  ruling->state = rules->state;
  ruling->facts.first[0] = ruling->facts.first[1] = -1;
  if (shot != NULL)
    ruling->facts = *shot->facts;
  ruling->falls = list_falls(&ruling->facts, count, ruling->fall);
  memcpy(ruling->balls, balls, (size_t)count * sizeof *balls);
  const bool spots = spots_nearest(rules, table, call, count, cue_ball, ruling);
  if (!spots)
    ruling->turn =
        rules->judge(&ruling->state, carom_on_table(balls, count), cue_ball, &ruling->facts, call);
  ruling->turn = carom_turn_seen(rules, &ruling->state, ruling->turn);

  /* the layout, with balls that return */
  lay_out(balls, count, shot, ruling);
  carom_status status;
  if (spots)
    status = carom_spot_ball(table, ruling->balls, count,
                             carom_count_of(carom_lowest_of(ruling->turn.spot) - 1));
  else
    status = carom_turn_settle(rules, &ruling->state, table, ruling->balls, count, &ruling->turn);
  ruling->put = moved_by_referee(balls, count, shot, ruling);

  /* who plays next, and how */
  ruling->hand = ruling->turn.leave >= CAROM_LEAVE_ANYWHERE;
  if (ruling->hand == 0)
    ruling->touching = carom_touching(ruling->balls, count, cue_ball);
  if (goes_on(&ruling->turn))
    ruling->on = balls_on(rules, ruling, count, cue_ball);
  const bool behind = ruling->turn.leave == CAROM_LEAVE_KITCHEN && table->pockets > 0;
  if (behind && carom_nearest_behind(table, ruling->balls, count, ruling->on) != 0)
    ruling->state.may |= CAROM_CHOICE_SPOT;
  return status;
}

/* A text with what the next player may do in addition to a stroke, each after "; ". A cue ball that
 * may be placed in the D is in hand, which the leave has. */
static void write_choices(int32_t choices, carom_leave leave, char *text, size_t room) {
  size_t size = 0;
  text[0] = '\0';
  for (int32_t choice = 1; choice <= CAROM_CHOICE_SPOT; choice *= 2) {
    const char *words = carom_word_text(CAROM_WORDS_CHOICE, choice);
    if (choice == CAROM_CHOICE_SPOT && leave == CAROM_LEAVE_KITCHEN)
      words = "may have the ball nearest to the head string spotted";
    if (choice != CAROM_CHOICE_PLACE && (choices & choice) != 0)
      size += (size_t)snprintf(text + size, room - size, "; %s", words);
  }
}

size_t carom_ruling_string(const carom_ruling *ruling, char *text, size_t room) {
  if (ruling == NULL || (uint32_t)ruling->turn.outcome > CAROM_TURN_DRAW ||
      (uint32_t)ruling->turn.leave > CAROM_LEAVE_BAULK)
    return 0;
  char foul[200] = "", leave[80] = "", choices[200] = "";
  const char *turn = carom_word_text(CAROM_WORDS_TURN, (int)ruling->turn.outcome);
  if (ruling->turn.outcome == CAROM_TURN_PASS && ruling->state.innings == CAROM_LAST_INNING)
    turn = "the other has the equalizing inning";
  if (ruling->turn.foul != CAROM_FOUL_NONE) {
    /* rules of a caller may have fouls that are not listed */
    const char *why = carom_word_text(CAROM_WORDS_FOUL, ruling->turn.foul);
    if (why == NULL)
      why = carom_word_text(CAROM_WORDS_FOUL, CAROM_FOUL_OTHER);
    snprintf(foul, sizeof foul, "foul: %s; ", why);
  }
  if (goes_on(&ruling->turn)) {
    if (ruling->turn.leave != CAROM_LEAVE_AFTER)
      snprintf(leave, sizeof leave, ", %s",
               carom_word_text(CAROM_WORDS_LEAVE, (int)ruling->turn.leave));
    write_choices(ruling->state.may, ruling->turn.leave, choices, sizeof choices);
  }
  if (text == NULL)
    room = 0;
  const int size = snprintf(text, room, "%s%s%s%s", foul, turn, leave, choices);
  return (size_t)carom_max(size, 0);
}
