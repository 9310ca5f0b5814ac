/* Options of calls: one row each. Checks, the line of options in recordings, the fingerprint of a
 * stopped shot, copies, and the options of the command and of other languages are made from these
 * rows.
 *
 * OPTION(member, key, FORM, low, high, ERROR, text)
 *
 * key: the option of the command; "": no option. FORM: WORDS(OF), an enumeration from 0 of which
 * `high` is the last; COUNT; FLAG, 0 or 1;
 *       SEED, any; NUMBER(unit), a double; SET(OF), whose bits are values with names, or BALLS.
 * low, high, ERROR: as in numbers.h; and 0, which is the default of each. */
#ifndef CAROM_SRC_SCHEMA_OPTIONS_H
#define CAROM_SRC_SCHEMA_OPTIONS_H

#include "schema/numbers.h"

#include <stdint.h>

/* Options of carom_shot_options that decide the motion, in the order of recordings. The number
 * behind the text is the position of the option's 32 bits in the fingerprint of a stopped shot. */
#define CAROM_MOTION_OPTIONS(OPTION)                                                               \
  OPTION(world, "world", WORDS(WORLD), 0, CAROM_WORLD_POOLTOOL, WORLD,                             \
         "rules of contact, and the default models", 0)                                            \
  OPTION(ball_model, "ball-model", WORDS(BALL_MODEL), 0, CAROM_BALL_MODEL_MIRROR, BALL_MODEL,      \
         "model of the collision of two balls (default: exact; in the world pooltool inelastic)",  \
         1)                                                                                        \
  OPTION(cushion_model, "cushion", WORDS(SHOT_CUSHION), 0, CAROM_CUSHION_MODEL_COUNT,              \
         SHOT_CUSHION_MODEL,                                                                       \
         "model of the impact on a cushion; mathavan, the exact limit, is the slowest (default: "  \
         "smooth for balls with a smooth_q, such as those of carom's games, else han; in the "     \
         "world pooltool stronge)",                                                                \
         2)                                                                                        \
  OPTION(friction, "friction", WORDS(BALL_FRICTION), 0, CAROM_LAW_COUNT - 1, FRICTION,             \
         "friction between balls: a function of the speed of slip (default), or their mu_ball", 3) \
  OPTION(steps, "steps", COUNT, 0, INT32_MAX, STEPS, "steps of Euler's models; 0: 1000", 5)        \
  OPTION(space, "space", WORDS(SPACE), 0, CAROM_SPACE_FLAT, SPACE,                                 \
         "whether balls can leave the cloth (default: 3d); the world pooltool is flat", 4)         \
  OPTION(simultaneous, "simultaneous", WORDS(SIMULTANEOUS), 0, CAROM_SIMULTANEOUS_PAIRS,           \
         SIMULTANEOUS,                                                                             \
         "contacts of several balls at one instant, as in a rack: they last and overlap in time "  \
         "(default), or are resolved one after the other, as always in the world pooltool and "    \
         "with the models euler and inelastic",                                                    \
         7)                                                                                        \
  OPTION(cluster_steps, "cluster-steps", COUNT, 0, 10000, CLUSTER_STEPS,                           \
         "steps of the integrator of clusters for the duration of a contact; 0: 25", 8)

/* Options of carom_shot_options that decide when a shot stops. */
#define CAROM_STOP_OPTIONS(OPTION)                                                                 \
  OPTION(time_most, "time-most", NUMBER("s"), 0, DBL_MAX, TIME_MOST,                               \
         "time on the clock of a shot, s, at which the shot is stopped; 0: none, but 1000 s are "  \
         "an error")                                                                               \
  OPTION(                                                                                          \
      stop_at, "", SET(EVENT), 0, 8191, STOP_AT,                                                   \
      "events right after which a shot is stopped; bit 0: a contact of the cue ball with another") \
  OPTION(first_of, "", SET(BALLS), 0, UINT64_MAX, SHOT_OPTIONS,                                    \
         "a shot is stopped after the first contact of the cue ball if the other ball is none of " \
         "these; 0: it is not stopped")                                                            \
  OPTION(events_most, "events-most", COUNT, 0, INT32_MAX, EVENTS_MOST,                             \
         "largest number of events of a shot; 0: 10000")

