/* The numbers of a ball and of its cushions, in the order of carom_ball_kind: one row each. Checks,
 * faults, keys of files and recordings, and copies between structs are made of these rows.
 *
 * BALL(member, key, unit, low, high, other, ERROR, READER, text), or CUSHION(...) where
 * carom_cushion_options has the member too.
 *
 * key:    in files of `carom shoot`.
 * low, high: both ends belong to the range.
 * other:  an allowed value outside the range; NAN: there is none. Where it is 0, that is a default.
 * ERROR:  the status of a number that is neither.
 * READER: ALWAYS, BY_CUSHION(MODEL) or BY_FRICTION(LAW): what reads it. WITH(MODEL, number): a
 *         cushion too, and where that other number is 0, this one must be 0.
 *
 * Every argument is a name, a number or a text, or CAROM_ABOVE() or CAROM_BELOW() of one, which are
 * the next doubles: scripts read it. */
#ifndef CAROM_SRC_SCHEMA_NUMBERS_H
#define CAROM_SRC_SCHEMA_NUMBERS_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#define CAROM_ABOVE(x) ((x) == 0 ? DBL_TRUE_MIN : (x) * (1 + DBL_EPSILON))
#define CAROM_BELOW(x) ((x) * (1 - DBL_EPSILON / 2))

#define CAROM_NUMBERS(BALL, CUSHION)                                                            \
  BALL(mass, "m", "kg", CAROM_ABOVE(0), DBL_MAX, NAN, MASS, ALWAYS, "mass")                     \
  BALL(radius, "R", "m", CAROM_ABOVE(0), DBL_MAX, NAN, RADIUS, ALWAYS, "radius")                \
  BALL(mu_slide, "u_s", "", CAROM_ABOVE(0), 1, NAN, MU_MOTION, ALWAYS,                          \
       "sliding friction of ball and cloth")                                                    \
  BALL(mu_roll, "u_r", "", CAROM_ABOVE(0), 1, NAN, MU_MOTION, ALWAYS, "rolling resistance")     \
  BALL(mu_spin, "u_sp", "", CAROM_ABOVE(0), 1, NAN, MU_MOTION, ALWAYS,                          \
       "friction of the ball turning on the spot")                                              \
  BALL(mu_ball, "u_b", "", 0, 1, NAN, MU_BALL, BY_FRICTION(CONSTANT), "friction between balls") \
  BALL(restitution, "e_b", "", 0, 1, NAN, RESTITUTION, ALWAYS, "restitution of two balls")      \
  BALL(mu_cushion, "f_c", "", 0, 1, NAN, MU_CUSHION, ALWAYS, "friction of ball and cushion")    \
  BALL(restitution_cushion, "e_c", "", 0, 1, NAN, RESTITUTION, ALWAYS,                          \
       "restitution of ball and cushion")                                                       \
  BALL(gravity, "g", "m/s^2", CAROM_ABOVE(0), 1e6, NAN, GRAVITY, ALWAYS, "gravity")             \
  BALL(drag, "drag", "1/m", 0, 1, NAN, DRAG, ALWAYS,                                            \
       "deceleration of a rolling ball divided by the square of its speed")                     \
  CUSHION(roll_loss, "roll_loss", "", 0, 1, NAN, BALL_CUSHION, ALWAYS,                          \
          "part of the speed along a cushion that an impact takes from the roll along it")      \
  BALL(law_a, "law_a", "", 0, 1, NAN, MU_BALL, BY_FRICTION(ALCIATORE),                          \
       "friction between balls at great slips; law_a, law_b and law_c 0: carom_alciatore()")    \
  BALL(law_b, "law_b", "", 0, 1, NAN, MU_BALL, BY_FRICTION(ALCIATORE),                          \
       "by how much friction between balls is greater at small slips")                          \
  BALL(law_c, "law_c", "s/m", 0, DBL_MAX, NAN, MU_BALL, BY_FRICTION(ALCIATORE),                 \
       "how fast friction between balls falls with the slip")                                   \
  BALL(nose_height, "nose_height", "m", 0, DBL_MAX, NAN, BALL_CUSHION, ALWAYS,                  \
       "height of the noses of all cushions above the cloth; 0: those of the table")            \
  CUSHION(omega_ratio, "omega_ratio", "", CAROM_ABOVE(1), CAROM_BELOW(2), 0, OMEGA_RATIO,       \
          BY_CUSHION(STRONGE),                                                                  \
          "frequency of the nose along its surface divided by that across it; 0: 1.8")          \
  BALL(restitution_table, "e_t", "", 0, 0.98, -1, RESTITUTION, ALWAYS,                          \
       "restitution of ball and slate; 0: 0.5; -1: none")                                       \
  BALL(modulus, "modulus", "Pa", 1e6, 1e15, 0, MODULUS, ALWAYS,                                 \
       "E/(1 - nu^2) of the ball, for contacts that last; 0: 6.6e9")                            \
  CUSHION(restitution_log, "e_c_log", "", -1, 1, NAN, SPEED_LOG, ALWAYS,                        \
          "change of the cushion's restitution for each unit of ln(speed)")                     \
  CUSHION(mu_log, "f_c_log", "", -1, 1, NAN, SPEED_LOG, ALWAYS,                                 \
          "change of the cushion's friction for each unit of ln(speed)")                        \
  CUSHION(                                                                                      \
      smooth_q, "smooth_q", "", 1e-12, 0.5, 0, SMOOTH, BY_CUSHION(SMOOTH),                      \
      "width of the change from sticking to sliding; 0: all numbers of smooth as on one table") \
  CUSHION(smooth_x, "smooth_x", "", 0, 2, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                  \
          "part of the slip along the cushion that friction takes")                             \
  CUSHION(smooth_t, "smooth_t", "", 0, 2, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                  \
          "part of the slip across the cushion that friction takes")                            \
  CUSHION(smooth_a, "smooth_a", "", 0, 1, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                  \
          "how much farther friction across the cushion reaches")                               \
  CUSHION(smooth_k, "smooth_k", "", 0, 1, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                  \
          "part of the impulse that the rebound gains where friction reaches its limit")        \
  CUSHION(smooth_g, "smooth_g", "", -1, 1, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                 \
          "part of the impulse that the rebound gains, at most, where friction slides")         \
  CUSHION(smooth_g_log, "smooth_g_log", "", -1, 1, NAN, SMOOTH, WITH(SMOOTH, smooth_q),         \
          "change of smooth_g for each unit of ln(speed)")                                      \
  CUSHION(smooth_e, "smooth_e", "", -1, 1, NAN, SMOOTH, WITH(SMOOTH, smooth_q),                 \
          "restitution that a ball which rolls into the cushion gains, at most")                \
  CUSHION(restitution_log2, "e_c_log2", "", -1, 1, NAN, SPEED_LOG, ALWAYS,                      \
          "change of the cushion's restitution with ln(speed)^2, which counts up to 1")         \
  CUSHION(roll_loss_log, "roll_loss_log", "", -1, 1, NAN, SPEED_LOG, ALWAYS,                    \
          "change of roll_loss for each unit of ln(speed)")

