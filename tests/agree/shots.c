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
  lab_random r = {test_seed()};
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (int k = 0; k < SHOTS; k++) {
    carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, (uint64_t)k, balls + 16 * k, 16);
    cues[k] = carom_cue_of(CAROM_GAME_POOL);
    cues[k].speed = lab_uniform(&r, 3.0, 10.0);
    cues[k].phi = lab_uniform(&r, 88.0, 92.0);
    cues[k].a = lab_uniform(&r, -0.3, 0.3);
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
    carom_shot_options options = {.world = world, .cushion_model = 1 + CAROM_CUSHION_HAN};
    results *single = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + 16 * k, 16, &cues[k], &options, &single->shot[k]);
    ck_assert_int_eq(single->status[4], CAROM_ERROR_MISCUE);
    ck_assert_int_eq(single->status[5], CAROM_OK);
    static const int threads[] = {0, 1, 2, 3, 7, CAROM_ALL_THREADS};
    for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
      results *batch = make_results();
      options.threads = threads[t];
      ck_assert_int_eq(carom_shoot_batch(&table, balls, 16, 0, cues, 0, SHOTS, &options, batch->shot, batch->status),
                       CAROM_ERROR_MISCUE);
      same_results(single, batch);
      free_results(batch);
    }
    /* any cut */
    lab_random r = {test_seed()};
    results *cut = make_results();
    for (int from = 0, size; from < SHOTS; from += size) {
      size = (int)lab_uniform(&r, 1.0, 9.0);
      size = from + size <= SHOTS ? size : SHOTS - from;
      carom_shoot_batch(&table, balls + 16 * from, 16, 0, cues + from, 0, (size_t)size, &options, cut->shot + from,
                        cut->status + from);
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
  const carom_shot_options options = {.cushion_model = 1 + CAROM_CUSHION_HAN};
  for (int bad = 0; bad <= SHOTS; bad++) { /* the first ones; all of them */
    make_breaks();
    cues[4].a = 0.0;
    for (int k = 0; k < bad; k++)
      balls[16 * k].kind.radius = radii[k % 4];
    results *single = make_results(), *batch = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + 16 * k, 16, &cues[k], &options, &single->shot[k]);
    ck_assert_int_eq(carom_shoot_batch(&table, balls, 16, 0, cues, 0, SHOTS, &options, batch->shot, batch->status),
                     bad > 0 ? CAROM_ERROR_RADIUS : CAROM_OK);
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
  const carom_shot_options options = {.cushion_model = 1 + CAROM_CUSHION_HAN};
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
      const carom_status first =
          carom_shoot_batch(&table, balls, BALLS, 0, cues, 0, LAYOUTS, &threaded, batch->shot, batch->status);
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
  const carom_shot_options options = {.cushion_model = 1 + CAROM_CUSHION_HAN};
  for (int which = 0; which < 2; which++) {
    results *single = make_results(), *batch = make_results();
    for (int k = 0; k < SHOTS; k++)
      single->status[k] = (int8_t)carom_shoot(&table, balls + (which == 0 ? 0 : 16 * k), 16, &cues[which == 0 ? k : 0],
                                              &options, &single->shot[k]);
    ck_assert_int_eq(
        carom_shoot_batch(&table, balls, 16, which == 0, cues, which == 1, SHOTS, &options, batch->shot, batch->status),
        CAROM_OK);
    same_results(single, batch);
    free_results(single);
    free_results(batch);
  }
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
  return RUN_TESTS("shots", batch_is_singles, bad_layouts, radii, one_for_all, instruction_sets);
}
