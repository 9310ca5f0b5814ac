/* The motion of a ball between events, in closed form.
 *
 *   symbol   meaning                                        unit
 *   r, v     position and velocity of the centre            m, m/s
 *   w        angular velocity                               rad/s
 *   u        slip: the velocity of the ball's lowest point  m/s
 *   R, g     radius, gravity                                m, m/s^2
 *   mu       friction of the cloth: mu_s of a ball that slides, mu_r of one that rolls, mu_sp of
 *            one that turns on the spot
 *
 *   sliding: a parabola, since     rolling: straight,        spinning: on the spot,
 *   u keeps its direction          u = 0                     until w_z = 0; then at rest
 *
 *        u
 *         \
 *      v0 -o-----___
 *                   ---__
 *                        -_
 *                          -o------------------------------o
 *                           u = 0                          v = 0
 *
 * With tau the time since the start of the path, u the slip at the start, e = u/|u|:
 *
 *   sliding    r = r0 + v0 tau - mu_s g/2 e tau^2,   v = v0 - mu_s g e tau,
 *              w = w0 - 5 mu_s g/(2R) tau (e_y, -e_x, 0)
 *              until tau = 2|u|/(7 mu_s g), when u = 0 (e does not turn on the way)
 *   rolling    r = r0 + v0 tau - mu_r g/2 v0/|v0| tau^2   and so on, (w_x, w_y) = (-v_y, v_x)/R,
 *              until tau = |v0|/(mu_r g)
 *   drag       a rolling ball slows by mu_r g + k v^2: in pieces of constant deceleration, below
 *   slope      a ball slides and rolls on a curve: in pieces of constant acceleration, below
 *   on the cloth |w_z| falls at 5 mu_sp g/(2R) down to 0
 *   airborne   r = r0 + v0 tau - g/2 tau^2 z, v = v0 - g tau z, w constant, no drag of the air,
 *              until the ball lands: with d = z - R >= 0 and q = sqrt(v_z^2 + 2 g d),
 *              tau = (v_z + q)/g, or 2 d/(q - v_z) where v_z < 0
 *
 * A landing is the end of a phase: it needs no detection. The ball is there at z = R exactly,
 * with v_z = -q.
 *
 * Source: W. C. Marlow, The Physics of Pocket Billiards (1995); D. Alciatore, TP A-4.
 *
 * DRAG. With A = mu_r g the exact solution takes, from v0 to v1 < v0,
 *
 *   T = atan(x) / sqrt(A k),  x = sqrt(A k) (v0 - v1) / (A + k v0 v1)              for the way
 *   S = atanh(y) / k,         y = k (v0^2 - v1^2) / (2 A + k (v0^2 + v1^2)).
 *
 * Detection wants paths of degree 2. So this time is halved, and each half has a constant
 * deceleration, a1 and a2, such that the pair of them ends in the exact state, after T at S with
 * v1:
 *
 *   a1 = 4 (v0 T - S) / T^2 - m,   a2 = 2 m - a1,   m = (v0 - v1) / T.
 *
 *   speed
 *    v0 |\
 *       | \  a1
 *       |  \
 *       |   \__                   The pieces are straight lines here. The exact speed bends between
 *       |      ---___   a2        them, and has the same area below it, which is the way S.
 *    v1 |            ---
 *       +----+-------+--- time
 *       0   T/2      T
 *
 * Errors do not accumulate from pair to pair. Within one, where J is v'' (J = 2 k v (A + k v^2),
 * largest at the start, and nearly constant), the position differs from the exact one by J T^3 /
 * 324 at most, at T/3 and 2T/3, and by nothing at T/2. The speed v0 - v1 that a pair takes is
 * chosen for an error of 1e-5 m. Where that is v0 the pair ends at rest.
 *
 * SLOPE. The cloth rises by s = (s_x, s_y) m for each m, so G = -g s is the part of gravity along
 * it, to first order in s. With e = v/|v|, or e = u/|u| of a ball that slides,
 *
 *   sliding    v' = -mu_s g e + G,   u' = -7/2 mu_s g e + G,   so  v' = 2/7 u' + 5/7 G
 *   rolling    v' = -(mu_r g + k v^2) e + 5/7 G
 *   airborne   v' = G - g z
 *
 * So u, and v of a ball that rolls, obey u' = -(A + k u^2) u/|u| + c: the direction turns downhill.
 * Without drag u reaches 0, and has covered W until then, where with q = |u0| and h = c . e0
 *
 *   T = (A q + c . u0) / (A^2 - c^2),
 *   W = q^2 (e0 (2A + h) / (4A^2 - c^2) + c (1 + 3h (2A + h) / (4A^2 - c^2)) / (4 (A^2 - c^2))):
 *
 * by the rule of products |u| (A + h) falls at A^2 - c^2, and |u|^2 times a polynomial of e at the
 * components of u. A slope below mu_r and mu_s leaves c < 5/7 A, so every ball stops.
 *
 * A pair ends in the state where u is 0, if the position within it is good to 1e-5 m. Otherwise it
 * ends after a part h of its speed, in the state of RUNGE_STEPS steps of Runge's and Kutta's
 * method, which is good to 1e-6 m. Its two accelerations are as for a pair with drag, as vectors.
 * core/tests/physics/slope.c measures both errors. With drag the last pair has A (1 + 0.35 y), y =
 * k q^2/A, and times that make it exact for c = 0; it is used when c k q^4/A^3 is below 1e-5 m. */
