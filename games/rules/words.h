/* The words of a game, a row each. The texts of the library, the command, recordings and other
 * languages are made of these rows; the headers have the numbers, and what each means to a caller.
 *
 * WORD(OF, VALUE, word, text): OF is the end of a carom_words, CAROM_VALUE the value. The word
 * is the end of the enumerator's name, so that all languages share it. games.h has those of
 * games. */
#ifndef CAROM_PLAN_WORDS_H
#define CAROM_PLAN_WORDS_H

#define CAROM_GAME_WORD_ROWS(WORD)                                                                 \
  /* what happens to the turn, of the player who has played */                                     \
  WORD(TURN, TURN_KEEP, "keep", "plays on")                                                        \
  WORD(TURN, TURN_PASS, "pass", "the other plays")                                                 \
  WORD(TURN, TURN_WIN, "win", "has won")                                                           \
  WORD(TURN, TURN_LOSE, "lose", "has lost")                                                        \
  WORD(TURN, TURN_DRAW, "draw", "has drawn")                                                       \
  /* the layout of the next stroke; "": as the balls lie */                                        \
  WORD(LEAVE, LEAVE_AFTER, "after", "")                                                            \
  WORD(LEAVE, LEAVE_BEFORE, "before", "with the balls as before")                                  \
  WORD(LEAVE, LEAVE_ANYWHERE, "anywhere", "cue ball in hand")                                      \
  WORD(LEAVE, LEAVE_KITCHEN, "kitchen", "cue ball in hand behind the head string")                 \
  WORD(LEAVE, LEAVE_D, "d", "cue ball in hand in the D")                                           \
  WORD(LEAVE, LEAVE_BAULK, "baulk", "cue ball in hand behind the baulk line")                      \
  /* why a shot is a foul */                                                                       \
  WORD(FOUL, FOUL_NONE, "none", "")                                                                \
  WORD(FOUL, FOUL_CUE_BALL, "cue_ball", "the cue ball fell or left the table")                     \
  WORD(FOUL, FOUL_NO_BALL, "no_ball", "the cue ball met no ball")                                  \
  WORD(FOUL, FOUL_FIRST, "first", "the cue ball first met a ball that is not on")                  \
  WORD(FOUL, FOUL_OFF, "off", "a ball left the table")                                             \
  WORD(FOUL, FOUL_CUSHION, "cushion",                                                              \
       "nothing fell, and nothing met a cushion after the first contact")                          \
  WORD(FOUL, FOUL_BREAK, "break", "the break potted nothing, and drove too few balls to cushions") \
  WORD(FOUL, FOUL_OTHER, "other", "another rule")                                                  \
  WORD(FOUL, FOUL_POT, "pot", "a ball fell that was not on")                                       \
  WORD(FOUL, FOUL_DOUBLE_HIT, "double_hit",                                                        \
       "the tip was still on the cue ball, or touched it again, as it met a ball")                 \
  WORD(FOUL, FOUL_JUMP, "jump", "the cue ball jumped over a ball")                                 \
  /* what a player may decide in addition to strokes; the text is of the player */                 \
  WORD(CHOICE, CHOICE_PASS, "pass", "may pass")                                                    \
  WORD(CHOICE, CHOICE_PUSH, "push", "may push out")                                                \
  WORD(CHOICE, CHOICE_FREE_BALL, "free_ball", "has a free ball")                                   \
  WORD(CHOICE, CHOICE_PLACE, "place", "may place the cue ball in the D")                           \
  WORD(CHOICE, CHOICE_RACK, "rack", "may have the balls racked and break")                         \
  WORD(CHOICE, CHOICE_OTHER_RACK, "other_rack", "may have the balls racked for the other")         \
  WORD(CHOICE, CHOICE_STAY, "stay", "may leave the cue ball where it lies")                        \
  WORD(CHOICE, CHOICE_SPOT, "spot", "may have the touching balls spotted")                         \
  /* the group of a player in eight-ball */                                                        \
  WORD(GROUP, GROUP_OPEN, "open", "the table is open")                                             \
  WORD(GROUP, GROUP_SOLIDS, "solids", "1 to 7")                                                    \
  WORD(GROUP, GROUP_STRIPES, "stripes", "9 to 15")                                                 \
  /* what a match waits for */                                                                     \
  WORD(PHASE, MATCH_NONE, "none", "the match has not begun")                                       \
  WORD(PHASE, MATCH_STROKE, "stroke", "a stroke, or a choice")                                     \
  WORD(PHASE, MATCH_PLACE, "place", "a position of the cue ball in hand, or a choice")             \
  WORD(PHASE, MATCH_MOVING, "moving", "the rest of a shot that was stopped")                       \
  WORD(PHASE, MATCH_OVER, "over", "nothing: the match is over")                                    \
  /* the acts of a match in addition to strokes and places */                                      \
  WORD(ACT, ACT_CHOOSE, "choose", "one of the choices")                                            \
  WORD(ACT, ACT_CALL, "call", "the ball and the pocket of the next stroke")                        \
  WORD(ACT, ACT_CONCEDE, "concede", "the player concedes the game")                                \
  WORD(ACT, ACT_CLOCK, "clock", "the time for the stroke is over")                                 \
  WORD(ACT, ACT_EXTEND, "extend", "the player takes an extension of the time")                     \
  WORD(ACT, ACT_TIMEOUT, "timeout", "the player takes a timeout")                                  \
  /* why an act was rejected */                                                                    \
  WORD(REFUSAL, REFUSED_NOT, "not", "")                                                            \
  WORD(REFUSAL, REFUSED_NOT_BEGUN, "not_begun", "the match has not begun")                         \
  WORD(REFUSAL, REFUSED_OVER, "over", "the match is over")                                         \
  WORD(REFUSAL, REFUSED_TURN, "turn", "another seat is at the table, or sent the line")            \
  WORD(REFUSAL, REFUSED_MOVING, "moving", "balls move")                                            \
  WORD(REFUSAL, REFUSED_AT_REST, "at_rest", "no ball moves, so no shot can be continued")          \
  WORD(REFUSAL, REFUSED_IN_HAND, "in_hand", "the cue ball must be placed first")                   \
  WORD(REFUSAL, REFUSED_NO_HAND, "no_hand", "the cue ball is not in hand")                         \
  WORD(REFUSAL, REFUSED_BOUNDS, "bounds", "the position is outside the bounds")                    \
  WORD(REFUSAL, REFUSED_OCCUPIED, "occupied", "a ball or a cushion is in the way")                 \
  WORD(REFUSAL, REFUSED_CHOICE, "choice", "the rules do not allow this choice now")                \
  WORD(REFUSAL, REFUSED_CALL, "call", "the game does not know this call, or the ball is not on")   \
  WORD(REFUSAL, REFUSED_CUE_BALL, "cue_ball", "a ball other than the cue ball would be struck")    \
  WORD(REFUSAL, REFUSED_STROKE, "stroke", "the stroke cannot be played")                           \
  WORD(REFUSAL, REFUSED_BEGIN, "begin", "a match cannot begin in this way")                        \
  WORD(REFUSAL, REFUSED_LINE, "line", "a line that was read breaks the rules")                     \
  WORD(REFUSAL, REFUSED_LIMIT, "limit", "the stroke is beyond the limits of the match")            \
  WORD(REFUSAL, REFUSED_TIME, "time", "no extension or timeout is left")                           \
  WORD(REFUSAL, REFUSED_NOTE, "note", "a value of the note is not allowed")                        \
  /* what a stroke is to leave */                                                                  \
  WORD(GOAL, GOAL_WIN, "win", "the best chance to win")                                            \
  WORD(GOAL, GOAL_HIDDEN, "hidden", "no ball that is on can be hit in a straight line")            \
  WORD(GOAL, GOAL_SNOOKER, "snooker", "other balls are in the way to an edge of the ball")         \
  WORD(GOAL, GOAL_NEAR, "near", "the cue ball rests near the place")                               \
  WORD(GOAL, GOAL_APART, "apart", "the balls are apart from all others")                           \
  /* kinds of strokes; the texts are the names that players use, as in pot_kind.c */               \
  WORD(PLAN_KIND, PLAN_POT, "pot", "pot")                                                          \
  WORD(PLAN_KIND, PLAN_SCAN, "scan", "scan")                                                       \
  WORD(PLAN_KIND, PLAN_FOUL, "foul", "foul")                                                       \
  WORD(PLAN_KIND, PLAN_GIVEN, "given", "given")                                                    \
  WORD(PLAN_KIND, PLAN_PUSH, "push", "push-out")                                                   \
  WORD(PLAN_KIND, PLAN_PASS, "pass", "pass")                                                       \
  WORD(PLAN_KIND, PLAN_BREAK, "break", "break")                                                    \
  WORD(PLAN_KIND, PLAN_BANK, "bank", "bank")                                                       \
  WORD(PLAN_KIND, PLAN_KICK, "kick", "kick")                                                       \
  WORD(PLAN_KIND, PLAN_COMBINATION, "combination", "combination")                                  \
  WORD(PLAN_KIND, PLAN_CAROM, "carom", "carom")                                                    \
  WORD(PLAN_KIND, PLAN_SAFETY, "safety", "safety")                                                 \
  WORD(PLAN_KIND, PLAN_KISS, "kiss", "kiss")                                                       \
  WORD(PLAN_KIND, PLAN_RAIL_FIRST, "rail_first", "rail first")                                     \
  /* groups of strokes to practise; the texts are their names */                                   \
  WORD(PRACTICE, PRACTICE_STRAIGHT, "straight", "short straight pot")                              \
  WORD(PRACTICE, PRACTICE_CUT, "cut", "short cut")                                                 \
  WORD(PRACTICE, PRACTICE_THIN, "thin", "short thin cut")                                          \
  WORD(PRACTICE, PRACTICE_LONG_STRAIGHT, "long_straight", "long straight pot")                     \
  WORD(PRACTICE, PRACTICE_LONG_CUT, "long_cut", "long cut")                                        \
  WORD(PRACTICE, PRACTICE_LONG_THIN, "long_thin", "long thin cut")                                 \
  WORD(PRACTICE, PRACTICE_INDIRECT, "indirect", "bank, kick, combination")                         \
  WORD(PRACTICE, PRACTICE_OTHER, "other", "no pot")

#endif
