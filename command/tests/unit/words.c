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
  char texts[60][TEXT];
  for (int k = read_texts("said", 3, texts) - 1; k >= 0; k--) {
    const char *said = texts[3 * k], *words = texts[3 * k + 1];
    ck_assert_msg(word_among(words, said, strlen(said)) == atoi(texts[3 * k + 2]), "%s among %s",
                  said, words);
  }
}

/* Places by name, and those at a rail: of a bare number the unit is m, as elsewhere. */
TEST(places_in_words) {
  char texts[40][TEXT], place[80];
  for (int k = read_texts("place", 2, texts) - 1; k >= 0; k--) {
    const char *text = texts[2 * k];
    value x = {.x = 0.0}, y = {.x = 0.0};
    const char *rest = place_named(text, &x, &y);
    snprintf(place, sizeof place, "%s,%s%s", x.name, y.name, rest);
    ck_assert_str_eq(rest == text ? text : place, texts[2 * k + 1]);
  }
}

/* Places of the tip in words, at most half a radius from the centre, and with numbers. */
TEST(tips_in_words) {
  static place_list list;
  char texts[40][TEXT];
  for (int k = read_texts("tip", 4, texts) - 1; k >= 0; k--) {
    ck_assert_msg(option_tip.set(&option_tip, texts[4 * k], &list), "tip %d", k);
    ck_assert_int_eq(list.count, atoi(texts[4 * k + 1]));
    ck_assert_double_eq_tol(list.place[0].x.x, atof(texts[4 * k + 2]), 1e-12);
    ck_assert_double_eq_tol(list.place[0].y.x, atof(texts[4 * k + 3]), 1e-12);
  }
  for (int k = read_texts("no_tip", 1, texts) - 1; k >= 0; k--)
    ck_assert_msg(!option_tip.set(&option_tip, texts[k], &list), "no tip %d", k);
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
