/* Random shots of every kind, from seeds. */
#ifndef CAROM_TESTS_RANDOM_SHOTS_H
#define CAROM_TESTS_RANDOM_SHOTS_H

#include "carom_shot.h"
#include "random.h"

typedef struct random_shot {
  const char *kind;
  carom_table table;
  carom_shot_ball ball[CAROM_BALLS_MOST];
  int count;
  carom_cue cue;
} random_shot;

/* The number of kinds, and their names. Those in space come behind the others, and are for
 * CAROM_SPACE_3D. */
int random_shot_kinds(void);
int random_shot_kinds_in_space(void);
const char *random_shot_kind(int kind);

/* Shot number `index` of a kind and seed. */
void random_shot_make(int kind, uint64_t seed, uint64_t index, random_shot *shot);

#endif