/* Conditions on several numbers of `k`, each of which is within its range: BALL(member to blame,
 * condition, ERROR, text) or CUSHION(...), as above. The text describes the member. */
#define CAROM_CONDITIONS(BALL, CUSHION)                                                          \
  BALL(law_b, k->law_a + k->law_b <= 1.0, MU_BALL, "at most 1 - law_a")                          \
  BALL(nose_height, k->nose_height < 2.0 * k->radius, BALL_CUSHION, "below 2 R")                 \
  CUSHION(smooth_x, (k->smooth_q > 0) <= (k->smooth_x > 0), SMOOTH, "above 0 where smooth_q is") \
  CUSHION(smooth_t, (k->smooth_q > 0) <= (k->smooth_t > 0), SMOOTH, "above 0 where smooth_q is")

/* Numbers of other structs, doubles unless the header says otherwise, in their order: ROW(member,
 * key, unit, low, high, other, ERROR, text), as above. LATER(...): it is checked where more is
 * known, as the radius of the balls. */
#define CAROM_CUE_NUMBERS(ROW, LATER)                                                             \
  ROW(speed, "V0", "m/s", 0, 1e3, NAN, CUE_SPEED,                                                 \
      "speed of the cue before the strike; 0: no strike")                                         \
  ROW(phi, "phi", "degrees", -1e9, 1e9, NAN, CUE_PHI, "direction, from +x towards +y")            \
  ROW(theta, "theta", "degrees", 0, 90, NAN, CUE_THETA, "elevation of the butt")                  \
  LATER(a, "a", "R", -1, 1, NAN, MISCUE, "where the tip touches, to the left of the centre")      \
  LATER(b, "b", "R", -1, 1, NAN, MISCUE, "where the tip touches, above the centre")               \
  ROW(mass, "M", "kg", CAROM_ABOVE(0), DBL_MAX, NAN, CUE_MASS, "mass of the cue")                 \
  ROW(end_mass, "end_mass", "kg", CAROM_ABOVE(0), DBL_MAX, NAN, CUE_END_MASS,                     \
      "effective mass of the end of the cue, which causes squirt")                                \
  ROW(tip_restitution, "tip_restitution", "", 0, 1, NAN, CUE_TIP_RESTITUTION,                     \
      "restitution of tip and ball; 0: 1")                                                        \
  ROW(tip_radius, "tip_radius", "m", 0, DBL_MAX, NAN, CUE_TIP_RADIUS,                             \
      "radius of the tip, which no strike reads")                                                 \
  LATER(ball, "", "", 0, CAROM_BALLS_MOST - 1, NAN, CUE_BALL, "index of the ball that is struck") \
  ROW(miscue, "miscue", "R", 0, 1, NAN, CUE_MISCUE,                                               \
      "offset at which the tip slips off the ball; 0: 1")                                         \
  ROW(tip_time, "tip_time", "s", 0, 0.01, -1, CUE_TIP_TIME,                                       \
      "how long the tip of a raised cue touches the ball; 0: 0.001; -1: no time")                 \
  ROW(follow, "follow", "m", 0, 1, NAN, CUE_FOLLOW,                                               \
      "how far the cue goes on after it has touched the ball; 0: it stops")

