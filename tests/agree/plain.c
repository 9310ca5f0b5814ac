/* CAROM_ISA=plain gives the same bits on every machine and with every compiler: a hash of results over collisions that are
 * drawn by correctly rounded operations alone, so that the inputs have the same bits everywhere too. The rows are plain shots,
 * shots with friction and motion of all sizes, and rows in error; resolved alone and in batches, exactly and by Euler's steps,
 * with both slips, in both precisions.
 *
 * The golden values change only with the numerics, in the commit that says why: the test prints what it found. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 4000 };

static const struct {
  carom_solver solver;
  carom_slip slip;
  uint64_t in_double, in_single;
} golden[] = {
    {CAROM_SOLVER_EXACT, CAROM_SLIP_PAPER, 0x66224368afb92ee3u, 0x0426e6c70a7e1a45u},
    {CAROM_SOLVER_EXACT, CAROM_SLIP_POOLTOOL, 0xa0d469d3f1e4250eu, 0xdd1d4113644455d0u},
    {CAROM_SOLVER_EULER, CAROM_SLIP_PAPER, 0x6c2ba4b847180eeeu, 0xcbaed2e96524ddfcu},
    {CAROM_SOLVER_EULER, CAROM_SLIP_POOLTOOL, 0x9362d673fa9a67e8u, 0xd4854e721b8c7a4au},
};

/* A power of two between 2^low and 2^high, by products that are exact. */
static double power_of_two(random_source *source, double low, double high) {
  double x = 1.0;
  const double exponent = random_between(source, low, high);
  for (int k = 1; k <= exponent; k++)
    x *= 2.0;
  for (int k = -1; k >= exponent; k--)
    x *= 0.5;
  return x;
}

static carom_impact draw(random_source *source, size_t k) {
  const bool wild = k % 2 == 1;
  const double radius = 0.028575, x = random_between(source, -1.0, 1.0), y = random_between(source, -1.0, 1.0);
  const double length = sqrt(x * x + y * y) + 0x1p-60;
  carom_ball a = {.radius = radius, .mass = 0.17, .mu_cloth = random_between(source, 0.0, wild ? 1.0 : 0.4)}, b = a;
  b.mu_cloth = random_between(source, 0.0, wild ? 1.0 : 0.4);
  b.mass = wild ? 0.17 * power_of_two(source, -3.0, 3.0) : 0.17;
  b.r[0] = 2.0 * radius * x / length;
  b.r[1] = 2.0 * radius * y / length;
  for (int c = 0; c < 2; c++) {
    a.v[c] = random_between(source, -2.0, 2.0);
    b.v[c] = wild ? random_between(source, -2.0, 2.0) * power_of_two(source, -30.0, 2.0) : 0.0;
  }
  for (int c = 0; c < 3; c++) {
    a.w[c] = random_between(source, -100.0, 100.0) * (wild ? power_of_two(source, -30.0, 3.0) : 1.0);
    b.w[c] = wild ? random_between(source, -100.0, 100.0) : 0.0;
  }
  carom_impact in = {a, b, random_between(source, 0.0, wild ? 1.0 : 0.12), random_between(source, wild ? 0.0 : 0.8, 1.0)};
  if (k % 97 == 50)
    in.restitution = 2.0; /* a row in error */
  return in;
}

/* FNV-1a, in an order that does not depend on that of bytes in memory. NaN has many bits: only that it is NaN counts. */
static uint64_t add_to_hash(uint64_t hash, uint64_t bits) {
  for (int k = 0; k < 8; k++)
    hash = (hash ^ (bits >> 8 * k & 0xff)) * 0x100000001b3u;
  return hash;
}

static uint64_t hash_of(const double *x, size_t n, uint64_t hash) {
  for (size_t k = 0; k < n; k++) {
    uint64_t bits = 1;
    if (!isnan(x[k]))
      memcpy(&bits, &x[k], sizeof bits);
    hash = add_to_hash(hash, bits);
  }
  return hash;
}

static uint64_t hash_of_f32(const float *x, size_t n, uint64_t hash) {
  for (size_t k = 0; k < n; k++) {
    uint32_t bits = 1;
    if (!isnan(x[k]))
      memcpy(&bits, &x[k], sizeof bits);
    hash = add_to_hash(hash, bits);
  }
  return hash;
}

START_TEST(golden_hashes) {
  static const uint64_t start = 0xcbf29ce484222325u;
  carom_impact *in = malloc(ROWS * sizeof *in);
  carom_impact_f32 *in_f32 = malloc(ROWS * sizeof *in_f32);
  carom_result *out = malloc(ROWS * sizeof *out);
  carom_result_f32 *out_f32 = malloc(ROWS * sizeof *out_f32);
  int8_t *status = malloc(ROWS);
  random_source source = {1};
  int differ = 0;
  for (size_t k = 0; k < ROWS; k++) {
    in[k] = draw(&source, k);
    for (int c = 0; c < 26; c++)
      ((float *)&in_f32[k])[c] = (float)((const double *)&in[k])[c];
  }
  ck_assert_int_eq(carom_isa_limit(CAROM_ISA_PLAIN), CAROM_ISA_PLAIN);
  for (size_t way = 0; way < sizeof golden / sizeof golden[0]; way++) {
    const carom_options options = {.solver = golden[way].solver, .slip = golden[way].slip, .steps = 100};
    carom_collide_batch(in, ROWS, &options, out, status);
    uint64_t in_double = hash_of((const double *)out, ROWS * 12, start);
    for (size_t k = 0; k < ROWS; k++)
      in_double = add_to_hash(in_double, (uint64_t)(uint8_t)status[k]);
    carom_collide_batch_f32(in_f32, ROWS, &options, out_f32, status);
    const uint64_t in_single = hash_of_f32((const float *)out_f32, ROWS * 12, start);
    printf("%s, slip %s: double 0x%016llxu, single 0x%016llxu\n", carom_solver_name(options.solver),
           carom_slip_name(options.slip), (unsigned long long)in_double, (unsigned long long)in_single);
    fflush(stdout);
    differ += in_double != golden[way].in_double || in_single != golden[way].in_single;
  }
  ck_assert_int_eq(differ, 0);
  free(in), free(in_f32), free(out), free(out_f32), free(status);
}
END_TEST

int main(void) {
  return RUN_TESTS("plain", golden_hashes);
}
