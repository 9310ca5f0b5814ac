/* Matches of two rated players: the share that the first one wins, compared with the share that is
 * due, 1/(1 + 2^((d - r)/100)) of a player of rating r against one of rating d. Both play as
 * carom_match_plan() lets the seat of a rating play. They break alternately, and match k has its
 * own seeds, so that no result depends on the number of threads. */
#include "rated_match.h"

#include "comparison.h"
#include "eye.h"
#include "platform/threads.h"
#include "player.h"
#include "pot_kind.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/monotonic.h"
#include "random.h"
#include "random_draws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BLOCK = 16, STROKES_MOST = 20000 };

/* What plans predict of a stroke. */
enum { KEEP, FOUL, LOSE, WIN, CHANCES };

void lab_interval(double wins, double count, double bounds[2]) {
  static const double z = 1.96;
  const double share = wins / count, wide = 1.0 + z * z / count;
  const double middle = (share + z * z / (2.0 * count)) / wide;
  const double variance = share * (1.0 - share) / count + z * z / (4.0 * count * count);
  const double half = z * sqrt(variance) / wide;
  bounds[0] = middle - half;
  bounds[1] = middle + half;
}

/* A stroke of a match: the side that played it, and its chances compared with the result. */
typedef struct told_stroke {
  int side, kind;
  double forecast[CHANCES], came[CHANCES];
} told_stroke;

typedef struct played_match {
  told_stroke *forecast;
  size_t count, room;
  double won; /* by the first player: 1, 0, or 0.5 of a draw */
  long strokes;
  bool failed, ended;
} played_match;

typedef struct block {
  const lab_ratings *request;
  int first;
  played_match matches[BLOCK];
} block;

/* Moves the balls in play to where they may lie for a player who sees them where they are. */
static void draw_places(carom_match *match, const carom_player *player, uint64_t seed) {
  carom_record *record = &match->record;
  carom_shot_ball balls[CAROM_BALLS_MOST];
  int ball[CAROM_BALLS_MOST], count = 0, struck = 0, where;
  for (int k = 0; k < (int)record->count; k++) {
    if (record->balls[k].state.label == CAROM_BALL_POCKETED ||
        record->balls[k].state.label == CAROM_BALL_OFF)
      continue;
    if (k == match->cue_ball)
      struck = count;
    ball[count] = k;
    balls[count++] = record->balls[k];
  }
  carom_features features;
  carom_prepared layout;
  carom_ball_state drawn[CAROM_BALLS_MOST];
  if (carom_prepare(&record->table, balls, count, &record->options, &features, &layout, &where) !=
      CAROM_OK)
    return;
  const double eye = carom_player_bounded(player, &match->cue).eye;
  carom_eye_draw(&layout, struck, eye, seed, DRAW_PLAYED, 0, drawn);
  for (int k = 0; k < count; k++)
    record->balls[ball[k]].state = drawn[k];
}

/* Adds a stroke that was ruled: its player, the balls that were on, and what was predicted. */
static void keep_stroke(const carom_match *match, int side, uint32_t on,
                        const carom_plan_stroke *choice, played_match *result) {
  const carom_turn *turn = &match->ruling.turn;
  result->forecast =
      grow(result->forecast, &result->room, result->count + 1, sizeof *result->forecast);
  bool keeps = turn->outcome != CAROM_TURN_PASS && turn->outcome != CAROM_TURN_LOSE;
  if (match->rules.race == CAROM_RACE_SEATS && turn->outcome == CAROM_TURN_PASS)
    keeps = turn->foul == 0 && (match->ruling.facts.down & on) != 0;
  result->forecast[result->count++] =
      (told_stroke){.side = side,
                    .kind = choice->kind,
                    .forecast = {choice->keep, choice->foul, choice->lose, choice->value},
                    .came = {(double)keeps, (double)(turn->foul != 0),
                             (double)(turn->outcome == CAROM_TURN_LOSE)}};
}

