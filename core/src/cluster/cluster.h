/* Several balls that touch, or nearly touch, at one instant: contacts that last.
 *
 * The rigid limit of Hertz's contacts with Coulomb's friction. An internal time tau orders the
 * impulses; places.c determines from where the balls start then. A contact of balls i and j has an
 * overlap d, which starts at minus its gap, the unit vector n from i to j, B = 1/m_i + 1/m_j, and
 * the slip u of the surface of i on that of j. With ' = d/dtau and W = R w:
 *
 *        .---.   .---.         d   overlap: here below 0, minus the gap
 *       '  i  ' '  j  '        n   from i to j
 *       (  o--+-+> o  )        t   horizontal, across n (vectors.h)
 *       .     . . n   .        f   friction along t and t x n
 *        '---'   '---'
 *
 *     d' = (v_i - v_j) . n
 *     K  = (4/3) E sqrt(R),  1/E = 1/E_i + 1/E_j,  1/R = 1/R_i + 1/R_j
 *          E_i the modulus of a ball, N/m^2
 *     F  = K d^1.5                                    while d > d_max: loading
 *     F  = K/e^3 (d - (1 - e^2) d_max)^1.5, or 0      below it: unloading, loading again
 *     u  = (v_i - v_j) - d' n + (W_i + W_j) x n
 *     |f| <= mu F, f against u;  mu = a + b exp(-c U), U the greatest |u| so far;  f on i, -f on j
 *     m v' = sum(-F n + f)      (2/5) m W' = sum(n x f)
 *
 * d_max and U are the greatest since the touch. Both branches of F together return e^2 of the work
 * of compression, for any course. Where F has reached 0 the set that is left recovers as d falls:
 * d_max = d/(1 - e^2). A contact that closes before loads along the line of unloading, so that e is
 * paid once for each compression; one at d < 0 is open, and touches anew. A contact without a force
 * acts only while it closes at `slow` or faster. A single contact has the law of carom_collide() on
 * the cloth, and of carom_impact3() in space.
 *
 * ON THE CLOTH v_z = 0 and u does not contain v_z. The friction's vertical part presses one ball of
 * a contact on the cloth:
 *
 *     L = max(0, -sum f_z)     |g| <= mu_slide L,  g against v + z x W
 *     m v' += g,  (2/5) m W' -= z x g
 *
 * IN SPACE v_z is free and the cloth takes no part: a ball that is pressed down lands
 * afterwards, as its own event.
 *
 * BETWEEN THE TWO a contact has the freedom phi. With h the greater height of the two balls above
 * the cloth, 0 for a ball that is on it, and n_z the tilt of the line of centres, which unlike
 * radii have too,
 *
 *     phi = min(1, h / 1 mm + (n_z / 0.1)^2).
 *
 * phi is 0 for equal balls on the cloth and 1 in space. The friction along t x n, which is upright
 * for a level n, meets v with the share phi: it sees phi of v in the slip, gives phi of its impulse
 * to v, and presses 1 - phi of it on the cloth. Seeing and giving the same share keeps the energy
 * of a contact what its impulses do. So neither a radius nor a height changes the law by a jump.
 * 1 mm is the convention of cushions (shot/resolve.c). 0.1 is one too: beyond a tilt of mu, some
 * 0.05, the normal impulse lifts or presses a ball more than friction can.
 *
 * Balls touch where their gap falls below CAROM_TOUCHING, at the start as later.
 *
 * A contact that is open at the start takes its n where the balls touch, moved by s = int v
 * dtau. Compression and duration of a contact that closes at v: delta = (5 v^2 / (4 K B))^0.4, T
 * = 2.943 delta / v. docs/understanding/clusters.md has what the law explains, cluster.c the
 * integrator. */
#ifndef CAROM_SRC_CLUSTER_CLUSTER_H
#define CAROM_SRC_CLUSTER_CLUSTER_H

#include "platform/arithmetic.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* m: a ball that is nearer touches, because positions are rounded to less than that */
#define CAROM_TOUCHING 1e-9
/* of a cluster's duration: touches that are nearer in time begin at one time; and of an impulse:
 * those that are nearer are alike */
#define CAROM_SIMULTANEOUS_TOUCHES 1e-9
#define CAROM_LEAST_OVERLAP 1e-15 /* m: of tip or slate where they touch anew */
#define CAROM_NOSE_TIME 5e-3      /* s, that a nose lasts for a ball alone: a convention; nose.h */

