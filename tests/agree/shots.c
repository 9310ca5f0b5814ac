/* Whole shots have equal bits in a batch and in single calls, whatever the threads and the cut. */
#include "random_shots.h"
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SHOTS = 150, ROOM = 1000 }; /* threads take 64 shots at a time */

static carom_table table;
static carom_shot_ball balls[SHOTS * 16];
static carom_cue cues[SHOTS];

/* Eight-ball breaks, each with its own rack and cue; the fifth has a cue that misses. */
static void make_breaks(void) {
  shot_random r = {test_seed()};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int k = 0; k < SHOTS; k++) {
    carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, (uint64_t)k, balls + 16 * k, 16);
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = shot_uniform(&r, 3.0, 10.0);
    cues[k].phi = shot_uniform(&r, 88.0, 92.0);
    cues[k].a = shot_uniform(&r, -0.3, 0.3);
  }
  cues[4].a = 2.0;
}

typedef struct results {
  carom_shot shot[SHOTS];
  carom_event *events;
  carom_ball_state final[SHOTS][16];
  int8_t status[SHOTS];
} results;

static results *make_results(void) {
  results *r = calloc(1, sizeof *r);
  r->events = calloc((size_t)SHOTS * ROOM, sizeof *r->events);
  for (int k = 0; k < SHOTS; k++)
    r->shot[k] = (carom_shot){.events = r->events + (size_t)k * ROOM, .room = ROOM, .final = r->final[k]};
  return r;
}

/* Plays the layouts with balls[] and the cues with cues[], each for all shots or for its own. */
static carom_status play_batch(int count, bool one_layout, bool one_cue, int from, int n, const carom_shot_options *options,
                               results *r) {
  const carom_shot_job job = {.table = &table,
                              .balls = balls + (one_layout ? 0 : count * from),
                              .cues = cues + (one_cue ? 0 : from),
                              .count = count,
                              .ball_stride = one_layout ? 0 : (uint64_t)count,
                              .cue_stride = one_cue ? 0 : 1,
                              .n = (uint64_t)n,
                              .options = options,
                              .shots = r->shot + from,
                              .status = r->status + from};
  return carom_shoot_batch(&job);
}

static void same_results(const results *a, const results *b) {
  for (int k = 0; k < SHOTS; k++) {
    ck_assert_int_eq(a->status[k], b->status[k]);
    ck_assert_int_eq(a->shot[k].count, b->shot[k].count);
    ck_assert_int_eq(memcmp(&a->shot[k].time, &b->shot[k].time, sizeof a->shot[k].time), 0);
  }
  ck_assert_int_eq(memcmp(a->final, b->final, sizeof a->final), 0);
  ck_assert_int_eq(memcmp(a->events, b->events, (size_t)SHOTS * ROOM * sizeof *a->events), 0);
}

static void free_results(results *r) {
  free(r->events);
  free(r);
}

START_TEST(batch_is_singles) {
  make_breaks();
  for (int world = 0; world < 2; world++) {
    carom_shot_options options = {.world = world, .cushion_model = CAROM_SHOT_CUSHION_HAN};
    results *single = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + 16 * k, 16, &cues[k], &options, &single->shot[k]);
    ck_assert_int_eq(single->status[4], CAROM_ERROR_MISCUE);
    ck_assert_int_eq(single->status[5], CAROM_OK);
    static const int threads[] = {0, 1, 2, 3, 7, CAROM_ALL_THREADS};
    for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
      results *batch = make_results();
      options.threads = threads[t];
      ck_assert_int_eq(play_batch(16, false, false, 0, SHOTS, &options, batch), CAROM_ERROR_MISCUE);
      same_results(single, batch);
      free_results(batch);
    }
    /* any cut */
    shot_random r = {test_seed()};
    results *cut = make_results();
    for (int from = 0, size; from < SHOTS; from += size) {
      size = (int)shot_uniform(&r, 1.0, 9.0);
      size = from + size <= SHOTS ? size : SHOTS - from;
      play_batch(16, false, false, from, size, &options, cut);
    }
    same_results(single, cut);
    free_results(cut);
    free_results(single);
  }
}
END_TEST

/* A bad layout costs itself, wherever it stands, and whatever is wrong with its first ball. */
START_TEST(bad_layouts) {
  static const double radii[] = {0.0, -1.0, NAN, INFINITY};
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  for (int bad = 0; bad <= SHOTS; bad++) { /* the first ones; all of them */
    make_breaks();
    cues[4].a = 0.0;
    for (int k = 0; k < bad; k++)
      balls[16 * k].kind.radius = radii[k % 4];
    results *single = make_results(), *batch = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + 16 * k, 16, &cues[k], &options, &single->shot[k]);
    ck_assert_int_eq(play_batch(16, false, false, 0, SHOTS, &options, batch), bad > 0 ? CAROM_ERROR_RADIUS : CAROM_OK);
    for (int k = 0; k < SHOTS; k++)
      ck_assert_int_eq(single->status[k], k < bad ? CAROM_ERROR_RADIUS : CAROM_OK);
    same_results(single, batch);
    free_results(single);
    free_results(batch);
    bad += bad > 2 && bad < SHOTS - 1 ? SHOTS - 2 - bad : 0;
  }
}
END_TEST

/* Each layout is checked and played with its own radius, whatever the radius of the others: too large for the nose, too small
 * for it, in the cushion with this radius and not with that. */
