/* Numbers as text: what is read, and that what is written is the shortest of %.15g, %.16g and
 * %.17g that reads back. */
#include "rows/number.h"
#include "support.h"

TEST(what_is_read) {
  static const struct {
    const char *text;
    double number;
  } good[] = {{"1", 1},
              {"-1.5e-3", -0.0015},
              {" 2 ", 2},
              {"+.5", 0.5},
              {"0x1p-2", 0.25},
              {"inf", INFINITY},
              {"-INF", -INFINITY},
              {"Infinity", INFINITY},
              {"1e999", INFINITY},
              {"1e-999", 0}};
  static const char *const bad[] = {"", " ", "1,5", "1.5.2", "one", "1e", "--1", "1 2", "0x"};
  double x;
  for (size_t k = 0; k < COUNT_OF(good); k++) {
    ck_assert_msg(parse_number(good[k].text, &x), "%s", good[k].text);
    ck_assert_double_eq(x, good[k].number);
  }
  ck_assert(parse_number("NaN", &x) && isnan(x));
  for (size_t k = 0; k < COUNT_OF(bad); k++)
    ck_assert_msg(!parse_number(bad[k], &x), "%s", bad[k]);
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
  static const double chosen[] = {0.0,
                                  1.0,
                                  0.1,
                                  0.3333333333333333,
                                  100.0,
                                  1e15,
                                  1e16,
                                  123456789012345680.0,
                                  5e-324,
                                  2.2250738585072014e-308,
                                  1.7976931348623157e308,
                                  2.220446049250313e-16,
                                  INFINITY,
                                  9.95,
                                  0.028575,
                                  8.41,
                                  2e-308,
                                  0.30000000000000004,
                                  1e22,
                                  1e23,
                                  9007199254740993.0,
                                  5.684341886080802e-14,
                                  9999999999999999.0};
  for (size_t k = 0; k < COUNT_OF(chosen); k++) {
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
