/* The options of a plan, a row each, as schema/options.h has those of shots. */
#ifndef CAROM_PLAN_OPTIONS_H
#define CAROM_PLAN_OPTIONS_H

#include <float.h>
#include <stdint.h>

#define CAROM_PLAN_OPTIONS(OPTION)                                                                 \
  OPTION(shots, "shots", COUNT, 100, 1000000, OPTIONS,                                             \
         "shots of the whole layout that a plan plays, about; 0: 2000; by seconds 200000")         \
  OPTION(scan, "", NUMBER(""), -DBL_MAX, 0.9, OPTIONS,                                             \
         "share of them in all directions; 0: 0.5; below 0: none")                                 \
  OPTION(seed, "seed", SEED, 0, UINT64_MAX, OPTIONS, "of the errors of strokes")                   \
  OPTION(                                                                                          \
      threads, "threads", COUNT, -1, INT32_MAX, OPTIONS,                                           \
      "most threads, the calling one among them; 0: that one alone; -1: one for each processor")   \
  OPTION(level, "", FLAG, 0, 1, OPTIONS,                                                           \
         "1: by a level cue, whose stick may be in cushions and balls; 0: the stick is over them") \
  OPTION(chance_me, "", NUMBER(""), 0, 1, OPTIONS,                                                 \
         "chance of each later pot of a visit, of the player; 0: by the layout")                   \
  OPTION(chance_opponent, "", NUMBER(""), 0, 1, OPTIONS,                                           \
         "chance of each later pot of a visit, of the opponent; 0: by the layout")                 \
  OPTION(                                                                                          \
      unsure, "unsure", NUMBER(""), 0, 1, OPTIONS,                                                 \
      "how little the player knows of the table; 0: he knows it; 1: as little as of any table. "   \
      "Its cushions and cloth are drawn, as his errors are")                                       \
  OPTION(seconds, "seconds", NUMBER("s"), 0, 1e6, OPTIONS,                                         \
         "time of its calls, s, at which a plan is stopped; 0: none")                              \
  OPTION(once, "", FLAG, 0, 1, OPTIONS, "1: all shots are one plan, though it may be stopped")

#endif
