/* `carom-lab stress`: the exact solver on random collisions, in every way it can be called, against the integrator behind it.
 *
 * Each collision is solved by a single call and in a batch, in double and in single precision, and by the fallback alone, whose
 * own error is about 1e-9 at most: where it and a single call differ by more than REFERENCE_FROM, and for 1 row in
 * 1000, the reference of lab/stress decides.
 * Rows of batches are compared with single calls bit by bit. */
#include "accuracy.h"
#include "command.h"
#include "draws.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "options.h"
#include "output.h"
#include "precisely.h"
#include "reference.h"
#include "stress_impacts.h"
#include "stress_shots.h"
#include "stress_tally.h"
#include "subcommands.h"

#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/reduced.h"
#include "enumerations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  BLOCK = 1000, /* collisions that a thread draws and solves at a time */
  WORST = 20,   /* rows that are kept */
};
static const double REFERENCE_FROM = 1e-7;

typedef struct worst_row {
  double error, fallback_error; /* against the reference where that was asked, else against the fallback; NAN */
  carom_slip slip;
  uint64_t k;
} worst_row;

enum { WAY_DOUBLE, WAY_SINGLE, WAYS };

typedef struct stress_job {
  shared_options shared;
  int draws, seed, kind;
  int shots, models, cushion; /* whole shots instead */
  int cushions, coincidences; /* or these impacts */
  bool worst_rows;
} stress_job;

typedef struct shift {
  const stress_job *job;
  stress_tally tally[CAROM_SLIP_COUNT][WAYS];
  long other_bits; /* rows of batches that differ from single calls */
  long asked, fallback_wrong;
  double fallback_largest; /* error against the reference */
  worst_row worst[WORST];
  /* a block */
  carom_impact in[BLOCK];
  carom_impact_f32 in32[BLOCK];
  carom_result out[BLOCK], exact[BLOCK];
  carom_result_f32 out32[BLOCK];
  int8_t status[BLOCK], status32[BLOCK];
} shift;

static void keep_worst(shift *w, worst_row row) {
  int least = 0;
  for (int k = 1; k < WORST; k++)
    if (w->worst[k].error < w->worst[least].error)
      least = k;
  if (row.error > w->worst[least].error)
    w->worst[least] = row;
}

static double distance(const carom_result *a, const carom_result *b, double radius) {
  return accuracy_of(a, b, radius).pair;
}

/* Whether a result is not there to be judged, which is counted. */
static bool is_error(stress_tally *t, carom_status status) {
  t->unresolved += status == CAROM_ERROR_UNRESOLVED;
  t->refused += status < 0 && status != CAROM_ERROR_UNRESOLVED;
  return status != CAROM_OK;
}

/* One collision in double precision; its exact result becomes *exact. */
static void count_double(shift *w, carom_slip slip, uint64_t k, const carom_impact *in, const carom_result *out,
                         carom_status status, carom_result *exact) {
  stress_tally *t = &w->tally[slip][WAY_DOUBLE];
  carom_result unused;
  if (status == CAROM_SEPARATING)
    return;
  t->by_fallback += carom_kernels_in_force()->call[CAROM_F64](in, carom_spin_sign(slip), &unused, NULL) <= 0;
  if (is_error(t, status))
    return;
  const bool known = collide_precisely(in, slip, PRECISELY, exact) == CAROM_OK;
  worst_row row = {.error = known ? distance(out, exact, in->a.radius) : INFINITY, .fallback_error = NAN, .slip = slip, .k = k};
  if (row.error > REFERENCE_FROM || k % 1000 == 0) {
    carom_result reference;
    if (reference_collide(in, slip, &reference, NULL) == REFERENCE_OK) {
      row.error = distance(out, &reference, in->a.radius);
      row.fallback_error = known ? distance(exact, &reference, in->a.radius) : INFINITY;
      w->asked++;
      w->fallback_wrong += known && row.fallback_error > 1e-9;
      w->fallback_largest = fmax(w->fallback_largest, known ? row.fallback_error : 0);
    } else if (row.error > REFERENCE_FROM) {
      t->unjudged++;
      return;
    }
  }
  stress_count(t, row.error, w->job->kind == DRAW_REALISTIC, k);
  keep_worst(w, row);
}

/* The same row in single precision, against the exact result for the rounded numbers. */
static void count_single(shift *w, carom_slip slip, const carom_impact_f32 *in, const carom_result_f32 *out,
                         carom_status status) {
  stress_tally *t = &w->tally[slip][WAY_SINGLE];
  carom_impact wide;
  carom_result result, exact;
  carom_result_f32 unused;
  if (status == CAROM_SEPARATING)
    return;
  for (int k = 0; k < 26; k++)
    ((double *)&wide)[k] = ((const float *)in)[k];
  for (int k = 0; k < 12; k++)
    ((double *)&result)[k] = ((const float *)out)[k];
  t->by_fallback += carom_kernels_in_force()->call[CAROM_F32](in, carom_spin_sign(slip), &unused, NULL) == 0;
  if (is_error(t, status))
    return;
  if (collide_precisely(&wide, slip, PRECISELY, &exact) == CAROM_OK)
    stress_count(t, distance(&result, &exact, wide.a.radius), false, 0);
  else
    t->unjudged++;
}

