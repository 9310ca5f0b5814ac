/* Numbers as text: what is read, and that what is written is the shortest of %.15g, %.16g and
 * %.17g that reads back. */
#include "rows/number.h"
#include "support.h"

TEST(what_is_read) {
  char texts[40][TEXT];
  double x;
  for (int k = read_texts("number", 2, texts) - 1; k >= 0; k--) {
    ck_assert_msg(parse_number(texts[2 * k], &x), "%s", texts[2 * k]);
    ck_assert(x == atof(texts[2 * k + 1]));
  }
  ck_assert(parse_number("NaN", &x) && isnan(x));
  for (int k = read_texts("no_number", 1, texts) - 1; k >= 0; k--)
    ck_assert_msg(!parse_number(texts[k], &x), "%s", texts[k]);
}

static void check_shortest(double x) {
  char text[NUMBER_TEXT], expected[NUMBER_TEXT];
  double back;
  ck_assert_ptr_eq(number_text(x, text), text);
  ck_assert_msg(parse_number(text, &back), "%s", text);
  ck_assert_msg(memcmp(&back, &x, sizeof x) == 0, "%a is written as %s, which is %a", x, text,
                back);
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(expected, sizeof expected, "%.*g", digits, x);
    if (strtod(expected, NULL) == x)
      break;
  }
  ck_assert_str_eq(text, expected);
}

TEST(what_is_written_is_the_shortest) {
  double chosen[40];
  for (int k = read_rows("written", 1, chosen) - 1; k >= 0; k--) {
    check_shortest(chosen[k]);
    check_shortest(-chosen[k]);
  }
}

TEST(powers_of_two_are_asymmetric) {
  for (int exponent = -1074; exponent <= 1023; exponent++)
    check_shortest(ldexp(1.0, exponent));
}

TEST(random_doubles_and_random_decimals) {
  random_source source = {test_seed()};
  for (int k = 0; k < 50000; k++) {
    const double usual =
        random_between(&source, -1.0, 1.0) * pow(10.0, floor(random_between(&source, -9.0, 17.0)));
    check_shortest(usual);
    check_shortest((double)(float)usual);
    check_shortest(
        ldexp(random_between(&source, 1.0, 2.0), (int)random_between(&source, -1074.0, 1023.0)));
    char text[NUMBER_TEXT];
    double decimal;
    snprintf(text, sizeof text, "%.*g", 1 + (int)random_between(&source, 0.0, 17.0), usual);
    ck_assert(parse_number(text, &decimal));
    check_shortest(decimal);
  }
}

TEST(not_a_number) {
  char text[NUMBER_TEXT];
  ck_assert_str_eq(number_text((double)NAN, text), "nan");
}
