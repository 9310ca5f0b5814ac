/* `carom-lab stress --cushion` and `--coincidences`: single impacts by single calls, a table with a line for each kind.
 *
 * Calls are judged by the precise solver with the tolerance of two balls; and where that refuses or differs by more than
 * REFERENCE_FROM, and in 1 row of 1000 (of coincidences: 20), by the reference of lab/stress. */
#include "stress_impacts.h"

#include "accuracy.h"
#include "coincidences.h"
#include "draws.h"
#include "memory.h"
#include "number.h"
#include "precisely.h"
#include "reference.h"
#include "stress_tally.h"

#include <math.h>
#include <stdlib.h>

enum { KINDS_MOST = 32, BLOCK = 50 };
static const double REFERENCE_FROM = 1e-7;

typedef struct shift {
  bool coincidences;
  int kinds;
  uint64_t draws, seed;
  stress_tally tally[KINDS_MOST];
  long asked, precise_wrong; /* rows that the reference judged; of these, the precise solver off by more than 1e-8 */
  double precise_largest;
} shift;

static coincidence draw(const shift *w, int kind, uint64_t k) {
  if (w->coincidences)
    return coincidence_draw(kind, w->seed, k);
  return (coincidence){.cushion = true, .of_play = kind == CUSHION_PLAY, .rail = draw_cushion((cushion_draw)kind, w->seed, k)};
}

/* A motion of one ball or of two. */
typedef union outcome {
  carom_motion rail;
  carom_result balls;
} outcome;

static double apart(const coincidence *c, const outcome *a, const outcome *b) {
  return c->cushion ? cushion_distance(&c->rail, &a->rail, &b->rail)
                    : accuracy_of(&a->balls, &b->balls, c->balls.a.radius).pair;
}

static carom_status call(const coincidence *c, outcome *out) {
  const carom_options options = {.slip = c->slip};
  return c->cushion ? carom_cushion(&c->rail, NULL, &out->rail) : carom_collide(&c->balls, &options, &out->balls);
}

static void judge(shift *w, int kind, uint64_t k) {
  stress_tally *t = &w->tally[kind];
  const coincidence c = draw(w, kind, k);
  outcome own, precise, exact;
  const carom_status status = call(&c, &own);
  t->unresolved += status == CAROM_ERROR_UNRESOLVED;
  t->refused += status < 0 && status != CAROM_ERROR_UNRESOLVED;
  if (status != CAROM_OK)
    return;
  const bool known = CAROM_OK == (c.cushion ? cushion_precisely(&c.rail, PRECISELY, &precise.rail)
                                            : collide_precisely(&c.balls, c.slip, PRECISELY, &precise.balls));
  double error = known ? apart(&c, &own, &precise) : INFINITY;
  if (error > REFERENCE_FROM || k % (w->coincidences ? 20 : 1000) == 0) {
    const reference_status judged =
        c.cushion ? reference_cushion(&c.rail, &exact.rail, NULL) : reference_collide(&c.balls, c.slip, &exact.balls, NULL);
    if (judged != REFERENCE_OK) {
      t->unjudged++;
      return;
    }
    error = apart(&c, &own, &exact);
    w->asked++;
    if (known) {
      const double wrong = apart(&c, &precise, &exact);
      w->precise_largest = fmax(w->precise_largest, wrong);
      w->precise_wrong += wrong > 1e-8;
    }
  }
  stress_count(t, error, c.of_play, k);
}

static void run_block(void *of, uint64_t block) {
  shift *w = of;
  const int kind = (int)(block % (uint64_t)w->kinds);
  const uint64_t first = block / (uint64_t)w->kinds * BLOCK;
  for (uint64_t k = first; k < first + BLOCK && k < w->draws; k++)
    judge(w, kind, k);
}

/* The numbers of an impact, in the order of its struct. */
static void print_worst(const shift *w, int kind, FILE *out) {
  const stress_tally *t = &w->tally[kind];
  const coincidence c = draw(w, kind, t->worst);
  const double *const number = c.cushion ? (const double *)&c.rail : (const double *)&c.balls;
  char text[NUMBER_TEXT];
  fprintf(out, "%s, %s %llu, %.2g of its bound: ", c.cushion ? "cushion" : carom_slip_name(c.slip),
          w->coincidences        ? coincidence_name(kind)
          : kind == CUSHION_PLAY ? "play"
                                 : "any",
          (unsigned long long)t->worst, t->worst_share);
  for (int k = 0; k < (c.cushion ? 15 : 26); k++)
    fprintf(out, "%s%s", k > 0 ? "," : "", number_text(number[k], text));
  fputc('\n', out);
}

bool stress_impacts(FILE *out, bool coincidences, int draws, uint64_t seed, int threads) {
  shift *shifts = allocate((size_t)threads, sizeof *shifts);
  for (int t = 0; t < threads; t++) {
    shifts[t].coincidences = coincidences;
    shifts[t].kinds = coincidences ? coincidence_kinds() : (int)CUSHION_DRAWS;
    shifts[t].draws = (uint64_t)draws;
    shifts[t].seed = seed;
  }
  shift *all = &shifts[0];
  stress_in_threads(threads, shifts, sizeof *shifts, (uint64_t)all->kinds * (((uint64_t)draws + BLOCK - 1) / BLOCK), run_block,
                    "blocks of impacts");
  for (int t = 1; t < threads; t++) {
    for (int kind = 0; kind < all->kinds; kind++)
      stress_add(&all->tally[kind], &shifts[t].tally[kind]);
    all->asked += shifts[t].asked;
    all->precise_wrong += shifts[t].precise_wrong;
    all->precise_largest = fmax(all->precise_largest, shifts[t].precise_largest);
  }
  bool good = true;
  fprintf(out, "%s, %d drawn of each kind with seed %llu, instruction set %s\n\n",
          coincidences ? "coincidences" : "impacts on a cushion", draws, (unsigned long long)seed,
          carom_isa_name(carom_isa_in_force()));
  stress_print_head(out, "impact", "kind");
  for (int kind = 0; kind < all->kinds; kind++) {
    const bool cushion = !coincidences || coincidence_of_cushion(kind);
    stress_print(out, cushion ? "cushion" : "balls",
                 coincidences           ? coincidence_name(kind)
                 : kind == CUSHION_PLAY ? "play"
                                        : "any",
                 &all->tally[kind]);
    good &= stress_holds(&all->tally[kind]);
  }
  fprintf(out,
          "\nprecise solver against the reference, where calls differ from it by more than %g, and 1 row in %d: %ld rows, "
          "largest error %.1e, %ld above 1e-8\n",
          REFERENCE_FROM, coincidences ? 20 : 1000, all->asked, all->precise_largest, all->precise_wrong);
  fputs("\nlargest errors:\n", out);
  for (int kind = 0; kind < all->kinds; kind++)
    if (all->tally[kind].rows > 0)
      print_worst(all, kind, out);
  free(shifts);
  return good;
}