/* BETWEEN THE TWO, above: how free of the cloth a ball is by its height, m, and a contact of two
 * balls by the greater height and by the tilt. */
static inline double carom_freedom_of_height(double height) {
  static const double full_height = 1e-3; /* m */
  return height > 0.0 ? height / full_height : 0.0;
}
static inline double carom_freedom_of_balls(double height, double n_z) {
  static const double steep = 0.1;
  const double tilt = n_z / steep, freedom = carom_freedom_of_height(height) + tilt * tilt;
  return freedom < 1.0 ? freedom : 1.0;
}

enum {
  CAROM_CLUSTER_BALLS = 32,
  CAROM_CLUSTER_IN_TURN = 5,   /* balls of a cluster whose touches may be resolved successively */
  CAROM_CLUSTER_CONTACTS = 76, /* that 32 balls of one radius have on the cloth at most */
  CAROM_CLUSTER_REPEATED = 15, /* touches of contacts that have touched: further ones count with
                                     the last one of theirs */
  CAROM_CLUSTER_TOUCHES = CAROM_CLUSTER_CONTACTS + 1 + CAROM_CLUSTER_REPEATED,
  CAROM_CLUSTER_STEPS = 25,       /* of a contact's duration, unless the caller sets it */
  CAROM_CLUSTER_STEPS_MOST = 4000 /* of a cluster, for each of a contact's duration */
};

/* Members that are letters are the symbols above; the others are
 *
 *     symbol     member                     meaning, unit
 *     R, 1/m     radius, inverse_mass       m, 1/kg
 *     d, d_max   overlap, overlap_max       of a contact; of tip and slate their compression, m
 *     K, k       stiffness                  N/m^1.5 of two balls; N/m of a tip
 *     e          restitution
 *     u, U       slip, greatest_slip        m/s
 *     f          friction                   impulse of a step along t and t x n, N s
 *     T          duration                   s
 *
 * J, N s, is the normal impulse of a step. */

/* A ball. */
typedef struct carom_cluster_ball {
  double r[3], v[3], W[3];     /* W = R w, m/s */
  double radius, inverse_mass; /* m, 1/kg */
  double mu_slide;
  double restitution, modulus; /* e; E, N/m^2 */
  double law[3];               /* numbers of its friction with other balls, friction/laws.h; a
                                  pair has the mean of each */
  bool flies;                  /* above the cloth: its contacts are in space */
  int8_t friction;             /* the law, one for all balls */
  int8_t index;                /* the caller's index */
  int8_t acting;               /* its contacts that act in this step, at most 2 */
  /* of the integrator */
  double v0[3], s[3];         /* v at the start; int v dtau, m */
  double shift[3];            /* m: from where it was to where it starts: places.c */
  double base[2], g[2], load; /* slip on the cloth as a step begins; impulses of the cloth's
                                 friction and of the load */
} carom_cluster_ball;

/* A contact of balls i and j. */
typedef struct carom_cluster_contact_state {
  carom_cluster_ball *ball_i, *ball_j;
  int8_t i, j;                          /* of these in ball[] */
  bool touched;                         /* now or before: n is known */
  bool may_stick;                       /* within this step */
  int touch;                            /* its last one, in touch[] */
  double n[3];                          /* unit vector from i to j */
  double offset;                        /* d = offset + (s_i - s_j) . n */
  double overlap, overlap_max;          /* d_max: 0 while open */
  double size;                          /* the compression that it has, or will have */
  double stiffness, restitution, quick; /* quick: (e T)^-4 of a compression of 1 m */
  double tilted, freedom; /* phi by height and tilt, and with what the slate bears; read in space */
  double mu, greatest_slip;
  double J, friction[2];     /* impulses of a step along n, and of friction along t and the
                                third; between steps f/J */
  double slip[2], closing;   /* slip and closing speed as a step begins */
  double time;               /* tau of the first touch */
  double impulse, rubbed[2]; /* sums of J and f */
} carom_cluster_contact_state;

/* One touch of two balls or, as contact -1, of the tip. */
typedef struct carom_cluster_touch {
  int contact;
  double time, approach; /* tau at which it begins, s; how far the two have approached, m */
  double P[3];   /* of balls, sums of J and of f on v; of the tip, the impulse on the ball */
  double moment; /* sum of J tau */
} carom_cluster_touch;