/* Options of carom_shot_options that decide how it is computed. */
#define CAROM_THREAD_OPTIONS(OPTION)                                                               \
  OPTION(threads, "threads", COUNT, -1, INT32_MAX, THREADS,                                        \
         "largest number of threads of a batch, including the calling one; 0: only that one; -1: " \
         "one for each processor")
#define CAROM_COMPUTE_OPTIONS(OPTION)                                                              \
  OPTION(                                                                                          \
      fast, "", FLAG, 0, 1, FAST,                                                                  \
      "1: computes with the instruction set in use; 0: computes the bits that all machines share") \
  CAROM_THREAD_OPTIONS(OPTION)

#define CAROM_SHOT_OPTIONS(OPTION) \
  CAROM_MOTION_OPTIONS(OPTION) CAROM_STOP_OPTIONS(OPTION) CAROM_COMPUTE_OPTIONS(OPTION)

/* Options of calls of single impacts. */
#define CAROM_CALL_OPTIONS(OPTION)                                                              \
  OPTION(steps, "steps", COUNT, 0, INT32_MAX, STEPS, "steps of Euler's method; 0: 1000")        \
  OPTION(plain, "", FLAG, 0, 1, PLAIN,                                                          \
         "1: computes with the instruction set plain, and so the bits that all machines share") \
  CAROM_THREAD_OPTIONS(OPTION)

/* Options of carom_options, for two balls. */
#define CAROM_IMPACT_OPTIONS(OPTION)                                    \
  OPTION(solver, "solver", WORDS(SOLVER), 0, CAROM_SOLVER_FAST, SOLVER, \
         "how the collision is solved")                                 \
  OPTION(slip, "slip", WORDS(SLIP), 0, CAROM_SLIP_POOLTOOL, SLIP,       \
         "sign of the spin in the slip over the cloth")                 \
  CAROM_CALL_OPTIONS(OPTION)

/* Options of carom_cushion_options, in addition to the numbers of numbers.h. */
#define CAROM_RAIL_OPTIONS(OPTION)                                                              \
  OPTION(model, "model", WORDS(CUSHION_MODEL), 0, CAROM_CUSHION_MODEL_COUNT - 1, CUSHION_MODEL, \
         "model of the impact")                                                                 \
  CAROM_CALL_OPTIONS(OPTION)                                                                    \
  OPTION(convention, "convention", WORDS(CUSHION_CONVENTION), 0, CAROM_CONVENTION_POOLTOOL,     \
         CONVENTION, "the convention to follow where pooltool differs from the papers")         \
  OPTION(law, "law", WORDS(CUSHION_LAW), 0, CAROM_CUSHION_LAW_HAN, CUSHION_LAW,                 \
         "where restitution and friction of the cushion come from")                             \
  OPTION(least_step, "least-step", NUMBER("N s"), 0, DBL_MAX, LEAST_STEP,                       \
         "smallest impulse of a step of Euler's method; pooltool: 0.001")

/* Whether the value x of an option is right. */
#define CAROM_IN_FLAG(x, low, high) ((uint32_t)(x) <= (uint32_t)(high))
#define CAROM_IN_COUNT(x, low, high) (((x) >= (low) && (x) <= (high)) || (x) == 0)
#define CAROM_IN_BITS(x, low, high) (((x) & ~(uint64_t)(high)) == 0)
#define CAROM_IN_SEED(x, low, high) true
#define CAROM_IN_WORDS(KIND) CAROM_IN_FLAG
#define CAROM_IN_NUMBER(unit) CAROM_IN_COUNT
#define CAROM_IN_SET(KIND) CAROM_IN_BITS

/* Returns the error of the first option of `o` at fault. */
#define CAROM_CHECK_OPTION(member, key, FORM, low, high, error, ...) \
  if (!CAROM_IN_##FORM(o->member, low, high))                        \
    return CAROM_ERROR_##error;

#endif
