/* Names and texts of the public enumerations. carom.h spells the enumerators out, and the compiler
 * reports where one has no name. packaging/tests/abi keeps their values. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include "platform/enumerations.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *carom_version(void) {
  return TEXT(CAROM_VERSION_MAJOR) "." TEXT(CAROM_VERSION_MINOR) "." TEXT(CAROM_VERSION_PATCH);
}

int carom_version_number(void) {
  return CAROM_VERSION_NUMBER;
}

/* Raised by the commit that changes the bits of any result; core/tests/platforms/revision explains
 * when that is. */
int carom_physics_revision(void) {
  return 26;
}

int carom_serves(int header) {
  const int major = header / 10000, minor = header / 100 % 100;
  if (header < 0 || major != CAROM_VERSION_MAJOR)
    return 0;
  if (major == 0)
    return minor == CAROM_VERSION_MINOR;
  return minor <= CAROM_VERSION_MINOR;
}

/* The name and the text of a status. One of carom.h that is not here is a warning (-Wswitch). */
typedef struct status_words {
  const char *name, *text;
} status_words;

static status_words words_of(carom_status status) {
#define STATUS(NAME, name, text) \
  case CAROM_##NAME:             \
    return (status_words){name, text};
  switch (status) {
    STATUS(OK, "ok", "resolved")
    STATUS(SEPARATING, "separating",
           "the balls do not approach each other; their state is returned unchanged")
    STATUS(STOPPED_AT_TIME, "stopped_at_time",
           "the shot was stopped at options.time_most, as requested; balls are still moving")
    STATUS(STOPPED_AT_EVENT, "stopped_at_event",
           "the shot was stopped after an event of options.stop_at, as requested")
    STATUS(ERROR_NULL, "null_pointer", "a required pointer is NULL")
    STATUS(ERROR_SOLVER, "bad_solver", "options.solver is not one of carom_solver")
    STATUS(ERROR_SLIP, "bad_slip", "options.slip is not one of carom_slip")
    STATUS(ERROR_STEPS, "bad_steps", "options.steps must not be negative (0 is the default)")
    STATUS(ERROR_POSITION, "bad_position", "a position must be finite")
    STATUS(ERROR_VELOCITY, "bad_velocity", "a velocity must be finite")
    STATUS(ERROR_SPIN, "bad_spin", "an angular velocity must be finite")
    STATUS(ERROR_RADIUS, "bad_radius", "a radius must be positive and finite")
    STATUS(ERROR_MASS, "bad_mass", "a mass must be positive and finite")
    STATUS(ERROR_MU_SLIDE, "bad_mu_slide", "the friction of ball and cloth must be in [0, 1]")
    STATUS(ERROR_MU_BALL, "bad_mu_ball", "the friction of ball and ball must be in [0, 1]")
    STATUS(ERROR_RESTITUTION, "bad_restitution", "the restitution must be in [0, 1]")
    STATUS(ERROR_RADII_DIFFER, "radii_differ", "the radii of the balls differ; they must be equal")
    STATUS(ERROR_HEIGHTS_DIFFER, "heights_differ",
           "the centres are at different heights; they must be at the same height")
    STATUS(ERROR_VERTICAL, "vertical_velocity",
           "the vertical velocity must be 0: both balls stay on the table")
    STATUS(ERROR_COINCIDENT, "centres_coincide",
           "the centres coincide, so there is no line of centres")
    STATUS(ERROR_TOO_SLOW, "too_slow",
           "Euler's method is too slow here: its steps are lost in rounding, or more than 16 N "
           "of them are needed")
    STATUS(ERROR_OVERFLOW, "overflow", "the collision overflows the range of double")
    STATUS(ERROR_MASSES_DIFFER, "masses_differ",
           "the masses of the balls differ; this model requires equal masses")
    STATUS(ERROR_THREADS, "bad_threads", "options.threads must be CAROM_ALL_THREADS, or 0 or more")
    STATUS(ERROR_POINTS, "bad_points", "a trace needs at least 2 points")
    STATUS(ERROR_UNRESOLVED, "unresolved",
           "the collision is too extreme: its result depends on rounding errors, or needs more "
           "work than a call may do")
    STATUS(
        ERROR_OPTIONS, "bad_options",
        "a number of the options, the job or the player is out of its range, or a reserved field "
        "is not 0")
    STATUS(ERROR_CUSHION_MODEL, "bad_cushion_model",
           "options.model is not one of carom_cushion_model")
    STATUS(ERROR_NORMAL, "bad_normal", "the direction into the cushion must be finite and not 0")
    STATUS(ERROR_NOSE_HEIGHT, "bad_nose_height",
           "the nose must be between the cloth and the top of the ball")
    STATUS(ERROR_MU_CUSHION, "bad_mu_cushion", "the friction of ball and cushion must be in [0, 1]")
    STATUS(ERROR_JAW_RADIUS, "bad_jaw_radius",
           "the radius of a jaw must be finite and not negative")
    STATUS(ERROR_CONVENTION, "bad_convention",
           "options.convention must be one of carom_cushion_convention")
    STATUS(ERROR_CUSHION_LAW, "bad_cushion_law", "options.law must be one of carom_cushion_law")
    STATUS(ERROR_LEAST_STEP, "bad_least_step",
           "options.least_step must be 0 N s or more, and finite")
    STATUS(ERROR_OMEGA_RATIO, "bad_omega_ratio", "omega_ratio must be 0, or between 1 and 2")
    STATUS(ERROR_SPEED_LOG, "bad_speed_log",
           "restitution_log, restitution_log2, mu_log and roll_loss_log must be -1 to 1")
    STATUS(
        ERROR_SMOOTH, "bad_smooth",
        "smooth_q must be 1e-12 to 0.5, smooth_x and smooth_t above 0 and at most 2, smooth_a and "
        "smooth_k 0 to 1, smooth_g, smooth_g_log and smooth_e -1 to 1; or all eight 0")
    STATUS(
        ERROR_VERSION, "bad_version",
        "the program was compiled with the header of a version that this library does not serve; "
        "compile it with the header of carom_version()")
    STATUS(ERROR_TOO_MANY_EVENTS, "too_many_events",
           "the shot was stopped: it has more events than options.events_most")
    STATUS(ERROR_TOO_LONG, "too_long",
           "the shot was stopped: it lasts longer than 1000 s, and options.time_most is 0")
    STATUS(ERROR_LEFT_TABLE, "left_table",
           "a ball on the cloth left the table, through a gap between its cushions")
    STATUS(
        ERROR_SHOT_OPTIONS, "bad_shot_options",
        "a reserved or unused field of the options, the job or the seeds is not 0, first_of has a "
        "ball beyond the layout, or a job has both balls and kinds")
    STATUS(ERROR_BALLS, "bad_balls",
           "the count of balls must be 1 to 32, and the index of a ball below it")
    STATUS(ERROR_LABEL, "bad_label",
           "the label of a ball must be 0 to 4, or, unless the space is flat, 5 or 6")
    STATUS(ERROR_OVERLAP, "overlap", "two balls overlap")
    STATUS(ERROR_OFF_TABLE, "off_table", "a ball is not on the table")
    STATUS(ERROR_MU_MOTION, "bad_mu_motion",
           "frictions of sliding, rolling and spinning must be above 0 and at most 1")
    STATUS(ERROR_GRAVITY, "bad_gravity", "gravity must be above 0 and at most 1e6 m/s^2")
    STATUS(ERROR_MISCUE, "miscue",
           "the tip misses the ball: a^2 + b^2 must be below miscue^2, which is 1 by default")
    STATUS(ERROR_TABLE, "bad_table",
           "the table has no part, a part that is not finite or has no length, friction or "
           "restitution outside 0 to 1, or a rail_width below the radius of a ball")
    STATUS(ERROR_RACK, "bad_rack",
           "there is no such rack, its gap is not between 0 and R, or there is too little room")
    STATUS(
        ERROR_EVENTS_LOST, "events_lost",
        "some events of the shot so far are missing, for example because shot.room was too small")
    STATUS(ERROR_TIME, "bad_time",
           "the time is below 0, not a number, or after the end of a shot that was stopped while "
           "balls moved")
    STATUS(ERROR_DRAG, "bad_drag", "the drag of a rolling ball must be 0 to 1 per metre")
    STATUS(ERROR_BALL_CUSHION, "bad_ball_cushion",
           "a ball's roll_loss must be 0 to 1, and its nose_height 0 or more and below 2 R")
    STATUS(
        ERROR_TABLE_OPEN, "table_open",
        "a ball can leave the table between two of its parts, or there is no room for a ball on it")
    STATUS(ERROR_RAIL_SIDE, "bad_rail_side", "the played side of a rail faces away from the table")
    STATUS(ERROR_RAIL_LINE, "bad_rail_line",
           "the line of a rail does not pass through both of its ends")
    STATUS(ERROR_TANGENT, "no_tangent",
           "derivatives are not available with pooltool's rules, with Euler's model of balls, or "
           "through this cluster")
    STATUS(ERROR_DIRECTIONS, "bad_directions", "the number of directions must be 1 to 64")
    STATUS(ERROR_MODULUS, "bad_modulus", "a ball's modulus must be 0 or 1e6 to 1e15 Pa")
    STATUS(ERROR_NO_TANGENTS, "no_tangents",
           "this library was built without derivatives, which need a C++ compiler")
    STATUS(ERROR_STATE, "bad_state",
           "shot.state, or the memory of a plan, is damaged, is from another build, or cannot be "
           "continued")
    STATUS(ERROR_STATE_TABLE, "other_table", "shot.state belongs to a shot on another table")
    STATUS(ERROR_STATE_BALLS, "other_balls",
           "shot.state belongs to a shot with other balls or another layout")
    STATUS(ERROR_STATE_OPTIONS, "other_options",
           "shot.state belongs to a shot with other options, apart from the stopping options")
    STATUS(ERROR_ROOM, "bad_room",
           "shot.room must be 0 or more, and 0 if shot.events and shot.brief are both NULL")
    STATUS(ERROR_CUE_SPEED, "bad_cue_speed", "cue.speed must be 0 to 1000 m/s")
    STATUS(ERROR_CUE_PHI, "bad_cue_phi", "cue.phi must be a direction of -1e9 to 1e9 degrees")
    STATUS(ERROR_CUE_THETA, "bad_cue_theta", "cue.theta must be 0 to 90 degrees")
    STATUS(ERROR_CUE_MASS, "bad_cue_mass", "cue.mass must be positive and finite")
    STATUS(ERROR_CUE_END_MASS, "bad_cue_end_mass", "cue.end_mass must be positive and finite")
    STATUS(ERROR_CUE_BALL, "bad_cue_ball",
           "cue.ball must be the index of one of the balls, counted from 0")
    STATUS(ERROR_CUE_BALL_OUT, "cue_ball_out",
           "cue.ball must be in play, neither in a pocket nor off the table")
    STATUS(ERROR_CUE_MISCUE, "bad_cue_miscue", "cue.miscue must be 0 to 1")
    STATUS(ERROR_CUE_TIP_TIME, "bad_cue_tip_time", "cue.tip_time must be 0 to 0.01 s, or -1")
    STATUS(ERROR_CUE_TIP_RESTITUTION, "bad_cue_tip_restitution",
           "cue.tip_restitution must be 0 to 1, where 0 means 1")
    STATUS(ERROR_WORLD, "bad_world",
           "options.world must be one of carom_world; for a cluster, CAROM_WORLD_CAROM")
    STATUS(ERROR_BALL_MODEL, "bad_ball_model",
           "options.ball_model must be one of carom_ball_model; for a cluster, the default, EXACT "
           "or MIRROR")
    STATUS(ERROR_SHOT_CUSHION_MODEL, "bad_shot_cushion_model",
           "options.cushion_model must be one of carom_shot_cushion")
    STATUS(ERROR_FRICTION, "bad_friction", "options.friction must be one of carom_ball_friction")
    STATUS(ERROR_SPACE, "bad_space", "options.space must be one of carom_space")
    STATUS(ERROR_EVENTS_MOST, "bad_events_most",
           "options.events_most must not be negative (0 is the default)")
    STATUS(ERROR_TIME_MOST, "bad_time_most",
           "options.time_most must be 0 or more, finite, and not before the time of the shot to "
           "continue")
    STATUS(ERROR_STOP_AT, "bad_stop_at",
           "options.stop_at must be a set of CAROM_STOP_AT() and CAROM_STOP_AT_CONTACT")
    STATUS(ERROR_PLAIN, "bad_plain", "options.plain must be 0 or 1")
    STATUS(ERROR_SIMULTANEOUS, "bad_simultaneous",
           "options.simultaneous must be one of carom_simultaneous")
    STATUS(ERROR_CLUSTER_STEPS, "bad_cluster_steps",
           "options.cluster_steps must be 0 to 10000 (0 is the default)")
    STATUS(ERROR_RECORD, "bad_record", "the recording is invalid; record.fault describes the error")
    STATUS(ERROR_REVISION, "other_revision",
           "the recording was made with another revision of the physics, with which its shots have "
           "other bits")
    STATUS(ERROR_IN_MOTION, "in_motion",
           "a ball moves, turns or flies; plans need a layout at rest")
    STATUS(ERROR_GAME_OVER, "game_over",
           "no ball is left to play: all balls that count are down, or the eight is")
    STATUS(ERROR_FAST, "bad_fast", "options.fast must be 0 or 1")
    STATUS(ERROR_CORNERS, "bad_corners", "the table must have 3 to 32 corners")
    STATUS(ERROR_SIDES_CROSS, "sides_cross", "two sides of the table cross or touch")
    STATUS(ERROR_CUE_FOLLOW, "bad_cue_follow", "cue.follow must be 0 to 1 m")
    STATUS(ERROR_SCORE, "bad_score",
           "a rating must be 0 to 1000, games won and lost 0 to 1e9 each, and the number of scores "
           "not negative")
    STATUS(ERROR_CUE_TIP_RADIUS, "bad_cue_tip_radius", "cue.tip_radius must be 0 m or more")
    STATUS(ERROR_TABLE_KIND, "bad_table_kind", "there is no such kind of table")
    STATUS(ERROR_CORNER, "bad_corner",
           "a corner must be within 1e6 m of 0, and its mouth 0 to 1e6 m wide")
    STATUS(ERROR_CORNERS_MEET, "corners_meet", "two successive corners of the table coincide")
    STATUS(ERROR_CORNERS_IN_LINE, "corners_in_line", "all corners of the table are on one line")
    STATUS(ERROR_MOUTHS, "mouths_too_wide",
           "the mouths at both ends of a side leave no rail between them")
    STATUS(ERROR_POCKETS, "too_many_pockets", "the table has more than 8 pockets")
    STATUS(ERROR_JAWS, "too_many_jaws", "the table has more than 32 jaws")
    STATUS(ERROR_RAILS, "too_many_rails", "the table has more than 32 rails")
    STATUS(ERROR_ACT, "bad_act", "the rules do not allow this act")
    STATUS(
        ERROR_SLOPE, "bad_slope",
        "the slope of the table, (slope_x, slope_y), must be below mu_roll and mu_slide of every "
        "ball")
  }
#undef STATUS
  return (status_words){"unknown", "not a status of this library"};
}

const char *carom_status_name(carom_status status) {
  return words_of(status).name;
}

const char *carom_status_string(carom_status status) {
  return words_of(status).text;
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