/* A cue that pushes a ball, tip.h. The caller sets it up to e. */
typedef struct carom_cluster_tip {
  double axis[3];          /* c */
  double along[3], arm[3]; /* c' and q */
  double inverse_mass, V;  /* 1/M; the speed of the cue, m/s */
  double duration, stiffness,
      restitution;    /* duration with only the ball, s; stiffness, N/m; restitution */
  double reach;       /* m: how far the cue continues after it has parted; the caller sets it */
  int ball;           /* of ball[] */
  bool slides;        /* a further touch: n, kappa, mu and end are read, c' and q are not */
  double n[3], kappa; /* from the tip to the centre; n . c */
  double mu, end;     /* friction; 1/m_e */
  double start[3];    /* p_0, m: the tip from the centre as the push begins */
  /* of the integrator */
  double overlap, overlap_max, J, closing, lost;
  double y[3], bend[3];    /* of the end mass across the axis, m/s; Y, m */
  double beyond;           /* m: overlap less what the position of the tip gives */
  double apart;            /* s: since it had a force, of one that slides */
  double hold;             /* 1 to 0: what is left of its force, of one that slides */
  double arm_way, slowest; /* m: of the arm, of the reach; m/s, at least */
  double travel, delay; /* int V dtau, m; how far the ball is behind, along the axis, as contacts of
                           balls last, m: places.c */
  double impulse;       /* sum of J */
  bool gone;            /* it has parted, and does not continue */
  int touches, touch;   /* how many times it has touched; its last one, in touch[] */
  double first;         /* m/s: its closing speed as all begins, or more; */
  double touch_closing, second; /* and as the first and the second of them begin */
  double last;                  /* tau at which it acts last */
} carom_cluster_tip;

/* The nose of a cushion near the struck ball, nose.h. The caller sets it up to the context. */
typedef struct carom_cluster_nose {
  double normal[3], gap; /* from the nose to the ball; m, between them as the push begins */
  /* gives the motion that the model of the cushion leaves a ball with, in `context`; whether it
     does */
  bool (*model)(void *context, const carom_cluster_ball *ball, double v[3], double W[3]);
  void *context;
  /* of the integrator */
  bool touches;
  double v[3], W[3];                       /* D */
  double stiffness, restitution;           /* k, 1/s^2; e */
  double change, excess;                   /* m/s: |Delta| with the excess; and that */
  double overlap, overlap_max, J, closing; /* J over the mass of the ball, m/s */
  double rest, began, place[3]; /* s, without a force; s and m, of the ball as it touched it */
  double lasted, moved[3];      /* s and m: of the ball, sums over all touches */
  double first_gap;             /* m: the gap as all begins */
  double impulse;               /* sum of J D_v, over the mass, m/s */
} carom_cluster_nose;

/* The contact of the slate and a ball, tip.h. The caller sets e. */
typedef struct carom_cluster_slate {
  double restitution; /* restitution; 0: the ball flies, and there is none */
  /* of the integrator */
  double falls; /* m/s, 0 or below: of v_z, what a ball falls by without tip and slate */
  double overlap, overlap_max, J, closing, impulse;
} carom_cluster_slate;

/* The caller sets balls, ball[] up to `which`, steps and slow; of a strike also tip and slate[];
 * carom_cluster_members() in_space and the contacts. */
typedef struct carom_cluster_state {
  bool in_space;
  bool struck;    /* by a cue: tip is read, */
  bool on_slate;  /* and slate[], one for each of ball[] */
  bool nose_near; /* and nose; of a further touch */
  int balls, contacts;
  double steps;     /* of a contact's duration */
  double steepness; /* of the cue, 0 to 1: how short steps of the slate are; push.c */
  double slow;      /* m/s: contacts that close slower are none, and do not prolong a cluster */
  double duration;  /* of the integration, s */
  double shared;    /* sum of the impulses in steps in which other contacts of a ball act too */
  int steps_done;   /* steps */
  int touches, repeated; /* in touch[]; the ones that are repeated */
  carom_cluster_ball ball[CAROM_CLUSTER_BALLS];
  carom_cluster_contact_state contact[CAROM_CLUSTER_CONTACTS];
  carom_cluster_touch touch[CAROM_CLUSTER_TOUCHES];
  carom_cluster_tip tip;
  carom_cluster_nose nose;
  carom_cluster_slate *slate; /* CAROM_CLUSTER_BALLS of the caller's, where a cue strikes */
} carom_cluster_state;

