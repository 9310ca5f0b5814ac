/* The kind of row that is an impact of a ball on a cushion: 15 numbers, those of a
 * carom_cushion_impact, and 6 results. */
#include "rows/kind.h"
#include "rows/quantities.h"

#include <math.h>
#include <string.h>

enum {
  NUMBERS = sizeof(carom_cushion_impact) / sizeof(double),
  RESULTS = sizeof(carom_motion) / sizeof(double)
};
enum { DERIVED = 6, NORMAL = 6, HEIGHT = 8, RADIUS = 9 };

#define PLAIN(name) \
  { name, NULL, NO_NUMBER, false }
static const column columns[NUMBERS] = {PLAIN("vx"),
                                        PLAIN("vy"),
                                        PLAIN("vz"),
                                        PLAIN("wx"),
                                        PLAIN("wy"),
                                        PLAIN("wz"),
                                        {"nx", NULL, NORMAL + 1, true},
                                        {"ny", NULL, NORMAL, true},
                                        PLAIN("h"),
                                        PLAIN("R"),
                                        PLAIN("M"),
                                        PLAIN("mu_s"),
                                        PLAIN("mu_w"),
                                        PLAIN("e"),
                                        {"rho", NULL, NO_NUMBER, true}};
static const double defaults[NUMBERS] = {[NORMAL + 1] = 1.0};

static const char *name(const shared_options *shared) {
  return carom_word(CAROM_WORDS_CUSHION_MODEL, (int)shared->rail.model);
}

static carom_status check(const void *in, const shared_options *shared, int *field) {
  const carom_cushion_options options = cushion_options_of(shared);
  return carom_cushion_check(in, &options, field);
}

static void solve(const shared_options *shared, bool single, const void *in, size_t n, void *out,
                  int8_t *status) {
  const carom_cushion_options options = cushion_options_of(shared);
  (void)single;
  carom_cushion_batch(in, n, &options, out, status);
}

/* The angle of a velocity that leaves the cushion from its normal; a mirror keeps that of the
 * velocity that came. */
static double rebound(const carom_cushion_impact *in, const double v[2]) {
  return plane_size(v) > 0.0 ? angle_between(v, (const double[]){-in->normal[0], -in->normal[1]})
                             : (double)NAN;
}

static void derive_row(const void *in, const void *out, double *numbers) {
  const carom_cushion_impact *impact = in;
  const carom_motion *motion = out;
  const double m = impact->mass, R = impact->radius;
  double rolling[3];
  carom_rolling_velocity(motion->v, motion->w, R, rolling);
  const double values[DERIVED] = {angle_between(impact->normal, impact->v),
                                  rebound(impact, motion->v),
                                  rebound(impact, rolling),
                                  rolling[0],
                                  rolling[1],
                                  1.0 - energy_of(m, R, motion->v, motion->w) /
                                            energy_of(m, R, impact->v, impact->w)};
  memcpy(numbers, values, sizeof values);
}

const row_kind cushion_kind = {
    .noun = "impact",
    .clue = "r2x",
    .meant = "collisions of two balls are read without --cushion; ",
    .numbers = NUMBERS,
    .results = RESULTS,
    .columns = columns,
    .defaults = defaults,
    .radius = RADIUS,
    .height = HEIGHT,
    .motion = {0, NO_NUMBER},
    .result_columns = "vx,vy,vz,wx,wy,wz",
    .name = name,
    .check = check,
    .solve = solve,
    .derived_columns = "angle_in_deg,angle_out_deg,angle_rolling_deg,rollx,rolly,energy_lost",
    .derived = DERIVED,
    .derive = derive_row,
};
