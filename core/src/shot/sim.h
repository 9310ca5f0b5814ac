/* A shot in progress, which the sources of this folder share. One carom_play is on the stack of
 * carom_shoot(), nothing is allocated. */
#ifndef CAROM_SRC_SHOT_SIM_H
#define CAROM_SRC_SHOT_SIM_H

#include "shot/shot.h"

/* The next meeting of a ball with the table. */
typedef struct carom_meeting {
  double time;
  int type, part; /* a carom_event_type, or 0 where it leaves the table on the cloth; the index
                     of rail, jaw or pocket */
} carom_meeting;

struct carom_rules;

/* The cue that continues after its push, follow_through.c. */
typedef struct carom_follow {
  double end;       /* s: it is there up to then; -1: it is not */
  double start, V;  /* s: it moves since then; at this speed, m/s */
  double along;     /* m: where it was then, along its axis from where it struck first */
  double left;      /* m: of the length of its follow-through, then */
  double origin[3]; /* m: the struck ball at that first strike */
  double time;      /* s: when it touches the struck ball again; infinite: it does not */
  carom_cue cue;    /* of a stopped shot */
} carom_follow;

/* How long a column of balls is; derivatives have no columns. */
enum { CAROM_COLUMN = 32 };

typedef struct carom_sim {
  /* of a state that is kept, state.c */
  uint64_t can_go_on, seal;
  uint64_t of_table, of_balls, of_options;
  const struct carom_rules *rules; /* of the world, rules.h */
  const carom_table *table;
  const carom_features *features;
  const carom_prepared *layout;
  const carom_shot_options *opt;
  const carom_cue *cue;
  carom_shot *shot;
  int count, struck; /* struck: the cue ball */
  carom_world world;
  bool has_hit;  /* the cue ball has met another, */
  bool turned;   /* or a cushion */
  bool unlike;   /* radii differ from each other or from the table's reference: contacts are
                    contacts of spheres in space */
  int flying;    /* airborne balls */
  double widest; /* m: the greatest radius of the balls */
  double time;
  int64_t slow_instants; /* that had a slow contact, so far; see resolve.c */
  double slow_last;      /* s: the last of them */
  int64_t round;         /* events so far: shows when an entry below was computed */
  carom_ball_rates rates[CAROM_BALLS_MOST];
  carom_path path[CAROM_BALLS_MOST];
  /* the paths once more, in columns: many pairs are searched at a time */
  double x[CAROM_COLUMN], y[CAROM_COLUMN], v_x[CAROM_COLUMN], v_y[CAROM_COLUMN], a_x[CAROM_COLUMN],
      a_y[CAROM_COLUMN], start[CAROM_COLUMN], horizon[CAROM_COLUMN];
  /* R, 0 and 0 but for airborne balls */
  double z[CAROM_COLUMN], v_z[CAROM_COLUMN], a_z[CAROM_COLUMN];
  carom_meeting meeting[CAROM_BALLS_MOST]; /* with the table */
  /* when i < j meet; infinite where not before a path ends */
  double pair[CAROM_BALLS_MOST][CAROM_BALLS_MOST];
  int32_t pair_round[CAROM_BALLS_MOST][CAROM_BALLS_MOST], meeting_round[CAROM_BALLS_MOST];
  double own_end[CAROM_BALLS_MOST]; /* the end of the ball's phase or its meeting, whichever is
                                     earlier */
  double first[CAROM_BALLS_MOST];   /* of row i of pair[] */
  int8_t first_with[CAROM_BALLS_MOST];
} carom_sim;

/* A shot on its way, with the cue that continues. Only the loop of the shot needs the cue. */
typedef struct carom_play {
  carom_sim sim;
  carom_follow follow;
} carom_play;

/* An event that is due. */
typedef struct carom_due {
  double time;
  int type, a, b; /* a type of event, or one of the following */
} carom_due;

