/* The kind of row that is a collision of two balls: 26 numbers, those of a carom_impact, and 12
 * results. */
#include "rows/kind.h"
#include "rows/quantities.h"

#include <string.h>

enum {
  NUMBERS = sizeof(carom_impact) / sizeof(double),
  RESULTS = sizeof(carom_result) / sizeof(double)
};
enum { RADIUS = 9, MASS = 10, CLOTH = 11, SECOND = 12 };

#define OF_BALL(n, partner)                                                                     \
  {"r" n "x", 0, NO_NUMBER, 0}, {"r" n "y", 0, NO_NUMBER, 0}, {"r" n "z", 0, NO_NUMBER, 0},     \
      {"v" n "x", 0, NO_NUMBER, 0}, {"v" n "y", 0, NO_NUMBER, 0}, {"v" n "z", 0, NO_NUMBER, 0}, \
      {"w" n "x", 0, NO_NUMBER, 0}, {"w" n "y", 0, NO_NUMBER, 0}, {"w" n "z", 0, NO_NUMBER, 0}, \
      {"R" n, "R", (partner) + RADIUS, 0}, {"M" n, "M", (partner) + MASS, 0}, {                 \
    "u_s" n, "u_s", (partner) + CLOTH, 0                                                        \
  }

static const column columns[NUMBERS] = {
    OF_BALL("1", SECOND), OF_BALL("2", 0), {"u_b", 0, NO_NUMBER, 0}, {"e_b", 0, NO_NUMBER, 0}};
static const double defaults[NUMBERS] = {0};

static const char *name(const shared_options *shared) {
  return carom_word(CAROM_WORDS_SOLVER, (int)shared->options.solver);
}

static carom_status check(const void *in, const shared_options *shared, int *field) {
  return carom_check(in, &shared->options, field);
}

/* A law of friction depends on the slip, and so on the row. */
static void prepare(const shared_options *shared, void *in) {
  carom_impact *impact = in;
  if (shared->friction.is_set)
    impact->mu_ball = carom_mu_ball(impact, shared->friction.law);
}

static void solve(const shared_options *shared, bool single, const void *in, size_t n, void *out,
                  int8_t *status) {
  if (single)
    carom_collide_batch_f32(in, n, &shared->options, out, status);
  else
    carom_collide_batch(in, n, &shared->options, out, status);
}

static void derive_row(const void *in, const void *out, double *numbers) {
  const derived d = derive(in, out);
  memcpy(numbers, &d, sizeof d);
}

const row_kind ball_kind = {
    .noun = "collision",
    .clue = "mu_w",
    .meant = "with --cushion impacts on a cushion are read; ",
    .numbers = NUMBERS,
    .results = RESULTS,
    .columns = columns,
    .defaults = defaults,
    .radius = RADIUS,
    .height = NO_NUMBER,
    .motion = {3, SECOND + 3},
    .result_columns = RESULT_COLUMNS,
    .has_single = true,
    .name = name,
    .check = check,
    .prepare = prepare,
    .solve = solve,
    .derived_columns = DERIVED_COLUMNS,
    .derived = DERIVED_NUMBERS,
    .derive = derive_row,
};
