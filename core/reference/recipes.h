/* Layouts of few balls from few numbers, each of which moves alone and over a wide range: places
 * by gaps and angles from other balls and from cushions. */
#ifndef CAROM_REFERENCE_RECIPES_H
#define CAROM_REFERENCE_RECIPES_H

#include "carom_shot.h"

#include <stddef.h>
#include <stdint.h>

enum { RECIPE_BALLS = 16 };

typedef struct recipe {
  const char *family;
  int count, table;             /* of balls; a carom_table_kind */
  int rail, end;                /* the cushion at which ball 0 lies, and from which of its ends */
  double along, away;           /* m: from that end along the rail; between ball and nose */
  int anchor[RECIPE_BALLS];     /* the ball from which ball k has its position, for k > 0 */
  double gap[RECIPE_BALLS];     /* m: between the two */
  double bearing[RECIPE_BALLS]; /* degrees: of k from of[k] */
  double height, rise;          /* m, m/s: of the last ball above the cloth */
  double speed, phi, theta, a, b, follow; /* of the cue at ball 0; speed 0: none */
  double pace, heading;     /* m/s, degrees: the last ball's motion where there is no cue */
  double roll, side;        /* its spins in units of v/R */
  double restitution, mass; /* of the balls; of the cue, kg */
  double radius[RECIPE_BALLS], weight[RECIPE_BALLS]; /* of ball k, over those of pool; 0: 1 */
  int cushion_model, friction;                       /* of carom_shot_options */
  double time;                                       /* s: when the shot is stopped */
} recipe;

/* One number of a recipe, and the range over which it moves. */
typedef struct recipe_number {
  const char *name;
  size_t offset;
  double low, high;
} recipe_number;

enum { RECIPE_NUMBERS = 24 };

/* A layout as carom_shoot() takes it. */
typedef struct recipe_layout {
  carom_table table;
  carom_shot_ball ball[RECIPE_BALLS];
  int count;
  carom_cue cue;
  carom_shot_options options;
} recipe_layout;

/* Recipe number `index` of a seed, of the families by turns that have few balls, all alike. */
void recipe_make(uint64_t seed, uint64_t index, recipe *r);

/* All families: racks, unlike balls and other models come behind the others. The same of a family
 * from 0 on, and its name. */
int recipe_families(void);
const char *recipe_family(int family);
void recipe_make_of(int family, uint64_t seed, uint64_t index, recipe *r);

/* The numbers of a recipe that can move. Returns how many. */
int recipe_numbers(const recipe *r, recipe_number numbers[RECIPE_NUMBERS]);

/* The layout of a recipe. */
void recipe_lay(const recipe *r, recipe_layout *layout);

#endif