/* In addition to the types of events. CAROM_DUE_PIECE, another piece of ball a's path, is reported
 * to nobody; in the order of simultaneous events it counts as an end of a phase. */
enum {
  CAROM_DUE_REST = -1,         /* nothing will happen any more */
  CAROM_DUE_NOTHING = 0,       /* no event, where one may be */
  CAROM_DUE_OFF_THE_CLOTH = 0, /* ball a, on the cloth, will find no part of the table */
  CAROM_DUE_PIECE = CAROM_EVENT_LEFT_TABLE + 1
};

/* Whether contacts are looked for in space, and not only on the cloth. */
static inline bool carom_in_space(const carom_sim *sim) {
  return sim->flying > 0 || sim->unlike;
}

/* resolve.c: the height of a ball's centre on the top of rail `part`, or of jaw `part` less the
 * rails. */
double carom_height_on_top(const carom_sim *sim, int ball, int part);
/* flight.c: the first meeting of an airborne ball with the table, from r with v now, its time
 * from now on; landing: the time until it would land. */
carom_meeting carom_meet_in_flight(const carom_sim *sim, int ball, const double r[3],
                                   const double v[3], double landing);

/* detect.c: looks again for all that two balls can meet, from now on; `partner` may be -1. */
void carom_detect(carom_sim *sim, int ball, int partner);
/* The same for all balls, at the start. */
void carom_detect_all(carom_sim *sim);
/* Takes what follows from the kinds of the balls. */
void carom_take_rates(carom_sim *sim);
/* Computes again all that follows from the paths, meetings and pairs: columns and firsts. */
void carom_detect_columns(carom_sim *sim);

/* state.c: takes fingerprints of table, balls and options, where a state will be kept. */
void carom_state_begin(carom_sim *sim);
/* Leaves the shot, of which the state is the copy, without the caller's pointers. The facts so far
 * are in play->sim.shot. */
void carom_state_save(carom_play *play, carom_shot_state *state);
/* Whether play, the copy of a state with the caller's pointers, can continue: CAROM_OK or why not.
 * Numbers that follow from others are computed again; count, time and facts so far go into
 * play->sim.shot. */
carom_status carom_state_check(carom_play *play, const carom_shot_state *state, int count);
/* Gives a state the seal that its bits must have. */
void carom_state_seal(carom_shot_state *state);

/* next.c: the next event. */
carom_due carom_next(const carom_sim *sim);

/* resolve.c: a contact in the world carom of two balls, or of a ball with a rail or a jaw, now;
 * b is NULL then. Changes the states, labels too. */
carom_status carom_resolve(carom_sim *sim, const carom_due *pending_event, carom_ball_state *a,
                           carom_ball_state *b);
/* The unit vector from the centre of a ball into the rail of a line, or into a jaw; horizontal for
 * a ball on the cloth. reference: the radius that the table is meant for. */
void carom_into_nose(const carom_table *table, const double line[3], double reference,
                     const carom_ball_kind *kind, const carom_due *pending_event,
                     const carom_ball_state *state, double N[3]);
/* The unit vector from ball a to ball b, or into the cushion; and how fast the two close along
 * it, m/s. */
void carom_contact_normal(const carom_sim *sim, const carom_due *pending_event,
                          const carom_ball_state *a, const carom_ball_state *b, double normal[3]);
double carom_closing(const carom_ball_state *a, const carom_ball_state *b, const double normal[3]);
/* The speed below which contacts are slow, after so many instants that had one. */
double carom_slow_speed(int64_t instants);

/* The nose of a rail or a jaw where a ball touches it. */
typedef struct carom_nose {
  double height, jaw_radius; /* jaw_radius: 0 of a rail */
  double mu_cushion, restitution;
} carom_nose;

/* models.c: v and w after a collision by the model requested. normal: unit vector from the first
 * ball to the second one, or into the cushion. Balls `in_space` are not both on the cloth, or have
 * unlike radii: they collide the more as spheres the higher they are and the more n is tilted; an
 * airborne ball meets a nose with less of the cloth the higher it is. */