/* One stroke of the seat at the table, as its plan proposes it; `player`: a player in its place,
 * whose strokes the result lists, or NULL. */
static bool play_stroke(carom_match *match, carom_plan_job *job, carom_plan_options *options,
                        const carom_player *player, uint64_t seed, played_match *result) {
  carom_plan_stroke best;
  int found;
  options->seed = seed;
  job->options = options;
  job->player = player;
  job->cue = NULL;
  carom_status status = carom_match_plan(match, job, &best, 1, &found);
  const int seat = match->seat, side = (int)match->seating.seat[seat].side;
  const uint32_t on = match->on;
  if (status == CAROM_OK)
    status = carom_match_prepare(match, seat, &best);
  if (status != CAROM_OK || best.kind == CAROM_PLAN_PASS)
    return status == CAROM_OK;
  const carom_player *striker = player != NULL ? player : &match->player;
  carom_player_strike(striker, seed, 0, &best.cue);
  if (player != NULL)
    draw_places(match, player, seed);
  status = carom_match_stroke(match, seat, &best.cue, NULL, NULL);
  if (status == CAROM_OK && player != NULL)
    keep_stroke(match, side, on, &best, result);
  return status == CAROM_OK;
}

static void play(const lab_ratings *request, int number, played_match *result) {
  carom_table table;
  carom_table_make((carom_table_kind)carom_rules_about_of(request->rules)->table, &table);
  lab_random draw = {((uint64_t)request->seed << 32) + 104729 * ((uint64_t)number + 1)};
  carom_seating seating;
  const bool tells = request->shots > 0;
  carom_seating_make(request->rules, tells ? 0 : 2, &seating);
  carom_player player[CAROM_SEATS_MOST];
  for (int seat = 0; seat < seating.count; seat++) {
    const double rating = request->rating[seat % 2];
    seating.seat[seat].rating = rating;
    player[seat] = carom_player_rated(rating, request->rules);
    if (tells)
      player[seat].only_pots = 0.0;
  }
  const carom_match_setup setup = {.rules = request->rules,
                                   .table = &table,
                                   .target = request->target,
                                   .side = number % 2,
                                   .seed = lab_bits(&draw),
                                   .seating = &seating};

  /* the match, and room for the plans of both */
  carom_match *match = allocate(1, sizeof *match);
  carom_plan_options options = {.shots = request->shots};
  carom_plan_job job = {.memory_size = carom_plan_memory(&options)};
  job.memory = allocate(1, job.memory_size);
  *result = (played_match){.failed = carom_match_begin_with(match, &setup) != CAROM_OK};
  while (!result->failed && match->phase != CAROM_MATCH_OVER && result->strokes < STROKES_MOST) {
    options.opponent = &player[(match->seat + 1) % seating.count];
    const carom_player *striker = tells ? &player[match->seat] : NULL;
    result->failed = !play_stroke(match, &job, &options, striker, lab_bits(&draw), result);
    result->strokes++;
  }

  /* who has won */
  result->ended = match->phase == CAROM_MATCH_OVER;
  result->won = 0.5;
  if (match->winner == 1 || match->winner == 2)
    result->won = match->winner == 1;
  for (size_t k = 0; k < result->count; k++) {
    result->forecast[k].came[WIN] = match->winner == 1 + result->forecast[k].side;
    if (match->winner == CAROM_DRAWN)
      result->forecast[k].came[WIN] = 0.5;
  }
  if (result->failed)
    complain("match %d: %s", number, match->fault);
  free(job.memory);
  free(match);
}

static size_t play_some(const void *context, size_t start, size_t end) {
  block *b = *(block *const *)context;
  for (size_t k = start; k < end; k++)
    play(b->request, b->first + (int)k, &b->matches[k]);
  return end;
}