/* members.c: compression of a contact of stiffness K and 1/reduced mass B, its mobility; and the
 * duration of one of that compression, by its pace. */
double carom_cluster_compression(double stiffness, double mobility, double closing);
double carom_cluster_duration(double pace, double size);

/* members.c: keeps of ball[] those that a contact which begins can reach, and lists their contacts.
 * The contact is between two balls, indices in ball[]; or, if `first` is below 0, between the
 * fastest of the pairs that touch and close. Returns the number of contacts: 0 where no pair
 * touches and closes at `slow` or faster, -1 where there are too many. */
int carom_cluster_members(carom_cluster_state *cluster, int first, int second);

/* members.c: keeps of ball[] the struck one, tip.ball, and those that it can reach while the cue
 * pushes it, if `most` is the speed that it gets, and lists their contacts. Returns the number of
 * contacts, -1 if there are too many; 0: a single contact. */
int carom_cluster_members_of_tip(carom_cluster_state *cluster, double most);

/* push.c: the tip of a cue at ball[struck], which touches a single ball for a duration. cue[] has
 * the numbers of carom_cue from speed to tip_restitution, in their order. */
void carom_cluster_tip_of(carom_cluster_state *cluster, int struck, const double cue[8],
                          double duration);

/* push.c: makes that a further touch, of a tip with the friction mu at that place from the centre.
 */
void carom_cluster_tip_slides(carom_cluster_state *cluster, double end_mass, double mu,
                              const double tip_place[3]);

/* push.c: the same of a ball that touches nose. The tip may be anywhere then; of one that is in the
 * ball what it is compressed by is a set. */
void carom_cluster_put_in_nose(carom_cluster_state *cluster);

/* push.c: whether the tip may reach the ball while it touches the nose, as a ball alone does. Where
 * the nose does not push the ball, there is none. */
bool carom_cluster_tip_comes(carom_cluster_state *cluster);

/* push.c: a push of a ball that nothing else touches, in closed form. */
void carom_cluster_push_alone(carom_cluster_state *cluster);

/* push.c: begins slate[], whose e the caller sets then of balls that do not fly; and the impulse of
 * the slate on a ball. */
void carom_cluster_put_on_slate(carom_cluster_state *cluster);
double carom_cluster_slate_impulse(const carom_cluster_state *cluster, int ball);

/* places.c: takes note of a touch of a contact that begins, -1 of the tip, and returns its position
 * in touch[], which for one too many is that of the `last` touch of the contact, -1 where it is the
 * first; what the touches move the balls by, their `shift`; and how far the tip of a push is ahead
 * of the ball then, if both are seen to move from the start as they do after it. */
int carom_cluster_begin_touch(carom_cluster_state *cluster, int contact, int last, double time,
                              double approach);
void carom_cluster_find_places(carom_cluster_state *cluster);
/* Reduces the shifts so that no two balls start too deep in each other; find_places() does so. */
void carom_cluster_limit_shifts(carom_cluster_state *cluster);
double carom_cluster_tip_lead(const carom_cluster_state *cluster);
/* The same of a further touch, which takes no time of the shot's clock. In m: the tip continues
 * from `travel` along its axis, and has `moved` against the ball; the arm continues from `arm`. */
typedef struct carom_next_tip {
  double travel, arm, moved[3];
} carom_next_tip;
carom_next_tip carom_cluster_next_tip(const carom_cluster_state *cluster);

/* The impulse of a contact, friction's share with it. */
static inline double carom_cluster_size_of_impulse(const carom_cluster_contact_state *contact) {
  return sqrt(contact->impulse * contact->impulse + contact->rubbed[0] * contact->rubbed[0] +
              contact->rubbed[1] * contact->rubbed[1]);
}

/* places.c: 1 for a cluster whose touches do not overlap; 0 if they share more than a 500th of the
 * largest impulse, for a push, and for more than CAROM_CLUSTER_IN_TURN balls. */
double carom_cluster_separation(const carom_cluster_state *cluster);

/* cluster.c: v, W and shift of ball[]; time, impulse and friction of contact[]. False where it
 * takes too many steps. */
bool carom_cluster_solve(carom_cluster_state *cluster);

#endif
