/* The bits of many collisions and of cushions' impacts, to be compared between platforms: a line for each result, first what
 * computed it, then its numbers as hexadecimal floats. Its input is made by whole numbers alone, so that it is the same
 * everywhere. */
#include <carom.h>
#include <carom_shot.h>
#include <stdint.h>
#include <stdio.h>

static uint64_t state = 42;

/* A number from low to high, of 32 bits: every operation is exact or rounded once. */
static double between(double low, double high) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * ((double)(state >> 32) / 4294967296.0);
}

static carom_ball ball(void) {
  carom_ball b = {.radius = 0.028575, .mass = between(0.15, 0.2), .mu_cloth = between(0.1, 0.4)};
  for (int k = 0; k < 3; k++) {
    b.v[k] = k < 2 ? between(-2.0, 2.0) : 0.0;
    b.w[k] = between(-100.0, 100.0);
  }
  return b;
}

static void show(const char *what, const double *x, int count) {
  fputs(what, stdout);
  for (int k = 0; k < count; k++)
    printf(" %a", x[k]);
  putchar('\n');
}

int main(void) {
  const carom_options euler = {.solver = CAROM_SOLVER_EULER, .steps = 200};
  for (int k = 0; k < 2000; k++) {
    carom_impact in = {.a = ball(), .b = ball(), .mu_ball = between(0.0, 0.3), .restitution = between(0.5, 1.0)};
    carom_result out;
    in.b.r[0] = between(-1.0, 1.0);
    in.b.r[1] = between(-1.0, 1.0);
    if (carom_collide(&in, NULL, &out) == CAROM_OK)
      show("exact", (const double *)&out, 12);
    if (k < 200 && carom_collide(&in, &euler, &out) == CAROM_OK)
      show("euler", (const double *)&out, 12);
    carom_cushion_impact rail = {.v = {between(-2.0, 2.0), between(0.1, 3.0), 0.0},
                                 .w = {in.a.w[0], in.a.w[1], in.a.w[2]},
                                 .normal = {0.0, 1.0},
                                 .height = 0.0365,
                                 .radius = 0.028575,
                                 .mass = 0.17,
                                 .mu_cloth = 0.2,
                                 .mu_cushion = 0.14,
                                 .restitution = 0.85};
    carom_motion after;
    if (k < 200 && carom_cushion(&rail, NULL, &after) == CAROM_OK)
      show("cushion", (const double *)&after, 6);
  }
  return 0;
}