static void run_block(void *of, uint64_t block) {
  shift *w = of;
  const stress_job *job = w->job;
  const carom_slip slip = (carom_slip)(block % CAROM_SLIP_COUNT);
  const uint64_t first = block / CAROM_SLIP_COUNT * BLOCK;
  carom_options options = {0};
  options.slip = slip;
  options.threads = 1;
  size_t n = 0;
  for (; n < BLOCK && first + n < (uint64_t)job->draws; n++) {
    w->in[n] = draw_collision((draw_kind)job->kind, slip, (uint64_t)job->seed, first + n);
    for (int k = 0; k < 26; k++)
      ((float *)&w->in32[n])[k] = (float)((const double *)&w->in[n])[k];
  }
  carom_collide_batch(w->in, n, &options, w->out, w->status);
  carom_collide_batch_f32(w->in32, n, &options, w->out32, w->status32);
  for (size_t k = 0; k < n; k++) {
    carom_result alone;
    carom_result_f32 alone32;
    const carom_status status = carom_collide(&w->in[k], &options, &alone);
    const carom_status status32 = carom_collide_f32(&w->in32[k], &options, &alone32);
    w->other_bits += status != w->status[k] || memcmp(&alone, &w->out[k], sizeof alone) != 0;
    w->other_bits += status32 != w->status32[k] || memcmp(&alone32, &w->out32[k], sizeof alone32) != 0;
    count_double(w, slip, first + k, &w->in[k], &alone, status, &w->exact[k]);
    count_single(w, slip, &w->in32[k], &alone32, status32);
  }
}

static void add(shift *to, const shift *from) {
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
    for (int way = 0; way < WAYS; way++)
      stress_add(&to->tally[slip][way], &from->tally[slip][way]);
  to->other_bits += from->other_bits;
  to->asked += from->asked;
  to->fallback_wrong += from->fallback_wrong;
  to->fallback_largest = fmax(to->fallback_largest, from->fallback_largest);
  for (int k = 0; k < WORST; k++)
    keep_worst(to, from->worst[k]);
}

static int descending(const void *a, const void *b) {
  const double x = ((const worst_row *)a)->error, y = ((const worst_row *)b)->error;
  return (x < y) - (x > y);
}

/* Rows that `carom resolve` reads. */
static void print_worst(const stress_job *job, shift *w, FILE *out) {
  fputs("id,r1x,r1y,r1z,v1x,v1y,v1z,w1x,w1y,w1z,R1,M1,u_s1,r2x,r2y,r2z,v2x,v2y,v2z,w2x,w2y,w2z,R2,M2,u_s2,u_b,e_b,slip,error,"
        "fallback_error\n",
        out);
  qsort(w->worst, WORST, sizeof w->worst[0], descending);
  for (int k = 0; k < WORST && w->worst[k].error > 0; k++) {
    const worst_row *row = &w->worst[k];
    const carom_impact in = draw_collision((draw_kind)job->kind, row->slip, (uint64_t)job->seed, row->k);
    char text[NUMBER_TEXT];
    fprintf(out, "%s-%llu", carom_slip_name(row->slip), (unsigned long long)row->k);
    for (int c = 0; c < 26; c++)
      fprintf(out, ",%s", number_text(((const double *)&in)[c], text));
    fprintf(out, ",%s,%.3g,%.3g\n", carom_slip_name(row->slip), row->error, row->fallback_error);
  }
}

static void print_table(const stress_job *job, const shift *w, FILE *out) {
  static const char *const ways[] = {"double", "single"}, *const kinds[] = {"realistic", "regimes", "extreme"};
  fprintf(out, "%s collisions, %d drawn for each slip with seed %d, instruction set %s\n\n", kinds[job->kind], job->draws,
          job->seed, carom_isa_name(carom_isa_in_force()));
  stress_print_head(out, "precision", "slip");
  for (int way = 0; way < WAYS; way++)
    for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++)
      stress_print(out, ways[way], carom_slip_name((carom_slip)slip), &w->tally[slip][way]);
  fprintf(out, "\nrows of batches whose bits or status differ from single calls: %ld\n", w->other_bits);
  fprintf(out,
          "fallback against the reference, where single calls differ from it by more than %g, and 1 row in 1000: %ld rows, "
          "largest error %.1e, %ld above 1e-9\n",
          REFERENCE_FROM, w->asked, w->fallback_largest, w->fallback_wrong);
}