START_TEST(radii) {
  enum { LAYOUTS = 144, BALLS = 2 };
  static const double factor[] = {1.0, 1.0, 1.1, 0.7, 1.0, 1.95, 0.4, 1.1, 0.0};
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  static const int threads[] = {0, 3, CAROM_ALL_THREADS};
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  int played = 0, refused = 0;
  for (int from = 0; from < 9; from++) { /* each may be the first */
    results *single = make_results();
    for (int k = 0; k < LAYOUTS; k++) {
      for (int i = 0; i < BALLS; i++) {
        carom_shot_ball *b = &balls[BALLS * k + i];
        *b = (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_BILLIARD)};
        b->kind.radius *= factor[(from + k) % 9];
        b->state = (carom_ball_state){.r = {0.055 + 0.3 * i, 0.5 + 0.005 * k, b->kind.radius}};
      }
      cues[k] = carom_cue_of(CAROM_GAME_BILLIARD);
      cues[k].phi = 37.0 + 10.0 * k;
      single->status[k] = (int8_t)carom_shoot(&table, balls + BALLS * k, BALLS, &cues[k], &options, &single->shot[k]);
      played += single->status[k] == CAROM_OK;
      refused += single->status[k] == CAROM_ERROR_NOSE_HEIGHT || single->status[k] == CAROM_ERROR_OFF_TABLE;
    }
    for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
      carom_shot_options threaded = options;
      threaded.threads = threads[t];
      results *batch = make_results();
      const carom_status first = play_batch(BALLS, false, false, 0, LAYOUTS, &threaded, batch);
      same_results(single, batch);
      int bad = 0;
      while (batch->status[bad] >= 0)
        bad++;
      ck_assert_int_eq(first, batch->status[bad]);
      free_results(batch);
    }
    free_results(single);
  }
  ck_assert_int_eq(played, 9 * 96);
  ck_assert_int_eq(refused, 9 * 32);
}
END_TEST

/* One layout for all cues, one cue for all layouts. */
START_TEST(one_for_all) {
  make_breaks();
  cues[4].a = 0.0;
  const carom_shot_options options = {.cushion_model = CAROM_SHOT_CUSHION_HAN};
  for (int which = 0; which < 2; which++) {
    results *single = make_results(), *batch = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + (which == 0 ? 0 : 16 * k), 16, &cues[which == 0 ? k : 0],
                                              &options, &single->shot[k]);
    ck_assert_int_eq(play_batch(16, which == 0, which == 1, 0, SHOTS, &options, batch), CAROM_OK);
    same_results(single, batch);
    free_results(single);
    free_results(batch);
  }
}
END_TEST

/* Brief events tell what full ones do, in place of them and beside them, and no more of them than there is room for. */
START_TEST(brief_events) {
  enum { FEW = 7 };
  static carom_brief_event in_place[ROOM], beside[ROOM];
  static carom_event full[ROOM], others[ROOM];
  make_breaks();
  carom_shot a = {.events = full, .room = ROOM}, b = {.brief = in_place, .room = ROOM};
  carom_shot c = {.events = others, .brief = beside, .room = FEW};
  memset(beside, 0x55, sizeof beside);
  memset(others, 0x55, sizeof others);
  carom_shot *const each[] = {&a, &b, &c};
  for (int k = 0; k < 3; k++)
    ck_assert_int_eq(carom_shoot(&table, balls, 16, &cues[0], NULL, each[k]), CAROM_OK);
  ck_assert(a.count > FEW && a.count <= ROOM && a.count == b.count && a.count == c.count);
  for (int64_t k = 0; k < a.count; k++) {
    const carom_brief_event told = {full[k].time, full[k].type, full[k].a, full[k].b, 0};
    ck_assert_int_eq(memcmp(&in_place[k], &told, sizeof told), 0);
    if (k < FEW)
      ck_assert(memcmp(&beside[k], &told, sizeof told) == 0 && memcmp(&others[k], &full[k], sizeof full[k]) == 0);
  }
  for (const unsigned char *p = (const void *)&beside[FEW]; p < (const unsigned char *)(beside + ROOM); p++)
    ck_assert_int_eq(*p, 0x55);
  for (const unsigned char *p = (const void *)&others[FEW]; p < (const unsigned char *)(others + ROOM); p++)
    ck_assert_int_eq(*p, 0x55);
  /* states at a time need the full ones */
  carom_ball_state states[16];
  ck_assert_int_eq(carom_shot_at(balls, 16, &b, 0.5, states), CAROM_ERROR_EVENTS_LOST);
}
END_TEST

/* On every instruction set a shot ends well, and the first events, which nothing has amplified yet, are the same but for
 * rounding. */
START_TEST(instruction_sets) {
  static carom_event events[ROOM], others[ROOM];
  make_breaks();
  carom_isa_limit(CAROM_ISA_PLAIN);
  carom_shot plain = {.events = events, .room = ROOM};
  ck_assert_int_eq(carom_shoot(&table, balls, 16, &cues[0], NULL, &plain), CAROM_OK);
  FOR_EACH_ISA(isa) {
    carom_shot shot = {.events = others, .room = ROOM};
    ck_assert_int_eq(carom_shoot(&table, balls, 16, &cues[0], NULL, &shot), CAROM_OK);
    for (int k = 0; k < 8; k++) {
      ck_assert_int_eq(others[k].type, events[k].type);
      ck_assert_double_eq_tol(others[k].time, events[k].time, 1e-6);
    }
  }
  carom_isa_limit(CAROM_ISA_ANY);
}
END_TEST

int main(void) {
  return RUN_TESTS("shots", batch_is_singles, bad_layouts, radii, one_for_all, brief_events, instruction_sets);
}
