/* What there is, by its rows: each number is rejected outside its range and named. */
#include "schema/numbers.h"
#include "support.h"

static carom_shot_ball fit(void) {
  return (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_POOL),
                           .state = {.r = {0.5, 1, 0.028575}}};
}

static void set(carom_ball_kind *kind, const carom_number *n, double x) {
  memcpy((char *)kind + n->offset, &x, sizeof x);
}

static const carom_number *number_of(const char *name) {
  int k = 0;
  while (carom_number_of(CAROM_PART_BALL, k) != NULL &&
         strcmp(carom_number_of(CAROM_PART_BALL, k)->name, name) != 0)
    k++;
  ck_assert_ptr_nonnull(carom_number_of(CAROM_PART_BALL, k));
  return carom_number_of(CAROM_PART_BALL, k);
}

TEST(rows_are_those_of_the_struct) {
  const carom_number *n;
  char text[80];
  int k = 0;
  for (; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    ck_assert_int_eq(n->offset, 8 * k);
    ck_assert(n->text[0] != '\0' && n->key[0] != '\0');
  }
  ck_assert_int_eq(k, sizeof(carom_ball_kind) / sizeof(double));
  ck_assert_ptr_null(carom_number_of(CAROM_PART_BALL, -1));
  for (int game = 0; game <= CAROM_GAME_POOLTOOL_BILLIARD; game++) {
    const carom_ball_kind kind = carom_ball_kind_of((carom_game)game);
    ck_assert_ptr_null(carom_ball_fault(&kind, text, sizeof text));
  }
  ck_assert_ptr_null(carom_ball_fault(NULL, text, sizeof text));
}

/* A rejected kind reports which number is invalid. */
TEST(every_refusal_names_a_number) {
  carom_table table;
  expect_ok(carom_table_make(CAROM_TABLE_POOL_9FT, &table));
  static const double values[] = {-2, -1, 0, 1e-13, 0.05, 0.3, 0.99, 1.5, 3, 1e7};
  int refused = 0;
  for (int j = 0; carom_number_of(CAROM_PART_BALL, j) != NULL; j++)
    for (int k = 0; carom_number_of(CAROM_PART_BALL, k) != NULL; k++)
      for (int x = 0; x < 100; x++) {
        carom_shot_ball ball = fit();
        char text[80];
        set(&ball.kind, carom_number_of(CAROM_PART_BALL, j), values[x % 10]);
        set(&ball.kind, carom_number_of(CAROM_PART_BALL, k), values[x / 10]);
        const carom_number *n = carom_ball_fault(&ball.kind, text, sizeof text);
        const carom_status status = carom_shot_check(&table, &ball, 1, NULL, NULL, NULL);
        if (n == NULL) /* a radius next to its state or table */
          ck_assert(status == CAROM_OK || ball.kind.radius != fit().kind.radius);
        else
          ck_assert(status < 0 && text[0] != '\0');
        refused += n != NULL;
      }
  ck_assert_int_gt(refused, 1000);
}

TEST(conditions_blame_a_number) {
  static const struct {
    const char *number_set;
    double value;
    const char *number_at_fault;
    const char *reason;
  } conditions[] = {{"nose_height", 0.06, "nose_height", "below 2 R"},
                    {"law_b", 0.995, "law_b", "at most 1 - law_a"},
                    {"smooth_q", 0.3, "smooth_x", "above 0 where smooth_q is"},
                    {"smooth_t", 0.3, "smooth_t", "0 where smooth_q is 0"},
                    {"smooth_k", 0.3, "smooth_k", "0 where smooth_q is 0"}};
  for (size_t k = 0; k < COUNT_OF(conditions); k++) {
    carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL);
    char text[80], cut[6];
    kind.law_a = 0.01;
    set(&kind, number_of(conditions[k].number_set), conditions[k].value);
    const carom_number *n = carom_ball_fault(&kind, text, sizeof text);
    ck_assert_ptr_eq(n, number_of(conditions[k].number_at_fault));
    ck_assert_str_eq(text, conditions[k].reason);
    ck_assert_ptr_eq(carom_ball_fault(&kind, cut, sizeof cut), n);
    ck_assert_uint_eq(strlen(cut), 5);
    ck_assert_ptr_eq(carom_ball_fault(&kind, NULL, 0), n);
  }
}