#define CAROM_TABLE_NUMBERS(ROW, LATER)                                                  \
  ROW(width, "w", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "width, for racks and drawings")   \
  ROW(length, "l", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "length, for racks and drawings") \
  ROW(ball_radius, "ball_radius", "m", 0, DBL_MAX, NAN, TABLE,                           \
      "radius of the balls for which rails are placed; 0: the commonest radius")         \
  ROW(rail_width, "rail_width", "m", 0, DBL_MAX, NAN, TABLE,                             \
      "width of the tops of rails; 0: 0.12")                                             \
  ROW(pocket_back, "pocket_back", "m", 0, DBL_MAX, NAN, TABLE,                           \
      "height of the backs of pockets; 0: that of the highest nose")                     \
  ROW(slope_x, "slope_x", "", -1, 1, NAN, SLOPE, "rise of the cloth along x")            \
  ROW(slope_y, "slope_y", "", -1, 1, NAN, SLOPE, "rise of the cloth along y")

#define CAROM_MEASURES_NUMBERS(ROW, LATER)                                                         \
  LATER(width, "width", "m", 0.1, 100, NAN, TABLE, "width of the playing area, between the noses") \
  LATER(length, "length", "m", 0.1, 100, NAN, TABLE, "length of the playing area")                 \
  LATER(nose_height, "nose_height", "m", CAROM_ABOVE(0), 1, NAN, TABLE, "height of the noses")     \
  LATER(cushion_depth, "cushion_depth", "m", 0.001, 0.5, NAN, TABLE, "depth of the facings")       \
  LATER(corner_mouth, "corner", "m", 0.01, 1, NAN, TABLE,                                          \
        "mouth of corner pockets, between the points of noses; both mouths 0: no pockets")         \
  LATER(corner_cut, "corner_cut", "degrees", 90, 165, NAN, TABLE, "angle of nose and facing")      \
  LATER(corner_shelf, "corner_shelf", "m", 0, 0.2, NAN, TABLE, "from the mouth to the hole")       \
  LATER(corner_jaw, "corner_jaw", "m", 0, 0.5, NAN, TABLE, "radius of the points of noses")        \
  LATER(corner_hole, "corner_hole", "m", 0.005, 0.5, NAN, TABLE, "radius of the hole")             \
  LATER(side_mouth, "side", "m", 0.01, 1, NAN, TABLE,                                              \
        "mouth of side pockets, between the points of noses; both mouths 0: no pockets")           \
  LATER(side_cut, "side_cut", "degrees", 90, 165, NAN, TABLE, "angle of nose and facing")          \
  LATER(side_shelf, "side_shelf", "m", 0, 0.2, NAN, TABLE, "from the mouth to the hole")           \
  LATER(side_jaw, "side_jaw", "m", 0, 0.5, NAN, TABLE, "radius of the points of noses")            \
  LATER(side_hole, "side_hole", "m", 0.005, 0.5, NAN, TABLE, "radius of the hole")                 \
  LATER(facing_restitution, "facing_restitution", "", 0, 1, NAN, TABLE,                            \
        "restitution of ball and facing or jaw; 0: that of the ball")                              \
  LATER(facing_friction, "facing_friction", "", 0, 1, NAN, TABLE,                                  \
        "friction of ball and facing or jaw; 0: that of the ball")                                 \
  LATER(slope_x, "slope_x", "", -1, 1, NAN, TABLE, "rise of the cloth along x")                    \
  LATER(slope_y, "slope_y", "", -1, 1, NAN, TABLE, "rise of the cloth along y")

