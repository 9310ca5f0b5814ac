/* Words that the command has are those of the library. */
#include "program/words.h"
#include "program/options.h"
#include "shots/shoot_flags.h"
#include "support.h"

TEST(words_of_an_option) {
  carom_shot_cushion cushion = CAROM_SHOT_CUSHION_DEFAULT;
  char smooth[] = "smooth", usual[] = "default", none[] = "smoth";
  char all[200] = "";
  for (int k = 1; carom_word(CAROM_WORDS_SHOT_CUSHION, k) != NULL; k++) {
    strcat(all, k > 1 ? "|" : "");
    strcat(all, carom_word(CAROM_WORDS_SHOT_CUSHION, k));
  }
  ck_assert(strstr(all, "han|mirror|") != NULL);
  option_row rows[MOST_OF_LIBRARY], *row = rows;
  const int count = rows_of(&options_of_shots, rows);
  ck_assert_int_gt(count, rows_of(&options_of_motion, rows));
  while (strcmp(row->name, "cushion") != 0)
    row++;
  ck_assert_str_eq(argument_of(row), all);
  ck_assert(row->set(row, smooth, &cushion));
  ck_assert_int_eq(cushion, CAROM_SHOT_CUSHION_SMOOTH);
  ck_assert(row->set(row, usual, &cushion));
  ck_assert_int_eq(cushion, CAROM_SHOT_CUSHION_DEFAULT);
  ck_assert(!row->set(row, none, &cushion));
}

TEST(every_table_and_rack_has_its_word) {
  static shoot_flags flags;
  const char *word;
  for (int rack = 0; rack < 2; rack++)
    for (int k = 0; (word = carom_word(rack ? CAROM_WORDS_RACK : CAROM_WORDS_TABLE, k)) != NULL;
         k++) {
      const option_row *row = rack ? &option_balls : &option_table;
      char text[40];
      strcpy(text, word);
      ck_assert(row->set(row, text, rack ? (void *)&flags.balls : (void *)&flags.table));
      ck_assert_int_eq(rack ? flags.balls.rack : flags.table.kind, 1 + k);
      ck_assert_ptr_nonnull(strstr(argument_of(row), word));
    }
}

/* Capitals, hyphens and the order of two parts do not matter, and some words have other names; a
 * word that is there itself is that one. */
TEST(words_as_players_say_them) {
  static const struct {
    const char *said;
    const char *words;
    int meant; /* its index; -1: none */
  } cases[] = {{"Eight-Ball", "nineball|eightball", 1},
               {"9-ball", "eightball|nineball", 1},
               {"left_side", "side-right|side-left", 1},
               {"top-left", "head-left|foot-left", 1},
               {"center", "head-spot|centre", 1},
               {"head", "head-spot|centre", 0},
               {"head", "head-spot|head", 1},
               {"screw", "stun|draw", 1},
               {"screw", "high|low", 1},
               {"side", "side-left|side-right", -1},
               {"lefts", "left|right", -1},
               {"-", "left|right", -1},
               {"", "left|right", -1}};
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    const int found = word_among(cases[k].words, cases[k].said, strlen(cases[k].said));
    ck_assert_msg(found == cases[k].meant, "%s among %s", cases[k].said, cases[k].words);
  }
}

/* Places by name, and those at a rail: of a bare number the unit is m, as elsewhere. */
TEST(places_in_words) {
  static const struct {
    const char *text;
    const char *numbers;
  } places[] = {
      {"left,4d", "0d,4d"},          {"head,2d", "2d,0d"},           {"right,1.2", "4d,1.2 m"},
      {"foot,30in", "30 in,8d"},     {"left,6d,10cm", "0d,6d,10cm"}, {"head,20cm", "20 cm,0d"},
      {"center,20cm", "2d,4d,20cm"}, {"Foot-Spot", "2d,6d"},         {"foot", "2d,6d"},
      {"0.6,1.5", "0.6,1.5"},        {"leftish,2d", "leftish,2d"}};
  char place[80];
  for (size_t k = 0; k < COUNT_OF(places); k++) {
    const char *text = places[k].text;
    value x = {.x = 0.0}, y = {.x = 0.0};
    const char *rest = place_named(text, &x, &y);
    snprintf(place, sizeof place, "%s,%s%s", x.name, y.name, rest);
    ck_assert_str_eq(rest == text ? text : place, places[k].numbers);
  }
}

/* Places of the tip in words, at most half a radius from the centre, and with numbers. */
TEST(tips_in_words) {
  static const struct {
    const char *text;
    int count;
    double x, y; /* of the first, over the radius */
  } good[] = {{"low", 1, 0.0, -0.5},
              {"center", 1, 0.0, 0.0},
              {"right,0", 1, 0.5, 0.0},
              {"low-left", 1, -0.3536, -0.3536},
              {"left,high", 1, -0.3536, 0.3536},
              {"50%,-20%", 1, 0.25, -0.1},
              {"draw:follow", 2, 0.0, -0.5},
              {"0.1,0.2:low", 2, 0.1, 0.2}};
  static const char *const bad[] = {"lower", "low-", "right,", "low,0.2,3", "left-frozen"};
  static place_list list;
  for (size_t k = 0; k < COUNT_OF(good); k++) {
    char text[40]; /* which may be cut into its parts */
    snprintf(text, sizeof text, "%s", good[k].text);
    ck_assert_msg(option_tip.set(&option_tip, text, &list), "%s", good[k].text);
    ck_assert_int_eq(list.count, good[k].count);
    ck_assert_double_eq_tol(list.place[0].x.x, good[k].x, 1e-12);
    ck_assert_double_eq_tol(list.place[0].y.x, good[k].y, 1e-12);
  }
  for (size_t k = 0; k < COUNT_OF(bad); k++) {
    char text[40];
    snprintf(text, sizeof text, "%s", bad[k]);
    ck_assert_msg(!option_tip.set(&option_tip, text, &list), "%s", bad[k]);
  }
}

TEST(numbers_by_name_and_key) {
  static shared_options shared;
  char good[] = "u_b=0.03,mu_slide=0.15", bad[] = "u_b=2", none[] = "u_q=1", bare[] = "mass";
  const option_row *row = &option_with_of_shots;
  ck_assert(row->set(row, good, &shared.with));
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  give_ball(&shared.with, &kind);
  ck_assert(kind.mu_ball == 0.03 && kind.mu_slide == 0.15 && kind.mass > 0);
  ck_assert(!row->set(row, bad, &shared.with));
  ck_assert(!row->set(row, none, &shared.with));
  ck_assert(!row->set(row, bare, &shared.with));
  ck_assert(!numbers_are_read(&shared)); /* mu_ball */
  shared.shot.friction = CAROM_FRICTION_CONSTANT;
  ck_assert(numbers_are_read(&shared));
}
