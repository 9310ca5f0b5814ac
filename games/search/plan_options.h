/* The options of a plan, a row each, as schema/options.h has those of shots. */
#ifndef CAROM_PLAN_OPTIONS_H
#define CAROM_PLAN_OPTIONS_H

#include <float.h>
#include <stdint.h>

#define CAROM_PLAN_OPTIONS(OPTION)                                                                \
  OPTION(shots, "shots", COUNT, 100, 1000000, OPTIONS,                                            \
         "about how many shots of the whole layout a plan plays; 0: 2000; with seconds 200000")   \
  OPTION(scan, "", NUMBER(""), -DBL_MAX, 0.9, OPTIONS,                                            \
         "share of the shots in all directions; 0: 0.5; below 0: none")                           \
  OPTION(seed, "seed", SEED, 0, UINT64_MAX, OPTIONS, "seed of the errors of strokes")             \
  OPTION(threads, "threads", COUNT, -1, INT32_MAX, OPTIONS,                                       \
         "largest number of threads, including the calling one; 0: only that one; -1: one for "   \
         "each processor")                                                                        \
  OPTION(level, "", FLAG, 0, 1, OPTIONS,                                                          \
         "1: with a level cue, whose stick may pass through cushions and balls; 0: the stick is " \
         "above them")                                                                            \
  OPTION(chance_me, "", NUMBER(""), 0, 1, OPTIONS,                                                \
         "the player's chance of each later pot of a visit; 0: it follows from the layout")       \
  OPTION(chance_opponent, "", NUMBER(""), 0, 1, OPTIONS,                                          \
         "the opponent's chance of each later pot of a visit; 0: it follows from the layout")     \
  OPTION(unsure, "unsure", NUMBER(""), 0, 1, OPTIONS,                                             \
         "how little the player knows about the table; 0: the player knows it; 1: as little as "  \
         "about any table. Its cushions and cloth are drawn at random, like the errors")          \
  OPTION(seconds, "seconds", NUMBER("s"), 0, 1e6, OPTIONS,                                        \
         "time of the calls of a plan, s, at which it is stopped; 0: none")                       \
  OPTION(once, "", FLAG, 0, 1, OPTIONS, "1: all shots make one plan, although it may be stopped") \
  OPTION(safeties, "", FLAG, 0, 1, OPTIONS,                                                       \
         "1: only safeties: strokes that without errors pass the turn without a foul")

#endif
