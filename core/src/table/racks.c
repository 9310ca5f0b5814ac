/* Balls set up for the first shot of a game. */
#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "table/marks.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Racks as rows. A triangle has `rows` rows, of which row `spot` has its middle on the foot spot; a
 * diamond of nine balls has its widest row in the middle. Balls of `fixed` have their positions,
 * from the front and from the left; the others have no fixed ones. Other balls are on spots. */
typedef struct rack_row {
  carom_game game;
  int size; /* with the cue ball */
  int rows, spot;
  int fixed[15];
  bool diamond, unlike; /* unlike: a solid and a stripe in the corners of the base */
} rack_row;
static const rack_row racks[] = {
    [CAROM_RACK_NINEBALL] = {.game = CAROM_GAME_POOL,
                             .size = 10,
                             .rows = 5,
                             .spot = 0,
                             .fixed = {[0] = 1, [4] = 9},
                             .diamond = true},
    [CAROM_RACK_EIGHTBALL] = {.game = CAROM_GAME_POOL,
                              .size = 16,
                              .rows = 5,
                              .spot = 0,
                              .fixed = {[4] = 8},
                              .unlike = true},
    [CAROM_RACK_TENBALL] =
        {.game = CAROM_GAME_POOL, .size = 11, .rows = 4, .spot = 0, .fixed = {[0] = 1, [4] = 10}},
    [CAROM_RACK_SNOOKER] = {.game = CAROM_GAME_SNOOKER,
                            .size = 22,
                            .rows = 5,
                            .spot = 0,
                            .fixed = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}},
    [CAROM_RACK_THREECUSHION] = {.game = CAROM_GAME_BILLIARD, .size = 3},
    [CAROM_RACK_NINEONSPOT] = {.game = CAROM_GAME_POOL,
                               .size = 10,
                               .rows = 5,
                               .spot = 2,
                               .fixed = {[0] = 1, [4] = 9},
                               .diamond = true},
    [CAROM_RACK_BLACKBALL] = {.game = CAROM_GAME_BLACKBALL,
                              .size = 16,
                              .rows = 5,
                              .spot = 2,
                              .fixed = {[4] = 8},
                              .unlike = true},
    [CAROM_RACK_ROTATION] = {.game = CAROM_GAME_POOL,
                             .size = 16,
                             .rows = 5,
                             .spot = 0,
                             .fixed = {[0] = 1, [4] = 15, [10] = 3, [14] = 2}},
    [CAROM_RACK_PYRAMID] = {.game = CAROM_GAME_PYRAMID, .size = 16, .rows = 5, .spot = 0},
    [CAROM_RACK_FOURBALL] = {.game = CAROM_GAME_FOURBALL, .size = 4},
    [CAROM_RACK_COWBOY] = {.game = CAROM_GAME_POOL, .size = 4},
    [CAROM_RACK_BILLIARDS] = {.game = CAROM_GAME_SNOOKER, .size = 3},
    [CAROM_RACK_EIGHTONSPOT] = {.game = CAROM_GAME_POOL,
                                .size = 16,
                                .rows = 5,
                                .spot = 2,
                                .fixed = {[4] = 8},
                                .unlike = true}};

static const rack_row *row_of(carom_rack_kind kind) {
  if ((uint32_t)kind >= sizeof racks / sizeof *racks)
    return NULL;
  return &racks[kind];
}

int carom_rack_size(carom_rack_kind kind) {
  const rack_row *row = row_of(kind);
  if (row == NULL)
    return 0;
  return row->size;
}

/* splitmix64 */
static uint64_t random_bits(uint64_t *state) {
  uint64_t bits = *state += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
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
  double middle; /* of the table's width */
} rack;

static void put(rack *layout, int ball, double x, double y) {
  layout->balls[ball] =
      (carom_shot_ball){.kind = layout->kind, .state = {.r = {x, y, layout->kind.radius}}};
}

/* A position of the triangle: row 0 is its front, columns count from the left. Up to a quarter of
 * the gap off, in any direction. */
static void put_in_row(rack *layout, int ball, double front, int row, int place) {
  const double pitch = 2.0 * layout->kind.radius + layout->gap;
  double x, y;
  do {
    x = random_symmetric(&layout->state);
    y = random_symmetric(&layout->state);
  } while (x * x + y * y > 1.0);
  put(layout, ball, layout->middle + (place - 0.5 * row) * pitch + 0.25 * layout->gap * x,
      front + row * pitch * 0.8660254037844386 + 0.25 * layout->gap * y);
}

/* The numbers from first to last, in an order drawn from the seed. */
static void shuffle(rack *layout, int *number, int count) {
  for (int index = count - 1; index > 0; index--) {
    const int place = (int)(random_bits(&layout->state) % (uint64_t)(index + 1)),
              drawn = number[index];
    number[index] = number[place];
    number[place] = drawn;
  }
}

/* Fills the positions that are still 0 with the numbers from 1 to `last` that have no position
 * yet. */
static void fill(rack *layout, int *number, int last) {
  int rest[16], count = 0, next = 0;
  for (int index = 1; index <= last; index++) {
    bool placed = false;
    for (int p = 0; p < last; p++)
      placed |= number[p] == index;
    if (!placed)
      rest[count++] = index;
  }
  shuffle(layout, rest, count);
  for (int p = 0; p < last; p++)
    if (number[p] == 0)
      number[p] = rest[next++];
}

