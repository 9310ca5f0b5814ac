/* Names of enumerations' values: one row each. cushion/list.h and friction/laws.h have the names of
 * models.
 *
 * WORD(OF, VALUE, word, text): OF is a carom_words, CAROM_VALUE the value. */
#ifndef CAROM_SRC_SCHEMA_WORDS_H
#define CAROM_SRC_SCHEMA_WORDS_H

#define CAROM_WORD_ROWS(WORD)                                                                      \
  WORD(WORLD, WORLD_CAROM, "carom", "an event occurs where a gap is closed and closing")           \
  WORD(WORLD, WORLD_POOLTOOL, "pooltool", "pooltool's rules of contact, which give its histories") \
  WORD(BALL_MODEL, BALL_MODEL_DEFAULT, "default", "exact; in the world pooltool inelastic")        \
  WORD(BALL_MODEL, BALL_MODEL_EXACT, "exact", "the exact limit of the 2014 model")                 \
  WORD(BALL_MODEL, BALL_MODEL_EULER, "euler", "the 2014 model in N steps")                         \
  WORD(BALL_MODEL, BALL_MODEL_INELASTIC, "inelastic", "one impulse in closed form, as pooltool")   \
  WORD(BALL_MODEL, BALL_MODEL_MIRROR, "mirror", "no friction")                                     \
  WORD(SHOT_CUSHION, SHOT_CUSHION_DEFAULT, "default",                                              \
       "smooth for balls with its numbers, else han; in the world pooltool stronge")               \
  WORD(SPACE, SPACE_3D, "3d", "balls can leave the cloth")                                         \
  WORD(SPACE, SPACE_FLAT, "flat", "balls stay on the cloth")                                       \
  WORD(SIMULTANEOUS, SIMULTANEOUS_CLUSTER, "cluster", "contacts last and overlap in time")         \
  WORD(SIMULTANEOUS, SIMULTANEOUS_PAIRS, "pairs", "one contact after the other")                   \
  WORD(CUSHION_CONVENTION, CONVENTION_PAPER, "paper", "that of the papers")                        \
  WORD(CUSHION_CONVENTION, CONVENTION_POOLTOOL, "pooltool", "that of pooltool")                    \
  WORD(CUSHION_LAW, CUSHION_LAW_CONSTANT, "constant", "restitution and friction as given")         \
  WORD(CUSHION_LAW, CUSHION_LAW_HAN, "han", "Han's fits over speed and angle")                     \
  WORD(GAME, GAME_POOL, "pool", "typical numbers of pool")                                         \
  WORD(GAME, GAME_SNOOKER, "snooker", "snooker, measured on films of broadcasts")                  \
  WORD(GAME, GAME_BILLIARD, "billiard", "three-cushion, measured on one table")                    \
  WORD(GAME, GAME_POOLTOOL_POOL, "pooltool_pool", "pooltool's numbers of pool")                    \
  WORD(GAME, GAME_POOLTOOL_SNOOKER, "pooltool_snooker", "pooltool's numbers of snooker")           \
  WORD(GAME, GAME_POOLTOOL_BILLIARD, "pooltool_billiard", "pooltool's numbers of carom")           \
  WORD(GAME, GAME_BLACKBALL, "blackball", "pool with balls of 2 inches")                           \
  WORD(GAME, GAME_PYRAMID, "pyramid", "pool with balls of 68 mm")                                  \
  WORD(GAME, GAME_FOURBALL, "fourball", "three-cushion with balls of 65.5 mm")                     \
  WORD(CONDITION, CONDITION_SLOW_CLOTH, "slow_cloth", "a napped or dirty cloth")                   \
  WORD(CONDITION, CONDITION_MEDIUM_CLOTH, "medium_cloth", "the cloth of the game pool")            \
  WORD(CONDITION, CONDITION_FAST_CLOTH, "fast_cloth", "a new cloth without nap")                   \
  WORD(CONDITION, CONDITION_OLD_CUSHION, "old_cushion", "slower; soft banks come back shorter")    \
  WORD(CONDITION, CONDITION_NEW_CUSHION, "new_cushion", "faster; soft banks come back longer")     \
  WORD(CONDITION, CONDITION_HUMID_CUSHION, "humid_cushion", "banks come back shorter")             \
  WORD(EVENT, EVENT_STRIKE, "stick_ball", "the cue strikes a ball")                                \
  WORD(EVENT, EVENT_BALL_BALL, "ball_ball", "two balls meet")                                      \
  WORD(EVENT, EVENT_RAIL, "ball_linear_cushion", "a ball meets a rail")                            \
  WORD(EVENT, EVENT_JAW, "ball_circular_cushion", "a ball meets a jaw")                            \
  WORD(EVENT, EVENT_POCKET, "ball_pocket", "a ball falls")                                         \
  WORD(EVENT, EVENT_SLIDING_ROLLING, "sliding_rolling", "a ball rolls from here on")               \
  WORD(EVENT, EVENT_ROLLING_SPINNING, "rolling_spinning", "a ball turns on the spot")              \
  WORD(EVENT, EVENT_ROLLING_STATIONARY, "rolling_stationary", "a rolling ball rests")              \
  WORD(EVENT, EVENT_SPINNING_STATIONARY, "spinning_stationary", "a turning ball rests")            \
  WORD(EVENT, EVENT_SLATE, "slate", "a ball lands")                                                \
  WORD(EVENT, EVENT_RAIL_TOP, "rail_top", "a ball lands on a rail")                                \
  WORD(EVENT, EVENT_LEFT_TABLE, "left_table", "a ball leaves the table")                           \
  WORD(LABEL, BALL_STATIONARY, "stationary", "at rest")                                            \
  WORD(LABEL, BALL_SPINNING, "spinning", "turning on the spot")                                    \
  WORD(LABEL, BALL_SLIDING, "sliding", "slipping over the cloth")                                  \
  WORD(LABEL, BALL_ROLLING, "rolling", "without slip")                                             \
  WORD(LABEL, BALL_POCKETED, "pocketed", "in a pocket")                                            \
  WORD(LABEL, BALL_AIRBORNE, "airborne", "in flight")                                              \
  WORD(LABEL, BALL_OFF, "off", "off the table")                                                    \
  WORD(TABLE, TABLE_POOL_7FT, "7ft", "pool, 7 feet")                                               \
  WORD(TABLE, TABLE_POOL_8FT, "8ft", "pool, 8 feet")                                               \
  WORD(TABLE, TABLE_POOL_9FT, "9ft", "pool, 9 feet")                                               \
  WORD(TABLE, TABLE_SNOOKER, "snooker", "snooker, 12 feet")                                        \
  WORD(TABLE, TABLE_THREECUSHION, "threecushion", "three-cushion, without pockets")                \
  WORD(TABLE, TABLE_POOLTOOL, "pooltool", "pooltool's default, 7 feet, with wider side pockets")   \
  WORD(TABLE, TABLE_HEYBALL, "heyball", "heyball, 9 feet, with rounded jaws")                      \
  WORD(TABLE, TABLE_BLACKBALL, "blackball", "blackball, 7 feet, with rounded jaws")                \
  WORD(TABLE, TABLE_PYRAMID, "pyramid", "Russian pyramid, 12 feet")                                \
  WORD(TABLE, TABLE_FOURBALL, "fourball", "four-ball, 9 feet, without pockets")                    \
  WORD(RACK, RACK_NINEBALL, "nineball",                                                            \
       "cue ball, then 1 to 9 by number; 1 in front, 9 in the middle")                             \
  WORD(RACK, RACK_EIGHTBALL, "eightball",                                                          \
       "cue ball, then 1 to 15 by number; 8 in the middle, both kinds in the corners")             \
  WORD(RACK, RACK_TENBALL, "tenball", "cue ball, then 1 to 10 by number; 10 in the middle")        \
  WORD(RACK, RACK_SNOOKER, "snooker", "white, 15 reds, yellow, green, brown, blue, pink, black")   \
  WORD(RACK, RACK_THREECUSHION, "threecushion", "white, yellow, red, as for the opening")          \
  WORD(RACK, RACK_NINEONSPOT, "nineonspot", "nine-ball's, with the 9 on the foot spot")            \
  WORD(RACK, RACK_BLACKBALL, "blackball", "eight-ball's, with the 8 on the foot spot")             \
  WORD(RACK, RACK_ROTATION, "rotation",                                                            \
       "cue ball, then 1 to 15 by number; 1 in front, 15 in the middle")                           \
  WORD(RACK, RACK_PYRAMID, "pyramid", "the yellow ball, then 15 white ones")                       \
  WORD(RACK, RACK_FOURBALL, "fourball", "white, yellow and two reds, as for the opening")          \
  WORD(RACK, RACK_COWBOY, "cowboy", "cue ball, and the balls 1, 3 and 5 on their spots")           \
  WORD(RACK, RACK_BILLIARDS, "billiards", "white, yellow, which is down, and red on the spot")     \
  WORD(SOLVER, SOLVER_EXACT, "exact", "the limit of infinitely many steps")                        \
  WORD(SOLVER, SOLVER_EULER, "euler", "N steps of equal impulse")                                  \
  WORD(SOLVER, SOLVER_FAST, "fast", "exact in less time, but not smooth")                          \
  WORD(SLIP, SLIP_PAPER, "paper", "that of the 2014 paper")                                        \
  WORD(SLIP, SLIP_POOLTOOL, "pooltool", "that of pooltool")                                        \
  WORD(ISA, ISA_PLAIN, "plain", "plain C, on every processor")                                     \
  WORD(ISA, ISA_SSE2, "sse2", "x86-64: 2 doubles at a time")                                       \
  WORD(ISA, ISA_NEON, "neon", "arm64: 2 doubles at a time")                                        \
  WORD(ISA, ISA_AVX2, "avx2", "x86-64: 4 doubles at a time")                                       \
  WORD(ISA, ISA_AVX512, "avx512", "x86-64: 8 doubles at a time")

#endif