TEST(ranges_in_words) {
  static const struct {
    double low;
    double high;
    double other; /* a value outside the range */
    const char *unit;
    const char *words;
  } ranges[] = {
      {4.9406564584124654e-324, 1.7976931348623157e308, NAN, "kg", "above 0 and finite, in kg"},
      {4.9406564584124654e-324, 1, NAN, "", "above 0 and at most 1"},
      {0, 0.99999999999999989, NAN, "", "0 or more and below 1"},
      {0, 1.7976931348623157e308, NAN, "s/m", "0 or more and finite, in s/m"},
      {1.0000000000000002, 1.9999999999999998, 0, "", "0, or between 1 and 2"},
      {1e-12, 0.5, 0, "", "0, or 1e-12 to 0.5"},
      {0, 0.98, -1, "", "-1, or 0 to 0.98"},
      {1e6, 1e15, 0, "Pa", "0, or 1e6 to 1e15, in Pa"},
      {-1.05, 1000, NAN, "", "-1.05 to 1000"},
      {0.001, 12000, NAN, "", "0.001 to 12000"}};
  for (size_t k = 0; k < COUNT_OF(ranges); k++) {
    char text[64], cut[8];
    carom_number n = *carom_number_of(CAROM_PART_BALL, 0);
    n.low = ranges[k].low;
    n.high = ranges[k].high;
    n.other = ranges[k].other;
    n.unit = ranges[k].unit;
    ck_assert_uint_eq(carom_number_range(&n, text, sizeof text), strlen(ranges[k].words));
    ck_assert_str_eq(text, ranges[k].words);
    ck_assert_uint_eq(carom_number_range(&n, cut, sizeof cut), strlen(text));
    ck_assert_int_eq(strncmp(cut, text, 7), 0);
  }
}

TEST(what_is_read) {
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL);
  const carom_shot_options constant = {.friction = CAROM_FRICTION_CONSTANT},
                           smooth = {.cushion_model = CAROM_SHOT_CUSHION_SMOOTH},
                           mirror = {.ball_model = CAROM_BALL_MODEL_MIRROR},
                           pooltool = {.world = CAROM_WORLD_POOLTOOL};
  const carom_number *mu = number_of("mu_ball"), *b = number_of("law_b"),
                     *k = number_of("smooth_k"), *omega = number_of("omega_ratio");
  ck_assert(!carom_number_is_read(mu, &kind, NULL) && carom_number_is_read(mu, &kind, &constant));
  ck_assert(carom_number_is_read(b, &kind, NULL) && !carom_number_is_read(b, &kind, &constant));
  ck_assert(!carom_number_is_read(b, &kind, &mirror));
  ck_assert(!carom_number_is_read(k, &kind, NULL) && carom_number_is_read(k, &kind, &smooth));
  ck_assert(!carom_number_is_read(omega, &kind, NULL) &&
            carom_number_is_read(omega, &kind, &pooltool));
  ck_assert(carom_number_is_read(number_of("mass"), &kind, NULL));
}

TEST(words_are_without_gaps) {
  for (int of = 0; of <= CAROM_WORDS_SLIP; of++) {
    int value = of == CAROM_WORDS_EVENT ? CAROM_EVENT_STRIKE : 0;
    for (; carom_word((carom_words)of, value) != NULL; value++) {
      ck_assert_str_ne(carom_word((carom_words)of, value), "");
      ck_assert_str_ne(carom_word_text((carom_words)of, value), "");
    }
    ck_assert_int_ge(value, 2);
    ck_assert_ptr_null(carom_word((carom_words)of, -1));
    for (int beyond = value; beyond < 40; beyond++)
      ck_assert_ptr_null(carom_word_text((carom_words)of, beyond));
  }
}

/* Players write words in many ways; a text that is a word itself means that word. */
TEST(words_as_players_write_them) {
  static const struct {
    carom_words of;
    const char *text;
    const char *word; /* NULL: none */
  } cases[] = {{CAROM_WORDS_RACK, "9ball", "nineball"},
               {CAROM_WORDS_RACK, "8-ball", "eightball"},
               {CAROM_WORDS_RACK, "Ten Ball", "tenball"},
               {CAROM_WORDS_RACK, "billiards", "billiards"},
               {CAROM_WORDS_TABLE, "9-foot", "9ft"},
               {CAROM_WORDS_TABLE, "12ft", "snooker"},
               {CAROM_WORDS_TABLE, "9", NULL},
               {CAROM_WORDS_CONDITION, "fast", "fast_cloth"},
               {CAROM_WORDS_EVENT, "Ball Ball", "ball_ball"},
               {CAROM_WORDS_RACK, "BILLIARDS", "billiards"},
               {CAROM_WORDS_WORLD, "", NULL},
               {CAROM_WORDS_WORLD, NULL, NULL},
               {CAROM_WORDS_WORLD, "a text that is longer than any word of the library", NULL}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const int value = carom_word_value(cases[k].of, cases[k].text);
    if (cases[k].word == NULL)
      ck_assert_int_eq(value, -1);
    else
      ck_assert_str_eq(carom_word(cases[k].of, value), cases[k].word);
  }
  ck_assert_str_eq(carom_word_synonym("threecushion", 1), "carom");
  ck_assert_ptr_null(carom_word_synonym("nineball", 1));
  ck_assert_ptr_null(carom_word_synonym("nineball", -1));
  ck_assert_ptr_null(carom_word_synonym(NULL, 0));
  ck_assert_int_eq(carom_word_means("top-right", "foot-right"), 1);
  ck_assert_int_eq(carom_word_means("right_side", "side-right"), 1);
  ck_assert_int_eq(carom_word_means("side", "side-right"), 0);
  ck_assert_int_eq(carom_word_means(NULL, "side-right"), 0);
}