/* Sets up the balls of a row that form a pack, whose front is at y = front. */
static void pack(rack *layout, const rack_row *row, double front) {
  static const int widths[5] = {1, 2, 3, 2, 1}; /* of a diamond */
  int last = row->rows * (row->rows + 1) / 2;
  if (row->diamond)
    last = 9;
  int number[15];
  memcpy(number, row->fixed, sizeof number);
  if (row->unlike) {
    const uint64_t drawn = random_bits(&layout->state);
    const int right = (int)(drawn / 49 % 2); /* whether the solid is at the right corner */
    static const int corners[2] = {10, 14};
    number[corners[right]] = 1 + (int)(drawn % 7);
    number[corners[1 - right]] = 9 + (int)(drawn / 7 % 7);
  }
  fill(layout, number, last);
  for (int line = 0, p = 0; line < row->rows; line++) {
    int width = line + 1;
    if (row->diamond)
      width = widths[line];
    for (int place = 0; place < width; place++, p++)
      put_in_row(layout, number[p], front, line, place + (line + 1 - width) / 2);
  }
}

/* ---- Spots by the rules of the sports */

/* Positions of balls on the middle line, as fractions of the length, for racks without a pack. */
static const double middle_spots[][4] = {[CAROM_RACK_THREECUSHION] = {0.25, 0.25, 0.75},
                                         [CAROM_RACK_FOURBALL] = {0.25, 0.875, 0.25, 0.75},
                                         [CAROM_RACK_COWBOY] = {0.125, 0.25, 0.75, 0.5},
                                         [CAROM_RACK_BILLIARDS] = {0.2, 0.2, 1.0 - 0.324 / 3.569}};

/* The spot of the cue ball of snooker, or of a colour. */
static void find_snooker_spot(const carom_table *table, int ball, double place[2]) {
  enum { YELLOW = 16 };
  const carom_marks marks = carom_marks_of(table->width, table->length);
  const double d = marks.d_radius, line = marks.d_centre[1];
  if (ball == 0) {
    place[0] += 0.4 * d;
    place[1] = line - 0.3 * d;
    return;
  }
  const double across[] = {d, -d, 0.0, 0.0, 0.0, 0.0};
  const double along[] = {line,
                          line,
                          line,
                          marks.centre_spot[1],
                          marks.foot_spot[1],
                          table->length - 0.324 / 3.569 * table->length};
  place[0] += across[ball - YELLOW];
  place[1] = along[ball - YELLOW];
}

/* Whether a ball of snooker has its own spot. */
static bool has_snooker_spot(carom_rack_kind kind, int ball) {
  return kind == CAROM_RACK_SNOOKER && (ball == 0 || ball >= 16);
}

carom_status carom_spot_of(carom_rack_kind kind, const carom_table *table, int ball,
                           double place[2]) {
  if (table == NULL || place == NULL)
    return CAROM_ERROR_NULL;
  /* pool has as many balls as there may be */
  const rack_row *row = row_of(kind);
  const bool pool = row != NULL && row->rows > 0 && kind != CAROM_RACK_SNOOKER;
  if (row == NULL || ball < 0 || ball >= CAROM_BALLS_MOST || (!pool && ball >= row->size))
    return CAROM_ERROR_RACK;

  /* the foot spot, or the head spot of the cue ball */
  const carom_marks marks = carom_marks_of(table->width, table->length);
  const double *spot = marks.foot_spot;
  if (ball == 0)
    spot = marks.head_spot;
  memcpy(place, spot, sizeof marks.foot_spot);

  /* games whose balls have their own spots; the cue balls of two begin off the middle */
  if (row->rows == 0) {
    const int kinds = sizeof middle_spots / sizeof middle_spots[0];
    if ((int)kind >= kinds || middle_spots[kind][ball] == 0.0)
      return CAROM_ERROR_RACK; /* a new rack has no spots yet */
    place[1] = middle_spots[kind][ball] * table->length;
  }
  if (row->rows == 0 && kind != CAROM_RACK_COWBOY && ball == 0)
    place[0] += 0.1825 / 1.42 * table->width;
  if (has_snooker_spot(kind, ball))
    find_snooker_spot(table, ball, place);
  return CAROM_OK;
}

static void put_on_spot(rack *layout, carom_rack_kind kind, int ball) {
  double place[2] = {0.0, 0.0};
  carom_spot_of(kind, layout->table, ball, place);
  put(layout, ball, place[0], place[1]);
}

/* The gap before the pink that a rack of reds has at least, m. */
static const double red_gap = 1e-3;

carom_status carom_rack(carom_rack_kind kind, const carom_table *table, double gap, uint64_t seed,
                        carom_shot_ball *balls, int room) {
  if (table == NULL || balls == NULL)
    return CAROM_ERROR_NULL;
  const rack_row *row = row_of(kind);
  if (row == NULL)
    return CAROM_ERROR_RACK;
  const carom_marks marks = carom_marks_of(table->width, table->length);
  rack layout = {table, balls, carom_ball_kind_of(row->game), gap, seed, marks.foot_spot[0]};
  const double radius = layout.kind.radius;
  if (room < row->size || !(gap >= 0.0 && gap <= radius))
    return CAROM_ERROR_RACK;

  /* the balls that have spots, and the pack */
  const bool snooker = kind == CAROM_RACK_SNOOKER;
  for (int ball = 0; ball < row->size; ball++)
    if (ball == 0 || row->rows == 0 || has_snooker_spot(kind, ball))
      put_on_spot(&layout, kind, ball);
  double front = marks.foot_spot[1] - row->spot * (2.0 * radius + gap) * 0.8660254037844386;
  if (snooker)
    front += 2.0 * radius + fmax(gap, red_gap);
  if (row->rows > 0)
    pack(&layout, row, front);
  if (kind == CAROM_RACK_BILLIARDS) /* its player has not begun */
    balls[1].state = (carom_ball_state){.r = {0.0, 0.0, -0.1}, .label = CAROM_BALL_POCKETED};
  return CAROM_OK;
}