#ifndef CAROM_SRC_MOTION_PATH_H
#define CAROM_SRC_MOTION_PATH_H

#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "platform/dependence.h"
#include "platform/ranges.h"
#include "platform/vectors.h"

#include <stdbool.h>

/* Numbers that follow from a ball's kind, once for a shot. */
typedef struct carom_ball_rates {
  double radius, slide, roll; /* R; mu_s g and mu_r g, m/s^2 */
  double gravity;             /* g */
  double drag;                /* k, 1/m */
  double spin;                /* 5 mu_sp g/(2R), rad/s^2 */
  double downhill[2];         /* G, m/s^2: 0 on a level cloth */
} carom_ball_rates;

/* The path on a level cloth; and on a slope. */
carom_ball_rates carom_rates_of(const carom_ball_kind *kind);
carom_ball_rates carom_rates_on_slope(const carom_ball_kind *kind, double slope_x, double slope_y);

/* Whether the cloth slopes, or derivatives by its slope are requested. */
static inline bool carom_is_sloped(const carom_ball_rates *rates) {
  return !carom_absent(rates->downhill[0]) || !carom_absent(rates->downhill[1]);
}

typedef struct carom_path {
  double start, end; /* of the phase, on the clock; end is infinite where nothing changes */
  double a[3];       /* half the acceleration: r(tau) = r0 + v0 tau + a tau^2; a[2] is 0 but
                            for an airborne ball */
  double e[2];       /* on a level cloth, the direction of the friction: of the slip, or of v; in
                            a pair, a[0] and a[1] of its second piece */
  carom_ball_state from; /* at the start; its label is the phase */
  bool goes_on;          /* at the end another piece of the same phase begins: carom_path_go_on() */
  bool ends_pair;        /* the piece is the second of its pair */
  bool last_pair;        /* which ends at rest */
  double second;         /* duration of the second piece of the pair, s */
} carom_path;

/* Whether the centre moves in the phase. */
static inline bool carom_translates(int64_t label) {
  return label == CAROM_BALL_SLIDING || label == CAROM_BALL_ROLLING || label == CAROM_BALL_AIRBORNE;
}

/* Whether the ball is pocketed or has left the table: it meets nothing any more. */
static inline bool carom_is_out(int64_t label) {
  return label == CAROM_BALL_POCKETED || label == CAROM_BALL_OFF;
}

/* The time after which a thing that is `height` above a plane and rises at v_z falls onto it;
 * infinite if it is below and does not reach it. */
double carom_fall_time(double height, double v_z, double gravity);

/* Starts a path at a time from path->from, whose label is the phase. */
void carom_path_begin(carom_path *path, const carom_ball_rates *rates, double start);

/* The second piece of a pair, from the state in path->from. */
void carom_path_second(carom_path *path, double start);
/* At the end of a path that continues: the next piece. */
void carom_path_go_on(carom_path *path, const carom_ball_rates *rates);

/* Continues to the piece that contains a time. False where that takes more pieces than any shot:
 * 1000 s of a ball at 10,000 m/s take 16,000, but a state that was damaged may have a speed at
 * which pieces have no length. */
bool carom_path_go_to(carom_path *path, const carom_ball_rates *rates, double time);

/* The state at a time within the path; *state may be path->from. */
void carom_path_at(const carom_path *path, const carom_ball_rates *rates, double time,
                   carom_ball_state *state);

/* The phase that v and w of a state amount to: not one that would end at once but for rounding.
 * Tidies v and w. */
int64_t carom_label_of(carom_ball_state *state, double radius);

/* The same where the ball may have left the cloth: airborne with v_z other than 0 or above the
 * cloth. A ball on the cloth that moves down or up by rounding, less than 1e-9 m/s, is on it. */
int64_t carom_label_in_space(carom_ball_state *state, double radius);

static inline bool carom_flies(const carom_ball_state *state) {
  return state->label == CAROM_BALL_AIRBORNE;
}

/* Whether a ball of a layout is airborne, unless it is out of play: by its label, or as it moves
 * up or down or is more than 1e-6 m above the cloth. */
static inline bool carom_flies_in_layout(const carom_ball_state *state, double radius) {
  static const double on_cloth = 1e-6; /* m */
  return state->label == CAROM_BALL_AIRBORNE || state->v[2] != 0.0 ||
         state->r[2] - radius > on_cloth;
}

/* The phase of a ball of a layout. One that is out of play stays so. */
int64_t carom_label_of_layout(carom_ball_state *state, double radius);

/* The state of an airborne ball as it reaches the cloth, at the end of the path, or slightly later,
 * where another event was the first of several at one instant. */
void carom_path_land(const carom_path *path, const carom_ball_rates *rates, double time,
                     carom_ball_state *state);

/* The phase that follows the path's own at its end, and the state there; a velocity that has ended
 * is exactly 0. *state may be path->from. */
void carom_path_end(const carom_path *path, const carom_ball_rates *rates, carom_ball_state *state);

#endif
