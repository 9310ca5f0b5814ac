/* The cue after its push: it follows through, and touches the cue ball again where it reaches it.
 *
 * Its tip continues along the axis c at the speed V that the push has left it, for the length
 * cue.follow from where it struck. That length is a convention: the arm, which takes the cue away,
 * is not computed. It moves at a tenth of the first speed at least, also where the ball has stopped
 * the cue or thrown it back: the cue stays in the way until then. With p from the centre of
 * the struck ball to the tip, the next touch is where
 *
 *     |p| = R,   p = p0 + t V c - v t - a t^2
 *
 *      where it struck           p
 *      |---- along ---|-- V t --|<-----o    the ball, at v t + a t^2 from where it is now
 *      ================= c ====>   R
 *
 * (gap.c). There it pushes as tip.h has it, with the (a, b) of p, and continues at the speed that
 * is left. It is looked for from the first contact of the cue ball with another ball or a cushion
 * after a touch on, and from a further touch on that throws the cue back: before that the ball runs
 * away from the cue, but in slow draws, in which an arm stops. A tip that closes slower than
 * CAROM_LEAST_TOUCH stays at the ball until the next event; a tip that passes its middle misses:
 * there the follow-through ends.
 *
 * NOSE. A cushion that the ball meets meanwhile lasts (cluster/nose.h), and the cue moves for that
 * time, though the clock of the shot stands still: where the tip is against the ball counts. If it
 * presses the ball in the nose, both are one event of the shot, a push. Otherwise the cushion gives
 * what it gives without a cue, to the bit. */
#include "cluster/cluster.h"
#include "cluster/cue.h"
#include "cluster/nose.h"
#include "motion/gap.h"
#include "shot/clusters.h"
#include "shot/rules.h"

#include <math.h>

/* A touch has the tip not deep in the ball, and the centre of the ball ahead of it: by more than
 * this fraction of |p| along the axis; less is past the middle of the ball. */
static const double least_distance2 = 0.25; /* |p|^2, of R^2 */
static const double least_ahead = 0.1;

void carom_follow_on(carom_play *play, double speed, double lead, double arm) {
  const carom_sim *sim = &play->sim;
  const carom_cue *cue = sim->cue;
  carom_follow *follow = &play->follow;
  follow->along += lead;
  follow->left -= arm;

  /* balls must last as it touches them */
  follow->end = -1.0;
  if (!(follow->left > 0.0) || cue->tip_time < 0.0 || !sim->rules->clusters ||
      !carom_lasts(sim->opt))
    return;
  follow->start = sim->time;
  follow->end = sim->time + follow->left / carom_arm_speed(cue, speed);
  follow->V = speed;
}

void carom_follow_now(carom_play *play) {
  carom_follow *follow = &play->follow;
  const double elapsed = play->sim.time - follow->start;
  follow->along += follow->V * elapsed;
  follow->left -= carom_arm_speed(play->sim.cue, follow->V) * elapsed;
  follow->start = play->sim.time;
  follow->time = INFINITY;
}

void carom_follow_moved(carom_play *play, const double moved[3]) {
  for (int axis = 0; axis < 3; axis++)
    play->follow.origin[axis] += moved[axis];
}

/* p, from the centre to the tip, now, and the directions of the cue. */
static void tip_of(const carom_play *play, const double centre[3], double axes[3][3],
                   double tip_place[3]) {
  const carom_sim *sim = &play->sim;
  const carom_follow *follow = &play->follow;
  carom_tip_from(sim->cue, sim->rates[sim->struck].radius, follow->origin,
                 follow->along + follow->V * (sim->time - follow->start), centre, axes, tip_place);
}

/* The struck ball from now on, in axes[0] the axis of the cue, and the way from the ball to the
 * tip. */
static void begin(const carom_play *play, double axes[3][3], carom_separation *separation) {
  const carom_sim *sim = &play->sim;
  const int i = sim->struck;
  carom_ball_state state;
  carom_path_at(&sim->path[i], &sim->rates[i], sim->time, &state);
  tip_of(play, state.r, axes, separation->d0);
  for (int axis = 0; axis < 3; axis++) {
    separation->d1[axis] = play->follow.V * axes[0][axis] - state.v[axis];
    separation->d2[axis] = -sim->path[i].a[axis];
  }
}

void carom_follow_find(carom_play *play) {
  const carom_sim *sim = &play->sim;
  carom_follow *follow = &play->follow;
  const int struck = sim->struck;
  const carom_path *path = &sim->path[struck];
  const bool out = carom_is_out(path->from.label);

  /* none where the ball is out, or has met nothing since the last touch */
  follow->time = INFINITY;
  if (out)
    follow->end = -1.0;
  if (out || !sim->turned)
    return;

  /* until the cue stops or the path of the ball ends */
  carom_separation separation;
  double axes[3][3];
  begin(play, axes, &separation);
  const double horizon = carom_lesser(follow->end, path->end) - sim->time;
  if (horizon >= 0.0)
    follow->time =
        sim->time + carom_first_contact_in_space(&separation, sim->rates[struck].radius, horizon);
}

bool carom_follow_cue(const carom_play *play, carom_cue *moved_cue, double tip_place[3]) {
  const carom_sim *sim = &play->sim;
  const int struck = sim->struck;
  const double radius = sim->rates[struck].radius;
  carom_ball_state state;
  double axes[3][3], offset[3];
  carom_path_at(&sim->path[struck], &sim->rates[struck], sim->time, &state);
  tip_of(play, state.r, axes, tip_place);

  /* the cue with what is left of its way, at this touch */
  const double square = carom_tip_on(axes, tip_place, offset);
  *moved_cue = *sim->cue;
  moved_cue->speed = play->follow.V;
  moved_cue->follow = play->follow.left -
                      carom_arm_speed(sim->cue, play->follow.V) * (sim->time - play->follow.start);
  moved_cue->a = offset[1];
  moved_cue->b = offset[2];
  return square > least_distance2 * radius * radius && offset[0] < -least_ahead;
}

bool carom_tip_is_near(const carom_play *play, const carom_ball_state *ball) {
  const double radius = play->sim.rates[play->sim.struck].radius;
  double axes[3][3], tip_place[3];
  tip_of(play, ball->r, axes, tip_place);

  /* no model of a cushion raises the energy, so this is the greatest speed of the ball */
  const double turns2 = radius * radius * carom_space_dot(ball->w, ball->w),
               fastest =
                   sqrt(carom_space_dot(ball->v, ball->v) + 2.0 * CAROM_SPHERE_ENERGY * turns2);
  return carom_space_size(tip_place) - radius <
         2.0 * CAROM_NOSE_TIME * (fabs(play->follow.V) + fastest);
}

void carom_follow_nose(carom_play *play, const carom_ball_state *start,
                       const carom_ball_state *end) {
  const double radius = play->sim.rates[play->sim.struck].radius, V = play->follow.V;
  carom_cluster_ball ball;
  carom_cluster_nose nose;
  double W[3], moved[3];
  for (int axis = 0; axis < 3; axis++) {
    ball.v[axis] = start->v[axis];
    ball.W[axis] = radius * start->w[axis];
    W[axis] = radius * end->w[axis];
  }
  if (!nose_of(&ball, end->v, W, &nose))
    return;
  const double lasts = nose_lasts(&nose);
  nose_moves(&nose, ball.v, lasts, moved);
  for (int axis = 0; axis < 3; axis++)
    moved[axis] = -moved[axis];
  carom_follow_now(play);
  carom_follow_moved(play, moved);
  carom_follow_on(play, V, V * lasts, carom_arm_speed(play->sim.cue, V) * lasts);
}