#define CAROM_RAIL_NUMBERS(ROW, LATER)                                                           \
  ROW(p, "", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "one end")                                      \
  ROW(q, "", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "the other end")                                \
  LATER(height, "", "m", CAROM_ABOVE(0), DBL_MAX, NAN, NOSE_HEIGHT,                              \
        "height of the nose above the cloth, below 2 R")                                         \
  ROW(line, "", "", -DBL_MAX, DBL_MAX, NAN, TABLE,                                               \
      "lx, ly and l0 of the line lx x + ly y + l0 = 0; all 0: through the ends")                 \
  ROW(side, "direction", "", 0, 1, NAN, TABLE,                                                   \
      "the side where balls are: 0 where that is below 0, 1 above")                              \
  ROW(mu_cushion, "f_c", "", 0, 1, NAN, TABLE, "friction of ball and rail; 0: that of the ball") \
  ROW(restitution, "e_c", "", 0, 1, NAN, TABLE, "restitution of ball and rail; 0: that of the ball")

#define CAROM_JAW_NUMBERS(ROW, LATER)                                                           \
  ROW(centre, "", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "centre")                                 \
  ROW(radius, "radius", "m", 0, DBL_MAX, NAN, TABLE, "radius")                                  \
  LATER(height, "", "m", CAROM_ABOVE(0), DBL_MAX, NAN, NOSE_HEIGHT,                             \
        "height of the nose above the cloth, below 2 R")                                        \
  ROW(mu_cushion, "f_c", "", 0, 1, NAN, TABLE, "friction of ball and jaw; 0: that of the ball") \
  ROW(restitution, "e_c", "", 0, 1, NAN, TABLE, "restitution of ball and jaw; 0: that of the ball")

#define CAROM_POCKET_NUMBERS(ROW, LATER)                          \
  ROW(centre, "", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "centre")   \
  ROW(radius, "radius", "m", 1e-9, DBL_MAX, NAN, TABLE, "radius") \
  ROW(depth, "depth", "m", -DBL_MAX, DBL_MAX, NAN, TABLE, "depth at which a ball lies in it")

#define CAROM_STATE_NUMBERS(ROW, LATER)                           \
  LATER(r, "", "m", -1e6, 1e6, NAN, POSITION, "centre")           \
  LATER(v, "", "m/s", -1e4, 1e4, NAN, VELOCITY, "velocity")       \
  LATER(w, "", "rad/s", -1e6, 1e6, NAN, SPIN, "angular velocity") \
  LATER(label, "", "", 0, 6, NAN, LABEL, "how it moves, a carom_label")

/* What a number of a ball represents where it is 0 and 0 is a default: carom_ball_kind_resolve()
 * writes these, and whoever reads a number takes them from here. The default of the law of friction
 * is carom_alciatore(). */
#define CAROM_USUAL_OMEGA_RATIO 1.8
#define CAROM_USUAL_RESTITUTION_TABLE 0.5
#define CAROM_USUAL_MODULUS 6.6e9 /* phenolic resin, docs/understanding/clusters.md */
#define CAROM_USUAL_SMOOTH(X) \
  X(smooth_q, 0.35)           \
  X(smooth_x, 1.3)            \
  X(smooth_t, 1.18)           \
  X(smooth_a, 0.25)           \
  X(smooth_k, 0.0)            \
  X(smooth_g, 0.067)          \
  X(smooth_g_log, -0.059)     \
  X(smooth_e, 0.06)

/* For the rows that are not wanted. */
#define CAROM_NO_ROW(...)

/* Whether a member of `k` is right by its row, without the conditions. */
#define CAROM_IS_RIGHT(member, low, high, extra, reader)                    \
  (((k->member >= (low) && k->member <= (high)) || k->member == (extra)) && \
   (CAROM_GIVEN_##reader || k->member == 0))
#define CAROM_GIVEN_ALWAYS true
#define CAROM_GIVEN_BY_CUSHION(model) true
#define CAROM_GIVEN_BY_FRICTION(law) true
#define CAROM_GIVEN_WITH(model, number) k->number > 0

/* Returns the error of the first number of `k` at fault. */
#define CAROM_CHECK_NUMBER(member, key, unit, low, high, extra, error, reader, text) \
  if (!CAROM_IS_RIGHT(member, low, high, extra, reader))                             \
    return CAROM_ERROR_##error;
#define CAROM_CHECK_ROW(member, key, unit, low, high, extra, error, text) \
  if (!CAROM_IS_RIGHT(member, low, high, extra, ALWAYS))                  \
    return CAROM_ERROR_##error;
#define CAROM_CHECK_CONDITION(member, holds, error, text) \
  if (!(holds))                                           \
    return CAROM_ERROR_##error;

#endif
