/* Matches of two rated players: the share that the first one wins, beside the share that is due,
 * 1/(1 + 2^((d - r)/100)) of a player of rating r against one of rating d. Both play as
 * carom_match_plan() lets the seat of a rating play. They break in turn, and match k has seeds of
 * its own, so that no result depends on the number of threads. */
#include "rated_match.h"

#include "platform/threads.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/monotonic.h"
#include "random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BLOCK = 16, STROKES_MOST = 20000 };

void lab_interval(double wins, double count, double bounds[2]) {
  static const double z = 1.96;
  const double share = wins / count, wide = 1.0 + z * z / count;
  const double middle = (share + z * z / (2.0 * count)) / wide;
  const double variance = share * (1.0 - share) / count + z * z / (4.0 * count * count);
  const double half = z * sqrt(variance) / wide;
  bounds[0] = middle - half;
  bounds[1] = middle + half;
}

typedef struct played_match {
  double won; /* by the first player: 1, 0, or 0.5 of a draw */
  long strokes;
  bool failed, ended;
} played_match;

typedef struct block {
  const lab_ratings *wanted;
  int first;
  played_match matches[BLOCK];
} block;

/* One stroke of the seat at the table, as its plan proposes it. */
static bool play_stroke(carom_match *match, carom_plan_job *job, carom_plan_options *options,
                        const carom_player *opponent, uint64_t seed) {
  carom_plan_stroke best;
  int found;
  options->seed = seed;
  options->opponent = opponent;
  job->options = options;
  job->player = NULL;
  job->cue = NULL;
  carom_status status = carom_match_plan(match, job, &best, 1, &found);
  const int seat = match->seat;
  if (status == CAROM_OK)
    status = carom_match_prepare(match, seat, &best);
  if (status != CAROM_OK || best.kind == CAROM_PLAN_PASS)
    return status == CAROM_OK;
  carom_player_strike(&match->player, seed, 0, &best.cue);
  return carom_match_stroke(match, seat, &best.cue, NULL, NULL) == CAROM_OK;
}

static void play(const lab_ratings *wanted, int number, played_match *result) {
  carom_table table;
  carom_table_make((carom_table_kind)carom_rules_about_of(wanted->rules)->table, &table);
  lab_random draw = {((uint64_t)wanted->seed << 32) + 104729 * ((uint64_t)number + 1)};
  carom_seating seating;
  carom_seating_make(wanted->rules, 2, &seating);
  carom_player player[2];
  for (int seat = 0; seat < 2; seat++) {
    seating.seat[seat].rating = wanted->rating[seat];
    player[seat] = carom_player_rated(wanted->rating[seat], wanted->rules);
  }
  const carom_match_setup setup = {.rules = wanted->rules,
                                   .table = &table,
                                   .target = wanted->target,
                                   .side = number % 2,
                                   .seed = lab_bits(&draw),
                                   .seating = &seating};

  /* the match, and room for the plans of both */
  carom_match *match = allocate(1, sizeof *match);
  carom_plan_options options = {0};
  carom_plan_job job = {.memory_size = carom_plan_memory(&options)};
  job.memory = allocate(1, job.memory_size);
  *result = (played_match){.failed = carom_match_begin_with(match, &setup) != CAROM_OK};
  while (!result->failed && match->phase != CAROM_MATCH_OVER && result->strokes < STROKES_MOST) {
    const carom_player *opponent = &player[1 - match->seat];
    result->failed = !play_stroke(match, &job, &options, opponent, lab_bits(&draw));
    result->strokes++;
  }

  /* who has won */
  result->ended = match->phase == CAROM_MATCH_OVER;
  result->won = 0.5;
  if (match->winner == 1 || match->winner == 2)
    result->won = match->winner == 1;
  if (result->failed)
    complain("match %d: %s", number, match->fault);
  free(job.memory);
  free(match);
}

static size_t play_some(const void *context, size_t start, size_t end) {
  block *b = *(block *const *)context;
  for (size_t k = start; k < end; k++)
    play(b->wanted, b->first + (int)k, &b->matches[k]);
  return end;
}

bool lab_play_ratings(const lab_ratings *wanted) {
  const double begin = processor_ns();
  double won = 0.0;
  long strokes = 0, unfinished = 0;
  block here = {.wanted = wanted}, *b = &here;
  for (; b->first < wanted->matches; b->first += BLOCK) {
    int count = wanted->matches - b->first;
    if (count > BLOCK)
      count = BLOCK;
    carom_in_threads(play_some, &b, (size_t)count, wanted->threads, 1);
    for (int k = 0; k < count; k++) {
      if (b->matches[k].failed)
        return false;
      won += b->matches[k].won;
      strokes += b->matches[k].strokes;
      unfinished += !b->matches[k].ended;
    }
    progress_show("matches", b->first + count, wanted->matches);
  }
  progress_clear();

  /* the share of the first player, and what is due */
  const double count = wanted->matches, *rating = wanted->rating;
  const double due = 1.0 / (1.0 + exp2(0.01 * (rating[1] - rating[0])));
  double bounds[2];
  lab_interval(won, count, bounds);
  printf("%s: %g beats %g in %g of %g matches, %.1f %% (95 %%: %.1f to %.1f), due %.1f %%; "
         "unfinished %ld; %.1f strokes and %.2f s a match\n",
         carom_word(CAROM_WORDS_RULES, (int)wanted->rules), rating[0], rating[1], won, count,
         100.0 * won / count, 100.0 * bounds[0], 100.0 * bounds[1], 100.0 * due, unfinished,
         (double)strokes / count, 1e-9 * (processor_ns() - begin) / count);
  return true;
}
