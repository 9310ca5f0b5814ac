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
  static const struct {
    const char *text;
    const char *records;
  } files[] = {
      /* shapes of files */
      {"", ""},
      {"\n\n", ""},
      {"a,b\n1,2\n", "1:a|b;2:1|2;"},
      {"a,b\n1,2", "1:a|b;2:1|2;"},
      {"a,b\r\n1,2\r\n3,4\r\n", "1:a|b;2:1|2;3:3|4;"},
      {"a,b\r1,2\r", "1:a|b;2:1|2;"},
      {"a\n\n\r\n1\n\n2\n", "1:a;4:1;6:2;"},
      {"a,b\n,\n1\n1,2,3\n", "1:a|b;3:1;4:1|2|3;"},
      {" a , b \n", "1:a|b;"},
      /* what other programs write */
      {"# note\n#,\na,b\n1,2\n", "3:a|b;4:1|2;"},
      {"a,b\n#1,2\n", "1:a|b;2:#1|2;"},
      {"a;b\n1,5;2\n", "1:a|b;2:1,5|2;"},
      {"a\tb\n1\t\"2\t3\"\n", "1:a|b;2:1|2\t3;"},
      {"a,b;c\n1,2;3\n", "1:a|b;c;2:1|2;3;"},
      {"a;b (m, m);c\n1,5;2;3\n", "1:a|b (m, m)|c;2:1,5|2|3;"},
      {"a,b\n , \n,,,\n1,2\n\"\",\n", "1:a|b;4:1|2;"},
      /* quotes */
      {"\"a\",\"b,c\",\"d \"\"e\"\"\"\n1,2,3\n", "1:a|b,c|d \"e\";2:1|2|3;"},
      {"a,\"two\nlines\"\nnext,\"x\r\ny\"\nlast\n", "1:a|two\nlines;3:next|x\r\ny;5:last;"},
      {"\"starts\nhere\",1\nb\n", "1:starts\nhere|1;3:b;"}};
  for (size_t k = 0; k < COUNT_OF(files); k++)
    expect(files[k].text, files[k].records);
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
  static const struct {
    const char *text;
    bool has_semicolons; /* between fields */
    bool is_number;
    double number;
  } fields[] = {
      {"1,5", true, true, 1.5},    {"-0,25e1", true, true, -2.5}, {"1.5", true, true, 1.5},
      {",5", true, true, 0.5},     {"1,5", false, false, 0.0},    {"1.234,5", true, false, 0.0},
      {"1,2,3", true, false, 0.0}, {",", true, false, 0.0},       {"0x1,8", true, false, 0.0}};
  for (size_t k = 0; k < COUNT_OF(fields); k++) {
    double number = 0.0;
    const record r = {.decimal_commas = fields[k].has_semicolons};
    const bool is_number = record_number(&r, fields[k].text, &number);
    ck_assert_msg(is_number == fields[k].is_number, "%s", fields[k].text);
    if (is_number)
      ck_assert_msg(number == fields[k].number, "%s is %g", fields[k].text, number);
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
