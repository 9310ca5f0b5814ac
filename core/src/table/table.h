/* A table prepared for all shots on it: rails, jaws and pockets as the centre of a ball sees
 * them. */
#ifndef CAROM_SRC_TABLE_TABLE_H
#define CAROM_SRC_TABLE_TABLE_H

#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "platform/ranges.h"
#include "platform/vectors.h"

#include <stdbool.h>

/* m: a ball that is deeper than this in the table overlaps it. */
#define CAROM_MOST_OVERLAP 1e-6
/* m: a ball that is deeper than this in another overlaps it. Rules allow balls so much smaller than
 * usual, and those that touch lie so much nearer. */
#define CAROM_MOST_BALL_OVERLAP (5e-5 + CAROM_MOST_OVERLAP)
/* m: the parts of a ring reach less far than a ball by this, so that no ball that touches a part is
 * behind it. */
#define CAROM_RING_OVERLAP 2e-6

enum { MOST_FEATURES = CAROM_RAILS_MOST + CAROM_JAWS_MOST + CAROM_POCKETS_MOST };

/* The parts that a ball can meet on the table, in the order of rails, jaws, pockets. */
typedef struct carom_features {
  double radius; /* the greatest of the balls for which the rest was prepared; 0: nothing yet */
  int rails, jaws, pockets, count;
  double line[CAROM_RAILS_MOST][3];  /* unit normal towards the played side, and offset: distance
                                        = line . (x, y, 1) */
  double along[CAROM_RAILS_MOST][3]; /* position along the rail, 0 at p and 1 at q: along . (x, y,
                                        1) */
  /* boxes around the things, in single precision, rounded outward */
  float low_x[MOST_FEATURES], high_x[MOST_FEATURES], low_y[MOST_FEATURES], high_y[MOST_FEATURES];
  double least;              /* the least radius of those balls */
  double reference;          /* radius of the balls that the table is meant for, nose.c */
  double nose_low;           /* least height of a nose */
  double width, pocket_back; /* of the tops of rails; height of the pockets' backs: see
                                carom_table */
  double hull[4];            /* low x, high x, low y, high y: centres stay inside */
  double eye[2];             /* a position on the table, from which one sees most others */
  bool has_eye;
  double clear[2]; /* half width and length of a box around the eye in which a ball meets nothing;
                      below 0: none */
} carom_features;

/* pooltool.c */
extern const carom_table carom_table_pooltool;

/* features.c: the unit normal of a rail towards its played side, and its offset: distance = line
 * . (x, y, 1). */
void carom_rail_line(const carom_rail *rail, double line[3]);
/* Prepares a table for balls of a greatest radius; reference: the radius that it is meant for. */
void carom_features_of(const carom_table *table, double radius, double reference,
                       carom_features *features);

/* seams.c: a jaw that continues a rail. */
enum { CAROM_SEAMS_MOST = 2 }; /* an arc has two ends */
typedef struct carom_seam {
  int rail;
  double end[2]; /* of the rail */
} carom_seam;
/* The seams of a jaw, which depend only on the numbers of the table, and their number. */
int carom_seams_of(const carom_table *table, int index, carom_seam seam[CAROM_SEAMS_MOST]);
/* Changes the friction and the restitution of a jaw, for a ball of a kind, to those at the position
 * that the ball touches. */
void carom_blend_jaw(const carom_table *table, int index, const carom_ball_kind *kind,
                     const double centre[3], double *mu, double *restitution);

/* part_names.c: whether a rail is the cut of a pocket, and no cushion: those are short. */
bool carom_is_cut(const carom_table *table, int rail);
/* Whether a position is so near to a pocket that a rail that ends there is next to it. */
bool carom_is_near_pocket(const carom_table *table, int pocket, const double place[2]);

/* nose.c: the height of a nose for a ball, how far it is inside the wall that represents it, and
 * the distance from the wall at which a ball on the cloth touches it. */