/* Plays the next block of matches. Returns how many they are; 0: there is none, or one failed. */
static int play_block(block *b) {
  int count = b->request->matches - b->first;
  if (count > BLOCK)
    count = BLOCK;
  carom_in_threads(play_some, &b, (size_t)count, b->request->threads, 1);
  b->first += count;
  progress_show("matches", b->first, b->request->matches);
  for (int k = 0; k < count; k++)
    if (b->matches[k].failed)
      return 0;
  return count;
}

bool lab_play_ratings(const lab_ratings *request) {
  const double begin = processor_ns();
  double won = 0.0;
  long strokes = 0, unfinished = 0;
  block b = {.request = request};
  while (b.first < request->matches) {
    const int count = play_block(&b);
    if (count == 0)
      return false;
    for (int k = 0; k < count; k++) {
      won += b.matches[k].won;
      strokes += b.matches[k].strokes;
      unfinished += !b.matches[k].ended;
    }
  }
  progress_clear();

  /* the fraction of the first player, and what is due */
  const double count = request->matches, *rating = request->rating;
  const double due = 1.0 / (1.0 + exp2(0.01 * (rating[1] - rating[0])));
  double bounds[2];
  lab_interval(won, count, bounds);
  printf("%s: %g beats %g in %g of %g matches, %.1f %% (95 %%: %.1f to %.1f), due %.1f %%; "
         "unfinished %ld; %.1f strokes and %.2f s a match\n",
         carom_word(CAROM_WORDS_RULES, (int)request->rules), rating[0], rating[1], won, count,
         100.0 * won / count, 100.0 * bounds[0], 100.0 * bounds[1], 100.0 * due, unfinished,
         (double)strokes / count, 1e-9 * (processor_ns() - begin) / count);
  return true;
}

/* A row of CSV for each chance of a kind of stroke; kind CAROM_PLAN_KINDS: of all strokes. */
static void print_told(const lab_ratings *request, int kind, const lab_comparison rows[CHANCES]) {
  static const char *const chances[CHANCES] = {"keep", "foul", "lose", "win"};
  const char *name = "all";
  if (kind < CAROM_PLAN_KINDS)
    name = carom_word_text(CAROM_WORDS_PLAN_KIND, kind);
  const bool is_alone = carom_plan_rules_of(request->rules).race == CAROM_RACE_ALONE;
  const int chances_told = is_alone ? WIN : CHANCES; /* a single player plays for points */
  for (int k = 0; k < chances_told && rows[k].strokes > 0; k++) {
    const double n = (double)rows[k].strokes;
    printf("%s,%s,%s,%ld,%.3f,%.3f,%+.3f,%.3f\n",
           carom_word(CAROM_WORDS_RULES, (int)request->rules), name, chances[k], rows[k].strokes,
           rows[k].predicted / n, rows[k].came / n, (rows[k].predicted - rows[k].came) / n,
           lab_compare_error(&rows[k]));
  }
}

bool lab_play_told(const lab_ratings *request) {
  lab_comparison rows[CAROM_PLAN_KINDS + 1][CHANCES] = {0};
  block b = {.request = request};
  while (b.first < request->matches) {
    const int count = play_block(&b);
    if (count == 0)
      return false;
    for (int k = 0; k < count; k++) {
      played_match *match = &b.matches[k];
      for (size_t n = 0; n < match->count; n++)
        for (int chance = 0; chance < CHANCES && match->ended; chance++) {
          const told_stroke *stroke = &match->forecast[n];
          lab_compare(&rows[stroke->kind][chance], stroke->forecast[chance], stroke->came[chance]);
          lab_compare(&rows[CAROM_PLAN_KINDS][chance], stroke->forecast[chance],
                      stroke->came[chance]);
        }
      lab_compare_end(&rows[0][0], (CAROM_PLAN_KINDS + 1) * CHANCES);
      free(match->forecast);
    }
  }
  progress_clear();
  for (int kind = 0; kind <= CAROM_PLAN_KINDS; kind++)
    print_told(request, kind, rows[kind]);
  fflush(stdout);
  return true;
}
