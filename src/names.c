/* Names and texts of the public enumerations. The lists are private; carom.h spells the
 * enumerators out, and the compiler says where the two differ. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include "platform/enumerations.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

/* X(NAME, value, name, text) */
#define STATUS_LIST(X)                                                                             \
  X(OK, 0, "ok", "resolved")                                                                       \
  X(SEPARATING, 1, "separating",                                                                   \
    "the balls do not approach each other; their state is returned unchanged")                     \
  X(STOPPED_AT_TIME, 2, "stopped_at_time",                                                         \
    "the shot was stopped at options.time_most, as asked; balls still move")                       \
  X(STOPPED_AT_EVENT, 3, "stopped_at_event",                                                       \
    "the shot was stopped after an event of options.stop_at, as asked")                            \
  X(ERROR_NULL, -1, "null_pointer", "a required pointer is NULL")                                  \
  X(ERROR_SOLVER, -2, "bad_solver", "options.solver is not one of carom_solver")                   \
  X(ERROR_SLIP, -3, "bad_slip", "options.slip is not one of carom_slip")                           \
  X(ERROR_STEPS, -4, "bad_steps", "options.steps must not be negative (0 is the default)")         \
  X(ERROR_POSITION, -5, "bad_position", "a position must be finite")                               \
  X(ERROR_VELOCITY, -6, "bad_velocity", "a velocity must be finite")                               \
  X(ERROR_SPIN, -7, "bad_spin", "an angular velocity must be finite")                              \
  X(ERROR_RADIUS, -8, "bad_radius", "a radius must be positive and finite")                        \
  X(ERROR_MASS, -9, "bad_mass", "a mass must be positive and finite")                              \
  X(ERROR_MU_SLIDE, -10, "bad_mu_slide", "the friction of ball and cloth must be in [0, 1]")       \
  X(ERROR_MU_BALL, -11, "bad_mu_ball", "the friction of ball and ball must be in [0, 1]")          \
  X(ERROR_RESTITUTION, -12, "bad_restitution", "the restitution must be in [0, 1]")                \
  X(ERROR_RADII_DIFFER, -13, "radii_differ", "both balls must have the same radius")               \
  X(ERROR_HEIGHTS_DIFFER, -14, "heights_differ", "both centres must be at the same height")        \
  X(ERROR_VERTICAL, -15, "vertical_velocity",                                                      \
    "the vertical velocity must be 0: both balls stay on the table")                               \
  X(ERROR_COINCIDENT, -16, "centres_coincide",                                                     \
    "the centres coincide, so there is no line of centres")                                        \
  X(ERROR_TOO_SLOW, -17, "too_slow",                                                               \
    "Euler's method is too slow here: its steps are lost in rounding, or more than 16 N of them "  \
    "are needed")                                                                                  \
  X(ERROR_OVERFLOW, -18, "overflow", "the collision overflows the range of double")                \
  X(ERROR_MASSES_DIFFER, -19, "masses_differ", "this model is for balls of equal mass only")       \
  X(ERROR_THREADS, -20, "bad_threads", "options.threads must be CAROM_ALL_THREADS, or 0 or more")  \
  X(ERROR_POINTS, -21, "bad_points", "a trace needs at least 2 points")                            \
  X(ERROR_UNRESOLVED, -22, "unresolved",                                                           \
    "the collision is too extreme: its result depends on rounding errors, or takes more work "     \
    "than a call may cost")                                                                        \
  X(ERROR_OPTIONS, -23, "bad_options", "a reserved or unused field of the options is not 0")       \
  X(ERROR_CUSHION_MODEL, -30, "bad_cushion_model",                                                 \
    "options.model is not one of carom_cushion_model")                                             \
  X(ERROR_NORMAL, -32, "bad_normal", "the direction into the cushion must be finite and not 0")    \
  X(ERROR_NOSE_HEIGHT, -33, "bad_nose_height",                                                     \
    "the nose must be between the cloth and the top of the ball")                                  \
  X(ERROR_MU_CUSHION, -34, "bad_mu_cushion", "the friction of ball and cushion must be in [0, 1]") \
  X(ERROR_JAW_RADIUS, -35, "bad_jaw_radius",                                                       \
    "the radius of a jaw must be finite and not negative")                                         \
  X(ERROR_CONVENTION, -36, "bad_convention",                                                       \
    "options.convention must be one of carom_cushion_convention")                                  \
  X(ERROR_CUSHION_LAW, -37, "bad_cushion_law", "options.law must be one of carom_cushion_law")     \
  X(ERROR_LEAST_STEP, -38, "bad_least_step",                                                       \
    "options.least_step must be 0 N s or more, and finite")                                        \
  X(ERROR_OMEGA_RATIO, -39, "bad_omega_ratio", "omega_ratio must be 0, or between 1 and 2")        \
  X(ERROR_SPEED_LOG, -24, "bad_speed_log",                                                         \
    "restitution_log, restitution_log2, mu_log and roll_loss_log must be -1 to 1")                 \
  X(ERROR_SMOOTH, -25, "bad_smooth",                                                               \
    "smooth_q must be 1e-12 to 0.5, smooth_x and smooth_t above 0 and at most 2, smooth_a and "    \
    "smooth_k 0 to 1, smooth_g, smooth_g_log and smooth_e -1 to 1; or all eight 0")