/* The contract of carom.h. */
static bool holds(const stress_job *job, const shift *w) {
  bool good = w->other_bits == 0;
  for (int slip = 0; slip < CAROM_SLIP_COUNT; slip++) {
    const stress_tally *t = &w->tally[slip][WAY_DOUBLE];
    good &= stress_holds(t) && (job->kind != DRAW_REALISTIC || stress_quantile(t, 0.5) <= 3e-9);
    good &= w->tally[slip][WAY_SINGLE].over_2e5 == 0 || job->kind != DRAW_REALISTIC;
  }
  return good;
}

OPTION(stress_job, option_draws, "draws", draws, 'n', "N", set_count, 1, "collisions to draw, for each slip (default: 100000)");
OPTION(stress_job, option_seed, "seed", seed, 0, "S", set_count, 0, "of the draws (default: 1)");
OPTION(stress_job, option_kind, "kind", kind, 0, DRAW_KIND_NAMES, set_choice, 0,
       "what to draw: collisions of play; the regimes of the tests, corners of all sorts; or\n"
       "everything that is accepted (default: realistic)");
OPTION(stress_job, option_worst, "worst", worst_rows, 0, NULL, set_flag, 0,
       "print, instead of the table, the 20 collisions with the largest errors in double precision,\n"
       "as rows that `carom resolve` reads");

OPTION(stress_job, option_cushions, "cushion", cushions, 0, "N", set_count, 1,
       "draw so many impacts on a cushion of each kind instead, of play and any");
OPTION(stress_job, option_coincidences, "coincidences", coincidences, 0, "N", set_count, 1,
       "draw instead so many impacts of each kind of coincidence, of two balls and on a cushion: numbers that\n"
       "are exactly equal, zero or at the edge of a cone, planar motion, slips of rounding errors, grazing");
OPTION(stress_job, option_shots, "shots", shots, 0, "N", set_count, 1,
       "play so many random whole shots instead, and check the invariants that they keep");
OPTION(stress_job, option_models, "models", models, 0, "carom|pooltool", set_choice, 0,
       "whose rules and models the shots follow");
OPTION(stress_job, option_cushion_model, "cushion-model", cushion, 0, "MODEL", set_cushion_model, 0,
       "impacts on cushions in the shots: mathavan, stronge, han, mirror or euler");

static const command_form form = {
    .name = "stress",
    .usage = "[OPTIONS]",
    .about =
        "Draws random collisions and compares the exact solver's results, by single calls and in batches, in double and in\n"
        "single precision, with the precise solver, and where they differ with a reference in extended precision.\n",
    .options = (const option_row *const[]){&option_draws, &option_seed, &option_kind, &option_worst, &option_cushions,
                                           &option_coincidences, &option_shots, &option_models, &option_cushion_model,
                                           &option_threads, &option_output, NULL},
    .details = "exit code: 0; 1 if an error is larger than carom.h promises, or bits of a batch differ from a single call's;\n"
               "           2 for bad usage\n",
    .example = "carom-lab stress --draws 10000 --kind regimes",
};

int command_stress(int argc, char **argv) {
  stress_job job = {.shared = {.options = COMMAND_OPTIONS, .output = "-"}, .draws = 100000, .seed = 1};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  if (job.shots > 0)
    return stress_shots(job.shots, (uint64_t)job.seed, job.models, job.cushion);
  FILE *out = output_open(job.shared.output);
  if (out == NULL)
    return EXIT_USAGE;
  const int threads = stress_threads(job.shared.options.threads);
  if (job.cushions > 0 || job.coincidences > 0) {
    const bool held = stress_impacts(out, job.coincidences > 0, job.coincidences > 0 ? job.coincidences : job.cushions,
                                     (uint64_t)job.seed, threads);
    return !output_commit() ? EXIT_USAGE : held ? EXIT_GOOD : EXIT_SOME;
  }
  shift *shifts = allocate((size_t)threads, sizeof *shifts);
  for (int t = 0; t < threads; t++)
    shifts[t].job = &job;
  stress_in_threads(threads, shifts, sizeof *shifts, (uint64_t)CAROM_SLIP_COUNT * (((uint64_t)job.draws + BLOCK - 1) / BLOCK),
                    run_block, "blocks of collisions");
  for (int t = 1; t < threads; t++)
    add(&shifts[0], &shifts[t]);
  if (job.worst_rows)
    print_worst(&job, &shifts[0], out);
  else
    print_table(&job, &shifts[0], out);
  const bool good = holds(&job, &shifts[0]);
  free(shifts);
  return !output_commit() ? EXIT_USAGE : good ? EXIT_GOOD : EXIT_SOME;
}
