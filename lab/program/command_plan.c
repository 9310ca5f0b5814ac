/* `carom-lab plan`: how strong the planner is. Racks of eight-ball after a break that pots
 * nothing, run out from ball in hand by a player who errs; and how often shots come off beside
 * the chance that was predicted for them. */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "monotonic.h"
#include "options.h"
#include "rack_play.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 10 };

typedef struct strength_job {
  shared_options shared;
  int racks, shots, seed;
  double errors;
} strength_job;

OPTION(strength_job, option_racks, "racks", racks, 0, "N", set_count, 1,
       "racks to be played (default 100)");
OPTION(strength_job, option_shots, "shots", shots, 0, "N", set_count, 100,
       "shots of a plan (default 2000)");
OPTION(strength_job, option_errors, "errors", errors, 0, "SCALE", set_amount, 0,
       "scale of the player's errors (default 1)");
OPTION(strength_job, option_seed, "seed", seed, 0, "N", set_count, 0,
       "seed of racks, plans and strokes (default 0)");

/* A row of the comparison of chances. */
typedef struct bin {
  double predicted, variance;
  long shots, kept;
} bin;

typedef struct tally {
  long racks, wins, strokes, pots, plans;
  double seconds;
  bin bins[BINS];
} tally;

/* One rack: strokes until the turn is not kept. */
static void run_out(const strength_job *job, uint64_t number, lab_rack *rack, tally *to) {
  lab_rack_make(rack, ((uint64_t)job->seed << 32) + 7919 * (number + 1));
  carom_turn turn = {.is = CAROM_TURN_KEEP};
  for (bool hand = true; turn.is == CAROM_TURN_KEEP; hand = false) {
    carom_choice best;
    const double begin = processor_ns();
    if (!lab_rack_stroke(rack, hand, &best, &turn))
      return;
    to->seconds += 1e-9 * (processor_ns() - begin);
    to->plans++;

    /* what was predicted beside what came */
    const bool kept = turn.is == CAROM_TURN_KEEP || turn.is == CAROM_TURN_WIN;
    bin *b = &to->bins[best.keep < 1.0 ? (int)(BINS * best.keep) : BINS - 1];
    b->predicted += best.keep;
    b->variance +=
        best.keep * (1.0 - best.keep) * (1.0 + 1.0 / (double)(best.seen > 0 ? best.seen : 1));
    b->shots++;
    b->kept += kept;
    to->strokes++;
    to->pots += kept;
    to->wins += turn.is == CAROM_TURN_WIN;
  }
}

static void report(const tally *t, const strength_job *job) {
  /* Wilson's interval, 95 % */
  const double n = (double)t->racks, p = (double)t->wins / n, z = 1.96;
  const double wide = 1.0 + z * z / n, middle = (p + z * z / (2.0 * n)) / wide;
  const double half = z * sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / wide;
  printf("%d shots a plan, errors %g: run out %ld of %ld, %.1f %% (95 %%: %.1f to %.1f), pots a "
         "stroke %.3f, %.1f ms a plan\n",
         job->shots, job->errors, t->wins, t->racks, 100.0 * p, 100.0 * (middle - half),
         100.0 * (middle + half), (double)t->pots / (double)t->strokes,
         1e3 * t->seconds / (double)t->plans);
  printf("predicted,shots,kept,standard_errors\n");
  for (int k = 0; k < BINS; k++) {
    const bin *b = &t->bins[k];
    if (b->shots > 0)
      printf("%.3f,%ld,%.3f,%.1f\n", b->predicted / (double)b->shots, b->shots,
             (double)b->kept / (double)b->shots,
             ((double)b->kept - b->predicted) / sqrt(b->variance + 0.25));
  }
}

static const command_form form = {
    .name = "plan",
    .usage = "[OPTIONS]",
    .about = "Plays racks of eight-ball by plans: each is run out from ball in hand after a break "
             "that potted nothing, by a player whose strokes err. Tells how many are run out, and "
             "how often shots keep the turn beside the chance that was predicted.\n",
    .options = (const option_row *const[]){&option_racks, &option_shots, &option_errors,
                                           &option_seed, &option_threads, NULL},
    .details = "exit code: 0; 2 for bad usage\n",
    .example = "carom-lab plan --racks 100 --shots 1000",
    .files = NO_FILES,
};

int command_plan(int argc, char **argv) {
  static strength_job job;
  const char *path;
  job = (strength_job){
      .shared = {.options = {.threads = 0}}, .racks = 100, .shots = 2000, .errors = 1.0};
  const int parsed = parse_arguments(&form, argc, argv, &job, &path);
  if (parsed >= 0)
    return parsed;
  carom_table table;
  carom_table_make(CAROM_TABLE_POOLTOOL, &table);
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_player player = carom_player_of(job.errors);
  const carom_shot_options shot = {.space = CAROM_SPACE_FLAT};
  static lab_rack rack;
  rack.options = (carom_plan_options){.shots = job.shots, .threads = job.shared.options.threads};
  rack.plan = (carom_plan_job){.table = &table,
                               .cue = &cue,
                               .player = &player,
                               .shot = &shot,
                               .memory_size = carom_plan_memory(&rack.options)};
  if (rack.plan.memory_size == 0) {
    complain("--shots: it must be 100 to 1000000");
    return EXIT_USAGE;
  }
  rack.plan.memory = allocate(1, rack.plan.memory_size);
  static tally t;
  for (; t.racks < job.racks; t.racks++) {
    run_out(&job, (uint64_t)t.racks, &rack, &t);
    progress_show("racks", (double)t.racks, job.racks);
  }
  progress_clear();
  free(rack.plan.memory);
  report(&t, &job);
  return EXIT_GOOD;
}
