/* Contacts that last in a shot: see clusters.c. */
#ifndef CAROM_SRC_SHOT_CLUSTERS_H
#define CAROM_SRC_SHOT_CLUSTERS_H

#include "cluster/cluster.h"
#include "shot/sim.h"

/* Whether a third ball is so near to i or j, which touch now, that it may be in a cluster with
 * them. */
bool carom_third_is_near(const carom_sim *sim, int i, int j);

/* The result of the successive touches of a cluster, clusters.c. */
typedef struct carom_in_turn_ball {
  carom_ball_state state;
  int index; /* the caller's */
} carom_in_turn_ball;
typedef struct carom_in_turn_touch {
  float impulse; /* single, to save stack */
  int8_t a, b;   /* of ball[] */
} carom_in_turn_touch;
enum { CAROM_TURN_TOUCHES = 10 + CAROM_CLUSTER_REPEATED }; /* every pair of 5 balls, and further */
typedef struct carom_in_turn {
  bool known; /* what they leave, and not only which they are */
  int balls, touches;
  double duration; /* of the cluster, s: later ones are separate events */
  carom_in_turn_ball ball[CAROM_CLUSTER_IN_TURN];
  carom_in_turn_touch touch[CAROM_TURN_TOUCHES];
} carom_in_turn;
void carom_take_in_turn(const carom_sim *sim, carom_in_turn *turn);

/* The cluster around balls i < j, which touch now and close at the speed of slow contacts or
 * faster. Returns how many contacts had an impulse, in the order of order[]; 0 if the contact of i
 * and j involves only these two balls; -1 if the cluster has too many contacts, or needs too many
 * steps; CAROM_TAKE_IN_TURN if its touches must first be resolved successively. The caller does
 * that, and calls again, because a cluster and a contact together need too much stack. */
enum { CAROM_TAKE_IN_TURN = -2 };
int carom_cluster_now(carom_sim *sim, int i, int j, carom_in_turn *turn,
                      carom_cluster_state *cluster, uint8_t order[CAROM_CLUSTER_CONTACTS]);

/* The motion of a ball after its cluster. */
void carom_cluster_take(const carom_cluster_ball *ball, carom_ball_state *state);

/* The contact of two balls, each of which is as given at its own time, s from now on: they get
 * their states after it, these times become the time of the touch, and the impulse includes it.
 * Nothing changes where they do not touch by the `last` time. */
void carom_touch_in_turn(const carom_sim *sim, const carom_due *pair, carom_ball_state *state_a,
                         carom_ball_state *state_b, double last, double since[2], double *impulse);
/* A ball becomes as it has to start now in order to be as given then; of the change of its motion
 * meanwhile, a share counts: all, unless the energy of all balls, which is `started` with all of it
 * and `touched` with none, would be above that before. */
void carom_start_in_turn(const carom_ball_kind *kind, double since, double share,
                         carom_ball_state *state);
double carom_share_in_turn(double before, double touched, double started);
/* How much successive touches count whose impulses differ from the integrator's by so much, where
 * the largest one is `most`: 1 to 0. */
double carom_agreement_in_turn(double difference, double most);
double carom_energy_in_turn(const carom_ball_kind *kind, const carom_ball_state *state);

/* Whether contacts of several balls last by these options. */
bool carom_lasts(const carom_shot_options *opt);

/* Whether the struck ball, which would get the motion `alone`, may meet another while the cue
 * pushes it. */
bool carom_may_push(const carom_sim *sim, const carom_motion *alone);

/* The nose of a cushion near the struck ball, near_nose.c. */
typedef struct carom_push_nose {
  carom_sim *sim;
  carom_due event;       /* the event of touching it */
  double normal[3], gap; /* from the nose to the ball; m */
  bool touches;          /* now, by that event */
} carom_push_nose;
/* The nearest one within reach of a push; false: none is. */
bool carom_find_nose(carom_sim *sim, const carom_ball_state *ball, carom_push_nose *nose);
/* The plane of the nose that an event names. */
void carom_nose_of_part(carom_sim *sim, const carom_ball_state *ball, const carom_due *event,
                        carom_push_nose *nose);
/* The one that is due to be touched. */
void carom_nose_now(carom_sim *sim, const carom_ball_state *ball, const carom_due *event,
                    carom_push_nose *nose);

/* A push of a cue, now. */
typedef struct carom_cue_push {
  const carom_cue *cue; /* cue->follow is what is left of it */
  /* of a further touch: from the centre of the struck ball to the tip, and the nose near that ball;
     or NULL */
  const double *tip_place;
  carom_push_nose *nose;
  double most;    /* m/s: the greatest speed that the ball gets */
  double slowest; /* m/s: of the arm, of a further touch */
  bool slate;     /* of a raised cue, on the slate */
} carom_cue_push;
/* That push of the struck ball, and of those that it meets meanwhile. Returns how many contacts of
 * balls had an impulse, in the order of order[]; -1 where there are too many contacts or steps. In
 * a nose that the tip does not come to, nothing happens: its impulse is 0. */
#define CAROM_LEAST_TOUCH 0.001 /* m/s: a further touch that is slower is none */
int carom_cluster_strike(carom_sim *sim, const carom_cue_push *push, carom_cluster_state *cluster,
                         uint8_t order[CAROM_CLUSTER_CONTACTS]);

/* follow_through.c. The cue continues from now at a speed, its tip `lead` m ahead of its position
 * at the ball, as in places.c; the arm has gone on by `arm` m. */
void carom_follow_on(carom_play *play, double speed, double lead, double arm);
/* It is where it is now. */
void carom_follow_now(carom_play *play);
/* Sets play->follow.time: when its tip touches the struck ball again. */
void carom_follow_find(carom_play *play);
/* *moved_cue becomes the cue with the position of its tip and its speed; tip_place the way from the
 * centre to the tip. Returns whether that is a touch. */
bool carom_follow_cue(const carom_play *play, carom_cue *moved_cue, double tip_place[3]);
/* The tip is moved against the ball, in addition to what the cue travels, as if the cue had struck
 * elsewhere. */
void carom_follow_moved(carom_play *play, const double moved[3]);
/* Whether the tip may reach the struck ball while that touches a nose; and, behind one that the tip
 * has not reached, which took the ball from one state to another, the cue continues. */
bool carom_tip_is_near(const carom_play *play, const carom_ball_state *ball);
void carom_follow_nose(carom_play *play, const carom_ball_state *start,
                       const carom_ball_state *end);

/* raised.c: e of the contact of a ball with the slate; and what an impulse J of it, over the mass,
 * takes from the turn about the vertical and the end of hops from v[2]. */
double carom_slate_under(const carom_ball_kind *kind);
void carom_leave_slate(const carom_ball_kind *kind, double J, carom_ball_state *state);

/* The motion of a member after a push, of a raised cue with what the slate takes from it. */
void carom_cluster_rest(const carom_sim *sim, const carom_cluster_state *cluster, int index,
                        carom_ball_state *state);

#endif
