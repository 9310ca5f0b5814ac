/* Derivatives in several directions, a pass of at most CAROM_TANGENT_COLUMNS of them at a time:
 * the common part of this room's C and its C++, follow.cpp. README.md explains how they work. */
#ifndef CAROM_SRC_TANGENT_WORK_H
#define CAROM_SRC_TANGENT_WORK_H

#include "carom_tangent.h"
#include "motion/path.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

/* Derivatives that a number carries, of which the last is that by time. */
enum { CAROM_TANGENT_WIDTH = 8, CAROM_TANGENT_COLUMNS = CAROM_TANGENT_WIDTH - 1 };

/* In the order of the numbers of a state. */
enum { S_X, S_Y, S_V_X, S_V_Y, S_W_X, S_W_Y, S_W_Z, S_Z, S_V_Z };

typedef double carom_tangent_row[CAROM_TANGENT_WIDTH];
typedef carom_tangent_row carom_tangent_rows[CAROM_STATE_NUMBERS];

/* The flags and the error of a derivative. */
typedef struct carom_tangent_note {
  int32_t flags; /* of carom_tangent_flag */
  double error;  /* of differences, relative */
} carom_tangent_note;

/* The directions of a pass: so many of m, from `first` on. */
typedef struct carom_tangent_pass {
  int m, first, columns;
} carom_tangent_pass;

/* A ball since its last event. Total tangents of the state there are in tangent->final. */
typedef struct carom_tangent_ball {
  const carom_ball_kind *kind;
  carom_ball_state origin; /* the state there, */
  double origin_time;      /* and its time, s, */
  carom_tangent_row start; /* with its tangent */
  double a[3];             /* half the acceleration from there on; for reach only */
  double last_contact;     /* s */
} carom_tangent_ball;

/* The tip of a cue that continues after its push, as in carom_follow, with its tangents. */
typedef struct carom_tangent_tip {
  double V, along, start_time, origin[2]; /* from start_time, s */
  carom_tangent_row V_row, along_row, start;
  double left; /* m, of the length of the follow-through, at the start; */
  carom_tangent_row left_row;
  double touch_left; /* and as its tip touched last */
  carom_tangent_row touch_left_row;
  double moved[3]; /* m, by noses, beside its way: shot/follow_through.c */
  carom_tangent_row moved_row[3];
  bool turned; /* the struck ball has met another, or a cushion */
} carom_tangent_tip;

/* A shot on its way through its events once more. */
typedef struct carom_tangent_work {
  const carom_table *table;
  const carom_cue *cue;
  const carom_shot_options *opt;
  const carom_tangent_seeds *seeds;
  carom_tangent *tangent;
  int count; /* balls */
  carom_tangent_pass pass;
  double reference;      /* radius of the balls that the table is meant for: nose.c */
  int reference_ball;    /* has it, where the table names none */
  int64_t slow_instants; /* as in carom_sim */
  double slow_last;
  carom_tangent_ball ball[CAROM_BALLS_MOST];
  carom_tangent_tip tip;
  /* of the last event: its flags, the tangent of its time, total tangents before it, of
   * both balls */
  carom_tangent_note note;
  carom_tangent_row time;
  carom_tangent_rows approach[2];
  bool inner; /* it is one of a cluster, and not the one that starts it */
  /* m: how far its hit is from a miss, or infinity; for reach only */
  double margin;
  carom_tangent_row margin_row;
} carom_tangent_work;

/* Whether an event is a further touch of the tip, after the strike. */
static inline bool carom_touches_again(const carom_event *e) {
  return e->type == CAROM_EVENT_STRIKE && e->time > 0.0;
}

/* Whether it is a contact with the nose of a cushion. */
static inline bool carom_is_nose(const carom_event *e) {
  return e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW;
}

/* The numbers of the caller that represent row `row` in a pass. */
static inline double *carom_tangent_columns(const carom_tangent_pass *pass, double *rows,
                                            int64_t row) {
  return rows + row * pass->m + pass->first;
}

/* follow.cpp: the gap whose zero would be an event of `type`, `a` and `b`, at its time, m, with its
 * derivatives at that time, as the balls move from their last events on. */
double carom_tangent_gap(carom_tangent_work *w, const carom_event *event, carom_tangent_row d);
/* Takes a ball to where it begins, from the seeds; */
void carom_tangent_begin(carom_tangent_work *w, int i);
/* an event and its balls behind it; CAROM_OK, or an error of the collision; */
carom_status carom_tangent_follow(carom_tangent_work *w, const carom_event *event);
/* the events of a cluster, of which the first is event `at` of the shot; writes tangent->before
 * too. CAROM_ERROR_TANGENT where it is not found again; */
carom_status carom_tangent_follow_cluster(carom_tangent_work *w, const carom_event *events,
                                          int count, int64_t index);
/* tangents of ball i at a fixed time, not before its last event. */
void carom_tangent_at(const carom_tangent_work *w, int i, double time, carom_tangent_rows d);

/* follow.cpp: carom_collide() of balls that close, and carom_cushion(). Their arguments have
 * been checked. */
carom_status carom_tangent_of_balls(const carom_impact *in, const carom_options *opt,
                                    const carom_tangent_pass *pass, const double *seeds,
                                    double *tangent, carom_tangent_note *note);
carom_status carom_tangent_of_cushion(const carom_cushion_impact *in,
                                      const carom_cushion_options *opt,
                                      const carom_tangent_pass *pass, const double *seeds,
                                      double *tangent, carom_tangent_note *note);

/* A build without C++ has no derivatives: tangent.c rejects before it would call these. */
#if !defined(CAROM_WITH_TANGENTS) && !defined(__cplusplus)
static inline carom_status carom_no_tangents(const void *first, ...) {
  (void)first;
  return CAROM_ERROR_NO_TANGENTS;
}
#define carom_tangent_begin carom_no_tangents
#define carom_tangent_follow carom_no_tangents
#define carom_tangent_follow_cluster carom_no_tangents
#define carom_tangent_at carom_no_tangents
#define carom_tangent_gap carom_no_tangents
#define carom_tangent_of_balls carom_no_tangents
#define carom_tangent_of_cushion carom_no_tangents
#endif

#endif