/* Those of whole shots. */
#define SHOT_STATUS_LIST(X)                                                                        \
  X(ERROR_TOO_MANY_EVENTS, -40, "too_many_events",                                                 \
    "the shot was stopped: it has more events than options.events_most")                           \
  X(ERROR_TOO_LONG, -41, "too_long",                                                               \
    "the shot was stopped: it lasts longer than 1000 s, and options.time_most is 0")               \
  X(ERROR_LEFT_TABLE, -42, "left_table",                                                           \
    "a ball on the cloth left the table, through a gap between its cushions")                      \
  X(ERROR_SHOT_OPTIONS, -43, "bad_shot_options",                                                   \
    "a reserved or unused field of the options, the job or the seeds is not 0, first_of has a "    \
    "ball beyond the layout, or a job has both balls and kinds")                                   \
  X(ERROR_BALLS, -44, "bad_balls",                                                                 \
    "the count of balls must be 1 to 32, and the index of a ball below it")                        \
  X(ERROR_LABEL, -45, "bad_label",                                                                 \
    "the label of a ball is none that a layout may have: 0 to 4, and in space 5 and 6")            \
  X(ERROR_OVERLAP, -46, "overlap", "two balls overlap")                                            \
  X(ERROR_OFF_TABLE, -47, "off_table", "a ball is not on the table")                               \
  X(ERROR_MU_MOTION, -48, "bad_mu_motion",                                                         \
    "frictions of sliding, rolling and spinning must be above 0 and at most 1")                    \
  X(ERROR_GRAVITY, -49, "bad_gravity", "gravity must be above 0 and at most 1e6 m/s^2")            \
  X(ERROR_MISCUE, -51, "miscue",                                                                   \
    "the tip misses the ball: a^2 + b^2 must be below miscue^2, which is 1 by default")            \
  X(ERROR_TABLE, -52, "bad_table",                                                                 \
    "the table has no part, a part that is not finite or has no length, friction or restitution "  \
    "outside 0 to 1, or a rail_width below the radius of a ball")                                  \
  X(ERROR_RACK, -53, "bad_rack",                                                                   \
    "no such rack, or its gap is not between 0 and R, or there is too little room")                \
  X(ERROR_EVENTS_LOST, -54, "events_lost",                                                         \
    "the events of the shot so far are not all there, as with too little room")                    \
  X(ERROR_TIME, -55, "bad_time",                                                                   \
    "the time is below 0, no number, or after the end of a shot stopped while balls moved")        \
  X(ERROR_DRAG, -56, "bad_drag", "the drag of a rolling ball must be 0 to 1 per metre")            \
  X(ERROR_BALL_CUSHION, -57, "bad_ball_cushion",                                                   \
    "a ball's roll_loss must be 0 to 1, its nose_height 0 to below 2 R")                           \
  X(ERROR_TABLE_OPEN, -61, "table_open",                                                           \
    "a ball can leave the table between two of its parts, or there is no place for a ball")        \
  X(ERROR_RAIL_SIDE, -62, "bad_rail_side",                                                         \
    "the played side of a rail is turned away from the table")                                     \
  X(ERROR_RAIL_LINE, -63, "bad_rail_line",                                                         \
    "the line of a rail does not pass through both of its ends")                                   \
  X(ERROR_TANGENT, -70, "no_tangent",                                                              \
    "derivatives are not known in the world pooltool, by Euler's model of balls, nor through a "   \
    "cluster")                                                                                     \
  X(ERROR_DIRECTIONS, -71, "bad_directions", "derivatives are in 1 to 64 directions at once")      \
  X(ERROR_MODULUS, -58, "bad_modulus", "a ball's modulus must be 0 or 1e6 to 1e15 Pa")             \
  X(ERROR_NO_TANGENTS, -72, "no_tangents",                                                         \
    "this library was built without derivatives, as it was without C++")                           \
  X(ERROR_STATE, -60, "bad_state",                                                                 \
    "shot.state, or a plan's memory, is damaged, of another build, or of nothing that can go on")  \
  X(ERROR_STATE_TABLE, -64, "other_table", "shot.state is that of a shot on another table")        \
  X(ERROR_STATE_BALLS, -65, "other_balls",                                                         \
    "shot.state is that of a shot of other balls, or of another layout")                           \
  X(ERROR_STATE_OPTIONS, -66, "other_options",                                                     \
    "shot.state is that of a shot with other options, besides those that say when to stop")        \
  X(ERROR_ROOM, -67, "bad_room",                                                                   \
    "shot.room must be 0 or more, and 0 where shot.events and shot.brief are both NULL")           \
  X(ERROR_CUE_SPEED, -80, "bad_cue_speed", "cue.speed must be 0 to 1000 m/s")                      \
  X(ERROR_CUE_PHI, -81, "bad_cue_phi", "cue.phi must be a direction of -1e9 to 1e9 degrees")       \
  X(ERROR_CUE_THETA, -82, "bad_cue_theta", "cue.theta must be 0 to 90 degrees")                    \
  X(ERROR_CUE_MASS, -83, "bad_cue_mass", "cue.mass must be positive and finite")                   \
  X(ERROR_CUE_END_MASS, -84, "bad_cue_end_mass", "cue.end_mass must be positive and finite")       \
  X(ERROR_CUE_BALL, -85, "bad_cue_ball",                                                           \
    "cue.ball must be the index of one of the balls, which are counted from 0")                    \
  X(ERROR_CUE_BALL_OUT, -86, "cue_ball_out",                                                       \
    "cue.ball must be in play, neither in a pocket nor off the table")                             \
  X(ERROR_CUE_MISCUE, -87, "bad_cue_miscue", "cue.miscue must be 0 to 1")                          \
  X(ERROR_CUE_TIP_TIME, -88, "bad_cue_tip_time", "cue.tip_time must be 0 to 0.01 s, or -1")        \
  X(ERROR_CUE_TIP_RESTITUTION, -89, "bad_cue_tip_restitution",                                     \
    "cue.tip_restitution must be 0 to 1; 0 stands for 1")                                          \
  X(ERROR_WORLD, -90, "bad_world",                                                                 \
    "options.world must be one of carom_world; of a cluster, CAROM_WORLD_CAROM")                   \
  X(ERROR_BALL_MODEL, -91, "bad_ball_model",                                                       \
    "options.ball_model must be one of carom_ball_model; of a cluster, the default, EXACT or "     \
    "MIRROR")                                                                                      \
  X(ERROR_SHOT_CUSHION_MODEL, -92, "bad_shot_cushion_model",                                       \
    "options.cushion_model must be one of carom_shot_cushion")                                     \
  X(ERROR_FRICTION, -93, "bad_friction", "options.friction must be one of carom_ball_friction")    \
  X(ERROR_SPACE, -94, "bad_space", "options.space must be one of carom_space")                     \
  X(ERROR_EVENTS_MOST, -95, "bad_events_most",                                                     \
    "options.events_most must not be negative (0 is the default)")                                 \
  X(ERROR_TIME_MOST, -96, "bad_time_most",                                                         \
    "options.time_most must be 0 or more, finite, and not before the time of a shot that goes on") \
  X(ERROR_STOP_AT, -97, "bad_stop_at",                                                             \
    "options.stop_at must be a set of CAROM_STOP_AT() and CAROM_STOP_AT_CONTACT")                  \
  X(ERROR_PLAIN, -98, "bad_plain", "options.plain must be 0 or 1")                                 \
  X(ERROR_SIMULTANEOUS, -99, "bad_simultaneous",                                                   \
    "options.simultaneous must be one of carom_simultaneous")                                      \
  X(ERROR_CLUSTER_STEPS, -100, "bad_cluster_steps",                                                \
    "options.cluster_steps must be 0 to 10000 (0 is the default)")                                 \
  X(ERROR_RECORD, -101, "bad_record", "the recording is wrong; record.fault says where and why")   \
  X(ERROR_REVISION, -102, "other_revision",                                                        \
    "the recording is of another revision of the physics, with which its shots have other bits")   \
  X(ERROR_IN_MOTION, -103, "in_motion",                                                            \
    "plans are made of layouts at rest, and a ball moves, turns or flies")                         \
  X(ERROR_GAME_OVER, -104, "game_over",                                                            \
    "no ball is left to be played: all that count are down, or the eight is")                      \
  X(ERROR_FAST, -105, "bad_fast", "options.fast must be 0 or 1")                                   \
  X(ERROR_CORNERS, -106, "bad_corners", "a table has 3 to 32 corners")                             \
  X(ERROR_SIDES_CROSS, -107, "sides_cross", "two sides of the table cross or touch")               \
  X(ERROR_CUE_FOLLOW, -108, "bad_cue_follow", "cue.follow must be 0 to 1 m")                       \
  X(ERROR_SCORE, -109, "bad_score",                                                                \
    "a rating must be 0 to 1000, games won and lost 0 to 1e9 each, and their number not negative") \
  X(ERROR_CUE_TIP_RADIUS, -110, "bad_cue_tip_radius", "cue.tip_radius must be 0 m or more")        \
  X(ERROR_TABLE_KIND, -111, "bad_table_kind", "there is no such kind of table")                    \
  X(ERROR_CORNER, -112, "bad_corner",                                                              \
    "a corner must lie within 1e6 m of 0, and its mouth be 0 to 1e6 m wide")                       \
  X(ERROR_CORNERS_MEET, -113, "corners_meet", "two corners of the table are at one place")         \
  X(ERROR_CORNERS_IN_LINE, -114, "corners_in_line", "all corners of the table lie on one line")    \
  X(ERROR_MOUTHS, -115, "mouths_too_wide",                                                         \
    "the mouths at both ends of a side leave nothing of its rail")                                 \
  X(ERROR_POCKETS, -116, "too_many_pockets", "a table has at most 8 pockets")                      \
  X(ERROR_JAWS, -117, "too_many_jaws", "a table has at most 32 jaws")                              \
  X(ERROR_RAILS, -118, "too_many_rails", "a table has at most 32 rails")                           \
  X(ERROR_ACT, -119, "bad_act", "the rules do not allow this act")                                 \
  X(ERROR_SLOPE, -120, "bad_slope",                                                                \
    "the slope of the table, (slope_x, slope_y), must be below mu_roll and mu_slide of every "     \
    "ball")

