/* CSV records: what real files contain. */
#include "rows/records.h"
#include "support.h"

static record_reader *open_text(const char *text, size_t size) {
  char path[32];
  FILE *file = tmpfile();
  ck_assert_ptr_nonnull(file);
  ck_assert_uint_eq(fwrite(text, 1, size, file), size);
  ck_assert_int_eq(fflush(file), 0);
  snprintf(path, sizeof path, "/proc/self/fd/%d", fileno(file));
  record_reader *reader = record_open(path);
  fclose(file);
  ck_assert_ptr_nonnull(reader);
  return reader;
}

/* Reads all records as "line:a|b|c;..." */
static void expect(const char *text, const char *expected) {
  char seen[512] = "";
  size_t used = 0;
  record_reader *reader = open_text(text, strlen(text));
  record in;
  while (record_next(reader, &in) == READ_ONE) {
    used += (size_t)snprintf(seen + used, sizeof seen - used, "%lld:", in.line);
    for (size_t k = 0; k < in.count; k++)
      used +=
          (size_t)snprintf(seen + used, sizeof seen - used, "%s%s", k > 0 ? "|" : "", in.field[k]);
    used += (size_t)snprintf(seen + used, sizeof seen - used, ";");
  }
  record_close(reader);
  ck_assert_str_eq(seen, expected);
}

TEST(records_of_files) {
  char texts[50][TEXT];
  for (int k = 2 * (read_texts("records", 2, texts) - 1); k >= 0; k -= 2)
    expect(texts[k], texts[k + 1]);
  expect("\xEF\xBB\xBF"
         "a,b\n1,2\n",
         "1:a|b;2:1|2;");
  expect("PK\x03\x04,1\n2,3\n", "");
}

TEST(a_first_record_of_numbers) {
  static const char *const texts[] = {"x,1,2\n", "1,2\n", "a,b,1\n", "a,b\n"};
  for (size_t k = 0; k < 4; k++) {
    record_reader *reader = open_text(texts[k], strlen(texts[k]));
    record in;
    ck_assert_int_eq(record_next(reader, &in), READ_ONE);
    ck_assert_msg(record_is_numbers(&in) == (k < 2), "%s", texts[k]);
    record_close(reader);
  }
}

TEST(decimal_commas) {
  char texts[40][TEXT];
  for (int k = read_texts("decimal", 4, texts) - 1; k >= 0; k--) {
    const char *text = texts[4 * k];
    const bool good = atoi(texts[4 * k + 2]);
    double number = 0.0;
    const record r = {.decimal_commas = atoi(texts[4 * k + 1])};
    ck_assert_msg(record_number(&r, text, &number) == good, "%s", text);
    ck_assert_msg(!good || number == atof(texts[4 * k + 3]), "%s is %g", text, number);
  }
}

TEST(a_quote_left_open_costs_one_record) {
  const size_t size = 3 << 20;
  char *text = malloc(size);
  memset(text, 'x', size);
  for (size_t k = 100; k < size; k += 100)
    text[k] = '\n';
  memcpy(text, "a\n\"open,", 8);
  memcpy(text + size - 7, "\nlast\n\n", 7);
  record_reader *reader = open_text(text, size);
  record in;
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert(in.malformed);
  ck_assert_int_eq(in.line, 2);
  char last[100] = "";
  while (record_next(reader, &in) == READ_ONE) {
    ck_assert(!in.malformed);
    snprintf(last, sizeof last, "%.90s", in.field[0]);
  }
  ck_assert_str_eq(last, "last");
  record_close(reader);
  free(text);
}

TEST(a_line_without_end_costs_one_record) {
  const size_t size = 5 << 20;
  char *text = malloc(size);
  memset(text, 'x', size);
  memcpy(text, "a,b\n", 4);
  memcpy(text + size - 6, "\r\nc,d\n", 6);
  record_reader *reader = open_text(text, size);
  record in;
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert(in.malformed);
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert(!in.malformed);
  ck_assert_int_eq(in.line, 3);
  ck_assert_uint_eq(in.count, 2);
  ck_assert_int_eq(record_next(reader, &in), READ_END);
  record_close(reader);
  free(text);
}

TEST(a_nul_does_not_end_a_field) {
  record_reader *reader = open_text("a\n0.5\0junk,\0\0,\"\0\"\n", 19);
  record in;
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert_int_eq(record_next(reader, &in), READ_ONE);
  ck_assert_uint_eq(in.count, 3);
  ck_assert_str_eq(in.field[0], "0.5?junk");
  ck_assert_str_eq(in.field[1], "??");
  ck_assert_str_eq(in.field[2], "?");
  record_close(reader);
}