carom_status carom_model_balls(const carom_sim *sim, const carom_due *pending_event,
                               const double normal[3], bool in_space, carom_ball_state *a,
                               carom_ball_state *b);
/* How free of the cloth a contact of two balls is, phi of cluster/cluster.h. */
double carom_freedom_of_pair(const carom_sim *sim, const carom_due *pending_event,
                             const double normal[3], const carom_ball_state *a,
                             const carom_ball_state *b);
carom_status carom_model_cushion(const carom_sim *sim, const carom_due *pending_event,
                                 const double normal[3], carom_ball_state *state);
/* The unit vector from ball a to ball b, in space. A ball on the cloth is at z = R exactly. */
void carom_line_of_centres(const carom_ball_kind *kind_a, const carom_ball_state *a,
                           const carom_ball_kind *kind_b, const carom_ball_state *b,
                           double normal[3]);
carom_nose carom_nose_of(const carom_sim *sim, const carom_due *pending_event,
                         const carom_ball_state *state);
/* resolve.c: the phase of a ball after a contact, which may have lifted it or pushed it down if
 * it was in space. */
void carom_label_after(bool in_space, const carom_ball_kind *kind, carom_ball_state *state);
/* models.c: the numbers of a ball's friction with others by a law, friction/laws.h. A pair has the
 * mean of each. */
void carom_law_of_ball(carom_ball_friction law, const carom_ball_kind *kind, double k[3]);

/* check.c: the position for events, the options of a shot, and a ball by itself. */
carom_status carom_check_room(const carom_shot *shot);
carom_status carom_check_shot_options(const carom_shot_options *opt);
carom_status carom_check_ball(const carom_shot_ball *ball, bool flat);

/* ---- slate.c: the impact of a ball with something that does not move */

/* A ball that touches something fixed. N is the unit vector from its centre into that. */
typedef struct carom_touch {
  double N[3];
  double closing; /* v . N, m/s */
  double slip;    /* |u|, m/s, u = v - (v . N) N + R w x N the velocity of its surface there */
  double t[3];    /* u/|u|, or 0 */
} carom_touch;

carom_touch carom_touch_of(const double N[3], double radius, const carom_ball_state *state);

/* Takes the impulses J N and J_t t, over the mass, m/s, from the ball. */
void carom_take_impulse(const carom_touch *touch, double radius, double J, double J_t,
                        carom_ball_state *state);

/* slate.c: the touch of the slate by a ball with v[2] <= 0; and what the impulses J, by which the
 * ball leaves it at the speed `up`, and J_t change. */
carom_touch carom_touch_slate(const carom_ball_kind *kind, const carom_ball_state *state);
void carom_answer_of_slate(const carom_ball_kind *kind, const carom_touch *touch, double up,
                           double J_t, carom_ball_state *state);

/* ---- spheres.c: two spheres that collide in space, n the unit vector from ball a to ball b */

/* The speed at which the surface of a slips on the surface of b, m/s. Positions are not read. */
double carom_spheres_slip(const carom_impact *in, const double normal[3]);
/* The collision of two spheres in space along any line of centres, with its arguments checked: one
 * impulse in closed form, for any radii and masses, with restitution e and Coulomb's friction
 * mu_ball, which either stops the slip or slips to the end. The cloth is not involved, so mu_slide
 * is not read. Only the direction of b.r - a.r matters. CAROM_SEPARATING: the motion before, as the
 * balls do not close. CAROM_ERROR_OVERFLOW: speeds are above 1e300 m/s, or impulses are not within
 * 1e-290 to 1e300 kg m/s. With an error *out is all NaN. */
carom_status carom_impact3(const carom_impact *in, carom_result *out);
/* The motion after the impact of balls that close along n. */
void carom_spheres_collide(const carom_impact *in, const double normal[3], carom_result *out);

#endif
