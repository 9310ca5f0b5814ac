/* Balls set up for the first shot of a game. */
#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "table/spots.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static const int sizes[] = {10, 16, 11, 22, 3};

int carom_rack_size(carom_rack_kind kind) {
  return (int)kind >= 0 && kind <= CAROM_RACK_THREECUSHION ? sizes[kind] : 0;
}

/* splitmix64 */
static uint64_t random_bits(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
static double random_symmetric(uint64_t *state) { /* -1 to 1 */
  return 2.0 * ((double)(random_bits(state) >> 11) * 0x1p-53) - 1.0;
}

typedef struct rack {
  const carom_table *table;
  carom_shot_ball *balls;
  carom_ball_kind kind;
  double gap;
  uint64_t state;
} rack;

static void put(rack *k, int ball, double x, double y) {
  k->balls[ball] = (carom_shot_ball){.kind = k->kind, .state = {.r = {x, y, k->kind.radius}}};
}

/* A place of the triangle: row 0 is its front, places count from the left. Up to a quarter of
 * the gap off, in any direction. */
static void put_in_row(rack *k, int ball, double front, int row, int place) {
  const double pitch = 2.0 * k->kind.radius + k->gap;
  double x, y;
  do {
    x = random_symmetric(&k->state);
    y = random_symmetric(&k->state);
  } while (x * x + y * y > 1.0);
  put(k, ball, 0.5 * k->table->width + (place - 0.5 * row) * pitch + 0.25 * k->gap * x,
      front + row * pitch * 0.8660254037844386 + 0.25 * k->gap * y);
}

/* The numbers from first to last, in an order drawn from the seed. */
static void shuffle(rack *k, int *number, int count) {
  for (int n = count - 1; n > 0; n--) {
    const int other = (int)(random_bits(&k->state) % (uint64_t)(n + 1)), kept = number[n];
    number[n] = number[other];
    number[other] = kept;
  }
}

/* Fills the places that are still 0 with the numbers from 1 to `last` that have no place yet. */
static void fill(rack *k, int *number, int last) {
  int rest[16], count = 0, next = 0;
  for (int n = 1; n <= last; n++) {
    bool placed = false;
    for (int p = 0; p < last; p++)
      placed |= number[p] == n;
    if (!placed)
      rest[count++] = n;
  }
  shuffle(k, rest, count);
  for (int p = 0; p < last; p++)
    if (number[p] == 0)
      number[p] = rest[next++];
}

static void triangle(rack *k, const int *number, int rows, double front) {
  for (int row = 0, p = 0; row < rows; row++)
    for (int place = 0; place <= row; place++)
      put_in_row(k, number[p++], front, row, place);
}

static void nineball(rack *k, double front) {
  static const int rows[9] = {0, 1, 1, 2, 2, 2, 3, 3, 4}, places[9] = {0, 0, 1, 0, 1, 2, 1, 2, 2};
  int number[9] = {[0] = 1, [4] = 9};
  fill(k, number, 9);
  for (int p = 0; p < 9; p++)
    put_in_row(k, number[p], front, rows[p], places[p]);
}

static void eightball(rack *k, double front) {
  int number[15] = {[4] = 8};
  const uint64_t drawn = random_bits(&k->state);
  const int solid = 1 + (int)(drawn % 7), stripe = 9 + (int)(drawn / 7 % 7),
            left = drawn / 49 % 2 == 0;
  number[10] = left ? solid : stripe;
  number[14] = left ? stripe : solid;
  fill(k, number, 15);
  triangle(k, number, 5, front);
}

static void tenball(rack *k, double front) {
  int number[10] = {[0] = 1, [4] = 10};
  fill(k, number, 10);
  triangle(k, number, 4, front);
}

/* ---- Spots by the rules of the sports */

carom_d carom_d_of(double width, double length) {
  return (carom_d){.x = 0.5 * width, .y = 0.737 / 3.569 * length, .radius = 0.292 / 1.778 * width};
}

bool carom_is_in_d(const carom_table *table, double x, double y) {
  const carom_d d = carom_d_of(table->width, table->length);
  x -= d.x;
  y -= d.y;
  return y <= 0.0 && x * x + y * y <= d.radius * d.radius;
}

carom_status carom_spot_of(carom_rack_kind kind, const carom_table *table, int ball,
                           double place[2]) {
  if (table == NULL || place == NULL)
    return CAROM_ERROR_NULL;
  /* pool has as many balls as there may be */
  const bool pool = kind != CAROM_RACK_SNOOKER && kind != CAROM_RACK_THREECUSHION;
  const int balls = carom_rack_size(kind);
  if (balls == 0 || ball < 0 || ball >= (pool ? CAROM_BALLS_MOST : balls))
    return CAROM_ERROR_RACK;
  const double w = table->width, l = table->length;
  const carom_d d = carom_d_of(table->width, table->length);
  /* the foot spot, or the head spot of the cue ball */
  double x = 0.5 * w, y = ball == 0 ? 0.25 * l : 0.75 * l;
  if (kind == CAROM_RACK_THREECUSHION) {
    x += ball == 0 ? 0.1825 / 1.42 * w : 0.0;
    y = ball == 2 ? 0.75 * l : 0.25 * l;
  } else if (kind == CAROM_RACK_SNOOKER && ball == 0) {
    x += 0.4 * d.radius;
    y = d.y - 0.3 * d.radius;
  } else if (kind == CAROM_RACK_SNOOKER && ball >= 16) {
    const double across[] = {d.radius, -d.radius, 0.0, 0.0, 0.0, 0.0};
    const double along[] = {d.y, d.y, d.y, 0.5 * l, 0.75 * l, l - 0.324 / 3.569 * l};
    x += across[ball - 16];
    y = along[ball - 16];
  }
  place[0] = x;
  place[1] = y;
  return CAROM_OK;
}

static void put_on_spot(rack *k, carom_rack_kind kind, int ball) {
  double at[2] = {0.0, 0.0};
  carom_spot_of(kind, k->table, ball, at);
  put(k, ball, at[0], at[1]);
}

static void snooker(rack *k) {
  int number[15];
  for (int n = 0; n < 15; n++)
    number[n] = n + 1;
  triangle(k, number, 5, 0.75 * k->table->length + 2.0 * k->kind.radius + fmax(k->gap, 1e-3));
  put_on_spot(k, CAROM_RACK_SNOOKER, 0);
  for (int ball = 16; ball < 22; ball++)
    put_on_spot(k, CAROM_RACK_SNOOKER, ball);
}

static void threecushion(rack *k) {
  for (int ball = 0; ball < 3; ball++)
    put_on_spot(k, CAROM_RACK_THREECUSHION, ball);
}

carom_status carom_rack(carom_rack_kind kind, const carom_table *table, double gap, uint64_t seed,
                        carom_shot_ball *balls, int room) {
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  carom_game game = CAROM_GAME_POOL;
  if (kind == CAROM_RACK_SNOOKER)
    game = CAROM_GAME_SNOOKER;
  else if (kind == CAROM_RACK_THREECUSHION)
    game = CAROM_GAME_BILLIARD;
  rack k = {table, balls, carom_ball_kind_of(game), gap, seed};
  const int size = carom_rack_size(kind);
  if (size == 0 || room < size || !(gap >= 0.0 && gap <= k.kind.radius))
    return CAROM_ERROR_RACK;
  const double front = 0.75 * table->length;
  if (kind == CAROM_RACK_SNOOKER) {
    snooker(&k);
  } else if (kind == CAROM_RACK_THREECUSHION) {
    threecushion(&k);
  } else {
    put_on_spot(&k, kind, 0);
    if (kind == CAROM_RACK_NINEBALL)
      nineball(&k, front);
    else if (kind == CAROM_RACK_EIGHTBALL)
      eightball(&k, front);
    else
      tenball(&k, front);
  }
  return CAROM_OK;
}