#define AGREES(NAME, value, name, text) \
  _Static_assert(CAROM_##NAME == (value), "values are never renumbered");
STATUS_LIST(AGREES)
SHOT_STATUS_LIST(AGREES)
#undef AGREES

const char *carom_version(void) {
  return TEXT(CAROM_VERSION_MAJOR) "." TEXT(CAROM_VERSION_MINOR) "." TEXT(CAROM_VERSION_PATCH);
}

int carom_version_number(void) {
  return CAROM_VERSION_NUMBER;
}

/* Raised by the commit that changes the bits of any result; tests/platforms/revision says when
 * that is. */
int carom_physics_revision(void) {
  return 24;
}

int carom_serves(int header) {
  const int major = header / 10000, minor = header / 100 % 100;
  if (header < 0 || major != CAROM_VERSION_MAJOR)
    return 0;
  if (major == 0)
    return minor == CAROM_VERSION_MINOR;
  return minor <= CAROM_VERSION_MINOR;
}

/* A status that is in carom.h but not in the list is a warning here (-Wswitch). */
const char *carom_status_name(carom_status status) {
  switch (status) {
#define CASE(NAME, value, name, text) \
  case CAROM_##NAME:                  \
    return name;
    STATUS_LIST(CASE)
    SHOT_STATUS_LIST(CASE)
#undef CASE
  }
  return "unknown";
}

const char *carom_status_string(carom_status status) {
  switch (status) {
#define CASE(NAME, value, name, text) \
  case CAROM_##NAME:                  \
    return text;
    STATUS_LIST(CASE)
    SHOT_STATUS_LIST(CASE)
#undef CASE
  }
  return "not a status of this library";
}

const char *carom_solver_name(carom_solver solver) {
  return carom_word(CAROM_WORDS_SOLVER, (int)solver);
}

const char *carom_slip_name(carom_slip slip) {
  return carom_word(CAROM_WORDS_SLIP, (int)slip);
}

const char *carom_event_name(carom_event_type type) {
  return carom_word(CAROM_WORDS_EVENT, (int)type);
}

const char *carom_label_name(carom_label label) {
  return carom_word(CAROM_WORDS_LABEL, (int)label);
}

const char *carom_table_name(carom_table_kind kind) {
  return carom_word(CAROM_WORDS_TABLE, (int)kind);
}

const char *carom_rack_name(carom_rack_kind kind) {
  return carom_word(CAROM_WORDS_RACK, (int)kind);
}

const char *carom_field_name(int field) {
#define BALL(ball)                                                                          \
#ball ".r[0]", #ball ".r[1]", #ball ".r[2]", #ball ".v[0]", #ball ".v[1]", #ball ".v[2]", \
      #ball ".w[0]", #ball ".w[1]", #ball ".w[2]", #ball ".radius", #ball ".mass",          \
      #ball ".mu_slide"
  static const char *const names[] = {BALL(a), BALL(b), "mu_ball", "restitution"};
#undef BALL
  if (field < 0 || field >= (int)(sizeof names / sizeof names[0]))
    return NULL;
  return names[field];
}