double carom_nose_height(const carom_ball_kind *kind, double height);
double carom_nose_shift(double height, double reference);
double carom_reach_on_cloth(const carom_ball_kind *kind, double height, double reference);

/* Whether a position is in the box around the eye in which a ball meets nothing. */
static inline bool carom_is_clear(const carom_features *features, const double centre[2]) {
  return fabs(centre[0] - features->eye[0]) <= features->clear[0] &&
         fabs(centre[1] - features->eye[1]) <= features->clear[1];
}

/* A prepared table as a ball of one kind on the cloth meets it. */
typedef struct carom_ground {
  const carom_table *table;
  const carom_features *features;
  const carom_ball_kind *kind;
  /* m: how far from the line of a rail, or beyond the circle of a jaw, the ball touches it */
  double rail[CAROM_RAILS_MOST], jaw[CAROM_JAWS_MOST];
} carom_ground;

/* parts.c: the parts of a table, each by itself. *where becomes the index of the part at fault,
 * or -1. */
carom_status carom_check_table(const carom_table *table, int *where);
/* Prepares the table, which is meant for balls of the radius `reference`, for those from a least
 * to a greatest radius, unless that has been done. */
carom_status carom_prepare_table(const carom_table *table, double least, double greatest,
                                 double reference, carom_features *features, int *where);
/* The radius that a table is meant for; `usual` where it names none. */
static inline double carom_reference_of(const carom_table *table, double usual) {
  return table->ball_radius > 0.0 ? table->ball_radius : usual;
}
/* Both, for balls of one radius, and the part at fault. */
carom_status carom_check_parts(const carom_table *table, double radius, double usual,
                               carom_features *features, carom_part *part);

/* places.c: a table as balls of a kind meet it. */
void carom_ground_of(const carom_table *table, const carom_features *features,
                     const carom_ball_kind *kind, carom_ground *ground);
/* Whether a ball on the cloth is within the cushions and in no pocket; if not, the part in which it
 * is, CAROM_PART_NONE outside the ring. */
bool carom_stands_on_table(const carom_table *table, const carom_features *features,
                           const carom_ball_kind *kind, const double centre[3]);
carom_part carom_part_there(const carom_ground *ground, const double centre[3]);
/* Whether an airborne ball is above the table or its rails, and in no cushion. Below the tops it
 * must be within the cushions. */
bool carom_is_above_table(const carom_table *table, const carom_features *features,
                          const carom_ball_kind *kind, const double centre[3]);
/* Whether the way from the eye of the table straight to a position is clear of all parts for the
 * centre of a ball on the cloth. */
bool carom_is_in_sight(const carom_ground *ground, const double centre[2]);
/* Whether a position is outside the ring of cushions and pockets, for the centre of a ball that
 * touches none of them. */
bool carom_place_is_outside(const carom_table *table, const carom_features *features,
                            const carom_ball_kind *kind, const double centre[2]);

/* ring.c: that the parts of a table keep balls on it, and its rails are played from the right
 * side. */
carom_status carom_check_ring(const carom_ground *ground, carom_table_fault *fault);
/* A position next to the middle of the longest rail, on its played side, at twice the radius from
 * it; false without rails. */
bool carom_beside_longest(const carom_table *table, const carom_features *features, double radius,
                          double place[2]);
/* Whether a position is outside, as above, computed only from the parts of the table: some
 * microseconds. */
bool carom_is_cut_off(const carom_ground *ground, const double centre[2]);

/* The kind of part of which a table has too many, by the error; NONE for other errors. */
static inline carom_part_kind carom_surplus_of(carom_status error) {
  switch (error) {
  case CAROM_ERROR_RAILS:
    return CAROM_PART_RAIL;
  case CAROM_ERROR_JAWS:
    return CAROM_PART_JAW;
  case CAROM_ERROR_POCKETS:
    return CAROM_PART_POCKET;
  default:
    return CAROM_PART_NONE;
  }
}

#endif
